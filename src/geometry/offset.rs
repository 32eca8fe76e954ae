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
//! Where both edges of a room's corner are long enough, the curve takes the short cut from edge to edge, the point
//! where the moved edges meet. The loop b', b, b'' that it leaves out lies within both edges' reaches, so that the
//! curve wound around its points minus once at most, and now not at all: they stay out, and nothing else changes.
//!
//! Tangents' corners stick out of the circle and would close a gap that the disc just fits through. So where
//! something else stands opposite to a corner in just that distance, one tangent faces it squarely: gaps are exactly
//! as wide as they are.
//!
//! **Invariant**: tangents stand outside the circle, so that a centre never comes nearer to a wall than the
//! radius; they exceed it by 1.3 % at most, and not at all where a gap is narrowest.

use std::f64::consts::PI;

use crate::units::{Point, Vector};

use super::buckets::Buckets;
use super::grid::{Contour, Grid, Region};
use super::{Bounds, Polygon, nearest_on_segment};

/// The widest turn that one tangent takes, in radians: 18°.
const ARC_STEP: f64 = PI / 10.0;

/// Contours that wind once around the places of a disc's centre from which the disc lies within `floor`, and
/// around all others less often.
pub(super) fn shrink(grid: &Grid, floor: &[Region], radius: f64) -> Vec<Contour> {
    let opposite = Opposite::of(floor, radius);
    let joint = |corner: &Corner, out: &mut Vec<Vector>| shrink_joint(corner, &opposite, out);
    let curve = |contour: &Polygon| offset_curve(grid, contour, radius, joint);
    floor.iter().flat_map(Region::contours).map(curve).collect()
}

/// The edges of a floor, for what stands opposite to its corners.
struct Opposite {
    edges: Vec<(Point, Point)>,
    buckets: Buckets,
    radius: f64,
}

impl Opposite {
    /// How far apart two things can be between which tangents would close a gap, in radii.
    fn furthest() -> f64 {
        2.0 / (ARC_STEP / 2.0).cos()
    }

    fn of(floor: &[Region], radius: f64) -> Self {
        let edges: Vec<(Point, Point)> =
            floor.iter().flat_map(Region::contours).flat_map(Polygon::edges).collect();
        let boxes: Vec<Bounds> = edges.iter().map(|&(a, b)| Bounds::of([a, b])).collect();
        Self { edges, buckets: Buckets::of(&boxes), radius }
    }

    /// Turns from the corner's first moved edge, in radians, at which something stands so near beyond a gap that
    /// tangents could close it; sorted, and less than `turn`.
    fn turns(&self, corner: &Corner, turn: f64) -> Vec<f64> {
        const APART: f64 = 1e-3;
        let Corner { at, start, end, .. } = *corner;
        let (least, most) = (2.0 * self.radius - 0.01, Self::furthest() * self.radius + 0.01);
        let scale = most / self.radius;
        let reach = if corner.cosine > -0.5 {
            let ends = [Vector::zeros(), start, end, corner.meeting()];
            Bounds::of(ends.map(|v| at + v * scale))
        } else {
            Bounds::of([at]).grown(most)
        };
        let mut turns = Vec::new();
        self.buckets.visit_meeting(&reach, |number| {
            let (a, b) = self.edges[number as usize];
            // With an end nearer than any gap, so is the edge.
            if (a - at).norm_squared() < least * least {
                return;
            }
            let across = nearest_on_segment(at, a, b) - at;
            let square = across.norm_squared();
            if square < least * least || square > most * most {
                return;
            }
            let angle = -start.perp(&across).atan2(start.dot(&across));
            if angle > APART && angle < turn - APART {
                turns.push(angle);
            }
        });
        turns.sort_by(f64::total_cmp);
        turns.dedup_by(|next, last| *next - *last < APART);
        turns
    }
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
        offset_curve(grid, contour, -radius, |corner, out| {
            let Corner { at, start, end, turns_left, .. } = *corner;
            // The moved edge's end, or the corner that the edge is a tangent at.
            let touched = |end: Vector| {
                let on_edge = |c: Point| (c - at - end).dot(&end).abs() <= TOUCH * radius;
                corners.find(at + end, on_edge).map_or(end, |c| c - at)
            };
            if turns_left && corner.cosine > GIVEN_BACK {
                let apex = at + corner.meeting();
                if let Some(c) = corners.find(apex, |c| (c - apex).norm() <= TOUCH) {
                    out.push(c - at);
                    return;
                }
            }
            let (from, to) = (touched(start), touched(end));
            out.push(from);
            if from == to {
                return;
            }
            if turns_left {
                let turn = corner.turn();
                let steps = (turn / MOUTH_STEP).ceil().max(1.0);
                let between = |k: usize| rotated(start, turn * k as f64 / steps);
                out.extend((1..steps as usize).map(between));
            } else {
                out.push(Vector::zeros());
            }
            out.push(to);
        })
    };
    centres.iter().flat_map(Region::contours).map(curve).collect()
}

