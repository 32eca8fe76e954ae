//! Where a scan was taken, without a guess (SPEC L2, L3).
//!
//! 1. Each corner of the scan is held against the corners of the faces: candidate poses ([`crate::corners`]).
//! 2. A few points of the scan's lines, tried on the grid of distances, leave the likely ones.
//! 3. These are refined and held against the whole expected view ([`crate::fit`]).
//! 4. Rivals of the best are looked for where buildings repeat themselves: along its least certain direction.
//! 5. What is left is counted: one pose that fits, several, or none.
//!
//! **Invariant**: an answer is [`Answer::Unique`] only where nothing else that was found fits nearly as well, where the
//! scan fixes all three numbers of the pose, and where at least three faces were met: two walls alone are never enough.

use nalgebra::{Isometry2, Matrix3, Point2, SymmetricEigen, Vector2};
use orthoframe_vectors::scan::Sensor;

use crate::corners::Corners;
use crate::faces::Face;
use crate::field::Field;
use crate::fit::{Fit, fit, refine};
use crate::view::View;

/// No sensor stands nearer to a wall, in cm.
const NEAREST: f64 = 8.0;
/// How far a probe may be from a face and still count, in cm.
const PROBE: f64 = 40.0;
/// Probes of the first, coarse look.
const FIRST: usize = 8;
/// Candidates that are refined.
const REFINED: usize = 200;
/// Of them, those that are held against the whole view.
const VIEWED: usize = 40;
/// Poses nearer to each other than this, in cm and rad, are one.
const SAME: (f64, f64) = (40.0, 0.18);
/// Least score of a pose that fits.
pub(crate) const FITS: f64 = 0.45;
/// Least score of a pose that is called the only one: a worse one may be beside one that was not found.
pub(crate) const SURE: f64 = 0.65;
/// A pose that scores less than the best by this is no rival.
pub(crate) const RIVAL: f64 = 0.12;
/// Deviations of a pose that the scan fixes: cm and rad.
const FIXED: (f64, f64) = (8.0, 0.02);
/// Fewest returns that say anything.
const FEWEST: usize = 20;
/// Farthest that a repetition is looked for, and by which steps, in cm.
const SLIDE: (f64, f64) = (2500.0, 20.0);
/// Longest list of an ambiguous answer.
pub(crate) const LIST: usize = 32;

/// A pose that fits a scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fix {
    /// Sensor → Map, in cm and rad.
    pub pose: Isometry2<f64>,
    /// Of (x, y, heading), in cm and rad. Along what the scan does not fix it is large, but finite.
    pub covariance: Matrix3<f64>,
    pub fit: Fit,
}

impl Fix {
    /// Greatest deviation of the place, in cm, and that of the heading, in rad.
    #[must_use]
    pub fn deviations(&self) -> (f64, f64) {
        let place = self.covariance.fixed_view::<2, 2>(0, 0).into_owned();
        let most = SymmetricEigen::new(place).eigenvalues.max();
        (most.max(0.0).sqrt(), self.covariance[(2, 2)].max(0.0).sqrt())
    }

    /// Whether the scan fixes place and heading.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        let (place, heading) = self.deviations();
        place <= FIXED.0 && heading <= FIXED.1
    }

    /// Whether the scan fixes the pose, and most of it speaks for it, of at least three faces.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.is_fixed() && self.fit.score() >= SURE && self.fit.faces >= 3
    }

    /// Whether both are one pose, for all that the scans can tell.
    #[must_use]
    pub fn is_near(&self, other: &Isometry2<f64>) -> bool {
        near(&self.pose, other)
    }
}

/// Where a scan was taken, as far as it can be told.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// One pose fits, and no other.
    Unique(Fix),
    /// All poses found that fit, the best first; one alone where the scan leaves a direction open.
    Ambiguous(Vec<Fix>),
    /// None fits.
    Unknown,
}

impl Answer {
    /// All poses that it names.
    #[must_use]
    pub fn fixes(&self) -> &[Fix] {
        match self {
            Self::Unique(fix) => std::slice::from_ref(fix),
            Self::Ambiguous(fixes) => fixes,
            Self::Unknown => &[],
        }
    }
}

