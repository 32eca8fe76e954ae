//! Whether a point is in view of an eye: what stands between them, in space.
//!
//! **Invariant**: walls and leaves hide whatever their height; a prism hides only where the ray is within its height.

use crate::geometry::Prism;
use crate::units::Point;

/// What may hide things.
pub(super) struct View<'s> {
    /// Walls and door leaves.
    pub walls: Vec<(Point, Point)>,
    pub bodies: Vec<&'s Prism>,
}

/// A point of the floor plan and a height, cm.
pub(super) type Spot = (Point, f64);

impl View<'_> {
    /// A thing within a body (a book in a shelf drawn as one block) is not hidden by that body.
    pub(super) fn is_clear(&self, eye: Spot, goal: Spot) -> bool {
        self.walls.iter().all(|&(a, b)| crossing(eye.0, goal.0, a, b).is_none())
            && self
                .bodies
                .iter()
                .filter(|p| !p.polygon.contains(goal.0, 0.0) || goal.1 <= p.bottom)
                .all(|p| !hides(p, eye, goal))
    }
}

fn hides(prism: &Prism, eye: Spot, goal: Spot) -> bool {
    let mut at: Vec<f64> =
        prism.polygon.edges().filter_map(|(a, b)| crossing(eye.0, goal.0, a, b)).collect();
    if prism.polygon.contains(eye.0, 0.0) {
        at.push(0.0);
    }
    if prism.polygon.contains(goal.0, 0.0) {
        at.push(1.0);
    }
    at.sort_by(f64::total_cmp);
    let height = |t: f64| eye.1 + (goal.1 - eye.1) * t;
    at.windows(2).any(|w| {
        let middle = eye.0 + (goal.0 - eye.0) * ((w[0] + w[1]) / 2.0);
        let (low, high) = (height(w[0]).min(height(w[1])), height(w[0]).max(height(w[1])));
        prism.polygon.contains(middle, 0.0) && low < prism.top && high > prism.bottom
    })
}

/// Where along the ray, from 0 to 1, it meets a segment.
fn crossing(from: Point, to: Point, a: Point, b: Point) -> Option<f64> {
    let (ray, edge, gap) = (to - from, b - a, a - from);
    let cross = ray.x * edge.y - ray.y * edge.x;
    if cross.abs() < 1e-12 {
        return None;
    }
    let along = (gap.x * edge.y - gap.y * edge.x) / cross;
    let across = (gap.x * ray.y - gap.y * ray.x) / cross;
    ((0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across)).then_some(along)
}
