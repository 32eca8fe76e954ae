//! What a line says of what it means holds of what is told: a door is no room, "all" are those that were told, a desk on which
//! a mug is looked for is no mug; over all things of maps, and where that cannot be, it is asked back.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::command::Command;
use orthoframe_language::question::{Answer, Said, Thing};
use orthoframe_language::{Case, NounPhrase, Number, WordHints, english};
use orthoframe_map::{Entity, World};
use orthoframe_units::{ReplicaId, TypeId, name_key};

use crate::files::long;
use crate::talk::engine;

const OFFICE: &str = "../shared/data/rmf/office.building.yaml";
const CLINIC: &str = "../shared/data/rmf/clinic.building.yaml";

/// Maps of ours and of others.
fn maps() -> impl Iterator<Item = Engine> {
    const MAPS: [&str; 5] = [
        OFFICE,
        "../shared/data/procthor/house_6.json",
        "../shared/data/virtualhome/TestScene1_graph.json",
        "maps/rb2.toml",
        "../shared/data/procthor/house_3.json",
    ];
    MAPS.into_iter().take(if long() { 5 } else { 3 }).filter_map(engine)
}

fn ask(engine: &Engine, line: &str, memory: &mut Memory) -> Option<Answer> {
    engine.ask(line, memory).expect("there is a map").ok()
}

fn replica(id: ReplicaId) -> Thing {
    Thing::Entity(Entity::Replica(id))
}

/// The things of each type, by the type.
fn by_type(world: &World) -> BTreeMap<TypeId, Vec<ReplicaId>> {
    let mut kinds: BTreeMap<TypeId, Vec<ReplicaId>> = BTreeMap::new();
    for thing in world.replicas.values() {
        if let Some(kind) = world.objects[&thing.object].object_type {
            kinds.entry(kind).or_default().push(thing.id);
        }
    }
    kinds
}

/// The name of a type in both languages.
fn names(world: &World, kind: TypeId) -> (String, String) {
    let entry = world.types.object.get(Some(kind)).expect("a type that is used");
    (entry.name.clone(), entry.name_en.to_lowercase())
}

fn many(russian: &str, case: Case) -> String {
    NounPhrase::parse(russian, &WordHints::default()).form(case, Number::Plural).to_lowercase()
}

/// «Сколько шкафов?» on a map of bookcases («книжный шкаф») and cabinets: of whatever the language calls so, and never of the
/// one sort alone whose name ends with the word.
#[test]
fn the_end_of_a_name_is_not_one_sort_alone() {
    let mut asked = 0;
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        let kinds = by_type(world);
        let called = |kind: &TypeId| {
            let entry = world.types.object.get(Some(*kind)).expect("a type that is used");
            entry
                .synonyms
                .iter()
                .chain([&entry.name])
                .map(|name| name_key(name))
                .collect::<Vec<_>>()
        };
        let whole: BTreeSet<String> = kinds.keys().flat_map(called).collect();
        let ends: BTreeSet<String> = whole
            .iter()
            .filter_map(|name| name.rsplit_once(' '))
            .map(|(_, end)| end.to_owned())
            .filter(|end| !whole.contains(end))
            .collect();
        for end in ends {
            let own = english::words_of(&end);
            let meant = kinds.iter().filter(|(kind, _)| {
                let (_, name) = names(world, **kind);
                own.iter().any(|word| word.to_lowercase() == name)
            });
            let meant: BTreeSet<Thing> =
                meant.flat_map(|(_, all)| all).copied().map(replica).collect();
            let question = format!("Сколько {}?", many(&end, Case::Genitive));
            let Some(answer) = ask(&engine, &question, &mut Memory::default()) else { continue };
            let told: BTreeSet<Thing> = answer.things.iter().copied().collect();
            assert!(meant.is_subset(&told), "{question} {}", answer.text);
            asked += usize::from(!meant.is_empty());
        }
    }
    assert!(asked > 0, "{asked}");
}

