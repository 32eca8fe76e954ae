//! What is told before a question: it bears upon the answer, is refused with its words, or bears upon nothing; and what
//! one word means of a few things that it fits.

use std::collections::BTreeMap;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::question::{Said, Thing};
use orthoframe_map::{Entity, Replica, World};
use orthoframe_units::ReplicaId;

use crate::files::long;
use crate::talk::engine;

const HOUSES: [&str; 3] =
    ["procthor/house_3.json", "procthor/house_6.json", "procthor/house_8.json"];
const CLINIC: &str = "rmf/clinic.building.yaml";

fn of_others(file: &str) -> Option<Engine> {
    engine(&format!("../shared/data/{file}"))
}

fn answered(engine: &Engine, line: &str) -> Result<orthoframe_language::question::Answer, String> {
    let answer = engine.ask(line, &mut Memory::default()).expect("there is a map");
    answer.map_err(|unanswered| unanswered.text)
}

/// The replicas of a map by the name of their kind, where each name is of one kind and its things are told apart by number.
fn kinds(world: &World) -> BTreeMap<String, Vec<&Replica>> {
    let mut kinds: BTreeMap<String, Vec<&Replica>> = BTreeMap::new();
    for replica in world.replicas.values() {
        let name = world.objects[&replica.object].name_en.to_lowercase();
        kinds.entry(name).or_default().push(replica);
    }
    kinds
}

/// Of every door it is told that it is stuck, or something that nothing knows: no way leads through it that is told then.
#[test]
fn what_is_said_of_a_door_bears_upon_the_way() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let world = rb2.world().unwrap();
    let (mut told, mut around) = (0, 0);
    for door in world.doors.values() {
        for area in world.areas.values() {
            for (says, stuck) in
                [("is stuck.", true), ("got a coat of paint,", false), ("is blocked:", true)]
            {
                let line = format!("{} {says} How do I get to {}?", door.name_en, area.name_en);
                let Ok(answer) = answered(&rb2, &line) else { continue };
                told += 1;
                assert!(stuck, "{line}\n  {}", answer.text);
                assert!(answer.text.contains("Avoiding"), "{line}\n  {}", answer.text);
                let (_, way) = answer.text.split_once("Avoiding").unwrap_or_default();
                let way = way.split_once(". ").map_or("", |(_, way)| way);
                let only = way.contains("this is the only way");
                assert!(only || !way.contains(&door.name_en), "{line}\n  {}", answer.text);
                around += 1;
            }
            let line = format!("{} заклинило. Как пройти в {}?", door.name, area.name);
            if let Ok(answer) = answered(&rb2, &line) {
                assert!(answer.text.contains("В обход"), "{line}\n  {}", answer.text);
            }
        }
    }
    assert!(told > 4 && around > 4, "{told}, {around}");
}

/// A lift that is out of order is taken by nobody, and one that stops at a storey goes there.
#[test]
fn a_lift_goes_where_it_stops_unless_it_is_out_of_order() {
    let Some(clinic) = of_others(CLINIC) else { return };
    let world = clinic.world().unwrap();
    for (name, stops) in &world.domain.lifts {
        let maps: Vec<_> =
            stops.iter().filter_map(|stop| Some(world.placement(stop.area)?.0)).collect();
        for map in world.maps.values() {
            let goes = maps.contains(&map.id);
            for line in [
                format!("Does {name} stop at {}?", map.name),
                format!("Does {name} go to {}?", map.name),
                format!("Ходит ли {name} на этаж {}?", map.name),
            ] {
                let answer = answered(&clinic, &line).expect("a plain question");
                let said = if goes { Said::Yes } else { Said::No };
                assert_eq!(answer.said, said, "{line}\n  {}", answer.text);
            }
        }
        for line in [
            format!("{name} is out of order. How do I get upstairs?"),
            format!("They say {name} is broken. Can I still get to the second floor?"),
            format!("Лифт {name} не работает. Как попасть на второй этаж?"),
        ] {
            let Ok(answer) = answered(&clinic, &line) else { continue };
            let taken = [format!("“{name}”"), format!("«{name}»")];
            assert!(
                !taken.iter().any(|own| answer.text.contains(own)),
                "{line}\n  {}",
                answer.text
            );
        }
    }
}

