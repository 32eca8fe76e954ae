//! The shortest way of a disc, by looking from corner to corner: slow, and apart from everything that it judges.
//!
//! Things grow by a polygon whose corners lie *on* the disc's circle, so that what is found is never longer than
//! the true shortest way, and shorter by a hair.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use std::f64::consts::TAU;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use orthoframe_geometry::{Scene, convex_hull};
use orthoframe_map::Permeability;
use orthoframe_units::{MapId, Point, Vector};

use crate::generated::Generated;

/// Corners of the polygon that stands for the circle.
const ROUND: usize = 48;
/// Width of the buckets that edges are sorted into, in cm.
const BUCKET: f64 = 100.0;
const TOUCH: f64 = 1e-5;

/// The edges of the grown things, each with what lies before and after it.
pub(crate) struct Sight {
    /// Corners with their neighbours along the outline; the blocked side lies to the right.
    corners: Vec<[Point; 3]>,
    /// Whether the floor's border turns to the left at the start: no straight way leads on through there.
    edges: Vec<(Point, Point, bool)>,
    buckets: HashMap<(i32, i32), Vec<u32>>,
}

impl Sight {
    pub(crate) fn of(floor: &Generated, radius: f64) -> Self {
        let scene = Scene::of(&floor.builder.world, MapId(1));
        let mut solids: Vec<Vec<Point>> = Vec::new();
        for prism in scene.areas.values().flat_map(|a| &a.prisms) {
            for (side, (a, b)) in prism.sides.iter().zip(prism.polygon.edges()) {
                if side.permeability == Permeability::Impermeable {
                    solids.push(vec![a, b]);
                }
            }
        }
        let parts = scene.replicas.values().flat_map(|r| &r.prisms);
        solids.extend(parts.map(|p| p.polygon.corners.clone()));
        let grown: Vec<Vec<[f64; 2]>> = solids.iter().map(|s| grow(s, radius)).collect();
        let shapes =
            grown.overlay(&Vec::<Vec<[f64; 2]>>::new(), OverlayRule::Subject, FillRule::NonZero);
        let mut sight = Self { corners: vec![], edges: vec![], buckets: HashMap::new() };
        for contour in shapes.iter().flatten() {
            let n = contour.len();
            let at = |i: usize| Point::new(contour[i % n][0], contour[i % n][1]);
            for i in 0..n {
                // Outlines run counter-clockwise round what is solid: reversed, the floor lies to the left.
                let [before, here, after] = [at(i + 1), at(i), at(i + n - 1)];
                if (here - before).perp(&(after - here)) < 0.0 {
                    sight.corners.push([before, here, after]);
                }
                let is_niche = (here - before).perp(&(after - here)) > TOUCH;
                let number = sight.edges.len() as u32;
                sight.edges.push((here, at(i + 1), is_niche));
                for bucket in buckets(here, at(i + 1)) {
                    sight.buckets.entry(bucket).or_default().push(number);
                }
            }
        }
        sight
    }

    fn sees(&self, a: Point, b: Point) -> bool {
        let length = (b - a).norm();
        if length < TOUCH {
            return true;
        }
        let along = (b - a) / length;
        let crosses = |&number: &u32| {
            let (u, v, is_niche) = self.edges[number as usize];
            let (su, sv) = (along.perp(&(u - a)), along.perp(&(v - a)));
            let place = along.dot(&(u - a));
            if is_niche && su.abs() <= TOUCH && place > TOUCH && place < length - TOUCH {
                return true;
            }
            if su.abs() <= TOUCH || sv.abs() <= TOUCH || su * sv > 0.0 {
                return false;
            }
            let t = along.dot(&(u + (v - u) * (su / (su - sv)) - a));
            t > TOUCH && t < length - TOUCH
        };
        let mut near = buckets(a, b);
        !near.any(|bucket| self.buckets.get(&bucket).is_some_and(|list| list.iter().any(crosses)))
    }

