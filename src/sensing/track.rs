//! The pose, scan after scan: what one view leaves open is narrowed as the robot drives, and what does not add up is
//! noticed (SPEC L3, V15).
//!
//! Every pose that fits is a hypothesis. Odometry moves each of them, the scan draws it to the faces, and its evidence
//! grows or falls by how the scan fits. Odometry is a guess that is checked, never a fact: a hypothesis may be drawn
//! farther than odometry allows only by being found anew.
//!
//! **Invariant**: [`Answer::Unique`] is told only where every other hypothesis was refuted by scans.

use nalgebra::{Isometry2, Vector2};
use orthoframe_vectors::scan::Sensor;

use crate::locate::{Answer, FITS, Fix, LIST, Locator, RIVAL, SURE, near};
use crate::view::View;

/// How much odometry errs: of the way, in cm a cm; of a turn, in rad a rad; and in any step, in cm and rad.
const DRIFT: (f64, f64, f64, f64) = (0.1, 0.1, 2.0, 0.01);
/// Deviations by which a drawn pose may differ from the driven one.
const MOST: f64 = 4.0;
/// Evidence by which one hypothesis refutes another: differences of score, summed over views from new places.
const REFUTED: f64 = 0.3;
/// A view is a new one after so much of a way or turn, in cm and rad.
const NEW: (f64, f64) = (25.0, 0.25);
/// Scans in a row that fit no hypothesis, after which all is looked for anew.
const LOST: usize = 3;
/// What odometry missed by more than this, in cm, the robot did not drive.
const CARRIED: f64 = 150.0;
/// Steps in a row with the same sense of error that make a lie.
const LIES: usize = 4;

/// What is remarkable about a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Event {
    /// The scan is where odometry led.
    Steady,
    /// Something refuted a hypothesis.
    Narrowed,
    /// Scans agree with each other and the Map, and odometry does not.
    OdometryLies,
    /// The robot is somewhere else than it drove to: all was looked for anew.
    Kidnapped,
    /// Nothing fits.
    Lost,
}

#[derive(Debug, Clone, Copy)]
struct Hypothesis {
    fix: Fix,
    evidence: f64,
}

/// Follows the pose of a robot by its scans and its odometry.
#[derive(Debug, Clone)]
pub struct Tracker<'l> {
    locator: &'l Locator,
    hypotheses: Vec<Hypothesis>,
    /// It began with all poses that fit: what is left alone is the only one.
    complete: bool,
    poor: usize,
    lies: usize,
    since: (f64, f64),
}

impl<'l> Tracker<'l> {
    /// Knows nothing yet.
    #[must_use]
    pub const fn new(locator: &'l Locator) -> Self {
        Self {
            locator,
            hypotheses: Vec::new(),
            complete: false,
            poor: 0,
            lies: 0,
            since: (0.0, 0.0),
        }
    }

    /// Where the robot is, as far as is known.
    #[must_use]
    pub fn answer(&self) -> Answer {
        let fixes: Vec<Fix> = self.hypotheses.iter().map(|h| h.fix).collect();
        match fixes.as_slice() {
            [] => Answer::Unknown,
            [fix] if self.complete && fix.is_sure() => Answer::Unique(*fix),
            _ => Answer::Ambiguous(fixes),
        }
    }

