//! Questions that rest on one truth agree: a comparison asked of all and of each, what is in a place and what is outside
//! of it, what bears something and what does not, a way and the doors on it.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::question::{Answer, Doubt};
use orthoframe_language::{Case, NounPhrase, Number, WordHints};

use crate::files::project;
use crate::talk::engine;

fn rb2() -> Engine {
    engine("maps/rb2.toml").expect("part of the crate")
}

fn ask(engine: &Engine, question: &str) -> Answer {
    let answer = engine.ask(question, &mut Memory::default()).expect("there is a map");
    answer.unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text))
}

fn names(answer: &Answer) -> BTreeSet<String> {
    answer.symbols.iter().cloned().collect()
}

/// Which are beyond a thing, whether there is one, how many: as it is so of each by itself, in both languages.
#[test]
fn what_is_beyond_a_thing_is_what_is_so_one_by_one() {
    let engine = rb2();
    let rooms: &[[&str; 2]] = &[
        ["Комнаты-В", "Room V"],
        ["Комнаты-Z", "Room Z"],
        ["Комнаты-Y", "Room Y"],
        ["Коридора", "the corridor"],
    ];
    let things: &[[&str; 2]] = &[
        ["Шкафа-1", "Wardrobe 1"],
        ["Шкафа-2", "Wardrobe 2"],
        ["Холодильника-1", "Refrigerator 1"],
        ["Комода-1", "Dresser 1"],
    ];
    let of_rooms = [("больше", "bigger"), ("меньше", "smaller")];
    let of_things = [("выше", "taller"), ("шире", "wider"), ("длиннее", "longer")];
    let sorts = [
        ("комнаты", "комнат", "rooms", &of_rooms[..], rooms),
        ("стулья", "стульев", "chairs", &of_things[..], things),
        ("шкафы", "шкафов", "wardrobes", &of_things[..], things),
        ("кровати", "кроватей", "beds", &of_things[..], things),
    ];
    let mut asked = 0;
    for (kinds, of, in_english, comparisons, others) in sorts {
        let all = names(&ask(&engine, &format!("Какие есть {kinds}?")));
        assert!(!all.is_empty(), "{kinds}");
        for (comparison, comparative) in comparisons {
            for [other, other_in_english] in others {
                let question = format!("Какие {kinds} {comparison} {other}?");
                let beyond = names(&ask(&engine, &question));
                let by_itself: BTreeSet<String> = all
                    .iter()
                    .filter(|one| {
                        let itself = NounPhrase::parse(one, &WordHints::default());
                        let one_by_one = format!("{one} {comparison} {other}?");
                        itself.form(Case::Genitive, Number::Singular) != *other
                            && ask(&engine, &one_by_one).is_so() == Some(true)
                    })
                    .cloned()
                    .collect();
                assert_eq!(beyond, by_itself, "{question}");
                for exists in [
                    format!("Есть ли {kinds} {comparison} {other}?"),
                    format!("Are there {in_english} {comparative} than {other_in_english}?"),
                    format!("Are there any {in_english} {comparative} than {other_in_english}?"),
                ] {
                    let answer = ask(&engine, &exists);
                    assert_eq!(
                        answer.is_so(),
                        Some(!beyond.is_empty()),
                        "{exists}: {}",
                        answer.text
                    );
                }
                for count in [
                    format!("Сколько {of} {comparison} {other}?"),
                    format!("How many {in_english} are {comparative} than {other_in_english}?"),
                ] {
                    let answer = ask(&engine, &count);
                    let number = Some(beyond.len() as f64);
                    assert_eq!(answer.number, number, "{count}: {}", answer.text);
                }
                asked += 1;
            }
        }
    }
    assert!(asked > 40, "{asked}");
}

/// No weight is on the map: that nothing is heavier would be a guess.
#[test]
fn what_the_map_does_not_measure_is_beyond_nothing_and_not_less() {
    let engine = rb2();
    for question in [
        "Что тяжелее Стола-1?",
        "Есть ли что-нибудь тяжелее Стола-1?",
        "Сколько стульев тяжелее Стола-1?",
        "What is lighter than Table 1?",
        "Is there anything heavier than Table 1?",
        "How many chairs are lighter than Table 1?",
    ] {
        let answer = ask(&engine, question);
        assert_eq!(answer.is_so(), None, "{question}: {}", answer.text);
        assert!(answer.symbols.len() < 2, "{question}: {}", answer.text);
        let tells = ["вес", "weight"].iter().any(|word| answer.text.to_lowercase().contains(word));
        assert!(tells, "{question}: {}", answer.text);
    }
}

