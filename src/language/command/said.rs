//! A text by its words, for who puts it into plain orders.

use std::ops::Range;

use super::vocabulary::{Meaning, Verb, longest};
use crate::words::{phrase_at, word_keys, word_ranges};

/// A text, the places of its words and their keys.
pub(super) struct Said {
    pub(super) text: String,
    pub(super) words: Vec<Range<usize>>,
    pub(super) keys: Vec<String>,
}

impl Said {
    pub(super) fn new(text: String) -> Self {
        let (words, keys) = (word_ranges(&text), word_keys(&text));
        Self { text, words, keys }
    }

    pub(super) fn meaning(&self, at: usize) -> Option<(usize, Meaning)> {
        (at < self.keys.len())
            .then(|| longest(&self.keys[at..].iter().map(String::as_str)))
            .flatten()
    }

    pub(super) fn is(&self, at: usize, any: &[&str]) -> bool {
        self.keys.get(at).is_some_and(|key| any.contains(&key.as_str()))
    }

    /// How many words of one of these phrases, the longest, stand here.
    pub(super) fn phrase(&self, at: usize, phrases: &[&str]) -> Option<usize> {
        phrases.iter().filter_map(|phrase| phrase_at(&self.keys, at, phrase)).max()
    }

    /// Whether a mark stands before a word.
    pub(super) fn parted(&self, at: usize) -> bool {
        match at.checked_sub(1).map(|before| self.words[before].end) {
            Some(end) if at < self.words.len() => self.text[end..self.words[at].start]
                .contains([',', ';', '.', '!', '…', ':', '–', '—']),
            _ => true,
        }
    }

    /// Where the clause of a word ends: at the next mark, or the end.
    pub(super) fn clause_end(&self, at: usize) -> usize {
        (at + 1..self.words.len()).find(|&n| self.parted(n)).unwrap_or(self.words.len())
    }

    pub(super) fn bytes(&self, words: &Range<usize>) -> Range<usize> {
        self.words[words.start].start..self.words[words.end - 1].end
    }

    pub(super) fn of(&self, words: &Range<usize>) -> &str {
        &self.text[self.bytes(words)]
    }

    /// The first verb from a word on, and how many words it takes.
    pub(super) fn verb_from(&self, mut at: usize) -> Option<(usize, usize, Verb)> {
        while at < self.keys.len() {
            match self.meaning(at) {
                Some((taken, Meaning::Verb(verb))) => return Some((at, taken, verb)),
                Some((taken, _)) => at += taken,
                None => at += 1,
            }
        }
        None
    }

    /// The text without some words and the mark before them.
    pub(super) fn without(&self, words: &Range<usize>) -> String {
        let mut text = self.text.clone();
        text.replace_range(self.words[words.start - 1].end..self.words[words.end - 1].end, "");
        text
    }

    /// The text with some words replaced by others.
    pub(super) fn with(&self, words: &Range<usize>, said: &str) -> String {
        let mut text = self.text.clone();
        text.replace_range(self.bytes(words), said);
        text
    }
}

/// Whether a word without its noun is an adjective, by its ending.
pub(super) fn is_adjective(key: &str) -> bool {
    const ENDINGS: [&str; 13] =
        ["ую", "юю", "ый", "ий", "ой", "ое", "ее", "ые", "ие", "ого", "его", "ом", "ую"];
    key.chars().count() > 4 && ENDINGS.iter().any(|ending| key.ends_with(ending))
}
