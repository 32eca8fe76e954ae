//! Ways over floor with slow and one-way zones: never against a one-way zone's heading, and quickest in time.
//!
//! A shortest way that keeps to the rules and is slowed down nowhere is the quickest one, and most are. Else a way is looked
//! for over a graph of sight (A*): its nodes are the corners at which ways bend, places on doorways' lines, and on the
//! borders of zones their corners, a place every [`STEP`] cm and, for one-way zones, the places level with each other node,
//! since a way that may not turn back runs along a level at the utmost. Then the nodes slide along the lines on which they
//! lie to where the way is quickest.
//!
//! **Invariant**: what is found lies in the centre space and keeps to every rule on its whole length. That there is none is
//! told of one-way zones truly: where a way keeps to them at all, one over these nodes does.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::Arc;

use crate::map::ZoneKind;
use crate::units::{Point, Vector};

use super::floor::FragmentFloor;
use super::zone::PlacedZone;
use super::{Bounds, Polygon};

/// Places on the borders of zones and on doorways' lines are so far from each other at the most, in cm.
const STEP: f64 = 25.0;
/// Lengths below this are rounding, in cm.
const ROUNDING: f64 = 1e-6;
/// A step back of a smaller share of a leg is rounding.
const BACK: f64 = 1e-9;

