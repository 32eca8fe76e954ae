//! Soufflé's own evaluation tests, in `../shared/data/souffle`: each program over its facts, each expected relation
//! row by row in any order, and what is printed.
//!
//! A test comes out the same, is refused (a fault that names what is not done here, or a limit), or differs. Those
//! that may be refused or differ are listed with their reason; nothing else may, and what is listed must.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use orthoframe_facts::{FilesError, Limits, run_files};

/// Tests that need not come out the same, each with the reason.
const EXCEPTIONS: &[(&str, &str)] = &[];

#[derive(Debug, PartialEq)]
enum Outcome {
    Same,
    Refused(String),
    Differs(String),
}

#[test]
fn the_suite_comes_out_the_same() {
    let Some(folder) = suite() else { return };
    let mut outcomes: BTreeMap<String, Outcome> = BTreeMap::new();
    for entry in std::fs::read_dir(&folder).expect("the suite is readable") {
        let case = entry.expect("the suite is readable").path();
        let name = case.file_name().expect("a test has a name").to_string_lossy().into_owned();
        if case.join(format!("{name}.dl")).exists() {
            outcomes.insert(name.clone(), outcome(&case, &name));
        }
    }
    let mut table = String::new();
    let mut counts = [0_usize; 3];
    for (name, outcome) in &outcomes {
        let (n, word, told) = match outcome {
            Outcome::Same => (0, "same", ""),
            Outcome::Refused(told) => (1, "refused", told.as_str()),
            Outcome::Differs(told) => (2, "differs", told.as_str()),
        };
        counts[n] += 1;
        if n > 0 {
            let _ = writeln!(table, "{name:<28} {word:<8} {told}");
        }
    }
    let [same, refused, differs] = counts;
    let _ = writeln!(
        std::io::stdout(),
        "{table}same {same}, refused {refused}, differs {differs}, of {}",
        outcomes.len()
    );
    let odd: Vec<&String> = outcomes
        .iter()
        .filter(|(name, outcome)| {
            let is_listed = EXCEPTIONS.iter().any(|(known, _)| known == name);
            (**outcome == Outcome::Same) == is_listed
        })
        .map(|(name, _)| name)
        .collect();
    assert!(odd.is_empty(), "not as listed: {odd:?}\n{table}");
}

/// Where the suite lies: `SOUFFLE_SUITE`, or the data of others beside the project.
fn suite() -> Option<PathBuf> {
    if let Some(given) = std::env::var_os("SOUFFLE_SUITE") {
        return Some(given.into());
    }
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/souffle/evaluation");
    if path.exists() {
        return Some(path);
    }
    assert!(std::env::var_os("CI").is_none(), "{} is missing", path.display());
    None
}

fn outcome(case: &Path, name: &str) -> Outcome {
    let out = tempfile::tempdir().expect("a folder for the results");
    let facts = case.join("facts");
    let facts = if facts.exists() { facts } else { case.to_owned() };
    let limits =
        Limits { time: Duration::from_secs(240), memory_bytes: 1 << 30, ..Limits::default() };
    let report = match run_files(&case.join(format!("{name}.dl")), &facts, out.path(), limits) {
        Ok(report) => report,
        Err(FilesError::Program(faults)) => {
            let first = faults.files.iter().flat_map(|file| file.placed()).next();
            let told = first.map(|(line, _, fault)| format!("{line}: {fault}"));
            return Outcome::Refused(told.unwrap_or_default());
        }
        Err(other) => return Outcome::Refused(other.to_string()),
    };
    for entry in std::fs::read_dir(case).expect("the test is readable") {
        let expected = entry.expect("the test is readable").path();
        if expected.extension().is_none_or(|extension| extension != "csv") {
            continue;
        }
        let file = expected.file_name().expect("a file has a name").to_owned();
        let (wanted, found) = (lines(&expected), lines(&out.path().join(&file)));
        if wanted != found {
            let missing: Vec<_> =
                wanted.iter().filter(|line| !found.contains(line)).take(3).collect();
            let more: Vec<_> = found.iter().filter(|line| !wanted.contains(line)).take(3).collect();
            let file = file.to_string_lossy();
            return Outcome::Differs(format!("{file}: missing {missing:?}, too many {more:?}"));
        }
    }
    let mut printed = report.printed.clone();
    for (relation, size) in &report.sizes {
        let _ = writeln!(printed, "{relation}\t{size}");
    }
    let mut wanted = lines(&case.join(format!("{name}.out")));
    let mut found: Vec<String> = printed.lines().map(|line| line.trim_end().to_owned()).collect();
    found.sort();
    wanted.retain(|line| !line.is_empty());
    found.retain(|line| !line.is_empty());
    if wanted != found {
        return Outcome::Differs(format!("printed {found:?}, wanted {wanted:?}"));
    }
    Outcome::Same
}

/// The lines of a file in order of the alphabet; none where it is not there.
fn lines(path: &Path) -> Vec<String> {
    let text = std::fs::read(path).unwrap_or_default();
    let text = String::from_utf8_lossy(&text).into_owned();
    let mut lines: Vec<String> = text.lines().map(|line| line.trim_end().to_owned()).collect();
    lines.sort();
    lines
}
