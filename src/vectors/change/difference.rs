//! Which segment of one observation is which of the next, and how they moved (SPEC V16, V17; paper 3, section 4).
//!
//! Most are where they were: found by place, they take no further part, as the paper removes equal pairs. The rest is
//! looked for near its place, then anywhere, by invariants.

use std::{borrow::Cow, collections::VecDeque};

use super::parts::{RigidPart, rigid_parts};
use crate::{
    Counters, Equality, Euclid, Index, Model, Motion, Options, Residual, Segment, Space,
    identify::Seeds,
};

/// How far, in cm, and by what turn, in rad, a segment may have moved to be looked for near its place.
const NEAR: (f64, f64) = (30.0, 0.5);

/// What became of one model's segments in the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference<const D: usize> {
    /// Segment before, segment after, and whether it now runs the other way; ascending.
    pub pairs: Vec<(usize, usize, bool)>,
    /// What moved as one, by positions in `pairs`, the greatest first.
    pub parts: Vec<RigidPart<D>>,
    /// Segments of the first model that were not found again.
    pub vanished: Vec<usize>,
    /// Segments of the second model that were not there.
    pub appeared: Vec<usize>,
    pub counters: Counters,
}

/// Compares two observations; `guess` is how what stands still seems to have moved between them.
#[must_use]
pub fn difference<const D: usize>(
    before: &Model<D>,
    after: &Model<D>,
    guess: Option<&Motion<D>>,
    equality: &Equality,
) -> Difference<D>
where
    Euclid<D>: Space<D>,
{
    let mut counters = Counters::default();
    let mut matching = Matching {
        before,
        after,
        equality,
        partner: vec![None; before.len()],
        taken: vec![false; after.len()],
    };
    let start = guess.copied().unwrap_or_else(Motion::identity);
    if guess.is_some() {
        matching.in_place(&start, &mut counters);
        matching.nearby(&start, &mut counters);
    }
    matching.anywhere(&mut counters);
    let pairs: Vec<(usize, usize, bool)> = matching
        .partner
        .iter()
        .enumerate()
        .filter_map(|(k, p)| p.map(|(j, reversed)| (k, j, reversed)))
        .collect();
    let (told, next) = aligned(before, after, &pairs);
    let parts = rigid_parts(&told, &next, &start, equality);
    let vanished = (0..before.len()).filter(|&k| matching.partner[k].is_none()).collect();
    let appeared = (0..after.len()).filter(|&k| !matching.taken[k]).collect();
    Difference { pairs, parts, vanished, appeared, counters }
}

/// Segments before and after, start to start, and which pair stands next on the contour.
pub(crate) fn aligned<const D: usize>(
    before: &Model<D>,
    after: &Model<D>,
    pairs: &[(usize, usize, bool)],
) -> (Vec<(Segment<D>, Segment<D>)>, Vec<Option<usize>>) {
    let mut position = vec![None; before.len()];
    for (at, pair) in pairs.iter().enumerate() {
        position[pair.0] = Some(at);
    }
    let told = pairs.iter().map(|&(k, j, reversed)| {
        let segment = after.segments()[j];
        (before.segments()[k], if reversed { segment.reversed() } else { segment })
    });
    let next = pairs
        .iter()
        .map(|&(k, ..)| before.next(k).filter(|_| before.is_joined(k)).and_then(|n| position[n]));
    (told.collect(), next.collect())
}

/// Some segments of a model as one; all of them are the model itself.
fn members_of<'a, const D: usize>(model: &'a Model<D>, members: &[usize]) -> Cow<'a, Model<D>> {
    if members.len() == model.len() {
        Cow::Borrowed(model)
    } else {
        Cow::Owned(model.part(members))
    }
}

struct Matching<'a, const D: usize> {
    before: &'a Model<D>,
    after: &'a Model<D>,
    equality: &'a Equality,
    partner: Vec<Option<(usize, bool)>>,
    taken: Vec<bool>,
}

