//! Position reports said and read back: what is said of a pose is read as a region that holds the pose.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use orthoframe::engine::{Engine, Whereabout};
use orthoframe_exchange::{Options, read};
use orthoframe_language::Language;
use orthoframe_language::report::{Detail, Facing};
use orthoframe_map::World;
use orthoframe_semantics::Spot;
use orthoframe_units::{Deg, MapId, Point, Pose};
use proptest::prelude::{ProptestConfig, prop_assert, proptest};
use proptest::test_runner::{TestCaseError, TestRunner};

use crate::files::shared;
use crate::floor_properties::Random;
use crate::worlds::{area_named, doubled, mirrored, rb2, renamed, rotated, unnumbered};

const DETAILS: [Detail; 3] = [Detail::Region, Detail::Spot, Detail::Heading];

/// The robot's places on the floor of a Map, as shares of its extent, with a heading.
fn pose(engine: &Engine, map: MapId, (x, y, heading): (f64, f64, f64)) -> Option<Pose> {
    let floor = &engine.floors().unwrap()[&map];
    let areas = floor.scene().areas.values().flat_map(|area| &area.prisms);
    let corners: Vec<Point> = areas.flat_map(|p| [p.bounds.min, p.bounds.max]).collect();
    let low = corners.iter().fold(corners[0], |a, b| a.inf(b));
    let high = corners.iter().fold(corners[0], |a, b| a.sup(b));
    let at = Point::new(low.x + x * (high.x - low.x), low.y + y * (high.y - low.y));
    let fits = floor.fragments().any(|fragment| fragment.fits(at));
    fits.then_some(Pose { at, heading: Deg::of(heading) })
}

fn said_is_read(engine: &Engine, map: MapId, pose: Pose) -> Result<(), TestCaseError> {
    let Ok(found) = engine.locate(map, pose, true) else { return Ok(()) };
    for language in [Language::Russian, Language::English] {
        for detail in DETAILS {
            let text = found.position.say_in(language, detail);
            let region = engine
                .read_position(&text)
                .map_err(|e| TestCaseError::fail(format!("{text}: {e}")))?;
            prop_assert!(region.map == map, "{text} at {pose:?}: {region:?}");
            let holds = engine.region_contains(&region, pose).unwrap();
            prop_assert!(holds, "{text} at {pose:?}: {region:?}");
        }
    }
    Ok(())
}

fn check(world: World) {
    check_some(world, 80);
}

fn check_some(world: World, poses: u32) {
    let engine = Engine::in_memory(world, None).unwrap();
    let mut runner = TestRunner::new(ProptestConfig::with_cases(poses));
    let told: RefCell<BTreeMap<String, BTreeSet<String>>> = RefCell::default();
    let maps: Vec<MapId> = engine.floors().unwrap().keys().copied().collect();
    runner
        .run(&(0..maps.len(), 0.0..1.0, 0.0..1.0, 0.0..360.0), |(n, x, y, heading)| {
            let Some(pose) = pose(&engine, maps[n], (x, y, heading)) else {
                return Err(TestCaseError::reject("not on the free floor"));
            };
            if let Ok(found) = engine.locate(maps[n], pose, true) {
                for (text, meant) in what_is_meant(&found) {
                    told.borrow_mut().entry(text).or_default().insert(meant);
                }
            }
            said_is_read(&engine, maps[n], pose)
        })
        .unwrap();
    let told = told.into_inner();
    assert!(told.len() > 8, "the poses are told apart: {told:?}");
    let of_two = told.iter().find(|(_, meant)| meant.len() > 1);
    assert!(of_two.is_none(), "one report of two places: {of_two:?}");
}

