//! What is said to whom one speaks with and nothing of the world: "Where is it, dear?", «Короче, где чашка?», "Is it, like,
//! red?"
//!
//! Invariant: commas or the ends of the line part it from everything else; what is named within a sentence is no address, and
//! what puts right what was said before it («кружка, то есть, чашка») stays.

use std::borrow::Cow;
use std::ops::Range;

use super::conditions::{IF, NOT_SO};
use super::convenience;
use super::courtesy;
use super::mark::Mark;
use super::orders::hinges;
use super::query::Courtesy;
use super::several::{self, is_tag};
use super::vocabulary;
use crate::command::{Correction, correction_of_question, is_order};
use crate::sets::{Set, set};
use crate::units::name_key;
use crate::words::{is_first_person, phrase_at, word_keys, word_ranges};

/// A line without the words by which somebody is spoken to, and without particles of speech.
#[must_use]
pub fn unaddressed(line: &str) -> Cow<'_, str> {
    match unstressed(line) {
        Some(plain) => Cow::Owned(unspoken(&plain).into_owned()),
        None => unspoken(line),
    }
}

/// A line in which a hyphen between blanks is the dash that it stands for.
#[must_use]
pub fn dashed(line: &str) -> String {
    line.replace(" - ", " – ")
}

/// A line without «-то», where that only stresses a word: «куда её поставили-то?», but «где-то».
fn unstressed(line: &str) -> Option<String> {
    const STRESS: &str = "-то";
    let mut plain = line.to_owned();
    for (at, _) in line.rmatch_indices(STRESS) {
        let ends = line[at + STRESS.len()..].chars().next().is_none_or(|c| !c.is_alphanumeric());
        let word = line[..at].rsplit(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
        let word = name_key(word);
        let asks = set!("IndefiniteStem").iter().any(|stem| word.starts_with(stem));
        if ends && !word.is_empty() && !asks {
            plain.replace_range(at..at + STRESS.len(), "");
        }
    }
    (plain != line).then_some(plain)
}

fn unspoken(line: &str) -> Cow<'_, str> {
    let mut cuts = Vec::new();
    let mut from = 0;
    let asks = line.trim_end().ends_with('?');
    let marks = line.char_indices().filter(|(_, c)| MARKS.contains(c));
    for (at, mark) in marks.map(|(at, mark)| (at, mark.len_utf8())).chain([(line.len(), 0)]) {
        let end = at + mark;
        let keys = word_keys(&line[from..at]);
        if puts_right(line, from, end) {
            from = end;
            continue;
        }
        let polite = suiting(&line[from..at], &keys);
        if let Some(polite) = polite.filter(|_| !is_hinge(line, from, end)) {
            let (begin, until) = (from + polite.start, from + polite.end);
            match begin == from && until == at {
                true => cuts.push((begin, at, end, Cut::within(&line[..from], &line[end..]))),
                false => cuts.push((begin, until, until, Cut::Comma)),
            }
            from = end;
            continue;
        }
        // «Спасибо, а первый?»
        if from == 0 && thanks(&line[..at]) && !thanks(line) {
            cuts.push((from, at, end, Cut::Comma));
            from = end;
            continue;
        }
        let cut = match vocabulary::parted(&keys).filter(|_| !hinges(&keys)) {
            Some(Mark::Called) => Some(Cut::Comma),
            Some(Mark::Hesitates) => asks.then_some(Cut::Comma),
            Some(Mark::Particle) => Some(Cut::within(&line[..from], &line[end..])),
            Some(Mark::Corrects) => {
                let outside = line[..from].trim().is_empty() || line[end..].trim().is_empty();
                (outside || begins_clause(&line[..from], &line[end..])).then_some(Cut::Comma)
            }
            _ => None,
        };
        cuts.extend(cut.map(|cut| (from, at, end, cut)));
        from = end;
    }
    let alone = cuts.iter().map(|(from, at, ..)| word_keys(&line[*from..*at]).len()).sum::<usize>();
    if cuts.is_empty() || alone == word_keys(line).len() {
        return Cow::Borrowed(line);
    }
    let mut kept = String::new();
    let mut from = 0;
    for (begin, end, next, cut) in cuts {
        let before = line[from..begin].trim_end();
        let within = !line[next..].trim().is_empty() && !before.is_empty();
        // "…, dear?" keeps the mark that ends the line; «Скажи, дружок, где …» one comma; «Где, короче, чашка?» none.
        let joined = within && matches!(cut, Cut::Both);
        // "It is a mess, honestly. Where …?" are two sentences all the same.
        let closes = within && line[end..next].contains(['.', '!', '?', '…']);
        let bare = before.trim_end_matches(COMMAS);
        kept.push_str(if within && !joined && !closes { before } else { bare });
        if closes && bare.ends_with(char::is_alphanumeric) {
            kept.push_str(&line[end..next]);
        }
        from = if within || before.is_empty() && kept.is_empty() { next } else { end };
    }
    let rest = &line[from..];
    if !kept.is_empty() && !rest.starts_with(MARKS) && !rest.starts_with(' ') {
        kept.push(' ');
    }
    kept.push_str(rest);
    Cow::Owned(kept.trim().to_owned())
}

