//! Narrows: where solids stand so close that the robot does not pass between them, and which pieces of centre space
//! they part (W5).
//!
//! A narrow place is a chord: the shortest line from one solid to another, with nothing in the disc about it. All
//! chords that are shorter than the robot is wide cut the floor into basins. A piece of centre space crosses no chord, so
//! it lies in one basin, and two pieces never lie in the same: what would lead from one to the other without a chord is
//! as wide as the robot. So the widest gap between two pieces is the least chord of the best way over basins without a piece.
//!
//! ```text
//!   ┌────────────┬──────────┐
//!   │            ┊ 38       │     two pieces, a and b; the pocket between the chords of 38 and 22
//!   │  a      ┌──┴──┐   b   │     holds none
//!   │         └──┬──┘       │
//!   │  ┌────┐22┌─┴─┐        │
//!   └──┴────┴┄┄┴───┴────────┘
//! ```

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, HashMap};

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::map::Permeability;
use crate::units::{InOrder as _, Point, Vector};

use super::blocker::Blocker;
use super::buckets::Buckets;
use super::cells::Piece;
use super::floor::FragmentFloor;
use super::grid::{Contour, Grid, difference, overlay};
use super::mesh::Mesh;
use super::mouth::thick;
use super::plan::FloorPlan;
use super::{Bounds, Polygon, Region, nearest_on_segment};

/// A gap between two solids.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Narrow {
    /// In cm.
    pub(super) width: f64,
    pub(super) middle: Point,
    /// From one solid to the other.
    pub(super) along: Vector,
    /// Around the gap and the basins on both of its sides that hold no piece.
    pub(super) reach: Bounds,
    pub(super) between: Vec<Blocker>,
}

/// The narrow places of some floor.
#[derive(Debug)]
pub(super) struct Narrows {
    pub(super) grid: Grid,
    pub(super) floor: Vec<Contour>,
    found: Vec<Narrow>,
    /// For each basin the narrow places around it, each with the basin beyond.
    beyond: Vec<Vec<(usize, usize)>>,
    /// The basin of each piece.
    home: BTreeMap<Piece, usize>,
    /// The pieces in each basin that has any; of Fragments side by side several, which are joined.
    pieces: BTreeMap<usize, Vec<Piece>>,
}

/// Solids nearer than this, in cm, touch.
const TOUCH: f64 = 0.05;
/// A disc that is met by so little, in cm, is not met.
const PLAY: f64 = 1e-4;

