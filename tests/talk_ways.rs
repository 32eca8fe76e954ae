//! Ways in words: what is told agrees with the route's geometry, in every world and both languages.

use orthoframe::World;
use orthoframe::engine::{Engine, Memory, Method, RouteAnswer};
use orthoframe_exchange::{Options, read};
use orthoframe_language::Language;
use orthoframe_language::directions::{Directions, RoomPart, Side};
use orthoframe_language::question::Said;
use orthoframe_language::report::Detail;
use orthoframe_map::Entity;
use orthoframe_units::{Deg, Vector};

use crate::files::shared;
use crate::worlds::{mirrored, rb2, rotated};

fn worlds() -> Vec<(String, World)> {
    let mut worlds = vec![
        ("rb2".to_owned(), rb2()),
        ("mirrored".to_owned(), mirrored(&rb2())),
        ("turned".to_owned(), rotated(&rb2(), Deg::of(123.0))),
    ];
    if let Some(houses) = shared("procthor") {
        let path = houses.join("house_1.json");
        let house = read(&path, &Options::default()).expect("the house reads").world;
        worlds.push(("house_1".to_owned(), house));
    }
    worlds
}

/// Places, rooms and some things that ways lead to.
fn ends(world: &World) -> Vec<String> {
    let mut names: Vec<String> =
        world.places.keys().map(|id| world.name(Entity::Place(*id)).to_owned()).collect();
    names.extend(world.areas.values().map(|a| a.name.clone()));
    names.extend(world.replicas.values().step_by(7).take(2).map(|r| r.name.clone()));
    names.retain(|name| world.find(name).len() == 1);
    names.truncate(6);
    names
}

fn ways(engine: &Engine) -> Vec<(RouteAnswer, Directions)> {
    let ends = ends(engine.world().unwrap());
    let mut found = Vec::new();
    for from in &ends {
        for to in &ends {
            let Ok(answer) = engine.route(from, to, Method::Shortest) else { continue };
            let Some(way) = engine.directions(&answer, None).unwrap() else { continue };
            found.push((answer, way));
        }
    }
    found
}

fn turn(from: Vector, to: Vector) -> f64 {
    from.perp(&to).atan2(from.dot(&to)).to_degrees()
}

/// The smallest difference of two angles, degrees.
fn apart(a: f64, b: f64) -> f64 {
    let difference = (a - b).rem_euclid(360.0);
    difference.min(360.0 - difference)
}

/// How each doorway of a route is passed: across its line, to the side on which the route goes on; and as the route
/// itself crosses it, which is what counts where the way goes straight through it.
fn doorways(engine: &Engine, answer: &RouteAnswer) -> Vec<[Vector; 2]> {
    let route = answer.route.as_ref().unwrap();
    let floor = &engine.floors().unwrap()[&answer.map];
    answer
        .stages
        .windows(2)
        .map(|pair| {
            let doorway = &floor.doorways()[pair[0].leaves_by.unwrap()];
            let middle = doorway.at((doorway.span().0 + doorway.span().1) / 2.0, 0.0);
            let (a, b) = doorway.side_in(doorway.area()).unwrap().ends;
            let across = Vector::new(b.y - a.y, a.x - b.x).normalize();
            // Where the route crosses the doorway's line between its ends; the line goes on beside the doorway.
            let side = |p: &orthoframe_units::Point| (p - middle).dot(&across);
            let at = route.points.windows(2).find(|w| {
                let (before, after) = (side(&w[0]), side(&w[1]));
                let share =
                    if (before - after).abs() < 1e-9 { 0.0 } else { before / (before - after) };
                let crossing = w[0] + share * (w[1] - w[0]);
                before * after <= 0.0 && (crossing - middle).norm() <= doorway.width() / 2.0 + 1.0
            });
            let across = match at {
                Some(w) if side(&w[1]) < side(&w[0]) => -across,
                _ => across,
            };
            let along = at.and_then(|w| (w[1] - w[0]).try_normalize(1e-6));
            [across, along.unwrap_or(across)]
        })
        .collect()
}

/// How far an angle is off the turn from one doorway to the next, by whichever direction each is passed in.
fn off(angle: f64, from: &[Vector; 2], to: &[Vector; 2]) -> f64 {
    let turns = from.iter().flat_map(|a| to.iter().map(|b| turn(*a, *b)));
    turns.map(|turn| apart(angle, turn)).fold(f64::INFINITY, f64::min)
}

