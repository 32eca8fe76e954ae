//! What one sentence joins, held against what its parts come to by themselves: two things that a room has, two claims with
//! one verb, several rooms, several things that are of a kind; and that an answer keeps to its language.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::question::{Answer, Said};
use orthoframe_language::report::Named;
use orthoframe_language::{Case, Language, Number, english};
use orthoframe_map::World;
use orthoframe_robot::GoalFact;

use crate::files::{long, project};
use crate::talk::engine;

const HOUSE: &str = "../shared/data/procthor/house_5.json";
const FLAT: &str = "../shared/data/virtualhome/TestScene3_graph.json";

fn ask(engine: &Engine, line: &str) -> Option<Answer> {
    engine.ask(line, &mut Memory::default()).expect("there is a map").ok()
}

fn symbols(engine: &Engine, line: &str) -> Option<BTreeSet<String>> {
    Some(ask(engine, line)?.symbols.into_iter().collect())
}

/// The English names of rooms and of the kinds of things, each as it is in a sentence.
fn rooms_and_kinds(engine: &Engine) -> (Vec<String>, Vec<String>) {
    let world = engine.world().unwrap();
    let rooms = world.areas.values().map(|area| area.name_en.clone()).collect();
    let kinds: BTreeSet<String> = world
        .replicas
        .values()
        .filter_map(|replica| {
            let kind = world.objects[&replica.object].object_type;
            Some(world.types.object.get(kind)?.name_en.to_lowercase())
        })
        .collect();
    (rooms, kinds.into_iter().step_by(if long() { 1 } else { 3 }).collect())
}

/// "Which rooms have a sink and a window?": those that have both.
#[test]
fn a_room_with_two_things_has_both() {
    let mut told = 0;
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let (_, kinds) = rooms_and_kinds(&engine);
        let of = |kind: &str| symbols(&engine, &format!("Which rooms have a {kind}?"));
        for pair in kinds.windows(2) {
            let [one, other] = pair else { continue };
            let (Some(first), Some(second)) = (of(one), of(other)) else { continue };
            let both: BTreeSet<String> = first.intersection(&second).cloned().collect();
            for line in [
                format!("Which rooms have a {one} and a {other}?"),
                format!("Which rooms are there with a {one} and a {other}?"),
            ] {
                let Some(found) = ask(&engine, &line) else { continue };
                let symbols: BTreeSet<String> = found.symbols.into_iter().collect();
                assert_eq!(symbols, both, "{line}: {}", found.text);
                told += 1;
            }
            let line = format!("Is there a room with a {one} and a {other}?");
            let Some(found) = ask(&engine, &line) else { continue };
            assert_eq!(found.said == Said::Yes, !both.is_empty(), "{line}: {}", found.text);
            told += 1;
        }
    }
    assert!(told > 20, "{told}");
}

/// "Is there a sink in the kitchen and a window?", "…, or any windows?": the second is sought where the first is.
#[test]
fn what_is_any_of_its_kind_is_sought_as_the_first() {
    let mut told = 0;
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let (rooms, kinds) = rooms_and_kinds(&engine);
        let has = |room: &str, kind: &str| {
            ask(&engine, &format!("Is there a {kind} in {room}?")).map(|answer| answer.said)
        };
        for (n, pair) in kinds.windows(2).enumerate() {
            let ([one, other], room) = (pair, &rooms[n % rooms.len()]) else { continue };
            let (Some(first), Some(second)) = (has(room, one), has(room, other)) else { continue };
            let (first, second) = (first == Said::Yes, second == Said::Yes);
            for (line, is_so) in [
                (format!("Is there a {one} in {room} and a {other}?"), first && second),
                (format!("Is there any {one} in {room}, and any {other}?"), first && second),
                (format!("Is there a {one} in {room} or a {other}?"), first || second),
            ] {
                let Some(found) = ask(&engine, &line) else { continue };
                assert_eq!(found.said == Said::Yes, is_so, "{line}: {}", found.text);
                told += 1;
            }
        }
    }
    assert!(told > 40, "{told}");
}

