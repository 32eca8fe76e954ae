//! The walls of one room, and the stretches of them that openings take.
//!
//! Every ring of a room's outline is measured along its length; an opening takes an interval of one ring. An opening
//! in the thickness of a wall gets a bay: the floor of the doorway is given to one of its two rooms.
//!
//! ```text
//!        other room                  foot ┐      ┌ foot      the room that gets the bay
//!      ─────R────L─────              ─────┘R    L└─────
//!       opening on the wall                └────┘            in the face of the other room
//! ```
//!
//! **Invariant.** Intervals of one ring do not overlap; stretches between them, and between them and corners, are
//! longer than [`NEAR`] or nothing.

use crate::map::plane::{doubled_area, segment_distance};
use crate::units::{InOrder as _, Point, Vector};

use super::ring::{NEAR, Region, Ring};

/// Openings turned more than this against a wall do not stand in it: cosine of 36°.
const PARALLEL: f64 = 0.8;
/// Walls that bend less than this carry an opening over the bend: cosine of 20°.
const BEND: f64 = 0.94;
/// How far a bent wall may stand off the opening that spans the bend, cm.
const BULGE: f64 = 6.0;
/// Two sides that differ less coincide, cm: a little under the tolerance of the map's checks.
const SAME: f64 = 0.04;

/// What stands on a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SideUse {
    Wall,
    /// Index of an opening of the level.
    Opening(usize),
}

/// A stretch of wall, seen from within: from the right jamb to the left one, counter-clockwise round the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seat {
    ring: usize,
    /// Along the ring, cm; `to` may lie beyond its length.
    from: f64,
    to: f64,
    pub(super) right: Point,
    pub(super) left: Point,
    /// From the middle of the opening to the wall, cm.
    pub(super) distance: f64,
}

impl Seat {
    pub(super) fn width(&self) -> f64 {
        (self.left - self.right).norm()
    }
}

#[derive(Debug, Clone, PartialEq)]
struct Cut {
    ring: usize,
    from: f64,
    to: f64,
    points: Vec<Point>,
    /// Which of `points` begins the opening's side.
    starts: usize,
    opening: usize,
}

#[derive(Debug, Clone, PartialEq)]
struct Measured {
    ring: Ring,
    /// Distance of each corner from the first one along the ring, cm.
    at: Vec<f64>,
    length: f64,
}

/// A room's walls.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Walls {
    rings: Vec<Measured>,
    cuts: Vec<Cut>,
}

impl Walls {
    pub(super) fn of(region: &Region) -> Self {
        let measured = |ring: &Ring| {
            let mut at = Vec::with_capacity(ring.len());
            let mut length = 0.0;
            for (i, p) in ring.iter().enumerate() {
                at.push(length);
                length += (ring[(i + 1) % ring.len()] - p).norm();
            }
            Measured { ring: ring.clone(), at, length }
        };
        Self { rings: region.rings().map(measured).collect(), cuts: Vec::new() }
    }

    /// The free stretch of wall nearest to an opening from `p` to `q` whose room lies to the left of that direction,
    /// at most `reach` cm off.
    pub(super) fn seat(&self, p: Point, q: Point, reach: f64) -> Option<Seat> {
        let along = (q - p).try_normalize(1e-9)?;
        let (width, middle) = ((q - p).norm(), nalgebra::center(&p, &q));
        let mut best: Option<(f64, usize, usize, f64)> = None;
        for (r, measured) in self.rings.iter().enumerate() {
            for k in 0..measured.ring.len() {
                let (a, b) = measured.side(k);
                let far = a.x.min(b.x) - reach > middle.x
                    || a.x.max(b.x) + reach < middle.x
                    || a.y.min(b.y) - reach > middle.y
                    || a.y.max(b.y) + reach < middle.y;
                if far {
                    continue;
                }
                let Some(v) = (b - a).try_normalize(1e-9) else { continue };
                if v.dot(&along) < PARALLEL {
                    continue;
                }
                let distance = segment_distance(middle, (a, b));
                if distance > reach {
                    continue;
                }
                let (from, to) = ((p - a).dot(&v).max(0.0), (q - a).dot(&v).min((b - a).norm()));
                if to - from < (width / 5.0).min(10.0) {
                    continue;
                }
                let cost = distance + 0.3 * (width - (to - from)).max(0.0);
                if best.is_none_or(|(least, ..)| cost < least) {
                    best = Some((cost, r, k, f64::midpoint(from, to)));
                }
            }
        }
        let (_, r, k, at) = best?;
        self.fit(r, k, at, (p, q), segment_distance(middle, self.rings[r].side(k)))
    }

