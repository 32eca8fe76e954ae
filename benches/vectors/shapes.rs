//! Things and views of them, made from a seed: for the benches and for the statistical tests of the crate.

#![allow(dead_code, reason = "each user takes what it needs")]

use fastrand::Rng;
use nalgebra::{Rotation2, Rotation3, Vector2, Vector3};
use orthoframe_vectors::{Cut, End, Model, Motion, Segment};

/// How things are shaped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A ring of segments of any turn.
    Generic,
    /// A ring of right angles.
    Rectangular,
}

/// A normal deviate (Box and Muller).
pub(crate) fn normal(rng: &mut Rng) -> f64 {
    let (u, v) = (1.0 - rng.f64(), rng.f64());
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

/// The corners of thing number `number`, `count` of them; faces of some 20 to 150 cm.
pub(crate) fn corners(kind: Kind, number: u64, count: usize) -> Vec<Vector2<f64>> {
    let mut rng = Rng::with_seed(number.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5eed);
    match kind {
        Kind::Generic => {
            let radius = count as f64 * 12.0;
            (0..count)
                .map(|k| {
                    let angle = (k as f64 + rng.f64() * 0.8) / count as f64 * std::f64::consts::TAU;
                    Vector2::new(angle.cos(), angle.sin()) * radius * (0.7 + 0.6 * rng.f64())
                })
                .collect()
        }
        Kind::Rectangular => {
            // A staircase out and back around a middle line: steps to the right above, to the left below.
            let half = (count / 4).max(1);
            let widths: Vec<f64> = (0..half).map(|_| 20.0 + 130.0 * rng.f64()).collect();
            let mut level =
                |base: f64| -> Vec<f64> { (0..half).map(|_| base + 110.0 * rng.f64()).collect() };
            let (above, below) = (level(80.0), level(80.0));
            let mut points = Vec::new();
            let mut x = 0.0;
            for (w, y) in widths.iter().zip(&above) {
                points.push(Vector2::new(x, *y));
                x += w;
                points.push(Vector2::new(x, *y));
            }
            // Other steps below.
            let cuts: Vec<f64> = {
                let parts: Vec<f64> = (0..half).map(|_| 0.3 + rng.f64()).collect();
                let sum: f64 = parts.iter().sum();
                parts.iter().map(|p| p / sum * x).collect()
            };
            for (w, y) in cuts.iter().zip(&below) {
                points.push(Vector2::new(x, -*y));
                x -= w;
                points.push(Vector2::new(x, -*y));
            }
            points
        }
    }
}

/// Thing number `number` without errors.
pub(crate) fn thing(kind: Kind, number: u64, count: usize) -> Vec<Segment<2>> {
    ring(&corners(kind, number, count), 0.01)
}

fn ring(corners: &[Vector2<f64>], sigma: f64) -> Vec<Segment<2>> {
    (0..corners.len())
        .map(|k| Segment::given(corners[k], corners[(k + 1) % corners.len()], sigma))
        .collect()
}

/// The stored model of thing number `number`: known to `sigma` cm, and off by as much.
pub(crate) fn stored(kind: Kind, number: u64, count: usize, sigma: f64) -> Model<2> {
    let mut rng = Rng::with_seed(number ^ 0xabcd_ef01);
    let noisy: Vec<Vector2<f64>> = corners(kind, number, count)
        .into_iter()
        .map(|p| p + Vector2::new(normal(&mut rng), normal(&mut rng)) * sigma)
        .collect();
    Model::of_contour(ring(&noisy, sigma.max(0.01)))
}

/// What hides a part of a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hiding {
    /// One side is turned away: what is seen is one run of the contour, its ends cut.
    Side,
    /// Things stand before it, here and there.
    Scattered,
}

/// A view of a thing from somewhere, each end with error `sigma`, a share of its segments hidden; and the motion that
/// carries the view back into the thing's frame.
pub(crate) fn view(
    thing: &[Segment<2>],
    hidden: f64,
    hiding: Hiding,
    sigma: f64,
    rng: &mut Rng,
) -> (Model<2>, Motion<2>) {
    let motion = Motion::<2>::from_parts(
        Vector2::new(rng.f64() * 1000.0 - 500.0, rng.f64() * 1000.0 - 500.0).into(),
        Rotation2::new(rng.f64() * std::f64::consts::TAU),
        1.0,
    );
    let count = thing.len();
    let seen = ((1.0 - hidden) * count as f64).round().max(1.0) as usize;
    let first = rng.usize(..count);
    let chosen: Vec<usize> = match hiding {
        Hiding::Side => (0..seen).map(|k| (first + k) % count).collect(),
        Hiding::Scattered => {
            let mut all: Vec<usize> = (0..count).collect();
            rng.shuffle(&mut all);
            all.truncate(seen);
            all.sort_unstable();
            all
        }
    };
    // One error for one corner, as corners are found by intersection.
    let errors: Vec<Vector2<f64>> =
        (0..count).map(|_| Vector2::new(normal(rng), normal(rng)) * sigma).collect();
    let mut segments: Vec<Segment<2>> = chosen
        .iter()
        .map(|&k| {
            let s = &thing[k];
            let (p, q) = (s.start + errors[k], s.end + errors[(k + 1) % count]);
            Segment::given(p, q, sigma)
        })
        .collect();
    if hiding == Hiding::Side && seen < count {
        let last = segments.len() - 1;
        let keep = 0.3 + 0.6 * rng.f64();
        segments[0].start = segments[0].end + (segments[0].start - segments[0].end) * keep;
        segments[0].ends[0] = End::Cut(Cut::Occluded);
        let keep = 0.3 + 0.6 * rng.f64();
        segments[last].end =
            segments[last].start + (segments[last].end - segments[last].start) * keep;
        segments[last].ends[1] = End::Cut(Cut::Occluded);
    }
    let model = Model::of_contour(segments).moved(&motion.inverse());
    (model, motion)
}

/// Thing number `number` in space: a bent chain of `count` bars.
pub(crate) fn chain(number: u64, count: usize, sigma: f64) -> Model<3> {
    let mut rng = Rng::with_seed(number ^ 0x3d);
    let mut at = Vector3::zeros();
    let segments = (0..count)
        .map(|_| {
            let v = Vector3::new(normal(&mut rng), normal(&mut rng), normal(&mut rng)).normalize();
            let next = at + v * (20.0 + 130.0 * rng.f64());
            let segment = Segment::given(at, next, sigma);
            at = next;
            segment
        })
        .collect();
    Model::of_contour(segments)
}

/// A view of a run of bars from somewhere in space.
pub(crate) fn view_of_chain(
    thing: &Model<3>,
    seen: usize,
    sigma: f64,
    rng: &mut Rng,
) -> (Model<3>, Motion<3>) {
    let motion = Motion::<3>::from_parts(
        Vector3::new(normal(rng), normal(rng), normal(rng)).scale(300.0).into(),
        Rotation3::new(Vector3::new(normal(rng), normal(rng), normal(rng))),
        1.0,
    );
    let first = rng.usize(..=thing.len() - seen);
    let segments = thing.segments()[first..first + seen]
        .iter()
        .map(|s| {
            let mut error = || Vector3::new(normal(rng), normal(rng), normal(rng)) * sigma;
            Segment::given(s.start + error(), s.end + error(), sigma)
        })
        .collect();
    (Model::of_contour(segments).moved(&motion.inverse()), motion)
}
