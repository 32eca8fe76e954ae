//! A range sensor: where its beams point, how far they reach, and how much they err.

use nalgebra::Vector2;

/// No sensor of this kind reaches farther, in cm: beyond it sums of squares lose what noise tells.
const FARTHEST: f64 = 100_000.0;
/// Beams of one turn that are still told apart.
const MOST_BEAMS: usize = 1 << 16;
/// Least angle, in rad, at which a face is still expected to be seen; more oblique ones tear and are merged again.
const OBLIQUE: f64 = 0.175;

/// What a sensor cannot be.
#[derive(Debug, Clone, Copy, PartialEq, orthoframe_units::Fault)]
#[fault(vectors)]
#[non_exhaustive]
pub enum SensorError {
    /// Angles or the number of beams make no field of view.
    #[fault(code = "vectors::sensor_field")]
    Field { first: f64, step: f64, count: usize },

    /// Nearest and farthest range make no interval.
    #[fault(code = "vectors::sensor_reach")]
    Reach { nearest: f64, farthest: f64 },

    /// A deviation is no positive number.
    #[fault(code = "vectors::sensor_noise")]
    Noise(f64),
}

/// Deviations of one measurement: √(range² + (share·r)²) cm along the beam, `bearing` rad across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// In cm; what a resolution of the ranges adds is in it.
    pub range: f64,
    /// Of the range.
    pub share: f64,
    /// In rad.
    pub bearing: f64,
}

impl Default for Noise {
    /// A SICK LMS as the logs of mobile robots have it: 1 cm of noise, ranges in whole centimetres.
    fn default() -> Self {
        Self { range: 1.0, share: 0.0, bearing: 0.001 }
    }
}

impl Noise {
    /// Variance along the beam at range `r`, in cm².
    #[must_use]
    pub fn along(&self, r: f64) -> f64 {
        (self.share * r) * (self.share * r) + self.range * self.range
    }
}

/// Beams in one plane, counter-clockwise, evenly spaced.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    pub(crate) directions: Vec<Vector2<f64>>,
    pub(crate) first: f64,
    pub(crate) step: f64,
    pub(crate) nearest: f64,
    pub(crate) farthest: f64,
    pub(crate) noise: Noise,
    closed: bool,
    /// How far the next hit may lie, no, one and two beams on, as a share of the range, on a face seen as obliquely as can be.
    pub(super) oblique: [f64; 3],
}

impl Sensor {
    /// `count` beams, the first at `first` rad, each `step` rad further counter-clockwise; `reach` is the nearest and
    /// the farthest range in cm: what is not between them is no return.
    ///
    /// # Errors
    /// [`SensorError`].
    pub fn new(
        first: f64,
        step: f64,
        count: usize,
        reach: (f64, f64),
        noise: Noise,
    ) -> Result<Self, SensorError> {
        let turn = step * count.saturating_sub(1) as f64;
        let field = first.is_finite() && step > 0.0 && turn <= std::f64::consts::TAU + 1e-6;
        if !field || first.abs() > 100.0 || count > MOST_BEAMS {
            return Err(SensorError::Field { first, step, count });
        }
        let (nearest, farthest) = reach;
        if !(nearest >= 0.0 && nearest < farthest && farthest <= FARTHEST) {
            return Err(SensorError::Reach { nearest, farthest });
        }
        let fault = [
            (noise.range, noise.range > 0.0 && noise.range <= FARTHEST),
            (noise.share, (0.0..=1.0).contains(&noise.share)),
            (noise.bearing, (0.0..=1.0).contains(&noise.bearing)),
        ];
        if let Some((value, _)) = fault.into_iter().find(|(_, holds)| !holds) {
            return Err(SensorError::Noise(value));
        }
        let direction = |beam: usize| {
            let (sin, cos) = (step * beam as f64 + first).sin_cos();
            Vector2::new(cos, sin)
        };
        let directions = (0..count).map(direction).collect();
        let closed = count > 2 && std::f64::consts::TAU - turn <= 1.5 * step;
        let oblique = [0.0, 1.0, 2.0].map(|beams| {
            let turn = beams * step;
            turn.sin() / (OBLIQUE.max(1.5 * turn) - turn).sin()
        });
        Ok(Self { directions, first, step, nearest, farthest, noise, closed, oblique })
    }

    /// Number of beams.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.directions.len()
    }

    /// How many beams one is further than another, counted on over the last beam.
    pub(super) fn steps(&self, from: u32, to: u32) -> u32 {
        let count = self.count() as u32;
        (to + count - from) % count
    }

    /// Unit vectors of the beams.
    #[must_use]
    pub fn directions(&self) -> &[Vector2<f64>] {
        &self.directions
    }

    /// Bearing of a beam, in rad.
    #[must_use]
    pub fn bearing(&self, beam: usize) -> f64 {
        self.step * beam as f64 + self.first
    }

    /// Angle between neighbouring beams, in rad.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// Nearest and farthest range, in cm.
    #[must_use]
    pub const fn reach(&self) -> (f64, f64) {
        (self.nearest, self.farthest)
    }

    #[must_use]
    pub const fn noise(&self) -> Noise {
        self.noise
    }

    /// The same beams with another noise.
    ///
    /// # Errors
    /// [`SensorError::Noise`].
    pub fn with_noise(self, noise: Noise) -> Result<Self, SensorError> {
        Self::new(self.first, self.step, self.count(), self.reach(), noise)
    }

    /// The last beam borders on the first: all around is seen.
    #[must_use]
    pub const fn is_closed(&self) -> bool {
        self.closed
    }

    /// Whether a range is a return. NaN and infinities are none.
    #[must_use]
    pub fn returned(&self, range: f64) -> bool {
        range > self.nearest && range < self.farthest
    }
}
