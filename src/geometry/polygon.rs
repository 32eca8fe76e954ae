//! Simple polygons of a floor plan, counter-clockwise, in cm.

use crate::units::{Point, Vector};

/// A closed chain of corners; the edge from the last to the first is implied. Counter-clockwise unless said otherwise.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polygon {
    pub corners: Vec<Point>,
}

/// An axis-parallel box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    pub min: Point,
    pub max: Point,
}

impl Bounds {
    /// The box that holds nothing; any point grows it.
    pub const EMPTY: Self = Self {
        min: Point::new(f64::INFINITY, f64::INFINITY),
        max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    #[must_use]
    pub fn of(points: impl IntoIterator<Item = Point>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self {
            min: Point::new(b.min.x.min(p.x), b.min.y.min(p.y)),
            max: Point::new(b.max.x.max(p.x), b.max.y.max(p.y)),
        })
    }

    #[must_use]
    pub fn grown(&self, by: f64) -> Self {
        Self { min: self.min - Vector::new(by, by), max: self.max + Vector::new(by, by) }
    }

    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        self.min.x <= p.x && p.x <= self.max.x && self.min.y <= p.y && p.y <= self.max.y
    }

    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: Point::new(self.min.x.min(other.min.x), self.min.y.min(other.min.y)),
            max: Point::new(self.max.x.max(other.max.x), self.max.y.max(other.max.y)),
        }
    }
}

impl Polygon {
    #[must_use]
    pub fn new(corners: Vec<Point>) -> Self {
        Self { corners }
    }

    /// Edges in order; edge `i` starts at corner `i`.
    pub fn edges(&self) -> impl ExactSizeIterator<Item = (Point, Point)> + '_ {
        let n = self.corners.len();
        (0..n).map(move |i| (self.corners[i], self.corners[(i + 1) % n]))
    }

    /// Positive when counter-clockwise (shoelace formula, about the first corner to keep precision far from the origin).
    #[must_use]
    pub fn signed_area(&self) -> f64 {
        let Some(&o) = self.corners.first() else { return 0.0 };
        self.edges().map(|(a, b)| (a - o).perp(&(b - o))).sum::<f64>() / 2.0
    }

    /// The same polygon, run through counter-clockwise.
    #[must_use]
    pub fn counter_clockwise(mut self) -> Self {
        if self.signed_area() < 0.0 {
            self.corners.reverse();
        }
        self
    }

    /// Centre of the area; of the corners where the area is zero.
    #[must_use]
    pub fn centroid(&self) -> Point {
        let Some(&o) = self.corners.first() else { return Point::origin() };
        let mut doubled_area = 0.0;
        let mut sum = Vector::zeros();
        for (a, b) in self.edges() {
            let (u, v) = (a - o, b - o);
            let cross = u.perp(&v);
            doubled_area += cross;
            sum += (u + v) * cross;
        }
        if doubled_area.abs() < 1e-9 {
            let n = self.corners.len() as f64;
            return o + self.corners.iter().map(|p| p - o).sum::<Vector>() / n;
        }
        o + sum / (3.0 * doubled_area)
    }

    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.corners.iter().copied())
    }

    /// The part within a box. Parts that hang together outside of it stay joined by lines along its border.
    #[must_use]
    pub(super) fn clipped(self, bounds: &Bounds) -> Self {
        let (low, high) = (bounds.min, bounds.max);
        let corners = [low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)];
        self.within_convex(&Self::new(corners.to_vec()))
    }

    /// The part within a convex polygon; of a polygon that is not convex itself, see [`Self::clipped`].
    #[must_use]
    pub(super) fn within_convex(mut self, convex: &Self) -> Self {
        // Sutherland and Hodgman 1974: one side after another.
        for (u, v) in convex.edges() {
            let along = v - u;
            let depth = |p: &Point| along.perp(&(p - u));
            let mut kept = Vec::with_capacity(self.corners.len() + 1);
            for (a, b) in self.edges() {
                let (from, to) = (depth(&a), depth(&b));
                if from >= 0.0 {
                    kept.push(a);
                }
                if (from >= 0.0) != (to >= 0.0) {
                    kept.push(a + (b - a) * (from / (from - to)));
                }
            }
            self.corners = kept;
        }
        self
    }

    /// Inside or on the border, the border within `tolerance` cm.
    #[must_use]
    pub fn contains(&self, p: Point, tolerance: f64) -> bool {
        self.border_distance(p) <= tolerance || self.winds_around(p)
    }

    /// Distance from a point to the nearest edge, in cm; infinite for an empty polygon.
    #[must_use]
    pub fn border_distance(&self, p: Point) -> f64 {
        self.edges()
            .map(|(a, b)| (p - nearest_on_segment(p, a, b)).norm())
            .fold(f64::INFINITY, f64::min)
    }

    /// Even-odd rule: a ray to +x crosses the border an odd number of times.
    pub(super) fn winds_around(&self, p: Point) -> bool {
        let crossings = self
            .edges()
            .filter(|(a, b)| {
                (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
            })
            .count();
        crossings % 2 == 1
    }

    /// Every corner turns left or runs straight, within `tolerance` on the sine of the turn.
    #[must_use]
    pub fn is_convex(&self, tolerance: f64) -> bool {
        let n = self.corners.len();
        n >= 3
            && (0..n).all(|i| {
                let u = self.corners[(i + 1) % n] - self.corners[i];
                let v = self.corners[(i + 2) % n] - self.corners[(i + 1) % n];
                u.perp(&v) >= -tolerance * u.norm() * v.norm()
            })
    }
}

