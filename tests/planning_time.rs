//! Plans by driven time: in buildings drawn at random the quickest plan is that of a search through all states, and it is
//! not always the one with the fewest steps.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap, HashSet};

use orthoframe::Engine;
use orthoframe::engine::{Error, PlanAnswer};
use orthoframe_graphplan::{Limits, Outcome, validate};
use orthoframe_map::*;
use orthoframe_robot::{Reason, Wanted};
use orthoframe_strips::{FactId, Scenario, Task};
use orthoframe_units::*;

use crate::files::project;
use crate::floors::{Builder, Opening, p};
use crate::generated_worlds::Dice;
use crate::planning_judge::{Texts, stands};

const DEPTH: f64 = 300.0;
/// Of a door, from the middle of its side to either end.
const HALF: f64 = 45.0;

/// Rooms in two rows, columns of these widths; between neighbours a door, if `door` says so, open or shut. Each room has a
/// place at its left: «Место-0», «Место-1», … by rows.
///
/// ```text
///  +--------+-------------+
///  |        D             |
///  +---D----+------D------+
///  |        D             |
///  +--------+-------------+
/// ```
fn building(widths: &[f64], door: impl FnMut(usize, usize) -> Option<DoorState>) -> World {
    building_of(DoorKind::Sliding, widths, door).0.world
}

/// The same to be furnished, its doors of a kind.
pub(crate) fn building_of(
    kind: DoorKind,
    widths: &[f64],
    mut door: impl FnMut(usize, usize) -> Option<DoorState>,
) -> (Builder, Vec<AreaId>) {
    let mut b = Builder::new();
    let columns = widths.len();
    let mut sides: Vec<Vec<(usize, Opening)>> = vec![Vec::new(); 2 * columns];
    let mut links = Vec::new();
    for room in 0..2 * columns {
        let right = (room % columns + 1 < columns).then_some((room + 1, 4, 10));
        let above = (room < columns).then_some((room + columns, 7, 1));
        for (other, own_side, other_side) in right.into_iter().chain(above) {
            let Some(state) = door(room, other) else { continue };
            let id = b.door(kind, 2.0 * HALF, state);
            sides[room].push((own_side, Opening::Door(id)));
            sides[other].push((other_side, Opening::Door(id)));
            links.push(((room, own_side), (other, other_side)));
        }
    }
    let (mut areas, mut places) = (Vec::new(), Vec::new());
    for (room, open) in sides.iter().enumerate() {
        let (row, column) = (room / columns, room % columns);
        let (w, d) = (widths[column], DEPTH);
        let (x, y) = (w / 2.0, d / 2.0);
        let corners = [
            p(0., 0.),
            p(x - HALF, 0.),
            p(x + HALF, 0.),
            p(w, 0.),
            p(w, y - HALF),
            p(w, y + HALF),
            p(w, d),
            p(x + HALF, d),
            p(x - HALF, d),
            p(0., d),
            p(0., y + HALF),
            p(0., y - HALF),
        ];
        let left: f64 = widths[..column].iter().map(|w| w + 10.0).sum();
        let at = Frame::new(left, row as f64 * (DEPTH + 10.0), 0.0, Deg::ZERO);
        let area = b.area(&format!("Комната-{room}"), &corners, at, open);
        areas.push(area);
        places.push(Place {
            id: PlaceId(9_000 + room as u32),
            area,
            name: format!("Место-{room}"),
            name_en: String::new(),
            at: p(60.0, 70.0),
            heading: None,
            serves: None,
            forms: Forms::new(),
        });
    }
    for ((a, side_a), (other, side_b)) in links {
        b.link(areas[a], side_a, areas[other], side_b);
    }
    places.into_iter().for_each(|place| {
        b.world.places.insert(place.id, place);
    });
    (b, areas)
}

pub(crate) fn scenario(start: &str, goal: &str) -> Scenario {
    Scenario::parse(&Source::new("scenario", text(start, goal))).unwrap()
}

fn text(start: &str, goal: &str) -> String {
    let rules = std::fs::read_to_string(project("rules/service-robot.strips")).unwrap();
    format!("{rules}\nИсходная позиция: {start}\nЦелевая позиция: {goal}\n")
}

/// The same with all that a map gives to it.
pub(crate) fn texts(engine: &Engine, start: &str, goal: &str) -> Texts {
    let facts = engine.facts_in_rule_text(None, Language::Russian).unwrap();
    Texts::Rules(text(start, goal) + &facts)
}

/// The plan for a scenario by time, and by steps.
fn plan(world: &World, scenario: &Scenario) -> (PlanAnswer, PlanAnswer) {
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let limits = Limits::default();
    let supplied = engine.supplemented(scenario.clone()).unwrap();
    let quickest = engine.plan_quickest(supplied, &limits).unwrap();
    (quickest, engine.plan(scenario.clone(), &limits, Wanted::Shortest).unwrap())
}

