//! Straits: places too narrow for a robot to turn in, which a long one passes along its own heading.
//!
//! The free floor is made for the disc that covers the footprint: there the robot may turn as it likes. Between two
//! pieces of that floor, where they come close, a strait is looked for: one straight leg, from a place of one piece
//! to a place of the other, along which the footprint is driven ahead with its heading along the leg.
//! Pieces of different Fragments are joined over every doorway on the line, also where a Fragment between them, such as
//! a threshold or a narrow corridor, has no piece of its own.
//!
//! ```text
//!   ┌────────┐
//!   │        │           headings are tried every 15°, and straight across every gap
//!   └────────┘           that the body may pass. Along each heading the
//!  a ───[▭]──── b        floor is shrunk by the footprint turned that way (Minkowski), so that a
//!   ┌────────┐           line in what is left is clear from one end to the other.
//!   │        │
//!   └────────┘
//! ```
//!
//! A footprint may lie aside of the centre on which it turns; then the way back leads along a line of its own, since
//! the robot drives ahead both times. A strait has both ways, so that where the robot came in it comes out.
//!
//! What the body passes over there is free floor, as all that it covers somewhere ([`super::coverage`]).
//!
//! Deliberately absent: turning, shifting the heading or backing within a strait. A bend too narrow for the covering
//! disc is no way.
//!
//! **Invariant**: the ends of a strait lie in centre space; the footprint with its clearance (less [`SLACK`]) keeps
//! to the floor on all of it, driven ahead.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::f64::consts::PI;

use crate::map::RobotProfile;
use crate::units::{InOrder as _, Point, Vector};

use super::anchor::Anchor;
use super::apart::{distance, segment_distance};
use super::cells::{CellKey, Piece};
use super::coverage::{body, meeting, over, shrunk};
use super::floor::FragmentFloor;
use super::grid::{Contour, Grid, Shapes};
use super::mesh::Mesh;
use super::narrows::Narrows;
use super::network::{Lane, Strait};
use super::plan::FloorPlan;
use super::site::SLACK;
use super::{Bounds, Polygon};

/// Headings are tried at this step, in radians.
const TURN: f64 = PI / 12.0;
/// Lines are tried at this distance, in cm.
const LINE: f64 = 2.0;
/// How far a strait leads into the centre space at its ends, in cm; to the middle of less.
const FOOTHOLD: f64 = 0.5;

/// The shortest way over open floor and straits: `leg` finds the points between two places of one open region.
///
/// A* over the straits' ends. A leg is measured when its straight line has come to be the best there is.
pub(super) fn way(
    plan: &FloorPlan,
    start: &Anchor,
    goal: &Anchor,
    leg: impl Fn(&Anchor, &Anchor) -> Option<Vec<Point>>,
) -> Option<Vec<Point>> {
    let anchor = |(at, cell): (Point, CellKey)| Anchor::at(at, cell);
    let lanes = plan.network.straits.iter().flat_map(|s| s.lanes);
    let ends = lanes.flat_map(|lane| lane.ends.into_iter().zip(lane.cells));
    let nodes: Vec<Anchor> =
        [start.clone(), goal.clone()].into_iter().chain(ends.map(anchor)).collect();
    let mut by_region: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    let region = |a: &Anchor| {
        let component = plan.floor(a.cell.0).cells.component(a.cell.1);
        plan.network.open_region((a.cell.0, component))
    };
    for (node, anchor) in nodes.iter().enumerate() {
        by_region.entry(region(anchor)).or_default().push(node);
    }
    const GOAL: usize = 1;
    let left = |node: usize| (goal.at - nodes[node].at).norm();
    let mut spent = vec![f64::INFINITY; nodes.len()];
    let mut before: Vec<Option<(usize, usize)>> = vec![None; nodes.len()];
    let mut is_done = vec![false; nodes.len()];
    let mut legs: Vec<Vec<Point>> = vec![vec![start.at]];
    // Least length through the node, the node, from where, and which leg leads there once it is measured.
    let mut open = BinaryHeap::from([(Reverse(0), 0, 0, Some(0))]);
    while let Some((_, node, from, measured)) = open.pop() {
        if is_done[node] {
            continue;
        }
        let Some(number) = measured else {
            let Some(points) = leg(&nodes[from], &nodes[node]) else { continue };
            let bound = spent[from] + length(&points) + left(node);
            legs.push(points);
            open.push((Reverse(bound.to_bits()), node, from, Some(legs.len() - 1)));
            continue;
        };
        is_done[node] = true;
        spent[node] = if node == 0 { 0.0 } else { spent[from] + length(&legs[number]) };
        before[node] = (node != 0).then_some((from, number));
        if node == GOAL {
            let back = std::iter::successors(before[GOAL], |&(from, _)| before[from]);
            let numbers: Vec<usize> = back.map(|step| step.1).collect();
            let mut way: Vec<Point> =
                numbers.into_iter().rev().flat_map(|n| std::mem::take(&mut legs[n])).collect();
            way.dedup_by(|a, b| (*a - *b).norm() < 1e-9);
            if way.len() == 1 {
                way.push(goal.at);
            }
            return Some(way);
        }
        if node > GOAL && node % 2 == 0 {
            // Straight through to the lane's other end.
            let other = node + 1;
            legs.push(vec![nodes[node].at, nodes[other].at]);
            let bound = spent[node] + length(&legs[legs.len() - 1]) + left(other);
            open.push((Reverse(bound.to_bits()), other, node, Some(legs.len() - 1)));
        }
        for &next in &by_region[&region(&nodes[node])] {
            if !is_done[next] && next != node {
                let bound = spent[node] + (nodes[next].at - nodes[node].at).norm() + left(next);
                open.push((Reverse(bound.to_bits()), next, node, None));
            }
        }
    }
    None
}

fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|p| (p[1] - p[0]).norm()).sum()
}

/// Where straits are looked for: some floor, the Fragments whose centre space lies on it, and the place.
struct Site<'a> {
    grid: Grid,
    /// The floor's edges, all about.
    edges: &'a [(Point, Point)],
    floor: &'a [Contour],
    fragments: &'a [(u32, &'a FragmentFloor)],
    place: Bounds,
    /// Headings worth trying besides the usual ones, as angles.
    headings: Vec<f64>,
    /// A place in each piece so small that the usual lines may miss it.
    spots: &'a [Point],
}

/// The straits within a Fragment.
pub(super) fn within(plan: &FloorPlan, number: u32) -> Vec<Strait> {
    let is_whole = plan.floor(number).cells.components < 2;
    if plan.robot().footprint.is_empty() || is_whole { Vec::new() } else { join(plan, &[number]) }
}

/// The straits through an open doorway that the covering disc does not pass. Where the Fragment behind has no place for
/// the disc, they lead on through its further doorways; each is found for the first doorway that it passes.
pub(super) fn through(plan: &FloorPlan, index: usize) -> Vec<Strait> {
    if plan.robot().footprint.is_empty() || !plan.admits(index) {
        return Vec::new();
    }
    let sides = |index: usize| -> Option<[u32; 2]> {
        let [one, other] = plan.doorways()[index].areas.map(|a| plan.number(a));
        Some([one? as u32, other? as u32])
    };
    let Some([one, other]) = sides(index) else { return Vec::new() };
    if plan.network.portals[one as usize].iter().any(|p| p.doorway == index) {
        return Vec::new();
    }
    let (mut numbers, mut passed) = (vec![one, other], vec![(index, [one, other])]);
    let mut k = 0;
    while let Some(&number) = numbers.get(k) {
        k += 1;
        if !plan.is_blind(number) {
            continue;
        }
        for &(next, _) in plan.doorways_at(number) {
            let is_new = passed.iter().all(|&(known, _)| known != next);
            if let Some(ends) = sides(next).filter(|_| is_new && plan.admits(next)) {
                passed.push((next, ends));
                numbers.extend(ends.iter().filter(|n| !numbers.contains(n)).collect::<Vec<_>>());
            }
        }
    }
    let mut found = join(plan, &numbers);
    for strait in &mut found {
        let crossed = passed.iter().filter(|&&(d, _)| {
            let (right, left) = plan.doorways()[d].line();
            let crosses = |[a, b]: [Point; 2]| segment_distance(a, b, right, left) <= 0.0;
            strait.lanes.iter().any(|lane| crosses(lane.ends))
        });
        strait.doorways = crossed.copied().collect();
        strait.doorways.sort_unstable();
    }
    found.retain(|strait| strait.doorways.first().is_some_and(|&(first, _)| first == index));
    found
}

