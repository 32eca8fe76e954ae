//! Sets of segments that moved rigidly, each by itself (SPEC V18; paper 3, section 4: S₁ and S₂ of fig. 2).
//!
//! Motions are added one by one, each the one that explains most of what those before leave unexplained, as long as
//! the gain is more than chance would give among all runs of the contour. Each segment goes where it fits best, a border
//! between neighbours having its price, and every motion is fitted to its own.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::{
    Equality, Euclid, Motion, Residual, Segment, Space,
    motion::{Fit, motion_of},
};

/// Chance that a thing which moved as one is taken apart, as far as its errors are what they are said to be.
const FALSE_SPLIT: f64 = 0.001;
/// A squared distance beyond which it is all the same: the segment is elsewhere.
const CAP: f64 = 36.0;
/// A squared distance within which a segment may belong to a motion that is still being fitted.
const OWN: f64 = 20.0;
/// A squared distance, per coordinate, from which on a segment is poorly explained: one in twenty by chance.
const POOR: f64 = 2.4;
/// Parts that one thing falls into at one step.
const MOST: usize = 8;
/// Segments by which candidate motions are ranked, and how many of these are then held against all.
const SAMPLE: usize = 20;
const FINALISTS: usize = 6;
/// Candidate motions looked at per part.
const CANDIDATES: usize = 48;

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
    if pairs.is_empty() {
        return Vec::new();
    }
    let one = first(pairs, next, guess);
    // Most often nothing, or all of it, moved.
    let split = if is_usual(pairs, &one, equality) { one } else { split(pairs, next, one) };
    parts_of(pairs, split, equality)
}

/// Whether one motion explains all pairs as well as errors let it.
fn is_usual<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    one: &Split<D>,
    equality: &Equality,
) -> bool {
    let sum: f64 = one.squared.iter().sum();
    let measured: u32 = pairs.iter().map(|pair| distance(pair, &one.motions[0]).1).sum();
    let freedom = measured.saturating_sub(parameters::<D>()).max(1);
    let worst = one.squared.iter().copied().fold(0.0, f64::max);
    let law = ChiSquared::new(f64::from(freedom));
    worst <= equality.radius(2 * D as u32).powi(2) && law.is_ok_and(|law| law.cdf(sum) <= 0.95)
}

const fn parameters<const D: usize>() -> u32 {
    if D == 2 { 3 } else { 6 }
}

/// Squared distance of a pair under a motion, at most [`CAP`], and its degrees of freedom.
fn distance<const D: usize>(
    (before, after): &(Segment<D>, Segment<D>),
    motion: &Motion<D>,
) -> (f64, u32) {
    let residual = Residual::between(&before.moved(motion), after);
    residual.map_or((CAP, 2 * D as u32), |r| (r.squared().min(CAP), r.freedom))
}

/// Of every pair.
fn squared<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    motion: &Motion<D>,
) -> Vec<(f64, u32)> {
    pairs.iter().map(|pair| distance(pair, motion)).collect()
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
        // A tenth of a deviation decides nothing here.
        if step < 0.1 {
            break;
        }
    }
    Some(motion)
}

/// Motions, and which pair belongs to which.
struct Split<const D: usize> {
    motions: Vec<Motion<D>>,
    labels: Vec<usize>,
    /// Squared distance of each pair under its motion.
    squared: Vec<f64>,
    /// To which pairs each motion is fitted.
    fitted_to: Vec<Vec<usize>>,
}

