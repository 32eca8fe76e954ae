//! What is said behind an order that was carried out: "No, the one on the table" is another of its kind, and "No, put it there"
//! an order of its own.

use std::collections::BTreeMap;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::{Entity, World};

use crate::talk::engine;

const HOUSES: [&str; 3] = [
    "../shared/data/procthor/house_4.json",
    "../shared/data/procthor/house_8.json",
    "../shared/data/procthor/house_2.json",
];

fn form(world: &World, entity: Entity, case: Case) -> String {
    NounPhrase::parse(world.name(entity), &names::hints(world, entity)).case(case)
}

/// What an order is done to.
fn done_to(engine: &Engine, order: &str, memory: &mut Memory) -> Option<Vec<Entity>> {
    let commands = engine.understand_in(order, memory).ok()?;
    commands.iter().map(|command| command.what().map(|what| what.id)).collect()
}

/// Whether a "no" behind an order is heard; it then means these and nothing else.
fn instead(engine: &Engine, no: &str, memory: &Memory, second: &[Entity]) -> bool {
    let Ok(Some(whole)) = engine.resumed(no, memory) else { return false };
    let meant = done_to(engine, &whole, &mut memory.clone());
    assert!(meant.as_deref().is_none_or(|meant| meant == second), "{no}: {whole}");
    meant.is_some()
}

#[test]
fn no_the_one_over_there_is_another_of_its_kind() {
    let (mut heard, mut missed) = (0, Vec::new());
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let relations = engine.relations().unwrap();
        // Kinds of which there is one thing on each of two supports.
        let mut kinds: BTreeMap<_, BTreeMap<_, Vec<Entity>>> = BTreeMap::new();
        for one in world.replicas.values().filter(|r| world.has_trait(r.id, "portable")) {
            let kind = world.objects[&one.object].object_type;
            if let Some(on) = relations.support_of(one.id) {
                let things = kinds.entry(kind).or_default().entry(on).or_default();
                things.push(Entity::Replica(one.id));
            }
        }
        for (kind, places) in kinds {
            let Some(kind) = world.types.object.get(kind) else { continue };
            let single: Vec<_> = places
                .into_iter()
                .filter(|(on, things)| {
                    let name = &world.replicas[on].name_en;
                    things.len() == 1 && !name.is_empty() && !relations.all_shut_in().contains(on)
                })
                .collect();
            for pair in single.windows(2) {
                let [(here, first), (there, second)] = pair else { continue };
                let name = |id| world.replicas[id].name_en.clone();
                let noun = kind.name_en.to_lowercase();
                let mut memory = Memory::default();
                let order = format!("Take the {noun} from {}", name(here));
                if done_to(&engine, &order, &mut memory).as_ref() != Some(first) {
                    continue;
                }
                for said in ["No, the one on", "Not that one, the one on"] {
                    let no = format!("{said} {}", name(there));
                    match instead(&engine, &no, &memory, second) {
                        true => heard += 1,
                        false => missed.push(format!("{order} – {no}")),
                    }
                }
                let hints = names::hints(world, first[0]);
                let bare = NounPhrase::parse(&kind.name.to_lowercase(), &hints);
                let mut memory = Memory::default();
                let order = format!(
                    "Возьми {} с {}",
                    bare.case(Case::Accusative),
                    form(world, Entity::Replica(*here), Case::Genitive)
                );
                if done_to(&engine, &order, &mut memory).as_ref() != Some(first) {
                    continue;
                }
                let place = form(world, Entity::Replica(*there), Case::Prepositional);
                for said in ["Нет, тот, что на", "Нет, ту, которая на", "Не тот, а тот, что на"]
                {
                    let no = format!("{said} {place}");
                    match instead(&engine, &no, &memory, second) {
                        true => heard += 1,
                        false => missed.push(format!("{order} – {no}")),
                    }
                }
            }
        }
    }
    assert!(heard > missed.len() && heard > 10, "{heard}; {missed:#?}");
}

/// Behind "no" an order is that order.
#[test]
fn an_order_behind_no_is_one_of_its_own() {
    for (first, no) in [
        ("Принеси зонт", "Нет, положи зонт на кровать"),
        ("Принеси зонт", "Нет, зонт положи на кровать"),
        ("Поезжай в спальню", "Нет, открой Дверь-ZY"),
        ("Bring the umbrella", "No, put the umbrella on the bed"),
        ("Go to Room-Y", "No, go to Room-Z"),
    ] {
        let place = |second: &str| {
            let mut engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
            let mut dialogue = orthoframe::engine::Dialogue::default();
            dialogue.hear(&mut engine, first, &mut |_, _| {}).unwrap();
            let heard = dialogue.hear(&mut engine, second, &mut |_, _| {}).unwrap();
            let ends: Vec<bool> = heard.tasks().map(|task| task.ending.is_done()).collect();
            let goals: Vec<_> = heard.tasks().flat_map(|task| task.goal.clone()).collect();
            (ends, goals)
        };
        let (_, plain) = no.split_once(", ").unwrap();
        let (denied, alone) = (place(no), place(plain));
        assert!(!alone.0.is_empty(), "{first} – {plain}");
        assert_eq!(format!("{denied:?}"), format!("{alone:?}"), "{first} – {no}");
    }
}

/// "I meant the other one, and take it there" is no order on the first one.
#[test]
fn what_was_meant_instead_is_what_the_order_behind_it_is_done_to() {
    let Some(engine) = engine("../shared/data/procthor/house_5.json") else { return };
    let world = engine.world().unwrap().clone();
    let goals = |line: &str| {
        let mut engine = Engine::in_memory(world.clone(), None).unwrap();
        let mut dialogue = orthoframe::engine::Dialogue::default();
        let mut last = String::new();
        let before = ["Where are the bowls?", "Take the one from the bedroom to the kitchen."];
        for said in before.into_iter().chain([line]) {
            let heard = dialogue.hear(&mut engine, said, &mut |_, _| {}).unwrap();
            last = format!("{:?}", heard.tasks().map(|task| &task.goal).collect::<Vec<_>>());
        }
        last
    };
    let done_to = |goals: &str| [1, 2].map(|n| goals.contains(&format!("Миска-{n}\"")));
    assert_eq!(done_to(&goals("Take it to the bathroom.")), [true, false]);
    // What is put right is not understood behind nothing: then nothing is done.
    let mut none = Engine::in_memory(world.clone(), None).unwrap();
    let mut dialogue = orthoframe::engine::Dialogue::default();
    dialogue.hear(&mut none, "Where is bowl 1?", &mut |_, _| {}).unwrap();
    let line = "I meant the other one, and take it to the bathroom";
    let heard = dialogue.hear(&mut none, line, &mut |_, _| {}).unwrap();
    assert_eq!(heard.tasks().count(), 0, "{}", heard.text());
    for line in [
        "Sorry, I meant the other one, and take it to the bathroom.",
        "I meant the other one, and take it to the bathroom",
        "No, the other one, and take it to the bathroom.",
        "Нет, другую, и отнеси её в ванную.",
        "Я имел в виду другую, и отнеси её в ванную.",
    ] {
        assert_eq!(done_to(&goals(line)), [false, true], "{line}");
    }
}
