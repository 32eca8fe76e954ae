//! Drives in a world that is not as the robot believes: what the file of a truth may say, and what the robot then tells.

use orthoframe::Engine;
use orthoframe::engine::{Error, Progress, TaskAnswer, TaskEnding, Timestamp, change_now};
use orthoframe_geometry::Scene;
use orthoframe_language::question::News;
use orthoframe_map::{DoorState, Entity, Format, World};
use orthoframe_robot::{GoalFact, Senses, SensingRobot, Surprise, facts_of_map, is_obstacle};
use orthoframe_semantics::{Profile, RelationRules, derive};
use orthoframe_units::{AreaId, Frame, Point, ReplicaId, Source, Stop};

use crate::files::project;
use crate::generated_worlds::Dice;
use crate::worlds::rb2;

fn load(name: &str) -> World {
    World::load(project(&format!("maps/{name}.toml"))).expect("the example maps are sound")
}

fn engine(world: &World) -> Engine {
    Engine::in_memory(world.clone(), None).unwrap()
}

fn thing(world: &World, name: &str) -> ReplicaId {
    let found = world.find(name).into_iter();
    found.filter_map(|e| if let Entity::Replica(id) = e { Some(id) } else { None }).next().unwrap()
}

fn edits(text: &str) -> Source {
    Source::new("truth.toml", text)
}

/// Drives in a truth, which is left as the drive leaves it; with what surprised the robot.
fn drive(engine: &Engine, task: &str, truth: &mut World) -> (TaskAnswer, Vec<Surprise>) {
    let mut surprises = Vec::new();
    let commands = engine.understand(task).unwrap();
    let answer = engine.carry_out_in(&commands, truth, &mut |progress| {
        if let Progress::Surprised { surprise, .. } = progress {
            surprises.push((*surprise).clone());
        }
    });
    (answer.unwrap(), surprises)
}

/// Whether what is told done is so in the truth that the drive left.
fn check_done(how: &str, world: &World, answer: &TaskAnswer, truth: &World) {
    let relations = derive(truth, &RelationRules::standard(), Profile::Surveyed).unwrap();
    let facts = facts_of_map(truth, &relations);
    let scene = Scene::of(truth, answer.end_map);
    let holds = |goal: &GoalFact| {
        facts.iter().any(|fact| {
            fact.predicate == goal.predicate
                && fact.arguments.iter().map(|a| &a.name).eq(goal.args.iter())
        })
    };
    for goal in &answer.goal {
        let first = goal.args.first().map(String::as_str).unwrap_or_default();
        let so = match goal.predicate.as_str() {
            "РОБОТ-НАХОДИТСЯ-В" => {
                let here = scene.area_at(answer.end.at);
                here.is_some_and(|area| truth.name(Entity::Area(area)) == first)
            }
            "РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ" => match world.find(first).first() {
                // Before a thing: where that truly is.
                Some(Entity::Replica(id)) => scene.replicas.get(id).is_some_and(|placed| {
                    let (low, high) = (placed.bounds.min, placed.bounds.max);
                    let at = answer.end.at;
                    let near = Point::new(at.x.clamp(low.x, high.x), at.y.clamp(low.y, high.y));
                    (near - at).norm() <= 150.0
                }),
                _ => true,
            },
            "ПРЕДМЕТ_ПЕРЕДАН" | "РОБОТ-ДЕРЖИТ" => {
                !truth.replicas.contains_key(&thing(world, first))
            }
            "ПРЕДМЕТ-НАЙДЕН" => truth.replicas.contains_key(&thing(world, first)),
            _ => holds(goal),
        };
        assert!(so, "{how}: told done, and is not so: {goal:?}");
    }
}

