//! What stands around a dead zone, and how narrow it is there.

use crate::map::Permeability;
use crate::units::Point;

use super::apart::distance_within;
use super::blocker::Blocker;
use super::floor::FragmentFloor;
use super::{Bounds, Polygon, Region, nearest_on_segment};

/// What makes a dead zone one.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// What stands around it.
    pub owners: Vec<Blocker>,
    /// The narrowest gap between two of them that is too narrow for the robot, in cm.
    pub gap: Option<f64>,
}

/// What stands around a dead zone, for a robot that keeps `reach` from everything.
pub(super) fn surroundings(floor: &FragmentFloor, zone: &Region, reach: f64) -> Surroundings {
    let at = zone.outer.bounds();
    let beside = |blocker: Blocker, polygon: &Polygon| {
        let bounds = polygon.bounds().grown(TOUCH);
        let stands = bounds.meets(&at) && distance_within(polygon, &zone.outer, TOUCH).is_some();
        stands.then(|| (blocker, polygon.clone(), bounds))
    };
    let things = floor.obstacles().iter();
    let mut near: Vec<(Blocker, Polygon, Bounds)> =
        things.filter_map(|o| beside(o.blocker, &o.polygon)).collect();
    let mut jambs = floor.walls.clone();
    for side in floor.edging.sides.iter().filter(|s| s.permeability != Permeability::Permeable) {
        let blocker = Blocker::Wall { area: floor.area, item: side.item, side: side.side };
        near.extend(beside(blocker, &Polygon::new(vec![side.start, side.end])));
        let is_off = |q: Point| (nearest_on_segment(q, side.start, side.end) - q).norm() > TOUCH;
        jambs.retain(|&(a, b)| is_off(a) || is_off(b));
    }
    // What is left of the walls belongs to no side: in a doorway.
    let sides = near.len();
    near.extend(
        jambs
            .into_iter()
            .filter_map(|(a, b)| beside(Blocker::jamb(floor.area), &Polygon::new(vec![a, b]))),
    );
    let mut gap: Option<f64> = None;
    for (k, (a, p, own)) in near.iter().enumerate() {
        for (b, q, other) in &near[k + 1..] {
            let widest = gap.unwrap_or(2.0 * reach);
            let is_same = a == b && k < sides;
            if is_same || !own.grown(widest).meets(other) {
                continue;
            }
            if let Some(d) = distance_within(p, q, widest)
                && d > TOUCH
                && d < widest
            {
                gap = Some(d);
            }
        }
    }
    let mut owners: Vec<Blocker> = near.into_iter().map(|n| n.0).collect();
    owners.sort_unstable();
    owners.dedup();
    Surroundings { owners, gap }
}

/// Things within this distance of a zone stand around it, in cm.
const TOUCH: f64 = 0.05;
