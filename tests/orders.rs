//! Orders as people put them together: conditions, what is left out, where to stand and what to look at; and what the
//! map says of light and keys, in the plans that come of them.

use orthoframe::Engine;
use orthoframe::engine::{Memory, TaskAnswer, TaskEnding};
use orthoframe_language::Language;
use orthoframe_map::{DoorState, Entity, World};
use orthoframe_robot::GoalFact;
use orthoframe_units::Deg;

use crate::whole_orders::heard;

pub(crate) fn lab() -> World {
    World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/lab.toml")).unwrap()
}

fn perform(world: &World, order: &str) -> TaskAnswer {
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    engine.perform(order, &mut |_| {}).unwrap_or_else(|e| panic!("{order}: {e}"))
}

fn actions(answer: &TaskAnswer) -> Vec<&str> {
    let carried = answer.reports.iter().map(|r| r.directive.action.as_ref());
    carried.filter(|action: &&str| !action.starts_with("Движение")).collect()
}

fn golden(world: &World, text: &str, path: &str) {
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let goals = |order: &str| match engine.perform(order, &mut |_| {}) {
        Ok(answer) => {
            let said = |g: &GoalFact| format!("{}({})", g.predicate, g.args.join(", "));
            answer.goal.iter().map(said).collect::<Vec<_>>().join("; ")
        }
        Err(error) => error.say(Language::of(order)),
    };
    let said: String = text
        .lines()
        .filter(|line| !line.starts_with("    ") && !line.is_empty())
        .map(|line| format!("{line}\n    {}\n", goals(line)))
        .collect();
    expect_test::expect_file![path].assert_eq(&said);
}

#[test]
fn orders_put_together_mean_what_they_say() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/commands");
    let lab_orders = include_str!("golden/commands/orders-lab.txt");
    golden(&lab(), lab_orders, &format!("{folder}/orders-lab.txt"));
    let flat = include_str!("golden/commands/orders-rb2.txt");
    golden(&crate::worlds::rb2(), flat, &format!("{folder}/orders-rb2.txt"));
}

#[test]
fn orders_in_an_imported_house_mean_what_they_say() {
    let Some(house) = crate::talk::engine("../shared/data/procthor/house_6.json") else { return };
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/commands/orders-house6.txt");
    golden(house.world().unwrap(), include_str!("golden/commands/orders-house6.txt"), path);
}

/// A room that the map says is dark is looked over by the light of its lamp.
#[test]
fn a_dark_room_is_lit_before_it_is_looked_over() {
    let mut world = lab();
    let office = world.find("Office")[0];
    let Entity::Area(office) = office else { panic!("{office:?}") };
    let order = "Find the battery";
    let sought = ["Открыть-дверь", "Осмотреть", "Искать"];
    assert_eq!(actions(&perform(&world, order)), sought);
    let properties = &mut world.areas.get_mut(&office).unwrap().properties;
    properties.insert("light".to_owned(), "off".to_owned());
    let answer = perform(&world, order);
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    assert_eq!(actions(&answer), ["Открыть-дверь", "Включить-свет", "Осмотреть", "Искать"]);
    // Without a lamp there is no plan.
    let lamp = world.find("Lamp 1")[0];
    let Entity::Replica(lamp) = lamp else { panic!("{lamp:?}") };
    world.replicas.remove(&lamp);
    assert!(matches!(perform(&world, order).ending, TaskEnding::NoPlan(_)));
}

/// Who has the key of a door is asked to unlock it; nobody else is.
#[test]
fn whoever_has_the_key_is_asked_to_unlock() {
    let mut world = lab();
    let door = world.find("Office door")[0];
    let Entity::Door(door) = door else { panic!("{door:?}") };
    let locked = world.doors.get_mut(&door).unwrap();
    locked.state = DoorState::LOCKED;
    assert!(matches!(perform(&world, "Bring the battery").ending, TaskEnding::NoPlan(_)));
    for holder in ["operator", "Оператор"] {
        let properties = &mut world.doors.get_mut(&door).unwrap().properties;
        properties.insert("key_with".to_owned(), holder.to_owned());
        let answer = perform(&world, "Bring the battery");
        assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
        assert_eq!(actions(&answer)[..2], ["Позвать-оператора", "Открыть-дверь"]);
        let told = answer.reports.iter();
        let told = told.flat_map(|r| r.actions_in_words(&world, Language::English));
        assert!(
            told.into_iter().any(|said| said == "Please come to me and unlock the office door.")
        );
    }
}