/// One edit at random: a door, or a thing moved, removed, added.
fn step(world: &World, dice: &mut Dice, number: usize) -> String {
    let things: Vec<_> = world.replicas.values().collect();
    let any = things[dice.below(things.len())];
    let by = |dice: &mut Dice| dice.below(301) as f64 - 150.0;
    let doors: Vec<_> = world.doors.values().filter(|door| !door.leaves.is_empty()).collect();
    match dice.below(5) {
        0 | 1 if !doors.is_empty() => {
            let door = &doors[dice.below(doors.len())].name;
            let is = ["locked", "closed", "open"][dice.below(3)];
            format!("[[edit]]\nstate = \"{door}\"\nis = \"{is}\"\n")
        }
        2 => format!("[[edit]]\nremove = \"{}\"\n", any.name),
        3 => {
            let (area, object) = (&world.areas[&any.area].key, &world.objects[&any.object].key);
            let (x, y) = (any.frame.x.get() + by(dice), any.frame.y.get() + by(dice));
            format!(
                "[[edit]]\nplace = \"Новое-{number}\"\nobject = \"{object}\"\narea = \"{area}\"\nat = [{x}, {y}]\n"
            )
        }
        _ => {
            let (dx, dy) = (by(dice), by(dice));
            format!("[[edit]]\nmove = \"{}\"\nby = [{dx}, {dy}]\ncarry = true\n", any.name)
        }
    }
}

/// Locked, closed, moved, removed, added at random: a mission ends, and what it tells done is so. With ORTHOFRAME_LONG
/// set, over many more truths.
#[test]
fn whatever_the_truth_a_mission_ends_and_what_is_told_done_is_so() {
    let houses = [
        (
            "rb2",
            &[
                "Принеси лекарство",
                "Положи лекарство на Стол-1",
                "Поезжай к Шкафу-1",
                "Открой Дверь-КY",
                "Найди Зонт-1",
                "Поезжай в Комнату-Y",
                "Включи Торшер-1",
                "Закрой Дверь-ZY",
            ][..],
        ),
        ("lab", &["Go to the Shelf 1"][..]),
        ("two-storeys", &["Поезжай в Холл-2"][..]),
    ];
    let seeds = if crate::files::long() { 40 } else { 1 };
    let (mut done, mut ended, mut refused) = (0, 0, 0);
    for (name, tasks) in houses {
        let world = load(name);
        let engine = engine(&world);
        for (n, task) in tasks.iter().enumerate() {
            for seed in 0..seeds {
                let mut dice = Dice::new(seed * 100 + n as u64 + 7);
                // What a map may not say, such as a thing within a wall, is left out of the truth.
                let mut text = String::new();
                for number in 0..1 + dice.below(4) {
                    let next = format!("{text}{}", step(&world, &mut dice, number));
                    match engine.truth(&edits(&next), Format::Toml) {
                        Ok(_) => text = next,
                        Err(Error::Map(_) | Error::Request(_)) => refused += 1,
                        Err(other) => panic!("{next}: {other}"),
                    }
                }
                if text.is_empty() {
                    continue;
                }
                let how = format!("{name}, «{task}», seed {seed}:\n{text}");
                let mut truth = engine.truth(&edits(&text), Format::Toml).unwrap().world;
                let (answer, _) = drive(&engine, task, &mut truth);
                match answer.ending {
                    TaskEnding::Done => {
                        check_done(&how, &world, &answer, &truth);
                        done += 1;
                    }
                    TaskEnding::AlreadyTrue => {}
                    TaskEnding::NoPlan(_) | TaskEnding::Stuck(_) => ended += 1,
                    TaskEnding::Stopped | TaskEnding::Failed(_) => panic!("{how}: {answer:?}"),
                }
                assert_eq!(engine.world().unwrap(), &world, "{how}: the map stays as it was");
            }
        }
    }
    assert!(done >= 3, "{done} done, {ended} not, {refused} edits refused");
}

