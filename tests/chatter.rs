//! Families of chatter and of dialogue: what is hung on a question changes no answer, and a line that goes on is answered
//! as the whole question is, or not at all.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_map::Entity;

use crate::files::{long, project};
use crate::talk::engine;

/// What is answered, without what was understood before it; none where it is not.
fn answered(engine: &Engine, question: &str, memory: &mut Memory) -> Option<String> {
    let text = engine.ask(question, memory).expect("there is a map").ok()?.text;
    let understood = ["Understood as “", "Понял так: «"].iter().any(|lead| text.starts_with(lead));
    let rest = text.split_once(['”', '»']).map(|(_, rest)| rest.trim().to_owned());
    Some(rest.filter(|_| understood).unwrap_or(text))
}

/// The questions of a golden case that begin a dialogue.
pub(crate) fn golden(case: &str) -> Vec<String> {
    let questions = project("tests/golden/talk").join(case).join("questions.txt");
    let lines = std::fs::read_to_string(questions).unwrap();
    let lines =
        lines.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with(['+', '#']));
    lines.map(str::to_owned).collect()
}

/// Every `step`-th of them with `ORTHOFRAME_LONG`; else a fifth of those.
fn some(questions: &[String], step: usize) -> impl Iterator<Item = &String> {
    questions.iter().step_by(if long() { step } else { 5 * step })
}

/// A claim that somebody makes is answered as the question is whether it is so.
#[test]
fn a_claim_of_others_is_asked_after() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let claims = [
        ("there are six chairs", "Are there six chairs?"),
        ("the entrance door is open", "Is the entrance door open?"),
        ("Lamp 1 is on", "Is Lamp 1 on?"),
        ("the medicine is in Room Y", "Is the medicine in Room Y?"),
    ];
    let frames = [
        "My wife says {}, is that true?",
        "somebody told me {}, can you check?",
        "the boss wants to know if {}",
        "They claim that {}. Is that right?",
        "My wife says {}, is she right?",
        "Someone told me that {}, isn't that so?",
    ];
    for (claim, question) in claims {
        let plain = answered(&rb2, question, &mut Memory::default()).expect("a plain question");
        for frame in frames {
            let line = frame.replace("{}", claim);
            let told = answered(&rb2, &line, &mut Memory::default());
            assert_eq!(told.as_deref(), Some(&*plain), "{line}");
        }
    }
}

/// The same in Russian, whoever claims it and whichever words ask whether it is so.
#[test]
fn a_claim_of_others_is_asked_after_in_russian() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let claims = [
        ("входная дверь заперта", "Входная дверь заперта?"),
        ("Лампа-1 включена", "Лампа-1 включена?"),
        ("лекарство в Комнате-Y", "Лекарство в Комнате-Y?"),
        ("красная чашка на столе в гостиной", "Красная чашка на столе в гостиной?"),
        ("чайник лежит на полу", "Чайник лежит на полу?"),
    ];
    let frames = [
        "Жена говорит, что {}, это правда?",
        "Сын утверждает, что {}. Это так?",
        "Сосед уверяет, что {}, он прав?",
        "Мне сказали, что {}, так ли это?",
        "Говорят, {}. Верно?",
    ];
    let (mut asked, mut same) = (0, 0);
    for (claim, question) in claims {
        let plain = rb2.ask(question, &mut Memory::default()).unwrap().expect("a plain question");
        for frame in frames {
            let line = frame.replace("{}", claim);
            asked += 1;
            let Ok(told) = rb2.ask(&line, &mut Memory::default()).unwrap() else { continue };
            assert_eq!(told.said, plain.said, "{line}\n  {}\n  {}", told.text, plain.text);
            same += 1;
        }
    }
    assert!(same * 4 >= asked * 3, "{same} of {asked}");
}

