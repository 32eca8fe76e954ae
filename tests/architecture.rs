//! Holds the drawing of ARCHITECTURE.md true: which folder may use which, and who alone may name what.
//!
//! The table under «Folders» in ARCHITECTURE.md is the law; this test reads it, the manifests of the folders and the
//! sources, so that none can drift from the others.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::files::project;

type Arrows = BTreeMap<String, BTreeSet<String>>;

/// Rows `| `folder` | what it says | `may`, `use` |` of the table under the heading «Folders».
fn allowed_arrows() -> Arrows {
    let text = fs::read_to_string(project("ARCHITECTURE.md"))
        .expect("ARCHITECTURE.md is part of the crate");
    let table = text.split("\n## Folders").nth(1).expect("ARCHITECTURE.md has a section «Folders»");
    let ticked = |cell: &str| -> BTreeSet<String> {
        cell.split('`')
            .skip(1)
            .step_by(2)
            .map(|word| word.trim_end_matches(".rs").to_owned())
            .collect()
    };
    table
        .split("\n## ")
        .next()
        .expect("split yields at least one piece")
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').collect();
            let folder = ticked(cells[0]).pop_first().expect("a row names its folder");
            (folder, ticked(cells.last().expect("a row has cells")))
        })
        .collect()
}

/// Every source file with the folder (or top-level file) that it belongs to.
fn sources() -> Vec<(String, PathBuf, String)> {
    sources_in("src")
}

fn sources_in(root: &str) -> Vec<(String, PathBuf, String)> {
    let src = project(root);
    let mut found = Vec::new();
    let mut open = vec![src.clone()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("src is readable") {
            let path = entry.expect("src is readable").path();
            if path.is_dir() {
                // What only tests and examples run may print, and use what it likes.
                if !["tests", "examples", "judges"].iter().any(|name| path.ends_with(name)) {
                    open.push(path);
                }
            } else if path.extension().is_some_and(|e| e == "rs") {
                let relative = path.strip_prefix(&src).expect("found under src");
                let first = relative.components().next().expect("a file has a name").as_os_str();
                let folder = Path::new(first).with_extension("").to_string_lossy().into_owned();
                let text = fs::read_to_string(&path).expect("a source is UTF-8");
                found.push((folder, relative.to_path_buf(), text));
            }
        }
    }
    found.sort();
    found
}

