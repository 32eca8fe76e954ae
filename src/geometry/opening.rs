//! A door or passage between Areas: where it is, what its leaves occupy, and how wide it stands open (M7).
//!
//! There is one such value for each, made once for a building ([`super::Openings`]): facts, floor, plans, answers, drawings
//! and reports speak of it by its id. Geometry measures it; what it joins is decided by the rules.
//!
//! It joins a side of one Area to a side of another across the wall between them, which may be thin as a
//! line. Its own coordinates: `t` runs along the side of the first Area (from the right jamb to the left one,
//! seen from inside), `s` leads out of that Area:
//!
//! ```text
//!              second Area
//!   s = gap  ▔▔▔▔▔┐         ┌▔▔▔▔▔▔   its side
//!              wall│- - - -│ wall    the line on which the Fragments meet, s = gap / 2
//!   s = 0    ▁▁▁▁▁┘         └▁▁▁▁▁▁   the side of the first Area
//!                 t0        t1
//!              first Area
//! ```
//!
//! How the leaves of its door stand in it is told by [`super::leaf`].

use crate::map::{Door, DoorMount, DoorState, OpensTo, Permeability, SideRef, World};
use crate::units::{AreaId, DoorId, InOrder as _, MapId, OpeningId, Point, Vector};

use super::leaf::{Bay, Leaves};
use super::{Bounds, Polygon};

/// Two sides that have less in common, in cm, make no way.
pub(super) const LEAST_WIDTH: f64 = 1e-3;

/// A side of an Area through which one may pass, as it was measured, in the Map's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenSide {
    pub area: AreaId,
    pub side: SideRef,
    /// Counter-clockwise round the Area.
    pub ends: (Point, Point),
    /// Height of the floor before it, in cm.
    pub floor: f64,
    /// Of the Orthoframe whose side it is, in cm.
    pub height: f64,
    pub permeability: Permeability,
    pub mount: Option<DoorMount>,
    /// The other Area of the link, where the Map binds this side.
    pub linked: Option<AreaId>,
    /// The Areas on either side within the reach of a step, with the way to them in cm.
    pub inward: Option<(AreaId, f64)>,
    pub outward: Option<(AreaId, f64)>,
}

impl OpenSide {
    #[must_use]
    pub fn width(&self) -> f64 {
        (self.ends.1 - self.ends.0).norm()
    }

    #[must_use]
    pub fn middle(&self) -> Point {
        nalgebra::center(&self.ends.0, &self.ends.1)
    }

    /// The Area behind it as far as measuring tells: by the link, else by stepping through.
    #[must_use]
    pub fn behind(&self) -> Option<AreaId> {
        self.linked.or(self.outward.map(|(area, _)| area))
    }
}

/// A door or a passage.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// Its place in [`super::Openings`].
    pub id: OpeningId,
    pub map: MapId,
    /// Its name in the facts: the door's, or one made of the Areas that it joins.
    pub name: String,
    /// The Area that mounts the door first, then the other; twice the same where only one has a side there.
    pub areas: [AreaId; 2],
    /// Of these Areas: two, or one.
    pub sides: Vec<OpenSide>,
    /// None for an open passage.
    pub door: Option<DoorId>,
    /// Conditional: a door. Permeable: a passage.
    pub permeability: Permeability,
    /// Pairs of Areas that it joins, the lower id first: as measured, until the rules have decided.
    pub joins: Vec<[AreaId; 2]>,
    /// Towards which Area the leaves swing: 0 or 1, an index of `areas`.
    pub opens_to: usize,
    /// Depth of the wall between the sides, in cm.
    pub gap: f64,
    /// Floor of the second Area less floor of the first, in cm.
    pub rise: f64,
    origin: Point,
    along: Vector,
    span: (f64, f64),
    is_through: bool,
}

impl Opening {
    /// The opening that two sides of a Map make; none when they do not overlap.
    pub(super) fn between(world: &World, map: MapId, a: &OpenSide, b: &OpenSide) -> Option<Self> {
        // The first Area is the one that mounts the door first.
        let rank = |s: &OpenSide| (s.mount.is_none(), s.area);
        let (a, b) = if rank(b) < rank(a) { (b, a) } else { (a, b) };
        let (start, end) = a.ends;
        let along = (end - start).try_normalize(0.0)?;
        let out = Vector::new(along.y, -along.x);
        let (near, far) = (b.ends.1 - start, b.ends.0 - start);
        let span = (near.dot(&along).max(0.0), far.dot(&along).min((end - start).norm()));
        if span.1 - span.0 < LEAST_WIDTH {
            return None;
        }
        let gap = ((near + far).dot(&out) / 2.0).max(0.0);
        let mut made = Self::of(world, map, vec![a.clone(), b.clone()], (along, span, gap));
        made.is_through = true;
        Some(made)
    }