fn thanks(text: &str) -> bool {
    courtesy::of(text) == Some(Courtesy::Thanks)
}

/// What goes with words that are left out within a line.
enum Cut {
    /// One of the two marks: the other parts a clause.
    Comma,
    /// Both: they part one clause.
    Both,
}

impl Cut {
    fn within(before: &str, behind: &str) -> Self {
        let orders_again = is_order(before) && is_order(behind);
        let joined = before.trim_end().ends_with(',') && !begins_clause(before, behind);
        let joined = joined && !orders_again;
        if joined { Self::Both } else { Self::Comma }
    }
}

/// "If you have time, …, otherwise …", "if it is open, close it, and if you have time, …": whether what elsewhere only is
/// polite divides what is ordered from what is ordered otherwise, or anyway.
fn is_hinge(line: &str, from: usize, end: usize) -> bool {
    let keys = word_keys(&line[end..]);
    let otherwise =
        (0..keys.len()).any(|n| NOT_SO.iter().any(|p| phrase_at(&keys, n, p).is_some()));
    let begins = word_keys(&line[..from]).first().is_some_and(|key| IF.contains(&key.as_str()));
    otherwise || begins && is_order(&line[end..])
}

/// The bytes of a part of a line that ask only whether something suits who is spoken to: all of it, its end, or what stands
/// before an order.
fn suiting(part: &str, keys: &[String]) -> Option<Range<usize>> {
    let words = word_ranges(part);
    match convenience::length(keys) {
        Some(taken) if taken == keys.len() => Some(0..part.len()),
        Some(taken) if is_order(&part[words[taken].start..]) => Some(0..words[taken].start),
        _ => Some(words[convenience::at_the_end(keys)?].start..part.len()),
    }
}

/// «Где кружка, ой, чашка?», "…, sorry, the mug": whether bytes of a line put right what a word before them said.
fn puts_right(line: &str, from: usize, end: usize) -> bool {
    let Some(Correction { before, behind, .. }) = correction_of_question(line) else {
        return false;
    };
    names_last(before)
        && before.len() <= from
        && end <= line.len() - behind.len()
        && courtesy::of(before).is_none()
        && word_keys(behind).first().is_some_and(|first| !is_first_person(first))
        && !begins_clause(before, behind)
        && !is_order(behind)
}

/// Whether words end with what they name, and not where something is still to be named: «зонт и», "where is the".
pub(super) fn names_last(words: &str) -> bool {
    let small = |mark: Mark| {
        mark.asks()
            || matches!(
                mark,
                Mark::Link(_)
                    | Mark::And
                    | Mark::Or
                    | Mark::But
                    | Mark::Not
                    | Mark::The
                    | Mark::A
                    | Mark::Be
                    | Mark::Have
                    | Mark::Exists
                    | Mark::Than
                    | Mark::Except
                    | Mark::Without
            )
    };
    let last = word_keys(words).pop();
    last.is_some_and(|last| !vocabulary::longest(&[last]).is_some_and(|(_, mark)| small(mark)))
}

/// Whether what stands behind words that say nothing is a clause of its own, and not the rest of the one before them.
fn begins_clause(before: &str, behind: &str) -> bool {
    let keys = word_keys(behind);
    let joint = matches!(vocabulary::longest(&keys), Some((1, Mark::But)));
    let keys = &keys[usize::from(joint)..];
    let of_me = |key: &String| set!("FirstPerson").contains(&key.as_str());
    let tells = word_keys(before).iter().any(|key| of_me(key) || is_first_person(key));
    let whether = keys.get(1).is_some_and(|key| key == "ли");
    let asks = vocabulary::longest(keys).is_some_and(|(_, mark)| mark.asks() && keys[0] != "есть");
    // «Сколько их, чёрт, никак не сосчитаю?»
    let of_me = keys.iter().any(|key| is_first_person(key));
    of_me || !several::asks_in(before) && (tells || asks || whether)
}

