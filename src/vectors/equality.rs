//! When two segments are the same, seen with errors (SPEC V10, V11; paper 3, section 3).
//!
//! A segment is a point of R²ⁿ, and so is the residual Δh of two. With independent normal errors it has the density
//! f(x) = |A|^½ (2π)^−n e^(−½(Ax, x)), A = R⁻¹ (the paper prints the factor without its root and the exponent without
//! its half), and (Ax, x) follows the χ² law with 2n degrees of freedom. Given a confidence, that law is solved for
//! the radius: of the whitened residual √(Ax, x), or, as the paper has it, of the residual itself in units of one σ.
//!
//! # Invariants
//!
//! What was not measured is not compared: along a cut end, where the other segment goes on, there is no residual and
//! one degree of freedom less. An end that was seen *beyond* a true end is a residual like any other.

use nalgebra::{SMatrix, SVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::{Covariance, Segment};

/// Variance that stands for "not measured", in cm²: a kilometre.
pub(crate) const UNMEASURED: f64 = 1e10;
/// Least variance of a coordinate, in cm²: a hundredth of a millimetre. Two exact segments can be compared at all.
const LEAST: f64 = 1e-6;

/// √ of the χ² quantile: the radius within which a normal vector of `freedom` coordinates lies with `confidence`, in σ.
///
/// # Panics
///
/// When `freedom` is 0 or `confidence` is outside 0 < p < 1.
#[must_use]
pub fn radius(confidence: f64, freedom: u32) -> f64 {
    assert!(confidence > 0.0 && confidence < 1.0, "a confidence lies between 0 and 1");
    let law = ChiSquared::new(f64::from(freedom)).expect("at least one degree of freedom");
    law.inverse_cdf(confidence).sqrt()
}

/// Probability that the residual of two equal segments is at most this long: the paper's P_c(r), r in σ.
#[must_use]
pub fn within(radius: f64, freedom: u32) -> f64 {
    ChiSquared::new(f64::from(freedom)).map_or(1.0, |law| law.cdf(radius * radius))
}

/// What differs between two segments whose ends correspond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual<const D: usize> {
    /// First start less second start, in cm, without what was not measured.
    pub start: SVector<f64, D>,
    /// First end less second end.
    pub end: SVector<f64, D>,
    /// A = R⁻¹ in blocks, in cm⁻²: of the starts, of the ends, between them.
    pub information: [SMatrix<f64, D, D>; 3],
    /// How many coordinates were measured in both: 2n where every end is true.
    pub freedom: u32,
    /// Along the segment, for start and end: whether the place of the end was compared.
    pub compared: [bool; 2],
    /// |R|, with [`UNMEASURED`] for each coordinate that was not.
    determinant: f64,
}

impl<const D: usize> Residual<D> {
    /// Of `a` against `b`, start to start and end to end, errors of both independent of one another.
    ///
    /// `None` when two views of one line do not meet: that they are parts of one face was not seen.
    #[must_use]
    pub fn between(a: &Segment<D>, b: &Segment<D>) -> Option<Self> {
        Self::of(a, b, false)
    }

    /// The same of what the start does not tell: of the end alone, for a start that another segment's end told.
    pub(crate) fn of_end(a: &Segment<D>, b: &Segment<D>) -> Option<Self> {
        Self::of(a, b, true)
    }

    fn of(a: &Segment<D>, b: &Segment<D>, end_alone: bool) -> Option<Self> {
        let along = (a.vector() + b.vector()).try_normalize(f64::MIN_POSITIVE);
        let mut x = [a.start - b.start, a.end - b.end];
        let sum = |p: &SMatrix<f64, D, D>, q: &SMatrix<f64, D, D>| p + q;
        let floor = SMatrix::<f64, D, D>::identity() * LEAST;
        let mut r = [
            sum(&a.covariance.start, &b.covariance.start) + floor,
            sum(&a.covariance.end, &b.covariance.end) + floor,
        ];
        let mut cross = sum(&a.covariance.cross, &b.covariance.cross);
        let mut compared = [true; 2];
        if let Some(u) = along {
            let overlap = a.end.dot(&u).min(b.end.dot(&u)) - a.start.dot(&u).max(b.start.dot(&u));
            let slack = 4.0 * (u.dot(&((r[0] + r[1]) * u))).sqrt();
            if overlap < -slack {
                return None;
            }
            for side in 0..2 {
                // Positive where `a` reaches further out than `b` at this end.
                let outward = if side == 0 { -x[0].dot(&u) } else { x[1].dot(&u) };
                let beyond = match (a.ends[side].is_true(), b.ends[side].is_true()) {
                    (true, true) => true,
                    (false, true) => outward > 0.0,
                    (true, false) => outward < 0.0,
                    (false, false) => false,
                };
                compared[side] = beyond;
                if !beyond {
                    x[side] -= u * u.dot(&x[side]);
                    r[side] += u * u.transpose() * UNMEASURED;
                }
            }
        }
        let mut freedom = 2 * D as u32 - compared.iter().filter(|&&c| !c).count() as u32;
        if end_alone {
            freedom -= D as u32 - u32::from(!compared[0]);
            compared[0] = false;
            x[0] = SVector::zeros();
            r[0] += SMatrix::<f64, D, D>::identity() * UNMEASURED;
        }
        let inverse = r[0].try_inverse()?;
        let gain = cross.transpose() * inverse;
        let rest = r[1] - gain * cross;
        let second = rest.try_inverse()?;
        cross = -(inverse * cross * second);
        let first = inverse + gain.transpose() * second * gain;
        let determinant = determinant(&r[0]) * determinant(&rest);
        Some(Self {
            start: x[0],
            end: x[1],
            information: [first, second, cross],
            freedom,
            compared,
            determinant,
        })
    }