#[test]
fn what_is_in_a_place_and_what_is_outside_of_it_are_all() {
    let engine = rb2();
    let places = [
        ("в Комнате-В", "in Room V"),
        ("в Комнате-Z", "in Room Z"),
        ("в Шкафу-1", "in Wardrobe 1"),
        ("в Холодильнике-1", "in Refrigerator 1"),
    ];
    let kinds = [("стульев", "chairs"), ("столов", "tables"), ("книг", "books"), ("чашек", "cups")];
    for (place, in_english) in places {
        for (of, kinds) in kinds {
            let both = [
                (
                    format!("Сколько всего {of}?"),
                    format!("Сколько {of} {place}?"),
                    "А снаружи сколько?",
                ),
                (
                    format!("How many {kinds} are there?"),
                    format!("How many {kinds} are {in_english}?"),
                    "And how many outside?",
                ),
            ];
            for (all, inside, outside) in both {
                let mut memory = Memory::default();
                let all = ask(&engine, &all).number;
                let within = engine.ask(&inside, &mut memory).expect("there is a map");
                let within =
                    within.unwrap_or_else(|doubt| panic!("{inside}: {}", doubt.text)).number;
                let without = engine.ask(outside, &mut memory).expect("there is a map");
                let without =
                    without.unwrap_or_else(|doubt| panic!("{inside} {outside}: {}", doubt.text));
                let sum = within.zip(without.number).map(|(within, without)| within + without);
                assert_eq!(sum, all, "{inside} {outside}: {}", without.text);
            }
        }
    }
}

#[test]
fn what_bears_none_is_all_but_what_bears_some() {
    let engine = rb2();
    let all = names(&ask(&engine, "Какие есть столы?"));
    for (kind, of) in
        [("лекарство", "лекарства"), ("книга", "книги"), ("чашка", "чашки"), ("тарелка", "тарелки")]
    {
        let without = names(&ask(&engine, &format!("На каком столе нет {of}?")));
        let with: BTreeSet<String> = all
            .iter()
            .filter(|table| {
                let table = table.replace("Стол-", "Столе-");
                ask(&engine, &format!("Есть ли {kind} на {table}?")).is_so() == Some(true)
            })
            .cloned()
            .collect();
        assert_eq!(without, &all - &with, "{kind}");
    }
}

#[test]
fn the_doors_and_rooms_that_one_goes_through_are_those_of_the_way() {
    let engine = rb2();
    let rooms = [
        ("Комнаты-В", "Комнату-В", "Room V"),
        ("Комнаты-Z", "Комнату-Z", "Room Z"),
        ("Комнаты-Y", "Комнату-Y", "Room Y"),
        ("Коридора", "Коридор", "the corridor"),
    ];
    for (n, (from, _, from_english)) in rooms.iter().enumerate() {
        for (m, (_, to, to_english)) in rooms.iter().enumerate() {
            if n == m {
                continue;
            }
            let way = ask(&engine, &format!("Как пройти из {from} в {to}?")).text;
            for frame in [
                "Через какие двери я пройду из {from} в {to}?",
                "Через какие двери надо пройти, чтобы попасть из {from} в {to}?",
                "Через какие комнаты я пройду из {from} в {to}?",
            ] {
                let question = frame.replace("{from}", from).replace("{to}", to);
                assert_eq!(ask(&engine, &question).text, way, "{question}");
            }
            let way =
                ask(&engine, &format!("How do I get from {from_english} to {to_english}?")).text;
            for frame in [
                "Which doors do I go through from {from} to {to}?",
                "What doors will I pass going from {from} to {to}?",
                "Which rooms do I pass from {from} to {to}?",
            ] {
                let question = frame.replace("{from}", from_english).replace("{to}", to_english);
                assert_eq!(ask(&engine, &question).text, way, "{question}");
            }
        }
    }
}

