//! Turning, scaling and shifting, and the one that best carries segments onto others (SPEC V4, V13; paper 3, section 1).
//!
//! What differs between the plane and space stands in [`Space`]; all else is written once for both.

use nalgebra::{
    Isometry, Matrix2, Matrix3, Rotation, Rotation2, Rotation3, SMatrix, SVector, Similarity,
    Vector2, Vector3,
};

use crate::{Residual, Segment};

/// The paper's g(φ), g'(α) and the shift in one: x ↦ α·R·x + d.
pub type Motion<const D: usize> = Similarity<f64, Rotation<f64, D>, D>;
/// A motion without scaling: the transition matrix of a frame.
pub type Transition<const D: usize> = Isometry<f64, Rotation<f64, D>, D>;

/// Most parameters of a motion: three of turning, three of shift, one of scale.
pub(crate) const PARAMETERS: usize = 7;
/// Where the shift's parameters begin, and where the scale's stands.
pub(crate) const SHIFT: usize = 3;
pub(crate) const SCALE: usize = 6;
pub(crate) type Parameters = SVector<f64, PARAMETERS>;
pub(crate) type Information = SMatrix<f64, PARAMETERS, PARAMETERS>;

/// The plane or space: the marker on which [`Space`] is implemented.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Euclid<const D: usize>;

/// What is not the same in the plane and in space.
pub trait Space<const D: usize> {
    /// Parameters of a turning.
    const TURNS: usize;

    /// The turning R for which Σ (R·p − q)² is least, from Σ q·pᵀ; never a reflection (Kabsch, Umeyama).
    fn turning(moment: &SMatrix<f64, D, D>) -> Rotation<f64, D>;

    /// The turning by small angles about each axis, in rad.
    fn turned(by: &[f64; 3]) -> Rotation<f64, D>;

    /// Where a point at `lever` from the pivot goes under a small turning about axis `axis`: the derivative.
    fn swing(axis: usize, lever: &SVector<f64, D>) -> SVector<f64, D>;

    /// Sine and cosine of the turn from `a` to `b`, unit vectors. The sine has a sign in the plane alone.
    fn turn(a: &SVector<f64, D>, b: &SVector<f64, D>) -> (f64, f64);

    /// How far `b` is turned against `a` about `axis`, in rad, signed; zero in the plane.
    fn dihedral(axis: &SVector<f64, D>, a: &SVector<f64, D>, b: &SVector<f64, D>) -> f64;
}

impl Space<2> for Euclid<2> {
    const TURNS: usize = 1;

    fn turning(m: &Matrix2<f64>) -> Rotation2<f64> {
        Rotation2::new((m[(1, 0)] - m[(0, 1)]).atan2(m[(0, 0)] + m[(1, 1)]))
    }

    fn turned(by: &[f64; 3]) -> Rotation2<f64> {
        Rotation2::new(by[0])
    }

    fn swing(_axis: usize, lever: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(-lever.y, lever.x)
    }

    fn turn(a: &Vector2<f64>, b: &Vector2<f64>) -> (f64, f64) {
        (a.perp(b), a.dot(b))
    }

    fn dihedral(_axis: &Vector2<f64>, _a: &Vector2<f64>, _b: &Vector2<f64>) -> f64 {
        0.0
    }
}

impl Space<3> for Euclid<3> {
    const TURNS: usize = 3;

    fn turning(m: &Matrix3<f64>) -> Rotation3<f64> {
        let svd = m.svd(true, true);
        let (Some(u), Some(v)) = (svd.u, svd.v_t) else { return Rotation3::identity() };
        // Singular values are sorted: the least one is turned where the product is a reflection.
        let keep = (u * v).determinant().signum();
        let sign = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, keep));
        Rotation3::from_matrix_unchecked(u * sign * v)
    }

    fn turned(by: &[f64; 3]) -> Rotation3<f64> {
        Rotation3::new(Vector3::from(*by))
    }

    fn swing(axis: usize, lever: &Vector3<f64>) -> Vector3<f64> {
        Vector3::ith(axis, 1.0).cross(lever)
    }

    fn turn(a: &Vector3<f64>, b: &Vector3<f64>) -> (f64, f64) {
        (a.cross(b).norm(), a.dot(b))
    }

    fn dihedral(axis: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
        let (m, n) = (axis.cross(a), axis.cross(b));
        axis.dot(&m.cross(&n)).atan2(m.dot(&n))
    }
}

impl<const D: usize> Segment<D> {
    /// Where it is after a motion, with its covariance.
    #[must_use]
    pub fn moved(&self, motion: &Motion<D>) -> Self {
        let linear = motion.isometry.rotation.matrix() * motion.scaling();
        self.mapped(&linear, &motion.isometry.translation.vector)
    }
}

