//! Position reports said and read back: what is said of a pose is read as a region that holds the pose.

use orthoframe::engine::Engine;
use orthoframe::language::Language;
use orthoframe::language::report::Detail;
use orthoframe::map::World;
use orthoframe::units::{Deg, Point, Pose};
use proptest::prelude::{ProptestConfig, prop_assert, proptest};
use proptest::test_runner::{TestCaseError, TestRunner};

use crate::worlds::{mirrored, rb2, renamed, rotated};

const DETAILS: [Detail; 3] = [Detail::Region, Detail::Spot, Detail::Heading];

/// The robot's places on the floor of a world's first Map, as shares of its extent, with a heading.
fn pose(engine: &Engine, (x, y, heading): (f64, f64, f64)) -> Option<Pose> {
    let (_, floor) = engine.floors().unwrap().first_key_value()?;
    let areas = floor.scene().areas.values().flat_map(|area| &area.prisms);
    let corners: Vec<Point> = areas.flat_map(|p| [p.bounds.min, p.bounds.max]).collect();
    let low = corners.iter().fold(corners[0], |a, b| a.inf(b));
    let high = corners.iter().fold(corners[0], |a, b| a.sup(b));
    let at = Point::new(low.x + x * (high.x - low.x), low.y + y * (high.y - low.y));
    let fits = floor.fragments().any(|fragment| fragment.fits(at));
    fits.then_some(Pose { at, heading: Deg::of(heading) })
}

fn said_is_read(engine: &Engine, pose: Pose) -> Result<(), TestCaseError> {
    let map = *engine.floors().unwrap().keys().next().unwrap();
    let Ok(found) = engine.locate(map, pose, true) else { return Ok(()) };
    for language in [Language::Russian, Language::English] {
        for detail in DETAILS {
            let text = found.position.say_in(language, detail);
            let region = engine
                .read_position(&text)
                .map_err(|e| TestCaseError::fail(format!("{text}: {e}")))?;
            let holds = engine.region_contains(&region, pose).unwrap();
            prop_assert!(holds, "{text} at {pose:?}: {region:?}");
        }
    }
    Ok(())
}

fn check(world: World) {
    let engine = Engine::in_memory(world, None).unwrap();
    let mut runner = TestRunner::new(ProptestConfig::with_cases(150));
    let mut told = std::collections::BTreeSet::new();
    let cell = std::cell::RefCell::new(&mut told);
    runner
        .run(&(0.0..1.0, 0.0..1.0, 0.0..360.0), |shares| {
            let Some(pose) = pose(&engine, shares) else {
                return Err(TestCaseError::reject("not on the free floor"));
            };
            let map = *engine.floors().unwrap().keys().next().unwrap();
            if let Ok(found) = engine.locate(map, pose, true) {
                cell.borrow_mut().insert(found.position.say(Language::Russian));
            }
            said_is_read(&engine, pose)
        })
        .unwrap();
    assert!(told.len() > 20, "the poses are told apart: {told:?}");
}

#[test]
fn what_is_said_of_a_pose_is_read_as_a_region_that_holds_it() {
    check(rb2());
}

#[test]
fn so_it_is_in_a_mirrored_renamed_and_turned_world() {
    check(rotated(&renamed(&mirrored(&rb2())), Deg::of(200.0)));
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
