//! Pairs of lines and where they meet: what of a view names the poses from which it may have been taken (SPEC V19, L3).
//!
//! Two lines that are not parallel fix a pose but for four turnings. A corner of the scan, its lines taken in one order
//! and sense, is held against the corners of the faces in every order and sense that turns the same way; what was seen
//! of each line must lie on the face, as far as it is known from their meeting.
//!
//! ```text
//!        │ second            places along each line are counted from the meeting ×,
//!        │                   positive along its sense; first → second turns
//!   × ───┼──── first         counter-clockwise by `turn`
//! ```

use nalgebra::{Isometry2, Vector2};

use crate::faces::Face;

/// Sine of the least angle between two lines that fix a pose.
const SLANT: f64 = 0.5;
/// Shortest face that is held for a line, in cm.
const SHORTEST: f64 = 20.0;
/// Farthest that a face may end from where it would meet another, in cm; less where there are too many.
const REACHES: [f64; 5] = [1000.0, 500.0, 250.0, 100.0, 30.0];
/// Entries of an index.
const MOST: usize = 300_000;
/// Gaps over which faces are one line, in cm.
const JOINED: f64 = 150.0;
/// More faces are not joined: each is held against each line.
const MOST_JOINED: usize = 10_000;
/// By how much turns may differ, in rad.
const TURN: f32 = 0.12;
/// By how much a place may be off, in cm.
const OFF: f32 = 30.0;

/// Where two lines meet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corner {
    at: [f32; 2],
    /// Of the first line, in rad.
    heading: f32,
    /// From the first to the second, in rad.
    turn: f32,
    first: [f32; 2],
    second: [f32; 2],
}

/// All corners of some faces.
#[derive(Debug, Clone)]
pub(crate) struct Corners {
    all: Vec<Corner>,
    /// How far from their meeting the faces may end, in cm.
    pub(crate) reach: f64,
}

impl Corners {
    pub(crate) fn new(faces: &[Face]) -> Self {
        let faces = &lines(faces);
        let mut order: Vec<usize> =
            (0..faces.len()).filter(|k| faces[*k].length() >= SHORTEST).collect();
        let left = |k: usize| faces[k].start.x.min(faces[k].end.x);
        order.sort_by(|a, b| left(*a).total_cmp(&left(*b)));
        let (mut all, mut widest) = (Vec::new(), 0.0);
        for reach in REACHES {
            all.clear();
            widest = reach;
            if gather(faces, &order, reach, &mut all) {
                break;
            }
        }
        Self { all, reach: widest }
    }

    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }

    /// The poses from which `seen` would be one of these corners.
    pub(crate) fn poses<'a>(
        &'a self,
        seen: &'a Corner,
    ) -> impl Iterator<Item = Isometry2<f64>> + 'a {
        let holds = |of: [f32; 2], part: [f32; 2]| {
            let shared = of[1].min(part[1]) - of[0].max(part[0]);
            shared + OFF >= 0.6 * (part[1] - part[0]) + 0.4 * OFF
        };
        let first_is_longer = seen.first[1] - seen.first[0] >= seen.second[1] - seen.second[0];
        self.all.iter().filter_map(move |known| {
            let off = known.turn - seen.turn;
            if off.abs() > TURN
                || !holds(known.first, seen.first)
                || !holds(known.second, seen.second)
            {
                return None;
            }
            let turn = known.heading - seen.heading + if first_is_longer { 0.0 } else { off };
            let turned = Isometry2::rotation(f64::from(turn));
            let place = |c: &Corner| Vector2::new(f64::from(c.at[0]), f64::from(c.at[1]));
            let shift = place(known) - turned * place(seen);
            Some(Isometry2::new(shift, f64::from(turn)))
        })
    }
}

/// Faces of one line, joined over gaps as wide as doorways: a scan may see as one what the Map has in pieces.
fn lines(faces: &[Face]) -> Vec<Face> {
    let mut order: Vec<&Face> = faces.iter().collect();
    order.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let mut lines: Vec<Face> = Vec::new();
    for face in order {
        let own = lines.iter_mut().filter(|_| faces.len() <= MOST_JOINED).find_map(|line| {
            let (t, length) = (line.direction(), line.length());
            let off = |p: &Vector2<f64>| t.perp(&(p - line.start)).abs();
            let places = [face.start, face.end].map(|p| t.dot(&(p - line.start)));
            let (low, high) = (places[0].min(places[1]), places[0].max(places[1]));
            let is_one = t.perp(&face.direction()).abs() < 0.05
                && off(&face.start).max(off(&face.end)) < 6.0
                && low < length + JOINED
                && high > -JOINED;
            is_one.then_some((line, t, low, high, length))
        });
        match own {
            Some((line, t, low, high, length)) => {
                let start = line.start;
                line.start = start + t * low.min(0.0);
                line.end = start + t * high.max(length);
            }
            None => lines.push(*face),
        }
    }
    lines
}