/// A line without an "isn't it" in its midst, which denies nothing: "It's in there, isn't it, but where?"
pub(super) fn untagged(line: &str) -> Cow<'_, str> {
    let mut commas = line.char_indices().filter(|(_, c)| *c == ',').map(|(at, _)| at);
    let (Some(first), Some(last)) = (commas.next(), commas.next_back()) else {
        return Cow::Borrowed(line);
    };
    let parts: Vec<&str> = line[first + 1..last].split(',').collect();
    let kept: Vec<&str> =
        parts.iter().copied().filter(|part| !is_tag(&word_keys(part).join(" "))).collect();
    if kept.len() == parts.len() {
        return Cow::Borrowed(line);
    }
    let ends = [&line[..first]].into_iter().chain(kept).chain([&line[last + 1..]]);
    Cow::Owned(ends.collect::<Vec<_>>().join(","))
}

/// An order without the "would you?" at its end, which asks nothing.
#[must_use]
pub fn unbegged(line: &str) -> &str {
    static BEGGING: Set = Set::named("BeggingTag");
    match line.rsplit_once(COMMAS[0]) {
        Some((order, tag))
            if BEGGING.contains(&word_keys(tag).join(" ").as_str()) && is_order(order) =>
        {
            order
        }
        _ => line,
    }
}

/// What parts an address from the rest of a line.
const MARKS: [char; 9] = [',', ';', '.', '!', '?', '…', '–', '—', ':'];
/// What stands before one at the end of a line.
const COMMAS: [char; 2] = [',', ' '];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tag_within_a_line_denies_nothing() {
        for (line, plain) in [
            ("It's in there, isn't it, but where?", "It's in there, but where?"),
            ("Она красная, не так ли, или синяя?", "Она красная, или синяя?"),
            ("A, b, c", "A, b, c"),
            ("It is red, isn't it?", "It is red, isn't it?"),
        ] {
            assert_eq!(untagged(line), plain, "{line}");
        }
    }

    #[test]
    fn who_is_spoken_to_is_left_out_and_what_is_named_stays() {
        for (line, plain) in [
            ("Where is the cup, dear?", "Where is the cup?"),
            ("Скажи, дружок, где чашка?", "Скажи, где чашка?"),
            ("Сынок, сколько у нас стульев?", "сколько у нас стульев?"),
            ("Hey, buddy! Bring me the cup.", "Bring me the cup."),
            ("My dear, which one is red", "which one is red"),
            ("Is there honey in the kitchen?", "Is there honey in the kitchen?"),
            ("Принеси чашку, блюдце и ложку", "Принеси чашку, блюдце и ложку"),
            ("Ok wait, is it red?", "is it red?"),
            ("It rains, dear. Where is the cup?", "It rains. Where is the cup?"),
            ("Подожди, пока я не приду", "Подожди, пока я не приду"),
            ("Mum?", "Mum?"),
            ("Короче, есть чем поиграть?", "есть чем поиграть?"),
            ("Ну короче, где чашка?", "где чашка?"),
            ("Где, короче, чашка?", "Где чашка?"),
            ("Сколько, значит, стульев на кухне?", "Сколько стульев на кухне?"),
            ("Which cups are, like, red?", "Which cups are red?"),
            ("Принеси, если тебе не трудно, чашку", "Принеси чашку"),
            ("Could you, if it's not too much trouble, bring it?", "Could you bring it?"),
            ("Когда будет минутка, принеси чашку", "принеси чашку"),
            ("If it is no trouble bring the cup", "bring the cup"),
            ("Bring the cup if you get a chance, and the jug.", "Bring the cup, and the jug."),
            ("Bring the cup, if you have time, put it here", "Bring the cup, put it here"),
            ("Bring, if the door is open, the cup", "Bring, if the door is open, the cup"),
            ("If you have time", "If you have time"),
            ("Which cups, you know, are red?", "Which cups are red?"),
            (
                "I'm in the kitchen, you know, where is the bin?",
                "I'm in the kitchen, where is the bin?",
            ),
            ("Скажи, ну, где чашка?", "Скажи, где чашка?"),
            ("They ate it, I guess, but how many are left?", "They ate it, but how many are left?"),
            ("Всё съели, похоже, а где, ну, ложки?", "Всё съели, похоже, а где ложки?"),
            ("What is above the kitchen, like, counter?", "What is above the kitchen counter?"),
            ("Where is the cup, I mean, the mug?", "Where is the cup, I mean, the mug?"),
            ("I mean, where is the cup?", "where is the cup?"),
            ("Что короче, стол или шкаф?", "Что короче, стол или шкаф?"),
            ("Is there milk, like?", "Is there milk?"),
            ("Короче", "Короче"),
        ] {
            assert_eq!(unaddressed(line), plain, "{line}");
        }
    }
}