/// The motion that best carries points onto points in the plain sense, scale kept at one unless `scaled`.
///
/// `None` when the points coincide, so that no turning follows from them.
pub(crate) fn carry<const D: usize>(
    pairs: &[(SVector<f64, D>, SVector<f64, D>)],
    scaled: bool,
) -> Option<Motion<D>>
where
    Euclid<D>: Space<D>,
{
    let count = pairs.len() as f64;
    let (mut from, mut to) = (SVector::zeros(), SVector::zeros());
    for (p, q) in pairs {
        from += p / count;
        to += q / count;
    }
    let mut moment = SMatrix::zeros();
    let mut spread = 0.0;
    for (p, q) in pairs {
        moment += (q - to) * (p - from).transpose();
        spread += (p - from).norm_squared();
    }
    if spread <= f64::MIN_POSITIVE {
        return None;
    }
    let turning = Euclid::turning(&moment);
    let scale = if scaled { (turning.matrix().component_mul(&moment)).sum() / spread } else { 1.0 };
    if !(scale > 1e-6 && scale < 1e6) {
        return None;
    }
    let shift = to - turning * from * scale;
    Some(Motion::from_parts(shift.into(), turning, scale))
}

/// The motion that pairs of segments ask for, start to start: true ends upon true ends, directions upon directions.
///
/// `None` where no two true ends say where along itself something lies.
pub(crate) fn motion_of<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    scaled: bool,
) -> Option<Motion<D>>
where
    Euclid<D>: Space<D>,
{
    let mut points = Vec::with_capacity(2 * pairs.len());
    let mut known = 0;
    for (from, to) in pairs {
        let length = from.length().min(to.length());
        let (u, v) = (
            from.vector().try_normalize(1e-9)? * length,
            to.vector().try_normalize(1e-9)? * length,
        );
        let both = [0, 1].map(|k| from.ends[k].is_true() && to.ends[k].is_true());
        known += both.iter().filter(|&&b| b).count();
        match both {
            [true, true] => points.extend([(from.start, to.start), (from.end, to.end)]),
            [true, false] => {
                points.extend([(from.start, to.start), (from.start + u, to.start + v)])
            }
            [false, true] => points.extend([(from.end - u, to.end - v), (from.end, to.end)]),
            [false, false] => {}
        }
    }
    if known < 2 { None } else { carry(&points, scaled) }
}

/// A motion refined by residuals: weighted least squares about the motion so far (Gauss–Newton).
#[derive(Debug, Clone)]
pub(crate) struct Fit<const D: usize> {
    pub(crate) motion: Motion<D>,
    /// About which turning and scaling are taken: a point after the motion.
    pub(crate) pivot: SVector<f64, D>,
    /// Λ over (turning, shift, scale); what is not fitted has one on the diagonal.
    pub(crate) information: Information,
    gradient: Parameters,
    scaled: bool,
}

impl<const D: usize> Fit<D>
where
    Euclid<D>: Space<D>,
{
    pub(crate) fn new(motion: Motion<D>, pivot: SVector<f64, D>, scaled: bool) -> Self {
        Self {
            motion,
            pivot,
            information: blank::<D>(scaled),
            gradient: Parameters::zeros(),
            scaled,
        }
    }

    /// Derivative of a moved point by each parameter that is fitted, and that parameter's place.
    fn derivatives(
        &self,
        point: &SVector<f64, D>,
    ) -> ([(usize, SVector<f64, D>); PARAMETERS], usize) {
        let lever = point - self.pivot;
        let mut all = [(0, SVector::zeros()); PARAMETERS];
        let mut count = 0;
        let mut push = |place: usize, derivative: SVector<f64, D>| {
            all[count] = (place, derivative);
            count += 1;
        };
        for axis in 0..Euclid::<D>::TURNS {
            push(axis, Euclid::swing(axis, &lever));
        }
        for k in 0..D {
            push(SHIFT + k, SVector::from_fn(|i, _| if i == k { 1.0 } else { 0.0 }));
        }
        if self.scaled {
            push(SCALE, lever);
        }
        (all, count)
    }

    /// Takes in what a segment, already moved, differs by from its match.
    pub(crate) fn add(&mut self, moved: &Segment<D>, residual: &Residual<D>) {
        let ((p, count), (q, _)) = (self.derivatives(&moved.start), self.derivatives(&moved.end));
        let [first, second, cross] = &residual.information;
        for j in 0..count {
            let place = p[j].0;
            let start = first * p[j].1 + cross * q[j].1;
            let end = cross.transpose() * p[j].1 + second * q[j].1;
            self.gradient[place] += start.dot(&residual.start) + end.dot(&residual.end);
            for i in 0..=j {
                let sum = p[i].1.dot(&start) + q[i].1.dot(&end);
                self.information[(p[i].0, place)] += sum;
                if i < j {
                    self.information[(place, p[i].0)] += sum;
                }
            }
        }
    }

    /// The motion after one step, and how far the step went in σ; `None` where the residuals leave it open.
    pub(crate) fn step(&self) -> Option<(Motion<D>, f64)> {
        let factor = self.information.cholesky()?;
        let step = -factor.solve(&self.gradient);
        let length = (self.information * step).dot(&step).max(0.0).sqrt();
        let turning = Euclid::<D>::turned(&[step[0], step[1], step[2]]);
        let scale = step[SCALE].clamp(-0.5, 0.5).exp();
        let shift: SVector<f64, D> = SVector::from_fn(|k, _| step[SHIFT + k]);
        let about = turning * (self.motion.isometry.translation.vector - self.pivot) * scale
            + self.pivot
            + shift;
        let turned = turning * self.motion.isometry.rotation;
        Some((Motion::from_parts(about.into(), turned, self.motion.scaling() * scale), length))
    }

    /// ln of the volume that the parameters keep open, in rad, cm and ln scale: ½ ln |2π Λ⁻¹|.
    pub(crate) fn log_volume(&self) -> f64 {
        let count = (Euclid::<D>::TURNS + D + usize::from(self.scaled)) as f64;
        let Some(factor) = self.information.cholesky() else { return f64::INFINITY };
        let half_determinant: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        0.5 * count * std::f64::consts::TAU.ln() - half_determinant
    }

    /// Deviation of the parameters about the pivot: of turning in rad and of shift in cm, the greatest of each.
    pub(crate) fn deviations(&self) -> Option<(f64, f64)> {
        let covariance = self.information.cholesky()?.inverse();
        let most = |range: std::ops::Range<usize>| {
            range.map(|k| covariance[(k, k)]).fold(0.0, f64::max).sqrt()
        };
        let turn = most(0..Euclid::<D>::TURNS);
        let scale = if self.scaled { covariance[(SCALE, SCALE)].sqrt() } else { 0.0 };
        Some((turn.hypot(scale), most(SHIFT..SHIFT + D)))
    }
}

