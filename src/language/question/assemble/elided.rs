//! A question word without its noun: "which is in the living room?", «А какие в спальне?», "How many does the kitchen have?"
//!
//! Invariant: it asks among what was spoken of, never among all that there is; where nothing was, it is not understood.

use super::Frame;
use crate::question::mark::Mark;
use crate::question::query::{Noun, Query, Rel, Restriction};
use crate::question::told_together::Elided;
use crate::sets::Set;

impl Frame<'_, '_> {
    /// The query with the noun that its question word lacks; none where nothing was spoken of that it could be.
    pub(super) fn filled(&self, query: Query, elided: Option<Elided>) -> Option<Query> {
        if let Query::Exists { what, .. } = &query
            && let [noun] = &what[..]
            && self.is_any_of_those(noun)
        {
            let noun = Noun { head: elided?.head_of(noun), ..noun.clone() };
            return Some(match query {
                Query::Exists { either, denial, .. } => {
                    Query::Exists { what: vec![noun], either, denial }
                }
                query => query,
            });
        }
        let counts = self.has(Mark::HowMany);
        let asks = counts || self.has(Mark::Which) || self.compares();
        if !asks || !self.values.is_empty() {
            return Some(query);
        }
        match query {
            // "How many does the kitchen have?" counts no kitchens.
            Query::Count(room)
                if counts && self.has(Mark::Have) && self.is_area(&room) && !room.plural =>
            {
                let place = Restriction { rel: Rel::In, anchors: vec![room], negated: false };
                let noun = Noun { plural: true, restrictions: vec![place], ..Noun::default() };
                Some(Query::Count(Noun { head: elided?.head_of(&noun), ..noun }))
            }
            Query::Find(noun) if self.lacks_noun(&noun) => {
                Some(Query::Find(Noun { head: elided?.head_of(&noun), ..noun }))
            }
            Query::Count(noun) if self.lacks_noun(&noun) => {
                Some(Query::Count(Noun { head: elided?.head_of(&noun), ..noun }))
            }
            query => Some(query),
        }
    }

    /// "Are there any in the kitchen?", «есть ли хоть одна в ванной?»: any of those, and not anything at all.
    fn is_any_of_those(&self, noun: &Noun) -> bool {
        static ANY: Set = Set::named("AnyOrOne");
        let said = self.sentence.keys.iter().any(|key| ANY.contains(&key.as_str()));
        said && noun.head.anything
            && noun.filters.is_empty()
            && self.nouns.iter().all(|s| s.noun.head.anything)
    }

    /// «Что ближе?»: between what, nothing says.
    fn compares(&self) -> bool {
        let compares = |mark: &Mark| matches!(mark, Mark::Nearer(_) | Mark::More(_));
        self.spots.is_empty() && self.marks.iter().any(|(mark, _)| compares(mark))
    }

    fn lacks_noun(&self, noun: &Noun) -> bool {
        let head = &noun.head;
        let general = head.kinds.is_empty() && head.named.is_empty() && head.things.is_none();
        // "Which things", "which one" are read elsewhere.
        general && self.nouns.is_empty() && noun.text.is_empty() && noun.also.is_empty()
    }
}
