//! Why there is no route (W5): the doors, gaps and things that stand between start and goal.
//!
//! Pieces of the centre space are nodes; a closed door, an opening too narrow and a dead zone between two pieces
//! are edges between them. The way over the fewest names what would have to change.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, HashMap};

use crate::map::{DoorKind, DoorState, DoorStatus, World};
use crate::units::{AreaId, DoorId, Gather as _, InOrder as _, ZoneId};

use super::blocker::Blocker;
use super::cells::{CellKey, Piece};
use super::leaf::opening_of;
use super::narrows::{Narrow, Narrows};
use super::opening::Opening;
use super::plan::FloorPlan;
use super::scene::Scene;

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
    /// The Areas are not joined by any doors or passages.
    Apart { areas: [AreaId; 2] },
    /// No door or passage leads from an Area to any other.
    Doorless { area: AreaId },
    /// A zone that the robot has to keep out of, or that it would have to cross against its direction.
    Zone { zone: ZoneId },
}

/// There is no way.
#[derive(Debug, Clone, PartialEq)]
pub enum NoRoute {
    /// Between start and goal stands what is named, in the order of the way.
    Blocked { barriers: Vec<Barrier> },
    /// The robot fits nowhere near the start or the goal.
    NoFloor,
    /// The goal lies on another Map.
    OtherMap { area: AreaId },
}

impl NoRoute {
    #[must_use]
    pub fn barriers(&self) -> &[Barrier] {
        match self {
            Self::Blocked { barriers } => barriers,
            _ => &[],
        }
    }
}

/// Names what stands between a cell and the nearest of some others.
pub(super) fn explain(plan: &FloorPlan, world: &World, from: CellKey, to: &[CellKey]) -> NoRoute {
    let piece = |c: CellKey| (c.0, plan.floor(c.0).cells.component(c.1));
    let goals: BTreeSet<Piece> = to.iter().map(|&c| piece(c)).gather();
    let start = piece(from);
    let mut between = Between::of(plan, world);
    let ends = [
        BTreeSet::from([plan.network.region(start)]),
        goals.iter().map(|&g| plan.network.region(g)).collect(),
    ];
    // A way over what can be changed is told before a shorter one over a step or a doorway that is too low.
    let mut barriers = between
        .fewest(ends.clone())
        .or_else(|| {
            between.only_passing = false;
            between.fewest(ends)
        })
        .unwrap_or_default();
    if barriers.is_empty() {
        barriers = vec![enclosure(plan, start, &goals)];
    }
    // Several doorways may be shut by one thing.
    let mut told: Vec<Barrier> = Vec::new();
    barriers.retain(|b| {
        !told.contains(b) && {
            told.push(b.clone());
            true
        }
    });
    NoRoute::Blocked { barriers }
}

/// All that stands between the region of a cell and those of some others with nothing else before or behind it, what
/// lacks least first.
pub(super) fn single(
    plan: &FloorPlan,
    world: &World,
    from: CellKey,
    to: &[CellKey],
) -> Vec<Barrier> {
    let goals: BTreeSet<u32> = to.iter().map(|&cell| plan.region(cell)).gather();
    let mut between = Between::of(plan, world);
    let mut ends = [BTreeSet::from([plan.region(from)]), goals];
    let weight = |end: &BTreeSet<u32>| end.iter().map(|r| between.pieces[r].len()).sum::<usize>();
    ends.order_by_key(weight);
    let around = ends[0].iter().flat_map(|&region| between.all_around(region));
    let single = around.filter(|(other, _)| ends[1].contains(other));
    let mut barriers: Vec<Barrier> = single.map(|(_, barrier)| barrier).collect();
    barriers.order_by(|a, b| a.lack(plan, world).total_cmp(&b.lack(plan, world)));
    barriers
}

/// What stands between regions of the centre space, found as far as it is asked for.
struct Between<'a> {
    plan: &'a FloorPlan,
    world: &'a World,
    pieces: BTreeMap<u32, Vec<Piece>>,
    /// By Fragment.
    narrows: HashMap<u32, Narrows>,
    /// Of Fragments with an open doorway between them.
    side_by_side: HashMap<[u32; 2], Narrows>,
    /// Only over what opening, shutting or moving something can do away with.
    only_passing: bool,
}

/// How a region is reached: over what from which other, none for the first; and by how much all barriers up to it
/// together would have to give way, in cm.
struct Step {
    before: Option<(u32, Barrier)>,
    lack: f64,
}

