//! Spoken constructions put into plain orders, by words alone: «убедись, что дверь закрыта» is «закрой дверь», "not the
//! red cup but the white one" is "the white cup".
//!
//! Invariant: a rewriting drops only words that say what is not to be done, or that say how it is said; a text that has
//! none of these constructions stays as it is, and what was rewritten once is not rewritten again.

use std::ops::Range;

use super::vocabulary::{Meaning, Role, Verb, longest};
use crate::language::words::{Language, phrase_at, word_keys, word_ranges};

/// A text, the places of its words and their keys.
struct Said {
    text: String,
    words: Vec<Range<usize>>,
    keys: Vec<String>,
}

impl Said {
    fn new(text: String) -> Self {
        let (words, keys) = (word_ranges(&text), word_keys(&text));
        Self { text, words, keys }
    }

    fn meaning(&self, at: usize) -> Option<(usize, Meaning)> {
        (at < self.keys.len())
            .then(|| longest(&self.keys[at..].iter().map(String::as_str)))
            .flatten()
    }

    fn is(&self, at: usize, any: &[&str]) -> bool {
        self.keys.get(at).is_some_and(|key| any.contains(&key.as_str()))
    }

    /// How many words of one of these phrases, the longest, stand here.
    fn phrase(&self, at: usize, phrases: &[&str]) -> Option<usize> {
        phrases.iter().filter_map(|phrase| phrase_at(&self.keys, at, phrase)).max()
    }

    /// Whether a mark stands before a word.
    fn parted(&self, at: usize) -> bool {
        match at.checked_sub(1).map(|before| self.words[before].end) {
            Some(end) if at < self.words.len() => {
                self.text[end..self.words[at].start].contains([',', ';', '.', '!', ':', '–', '—'])
            }
            _ => true,
        }
    }

    /// Where the clause of a word ends: at the next mark, or the end.
    fn clause_end(&self, at: usize) -> usize {
        (at + 1..self.words.len()).find(|&n| self.parted(n)).unwrap_or(self.words.len())
    }

    fn bytes(&self, words: &Range<usize>) -> Range<usize> {
        self.words[words.start].start..self.words[words.end - 1].end
    }

    fn of(&self, words: &Range<usize>) -> &str {
        &self.text[self.bytes(words)]
    }

    /// The first verb from a word on, and how many words it takes.
    fn verb_from(&self, mut at: usize) -> Option<(usize, usize, Verb)> {
        while at < self.keys.len() {
            match self.meaning(at) {
                Some((taken, Meaning::Verb(verb))) => return Some((at, taken, verb)),
                Some((taken, _)) => at += taken,
                None => at += 1,
            }
        }
        None
    }

    /// The text with some words replaced by others.
    fn with(&self, words: &Range<usize>, said: &str) -> String {
        let mut text = self.text.clone();
        text.replace_range(self.bytes(words), said);
        text
    }
}

/// The text as plain orders.
pub(super) fn plain(text: &str) -> String {
    /// No sentence has more of one construction.
    const MOST: usize = 4;
    let rewritings: [fn(&Said) -> Option<String>; 14] = [
        without_forbidden,
        contrasted,
        excluded,
        ensured,
        everything,
        switched,
        gone,
        stopping_at,
        homeward,
        gapped,
        searched,
        fetched,
        without_where,
        any_at_the_end,
    ];
    let mut said = Said::new(text.to_owned());
    for rewrite in rewritings {
        for _ in 0..MOST {
            match rewrite(&said) {
                Some(text) if text != said.text => said = Said::new(text),
                _ => break,
            }
        }
    }
    said.text
}

/// "Don't go to the kitchen, go to the bedroom": what is not to be done, beside what is.
fn without_forbidden(said: &Said) -> Option<String> {
    let mut at = 0;
    while let Some((taken, Meaning::Filler | Meaning::Me | Meaning::And)) = said.meaning(at) {
        at += taken;
    }
    let (taken, Meaning::Not) = said.meaning(at)? else { return None };
    let (verb, ..) = said.verb_from(at + taken)?;
    let end = said.clause_end(verb);
    let (next, ..) = said.verb_from(end)?;
    let forbidden_too = (end..next).any(|n| matches!(said.meaning(n), Some((_, Meaning::Not))));
    (!forbidden_too).then(|| said.with(&(at..next + 1), said.of(&(next..next + 1))))
}