    /// (Ax, x): the squared whitened distance.
    #[must_use]
    pub fn squared(&self) -> f64 {
        let [first, second, cross] = &self.information;
        let mixed = self.start.dot(&(cross * self.end));
        (self.start.dot(&(first * self.start)) + self.end.dot(&(second * self.end)) + 2.0 * mixed)
            .max(0.0)
    }

    /// |x|, in cm: the paper's distance.
    #[must_use]
    pub fn norm(&self) -> f64 {
        (self.start.norm_squared() + self.end.norm_squared()).sqrt()
    }

    /// ln f(x) over the coordinates that were measured, x in cm.
    #[must_use]
    pub fn log_density(&self) -> f64 {
        let turns = f64::from(self.freedom) * std::f64::consts::TAU.ln();
        let unmeasured = f64::from(2 * D as u32 - self.freedom) * UNMEASURED.ln();
        -0.5 * (self.squared() + turns + self.determinant.max(f64::MIN_POSITIVE).ln() - unmeasured)
    }
}

/// |m| of a positive matrix, by elimination: nalgebra's own determinant asks for bounds that `D` cannot give.
fn determinant<const D: usize>(m: &SMatrix<f64, D, D>) -> f64 {
    let mut m = *m;
    let mut product = 1.0;
    for k in 0..D {
        let pivot = m[(k, k)].max(f64::MIN_POSITIVE);
        product *= pivot;
        for i in k + 1..D {
            let factor = m[(i, k)] / pivot;
            for j in k..D {
                let above = m[(k, j)];
                m[(i, j)] -= factor * above;
            }
        }
    }
    product
}

/// By what the residual of two segments is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure {
    /// √(Ax, x), with the covariance of both segments.
    Whitened,
    /// The paper's ball: |x| in units of one deviation for every coordinate, cm. Where both segments were seen with
    /// it, not one against the truth, the residual's deviation is √2 of it.
    Ball { sigma: f64, both_noisy: bool },
}

/// Stochastic equality of segments at a confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equality {
    confidence: f64,
    measure: Measure,
    /// Squared radius by degrees of freedom, 1 to 6.
    squared: [f64; 6],
}

/// Two segments found equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Match<const D: usize> {
    /// The second segment's start lies at the first one's end.
    pub reversed: bool,
    pub residual: Residual<D>,
}

impl Equality {
    /// At `confidence`, by whitened distance.
    ///
    /// # Panics
    ///
    /// When `confidence` is outside 0 < p < 1.
    #[must_use]
    pub fn at(confidence: f64) -> Self {
        let squared = [1, 2, 3, 4, 5, 6].map(|freedom| radius(confidence, freedom).powi(2));
        Self { confidence, measure: Measure::Whitened, squared }
    }

    /// The same confidence by another measure.
    #[must_use]
    pub const fn by(self, measure: Measure) -> Self {
        Self { measure, ..self }
    }

    #[must_use]
    pub const fn confidence(&self) -> f64 {
        self.confidence
    }

    /// The radius for so many degrees of freedom (1 to 6), in σ.
    #[must_use]
    pub fn radius(&self, freedom: u32) -> f64 {
        self.squared[freedom.clamp(1, 6) as usize - 1].sqrt()
    }

    /// Whether a residual is as small as that of equal segments.
    #[must_use]
    pub fn admits<const D: usize>(&self, residual: &Residual<D>) -> bool {
        let most = self.squared[residual.freedom.clamp(1, 6) as usize - 1];
        match self.measure {
            Measure::Whitened => residual.squared() <= most,
            Measure::Ball { sigma, both_noisy } => {
                let variance = sigma * sigma * if both_noisy { 2.0 } else { 1.0 };
                residual.norm().powi(2) <= most * variance
            }
        }
    }