/// Dialogues of which the last line goes on from those before it, and the whole question that it stands for.
fn gone_on(engine: &Engine, lines: &[&str], whole: &str) {
    let mut memory = Memory::default();
    let (last, before) = lines.split_last().expect("a dialogue");
    for line in before {
        answered(engine, line, &mut memory);
    }
    let told = answered(engine, last, &mut memory);
    let plain = answered(engine, whole, &mut Memory::default());
    assert!(told.is_none() || told == plain, "{lines:?}\n  {told:?}\n{whole}\n  {plain:?}");
}

/// Of every two kinds of things and every room: what goes on keeps the place of the question before it, by whichever
/// words that was told.
#[test]
fn what_goes_on_keeps_the_place() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let kinds = ["chairs", "books", "lamps", "wardrobes", "windows"];
    let rooms = ["Room V", "Room Z", "Room Y", "the corridor"];
    for room in rooms {
        for (first, second) in kinds.iter().zip(kinds.iter().cycle().skip(1)) {
            let counted = format!("How many {first} are in {room}?");
            let whole = format!("How many {second} are in {room}?");
            gone_on(&rb2, &[&counted, &format!("And {second}?")], &whole);
            let bigger = format!("Is {room} bigger than Room V?");
            let it = format!("How many {first} are in it?");
            gone_on(&rb2, &[&bigger, &it, &format!("And {second}?")], &whole);
            let house = format!("How many {first} are there in the whole house?");
            gone_on(&rb2, &[&counted, "How many of them are there in the whole house?"], &house);
        }
    }
    let lamp = |place: &str| format!("Is the lamp {place} on?");
    let (desk, bedside) = ("on the desk", "on Bedside table 1");
    for (first, second) in [(desk, bedside), (bedside, desk), ("in Room V", "in Room Y")] {
        gone_on(&rb2, &[&lamp(first), &format!("And {second}?")], &lamp(second));
    }
    let on = |support: &str| format!("What is on {support}?");
    for (first, second) in [("Table 1", "the dresser"), ("Shelf 1", "the dining table")] {
        gone_on(&rb2, &[&on(first), &format!("And {second}?")], &on(second));
    }
}

/// A "that" with a noun means what bears the things that were told, whatever was told of them; and never anything else.
#[test]
fn that_table_is_the_one_that_was_spoken_of() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let world = rb2.world().unwrap();
    let mut shown = 0;
    for replica in world.replicas.values() {
        let english = &replica.name_en;
        let symbol = rb2.relations().unwrap().support_of(replica.id);
        let Some(support) = symbol.and_then(|id| world.replicas.get(&id)) else { continue };
        let kind = world.types.object.get(world.objects[&support.object].object_type);
        let kind = kind.expect("everything on this map has a type");
        let asked = format!("What else is on that {}?", kind.name_en);
        for opening in [format!("Where is {english}?"), format!("Which room is {english} in?")] {
            let mut memory = Memory::default();
            answered(&rb2, &opening, &mut memory);
            let Ok(answer) = rb2.ask(&asked, &mut memory).unwrap() else { continue };
            let others: BTreeSet<_> = world
                .replicas
                .values()
                .filter(|r| rb2.relations().unwrap().support_of(r.id) == Some(support.id))
                .filter(|r| r.id != replica.id)
                .map(|r| Entity::Replica(r.id))
                .collect();
            let told = answer.things.iter().filter_map(|thing| match thing {
                orthoframe_language::question::Thing::Entity(entity) => Some(*entity),
                _ => None,
            });
            assert_eq!(told.collect::<BTreeSet<_>>(), others, "{opening} {asked}: {}", answer.text);
            shown += 1;
        }
    }
    assert!(shown > 10, "{shown}");
    for line in ["What else is on that piano?", "Что ещё на этой скамье?"] {
        let told = answered(&rb2, line, &mut Memory::default());
        assert_eq!(told, None, "{line}");
    }
}

