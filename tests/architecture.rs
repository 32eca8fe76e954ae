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
    let src = project("src");
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

/// The folders that a folder's manifest lets it use, tests included; none for a folder of the root package.
fn arrows_of_manifest(folder: &str) -> Option<BTreeSet<String>> {
    let text = fs::read_to_string(project("src").join(folder).join("Cargo.toml")).ok()?;
    let named = text.lines().filter_map(|line| line.strip_prefix("orthoframe-"));
    Some(named.map(head).collect())
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
        ("serde_json", &["cli", "engine", "exchange", "robot", "serve"]),
        ("axum", &["serve"]),
        ("hyper", &["serve"]),
        ("subtle", &["serve"]),
        ("tokio", &["serve"]),
        ("encoding_rs", &["exchange"]),
        ("rusqlite", &["exchange"]),
        ("png", &["exchange", "vectors"]),
        ("roxmltree", &["exchange"]),
        ("i_overlay", &["geometry", "map", "corridor", "exchange"]),
        ("resvg", &["draw"]),
    ];
    let mut wrong = Vec::new();
    for (folder, path, text) in sources() {
        let code = code(&text);
        for &(package, may) in owners {
            if code.contains(&format!("{package}::")) && !may.contains(&folder.as_str()) {
                wrong.push(format!("{} names {package}", path.display()));
            }
        }
        if !["cli", "web", "main"].contains(&folder.as_str())
            && ["println!(", "print!(", "eprintln!(", "eprint!("].iter().any(|m| code.contains(m))
        {
            wrong.push(format!("{} prints", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_reader_of_sources_sees_what_it_should() {
    let code =
        "use crate::{facts, map::{World, Door}, units::Cm};\nfn f() { crate::geometry::nothing() }";
    let named: Vec<String> = named_modules(code).into_iter().collect();
    assert_eq!(named, ["facts", "geometry", "map", "units"]);
}
