//! Plans and the floor: in furnished buildings drawn at random every plan that is proposed can be driven, and where there is
//! none a search through all ways of the floor finds none either.

use std::collections::{HashMap, HashSet, VecDeque};
use std::rc::Rc;

use orthoframe::Engine;
use orthoframe::engine::{PlanStep, Progress, TaskEnding};
use orthoframe_geometry::{DoorStates, FloorPlan, Method, Target};
use orthoframe_graphplan::{Limits, Outcome};
use orthoframe_map::*;
use orthoframe_robot::{Reason, Wanted};
use orthoframe_units::*;

use crate::floors::Builder;
use crate::generated_worlds::Dice;
use crate::planning_judge::stands;
use crate::planning_time::{building_of, scenario, texts};

/// Where a robot stands, and which doors are open.
#[derive(Debug, Clone)]
pub(crate) struct State {
    area: AreaId,
    spot: Target,
    at: Point,
    open: Vec<DoorId>,
}

/// What the floor allows, asked of a floor that is built anew for each setting of the doors.
pub(crate) struct Judge<'w> {
    world: &'w World,
    floors: HashMap<Vec<DoorId>, Rc<FloorPlan>>,
}

impl<'w> Judge<'w> {
    pub(crate) fn of(world: &'w World) -> Self {
        Self { world, floors: HashMap::new() }
    }

    fn floor(&mut self, open: &[DoorId]) -> Rc<FloorPlan> {
        let world = self.world;
        let build = || {
            let state = |door: &DoorId| match open.contains(door) {
                true => DoorState::OPEN,
                false => DoorState::CLOSED,
            };
            let states: DoorStates = world.doors.keys().map(|door| (*door, state(door))).collect();
            Rc::new(FloorPlan::build(world, MapId(1), &world.robot, &states))
        };
        Rc::clone(self.floors.entry(open.to_vec()).or_insert_with(build))
    }

    fn drive(&mut self, from: &State, spot: Target, areas: &[AreaId]) -> Option<State> {
        let floor = self.floor(&from.open);
        let way = floor.route_within(self.world, from.at, spot, Method::Shortest, Some(areas));
        let at = *way.ok()?.points.last()?;
        let area = *areas.last()?;
        Some(State { area, spot, at, open: from.open.clone() })
    }

    fn cross(&mut self, from: &State, door: DoorId, into: AreaId) -> Option<State> {
        let is_there = matches!(from.spot, Target::Door { door: at, .. } if at == door);
        if !is_there || !from.open.contains(&door) {
            return None;
        }
        self.drive(from, Target::Door { door, area: into }, &[from.area, into])
    }

    fn open(&mut self, from: &State, door: DoorId) -> Option<State> {
        let floor = self.floor(&from.open);
        if from.open.contains(&door) || !floor.opens_from(self.world, door, from.at) {
            return None;
        }
        let mut open = from.open.clone();
        open.push(door);
        open.sort();
        Some(State { open, ..from.clone() })
    }

    /// Only where it can be opened again.
    fn close(&mut self, from: &State, door: DoorId) -> Option<State> {
        let open = from.open.iter().copied().filter(|other| *other != door).collect();
        let shut = State { open, ..from.clone() };
        let before = self.drive(&shut, Target::Door { door, area: from.area }, &[from.area])?;
        let floor = self.floor(&shut.open);
        floor.opens_from(self.world, door, before.at).then_some(shut)
    }

    /// All that can be done next, as far as the rules know what it is good for: that a leaf stands in the way, so that it
    /// helps to shut a door, they do not.
    fn next(&mut self, from: &State) -> Vec<State> {
        let world = self.world;
        let mut next = Vec::new();
        for place in world.places.values().filter(|place| place.area == from.area) {
            next.extend(self.drive(from, Target::Place(place.id), &[from.area]));
        }
        for &door in world.doors.keys() {
            let sides = world.areas.values().filter(|a| a.doors.iter().any(|m| m.door == door));
            let sides: Vec<AreaId> = sides.map(|area| area.id).collect();
            if !sides.contains(&from.area) {
                continue;
            }
            let here = Target::Door { door, area: from.area };
            if from.spot != here {
                next.extend(self.drive(from, here, &[from.area]));
            } else {
                next.extend(self.open(from, door));
                for into in sides.into_iter().filter(|side| *side != from.area) {
                    next.extend(self.cross(from, door, into));
                }
            }
        }
        next
    }

