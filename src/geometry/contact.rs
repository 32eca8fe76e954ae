//! How two footprints lie to each other: overlap, gap, facing sides, containment, what stands between (SPEC R1).
//!
//! Pure measuring in the plane, in cm; no thresholds here. Axis-parallel boxes and convex polygons have exact
//! short ways, any other simple polygon takes the general one; all agree within 1e-6 cm.
//!
//! **Invariant:** [`gap`] and [`overlap_area`] are symmetric, whichever way they were taken.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::float::single::SingleFloatOverlay;

use crate::units::{Frame, Point, Vector};

use super::{Bounds, Polygon, nearest_on_segment};

/// The least length that counts, in cm: a hundredth of the facts' unit.
const EPSILON: f64 = 1e-6;

/// Which short ways a polygon allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// A rectangle along the axes: its bounds say all.
    Box,
    Convex,
    Simple,
}

/// A polygon with what the quick tests need to know of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Footprint {
    pub polygon: Polygon,
    pub bounds: Bounds,
    pub class: Class,
    pub area: f64,
}

impl Footprint {
    #[must_use]
    pub fn new(polygon: Polygon) -> Self {
        let bounds = polygon.bounds();
        let area = polygon.signed_area().abs();
        let class = if is_box(&polygon, &bounds) {
            Class::Box
        } else if polygon.is_convex(1e-9) {
            Class::Convex
        } else {
            Class::Simple
        };
        Self { polygon, bounds, class, area }
    }

    /// The same footprint, seen in the parent of `frame`.
    #[must_use]
    pub fn placed(&self, frame: &Frame) -> Self {
        let polygon = Polygon::new(self.polygon.corners.iter().map(|&p| frame.apply(p)).collect());
        let bounds = polygon.bounds();
        // Turning keeps area and convexity; only the axes may be lost or found.
        let class = match self.class {
            Class::Simple => Class::Simple,
            _ if is_box(&polygon, &bounds) => Class::Box,
            _ => Class::Convex,
        };
        Self { polygon, bounds, class, area: self.area }
    }

    /// Inside or on the border.
    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        self.bounds.grown(EPSILON).contains(p)
            && (self.class == Class::Box || self.polygon.contains(p, EPSILON))
    }

    /// Distance from a point to the footprint; 0 inside.
    #[must_use]
    pub fn distance_to(&self, p: Point) -> f64 {
        if self.class == Class::Box {
            let dx = (self.bounds.min.x - p.x).max(p.x - self.bounds.max.x).max(0.0);
            let dy = (self.bounds.min.y - p.y).max(p.y - self.bounds.max.y).max(0.0);
            return dx.hypot(dy);
        }
        if self.contains(p) { 0.0 } else { self.polygon.border_distance(p) }
    }

    /// A point that is certainly inside: the centroid where it serves, else the middle of the widest cut through its height.
    #[must_use]
    pub fn interior_point(&self) -> Point {
        let centroid = self.polygon.centroid();
        if self.class != Class::Simple || self.polygon.contains(centroid, 0.0) {
            return centroid;
        }
        let mut crossings: Vec<f64> = self
            .polygon
            .edges()
            .filter(|(a, b)| (a.y > centroid.y) != (b.y > centroid.y))
            .map(|(a, b)| a.x + (centroid.y - a.y) / (b.y - a.y) * (b.x - a.x))
            .collect();
        crossings.sort_by(f64::total_cmp);
        crossings
            .chunks_exact(2)
            .max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))
            .map_or(centroid, |cut| Point::new(f64::midpoint(cut[0], cut[1]), centroid.y))
    }
}

/// Four corners, each an end of the bounds, no two alike.
fn is_box(polygon: &Polygon, bounds: &Bounds) -> bool {
    let [a, b, c, d] = polygon.corners.as_slice() else { return false };
    let (min, max) = (bounds.min, bounds.max);
    let at_end = |v: f64, low: f64, high: f64| (v - low).abs() < 1e-9 || (v - high).abs() < 1e-9;
    let ends = |p: &Point| at_end(p.x, min.x, max.x) && at_end(p.y, min.y, max.y);
    let turns = |p: &Point, q: &Point, r: &Point| (q - p).perp(&(r - q)) > 1e-9;
    [a, b, c, d].into_iter().all(ends)
        && turns(a, b, c)
        && turns(b, c, d)
        && turns(c, d, a)
        && turns(d, a, b)
}

