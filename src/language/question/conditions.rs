//! The words by which an order hinges on something, and where a second condition begins.

use crate::command::is_order;
use crate::sets::Set;
use crate::words::{phrase_at, word_keys, word_ranges};

/// What refers to a condition that was asked: it is so, or it is not.
pub(super) static SO: Set = Set::named("IfSo");

/// The same where it is not so.
pub(super) static NOT_SO: Set = Set::named("IfNotSo");

/// What an order hinges on begins so.
pub(super) static IF: Set = Set::named("If");

/// What is waited for; of the person and the robot itself nothing is known beforehand.
pub(super) static WHEN: Set = Set::named("WhenAsCondition");

/// An order under a condition behind another one.
pub(super) struct Another<'t> {
    pub(super) before: &'t str,
    pub(super) text: &'t str,
    /// «а если», "but if": only where the first does not hold.
    pub(super) instead: bool,
}

/// The last condition of a text that begins with one; none where that is its only one.
pub(super) fn another(text: &str) -> Option<Another<'_>> {
    static BESIDE: Set = Set::named("And");
    static INSTEAD: Set = Set::named("ButOrOr");
    let (words, keys) = (word_ranges(text), word_keys(text));
    let is = |n: usize, all: &[&str]| keys.get(n).is_some_and(|key| all.contains(&key.as_str()));
    let parted = |n: usize| text[words[n - 1].end..words[n].start].contains([',', ';', '.']);
    let phrase = |n: usize, all: &[&str]| all.iter().filter_map(|p| phrase_at(&keys, n, p)).max();
    // "If so, …", but "if it is on the shelf".
    let refers = |n: usize| {
        let taken = phrase(n, &SO).max(phrase(n, &NOT_SO));
        taken.is_some_and(|taken| n + taken >= keys.len() || parted(n + taken))
    };
    let hinges = |n: usize| phrase(n, &IF).is_some() && !refers(n);
    let first = usize::from(is(0, &BESIDE) || is(0, &INSTEAD));
    if !hinges(first) {
        return None;
    }
    let (at, begin) = (first + 2..keys.len()).rev().filter(|&n| parted(n)).find_map(|n| {
        let begin = n + usize::from(is(n, &BESIDE) || is(n, &INSTEAD));
        hinges(begin).then_some((n, begin))
    })?;
    // "If it is open, and if it is on the table, bring it" is one condition of two parts.
    let is_ordered = (first + 1..at).any(|n| is_order(&text[words[n].start..words[at - 1].end]));
    is_ordered.then(|| Another {
        before: &text[..words[at - 1].end],
        text: &text[words[begin].start..],
        instead: !is(at, &BESIDE),
    })
}
