//! Map files: every fault in its place, nothing lost on the way, and no text that does harm.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use expect_test::expect_file;
use miette::Diagnostic;
use orthoframe::geometry::{DoorStates, FloorPlan, Method, Target};
use orthoframe::map::{DoorState, Format, Reading, read};
use orthoframe::units::{Cm, Source};

use crate::worlds::variants;

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/map")
}

/// `line:column code text`, then the remedy.
fn listing(reading: &Reading) -> String {
    let mut text = String::new();
    for fault in &reading.faults.faults {
        let place =
            reading.faults.position(fault).map(|(line, column)| format!("{line}:{column} "));
        let also = fault.spans.get(1).map(|span| {
            let source = reading.faults.source.as_ref().expect("spans are of a text");
            let (line, column) = source.position(span.offset());
            format!(" (и {line}:{column})")
        });
        let kind = if fault.is_warning() { "предупреждение: " } else { "" };
        let code = fault.code().expect("every fault has a code");
        let help = fault.help().expect("every fault has a remedy");
        let (place, also) = (place.unwrap_or_default(), also.unwrap_or_default());
        writeln!(text, "{place}{code} {kind}{fault}{also}\n    {help}")
            .expect("a string takes all");
    }
    let verdict = if reading.world.is_some() { "годна" } else { "не годна" };
    writeln!(text, "карта {verdict}").expect("a string takes all");
    text
}

#[test]
fn every_fault_is_reported_in_its_place() {
    let mut cases = 0;
    for case in std::fs::read_dir(golden()).expect("golden cases are part of the crate") {
        let case = case.expect("a folder can be read").path();
        let map = ["map.toml", "map.yaml", "map.json"].map(|name| case.join(name));
        let map = map.iter().find(|map| map.exists()).expect("every case has a map");
        let source = Source::new("map", std::fs::read_to_string(map).expect("a map is a text"));
        let reading = read(&source, Format::of(map));
        expect_file![case.join("faults.txt")].assert_eq(&listing(&reading));
        cases += 1;
    }
    assert!(cases > 10);
}

#[test]
fn the_worked_examples_are_without_fault() {
    for name in ["rb2", "box", "room"] {
        let path = format!("{}/maps/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let source = Source::read(Path::new(&path)).expect("the examples are part of the crate");
        let reading = read(&source, Format::Toml);
        assert!(reading.faults.faults.is_empty(), "{name}: {}", listing(&reading));
    }
}

#[test]
fn the_robot_drives_from_everywhere_to_everywhere() {
    let all = ["as it is", "with a fifth room", "mirrored, renamed and turned by 200"];
    for (how, mut world) in variants().into_iter().filter(|(how, _)| all.contains(how)) {
        // Seventy-five centimetres must be free, more than the robot of the papers needs.
        world.robot.radius = Cm::of(37.5 - world.robot.clearance.get());
        let between: Vec<_> =
            world.doors.keys().copied().filter(|&d| world.door_areas(d).len() == 2).collect();
        for door in &between {
            world.doors.get_mut(door).expect("a door of this world").state = DoorState::OPEN;
        }
        let map = *world.maps.keys().next().expect("one flat");
        let plan = FloorPlan::build(&world, map, &world.robot, &DoorStates::default());
        let mut targets: Vec<_> = world.places.keys().map(|&place| Target::Place(place)).collect();
        for door in between {
            let areas = world.door_areas(door);
            targets.extend(areas.into_iter().map(|area| Target::Door { door, area }));
        }
        for place in world.places.values() {
            let (_, frame) = world.placement(place.area).expect("every room stands on the map");
            let from = frame.apply(place.at);
            for &target in &targets {
                let route = plan.route(&world, from, target, Method::Shortest);
                let route =
                    route.unwrap_or_else(|e| panic!("{how}: {} {target:?}: {e:?}", place.name));
                assert!(
                    route.moved_start.is_none(),
                    "{how}: {} {:?}",
                    place.name,
                    route.moved_start
                );
                assert!(
                    route.moved_goal.is_none(),
                    "{how}: {} {target:?} {:?}",
                    place.name,
                    route.moved_goal
                );
            }
        }
    }
}
