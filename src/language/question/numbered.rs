//! «А вторая горит?», "How wide are the other two?": a number or "other" without its noun, in a sentence that asks more of it.
//!
//! Invariant: it is one of those that were told, never what bears the number in its name; where those that were told and
//! those that orders took of them are counted differently, it is asked which is meant.

use std::ops::Range;

use super::grammar::{Item, Sentence, number_of};
use super::mark::Mark;
use super::{Asker, Doubt, Memory, Noun, Thing, Unanswered, vocabulary};
use crate::sets::set;
use crate::words::{Case, enumerate, word_keys, word_ranges};

/// Marks that end a clause.
const MARKS: [char; 8] = [',', ';', '.', '!', '?', '–', '—', ':'];

/// Words that stand for one of those that were told, or for several.
struct Said {
    words: Range<usize>,
    /// The number in the order; none is "other".
    rank: Option<u64>,
    /// How many there are.
    many: Option<u64>,
    is_plural: bool,
}

impl Asker<'_> {
    /// A question with the name of what a number or "other" means in it, where that stands without its noun.
    ///
    /// # Errors
    /// Several of those that were told are meant alike.
    pub(super) fn with_told(&self, text: &str, memory: &Memory) -> Result<Option<String>, Doubt> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        if memory.listed.len() < 2 || memory.pending.is_some() {
            return Ok(None);
        }
        let Some(said) = (0..keys.len()).find_map(|n| said(&keys, n)) else { return Ok(None) };
        let small = |n: usize| set!("AroundAnother").contains(&keys[n].as_str());
        // Where "the other one" is, is asked elsewhere; what a number means of those that orders took, nowhere else.
        let is_taken = said.rank.is_some() && memory.has_taken();
        let placed = (0..keys.len()).any(|n| match vocabulary::longest(&keys[n..=n]) {
            Some((_, Mark::Where)) => !is_taken,
            Some((_, mark)) => matches!(mark, Mark::Link(_)),
            None => false,
        });
        let asks = (0..keys.len()).any(|n| !said.words.contains(&n) && !small(n));
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let most = sentence.items().iter().any(|item| match item {
            Item::Mark(mark) => matches!(mark, Mark::Best(_) | Mark::BestTo(_)),
            Item::Noun(phrase) => phrase.noun.best.is_some(),
            Item::Place { .. } => true,
            _ => false,
        });
        if !asks || placed || most || !sentence.ends_noun(said.words.end) {
            return Ok(None);
        }
        let Some(meant) = self.told_by(&said, memory) else { return Ok(None) };
        let reference = &text[words[said.words.start].start..words[said.words.end - 1].end];
        if meant.len() > 1 && !said.is_plural {
            let reference = reference.to_owned();
            return Err(Doubt::Ambiguous { reference, candidates: meant });
        }
        let knowledge = self.knowledge(sentence.language, memory);
        let names: Vec<String> =
            meant.iter().map(|t| knowledge.form(*t, Case::Nominative)).collect();
        let from = (0..said.words.start).take_while(|n| small(*n)).count();
        let before = &text[words[from].start..words[said.words.start].start];
        let behind = &text[words[said.words.end - 1].end..];
        Ok(Some(format!("{before}{}{behind}", enumerate(&names, sentence.language))))
    }

    /// «Тот, что на полке, принеси сюда»: an order with the names of what a pointing word and its clause mean of those that were
    /// told; none where it has no such words.
    ///
    /// # Errors
    /// None of those that were told is there, or several are.
    pub fn with_pointed(
        &self,
        text: &str,
        memory: &Memory,
    ) -> Result<Option<String>, Box<Unanswered>> {
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let (words, keys) = (&sentence.words, &sentence.keys);
        let Some(from) = (0..keys.len()).find(|n| sentence.points_ahead(*n)) else {
            return Ok(None);
        };
        let parted = |n: &usize| text[words[n - 1].end..words[*n].start].contains(MARKS);
        let until = (from + 3..words.len()).find(parted).unwrap_or(words.len());
        let Some(place) = words.get(from + 2) else { return Ok(None) };
        let place = self.bare_place(&text[place.start..words[until - 1].end], memory);
        let is_plural = set!("SeveralOnes").contains(&keys[from].as_str());
        let Some(restrictions) = place.filter(|_| memory.listed.len() > 1) else {
            // «Закрой дверь в ванную. – Закрой и ту, что ведёт в спальню»: a door too.
            let last = memory.last_things().pop().filter(|_| !is_plural);
            let kind = last.and_then(|thing| self.kind_word(thing, sentence.language));
            // "… that one too" is another than the last.
            let too = from > 0 && set!("AndWord").contains(&keys[from - 1].as_str());
            let other = set!("OtherOne").first().filter(|_| too).map_or("", |other| other);
            let whole = |kind| {
                let (before, behind) = (&text[..words[from].start], &text[words[from].end..]);
                format!("{before}{other} {kind}{behind}")
            };
            return Ok(kind.map(whole));
        };
        let knowledge = self.knowledge(sentence.language, memory);
        let told = Noun { plural: true, restrictions, ..Noun::of(memory.listed.clone()) };
        let reference = text[words[from].start..words[until - 1].end].to_owned();
        let found = knowledge.find(&told, true).unwrap_or_default();
        let doubt = match found.len() {
            0 => Doubt::not_understood(&reference),
            2.. if !is_plural => Doubt::Ambiguous { reference, candidates: found },
            _ => {
                let names: Vec<String> =
                    found.iter().map(|t| knowledge.form(*t, Case::Accusative)).collect();
                let names = enumerate(&names, sentence.language);
                let behind = text[words[until - 1].end..].trim_start_matches([',', ' ']);
                return Ok(Some(format!("{}{names} {behind}", &text[..words[from].start])));
            }
        };
        Err(Box::new(knowledge.unanswered(doubt)))
    }

    /// What such words mean of those that were told.
    fn told_by(&self, said: &Said, memory: &Memory) -> Option<Vec<Thing>> {
        let others = || self.others_of_last(memory)?.head.things;
        let meant = match said.rank {
            Some(rank) => memory.numbered(usize::try_from(rank).ok()?.checked_sub(1)?),
            None if said.is_plural => {
                let knowledge = self.knowledge(memory.language, memory);
                let rest = self.rest_of_kind(memory);
                let rest = rest.and_then(|noun| knowledge.find(&noun, true).ok());
                rest.or_else(others)?
            }
            None => others()?,
        };
        let fits = said.many.is_none_or(|many| meant.len() as u64 == many);
        let told = meant.iter().all(|thing| memory.listed.contains(thing));
        (!meant.is_empty() && fits && told).then_some(meant)
    }
}

