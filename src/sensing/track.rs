//! What is possible, carried along from scan to scan by odometry (SPEC L3).

use nalgebra::Isometry2;

use super::locate::{Answer, Fit, Localiser};
use super::search::is_near;
use crate::vectors::scan::Sensor;

/// What is believed of the pose after a scan.
#[derive(Debug, Clone)]
pub enum Belief {
    /// One pose is left.
    At(Fit),
    /// Any of these, the best first.
    OneOf(Vec<Fit>),
    /// None: it was never found, or what was believed does not fit any more.
    Lost,
}

impl From<Answer> for Belief {
    fn from(answer: Answer) -> Self {
        match answer {
            Answer::Unique(fit) => Self::At(fit),
            Answer::Ambiguous(fits) => Self::OneOf(fits),
            Answer::Unknown => Self::Lost,
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
    /// Nothing fits.
    Lost,
}

/// Follows a robot over a chart.
pub struct Tracker<'l> {
    localiser: &'l Localiser<'l>,
    belief: Belief,
    last: Option<Isometry2<f64>>,
    /// Scans in a row that fitted badly.
    doubts: usize,
}

/// Scans in a row that a belief may fit badly before it is given up.
const PATIENCE: usize = 3;
/// Hypotheses nearer than this are one, in cm.
const APART: f64 = 40.0;
/// Of more places one at a time is no knowledge.
const MOST: usize = 200;

impl<'l> Tracker<'l> {
    #[must_use]
    pub fn new(localiser: &'l Localiser<'l>) -> Self {
        Self { localiser, belief: Belief::Lost, last: None, doubts: 0 }
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
        let covariance = nalgebra::Matrix3::zeros();
        self.belief =
            Belief::At(Fit { pose, covariance, explained: 0.0, through: 0.0, likeness: 0.0 });
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
        let known = match (&self.belief, by) {
            (Belief::At(fit), Some(by)) => vec![fit.pose * by],
            (Belief::OneOf(fits), Some(by)) => fits.iter().map(|fit| fit.pose * by).collect(),
            _ => Vec::new(),
        };
        if known.is_empty() {
            self.belief = self.localiser.locate(sensor, ranges).into();
            self.doubts = 0;
            return if matches!(self.belief, Belief::Lost) { Event::Lost } else { Event::Steady };
        }
        let mut fits: Vec<Fit> = Vec::new();
        for pose in known.iter().take(MOST) {
            // In a corridor the scan holds no pose along it: odometry does, for a while.
            let fit = self
                .localiser
                .close_to(sensor, ranges, *pose)
                .filter(|fit| is_near(&fit.pose, pose, 60.0));
            let fit = fit.unwrap_or_else(|| {
                let covariance =
                    nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(900.0, 900.0, 0.01));
                self.localiser.fit_at(sensor, ranges, *pose, covariance)
            });
            match fits.iter_mut().find(|known| is_near(&known.pose, &fit.pose, APART)) {
                Some(known) if known.rank() < fit.rank() => *known = fit,
                Some(_) => {}
                None => fits.push(fit),
            }
        }
        fits.sort_by(|a, b| b.rank().total_cmp(&a.rank()));
        let options = self.localiser.options();
        let best = fits.first().map_or(-1.0, Fit::worth);
        if best < options.least - 2.0 * options.margin {
            self.doubts += 1;
            if self.doubts >= PATIENCE {
                self.belief = Belief::Lost;
                self.doubts = 0;
                return Event::GivenUp;
            }
        } else {
            self.doubts = 0;
            // What fits much worse than another is not where the robot is.
            let bound = fits.first().map_or(-1.0, Fit::rank) - 1.5 * options.margin;
            fits.retain(|fit| fit.rank() >= bound);
        }
        let is_narrowed = fits.len() < known.len();
        self.belief = match fits.len() {
            1 => Belief::At(fits.swap_remove(0)),
            _ => Belief::OneOf(fits),
        };
        if is_narrowed { Event::Narrowed } else { Event::Steady }
    }
}
