//! An order that its condition cuts off before anything is named: «Принеси, если дверь открыта, чашку».
//!
//! Invariant: nothing is left out; the condition stands behind what it cut off, and before what is to be done otherwise.

use super::conditions::{IF, NOT_SO, WHEN};
use crate::command::{is_order, names_nothing};
use crate::words::{phrase_at, word_keys, word_ranges};

/// The text with its condition behind the order; none where the order is whole.
pub(super) fn mended(text: &str) -> Option<String> {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let parted = |n: usize| text[words[n - 1].end..words[n].start].contains(',');
    let begins = |n: usize, all: &[&str]| all.iter().any(|p| phrase_at(&keys, n, p).is_some());
    let at = (1..keys.len()).find(|&n| parted(n) && (begins(n, &IF) || begins(n, &WHEN)))?;
    if !names_nothing(&keys[..at]) {
        return None;
    }
    let rest = (at + 2..keys.len()).find(|&n| parted(n))?;
    let goes_on = is_order(&text[words[rest].start..]) || begins(rest, &NOT_SO);
    let otherwise = (rest + 1..keys.len()).find(|&n| parted(n) && begins(n, &NOT_SO));
    let said = |from: usize, to: usize| &text[words[from].start..words[to - 1].end];
    let end = otherwise.unwrap_or(keys.len());
    let tail = otherwise.map(|n| format!(", {}", said(n, keys.len())));
    (!goes_on).then(|| {
        let (order, what, condition) = (said(0, at), said(rest, end), said(at, rest));
        format!("{order} {what}, {condition}{}", tail.unwrap_or_default())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_an_order_that_has_named_nothing_is_cut_off() {
        for (text, whole) in [
            ("Bring, if the door is open, the cup", Some("Bring the cup, if the door is open")),
            (
                "Принеси мне, если дверь открыта, чашку, иначе книгу",
                Some("Принеси мне чашку, если дверь открыта, иначе книгу"),
            ),
            ("Put, when it is shut, it on the desk", Some("Put it on the desk, when it is shut")),
            ("Bring the cup, if the door is open, or the jug", None),
            ("Wait, if the door is open, open it", None),
            ("Stop, if it is open, otherwise go on", None),
            ("Bring the cup if the door is open", None),
        ] {
            assert_eq!(mended(text).as_deref(), whole, "{text}");
        }
    }
}
