//! Where the centre of a disc may be, and what the disc then covers: offsets of polygons.
//!
//! The shrunken floor is the floor less the disc's reach round every wall. Each edge is moved to the inside by
//! the radius; the ends of neighbouring edges are joined round an obstacle's corner by tangents of the circle,
//! in a corner of the room through the corner itself:
//!
//! ```text
//!    obstacle │ b' ...            room │   b''
//!     ────────b    \ tangents          │   │      the curve goes b', b, b'': it runs round
//!             ╎     \                  b───┼──    both edges' reaches once more, and a point
//!             ╎- - - b''               │   │      that it does not wind around is in neither
//! ```
//!
//! The curve's winding number at a point is then the floor's own, less one for every edge and corner that the
//! disc would touch there. So "winds around at least once" is exactly "the disc fits", whatever the shape.
//!
//! **Invariant**: tangents stand outside the circle, so that a centre never comes nearer to a wall than the
//! radius; they exceed it by 0.9 % at most.

use std::f64::consts::PI;

use crate::units::{Point, Vector};

use super::buckets::Buckets;
use super::grid::{Contour, Grid, Region};
use super::{Bounds, Polygon};

/// The widest turn that one tangent takes, in radians: 15°.
const ARC_STEP: f64 = PI / 12.0;

/// Contours that wind once around the places of a disc's centre from which the disc lies within `floor`, and
/// around all others less often.
pub(super) fn shrink(grid: &Grid, floor: &[Region], radius: f64) -> Vec<Contour> {
    let curve = |contour: &Polygon| offset_curve(grid, contour, radius, shrink_joint);
    floor.iter().flat_map(Region::contours).map(curve).collect()
}

/// Everything that the disc covers from `centres`, which are `floor` shrunk by `radius`; to be cut to that floor.
///
/// Where a corner of the floor kept the disc away, the corner itself is given back, since a gap is what has two
/// sides. Where two obstacles did, the line from one to the other closes the gap between them: straight, or with
/// a bend for every 60° by which the disc bulges into the gap. An edge that is a tangent at an obstacle's corner
/// returns to that corner, so that nothing of the tangents is left.
pub(super) fn grow(grid: &Grid, centres: &[Region], radius: f64, floor: &[Region]) -> Vec<Contour> {
    let corners = CornerSet::of(floor, radius * (ARC_STEP / 2.0).tan() + TOUCH);
    let curve = |contour: &Polygon| {
        offset_curve(grid, contour, -radius, |at, start, end, turn| {
            // The moved edge's end, or the corner that the edge is a tangent at.
            let touched = |end: Vector| {
                let on_edge = |c: Point| (c - at - end).dot(&end).abs() <= TOUCH * radius;
                corners.find(at + end, on_edge).map_or(end, |c| c - at)
            };
            if turn > 0.0 && turn < 2.1 {
                let apex = at + rotated(start, turn / 2.0) / (turn / 2.0).cos();
                if let Some(c) = corners.find(apex, |c| (c - apex).norm() <= TOUCH) {
                    return vec![c - at];
                }
            }
            let (from, to) = (touched(start), touched(end));
            match (turn > 0.0, from == to) {
                (_, true) => vec![from],
                (true, false) => {
                    let steps = (turn / MOUTH_STEP).ceil().max(1.0);
                    let between = |k: usize| rotated(start, turn * k as f64 / steps);
                    let arc = (1..steps as usize).map(between);
                    std::iter::once(from).chain(arc).chain([to]).collect()
                }
                (false, false) => vec![from, Vector::zeros(), to],
            }
        })
    };
    centres.iter().flat_map(Region::contours).map(curve).collect()
}

/// The widest turn of the disc that one straight line closes, in radians: it leaves out 13 % of the radius.
const MOUTH_STEP: f64 = PI / 3.0 + 1e-6;

/// Corners nearer than this, in cm, are one.
const TOUCH: f64 = 0.05;

/// Joins the ends of two edges that moved inwards.
fn shrink_joint(_at: Point, start: Vector, end: Vector, turn: f64) -> Vec<Vector> {
    if turn > 0.0 {
        return vec![start, Vector::zeros(), end];
    }
    // Rounding must not cost a right angle one tangent more.
    let steps = (turn.abs() / ARC_STEP - 1e-4).ceil().max(1.0);
    let half = turn / steps / 2.0;
    let tangent = |k: usize| rotated(start, half * (2 * k + 1) as f64) / half.cos();
    // The first and the last tangent are the moved edges' own lines, so their ends need not be named.
    (0..steps as usize).map(tangent).collect()
}