    /// The way of the fewest steps to a place, if there is one.
    pub(crate) fn way(&mut self, start: &State, goal: Target) -> Option<Vec<State>> {
        let key = |state: &State| {
            let (x, y) = ((state.at.x * 10.0).round() as i64, (state.at.y * 10.0).round() as i64);
            (state.area, format!("{:?}", state.spot), x, y, state.open.clone())
        };
        let (mut seen, mut open) =
            (HashSet::from([key(start)]), VecDeque::from([vec![start.clone()]]));
        while let Some(way) = open.pop_front() {
            let state = way.last()?;
            if state.spot == goal {
                return Some(way);
            }
            for next in self.next(state) {
                if seen.insert(key(&next)) {
                    open.push_back(way.iter().cloned().chain([next]).collect());
                }
            }
        }
        None
    }

    /// Drives a plan; the action that the floor refuses.
    fn refused(&mut self, start: &State, plan: &[Vec<PlanStep>]) -> Option<String> {
        let mut state = start.clone();
        for step in plan.iter().flatten() {
            let named = |name: &String| self.world.find(name).first().copied();
            let args: Vec<Entity> = step.args.iter().filter_map(named).collect();
            let (area, last) = (state.area, args.last().copied());
            let next = match (step.action.as_str(), last) {
                (name, Some(Entity::Place(place))) if name.starts_with("Движение-в") => {
                    self.drive(&state, Target::Place(place), &[area])
                }
                ("Движение-из_в_через-дверь", Some(Entity::Door(door))) => {
                    let Entity::Area(into) = args[1] else { panic!("{step:?}") };
                    self.cross(&state, door, into)
                }
                (name, Some(Entity::Door(door))) if name.starts_with("Движение-в") => {
                    self.drive(&state, Target::Door { door, area }, &[area])
                }
                ("Открыть-дверь", Some(Entity::Door(door))) => self.open(&state, door),
                ("Закрыть-дверь", Some(Entity::Door(door))) => self.close(&state, door),
                _ => panic!("{step:?}"),
            };
            let Some(next) = next else { return Some(format!("{step:?}")) };
            state = next;
        }
        None
    }
}

/// Four rooms with crates where they please, some before doors, and doors open, shut or missing.
pub(crate) fn furnished(dice: &mut Dice, kind: DoorKind) -> World {
    let widths = [260.0, 300.0];
    let (mut b, areas): (Builder, Vec<AreaId>) = building_of(kind, &widths, |_, _| {
        [Some(DoorState::OPEN), Some(DoorState::CLOSED), None][dice.below(5).saturating_sub(2)]
    });
    for (room, &area) in areas.iter().enumerate() {
        for _ in 0..dice.below(4) {
            let (w, d) = (40.0 + dice.below(80) as f64, 30.0 + dice.below(60) as f64);
            let x = dice.below((widths[room % 2] - w) as usize) as f64;
            // Not where the room's place is.
            let y = 110.0 + dice.below((190.0 - d) as usize) as f64;
            b.put(area, x, y, w, d, 0.0, 100.0);
        }
    }
    b.world.robot.radius = Cm::of([20.0, 25.0, 30.0, 46.0][dice.below(8).saturating_sub(4)]);
    b.world
}

/// The robot at a place, with the doors as they are; none where it does not fit in that room.
pub(crate) fn begun(judge: &mut Judge<'_>, place: &Place) -> Option<State> {
    let doors = judge.world.doors.values();
    let open = doors.filter(|door| door.state.status == DoorStatus::Open);
    let open: Vec<DoorId> = open.map(|door| door.id).collect();
    let (_, frame) = judge.world.placement(place.area)?;
    let at = judge.floor(&open).standing_at(frame.apply(place.at))?;
    Some(State { area: place.area, spot: Target::Place(place.id), at, open })
}

