//! Another than this robot that an order begins by calling: "Bob, go to the kitchen", «tinyRobot_2, поезжай к стойке».
//!
//! Invariant: what calls the robot itself, cries out or tells something is no name of another.

use super::hints::preamble;
use super::vocabulary::{Meaning, longest};
use super::{Misheard, is_too_long, waiting};
use crate::sets::set;
use crate::units::{OwnText, Source};
use crate::words::everyday::is_in_list;
use crate::words::{Language, phrase_at, readings, word_keys, word_ranges};

/// Refuses what somebody else is told to do; `is_named` tells of what the map has a name for.
///
/// # Errors
/// [`Misheard::NotMe`]
pub fn without_another(text: &str, is_named: impl Fn(&str) -> bool) -> Result<(), Misheard> {
    // "Later: bring the cup" calls nobody.
    if is_too_long(text) || waiting(text).is_some() {
        return Ok(());
    }
    let Some((told, _)) = preamble(text) else { return Ok(()) };
    let Some(name) = called(told).filter(|name| !is_named(name)) else { return Ok(()) };
    let at = text.find(name).unwrap_or_default();
    Err(Misheard::NotMe {
        name: name.to_owned(),
        text: Source::own(OwnText::Order, text),
        at: (at, name.len()).into(),
    })
}

/// The name that is all a text says, beside small words and titles: "hey Alexa", "dear Mr Smith".
fn called(told: &str) -> Option<&str> {
    /// No one is called by more words.
    const MOST: usize = 3;
    let (words, keys) = (word_ranges(told), word_keys(told));
    let (mut at, mut named) = (0, Vec::new());
    while at < keys.len() {
        let small = match longest(&keys[at..].iter().map(String::as_str)) {
            Some((taken, Meaning::Filler | Meaning::And)) => Some(taken),
            Some(_) => return None,
            None => None,
        };
        let title = || set!("Title").iter().filter_map(|title| phrase_at(&keys, at, title)).max();
        match small.or_else(title) {
            Some(taken) => at += taken,
            // «Сергей Иванович», "tinyRobot 2"
            None if is_name(&told[words[at].clone()], &keys[at])
                || !named.is_empty() && goes_on(&told[words[at].clone()]) =>
            {
                named.push(words[at].clone());
                at += 1;
            }
            None => return None,
        }
    }
    let (first, last) = (named.first()?, named.last()?);
    (named.len() <= MOST).then(|| &told[first.start..last.end])
}

/// Whether a word behind a name may be a part of it: written as names are, or a number.
fn goes_on(written: &str) -> bool {
    written.starts_with(char::is_uppercase) || written.chars().all(|c| c.is_ascii_digit())
}

/// Whether a word is written as names are, and the language has no other use for it.
fn is_name(written: &str, key: &str) -> bool {
    let letters: Vec<char> = written.chars().collect();
    let is_coded = letters.iter().any(|c| c.is_ascii_digit() || *c == '_')
        || letters.windows(2).any(|pair| pair[0].is_lowercase() && pair[1].is_uppercase());
    if is_coded {
        return letters.iter().any(|c| c.is_alphabetic());
    }
    if !letters.first().is_some_and(|c| c.is_uppercase()) || set!("NoName").contains(&key) {
        return false;
    }
    match Language::of(written) {
        Language::Russian => {
            let known = readings(key);
            let is_unknown = cfg!(feature = "rumorph") && !known.known;
            known.first_name || known.surname && !known.noun || is_unknown
        }
        Language::English => !is_in_list(key),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg_attr(not(feature = "rumorph"), ignore = "the dictionary knows which words are names")]
    fn who_else_is_called_is_told_from_what_is_only_said() {
        for (told, name) in [
            ("Bob", Some("Bob")),
            ("tinyRobot_2", Some("tinyRobot_2")),
            ("deliveryRobot_9", Some("deliveryRobot_9")),
            ("Hey Alexa", Some("Alexa")),
            ("Ok Google", Some("Google")),
            ("Mr Smith", Some("Smith")),
            ("Петя", Some("Петя")),
            ("Робот Вася", Some("Вася")),
            ("Эй, Алиса", Some("Алиса")),
            ("Сергей Иванович", Some("Сергей Иванович")),
            ("Quick", None),
            ("Careful", None),
            ("Robot", None),
            ("Робот", None),
            ("Темно", None),
            ("Холодно", None),
            ("It is cold", None),
            ("Гости пришли", None),
            ("Пожар", None),
            ("please", None),
            ("I'm Bob", None),
        ] {
            assert_eq!(called(told), name, "{told}");
        }
    }
}