/// Turns that a sentence tells, in degrees.
fn told(sentence: &str) -> Vec<f64> {
    let words = [
        ("налево", 90.0),
        ("направо", -90.0),
        ("левее", 45.0),
        ("правее", -45.0),
        ("развернитесь", 180.0),
        ("turn left", 90.0),
        ("turn right", -90.0),
        ("then left", 90.0),
        ("then right", -90.0),
        ("bear left", 45.0),
        ("bear right", -45.0),
        ("turn round", 180.0),
    ];
    let text = sentence.to_lowercase();
    let mut found: Vec<(usize, f64)> = Vec::new();
    for (word, angle) in words {
        found.extend(text.match_indices(word).map(|(at, _)| (at, angle)));
    }
    found.sort_by_key(|(at, _)| *at);
    found.into_iter().map(|(_, angle)| angle).collect()
}

#[test]
fn turns_add_up_to_the_angle_between_the_doors_and_lengths_to_the_route() {
    let mut checked = 0;
    for (name, world) in worlds() {
        let engine = Engine::in_memory(world, None).unwrap();
        for (answer, way) in ways(&engine) {
            let doors = doorways(&engine, &answer);
            let context = || format!("{name}: {} – {}: {way:#?}", answer.from, answer.to);
            for (n, pair) in doors.windows(2).enumerate() {
                let passage: &RoomPart = &way.passages[n + 1];
                let inner = passage.stretches.iter().filter_map(|s| s.angle);
                let all: f64 = inner.chain(passage.exit.iter().map(|e| e.angle)).sum();
                let slack = 2.0 + 25.0 * passage.stretches.len() as f64;
                assert!(off(all, &pair[0], &pair[1]) < slack, "{}", context());
                checked += 1;
            }
            let told: f64 = way.passages.iter().flat_map(|p| &p.stretches).map(|s| s.length).sum();
            let length = answer.route.as_ref().unwrap().length;
            assert!(told <= length + 1.0, "{told} of {length}: {}", context());
            assert!(told >= 0.8 * length - 80.0, "{told} of {length}: {}", context());
        }
    }
    assert!(checked > 20, "{checked}");
}

#[test]
fn the_turns_that_are_said_lead_to_the_next_door() {
    let mut checked = 0;
    for (name, world) in worlds() {
        let engine = Engine::in_memory(world, None).unwrap();
        for (answer, way) in ways(&engine) {
            let doors = doorways(&engine, &answer);
            for (n, pair) in doors.windows(2).enumerate() {
                for language in [Language::Russian, Language::English] {
                    for detail in [Detail::Spot, Detail::Heading] {
                        let Some(text) = way.say_passage(n + 1, language, detail) else { continue };
                        let turns = told(&text);
                        // A turn of a quarter is said of up to 150°, and slight ones are passed over.
                        let slack = if turns.len() < 2 { 80.0 } else { 140.0 };
                        let off = off(turns.iter().sum(), &pair[0], &pair[1]);
                        assert!(
                            off < slack,
                            "{name}: {} – {}: {off}: {text}\n{:#?}",
                            answer.from,
                            answer.to,
                            way.passages[n + 1]
                        );
                        checked += 1;
                    }
                }
            }
        }
    }
    assert!(checked > 80, "{checked}");
}

