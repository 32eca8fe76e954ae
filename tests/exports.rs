//! What other programs are given of a map, read back: GeoJSON, occupancy grids, route graphs.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe_exchange::{geojson, ros, to_geojson, to_grid, to_route_graph};
use orthoframe_geometry::{DoorStates, FloorPlan};
use orthoframe_map::{DoorState, World};
use orthoframe_units::{MapId, Point, Source};
use serde_json::Value;

fn rb2() -> World {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml");
    World::load(path).expect("the example is sound")
}

fn floors(world: &World) -> Vec<FloorPlan> {
    let plan = |map: &MapId| FloorPlan::build(world, *map, &world.robot, &DoorStates::new());
    world.maps.keys().map(plan).collect()
}

fn area(ring: &[Point]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>() / 2.0
}

#[test]
fn geojson_of_a_floor_reads_back_as_the_same_rooms_and_doors() {
    let world = rb2();
    let text = to_geojson(&world, floors(&world).iter());
    let survey = geojson::read(&Source::new("rb2.geojson", text)).expect("our own file");
    let level = &survey.levels[0];
    let scene = orthoframe_geometry::Scene::of(&world, *world.maps.keys().next().unwrap());
    let mut ours = BTreeMap::<String, f64>::new();
    for (id, placed) in &scene.areas {
        let name = world.areas[id].name.clone();
        let size = placed.prisms.iter().map(|p| p.polygon.signed_area()).sum::<f64>();
        *ours.entry(name).or_default() += size;
    }
    let mut theirs = BTreeMap::<String, f64>::new();
    for room in &level.rooms {
        *theirs.entry(room.name.clone()).or_default() += area(&room.outline);
    }
    assert_eq!(ours.keys().collect::<Vec<_>>(), theirs.keys().collect::<Vec<_>>());
    for (name, size) in &ours {
        assert!((size - theirs[name]).abs() < 1.0, "{name}: {size} {}", theirs[name]);
    }
    let doors: BTreeSet<&str> = world.area_doors().map(|d| d.name.as_str()).collect();
    let read: BTreeSet<&str> =
        level.openings.iter().map(|o| o.name.as_str()).filter(|n| !n.is_empty()).collect();
    assert_eq!(doors, read);
    for opening in level.openings.iter().filter(|o| !o.name.is_empty()) {
        let door = world.area_doors().find(|d| d.name == opening.name).unwrap();
        let width = (opening.jambs[1] - opening.jambs[0]).norm();
        assert!((width - door.width.get()).abs() < 0.01, "{}", door.name);
    }
    assert_eq!(level.spots.len(), world.places.len());
    // A thing of several parts is one, with all of them.
    assert_eq!(level.things.len(), scene.replicas.len());
    let parts: usize = scene.replicas.values().map(|r| r.prisms.len()).sum();
    let read = level.things.iter().map(|thing| survey.kinds[thing.kind].parts.len());
    assert_eq!(read.sum::<usize>(), parts);
}

#[test]
fn a_grid_of_a_floor_comes_apart_into_the_same_rooms() {
    // Rooms without furniture: with it a room may fall apart where two things leave a door's width.
    let mut world = rb2();
    world.replicas.clear();
    world.places.values_mut().for_each(|p| p.serves = None);
    let plan = floors(&world).remove(0);
    let files = to_grid(&world, &plan, 5.0).expect("a small house");
    let sheet = ros::sheet(&Source::new("rb2.yaml", &files.yaml)).expect("our own file");
    assert_eq!(sheet.image, format!("{}.pgm", files.name));
    let survey = ros::read_parts("rb2", &sheet, &files.pgm).expect("our own picture");
    let level = &survey.levels[0];
    let mut found: Vec<f64> = level.rooms.iter().map(|r| area(&r.outline).abs() / 1e4).collect();
    let scene = plan.scene();
    let mut ours: Vec<f64> = scene
        .areas
        .values()
        .map(|a| a.prisms.iter().map(|p| p.polygon.signed_area()).sum::<f64>() / 1e4)
        .collect();
    found.sort_by(f64::total_cmp);
    ours.sort_by(f64::total_cmp);
    assert_eq!(found.len(), ours.len(), "{found:?} {ours:?}");
    for (a, b) in found.iter().zip(&ours) {
        assert!((a - b).abs() < 0.12 * b, "{found:?} {ours:?}");
    }
    for doorway in plan.doorways() {
        let near = |o: &&orthoframe_exchange::Opening| {
            let middle = o.jambs[0] + (o.jambs[1] - o.jambs[0]) / 2.0;
            (middle - doorway.middle()).norm() < 30.0
        };
        assert!(level.openings.iter().any(|o| near(&o)), "{:?}", doorway.middle());
    }
}

#[test]
fn a_route_graph_is_whole_and_keeps_the_clearance() {
    let world = rb2();
    let plan = floors(&world).remove(0);
    let graph: Value = serde_json::from_str(&to_route_graph(&world, &plan)).expect("JSON");
    let features = graph["features"].as_array().expect("features");
    let mut ids = BTreeSet::new();
    let mut nodes = BTreeMap::new();
    let mut beside = BTreeMap::<u64, Vec<u64>>::new();
    for feature in features {
        let p = &feature["properties"];
        let id = p["id"].as_u64().expect("an id");
        assert!(ids.insert(id), "{id} twice");
        let at =
            |c: &Value| Point::new(c[0].as_f64().unwrap() * 100.0, c[1].as_f64().unwrap() * 100.0);
        let place = &feature["geometry"]["coordinates"];
        match feature["geometry"]["type"].as_str() {
            Some("Point") => {
                nodes.insert(id, at(place));
            }
            Some("MultiLineString") => {
                let (from, to) = (p["startid"].as_u64().unwrap(), p["endid"].as_u64().unwrap());
                beside.entry(from).or_default().push(to);
                assert_eq!(nodes[&from], at(&place[0][0]));
                assert_eq!(nodes[&to], at(&place[0][1]));
            }
            other => panic!("{other:?}"),
        }
    }
    // With all doors open the robot keeps its radius on every edge.
    let open: DoorStates = world.doors.keys().map(|d| (*d, DoorState::OPEN)).collect();
    let opened = plan.with_doors(&world, &open);
    for (from, ends) in &beside {
        for to in ends {
            let clearance = opened.clearance(&[nodes[from], nodes[to]]);
            assert!(clearance >= world.robot.radius.get() - 0.1, "{from} {to}: {clearance}");
        }
    }
    // One piece: rb2's rooms hang together once the doors are open.
    let mut seen = BTreeSet::new();
    let mut open = vec![*nodes.keys().next().unwrap()];
    while let Some(node) = open.pop() {
        if seen.insert(node) {
            open.extend(beside.get(&node).into_iter().flatten());
        }
    }
    assert_eq!(seen.len(), nodes.len());
    let named: BTreeSet<&str> =
        features.iter().filter_map(|f| f["properties"]["metadata"]["room"].as_str()).collect();
    assert_eq!(named.len(), world.areas.len());
}
