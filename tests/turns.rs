//! Orders that take up what was said, and where the robot goes for them: "the first one", "it", "back here", "go and check".

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Memory};
use orthoframe_language::command::{Command, Relation};
use orthoframe_map::{Entity, Replica, World};

use crate::talk::engine;
use crate::worlds::rb2;

const HOUSE: &str = "../shared/data/procthor/house_6.json";

/// What the last of some lines orders; none where it is refused.
fn ordered(engine: &Engine, lines: &[&str]) -> Option<Vec<Command<Entity>>> {
    let (order, asked) = lines.split_last()?;
    let mut memory = Memory::default();
    for line in asked {
        engine.ask(line, &mut memory).expect("there is a map").ok()?;
    }
    engine.understand_in(order, &mut memory).ok()
}

fn is_done_to(commands: &[Command<Entity>], thing: Entity) -> bool {
    commands.iter().any(|command| command.what().is_some_and(|what| what.id == thing))
}

fn of_trait<'w>(world: &'w World, name: &'static str) -> impl Iterator<Item = &'w Replica> {
    world.replicas.values().filter(move |thing| world.has_trait(thing.id, name))
}

/// "Where is the fork? Where is the pen? Bring the first one": the fork, though the pen was spoken of last.
#[test]
fn the_first_and_the_second_are_counted_in_the_order_in_which_they_were_told() {
    let Some(engine) = engine(HOUSE) else { return };
    let world = engine.world().unwrap();
    let mut told = 0;
    let carried: Vec<&Replica> = of_trait(world, "portable").step_by(3).collect();
    for pair in carried.windows(2) {
        let places = [0, 1].map(|n| format!("Where is {}?", pair[n].name_en));
        for (rank, thing) in ["first", "second"].into_iter().zip(pair) {
            let order = format!("Bring the {rank} one");
            let lines = [&*places[0], &places[1], &order];
            let Some(commands) = ordered(&engine, &lines) else { continue };
            assert!(is_done_to(&commands, Entity::Replica(thing.id)), "{lines:?}: {commands:?}");
            told += 1;
        }
    }
    let kinds = ["pens", "phones", "keys", "books"];
    for kind in kinds {
        let lines = [&*format!("Where are the {kind}?"), &format!("Bring the {kind}")];
        let Some(all) = ordered(&engine, &lines) else { continue };
        let mut memory = Memory::default();
        let listed = engine.ask(lines[0], &mut memory).unwrap().expect("there are several").symbols;
        assert!(listed.len() > 2 && all.len() == listed.len(), "{kind}: {listed:?}");
        // "Now the second one" goes on with the list, whichever is nearer.
        engine.understand_in("Bring the third one", &mut memory).unwrap();
        let whole = engine.resumed("Now the second one", &memory).unwrap().expect("an order");
        let commands = engine.understand_in(&whole, &mut memory).unwrap();
        let second = world.find(&listed[1])[0];
        assert!(is_done_to(&commands, second), "{kind}: {whole}");
        told += 1;
    }
    let doors: Vec<_> = world.doors.values().collect();
    for one in &doors {
        for other in doors.iter().filter(|other| other.id != one.id) {
            let states = [one, other].map(|door| format!("Is {} open?", door.name_en));
            let lines = [&*states[0], &states[1], "Close the first one"];
            let Some(commands) = ordered(&engine, &lines) else { continue };
            assert!(is_done_to(&commands, Entity::Door(one.id)), "{lines:?}: {commands:?}");
            told += 1;
        }
    }
    assert!(told > 20, "{told}");
}

/// "Where is the apple? Where is the toaster? Bring it": not the apple, of which nobody spoke.
#[test]
fn it_is_not_what_was_left_before() {
    let Some(engine) = engine(HOUSE) else { return };
    let world = engine.world().unwrap();
    let apple = of_trait(world, "portable").next().expect("there are things to carry");
    let furniture = ["portable", "support", "seat", "bed", "container"];
    let mut told = 0;
    for fixed in world.replicas.values() {
        if furniture.iter().any(|name| world.has_trait(fixed.id, name)) {
            continue;
        }
        let (one, other) = (&apple.name_en, &fixed.name_en);
        let lines = [&*format!("Where is {one}?"), &format!("Where is {other}?"), "Bring it"];
        if let Some(commands) = ordered(&engine, &lines) {
            assert!(!is_done_to(&commands, Entity::Replica(apple.id)), "{lines:?}: {commands:?}");
        }
        told += 1;
    }
    for one in world.doors.values() {
        for other in world.doors.values().filter(|other| other.id != one.id) {
            let leads = [one, other].map(|door| format!("Where does {} lead?", door.name_en));
            let lines = [&*leads[0], &leads[1], "Close it"];
            let Some(commands) = ordered(&engine, &lines) else { continue };
            assert!(!is_done_to(&commands, Entity::Door(one.id)), "{lines:?}: {commands:?}");
            told += 1;
        }
    }
    assert!(told > 10, "{told}");
}

/// "Go there, then back here": it ends where it was; where "here" alone would be a second place, it is refused.
#[test]
fn it_comes_back_to_where_it_was_sent_from() {
    let world = rb2();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let (_, start) = engine.robot().unwrap();
    for area in world.areas.values() {
        let (room, room_en) = (&area.name, &area.name_en);
        for order in [
            format!("Go to {room_en}, then back here"),
            format!("Go to {room_en} and come back here"),
            format!("Take the medicine to {room_en}, then back here"),
            format!("Съезди: «{room}», а потом обратно сюда"),
        ] {
            let Ok(answer) = engine.perform(&order, &mut |_| {}) else { continue };
            let away = (answer.end.at - start.at).norm();
            assert!(!answer.ending.is_done() || away < 60.0, "{order}: {away} cm off");
        }
        for order in [format!("Go to {room_en}, then here"), format!("Go to {room_en}, here")] {
            assert!(engine.understand(&order).is_err(), "{order}");
        }
    }
    let done = engine.perform("Go to Room Y, then back here", &mut |_| {}).unwrap();
    assert!(done.ending.is_done() && done.reports.len() > 2);
}