/// The words from one on that stand for what was told.
fn said(keys: &[String], from: usize) -> Option<Said> {
    let is = |n: usize, all: &[&str]| keys.get(n).is_some_and(|key| all.contains(&key.as_str()));
    let number = |n: usize| keys.get(n).and_then(|key| number_of(key)).filter(|many| *many > 1);
    let mut at = from;
    let has_article = is(at, set!("TheOrA"));
    at += usize::from(has_article);
    let mut many = number(at);
    at += usize::from(many.is_some());
    let rank = match vocabulary::longest(keys.get(at..)?) {
        Some((1, Mark::Rank(rank))) => Some(rank),
        _ => None,
    };
    let other = is(at, set!("Another"));
    let several = is(at, set!("OtherSeveral"));
    if rank.is_none() && !other || rank.is_some() && many.is_some() {
        return None;
    }
    at += 1;
    // English says "one" for the noun, or nothing behind "the others".
    let stands = is(at, set!("PointingToNoun"));
    let ones = is(at, set!("SeveralOnes"));
    if many.is_none() && rank.is_none() && !stands {
        many = number(at);
        at += usize::from(many.is_some());
    }
    let english = keys[from..at].iter().all(|key| key.is_ascii());
    if english && !(has_article && (stands || many.is_some() || several)) {
        return None;
    }
    at += usize::from(english && stands);
    let is_plural = ones || several || many.is_some();
    Some(Said { words: from..at, rank, many, is_plural })
}