/// Reports of a pose without the heading, each with the one region or spot of the map that it is to mean, by ids.
fn what_is_meant(found: &Whereabout) -> Vec<(String, String)> {
    let room = format!("{} {}", found.map.0, found.terms.area.0);
    let spot = match found.terms.spot {
        Spot::InDoorway(way) => format!("{} in {:?}", found.map.0, way.door),
        Spot::AtDoor { way, .. } => format!("{room} at {:?}", way.door),
        Spot::On { replica } => format!("{room} on {replica:?}"),
        Spot::NextTo { replica, .. } => format!("{room} by {replica:?}"),
        // Of which nothing more is said than the room.
        Spot::Inside => room.clone(),
        other => format!("{room} {other:?}"),
    };
    let levels = [(Detail::Region, room), (Detail::Spot, spot)];
    let said = |language| {
        let levels = levels.iter();
        levels.map(move |(d, meant)| (found.position.say_in(language, *d), meant.clone()))
    };
    said(Language::Russian).chain(said(Language::English)).collect()
}

#[test]
fn what_is_said_of_a_pose_is_read_as_a_region_that_holds_it() {
    check(rb2());
}

/// What stands at a wall's other side, or reaches into it by a loose box, is not faced through it.
#[test]
fn nothing_is_faced_through_a_wall() {
    let shared = [
        "cases/office-two-storeys.toml",
        "procthor/house_0.json",
        "virtualhome/TestScene1_graph.json",
    ]
    .into_iter()
    .filter_map(shared)
    .map(|path| read(&path, &Options::default()).expect("a map").world);
    let mut random = Random(24);
    let mut count = 0;
    for world in std::iter::once(rb2()).chain(shared) {
        let engine = Engine::in_memory(world, None).unwrap();
        let world = engine.world().unwrap();
        let maps: Vec<MapId> = world.maps.keys().copied().collect();
        for n in 0..1500 {
            let map = maps[n % maps.len()];
            let place = (random.unit(), random.unit(), random.between(0.0, 360.0));
            let Some(pose) = pose(&engine, map, place) else { continue };
            let Ok(found) = engine.locate(map, pose, true) else { continue };
            let Some(Facing::Object(named)) = &found.position.facing else { continue };
            let name = named.phrase().name();
            let mut homes = world.replicas.values().filter(|r| r.name == name).map(|r| r.area);
            let is_here = homes.any(|area| area == found.terms.area);
            let in_doorway = matches!(found.terms.spot, Spot::InDoorway(_));
            count += usize::from(is_here);
            let told = found.position.say_in(Language::English, Detail::Heading);
            assert!(is_here || in_doorway, "{pose:?}: {told}");
        }
    }
    assert!(count > 100, "{count}");
}

#[test]
fn so_it_is_in_a_mirrored_renamed_and_turned_world() {
    check(rotated(&renamed(&mirrored(&rb2())), Deg::of(200.0)));
}

#[test]
fn namesakes_on_one_floor_are_told_apart() {
    check(unnumbered(&rb2()));
}

#[test]
fn namesakes_on_two_floors_are_told_apart() {
    let poses = if crate::files::long() { 80 } else { 12 };
    check_some(doubled(&rb2()), poses);
    check_some(doubled(&unnumbered(&rb2())), poses);
}

/// Houses of others, as they are and with every number taken off their names. The ordinary run takes a quarter of the poses.
#[test]
fn poses_in_imported_houses_are_told_apart() {
    let Some(folder) = shared("procthor") else { return };
    let house = |n: u32| {
        let path = folder.join(format!("house_{n}.json"));
        read(&path, &Options::default()).expect("the house reads").world
    };
    let poses = if crate::files::long() { 80 } else { 10 };
    check_some(house(4), poses);
    check_some(unnumbered(&house(1)), poses);
    check_some(doubled(&house(7)), poses);
}

/// A flat with rugs, an office and a building of two storeys.
#[test]
fn poses_in_other_imported_buildings_are_told_apart() {
    for (folder, file) in
        [("virtualhome", "TestScene1_graph.json"), ("rmf", "office.building.yaml")]
    {
        let Some(folder) = shared(folder) else { return };
        let world = read(&folder.join(file), &Options::default()).expect("it reads").world;
        check_some(unnumbered(&world), 25);
    }
    let storeys = World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/two-storeys.toml"));
    check_some(unnumbered(&storeys.expect("the map is sound")), 40);
}

