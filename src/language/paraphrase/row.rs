//! A paraphrase, and the sentence that it puts.

use std::collections::HashMap;

use super::pattern::{Pattern, Run, Taken, stands_among};
use super::words::Words;
use crate::words::{Case, NounPhrase, WordHints};

/// Words in common, by their names.
pub(super) type Sets = HashMap<String, Vec<Run>>;

/// When a line about orders has its turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Before it is put into the order of time what is to be done.
    InTime,
    /// Before what a clause leaves out is said again.
    Early,
    Late,
}

/// Another way to say something.
#[derive(Debug)]
pub(super) struct Paraphrase {
    pub(super) pattern: Pattern,
    /// What must stand in the sentence, any of it, and what must not.
    pub(super) only: Vec<Run>,
    pub(super) unless: Vec<Run>,
    pub(super) plain: Vec<Put>,
    /// Whether a question mark ends it.
    pub(super) asks: bool,
    /// Whether what it leaves out is said not to be meant.
    pub(super) drops: bool,
    pub(super) is_order: bool,
    pub(super) stage: Stage,
}

/// What is put in place of a pattern.
#[derive(Debug)]
pub(super) enum Put {
    Word(String),
    /// What a part was filled with, in a case.
    Taken(usize, Option<Case>),
    /// By which of its words a part was filled; «*» is the rest of the word.
    Choice(usize, Vec<String>),
}

impl Paraphrase {
    /// The sentence in the words that are meant; none where it is another.
    pub(super) fn put(&self, words: &Words<'_>) -> Option<String> {
        let all = 0..words.keys.len();
        let stands = |run: &Run| stands_among(run, words, &all);
        if self.unless.iter().any(stands) || !(self.only.is_empty() || self.only.iter().any(stands))
        {
            return None;
        }
        let taken = self.pattern.fit(words)?;
        let (first, last) = (taken.first()?.words.start, taken.last()?.words.end);
        let before = match self.pattern.is_open.0 {
            true => &words.text[..words.at.get(first)?.start],
            false => "",
        };
        let behind = match self.asks {
            true => "?",
            false => &words.text[words.at.get(last.checked_sub(1)?)?.end..],
        };
        let core = self.core(words, &taken);
        let before = if core.is_empty() { before.trim_end() } else { before };
        Some(format!("{before}{core}{behind}"))
    }

    /// What stands between two things that are put, the first of which ends before a word and the second begins at one:
    /// what stood between where they were said side by side; beside a word of its own, a mark that parts the clauses of
    /// an order.
    fn between<'t>(&self, words: &Words<'t>, end: Option<usize>, next: Option<usize>) -> &'t str {
        let place = match (end, next) {
            (Some(end), Some(next)) => (end == next).then_some(end),
            (Some(own), None) | (None, Some(own)) => {
                (self.is_order && words.parted(own)).then_some(own)
            }
            (None, None) => None,
        };
        let gap = place.and_then(|n| {
            let (one, other) = (words.at.get(n.checked_sub(1)?)?, words.at.get(n)?);
            Some(&words.text[one.end..other.start])
        });
        gap.unwrap_or(" ")
    }

    fn core(&self, words: &Words<'_>, taken: &[Taken]) -> String {
        let mut core = String::new();
        let mut end: Option<usize> = None;
        for put in &self.plain {
            let (text, place) = match put {
                Put::Word(word) => (word.clone(), None),
                Put::Taken(part, case) => {
                    let place = taken[*part].words.clone();
                    let said = words.part(place.clone()).unwrap_or_default();
                    (declined(said, *case), Some(place))
                }
                Put::Choice(part, choices) => {
                    let Taken { words: place, choice, rest } = &taken[*part];
                    let said = words.part(place.clone()).unwrap_or_default();
                    let text = choices[*choice].replace('*', rest);
                    let text = if said.starts_with(char::is_uppercase) {
                        crate::units::capitalized(&text)
                    } else {
                        text
                    };
                    // Words that may be left out.
                    (if place.is_empty() { String::new() } else { text }, Some(place.clone()))
                }
            };
            if text.is_empty() {
                continue;
            }
            if !core.is_empty() && text != "," {
                let next = place.as_ref().map(|next| next.start).filter(|_| !core.ends_with(','));
                core.push_str(self.between(words, end, next));
            }
            core.push_str(&text);
            end = place.map(|place| place.end);
        }
        core
    }
}

/// A noun phrase in a case.
fn declined(said: &str, case: Option<Case>) -> String {
    let Some(case) = case else { return said.to_owned() };
    let phrase = NounPhrase::parse(said, &WordHints::default());
    phrase.form(case, phrase.number())
}
