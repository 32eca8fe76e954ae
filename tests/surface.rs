//! The surface of the library: what a program can name stands in `tests/golden/surface.txt`, so that a change of it is seen.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use expect_test::expect_file;

use crate::files::project;

fn read(path: &str) -> String {
    std::fs::read_to_string(project(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// The names that `pub use …;` gives, as they are called from outside.
fn used(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for piece in text.split("\npub use ").skip(1) {
        let list = piece.split(';').next().unwrap();
        let names = list.split_once('{').map_or_else(
            || list.rsplit("::").next().unwrap().to_owned(),
            |(_, names)| names.replace('}', ""),
        );
        for name in names.split(',').map(str::trim).filter(|name| !name.is_empty()) {
            let outside = name.split(" as ").last().unwrap();
            found.insert(outside.to_owned());
        }
    }
    found
}

/// Public functions, each with the type that it belongs to.
fn functions(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut of = String::new();
    for line in text.lines() {
        if let Some(head) = line.strip_prefix("impl") {
            let of_type = head.split(" for ").last().unwrap().trim_start_matches(|c| c != ' ');
            of = of_type.trim().split(['<', ' ', '{']).next().unwrap().to_owned();
        } else if line == "}" {
            of.clear();
        }
        let Some(name) = line.trim_start().strip_prefix("pub fn ") else { continue };
        let name = name.split(['(', '<']).next().unwrap();
        found.insert(if of.is_empty() { name.to_owned() } else { format!("{of}::{name}") });
    }
    found
}

fn sources(dir: &str) -> Vec<String> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(project(dir)).unwrap() {
        let path = format!("{dir}/{}", entry.unwrap().file_name().to_string_lossy());
        if path.ends_with(".rs") {
            found.push(path);
        } else if project(&path).is_dir() {
            found.extend(sources(&path));
        }
    }
    found.sort();
    found
}

#[test]
fn the_surface_is_the_one_that_was_agreed_on() {
    let (root, engine) = (read("src/lib.rs"), read("src/engine/mod.rs"));
    // No folder as a whole: each name that is public is one that somebody meant to be.
    let modules: Vec<&str> = root.lines().filter(|line| line.starts_with("pub mod ")).collect();
    assert_eq!(modules, ["pub mod cli;", "pub mod engine;", "pub mod serve;", "pub mod vehicle {"]);
    assert!(!root.contains("pub use orthoframe_") || !root.contains("::*"), "no globs");
    let open = engine.lines().filter(|line| line.starts_with("pub mod "));
    assert_eq!(open.collect::<Vec<_>>(), ["pub mod json;"]);
    let (at_root, of_engine) = (used(&root), used(&engine));
    let inside = root.split("\npub mod vehicle {").nth(1).unwrap();
    let inside = inside.split("\n}").next().unwrap();
    let of_vehicle = used(&inside.replace("\n    ", "\n"));
    let names: BTreeSet<&String> = at_root.union(&of_engine).chain(&of_vehicle).collect();
    assert!(names.len() <= 170, "{} names", names.len());
    let mut told = format!("orthoframe: {} names\n", at_root.len());
    at_root.iter().for_each(|name| writeln!(told, "  {name}").unwrap());
    writeln!(told, "orthoframe::engine: {} names", of_engine.len()).unwrap();
    of_engine.iter().for_each(|name| writeln!(told, "  {name}").unwrap());
    writeln!(told, "orthoframe::vehicle: {} names", of_vehicle.len()).unwrap();
    of_vehicle.iter().for_each(|name| writeln!(told, "  {name}").unwrap());
    let mut methods = BTreeSet::new();
    for path in sources("src/engine") {
        let text = read(&path);
        for function in functions(&text) {
            let owner = function.split("::").next().unwrap().to_owned();
            let is_json = path.contains("/json/") && !function.contains("::");
            if is_json {
                methods.insert(format!("json::{function}"));
            } else if function.contains("::") && (names.contains(&owner)) {
                methods.insert(function);
            }
        }
    }
    writeln!(told, "functions: {}", methods.len()).unwrap();
    methods.iter().for_each(|name| writeln!(told, "  {name}").unwrap());
    expect_file![project("tests/golden/surface.txt")].assert_eq(&told);
}

/// Enums that are errors by their use and derive no `Error`. Others of the kind (`Refusal`, `Barrier`, `WhyNot`) stay closed:
/// other crates tell each of their cases, and one that is told nowhere is not to compile.
const REASONS: [(&str, &str); 3] = [
    ("src/units/file.rs", "FileFault"),
    ("src/language/question/doubt.rs", "Doubt"),
    ("src/meaning/outcome.rs", "NoAnswer"),
];

/// Errors grow: who matches on them has a last arm.
#[test]
fn error_enums_may_grow() {
    for path in sources("src") {
        let text = read(&path);
        let mut derives = false;
        let mut grows = false;
        for line in text.lines() {
            if line.starts_with("#[derive(") {
                derives = line.split(['(', ',', ' ', ')']).any(|word| word == "Error");
                grows = false;
            }
            grows |= line == "#[non_exhaustive]";
            if line.starts_with("pub enum ") && derives {
                assert!(grows, "{path}: {line}");
            }
            if line.starts_with("pub enum ") || line.starts_with("pub struct ") {
                derives = false;
            }
        }
    }
    for (path, name) in REASONS {
        let head = format!("\n#[non_exhaustive]\npub enum {name} {{\n");
        assert!(read(path).contains(&head), "{path}: {name}");
    }
}