/// The straits between the pieces of Fragments that lie side by side, or of one: through every gap that is wide enough
/// for the body.
fn join(plan: &FloorPlan, numbers: &[u32]) -> Vec<Strait> {
    let fragments: Vec<(u32, &FragmentFloor)> =
        numbers.iter().map(|&n| (n, plan.floor(n))).collect();
    let narrows = Narrows::of(plan, numbers);
    let around = 2.0 * plan.reach() + 60.0;
    let edges: Vec<(Point, Point)> = narrows
        .floor
        .iter()
        .flat_map(|c| narrows.grid.polygon(c).edges().collect::<Vec<_>>())
        .collect();
    let mut sites: Vec<Site<'_>> = Vec::new();
    let gaps = narrows.parting(plan.robot().passing_width() - 4.0 * SLACK);
    let spots: Vec<Point> = fragments.iter().flat_map(|(_, f)| small_pieces(&f.cells)).collect();
    for gap in &gaps {
        let heading = (gap.along.y.atan2(gap.along.x) + PI / 2.0).rem_euclid(PI);
        let near = gap.reach.grown(around / 2.0);
        let holds = |s: &&mut Site<'_>| s.place.contains(near.min) && s.place.contains(near.max);
        match sites.iter_mut().find(holds) {
            Some(site) => site.headings.push(heading),
            None => sites.push(Site {
                grid: narrows.grid,
                edges: &edges,
                floor: &narrows.floor,
                fragments: &fragments,
                place: gap.reach.grown(around),
                headings: vec![heading],
                spots: &spots,
            }),
        }
    }
    for site in &mut sites {
        let near: Vec<Point> = spots.iter().copied().filter(|&p| site.place.contains(p)).collect();
        let middles = gaps.iter().map(|gap| gap.middle).filter(|&m| site.place.contains(m));
        let goals: Vec<Point> = near.iter().copied().chain(middles).collect();
        let ways = near.iter().flat_map(|&from| goals.iter().map(move |&to| to - from));
        site.headings.extend(ways.filter(|way| way.norm() > LINE).map(|way| way.y.atan2(way.x)));
    }
    let mut best: BTreeMap<(Piece, Piece), Lane> = BTreeMap::new();
    for site in &sites {
        for (pieces, lane) in self::best(plan, site) {
            let is_shorter = best.get(&pieces).is_none_or(|b| lane.length() < b.length());
            if is_shorter {
                best.insert(pieces, lane);
            }
        }
    }
    let both = best.iter().filter(|((from, to), _)| from < to);
    let straits = both.filter_map(|(&(from, to), &lane)| {
        let back = *best.get(&(to, from))?;
        Some(Strait { lanes: [lane, back], doorways: Vec::new() })
    });
    straits.collect()
}

/// A place in each piece of centre space of so little area that lines may miss it.
fn small_pieces(cells: &Mesh) -> Vec<Point> {
    let mut pieces = vec![(0.0, 0.0, Point::origin()); cells.components as usize];
    for cell in cells.cells() {
        let (area, largest, place) = &mut pieces[cells.component(cell) as usize];
        let polygon = cells.polygon(cell);
        let own = polygon.signed_area();
        *area += own;
        if own > *largest {
            (*largest, *place) = (own, polygon.centroid());
        }
    }
    const SMALL: f64 = 10.0 * LINE * LINE;
    pieces.into_iter().filter(|piece| piece.0 < SMALL).map(|piece| piece.2).collect()
}

