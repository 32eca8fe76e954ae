//! Rooms as the faces of a graph of walls and doors.
//!
//! Drawn walls rarely close: ends stop short of the wall that they meet, walls cross without a common vertex, several
//! vertices stand in one corner. The graph is mended first: near nodes are welded, loose ends led to a wall near by,
//! crossings made nodes. Then every half-edge is followed round its face. Walls that bound nothing are handed back.
//!
//! **Invariant.** Faces do not overlap, run counter-clockwise, and together with their holes fill what the walls
//! enclose.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::ControlFlow;

use crate::geometry::nearest_on_segment;
use crate::map::plane::{bounds, contains, doubled_area, meeting, near_pairs};
use crate::units::{Gather as _, InOrder as _, Point};

mod gaps;

/// Nodes nearer than this are one, cm.
const WELD: f64 = 4.0;
/// A loose end is led to a wall that is no farther than this, cm.
const GAP: f64 = 30.0;
/// Faces smaller than this are drawn walls and columns, cm².
const LEAST_FACE: f64 = 2_500.0;

/// A wall or a door between two points, with the caller's number for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    pub(super) ends: (Point, Point),
    pub(super) tag: usize,
}

/// A bounded face.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Face {
    pub(super) outline: Vec<Point>,
    pub(super) holes: Vec<Vec<Point>>,
    /// Tags of the edges around it.
    pub(super) tags: BTreeSet<usize>,
}

/// The tag of an edge that nothing stands on: see [`Plan::open`].
const OPEN: usize = usize::MAX;
/// The farthest that an open edge reaches, cm.
const REACH: f64 = 600.0;
/// A part of a face smaller than this is not parted from it, cm².
const LEAST_PART: f64 = 40_000.0;
/// Levels with more walls than this keep doors that lead from a room into itself, to be left out later.
const MOST_EDGES: usize = 20_000;
/// Open edges tried on one level; the shortest come first.
const MOST_LEADS: usize = 150;
/// A gap in a wall no wider than this is a doorway, cm: that of a double door.
const DOORWAY: f64 = 150.0;
/// Walls on both sides of a gap are one wall when they turn by less than this, degrees.
const TURN: f64 = 20.0;
/// Floor smaller than this is no room of its own, cm².
const LEAST_ROOM: f64 = 12_000.0;

/// What a graph encloses.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Plan {
    pub(super) faces: Vec<Face>,
    /// Pieces of edges that bound no face.
    pub(super) loose: Vec<Edge>,
    /// Edges between faces on which nothing stands. A door in a wall that ends in the open would have one room on both
    /// sides; the loose ends of its wall are led across to the next wall, and rooms meet there by a passage.
    pub(super) open: Vec<(Point, Point)>,
    /// Gaps in a wall as narrow as a doorway, in which no door is drawn; the floor on both sides is one face.
    pub(super) gaps: Vec<(Point, Point)>,
    /// Gaps in a wall that are wider, so that the floor on both sides became one face.
    pub(super) wide: Vec<(Point, Point)>,
}

/// The faces of a graph of walls.
pub(super) fn faces(edges: &[Edge]) -> Plan {
    let mut graph = Graph::default();
    for edge in edges {
        let (a, b) = (graph.node(edge.ends.0), graph.node(edge.ends.1));
        if a != b {
            graph.edges.push((a, b, edge.tag));
        }
    }
    graph.lead_loose_ends();
    graph.split();
    graph.dedup();
    let gaps = graph.narrow_gaps();
    graph.part_doors();
    graph.span_doors();
    let wide = graph.wide_gaps();
    let (loose, cycles) = graph.bound();
    let ends = |e: &(usize, usize, usize)| (graph.points[e.0], graph.points[e.1]);
    let open = graph.edges.iter().filter(|e| e.2 == OPEN).map(ends).collect();
    let loose = loose
        .into_iter()
        .filter(|e| e.2 != OPEN)
        .map(|(a, b, tag)| Edge { ends: (graph.points[a], graph.points[b]), tag })
        .collect();
    Plan { faces: graph.faces(&cycles), loose, open, gaps, wide }
}

/// The nodes round a face, each with the tag of the edge that follows.
type Cycle = Vec<(usize, usize)>;

#[derive(Default, Clone)]
struct Graph {
    points: Vec<Point>,
    cells: HashMap<(i64, i64), Vec<usize>>,
    edges: Vec<(usize, usize, usize)>,
}

