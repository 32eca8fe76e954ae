//! The verbs of a text: where its clauses begin, and what each asks to do with what it names.

use std::borrow::Cow;
use std::ops::Range;

use super::is_too_long;
use super::spoken;
use super::vocabulary::{Meaning, Verb, longest, verbs};
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
            Verb::GoTo | Verb::Face | Verb::Charge => Self::Go,
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
            | Verb::Wait
            | Verb::Unable => Self::Other,
        }
    }
}

/// Verbs whose second half may stand behind what they are done to: "turn the lamp on".
const SPLIT: &[(&str, &[&str])] = &[
    ("turn", &["on", "off", "out"]),
    ("switch", &["on", "off"]),
    ("power", &["on", "off", "up", "down"]),
    ("pick", &["up"]),
    ("lift", &["up"]),
    ("put", &["down", "back", "away"]),
    ("place", &["back"]),
    ("take", &["back", "out"]),
    ("bring", &["back"]),
    ("set", &["down"]),
    ("lay", &["down"]),
    ("throw", &["away", "out"]),
    ("toss", &["away", "out"]),
    ("clear", &["up", "away"]),
    ("clean", &["up"]),
    ("tidy", &["up"]),
    ("lock", &["up"]),
    ("shut", &["off", "down"]),
    ("положи", &["обратно", "назад", "на место"]),
    ("положите", &["обратно", "назад", "на место"]),
    ("поставь", &["обратно", "назад", "на место"]),
    ("поставьте", &["обратно", "назад", "на место"]),
    ("верни", &["обратно", "назад", "на место"]),
    ("верните", &["обратно", "назад", "на место"]),
    ("отнеси", &["обратно", "назад", "на место"]),
    ("отвези", &["обратно", "назад", "на место"]),
    ("отвезите", &["обратно", "назад", "на место"]),
    ("отнесите", &["обратно", "назад", "на место"]),
    ("убери", &["обратно", "назад", "на место"]),
    ("уберите", &["обратно", "назад", "на место"]),
    ("повесь", &["обратно", "назад", "на место"]),
    ("повесьте", &["обратно", "назад", "на место"]),
];

fn keys_of(text: &str, words: &[Range<usize>]) -> Vec<String> {
    words.iter().map(|range| name_key(&text[range.clone()])).collect()
}

/// The meaning of the longest phrase at a word.
fn meaning_at(keys: &[String], at: usize) -> Option<(usize, Meaning)> {
    longest(&keys[at..].iter().map(String::as_str))
}

fn ends_clause(text: &str, words: &[Range<usize>], keys: &[String], at: usize) -> bool {
    let Some(word) = words.get(at) else { return true };
    let gap = &text[words[at - 1].end..word.start];
    gap.contains([',', ';', '.', '!', '?'])
        || meaning_at(keys, at).is_some_and(|m| m.1 == Meaning::And)
}

/// The text as the grammars read it: relative clauses as mere places («книгу, которая лежит на столе» is «книгу на
/// столе»), what is left out said again («к столу, потом к окну»), the halves of verbs together.
#[must_use]
pub(crate) fn gathered(text: &str) -> Cow<'_, str> {
    gathered_of(text).0
}

/// The text as [`gathered`] has it, and the words that it left out because they are not meant: «не красную».
#[must_use]
pub(crate) fn gathered_of(text: &str) -> (Cow<'_, str>, Vec<String>) {
    if is_too_long(text) {
        return (Cow::Borrowed(text), Vec::new());
    }
    let (text, not_meant) = spoken::plain(&joined(text));
    let text = without_relatives(&text).into_owned();
    let text = repeated(&text).into_owned();
    (Cow::Owned(joined(&text).into_owned()), not_meant)
}