impl<const D: usize> Matching<'_, D>
where
    Euclid<D>: Space<D>,
{
    /// By V11, at the place where the guess has them.
    fn in_place(&mut self, guess: &Motion<D>, counters: &mut Counters) {
        let reach =
            self.equality.radius(2 * D as u32) * (self.before.deviation() + self.after.deviation());
        self.pair_up(guess, reach, counters, |equality, residual, _, _| {
            equality.admits(residual).then(|| residual.squared())
        });
    }

    /// Not far from there, and of the same length as far as it is known.
    fn nearby(&mut self, guess: &Motion<D>, counters: &mut Counters) {
        if self.partner.iter().all(Option::is_some) || self.taken.iter().all(|&t| t) {
            return;
        }
        self.pair_up(guess, NEAR.0, counters, |equality, residual, a, b| {
            let turn = a.vector().normalize().dot(&b.vector().normalize());
            let apart = residual.start.norm().max(residual.end.norm());
            let error = a.covariance.deviation().hypot(b.covariance.deviation());
            let same = !(a.is_whole() && b.is_whole())
                || (a.length() - b.length()).abs()
                    <= std::f64::consts::SQRT_2 * equality.radius(1) * error;
            (turn >= NEAR.1.cos() && apart <= NEAR.0 && same).then_some(apart)
        });
    }

    /// Pairs what is free, the nearest first.
    fn pair_up(
        &mut self,
        guess: &Motion<D>,
        reach: f64,
        counters: &mut Counters,
        admits: impl Fn(&Equality, &Residual<D>, &Segment<D>, &Segment<D>) -> Option<f64>,
    ) {
        let mut found = Vec::with_capacity(self.before.len());
        let mut near = Vec::new();
        for k in (0..self.before.len()).filter(|&k| self.partner[k].is_none()) {
            let moved = self.before.segments()[k].moved(guess);
            near.clear();
            self.after.places().near(&moved.at(0.5), reach, &mut near);
            if !(moved.is_whole() && self.after.is_whole()) {
                self.after.places().near(&moved.start, reach, &mut near);
                self.after.places().near(&moved.end, reach, &mut near);
            }
            for &j in near.iter().filter(|&&j| !self.taken[j as usize]) {
                counters.segments += 1;
                let other = self.after.segments()[j as usize];
                let reversed = moved.vector().dot(&other.vector()) < 0.0;
                let other = if reversed { other.reversed() } else { other };
                let Some(residual) = Residual::between(&moved, &other) else { continue };
                if let Some(distance) = admits(self.equality, &residual, &moved, &other) {
                    found.push((distance, k, j as usize, reversed));
                }
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, k, j, reversed) in found {
            if self.partner[k].is_none() && !self.taken[j] {
                self.partner[k] = Some((j, reversed));
                self.taken[j] = true;
            }
        }
    }

    /// What is left, by invariants: whichever motion carries most of it, again and again.
    fn anywhere(&mut self, counters: &mut Counters) {
        for _ in 0..8 {
            let left: Vec<usize> =
                (0..self.before.len()).filter(|&k| self.partner[k].is_none()).collect();
            let free: Vec<usize> = (0..self.after.len()).filter(|&j| !self.taken[j]).collect();
            if left.len() < 2 || free.len() < 2 {
                return;
            }
            let (stored, view) = (members_of(self.after, &free), members_of(self.before, &left));
            let index = Index::of(
                std::slice::from_ref(stored.as_ref()),
                Options {
                    confidence: self.equality.confidence(),
                    // Links of unknown length are asked for by views that have some.
                    cut_ends: !view.is_whole(),
                    ..Options::default()
                },
            );
            let seeds = Seeds { view: &view, model: &stored, index: &index };
            let Some(pairs) = seeds.greatest(counters) else { return };
            for (k, j, reversed) in pairs {
                // Pieces of one face fit the whole of it; one of them is it.
                if !self.taken[free[j]] {
                    self.partner[left[k]] = Some((free[j], reversed));
                    self.taken[free[j]] = true;
                }
            }
        }
    }
}

impl<const D: usize> Difference<D> {
    /// What became of the segments over this step and the next one:
    /// (μₜ, μₜ₋₂) = (μₜ, μₜ₋₁) · (μₜ₋₁, μₜ₋₂).
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let mut after = std::collections::HashMap::new();
        for (at, &(k, j, reversed)) in next.pairs.iter().enumerate() {
            after.insert(k, (at, j, reversed));
        }
        let part_of = |parts: &[RigidPart<D>], count: usize| {
            let mut of = vec![None; count];
            for (p, part) in parts.iter().enumerate() {
                for &k in &part.members {
                    of[k] = Some(p);
                }
            }
            of
        };
        let (first, second) =
            (part_of(&self.parts, self.pairs.len()), part_of(&next.parts, next.pairs.len()));
        let (mut pairs, mut vanished) = (Vec::new(), self.vanished.clone());
        let mut parts: Vec<((usize, usize), RigidPart<D>)> = Vec::new();
        for (at, &(k, middle, reversed)) in self.pairs.iter().enumerate() {
            let Some(&(beyond, j, again)) = after.get(&middle) else {
                vanished.push(k);
                continue;
            };
            // What moved as one twice moved as one.
            if let (Some(p), Some(q)) = (first[at], second[beyond]) {
                let motion = next.parts[q].motion * self.parts[p].motion;
                match parts.iter_mut().find(|part| part.0 == (p, q)) {
                    Some((_, part)) => part.members.push(pairs.len()),
                    None => parts.push(((p, q), RigidPart { members: vec![pairs.len()], motion })),
                }
            }
            pairs.push((k, j, reversed != again));
        }
        vanished.sort_unstable();
        let mut parts: Vec<RigidPart<D>> = parts.into_iter().map(|(_, part)| part).collect();
        parts.sort_by_key(|part| std::cmp::Reverse(part.members.len()));
        let reached: std::collections::HashSet<usize> = pairs.iter().map(|p| p.1).collect();
        let mut appeared: Vec<usize> = next.appeared.clone();
        appeared.extend(next.pairs.iter().map(|p| p.1).filter(|j| !reached.contains(j)));
        appeared.sort_unstable();
        let counters = self.counters.with(next.counters);
        Self { pairs, parts, vanished, appeared, counters }
    }
}