/// Where the robot is told to look it looks, and in the middle it stands in the middle.
#[test]
fn it_stands_and_looks_as_it_is_told() {
    let world = lab();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let bench = engine.locate_entity(world.find("Workbench 1")[0]).unwrap();
    let answer = perform(&world, "Drive into the middle of the lab, facing the workbench");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let away = bench.at - answer.end.at;
    assert!(away.norm() > 60.0, "it stays in the middle: {away}");
    let off = (Deg::from_radians(away.y.atan2(away.x)) - answer.end.heading).signed().abs();
    assert!(off < 30.0, "{off}° aside of the place before the bench");
    let answer = perform(&world, "Stand in the corridor between the two doors");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
}

/// A condition is looked up in the world as it is, and decides.
#[test]
fn a_condition_decides_what_is_done() {
    let mut world = lab();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let heard = |engine: &Engine, order: &str| {
        let commands = engine.understand_in(order, &mut Memory::default()).unwrap();
        format!("{commands:?}").chars().take_while(|c| *c != '(' && *c != ' ').collect::<String>()
    };
    let order = "If the office door is closed, open it, otherwise close the lab door";
    assert_eq!(heard(&engine, order), "[Open");
    let unless = "Bring the battery unless the office door is closed";
    assert_eq!(heard(&engine, unless), "[Wait]");
    let door = world.find("Office door")[0];
    let Entity::Door(door) = door else { panic!("{door:?}") };
    world.doors.get_mut(&door).unwrap().state = DoorState::OPEN;
    let engine = Engine::in_memory(world, None).unwrap();
    assert_eq!(heard(&engine, order), "[Close");
    assert_eq!(heard(&engine, unless), "[Bring");
}

/// What cannot be put away is told, and the others are put away all the same.
#[test]
fn what_cannot_be_put_away_lets_the_rest_be_tidied() {
    let mut world = crate::worlds::rb2();
    for door in ["Дверь-ZY", "Дверь-КY"] {
        let Entity::Door(id) = world.find(door)[0] else { panic!("{door}") };
        world.doors.get_mut(&id).unwrap().state = DoorState::LOCKED;
    }
    // By their names the book comes first; the bedroom, where it is kept, is locked.
    for (thing, on) in [("Книга-4", "Комод-1"), ("Чашка-1", "Письменный стол")]
    {
        let Entity::Replica(id) = world.find(thing)[0] else { panic!("{thing}") };
        let properties = &mut world.replicas.get_mut(&id).unwrap().properties;
        properties.insert("ХРАНИТСЯ_НА".to_owned(), on.to_owned());
    }
    let answer = perform(&world, "Приберись в гостиной");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let left: Vec<&str> = answer.left.iter().map(|(goal, _)| goal.args[0].as_str()).collect();
    assert_eq!(left, ["Книга-4"]);
    assert_eq!(actions(&answer).last(), Some(&"Вернуть-на-место"));
}

/// Whither it is told to look the robot looks: a window and a wall have no names of their own.
#[test]
fn it_turns_to_windows_and_walls() {
    let world = crate::worlds::rb2();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    for (order, facing) in [
        ("Повернись к окну", "лицом к окну"),
        ("Встань в спальне лицом к окну", "лицом к окну"),
        ("Face the wall", "лицом к стене"),
    ] {
        let answer = perform(&world, order);
        assert!(matches!(answer.ending, TaskEnding::Done), "{order}: {:?}", answer.ending);
        let place = &answer.goal[0].args[0];
        assert!(place.contains(&facing.replace(' ', "-")), "{order}: {place}");
        let found = engine.locate(answer.end_map, answer.end, true).unwrap();
        let told = found.position.say(Language::Russian);
        assert!(told.contains("лицом к ") && !told.contains("лицом внутрь"), "{order}: {told}");
    }
}

/// What is cleared and stays is cleared of what is on it; what can be carried is put away itself.
#[test]
fn a_table_is_cleared_and_a_cup_is_put_away() {
    let engine = Engine::in_memory(lab(), None).unwrap();
    for (order, wanted) in [
        ("Clear the desk", "Clear { from: Replica"),
        ("Clear up the lab", "Clear { from: Area"),
        ("Clear away Battery 1", "PutAway("),
    ] {
        let said = format!("{:?}", engine.understand(order).unwrap());
        assert!(said.contains(wanted), "{order}: {said}");
    }
    // What is on it is kept there: nobody said where it should go instead.
    let engine = Engine::in_memory(lab(), None).unwrap();
    let refused = engine.perform("Clear the desk", &mut |_| {}).unwrap_err();
    let said = refused.say(Language::English);
    assert!(said.contains("kept elsewhere: Battery 1"), "{said}");
}

