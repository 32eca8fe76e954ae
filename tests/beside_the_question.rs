//! What stands beside what is asked: where the person is, what was not understood before; and what was is not what is.

use std::collections::BTreeMap;

use orthoframe::Engine;
use orthoframe::engine::{After, Dialogue, Memory, change_now};
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::{Entity, Replica, World};
use orthoframe_store::Seen;
use orthoframe_units::ReplicaId;

use crate::files::{long, shared};
use crate::talk::engine;

const HOUSE: &str = "procthor/house_8.json";

fn house() -> Option<Engine> {
    engine(&format!("../shared/data/{HOUSE}"))
}

fn answer(engine: &Engine, line: &str, memory: &mut Memory) -> Option<String> {
    Some(engine.ask(line, memory).expect("there is a map").ok()?.text)
}

/// What is answered, without what was understood before it.
fn plainly(text: &str) -> &str {
    let understood = ["Understood as “", "Понял так: «"].iter().any(|lead| text.starts_with(lead));
    let rest = text.split_once(['”', '»']).map(|(_, rest)| rest.trim());
    rest.filter(|_| understood).unwrap_or(text)
}

fn portable(world: &World) -> impl Iterator<Item = &Replica> {
    let step = if long() { 1 } else { 5 };
    world.replicas.values().filter(|r| world.has_trait(r.id, "portable")).step_by(step)
}

fn form(world: &World, entity: Entity, case: Case) -> String {
    NounPhrase::parse(world.name(entity), &names::hints(world, entity)).case(case)
}

/// «Я на кухне, а …»: what follows is answered as it is behind «Я на кухне.», or not at all; what follows and is not
/// understood is not passed over.
#[test]
fn where_the_person_is_swallows_nothing_and_bounds_nothing() {
    let Some(engine) = house() else { return };
    let world = engine.world().unwrap();
    let relations = engine.relations().unwrap();
    let (mut asked, mut told) = (0, 0);
    for area in world.areas.values() {
        let room = form(world, Entity::Area(area.id), Case::Prepositional);
        let stays = [(format!("Я в {room}"), true), (format!("I'm in {}", area.name_en), false)];
        for thing in portable(world) {
            let Some(on) = relations.support_of(thing.id) else { continue };
            let on = &world.replicas[&on];
            let place = form(world, Entity::Replica(on.id), Case::Prepositional);
            for (stay, russian) in &stays {
                let questions = match russian {
                    true => [
                        format!(", а {} лежит на {place}?", thing.name),
                        format!(" и хочу знать, где {}?", thing.name),
                    ],
                    false => [
                        format!(", but is {} on {}?", thing.name_en, on.name_en),
                        format!(" and I want to know where {} is", thing.name_en),
                    ],
                };
                for question in questions {
                    let mut memory = Memory::default();
                    answer(&engine, &format!("{stay}."), &mut memory).expect("where they are");
                    let bare = question.trim_start_matches([',', ' ']);
                    let (_, bare) = bare.split_once(' ').expect("a joint");
                    let alone = answer(&engine, bare, &mut memory);
                    let line = format!("{stay}{question}");
                    let whole = answer(&engine, &line, &mut Memory::default());
                    asked += 1;
                    told += usize::from(whole.is_some());
                    let alike =
                        |text: &String| alone.as_deref().map(plainly) == Some(plainly(text));
                    assert!(whole.as_ref().is_none_or(alike), "{line}: {whole:?}, {alone:?}");
                }
                let wishes = match russian {
                    true => [
                        format!(", а {} бы сюда", thing.name),
                        format!(" и нужен мне {}", thing.name),
                        format!(", а {} грумкает", thing.name),
                    ],
                    false => [
                        format!(" and would love {} here", thing.name_en),
                        format!(" and need {} badly", thing.name_en),
                        format!(", but {} is groomy", thing.name_en),
                    ],
                };
                for wish in wishes {
                    let line = format!("{stay}{wish}");
                    let heard = answer(&engine, &line, &mut Memory::default());
                    let only_place = |text: &String| {
                        text.starts_with("Понял, где вы") || text.starts_with("I see where you are")
                    };
                    assert!(!heard.as_ref().is_some_and(only_place), "{line}: {heard:?}");
                }
            }
        }
    }
    assert!(told * 10 > asked * 8, "{told} of {asked}");
}

