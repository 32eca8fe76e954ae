//! Centre lines of corridors, found between facing walls.
//!
//! ```text
//!   ┌───────────────────────┐      A piece of lane lies midway between two facing walls. Pieces in one line
//!   │- - - - - -x- - - - - -│      are one lane, across the mouths of branches too. Lanes run on to the next
//!   └─────────┐ ╎ ┌─────────┘      wall and meet where they cross (x). What is left of a lane beyond a
//!             │ ╎ │                crossing is an arm only if walls go with it.
//!             └───┘
//! ```
//!
//! **Invariant**: lanes of one floor shape are connected: where they do not cross, a link joins the nearest two.

use crate::units::{InOrder as _, Point, Vector};

/// A wall of the floor shape, the floor on its left.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wall {
    pub(super) a: Point,
    pub(super) b: Point,
}

/// A straight centre line: points `origin + t * dir`.
#[derive(Debug, Clone)]
pub(super) struct Lane {
    pub(super) origin: Point,
    pub(super) dir: Vector,
    pub(super) width: f64,
    /// Between walls on both sides.
    pub(super) walled: [f64; 2],
    /// As far as the floor goes.
    pub(super) reach: [f64; 2],
}

/// Two lanes meet: each with its own parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    pub(super) lanes: [usize; 2],
    pub(super) t: [f64; 2],
}

/// What was found in one connected shape of floor.
#[derive(Debug)]
pub(super) struct Lanes {
    pub(super) walls: Vec<Wall>,
    pub(super) lanes: Vec<Lane>,
    pub(super) meetings: Vec<Meeting>,
}

/// What makes a corridor and its arms: a table of numbers that whoever looks for corridors gives.
///
/// # Units
/// Lengths in cm, angles in degrees, shares of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Facing walls converge by no more.
    pub parallel: f64,
    /// The shortest corridor; a niche is none.
    pub shortest: f64,
    /// A corridor is at least this many times as long as wide.
    pub slender: f64,
    /// So much of a corridor has walls on both sides; the rest are mouths of branches.
    pub covered: f64,
    /// Facing walls that are shorter than this share of their distance are the ends of something long.
    pub stub: f64,
    /// Two lanes that meet at no more than this angle are one corridor with a bend.
    pub bend: f64,
    /// An arm goes on between walls for more than this beyond its junction.
    pub arm: f64,
    /// A door is straight ahead at the end of a corridor from which it is no farther,
    pub ahead: f64,
    /// no farther beside its middle than this share of its width,
    pub aside: f64,
    /// and turned off it by no more.
    pub askew: f64,
}

impl Default for Shape {
    /// Where no rules say it.
    fn default() -> Self {
        Self {
            parallel: 5.74,
            shortest: 120.0,
            slender: 0.7,
            covered: 0.35,
            stub: 0.25,
            bend: 30.0,
            arm: 80.0,
            ahead: 60.0,
            aside: 0.6,
            askew: 45.57,
        }
    }
}

impl Shape {
    /// Whether a direction turns from another by no more than facing walls do, given the sine of the angle between.
    fn is_parallel(&self, sine: f64) -> bool {
        sine.abs() <= self.parallel.to_radians().sin()
    }
}

impl Lane {
    pub(super) fn at(&self, t: f64) -> Point {
        self.origin + self.dir * t
    }

    /// Parameter and signed offset (positive to the left) of a point.
    pub(super) fn locate(&self, p: Point) -> (f64, f64) {
        let v = p - self.origin;
        (v.dot(&self.dir), self.dir.perp(&v))
    }

    fn length(&self) -> f64 {
        self.walled[1] - self.walled[0]
    }
}

impl Lanes {
    /// The lanes of one shape: its contours, the outer one counter-clockwise, holes clockwise.
    pub(super) fn of(contours: &[Vec<Point>], shape: &Shape) -> Self {
        let walls: Vec<Wall> = contours.iter().flat_map(|c| walls_of(c)).collect();
        let pieces = pieces(&walls, shape);
        let mut lanes = join_pieces(&pieces, &walls, shape);
        if lanes.is_empty() {
            lanes.extend(stoutest(&pieces, &walls));
        }
        for lane in &mut lanes {
            reach_out(lane, &walls);
        }
        let mut found = Self { walls, lanes, meetings: Vec::new() };
        found.find_meetings();
        found.connect();
        found
    }

    /// Distance along a ray to the first wall; infinite where there is none.
    pub(super) fn free_way(&self, from: Point, dir: Vector) -> f64 {
        first_wall(&self.walls, from, dir).map_or(f64::INFINITY, |(r, _)| r)
    }

