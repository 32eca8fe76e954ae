//! Measurements as rows of the input relations that `rules/relations.dl` declares.
//!
//! Two kinds of rows: those of things, which one moved replica changes, and those of the world beneath them – Areas,
//! openings, parts, properties – which it does not.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::facts::Value;
use crate::geometry::contact::extent;
use crate::map::{DoorState, DoorStatus, Entity, Mark, Permeability, Properties, World, stands};
use crate::units::{AreaId, Cm, DoorId, ObjectId, OrFrId, ReplicaId, Vector};

use super::body::{Block, Kind};
use super::measure::{Between, Directed, Into, Located, Measurements, Pair, Single};
use super::names::{Subject, Symbols};
use crate::geometry::{Opening, Openings};

/// A value of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Cell<'a> {
    /// The name of something in the world.
    Name(&'a Arc<str>),
    Word(&'a str),
    Number(i64),
}

impl From<Cell<'_>> for Value {
    fn from(cell: Cell<'_>) -> Self {
        match cell {
            Cell::Name(name) => Self::Symbol(Arc::clone(name)),
            Cell::Word(word) => Self::from(word),
            Cell::Number(number) => Self::Number(number),
        }
    }
}

/// Takes the rows: relation, values.
pub(super) trait Sink {
    fn row(&mut self, relation: &'static str, cells: &[Cell<'_>]);
}

impl<F: FnMut(&'static str, &[Cell<'_>])> Sink for F {
    fn row(&mut self, relation: &'static str, cells: &[Cell<'_>]) {
        self(relation, cells);
    }
}

macro_rules! row {
    ($sink:expr, $relation:literal, $($cell:expr),+ $(,)?) => {
        $sink.row($relation, &[$(Cell::from($cell)),+])
    };
}

impl<'a> From<&'a str> for Cell<'a> {
    fn from(symbol: &'a str) -> Self {
        Cell::Word(symbol)
    }
}

impl<'a> From<&'a Arc<str>> for Cell<'a> {
    fn from(name: &'a Arc<str>) -> Self {
        Cell::Name(name)
    }
}

impl<'a> From<&'a String> for Cell<'a> {
    fn from(symbol: &'a String) -> Self {
        Cell::Word(symbol)
    }
}

impl From<i64> for Cell<'_> {
    fn from(number: i64) -> Self {
        Cell::Number(number)
    }
}

/// What rows need to know to be written.
#[derive(Clone, Copy)]
pub(super) struct Feed<'a> {
    pub(super) world: &'a World,
    pub(super) symbols: &'a Symbols,
    pub(super) measured: &'a Measurements,
    pub(super) openings: &'a Openings,
}

