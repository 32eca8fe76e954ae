//! The whole way once, in the papers' flat and in worlds made from it: map, plan, drive, report (SPEC P4, X1, X2).

use std::path::Path;

use orthoframe::Engine;
use orthoframe::engine::{PlanStep, Progress, TaskAnswer, TaskEnding, change_now};
use orthoframe_geometry::{Openings, STEP_REACH, Scene, nearest_on_segment};
use orthoframe_graphplan::{Limits, Outcome, validate};
use orthoframe_language::Language;
use orthoframe_map::{DoorState, Entity, Permeability, World};
use orthoframe_robot::Wanted;
use orthoframe_robot::{Obstruction, Refusal, Surprise};
use orthoframe_strips::Scenario;
use orthoframe_units::{Deg, DoorId, Frame, MapId, Point, ReplicaId, Source};

use crate::files::project;
use crate::worlds::{mirrored, rb2, rb2_with_fifth_room, renamed, rotated};

const TASK: &str = "Принеси лекарство";
const AT_THE_DOOR: &str = "Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.";

fn worlds() -> Vec<(&'static str, World)> {
    let rb2 = rb2();
    vec![
        ("renamed", renamed(&rb2)),
        ("mirrored", mirrored(&rb2)),
        ("turned by 17.3", rotated(&rb2, Deg::of(17.3))),
        ("turned by 200", rotated(&rb2, Deg::of(200.0))),
        ("with a fifth room", rb2_with_fifth_room()),
        ("as it is", rb2),
    ]
}

/// A text that speaks of rb2, in the names of another world made from it.
fn in_names_of(world: &World, text: &str) -> String {
    let old = rb2();
    let mut text = text.to_owned();
    for (entity, name) in old.names() {
        if !matches!(entity, Entity::Replica(_)) && old.name(entity) == name {
            text = text.replace(name, world.name(entity));
        }
    }
    text
}

/// The paper's scenario in the names of a world; the map is that world, whatever the text says.
fn walk(world: &World) -> Scenario {
    let text = std::fs::read_to_string(project("rules/scenarios/medicine-walk.strips")).unwrap();
    let rules = project("rules/service-robot.strips");
    let text =
        in_names_of(world, &text).replace("../service-robot.strips", &rules.display().to_string());
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with("Карта:")).collect();
    Scenario::parse(&Source::new("прогулка", lines.join("\n"))).expect("the scenario is sound")
}