/// Area that two footprints share, in cm².
#[must_use]
pub fn overlap_area(a: &Footprint, b: &Footprint) -> f64 {
    let w = a.bounds.max.x.min(b.bounds.max.x) - a.bounds.min.x.max(b.bounds.min.x);
    let h = a.bounds.max.y.min(b.bounds.max.y) - a.bounds.min.y.max(b.bounds.min.y);
    if w <= 0.0 || h <= 0.0 {
        return 0.0;
    }
    match (a.class, b.class) {
        (Class::Box, Class::Box) => w * h,
        (_, Class::Box | Class::Convex) => clipped_area(&a.polygon, &b.polygon),
        (Class::Box | Class::Convex, _) => clipped_area(&b.polygon, &a.polygon),
        (Class::Simple, Class::Simple) => total_area(&corners(&a.polygon).overlay_as::<i64>(
            &corners(&b.polygon),
            OverlayRule::Intersect,
            FillRule::NonZero,
        )),
    }
}

/// Of a polygon within a convex one. One that is not convex is cut with seams along the border; they have no area.
fn clipped_area(subject: &Polygon, window: &Polygon) -> f64 {
    subject.clone().within_convex(window).signed_area().max(0.0)
}

/// The shortest way from one footprint to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// 0 when they touch or overlap.
    pub distance: f64,
    /// Its ends; in the middle of the stretch where two sides run parallel.
    pub from: Point,
    pub to: Point,
}

impl Gap {
    fn none(at: Point) -> Self {
        Self { distance: 0.0, from: at, to: at }
    }

    fn reversed(self) -> Self {
        Self { distance: self.distance, from: self.to, to: self.from }
    }
}

/// The least that the gap between two footprints can be: that of their bounds.
#[must_use]
pub fn bounds_distance(a: &Bounds, b: &Bounds) -> f64 {
    let dx = (a.min.x - b.max.x).max(b.min.x - a.max.x).max(0.0);
    let dy = (a.min.y - b.max.y).max(b.min.y - a.max.y).max(0.0);
    dx.hypot(dy)
}

/// The shortest way from `a` to `b`.
#[must_use]
pub fn gap(a: &Footprint, b: &Footprint) -> Gap {
    if a.class == Class::Box && b.class == Class::Box {
        return box_gap(&a.bounds, &b.bounds);
    }
    if a.bounds.meets(&b.bounds)
        && let Some(&p) = [(a, b), (b, a)]
            .iter()
            .find_map(|(f, g)| f.polygon.corners.iter().find(|&&p| g.contains(p)))
    {
        return Gap::none(p);
    }
    let mut best = Gap { distance: f64::INFINITY, ..Gap::none(a.bounds.min) };
    let mut longest = 0.0;
    for (p, q) in a.polygon.edges() {
        for (r, s) in b.polygon.edges() {
            let (found, stretch) = segment_gap((p, q), (r, s));
            // A corner ties with the side that it ends: the longer stretch says more.
            let level = (found.distance - best.distance).abs() <= 1e-9;
            if if level { stretch > longest + 1e-9 } else { found.distance < best.distance } {
                (best, longest) = (found, stretch);
            }
        }
    }
    best
}

fn box_gap(a: &Bounds, b: &Bounds) -> Gap {
    //     +---+
    //     | a |<--->+---+      along an axis on which they are apart the ends face each other,
    //     +---+     | b |      along the other both stand in the middle of the common stretch
    //               +---+
    let axis = |a: (f64, f64), b: (f64, f64)| {
        if a.1 < b.0 {
            (a.1, b.0)
        } else if b.1 < a.0 {
            (a.0, b.1)
        } else {
            let middle = f64::midpoint(a.0.max(b.0), a.1.min(b.1));
            (middle, middle)
        }
    };
    let (ax, bx) = axis((a.min.x, a.max.x), (b.min.x, b.max.x));
    let (ay, by) = axis((a.min.y, a.max.y), (b.min.y, b.max.y));
    let (from, to) = (Point::new(ax, ay), Point::new(bx, by));
    Gap { distance: (to - from).norm(), from, to }
}

