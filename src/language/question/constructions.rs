//! More constructions put plainly, by their words in order: what a room contains, doors to the outside, what shares a
//! place with a thing. A part of [`super::rephrase`].

use crate::language::words::{Case, Language, NounPhrase, WordHints, word_ranges};
use crate::units::name_key;

/// Beginnings that another beginning means; what follows stays.
const BEGINNINGS: [(&str, &str); 20] = [
    ("правда что", "правда ли, что"),
    ("верно что", "верно ли, что"),
    ("правда ведь что", "правда ли, что"),
    ("пройду ли я", "можно ли пройти"),
    ("попаду ли я", "можно ли попасть"),
    ("доберусь ли я", "можно ли добраться"),
    ("смогу ли я пройти", "можно ли пройти"),
    ("смогу ли я попасть", "можно ли попасть"),
    ("what do we have more of", "are there more"),
    ("what is there more of", "are there more"),
    ("what are there more of", "are there more"),
    ("which things share a surface with", "what else is on the same piece of furniture as"),
    ("what shares a surface with", "what else is on the same piece of furniture as"),
    ("which doors lead outside", "which are the exits"),
    ("what doors lead outside", "which are the exits"),
    ("which door leads outside", "where is the exit"),
    ("does any door lead outside", "is there an exit"),
    ("do any doors lead outside", "is there an exit"),
    ("does a door lead outside", "is there an exit"),
    ("where should i look for", "where is"),
];

/// Sentences with one gap: what stands in it goes into the gap of the other.
const FRAMES: [(&str, &str, &str, &str); 27] = [
    ("what door do i take to go from", "", "which door leads from", ""),
    ("which door do i take to go from", "", "which door leads from", ""),
    ("how do i get outside from", "", "how do i get from", "to the exit"),
    ("how do i get outside", "", "how do i get to the exit", ""),
    ("how do i leave the house from", "", "how do i get from", "to the exit"),
    ("how can i get outside from", "", "how do i get from", "to the exit"),
    ("what does", "contain", "what is in", ""),
    ("what do", "contain", "what is in", ""),
    ("which things does", "contain", "what is in", ""),
    ("what else is where", "is", "what else is on the same piece of furniture as", ""),
    ("what is lying where", "is", "what else is on the same piece of furniture as", ""),
    ("which rooms does", "connect", "what does", "join"),
    ("which rooms does", "join", "what does", "join"),
    ("can i go outside from", "", "is there an exit in", ""),
    ("can one go outside from", "", "is there an exit in", ""),
    ("can i leave the house directly from", "", "is there an exit in", ""),
    ("can i leave the house from", "", "is there an exit in", ""),
    ("can i get outside from", "", "is there an exit in", ""),
    ("ведет ли какая нибудь дверь на улицу", "", "есть ли выход", ""),
    ("ведет ли какая нибудь дверь наружу", "", "есть ли выход", ""),
    ("можно ли выйти из дома прямо с", "", "есть ли выход с", ""),
    ("можно ли выйти из дома прямо из", "", "есть ли выход из", ""),
    ("что содержит", "", "что внутри", ""),
    ("где искать", "", "где", ""),
    ("где мне искать", "", "где", ""),
    ("что еще лежит там же где и", "", "что ещё лежит на том же предмете мебели что и", ""),
    ("что еще лежит там же где", "", "что ещё лежит на том же предмете мебели что и", ""),
];

/// A text in the words of the first construction that it is.
pub(super) fn plain(text: &str) -> Option<String> {
    let at = word_ranges(text);
    let keys: Vec<String> = at.iter().map(|range| name_key(&text[range.clone()])).collect();
    let starts = |words: &[&str]| {
        words.len() <= keys.len() && words.iter().zip(&keys).all(|(word, key)| word == key)
    };
    let rest = |from: usize, to: usize| match from < to {
        true => text[at[from].start..at[to - 1].end].to_owned(),
        false => String::new(),
    };
    for (said, meant) in BEGINNINGS {
        let said: Vec<&str> = said.split(' ').collect();
        if starts(&said) {
            return Some(format!("{meant} {}?", rest(said.len(), keys.len())));
        }
    }
    for (start, end, before, after) in FRAMES {
        let start: Vec<&str> = start.split(' ').collect();
        let ends = end.is_empty() || keys.last().is_some_and(|key| key == end);
        let upto = keys.len().saturating_sub(usize::from(!end.is_empty()));
        if starts(&start) && ends {
            return Some(
                format!("{before} {} {after}", rest(start.len(), upto)).trim_end().to_owned() + "?",
            );
        }
    }
    connects_with(text, &keys, &at)
        .or_else(|| nearer_from(text, &keys, &at))
        .or_else(|| but_no(text, &keys, &at))
        .or_else(|| same_as_where(text, &keys, &at))
        .or_else(|| filler(text, &keys, &at))
}

