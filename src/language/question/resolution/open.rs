//! An order that is open: what was said of it, part by part, before it is known what its descriptions mean. What corrects
//! such an order says one of its parts anew.
//!
//! Invariant: an order that asked back, or was not understood, is what the next line amends, and never the one before it.

use std::ops::Range;

use super::Resolver;
use super::place::{Spot, case_of};
use crate::command::{self, Correction, Sort};
use crate::question::grammar::{Item, Phrase, Sentence};
use crate::question::memory::Ordered;
use crate::question::query::Rel;
use crate::question::{Asker, Memory, Thing};
use crate::words::Case;

impl Asker<'_> {
    /// Notes that an order came to nothing yet: what amends is said of it from now on, and "it" is one of the things that
    /// it may be done to.
    pub fn leave_open(&self, text: &str, memory: &mut Memory) {
        memory.ordered = self.parts(text, memory);
        let Some(waiting) = memory.waiting.clone() else { return };
        memory.pending = None;
        memory.spoken.clear();
        let object = memory.ordered.as_ref().and_then(|ordered| ordered.object.clone());
        match object {
            Some((at, _)) if at == waiting.at => memory.waver(&waiting.candidates),
            Some((_, things)) if !things.is_empty() => memory.waver(&things),
            _ => {}
        }
    }

    /// The parts of an order as they were said; none where it names neither what is done something to nor whither.
    pub(super) fn parts(&self, text: &str, memory: &Memory) -> Option<Ordered> {
        let described = command::without_verbs(text);
        let sentence = Sentence::new(&described, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let resolver = Resolver::reading(&knowledge, &sentence);
        let (object, told, goal) = resolver.parts(text);
        let things = |phrase: &Phrase| knowledge.base(&phrase.noun.head);
        let object = object.map(|phrase| (resolver.bytes(&phrase.words), things(&phrase)));
        (object.is_some() || goal.is_some()).then(|| Ordered {
            text: text.to_owned(),
            object,
            told,
            goal,
            is_resolved: false,
            language: sentence.language,
        })
    }

    /// Bytes of the pronoun that an order is done to, and what it means.
    pub(super) fn done_to_it(
        &self,
        text: &str,
        sentence: &Sentence<'_>,
        memory: &Memory,
    ) -> Option<(Range<usize>, Vec<Thing>)> {
        let words = sentence.items().into_iter().find_map(|item| match item {
            Item::Noun(phrase) if phrase.pronoun.is_some() => Some(phrase.words),
            _ => None,
        })?;
        let at = sentence.words.get(words.start)?.start..sentence.words.get(words.end - 1)?.end;
        let things = self.spoken_of(text, memory);
        (!things.is_empty()).then_some((at, things))
    }

    /// The case in which a name stands for the words at some bytes of an order.
    pub(super) fn case_at(&self, text: &str, at: &Range<usize>, memory: &Memory) -> Case {
        let described = command::without_verbs(text);
        let sentence = Sentence::new(&described, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let resolver = Resolver::reading(&knowledge, &sentence);
        let place = sentence.items().into_iter().find_map(|item| match item {
            Item::Place { rel, nouns, .. } => {
                let phrase = nouns.into_iter().find(|p| resolver.bytes(&p.words) == *at)?;
                Some(case_of(rel, resolver.is_whither(rel, &phrase) != Some(false)))
            }
            _ => None,
        });
        place.unwrap_or(Case::Accusative)
    }
}

/// What a line comes to that takes back what it has ordered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Corrected {
    /// The line as it is meant.
    Meant(String),
    /// Nothing is to be done.
    Cancelled,
    /// These words take it back, and what they put instead is not understood.
    Unclear(String),
}

