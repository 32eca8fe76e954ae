//! Several questions in one sentence, and what people hang on a question's end.

use super::mark::Mark;
use super::{opening, vocabulary};
use crate::sets::{Set, set};
use crate::words::{word_keys, word_ranges};

/// The questions that «и», «а» or "and" join in a text: each has a word of its own that asks. None where it is one.
pub(super) fn parts(text: &str) -> Option<Vec<&str>> {
    let words = word_ranges(text);
    let keys = word_keys(text);
    // A joint is left out; behind a comma alone the next question begins at once.
    let cut = |n: usize| {
        let comma = text[words[n - 1].end..words[n].start].contains(',');
        let (before, behind) = (&keys[..n], &keys[n + 1..]);
        let of_all = || comma && claims_of_all(before, behind);
        let joint =
            is_joint(&keys[n]) && (begins(behind) || asks_of_those(before, behind) || of_all());
        let anew = comma && begins_anew(&keys[n..]);
        // «…, а чашек?»: the same of something else. «…, а не на полке?» only sets off.
        let goes_on = comma && keys[n] == "а" && behind.first().is_some_and(|key| key != "не");
        // "Is the stove on, and is it clean?" asks whether, twice.
        let asks = asks(before) || opening::asks_at_once(before);
        (asks && (joint || anew || goes_on)).then(|| match joint {
            true => (words[n].start, words[n].end),
            false => (words[n].start, words[n].start),
        })
    };
    let cuts: Vec<(usize, usize)> = (1..keys.len()).filter_map(cut).collect();
    if cuts.is_empty() {
        return None;
    }
    let mut parts = Vec::new();
    let mut from = 0;
    for (end, next) in cuts {
        parts.push(text[from..end].trim_matches([' ', ',']));
        from = next;
    }
    parts.push(text[from..].trim());
    parts.iter().all(|part| !part.is_empty()).then_some(parts)
}

/// A text without one of two things that it joins, and whether by "or": «микроволновка или тостер» without the first.
pub(super) fn without(text: &str, one: &str) -> Option<(String, bool)> {
    static ARTICLES: Set = Set::named("Article");
    let (words, keys) = (word_ranges(text), word_keys(text));
    let start = text.find(one)?;
    let mut from = words.iter().position(|w| w.start == start)?;
    let after = 1 + words.iter().position(|w| w.end == start + one.len())?;
    while from > 0 && ARTICLES.contains(&keys[from - 1].as_str()) {
        from -= 1;
    }
    let joint = |n: usize| match keys.get(n)?.as_str() {
        "or" | "или" | "либо" => Some(true),
        "and" | "и" => Some(false),
        _ => None,
    };
    let (cut, either) = match (joint(after), from.checked_sub(1).and_then(joint)) {
        (Some(either), _) => (words[from].start..words.get(after + 1)?.start, either),
        (None, Some(either)) => (words[from - 1].start..words[after - 1].end, either),
        (None, None) => return None,
    };
    Some((format!("{}{}", text[..cut.start].trim_end(), spaced(&text[cut.end..])), either))
}

/// What follows a cut, parted from what stands before it.
fn spaced(rest: &str) -> String {
    let rest = rest.trim_start();
    let parts = !rest.is_empty() && rest.starts_with(char::is_alphanumeric);
    if parts { format!(" {rest}") } else { rest.to_owned() }
}

/// Whether a word of these asks.
pub(super) fn asks_in(text: &str) -> bool {
    let keys = word_keys(text);
    asks(&keys)
}

/// The same, where "somebody" asks for nobody.
pub(super) fn asks_outright(text: &str) -> bool {
    let (words, keys) = (word_ranges(text), word_keys(text));
    // «чего-то не пойму»
    let indefinite = |n: usize| {
        let particle = keys.get(n + 1).is_some_and(|k| set!("Particle").contains(&&**k));
        particle && &text[words[n].end..words[n + 1].start] == "-"
    };
    (0..keys.len()).any(|n| {
        !indefinite(n)
            && match vocabulary::longest(&keys[n..]) {
                Some((taken, Mark::Who)) => {
                    taken == 1
                        && (set!("AskingWho").contains(&&*keys[n]) || keys[n].starts_with("чь"))
                }
                Some((_, mark)) => mark.asks(),
                None => false,
            }
    })
}

