//! Of which things a question goes on to ask: of those that were listed, of the rooms that were counted, of the whole map;
//! and its number is that of these.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::english;
use orthoframe_language::question::Answer;
use orthoframe_map::World;

use crate::talk::engine;

const MAPS: [&str; 3] = [
    "../shared/data/procthor/house_2.json",
    "../shared/data/procthor/house_7.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

/// An answer to what goes on from a dialogue, which it does not change.
fn ask(engine: &Engine, question: &str, memory: &Memory) -> Answer {
    let answer = engine.ask(question, &mut memory.clone()).expect("there is a map");
    answer.unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text))
}

pub(crate) fn names(answer: &Answer) -> BTreeSet<String> {
    answer.symbols.iter().cloned().collect()
}

/// The English name of the kind of a thing.
pub(crate) fn kind(world: &World, name: &str) -> String {
    let replica = world.replicas.values().find(|replica| replica.name == name).expect("a thing");
    let kind = world.types.object.get(world.objects[&replica.object].object_type);
    kind.expect("a kind").name_en.to_lowercase()
}

/// What lies on each thing that bears several, with the dialogue that told it.
fn listed(engine: &Engine) -> Vec<(Vec<String>, Memory)> {
    let world = engine.world().expect("there is a map");
    let bears = |id: &&orthoframe_units::ReplicaId| world.has_trait(**id, "support");
    let mut all = Vec::new();
    for replica in world.replicas.keys().filter(bears).map(|id| &world.replicas[id]) {
        let in_both = [("Что на", &replica.name), ("What is on", &replica.name_en)];
        for (what, name) in in_both {
            let mut memory = Memory::default();
            let question = match what {
                "Что на" => format!("Что находится на «{name}»?"),
                _ => format!("{what} {name}?"),
            };
            let answer = engine.ask(&question, &mut memory).expect("there is a map");
            if let Ok(answer) = answer.as_ref()
                && answer.symbols.len() > 1
            {
                all.push((answer.symbols.clone(), memory));
            }
        }
    }
    all
}

/// "These things", "the things listed", «перечисленные вещи» are those that were listed.
#[test]
fn what_is_asked_of_these_is_asked_of_those_that_were_listed() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        for (told, memory) in listed(&engine) {
            let all: BTreeSet<String> = told.iter().cloned().collect();
            for [of_them, of_these] in [
                ["Which of them is the biggest?", "Which of these things is the biggest?"],
                ["Which of them is the tallest?", "Which of the listed things is the tallest?"],
                [
                    "Which of them is the tallest?",
                    "Which one of the things you listed is the tallest?",
                ],
                ["Which of them is the smallest?", "Which of those items is the smallest?"],
                ["Какая из них самая большая?", "Какая из этих вещей самая большая?"],
                ["Какая из них самая высокая?", "Какая из перечисленных вещей самая высокая?"],
                [
                    "Какая из них самая высокая?",
                    "Какая из вещей, которые ты назвал, самая высокая?",
                ],
                ["Сколько их?", "Сколько этих вещей?"],
                ["How many of them are there?", "How many of these things are there?"],
            ] {
                let (one, other) =
                    (ask(&engine, of_them, &memory), ask(&engine, of_these, &memory));
                assert_eq!(names(&one), names(&other), "{told:?}: {of_these}: {}", other.text);
                assert!(names(&other).is_subset(&all), "{told:?}: {of_these}: {}", other.text);
                asked += 1;
            }
        }
    }
    assert!(asked > 200, "{asked}");
}

/// Of these how many are of a kind, whether any are, and of another kind after that.
#[test]
fn those_of_a_kind_are_counted_among_these() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        for (told, memory) in listed(&engine) {
            let kinds: BTreeSet<String> = told.iter().map(|name| kind(world, name)).collect();
            for own in &kinds {
                let many = english::plural(own);
                let all =
                    names(&ask(&engine, &format!("Which {many} are there?"), &Memory::default()));
                let those: BTreeSet<String> =
                    told.iter().filter(|n| all.contains(*n)).cloned().collect();
                let mut counted = memory.clone();
                let question = format!("How many of these things are {many}?");
                let answer = engine.ask(&question, &mut counted).unwrap().unwrap();
                assert_eq!(names(&answer), those, "{told:?}: {question}: {}", answer.text);
                // Of one there are no others.
                let question = format!("Which of these {many} is the biggest?");
                let biggest = engine.ask(&question, &mut memory.clone()).unwrap();
                assert!(biggest.is_ok() || those.len() == 1, "{told:?}: {question}");
                let own_biggest = biggest.map(|biggest| names(&biggest)).unwrap_or_default();
                assert!(own_biggest.is_subset(&those), "{told:?}: {question}: {own_biggest:?}");
                let any = ask(&engine, &format!("Are any of these things {many}?"), &memory);
                assert_eq!(any.is_so(), Some(true), "{told:?}: {many}: {}", any.text);
                for other in kinds.iter().filter(|other| *other != own) {
                    let question = format!("And {}?", english::plural(other));
                    let answer = ask(&engine, &question, &counted);
                    let all: BTreeSet<String> = told.iter().cloned().collect();
                    assert!(
                        names(&answer).is_subset(&all),
                        "{told:?}: {question}: {}",
                        answer.text
                    );
                }
                asked += 1;
            }
        }
    }
    assert!(asked > 50, "{asked}");
}