    /// The interval between the feet of both jambs, as far as the wall runs straight and is free.
    fn fit(
        &self,
        r: usize,
        k: usize,
        at: f64,
        (p, q): (Point, Point),
        distance: f64,
    ) -> Option<Seat> {
        let measured = &self.rings[r];
        let mut from = measured.walk(k, p, false);
        let mut to = measured.walk(k, q, true);
        if measured.bulge(from, to) > BULGE {
            let start = measured.at[k];
            let end = start + measured.side_length(k);
            (from, to) = (from.max(start), to.min(end));
        }
        let middle = measured.at[k] + at;
        for cut in self.cuts.iter().filter(|cut| cut.ring == r) {
            for turn in [-1.0, 0.0, 1.0] {
                let (start, end) =
                    (cut.from + turn * measured.length, cut.to + turn * measured.length);
                if start < middle && middle < end {
                    return None;
                }
                if end <= middle && from < end + 2.0 * NEAR {
                    from = end;
                }
                if start >= middle && to > start - 2.0 * NEAR {
                    to = start;
                }
            }
        }
        let (from, to) = (measured.snap(from), measured.snap(to));
        (to - from > 2.0 * NEAR).then(|| Seat {
            ring: r,
            from,
            to,
            right: measured.point(from),
            left: measured.point(to),
            distance,
        })
    }

    /// Takes a seat for an opening that stands right in the wall.
    pub(super) fn take(&mut self, seat: &Seat, opening: usize) {
        let points = vec![seat.right, seat.left];
        self.cuts.push(Cut {
            ring: seat.ring,
            from: seat.from,
            to: seat.to,
            points,
            starts: 0,
            opening,
        });
    }

    /// Takes a seat for an opening that stands from `right` to `left`, off the wall: with a bay where it must.
    pub(super) fn take_line(&mut self, seat: &Seat, right: Point, left: Point, opening: usize) {
        let (off_right, off_left) = ((right - seat.right).norm(), (left - seat.left).norm());
        if off_right <= SAME && off_left <= SAME {
            self.take(seat, opening);
            return;
        }
        let (mut from, mut to) = (seat.from, seat.to);
        // A reveal must not be shorter than a side may be: its foot moves away from the jamb.
        let (free_from, free_to) = self.room_beside(seat);
        if off_right <= NEAR {
            from -= (3.0 * NEAR).min(free_from);
        }
        if off_left <= NEAR {
            to += (3.0 * NEAR).min(free_to);
        }
        let measured = &self.rings[seat.ring];
        let mut points = Vec::with_capacity(4);
        let foot = measured.point(from);
        if (foot - right).norm() > NEAR {
            points.push(foot);
        }
        let starts = points.len();
        points.extend([right, left]);
        let foot = measured.point(to);
        if (foot - left).norm() > NEAR {
            points.push(foot);
        }
        self.cuts.push(Cut { ring: seat.ring, from, to, points, starts, opening });
    }

    /// Free wall before and after a seat on its own sides, cm.
    fn room_beside(&self, seat: &Seat) -> (f64, f64) {
        let measured = &self.rings[seat.ring];
        let (mut before, mut after) = measured.to_corners(seat.from, seat.to);
        for cut in self.cuts.iter().filter(|cut| cut.ring == seat.ring) {
            before = before.min((seat.from - cut.to).rem_euclid(measured.length));
            after = after.min((cut.from - seat.to).rem_euclid(measured.length));
        }
        (before - 2.0 * NEAR, after - 2.0 * NEAR)
    }

    /// Gives an opening's stretch back.
    pub(super) fn release(&mut self, opening: usize) {
        self.cuts.retain(|cut| cut.opening != opening);
    }

    /// Openings that have a bay here, the last taken first.
    pub(super) fn bays(&self) -> Vec<usize> {
        self.cuts.iter().rev().filter(|cut| cut.points.len() > 2).map(|cut| cut.opening).collect()
    }