/// Whether words tell that something is looked for, and ask only by that: "I can't find the kettle", «ищу свой зонт».
pub(super) fn seeks(text: &str) -> bool {
    static ASKING: Set = Set::named("AsksWhere");
    let keys = word_keys(text);
    if text.trim_end().ends_with('?') || keys.iter().any(|key| ASKING.contains(&key.as_str())) {
        return false;
    }
    let marks = || (0..keys.len()).filter_map(|n| vocabulary::longest(&keys[n..]).map(|(_, m)| m));
    marks().any(|mark| mark == Mark::Where)
        && marks().all(|mark| mark == Mark::Where || !mark.asks())
}

/// The sentences of a line: a mark that ends one, a blank, and a capital.
#[must_use]
pub fn sentences(line: &str) -> Vec<&str> {
    let mut sentences = Vec::new();
    let mut from = 0;
    let marks = line.char_indices().filter(|(_, c)| matches!(c, '.' | '!' | '?' | '…'));
    for (at, mark) in marks {
        let next = at + mark.len_utf8();
        let rest = line[next..].trim_start();
        let begins = rest.len() < line.len() - next && rest.starts_with(char::is_uppercase);
        if begins && next > from {
            sentences.push(line[from..next].trim());
            from = line.len() - rest.len();
        }
    }
    sentences.push(line[from..].trim());
    sentences
}

fn is_joint(key: &str) -> bool {
    set!("AndOrOnlyBut").contains(&key)
}

fn asks(words: &[String]) -> bool {
    has_mark(words, Mark::asks)
}

fn has_mark(words: &[String], wanted: fn(Mark) -> bool) -> bool {
    (0..words.len()).any(|n| vocabulary::longest(&words[n..]).is_some_and(|(_, m)| wanted(m)))
}

/// Whether words behind a comma ask anew, which a relative clause does not: «…, на каком этаже», «…, сколько».
fn begins_anew(words: &[String]) -> bool {
    match vocabulary::longest(words) {
        // «…, на каком этаже», «…, на чём стоит», but «…, на котором»
        Some((taken, Mark::Link(_))) => {
            let what = matches!(vocabulary::longest(&words[taken..]), Some((_, Mark::What)));
            what || words.get(taken).is_some_and(|w| w.starts_with("как"))
        }
        Some((_, Mark::HowMany)) => true,
        _ => false,
    }
}

/// «Сколько дверей, и все открыты?»: a word for all, and what is claimed of them.
fn claims_of_all(before: &[String], words: &[String]) -> bool {
    let counted = has_mark(before, |mark| mark == Mark::HowMany);
    counted && words.len() == 2 && matches!(vocabulary::longest(words), Some((1, Mark::All)))
}

/// "How many rooms are there and which is the biggest?": where a thing is described, "which is" asks nothing.
fn asks_of_those(before: &[String], words: &[String]) -> bool {
    let [which, is, rest @ ..] = words else { return false };
    let is_which = which == "which" && matches!(is.as_str(), "is" | "are");
    let counted = has_mark(before, |mark| mark == Mark::HowMany);
    is_which && (counted || has_mark(rest, |mark| matches!(mark, Mark::Best(_))))
}