    /// What a side, or two that have no width in common, make: nothing that a floor goes through.
    pub(super) fn blind(world: &World, map: MapId, mut sides: Vec<OpenSide>) -> Self {
        sides.order_by_key(|s| (s.mount.is_none(), s.area));
        let (start, end) = sides[0].ends;
        let along = (end - start).try_normalize(1e-9).unwrap_or_else(Vector::x);
        let width = (end - start).norm();
        Self::of(world, map, sides, (along, (0.0, width), 0.0))
    }

    fn of(
        world: &World,
        map: MapId,
        sides: Vec<OpenSide>,
        (along, span, gap): (Vector, (f64, f64), f64),
    ) -> Self {
        let (a, b) = (&sides[0], &sides[sides.len() - 1]);
        let door = a.mount.as_ref().or(b.mount.as_ref()).map(|m| m.door);
        // A door narrower than its side stands in the middle of it.
        let width = door.and_then(|d| world.doors.get(&d)).map_or(0.0, |d| d.width.get());
        let margin = if width > 0.0 { (span.1 - span.0 - width).max(0.0) / 2.0 } else { 0.0 };
        let span = if margin > 1e-6 { (span.0 + margin, span.1 - margin) } else { span };
        let opens_to = match (&a.mount, &b.mount) {
            (Some(m), _) => usize::from(m.opens == OpensTo::Outside),
            (None, Some(m)) => usize::from(m.opens == OpensTo::Inside),
            (None, None) => 0,
        };
        let joins = if a.area == b.area {
            Vec::new()
        } else {
            vec![[a.area.min(b.area), a.area.max(b.area)]]
        };
        Self {
            id: OpeningId(0),
            map,
            name: String::new(),
            areas: [a.area, b.area],
            door,
            permeability: a.permeability.max(b.permeability),
            joins,
            opens_to,
            gap,
            rise: b.floor - a.floor,
            origin: a.ends.0,
            along,
            span,
            is_through: false,
            sides,
        }
    }

    /// Whether it is called and measured as another; its number, and what the rules let it join, do not count.
    #[must_use]
    pub fn is_measured_as(&self, other: &Self) -> bool {
        (self.map, &self.name, &self.sides, self.rise, self.is_through)
            == (other.map, &other.name, &other.sides, other.rise, other.is_through)
            && self.is_shaped_as(other)
    }

    /// Whether a floor leads through it as through another of the same sides; see [`Self::shape`].
    pub(super) fn is_shaped_as(&self, other: &Self) -> bool {
        let bay = |o: &Self| (o.opens_to, o.gap, o.rise, o.origin, o.along, o.span);
        let kind = |o: &Self| (o.areas, o.door, o.permeability);
        kind(self) == kind(other) && bay(self) == bay(other)
    }

    /// Whether the floor before it, on the side of an Area, may tell of another doorway of that Area; for a robot that
    /// keeps `reach` from everything.
    pub(super) fn may_tell(&self, beside: &Self, reach: f64) -> bool {
        let around = Bounds::of([self.middle()]).grown(self.width() / 2.0 + 3.0 * reach);
        around.grown(beside.width() + 1.0).contains(beside.middle())
            || beside.mouth(1.0).meets(&self.mouth(reach).grown(1.0))
    }

    /// The point at `t` along the first Area's side, `s` out of that Area.
    #[must_use]
    pub fn at(&self, t: f64, s: f64) -> Point {
        self.origin + self.along * t + self.out() * s
    }

    /// Unit vector out of the first Area into the second.
    #[must_use]
    pub fn out(&self) -> Vector {
        Vector::new(self.along.y, -self.along.x)
    }

