//! Several views of one thing, joined into one model (SPEC V6; paper 3, section 2).
//!
//! μ̄₂ = μ₂ ∪ gμ₁ and μ̄₁ = μ₁ ∪ g⁻¹μ₂, hence gμ̄₁ = μ̄₂: joining treats both sides alike. Segments that are equal
//! (V11) become one, each weighted by what it knows: across by both, at an end by whoever saw that end.

use nalgebra::{SMatrix, SVector};

use crate::{Covariance, End, Equality, Membership, Model, Motion, Segment, equality::UNMEASURED};

impl<const D: usize> Model<D> {
    /// What two views in one frame show together.
    #[must_use]
    pub fn united(&self, other: &Self, equality: &Equality) -> Self {
        let known = |model: &Self| {
            let counts = (0..model.len()).map(|k| model.membership(k));
            model.segments().iter().copied().zip(counts).collect::<Vec<_>>()
        };
        let mut pool = known(self);
        pool.extend(known(other));
        fuse_all(&mut pool, 1, equality);
        let segments: Vec<_> = pool.iter().map(|&(segment, _)| segment).collect();
        let ordered = crate::contour::order(&segments);
        let membership = ordered.iter().map(|&(k, _)| pool[k].1).collect();
        Self::with_membership(ordered.into_iter().map(|(_, segment)| segment).collect(), membership)
    }

    /// The refined models at both places, (μ̄₁, μ̄₂), when `self` is seen at the first and `other` at the second and
    /// `motion` is the paper's g: what the first place sees, as it lies before the second.
    #[must_use]
    pub fn synthesised(
        &self,
        motion: &Motion<D>,
        other: &Self,
        equality: &Equality,
    ) -> (Self, Self) {
        let first = self.united(&other.moved(&motion.inverse()), equality);
        let second = other.united(&self.moved(motion), equality);
        (first, second)
    }
}

/// Segments that are known, none of them equal to another, fused with those seen; in no order.
pub(crate) fn fused<const D: usize>(
    known: Vec<Segment<D>>,
    seen: Vec<Segment<D>>,
    equality: &Equality,
) -> Vec<Segment<D>> {
    let from = known.len();
    let all = known.into_iter().chain(seen);
    let mut pool: Vec<_> = all.map(|segment| (segment, Membership::default())).collect();
    fuse_all(&mut pool, from.max(1), equality);
    pool.into_iter().map(|(segment, _)| segment).collect()
}

/// Fuses equal segments, the most alike first, until none is left; several pieces of one face thus become one. Those
/// before `from` are known not to be equal.
fn fuse_all<const D: usize>(
    pool: &mut Vec<(Segment<D>, Membership)>,
    from: usize,
    equality: &Equality,
) {
    let mut alive: Vec<bool> = vec![true; pool.len()];
    let mut candidates = Vec::new();
    let compare = |pool: &[(Segment<D>, Membership)],
                   i: usize,
                   j: usize,
                   out: &mut Vec<(f64, usize, usize, bool)>| {
        if apart(&pool[i].0, &pool[j].0) {
            return;
        }
        if let Some(found) = equality.equal(&pool[i].0, &pool[j].0) {
            out.push((found.residual.squared(), i, j, found.reversed));
        }
    };
    for j in from..pool.len() {
        for i in 0..j {
            compare(pool, i, j, &mut candidates);
        }
    }
    while let Some(best) =
        (0..candidates.len()).min_by(|&p, &q| candidates[p].0.total_cmp(&candidates[q].0))
    {
        let (_, i, j, reversed) = candidates[best];
        let second = if reversed { pool[j].0.reversed() } else { pool[j].0 };
        let membership = pool[i].1.with(pool[j].1);
        let fused = pool[i].0.fused(&second);
        candidates.retain(|c| ![c.1, c.2].iter().any(|k| [i, j].contains(k)));
        alive[i] = false;
        alive[j] = false;
        // What cannot be weighed stays as it was first seen.
        pool.push((fused.unwrap_or(pool[i].0), membership));
        alive.push(true);
        let new = pool.len() - 1;
        for k in (0..new).filter(|&k| alive[k]) {
            compare(pool, k, new, &mut candidates);
        }
    }
    let mut keep = alive.into_iter();
    pool.retain(|_| keep.next().unwrap_or(false));
}

/// Whether two segments are too far from one another to be worth a comparison.
pub(crate) fn apart<const D: usize>(a: &Segment<D>, b: &Segment<D>) -> bool {
    let slack = 10.0 * (a.covariance.deviation() + b.covariance.deviation()) + 1.0;
    (0..D).any(|k| {
        let (al, ah) = (a.start[k].min(a.end[k]), a.start[k].max(a.end[k]));
        let (bl, bh) = (b.start[k].min(b.end[k]), b.start[k].max(b.end[k]));
        al > bh + slack || bl > ah + slack
    })
}

/// Which of two segments tells where an end is.
#[derive(Clone, Copy)]
enum Teller {
    Both,
    First,
    Second,
}