/// A line that is not understood changes no later answer: it is the same, or none.
#[test]
fn what_is_not_understood_changes_no_later_answer() {
    let Some(engine) = house() else { return };
    let world = engine.world().unwrap();
    let unheard = ["Бубубу грумкает жваково?", "Are the groomy zorbs flarking?", "Я имел грумк"];
    let later = [
        ("Что ещё там лежит?", "What else is there?"),
        ("А сколько там ручек?", "How many pens are in there?"),
        ("В какой это комнате?", "Which room is that in?"),
    ];
    let mut told = 0;
    for thing in portable(world) {
        let first = [format!("Где {}?", thing.name), format!("Where is {}?", thing.name_en)];
        let mut before = Memory::default();
        for (n, first) in first.iter().enumerate() {
            answer(&engine, first, &mut before);
            for line in later {
                let line = if n == 0 { line.0 } else { line.1 };
                let plain = answer(&engine, line, &mut before.clone());
                told += usize::from(plain.is_some());
                for unheard in unheard {
                    let mut memory = before.clone();
                    if answer(&engine, unheard, &mut memory).is_some() {
                        continue;
                    }
                    let after = answer(&engine, line, &mut memory);
                    assert!(
                        after.is_none() || after == plain,
                        "{first} {unheard} {line}: {after:?}"
                    );
                }
            }
        }
    }
    assert!(told > 10, "{told}");
}

/// "There" behind several things that are in several places is nowhere, and «А на втором?» is a storey where one was asked of.
#[test]
fn there_is_no_place_that_nobody_spoke_of() {
    let Some(clinic) = engine("../shared/data/rmf/clinic.building.yaml") else { return };
    for (lines, line) in [
        (["Сколько медсестёр?"], "А капельниц там сколько?"),
        (["How many nurses are there?"], "How many IV stands are in there?"),
    ] {
        let mut memory = Memory::default();
        for line in lines {
            answer(&clinic, line, &mut memory).expect("a plain question");
        }
        assert_eq!(answer(&clinic, line, &mut memory), None, "{line}");
    }
    let kinds = [("пациентов", "patients"), ("медсестёр", "nurses"), ("капельниц", "IV stands")];
    for (russian, english) in kinds {
        for (first, on, whole) in [
            (
                format!("Сколько {russian} на первом этаже?"),
                "А на втором?",
                format!("Сколько {russian} на втором этаже?"),
            ),
            (
                format!("How many {english} are on the first floor?"),
                "And on the second?",
                format!("How many {english} are on the second floor?"),
            ),
        ] {
            let mut memory = Memory::default();
            answer(&clinic, &first, &mut memory).expect("a plain question");
            let whole = answer(&clinic, &whole, &mut Memory::default());
            assert!(whole.is_some());
            assert_eq!(answer(&clinic, on, &mut memory), whole, "{first} {on}");
        }
    }
}

/// "Where was it?" of what was moved tells its former place, and of what was there then nothing is told by how it is now.
#[test]
fn what_was_moved_was_where_it_was() {
    let Some(path) = shared(HOUSE) else { return };
    let dir = tempfile::TempDir::new().unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    engine.import(&path, &change_now("test", "")).unwrap();
    let surveyed = engine.relations().unwrap().clone();
    let world = engine.world().unwrap().clone();
    let moved: Vec<ReplicaId> = portable(&world)
        .map(|thing| thing.id)
        .filter(|thing| surveyed.support_of(*thing).is_some())
        .collect();
    let mut told = 0;
    for pair in moved.windows(2) {
        let [thing, other] = [pair[0], pair[1]].map(|id| &world.replicas[&id]);
        let [was, is] = pair else { continue };
        let [was, is] = [was, is].map(|id| surveyed.support_of(*id).expect("it lies on something"));
        if was == is || surveyed.is_inside(thing.id, was) {
            continue;
        }
        let there = Seen { area: other.area, frame: other.frame };
        let moved = BTreeMap::from([(thing.id, Some(there))]);
        let after = After { moved, sure: 1.0, ..After::default() };
        engine.remember_after(&after, std::time::SystemTime::now().into()).unwrap();
        let (old, new) = (&world.replicas[&was], &world.replicas[&is]);
        for (question, old, new) in [
            (format!("Где раньше был {}?", thing.name), None, &new.name),
            (format!("Where was {}?", thing.name_en), Some(&old.name_en), &new.name_en),
            (format!("Where was {} before?", thing.name_en), Some(&old.name_en), &new.name_en),
        ] {
            let text = answer(&engine, &question, &mut Memory::default()).expect("its history");
            assert!(old.is_none_or(|old| text.contains(&**old)), "{question}: {text}");
            assert!(!text.contains(&format!("on {new} ")), "{question}: {text}");
        }
        for question in [
            format!("What was on {}?", old.name_en),
            format!("Что лежало на {}?", form(&world, Entity::Replica(was), Case::Prepositional)),
            format!("What was {} next to?", thing.name_en),
            format!("Was {} on {}?", thing.name_en, old.name_en),
        ] {
            let text = answer(&engine, &question, &mut Memory::default());
            assert_eq!(text, None, "{question}");
        }
        told += 1;
    }
    assert!(told > 3, "{told}");
}