impl Graph {
    /// The node at a point, an old one when there is one near.
    fn node(&mut self, p: Point) -> usize {
        let cell = |v: f64| (v / WELD).floor() as i64;
        let (x, y) = (cell(p.x), cell(p.y));
        let mut nearest: Option<(f64, usize)> = None;
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            for &i in self.cells.get(&(x + dx, y + dy)).into_iter().flatten() {
                let distance = (self.points[i] - p).norm();
                if distance <= WELD && nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, i));
                }
            }
        }
        if let Some((_, i)) = nearest {
            return i;
        }
        self.points.push(p);
        self.cells.entry((x, y)).or_default().push(self.points.len() - 1);
        self.points.len() - 1
    }

    fn degrees(&self) -> Vec<usize> {
        let mut degrees = vec![0; self.points.len()];
        for &(a, b, _) in &self.edges {
            degrees[a] += 1;
            degrees[b] += 1;
        }
        degrees
    }

    fn ends(&self, edge: (usize, usize, usize)) -> (Point, Point) {
        (self.points[edge.0], self.points[edge.1])
    }

    /// An end that stops short of a wall is led on to it.
    fn lead_loose_ends(&mut self) {
        let degrees = self.degrees();
        let loose: Vec<usize> = (0..degrees.len()).filter(|&i| degrees[i] == 1).collect();
        let mut boxes: Vec<_> = self
            .edges
            .iter()
            .map(|&e| {
                let (a, b) = self.ends(e);
                bounds([a, b])
            })
            .collect();
        let count = boxes.len();
        boxes.extend(loose.iter().map(|&i| (self.points[i], self.points[i])));
        let mut nearest: BTreeMap<usize, (f64, Point, usize)> = BTreeMap::new();
        near_pairs(&boxes, GAP, |i, j| {
            if i < count && j >= count {
                let (node, edge) = (loose[j - count], self.edges[i]);
                if edge.0 != node && edge.1 != node {
                    let p = self.points[node];
                    let foot = foot(p, self.ends(edge));
                    let distance = (foot - p).norm();
                    let best = nearest.get(&node);
                    if distance <= GAP && best.is_none_or(|b| distance < b.0) {
                        let own = self.edges.iter().find(|e| e.0 == node || e.1 == node);
                        nearest.insert(node, (distance, foot, own.map_or(0, |e| e.2)));
                    }
                }
            }
            ControlFlow::Continue(())
        });
        for (node, (_, foot, tag)) in nearest {
            let to = self.node(foot);
            if to != node {
                self.edges.push((node, to, tag));
            }
        }
    }

    /// Splits edges where they cross, and where a node lies on them.
    fn split(&mut self) {
        let boxes: Vec<_> = self
            .edges
            .iter()
            .map(|&e| {
                let (a, b) = self.ends(e);
                bounds([a, b])
            })
            .collect();
        let mut cuts: BTreeMap<usize, Vec<Point>> = BTreeMap::new();
        near_pairs(&boxes, WELD, |i, j| {
            let (one, other) = (self.ends(self.edges[i]), self.ends(self.edges[j]));
            if let Some(p) = meeting(one, other) {
                cuts.entry(i).or_default().push(p);
                cuts.entry(j).or_default().push(p);
            }
            for (edge, ends, points) in [(i, one, other), (j, other, one)] {
                for p in [points.0, points.1] {
                    if (foot(p, ends) - p).norm() <= WELD {
                        cuts.entry(edge).or_default().push(p);
                    }
                }
            }
            ControlFlow::Continue(())
        });
        for (i, mut points) in cuts {
            let (a, b, tag) = self.edges[i];
            let from = self.points[a];
            points.order_by(|p, q| (p - from).norm().total_cmp(&(q - from).norm()));
            let mut chain = vec![a];
            for p in points {
                let node = self.node(p);
                if node != b && !chain.contains(&node) {
                    chain.push(node);
                }
            }
            chain.push(b);
            self.edges[i] = (chain[0], chain[1], tag);
            self.edges.extend(chain.windows(2).skip(1).map(|w| (w[0], w[1], tag)));
        }
    }

    /// Takes away all that bounds nothing: arms, and bridges to inner rings. What is left has a face on either side.
    fn bound(&mut self) -> (Vec<(usize, usize, usize)>, Vec<Cycle>) {
        let mut loose = self.prune();
        let mut cycles = self.cycles();
        loop {
            let bridges = bridges(&cycles);
            if bridges.is_empty() {
                return (loose, cycles);
            }
            let is_bridge =
                |e: &(usize, usize, usize)| bridges.contains(&(e.0.min(e.1), e.0.max(e.1)));
            loose.extend(self.edges.iter().filter(|e| is_bridge(e)).copied());
            self.edges.retain(|e| !is_bridge(e));
            loose.extend(self.prune());
            cycles = self.cycles();
        }
    }

    /// The doors that have one face on both sides, and everything else that bounds nothing.
    fn one_sided(&self) -> (BTreeSet<usize>, Vec<(usize, usize, usize)>) {
        let (loose, _) = self.clone().bound();
        (loose.iter().map(|e| e.2).filter(|&tag| tag > 0 && tag != OPEN).collect(), loose)
    }

    /// Parts a face that has a door on both sides by the shortest line, from corner to corner, that parts the two
    /// sides of the door: the open side of a bay of rooms.
    fn span_doors(&mut self) {
        let limit = if self.edges.len() > MOST_EDGES { 0 } else { MOST_LEADS };
        for _ in 0..limit {
            let mut pruned = self.clone();
            pruned.prune();
            let cycles = pruned.cycles();
            let Some(chord) = cycles.iter().find_map(|cycle| pruned.chord(cycle)) else { return };
            self.edges.push((chord.0, chord.1, OPEN));
        }
    }

    fn chord(&self, cycle: &Cycle) -> Option<(usize, usize)> {
        let n = cycle.len();
        let mut first: BTreeMap<usize, usize> = BTreeMap::new();
        let mut doors = Vec::new();
        for (i, &(node, tag)) in cycle.iter().enumerate() {
            if tag > 0 && tag != OPEN {
                // The same edge the other way round, not another piece of the same door.
                match first.get(&tag) {
                    Some(&j) if cycle[(j + 1) % n].0 == node => doors.push((j, i)),
                    _ => {
                        first.insert(tag, i);
                    }
                }
            }
        }
        let at = |i: usize| self.points[cycle[i % n].0];
        let mut sums = vec![0.0; 2 * n + 1];
        for i in 0..2 * n {
            sums[i + 1] = sums[i] + at(i).coords.perp(&at(i + 1).coords);
        }
        let total = sums[n] / 2.0;
        doors.into_iter().find_map(|(i, j)| {
            let mut chords: Vec<(f64, usize, usize)> = Vec::new();
            for p in i + 1..=j {
                for q in j + 1..=i + n {
                    let length = (at(p) - at(q)).norm();
                    if !(WELD..=REACH).contains(&length) {
                        continue;
                    }
                    let part = (sums[q] - sums[p] + at(q).coords.perp(&at(p).coords)) / 2.0;
                    let rest = total - part;
                    // Of the border of all walls one part lies outside.
                    let is_floor = |area: f64| area >= LEAST_PART;
                    if is_floor(part) && is_floor(rest) || total < 0.0 && is_floor(part.max(rest)) {
                        chords.push((length, cycle[p % n].0, cycle[q % n].0));
                    }
                }
            }
            chords.order_by(|a, b| a.0.total_cmp(&b.0));
            chords.into_iter().map(|(_, a, b)| (a, b)).find(|&(a, b)| self.is_clear(a, b))
        })
    }

    /// Whether a line between two nodes meets no edge on its way.
    fn is_clear(&self, a: usize, b: usize) -> bool {
        let line = (self.points[a], self.points[b]);
        self.edges.iter().all(|&edge| {
            [edge.0, edge.1].iter().any(|n| *n == a || *n == b)
                && !(edge.0 == a && edge.1 == b)
                && !(edge.0 == b && edge.1 == a)
                || meeting(line, self.ends(edge)).is_none()
        })
    }

    /// Leads free ends of walls across to the next wall, as few as give every door two sides.
    fn part_doors(&mut self) {
        let (doors, loose) = self.one_sided();
        if doors.is_empty() || self.edges.len() > MOST_EDGES {
            return;
        }
        let group = groups(&loose);
        let degrees = self.degrees();
        let own: BTreeSet<(usize, usize, usize)> = loose.into_iter().gather();
        let mut leads: Vec<(f64, usize, Point)> = Vec::new();
        for (&end, of) in group.iter().filter(|(n, _)| degrees[**n] == 1) {
            let p = self.points[end];
            let is_own =
                |edge: &(usize, usize, usize)| own.contains(edge) && group.get(&edge.0) == Some(of);
            let feet = self.edges.iter().filter(|e| !is_own(e)).map(|&e| foot(p, self.ends(e)));
            let nearest = feet.min_by(|a, b| (a - p).norm().total_cmp(&(b - p).norm()));
            leads.extend(nearest.map(|foot| ((foot - p).norm(), end, foot)));
        }
        leads.retain(|lead| lead.0 <= REACH);
        leads.order_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        leads.truncate(MOST_LEADS);
        let led = |leads: &[(f64, usize, Point)]| {
            let gaps: Vec<(usize, Point)> =
                leads.iter().map(|&(_, end, foot)| (end, foot)).collect();
            self.led(&gaps)
        };
        let left = led(&leads).one_sided().0.len();
        if left == doors.len() {
            return;
        }
        // The longest go first, as long as no door loses its second side.
        for i in (0..leads.len()).rev() {
            let mut fewer = leads.clone();
            fewer.remove(i);
            if led(&fewer).one_sided().0.len() <= left {
                leads = fewer;
            }
        }
        *self = led(&leads);
    }

    /// One edge between two nodes: a door before a wall, a wall before nothing.
    fn dedup(&mut self) {
        let mut best: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for &(a, b, tag) in self.edges.iter().filter(|e| e.0 != e.1) {
            let kept = best.entry((a.min(b), a.max(b))).or_insert(tag);
            let rank = |tag: usize| tag.wrapping_add(1);
            if rank(tag) > rank(*kept) {
                *kept = tag;
            }
        }
        self.edges = best.into_iter().map(|((a, b), tag)| (a, b, tag)).collect();
    }

    /// Takes away edges with a free end until none is left.
    fn prune(&mut self) -> Vec<(usize, usize, usize)> {
        let mut degrees = self.degrees();
        let mut at: Vec<Vec<usize>> = vec![Vec::new(); self.points.len()];
        for (i, &(a, b, _)) in self.edges.iter().enumerate() {
            at[a].push(i);
            at[b].push(i);
        }
        let mut is_loose = vec![false; self.edges.len()];
        let mut ends: Vec<usize> = (0..degrees.len()).filter(|&n| degrees[n] == 1).collect();
        while let Some(end) = ends.pop() {
            let Some(&edge) = at[end].iter().find(|&&e| !is_loose[e]) else { continue };
            is_loose[edge] = true;
            for node in [self.edges[edge].0, self.edges[edge].1] {
                degrees[node] -= 1;
                if degrees[node] == 1 {
                    ends.push(node);
                }
            }
        }
        let all = std::mem::take(&mut self.edges);
        let (loose, kept): (Vec<_>, Vec<_>) =
            all.into_iter().zip(is_loose).partition(|(_, is_loose)| *is_loose);
        self.edges = kept.into_iter().map(|(edge, _)| edge).collect();
        loose.into_iter().map(|(edge, _)| edge).collect()
    }

    /// Every face as the chain of its nodes, the face to the left; with the tag of each edge.
    fn cycles(&self) -> Vec<Cycle> {
        let mut out: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
        for &(a, b, tag) in &self.edges {
            out.entry(a).or_default().push((b, tag));
            out.entry(b).or_default().push((a, tag));
        }
        let angle = |from: usize, to: usize| {
            let v = self.points[to] - self.points[from];
            v.y.atan2(v.x)
        };
        for (&node, ends) in &mut out {
            ends.order_by(|a, b| angle(node, a.0).total_cmp(&angle(node, b.0)));
        }
        let mut seen = BTreeSet::new();
        let mut cycles = Vec::new();
        let starts: Vec<(usize, usize)> =
            self.edges.iter().flat_map(|&(a, b, _)| [(a, b), (b, a)]).collect();
        for start in starts {
            if seen.contains(&start) {
                continue;
            }
            let mut cycle = Vec::new();
            let (mut from, mut to) = start;
            while seen.insert((from, to)) {
                let ends = &out[&to];
                let back = ends.iter().position(|e| e.0 == from).unwrap_or(0);
                cycle.push((from, ends[back].1));
                // The next edge clockwise from the way back keeps the face to the left.
                let next = ends[(back + ends.len() - 1) % ends.len()].0;
                (from, to) = (to, next);
            }
            cycles.push(cycle);
        }
        cycles
    }

    fn faces(&self, cycles: &[Cycle]) -> Vec<Face> {
        let ring =
            |cycle: &Cycle| -> Vec<Point> { cycle.iter().map(|&(n, _)| self.points[n]).collect() };
        let rings: Vec<(Vec<Point>, f64)> = cycles
            .iter()
            .map(|cycle| {
                let ring = ring(cycle);
                let area = doubled_area(&ring) / 2.0;
                (ring, area)
            })
            .collect();
        let mut faces: Vec<(f64, BTreeSet<usize>, Face)> = Vec::new();
        for (cycle, (ring, area)) in cycles.iter().zip(&rings) {
            if *area >= LEAST_FACE {
                let tags = cycle.iter().map(|&(_, tag)| tag).collect();
                let nodes = cycle.iter().map(|&(n, _)| n).collect();
                let face = Face { outline: ring.clone(), holes: Vec::new(), tags };
                faces.push((*area, nodes, face));
            }
        }
        // The outer border of a group of walls is a hole of the face around it.
        for (cycle, (ring, area)) in cycles.iter().zip(&rings) {
            if *area < -LEAST_FACE {
                let around = faces
                    .iter_mut()
                    .filter(|(size, nodes, face)| {
                        *size > -area
                            && !cycle.iter().any(|(n, _)| nodes.contains(n))
                            && contains(&face.outline, ring[0])
                    })
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((_, _, face)) = around {
                    face.holes.push(ring.clone());
                    face.tags.extend(cycle.iter().map(|&(_, tag)| tag));
                }
            }
        }
        faces.into_iter().map(|(_, _, face)| face).collect()
    }
}