/// The four rooms of the one lie in a ring, so that no door is needed; the other house has one way between any two.
#[test]
fn a_way_without_a_door_does_not_lead_through_it() {
    let engine = rb2();
    let frames = [
        "Можно ли попасть из Комнаты-В в Комнату-Y, минуя {door}?",
        "Как попасть из Комнаты-В в Комнату-Y, минуя {door}?",
        "Как попасть из Комнаты-В в Комнату-Y не через {door}?",
        "Can I get from Room V to Room Y without going through {door}?",
        "Can I get from Room V to Room Y without using {door}?",
        "How do I get from Room V to Room Y without going through {door}?",
    ];
    let doors = [
        ["Дверь-ВZ", "Door VZ"],
        ["Дверь-ZY", "Door ZY"],
        ["Дверь-КY", "Door KY"],
        ["Проход-ВК", "Passage VK"],
    ];
    for frame in frames {
        for [door, in_english] in doors {
            let door = if frame.is_ascii() { in_english } else { door };
            let question = frame.replace("{door}", door);
            let answer = ask(&engine, &question);
            assert_ne!(answer.is_so(), Some(false), "{question}: {}", answer.text);
            assert!(!answer.text.contains(door), "{question}: {}", answer.text);
        }
    }
    let Some(engine) = crate::talk::engine("../shared/data/procthor/house_2.json") else { return };
    for question in [
        "Can I go from the bedroom to the kitchen without going through Door 2?",
        "How do I get from the bathroom to the kitchen without using Door 2?",
        "Можно ли попасть из ванной на кухню, минуя Дверь-2?",
        "Можно ли попасть из ванной в спальню, минуя Дверь-1?",
    ] {
        let answer = ask(&engine, question);
        assert_eq!(answer.is_so(), Some(false), "{question}: {}", answer.text);
    }
}

/// Of two sets of keys neither is "they" rather than the other.
#[test]
fn they_that_were_named_without_choosing_are_all_of_them() {
    let Some(engine) = engine("../shared/data/procthor/house_4.json") else { return };
    let all = names(&ask(&engine, "Which keys are there?"));
    assert!(all.len() > 1, "{all:?}");
    for told in ["I can't find my keys.", "I need the keys.", "There should be two keys."] {
        let answer = ask(&engine, &format!("{told} Where are they?"));
        assert_eq!(names(&answer), all, "{told}: {}", answer.text);
    }
}

/// What is put in before a sentence is read is not the asker's word.
#[test]
fn what_is_not_understood_is_quoted_as_it_was_said() {
    let words = |text: &str| -> Vec<String> {
        let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        words.map(str::to_lowercase).collect()
    };
    let engine = rb2();
    let mut quoted = 0;
    let cases = std::fs::read_dir(project("tests/golden/talk")).unwrap();
    for case in cases {
        let questions =
            std::fs::read_to_string(case.unwrap().path().join("questions.txt")).unwrap();
        for question in questions.lines().map(|line| line.trim_start_matches('+').trim()) {
            let answer = engine.ask(question, &mut Memory::default()).expect("there is a map");
            let Err(unanswered) = answer else { continue };
            let Doubt::NotUnderstood { words: told } = &unanswered.doubt else { continue };
            let (said, told) = (words(question), words(told));
            // A long one is cut, within a word.
            let whole = told.len().saturating_sub(1).max(1).min(told.len());
            let is_said = said.windows(whole).any(|run| *run == told[..whole]);
            assert!(is_said || told.is_empty(), "{question}: {}", unanswered.text);
            quoted += 1;
        }
    }
    assert!(quoted > 40, "{quoted}");
}

/// Properties of rooms and things that the readers of formats make have a name in English.
#[test]
fn what_rooms_have_in_common_is_told_in_one_language() {
    let Some(engine) = engine("../shared/data/procthor/house_4.json") else { return };
    let rooms = ["the bedroom", "the bathroom", "the kitchen", "the living room"];
    for (n, room) in rooms.iter().enumerate() {
        for other in &rooms[n + 1..] {
            for question in [
                format!("What do {room} and {other} have in common?"),
                format!("How do {room} and {other} differ?"),
                format!("What is the difference between {room} and {other}?"),
                format!("Tell me about {room}"),
            ] {
                let answer = engine.ask(&question, &mut Memory::default()).expect("there is a map");
                let Ok(answer) = answer else { continue };
                let russian = answer.text.chars().any(|c| ('\u{400}'..'\u{530}').contains(&c));
                assert!(!russian, "{question}: {}", answer.text);
            }
        }
    }
}