/// "Which door connects the hall with the lab?": and the lab.
fn connects_with(text: &str, keys: &[String], at: &[std::ops::Range<usize>]) -> Option<String> {
    const CONNECTS: [&str; 6] = ["connects", "connect", "connecting", "joins", "join", "links"];
    let verb = keys.iter().position(|key| CONNECTS.contains(&key.as_str()))?;
    let with = (verb..keys.len()).find(|&n| keys[n] == "with")?;
    Some(format!("{}and{}", &text[..at[with].start], &text[at[with].end..]))
}

/// «От хлеба до чашки ближе, чем до яблока?»: is the cup nearer to the bread than the apple.
fn nearer_from(text: &str, keys: &[String], at: &[std::ops::Range<usize>]) -> Option<String> {
    let is = |n: usize, word: &str| keys.get(n).is_some_and(|key| key == word);
    let find = |from: usize, word: &str| (from..keys.len()).find(|n| is(*n, word));
    let to = find(1, "до").filter(|_| is(0, "от"))?;
    let nearer = (to..keys.len()).find(|n| is(*n, "ближе") || is(*n, "дальше"))?;
    let than = find(nearer, "чем").filter(|than| is(than + 1, "до") && than + 2 < keys.len())?;
    let part = |from: usize, to: usize| (from < to).then(|| &text[at[from].start..at[to - 1].end]);
    let (first, second) = (part(1, to)?, part(to + 1, nearer)?);
    let third = part(than + 2, keys.len())?;
    let compares = &keys[nearer];
    Some(format!("{first} {compares} к {second}, чем к {third}?"))
}

/// «на том же столе, где кофеварка»: the same as that with it.
fn same_as_where(text: &str, keys: &[String], at: &[std::ops::Range<usize>]) -> Option<String> {
    let same = (1..keys.len())
        .find(|&n| keys[n] == "же" && ["том", "той", "тех"].contains(&keys[n - 1].as_str()))?;
    let place = (same..keys.len()).find(|&n| keys[n] == "где")?;
    let partner = place + 1 + usize::from(keys.get(place + 1).is_some_and(|key| key == "и"));
    let rest = &text[at.get(partner)?.start..];
    Some(format!("{} что и {rest}", &text[..at[place - 1].end]))
}

/// "I'm in the bathroom. How do I get to the kitchen?": from there.
pub(super) fn from_where_i_am(text: &str) -> Option<String> {
    let (told, asked) = text.split_once('.')?;
    let told = told.trim().trim_start_matches("I am ").trim_start_matches("I'm ");
    let place = told.strip_prefix("in ")?;
    let asked = asked.trim().trim_end_matches('?');
    let way = ["how do i get to", "how can i get to", "how do i get outside"];
    let asked = if way.iter().any(|way| asked.to_lowercase().starts_with(way)) {
        asked
    } else {
        return None;
    };
    let whole = format!("{asked} from {place}?");
    Some(plain(&whole).unwrap_or(whole))
}

/// "Which rooms have a bed but no lamp?", «В каких комнатах есть кровать, но нет лампы?»: those with one, without the
/// other.
fn but_no(text: &str, keys: &[String], at: &[std::ops::Range<usize>]) -> Option<String> {
    let find = |words: &[&str]| {
        (0..keys.len()).find(|&n| {
            words.iter().enumerate().all(|(i, word)| keys.get(n + i).is_some_and(|key| key == word))
        })
    };
    let part = |from: usize, to: usize| {
        (from < to).then(|| text[at[from].start..at[to - 1].end].trim_end_matches(','))
    };
    let end = keys.len();
    let rooms = ["which rooms", "what rooms", "which room", "what room"];
    if rooms.contains(&keys.get(..2)?.join(" ").as_str()) {
        let have = find(&["have"]).or_else(|| find(&["has"])).filter(|have| *have >= 2)?;
        if let Some(but) = find(&["but", "no"]) {
            let (with, without) = (part(have + 1, but)?, part(but + 2, end)?);
            return Some(format!("Which rooms with {with} are without {without}?"));
        }
        // "Which rooms with a bed have no lamp?"
        let with = find(&["with"]).filter(|with| *with == 2)?;
        let no = find(&["have", "no"]).or_else(|| find(&["has", "no"]))?;
        let (with, without) = (part(with + 1, no)?, part(no + 2, end)?);
        return Some(format!("Which rooms with {with} are without {without}?"));
    }
    let asked = ["в каких комнатах есть", "в какой комнате есть"];
    let asks = asked.contains(&keys.get(..4)?.join(" ").as_str());
    let but = find(&["но", "нет"]).or_else(|| find(&["а", "нет"])).filter(|_| asks)?;
    let (with, without) = (part(4, but)?, part(but + 2, end)?);
    let with = NounPhrase::parse(with, &WordHints::default());
    let with = with.form(Case::Instrumental, with.number());
    Some(format!("Комнаты с {with} без {without}"))
}

