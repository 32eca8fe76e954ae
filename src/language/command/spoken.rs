//! Spoken constructions put into plain orders, by words alone: «убедись, что дверь закрыта» is «закрой дверь», "not the
//! red cup but the white one" is "the white cup".
//!
//! Invariant: a rewriting drops only words that say what is not to be done, or that say how it is said; a text that has
//! none of these constructions stays as it is, and what was rewritten once is not rewritten again.

use std::ops::Range;

use super::ellipsis;
use super::kinds::senses;
use super::said::{Said, is_adjective};
use super::time;
use super::verbs::{Sort, is_relative};
use super::vocabulary::{Meaning, Role, Verb};
use crate::command::Relation;
use crate::paraphrase::{Paraphrases, Stage, lost};
use crate::words::Language;

/// What a rewriting may leave out.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Loss {
    /// Small words and the words of its own phrases, no name, number or description.
    Small,
    /// What is said not to be meant, or is told by its phrase: «не красную», "the house".
    NotMeant,
}

type Rewriting = fn(&Said) -> Option<String>;

/// The text as plain orders, and the words that were left out because they are not meant.
pub(super) fn plain(text: &str, lines: &Paraphrases) -> (String, Vec<String>) {
    use Loss::{NotMeant, Small};
    /// Before what a clause leaves out is said again: each clause stands where its time is.
    const IN_TIME: &[(Rewriting, Loss)] = &[(time::told_when, Small), (time::in_time, Small)];
    const CLAUSES: &[(Rewriting, Loss)] = &[
        (spared, NotMeant),
        (excluded, NotMeant),
        // Before «а Книгу-4 оставь» gets its verb first.
        (left_alone, NotMeant),
        (ellipsis::verb_first, Small),
        (ellipsis::verb_again, Small),
        (ellipsis::object_again, Small),
        (ellipsis::object_shared, Small),
        (ellipsis::noun_again, Small),
        (dashed, Small),
    ];
    let mut text = text.to_owned();
    let mut not_meant = Vec::new();
    for (stage, rewritings) in
        [(Stage::InTime, IN_TIME), (Stage::Early, CLAUSES), (Stage::Late, &[])]
    {
        if let Some((plain, left_out)) = lines.ordered(&text, stage, senses) {
            text = plain;
            not_meant.extend(left_out);
        }
        text = rewritten(text, rewritings, &mut not_meant);
    }
    (text, not_meant)
}

/// A text by each rewriting, as long as that changes something.
fn rewritten(text: String, all: &[(Rewriting, Loss)], not_meant: &mut Vec<String>) -> String {
    /// No sentence has more of one construction.
    const MOST: usize = 4;
    let mut said = Said::new(text);
    for (rewrite, loss) in all {
        for _ in 0..MOST {
            match rewrite(&said) {
                Some(text) if text != said.text => {
                    let after = Said::new(text);
                    if *loss == Loss::NotMeant {
                        not_meant.extend(lost(&said.keys, &after.keys));
                    }
                    said = after;
                }
                _ => break,
            }
        }
    }
    said.text
}

