//! How far polygons and segments are from each other in the plan, in cm; 0 where they meet.

use crate::units::Point;

use super::{Bounds, Polygon, nearest_on_segment};

/// Distance between two polygons, 0 where they meet. Two corners make a segment.
pub(super) fn distance(a: &Polygon, b: &Polygon) -> f64 {
    distance_within(a, b, f64::INFINITY).unwrap_or(f64::INFINITY)
}

/// Distance between two polygons if it is less than a limit.
pub(super) fn distance_within(a: &Polygon, b: &Polygon, limit: f64) -> Option<f64> {
    let inside = |p: &Polygon, q: &Polygon| {
        p.corners.len() > 2 && q.corners.first().is_some_and(|&c| p.winds_around(c))
    };
    if inside(a, b) || inside(b, a) {
        return Some(0.0);
    }
    let mut least = limit;
    let whole = b.bounds();
    for (p, q) in a.edges() {
        // Edges whose boxes are further away than the nearest so far bring nothing nearer.
        let edge = Bounds::of([p, q]).grown(least);
        if !edge.meets(&whole) {
            continue;
        }
        for (u, v) in b.edges() {
            if Bounds::of([u, v]).meets(&edge) {
                least = least.min(segment_distance(p, q, u, v));
            }
        }
    }
    (least < limit).then_some(least)
}

pub(super) fn segment_distance(p: Point, q: Point, u: Point, v: Point) -> f64 {
    let side = |a: Point, b: Point, c: Point| (b - a).perp(&(c - a));
    let crosses = side(p, q, u) * side(p, q, v) < 0.0 && side(u, v, p) * side(u, v, q) < 0.0;
    if crosses {
        return 0.0;
    }
    [
        (p - nearest_on_segment(p, u, v)).norm(),
        (q - nearest_on_segment(q, u, v)).norm(),
        (u - nearest_on_segment(u, p, q)).norm(),
        (v - nearest_on_segment(v, p, q)).norm(),
    ]
    .into_iter()
    .fold(f64::INFINITY, f64::min)
}
