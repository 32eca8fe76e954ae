//! What is possible, carried along from scan to scan by odometry (SPEC L3).

use nalgebra::{Isometry2, Matrix3};

use super::along::Look;
use super::locate::{Answer, Fit, Localiser, Unknown, loosely};
use super::search::is_near;
use crate::vectors::scan::Sensor;

/// What is believed of the pose after a scan.
#[derive(Debug, Clone)]
pub enum Belief {
    /// One pose is left.
    At(Fit),
    /// Any of these, the best first.
    OneOf(Vec<Fit>),
    /// None is told: it was never found, or what was believed does not fit any more.
    Lost(Unknown),
}

impl Belief {
    /// The poses that are possible, as far as they were looked through, the best first.
    #[must_use]
    pub fn fits(&self) -> &[Fit] {
        match self {
            Self::At(fit) => std::slice::from_ref(fit),
            Self::OneOf(fits) | Self::Lost(Unknown::TooMany(fits)) => fits,
            Self::Lost(_) => &[],
        }
    }
}

impl From<Answer> for Belief {
    fn from(answer: Answer) -> Self {
        match answer {
            Answer::Unique(fit) => Self::At(fit),
            Answer::Ambiguous(fits) => Self::OneOf(fits),
            Answer::Unknown(why) => Self::Lost(why),
        }
    }
}

/// What was remarkable about a scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// It is where odometry led, or it is the first that says anything.
    Steady,
    /// Places that were possible are not any more.
    Narrowed,
    /// Nothing that was believed fits any more: a robot carried off, or odometry that lied.
    GivenUp,
    /// No place is told: [`Belief::Lost`] has why.
    Lost,
}

/// Follows a robot over a chart.
pub struct Tracker<'l> {
    localiser: &'l Localiser<'l>,
    belief: Belief,
    last: Option<Isometry2<f64>>,
    /// Scans along the way so far, while the place is not known.
    looks: Vec<Look>,
    /// The one place that they led to at last, not yet confirmed.
    likely: Option<Isometry2<f64>>,
    /// Scans in a row that fitted badly.
    doubts: usize,
}

/// Scans in a row that a belief may fit badly before it is given up.
const PATIENCE: usize = 3;
/// A scan says something new after so much way or turn, in cm and rad.
const STEP: (f64, f64) = (50.0, 0.5);
/// What looks lead to, and one look later lead to again, is the place: no farther off than this, in cm.
const APART: f64 = 40.0;
/// Of a longer way odometry knows too little, by scans.
const MOST_LOOKS: usize = 12;

impl<'l> Tracker<'l> {
    #[must_use]
    pub fn new(localiser: &'l Localiser<'l>) -> Self {
        Self {
            localiser,
            belief: Belief::Lost(Unknown::TooLittle),
            last: None,
            looks: Vec::new(),
            likely: None,
            doubts: 0,
        }
    }

    /// It is held to be at a pose of the sensor, where the odometry tells another: the first scan then speaks for or against.
    #[must_use]
    pub fn believing(
        localiser: &'l Localiser<'l>,
        pose: Isometry2<f64>,
        odometry: Isometry2<f64>,
    ) -> Self {
        let mut tracker = Self { last: Some(odometry), ..Self::new(localiser) };
        tracker.believe(pose);
        tracker
    }

    /// It is held to be here after all, whatever was believed.
    pub fn believe(&mut self, pose: Isometry2<f64>) {
        let covariance = Matrix3::zeros();
        self.belief =
            Belief::At(Fit { pose, covariance, explained: 0.0, through: 0.0, likeness: 0.0 });
        self.looks.clear();
        self.doubts = 0;
    }

    #[must_use]
    pub fn belief(&self) -> &Belief {
        &self.belief
    }

    /// Takes in a scan, with the odometry's pose of the sensor at that moment.
    pub fn scan(&mut self, sensor: &Sensor, ranges: &[f64], odometry: Isometry2<f64>) -> Event {
        let by = self.last.map(|last| last.inverse() * odometry);
        self.last = Some(odometry);
        match (&self.belief, by) {
            (Belief::At(fit), Some(by)) => {
                let pose = fit.pose * by;
                if self.follow(sensor, ranges, pose) {
                    return Event::Steady;
                }
                // The same scan tells where else it may be.
                self.belief = Belief::Lost(Unknown::Nowhere);
                self.look_about(sensor, ranges, odometry, Isometry2::identity());
                Event::GivenUp
            }
            _ => self.look_about(sensor, ranges, odometry, by.unwrap_or_default()),
        }
    }

