//! More constructions put plainly, by their words in order: what a room contains, doors to the outside, what shares a
//! place with a thing. A part of [`super::rephrase`].

use crate::language::words::{Language, word_ranges};
use crate::units::name_key;

/// Beginnings that another beginning means; what follows stays.
const BEGINNINGS: [(&str, &str); 12] = [
    ("what do we have more of", "are there more"),
    ("what is there more of", "are there more"),
    ("what are there more of", "are there more"),
    ("which things share a surface with", "what else is on the same piece of furniture as"),
    ("what shares a surface with", "what else is on the same piece of furniture as"),
    ("which doors lead outside", "which are the exits"),
    ("what doors lead outside", "which are the exits"),
    ("which door leads outside", "where is the exit"),
    ("does any door lead outside", "is there an exit"),
    ("do any doors lead outside", "is there an exit"),
    ("does a door lead outside", "is there an exit"),
    ("where should i look for", "where is"),
];

/// Sentences with one gap: what stands in it goes into the gap of the other.
const FRAMES: [(&str, &str, &str, &str); 21] = [
    ("what does", "contain", "what is in", ""),
    ("what do", "contain", "what is in", ""),
    ("which things does", "contain", "what is in", ""),
    ("what else is where", "is", "what else is on the same piece of furniture as", ""),
    ("what is lying where", "is", "what else is on the same piece of furniture as", ""),
    ("which rooms does", "connect", "what does", "join"),
    ("which rooms does", "join", "what does", "join"),
    ("can i go outside from", "", "is there an exit in", ""),
    ("can one go outside from", "", "is there an exit in", ""),
    ("can i leave the house directly from", "", "is there an exit in", ""),
    ("can i leave the house from", "", "is there an exit in", ""),
    ("can i get outside from", "", "is there an exit in", ""),
    ("ведет ли какая нибудь дверь на улицу", "", "есть ли выход", ""),
    ("ведет ли какая нибудь дверь наружу", "", "есть ли выход", ""),
    ("можно ли выйти из дома прямо с", "", "есть ли выход с", ""),
    ("можно ли выйти из дома прямо из", "", "есть ли выход из", ""),
    ("что содержит", "", "что внутри", ""),
    ("где искать", "", "где", ""),
    ("где мне искать", "", "где", ""),
    ("что еще лежит там же где и", "", "что ещё лежит на том же предмете мебели что и", ""),
    ("что еще лежит там же где", "", "что ещё лежит на том же предмете мебели что и", ""),
];

/// A text in the words of the first construction that it is.
pub(super) fn plain(text: &str) -> Option<String> {
    let at = word_ranges(text);
    let keys: Vec<String> = at.iter().map(|range| name_key(&text[range.clone()])).collect();
    let starts = |words: &[&str]| {
        words.len() <= keys.len() && words.iter().zip(&keys).all(|(word, key)| word == key)
    };
    let rest = |from: usize, to: usize| match from < to {
        true => text[at[from].start..at[to - 1].end].to_owned(),
        false => String::new(),
    };
    for (said, meant) in BEGINNINGS {
        let said: Vec<&str> = said.split(' ').collect();
        if starts(&said) {
            return Some(format!("{meant} {}?", rest(said.len(), keys.len())));
        }
    }
    for (start, end, before, after) in FRAMES {
        let start: Vec<&str> = start.split(' ').collect();
        let ends = end.is_empty() || keys.last().is_some_and(|key| key == end);
        let upto = keys.len().saturating_sub(usize::from(!end.is_empty()));
        if starts(&start) && ends {
            return Some(
                format!("{before} {} {after}", rest(start.len(), upto)).trim_end().to_owned() + "?",
            );
        }
    }
    filler(text, &keys, &at)
}

/// Words that say nothing more: "How many rooms have paintings in them?", "both a bed and a desk".
fn filler(text: &str, keys: &[String], at: &[std::ops::Range<usize>]) -> Option<String> {
    if Language::of(text) != Language::English {
        return None;
    }
    let is = |n: usize, all: &[&str]| keys.get(n).is_some_and(|key| all.contains(&key.as_str()));
    let last = keys.len().checked_sub(1)?;
    let rooms = keys.iter().any(|key| ["rooms", "room"].contains(&key.as_str()));
    let have = keys.iter().any(|key| ["have", "has", "contain"].contains(&key.as_str()));
    if last > 2 && rooms && have && is(last, &["them", "it"]) && is(last - 1, &["in", "inside"]) {
        return Some(format!("{}?", &text[..at[last - 2].end]));
    }
    let both = (0..keys.len()).find(|n| is(*n, &["both"]) && is(*n + 1, &["a", "an"]))?;
    let and = (both..keys.len()).any(|n| is(n, &["and"]));
    and.then(|| format!("{}{}", &text[..at[both].start], &text[at[both + 1].start..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructions_are_put_plainly() {
        let check = |text: &str, meant: &str| assert_eq!(plain(text).as_deref(), Some(meant));
        check("What does the bedroom contain?", "what is in the bedroom?");
        check("Which rooms does Door 1 connect?", "what does Door 1 join?");
        check("What do we have more of, chairs or books?", "are there more chairs or books?");
        check("How many rooms have paintings in them?", "How many rooms have paintings?");
        check("Does the room have both a bed and a desk?", "Does the room have a bed and a desk?");
        check("Где искать статуэтку?", "где статуэтку?");
        assert_eq!(plain("Where are both chairs?"), None);
        assert_eq!(plain("in it"), None);
        assert_eq!(plain(""), None);
    }
}