/// Words of a relative clause that say no more than the preposition after them.
const RELATIVE: [&str; 73] = [
    "та что",
    "что ведет",
    "что ведут",
    "который ведет",
    "которая лежит",
    "который лежит",
    "которое лежит",
    "которую положили",
    "которые лежат",
    "которая стоит",
    "который стоит",
    "которое стоит",
    "которые стоят",
    "которая находится",
    "который находится",
    "которое находится",
    "которые находятся",
    "которая висит",
    "который висит",
    "что лежит",
    "что лежат",
    "что стоит",
    "что стоят",
    "что находится",
    "что висит",
    "которая ведет",
    "ведущую",
    "ведущая",
    "ведущие",
    "лежащую",
    "лежащий",
    "лежащее",
    "лежащие",
    "стоящую",
    "стоящий",
    "стоящее",
    "стоящие",
    "that is",
    "that s",
    "that are",
    "which is",
    "which are",
    "that lies",
    "that stands",
    "that leads",
    "which leads",
    "leading",
    "that is lying",
    "that is standing",
    "lying",
    "standing",
    "located",
    "он",
    "она",
    "оно",
    "они",
    "он лежит",
    "она лежит",
    "он стоит",
    "она стоит",
    "они лежат",
    "ту что",
    "тот что",
    "то что",
    "те что",
    "что",
    "который",
    "которая",
    "которую",
    "it s",
    "it is",
    "they are",
    "the one",
];

/// Whether a word begins what only describes: «что на столе», "the one by the window".
pub(super) fn is_relative(keys: &[String], at: usize) -> bool {
    const NEAREST: [&str; 5] = ["ближайш", "nearest", "closest", "farthest", "furthest"];
    const POINTING: [&str; 8] = ["ту", "тот", "то", "те", "где", "куда", "where", "that"];
    let said = |length: usize| keys.get(at..at + length).map(|words| words.join(" "));
    keys.get(at).is_some_and(|key| {
        POINTING.contains(&key.as_str()) || NEAREST.iter().any(|stem| key.starts_with(stem))
    }) || (1..=3).filter_map(said).any(|words| RELATIVE.contains(&words.as_str()))
}

fn without_relatives(text: &str) -> Cow<'_, str> {
    let words = word_ranges(text);
    let keys = keys_of(text, &words);
    let mut gone: Vec<Range<usize>> = Vec::new();
    let mut at = 1;
    while at < keys.len() {
        let relative = (1..=3).rev().find(|&length| {
            let said = keys.get(at..at + length);
            let before_place = matches!(
                keys.get(at + length).and_then(|_| meaning_at(&keys, at + length)),
                Some((_, Meaning::Link(_)))
            );
            let pointing = keys.get(at..at + length).is_some_and(|said| said == ["the", "one"]);
            let nearest = keys.get(at + length).is_some_and(|key| {
                matches!(key.as_str(), "nearest" | "closest" | "farthest" | "furthest")
            });
            // "Bring the one from the dresser" has no other object.
            let parted = text[words[at - 1].end..words[at].start].contains(',');
            let before_place = before_place && (!pointing || parted) || pointing && nearest;
            before_place && said.is_some_and(|said| RELATIVE.contains(&said.join(" ").as_str()))
        });
        if let Some(length) = relative {
            gone.push(words[at - 1].end..words[at + length - 1].end);
        }
        at += relative.unwrap_or(1);
    }
    if gone.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut left = text.to_owned();
    for range in gone.into_iter().rev() {
        left.replace_range(range, "");
    }
    Cow::Owned(left)
}

/// «Подъедь к столу, потом к окну»: the verb once more before each place that only follows, in time or in a list.
fn repeated(text: &str) -> Cow<'_, str> {
    let words = word_ranges(text);
    let keys = keys_of(text, &words);
    let mut put: Vec<(usize, String)> = Vec::new();
    let mut verb: Option<Range<usize>> = None;
    let mut at = 0;
    while at < keys.len() {
        let (taken, meaning) = match meaning_at(&keys, at) {
            Some((taken, meaning)) => (taken, Some(meaning)),
            None => (1, None),
        };
        match meaning {
            Some(Meaning::Verb(found)) if Sort::of(found) == Sort::Go => {
                verb = Some(words[at].start..words[at + taken - 1].end);
            }
            Some(Meaning::Verb(_)) => verb = None,
            Some(Meaning::And) => {
                let mut next = at + taken;
                let next_meaning = loop {
                    match (next < keys.len()).then(|| meaning_at(&keys, next)).flatten() {
                        Some((small, Meaning::Filler | Meaning::And)) => next += small,
                        found => break found,
                    }
                };
                if let (Some(verb), Some((_, link))) = (&verb, next_meaning)
                    && spoken::says_whither(link)
                {
                    put.push((words[next].start, format!("{} ", &text[verb.clone()])));
                }
                at = next;
                continue;
            }
            _ => {}
        }
        at += taken;
    }
    if put.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut repeated = text.to_owned();
    for (at, verb) in put.into_iter().rev() {
        repeated.insert_str(at, &verb);
    }
    Cow::Owned(repeated)
}

