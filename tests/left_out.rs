//! Questions of some and not of the others: those told without those that are excepted or elsewhere, two things of one kind
//! told apart by their rooms, and comparisons that one sentence joins; each held against plainer questions.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::question::Answer;
use orthoframe_language::report::Named;
use orthoframe_language::{Case, Number};

use crate::talk::engine;

const MAPS: [&str; 2] =
    ["../shared/data/procthor/house_2.json", "../shared/data/virtualhome/TestScene3_graph.json"];

fn ask(engine: &Engine, line: &str) -> Option<Answer> {
    engine.ask(line, &mut Memory::default()).expect("there is a map").ok()
}

fn symbols(answer: Answer) -> BTreeSet<String> {
    answer.symbols.into_iter().collect()
}

/// Kinds in English and Russian of which there are several things, with the English names of these.
fn several_of_a_kind(engine: &Engine) -> BTreeMap<(String, String), Vec<String>> {
    let world = engine.world().unwrap();
    let mut all: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    for replica in world.replicas.values() {
        let kind = world.objects[&replica.object].object_type;
        let Some(kind) = world.types.object.get(kind) else { continue };
        let key = (kind.name_en.to_lowercase(), kind.name.to_lowercase());
        all.entry(key).or_default().push(replica.name_en.clone());
    }
    all.retain(|_, things| things.len() > 2);
    all
}

fn one_of_each_kind(engine: &Engine) -> Vec<String> {
    several_of_a_kind(engine).into_values().map(|things| things[0].clone()).collect()
}

fn rooms(engine: &Engine) -> Vec<String> {
    engine.world().unwrap().areas.values().map(|area| area.name_en.clone()).collect()
}

/// "Where are the keys, but not the ones in the bedroom?", "Where are the keys not in the bedroom?": all but those, and never
/// those themselves, nor rooms without any.
#[test]
fn what_a_place_leaves_out_is_left_out() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        for ((kind, _), things) in several_of_a_kind(&engine).iter().take(12) {
            for area in world.areas.values() {
                let own = |name: &&String| {
                    world.replicas.values().any(|r| r.name_en == **name && r.area != area.id)
                };
                let rest: BTreeSet<&String> = things.iter().filter(own).collect();
                if rest.is_empty() || rest.len() == things.len() {
                    continue;
                }
                let room = area.name_en.to_lowercase();
                for line in [
                    format!("Where are the {kind}s, but not the ones in the {room}?"),
                    format!("Where are the {kind}s, just not those in the {room}?"),
                    format!("Where are the {kind}s not in the {room}?"),
                ] {
                    let Some(found) = ask(&engine, &line) else { continue };
                    let named = found.things.iter().filter_map(|thing| thing.replica());
                    let named = named.map(|id| &world.replicas[&id].name_en).collect();
                    assert_eq!(rest, named, "{line}: {}", found.text);
                    told += 1;
                }
            }
        }
    }
    assert!(told > 20, "{told}");
}

/// "How many books are there besides Book 1 and Book 2?": both are left out, and the rest is counted once.
#[test]
fn what_is_left_out_is_left_out_at_once() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        for ((kind, _), things) in several_of_a_kind(&engine).iter().take(12) {
            let (one, other) = (&things[0], &things[1]);
            let Some(all) = ask(&engine, &format!("How many {kind}s are there?")) else { continue };
            let each = [one, other].map(|thing| ask(&engine, &format!("Where is {thing}?")));
            let [Some(first), Some(second)] = each else { continue };
            let mut rest = symbols(all);
            if !rest.remove(&first.symbols[0]) || !rest.remove(&second.symbols[0]) {
                continue;
            }
            let line = format!("How many {kind}s are there besides {one} and {other}?");
            let Some(found) = ask(&engine, &line) else { continue };
            assert_eq!(found.symbols.len(), rest.len(), "{line}: {}", found.text);
            assert_eq!(symbols(found), rest, "{line}");
            told += 1;
        }
    }
    assert!(told > 5, "{told}");
}

/// "Which books are in the bedroom? Which ones are not on the bed?": of those in the bedroom.
#[test]
fn what_is_not_there_is_asked_of_those_told() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms = rooms(&engine);
        for (kind, _) in several_of_a_kind(&engine).keys() {
            for room in &rooms {
                let mut memory = Memory::default();
                let first = format!("Which {kind}s are in {room}?");
                let Ok(before) = engine.ask(&first, &mut memory).unwrap() else { continue };
                if before.symbols.len() < 2 {
                    continue;
                }
                for line in ["Which ones are not on the floor?", "Which are not on the floor?"] {
                    let Ok(next) = engine.ask(line, &mut memory.clone()).unwrap() else { continue };
                    let (next, before) = (symbols(next), symbols(before.clone()));
                    assert!(next.is_subset(&before), "{first} {line} {next:?}");
                    told += 1;
                }
            }
        }
    }
    assert!(told > 5, "{told}");
}

