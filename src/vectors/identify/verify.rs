//! A candidate transformation held against the full model: the view as a part of it (SPEC V19, V11, V9).
//!
//! Two segments give a first motion. The others are taken in from near to far, each with the error that the motion
//! so far has at its place, and each makes the motion surer; then all are held against the model once more, by V11
//! alone.

use nalgebra::SMatrix;

use super::{answer::Counters, link::Scale};
use crate::{
    Covariance, Equality, Euclid, Model, Motion, Residual, Segment, Space, motion::Fit,
    motion::motion_of,
};

/// A view, a stored model, and what is asked of them.
pub(crate) struct Trial<'a, const D: usize> {
    pub(crate) view: &'a Model<D>,
    pub(crate) model: &'a Model<D>,
    pub(crate) equality: &'a Equality,
    pub(crate) scale: Scale,
    /// How many segments of the view may be foreign to the model.
    pub(crate) misses: usize,
}

/// Segment of the view, of the model, and whether they run against one another.
pub(crate) type Correspondence = (usize, usize, bool);

/// A motion under which enough of the view is in the model.
#[derive(Debug, Clone)]
pub(crate) struct Hypothesis<const D: usize> {
    pub(crate) motion: Motion<D>,
    pub(crate) pairs: Vec<Correspondence>,
    pub(crate) information: SMatrix<f64, 7, 7>,
    pub(crate) evidence: f64,
}