/// "How wide is the door coe?", where a room or a point is called so: the coe_door, or nothing; no room is a door.
#[test]
fn what_is_called_a_door_is_a_door() {
    let (mut told, mut refused) = (0, 0);
    for engine in [OFFICE, CLINIC].into_iter().filter_map(engine).chain(maps().skip(1)) {
        let world = engine.world().expect("there is a map");
        let doors: Vec<&str> = world.doors.values().map(|door| door.name.as_str()).collect();
        let is_door = |entity: &Entity| matches!(entity, Entity::Door(_));
        let others = world.names().map(|(entity, _)| entity).filter(|entity| !is_door(entity));
        let others: BTreeSet<String> = others.map(|e| world.name(e).to_owned()).collect();
        let ends = world.doors.values().filter_map(|door| door.name_en.rsplit_once(['_', ' ']));
        let own = ends.map(|(own, _)| own.to_owned());
        for name in own.chain(others.into_iter().take(60)) {
            if doors.contains(&name.as_str()) || name.is_empty() {
                continue;
            }
            for question in
                [format!("How wide is the door {name}?"), format!("Какая ширина у двери {name}?")]
            {
                let Some(answer) = ask(&engine, &question, &mut Memory::default()) else {
                    refused += 1;
                    continue;
                };
                let opens = |thing: &Thing| {
                    matches!(thing, Thing::Opening(_) | Thing::Entity(Entity::Door(_)))
                };
                assert!(answer.things.iter().all(opens), "{question} {}", answer.text);
                told += answer.things.len();
            }
        }
    }
    assert!(told > 4 && refused > 20, "{told} told, {refused} refused");
}

