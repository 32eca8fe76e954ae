//! Boolean operations on polygons, exact on an integer grid.
//!
//! i_overlay computes on integers: every result has its corners on the grid, so that areas, orientations and
//! convexity are decided exactly. Each Fragment has a grid of its own, as fine as 30 bits allow over its extent
//! (below a micrometre for a building of a kilometre), and turned as most of its walls are, so that what stands in one
//! line stays in one line.
//!
//! **Invariant**: a [`Grid`] maps grid points to cm and back without loss; its unit is a power of two.

use std::cell::RefCell;

use i_overlay::core::extract::BooleanExtractionBuffer;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;

use crate::units::{Point, Vector};

use super::{Bounds, Polygon};

/// A grid point.
pub(super) type Node = IntPoint<i32>;
/// A closed chain of grid points.
pub(super) type Contour = Vec<Node>;
/// Shapes as i_overlay returns them: an outer contour (counter-clockwise), then its holes (clockwise).
pub(super) type Shapes = Vec<Vec<Contour>>;

/// A connected piece of floor: a polygon less its holes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Region {
    /// Counter-clockwise.
    pub outer: Polygon,
    /// Clockwise.
    pub holes: Vec<Polygon>,
}

impl Region {
    #[must_use]
    pub fn area(&self) -> f64 {
        self.contours().map(Polygon::signed_area).sum()
    }

    /// Inside or on the border, the border within `tolerance` cm.
    #[must_use]
    pub fn contains(&self, p: Point, tolerance: f64) -> bool {
        self.outer.contains(p, tolerance)
            && !self.holes.iter().any(|h| h.contains(p, 0.0) && h.border_distance(p) > tolerance)
    }

    /// The outer contour, then the holes: the region lies to the left of each.
    pub fn contours(&self) -> impl Iterator<Item = &Polygon> + '_ {
        std::iter::once(&self.outer).chain(&self.holes)
    }
}

/// Shapes as they are kept: in a tenth of the pieces of memory, and half of the memory, that [`Region`]s take.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Outlines {
    pub(super) nodes: Vec<Node>,
    /// Where each contour ends in `nodes`, and whether it is a hole in the last that is none.
    pub(super) ends: Vec<(u32, bool)>,
}

impl Outlines {
    pub(super) fn of(shapes: &Shapes) -> Self {
        let mut kept = Self {
            nodes: Vec::with_capacity(shapes.iter().flatten().map(Vec::len).sum()),
            ends: Vec::with_capacity(shapes.iter().map(Vec::len).sum()),
        };
        for (number, contour) in shapes.iter().flat_map(|shape| shape.iter().enumerate()) {
            kept.nodes.extend(contour);
            kept.ends.push((kept.nodes.len() as u32, number > 0));
        }
        kept
    }

    pub(super) fn regions(&self, grid: &Grid) -> Vec<Region> {
        let (mut regions, mut from) = (Vec::<Region>::new(), 0);
        for &(end, is_hole) in &self.ends {
            let polygon = grid.polygon(&self.nodes[from..end as usize]);
            match regions.last_mut() {
                Some(last) if is_hole => last.holes.push(polygon),
                _ => regions.push(Region { outer: polygon, holes: Vec::new() }),
            }
            from = end as usize;
        }
        regions
    }
}

/// The grid of one Fragment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    pub(super) origin: Point,
    /// Grid units per cm; a power of two.
    pub(super) scale: f64,
    /// Cosine and sine of the angle by which its axes are turned.
    pub(super) cos: f64,
    pub(super) sin: f64,
}

impl Default for Grid {
    fn default() -> Self {
        Self::over(&Bounds::EMPTY)
    }
}

/// i_overlay's limit for `i32` is 2^30; one bit is left for what sticks out of the bounds.
const REACH: f64 = (1 << 29) as f64;

impl Grid {
    /// The finest grid that covers `bounds`.
    pub(super) fn over(bounds: &Bounds) -> Self {
        Self::turned(bounds, 0.0)
    }

