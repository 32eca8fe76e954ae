//! Ways from floor to floor.

use std::collections::BTreeMap;

use orthoframe::Engine;
use orthoframe::engine::Method;
use orthoframe_geometry::*;
use orthoframe_language::Language;
use orthoframe_language::report::Detail;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floors::{Builder, Opening, p, rectangle};
use crate::routes::check_route;

/// Two floors, each a hall of 1000 × 400 with a cabin of 150 × 150 at its left and one at its right end.
///
/// ```text
///   +---+                  +---+
///   | L |                  | R |
///   +-D-+------------------+-D-+
///   |          hall            |
///   +--------------------------+
/// ```
struct House {
    world: World,
    halls: [AreaId; 2],
    doors: Vec<DoorId>,
}

fn house() -> House {
    let mut b = Builder::new();
    let mut halls = Vec::new();
    let mut cabins = Vec::new();
    let mut doors = Vec::new();
    for floor in 1..=2 {
        let (left, right) = (
            b.door(DoorKind::Sliding, 90.0, DoorState::OPEN),
            b.door(DoorKind::Sliding, 90.0, DoorState::OPEN),
        );
        doors.extend([left, right]);
        let hall = [
            p(0., 0.),
            p(1000., 0.),
            p(1000., 400.),
            p(970., 400.),
            p(880., 400.),
            p(120., 400.),
            p(30., 400.),
            p(0., 400.),
        ];
        let open = [(3, Opening::Door(right)), (5, Opening::Door(left))];
        halls.push(b.area(&format!("Холл-{floor}"), &hall, Frame::IDENTITY, &open));
        let cabin = [p(0., 0.), p(30., 0.), p(120., 0.), p(150., 0.), p(150., 150.), p(0., 150.)];
        for (x, door) in [(0.0, left), (850.0, right)] {
            let at = Frame::new(x, 400.0, 0.0, Deg::ZERO);
            let name = format!("Кабина-{floor}-{x}");
            cabins.push(b.area(&name, &cabin, at, &[(1, Opening::Door(door))]));
        }
    }
    let mut world = b.world;
    // The second floor's Areas move to a Map of their own, 300 cm higher.
    let mut upper = world.maps[&MapId(1)].clone();
    (upper.id, upper.key, upper.name) = (MapId(2), "upper".into(), "Второй этаж".into());
    let lower = world.maps.get_mut(&MapId(1)).unwrap();
    upper.items = lower.items.split_off(3);
    upper.items[0].is_base = true;
    world.maps.insert(MapId(2), upper);
    world.domain.maps.push(DomainMap {
        map: MapId(2),
        frame: Frame::new(0.0, 0.0, 300.0, Deg::ZERO),
        is_base: false,
    });
    let stop = |area: AreaId| LiftStop { area };
    world.domain.lifts = vec![
        ("Левый".into(), vec![stop(cabins[0]), stop(cabins[2])]),
        ("Правый".into(), vec![stop(cabins[1]), stop(cabins[3])]),
    ];
    House { world, halls: [halls[0], halls[1]], doors }
}

fn plans(world: &World) -> BTreeMap<MapId, FloorPlan> {
    let plan = |&m: &MapId| (m, FloorPlan::build(world, m, &world.robot, &DoorStates::new()));
    world.maps.keys().map(plan).collect()
}

fn way(world: &World, from: Point, to: Point) -> Result<Vec<Leg>, Box<NoWay>> {
    let ends = ((MapId(1), from), (MapId(2), Target::Point(to)));
    across(world, &plans(world), ends.0, ends.1, Method::Shortest)
}