/// Cosine of the widest turn at a corner that is given back: 120°, corners of regular triangles among them whatever
/// rounding makes of them.
const GIVEN_BACK: f64 = -0.501;

/// The widest turn of the disc that one straight line closes, in radians: it leaves out 13 % of the radius.
const MOUTH_STEP: f64 = PI / 3.0 + 1e-6;

/// A turn with such a sine is none; with a cosine so near to -1 it is straight back.
const STRAIGHT: f64 = 1e-9;

/// Corners nearer than this, in cm, are one.
const TOUCH: f64 = 0.05;

/// Joins the ends of two edges that moved inwards.
fn shrink_joint(corner: &Corner, opposite: &Opposite, out: &mut Vec<Vector>) {
    let Corner { start, end, turns_left, .. } = *corner;
    if turns_left {
        if corner.is_roomy {
            out.push(corner.meeting());
        } else {
            out.extend([start, Vector::zeros(), end]);
        }
        return;
    }
    let turn = corner.turn().abs();
    let mut from = 0.0;
    for to in opposite.turns(corner, turn).into_iter().chain([turn]) {
        // Rounding must not cost a right angle one tangent more.
        let steps = ((to - from) / ARC_STEP - 1e-4).ceil().max(1.0);
        let half = (to - from) / steps / 2.0;
        // Tangents at `from` and `to` are what comes before and after, so their ends need not be named.
        let mut tangent = rotated(start, -from - half) / half.cos();
        let (sin, cos) = (-2.0 * half).sin_cos();
        for _ in 0..steps as usize {
            out.push(tangent);
            tangent = turned(tangent, sin, cos);
        }
        from = to;
    }
}

/// A corner of a contour that is moved.
struct Corner {
    at: Point,
    /// The ends of the moved edges there, relative to it.
    start: Vector,
    end: Vector,
    /// Of the turn to the left.
    sine: f64,
    cosine: f64,
    /// Of two opposite turns back the sign of zero chooses.
    turns_left: bool,
    /// The moved edges reach their meeting point, and what neighbouring corners cut off of them does not overlap.
    is_roomy: bool,
}

impl Corner {
    /// The turn to the left, in radians.
    fn turn(&self) -> f64 {
        self.sine.atan2(self.cosine)
    }

    /// Where the moved edges' lines meet, relative to the corner.
    fn meeting(&self) -> Vector {
        (self.start + self.end) / (1.0 + self.cosine)
    }
}