    /// Every opening that has a seat here.
    pub(super) fn openings(&self) -> impl Iterator<Item = usize> + '_ {
        self.cuts.iter().map(|cut| cut.opening)
    }

    /// The outline with all openings, each corner with what stands on the side that begins there; the ring that runs
    /// counter-clockwise comes first.
    pub(super) fn outline(&self) -> Vec<Vec<(Point, SideUse)>> {
        (0..self.rings.len()).map(|r| self.ring(r)).collect()
    }

    fn ring(&self, r: usize) -> Vec<(Point, SideUse)> {
        let measured = &self.rings[r];
        let mut cuts: Vec<(f64, &Cut)> = self
            .cuts
            .iter()
            .filter(|cut| cut.ring == r)
            .map(|cut| (cut.from.rem_euclid(measured.length), cut))
            .collect();
        cuts.order_by(|a, b| a.0.total_cmp(&b.0));
        let is_cut = |s: f64| {
            let before = cuts.partition_point(|cut| cut.0 <= s + 1e-6);
            // The cut that begins last before this corner, or the last of all, which may reach over the start.
            let (start, cut) = match before.checked_sub(1) {
                Some(i) => cuts[i],
                None => match cuts.last() {
                    Some(&last) => last,
                    None => return false,
                },
            };
            (s - start + 1e-6).rem_euclid(measured.length) <= cut.to - cut.from + 2e-6
        };
        let mut marks: Vec<(f64, Option<&Cut>, Point)> = measured
            .ring
            .iter()
            .zip(&measured.at)
            .filter(|&(_, &s)| !is_cut(s))
            .map(|(&p, &s)| (s, None, p))
            .collect();
        marks.extend(cuts.iter().map(|&(s, cut)| (s, Some(cut), cut.points[0])));
        marks.order_by(|a, b| a.0.total_cmp(&b.0));
        let mut outline: Vec<(Point, SideUse)> = Vec::with_capacity(marks.len());
        for (_, cut, p) in marks {
            match cut {
                None => outline.push((p, SideUse::Wall)),
                Some(cut) => {
                    for (i, &point) in cut.points.iter().enumerate() {
                        let side = if i == cut.starts {
                            SideUse::Opening(cut.opening)
                        } else {
                            SideUse::Wall
                        };
                        // Openings side by side share a jamb.
                        match outline.last_mut() {
                            Some(last) if (last.0 - point).norm() < 1e-3 => last.1 = side,
                            _ => outline.push((point, side)),
                        }
                    }
                }
            }
        }
        if outline.len() > 1 && (outline[0].0 - outline[outline.len() - 1].0).norm() < 1e-3 {
            outline.pop();
        }
        outline
    }
}

impl Measured {
    fn side(&self, k: usize) -> (Point, Point) {
        (self.ring[k], self.ring[(k + 1) % self.ring.len()])
    }

    fn side_length(&self, k: usize) -> f64 {
        let (a, b) = self.side(k);
        (b - a).norm()
    }

    fn direction(&self, k: usize) -> Vector {
        let (a, b) = self.side(k);
        (b - a).try_normalize(1e-12).unwrap_or_default()
    }

    /// The foot of a jamb on side `k`, or further on over slight bends; not reduced to the ring's length.
    fn walk(&self, k: usize, jamb: Point, is_forward: bool) -> f64 {
        let n = self.ring.len();
        let (mut k, mut start) = (k, self.at[k]);
        for _ in 0..n.min(64) {
            let (a, _) = self.side(k);
            let (direction, length) = (self.direction(k), self.side_length(k));
            let t = (jamb - a).dot(&direction);
            if is_forward {
                let next = (k + 1) % n;
                if t <= length || self.direction(next).dot(&direction) < BEND {
                    return start + t.clamp(0.0, length);
                }
                let (corner, _) = self.side(next);
                if (jamb - corner).dot(&self.direction(next)) <= 0.0 {
                    return start + length;
                }
                (k, start) = (next, start + length);
            } else {
                let before = (k + n - 1) % n;
                if t >= 0.0 || self.direction(before).dot(&direction) < BEND {
                    return start + t.clamp(0.0, length);
                }
                let (_, corner) = self.side(before);
                if (jamb - corner).dot(&self.direction(before)) >= 0.0 {
                    return start;
                }
                (k, start) = (before, start - self.side_length(before));
            }
        }
        start
    }

    /// How far the corners between two places stand off the straight line, cm.
    fn bulge(&self, from: f64, to: f64) -> f64 {
        let chord = (self.point(from), self.point(to));
        self.between(from, to).map(|p| segment_distance(p, chord)).fold(0.0, f64::max)
    }

    fn between(&self, from: f64, to: f64) -> impl Iterator<Item = Point> + '_ {
        self.ring.iter().zip(&self.at).filter_map(move |(&p, &s)| {
            let ahead = (s - from).rem_euclid(self.length);
            (ahead > 1e-6 && ahead < to - from - 1e-6).then_some(p)
        })
    }

    fn point(&self, s: f64) -> Point {
        let s = s.rem_euclid(self.length);
        let k = self.at.partition_point(|&at| at <= s).saturating_sub(1);
        let ahead = s - self.at[k];
        // A corner is the file's own point, not one computed anew.
        if ahead <= 1e-9 { self.ring[k] } else { self.ring[k] + self.direction(k) * ahead }
    }

    /// Onto a corner that is near.
    fn snap(&self, s: f64) -> f64 {
        let turns = (s / self.length).floor() * self.length;
        let within = s - turns;
        let k = self.at.partition_point(|&at| at <= within).saturating_sub(1);
        let next = self.at.get(k + 1).copied().unwrap_or(self.length);
        if within - self.at[k] <= NEAR {
            turns + self.at[k]
        } else if next - within <= NEAR {
            turns + next
        } else {
            s
        }
    }

    fn to_corners(&self, from: f64, to: f64) -> (f64, f64) {
        let (from, to) = (from.rem_euclid(self.length), to.rem_euclid(self.length));
        let k = self.at.partition_point(|&at| at < from).saturating_sub(1);
        let before = from - self.at[k];
        let next = self.at.partition_point(|&at| at <= to);
        let after = self.at.get(next).copied().unwrap_or(self.length) - to;
        (before.max(0.0), after.max(0.0))
    }
}

