//! What the simulated body touches when it goes straight on and when it turns.

use std::f64::consts::TAU;

use parry2d_f64::math::{Pose as ShapePose, Vector as ShapeVector};
use parry2d_f64::query::{ShapeCastOptions, cast_shapes};
use parry2d_f64::shape::{Ball, ConvexPolygon, Segment, Shape};

use crate::geometry::{Bounds, Polygon};
use crate::units::{Point, Pose, Vector};
use crate::vehicle::Obstruction;

use super::{SKIN, Simulator};

impl Simulator {
    /// The corners of the robot's footprint, less the skin; none of a disc.
    pub(super) fn outline(&self) -> Vec<Point> {
        let corners = &self.profile.footprint;
        let n = corners.len();
        let inward = |i: usize| {
            let along = (corners[(i + 1) % n] - corners[i % n]).normalize();
            Vector::new(-along.y, along.x)
        };
        let inset = |i: usize| {
            let (before, after) = (inward(i + n - 1), inward(i));
            corners[i] + (before + after) * (SKIN / (1.0 + before.dot(&after)))
        };
        let outline: Vec<Point> = (0..n).map(inset).collect();
        let keeps_its_way = (0..n).all(|i| {
            let (was, is) = (corners[(i + 1) % n] - corners[i], outline[(i + 1) % n] - outline[i]);
            was.dot(&is) > 0.0
        });
        // What is thinner than two skins has none.
        if keeps_its_way { outline } else { corners.clone() }
    }

    /// The robot's body, less the skin.
    pub(super) fn body(&self) -> Box<dyn Shape> {
        let corners = self.outline().iter().map(|p| ShapeVector::new(p.x, p.y)).collect();
        match ConvexPolygon::from_convex_polyline(corners) {
            Some(polygon) if !self.profile.footprint.is_empty() => Box::new(polygon),
            _ => Box::new(Ball::new(self.profile.radius.get() - SKIN)),
        }
    }

    /// The first contact of the robot on its way from here to `goal`: how far it gets, and against what.
    pub(super) fn first_contact(&self, goal: Point) -> Option<(f64, Obstruction)> {
        let way = goal - self.pose.at;
        let length = way.norm();
        let radius = self.profile.radius.get() - SKIN;
        let swept = Bounds::of([self.pose.at, goal]).grown(radius);
        let body = self.body();
        let from = placed(self.pose);
        // Unit speed, so that time is distance.
        let velocity = ShapeVector::new(way.x / length, way.y / length);
        let options = ShapeCastOptions { max_time_of_impact: length, ..Default::default() };
        self.edges
            .iter()
            .filter(|e| Bounds::of([e.a, e.b]).meets(&swept))
            .filter_map(|e| {
                let edge =
                    Segment::new(ShapeVector::new(e.a.x, e.a.y), ShapeVector::new(e.b.x, e.b.y));
                let hit = cast_shapes(
                    &from,
                    velocity,
                    &*body,
                    &ShapePose::identity(),
                    ShapeVector::ZERO,
                    &edge,
                    options,
                )
                .expect("parry casts a ball or a polygon against a segment")?;
                Some((hit.time_of_impact, e.of))
            })
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
    }

    /// The first contact of the robot when it turns by so many degrees: how far it gets, and against what. A corner
    /// of the outline meets an edge, or an edge's end meets the outline, where a circle about the centre cuts it.
    pub(super) fn contact_in_turn(&self, turn: f64) -> Option<(f64, Obstruction)> {
        let Pose { at, heading } = self.pose;
        let outline = Polygon::new(self.outline());
        let near = Bounds::of([at]).grown(self.profile.radius.get());
        let toward = |p: Point| p.y.atan2(p.x);
        let mut first: Option<(f64, Obstruction)> = None;
        for edge in self.edges.iter().filter(|e| Bounds::of([e.a, e.b]).meets(&near)) {
            // As seen from the robot before it turns.
            let seen = |p: Point| {
                let (sin, cos) = heading.radians().sin_cos();
                let v = p - at;
                Point::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin)
            };
            let (a, b) = (seen(edge.a), seen(edge.b));
            let corners = outline.corners.iter().flat_map(|&corner| {
                at_distance(corner.coords.norm(), a, b).map(move |met| (corner, met))
            });
            let ends = [a, b].into_iter().flat_map(|end| {
                let sides = outline.edges();
                let met = sides.flat_map(move |(u, v)| at_distance(end.coords.norm(), u, v));
                met.map(move |met| (met, end))
            });
            for (from, to) in corners.chain(ends) {
                let angle = (toward(to) - toward(from)) * turn.signum();
                let angle = angle.rem_euclid(TAU).to_degrees();
                if angle <= turn.abs() && first.is_none_or(|f| (angle, edge.of) < f) {
                    first = Some((angle, edge.of));
                }
            }
        }
        first
    }
}

/// The places on a segment that are so far from the origin.
fn at_distance(radius: f64, a: Point, b: Point) -> impl Iterator<Item = Point> {
    let along = b - a;
    // |a + t along|² = radius²
    let (square, half) = (along.norm_squared(), a.coords.dot(&along));
    let root = (half * half - square * (a.coords.norm_squared() - radius * radius)).sqrt();
    let places = [-root, root].map(|root| (root - half) / square);
    places.into_iter().filter(|t| (0.0..=1.0).contains(t)).map(move |t| a + along * t)
}

/// A pose as parry has it.
pub(super) fn placed(pose: Pose) -> ShapePose {
    ShapePose::new(ShapeVector::new(pose.at.x, pose.at.y), pose.heading.radians())
}
