//! The greatest part of a view that lies in one model under one motion, whatever the rest does (SPEC V18).

use std::collections::HashSet;

use super::{
    Counters, Index, fits, link,
    table::Posting,
    verify::{Correspondence, Trial},
};
use crate::{Euclid, Model, Space};

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
        let mut best: Option<(usize, f64, Vec<Correspondence>)> = None;
        let mut tried: HashSet<[Correspondence; 2]> = HashSet::new();
        for link in link::links_of_view(self.view, options.reach) {
            // No other motion can explain more than what explains most.
            if best.as_ref().is_some_and(|b| 2 * b.0 > self.view.len()) {
                break;
            }
            for (key, swapped) in self.index.keys(&link) {
                let mut candidates: Vec<Posting> = Vec::new();
                self.index.table.find(&key, counters, |posting| candidates.push(*posting));
                let told = if swapped { self.index.key(&link, key.kind) } else { key };
                for posting in candidates {
                    let (first, second) = (usize::from(posting.first), usize::from(posting.second));
                    let stored = if swapped { (second, first) } else { (first, second) };
                    let Some(seeds) = fits(&link, &told, self.model, stored, options) else {
                        continue;
                    };
                    // Part of what one motion explains already.
                    let known =
                        best.as_ref().is_some_and(|b| seeds.iter().all(|s| b.2.contains(s)));
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
        }
        best.map(|b| b.2)
    }
}