/// Moves a contour to its left by `distance` (to its right if negative). `joint` joins the moved edges at a corner.
fn offset_curve(
    grid: &Grid,
    contour: &Polygon,
    distance: f64,
    joint: impl Fn(&Corner, &mut Vec<Vector>),
) -> Contour {
    let corners = distinct(&contour.corners, if distance > 0.0 { 0.0 } else { NOISE });
    let n = corners.len();
    // For each edge its length and direction; corners are distinct, so that no length is zero.
    let edge = |i: usize| {
        let along: Vector = corners[(i + 1) % n] - corners[i];
        let length = along.norm();
        (length, along / length)
    };
    let edges: Vec<(f64, Vector)> = if n > 1 { (0..n).map(edge).collect() } else { Vec::new() };
    let turn = |i: usize| {
        let (arriving, leaving) = (edges[(i + n - 1) % n].1, edges[i].1);
        (arriving.perp(&leaving), arriving.dot(&leaving))
    };
    // How much of its edges a turn to the left can cut off.
    let cut = |(sine, cosine): (f64, f64)| {
        if cosine < STRAIGHT - 1.0 {
            // Straight back the moved edges' lines do not meet; by rounding the cosine may even be less than -1.
            f64::INFINITY
        } else if sine <= 0.0 {
            0.0
        } else if cosine >= 0.0 {
            distance.abs() * sine
        } else {
            distance.abs() * sine / (1.0 + cosine)
        }
    };
    let turns: Vec<(f64, f64)> = (0..edges.len()).map(turn).collect();
    let mut curve = Contour::with_capacity(4 * n);
    let mut joined = Vec::new();
    for (i, &(sine, cosine)) in turns.iter().enumerate() {
        let (before, after) = ((i + n - 1) % n, (i + 1) % n);
        let start = left_of(edges[before].1) * distance;
        let end = left_of(edges[i].1) * distance;
        if sine.abs() < STRAIGHT && cosine > 0.0 {
            curve.push(grid.node(corners[i] + start));
            continue;
        }
        let own = cut(turns[i]);
        let is_roomy =
            own + cut(turns[before]) <= edges[before].0 && own + cut(turns[after]) <= edges[i].0;
        let turns_left = sine.is_sign_positive();
        let corner = Corner { at: corners[i], start, end, sine, cosine, turns_left, is_roomy };
        joint(&corner, &mut joined);
        for v in joined.drain(..) {
            let node = grid.node(corners[i] + v);
            if curve.last() != Some(&node) {
                curve.push(node);
            }
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

/// An edge of the centre space so short, in cm, points wherever rounding turned it; grown by the disc's radius, it
/// would cut a crack into the floor.
const NOISE: f64 = 1e-3;

/// The corners without repetitions, and without those that are nearer to the one before.
fn distinct(corners: &[Point], nearer: f64) -> Vec<Point> {
    let is_same = |a: &Point, b: &Point| (a - b).norm() <= nearer;
    let mut kept: Vec<Point> = corners.to_vec();
    kept.dedup_by(|next, last| is_same(next, last));
    while kept.len() > 1 && is_same(&kept[0], &kept[kept.len() - 1]) {
        kept.pop();
    }
    kept
}

fn left_of(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

fn rotated(v: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    turned(v, sin, cos)
}

fn turned(v: Vector, sin: f64, cos: f64) -> Vector {
    Vector::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{Shapes, positive};

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
        assert!(blocked > exact && blocked < exact + 26.0, "{blocked} {exact}");
        for &p in &hole.corners {
            assert!(pillar.border_distance(p) > 30.0 - 1e-5);
        }
    }

    #[test]
    fn a_slit_without_width_shrinks_to_nothing() {
        // From a wall out of the room and straight back: the turn's sine is zero, or nearly, as the room is turned.
        for turn in 0..60 {
            let (sin, cos) = (f64::from(turn) * 0.37).sin_cos();
            let middle = Point::new(200.0, 150.0);
            let corners = [(0.0, 0.0), (400.0, 0.0), (400.0, 300.0), (0.0, 300.0), (0.0, 150.0)];
            let slit = [(-40.0, 150.0), (0.0, 150.0)];
            let at = |(x, y)| middle + turned(Point::new(x, y) - middle, sin, cos);
            let outer = Polygon::new(corners.into_iter().chain(slit).map(at).collect());
            let shapes = shrunk(&[region(outer, &[])], 30.0);
            let area: f64 = grid().regions(&shapes).iter().map(Region::area).sum();
            assert!((area - 340.0 * 240.0).abs() < 1e-2, "{turn}: {area}");
        }
    }

    /// Corners of two pillars, on a slant for which no tangent of the plain arc stands square: the disc passes
    /// if and only if they are further apart than it is wide.
    #[test]
    fn a_gap_between_two_corners_is_as_wide_as_it_is() {
        let walls = rectangle(0.0, 0.0, 400.0, 300.0);
        let (sin, cos) = 0.46_f64.sin_cos();
        for (width, rooms) in [(59.99, 2), (60.01, 1)] {
            let low = rectangle(0.0, 0.0, 180.0, 120.0);
            let (x, y) = (180.0 + width * cos, 120.0 + width * sin);
            let high = rectangle(x, y, 400.0 - x, 300.0 - y);
            let grid = grid();
            let [walls, low, high] = [&walls, &low, &high].map(|p| grid.contour(p));
            let floor = grid.regions(&crate::grid::difference(&[walls], &[low, high]));
            assert_eq!(shrunk(&floor, 30.0).len(), rooms, "{width}");
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