    fn find_meetings(&mut self) {
        for a in 0..self.lanes.len() {
            for b in a + 1..self.lanes.len() {
                if let Some(t) = crossing(&self.lanes[a], &self.lanes[b]) {
                    self.meetings.push(Meeting { lanes: [a, b], t });
                }
            }
        }
    }

    /// Links lanes that do not cross, nearest first.
    fn connect(&mut self) {
        let mut group: Vec<usize> = (0..self.lanes.len()).collect();
        for meeting in &self.meetings {
            unite(&mut group, meeting.lanes[0], meeting.lanes[1]);
        }
        let mut near = Vec::new();
        for a in 0..group.len() {
            for b in a + 1..group.len() {
                if find(&group, a) != find(&group, b) {
                    let t = nearest(&self.lanes[a], &self.lanes[b]);
                    let gap = (self.lanes[a].at(t[0]) - self.lanes[b].at(t[1])).norm();
                    near.push((gap, [a, b], t));
                }
            }
        }
        near.order_by(|x, y| x.0.total_cmp(&y.0));
        for (gap, [a, b], t) in near {
            if find(&group, a) == find(&group, b) {
                continue;
            }
            unite(&mut group, a, b);
            self.link(gap, [a, b], t);
        }
    }

    fn link(&mut self, gap: f64, [a, b]: [usize; 2], t: [f64; 2]) {
        if gap < 5.0 {
            self.meetings.push(Meeting { lanes: [a, b], t });
            return;
        }
        let (p, q) = (self.lanes[a].at(t[0]), self.lanes[b].at(t[1]));
        let link = self.lanes.len();
        let width = self.lanes[a].width.min(self.lanes[b].width);
        let (walled, reach) = ([0.0, gap], [0.0, gap]);
        self.lanes.push(Lane { origin: p, dir: (q - p) / gap, width, walled, reach });
        self.meetings.push(Meeting { lanes: [a, link], t: [t[0], 0.0] });
        self.meetings.push(Meeting { lanes: [b, link], t: [t[1], gap] });
    }
}

pub(super) fn find(group: &[usize], mut x: usize) -> usize {
    while group[x] != x {
        x = group[x];
    }
    x
}

pub(super) fn unite(group: &mut [usize], a: usize, b: usize) {
    let (a, b) = (find(group, a), find(group, b));
    group[a.max(b)] = a.min(b);
}

/// Edges of a contour, without corners that stand out by less than a centimetre.
fn walls_of(contour: &[Point]) -> Vec<Wall> {
    let mut corners = contour.to_vec();
    let mut at = 0;
    while corners.len() > 3 && at < corners.len() {
        let n = corners.len();
        let (a, p, b) = (corners[(at + n - 1) % n], corners[at], corners[(at + 1) % n]);
        let near = (p - crate::geometry::nearest_on_segment(p, a, b)).norm() < 1.0;
        if near {
            corners.remove(at);
            at = at.saturating_sub(1);
        } else {
            at += 1;
        }
    }
    let n = corners.len();
    (0..n).map(|i| Wall { a: corners[i], b: corners[(i + 1) % n] }).collect()
}