/// Twice the area in cm² of a corner so flat that a hull goes without it: what turning a rectangle leaves of error.
const FLAT: f64 = 1e-9;

/// Corners of the convex hull, counter-clockwise and none on a line between two others (Andrew's monotone chain);
/// fewer than three when all points lie on one line.
#[must_use]
pub fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for &p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp(&(p - b)) > FLAT {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut corners = half(&mut points.iter());
    corners.extend(half(&mut points.iter().rev()));
    corners
}

/// The point of a segment that lies nearest to `p`.
#[must_use]
pub fn nearest_on_segment(p: Point, a: Point, b: Point) -> Point {
    let along = b - a;
    let square = along.norm_squared();
    if square <= 0.0 {
        return a;
    }
    a + along * ((p - a).dot(&along) / square).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ell() -> Polygon {
        // +---+
        // |   |
        // |   +---+
        // |       |
        // +-------+
        let p = |x, y| Point::new(x, y);
        Polygon::new(vec![p(0., 0.), p(20., 0.), p(20., 10.), p(10., 10.), p(10., 20.), p(0., 20.)])
    }

    #[test]
    fn area_and_centroid_of_an_ell() {
        assert!((ell().signed_area() - 300.0).abs() < 1e-9);
        let c = ell().centroid();
        assert!((c - Point::new(25.0 / 3.0, 25.0 / 3.0)).norm() < 1e-9);
    }

    #[test]
    fn nothing_joined_to_a_box_is_the_box() {
        let bounds = ell().bounds();
        assert_eq!(Bounds::EMPTY.union(&bounds), bounds);
    }

    #[test]
    fn a_clipped_ell_keeps_its_area_within_the_box() {
        let part = |min: (f64, f64), max: (f64, f64)| {
            let at = |(x, y)| Point::new(x, y);
            ell().clipped(&Bounds { min: at(min), max: at(max) }).signed_area()
        };
        assert!((part((5.0, 5.0), (15.0, 15.0)) - 75.0).abs() < 1e-9);
        assert!((part((-5.0, -5.0), (50.0, 50.0)) - 300.0).abs() < 1e-9);
        assert!(part((12.0, 12.0), (18.0, 18.0)).abs() < 1e-9);
    }

    #[test]
    fn the_notch_is_outside() {
        assert!(ell().contains(Point::new(5.0, 15.0), 0.0));
        assert!(!ell().contains(Point::new(15.0, 15.0), 0.1));
        assert!(ell().contains(Point::new(20.05, 5.0), 0.1));
        assert!(!ell().is_convex(1e-9));
    }

    #[test]
    fn the_hull_holds_every_point() {
        let cloud: Vec<Point> = (0..200_i32)
            .map(|n| Point::new(f64::from(n * 37 % 101), f64::from(n * 53 % 89)))
            .collect();
        let hull = Polygon::new(convex_hull(cloud.clone()));
        assert!(hull.signed_area() > 0.0 && hull.is_convex(0.0));
        let left = |p: Point| hull.edges().all(|(a, b)| (b - a).perp(&(p - a)) >= -1e-9);
        assert!(cloud.iter().all(|&p| left(p)));
    }

    #[test]
    fn points_on_a_line_have_no_hull() {
        let line = |n| vec![Point::new(1.0, 2.0); n];
        assert!((0..4).all(|n| convex_hull(line(n)).len() < 3));
        assert_eq!(convex_hull((0..9).map(|n| Point::new(f64::from(n), 0.0)).collect()).len(), 2);
    }
}