/// Plans on a furnished building, beside the judge: how many plans there were, and how often none.
fn judged(kind: DoorKind, seeds: std::ops::Range<u64>) -> (usize, usize) {
    let (mut plans, mut none) = (0, 0);
    for seed in seeds {
        let mut dice = Dice::new(seed);
        let world = furnished(&mut dice, kind);
        let (from, to) = (dice.below(4), dice.below(4));
        let place = |room: usize| world.places.values().nth(room).unwrap();
        let mut judge = Judge::of(&world);
        let Some(start) = begun(&mut judge, place(from)) else { continue };
        let begin =
            format!("РОБОТ-НАХОДИТСЯ-В_(Комната-{from}) РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-{from})");
        let end = format!("РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-{to})");
        let scenario = scenario(&begin, &end);
        let engine = Engine::in_memory(world.clone(), None).unwrap();
        let answer = engine.plan(scenario, &Limits::default(), Wanted::Shortest).unwrap();
        let way = judge.way(&start, Target::Place(place(to).id));
        match &answer.solved.outcome {
            Outcome::Plan(plan) => {
                let texts = texts(&engine, &begin, &end);
                assert!(stands(&texts, &answer.solved.task, plan), "{kind:?} {seed}");
                assert_eq!(judge.refused(&start, &answer.steps()), None, "{kind:?} {seed}");
                plans += 1;
            }
            Outcome::NoPlan { .. } => {
                let why = answer.solved.explanation(Language::English);
                assert!(way.is_none(), "{kind:?} {seed}: there is a way: {why:?}\n{way:#?}");
                none += 1;
            }
            Outcome::LimitReached(known) => panic!("{kind:?} {seed}: {known:?}"),
        }
    }
    (plans, none)
}

#[test]
fn a_plan_is_proposed_where_the_floor_has_a_way_and_nowhere_else() {
    let (plans, none) = judged(DoorKind::Sliding, 1..60);
    assert!(plans >= 15 && none >= 8, "{plans} plans, {none} without");
}

#[test]
fn leaves_that_sweep_are_thought_of() {
    let (plans, none) = judged(DoorKind::Hinged, 1..60);
    assert!(plans >= 15 && none >= 8, "{plans} plans, {none} without");
}

/// A trunk before the only door: the plan of the rules is not proposed, and what bars it is told, with what would help.
#[test]
fn what_bars_the_only_way_is_told_instead_of_a_plan() {
    let (mut b, areas) = building_of(DoorKind::Sliding, &[300.0], |_, _| Some(DoorState::OPEN));
    let trunk = b.put(areas[0], 90.0, 250.0, 120.0, 40.0, 0.0, 100.0);
    let mut world = b.world;
    world.replicas.get_mut(&trunk).unwrap().move_prob = 50;
    let name = world.name(Entity::Replica(trunk)).to_owned();
    let engine = Engine::in_memory(world, None).unwrap();
    let start = "РОБОТ-НАХОДИТСЯ-В_(Комната-0) РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-0)";
    let scenario = scenario(start, "РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-1)");
    for wanted in [Wanted::Shortest, Wanted::Any, Wanted::Anytime, Wanted::Plain] {
        let answer = engine.plan(scenario.clone(), &Limits::default(), wanted).unwrap();
        let Some(Reason::NoWay(refused)) = &answer.solved.reason else {
            panic!("{:?}", answer.solved.reason)
        };
        let why = refused[0].why.as_ref().unwrap();
        for (language, help) in
            [(Language::Russian, "чтобы путь был"), (Language::English, "for a way")]
        {
            let told = why.say(language);
            assert!(
                told.contains(name.trim_start_matches("Вещь")) && told.contains(help),
                "{told}"
            );
            assert!(answer.solved.explanation(language).unwrap().contains(told));
        }
    }
}

/// What is ordered is planned and tried before it is told: no plan is told that is not begun.
#[test]
fn an_order_that_the_floor_refuses_tells_no_plan() {
    let (mut b, areas) = building_of(DoorKind::Sliding, &[300.0], |_, _| Some(DoorState::OPEN));
    b.put(areas[0], 90.0, 250.0, 120.0, 40.0, 0.0, 100.0);
    let mut world = b.world;
    world.robot.start = world.places.keys().next().copied();
    let engine = Engine::in_memory(world, None).unwrap();
    let mut told = 0;
    let mut tell =
        |progress: &Progress<'_>| told += usize::from(matches!(progress, Progress::Planned(_)));
    let answer = engine.perform("Поезжай к Месту-1", &mut tell).unwrap();
    assert!(matches!(answer.ending, TaskEnding::Stuck(_)), "{:?}", answer.ending);
    assert_eq!(told, 0);
}