fn first_wall(walls: &[Wall], from: Point, dir: Vector) -> Option<(f64, usize)> {
    let hit = |wall: &Wall| {
        let (along, to) = (wall.b - wall.a, wall.a - from);
        let turn = dir.perp(&along);
        if turn.abs() < 1e-9 {
            return None;
        }
        let (r, s) = (to.perp(&along) / turn, to.perp(&dir) / turn);
        (r > 1e-6 && (-1e-9..=1.0 + 1e-9).contains(&s)).then_some(r)
    };
    let hits = walls.iter().enumerate().filter_map(|(i, wall)| Some((hit(wall)?, i)));
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// A piece of lane between two facing walls.
#[derive(Debug, Clone, Copy)]
struct Piece {
    a: Point,
    b: Point,
    width: f64,
}

impl Piece {
    fn length(&self) -> f64 {
        (self.b - self.a).norm()
    }

    fn dir(&self) -> Vector {
        (self.b - self.a) / self.length()
    }
}

/// Every wall looks across: between neighbouring projections of corners it sees one wall.
fn pieces(walls: &[Wall], shape: &Shape) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    for wall in walls {
        let length = (wall.b - wall.a).norm();
        if length < 5.0 {
            continue;
        }
        let dir = (wall.b - wall.a) / length;
        let inward = Vector::new(-dir.y, dir.x);
        let mut breaks: Vec<f64> = walls.iter().map(|w| (w.a - wall.a).dot(&dir)).collect();
        breaks.retain(|t| *t > 0.0 && *t < length);
        breaks.extend([0.0, length]);
        breaks.sort_by(f64::total_cmp);
        let mut seen: Vec<(usize, Piece)> = Vec::new();
        for pair in breaks.windows(2).filter(|p| p[1] - p[0] > 1.0) {
            let middle = wall.a + dir * f64::midpoint(pair[0], pair[1]);
            let Some((width, other)) = first_wall(walls, middle + inward * 0.01, inward) else {
                continue;
            };
            let facing = walls[other].b - walls[other].a;
            if facing.dot(&dir) >= 0.0 || !shape.is_parallel(facing.perp(&dir) / facing.norm()) {
                continue;
            }
            let across = |t: f64| wall.a + dir * t + inward * (width / 2.0);
            match seen.last_mut() {
                Some((last, piece))
                    if *last == other && (piece.b - across(pair[0])).norm() < 10.0 =>
                {
                    piece.b = across(pair[1]);
                }
                _ => {
                    let piece = Piece { a: across(pair[0]), b: across(pair[1]), width };
                    seen.push((other, piece));
                }
            }
        }
        let broad = |p: &Piece| p.length() >= shape.stub * p.width;
        pieces.extend(seen.into_iter().map(|(_, piece)| piece).filter(broad));
    }
    pieces
}

/// Pieces in one line become one lane; what is wider than long, or runs across a lane, is none.
fn join_pieces(pieces: &[Piece], walls: &[Wall], shape: &Shape) -> Vec<Lane> {
    let mut group: Vec<usize> = (0..pieces.len()).collect();
    for a in 0..pieces.len() {
        for b in a + 1..pieces.len() {
            if find(&group, a) != find(&group, b) && in_line(&pieces[a], &pieces[b], walls, shape) {
                unite(&mut group, a, b);
            }
        }
    }
    let mut lanes: Vec<Lane> = (0..pieces.len())
        .filter(|&i| find(&group, i) == i)
        .map(|root| {
            let members = (0..pieces.len()).filter(|&i| find(&group, i) == root);
            lane_of(&members.map(|i| pieces[i]).collect::<Vec<_>>())
        })
        .filter_map(|(lane, covered)| (covered >= shape.covered * lane.length()).then_some(lane))
        .filter(|lane| lane.length() >= shape.shortest.max(shape.slender * lane.width))
        .collect();
    lanes.order_by(|a, b| (b.length() / b.width).total_cmp(&(a.length() / a.width)));
    let mut kept: Vec<Lane> = Vec::new();
    for lane in lanes {
        if !kept.iter().any(|other| runs_across(&lane, other)) {
            kept.push(lane);
        }
    }
    kept
}

/// The lane of some pieces, and how much of it they cover.
fn lane_of(members: &[Piece]) -> (Lane, f64) {
    let longest = members
        .iter()
        .max_by(|a, b| a.length().total_cmp(&b.length()))
        .expect("a group has a member");
    let (origin, dir) = (longest.a, longest.dir());
    let ends = members.iter().flat_map(|p| [p.a, p.b]).map(|p| (p - origin).dot(&dir));
    let walled =
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(t), high.max(t)]);
    let lane = Lane { origin, dir, width: longest.width, walled, reach: walled };
    let mut spans: Vec<(f64, f64)> = members
        .iter()
        .map(|p| (lane.locate(p.a).0, lane.locate(p.b).0))
        .map(|(a, b)| (a.min(b), a.max(b)))
        .collect();
    spans.order_by(|a, b| a.0.total_cmp(&b.0));
    let (mut covered, mut end) = (0.0, f64::NEG_INFINITY);
    for (low, high) in spans {
        covered += (high - low.max(end)).max(0.0);
        end = end.max(high);
    }
    (lane, covered)
}