#[test]
fn the_lift_that_makes_the_way_shortest_is_ridden() {
    let house = house();
    let plans = plans(&house.world);
    for (from, to, lift) in [
        (p(100., 100.), p(200., 100.), 0),
        (p(900., 100.), p(800., 100.), 1),
        (p(100., 100.), p(950., 100.), 1),
        (p(100., 300.), p(800., 100.), 0),
    ] {
        let legs = way(&house.world, from, to).expect("both lifts run");
        assert_eq!(legs.iter().map(|l| l.map).collect::<Vec<_>>(), [MapId(1), MapId(2)]);
        let length: f64 = legs.iter().map(|l| l.route.length).sum();
        for leg in &legs {
            check_route(&plans[&leg.map], &house.world, &leg.route);
        }
        let ride = legs[0].ride.as_ref().expect("a lift between floors");
        assert!((ride.rise - 300.0).abs() < 1e-9 && legs[1].ride.is_none());
        // By either lift alone it is no shorter.
        let mut lengths = Vec::new();
        for only in 0..2 {
            let mut world = house.world.clone();
            world.domain.lifts = vec![world.domain.lifts[only].clone()];
            let legs = way(&world, from, to).expect("one lift is enough");
            lengths.push(legs.iter().map(|l| l.route.length).sum::<f64>());
        }
        assert!((length - lengths[0].min(lengths[1])).abs() < 1e-6, "{length} of {lengths:?}");
        if (lengths[0] - lengths[1]).abs() > 1.0 {
            assert_eq!(lengths[1] < lengths[0], ride.lift == 1);
            assert!(lift == ride.lift || from.x < 200.0, "{from:?} {to:?}");
        }
    }
}

#[test]
fn a_lift_behind_a_shut_door_is_left_aside() {
    let mut house = house();
    let shut = DoorState { status: DoorStatus::Locked, opening: 0.0 };
    house.world.doors.get_mut(&house.doors[0]).unwrap().state = shut;
    let legs = way(&house.world, p(100., 100.), p(200., 100.)).expect("the right one runs");
    assert_eq!(legs[0].ride.as_ref().unwrap().lift, 1);
    house.world.doors.get_mut(&house.doors[1]).unwrap().state = shut;
    let no = way(&house.world, p(100., 100.), p(200., 100.)).expect_err("both are shut");
    assert_eq!(no.map, MapId(1));
    let barriers = no.why.barriers();
    assert!(matches!(barriers, [Barrier::Door { status: DoorStatus::Locked, .. }]), "{no:?}");
}

#[test]
fn a_lift_opens_its_doors_where_it_is_called() {
    let mut house = house();
    let open = way(&house.world, p(100., 100.), p(200., 100.)).expect("both lifts run");
    for door in house.world.doors.values_mut() {
        door.state = DoorState::CLOSED;
    }
    let closed = way(&house.world, p(100., 100.), p(200., 100.)).expect("it is called");
    assert_eq!(closed, open);
    let engine = Engine::in_memory(house.world.clone(), None).expect("built-in rules");
    let journey = engine.journey("Холл-1", "Холл-2", Method::Shortest).expect("both are known");
    assert!(journey.rides.len() == 1 && journey.legs.iter().all(|leg| leg.route.is_ok()));
    // On one floor a cabin whose door is closed is shut off as any room is.
    let plan = &plans(&house.world)[&MapId(1)];
    let cabin = plan.doorways()[0].areas.into_iter().find(|area| *area != house.halls[0]);
    let target = Target::Area(cabin.expect("a cabin"));
    assert!(plan.route(&house.world, p(100., 100.), target, Method::Shortest).is_err());
}

#[test]
fn without_a_lift_there_is_no_way_and_stairs_are_none() {
    let mut house = house();
    let lifts = std::mem::take(&mut house.world.domain.lifts);
    let other = |world: &World, told: [&str; 2]| {
        let no = way(world, p(100., 100.), p(200., 100.)).expect_err("no lift");
        assert!(matches!(no.why, NoRoute::OtherMap { .. }), "{no:?}");
        for (language, told) in [Language::Russian, Language::English].into_iter().zip(told) {
            let engine = Engine::in_memory(world.clone(), None).expect("built-in rules");
            let journey = engine.journey("Холл-1", "Холл-2", Method::Shortest).expect("two halls");
            let words = journey.legs[0].no_way_in_words(world, language).expect("no lift");
            assert!(words.contains(told), "{words}");
        }
    };
    other(&house.world, ["куда не ведёт ни лифт, ни лестница", "neither lift nor stairs lead"]);
    house.world.domain.lifts = lifts;
    let stairs = TypeEntry {
        id: TypeId(900),
        name: "лестница".into(),
        traits: vec!["stairs".into()],
        ..house.world.types.area.entries.values().next().cloned().unwrap_or_else(blank_type)
    };
    house.world.types.area.entries.insert(TypeId(900), stairs);
    for (_, stops) in &house.world.domain.lifts.clone() {
        house.world.areas.get_mut(&stops[0].area).unwrap().area_type = Some(TypeId(900));
    }
    other(&house.world, ["куда ведёт только лестница", "only stairs lead"]);
}