/// What zones say of the legs of a way.
pub(super) struct Rules<'a> {
    /// Polygons with the direction in which they may be crossed.
    one_way: Vec<(&'a Polygon, Bounds, Vector)>,
    /// Polygons with how many times as long a leg takes there.
    slow: Vec<(&'a Polygon, Bounds, f64)>,
}

impl<'a> Rules<'a> {
    /// Those of some zones for a robot that drives at so many cm/s elsewhere; none where no zone says anything of legs.
    pub(super) fn of(zones: &'a [PlacedZone], speed: f64) -> Option<Self> {
        let mut rules = Self { one_way: Vec::new(), slow: Vec::new() };
        for zone in zones {
            for polygon in &zone.polygons {
                let bounds = polygon.bounds();
                match zone.kind {
                    ZoneKind::OneWay { heading } => {
                        let angle = heading.get().to_radians();
                        let along = Vector::new(angle.cos(), angle.sin());
                        rules.one_way.push((polygon, bounds, along));
                    }
                    ZoneKind::Slow { speed: slow } if slow < speed => {
                        rules.slow.push((polygon, bounds, speed / slow));
                    }
                    _ => {}
                }
            }
        }
        (!rules.one_way.is_empty() || !rules.slow.is_empty()).then_some(rules)
    }

    /// What a leg costs: its length in cm as driven at full speed; none where it runs against a one-way zone.
    pub(super) fn cost(&self, a: Point, b: Point) -> Option<f64> {
        let way = b - a;
        let length = way.norm();
        let reach = Bounds::of([a, b]);
        for (polygon, bounds, along) in &self.one_way {
            let is_back = way.dot(along) < -BACK * length.max(1.0);
            if is_back && bounds.meets(&reach) && crosses(polygon, a, b) {
                return None;
            }
        }
        let mut slow = self.slow.iter().filter(|(_, bounds, _)| bounds.meets(&reach)).peekable();
        if slow.peek().is_none() {
            return Some(length);
        }
        let near: Vec<_> = slow.collect();
        let mut cuts: Vec<f64> = near.iter().flat_map(|(p, ..)| cuts(p, a, b)).collect();
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        let piece = |ends: &[f64]| {
            let middle = a + way * ((ends[0] + ends[1]) / 2.0);
            let here = near.iter().filter(|(polygon, ..)| is_within(polygon, middle));
            let times = here.map(|(_, _, times)| *times).fold(1.0, f64::max);
            (ends[1] - ends[0]) * length * times
        };
        Some(cuts.windows(2).map(piece).sum())
    }

    pub(super) fn cost_of(&self, points: &[Point]) -> Option<f64> {
        points.windows(2).map(|leg| self.cost(leg[0], leg[1])).sum()
    }

    fn polygons(&self) -> impl Iterator<Item = (&'a Polygon, &Bounds)> + '_ {
        let one_way = self.one_way.iter().map(|(polygon, bounds, _)| (*polygon, bounds));
        one_way.chain(self.slow.iter().map(|(polygon, bounds, _)| (*polygon, bounds)))
    }
}

/// Where a leg meets the border of a polygon, as shares of it.
fn cuts(polygon: &Polygon, a: Point, b: Point) -> Vec<f64> {
    let way = b - a;
    let cut = |(p, q): (Point, Point)| {
        let side = q - p;
        let turn = way.perp(&side);
        let t = (p - a).perp(&side) / turn;
        let u = (p - a).perp(&way) / turn;
        (turn.abs() > 0.0 && (0.0..=1.0).contains(&t) && (-1e-9..=1.0 + 1e-9).contains(&u))
            .then_some(t)
    };
    polygon.edges().filter_map(cut).collect()
}

/// Whether a point lies within a polygon, and not on its border.
fn is_within(polygon: &Polygon, p: Point) -> bool {
    polygon.winds_around(p) && polygon.border_distance(p) > ROUNDING
}

/// Whether some of a leg lies within a polygon, and not only on its border.
fn crosses(polygon: &Polygon, a: Point, b: Point) -> bool {
    let mut all = cuts(polygon, a, b);
    all.extend([0.0, 1.0]);
    all.sort_by(f64::total_cmp);
    let length = (b - a).norm();
    all.windows(2).any(|ends| {
        let middle = a + (b - a) * ((ends[0] + ends[1]) / 2.0);
        (ends[1] - ends[0]) * length > ROUNDING && is_within(polygon, middle)
    })
}

/// A way in pieces, each with the speed in cm/s that slow zones allow on it; none where they say nothing.
pub(super) fn paces(zones: &[PlacedZone], points: &[Point]) -> Vec<(Vec<Point>, Option<f64>)> {
    let slow: Vec<(&Polygon, f64)> = zones
        .iter()
        .filter_map(|zone| match zone.kind {
            ZoneKind::Slow { speed } => Some((zone, speed)),
            _ => None,
        })
        .flat_map(|(zone, speed)| zone.polygons.iter().map(move |polygon| (polygon, speed)))
        .collect();
    if slow.is_empty() {
        return vec![(points.to_vec(), None)];
    }
    let mut pieces: Vec<(Vec<Point>, Option<f64>)> = Vec::new();
    for leg in points.windows(2) {
        let mut ends: Vec<f64> =
            slow.iter().flat_map(|(polygon, _)| cuts(polygon, leg[0], leg[1])).collect();
        ends.extend([0.0, 1.0]);
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|b, a| (*b - *a) * (leg[1] - leg[0]).norm() < ROUNDING);
        for share in ends.windows(2) {
            let at = |t: f64| leg[0] + (leg[1] - leg[0]) * t;
            let middle = at((share[0] + share[1]) / 2.0);
            let here = slow.iter().filter(|(polygon, _)| is_within(polygon, middle));
            let pace = here.map(|(_, speed)| *speed).reduce(f64::min);
            let to = if share[1] < 1.0 { at(share[1]) } else { leg[1] };
            match pieces.last_mut() {
                Some((piece, known)) if *known == pace => piece.push(to),
                _ => pieces.push((vec![at(share[0]), to], pace)),
            }
        }
    }
    if pieces.is_empty() {
        pieces.push((points.to_vec(), None));
    }
    pieces
}

/// The floor over which ways are looked for.
pub(super) struct Ground<'a> {
    pub(super) floors: &'a [Arc<FragmentFloor>],
    /// Where the centre spaces of two Fragments touch, by their numbers, both ways round.
    pub(super) doorways: Vec<(u32, u32, (Point, Point))>,
    /// How far the robot's centre keeps from things, in cm.
    pub(super) reach: f64,
}

/// A place over which a way may go.
struct Place {
    at: Point,
    /// The Fragments on whose floor it lies.
    on: [u32; 2],
    /// The line along which it may slide.
    line: Option<(Point, Point)>,
}