/// Moves a contour to its left by `distance` (to its right if negative). `joint` joins the moved edges at a
/// corner: it is given the corner, both ends relative to it, and the contour's turn to the left.
fn offset_curve(
    grid: &Grid,
    contour: &Polygon,
    distance: f64,
    joint: impl Fn(Point, Vector, Vector, f64) -> Vec<Vector>,
) -> Contour {
    let corners = distinct(&contour.corners);
    let n = corners.len();
    let mut curve = Contour::with_capacity(4 * n);
    for i in 0..n {
        let (before, at, after) = (corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]);
        let (Some(arriving), Some(leaving)) = (direction(before, at), direction(at, after)) else {
            continue;
        };
        let turn = arriving.perp(&leaving).atan2(arriving.dot(&leaving));
        let start = left_of(arriving) * distance;
        let end = left_of(leaving) * distance;
        if turn.abs() < 1e-9 {
            curve.push(grid.node(at + start));
        } else {
            curve.extend(joint(at, start, end, turn).into_iter().map(|v| grid.node(at + v)));
        }
    }
    curve
}

/// The corners of a floor, found by place.
struct CornerSet {
    /// No corner further than this is asked for.
    size: f64,
    corners: Vec<Point>,
    buckets: Buckets,
}

impl CornerSet {
    fn of(floor: &[Region], size: f64) -> Self {
        let corners: Vec<Point> =
            floor.iter().flat_map(Region::contours).flat_map(|c| &c.corners).copied().collect();
        let boxes: Vec<Bounds> =
            corners.iter().map(|&c| Bounds { min: c, max: c }.grown(size)).collect();
        Self { size, buckets: Buckets::of(&boxes), corners }
    }

    /// The corner nearest to `p` among those that are wanted.
    fn find(&self, p: Point, wanted: impl Fn(Point) -> bool) -> Option<Point> {
        self.buckets
            .near(p)
            .iter()
            .map(|&i| self.corners[i as usize])
            .filter(|&c| (c - p).norm() <= self.size && wanted(c))
            .min_by(|a, b| (a - p).norm_squared().total_cmp(&(b - p).norm_squared()))
    }
}

/// The corners without repetitions.
fn distinct(corners: &[Point]) -> Vec<Point> {
    let mut kept: Vec<Point> = corners.to_vec();
    kept.dedup();
    while kept.len() > 1 && kept.first() == kept.last() {
        kept.pop();
    }
    kept
}

fn direction(from: Point, to: Point) -> Option<Vector> {
    (to - from).try_normalize(0.0)
}

fn left_of(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

fn rotated(v: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    Vector::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::grid::{Shapes, positive};

    fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Polygon {
        Polygon::new(vec![
            Point::new(x, y),
            Point::new(x + w, y),
            Point::new(x + w, y + h),
            Point::new(x, y + h),
        ])
    }

    fn grid() -> Grid {
        Grid::over(&Bounds { min: Point::new(-50.0, -50.0), max: Point::new(450.0, 350.0) })
    }

    fn region(outer: Polygon, holes: &[Polygon]) -> Region {
        let turned = |p: &Polygon| Polygon::new(p.corners.iter().rev().copied().collect());
        Region { outer, holes: holes.iter().map(turned).collect() }
    }

    fn shrunk(floor: &[Region], radius: f64) -> Shapes {
        positive(&shrink(&grid(), floor, radius))
    }

    #[test]
    fn an_empty_room_shrinks_to_a_smaller_one() {
        let shapes = shrunk(&[region(rectangle(0.0, 0.0, 400.0, 300.0), &[])], 30.0);
        let area = grid().regions(&shapes)[0].area();
        assert!((area - 340.0 * 240.0).abs() < 1e-6, "{area}");
    }

    #[test]
    fn a_room_narrower_than_the_disc_shrinks_to_nothing() {
        assert!(shrunk(&[region(rectangle(0.0, 0.0, 400.0, 59.9), &[])], 30.0).is_empty());
    }

    #[test]
    fn the_disc_rolls_round_a_pillar() {
        let pillar = rectangle(180.0, 130.0, 40.0, 40.0);
        let floor = region(rectangle(0.0, 0.0, 400.0, 300.0), std::slice::from_ref(&pillar));
        let shapes = shrunk(&[floor], 30.0);
        let hole = &grid().regions(&shapes)[0].holes[0];
        let blocked = -hole.signed_area();
        let exact = 40.0 * 40.0 + 4.0 * 40.0 * 30.0 + PI * 900.0;
        assert!(blocked > exact && blocked < exact + 20.0, "{blocked} {exact}");
        for &p in &hole.corners {
            assert!(pillar.border_distance(p) > 30.0 - 1e-5);
        }
    }

    #[test]
    fn growing_back_returns_the_room_but_not_its_niche() {
        // A niche 40 wide opens at the right wall; a disc of radius 30 does not fit in.
        let p = |x, y| Point::new(x, y);
        let outer = Polygon::new(vec![
            p(0., 0.),
            p(300., 0.),
            p(300., 130.),
            p(400., 130.),
            p(400., 170.),
            p(300., 170.),
            p(300., 300.),
            p(0., 300.),
        ]);
        let floor = [region(outer, &[])];
        let centres = grid().regions(&shrunk(&floor, 30.0));
        let covered = positive(&grow(&grid(), &centres, 30.0, &floor));
        let area = grid().regions(&covered)[0].area();
        // The disc bulges into the niche by a segment of 209 cm².
        assert!((90_100.0..90_209.0).contains(&area), "{area}");
    }
}
