//! A candidate transformation held against the full model: the view as a part of it (SPEC V19, V11, V9).
//!
//! Two segments give a first motion. The others are taken in from near to far, each with the error that the motion
//! so far has at its place, and each makes the motion surer; then all are held against the model once more, by V11
//! alone.

use nalgebra::SMatrix;

use super::{answer::Counters, link::Scale};
use crate::{
    Covariance, Equality, Euclid, Model, Motion, Residual, Segment, Space, Turn, motion::Fit,
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
        let (best, pairs) = self.place(motion, seeds, counters)?;
        let evidence = self.evidence(&best, &pairs);
        Some(Hypothesis { motion: best.motion, pairs, information: best.information, evidence })
    }

    /// The same, without weighing it: the motion, and what of the view is which part of the model.
    pub(super) fn place(
        &self,
        motion: Motion<D>,
        seeds: [Correspondence; 2],
        counters: &mut Counters,
    ) -> Option<(Fit<D>, Vec<Correspondence>)> {
        let (motion, mut pairs) = self.grow(motion, seeds, counters)?;
        let mut best = self.refine(motion, &pairs)?;
        // Until the same segments are found twice; the motion hardly moves any more.
        for _ in 0..3 {
            let found = self.matches(&best.motion, counters)?;
            let converged = found == pairs;
            pairs = found;
            if converged {
                break;
            }
            best = self.refine(best.motion, &pairs)?;
        }
        Some((best, pairs))
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
        let mut taken: Vec<Vec<(f64, f64)>> = vec![Vec::new(); self.model.len()];
        let mut pairs: Vec<Correspondence> = Vec::with_capacity(found.len());
        for (_, pair, (from, to)) in found {
            let on_it = &mut taken[pair.1];
            if !on_it.iter().any(|&(low, high)| to.min(high) > from.max(low)) {
                on_it.push((from, to));
                pairs.push(pair);
            }
        }
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
    /// Each segment is told from the one before it: where it begins, unless that one ends there; how it turns; how long it
    /// is. So a corner of two is told once, and what it errs too. Counted against itself: of foreign things nothing is
    /// known but that they are as large as these, as long, and as near to one another, and that walls stand at right
    /// angles everywhere: such a turn is worth no more than one in four.
    fn evidence(&self, fit: &Fit<D>, pairs: &[Correspondence]) -> f64 {
        let extent = self.model.extent().max(self.view.extent()).max(1.0);
        let surprise =
            |size: f64, sigma: f64| (size / (std::f64::consts::TAU.sqrt() * sigma)).ln().max(0.0);
        let across = (D - 1) as f64;
        let mut sum = 0.0;
        let mut before: Option<Segment<D>> = None;
        for &pair in pairs {
            let (k, stored) = (pair.0, self.stored(pair));
            let moved = self.view.segments()[k].moved(&fit.motion);
            let ends_here = |p: usize| {
                let met = pairs.binary_search_by_key(&p, |pair| pair.0).ok();
                met.is_some_and(|at| self.stored(pairs[at]).ends[1].is_true())
            };
            let is_met =
                self.view.previous(k).is_some_and(|p| self.view.is_joined(p) && ends_here(p));
            let residual = if is_met {
                Residual::of_end(&moved, &stored)
            } else {
                Residual::between(&moved, &stored)
            };
            let Some(residual) = residual else { continue };
            let sigma = moved.covariance.deviation().hypot(stored.covariance.deviation()).max(1e-3);
            let length = moved.length();
            // Where the view is cut, that it is cut just there says nothing for the thing.
            let told = [0, 1].map(|end| moved.ends[end].is_true() && stored.ends[end].is_true());
            if !is_met {
                let near =
                    before.map_or(extent, |b| extent.min(2.0 * (moved.start - b.end).norm()));
                sum += (across + f64::from(u8::from(told[0]))) * surprise(near, sigma);
            }
            let lean = std::f64::consts::SQRT_2 * sigma / length.max(1e-9);
            let turn = surprise(std::f64::consts::PI, lean);
            let square = before.and_then(|b| Turn::between(&b, &stored)).map_or(turn, |turn| {
                let quarters = turn.angle() / std::f64::consts::FRAC_PI_2;
                let off = (quarters - quarters.round()) * std::f64::consts::FRAC_PI_2 / lean;
                4.0_f64.ln() + 0.5 * off * off
            });
            sum += across * turn.min(square);
            if told[1] {
                sum += surprise(2.0 * stored.length(), sigma);
            }
            sum -= 0.5 * residual.squared();
            // Seen as often as it should be (V9), against a foreign segment that was as likely.
            sum += self.model.membership(pair.1).probability().ln();
            before = Some(stored);
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