    /// Whether two segments are equal, undirected: both end orders are tried, and the nearer one is told.
    #[must_use]
    pub fn equal<const D: usize>(&self, a: &Segment<D>, b: &Segment<D>) -> Option<Match<D>> {
        let straight = Residual::between(a, b).map(|residual| Match { reversed: false, residual });
        let crossed =
            Residual::between(a, &b.reversed()).map(|residual| Match { reversed: true, residual });
        [straight, crossed]
            .into_iter()
            .flatten()
            .filter(|found| self.admits(&found.residual))
            .min_by(|p, q| p.residual.norm().total_cmp(&q.residual.norm()))
    }
}

impl<const D: usize> Covariance<D> {
    /// The greatest deviation of a coordinate of either end, in cm.
    #[must_use]
    pub fn deviation(&self) -> f64 {
        let most = |m: &SMatrix<f64, D, D>| (0..D).map(|k| m[(k, k)]).fold(0.0, f64::max);
        most(&self.start).max(most(&self.end)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Vector2, Vector3};

    use super::*;
    use crate::{Cut, End};

    /// SPEC V11's table. Its 3.549 is the root of the printed quantile 12.592; of the law itself it is 3.5485.
    #[test]
    fn radii_of_the_chi_squared_law() {
        let table = [(4, 0.90, 2.789), (4, 0.95, 3.080), (4, 0.99, 3.644), (4, 0.999, 4.297)];
        let space = [(6, 0.90, 3.263), (6, 0.95, 3.549), (6, 0.99, 4.100), (6, 0.999, 4.739)];
        for (freedom, confidence, expected) in table.into_iter().chain(space) {
            let found = radius(confidence, freedom);
            assert!(
                (found - expected).abs() < 6e-4,
                "{freedom} {confidence}: {found}, not {expected}"
            );
            assert!((within(found, freedom) - confidence).abs() < 1e-9);
        }
    }

    #[test]
    fn the_density_is_the_normal_law() {
        let a = Segment::given(Vector2::new(0.0, 0.0), Vector2::new(100.0, 0.0), 1.0);
        let b = Segment::given(Vector2::new(1.0, 2.0), Vector2::new(103.0, 0.0), 2.0);
        let residual = Residual::between(&a, &b).expect("they overlap");
        // Each coordinate has variance 1 + 4; x = (−1, −2, −3, 0).
        let expected = -0.5 * (14.0 / 5.0) - 2.0 * std::f64::consts::TAU.ln() - 2.0 * 5.0_f64.ln();
        assert!(
            (residual.log_density() - expected).abs() < 1e-5,
            "{} {expected}",
            residual.log_density()
        );
        assert!((residual.squared() - 14.0 / 5.0).abs() < 1e-5);
        assert_eq!(residual.freedom, 4);
    }

    #[test]
    fn either_end_order_and_both_measures() {
        let a = Segment::given(Vector3::new(0.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 80.0), 1.0);
        let b = Segment::given(Vector3::new(0.5, 0.0, 80.0), Vector3::new(0.0, -0.5, 0.0), 1.0);
        let equality = Equality::at(0.99);
        assert!(equality.equal(&a, &b).is_some_and(|found| found.reversed));
        let ball = equality.by(Measure::Ball { sigma: 0.1, both_noisy: true });
        assert!(ball.equal(&a, &b).is_none());
        assert!(
            equality.by(Measure::Ball { sigma: 0.2, both_noisy: false }).equal(&a, &b).is_some()
        );
        assert!(
            equality.by(Measure::Ball { sigma: 0.12, both_noisy: true }).equal(&a, &b).is_none()
        );
    }

    #[test]
    fn a_cut_end_may_go_on_but_not_back() {
        let whole = Segment::given(Vector2::new(0.0, 0.0), Vector2::new(200.0, 0.0), 1.0);
        let mut part = Segment::given(Vector2::new(0.5, 0.0), Vector2::new(90.0, 0.0), 1.0);
        part.ends[1] = End::Cut(Cut::Occluded);
        let equality = Equality::at(0.999);
        let found = equality.equal(&part, &whole).expect("a part of it");
        assert_eq!((found.residual.freedom, found.residual.compared), (3, [true, false]));
        part.end.x = 230.0;
        assert!(equality.equal(&part, &whole).is_none(), "seen beyond a true end");
        part.start.x = 60.0;
        part.end.x = 90.0;
        assert!(equality.equal(&part, &whole).is_none(), "a true end where none is");
        part.ends[0] = End::Cut(Cut::Field);
        assert!(equality.equal(&part, &whole).is_some());
    }
}