/// The numbers of a map file are its own: a thing more at its head shifts them all.
#[test]
fn things_of_a_truth_match_by_name_and_not_by_number() {
    let world = rb2();
    let engine = engine(&world);
    let mut other = world.clone();
    let shift = 40;
    other.replicas = world
        .replicas
        .values()
        .map(|thing| {
            let id = ReplicaId(thing.id.0 + shift);
            (id, orthoframe_map::Replica { id, ..thing.clone() })
        })
        .collect();
    for place in other.places.values_mut() {
        place.serves = place.serves.map(|id| ReplicaId(id.0 + shift));
    }
    let text = Source::new("other.toml", other.to_toml());
    let mut truth = engine.truth(&text, Format::Toml).unwrap().world;
    assert_eq!(truth, world, "it is the same world, told with other numbers");
    let (answer, surprises) = drive(&engine, "Принеси лекарство", &mut truth);
    assert!(matches!(answer.ending, TaskEnding::Done) && surprises.is_empty());
}

/// The codes of the faults of a truth, each with the line that it stands in.
fn faults(engine: &Engine, name: &str, text: &str) -> Vec<(String, Option<usize>)> {
    let Err(Error::Map(faults)) = engine.truth(&Source::new(name, text), Format::Toml) else {
        panic!("{text}: it fits")
    };
    let place = |f: &orthoframe_map::Fault| faults.position(f).map(|(line, _)| line);
    faults.errors().map(|f| (f.to_string(), place(f))).collect()
}

#[test]
fn another_building_is_no_truth_and_what_does_not_fit_is_told() {
    let engine = engine(&rb2());
    let map = std::fs::read_to_string(project("maps/rb2.toml")).unwrap();
    let all = |from: &str, to: &str| {
        assert!(map.contains(from), "{from}");
        faults(&engine, "other.toml", &map.replacen(from, to, 1))
    };
    let robot = all("radius = ", "radius = 1");
    assert!(
        robot.iter().any(|(told, line)| told.starts_with("Робот") && line.is_some()),
        "{robot:?}"
    );
    // An edit that changes the building is refused at its step.
    let taller = faults(&engine, "t.toml", "[[edit]]\nstand = \"Комната-Y\"\nat = [10, 10]\n");
    assert!(!taller.is_empty() && taller.iter().all(|(_, line)| line.is_some()), "{taller:?}");
    // What the map reader refuses is told as it tells it.
    let unknown = faults(&engine, "t.toml", "[[edit]]\nmove = \"Стул-99\"\nto = [1, 2]\n");
    assert_eq!(unknown[0].1, Some(2), "{unknown:?}");
    assert!(unknown[0].0.contains("Стул-99"), "{unknown:?}");
    // A house of its own.
    let lab = std::fs::read_to_string(project("maps/lab.toml")).unwrap();
    let other = faults(&engine, "lab.toml", &lab);
    assert!(other.iter().any(|(told, _)| told.contains("Комната-В")), "{other:?}");
}

#[test]
fn nothing_stands_where_the_robot_stands() {
    let world = rb2();
    let engine = engine(&world);
    let (map, pose) = engine.robot().unwrap();
    let area = engine.floors().unwrap()[&map].locate(pose.at).unwrap().0;
    let (_, frame) = world.placement(area).unwrap();
    let at = frame.invert(pose.at);
    let key = &world.areas[&area].key;
    let text = format!(
        "[[edit]]\nplace = \"Новое\"\nobject = \"chair\"\narea = \"{key}\"\nat = [{}, {}]\n",
        at.x - 20.0,
        at.y - 20.0
    );
    let error = engine.truth(&edits(&text), Format::Toml).unwrap_err();
    assert!(error.to_string().contains("«Новое»"), "{error}");
}