/// "How many cups are there? Are all clean?": the cups. Where nothing was told, nothing is meant; "everything" is all there is.
#[test]
fn all_are_those_that_were_told() {
    let mut asked = 0;
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        for (kind, things) in by_type(world).iter().filter(|(_, all)| all.len() > 1) {
            let (russian, english) = names(world, *kind);
            let lists = [
                (
                    format!("How many {} are there?", english::plural(&english)),
                    ["Are all open?", "Are all clean?"],
                ),
                (
                    format!("Сколько {}?", many(&russian, Case::Genitive)),
                    ["Все ли открыты?", "Все чистые?"],
                ),
            ];
            for (list, questions) in lists {
                for question in questions {
                    let mut memory = Memory::default();
                    let nothing = engine.ask(question, &mut memory).expect("there is a map");
                    assert!(nothing.is_err(), "{question} {}", nothing.unwrap().text);
                    let Some(told) = ask(&engine, &list, &mut memory) else { continue };
                    let told: BTreeSet<Thing> = told.things.into_iter().collect();
                    if !things.iter().all(|id| told.contains(&replica(*id))) {
                        continue;
                    }
                    let Some(answer) = ask(&engine, question, &mut memory) else { continue };
                    let of_them = answer.things.iter().all(|thing| told.contains(thing));
                    assert!(of_them, "{list} {question} {}", answer.text);
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 20, "{asked}");
}

/// "Where is the mug on the desk?" of several desks: what is told is a mug, or it is asked which desk.
#[test]
fn where_something_is_on_one_of_several_tells_of_no_other_kind() {
    let mut asked = 0;
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        let kinds = by_type(world);
        let bears = |id: &ReplicaId| world.has_trait(*id, "support");
        let places: Vec<_> =
            kinds.iter().filter(|(_, all)| all.len() > 1 && all.iter().all(bears)).collect();
        let carried = |id: &ReplicaId| world.has_trait(*id, "portable");
        for (kind, _) in kinds.iter().filter(|(_, all)| all.iter().all(carried)).take(25) {
            for (place, places_of) in &places {
                let (name, place) = (names(world, *kind).1, names(world, **place).1);
                for question in [
                    format!("Where is the {name} on the {place}?"),
                    format!("Where is the {name} not on the {place}?"),
                    format!("Where is the {name} that is not on the {place}?"),
                ] {
                    let Some(answer) = ask(&engine, &question, &mut Memory::default()) else {
                        continue;
                    };
                    if answer.said != Said::Found {
                        continue;
                    }
                    let is_place =
                        |thing: &Thing| places_of.iter().any(|id| replica(*id) == *thing);
                    assert!(!answer.things.iter().any(is_place), "{question} {}", answer.text);
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 10, "{asked}");
}

/// «Где столы? Поезжай к ним»: to each of them; "put it on them", to one of which nothing says which, is asked back.
#[test]
fn to_them_is_to_all_or_it_is_asked() {
    let (mut gone, mut asked_back) = (0, 0);
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        let stands =
            |id: &ReplicaId| world.has_trait(*id, "support") && !world.has_trait(*id, "portable");
        let Some(thing) = world.replicas.values().find(|r| world.has_trait(r.id, "portable"))
        else {
            continue;
        };
        for (kind, things) in by_type(world) {
            if !(2..9).contains(&things.len()) || !things.iter().all(stands) {
                continue;
            }
            let (russian, english) = names(world, kind);
            let taken =
                NounPhrase::parse(&thing.name, &WordHints::default()).case(Case::Accusative);
            for (list, go, put) in [
                (
                    format!("Where are the {}?", english::plural(&english)),
                    "Go to them",
                    format!("Put {} on them", thing.name_en),
                ),
                (
                    format!("Где {}?", many(&russian, Case::Nominative)),
                    "Поезжай к ним",
                    format!("Отнеси {taken} к ним"),
                ),
            ] {
                let mut memory = Memory::default();
                let Some(told) = ask(&engine, &list, &mut memory) else { continue };
                let told: BTreeSet<Thing> = told.things.into_iter().collect();
                if told.len() < 2 {
                    continue;
                }
                if let Ok(commands) = engine.understand_in(go, &mut memory.clone()) {
                    let whither = commands.iter().filter_map(Command::place);
                    let whither: BTreeSet<Thing> =
                        whither.map(|place| Thing::Entity(place.anchor)).collect();
                    assert_eq!(whither, told, "{list} {go}");
                    gone += 1;
                }
                let ordered = engine.understand_in(&put, &mut memory.clone());
                assert!(ordered.is_err(), "{list} {put}: {ordered:?}");
                asked_back += 1;
            }
        }
    }
    assert!(gone > 3 && asked_back > 3, "{gone} {asked_back}");
}

/// "Come to me": where the person is, only the person can tell, wherever the robot has been.
#[test]
fn who_calls_is_where_he_said_to_be() {
    let mut gone = 0;
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        for room in world.areas.values().take(8) {
            let at = NounPhrase::parse(&room.name, &WordHints::default());
            let at = orthoframe_language::russian::where_at(&at);
            for (told, order) in [
                (format!("I am in the {}.", room.name_en), "Come to me"),
                (format!("Я {at}."), "Подъедь ко мне"),
            ] {
                let mut memory = Memory::default();
                let unknown = engine.understand_in(order, &mut memory);
                assert!(unknown.is_err(), "{order}: {unknown:?}");
                if ask(&engine, &told, &mut memory).is_none() {
                    continue;
                }
                let Ok(commands) = engine.understand_in(order, &mut memory) else { continue };
                let whither = commands.iter().filter_map(Command::place).map(|place| place.anchor);
                let whither: Vec<Entity> = whither.collect();
                assert_eq!(whither, [Entity::Area(room.id)], "{told} {order}");
                gone += 1;
            }
        }
    }
    assert!(gone > 5, "{gone}");
}

/// Lifts are asked of by where they stop: a cabin is on no storey rather than another.
#[test]
fn lifts_are_on_the_storeys_where_they_stop() {
    let Some(engine) = engine(CLINIC) else { return };
    let world = engine.world().expect("there is a map");
    let storeys: Vec<&str> = world.maps.values().map(|map| map.name.as_str()).collect();
    let lines = [
        ["How many lifts are there?", "Which floors do they go to?"],
        ["Сколько здесь лифтов?", "На какие этажи они ходят?"],
    ];
    let mut questions = vec![
        "How many lifts are there and which floors do they go to?".to_owned(),
        "Сколько здесь лифтов и на какие этажи они ходят?".to_owned(),
    ];
    for (name, _) in &world.domain.lifts {
        questions.push(format!("Which floors does {name} go to?"));
        questions.push(format!("Which floor is {name} on?"));
        questions.push(format!("На какие этажи ходит лифт {name}?"));
    }
    let alone = questions.iter().map(|question| vec![question.as_str()]);
    for lines in alone.chain(lines.iter().map(|lines| lines.to_vec())) {
        let mut memory = Memory::default();
        let answer = lines.iter().map(|line| ask(&engine, line, &mut memory)).last().flatten();
        let text = answer.unwrap_or_else(|| panic!("{lines:?} is not understood")).text;
        assert!(storeys.iter().all(|storey| text.contains(storey)), "{lines:?} {text}");
    }
}

/// "How many cups are there? What are they called?": the cups; and of many, none is "it".
#[test]
fn those_that_were_told_are_named_and_none_of_many_is_it() {
    let (mut named, mut unclear) = (0, 0);
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        for (kind, things) in by_type(world).iter().filter(|(_, all)| all.len() > 1) {
            let (russian, english) = names(world, *kind);
            for (list, name, it) in [
                (
                    format!("How many {} are there?", english::plural(&english)),
                    "What are they called?",
                    "How big is it?",
                ),
                (
                    format!("Сколько {}?", many(&russian, Case::Genitive)),
                    "Как они называются?",
                    "Какого она цвета?",
                ),
            ] {
                let mut memory = Memory::default();
                let Some(told) = ask(&engine, &list, &mut memory) else { continue };
                if told.things.len() != things.len() {
                    continue;
                }
                if let Some(answer) = ask(&engine, name, &mut memory.clone()) {
                    let all: BTreeSet<&Thing> = answer.things.iter().collect();
                    assert_eq!(all, told.things.iter().collect(), "{list} {name} {}", answer.text);
                    named += 1;
                }
                if things.len() > 8 {
                    let unanswered = engine.ask(it, &mut memory).expect("there is a map");
                    let unanswered = unanswered.expect_err("one of many was taken");
                    assert_eq!(unanswered.doubt.kind(), "incomplete", "{list} {it}");
                    unclear += 1;
                }
            }
        }
    }
    assert!(named > 10 && unclear > 2, "{named} named, {unclear} unclear");
}

/// «Сколько стульев на кухне? А в спальне? А всего?»: the sum of the two, and all that there are beside it.
#[test]
fn a_sum_of_places_hides_no_others() {
    let mut more = 0;
    for engine in maps().skip(1) {
        let world = engine.world().expect("there is a map");
        let rooms: Vec<_> = world.areas.values().take(3).collect();
        let [first, second, ..] = rooms[..] else { continue };
        for (kind, things) in by_type(world).iter().filter(|(_, all)| all.len() > 2) {
            let plural = english::plural(&names(world, *kind).1);
            let mut memory = Memory::default();
            let lines = [
                format!("How many {plural} are there in the {}?", first.name_en),
                format!("And in the {}?", second.name_en),
            ];
            let sum: Option<f64> = lines
                .iter()
                .map(|line| ask(&engine, line, &mut memory).and_then(|answer| answer.number))
                .sum();
            let whole =
                ask(&engine, &format!("How many {plural} are there?"), &mut Memory::default());
            let whole = whole.filter(|whole| whole.things.len() == things.len());
            let (Some(sum), Some(whole)) = (sum, whole.and_then(|whole| whole.number)) else {
                continue;
            };
            let Some(answer) = ask(&engine, "And in total?", &mut memory) else { continue };
            if sum > 0.0 && whole > sum {
                let (sum, whole) = (sum.to_string(), whole.to_string());
                assert!(
                    answer.text.contains(&sum) && answer.text.contains(&whole),
                    "{lines:?} {}",
                    answer.text
                );
                more += 1;
            }
        }
    }
    assert!(more > 2, "{more}");
}

/// "They sent me to the lab. Which door do I go through?": to the lab, or it is not understood; never any door that there is.
#[test]
fn a_door_to_go_through_leads_somewhere() {
    let mut refused = 0;
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        for room in world.areas.values().take(6) {
            let name = &room.name_en;
            for line in [
                format!("They sent me to the {name}. Which door do I go through?"),
                format!("My boss waits in the {name}, which door do I go through?"),
                format!("Someone wants me in the {name}; which door do I go through?"),
                "Which door do I go through?".to_owned(),
                "Через какую дверь мне идти?".to_owned(),
            ] {
                match ask(&engine, &line, &mut Memory::default()) {
                    None => refused += 1,
                    Some(answer) => {
                        let own = answer.text.to_lowercase().contains(&name.to_lowercase());
                        assert!(own, "{line} {}", answer.text);
                    }
                }
            }
        }
    }
    assert!(refused > 10, "{refused}");
}

