//! What lies in reach is reached, and what does not lets the rest be done.

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Heard, change_now};
use orthoframe_units::ReplicaId;

use crate::files::shared;
use crate::talk::engine;

const HOUSES: [u8; 9] = [0, 1, 2, 3, 4, 5, 6, 8, 9];

fn hear(engine: &mut Engine, dialogue: &mut Dialogue, line: &str) -> Heard {
    dialogue.hear(engine, line, &mut |_, _| {}).unwrap()
}

/// What lies on a counter of any shape, straight, L or U, wherever on it, can be taken and put back from open floor.
#[test]
fn what_lies_on_a_counter_is_in_reach() {
    let (mut taken, mut short) = (0, Vec::new());
    for house in HOUSES {
        let path = format!("../shared/data/procthor/house_{house}.json");
        let Some(mut engine) = engine(&path) else { return };
        let world = engine.world().unwrap().clone();
        let relations = engine.relations().unwrap();
        let is_counter = |id: ReplicaId| {
            world.replicas[&id]
                .properties
                .get("ИСТОЧНИК")
                .is_some_and(|s| s.to_lowercase().starts_with("countertop"))
        };
        let on: Vec<String> = world
            .replicas
            .values()
            .filter(|r| world.has_trait(r.id, "portable"))
            .filter(|r| relations.support_of(r.id).is_some_and(is_counter))
            .map(|r| r.name_en.clone())
            .collect();
        for name in on {
            let mut dialogue = Dialogue::default();
            let heard = hear(&mut engine, &mut dialogue, &format!("Take {name}"));
            let done = heard.tasks().any(|task| task.ending.is_done());
            let told = heard.text();
            match done {
                true => taken += 1,
                false if told.contains("out of reach") || told.contains("не дотянуться") => {
                    short.push(told)
                }
                false => {}
            }
            hear(&mut engine, &mut dialogue, &format!("Put {name} on the counter"));
        }
    }
    assert!(short.is_empty() && taken > 40, "{taken} taken, {short:#?}");
}

/// Several things are ordered onto one, of which one is out of reach: wherever it is named, the others come there, and of it
/// alone it is said that it did not.
#[test]
fn one_that_cannot_be_reached_lets_the_rest_be_done() {
    let mut tried = 0;
    for house in [6, 8] {
        let path = format!("../shared/data/procthor/house_{house}.json");
        let Some(first) = engine(&path) else { return };
        let world = first.world().unwrap().clone();
        let portable = world.replicas.values().filter(|r| world.has_trait(r.id, "portable"));
        let names: Vec<&str> = portable.map(|r| &*r.name_en).take(14).collect();
        let taken = |name: &str| {
            let mut engine = engine(&path).unwrap();
            let heard = hear(&mut engine, &mut Dialogue::default(), &format!("Take {name}"));
            heard.tasks().next().map(|task| task.ending.is_done())
        };
        let reached =
            |wanted: bool| names.iter().copied().filter(move |n| taken(n) == Some(wanted));
        let Some(far) = reached(false).next() else { continue };
        let near: Vec<&str> = reached(true).take(2).collect();
        let holder = world.replicas.values().find(|r| r.name_en.starts_with("Sofa"));
        let holder = holder.or(world.replicas.values().find(|r| r.name_en.starts_with("Bed")));
        let holder = &*holder.expect("one sits or lies somewhere").name_en;
        for at in 0..3 {
            let mut things = near.clone();
            things.insert(at, far);
            let dir = tempfile::tempdir().unwrap();
            let mut engine = Engine::open(dir.path(), None).unwrap();
            let change = change_now("test", "");
            engine
                .import(&shared(&format!("procthor/house_{house}.json")).unwrap(), &change)
                .unwrap();
            let mut dialogue = Dialogue::default();
            let order = format!("Put {}, {} and {} on {holder}", things[0], things[1], things[2]);
            let heard = hear(&mut engine, &mut dialogue, &order);
            let told = heard.text();
            assert!(!heard.tasks().any(|task| task.ending.is_done()), "{order}: {told}");
            assert!(
                told.contains(far) && !near.iter().any(|n| told.contains(n)),
                "{order}: {told}"
            );
            for thing in &near {
                let asked = format!("Is {thing} on {holder}?");
                let told = hear(&mut engine, &mut dialogue, &asked).text();
                assert!(told.starts_with("Yes"), "{order}: {told}");
            }
            tried += 1;
        }
    }
    assert!(tried > 0);
}

/// Who else is called by a name is not this robot, in any house and language; what calls it, or only tells something, is.
#[test]
fn what_another_is_told_is_not_done() {
    const OTHERS: [&str; 12] = [
        "Bob",
        "tinyRobot_2",
        "deliveryRobot_9",
        "Hey Alexa",
        "Mr Smith",
        "Okay Google",
        "Петя",
        "Эй, Алиса",
        "Робот Вася",
        "Сергей Иванович",
        "TurtleBot 3",
        "Уважаемый Пётр",
    ];
    const SELF: [&str; 14] = [
        "Robot",
        "Please",
        "Dear",
        "Old friend",
        "Careful",
        "Quick",
        "It is cold",
        "Робот",
        "Дорогой",
        "Дружок",
        "Темно",
        "Гости пришли",
        "Холодно",
        "Спасибо",
    ];
    let Some(mut engine) = engine("../shared/data/procthor/house_4.json") else { return };
    for (called, other) in OTHERS.map(|c| (c, true)).into_iter().chain(SELF.map(|c| (c, false))) {
        for mark in [", ", "! ", ": "] {
            let russian = called.chars().any(|c| matches!(c, 'а'..='я'));
            for room in 0..2 {
                let order = match (russian, room) {
                    (true, 0) => "поезжай на кухню",
                    (true, _) => "поезжай в спальню",
                    (false, 0) => "go to the kitchen",
                    (false, _) => "go to the bedroom",
                };
                let line = format!("{called}{mark}{order}");
                let heard = hear(&mut engine, &mut Dialogue::default(), &line);
                let obeyed = heard.tasks().any(|task| task.ending.is_done());
                assert_eq!(obeyed, !other, "{line}: {}", heard.text());
            }
        }
    }
}