/// «не красную чашку, а белую», "not to the kitchen but to the bedroom": the second of two, with the noun of the first.
fn contrasted(said: &Said) -> Option<String> {
    let not =
        (0..said.keys.len()).find(|&at| matches!(said.meaning(at), Some((_, Meaning::Not))))?;
    let but = (not + 1..said.keys.len())
        .find(|&at| said.is(at, &["but"]) || (said.is(at, &["а"]) && said.parted(at)))?;
    let between = not + 1..but;
    if between.is_empty()
        || between.clone().any(|n| matches!(said.meaning(n), Some((_, Meaning::Verb(_)))))
    {
        return None;
    }
    let end = said.clause_end(but);
    let noun = &said.keys[but - 1];
    let rest = but + 1..end;
    if rest.is_empty() {
        return None;
    }
    let mut kept = said.of(&rest).to_owned();
    let last = &said.keys[end - 1];
    if last == "one" || last == "ones" {
        kept = format!("{} {noun}", said.of(&(but + 1..end - 1)));
    } else if rest.len() == 1 && between.len() > 1 && is_adjective(last) {
        kept = format!("{kept} {noun}");
    }
    Some(said.with(&(not..end), &kept))
}

/// "the cup, not the red one", «чашку, только не красную»: all but that.
fn excluded(said: &Said) -> Option<String> {
    const BUT_NOT: [&str; 5] = ["not", "but not", "только не", "но не", "не"];
    let at =
        (2..said.keys.len()).find(|&n| said.parted(n) && said.phrase(n, &BUT_NOT).is_some())?;
    let taken = said.phrase(at, &BUT_NOT)?;
    let end = said.clause_end(at + taken);
    let told = at + taken..end;
    // "to me, not to the kitchen": the other place is merely not meant.
    if matches!(said.meaning(at + taken), Some((_, Meaning::Link(_)))) {
        let mut text = said.text.clone();
        text.replace_range(said.words[at - 1].end..said.words[end - 1].end, "");
        return Some(text);
    }
    if told.is_empty()
        || told.clone().any(|n| matches!(said.meaning(n), Some((_, Meaning::Verb(_)))))
    {
        return None;
    }
    let except = match Language::of(&said.keys[at]) {
        Language::Russian => "кроме",
        Language::English => "except",
    };
    let from = said.words[at - 1].end;
    let mut text = said.text.clone();
    text.replace_range(from..said.words[end - 1].end, &format!(" {except} {}", said.of(&told)));
    Some(text)
}