/// Seen from where the route passes nearest to its middle, a landmark is on the hand that is told.
#[test]
fn what_is_passed_stands_on_the_hand_that_is_told() {
    let (mut right, mut wrong) = (0, Vec::new());
    for (name, world) in worlds() {
        let engine = Engine::in_memory(world, None).unwrap();
        let world = engine.world().unwrap();
        for (answer, way) in ways(&engine) {
            let floor = &engine.floors().unwrap()[&answer.map];
            let points = &answer.route.as_ref().unwrap().points;
            for (stage, passage) in answer.stages.iter().zip(&way.passages) {
                for (side, thing) in passage.stretches.iter().flat_map(|s| &s.passed) {
                    let named = |r: &&orthoframe_map::Replica| {
                        r.area == stage.area && r.name == thing.phrase().name()
                    };
                    let id = world.replicas.values().find(named).unwrap().id;
                    let bounds = &floor.scene().replicas[&id].bounds;
                    let middle = nalgebra::center(&bounds.min, &bounds.max);
                    let here = points.windows(2).flat_map(|w| {
                        let along = w[1] - w[0];
                        let steps = (0..=20).map(move |k| w[0] + along * (f64::from(k) / 20.0));
                        steps.map(move |at| (at, along))
                    });
                    let here = here.filter(|(at, along)| {
                        along.norm() > 1.0
                            && floor.locate(*at).is_some_and(|(area, _)| area == stage.area)
                    });
                    let nearest =
                        here.min_by(|a, b| (a.0 - middle).norm().total_cmp(&(b.0 - middle).norm()));
                    let (at, along) = nearest.unwrap();
                    let left = along.perp(&(middle - at)) > 0.0;
                    match left == (*side == Side::Left) {
                        true => right += 1,
                        false => wrong.push(format!(
                            "{name}: {} – {}: {}",
                            answer.from,
                            answer.to,
                            thing.phrase().name()
                        )),
                    }
                }
            }
        }
    }
    // A way that winds round a thing passes it on both hands.
    assert!(right > 60 && wrong.len() * 50 < right, "{right} {wrong:#?}");
}

#[test]
fn in_a_mirror_left_is_right() {
    let swap = |text: &str| {
        text.replace("лев", "\u{1}")
            .replace("прав", "лев")
            .replace('\u{1}', "прав")
            .replace("left", "\u{1}")
            .replace("right", "left")
            .replace('\u{1}', "right")
            .replace("Лев", "Прав")
            .replace("слева", "\u{1}")
            .replace("справа", "слева")
            .replace('\u{1}', "справа")
    };
    let (own, other) = (rb2(), mirrored(&rb2()));
    let (own, other) =
        (Engine::in_memory(own, None).unwrap(), Engine::in_memory(other, None).unwrap());
    let (mut turns, mut alike, mut all) = (0, 0, 0);
    for ((answer, a), (_, b)) in ways(&own).into_iter().zip(ways(&other)) {
        for language in [Language::Russian, Language::English] {
            let text = a.say_in(language, Detail::Spot).join(" ");
            turns += told(&text).len();
            let seen = b.say_in(language, Detail::Spot).join(" ");
            all += 1;
            // A way on the very edge of two words may be told by either.
            alike += usize::from(swap(&seen) == text || seen == text && told(&text).is_empty());
            assert!(
                told(&seen).iter().map(|t| -t).eq(told(&text))
                    || told(&text).iter().any(|t| (t.abs() - 90.0).abs() > 1.0),
                "{} – {}: {text} | {seen}",
                answer.from,
                answer.to
            );
        }
    }
    assert!(turns > 20 && alike * 10 >= all * 9, "{turns} turns, {alike} of {all} alike");
}

/// The rooms that are said to be reached, or not to be, are those of which each by itself is said so.
#[test]
fn rooms_that_are_reached_are_those_to_which_one_can_get() {
    let questions = [
        ("Which rooms can you reach?", true),
        ("Which rooms can I get to?", true),
        ("В какие комнаты можно попасть?", true),
        ("Which rooms can I not get to?", false),
        ("Which rooms can't you reach?", false),
        ("Which rooms cannot be reached?", false),
        ("В какие комнаты нельзя попасть?", false),
        ("До каких комнат ты не доберёшься?", false),
    ];
    let mut shut = 0;
    for locked in 0..4 {
        let mut world = rb2();
        for door in world.doors.values_mut().take(locked) {
            door.state = orthoframe_map::DoorState::LOCKED;
        }
        let engine = Engine::in_memory(world, None).unwrap();
        let ask = |text: &str| engine.ask(text, &mut Memory::default()).unwrap();
        for (question, reached) in questions {
            let answer = ask(question).unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text));
            for area in engine.world().unwrap().areas.values() {
                let one = ask(&format!("Can you get to {}?", area.name_en)).unwrap();
                shut += usize::from(one.said == Said::No);
                let is_listed = answer.symbols.contains(&area.name);
                assert!(
                    !answer.symbols.is_empty()
                        || answer.text.contains("to all of them")
                        || answer.text.contains("ко всем"),
                    "{question} {}",
                    answer.text
                );
                assert_eq!(
                    is_listed,
                    (one.said != Said::No) == reached,
                    "{question} {}",
                    area.name
                );
            }
        }
    }
    assert!(shut > 0);
}