/// The nodes of edges that hang together, each with the least node of its group.
fn groups(edges: &[(usize, usize, usize)]) -> BTreeMap<usize, usize> {
    let mut parent: BTreeMap<usize, usize> =
        edges.iter().flat_map(|e| [(e.0, e.0), (e.1, e.1)]).gather();
    fn root(parent: &mut BTreeMap<usize, usize>, node: usize) -> usize {
        let (mut top, mut n) = (node, node);
        while parent[&top] != top {
            top = parent[&top];
        }
        while parent[&n] != top {
            n = parent.insert(n, top).unwrap_or(top);
        }
        top
    }
    for &(a, b, _) in edges {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent.insert(a.max(b), a.min(b));
    }
    let nodes: Vec<usize> = parent.keys().copied().collect();
    nodes.into_iter().map(|n| (n, root(&mut parent, n))).gather()
}

/// Edges that one face has on both sides.
fn bridges(cycles: &[Cycle]) -> BTreeSet<(usize, usize)> {
    let mut bridges = BTreeSet::new();
    for cycle in cycles {
        let mut seen = BTreeSet::new();
        for i in 0..cycle.len() {
            let (a, b) = (cycle[i].0, cycle[(i + 1) % cycle.len()].0);
            if !seen.insert((a.min(b), a.max(b))) {
                bridges.insert((a.min(b), a.max(b)));
            }
        }
    }
    bridges
}

