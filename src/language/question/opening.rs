//! How a sentence begins: whether it asks, asks to be told, or orders.

use super::mark::Mark;
use super::query::Rel;
use super::vocabulary::longest;
use crate::sets::{Set, set};
use crate::words::word_keys;

/// Whether these words, in [`name_key`](crate::units::name_key) form, begin a question: after small words, one that asks.
pub(super) fn begins_question(words: &[String]) -> bool {
    // «Дойдёшь ли ты …?» asks; «Можешь ли открыть дверь?» is a polite command.
    static POLITE: Set = Set::named("PoliteAble");
    if let [first, second, ..] = words
        && second == "ли"
        && !POLITE.contains(&first.as_str())
    {
        return true;
    }
    // «Где-то был мой зонтик» tells.
    if words.get(1).is_some_and(|word| set!("Particle").contains(&word.as_str())) {
        return false;
    }
    let mut at = 0;
    while let Some((taken, mark)) = longest(&words[at..]) {
        match mark {
            Mark::Filler | Mark::But | Mark::The | Mark::A | Mark::You | Mark::Me | Mark::And => {
                at += taken
            }
            // «Можно ли сесть на кровать?» asks; «Можешь открыть дверь?» is a polite command.
            Mark::Can => {
                // «Можно попросить тебя принести чашку?»
                let rest = &words[at + taken..];
                if rest.iter().take(2).any(|word| word == "попросить") {
                    return false;
                }
                return asks_leave(&words[at..at + taken]) || asks_way(&words[at + taken..]);
            }
            // «Скажи, в какой комнате плита»
            Mark::Link(_) => {
                let next = longest(&words[at + taken..]);
                return matches!(next, Some((_, Mark::Which | Mark::What)));
            }
            Mark::Not => return false,
            Mark::PutDown | Mark::Free | Mark::See | Mark::Hold | Mark::Lead | Mark::Move => {
                return false;
            }
            _ => return true,
        }
    }
    false
}

/// Whether a word for what is not known stands first, after small ones: «ну где», "how many".
pub(super) fn asks_by_a_word(words: &[String]) -> bool {
    let mut at = 0;
    while let Some((taken, mark)) = longest(&words[at..]) {
        match mark {
            Mark::Filler | Mark::But | Mark::The | Mark::And => at += taken,
            // «в какой комнате»
            Mark::Link(_) => {
                let next = longest(&words[at + taken..]);
                return matches!(next, Some((_, Mark::Which | Mark::What)));
            }
            // What there is may be told as well: «есть кофе, принеси».
            mark => return mark.asks() && mark != Mark::Exists,
        }
    }
    false
}

/// Whether the first of these words asks by itself: no small word stands before it.
pub(super) fn asks_at_once(words: &[String]) -> bool {
    let small = |mark| {
        matches!(
            mark,
            Mark::Filler | Mark::But | Mark::The | Mark::A | Mark::You | Mark::Me | Mark::And
        )
    };
    longest(words).is_some_and(|(_, mark)| !small(mark)) && begins_question(words)
}

/// «Скажите, а чайник электрический?»: who begs to be told and asks gives no order.
pub(super) fn begs_to_tell(text: &str) -> bool {
    let first = word_keys(text).into_iter().next().unwrap_or_default();
    let tells = set!("TellStem").iter().any(|stem| first.starts_with(stem));
    tells && text.trim_end().ends_with('?')
}

/// Whether a word is of the person who speaks: "I", «нам».
pub(super) fn is_me(key: &String) -> bool {
    is_of_me(std::slice::from_ref(key))
}

/// "I am hungry", «мне холодно»: what a person tells of itself.
pub(super) fn is_of_me(words: &[String]) -> bool {
    longest(words).is_some_and(|(_, mark)| mark == Mark::Me)
}

/// Whether these words begin, after small ones, with a way, a list or a description to be told.
pub(super) fn asks_to_tell(words: &[String]) -> bool {
    // «Дай знать, где телевизор»
    let begs =
        matches!(words, [first, second, ..] if first.starts_with("дай") && second == "знать");
    if begs && begins_question(&words[2..]) {
        return true;
    }
    let mut at = 0;
    while let Some((taken, mark)) = longest(&words[at..]) {
        match mark {
            Mark::Filler | Mark::But | Mark::The | Mark::A | Mark::Me => at += taken,
            mark => return matches!(mark, Mark::HowGet | Mark::List | Mark::Describe),
        }
    }
    false
}

/// Whether these words of [`Mark::Can`] ask what may or can be done, and not the robot to do it.
fn asks_leave(words: &[String]) -> bool {
    static ROBOT: Set = Set::named("AsksRobot");
    !ROBOT.contains(&words.join(" ").as_str())
}

/// "Can you get from the hall to the kitchen?": of a way between two others the robot is asked, not sent.
fn asks_way(words: &[String]) -> bool {
    let you = longest(words).filter(|(_, mark)| *mark == Mark::You).map_or(0, |(taken, _)| taken);
    let Some((taken, Mark::Move)) = longest(&words[you..]) else { return false };
    let next = longest(&words[you + taken..]).map(|(_, mark)| mark);
    // "Can you get into the office?" asks; "Can you get to it?" may send.
    let into = |word: &String| set!("IntoOrPast").contains(&word.as_str());
    if words.get(you).is_some_and(|word| word == "get") && words.get(you + taken).is_some_and(into)
    {
        return true;
    }
    // "Can you drive through it?" asks of a door.
    matches!(next, Some(Mark::Link(Rel::From | Rel::Through)))
}
