//! `ortho do --truth`, `--scenario`, events as JSON lines; the map's facts as rules, and the rule files written out.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use orthoframe_strips::Scenario;
use orthoframe_units::Source;
use serde_json::Value;

use super::{Place, project, rb2, walk};

const LOCKED: &str = "[[edit]]\nstate = \"Дверь-ZY\"\nis = \"locked\"\n";

#[test]
fn events_are_a_line_each_and_the_last_line_is_the_value() {
    let place = Place::with_rb2();
    place.write("truth.toml", LOCKED);
    let before = place.store();
    let out = place.run(&["do", "Принеси лекарство", "--truth", "truth.toml", "--json"]).is(0).out;
    let lines: Vec<Value> = out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let (last, events) = lines.split_last().unwrap();
    let name = |event: &Value| event["event"].as_str().unwrap().to_owned();
    let names: Vec<String> = events.iter().map(name).collect();
    assert_eq!(names[..2], ["planned", "started"]);
    let met = names.iter().position(|name| name == "surprised").expect("the door is locked");
    assert_eq!(names[met + 1], "replanned");
    assert_eq!(events[met]["thing"], "Дверь-ZY");
    let count = |wanted: &str| names.iter().filter(|name| *name == wanted).count();
    let done = last["directives"].as_array().unwrap().len();
    assert_eq!(count("arrived") + count("done"), done);
    assert_eq!(count("started"), done + count("surprised"));
    assert_eq!(last["replans"], count("replanned"));
    // A directive is told in one shape, on its way and in the end.
    let arrived = events.iter().find(|event| event["event"] == "done").unwrap();
    let same = last["directives"].as_array().unwrap().iter().any(|report| {
        report.as_object().unwrap().iter().all(|(field, value)| arrived[field] == *value)
    });
    assert!(same, "{arrived}");
    assert_eq!((&last["outcome"], last.get("event")), (&"done".into(), None));
    assert_eq!(place.store().map(|(_, world)| world), before.map(|(_, world)| world));
    let seen = place.run(&["ask", "Заперта ли Дверь-ZY?"]).is(0).out;
    assert!(seen.contains("заперта"), "{seen}");
}

#[test]
fn a_file_that_is_no_truth_is_refused_at_its_place() {
    let place = Place::with_rb2();
    place.write("bad.toml", "[[edit]]\nmove = \"Стул-99\"\nto = [1, 2]\n");
    let told = place.run(&["do", "Принеси лекарство", "--truth", "bad.toml"]).is(2).err;
    assert!(told.contains("bad.toml:2:8") && told.contains("Стул-1"), "{told}");
    place.run(&["do", "Принеси лекарство", "--truth", "no-such.toml"]).is(2);
}

#[test]
fn a_scenario_is_driven_or_refused_at_its_place() {
    let place = Place::with_rb2();
    fn with<'a>(args: &[&'a str]) -> Vec<&'a str> {
        [args, &["--store", "ortho-store"]].concat()
    }
    let done = place.json(&with(&["do", "--scenario", &walk()]), 0);
    assert_eq!(
        (&done["outcome"], &done["directives"][4]["args"][2]),
        (&"done".into(), &"Точка-К".into())
    );
    // The robot is not any more where the scenario begins.
    let told = place.run(&with(&["do", "--scenario", &walk()])).is(2).err;
    assert!(told.contains("medicine-walk.strips:8:1") && told.contains("--from"), "{told}");
    place.run(&with(&["do", "--scenario", &walk(), "--reset"])).is(0);
    // In a truth of its own.
    place.write("truth.toml", LOCKED);
    let walk = walk();
    let args = with(&["do", "--scenario", &walk, "--reset", "--truth", "truth.toml"]);
    assert!(place.run(&args).is(0).out.contains("путь преграждает Дверь-ZY"));
    // What the map does not know, what is not so, and what nothing that the robot does brings about.
    let rules = project("rules/service-robot.strips").display().to_string();
    let text = format!(
        "Включить: {rules}\nФакты:\nПОЗИЦИЯ_НАХОДИТСЯ-В_(Точка-Ю, Комната-В)\nДВЕРЬ_ИЗ_В_ЗАПЕРТА_(Дверь-ВZ, Комната-В, Комната-Z)\nЦель:\nОБСТАНОВКА-СООБЩЕНА_(Комната-Z)\nНЕ РОБОТ-НАХОДИТСЯ-В_(Комната-В)\n"
    );
    let file = place.write("own.strips", text);
    let refused = place.json(&with(&["do", "--scenario", &file]), 2);
    let faults: Vec<(&str, u64)> = refused["errors"]
        .as_array()
        .unwrap()
        .iter()
        .map(|fault| (fault["code"].as_str().unwrap(), fault["line"].as_u64().unwrap()))
        .collect();
    let (unknown, undone) = ("strips::not_believed", "strips::not_driven");
    assert_eq!(faults, [(unknown, 3), (unknown, 4), (undone, 6), (undone, 7)]);
}

