//! A denial is so where what it denies is not, however it is said: orders under conditions rest on it.

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::Language;
use orthoframe_language::command::is_order;
use orthoframe_language::question::conditional;

use crate::talk::engine;

/// Whether what a line says is so; none where it is not understood.
fn is_so(engine: &Engine, line: &str) -> Option<bool> {
    engine.ask(line, &mut Memory::default()).expect("there is a map").ok()?.is_so()
}

/// How a claim is said, and how it is denied.
struct Claim {
    said: String,
    denied: Vec<String>,
}

/// What there is, in a room and on a thing: its kind in the nominative and genitive of several, and the places.
fn claims(language: Language) -> Vec<Claim> {
    let mut claims = Vec::new();
    match language {
        Language::Russian => {
            let kinds = [
                ("стулья", "стульев", "красные", "красных"),
                ("столы", "столов", "чёрные", "чёрных"),
                ("книги", "книг", "красные", "красных"),
                ("чашки", "чашек", "белые", "белых"),
                ("кровати", "кроватей", "белые", "белых"),
                ("телевизоры", "телевизоров", "чёрные", "чёрных"),
            ];
            for place in ["в Комнате-В", "в Комнате-Z", "в Коридоре", "на Столе-1"]
            {
                for (are, of, like, of_like) in kinds {
                    for (are, of) in [
                        (are.to_owned(), of.to_owned()),
                        (format!("{like} {are}"), format!("{of_like} {of}")),
                    ] {
                        claims.push(Claim {
                            said: format!("Есть ли {place} {are}?"),
                            denied: vec![
                                format!("{place} нет {of}?"),
                                format!("{of} нет {place}?"),
                                format!("{place} нету {of}?"),
                            ],
                        });
                    }
                }
                claims.push(Claim {
                    said: format!("Есть ли что-нибудь {place}?"),
                    denied: vec![format!("{place} ничего нет?"), format!("{place} нет ничего?")],
                });
            }
            for (thing, states) in [
                ("Телевизор-1", ["включён", "выключен"]),
                ("Холодильник-1", ["открыт", "закрыт"]),
                ("Дверь-ВZ", ["открыта", "закрыта"]),
            ] {
                claims.extend(states.map(|state| Claim {
                    said: format!("{thing} {state}?"),
                    denied: vec![
                        format!("{thing} не {state}?"),
                        format!("Правда ли, что {thing} не {state}?"),
                    ],
                }));
            }
        }
        Language::English => {
            for place in ["in Room V", "in Room Z", "in the corridor", "on Table 1"] {
                for kinds in ["chairs", "tables", "books", "cups", "red books", "white cups"] {
                    claims.push(Claim {
                        said: format!("Are there {kinds} {place}?"),
                        denied: vec![
                            format!("Are there no {kinds} {place}?"),
                            format!("Are there not any {kinds} {place}?"),
                            format!("Is it true that there are no {kinds} {place}?"),
                        ],
                    });
                }
                claims.push(Claim {
                    said: format!("Is there anything {place}?"),
                    denied: vec![
                        format!("Is there nothing {place}?"),
                        format!("Is nothing {place}?"),
                        format!("Is it true that there is nothing {place}?"),
                    ],
                });
            }
            for (thing, states) in [
                ("Television 1", ["on", "off"]),
                ("Refrigerator 1", ["open", "closed"]),
                ("Door VZ", ["open", "closed"]),
                ("Medicine", ["on Bedside table 2", "in Room V"]),
            ] {
                claims.extend(states.map(|state| Claim {
                    said: format!("Is {thing} {state}?"),
                    denied: vec![
                        format!("Is {thing} not {state}?"),
                        format!("Is it true that {thing} is not {state}?"),
                    ],
                }));
            }
        }
    }
    claims
}

#[test]
fn a_denial_is_so_where_what_it_denies_is_not() {
    let engine = engine("maps/rb2.toml").expect("part of the crate");
    for language in [Language::Russian, Language::English] {
        let (mut asked, mut understood, mut so) = (0, 0, 0);
        for claim in claims(language) {
            let Some(said) = is_so(&engine, &claim.said) else { continue };
            so += usize::from(said);
            for denied in &claim.denied {
                asked += 1;
                if let Some(told) = is_so(&engine, denied) {
                    understood += 1;
                    assert_eq!(told, !said, "{} {denied}", claim.said);
                }
            }
        }
        assert!(asked > 60 && so > 8, "{asked} {so}");
        assert!(understood * 10 >= asked * 8, "{understood} of {asked} in {language:?}");
    }
}

