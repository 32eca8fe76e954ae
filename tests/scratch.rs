use orthoframe::geometry::*;
use orthoframe::units::*;
#[test]
fn scratch() {
    let mut world = crate::worlds::rb2();
    for r in [25.0, 30.0,  35.5] {
        world.robot.radius = Cm::of(r);
        let map = *world.maps.keys().next().unwrap();
        let plan = FloorPlan::build(&world, map, &world.robot, &DoorStates::default());
        for d in plan.doorways() { println!("r {r}: {:?} {:?} width {} open {:?} {:?}", d.door.map(|d| world.doors[&d].name.clone()), d.areas, d.width(), d.door.map(|id| d.clear_width(Some(&world.doors[&id]), world.doors[&id].state)),
           d.door.map(|id| (d.leaves(&world.doors[&id], world.doors[&id].state), d.leaf_obstacles(&world.doors[&id], world.doors[&id].state) ))); }
        println!("open {:?}", plan.open_doorways());
        for place in world.places.values() {
            let (_, frame) = world.placement(place.area).unwrap();
            let from = frame.apply(place.at);
            for p2 in world.places.values() {
                match plan.route(&world, from, Target::Place(p2.id), Method::Shortest) {
                    Ok(route) => println!("  {} -> {}: {:.0} {:?}", place.name, p2.name, route.length, route.doorways),
                    Err(e) => println!("  {} -> {}: {:?}", place.name, p2.name, e),
                }
            }
        }
    }
}