impl<const D: usize> Segment<D> {
    /// One segment of two that are equal, start to start; symmetric in both.
    ///
    /// `None` where the two say nothing together (a point, or a covariance that cannot be inverted).
    #[must_use]
    pub fn fused(&self, other: &Self) -> Option<Self> {
        let u = (self.vector() + other.vector()).try_normalize(1e-9)?;
        let (start, start_end) = self.teller(other, 0, &u);
        let (end, end_end) = self.teller(other, 1, &u);
        let a = self.told([start, end], other, &u, true)?;
        let b = other.told([start, end], self, &u, false)?;
        let total = Joint {
            start: a.1.start + b.1.start,
            end: a.1.end + b.1.end,
            cross: a.1.cross + b.1.cross,
        };
        let covariance = total.inverse()?;
        let weigh = |known: &([SVector<f64, D>; 2], Joint<D>)| {
            let (x, w) = known;
            [w.start * x[0] + w.cross * x[1], w.cross.transpose() * x[0] + w.end * x[1]]
        };
        let (p, q) = (weigh(&a), weigh(&b));
        let sum = [p[0] + q[0], p[1] + q[1]];
        Some(Self {
            start: covariance.start * sum[0] + covariance.cross * sum[1],
            end: covariance.cross.transpose() * sum[0] + covariance.end * sum[1],
            ends: [start_end, end_end],
            covariance,
        })
    }

    /// Who tells where the end at `side` is, and what that end then is: a true end before a cut one, of two cut ones
    /// that which was seen further out.
    fn teller(&self, other: &Self, side: usize, u: &SVector<f64, D>) -> (Teller, End) {
        let [p, q] = [self, other].map(|s| if side == 0 { -s.start.dot(u) } else { s.end.dot(u) });
        match (self.ends[side].is_true(), other.ends[side].is_true()) {
            // The same whichever is asked first: a corner says more than a free end, that more than a given one.
            (true, true) => (
                Teller::Both,
                if rank(self.ends[side]) <= rank(other.ends[side]) {
                    self.ends[side]
                } else {
                    other.ends[side]
                },
            ),
            (true, false) => (Teller::First, self.ends[side]),
            (false, true) => (Teller::Second, other.ends[side]),
            (false, false) if p >= q => (Teller::First, self.ends[side]),
            (false, false) => (Teller::Second, other.ends[side]),
        }
    }

    /// What this segment knows of the points at which the fused one ends, as points and information.
    fn told(
        &self,
        tellers: [Teller; 2],
        other: &Self,
        u: &SVector<f64, D>,
        first: bool,
    ) -> Option<([SVector<f64, D>; 2], Joint<D>)> {
        let length = self.vector().dot(u);
        let own = |t: Teller| {
            matches!(
                (t, first),
                (Teller::Both, _) | (Teller::First, true) | (Teller::Second, false)
            )
        };
        let theirs = [other.start, other.end];
        // Where on this segment's line the two points lie, as a share of its length.
        let at: [f64; 2] = std::array::from_fn(|side| {
            if own(tellers[side]) {
                side as f64
            } else {
                (theirs[side] - self.start).dot(u) / length
            }
        });
        if !at.iter().all(|t| t.is_finite()) {
            return None;
        }
        let c = &self.covariance;
        let between = |p: f64, q: f64| {
            c.start * ((1.0 - p) * (1.0 - q))
                + c.end * (p * q)
                + c.cross * ((1.0 - p) * q)
                + c.cross.transpose() * (p * (1.0 - q))
        };
        let mut known = Covariance {
            start: between(at[0], at[0]) + SMatrix::identity() * 1e-6,
            end: between(at[1], at[1]) + SMatrix::identity() * 1e-6,
            cross: between(at[0], at[1]),
        };
        let open = u * u.transpose() * UNMEASURED;
        if !own(tellers[0]) {
            known.start += open;
        }
        if !own(tellers[1]) {
            known.end += open;
        }
        let points = at.map(|t| self.start + self.vector() * t);
        Some((points, known.inverse()?))
    }
}

/// A 2n × 2n symmetric matrix in blocks: covariance or its inverse.
type Joint<const D: usize> = Covariance<D>;

impl<const D: usize> Covariance<D> {
    /// R⁻¹ in the same blocks, or R from R⁻¹; `None` when singular.
    pub(crate) fn inverse(&self) -> Option<Self> {
        let first = self.start.try_inverse()?;
        let gain = self.cross.transpose() * first;
        let second = (self.end - gain * self.cross).try_inverse()?;
        let start = first + gain.transpose() * second * gain;
        let cross = -(first * self.cross * second);
        let symmetric = |m: SMatrix<f64, D, D>| (m + m.transpose()) * 0.5;
        Some(Self { start: symmetric(start), end: symmetric(second), cross })
    }
}