impl Narrows {
    /// The narrow places of Fragments that lie side by side, or of one.
    pub(super) fn of(plan: &FloorPlan, numbers: &[u32]) -> Self {
        let floors: Vec<(u32, &FragmentFloor)> =
            numbers.iter().map(|&n| (n, plan.floor(n))).collect();
        let pieces: Vec<(Piece, Point)> =
            floors.iter().flat_map(|&(n, floor)| pieces(n, floor)).collect();
        let bounds = floors.iter().fold(Bounds::EMPTY, |b, (_, f)| b.union(&f.bounds));
        let bounds = bounds.grown(4.0 * plan.reach() + 200.0);
        let grid =
            floors.first().map_or_else(|| Grid::over(&bounds), |f| f.1.grid.covering(&bounds));
        let mut narrows = Self {
            grid,
            floor: Vec::new(),
            found: Vec::new(),
            beyond: Vec::new(),
            home: BTreeMap::new(),
            pieces: BTreeMap::new(),
        };
        if pieces.len() < 2 {
            return narrows;
        }
        let raw: Vec<Region> = floors.iter().flat_map(|(_, f)| f.raw()).collect();
        let raw: Vec<Contour> =
            raw.iter().flat_map(Region::contours).map(|c| grid.contour(c)).collect();
        let mut floor = overlay(&raw, &[], OverlayRule::Subject, FillRule::Positive);
        if numbers.len() > 1 {
            // Rooms that share a wall without thickness would grow together.
            let walls: Vec<(Point, Point)> =
                floors.iter().flat_map(|(_, f)| &f.walls).copied().collect();
            let walls: Vec<Contour> =
                walls.iter().map(|&w| grid.contour(&thick(w, &walls, &grid))).collect();
            let merged: Vec<Contour> = floor.into_iter().flatten().collect();
            floor = difference(&merged, &walls);
        }
        let chords = chords(&grid.regions(&floor), 2.0 * plan.reach());
        let cuts: Vec<Contour> = chords.iter().map(|c| grid.contour(&strip(c, &grid))).collect();
        narrows.floor = floor.into_iter().flatten().collect();
        // A basin is a component of the mesh.
        let basins = Mesh::of(&grid, &difference(&narrows.floor, &cuts), 0);
        let mut boxes = vec![Bounds::EMPTY; basins.components as usize];
        for cell in basins.cells() {
            let reach = &mut boxes[basins.component(cell) as usize];
            *reach = reach.union(&basins.polygon(cell).bounds());
        }
        let basin_at = |p: Point| Some(basins.component(basins.locate(p, 0.0)?) as usize);
        let owners: Vec<Owners<'_>> = floors.iter().map(|(_, f)| Owners::of(f)).collect();
        narrows.beyond.resize(boxes.len(), Vec::new());
        for (piece, at) in pieces {
            if let Some(basin) = basin_at(at) {
                narrows.home.insert(piece, basin);
                narrows.pieces.entry(basin).or_default().push(piece);
            }
        }
        for (p, q) in chords {
            let (middle, along) = (nalgebra::center(&p, &q), q - p);
            let aside = Vector::new(-along.y, along.x).normalize() * ASIDE;
            let (Some(one), Some(other)) = (basin_at(middle + aside), basin_at(middle - aside))
            else {
                continue;
            };
            let owners = [p, q].map(|end| owners.iter().find_map(|known| known.at(end)));
            // What nobody owns is the rim of the floor that is looked at, and no gap.
            if let ([Some(a), Some(b)], true) = (owners, one != other) {
                let between = if a == b { vec![a] } else { vec![a, b] };
                let number = narrows.found.len();
                let mut reach = Bounds::of([p, q]);
                for basin in [one, other].into_iter().filter(|b| !narrows.pieces.contains_key(b)) {
                    reach = reach.union(&boxes[basin]);
                }
                narrows.found.push(Narrow { width: along.norm(), middle, along, reach, between });
                narrows.beyond[one].push((number, other));
                narrows.beyond[other].push((number, one));
            }
        }
        narrows
    }

    /// The pieces that gaps alone part from one, each with the widest gap between them; only gaps that are admitted count.
    pub(super) fn around(
        &self,
        piece: Piece,
        admits: impl Fn(&Narrow) -> bool,
    ) -> Vec<(Piece, &Narrow)> {
        let Some(&home) = self.home.get(&piece) else { return Vec::new() };
        let mut found = Vec::new();
        // The widest ways over basins without a piece, by the least gap of each.
        let mut done = BTreeSet::new();
        let bits = |width: f64| width.to_bits();
        let mut open = BinaryHeap::from([(bits(f64::INFINITY), Reverse(home), usize::MAX)]);
        while let Some((width, Reverse(basin), least)) = open.pop() {
            if !done.insert(basin) {
                continue;
            }
            if let Some(pieces) = self.pieces.get(&basin).filter(|_| basin != home) {
                found.extend(pieces.iter().map(|&to| (to, &self.found[least])));
                continue;
            }
            let admitted = self.beyond[basin].iter().filter(|(n, _)| admits(&self.found[*n]));
            for &(number, beyond) in admitted {
                let own = bits(self.found[number].width);
                let (width, least) = if own < width { (own, number) } else { (width, least) };
                open.push((width, Reverse(beyond), least));
            }
        }
        found
    }

