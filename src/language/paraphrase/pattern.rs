//! Which words of a sentence fill the parts of a pattern.

use std::ops::Range;

use super::words::{Kind, Words};
use crate::words::Language;

/// One word of a pattern: all of it, or its beginning or end, where the rest is carried over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Word {
    Whole(String),
    Begins(String),
    Ends(String),
    /// What a phrase does in an order, of the language of the file.
    Kind(Kind, Language),
    /// A place before which a mark stands, or where the text begins or ends; in a condition, a mark anywhere.
    Mark(String),
    /// A place before which no mark stands.
    Unparted,
}

impl Word {
    /// How many words it takes at a place, and what these have beside the part that the pattern tells; none where
    /// another stands.
    fn at<'w>(&self, words: &'w Words<'_>, at: usize) -> Option<(usize, &'w str)> {
        let key = || words.keys.get(at).map(String::as_str);
        match self {
            Self::Whole(word) => (word == key()?).then_some((1, "")),
            Self::Begins(stem) => Some((1, key()?.strip_prefix(stem.as_str())?)),
            Self::Ends(end) => Some((1, key()?.strip_suffix(end.as_str())?)),
            Self::Kind(kind, language) => {
                let sense = words.senses.get(at)?;
                let is_it = sense.kinds.contains(kind) && Language::of(key()?) == *language;
                is_it.then_some((sense.length, ""))
            }
            Self::Mark(_) => words.parted(at).then_some((0, "")),
            Self::Unparted => (!words.parted(at)).then_some((0, "")),
        }
    }
}

/// Words one after the other.
pub(super) type Run = Vec<Word>;

#[derive(Debug)]
pub(super) enum Part {
    /// One of these runs of words.
    Words { choices: Vec<Run>, optional: bool },
    /// So many of these runs of words one behind the other as there are, which may be none.
    Repeated { choices: Vec<Run> },
    /// Any words, so many, among which none of these stand, nor a mark where they are of one clause.
    Gap { least: usize, most: usize, without: Vec<Run>, is_clause: bool },
}

/// What a part was filled with.
#[derive(Debug)]
pub(super) struct Taken {
    pub(super) words: Range<usize>,
    pub(super) choice: usize,
    /// What a word had beside the part of it that the pattern tells.
    pub(super) rest: String,
}

#[derive(Debug)]
pub(super) struct Pattern {
    /// Whether a sentence may have words before these, and behind them.
    pub(super) is_open: (bool, bool),
    pub(super) parts: Vec<Part>,
}

/// Where a run ends that stands at a place, and the rest of its words.
fn run_at(run: &Run, words: &Words<'_>, at: usize) -> Option<(usize, String)> {
    run.iter().try_fold((at, String::new()), |(at, rests), word| {
        let (length, rest) = word.at(words, at)?;
        Some((at + length, rests + rest))
    })
}

/// Whether a run, or a punctuation mark, stands among some words.
pub(super) fn stands_among(run: &Run, words: &Words<'_>, among: &Range<usize>) -> bool {
    if let [Word::Mark(mark)] = &run[..] {
        let from = among.start.checked_sub(1).map_or(0, |before| words.at[before].end);
        let to = words.at.get(among.end).map_or(words.text.len(), |after| after.start);
        return words.text[from..to].contains(mark.as_str());
    }
    // A phrase of some kind may go on behind them.
    let is_kind = matches!(run[..], [Word::Kind(..)]);
    among
        .clone()
        .any(|at| run_at(run, words, at).is_some_and(|(end, _)| is_kind || end <= among.end))
}

impl Part {
    /// In which ways it can be filled from a word on, the first to be tried first.
    fn filled(&self, words: &Words<'_>, at: usize) -> Vec<Taken> {
        let taken = |words: Range<usize>, choice, rest| Taken { words, choice, rest };
        match self {
            Self::Words { choices, optional } => {
                let mut found: Vec<Taken> = choices
                    .iter()
                    .enumerate()
                    .filter_map(|(choice, run)| {
                        let (end, rest) = run_at(run, words, at)?;
                        Some(taken(at..end, choice, rest))
                    })
                    .collect();
                found.extend(optional.then(|| taken(at..at, 0, String::new())));
                found
            }
            Self::Repeated { choices } => {
                let mut ends = vec![at];
                let next = |at| choices.iter().find_map(|run| Some(run_at(run, words, at)?.0));
                let mut end = at;
                while let Some(further) = next(end).filter(|further| *further > end) {
                    ends.push(further);
                    end = further;
                }
                ends.into_iter().rev().map(|end| taken(at..end, 0, String::new())).collect()
            }
            Self::Gap { least, most, without, is_clause } => {
                let longest = words.keys.len().saturating_sub(at).min(*most);
                let keeps = |length: &usize| {
                    let is_parted = *is_clause && (at + 1..at + length).any(|n| words.parted(n));
                    let has = |run| stands_among(run, words, &(at..at + length));
                    !is_parted && !without.iter().any(has)
                };
                let lengths = (*least..=longest).take_while(keeps);
                lengths.map(|length| taken(at..at + length, 0, String::new())).collect()
            }
        }
    }

    /// The words of which one stands in every sentence that it fills, where there are such.
    pub(super) fn required(&self) -> Option<Vec<&str>> {
        let Self::Words { choices, optional: false } = self else { return None };
        let whole = |word: &Word| match word {
            Word::Whole(word) => Some(word.len()),
            _ => None,
        };
        choices
            .iter()
            .map(|run| match run.iter().max_by_key(|word| whole(word))? {
                Word::Whole(word) => Some(word.as_str()),
                _ => None,
            })
            .collect()
    }
}

impl Pattern {
    /// What each part is filled with: as far to the left as can be, gaps as short as can be.
    pub(super) fn fit(&self, words: &Words<'_>) -> Option<Vec<Taken>> {
        let length = words.keys.len();
        let failed = vec![false; self.parts.len() * (length + 1)];
        let mut search = Search { pattern: self, words, failed, taken: Vec::new() };
        let starts = if self.is_open.0 { length } else { 1 };
        (0..starts).any(|at| search.fits(0, at)).then_some(search.taken)
    }
}

struct Search<'a> {
    pattern: &'a Pattern,
    words: &'a Words<'a>,
    /// Which parts cannot be filled from which word on: what is before them does not matter.
    failed: Vec<bool>,
    taken: Vec<Taken>,
}

impl Search<'_> {
    fn fits(&mut self, part: usize, at: usize) -> bool {
        let length = self.words.keys.len();
        let Some(next) = self.pattern.parts.get(part) else {
            return self.pattern.is_open.1 || at == length;
        };
        // A phrase of some kind may take more words than there are.
        let place = part * (length + 1) + at.min(length);
        if self.failed[place] {
            return false;
        }
        for taken in next.filled(self.words, at) {
            let end = taken.words.end;
            self.taken.push(taken);
            if self.fits(part + 1, end) {
                return true;
            }
            self.taken.pop();
        }
        self.failed[place] = true;
        false
    }
}
