//! The sides of Areas – walls, and openings in them – and how near things are to them.
//!
//! Invariant: a side between two Orthoframes of one Area is neither wall nor opening.

use std::collections::BTreeMap;

use crate::geometry::contact::{Footprint, bounds_distance, extent, gap};
use crate::geometry::{Polygon, outward_normal};
use crate::map::{Permeability, SideRef, World};
use crate::units::{AreaId, Frame, Point, Vector};

use super::super::body::Body;
use super::rooms::Room;
use super::{Measurements, cm, hundredths, tenths};

/// The contact tests want an area: a side is taken for a thread of twice this width, cm.
const THREAD: f64 = 0.05;
/// Ends of neighbouring sides may lie a grid step apart, cm.
const APART: f64 = 2.0;

/// A side of an Area, in the frame of its Map.
#[derive(Debug, Clone, PartialEq)]
struct Side {
    side: SideRef,
    ends: (Point, Point),
    thread: Footprint,
}

/// All sides that bound the Areas of the Maps.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Borders {
    walls: BTreeMap<AreaId, Vec<Side>>,
    /// Doors, passages and windows that can be gone through, in the order of items and sides.
    open: BTreeMap<AreaId, Vec<Side>>,
    /// Of each Area its middle, and its narrower side, cm.
    middles: BTreeMap<AreaId, (Point, f64)>,
}

impl Borders {
    /// Looks for the sides of an Area; it must have none yet.
    pub(super) fn enter(&mut self, world: &World, room: &Room, frame: &Frame) {
        let Some(area) = world.areas.get(&room.id) else { return };
        for item in &area.items {
            let place = frame.compose(&item.frame);
            for vector in &world.orthoframe_of(item).base {
                let ends = (place.apply(vector.start), place.apply(vector.end));
                if joins_own_items(room, ends) {
                    continue;
                }
                let side = Side {
                    side: SideRef { item: item.id.clone(), side: vector.id.clone() },
                    ends,
                    thread: thread(ends).unwrap_or_else(|| {
                        Footprint::new(Polygon::new(vec![ends.0, ends.1, ends.0]))
                    }),
                };
                let is_wall = vector.permeability == Permeability::Impermeable;
                let sides = if is_wall { &mut self.walls } else { &mut self.open };
                sides.entry(area.id).or_default().push(side);
            }
        }
        let corners = || room.parts.iter().flat_map(|(f, ..)| f.polygon.corners.iter().copied());
        let corners: Vec<Point> = corners().collect();
        let across = |way: Vector| {
            let (low, high) = extent(&corners, frame.turn(way));
            high - low
        };
        let narrow = across(Vector::new(1.0, 0.0)).min(across(Vector::new(0.0, 1.0)));
        let largest = room.parts.iter().max_by(|a, b| a.0.area.total_cmp(&b.0.area));
        if let Some((part, ..)) = largest {
            self.middles.insert(area.id, (part.interior_point(), narrow));
        }
    }

    pub(super) fn forget(&mut self, area: AreaId) {
        self.walls.remove(&area);
        self.open.remove(&area);
        self.middles.remove(&area);
    }

    /// An open side by its Area and its place among the open sides of that.
    pub(crate) fn open_side(&self, (area, place): (AreaId, usize)) -> Option<&SideRef> {
        self.open.get(&area)?.get(place).map(|side| &side.side)
    }
}

/// An open side between two items of one Area leads nowhere else.
fn joins_own_items(room: &Room, (a, b): (Point, Point)) -> bool {
    /// A step this long beyond a border stands on the floor behind it, in cm.
    const FOOTHOLD: f64 = 0.5;
    let middle = nalgebra::center(&a, &b);
    outward_normal(a, b).is_none_or(|n| {
        let outside = middle + n * FOOTHOLD;
        room.parts.iter().any(|(f, _, _)| f.contains(outside))
    })
}