/// "Is A longer than B and taller than C?": as the two by themselves, each by its own measure.
#[test]
fn two_comparisons_of_one_sentence_are_as_each_by_itself() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let things = one_of_each_kind(&engine);
        for three in things.windows(3) {
            let [a, b, c] = three else { continue };
            for (one, other) in [("longer", "taller"), ("wider", "lower"), ("taller", "wider")] {
                let first = ask(&engine, &format!("Is {a} {one} than {b}?"));
                let second = ask(&engine, &format!("Is {a} {other} than {c}?"));
                let (Some(first), Some(second)) = (first, second) else { continue };
                let line = format!("Is {a} {one} than {b} and {other} than {c}?");
                let Some(both) = ask(&engine, &line) else { continue };
                assert_eq!(both.text, format!("{} {}", first.text, second.text), "{line}");
                told += 1;
            }
        }
    }
    assert!(told > 5, "{told}");
}

/// "Which is bigger, the bowl in the kitchen or the one in the hall?": one of the two bowls is, and the other is smaller.
#[test]
fn the_one_elsewhere_is_of_the_same_kind() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms = rooms(&engine);
        for (kind, _) in several_of_a_kind(&engine).keys() {
            for pair in rooms.windows(2) {
                let (one, other) = (&pair[0], &pair[1]);
                let in_room = |room: &String| {
                    ask(&engine, &format!("Which {kind}s are in {room}?")).map(symbols)
                };
                let (Some(mut both), Some(there)) = (in_room(one), in_room(other)) else {
                    continue;
                };
                if both.len() != 1 || there.len() != 1 {
                    continue;
                }
                both.extend(there);
                let which = |more: &str| {
                    let line =
                        format!("Which is {more}, the {kind} in {one} or the one in {other}?");
                    ask(&engine, &line).map(symbols)
                };
                let (Some(bigger), Some(smaller)) = (which("bigger"), which("smaller")) else {
                    continue;
                };
                let told_of: BTreeSet<String> = bigger.union(&smaller).cloned().collect();
                assert_eq!(told_of, both, "{kind} in {pair:?}");
                told += 1;
            }
        }
    }
    assert!(told > 0, "{told}");
}

/// What is wider is so by the width that is told.
#[test]
fn wider_is_by_the_width_that_is_told() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let things = one_of_each_kind(&engine);
        for pair in things.windows(2) {
            let line = format!("Is {} wider than {}?", pair[0], pair[1]);
            let Some(found) = ask(&engine, &line) else { continue };
            for thing in pair {
                let wide = ask(&engine, &format!("How wide is {thing}?")).unwrap().text;
                let wide = wide.rsplit(" is ").next().unwrap().trim_end_matches(" wide.");
                assert!(found.text.contains(&format!("{wide} wide")), "{line} {}", found.text);
            }
            told += 1;
        }
    }
    assert!(told > 5, "{told}");
}

/// «Ни в одной комнате нет дивана?» denies once.
#[test]
fn none_of_the_rooms_without_denies_once() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        for (_, kind) in several_of_a_kind(&engine).keys() {
            let one = Named::plain(kind).phrase().form(Case::Genitive, Number::Singular);
            for line in [
                format!("Ни в одной комнате нет {one}?"),
                format!("Верно ли, что ни в одной комнате нет {one}?"),
            ] {
                let Some(found) = ask(&engine, &line) else { continue };
                assert!(found.text.starts_with("Нет, "), "{line} {}", found.text);
                told += 1;
            }
        }
    }
    assert!(told > 5, "{told}");
}

/// "What is the biggest thing in each room?": as asked of each room.
#[test]
fn the_biggest_in_each_room_is_told_of_each() {
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let rooms = rooms(&engine);
        for best in ["biggest", "tallest", "widest"] {
            let all = ask(&engine, &format!("What is the {best} thing in each room?")).unwrap();
            let of = |room| ask(&engine, &format!("What is the {best} thing in {room}?"));
            let each: BTreeSet<String> =
                rooms.iter().filter_map(of).flat_map(|answer| answer.symbols).collect();
            assert_eq!(symbols(all), each, "{best}");
        }
    }
}
