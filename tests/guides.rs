//! What the guides show is so: the pieces of docs/*.md, run.

use std::path::Path;
use std::process::Command;

use orthoframe::Engine;
use orthoframe::engine::{PlanAnswer, Rules};
use orthoframe_graphplan::{Limits, Outcome};
use orthoframe_map::{Format, World};
use orthoframe_robot::Wanted;
use orthoframe_strips::Scenario;
use orthoframe_units::Source;

use crate::files::project;
use crate::worlds::rb2;

/// The texts of a guide between fences of one language.
fn pieces<'g>(guide: &'g str, language: &str) -> Vec<&'g str> {
    let fence = format!("```{language}\n");
    let after = guide.split(fence.as_str()).skip(1);
    after.map(|rest| rest.split("```").next().expect("split gives at least one piece")).collect()
}

/// docs/map.md builds the lab piece by piece: every piece that it shows stands in the map file.
#[test]
fn the_guide_to_maps_shows_the_map_as_it_is() {
    let lines = |text: &str| -> String {
        let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
        lines.fold(String::new(), |all, line| all + line + "\n")
    };
    let map = lines(include_str!("../maps/lab.toml"));
    let pieces = pieces(include_str!("../docs/map.md"), "toml");
    assert!(pieces.len() > 7);
    for piece in pieces {
        assert!(map.contains(&lines(piece)), "not in maps/lab.toml:\n{piece}");
    }
}

#[test]
fn the_zones_of_the_guide_to_maps_stand_on_its_map() {
    let [zones] = pieces(include_str!("../docs/map.md"), "toml zones")[..] else {
        panic!("zones are shown in one piece")
    };
    let text = format!("{}\n{zones}", include_str!("../maps/lab.toml"));
    let world = World::parse(&Source::new("lab.toml", text), Format::Toml)
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)));
    assert_eq!(world.zones.len(), zones.matches("[zone.").count());
}

#[test]
fn the_relation_of_the_guide_to_rules_is_derived() {
    let rules = tempfile::tempdir().unwrap();
    let [relation] = pieces(include_str!("../docs/rules.md"), "datalog")[..] else {
        panic!("one relation is shown")
    };
    std::fs::write(rules.path().join("seats.dl"), relation).unwrap();
    let engine = Engine::in_memory(rb2(), Some(rules.path())).unwrap();
    for name in ["AT_HAND_OF", "ПОД_РУКОЙ_У"] {
        let facts = engine.facts(Some(name), None).unwrap();
        let told: Vec<Vec<String>> =
            facts.iter().map(|(_, fact)| fact.iter().map(ToString::to_string).collect()).collect();
        // The medicine on the bedside table, and what stands on the dining table by its chairs.
        assert!(told.contains(&vec!["Лекарство".to_owned(), "Кровать-1".to_owned()]), "{told:?}");
        assert_eq!(told.len(), 9);
    }
    // The standard relations are there as before.
    assert!(!engine.facts(Some("ON_TOP_OF"), Some("Стол-1")).unwrap().is_empty());
    // A fault of the added file is told, and in its own text.
    std::fs::write(rules.path().join("more.dl"), "X(a) :- NEXT_TWO(a, _).").unwrap();
    let fault = Rules::read(Some(rules.path())).unwrap_err().to_string();
    assert!(fault.contains("more.dl"), "{fault}");
}

