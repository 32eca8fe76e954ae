//! The places of an order tell each other: where a thing is, within what the second place is, which rooms are visited, and
//! from what something is taken.

use std::collections::BTreeMap;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::command::{Command, Relation};
use orthoframe_map::{Entity, World};
use orthoframe_units::AreaId;

use crate::talk::engine;

const HOUSES: [&str; 3] = [
    "../shared/data/procthor/house_7.json",
    "../shared/data/virtualhome/TestScene3_graph.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

fn heard(engine: &Engine, lines: &[&str]) -> Result<Vec<Command<Entity>>, String> {
    let mut memory = Memory::default();
    let mut last = Ok(Vec::new());
    for line in lines {
        last = engine
            .understand_in(line, &mut memory)
            .map_err(|e| e.say(orthoframe_language::Language::of(line)));
    }
    last
}

/// The kinds of things of a trait, by their English names, with the things and their rooms.
fn kinds(world: &World, wanted: &str) -> BTreeMap<String, Vec<(Entity, AreaId)>> {
    let mut kinds: BTreeMap<String, Vec<(Entity, AreaId)>> = BTreeMap::new();
    for replica in world.replicas.values().filter(|r| world.has_trait(r.id, wanted)) {
        let kind = world.types.object.get(world.objects[&replica.object].object_type);
        let name = kind.map(|kind| kind.name_en.to_lowercase()).unwrap_or_default();
        kinds.entry(name).or_default().push((Entity::Replica(replica.id), replica.area));
    }
    kinds
}

/// Of a kind, the only one in a room.
fn only_in(things: &[(Entity, AreaId)], room: AreaId) -> Option<Entity> {
    let mut there = things.iter().filter(|(_, area)| *area == room);
    there.next().filter(|_| there.next().is_none()).map(|(thing, _)| *thing)
}

/// "Take the mug to the kitchen and put it on the table": on the one in the kitchen, where there is one.
#[test]
fn the_second_place_is_within_the_first() {
    let mut told = 0;
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let thing = kinds(world, "portable").into_values().flatten().next().unwrap().0;
        let thing =
            &world.replicas.values().find(|r| Entity::Replica(r.id) == thing).unwrap().name_en;
        for (kind, things) in kinds(world, "support").into_iter().filter(|(_, all)| all.len() > 1) {
            for area in world.areas.values() {
                let Some(only) = only_in(&things, area.id) else { continue };
                let room = &area.name_en;
                for order in [
                    format!("Take {thing} to {room} and put it on the {kind}"),
                    format!("Go to {room} and put {thing} on the {kind}"),
                ] {
                    let Ok(commands) = heard(&engine, &[&order]) else { continue };
                    let Some(Command::Put { to, .. }) = commands.last() else {
                        panic!("{order}: {commands:?}")
                    };
                    assert_eq!(to.anchor, only, "{order}");
                    told += 1;
                }
            }
        }
    }
    assert!(told > 10, "{told}");
}

/// "Go to the bedroom. Bring the mug from there", «тот, что …», "the one in …": the one that is there.
#[test]
fn from_there_is_from_what_was_spoken_of() {
    let mut told = 0;
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        for (kind, things) in kinds(world, "portable").into_iter().filter(|(_, all)| all.len() > 1)
        {
            for area in world.areas.values() {
                let Some(only) = only_in(&things, area.id) else { continue };
                let room = &area.name_en;
                for lines in [
                    [format!("Go to {room}"), format!("Bring the {kind} from there")],
                    [String::new(), format!("Go to {room} and bring me the {kind} from there")],
                    [format!("Поезжай: «{}»", area.name), format!("Bring the {kind} from there")],
                ] {
                    let lines: Vec<&str> =
                        lines.iter().map(String::as_str).filter(|line| !line.is_empty()).collect();
                    let Ok(commands) = heard(&engine, &lines) else { continue };
                    let what = commands.last().and_then(|c| c.what()).map(|what| what.id);
                    assert_eq!(what, Some(only), "{lines:?}");
                    told += 1;
                }
            }
        }
    }
    assert!(told > 20, "{told}");
}

