//! What people say for a name that a program gave: "the left nurse center", «левый сестринский пост» for
//! `L1_left_nurse_center`, or that was made of such names and begins with its storey as they do: `L1 left ward 3`.
//!
//! Invariant: what is said ends as the name does, with two of its words at least; a number may be left unsaid, and the
//! storey that stands first.

use super::adjective::Adjective;
use super::grammar::{Animacy, Case, Number, WordHints};
use super::phrase::NounPhrase;
use super::things::things;

/// What may stand before a number, in the list of the words of identifiers.
const COUNTER: &str = "number";

/// The forms of such a name that are said, English and Russian; none for any other name.
pub(crate) fn spoken(name: &str) -> Vec<String> {
    let lower = name.to_lowercase();
    let is_storey = |part: &str| part.len() < 4 && part.ends_with(|c: char| c.is_ascii_digit());
    let mut parts: Vec<&str> = lower.split('_').filter(|part| !part.is_empty()).collect();
    if let [words] = parts[..] {
        parts = words.split(' ').collect();
        parts.truncate(if is_storey(parts[0]) { parts.len() } else { 0 });
    }
    if parts.len() < 2 || !name.is_ascii() {
        return Vec::new();
    }
    let storey = is_storey(parts[0]);
    let numbers = parts.iter().rev().take_while(|part| is_number(part)).count();
    let (named, number) = parts.split_at(parts.len() - numbers);
    let mut said = Vec::new();
    for from in (usize::from(storey)..named.len()).filter(|from| is_word(named[*from])) {
        let words = &named[from..];
        if words.iter().filter(|part| is_word(part)).count() < 2 {
            continue;
        }
        // "Ward 3" and "ward number 3", «кабинет 8» and «кабинет номер 8»
        let numbered = |phrase: &str, counter: Option<&str>| {
            let counters = ["", counter.unwrap_or_default()];
            let counters = counters.into_iter().filter(|_| !number.is_empty());
            let told = counters.map(|word| format!("{phrase} {word} {}", number.join(" ")));
            told.map(|told| told.replace("  ", " ")).collect::<Vec<_>>()
        };
        let head_last = words.join(" ");
        said.extend(numbered(&head_last, Some(COUNTER)));
        said.push(head_last);
        // "The charger of tinyRobot 1", «зарядка tinyRobot 1»
        let [owner @ .., head] = words else { continue };
        let numbered_owner = |part: &&str| part.ends_with(|c: char| c.is_ascii_digit());
        let of_owner = owner.last().filter(|part| numbered_owner(part)).map(|_| owner.join(" "));
        said.extend(of_owner.iter().map(|owner| format!("{head} of {owner}")));
        let russian = match of_owner {
            Some(owner) => russian_of(head).map(|head| format!("{head} {owner}")),
            None => in_russian(words),
        };
        let counter = russian_of(COUNTER);
        said.extend(russian.iter().flat_map(|phrase| numbered(phrase, counter)));
        said.extend(russian);
    }
    said
}

fn is_number(part: &str) -> bool {
    part.bytes().all(|byte| byte.is_ascii_digit())
}

fn is_word(part: &str) -> bool {
    part.len() > 2 && part.starts_with(|c: char| c.is_ascii_alphabetic())
}

/// "Left nurse center": the longest end that the word list has, and an adjective for each word before it.
fn in_russian(words: &[&str]) -> Option<String> {
    let (cut, head) =
        (0..words.len()).find_map(|cut| Some((cut, russian_of(&words[cut..].join(" "))?)))?;
    let gender = NounPhrase::parse(head, &WordHints::default()).gender();
    let mut phrase = String::new();
    for word in &words[..cut] {
        let adjective = Adjective::read(russian_of(word)?)?;
        let form = adjective.form(Case::Nominative, Number::Singular, gender, Animacy::Inanimate);
        phrase.extend([&form, " "]);
    }
    Some(phrase + head)
}

fn russian_of(words: &str) -> Option<&'static str> {
    let named = things().identifiers.iter().find(|(english, _)| english == words);
    named.map(|(_, russian)| russian.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_program_names_is_said_in_words() {
        let check = |name: &str, expected: &[&str], others: &[&str]| {
            let said = spoken(name);
            for phrase in expected {
                assert!(said.iter().any(|own| own == phrase), "{name}: {phrase} in {said:?}");
            }
            for phrase in others {
                assert!(said.iter().all(|own| own != phrase), "{name}: {phrase}");
            }
        };
        check(
            "L1_left_nurse_center",
            &["left nurse center", "nurse center", "левый сестринский пост"],
            &["center", "l1 left nurse center"],
        );
        check("L2_north_counter", &["north counter", "северная стойка"], &["counter", "стойка"]);
        check("L1_sub_waiting_area_3", &["waiting area", "waiting area 3", "зона ожидания 3"], &[]);
        check(
            "L1 left consult room 3",
            &[
                "left consult room 3",
                "consult room number 3",
                "левый кабинет консультаций 3",
                "левый кабинет консультаций номер 3",
            ],
            &["room 3", "l1 left consult room 3"],
        );
        // Where a robot is charged is not where it is.
        check(
            "tinyRobot_1_charger",
            &["charger of tinyrobot 1", "зарядка tinyrobot 1"],
            &["tinyrobot 1", "charger"],
        );
        check(
            "tinyRobot2_charger",
            &["charger of tinyrobot2", "зарядка tinyrobot2"],
            &["tinyrobot2"],
        );
        for name in ["hardware_2", "Office chair", "Table 1", "Room-B", "", "_", "1_2"] {
            assert!(spoken(name).is_empty(), "{name}: {:?}", spoken(name));
        }
    }
}
