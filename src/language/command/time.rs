//! In which order orders are to be done, where a conjunction of time says so: "before leaving, close the door",
//! «когда приедешь на кухню, включи свет», "tell me when you have found the keys". By words alone, as
//! [`spoken`](super::spoken).

use std::ops::Range;

use super::ellipsis::first_word;
use super::said::Said;
use super::vocabulary::{Meaning, Verb, longest};
use crate::sets::{Set, set};
use crate::words::Language;

static BEFORE: Set = Set::named("BeforeDoing");
static AFTER: Set = Set::named("AfterDoing");

/// What an order that waits is followed by.
pub(super) static UNTIL: Set = Set::named("Until");

/// «придёт», «откроется»: what another does; what the robot is told is «приедешь».
pub(super) fn is_of_another(key: &str) -> bool {
    key.ends_with('т') || key.ends_with("тся")
}

/// A time of the clock or a span of it, at which or for which something is to be done: «через пять минут», "for two
/// hours", "tomorrow". «Подожди минуту» is but a way to say that it should wait.
pub(super) fn of_the_clock(said: &Said) -> Option<Range<usize>> {
    static UNITS: Set = Set::named("UnitOfTime");
    static SPANS: Set = Set::named("BeforeSpan");
    static TIMES: Set = Set::named("TimeOfDay");
    let unit = |n: usize| {
        said.keys.get(n).is_some_and(|key| UNITS.iter().any(|unit| key.starts_with(unit)))
    };
    let least = said.verb_from(0).map_or(0, |(verb, ..)| verb);
    // The verb before: "go there and wait for two minutes".
    let waiting = |at: usize| {
        let verb = |n: usize| match said.meaning(n) {
            Some((_, Meaning::Verb(verb))) => Some(verb),
            _ => None,
        };
        (0..at).rev().find_map(verb) == Some(Verb::Wait)
    };
    (0..said.keys.len()).find_map(|n| {
        // «Подожди две минуты»
        let several = |n: usize| unit(n) && said.keys[n].ends_with(['s', 'ы', 'т', 'а', 'в']);
        let waits = waiting(n);
        if waits && n > least && several(n) {
            return Some(n - 1..n + 1);
        }
        if let Some(taken) = said.phrase(n, &TIMES) {
            return Some(n..n + taken);
        }
        let span = n + said.phrase(n, &SPANS)?;
        let number = (span..span + 3).find(|&n| unit(n))?;
        // "in a second", «на минутку»
        let soon = number == span || said.is(span, set!("SoonSpan"));
        let told = !said.keys[number].ends_with("ку") && (!soon || said.is(n, &["через"]));
        (told && !waits || waits && n > least && !soon).then_some(n..number + 1)
    })
}

/// "Tell me when you have found the keys": each order ends with a report.
pub(super) fn told_when(said: &Said) -> Option<String> {
    static TELL: Set = Set::named("TellMe");
    let begin = first_word(said, &(0..said.keys.len()))?;
    let when = begin + said.phrase(begin, &TELL)?;
    let one = when + said.phrase(when, &AFTER)?;
    let rest = said.of(&(one..said.keys.len()));
    match of_verb(said, one) {
        Some((words, base)) => Some(format!("{base} {}", said.of(&(words..said.keys.len())))),
        None => said.verb_from(one).filter(|(verb, ..)| *verb == one).map(|_| rest.to_owned()),
    }
}

/// "Go to the bedroom, but first switch off the lamp", «прежде чем ехать в спальню, выключи лампу», "close the door
/// before leaving the room": in the order of time.
pub(super) fn in_time(said: &Said) -> Option<String> {
    static FIRST: Set = Set::named("ButFirst");
    let end = said.keys.len();
    let cut = (1..end).find_map(|at| Some((at, said.phrase(at, &FIRST)?)));
    if let Some((at, taken)) = cut.filter(|(at, taken)| at + taken < end) {
        let (later, first) = (said.of(&(0..at)), said.of(&(at + taken..end)));
        return Some(in_order(first, later));
    }
    let conjunction = |at: usize| {
        let before = said.phrase(at, &BEFORE).map(|taken| (taken, true));
        before.or(said.phrase(at, &AFTER).map(|taken| (taken, false)))
    };
    // «После» alone is a word of politeness, «после того как» is not.
    let word = first_word(said, &(0..end))?;
    let begin = (0..word).find(|&at| conjunction(at).is_some()).unwrap_or(word);
    let leads = conjunction(begin).is_some();
    let orders = |at: usize| said.verb_from(0).is_some_and(|(verb, ..)| verb < at);
    let at = match leads {
        true => begin,
        false => (begin + 1..end).find(|&at| conjunction(at).is_some() && orders(at))?,
    };
    let (taken, before) = conjunction(at)?;
    let one = at + taken;
    // "after closing the door", "once you have closed the door"
    if let Some((words, base)) = of_verb(said, one) {
        let rest = if words < end { said.of(&(words..end)) } else { "" };
        let told = format!("{} {base} {rest}", said.of(&(0..one)));
        return Some(told.trim_end().to_owned());
    }
    let (verb, length, _) = said.verb_from(one)?;
    if first_word(said, &(one..end)) != Some(verb) || is_of_another(&said.keys[verb]) {
        return None;
    }
    let joined = |n: usize| {
        matches!(said.meaning(n), Some((length, Meaning::And))
            if said.verb_from(n + length).is_some_and(|(next, ..)| first_word(said, &(n + length..end)) == Some(next)))
    };
    let next = (verb + length..end).find(|&n| said.parted(n) || (!leads && joined(n)));
    let clause = said.of(&(one..next.unwrap_or(end)));
    if leads {
        let other = said.of(&(next.filter(|&n| said.verb_from(n).is_some())?..end));
        return Some(if before { in_order(other, clause) } else { in_order(clause, other) });
    }
    let other = said.of(&(0..at));
    let both = if before { in_order(other, clause) } else { in_order(clause, other) };
    Some(match next {
        Some(next) => format!("{both}, {}", said.of(&(next..end))),
        None => both,
    })
}

