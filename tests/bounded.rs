//! What bounds an order is kept or refused, never dropped: what is left out, through what not to go, which of two was compared,
//! on which storey.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::english;
use orthoframe_map::World;

use crate::talk::engine;

const HOUSES: [&str; 2] =
    ["../shared/data/procthor/house_2.json", "../shared/data/procthor/house_7.json"];

/// The names of what an order is done to; none where it is refused.
fn done_to(engine: &Engine, order: &str, memory: &mut Memory) -> Option<BTreeSet<String>> {
    let commands = engine.understand_in(order, memory).ok()?;
    let world = engine.world().expect("there is a map");
    let name = |what| world.name(what).to_owned();
    Some(commands.iter().filter_map(|c| c.what().map(|what| name(what.id))).collect())
}

fn symbols(engine: &Engine, question: &str) -> Option<BTreeSet<String>> {
    let answer = engine.ask(question, &mut Memory::default()).expect("there is a map").ok()?;
    Some(answer.symbols.into_iter().collect())
}

/// The kinds of what can be carried and of which there are several, by their English names.
fn carried_kinds(world: &World) -> BTreeSet<String> {
    let kind = |id| {
        let object = &world.objects[&world.replicas[id].object];
        world.types.object.get(object.object_type).map(|kind| kind.name_en.to_lowercase())
    };
    let carried = world.replicas.keys().filter(|id| world.has_trait(**id, "portable"));
    let all: Vec<String> = carried.filter_map(kind).collect();
    let many = |kind: &&String| all.iter().filter(|other| other == kind).count() > 1;
    all.iter().filter(many).cloned().collect()
}

/// "All the cups but the biggest one": all but that, whichever word says so.
#[test]
fn what_is_left_out_by_comparing_is_left_out() {
    let mut told = 0;
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        for kind in carried_kinds(engine.world().unwrap()) {
            let many = english::plural(&kind);
            let all = done_to(&engine, &format!("Bring all the {many}"), &mut Memory::default());
            for (n, best) in ["biggest", "smallest", "tallest", "widest"].iter().enumerate() {
                let Some(found) = symbols(&engine, &format!("Which {kind} is the {best}?")) else {
                    continue;
                };
                let but = ["but", "except"][n % 2];
                let order = format!("Bring all the {many} {but} the {best} one");
                let (Some(all), Some(taken)) =
                    (&all, done_to(&engine, &order, &mut Memory::default()))
                else {
                    continue;
                };
                // Of several that are equally big any is the biggest.
                assert!(taken.is_disjoint(&found) || found.len() > 1, "{order}: {taken:?}");
                assert!(taken.len() < all.len(), "{order}: {taken:?}");
                told += 1;
            }
        }
    }
    assert!(told > 15, "{told}");
}

/// "Which is bigger, A or B? – A. – Bring the smaller one.": B.
#[test]
fn the_other_of_two_that_were_compared_is_meant_by_its_measure() {
    let mut told = 0;
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        for kind in carried_kinds(world) {
            let Some(all) = symbols(&engine, &format!("Where are the {}?", english::plural(&kind)))
            else {
                continue;
            };
            let names: Vec<&String> = all.iter().collect();
            for pair in names.windows(2) {
                for (more, less) in [("bigger", "smaller"), ("smaller", "bigger")] {
                    let mut memory = Memory::default();
                    let called = |name: &String| {
                        let of_name = world.replicas.values().find(|r| r.name == *name);
                        of_name.map_or_else(String::new, |replica| replica.name_en.clone())
                    };
                    let (a, b) = (called(pair[0]), called(pair[1]));
                    let question = format!("Which is {more}, {a} or {b}?");
                    let Ok(answer) = engine.ask(&question, &mut memory).expect("there is a map")
                    else {
                        continue;
                    };
                    // They are equal, or cannot be compared.
                    let [one] = &answer.symbols[..] else { continue };
                    let other = pair.iter().find(|name| **name != one).expect("one of two");
                    for (said, meant) in [(less, *other), (more, one)] {
                        let order = format!("Bring the {said} one");
                        let Some(taken) = done_to(&engine, &order, &mut memory.clone()) else {
                            continue;
                        };
                        assert_eq!(taken, BTreeSet::from([meant.clone()]), "{question} {order}");
                        told += 1;
                    }
                }
            }
        }
    }
    assert!(told > 15, "{told}");
}

/// Through what not to go, and how near, is never dropped.
#[test]
fn a_bound_of_the_way_is_not_dropped() {
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let through = world.areas.values().map(|area| (&area.name_en, &area.name));
        let through: Vec<(&String, &String)> =
            through.chain(world.doors.values().map(|door| (&door.name_en, &door.name))).collect();
        for area in world.areas.values() {
            for (by, russian) in &through {
                let (to, name) = (&area.name_en, &area.name);
                for order in [
                    format!("Go to {to}, but not through {by}"),
                    format!("Go to {to} but not via {by}"),
                    format!("Don't go through {by}, go to {to}"),
                    format!("Go to {to}, not past {by}"),
                    format!("Go to {to}, but not closer than a metre"),
                    format!("Поезжай в «{name}», но не через «{russian}»"),
                    format!("Поезжай в «{name}», только не через «{russian}»"),
                    format!("Не открывай «{russian}», поезжай в «{name}»"),
                    format!("Поезжай в «{name}», но не ближе метра"),
                ] {
                    let heard = engine.understand(&order);
                    assert!(heard.is_err(), "{order}: {heard:?}");
                }
            }
        }
    }
}

/// What is on a storey is told by it; whither it goes is told by itself.
#[test]
fn a_storey_before_the_place_is_of_what_is_carried() {
    let Some(engine) = engine("../shared/data/cases/office-two-storeys.toml") else { return };
    let order = |line: &str| done_to(&engine, line, &mut Memory::default());
    let cups = |line: &str| symbols(&engine, line);
    for floor in ["ground", "upper"] {
        let found = cups(&format!("Which cups are on the {floor} floor?"));
        assert!(found.as_ref().is_some_and(|found| !found.is_empty()));
        for to in ["Desk 1", "the reception desk"] {
            assert_eq!(order(&format!("Bring all the cups on the {floor} floor to {to}")), found);
        }
    }
}
