//! Which words of a sentence fill the parts of a pattern.

use std::ops::Range;

use crate::question::rule::Words;

/// One word of a pattern: all of it, or its beginning or end, where the rest is carried over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Word {
    Whole(String),
    Begins(String),
    Ends(String),
    /// A punctuation mark, which only conditions have.
    Mark(String),
}

impl Word {
    /// What the word has beside the part that the pattern tells; none where it is another.
    fn rest<'k>(&self, key: &'k str) -> Option<&'k str> {
        match self {
            Self::Whole(word) => (word == key).then_some(""),
            Self::Begins(stem) => key.strip_prefix(stem.as_str()),
            Self::Ends(end) => key.strip_suffix(end.as_str()),
            Self::Mark(_) => None,
        }
    }
}

/// Words one after the other.
pub(super) type Run = Vec<Word>;

#[derive(Debug)]
pub(super) enum Part {
    /// One of these runs of words.
    Words { choices: Vec<Run>, optional: bool },
    /// Any words, so many, among which none of these stand.
    Gap { least: usize, most: usize, without: Vec<Run> },
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

/// The rest of the words, where a run stands at a place.
fn run_at(run: &Run, keys: &[String], at: usize) -> Option<String> {
    let said = keys.get(at..at + run.len())?;
    run.iter().zip(said).map(|(word, key)| word.rest(key)).collect()
}

/// Whether a run, or a punctuation mark, stands among some words.
pub(super) fn stands_among(run: &Run, words: &Words<'_>, among: &Range<usize>) -> bool {
    if let [Word::Mark(mark)] = &run[..] {
        let from = among.start.checked_sub(1).map_or(0, |before| words.at[before].end);
        let to = words.at.get(among.end).map_or(words.text.len(), |after| after.start);
        return words.text[from..to].contains(mark.as_str());
    }
    among.clone().any(|at| at + run.len() <= among.end && run_at(run, &words.keys, at).is_some())
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
                        let rest = run_at(run, &words.keys, at)?;
                        Some(taken(at..at + run.len(), choice, rest))
                    })
                    .collect();
                found.extend(optional.then(|| taken(at..at, 0, String::new())));
                found
            }
            Self::Gap { least, most, without } => {
                let longest = (words.keys.len() - at).min(*most);
                let keeps = |length: &usize| {
                    !without.iter().any(|run| stands_among(run, words, &(at..at + length)))
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
        let place = part * (length + 1) + at;
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
