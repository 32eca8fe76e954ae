//! Identification without an index: every pair of the view against every pair of every thing, in both end orders.
//!
//! The obvious slow version, against which the index is held; it verifies and decides by the same rules.

use super::{
    Counters, Options, Search, ThingId, decide,
    verify::{Hypothesis, Trial},
};
use crate::{Equality, Euclid, Model, Space};

/// What [`Index::identify`](super::Index::identify) answers, found by looking at everything. Each motion that was
/// tried counts as one comparison.
#[must_use]
pub fn exhaustive<const D: usize>(
    models: &[Model<D>],
    view: &Model<D>,
    options: &Options,
) -> Search<D>
where
    Euclid<D>: Space<D>,
{
    let equality = Equality::at(options.confidence);
    let mut counters = Counters::default();
    let mut found: Vec<(ThingId, Hypothesis<D>)> = Vec::new();
    for (thing, model) in models.iter().enumerate() {
        let thing = ThingId(thing as u32);
        let trial = Trial {
            view,
            model,
            equality: &equality,
            scale: options.scale,
            misses: options.misses(view.len()),
        };
        for (a, b) in (0..view.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
            for (i, j) in (0..model.len()).flat_map(|i| (0..model.len()).map(move |j| (i, j))) {
                for (p, q) in [(false, false), (false, true), (true, false), (true, true)] {
                    let seeds = [(a, i, p), (b, j, q)];
                    counters.postings += 1;
                    if i == j
                        || found.iter().any(|(of, h)| {
                            *of == thing && seeds.iter().all(|s| h.pairs.contains(s))
                        })
                    {
                        continue;
                    }
                    let hypothesis = trial
                        .seed(seeds)
                        .and_then(|motion| trial.verify(motion, seeds, &mut counters));
                    found.extend(hypothesis.map(|h| (thing, h)));
                }
            }
        }
    }
    let answer = decide(found, view, options, models.len());
    Search { answer, counters, complete: true }
}
