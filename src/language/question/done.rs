//! What somebody has done to a thing, asked after by what it is like since: «я дверь закрыл?», "did I lock the door?"
//!
//! Invariant: who did it, when and why are other questions, and so is what the robot itself did.

use std::ops::Range;

use crate::units::InOrder as _;
use crate::words::{Language, word_keys, word_ranges};

/// Russian verbs up to the ending of their past, and the state that they bring about.
const VERBS: [(&str, &str); 11] = [
    ("закры", "закрыт"),
    ("прикры", "закрыт"),
    ("захлопну", "закрыт"),
    ("откры", "открыт"),
    ("запер", "заперт"),
    ("включи", "включён"),
    ("зажг", "включён"),
    ("выключи", "выключен"),
    ("погаси", "выключен"),
    ("отключи", "выключен"),
    ("выруби", "выключен"),
];

/// A text that asks for the state in place of the action.
pub(super) fn as_it_is(text: &str) -> Option<String> {
    let (at, keys) = (word_ranges(text), word_keys(text));
    match Language::of(text) {
        Language::Russian => russian(text, &at, &keys),
        Language::English => english(text, &at, &keys),
    }
}

fn russian(text: &str, at: &[Range<usize>], keys: &[String]) -> Option<String> {
    const OTHER: [&str; 16] = [
        "кто",
        "кем",
        "что",
        "чем",
        "когда",
        "где",
        "куда",
        "зачем",
        "почему",
        "сколько",
        "ты",
        "вы",
        "робот",
        "если",
        "бы",
        "чтобы",
    ];
    let past = |key: &String| {
        VERBS.iter().find_map(|(stem, state)| {
            let end = key.strip_prefix(stem)?;
            let ends = ["л", "ла", "ли"].contains(&end) || end.is_empty() && *stem == "запер";
            ends.then_some(*state)
        })
    };
    let mut actions = keys.iter().enumerate().filter_map(|(n, key)| Some((n, past(key)?)));
    let (action, state) = actions.next().filter(|_| actions.next().is_none())?;
    // «Кто-нибудь закрыл дверь?» asks of the door.
    let any = |key: &String| ["нибудь", "то", "либо"].contains(&key.as_str());
    let someone = keys.windows(2).position(|two| two[0] == "кто" && any(&two[1]));
    let asks = |key: &String| OTHER.contains(&key.as_str()) || key.starts_with("как");
    let asked = keys.iter().enumerate().any(|(n, key)| asks(key) && Some(n) != someone);
    // A thing is named beside who did it.
    if asked || keys.len() < 2 {
        return None;
    }
    let mut plain = text.to_owned();
    let mut changes = vec![(at[action].clone(), state)];
    changes.extend(someone.map(|n| (at[n].start..at[n + 1].end, "")));
    changes.order_by_key(|(range, _)| std::cmp::Reverse(range.start));
    for (range, by) in changes {
        plain.replace_range(range, by);
    }
    Some(plain)
}

/// "Did I turn the lamp off?", "have we locked the door?"
fn english(text: &str, at: &[Range<usize>], keys: &[String]) -> Option<String> {
    const SOMEONE: [&str; 9] =
        ["i", "we", "he", "she", "they", "anyone", "anybody", "someone", "somebody"];
    let [did, someone, action, .., last] = keys else { return None };
    let whether = ["did", "have", "has"].contains(&did.as_str());
    if !whether || !SOMEONE.contains(&someone.as_str()) {
        return None;
    }
    let switched = |word: &String| match word.as_str() {
        "on" => Some("switched on"),
        "off" => Some("switched off"),
        _ => None,
    };
    let end = keys.len();
    let (thing, state) = match action.as_str() {
        "close" | "closed" | "shut" => (3..end, "closed"),
        "open" | "opened" => (3..end, "open"),
        "lock" | "locked" => (3..end, "locked"),
        "unlock" | "unlocked" => (3..end, "unlocked"),
        "turn" | "turned" | "switch" | "switched" => match (switched(&keys[3]), switched(last)) {
            (Some(state), _) => (4..end, state),
            (None, Some(state)) => (3..end - 1, state),
            (None, None) => return None,
        },
        _ => return None,
    };
    let (first, last) = (at.get(thing.start)?, at.get(thing.end.checked_sub(1)?)?);
    let thing = text.get(first.start..last.end)?;
    Some(format!("is {thing} {state}?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_action_of_somebody_is_asked_after_by_the_state() {
        let check = |text: &str, expected: Option<&str>| {
            assert_eq!(as_it_is(text).as_deref(), expected, "{text}");
        };
        check("я дверь закрыл?", Some("я дверь закрыт?"));
        check("дверь не заперли?", Some("дверь не заперт?"));
        check("кто-нибудь закрыл дверь?", Some(" закрыт дверь?"));
        check("кто закрыл дверь?", None);
        check("ты закрыл дверь?", None);
        check("какую дверь закрыли?", None);
        check("did I lock the front door?", Some("is the front door locked?"));
        check("did somebody turn the lamp off?", Some("is the lamp switched off?"));
        check("did I turn off the lamp?", Some("is the lamp switched off?"));
        check("did you lock the door?", None);
        check("who locked the door?", None);
        check("did I leave?", None);
    }
}
