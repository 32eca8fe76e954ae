//! Floor that a robot with a convex footprint covers though its covering disc does not: it stands along a wall in a
//! corner, pokes into a niche, passes a gap lengthwise.
//!
//! A dead zone of the disc is covered where the footprint, with its clearance, lies clear of everything at some place
//! and heading; whether it can drive there does not matter. For one heading that is the morphological opening of the
//! floor by the turned footprint: the floor is shrunk by it (Minkowski), which leaves the clear places, and what is
//! left is swept with it. The union is taken over many headings:
//!
//! ```text
//!   ┌──────────────        regular ones, by [`TURN`];
//!   │╲▒▒│    │             those at which an edge of the footprint lies along an edge nearby;
//!   │ ╲▒│    │   ▒ dead    those across a gap between two corners that is just as wide as the footprint;
//!   │  ╲└────┘             the lanes' of straits
//! ```
//!
//! Between headings the union has teeth, where a corner of the footprint was turned on, and a body that pokes into the
//! mouth of a narrow gap covers a little of it. Both would cost Passframes: the teeth are evened by [`EVEN`] of the
//! robot's radius to either side, and only pieces that hold a disc of [`DEEP`] of it count. So what is covered may be
//! told dead within 14 % of the radius of a dead zone, as for a disc ([`super::offset`]), and what is not free within 4 %.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::map::RobotProfile;
use crate::units::{Point, Vector};

use super::grid::{Contour, Grid, Shapes, difference, intersection, positive};
use super::offset::shrink;
use super::site::SLACK;
use super::{Bounds, Polygon, convex_hull, nearest_on_segment};

/// Headings are tried at this step, in radians.
const TURN: f64 = PI / 36.0;

/// What is covered is evened by so much, in radii of the robot: the teeth between two headings.
const EVEN: f64 = 0.04;

/// The disc that the mouth of a narrow gap does not hold, in radii of the robot.
const DEEP: f64 = 0.07;

/// Headings and directions that differ less, in radians, are one.
const SAME: f64 = 1e-5;

/// A Fragment's floor and that of its neighbours through open doorways, as far as the body reaches.
pub(super) struct Coverage<'a> {
    pub(super) robot: &'a RobotProfile,
    pub(super) grid: Grid,
    pub(super) floor: Vec<Contour>,
    /// All that the body must not touch: the floor's edges, walls without thickness, shut doorways.
    pub(super) edges: Vec<(Point, Point)>,
    /// Headings of straits' lanes, in radians.
    pub(super) lanes: Vec<f64>,
}