/// A place that is told with its storey, or what stands in a room, is where the person is; of a place that nothing knows
/// nothing is counted.
#[test]
fn where_the_person_is_counts_or_nothing_does() {
    let Some(clinic) = of_others(CLINIC) else { return };
    let world = clinic.world().unwrap();
    let places: Vec<_> = world.places.values().filter(|p| p.name_en.contains("counter")).collect();
    let mut same = 0;
    for from in &places {
        let Some((map, _)) = world.placement(from.area) else { continue };
        let storey = &world.maps[&map].name;
        for to in places.iter().filter(|to| to.id != from.id) {
            let whole = format!("How far is it from {} to {}?", from.name_en, to.name_en);
            let Ok(whole) = answered(&clinic, &whole) else { continue };
            for line in [
                format!("I'm at {} on {storey}. How far is it to {}?", from.name_en, to.name_en),
                format!("I am on {storey} at {}. How far is it to {}?", from.name_en, to.name_en),
            ] {
                let told = answered(&clinic, &line);
                assert_eq!(
                    told.as_ref().ok().and_then(|a| a.number),
                    whole.number,
                    "{line} {told:?}"
                );
                same += 1;
            }
            for line in [
                format!("I'm next to the blorb. How far is it to {}?", to.name_en),
                format!("I'm standing by the zork. How far is {}?", to.name_en),
                "I'm by the blorb upstairs. Which vending machine is nearest to me?".to_owned(),
                format!("Я стою у грумка. Далеко до {}?", to.name),
            ] {
                let told = answered(&clinic, &line);
                assert!(told.is_err(), "{line} {:?}", told.map(|a| a.text));
            }
        }
    }
    assert!(same > 4, "{same}");
}

/// What says of what alone a question is asked, in a sentence of its own, is heeded or refused.
#[test]
fn what_narrows_is_never_passed_over() {
    for house in HOUSES {
        let Some(engine) = of_others(house) else { return };
        let world = engine.world().unwrap();
        let step = if long() { 1 } else { 5 };
        for (kind, all) in kinds(world).iter().filter(|(_, all)| all.len() > 1).step_by(step) {
            for area in world.areas.values() {
                let room = &area.name_en;
                let within = all.iter().filter(|replica| replica.area == area.id).count();
                let kind = format!("{kind}s");
                for (told, count) in [
                    (format!("Only in the {room}."), within),
                    (format!("I only care about the {room}."), within),
                    (format!("In the {room}."), within),
                    (format!("Not counting the {room}."), all.len() - within),
                    (format!("I'm not interested in the {room}."), all.len() - within),
                ] {
                    let line = format!("{told} How many {kind} are there?");
                    let Ok(answer) = answered(&engine, &line) else { continue };
                    assert_eq!(answer.number, Some(count as f64), "{line}\n  {}", answer.text);
                }
            }
        }
    }
}

