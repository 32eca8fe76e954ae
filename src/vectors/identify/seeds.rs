//! The greatest part of a view that lies in one model under one motion, whatever the rest does (SPEC V18).

use std::collections::HashSet;

use super::{
    Counters, Index, fits,
    link::{self, Link},
    table::Posting,
    verify::{Correspondence, Trial},
};
use crate::{Euclid, Model, Space};

/// Neighbours looked at on either side before a motion is looked at whole; half of them must fit.
const AROUND: usize = 4;

/// How many segments one motion explains, how well, and which.
type Found = (usize, f64, Vec<Correspondence>);

/// A view and the one model of an index.
pub(crate) struct Seeds<'a, const D: usize> {
    pub(crate) view: &'a Model<D>,
    pub(crate) model: &'a Model<D>,
    pub(crate) index: &'a Index<D>,
}

impl<const D: usize> Seeds<'_, D>
where
    Euclid<D>: Space<D>,
{
    /// The first motion that explains more than half of the view; only those are looked at whole under which the
    /// neighbours of their two segments lie in place.
    fn most(&self, trial: &Trial<'_, D>, counters: &mut Counters) -> Option<Vec<Correspondence>> {
        let (view, options) = (self.view, &self.index.options);
        for link in link::links_of_view(view, options.reach) {
            for seeds in self.seeds(&link, counters) {
                let Some(motion) = trial.seed(seeds) else { continue };
                let around = (1..=AROUND).flat_map(|k| {
                    let before = (link.a + view.len() - k % view.len()) % view.len();
                    [before, (link.b + k) % view.len()]
                });
                let fitting = around.filter(|k| {
                    let moved = view.segments()[*k].moved(&motion);
                    trial.nearest(&moved, counters).is_some()
                });
                if fitting.count() < AROUND {
                    continue;
                }
                let found = trial.place(motion, seeds, counters);
                if let Some((_, pairs)) = found.filter(|(_, pairs)| 2 * pairs.len() > view.len()) {
                    return Some(pairs);
                }
            }
        }
        None
    }

    /// Pairs of correspondences that a link of the view asks for.
    fn seeds(&self, link: &Link, counters: &mut Counters) -> Vec<[Correspondence; 2]> {
        let mut found = Vec::new();
        for (key, swapped) in self.index.keys(link) {
            let mut candidates: Vec<Posting> = Vec::new();
            self.index.table.find(&key, counters, |posting| candidates.push(*posting));
            let told = if swapped { self.index.key(link, key.kind) } else { key };
            found.extend(candidates.into_iter().filter_map(|posting| {
                let (first, second) = (usize::from(posting.first), usize::from(posting.second));
                let stored = if swapped { (second, first) } else { (first, second) };
                fits(link, &told, self.model, stored, &self.index.options)
            }));
        }
        found
    }

    /// Correspondences of at least two segments, as many as one motion explains; of as many, the better explained.
    pub(crate) fn greatest(&self, counters: &mut Counters) -> Option<Vec<Correspondence>> {
        let options = &self.index.options;
        let equality = &self.index.equality;
        let trial = Trial {
            view: self.view,
            model: self.model,
            equality,
            scale: options.scale,
            misses: self.view.len(),
        };
        // No other motion can explain more than what explains most.
        if let Some(most) = self.most(&trial, counters) {
            return Some(most);
        }
        let mut best: Option<Found> = None;
        let mut tried: HashSet<[Correspondence; 2]> = HashSet::new();
        for link in link::links_of_view(self.view, options.reach) {
            if best.as_ref().is_some_and(|b| 2 * b.0 > self.view.len()) {
                break;
            }
            for seeds in self.seeds(&link, counters) {
                // Part of what one motion explains already.
                let known = best.as_ref().is_some_and(|b| seeds.iter().all(|s| b.2.contains(s)));
                if known || !tried.insert(seeds) {
                    continue;
                }
                let found =
                    trial.seed(seeds).and_then(|motion| trial.verify(motion, seeds, counters));
                if let Some(h) = found {
                    let better =
                        best.as_ref().is_none_or(|b| (b.0, b.1) < (h.pairs.len(), h.evidence));
                    if better {
                        best = Some((h.pairs.len(), h.evidence, h.pairs));
                    }
                }
            }
        }
        best.map(|b| b.2)
    }
}