impl Coverage<'_> {
    /// What is left of a dead zone of the disc.
    pub(super) fn left_of(&self, zone: &[Contour]) -> Shapes {
        let extent = extent(self.robot);
        let bounds = Bounds::of(zone.iter().flatten().map(|&n| self.grid.point(n)));
        let place = bounds.grown(extent + 1.0);
        let near: Vec<(Point, Point)> = meeting(&self.edges, &place.grown(extent + 1.0)).collect();
        let ground = self.cut(&self.floor, &place);
        let (headings, width) = self.headings(&near);
        let mut left = vec![zone.to_vec()];
        for heading in headings {
            let way = Vector::new(heading.cos(), heading.sin());
            let body = about_middle(body(self.robot, way));
            let Bounds { min, max } = Bounds::of(body.iter().map(|&v| Point::from(v)));
            // Bodies placed further off do not touch the zone.
            let around = Bounds { min: bounds.min - max.coords, max: bounds.max - min.coords };
            let touching = Bounds { min: around.min + min.coords, max: around.max + max.coords };
            let close: Vec<(Point, Point)> = meeting(&near, &touching.grown(1.0)).collect();
            let covered = self.swept(&shrunk(&self.grid, &ground, &close, &body), &body, &bounds);
            if covered.is_empty() {
                continue;
            }
            let flat: Vec<Contour> = left.into_iter().flatten().collect();
            left = difference(&flat, &covered);
            left.retain(|shape| !is_rim(&self.grid, shape));
            if left.is_empty() {
                return left;
            }
        }
        self.without_teeth(zone, left, width)
    }

    /// What a body passes over about a place if it is set down anywhere in `clear`. What rounding and slack leave along the
    /// walls belongs to it.
    fn swept(&self, clear: &Shapes, body: &[Vector], place: &Bounds) -> Vec<Contour> {
        let wider = body.iter().flat_map(|&v| {
            let sides = [(1., 1.), (-1., 1.), (-1., -1.), (1., -1.)];
            sides.map(|(x, y)| Point::from(v + Vector::new(x, y) * RIM))
        });
        let wider: Vec<Vector> = convex_hull(wider.collect()).iter().map(|p| p.coords).collect();
        let mut covered: Vec<Contour> = Vec::new();
        for contour in clear.iter().flatten() {
            let polygon = self.grid.polygon(contour);
            let swept = polygon.edges().map(|(a, b)| over(&wider, [a, b]));
            let near = swept.filter(|s| s.bounds().meets(place));
            covered.extend(near.map(|s| self.grid.contour(&s)));
            if polygon.bounds().meets(place) {
                covered.push(contour.clone());
            }
        }
        covered
    }

    /// The dead zone less what is worth a Passframe of that which a body so wide covers of it.
    fn without_teeth(&self, zone: &[Contour], left: Shapes, width: f64) -> Shapes {
        let radius = self.robot.radius.get();
        let deep = (DEEP * radius).min(width * 0.4);
        let left: Vec<Contour> = left.into_iter().flatten().collect();
        let mut covered = difference(zone, &left);
        covered.retain(|shape| {
            let regions = self.grid.regions(&vec![shape.clone()]);
            !positive(&shrink(&self.grid, &regions, deep)).is_empty()
        });
        let rim: Vec<(Point, Point)> =
            zone.iter().flat_map(|c| self.grid.polygon(c).edges().collect::<Vec<_>>()).collect();
        let even =
            |c: &Contour| self.grid.contour(&evened(&self.grid.polygon(c), &rim, EVEN * radius));
        let covered: Vec<Contour> = covered.iter().flatten().map(even).collect();
        let mut left = difference(zone, &covered);
        left.retain(|shape| !is_rim(&self.grid, shape));
        left
    }

    fn cut(&self, contours: &[Contour], place: &Bounds) -> Vec<Contour> {
        let Bounds { min, max } = *place;
        let square = vec![min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
        let square = self.grid.contour(&Polygon::new(square));
        intersection(contours, &[square]).into_iter().flatten().collect()
    }

    /// The headings that are tried, in radians, and how wide the body is at its narrowest, in cm.
    fn headings(&self, near: &[(Point, Point)]) -> (Vec<f64>, f64) {
        let upright =
            Polygon::new(body(self.robot, Vector::x()).into_iter().map(Point::from).collect());
        let angle = |v: Vector| v.y.atan2(v.x);
        let sides: Vec<(f64, f64)> = upright
            .edges()
            .filter_map(|(a, b)| {
                let along = (b - a).try_normalize(1e-9)?;
                let off = |c: &Point| along.perp(&(c - a));
                Some((angle(along), upright.corners.iter().map(off).fold(0.0, f64::max)))
            })
            .collect();
        let width = sides.iter().map(|side| side.1).fold(f64::INFINITY, f64::min);
        let mut directions: Vec<f64> =
            near.iter().map(|&(a, b)| angle(b - a).rem_euclid(PI)).collect();
        distinct(&mut directions);
        let mut found = self.lanes.clone();
        for &(side, _) in &sides {
            found.extend(directions.iter().flat_map(|d| [d - side, d - side + PI]));
        }
        for (k, &(p, _)) in near.iter().enumerate() {
            for &(q, _) in &near[k + 1..] {
                let along = q - p;
                let gap = along.norm();
                for &(side, width) in &sides {
                    if (width - 4.0 * SLACK..width * TIGHT).contains(&gap) {
                        let across = angle(along) + PI / 2.0 - side;
                        found.extend([across, across + PI]);
                    }
                }
            }
        }
        // A body that is the same turned half about covers the same.
        let whole = if is_symmetric(&upright) { PI } else { TAU };
        found.iter_mut().for_each(|h| *h = h.rem_euclid(whole));
        distinct(&mut found);
        let regular = (0..).map(|k| f64::from(k) * TURN).take_while(|h| *h < whole - SAME);
        let is_new = |h: &f64| found.iter().all(|f| (f - h).abs() >= SAME);
        let regular: Vec<f64> = regular.filter(is_new).collect();
        // Those along the walls cover most.
        found.extend(regular);
        (found, width)
    }
}

/// A contour without the corners that stand out, to either side, by no more than a tolerance from the lines between
/// others; those on the rim stay.
fn evened(contour: &Polygon, rim: &[(Point, Point)], tolerance: f64) -> Polygon {
    let stays =
        |p: &Point| rim.iter().any(|&(a, b)| (nearest_on_segment(*p, a, b) - p).norm() < ON_RIM);
    let mut corners = contour.corners.clone();
    let Some(first) = corners.iter().position(stays) else { return contour.clone() };
    corners.rotate_left(first);
    corners.push(corners[0]);
    let fixed: Vec<usize> = (0..corners.len()).filter(|&i| stays(&corners[i])).collect();
    let mut kept = Vec::new();
    for ends in fixed.windows(2) {
        kept.push(corners[ends[0]]);
        // Douglas and Peucker 1973.
        let mut open = vec![(ends[0], ends[1])];
        while let Some((from, to)) = open.pop() {
            let off = |i: &usize| {
                (nearest_on_segment(corners[*i], corners[from], corners[to]) - corners[*i]).norm()
            };
            let furthest = (from + 1..to).max_by(|a, b| off(a).total_cmp(&off(b)));
            match furthest.filter(|i| off(i) > tolerance) {
                Some(i) => open.extend([(i, to), (from, i)]),
                None if from > ends[0] => kept.push(corners[from]),
                None => {}
            }
        }
    }
    Polygon::new(kept)
}