/// The regions reached from one end.
struct Reached {
    by: BTreeMap<u32, Step>,
    rim: Vec<u32>,
}

impl Reached {
    /// The barriers from the end to a region, each with the region behind it.
    fn barriers(&self, mut region: u32) -> Vec<(Barrier, u32)> {
        let mut barriers = Vec::new();
        while let Some((before, barrier)) = &self.by[&region].before {
            barriers.push((barrier.clone(), region));
            region = *before;
        }
        barriers.reverse();
        barriers
    }

    /// Of several ends the one from which a region is reached.
    fn end_of(&self, region: u32) -> u32 {
        let before = |region: &u32| Some(self.by[region].before.as_ref()?.0);
        std::iter::successors(Some(region), before).last().unwrap_or(region)
    }

    /// The barriers from a region to the end, each with the region behind it.
    fn barriers_back(&self, mut region: u32) -> Vec<(Barrier, u32)> {
        let mut barriers = Vec::new();
        while let Some((before, barrier)) = &self.by[&region].before {
            barriers.push((barrier.clone(), *before));
            region = *before;
        }
        barriers
    }
}

impl<'a> Between<'a> {
    fn of(plan: &'a FloorPlan, world: &'a World) -> Self {
        let pieces = plan.network.pieces();
        let (narrows, side_by_side) = (HashMap::new(), HashMap::new());
        Self { plan, world, pieces, narrows, side_by_side, only_passing: true }
    }

    /// The fewest barriers from the first set of regions to the second, of as few those that lack least; gaps one after
    /// the other are one narrow way, and of its ways the widest is taken.
    ///
    /// Breadth-first from both, a whole ring of the smaller side at a time, so that a way out of a closet does not search
    /// the building.
    fn fewest(&mut self, ends: [BTreeSet<u32>; 2]) -> Option<Vec<Barrier>> {
        let first = |r: u32| (r, Step { before: None, lack: 0.0 });
        let mut sides = ends.map(|end| Reached {
            by: end.iter().copied().map(first).collect(),
            rim: end.into_iter().collect(),
        });
        loop {
            let lack = |r: &u32| Some(sides[0].by[r].lack + sides[1].by.get(r)?.lack);
            let met = sides[0].by.keys().filter_map(|r| Some((lack(r)?, *r)));
            if let Some((_, met)) = met.min_by(|a, b| a.0.total_cmp(&b.0)) {
                let mut barriers = sides[0].barriers(met);
                let start = sides[0].end_of(met);
                barriers.extend(sides[1].barriers_back(met));
                return Some(self.widened(start, &barriers));
            }
            if sides.iter().any(|s| s.rim.is_empty()) {
                return None;
            }
            let weight = |s: &Reached| s.rim.iter().map(|r| self.pieces[r].len()).sum::<usize>();
            let smaller = usize::from(weight(&sides[1]) < weight(&sides[0]));
            let side = &mut sides[smaller];
            let mut ring: BTreeMap<u32, Step> = BTreeMap::new();
            for region in std::mem::take(&mut side.rim) {
                for (next, barrier) in self.around(region) {
                    let lack = side.by[&region].lack + barrier.lack(self.plan, self.world);
                    let is_less = ring.get(&next).is_none_or(|known| lack < known.lack);
                    if is_less && !side.by.contains_key(&next) {
                        ring.insert(next, Step { before: Some((region, barrier)), lack });
                    }
                }
            }
            side.rim.extend(ring.keys());
            side.by.append(&mut ring);
        }
    }

    /// Barriers with every run of gaps as wide as it can be, given by what stands between a region and those behind.
    fn widened(&mut self, start: u32, barriers: &[(Barrier, u32)]) -> Vec<Barrier> {
        let mut widened = Vec::new();
        let mut from = start;
        for run in barriers.chunk_by(|a, b| [a, b].iter().all(|b| gap_width(&b.0).is_some())) {
            let to = run.last().map_or(from, |b| b.1);
            let widths = run.iter().filter_map(|b| gap_width(&b.0));
            let wider = widths.reduce(f64::min).and_then(|least| self.wider(from, to, least));
            widened.extend(wider.unwrap_or_else(|| run.iter().map(|b| b.0.clone()).collect()));
            from = to;
        }
        widened
    }

