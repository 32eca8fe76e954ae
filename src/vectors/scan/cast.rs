//! What a sensor would measure among given segments: the obvious way, every beam against every segment.

use nalgebra::{Isometry2, Vector2};

use super::sensor::Sensor;
use crate::segment::Segment;

/// The nearest segment on a beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Struck {
    /// In cm.
    pub range: f64,
    /// Its place among the segments.
    pub segment: usize,
}

/// What each beam of the sensor strikes first, from `pose`; also beyond the sensor's reach.
///
/// A beam strikes a segment also at its very ends, and within `slack` rad beside them.
#[must_use]
pub fn cast(
    sensor: &Sensor,
    pose: &Isometry2<f64>,
    segments: &[Segment<2>],
    slack: f64,
) -> Vec<Option<Struck>> {
    let mut struck = vec![None; sensor.count()];
    for (index, segment) in segments.iter().enumerate() {
        let local = |p: Vector2<f64>| pose.inverse_transform_vector(&(p - pose.translation.vector));
        let (start, end) = (local(segment.start), local(segment.end));
        for (beam, u) in sensor.directions().iter().enumerate() {
            let Some(range) = meet(*u, start, end, slack) else { continue };
            let nearer = struck[beam].is_none_or(|other: Struck| range < other.range);
            if nearer {
                struck[beam] = Some(Struck { range, segment: index });
            }
        }
    }
    struck
}

/// Range at which the ray along `u` from the origin meets the segment, or passes one of its ends within `slack` rad.
fn meet(u: Vector2<f64>, start: Vector2<f64>, end: Vector2<f64>, slack: f64) -> Option<f64> {
    let v = end - start;
    let sine = u.perp(&v);
    let (range, share) = (start.perp(&v), start.perp(&u));
    // range / sine along the ray, share / sine along the segment.
    let inside = share * sine >= 0.0 && share.abs() <= sine.abs() && range * sine > 0.0;
    if inside && sine != 0.0 {
        return Some(range / sine);
    }
    let beside = |p: Vector2<f64>| {
        let along = u.dot(&p);
        (along > 0.0 && u.perp(&p).abs() <= slack * along).then_some(along)
    };
    match (beside(start), beside(end)) {
        (Some(one), Some(other)) => Some(one.min(other)),
        (one, other) => one.or(other),
    }
}
