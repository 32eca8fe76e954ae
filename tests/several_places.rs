//! Questions of several rooms or things at once: one from each room, what is in both, a door from the one to the other,
//! which of those that are named is there. Each agrees with what is told of every room by itself.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::question::Answer;
use orthoframe_language::{Case, NounPhrase, Number, WordHints, english};

use crate::scope::{kind, names};
use crate::talk::engine;

const MAPS: [&str; 3] = [
    "../shared/data/procthor/house_3.json",
    "../shared/data/procthor/house_7.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

fn ask(engine: &Engine, question: &str) -> Answer {
    let answer = engine.ask(question, &mut Memory::default()).expect("there is a map");
    answer.unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text))
}

/// Every room with the things in it, by its names in both languages.
fn rooms(engine: &Engine) -> Vec<(String, String, BTreeSet<String>)> {
    let world = engine.world().expect("there is a map");
    let told = |name: &str| names(&ask(engine, &format!("Which things are in the {name}?")));
    let room = |area: &orthoframe_map::Area| {
        (area.name.clone(), area.name_en.clone(), told(&area.name_en))
    };
    world.areas.values().map(room).collect()
}

/// «спальне»
fn located(room: &str) -> String {
    NounPhrase::parse(room, &WordHints::default()).form(Case::Locative, Number::Singular)
}

#[test]
fn one_thing_from_each_room_is_in_it() {
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms = rooms(&engine);
        for question in [
            "Name one thing from each room",
            "Name a thing in every room",
            "Tell me one thing in each room",
            "Назови по одной вещи из каждой комнаты",
            "Назови одну вещь в каждой комнате",
        ] {
            let answer = ask(&engine, question);
            let told = names(&answer);
            for (_, room, things) in &rooms {
                let own = told.intersection(things).count();
                assert_eq!(own, things.len().min(1), "{question}, {room}: {}", answer.text);
            }
        }
    }
}

#[test]
fn what_is_from_a_room_is_in_it() {
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        for (russian, room, things) in rooms(&engine) {
            for question in [
                format!("Which things are from the {room}?"),
                format!("List the things from the {room}"),
                format!("Какие вещи из «{russian}»?"),
            ] {
                let answer = ask(&engine, &question);
                assert_eq!(names(&answer), things, "{question}: {}", answer.text);
            }
        }
    }
}

#[test]
fn what_is_in_both_rooms_is_of_the_kinds_that_are_in_each() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        let rooms = rooms(&engine);
        let kinds = |things: &BTreeSet<String>| -> BTreeSet<String> {
            things.iter().map(|name| kind(world, name)).collect()
        };
        for (n, (first, one, here)) in rooms.iter().enumerate() {
            for (second, other, there) in &rooms[n + 1..] {
                let common: BTreeSet<String> =
                    kinds(here).intersection(&kinds(there)).cloned().collect();
                for question in [
                    format!("What is both in the {one} and in the {other}?"),
                    format!("Which things are in both the {one} and the {other}?"),
                    format!("Что есть и в {}, и в {}?", located(first), located(second)),
                ] {
                    let answer = ask(&engine, &question);
                    assert_eq!(kinds(&names(&answer)), common, "{question}: {}", answer.text);
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 30, "{asked}");
}

#[test]
fn a_door_from_room_to_room_is_between_them() {
    let mut joined = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms = rooms(&engine);
        for (first, one, _) in &rooms {
            for (second, other, _) in rooms.iter().filter(|(_, other, _)| other != one) {
                let between = ask(&engine, &format!("Is there a door between {one} and {other}?"));
                for question in [
                    format!("Is there a door from the {one} to the {other}?"),
                    format!("Does a door lead straight from the {one} to the {other}?"),
                    format!("Ведёт ли дверь из «{first}» прямо в «{second}»?"),
                    format!("Есть ли дверь из «{first}» в «{second}»?"),
                ] {
                    let answer = ask(&engine, &question);
                    assert_eq!(answer.is_so(), between.is_so(), "{question}: {}", answer.text);
                    assert_eq!(names(&answer), names(&between), "{question}: {}", answer.text);
                    let text = answer.text.to_lowercase();
                    let [a, b] = match question.starts_with(['I', 'D']) {
                        true => [one, other],
                        false => [first, second],
                    };
                    // A Russian name is told in another case.
                    let stem =
                        |name: &str| -> String { name.to_lowercase().chars().take(4).collect() };
                    assert!(
                        text.contains(&stem(a)) && text.contains(&stem(b)),
                        "{question}: {text}"
                    );
                }
                joined += usize::from(between.is_so() == Some(true));
                let way =
                    ask(&engine, &format!("Can I go directly from the {one} to the {other}?"));
                let why = ask(
                    &engine,
                    &format!("Why can't I go directly from the {one} to the {other}?"),
                );
                if way.is_so() == Some(false) {
                    assert!(
                        why.text.starts_with("There is no door or passage"),
                        "{one}, {other}: {}",
                        why.text
                    );
                }
            }
        }
    }
    assert!(joined > 5, "{joined}");
}

