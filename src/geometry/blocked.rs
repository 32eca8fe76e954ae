//! Why there is no route (W5): the doors, gaps and things that stand between start and goal.
//!
//! Pieces of the centre space are nodes; a closed door, an opening too narrow and a dead zone between two pieces
//! are edges that cost one each. The cheapest way over them names the fewest things that would have to change.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use miette::Diagnostic;
use thiserror::Error;

use crate::map::{DoorKind, DoorStatus, World};
use crate::units::{AreaId, DoorId};

use super::floor::Blocker;
use super::plan::FloorPlan;
use super::route::things;
use super::search::CellKey;

/// One thing in the way.
#[derive(Debug, Clone, PartialEq)]
pub enum Barrier {
    /// A door that is shut, or locked.
    Door { door: DoorId, status: DoorStatus },
    /// A doorway that is open, but not wide enough. Widths in cm.
    Narrow { door: Option<DoorId>, areas: [AreaId; 2], width: f64, needed: f64 },
    /// A doorway lower than the robot.
    Low { door: DoorId, height: f64, needed: f64 },
    /// A step between two Areas that the robot does not climb.
    Step { areas: [AreaId; 2], rise: f64 },
    /// A gap between two things that is too narrow. Widths in cm.
    Gap { area: AreaId, width: f64, needed: f64, between: Vec<Blocker> },
    /// No gap at all: these things shut the way off.
    Enclosed { area: AreaId, by: Vec<Blocker> },
    /// The Areas are not joined by any door or passage.
    Apart { areas: [AreaId; 2] },
}

/// There is no way.
#[derive(Debug, Clone, PartialEq, Error, Diagnostic)]
pub enum NoRoute {
    /// Between start and goal stands what is named, in the order of the way.
    #[error("пути нет: {text}")]
    #[diagnostic(code(route::blocked), help("уберите препятствие или откройте дверь: {text}"))]
    Blocked { barriers: Vec<Barrier>, text: String },
    /// The robot fits nowhere near the start or the goal.
    #[error("пути нет: у начала или цели нет места, где робот помещается")]
    #[diagnostic(
        code(route::no_floor),
        help("проверьте, что цель стоит на полу помещения этой карты")
    )]
    NoFloor,
    /// The goal lies on another Map.
    #[error("пути нет: цель находится на другой карте (помещение № {})", area.0)]
    #[diagnostic(code(route::other_map), help("постройте путь до лифта или лестницы"))]
    OtherMap { area: AreaId },
}

impl NoRoute {
    #[must_use]
    pub fn barriers(&self) -> &[Barrier] {
        match self {
            Self::Blocked { barriers, .. } => barriers,
            _ => &[],
        }
    }
}

/// A piece of centre space: Fragment, component.
type Piece = (u32, u32);

/// Names what stands between a cell and the nearest of some others.
pub(super) fn explain(plan: &FloorPlan, world: &World, from: CellKey, to: &[CellKey]) -> NoRoute {
    let piece = |c: CellKey| (c.0, plan.floor(c.0).cells.component[c.1 as usize]);
    let goals: BTreeSet<Piece> = to.iter().map(|&c| piece(c)).collect();
    let links = links(plan, world);
    let start = piece(from);
    let mut came: BTreeMap<Piece, (Piece, Option<Barrier>)> = BTreeMap::new();
    let mut cost: BTreeMap<Piece, u32> = BTreeMap::from([(start, 0)]);
    let mut open = VecDeque::from([start]);
    while let Some(at) = open.pop_front() {
        let spent = cost[&at];
        for (next, barrier) in links.get(&at).into_iter().flatten() {
            let price = spent + u32::from(barrier.is_some());
            if cost.get(next).is_none_or(|&c| price < c) {
                cost.insert(*next, price);
                came.insert(*next, (at, barrier.clone()));
                // The queue stays sorted: free steps go to its front.
                if barrier.is_some() { open.push_back(*next) } else { open.push_front(*next) }
            }
        }
    }
    let goal = goals.iter().filter(|g| cost.contains_key(g)).min_by_key(|g| cost[g]);
    let mut barriers = Vec::new();
    if let Some(&goal) = goal {
        let mut at = goal;
        while let Some((before, barrier)) = came.get(&at) {
            barriers.extend(barrier.clone());
            at = *before;
        }
        barriers.reverse();
    }
    if barriers.is_empty() {
        barriers = vec![enclosure(plan, start, &goals)];
    }
    let text = barriers.iter().map(|b| b.describe(world)).collect::<Vec<_>>().join("; ");
    NoRoute::Blocked { barriers, text }
}

