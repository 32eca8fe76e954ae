//! How doors stand, by the opening that explains the beams best.
//!
//! For each door in reach all openings from shut to wide are tried, in steps: the leaves that an opening would put there
//! are held against the beams that can tell openings apart. An opening is possible while it explains nearly as much as
//! the best one; what is said of the door is what all possible ones have in common.

use std::collections::BTreeMap;

use nalgebra::{Isometry2, Point2, Vector2};

use super::slack;
use crate::chart::{Chart, Line};
use crate::geometry::{Blocker, FloorPlan, SeenFace};
use crate::map::{DoorKind, DoorState, DoorStatus, World};
use crate::units::{DoorId, Gather as _};
use crate::vectors::scan::Sensor;

/// Openings are tried in steps of so many per cent.
const STEP: usize = 5;
/// What a beam costs that ended before a leaf, and one that went through it: the former may have met something else.
const BEFORE: f64 = 0.7;
const THROUGH: f64 = 1.5;
/// An opening is possible that costs so much more than the best.
const MARGIN: f64 = 2.5;
/// What is left of older costs after each new look.
const KEPT: f64 = 0.7;
/// Beams of such a look; fewer leave more.
const WHOLE_LOOK: f64 = 10.0;
/// Openings up to this look as shut: a leaf turned by so little stands as near as a pose is known.
const AJAR: f64 = 10.0;
/// A door farther than this is not judged, in cm: two beams pass its leaf.
const FARTHEST: f64 = 800.0;

/// The openings, in per cent of the most, of which all fit what was seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoorSeen {
    pub least: f64,
    pub most: f64,
    /// Of them, the one that fits best.
    pub best: f64,
    /// 0..=1 that it is one of them.
    pub sure: f64,
}

impl DoorSeen {
    /// The door's state by this: as it was where that is possible, none where it may be shut or open.
    #[must_use]
    pub fn state(&self, mapped: DoorState) -> Option<DoorState> {
        if self.most <= AJAR {
            // That it is locked is not seen.
            let locked = mapped.status == DoorStatus::Locked;
            return Some(if locked { mapped } else { DoorState::CLOSED });
        }
        if self.least <= 0.0 {
            return None;
        }
        let is_possible = mapped.status == DoorStatus::Open
            && (self.least - STEP as f64..=self.most + STEP as f64).contains(&mapped.opening);
        let opening = if is_possible { mapped.opening } else { self.best };
        Some(DoorState { status: DoorStatus::Open, opening })
    }
}

/// A door in a doorway, with the leaves of all openings.
struct Door {
    id: DoorId,
    middle: Point2<f64>,
    reach: f64,
    /// By opening.
    leaves: Vec<Vec<Line>>,
    costs: Vec<f64>,
    /// Beams that told openings apart, faded as the costs are.
    beams: f64,
}

pub(super) struct Doors<'w> {
    world: &'w World,
    doors: Vec<Door>,
}

fn openings() -> impl Iterator<Item = f64> {
    (0..=100).step_by(STEP).map(|percent| percent as f64)
}

impl<'w> Doors<'w> {
    pub(super) fn forget(&mut self, id: DoorId) {
        for door in self.doors.iter_mut().filter(|door| door.id == id) {
            door.costs.fill(0.0);
            door.beams = 0.0;
        }
    }