    /// The gaps on the widest way over gaps alone from one region to another, of as wide those that are fewest, if all
    /// are wider than `least`.
    fn wider(&mut self, from: u32, to: u32, least: f64) -> Option<Vec<Barrier>> {
        // How a region is reached: by the gap that leads there, and the step before.
        let mut steps: Vec<(u32, Option<(Barrier, usize)>)> = vec![(from, None)];
        let mut done = BTreeSet::new();
        // Widths are positive, so their bits are in their order.
        let mut open = BinaryHeap::from([(f64::INFINITY.to_bits(), Reverse(0), Reverse(0))]);
        while let Some((narrowest, Reverse(count), Reverse(step))) = open.pop() {
            let region = steps[step].0;
            if region == to {
                let back = std::iter::successors(steps[step].1.as_ref(), |s| steps[s.1].1.as_ref());
                let mut gaps: Vec<Barrier> = back.map(|s| s.0.clone()).collect();
                gaps.reverse();
                return Some(gaps);
            }
            if !done.insert(region) {
                continue;
            }
            for (next, barrier) in self.around(region) {
                let Some(width) = gap_width(&barrier).filter(|&w| w >= least + TOLD) else {
                    continue;
                };
                let narrowest = narrowest.min(width.to_bits());
                open.push((narrowest, Reverse(count + 1), Reverse(steps.len())));
                steps.push((next, Some((barrier, step))));
            }
        }
        None
    }

    /// The regions behind one barrier, and the barriers: of several gaps in a row the narrowest of the widest way.
    fn around(&mut self, region: u32) -> Vec<(u32, Barrier)> {
        let (plan, world, only_passing) = (self.plan, self.world, self.only_passing);
        let counts = |barrier: &Barrier| !(only_passing && is_lasting(plan, world, barrier));
        let mut found = self.behind(region, |narrows, piece| {
            let widest = narrows.around(piece, |gap| counts(&gap_of(plan, piece.0, gap)));
            widest.into_iter().map(|(other, gap)| (other, vec![gap])).collect()
        });
        found.retain(|(_, barrier)| counts(barrier));
        found
    }

    /// As [`Self::around`], with every gap that lies between.
    fn all_around(&mut self, region: u32) -> Vec<(u32, Barrier)> {
        self.behind(region, |narrows, piece| {
            let others = narrows.around(piece, |_| true).into_iter().map(|(other, _)| other);
            others.map(|other| (other, narrows.all_between(piece, other))).collect()
        })
    }

    fn behind(
        &mut self,
        region: u32,
        gaps: impl for<'n> Fn(&'n Narrows, Piece) -> Vec<(Piece, Vec<&'n Narrow>)>,
    ) -> Vec<(u32, Barrier)> {
        let plan = self.plan;
        let mut found = Vec::new();
        for &piece in &self.pieces[&region] {
            let (number, _) = piece;
            for &(index, side) in plan.doorways_at(number) {
                if plan.is_passable(number, index) {
                    continue;
                }
                let ends = [side, 1 - side].map(|side| before(plan, index, side));
                let [Some(near), Some(far)] = ends else { continue };
                if let Some(barrier) = barrier_at(plan, self.world, index) {
                    if near == piece {
                        found.push((plan.network.region(far), barrier));
                    }
                    continue;
                }
                let both = [number.min(far.0), number.max(far.0)];
                let narrows =
                    self.side_by_side.entry(both).or_insert_with(|| Narrows::of(plan, &both));
                let mut between = gaps(narrows, piece);
                between.retain(|((to, _), _)| *to == far.0);
                if between.is_empty() && near == piece {
                    found.push((plan.network.region(far), clutter(plan, &plan.doorways()[index])));
                }
                for (other, between) in between {
                    let other = plan.network.region(other);
                    found.extend(between.into_iter().map(|gap| (other, gap_of(plan, number, gap))));
                }
            }
            let narrows =
                self.narrows.entry(number).or_insert_with(|| Narrows::of(plan, &[number]));
            for (other, between) in gaps(narrows, piece) {
                let other = plan.network.region(other);
                found.extend(between.into_iter().map(|gap| (other, gap_of(plan, number, gap))));
            }
        }
        found.retain(|(other, _)| *other != region);
        found
    }
}

/// Gaps that differ by less, in cm, are told alike.
const TOLD: f64 = 0.1;

fn gap_width(barrier: &Barrier) -> Option<f64> {
    match barrier {
        Barrier::Gap { width, .. } => Some(*width),
        _ => None,
    }
}

