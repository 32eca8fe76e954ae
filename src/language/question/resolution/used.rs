//! What an order names by its use: «дай что-нибудь почитать», "something to cut an apple with".
//!
//! Invariant: where the order says that it is, there it is looked for, and it is missing only where nothing of that use is there.

use std::ops::Range;

use super::Resolver;
use crate::question::grammar::Item;
use crate::question::query::{Head, Noun, Thing};
use crate::question::{Asker, Doubt, Memory, uses};
use crate::sets::set;
use crate::words::{Case, Language, word_keys, word_ranges};

/// An order with the name of a thing of the wanted use in the place of the words for that.
pub(super) struct Used {
    pub(super) text: String,
    /// Bytes of the name.
    pub(super) at: Range<usize>,
    /// What the name stands for, the best sort first; nothing where no use is told.
    pub(super) heads: Vec<Head>,
}

impl Asker<'_> {
    /// # Errors
    /// The map has nothing of that use.
    pub(super) fn with_use(&self, mut text: String, language: Language) -> Result<Used, Doubt> {
        let (words, keys) = (word_ranges(&text), word_keys(&text));
        let Some(wanted) = uses::wanted(&keys) else {
            return Ok(Used { text, at: 0..0, heads: Vec::new() });
        };
        let memory = Memory::default();
        let knowledge = self.knowledge(language, &memory);
        // What is only looked for need not be carried.
        let found = keys.iter().any(|key| set!("FindWord").contains(&&**key));
        let serves =
            |t: &Thing| found || t.replica().is_some_and(|id| self.world.has_trait(id, "portable"));
        let of_sort = |sort: &u16| {
            let kinds = self.mind.lexicon.kinds_of_sort(*sort);
            let all = knowledge.base(&Head { kinds: kinds.clone(), ..Head::default() });
            (Head { kinds, ..Head::default() }, all.into_iter().find(serves))
        };
        let sorts: Vec<(Head, Option<Thing>)> = wanted.sorts.iter().map(of_sort).collect();
        let Some(thing) = sorts.iter().find_map(|(_, thing)| *thing) else {
            return match sorts.into_iter().next() {
                Some((head, _)) => {
                    Err(Doubt::NoneSuch { noun: Box::new(Noun { head, ..Noun::default() }) })
                }
                None => Ok(Used { text, at: 0..0, heads: Vec::new() }),
            };
        };
        let at = words[wanted.words.start].start..words[wanted.words.end - 1].end;
        let name = knowledge.form(thing, Case::Accusative);
        let named = at.start..at.start + name.len();
        text.replace_range(at, &name);
        let there_are = sorts.into_iter().filter(|(_, thing)| thing.is_some());
        Ok(Used { text, at: named, heads: there_are.map(|(head, _)| head).collect() })
    }
}

impl Resolver<'_, '_> {
    /// The items with any thing of the wanted use for the one that was named in its place.
    pub(super) fn of_use(&self, mut items: Vec<Item>) -> Vec<Item> {
        let Some((at, head)) = &self.used else { return items };
        for item in &mut items {
            if let Item::Noun(phrase) = item
                && self.bytes(&phrase.words) == *at
            {
                let text = phrase.noun.text.clone();
                phrase.noun =
                    Noun { head: head.clone(), indefinite: true, text, ..Noun::default() };
            }
        }
        items
    }
}
