//! What goes on from an answer goes on from all of it: the room that is named instead, the ends of a way, what was counted.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::english;
use orthoframe_language::question::Answer;

use crate::talk::engine;

const MAPS: [&str; 3] = [
    "../shared/data/procthor/house_3.json",
    "../shared/data/procthor/house_7.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

fn told(engine: &Engine, turns: &[&str]) -> Option<Answer> {
    let mut memory = Memory::default();
    let mut last = None;
    for turn in turns {
        last = engine.ask(turn, &mut memory).expect("there is a map").ok();
        last.as_ref()?;
    }
    last
}

fn names(answer: &Answer) -> BTreeSet<String> {
    answer.symbols.iter().cloned().collect()
}

/// Every kind of things of which there are several, in the plural.
fn kinds(engine: &Engine) -> BTreeSet<String> {
    single(engine).iter().map(|kind| english::plural(kind)).collect()
}

/// The same in the singular.
fn single(engine: &Engine) -> BTreeSet<String> {
    let world = engine.world().expect("there is a map");
    let kind = |replica: &orthoframe_map::Replica| {
        let kind = world.types.object.get(world.objects[&replica.object].object_type);
        kind.expect("a kind").name_en.to_lowercase()
    };
    let all: Vec<String> = world.replicas.values().map(kind).collect();
    all.iter().filter(|kind| all.iter().filter(|k| k == kind).count() > 1).cloned().collect()
}

/// The same question of another room is as if it had been asked of that room.
#[test]
fn another_room_takes_the_place_of_the_room() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms: Vec<String> =
            engine.world().unwrap().areas.values().map(|area| area.name_en.clone()).collect();
        for kind in kinds(&engine) {
            for pair in rooms.windows(2) {
                let here = format!("Which {kind} are in the {}?", pair[0]);
                let there = format!("Which {kind} are in the {}?", pair[1]);
                let Some(own) = told(&engine, &[&there]) else { continue };
                for about in
                    [format!("What about the {}?", pair[1]), format!("And in the {}?", pair[1])]
                {
                    if let Some(answer) = told(&engine, &[&here, &about]) {
                        assert_eq!(names(&answer), names(&own), "{here} {about}: {}", answer.text);
                        asked += 1;
                    }
                    let biggest = "Which of them is the biggest?";
                    let best = format!("Which of the {kind} in the {} is the biggest?", pair[1]);
                    if let (Some(answer), Some(own)) =
                        (told(&engine, &[&here, biggest, &about]), told(&engine, &[&best]))
                    {
                        assert_eq!(
                            names(&answer),
                            names(&own),
                            "{here} {biggest} {about}: {}",
                            answer.text
                        );
                    }
                }
            }
        }
    }
    assert!(asked > 100, "{asked}");
}

/// "Which rooms have chairs? And which has the most?": chairs, and not the biggest room.
#[test]
fn the_most_is_of_what_rooms_were_asked_to_have() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        for kind in kinds(&engine) {
            let Some(most) = told(&engine, &[&format!("Which room has the most {kind}?")]) else {
                continue;
            };
            for (first, then) in [
                (format!("Which rooms have {kind}?"), "And which has the most?"),
                (format!("Which rooms have no {kind}?"), "And which room has the most?"),
            ] {
                let Some(answer) = told(&engine, &[&first, then]) else { continue };
                assert_eq!(names(&answer), names(&most), "{first} {then}: {}", answer.text);
                asked += 1;
            }
        }
    }
    assert!(asked > 20, "{asked}");
}

/// A room behind that to which something is near tells which that is, and not where the thing is.
#[test]
fn nearest_to_a_thing_in_a_room_may_be_elsewhere() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        for replica in world.replicas.values().step_by(7) {
            let room = world.areas.get(&replica.area).map(|area| area.name_en.clone());
            let Some(room) = room else { continue };
            for one in single(&engine).iter().take(6) {
                let plain = format!("Which {one} is nearest to {}?", replica.name_en);
                let placed =
                    format!("Which {one} is nearest to {} in the {room}?", replica.name_en);
                let (Some(one), Some(other)) =
                    (told(&engine, &[&plain]), told(&engine, &[&placed]))
                else {
                    continue;
                };
                assert_eq!(names(&one), names(&other), "{placed}: {}", other.text);
                asked += 1;
            }
        }
    }
    assert!(asked > 30, "{asked}");
}

/// «Какая не там?», "Which are not there?": the others.
#[test]
fn what_is_not_there_is_the_rest() {
    let mut asked = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms: Vec<String> =
            engine.world().unwrap().areas.values().map(|area| area.name_en.clone()).collect();
        for kind in kinds(&engine) {
            for room in &rooms {
                let all = told(&engine, &[&format!("Which {kind} are there?")]);
                let here = told(&engine, &[&format!("Which {kind} are in the {room}?")]);
                let (Some(all), Some(here)) = (all, here) else { continue };
                let whether = format!("Are all the {kind} in the {room}?");
                for which in ["Which are not there?", "Which aren't?", "And which ones are not?"] {
                    let Some(answer) = told(&engine, &[&whether, which]) else {
                        continue;
                    };
                    let rest: BTreeSet<String> =
                        names(&all).difference(&names(&here)).cloned().collect();
                    assert_eq!(names(&answer), rest, "{whether} {which}: {}", answer.text);
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 20, "{asked}");
}

/// "How many doors?" after a way is of the way.
#[test]
fn doors_are_counted_on_the_way_that_was_told() {
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms: Vec<String> =
            engine.world().unwrap().areas.values().map(|area| area.name_en.clone()).collect();
        for from in &rooms {
            for to in rooms.iter().filter(|to| *to != from) {
                let way = format!("How do I get from the {from} to the {to}?");
                let own =
                    format!("How many doors are there on the way from the {from} to the {to}?");
                let (Some(one), Some(other)) =
                    (told(&engine, &[&way, "How many doors?"]), told(&engine, &[&own]))
                else {
                    continue;
                };
                assert_eq!(one.number, other.number, "{way}: {}", one.text);
            }
        }
    }
}
