//! A contour of any source, as segments (SPEC V2): a drawn polyline, an outline of a picture, a row of depths.

use nalgebra::Vector2;

use crate::line::{Line, Sums};
use crate::segment::{Cut, End, Segment, Truth};
use crate::tip::{Meeting, Tip, tip_segment};

/// A point this many deviations off its chord splits it, and two lines meet no farther from their common point.
const SPLIT: f64 = 4.0;
/// Sine of the least angle that makes a corner.
const FLAT: f64 = 0.12;
/// Points beyond are none: their squares would lose what noise tells.
const FARTHEST: f64 = 1e7;

/// How a contour begins and ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// The last point is joined with the first.
    Closed,
    /// What the first point is and what the last.
    Open([End; 2]),
}

/// The segments of a contour whose points each err by `sigma` cm, in its order; no more than one for points nearer to each
/// other than that.
///
/// Iterative end-point fit, then total least squares; neighbours meet in a corner where their lines do, near the point
/// that they share. Points that are not finite, or farther off than 10⁷ cm, and points told twice in a row are passed over.
/// A single point is a segment with equal ends.
#[must_use]
pub fn polyline(points: &[Vector2<f64>], course: Course, sigma: f64) -> Vec<Segment<2>> {
    let fits = |p: &&Vector2<f64>| p.iter().all(|x| x.abs() <= FARTHEST);
    let mut points: Vec<Vector2<f64>> = points.iter().filter(fits).copied().collect();
    points.dedup();
    let sigma = if sigma.is_finite() { sigma.max(1e-6) } else { 1.0 };
    let Some(first) = points.first().copied() else { return Vec::new() };
    if points.len() == 1 {
        let mut point = Segment::given(first, first, sigma);
        if let Course::Open(ends) = course {
            point.ends = ends;
        }
        return vec![point];
    }
    if course == Course::Closed {
        begin_at_a_corner(&mut points);
    }
    fit(&points, course, sigma)
}

/// The point farthest from the middle is a corner, or on a curve.
fn begin_at_a_corner(points: &mut Vec<Vector2<f64>>) {
    if points.first() == points.last() {
        points.pop();
    }
    let middle = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
    let far = |at: &usize| (points[*at] - middle).norm_squared();
    let corner = (0..points.len()).max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0);
    points.rotate_left(corner);
    points.push(points[0]);
}

fn fit(points: &[Vector2<f64>], course: Course, sigma: f64) -> Vec<Segment<2>> {
    let origin = points[0];
    let mut sums = vec![Sums::default()];
    for (at, p) in points.iter().enumerate() {
        sums.push(sums[at].and(p - origin, 1.0));
    }
    let line = |from: usize, to: usize| {
        // What lies at a border may belong to the neighbour; where there are enough points it is left out.
        let spare = usize::from(to - from > 5);
        let mut line = Line::through(&sums, from + spare, to + 1 - spare, sigma * sigma);
        line.centre += origin;
        if (points[to] - points[from]).dot(&line.direction) < 0.0 {
            line.direction = -line.direction;
        }
        line
    };
    let mut vertices = vertices(points, SPLIT * sigma);
    let mut lines: Vec<Line> = vertices.windows(2).map(|pair| line(pair[0], pair[1])).collect();
    chamfers(points, &mut vertices, &mut lines, 3.0 * SPLIT * sigma);
    let last = lines.len() - 1;
    let joint = |one: usize, two: usize, at: usize| {
        let (one, two) = (&lines[one], &lines[two]);
        let room = 3.0 * SPLIT * sigma;
        Meeting::of(one, two, FLAT)
            .filter(|meeting| (meeting.point - points[at]).norm() <= room)
            .map_or_else(
                || {
                    let end = End::Cut(Cut::Unclear);
                    (plain(one, points[at], end, sigma), plain(two, points[at], end, sigma))
                },
                |meeting| meeting.tips(one, two, End::True(Truth::Corner)),
            )
    };
    let (mut start, finish) = match course {
        Course::Closed if last > 0 => {
            let (finish, start) = joint(last, 0, 0);
            (start, finish)
        }
        Course::Closed => {
            let end = End::Cut(Cut::Unclear);
            (
                plain(&lines[0], points[0], end, sigma),
                plain(&lines[0], points[points.len() - 1], end, sigma),
            )
        }
        Course::Open([begin, end]) => (
            plain(&lines[0], points[0], begin, sigma),
            plain(&lines[last], points[points.len() - 1], end, sigma),
        ),
    };
    let mut segments = Vec::with_capacity(lines.len());
    for (at, line) in lines.iter().enumerate() {
        let (end, next) =
            if at == last { (finish, start) } else { joint(at, at + 1, vertices[at + 1]) };
        segments.push(tip_segment(line, &start, &end));
        start = next;
    }
    segments
}

