//! What of two neighbouring segments stays the same wherever the observer stands (SPEC V4; paper 3, section 1).
//!
//! A turning g(φ) keeps differences of inclination, a scaling g'(α) keeps them and the ratios of lengths. The paper
//! takes tan Δγ = cross / dot and λ = |b| / |a|. Kept as (cross, dot) and ln λ, a right angle is a number like any
//! other, and exchanging the two segments changes signs alone.

use crate::{Euclid, Segment, Space};

/// The turn from one segment to another, as unit (sin, cos). In space the sine is never negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    pub cross: f64,
    pub dot: f64,
}

impl Turn {
    /// Of two segments that have a direction; `None` where one is a point.
    #[must_use]
    pub fn between<const D: usize>(a: &Segment<D>, b: &Segment<D>) -> Option<Self>
    where
        Euclid<D>: Space<D>,
    {
        let unit = |s: &Segment<D>| s.vector().try_normalize(1e-9);
        let (cross, dot) = Euclid::turn(&unit(a)?, &unit(b)?);
        Some(Self { cross, dot })
    }

    /// Δγ in rad, −π to π.
    #[must_use]
    pub fn angle(self) -> f64 {
        self.cross.atan2(self.dot)
    }

    /// The paper's tg Δγ; infinite at a right angle.
    #[must_use]
    pub fn tangent(self) -> f64 {
        self.cross / self.dot
    }

    /// The turn back, in the plane.
    #[must_use]
    pub fn back(self) -> Self {
        Self { cross: -self.cross, ..self }
    }
}

/// ln λ, the ratio of the second length to the first, as far as both were seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ratio {
    /// Both segments are whole.
    Exactly(f64),
    /// The first is whole, the second goes on behind a cut.
    AtLeast(f64),
    /// The second is whole, the first goes on.
    AtMost(f64),
    /// Both go on: nothing follows.
    Unknown,
}

impl Ratio {
    /// Of two segments; `Unknown` where one is a point.
    #[must_use]
    pub fn between<const D: usize>(a: &Segment<D>, b: &Segment<D>) -> Self {
        let log = (b.length() / a.length()).ln();
        match (a.is_whole(), b.is_whole()) {
            _ if !log.is_finite() => Self::Unknown,
            (true, true) => Self::Exactly(log),
            (true, false) => Self::AtLeast(log),
            (false, true) => Self::AtMost(log),
            (false, false) => Self::Unknown,
        }
    }

    /// Of the same two in the other order.
    #[must_use]
    pub fn swapped(self) -> Self {
        match self {
            Self::Exactly(log) => Self::Exactly(-log),
            Self::AtLeast(log) => Self::AtMost(-log),
            Self::AtMost(log) => Self::AtLeast(-log),
            Self::Unknown => Self::Unknown,
        }
    }
}

/// The paper's pair {(j−1), j}: turn and ratio of two neighbours on a contour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    pub turn: Turn,
    pub ratio: Ratio,
}

impl Pair {
    #[must_use]
    pub fn of<const D: usize>(a: &Segment<D>, b: &Segment<D>) -> Option<Self>
    where
        Euclid<D>: Space<D>,
    {
        Some(Self { turn: Turn::between(a, b)?, ratio: Ratio::between(a, b) })
    }
}

/// Three in a row: two pairs that share the middle segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triple {
    pub first: Pair,
    pub second: Pair,
}

impl Triple {
    #[must_use]
    pub fn of<const D: usize>(a: &Segment<D>, b: &Segment<D>, c: &Segment<D>) -> Option<Self>
    where
        Euclid<D>: Space<D>,
    {
        Some(Self { first: Pair::of(a, b)?, second: Pair::of(b, c)? })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation2, Vector2};
    use proptest::prelude::*;

    use super::*;
    use crate::Motion;

    fn segment() -> impl Strategy<Value = Segment<2>> {
        (-500.0..500.0, -500.0..500.0, 1.0..300.0, -3.1..3.1).prop_map(
            |(x, y, length, angle): (f64, f64, f64, f64)| {
                let start = Vector2::new(x, y);
                Segment::given(start, start + Vector2::new(angle.cos(), angle.sin()) * length, 1.0)
            },
        )
    }

    proptest! {
        #[test]
        fn invariants_do_not_see_the_observer(
            a in segment(), b in segment(), x in -1e3..1e3, y in -1e3..1e3, angle in -3.1..3.1, scale in 0.1..10.0,
        ) {
            let motion = Motion::<2>::from_parts(Vector2::new(x, y).into(), Rotation2::new(angle), scale);
            let (before, after) = (Pair::of(&a, &b), Pair::of(&a.moved(&motion), &b.moved(&motion)));
            let (Some(before), Some(after)) = (before, after) else { panic!("both have a direction") };
            prop_assert!((before.turn.cross - after.turn.cross).abs() < 1e-9);
            prop_assert!((before.turn.dot - after.turn.dot).abs() < 1e-9);
            let (Ratio::Exactly(p), Ratio::Exactly(q)) = (before.ratio, after.ratio) else { panic!("both whole") };
            prop_assert!((p - q).abs() < 1e-9);
            let swapped = Pair::of(&b, &a).expect("directions");
            prop_assert!((swapped.turn.cross - before.turn.back().cross).abs() < 1e-12);
            let Ratio::Exactly(r) = swapped.ratio else { panic!("both whole") };
            prop_assert!((r + p).abs() < 1e-12);
        }
    }

    #[test]
    fn right_angles_are_no_special_case() {
        let a = Segment::given(Vector2::new(0.0, 0.0), Vector2::new(3.0, 0.0), 1.0);
        let b = Segment::given(Vector2::new(3.0, 0.0), Vector2::new(3.0, 4.0), 1.0);
        let turn = Turn::between(&a, &b).expect("directions");
        assert!((turn.angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert!(turn.tangent().abs() > 1e9);
        assert!((turn.back().angle() + std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
}
