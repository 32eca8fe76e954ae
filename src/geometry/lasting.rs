//! What of a floor is there for good: the room that is left when all that may go has gone and every door stands wide open.
//!
//! A planner asks it before anything is tried: where even this floor has no way, none is made by opening, shutting, carrying
//! or pushing. What leads on as the floor is needs no asking; rooms in which something does not are measured, each once.
//!
//! **Invariant**: it has every way that the floor has that it was made from, however doors stand and wherever things are
//! that may go; it may have others.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::map::{DoorState, World};
use crate::units::{AreaId, DoorId, Gather as _, Point, ReplicaId};

use super::Bounds;
use super::blocker::Blocker;
use super::cells::Piece;
use super::opening::Opening;
use super::plan::FloorPlan;
use super::replica_index::ReplicaIndex;
use super::route::Target;
use super::scene::{PlacedReplica, Scene};
use super::site::{DoorStates, SLACK};

/// Who is sent to a thing stands no farther from it than this and what he keeps clear, in cm.
const AT_THING: f64 = 150.0;

/// Where the robot may stand that was sent somewhere in an Area, or anywhere in it.
#[derive(Debug, Clone)]
pub struct Foothold {
    area: AreaId,
    target: Option<Target>,
    /// On the floor as it is; on what is left of it once that is asked for.
    now: BTreeSet<Piece>,
    lasting: OnceCell<BTreeSet<Piece>>,
}

/// The floor of one Map with nothing about but what stays.
#[derive(Debug, Clone)]
pub struct LastingFloor {
    /// Its Fragments are those of the floor that it was made from until they are measured.
    plan: FloorPlan,
    /// With doors that are open and have no leaves.
    open: World,
    /// The Areas whose Fragments are its own.
    measured: BTreeSet<AreaId>,
    /// The pieces of a Fragment from which a doorway's door is at hand, by doorway and side.
    before: BTreeMap<(usize, usize), BTreeSet<Piece>>,
}

impl LastingFloor {
    /// Of a floor and its world, with the things of it that stay where they are.
    #[must_use]
    pub fn of(floor: &FloorPlan, world: &World, stays: impl Fn(ReplicaId) -> bool) -> Self {
        let mut open = world.clone();
        for door in open.doors.values_mut() {
            (door.state, door.leaves) = (DoorState::OPEN, Vec::new());
        }
        let whole = floor.scene();
        let kept = whole.replicas.values().filter(|thing| stays(thing.id)).cloned();
        // Its own leaves are open or shut, as it pleases whoever comes by.
        let without_leaves = |thing| PlacedReplica { has_doors: false, ..thing };
        let replicas = kept.map(|thing| (thing.id, without_leaves(thing))).gather();
        let scene = Scene { map: whole.map, areas: whole.areas.clone(), replicas };
        let index = Arc::new(ReplicaIndex::of(&scene));
        let states = DoorStates::new();
        let plan = FloorPlan { scene: Arc::new(scene), index, states, ..floor.clone() };
        Self { plan, open, measured: BTreeSet::new(), before: BTreeMap::new() }
    }

    /// The Areas that something may part for good, given the floor as it is now.
    pub fn parted<'f>(&'f self, now: &'f FloorPlan) -> impl Iterator<Item = AreaId> + 'f {
        let is_parted = |area: &AreaId| !self.is_whole(now, *area);
        now.fragments.iter().map(|fragment| fragment.area).filter(is_parted)
    }

