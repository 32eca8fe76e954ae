//! The verbs of a text: where its clauses begin, and what each asks to do with what it names.

use std::ops::Range;

use super::Relation;
use super::vocabulary::{Meaning, Verb, is_wished, longest, verbs};
use crate::sets::Set;
use crate::units::name_key;
use crate::words::word_ranges;

/// What a verb does with the things that are named with it, for who finds out which things are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sort {
    /// The robot goes to what is named.
    Go,
    /// Something is fetched; "on" and "in" tell where it is.
    Carry,
    /// Something is set down; "on" and "in" tell whither.
    Put,
    Door,
    Switch,
    Find,
    /// The robot leaves what is named, or leaves something somewhere.
    Leave,
    Other,
}

impl Sort {
    pub(super) fn of(verb: Verb) -> Self {
        match verb {
            Verb::GoTo | Verb::Visit | Verb::Face | Verb::Charge => Self::Go,
            Verb::Leave => Self::Leave,
            Verb::Bring | Verb::Get | Verb::Need | Verb::Take | Verb::ThrowAway => Self::Carry,
            Verb::Put | Verb::SetDown | Verb::Move | Verb::Clear | Verb::Return | Verb::PutBack => {
                Self::Put
            }
            Verb::Open | Verb::Close | Verb::Lock | Verb::Unlock => Self::Door,
            Verb::SwitchOn | Verb::SwitchOff => Self::Switch,
            Verb::Find => Self::Find,
            Verb::Tidy
            | Verb::Clean
            | Verb::CallOperator
            | Verb::CallLift
            | Verb::Report
            | Verb::Stop
            | Verb::Needless
            | Verb::Wait
            | Verb::Unable => Self::Other,
        }
    }
}

pub(super) fn keys_of(text: &str, words: &[Range<usize>]) -> Vec<String> {
    words.iter().map(|range| name_key(&text[range.clone()])).collect()
}

/// The meaning of the longest phrase at a word.
pub(super) fn meaning_at(keys: &[String], at: usize) -> Option<(usize, Meaning)> {
    longest(&keys[at..].iter().map(String::as_str))
}

/// Words of a relative clause that say no more than the preposition after them.
pub(super) static RELATIVE: Set = Set::named("RelativeOpening");

/// Whether a word begins what only describes: «что на столе», "the one by the window".
pub(super) fn is_relative(keys: &[String], at: usize) -> bool {
    static NEAREST: Set = Set::named("NearestStem");
    static POINTING: Set = Set::named("DescribingOpening");
    let said = |length: usize| keys.get(at..at + length).map(|words| words.join(" "));
    keys.get(at).is_some_and(|key| {
        POINTING.contains(&key.as_str()) || NEAREST.iter().any(|stem| key.starts_with(stem))
    }) || (1..=3).filter_map(said).any(|words| RELATIVE.contains(&words.as_str()))
}

/// A verb of a text.
struct Found {
    verb: Verb,
    /// Bytes of the verb, and of what joins its clause to the one before.
    at: Range<usize>,
    joined: Range<usize>,
}

/// The verbs that begin the clauses of a text, with their places in it; else the first verb anywhere.
fn found(text: &str) -> Vec<Found> {
    let words = word_ranges(text);
    let keys = keys_of(text, &words);
    let mut found = Vec::new();
    let mut anywhere = None;
    let (mut at, mut begins) = (0, true);
    let mut joint: Option<usize> = None;
    while at < keys.len() {
        let (taken, meaning) = match meaning_at(&keys, at) {
            Some((taken, meaning)) => (taken, Some(meaning)),
            None => (1, None),
        };
        if let Some(Meaning::Verb(verb)) = meaning {
            let span = words[at].start..words[at + taken - 1].end;
            let joined = joint.unwrap_or(span.start)..span.end;
            if begins {
                found.push(Found { verb, at: span, joined });
            } else {
                anywhere.get_or_insert(Found { verb, at: span.clone(), joined: span });
            }
        }
        joint = match meaning {
            Some(Meaning::And) => joint.or(Some(words[at].start)),
            Some(Meaning::Filler) => joint,
            _ => None,
        };
        at += taken;
        let comma = at < words.len()
            && text[words[at - 1].end..words[at].start].contains([',', ';', '.', '!', ':']);
        begins = match meaning {
            Some(Meaning::And) => true,
            // «мне нужно, чтобы ты принёс»: what is needed is told by the next verb, or by a noun.
            Some(Meaning::Verb(Verb::Need)) => true,
            Some(Meaning::Filler | Meaning::Me) => begins || comma,
            _ => comma,
        };
    }
    if found.is_empty() {
        found.extend(anywhere);
    }
    found
}

/// The clauses of a text: where each verb begins, and of which sort it is.
#[must_use]
pub(crate) fn clauses(text: &str) -> Vec<(usize, Sort)> {
    found(text).into_iter().map(|f| (f.at.start, Sort::of(f.verb))).collect()
}

/// Whether a text begins with a verb that opens.
pub(crate) fn opens(text: &str) -> bool {
    first(text).is_some_and(|(_, verb)| verb == Verb::Open)
}

/// Where the verbs of a text stand that begin its clauses.
pub(crate) fn verbs_of(text: &str) -> Vec<Range<usize>> {
    found(text).into_iter().map(|f| f.at).collect()
}

/// Whether a text has a verb of command anywhere.
#[must_use]
pub fn has_verb(text: &str) -> bool {
    found(text).iter().any(|f| !matches!(f.verb, Verb::Need | Verb::Report))
}

