//! The door of a thing that opens and shuts as a whole: «Дверца микроволновки открыта?» asks of the oven.
//!
//! Invariant: of what has doors of its own, those are asked of; doors are counted and listed as doors.

use super::knowledge::Knowledge;
use super::lexicon::Extension;
use super::query::{Noun, Query, Rel};
use super::values::Property;

impl Knowledge<'_> {
    /// Puts the thing for the door that it has not.
    pub(super) fn doors_of_what_shuts(&self, query: &mut Query) {
        if matches!(query, Query::Holds { .. } | Query::Choice { .. } | Query::Property { .. }) {
            query.each_noun(&mut |noun| {
                if let Some(shuts) = self.shuts(noun) {
                    *noun = shuts;
                }
            });
        }
    }

    /// What is meant by the door of something without doors, whose state the map tells.
    fn shuts(&self, noun: &Noun) -> Option<Noun> {
        let is_door = |k| self.lexicon().kind(k).extension == Extension::Doors;
        let [place] = &noun.restrictions[..] else { return None };
        let [anchor] = &place.anchors[..] else { return None };
        let plain = place.rel == Rel::Of && !place.negated && noun.filters.is_empty();
        if !plain || !noun.head.kinds.iter().copied().any(is_door) {
            return None;
        }
        let things = self.find(anchor, true).ok()?;
        let mut all = things.iter().map(|thing| {
            let has_state = self.values(*thing).iter().any(|(of, _, _)| *of == Property::State);
            thing.replica().is_some() && has_state && self.statuses(*thing).is_empty()
        });
        (!things.is_empty() && all.all(|shuts| shuts)).then(|| anchor.clone())
    }
}
