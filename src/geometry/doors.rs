//! Doors and passages: where they are, what their leaves occupy, and how wide they stand open (M7).
//!
//! A doorway joins a side of one Area to a side of another across the wall between them, which may be thin as a
//! line. Its own coordinates: `t` runs along the side of the first Area (from the right jamb to the left one,
//! seen from inside), `s` leads out of that Area:
//!
//! ```text
//!              second Area
//!   s = gap  ▔▔▔▔▔┐         ┌▔▔▔▔▔▔   its side
//!              wall│- - - - -│ wall    the doorway's line, s = gap / 2
//!   s = 0    ▁▁▁▁▁┘         └▁▁▁▁▁▁   the side of the first Area
//!                 t0        t1
//!              first Area
//! ```
//!
//! How the leaves of its door stand in it is told by [`super::leaf`].

use std::collections::BTreeMap;

use crate::map::{Door, DoorMount, DoorState, OpensTo, Permeability, SideRef, World};
use crate::units::{AreaId, DoorId, MapId, Point, Vector};

use super::buckets::Buckets;
use super::leaf::{Bay, Leaves};
use super::scene::{PlacedArea, Scene};
use super::{Bounds, Polygon, nearest_on_segment};

/// An opening between two Areas of a Map.
#[derive(Debug, Clone, PartialEq)]
pub struct Doorway {
    /// The Area that mounts the door first, then the other.
    pub areas: [AreaId; 2],
    pub sides: [SideRef; 2],
    /// None for an open passage.
    pub door: Option<DoorId>,
    pub permeability: Permeability,
    /// Towards which Area the leaves swing: 0 or 1, an index of `areas`.
    pub opens_to: usize,
    /// Depth of the wall between the sides, in cm.
    pub gap: f64,
    /// Floor of the second Area less floor of the first, in cm.
    pub rise: f64,
    origin: Point,
    along: Vector,
    span: (f64, f64),
}

