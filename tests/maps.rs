//! Map files: every fault in its place, nothing lost on the way, and no text that does harm.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use expect_test::expect_file;
use miette::Diagnostic;
use orthoframe_geometry::{DoorStates, FloorPlan, Method, Target};
use orthoframe_map::{DoorState, Format, MapErrors, Reading, World, check, read};
use orthoframe_units::{Cm, Source};

use proptest::prelude::*;

use crate::generated_worlds::{self, Dice};
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

/// Every fault in English with its remedy.
fn in_english(faults: &MapErrors) -> String {
    let english = faults.in_english();
    let mut text = format!("{english}\n");
    for fault in english.related().into_iter().flatten() {
        let help = fault.help().expect("every fault has a remedy");
        writeln!(text, "{fault}\n    {help}").expect("a string takes all");
    }
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
        expect_file![case.join("faults.en.txt")].assert_eq(&in_english(&reading.faults));
        cases += 1;
    }
    assert!(cases > 10);
}

#[test]
fn the_worked_examples_are_without_fault() {
    for name in ["rb2", "box", "room", "lab"] {
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

/// The world that a text describes; the faults as a failure where there are any.
fn reread(text: &str) -> World {
    let reading = read(&Source::new("copy.toml", text), Format::Toml);
    reading.world.clone().unwrap_or_else(|| panic!("{}\n{text}", listing(&reading)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn writing_and_reading_loses_nothing(seed in any::<u64>()) {
        let world = generated_worlds::world(seed);
        let faults = check(&world);
        prop_assert!(faults.iter().all(|f| f.is_warning()), "{:#?}", faults);
        let text = world.to_toml();
        let again = reread(&text);
        prop_assert_eq!(&again, &world, "{}", text);
        prop_assert_eq!(again.to_toml(), text);
    }
}

/// The text of the flat with a few random changes: letters, words and lines lost, doubled, or replaced by others'.
fn spoiled(text: &str, dice: &mut Dice) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for _ in 0..=dice.below(6) {
        let at = dice.below(chars.len());
        let end = (at + [1, 1, 3, 20, 300][dice.below(5)]).min(chars.len());
        let from = dice.below(chars.len());
        let graft: Vec<char> = chars[from..(from + dice.below(30)).min(chars.len())].to_vec();
        match dice.below(4) {
            0 => drop(chars.drain(at..end)),
            1 => chars.insert(at, ['"', '[', '}', '\0', '9', '-', 'é', '\n', '.'][dice.below(9)]),
            2 => drop(chars.splice(at..end, graft)),
            _ => drop(chars.splice(at..at, graft)),
        }
    }
    chars.into_iter().collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_spoiled_map_is_refused_or_read_but_never_harms(seed in any::<u64>()) {
        let text = include_str!("../maps/rb2.toml");
        let mut dice = Dice::new(seed);
        let text = spoiled(text, &mut dice);
        let format = [Format::Toml, Format::Toml, Format::Toml, Format::Yaml][dice.below(4)];
        let reading = read(&Source::new("spoiled", &text), format);
        prop_assert_eq!(reading.world.is_none(), reading.faults.has_errors());
        for span in reading.faults.faults.iter().flat_map(|fault| &fault.spans) {
            let (start, end) = (span.offset(), span.offset() + span.len());
            prop_assert!(text.get(start..end).is_some(), "{start}..{end} of {}", text.len());
        }
        if let Some(world) = reading.world {
            prop_assert_eq!(reread(&world.to_toml()), world);
        }
    }
}

#[test]
fn no_text_does_harm() {
    let deep = |open: &str| format!("format = 1\nx = {}", open.repeat(100_000));
    let bomb: String = (1..30)
        .map(|i| format!("a{i}: &a{i} [*a{p},*a{p},*a{p},*a{p},*a{p},*a{p}]\n", p = i - 1))
        .collect();
    let long_line = format!("format = 1\nx = \"{}\"", "й".repeat(10_000_000));
    let corners = "[1, 1], ".repeat(200_000);
    let cases = [
        (Format::Toml, deep("["), "map::syntax"),
        (Format::Toml, deep("{a = "), "map::syntax"),
        (Format::Toml, format!("{}.a = 1", vec!["a"; 100_000].join(".")), "map::syntax"),
        (Format::Toml, "[".repeat(1_000_000), "map::syntax"),
        (Format::Toml, long_line, "map::unknown_field"),
        (Format::Toml, format!("format = 1\n{} = 1", "k".repeat(5_000_000)), "map::unknown_field"),
        (Format::Toml, "x".repeat(65 << 20), "map::too_large"),
        (
            Format::Toml,
            format!("format = 1\n[orthoframe.a]\npoints = [{corners}]"),
            "map::out_of_range",
        ),
        (Format::Toml, "\u{feff}".to_owned(), "map::empty"),
        (Format::Yaml, format!("a0: &a0 [x]\n{bomb}"), "map::syntax"),
        (Format::Yaml, "[".repeat(1_000_000), "map::syntax"),
        (Format::Yaml, format!("x: {}", "- ".repeat(100_000)), "map::syntax"),
        (Format::Yaml, "a: &a [*a]".to_owned(), "map::syntax"),
        (Format::Json, "[".repeat(1_000_000), "map::syntax"),
        (Format::Json, "{\"a\":".repeat(100_000), "map::syntax"),
        (Format::Json, "7".to_owned(), "map::wrong_kind"),
    ];
    for (format, text, code) in cases {
        let start = text.chars().take(30).collect::<String>();
        let clock = std::time::Instant::now();
        let reading = read(&Source::new("harm", &text), format);
        let codes: Vec<_> =
            reading.faults.faults.iter().filter_map(|f| Some(f.code()?.to_string())).collect();
        assert!(codes.iter().any(|c| c == code), "{start}: {codes:?}");
        assert!(clock.elapsed().as_secs() < 20, "{start}: {:?}", clock.elapsed());
        // The report shows what is near the fault, not a line of megabytes.
        let shown = format!("{:?}", miette::Report::new(reading.faults));
        assert!(shown.len() < 100_000, "{start}: a report of {} bytes", shown.len());
    }
}
