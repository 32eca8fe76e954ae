//! What is seen and not mapped: returns in cells, emptied again by beams that go through them, and what hangs together.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Isometry2, Matrix2, Point2, SymmetricEigen, Vector2};

use super::slack;
use crate::geometry::{Polygon, convex_hull};
use crate::units::Gather as _;
use crate::vectors::scan::Sensor;

/// Side of a cell, in cm.
const CELL: f64 = 5.0;
/// What a return and a beam that goes through add to a cell, and the bounds of what is added up.
const RETURN: f64 = 1.0;
const THROUGH: f64 = -0.4;
const BOUNDS: (f64, f64) = (-1.0, 4.0);
/// Cells that are no farther apart than so many steps hang together.
const STEPS: i32 = 4;
/// Returns that make an obstacle; fewer may be noise.
const FEWEST: usize = 3;
/// What is no larger across, in cm, is one convex thing.
const ONE_THING: f64 = 60.0;

/// Something that is seen and not mapped, in the Map's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Unmapped {
    /// Convex, counter-clockwise; together they cover all returns.
    pub pieces: Vec<Polygon>,
    /// Returns from it.
    pub returns: usize,
    /// Scans that saw a place of it, in the median of its places: of what walks by few see the same.
    pub looks: usize,
    /// 0..=1 that it is there.
    pub sure: f64,
    middle: Point2<f64>,
}

impl Unmapped {
    /// Of its returns.
    #[must_use]
    pub fn middle(&self) -> Point2<f64> {
        self.middle
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    sum: Vector2<f64>,
    returns: usize,
    weight: f64,
    /// Scans with returns from it, and the number of the last.
    looks: usize,
    last: usize,
}

/// See the head of this file.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells {
    cells: BTreeMap<(i32, i32), Cell>,
    /// Scans so far.
    count: usize,
}

impl Cells {
    /// Takes in the beams of a scan whose ends lie on nothing that is mapped; all others may empty cells.
    pub(super) fn take_in(
        &mut self,
        sensor: &Sensor,
        ranges: &[f64],
        pose: &Isometry2<f64>,
        extra: &[(usize, Point2<f64>)],
    ) {
        let first = sensor.bearing(0);
        for cell in self.cells.values_mut() {
            let at = cell.sum / cell.returns as f64;
            let own = pose.inverse_transform_point(&Point2::from(at)).coords;
            let turn = (own.y.atan2(own.x) - first).rem_euclid(std::f64::consts::TAU);
            let beam = (turn / sensor.step()).round() as usize;
            let Some(&range) = ranges.get(beam).filter(|_| beam < sensor.count()) else { continue };
            if sensor.returned(range) && range > own.norm() + slack(own.norm()) {
                cell.weight = (cell.weight + THROUGH).max(BOUNDS.0);
            }
        }
        self.cells.retain(|_, cell| cell.weight > BOUNDS.0);
        self.count += 1;
        for (_, end) in extra {
            let place = ((end.x / CELL).floor(), (end.y / CELL).floor());
            let cell = self.cells.entry((place.0 as i32, place.1 as i32)).or_default();
            cell.sum += end.coords;
            cell.returns += 1;
            cell.looks += usize::from(cell.last != self.count);
            cell.last = self.count;
            cell.weight = (cell.weight + RETURN).min(BOUNDS.1);
        }
    }

    /// Where something is.
    pub(super) fn points(&self) -> Vec<Point2<f64>> {
        self.live().map(|(_, cell)| Point2::from(cell.sum / cell.returns as f64)).collect()
    }

    fn live(&self) -> impl Iterator<Item = (&(i32, i32), &Cell)> {
        self.cells.iter().filter(|(_, cell)| cell.weight > 0.0)
    }

    /// Empties the cells at these places.
    pub(super) fn forget(&mut self, at: impl Fn(Point2<f64>) -> bool) {
        self.cells.retain(|_, cell| !at(Point2::from(cell.sum / cell.returns as f64)));
    }

    /// What hangs together.
    pub(super) fn clusters(&self) -> Vec<Unmapped> {
        let mut left: BTreeSet<(i32, i32)> = self.live().map(|(place, _)| *place).gather();
        let mut found = Vec::new();
        while let Some(first) = left.pop_first() {
            let (mut cluster, mut open) = (vec![first], vec![first]);
            while let Some((x, y)) = open.pop() {
                for dx in -STEPS..=STEPS {
                    for dy in -STEPS..=STEPS {
                        let near = (x + dx, y + dy);
                        if dx * dx + dy * dy <= STEPS * STEPS && left.remove(&near) {
                            cluster.push(near);
                            open.push(near);
                        }
                    }
                }
            }
            let cells: Vec<&Cell> = cluster.iter().map(|place| &self.cells[place]).collect();
            let returns = cells.iter().map(|cell| cell.returns).sum();
            if returns < FEWEST {
                continue;
            }
            let points: Vec<Point2<f64>> =
                cells.iter().map(|c| Point2::from(c.sum / c.returns as f64)).collect();
            let mut looks: Vec<usize> = cells.iter().map(|cell| cell.looks).collect();
            looks.sort_unstable();
            let weight: f64 = cells.iter().map(|cell| cell.weight).sum();
            let sum: Vector2<f64> = points.iter().map(|p| p.coords).sum();
            found.push(Unmapped {
                middle: Point2::from(sum / points.len() as f64),
                pieces: pieces(points),
                returns,
                looks: looks[looks.len() / 2],
                sure: 1.0 - 0.5_f64.powf(weight / 2.0),
            });
        }
        found
    }
}

/// Convex pieces that cover the points and little else: what is large and hollow is halved across its length.
fn pieces(points: Vec<Point2<f64>>) -> Vec<Polygon> {
    let half = CELL / 2.0;
    let corners = |p: &Point2<f64>| {
        [(-half, -half), (half, -half), (half, half), (-half, half)]
            .map(|(x, y)| p + Vector2::new(x, y))
    };
    let hull = Polygon::new(convex_hull(points.iter().flat_map(corners).collect()));
    let size = hull.bounds().max - hull.bounds().min;
    let is_full = hull.signed_area().abs() <= 4.0 * CELL * CELL * points.len() as f64;
    if points.len() < 4 || size.norm() <= ONE_THING || is_full {
        return vec![hull];
    }
    let middle = points.iter().map(|p| p.coords).sum::<Vector2<f64>>() / points.len() as f64;
    let spread: Matrix2<f64> =
        points.iter().map(|p| (p.coords - middle) * (p.coords - middle).transpose()).sum();
    let eigen = SymmetricEigen::new(spread);
    let axis: Vector2<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    let (one, other): (Vec<_>, Vec<_>) =
        points.into_iter().partition(|p| axis.dot(&(p.coords - middle)) < 0.0);
    if one.is_empty() || other.is_empty() {
        return vec![hull];
    }
    let mut all = pieces(one);
    all.extend(pieces(other));
    all
}