    pub(super) fn of(world: &'w World, plan: &FloorPlan, height: f64) -> Self {
        let mut doors = Vec::new();
        for doorway in plan.doorways() {
            let Some(door) = doorway.door.and_then(|id| world.doors.get(&id)) else { continue };
            let floor = doorway.sides.first().map_or(0.0, |side| side.floor);
            let is_over = door.height.get() > 0.0 && door.height.get() <= height - floor;
            if door.kind == DoorKind::Passage || door.leaves.is_empty() || is_over {
                continue;
            }
            let hung = doorway.leaves(door);
            let lines = |opening: f64| {
                let status = if opening > 0.0 { DoorStatus::Open } else { DoorStatus::Closed };
                let leaves = hung.obstacles(DoorState { status, opening });
                let line = |(leaf, polygon): (usize, crate::geometry::Polygon)| {
                    let face =
                        SeenFace { blocker: Blocker::DoorLeaf { door: door.id, leaf }, side: None };
                    let edges: Vec<_> = polygon.edges().collect();
                    edges.into_iter().map(move |(start, end)| Line {
                        face: Some(face),
                        ..Line::between(start, end)
                    })
                };
                leaves.into_iter().enumerate().flat_map(line).collect::<Vec<_>>()
            };
            let leaves: Vec<Vec<Line>> = openings().map(lines).collect();
            let middle = doorway.middle();
            let ends = leaves.iter().flatten().flat_map(|line| [line.start, line.end]);
            let reach = ends.map(|p| (p - middle).norm()).fold(0.0, f64::max);
            let costs = vec![0.0; leaves.len()];
            doors.push(Door { id: door.id, middle, reach, leaves, costs, beams: 0.0 });
        }
        Self { world, doors }
    }

    /// Takes in what a scan says of the doors in its reach, with all else that stands on `chart`.
    pub(super) fn look(
        &mut self,
        chart: &Chart,
        sensor: &Sensor,
        ranges: &[f64],
        pose: &Isometry2<f64>,
    ) {
        for door in &mut self.doors {
            let way = (door.middle - Point2::from(pose.translation.vector)).norm();
            if way - door.reach <= FARTHEST {
                door.look(chart, sensor, ranges, pose);
            }
        }
    }

    /// The leaves of the doors in reach of a pose as they are seen to stand, else as they are mapped.
    pub(super) fn leaves_near(&self, pose: &Isometry2<f64>, reach: f64) -> Vec<Line> {
        let at = Point2::from(pose.translation.vector);
        let near = self.doors.iter().filter(|door| (door.middle - at).norm() <= reach + door.reach);
        near.flat_map(|door| self.leaves_of(door)).copied().collect()
    }

    /// Whether a point is of a leaf as the doors are seen to stand, else as they are mapped.
    pub(super) fn holds(&self, p: Point2<f64>, slack: f64) -> bool {
        let near = self.doors.iter().filter(|door| (door.middle - p).norm() <= door.reach + slack);
        let mut leaves = near.flat_map(|door| self.leaves_of(door));
        leaves.any(|line| (line.nearest(p) - p).norm() <= slack)
    }

    fn leaves_of<'d>(&self, door: &'d Door) -> &'d [Line] {
        let mapped = self.world.doors.get(&door.id).map(|door| door.state);
        let opening = match (door.seen(), mapped) {
            (Some(seen), Some(mapped)) => seen.state(mapped).unwrap_or(mapped).opening,
            (Some(seen), None) => seen.best,
            (None, Some(mapped)) => mapped.opening,
            (None, None) => 0.0,
        };
        let number = (opening / STEP as f64).round() as usize;
        &door.leaves[number.min(door.leaves.len() - 1)]
    }

    /// Whether a point may be of a leaf of which it is not known how it stands.
    pub(super) fn may_hold(&self, p: Point2<f64>, slack: f64) -> bool {
        self.doors.iter().any(|door| {
            (door.middle - p).norm() <= door.reach + slack
                && door.leaves.iter().zip(&door.costs).any(|(leaves, cost)| {
                    *cost <= door.least() + MARGIN
                        && leaves.iter().any(|line| (line.nearest(p) - p).norm() <= slack)
                })
        })
    }

    /// What can be said; nothing of a door of which any opening fits.
    pub(super) fn seen(&self) -> BTreeMap<DoorId, DoorSeen> {
        self.doors.iter().filter_map(|door| Some((door.id, door.seen()?))).gather()
    }
}

