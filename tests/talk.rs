//! Questions and answers: golden pairs, templates against a direct look at the data, and input that is no question.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::PathBuf;

use orthoframe::Engine;
use orthoframe::World;
use orthoframe::engine::{Error, Memory};
use orthoframe_exchange::{Options, read};
use orthoframe_facts::Value;
use orthoframe_language::command::Misheard;
use orthoframe_language::question::Said;
use orthoframe_language::{Case, NounPhrase, Number, WordHints};
use orthoframe_map::Entity;
use orthoframe_semantics::{Profile, RelationRules, derive};
use orthoframe_units::{Source, TypeId};

use crate::files::{long, project, shared};

/// An engine on a map of ours or of others; none, with a word, where the file is not there.
pub(crate) fn engine(map: &str) -> Option<Engine> {
    let path = match map.strip_prefix("../shared/data/") {
        Some(of_others) => shared(of_others)?,
        None => project(map),
    };
    let world = read(&path, &Options::default()).expect("the map reads").world;
    Some(Engine::in_memory(world, None).expect("the rules are sound"))
}

fn rb2() -> Engine {
    engine("maps/rb2.toml").expect("part of the crate")
}

/// What was said, with the kind of doubt before it where there is no answer.
fn said(engine: &Engine, question: &str, memory: &mut Memory) -> String {
    match engine.ask(question, memory).expect("there is a map") {
        Ok(answer) => answer.text,
        Err(unanswered) => format!("[{}] {}", unanswered.doubt.kind(), unanswered.text),
    }
}

/// Each folder: a map and questions; a line with «+» before it goes on with the dialogue of the line above.
#[test]
#[expect(clippy::print_stdout, reason = "the number of pairs is worth seeing")]
fn answers_are_as_the_golden_texts_say() {
    let folder = project("tests/golden/talk");
    let mut pairs = 0;
    let mut cases: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.sort();
    for case in cases {
        let map = std::fs::read_to_string(case.join("map.txt")).unwrap();
        let questions = std::fs::read_to_string(case.join("questions.txt")).unwrap();
        let Some(engine) = engine(map.trim()) else { continue };
        let mut memory = Memory::default();
        let mut text = String::new();
        for line in
            questions.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with('#'))
        {
            let question = match line.strip_prefix('+') {
                Some(rest) => rest.trim(),
                None => {
                    memory = Memory::default();
                    line
                }
            };
            writeln!(text, "{line}\n    {}", said(&engine, question, &mut memory)).unwrap();
            pairs += 1;
        }
        expect_test::expect_file![case.join("answers.txt")].assert_eq(&text);
    }
    println!("{pairs} questions answered as expected");
    assert!(pairs >= 400, "{pairs} pairs");
}