fn thread((from, to): (Point, Point)) -> Option<Footprint> {
    let along = (to - from).try_normalize(1e-9)?;
    let side = Vector::new(along.y, -along.x) * THREAD;
    Some(Footprint::new(Polygon::new(vec![from + side, to + side, to - side, from - side])))
}

/// Between an outline and a side, in the plan, cm.
fn away(body: &Body, side: &Side) -> Option<f64> {
    let gaps = body.outline.iter().map(|f| gap(f, &side.thread).distance);
    let least = gaps.reduce(f64::min)?;
    Some(if least > 0.0 { least + THREAD } else { 0.0 })
}

impl Measurements {
    /// Solid sides of an Area that bound it, in the Map's frame.
    pub fn walls(&self, area: AreaId) -> impl Iterator<Item = (Point, Point)> {
        self.borders.walls.get(&area).into_iter().flatten().map(|side| side.ends)
    }

    /// Walls of an Area near to a body, by their places among its walls, with their distances.
    pub(super) fn near_walls(&self, body: &Body, area: AreaId) -> Vec<(usize, i64)> {
        let walls = self.borders.walls.get(&area).into_iter().flatten();
        near(body, walls.enumerate(), self.reach.edge)
    }

    /// Open sides near to a body, by their Areas and their places among the open sides of these, with their distances.
    pub(super) fn near_openings(&self, body: &Body) -> Vec<((AreaId, usize), i64)> {
        let Some(grid) = self.room_grid.get(&body.map) else { return Vec::new() };
        let mut rooms = Vec::new();
        grid.near(&body.bounds.grown(cm(self.reach.opening)), &mut rooms);
        let open = rooms.iter().filter_map(|room| Some((*room, self.borders.open.get(room)?)));
        let sides =
            open.flat_map(|(room, sides)| (0..).zip(sides).map(move |(n, s)| ((room, n), s)));
        near(body, sides, self.reach.opening)
    }

    /// How far a body is from the middle of an Area, where that is nearer than its walls can be.
    pub(super) fn to_middle(&self, body: &Body, area: AreaId) -> Option<i64> {
        let (middle, narrow) = self.borders.middles.get(&area)?;
        let away = body.outline.iter().map(|f| f.distance_to(*middle)).reduce(f64::min)?;
        (away <= narrow / 2.0).then(|| tenths(away))
    }

    /// The narrower side of an Area along its own axes.
    pub(crate) fn narrow_side(&self, area: AreaId) -> Option<i64> {
        self.borders.middles.get(&area).map(|(_, narrow)| tenths(*narrow))
    }

    /// Where two walls of an Area meet: their places among its walls, and how far the second turns from the first,
    /// inwards positive.
    pub(crate) fn corners(&self, area: AreaId) -> Vec<(usize, usize, i64)> {
        let walls = self.borders.walls.get(&area).map_or(&[][..], Vec::as_slice);
        let way = |side: &Side| (side.ends.1 - side.ends.0).try_normalize(1e-9);
        let mut found = Vec::new();
        for (n, first) in walls.iter().enumerate() {
            for (m, second) in walls.iter().enumerate() {
                let meets = n != m && (second.ends.0 - first.ends.1).norm() <= APART;
                if let (true, Some(u), Some(v)) = (meets, way(first), way(second)) {
                    let turn = u.perp(&v).atan2(u.dot(&v)).to_degrees();
                    found.push((n, m, hundredths(turn)));
                }
            }
        }
        found
    }
}

fn near<'s, N>(
    body: &Body,
    sides: impl Iterator<Item = (N, &'s Side)>,
    reach: i64,
) -> Vec<(N, i64)> {
    let within = |(n, side): (N, &Side)| {
        if bounds_distance(&body.bounds, &side.thread.bounds) > cm(reach) {
            return None;
        }
        Some((n, tenths(away(body, side)?))).filter(|(_, away)| *away <= reach)
    };
    sides.filter_map(within).collect()
}
