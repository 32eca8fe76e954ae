//! How many of what is named are meant: all that is there, any of them, all at the end of a sentence. By words alone, as
//! [`spoken`](super::spoken).

use super::ellipsis::object;
use super::said::Said;
use super::states::state_at;
use super::verbs::{Sort, is_relative};
use super::vocabulary::Meaning;
use crate::words::{Cardinal, Language};

/// «всё со стола», "everything on the table", «то, что лежит на столе»: all things that are there.
pub(super) fn everything(said: &Said) -> Option<String> {
    const ALL: [&str; 7] = [
        "everything",
        "whatever is",
        "whatever s",
        "everything that is",
        "everything that s",
        "everything there is",
        "whatever lies",
    ];
    /// Only behind a verb that carries: "tell me what is on the table" asks.
    const WHAT: [&str; 16] = [
        "то что лежит",
        "то что стоит",
        "то что находится",
        "то что есть",
        "то что",
        "все что лежит",
        "все что стоит",
        "все что есть",
        "все что находится",
        "все что",
        "что лежит",
        "what is",
        "what s",
        "what lies",
        "that which is",
        "all that is",
    ];
    let before_link = |n: usize| matches!(said.meaning(n).map(|(_, m)| m), Some(Meaning::Link(_)));
    let carries = |at: usize| {
        let mut verb = said.verb_from(0);
        while let Some((from, taken, kind)) = verb {
            if from + taken == at {
                return matches!(Sort::of(kind), Sort::Carry | Sort::Put);
            }
            verb = said.verb_from(from + taken);
        }
        false
    };
    (0..said.keys.len()).find_map(|at| {
        let russian = said.text.get(said.words[at].clone())?.to_lowercase() == "всё";
        let there = |n: usize| before_link(n) || said.is(n, &["there", "там"]);
        let what = said.phrase(at, &WHAT).filter(|taken| carries(at) && there(at + taken));
        let taken = what.or(said.phrase(at, &ALL)).or(russian.then_some(1))?;
        let things = Language::of(&said.keys[at]).pick("все вещи", "all the things");
        // "Take what is inside": in what was spoken of.
        let inside = said.is(at + taken, &["inside", "внутри", "there", "там"]);
        if inside && at + taken + 1 == said.clause_end(at + taken) {
            let of_it = Language::of(&said.keys[at]).pick("из него", "from it");
            return Some(said.with(&(at..at + taken + 1), &format!("{things} {of_it}")));
        }
        let follows = before_link(at + taken) || said.is(at + taken, &["кроме", "except"]);
        follows.then(|| said.with(&(at..at + taken), things))
    })
}

/// «По одной книге из каждой комнаты», «по книге с каждого стола»: any of them from each.
pub(super) fn so_many_from_each(said: &Said) -> Option<String> {
    let each = |n: usize| matches!(said.meaning(n), Some((_, Meaning::All)));
    let (verb, taken, _) = said.verb_from(0)?;
    let at = (verb + taken..said.keys.len()).find(|&n| said.is(n, &["по"]))?;
    let end = said.clause_end(at);
    if !(at + 2..end).any(each) {
        return None;
    }
    let one = said.is(at + 1, &["одной", "одному"]);
    let counted = said.keys.get(at + 1).is_some_and(|key| Cardinal::read(key).is_some());
    let any = if counted && !one { "" } else { "любую" };
    Some(said.with(&(at..at + 1 + usize::from(one)), any))
}

/// "All lamps except the one in the bedroom", «все лампы, кроме той, что в спальне»: the noun once more.
pub(super) fn except_one(said: &Said) -> Option<String> {
    const EXCEPT: [&str; 8] = [
        "except",
        "except for",
        "apart from",
        "other than",
        "but",
        "кроме",
        "за исключением",
        "не считая",
    ];
    const ONE: [&str; 11] =
        ["the one", "the ones", "that", "those", "той", "того", "тех", "ту", "тот", "то", "те"];
    let (verb, taken, _) = said.verb_from(0)?;
    let (except, end) = (verb + taken + 1..said.keys.len()).find_map(|n| {
        let one = n + said.phrase(n, &EXCEPT)?;
        Some((n, one + said.phrase(one, &ONE)?))
    })?;
    let place = matches!(said.meaning(end), Some((_, Meaning::Link(_))));
    let (noun, _) = object(said, &(verb + taken..except));
    if noun.is_empty() || !(place || is_relative(&said.keys, end)) {
        return None;
    }
    let except_word = Language::of(&said.keys[except]).pick("кроме", "except");
    Some(said.with(&(except..end), &format!("{except_word} {}", said.of(&noun))))
}

