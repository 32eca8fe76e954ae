//! Pronouns of an order that may mean one or another of what was told: it is asked back which.

use std::ops::Range;

use super::super::grammar::{Item, Sentence};
use super::super::mark::Pronoun;
use super::super::memory::Exchange;
use super::super::query::{Query, Rel};
use super::super::{Asker, Memory, Thing};
use crate::command;
use crate::sets::set;

impl Asker<'_> {
    /// «Что на кровати? – Книга, ракетка и подушка. – Принеси её», "What is next to the mug? – A plate. – Bring it": which of
    /// several that were told at once, or of what was asked by and what was told, nothing says.
    pub(super) fn one_of_listed(
        &self,
        text: &str,
        sentence: &Sentence<'_>,
        memory: &Memory,
    ) -> Option<(Range<usize>, String, Vec<Thing>)> {
        let (words, reference, pronoun) =
            sentence.items().into_iter().find_map(|item| match item {
                Item::Noun(phrase) => Some((phrase.words, phrase.noun.text, phrase.pronoun?)),
                _ => None,
            })?;
        if matches!(pronoun, Pronoun::They | Pronoun::There) {
            return None;
        }
        let knowledge = self.knowledge(sentence.language, memory);
        let (_, sort) = *command::clauses(text).first()?;
        // Of two doors one of which cannot be shut, that one may be meant all the same.
        let may = |t: Thing| {
            knowledge.can(sort, t) || sort == command::Sort::Door && knowledge.is_akin(sort, t)
        };
        let fits = |t: &&Thing| may(**t) && knowledge.agrees(pronoun, **t);
        let candidates = memory.exchanges.iter().enumerate().map(|(n, exchange)| {
            // What it was asked by may be meant as well; and so may what was spoken of before and has not been left since.
            let before = memory.exchanges.get(n + 1).map_or(&[][..], Exchange::topics);
            let topics = exchange.topics().iter().enumerate();
            let topics = topics.filter(|(n, t)| *n == 0 || before.contains(t)).map(|(_, t)| t);
            let mut all: Vec<Thing> = exchange.members().iter().filter(fits).copied().collect();
            all.extend(topics.filter(fits).filter(|t| !exchange.members().contains(t)));
            all
        });
        let candidates = candidates.into_iter().find(|all| !all.is_empty())?;
        let at = sentence.words.get(words.start)?.start..sentence.words.get(words.end - 1)?.end;
        (candidates.len() > 1).then_some((at, reference, candidates))
    }

    /// «Где столы? Отнеси газету к ним», "Put it on them": on one of several that were told nothing says which.
    fn one_of_places(
        &self,
        text: &str,
        sentence: &Sentence<'_>,
        memory: &Memory,
    ) -> Option<(Range<usize>, String, Vec<Thing>)> {
        let [(_, sort)] = command::clauses(text)[..] else { return None };
        let (mut named, mut places) = (0, Vec::new());
        for item in sentence.items() {
            match item {
                Item::Noun(phrase) if phrase.person.is_none() && phrase.noun.plural => return None,
                Item::Noun(phrase) => named += usize::from(phrase.person.is_none()),
                Item::Place { rel, nouns, .. } => places.push((rel, nouns)),
                _ => {}
            }
        }
        let [(rel, nouns)] = &places[..] else { return None };
        let [they] = &nouns[..] else { return None };
        let carried = matches!(sort, command::Sort::Put | command::Sort::Carry) && named == 1;
        let said = crate::units::name_key(&they.noun.text);
        let dative = *rel == Rel::To && set!("ThemInDative").contains(&said.as_str());
        if !carried || they.pronoun != Some(Pronoun::They) && !dative {
            return None;
        }
        let knowledge = self.knowledge(sentence.language, memory);
        let mut candidates = knowledge.referent(Pronoun::They, Some(*rel));
        candidates.retain(|thing| knowledge.may_be_anchor(*rel, *thing));
        let words = &they.words;
        let at = sentence.words.get(words.start)?.start..sentence.words.get(words.end - 1)?.end;
        (candidates.len() > 1).then(|| (at, they.noun.text.clone(), candidates))
    }

    /// «Где книги? Что рядом с ними? Поезжай к ним»: to the books, or to what stands beside them.
    pub(super) fn either_several(
        &self,
        text: &str,
        sentence: &Sentence<'_>,
        memory: &Memory,
    ) -> Option<(Range<usize>, String, Vec<Thing>)> {
        if let Some(place) = self.one_of_places(text, sentence, memory) {
            return Some(place);
        }
        let they = sentence.items().into_iter().find_map(|item| {
            let nouns = match item {
                Item::Noun(phrase) => vec![phrase],
                Item::Place { nouns, .. } => nouns,
                _ => Vec::new(),
            };
            nouns.into_iter().find(|phrase| phrase.pronoun == Some(Pronoun::They))
        })?;
        let Some(Query::Find(asked)) = &memory.query else { return None };
        let told = &memory.last;
        let anchors = asked.restrictions.iter().flat_map(|place| &place.anchors);
        let by = anchors.flat_map(|anchor| anchor.head.things.iter().flatten());
        let others: Vec<Thing> = by.filter(|thing| !told.contains(thing)).copied().collect();
        let words = they.words;
        let at = sentence.words.get(words.start)?.start..sentence.words.get(words.end - 1)?.end;
        let candidates = told.iter().copied().chain(others.iter().copied()).collect();
        (others.len() > 1 && !told.is_empty()).then_some((at, they.noun.text, candidates))
    }
}
