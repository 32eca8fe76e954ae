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
//! Between headings the union has teeth, where a corner of the footprint was turned on. They are no floor worth a
//! Passframe: only what holds a disc of [`ROUND`] of the robot's radius counts, so that what is covered may be told
//! dead that near to a dead zone, and never the other way.

use std::f64::consts::{PI, SQRT_2, TAU};

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::map::RobotProfile;
use crate::units::{Point, Vector};

use super::dead_zone::RIM;
use super::floor::SLACK;
use super::grid::{Contour, Grid, Shapes, difference, intersection, overlay, positive};
use super::offset::{grow, shrink};
use super::{Bounds, Polygon, convex_hull};

/// Headings are tried at this step, in radians.
const TURN: f64 = PI / 36.0;

/// The disc that the teeth between two headings do not hold, in radii of the robot.
const ROUND: f64 = 0.06;

/// Headings and directions that differ less, in radians, are one.
const SAME: f64 = 1e-5;

/// A Fragment's floor and that of its neighbours through open doorways, as far as the body reaches.
pub(super) struct Coverage<'a> {
    pub(super) robot: &'a RobotProfile,
    pub(super) grid: Grid,
    pub(super) floor: Vec<Contour>,
    /// What the disc covers of it.
    pub(super) free: Vec<Contour>,
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
        let (headings, least) = self.headings(&near);
        let mut left = vec![zone.to_vec()];
        let mut is_freed = false;
        for heading in headings {
            let way = Vector::new(heading.cos(), heading.sin());
            let body = about_middle(body(self.robot, way));
            let clear = shrunk(&self.grid, &ground, &near, &body);
            if clear.is_empty() {
                continue;
            }
            is_freed = true;
            let covered = self.swept(&clear, &body);
            let flat: Vec<Contour> = left.into_iter().flatten().collect();
            left = difference(&flat, &covered);
            left.retain(|shape| !is_rim(&self.grid, shape));
            if left.is_empty() {
                return left;
            }
        }
        if is_freed { self.without_teeth(zone, left, &place, least) } else { left }
    }

    /// Everything that a body passes over whose place lies in `clear`. What rounding and slack leave along the walls
    /// belongs to it.
    fn swept(&self, clear: &Shapes, body: &[Vector]) -> Vec<Contour> {
        let wider: Vec<Vector> = body
            .iter()
            .flat_map(|v| {
                [(1., 1.), (-1., 1.), (-1., -1.), (1., -1.)]
                    .map(|(x, y)| v + Vector::new(x, y) * RIM)
            })
            .collect();
        let mut covered: Vec<Contour> = Vec::new();
        for contour in clear.iter().flatten() {
            let edges = self.grid.polygon(contour);
            covered.extend(
                edges
                    .edges()
                    .map(|edge| self.grid.contour(&over(&wider, <[Point; 2]>::from(edge)))),
            );
            covered.push(contour.clone());
        }
        covered
    }

    /// The dead zone less all that hangs together with the free floor and holds the least disc.
    fn without_teeth(&self, zone: &[Contour], left: Shapes, place: &Bounds, least: f64) -> Shapes {
        let left: Vec<Contour> = left.into_iter().flatten().collect();
        let mut free = self.cut(&self.free, place);
        free.extend(difference(zone, &left).into_iter().flatten());
        let free = self.grid.regions(&overlay(&free, &[], OverlayRule::Subject, FillRule::NonZero));
        let core = self.grid.regions(&positive(&shrink(&self.grid, &free, least)));
        let covered = positive(&grow(&self.grid, &core, least, &free));
        let covered: Vec<Contour> = covered.into_iter().flatten().collect();
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

    /// The headings that are tried, in radians, and the radius of the disc that makes floor of what is covered, in cm.
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
        let least = sides.iter().map(|side| side.1).fold(f64::INFINITY, f64::min);
        let mut directions: Vec<f64> =
            near.iter().map(|&(a, b)| angle(b - a).rem_euclid(PI)).collect();
        distinct(&mut directions);
        let mut found: Vec<f64> = (0..72).map(|k| f64::from(k) * TURN).collect();
        found.extend(&self.lanes);
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
        (found, (ROUND * self.robot.radius.get()).min(least / 4.0))
    }
}

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

/// What a body passes over from one place to another.
pub(super) fn over(body: &[Vector], [a, b]: [Point; 2]) -> Polygon {
    Polygon::new(convex_hull(body.iter().flat_map(|&v| [a + v, b + v]).collect()))
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