/// «Принеси чашки, а в гостиной не надо»: all but those. Whether what is carried is not to go there or not to come from
/// there, is not guessed.
fn spared(said: &Said) -> Option<String> {
    let (verb, taken, kind) = said.verb_from(0).filter(|(.., verb)| *verb != Verb::Needless)?;
    let (needless, length, _) =
        said.verb_from(verb + taken).filter(|(.., verb)| *verb == Verb::Needless)?;
    let end = needless + length;
    let begin = (verb + taken + 1..=needless).rev().find(|&n| said.parted(n))?;
    let joint = |n: &usize| {
        matches!(said.meaning(*n), Some((_, Meaning::And | Meaning::Filler)))
            || said.is(*n, &["but", "но", "а", "только"])
    };
    // «…, только не надо из спальни»
    let told = match (begin..needless).find(|n| !joint(n)) {
        Some(from) if end == said.keys.len() || said.parted(end) => from..needless,
        None => end..said.clause_end(end.min(said.keys.len().checked_sub(1)?)),
        Some(_) => return None,
    };
    if told.is_empty() {
        return None;
    }
    let end = end.max(told.end);
    let link = said.meaning(told.start).filter(|(_, meaning)| matches!(meaning, Meaning::Link(_)));
    let moves = matches!(Sort::of(kind), Sort::Go | Sort::Put);
    if link.is_some_and(|(_, link)| link.says_whither()) && moves {
        return (Sort::of(kind) == Sort::Go).then(|| said.without(&(begin..end)));
    }
    let noun = object_of(said, verb + taken..begin);
    if link.is_some() && noun.is_empty() {
        return None;
    }
    let except = Language::of(&said.keys[told.start]).pick("кроме", "except");
    let mut text = said.text.clone();
    let out = match link {
        Some(_) => format!(" {except} {} {}", said.of(&noun), said.of(&told)),
        None => format!(" {except} {}", with_noun(said, &told, &noun)),
    };
    text.replace_range(said.words[begin - 1].end..said.words[end - 1].end, &out);
    Some(text)
}

/// "the cup, not the red one", «чашку, только не красную»: all but that.
fn excluded(said: &Said) -> Option<String> {
    const BUT_NOT: [&str; 5] = ["but not", "and not", "только не", "но не", "а не"];
    const NOT: [&str; 2] = ["not", "не"];
    let not = |n: usize| said.phrase(n, &NOT).filter(|_| said.parted(n));
    let (at, taken) = (2..said.keys.len())
        .find_map(|n| Some((n, said.phrase(n, &BUT_NOT).or_else(|| not(n))?)))?;
    let mut end = said.clause_end(at + taken);
    // «…, а не ту, что на столе»
    if end == at + taken + 1 && is_relative(&said.keys, end - 1) && end < said.keys.len() {
        end = said.clause_end(end);
    }
    let told = at + taken..end;
    // «не заезжая в кухню», "not entering the kitchen" forbids; it leaves nothing out.
    if said.keys.get(told.start).is_some_and(|key| is_gerund(key)) {
        return None;
    }
    let except = Language::of(&said.keys[at]).pick("кроме", "except");
    let ordered = said.verb_from(0);
    let goes = ordered.is_some_and(|(.., verb)| verb == Verb::GoTo);
    let link = said.meaning(at + taken).filter(|(_, meaning)| matches!(meaning, Meaning::Link(_)));
    // «книгу, только не из спальни»: one that is elsewhere, where no place was said.
    if let (Some((_, link)), Some((verb, heard, _))) = (link, ordered.filter(|_| !goes))
        && !link.says_whither()
        && let (noun, None) = ellipsis::object(said, &(verb + heard..at))
        && !noun.is_empty()
    {
        let noun = said.of(&noun);
        let mut text = said.text.clone();
        let out = format!(" {except} {noun} {}", said.of(&told));
        text.replace_range(said.words[at - 1].end..said.words[end - 1].end, &out);
        return Some(text);
    }
    // "to me, not to the kitchen", "go to the desk, not the workbench": the other place is merely not meant. Through
    // which not to go, and how near, is a bound of its own.
    if goes || link.is_some() {
        let other = match link {
            Some((_, link)) => says_place(link, goes),
            None => {
                // "not past the bedroom" names nothing yet.
                let article = said.phrase(told.start, &["the", "a", "an"]);
                let named = told.start + article.unwrap_or(0)..told.end;
                let is_name = |text: &str| text.starts_with(char::is_uppercase);
                !named.is_empty()
                    && (article.is_some() || is_name(said.of(&named)))
                    && named.clone().all(|n| said.meaning(n).is_none())
                    && Language::of(said.of(&named)) == Language::English
            }
        };
        return other.then(|| said.without(&(at..end)));
    }
    // "the bowl from the table, not the one from the bed": told by its own place already.
    let link = |n: usize| matches!(said.meaning(n), Some((_, Meaning::Link(link))) if link.role != Role::Whither);
    let other_place =
        said.phrase(at + taken, &["the one", "the ones", "ту что", "тот что", "то что"]);
    if other_place.is_some() && (0..at).any(link) {
        return Some(said.without(&(at..end)));
    }
    if told.is_empty()
        || told.clone().any(|n| matches!(said.meaning(n), Some((_, Meaning::Verb(_)))))
    {
        return None;
    }
    let from = said.words[at - 1].end;
    let noun = ordered.map_or(0..0, |(verb, heard, _)| object_of(said, verb + heard..at));
    let mut text = said.text.clone();
    let out = format!(" {except} {}", with_noun(said, &told, &noun));
    text.replace_range(from..said.words[end - 1].end, &out);
    Some(text)
}