/// Which of two true ends says more of itself.
const fn rank(end: End) -> u8 {
    match end {
        End::True(crate::Truth::Corner) => 0,
        End::True(crate::Truth::Free) => 1,
        End::True(crate::Truth::Given) => 2,
        End::Cut(_) => 3,
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation2, Vector2};
    use proptest::prelude::*;

    use super::*;
    use crate::Cut;

    fn ring(radii: &[f64]) -> Vec<Segment<2>> {
        let corner = |k: usize| {
            let angle = k as f64 / radii.len() as f64 * std::f64::consts::TAU;
            Vector2::new(angle.cos(), angle.sin()) * radii[k % radii.len()]
        };
        (0..radii.len()).map(|k| Segment::given(corner(k), corner(k + 1), 1.0)).collect()
    }

    proptest! {
        /// g μ̄₁ = μ̄₂, whichever was turned, with noise and with ends cut at the rim of either view.
        #[test]
        fn both_places_see_the_same_model(
            radii in prop::collection::vec(150.0..400.0, 8..16), seed in any::<u64>(),
            angle in -3.1..3.1, x in -500.0..500.0, y in -500.0..500.0,
        ) {
            let mut rng = fastrand::Rng::with_seed(seed);
            let truth = ring(&radii);
            let motion = Motion::<2>::from_parts(Vector2::new(x, y).into(), Rotation2::new(angle), 1.0);
            let half = truth.len() / 2;
            let mut view = |from: usize, to: usize| {
                let mut part: Vec<Segment<2>> = truth[from..to].to_vec();
                for s in &mut part {
                    s.start += Vector2::new(rng.f64() - 0.5, rng.f64() - 0.5);
                    s.end += Vector2::new(rng.f64() - 0.5, rng.f64() - 0.5);
                }
                let last = part.len() - 1;
                part[0].start = part[0].start * 0.6 + part[0].end * 0.4;
                part[0].ends[0] = End::Cut(Cut::Field);
                part[last].end = part[last].end * 0.6 + part[last].start * 0.4;
                part[last].ends[1] = End::Cut(Cut::Field);
                Model::of_contour(part)
            };
            let first = view(0, half + 2);
            let second = view(half - 2, truth.len()).moved(&motion);
            let equality = Equality::at(0.999);
            let (one, two) = first.synthesised(&motion, &second, &equality);
            prop_assert_eq!(one.len(), two.len());
            prop_assert_eq!(one.len(), truth.len(), "four segments are seen twice");
            let turned = one.moved(&motion);
            for s in turned.segments() {
                let same = two.segments().iter().any(|t| {
                    let near = |p: Vector2<f64>, q: Vector2<f64>| (p - q).norm() < 1e-5;
                    (near(s.start, t.start) && near(s.end, t.end)) || (near(s.start, t.end) && near(s.end, t.start))
                });
                prop_assert!(same, "{s:?} in {two:?}");
            }
        }
    }

    #[test]
    fn pieces_of_a_wall_become_one_wall() {
        let at = |a: f64, b: f64, ends: [bool; 2]| {
            let mut s = Segment::given(Vector2::new(a, 0.0), Vector2::new(b, 0.0), 1.0);
            for (end, known) in s.ends.iter_mut().zip(ends) {
                if !known {
                    *end = End::Cut(Cut::Occluded);
                }
            }
            s
        };
        let first = Model::of_contour(vec![
            at(0.0, 100.0, [true, false]),
            at(200.0, 300.0, [false, false]),
        ]);
        let second = Model::of_contour(vec![at(80.0, 400.0, [false, true])]);
        let whole = first.united(&second, &Equality::at(0.99));
        assert_eq!(whole.len(), 1);
        let wall = whole.segments()[0];
        assert!(wall.is_whole());
        assert!((wall.length() - 400.0).abs() < 1e-6);
        assert_eq!(whole.membership(0).seen, 3);
        let sum = second.united(&first, &Equality::at(0.99));
        assert!((sum.segments()[0].length() - 400.0).abs() < 1e-6);
    }

    #[test]
    fn what_is_seen_twice_is_known_better() {
        let a = Segment::given(Vector2::new(0.0, 0.0), Vector2::new(100.0, 0.0), 2.0);
        let mut b = Segment::given(Vector2::new(1.0, 1.0), Vector2::new(60.0, 1.0), 2.0);
        b.ends[1] = End::Cut(Cut::Range);
        let one = a.fused(&b).expect("they overlap");
        // Across: the line y(x) through 0, 0 at x = 0, 100 and 1, 1 at x = 0, 60, by least squares.
        assert!((one.start - Vector2::new(0.5, 0.611)).norm() < 0.02);
        assert!((one.end - Vector2::new(100.0, 0.333)).norm() < 0.02, "only the first saw the end");
        assert!(one.covariance.start[(0, 0)] < 2.1 && one.covariance.start[(1, 1)] < 2.1);
        assert!(
            (one.covariance.end[(0, 0)] - 4.0).abs() < 1e-3 && one.covariance.end[(1, 1)] < 4.0
        );
    }
}
