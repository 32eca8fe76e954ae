//! A segment with its ends, and how surely each is known (SPEC V1, V2, V10; paper 3, formula 2).

use nalgebra::{SMatrix, SVector};

/// Why an end of a segment is an end of the thing itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Truth {
    /// Two faces meet here.
    Corner,
    /// The face ends in front of what lies behind.
    Free,
    /// Known from elsewhere: drawn, surveyed or a vertex of a given polyline.
    Given,
}

/// Why no more of a face was seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Cut {
    /// Something nearer hides the rest.
    Occluded,
    /// The rest is out of range, or sent nothing back.
    Range,
    /// The field of view ends here.
    Field,
    /// The contour goes on, but not as this straight line: too little of it to say how the two meet.
    Unclear,
}

/// What one end of a segment is.
///
/// A length is a measurement between two true ends; otherwise it is a lower bound (SPEC V4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// The thing ends here.
    True(Truth),
    /// The view ends here; the thing may go on.
    Cut(Cut),
}

impl End {
    #[must_use]
    pub const fn is_true(self) -> bool {
        matches!(self, Self::True(_))
    }
}

/// The covariance of both points of a segment together, in cm².
///
/// As a matrix over (start, end) it is `[[start, cross], [crossᵀ, end]]`: the 2n × 2n matrix R of paper 3, section 3,
/// in blocks, since its dimension cannot be computed from `D` in today's Rust. At a cut end it says how well the last
/// point *seen* is known, not where the thing ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Covariance<const D: usize> {
    /// Of the start.
    pub start: SMatrix<f64, D, D>,
    /// Of the end.
    pub end: SMatrix<f64, D, D>,
    /// E[δstart · δendᵀ]; zero where the two are independent.
    pub cross: SMatrix<f64, D, D>,
}

impl<const D: usize> Covariance<D> {
    /// Independent errors of deviation `sigma` cm in every coordinate: the paper's assumption.
    #[must_use]
    pub fn isotropic(sigma: f64) -> Self {
        let one = SMatrix::identity() * (sigma * sigma);
        Self { start: one, end: one, cross: SMatrix::zeros() }
    }

    /// Under a linear map: `a · R · aᵀ` in every block.
    #[must_use]
    pub fn mapped(&self, a: &SMatrix<f64, D, D>) -> Self {
        let map = |block: &SMatrix<f64, D, D>| a * block * a.transpose();
        Self { start: map(&self.start), end: map(&self.end), cross: map(&self.cross) }
    }

    /// With start and end exchanged.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { start: self.end, end: self.start, cross: self.cross.transpose() }
    }
}

/// The 1-simplex σ(start, end) in n-dimensional space, in cm; a point is a segment with equal ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment<const D: usize> {
    pub start: SVector<f64, D>,
    pub end: SVector<f64, D>,
    /// What the start and the end are, in this order.
    pub ends: [End; 2],
    pub covariance: Covariance<D>,
}

impl<const D: usize> Segment<D> {
    /// A segment known from elsewhere, both ends true, each coordinate with deviation `sigma` cm.
    #[must_use]
    pub fn given(start: SVector<f64, D>, end: SVector<f64, D>, sigma: f64) -> Self {
        let covariance = Covariance::isotropic(sigma);
        Self { start, end, ends: [End::True(Truth::Given); 2], covariance }
    }

    /// From start to end, in cm.
    #[must_use]
    pub fn vector(&self) -> SVector<f64, D> {
        self.end - self.start
    }

    /// Distance between the ends, in cm: the length of the face where [`is_whole`](Self::is_whole), else a lower bound.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.vector().norm()
    }

    /// Both ends are the thing's own.
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        self.ends[0].is_true() && self.ends[1].is_true()
    }

    /// The same segment told from its other end.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let [first, second] = self.ends;
        Self {
            start: self.end,
            end: self.start,
            ends: [second, first],
            covariance: self.covariance.reversed(),
        }
    }

    /// Under x ↦ a·x + shift: a turning, or a turning and a scaling.
    #[must_use]
    pub fn mapped(&self, a: &SMatrix<f64, D, D>, shift: &SVector<f64, D>) -> Self {
        Self {
            start: a * self.start + shift,
            end: a * self.end + shift,
            ends: self.ends,
            covariance: self.covariance.mapped(a),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Vector2};

    use super::*;

    #[test]
    fn turned_twice_is_as_before() {
        let mut segment = Segment::given(Vector2::new(1.0, 2.0), Vector2::new(4.0, 6.0), 0.5);
        segment.ends[1] = End::Cut(Cut::Occluded);
        segment.covariance.cross = Matrix2::new(0.1, 0.2, 0.3, 0.4);
        assert!((segment.length() - 5.0).abs() < 1e-12);
        assert!(!segment.is_whole());
        assert_eq!(segment.reversed().ends[0], End::Cut(Cut::Occluded));
        assert_eq!(segment.reversed().reversed(), segment);
    }
}