    /// The finest grid that covers `bounds` with axes turned by an angle, in radians.
    pub(super) fn turned(bounds: &Bounds, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        if !(bounds.min.x <= bounds.max.x && bounds.min.y <= bounds.max.y) {
            return Self { origin: Point::origin(), scale: 1024.0, cos, sin };
        }
        let middle = nalgebra::center(&bounds.min, &bounds.max);
        let half = (bounds.max - bounds.min).amax() / 2.0 + 1.0;
        let exponent = (REACH / (half * (cos.abs() + sin.abs()))).log2().floor().clamp(0.0, 20.0);
        let origin = Point::new(middle.x.round(), middle.y.round());
        Self { origin, scale: exponent.exp2(), cos, sin }
    }

    /// The finest grid that covers other bounds, turned as this one.
    pub(super) fn covering(&self, bounds: &Bounds) -> Self {
        Self::turned(bounds, self.sin.atan2(self.cos))
    }

    /// A point's place between the grid points, in grid units.
    pub(super) fn place(&self, p: Point) -> Point {
        let v: Vector = (p - self.origin) * self.scale;
        Point::new(v.x * self.cos + v.y * self.sin, v.y * self.cos - v.x * self.sin)
    }

    /// The nearest grid point; points beyond the grid come to its edge.
    pub(super) fn node(&self, p: Point) -> Node {
        let limit = 2.0 * REACH - 1.0;
        let Point { coords: at } = self.place(p);
        // A NaN would become 0: casts saturate, they do not trap.
        Node::new(
            at.x.round().clamp(-limit, limit) as i32,
            at.y.round().clamp(-limit, limit) as i32,
        )
    }

    pub(super) fn point(&self, n: Node) -> Point {
        let (x, y) = (f64::from(n.x) / self.scale, f64::from(n.y) / self.scale);
        self.origin + Vector::new(x * self.cos - y * self.sin, x * self.sin + y * self.cos)
    }

    pub(super) fn contour(&self, polygon: &Polygon) -> Contour {
        polygon.corners.iter().map(|&p| self.node(p)).collect()
    }

    pub(super) fn polygon(&self, contour: &[Node]) -> Polygon {
        Polygon::new(contour.iter().map(|&n| self.point(n)).collect())
    }

    pub(super) fn regions(&self, shapes: &Shapes) -> Vec<Region> {
        let region = |shape: &Vec<Contour>| {
            let mut contours = shape.iter().map(|c| self.polygon(c));
            Region { outer: contours.next().unwrap_or_default(), holes: contours.collect() }
        };
        shapes.iter().map(region).collect()
    }
}

/// The union of `floor` less the union of `blocked`, whichever way their contours run.
pub(super) fn difference(floor: &[Contour], blocked: &[Contour]) -> Shapes {
    overlay(floor, blocked, OverlayRule::Difference, FillRule::NonZero)
}

/// What lies in both unions.
pub(super) fn intersection(one: &[Contour], other: &[Contour]) -> Shapes {
    overlay(one, other, OverlayRule::Intersect, FillRule::NonZero)
}

/// The points that `contours` wind around more often counter-clockwise than clockwise.
pub(super) fn positive(contours: &[Contour]) -> Shapes {
    overlay(contours, &[], OverlayRule::Subject, FillRule::Positive)
}

/// The shapes without the slivers that rounding left: corners that stick out from the line between their
/// neighbours by a few units are cut off. Nothing is added.
pub(super) fn smooth(shapes: Shapes) -> Shapes {
    let mut is_changed = false;
    let mut contours: Vec<Contour> = Vec::with_capacity(shapes.len());
    for contour in shapes.iter().flatten() {
        let mut kept = contour.clone();
        let mut i = 0;
        while i < kept.len() && kept.len() > 2 {
            let n = kept.len();
            if is_sliver(kept[(i + n - 1) % n], kept[i], kept[(i + 1) % n]) {
                kept.remove(i);
                is_changed = true;
                i = i.saturating_sub(1);
            } else {
                i += 1;
            }
        }
        if kept.len() > 2 {
            contours.push(kept);
        }
    }
    if is_changed { positive(&contours) } else { shapes }
}

/// A turn to the left, less than [`SLIVER`] units high over the line between its neighbours.
fn is_sliver(before: Node, at: Node, after: Node) -> bool {
    const SLIVER: f64 = 16.0;
    let f = |n: Node| Vector::new(f64::from(n.x), f64::from(n.y));
    let (u, v) = (f(at) - f(before), f(after) - f(at));
    let (turn, base) = (u.perp(&v), (f(after) - f(before)).norm());
    turn >= 0.0 && (turn < SLIVER * base || u.norm().min(v.norm()) < SLIVER)
}