/// Motions that together explain the pairs: one more as long as it explains more than chance would.
fn split<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    next: &[Option<usize>],
    one: Split<D>,
) -> Split<D>
where
    Euclid<D>: Space<D>,
{
    let count = pairs.len();
    let runs = (count * (count + 1) / 2) as f64;
    let law = ChiSquared::new(f64::from(parameters::<D>())).expect("a motion has parameters");
    let least = law.inverse_cdf(1.0 - FALSE_SPLIT / runs);
    let mut best = one;
    while best.motions.len() < MOST {
        // Where what is known explains well, little can be gained.
        let poor: Vec<usize> =
            (0..count).filter(|&k| best.squared[k] > POOR * (2 * D) as f64).collect();
        let gain_of = |k: usize, motion: &Motion<D>| {
            (best.squared[k] - distance(&pairs[k], motion).0).max(0.0)
        };
        let gain = |motion: &Motion<D>| -> f64 { poor.iter().map(|&k| gain_of(k, motion)).sum() };
        let found = foremost(candidates(pairs, next, &best.squared), &poor, gain_of);
        let Some(mut motion) = found else { break };
        // What it explains better than those before, it is fitted to.
        for _ in 0..3 {
            let own: Vec<usize> = poor
                .iter()
                .copied()
                .filter(|&k| distance(&pairs[k], &motion).0 < best.squared[k].min(OWN))
                .collect();
            let Some(next) = fitted(pairs, &own, &motion).filter(|m| gain(m) >= gain(&motion))
            else {
                break;
            };
            motion = next;
        }
        // Neighbours that it takes along, and the others' better fit, can add to that, but not so much.
        if gain(&motion) < 0.7 * least {
            break;
        }
        let mut motions = best.motions.clone();
        motions.push(motion);
        let more = alternate(pairs, next, motions, best.fitted_to.clone());
        let saved = best.squared.iter().sum::<f64>() - more.squared.iter().sum::<f64>();
        if saved < least {
            break;
        }
        best = more;
    }
    best
}

/// The motion that explains most: the guess, where it explains more than half, else the best of the candidates.
fn first<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    next: &[Option<usize>],
    guess: &Motion<D>,
) -> Split<D>
where
    Euclid<D>: Space<D>,
{
    let fitting = squared(pairs, guess).iter().filter(|r| r.0 < OWN).count();
    let mut motion = *guess;
    if 2 * fitting <= pairs.len() {
        let mut all = candidates(pairs, next, &vec![CAP; pairs.len()]);
        all.push(*guess);
        let every: Vec<usize> = (0..pairs.len()).collect();
        let explained = |k: usize, motion: &Motion<D>| CAP - distance(&pairs[k], motion).0;
        motion = foremost(all, &every, explained).unwrap_or(*guess);
    }
    alternate(pairs, next, vec![motion], Vec::new())
}

/// The motion that gains most of some pairs: of many, a few tell which are worth asking all of them.
fn foremost<const D: usize>(
    candidates: Vec<Motion<D>>,
    among: &[usize],
    gain: impl Fn(usize, &Motion<D>) -> f64,
) -> Option<Motion<D>> {
    let stride = among.len().div_ceil(SAMPLE).max(1);
    let of = |motion: &Motion<D>, stride: usize| -> f64 {
        among.iter().step_by(stride).map(|&k| gain(k, motion)).sum()
    };
    let mut ranked: Vec<(f64, Motion<D>)> =
        candidates.into_iter().map(|motion| (of(&motion, stride), motion)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    if stride > 1 {
        ranked.truncate(FINALISTS);
        ranked.iter_mut().for_each(|(sum, motion)| *sum = of(motion, 1));
    }
    ranked.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).map(|found| found.1)
}

/// Assigns pairs to motions and fits the motions to their pairs, in turn; `fitted_to` tells which already are.
fn alternate<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    next: &[Option<usize>],
    mut motions: Vec<Motion<D>>,
    mut fitted_to: Vec<Vec<usize>>,
) -> Split<D>
where
    Euclid<D>: Space<D>,
{
    let costs = |motions: &[Motion<D>]| -> Vec<Vec<f64>> {
        motions.iter().map(|m| squared(pairs, m).into_iter().map(|r| r.0).collect()).collect()
    };
    let mut now = costs(&motions);
    let mut labels = assign(&now, next);
    fitted_to.resize(motions.len(), Vec::new());
    // Assignment and fit both lower one sum, up to what the caps hide: it converges, or nearly.
    for _ in 0..6 {
        for (m, motion) in motions.iter_mut().enumerate() {
            let own: Vec<usize> =
                (0..pairs.len()).filter(|&k| labels[k] == m && now[m][k] < OWN).collect();
            if own == fitted_to[m] {
                continue;
            }
            if let Some(better) = fitted(pairs, &own, motion) {
                *motion = better;
                now[m] = squared(pairs, motion).into_iter().map(|r| r.0).collect();
            }
            fitted_to[m] = own;
        }
        let again = assign(&now, next);
        if again == labels {
            break;
        }
        labels = again;
    }
    let squared = labels.iter().enumerate().map(|(k, &m)| now[m][k]).collect();
    Split { motions, labels, squared, fitted_to }
}