/// What is named behind a verb, before the first preposition.
fn object_of(said: &Said, words: Range<usize>) -> Range<usize> {
    if words.is_empty() { words } else { ellipsis::object(said, &words).0 }
}

/// «красную» of some cups, with its noun.
fn with_noun(said: &Said, told: &Range<usize>, noun: &Range<usize>) -> String {
    let alone = told.len() == 1 && is_adjective(&said.keys[told.start]) && !noun.is_empty();
    match noun.end.checked_sub(1) {
        Some(last) if alone => format!("{} {}", said.of(told), said.of(&(last..noun.end))),
        _ => said.of(told).to_owned(),
    }
}

/// Whether a preposition tells where something ends up, and not through what or how near.
fn says_place(link: Meaning, goes: bool) -> bool {
    let Meaning::Link(link) = link else { return false };
    let is_goal = matches!(link.relation, Relation::At | Relation::In | Relation::On);
    match link.role {
        Role::Whither => true,
        Role::Whence => !goes,
        Role::WhereOrWhither | Role::Where => is_goal,
        Role::Via => false,
    }
}

/// «заезжая», «не глядя», «закрыв», "entering": by its ending, where a thing left out would stand.
fn is_gerund(key: &str) -> bool {
    const ENDS: [&str; 8] = ["я", "ясь", "ав", "ив", "ев", "ыв", "вши", "вшись"];
    let long = key.chars().count() > 4;
    match Language::of(key) {
        Language::Russian => long && ENDS.iter().any(|end| key.ends_with(end)),
        Language::English => long && key.ends_with("ing"),
    }
}