/// The source without comments, doc tests and the tests at its foot.
fn code(text: &str) -> String {
    let body = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    body.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// Top-level modules that a source names: `crate::map::…`, `crate::{geometry, map::World}`, `orthoframe::…`.
fn named_modules(code: &str) -> BTreeSet<String> {
    let mut named = BTreeSet::new();
    for root in ["crate::", "orthoframe::"] {
        for (at, _) in code.match_indices(root) {
            let rest = &code[at + root.len()..];
            if let Some(group) = rest.strip_prefix('{') {
                named.extend(heads_of_group(group));
            } else {
                named.insert(head(rest));
            }
        }
    }
    named.into_iter().filter(|m| m.chars().next().is_some_and(char::is_lowercase)).collect()
}

fn head(path: &str) -> String {
    path.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

/// First words of the members of `a::b, c::{d, e}, f}`.
fn heads_of_group(group: &str) -> Vec<String> {
    let (mut depth, mut member, mut heads) = (0_i32, String::new(), Vec::new());
    for c in group.chars() {
        match c {
            '}' if depth == 0 => break,
            ',' if depth == 0 => heads.push(head(std::mem::take(&mut member).trim())),
            _ => {
                depth += i32::from(c == '{') - i32::from(c == '}');
                member.push(c);
            }
        }
    }
    heads.push(head(member.trim()));
    heads.retain(|h| !h.is_empty());
    heads
}

#[test]
fn arrows_run_only_as_drawn() {
    let allowed = allowed_arrows();
    let mut wrong = Vec::new();
    for (folder, path, text) in sources() {
        if ["lib", "main"].contains(&folder.as_str()) {
            continue;
        }
        let Some(may_use) = allowed.get(&folder) else {
            wrong.push(format!("{}: folder `{folder}` is not in ARCHITECTURE.md", path.display()));
            continue;
        };
        for module in named_modules(&code(&text)) {
            if module != folder && allowed.contains_key(&module) && !may_use.contains(&module) {
                wrong.push(format!("{}: `{folder}` uses `{module}`", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "arrows that ARCHITECTURE.md does not draw:\n{}", wrong.join("\n"));
}

/// The folders that a folder's manifest lets it use, tests included, beside its own; none for a folder of the root package.
fn arrows_of_manifest(folder: &str) -> Option<BTreeSet<String>> {
    let text = fs::read_to_string(project("src").join(folder).join("Cargo.toml")).ok()?;
    let named = text.lines().filter_map(|line| line.strip_prefix("orthoframe-"));
    Some(named.map(head).filter(|name| name != folder).collect())
}

#[test]
fn manifests_name_what_is_drawn_and_no_more() {
    let allowed = allowed_arrows();
    let mut wrong = Vec::new();
    for (folder, may_use) in &allowed {
        let Some(named) = arrows_of_manifest(folder) else { continue };
        if named != *may_use {
            wrong.push(format!("{folder}: the manifest names {named:?}, drawn is {may_use:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is made for other languages stands on the facade, as any program does: it names no folder.
#[test]
fn bindings_use_the_facade_alone() {
    let text = fs::read_to_string(project("bindings/python/Cargo.toml")).expect("it has one");
    let named: Vec<&str> = text.lines().filter(|line| line.starts_with("orthoframe")).collect();
    assert_eq!(named, ["orthoframe = { path = \"../..\" }"]);
}

#[test]
fn the_drawing_has_no_cycle_and_no_ghost() {
    let allowed = allowed_arrows();
    let folders: BTreeSet<String> = sources().into_iter().map(|(folder, _, _)| folder).collect();
    let drawn: BTreeSet<String> = allowed.keys().cloned().collect();
    assert_eq!(
        &drawn - &folders,
        BTreeSet::new(),
        "ARCHITECTURE.md draws folders that are not there"
    );

    let mut remaining = allowed;
    while !remaining.is_empty() {
        let ground: Vec<String> = remaining
            .iter()
            .filter(|(_, uses)| uses.iter().all(|u| !remaining.contains_key(u)))
            .map(|(folder, _)| folder.clone())
            .collect();
        assert!(!ground.is_empty(), "arrows in a ring: {:?}", remaining.keys());
        for folder in ground {
            remaining.remove(&folder);
        }
    }
}

#[test]
fn each_package_has_its_own_folder() {
    // Package, and the folders that may name it.
    let owners: &[(&str, &[&str])] = &[
        ("sled", &["store"]),
        ("datafrog", &["facts"]),
        ("clap", &["cli", "main"]),
        ("serde_json", &["cli", "engine", "exchange", "recording", "robot", "serve"]),
        ("axum", &["serve"]),
        ("hyper", &["serve"]),
        ("subtle", &["serve"]),
        ("tokio", &["serve"]),
        ("encoding_rs", &["exchange"]),
        ("rusqlite", &["exchange"]),
        ("png", &["exchange", "vectors"]),
        ("roxmltree", &["exchange", "draw"]),
        ("i_overlay", &["geometry", "map", "corridor", "exchange"]),
        ("resvg", &["draw"]),
        ("ttf_parser", &["draw"]),
    ];
    let mut wrong = Vec::new();
    for (folder, path, text) in sources() {
        let code = code(&text);
        for &(package, may) in owners {
            if code.contains(&format!("{package}::")) && !may.contains(&folder.as_str()) {
                wrong.push(format!("{} names {package}", path.display()));
            }
        }
        // A build script speaks to cargo by its output.
        if !["cli", "web", "main"].contains(&folder.as_str())
            && !path.ends_with("build.rs")
            && ["println!(", "print!(", "eprintln!(", "eprint!("].iter().any(|m| code.contains(m))
        {
            wrong.push(format!("{} prints", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Files of the faces that make JSON which is no result of the engine: what a protocol, or the server's own keeping, has
/// of its own.
const OWN_JSON: [(&str, &str); 8] = [
    ("cli/language_server.rs", "the language server's protocol"),
    ("serve/assist/approval.rs", "the form in which an assistant's user is asked"),
    ("serve/assist/calls.rs", "the log of the assistants' calls"),
    ("serve/assist/tools.rs", "the schemas of the tools"),
    ("serve/centre.rs", "who holds a store, told to what carries a map to it"),
    ("serve/events.rs", "the frame of an event"),
    ("serve/fault.rs", "the body of a refusal"),
    ("serve/gate.rs", "sessions, kept over a restart"),
];

/// What makes JSON: the macro, a type's own shape, a field put into a value. What is built of a `serde_json::Map` by hand
/// goes unseen here.
fn makes_json(code: &str) -> bool {
    code.contains("json!") || code.contains("Serialize") || code.contains("\"] = ")
}

/// The shape of a result stands in `engine/json` alone: whatever a program reads is the same by every face.
#[test]
fn the_shape_of_a_result_stands_in_one_place() {
    let makers: BTreeSet<String> = sources()
        .into_iter()
        .filter(|(folder, _, text)| {
            ["cli", "serve"].contains(&folder.as_str()) && makes_json(&code(text))
        })
        .map(|(_, path, _)| path.to_string_lossy().replace('\\', "/"))
        .collect();
    let known = OWN_JSON.iter().map(|(path, _)| (*path).to_owned()).collect();
    assert_eq!(makers, known, "left: files of the faces that make JSON");
    for shape in ["json!({ \"a\": 1 })", "#[derive(Serialize)]", "view[\"a\"] = one.into();"] {
        assert!(makes_json(shape), "{shape}");
    }
    assert!(!makes_json("#[derive(Deserialize)]\nlet is = view[\"a\"] == 1;"));
}

#[test]
fn the_reader_of_sources_sees_what_it_should() {
    let code =
        "use crate::{facts, map::{World, Door}, units::Cm};\nfn f() { crate::geometry::nothing() }";
    let named: Vec<String> = named_modules(code).into_iter().collect();
    assert_eq!(named, ["facts", "geometry", "map", "units"]);
}

/// A file as a module: the names on the way to it from its folder's root.
type Module = Vec<String>;

/// Modules of a folder with their code.
fn modules_of(folder: &str, all: &[(String, PathBuf, String)]) -> BTreeMap<Module, String> {
    let own = all.iter().filter(|(of, path, _)| of == folder && path.components().count() > 1);
    let module = |path: &Path| -> Module {
        let names = path.with_extension("");
        let names = names.components().skip(1).map(|c| c.as_os_str().to_string_lossy());
        names.map(|name| name.into_owned()).filter(|name| name != "mod").collect()
    };
    own.map(|(_, path, text)| (module(path), code(text))).collect()
}

/// The paths of a `use` of one or several things: `a::{b, c::d}` names `a::b` and `a::c::d`.
fn spread(tree: &str) -> Vec<Module> {
    let (mut paths, mut prefixes, mut at) = (Vec::new(), Vec::<Module>::new(), Module::new());
    let mut word = String::new();
    let take = |word: &mut String, at: &mut Module| {
        // `x as y` is x.
        let name = word.split_whitespace().next().unwrap_or_default().to_owned();
        word.clear();
        if !name.is_empty() {
            at.push(name);
        }
    };
    for c in tree.chars() {
        match c {
            ':' => take(&mut word, &mut at),
            '{' => prefixes.push(at.clone()),
            ',' | '}' => {
                let named = !word.trim().is_empty();
                take(&mut word, &mut at);
                if named {
                    paths.push(at.clone());
                }
                if c == '}' {
                    prefixes.pop();
                }
                at = prefixes.last().cloned().unwrap_or_default();
            }
            _ => word.push(c),
        }
    }
    let named = !word.trim().is_empty();
    take(&mut word, &mut at);
    if named {
        paths.push(at);
    }
    paths
}

/// Every path that the code of a module names, and whether it hands it on.
fn paths_of(code: &str) -> Vec<(bool, Module)> {
    let mut paths = Vec::new();
    let mut rest = String::new();
    for statement in code.split_inclusive(';') {
        let start = statement.find("use ").filter(|at| {
            let before = statement[..*at].rsplit('\n').next().unwrap_or_default().trim();
            before.is_empty() || before.starts_with("pub")
        });
        match start {
            Some(at) => {
                let is_public =
                    statement[..at].rsplit('\n').next().unwrap_or_default().contains("pub");
                let tree = statement[at + 4..].trim_end_matches(';');
                paths.extend(spread(tree).into_iter().map(|path| (is_public, path)));
                rest.push_str(&statement[..at]);
            }
            None => rest.push_str(statement),
        }
    }
    for root in ["crate::", "super::", "self::"] {
        for (at, _) in rest.match_indices(root) {
            let whole: String = rest[at..]
                .chars()
                .take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':')
                .collect();
            paths.push((false, spread(&whole).pop().unwrap_or_default()));
        }
    }
    paths
}

/// The circles of the files of a folder: files of which each names, by way of others or not, what another of them holds.
/// That a file names its parent is no arrow: that is the frame in which it stands. Nor is the call of a method that a type
/// has in another file.
fn circles(folder: &str, all: &[(String, PathBuf, String)]) -> Vec<BTreeSet<String>> {
    let modules = modules_of(folder, all);
    let is_crate = project("src").join(folder).join("Cargo.toml").exists();
    // The module to which a path leads, with what is named in it.
    let lead = |from: &Module, path: &Module| -> Option<(Module, Option<String>)> {
        let mut names = path.iter().peekable();
        let mut at = match names.next()?.as_str() {
            "crate" if is_crate => Module::new(),
            "crate" => (names.next()? == folder).then(Module::new)?,
            "self" => from.clone(),
            "super" => {
                let mut at = from.clone();
                at.pop();
                while names.next_if(|name| *name == "super").is_some() {
                    at.pop();
                }
                at
            }
            child => {
                let mut at = from.clone();
                at.push(child.to_owned());
                modules.contains_key(&at).then_some(at)?
            }
        };
        let mut named = None;
        for name in names {
            let mut deeper = at.clone();
            deeper.push(name.clone());
            if named.is_none() && modules.contains_key(&deeper) {
                at = deeper;
            } else {
                named.get_or_insert(name.clone());
            }
        }
        Some((at, named))
    };
    let named: BTreeMap<&Module, Vec<(bool, Module)>> =
        modules.iter().map(|(module, code)| (module, paths_of(code))).collect();
    let mut handed_on: BTreeMap<(Module, String), Module> = BTreeMap::new();
    for (module, paths) in &named {
        for (_, path) in paths.iter().filter(|(is_public, _)| *is_public) {
            if let Some((to, Some(name))) = lead(module, path).filter(|(to, _)| to != *module) {
                handed_on.insert(((*module).clone(), name), to);
            }
        }
    }
    let mut arrows: BTreeMap<&Module, BTreeSet<Module>> = BTreeMap::new();
    for (module, paths) in &named {
        for (_, path) in paths {
            let Some((mut to, name)) = lead(module, path) else { continue };
            let mut seen = BTreeSet::new();
            while let Some(name) = &name
                && seen.insert(to.clone())
                && let Some(further) = handed_on.get(&(to.clone(), name.clone()))
            {
                to = further.clone();
            }
            if !module.starts_with(&to) && modules.contains_key(&to) {
                arrows.entry(module).or_default().insert(to);
            }
        }
    }
    // A file hands on what stands below it without needing it.
    let reach = |from: &Module| -> BTreeSet<Module> {
        let mut found = BTreeSet::new();
        let mut open: Vec<Module> = arrows.get(from).into_iter().flatten().cloned().collect();
        while let Some(at) = open.pop() {
            if found.insert(at.clone()) {
                open.extend(arrows.get(&at).into_iter().flatten().cloned());
            }
        }
        found
    };
    let reached: BTreeMap<&Module, BTreeSet<Module>> =
        modules.keys().map(|module| (module, reach(module))).collect();
    let mut circles = BTreeSet::new();
    for (module, reaches) in &reached {
        let mut circle: BTreeSet<String> = reaches
            .iter()
            .filter(|other| reached.get(other).is_some_and(|back| back.contains(*module)))
            .map(|module| module.join("/"))
            .collect();
        circle.insert(module.join("/"));
        if circle.len() > 1 {
            circles.insert(circle);
        }
    }
    circles.into_iter().collect()
}

/// The circles that there are, each with its folder: what a moved type would end is ended, and each that is left is one
/// recursive subject. There may only become fewer.
const CIRCLES: [(&str, &[&str]); 4] = [
    // A call of a recursive relation is answered by magic sets, whose rules call what lies below.
    ("facts", &["demand", "magic"]),
    // Premises hold expressions, and an aggregate among expressions holds premises.
    ("facts", &["expression", "parse"]),
    // A graph begins with what was learned by planning before, and that is the graph of that planning.
    ("graphplan", &["proof/graph", "proof/replan"]),
    // Preferences are met by planning for one plain goal after another, and a goal may have preferences.
    ("robot", &["solve", "wishes"]),
];

#[test]
fn no_file_enters_a_circle() {
    let all = sources();
    let folders: BTreeSet<String> = all.iter().map(|(folder, ..)| folder.clone()).collect();
    let of = |folder: String| {
        let own = circles(&folder, &all).into_iter();
        own.map(move |circle| (folder.clone(), circle)).collect::<Vec<_>>()
    };
    let found: BTreeSet<(String, BTreeSet<String>)> = folders.into_iter().flat_map(of).collect();
    let known = CIRCLES.map(|(folder, files)| {
        (folder.to_owned(), files.iter().map(|file| (*file).to_owned()).collect())
    });
    assert_eq!(found, BTreeSet::from(known));
}

#[test]
fn the_finder_of_circles_finds_one() {
    let file = |name: &str, code: &str| {
        ("graphplan".to_owned(), PathBuf::from(format!("graphplan/{name}.rs")), code.to_owned())
    };
    let circle = [
        file("mod", "mod a;\nmod b;\nmod c;\npub use c::{Gamma, other as Delta};"),
        file("a", "use super::{b::Beta, c};\nfn f() { c::g() }"),
        file("b", "use crate::Gamma;\nuse crate::units::Cm;"),
        file("c", "fn g() { super::a::f() }"),
    ];
    let found: Vec<Vec<String>> =
        circles("graphplan", &circle).into_iter().map(|c| c.into_iter().collect()).collect();
    assert_eq!(found, [["a", "b", "c"]]);
    assert_eq!(circles("graphplan", &circle[..3]), Vec::<BTreeSet<String>>::new());
}

/// One word for one thing: a word of docs/GLOSSARY.md stands in one row, alone or among others; what follows it in brackets
/// makes no other word of it.
#[test]
fn a_word_of_the_glossary_means_one_thing() {
    let text = std::fs::read_to_string(project("docs/GLOSSARY.md")).unwrap();
    let mut known = BTreeSet::new();
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.split(" |").next());
    let words = rows
        .flat_map(|cell| cell.split([',', '/']))
        .map(|word| word.split('(').next().unwrap_or_default().trim().to_lowercase());
    let twice: Vec<String> = words.filter(|word| !known.insert(word.clone())).collect();
    assert!(twice.is_empty(), "in two rows: {twice:?}");
    assert!(known.len() > 150, "{} words", known.len());
}

/// What a person reads stands in message files (rules/messages): no source outside the grammar of the languages holds Russian
/// words but these, each for its reason, and none is added.
#[test]
fn what_is_told_stands_in_message_files() {
    const RUSSIAN: [(&str, &[&str]); 7] = [
        (
            "words that are read: of questions, orders, properties, lengths",
            &[
                "cli/lengths.rs",
                "draw/view/bodies.rs",
                "engine/task/understanding.rs",
                "engine/zones.rs",
                "fleet/ask.rs",
                "map/doorway.rs",
            ],
        ),
        (
            "notation of map, rule and corridor files, in either language",
            &[
                "cli/language_server.rs",
                "corridor/words.rs",
                "map/check/base.rs",
                "map/check/doubts/words.rs",
                "map/device.rs",
                "map/file/records.rs",
                "map/file/words.rs",
                "map/marks.rs",
                "map/types.rs",
                "strips/phrase.rs",
                "strips/replay.rs",
                "strips/rule_text/compound.rs",
                "strips/rule_text/heading.rs",
                "strips/rule_text/mod.rs",
                "strips/task.rs",
            ],
        ),
        (
            "names in facts: of predicates, relations, kinds, places and the robot",
            &[
                "engine/directive_words.rs",
                "engine/json/names.rs",
                "engine/memory.rs",
                "engine/plan.rs",
                "engine/query.rs",
                "engine/task.rs",
                "facts/clause.rs",
                "facts/subsume.rs",
                "facts/witness.rs",
                "geometry/passframe.rs",
                "robot/belief.rs",
                "robot/mission/names.rs",
                "semantics/asked/mod.rs",
                "semantics/asked/spot.rs",
                "semantics/feed.rs",
                "semantics/lifts.rs",
                "semantics/measured.rs",
                "semantics/openings.rs",
                "semantics/planning.rs",
                "semantics/predicate.rs",
                "semantics/relations/rules.rs",
                "strips/declare.rs",
            ],
        ),
        (
            "words of foreign files, and what stands for them in the map that is made",
            &[
                "exchange/assemble/build.rs",
                "exchange/assemble/doors.rs",
                "exchange/assemble/things.rs",
                "exchange/geojson/classify.rs",
                "exchange/geojson/doors.rs",
                "exchange/geojson/levels.rs",
                "exchange/geojson/mod.rs",
                "exchange/geojson/names.rs",
                "exchange/geojson/things.rs",
                "exchange/ifc/building.rs",
                "exchange/ifc/stairs.rs",
                "exchange/osmag.rs",
                "exchange/read.rs",
                "exchange/rmf/mod.rs",
                "exchange/ros/mod.rs",
                "exchange/scene/colour.rs",
                "exchange/scene/procthor.rs",
                "exchange/scene/pyrobosim/mod.rs",
                "exchange/scene/pyrobosim/record.rs",
                "exchange/scene/stock.rs",
                "exchange/scene/thor.rs",
                "exchange/scene/virtualhome.rs",
                "exchange/shafts.rs",
                "exchange/survey.rs",
                "exchange/synonyms.rs",
                "sensing/operative.rs",
            ],
        ),
        (
            "letters",
            &["exchange/assemble/names.rs", "exchange/input.rs", "strips/hint.rs", "units/name.rs"],
        ),
        ("a disk of tests", &["store/sim/mod.rs"]),
        (
            "what grammar files are told still",
            &["meaning/check.rs", "meaning/file.rs", "meaning/paraphrase.rs", "meaning/sense.rs"],
        ),
    ];
    let is_russian = |c: char| ('\u{400}'..='\u{4ff}').contains(&c);
    let fleet = sources_in("fleet/src").into_iter();
    let fleet =
        fleet.map(|(_, path, text)| ("fleet".to_owned(), Path::new("fleet").join(path), text));
    let all = sources().into_iter().chain(fleet);
    let mut found: Vec<String> = all
        .filter(|(folder, path, _)| folder != "language" && !path.ends_with("tests.rs"))
        .filter(|(_, _, text)| {
            let code = code(text);
            let mut words = code.lines().map(|line| line.split(" //").next().unwrap_or_default());
            words.any(|line| line.contains(is_russian))
        })
        .map(|(_, path, _)| path.display().to_string())
        .collect();
    found.sort();
    let mut known: Vec<&str> = RUSSIAN.iter().flat_map(|(_, files)| *files).copied().collect();
    known.sort_unstable();
    assert_eq!(found, known);
}