/// The shortest way between two segments, and the length of the stretch along which it is the shortest.
fn segment_gap(a: (Point, Point), b: (Point, Point)) -> (Gap, f64) {
    if let Some(at) = crossing(a, b) {
        return (Gap::none(at), 0.0);
    }
    let to = |p: Point, s: (Point, Point)| {
        let q = nearest_on_segment(p, s.0, s.1);
        Gap { distance: (q - p).norm(), from: p, to: q }
    };
    let ends = [to(a.0, b), to(a.1, b), to(b.0, a).reversed(), to(b.1, a).reversed()];
    let least = ends.iter().map(|g| g.distance).fold(f64::INFINITY, f64::min);
    let level = ends.iter().filter(|g| g.distance <= least + 1e-9);
    // Parallel stretches tie at both their ends: take the two that lie farthest apart.
    let (mut first, mut last) = (None::<&Gap>, None::<&Gap>);
    for g in level {
        let f = *first.get_or_insert(g);
        if last.is_none_or(|l| (g.from - f.from).norm() > (l.from - f.from).norm()) {
            last = Some(g);
        }
    }
    let (f, l) = (first.expect("one of the ends is least"), last.expect("the first is one"));
    let middle = Gap {
        distance: least,
        from: nalgebra::center(&f.from, &l.from),
        to: nalgebra::center(&f.to, &l.to),
    };
    (middle, (l.from - f.from).norm())
}

/// Where two segments cross; none for parallel ones.
fn crossing(a: (Point, Point), b: (Point, Point)) -> Option<Point> {
    let (u, v) = (a.1 - a.0, b.1 - b.0);
    let turn = u.perp(&v);
    if turn.abs() <= 1e-12 * u.norm() * v.norm() {
        return None;
    }
    let w = b.0 - a.0;
    let (s, t) = (w.perp(&v) / turn, w.perp(&u) / turn);
    ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)).then(|| a.0 + u * s)
}

/// How much of a segment runs through a footprint, in cm.
#[must_use]
pub fn length_within(from: Point, to: Point, footprint: &Footprint) -> f64 {
    if !Bounds::of([from, to]).meets(&footprint.bounds) {
        return 0.0;
    }
    let length = (to - from).norm();
    let inside = |s: f64| footprint.contains(from + (to - from) * s);
    pieces(from, to, footprint.polygon.edges())
        .filter(|&(s, t)| inside(f64::midpoint(s, t)))
        .map(|(s, t)| (t - s) * length)
        .sum()
}

/// Whether a segment stays within the union of some footprints, bar `tolerance` cm.
#[must_use]
pub fn stays_within(from: Point, to: Point, union: &[&Footprint], tolerance: f64) -> bool {
    let length = (to - from).norm();
    let outside: f64 = pieces(from, to, union.iter().flat_map(|f| f.polygon.edges()))
        .filter(|&(s, t)| {
            let middle = from + (to - from) * f64::midpoint(s, t);
            !union.iter().any(|f| f.contains(middle))
        })
        .map(|(s, t)| (t - s) * length)
        .sum();
    outside <= tolerance
}

/// The parts, as shares of its length, into which edges cut a segment.
fn pieces(
    from: Point,
    to: Point,
    edges: impl Iterator<Item = (Point, Point)>,
) -> impl Iterator<Item = (f64, f64)> {
    let way = to - from;
    let square = way.norm_squared().max(f64::MIN_POSITIVE);
    let mut cuts: Vec<f64> = edges
        .filter_map(|edge| crossing((from, to), edge))
        .map(|p| (p - from).dot(&way) / square)
        .chain([0.0, 1.0])
        .collect();
    cuts.sort_by(f64::total_cmp);
    (1..cuts.len()).map(move |i| (cuts[i - 1], cuts[i]))
}

/// Extent of some points along a direction.
#[must_use]
pub fn extent(points: &[Point], along: Vector) -> (f64, f64) {
    points
        .iter()
        .map(|p| p.coords.dot(&along))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |e, v| (e.0.min(v), e.1.max(v)))
}