/// What a line tells before it asks of "there": the place, and not the thing.
#[test]
fn there_is_the_place_that_was_told() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    for (thing, room) in [("umbrella", "Room Z"), ("kettle", "Room Z"), ("vase", "the corridor")] {
        let whole = format!("Is the {thing} in {room}?");
        for line in [
            format!("I swear I put the {thing} in {room}, is it there?"),
            format!("I left the {thing} in {room} yesterday. Is it there?"),
        ] {
            let ask = |text: &str| rb2.ask(text, &mut Memory::default()).unwrap().ok();
            let (told, plain) = (ask(&line), ask(&whole).expect("a plain question"));
            assert!(told.is_none_or(|told| told.said == plain.said), "{line}: {}", plain.text);
        }
    }
}

/// «Сколько из них на столе?» – "One." – «Какая из них ближе?»: of one thing there are no others, so all are meant.
#[test]
fn of_one_thing_there_are_no_others() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let mut shown = 0;
    for (several, one) in [("chairs", "chair"), ("books", "book"), ("lamps", "lamp")] {
        for room in ["Room V", "Room Z", "Room Y", "the corridor"] {
            let mut memory = Memory::default();
            let all = rb2.ask(&format!("How many {several} are there?"), &mut memory).unwrap();
            if all.is_ok_and(|all| all.things.len() < 2) {
                continue;
            }
            let there = rb2.ask(&format!("How many of them are in {room}?"), &mut memory).unwrap();
            if there.is_ok_and(|there| there.things.len() != 1) {
                continue;
            }
            let whole = format!("Which {one} is the nearest to Table 1?");
            let plain = answered(&rb2, &whole, &mut Memory::default()).expect("a plain question");
            let asked = "Which of them is the nearest to Table 1?";
            let told = answered(&rb2, asked, &mut memory);
            assert!(told.as_ref().is_none_or(|told| *told == plain), "{room}: {told:?}, {plain}");
            shown += usize::from(told.is_some());
        }
    }
    assert!(shown > 0, "none of them was understood");
}

/// "Which books are there? What colour is it?": one word in the singular means no one of several that were listed.
#[test]
fn it_is_none_of_several_that_were_listed() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let kinds = [("books", "книги"), ("chairs", "стулья"), ("lamps", "лампы"), ("windows", "окна")];
    let mut asked_back = 0;
    for (english, russian) in kinds {
        for (list, asked) in [
            (format!("Which {english} are there?"), "What colour is it?"),
            (format!("Which {english} are there?"), "Is it in Room V?"),
            (format!("Which {english} are there?"), "What is next to it?"),
            (format!("Какие {russian} есть?"), "Какого цвета она?"),
            (format!("Какие {russian} есть?"), "Что рядом с ним?"),
        ] {
            let mut memory = Memory::default();
            let Ok(listed) = rb2.ask(&list, &mut memory).unwrap() else { continue };
            if listed.things.len() < 2 {
                continue;
            }
            match rb2.ask(asked, &mut memory).unwrap() {
                Ok(told) => {
                    let of_one = listed.things.iter().filter(|t| told.things.contains(t)).count();
                    assert_ne!(of_one, 1, "{list} {asked} {}", told.text);
                }
                Err(unanswered) => {
                    asked_back += usize::from(unanswered.doubt.kind() == "ambiguous");
                }
            }
        }
    }
    assert!(asked_back > 3, "{asked_back}");
}