impl Feed<'_> {
    /// All rows of all things.
    pub(super) fn things(&self, sink: &mut impl Sink) {
        for (&id, single) in &self.measured.singles {
            self.single(id, single, sink);
        }
        for (&key, pair) in self.measured.pairs() {
            self.pair(key, pair, sink);
        }
    }

    pub(super) fn single(&self, id: ReplicaId, single: &Single, sink: &mut impl Sink) {
        let x = self.symbols.replica(id);
        let (kind, fragment) =
            (self.symbols.object(single.object), self.symbols.area(single.fragment));
        row!(sink, "replica", x, i64::from(id.0), kind, fragment, i64::from(single.move_prob));
        let &Single { bottom, top, thin, mean_size, base, .. } = single;
        row!(sink, "body", x, bottom, top, thin, mean_size, base);
        match single.place {
            Located::In { area, above_floor, below_ceiling } => {
                row!(sink, "standing_in", x, self.symbols.area(area), above_floor, below_ceiling);
            }
            Located::Out { fragment, distance } => {
                row!(sink, "off_area", x, self.symbols.area(fragment), distance);
            }
            Located::Nowhere => {}
        }
        let [at_x, at_y, at_z, angle] = single.at;
        row!(sink, "at", x, fragment, at_x, at_y, at_z, angle);
        let room = match single.place {
            Located::In { area, .. } | Located::Out { fragment: area, .. } => area,
            Located::Nowhere => return self.near_openings(x, single, sink),
        };
        for &(wall, distance) in &single.walls {
            row!(sink, "edge_distance", x, self.symbols.area(room), wall as i64, distance);
        }
        if let Some(middle) = single.middle {
            row!(sink, "middle_distance", x, self.symbols.area(room), middle);
        }
        self.near_openings(x, single, sink);
    }

    /// Both sides of an opening bear one name: the nearer counts.
    fn near_openings(&self, x: &Arc<str>, single: &Single, sink: &mut impl Sink) {
        let mut near: BTreeMap<&String, i64> = BTreeMap::new();
        for &(at, distance) in &single.openings {
            let side = self.measured.borders.open_side(at);
            let opening = side.and_then(|side| self.openings.of_side(at.0, side));
            let Some(opening) = opening else { continue };
            let known = near.entry(&opening.name).or_insert(distance);
            *known = distance.min(*known);
        }
        for (name, distance) in near {
            row!(sink, "opening_distance", x, name, distance);
        }
    }

    pub(super) fn pair(&self, key: (ReplicaId, ReplicaId), pair: &Pair, sink: &mut impl Sink) {
        let (a, b) = (self.symbols.replica(key.0), self.symbols.replica(key.1));
        self.unordered(a, b, pair, sink);
        if self.measured.reach().both_orders {
            self.unordered(b, a, pair, sink);
        }
        self.directed(a, key.1, pair, &pair.first, sink);
        self.directed(b, key.0, pair, &pair.second, sink);
    }

    /// What is measured of a pair whichever stands first.
    fn unordered(&self, a: &Arc<str>, b: &Arc<str>, pair: &Pair, sink: &mut impl Sink) {
        if pair.distance <= self.measured.reach().distance {
            row!(sink, "distance", a, b, pair.distance);
        }
        let Some(beside) = &pair.beside else { return };
        row!(sink, "beside", a, b, pair.distance, pair.level, beside.facing);
        for (third, &share) in &beside.between {
            let third = match third {
                Between::Replica(id) => self.symbols.replica(*id),
                Between::Wall(area) => self.symbols.area(*area),
            };
            row!(sink, "between", a, b, third, share);
        }
    }

    /// `a` against the thing `b`.
    fn directed(
        &self,
        a: &Arc<str>,
        b: ReplicaId,
        pair: &Pair,
        found: &Directed,
        sink: &mut impl Sink,
    ) {
        let object = &self.world.objects[&self.world.replicas[&b].object];
        let part = |block: usize| self.symbols.part(object.items[block].orthoframe);
        let face = |solid: bool| if solid { "solid" } else { "open" };
        let to = self.symbols.replica(b);
        for o in &found.over {
            let centred = i64::from(o.centred);
            row!(
                sink,
                "over",
                a,
                to,
                part(o.block),
                face(o.solid),
                o.gap,
                o.share,
                centred,
                o.lift
            );
        }
        for u in &found.below {
            row!(sink, "below", a, to, part(u.block), face(u.solid), u.gap, u.share);
        }
        for w in &found.within {
            let hold = w.block.map_or_else(|| self.symbols.object(object.id), part);
            let opening = match w.opening {
                Into::Container => "container",
                Into::Hollow => "hollow",
                Into::OpenTop => "open top",
            };
            row!(
                sink, "within", a, to, hold, opening, w.escape, w.beneath, w.above, w.bulk, w.held
            );
        }
        if let Some(middle) = found.middle {
            row!(sink, "middle_distance", a, to, middle);
        }
        if let Some(apart) = found.apart {
            row!(sink, "apart", a, to, apart);
        }
        if let Some(bearing) = found.bearing {
            row!(sink, "sector", a, to, bearing, pair.distance, pair.level);
        }
    }

    /// Everything but the things: Areas, openings, parts, properties, the robot.
    pub(super) fn ground(&self, sink: &mut impl Sink) {
        self.robot(sink);
        self.openings(|_| true, sink);
        self.world.areas.keys().for_each(|&area| self.area(area, sink));
        self.world.objects.keys().for_each(|&object| self.object(object, sink));
        self.world.orthoframes.keys().for_each(|&part| self.part(part, sink));
        self.world.doors.keys().for_each(|&door| self.door_properties(door, sink));
        self.world.replicas.keys().for_each(|&id| self.replica_properties(id, sink));
    }

    pub(super) fn robot(&self, sink: &mut impl Sink) {
        let robot = &self.world.robot;
        let width = Cm::of(robot.passing_width());
        row!(sink, "robot", width.to_tenths_mm(), robot.height.to_tenths_mm());
    }

    pub(super) fn openings(&self, wanted: impl Fn(&Opening) -> bool, sink: &mut impl Sink) {
        let tenths = |cm: f64| Cm::of(cm).to_tenths_mm();
        for o in self.openings.iter().filter(|o| wanted(o)) {
            let name = &o.name;
            let kind = if o.is_passage() { "passage" } else { "door" };
            let door = o.door.and_then(|door| self.world.doors.get(&door));
            // Of a door that the Map does not describe nothing is known, least of all that it stands open.
            if o.door.is_some() || o.permeability == Permeability::Permeable {
                row!(sink, "clear_width", name, tenths(o.free_width(self.world)));
            }
            for side in &o.sides {
                let height = door.map_or(side.height, |door| door.height.get());
                row!(sink, "opening", name, kind, tenths(side.width()), tenths(height));
                let area = self.symbols.area(side.area);
                row!(sink, "mounts", name, area);
                if side.mount.is_some() {
                    row!(sink, "mounted", name, area);
                }
                if let Some(other) = side.linked {
                    let (low, high) = (side.area.min(other), side.area.max(other));
                    row!(sink, "links", name, self.symbols.area(low), self.symbols.area(high));
                }
                for (way, found) in [("inward", side.inward), ("outward", side.outward)] {
                    if let Some((area, length)) = found {
                        row!(sink, "step", name, way, self.symbols.area(area), tenths(length));
                    }
                }
            }
            if let Some(state) = door.map(|door| door.state) {
                row!(sink, "door_state", name, status_word(state), state.opening.round() as i64);
            }
        }
    }

    /// An Area, with its parts and properties.
    pub(super) fn area(&self, id: AreaId, sink: &mut impl Sink) {
        let Some(area) = self.world.areas.get(&id) else { return };
        let whole = self.symbols.area(id);
        for item in &area.items {
            row!(sink, "part", self.symbols.part(item.orthoframe), whole, "area");
        }
        self.properties(whole, &area.properties, sink);
        let Some(room) = self.measured.rooms.get(&id) else { return };
        row!(sink, "area", whole, self.symbols.symbol(Subject::Entity(Entity::Map(room.map))));
        if let Some(narrow) = self.measured.narrow_side(id) {
            row!(sink, "narrow_side", whole, narrow);
        }
        for (wall, next, turn) in self.measured.corners(id) {
            row!(sink, "corner", whole, wall as i64, next as i64, turn);
        }
        let low = room.parts.iter().map(|p| p.1).fold(f64::INFINITY, f64::min);
        let high = room.parts.iter().map(|p| p.2).fold(f64::NEG_INFINITY, f64::max);
        for (item, (_, bottom, top)) in area.items.iter().zip(&room.parts) {
            let part = self.symbols.part(item.orthoframe);
            if let Some((from, to)) = share_of((*bottom, *top), (low, high)) {
                row!(sink, "part_along", part, whole, "area", "height", from, to);
            }
        }
    }

    /// A kind of thing, with its parts, traits and properties.
    pub(super) fn object(&self, id: ObjectId, sink: &mut impl Sink) {
        let Some(object) = self.world.objects.get(&id) else { return };
        let whole = self.symbols.object(id);
        let entry = self.world.types.object.get(object.object_type);
        for is in entry.iter().flat_map(|t| &t.traits) {
            row!(sink, "kind_trait", whole, is);
        }
        for item in &object.items {
            row!(sink, "part", self.symbols.part(item.orthoframe), whole, "object");
        }
        self.properties(whole, &object.properties, sink);
        let Some(kind) = self.measured.kind(id) else { return };
        for (item, block) in object.items.iter().zip(&kind.blocks) {
            let part = self.symbols.part(item.orthoframe);
            for (axis, (low, high)) in spans(kind, block) {
                row!(sink, "part_along", part, whole, "object", axis, low, high);
            }
        }
    }

    /// The properties of an Orthoframe.
    pub(super) fn part(&self, id: OrFrId, sink: &mut impl Sink) {
        if let Some(orthoframe) = self.world.orthoframes.get(&id) {
            self.properties(self.symbols.part(id), &orthoframe.properties, sink);
        }
    }

    fn properties(&self, of: &Arc<str>, properties: &Properties, sink: &mut impl Sink) {
        for (name, value) in properties {
            row!(sink, "property", of, name, value);
        }
    }

    pub(super) fn door_properties(&self, id: DoorId, sink: &mut impl Sink) {
        let Some(door) = self.world.doors.get(&id) else { return };
        let x = self.symbols.door(id);
        self.properties(x, &door.properties, sink);
        if !door.leaves.is_empty() && Mark::State.of(&door.properties).is_none() {
            row!(sink, "property", x, "СОСТОЯНИЕ", state_word(door.state));
        }
    }

    pub(super) fn replica_properties(&self, id: ReplicaId, sink: &mut impl Sink) {
        let Some(replica) = self.world.replicas.get(&id) else { return };
        let x = self.symbols.replica(id);
        self.properties(x, &replica.properties, sink);
        let mounts = &self.world.objects[&replica.object].doors;
        let states = mounts.iter().filter_map(|m| {
            let own = replica.door_states.get(&m.door).copied();
            own.or_else(|| self.world.doors.get(&m.door).map(|d| d.state))
        });
        // A wardrobe with one door open stands open.
        let widest = states.max_by(|a, b| a.opening.total_cmp(&b.opening));
        if stands(self.world, replica).is_some_and(|status| status != DoorStatus::Open) {
            row!(sink, "stands_shut", x);
        }
        if let Some(state) = widest.filter(|_| Mark::State.of(&replica.properties).is_none()) {
            row!(sink, "property", x, "СОСТОЯНИЕ", state_word(state));
        }
    }
}

