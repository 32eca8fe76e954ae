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

/// The names that are declared here and public.
fn declared(text: &str) -> impl Iterator<Item = String> {
    let kinds = ["fn ", "struct ", "enum ", "trait ", "type ", "const ", "static "];
    let declared = text.lines().filter_map(|line| line.strip_prefix("pub "));
    let names = declared.filter_map(move |line| kinds.iter().find_map(|k| line.strip_prefix(k)));
    names.map(|name| name.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap().into())
}

/// Public functions, each with the type that it belongs to and what it takes.
fn functions(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut of = String::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(head) = line.strip_prefix("impl") {
            let of_type = head.split(" for ").last().unwrap().trim_start_matches(|c| c != ' ');
            of = of_type.trim().split(['<', ' ', '{']).next().unwrap().to_owned();
        } else if line == "}" {
            of.clear();
        }
        let Some(head) = line.trim_start().strip_prefix("pub fn ") else { continue };
        let (name, takes) = head.split_once(['(', '<']).unwrap();
        let mut takes = takes.to_owned();
        while !takes.ends_with('{') {
            takes += lines.next().unwrap();
        }
        let takes = takes.split("->").next().unwrap().to_owned();
        found.push((if of.is_empty() { name.to_owned() } else { format!("{of}::{name}") }, takes));
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

/// What is public: at the root, in the engine and of vehicles.
fn named() -> [BTreeSet<String>; 3] {
    let (root, engine) = (read("src/lib.rs"), read("src/engine/mod.rs"));
    let mut of_engine = used(&engine);
    of_engine.extend(declared(&engine));
    let inside = root.split("\npub mod vehicle {").nth(1).unwrap();
    let inside = inside.split("\n}").next().unwrap();
    [used(&root), of_engine, used(&inside.replace("\n    ", "\n"))]
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
    let [at_root, of_engine, of_vehicle] = named();
    let names: BTreeSet<&String> = at_root.union(&of_engine).chain(&of_vehicle).collect();
    // Who is asked and what answers, with all that a function takes; places, ids and the nouns of the map that answers
    // speak of; and what a vehicle of one's own is told and tells. What only stands within an answer has no name here.
    assert!(names.len() <= 110, "{} names", names.len());
    let mut told = format!("distinct names: {}\n", names.len());
    for (module, names) in [
        ("orthoframe", &at_root),
        ("orthoframe::engine", &of_engine),
        ("orthoframe::vehicle", &of_vehicle),
    ] {
        writeln!(told, "{module}: {} names", names.len()).unwrap();
        names.iter().for_each(|name| writeln!(told, "  {name}").unwrap());
    }
    let methods: BTreeSet<String> =
        public_functions(&names).into_iter().map(|(name, _)| name).collect();
    writeln!(told, "functions: {}", methods.len()).unwrap();
    methods.iter().for_each(|name| writeln!(told, "  {name}").unwrap());
    expect_file![project("tests/golden/surface.txt")].assert_eq(&told);
}

/// The functions of the types of these names and those of the JSON, each with what it takes.
fn public_functions(names: &BTreeSet<&String>) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for path in sources("src/engine") {
        for (function, takes) in functions(&read(&path)) {
            let owner = function.split("::").next().unwrap().to_owned();
            let is_json = path.contains("/json/") && !function.contains("::");
            if is_json {
                found.push((format!("json::{function}"), takes));
            } else if function.contains("::") && names.contains(&owner) {
                found.push((function, takes));
            }
        }
    }
    found
}

/// What a program has of the library itself when it gives it back, and need not name: of `understand`, `queue`,
/// `differences`, of what changed the map, of an answer, a plan, a task under way. `Tell` stands for a closure.
const HANDED_OUT: [&str; 9] = [
    "Command",
    "Differing",
    "Fact",
    "ImportReport",
    "Planned",
    "Queue",
    "QueuedTask",
    "Solved",
    "Tell",
];

/// Who calls a function can name what it takes.
#[test]
fn what_is_taken_can_be_named() {
    let all = named();
    let names: BTreeSet<&String> = all.iter().flatten().collect();
    let of_std = [
        "Arc",
        "Box",
        "Diagnostic",
        "FnMut",
        "FnOnce",
        "Option",
        "Path",
        "PathBuf",
        "Result",
        "Self",
        "Send",
        "Some",
        "String",
        "Vec",
    ];
    let mut nameless = BTreeSet::new();
    for (function, takes) in public_functions(&names) {
        for word in takes.split(|c: char| !c.is_alphanumeric() && c != '_') {
            let is_type = word.starts_with(char::is_uppercase);
            if is_type
                && !names.contains(&word.to_owned())
                && ![&of_std[..], &HANDED_OUT].concat().contains(&word)
            {
                nameless.insert(format!("{function}: {word}"));
            }
        }
    }
    assert!(nameless.is_empty(), "{nameless:#?}");
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
