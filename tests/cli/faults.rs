//! What wrong input comes to.

use std::path::Path;
use std::process::Stdio;

use orthoframe_store::Store;
use serde_json::Value;

use crate::files::shared;

use super::{Place, project, rb2, walk};

/// Wrong input: exit code 2, a remedy, the store untouched; gives the first fault.
fn refused(place: &Place, args: &[&str]) -> Value {
    let before = place.store();
    let text = place.run(args).is(2);
    assert!(text.err.contains("help:"), "{args:?} offers no remedy: {}", text.err);
    let fault = place.json(args, 2);
    assert_eq!(fault["outcome"], "error");
    let first = fault["errors"][0].clone();
    assert!(first["help"].as_str().is_some_and(|h| !h.is_empty()), "{args:?}: {fault}");
    assert!(place.store() == before, "{args:?} changed the store");
    first
}

/// A fault with a place in the text.
fn refused_at_place(place: &Place, args: &[&str]) -> Value {
    let fault = refused(place, args);
    assert!(fault["line"].as_u64().is_some_and(|n| n > 0), "{args:?}: {fault}");
    assert!(fault["column"].as_u64().is_some_and(|n| n > 0), "{args:?}: {fault}");
    assert!(fault["file"].is_string(), "{args:?}: {fault}");
    fault
}

#[test]
fn broken_maps_leave_the_store_as_it_was() {
    let place = Place::with_rb2();
    let map = std::fs::read_to_string(rb2()).unwrap();
    let broken = |name: &str, from: &str, to: &str, code: &str| {
        let text = map.replacen(from, to, 1);
        assert_ne!(text, map, "{name}: rb2 has no such text");
        let file = place.write(name, text);
        for command in ["import", "check"] {
            refused_at_place(&place, &[command, &file]);
            let all = place.json(&[command, &file], 2)["errors"].clone();
            let all = all.as_array().unwrap();
            let ours = all.iter().find(|fault| fault["code"] == code);
            let ours = ours.unwrap_or_else(|| panic!("{name}: {all:#?}"));
            assert!(ours["line"].is_u64() && ours["column"].is_u64(), "{name}: {ours}");
        }
    };
    broken(
        "unclosed.toml",
        "rect = [90, 30]\nheight = 10",
        r#"sides = [
  { id = "A", from = [0, 0], to = [90, 0] },
  { id = "B", from = [90, 0], to = [90, 30] },
  { id = "C", from = [90, 30], to = [0, 30] },
  { id = "D", from = [0, 30], to = [0, 5] },
]
height = 10"#,
        "map::base_not_closed",
    );
    // The passage of the corridor, narrower than that of the room.
    broken("lengths.toml", "[0, 170], [0, 60]]", "[0, 160], [0, 60]]", "map::link_length");
    // A table top sunk into the cabinet below it; a room on a room.
    broken(
        "sunk.toml",
        r#""counter-top", at = [0, 0, 87]"#,
        r#""counter-top", at = [0, 0, 80]"#,
        "map::items_overlap",
    );
    broken(
        "rooms.toml",
        r#""corridor", at = [560, 0]"#,
        r#""corridor", at = [500, 0]"#,
        "map::areas_overlap",
    );
}

