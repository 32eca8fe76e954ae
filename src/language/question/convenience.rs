//! Conditions that ask nothing of the world: "if it's not too much trouble", «когда будет минутка».
//!
//! Invariant: every word of one is of the file, so that a condition under which something else holds is none of them.

use std::collections::HashSet;
use std::sync::OnceLock;

use crate::units::{Carried, carried, name_key};
use crate::words::things;

static TEXT: Carried = carried!("convenience.txt");

#[derive(Default)]
struct Words {
    begins: HashSet<String>,
    suits: HashSet<String>,
    beside: HashSet<String>,
}

fn table() -> &'static Words {
    static TABLE: OnceLock<Words> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table = Words::default();
        for entry in things::entries(&TEXT) {
            let Some((line, said)) = entry.split_once(" : ") else { continue };
            let said = things::words(said).into_iter().map(|word| name_key(&word));
            match line {
                "begins" => table.begins.extend(said),
                "suits" => table.suits.extend(said),
                _ => table.beside.extend(said),
            }
        }
        table
    })
}

/// How many words at the beginning of some are such a condition, as many as may be.
pub(super) fn length(keys: &[String]) -> Option<usize> {
    let table = table();
    keys.first().filter(|key| table.begins.contains(*key))?;
    let is_one = |key: &&String| table.suits.contains(*key) || table.beside.contains(*key);
    let taken = 1 + keys[1..].iter().take_while(is_one).count();
    keys[1..taken].iter().any(|key| table.suits.contains(key)).then_some(taken)
}

/// Where such a condition begins that ends some words.
pub(super) fn at_the_end(keys: &[String]) -> Option<usize> {
    (0..keys.len()).find(|&at| length(&keys[at..]) == Some(keys.len() - at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::word_keys;

    #[test]
    fn only_what_suits_who_is_spoken_to_asks_nothing_of_the_world() {
        for (said, is_one) in [
            ("if it's not too much trouble", true),
            ("when you have a moment", true),
            ("whenever you get a chance", true),
            ("если тебе не трудно", true),
            ("когда будет время", true),
            ("if the door is open", false),
            ("when it is there", false),
            ("if it is free", false),
            ("если она на столе", false),
            ("если стул свободен", false),
            ("time", false),
        ] {
            let keys = word_keys(said);
            assert_eq!(length(&keys) == Some(keys.len()), is_one, "{said}");
        }
    }
}