/// A gap as a barrier, in or near a Fragment.
fn gap_of(plan: &FloorPlan, number: u32, gap: &Narrow) -> Barrier {
    let between = things(plan.scene(), &gap.between);
    let stands_in = between.iter().find_map(|b| match b {
        Blocker::Replica { replica, .. } => plan.scene().replicas.get(replica).map(|r| r.area),
        _ => None,
    });
    let area = stands_in.or_else(|| plan.area_at(gap.middle)).unwrap_or(plan.floor(number).area);
    Barrier::Gap { area, width: gap.width, needed: plan.robot().passing_width(), between }
}

/// The piece of centre space before a doorway, on one of its sides.
fn before(plan: &FloorPlan, index: usize, side: usize) -> Option<Piece> {
    let doorway = &plan.doorways()[index];
    let number = plan.number(doorway.areas[side])? as u32;
    let cells = &plan.floor(number).cells;
    let (_, cell) = cells.nearest(doorway.before(side, plan.reach()), |_| true)?;
    Some((number, cells.component(cell)))
}

/// What of a doorway itself bars it, if it is not what stands there: what opening the door does not help comes first.
fn barrier_at(plan: &FloorPlan, world: &World, index: usize) -> Option<Barrier> {
    let doorway = &plan.doorways()[index];
    let door = doorway.door.and_then(|d| world.doors.get(&d));
    let (height, needed) = (plan.robot().height.get(), plan.robot().passing_width());
    if let Some(door) = door.filter(|d| d.height.get() > 0.0 && d.height.get() < height) {
        return Some(Barrier::Low { door: door.id, height: door.height.get(), needed: height });
    }
    if doorway.rise.abs() > plan.robot().step.get() {
        return Some(Barrier::Step { areas: doorway.areas, rise: doorway.rise });
    }
    let narrow =
        |width: f64| Barrier::Narrow { door: doorway.door, areas: doorway.areas, width, needed };
    let widest = doorway.clear_width(door, DoorState::OPEN);
    if widest < needed {
        return Some(narrow(widest));
    }
    let state = door.map_or(DoorState::OPEN, |d| plan.door_state(world, d.id));
    if let Some(door) = door.filter(|d| d.kind != DoorKind::Passage && opening_of(state) <= 0.0) {
        let is_locked = state.status == DoorStatus::Locked;
        let status = if is_locked { DoorStatus::Locked } else { DoorStatus::Closed };
        return Some(Barrier::Door { door: door.id, status });
    }
    let width = doorway.clear_width(door, state);
    (width < needed).then(|| narrow(width))
}

/// The things that shut a doorway without a gap.
fn clutter(plan: &FloorPlan, doorway: &Opening) -> Barrier {
    let around = plan.reach() + 2.0;
    let mouth = doorway.rectangle(-around, doorway.gap + around, 0.0);
    let bounds = mouth.bounds();
    let fragments = doorway.areas.into_iter().filter_map(|area| plan.fragment(area));
    let owners = fragments.flat_map(|f| f.obstacles()).filter(|o| {
        o.polygon.bounds().meets(&bounds) && super::apart::distance(&o.polygon, &mouth) <= 0.0
    });
    let owners: Vec<Blocker> = owners.map(|o| o.blocker).collect();
    let by = things(plan.scene(), &owners);
    let stands_in = by.iter().find_map(|b| match b {
        Blocker::Replica { replica, .. } => plan.scene().replicas.get(replica).map(|r| r.area),
        _ => None,
    });
    Barrier::Enclosed { area: stands_in.unwrap_or(doorway.areas[0]), by }
}

/// Whether nothing that can be opened, shut or moved does away with a barrier.
fn is_lasting(plan: &FloorPlan, world: &World, barrier: &Barrier) -> bool {
    let moves = |b: &Blocker| match b {
        Blocker::Replica { replica, .. } => {
            world.replicas.get(replica).is_some_and(|r| r.move_prob > 0)
        }
        Blocker::DoorLeaf { .. } | Blocker::ReplicaLeaf { .. } => true,
        Blocker::Wall { .. } | Blocker::Floor { .. } | Blocker::Zone { .. } => false,
    };
    match barrier {
        Barrier::Door { .. } => false,
        Barrier::Narrow { door, .. } => door.is_none_or(|door| {
            let is_passage = world.doors.get(&door).is_none_or(|d| d.kind == DoorKind::Passage);
            is_passage || opening_of(plan.door_state(world, door)) >= 100.0
        }),
        Barrier::Gap { between, .. } => !between.iter().any(moves),
        Barrier::Enclosed { by, .. } => !by.iter().any(moves),
        Barrier::Zone { .. }
        | Barrier::Low { .. }
        | Barrier::Step { .. }
        | Barrier::Apart { .. }
        | Barrier::Doorless { .. } => true,
    }
}

