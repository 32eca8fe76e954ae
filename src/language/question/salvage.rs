//! What asks within a line that is not understood as a whole: "hmm, no idea what time it is, is there a clock?"
//!
//! Invariant: what is left aside names nothing that the map or the lexicon knows, no number and no value, limits nothing
//! and asks nothing; and what was understood is said with the answer.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::{Answer, Asker, Memory, Noun, Said, opening, several};
use crate::words::{Language, word_keys, word_ranges};

/// A line of more parts than this is not chatter.
const MOST_PARTS: usize = 8;
/// Nor one with more words before what asks.
const MOST_WORDS: usize = 12;

impl Asker<'_> {
    /// The answer to the one part of a line that asks, with what was understood before it.
    pub(super) fn salvaged(
        &self,
        text: &str,
        language: Language,
        memory: &Memory,
    ) -> Option<Answer> {
        let parts = parts(text);
        if parts.len() > MOST_PARTS {
            return None;
        }
        let spans = (0..parts.len()).flat_map(|from| (from..parts.len()).map(move |to| (from, to)));
        let mut spans: Vec<(usize, usize)> = spans.collect();
        spans.sort_by_key(|(from, to)| (parts.len() - (to - from), *from));
        for (from, to) in spans {
            let (start, end) = (parts[from].0, parts[to].1);
            let span = &text[start..end];
            // What asks begins with the span, or at a word of it that asks.
            let (words, keys) = (word_ranges(span), word_keys(span));
            let at_once = |n: usize| n == 0 || keys[n] != "ли" && opening::asks_at_once(&keys[n..]);
            let begins = (0..words.len().min(MOST_WORDS)).filter(|n| at_once(*n));
            for begin in begins.map(|n| words[n].start) {
                let asked = &span[begin..];
                let aside = [&text[..start + begin], &text[end..]];
                if asked.len() == text.trim().len() || !self.asks(asked) {
                    continue;
                }
                let Some(place) = self.told_aside(&aside) else { break };
                // "Is there a mug anywhere else?" without its "is" is another question.
                if self.says_something(&span[..begin]) {
                    continue;
                }
                if !self.asks_of_something(asked) {
                    continue;
                }
                // A pronoun may mean what was not understood.
                if self.has_pronoun(asked) {
                    continue;
                }
                let answer = self.answer_at(place.as_ref(), asked, language, memory);
                let Ok(answer) = answer else { continue };
                if answer.said == Said::Unknown {
                    continue;
                }
                let asked = asked.trim_end_matches(['?', '.', '!', ',', ' ']);
                let understood = language
                    .pick(format!("Понял так: «{asked}?» "), format!("Understood as “{asked}?” "));
                return Some(Answer { text: format!("{understood}{}", answer.text), ..answer });
            }
        }
        None
    }

    /// Where the person says to be, in what is left aside; none where that tells anything else.
    fn told_aside(&self, aside: &[&str]) -> Option<Option<Noun>> {
        let mut place = None;
        for text in aside {
            for (from, to) in parts(text) {
                match self.premise(&text[from..to]) {
                    Some(told) if place.is_none() => place = Some(told),
                    Some(_) => return None,
                    None if self.tells_nothing(&text[from..to]) => {}
                    None => return None,
                }
            }
        }
        Some(place)
    }

    fn asks(&self, text: &str) -> bool {
        let words = word_keys(text);
        opening::begins_question(&words) || (several::asks_in(text) && text.trim().ends_with('?'))
    }

    /// Whether a question names what it is about beside the noun of its question word, or what is done.
    fn asks_of_something(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        (0..items.len()).any(|n| match &items[n] {
            Item::Noun(phrase) if phrase.person.is_none() => {
                !matches!(n.checked_sub(1).map(|n| &items[n]), Some(Item::Mark(Mark::Which)))
            }
            Item::Place { .. } => n > 0,
            Item::Mark(mark) => {
                matches!(mark, Mark::Deed(_) | Mark::Sit | Mark::LieDown | Mark::PutDown)
            }
            _ => false,
        })
    }

    /// Whether words before a question belong to it: anything but small and unknown ones.
    fn says_something(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let small = |item: &Item| {
            matches!(
                item,
                Item::Unknown(_)
                    | Item::Mark(
                        Mark::Filler | Mark::The | Mark::A | Mark::You | Mark::Me | Mark::And
                    )
            ) || matches!(item, Item::Noun(phrase) if phrase.person.is_some())
        };
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        // "Sorry to bother you, …", but «С чем граничит …?»
        let governs = matches!(items.last(), Some(Item::Link(_)));
        governs || !items.iter().all(|item| small(item) || matches!(item, Item::Link(_)))
    }

    /// Whether a part of a line names nothing, limits nothing and asks nothing.
    fn tells_nothing(&self, text: &str) -> bool {
        const LIMITS: [&str; 12] = [
            "если",
            "когда",
            "пока",
            "кроме",
            "без",
            "if",
            "when",
            "while",
            "except",
            "but",
            "without",
            "unless",
        ];
        let keys = word_keys(text);
        let (last, before) = match keys.split_last() {
            None => return true,
            Some((last, before)) => (last, before),
        };
        // "Sorry to bother you, but …" limits nothing; "all but …" does.
        let joint = |key: &String| matches!(key.as_str(), "but") && before.len() > 2;
        if before.iter().chain([last]).any(|key| LIMITS.contains(&key.as_str()) && !joint(key)) {
            return false;
        }
        if several::asks_in(text) {
            return false;
        }
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        sentence.content(&self.mind.lexicon).is_empty()
            && !sentence.items().iter().any(|item| {
                matches!(item, Item::Place { .. } | Item::Mark(Mark::Other | Mark::All))
            })
    }
}

/// The parts of a line between its marks, by their bytes.
fn parts(text: &str) -> Vec<(usize, usize)> {
    let mut parts = Vec::new();
    let mut from = 0;
    let ends = text
        .char_indices()
        .filter(|(_, c)| matches!(c, ',' | ';' | '.' | '!' | '?' | '…' | '–' | '—'));
    let ends = ends.map(|(at, mark)| (at, at + mark.len_utf8())).chain([(text.len(), text.len())]);
    for (end, next) in ends {
        let part = &text[from..end];
        let lead = part.len() - part.trim_start().len();
        if !part.trim().is_empty() {
            let closes = text[end..next].trim().starts_with('?');
            parts.push((from + lead, if closes { next } else { from + part.trim_end().len() }));
        }
        from = next;
    }
    parts
}
