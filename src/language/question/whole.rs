//! Asking of the whole building what was spoken of in a part of it: «А всего их сколько в доме?»
//!
//! Invariant: where the whole is named, things that were told are none of the bounds of the question.

use super::grammar::{Item, Sentence};
use super::lexicon::{Extension, KindId};
use super::{Asker, Doubt, Head, Memory, Noun, Query, Rel, Thing};

impl Asker<'_> {
    /// Asks of all things of the kind, where a pronoun means some of them and the whole building is named.
    ///
    /// # Errors
    /// What was spoken of is of no one kind.
    pub(super) fn widen(
        &self,
        query: &mut Query,
        text: &str,
        memory: &Memory,
    ) -> Result<(), Doubt> {
        let (Query::Count(noun) | Query::Find(noun)) = query else { return Ok(()) };
        let Some(told) = noun.head.things.as_deref() else { return Ok(()) };
        let in_parts = told.iter().all(|thing| thing.area().is_none());
        let whole = noun.restrictions.is_empty() && self.names_the_whole(text);
        if !in_parts || !(whole || self.is_moved_on(noun, told, memory)) {
            return Ok(());
        }
        // As they were asked for, else by what they are.
        let sought = memory.query.as_ref().and_then(Query::sought).map(|noun| &noun.head.kinds);
        let knowledge = self.knowledge(memory.language, memory);
        let of_these = |kinds: &&Vec<KindId>| {
            let all = knowledge.base(&Head { kinds: (*kinds).clone(), ..Head::default() });
            !kinds.is_empty() && told.iter().all(|thing| all.contains(thing))
        };
        let kinds = match sought.filter(of_these) {
            Some(kinds) => kinds.clone(),
            None => {
                let kind = knowledge.alike(told);
                vec![kind.ok_or_else(|| Doubt::not_understood(text))?]
            }
        };
        let head = Head { kinds, ..Head::default() };
        *noun = Noun { head, plural: true, all: false, ..noun.clone() };
        Ok(())
    }

    /// «Сколько стульев в гостиной? А на кухне их сколько?»: those that were found in one room are in no other.
    fn is_moved_on(&self, noun: &Noun, told: &[Thing], memory: &Memory) -> bool {
        let knowledge = self.knowledge(memory.language, memory);
        let within = |noun: &Noun| match &noun.restrictions[..] {
            [place] if place.rel == Rel::In && !place.negated => match &place.anchors[..] {
                [anchor] => {
                    let found = knowledge.find(anchor, true).unwrap_or_default();
                    match found[..] {
                        [only] => only.area(),
                        _ => None,
                    }
                }
                _ => None,
            },
            _ => None,
        };
        let before = memory.query.as_ref().and_then(Query::sought).and_then(within);
        let (Some(before), Some(now)) = (before, within(noun)) else { return false };
        before != now && told.iter().all(|thing| knowledge.area_of(*thing) == Some(before))
    }

    fn names_the_whole(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let is_whole = |noun: &Noun| {
            let building = |kind| self.mind.lexicon.kind(kind).extension == Extension::Building;
            noun.head.kinds.iter().any(|kind| building(*kind))
        };
        Sentence::new(&plain, &self.mind.lexicon).items().iter().any(|item| match item {
            Item::Place { rel: Rel::In, nouns, .. } => nouns.iter().any(|p| is_whole(&p.noun)),
            _ => false,
        })
    }
}