/// The Fragments that doors and passages join to one, whatever their state, itself among them.
fn joined(plan: &FloorPlan, from: u32) -> BTreeSet<u32> {
    let (mut joined, mut open) = (BTreeSet::from([from]), vec![from]);
    while let Some(number) = open.pop() {
        for &(index, side) in plan.doorways_at(number) {
            let next = plan.number(plan.doorways()[index].areas[1 - side]).map(|n| n as u32);
            open.extend(next.filter(|&next| joined.insert(next)));
        }
    }
    joined
}

/// What parts a piece from others where no barrier by itself does: there is no door, or everything solid around it.
fn enclosure(plan: &FloorPlan, start: Piece, goals: &BTreeSet<Piece>) -> Barrier {
    let floor = plan.floor(start.0);
    let near = joined(plan, start.0);
    if let Some(goal) = goals.first().filter(|_| goals.iter().all(|g| !near.contains(&g.0))) {
        let areas = [floor.area, plan.floor(goal.0).area];
        let is_doorless = |number: u32| plan.doorways_at(number).is_empty();
        return match [goal.0, start.0].into_iter().find(|&number| is_doorless(number)) {
            Some(number) => Barrier::Doorless { area: plan.floor(number).area },
            None => Barrier::Apart { areas },
        };
    }
    let cells = &floor.cells;
    let mut by = Vec::new();
    for obstacle in floor.obstacles() {
        let near = cells.cells().filter(|&c| cells.component(c) == start.1).any(|c| {
            let polygon = cells.polygon(c);
            polygon.bounds().grown(plan.reach() * 1.02).meets(&obstacle.polygon.bounds())
                && super::apart::distance(&polygon, &obstacle.polygon) <= plan.reach() * 1.02
        });
        if near {
            by.push(obstacle.blocker);
        }
    }
    Barrier::Enclosed { area: floor.area, by: things(plan.scene(), &by) }
}

impl Barrier {
    /// By how much what is there would have to give way, in cm: nothing for a door that only needs opening, and more than
    /// any gap for what leaves none.
    fn lack(&self, plan: &FloorPlan, world: &World) -> f64 {
        const NO_GAP: f64 = 1e4;
        match self {
            Self::Door { .. } => 0.0,
            Self::Narrow { .. } if !is_lasting(plan, world, self) => 0.0,
            Self::Narrow { width, needed, .. } | Self::Gap { width, needed, .. } => {
                (needed - width).max(0.0)
            }
            Self::Low { height, needed, .. } => needed - height,
            Self::Enclosed { .. }
            | Self::Step { .. }
            | Self::Apart { .. }
            | Self::Doorless { .. }
            | Self::Zone { .. } => NO_GAP,
        }
    }
}

/// The distinct things among blockers, each with its part that is in the way: of several the lowest.
fn things(scene: &Scene, blockers: &[Blocker]) -> Vec<Blocker> {
    let bottom = |b: &Blocker| match *b {
        Blocker::Replica { replica, item } => {
            let prisms = scene.replicas.get(&replica).map_or(&[][..], |r| &r.prisms);
            prisms.iter().find(|p| p.item == item).map_or(0.0, |p| p.bottom)
        }
        _ => 0.0,
    };
    let whole = |b: &Blocker| match *b {
        Blocker::Replica { replica, .. } => Blocker::Replica { replica, item: 0 },
        Blocker::DoorLeaf { door, .. } => Blocker::DoorLeaf { door, leaf: 0 },
        other => other,
    };
    let mut parts: BTreeMap<Blocker, Blocker> = BTreeMap::new();
    for part in blockers {
        let kept = parts.entry(whole(part)).or_insert(*part);
        if bottom(part) < bottom(kept) {
            *kept = *part;
        }
    }
    parts.into_iter().map(|(whole, part)| if bottom(&part) > 0.0 { part } else { whole }).collect()
}
