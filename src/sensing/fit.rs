//! How well a scan fits the faces from a pose, and the pose at which it fits best.
//!
//! Every beam is asked what it should have struck. One that ends at a face speaks for the pose; one that went through
//! what would have to be a wall speaks against it as much; one that ended before the face met something that the Map
//! does not know, and one that should have met nothing says nothing.

use nalgebra::{Isometry2, Matrix3, Point2, Vector2, Vector3};

use crate::faces::Face;
use crate::field::Field;
use crate::view::{Return, View};

/// A return this far from a face, and three deviations, is still of it, in cm.
const AT: f64 = 9.0;
/// A beam must pass a face by this much to have gone through it, in cm.
const BEYOND: f64 = 35.0;
/// From how far faces draw the points of a scan: first and last round, in cm.
const DRAWS: [f64; 7] = [60.0, 45.0, 35.0, 25.0, 18.0, 12.0, 12.0];
/// Neighbouring beams err together: so many count as one.
const TOGETHER: f64 = 3.0;

/// How the beams of a scan lie among the faces.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fit {
    /// Beams that came back.
    pub beams: usize,
    /// They ended at a face.
    pub explained: usize,
    /// They went through what is a wall or a thing on the Map.
    pub through: usize,
    /// They ended before the face that they should have met.
    pub short: usize,
    /// Faces at which at least three beams ended.
    pub faces: usize,
}

impl Fit {
    /// Share of the beams that speak for the pose, less those that speak against it.
    #[must_use]
    pub fn score(&self) -> f64 {
        (self.explained as f64 - self.through as f64) / self.beams.max(1) as f64
    }
}

/// What a beam met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Met {
    /// This face.
    Face(usize),
    /// Nothing of the Map, before this face.
    Before(usize),
    /// It went through this face.
    Through(usize),
    /// Nothing known stands on this beam.
    Open,
}

/// What one return says of a pose.
pub(crate) fn met(field: &Field, faces: &[Face], pose: &Isometry2<f64>, beam: &Return) -> Met {
    let from = pose.translation.vector;
    let (u, end) = (pose.rotation * beam.u, (pose * Point2::from(beam.point())).coords);
    let tolerance = 3.0f64.mul_add(beam.noise, AT);
    let struck = field.strike(faces, &from, &u, beam.range + BEYOND + tolerance + 2000.0);
    let Some((range, face)) = struck else {
        return at_face(field, faces, &end, tolerance).map_or(Met::Open, Met::Face);
    };
    if (range - beam.range).abs() <= tolerance {
        return Met::Face(face);
    }
    // Across a grazing face the range errs more than the place.
    if faces[face].distance(&end) <= tolerance {
        return Met::Face(face);
    }
    if range + BEYOND + tolerance < beam.range {
        return Met::Through(face);
    }
    if range > beam.range {
        return at_face(field, faces, &end, tolerance).map_or(Met::Before(face), Met::Face);
    }
    at_face(field, faces, &end, tolerance).map_or(Met::Open, Met::Face)
}

fn at_face(field: &Field, faces: &[Face], p: &Vector2<f64>, tolerance: f64) -> Option<usize> {
    let face = field.nearest(p)?;
    (faces[face].distance(p) <= tolerance).then_some(face)
}

/// How the whole scan fits. A beam through a door's leaf, which may stand otherwise, says nothing against the pose.
pub(crate) fn fit(field: &Field, faces: &[Face], pose: &Isometry2<f64>, view: &View) -> Fit {
    let mut fit = Fit { beams: view.beams.len(), ..Fit::default() };
    let mut struck = Vec::with_capacity(view.beams.len());
    for beam in &view.beams {
        match met(field, faces, pose, beam) {
            Met::Face(face) => {
                fit.explained += 1;
                struck.push(face);
            }
            Met::Before(_) => fit.short += 1,
            Met::Through(face) if !faces[face].is_leaf() => fit.through += 1,
            Met::Through(_) | Met::Open => {}
        }
    }
    struck.sort_unstable();
    fit.faces = struck.chunk_by(|a, b| a == b).filter(|run| run.len() >= 3).count();
    fit
}

/// The pose near `pose` at which the points of the scan lie nearest to the faces, with what the points tell of it:
/// their normal equations over (x, y, heading), in cm and rad.
///
/// Gauss-Newton on distances from points to the lines of their nearest faces, which reach less and less far.
pub(crate) fn refine(
    field: &Field,
    faces: &[Face],
    pose: &Isometry2<f64>,
    view: &View,
    rounds: std::ops::Range<usize>,
) -> (Isometry2<f64>, Matrix3<f64>) {
    let mut pose = *pose;
    let mut information = Matrix3::zeros();
    for draw in DRAWS.iter().skip(rounds.start).take(rounds.len()) {
        let (mut normal, mut right, mut squares, mut count) =
            (Matrix3::zeros(), Vector3::zeros(), 0.0, 0.0);
        for beam in &view.beams {
            let lever = pose.rotation * beam.point();
            let p = lever + pose.translation.vector;
            if field.distance(&p) > draw + 10.0 {
                continue;
            }
            let Some(face) = field.nearest(&p) else { continue };
            let face = &faces[face];
            let t = face.direction();
            let place = (p - face.start).dot(&t);
            let n = Vector2::new(-t.y, t.x);
            let off = n.dot(&(p - face.start));
            if off.abs() > *draw || place < -5.0 || place > face.length() + 5.0 {
                continue;
            }
            let row = Vector3::new(n.x, n.y, lever.perp(&n));
            // Tukey's weight.
            let weight = (1.0 - (off / draw).powi(2)).powi(2);
            normal += row * row.transpose() * weight;
            right -= row * (off * weight);
            squares += off * off * weight;
            count += weight;
        }
        let variance = (squares / f64::max(count - 3.0, 1.0)).max(1.0);
        information = normal / (variance * TOGETHER);
        // Where the points tell nothing of a direction, the pose stays as it is.
        let held = normal + Matrix3::from_diagonal(&Vector3::new(1e-2, 1e-2, 1e2));
        let Some(step) = held.cholesky().map(|c| c.solve(&right)) else { break };
        if !step.iter().all(|x| x.is_finite()) {
            break;
        }
        let angle = pose.rotation.angle() + step.z.clamp(-0.2, 0.2);
        let shift = pose.translation.vector + step.xy().cap_magnitude(60.0);
        pose = Isometry2::new(shift, angle);
    }
    (pose, information)
}
