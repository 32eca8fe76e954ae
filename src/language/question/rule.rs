//! What a rule that puts a text plainly is given: the text by its words.

use std::ops::Range;

use crate::units::{InOrder as _, name_key};
use crate::words::word_ranges;

/// Puts a text plainly, where it is of the rule's construction.
pub(super) type Rule = fn(&Words<'_>) -> Option<String>;

/// A text by its words.
pub(super) struct Words<'t> {
    pub(super) text: &'t str,
    pub(super) at: Vec<Range<usize>>,
    pub(super) keys: Vec<String>,
}

impl<'t> Words<'t> {
    pub(super) fn of(text: &'t str) -> Option<Self> {
        let at = word_ranges(text);
        let keys: Vec<String> = at.iter().map(|range| name_key(&text[range.clone()])).collect();
        (!keys.is_empty()).then_some(Self { text, at, keys })
    }

    pub(super) fn is(&self, n: usize, all: &[&str]) -> bool {
        self.keys.get(n).is_some_and(|key| all.contains(&key.as_str()))
    }

    pub(super) fn find(&self, all: &[&str]) -> Option<usize> {
        (0..self.keys.len()).find(|n| self.is(*n, all))
    }

    /// The text of some words, where there are any.
    pub(super) fn part(&self, words: Range<usize>) -> Option<&'t str> {
        let last = words.end.checked_sub(1).filter(|last| words.start <= *last)?;
        Some(&self.text[self.at.get(words.start)?.start..self.at.get(last)?.end])
    }

    /// The text with some words replaced, the last first.
    pub(super) fn replaced(&self, mut changes: Vec<(Range<usize>, String)>) -> String {
        changes.order_by_key(|(words, _)| std::cmp::Reverse(words.start));
        let mut text = self.text.to_owned();
        for (words, by) in changes {
            text.replace_range(self.at[words.start].start..self.at[words.end - 1].end, &by);
        }
        text
    }
}
