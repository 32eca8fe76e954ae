//! The word list `lexicon.txt`: words of a house with their English, and words that endings would decline wrongly.
//!
//! Invariant: every line reads (a test parses all of them), and no word stands twice.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::grammar::{Gender, PlaceSense};
use crate::units::{Carried, carried};

/// One line of the list. What it leaves open follows from the ending.
#[derive(Debug, Clone, Default)]
pub(crate) struct Entry {
    pub(crate) gender: Option<Gender>,
    pub(crate) animate: bool,
    pub(crate) plural_only: bool,
    pub(crate) indeclinable: bool,
    pub(crate) adjectival: bool,
    pub(crate) upon: bool,
    pub(crate) genitive: Option<&'static str>,
    pub(crate) instrumental: Option<&'static str>,
    pub(crate) nominative_plural: Option<&'static str>,
    pub(crate) genitive_plural: Option<&'static str>,
    pub(crate) instrumental_plural: Option<&'static str>,
    pub(crate) locative: Option<&'static str>,
    /// English words, the usual one first.
    pub(crate) english: Vec<String>,
}

impl Entry {
    pub(crate) fn place(&self) -> PlaceSense {
        if self.upon { PlaceSense::Upon } else { PlaceSense::Inside }
    }
}

static TEXT: Carried = carried!("lexicon.txt");

/// The entry of a word in lower case; ё may be written е.
pub(crate) fn find(word: &str) -> Option<&'static Entry> {
    static WORDS: OnceLock<HashMap<String, Entry>> = OnceLock::new();
    let words = WORDS.get_or_init(|| {
        TEXT.lines().filter_map(read_line).map(|(word, entry)| (without_yo(word), entry)).collect()
    });
    if word.contains('ё') { words.get(&without_yo(word)) } else { words.get(word) }
}

pub(super) fn without_yo(word: &str) -> String {
    word.replace('ё', "е")
}

/// A line of the list; none for a comment and for what does not read (a test refuses the latter).
fn read_line(line: &'static str) -> Option<(&'static str, Entry)> {
    let mut parts = line.split_once('#').map_or(line, |(before, _)| before).split_whitespace();
    let word = parts.next()?;
    let mut entry = Entry::default();
    for part in parts {
        match (part, part.split_once('=')) {
            ("м", _) => entry.gender = Some(Gender::Masculine),
            ("ж", _) => entry.gender = Some(Gender::Feminine),
            ("с", _) => entry.gender = Some(Gender::Neuter),
            ("од", _) => entry.animate = true,
            ("мн", _) => entry.plural_only = true,
            ("0", _) => entry.indeclinable = true,
            ("прил", _) => entry.adjectival = true,
            ("на", _) => entry.upon = true,
            (_, Some(("р", form))) => entry.genitive = Some(form),
            (_, Some(("т", form))) => entry.instrumental = Some(form),
            (_, Some(("им", form))) => entry.nominative_plural = Some(form),
            (_, Some(("рм", form))) => entry.genitive_plural = Some(form),
            (_, Some(("тм", form))) => entry.instrumental_plural = Some(form),
            (_, Some(("м", form))) => entry.locative = Some(form),
            (_, Some(("en", words))) => {
                entry.english = words.split(',').map(|word| word.replace('_', " ")).collect();
            }
            _ => return None,
        }
    }
    Some((word, entry))
}

/// All words of the list.
pub(crate) fn all() -> impl Iterator<Item = (&'static str, Entry)> {
    TEXT.lines().filter_map(read_line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_reads_and_no_word_stands_twice() {
        let mut seen = std::collections::HashSet::new();
        for line in TEXT.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty()) {
            let (word, entry) = read_line(line).unwrap_or_else(|| panic!("does not read: {line}"));
            assert!(entry.gender.is_some(), "no gender: {line}");
            assert!(seen.insert(without_yo(word)), "stands twice: {word}");
        }
    }

    #[test]
    fn yo_may_be_written_e() {
        assert_eq!(find("ковер").and_then(|entry| entry.genitive), Some("ковра"));
        assert_eq!(find("кухня").map(Entry::place), Some(PlaceSense::Upon));
    }
}
