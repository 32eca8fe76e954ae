//! Dead zones: floor that the robot covers from no place where it fits, what stands around it, and how narrow it is.

use std::f64::consts::PI;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::map::Permeability;
use crate::units::Point;

use super::apart::distance_within;
use super::blocker::Blocker;
use super::coverage::RIM;
use super::floor::FragmentFloor;
use super::grid::{Contour, Grid, Shapes, overlay, positive};
use super::offset::{grow, shrink};
use super::{Bounds, Polygon, Region, nearest_on_segment};

/// What makes a dead zone one.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// What stands around it.
    pub owners: Vec<Blocker>,
    /// The narrowest gap between two of them that is too narrow for the robot, in cm.
    pub gap: Option<f64>,
}

/// The dead zones among pieces of floor that the robot does not cover.
pub(super) fn dead_zones(grid: &Grid, dead: Shapes) -> Shapes {
    let rim = |r: &Region| {
        r.contours().flat_map(Polygon::edges).map(|(a, b)| (b - a).norm()).sum::<f64>()
    };
    let zone = |shape: Vec<Contour>| {
        let shape = vec![shape];
        let regions = grid.regions(&shape);
        let area: f64 = regions.iter().map(Region::area).sum();
        let rim: f64 = regions.iter().map(rim).sum();
        if area > RIM * f64::max(rim, 1.0) {
            shape
        } else if area > PI * LEAST * LEAST {
            without_rims(grid, &regions)
        } else {
            Shapes::new()
        }
    };
    dead.into_iter().flat_map(zone).collect()
}

/// A disc of this radius, in cm, makes a zone of what holds it, however much hangs on it.
const LEAST: f64 = 0.03;

/// What is left of a piece when only places count that hold a small disc. A zone may hang on the slivers along a
/// long wall, which are no part of it.
fn without_rims(grid: &Grid, piece: &[Region]) -> Shapes {
    let core = grid.regions(&positive(&shrink(grid, piece, LEAST)));
    let covered = grow(grid, &core, LEAST, piece);
    let own: Vec<Contour> =
        piece.iter().flat_map(Region::contours).map(|c| grid.contour(c)).collect();
    overlay(&covered, &own, OverlayRule::Intersect, FillRule::Positive)
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
        jambs.into_iter().filter_map(|(a, b)| beside(jamb(floor), &Polygon::new(vec![a, b]))),
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

/// Jambs have no side of their own: they belong to the wall.
pub(super) fn jamb(floor: &FragmentFloor) -> Blocker {
    Blocker::Wall { area: floor.area, item: 0, side: 0 }
}

/// Things within this distance of a zone stand around it, in cm.
const TOUCH: f64 = 0.05;