impl Ground<'_> {
    fn floor(&self, number: u32) -> &FragmentFloor {
        &self.floors[number as usize]
    }

    /// The quickest way that keeps to the rules, over the Fragments named; `plain` is the shortest one.
    pub(super) fn lawful(
        &self,
        rules: &Rules<'_>,
        within: &[u32],
        (start, goal): ((Point, u32), (Point, u32)),
        plain: &[Point],
    ) -> Option<Vec<Point>> {
        let shortest: f64 = super::search::length(plain);
        if rules.cost_of(plain).is_some_and(|cost| cost <= shortest + ROUNDING) {
            return Some(plain.to_vec());
        }
        let places = self.places_of_ways(rules, within, start, goal);
        let chain = self.quickest(rules, &places)?;
        let mut way: Vec<&Place> = chain.into_iter().map(|place| &places[place]).collect();
        let mut points: Vec<Point> = way.iter().map(|place| place.at).collect();
        self.slide(rules, &mut way, &mut points);
        // The plain way may be slowed down and the quickest all the same.
        let found = rules.cost_of(&points)?;
        let is_plain = rules.cost_of(plain).is_some_and(|cost| cost <= found + ROUNDING);
        Some(if is_plain { plain.to_vec() } else { points })
    }

    /// The start, the goal, and all places where a way may bend.
    fn places_of_ways(
        &self,
        rules: &Rules<'_>,
        within: &[u32],
        start: (Point, u32),
        goal: (Point, u32),
    ) -> Vec<Place> {
        let single = |at: Point, number: u32| Place { at, on: [number; 2], line: None };
        let mut places = vec![single(start.0, start.1), single(goal.0, goal.1)];
        let locate = |number: u32, p: Point| self.floor(number).cells.locate(p, 1e-6);
        for &number in within {
            for corner in self.floor(number).cells.bends() {
                places.push(single(corner, number));
            }
            let ahead = self.doorways.iter().filter(|(from, to, _)| *from == number && to > from);
            for &(from, to, line) in ahead {
                if within.binary_search(&to).is_err() {
                    continue;
                }
                let on = [from, to];
                let along = along(line).map(|at| Place { at, on, line: Some(line) });
                places.extend(along);
            }
        }
        let corners: Vec<(Point, [u32; 2])> = places.iter().map(|p| (p.at, p.on)).collect();
        for &number in within {
            let floor = self.floor(number);
            let near = |bounds: &Bounds| bounds.meets(&floor.bounds.grown(2.0 * self.reach));
            for (polygon, _) in rules.polygons().filter(|(_, bounds)| near(bounds)) {
                for side in polygon.edges() {
                    for (from, to) in floor.cells.stretches(side.0, side.1) {
                        let end = |t: f64| side.0 + (side.1 - side.0) * t;
                        let line = (end(from), end(to));
                        let mut on_it: Vec<Point> = along(line).collect();
                        on_it.extend(
                            rules.levels(line, corners.iter().filter(|c| c.1.contains(&number))),
                        );
                        on_it.extend(rules.levels_of_zones(line));
                        for at in on_it.into_iter().filter(|p| locate(number, *p).is_some()) {
                            places.push(Place { at, on: [number; 2], line: Some(line) });
                        }
                    }
                }
            }
        }
        places
    }

    /// The places of the quickest way from the first place to the second.
    fn quickest(&self, rules: &Rules<'_>, places: &[Place]) -> Option<Vec<usize>> {
        const NOWHERE: usize = usize::MAX;
        let goal = places[1].at;
        let mut by_floor: std::collections::BTreeMap<u32, Vec<usize>> = Default::default();
        for (index, place) in places.iter().enumerate() {
            for number in place.on {
                by_floor.entry(number).or_default().push(index);
            }
        }
        let mut spent = vec![f64::INFINITY; places.len()];
        let mut before = vec![NOWHERE; places.len()];
        let mut done = vec![false; places.len()];
        spent[0] = 0.0;
        // Costs are positive, so their bits are in their order.
        let mut open = BinaryHeap::from([Reverse(((goal - places[0].at).norm().to_bits(), 0))]);
        while let Some(Reverse((_, here))) = open.pop() {
            if std::mem::replace(&mut done[here], true) {
                continue;
            }
            if here == 1 {
                let back = std::iter::successors(Some(here), |&place| {
                    Some(before[place]).filter(|&b| b != NOWHERE)
                });
                let mut chain: Vec<usize> = back.collect();
                chain.reverse();
                return Some(chain);
            }
            let from = &places[here];
            let floors = if from.on[0] == from.on[1] { &from.on[..1] } else { &from.on[..] };
            for number in floors {
                let cells = &self.floor(*number).cells;
                for &next in &by_floor[number] {
                    let to = places[next].at;
                    let least = spent[here] + (to - from.at).norm();
                    if done[next] || least >= spent[next] {
                        continue;
                    }
                    let Some(cost) = rules.cost(from.at, to) else { continue };
                    let cost = spent[here] + cost;
                    if cost < spent[next] && cells.sees(from.at, to) {
                        (spent[next], before[next]) = (cost, here);
                        open.push(Reverse(((cost + (goal - to).norm()).to_bits(), next)));
                    }
                }
            }
        }
        None
    }

    /// Moves what may slide along its line to where the way is quickest, and leaves out what is not needed.
    fn slide(&self, rules: &Rules<'_>, way: &mut Vec<&Place>, points: &mut Vec<Point>) {
        const ROUNDS: usize = 6;
        const HALVINGS: usize = 40;
        let floors = |i: usize, way: &[&Place]| {
            let (a, b) = (way[i], way[i + 1]);
            a.on.into_iter().find(|number| b.on.contains(number))
        };
        let leg = |number: Option<u32>, a: Point, b: Point| {
            let is_seen = number.is_some_and(|n| self.floor(n).cells.sees(a, b));
            if is_seen { rules.cost(a, b) } else { None }
        };
        for _ in 0..ROUNDS {
            let mut i = 1;
            while i + 1 < way.len() {
                let (one, two) = (floors(i - 1, way), floors(i, way));
                let (a, b) = (points[i - 1], points[i + 1]);
                let over = |p: Point| Some(leg(one, a, p)? + leg(two, p, b)?);
                let Some(known) = over(points[i]) else {
                    i += 1;
                    continue;
                };
                if one == two && leg(one, a, b).is_some_and(|cost| cost <= known + ROUNDING) {
                    way.remove(i);
                    points.remove(i);
                    continue;
                }
                if let Some((from, to)) = way[i].line {
                    let at = |t: f64| from + (to - from) * t;
                    let cost = |t: f64| over(at(t)).unwrap_or(f64::INFINITY);
                    let (mut low, mut high) = (0.0, 1.0);
                    for _ in 0..HALVINGS {
                        let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                        if cost(one) <= cost(two) { high = two } else { low = one }
                    }
                    let best = (low + high) / 2.0;
                    if cost(best) < known - ROUNDING {
                        points[i] = at(best);
                    }
                }
                i += 1;
            }
        }
    }
}

