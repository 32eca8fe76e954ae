//! States of knowledge, shared by threads: each answers for the revision that it names, whatever is written meanwhile.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::sync::{Arc, Mutex};

use orthoframe::engine::{Dialogue, Engine, Memory, Method, Mode, State, change_now};
use orthoframe_map::{DoorState, Edits, Entity, Format, Permeability, Replica, World};
use orthoframe_store::Change;
use orthoframe_units::{Language, ReplicaId, Source};

use crate::agreement::row_of_rooms;
use crate::generated_worlds::Dice;
use crate::worlds::rb2;

fn edit(engine: &mut Engine, text: &str, change: &Change) {
    let source = Source::new("edit.toml", text);
    engine
        .edit(&Edits::read(&source, Format::Toml), change, Mode::Commit)
        .unwrap_or_else(|e| panic!("{text}\n{e}"));
}

/// What is asked of a state: the answers of another with the same map must be the same.
fn asked(state: &Arc<State>, question: usize) -> String {
    const QUESTIONS: [&str; 6] = [
        "Где Ваза-1?",
        "Что лежит на обеденном столе?",
        "Какая дверь закрыта?",
        "Where is the vase?",
        "What is on the bar?",
        "Сколько вещей в Комнате-Z?",
    ];
    match question % 9 {
        8 => {
            let heard =
                state.rehearse(&Dialogue::new(Language::Russian), "Принеси лекарство").unwrap();
            let plan = heard.plan.expect("it is planned, or told why not");
            serde_json::to_string(&plan).unwrap()
        }
        6 => {
            let route = state.route("Точка-А", "Ваза-1", Method::Shortest).unwrap().route;
            format!("{:?}", route.map(|r| r.points).ok())
        }
        7 => {
            let world = state.world().unwrap();
            let Entity::Replica(vase) = world.find("Ваза-1")[0] else { panic!() };
            format!("{:?}", state.relations().unwrap().support_of(vase))
        }
        n => match state.ask(QUESTIONS[n], &mut Memory::default()).unwrap() {
            Ok(answer) => answer.text,
            Err(unanswered) => unanswered.text,
        },
    }
}

/// Eight threads ask, find ways and derive on states, while a ninth edits: every answer is that of an engine that has the
/// map of that state alone. `ORTHOFRAME_LONG` takes thousands of steps instead of some.
#[test]
fn every_answer_is_right_for_its_revision() {
    let edits = if crate::files::long() { 300 } else { 12 };
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    let change = change_now("test", "");
    engine.import(crate::files::project("maps/rb2.toml").as_ref(), &change).unwrap();
    let latest = Mutex::new(engine.state().unwrap());
    let ended = AtomicBool::new(false);
    let steps = AtomicUsize::new(0);
    let (told, heard) = mpsc::channel::<(Arc<State>, usize, String)>();
    std::thread::scope(|scope| {
        for thread in 0..8 {
            let (told, latest, ended, steps) = (told.clone(), &latest, &ended, &steps);
            scope.spawn(move || {
                let mut question = thread;
                while !ended.load(Ordering::Relaxed) {
                    let state = Arc::clone(&latest.lock().unwrap());
                    let answer = asked(&state, question);
                    // Asked again of the same state, it is told the same.
                    assert_eq!(asked(&state, question), answer);
                    steps.fetch_add(1, Ordering::Relaxed);
                    told.send((state, question, answer)).unwrap();
                    question += 3;
                }
            });
        }
        drop(told);
        let mut dice = Dice::new(5);
        for n in 0..edits {
            let wait = steps.load(Ordering::Relaxed) + 8;
            while steps.load(Ordering::Relaxed) < wait {
                std::thread::yield_now();
            }
            match dice.below(5) {
                4 => {
                    let is_there = !engine.world().unwrap().find("Коробка-9").is_empty();
                    let step = match is_there {
                        true => "remove = \"Коробка-9\"".to_owned(),
                        false => {
                            let at = format!("at = [{}, 200]", 100 + dice.below(100));
                            format!(
                                "place = \"Коробка-9\"\nobject = \"box\"\narea = \"Комната-Z\"\n{at}"
                            )
                        }
                    };
                    edit(&mut engine, &format!("[[edit]]\n{step}\n"), &change);
                }
                0 => {
                    let door = ["Дверь-КY", "Дверь-ВZ"][dice.below(2)];
                    let status = ["open", "closed"][dice.below(2)];
                    let text = format!("[[edit]]\nstate = \"{door}\"\nis = \"{status}\"\n");
                    edit(&mut engine, &text, &change);
                }
                1 => engine.observe("Чашка-1", None, 0.9, "test", change.at).unwrap(),
                _ => {
                    engine
                        .edit_world(&change, Mode::Commit, |world| {
                            let Entity::Replica(vase) = world.find("Ваза-1")[0] else {
                                panic!()
                            };
                            let vase = world.replicas.get_mut(&vase).unwrap();
                            let at = vase.frame.origin();
                            let by = if n % 2 == 0 { 3.0 } else { -3.0 };
                            vase.frame = orthoframe_units::Frame::new(
                                at.x + by,
                                at.y,
                                vase.frame.z.get(),
                                vase.frame.angle,
                            );
                        })
                        .unwrap();
                }
            }
            *latest.lock().unwrap() = engine.state().unwrap();
        }
        ended.store(true, Ordering::Relaxed);
        let mut alone: Vec<(Arc<State>, Engine)> = Vec::new();
        let mut checked = 0;
        for (state, question, answer) in heard {
            let known = alone.iter().position(|(of, _)| Arc::ptr_eq(of, &state));
            let known = known.unwrap_or_else(|| {
                let world = state.world_now().unwrap().clone();
                alone.push((state, Engine::in_memory(world, None).unwrap()));
                alone.len() - 1
            });
            assert_eq!(
                asked(&alone[known].1.state().unwrap(), question),
                answer,
                "question {question}"
            );
            checked += 1;
        }
        assert!(checked >= edits * 8 && alone.len() > edits / 2, "{checked} of {}", alone.len());
    });
    assert_ne!(rb2(), *engine.world().unwrap());
}