impl Door {
    fn least(&self) -> f64 {
        self.costs.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn seen(&self) -> Option<DoorSeen> {
        if self.beams < 3.0 {
            return None;
        }
        let least = self.least();
        let fit: Vec<f64> = openings()
            .zip(&self.costs)
            .filter(|(_, cost)| **cost <= least + MARGIN)
            .map(|(opening, _)| opening)
            .collect();
        let (first, last) = (*fit.first()?, *fit.last()?);
        if first <= 0.0 && last > AJAR {
            return None;
        }
        // Of those that fit equally well, the one in the middle.
        let equal: Vec<f64> = openings()
            .zip(&self.costs)
            .filter(|(_, cost)| **cost <= least + 1e-6)
            .map(|(opening, _)| opening)
            .collect();
        // The best of what is not possible: how much more it costs is how sure this is.
        let other = openings().zip(&self.costs).filter(|(opening, _)| !fit.contains(opening));
        let other = other.map(|(_, cost)| *cost).fold(f64::INFINITY, f64::min);
        let sure = if other.is_finite() { 1.0 - 0.5_f64.powf((other - least) / 2.0) } else { 0.5 };
        Some(DoorSeen { least: first, most: last, best: equal[equal.len() / 2], sure })
    }

    fn look(&mut self, chart: &Chart, sensor: &Sensor, ranges: &[f64], pose: &Isometry2<f64>) {
        let at = Point2::from(pose.translation.vector);
        let to = pose.inverse_transform_point(&self.middle).coords;
        let bearing = to.y.atan2(to.x);
        let half = if to.norm() > self.reach { (self.reach / to.norm()).asin() } else { 4.0 };
        let mut told = vec![0.0; self.leaves.len()];
        let mut beams = 0.0;
        for (beam, (&range, u)) in ranges.iter().zip(sensor.directions()).enumerate() {
            let off = Vector2::new(bearing.cos(), bearing.sin());
            let turn = off.perp(u).atan2(off.dot(u));
            if !sensor.returned(range) || turn.abs() > half + 0.02 {
                continue;
            }
            let slack = slack(range);
            let (behind, _) = chart.cast(pose, sensor.bearing(beam), range + 4.0 * slack);
            let direction = pose.rotation * u;
            let end = at + direction * range;
            let cost = |leaves: &Vec<Line>| {
                let leaf = leaves.iter().filter_map(|line| meets(at, direction, line));
                let leaf = leaf.fold(f64::INFINITY, f64::min);
                // Near its tip a leaf may be met or missed by a hair.
                let is_at = leaves.iter().any(|line| (line.nearest(end) - end).norm() <= slack);
                if is_at || (range - leaf.min(behind)).abs() <= slack {
                    0.0
                } else if range > leaf {
                    THROUGH
                } else if range < behind {
                    BEFORE
                } else {
                    0.0
                }
            };
            let costs: Vec<f64> = self.leaves.iter().map(cost).collect();
            let low = costs.iter().copied().fold(f64::INFINITY, f64::min);
            if costs.iter().all(|cost| (cost - low).abs() < 1e-9) {
                continue;
            }
            beams += 1.0;
            told.iter_mut().zip(&costs).for_each(|(sum, cost)| *sum += cost - low);
        }
        if beams > 0.0 {
            // A glance from afar takes little from what was seen well.
            let kept = KEPT.powf((beams / WHOLE_LOOK).min(1.0));
            self.beams = kept.mul_add(self.beams, beams);
            for (cost, new) in self.costs.iter_mut().zip(told) {
                *cost = kept.mul_add(*cost, new);
            }
        }
    }
}

/// How far along a beam a line lies.
fn meets(from: Point2<f64>, direction: Vector2<f64>, line: &Line) -> Option<f64> {
    let (v, to) = (line.end - line.start, line.start - from);
    let sine = direction.perp(&v);
    if sine.abs() < 1e-12 {
        return None;
    }
    let (along, share) = (to.perp(&v) / sine, to.perp(&direction) / sine);
    ((0.0..=1.0).contains(&share) && along > 0.0).then_some(along)
}