/// "Leave the bowl where it is and …", «другая пусть остаётся»: beside what is to be done.
fn left_alone(said: &Said) -> Option<String> {
    const ALONE: [&str; 31] = [
        "leave it",
        "leave them",
        "leave that",
        "leave this",
        "the rest",
        "the others",
        "остальное",
        "остальные",
        "оставь остальное",
        "оставь остальные",
        "where it is",
        "where they are",
        "as it is",
        "as they are",
        "alone",
        "in peace",
        "open",
        "closed",
        "shut",
        "пусть остается",
        "пусть останется",
        "пусть стоит",
        "пусть лежит",
        "пусть остаются",
        "не трогай",
        "оставь на месте",
        "оставь там",
        "оставь как есть",
        "оставь где стоит",
        "оставь где лежит",
        "оставь",
    ];
    let parted = |n: usize| said.parted(n) || matches!(said.meaning(n), Some((_, Meaning::And)));
    let (at, taken) = (0..said.keys.len()).find_map(|n| Some((n, said.phrase(n, &ALONE)?)))?;
    let end = at + taken;
    if end < said.keys.len() && !parted(end) {
        return None;
    }
    let begin = (0..=at).rev().find(|&n| n == 0 || parted(n))?;
    let english = Language::of(&said.keys[at]) == Language::English;
    let leaves = !english || said.is(begin, &["leave"]) || said.is(begin + 1, &["leave"]);
    let mut next = end;
    while next < said.keys.len() && matches!(said.meaning(next), Some((_, Meaning::And))) {
        next += 1;
    }
    let (before, after) = (
        if begin > 0 { said.of(&(0..begin)) } else { "" },
        if next < said.keys.len() { said.of(&(next..said.keys.len())) } else { "" },
    );
    let orders = |part: &str| Said::new(part.to_owned()).verb_from(0).is_some();
    if !leaves || !(orders(before) || orders(after)) {
        return None;
    }
    let whole = [before, after].into_iter().filter(|p| !p.is_empty()).collect::<Vec<_>>();
    let whole = whole.join(", ");
    // "… all the books, but leave Book 4 where it is": what is left is no part of what is done.
    let idle = |n: usize| matches!(said.meaning(n), Some((_, Meaning::And | Meaning::Filler)));
    let small = |n: usize| idle(n) || said.is(n, &["leave", "оставь"]);
    let from = (begin..at).find(|n| !small(*n)).unwrap_or(at);
    const REST: [&str; 13] = [
        "it", "them", "that", "those", "this", "these", "rest", "other", "others", "ее", "его",
        "их", "это",
    ];
    let rest = (from..at).any(|n| {
        said.is(n, &REST) || said.keys[n].starts_with("друг") || said.keys[n].starts_with("остальн")
    });
    // "Leave the bowl where it is and bring the cup" leaves out nothing of what is brought.
    let ordered = Said::new(whole.clone());
    let all = |n: usize| {
        matches!(ordered.meaning(n), Some((_, Meaning::All))) || ordered.is(n, &["everything"])
    };
    let may_be = (0..ordered.keys.len()).any(all)
        || (from..at)
            .filter(|n| !idle(*n))
            .any(|n| ordered.keys.iter().any(|key| is_akin(&said.keys[n], key)));
    match from == at || rest || !may_be {
        true => Some(whole),
        false => {
            let except = if english { "except" } else { "кроме" };
            Some(format!("{whole} {except} {}", said.of(&(from..at))))
        }
    }
}

/// Whether two words are forms of one: «книги», «Книгу-4».
fn is_akin(one: &str, other: &str) -> bool {
    let shared = one.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
    let shorter = one.chars().count().min(other.chars().count());
    shared >= 3 && shared + 2 >= shorter
}