fn in_order(first: &str, later: &str) -> String {
    format!("{first}, {} {later}", Language::of(first).pick("потом", "then"))
}

/// The verb of command that an English gerund or participle at a word comes from, and the word behind it: "leaving",
/// "have closed", "picking up".
fn of_verb(said: &Said, at: usize) -> Option<(usize, String)> {
    static IRREGULAR: Set = Set::named("Participle");
    // "Once you are in the hall", «когда будешь в коридоре»
    let placed = matches!(said.meaning(at + 1), Some((_, Meaning::Link(_))));
    if placed && said.is(at, set!("BeingThere")) {
        return Some((at + 1, Language::of(&said.keys[at]).pick("поезжай", "go").to_owned()));
    }
    let have = usize::from(said.is(at, set!("Have")));
    let key = said.keys.get(at + have)?.as_str();
    let irregular = IRREGULAR.meant().iter().find(|(form, _)| have > 0 && *form == key);
    let stems = [key.strip_suffix("ing"), key.strip_suffix("ed"), key.strip_suffix('d')];
    let mut bases: Vec<String> =
        irregular.map(|(_, base)| (*base).to_owned()).into_iter().collect();
    for stem in stems.into_iter().flatten() {
        let mut letters = stem.chars().rev();
        let doubled = letters.next().is_some_and(|last| letters.next() == Some(last));
        bases.push(stem.to_owned());
        bases.push(format!("{stem}e"));
        bases.extend(doubled.then(|| stem[..stem.len() - 1].to_owned()));
    }
    let rest = said.keys[at + have + 1..].iter().map(String::as_str);
    let is_verb = |base: &String| {
        let keys: Vec<&str> = std::iter::once(base.as_str()).chain(rest.clone()).collect();
        matches!(longest(&keys.into_iter()), Some((_, Meaning::Verb(verb))) if verb != Verb::Need)
    };
    let base = bases.into_iter().find(is_verb)?;
    Some((at + have + 1, base))
}

#[cfg(test)]
mod tests {
    use crate::command::gathered;

    #[test]
    #[cfg_attr(not(feature = "rumorph"), ignore = "the dictionary knows the forms of its verbs")]
    fn orders_follow_in_time() {
        for (said, order) in [
            ("Before leaving, close the door", "close the door"),
            ("Close the door before leaving", "Close the door"),
            ("Перед отъездом выключи телевизор", "выключи телевизор"),
            ("Когда закончишь, вернись на зарядку", "вернись на зарядку"),
            ("Bring the cup and when you are done, go home", "Bring the cup and, go to base"),
            ("Tell me when you have found the keys", "find the keys"),
            ("Close the door before leaving the room", "Close the door, then leave the room"),
            (
                "Go to the hall after picking up the pen and call the operator",
                "pick up the pen, then Go to the hall, and call the operator",
            ),
            ("Before going to the hall, take the pen", "take the pen, then go to the hall"),
            ("Когда приедешь на кухню, включи свет", "поезжай на кухню, включи свет"),
            ("Open the door once you get to the hall", "go to the hall, then Open the door"),
            (
                "Go to your charger, but first switch off the lamp",
                "switch off the lamp, then Go to your charger",
            ),
            ("Прежде чем ехать в спальню, выключи лампу", "выключи лампу, потом ехать в спальню"),
            ("After you have closed the door, come here", "close the door, then come here"),
            (
                "Когда дверь откроется, поезжай в спальню",
                "Когда дверь откроется, поезжай в спальню",
            ),
            (
                "После того как возьмёшь ключ, позови оператора",
                "возьмёшь ключ, потом позови оператора",
            ),
            ("Let me know once you are in the hall", "go in the hall"),
            ("Скажи, когда будешь в ванной", "поезжай в ванной"),
            ("Как закрыть дверь?", "Как закрыть дверь?"),
        ] {
            assert_eq!(gathered(said), order, "{said}");
        }
    }

    /// That «найдёшь» is a form of «найти» the dictionary alone knows.
    #[cfg(feature = "rumorph")]
    #[test]
    fn what_is_to_be_told_of_is_done() {
        assert_eq!(gathered("Сообщи мне, когда найдёшь лекарство"), "найдёшь лекарство");
    }
}