/// "Put the book on the sofa. Turn off the light there": in the room of the sofa, where none is on it.
#[test]
fn what_is_switched_there_is_in_the_room() {
    let mut switched = 0;
    for engine in maps().skip(1) {
        let (world, relations) =
            (engine.world().expect("there is a map"), engine.relations().unwrap());
        let Some(thing) = world.replicas.values().find(|r| world.has_trait(r.id, "portable"))
        else {
            continue;
        };
        let bears =
            |id: &ReplicaId| world.has_trait(*id, "support") && !world.has_trait(*id, "portable");
        for place in world.replicas.values().filter(|replica| bears(&replica.id)).take(12) {
            let mut memory = Memory::default();
            let put = format!("Put {} on {}", thing.name_en, place.name_en);
            if engine.understand_in(&put, &mut memory).is_err() {
                continue;
            }
            let Ok(commands) = engine.understand_in("Turn off the light there", &mut memory) else {
                continue;
            };
            for what in commands.iter().filter_map(|command| command.what()) {
                let Entity::Replica(id) = what.id else { continue };
                assert_eq!(relations.area_of(id), relations.area_of(place.id), "{put}");
                switched += 1;
            }
        }
    }
    assert!(switched > 2, "{switched}");
}

/// «Горит что-нибудь?» asks for what gives light, and not for its switches; «каких они цветов» for colours, and not for flowers.
#[test]
fn what_burns_gives_light_and_colours_are_no_flowers() {
    let mut lit = 0;
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        for question in ["Что горит?", "А теперь горит что-нибудь?", "Горит ли что-нибудь?"]
        {
            let Some(answer) = ask(&engine, question, &mut Memory::default()) else { continue };
            let gives_light = |thing: &Thing| match thing {
                Thing::Entity(Entity::Replica(id)) => world.has_trait(*id, "light"),
                _ => false,
            };
            assert!(answer.things.iter().all(gives_light), "{question} {}", answer.text);
            lit += answer.things.len();
        }
        for (kind, _) in by_type(world).into_iter().take(12) {
            let kinds = many(&names(world, kind).0, Case::Genitive);
            let said = |colours: &str| {
                let question = format!("Сколько {kinds} и {colours}?");
                ask(&engine, &question, &mut Memory::default()).map(|answer| answer.text)
            };
            let plain = said("какого они цвета");
            for colours in ["каких они цветов", "каких цветов"] {
                assert_eq!(said(colours), plain, "{kinds}, {colours}");
            }
        }
    }
    assert!(lit > 0, "{lit}");
}