/// The shortest lane from every piece to every other that a site joins.
fn best(plan: &FloorPlan, site: &Site<'_>) -> Vec<((Piece, Piece), Lane)> {
    let mut headings: Vec<f64> = (0..12).map(|k| f64::from(k) * TURN).collect();
    headings.extend(site.headings.iter().map(|h| h.rem_euclid(PI)));
    headings.sort_by(f64::total_cmp);
    headings.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    let is_symmetric = is_symmetric(&plan.robot().footprint);
    let mut best: BTreeMap<(Piece, Piece), Vec<Lane>> = BTreeMap::new();
    for heading in headings {
        let mut lanes = along(plan, site, heading);
        if is_symmetric {
            let back = |&((from, to), lane): &((Piece, Piece), Lane)| ((to, from), lane.reversed());
            lanes.extend(lanes.iter().map(back).collect::<Vec<_>>());
        } else {
            lanes.extend(along(plan, site, heading + PI));
        }
        for (pieces, lane) in lanes {
            let found = best.entry(pieces).or_default();
            if found.first().is_none_or(|b| lane.length() < b.length() - 1.0) {
                found.clear();
            }
            if found.first().is_none_or(|b| lane.length() < b.length() + 1.0) {
                found.push(lane);
            }
        }
    }
    // Of equals the one in the middle keeps furthest from both sides.
    let middle = best.into_iter().map(|(pieces, mut found)| {
        let middle = found.len() / 2;
        (pieces, found.swap_remove(middle))
    });
    middle.filter(|(_, lane)| is_clear(plan.robot(), site, lane)).collect()
}

/// Whether a footprint is the same when it has turned half about.
fn is_symmetric(footprint: &[Point]) -> bool {
    footprint.iter().all(|p| footprint.iter().any(|q| (p.coords + q.coords).norm() < 1e-9))
}

/// Whether the body on its way along a lane touches nothing solid: asked of the things themselves, whatever the
/// floor made of them says.
fn is_clear(robot: &RobotProfile, site: &Site<'_>, lane: &Lane) -> bool {
    let [a, b] = lane.ends;
    let Some(way) = (b - a).try_normalize(0.0) else { return false };
    let swept = over(&body(robot, way), lane.ends);
    let bounds = swept.bounds();
    let is_off = |solid: &Polygon| !solid.bounds().meets(&bounds) || distance(solid, &swept) > 0.0;
    site.fragments.iter().all(|(_, fragment)| {
        fragment.obstacles().iter().all(|o| is_off(&o.polygon))
            && fragment.walls.iter().all(|&(a, b)| is_off(&Polygon::new(vec![a, b])))
    })
}

/// The lanes of one heading, each with the pieces from and to which it leads.
fn along(plan: &FloorPlan, site: &Site<'_>, heading: f64) -> Vec<((Piece, Piece), Lane)> {
    let scan = Scan::of(plan.robot(), site, Vector::new(heading.cos(), heading.sin()));
    // Between the corners' own lines nothing changes: one line in each stretch misses no gap, however tight.
    let stretches = scan.marks.windows(2).filter(|m| m[1] - m[0] > 1e-4);
    let between = stretches.map(|m| (m[0] + m[1]) / 2.0);
    let through = site.spots.iter().map(|p| p.coords.dot(&scan.across));
    let through = through.filter(|offset| (scan.low..=scan.high).contains(offset));
    let mut found = Vec::new();
    scan.regular()
        .chain(between)
        .chain(through)
        .for_each(|offset| scan.lanes_at(offset, &mut found));
    found
}

/// The lines of one heading over a site.
struct Scan<'a> {
    site: &'a Site<'a>,
    way: Vector,
    across: Vector,
    /// How far the site reaches along and across.
    left: f64,
    right: f64,
    low: f64,
    high: f64,
    /// The outlines of where the centre of a robot with this heading may be: how far along and across their edges begin
    /// and end.
    edges: Vec<[(f64, f64); 2]>,
    /// The offsets of the outlines' corners, which rise.
    marks: Vec<f64>,
}

