//! The sides of Areas – walls, and openings in them – and how near things are to them.
//!
//! Invariant: a side between two Orthoframes of one Area is neither wall nor opening.

use std::collections::BTreeMap;

use crate::geometry::Polygon;
use crate::geometry::contact::{Footprint, bounds_distance, extent, gap};
use crate::map::{Permeability, World};
use crate::units::{AreaId, Frame, MapId, Point, Vector};

use super::super::body::Body;
use super::super::openings::joins_own_items;
use super::rooms::Room;
use super::{Measurements, cm, hundredths, tenths};

/// The contact tests want an area: a side is taken for a thread of twice this width, cm.
const THREAD: f64 = 0.05;
/// Ends of neighbouring sides may lie a grid step apart, cm.
const APART: f64 = 2.0;

/// A side of an Area, in the frame of its Map.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Side {
    pub(crate) area: AreaId,
    /// Places of the item in its Area and of the side in that item's base.
    pub(crate) item: usize,
    pub(crate) side: usize,
    pub(crate) ends: (Point, Point),
    thread: Footprint,
}

/// All sides that bound the Areas of the Maps.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Borders {
    walls: BTreeMap<AreaId, Vec<Side>>,
    /// Doors, passages and windows that can be gone through, in the order of Areas, items and sides.
    pub(crate) open: Vec<Side>,
    open_of: BTreeMap<AreaId, Vec<usize>>,
    /// Of each Area its middle, and its narrower side, cm.
    middles: BTreeMap<AreaId, (Point, f64)>,
}

pub(super) fn borders(
    world: &World,
    rooms: &BTreeMap<AreaId, Room>,
    placements: &BTreeMap<AreaId, (MapId, Frame)>,
) -> Borders {
    let mut found = Borders::default();
    for area in world.areas.values() {
        let (Some(room), Some((_, frame))) = (rooms.get(&area.id), placements.get(&area.id)) else {
            continue;
        };
        for (item_at, item) in area.items.iter().enumerate() {
            let place = frame.compose(&item.frame);
            for (side_at, vector) in world.orthoframe_of(item).base.iter().enumerate() {
                let ends = (place.apply(vector.start), place.apply(vector.end));
                if joins_own_items(room, ends) {
                    continue;
                }
                let side = Side {
                    area: area.id,
                    item: item_at,
                    side: side_at,
                    ends,
                    thread: thread(ends).unwrap_or_else(|| {
                        Footprint::new(Polygon::new(vec![ends.0, ends.1, ends.0]))
                    }),
                };
                if vector.permeability == Permeability::Impermeable {
                    found.walls.entry(area.id).or_default().push(side);
                } else {
                    found.open_of.entry(area.id).or_default().push(found.open.len());
                    found.open.push(side);
                }
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
            found.middles.insert(area.id, (part.interior_point(), narrow));
        }
    }
    found
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

    /// Openings near to a body, by their places among all, with their distances.
    pub(super) fn near_openings(&self, body: &Body) -> Vec<(usize, i64)> {
        let Some(grid) = self.room_grid.get(&body.map) else { return Vec::new() };
        let mut rooms = Vec::new();
        grid.near(&body.bounds.grown(cm(self.reach.opening)), &mut rooms);
        let sides = rooms.iter().filter_map(|room| self.borders.open_of.get(room)).flatten();
        near(body, sides.map(|&n| (n, &self.borders.open[n])), self.reach.opening)
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

fn near<'s>(
    body: &Body,
    sides: impl Iterator<Item = (usize, &'s Side)>,
    reach: i64,
) -> Vec<(usize, i64)> {
    let within = |(n, side): (usize, &Side)| {
        if bounds_distance(&body.bounds, &side.thread.bounds) > cm(reach) {
            return None;
        }
        Some((n, tenths(away(body, side)?))).filter(|(_, away)| *away <= reach)
    };
    sides.filter_map(within).collect()
}
