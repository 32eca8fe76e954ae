//! What is measured between things that are near, in the integer units of the facts (SPEC R1, R4).
//!
//! Lengths are tenths of a millimetre, angles hundredths of a degree, shares per mille. Nothing here knows what a
//! number means: how near is "next to" stands in `rules/relations.dl`. Only [`Reach`], taken from that same text,
//! says how far measuring need look, so that its cost grows with the number of near pairs.
//!
//! **Invariant:** after any [`Measurements::update`] the measurements equal those made from scratch.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use crate::geometry::contact::{
    Footprint, Gap, bounds_distance, escape, facing_overlap, gap, length_within, overlap_area,
    stays_within,
};
use crate::geometry::{Bounds, Polygon};
use crate::map::{Item, World};
use crate::units::{AreaId, Cm, Frame, MapId, ObjectId, Point, ReplicaId};

use super::body::{Block, Body, Kind};
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
    /// From the middle of one thing to what surrounds another, up to this; the standard rules do without it.
    pub apart: i64,
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
            apart: 0,
        }
    }
}

/// `a` stands or hangs over the roof of a block of `b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Over {
    pub block: usize,
    pub solid: bool,
    /// Foot less roof.
    pub gap: i64,
    /// Share of `a`'s foot that is over the roof.
    pub share: i64,
    /// Whether `a`'s centre is over the roof.
    pub centred: bool,
    /// Foot less the block's middle height.
    pub lift: i64,
}

/// `a` is below the base of a block of `b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Below {
    pub block: usize,
    pub solid: bool,
    /// Base less the highest roof of `a` beneath it.
    pub gap: i64,
    /// Share of `a`'s outline that is beneath the block.
    pub share: i64,
}

/// Through what a thing got into another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Into {
    /// The type of the Object says that it holds things.
    Container,
    /// Some face of the block is permeable or a door.
    Hollow,
    /// The block's roof is permeable.
    OpenTop,
}

/// `a` lies within `b`, or nearly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Within {
    /// None for the whole of a container.
    pub block: Option<usize>,
    pub opening: Into,
    /// How far `a` sticks out sideways.
    pub escape: i64,
    /// How far `a` reaches below the bottom; negative above it.
    pub beneath: i64,
    /// How far `a` reaches above the top; negative below it.
    pub above: i64,
    /// Volume of `a` over that of what holds it.
    pub bulk: i64,
    /// Share of `a`'s own volume that is inside.
    pub held: i64,
}

/// What is measured of one thing against another: (upper, lower), (inner, outer), (seen, anchor).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Directed {
    pub over: Vec<Over>,
    pub below: Vec<Below>,
    pub within: Vec<Within>,
    /// Hundredths of a degree from the front of the other, counter-clockwise positive.
    pub bearing: Option<i64>,
    /// From the middle of this thing to the hull of the other, from its bottom to its top.
    pub apart: Option<i64>,
}

/// What stands between two things that are beside each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Between {
    Replica(ReplicaId),
    /// A wall of this Area.
    Wall(AreaId),
}

/// Two things beside each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Beside {
    /// Overlap of the sides that they turn to each other, share of the shorter.
    pub facing: i64,
    /// What stands between, and the share of the common height that it fills.
    pub between: BTreeMap<Between, i64>,
}

/// All that is measured of a pair of things, the lower id first.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// Between surfaces, in space.
    pub distance: i64,
    /// Common height, share of the lower thing's.
    pub level: i64,
    pub beside: Option<Box<Beside>>,
    /// The first seen from the second.
    pub first: Directed,
    /// The second seen from the first.
    pub second: Directed,
    /// Where the surfaces are nearest in the plan; what stands between is looked for there.
    way: Gap,
}

/// One thing by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Single {
    pub object: ObjectId,
    pub fragment: AreaId,
    pub move_prob: u8,
    pub bottom: i64,
    pub top: i64,
    /// The smaller of its sizes along its own axes.
    pub thin: i64,
    /// Mean of its sizes along its own axes.
    pub mean_size: i64,
    /// cm² of its outline.
    pub base: i64,
    pub place: Located,
}