    /// All gaps that may lie on a way from one piece to another over basins without a piece, the widest first.
    pub(super) fn all_between(&self, one: Piece, other: Piece) -> Vec<&Narrow> {
        let [Some(one), Some(other)] = [one, other].map(|piece| self.home.get(&piece).copied())
        else {
            return Vec::new();
        };
        let [near, far] = [one, other].map(|from| self.pockets(from));
        let mut found: Vec<&Narrow> = Vec::new();
        for (basin, beyond) in self.beyond.iter().enumerate() {
            for &(number, next) in beyond {
                let leads = |a: usize, b: usize| near.contains(&a) && far.contains(&b);
                if basin < next && (leads(basin, next) || leads(next, basin)) {
                    found.push(&self.found[number]);
                }
            }
        }
        found.order_by(|a, b| b.width.total_cmp(&a.width));
        found
    }

    /// The gaps of some width at least that lie on a way between two pieces, each once.
    pub(super) fn parting(&self, least: f64) -> Vec<&Narrow> {
        let pockets: Vec<BTreeSet<usize>> =
            self.pieces.keys().map(|&home| self.pockets(home)).collect();
        let mut found = BTreeSet::new();
        for (basin, beyond) in self.beyond.iter().enumerate() {
            for &(number, next) in beyond {
                let parts = |(k, near): (usize, &BTreeSet<usize>)| {
                    let leads = |far: &BTreeSet<usize>| far.contains(&next);
                    near.contains(&basin)
                        && pockets.iter().enumerate().any(|(l, far)| l != k && leads(far))
                };
                if self.found[number].width >= least && pockets.iter().enumerate().any(parts) {
                    found.insert(number);
                }
            }
        }
        found.into_iter().map(|number| &self.found[number]).collect()
    }

    /// A piece's basin, and those without a piece that hang on it.
    fn pockets(&self, home: usize) -> BTreeSet<usize> {
        let (mut seen, mut open) = (BTreeSet::from([home]), vec![home]);
        while let Some(basin) = open.pop() {
            for &(_, next) in &self.beyond[basin] {
                if !self.pieces.contains_key(&next) && seen.insert(next) {
                    open.push(next);
                }
            }
        }
        seen
    }
}

/// So far beside a chord its two basins are looked for, in cm.
const ASIDE: f64 = 0.02;

/// A place in each piece of a Fragment's centre space.
fn pieces(number: u32, floor: &FragmentFloor) -> Vec<(Piece, Point)> {
    let first = |component| floor.cells.cells().find(|&c| floor.cells.component(c) == component);
    (0..floor.cells.components)
        .filter_map(|component| {
            let cell = first(component)?;
            Some(((number, component), floor.cells.polygon(cell).centroid()))
        })
        .collect()
}

