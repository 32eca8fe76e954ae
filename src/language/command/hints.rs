//! What the words of a text tell of it before it is heard as a command: whether it is one, and when it is to be done.

use super::gathered::{gathered, gathered_of};
use super::kinds::senses;
use super::said::Said;
use super::vocabulary::{Link, Meaning, Role, Verb, longest};
use super::{Misheard, Relation, is_too_long, time, verbs};
use crate::paraphrase::{Paraphrases, Stage};
use crate::sets::{Set, set};
use crate::units::{OwnText, Source};
use crate::words::{phrase_at, word_keys, word_ranges};

/// A text that tells by a conjunction in which order it is to be done, in that order.
#[must_use]
pub fn in_time(text: &str, lines: &Paraphrases) -> Option<String> {
    if is_too_long(text) {
        return None;
    }
    let said = Said::new(text.to_owned());
    let put = lines.ordered(text, Stage::InTime, senses).map(|(text, _)| text);
    put.or_else(|| time::told_when(&said)).or_else(|| time::in_time(&said))
}

/// Whether a word tells what another than the robot does: «придёт».
pub(crate) fn is_of_another(word: &str) -> bool {
    time::is_of_another(word)
}

/// What a text waits for, behind "wait until": the words before it, and those that begin the claim.
pub(crate) fn awaited(keys: &[String]) -> Option<(usize, usize)> {
    let phrase = |n: usize| {
        let all = time::UNTIL.iter();
        all.filter_map(|until| phrase_at(keys, n, until)).max()
    };
    let (at, taken) = (1..keys.len()).find_map(|n| Some((n, phrase(n)?)))?;
    let waits = (0..at).any(|n| {
        let found = longest(&keys[n..].iter().map(String::as_str));
        matches!(found, Some((_, Meaning::Verb(Verb::Wait))))
    });
    let called = keys.get(at + taken).is_none_or(|key| set!("FirstPerson").contains(&&**key));
    (waits && !called).then_some((at, at + taken))
}

/// Refuses what is to be done at a time of the clock, or for some time.
///
/// # Errors
/// [`Misheard::Timed`]
pub fn without_clock(text: &str) -> Result<(), Misheard> {
    // What is too long is refused for that.
    if is_too_long(text) {
        return Ok(());
    }
    let said = Said::new(text.to_owned());
    let Some(words) = time::of_the_clock(&said) else { return Ok(()) };
    let bytes = said.bytes(&words);
    Err(Misheard::Timed {
        word: text[bytes.clone()].to_owned(),
        text: Source::own(OwnText::Order, text),
        at: (bytes.start, bytes.len()).into(),
    })
}

/// Whether a word, in [`name_key`](crate::units::name_key) form, is a preposition that says whither or may.
pub(crate) fn says_whither(word: &str) -> bool {
    let found = longest(&std::iter::once(word));
    found.is_some_and(|(_, meaning)| meaning.says_whither())
}

/// The place that is all a text says, with its preposition, for an order that lacked only that: "on the sofa, please",
/// "put them there: on the sofa" without the "there". English "on" and "in" say whither then.
#[must_use]
pub fn whither_alone(text: &str) -> Option<String> {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let mut at = 0;
    while let Some((taken, meaning)) = longest(&keys[at..].iter().map(String::as_str)) {
        let place = &text[words[at].start..];
        let puts = matches!(meaning, Meaning::Verb(Verb::Put | Verb::Move));
        match meaning {
            Meaning::Filler | Meaning::Pronoun | Meaning::Them | Meaning::All => {}
            Meaning::Verb(_) if puts => {}
            Meaning::OnFloor => return Some(place.to_owned()),
            Meaning::Link(Link { role: Role::Whence | Role::Via, .. }) => return None,
            Meaning::Link(_) if verbs::has_verb(place) => return None,
            Meaning::Link(Link { role: Role::Where, relation: Relation::On | Relation::In }) => {
                let behind = &text[words[at + taken - 1].end..];
                let into = if keys[at].starts_with("in") { "into" } else { "onto" };
                return Some(format!("{into}{behind}"));
            }
            Meaning::Link(_) => return Some(place.to_owned()),
            _ => return None,
        }
        at += taken;
    }
    None
}

/// Whether words say what to do and not yet to what: «Принеси мне», "could you please bring".
pub(crate) fn names_nothing(keys: &[String]) -> bool {
    let (mut at, mut has_verb) = (0, false);
    while at < keys.len() {
        match longest(&keys[at..].iter().map(String::as_str)) {
            Some((taken, Meaning::Verb(_))) => (at, has_verb) = (at + taken, true),
            Some((taken, Meaning::Filler | Meaning::Me)) => at += taken,
            _ => return false,
        }
    }
    has_verb
}

/// Whether a text names a place of the robot's own: «на базу».
pub(crate) fn has_haunt(text: &str) -> bool {
    let keys = word_keys(text);
    (0..keys.len()).any(|n| {
        let found = longest(&keys[n..].iter().map(String::as_str));
        matches!(found, Some((_, Meaning::Haunt(_))))
    })
}

/// Whether a text names a place of the robot's own and nothing else.
pub(crate) fn is_haunt(text: &str) -> bool {
    let keys = word_keys(text);
    let found = longest(&keys.iter().map(String::as_str));
    matches!(found, Some((taken, Meaning::Haunt(_))) if taken == keys.len())
}

/// Whether a text begins with what is to be done: small words aside, its first word is a verb of command.
#[must_use]
pub fn is_command(text: &str, lines: &Paraphrases) -> bool {
    let (text, _) = gathered_of(text, lines);
    verbs::first(&text).is_some() || verbs::forbids(&text)
}

/// Whether a text begins with a verb that orders, though words of a question begin so too: "Find the cup",
/// "Hang the umbrella on the rack". What ends in a question mark asks.
#[must_use]
pub fn is_order(text: &str) -> bool {
    is_order_by(text, &Paraphrases::built_in())
}

/// The same, where lines of the user's own may put it plainly.
#[must_use]
pub fn is_order_by(text: &str, lines: &Paraphrases) -> bool {
    let (gathered, _) = gathered_of(text, lines);
    let verb = verbs::first(&gathered).map(|(_, verb)| verb);
    match verb {
        None | Some(Verb::Need | Verb::Report | Verb::Unable) => false,
        Some(Verb::Find) => true,
        Some(_) => !text.trim_end().ends_with('?'),
    }
}

/// What only tells, and the order behind its mark.
#[must_use]
pub fn preamble(sentence: &str) -> Option<(&str, &str)> {
    /// What begins so says when, and is part of the order.
    static WHEN: Set = Set::named("BeginsBound");
    let first = word_keys(sentence).into_iter().next();
    // "Don't go through the hall, go to …": what is forbidden is told as a bound of the order.
    let bounds = verbs::forbids(&gathered(sentence));
    if is_order(sentence) || bounds || first.is_some_and(|word| WHEN.contains(&word.as_str())) {
        return None;
    }
    let marks = sentence.match_indices([',', '.', ';', '!', '–', '—', ':']);
    let dashes = sentence.match_indices(" - ");
    marks
        .chain(dashes)
        .map(|(at, mark)| (&sentence[..at], sentence[at + mark.len()..].trim_start()))
        .find(|(told, order)| !told.trim().is_empty() && is_order(order))
}