/// «Где сок?» of two is told of each; "it" is neither of them, and an order with "it" asks back.
#[test]
fn where_a_few_are_is_told_of_each_and_none_is_it() {
    for file in ["virtualhome/TestScene3_graph.json", HOUSES[0], HOUSES[1]] {
        let Some(engine) = of_others(file) else { return };
        let world = engine.world().unwrap();
        let mut told = 0;
        for (kind, all) in kinds(world).iter().filter(|(_, all)| (2..=5).contains(&all.len())) {
            let ids = || all.iter().map(|replica| Thing::Entity(Entity::Replica(replica.id)));
            let mut memory = Memory::default();
            let line = format!("Where is the {kind}?");
            let Ok(answer) = engine.ask(&line, &mut memory).unwrap() else { continue };
            // Another word of the map may be broader than the name of the kind.
            if answer.things.len() != all.len() {
                continue;
            }
            assert!(ids().all(|id| answer.things.contains(&id)), "{line}\n  {}", answer.text);
            told += 1;
            for then in ["What is it on?", "What colour is it?", "What is next to it?"] {
                if let Ok(one) = engine.ask(then, &mut memory.clone()).unwrap() {
                    let spoken =
                        ids().filter(|id| one.text.contains(world.name(entity(*id)))).count();
                    assert!(spoken != 1, "{line} {then}\n  {}", one.text);
                }
            }
        }
        assert!(told > 1, "{file}: {told}");
    }
}

fn entity(thing: Thing) -> Entity {
    match thing {
        Thing::Entity(entity) => entity,
        other => panic!("{other:?} is no thing of the map"),
    }
}

