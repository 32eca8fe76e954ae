//! From a log with poses to one map of things (SPEC V6, V9, V12): every view is laid where it was taken, what is equal is
//! fused, and what joins corner to corner is a thing.
//!
//! A view is known no better than the place that it was taken from, so the errors of the pose are added to those of its
//! segments, all ends of one view together. Views that differ by less than a step are passed over: they would say the same
//! thing with the same errors.

use nalgebra::{Isometry2, Matrix2, Vector2};

use crate::read::{Log, Scan};
use crate::scan::Extractor;
use crate::synthesis::{apart, fused};
use crate::{Covariance, Equality, Membership, Model, Motion, Observer, Scene, Segment, project};

/// Views nearer to each other than this, in cm and rad, are one.
const STEP: (f64, f64) = (50.0, 0.35);
/// Ends known less well than this, in cm, tell no place in a map.
const VAGUE: f64 = 15.0;
/// Segments that stand beside a view are held against it up to so far, in cm.
const BESIDE: f64 = 100.0;

/// How surely the poses of a log are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseNoise {
    /// In cm, in every direction.
    pub place: f64,
    /// In rad.
    pub heading: f64,
}

impl Default for PoseNoise {
    /// Logs corrected by a scan matcher.
    fn default() -> Self {
        Self { place: 3.0, heading: 0.008 }
    }
}

/// The things of a log.
#[derive(Debug, Clone)]
pub struct Survey {
    /// The things in the frame of the log's poses; each segment with how often it was seen and should have been.
    pub scene: Scene<2>,
    /// Views that were used; the others stood where one of these did, or told no pose.
    pub views: usize,
    /// Scans that tell no pose.
    pub without_pose: usize,
}

/// Joins the scans of a log into a map of things.
#[must_use]
pub fn survey(log: &Log, noise: PoseNoise, equality: &Equality) -> Survey {
    let mut extractor = Extractor::new();
    let mut world: Vec<Segment<2>> = Vec::new();
    let mut taken: Vec<(usize, Isometry2<f64>)> = Vec::new();
    let mut without_pose = 0;
    for (number, scan) in log.scans.iter().enumerate() {
        let Some(pose) = scan.pose else {
            without_pose += 1;
            continue;
        };
        if taken.last().is_some_and(|(_, last)| is_near(last, &pose)) {
            continue;
        }
        taken.push((number, pose));
        let view = placed(&mut extractor, log, scan, &pose, noise);
        join(&mut world, view, equality);
    }
    let mut model = Model::of_set(&world);
    model =
        Model::with_membership(model.segments().to_vec(), vec![Membership::default(); model.len()]);
    for (number, pose) in &taken {
        let scan = &log.scans[*number];
        let view = placed(&mut extractor, log, scan, pose, noise);
        count(&mut model, log, scan, pose, &view, equality);
    }
    let mut scene = Scene::new(*equality);
    let all: Vec<usize> = (0..model.len()).collect();
    scene.add_contours(&model, &all);
    Survey { scene, views: taken.len(), without_pose }
}

fn is_near(a: &Isometry2<f64>, b: &Isometry2<f64>) -> bool {
    let between = a.inv_mul(b);
    between.translation.vector.norm() < STEP.0 && between.rotation.angle().abs() < STEP.1
}

/// The segments of a scan in the frame of the log, with the errors of the pose.
fn placed(
    extractor: &mut Extractor,
    log: &Log,
    scan: &Scan,
    pose: &Isometry2<f64>,
    noise: PoseNoise,
) -> Vec<Segment<2>> {
    let rotation = pose.rotation.to_rotation_matrix();
    let shift = pose.translation.vector;
    let seen = extractor.segments(log.sensor(scan), &scan.ranges);
    let placed = seen.iter().map(|s| loosened(&s.mapped(rotation.matrix(), &shift), &shift, noise));
    placed.filter(|s| s.covariance.deviation() < VAGUE).collect()
}