/// Corners of faces that end within `reach` of their meeting; false when they are too many.
fn gather(faces: &[Face], order: &[usize], reach: f64, all: &mut Vec<Corner>) -> bool {
    for (k, &one) in order.iter().enumerate() {
        let a = &faces[one];
        let right = a.start.x.max(a.end.x) + 2.0 * reach;
        for &two in &order[k + 1..] {
            let b = &faces[two];
            if b.start.x.min(b.end.x) > right {
                break;
            }
            if let Some(corner) = Corner::of((a.start, a.end), (b.start, b.end), reach) {
                all.extend(corner.variants());
                if all.len() > MOST {
                    return false;
                }
            }
        }
    }
    true
}

impl Corner {
    /// Of two pieces of lines, which end within `reach` of their meeting; counter-clockwise from first to second.
    pub(crate) fn of(
        (a, b): (Vector2<f64>, Vector2<f64>),
        (c, d): (Vector2<f64>, Vector2<f64>),
        reach: f64,
    ) -> Option<Self> {
        let (u, mut v) = ((b - a).try_normalize(1e-9)?, (d - c).try_normalize(1e-9)?);
        let mut sine = u.perp(&v);
        if sine.abs() < SLANT {
            return None;
        }
        if sine < 0.0 {
            v = -v;
            sine = -sine;
        }
        let meeting = a + u * ((c - a).perp(&v) / sine);
        let interval = |p: Vector2<f64>, q: Vector2<f64>, along: Vector2<f64>| {
            let (s, t) = ((p - meeting).dot(&along), (q - meeting).dot(&along));
            [s.min(t) as f32, s.max(t) as f32]
        };
        let (first, second) = (interval(a, b, u), interval(c, d, v));
        let near = |i: [f32; 2]| i[0] <= reach as f32 && i[1] >= -(reach as f32);
        let turn = sine.atan2(u.dot(&v)) as f32;
        let at = [meeting.x as f32, meeting.y as f32];
        let corner = Self { at, heading: u.y.atan2(u.x) as f32, turn, first, second };
        (near(first) && near(second)).then_some(corner)
    }

    /// The same corner in every order and sense in which the second line is to the left of the first.
    fn variants(self) -> [Self; 4] {
        let pi = std::f32::consts::PI;
        let back = |i: [f32; 2]| [-i[1], -i[0]];
        let Self { at, heading, turn, first, second } = self;
        let opposite =
            Self { at, heading: heading + pi, turn, first: back(first), second: back(second) };
        let left = Self {
            at,
            heading: heading + turn,
            turn: pi - turn,
            first: second,
            second: back(first),
        };
        let right = Self {
            at,
            heading: heading + turn + pi,
            turn: pi - turn,
            first: back(second),
            second: first,
        };
        [self, opposite, left, right]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Seen from anywhere, and told in any order and sense, a corner leads back to where it was seen from.
        #[test]
        fn a_corner_names_the_pose(
            x in -500.0..500.0, y in -500.0..500.0, turn in -3.0..3.0,
            angle in 0.8..2.3, near in -100.0..100.0, order in 0..2, sense in 0..2, other in 0..2,
        ) {
            let point = |x: f64, y: f64| Vector2::new(x, y);
            let along = point(f64::cos(angle), f64::sin(angle));
            let faces = [
                Face::plain(point(near, 0.0), point(300.0, 0.0)),
                Face::plain(along * 40.0, along * 200.0),
            ];
            let pose = Isometry2::new(point(x, y), turn);
            let local = |p: Vector2<f64>| (pose.inverse() * nalgebra::Point2::from(p)).coords;
            let mut seen = faces.map(|f| (local(f.start), local(f.end)));
            if order == 1 { seen.reverse(); }
            if sense == 1 { seen[0] = (seen[0].1, seen[0].0); }
            if other == 1 { seen[1] = (seen[1].1, seen[1].0); }
            let corner = Corner::of(seen[0], seen[1], 1e4).expect("the lines are not parallel");
            let corners = Corners::new(&faces);
            let found = corners.poses(&corner).any(|found| {
                let off = pose.inverse() * found;
                off.translation.vector.norm() < 0.5 && off.rotation.angle().abs() < 1e-3
            });
            prop_assert!(found);
        }
    }
}