#[test]
fn the_maps_facts_read_back() {
    let place = Place::with_rb2();
    let text = place.run(&["plan", "--facts"]).is(0).out;
    let rules = project("rules/service-robot.strips").display().to_string();
    let goal = "Исходная позиция: РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Точка-А) РУКА-СВОБОДНА_()\nЦель: РОБОТ-ДЕРЖИТ_(Лекарство)";
    let read = |facts: &str| {
        let text = format!("Включить: {rules}\n{facts}\n{goal}");
        Scenario::parse(&Source::new("факты", text)).unwrap()
    };
    let engine = orthoframe::Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    let (told, given) = (read(&text), engine.supplemented(read("")).unwrap());
    let [told, given] = [&told, &given].map(|scenario| {
        let task = scenario.ground().unwrap();
        let facts: BTreeSet<String> =
            task.init.iter().map(|&id| task.fact(id).to_string()).collect();
        let operators: BTreeSet<String> = task.operators.iter().map(ToString::to_string).collect();
        (facts, operators)
    });
    assert_eq!(told, given);
    let all = place.json(&["plan", "--facts"], 0);
    let lines: BTreeSet<&str> = text.lines().filter(|line| line.contains("_(")).collect();
    let told: BTreeSet<&str> = all["facts"]
        .as_array()
        .unwrap()
        .iter()
        .map(|fact| fact["text"].as_str().unwrap())
        .collect();
    assert_eq!(lines, told);
    let some = place.run(&["plan", "--facts", "--name", "КЛЮЧ_ПОДХОДИТ-К"]).is(0).out;
    assert!(some.contains("Таких фактов нет"), "{some}");
    place.run(&["plan", "--facts", "--name", "ДВЕРЬ_ИЗ_В_ОТКРЫТО"]).is(2);
}

#[test]
fn rule_files_are_written_out_and_read_back() {
    let place = Place::empty();
    // None is forgotten.
    let files = |within: PathBuf| {
        let mut open = vec![within.clone()];
        let mut files = BTreeMap::new();
        while let Some(folder) = open.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    open.push(path);
                } else {
                    let text = std::fs::read_to_string(&path).unwrap();
                    files.insert(path.strip_prefix(&within).unwrap().to_owned(), text);
                }
            }
        }
        files
    };
    let mut own = files(project("rules"));
    // Held against the truth of a foreign data set, and no rules of a robot; words that code looks for, and those that it
    // tells, are built in.
    let is_rules = |file: &Path| {
        !file.starts_with("truth")
            && file.extension().is_none_or(|kind| kind != "txt" && kind != "ftl")
    };
    own.retain(|file, _| is_rules(file));
    place.run(&["rules", "--export", "own"]).is(0);
    let written = files(place.path("own"));
    assert!(written.keys().eq(own.keys()), "{:?} {:?}", written.keys(), own.keys());
    for (file, text) in &written {
        assert_eq!(text, &own[file], "{}", file.display());
    }
    place.write("own/relations.dl", "mine");
    let told = place.run(&["rules", "--export", "own"]).is(2).err;
    assert!(told.contains("--force"), "{told}");
    assert_eq!(std::fs::read_to_string(place.path("own/relations.dl")).unwrap(), "mine");
    place.run(&["rules", "--export", "own", "--force"]).is(0);
    place.run(&["import", &rb2()]).is(0);
    for args in [
        &["relations"][..],
        &["plan", "--facts"],
        &["do", "Принеси лекарство", "--reset", "--json"],
    ] {
        let own = place.run(&[args, &["--rules", "own"][..]].concat()).is(0).out;
        assert_eq!(own, place.run(args).is(0).out, "{args:?}");
    }
}

/// Doors of a model are hung as it says and stand open: their leaves must leave a way, and the floor runs on within the walls.
#[test]
fn every_room_of_a_model_is_driven_to() {
    for (file, rooms) in [
        (
            "docs/start/flat.ifc",
            &["the living room", "the kitchen", "the bedroom", "the office", "the corridor"][..],
        ),
        ("tests/golden/formats/ifc2x3_flat/input.ifc", &["Kitchen 101", "Entrance hall 102"]),
        ("tests/golden/formats/ifc4_two_storeys/input.ifc", &["Office 1", "Stair hall 002"]),
        ("tests/golden/formats/ifc4_two_storeys/input.ifc", &["Office 101", "Stair hall 102"]),
    ] {
        let place = Place::empty();
        place.run(&["import", &project(file).display().to_string()]).is(0);
        for from in rooms {
            for to in rooms.iter().filter(|to| *to != from) {
                let from = from.trim_start_matches("the ");
                let order = format!("Go to {to}");
                place.run(&["--lang", "en", "do", &order, "--from", from]).is(0);
            }
        }
    }
}
