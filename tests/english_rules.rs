//! Scenarios without a Cyrillic letter: second names of predicates and types, the map's English names of objects.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use miette::Diagnostic;
use orthoframe::Engine;
use orthoframe::engine::{Error, Value};
use orthoframe_graphplan::{Limits, Outcome};
use orthoframe_map::{Entity, World};
use orthoframe_robot::Wanted;
use orthoframe_strips::{RuleFaults, Scenario};
use orthoframe_units::{English, Language, Source, name_key};

use crate::files::project;
use crate::planning_judge::whole;

const WORDS_OF_THE_LANGUAGE: [(&str, &str); 7] = [
    ("НЕ ", "NOT "),
    ("Исходная позиция:", "Initial position:"),
    ("Целевая позиция:", "Goal position:"),
    ("Предположения:", "Assumptions:"),
    ("Факты:", "Facts:"),
    ("Объекты:", "Objects:"),
    ("Цель:", "Goal:"),
];

fn rules() -> String {
    std::fs::read_to_string(project("rules/service-robot.strips")).unwrap()
}

fn rb2() -> Engine {
    Engine::in_memory(crate::worlds::rb2(), None).unwrap()
}

/// By first names the second ones, as the rule file gives them, read by eye: `ПЕРВОЕ_(…) = SECOND = «…»`.
fn second_names() -> BTreeMap<String, String> {
    let rules = rules();
    let of_line = |line: &str| {
        let (first, rest) = line.split_once(" = ")?;
        let (second, _) = rest.split_once(" = «")?;
        let first = first.split('(').next()?.trim().trim_end_matches('_');
        Some((first.to_owned(), second.to_owned()))
    };
    rules.lines().filter_map(of_line).collect()
}

fn is_of_word(letter: char) -> bool {
    letter.is_alphanumeric() || "-_".contains(letter)
}

fn is_cyrillic(letter: char) -> bool {
    ('\u{400}'..='\u{4ff}').contains(&letter)
}

/// A word without Cyrillic letters, whatever it says.
fn in_latin(word: &str) -> String {
    let key = name_key(word);
    key.chars()
        .map(|c| if c.is_ascii() { c.to_string() } else { format!("{:x}", c as u32) })
        .collect()
}

/// A scenario said in English.
fn english(text: &str, seconds: &BTreeMap<String, String>, world: &World) -> String {
    let mut objects: BTreeMap<String, String> = BTreeMap::new();
    let mut first: BTreeMap<Entity, &str> = BTreeMap::new();
    for (entity, name) in world.names() {
        match first.get(&entity) {
            None => drop(first.insert(entity, name)),
            Some(russian) => drop(objects.insert(name_key(russian), name.replace(' ', "-"))),
        }
    }
    let mut told = String::new();
    for line in text.lines() {
        let mut line = line.split(';').next().unwrap_or("").to_owned();
        for (russian, english) in WORDS_OF_THE_LANGUAGE {
            line = line.replace(russian, english);
        }
        for word in line.split_inclusive(|c| !is_of_word(c)) {
            let end = word.trim_end_matches(|c| !is_of_word(c)).len();
            let (word, rest) = word.split_at(end);
            let name = word.trim_end_matches('_');
            let said = seconds.get(name).or_else(|| objects.get(&name_key(name))).cloned();
            told += &said.unwrap_or_else(|| in_latin(word));
            told += rest;
        }
        told.push('\n');
    }
    told
}

type Statements = BTreeSet<(String, Vec<String>, bool)>;

/// What a scenario states and wants, with what of its objects no map names in Latin letters.
fn statements(engine: &Engine, text: &str) -> (Statements, Statements, Scenario) {
    let read = Scenario::parse(&Source::new("scenario", text)).unwrap();
    let scenario = engine.supplemented(read).unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    let of = |stated: orthoframe_strips::Stated<'_>| {
        let args = stated.args().iter().map(|arg| in_latin(arg)).collect();
        (name_key(stated.predicate()), args, stated.is_negated())
    };
    let facts = scenario.problem.stated_facts().map(of).collect();
    let goals = scenario.problem.stated_goals().map(of).collect();
    (facts, goals, scenario)
}

#[test]
fn every_scenario_can_be_written_without_a_cyrillic_letter() {
    let (engine, seconds) = (rb2(), second_names());
    let folder = std::fs::read_dir(project("rules/scenarios")).unwrap();
    let mut files: Vec<PathBuf> = folder.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let mut twins = 0;
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let own = |line: &&str| !["Включить:", "Карта:"].iter().any(|head| line.starts_with(head));
        let text: String = text.lines().filter(own).map(|line| format!("{line}\n")).collect();
        if text.contains("Include:") {
            continue;
        }
        let told = english(&text, &seconds, engine.world().unwrap());
        assert!(!told.contains(is_cyrillic), "{}: {told}", file.display());
        let (facts, goals, scenario) = statements(&engine, &(rules() + &text));
        let (same_facts, same_goals, twin) = statements(&engine, &(rules() + &told));
        let differ: Vec<_> = facts.symmetric_difference(&same_facts).collect();
        assert!(differ.is_empty(), "{}: {differ:#?}", file.display());
        assert_eq!(same_goals, goals, "{}", file.display());
        let size = |scenario: Scenario| {
            let answer = engine.plan_supplied(scenario, &Limits::default(), Wanted::Shortest);
            match answer.unwrap().solved.outcome {
                Outcome::Plan(plan) => Some(plan.steps.len()),
                _ => None,
            }
        };
        assert_eq!(size(twin), size(scenario), "{}", file.display());
        twins += 1;
    }
    assert!(twins > 10, "{twins}");
}