fn shown(steps: &[Vec<PlanStep>]) -> String {
    let line = |s: &PlanStep| format!("{}_({})", s.action, s.args.join(", "));
    steps.iter().flatten().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_walk_is_the_papers_five_directives_in_every_world() {
    let paper = "\
Движение-в_от-места_до-двери_(Комната-В, Точка-А, Дверь-ВZ)
Движение-из_в_через-дверь_(Комната-В, Комната-Z, Дверь-ВZ)
Движение-в_от-двери_до-двери_(Комната-Z, Дверь-ВZ, Дверь-ZY)
Движение-из_в_через-дверь_(Комната-Z, Комната-Y, Дверь-ZY)
Движение-в_от-двери_до-места_(Комната-Y, Дверь-ZY, Точка-К)";
    for (how, world) in worlds() {
        let (scenario, expected) = (walk(&world), in_names_of(&world, paper));
        let engine = Engine::in_memory(world, None).unwrap();
        let answer = engine.plan(scenario, &Limits::default(), Wanted::Shortest).unwrap();
        let steps = answer.steps();
        assert!(steps.iter().all(|step| step.len() == 1), "{how}");
        assert_eq!(shown(&steps), expected, "{how}");
        let Outcome::Plan(plan) = &answer.solved.outcome else { panic!("{how}: no plan") };
        assert_eq!(validate(&answer.solved.task, plan), Ok(()), "{how}");
    }
}

/// What was told on the way.
#[derive(Default)]
struct Told {
    started: usize,
    plans: usize,
    surprises: Vec<Surprise>,
}

/// Carries out a task; every plan is replayed to its goal, every directive that is done is reported.
fn carry_out(how: &str, engine: &Engine, task: &str, truth: World) -> (TaskAnswer, Told) {
    let mut told = Told::default();
    let answer = engine
        .perform_in(task, truth, &mut |progress| match progress {
            Progress::Planned(planned) => {
                told.plans += 1;
                if let Outcome::Plan(plan) = &planned.solved.outcome {
                    assert_eq!(validate(&planned.solved.task, plan), Ok(()), "{how}");
                }
            }
            Progress::Started { .. } => told.started += 1,
            Progress::Sent { .. }
            | Progress::Moved(_)
            | Progress::Scanned(_)
            | Progress::Barred { .. } => {}
            Progress::Surprised { surprise, .. } => told.surprises.push((*surprise).clone()),
            Progress::Finished(report) => {
                assert!(report.position.is_some(), "{how}: {} ends nowhere", report.directive);
            }
        })
        .unwrap();
    assert_eq!(answer.reports.len() + told.surprises.len(), told.started, "{how}");
    assert_eq!(answer.replans + 1, told.plans, "{how}");
    (answer, told)
}

/// Everything that a robot could touch, as edges, gathered anew.
fn edges(world: &World, map: MapId) -> Vec<(Point, Point)> {
    let (height, step) = (world.robot.height.get(), world.robot.step.get());
    let scene = Scene::of(world, map);
    let mut edges = Vec::new();
    for prism in scene.replicas.values().flat_map(|r| &r.prisms) {
        if prism.bottom < height && prism.top > step {
            edges.extend(prism.polygon.edges());
        }
    }
    for prism in scene.areas.values().flat_map(|a| &a.prisms) {
        let walls = prism.polygon.edges().zip(prism.sides.iter());
        edges.extend(
            walls.filter(|(_, s)| s.permeability == Permeability::Impermeable).map(|(e, _)| e),
        );
    }
    let openings = Openings::of(world, STEP_REACH);
    for doorway in openings.iter().filter(|o| o.map == map && o.is_way()) {
        let Some(door) = doorway.door.map(|id| &world.doors[&id]) else { continue };
        for leaf in doorway.leaves(door).obstacles(door.state) {
            edges.extend(leaf.edges().collect::<Vec<_>>());
        }
    }
    edges
}

/// Each centimetre of a way, and its end.
fn samples(points: &[Point]) -> impl Iterator<Item = Point> + '_ {
    points.windows(2).flat_map(|leg| {
        let (a, way) = (leg[0], leg[1] - leg[0]);
        let count = way.norm().ceil().max(1.0) as u32;
        (0..=count).map(move |k| a + way * (f64::from(k) / f64::from(count)))
    })
}

/// The slow check: the robot's disc round each centimetre of the ways touches nothing and stays in the rooms.
///
/// `world` is as it stood while these ways were driven.
fn check_ways(how: &str, world: &World, map: MapId, ways: &[&[Point]]) {
    let (edges, scene) = (edges(world, map), Scene::of(world, map));
    let openings = Openings::of(world, STEP_REACH);
    let doorways: Vec<_> = openings.iter().filter(|o| o.map == map && o.is_way()).collect();
    let radius = world.robot.radius.get() - 0.01;
    for p in ways.iter().flat_map(|points| samples(points)) {
        for &(a, b) in &edges {
            let gap = (nearest_on_segment(p, a, b) - p).norm();
            assert!(gap >= radius, "{how}: {gap} cm from {a:?}–{b:?} at {p:?}");
        }
        let in_room = scene.area_at(p).is_some();
        let in_doorway = doorways.iter().any(|d| (d.middle() - p).norm() <= d.width());
        assert!(in_room || in_doorway, "{how}: {p:?} lies outside");
        let solid = scene.replicas.values().flat_map(|r| &r.prisms).find(|prism| {
            prism.bottom < world.robot.height.get()
                && prism.top > world.robot.step.get()
                && prism.polygon.contains(p, 0.0)
        });
        assert!(solid.is_none(), "{how}: {p:?} lies in {solid:?}");
    }
}

fn ways(answer: &TaskAnswer) -> Vec<&[Point]> {
    answer.reports.iter().map(|r| r.points.as_slice()).filter(|w| !w.is_empty()).collect()
}