/// A state that somebody holds stays as it was; one that nobody holds is changed in place.
#[test]
fn a_state_stays_as_it_was() {
    let mut engine = Engine::in_memory(rb2(), None).unwrap();
    let change = change_now("test", "");
    let before = engine.state().unwrap();
    let counted = before.relations().unwrap().tuples("ON_TOP_OF").unwrap().len();
    engine
        .edit_world(&change, Mode::Commit, |world| {
            let Entity::Replica(cup) = world.find("Чашка-1")[0] else { panic!() };
            world.replicas.remove(&cup);
        })
        .unwrap();
    assert!(before.find("Чашка-1").is_ok() && engine.find("Чашка-1").is_err());
    assert_eq!(before.relations().unwrap().tuples("ON_TOP_OF").unwrap().len(), counted);
    assert!(engine.relations().unwrap().tuples("ON_TOP_OF").unwrap().len() < counted);
    let after = engine.state().unwrap();
    assert!(!Arc::ptr_eq(&before, &after));
    assert!(Arc::ptr_eq(&after, &engine.state().unwrap()));
}

/// What followed an edit, whoever else still asks the states before it, is what would be derived of the edited map.
#[test]
fn what_follows_edits_is_what_would_be_derived() {
    let mut engine = Engine::in_memory(rb2(), None).unwrap();
    let change = change_now("test", "");
    let mut dice = Dice::new(9);
    let mut held: Vec<(Arc<State>, Vec<String>)> = Vec::new();
    let all = |state: &Arc<State>| {
        let relations = state.relations().unwrap();
        let mut said: Vec<String> = (0..8).map(|question| asked(state, question)).collect();
        for count in relations.counts() {
            let tuples = relations.tuples(&count.name).unwrap();
            let mut tuples: Vec<String> = tuples.iter().map(|tuple| format!("{tuple:?}")).collect();
            tuples.sort();
            said.push(format!("{} {tuples:?}", count.name));
        }
        said
    };
    let movable = ["Ваза-1", "Чашка-1", "Стул-1"].map(|name| {
        let Entity::Replica(id) = rb2().find(name)[0] else { panic!() };
        id
    });
    for step in 0..if crate::files::long() { 60 } else { 24 } {
        let state = engine.state().unwrap();
        let said = all(&state);
        // Some let go at once, some held for long: copies, spares and changes in place all come up.
        if dice.below(3) > 0 {
            held.push((state, said));
        } else {
            drop(state);
        }
        if held.len() > dice.below(6) {
            held.remove(dice.below(held.len()));
        }
        let way = dice.below(8);
        let (id, chair, door) = (movable[dice.below(3)], movable[2], dice.below(2));
        engine
            .edit_world(&change, Mode::Commit, |world| match way {
                0 => {
                    let value = format!("Цвет-{step}");
                    let thing = world.replicas.get_mut(&id).unwrap();
                    thing.properties.insert("ЦВЕТ".to_owned(), value);
                }
                1 => world.replicas.get_mut(&chair).unwrap().name = format!("Пуфик-{step}"),
                2 => {
                    let last = *world.replicas.keys().next_back().unwrap();
                    let new = ReplicaId(last.0 + 1);
                    let name = format!("Скамья-{step}");
                    let (chair, name_en) = (world.replicas[&chair].clone(), String::new());
                    let thing = Replica { id: new, name, name_en, ..chair };
                    world.replicas.insert(new, thing);
                }
                3 => {
                    let is_new = |r: &&Replica| r.name.starts_with("Скамья-");
                    let gone = world.replicas.values().find(is_new).map(|r| r.id);
                    if let Some(gone) = gone {
                        world.replicas.remove(&gone);
                    }
                }
                4 => {
                    let state = [DoorState::CLOSED, DoorState::LOCKED][door];
                    let mut doors = world.doors.values_mut();
                    let door = doors.find(|door| door.name == "Дверь-КY").unwrap();
                    door.state = state;
                }
                _ => {
                    let thing = world.replicas.get_mut(&id).unwrap();
                    let (at, by) = (thing.frame, [2.0, -2.0][step % 2]);
                    let (x, y) = (at.x.get() + by, at.y.get());
                    thing.frame = orthoframe_units::Frame::new(x, y, at.z.get(), at.angle);
                }
            })
            .unwrap();
        let alone = Engine::in_memory(engine.world().unwrap().clone(), None).unwrap();
        assert_eq!(all(&engine.state().unwrap()), all(&alone.state().unwrap()), "step {step}");
        for (state, said) in &held {
            assert_eq!(all(state), *said, "step {step}: a state that is held");
        }
    }
}