pub(super) fn overlay(
    subject: &[Contour],
    clip: &[Contour],
    rule: OverlayRule,
    fill: FillRule,
) -> Shapes {
    KEPT.with_borrow_mut(|(overlay, _)| {
        fill_in(overlay, subject, clip);
        overlay.overlay(rule, fill)
    })
}

thread_local! {
    /// What i_overlay allocates for one overlay serves the next: a Fragment needs several, a building thousands.
    static KEPT: RefCell<(Overlay<i32>, BooleanExtractionBuffer<i32>)> =
        RefCell::new((Overlay::new(512), BooleanExtractionBuffer::default()));
}

/// Several results of one overlay, for little more than the work of one.
pub(super) fn overlays<const N: usize>(
    subject: &[Contour],
    clip: &[Contour],
    rules: [OverlayRule; N],
    fill: FillRule,
) -> [Shapes; N] {
    KEPT.with_borrow_mut(|(overlay, buffer)| {
        fill_in(overlay, subject, clip);
        match overlay.build_graph_view(fill) {
            Some(graph) => rules.map(|rule| graph.extract_shapes(rule, buffer)),
            None => rules.map(|_| Shapes::new()),
        }
    })
}

fn fill_in(overlay: &mut Overlay<i32>, subject: &[Contour], clip: &[Contour]) {
    overlay.clear();
    for contour in subject {
        overlay.add_contour(contour, ShapeType::Subject);
    }
    for contour in clip {
        overlay.add_contour(contour, ShapeType::Clip);
    }
}

#[cfg(test)]
/// Twice the signed area of a shape less its holes, exact.
pub(super) fn doubled_area(shape: &[Contour]) -> i128 {
    shape.iter().map(|c| doubled_contour_area(c)).sum()
}

#[cfg(test)]
fn doubled_contour_area(contour: &[Node]) -> i128 {
    let n = contour.len();
    (0..n)
        .map(|i| {
            let (a, b) = (contour[i], contour[(i + 1) % n]);
            i128::from(a.x) * i128::from(b.y) - i128::from(b.x) * i128::from(a.y)
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: i32, y: i32, size: i32) -> Contour {
        vec![
            Node::new(x, y),
            Node::new(x + size, y),
            Node::new(x + size, y + size),
            Node::new(x, y + size),
        ]
    }

    #[test]
    fn the_grid_gives_back_its_own_points() {
        let bounds =
            Bounds { min: Point::new(-1e6, 999_000.0), max: Point::new(-999_400.0, 999_500.0) };
        for angle in [0.0, 0.3, 1.2] {
            let grid = Grid::turned(&bounds, angle);
            for n in [Node::new(0, 0), Node::new(-123_456, 77), Node::new(1 << 29, -(1 << 29))] {
                assert_eq!(grid.node(grid.point(n)), n);
            }
            assert!((grid.point(Node::new(1, 0)) - grid.point(Node::new(0, 0))).norm() < 1e-5);
        }
    }

    #[test]
    fn points_from_nowhere_stay_on_the_grid() {
        let grid = Grid::over(&Bounds::EMPTY);
        for p in [Point::new(f64::NAN, 0.0), Point::new(1e300, f64::NEG_INFINITY)] {
            let n = grid.node(p);
            assert!(n.x.abs() < 1 << 30 && n.y.abs() < 1 << 30);
        }
    }

    #[test]
    fn a_hole_runs_clockwise() {
        let shapes = difference(&[square(0, 0, 100)], &[square(40, 40, 20)]);
        assert_eq!(doubled_area(&shapes[0]), 2 * (10_000 - 400));
        assert!(doubled_contour_area(&shapes[0][1]) < 0);
    }

    #[test]
    fn winding_counts_direction() {
        let mut hole = square(40, 40, 20);
        hole.reverse();
        assert_eq!(doubled_area(&positive(&[square(0, 0, 100), hole.clone()])[0]), 2 * 9_600);
        assert!(positive(&[hole]).is_empty());
    }
}
