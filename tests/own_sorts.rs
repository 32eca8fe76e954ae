//! What is counted, measured and switched is told as what it is: rooms apart from things of the same word, one state apart
//! from another, photographs apart from paintings, and how far things are with what it is measured between.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::command::Command;
use orthoframe_language::question::Thing;
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::{DoorKind, Entity, Mark, World};

use crate::files::shared;
use crate::talk::engine;

const CLINIC: &str = "rmf/clinic.building.yaml";
const SCENES: [&str; 3] = [
    "../shared/data/virtualhome/TestScene1_graph.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
    "../shared/data/virtualhome/TestScene3_graph.json",
];
const HOUSES: [&str; 3] =
    ["procthor/house_2.json", "procthor/house_8.json", "procthor/house_5.json"];

fn told(engine: &Engine, question: &str) -> (String, Option<f64>) {
    let answer = engine.ask(question, &mut Memory::default()).expect("there is a map");
    let answer = answer.unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text));
    (answer.text, answer.number)
}

fn form(world: &World, entity: Entity, case: Case) -> String {
    NounPhrase::parse(world.name(entity), &names::hints(world, entity)).case(case)
}

#[test]
fn rooms_and_things_of_one_word_are_not_counted_together() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let world = clinic.world().unwrap();
    let rooms = world.areas.values().filter(|area| area.name_en.starts_with("Toilet")).count();
    let things = world.replicas.values().filter(|r| r.name_en.starts_with("Toilet")).count();
    assert!(rooms > 1 && things > 1);
    let (english, _) = told(&clinic, "How many toilets are there?");
    assert!(english.contains(&format!("{rooms} rooms (")), "{english}");
    assert!(english.contains(&format!("{things} things (")), "{english}");
    // Russian has a word for each.
    assert_eq!(told(&clinic, "Сколько туалетов в здании?").1, Some(rooms as f64));
    assert_eq!(told(&clinic, "Сколько унитазов в здании?").1, Some(things as f64));
    // What one word means alone is counted as before.
    assert_eq!(told(&clinic, "How many wheelchairs are there?").1, Some(9.0));
}

/// A stove is closed and off: of what it is asked is told, and of its state both.
#[test]
fn what_is_open_and_on_is_told_of_as_both() {
    let mut asked = 0;
    for scene in SCENES {
        let Some(engine) = engine(scene) else { return };
        let world = engine.world().unwrap();
        for replica in world.replicas.values() {
            let marks = [Mark::State, Mark::Power].map(|mark| mark.of(&replica.properties));
            let [Some((_, shut)), Some((_, off))] = marks else { continue };
            let shut = if shut == "Закрыто" { "closed" } else { "open" };
            let off = if off == "Выключено" { "switched off" } else { "switched on" };
            let name = &replica.name_en;
            let (state, _) = told(&engine, &format!("What state is {name} in?"));
            assert!(state.contains(shut) && state.contains(off), "{state}");
            for (question, own, other) in [("on", off, shut), ("closed", shut, off)] {
                let (text, _) = told(&engine, &format!("Is {name} {question}?"));
                assert!(text.contains(own) && !text.contains(other), "{text}");
            }
            asked += 1;
        }
    }
    assert!(asked > 3, "{asked}");
}

/// "Which doors are sliding?", "Is L1_hr a hinged door?": the sort of a door is an adjective, with its noun or without.
#[test]
fn doors_and_rooms_are_asked_for_by_their_sorts() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let world = clinic.world().unwrap();
    for sort in world.types.door.entries.values() {
        let own = world.doors.values().filter(|door| door.door_type == Some(sort.id));
        let own: Vec<_> = own.collect();
        let Some(first) = own.iter().find(|door| !door.name_en.is_empty()) else { continue };
        let (adjective, name) = (&sort.name_en, &first.name_en);
        if first.kind == DoorKind::Passage {
            continue;
        }
        let number = |question: &str| told(&clinic, question).1;
        assert_eq!(
            number(&format!("How many {adjective} doors are there?")),
            Some(own.len() as f64)
        );
        let listed = clinic.ask(&format!("Which doors are {adjective}?"), &mut Memory::default());
        assert_eq!(listed.unwrap().unwrap().things.len(), own.len(), "{adjective}");
        let (text, _) = told(&clinic, &format!("Is {name} a {adjective} door?"));
        assert!(text.starts_with("Yes"), "{text}");
        let (text, _) = told(&clinic, &format!("What kind of door is {name}?"));
        assert!(text.contains(adjective), "{text}");
    }
    let toilets = clinic.ask("Which rooms are toilets?", &mut Memory::default());
    let areas = toilets.unwrap().unwrap().things;
    assert!(areas.len() > 1 && areas.iter().all(|thing| thing.area().is_some()), "{areas:?}");
}