/// Of every two rooms: "more pictures on the walls of the one than of the other" is told as they are counted one by one.
#[test]
fn more_here_than_there_is_as_the_counts_say() {
    let mut compared = 0;
    for house in HOUSES {
        let Some(engine) = of_others(house) else { return };
        let world = engine.world().unwrap();
        let rooms: Vec<&String> = world.areas.values().map(|area| &area.name_en).collect();
        let count = |line: String| answered(&engine, &line).ok().and_then(|answer| answer.number);
        for (first, second) in rooms.iter().zip(rooms.iter().cycle().skip(1)) {
            for (kind, place) in
                [("paintings", "on the walls of"), ("chairs", "in"), ("things", "on the floor of")]
            {
                let each = [first, second]
                    .map(|room| count(format!("How many {kind} are there {place} the {room}?")));
                let [Some(here), Some(there)] = each else { continue };
                let last = place.split(' ').next_back().unwrap_or_default();
                for line in [
                    format!("Are there more {kind} {place} the {first} than {last} the {second}?"),
                    format!("Are there more {kind} {place} the {first} than {place} the {second}?"),
                    format!("Are there more {kind} {place} the {first} than the {second}?"),
                ] {
                    let Ok(answer) = answered(&engine, &line) else { continue };
                    let said = if here > there { Said::Yes } else { Said::No };
                    assert_eq!(answer.said, said, "{line} {here} {there}\n  {}", answer.text);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 20, "{compared}");
}

/// "Are there more red chairs than blue ones?", where the map does not tell of what colour they are.
#[test]
fn of_whose_colour_nothing_is_told_there_are_not_equally_many() {
    let mut unknown = 0;
    for house in HOUSES {
        let Some(engine) = of_others(house) else { return };
        for kind in kinds(engine.world().unwrap()).keys().step_by(3) {
            for (one, other) in [("red", "blue"), ("metal", "wooden"), ("black", "white")] {
                let many = |value: &str| {
                    let line = format!("Are there any {value} {kind}s?");
                    answered(&engine, &line).is_ok_and(|answer| answer.said == Said::Unknown)
                };
                let line = format!("Are there more {one} {kind}s than {other} {kind}s?");
                let Ok(answer) = answered(&engine, &line) else { continue };
                if many(one) || many(other) {
                    assert_eq!(answer.said, Said::Unknown, "{line}\n  {}", answer.text);
                    unknown += 1;
                }
            }
        }
    }
    assert!(unknown > 20, "{unknown}");
}

/// What lies in a sink or a basin is told where one asks what is on it.
#[test]
fn what_is_on_a_thing_that_nothing_shuts_is_told_with_what_is_in_it() {
    let mut told = 0;
    for n in [0, 1, 2, 3, 4, 5, 6, 8, 9] {
        let Some(engine) = of_others(&format!("procthor/house_{n}.json")) else { return };
        let world = engine.world().unwrap();
        let relations = engine.relations().unwrap();
        let mut held: BTreeMap<ReplicaId, Vec<&Replica>> = BTreeMap::new();
        for replica in world.replicas.values() {
            if let Some(holder) = relations.support_of(replica.id) {
                held.entry(holder).or_default().push(replica);
            }
        }
        let is_basin = |id: &ReplicaId| {
            let replica = &world.replicas[id];
            world.has_trait(*id, "container")
                && !world.has_trait(*id, "support")
                && orthoframe_map::stands(world, replica).is_none()
        };
        for (holder, things) in held.iter().filter(|(holder, _)| is_basin(holder)) {
            let name = &world.replicas[holder].name_en;
            let line = format!("What is on {name}?");
            let Ok(answer) = answered(&engine, &line) else { continue };
            for thing in things {
                assert!(
                    answer.text.contains(&thing.name_en),
                    "house {n}: {line}\n  {}",
                    answer.text
                );
            }
            told += 1;
        }
    }
    assert!(told > 2, "{told}");
}

/// Whether there is light in a room is told only where every lamp says so, or one that is on.
#[test]
fn there_is_light_where_a_lamp_is_on_and_none_where_all_are_off() {
    for file in
        ["virtualhome/TestScene2_graph.json", "virtualhome/TestScene3_graph.json", HOUSES[0]]
    {
        let Some(engine) = of_others(file) else { return };
        let world = engine.world().unwrap();
        for area in world.areas.values() {
            let lamps: Vec<Option<bool>> = world
                .replicas
                .values()
                .filter(|r| r.area == area.id && world.has_trait(r.id, "light"))
                .map(|r| orthoframe_map::is_on(&r.properties))
                .collect();
            let line = format!("Is the light on in the {}?", area.name_en);
            let Ok(answer) = answered(&engine, &line) else { continue };
            let known = match lamps.contains(&Some(true)) {
                true => Said::Yes,
                false if lamps.iter().all(|lamp| *lamp == Some(false)) => Said::No,
                false => Said::Unknown,
            };
            assert_eq!(answer.said, known, "{file}: {line}\n  {}", answer.text);
        }
    }
}

/// What is in a point is asked of the room where that is the only one, and of no point else.
#[test]
fn nothing_is_in_a_point() {
    for file in ["rmf/office.building.yaml", CLINIC] {
        let Some(engine) = of_others(file) else { return };
        let world = engine.world().unwrap();
        for place in world.places.values() {
            let alone = world.places.values().filter(|p| p.area == place.area).count() == 1;
            for line in [
                format!("What is in {}?", place.name_en),
                format!("How many chairs are in {}?", place.name_en),
                format!("Is there a chair in {}?", place.name_en),
            ] {
                let answer = answered(&engine, &line);
                assert!(alone || answer.is_err(), "{line}: {:?}", answer.map(|a| a.text));
            }
        }
    }
}

/// What is out of the question for who asks is no "other one": of two, the one that was told is left out, and of one nothing is
/// left.
#[test]
fn the_other_one_is_not_the_one_that_was_told() {
    let mut told = 0;
    for file in HOUSES {
        let Some(engine) = of_others(file) else { return };
        let world = engine.world().unwrap();
        for (kind, all) in kinds(world).iter().filter(|(_, all)| all.len() == 2) {
            let [first, second] = all[..] else { continue };
            if first.area == second.area {
                continue;
            }
            for (one, other) in [(first, second), (second, first)] {
                let room = &world.areas[&one.area].name_en;
                let line =
                    format!("The {kind} in the {room} fell over. Where is the other {kind}?");
                let Ok(answer) = answered(&engine, &line) else { continue };
                let is = |replica: &Replica| Thing::Entity(Entity::Replica(replica.id));
                assert_eq!(answer.things, [is(other)], "{line}\n  {}", answer.text);
                told += 1;
            }
        }
    }
    assert!(told > 2, "{told}");
}
