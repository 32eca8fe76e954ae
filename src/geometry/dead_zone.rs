//! Dead zones: floor that the robot covers from no place where it fits.

use std::f64::consts::PI;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use super::coverage::RIM;
use super::grid::{Contour, Grid, Shapes, overlay, positive};
use super::offset::{grow, shrink};
use super::{Polygon, Region};

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
