//! Just enough geometry of the plane to check a map by. The map stands below `geometry` and cannot use it.

use std::ops::ControlFlow;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use robust::{Coord, orient2d};

use crate::units::{Point, Vector};

/// An axis-parallel box: least and greatest corner.
pub type Bounds = (Point, Point);

pub fn bounds(points: impl IntoIterator<Item = Point>) -> Bounds {
    let empty = (Point::new(f64::MAX, f64::MAX), Point::new(f64::MIN, f64::MIN));
    points.into_iter().fold(empty, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

/// Calls `visit` for every pair of boxes that come within `margin` of each other, until it breaks.
pub fn near_pairs(
    boxes: &[Bounds],
    margin: f64,
    mut visit: impl FnMut(usize, usize) -> ControlFlow<()>,
) {
    let order = from_the_left(boxes);
    for (n, &i) in order.iter().enumerate() {
        let (low, high) = boxes[i];
        for &j in order[n + 1..].iter().take_while(|&&j| boxes[j].0.x <= high.x + margin) {
            let apart = boxes[j].0.y > high.y + margin || boxes[j].1.y < low.y - margin;
            if !apart && visit(i.min(j), i.max(j)).is_break() {
                return;
            }
        }
    }
}

/// Apart from [`near_pairs`], so that the sort is not compiled anew for each of those who visit.
fn from_the_left(boxes: &[Bounds]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&i, &j| boxes[i].0.x.total_cmp(&boxes[j].0.x));
    order
}

pub fn edges(corners: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]))
}

/// Twice the area, positive when counter-clockwise.
pub fn doubled_area(corners: &[Point]) -> f64 {
    let Some(&o) = corners.first() else { return 0.0 };
    edges(corners).map(|(a, b)| (a - o).perp(&(b - o))).sum()
}

/// Which side of the line `ab` the point is on; exact.
fn turn(a: Point, b: Point, p: Point) -> f64 {
    let coord = |p: Point| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(p))
}

/// Whether a point on the line `ab` lies between its ends.
fn between(a: Point, b: Point, p: Point) -> bool {
    let low = a.inf(&b);
    let high = a.sup(&b);
    low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y
}

/// A point common to two segments, touching included; exact but for the rounding of the point itself.
pub fn meeting((a, b): (Point, Point), (c, d): (Point, Point)) -> Option<Point> {
    let (ta, tb) = (turn(c, d, a), turn(c, d, b));
    let (tc, td) = (turn(a, b, c), turn(a, b, d));
    let splits = |s: f64, t: f64| (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0);
    if splits(ta, tb) && splits(tc, td) {
        return Some(a + (b - a) * (ta / (ta - tb)));
    }
    let lies = |t: f64, from: Point, to: Point, p: Point| t == 0.0 && between(from, to, p);
    #[allow(clippy::float_cmp, reason = "orient2d is exact: zero means on the line")]
    {
        if lies(ta, c, d, a) {
            Some(a)
        } else if lies(tb, c, d, b) {
            Some(b)
        } else if lies(tc, a, b, c) {
            Some(c)
        } else if lies(td, a, b, d) {
            Some(d)
        } else {
            None
        }
    }
}

pub fn segment_distance(p: Point, (a, b): (Point, Point)) -> f64 {
    let along: Vector = b - a;
    let square = along.norm_squared();
    let t = if square > 0.0 { ((p - a).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + along * t)).norm()
}

pub fn border_distance(polygon: &[Point], p: Point) -> f64 {
    edges(polygon).map(|edge| segment_distance(p, edge)).fold(f64::INFINITY, f64::min)
}

/// Even-odd rule: a ray to +x crosses the border an odd number of times.
pub fn contains(polygon: &[Point], p: Point) -> bool {
    edges(polygon)
        .filter(|(a, b)| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        })
        .count()
        % 2
        == 1
}

/// Whether two polygons come within `margin` of each other.
pub fn touch(p: &[Point], q: &[Point], margin: f64) -> bool {
    let near = |p: &[Point], q: &[Point]| p.iter().any(|&c| border_distance(q, c) <= margin);
    let within = |p: &[Point], q: &[Point]| p.first().is_some_and(|&c| contains(q, c));
    near(p, q)
        || near(q, p)
        || within(p, q)
        || within(q, p)
        || edges(p).any(|e| edges(q).any(|f| meeting(e, f).is_some()))
}

type Contour = Vec<[f64; 2]>;

fn contour(polygon: &[Point]) -> Contour {
    polygon.iter().map(|p| [p.x, p.y]).collect()
}

/// What a boolean operation left: its area and its outlines.
pub struct Rest {
    pub area: f64,
    pub outlines: Vec<Vec<Point>>,
}

fn rest(subject: &Vec<Contour>, clip: &Vec<Contour>, rule: OverlayRule) -> Rest {
    let shapes = subject.overlay_as::<i64>(clip, rule, FillRule::NonZero);
    let mut rest = Rest { area: 0.0, outlines: Vec::new() };
    for shape in shapes {
        for (i, outline) in shape.into_iter().enumerate() {
            let outline: Vec<_> = outline.into_iter().map(|[x, y]| Point::new(x, y)).collect();
            let area = doubled_area(&outline).abs() / 2.0;
            // The first outline of a shape is its border, the others are holes.
            rest.area += if i == 0 { area } else { -area };
            rest.outlines.push(outline);
        }
    }
    rest
}

/// The common part of two polygons.
pub fn intersection(p: &[Point], q: &[Point]) -> Rest {
    rest(&vec![contour(p)], &vec![contour(q)], OverlayRule::Intersect)
}

/// What of a polygon lies outside all the others.
pub fn difference(p: &[Point], others: &[Vec<Point>]) -> Rest {
    let others: Vec<_> = others.iter().map(|q| contour(q)).collect();
    rest(&vec![contour(p)], &others, OverlayRule::Difference)
}

/// Centre of the corners: good enough to point at.
pub fn middle(polygon: &[Point]) -> Point {
    let sum: Vector = polygon.iter().map(|p| p.coords).sum();
    (sum / polygon.len().max(1) as f64).into()
}