/// The least that any plan costs, by all states in the order of their costs.
fn least_cost(task: &Task) -> Option<u64> {
    let start: BTreeSet<FactId> = task.init.iter().copied().collect();
    let (mut done, mut open) = (HashSet::new(), BinaryHeap::from([Reverse((0, start))]));
    while let Some(Reverse((cost, state))) = open.pop() {
        if task.goal.iter().all(|fact| state.contains(fact)) {
            return Some(cost);
        }
        if !done.insert(state.clone()) {
            continue;
        }
        for operator in &task.operators {
            if operator.preconditions.iter().all(|fact| state.contains(fact)) {
                let mut next = state.clone();
                next.retain(|fact| !operator.del_effects.contains(fact));
                next.extend(&operator.add_effects);
                if !done.contains(&next) {
                    open.push(Reverse((cost + u64::from(operator.cost), next)));
                }
            }
        }
    }
    None
}

#[test]
fn the_quickest_plan_is_that_of_a_search_through_all_states() {
    let (mut proven, mut none, mut differ) = (0, 0, 0);
    for seed in 1..=12 {
        let mut dice = Dice::new(seed);
        let widths = [200.0, 300.0 + 100.0 * dice.below(12) as f64];
        let world = building(&widths, |_, _| {
            [Some(DoorState::OPEN), Some(DoorState::CLOSED), None][dice.below(5).saturating_sub(2)]
        });
        let rooms = 2 * widths.len();
        let mut any = || dice.below(rooms);
        let (robot, thing, wanted) = (any(), any(), any());
        let start = format!(
            "РОБОТ-НАХОДИТСЯ-В_(Комната-{robot}) РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-{robot}) РУКА-СВОБОДНА_()
            ПРЕДМЕТ_НАХОДИТСЯ-В-ПОЗИЦИИ_(Книга, Место-{thing})"
        );
        let goal = format!("ПРЕДМЕТ_НАХОДИТСЯ-В-ПОЗИЦИИ_(Книга, Место-{wanted})");
        let (quickest, shortest) = plan(&world, &scenario(&start, &goal));
        let solved = quickest.solved;
        let least = least_cost(&solved.task);
        match &solved.outcome {
            Outcome::Plan(plan) => {
                assert_eq!(validate(&solved.task, plan), Ok(()), "seed {seed}");
                let engine = Engine::in_memory(world, None).unwrap();
                assert!(stands(&texts(&engine, &start, &goal), &solved.task, plan), "seed {seed}");
                let time = solved.time.expect("it was planned for time");
                assert_eq!((Some(time.takes), Some(time.at_least)), (least, least), "seed {seed}");
                let Outcome::Plan(shortest) = &shortest.solved.outcome else {
                    panic!("seed {seed}: by steps there is one as well")
                };
                proven += 1;
                differ += usize::from(plan.steps.len() > shortest.steps.len());
            }
            Outcome::NoPlan { .. } => {
                assert_eq!(least, None, "seed {seed}");
                none += 1;
            }
            Outcome::LimitReached(known) => panic!("seed {seed}: {known:?}"),
        }
    }
    assert!(proven >= 6, "{proven} proven, {none} without, {differ} of more steps");
}

/// From one long room into the other: straight through the door in the middle, or round through two small rooms at the
/// end where the robot is.
#[test]
fn the_way_of_the_fewest_steps_is_not_always_the_quickest() {
    let world = building(&[300.0, 3000.0], |_, _| Some(DoorState::OPEN));
    let scenario = scenario(
        "РОБОТ-НАХОДИТСЯ-В_(Комната-1) РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-1)",
        "РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-3)",
    );
    let (quickest, shortest) = plan(&world, &scenario);
    assert_eq!((shortest.steps().len(), quickest.steps().len()), (3, 7));
    let time = quickest.solved.time.unwrap();
    // Straight on it is 29 m at 60 cm/s.
    assert!(time.is_least() && time.takes < 4_000, "{time:?}");
}

/// What the floor has no way for is no plan, and that is told; and what the map does not know has no time.
#[test]
fn without_a_way_on_the_floor_there_is_no_quickest_plan() {
    let mut world = building(&[300.0, 300.0], |_, _| Some(DoorState::OPEN));
    let goal = "РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-3)";
    let start = "РОБОТ-НАХОДИТСЯ-В_(Комната-0) РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Место-0)";
    let (quickest, _) = plan(&world, &scenario(start, goal));
    assert!(quickest.solved.time.unwrap().is_least());
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let elsewhere = scenario(
        &format!("{start} ПОЗИЦИЯ_НАХОДИТСЯ-В_(Окно, Комната-3)"),
        "РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Окно)",
    );
    let supplied = engine.supplemented(elsewhere).unwrap();
    let Err(Error::Request(unknown)) = engine.plan_quickest(supplied, &Limits::default()) else {
        panic!("the map knows no window")
    };
    assert!(unknown.to_string().contains("Окно"), "{unknown}");
    // A robot as wide as the doors.
    world.robot.radius = Cm::of(46.0);
    let (none, _) = plan(&world, &scenario(start, goal));
    let Some(Reason::NoWay(actions)) = none.solved.reason else { panic!("no way leads there") };
    assert!(!actions.is_empty());
}