/// "Got a pen or a pencil around?" is "Is there a pen or a pencil?", and a claim behind a comma is one of its own.
#[test]
fn what_is_left_unsaid_makes_no_other_question() {
    let Some(engine) = house() else { return };
    let pairs = [
        ("Got a fork or a spoon?", "Is there a fork or a spoon?"),
        ("Got a fork around?", "Is there a fork?"),
        ("I need to write something down, got a pen around?", "Is there a pen?"),
        ("I need something to write with, got a fork or a spoon?", "Is there a fork or a spoon?"),
        ("What does the fridge have?", "What is in the fridge?"),
        ("What has the fridge got?", "What is in the fridge?"),
        (
            "Is the laptop on the dresser on, the fridge closed?",
            "Is the laptop on the dresser on? Is the fridge closed?",
        ),
        (
            "Ноутбук на комоде открыт, холодильник закрыт?",
            "Ноутбук на комоде открыт? Холодильник закрыт?",
        ),
        ("I'm peckish - is there a tomato in the kitchen?", "Is there a tomato in the kitchen?"),
    ];
    for (line, whole) in pairs {
        let said = answer(&engine, line, &mut Memory::default());
        let whole = answer(&engine, whole, &mut Memory::default());
        let alike = |text: &String| whole.as_deref().map(plainly) == Some(plainly(text));
        assert!(said.as_ref().is_none_or(alike), "{line}: {said:?}, {whole:?}");
    }
    // "Where is it?" of several that were found somewhere is where these are.
    let mut memory = Memory::default();
    let found = answer(&engine, "Is there any chair in the bedroom?", &mut memory).unwrap();
    assert!(found.contains("Chair"), "{found}");
    let place = answer(&engine, "Where is it?", &mut memory).expect("they have a place");
    assert!(place.starts_with("Chair"), "{place}");
    // Where there is none, where the others are.
    let mut memory = Memory::default();
    let none = answer(&engine, "Is there a phone in the kitchen?", &mut memory).unwrap();
    assert!(none.starts_with("No"), "{none}");
    let place = answer(&engine, "Where is it?", &mut memory).expect("they have a place");
    assert!(place.contains("Phone") && !place.contains("one gets to"), "{place}");
}

/// What is told before or behind a question neither joins what is asked for nor takes its place, and a greeting before a wish
/// makes no order of what is asked behind it.
#[test]
fn what_is_told_beside_a_question_is_not_asked_for() {
    let Some(mut engine) = house() else { return };
    let pairs = [
        (
            "I need a spoon, are there any eggs in the kitchen?",
            "Are there any eggs in the kitchen?",
        ),
        ("Ложка нужна, на кухне есть яйца?", "На кухне есть яйца?"),
        ("They ate it all, I guess, but how many eggs are there?", "How many eggs are there?"),
        ("Where's the spoon? Not the fork, the spoon.", "Where's the spoon?"),
        ("Where did we put the pencil?", "Where is the pencil?"),
        ("Where have they put the pencil?", "Where is the pencil?"),
        ("Доброе утро! Хочу омлет, в какой комнате холодильник?", "В какой комнате холодильник?"),
    ];
    for (line, whole) in pairs {
        let mut hear = |line: &str| {
            let mut dialogue = Dialogue::default().keeping_nothing();
            let heard = dialogue.hear(&mut engine, line, &mut |_, _| {}).expect("there is a map");
            heard.replies.iter().map(|r| r.text.clone()).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(plainly(&hear(line)), plainly(&hear(whole)), "{line}");
    }
    // Which table is meant is asked back; what is asked behind it does not stand in its noun's place.
    let asked = "How many eggs are on the dining table, no wait, how many cups?";
    assert_eq!(answer(&engine, asked, &mut Memory::default()), None);
}

/// "Which office chair is closest to you?": what kind of thing it is does not say from where.
#[test]
fn the_nearest_is_nearest_to_what_is_said() {
    let Some(engine) = engine("../shared/data/rmf/clinic.building.yaml") else { return };
    let nearest = |line: &str| {
        let answer = engine.ask(line, &mut Memory::default()).expect("there is a map");
        answer.expect("it is understood").symbols
    };
    let told = nearest("Which office chair is closest to you?");
    assert!(told.len() == 1 && told == nearest("Which office chair is the closest?"), "{told:?}");
}
