//! What is said in a language is said in its letters: names that the map has in both are told in the one that is spoken.

use std::collections::BTreeSet;

use orthoframe::engine::Memory;
use orthoframe_language::names::named;
use orthoframe_language::{Case, Language};
use orthoframe_map::{Entity, World};
use orthoframe_units::Stop;

use crate::talk::engine;

const MAPS: [&str; 4] = [
    "maps/rb2.toml",
    "../shared/data/procthor/house_4.json",
    "../shared/data/procthor/house_6.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

/// Orders of which some are refused, whatever the thing is: by what it is, by what stands around it, or by its state.
const ORDERS: [(&str, &str, Case); 9] = [
    ("Возьми", "Take", Case::Accusative),
    ("Открой", "Open", Case::Accusative),
    ("Запри", "Lock", Case::Accusative),
    ("Включи", "Turn on", Case::Accusative),
    ("Помой", "Wash", Case::Accusative),
    ("Выброси", "Throw away", Case::Accusative),
    ("Верни на место", "Put back", Case::Accusative),
    ("Разбери", "Clear", Case::Accusative),
    ("Поезжай к", "Go to", Case::Dative),
];

/// Questions about a thing, by its name in the nominative.
const QUESTIONS: [(&str, &str); 6] = [
    ("Где {}?", "Where is {}?"),
    ("Какого цвета {}?", "What colour is {}?"),
    ("Какой высоты {}?", "How tall is {}?"),
    ("Что такое {}?", "Describe {}"),
    ("Насколько далеко {}?", "How far is {}?"),
    ("Почему {} здесь?", "Why is {} here?"),
];

/// One thing of each kind, the rooms and the doors.
fn sample(world: &World) -> Vec<Entity> {
    let mut kinds = Vec::new();
    let first = |entity: &Entity| match entity {
        Entity::Replica(id) => {
            let kind = world.objects[&world.replicas[id].object].object_type;
            let is_new = !kinds.contains(&kind);
            kinds.push(kind);
            is_new
        }
        Entity::Area(_) | Entity::Door(_) => true,
        Entity::Map(_) | Entity::Place(_) | Entity::Zone(_) => false,
    };
    world.names().map(|(entity, _)| entity).filter(first).collect()
}

/// The words of all names as a language has them.
fn words_of_names(world: &World, language: Language) -> BTreeSet<String> {
    let said = |entity| {
        let called = named(world, entity);
        language.pick(called.phrase().name().to_owned(), called.english_name().to_owned())
    };
    world.names().flat_map(|(entity, _)| words(&said(entity))).collect()
}

fn words(text: &str) -> Vec<String> {
    text.split(|c: char| !c.is_alphanumeric()).map(str::to_owned).collect()
}

/// A letter of the other language, known words and those of the line itself aside.
fn foreign(said: &str, known: &BTreeSet<String>, line: &str, language: Language) -> Option<char> {
    let other = |c: &char| match language {
        Language::Russian => c.is_ascii_alphabetic(),
        Language::English => c.is_alphabetic() && !c.is_ascii(),
    };
    let strange = |word: &String| !known.contains(word) && !line.contains(word.as_str());
    let told = words(said).into_iter().filter(strange).collect::<String>();
    told.chars().find(other)
}

/// A door was "Дверь-1" and a drawer «Drawer 1» in refusals, whatever the language of the order.
#[test]
fn no_answer_and_no_refusal_mixes_the_languages() {
    // What cannot be done is refused before anything is begun.
    let stop = Stop::new();
    stop.raise();
    let mut refused = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { continue };
        let world = engine.world().unwrap();
        let [russian, english] =
            [Language::Russian, Language::English].map(|l| words_of_names(world, l));
        let check = |line: &str, said: &str, language: Language| {
            let known = language.pick(&russian, &english);
            assert_eq!(foreign(said, known, line, language), None, "{line}: {said}");
        };
        for entity in sample(world) {
            let called = named(world, entity);
            for (russian, english, case) in ORDERS {
                let orders = [
                    (format!("{russian} {}", called.phrase().case(case)), Language::Russian),
                    (format!("{english} {}", called.english()), Language::English),
                ];
                for (order, language) in orders {
                    let understood = engine.understand_in(&order, &mut Memory::default());
                    let begun = understood.and_then(|commands| {
                        let mut robot = engine.simulator(None)?;
                        engine.carry_out_with(&commands, &mut robot, &mut |_| {}, &stop)
                    });
                    if let Err(error) = begun {
                        refused += 1;
                        check(&order, &error.say(language), language);
                    }
                }
            }
            for (russian, english) in QUESTIONS {
                let asked = [
                    (russian.replace("{}", called.phrase().name()), Language::Russian),
                    (english.replace("{}", &called.english()), Language::English),
                ];
                for (question, language) in asked {
                    let said = match engine.ask(&question, &mut Memory::default()).unwrap() {
                        Ok(answer) => answer.text,
                        Err(unanswered) => unanswered.text,
                    };
                    check(&question, &said, language);
                }
            }
        }
    }
    assert!(refused > 500, "{refused}");
}
