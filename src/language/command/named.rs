//! Names of the map that have words of orders in them: "patrol_B", «Склад принеси-подай», "the clean and tidy corner".
//!
//! Such a word is marked, so that no reader takes it for a verb or a joint, however the text is put before it is heard.
//!
//! Invariant: marks are within words and show nothing; who looks for names looks past them.

use std::borrow::Cow;
use std::hash::Hash;

use super::vocabulary::{Meaning, longest};
use super::{has_verb, is_too_long};
use crate::words::{FormIndex, OPAQUE, word_keys, word_ranges};

/// A text with the words of orders marked that stand within names; as it is where no verb would be left.
#[must_use]
pub fn with_names_marked<'t, T: Clone + Eq + Hash>(
    text: &'t str,
    index: &FormIndex<T>,
) -> Cow<'t, str> {
    if is_too_long(text) {
        return Cow::Borrowed(text);
    }
    let (words, keys) = (word_ranges(text), word_keys(text));
    let mut marks = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let taken = index.length_at(text, &words, at);
        if taken > 1 {
            marks.extend((at..at + taken).filter(|&n| parts(&keys[n..])).map(|n| &words[n]));
        }
        at += taken.max(1);
    }
    if marks.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut marked = text.to_owned();
    for word in marks.into_iter().rev() {
        let first = text[word.clone()].chars().next().map_or(0, char::len_utf8);
        marked.insert(word.start + first, OPAQUE);
    }
    match has_verb(text) && !has_verb(&marked) {
        true => Cow::Borrowed(text),
        false => Cow::Owned(marked),
    }
}

/// Whether a word would begin or join clauses.
fn parts(keys: &[String]) -> bool {
    let found = longest(&keys.iter().map(String::as_str));
    matches!(found, Some((_, Meaning::Verb(_) | Meaning::And | Meaning::Not)))
}

/// A text without marks.
#[must_use]
pub fn without_marks(text: &str) -> Cow<'_, str> {
    match text.contains(OPAQUE) {
        true => Cow::Owned(text.replace(OPAQUE, "")),
        false => Cow::Borrowed(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::{NounPhrase, WordHints};

    #[test]
    fn words_of_orders_are_marked_within_names_alone() {
        let mut index = FormIndex::default();
        for name in ["patrol_B", "Open office", "Склад принеси и положи", "Kitchen"]
        {
            index.insert(&NounPhrase::parse(name, &WordHints::default()), name);
        }
        for (text, marked) in [
            ("Go to patrol_B, then to the kitchen", Some("p|atrol_B")),
            ("Open office door", None),
            ("Close the open office", Some("o|pen office")),
            ("Поезжай на склад принеси и положи", Some("п|ринеси и| п|оложи")),
            ("Patrol the kitchen and open the door", None),
        ] {
            let shown = with_names_marked(text, &index).replace(OPAQUE, "|");
            assert_eq!(without_marks(&with_names_marked(text, &index)), text);
            match marked {
                Some(marked) => assert!(shown.contains(marked), "{shown}"),
                None => assert_eq!(shown, text),
            }
        }
    }
}