    /// Width between the jambs, in cm.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.span.1 - self.span.0
    }

    /// The right and the left jamb, as `t`.
    #[must_use]
    pub fn span(&self) -> (f64, f64) {
        self.span
    }

    /// The line on which the Fragments meet, right jamb first, seen from the first Area.
    #[must_use]
    pub fn line(&self) -> (Point, Point) {
        (self.at(self.span.0, self.gap / 2.0), self.at(self.span.1, self.gap / 2.0))
    }

    #[must_use]
    pub fn middle(&self) -> Point {
        self.at((self.span.0 + self.span.1) / 2.0, self.gap / 2.0)
    }

    /// Which of the two Areas: 0 or 1.
    #[must_use]
    pub fn index_of(&self, area: AreaId) -> Option<usize> {
        self.areas.iter().position(|&a| a == area)
    }

    /// Whether two sides, of two Areas, make it, with a width in common.
    #[must_use]
    pub fn is_through(&self) -> bool {
        self.is_through
    }

    /// Whether a floor goes through it: two sides make it, and the rules say that it joins their Areas.
    #[must_use]
    pub fn is_way(&self) -> bool {
        let [a, b] = self.areas;
        self.is_through() && self.joins.contains(&[a.min(b), a.max(b)])
    }

    /// The Area that it joins to this one, by the rules.
    #[must_use]
    pub fn joined_to(&self, area: AreaId) -> Option<AreaId> {
        let pair = self.joins.iter().find(|pair| pair.contains(&area))?;
        pair.iter().copied().find(|other| *other != area)
    }

    /// The Areas in whose sides it lies, and those that it joins, each once.
    #[must_use]
    pub fn all_areas(&self) -> Vec<AreaId> {
        let mut all = Vec::new();
        let mut own: Vec<AreaId> = self.sides.iter().map(|side| side.area).collect();
        own.sort_unstable();
        for area in own.into_iter().chain(self.joins.iter().flatten().copied()) {
            if !all.contains(&area) {
                all.push(area);
            }
        }
        all
    }

    /// Whether it lies in a side of an Area or joins that Area.
    #[must_use]
    pub fn is_of(&self, area: AreaId) -> bool {
        self.side_in(area).is_some() || self.joins.iter().any(|pair| pair.contains(&area))
    }

    /// The width that the leaves leave free as they stand in a world, in cm.
    #[must_use]
    pub fn free_width(&self, world: &World) -> f64 {
        let door = self.door.and_then(|door| world.doors.get(&door));
        self.clear_width(door, door.map_or(DoorState::OPEN, |door| door.state))
    }

    /// Its side in an Area.
    #[must_use]
    pub fn side_in(&self, area: AreaId) -> Option<&OpenSide> {
        self.sides.iter().find(|side| side.area == area)
    }

    /// The Area whose side it is: the one that mounts its door, or the first.
    #[must_use]
    pub fn area(&self) -> AreaId {
        self.areas[0]
    }

    #[must_use]
    pub fn is_passage(&self) -> bool {
        self.permeability == Permeability::Permeable
    }

    /// The middle of the opening, `distance` cm before the face of the wall on the side of an Area (0 or 1).
    #[must_use]
    pub fn before(&self, side: usize, distance: f64) -> Point {
        self.at(
            (self.span.0 + self.span.1) / 2.0,
            if side == 0 { -distance } else { self.gap + distance },
        )
    }

    /// A point of the opening in the face of the wall on the side of an Area (0 or 1), by its share of the width.
    pub(super) fn on_face(&self, side: usize, share: f64) -> Point {
        let t = self.span.0 + self.width() * share;
        self.at(t, if side == 0 { 0.0 } else { self.gap })
    }

    /// The rectangle between the jambs from `s = from` to `s = to`, widened by `by` on both sides.
    pub(super) fn rectangle(&self, from: f64, to: f64, by: f64) -> Polygon {
        let (t0, t1) = (self.span.0 - by, self.span.1 + by);
        let (low, high) = (from.min(to), from.max(to));
        // `along` × `out` is negative, so this order is counter-clockwise.
        Polygon::new(vec![self.at(t0, low), self.at(t0, high), self.at(t1, high), self.at(t1, low)])
            .counter_clockwise()
    }

    /// A door's leaves as they hang in this doorway.
    #[must_use]
    pub fn leaves<'d>(&self, door: &'d Door) -> Leaves<'d> {
        let bay = Bay { origin: self.origin, along: self.along, span: self.span, gap: self.gap };
        Leaves { door, bay, opens_to: self.opens_to }
    }

    /// All that its floor is made of, which is what it is but for its number and names.
    pub(super) fn shape(&self) -> impl std::fmt::Debug + '_ {
        let sides: Vec<&SideRef> = self.sides.iter().map(|side| &side.side).collect();
        let bay = (self.gap, self.rise, self.origin, self.along, self.span);
        (self.areas, sides, self.door, self.permeability, self.opens_to, bay)
    }

    /// The widest gap that the leaves leave between each other and the jambs, in cm; the width for a passage.
    #[must_use]
    pub fn clear_width(&self, door: Option<&Door>, state: DoorState) -> f64 {
        door.map_or(self.width(), |door| self.leaves(door).clear_width(state))
    }
}