fn check_delivery(how: &str, engine: &Engine) -> TaskAnswer {
    let world = engine.world().unwrap().clone();
    let (answer, told) = carry_out(how, engine, TASK, world.clone());
    assert!(matches!(answer.ending, TaskEnding::Done), "{how}: {:?}", answer.ending);
    assert_eq!((answer.replans, told.surprises.len()), (0, 0), "{how}: bumped");
    let handed: Vec<_> =
        answer.reports.iter().filter(|r| &*r.directive.action == "Передать").collect();
    assert_eq!(handed.len(), 1, "{how}");
    assert_eq!(&*handed[0].directive.args[0], "Лекарство", "{how}");
    assert!((answer.end.at - answer.start.at).norm() < 15.0, "{how}: not where it was asked for");
    let ways = ways(&answer);
    assert!(ways.len() > 8, "{how}");
    let linked = ways.windows(2).all(|w| (w[1][0] - w[0][w[0].len() - 1]).norm() < 1e-6);
    assert!(linked, "{how}: the ways do not follow one another");
    check_ways(how, &world, answer.map, &ways);
    answer
}

fn said(answer: &TaskAnswer, language: Language) -> Vec<String> {
    answer.reports.iter().flat_map(|r| r.position.as_ref()).map(|p| p.say(language)).collect()
}

#[test]
fn the_medicine_is_brought_in_every_world() {
    let mut lengths = Vec::new();
    for (how, world) in worlds() {
        let sentence = in_names_of(&world, "Дверь-ВZ");
        let engine = Engine::in_memory(world, None).unwrap();
        let answer = check_delivery(how, &engine);
        let first = &answer.reports[0].directive;
        assert_eq!(&*first.args[2], sentence, "{how}");
        let reports = said(&answer, Language::Russian);
        let is_renamed = how == "renamed";
        assert_eq!(reports.iter().any(|r| r == AT_THE_DOOR), !is_renamed, "{how}: {reports:#?}");
        assert_eq!(said(&answer, Language::English).len(), reports.len(), "{how}");
        lengths.push(answer.reports.iter().map(|r| r.length).sum::<f64>());
    }
    // Another name, a mirror or a turn makes no way longer.
    for length in &lengths {
        assert!((length - lengths[0]).abs() < 1.0, "{lengths:?}");
    }
}

#[test]
fn the_medicine_is_brought_from_a_store() {
    let dir = tempfile::tempdir().unwrap();
    let store = dir.path().join("store");
    let mut engine = Engine::open(&store, None).unwrap();
    engine.import(&project("maps/rb2.toml"), &change_now("тест", "импорт")).unwrap();
    drop(engine);
    let engine = Engine::open_existing(&store, None).unwrap();
    assert_eq!(engine.world().unwrap(), &rb2());
    let answer = check_delivery("from a store", &engine);
    let english = "I am in Room V at the door leading from Room V to Room Z.";
    assert!(said(&answer, Language::Russian).iter().any(|s| s == AT_THE_DOOR));
    assert!(said(&answer, Language::English).iter().any(|s| s == english));
}

fn door(world: &World, name: &str) -> DoorId {
    let found = world.find(name).into_iter();
    found.filter_map(|e| if let Entity::Door(id) = e { Some(id) } else { None }).next().unwrap()
}

fn replica(world: &World, name: &str) -> ReplicaId {
    let found = world.find(name).into_iter();
    found.filter_map(|e| if let Entity::Replica(id) = e { Some(id) } else { None }).next().unwrap()
}

fn with_doors(world: &World, states: &[(&str, DoorState)]) -> World {
    let mut world = world.clone();
    for (name, state) in states {
        let id = door(&world, name);
        world.doors.get_mut(&id).unwrap().state = *state;
    }
    world
}

/// The truth differs from the map in the states of doors; gives the answer and what surprised the robot.
fn drive_among(doors: &[(&str, DoorState)]) -> (TaskAnswer, Told) {
    let world = rb2();
    let truth = with_doors(&world, doors);
    let engine = Engine::in_memory(world, None).unwrap();
    carry_out(&format!("{doors:?}"), &engine, TASK, truth)
}

#[test]
fn a_door_that_is_shut_is_opened_or_gone_round() {
    let (answer, told) = drive_among(&[("Дверь-ZY", DoorState::CLOSED)]);
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    assert!((1..=3).contains(&answer.replans), "{}", answer.replans);
    let shut = door(&rb2(), "Дверь-ZY");
    let is_bump = |s: &Surprise| matches!(s, Surprise::Blocked { bump, .. } if bump.against == Obstruction::Door(shut));
    assert!(told.surprises.iter().any(is_bump), "{:?}", told.surprises);
    assert!((answer.end.at - answer.start.at).norm() < 15.0);
}