/// "Lock every door that is open": its state stands before the noun.
pub(super) fn in_state(said: &Said) -> Option<String> {
    const IS: [&str; 6] = ["that is", "that are", "that s", "which is", "which are", "still"];
    let end = said.keys.len();
    let (at, state, next) = (2..end).find_map(|n| {
        let is = n + said.phrase(n, &IS)?;
        let state = is + usize::from(said.is(is, &["still"]));
        let next = state + state_at(said, state)?;
        // "that is on, please", but "that is on the shelf" is a place.
        let mut behind = next;
        while let Some((small, Meaning::Filler)) = said.meaning(behind) {
            behind += small;
        }
        let joint = || matches!(said.meaning(behind), Some((_, Meaning::And)));
        let ends = behind == end || said.parted(next) || said.parted(behind) || joint();
        ends.then_some((n, state, next))
    })?;
    let mut noun = 0;
    while let Some((verb, taken, _)) = said.verb_from(noun).filter(|(verb, ..)| *verb < at) {
        noun = verb + taken;
    }
    while let Some((taken, Meaning::Filler | Meaning::All | Meaning::Me)) = said.meaning(noun) {
        noun += taken;
    }
    (noun > 0 && noun < at).then(|| {
        let state = match said.of(&(state..next)) {
            half @ ("on" | "off") => format!("switched {half}"),
            state => state.to_owned(),
        };
        said.with(&(noun..next), &format!("{state} {}", said.of(&(noun..at))))
    })
}

/// «Принеси книжку, любую», "bring a book, any will do": any of them.
pub(super) fn any_at_the_end(said: &Said) -> Option<String> {
    const ANY: [&str; 27] = [
        "без разницы",
        "все равно",
        "whichever is closer",
        "whichever is nearer",
        "whichever is closest",
        "любую",
        "любой",
        "любое",
        "какую нибудь",
        "какой нибудь",
        "все равно какую",
        "все равно какой",
        "неважно какую",
        "неважно какой",
        "не важно какую",
        "не важно какой",
        "без разницы какую",
        "any",
        "any one",
        "any one will do",
        "any will do",
        "whichever",
        "it doesn t matter which",
        "doesn t matter which",
        "i don t care which",
        "no matter which",
        "whichever one",
    ];
    let at = (2..said.keys.len()).find(|&n| said.parted(n) && said.phrase(n, &ANY).is_some())?;
    let end = at + said.phrase(at, &ANY)?;
    let (verb, taken, _) = said.verb_from(0).filter(|(verb, ..)| *verb < at)?;
    let mut noun = verb + taken;
    while let Some((taken, Meaning::Filler | Meaning::Me)) = said.meaning(noun) {
        noun += taken;
    }
    let article = said.is(noun - 1, &["a", "an"]).then(|| said.words[noun - 1].start);
    let any = match Language::of(&said.keys[at]) {
        Language::Russian => "любую",
        Language::English => "any",
    };
    let mut text = said.without(&(at..end));
    let noun = said.words.get(noun).filter(|word| word.start < said.words[at].start)?;
    text.replace_range(article.unwrap_or(noun.start)..noun.start, &format!("{any} "));
    Some(text)
}

/// «Положи свечу на унитаз, обе», "find the remotes, all three": all of them.
pub(super) fn all_at_the_end(said: &Said) -> Option<String> {
    const ALL: [&str; 16] = [
        "обе",
        "оба",
        "все",
        "все три",
        "все четыре",
        "все две",
        "all of them",
        "both of them",
        "both",
        "all three",
        "all four",
        "all two",
        "each of them",
        "every one",
        "all",
        "каждую",
    ];
    let (verb, taken, _) = said.verb_from(0)?;
    let at = (verb + taken + 1..said.keys.len()).find(|&n| {
        let ends = |end: usize| end == said.keys.len() || said.parted(end);
        said.parted(n) && said.phrase(n, &ALL).is_some_and(|length| ends(n + length))
    })?;
    let end = at + said.phrase(at, &ALL)?;
    let all = Language::of(&said.keys[at]).pick(" все", " all");
    let mut text = said.without(&(at..end));
    text.insert_str(said.words[verb + taken - 1].end, all);
    Some(text)
}