/// "Get me something to read from the kitchen": what is there, or it is said that there is none.
#[test]
fn what_serves_is_looked_for_where_it_is_said_to_be() {
    const USES: [(&str, &str); 3] = [
        ("something to read", "чтобы почитать"),
        ("something to drink", "попить"),
        ("something to write with", "чем писать"),
    ];
    let (mut there, mut nowhere) = (0, 0);
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        for (said, _) in USES {
            for area in world.areas.values() {
                let order = format!("Bring me {said} from {}", area.name_en);
                match heard(&engine, &[&order]) {
                    Ok(commands) => {
                        let Some(Entity::Replica(id)) = commands[0].what().map(|what| what.id)
                        else {
                            panic!("{order}: {commands:?}")
                        };
                        assert_eq!(world.replicas[&id].area, area.id, "{order}");
                        there += 1;
                    }
                    // Of no single thing is it said that it is not there.
                    Err(told) => {
                        let named = world.replicas.values().any(|r| told.contains(&r.name_en));
                        assert!(!named, "{order}: {told}");
                        nowhere += 1;
                    }
                }
            }
        }
    }
    assert!(there > 5 && nowhere > 5, "{there} {nowhere}");
}

/// Each room that is named is visited, in the order of the sentence, and no other.
#[test]
fn rooms_are_visited_as_they_are_named() {
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let rooms: Vec<_> = world.areas.values().collect();
        let visited = |order: &str| -> Vec<Entity> {
            let commands = heard(&engine, &[order]).unwrap_or_else(|e| panic!("{order}: {e}"));
            let to = |c: &Command<Entity>| match c {
                Command::GoTo { to, .. } => to.anchor,
                other => panic!("{order}: {other:?}"),
            };
            commands.iter().map(to).collect()
        };
        for n in 0..rooms.len() {
            let own: Vec<_> = (0..3).map(|k| rooms[(n + k) % rooms.len()]).collect();
            let [a, b, c] = &own[..] else { unreachable!() };
            let wanted: Vec<Entity> = own.iter().map(|area| Entity::Area(area.id)).collect();
            for order in [
                format!("Visit {}, {} and {}", a.name_en, b.name_en, c.name_en),
                format!("Go to {}, {} and {}", a.name_en, b.name_en, c.name_en),
                format!("Visit {} and {}, then return to {}", a.name_en, b.name_en, c.name_en),
                format!("Обойди «{}», «{}» и «{}»", a.name, b.name, c.name),
            ] {
                assert_eq!(visited(&order), wanted, "{order}");
            }
            let but: Vec<Entity> =
                rooms.iter().filter(|r| r.id != a.id).map(|r| Entity::Area(r.id)).collect();
            for order in [
                format!("Visit all rooms except {}", a.name_en),
                format!("Go to every room but {}", a.name_en),
                format!("Обойди все комнаты, кроме «{}»", a.name),
            ] {
                let mut visited = visited(&order);
                visited.sort();
                assert_eq!(visited, but, "{order}");
            }
        }
        // What is no room is not gone around.
        for (_, things) in kinds(world, "support") {
            let name = world.name(things[0].0);
            assert!(heard(&engine, &[&format!("Обойди «{name}»")]).is_err(), "{name}");
        }
    }
}

/// «Открой шкаф и достань книгу»: one that is in it, or it is said that there is none.
#[test]
fn what_is_opened_is_what_something_is_taken_out_of() {
    let (mut taken, mut none) = (0, 0);
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let holders: Vec<_> = kinds(world, "container").into_values().flatten().collect();
        for (kind, things) in kinds(world, "portable").into_iter().take(12) {
            for (holder, _) in holders.iter().take(15).filter(|h| !things.contains(h)) {
                let name = orthoframe_language::names::english_name(world, *holder);
                let order = format!("Open {name} and take out the {kind}");
                let Ok(commands) = heard(&engine, &[&order]) else {
                    none += 1;
                    continue;
                };
                let id = commands.last().and_then(|c| c.what()).map(|what| what.id).unwrap();
                let asked = format!(
                    "Is {} in {name}?",
                    orthoframe_language::names::english_name(world, id)
                );
                let answer = engine.ask(&asked, &mut Memory::default()).unwrap().unwrap();
                assert!(answer.text.starts_with("Yes"), "{order}: {}", answer.text);
                taken += 1;
            }
        }
    }
    assert!(taken > 0 && none > 20, "{taken} {none}");
}