/// The verb with which a text begins, small words aside.
pub(super) fn first(text: &str) -> Option<(Range<usize>, Verb)> {
    let words = word_ranges(text);
    let words = &words[..words.len().min(14)];
    let keys = keys_of(text, words);
    let mut at = 0;
    while at < keys.len() {
        match meaning_at(&keys, at)? {
            (taken, Meaning::Filler | Meaning::Me | Meaning::And) => at += taken,
            (taken, Meaning::Verb(verb)) => {
                let tells = tells_of_the_past(&keys, at);
                return (!tells).then(|| (words[at].start..words[at + taken - 1].end, verb));
            }
            _ => return None,
        }
    }
    None
}

/// Whether a Russian verb tells or asks what was done: «ты закрыл дверь?».
fn tells_of_the_past(keys: &[String], at: usize) -> bool {
    static WISHES: Set = Set::named("Wishing");
    is_wished(&keys[at]) && !keys[..at].iter().any(|key| WISHES.contains(&key.as_str()))
}

/// Whether a text begins with what is not to be done: «не открывай дверь», "don't go there".
pub(crate) fn forbids(text: &str) -> bool {
    let words = word_ranges(text);
    let keys = keys_of(text, &words[..words.len().min(14)]);
    let (mut at, mut forbids) = (0, false);
    while at < keys.len() {
        match meaning_at(&keys, at) {
            Some((taken, Meaning::Filler | Meaning::Me | Meaning::And)) => at += taken,
            Some((taken, Meaning::Not)) => {
                forbids = true;
                at += taken;
            }
            Some((_, Meaning::Verb(_))) => return forbids,
            _ => return false,
        }
    }
    false
}

/// The text with the verbs that begin its clauses blanked out, and a semicolon for each, every other word where it was:
/// in "Open the lab door" the first word orders, in "Close the open door" the third describes.
#[must_use]
pub(crate) fn without_verbs(text: &str) -> String {
    let mut blanked = text.to_owned();
    for Found { joined, .. } in found(text) {
        let blank = format!(";{}", " ".repeat(joined.len().saturating_sub(1)));
        blanked.replace_range(joined, &blank);
    }
    blanked
}

/// Whether a word means something in a command by itself.
#[must_use]
pub(crate) fn is_known(keys: &[String], at: usize) -> bool {
    meaning_at(keys, at).is_some()
}

/// Whether a preposition of commands stands at a word.
#[must_use]
pub(crate) fn link_at(keys: &[String], at: usize) -> bool {
    at < keys.len() && matches!(meaning_at(keys, at), Some((_, Meaning::Link(_))))
}

/// Whether the preposition at a word leaves open whether something goes into a thing, onto it or beside it: «к», "to".
#[must_use]
pub(crate) fn link_is_open(keys: &[String], at: usize) -> bool {
    let link = (at < keys.len()).then(|| meaning_at(keys, at)).flatten();
    matches!(link, Some((_, Meaning::Link(link))) if link.relation == Relation::At)
}

/// How many words at the beginning of some are politeness.
#[must_use]
pub(crate) fn small_words(keys: &[String]) -> usize {
    match longest(&keys.iter().map(String::as_str)) {
        Some((taken, Meaning::Filler)) => taken,
        _ => 0,
    }
}

/// How many words before one are a preposition of commands.
#[must_use]
pub(crate) fn link_before(keys: &[String], at: usize) -> usize {
    let is_link = |from: usize| matches!(meaning_at(keys, from), Some((taken, Meaning::Link(_))) if from + taken == at);
    (1..=3.min(at)).rev().find(|n| is_link(at - n)).unwrap_or(0)
}

/// A mistyped verb at the beginning of a text: where it stands, and the verb that was meant, if it is plain.
#[must_use]
pub fn likely_verb(text: &str) -> Option<(Range<usize>, &'static str)> {
    let words = word_ranges(text);
    let keys = keys_of(text, &words);
    let mut at = 0;
    while let Some((taken, Meaning::Filler | Meaning::Me)) =
        (at < keys.len()).then(|| meaning_at(&keys, at)).flatten()
    {
        at += taken;
    }
    let key = keys.get(at)?;
    let length = key.chars().count();
    let allowed = if length >= 7 { 2 } else { 1 };
    if length < 4 || meaning_at(&keys, at).is_some() {
        return None;
    }
    let off = |verb: &&str| strsim::damerau_levenshtein(&name_key(verb), key);
    let nearest = verbs().filter(|verb| !verb.contains(' ')).min_by_key(off)?;
    (off(&nearest) <= allowed).then(|| (words[at].clone(), nearest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistyped_verb_is_guessed_where_it_is_plain() {
        assert_eq!(likely_verb("Паезжай на кухню").map(|(_, v)| v), Some("поезжай"));
        assert_eq!(likely_verb("please brnig the cup").map(|(_, v)| v), Some("bring"));
        assert_eq!(likely_verb("Где чашка?"), None);
        assert_eq!(likely_verb("принеси чашку"), None);
    }

    #[test]
    fn every_clause_begins_with_its_verb() {
        let sorts = |text| clauses(text).into_iter().map(|(_, sort)| sort).collect::<Vec<_>>();
        assert_eq!(sorts("Возьми книгу и открой дверь"), [Sort::Carry, Sort::Door]);
        assert_eq!(
            sorts("Could you please go there, then close the open door"),
            [Sort::Go, Sort::Door]
        );
        assert_eq!(sorts("лекарство мне принеси"), [Sort::Carry]);
    }
}