impl<const D: usize> Trial<'_, D>
where
    Euclid<D>: Space<D>,
{
    fn stored(&self, (_, k, reversed): Correspondence) -> Segment<D> {
        let segment = self.model.segments()[k];
        if reversed { segment.reversed() } else { segment }
    }

    /// The motion that two correspondences ask for: true ends upon true ends, directions upon directions.
    ///
    /// `None` where no two true ends say where along itself something lies.
    pub(crate) fn seed(&self, pairs: [Correspondence; 2]) -> Option<Motion<D>> {
        let told = pairs.map(|pair| (self.view.segments()[pair.0], self.stored(pair)));
        motion_of(&told, self.scale == Scale::Free)
    }

    /// Whether the view is a part of the model near a first motion that two correspondences gave.
    pub(crate) fn verify(
        &self,
        motion: Motion<D>,
        seeds: [Correspondence; 2],
        counters: &mut Counters,
    ) -> Option<Hypothesis<D>> {
        let (motion, mut pairs) = self.grow(motion, seeds, counters)?;
        let mut best = self.refine(motion, &pairs)?;
        // Until the same segments are found twice; the motion hardly moves any more.
        for _ in 0..3 {
            let found = self.matches(&best.motion, counters)?;
            let settled = found == pairs;
            pairs = found;
            if settled {
                break;
            }
            best = self.refine(best.motion, &pairs)?;
        }
        let evidence = self.evidence(&best, &pairs);
        Some(Hypothesis { motion: best.motion, pairs, information: best.information, evidence })
    }

    /// Takes in segments from near to far; `None` as soon as too many do not fit.
    fn grow(
        &self,
        motion: Motion<D>,
        seeds: [Correspondence; 2],
        counters: &mut Counters,
    ) -> Option<(Motion<D>, Vec<Correspondence>)> {
        let pivot =
            seeds.map(|pair| self.stored(pair).at(0.5)).iter().sum::<nalgebra::SVector<f64, D>>()
                * 0.5;
        let fit = self.fitted(motion, pivot, &seeds);
        let mut motion = fit.step()?.0;
        counters.segments += 2;
        for pair in seeds {
            let moved = self.view.segments()[pair.0].moved(&motion);
            if !self.equality.admits(&Residual::between(&moved, &self.stored(pair))?) {
                return None;
            }
        }
        let (mut turn, mut shift) = fit.deviations()?;
        let mut pairs = seeds.to_vec();
        let mut rest: Vec<(f64, usize)> = (0..self.view.len())
            .filter(|&k| seeds.iter().all(|s| s.0 != k))
            .map(|k| {
                (
                    (motion.transform_point(&self.view.segments()[k].at(0.5).into()).coords
                        - pivot)
                        .norm_squared(),
                    k,
                )
            })
            .collect();
        rest.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let (mut misses, mut fitted) = (0, pairs.len());
        for (_, k) in rest {
            let moved = self.view.segments()[k].moved(&motion);
            let Some((stored, reversed, _)) =
                self.nearest(&loosened(&moved, turn, shift, &pivot), counters)
            else {
                misses += 1;
                if misses > self.misses {
                    return None;
                }
                continue;
            };
            pairs.push((k, stored, reversed));
            // Each of the first ones turns the motion; later ones hardly do, a quarter more together.
            if pairs.len() < 8 || 4 * pairs.len() >= 5 * fitted {
                fitted = pairs.len();
                let fit = self.fitted(motion, pivot, &pairs);
                motion = fit.step()?.0;
                (turn, shift) = fit.deviations()?;
            }
        }
        pairs.sort_unstable();
        Some((motion, pairs))
    }

    /// The motion that fits the correspondences best, with its information there.
    fn refine(&self, motion: Motion<D>, pairs: &[Correspondence]) -> Option<Fit<D>> {
        let pivot =
            pairs.iter().map(|&p| self.stored(p).at(0.5)).sum::<nalgebra::SVector<f64, D>>()
                / pairs.len() as f64;
        let mut fit = self.fitted(motion, pivot, pairs);
        for _ in 0..5 {
            let (next, step) = fit.step()?;
            fit = self.fitted(next, pivot, pairs);
            // A hundredth of a deviation decides nothing.
            if step < 0.01 {
                break;
            }
        }
        Some(fit)
    }

    /// The residuals of correspondences about a motion.
    fn fitted(
        &self,
        motion: Motion<D>,
        pivot: nalgebra::SVector<f64, D>,
        pairs: &[Correspondence],
    ) -> Fit<D> {
        let mut fit = Fit::new(motion, pivot, self.scale == Scale::Free);
        for &pair in pairs {
            let moved = self.view.segments()[pair.0].moved(&motion);
            if let Some(residual) = Residual::between(&moved, &self.stored(pair)) {
                fit.add(&moved, &residual);
            }
        }
        fit
    }

    /// What of the view is in the model under a motion, by V11; `None` when too much is not.
    fn matches(&self, motion: &Motion<D>, counters: &mut Counters) -> Option<Vec<Correspondence>> {
        let mut found = Vec::with_capacity(self.view.len());
        for (k, segment) in self.view.segments().iter().enumerate() {
            let moved = segment.moved(motion);
            if let Some((stored, reversed, score)) = self.nearest(&moved, counters) {
                found.push((score, (k, stored, reversed), self.covered(&moved, stored)));
            }
        }
        // A face is seen once: of two segments on the same part of it the better one stays.
        found.sort_by(|p, q| p.0.total_cmp(&q.0));
        let mut kept: Vec<(Correspondence, (f64, f64))> = Vec::with_capacity(found.len());
        for (_, pair, (from, to)) in found {
            let twice = |&(other, (low, high)): &(Correspondence, (f64, f64))| {
                other.1 == pair.1 && to.min(high) > from.max(low)
            };
            if !kept.iter().any(twice) {
                kept.push((pair, (from, to)));
            }
        }
        let mut pairs: Vec<Correspondence> = kept.into_iter().map(|(pair, _)| pair).collect();
        pairs.sort_unstable();
        (pairs.len() + self.misses >= self.view.len() && pairs.len() >= 2).then_some(pairs)
    }

    /// The part of a stored segment that a moved one covers, in cm along it: a whole one all of it, a piece what was
    /// seen, less its error.
    fn covered(&self, moved: &Segment<D>, stored: usize) -> (f64, f64) {
        let segment = &self.model.segments()[stored];
        let u = segment.vector().try_normalize(1e-9);
        let Some(u) = u.filter(|_| !moved.is_whole()) else {
            return (f64::NEG_INFINITY, f64::INFINITY);
        };
        let (p, q) = ((moved.start - segment.start).dot(&u), (moved.end - segment.start).dot(&u));
        let error = 4.0 * moved.covariance.deviation().hypot(segment.covariance.deviation());
        (p.min(q) + error, p.max(q) - error)
    }

    /// The stored segment that a moved one is a view of.
    pub(super) fn nearest(
        &self,
        moved: &Segment<D>,
        counters: &mut Counters,
    ) -> Option<(usize, bool, f64)> {
        let reach = self.equality.radius(2 * D as u32)
            * (moved.covariance.deviation() + self.model.deviation());
        let mut near = Vec::new();
        self.model.places().near(&moved.at(0.5), reach, &mut near);
        if !self.model.is_whole() {
            // Of a face that was stored in part, other parts may be seen.
            self.model.places().near(&moved.start, reach, &mut near);
            self.model.places().near(&moved.end, reach, &mut near);
        }
        let mut best: Option<(usize, bool, f64)> = None;
        for k in near {
            let stored = self.model.segments()[k as usize];
            counters.segments += 1;
            let reversed = moved.vector().dot(&stored.vector()) < 0.0;
            let stored = if reversed { stored.reversed() } else { stored };
            let Some(residual) = Residual::between(moved, &stored) else { continue };
            // By its density: a face that fits to its ends is before one that merely goes on.
            let score = -residual.log_density();
            if self.equality.admits(&residual) && best.is_none_or(|b| score < b.2) {
                best = Some((k as usize, reversed, score));
            }
        }
        best
    }

    /// ln of how much more likely the view is as a part of this model, placed anywhere, than as anything (Bayes, the
    /// integral over motions by Laplace).
    ///
    /// Counted against itself: of where a foreign wall stands nothing is known, but walls stand at right angles
    /// everywhere, so a turn is worth no more than one in four. A corner is where two lines meet: once both are
    /// counted, its place says nothing more.
    fn evidence(&self, fit: &Fit<D>, pairs: &[Correspondence]) -> f64 {
        let extent = self.model.extent().max(self.view.extent()).max(1.0);
        let of_view: Vec<Option<usize>> = {
            let mut known = vec![None; self.view.len()];
            for &(k, stored, _) in pairs {
                known[k] = Some(stored);
            }
            known
        };
        let root = std::f64::consts::TAU.sqrt();
        let mut sum = 0.0;
        for &pair in pairs {
            let (k, stored) = (pair.0, self.stored(pair));
            let moved = self.view.segments()[k].moved(&fit.motion);
            let Some(residual) = Residual::between(&moved, &stored) else { continue };
            let sigma = moved.covariance.deviation().hypot(stored.covariance.deviation()).max(1e-3);
            let across = (D - 1) as f64;
            sum += across * (extent / (root * sigma)).ln().max(0.0);
            let turn =
                std::f64::consts::PI * moved.length() / (root * std::f64::consts::SQRT_2 * sigma);
            sum += across * turn.ln().clamp(0.0, 4.0_f64.ln());
            let before = self.view.previous(k).filter(|&p| self.view.is_joined(p));
            let after = self.view.next(k).filter(|_| self.view.is_joined(k));
            let met =
                [before, after].map(|other| other.is_some_and(|other| of_view[other].is_some()));
            for (compared, met) in residual.compared.iter().zip(met) {
                if *compared && !met {
                    sum += (2.0 * stored.length() / (root * sigma)).ln().max(0.0);
                }
            }
            sum -= 0.5 * residual.squared();
            // Seen as often as it should be (V9), against a foreign segment that was as likely.
            sum += self.model.membership(pair.1).probability().ln();
        }
        // What is not explained was foreign: one in twenty is.
        sum += (self.view.len() - pairs.len()) as f64 * 0.05_f64.ln();
        let turns = if D == 2 {
            std::f64::consts::TAU
        } else {
            8.0 * std::f64::consts::PI * std::f64::consts::PI
        };
        let scales = if self.scale == Scale::Free { 100.0_f64.ln() } else { 1.0 };
        let prior = (extent.powi(D as i32) * turns * scales).ln();
        sum + (fit.log_volume() - prior).min(0.0)
    }
}

/// A segment with the error that the motion still has at its place.
fn loosened<const D: usize>(
    segment: &Segment<D>,
    turn: f64,
    shift: f64,
    pivot: &nalgebra::SVector<f64, D>,
) -> Segment<D> {
    let one = SMatrix::<f64, D, D>::identity();
    let at = |p: &nalgebra::SVector<f64, D>| {
        one * (shift * shift + turn * turn * (p - pivot).norm_squared())
    };
    let c = segment.covariance;
    let covariance = Covariance {
        start: c.start + at(&segment.start),
        end: c.end + at(&segment.end),
        cross: c.cross + one * (shift * shift),
    };
    Segment { covariance, ..*segment }
}