impl<'a> Scan<'a> {
    fn of(robot: &RobotProfile, site: &'a Site<'a>, way: Vector) -> Self {
        let across = Vector::new(-way.y, way.x);
        let Bounds { min, max } = site.place;
        let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
        let extent = |v: Vector| {
            corners
                .iter()
                .map(|c| c.coords.dot(&v))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |e, x| (e.0.min(x), e.1.max(x)))
        };
        let ((left, right), (low, high)) = (extent(way), extent(across));
        let mut edges = Vec::new();
        for contour in clear(robot, site, way).iter().flatten() {
            let at = |p: Point| (p.coords.dot(&way), p.coords.dot(&across));
            edges.extend(site.grid.polygon(contour).edges().map(|(a, b)| [at(a), at(b)]));
        }
        let mut marks: Vec<f64> = edges.iter().map(|edge| edge[0].1).collect();
        marks.retain(|m| (low..=high).contains(m));
        marks.sort_by(f64::total_cmp);
        marks.dedup();
        Self { site, way, across, left, right, low, high, edges, marks }
    }

    /// Offsets at the usual distance.
    fn regular(&self) -> impl Iterator<Item = f64> + use<> {
        let (low, width) = (self.low, self.high - self.low);
        let count = (width / LINE) as usize;
        (0..=count).map(move |k| low + width * (k as f64 + 0.5) / (count as f64 + 1.0))
    }

    /// From where to where the centre may be on a line.
    fn stretches(&self, offset: f64) -> Vec<(f64, f64)> {
        let crossed = self.edges.iter().filter(|[a, b]| (a.1 <= offset) != (b.1 <= offset));
        let mut met: Vec<f64> =
            crossed.map(|[a, b]| a.0 + (b.0 - a.0) * ((offset - a.1) / (b.1 - a.1))).collect();
        met.sort_by(f64::total_cmp);
        let mut stretches: Vec<(f64, f64)> = met.chunks_exact(2).map(|c| (c[0], c[1])).collect();
        stretches.dedup_by(|next, last| {
            let joins = next.0 <= last.1 + 1e-4;
            if joins {
                last.1 = next.1;
            }
            joins
        });
        stretches
    }

    /// Adds the lanes on one line, each with the pieces from and to which it leads.
    fn lanes_at(&self, offset: f64, found: &mut Vec<((Piece, Piece), Lane)>) {
        let stretches = self.stretches(offset);
        if stretches.is_empty() {
            return;
        }
        let at = |t: f64| Point::from(self.way * t + self.across * offset);
        let (a, b) = (at(self.left), at(self.right));
        let length = self.right - self.left;
        let mut cells: Vec<(f64, f64, CellKey, Piece)> = Vec::new();
        let mut near = Vec::new();
        for &(number, fragment) in self.site.fragments {
            fragment.cells.near_segment(a, b, &mut near);
            for &cell in &near {
                let Some((s, e)) = fragment.cells.clip(cell, a, b) else { continue };
                let piece = (number, fragment.cells.component(cell));
                let (s, e) = (self.left + s * length, self.left + e * length);
                cells.push((s, e, (number, cell), piece));
            }
        }
        cells.order_by(|x, y| x.0.total_cmp(&y.0));
        for (from, to) in stretches {
            let within =
                cells.iter().map(|&(s, e, cell, piece)| (s.max(from), e.min(to), cell, piece));
            let stands: Vec<_> = within.filter(|(s, e, ..)| e - s > 1e-6).collect();
            for pair in stands.windows(2) {
                let (near, far) = (pair[0], pair[1]);
                if near.3 == far.3 || far.0 <= near.1 {
                    continue;
                }
                let foothold = |(s, e, ..): (f64, f64, CellKey, Piece)| FOOTHOLD.min((e - s) / 2.0);
                let ends = [at(near.1 - foothold(near)), at(far.0 + foothold(far))];
                found.push(((near.3, far.3), Lane { ends, cells: [near.2, far.2] }));
            }
        }
    }
}

/// Where the centre of a robot that heads along `way` may be at the site.
fn clear(robot: &RobotProfile, site: &Site<'_>, way: Vector) -> Shapes {
    let body = body(robot, way);
    let extent = body.iter().map(|v| v.norm()).fold(0.0, f64::max);
    let near: Vec<(Point, Point)> = meeting(site.edges, &site.place.grown(extent + 1.0)).collect();
    shrunk(&site.grid, site.floor, &near, &body)
}