/// With the errors of the place `eye` from which it was seen: a shift and a turn that all its points share.
fn loosened(segment: &Segment<2>, eye: &Vector2<f64>, noise: PoseNoise) -> Segment<2> {
    let lever = |p: &Vector2<f64>| Vector2::new(eye.y - p.y, p.x - eye.x);
    let (a, b) = (lever(&segment.start), lever(&segment.end));
    let shift = Matrix2::identity() * (noise.place * noise.place);
    let shared = |p: &Vector2<f64>, q: &Vector2<f64>| {
        shift + p * q.transpose() * (noise.heading * noise.heading)
    };
    let own = &segment.covariance;
    let covariance = Covariance {
        start: own.start + shared(&a, &a),
        end: own.end + shared(&b, &b),
        cross: own.cross + shared(&a, &b),
    };
    Segment { covariance, ..*segment }
}

/// Fuses a view with what of the world stands beside it.
fn join(world: &mut Vec<Segment<2>>, view: Vec<Segment<2>>, equality: &Equality) {
    let ends = |s: &Segment<2>| [s.start, s.end];
    let Some(first) = view.first().map(|s| s.start) else { return };
    let (mut low, mut high) = (first, first);
    for p in view.iter().flat_map(ends) {
        (low, high) = (low.inf(&p), high.sup(&p));
    }
    let (low, high) = (low.add_scalar(-BESIDE), high.add_scalar(BESIDE));
    let is_beside = |s: &Segment<2>| {
        let (from, to) = (s.start.inf(&s.end), s.start.sup(&s.end));
        (0..2).all(|k| from[k] <= high[k] && low[k] <= to[k])
    };
    let (beside, far): (Vec<_>, Vec<_>) = world.drain(..).partition(is_beside);
    *world = far;
    world.extend(fused(beside, view, equality));
}

/// Counts which segments of the world should have been in a view, and were.
fn count(
    model: &mut Model<2>,
    log: &Log,
    scan: &Scan,
    pose: &Isometry2<f64>,
    view: &[Segment<2>],
    equality: &Equality,
) {
    let sensor = log.sensor(scan);
    let (nearest, farthest) = sensor.reach();
    let near: Vec<usize> = (0..model.len())
        .filter(|&k| distance(&model.segments()[k], &pose.translation.vector) < farthest)
        .collect();
    let back = Motion::<2>::from_parts(
        pose.inverse().translation,
        pose.inverse().rotation.to_rotation_matrix(),
        1.0,
    );
    let local = Model::of_contour(near.iter().map(|&k| model.segments()[k].moved(&back)).collect());
    let half = 0.5 * sensor.step() * sensor.count() as f64;
    let middle = sensor.bearing(0) + half;
    let observer = Observer {
        axis: Vector2::new(middle.cos(), middle.sin()),
        half_field: half.min(std::f64::consts::PI),
        range: (nearest, farthest),
        resolution: 3.0 * sensor.step(),
    };
    let images = observer.observe(&project(&local.whole_images(), &Vector2::zeros()));
    let mut visible = vec![0.0; near.len()];
    for image in &images.images {
        visible[image.source] += image.segment.length();
    }
    let is_seen = |&k: &usize| {
        let stored = &model.segments()[near[k]];
        view.iter().any(|s| !apart(s, stored) && equality.equal(s, stored).is_some())
    };
    let seen: Vec<usize> = (0..near.len()).filter(is_seen).collect();
    let half_seen = |k: &usize| visible[*k] > 0.5 * local.segments()[*k].length();
    let expected = (0..near.len()).filter(|k| half_seen(k) || seen.binary_search(k).is_ok());
    let expected: Vec<usize> = expected.map(|k| near[k]).collect();
    model.witness(seen.into_iter().map(|k| near[k]), expected);
}

fn distance(segment: &Segment<2>, p: &Vector2<f64>) -> f64 {
    let v = segment.vector();
    let share = ((p - segment.start).dot(&v) / v.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    (p - segment.start - v * share).norm()
}