/// «Карандаш – на комод, книгу – на кровать»: things and whither each goes, without a verb.
fn dashed(said: &Said) -> Option<String> {
    if said.verb_from(0).is_some() || said.text.contains('?') {
        return None;
    }
    let gap = |n: usize| &said.text[said.words[n - 1].end..said.words[n].start];
    let dash = |n: usize| gap(n).contains(['–', '—']) || gap(n) == " - ";
    let whither = |n: usize| matches!(said.meaning(n), Some((_, m)) if m.says_whither());
    let at: Vec<usize> = (1..said.keys.len()).filter(|&n| dash(n) && whither(n)).collect();
    let first = *at.first()?;
    let put = Language::of(&said.keys[first]).pick("положи ", "put ");
    let begins = |n: usize| (0..n).rev().find(|&b| b == 0 || (said.parted(b) && !dash(b)));
    let begins: Vec<usize> = at.iter().filter_map(|n| begins(*n)).collect();
    // «Книга – на стол – на стул» says one thing twice.
    if begins.windows(2).any(|pair| pair[0] == pair[1]) {
        return None;
    }
    let mut text = said.text.clone();
    for (n, begin) in at.into_iter().zip(begins).rev() {
        text.replace_range(said.words[n - 1].end..said.words[n].start, " ");
        text.insert_str(said.words[begin].start, put);
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructions_become_orders() {
        let lines = Paraphrases::built_in();
        for (said, order) in [
            ("Don't go to the kitchen, go to the bedroom", "go to the bedroom"),
            ("Не надо вилку, принеси ложку", "принеси ложку"),
            (
                "Don't go through the hall, go to the bedroom",
                "Don't go through the hall, go to the bedroom",
            ),
            ("Go to the bedroom, but not via the hall", "Go to the bedroom, but not via the hall"),
            ("Принеси книгу из зала, а не из спальни", "Принеси книгу из зала"),
            ("Поезжай на кухню и остановись у стола", "Поезжай на кухню и встань у стола"),
            ("Не открывай дверь, а закрой её", "закрой её"),
            ("Принеси не красную чашку, а белую", "Принеси белую чашку"),
            ("Не на кухню, а в спальню поезжай", "в спальню поезжай"),
            ("Bring not the red cup but the white one", "Bring the white cup"),
            ("Bring the cup, not the red one", "Bring the cup except the red one"),
            (
                "Please make sure the door to the bedroom is closed",
                "Please close the door to the bedroom",
            ),
            ("Make sure the TV is off", "switch off the TV"),
            ("Убедись, что дверь в спальню закрыта", "закрой дверь в спальню"),
            ("Проследи, чтобы свет был выключен", "выключи свет"),
            ("Go look for the toolbox in the lab", "look for the toolbox in the lab"),
            (
                "Put Book 1, Book 2 and Book 5 on the table",
                "Put Book 1, Book 2 and Book 5 on the table",
            ),
            (
                "switch on the lamp and the television off",
                "switch on the lamp and switch off the television",
            ),
            ("Search the bedroom for the medicine", "find the medicine in the bedroom"),
            ("Поезжай туда, где лежит зонт", "Поезжай к зонт"),
            (
                "Bring everything on the table to the bar",
                "Bring all the things on the table to the bar",
            ),
            ("Убери всё со стола", "Убери все вещи со стола"),
            ("Go home", "Go to base"),
            ("Shut and lock the door", "Shut the door and lock the door"),
            ("Go to the desk, not the bench", "Go to the desk"),
            ("Fetch the battery; no, the toolbox", "Fetch the toolbox"),
            ("Поезжай в спальню, точнее на кухню", "Поезжай на кухню"),
            ("Съезди на лифте на второй этаж", "Съезди на второй этаж"),
            ("Go to the hall and wait there until I call you", "Go to the hall and wait there"),
            ("Остановись у шкафа", "встань у шкафа"),
            ("Bring the medicine to me, not to the kitchen", "Bring the medicine to me"),
            ("Проследи, чтобы в спальне горел свет", "включи в спальне свет"),
            ("Lights on in the bedroom", "switch on Lights in the bedroom"),
            ("Сбегай на кухню за красной чашкой", "Сбегай на кухню, принеси красной чашкой"),
            ("Сходи за зонтом", "принеси зонтом"),
            ("Поищи, где тут ваза", "Поищи ваза"),
            ("Принеси мне книжку, любую", "Принеси мне любую книжку"),
            ("Bring me a book, any will do", "Bring me any book"),
            ("Проверь, закрыта ли дверь", "Проверь, закрыта ли дверь"),
            ("Is the light on?", "Is the light on?"),
            ("Lock every door that is open", "Lock every open door"),
            (
                "Switch off every lamp in the hall that is still on, please",
                "Switch off every switched on lamp in the hall, please",
            ),
            ("Bring the mug instead of the cup, please", "Bring the mug, please"),
            ("Принеси кружку вместо чашки на стол", "Принеси кружку на стол"),
            (
                "Go to the fridge and take what's inside",
                "Go to the fridge and take all the things from it",
            ),
            ("Встань за диваном", "Встань за диваном"),
            ("Put the cup on the table", "Put the cup on the table"),
        ] {
            assert_eq!(plain(said, &lines).0, order, "{said}");
            assert_eq!(plain(order, &lines).0, order);
        }
    }
}