/// "How many sinks are in the kitchen? And how many windows?", in one sentence or two: both are counted there.
#[test]
fn what_is_counted_next_is_counted_there() {
    let mut told = 0;
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let (rooms, kinds) = rooms_and_kinds(&engine);
        for (n, pair) in kinds.windows(2).enumerate() {
            let ([one, other], room) = (pair, &rooms[n % rooms.len()]) else { continue };
            let first = format!("How many {one}s are in {room}");
            let alone = ask(&engine, &format!("How many {other}s are in {room}?"));
            let (Some(alone), Some(before)) = (alone, ask(&engine, &first)) else { continue };
            // A plural that is not so formed.
            if [&alone, &before].iter().any(|answer| answer.text.starts_with("Understood")) {
                continue;
            }
            let mut memory = Memory::default();
            engine.ask(&first, &mut memory).expect("there is a map").expect("it was answered");
            let next = engine.ask(&format!("And how many {other}s?"), &mut memory).unwrap();
            let Ok(next) = next else { continue };
            assert_eq!(next.text, alone.text, "{first}? And how many {other}s?");
            let both = ask(&engine, &format!("{first}, and how many {other}s?"));
            let ends_so = |both: Answer| both.text.ends_with(&alone.text);
            assert!(both.is_none_or(ends_so), "{first}, and how many {other}s?");
            told += 1;
        }
    }
    assert!(told > 15, "{told}");
}

/// «Сколько раковин на кухне, а окон?» is as «Сколько раковин на кухне?» and «А окон?»; of what hangs, what stands and lies
/// is not told apart, and half a question is never answered as the whole.
#[test]
fn what_is_asked_of_something_else_is_asked_as_before() {
    let mut told = 0;
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let rooms: Vec<&str> = world.areas.values().map(|area| area.name.as_str()).collect();
        let kinds: BTreeSet<Vec<&str>> = world
            .replicas
            .values()
            .filter_map(|replica| {
                let kind = world.objects[&replica.object].object_type;
                let name = &world.types.object.get(kind)?.name;
                name.chars().all(char::is_alphabetic).then(|| vec![name.as_str()])
            })
            .collect();
        let many = |kind: &str| {
            let named = Named::plain(&kind.to_lowercase());
            named.phrase().form(Case::Genitive, Number::Plural)
        };
        let kinds: Vec<String> = kinds.iter().map(|kind| many(kind[0])).collect();
        for (n, pair) in kinds.windows(2).enumerate() {
            let ([one, other], room) = (pair, rooms[n % rooms.len()]) else { continue };
            let first = format!("Сколько {one} в помещении «{room}»");
            let mut memory = Memory::default();
            let Ok(before) = engine.ask(&format!("{first}?"), &mut memory).unwrap() else {
                continue;
            };
            let Ok(next) = engine.ask(&format!("А {other}?"), &mut memory).unwrap() else {
                continue;
            };
            let line = format!("{first}, а {other}?");
            let both = ask(&engine, &line).map(|answer| answer.text);
            assert_eq!(both, Some(format!("{} {}", before.text, next.text)), "{line}");
            let line = format!("Сколько {one} висит, а сколько лежит?");
            assert!(ask(&engine, &line).is_none(), "{line}");
            told += 1;
        }
    }
    assert!(told > 10, "{told}");
}

/// "Does the bedroom have a window and the kitchen a fridge?": each room by itself, or not understood.
#[test]
fn the_verb_of_one_claim_is_that_of_the_next() {
    let mut told = 0;
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let (rooms, kinds) = rooms_and_kinds(&engine);
        let has = |room: &str, kind: &str| {
            ask(&engine, &format!("Does {room} have a {kind}?")).map(|a| a.said)
        };
        for (n, pair) in kinds.windows(2).enumerate() {
            let (one, other) = (&rooms[n % rooms.len()], &rooms[(n + 1) % rooms.len()]);
            let (Some(first), Some(second)) = (has(one, &pair[0]), has(other, &pair[1])) else {
                continue;
            };
            let line = format!("Does {one} have a {} and {other} a {}?", pair[0], pair[1]);
            let Some(both) = ask(&engine, &line) else { continue };
            let alone = |line: String| ask(&engine, &line).map(|a| a.text).unwrap_or_default();
            let texts = [
                alone(format!("Does {one} have a {}?", pair[0])),
                alone(format!("Does {other} have a {}?", pair[1])),
            ];
            assert_eq!(both.text, texts.join(" "), "{line} {first:?} {second:?}");
            told += 1;
        }
    }
    assert!(told > 5, "{told}");
}