/// A few points between two longer lines that meet beside them are their corner: the split fell some points beside it.
fn chamfers(points: &[Vector2<f64>], vertices: &mut Vec<usize>, lines: &mut Vec<Line>, room: f64) {
    let mut at = 1;
    while at + 1 < lines.len() {
        let count = |piece: usize| vertices[piece + 1] - vertices[piece];
        let near = |p: Vector2<f64>, vertex: usize| (p - points[vertices[vertex]]).norm() <= room;
        let is_corner = count(at) <= 3
            && count(at - 1) > 5
            && count(at + 1) > 5
            && Meeting::of(&lines[at - 1], &lines[at + 1], FLAT)
                .is_some_and(|meeting| near(meeting.point, at) && near(meeting.point, at + 1));
        if is_corner {
            lines.remove(at);
            vertices.remove(at);
        } else {
            at += 1;
        }
    }
}

/// An end at the foot of a point on its line.
fn plain(line: &Line, point: Vector2<f64>, end: End, sigma: f64) -> Tip {
    let place = line.place(point);
    let t = line.direction;
    let own = t * t.transpose() * (sigma * sigma);
    Tip { end, point: line.at(place), place, lever: line.normal(), own }
}

/// First, last, and between them every point that is farthest from its chord, and farther than `room`.
fn vertices(points: &[Vector2<f64>], room: f64) -> Vec<usize> {
    let mut found = vec![0];
    let mut chords = vec![(0, points.len() - 1)];
    while let Some((from, to)) = chords.pop() {
        let (a, b) = (points[from], points[to]);
        let chord = b - a;
        let square = chord.norm_squared();
        let off = |p: Vector2<f64>| {
            let v = p - a;
            if square > 0.0 { chord.perp(&v).abs() / square.sqrt() } else { v.norm() }
        };
        let (mut at, mut farthest) = (from, room);
        for (index, point) in points.iter().enumerate().take(to).skip(from + 1) {
            let distance = off(*point);
            if distance > farthest {
                (at, farthest) = (index, distance);
            }
        }
        if at == from {
            found.push(to);
        } else {
            chords.push((at, to));
            chords.push((from, at));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(corners: &[(f64, f64)]) -> Vec<Vector2<f64>> {
        corners.iter().map(|(x, y)| Vector2::new(*x, *y)).collect()
    }

    #[test]
    fn a_drawn_polyline_is_itself() {
        let drawn = points(&[(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (40.0, 90.0)]);
        let ends = [End::True(Truth::Given), End::Cut(Cut::Field)];
        let segments = polyline(&drawn, Course::Open(ends), 0.1);
        assert_eq!(segments.len(), 3);
        for (segment, pair) in segments.iter().zip(drawn.windows(2)) {
            assert!(
                (segment.start - pair[0]).norm() < 1e-9 && (segment.end - pair[1]).norm() < 1e-9
            );
        }
        let corner = End::True(Truth::Corner);
        let told: Vec<[End; 2]> = segments.iter().map(|s| s.ends).collect();
        assert_eq!(told, [[ends[0], corner], [corner, corner], [corner, ends[1]]]);
    }

    #[test]
    fn a_closed_outline_of_many_points_has_its_corners() {
        let corners = points(&[(0.0, 0.0), (80.0, 10.0), (70.0, 60.0), (5.0, 40.0)]);
        let mut dense = Vec::new();
        for at in 0..4 {
            let (a, b) = (corners[at], corners[(at + 1) % 4]);
            // Zigzag of a quarter of a cm.
            dense.extend((0..40).map(|k| {
                let share = f64::from(k) / 40.0;
                let n = Vector2::new(-(b - a).y, (b - a).x).normalize();
                a + (b - a) * share + n * if k % 2 == 0 { 0.25 } else { -0.25 }
            }));
        }
        let segments = polyline(&dense, Course::Closed, 0.25);
        assert_eq!(segments.len(), 4);
        for segment in segments {
            assert!(segment.is_whole());
            let off = corners.iter().map(|c| (c - segment.start).norm()).fold(f64::MAX, f64::min);
            assert!(off < 0.3, "{off}");
        }
    }

    #[test]
    fn odd_points_make_no_trouble() {
        let odd =
            points(&[(f64::NAN, 0.0), (1e300, 2.0), (3.0, 3.0), (3.0, 3.0), (f64::INFINITY, 1.0)]);
        assert_eq!(polyline(&odd, Course::Closed, 1.0).len(), 1);
        assert!(polyline(&odd[..2], Course::Closed, 1.0).is_empty());
        let there_and_back = points(&[(0.0, 0.0), (5.0, 0.0), (0.0, 0.0)]);
        for sigma in [0.0, f64::NAN, 1e9] {
            for segment in polyline(&there_and_back, Course::Closed, sigma) {
                assert!(segment.start.iter().chain(&segment.end).all(|x| x.is_finite()));
            }
        }
    }
}