/// After a line that nothing understands, a question that goes on is answered as in a new dialogue, or not at all. The
/// ordinary run takes one dialogue of eight.
#[test]
fn nothing_goes_on_from_what_was_not_understood() {
    let mut cases: Vec<PathBuf> = std::fs::read_dir(project("tests/golden/talk"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    cases.sort();
    let mut asked = 0;
    for case in cases {
        let map = std::fs::read_to_string(case.join("map.txt")).unwrap();
        let questions = std::fs::read_to_string(case.join("questions.txt")).unwrap();
        let Some(engine) = engine(map.trim()) else { continue };
        let lines = questions.lines().map(str::trim);
        let lines: Vec<_> = lines.filter(|l| !l.is_empty() && !l.starts_with('#')).collect();
        let mut memory = Memory::default();
        // A line begins a dialogue; those with a plus go on with it.
        let dialogues = lines.chunk_by(|_, next| next.starts_with('+')).filter(|d| d.len() > 1);
        for line in dialogues.step_by(if long() { 1 } else { 8 }).flatten() {
            let Some(question) = line.strip_prefix('+').map(str::trim) else {
                memory = Memory::default();
                said(&engine, line, &mut memory);
                continue;
            };
            let russian = question.chars().any(|c| matches!(c, 'а'..='я' | 'А'..='Я'));
            let nonsense = if russian {
                "Флюрбь дзямс брынь?"
            } else {
                "Blorf gnarp zweeble?"
            };
            let mut lost = memory.clone();
            let refused = said(&engine, nonsense, &mut lost);
            assert!(refused.starts_with('['), "{nonsense}: {refused}");
            let after = said(&engine, question, &mut lost);
            let anew = said(&engine, question, &mut Memory::default());
            assert!(
                after.starts_with('[') || after == anew,
                "{}: {question}\n{after}\n{anew}",
                case.display()
            );
            said(&engine, question, &mut memory);
            asked += 1;
        }
    }
    assert!(asked >= if long() { 100 } else { 30 }, "{asked}");
}

#[test]
fn what_was_done_is_told_afterwards() {
    let engine = rb2();
    let mut memory = Memory::default();
    assert_eq!(
        said(&engine, "What did you do?", &mut memory),
        "I have done nothing yet in this talk."
    );
    let order = "Go to Room Z";
    let commands = engine.understand_in(order, &mut memory).unwrap();
    let answer = engine.carry_out(&commands, &mut |_| {}).unwrap();
    memory.did(answer.in_words(engine.world().unwrap(), order));
    assert_eq!(
        said(&engine, "What did you do?", &mut memory),
        "The last task was “Go to Room Z”: drive to Door VZ, go through Door VZ into Room Z; done."
    );
    let russian = said(&engine, "Что ты сделал?", &mut memory);
    assert!(russian.ends_with("проехать через Дверь-ВZ в Комнату-Z; сделано."), "{russian}");
}

/// Facts of two columns, by the names in them.
fn facts(engine: &Engine, relation: &str) -> Vec<(String, String)> {
    let tuples = engine.relations().unwrap().tuples(relation).unwrap();
    let text = |v: &Value| v.to_string();
    tuples.iter().map(|t| (text(&t[0]), text(&t[1]))).collect()
}

/// The houses of the data, or rb2 alone where these are not there.
fn houses() -> Vec<(String, Engine)> {
    let mut found = vec![("rb2".to_owned(), rb2())];
    if shared("procthor").is_some() {
        for n in 0..10 {
            let map = format!("../shared/data/procthor/house_{n}.json");
            found.extend(engine(&map).map(|e| (format!("house_{n}"), e)));
        }
    }
    found
}

/// Types by the English word for them, with all their things: a dining table is a table too, but a dog's bed is none
/// that a person means by "bed".
fn things_by_word(world: &World) -> BTreeMap<String, BTreeSet<String>> {
    let of_type = |wanted: TypeId| {
        let all = world.replicas.values();
        let own = all.filter(|r| world.objects[&r.object].object_type == Some(wanted));
        own.map(|r| r.name.clone()).collect::<BTreeSet<_>>()
    };
    let all: Vec<(String, BTreeSet<String>)> = world
        .types
        .object
        .entries
        .values()
        .filter(|t| !t.name_en.is_empty())
        .map(|t| (t.name_en.to_lowercase(), of_type(t.id)))
        .filter(|(_, things)| !things.is_empty())
        .collect();
    all.iter()
        .map(|(word, _)| {
            let narrower = format!(" {word}");
            let is_own =
                |w: &str| !["dog ", "cat ", "toy "].iter().any(|animal| w.starts_with(animal));
            let covers = |w: &str| w == word || (w.ends_with(&narrower) && is_own(w));
            let covered = all.iter().filter(|(w, _)| covers(w));
            (word.clone(), covered.flat_map(|(_, things)| things.clone()).collect())
        })
        .collect()
}

/// How templates fared.
#[derive(Default)]
struct Score {
    asked: usize,
    understood: usize,
    wrong: Vec<String>,
    missed: Vec<String>,
}

impl Score {
    /// Asks; `right` judges the answer.
    fn ask(
        &mut self,
        engine: &Engine,
        question: &str,
        right: &dyn Fn(&orthoframe::engine::Answer) -> bool,
    ) {
        self.asked += 1;
        match engine.ask(question, &mut Memory::default()).unwrap() {
            Ok(answer) => {
                self.understood += 1;
                if !right(&answer) {
                    self.wrong.push(format!("{question} -> {}", answer.text));
                }
            }
            Err(unanswered) => self.missed.push(format!("{question} -> {}", unanswered.text)),
        }
    }
}

fn sorted(symbols: &[String]) -> Vec<&str> {
    let mut symbols: Vec<&str> = symbols.iter().map(String::as_str).collect();
    symbols.sort_unstable();
    symbols.dedup();
    symbols
}

/// The templates of embodied question answering (PEERS, «Talk»), on every house, in the ordinary run on one of three,
/// against the facts themselves.
#[test]
#[expect(clippy::print_stdout, reason = "grammar coverage is worth seeing")]
fn templates_are_understood_and_answered_as_the_data_say() {
    let mut score = Score::default();
    for (house, engine) in houses().into_iter().step_by(if long() { 1 } else { 3 }) {
        let before = (score.asked, score.understood);
        templates(&engine, &mut score);
        println!(
            "{house}: {} of {} understood",
            score.understood - before.1,
            score.asked - before.0
        );
    }
    println!("{} of {} understood, {} wrong", score.understood, score.asked, score.wrong.len());
    for line in score.missed.iter().take(20) {
        println!("missed: {line}");
    }
    assert!(
        score.wrong.is_empty(),
        "{} wrong: {:#?}",
        score.wrong.len(),
        &score.wrong[..score.wrong.len().min(20)]
    );
    assert!(score.understood * 100 >= score.asked * 95, "{} of {}", score.understood, score.asked);
}

fn templates(engine: &Engine, score: &mut Score) {
    let world = engine.world().unwrap();
    let by_word = things_by_word(world);
    let rooms: Vec<(String, String)> = world
        .areas
        .values()
        .map(|a| (a.name.clone(), a.name_en.clone()))
        .filter(|(_, en)| !en.is_empty())
        .collect();
    let mut room_of: BTreeMap<String, String> = BTreeMap::new();
    for (room, thing) in facts(engine, "CONTAINS") {
        room_of.insert(thing, room);
    }
    let inside = |things: &BTreeSet<String>, room: &str| -> Vec<String> {
        things.iter().filter(|t| room_of.get(*t).is_some_and(|r| r == room)).cloned().collect()
    };
    for (word, things) in &by_word {
        let only = if things.len() == 1 { things.first() } else { None };
        let rooms_with: BTreeSet<&String> = things.iter().filter_map(|t| room_of.get(t)).collect();
        let plural = orthoframe_language::english::plural(word);
        score.ask(engine, &format!("How many rooms have {plural}?"), &|a| {
            a.number == Some(rooms_with.len() as f64)
        });
        score.ask(engine, &format!("Which rooms have a {word}?"), &|a| {
            sorted(&a.symbols) == rooms_with.iter().map(|r| r.as_str()).collect::<Vec<_>>()
        });
        score.ask(engine, &format!("how many {plural} are there in the house"), &|a| {
            a.number == Some(things.len() as f64)
        });
        for (room, english) in &rooms {
            let here = inside(things, room);
            let english = english.to_lowercase();
            for question in [
                format!("How many {plural} are in the {english}?"),
                format!("how many {plural} does the {english} have"),
                format!("Please tell me how many {plural} there are in the {english}"),
            ] {
                score.ask(engine, &question, &|a| a.number == Some(here.len() as f64));
            }
            for question in [
                format!("Is there a {word} in the {english}?"),
                format!("Are there any {plural} in the {english}?"),
                format!("Does the {english} have a {word}?"),
            ] {
                let expected = if here.is_empty() { Said::No } else { Said::Yes };
                score.ask(engine, &question, &|a| a.said == expected);
            }
        }
        let Some(thing) = only else { continue };
        for question in [
            format!("Which room is the {word} in?"),
            format!("In which room is the {word}?"),
            format!("What room is the {word} located in?"),
        ] {
            score.ask(engine, &question, &|a| {
                room_of.get(thing).is_none_or(|room| sorted(&a.symbols) == [room.as_str()])
            });
        }
        score.ask(engine, &format!("Where is the {word}?"), &|a| {
            sorted(&a.symbols) == [thing.as_str()]
        });
        let colour = colour_of(world, thing);
        score.ask(engine, &format!("What color is the {word}?"), &|a| match &colour {
            Some(_) => a.said == Said::Found,
            None => a.said == Said::Unknown,
        });
        for (phrase, relations) in [
            ("on", &[][..]),
            ("above", &[("ABOVE", false), ("UNDER", true)]),
            ("under", &[("UNDER", false), ("ON_TOP_OF", true), ("ABOVE", true)]),
            (
                "next to",
                &[("NEXT_TO", false), ("LEANING_AGAINST", false), ("LEANING_AGAINST", true)],
            ),
        ] {
            let mut expected: BTreeSet<String> = BTreeSet::new();
            for (relation, swapped) in relations {
                for (a, b) in facts(engine, relation) {
                    let (x, y) = if *swapped { (b, a) } else { (a, b) };
                    if y == *thing {
                        expected.insert(x);
                    }
                }
            }
            // What stands on it, and what lies on or in a thing there that can be carried away, and so on.
            if phrase == "on" {
                let mut open: Vec<String> = facts(engine, "ON_TOP_OF")
                    .into_iter()
                    .filter(|(_, y)| y == thing)
                    .map(|(x, _)| x)
                    .collect();
                let holds = facts(engine, "LIES_ON_OR_IN");
                while let Some(under) = open.pop() {
                    if expected.insert(under.clone()) && has_trait(world, &under, "portable") {
                        let over = holds.iter().filter(|(_, y)| *y == under);
                        open.extend(over.map(|(x, _)| x.clone()));
                    }
                }
            }
            // What stands in a bookcase is on its shelves.
            if phrase == "on" && has_trait(world, thing, "shelves") {
                let held = facts(engine, "INSIDE").into_iter().filter(|(_, y)| y == thing);
                expected.extend(held.map(|(x, _)| x));
            }
            score.ask(engine, &format!("What is {phrase} the {word}?"), &|a| {
                sorted(&a.symbols) == expected.iter().map(String::as_str).collect::<Vec<_>>()
            });
        }
    }
    closer(engine, score, &by_word);
}

/// Is X closer to Y than to Z, for things that are the only ones of their kind.
fn closer(engine: &Engine, score: &mut Score, by_word: &BTreeMap<String, BTreeSet<String>>) {
    let world = engine.world().unwrap();
    let relations = engine.relations().unwrap();
    let id = |name: &str| match world.find(name)[..] {
        [Entity::Replica(id)] => Some(id),
        _ => None,
    };
    let single: Vec<(&String, _)> = by_word
        .iter()
        .filter(|(_, things)| things.len() == 1)
        .filter_map(|(word, things)| Some((word, id(things.first()?)?)))
        .take(6)
        .collect();
    for window in single.windows(3) {
        let [(x, a), (y, b), (z, c)] = window else { continue };
        let (near, far) =
            (relations.distance(*a, *b).unwrap(), relations.distance(*a, *c).unwrap());
        let expected = if near < far { Said::Yes } else { Said::No };
        score.ask(engine, &format!("Is the {x} closer to the {y} than to the {z}?"), &|answer| {
            answer.said == expected
        });
    }
}

fn colour_of(world: &World, thing: &str) -> Option<String> {
    let [Entity::Replica(id)] = world.find(thing)[..] else { return None };
    let replica = &world.replicas[&id];
    let object = &world.objects[&replica.object];
    let all = replica.properties.iter().chain(&object.properties);
    let mut all =
        all.filter(|(name, _)| ["цвет", "color", "colour"].contains(&&*name.to_lowercase()));
    all.next().map(|(_, value)| value.clone())
}

fn has_trait(world: &World, thing: &str, wanted: &str) -> bool {
    let [Entity::Replica(id)] = world.find(thing)[..] else { return false };
    let object = &world.objects[&world.replicas[&id].object];
    world.types.object.has_trait(object.object_type, wanted)
}

/// Commands of RoboCup's general purpose grammar, with the things of each house in their places.
#[test]
#[expect(clippy::print_stdout, reason = "grammar coverage is worth seeing")]
fn commands_of_the_competition_are_understood() {
    let (mut asked, mut heard) = (0, 0);
    let mut missed = Vec::new();
    for (_, engine) in houses() {
        let world = engine.world().unwrap();
        let by_word = things_by_word(world);
        let single: Vec<&String> =
            by_word.iter().filter(|(_, t)| t.len() == 1).map(|(w, _)| w).take(12).collect();
        let rooms: Vec<String> = world
            .areas
            .values()
            .map(|a| a.name_en.to_lowercase())
            .filter(|n| !n.is_empty())
            .collect();
        for (n, word) in single.iter().enumerate() {
            let place = single[(n + 1) % single.len()];
            let room = &rooms[n % rooms.len()];
            for command in [
                format!("Could you please bring me the {word}"),
                format!("Go to the {room}"),
                format!("Navigate to the {place}"),
                format!("Robot please take the {word} from the {place}"),
                format!("find the {word} in the {room}"),
                format!("locate the {word}"),
                format!("put the {word} on the {place}"),
                format!("take the {word} and place it on the {place}"),
                format!("go to the {place}, find the {word}, and bring it to me"),
                format!("Please deliver the {word} to me"),
            ] {
                asked += 1;
                match engine.understand(&command) {
                    // "Take the bed from the bookshelf" is understood, and there is none.
                    Ok(_) | Err(Error::Misheard(Misheard::NoneSuch(_))) => heard += 1,
                    Err(e) => missed.push(format!("{command} -> {e}")),
                }
            }
            for question in [
                format!("Tell me how many things there are on the {place}"),
                format!("Tell me what's the biggest object on the {place}"),
                format!("tell me which are the three biggest objects on the {place}"),
                format!("Could you tell me what's the smallest object in the {room}"),
            ] {
                asked += 1;
                match engine.ask(&question, &mut Memory::default()).unwrap() {
                    Ok(_) => heard += 1,
                    Err(e) => missed.push(format!("{question} -> {}", e.text)),
                }
            }
        }
    }
    println!("{heard} of {asked} commands and requests understood");
    for line in missed.iter().take(20) {
        println!("missed: {line}");
    }
    assert!(
        heard * 100 >= asked * 95,
        "{heard} of {asked}: {:#?}",
        &missed[..missed.len().min(20)]
    );
}

#[test]
fn every_name_in_every_case_is_found_again() {
    for (house, engine) in houses().into_iter().take(3) {
        let world = engine.world().unwrap();
        for (entity, name) in world.names() {
            if matches!(entity, Entity::Map(_)) {
                continue;
            }
            let phrase = NounPhrase::parse(name, &WordHints::default());
            let mut forms: BTreeSet<String> =
                Case::ALL.iter().map(|case| phrase.form(*case, phrase.number())).collect();
            forms.insert(phrase.case(Case::Nominative));
            // Names that the map declines by hand are found in the map's own forms.
            let by_hand = match entity {
                Entity::Door(id) => !world.doors[&id].forms.is_empty(),
                Entity::Replica(id) => !world.replicas[&id].forms.is_empty(),
                _ => false,
            };
            if by_hand {
                forms = BTreeSet::from([name.to_owned()]);
            }
            for form in forms {
                for question in
                    [format!("Где находится {form}?"), format!("Опиши {}", form.to_uppercase())]
                {
                    let answer = engine.ask(&question, &mut Memory::default()).unwrap();
                    let found = match answer {
                        Ok(answer) => {
                            answer.text.contains(world.name(entity)) || !answer.symbols.is_empty()
                        }
                        Err(doubt) => doubt.names.iter().any(|n| n == world.name(entity)),
                    };
                    assert!(found, "{house}: {question}");
                }
            }
        }
    }
}

/// A rule that is shown with its predicates numbered, as a program, and the name of its head; or why it is none.
fn numbered(rule: &str, n: usize) -> Result<(String, String), String> {
    let head = if rule.contains("ответ(") { "ответ" } else { "answer" };
    let mut text = format!(".decl {head}(x: Any)\n.output {head}\n{rule}\n");
    if let Err(fault) = RelationRules::with(&Source::new("вопрос", &*text)) {
        return Err(format!("{rule}: {fault}"));
    }
    let declared = rule.split(".decl ").skip(1).filter_map(|d| d.split_once('('));
    let names: Vec<String> =
        declared.map(|(name, _)| name.to_owned()).chain([head.to_owned()]).collect();
    for name in names {
        text = text.replace(&format!("{name}("), &format!("{name}_q{n}("));
    }
    Ok((
        text.replace(&format!(".output {head}\n"), &format!(".output {head}_q{n}\n")),
        format!("{head}_q{n}"),
    ))
}

/// How many of these questions ask for things and are answered by relations alone, and those of them of which the rule that
/// is shown does not give the bindings of the answer.
fn shown_otherwise<'q>(
    engine: &Engine,
    questions: impl IntoIterator<Item = &'q str>,
) -> (usize, Vec<String>) {
    let (mut tried, mut wrong) = (0, Vec::new());
    let (mut program, mut asked) = (String::new(), Vec::new());
    for question in questions {
        let Ok(answer) = engine.ask(question, &mut Memory::default()).unwrap() else {
            continue;
        };
        if !["find", "count"].contains(&answer.query.kind()) {
            continue;
        }
        let rule = engine.rule_of(&answer).unwrap();
        let by_relations = rule.contains(":-")
            && match rule.split_once("//") {
                None => true,
                // What a count does with the things that it finds, and nothing else.
                Some((_, remark)) => {
                    ["сколько таких X", "how many such X"].contains(&remark.trim())
                }
            };
        if !by_relations {
            continue;
        }
        let symbols: BTreeSet<String> = answer.symbols.iter().cloned().collect();
        match numbered(&rule, asked.len()) {
            Ok((text, head)) => {
                program.push_str(&text);
                asked.push((format!("{question}: {rule}"), head, symbols));
            }
            Err(fault) => wrong.push(format!("{question}: {fault}")),
        }
        tried += 1;
    }
    let rules = RelationRules::with(&Source::new("вопросы", &*program)).unwrap();
    let relations = derive(engine.world().unwrap(), &rules, Profile::Surveyed).unwrap();
    for (question, head, symbols) in asked {
        let tuples = relations.tuples(&head).unwrap();
        let found: BTreeSet<String> = tuples.iter().map(|t| t[0].to_string()).collect();
        if found != symbols {
            wrong.push(format!("{question}\n  {found:?}\n  {symbols:?}"));
        }
    }
    (tried, wrong)
}

/// Of every golden question; the ordinary run takes one of three.
#[test]
#[expect(clippy::print_stdout, reason = "the number of rules is worth seeing")]
fn the_rule_shown_gives_the_same_bindings() {
    let (mut tried, mut wrong) = (0, Vec::new());
    let cases = std::fs::read_dir(project("tests/golden/talk")).unwrap();
    let mut cases: Vec<_> = cases.map(|case| case.unwrap().path()).collect();
    cases.sort();
    for case in cases {
        let map = std::fs::read_to_string(case.join("map.txt")).unwrap();
        let Some(engine) = engine(map.trim()) else { continue };
        let questions = std::fs::read_to_string(case.join("questions.txt")).unwrap();
        let questions = questions.lines().map(str::trim).filter(|l| !l.starts_with(['#', '+']));
        let questions = questions.filter(|l| !l.is_empty());
        let (asked, otherwise) =
            shown_otherwise(&engine, questions.step_by(if long() { 1 } else { 3 }));
        tried += asked;
        wrong.extend(otherwise);
    }
    println!("{tried} rules give the bindings of their answers");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(tried >= if long() { 60 } else { 20 }, "{tried}");
}

/// "Neither a bed nor a wardrobe": of what stands in different rooms, and of what stands in the same one.
#[test]
fn the_rule_shown_of_what_has_neither_gives_the_same_bindings() {
    let engine = rb2();
    let kinds = ["bed", "wardrobe", "table", "bookshelf", "lamp", "sofa"];
    let pairs = kinds.iter().flat_map(|one| kinds.iter().map(move |other| (one, other)));
    let questions: Vec<String> = pairs
        .filter(|(one, other)| one != other)
        .map(|(one, other)| format!("Which rooms have neither a {one} nor a {other}?"))
        .collect();
    let (tried, wrong) = shown_otherwise(&engine, questions.iter().map(String::as_str));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(tried > 20, "{tried}");
}

#[test]
fn whatever_is_typed_is_answered_politely() {
    let engine = rb2();
    let endless = "где стол ".repeat(12_000);
    let inputs = [
        "",
        "   ",
        "?",
        "???!!!",
        "😀🎉",
        "где 😀?",
        "\u{0}\u{1}\u{7f}",
        "Где\u{0}стол\u{8}?",
        "Wo ist der Tisch?",
        "где the стол on полка is?",
        "'; DROP TABLE Area; --",
        "SELECT * FROM Object WHERE name = 'стол'",
        "«Где \"стол?",
        "((((((((((",
        "что что что что на на на",
        "не не не не не",
        "и и и или или",
        "is is is the the the",
        "почему почему почему",
        "где она?",
        "12345678901234567890 стульев?",
        "ближе ближе чем чем к к",
        "между между и и",
        "\u{301}\u{301}\u{301}",
        "ﷺﷺﷺ",
        "a\u{300}\u{301}\u{302}",
        endless.as_str(),
    ];
    for input in inputs {
        let mut memory = Memory::default();
        let shown: String = input.chars().take(40).collect();
        for _ in 0..2 {
            let text = said(&engine, input, &mut memory);
            assert!(text.chars().count() > 3 && text.chars().count() < 2_000, "{shown}: {text}");
            assert!(!text.chars().any(char::is_control), "{shown}: {text:?}");
        }
        let _ = engine.understand(input);
        let _ = engine.is_command(input);
    }
    let words: Vec<&str> = "где что на в под стол стулья не ближе чем к и или какой сколько почему она the where is on in than closer which how many чёрный открыта дверь комната-в 3 у от до есть ли самый большой можно сесть ? , «".split(' ').collect();
    for seed in 0_usize..if long() { 3_000 } else { 200 } {
        let text: Vec<&str> = (0..seed % 11)
            .map(|at| words[(seed * 37 + at * at * 13 + at * seed) % words.len()])
            .collect();
        let _ = said(&engine, &text.join(" "), &mut Memory::default());
    }
}

/// Words of orders in any order, with marks between them, one after the other in one dialogue.
#[test]
fn orders_of_stirred_words_do_no_harm() {
    const WORDS: &str = "принеси возьми положи поставь закрой открой запри включи выключи найди иди сходи остановись \
        верни отнеси проверь убедись сделай пусть bring take put close open lock switch turn find go search fetch stop \
        make sure that check home everything whatever is on off and but not except for from the a one any to по кухню \
        чашку красную белую стол столе книгу лекарство зонт дверь Дверь-ZY Комната-В Комнату-Y ключ лампу свет окно \
        не а и или за в на из с со к у где там любую все всё кроме только вторую ещё другую её его cup table book key \
        door light Room window where there red second other it them please пожалуйста робот нет да , . ; ! – ? « \" два 3";
    let words: Vec<&str> = WORDS.split_whitespace().collect();
    let engine = rb2();
    let mut random = crate::planning_properties::random::Random::new(11);
    let mut understood = 0;
    let mut memory = Memory::default();
    let rounds = if long() { 4_000 } else { 300 };
    for _ in 0..rounds {
        let text: Vec<&str> =
            (0..1 + random.below(9)).map(|_| words[random.below(words.len())]).collect();
        let text = text.join(" ");
        understood += usize::from(engine.understand_in(&text, &mut memory).is_ok());
        let _ = engine.is_command(&text);
        let _ = engine.orders_and_questions(&text, &Memory::default());
        let _ = engine.orders_tersely(&text);
        let _ = engine.resumed(&text, &memory);
    }
    assert!(understood * 40 > rounds, "{understood}");
}

#[test]
fn types_that_the_map_lacks_are_unknown_and_plurals_are_found() {
    let engine = rb2();
    let kind = |question: &str| match engine.ask(question, &mut Memory::default()).unwrap() {
        Ok(answer) => answer.said.word(),
        Err(unanswered) => unanswered.doubt.kind(),
    };
    for (question, expected) in [
        ("Где велосипед?", "unknown"),
        ("Сколько велосипедов в доме?", "unknown"),
        ("Where is the bicycle?", "unknown"),
        ("Какого цвета стул?", "ambiguous"),
        ("Где зелёный стул?", "unknown"),
        ("Стул-1 прыгает?", "not_understood"),
        ("Сколько в Комнате-Y стульев?", "nothing"),
        ("Есть ли в Комнате-Y стулья?", "no"),
    ] {
        assert_eq!(kind(question), expected, "{question}");
    }
    let phrase = NounPhrase::parse("Стул", &WordHints::default());
    assert_eq!(phrase.form(Case::Genitive, Number::Plural), "Стульев");
}

/// In the notation of the rules every fact is affirmed and proved, and a name that the map does not know is told, whichever
/// place it has.
#[test]
fn facts_in_the_notation_of_the_rules_are_asked_after() {
    let engine = rb2();
    let relations = engine.relations().unwrap();
    let mut asked = 0;
    for relation in ["ON_TOP_OF", "INSIDE", "НАХОДИТСЯ_СВЕРХУ_НА", "JOINS", "IN_CORNER"]
    {
        for tuple in relations.tuples(relation).unwrap().into_iter().take(12) {
            let names: Vec<String> = tuple.iter().map(ToString::to_string).collect();
            let fact = |names: &[String]| format!("{relation}({})", names.join(", "));
            for (before, kind) in [("", Said::Yes), ("why ", Said::Found), ("почему ", Said::Found)]
            {
                let question = format!("{before}{}", fact(&names));
                let answer = engine.ask(&question, &mut Memory::default()).unwrap();
                let answer = answer.unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text));
                assert_eq!(answer.said, kind, "{question}: {}", answer.text);
                assert!(answer.facts[0].holds, "{question}");
            }
            for place in 0..names.len() {
                let mut wrong = names.clone();
                wrong[place] = "Нет-1".to_owned();
                for before in ["", "why ", "why not ", "почему ", "почему не "] {
                    let question = format!("{before}{}", fact(&wrong));
                    let doubt = engine.ask(&question, &mut Memory::default()).unwrap();
                    let doubt = doubt.expect_err(&question);
                    assert_eq!(doubt.doubt.kind(), "unknown", "{question}: {}", doubt.text);
                    assert!(doubt.text.contains("Нет-1"), "{question}: {}", doubt.text);
                }
            }
            asked += 1;
        }
    }
    assert!(asked > 20, "{asked}");
    for (question, text) in [
        ("ON_TOP_OF(Стол-1, Чашка-1)?", "No, Table 1 is not on Cup 1."),
        ("почему FOO_BAR(Стол-1)", "На карте нет ничего, что называлось бы «FOO_BAR»."),
        ("why ON_TOP_OF(Стол-1)", "I do not understand \"ON_TOP_OF(Стол-1)\"."),
    ] {
        let said = said(&engine, question, &mut Memory::default());
        assert!(said.ends_with(text), "{question}: {said}");
    }
}