/// "Are there lamps in the bathroom, the kitchen and the hall?": whether there are in any of them.
#[test]
fn several_rooms_are_told_in_a_list() {
    let mut told = 0;
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let (rooms, kinds) = rooms_and_kinds(&engine);
        let [one, two, three, ..] = &rooms[..] else { continue };
        for kind in &kinds {
            let within = |room: &str| symbols(&engine, &format!("Which {kind} is in {room}?"));
            let each = [one, two, three].map(|room| within(room));
            let [Some(a), Some(b), Some(c)] = each else { continue };
            let all: BTreeSet<String> = a.into_iter().chain(b).chain(c).collect();
            let line = format!("Which {kind} is in {one}, {two} and {three}?");
            let Some(found) = ask(&engine, &line) else { continue };
            let symbols: BTreeSet<String> = found.symbols.into_iter().collect();
            assert_eq!(symbols, all, "{line}: {}", found.text);
            told += 1;
        }
    }
    assert!(told > 5, "{told}");
}

/// "How many of the things on the counter are knives?": as many as there are knives on the counter.
#[test]
fn things_that_are_of_a_kind_are_counted_as_the_kind() {
    let mut told = 0;
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let (rooms, kinds) = rooms_and_kinds(&engine);
        for (n, kind) in kinds.iter().enumerate() {
            let kinds = orthoframe_language::english::plural(kind);
            let room = &rooms[n % rooms.len()];
            let plain = ask(&engine, &format!("How many {kinds} are in {room}?"));
            let Some(plain) = plain.and_then(|answer| answer.number) else { continue };
            for line in [
                format!("How many of the things in {room} are {kinds}?"),
                format!("How many things in {room} are {kinds}?"),
            ] {
                let Some(found) = ask(&engine, &line) else { continue };
                assert_eq!(found.number, Some(plain), "{line}: {}", found.text);
                told += 1;
            }
        }
        for room in &rooms {
            let plain = symbols(&engine, &format!("Which rooms are connected to {room}?"));
            let counted = ask(&engine, &format!("How many rooms are connected to {room}?"));
            let (Some(plain), Some(counted)) = (plain, counted) else { continue };
            assert_eq!(counted.number, Some(plain.len() as f64), "{room}: {}", counted.text);
            told += 1;
        }
    }
    assert!(told > 20, "{told}");
}

/// "Which rooms have lamps? Turn off the lamps in them", «Выключи их»: in each of the rooms.
#[test]
fn they_are_all_that_were_told() {
    let Some(engine) = engine(FLAT) else { return };
    let lamps = symbols(&engine, "Which lamps are there?").expect("a plain question");
    for (question, order) in [
        ("Which rooms have lamps?", "Turn off the lamps in them"),
        ("Which rooms have lamps?", "Switch them off"),
        ("В каких комнатах есть лампы?", "Выключи их"),
        ("В каких комнатах есть лампы?", "Включи лампы в них"),
    ] {
        let mut memory = Memory::default();
        engine.ask(question, &mut memory).expect("there is a map").expect("a plain question");
        let Ok(commands) = engine.understand_in(order, &mut memory) else { continue };
        assert_eq!(commands.len(), lamps.len(), "{question} {order}: {commands:?}");
    }
}

