//! What is measured between things that are near, in the integer units of the facts (SPEC R1, R4).
//!
//! Lengths are tenths of a millimetre, angles hundredths of a degree, shares per mille. Nothing here knows what a
//! number means: how near is "next to" stands in `rules/relations.dl`. Only [`Reach`], taken from that same text,
//! says how far measuring need look, so that its cost grows with the number of near pairs.

mod between;
mod borders;
mod pair;
mod rooms;
mod single;
mod update;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use borders::Borders;
pub use pair::{Below, Beside, Between, Directed, Into, Over, Pair, Within};
pub(super) use pair::{level, surface_distance};
pub(super) use rooms::Room;
pub use single::{Located, Single};
pub use update::Change;

use crate::map::World;
use crate::units::{AreaId, Cm, Frame, MapId, ObjectId, ReplicaId};

use super::body::{Body, Kind};
use super::grid::Grid;

/// Fewer things than this are measured by one thread: starting more would take longer.
const LEAST_SHARE: usize = 2_000;

/// How far measuring looks, in tenths of a millimetre. The facts `reach(name, limit)` of the rule text set it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reach {
    /// Surface distances up to this are facts.
    pub distance: i64,
    /// Facing sides and what stands between, up to this surface distance.
    pub beside: i64,
    /// Sectors round a front, up to this surface distance.
    pub sector: i64,
    /// How deep a foot may sink below a roof, and a roof rise above the base over it.
    pub sink: i64,
    /// How far a thing may stick out of what holds it.
    pub escape: i64,
    /// How far from its Fragment a thing that is in no Area may be.
    pub outside: i64,
    /// How far from a wall of its Area a thing may be.
    pub edge: i64,
    /// How far from a door or passage a thing may be.
    pub opening: i64,
    /// From the middle of one thing to what surrounds another, up to this; the standard rules do without it.
    pub apart: i64,
    /// Whether what may be told either way is told in both orders.
    pub both_orders: bool,
}

impl Default for Reach {
    fn default() -> Self {
        Self {
            distance: 13_000,
            beside: 6_000,
            sector: 20_000,
            sink: 1_000,
            escape: 1_000,
            outside: 5_000,
            edge: 5_000,
            opening: 10_000,
            apart: 0,
            both_orders: false,
        }
    }
}

/// OUTSIDE is derived for all things while there are no more pairs of thing and Area than this.
const MOST_OUTSIDE: usize = 100_000;

/// Everything measured on the Maps of a world.
#[derive(Debug, Clone)]
pub struct Measurements {
    reach: Reach,
    kinds: BTreeMap<ObjectId, Kind>,
    pub(super) placements: BTreeMap<AreaId, (MapId, Frame)>,
    pub(super) rooms: BTreeMap<AreaId, Room>,
    room_grid: BTreeMap<MapId, Grid<AreaId>>,
    pub(super) borders: Borders,
    pub(super) bodies: BTreeMap<ReplicaId, Body>,
    grids: BTreeMap<MapId, Grid<ReplicaId>>,
    pub(super) singles: BTreeMap<ReplicaId, Single>,
    /// Measured when first asked for: a reopened store may answer without.
    near: OnceLock<Near>,
}

/// What is measured of pairs.
#[derive(Debug, Clone, Default, PartialEq)]
struct Near {
    pairs: BTreeMap<Key, Pair>,
    /// For each thing the pairs between which it stands.
    stands_between: BTreeMap<ReplicaId, BTreeSet<Key>>,
}

/// A pair of things, the lower id first.
type Key = (ReplicaId, ReplicaId);

/// The same measurements, whatever way they came about.
impl PartialEq for Measurements {
    fn eq(&self, other: &Self) -> bool {
        self.singles == other.singles && self.near() == other.near() && self.bodies == other.bodies
    }
}

impl Measurements {
    /// Measures all Maps of a world.
    #[must_use]
    pub fn of(world: &World, reach: Reach) -> Self {
        let measured = Self::of_things(world, reach);
        measured.near();
        measured
    }

    /// Measures things and Areas; pairs when they are first asked for.
    pub(super) fn of_things(world: &World, reach: Reach) -> Self {
        let mut measured = Self {
            reach,
            kinds: BTreeMap::new(),
            placements: BTreeMap::new(),
            rooms: BTreeMap::new(),
            room_grid: BTreeMap::new(),
            borders: Borders::default(),
            bodies: BTreeMap::new(),
            grids: BTreeMap::new(),
            singles: BTreeMap::new(),
            near: OnceLock::new(),
        };
        world.objects.keys().for_each(|&object| measured.enter_kind(world, object));
        for (area, placement) in world.placements() {
            measured.enter_room(world, area, placement);
        }
        measured.bodies = world
            .replicas
            .keys()
            .filter_map(|&id| {
                Some((id, Body::new(world, &measured.kinds, &measured.placements, id)?))
            })
            .collect();
        for body in measured.bodies.values() {
            measured.grids.entry(body.map).or_default().insert(body.id, &body.bounds);
        }
        measured.singles = measured.bodies.values().map(|b| (b.id, measured.single(b))).collect();
        measured
    }

    /// Works out what the replicas of an Object have in common; there must be none in place.
    pub(crate) fn enter_kind(&mut self, world: &World, id: ObjectId) {
        self.kinds.remove(&id);
        let kind = world.objects.get(&id).and_then(|object| Kind::of(world, object));
        self.kinds.extend(kind.map(|kind| (id, kind)));
    }