/// The guide's words for the guide's relation: a question that was no question before.
#[test]
fn a_relation_of_ones_own_is_asked_in_its_own_words() {
    let rules = tempfile::tempdir().unwrap();
    let guide = include_str!("../docs/rules.md");
    let ask = |engine: &Engine, question: &str| {
        let answer = engine.ask(question, &mut orthoframe::engine::Memory::default()).unwrap();
        answer.map(|answer| (answer.text.clone(), engine.rule_of(&answer).unwrap()))
    };
    let relation = pieces(guide, "datalog")[0];
    let wordless: Vec<&str> = relation.lines().filter(|line| !line.starts_with("//")).collect();
    std::fs::write(rules.path().join("seats.dl"), wordless.join("\n")).unwrap();
    let before = Engine::in_memory(rb2(), Some(rules.path())).unwrap();
    assert!(ask(&before, "Что под рукой у Кровати-1?").is_err());
    std::fs::write(rules.path().join("seats.dl"), relation).unwrap();
    let engine = Engine::in_memory(rb2(), Some(rules.path())).unwrap();
    let (text, rule) = ask(&engine, "Что под рукой у Кровати-1?").unwrap();
    assert!(text.contains("Лекарство"), "{text}");
    assert!(rule.contains("AT_HAND_OF(X1, \"Кровать-1\")"), "{rule}");
    assert_eq!(ask(&engine, "Лекарство под рукой у Кровати-1?").unwrap().0, "Да.");
    assert_eq!(ask(&engine, "Лекарство под рукой у Стула-3?").unwrap().0, "Нет.");
    assert_eq!(ask(&engine, "How many things are within reach of Bed 1?").unwrap().0, "1.");
    // A file of words adds more: to the relation, and to what the map calls a sofa.
    let words = rules.path().join("language/ru");
    std::fs::create_dir_all(&words).unwrap();
    std::fs::write(words.join("own.lang"), pieces(guide, "lang").concat()).unwrap();
    let engine = Engine::in_memory(rb2(), Some(rules.path())).unwrap();
    let (text, _) = ask(&engine, "Что на расстоянии руки от Кровати-1?").unwrap();
    assert!(text.contains("Лекарство"), "{text}");
    assert!(ask(&engine, "Тахта в Комнате-В?").unwrap().0.starts_with("Да"));
    // Another way to ask is what it stands for.
    let where_is = ask(&engine, "Где Лекарство?").unwrap().0;
    assert_eq!(ask(&engine, "Где тусуется Лекарство?").unwrap().0, where_is);
    // A folder is a language.
    assert_eq!(ask(&engine, "Gibt es einen Stuhl in Room Y?").unwrap().0, "Nein.");
    assert_eq!(ask(&engine, "Welche Farbe hat das Sofa?").unwrap().0, "braun.");
    // A fault of a grammar file is told with its place.
    std::fs::write(words.join("own.lang"), "Prep <- под рукой у[gen] = at_hand\n").unwrap();
    let fault = Rules::read(Some(rules.path())).unwrap_err();
    assert!(format!("{fault:?}").contains("at_hand"), "{fault:?}");
}

#[test]
fn the_robot_of_the_guide_to_rules_waters_its_pots() {
    let [rules] = pieces(include_str!("../docs/rules.md"), "strips")[..] else {
        panic!("one rule file is shown")
    };
    let scenario = Scenario::parse(&Source::new("docs/rules.md", rules)).unwrap();
    let solved =
        PlanAnswer::without_map(scenario, &Limits::default(), Wanted::Shortest).unwrap().solved;
    let Outcome::Plan(plan) = &solved.outcome else { panic!("{:?}", solved.outcome) };
    assert_eq!(plan.steps.len(), 8);
    assert!(solved.is_shortest);
}

/// docs/start.md is walked through in a folder of its own: its files are written, its commands run one after another, and
/// what they tell is what the guide shows (`UPDATE_EXPECT=1` writes it anew).
#[test]
fn the_guide_for_beginners_is_walked_through() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["plan.png", "flat.ifc"] {
        std::fs::copy(project("docs/start").join(name), folder.path().join(name)).unwrap();
    }
    let program = Path::new(env!("CARGO_BIN_EXE_ortho")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let run = |command: &str| {
        let mut shell = Command::new("bash");
        shell.args(["-c", &format!("exec 2>&1; {command}")]).current_dir(folder.path());
        shell.env("PATH", &path).env("HOME", folder.path()).env_remove("XDG_CONFIG_HOME");
        for name in ["ORTHO_STORE", "ORTHO_RULES", "ORTHO_LANG", "ORTHO_USER", "ORTHO_CONFIG"] {
            shell.env_remove(name);
        }
        let told = shell.stdin(std::process::Stdio::null()).output().unwrap();
        String::from_utf8(told.stdout).unwrap()
    };
    let guide = std::fs::read_to_string(project("docs/start.md")).unwrap();
    let mut walked = String::new();
    let mut rest = guide.as_str();
    let mut commands = 0;
    while let Some((before, after)) = rest.split_once("\n```") {
        let (head, body) = after.split_once('\n').unwrap();
        let (body, next) = body.split_once("\n```\n").unwrap_or_else(|| panic!("no end: {head}"));
        walked += before;
        walked += "\n```";
        walked += head;
        walked.push('\n');
        match head.split_once(' ') {
            Some((_, file)) => {
                std::fs::write(folder.path().join(file), format!("{body}\n")).unwrap();
                walked += body;
            }
            None => {
                let asked = body.lines().filter(|line| line.starts_with("$ "));
                let told = asked.map(|line| {
                    commands += 1;
                    format!("{line}\n{}", run(&line[2..]))
                });
                walked += told.collect::<String>().trim_end();
            }
        }
        walked += "\n```\n";
        rest = next;
    }
    walked += rest;
    assert!(commands > 12, "{commands} commands");
    expect_test::expect_file![project("docs/start.md")].assert_eq(&walked);
}