/// "Which door is the front door?", "Which table is Side table 1?": what stands behind "is", and not all of the first word.
#[test]
fn which_of_a_sort_is_what_is_named_tells_it_alone() {
    let mut asked = 0;
    for house in HOUSES {
        let Some(engine) = engine(&format!("../shared/data/{house}")) else { return };
        let world = engine.world().unwrap();
        let things = |question: &str| match engine.ask(question, &mut Memory::default()).unwrap() {
            Ok(answer) => answer.things,
            Err(doubt) => panic!("{question}: {}", doubt.text),
        };
        for replica in world.replicas.values() {
            let word = replica.name_en.split(' ').rev().find(|word| word.parse::<u32>().is_err());
            let (word, name) = (word.unwrap().to_lowercase(), &replica.name_en);
            let told = things(&format!("Which {word} is {name}?"));
            assert_eq!(told, [Thing::Entity(Entity::Replica(replica.id))], "{word}, {name}");
            asked += 1;
        }
        let outer = things("Which doors lead outside?");
        assert_eq!(things("Which door is the front door?"), outer, "{house}");
        if let [only] = outer[..] {
            let sort = told(&engine, "What kind of door is the front door?").0;
            let Thing::Entity(Entity::Door(id)) = only else { panic!("{only:?}") };
            let kind = world.doors[&id].door_type.expect("a sort");
            assert!(sort.contains(&world.types.door.entries[&kind].name_en), "{sort}");
            asked += 1;
        }
    }
    assert!(asked > 30, "{asked}");
}

#[test]
fn where_the_file_says_that_robots_charge_is_a_charger() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let text = std::fs::read_to_string(shared(CLINIC).expect("it was read")).unwrap();
    let chargers: BTreeSet<String> = text
        .lines()
        .filter(|line| line.contains("is_charger: [4, true]"))
        .filter_map(|line| line.split(", {").next()?.rsplit(", ").next())
        .map(str::to_lowercase)
        .collect();
    assert!(chargers.len() > 3, "{chargers:?}");
    for question in
        ["Where are the chargers?", "List the charging stations", "Где зарядные станции?"]
    {
        let (text, _) = told(&clinic, question);
        let lower = text.to_lowercase();
        chargers.iter().for_each(|name| assert!(lower.contains(name), "{name}: {text}"));
    }
    for question in ["What robots are in the building?", "Сколько роботов в здании?"]
    {
        let refused = clinic.ask(question, &mut Memory::default()).expect("a map").unwrap_err();
        let kept = ["keeps no robots", "роботов карта не хранит"];
        assert!(
            kept.iter().any(|kept| refused.text.to_lowercase().contains(kept)),
            "{}",
            refused.text
        );
    }
}

/// How many of a word the file has by the names of its assets.
#[test]
fn photographs_are_no_paintings() {
    for house in HOUSES {
        let Some(engine) = engine(&format!("../shared/data/{house}")) else { return };
        let text = std::fs::read_to_string(shared(house).expect("it was read")).unwrap();
        let count =
            |asset: &str| text.matches(&format!("\"assetId\": \"Wall_Decor_{asset}")).count();
        let (photos, paintings) = (count("Photo"), count("Painting"));
        let number = |question: &str| told(&engine, question).1.unwrap_or_default() as usize;
        assert_eq!(number("How many photographs are there?"), photos, "{house}");
        assert_eq!(number("How many paintings are there?"), paintings, "{house}");
        // «Картины» are all that hangs in frames.
        assert_eq!(number("Сколько картин в доме?"), photos + paintings, "{house}");
        assert_eq!(number("How many pictures are there?"), photos + paintings, "{house}");
    }
}

