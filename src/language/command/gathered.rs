//! A text as the grammars read it: plain orders, verbs whole and before each place, relative clauses as mere places.

use std::borrow::Cow;
use std::ops::Range;

use super::is_too_long;
use super::spoken;
use super::verbs::{RELATIVE, Sort, keys_of, meaning_at};
use super::vocabulary::Meaning;
use crate::paraphrase::Paraphrases;
use crate::sets::{Set, set};
use crate::words::word_ranges;

/// The text as the grammars read it: relative clauses as mere places («книгу, которая лежит на столе» is «книгу на
/// столе»), what is left out said again («к столу, потом к окну»), the halves of verbs together.
#[must_use]
pub(crate) fn gathered(text: &str) -> Cow<'_, str> {
    gathered_of(text, &Paraphrases::built_in()).0
}

/// The text as [`gathered`] has it, and the words that it left out because they are not meant: «не красную».
#[must_use]
pub(crate) fn gathered_of<'t>(text: &'t str, lines: &Paraphrases) -> (Cow<'t, str>, Vec<String>) {
    if is_too_long(text) {
        return (Cow::Borrowed(text), Vec::new());
    }
    let (text, not_meant) = spoken::plain(&joined(text), lines);
    let text = without_relatives(&text).into_owned();
    let text = repeated(&text).into_owned();
    (Cow::Owned(joined(&text).into_owned()), not_meant)
}

/// Verbs whose second half may stand behind what they are done to: "turn the lamp on".
static SPLIT: Set = Set::named("SplitVerb");

fn ends_clause(text: &str, words: &[Range<usize>], keys: &[String], at: usize) -> bool {
    let Some(word) = words.get(at) else { return true };
    let gap = &text[words[at - 1].end..word.start];
    gap.contains([',', ';', '.', '!', '?'])
        || meaning_at(keys, at).is_some_and(|m| m.1 == Meaning::And)
}

/// Whether a relative clause, which begins at a word, tells of a pointing word that has no noun: «принеси тот, что на столе».
fn stands_for_noun(keys: &[String], at: usize) -> bool {
    static POINTING: Set = Set::named("PointingNoun");
    let points = |n: usize| keys.get(n).is_some_and(|key| POINTING.contains(&key.as_str()));
    let Some(pointing) = (at.saturating_sub(1)..=at).find(|n| points(*n)) else { return false };
    (0..pointing).rev().take(2).any(|n| {
        meaning_at(keys, n).is_some_and(|(taken, meaning)| {
            n + taken == pointing
                && matches!(meaning, Meaning::Verb(_) | Meaning::Filler | Meaning::Me)
        })
    })
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
            let nearest =
                keys.get(at + length).is_some_and(|key| set!("Nearest").contains(&key.as_str()));
            // "Bring the one from the dresser" has no other object.
            let parted = text[words[at - 1].end..words[at].start].contains(',');
            let before_place = before_place && (!pointing || parted) || pointing && nearest;
            before_place
                && !stands_for_noun(&keys, at)
                && said.is_some_and(|said| RELATIVE.contains(&said.join(" ").as_str()))
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
                    && link.says_whither()
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
        let of = |(verbs, _): &&(&str, &str)| verbs.split(", ").any(|verb| verb == key);
        let Some((_, halves)) = SPLIT.meant().iter().find(of) else { continue };
        let halves: Vec<&str> = halves.split(", ").collect();
        // "Turn off every lamp that is on"
        if keys.get(at + 1).is_some_and(|next| halves.contains(&next.as_str())) {
            continue;
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
            !set!("HalfOfPlace").contains(&keys[half.start].as_str())
        };
        // "Turn the lamp and the fan off": behind all of a list, up to what is ordered next.
        let next_verb = (at + 1..words.len())
            .find(|&n| matches!(meaning_at(&keys, n), Some((_, Meaning::Verb(_)))));
        let ends = (at + 1..=words.len()).filter(|&end| ends_clause(text, &words, &keys, end));
        let ends = ends.take_while(|end| next_verb.is_none_or(|verb| *end <= verb));
        let mut from = at + 1;
        let half = ends.into_iter().find_map(|end| {
            let begin = std::mem::replace(&mut from, end);
            let mut last = end;
            // "… on, please", "… off now"
            while last > at + 2 && set!("BehindHalf").contains(&keys[last - 1].as_str()) {
                last -= 1;
            }
            let inside = || {
                (begin.max(at + 3)..last).filter(before_place).filter_map(half_before).find(stays)
            };
            half_before(last).filter(|half| half.1.start >= begin).or_else(inside)
        });
        moved.extend(half);
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
            ("Turn the lamp and the TV off", "Turn off the lamp and the TV"),
            (
                "Put Bowl 1, Cup 2 and Mug 1 back, please",
                "Put back Bowl 1, Cup 2 and Mug 1, please",
            ),
            (
                "Put the cup on the desk and turn the TV off",
                "Put the cup on the desk and turn off the TV",
            ),
            ("Верни чашку и ложку на место", "Верни на место чашку и ложку"),
            ("Put the cup down and come back", "Put down the cup and come back"),
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
}