/// "Go check whether the door is closed": to the door before it is said.
#[test]
fn who_goes_to_check_goes_there() {
    for map in ["maps/rb2.toml", HOUSE] {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let check = |thing: Entity, line: String| {
            let parts = engine.parts_of(&line, &Memory::default()).unwrap().unwrap_or_default();
            let [order, _] = &parts[..] else { panic!("{line}: {parts:?}") };
            let commands = engine.understand(order).unwrap_or_else(|e| panic!("{line}: {e}"));
            let [Command::GoTo { to, .. }] = &commands[..] else { panic!("{line}: {commands:?}") };
            assert_eq!((to.anchor, to.relation), (thing, Relation::At), "{line}");
        };
        for door in world.doors.values() {
            let (name, name_en) = (&door.name, &door.name_en);
            let door = Entity::Door(door.id);
            check(door, format!("Go check whether {name_en} is closed"));
            check(door, format!("Go and see if {name_en} is open"));
            check(door, format!("Сходи проверь, закрыта ли «{name}»"));
        }
        for device in of_trait(world, "device") {
            let thing = Entity::Replica(device.id);
            check(thing, format!("Go and check if {} is on", device.name_en));
        }
    }
}

/// "Is the door open? If so, …": done where the answer was yes, and otherwise where it was no; without one it is refused.
#[test]
fn what_hinges_on_an_answer_is_done_as_it_was() {
    for map in ["maps/rb2.toml", HOUSE] {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let mut so = [0, 0];
        let mut check = |question: &str, hinges: &[(&str, bool)], order: &str| {
            let mut memory = Memory::default();
            let Ok(answer) = engine.ask(question, &mut memory).unwrap() else { return };
            let Some(is_so) = answer.is_so() else { return };
            for (hinge, wanted) in hinges {
                let line = format!("{hinge}, {order}");
                let commands = engine.understand_in(&line, &mut memory.clone()).unwrap();
                let waits = matches!(commands[..], [Command::Wait]);
                assert_eq!(waits, is_so != *wanted, "{question} {line}: {commands:?}");
                assert!(engine.understand(&line).is_err(), "{line}");
                so[usize::from(waits)] += 1;
            }
        };
        let english =
            [("If so", true), ("If it is", true), ("If not", false), ("Otherwise", false)];
        let russian =
            [("Если да", true), ("Если так", true), ("Если нет", false), ("Иначе", false)];
        let rooms = world.areas.values().next().expect("there are rooms");
        let (go, go_ru) =
            (format!("go to {}", rooms.name_en), format!("поезжай: «{}»", rooms.name));
        for door in world.doors.values() {
            for state in ["open", "closed"] {
                check(&format!("Is {} {state}?", door.name_en), &english, &go);
            }
            check(&format!("«{}» закрыта?", door.name), &russian, &go_ru);
        }
        for device in of_trait(world, "device") {
            check(&format!("Is {} on?", device.name_en), &english, &go);
        }
        assert!(so[0] > 10 && so[1] > 10, "{map}: {so:?}");
    }
}

/// In a dialogue: the one condition holds and the other does not, in one line as in two.
#[test]
fn a_line_hinges_on_the_question_before_it() {
    let mut engine = Engine::in_memory(rb2(), None).unwrap();
    for (lines, done) in [
        (&["Is Door KY open? If so, go to Room Z."][..], false),
        (&["Check whether Door KY is open. If so, go to Room Z."], false),
        (&["Is Door KY open?", "If so, go to Room Z."], false),
        (&["Is Door KY open?", "If so, go to Room Y.", "If not, go to Room Z."], true),
        (&["Дверь-КY открыта?", "Если да, поезжай в Комнату-Z."], false),
        (&["Is Door KY open?", "If so, go to Room V. Otherwise go to Room Z."], true),
        (&["Is Door KY closed?", "If not, go to Room Z; if so, go to Room Y."], true),
        (&["Дверь-КY закрыта?", "Если да, поезжай в Комнату-Y."], true),
    ] {
        let mut dialogue = Dialogue::default();
        let mut tasks = 0;
        for line in lines {
            let heard = dialogue.hear(&mut engine, line, &mut |_, _| {}).unwrap();
            tasks += heard.tasks().count();
        }
        assert_eq!(tasks > 0, done, "{lines:?}");
    }
}

/// "Switch on the lamp there. Come back": to where it was sent away, though it stayed where it was for the order between.
#[test]
fn an_order_on_the_spot_sends_nobody_away() {
    let Some(mut engine) = engine(HOUSE) else { return };
    let (_, start) = engine.robot().unwrap();
    for line in [
        "Go to the living room. Switch on the TV there. Come back here.",
        "Go to the bedroom. Close Door 1. Come back.",
        "Поезжай в гостиную. Включи там телевизор. Вернись сюда.",
    ] {
        let mut dialogue = Dialogue::default();
        let heard = dialogue.hear(&mut engine, line, &mut |_, _| {}).unwrap();
        let last = heard.tasks().last().expect("they are orders");
        let away = (last.end.at - start.at).norm();
        assert!(heard.tasks().count() == 3 && away < 60.0, "{line}: {away} cm off");
    }
}