/// A chair that the map does not have stands on the way: another door is tried, and the end is told as it is. (How large it
/// is nobody knows, so a way once given up for it stays given up; on its way back the robot may be stuck for that.)
#[test]
fn what_the_map_does_not_have_leaves_other_doors_to_be_tried() {
    let world = rb2();
    let engine = engine(&world);
    let (first, _) = drive(&engine, "Принеси лекарство", &mut world.clone());
    let through = |answer: &TaskAnswer, door: &str| {
        answer.reports.iter().any(|r| r.directive.args.iter().any(|arg| &**arg == door))
    };
    assert!(through(&first, "Дверь-ZY") && !through(&first, "Дверь-КY"));
    let way = first.reports.iter().find(|r| {
        &*r.directive.action == "Движение-в_от-двери_до-двери"
            && &*r.directive.args[0] == "Комната-Z"
    });
    let points = &way.expect("it drives through Комната-Z").points;
    let middle = nalgebra::center(&points[points.len() - 2], points.last().unwrap());
    let area = AreaId(
        world
            .find("Комната-Z")
            .iter()
            .find_map(|e| match e {
                Entity::Area(id) => Some(id.0),
                _ => None,
            })
            .unwrap(),
    );
    let (_, frame) = world.placement(area).unwrap();
    let at = frame.invert(middle);
    let mut truth = world.clone();
    let model = world.replicas[&thing(&world, "Стул-2")].clone();
    let id = ReplicaId(9_000);
    let new = orthoframe_map::Replica {
        id,
        area,
        name: "Новый стул".to_owned(),
        frame: Frame::new(at.x - 20.0, at.y - 20.0, 0.0, model.frame.angle),
        ..model
    };
    truth.replicas.insert(id, new);
    let (answer, surprises) = drive(&engine, "Принеси лекарство", &mut truth);
    assert!(!surprises.is_empty(), "the chair stands in the way");
    match answer.ending {
        TaskEnding::Done => check_done("a chair", &world, &answer, &truth),
        TaskEnding::Stuck(Surprise::Blocked { .. }) => {}
        other => panic!("{other:?}"),
    }
    assert!(through(&answer, "Дверь-КY"), "by the other door");
}

/// The table is not where it is believed to be: the robot does not put things into the air.
#[test]
fn a_table_that_was_moved_is_found_and_the_thing_is_put_on_it() {
    let world = rb2();
    let engine = engine(&world);
    let text = "[[edit]]\nmove = \"Стол-1\"\nby = [0, -30]\ncarry = true\n";
    let mut truth = match engine.truth(&edits(text), Format::Toml) {
        Ok(truth) => truth.world,
        Err(error) => panic!("{error}"),
    };
    let (answer, surprises) = drive(&engine, "Положи лекарство на Стол-1", &mut truth);
    assert!(!surprises.is_empty(), "it was not there");
    if matches!(answer.ending, TaskEnding::Done) {
        check_done("a table", &world, &answer, &truth);
    }
}

/// Before a thing that is gone the robot does not say that it stands there.
#[test]
fn a_thing_that_is_gone_is_not_arrived_at() {
    let world = rb2();
    let engine = engine(&world);
    let mut truth = world.clone();
    truth.replicas.remove(&thing(&world, "Шкаф-1"));
    let (answer, _) = drive(&engine, "Поезжай к Шкафу-1", &mut truth);
    assert!(matches!(answer.ending, TaskEnding::Stuck(_)), "{:?}", answer.ending);
}