impl Rules<'_> {
    /// The places on a line that are level with some others, across a one-way direction.
    fn levels<'p>(
        &self,
        line: (Point, Point),
        others: impl Iterator<Item = &'p (Point, [u32; 2])>,
    ) -> Vec<Point> {
        let of = |(p, _): &(Point, [u32; 2])| -> Vec<Point> {
            self.one_way.iter().filter_map(|(_, _, along)| level_with(line, *along, *p)).collect()
        };
        others.flat_map(of).collect()
    }

    /// Likewise with the corners of the zones themselves.
    fn levels_of_zones(&self, line: (Point, Point)) -> Vec<Point> {
        let corners = || self.one_way.iter().flat_map(|(polygon, ..)| &polygon.corners);
        let all = self.one_way.iter().flat_map(|(_, _, along)| {
            corners().filter_map(|corner| level_with(line, *along, *corner))
        });
        all.collect()
    }
}

/// The place on a line that is as far along a direction as another.
fn level_with((a, b): (Point, Point), along: Vector, p: Point) -> Option<Point> {
    let (from, to, level) = (a.coords.dot(&along), b.coords.dot(&along), p.coords.dot(&along));
    let t = (level - from) / (to - from);
    (t > 0.0 && t < 1.0).then(|| a + (b - a) * t)
}

/// Both ends of a line and places between them, at the most [`STEP`] apart.
fn along((a, b): (Point, Point)) -> impl Iterator<Item = Point> {
    let count = ((b - a).norm() / STEP).ceil().max(1.0) as u32;
    (0..=count).map(move |k| a + (b - a) * (f64::from(k) / f64::from(count)))
}