/// Whether a part begins with what asks, after a preposition or a small word: «и в какой она комнате».
fn begins(words: &[String]) -> bool {
    // «… и закрыт ли он?»
    if words.len() > 2 && words[1] == "ли" {
        return true;
    }
    let Some((taken, mark)) = vocabulary::longest(words) else { return false };
    match mark {
        Mark::Link(_) => {
            let next = vocabulary::longest(&words[taken..]);
            next.is_some_and(|(_, m)| matches!(m, Mark::Which | Mark::What))
        }
        // «… и как до него добраться?»
        Mark::How => has_mark(words, |mark| matches!(mark, Mark::Move)),
        // "… and is it on?", "… and is the door shut?"
        Mark::Be => {
            let next = vocabulary::longest(&words[taken..]);
            let inverted = matches!(words[0].as_str(), "is" | "are");
            next.is_some_and(|(_, m)| match m {
                Mark::The | Mark::All => inverted,
                m => matches!(m, Mark::Pronoun(_) | Mark::Anything),
            })
        }
        // "there is a lamp and there is …" asks nothing new of one thing.
        Mark::Exists => words.len() > 2,
        mark => mark.asks() && (words.len() > 1 || mark == Mark::Where),
    }
}

/// Whether words hung on a question ask only whether what stands before is so, or beg: "isn't it", "is she right", «не так
/// ли», «она права», "could you".
pub(super) fn is_tag(tag: &str) -> bool {
    static BEGGING: Set = Set::named("BeggingTag");
    static TRUE: Set = Set::named("TrueTag");
    static BEING: Set = Set::named("BeingTag");
    static WHO: Set = Set::named("PersonTag");
    let words: Vec<&str> = tag.split(' ').collect();
    let of = |sets: &[&[&str]]| words.iter().all(|word| sets.iter().any(|set| set.contains(word)));
    let says = words.iter().any(|word| TRUE.contains(word)) && of(&[&TRUE, &BEING, &WHO]);
    // "…, is there?" alone: "…, is it there?" asks of a place.
    let echoes = BEING.contains(&words[0])
        && of(&[&BEING, &WHO])
        && words.len() > 1
        && (!words.contains(&"there") || words.iter().all(|word| *word != "it"));
    BEGGING.contains(&tag) || says || echoes
}

/// A question without the "isn't it?" at its end.
pub(super) fn without_tag(text: &str) -> &str {
    // «Не могу найти часы, где они?» asks once.
    static WHERE: Set = Set::named("WhereTag");
    let text = without_or_not(text);
    let Some((before, tag)) = text.rsplit_once([',', '–', '—', '.', ';']) else { return text };
    let tag = word_keys(tag).join(" ");
    let asked = WHERE.contains(&tag.as_str());
    let is_tag =
        is_tag(&tag) || (asked && has_mark(&word_keys(before), |mark| mark == Mark::Where));
    if is_tag && word_ranges(before).len() > 1 { before } else { text }
}

/// «Дверь заперта или нет», "Is it open or not?": whether it is.
fn without_or_not(text: &str) -> &str {
    let keys = word_keys(text);
    let ends = |two: &[String]| {
        matches!((two[0].as_str(), two[1].as_str()), ("или", "нет" | "не") | ("or", "not"))
    };
    if keys.len() < 4 || !keys.last_chunk::<2>().is_some_and(|two| ends(two)) {
        return text;
    }
    let words = word_ranges(text);
    text[..words[words.len() - 2].start].trim_end_matches([' ', ',', '–', '—'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn questions_are_parted_where_the_second_asks_anew() {
        let check = |text: &str, expected: Option<&[&str]>| {
            assert_eq!(parts(text).as_deref(), expected, "{text}");
        };
        check("Где ваза и какого она цвета?", Some(&["Где ваза", "какого она цвета?"]));
        check("Где лекарство, а где зонт?", Some(&["Где лекарство", "где зонт?"]));
        check(
            "Where is the kettle and how many cups are there?",
            Some(&["Where is the kettle", "how many cups are there?"]),
        );
        check("Где чашка, на каком этаже?", Some(&["Где чашка", "на каком этаже?"]));
        check("How many cups are there and where?", Some(&["How many cups are there", "where?"]));
        check("Где шкаф и закрыт ли он?", Some(&["Где шкаф", "закрыт ли он?"]));
        check("Где стул, на котором лежит книга?", None);
        check("Где стол и стул?", None);
        check("Что между столом и шкафом?", None);
        assert_eq!(without_tag("The sofa isn't brown, is it?"), "The sofa isn't brown");
        assert_eq!(without_tag("Где стул, стол"), "Где стул, стол");
    }
}