/// Λ of nothing known, with what is not fitted held.
fn blank<const D: usize>(scaled: bool) -> Information
where
    Euclid<D>: Space<D>,
{
    let mut information = Information::zeros();
    for k in (Euclid::<D>::TURNS..3).chain(SHIFT + D..SCALE) {
        information[(k, k)] = 1.0;
    }
    if !scaled {
        information[(SCALE, SCALE)] = 1.0;
    }
    information
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_carried_in_the_plane_and_in_space() {
        let plane =
            Motion::<2>::from_parts(Vector2::new(3.0, -7.0).into(), Rotation2::new(2.9), 1.7);
        let points = [Vector2::new(0.0, 0.0), Vector2::new(10.0, 0.0), Vector2::new(4.0, 9.0)];
        let pairs = points.map(|p| (p, plane.transform_point(&p.into()).coords));
        let found = carry(&pairs, true).expect("points apart");
        for (p, q) in &pairs {
            assert!((found.transform_point(&(*p).into()).coords - q).norm() < 1e-9);
        }
        let turned = Rotation3::new(Vector3::new(0.4, -2.0, 1.0));
        let space = Motion::<3>::from_parts(Vector3::new(1.0, 2.0, 3.0).into(), turned, 1.0);
        // All in one plane of space: a reflection would fit as well.
        let flat = [
            Vector3::new(0.0, 0.0, 0.0),
            Vector3::new(10.0, 0.0, 0.0),
            Vector3::new(4.0, 9.0, 0.0),
        ];
        let pairs = flat.map(|p| (p, space.transform_point(&p.into()).coords));
        let found = carry(&pairs, false).expect("points apart");
        assert!((found.isometry.rotation.matrix().determinant() - 1.0).abs() < 1e-9);
        assert!(
            (found.transform_point(&Vector3::new(1.0, 1.0, 5.0).into())
                - space.transform_point(&Vector3::new(1.0, 1.0, 5.0).into()))
            .norm()
                < 1e-9
        );
    }

    #[test]
    fn residuals_refine_a_motion() {
        let truth =
            Motion::<2>::from_parts(Vector2::new(30.0, -7.0).into(), Rotation2::new(0.5), 1.0);
        let guess =
            Motion::<2>::from_parts(Vector2::new(26.0, -3.0).into(), Rotation2::new(0.4), 1.0);
        let seen = [
            Segment::given(Vector2::new(0.0, 0.0), Vector2::new(100.0, 0.0), 1.0),
            Segment::given(Vector2::new(100.0, 0.0), Vector2::new(120.0, 80.0), 1.0),
        ];
        let mut motion = guess;
        for _ in 0..4 {
            let mut fit = Fit::new(motion, Vector2::new(50.0, 50.0), false);
            for segment in &seen {
                let moved = segment.moved(&motion);
                let residual =
                    Residual::between(&moved, &segment.moved(&truth)).expect("they overlap");
                fit.add(&moved, &residual);
            }
            motion = fit.step().expect("two segments hold a motion").0;
        }
        assert!((motion.isometry.rotation.angle() - 0.5).abs() < 1e-9);
        assert!(
            (motion.isometry.translation.vector - truth.isometry.translation.vector).norm() < 1e-7
        );
    }
}