/// To close is no more than that: what is locked stays so, and what is so already does not take its neighbour's goal
/// along.
#[test]
fn closing_never_unlocks() {
    let mut world = lab();
    let Entity::Door(office) = world.find("Office door")[0] else { panic!() };
    world.doors.get_mut(&office).unwrap().state = DoorState::LOCKED;
    assert!(perform(&world, "Close the office door").goal.is_empty());
    let closed: Vec<String> = perform(&world, "Close the office door and close the lab door")
        .goal
        .iter()
        .map(|g| format!("{} {}", g.predicate, g.args[0]))
        .collect();
    assert!(!closed.is_empty() && closed.iter().all(|g| g.ends_with(" Lab door")), "{closed:?}");
    let every = perform(&world, "Close all doors").goal;
    assert!(!every.is_empty() && every.iter().all(|g| g.args[0] == "Lab door"), "{every:?}");
    // Locked by the same sentence, it stays locked.
    let engine = Engine::in_memory(lab(), None).unwrap();
    let both = engine.perform("Lock the lab door and close it", &mut |_| {}).unwrap();
    assert!(both.goal.iter().all(|g| g.predicate.contains("ЗАПЕРТА")), "{:?}", both.goal);
    // What needs no unlocking drops no other goal.
    let unlocked = perform(&lab(), "Unlock the lab door and turn on Lamp 1").goal;
    assert_eq!(unlocked.len(), 1, "{unlocked:?}");
}

/// «Закрой все двери» means those that a hand shuts; a lift sees to its own.
#[test]
fn all_doors_are_no_lift_doors() {
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/two-storeys.toml");
    let engine = Engine::in_memory(World::load(map).unwrap(), None).unwrap();
    let relations = engine.relations().unwrap();
    let lifts = orthoframe_semantics::lifts(engine.world().unwrap(), relations);
    let of_lift: Vec<_> = lifts.iter().flat_map(|l| &l.doors).filter_map(|j| j.door).collect();
    assert!(!of_lift.is_empty());
    for order in ["Закрой все двери", "Close all doors", "Shut every door"] {
        let commands = engine.understand(order).unwrap();
        let doors = commands.iter().filter_map(|c| c.what()).map(|what| what.id);
        assert!(!commands.is_empty());
        for door in doors {
            let Entity::Door(id) = door else { panic!("{door:?}") };
            assert!(!of_lift.contains(&id), "{order}: {id:?}");
        }
    }
}

/// Where a thing is said to be, there it must be.
#[test]
fn a_thing_is_not_taken_from_where_it_is_not() {
    let engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    for order in ["Принеси Чашку-2 из Комнаты-Y", "Bring Cup 2 from Room Y"] {
        assert!(engine.understand(order).is_err(), "{order}");
    }
    assert!(engine.understand("Принеси Чашку-2 из Комнаты-Z").is_ok());
}

/// "Stop" is an order in all its words; what is ordered behind it is done.
#[test]
fn stop_stops() {
    let engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    for order in ["Стоп", "Стой!", "Остановись", "Stop", "Halt!", "Stop, don't go there", "Отмена"]
    {
        assert_eq!(heard(&engine, order).as_deref(), Some("Stop;"), "{order}");
        let answer = engine.perform(order, &mut |_| {}).unwrap();
        assert!(answer.stops && answer.reports.is_empty(), "{order}");
    }
    let both = heard(&engine, "Стоп! Принеси Чашку-2").unwrap();
    assert!(both.starts_with("Stop;Bring"), "{both}");
    assert!(heard(&engine, "Принеси Чашку-2, нет, отмена").is_none_or(|h| h == "Stop;"));
}

/// What is not begun behind what came to nothing is told, each part of it.
#[test]
fn what_is_not_begun_is_told_part_by_part() {
    let mut world = lab();
    let Entity::Door(office) = world.find("Office door")[0] else { panic!() };
    world.doors.get_mut(&office).unwrap().state = DoorState::LOCKED;
    let order = "Go to the office, then open the lab door, turn on Lamp 1 and bring Toolbox 1";
    let engine = Engine::in_memory(world, None).unwrap();
    let answer = engine.perform(order, &mut |_| {}).unwrap();
    for (language, parts) in [
        (
            Language::English,
            ["Not begun: ", "open the lab door", "switch on Lamp 1", "give Toolbox 1 to"],
        ),
        (Language::Russian, ["Не начато: ", "открыть ", "включить ", "передать "]),
    ] {
        let told = engine.ending_in_words(&answer, language).unwrap();
        for part in parts {
            assert_eq!(told.matches(part).count(), 1, "{part}: {told}");
        }
    }
}