/// A spare floor leads through the openings that it was left with, whatever rooms came and went while nobody asked.
#[test]
fn a_spare_floor_of_other_rooms_follows_them() {
    let mut engine = {
        let text = row_of_rooms(4);
        let world = World::parse(&Source::new("row.toml", text), Format::Toml).unwrap();
        Engine::in_memory(world, None).unwrap()
    };
    let change = change_now("test", "");
    let turn = |world: &mut World| {
        let door = world.doors.values_mut().next().unwrap();
        door.state = match door.state == DoorState::CLOSED {
            true => DoorState::OPEN,
            false => DoorState::CLOSED,
        };
    };
    let take_last_away = |world: &mut World| {
        let id = *world.areas.keys().next_back().unwrap();
        let area = world.areas.remove(&id).unwrap();
        let hung: Vec<_> = area.doors.iter().map(|mount| mount.door).collect();
        for door in &hung {
            world.doors.remove(door);
        }
        for room in world.areas.values_mut() {
            let frame = world.orthoframes.get_mut(&room.items[0].orthoframe).unwrap();
            for mount in room.doors.extract_if(.., |mount| hung.contains(&mount.door)) {
                let side = frame.base.iter_mut().find(|side| side.id == mount.side).unwrap();
                side.permeability = Permeability::Impermeable;
            }
        }
        let map = world.maps.values_mut().next().unwrap();
        map.items.retain(|item| item.area != id);
        map.links.retain(|link| link.area != id && link.to_area != id);
    };
    let led = |state: &State| -> Vec<_> {
        let floors = state.floors().unwrap();
        let ways = floors.values().flat_map(|floor| floor.doorways().iter());
        let mut ways: Vec<_> = ways.map(|way| (way.door, way.areas)).collect();
        ways.sort();
        ways
    };
    let _ = (engine.relations().unwrap(), engine.floors().unwrap());
    type Alter<'a> = &'a dyn Fn(&mut World);
    let edits: [(bool, Alter<'_>); 6] = [
        (true, &turn),
        (false, &take_last_away),
        (false, &turn),
        (true, &turn),
        (false, &take_last_away),
        (true, &turn),
    ];
    for (step, (is_held, alter)) in edits.into_iter().enumerate() {
        let held = is_held.then(|| engine.state().unwrap());
        engine.edit_world(&change, Mode::Commit, alter).unwrap();
        drop(held);
        let alone = Engine::in_memory(engine.world().unwrap().clone(), None).unwrap();
        assert_eq!(led(&engine), led(&alone), "step {step}");
    }
}