fn status_word(state: DoorState) -> &'static str {
    match state.status {
        DoorStatus::Open => "open",
        DoorStatus::Closed => "closed",
        DoorStatus::Locked => "locked",
    }
}

fn state_word(state: DoorState) -> &'static str {
    match state.status {
        DoorStatus::Open => "Открыто",
        DoorStatus::Closed => "Закрыто",
        DoorStatus::Locked => "Заперто",
    }
}

/// Where a part lies within its Object, per mille, along height, depth (towards the front) and width (towards the left).
fn spans(kind: &Kind, block: &Block) -> Vec<(&'static str, (i64, i64))> {
    let low = kind.blocks.iter().map(|b| b.bottom).fold(f64::INFINITY, f64::min);
    let high = kind.blocks.iter().map(|b| b.top).fold(f64::NEG_INFINITY, f64::max);
    let along = |way: Vector| {
        let corners = &block.widest().polygon.corners;
        share_of(extent(corners, way), kind.extent_along(way))
    };
    let depth = kind.front.and_then(along);
    let width = kind.front.map(|f| Vector::new(-f.y, f.x)).and_then(along);
    [
        ("height", share_of((block.bottom, block.top), (low, high))),
        ("depth", depth),
        ("width", width),
    ]
    .into_iter()
    .filter_map(|(axis, span)| Some((axis, span?)))
    .collect()
}

fn share_of((low, high): (f64, f64), (from, to): (f64, f64)) -> Option<(i64, i64)> {
    let share = |v: f64| ((v - from) / (to - from) * 1000.0).round() as i64;
    (to - from > 1e-6).then(|| (share(low), share(high)))
}