    /// Whether the place that is believed still fits.
    fn follow(&mut self, sensor: &Sensor, ranges: &[f64], pose: Isometry2<f64>) -> bool {
        // In a corridor the scan holds no pose along it: odometry does, for a while.
        let fit = self.localiser.close_to(sensor, ranges, pose);
        let fit = fit
            .filter(|fit| is_near(&fit.pose, &pose, 60.0))
            .unwrap_or_else(|| self.localiser.fit_at(sensor, ranges, pose, loosely()));
        let options = self.localiser.options();
        let is_doubted = fit.worth() < options.least - 2.0 * options.margin;
        self.doubts = if is_doubted { self.doubts + 1 } else { 0 };
        self.belief = Belief::At(fit);
        if self.doubts < PATIENCE {
            return true;
        }
        self.doubts = 0;
        false
    }

    /// Where the place is not known: what it saw along the way, together. By single scans that speak against one place after
    /// another until one is left it would end at a wrong one, where the right one was never among them.
    fn look_about(
        &mut self,
        sensor: &Sensor,
        ranges: &[f64],
        odometry: Isometry2<f64>,
        by: Isometry2<f64>,
    ) -> Event {
        let is_new = self.looks.last().is_none_or(|last| {
            let way = last.at.inv_mul(&odometry);
            way.translation.vector.norm() >= STEP.0 || way.rotation.angle().abs() >= STEP.1
        });
        let is_alone = self.looks.len() == 1 && matches!(self.belief, Belief::Lost(_));
        self.likely = self.likely.map(|pose| pose * by);
        if !is_new && !is_alone {
            if let Belief::OneOf(fits) | Belief::Lost(Unknown::TooMany(fits)) = &mut self.belief {
                fits.iter_mut().for_each(|fit| fit.pose *= by);
            }
            let is_lost = matches!(self.belief, Belief::Lost(_));
            return if is_lost { Event::Lost } else { Event::Steady };
        }
        if !is_new {
            self.looks.clear();
        }
        let before = match &self.belief {
            Belief::OneOf(fits) => fits.len(),
            Belief::Lost(Unknown::TooMany(_)) => usize::MAX,
            _ => 0,
        };
        self.looks.extend(self.localiser.look(sensor, ranges, odometry));
        let past = self.looks.len().saturating_sub(MOST_LOOKS);
        self.looks.drain(..past);
        let alone = self.localiser.locate(sensor, ranges);
        let answer = match &self.looks[..] {
            [] | [_] => alone,
            looks => match (self.localiser.along(looks), alone) {
                (Answer::Unique(fit), Answer::Unique(other))
                    if is_near(&fit.pose, &other.pose, APART) =>
                {
                    Answer::Unique(fit)
                }
                // One scan may be clear where those before were not; and what the chart has and is not there any more bars
                // the right place from all looks that went through it, so that another is the likeliest by far.
                (_, Answer::Unique(other)) => Answer::Unique(other),
                (along, _) => along,
            },
        };
        let is_confirmed = |fit: &Fit| {
            self.looks.len() < 2
                || self.likely.is_some_and(|likely| is_near(&likely, &fit.pose, APART))
        };
        self.belief = match answer {
            Answer::Unique(fit) if !is_confirmed(&fit) => {
                self.likely = Some(fit.pose);
                Belief::Lost(Unknown::Unsure)
            }
            Answer::Unique(fit) => {
                self.likely = None;
                // What leads to the place is thinned; all that is seen from it holds it more exactly.
                let exact = self.localiser.close_to(sensor, ranges, fit.pose);
                Belief::At(
                    exact.filter(|exact| is_near(&exact.pose, &fit.pose, APART)).unwrap_or(fit),
                )
            }
            answer => {
                self.likely = None;
                answer.into()
            }
        };
        match &self.belief {
            Belief::At(_) => {
                self.looks.clear();
                if before > 0 { Event::Narrowed } else { Event::Steady }
            }
            Belief::OneOf(fits) if fits.len() < before => Event::Narrowed,
            Belief::OneOf(_) => Event::Steady,
            Belief::Lost(_) => Event::Lost,
        }
    }
}
