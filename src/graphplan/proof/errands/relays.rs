//! An order of errands in which things may be put down on the way, to be taken on later: with the other hand full, or
//! nothing to be brought back, a thing left at a crossing may save a second walk to the far end of a corridor.
//!
//! Local search from an order without that: a leg is split where that wins most, in two that may stand anywhere in the
//! order, the first before the second; a leg is moved; what is put down and taken up at once is one leg again.

/// A thing carried without a halt, or a visit, which goes from a point to itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Leg {
    pub(super) errand: usize,
    pub(super) from: usize,
    pub(super) to: usize,
}

/// What putting a thing down and taking it up again costs.
const HALT: usize = 2;

/// More rounds than these win little.
const ROUNDS: usize = 40;

/// Legs in a good order. `halts` are, for each errand, points where its thing may be put down.
pub(super) fn relayed(distance: &[Vec<usize>], legs: Vec<Leg>, halts: &[Vec<usize>]) -> Vec<Leg> {
    let mut best = legs;
    let mut cost = length(distance, &best);
    for _ in 0..ROUNDS {
        let mut better: Option<(usize, Vec<Leg>)> = None;
        let mut offer = |legs: Vec<Leg>| {
            let legs = joined(legs);
            let least = better.as_ref().map_or(cost, |(least, _)| *least);
            let own = length(distance, &legs);
            if own < least && is_in_order(&legs, &best) {
                better = Some((own, legs));
            }
        };
        for at in 0..best.len() {
            let leg = best[at];
            let mut others = best.clone();
            others.remove(at);
            for to in (0..=others.len()).filter(|&to| to != at) {
                offer(with(&others, to, leg));
            }
            for &halt in &halts[leg.errand] {
                if halt == leg.from || halt == leg.to {
                    continue;
                }
                let (one, two) = (Leg { to: halt, ..leg }, Leg { from: halt, ..leg });
                for first in 0..=others.len() {
                    let begun = with(&others, first, one);
                    for second in first + 1..=begun.len() {
                        offer(with(&begun, second, two));
                    }
                }
            }
        }
        let Some((own, legs)) = better else { break };
        (cost, best) = (own, legs);
    }
    best
}

fn with(legs: &[Leg], at: usize, leg: Leg) -> Vec<Leg> {
    let mut all = Vec::with_capacity(legs.len() + 1);
    all.extend_from_slice(&legs[..at]);
    all.push(leg);
    all.extend_from_slice(&legs[at..]);
    all
}

/// What is put down and taken up at once is carried on.
fn joined(legs: Vec<Leg>) -> Vec<Leg> {
    let mut joined: Vec<Leg> = Vec::with_capacity(legs.len());
    for leg in legs {
        match joined.last_mut() {
            Some(last) if last.errand == leg.errand && last.to == leg.from => last.to = leg.to,
            _ => joined.push(leg),
        }
    }
    joined
}

/// Whether each thing is taken up where it was put down last, and first where it lies.
fn is_in_order(legs: &[Leg], before: &[Leg]) -> bool {
    legs.iter().enumerate().all(|(at, leg)| {
        let earlier = legs[..at].iter().rev().find(|other| other.errand == leg.errand);
        let lies = || before.iter().find(|other| other.errand == leg.errand).map(|o| o.from);
        earlier.map_or_else(lies, |other| Some(other.to)) == Some(leg.from)
    })
}

fn length(distance: &[Vec<usize>], legs: &[Leg]) -> usize {
    let mut at = 0;
    let walked: usize = legs
        .iter()
        .map(|leg| {
            let come = distance[at][leg.from];
            at = leg.to;
            come + distance[leg.from][leg.to]
        })
        .sum();
    walked + HALT * legs.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    /// Points on a line, at random: legs in order stay so, each thing arrives, and nothing gets longer.
    #[test]
    fn things_arrive_and_the_walk_gets_no_longer() {
        let (mut shorter, mut halted) = (0, 0);
        for seed in 1..=200 {
            let mut random = Random(seed);
            let (errands, between) = (1 + random.below(6), random.below(4));
            let places: Vec<usize> =
                (0..1 + 2 * errands + between).map(|_| random.below(40)).collect();
            let distance: Vec<Vec<usize>> =
                places.iter().map(|a| places.iter().map(|b| a.abs_diff(*b)).collect()).collect();
            let legs: Vec<Leg> = (0..errands)
                .map(|errand| Leg { errand, from: 1 + 2 * errand, to: 2 + 2 * errand })
                .collect();
            let halts: Vec<usize> = (0..between).map(|n| 1 + 2 * errands + n).collect();
            let found = relayed(&distance, legs.clone(), &vec![halts; errands]);
            assert!(is_in_order(&found, &legs), "seed {seed}: {found:?}");
            for leg in &legs {
                let last = found.iter().rev().find(|other| other.errand == leg.errand);
                assert_eq!(last.map(|last| last.to), Some(leg.to), "seed {seed}");
            }
            let (before, after) = (length(&distance, &legs), length(&distance, &found));
            assert!(after <= before, "seed {seed}");
            shorter += usize::from(after < before);
            halted += usize::from(found.len() > legs.len());
        }
        assert!(shorter > 100 && halted > 5, "{shorter} {halted}");
    }
}