/// "Make sure that the door is closed", «проследи, чтобы свет был выключен»: what makes it so.
fn ensured(said: &Said) -> Option<String> {
    const SURE: [&str; 22] = [
        "make sure",
        "make certain",
        "ensure",
        "see to it",
        "be sure",
        "check that",
        "make it so",
        "убедись",
        "убедитесь",
        "проследи",
        "проследите",
        "позаботься",
        "сделай так",
        "удостоверься",
        "проверь",
        "проконтролируй",
        "пусть",
        "i want",
        "я хочу",
        "сделай",
        "сделайте",
        "пускай",
    ];
    const THAT: [&str; 3] = ["that", "что", "чтобы"];
    const BE: [&str; 17] = [
        "is",
        "are",
        "be",
        "s",
        "was",
        "был",
        "была",
        "было",
        "были",
        "будет",
        "будут",
        "остался",
        "осталась",
        "стоял",
        "лежал",
        "лежала",
        "стояла",
    ];
    const STATES: [(&[&str], &str, &str); 6] = [
        (&["closed", "shut", "закрыт", "закрыта", "закрыто", "закрыты"], "закрой", "close"),
        (&["open", "opened", "открыт", "открыта", "открыто", "открыты"], "открой", "open"),
        (&["locked", "заперт", "заперта", "заперты", "заперто"], "запри", "lock"),
        (&["unlocked", "отперт", "отперта", "отперты"], "отопри", "unlock"),
        (
            &[
                "on",
                "switched on",
                "turned on",
                "включен",
                "включена",
                "включено",
                "включены",
                "горит",
                "горел",
                "горела",
                "горели",
                "работал",
            ],
            "включи",
            "switch on",
        ),
        (
            &[
                "off",
                "switched off",
                "turned off",
                "выключен",
                "выключена",
                "выключено",
                "выключены",
                "погашен",
                "погашена",
                "не горит",
                "не горел",
                "не горела",
            ],
            "выключи",
            "switch off",
        ),
    ];
    let (at, sure) = (0..said.keys.len()).find_map(|n| Some((n, said.phrase(n, &SURE)?)))?;
    let mut from = at + sure;
    if said.is(at, &["сделай", "сделайте"]) && !said.is(from, &["чтобы", "так"])
    {
        return None;
    }
    while said.is(from, &THAT) {
        from += 1;
    }
    let end = said.clause_end(from.min(said.words.len().saturating_sub(1)));
    // «закрыта ли дверь» asks.
    if from >= end || (from..end).any(|n| said.is(n, &["ли", "whether", "if"])) {
        return None;
    }
    let (state, taken, (_, russian, english)) = (from..end).find_map(|n| {
        let state = STATES.iter().filter_map(|s| Some((said.phrase(n, s.0)?, s)));
        let (taken, state) = state.max_by_key(|(taken, _)| *taken)?;
        // "on the table" is a place.
        let is_last = Language::of(&said.keys[n]) == Language::Russian
            || n + taken == end
            || matches!(said.meaning(n + taken), Some((_, Meaning::Link(_) | Meaning::Filler)));
        is_last.then_some((n, taken, state))
    })?;
    let mut what: Vec<&str> = Vec::new();
    for n in (from..end).filter(|n| !(state..state + taken).contains(n)) {
        if !(said.is(n, &BE) && n < end) {
            what.push(&said.text[said.words[n].clone()]);
        }
    }
    let verb = match Language::of(&said.keys[at]) {
        Language::Russian => russian,
        Language::English => english,
    };
    Some(said.with(&(at..end), &format!("{verb} {}", what.join(" "))))
}

/// "Lights on in the bedroom, please": without a verb.
fn switched(said: &Said) -> Option<String> {
    const ASKS: [&str; 11] =
        ["is", "are", "what", "which", "where", "who", "how", "does", "do", "what s", "when"];
    if said.text.contains('?') || said.is(0, &ASKS) || said.verb_from(0).is_some() {
        return None;
    }
    let end = said.keys.len();
    let half = (1..end).find(|&n| {
        let next = said.meaning(n + 1).map(|(_, meaning)| meaning);
        said.is(n, &["on", "off"])
            && (n + 1 == end
                || said.is(n + 1, &["please", "now"])
                || matches!(next, Some(Meaning::Link(_))))
    })?;
    let what = said.of(&(0..half));
    Some(said.with(&(0..half + 1), &format!("switch {} {what}", said.keys[half])))
}

/// «всё со стола», "everything on the table": all things that are there.
fn everything(said: &Said) -> Option<String> {
    const ALL: [&str; 5] =
        ["everything", "whatever is", "whatever s", "everything that is", "everything that s"];
    let before_link = |n: usize| matches!(said.meaning(n).map(|(_, m)| m), Some(Meaning::Link(_)));
    (0..said.keys.len()).find_map(|at| {
        let russian = said.text.get(said.words[at].clone())?.to_lowercase() == "всё";
        let taken = said.phrase(at, &ALL).or(russian.then_some(1))?;
        let (things, follows) = match russian {
            true => ("все вещи", before_link(at + 1)),
            false => ("all the things", before_link(at + taken)),
        };
        follows.then(|| said.with(&(at..at + taken), things))
    })
}

/// "Switch the lamp on and the television off": the verb once more.
fn gapped(said: &Said) -> Option<String> {
    const VERBS: [Verb; 2] = [Verb::SwitchOn, Verb::SwitchOff];
    let (.., verb) = said.verb_from(0)?;
    let and = (1..said.keys.len()).rev().find(|&n| said.is(n, &["and", "but"]))?;
    let end = said.keys.len();
    let half = said.keys.get(end - 1).filter(|key| matches!(key.as_str(), "on" | "off"))?;
    let gaps = VERBS.contains(&verb) && end > and + 2 && said.verb_from(and).is_none();
    gaps.then(|| {
        let what = said.of(&(and + 1..end - 1));
        said.with(&(and..end), &format!("and switch {half} {what}"))
    })
}

