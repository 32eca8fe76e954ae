//! Sets of segments that moved rigidly, each by itself (SPEC V18; paper 3, section 4: S₁ and S₂ of fig. 2).
//!
//! Motions are added one by one, each the one that explains most of what those before leave unexplained, as long as
//! the gain is more than chance would give among all runs of the contour. Then each segment goes where it fits best,
//! with a preference for its neighbours' part, and every motion is fitted again.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::{
    Equality, Euclid, Motion, Residual, Segment, Space,
    motion::{Fit, motion_of},
};

/// Chance that a thing which moved as one is taken apart.
const FALSE_SPLIT: f64 = 0.003;
/// A residual beyond which it is all the same: the segment is elsewhere.
const CAP: f64 = 100.0;
/// Price of a border between two neighbours, as a squared distance.
const BORDER: f64 = 4.0;
/// Parts that one thing falls into at one step.
const MOST: usize = 8;
/// Candidate motions looked at per part.
const CANDIDATES: usize = 96;

/// Segments that moved as one.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidPart<const D: usize> {
    /// Positions in the list of pairs, ascending.
    pub members: Vec<usize>,
    /// From before to after.
    pub motion: Motion<D>,
}

/// The parts of a thing, the greatest first: `pairs` are its segments before and after, start to start, `next` the
/// position of each one's neighbour on the contour, `guess` how it is thought to have moved.
///
/// What fits no motion (a wrong correspondence) is in no part.
#[must_use]
pub fn rigid_parts<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    next: &[Option<usize>],
    guess: &Motion<D>,
    equality: &Equality,
) -> Vec<RigidPart<D>>
where
    Euclid<D>: Space<D>,
{
    let all: Vec<usize> = (0..pairs.len()).collect();
    if pairs.is_empty() {
        return Vec::new();
    }
    // Most often nothing, or all of it, moved.
    if let Some(motion) = fitted(pairs, &all, guess) {
        let residuals = squared(pairs, &motion);
        let sum: f64 = residuals.iter().map(|r| r.0).sum();
        let freedom: u32 =
            residuals.iter().map(|r| r.1).sum::<u32>().saturating_sub(parameters::<D>()).max(1);
        let usual =
            ChiSquared::new(f64::from(freedom)).is_ok_and(|law| sum <= law.inverse_cdf(0.95));
        let worst = residuals.iter().map(|r| r.0).fold(0.0, f64::max);
        if usual && worst <= equality.radius(2 * D as u32).powi(2) {
            return vec![RigidPart { members: all, motion }];
        }
    }
    let motions = split(pairs, next, guess);
    gather(pairs, next, motions, equality)
}

const fn parameters<const D: usize>() -> u32 {
    if D == 2 { 3 } else { 6 }
}

/// Squared distance of every pair under a motion, at most [`CAP`], and its degrees of freedom.
fn squared<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    motion: &Motion<D>,
) -> Vec<(f64, u32)> {
    let one = |(before, after): &(Segment<D>, Segment<D>)| {
        let residual = Residual::between(&before.moved(motion), after);
        residual.map_or((CAP, 2 * D as u32), |r| (r.squared().min(CAP), r.freedom))
    };
    pairs.iter().map(one).collect()
}

/// The motion of some pairs together, from a first one.
fn fitted<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    members: &[usize],
    from: &Motion<D>,
) -> Option<Motion<D>>
where
    Euclid<D>: Space<D>,
{
    let mut motion = *from;
    for _ in 0..4 {
        let middle = members.iter().map(|&k| pairs[k].1.at(0.5)).sum::<nalgebra::SVector<f64, D>>();
        let mut fit = Fit::new(motion, middle / members.len().max(1) as f64, false);
        for &k in members {
            let moved = pairs[k].0.moved(&motion);
            if let Some(residual) = Residual::between(&moved, &pairs[k].1) {
                fit.add(&moved, &residual);
            }
        }
        let (next, step) = fit.step()?;
        motion = next;
        if step < 0.01 {
            break;
        }
    }
    Some(motion)
}