    /// The doorways that may not be passed, or not opened, however things are.
    pub fn barred<'f>(&'f self, now: &'f FloorPlan) -> impl Iterator<Item = &'f Opening> + 'f {
        let ways = now.doorways.ways.iter().enumerate();
        ways.filter(|&(index, way)| !self.is_clear(now, index, way)).map(|(_, way)| &**way)
    }

    /// Where the robot may stand that is sent to a target in an Area; `now` is the floor as it is, and `world` that of it.
    #[must_use]
    pub fn foothold(
        &self,
        now: &FloorPlan,
        world: &World,
        area: AreaId,
        target: Option<Target>,
    ) -> Foothold {
        let at_hand = |index, side| now.piece_before(world, index, side).into_iter().gather();
        let now = pieces_at(now, world, (area, target), |_| true, at_hand);
        Foothold { area, target, now, lasting: OnceCell::new() }
    }

    /// Whether there may be a way from one to another that does not leave their Areas.
    #[must_use]
    pub fn may_lead(&mut self, now: &FloorPlan, from: &Foothold, to: &Foothold) -> bool {
        let areas = [from.area, to.area];
        let is_through = |way: &Opening| areas.iter().all(|area| way.areas.contains(area));
        let mut ways = now.doorways.ways.iter().enumerate();
        let is_next_door = from.area != to.area
            && ways.any(|(n, way)| is_through(way) && self.is_clear(now, n, way));
        if is_next_door || leads(now, &from.now, areas, &to.now) {
            return true;
        }
        let [starts, ends] = [from, to].map(|foothold| {
            foothold.lasting.get_or_init(|| self.pieces_of(now, foothold.area, foothold.target))
        });
        // Where it could not stand it is not for the floor to say how it gets on.
        starts.is_empty() || leads(&self.plan, starts, areas, ends)
    }

    /// Whether nothing that stays stops the leaves of a door of the world on their way from shut to wide open.
    #[must_use]
    pub fn swings(&mut self, world: &World, door: DoorId) -> bool {
        self.plan.states.insert(door, DoorState::CLOSED);
        let by = self.plan.struck_by(world, door);
        self.plan.states.remove(&door);
        // Other leaves can be set otherwise.
        !matches!(by, Some(Blocker::Replica { .. }))
    }

    /// Whether nothing parts the floor of an Area for good.
    fn is_whole(&self, now: &FloorPlan, area: AreaId) -> bool {
        let fragment = now.number(area).map(|number| now.floor(number as u32));
        let Some(fragment) = fragment else { return true };
        fragment.cells.components == 1 || self.is_bare(&fragment.bounds.grown(self.plan.reach()))
    }

    /// Whether nothing that stays, and no zone that is shut, is in a box.
    fn is_bare(&self, place: &Bounds) -> bool {
        let mut shut = self.plan.zones.iter().filter(|zone| zone.kind.is_shut());
        self.plan.index.near(&self.plan.scene, place).is_empty()
            && !shut.any(|zone| zone.bounds().meets(place))
    }

    /// Whether a doorway is passed as it is; or it is wide and high enough, and nothing that stays stands at it, nor where
    /// its leaves pass.
    fn is_clear(&self, now: &FloorPlan, index: usize, way: &Opening) -> bool {
        let (reach, width) = (self.plan.reach(), way.width());
        let about = reach.max(width);
        let is_passed = || now.network.portals.iter().flatten().any(|p| p.doorway == index);
        let is_wide = || {
            width >= 2.0 * (reach - SLACK) && self.plan.with_site(&self.open, |s| s.is_open(way))
        };
        let is_bare = || self.is_bare(&way.rectangle(-about, way.gap + about, about).bounds());
        is_passed() || is_wide() && is_bare()
    }

    /// The pieces of what is left of an Area's floor in which the robot may be that was sent to a target there.
    fn pieces_of(
        &mut self,
        now: &FloorPlan,
        area: AreaId,
        target: Option<Target>,
    ) -> BTreeSet<Piece> {
        if self.measured.insert(area) {
            self.plan.renew(&self.open, &[area]);
        }
        let (plan, open, before) = (&self.plan, &self.open, &mut self.before);
        let at_hand = |index, side| {
            let known = before.entry((index, side));
            known.or_insert_with(|| plan.pieces_before(open, index, side)).clone()
        };
        // Where something stands that may go, the robot stops near by, on whatever side it comes from.
        pieces_at(plan, open, (area, target), |point| now.fits(point), at_hand)
    }
}

/// The pieces of an Area's floor in which the robot may be that was sent to a target there; `is_free` tells of a point
/// whether it comes to stand in it, and `at_hand` the pieces from which the door of a doorway is, by its number and side.
fn pieces_at(
    plan: &FloorPlan,
    world: &World,
    (area, target): (AreaId, Option<Target>),
    is_free: impl Fn(Point) -> bool,
    mut at_hand: impl FnMut(usize, usize) -> BTreeSet<Piece>,
) -> BTreeSet<Piece> {
    let Some(number) = plan.number(area).map(|number| number as u32) else {
        return BTreeSet::new();
    };
    let cells = &plan.floor(number).cells;
    let piece = |cell| plan.piece_of((number, cell));
    let anywhere = || (0..cells.components).map(|component| (number, component)).gather();
    match target {
        Some(Target::Door { door, .. }) => {
            let own = plan.doorways_at(number).iter();
            let own = own.filter(|(index, _)| plan.doorways()[*index].door == Some(door));
            let mut own = own.peekable();
            match own.peek() {
                Some(_) => own.flat_map(|&(index, side)| at_hand(index, side)).gather(),
                // It leads out of the building.
                None => anywhere(),
            }
        }
        Some(Target::Replica(id)) => {
            let Some(thing) = plan.scene().replicas.get(&id) else { return anywhere() };
            let near = cells.meeting(&thing.bounds.grown(AT_THING + plan.reach()));
            let near: BTreeSet<Piece> = near.into_iter().map(piece).gather();
            if near.is_empty() { anywhere() } else { near }
        }
        Some(target @ (Target::Point(_) | Target::Place(_))) => {
            let point = plan.point_of(world, target).filter(|point| is_free(*point));
            let cell = point.and_then(|point| cells.locate(point, 1e-6));
            cell.map_or_else(anywhere, |cell| BTreeSet::from([piece(cell)]))
        }
        Some(Target::Area(_)) | None => anywhere(),
    }
}

/// Whether some of these pieces lead to some others within two Areas.
fn leads(
    plan: &FloorPlan,
    from: &BTreeSet<Piece>,
    areas: [AreaId; 2],
    to: &BTreeSet<Piece>,
) -> bool {
    if !from.is_disjoint(to) {
        return true;
    }
    let numbers = areas.map(|area| plan.number(area).map(|number| number as u32));
    let own = numbers.iter().flatten();
    let portals = own.flat_map(|&number| &plan.network.portals[number as usize]);
    let portals = portals.map(|portal| [portal.from, portal.to]);
    let straits = plan.network.straits.iter().map(|strait| strait.cells());
    let is_within = |ends: &[Piece; 2]| ends.iter().all(|end| numbers.contains(&Some(end.0)));
    let links =
        portals.chain(straits).filter(is_within).map(|ends| ends.map(|end| plan.piece_of(end)));
    let links: Vec<[Piece; 2]> = links.collect();
    let mut reached = from.clone();
    let mut open: Vec<Piece> = reached.iter().copied().collect();
    while let Some(from) = open.pop() {
        let next = links.iter().filter(|ends| ends.contains(&from)).flatten();
        open.extend(next.copied().filter(|next| reached.insert(*next)));
    }
    !reached.is_disjoint(to)
}