/// "Search the bedroom for the medicine", "go wherever the umbrella is".
fn searched(said: &Said) -> Option<String> {
    const WHEREVER: [&str; 5] =
        ["wherever", "to where", "to wherever", "туда где", "к тому месту где"];
    const IS: [&str; 7] = ["is", "are", "lies", "stands", "лежит", "стоит", "находится"];
    if said.is(0, &["search"]) {
        let at = (2..said.keys.len().saturating_sub(1)).find(|&n| said.is(n, &["for"]))?;
        let what = said.of(&(at + 1..said.clause_end(at)));
        let place = said.of(&(1..at));
        return Some(said.with(&(0..said.clause_end(at)), &format!("find {what} in {place}")));
    }
    let (verb, taken, Verb::GoTo) = said.verb_from(0)? else { return None };
    let at = verb + taken;
    let told = said.phrase(at, &WHEREVER)?;
    let end = said.clause_end(at + told);
    let kept: Vec<&str> = (at + told..end)
        .filter(|&n| !said.is(n, &IS))
        .map(|n| &said.text[said.words[n].clone()])
        .collect();
    let to = Language::of(&said.keys[verb]).pick("к", "to");
    Some(said.with(&(at..end), &format!("{to} {}", kept.join(" "))))
}

/// «Остановись у шкафа», "stop by the kitchen": it goes there.
fn stopping_at(said: &Said) -> Option<String> {
    let (at, taken, Verb::Stop) = said.verb_from(0)? else { return None };
    let (_, Meaning::Link(_)) = said.meaning(at + taken)? else { return None };
    let language = Language::of(said.of(&(at..at + taken)));
    Some(said.with(&(at..at + taken), language.pick("встань", "stand")))
}

/// "Go home": the map's houses are not meant.
fn homeward(said: &Said) -> Option<String> {
    let (verb, taken, _) = said.verb_from(0)?;
    let at = (verb + taken..said.keys.len()).find(|&n| said.is(n, &["home"]))?;
    let next = said.meaning(at + 1).map(|(_, meaning)| meaning);
    let ends = at + 1 == said.keys.len() || said.parted(at + 1);
    let ends = ends || matches!(next, Some(Meaning::And | Meaning::Filler));
    (ends && !said.is(at - 1, &["to", "your", "the"])).then(|| said.with(&(at..at + 1), "to base"))
}

/// «Сходи принеси чашку», "go and look for the cup": going is meant by the second verb.
fn gone(said: &Said) -> Option<String> {
    let (verb, taken, Verb::GoTo) = said.verb_from(0)? else { return None };
    let mut next = verb + taken;
    while let Some((small, Meaning::Filler | Meaning::And)) = said.meaning(next) {
        next += small;
    }
    match said.meaning(next)? {
        (_, Meaning::Verb(Verb::Need)) => None,
        (_, Meaning::Verb(_)) => Some(said.with(&(verb..next + 1), said.of(&(next..next + 1)))),
        _ => None,
    }
}

/// «Сходи на кухню за чашкой», "go to the kitchen for the cup": it is to be brought.
fn fetched(said: &Said) -> Option<String> {
    const INSTRUMENTAL: [&str; 11] =
        ["ой", "ей", "ом", "ем", "ами", "ями", "ью", "им", "ым", "ими", "ыми"];
    let (verb, taken, Verb::GoTo) = said.verb_from(0)? else { return None };
    if said.is(verb, &["встань", "стань", "встаньте", "стой", "спрячься"])
    {
        return None;
    }
    let end = said.clause_end(verb);
    // Up to the next order: "then look for the egg" fetches nothing.
    let goes_on =
        |n: &usize| !matches!(said.meaning(*n), Some((_, Meaning::And | Meaning::Verb(_))));
    let own = (verb + taken..end.saturating_sub(1)).take_while(goes_on);
    let at = own.into_iter().find(|&n| match said.keys[n].as_str() {
        "за" => {
            INSTRUMENTAL.iter().any(|ending| said.keys[n + 1].ends_with(ending))
                && !said.is(n + 1, &["мной", "собой", "дом"])
        }
        "for" => !said.is(n + 1, &["me", "us", "a"]) || (said.is(n + 1, &["a"]) && n + 2 < end),
        _ => false,
    })?;
    let bring = if said.keys[at] == "за" { "принеси" } else { "bring" };
    let before = if at == verb + taken { verb..at + 1 } else { at..at + 1 };
    let said_so = if at == verb + taken { bring.to_owned() } else { format!(", {bring}") };
    Some(said.with(&before, &said_so))
}

