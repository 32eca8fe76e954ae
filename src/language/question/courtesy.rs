//! Words that people say to be polite and that ask nothing: greetings, thanks, farewells.
//!
//! Invariant: only a sentence of nothing else is one.

use super::query::{Courtesy, Query};
use crate::words::word_keys;

const PHRASES: &[(Courtesy, &str)] = &[
    (
        Courtesy::Greeting,
        "привет|приветствую|здравствуй|здравствуйте|добрый день|добрый вечер|доброе утро|доброго дня|доброго утра|hello|hi|hey|hello there|hi there|hey there|good morning|good afternoon|good evening|good day|greetings",
    ),
    (
        Courtesy::Thanks,
        "спасибо|большое спасибо|спасибо большое|спасибо тебе|огромное спасибо|спс|благодарю|благодарю вас|thanks|thank you|thanks a lot|many thanks|thank you very much|thank you so much|cheers|much appreciated",
    ),
    (
        Courtesy::Farewell,
        "пока|до свидания|до встречи|всего доброго|всего хорошего|прощай|увидимся|спокойной ночи|bye|goodbye|good bye|bye bye|see you|see you later|good night|farewell",
    ),
    (
        Courtesy::HowAreYou,
        "как дела|как поживаешь|как жизнь|как твои дела|как ты|how are you|how are you doing|how s it going|how is it going|how do you do|what s up",
    ),
    (
        Courtesy::Assent,
        "хорошо|ладно|понятно|понял|поняла|ясно|отлично|молодец|здорово|ok|okay|all right|alright|great|i see|got it|understood|good|well done|nice|perfect|good robot|good job",
    ),
];

/// Words that may stand beside them.
const BESIDE: [&str; 10] =
    ["робот", "рб 2", "robot", "rb 2", "друг", "дорогой", "there", "and", "и", "very much"];

/// The courtesy that a sentence is; of several the last one that wants an answer.
pub(super) fn of(text: &str) -> Option<Courtesy> {
    let keys = word_keys(text);
    let (mut at, mut said) = (0, None);
    while at < keys.len() {
        let phrase = |n: &usize| keys.get(at..at + n).map(|words| words.join(" "));
        let courtesy = (1..=4).rev().find_map(|n| Some((n, listed(&phrase(&n)?)?)));
        let beside =
            (1..=2).rev().find(|n| phrase(n).is_some_and(|p| BESIDE.contains(&p.as_str())));
        match (courtesy, beside) {
            (Some((taken, courtesy)), _) => {
                said = Some(courtesy);
                at += taken;
            }
            (None, Some(taken)) => at += taken,
            (None, None) => return None,
        }
    }
    said
}

fn listed(phrase: &str) -> Option<Courtesy> {
    let lists = |all: &str| all.split('|').any(|one| one == phrase);
    PHRASES.iter().find(|(_, all)| lists(all)).map(|(courtesy, _)| *courtesy)
}

/// As a query, where a sentence is nothing but polite.
pub(super) fn query(text: &str) -> Option<Query> {
    of(text).map(Query::Courtesy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_polite_sentences_are_courtesies() {
        let check =
            |text: &str, expected: Option<Courtesy>| assert_eq!(of(text), expected, "{text}");
        check("Спасибо!", Some(Courtesy::Thanks));
        check("Здравствуй, робот", Some(Courtesy::Greeting));
        check("Okay, thank you very much!", Some(Courtesy::Thanks));
        check("Спасибо, а где стол?", None);
        check("робот", None);
        check("", None);
    }
}