#[test]
fn who_stands_on_a_rug_is_told_so() {
    let Some(folder) = shared("virtualhome") else { return };
    let path = folder.join("TestScene2_graph.json");
    let world = read(&path, &Options::default()).expect("it reads").world;
    let engine = Engine::in_memory(world, None).unwrap();
    let map = *engine.floors().unwrap().keys().next().unwrap();
    let pose = Pose { at: Point::new(-1150.0, 420.0), heading: Deg::ZERO };
    let found = engine.locate(map, pose, false).unwrap();
    let said = [Language::Russian, Language::English].map(|l| found.position.say(l));
    assert_eq!(
        said,
        ["Я нахожусь в Гостиной, стоя на Ковре-4.", "I am in the living room, standing on Rug 4."]
    );
    for text in said {
        let region = engine.read_position(&text).unwrap();
        assert!(engine.region_contains(&region, pose).unwrap());
        let beside = Pose { at: Point::new(-1150.0, 203.0), ..pose };
        assert!(!engine.region_contains(&region, beside).unwrap());
    }
}

/// Nothing is said that is not needed: a room that has no namesake is told by its name, one on another floor by the
/// floor, one on the same floor by what lies beside it.
#[test]
fn the_shortest_description_that_is_unique_is_taken() {
    let room = |world: World| {
        let named = |a: &&orthoframe_map::Area| a.name == "Комната-Z";
        let area = world.areas.values().find(named).unwrap().id;
        let engine = Engine::in_memory(world, None).unwrap();
        let (map, at) = engine.relations().unwrap().area_centre(area).unwrap();
        let found = engine.locate(map, Pose { at, heading: Deg::ZERO }, false).unwrap();
        found.position.say_in(Language::Russian, Detail::Region)
    };
    assert_eq!(room(rb2()), "Я нахожусь в Комнате-Z.");
    assert_eq!(room(doubled(&rb2())), "Я нахожусь на Первом этаже в Комнате-Z.");
    let mut twins = rb2();
    let other = area_named(&twins, "Комната-Y");
    let twin = twins.areas.get_mut(&other).unwrap();
    (twin.name, twin.name_en) = ("Комната-Z".into(), "Room Z".into());
    twin.forms.clear();
    assert_eq!(room(twins), "Я нахожусь в Комнате-Z, соседней с Комнатой-В.");
}

#[test]
fn a_region_leaves_out_what_the_report_does_not_mean() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let square = |text: &str| {
        let region = engine.read_position(text).unwrap();
        engine.region_points(&region, 10.0).unwrap().len()
    };
    let room = square("Я нахожусь в Комнате-В.");
    let door = square("Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.");
    let facing =
        square("Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z, лицом к ней.");
    assert!(0 < facing && facing <= door && door < room / 2, "{facing} {door} {room}");
    let at_door =
        engine.read_position("I am in Room V at the door leading from Room V to Room Z.").unwrap();
    let holds = |x, y| {
        let pose = Pose { at: Point::new(x, y), heading: Deg::ZERO };
        engine.region_contains(&at_door, pose).unwrap()
    };
    assert!(holds(225.0, 395.0));
    assert!(!holds(60.0, 60.0));
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_panic(words in proptest::collection::vec("(я|нахожусь|в|у|двери|ведущей|из|Комнате-В|Комнаты-В|лицом|к|ней|наружу|the|in|at|door|leading|facing|it|,|\\PC{0,5})", 0..15)) {
        thread_local! {
            static ENGINE: Engine = Engine::in_memory(rb2(), None).unwrap();
        }
        let text = words.join(" ");
        // What is read is a region of the map; everything else is refused with a reason.
        ENGINE.with(|engine| {
            match engine.read_position(&text) {
                Ok(region) => prop_assert!(engine.world().unwrap().areas.contains_key(&region.area)),
                Err(fault) => prop_assert!(!fault.to_string().is_empty()),
            }
            Ok(())
        })?;
    }
}