/// "Is the stove shut, and is it on?", "How many cups are there, and are there any in the kitchen?": both are answered, each
/// as by itself; and a second one is two of them.
#[test]
fn of_two_questions_in_one_sentence_none_is_dropped() {
    let (mut told, mut counted) = (0, 0);
    for map in [HOUSE, FLAT] {
        let Some(engine) = engine(map) else { return };
        let text = |line: &str| ask(&engine, line).map(|answer| answer.text);
        let world = engine.world().unwrap();
        let devices = world.replicas.values().filter(|r| world.has_trait(r.id, "device"));
        for name in devices.map(|device| &device.name_en) {
            for (one, other) in [("on", "closed"), ("closed", "on"), ("clean", "on")] {
                let alone = [one, other].map(|state| text(&format!("Is {name} {state}?")));
                let [Some(first), Some(second)] = alone else { continue };
                for line in [
                    format!("Is {name} {one}, and is it {other}?"),
                    format!("Is {name} {one} and is it {other}?"),
                ] {
                    let Some(both) = text(&line) else { continue };
                    assert_eq!(both, format!("{first} {second}"), "{line}");
                    told += 1;
                }
            }
        }
        let (rooms, kinds) = rooms_and_kinds(&engine);
        for (n, kind) in kinds.iter().enumerate() {
            let (many, room) = (english::plural(kind), &rooms[n % rooms.len()]);
            let (Some(all), Some(there)) = (
                ask(&engine, &format!("How many {many} are there?")),
                ask(&engine, &format!("Are there any {many} in {room}?")),
            ) else {
                continue;
            };
            let line = format!("How many {many} are there and are there any in {room}?");
            if let Some(both) = text(&line) {
                assert!(both.starts_with(&all.text), "{line}: {both}");
                let says_yes = both.contains(" Yes, ");
                assert_eq!(says_yes, there.said == Said::Yes, "{line}: {both}");
                counted += 1;
            }
            let second = ask(&engine, &format!("Is there a second {kind}?"));
            if let (Some(second), Some(number)) = (second, all.number) {
                assert_eq!(second.said == Said::Yes, number > 1.0, "{kind}: {}", second.text);
                counted += 1;
            }
        }
    }
    assert!(told > 10 && counted > 20, "{told} {counted}");
}

/// The goals of an order on a map; none where it is refused.
fn goals(world: &World, order: &str) -> Option<Vec<GoalFact>> {
    let engine = Engine::in_memory(world.clone(), None).expect("a map of the tests");
    engine.perform(order, &mut |_| {}).ok().map(|answer| answer.goal)
}

/// What is said of things, and the words that go with it.
type Pairs<'a> = &'a [(&'a str, &'a str)];

/// "Get the battery and the toolbox and put them on the desk": what is taken to be put somewhere is neither handed over
/// first nor held, whichever verbs say so.
#[test]
fn a_taking_is_part_of_the_placing_behind_it() {
    let lab = World::load(project("maps/lab.toml")).unwrap();
    let flat = crate::worlds::rb2();
    let ends =
        |(world, takes, things, joints, puts): (&World, &[&str], Pairs<'_>, &[&str], Pairs<'_>)| {
            let mut told = 0;
            for (n, take) in takes.iter().enumerate() {
                for (m, (put, to)) in puts.iter().enumerate() {
                    let (named, them) = things[(n + m) % things.len()];
                    let joint = joints[(n + m) % joints.len()];
                    let plain =
                        goals(world, &format!("{put} {named} {to}")).expect("a plain order");
                    let line = format!("{take} {named}{joint}{put} {them} {to}");
                    assert_eq!(goals(world, &line), Some(plain), "{line}");
                    told += 1;
                }
            }
            told
        };
    let told = ends((
        &lab,
        &[
            "Get",
            "Take",
            "Grab",
            "Pick up",
            "Fetch",
            "Collect",
            "Clear away",
            "Please get",
            "Go and get",
        ],
        &[
            ("the battery and the toolbox", "them"),
            ("the battery", "it"),
            ("the toolbox and the battery", "both"),
        ],
        &[" and ", ", then ", ", ", " and then "],
        &[("put", "on the desk"), ("place", "on Shelf 1"), ("set", "on Workbench 1")],
    ));
    let said = ends((
        &flat,
        &["Возьми", "Забери", "Захвати", "Подними", "Собери", "Пожалуйста, возьми", "Принеси"],
        &[
            ("Книгу-4 и лекарство", "их"),
            ("лекарство", "его"),
            ("все чашки", "их"),
            ("лекарство, Книгу-4", "их"),
        ],
        &[" и ", ", потом ", ", ", ", а затем "],
        &[("поставь", "на письменный стол"), ("положи", "на Комод-1"), ("отнеси", "на диван")],
    ));
    assert_eq!(told + said, 27 + 21);
}