/// What would have to change between neighbouring pieces; nothing where the way is free.
fn links(plan: &FloorPlan, world: &World) -> BTreeMap<Piece, Vec<(Piece, Option<Barrier>)>> {
    let mut links: BTreeMap<Piece, Vec<(Piece, Option<Barrier>)>> = BTreeMap::new();
    let mut join = |a: Piece, b: Piece, barrier: Option<Barrier>| {
        links.entry(a).or_default().push((b, barrier.clone()));
        links.entry(b).or_default().push((a, barrier));
    };
    for (from, to) in plan.portal_ends() {
        let piece = |c: CellKey| (c.0, plan.floor(c.0).cells.component[c.1 as usize]);
        join(piece(from), piece(to), None);
    }
    let open: BTreeSet<usize> = plan.open_doorways();
    for (index, doorway) in plan.doorways().iter().enumerate() {
        if open.contains(&index) {
            continue;
        }
        let near = |side: usize| {
            let number = plan.number(doorway.areas[side])? as u32;
            let cells = &plan.floor(number).cells;
            let (_, cell) = cells.nearest(doorway.before(side, plan.reach()), |_| true)?;
            Some((number, cells.component[cell as usize]))
        };
        if let (Some(a), Some(b)) = (near(0), near(1)) {
            join(a, b, Some(barrier_at(plan, world, index)));
        }
    }
    for number in 0..plan.fragments().len() as u32 {
        for (a, b, barrier) in gaps(plan, number) {
            join((number, a), (number, b), Some(barrier));
        }
    }
    links
}

fn barrier_at(plan: &FloorPlan, world: &World, index: usize) -> Barrier {
    let doorway = &plan.doorways()[index];
    let door = doorway.door.and_then(|d| world.doors.get(&d));
    let height = plan.robot().height.get();
    if let Some(door) = door {
        let state = plan.door_state(world, door.id);
        let is_shut = state.status != DoorStatus::Open || state.opening <= 0.0;
        if is_shut && door.kind != DoorKind::Passage {
            let status = if state.status == DoorStatus::Locked {
                DoorStatus::Locked
            } else {
                DoorStatus::Closed
            };
            return Barrier::Door { door: door.id, status };
        }
        if door.height.get() > 0.0 && door.height.get() < height {
            return Barrier::Low { door: door.id, height: door.height.get(), needed: height };
        }
    }
    if doorway.rise.abs() > plan.robot().step.get() {
        return Barrier::Step { areas: doorway.areas, rise: doorway.rise };
    }
    let state = door.map_or(crate::map::DoorState::OPEN, |d| plan.door_state(world, d.id));
    Barrier::Narrow {
        door: doorway.door,
        areas: doorway.areas,
        width: doorway.clear_width(door, state),
        needed: 2.0 * plan.reach(),
    }
}

/// Dead zones between two pieces of one Fragment.
fn gaps(plan: &FloorPlan, number: u32) -> Vec<(u32, u32, Barrier)> {
    let floor = plan.floor(number);
    let mut found = Vec::new();
    for zone in &floor.dead_zones {
        let Some(width) = zone.gap else { continue };
        let bounds = zone.region.outer.bounds().grown(2.0 * plan.reach());
        let mut pieces = BTreeSet::new();
        for cell in floor.cells.cells() {
            let polygon = floor.cells.polygon(cell);
            if polygon.bounds().meets(&bounds)
                && super::doors::distance(&polygon, &zone.region.outer) <= plan.reach() * 1.02
            {
                pieces.insert(floor.cells.component[cell as usize]);
            }
        }
        let pieces: Vec<u32> = pieces.into_iter().collect();
        for (i, &a) in pieces.iter().enumerate() {
            for &b in &pieces[i + 1..] {
                let barrier = Barrier::Gap {
                    area: floor.area,
                    width,
                    needed: 2.0 * plan.reach(),
                    between: things(&zone.owners),
                };
                found.push((a, b, barrier));
            }
        }
    }
    found
}