/// The shortest lines between edges of a floor that are nearer than `widest`, where nothing else comes into the disc.
fn chords(floor: &[Region], widest: f64) -> Vec<(Point, Point)> {
    let edges: Vec<(Point, Point)> =
        floor.iter().flat_map(Region::contours).flat_map(Polygon::edges).collect();
    let boxes: Vec<Bounds> = edges.iter().map(|&(a, b)| Bounds::of([a, b])).collect();
    let buckets = Buckets::of(&boxes);
    let reach = boxes.iter().fold(Bounds::EMPTY, |all, b| all.union(b));
    let (mut near, mut about) = (Vec::new(), Vec::new());
    let mut found: Vec<(Point, Point)> = Vec::new();
    // Those that were found, by the places of their middles.
    let mut known: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    let place = |p: Point| ((p.x / TOUCH).floor() as i64, (p.y / TOUCH).floor() as i64);
    for (i, &one) in edges.iter().enumerate() {
        buckets.meeting(&boxes[i].grown(widest), &mut near);
        for &j in near.iter().filter(|&&j| j as usize > i) {
            let (p, q) = nearest(one, edges[j as usize]);
            let width = (q - p).norm();
            if width <= TOUCH || width >= widest - PLAY {
                continue;
            }
            let middle = nalgebra::center(&p, &q);
            buckets.meeting(&Bounds::of([middle]).grown(width / 2.0), &mut about);
            let is_met = about.iter().any(|&k| {
                let (a, b) = edges[k as usize];
                (nearest_on_segment(middle, a, b) - middle).norm() < width / 2.0 - PLAY
            });
            if is_met {
                continue;
            }
            let ray = Bounds { min: middle, max: Point::new(reach.max.x, middle.y) };
            buckets.meeting(&ray, &mut about);
            let crosses = |&&k: &&u32| {
                let (a, b) = edges[k as usize];
                let x = || a.x + (middle.y - a.y) / (b.y - a.y) * (b.x - a.x);
                (a.y > middle.y) != (b.y > middle.y) && x() > middle.x
            };
            if about.iter().filter(crosses).count() % 2 == 0 {
                continue;
            }
            let is_same = |&(u, v): &(Point, Point)| {
                let apart = |p: Point, q: Point| (u - p).norm() + (v - q).norm();
                apart(p, q).min(apart(q, p)) < TOUCH
            };
            let (x, y) = place(middle);
            let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
            let mut alike = around.filter_map(|at| known.get(&at)).flatten();
            if !alike.any(|&k| is_same(&found[k])) {
                known.entry((x, y)).or_default().push(found.len());
                found.push((p, q));
            }
        }
    }
    found
}

/// The points of two segments that are nearest to each other.
fn nearest((a, b): (Point, Point), (u, v): (Point, Point)) -> (Point, Point) {
    let onto = |p: Point, a: Point, b: Point| nearest_on_segment(p, a, b);
    let pairs = [(a, onto(a, u, v)), (b, onto(b, u, v)), (onto(u, a, b), u), (onto(v, a, b), v)];
    let length = |pair: &(Point, Point)| (pair.1 - pair.0).norm();
    pairs
        .into_iter()
        .fold(pairs[0], |best, next| if length(&next) < length(&best) { next } else { best })
}

/// A chord as a cut through the floor, from solid into solid.
fn strip(&(p, q): &(Point, Point), grid: &Grid) -> Polygon {
    let along = (q - p).normalize();
    let half = (TOUCH / 10.0).max(4.0 / grid.scale);
    let aside = Vector::new(-along.y, along.x) * half;
    let (p, q) = (p - along * half, q + along * half);
    Polygon::new(vec![p - aside, q - aside, q + aside, p + aside])
}

/// What the points on the rim of a Fragment's floor belong to.
struct Owners<'a> {
    floor: &'a FragmentFloor,
    obstacles: Buckets,
}

impl<'a> Owners<'a> {
    fn of(floor: &'a FragmentFloor) -> Self {
        let boxes: Vec<Bounds> =
            floor.obstacles().iter().map(|o| o.polygon.bounds().grown(TOUCH)).collect();
        Self { floor, obstacles: Buckets::of(&boxes) }
    }

    fn at(&self, p: Point) -> Option<Blocker> {
        let floor = self.floor;
        let touches = |polygon: &Polygon| {
            polygon.bounds().grown(TOUCH).contains(p) && polygon.border_distance(p) <= TOUCH
        };
        let on = |a: Point, b: Point| (nearest_on_segment(p, a, b) - p).norm() <= TOUCH;
        let mut near = self.obstacles.near(p).iter().map(|&k| &floor.obstacles()[k as usize]);
        let thing = near.find(|o| touches(&o.polygon)).map(|o| o.blocker);
        let solid = |s: &&super::storey::Side| s.permeability != Permeability::Permeable;
        let side = || floor.edging.sides.iter().filter(solid).find(|s| on(s.start, s.end));
        let wall =
            || side().map(|s| Blocker::Wall { area: floor.area, item: s.item, side: s.side });
        let jamb = || floor.walls.iter().any(|&(a, b)| on(a, b)).then(|| Blocker::jamb(floor.area));
        thing.or_else(wall).or_else(jamb)
    }
}