/// What is said to be in a thing is put in, however else the place is told.
#[test]
fn in_is_never_on() {
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let thing = kinds(world, "portable").into_values().flatten().next().unwrap().0;
        let thing = orthoframe_language::names::english_name(world, thing);
        for holder in kinds(world, "container").into_values().flatten().map(|(holder, _)| holder) {
            let name = orthoframe_language::names::english_name(world, holder);
            for order in [
                format!("Put {thing} in {name}"),
                format!("Put {thing} inside {name}"),
                format!("Put {thing} into {name}"),
            ] {
                let Ok(commands) = heard(&engine, &[&order]) else { continue };
                let [Command::Put { to, .. }] = &commands[..] else {
                    panic!("{order}: {commands:?}")
                };
                assert_eq!((to.relation, to.anchor), (Relation::In, holder), "{order}");
            }
        }
    }
}

/// "The lamp on the nightstand in the bedroom with the computer": the room has the computer, and all that it is said to
/// have, and in that room the nightstand stands.
#[test]
fn a_room_behind_a_place_is_told_by_what_it_has() {
    let Some(engine) = engine(HOUSES[1]) else { return };
    for (described, named) in [
        (
            "Switch on the lamp on the nightstand in the bedroom with the computer.",
            "Switch on Table lamp 3.",
        ),
        ("Включи лампу на тумбочке в спальне с компьютером.", "Включи Настольную лампу-3."),
        (
            "Put Cupcake 1 on the desk in the bedroom with the bed and the computer.",
            "Put Cupcake 1 on Desk 2.",
        ),
        (
            "Положи Пирожное-1 на письменный стол в спальне с кроватью и компьютером.",
            "Положи Пирожное-1 на Письменный стол-2.",
        ),
    ] {
        let named = format!("{:?}", heard(&engine, &[named]).expect(named));
        assert_eq!(format!("{:?}", heard(&engine, &[described]).expect(described)), named);
    }
}

/// "Put the mug next to the sink": on the counter that the sink is let into, and not on the floor before it.
#[test]
fn beside_what_is_let_into_a_counter_is_on_the_counter() {
    let mut told = 0;
    for map in &HOUSES[1..2] {
        let Some(mut engine) = engine(map) else { return };
        let world = engine.world().unwrap().clone();
        let fixed = |name: &str| match world.find(name)[..] {
            [Entity::Replica(id)] => !world.has_trait(id, "portable"),
            _ => false,
        };
        let thing = kinds(&world, "portable").into_values().flatten().next().unwrap().0;
        for row in engine.query("?- INSIDE(X, Y)", false).unwrap().rows {
            let [anchor, holder] = [0, 1].map(|n| row[n].to_string());
            let holds =
                |id: &Entity| matches!(id, Entity::Replica(id) if world.has_trait(*id, "support"));
            if !fixed(&anchor) || !world.find(&holder).iter().any(holds) || told > 1 {
                continue;
            }
            let order = format!("Положи {} рядом с {anchor}", world.name(thing));
            let Ok(commands) = heard(&engine, &[&order]) else { continue };
            let mut dialogue = orthoframe::engine::Dialogue::default().keeping_nothing();
            let heard = dialogue.hear(&mut engine, &order, &mut |_, _| {}).unwrap();
            for goal in heard.tasks().flat_map(|task| &task.goal) {
                assert_eq!(goal.args.last(), Some(&holder), "{order}: {commands:?}");
                told += 1;
            }
        }
    }
    assert!(told > 0, "nothing was put beside a thing that is let into another");
}