    /// After a motion by odometry, in the frame of the sensor before it, in cm and rad, with the scan there.
    pub fn step(&mut self, motion: &Isometry2<f64>, sensor: &Sensor, ranges: &[f64]) -> Event {
        let view = self.locator.look(sensor, ranges);
        if self.hypotheses.is_empty() {
            self.begin(&view);
            return if self.hypotheses.is_empty() { Event::Lost } else { Event::Steady };
        }
        let (way, turn) = (motion.translation.vector.norm(), motion.rotation.angle().abs());
        self.since = (self.since.0 + way, self.since.1 + turn);
        let is_new = self.since.0 >= NEW.0 || self.since.1 >= NEW.1;
        if is_new {
            self.since = (0.0, 0.0);
        }
        let reach = (DRIFT.0.mul_add(way, DRIFT.2), DRIFT.1.mul_add(turn, DRIFT.3));
        let mut off = 0.0_f64;
        for (rank, hypothesis) in self.hypotheses.iter_mut().enumerate() {
            let driven = hypothesis.fix.pose * motion;
            let mut fix = self.locator.fix(&view, &driven);
            let (apart, turned) = between(&driven, &fix.pose);
            let spread = hypothesis.fix.deviations();
            let most =
                (MOST * (reach.0 + spread.0.min(50.0)), MOST * (reach.1 + spread.1.min(0.1)));
            if rank == 0 {
                off = (apart / reach.0).max(turned / reach.1);
            }
            if apart > most.0 || turned > most.1 {
                // Drawn to something else than it drove to: it counts as it stands.
                fix = self.locator.stay(&view, &driven);
            }
            hypothesis.fix = fix;
            if is_new {
                hypothesis.evidence += fix.fit.score();
            }
        }
        self.lies = if off > MOST { self.lies + 1 } else { 0 };
        let before = self.hypotheses.len();
        self.narrow();
        if is_new && !self.complete {
            self.complete_by(&view);
        }
        let best = self.hypotheses.iter().map(|h| h.fix.fit.score()).fold(0.0, f64::max);
        // Below what fits at all, for a while: perhaps people stand about; longer, and the robot is elsewhere.
        self.poor = if best < 0.8 * FITS { self.poor + 1 } else { 0 };
        if self.poor >= LOST {
            self.begin(&view);
            return if self.hypotheses.is_empty() { Event::Lost } else { Event::Kidnapped };
        }
        if best < SURE
            && let Some(event) = self.doubt(&view, best)
        {
            return event;
        }
        if self.lies >= LIES {
            return Event::OdometryLies;
        }
        if self.hypotheses.len() < before { Event::Narrowed } else { Event::Steady }
    }

    /// All is looked for anew.
    fn begin(&mut self, view: &View) {
        let answer = self.locator.locate_view(view);
        self.hypotheses =
            answer.fixes().iter().map(|fix| Hypothesis { fix: *fix, evidence: 0.0 }).collect();
        // A list cut short, or a pose that may slide, leaves others out.
        self.complete = match &answer {
            Answer::Unique(_) => true,
            Answer::Ambiguous(fixes) => fixes.len() < LIST && fixes.iter().all(Fix::is_fixed),
            Answer::Unknown => false,
        };
        (self.poor, self.lies, self.since) = (0, 0, (0.0, 0.0));
    }

    /// The scan speaks less for the pose than it should: it is asked without a guess whether it speaks for another.
    fn doubt(&mut self, view: &View, best: f64) -> Option<Event> {
        let Answer::Unique(found) = self.locator.locate_view(view) else { return None };
        let is_new = !self.hypotheses.iter().any(|h| near(&h.fix.pose, &found.pose));
        if !is_new || found.fit.score() < best + RIVAL {
            return None;
        }
        let apart = |h: &Hypothesis| between(&h.fix.pose, &found.pose).0;
        let nearest = self.hypotheses.iter().map(apart).fold(f64::INFINITY, f64::min);
        self.hypotheses = vec![Hypothesis { fix: found, evidence: 0.0 }];
        (self.complete, self.poor, self.lies, self.since) = (true, 0, 0, (0.0, 0.0));
        Some(if nearest < CARRIED { Event::OdometryLies } else { Event::Kidnapped })
    }

    /// What an incomplete list left is not all that there is: a view of more must say so.
    fn complete_by(&mut self, view: &View) {
        let mut anew = Self::new(self.locator);
        anew.begin(view);
        if anew.complete {
            *self = anew;
        }
    }

    /// Drops what was refuted, and one of two that became the same.
    fn narrow(&mut self) {
        self.hypotheses.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        let best = self.hypotheses.first().map_or(0.0, |h| h.evidence);
        let mut kept: Vec<Hypothesis> = Vec::with_capacity(self.hypotheses.len());
        for hypothesis in &self.hypotheses {
            let known = kept.iter().any(|k| near(&k.fix.pose, &hypothesis.fix.pose));
            if !known && hypothesis.evidence > best - REFUTED {
                kept.push(*hypothesis);
            }
        }
        self.hypotheses = kept;
    }
}

fn between(a: &Isometry2<f64>, b: &Isometry2<f64>) -> (f64, f64) {
    let v: Vector2<f64> = a.translation.vector - b.translation.vector;
    (v.norm(), a.rotation.angle_to(&b.rotation).abs())
}