fn blank_type() -> TypeEntry {
    TypeEntry {
        id: TypeId(0),
        name: String::new(),
        name_en: String::new(),
        description: String::new(),
        gender: None,
        animate: false,
        synonyms: vec![],
        forms: Forms::new(),
        traits: vec![],
    }
}

#[test]
fn a_journey_is_told_floor_by_floor() {
    let house = house();
    let engine = Engine::in_memory(house.world, None).expect("built-in rules");
    let journey = engine.journey("Холл-1", "Холл-2", Method::Shortest).expect("both are known");
    assert_eq!((journey.legs.len(), journey.rides.len()), (2, 1));
    let lift = &journey.rides[0];
    let name = ["Левый", "Правый"][lift.lift];
    let text = engine
        .journey_in_words(&journey, None, Language::Russian, Detail::Spot)
        .expect("a map")
        .join("\n");
    let ride = format!("Поднимитесь на лифте «{name}» на Второй этаж.");
    assert!(text.contains(&ride), "{text}");
    assert!(text.ends_with("в Холл-2."), "{text}");
    let back = engine.journey("Холл-2", "Холл-1", Method::Shortest).expect("both are known");
    let text = engine
        .journey_in_words(&back, None, Language::English, Detail::Spot)
        .expect("a map")
        .join("\n");
    assert!(
        text.contains("down to the floor “Карта”") || text.contains("down to the floor “Map”"),
        "{text}"
    );
    let areas: Vec<AreaId> = journey.legs[1].stages.iter().map(|s| s.area).collect();
    assert_eq!(areas.last(), Some(&house.halls[1]));
}

#[test]
fn what_would_open_a_way_is_said() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    b.put(hall, 180.0, 0.0, 40.0, 130.0, 0.0, 100.0);
    let chair = b.put(hall, 185.0, 170.0, 30.0, 120.0, 0.0, 100.0);
    let replica = b.world.replicas.get_mut(&chair).unwrap();
    (replica.move_prob, replica.name) = (80, "Стул-2".into());
    let engine = Engine::in_memory(b.world, None).expect("built-in rules");
    let journey =
        engine.journey("50,150", "350,150", Method::Shortest).expect("points of the hall");
    assert!(journey.legs[0].route.is_err());
    let advice = journey.advice.expect("the chair can be pushed");
    let text = advice.in_words(engine.world().unwrap(), Language::Russian);
    // The box stands below the chair, and nothing above it.
    assert!(text.starts_with("подвиньте Стул-2 на 1"), "{text}");
    assert!(text.ends_with(" см в сторону от Вещи-6"), "{text}");
    let text = advice.in_words(engine.world().unwrap(), Language::English);
    assert!(text.contains(" cm away from "), "{text}");
}

/// What the robot does not climb on is in its way by its underside, however low that and the robot are.
#[test]
fn what_hangs_is_told_to_hang_to_a_low_robot_too() {
    for (height, low) in [(120.0, 70.0), (120.0, 15.0), (9.0, 5.0)] {
        let mut b = Builder::new();
        let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
        let object = b.object(&[(&rectangle(40.0, 300.0), 0.0, 100.0)]);
        b.place_object(hall, object, Frame::new(180.0, 0.0, low, Deg::ZERO));
        b.world.robot.height = Cm::of(height);
        let engine = Engine::in_memory(b.world, None).expect("built-in rules");
        let journey =
            engine.journey("50,150", "350,150", Method::Shortest).expect("points of the hall");
        let told = journey.legs[0].no_way_in_words(engine.world().unwrap(), Language::English);
        let told = told.expect("it is shut off");
        assert!(told.contains(&format!("its underside at {low} cm")), "{told}");
    }
}