/// «Сколько стульев на кухне? А в спальне есть ещё?», "Is there another in the bedroom?": chairs, or it is not understood;
/// never whatever is there.
#[test]
fn another_is_of_the_kind_that_was_asked_for() {
    let (mut told, mut refused) = (0, 0);
    for engine in maps() {
        let world = engine.world().expect("there is a map");
        let rooms: Vec<_> = world.areas.values().take(3).collect();
        for (kind, things) in by_type(world) {
            let (russian, english) = names(world, kind);
            for room in &rooms {
                let at = NounPhrase::parse(&room.name, &WordHints::default());
                let at = orthoframe_language::russian::where_at(&at);
                for (opening, line) in [
                    (
                        format!("How many {} are there?", english::plural(&english)),
                        format!("Is there another in the {}?", room.name_en),
                    ),
                    (
                        format!("Сколько {}?", many(&russian, Case::Genitive)),
                        format!("А {at} есть ещё?"),
                    ),
                ] {
                    let mut memory = Memory::default();
                    refused += usize::from(ask(&engine, &line, &mut memory).is_none());
                    let Some(before) = ask(&engine, &opening, &mut memory) else { continue };
                    if before.things.len() != things.len() {
                        continue;
                    }
                    let Some(answer) = ask(&engine, &line, &mut memory) else { continue };
                    let own = |thing: &Thing| things.iter().any(|id| replica(*id) == *thing);
                    assert!(answer.things.iter().all(own), "{opening} {line} {}", answer.text);
                    told += 1;
                }
            }
        }
    }
    assert!(told > 10 && refused > 10, "{told} told, {refused} refused");
}

/// "What is on the table in the kitchen? And the one in the hall?": what is on the table there, and on no other.
#[test]
fn the_one_elsewhere_bears_its_own() {
    let mut heard = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        for (kind, things) in by_type(world) {
            let bears = |id: &ReplicaId| {
                world.replicas.keys().any(|other| relations.support_of(*other) == Some(*id))
            };
            let mut rooms = BTreeMap::new();
            for id in things.into_iter().filter(bears) {
                rooms.entry(world.replicas[&id].area).or_insert_with(Vec::new).push(id);
            }
            let single: Vec<_> = rooms.iter().filter(|(_, all)| all.len() == 1).collect();
            let noun = names(world, kind).1;
            for pair in single.windows(2) {
                let [here, there] = [0, 1].map(|n| world.areas[pair[n].0].name_en.clone());
                let whole = |room: &str| format!("What is on the {noun} in the {room}?");
                let plain = ask(&engine, &whole(&there), &mut Memory::default());
                for and in
                    ["And the one in the", "And on the one in the", "What about the one in the"]
                {
                    let mut memory = Memory::default();
                    if ask(&engine, &whole(&here), &mut memory).is_none() {
                        continue;
                    }
                    let said = ask(&engine, &format!("{and} {there}?"), &mut memory);
                    if let Some(said) = said {
                        let plain = plain.as_ref().map(|plain| &plain.things);
                        assert_eq!(Some(&said.things), plain, "{} – {and} {there}", whole(&here));
                        heard += 1;
                    }
                }
            }
        }
    }
    assert!(heard > 5, "{heard}");
}