/// The room that has the most of something in a place is the one in which the most are counted there.
#[test]
fn what_a_room_has_the_most_of_is_counted_in_the_place_that_is_told() {
    for house in HOUSES {
        let Some(engine) = engine(&format!("../shared/data/{house}")) else { return };
        let world = engine.world().unwrap();
        for (what, place) in [("pictures", "on the walls"), ("things", "on the floor")] {
            let counts = world.areas.values().map(|area| {
                let question = format!("How many {what} are {place} in {}?", area.name_en);
                (told(&engine, &question).1.unwrap_or_default() as usize, &area.name_en)
            });
            let counts: Vec<(usize, &String)> = counts.collect();
            let most = counts.iter().map(|(count, _)| *count).max().expect("there are rooms");
            let (text, _) = told(&engine, &format!("Which room has the most {what} {place}?"));
            for (_, room) in counts.iter().filter(|(count, _)| *count == most) {
                assert!(
                    text.to_lowercase().contains(&room.to_lowercase()),
                    "{most} {room}: {text}"
                );
            }
            assert!(text.contains(&most.to_string()), "{most}: {text}");
        }
    }
}

#[test]
fn how_far_things_are_is_told_with_what_it_is_measured_between() {
    let Some(engine) = engine(&format!("../shared/data/{}", HOUSES[0])) else { return };
    let world = engine.world().unwrap();
    let things: Vec<_> = world.replicas.values().step_by(5).collect();
    for pair in things.windows(2) {
        let [a, b] = pair else { continue };
        for question in [
            format!("How far is {} from {}?", a.name_en, b.name_en),
            format!("What's the distance between {} and {}?", a.name_en, b.name_en),
        ] {
            let (text, _) = told(&engine, &question);
            assert!(text.contains("between the nearest edges"), "{question} {text}");
        }
        let [a, b] = [a, b].map(|r| form(world, Entity::Replica(r.id), Case::Genitive));
        let (text, _) = told(&engine, &format!("Как далеко от {a} до {b}?"));
        assert!(text.contains("между ближайшими краями"), "{text}");
    }
}

/// "I want the soap on the bed" is said of a place, and switches nothing; "put on the bed" is an order to put it there.
#[test]
fn on_before_a_place_switches_nothing() {
    let mut put = 0;
    for house in HOUSES {
        let Some(engine) = engine(&format!("../shared/data/{house}")) else { return };
        let world = engine.world().unwrap();
        let understood = |order: &str| engine.understand_in(order, &mut Memory::default()).ok();
        let on = world.replicas.values().find(|r| world.has_trait(r.id, "support"));
        let Some(on) = on else { continue };
        for replica in world.replicas.values().filter(|r| world.has_trait(r.id, "portable")) {
            let (thing, place) = (&replica.name_en, &on.name_en);
            for way in ["on", "off"] {
                let said = understood(&format!("I want {thing} {way} the {place}"));
                let mut said = said.iter().flatten();
                let switches =
                    said.any(|c| matches!(c, Command::SwitchOn(_) | Command::SwitchOff(_)));
                assert!(!switches, "{thing} {way} the {place}");
            }
            let plain = understood(&format!("Put {thing} on {place}"));
            let wanted = understood(&format!("I want {thing} put on {place}"));
            assert_eq!(plain, wanted, "{thing} on {place}");
            put += usize::from(plain.is_some());
        }
    }
    assert!(put > 10, "{put}");
}

/// The light of a room is its lamps and the switch for them.
#[test]
fn the_light_of_a_room_goes_out_by_its_lamps_and_its_switch() {
    let Some(engine) = engine(SCENES[0]) else { return };
    let world = engine.world().unwrap();
    for area in world.areas.values() {
        let light = |r: &&orthoframe_map::Replica| {
            let switch = r.name_en.starts_with("Light switch");
            r.area == area.id && (switch || world.has_trait(r.id, "light"))
        };
        let lights: BTreeSet<Entity> =
            world.replicas.values().filter(light).map(|r| Entity::Replica(r.id)).collect();
        if lights.is_empty() {
            continue;
        }
        let place = form(world, Entity::Area(area.id), Case::Prepositional);
        let (at, name) = (if place == "Кухне" { "на" } else { "в" }, &area.name_en);
        for order in [format!("Погаси свет {at} {place}"), format!("Turn off the light in {name}")]
        {
            let commands = engine.understand_in(&order, &mut Memory::default());
            let commands = commands.unwrap_or_else(|_| panic!("{order}"));
            let done: BTreeSet<Entity> =
                commands.iter().filter_map(|c| Some(c.what()?.id)).collect();
            assert_eq!(done, lights, "{order}");
        }
    }
}