#[test]
fn the_english_scenario_says_what_the_papers_says() {
    let engine = rb2();
    let of = |name: &str| whole(&project(&format!("rules/scenarios/{name}.strips")));
    let (facts, goals, _) = statements(&engine, &of("medicine-walk"));
    let (same_facts, same_goals, _) = statements(&engine, &of("walk-to-the-medicine"));
    assert_eq!((same_facts, same_goals), (facts, goals));
}

#[test]
fn the_maps_facts_in_english_read_back() {
    let engine = rb2();
    let goal = "\nGoal position: ROBOT-AT(Point-K)\n";
    let text = |language| rules() + &engine.facts_in_rule_text(None, language).unwrap() + goal;
    let (facts, goals, _) = statements(&engine, &text(Language::Russian));
    let told = engine.facts_in_rule_text(None, Language::English).unwrap();
    assert!(!told.contains(is_cyrillic), "{told}");
    let (same_facts, same_goals, _) = statements(&engine, &text(Language::English));
    assert_eq!((same_facts, same_goals), (facts, goals));
    let of_doors = |name| engine.facts_given(Some(name)).unwrap();
    assert_eq!(of_doors("DOOR-OPEN"), of_doors("ДВЕРЬ_ИЗ_В_ОТКРЫТА_"));
}

/// Each fault in English, with its remedy.
fn faults(text: &str) -> String {
    let told = |faults: RuleFaults| {
        let told = faults.0.iter().map(English).map(|fault| {
            let help = fault.help().map_or_else(String::new, |help| format!(" – {help}"));
            format!("{fault}{help}\n")
        });
        told.collect()
    };
    let scenario = match Scenario::parse(&Source::new("rules", text)) {
        Ok(scenario) => scenario,
        Err(found) => return told(found),
    };
    match rb2().supplemented(scenario).map(|scenario| scenario.ground()) {
        Ok(Ok(_)) => String::new(),
        Ok(Err(found)) | Err(Error::Rules(found)) => told(found),
        Err(other) => panic!("{other:?}"),
    }
}

#[test]
fn slips_in_second_names_are_told_with_them() {
    let of = |stated: &str| {
        let told = faults(&format!("{stated}\nGoal: ROBOT-AT(Point-K)\n{}", rules()));
        let lines = told.lines().map(|line| line.split(", as here").next().unwrap_or(line));
        lines.collect::<Vec<_>>().join("\n")
    };
    assert_eq!(of("Facts: DOOR-OF(Door-VZ, Room-V)"), "");
    expect_test::expect![[r#"
        rules:1:8: unknown predicate “DOOR-OFF” – perhaps “DOOR-OF”?
        rules:1:58: “DOOR-OF” takes 2 arguments, not 1 – written: DOOR-OF_(door, room)"#]]
    .assert_eq(&of("Facts: DOOR-OFF(Door-VZ, Room-V) DOOR-OF(Door-VZ, Rom-V) DOOR-OF(Door-VZ)"));
    expect_test::expect!["rules:1:20: unknown type “thng” – perhaps “thing”?"]
        .assert_eq(&of("Objects: Trolley — thng"));
}

#[test]
fn a_second_name_is_one_predicates_or_types() {
    expect_test::expect![[r#"
        rules:6:22: the second name “WHERE” is declared a second time – “AT” is called so already
        rules:7:21: “Go” is an action: predicates and types may have a second name – remove it; the words in quotation marks stay
        rules:8:30: a section: “Action:”, “Facts:” and so on is expected, and “=” stands here
    "#]].assert_eq(&faults(
        "Action: Go (Parameters: place ?a) (Precondition: AT(?a)) (Effect+: WAS(?a))
         Goal: WAS(Home)
         Facts: AT(Home)
         In English:
           AT(?a) = WHERE = «?a is here»
           WAS(?a) = WHERE = «?a was seen»
           Go(?a) = WALK = «walk to ?a»
           NOT AT(?a) = AWAY = «?a is far»",
    ));
}

/// Of every map here: what bears an English name alone is asked by it as by its own, and told by it.
#[test]
fn questions_in_the_rules_language_take_english_names() {
    let (mut asked, mut shared) = (0, 0);
    for entry in std::fs::read_dir(project("maps")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        // A table of corridors is no map of rooms.
        let Ok(world) = World::load(&path) else { continue };
        let engine = Engine::in_memory(world, None).unwrap();
        let world = engine.world().unwrap();
        let mut bearers: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        let objects = world
            .objects
            .values()
            .map(|object| (object.name.as_str(), [&object.name, &object.name_en]));
        let own = objects.flat_map(|(own, names)| names.map(|name| (own, name.as_str())));
        for (own, name) in world.names().map(|(entity, name)| (world.name(entity), name)).chain(own)
        {
            bearers.entry(name_key(name)).or_default().insert(own.to_owned());
        }
        let rows = |name: &str| {
            let question = format!("?- CONTAINS(X, {name:?}).order X");
            let answer = engine.query(&question, false).unwrap();
            (answer.rows, answer.unknown)
        };
        for replica in world.replicas.values().filter(|replica| !replica.name_en.is_empty()) {
            let (by_name, unknown) = rows(&replica.name);
            assert!(unknown.is_empty(), "{unknown:?}");
            let value = Value::Symbol(replica.name.as_str().into());
            let told = engine.value_in_words(&value, Language::English);
            if bearers[&name_key(&replica.name_en)].len() == 1 {
                assert_eq!(rows(&replica.name_en), (by_name, unknown), "{}", replica.name_en);
                assert_eq!(told, replica.name_en);
                asked += 1;
            } else {
                assert_eq!(told, replica.name, "a name that several bear tells nothing");
                shared += 1;
            }
            assert_eq!(engine.value_in_words(&value, Language::Russian), replica.name);
        }
    }
    assert!(asked > 50, "{asked} asked, {shared} names of several");
}
