//! [`Cm`] and [`Deg`]: numbers that came from outside and were found fit to compute with.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use serde::{Deserialize, Serialize};

use super::{Language, Lengths};

/// Why a number from outside is no length or no angle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum QuantityError {
    /// NaN or infinite.
    NotFinite(f64),
    /// Beyond [`Cm::LIMIT`], where hundredths of a millimetre would be lost in an `f64` sum.
    TooLarge(f64),
}

/// A length in centimetres: finite, at most [`Cm::LIMIT`] either way.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Cm(f64);

impl Cm {
    /// A hundred kilometres: no building is larger.
    pub const LIMIT: f64 = 1e7;
    pub const ZERO: Self = Self(0.0);

    /// # Errors
    /// [`QuantityError`] when the number is not finite or exceeds [`Cm::LIMIT`].
    pub fn new(value: f64) -> Result<Self, QuantityError> {
        match value {
            v if !v.is_finite() => Err(QuantityError::NotFinite(v)),
            v if v.abs() > Self::LIMIT => Err(QuantityError::TooLarge(v)),
            v => Ok(Self(v)),
        }
    }

    /// A length computed from checked ones.
    #[must_use]
    pub fn of(value: f64) -> Self {
        debug_assert!(value.is_finite(), "a length computed from finite lengths is finite");
        Self(value)
    }

    #[must_use]
    pub fn get(self) -> f64 {
        self.0
    }

    /// In tenths of a millimetre, the unit of the facts: exact to compare and to hash.
    #[must_use]
    pub fn to_tenths_mm(self) -> i64 {
        (self.0 * 100.0).round() as i64
    }
}

impl TryFrom<f64> for Cm {
    type Error = QuantityError;
    fn try_from(value: f64) -> Result<Self, Self::Error> {
        Self::new(value)
    }
}

impl From<Cm> for f64 {
    fn from(value: Cm) -> Self {
        value.0
    }
}

impl Add for Cm {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Cm {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Neg for Cm {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Mul<f64> for Cm {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0 * factor)
    }
}

impl Div<f64> for Cm {
    type Output = Self;
    fn div(self, divisor: f64) -> Self {
        Self(self.0 / divisor)
    }
}

impl Cm {
    /// The length as faults tell it: in the unit of this run, the number as files write it.
    #[must_use]
    pub fn say(self, language: Language) -> String {
        cm(self.0, language)
    }
}

fn cm(value: f64, language: Language) -> String {
    let unit = Lengths::said();
    format!("{} {}", unit.short(round_for_people(value), 2), unit.word(language))
}

impl fmt::Display for Cm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.say(Language::Russian))
    }
}

/// An angle in degrees counter-clockwise, kept in `[0, 360)`.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Deg(f64);

impl Deg {
    pub const ZERO: Self = Self(0.0);

    /// # Errors
    /// [`QuantityError::NotFinite`].
    pub fn new(value: f64) -> Result<Self, QuantityError> {
        if value.is_finite() { Ok(Self::of(value)) } else { Err(QuantityError::NotFinite(value)) }
    }

    /// An angle computed from finite numbers, brought into `[0, 360)`.
    #[must_use]
    pub fn of(value: f64) -> Self {
        debug_assert!(value.is_finite(), "an angle computed from finite numbers is finite");
        let turned = value.rem_euclid(360.0);
        // rem_euclid of a tiny negative number rounds up to 360 itself.
        Self(if turned >= 360.0 { 0.0 } else { turned })
    }

    #[must_use]
    pub fn from_radians(radians: f64) -> Self {
        Self::of(radians.to_degrees())
    }

    #[must_use]
    pub fn get(self) -> f64 {
        self.0
    }

    #[must_use]
    pub fn radians(self) -> f64 {
        self.0.to_radians()
    }

    /// The same angle in `(-180, 180]`, as a turn to the left (positive) or to the right.
    #[must_use]
    pub fn signed(self) -> f64 {
        if self.0 > 180.0 { self.0 - 360.0 } else { self.0 }
    }

    /// `(sin, cos)`, exact at the multiples of 90°.
    #[must_use]
    pub fn sin_cos(self) -> (f64, f64) {
        let quarter = self.0 / 90.0;
        if quarter.fract() == 0.0 {
            match quarter as u8 {
                0 => (0.0, 1.0),
                1 => (1.0, 0.0),
                2 => (0.0, -1.0),
                _ => (-1.0, 0.0),
            }
        } else {
            self.radians().sin_cos()
        }
    }
}

impl TryFrom<f64> for Deg {
    type Error = QuantityError;
    fn try_from(value: f64) -> Result<Self, Self::Error> {
        Self::new(value)
    }
}

impl From<Deg> for f64 {
    fn from(value: Deg) -> Self {
        value.0
    }
}

impl Add for Deg {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::of(self.0 + other.0)
    }
}

impl Sub for Deg {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::of(self.0 - other.0)
    }
}

impl Neg for Deg {
    type Output = Self;
    fn neg(self) -> Self {
        Self::of(-self.0)
    }
}

impl fmt::Display for Deg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}°", round_for_people(self.0))
    }
}

/// Two decimals at most, none when they say nothing.
fn round_for_people(value: f64) -> f64 {
    (value * 100.0).round() / 100.0 + 0.0
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exactness is what these tests are about")]
mod tests {
    use super::*;

    #[test]
    fn outside_numbers_are_refused_with_the_reason() {
        assert!(matches!(Cm::new(f64::NAN), Err(QuantityError::NotFinite(_))));
        assert_eq!(Cm::new(1e8), Err(QuantityError::TooLarge(1e8)));
        assert!(Deg::new(f64::INFINITY).is_err());
    }

    #[test]
    fn angles_stay_within_one_turn() {
        assert_eq!(Deg::of(-90.0).get(), 270.0);
        assert_eq!(Deg::of(-1e-300).get(), 0.0);
        assert_eq!(Deg::of(270.0).signed(), -90.0);
        assert_eq!(Deg::of(180.0).signed(), 180.0);
    }

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(Deg::of(90.0).sin_cos(), (1.0, 0.0));
        assert_eq!(Deg::of(-90.0).sin_cos(), (-1.0, 0.0));
    }
}
