//! Sorts of things above the types of a map: "food", «посуда», "thing to cut with".
//!
//! After the hypernyms of everyday nouns. Invariant: a sort consists of kinds that the map has; a word that the map
//! itself uses is never taken from it. Which there are, and what is done
//! with the things of each, stands in `things.txt`.

use std::collections::HashSet;
use std::sync::OnceLock;

use crate::units::name_key;
use crate::words::english::plural;
pub(super) use crate::words::things::Role;
use crate::words::things::things;
use crate::words::{Language, NounPhrase, WordHints};

/// Whether a word is a sort or the kind of one, in either language; the text in [`name_key`](crate::units::name_key) form.
pub(super) fn is_a_word(key: &str) -> bool {
    static WORDS: OnceLock<HashSet<String>> = OnceLock::new();
    let words = WORDS.get_or_init(|| {
        let lists =
            things().sorts.iter().flat_map(|sort| [&sort.russian, &sort.english, &sort.members]);
        let mut words = HashSet::new();
        for word in lists.flatten() {
            match Language::of(word) {
                Language::English => words.extend([name_key(word), name_key(&plural(word))]),
                Language::Russian => {
                    let phrase = NounPhrase::parse(word, &WordHints::default());
                    words.extend(phrase.all_forms().iter().map(|(_, _, form)| name_key(form)));
                }
            }
        }
        words
    });
    words.contains(key)
}

/// A sort by its English name.
pub(super) fn sort_called(english: &str) -> Option<u16> {
    let found = things().sorts.iter().position(|sort| sort.english[0] == english);
    found.and_then(|n| u16::try_from(n).ok())
}

/// The part of a sort's things in what is done with them.
pub(super) fn role(sort: u16) -> Role {
    things().sorts.get(usize::from(sort)).map_or(Role::Patient, |sort| sort.role)
}