    /// Length of the shortest way, given the length of one that is known: no corner lies on a shorter way unless
    /// the distances to both ends are within it.
    pub(crate) fn shortest(&self, from: Point, to: Point, known: f64) -> Option<f64> {
        // Ours may cut a hair off, by the slack that it forgives.
        let limit = known + 0.05;
        let near = |c: &&[Point; 3]| (c[1] - from).norm() + (to - c[1]).norm() <= limit;
        let corners: Vec<[Point; 3]> = self.corners.iter().filter(near).copied().collect();
        let place = |node: usize| match node {
            0 => from,
            1 => to,
            other => corners[other - 2][1],
        };
        // A way bends at a corner only towards the solid side, so it must leave the corner along a tangent.
        let touches = |node: usize, other: Point| {
            node < 2 || {
                let [before, here, after] = corners[node - 2];
                let along = other - here;
                let (s, t) = (along.perp(&(before - here)), along.perp(&(after - here)));
                let slack = TOUCH * along.norm();
                (s >= -slack && t >= -slack) || (s <= slack && t <= slack)
            }
        };
        let count = corners.len() + 2;
        let mut spent = vec![f64::INFINITY; count];
        let mut done = vec![false; count];
        spent[0] = 0.0;
        let mut open = BinaryHeap::from([(Reverse(0_u64), 0_usize)]);
        while let Some((_, node)) = open.pop() {
            if std::mem::replace(&mut done[node], true) {
                continue;
            }
            if node == 1 {
                return Some(spent[1]);
            }
            let here = place(node);
            for next in 1..count {
                let there = place(next);
                let cost = spent[node] + (there - here).norm();
                let bound = cost + (to - there).norm();
                if !done[next]
                    && cost < spent[next]
                    && bound <= limit
                    && touches(node, there)
                    && touches(next, here)
                    && self.sees(here, there)
                {
                    spent[next] = cost;
                    open.push((Reverse(bound.to_bits()), next));
                }
            }
        }
        None
    }
}

/// The convex hull of a polygon inscribed in the circle round every corner, counter-clockwise.
fn grow(solid: &[Point], radius: f64) -> Vec<[f64; 2]> {
    let ring = |c: &Point| {
        let c = *c;
        (0..ROUND).map(move |k| {
            let angle = TAU * k as f64 / ROUND as f64;
            c + Vector::new(angle.cos(), angle.sin()) * radius
        })
    };
    let mut points: Vec<Point> = solid.iter().flat_map(ring).collect();
    // Sides moved by the whole radius, whichever way they run.
    for i in 0..solid.len() {
        let (a, b) = (solid[i], solid[(i + 1) % solid.len()]);
        if let Some(along) = (b - a).try_normalize(0.0) {
            let out = Vector::new(along.y, -along.x) * radius;
            points.extend([a + out, b + out, a - out, b - out]);
        }
    }
    convex_hull(points).into_iter().map(|p| [p.x, p.y]).collect()
}

/// The buckets that a segment may pass.
fn buckets(a: Point, b: Point) -> impl Iterator<Item = (i32, i32)> {
    let cell = |v: f64| (v / BUCKET).floor() as i32;
    let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
    (cell(low.y - TOUCH)..=cell(high.y + TOUCH)).flat_map(move |row| {
        let rise = (high.y - low.y).max(1e-12);
        let at = |y: f64| low.x + (high.x - low.x) * ((y - low.y) / rise).clamp(0.0, 1.0);
        let (p, q) = (at(f64::from(row) * BUCKET - TOUCH), at(f64::from(row + 1) * BUCKET + TOUCH));
        let is_level = high.y - low.y < 2.0 * TOUCH;
        let (p, q) = if is_level { (low.x, high.x) } else { (p, q) };
        (cell(p.min(q) - TOUCH)..=cell(p.max(q) + TOUCH)).map(move |column| (column, row))
    })
}
