//! A question that corrects itself while it is asked: "What's on the TV stand, no wait, on the sofa?", «Где ключи… ой, карта?»
//!
//! **Invariant**: what was taken back is neither asked nor denied, and what stands for it takes the place of the one thing that
//! it can stand for; where that may be several, nothing is answered.

use std::ops::Range;

use super::address::names_last;
use super::grammar::{Item, Phrase, Sentence};
use super::mark::Mark;
use super::{Answer, Asker, Doubt, Memory, Rel, Unanswered, opening, several, vocabulary};
use crate::command::{self, Correction};
use crate::sets::set;
use crate::words::{Case, Language, word_keys, word_ranges};

/// What a question names, as far as a correction can put another in its place.
struct Named {
    rel: Option<Rel>,
    /// In bytes, with the preposition and the article.
    at: Range<usize>,
    /// The same without the preposition.
    noun: Range<usize>,
    is_room: bool,
    phrase: Phrase,
}

impl Asker<'_> {
    /// The answer to a question that corrects itself.
    pub(super) fn answer_as_meant(
        &self,
        text: &str,
        language: Language,
        memory: &mut Memory,
    ) -> Option<Result<Answer, Unanswered>> {
        let found = command::correction_of_question(text)?;
        match self.repaired(text, &found) {
            Some(Ok(meant)) => {
                Some(self.heard(&meant, memory).map(|a| a.understood_as(&meant, language)))
            }
            Some(Err(doubt)) => {
                memory.miss(&doubt, false);
                Some(Err(self.knowledge(language, memory).unanswered(doubt)))
            }
            // «Сколько стульев, извини, на кухне?» puts nothing right.
            None => {
                let says_nothing = vocabulary::parted(&term(text, &found)).is_some();
                let rest = format!("{} {}", found.before, found.behind);
                says_nothing.then(|| self.heard(&rest, memory))
            }
        }
    }

    /// A question as it is meant, where it corrects itself; none where it does not.
    ///
    /// # Errors
    /// [`Doubt::Unheeded`]: what is put instead may stand for several, or for nothing that was said.
    fn repaired(&self, text: &str, found: &Correction<'_>) -> Option<Result<String, Doubt>> {
        let Correction { before, behind, .. } = *found;
        if !names_last(before) {
            return None;
        }
        let behind = self.without_withdrawn(without_i_mean(behind));
        let earlier = command::correction_of_question(before);
        let before = match earlier.and_then(|found| self.repaired(before, &found)) {
            Some(Ok(meant)) => meant,
            _ => before.to_owned(),
        };
        let keys = word_keys(behind);
        // "Is the bedroom, actually, the biggest room?": a word that may say nothing puts right what is a question already.
        let may_be_idle = vocabulary::parted(&term(text, found)).is_some();
        if may_be_idle && self.read(&before, &Memory::default()).is_err() {
            return None;
        }
        if opening::begins_question(&keys) || several::asks_outright(behind) {
            // "How many doors, sorry, are there in the hall?"
            let asks = |mark: Mark| mark.asks() && mark != Mark::Exists;
            let anew = vocabulary::longest(&keys).is_some_and(|(_, mark)| asks(mark));
            if may_be_idle && !anew {
                return None;
            }
            // "What is on the bed, no, what is on the sofa?", but "How many eggs are on the table, no wait, how many cups?"
            let placed = |text: &str| self.named_in(text).iter().any(|n| n.rel.is_some());
            let is_whole = placed(behind) || !placed(&before);
            return (keys.len() > 2).then(|| match is_whole {
                true => Ok(behind.to_owned()),
                false => Err(Doubt::unheeded(behind)),
            });
        }
        let meant = self.named_in(behind);
        let [first, ..] = &meant[..] else { return None };
        // "…, sorry, I am looking for the cup": a clause of its own corrects nothing.
        let led = |word: &str| set!("TheOrA").contains(&word);
        let begins = behind[..first.at.start].split_whitespace().all(led);
        if !begins {
            return None;
        }
        let told = self.named_in(&before);
        // "Is the kitchen the biggest, sorry, room?": what is put right stands at the end, or with it.
        if told.last()?.at.end < before.trim_end().len() {
            return None;
        }
        let stands_for = |one: &&Named| match first.rel {
            Some(rel) => one.rel == Some(rel),
            None => one.is_room == first.is_room && may_be_in_place_of(&one.phrase, &first.phrase),
        };
        let mut taken_back: Vec<&Named> = told.iter().filter(stands_for).collect();
        // "In the kitchen, no, on the table": another relation than any that was said; but whither is not whence.
        let leads = |rel: Rel| matches!(rel, Rel::To | Rel::From | Rel::Through);
        if taken_back.is_empty() && first.rel.is_some_and(|rel| !leads(rel)) {
            let lies = |one: &&Named| one.rel.is_some_and(|rel| !leads(rel));
            taken_back = told.iter().filter(lies).collect();
        }
        let [one] = taken_back[..] else { return Some(Err(Doubt::unheeded(behind))) };
        let at = if first.rel.is_some() { &one.at } else { &one.noun };
        let (head, tail) = (&before[..at.start], &before[at.end..]);
        let asks = if text.trim_end().ends_with('?') { "?" } else { "" };
        let behind = behind.trim_end_matches(['?', '.', '!', ' ']);
        Some(Ok(format!("{head}{behind}{tail}{asks}")))
    }

    fn named_in(&self, text: &str) -> Vec<Named> {
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let named = |rel: Option<Rel>, phrase: Phrase| {
            let words = &phrase.words;
            let article =
                |at: usize| at > 0 && set!("TheOrA").contains(&sentence.keys[at - 1].as_str());
            let begin = words.start - usize::from(article(words.start));
            let is_link = |n: &usize| {
                let said = vocabulary::longest(&sentence.keys[begin - n..begin]);
                matches!(said, Some((taken, Mark::Link(_))) if taken == *n)
            };
            let link = rel.and_then(|_| (1..=begin.min(3)).rev().find(is_link)).unwrap_or(0);
            let bytes = |word: usize| sentence.words[word].start;
            let end = sentence.words[words.end - 1].end;
            Named {
                rel,
                at: bytes(begin - link)..end,
                noun: bytes(begin)..end,
                is_room: self.is_room(&phrase.noun),
                phrase,
            }
        };
        let of = |item: Item| match item {
            Item::Noun(phrase) => vec![(None, phrase)],
            Item::Place { rel, nouns, .. } => {
                nouns.into_iter().map(|phrase| (Some(rel), phrase)).collect()
            }
            _ => Vec::new(),
        };
        let all = sentence.items().into_iter().flat_map(of);
        all.filter(|(_, phrase)| phrase.person.is_none() && phrase.pronoun.is_none())
            .map(|(rel, phrase)| named(rel, phrase))
            .collect()
    }

    /// «не ключи, карта»: what is put instead, without what is taken back once more.
    fn without_withdrawn<'t>(&self, behind: &'t str) -> &'t str {
        let Some((first, rest)) = behind.split_once(',') else { return behind };
        let sentence = Sentence::new(first, &self.mind.lexicon);
        match super::told_aside::withdrawn(&sentence.items()) {
            Some(_) if !rest.trim().is_empty() => rest.trim_start(),
            _ => behind,
        }
    }
}

/// The words that correct: "no wait".
fn term(text: &str, found: &Correction<'_>) -> Vec<String> {
    word_keys(&text[found.before.len()..text.len() - found.behind.len()])
}

/// Whether some form of a noun is one that another may have: «стулья», «столы», but not «стула».
fn may_be_in_place_of(one: &Phrase, other: &Phrase) -> bool {
    let has = |phrase: &Phrase, case: &Case| {
        phrase.cases.is_empty() || phrase.cases.iter().any(|form| form.has_case(*case))
    };
    Case::ALL.iter().any(|case| has(one, case) && has(other, case))
}

/// A text without the "I mean" at its end.
fn without_i_mean(text: &str) -> &str {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let said = set!("IMeant").iter().map(|said| said.split(' ').count()).filter(|taken| {
        let from = keys.len().checked_sub(*taken);
        from.is_some_and(|from| set!("IMeant").contains(&keys[from..].join(" ").as_str()))
    });
    match said.max().map(|taken| keys.len() - taken) {
        Some(0) | None => text,
        Some(kept) => text[..words[kept - 1].end].trim_end_matches([',', ' ']),
    }
}