/// Everything solid around a piece.
fn enclosure(plan: &FloorPlan, start: Piece, goals: &BTreeSet<Piece>) -> Barrier {
    let floor = plan.floor(start.0);
    let in_same = goals.iter().find(|g| g.0 == start.0);
    if let (None, Some(goal)) = (in_same, goals.first()) {
        let other = plan.floor(goal.0);
        let touches =
            |n: &super::FragmentFloor| plan.doorways().iter().any(|d| d.index_of(n.area).is_some());
        if !touches(floor) || !touches(other) {
            return Barrier::Apart { areas: [floor.area, other.area] };
        }
    }
    let cells = &floor.cells;
    let mut by = Vec::new();
    for obstacle in &floor.obstacles {
        let near = cells.cells().filter(|&c| cells.component[c as usize] == start.1).any(|c| {
            let polygon = cells.polygon(c);
            polygon.bounds().grown(plan.reach() * 1.02).meets(&obstacle.polygon.bounds())
                && super::doors::distance(&polygon, &obstacle.polygon) <= plan.reach() * 1.02
        });
        if near {
            by.push(obstacle.blocker);
        }
    }
    Barrier::Enclosed { area: floor.area, by: things(&by) }
}

impl Barrier {
    /// The barrier in Russian.
    #[must_use]
    pub fn describe(&self, world: &World) -> String {
        let area = |id: &AreaId| world.areas.get(id).map_or("?", |a| a.name.as_str());
        let door = |id: &DoorId| world.doors.get(id).map_or("?", |d| d.name.as_str());
        let list = |blockers: &[Blocker]| {
            let names: Vec<String> = blockers.iter().map(|b| b.name(world)).collect();
            names.join(", ")
        };
        match self {
            Self::Door { door: id, status: DoorStatus::Locked } => format!("{} заперта", door(id)),
            Self::Door { door: id, .. } => format!("{} закрыта", door(id)),
            Self::Narrow { door: id, areas, width, needed } => {
                let what = id.as_ref().map_or_else(
                    || format!("проход между «{}» и «{}»", area(&areas[0]), area(&areas[1])),
                    |d| format!("проём «{}»", door(d)),
                );
                format!("{what} шириной {} см, роботу нужно {} см", tenth(*width), tenth(*needed))
            }
            Self::Low { door: id, height, needed } => {
                format!(
                    "{} высотой {} см, робот высотой {} см",
                    door(id),
                    tenth(*height),
                    tenth(*needed)
                )
            }
            Self::Step { areas, rise } => format!(
                "ступень {} см между «{}» и «{}»",
                tenth(rise.abs()),
                area(&areas[0]),
                area(&areas[1])
            ),
            Self::Gap { width, needed, between, .. } => format!(
                "промежуток {} см, роботу нужно {} см ({})",
                tenth(*width),
                tenth(*needed),
                list(between)
            ),
            Self::Enclosed { area: id, by } if by.is_empty() => {
                format!("«{}»: выхода нет", area(id))
            }
            Self::Enclosed { area: id, by } => {
                format!("«{}»: путь загораживают {}", area(id), list(by))
            }
            Self::Apart { areas } => {
                format!(
                    "«{}» и «{}» не соединены ни дверью, ни проходом",
                    area(&areas[0]),
                    area(&areas[1])
                )
            }
        }
    }
}

impl Blocker {
    /// What people call it.
    #[must_use]
    pub fn name(&self, world: &World) -> String {
        let replica = |id| world.replicas.get(id).map_or_else(String::new, |r| r.name.clone());
        let door = |id| world.doors.get(id).map_or_else(String::new, |d| d.name.clone());
        match self {
            Self::Replica { replica: id, .. } => replica(id),
            Self::DoorLeaf { door: id, .. } => format!("створка «{}»", door(id)),
            Self::ReplicaLeaf { replica: id, .. } => format!("створка «{}»", replica(id)),
            Self::Wall { .. } => "стена".to_owned(),
            Self::Floor { .. } => "ступень или низкий потолок".to_owned(),
        }
    }
}

fn tenth(cm: f64) -> f64 {
    // Rounded down, so that 59.96 cm never reads as the 60 that are needed.
    (cm * 10.0 + 1e-6).floor() / 10.0
}