/// The map stays; what the robot found out is believed from then on.
#[test]
fn the_store_keeps_what_was_found_out_and_not_the_truth() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    engine.import(&project("maps/rb2.toml"), &change_now("тест", "импорт")).unwrap();
    let world = engine.world().unwrap().clone();
    let text = "[[edit]]\nstate = \"Дверь-ZY\"\nis = \"locked\"\n[[edit]]\nremove = \"Зонт-1\"\n";
    let mut truth = engine.truth(&edits(text), Format::Toml).unwrap().world;
    let (answer, _) = drive(&engine, "Возьми лекарство", &mut truth);
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    engine.remember(&answer, std::time::SystemTime::now().into()).unwrap();
    assert_eq!(engine.world().unwrap(), &world);
    let now = engine.uncarried().unwrap();
    let door = world.doors.values().find(|door| door.name == "Дверь-ZY").unwrap();
    assert_eq!(now.doors[&door.id].state, DoorState::LOCKED, "it bumped into it");
    // That the umbrella is gone it never saw.
    assert!(now.replicas.contains_key(&thing(&world, "Зонт-1")));
    // What is in the hand stands nowhere: no truth moves it.
    let moved = faults(&engine, "t.toml", "[[edit]]\nmove = \"Лекарство\"\nby = [5, 0]\n");
    assert!(
        moved
            .iter()
            .any(|(told, line)| told.contains("«Лекарство»") && *line == Some(1) || line.is_some()),
        "{moved:?}"
    );
    // A map file tells where it was surveyed, which is no contradiction.
    let map = std::fs::read_to_string(project("maps/rb2.toml")).unwrap();
    let truth = engine.truth(&Source::new("rb2.toml", map), Format::Toml).unwrap().world;
    assert!(!truth.replicas.contains_key(&thing(&world, "Лекарство")));
}

/// What a robot by its senses met and no map has: told when it is asked what has changed, known to the next task, proposed,
/// and by who says so a thing of the map, or forgotten.
#[test]
fn what_was_met_is_believed_and_proposed_and_becomes_a_thing_of_the_map_or_none() {
    let stranger = "[[edit]]\nplace = \"Чужое\"\nobject = \"bedside\"\narea = \"Комната-В\"\nat = [255, 290]\n";
    for is_confirmed in [true, false] {
        let dir = tempfile::tempdir().unwrap();
        let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
        engine.import(&project("maps/rb2.toml"), &change_now("тест", "импорт")).unwrap();
        let world = engine.world().unwrap().clone();
        let truth = || engine.truth(&edits(stranger), Format::Toml).unwrap().world;
        let mut robot =
            SensingRobot::new(engine.simulator(Some(truth())).unwrap(), Senses::of_seed(3));
        let mut surprises = 0;
        let mut tell = |progress: &Progress<'_>| {
            surprises += usize::from(matches!(progress, Progress::Surprised { .. }));
        };
        let commands = engine.understand("Поезжай в Комнату-Z").unwrap();
        let answer = engine.carry_out_with(&commands, &mut robot, &mut tell, &Stop::new()).unwrap();
        assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
        assert!(surprises > 0, "it stood in the way");
        engine.remember(&answer, std::time::SystemTime::now().into()).unwrap();
        assert_eq!(engine.world().unwrap(), &world, "the map is as it was");
        let now: Timestamp = std::time::SystemTime::now().into();
        let news = engine.news(now).unwrap();
        assert!(news.iter().any(|one| matches!(one, News::New(_))), "{news:?}");
        let proposed: Vec<String> =
            engine.proposals(now).unwrap().into_iter().map(|one| one.name).collect();
        assert_eq!(proposed, ["Препятствие-1"]);
        // Hours later nobody reckons with it.
        let later = Timestamp(now.0 + 4 * 3_600_000);
        assert!(engine.proposals(later).unwrap().is_empty());
        let change = change_now("тест", "");
        match is_confirmed {
            true => {
                engine.confirm("Препятствие-1", &change).unwrap();
                let found = engine.world().unwrap().find("Препятствие-1");
                assert!(matches!(found[..], [Entity::Replica(id)] if !is_obstacle(id)));
            }
            false => {
                engine.reject("Препятствие-1", &change).unwrap();
                assert_eq!(engine.world().unwrap(), &world);
            }
        }
        assert!(engine.proposals(now).unwrap().is_empty());
        let news = engine.news(now).unwrap();
        assert!(!news.iter().any(|one| matches!(one, News::New(_))), "{news:?}");
    }
}