#[test]
fn an_order_is_done_where_its_denied_condition_is_so() {
    let engine = engine("maps/rb2.toml").expect("part of the crate");
    let holds = |line: &str| {
        let question = conditional(line).unwrap_or_else(|| panic!("{line}")).question;
        is_so(&engine, &question)
    };
    for (there, empty) in [("in Room V", false), ("in the corridor", true)] {
        for line in [
            format!("If there are no chairs {there}, go to Room V"),
            format!("If there aren't any chairs {there}, go to Room V"),
            format!("Go to Room V if there is no chair {there}"),
        ] {
            assert_eq!(holds(&line), Some(empty), "{line}");
        }
    }
    for (there, empty) in [("в Комнате-В", false), ("в Коридоре", true)] {
        for line in [
            format!("Если {there} нет стульев, поезжай в Комнату-В"),
            format!("Если стульев {there} нет, поезжай в Комнату-В"),
            format!("Поезжай в Комнату-В, если {there} нет стульев"),
        ] {
            assert_eq!(holds(&line), Some(empty), "{line}");
        }
    }
}

/// Each of two claims that a word joins counts, and has its own thing or place.
#[test]
fn two_claims_are_so_where_both_are() {
    let engine = engine("maps/rb2.toml").expect("part of the crate");
    let mut understood = 0;
    let mut check = |one: &str, other: &str, both: String| {
        let told = is_so(&engine, &both);
        let each = is_so(&engine, one).zip(is_so(&engine, other));
        if let (Some(told), Some((one, other))) = (told, each) {
            understood += 1;
            assert_eq!(told, one && other, "{both}");
        }
    };
    let things = ["Television 1", "Refrigerator 1", "Stove 1", "Floor lamp 1"];
    for one in things {
        for other in things.into_iter().filter(|other| *other != one) {
            for (is, are) in [("on", "off"), ("off", "off"), ("closed", "off"), ("on", "closed")] {
                check(
                    &format!("Is {one} {is}?"),
                    &format!("Is {other} {are}?"),
                    format!("Is {one} {is} and {other} {are}?"),
                );
            }
        }
    }
    let places = ["in Room V", "in Room Z", "in the corridor"];
    for kinds in ["chairs", "books", "tables"] {
        for one in places {
            for other in places.into_iter().filter(|other| *other != one) {
                let there = |place: &str| format!("Are there {kinds} {place}?");
                let both = format!("Are there {kinds} {one} and {other}?");
                check(&there(one), &there(other), both);
                let both = format!("Is there a chair {one} and a book {other}?");
                let of = |a: &str, place: &str| format!("Is there a {a} {place}?");
                check(&of("chair", one), &of("book", other), both);
            }
        }
    }
    let things = [("Телевизор-1", "выключен", "включён"), ("Холодильник-1", "закрыт", "открыт")];
    for [(one, is, not), (other, so, no)] in [things, [things[1], things[0]]] {
        for a in [is, not] {
            for b in [so, no] {
                for joint in [" и", ", а"] {
                    check(
                        &format!("{one} {a}?"),
                        &format!("{other} {b}?"),
                        format!("{one} {a}{joint} {other} {b}?"),
                    );
                }
            }
        }
    }
    assert!(understood > 40, "{understood}");
}

/// A Russian verb in the past orders behind «чтобы» alone: «Ты закрыл дверь?» is no order.
#[test]
fn what_was_done_is_no_order() {
    let verbs = [
        "включил",
        "выключил",
        "открыл",
        "закрыл",
        "запер",
        "принёс",
        "привёз",
        "взял",
        "положил",
        "поставил",
        "отнёс",
        "нашёл",
        "подал",
        "достал",
        "поехал",
        "подъехал",
        "принесла",
    ];
    for verb in verbs {
        for line in [
            "Ты VERB его?",
            "Ты VERB его",
            "VERB его",
            "Ну что, ты VERB его?",
            "Робот, ты VERB его?",
        ] {
            let line = line.replace("VERB", verb);
            assert!(!is_order(&line), "{line}");
        }
        for line in ["Хочу, чтобы ты VERB его", "Надо, чтобы ты VERB его", "Чтобы ты VERB его"]
        {
            let line = line.replace("VERB", verb);
            assert!(is_order(&line), "{line}");
        }
    }
}

/// "Bring me the phone that is not in the kitchen": the only one elsewhere, or it is asked back of those that are; never one
/// that is there.
#[test]
fn a_denial_within_a_description_tells_of_the_thing() {
    let Some(engine) = engine("../shared/data/procthor/house_7.json") else { return };
    let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
    let mut told = 0;
    for thing in world.replicas.values().filter(|thing| world.has_trait(thing.id, "portable")) {
        let kind = world.objects[&thing.object].object_type;
        let Some(called) = world.types.object.get(kind) else { continue };
        let alike =
            world.replicas.values().filter(|r| world.objects[&r.object].object_type == kind);
        for area in world.areas.values() {
            let outside = |id| relations.area_of(id) != Some(area.id);
            let others: Vec<_> = alike.clone().map(|r| r.id).filter(|id| outside(*id)).collect();
            let (kind, room) = (called.name_en.to_lowercase(), &area.name_en);
            for clause in ["that is not in", "which is not in", "that isn't in"] {
                let order = format!("Bring me the {kind} {clause} {room}");
                let Ok(commands) = engine.understand(&order) else { continue };
                let said = format!("{commands:?}");
                let [only] = others[..] else { panic!("{order}: {said}") };
                assert!(said.contains(&format!("Replica({only:?})")), "{order}: {said}");
                told += 1;
            }
        }
    }
    assert!(told > 20, "{told}");
}

