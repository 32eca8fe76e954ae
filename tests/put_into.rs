//! What is said to go into a thing lies in it afterwards, or it is said why not: never on it.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Mode, change_now};
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::Entity;

use crate::files::{long, shared};

/// A thing to carry and what it is to be put into: in English, and in Russian in a case.
struct Named<'a> {
    english: [&'a str; 2],
    russian: &'a dyn Fn(usize, Case) -> String,
}

/// Some kinds of things of every house, in both languages; `ORTHOFRAME_LONG` all things. How many orders were done, and which
/// were refused.
fn put_into(
    holds: bool,
    lines: impl Fn(usize, &Named<'_>) -> Vec<String>,
) -> Option<(usize, usize)> {
    const MAPS: [&str; 3] = [
        "procthor/house_7.json",
        "virtualhome/TestScene3_graph.json",
        "virtualhome/TestScene2_graph.json",
    ];
    let (mut done, mut refused, mut wrong) = (0, 0, Vec::new());
    for map in MAPS {
        let path = shared(map)?;
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
        let fits =
            |id| !holds || world.has_trait(id, "container") && !world.has_trait(id, "portable");
        for holder in world.replicas.values().filter(|r| r.id != thing.id && fits(r.id)) {
            let kind = world.objects[&holder.object].object_type;
            if !long() && (!kinds.insert(kind) || !holds && kinds.len() % 3 > 0) {
                continue;
            }
            let russian = |n: usize, case| {
                let entity = Entity::Replica([thing.id, holder.id][n]);
                NounPhrase::parse(world.name(entity), &names::hints(&world, entity)).case(case)
            };
            let named = Named { english: [&thing.name_en, &holder.name_en], russian: &russian };
            let mut heard = None;
            let lines = lines(done + refused, &named);
            for line in &lines {
                heard = Some(dialogue.hear(&mut engine, line, &mut |_, _| {}).unwrap());
            }
            let heard = heard.expect("something is said");
            let is_done = heard.tasks().any(|task| task.ending.is_done());
            let asked = format!("Is {} in {}?", thing.name_en, holder.name_en);
            let told = dialogue.hear(&mut engine, &asked, &mut |_, _| {}).unwrap().text();
            match (is_done, told.starts_with("Yes")) {
                (true, true) => done += 1,
                (false, _) => refused += 1,
                (true, false) => wrong.push(format!("{lines:?}: {told}")),
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    Some((done, refused))
}

#[test]
fn what_is_put_into_a_thing_lies_in_it() {
    let counts = put_into(false, |n, Named { english: [thing, holder], russian }| {
        let acc = |n| russian(n, Case::Accusative);
        vec![match n % 2 {
            0 => format!("Put {thing} in {holder}"),
            _ => format!("Положи {} в {}", acc(0), acc(1)),
        }]
    });
    let Some((done, refused)) = counts else { return };
    assert!(done > 3 && refused > 5, "{done} done, {refused} refused");
}

/// "What is in the fridge? Put the milk there", «Что в холодильнике? Положи туда молоко»: into it.
#[test]
fn there_is_in_what_was_asked_to_hold_things() {
    let counts = put_into(true, |n, Named { english: [thing, holder], russian }| match n % 3 {
        0 => vec![format!("What is in {holder}?"), format!("Put {thing} there")],
        1 => vec![format!("Is there anything in {holder}?"), format!("Put {thing} in there")],
        _ => vec![
            format!("Что в {}?", russian(1, Case::Prepositional)),
            format!("Положи туда {}", russian(0, Case::Accusative)),
        ],
    });
    let Some((done, _)) = counts else { return };
    assert!(done > 3, "{done} done");
}