/// Whether an outline with openings is still a simple polygon that runs the right way.
pub(super) fn as_region(outline: &[Vec<(Point, SideUse)>]) -> Region {
    let mut rings = outline.iter().map(|ring| ring.iter().map(|&(p, _)| p).collect::<Ring>());
    let outer = rings.next().unwrap_or_default();
    Region { outer, holes: rings.filter(|ring| doubled_area(ring) < 0.0).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room() -> Region {
        let outer = [(0.0, 0.0), (400.0, 0.0), (400.0, 300.0), (0.0, 300.0)];
        Region { outer: outer.map(|(x, y)| Point::new(x, y)).to_vec(), holes: Vec::new() }
    }

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    fn corners(walls: &Walls) -> Vec<(f64, f64)> {
        walls.outline()[0].iter().map(|(p, _)| (p.x, p.y)).collect()
    }

    #[test]
    fn an_opening_on_the_wall_splits_it() {
        let mut walls = Walls::of(&room());
        let seat = walls.seat(p(100.0, 0.0), p(200.0, 0.0), 60.0).expect("on the lower wall");
        assert!(seat.distance < 1e-9);
        walls.take(&seat, 7);
        let outline = &walls.outline()[0];
        assert_eq!(outline[1], (p(100.0, 0.0), SideUse::Opening(7)));
        assert_eq!(outline.len(), 6);
        // The room lies to the right of the opposite direction: that is the upper wall, too far away.
        assert!(walls.seat(p(200.0, 0.0), p(100.0, 0.0), 60.0).is_none());
    }

    #[test]
    fn an_opening_in_a_thick_wall_gets_a_bay() {
        let mut walls = Walls::of(&room());
        let (right, left) = (p(100.0, -20.0), p(200.0, -20.0));
        let seat = walls.seat(right, left, 60.0).expect("near the lower wall");
        walls.take_line(&seat, right, left, 0);
        assert_eq!(
            corners(&walls),
            [
                (0.0, 0.0),
                (100.0, 0.0),
                (100.0, -20.0),
                (200.0, -20.0),
                (200.0, 0.0),
                (400.0, 0.0),
                (400.0, 300.0),
                (0.0, 300.0)
            ]
        );
    }

    #[test]
    fn a_taken_stretch_is_not_taken_again() {
        let mut walls = Walls::of(&room());
        let seat = walls.seat(p(100.0, 0.0), p(200.0, 0.0), 60.0).expect("free");
        walls.take(&seat, 0);
        assert!(walls.seat(p(110.0, 0.0), p(190.0, 0.0), 60.0).is_none());
        let beside = walls.seat(p(180.0, 0.0), p(300.0, 0.0), 60.0).expect("beside");
        assert_eq!((beside.right, beside.left), (p(200.0, 0.0), p(300.0, 0.0)));
        walls.take(&beside, 1);
        assert_eq!(walls.outline()[0].len(), 7, "openings side by side share a jamb");
        walls.release(0);
        assert_eq!(walls.outline()[0].len(), 6);
    }

    #[test]
    fn an_opening_over_the_first_corner_of_the_ring() {
        // The wall is bent by a degree where the ring begins.
        let outer = [(0.0, 0.0), (200.0, 1.0), (200.0, 300.0), (-200.0, 300.0), (-200.0, 1.0)];
        let region =
            Region { outer: outer.map(|(x, y)| Point::new(x, y)).to_vec(), holes: Vec::new() };
        let mut walls = Walls::of(&region);
        let seat = walls.seat(p(-50.0, 0.0), p(50.0, 0.0), 60.0).expect("over the bend");
        assert!((seat.width() - 100.0).abs() < 0.1);
        walls.take(&seat, 0);
        let outline = &walls.outline()[0];
        assert_eq!(outline.len(), 6, "{outline:?}");
        assert!(!outline.iter().any(|(q, _)| *q == p(0.0, 0.0)));
    }
}