    /// Takes over where an Area stands, and what bounds it; things near it must not be in place.
    pub(crate) fn enter_room(&mut self, world: &World, id: AreaId, placement: (MapId, Frame)) {
        self.forget_room(id);
        self.placements.insert(id, placement);
        let Some(room) = Room::of(world, id, placement) else { return };
        self.room_grid.entry(room.map).or_default().insert(id, &room.bounds);
        self.borders.enter(world, &room, &placement.1);
        self.rooms.insert(id, room);
    }

    pub(crate) fn forget_room(&mut self, id: AreaId) {
        self.placements.remove(&id);
        self.borders.forget(id);
        if let Some(room) = self.rooms.remove(&id)
            && let Some(grid) = self.room_grid.get_mut(&room.map)
        {
            grid.remove(id, &room.bounds);
        }
    }

    /// The things that may be within reach of what bounds an Area, as they are in place.
    pub(crate) fn things_near(&self, room: &Room) -> Vec<ReplicaId> {
        let Reach { beside, escape, outside, edge, opening, .. } = self.reach;
        let reach = cm(beside.max(escape).max(outside).max(edge).max(opening));
        let mut found = Vec::new();
        if let Some(grid) = self.grids.get(&room.map) {
            grid.near(&room.bounds.grown(reach), &mut found);
        }
        found
    }

    fn near(&self) -> &Near {
        self.near.get_or_init(|| self.measure_pairs())
    }

    fn near_mut(&mut self) -> &mut Near {
        self.near();
        self.near.get_mut().expect("measured in the line before")
    }

    /// All pairs that are near enough to say something of.
    pub(super) fn pairs(&self) -> &BTreeMap<Key, Pair> {
        &self.near().pairs
    }

    /// Measures all near pairs, on all cores where there are many things.
    fn measure_pairs(&self) -> Near {
        let bodies: Vec<&Body> = self.bodies.values().collect();
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let share = bodies.len().div_ceil(cores).max(LEAST_SHARE);
        let pairs: Vec<(Key, Pair)> = if bodies.len() <= share {
            self.pairs_of(&bodies)
        } else {
            std::thread::scope(|scope| {
                let parts: Vec<_> = bodies
                    .chunks(share)
                    .map(|part| scope.spawn(move || self.pairs_of(part)))
                    .collect();
                let joined = parts.into_iter().map(|part| match part.join() {
                    Ok(pairs) => pairs,
                    Err(panic) => std::panic::resume_unwind(panic),
                });
                joined.flatten().collect()
            })
        };
        let mut near = Near::default();
        for (key, pair) in &pairs {
            near.note_between(*key, pair);
        }
        near.pairs = pairs.into_iter().collect();
        near
    }

    /// The pairs of which these bodies are the first.
    fn pairs_of(&self, bodies: &[&Body]) -> Vec<(Key, Pair)> {
        let mut pairs = Vec::new();
        let mut near = Vec::new();
        for a in bodies {
            self.around(a, &mut near);
            for b in near.iter().filter(|&&b| b > a.id).map(|b| &self.bodies[b]) {
                if let Some(mut pair) = self.pair(a, b) {
                    let key = (a.id, b.id);
                    let between = pair.beside.as_ref().map(|_| self.between(key, &pair));
                    if let Some((beside, between)) = pair.beside.as_mut().zip(between) {
                        beside.between = between;
                    }
                    pairs.push((key, pair));
                }
            }
        }
        pairs
    }

    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    pub(super) fn kind(&self, object: ObjectId) -> Option<&Kind> {
        self.kinds.get(&object)
    }

    /// Number of pairs near enough to say something of.
    #[must_use]
    pub fn pair_count(&self) -> usize {
        self.pairs().len()
    }

    /// Whether OUTSIDE is derived of every thing.
    pub(super) fn asks_of_all(&self) -> bool {
        asks_of_all(self.bodies.len(), self.rooms.len())
    }

    /// The Map on which a thing is.
    pub(super) fn map_of(&self, thing: ReplicaId) -> Option<MapId> {
        self.bodies.get(&thing).map(|body| body.map)
    }

    /// What is measured of each thing by itself.
    pub(super) fn singles(&self) -> &BTreeMap<ReplicaId, Single> {
        &self.singles
    }

    /// What is measured of a thing by itself.
    #[must_use]
    pub fn of_thing(&self, id: ReplicaId) -> Option<&Single> {
        self.singles.get(&id)
    }

    /// What is measured of two things, the lower id first; none when they are far apart.
    #[must_use]
    pub fn of_pair(&self, a: ReplicaId, b: ReplicaId) -> Option<&Pair> {
        self.pairs().get(&(a.min(b), a.max(b)))
    }

    /// All things that may be within reach of a body, itself among them if it is in the grid.
    fn around(&self, body: &Body, found: &mut Vec<ReplicaId>) {
        let Reach { distance, beside, sector, apart, .. } = self.reach;
        let reach = cm(distance.max(beside).max(sector).max(apart));
        match self.grids.get(&body.map) {
            Some(grid) => grid.near(&body.bounds.grown(reach), found),
            None => found.clear(),
        }
    }
}

/// Whether OUTSIDE is derived of every one of so many things.
pub(crate) fn asks_of_all(things: usize, rooms: usize) -> bool {
    things * rooms <= MOST_OUTSIDE
}

pub(super) fn tenths(length: f64) -> i64 {
    Cm::of(length).to_tenths_mm()
}

pub(super) fn cm(tenths: i64) -> f64 {
    tenths as f64 / 100.0
}

pub(super) fn hundredths(degrees: f64) -> i64 {
    (degrees * 100.0).round() as i64
}

pub(super) fn per_mille(share: f64) -> i64 {
    (share * 1000.0).round() as i64
}