/// The faces of a Map at the height of a sensor, ready to be recognised.
#[derive(Debug, Clone)]
pub struct Locator {
    pub(crate) faces: Vec<Face>,
    pub(crate) field: Field,
    corners: Corners,
}

impl Locator {
    /// Of faces; those that are none are left out.
    #[must_use]
    pub fn new(mut faces: Vec<Face>) -> Self {
        faces.retain(Face::is_sound);
        let (field, corners) = (Field::new(&faces), Corners::new(&faces));
        Self { faces, field, corners }
    }

    /// What it recognises by.
    #[must_use]
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// Number of corners in its index.
    #[must_use]
    pub fn corners(&self) -> usize {
        self.corners.len()
    }

    /// Where a scan was taken, without a guess. `ranges` are cm, one a beam.
    #[must_use]
    pub fn locate(&self, sensor: &Sensor, ranges: &[f64]) -> Answer {
        let view = self.look(sensor, ranges);
        self.locate_view(&view)
    }

    pub(crate) fn look(&self, sensor: &Sensor, ranges: &[f64]) -> View {
        View::new(sensor, ranges, self.corners.reach)
    }

    pub(crate) fn locate_view(&self, view: &View) -> Answer {
        if view.beams.len() < FEWEST || self.faces.is_empty() {
            return Answer::Unknown;
        }
        let mut fixes = self.refined(view, self.candidates(view));
        if let Some(best) = fixes.first().copied() {
            fixes.extend(self.refined(view, self.repetitions(view, &best)));
            fixes = distinct(fixes);
        }
        decide(fixes)
    }

    /// How the scan fits from a pose near `pose`, refined.
    #[must_use]
    pub fn refine(&self, sensor: &Sensor, ranges: &[f64], pose: &Isometry2<f64>) -> Fix {
        self.fix(&self.look(sensor, ranges), pose)
    }

    pub(crate) fn fix(&self, view: &View, pose: &Isometry2<f64>) -> Fix {
        let (pose, information) = refine(&self.field, &self.faces, pose, view, 2..7);
        let fit = fit(&self.field, &self.faces, &pose, view);
        Fix { pose, covariance: covariance(&information), fit }
    }

    /// How the scan fits from exactly this pose.
    pub(crate) fn stay(&self, view: &View, pose: &Isometry2<f64>) -> Fix {
        let (_, information) = refine(&self.field, &self.faces, pose, view, 6..7);
        let fit = fit(&self.field, &self.faces, pose, view);
        Fix { pose: *pose, covariance: covariance(&information), fit }
    }

    /// Poses that the corners name and the probes leave, likely ones first.
    fn candidates(&self, view: &View) -> Vec<(f64, Isometry2<f64>)> {
        let mut found = Vec::new();
        let least = 0.4 * FIRST.min(view.probes.len()) as f64;
        for corner in &view.corners {
            for pose in self.corners.poses(corner) {
                if let Some(score) = self.probe(view, &pose, least) {
                    found.push((score, pose));
                }
            }
        }
        found
    }

    /// Mean nearness of the probes to faces, from 0 to 1; none where the first few are too far.
    fn probe(&self, view: &View, pose: &Isometry2<f64>, least: f64) -> Option<f64> {
        if self.field.distance(&pose.translation.vector) < NEAREST {
            return None;
        }
        let near = |p: &Vector2<f64>| {
            let p = (pose * Point2::from(*p)).coords;
            (1.0 - self.field.distance(&p) / PROBE).max(0.0)
        };
        let (first, rest) = view.probes.split_at(FIRST.min(view.probes.len()));
        let sum: f64 = first.iter().map(near).sum();
        if sum < least {
            return None;
        }
        let sum = sum + rest.iter().map(near).sum::<f64>();
        Some(sum / view.probes.len().max(1) as f64)
    }

