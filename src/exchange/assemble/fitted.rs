//! How large a thing of usual size can be at most where it stands, by what else the file says.
//!
//! A file that names a model and no size says more than that: no two things of one kind stand in each other, and none stands
//! where robots drive. A usual size that contradicts it is not this thing's.

use crate::Survey;
use crate::units::{Deg, Point, Vector};

/// A size that would have to be smaller than so much of the usual one is no matter of size: what stands on what, or was
/// drawn twice.
const LEAST: f64 = 0.3;
/// Bisections of a size, and of a place on a lane.
const STEPS: usize = 24;
/// Lanes and things of one kind are looked at pair by pair up to so many.
const MOST_OF_KIND: usize = 3_000;

/// A thing's frame on its level: where, and its own axes.
struct Stand {
    at: Point,
    axes: [Vector; 2],
}

impl Stand {
    fn new(at: Point, angle: Deg) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { at, axes: [Vector::new(cos, sin), Vector::new(-sin, cos)] }
    }

    fn local(&self, p: Point) -> [f64; 2] {
        self.axes.map(|axis| axis.dot(&(p - self.at)))
    }
}

/// The share of a usual width and depth, in cm, that all things of a kind have room for: at most 1.
///
/// `clearance` is how far from the middle of a lane things are at least, in cm.
pub(super) fn share_of(survey: &Survey, kind: usize, size: [f64; 2], clearance: f64) -> f64 {
    let half = size.map(|side| side / 2.0);
    let mut share = 1.0_f64;
    for level in &survey.levels {
        let of_kind = level.things.iter().filter(|thing| thing.kind == kind);
        let stands: Vec<(Stand, f64)> = of_kind
            .take(MOST_OF_KIND)
            .map(|thing| (Stand::new(thing.at, thing.angle), thing.z.get()))
            .collect();
        for (n, (one, z)) in stands.iter().enumerate() {
            let others = stands[n + 1..].iter().filter(|(_, other)| (other - z).abs() < 1.0);
            let beside = others.map(|(other, _)| share_beside(one, other, half));
            let driven = level.lanes.iter().map(|lane| share_off(one, lane.ends, half, clearance));
            let bounds = beside.chain(driven).filter(|bound| *bound >= LEAST);
            share = bounds.fold(share, f64::min);
        }
    }
    share
}

/// The share at which two boxes of one size touch: by the axis that parts them longest.
fn share_beside(one: &Stand, other: &Stand, half: [f64; 2]) -> f64 {
    let apart = other.at - one.at;
    let axes = one.axes.iter().chain(&other.axes);
    let shares = axes.map(|axis| {
        let reach = |stand: &Stand| -> f64 {
            stand.axes.iter().zip(half).map(|(own, half)| own.dot(axis).abs() * half).sum()
        };
        apart.dot(axis).abs() / (reach(one) + reach(other))
    });
    shares.fold(0.0, f64::max).min(1.0)
}

/// The share at which a box keeps clear of a lane.
fn share_off(stand: &Stand, lane: [Point; 2], half: [f64; 2], clearance: f64) -> f64 {
    let [from, to] = lane.map(|end| stand.local(end));
    let far = half[0].hypot(half[1]) + clearance;
    let beyond = |axis: usize| {
        let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
        low > far || high < -far
    };
    if beyond(0) || beyond(1) {
        return 1.0;
    }
    let clear = |share: f64| {
        // How far a lane is from a box falls and then rises along it.
        let away = |t: f64| {
            let over = [0, 1].map(|n| {
                let at = from[n] + (to[n] - from[n]) * t;
                (at.abs() - half[n] * share).max(0.0)
            });
            over[0].hypot(over[1])
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..STEPS {
            let third = (high - low) / 3.0;
            match away(low + third) <= away(high - third) {
                true => high -= third,
                false => low += third,
            }
        }
        away(f64::midpoint(low, high)) >= clearance
    };
    if clear(1.0) {
        return 1.0;
    }
    let (mut fits, mut too_large) = (0.0, 1.0);
    for _ in 0..STEPS {
        let share = f64::midpoint(fits, too_large);
        match clear(share) {
            true => fits = share,
            false => too_large = share,
        }
    }
    fits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_shrink_until_they_touch_and_keep_clear_of_lanes() {
        let stand = |x, y, angle| Stand::new(Point::new(x, y), Deg::of(angle));
        // Two of 300 × 150, turned, 145 apart along their width.
        let share = share_beside(&stand(0.0, 0.0, 90.0), &stand(0.0, 145.0, -90.0), [150.0, 75.0]);
        assert!((share - 145.0 / 300.0).abs() < 1e-9, "{share}");
        let share = share_beside(&stand(0.0, 0.0, 0.0), &stand(400.0, 0.0, 0.0), [150.0, 75.0]);
        assert!((share - 1.0).abs() < 1e-9, "{share}");
        let lane = [Point::new(-500.0, 90.0), Point::new(500.0, 90.0)];
        let share = share_off(&stand(0.0, 0.0, 0.0), lane, [150.0, 75.0], 27.0);
        assert!((share - 63.0 / 75.0).abs() < 1e-4, "{share}");
        // A lane that ends before it reaches it.
        let lane = [Point::new(-500.0, 0.0), Point::new(-150.0, 0.0)];
        let share = share_off(&stand(0.0, 0.0, 0.0), lane, [150.0, 75.0], 27.0);
        assert!((share - 123.0 / 150.0).abs() < 1e-4, "{share}");
    }
}