impl Doorway {
    /// A door that leads out of the Map, as a doorway of the only Area that mounts it: its index is 0, and there is
    /// nothing beyond.
    #[must_use]
    pub fn outer(world: &World, placed: &PlacedArea, door: DoorId) -> Option<Self> {
        let mount = world.areas.get(&placed.id)?.doors.iter().find(|m| m.door == door)?;
        let (right, left) = world.threshold(placed.id, door)?;
        let (origin, left) = (placed.frame.apply(right), placed.frame.apply(left));
        let side = SideRef { item: mount.item.clone(), side: mount.side.clone() };
        Some(Self {
            areas: [placed.id; 2],
            sides: [side.clone(), side],
            door: Some(door),
            permeability: Permeability::Conditional,
            opens_to: usize::from(mount.opens == OpensTo::Outside),
            gap: 0.0,
            rise: 0.0,
            origin,
            along: (left - origin).try_normalize(1e-9)?,
            span: (0.0, (left - origin).norm()),
        })
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

    /// The middle of the opening, `distance` cm before the face of the wall on the side of an Area (0 or 1).
    #[must_use]
    pub fn before(&self, side: usize, distance: f64) -> Point {
        self.at(
            (self.span.0 + self.span.1) / 2.0,
            if side == 0 { -distance } else { self.gap + distance },
        )
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

    /// The widest gap that the leaves leave between each other and the jambs, in cm; the width for a passage.
    #[must_use]
    pub fn clear_width(&self, door: Option<&Door>, state: DoorState) -> f64 {
        door.map_or(self.width(), |door| self.leaves(door).clear_width(state))
    }
}

/// Distance between two polygons, 0 where they meet. Two corners make a segment.
pub(super) fn distance(a: &Polygon, b: &Polygon) -> f64 {
    distance_within(a, b, f64::INFINITY).unwrap_or(f64::INFINITY)
}

/// Distance between two polygons if it is less than a limit.
pub(super) fn distance_within(a: &Polygon, b: &Polygon, limit: f64) -> Option<f64> {
    let inside = |p: &Polygon, q: &Polygon| {
        p.corners.len() > 2 && q.corners.first().is_some_and(|&c| p.winds_around(c))
    };
    if inside(a, b) || inside(b, a) {
        return Some(0.0);
    }
    let mut least = limit;
    let whole = b.bounds();
    for (p, q) in a.edges() {
        // Edges whose boxes are further away than the nearest so far bring nothing nearer.
        let edge = Bounds::of([p, q]).grown(least);
        if !edge.meets(&whole) {
            continue;
        }
        for (u, v) in b.edges() {
            if Bounds::of([u, v]).meets(&edge) {
                least = least.min(segment_distance(p, q, u, v));
            }
        }
    }
    (least < limit).then_some(least)
}

pub(super) fn segment_distance(p: Point, q: Point, u: Point, v: Point) -> f64 {
    let side = |a: Point, b: Point, c: Point| (b - a).perp(&(c - a));
    let crosses = side(p, q, u) * side(p, q, v) < 0.0 && side(u, v, p) * side(u, v, q) < 0.0;
    if crosses {
        return 0.0;
    }
    [
        (p - nearest_on_segment(p, u, v)).norm(),
        (q - nearest_on_segment(q, u, v)).norm(),
        (u - nearest_on_segment(u, p, q)).norm(),
        (v - nearest_on_segment(v, p, q)).norm(),
    ]
    .into_iter()
    .fold(f64::INFINITY, f64::min)
}

/// A side of an Area through which one may pass.
struct OpenSide {
    area: AreaId,
    side: SideRef,
    start: Point,
    end: Point,
    floor: f64,
    permeability: Permeability,
    mount: Option<DoorMount>,
}

/// All doorways of a Map: linked sides first, then doors that two Areas mount, then sides that face each other.
#[must_use]
pub fn doorways(world: &World, scene: &Scene, map: MapId) -> Vec<Doorway> {
    let mut open: Vec<Option<OpenSide>> =
        scene.areas.values().flat_map(|area| open_sides(world, area)).map(Some).collect();
    let mut found = Vec::new();
    let mut pair = |open: &mut Vec<Option<OpenSide>>, i: usize, j: usize| {
        let (Some(a), Some(b)) = (open[i].as_ref(), open[j].as_ref()) else { return };
        if a.area != b.area
            && let Some(doorway) = join(world, a, b)
        {
            found.push(doorway);
            open[i] = None;
            open[j] = None;
        }
    };
    let mut places: BTreeMap<(AreaId, SideRef), usize> = BTreeMap::new();
    let mut by_door: BTreeMap<DoorId, Vec<usize>> = BTreeMap::new();
    for (i, side) in open.iter().enumerate() {
        let Some(side) = side else { continue };
        places.entry((side.area, side.side.clone())).or_insert(i);
        if let Some(mount) = &side.mount {
            by_door.entry(mount.door).or_default().push(i);
        }
    }
    for link in world.maps.get(&map).map_or(&[][..], |m| &m.links) {
        let place = |area, side: &SideRef| places.get(&(area, side.clone())).copied();
        if let (Some(i), Some(j)) =
            (place(link.area, &link.side), place(link.to_area, &link.to_side))
        {
            pair(&mut open, i, j);
        }
    }
    for sides in by_door.values() {
        for (k, &i) in sides.iter().enumerate() {
            sides[k + 1..].iter().for_each(|&j| pair(&mut open, i, j));
        }
    }
    let boxes: Vec<Bounds> = open
        .iter()
        .map(|o| o.as_ref().map_or(Bounds::EMPTY, |o| Bounds::of([o.start, o.end])))
        .map(|b| if b.min.x > b.max.x { b } else { b.grown(THICKEST_WALL + 1.0) })
        .collect();
    let (buckets, mut near) = (Buckets::of(&boxes), Vec::new());
    for i in 0..open.len() {
        buckets.meeting(&boxes[i], &mut near);
        for &j in near.iter().filter(|&&j| j as usize > i) {
            let j = j as usize;
            let faces = open[i].as_ref().zip(open[j].as_ref());
            if faces.is_some_and(|(a, b)| face_each_other(a, b)) {
                pair(&mut open, i, j);
            }
        }
    }
    found.sort_by(|a, b| (a.areas, &a.sides).cmp(&(b.areas, &b.sides)));
    found
}

fn open_sides(world: &World, area: &PlacedArea) -> Vec<OpenSide> {
    let model = &world.areas[&area.id];
    let mut sides = Vec::new();
    for (item, prism) in model.items.iter().zip(&area.prisms) {
        for (i, side) in prism.sides.iter().enumerate() {
            if side.permeability == Permeability::Impermeable {
                continue;
            }
            let corners = &prism.polygon.corners;
            let id = world.orthoframe_of(item).base[i].id.clone();
            let reference = SideRef { item: item.id.clone(), side: id };
            let mount =
                model.doors.iter().find(|m| m.item == reference.item && m.side == reference.side);
            sides.push(OpenSide {
                area: area.id,
                start: corners[i],
                end: corners[(i + 1) % corners.len()],
                floor: prism.bottom,
                permeability: side.permeability,
                mount: mount.cloned(),
                side: reference,
            });
        }
    }
    sides
}

/// Walls are no thicker than this where the Map has no link to tell that two sides belong together, in cm.
const THICKEST_WALL: f64 = 60.0;

/// Equal stretches of two parallel lines that look at each other through at most a wall.
fn face_each_other(a: &OpenSide, b: &OpenSide) -> bool {
    let (Some(u), Some(v)) =
        ((a.end - a.start).try_normalize(0.0), (b.end - b.start).try_normalize(0.0))
    else {
        return false;
    };
    let (near, far) = (b.end - a.start, b.start - a.end);
    u.dot(&v) < -0.999
        && near.dot(&u).abs() < 1.0
        && far.dot(&u).abs() < 1.0
        && (-0.1..=THICKEST_WALL).contains(&Vector::new(u.y, -u.x).dot(&near))
}

/// The doorway between two sides; none when they do not overlap.
fn join(world: &World, a: &OpenSide, b: &OpenSide) -> Option<Doorway> {
    // The first Area is the one that mounts the door first.
    let rank = |s: &OpenSide| (s.mount.is_none(), s.area);
    let (a, b) = if rank(b) < rank(a) { (b, a) } else { (a, b) };
    let along = (a.end - a.start).try_normalize(0.0)?;
    let out = Vector::new(along.y, -along.x);
    let (near, far) = (b.end - a.start, b.start - a.start);
    let span = (near.dot(&along).max(0.0), far.dot(&along).min((a.end - a.start).norm()));
    if span.1 - span.0 < 1e-3 {
        return None;
    }
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
    Some(Doorway {
        areas: [a.area, b.area],
        sides: [a.side.clone(), b.side.clone()],
        door,
        permeability: a.permeability.max(b.permeability),
        opens_to,
        gap: ((near + far).dot(&out) / 2.0).max(0.0),
        rise: b.floor - a.floor,
        origin: a.start,
        along,
        span,
    })
}