fn in_line(a: &Piece, b: &Piece, walls: &[Wall], shape: &Shape) -> bool {
    let dir = a.dir();
    let ratio = a.width / b.width;
    if !shape.is_parallel(dir.perp(&b.dir())) || !(0.6..1.67).contains(&ratio) {
        return false;
    }
    let offset = |p: Point| dir.perp(&(p - a.a)).abs();
    let aside = offset(b.a).min(offset(b.b));
    if aside > 0.25 * a.width.min(b.width) {
        return false;
    }
    // The shortest way between them must not meet a wall.
    let t = |p: Point| (p - a.a).dot(&dir);
    let (low, high) = (t(b.a).min(t(b.b)), t(b.a).max(t(b.b)));
    let length = a.length();
    let (from, to) = if low > length {
        (a.b, if t(b.a) < t(b.b) { b.a } else { b.b })
    } else if high < 0.0 {
        (a.a, if t(b.a) < t(b.b) { b.b } else { b.a })
    } else {
        return true;
    };
    let gap = (to - from).norm();
    if gap < 1.0 {
        return true;
    }
    // From within the one piece into the other, since a piece may end in a wall.
    let along = (to - from) / gap;
    first_wall(walls, from - along, along).is_none_or(|(r, _)| r > gap + 1.5)
}

/// A lane that lies within the width of another one is the other's breadth.
fn runs_across(lane: &Lane, other: &Lane) -> bool {
    let within = |t: f64| {
        let (along, offset) = other.locate(lane.at(t));
        offset.abs() <= 0.55 * other.width
            && along >= other.walled[0] - 1.0
            && along <= other.walled[1] + 1.0
    };
    within(lane.walled[0]) && within(lane.walled[1])
}

/// The one lane of a shape without slender parts: a square lobby, a triangle.
fn stoutest(pieces: &[Piece], walls: &[Wall]) -> Option<Lane> {
    let ratio = |p: &Piece| p.length() / p.width;
    if let Some(piece) = pieces.iter().max_by(|a, b| ratio(a).total_cmp(&ratio(b))) {
        return Some(lane_of(&[*piece]).0);
    }
    let length = |w: &Wall| (w.b - w.a).norm();
    let wall = walls.iter().max_by(|a, b| length(a).total_cmp(&length(b)))?;
    let middle = nalgebra::center(&wall.a, &wall.b);
    let dir = (wall.b - wall.a) / length(wall).max(1e-9);
    let inward = Vector::new(-dir.y, dir.x);
    let (depth, _) = first_wall(walls, middle + inward * 0.01, inward)?;
    let origin = middle + inward * (depth / 2.0);
    Some(Lane { origin, dir, width: depth, walled: [0.0, 0.0], reach: [0.0, 0.0] })
}

fn reach_out(lane: &mut Lane, walls: &[Wall]) {
    let [low, high] = lane.walled;
    let on = |t: f64, dir: Vector| first_wall(walls, lane.at(t), dir).map_or(0.0, |(r, _)| r);
    // From a little inside, since a lane may end in a wall.
    let inset = (0.5_f64).min((high - low) / 2.0);
    let reach =
        [low + inset - on(low + inset, -lane.dir), high - inset + on(high - inset, lane.dir)];
    lane.reach = reach;
}

fn crossing(a: &Lane, b: &Lane) -> Option<[f64; 2]> {
    let turn = a.dir.perp(&b.dir);
    if turn.abs() < 0.17 {
        return None;
    }
    let to = b.origin - a.origin;
    let t = [to.perp(&b.dir) / turn, to.perp(&a.dir) / turn];
    let holds = |lane: &Lane, t: f64| t >= lane.reach[0] - 1.0 && t <= lane.reach[1] + 1.0;
    (holds(a, t[0]) && holds(b, t[1])).then_some(t)
}

/// Parameters of the points of two lanes that are nearest to each other; the middle where lanes run side by side.
fn nearest(a: &Lane, b: &Lane) -> [f64; 2] {
    let ends = b.reach.map(|t| a.locate(b.at(t)).0);
    let low = a.reach[0].max(ends[0].min(ends[1]));
    let high = a.reach[1].min(ends[0].max(ends[1]));
    if low <= high && a.dir.perp(&b.dir).abs() < 0.17 {
        let t = f64::midpoint(low, high);
        return [t, b.locate(a.at(t)).0.clamp(b.reach[0], b.reach[1])];
    }
    let from_a = a.reach.map(|t| [t, b.locate(a.at(t)).0.clamp(b.reach[0], b.reach[1])]);
    let from_b = b.reach.map(|t| [a.locate(b.at(t)).0.clamp(a.reach[0], a.reach[1]), t]);
    let gap = |t: &[f64; 2]| (a.at(t[0]) - b.at(t[1])).norm();
    from_a
        .into_iter()
        .chain(from_b)
        .min_by(|x, y| gap(x).total_cmp(&gap(y)))
        .expect("a lane has two ends")
}
