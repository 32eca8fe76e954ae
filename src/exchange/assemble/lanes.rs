//! Lanes: ways that the file says are driven, held against the rooms and openings that came of it.
//!
//! A lane makes nothing. One that leaves all rooms, or leads through a wall where no opening is, tells that the drawing
//! and the lanes disagree: the report says where.

use crate::map::plane::{bounds, edges, meeting};
use crate::report::{What, Why};
use crate::units::{Point, Vector};
use crate::{Lane, Level};

use super::build::{Maker, Storey};
use super::index::Index;
use super::wall::SideUse;

/// A lane may begin so far from the floor: on a threshold, under a wall drawn askew; cm.
const REACH: f64 = 30.0;
/// A lane that touches a wall with its end only does not cross it, cm.
const TOUCH: f64 = 5.0;

impl Maker<'_> {
    /// Counts the lanes that run over floor and through openings, and tells of the others.
    pub(super) fn lanes(&mut self, level: &Level, storey: &Storey) {
        if level.lanes.is_empty() {
            return;
        }
        self.report.found(What::Lane, level.lanes.len());
        let index = Index::of(&storey.floors);
        let walls: Vec<Vec<(Point, Point)>> = storey
            .placed
            .walls
            .iter()
            .map(|walls| {
                let rings = walls.iter().flat_map(super::wall::Walls::outline);
                rings.flat_map(|ring| solid(&ring)).collect()
            })
            .collect();
        for lane in &level.lanes {
            let [a, b] = lane.ends;
            let margin = Vector::new(REACH, REACH);
            let (low, high) = bounds([a, b]);
            let near = index.near_box((low - margin, high + margin));
            let is_on_floor = |p: Point| {
                let floors = near.iter().filter_map(|&r| storey.floors[r].as_ref());
                floors.into_iter().any(|f| f.contains(p) || f.border_distance(p) <= REACH)
            };
            if !is_on_floor(a) || !is_on_floor(b) {
                self.report.noted(What::Lane, &lane.source, Why::LaneOffFloor);
                continue;
            }
            let crossed: Vec<&str> = near
                .iter()
                .filter(|&&r| walls[r].iter().any(|&wall| crosses(lane, wall)))
                .map(|&r| level.rooms[r].source.as_str())
                .collect();
            if crossed.is_empty() {
                self.report.taken(What::Lane, 1);
            } else {
                let rooms = crossed.join("», «");
                self.report.noted(What::Lane, &lane.source, Why::LaneThroughWall { rooms });
            }
        }
    }
}

/// The sides of a ring on which no opening stands.
fn solid(ring: &[(Point, SideUse)]) -> Vec<(Point, Point)> {
    let corners: Vec<Point> = ring.iter().map(|&(p, _)| p).collect();
    let sides = edges(&corners).zip(ring).filter(|(_, (_, used))| *used == SideUse::Wall);
    sides.map(|(side, _)| side).collect()
}

fn crosses(lane: &Lane, wall: (Point, Point)) -> bool {
    let [a, b] = lane.ends;
    meeting((a, b), wall).is_some_and(|p| (p - a).norm() > TOUCH && (p - b).norm() > TOUCH)
}
