//! Words that people say to be polite and that ask nothing: greetings, thanks, farewells.
//!
//! Invariant: only a sentence of nothing else is one.

use super::mark::Mark;
use super::query::{Courtesy, Query};
use super::vocabulary;
use crate::words::word_keys;

/// The courtesy that a sentence is; of several the last one that wants an answer.
pub(super) fn of(text: &str) -> Option<Courtesy> {
    let keys = word_keys(text);
    let (mut at, mut said) = (0, None);
    let is_polite = |mark| matches!(mark, Mark::Polite(_) | Mark::BesidePolite);
    while at < keys.len() {
        let (taken, mark) = vocabulary::begun(&keys[at..], is_polite)?;
        if let Mark::Polite(courtesy) = mark {
            said = Some(courtesy);
        }
        at += taken;
    }
    said
}

/// As a query, where a sentence is nothing but polite.
pub(super) fn query(text: &str) -> Option<Query> {
    of(text).map(Query::Courtesy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_polite_sentences_are_courtesies() {
        let check =
            |text: &str, expected: Option<Courtesy>| assert_eq!(of(text), expected, "{text}");
        check("Спасибо!", Some(Courtesy::Thanks));
        check("Здравствуй, робот", Some(Courtesy::Greeting));
        check("Okay, thank you very much!", Some(Courtesy::Thanks));
        check("Спасибо, а где стол?", None);
        check("робот", None);
        check("", None);
    }
}