#[test]
fn of_things_that_are_named_each_is_told_whether_it_is_there() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        let rooms = rooms(&engine);
        let all: BTreeSet<String> =
            rooms.iter().flat_map(|(_, _, things)| things).cloned().collect();
        let kinds: BTreeSet<String> = all.iter().map(|name| kind(world, name)).collect();
        let kinds: Vec<&String> = kinds.iter().collect();
        for (_, room, _) in &rooms {
            for pair in kinds.windows(2) {
                let [one, other] = [pair[0], pair[1]].map(|kind| english::a(kind));
                let there = |kind: &str| {
                    names(&ask(
                        &engine,
                        &format!("Which {} are in the {room}?", english::plural(kind)),
                    ))
                };
                let each = [there(pair[0]), there(pair[1])];
                let union: BTreeSet<String> = each.iter().flatten().cloned().collect();
                for question in [
                    format!("What is in the {room}: {one} or {other}?"),
                    format!("What isn't in the {room}, {one} or {other}?"),
                ] {
                    let answer = ask(&engine, &question);
                    assert_eq!(names(&answer), union, "{question}: {}", answer.text);
                    let none = each.iter().filter(|things| things.is_empty()).count();
                    let denied = answer.text.to_lowercase().matches("there are no ").count()
                        + answer.text.to_lowercase().matches("there is no ").count();
                    assert_eq!(denied, none, "{question}: {}", answer.text);
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 100, "{asked}");
}

/// "Are there cups or mugs?": what the yes or no is said of comes first.
#[test]
fn a_yes_is_followed_by_what_is_there() {
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        let kinds: BTreeSet<String> =
            world.replicas.values().map(|replica| kind(world, &replica.name)).collect();
        let kinds: Vec<String> = kinds.iter().map(|kind| english::plural(kind)).collect();
        for (_, room, _) in rooms(&engine) {
            for pair in kinds.windows(2) {
                for joint in ["or", "and"] {
                    let question =
                        format!("Are there any {} {joint} {} in the {room}?", pair[0], pair[1]);
                    let text = ask(&engine, &question).text;
                    assert!(!text.starts_with("Yes, there are no"), "{question}: {text}");
                    assert!(!text.starts_with("Yes, there is no"), "{question}: {text}");
                    let no = ["No, there are no", "No, there is no"];
                    assert!(
                        !text.starts_with("No") || no.iter().any(|no| text.starts_with(no)),
                        "{question}: {text}"
                    );
                }
            }
        }
    }
}

/// "Which rooms have a wooden floor?": those of which it is told one by one; where it is told of some only, not "none".
#[test]
fn rooms_with_a_surface_are_those_whose_surface_is_so() {
    let mut asked = 0;
    for map in ["../shared/data/procthor/house_3.json", "../shared/data/procthor/house_7.json"] {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        let surfaces = [("floor", "is", "a {} floor"), ("walls", "are", "{} walls")];
        for (surface, be, described) in surfaces {
            let told = |room: &str, what: &str| {
                let answer = ask(&engine, &what.replace("{}", room));
                answer
                    .text
                    .rsplit_once(" is ")
                    .map(|(_, value)| value.trim_end_matches('.').to_owned())
            };
            for what in [
                format!("What colour {be} the {surface} in the {{}}?"),
                format!("What {be} the {surface} of the {{}} made of?"),
            ] {
                let each: Vec<(&String, Option<String>)> =
                    world.areas.values().map(|a| (&a.name, told(&a.name_en, &what))).collect();
                let values: BTreeSet<&String> =
                    each.iter().filter_map(|(_, v)| v.as_ref()).collect();
                for value in values {
                    let own = |(name, of): &(&String, Option<String>)| {
                        (of.as_ref() == Some(value)).then(|| (*name).clone())
                    };
                    let rooms: BTreeSet<String> = each.iter().filter_map(own).collect();
                    let question = format!("Which rooms have {}?", described.replace("{}", value));
                    let answer = ask(&engine, &question);
                    assert_eq!(names(&answer), rooms, "{question}: {}", answer.text);
                    asked += 1;
                }
            }
        }
        for question in ["Which rooms have purple walls?", "Which rooms have purple floors?"] {
            if let Ok(answer) = engine.ask(question, &mut Memory::default()).unwrap() {
                assert!(answer.symbols.is_empty(), "{question}: {}", answer.text);
            }
        }
    }
    assert!(asked > 4, "{asked}");
}

/// What is told in English has no Russian word on a map whose names have both languages.
#[test]
fn what_is_told_in_english_is_english() {
    let is_russian = |text: &str| {
        text.chars()
            .any(|c| ('а'..='я').contains(&c.to_ascii_lowercase()) || ('А'..='Я').contains(&c))
    };
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().expect("there is a map");
        let things = world.replicas.values().map(|replica| &replica.name_en).step_by(5);
        let areas = world.areas.values().map(|area| &area.name_en);
        let doors = world.doors.values().map(|door| &door.name_en);
        let names: Vec<&String> = things.chain(areas).chain(doors).collect();
        for pair in names.windows(2) {
            let [one, other] = [pair[0], pair[1]];
            for question in [
                format!("Where is the {one}?"),
                format!("Describe the {one}"),
                format!("What do the {one} and the {other} have in common?"),
                format!("How do the {one} and the {other} differ?"),
                format!("What is the {one} made of?"),
                format!("What are the walls of the {one} made of?"),
                format!("What colour is the floor in the {one}?"),
                format!("Why is the {one} next to the {other}?"),
                format!("How do I get from the {one} to the {other}?"),
                format!("Is the {one} open?"),
                format!("Open the {one}"),
                format!("Put the {one} on the {other}"),
                format!("Switch the {one} on"),
            ] {
                let told =
                    match engine.ask(&question, &mut Memory::default()).expect("there is a map") {
                        Ok(answer) => answer.text,
                        Err(doubt) => doubt.text,
                    };
                assert!(!is_russian(&told), "{question}: {told}");
                asked += 1;
            }
        }
    }
    assert!(asked > 300, "{asked}");
}