/// Which Area holds the interior point of a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Located {
    /// Within the base of the Area: height above its floor, and of the foot below its ceiling.
    In { area: AreaId, above_floor: i64, below_ceiling: i64 },
    /// In no Area's base; so far from the base of its own Fragment.
    Out { fragment: AreaId, distance: i64 },
    /// In no Area, and far from its Fragment.
    Nowhere,
}

impl Single {
    #[must_use]
    pub fn area(&self) -> Option<AreaId> {
        match self.place {
            Located::In { area, .. } => Some(area),
            _ => None,
        }
    }
}

/// The pairs whose measurements an update changed, and the things whose own did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Change {
    pub removed: BTreeMap<(ReplicaId, ReplicaId), Pair>,
    pub added: BTreeSet<(ReplicaId, ReplicaId)>,
    pub single_before: Option<Single>,
    pub single_after: Option<Single>,
}

/// The floor of one Area, ready for measuring.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Room {
    pub(super) id: AreaId,
    pub(super) map: MapId,
    pub(super) parts: Vec<(Footprint, f64, f64)>,
    pub(super) bounds: Bounds,
}

/// Everything measured on the Maps of a world.
#[derive(Debug, Clone)]
pub struct Measurements {
    reach: Reach,
    kinds: BTreeMap<ObjectId, Kind>,
    pub(super) placements: BTreeMap<AreaId, (MapId, Frame)>,
    pub(super) rooms: BTreeMap<AreaId, Room>,
    room_grid: BTreeMap<MapId, Grid<AreaId>>,
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
        let placements = placements(world);
        let mut measured = Self {
            reach,
            kinds: world
                .objects
                .values()
                .filter_map(|o| Some((o.id, Kind::of(world, o)?)))
                .collect(),
            rooms: rooms(world),
            room_grid: BTreeMap::new(),
            bodies: BTreeMap::new(),
            grids: BTreeMap::new(),
            singles: BTreeMap::new(),
            near: OnceLock::new(),
            placements,
        };
        for room in measured.rooms.values() {
            measured.room_grid.entry(room.map).or_default().insert(room.id, &room.bounds);
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

    fn single(&self, body: &Body) -> Single {
        let kind = &self.kinds[&body.object];
        Single {
            object: body.object,
            fragment: body.fragment,
            move_prob: body.move_prob,
            bottom: tenths(body.bottom),
            top: tenths(body.top),
            thin: tenths(kind.size.0.min(kind.size.1)),
            mean_size: tenths(f64::midpoint(kind.size.0, kind.size.1)),
            base: kind.outline_area.round() as i64,
            place: self.locate(body),
        }
    }

    /// The Area whose base holds a point of a Map; the lowest id where bases meet.
    #[must_use]
    pub fn area_at(&self, map: MapId, p: Point) -> Option<AreaId> {
        let mut near = Vec::new();
        self.room_grid.get(&map)?.near(&Bounds { min: p, max: p }, &mut near);
        near.into_iter().find(|id| self.rooms[id].parts.iter().any(|(f, _, _)| f.contains(p)))
    }

    /// The Areas of a Map whose bounds may meet these, in the order of their ids.
    pub(super) fn rooms_near(&self, map: MapId, bounds: &Bounds, found: &mut Vec<AreaId>) {
        match self.room_grid.get(&map) {
            Some(grid) => grid.near(bounds, found),
            None => found.clear(),
        }
    }

    /// Number of pairs near enough to say something of.
    #[must_use]
    pub fn pair_count(&self) -> usize {
        self.pairs().len()
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

    /// Measures one replica anew after it was moved, added or removed in `world`; Areas and Objects must be as they were.
    pub fn update(&mut self, world: &World, id: ReplicaId) -> Change {
        self.near();
        let mut change = Change { single_before: self.singles.remove(&id), ..Change::default() };
        let mut near = Vec::new();
        if let Some(body) = self.bodies.remove(&id) {
            self.forget(&body, &mut near, &mut change);
        }
        if let Some(body) = Body::new(world, &self.kinds, &self.placements, id) {
            self.enter(body, &mut near, &mut change);
        }
        change.single_after = self.singles.get(&id).copied();
        change
    }

    fn forget(&mut self, body: &Body, near: &mut Vec<ReplicaId>, change: &mut Change) {
        let id = body.id;
        if let Some(grid) = self.grids.get_mut(&body.map) {
            grid.remove(id, &body.bounds);
        }
        self.around(body, near);
        for &other in near.iter() {
            let key = (id.min(other), id.max(other));
            let near = self.near_mut();
            if let Some(pair) = near.pairs.remove(&key) {
                near.clear_between(key, &pair);
                change.removed.insert(key, pair);
            }
        }
        let near = self.near_mut();
        for key in near.stands_between.remove(&id).unwrap_or_default() {
            let Some(pair) = near.pairs.get_mut(&key) else { continue };
            change.removed.entry(key).or_insert_with(|| pair.clone());
            change.added.insert(key);
            if let Some(beside) = &mut pair.beside {
                beside.between.remove(&Between::Replica(id));
            }
        }
    }

    fn enter(&mut self, body: Body, near: &mut Vec<ReplicaId>, change: &mut Change) {
        let id = body.id;
        self.grids.entry(body.map).or_default().insert(id, &body.bounds);
        self.around(&body, near);
        self.singles.insert(id, self.single(&body));
        let mut found = Vec::new();
        for &other in near.iter().filter(|&&b| b != id) {
            let other = &self.bodies[&other];
            let (a, b) = if id < other.id { (&body, other) } else { (other, &body) };
            if let Some(pair) = self.pair(a, b) {
                change.added.insert((a.id, b.id));
                found.push(((a.id, b.id), pair));
            }
        }
        self.near_mut().pairs.extend(found);
        // A way between two others that this thing now crosses has both its ends within reach of it.
        let reach = cm(self.reach.beside);
        near.retain(|&n| {
            n != id && bounds_distance(&self.bodies[&n].bounds, &body.bounds) <= reach
        });
        self.bodies.insert(id, body);
        let entered: Vec<_> =
            change.added.iter().copied().filter(|k| k.0 == id || k.1 == id).collect();
        for key in entered {
            self.look_between(key);
        }
        for (i, &a) in near.iter().enumerate() {
            for &b in &near[i + 1..] {
                self.step_between((a, b), id, change);
            }
        }
    }

    /// Notes that `third` stands between two others, if it does.
    fn step_between(&mut self, key: (ReplicaId, ReplicaId), third: ReplicaId, change: &mut Change) {
        let Some(pair) = self.pairs().get(&key) else { return };
        if pair.beside.is_none() {
            return;
        }
        let share = self.fills(key, pair, &self.bodies[&third]);
        if share == 0 {
            return;
        }
        change.removed.entry(key).or_insert_with(|| pair.clone());
        change.added.insert(key);
        let near = self.near_mut();
        let beside = near.pairs.get_mut(&key).and_then(|p| p.beside.as_mut());
        beside.expect("looked up above").between.insert(Between::Replica(third), share);
        near.stands_between.entry(third).or_default().insert(key);
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

    fn pair(&self, a: &Body, b: &Body) -> Option<Pair> {
        let sideways = bounds_distance(&a.bounds, &b.bounds);
        let upright = (a.bottom - b.top).max(b.bottom - a.top);
        let crossing = sideways <= 0.0;
        let level = level(a, b);
        let faces = a.front.is_some() || b.front.is_some();
        let in_sector = |d: f64| {
            d <= cm(self.reach.sector)
                && faces
                && level.is_some()
                && self.singles[&a.id].area() == self.singles[&b.id].area()
        };
        let least = sideways.hypot(upright.max(0.0));
        let reach = cm(self.reach.distance.max(self.reach.apart));
        if !(crossing || least <= reach || in_sector(least)) {
            return None;
        }
        let (distance, way) = surface_distance(a, b);
        let mut pair = Pair {
            distance: tenths(distance),
            level: level.unwrap_or(0),
            beside: None,
            first: Directed::default(),
            second: Directed::default(),
            way,
        };
        if crossing {
            pair.first = self.contacts(a, b);
            pair.second = self.contacts(b, a);
        }
        if in_sector(distance) {
            let bearing =
                |seen: &Body, anchor: &Body| anchor.bearing_of(seen.centre).map(hundredths);
            pair.first.bearing = bearing(a, b);
            pair.second.bearing = bearing(b, a);
        }
        if self.reach.apart > 0 {
            let near = |d: &i64| *d <= self.reach.apart;
            pair.first.apart = Some(tenths(apart(a, b))).filter(near);
            pair.second.apart = Some(tenths(apart(b, a))).filter(near);
        }
        if level.is_some() && pair.distance <= self.reach.beside {
            pair.beside = Some(Box::new(Beside {
                facing: per_mille(facing_overlap(&a.hull, &b.hull)),
                between: BTreeMap::new(),
            }));
        }
        let says_something = pair.distance <= self.reach.distance
            || pair.first != Directed::default()
            || pair.second != Directed::default();
        says_something.then_some(pair)
    }

    fn contacts(&self, a: &Body, b: &Body) -> Directed {
        let mut found = Directed::default();
        let (kind_a, kind_b) = (&self.kinds[&a.object], &self.kinds[&b.object]);
        let sink = cm(self.reach.sink);
        let later = rests_later(a, kind_a, b, kind_b);
        for (index, block) in b.blocks.iter().enumerate() {
            if later && a.bottom - block.top >= -sink {
                found.over.extend(over(a, kind_a, index, block));
            }
            if block.bottom - a.bottom >= -sink {
                found
                    .below
                    .extend(below(a, kind_a, index, block).filter(|u| u.gap >= -self.reach.sink));
            }
            if block.hollow {
                let hold = std::slice::from_ref(block.widest());
                let opening = if block.open_top { Into::OpenTop } else { Into::Hollow };
                let volume = block.widest().area * (block.top - block.bottom);
                let within = self.within(a, kind_a, hold, (block.bottom, block.top), volume);
                found.within.extend(within.map(|w| Within { block: Some(index), opening, ..w }));
            }
        }
        if kind_b.container {
            let within = self.within(a, kind_a, &b.outline, (b.bottom, b.top), kind_b.volume);
            found.within.extend(within);
        }
        found
    }

    fn within(
        &self,
        a: &Body,
        kind: &Kind,
        hold: &[Footprint],
        (bottom, top): (f64, f64),
        volume: f64,
    ) -> Option<Within> {
        let reach = cm(self.reach.escape);
        let bounds = hold.iter().fold(Bounds::EMPTY, |b, f| b.union(&f.bounds)).grown(reach);
        let fits = bounds.contains(a.bounds.min) && bounds.contains(a.bounds.max);
        if !fits || bottom - a.bottom > reach || a.bottom > top {
            return None;
        }
        let held_by: Vec<&Footprint> = hold.iter().collect();
        let sticks_out = a.outline.iter().map(|f| escape(f, &held_by)).fold(0.0, f64::max);
        let height = a.top - a.bottom;
        let upright = if height > 0.0 {
            (a.top.min(top) - a.bottom.max(bottom)).max(0.0) / height
        } else {
            // What lies flat on the top is on it.
            f64::from(u8::from(bottom <= a.bottom && a.bottom < top))
        };
        let flat = a.outline.iter().flat_map(|f| hold.iter().map(move |h| overlap_area(f, h)));
        let held = upright * (flat.sum::<f64>() / kind.outline_area).min(1.0);
        (sticks_out <= reach).then(|| Within {
            block: None,
            opening: Into::Container,
            escape: tenths(sticks_out),
            beneath: tenths(bottom - a.bottom),
            above: tenths(a.top - top),
            // Rounded down, so that less than the whole is less than 1000.
            bulk: if volume > 0.0 { (kind.volume / volume * 1000.0) as i64 } else { 1000 },
            held: per_mille(held),
        })
    }

    /// Everything that stands between a pair, from scratch.
    fn look_between(&mut self, key: Key) {
        let Some(pair) = self.pairs().get(&key).filter(|p| p.beside.is_some()) else { return };
        let found = self.between(key, pair);
        let near = self.near_mut();
        let pair = near.pairs.get_mut(&key).expect("looked up above");
        pair.beside.as_mut().expect("looked up above").between = found;
        let pair = pair.clone();
        near.note_between(key, &pair);
    }

    fn between(&self, key: (ReplicaId, ReplicaId), pair: &Pair) -> BTreeMap<Between, i64> {
        let mut found = BTreeMap::new();
        if pair.way.distance <= 0.0 {
            return found;
        }
        let (from, to) = (pair.way.from, pair.way.to);
        let a = &self.bodies[&key.0];
        let mut near = Vec::new();
        if let Some(grid) = self.grids.get(&a.map) {
            grid.near(&Bounds::of([from, to]), &mut near);
        }
        for third in near.iter().filter(|&&t| t != key.0 && t != key.1) {
            let share = self.fills(key, pair, &self.bodies[third]);
            if share > 0 {
                found.insert(Between::Replica(*third), share);
            }
        }
        let areas = [key.0, key.1].map(|id| self.singles[&id].area());
        if let [Some(area), Some(other)] = areas
            && area == other
        {
            let floor: Vec<&Footprint> =
                self.rooms[&area].parts.iter().map(|(f, _, _)| f).collect();
            if !stays_within(from, to, &floor, 0.5) {
                found.insert(Between::Wall(area), 1000);
            }
        }
        found
    }

    /// Share of a pair's common height that a third thing fills where the two are nearest.
    fn fills(&self, key: (ReplicaId, ReplicaId), pair: &Pair, third: &Body) -> i64 {
        let (a, b) = (&self.bodies[&key.0], &self.bodies[&key.1]);
        let (from, to) = (pair.way.from, pair.way.to);
        if pair.way.distance <= 0.0 || !third.bounds.meets(&Bounds::of([from, to])) {
            return 0;
        }
        let (low, high) = (a.bottom.max(b.bottom), a.top.min(b.top));
        // What holds both of them is round them, not between them.
        let holds_both = |base: &Footprint| base.contains(from) && base.contains(to);
        let in_the_way = |block: &&Block| {
            block.top > low
                && block.bottom < high
                && length_within(from, to, &block.base) > 0.5
                && !holds_both(&block.base)
        };
        let filled: f64 = third
            .blocks
            .iter()
            .filter(in_the_way)
            .map(|block| block.top.min(high) - block.bottom.max(low))
            .sum();
        per_mille((filled / (high - low)).min(1.0))
    }

    fn locate(&self, body: &Body) -> Located {
        let p = body.interior_point();
        let floor_at = |room: &Room| {
            let here = |f: &&(Footprint, f64, f64)| f.0.contains(p);
            let storey = |f: &&(Footprint, f64, f64)| body.bottom <= f.2 && body.top >= f.1;
            let parts = || room.parts.iter().filter(here);
            parts().find(storey).map(|&(_, bottom, top)| Located::In {
                area: room.id,
                above_floor: tenths(body.bottom - bottom),
                below_ceiling: tenths(top - body.bottom),
            })
        };
        let mut near = Vec::new();
        if let Some(grid) = self.room_grid.get(&body.map) {
            grid.near(&Bounds { min: p, max: p }, &mut near);
        }
        // Where bases meet or overlap, the Map's maker decides.
        let own = self.rooms.get(&body.fragment);
        let others = near.iter().filter_map(|id| self.rooms.get(id));
        if let Some(place) = own.into_iter().chain(others).find_map(floor_at) {
            return place;
        }
        let distance = own.map_or(f64::INFINITY, |room| {
            room.parts.iter().map(|(f, _, _)| f.distance_to(p)).fold(f64::INFINITY, f64::min)
        });
        if distance <= cm(self.reach.outside) {
            Located::Out { fragment: body.fragment, distance: tenths(distance) }
        } else {
            Located::Nowhere
        }
    }
}

impl Near {
    fn note_between(&mut self, key: Key, pair: &Pair) {
        for thing in pair.beside.iter().flat_map(|b| b.between.keys()) {
            if let Between::Replica(third) = thing {
                self.stands_between.entry(*third).or_default().insert(key);
            }
        }
    }

    fn clear_between(&mut self, key: Key, pair: &Pair) {
        for thing in pair.beside.iter().flat_map(|b| b.between.keys()) {
            if let Between::Replica(third) = thing
                && let Some(keys) = self.stands_between.get_mut(third)
            {
                keys.remove(&key);
                if keys.is_empty() {
                    self.stands_between.remove(third);
                }
            }
        }
    }
}

/// Where every Area stands.
fn placements(world: &World) -> BTreeMap<AreaId, (MapId, Frame)> {
    let items = world.maps.values().flat_map(|m| m.items.iter().map(|i| (m.id, i)));
    items.map(|(map, item)| (item.area, (map, item.frame))).collect()
}

fn rooms(world: &World) -> BTreeMap<AreaId, Room> {
    let placed = placements(world).into_iter().filter_map(|(area, (map, frame))| {
        let part = |item: &Item| {
            let orthoframe = world.orthoframe_of(item);
            let place = frame.compose(&item.frame);
            let base = Polygon::new(orthoframe.corners().map(|p| place.apply(p)).collect());
            let bottom = place.z.get();
            (Footprint::new(base), bottom, bottom + orthoframe.height.get())
        };
        let parts: Vec<_> = world.areas.get(&area)?.items.iter().map(part).collect();
        let bounds = parts.iter().fold(Bounds::EMPTY, |b, (f, _, _)| b.union(&f.bounds));
        Some((area, Room { id: area, map, parts, bounds }))
    });
    placed.collect()
}

/// Whether `a` can rest on `b`: it starts higher, or level with it has the smaller base. This order keeps support acyclic.
fn rests_later(a: &Body, kind_a: &Kind, b: &Body, kind_b: &Kind) -> bool {
    let levels = a.bottom.total_cmp(&b.bottom);
    let bases = kind_b.outline_area.total_cmp(&kind_a.outline_area);
    levels.then(bases).then(a.id.cmp(&b.id)).is_gt()
}

fn over(a: &Body, kind: &Kind, index: usize, block: &Block) -> Option<Over> {
    let roof = block.roof();
    let common: f64 = kind.foot.iter().map(|&i| overlap_area(&a.blocks[i].base, roof)).sum();
    let share = per_mille((common / kind.foot_area).min(1.0));
    let centred = roof.contains(a.centre);
    (share > 0 || centred).then(|| Over {
        block: index,
        solid: block.solid_roof,
        gap: tenths(a.bottom - block.top),
        share,
        centred,
        lift: tenths(a.bottom - f64::midpoint(block.bottom, block.top)),
    })
}

fn below(a: &Body, kind: &Kind, index: usize, block: &Block) -> Option<Below> {
    let beneath = |part: &&Block| overlap_area(part.widest(), &block.base) > 0.5;
    let highest = a.blocks.iter().filter(beneath).map(|part| part.top).reduce(f64::max)?;
    let common: f64 = a.outline.iter().map(|f| overlap_area(f, &block.base)).sum();
    let share = per_mille((common / kind.outline_area).min(1.0));
    (share > 0).then(|| Below {
        block: index,
        solid: block.solid_base,
        gap: tenths(block.bottom - highest),
        share,
    })
}

/// Common height of two things as a share of the lower one; none when one ends where the other begins.
pub(super) fn level(a: &Body, b: &Body) -> Option<i64> {
    let common = a.top.min(b.top) - a.bottom.max(b.bottom);
    let lower = (a.top - a.bottom).min(b.top - b.bottom);
    if lower <= 0.0 {
        // A flat thing is on a level with what it cuts.
        return (common >= 0.0 && (a.top - a.bottom).max(b.top - b.bottom) > 0.0).then_some(1000);
    }
    (common > 0.0).then(|| per_mille(common / lower))
}

/// Shortest distance in space, and the way in the plan between the two nearest Orthoframes.
pub(super) fn surface_distance(a: &Body, b: &Body) -> (f64, Gap) {
    let mut best: Option<(f64, Gap)> = None;
    for p in &a.blocks {
        for q in &b.blocks {
            let upright = (p.bottom - q.top).max(q.bottom - p.top).max(0.0);
            let (f, g) = (p.widest(), q.widest());
            let least = bounds_distance(&f.bounds, &g.bounds).hypot(upright);
            if best.is_some_and(|(d, _)| least >= d - 1e-9) {
                continue;
            }
            let way = gap(f, g);
            let distance = way.distance.hypot(upright);
            if best.is_none_or(|(d, _)| distance < d) {
                best = Some((distance, way));
            }
        }
    }
    best.expect("a body has at least one Orthoframe")
}

/// From the middle of `a` to the box round `b`: its hull, from its bottom to its top.
fn apart(a: &Body, b: &Body) -> f64 {
    let middle = f64::midpoint(a.bottom, a.top);
    let upright = (b.bottom - middle).max(middle - b.top).max(0.0);
    b.hull.distance_to(a.centre).hypot(upright)
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

fn per_mille(share: f64) -> i64 {
    (share * 1000.0).round() as i64
}