impl Asker<'_> {
    /// "Bring the red cup. No, the white one": a line that corrects itself, as it is meant. None for any other.
    #[must_use]
    pub fn corrected(&self, text: &str, memory: &Memory) -> Option<Corrected> {
        let Correction { before, behind, is_sure } = command::correction(text)?;
        let before = match self.corrected(before, memory) {
            Some(Corrected::Meant(meant)) => meant,
            _ => before.to_owned(),
        };
        if behind.is_empty() {
            return Some(Corrected::Cancelled);
        }
        let behind = &*command::gathered(behind);
        // It is the last order that is corrected.
        let last = command::clauses(&before).last()?.0;
        let (first, order) = before.split_at(last);
        let ordered = self.parts(order, memory);
        let amended = match command::clauses(behind).is_empty() {
            true => self.amended(&format!("no, {behind}"), ordered.as_ref()?, memory, true),
            false if !is_sure => None,
            false => ordered.as_ref().map_or_else(
                || Some(behind.to_owned()),
                |ordered| ordered.with_verb(behind).or_else(|| ordered.done_otherwise(behind)),
            ),
        };
        match amended {
            Some(amended) => Some(Corrected::Meant(format!("{first}{amended}"))),
            None if is_sure => Some(Corrected::Unclear(behind.to_owned())),
            None => None,
        }
    }
}

impl Ordered {
    /// Another order with what this one is done to for its "it": "open the door, no, close it".
    fn done_otherwise(&self, order: &str) -> Option<String> {
        match &self.object {
            Some((at, _)) => {
                let end = self.told.iter().filter(|told| told.start >= at.end).map(|told| told.end);
                command::with_object(order, &self.text[at.start..end.max().unwrap_or(at.end)])
            }
            None => Some(order.to_owned()),
        }
    }
}

/// What an order is done to, where the bytes are that tell where that is, and those that say whither.
type Parts = (Option<Phrase>, Vec<Range<usize>>, Option<Range<usize>>);

impl Resolver<'_, '_> {
    fn parts(&self, text: &str) -> Parts {
        let clauses = command::clauses(text);
        let clause_at =
            |byte: usize| clauses.iter().rposition(|(start, _)| *start <= byte).unwrap_or(0);
        let sort = |clause: usize| clauses.get(clause).map_or(Sort::Other, |(_, sort)| *sort);
        let Ok(items) = self.numbered(self.sentence.items()) else { return Parts::default() };
        let items = self.freed(items, |byte| sort(clause_at(byte)));
        let spots = self.spots(&items, clause_at, &sort);
        let (mut object, mut told, mut goal) = Parts::default();
        for clause in 0..clauses.len().max(1) {
            let mut own: Vec<&Spot<'_>> = spots.iter().filter(|s| s.clause == clause).collect();
            own.retain(|spot| sort(clause) != Sort::Go || !self.is_faced(spot.phrase));
            let objects: Vec<(usize, &Phrase)> = items
                .iter()
                .enumerate()
                .filter_map(|(n, item)| match item {
                    Item::Noun(phrase) if phrase.person.is_none() => Some((n, phrase)),
                    _ => None,
                })
                .filter(|(_, phrase)| clause_at(self.bytes(&phrase.words).start) == clause)
                .collect();
            let whither = self
                .destination(sort(clause), &own, !objects.is_empty())
                .filter(|goal| !self.tells_of_fixed(sort(clause), own[*goal], &objects));
            if let Some(whither) = whither {
                let spot = own.remove(whither);
                let end = spot.attached.last().map_or(spot.at.end, |at| at.end);
                goal = Some(spot.at.start..end);
            }
            if object.is_none() {
                // What "it" means was said elsewhere.
                let own = objects.first().filter(|(_, phrase)| phrase.pronoun.is_none());
                object = own.map(|(_, phrase)| Phrase::clone(phrase));
            }
            let places = own.iter().filter(|spot| spot.rel != Rel::Through);
            told.extend(
                places.map(|spot| {
                    spot.at.start..spot.attached.last().map_or(spot.at.end, |at| at.end)
                }),
            );
        }
        (object, told, goal)
    }
}

/// Things, each once.
pub(super) fn without(things: &[Thing], out: &[Thing]) -> Vec<Thing> {
    things.iter().filter(|thing| !out.contains(thing)).copied().collect()
}
