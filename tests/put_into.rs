//! What is said to go into a thing lies in it afterwards, or it is said why not: never on it.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Mode, change_now};
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::Entity;

use crate::files::{long, shared};

/// Some kinds of things of every house, in both languages; `ORTHOFRAME_LONG` all things.
#[test]
fn what_is_put_into_a_thing_lies_in_it() {
    const MAPS: [&str; 3] = [
        "procthor/house_7.json",
        "virtualhome/TestScene3_graph.json",
        "virtualhome/TestScene2_graph.json",
    ];
    let (mut done, mut refused, mut wrong) = (0, Vec::new(), Vec::new());
    for map in MAPS {
        let Some(path) = shared(map) else { return };
        let dir = tempfile::tempdir().unwrap();
        let mut engine = Engine::open(dir.path(), None).unwrap();
        let change = change_now("test", "");
        engine.import(&path, &change).unwrap();
        engine.edit_world(&change, Mode::Commit, |world| world.robot.opens = true).unwrap();
        let world = engine.world().unwrap().clone();
        let mut dialogue = Dialogue::default();
        let shut = engine.relations().unwrap().all_shut_in();
        let free = world.replicas.values().filter(|r| !shut.contains(&r.id));
        let small = free.filter(|r| world.has_trait(r.id, "portable"));
        let thing = small.min_by_key(|r| r.name.len()).expect("there is something to carry");
        let mut kinds = BTreeSet::new();
        for holder in world.replicas.values().filter(|r| r.id != thing.id) {
            let kind = world.objects[&holder.object].object_type;
            if !long() && (!kinds.insert(kind) || kinds.len() % 3 > 0) {
                continue;
            }
            let russian = |id| {
                let entity = Entity::Replica(id);
                NounPhrase::parse(world.name(entity), &names::hints(&world, entity))
                    .case(Case::Accusative)
            };
            let order = match done % 2 {
                0 => format!("Put {} in {}", thing.name_en, holder.name_en),
                _ => format!("Положи {} в {}", russian(thing.id), russian(holder.id)),
            };
            let asked = format!("Is {} in {}?", thing.name_en, holder.name_en);
            let heard = dialogue.hear(&mut engine, &order, &mut |_, _| {}).unwrap();
            let is_done = heard.tasks().any(|task| task.ending.is_done());
            let said = heard.text();
            let told = dialogue.hear(&mut engine, &asked, &mut |_, _| {}).unwrap().text();
            match (is_done, told.starts_with("Yes")) {
                (true, true) => done += 1,
                (false, _) => refused.push(format!("{order}: {said}")),
                (true, false) => wrong.push(format!("{order}: {}", told)),
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(done > 3 && refused.len() > 5, "{done} done; {refused:#?}");
}