/// How far the sides that two convex footprints turn to each other overlap: share of the shorter one, 0 to 1.
///
/// ```text
///   +------+ ---.
///   |  a   |    | common      seen along the direction in which the two are farthest apart
///   +------+    |   +------+
///            ---'   |  b   |
///                   +------+
/// ```
#[must_use]
pub fn facing_overlap(a: &Footprint, b: &Footprint) -> f64 {
    let share = |direction: Vector| {
        let across = Vector::new(-direction.y, direction.x);
        let ((a0, a1), (b0, b1)) =
            (extent(&a.polygon.corners, across), extent(&b.polygon.corners, across));
        let shorter = (a1 - a0).min(b1 - b0);
        if shorter <= 0.0 { 0.0 } else { ((a1.min(b1) - a0.max(b0)) / shorter).clamp(0.0, 1.0) }
    };
    let apart = |direction: Vector| {
        let ((a0, a1), (b0, b1)) =
            (extent(&a.polygon.corners, direction), extent(&b.polygon.corners, direction));
        (b0 - a1).max(a0 - b1)
    };
    let along_axes = a.class == Class::Box && b.class == Class::Box;
    let axes = [Vector::x(), Vector::y()];
    let normals = [a, b].into_iter().flat_map(|f| {
        let edges = if along_axes { 0 } else { f.polygon.corners.len() };
        f.polygon.edges().take(edges).filter_map(|(p, q)| (q - p).try_normalize(1e-9))
    });
    let directions = normals
        .map(|e| Vector::new(e.y, -e.x))
        .chain(axes.into_iter().take(if along_axes { 2 } else { 0 }));
    let mut best = (f64::NEG_INFINITY, 0.0);
    for direction in directions {
        let found = (apart(direction), share(direction));
        if found.0 > best.0 + 1e-9 || ((found.0 - best.0).abs() <= 1e-9 && found.1 > best.1) {
            best = found;
        }
    }
    best.1
}

/// How far `a` reaches out of the union of some footprints: 0 when it lies within.
///
/// Exact for a convex union; where the union has notches, what lies in them is measured at its corners and edge middles.
#[must_use]
pub fn escape(a: &Footprint, union: &[&Footprint]) -> f64 {
    let distance = |p: Point| union.iter().map(|f| f.distance_to(p)).fold(f64::INFINITY, f64::min);
    let at_corners = a.polygon.corners.iter().map(|&p| distance(p)).fold(0.0, f64::max);
    if matches!(union, [only] if only.class != Class::Simple) {
        return at_corners;
    }
    let window: Vec<Vec<[f64; 2]>> = union.iter().map(|f| corners(&f.polygon)).collect();
    let outside =
        corners(&a.polygon).overlay_as::<i64>(&window, OverlayRule::Difference, FillRule::NonZero);
    outside
        .iter()
        .flatten()
        .flat_map(|contour| {
            let p = |i: usize| {
                let [x, y] = contour[i % contour.len()];
                Point::new(x, y)
            };
            (0..contour.len()).map(move |i| (p(i), nalgebra::center(&p(i), &p(i + 1))))
        })
        .map(|(corner, middle)| distance(corner).max(distance(middle)))
        .fold(at_corners, f64::max)
}

/// The outer border of the union of some polygons; holes are filled.
#[must_use]
pub fn outline(polygons: &[&Polygon]) -> Vec<Polygon> {
    if let [one] = polygons {
        return vec![(*one).clone()];
    }
    let contours: Vec<Vec<[f64; 2]>> = polygons.iter().map(|p| corners(p)).collect();
    contours
        .simplify_shape_as::<i64>(FillRule::NonZero)
        .into_iter()
        .filter_map(|shape| shape.into_iter().next())
        .map(|outer| Polygon::new(outer.into_iter().map(|[x, y]| Point::new(x, y)).collect()))
        .collect()
}

fn corners(polygon: &Polygon) -> Vec<[f64; 2]> {
    polygon.corners.iter().map(|p| [p.x, p.y]).collect()
}

