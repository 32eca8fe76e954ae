//! Outlines as files have them: what a reader must know of a ring of points before the assembler sees it.
//!
//! Lengths are cm. Nothing here judges whether a ring is a sound base; the checks of [`crate::map`] do.

use crate::units::{Cm, Point};

/// A ring with more corners than this, after thinning, is no room.
pub(super) const MOST_CORNERS: usize = 4000;
/// Corners nearer than this to the one before are the same corner.
const SAME: f64 = 0.5;

/// The ring without its closing point and without corners that repeat the one before; none when a number is no
/// length or less than a triangle is left.
pub(super) fn ring(points: impl IntoIterator<Item = Point>) -> Option<Vec<Point>> {
    let mut ring: Vec<Point> = Vec::new();
    for p in points {
        if Cm::new(p.x).is_err() || Cm::new(p.y).is_err() {
            return None;
        }
        if ring.last().is_none_or(|last| (p - last).norm() > SAME) {
            ring.push(p);
        }
    }
    while ring.len() > 1 && (ring[0] - ring[ring.len() - 1]).norm() <= SAME {
        ring.pop();
    }
    (ring.len() >= 3 && area(&ring).abs() > 1.0).then_some(ring)
}

/// Signed: positive when the ring runs counter-clockwise. In cm².
pub(super) fn area(ring: &[Point]) -> f64 {
    edges(ring).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>() / 2.0
}

pub(super) fn edges(ring: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// The middle of the corners' bounding box.
pub(super) fn middle(points: &[Point]) -> Point {
    let (low, high) = bounds(points);
    low + (high - low) / 2.0
}

pub(super) fn bounds(points: &[Point]) -> (Point, Point) {
    let (inf, low) = (f64::INFINITY, f64::NEG_INFINITY);
    points.iter().fold((Point::new(inf, inf), Point::new(low, low)), |(a, b), p| {
        (Point::new(a.x.min(p.x), a.y.min(p.y)), Point::new(b.x.max(p.x), b.y.max(p.y)))
    })
}

/// Even-odd rule; a point on the border may fall either way.
pub(super) fn contains(ring: &[Point], p: Point) -> bool {
    edges(ring)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y))
        .filter(|(a, b)| p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
        .count()
        % 2
        == 1
}

/// The middle line of a long thin ring: along its longest edge, as long as the ring is that way.
pub(super) fn long_axis(ring: &[Point]) -> Option<[Point; 2]> {
    let (a, b) = edges(ring)
        .max_by(|x, y| (x.1 - x.0).norm_squared().total_cmp(&(y.1 - y.0).norm_squared()))?;
    let along = (b - a).try_normalize(f64::EPSILON)?;
    let across = crate::units::Vector::new(-along.y, along.x);
    let span = |axis: crate::units::Vector| {
        let along = ring.iter().map(|p| (p - a).dot(&axis));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
    };
    let ((from, to), (low, high)) = (span(along), span(across));
    let start = a + across * (low.midpoint(high));
    Some([start + along * from, start + along * to])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point> {
        list.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn a_ring_loses_its_closing_point_and_repetitions() {
        let closed = points(&[(0., 0.), (0., 0.1), (100., 0.), (100., 50.), (0., 0.)]);
        assert_eq!(ring(closed), Some(points(&[(0., 0.), (100., 0.), (100., 50.)])));
        assert_eq!(ring(points(&[(0., 0.), (100., 0.), (0., 0.)])), None);
        assert_eq!(ring(points(&[(0., 0.), (f64::NAN, 0.), (9., 9.)])), None);
    }

    #[test]
    fn the_axis_of_a_door_leaf_runs_along_the_wall() {
        let leaf = points(&[(0., 0.), (90., 0.), (90., 10.), (0., 10.)]);
        assert_eq!(long_axis(&leaf), Some([Point::new(90., 5.), Point::new(0., 5.)]));
    }
}
