//! Map files: every fault in its place, nothing lost on the way, and no text that does harm.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use expect_test::expect_file;
use miette::Diagnostic;
use orthoframe::map::{Format, Reading, read};
use orthoframe::units::Source;

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
