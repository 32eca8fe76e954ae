//! Lengths are told in the unit of the run: no text fixes one of its own.

use std::path::{Path, PathBuf};

use super::Place;

/// What says how a number is to be written, in a file or an argument, or how an interface means its numbers, names the unit
/// of that; so does what is written into a map: neither is other for who reads in metres.
const MEANT: [(&str, &str); 9] = [
    ("exchange/ifc/building.rs", "{x}, {y}, {z} см"),
    ("map/check/doors.rs", "from 0 to 50 cm"),
    ("vectors/scan/sensor.rs", "100 000 см"),
    ("vectors/scan/sensor.rs", "больше 0 см"),
    ("vectors/read/english.rs", "100 000 cm"),
    ("vectors/read/english.rs", "above 0 cm"),
    ("cli/args.rs", "from 0.5 to 100 cm"),
    ("cli/args.rs", "from 0 to 10000 cm"),
    ("cli/map_from.rs", "from 1 to 100 cm"),
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !["tests", "examples", "judges"].contains(&name.as_str()) {
            sources(&path, found);
        } else if name.ends_with(".rs") && name != "tests.rs" {
            found.push(path);
        }
    }
}

/// Whether a line of a program's text has a number, or the place of one, with a unit behind it that is always the same.
fn fixes_a_unit(line: &str) -> bool {
    let is_text = !line.trim_start().starts_with("//") && line.contains('"');
    let fixed = |unit: &str| {
        line.match_indices(unit).any(|(at, _)| {
            let before = line[..at].strip_suffix([' ', '\u{a0}']).and_then(|l| l.chars().last());
            let after = line[at + unit.len()..].chars().next();
            before.is_some_and(|c| c == '}' || c.is_ascii_digit())
                && after.is_none_or(|c| !c.is_alphabetic() && c != '_')
        })
    };
    is_text && (fixed("см") || fixed("cm"))
}

#[test]
fn no_text_tells_a_length_in_a_unit_of_its_own() {
    assert!(fixes_a_unit(r#"    "a wall of {width} cm","#) && fixes_a_unit(r#"("уже 20 см²")"#));
    assert!(!fixes_a_unit(r#"("{width}", cm)"#) && !fixes_a_unit("/// At least 20 cm, \"so\"."));
    let mut files = Vec::new();
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    sources(&src, &mut files);
    let mut fixed = Vec::new();
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let name = file.strip_prefix(&src).unwrap().to_string_lossy().into_owned();
        let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let lines = text.lines().filter(|line| fixes_a_unit(line));
        let is_meant =
            |line: &str| MEANT.iter().any(|(at, what)| name == *at && line.contains(what));
        fixed.extend(lines.filter(|l| !is_meant(l)).map(|l| format!("{name}: {}", l.trim())));
    }
    assert!(fixed.is_empty(), "{fixed:#?}");
}

/// Faults of a map, one of each that carries a length, told in either unit.
#[test]
fn faults_of_a_map_are_told_in_the_unit_of_the_run() {
    let place = Place::with_rb2();
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/map");
    let (mut told, mut files) = (0, 0);
    for case in std::fs::read_dir(golden).unwrap().map(|entry| entry.unwrap().path()) {
        for map in std::fs::read_dir(&case).unwrap().map(|entry| entry.unwrap().path()) {
            if map.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            files += 1;
            let map = map.to_string_lossy().into_owned();
            for (lang, unit) in [("ru", "см"), ("en", "cm")] {
                let run = |unit| {
                    let run = place.run(&["--units", unit, "--lang", lang, "check", &map]);
                    // The lines of the file that are shown are as they are written.
                    let is_shown = |line: &&str| line.contains('│') || line.contains('·');
                    let lines = [run.out.as_str(), run.err.as_str()].join("\n");
                    lines.lines().filter(|l| !is_shown(l)).collect::<Vec<_>>().join("\n")
                };
                let with = |text: &str, unit: &str| {
                    // What is quoted is as the file has it, too.
                    let told = text.split(['«', '“']).map(|t| t.rsplit(['»', '”']).next());
                    let told: String = told.flatten().collect();
                    let parts = told.split(|c: char| !c.is_alphanumeric());
                    let words: Vec<&str> = parts.collect();
                    words.windows(2).filter(|w| w[1] == unit && w[0].parse::<u64>().is_ok()).count()
                };
                let (metres, centimetres) = (run("m"), run("cm"));
                assert_eq!(with(&metres, unit), meant(&centimetres), "{map}:\n{metres}");
                told += with(&centimetres, unit);
            }
        }
    }
    assert!(files > 5 && told > 20, "{told} lengths in {files} files");
}

/// How often a text names the unit of a number as it is to be written.
fn meant(text: &str) -> usize {
    text.matches("от 0 до 50 см").count() + text.matches("from 0 to 50 cm").count()
}