/// «На каких стульях что-нибудь лежит?»: things lie.
fn something_there(text: &str, keys: &[String], at: &[std::ops::Range<usize>]) -> Option<String> {
    let which = ["каком", "какой", "каких"].contains(&keys.get(1)?.as_str());
    let thing = |n: &usize| {
        keys[*n] == "что"
            && keys.get(n + 1).is_some_and(|k| ["нибудь", "то", "либо"].contains(&k.as_str()))
    };
    let thing = (2..keys.len()).find(thing).filter(|_| which && keys[0] == "на")?;
    let verb =
        (2..keys.len()).find(|n| ["лежит", "стоит", "есть", "находится"].contains(&&*keys[*n]));
    let end = thing.min(verb?);
    (end > 2 && keys.len() <= end + 3).then(|| format!("{} есть вещи?", &text[..at[end - 1].end]))
}

/// Words that say nothing more: "How many rooms have paintings in them?", "both a bed and a desk".
fn filler(text: &str, keys: &[String], at: &[std::ops::Range<usize>]) -> Option<String> {
    if Language::of(text) != Language::English {
        return something_there(text, keys, at);
    }
    let is = |n: usize, all: &[&str]| keys.get(n).is_some_and(|key| all.contains(&key.as_str()));
    let last = keys.len().checked_sub(1)?;
    let rooms = keys.iter().any(|key| ["rooms", "room"].contains(&key.as_str()));
    let have = keys.iter().any(|key| ["have", "has", "contain"].contains(&key.as_str()));
    if last > 2 && rooms && have && is(last, &["them", "it"]) && is(last - 1, &["in", "inside"]) {
        return Some(format!("{}?", &text[..at[last - 2].end]));
    }
    let both = (0..keys.len())
        .find(|n| is(*n, &["both"]) && (is(*n + 1, &["a", "an"]) || rooms && have))?;
    let and = (both..keys.len()).any(|n| is(n, &["and"]));
    and.then(|| format!("{}{}", &text[..at[both].start], &text[at[both + 1].start..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructions_are_put_plainly() {
        let check = |text: &str, meant: &str| assert_eq!(plain(text).as_deref(), Some(meant));
        check("What does the bedroom contain?", "what is in the bedroom?");
        check("Which rooms does Door 1 connect?", "what does Door 1 join?");
        check("What do we have more of, chairs or books?", "are there more chairs or books?");
        check("How many rooms have paintings in them?", "How many rooms have paintings?");
        check("Does the room have both a bed and a desk?", "Does the room have a bed and a desk?");
        check("Где искать статуэтку?", "где статуэтку?");
        assert_eq!(
            from_where_i_am("I'm in the hall. How do I get outside?").as_deref(),
            Some("how do i get from the hall to the exit?")
        );
        check(
            "Что ещё есть на том же столе, где и газета?",
            "Что ещё есть на том же столе что и газета?",
        );
        check("Which rooms have books but no lamps?", "Which rooms with books are without lamps?");
        check(
            "Which door connects the hall with the lab?",
            "Which door connects the hall and the lab?",
        );
        check("От хлеба до чашки ближе, чем до яблока?", "хлеба ближе к чашки, чем к яблока?");
        check("Правда, что газета на диване?", "правда ли, что газета на диване?");
        assert_eq!(plain("Where are both chairs?"), None);
        assert_eq!(plain("in it"), None);
        // Every order of the words that are looked for, some of them missing.
        let words = [
            "от",
            "до",
            "ближе",
            "чем",
            "до",
            "на",
            "каких",
            "что",
            "то",
            "лежит",
            "том",
            "же",
            "где",
            "и",
            "which",
            "rooms",
            "have",
            "but",
            "no",
            "with",
            "connects",
            "both",
            "a",
            "in",
            "it",
        ];
        for length in 1..6 {
            for start in 0..words.len() {
                for step in 1..words.len() {
                    let some = (0..length).map(|n| words[(start + n * step) % words.len()]);
                    let text = some.collect::<Vec<_>>().join(" ");
                    let _ = (plain(&text), from_where_i_am(&format!("{text}. {text}")));
                }
            }
        }
        assert_eq!(plain(""), None);
    }
}