    /// The most likely candidates, each once, refined, those that fit best first.
    fn refined(&self, view: &View, mut found: Vec<(f64, Isometry2<f64>)>) -> Vec<Fix> {
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kept: Vec<(f64, Isometry2<f64>)> = Vec::new();
        for (score, pose) in found {
            if kept.len() >= REFINED || score < kept.first().map_or(0.0, |k| 0.4 * k.0) {
                break;
            }
            if !kept.iter().any(|k| near(&k.1, &pose)) {
                kept.push((score, pose));
            }
        }
        // Twice: first towards the faces, then, of the best by the probes, to the end.
        let mut drawn: Vec<(f64, Isometry2<f64>)> = kept
            .iter()
            .map(|(_, pose)| {
                let (pose, _) = refine(&self.field, &self.faces, pose, view, 0..4);
                (self.closeness(view, &pose), pose)
            })
            .collect();
        drawn.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut apart: Vec<Isometry2<f64>> = Vec::new();
        for (_, pose) in drawn {
            if apart.len() < VIEWED && !apart.iter().any(|other| near(other, &pose)) {
                apart.push(pose);
            }
        }
        distinct(apart.iter().map(|pose| self.fix(view, pose)).collect())
    }

    /// Share of the returns near a face.
    fn closeness(&self, view: &View, pose: &Isometry2<f64>) -> f64 {
        let near = |p: Vector2<f64>| {
            let p = (pose * Point2::from(p)).coords;
            (1.0 - self.field.distance(&p) / 20.0).max(0.0)
        };
        view.beams.iter().map(|beam| near(beam.point())).sum::<f64>()
            / view.beams.len().max(1) as f64
    }

    /// Poses along the least certain direction of a pose, and turned about there.
    fn repetitions(&self, view: &View, fix: &Fix) -> Vec<(f64, Isometry2<f64>)> {
        let place = fix.covariance.fixed_view::<2, 2>(0, 0).into_owned();
        let eigen = SymmetricEigen::new(place);
        let along: Vector2<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
        let steps = (SLIDE.0 / SLIDE.1) as i32;
        let mut found = Vec::new();
        for turn in [0.0, std::f64::consts::PI] {
            for step in -steps..=steps {
                let shift = along * (f64::from(step) * SLIDE.1);
                let angle = fix.pose.rotation.angle() + turn;
                let pose = Isometry2::new(fix.pose.translation.vector + shift, angle);
                let least = 0.4 * FIRST.min(view.probes.len()) as f64;
                if !near(&pose, &fix.pose)
                    && let Some(score) = self.probe(view, &pose, least)
                {
                    found.push((score, pose));
                }
            }
        }
        found
    }
}

/// The inverse of the information; where that tells nothing, a deviation of 10 m and half a turn.
fn covariance(information: &Matrix3<f64>) -> Matrix3<f64> {
    let floor = Matrix3::from_diagonal(&nalgebra::Vector3::new(1e-6, 1e-6, 0.1));
    (information + floor).try_inverse().unwrap_or_else(|| Matrix3::identity() * 1e6)
}

pub(crate) fn near(a: &Isometry2<f64>, b: &Isometry2<f64>) -> bool {
    let apart = (a.translation.vector - b.translation.vector).norm();
    apart < SAME.0 && a.rotation.angle_to(&b.rotation).abs() < SAME.1
}

/// Each pose once, those that fit best first.
fn distinct(mut fixes: Vec<Fix>) -> Vec<Fix> {
    fixes.sort_by(|a, b| b.fit.score().total_cmp(&a.fit.score()));
    let mut kept: Vec<Fix> = Vec::new();
    for fix in fixes {
        if !kept.iter().any(|k| near(&k.pose, &fix.pose)) {
            kept.push(fix);
        }
    }
    kept
}

/// The answer that the poses found allow.
fn decide(fixes: Vec<Fix>) -> Answer {
    let Some(best) = fixes.first().copied() else { return Answer::Unknown };
    if best.fit.score() < FITS {
        return Answer::Unknown;
    }
    let least = best.fit.score() - RIVAL;
    let rivals: Vec<Fix> =
        fixes.into_iter().filter(|f| f.fit.score() >= least).take(LIST).collect();
    if rivals.len() == 1 && best.is_sure() {
        Answer::Unique(best)
    } else {
        Answer::Ambiguous(rivals)
    }
}