/// What rounding leaves along the walls is less wide than this, in cm, and no zone.
pub(super) const RIM: f64 = 0.01;

/// Corners nearer to a dead zone's rim, in cm, lie on it.
const ON_RIM: f64 = 0.05;

/// A body passes a gap that is wider than it by this factor at one of the regular headings.
const TIGHT: f64 = 1.002;

fn distinct(angles: &mut Vec<f64>) {
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|next, last| *next - *last < SAME);
}

/// The edges that come near a place.
pub(super) fn meeting(
    edges: &[(Point, Point)],
    place: &Bounds,
) -> impl Iterator<Item = (Point, Point)> {
    edges.iter().copied().filter(|&(a, b)| Bounds::of([a, b]).meets(place))
}

/// Whether a piece is no wider than what rounding leaves along the walls.
fn is_rim(grid: &Grid, shape: &[Contour]) -> bool {
    let polygons: Vec<Polygon> = shape.iter().map(|c| grid.polygon(c)).collect();
    let rim: f64 = polygons.iter().flat_map(Polygon::edges).map(|(a, b)| (b - a).norm()).sum();
    polygons.iter().map(Polygon::signed_area).sum::<f64>() <= RIM * f64::max(rim, 1.0)
}

/// Whether a body is the same, set elsewhere, when it has turned half about.
fn is_symmetric(body: &Polygon) -> bool {
    let middle = body.bounds();
    let both = middle.min.coords + middle.max.coords;
    body.corners
        .iter()
        .all(|p| body.corners.iter().any(|q| (p.coords + q.coords - both).norm() < 1e-9))
}

/// How far from its middle a body reaches at any heading, in cm.
pub(super) fn extent(robot: &RobotProfile) -> f64 {
    let body = about_middle(body(robot, Vector::x()));
    body.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

/// A body given about the middle of its box at no heading instead of the centre on which it turns.
fn about_middle(mut body: Vec<Vector>) -> Vec<Vector> {
    let sum: Vector = body.iter().sum();
    let middle = sum / body.len().max(1) as f64;
    body.iter_mut().for_each(|v| *v -= middle);
    body
}

/// Where a body may be placed on a floor without touching the edges.
pub(super) fn shrunk(
    grid: &Grid,
    floor: &[Contour],
    edges: &[(Point, Point)],
    body: &[Vector],
) -> Shapes {
    let back: Vec<Vector> = body.iter().map(|v| -v).collect();
    let blocked: Vec<Contour> =
        edges.iter().map(|&(a, b)| grid.contour(&over(&back, [a, b]))).collect();
    difference(floor, &blocked)
}

/// What a convex body, its corners counter-clockwise, passes over from one place to another.
pub(super) fn over(body: &[Vector], [a, b]: [Point; 2]) -> Polygon {
    let n = body.len();
    // The sides that look ahead go with the body to its new place, the others stay.
    let looks_ahead = |i: usize| (b - a).perp(&(body[(i + 1) % n] - body[i % n])) > 0.0;
    let mut corners = Vec::with_capacity(n + 2);
    for (i, &v) in body.iter().enumerate() {
        let sides = [looks_ahead(i + n - 1), looks_ahead(i)];
        corners.push(if sides[0] { b + v } else { a + v });
        if sides[0] != sides[1] {
            corners.push(if sides[1] { b + v } else { a + v });
        }
    }
    Polygon::new(corners)
}

/// The footprint turned to a heading, with its clearance, as one convex polygon about the centre.
pub(super) fn body(robot: &RobotProfile, way: Vector) -> Vec<Vector> {
    let across = Vector::new(-way.y, way.x);
    let clearance = (robot.clearance.get() - SLACK) / (PI / 8.0).cos();
    let bounds = Bounds::of(robot.footprint.iter().copied());
    let middle = nalgebra::center(&bounds.min, &bounds.max);
    let mut points = Vec::new();
    for p in &robot.footprint {
        let corner = way * p.x + across * p.y;
        for k in 0..8 {
            let (sin, cos) = (f64::from(k) * PI / 4.0 + PI / 8.0).sin_cos();
            let away = if clearance > 0.0 {
                way * (cos * clearance) + across * (sin * clearance)
            } else {
                // Without clearance the body itself gives way by the slack, to both sides.
                let inward = (middle - p).map(|d| if d == 0.0 { 0.0 } else { d.signum() });
                (way * inward.x + across * inward.y) * (SLACK / SQRT_2)
            };
            points.push(Point::origin() + corner + away);
        }
    }
    convex_hull(points).into_iter().map(|p| p.coords).collect()
}