#[test]
fn a_chair_in_the_way_is_driven_round() {
    let world = rb2();
    let chair = replica(&world, "Стул-2");
    let mut truth = world.clone();
    // In the middle of Комната-В, on the straight way from Точка-А to the door.
    truth.replicas.get_mut(&chair).unwrap().frame = Frame::new(305.0, 250.0, 0.0, Deg::ZERO);
    let engine = Engine::in_memory(world, None).unwrap();
    let (answer, told) = carry_out("a chair", &engine, TASK, truth.clone());
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let is_bump = |s: &Surprise| matches!(s, Surprise::Blocked { bump, .. } if bump.against == Obstruction::Replica(chair));
    assert!(told.surprises.iter().any(is_bump), "{:?}", told.surprises);
    assert!((1..=2).contains(&answer.replans));
    // What was driven after that keeps clear of where the chair really is.
    check_ways("a chair", &truth, answer.map, &ways(&answer));
}

#[test]
fn locked_doors_without_a_key_are_said_to_bar_the_way() {
    let locked = DoorState::LOCKED;
    let (answer, told) = drive_among(&[("Дверь-ZY", locked), ("Дверь-КY", locked)]);
    let TaskEnding::NoPlan(planned) = &answer.ending else { panic!("{:?}", answer.ending) };
    assert!((1..=4).contains(&told.surprises.len()), "{:?}", told.surprises);
    let why = planned.solved.explanation(Language::Russian).unwrap_or_default();
    assert!(why.contains("Дверь-ZY") || why.contains("Дверь-КY"), "{why}");
    assert!(why.contains("ЗАПЕРТА") || why.contains("ОТКРЫТА"), "{why}");
}

#[test]
fn a_mission_ends_whatever_the_doors_are() {
    let states = [DoorState::OPEN, DoorState::CLOSED, DoorState::LOCKED];
    let names = ["Дверь-ВZ", "Дверь-ZY", "Дверь-КY"];
    // Every door open, closed and locked beside others: six of the 27, for the time they take.
    for number in [0, 5, 10, 13, 15, 26_usize] {
        let all: Vec<_> =
            (0..3_usize).map(|i| (names[i], states[number / 3_usize.pow(i as u32) % 3])).collect();
        let (answer, told) = drive_among(&all);
        assert!(told.plans <= 8, "{all:?}: {} plans", told.plans);
        let is_reachable = |way: &[usize]| way.iter().all(|&i| all[i].1 != DoorState::LOCKED);
        let expected = is_reachable(&[0, 1]) || is_reachable(&[2]);
        let done = matches!(answer.ending, TaskEnding::Done);
        assert_eq!(done, expected, "{all:?}: {:?}", answer.ending);
        assert!(done || matches!(answer.ending, TaskEnding::NoPlan(_)), "{all:?}");
    }
}

#[test]
fn a_thing_that_is_gone_ends_the_mission_in_words() {
    let world = rb2();
    let mut truth = world.clone();
    truth.replicas.remove(&replica(&world, "Лекарство"));
    let engine = Engine::in_memory(world, None).unwrap();
    let (answer, told) = carry_out("no medicine", &engine, TASK, truth);
    let TaskEnding::Stuck(Surprise::Refused { refusal: Refusal::NotThere(_), seen: None }) =
        answer.ending
    else {
        panic!("{:?}", answer.ending)
    };
    assert!(told.plans > 1, "it was looked for");
}

#[test]
fn what_takes_the_last_way_away_is_said_and_not_what_the_rules_then_lack() {
    let lab = Path::new(env!("CARGO_MANIFEST_DIR")).join("maps/lab.toml");
    let mut world = World::load(lab).unwrap();
    let stool = replica(&world, "Stool 1");
    // Behind the doorway, which is as wide as the robot needs, and beside the wall.
    world.replicas.get_mut(&stool).unwrap().frame = Frame::new(130.0, 20.0, 0.0, Deg::ZERO);
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let (answer, told) = carry_out("a stool", &engine, "Go to the Shelf 1", world);
    let TaskEnding::Stuck(surprise) = &answer.ending else { panic!("{:?}", answer.ending) };
    assert!(matches!(surprise, Surprise::NoWay { to, .. } if to == "Shelf 1"), "{surprise:?}");
    // Out of sight the stool may be gone: the robot goes there and sees, and is told what bars it then.
    assert_eq!(told.plans, 1, "the one that sees; what the floor refuses is not told");
}
