//! How somebody is spoken to within a line: "Where is it, dear?", «Скажи, дружок, где чашка?»
//!
//! Invariant: commas or the ends of the line part it from everything else; what is named within a sentence is no address.

use std::borrow::Cow;

use super::mark::Mark;
use super::several::is_tag;
use super::vocabulary;
use crate::words::word_keys;

/// A line without the words by which somebody is spoken to.
#[must_use]
pub fn unaddressed(line: &str) -> Cow<'_, str> {
    let mut cuts = Vec::new();
    let mut from = 0;
    let marks = line.char_indices().filter(|(_, c)| MARKS.contains(c));
    for (at, mark) in marks.map(|(at, mark)| (at, mark.len_utf8())).chain([(line.len(), 0)]) {
        let asks = line.trim_end().ends_with('?');
        let parted = vocabulary::parted(&word_keys(&line[from..at]));
        if parted == Some(Mark::Called) || asks && parted == Some(Mark::Hesitates) {
            cuts.push((from, at, at + mark));
        }
        from = at + mark;
    }
    let alone = cuts.iter().map(|(from, at, _)| word_keys(&line[*from..*at]).len()).sum::<usize>();
    if cuts.is_empty() || alone == word_keys(line).len() {
        return Cow::Borrowed(line);
    }
    let mut kept = String::new();
    let mut from = 0;
    for (begin, end, next) in cuts {
        let before = line[from..begin].trim_end();
        let within = !line[next..].trim().is_empty() && !before.is_empty();
        // "…, dear?" keeps the mark that ends the line; «Скажи, дружок, где …» one comma.
        kept.push_str(if within { before } else { before.trim_end_matches(COMMAS) });
        from = if within || before.is_empty() && kept.is_empty() { next } else { end };
    }
    let rest = &line[from..];
    if !kept.is_empty() && !rest.starts_with(MARKS) && !rest.starts_with(' ') {
        kept.push(' ');
    }
    kept.push_str(rest);
    Cow::Owned(kept.trim().to_owned())
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
            ("Hey, buddy! Bring me the cup.", "Hey, Bring me the cup."),
            ("My dear, which one is red", "which one is red"),
            ("Is there honey in the kitchen?", "Is there honey in the kitchen?"),
            ("Принеси чашку, блюдце и ложку", "Принеси чашку, блюдце и ложку"),
            ("Ok wait, is it red?", "is it red?"),
            ("Подожди, пока я не приду", "Подожди, пока я не приду"),
            ("Mum?", "Mum?"),
        ] {
            assert_eq!(unaddressed(line), plain, "{line}");
        }
    }
}