/// Where nothing was told, nothing is meant by "these".
#[test]
fn these_are_nothing_where_nothing_was_told() {
    let Some(engine) = engine(MAPS[0]) else { return };
    for question in [
        "Which of these things is the biggest?",
        "Какая из этих вещей самая большая?",
        "Сколько из перечисленных вещей белые?",
        "Are these chairs white?",
        "Which of the listed chairs is the tallest?",
    ] {
        let answer = engine.ask(question, &mut Memory::default()).expect("there is a map");
        assert!(answer.is_err(), "{question}: {}", answer.unwrap().text);
    }
}

/// "In total?" is of the rooms that were asked about, and names them; "in the whole house" is of all.
#[test]
fn a_sum_is_of_the_places_that_were_counted() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        let kinds: BTreeSet<String> =
            world.replicas.values().map(|replica| kind(world, &replica.name)).collect();
        let rooms: Vec<_> = world.areas.values().collect();
        for (n, kind) in kinds.iter().enumerate() {
            let many = english::plural(kind);
            let count = |room: &str| format!("How many {many} are in the {room}?");
            let (first, second) = (rooms[n % rooms.len()], rooms[(n + 1) % rooms.len()]);
            let mut memory = Memory::default();
            let mut sum = 0.0;
            for room in [first, second] {
                let Ok(answer) = engine.ask(&count(&room.name_en), &mut memory).unwrap() else {
                    continue;
                };
                sum += answer.number.unwrap_or_default();
            }
            for total in ["And in total?", "How many altogether?", "How many is that in all?"] {
                let answer = ask(&engine, total, &memory);
                if sum > 0.0 {
                    assert_eq!(answer.number, Some(sum), "{many}, {total}: {}", answer.text);
                    let text = answer.text.to_lowercase();
                    for room in [first, second] {
                        assert!(text.contains(&room.name_en.to_lowercase()), "{many}: {text}");
                    }
                }
            }
            let all = ask(&engine, &format!("How many {many} are there?"), &Memory::default());
            for whole in ["And in the whole house?", "And in total in the house?"] {
                let answer = ask(&engine, whole, &memory);
                assert_eq!(answer.number, all.number, "{many}, {whole}: {}", answer.text);
            }
            asked += 1;
        }
    }
    assert!(asked > 60, "{asked}");
}

/// "Bring these cups": those that were told, one or all of them; where nothing was told, nothing.
#[test]
fn an_order_about_these_is_of_those_that_were_told() {
    let mut ordered = 0;
    for map in ["../shared/data/procthor/house_2.json", "../shared/data/procthor/house_3.json"] {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        let done_to = |order: &str, memory: &mut Memory| -> Option<BTreeSet<String>> {
            let commands = engine.understand_in(order, memory).ok()?;
            let what = commands.iter().filter_map(|command| command.what());
            Some(what.map(|what| world.name(what.id).to_owned()).collect())
        };
        let bears = |id: &&orthoframe_units::ReplicaId| world.has_trait(**id, "support");
        for id in world.replicas.keys().filter(bears) {
            let mut memory = Memory::default();
            let question = format!("What is on {}?", world.replicas[id].name_en);
            let Ok(told) = engine.ask(&question, &mut memory).expect("there is a map") else {
                continue;
            };
            let told: BTreeSet<String> = told.symbols.into_iter().collect();
            for order in [
                "Bring these things to me",
                "Bring me all of these things",
                "Bring me the listed things",
                "Принеси эти вещи",
                "Принеси перечисленные вещи",
            ] {
                let Some(taken) = done_to(order, &mut memory.clone()) else { continue };
                assert_eq!(taken, told, "{question} {order}");
                ordered += 1;
            }
            if told.len() > 1 {
                for order in ["Bring me one of these things", "Bring me two of these things"] {
                    let taken = done_to(order, &mut memory.clone()).unwrap_or_default();
                    assert!(
                        taken.len() < 3 && taken.is_subset(&told),
                        "{question} {order}: {taken:?}"
                    );
                    assert!(taken != told || told.len() == 2, "{question} {order}: {taken:?}");
                }
            }
        }
        for order in ["Bring these things to me", "Принеси эти вещи", "Bring me these cups"]
        {
            let taken = done_to(order, &mut Memory::default());
            assert_eq!(taken, None, "{order}");
        }
    }
    assert!(ordered > 20, "{ordered}");
}
