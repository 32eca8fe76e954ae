//! Constructions that are put plainly by more than their words in order: by numbers, or by what is a name. What a pattern
//! tells is a line of `paraphrases.lang` (see [`crate::paraphrase`]).
//!
//! Invariant: what is put in means the same, and names nothing that was not named.

use std::borrow::Cow;

use super::mark::Mark;
use super::vocabulary;
use crate::paraphrase::Words;
use crate::sets::{Set, set};
use crate::words::Language;

/// Puts a text plainly, where it is of the rule's construction.
type Rule = fn(&Words<'_>) -> Option<String>;

/// A text with these constructions put plainly: each rule once, in this order.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    const RULES: [Rule; 5] =
        [named_by_number, as_listed, numbered, everything_switched, numbers_joined];
    let mut rules = RULES.iter();
    let mut plain = Cow::Borrowed(text);
    // The words are taken anew only where one has changed the text.
    while let Some(next) = Words::of(&plain).and_then(|words| rules.find_map(|rule| rule(&words))) {
        plain = Cow::Owned(next);
    }
    plain
}

/// «Назови по одной вещи из каждой комнаты», "Tell me two things in each room": so many are named.
fn named_by_number(words: &Words<'_>) -> Option<String> {
    static ONE: Set = Set::named("NumberOne");
    let told = vocabulary::longest(&words.keys);
    let listed = match told {
        Some((taken, Mark::List)) => taken,
        _ if words.is(0, &["tell"]) && words.is(1, &["me"]) => 2,
        _ => return None,
    };
    let each = usize::from(words.is(listed, &["по"]));
    let number = words.keys.get(listed + each)?;
    let one = ONE.contains(&number.as_str());
    let by = match one {
        true => "одна",
        false => words.text.get(words.at[listed + each].clone())?,
    };
    let counts = one || number == "one" || crate::question::grammar::number_of(number).is_some();
    let said = match told {
        Some((_, Mark::List)) => words.part(0..listed)?,
        _ => "Name",
    };
    counts
        .then(|| words.replaced(vec![(0..listed + each + 1, format!("{said} {by}"))]))
        .filter(|text| text != words.text)
}

/// "Which of the books you listed is red?": of these books.
fn as_listed(words: &Words<'_>) -> Option<String> {
    let names = |noun: &usize| {
        let said = vocabulary::longest(&words.keys[*noun..=*noun]);
        said.is_none_or(|(_, mark)| mark == Mark::One)
    };
    let (noun, taken) = (0..words.keys.len()).filter(names).find_map(|noun| {
        Some((noun, vocabulary::taken_by(Mark::Listed, words.keys.get(noun + 1..)?)?))
    })?;
    let article = noun.checked_sub(1).filter(|n| words.is(*n, set!("TheOrAll")));
    let named = words.text.get(words.at[noun].clone())?;
    let those = format!("{} {named}", Language::of(named).pick("эти", "these"));
    Some(words.replaced(vec![(article.unwrap_or(noun)..noun + 1 + taken, those)]))
}

/// «процедурная номер два», "room number 5": the number of its name.
fn numbered(words: &Words<'_>) -> Option<String> {
    let number = (1..words.keys.len() - 1).find(|n| words.is(*n, set!("NumberSign")))?;
    let counted = crate::question::grammar::number_of(&words.keys[number + 1])?;
    (words.keys[number - 1].chars().count() > 2 && !words.is(number - 1, &["the", "what"]))
        .then(|| words.replaced(vec![(number..number + 2, counted.to_string())]))
}

/// «Выключи всё в комнате», "turn everything off": all devices, where nothing is named behind.
fn everything_switched(words: &Words<'_>) -> Option<String> {
    let switches = |key: &String| {
        set!("SwitchStem").iter().any(|stem| key.starts_with(stem))
            || set!("SwitchVerb").contains(&key.as_str())
    };
    let orders = words.keys.iter().take(4).position(switches)?;
    // A state («выключено ли всё») is asked after.
    if words.keys[orders].contains("ключен") {
        return None;
    }
    let all = words.find(set!("Everything")).filter(|all| *all > orders)?;
    // «Выключи все», with nothing behind it and no ё: those that were spoken of, and without any it is asked which.
    if all + 1 == words.keys.len() && words.text[words.at[all].clone()].to_lowercase() == "все" {
        return None;
    }
    if all + 1 < words.keys.len() && !words.is(all + 1, set!("BehindEverything")) {
        return None;
    }
    let devices = Language::of(words.text).pick("все приборы", "all devices");
    Some(words.replaced(vec![(all..all + 1, devices.to_owned())]))
}

/// «Стулья 3 и 4», "chairs 3 and 4": the noun said again before the second number.
fn numbers_joined(words: &Words<'_>) -> Option<String> {
    let number = |n: usize| words.keys.get(n).is_some_and(|key| key.parse::<u32>().is_ok());
    let noun = |n: usize| words.keys[n].chars().all(char::is_alphabetic);
    let joint = (2..words.keys.len()).find(|&n| {
        words.is(n, set!("AndOr"))
            && number(n - 1)
            && noun(n - 2)
            && number(n + 1)
            && words.keys[n - 2].chars().count() > 2
    })?;
    let said = &words.text[words.at[joint - 2].clone()];
    let second = &words.text[words.at[joint + 1].clone()];
    Some(words.replaced(vec![(joint + 1..joint + 2, format!("{said} {second}"))]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructions_become_plain_ones() {
        let check = |text: &str, expected: &str| assert_eq!(plain(text), expected, "{text}");
        check("Выключи всё в спальне", "Выключи все приборы в спальне");
        check("Выключи все лампы", "Выключи все лампы");
        check("Turn everything off", "Turn all devices off");
        check("Стулья 3 и 4 белые?", "Стулья 3 и Стулья 4 белые?");
        check("4 стула и 2 стола", "4 стула и 2 стола");
        check("Tell me two things in each room", "Name two things in each room");
        check("Which of the books you listed is red?", "Which of these books is red?");
        check("процедурная номер два", "процедурная 2");
        check("", "");
    }
}