fn total_area(shapes: &[Vec<Vec<[f64; 2]>>]) -> f64 {
    // Outer borders run counter-clockwise, holes clockwise: the signs add up to the area.
    let area = |contour: &Vec<[f64; 2]>| {
        Polygon::new(contour.iter().map(|&[x, y]| Point::new(x, y)).collect()).signed_area()
    };
    shapes.iter().flatten().map(area).sum::<f64>().abs()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::convex_hull;
    use super::*;
    use crate::units::Deg;

    fn polygon(corners: &[(f64, f64)]) -> Footprint {
        Footprint::new(Polygon::new(corners.iter().map(|&(x, y)| Point::new(x, y)).collect()))
    }

    fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Footprint {
        polygon(&[(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
    }

    fn turned(f: &Footprint, angle: f64) -> Footprint {
        f.placed(&Frame::new(0.0, 0.0, 0.0, Deg::of(angle)))
    }

    /// ```text
    /// +--+  +--+
    /// |  +--+  |
    /// +--------+
    /// ```
    fn cup() -> Footprint {
        polygon(&[
            (0., 0.),
            (30., 0.),
            (30., 20.),
            (20., 20.),
            (20., 10.),
            (10., 10.),
            (10., 20.),
            (0., 20.),
        ])
    }

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-6, "{a} is not {b}");
    }

    #[test]
    fn the_short_ways_know_their_polygons() {
        assert_eq!(rectangle(1.0, 2.0, 3.0, 4.0).class, Class::Box);
        assert_eq!(turned(&rectangle(1.0, 2.0, 3.0, 4.0), 90.0).class, Class::Box);
        assert_eq!(turned(&rectangle(1.0, 2.0, 3.0, 4.0), 30.0).class, Class::Convex);
        assert_eq!(turned(&turned(&rectangle(1.0, 2.0, 3.0, 4.0), 30.0), -30.0).class, Class::Box);
        assert_eq!(cup().class, Class::Simple);
    }

    #[test]
    fn overlap_of_boxes_of_turned_boxes_and_of_cups() {
        near(overlap_area(&rectangle(0., 0., 10., 10.), &rectangle(5., 5., 10., 10.)), 25.0);
        near(overlap_area(&cup(), &rectangle(0., 15., 30., 10.)), 100.0);
        near(overlap_area(&cup(), &cup()), 500.0);
        let (a, b) = (turned(&cup(), 33.0), turned(&rectangle(0., 15., 30., 10.), 33.0));
        near(overlap_area(&a, &b), 100.0);
    }

    #[test]
    fn the_way_between_parallel_sides_starts_in_their_middle() {
        let g = gap(&rectangle(0., 0., 10., 10.), &rectangle(14., 4., 10., 10.));
        assert_eq!(g, Gap { distance: 4.0, from: Point::new(10., 7.), to: Point::new(14., 7.) });
        let turn = Frame::new(0.0, 0.0, 0.0, Deg::of(20.0));
        let t = gap(
            &rectangle(0., 0., 10., 10.).placed(&turn),
            &rectangle(14., 4., 10., 10.).placed(&turn),
        );
        near(t.distance, 4.0);
        near((t.from - turn.apply(g.from)).norm(), 0.0);
    }

    #[test]
    fn a_thing_in_the_notch_has_a_gap_to_each_side() {
        near(gap(&cup(), &turned(&rectangle(12., 12., 6., 6.), 0.0)).distance, 2.0);
        near(gap(&turned(&cup(), 45.0), &turned(&rectangle(12., 12., 6., 6.), 45.0)).distance, 2.0);
    }

    #[test]
    fn facing_overlap_is_a_share_of_the_shorter_side() {
        let a = rectangle(0., 0., 10., 40.);
        near(facing_overlap(&a, &rectangle(20., 30., 10., 20.)), 0.5);
        near(facing_overlap(&a, &rectangle(20., 50., 10., 20.)), 0.0);
        let (a, b) = (turned(&a, 17.0), turned(&rectangle(20., 30., 10., 20.), 17.0));
        near(facing_overlap(&a, &b), 0.5);
    }

    #[test]
    fn escape_measures_what_sticks_out() {
        let shelf = [rectangle(0., 0., 80., 30.)];
        near(escape(&rectangle(10., 5., 20., 20.), &[&shelf[0]]), 0.0);
        near(escape(&rectangle(10., 5., 20., 28.), &[&shelf[0]]), 3.0);
        // A lid over the cup: its ends lie on the arms, its middle over the notch.
        let lid = rectangle(1., 15., 28., 4.);
        assert!(escape(&lid, &[&cup()]) >= 4.9);
        // Two halves make a whole.
        let halves = [rectangle(0., 0., 40., 30.), rectangle(40., 0., 40., 30.)];
        near(escape(&rectangle(30., 5., 20., 20.), &halves.each_ref()), 0.0);
    }

    #[test]
    fn an_outline_fills_the_hole_of_a_frame() {
        let sides = [(0., 0., 40., 2.), (0., 28., 40., 2.), (0., 0., 2., 30.), (38., 0., 2., 30.)]
            .map(|(x, y, w, h)| rectangle(x, y, w, h).polygon);
        let found = outline(&sides.each_ref());
        assert_eq!(found.len(), 1);
        near(found[0].signed_area(), 1200.0);
    }

    #[test]
    fn what_stands_between() {
        let (from, to) = (Point::new(-5., 15.), Point::new(35., 15.));
        near(length_within(from, to, &cup()), 20.0);
        assert!(!stays_within(from, to, &[&cup()], 0.1));
        assert!(stays_within(Point::new(1., 5.), Point::new(29., 5.), &[&cup()], 0.1));
    }

    #[test]
    fn the_interior_point_of_a_cup_is_in_it() {
        let p = turned(&cup(), 12.0).interior_point();
        assert!(turned(&cup(), 12.0).polygon.contains(p, 0.0));
    }

    /// Corners around a centre at growing angles: simple, seldom convex.
    fn star() -> impl Strategy<Value = Footprint> {
        (3usize..9, -40.0..40.0f64, -40.0..40.0f64)
            .prop_flat_map(|(n, x, y)| (prop::collection::vec(5.0..40.0f64, n), Just((x, y))))
            .prop_map(|(radii, (x, y))| {
                let n = radii.len() as f64;
                let corner = |(i, r): (usize, &f64)| {
                    let angle = i as f64 / n * std::f64::consts::TAU;
                    (x + r * angle.cos(), y + r * angle.sin())
                };
                polygon(&radii.iter().enumerate().map(corner).collect::<Vec<_>>())
            })
    }

    proptest! {
        #[test]
        fn clipping_agrees_with_the_general_overlay(a in star(), b in star()) {
            let general = total_area(&corners(&a.polygon).overlay_as::<i64>(
                &corners(&b.polygon), OverlayRule::Intersect, FillRule::NonZero));
            prop_assert!((overlap_area(&a, &b) - general).abs() < 1e-3);
            prop_assert!((overlap_area(&a, &b) - overlap_area(&b, &a)).abs() < 1e-3);
        }

        #[test]
        fn the_gap_is_the_least_distance_of_border_points(a in star(), b in star()) {
            let found = gap(&a, &b);
            let samples = |f: &Footprint| f.polygon.edges()
                .flat_map(|(p, q)| (0..40).map(move |i| p + (q - p) * (f64::from(i) / 40.0)))
                .collect::<Vec<_>>();
            let slow = samples(&a).iter().map(|&p| b.distance_to(p))
                .chain(samples(&b).iter().map(|&p| a.distance_to(p)))
                .fold(f64::INFINITY, f64::min);
            prop_assert!(found.distance <= slow + 1e-6 && slow <= found.distance + 2.0);
            prop_assert!((gap(&b, &a).distance - found.distance).abs() < 1e-6);
            prop_assert!((found.distance - (found.to - found.from).norm()).abs() < 1e-6);
        }

        #[test]
        fn nothing_escapes_from_the_hull(a in star(), b in star()) {
            let corners = a.polygon.corners.iter().chain(&b.polygon.corners).copied();
            let hull = Polygon::new(convex_hull(corners.collect()));
            prop_assert!(hull.is_convex(1e-9));
            let hull = [Footprint::new(hull)];
            prop_assert!(escape(&a, &[&hull[0]]) < 1e-6);
            prop_assert!(escape(&b, &[&hull[0]]) < 1e-6);
        }
    }
}