/// Motions that together explain the pairs, the one that explains most first.
fn split<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    next: &[Option<usize>],
    guess: &Motion<D>,
) -> Vec<Motion<D>>
where
    Euclid<D>: Space<D>,
{
    let count = pairs.len();
    let runs = (count * (count + 1) / 2) as f64;
    let law = ChiSquared::new(f64::from(parameters::<D>())).expect("a motion has parameters");
    let least = law.inverse_cdf(1.0 - FALSE_SPLIT / runs);
    let mut left = vec![CAP; count];
    let mut motions: Vec<Motion<D>> = Vec::new();
    while motions.len() < MOST {
        let gain = |motion: &Motion<D>| -> f64 {
            squared(pairs, motion).iter().zip(&left).map(|(r, l)| (l - r.0).max(0.0)).sum()
        };
        let mut candidates = candidates(pairs, next, &left);
        if motions.is_empty() {
            candidates.push(*guess);
        }
        let best = candidates.into_iter().map(|m| (gain(&m), m)).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, mut motion)) = best else { break };
        // What it explains better than those before, it is fitted to.
        for _ in 0..3 {
            let own: Vec<usize> = squared(pairs, &motion)
                .iter()
                .enumerate()
                .filter(|(k, r)| r.0 < left[*k])
                .map(|(k, _)| k)
                .collect();
            let Some(better) = fitted(pairs, &own, &motion).filter(|m| gain(m) >= gain(&motion))
            else {
                break;
            };
            motion = better;
        }
        if !motions.is_empty() && gain(&motion) < least {
            break;
        }
        for (l, r) in left.iter_mut().zip(squared(pairs, &motion)) {
            *l = l.min(r.0);
        }
        motions.push(motion);
    }
    motions
}

/// Motions that single segments, two and three neighbours ask for; those that are explained worst first.
fn candidates<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    next: &[Option<usize>],
    left: &[f64],
) -> Vec<Motion<D>>
where
    Euclid<D>: Space<D>,
{
    let mut order: Vec<usize> =
        (0..pairs.len()).filter(|&k| left[k] > f64::from(2 * D as u32 - 2)).collect();
    order.sort_by(|&a, &b| left[b].total_cmp(&left[a]));
    // Evenly among those that are explained equally badly.
    let stride = order.len().div_ceil(CANDIDATES / 3).max(1);
    let mut found = Vec::with_capacity(CANDIDATES);
    for &k in order.iter().step_by(stride) {
        let mut run = vec![pairs[k]];
        let mut at = k;
        for size in 1..=3 {
            // In space one segment leaves the turning about itself open.
            if size >= D - 1 {
                found.extend(motion_of(&run, false));
            }
            match next[at].filter(|&n| n != k) {
                Some(n) => at = n,
                None => break,
            }
            run.push(pairs[at]);
        }
    }
    found
}

/// Each pair to the motion under which it fits, neighbours together; motions fitted again.
fn gather<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    next: &[Option<usize>],
    mut motions: Vec<Motion<D>>,
    equality: &Equality,
) -> Vec<RigidPart<D>>
where
    Euclid<D>: Space<D>,
{
    let count = pairs.len();
    let mut previous = vec![None; count];
    for (k, n) in next.iter().enumerate() {
        if let Some(n) = n {
            previous[*n] = Some(k);
        }
    }
    let mut label = vec![0; count];
    for round in 0..4 {
        let costs: Vec<Vec<(f64, u32)>> = motions.iter().map(|m| squared(pairs, m)).collect();
        if round == 0 {
            for (k, l) in label.iter_mut().enumerate() {
                *l = (0..motions.len())
                    .min_by(|&a, &b| costs[a][k].0.total_cmp(&costs[b][k].0))
                    .unwrap_or(0);
            }
        }
        for _ in 0..3 {
            for k in 0..count {
                let price = |m: usize| {
                    let beside = [next[k], previous[k]]
                        .into_iter()
                        .flatten()
                        .filter(|&n| label[n] != m)
                        .count();
                    costs[m][k].0 + BORDER * beside as f64
                };
                label[k] =
                    (0..motions.len()).min_by(|&a, &b| price(a).total_cmp(&price(b))).unwrap_or(0);
            }
        }
        for (m, motion) in motions.iter_mut().enumerate() {
            let own: Vec<usize> =
                (0..count).filter(|&k| label[k] == m && costs[m][k].0 < CAP).collect();
            if let Some(better) = fitted(pairs, &own, motion) {
                *motion = better;
            }
        }
    }
    let mut parts: Vec<RigidPart<D>> = Vec::new();
    for (m, motion) in motions.into_iter().enumerate() {
        let own = squared(pairs, &motion);
        // Far beyond its errors a segment is not explained, only nearest.
        let fits = |k: usize| own[k].0 <= 2.0 * equality.radius(own[k].1).powi(2);
        let members: Vec<usize> = (0..count).filter(|&k| label[k] == m && fits(k)).collect();
        if !members.is_empty() {
            parts.push(RigidPart { members, motion });
        }
    }
    parts.sort_by_key(|part| std::cmp::Reverse(part.members.len()));
    parts
}