/// «Я в спальне, что тут …?»: "here" is where the person says to be, and never where the robot is.
#[test]
fn here_is_where_the_person_says_to_be() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let mut same = 0;
    for room in ["Room V", "Room Z", "Room Y"] {
        for thing in ["chairs", "books", "lamps"] {
            let whole = format!("How many {thing} are in {room}?");
            let plain = rb2.ask(&whole, &mut Memory::default()).unwrap().expect("a plain question");
            for lead in [
                format!("I'm in {room}, how many {thing} are here?"),
                format!("I'm in {room} and I'm bored, how many {thing} are there here?"),
                format!("I'm sitting in {room}. How many {thing} are in here?"),
            ] {
                let Ok(told) = rb2.ask(&lead, &mut Memory::default()).unwrap() else { continue };
                assert_eq!(told.number, plain.number, "{lead} {}", told.text);
                same += 1;
            }
        }
    }
    for (room, inside) in [("Комнате-В", "в Комнате-В"), ("Комнате-Z", "в Комнате-Z")]
    {
        for activity in ["почитать", "включить"] {
            let whole = format!("Что {inside} можно {activity}?");
            let plain = answered(&rb2, &whole, &mut Memory::default());
            let here = format!("Я сейчас в {room}, что тут можно {activity}?");
            let told = answered(&rb2, &here, &mut Memory::default());
            assert!(told.is_none() || told == plain, "{here}\n  {told:?}\n  {plain:?}");
        }
    }
    assert!(same > 8, "{same}");
}

/// What is thrown in behind a question word changes no answer.
#[test]
fn what_is_thrown_in_behind_a_question_word_changes_no_answer() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    for (case, thrown) in [("rb2-ru", ", спрашивается, "), ("rb2-en", ", pray tell, ")]
    {
        let (mut asked, mut same) = (0, 0);
        for question in some(&golden(case), 4) {
            let Some((first, rest)) = question.split_once(' ') else { continue };
            let words = ["Где", "Куда", "Сколько", "Where", "What"];
            if !words.contains(&first) {
                continue;
            }
            let Some(plain) = answered(&rb2, question, &mut Memory::default()) else { continue };
            let line = format!("{first}{thrown}{rest}");
            asked += 1;
            if let Some(told) = answered(&rb2, &line, &mut Memory::default()) {
                assert_eq!(told, plain, "{line}");
                same += 1;
            }
        }
        assert!(same * 2 >= asked && asked > 3, "{case}: {same} of {asked}");
    }
}

/// «Сколько стульев в А? А в Б их сколько?» counts those of the kind in the other room; "the other rooms" leave out the one
/// that was spoken of.
#[test]
fn what_goes_on_moves_to_another() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let counted = |question: &str, memory: &mut Memory| {
        rb2.ask(question, memory).unwrap().ok().and_then(|answer| answer.number)
    };
    let rooms = ["Room V", "Room Z", "Room Y", "the corridor"];
    for kind in ["chairs", "books", "lamps", "windows"] {
        for (from, to) in rooms.iter().zip(rooms.iter().cycle().skip(1)) {
            let first = format!("How many {kind} are in {from}?");
            let second = format!("How many of them are in {to}?");
            let mut memory = Memory::default();
            answered(&rb2, &first, &mut memory);
            let told = counted(&second, &mut memory);
            let plain = counted(&format!("How many {kind} are in {to}?"), &mut Memory::default());
            assert!(told.is_none() || told == plain, "{first} {second} {told:?} {plain:?}");
        }
        let all = counted(&format!("How many {kind} are there?"), &mut Memory::default());
        for room in rooms {
            let mut memory = Memory::default();
            let here = counted(&format!("How many {kind} are in {room}?"), &mut memory);
            let rest = counted(&format!("How many {kind} are in the other rooms?"), &mut memory);
            let (Some(all), Some(here), Some(rest)) = (all, here, rest) else { continue };
            assert!((all - here - rest).abs() < 0.5, "{kind}, {room}: {all} {here} {rest}");
        }
    }
}

/// A name that is asked for is no request for a list.
#[test]
fn whose_name_is_asked_is_told_no_list() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let answer = |line: &str| answered(&rb2, line, &mut Memory::default());
    let everything = answer("List everything").expect("a list of all things");
    for asked in ["what is", "What's", "So what is", "Tell me, what is", "And what would be"] {
        for whose in ["my", "your wife's", "the robot's", "the", "its", "everybody's"] {
            let line = format!("{asked} {whose} name?");
            assert_ne!(answer(&line).as_deref(), Some(everything.as_str()), "{line}");
        }
    }
}