/// The point of an edge that is nearest to `p`.
fn foot(p: Point, (a, b): (Point, Point)) -> Point {
    nearest_on_segment(p, a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(walls: &[[f64; 4]]) -> Plan {
        let edge =
            |w: &[f64; 4]| Edge { ends: (Point::new(w[0], w[1]), Point::new(w[2], w[3])), tag: 0 };
        faces(&walls.iter().map(edge).collect::<Vec<_>>())
    }

    fn areas(plan: &Plan) -> Vec<i64> {
        let area = |f: &Face| {
            let holes: f64 = f.holes.iter().map(|h| doubled_area(h).abs()).sum();
            ((doubled_area(&f.outline) - holes) / 2.0).round() as i64
        };
        let mut areas: Vec<i64> = plan.faces.iter().map(area).collect();
        areas.sort_unstable();
        areas
    }

    #[test]
    fn two_rooms_of_one_wall_that_stops_short_and_one_that_crosses() {
        let plan = plan(&[
            [0.0, 0.0, 600.0, 0.0],
            [600.0, 0.0, 600.0, 300.0],
            [600.0, 300.0, 0.0, 300.0],
            [0.0, 300.0, 0.0, 0.0],
            // Stops 10 cm short below and sticks out 20 cm above.
            [200.0, 10.0, 200.0, 320.0],
            // A stub into the room.
            [600.0, 100.0, 450.0, 100.0],
        ]);
        assert_eq!(areas(&plan), [60_000, 120_000]);
        assert_eq!(plan.loose.len(), 2, "{:?}", plan.loose);
    }

    #[test]
    fn a_door_in_a_wall_that_ends_in_the_open_parts_two_rooms() {
        let walls = [
            [0.0, 0.0, 600.0, 0.0],
            [600.0, 0.0, 600.0, 300.0],
            [600.0, 300.0, 0.0, 300.0],
            [0.0, 300.0, 0.0, 0.0],
            [200.0, 0.0, 200.0, 50.0],
            [200.0, 140.0, 200.0, 200.0],
        ];
        let edge = |tag: usize, w: [f64; 4]| Edge {
            ends: (Point::new(w[0], w[1]), Point::new(w[2], w[3])),
            tag,
        };
        let mut edges: Vec<Edge> = walls.iter().map(|&w| edge(0, w)).collect();
        assert_eq!(areas(&faces(&edges)), [180_000]);
        edges.push(edge(1, [200.0, 50.0, 200.0, 140.0]));
        let plan = faces(&edges);
        assert_eq!(areas(&plan), [60_000, 120_000]);
        assert_eq!(plan.open, [(Point::new(200.0, 200.0), Point::new(200.0, 300.0))]);
    }

    #[test]
    fn an_undrawn_doorway_is_told_and_a_wide_gap_too() {
        // A room above a corridor; the wall between them has a gap at x from `x0` to `x1`.
        let plan_of = |x0: f64, x1: f64, bend: f64| {
            plan(&[
                [0.0, 0.0, 800.0, 0.0],
                [800.0, 0.0, 800.0, 600.0],
                [800.0, 600.0, 0.0, 600.0],
                [0.0, 600.0, 0.0, 0.0],
                [0.0, 200.0, x0, 200.0],
                [x1, 200.0 + bend, 800.0, 200.0],
            ])
        };
        // In mid-wall, in a wall drawn askew, and in a corner where one side of the wall is missing.
        for (x0, x1, bend) in [(300.0, 390.0, 0.0), (300.0, 400.0, 12.0), (690.0, 799.0, 0.0)] {
            let plan = plan_of(x0, x1, bend);
            assert_eq!(plan.faces.len(), 1, "{x0} {x1}");
            assert_eq!((plan.open.len(), plan.gaps.len(), plan.wide.len()), (0, 1, 0), "{x0} {x1}");
            let (a, b) = plan.gaps[0];
            assert!(((b - a).norm() - (x1 - x0)).abs() < 5.0, "{a} {b}");
        }
        let wide = plan_of(200.0, 600.0, 0.0);
        assert_eq!((wide.faces.len(), wide.gaps.len()), (1, 0));
        assert!(!wide.wide.is_empty());
        // A screen that leaves a way round either end parts nothing, and a niche is no room.
        let mut walls = vec![
            [0.0, 0.0, 800.0, 0.0],
            [800.0, 0.0, 800.0, 600.0],
            [800.0, 600.0, 0.0, 600.0],
            [0.0, 600.0, 0.0, 0.0],
        ];
        walls.push([200.0, 300.0, 700.0, 300.0]);
        let screen = plan(&walls);
        assert_eq!((screen.faces.len(), screen.gaps.len()), (1, 0));
        walls.pop();
        walls.push([100.0, 0.0, 100.0, 90.0]);
        walls.push([100.0, 90.0, 60.0, 90.0]);
        let niche = plan(&walls);
        assert_eq!((niche.faces.len(), niche.gaps.len()), (1, 0));
    }

    #[test]
    fn a_ring_within_a_room_is_its_hole() {
        let square = |x: f64, y: f64, s: f64| {
            [[x, y, x + s, y], [x + s, y, x + s, y + s], [x + s, y + s, x, y + s], [x, y + s, x, y]]
        };
        let mut walls = square(0.0, 0.0, 1000.0).to_vec();
        walls.extend(square(400.0, 400.0, 200.0));
        // A wall that leads from the outer ring to the inner one parts nothing.
        walls.push([0.0, 500.0, 400.0, 500.0]);
        let plan = plan(&walls);
        assert_eq!(areas(&plan), [40_000, 960_000]);
    }
}