/// A list before a mark belongs to the verb before it: "Take the battery and the toolbox, go to the lab and …".
#[test]
fn what_is_listed_before_a_mark_goes_with_the_verb_before_it() {
    let (lab, flat) = (World::load(project("maps/lab.toml")).unwrap(), crate::worlds::rb2());
    for (world, one, other) in [
        (
            &lab,
            "Take the battery and the toolbox, go to the lab and put them on Workbench 1",
            "Go to the lab, put the battery on Workbench 1, put the toolbox on Workbench 1",
        ),
        (
            &lab,
            "Get the battery, go to the lab and put it on Workbench 1",
            "Take the battery, go to the lab, put the battery on Workbench 1",
        ),
        (
            &flat,
            "Возьми лекарство и Книгу-4, поезжай в спальню и положи их на Комод-1",
            "Поезжай в спальню, положи лекарство на Комод-1, положи Книгу-4 на Комод-1",
        ),
    ] {
        assert_eq!(goals(world, one), goals(world, other), "{one}");
        assert!(goals(world, one).is_some(), "{one}");
    }
}

/// Names of the map, and what stands in quotes or was said, may be in any language; nothing else.
#[test]
fn an_answer_keeps_to_its_language() {
    let mut told = [0; 2];
    for case in std::fs::read_dir(project("tests/golden/talk")).unwrap() {
        let case = case.unwrap().path();
        let map = std::fs::read_to_string(case.join("map.txt")).unwrap();
        let questions = std::fs::read_to_string(case.join("questions.txt")).unwrap();
        let Some(engine) = engine(map.trim()) else { continue };
        let names = names(&engine);
        let mut memory = Memory::default();
        for line in questions.lines().map(str::trim).filter(|l| !l.starts_with('#')) {
            let line = line.trim_start_matches(['+', ' ']);
            let Ok(answer) = engine.ask(line, &mut memory).expect("there is a map") else {
                continue;
            };
            let foreign = foreign(&answer.text, &names, line, answer.language);
            assert_eq!(foreign, None, "{line}: {}", answer.text);
            told[usize::from(answer.language == Language::English)] += 1;
        }
    }
    for line in ["Are the beds the same size?", "What do Bed 1 and Bed 2 have in common?"] {
        let Some(engine) = engine(FLAT) else { return };
        let answer = ask(&engine, line).expect("both beds have a size");
        let foreign = foreign(&answer.text, &[], line, Language::English);
        assert_eq!(foreign, None, "{line}: {}", answer.text);
    }
    assert!(told.iter().all(|told| *told > 200), "{told:?}");
}

fn names(engine: &Engine) -> Vec<String> {
    let world = engine.world().unwrap();
    let of_things = world.replicas.values().flat_map(|r| [r.name.clone(), r.name_en.clone()]);
    let of_rooms = world.areas.values().flat_map(|a| [a.name.clone(), a.name_en.clone()]);
    let of_doors = world.doors.values().flat_map(|d| [d.name.clone(), d.name_en.clone()]);
    let of_places = world.places.values().flat_map(|p| [p.name.clone(), p.name_en.clone()]);
    let of_storeys = world.maps.values().flat_map(|m| [m.name.clone(), m.name_en.clone()]);
    of_things.chain(of_rooms).chain(of_doors).chain(of_places).chain(of_storeys).collect()
}

/// The first word of a text in the letters of another language that neither a name nor the question has.
fn foreign(text: &str, names: &[String], question: &str, language: Language) -> Option<String> {
    let is_foreign = |c: char| match language {
        Language::English => ('а'..='я').contains(&c) || ('А'..='Я').contains(&c),
        Language::Russian => c.is_ascii_alphabetic(),
    };
    let words = text.split(|c: char| !c.is_alphanumeric());
    let mut foreign = words.filter(|word| word.chars().any(is_foreign));
    let known = |word: &str| question.contains(word) || names.iter().any(|n| n.contains(word));
    foreign.find(|word| !known(word)).map(str::to_owned)
}