/// "Then", "at the moment" and who is spoken to change nothing of what is switched on.
#[test]
fn small_words_behind_a_state_leave_it_one() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    for question in ["How many lights are on", "Which lamps are off", "Is Lamp 1 on"] {
        let plain = answered(&rb2, &format!("{question}?"), &mut Memory::default());
        assert!(plain.is_some(), "{question}");
        for behind in [" then", " now", " at the moment", ", dear", ", mate", " right now, please"]
        {
            let line = format!("{question}{behind}?");
            let told = answered(&rb2, &line, &mut Memory::default());
            assert_eq!(told, plain, "{line}");
        }
    }
}

/// "Three chairs are in the hall, right?" asks whether there are so many there; «в шкафу пусто?» is said of the wardrobe; two
/// questions behind one comma are two.
#[test]
fn what_is_claimed_is_claimed_of_what_bears_it() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let said = |question: &str| {
        let answer = rb2.ask(question, &mut Memory::default()).expect("there is a map").ok()?;
        Some((answer.said, answer.symbols))
    };
    let (mut asked, mut understood) = (0, 0);
    for (kind, kinds) in [("стула", "chairs"), ("книги", "books"), ("лампы", "lamps")]
    {
        for (room, place) in [("в Комнате-В", "in Room V"), ("в Комнате-Z", "in Room Z")]
        {
            for (number, count) in [("два", "two"), ("три", "three"), ("четыре", "four")]
            {
                let pairs = [
                    (
                        format!("{count} {kinds} are {place}, right?"),
                        format!("Are there {count} {kinds} {place}?"),
                    ),
                    (
                        format!("{number} {kind} стоят {room}, да?"),
                        format!("Есть ли {room} {number} {kind}?"),
                    ),
                ];
                for (claim, question) in pairs {
                    let told = said(&claim).map(|(said, _)| said);
                    let plain = said(&question).map(|(said, _)| said);
                    asked += 1;
                    understood += usize::from(told.is_some());
                    assert!(told.is_none() || told == plain, "{claim}: {told:?} {plain:?}");
                }
            }
        }
    }
    assert!(understood * 4 >= asked, "{understood} of {asked}");
    for (thing, place) in [("Холодильник", "холодильнике"), ("Стеллаж", "стеллаже")]
    {
        let told = answered(&rb2, &format!("В {place} пусто?"), &mut Memory::default());
        let plain = answered(&rb2, &format!("{thing} пустой?"), &mut Memory::default());
        let yes = |told: &Option<String>| told.as_ref().map(|text| text.starts_with("Да"));
        assert!(told.is_none() || yes(&told) == yes(&plain), "{place}: {told:?} {plain:?}");
    }
    let two = said("Какая чашка красная, на чём стоит?");
    assert!(two.is_none_or(|(_, things)| things.len() == 2), "both are answered");
}

/// «Я на кухне, мне бы в спальню, как пройти?»: from where one is and to where one wants, or not at all.
#[test]
fn whither_one_wants_is_not_where_one_is() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let rooms = [("Комнате-В", "Комнату-В"), ("спальне", "спальню"), ("столовой", "столовую")];
    for (at, _) in rooms {
        for (other, to) in rooms.iter().filter(|(other, _)| *other != at) {
            let plain = format!("Как пройти в {to}?");
            let mut memory = Memory::default();
            answered(&rb2, &format!("Я в {at}."), &mut memory);
            let length = |line: &str, memory: &mut Memory| {
                let answer = rb2.ask(line, memory).expect("there is a map").ok()?;
                answer.number.map(f64::round)
            };
            let plain = length(&plain, &mut memory);
            for line in [
                format!("Мне бы в {to}, я в {at} сейчас, как пройти?"),
                format!("Я в {at}, мне надо в {to}, как пройти покороче?"),
            ] {
                let told = length(&line, &mut Memory::default());
                assert!(told.is_none() || told == plain, "{other}: {line}\n{told:?}\n{plain:?}");
            }
        }
    }
}
