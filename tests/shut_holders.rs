//! What is put into things that are shut, or taken out of them: a robot that opens them does just that and shuts them again,
//! one that does not says so and touches nothing.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Mode, change_now};
use orthoframe_map::{DoorStatus, World, stands};
use orthoframe_units::ReplicaId;

use crate::files::{long, shared};

const HOUSES: [&str; 3] = [
    "virtualhome/TestScene2_graph.json",
    "virtualhome/TestScene1_graph.json",
    "procthor/house_4.json",
];

fn opened(map: &str, opens: bool) -> Option<(tempfile::TempDir, Engine)> {
    let path = shared(map)?;
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(dir.path(), None).unwrap();
    let change = change_now("test", "");
    engine.import(&path, &change).unwrap();
    engine.edit_world(&change, Mode::Commit, |world| world.robot.opens = opens).unwrap();
    Some((dir, engine))
}

/// Of each kind of thing that stands shut one; with `ORTHOFRAME_LONG` all.
fn shut(world: &World) -> Vec<ReplicaId> {
    let mut kinds = BTreeSet::new();
    let shut = world.replicas.values().filter(|r| stands(world, r) == Some(DoorStatus::Closed));
    let mut is_new =
        |id| long() || kinds.insert(world.objects[&world.replicas[&id].object].object_type);
    shut.map(|r| r.id).filter(|id| is_new(*id)).collect()
}

fn name(world: &World, id: ReplicaId) -> &str {
    &world.replicas[&id].name_en
}

/// Where every thing is that lies somewhere.
fn places(engine: &Engine) -> Vec<(ReplicaId, String)> {
    let world = engine.uncarried().unwrap();
    world.replicas.values().map(|r| (r.id, format!("{:?} {:?}", r.area, r.frame))).collect()
}

#[test]
fn what_is_put_into_what_is_shut_lies_in_it_or_nothing_was_touched() {
    let (mut done, mut refused) = (0, 0);
    for map in HOUSES {
        for opens in [true, false] {
            let Some((_dir, mut engine)) = opened(map, opens) else { return };
            let world = engine.world().unwrap().clone();
            let hidden = engine.relations().unwrap().all_shut_in();
            let small = world
                .replicas
                .values()
                .filter(|r| world.has_trait(r.id, "portable") && !hidden.contains(&r.id));
            let small = small.min_by_key(|r| r.name.len()).expect("there is something to carry").id;
            for holder in shut(&world) {
                let mut dialogue = Dialogue::default();
                let before = places(&engine);
                let order = format!("Put {} in {}", name(&world, small), name(&world, holder));
                let heard = dialogue.hear(&mut engine, &order, &mut |_, _| {}).unwrap();
                let said = heard.text();
                let is_done = heard.tasks().any(|task| task.ending.is_done());
                let asked = format!("Is {} in {}?", name(&world, small), name(&world, holder));
                let told = dialogue.hear(&mut engine, &asked, &mut |_, _| {}).unwrap().text();
                let within = told.starts_with("Yes");
                match (is_done, opens) {
                    (true, _) => {
                        let now = engine.uncarried().unwrap();
                        let status = stands(now, &now.replicas[&holder]);
                        assert!(opens && within, "{map}: {order}: {said}");
                        assert_eq!(status, Some(DoorStatus::Closed), "{map}: {order}");
                        done += 1;
                    }
                    (false, true) => {
                        // What stands in another shut thing is out of reach, and that one is told.
                        let own = format!("{} is shut", name(&world, holder));
                        assert!(!said.contains(&own), "{map}: {order}: {said}");
                        assert!(!said.contains("does not open"), "{map}: {order}: {said}");
                        refused += 1;
                    }
                    (false, false) => {
                        assert_eq!(places(&engine), before, "{map}: {order}: {said}");
                        refused += 1;
                    }
                }
            }
        }
    }
    assert!(done > 5 && refused > 5, "{done} done, {refused} refused");
}

#[test]
fn what_is_in_what_is_shut_is_brought_or_nothing_was_touched() {
    let (mut done, mut refused) = (0, 0);
    for map in HOUSES {
        for opens in [true, false] {
            let Some((_dir, mut engine)) = opened(map, opens) else { return };
            let world = engine.world().unwrap().clone();
            let relations = engine.relations().unwrap();
            let mut of: BTreeSet<ReplicaId> = BTreeSet::new();
            let hidden = relations.all_shut_in().into_iter().filter(|id| {
                let around = relations.shut_in(*id).filter(|_| world.has_trait(*id, "portable"));
                around.is_some_and(|around| of.insert(around))
            });
            let hidden: Vec<ReplicaId> = hidden.collect();
            for thing in hidden.into_iter().take(if long() { 100 } else { 4 }) {
                let around = engine.relations().unwrap().shut_in(thing).expect("it was hidden");
                let before = places(&engine);
                let order = format!("Bring {}", name(&world, thing));
                let mut dialogue = Dialogue::default();
                let heard = dialogue.hear(&mut engine, &order, &mut |_, _| {}).unwrap();
                let said = heard.text();
                match heard.tasks().any(|task| task.ending.is_done()) {
                    true => {
                        assert!(opens, "{map}: {order}: {said}");
                        let now = engine.uncarried().unwrap();
                        assert!(!now.replicas.contains_key(&thing), "{map}: {order}");
                        let status = stands(now, &now.replicas[&around]);
                        assert_eq!(status, Some(DoorStatus::Closed), "{map}: {order}");
                        done += 1;
                    }
                    false => {
                        assert!(opens || places(&engine) == before, "{map}: {order}: {said}");
                        assert!(
                            !opens || !said.contains("does not open"),
                            "{map}: {order}: {said}"
                        );
                        refused += 1;
                    }
                }
            }
        }
    }
    assert!(done > 3 && refused > 3, "{done} done, {refused} refused");
}

/// A dishwasher in a counter that is shut: that is opened before anything is in the hand, and all is shut again.
#[test]
fn what_stands_in_something_shut_is_opened_from_without() {
    let Some((_dir, mut engine)) = opened("virtualhome/TestScene3_graph.json", true) else {
        return;
    };
    for (order, place) in [
        ("Put Plate 1 in Dishwasher 1", "in Dishwasher 1"),
        ("Возьми Тарелку-1 из Посудомоечной машины-1", "hand"),
    ] {
        let mut dialogue = Dialogue::default();
        let heard = dialogue.hear(&mut engine, order, &mut |_, _| {}).unwrap();
        assert!(heard.tasks().any(|task| task.ending.is_done()), "{order}: {}", heard.text());
        let asked = dialogue.hear(&mut engine, "Where is Plate 1?", &mut |_, _| {}).unwrap();
        assert!(asked.text().contains(place), "{order}: {}", asked.text());
        let now = engine.uncarried().unwrap();
        for name in ["Dishwasher 1", "Counter 2"] {
            let thing = now.replicas.values().find(|it| it.name_en == name).expect("it stands");
            assert_eq!(stands(now, thing), Some(DoorStatus::Closed), "{order}: {name}");
        }
    }
}