/// What rooms have and what they lack, in any order and with any joint: as it is so of each room by itself. Where only the
/// one is denied the other is not.
#[test]
fn a_denial_ends_where_something_else_is_said_to_be_there() {
    let engine = engine("maps/rb2.toml").expect("part of the crate");
    let kinds = [
        ["кровать", "кровати", "a bed", "bed"],
        ["диван", "дивана", "a sofa", "sofa"],
        ["холодильник", "холодильника", "a fridge", "fridge"],
        ["телевизор", "телевизора", "a TV", "TV"],
        ["шкаф", "шкафа", "a wardrobe", "wardrobe"],
    ];
    let rooms = ["Комнате-В", "Комнате-Z", "Комнате-Y", "Коридоре"];
    let symbols = ["Комната-В", "Комната-Z", "Комната-Y", "Коридор"];
    let has = |kind: &str, room: &str| {
        is_so(&engine, &format!("Есть ли {kind} в {room}?")).expect("a plain question")
    };
    let mut understood = 0;
    let mut asked = 0;
    for [there, there_of, a, bare] in kinds {
        for [lacks, lacks_of, another, no] in kinds {
            if there == lacks {
                continue;
            }
            let with: Vec<&str> = (0..rooms.len())
                .filter(|n| has(there, rooms[*n]) && !has(lacks, rooms[*n]))
                .map(|n| symbols[n])
                .collect();
            let neither: Vec<&str> = (0..rooms.len())
                .filter(|n| !has(there, rooms[*n]) && !has(lacks, rooms[*n]))
                .map(|n| symbols[n])
                .collect();
            let not_both: Vec<&str> = (0..rooms.len())
                .filter(|n| !(has(there, rooms[*n]) && has(lacks, rooms[*n])))
                .map(|n| symbols[n])
                .collect();
            let lines = [
                (format!("В каких комнатах есть {there}, но нет {lacks_of}?"), &with),
                (format!("В каких комнатах нет {lacks_of}, но есть {there}?"), &with),
                (format!("В каких комнатах нет {lacks_of}, зато есть {there}?"), &with),
                (format!("В каких комнатах есть {there} и нет {lacks_of}?"), &with),
                (format!("В каких комнатах нет {lacks_of} и есть {there}?"), &with),
                (format!("В каких комнатах нет {lacks_of} и {there_of}?"), &neither),
                (format!("В каких комнатах нет ни {lacks_of}, ни {there_of}?"), &neither),
                (format!("Which rooms have {a} but no {no}?"), &with),
                (format!("Which rooms have no {no} but have {a}?"), &with),
                (format!("Which rooms have no {no} but {a}?"), &with),
                (format!("Which rooms have {a} and no {no}?"), &with),
                (format!("Which rooms have no {no} and {a}?"), &with),
                (format!("How many rooms have no {no} but have {a}?"), &with),
                (format!("Which rooms have no {no} and no {bare}?"), &neither),
                (format!("Which rooms have neither {another} nor {a}?"), &neither),
                (format!("Which rooms don't have both {another} and {a}?"), &not_both),
            ];
            for (line, so) in lines {
                asked += 1;
                let answer = engine.ask(&line, &mut Memory::default()).expect("there is a map");
                let Ok(answer) = answer else { continue };
                understood += 1;
                let mut told = answer.symbols.clone();
                told.sort();
                let mut so: Vec<String> = so.iter().map(|room| (*room).to_owned()).collect();
                so.sort();
                assert_eq!(told, so, "{line}: {}", answer.text);
            }
        }
    }
    assert!(understood * 10 > asked * 8, "{understood} of {asked}");
}

/// A thing in a room that has something: the room has it, and not the thing.
#[test]
fn what_stands_behind_a_room_is_in_the_room() {
    let engine = engine("maps/rb2.toml").expect("part of the crate");
    let rooms = [("Комнате-В", "Room V"), ("Комнате-Z", "Room Z"), ("Комнате-Y", "Room Y")];
    let things = [("стулья", "the chairs"), ("книги", "the books"), ("столы", "the tables")];
    let kinds = [("диван", "диваном", "a sofa"), ("кровать", "кроватью", "a bed")];
    for (things, the_things) in things {
        for (kind, with, a) in kinds {
            let of = |room: &str| {
                let any = is_so(&engine, &format!("Есть ли {things} в {room}?"));
                let has = is_so(&engine, &format!("Есть ли {kind} в {room}?"));
                any.zip(has).expect("plain questions")
            };
            let all = rooms.iter().map(|(room, _)| of(room)).all(|(any, has)| !any || has);
            let elsewhere = is_so(&engine, &format!("Есть ли {things} в Коридоре?")) == Some(true);
            for line in [
                format!("Все ли {things} в комнатах с {with}?"),
                format!("Are all {the_things} in rooms with {a}?"),
            ] {
                let so = is_so(&engine, &line);
                assert!(so.is_none_or(|so| so == (all && !elsewhere)), "{line}: {so:?}");
                assert!(so.is_some(), "{line}");
            }
        }
    }
}