#[test]
fn rubbish_is_refused_wherever_it_stands() {
    let place = Place::with_rb2();
    let rubbish: Vec<u8> =
        (0..4000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let long = format!("format = 1 # {}\n", "а".repeat(50_000_000));
    std::fs::create_dir(place.path("folder")).unwrap();
    let files = [
        place.write("rubbish", rubbish),
        place.write("empty", ""),
        place.write("long", long),
        place.path("folder").display().to_string(),
    ];
    for file in &files {
        refused(&place, &["import", file]);
        refused(&place, &["plan", file]);
        refused(&place, &["demo", "--map", file]);
        let rules = place.path("rules-of-mine");
        for name in ["relations.dl", "service-robot.strips"] {
            let _ = std::fs::remove_dir_all(&rules);
            std::fs::create_dir(&rules).unwrap();
            if Path::new(file).is_dir() {
                std::fs::create_dir(rules.join(name)).unwrap();
            } else {
                std::fs::hard_link(file, rules.join(name)).unwrap();
            }
            refused(&place, &["--rules", "rules-of-mine", "do", "Принеси лекарство"]);
        }
        std::fs::remove_dir_all(&rules).unwrap();
    }
    for args in [
        &["import", "missing"][..],
        &["check", "missing"],
        &["plan", "missing"],
        &["--rules", "missing", "relations"],
        &["--store", "missing", "relations"],
        &["--store", "rubbish", "relations"],
        &["--store", "folder/..", "relations"],
    ] {
        refused(&place, args);
    }
    assert!(!place.path("missing").exists());
}

#[test]
fn scenarios_and_rules_are_refused_at_their_place() {
    let place = Place::with_rb2();
    let scenario = std::fs::read_to_string(walk()).unwrap();
    let scenario = scenario
        .replace(
            "../service-robot.strips",
            &project("rules/service-robot.strips").display().to_string(),
        )
        .replace("../../maps/rb2.toml", &rb2());
    let unknown = place.write("unknown.strips", scenario.replace("Комната-Y", "Комната-Ъ"));
    let goal = place
        .write("goal.strips", scenario.replacen("(Точка-К, Комната-Y)", "(Точка-К, Комната-Ъ)", 1));
    for file in [&unknown, &goal] {
        for args in [&["plan", file][..], &["--store", "ortho-store", "plan", file]] {
            let fault = refused_at_place(&place, args);
            assert_eq!(fault["code"], "strips::unknown_object", "{fault}");
            assert!(fault["message"].as_str().unwrap().contains("Комната-Ъ"), "{fault}");
        }
    }
    let rules = std::fs::read_to_string(project("rules/service-robot.strips")).unwrap();
    let undeclared = rules.replacen(
        "(Эффект+: РОБОТ-НАХОДИТСЯ-У-ДВЕРИ_(дверь ?y)",
        "(Эффект+: РОБОТ-НАХОДИТСЯ-У-ДВЕРИ_(дверь ?q)",
        1,
    );
    assert_ne!(rules, undeclared);
    place.write("mine/service-robot.strips", undeclared);
    let fault = refused_at_place(&place, &["--rules", "mine", "do", "Принеси лекарство"]);
    assert_eq!(fault["code"], "strips::undeclared_variable");
    let relations = std::fs::read_to_string(project("rules/relations.dl")).unwrap();
    place.write(
        "other/relations.dl",
        relations + "\n.decl ДАЛЬ(x: symbol)\nДАЛЬ(y) :- profile(_).\n",
    );
    let fault = refused_at_place(&place, &["--rules", "other", "relations"]);
    assert_eq!(fault["code"], "facts::ungrounded");
}

#[test]
fn a_store_in_use_is_read_and_left_alone() {
    let place = Place::with_rb2();
    let reading = [&["relations"][..], &["where", "--at", "225,395"], &["ask", "Где лекарство?"]];
    let free = reading.map(|args| place.run(args).is(0).out);
    let (held, _) = Store::open(place.path("ortho-store")).unwrap();
    // Whoever only asks is answered as ever.
    assert_eq!(reading.map(|args| place.run(args).is(0).out), free);
    for args in [&["import", &rb2()][..], &["observe", "Лекарство", "--missing"]] {
        let run = place.run(args).is(2);
        assert!(
            run.err.contains("открыто другой программой") && run.err.contains("help:"),
            "{}",
            run.err
        );
        assert_eq!(place.json(args, 2)["errors"][0]["code"], "store::locked");
    }
    drop(held);
    place.run(&["edit", "rename", "Лекарство", "Таблетки"]).is(0);
}

#[test]
fn wrong_arguments_are_wrong_input() {
    let place = Place::with_rb2();
    for args in [
        &[][..],
        &["fly"],
        &["route", "--from", "Точка-А"],
        &["plan"],
        &["plan", "a.strips", "--time-limit", "-1"],
        &["relations", "--lang", "fr"],
        &["draw"],
    ] {
        place.run(args).is(2);
    }
    place.run(&["--help"]).is(0);
    for args in [
        &["relations", "--name", "НАХОДИТСЯ_СВЕРХУ"][..],
        &["relations", "--name", ""],
        &["relations", "--of", "Лекарствво"],
        &["relations", "--of", ""],
        &["do", ""],
        &["where", "--map", "Дача", "--at", "1,1"],
        &["route", "--from", "Точка-А", "--to", "Квартира РБ-2"],
    ] {
        refused(&place, args);
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_fault() {
    let place = Place::with_rb2();
    for args in [&["relations"][..], &["draw", "map"], &["do", "Принеси лекарство"], &["schema"]]
    {
        let mut child =
            place.command(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr);
        assert!(!err.contains("panicked"), "{args:?}: {err}");
        assert_eq!(output.status.code(), Some(0), "{args:?}: {err}");
    }
}

/// Nineteen doors that both their rooms claim, each with two places far apart.
#[test]
fn faults_with_places_far_apart_are_told_on_few_lines() {
    let Some(file) = shared("cases/corridor_19_errors.json") else { return };
    let file = file.display().to_string();
    let args = ["check", &file];
    let told = Place::empty().run(&args).is(2).err;
    assert!(told.lines().count() < 19 * 20 + 2, "{} lines", told.lines().count());
    assert_eq!(told.matches("и здесь").count(), 19);
    let faults = Place::empty().json(&args, 2);
    let both = |fault: &Value| fault["places"].as_array().is_some_and(|places| places.len() == 2);
    assert!(faults["errors"].as_array().unwrap().iter().all(both), "{faults}");
}