/// «Поищи, где ваза»: to find it is to know where it is.
fn without_where(said: &Said) -> Option<String> {
    const WHERE: [&str; 2] = ["где", "where"];
    const SMALL: [&str; 14] = [
        "тут",
        "там",
        "здесь",
        "лежит",
        "стоит",
        "находится",
        "у",
        "нас",
        "the",
        "is",
        "are",
        "моя",
        "мой",
        "мои",
    ];
    let (verb, taken, Verb::Find) = said.verb_from(0)? else { return None };
    let at = verb + taken;
    if !said.is(at, &WHERE) {
        return None;
    }
    let end = said.clause_end(at);
    let kept: Vec<&str> = (at + 1..end)
        .filter(|&n| !said.is(n, &SMALL))
        .map(|n| &said.text[said.words[n].clone()])
        .collect();
    (!kept.is_empty()).then(|| {
        let kept = kept.join(" ");
        let mut text = said.text.clone();
        text.replace_range(said.words[at - 1].end..said.words[end - 1].end, &format!(" {kept}"));
        text
    })
}

/// «Принеси книжку, любую», "bring a book, any will do": any of them.
fn any_at_the_end(said: &Said) -> Option<String> {
    const ANY: [&str; 22] = [
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
    let mut text = said.text.clone();
    text.replace_range(said.words[at - 1].end..said.words[end - 1].end, "");
    let noun = said.words.get(noun).filter(|word| word.start < said.words[at].start)?;
    text.replace_range(article.unwrap_or(noun.start)..noun.start, &format!("{any} "));
    Some(text)
}

/// Whether a word without its noun is an adjective, by its ending.
fn is_adjective(key: &str) -> bool {
    const ENDINGS: [&str; 13] =
        ["ую", "юю", "ый", "ий", "ой", "ое", "ее", "ые", "ие", "ого", "его", "ом", "ую"];
    key.chars().count() > 4 && ENDINGS.iter().any(|ending| key.ends_with(ending))
}

/// Whether a word says whither, or may: a preposition, «домой».
pub(super) fn says_whither(meaning: Meaning) -> bool {
    match meaning {
        Meaning::Link(link) => matches!(link.role, Role::Whither | Role::WhereOrWhither),
        Meaning::Haunt(_) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructions_become_orders() {
        for (said, order) in [
            ("Don't go to the kitchen, go to the bedroom", "go to the bedroom"),
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
            ("Остановись у шкафа", "встань у шкафа"),
            ("Bring the medicine to me, not to the kitchen", "Bring the medicine to me"),
            ("Проследи, чтобы в спальне горел свет", "включи в спальне свет"),
            ("Lights on in the bedroom", "switch on Lights in the bedroom"),
            ("Сбегай на кухню за красной чашкой", "Сбегай на кухню , принеси красной чашкой"),
            ("Сходи за зонтом", "принеси зонтом"),
            ("Поищи, где тут ваза", "Поищи ваза"),
            ("Принеси мне книжку, любую", "Принеси мне любую книжку"),
            ("Bring me a book, any will do", "Bring me any book"),
            ("Проверь, закрыта ли дверь", "Проверь, закрыта ли дверь"),
            ("Is the light on?", "Is the light on?"),
            ("Встань за диваном", "Встань за диваном"),
            ("Put the cup on the table", "Put the cup on the table"),
        ] {
            assert_eq!(plain(said), order, "{said}");
            assert_eq!(plain(order), order);
        }
    }
}