/// The labels that cost least together, each border between neighbours priced: exact along every contour (Viterbi),
/// a ring walked twice.
fn assign(costs: &[Vec<f64>], next: &[Option<usize>]) -> Vec<usize> {
    let count = next.len();
    // Where a border runs is one choice among so many.
    let border = 2.0 * (count as f64).ln().max(1.0);
    let mut labels = vec![0; count];
    let mut done = vec![false; count];
    let mut is_next = vec![false; count];
    next.iter().flatten().for_each(|&n| is_next[n] = true);
    for first in (0..count).filter(|&k| !is_next[k]).chain(0..count) {
        if done[first] {
            continue;
        }
        let mut walk = vec![first];
        let mut at = first;
        while let Some(n) = next[at].filter(|&n| n != first && !done[n]) {
            done[at] = true;
            walk.push(n);
            at = n;
        }
        done[at] = true;
        let length = walk.len();
        let ring = next[at] == Some(first) && length > 2;
        if ring {
            walk.extend_from_within(..);
        }
        let chosen = viterbi(costs, &walk, border);
        // Of a ring's two rounds, the halves that have something on both sides.
        for (step, &k) in walk.iter().enumerate() {
            if !ring || (step >= length / 2 && step < length / 2 + length) {
                labels[k] = chosen[step];
            }
        }
    }
    labels
}

fn viterbi(costs: &[Vec<f64>], walk: &[usize], border: f64) -> Vec<usize> {
    let cheapest = |sums: &[f64]| {
        let best = sums.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
        best.map_or((0, 0.0), |(m, &sum)| (m, sum))
    };
    let mut sums: Vec<f64> = costs.iter().map(|c| c[walk[0]]).collect();
    let mut from: Vec<Vec<usize>> = Vec::with_capacity(walk.len());
    for &k in &walk[1..] {
        let (best, least) = cheapest(&sums);
        let step: Vec<usize> =
            (0..sums.len()).map(|m| if sums[m] <= least + border { m } else { best }).collect();
        sums = (0..sums.len()).map(|m| sums[m].min(least + border) + costs[m][k]).collect();
        from.push(step);
    }
    let mut label = cheapest(&sums).0;
    let mut labels = vec![label];
    for step in from.iter().rev() {
        label = step[label];
        labels.push(label);
    }
    labels.reverse();
    labels
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
        (0..pairs.len()).filter(|&k| left[k] > POOR * (2 * D) as f64).collect();
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

/// The parts of a split, without what is far beyond its errors: that is not explained, only nearest.
fn parts_of<const D: usize>(
    pairs: &[(Segment<D>, Segment<D>)],
    split: Split<D>,
    equality: &Equality,
) -> Vec<RigidPart<D>> {
    let mut parts: Vec<RigidPart<D>> = Vec::new();
    for (m, motion) in split.motions.into_iter().enumerate() {
        let own = squared(pairs, &motion);
        let fits = |k: usize| own[k].0 <= (1.5 * equality.radius(own[k].1).powi(2)).min(CAP - 1.0);
        let members: Vec<usize> =
            (0..pairs.len()).filter(|&k| split.labels[k] == m && fits(k)).collect();
        if !members.is_empty() {
            parts.push(RigidPart { members, motion });
        }
    }
    parts.sort_by_key(|part| std::cmp::Reverse(part.members.len()));
    parts
}
