//! A text by its words, and what each does in an order, for who puts it plainly.

use std::ops::Range;

use crate::units::{InOrder as _, name_key};
use crate::words::word_ranges;

/// What words do in an order, as patterns name it.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident $name:literal),+ $(,)?) => {
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(crate) enum Kind {
            $($(#[$doc])* $kind),+
        }

        impl Kind {
            pub(super) const NAMED: &'static [(&'static str, Self)] = &[$(($name, Self::$kind)),+];
        }
    };
}

kinds! {
    Verb "verb",
    /// A verb that tells what to do, and not what is needed.
    Act "act",
    Go "go",
    Carry "carry",
    Put "put",
    /// What leaves a thing elsewhere than it was.
    Move "move",
    Door "door",
    /// What is no verb of doors.
    Deed "deed",
    Switch "switch",
    Find "find",
    Take "take",
    /// A verb of going, visiting, turning.
    Approach "approach",
    Face "face",
    Wait "wait",
    Stop "stop",
    Leave "leave",
    /// A preposition.
    Link "link",
    /// A preposition that says no more than where: «к», "to".
    At "at",
    Via "via",
    /// «лицом к».
    Facing "facing",
    /// A preposition of what lies between, beside, before or behind something.
    Beside "beside",
    Not "not",
    Needless "needless",
    /// What begins a clause that only describes.
    Relative "relative",
    Number "number",
    And "and",
    /// Politeness, articles.
    Small "small",
    Me "me",
    All "all",
    /// What means something else, and is no verb and no preposition.
    Other "other",
    /// «всё», which is not «все».
    Everything "everything",
}

/// How many words a phrase takes, and what it does.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sense {
    pub(crate) length: usize,
    pub(crate) kinds: Vec<Kind>,
}

/// A text by its words.
pub(crate) struct Words<'t> {
    pub(crate) text: &'t str,
    pub(crate) at: Vec<Range<usize>>,
    pub(crate) keys: Vec<String>,
    /// What each word does, where it is read as an order.
    pub(crate) senses: Vec<Sense>,
}

impl<'t> Words<'t> {
    pub(crate) fn of(text: &'t str) -> Option<Self> {
        let at = word_ranges(text);
        let keys: Vec<String> = at.iter().map(|range| name_key(&text[range.clone()])).collect();
        (!keys.is_empty()).then_some(Self { text, at, keys, senses: Vec::new() })
    }

    pub(crate) fn is(&self, n: usize, all: &[&str]) -> bool {
        self.keys.get(n).is_some_and(|key| all.contains(&key.as_str()))
    }

    pub(crate) fn find(&self, all: &[&str]) -> Option<usize> {
        (0..self.keys.len()).find(|n| self.is(*n, all))
    }

    /// The text of some words, where there are any.
    pub(crate) fn part(&self, words: Range<usize>) -> Option<&'t str> {
        let last = words.end.checked_sub(1).filter(|last| words.start <= *last)?;
        Some(&self.text[self.at.get(words.start)?.start..self.at.get(last)?.end])
    }

    /// Whether a mark stands before a word, or the text begins or ends there.
    pub(crate) fn parted(&self, n: usize) -> bool {
        match (n.checked_sub(1).and_then(|before| self.at.get(before)), self.at.get(n)) {
            (Some(before), Some(word)) => {
                self.text[before.end..word.start].contains([',', ';', '.', '!', ':', '–', '—'])
            }
            _ => true,
        }
    }

    /// The text with some words replaced, the last first.
    pub(crate) fn replaced(&self, mut changes: Vec<(Range<usize>, String)>) -> String {
        changes.order_by_key(|(words, _)| std::cmp::Reverse(words.start));
        let mut text = self.text.to_owned();
        for (words, by) in changes {
            text.replace_range(self.at[words.start].start..self.at[words.end - 1].end, &by);
        }
        text
    }
}

/// The words that stand in the first of two texts more often than in the second.
pub(crate) fn lost(before: &[String], after: &[String]) -> Vec<String> {
    let mut left: Vec<&String> = after.iter().collect();
    let mut is_lost = |key: &&String| match left.iter().position(|other| other == key) {
        Some(at) => {
            left.swap_remove(at);
            false
        }
        None => true,
    };
    before.iter().filter(|key| is_lost(key)).cloned().collect()
}