/// The differential mode: a queue of the last N + 1 models and the steps between them.
#[derive(Debug, Clone)]
pub struct Differential<const D: usize> {
    length: usize,
    equality: Equality,
    models: VecDeque<Model<D>>,
    steps: VecDeque<Difference<D>>,
}

impl<const D: usize> Differential<D>
where
    Euclid<D>: Space<D>,
{
    /// A queue for `n` steps: n + 1 models.
    #[must_use]
    pub fn new(n: usize, equality: Equality) -> Self {
        Self { length: n.max(1), equality, models: VecDeque::new(), steps: VecDeque::new() }
    }

    /// Takes in an observation; what changed since the last one, if there was one. The oldest leaves the queue.
    pub fn push(&mut self, model: Model<D>, guess: Option<&Motion<D>>) -> Option<&Difference<D>> {
        let step = self.models.back().map(|last| difference(last, &model, guess, &self.equality));
        self.models.push_back(model);
        if self.models.len() > self.length + 1 {
            self.models.pop_front();
            self.steps.pop_front();
        }
        self.steps.extend(step);
        self.steps.back()
    }

    /// The models in the queue, oldest first.
    pub fn models(&self) -> impl ExactSizeIterator<Item = &Model<D>> {
        self.models.iter()
    }

    /// The steps between them.
    pub fn steps(&self) -> impl ExactSizeIterator<Item = &Difference<D>> {
        self.steps.iter()
    }

    /// What changed from the oldest model to the newest: the steps composed.
    #[must_use]
    pub fn trend(&self) -> Option<Difference<D>> {
        let mut steps = self.steps.iter();
        let first = steps.next()?.clone();
        Some(steps.fold(first, |sum, step| sum.then(step)))
    }
}