/// "Go through Door 2" is done on its other side, from wherever in the house it is said, also where another door comes first.
#[test]
fn what_is_gone_through_is_gone_through_from_afar() {
    let (mut done, mut near) = (0, 0);
    for house in HOUSES {
        let path = format!("../shared/data/procthor/house_{house}.json");
        let Some(first) = engine(&path) else { return };
        let world = first.world().unwrap().clone();
        for (n, door) in world.doors.values().enumerate() {
            for order in ["Go through", "Open it and go in:", "Проедь через"] {
                let mut engine = engine(&path).unwrap();
                let line = match order {
                    "Go through" => format!("Go through {}", door.name_en),
                    "Проедь через" => format!("Проедь через {}", door.name),
                    _ => format!("Open {} and go in", door.name_en),
                };
                if order != ["Go through", "Open it and go in:", "Проедь через"][n % 3] {
                    continue;
                }
                let heard = hear(&mut engine, &mut Dialogue::default(), &line);
                for task in heard.tasks().filter(|task| task.ending.is_done()) {
                    let passes = |report: &orthoframe::engine::Report| {
                        let directive = &report.directive;
                        directive.action.contains("через-дверь")
                            && directive.args.iter().any(|arg| **arg == *door.name)
                    };
                    assert!(task.reports.iter().any(passes), "{path}: {line}: {}", heard.text());
                    done += 1;
                    near += usize::from(task.reports.len() > 3);
                }
            }
        }
    }
    assert!(done > 8 && near > 2, "{done} done, {near} from afar");
}

/// Who is told to close the door behind itself closes one through which it has come, or says that there is none.
#[test]
fn the_door_behind_oneself_is_one_that_was_gone_through() {
    let maps = HOUSES.map(|house| format!("../shared/data/procthor/house_{house}.json"));
    let scene = "../shared/data/virtualhome/TestScene3_graph.json".to_owned();
    let (mut closed, mut asked) = (0, 0);
    for path in maps.into_iter().chain([scene]) {
        let Some(first) = engine(&path) else { return };
        let rooms: Vec<String> =
            first.world().unwrap().areas.values().map(|area| area.name_en.clone()).collect();
        for room in rooms {
            let mut engine = engine(&path).unwrap();
            let line = format!("Go to the {room} and close the door behind you");
            let heard = hear(&mut engine, &mut Dialogue::default(), &line);
            asked += usize::from(heard.tasks().next().is_none());
            for task in heard.tasks() {
                let of = |action: &str| {
                    let reports = task.reports.iter().map(|report| &report.directive);
                    let own = reports.filter(|directive| directive.action.starts_with(action));
                    own.flat_map(|directive| directive.args.clone()).collect::<Vec<_>>()
                };
                let doors = &engine.world().unwrap().doors;
                let is_door = |name: &str| doors.values().any(|door| door.name == name);
                for door in of("Закрыть-дверь").iter().filter(|name| is_door(name)) {
                    assert!(
                        of("Движение-из_в_через-дверь").contains(door),
                        "{path}: {line}: {door}"
                    );
                    closed += 1;
                }
            }
        }
    }
    assert!(closed > 5 && asked > 5, "{closed} closed, {asked} asked back");
}

/// "To the fridge" leaves open whether into it or onto it: nothing that shuts others in has things put onto it unasked.
#[test]
fn to_what_shuts_things_in_is_asked_back() {
    let mut asked = 0;
    for map in
        ["procthor/house_3.json", "procthor/house_5.json", "virtualhome/TestScene3_graph.json"]
    {
        let Some(mut engine) = engine(&format!("../shared/data/{map}")) else { return };
        let world = engine.world().unwrap().clone();
        let has = |id, wanted: &str| world.has_trait(id, wanted);
        let thing = world
            .replicas
            .values()
            .find(|r| has(r.id, "portable") && r.name_en.starts_with("Book"));
        let thing = &*thing.expect("there is a book").name_en;
        let shuts = world.replicas.values().filter(|r| {
            has(r.id, "container")
                && !["support", "seat", "bed", "portable"].iter().any(|t| has(r.id, t))
                && orthoframe_map::stands(&world, r).is_some()
        });
        for holder in shuts {
            let lines = [
                format!("Take {thing} to {}", holder.name_en),
                format!("Carry {thing} over to {}", holder.name_en),
            ];
            for line in lines {
                let heard = hear(&mut engine, &mut Dialogue::default(), &line);
                assert_eq!(heard.tasks().count(), 0, "{line}: {}", heard.text());
                asked += 1;
            }
        }
    }
    assert!(asked > 4, "{asked} asked back");
}