/// The halves of verbs together: "turn the lamp on" is "turn on the lamp".
fn joined(text: &str) -> Cow<'_, str> {
    let words = word_ranges(text);
    let keys = keys_of(text, &words);
    let mut moved: Vec<(usize, Range<usize>)> = Vec::new();
    for (at, key) in keys.iter().enumerate() {
        let Some((_, halves)) = SPLIT.iter().find(|(verb, _)| verb == key) else { continue };
        // "Turn off every lamp that is on"
        if keys.get(at + 1).is_some_and(|next| halves.contains(&next.as_str())) {
            continue;
        }
        let end = (at + 1..=words.len()).find(|&end| ends_clause(text, &words, &keys, end));
        let mut last = end.unwrap_or(words.len());
        // "… on, please", "… off now"
        while last > at + 2 && matches!(keys[last - 1].as_str(), "please" | "now" | "again") {
            last -= 1;
        }
        let half_before = |end: usize| {
            let half = halves.iter().map(|half| end - half.split(' ').count().min(end));
            half.filter(|&from| from > at + 1)
                .find(|&from| halves.contains(&keys[from..end].join(" ").as_str()))
                .map(|from| (at, from..end))
        };
        // "Turn the lamp on in the kitchen": a place may follow.
        let before_place =
            |end: &usize| matches!(meaning_at(&keys, *end), Some((_, Meaning::Link(_))));
        // … but "put it back on the shelf" says whither.
        let stays = |(_, half): &(usize, Range<usize>)| {
            !matches!(keys[half.start].as_str(), "back" | "away" | "обратно" | "назад" | "на")
        };
        let inside = || (at + 3..last).filter(before_place).filter_map(half_before).find(stays);
        moved.extend(half_before(last).or_else(inside));
    }
    if moved.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut gathered = text.to_owned();
    for (verb, half) in moved.into_iter().rev() {
        let said = text[words[half.start].start..words[half.end - 1].end].to_owned();
        gathered.replace_range(words[half.start - 1].end..words[half.end - 1].end, "");
        gathered.insert_str(words[verb].end, &format!(" {said}"));
    }
    Cow::Owned(gathered)
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
                return Some((words[at].start..words[at + taken - 1].end, verb));
            }
            _ => return None,
        }
    }
    None
}

/// Whether a text begins with what is not to be done: «не открывай дверь», "don't go there".
pub(super) fn forbids(text: &str) -> bool {
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
    fn halves_of_a_verb_come_together() {
        for (text, joined) in [
            ("Turn the TV on", "Turn on the TV"),
            ("turn the lamp on the desk off, please", "turn off the lamp on the desk, please"),
            ("Switch all lights off and come back", "Switch off all lights and come back"),
            ("put the book on the shelf", "put the book on the shelf"),
            ("Turn off every lamp that's on", "Turn off every switched on lamp"),
            ("Put it down.", "Put down it."),
            ("Switch everything off in the hall", "Switch off all the things in the hall"),
            ("Верни её на место", "Верни на место её"),
            ("turn on the lamp", "turn on the lamp"),
            ("Принеси книгу, которая лежит на столе", "Принеси книгу на столе"),
            ("Подъедь к столу, потом к окну", "Подъедь к столу, потом Подъедь к окну"),
            ("the door that leads to the hall", "the door to the hall"),
        ] {
            assert_eq!(gathered(text), joined);
        }
    }

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
