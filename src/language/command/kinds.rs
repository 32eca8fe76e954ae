//! What the words of an order do, as the lines of `orders.lang` name it.

use super::Relation;
use super::verbs::{Sort, is_relative};
use super::vocabulary::{Link, Meaning, Role, Verb, longest};
use crate::paraphrase::{Kind, Sense, Words};
use crate::words::Cardinal;

/// What each word of a text does; a verb is none within a longer phrase.
pub(super) fn senses(words: &Words<'_>) -> Vec<Sense> {
    let mut phrase_ends = 0;
    (0..words.keys.len())
        .map(|at| {
            let found = longest(&words.keys[at..].iter().map(String::as_str));
            let is_within = at < phrase_ends;
            let mut own = Vec::new();
            own.extend(is_relative(&words.keys, at).then_some(Kind::Relative));
            own.extend(Cardinal::read(&words.keys[at]).map(|_| Kind::Number));
            let Some((length, meaning)) = found else { return Sense { length: 1, kinds: own } };
            if !is_within {
                phrase_ends = at + length;
            }
            let mut kinds = match meaning {
                Meaning::Verb(_) if is_within => Vec::new(),
                Meaning::Verb(verb) => of_verb(verb),
                Meaning::Link(link) => of_link(link),
                Meaning::FacingWall => vec![Kind::Facing, Kind::Other],
                Meaning::Not => vec![Kind::Not, Kind::Other],
                Meaning::Filler => vec![Kind::Small, Kind::Other],
                Meaning::And => vec![Kind::And, Kind::Other],
                Meaning::Me => vec![Kind::Me, Kind::Other],
                Meaning::All => vec![Kind::All, Kind::Other],
                _ => vec![Kind::Other],
            };
            kinds.append(&mut own);
            if words.text[words.at[at].clone()].to_lowercase() == "всё" {
                kinds.push(Kind::Everything);
            }
            Sense { length, kinds }
        })
        .collect()
}

fn of_link(link: Link) -> Vec<Kind> {
    let mut kinds = vec![Kind::Link];
    kinds.extend((link.role == Role::Via).then_some(Kind::Via));
    kinds.extend(match link.relation {
        Relation::Between | Relation::NextTo | Relation::InFrontOf | Relation::Behind => {
            Some(Kind::Beside)
        }
        Relation::At => Some(Kind::At),
        Relation::Facing => Some(Kind::Facing),
        _ => None,
    });
    kinds
}

fn of_verb(verb: Verb) -> Vec<Kind> {
    let mut kinds = vec![Kind::Verb];
    if verb != Verb::Need {
        kinds.push(Kind::Act);
    }
    if matches!(
        verb,
        Verb::Put | Verb::PutBack | Verb::Return | Verb::Move | Verb::Bring | Verb::Take
    ) {
        kinds.push(Kind::Move);
    }
    kinds.extend(match Sort::of(verb) {
        Sort::Carry => Some(Kind::Carry),
        Sort::Put => Some(Kind::Put),
        Sort::Switch => Some(Kind::Switch),
        Sort::Find => Some(Kind::Find),
        Sort::Leave => Some(Kind::Leave),
        Sort::Go => Some(Kind::Approach),
        Sort::Door => Some(Kind::Door),
        Sort::Other => None,
    });
    kinds.extend((Sort::of(verb) != Sort::Door).then_some(Kind::Deed));
    kinds.extend(match verb {
        Verb::Face => Some(Kind::Face),
        Verb::Needless => Some(Kind::Needless),
        Verb::GoTo => Some(Kind::Go),
        Verb::Take => Some(Kind::Take),
        Verb::Wait => Some(Kind::Wait),
        Verb::Stop => Some(Kind::Stop),
        _ => None,
    });
    kinds
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;
    use std::ops::Range;

    use super::senses;
    use crate::paraphrase::{FILES, Paraphrases, Stage, language_of};
    use crate::scan::statements;
    use crate::words::{Language, word_keys};

    /// A word of each kind.
    const OF_KIND: [(&str, &str, &str); 31] = [
        ("verb", "принеси", "bring"),
        ("act", "принеси", "bring"),
        ("go", "сходи", "go"),
        ("carry", "принеси", "bring"),
        ("put", "положи", "put"),
        ("move", "положи", "put"),
        ("door", "открой", "open"),
        ("deed", "принеси", "bring"),
        ("switch", "включи", "switch on"),
        ("find", "найди", "find"),
        ("take", "возьми", "take"),
        ("approach", "поезжай", "go"),
        ("face", "повернись", "face"),
        ("wait", "подожди", "wait"),
        ("stop", "остановись", "stop"),
        ("leave", "выйди", "leave"),
        ("link", "на", "on"),
        ("at", "к", "to"),
        ("via", "через", "through"),
        ("facing", "лицом к", "facing"),
        ("beside", "за", "behind"),
        ("not", "не", "not"),
        ("needless", "не надо", "no need"),
        ("relative", "который", "that is"),
        ("number", "две", "two"),
        ("and", "и", "and"),
        ("small", "пожалуйста", "please"),
        ("me", "мне", "me"),
        ("all", "все", "all"),
        ("other", "все", "all"),
        ("everything", "всё", "everything"),
    ];

    type Sets = HashMap<String, Vec<String>>;

    /// What one alternative of a pattern may be, in the order in which it is read.
    fn spelled(alternative: &str, sets: &Sets, language: Language) -> Vec<String> {
        let mut all = vec![String::new()];
        for token in alternative.split_whitespace() {
            let words = match (sets.get(token), token.strip_prefix('<')) {
                (Some(set), _) => set.clone(),
                (None, Some(kind)) => {
                    let kind =
                        OF_KIND.iter().find(|(name, ..)| *name == kind.trim_end_matches('>'));
                    let (_, russian, english) = kind.expect("every kind has a word");
                    vec![language.pick(*russian, *english).to_owned()]
                }
                _ if token.starts_with('*') => vec![token.replace('*', "красн")],
                _ => vec![token.replace(['*', '~'], "")],
            };
            let mut joined = Vec::new();
            for one in &all {
                joined.extend(words.iter().map(|word| format!("{one} {word}")));
            }
            all = joined;
        }
        all.iter().map(|one| one.trim().to_owned()).collect()
    }

    /// Choices that bars part.
    fn choices(text: &str, sets: &Sets, language: Language) -> Vec<String> {
        text.split('|').flat_map(|one| spelled(one, sets, language)).collect()
    }

    /// What fills the parts of a pattern.
    struct Filling {
        gap: &'static str,
        last: bool,
        /// Whether what may be left out is said.
        full: bool,
    }

    /// What is said for each part of a left side, with its name and the number of its choice.
    fn said<'l>(
        mut rest: &'l str,
        sets: &Sets,
        language: Language,
        with: &Filling,
    ) -> Vec<(&'l str, String, usize)> {
        let mut parts = Vec::new();
        loop {
            rest = rest.trim_start();
            let Some(first) = rest.chars().next() else { return parts };
            let length = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
            let mut name = "";
            if first.is_ascii_uppercase() {
                (name, rest) = rest.split_at(length);
                let Some(behind) = rest.strip_prefix(':') else {
                    let inner = rest.strip_prefix('{').and_then(|inner| inner.split_once('}'));
                    let many = inner.map_or("", |(many, _)| many);
                    rest = inner.map_or(rest, |(_, after)| after);
                    let gap = match many {
                        _ if many.starts_with("0-") && !with.full => String::new(),
                        _ if many.starts_with("2-") => format!("{} {}", with.gap, with.gap),
                        _ => with.gap.to_owned(),
                    };
                    parts.push((name, gap, 0));
                    continue;
                };
                rest = behind;
            }
            let (inner, after) = match rest.chars().next() {
                Some('(') => rest[1..].split_once(')').expect("it closes"),
                Some('<') => rest.split_at(rest.find('>').expect("it closes") + 1),
                Some(c) if c.is_alphanumeric() => {
                    rest.split_at(rest.find([' ', '?']).unwrap_or(rest.len()))
                }
                Some(mark) => rest.split_at(mark.len_utf8()),
                None => (rest, ""),
            };
            let all = choices(inner.trim_matches('…'), sets, language);
            let optional = after.starts_with(['?', '*']);
            rest = after.trim_start_matches(['?', '*']);
            let choice = if with.last { all.len() - 1 } else { 0 };
            let word = if optional && !with.full { String::new() } else { all[choice].clone() };
            parts.push((name, word, choice));
        }
    }

    /// What a right side says of these parts.
    fn put(mut rest: &str, parts: &[(&str, String, usize)]) -> String {
        let mut told: Vec<String> = Vec::new();
        loop {
            rest = rest.trim_start();
            if rest.is_empty() {
                return told.join(" ");
            }
            let (token, after) = rest.split_at(rest.find([' ', ':']).unwrap_or(rest.len()));
            // The fillings are such as have no other form in the case that a line asks for.
            let bare = token.split('[').next().unwrap_or(token);
            let part = parts.iter().find(|(name, ..)| !name.is_empty() && *name == bare);
            rest = after;
            match (part, after.strip_prefix(':')) {
                (None, _) => told.push(token.replace('…', "")),
                (Some((_, word, _)), None) => told.push(word.clone()),
                (Some((_, word, choice)), Some(list)) => {
                    let (list, after) = match list.strip_prefix('(') {
                        Some(list) => list.split_once(')').expect("it closes"),
                        None => list.split_at(list.find(' ').unwrap_or(list.len())),
                    };
                    let all: Vec<&str> = list.split('|').map(str::trim).collect();
                    let one = all.get(*choice).unwrap_or(&all[0]);
                    told.push(if word.is_empty() { String::new() } else { (*one).to_owned() });
                    rest = after;
                }
            }
        }
    }

    /// Each line about orders is met by a sentence of its own pattern, and puts what its right side says.
    #[test]
    fn every_line_of_orders_puts_what_it_says() {
        let mut unmet: Vec<String> = Vec::new();
        let mut met = 0;
        for (path, text) in FILES.iter().filter(|(path, _)| path.ends_with("orders.lang")) {
            let language = language_of(path).expect("the folder of a language");
            let mut sets = Sets::new();
            let mut common: Vec<Range<usize>> = Vec::new();
            for at in statements(text) {
                let line = text[at.clone()].split_whitespace().collect::<Vec<_>>().join(" ");
                if let Some((name, words)) =
                    line.strip_prefix("set ").and_then(|set| set.split_once(" = "))
                {
                    let words = choices(words, &sets, language);
                    sets.insert(name.to_owned(), words);
                    common.push(at);
                    continue;
                }
                let mut own = Paraphrases::default();
                for at in common.iter().chain([&at]) {
                    own.read(language, text, at).expect("they are sound");
                }
                let line = line.strip_prefix("ordered ").expect("a line about orders");
                let (left, right) = line.split_once(" = ").expect("a line has two sides");
                let (right, options) = right.split_once(" {").unwrap_or((right, ""));
                let stage = match options {
                    _ if options.starts_with("in time") => Stage::InTime,
                    _ if options.starts_with("early") => Stage::Early,
                    _ => Stage::Late,
                };
                let gaps = language
                    .pick(["чашку", "красную", "свет", "стол"], ["cup", "lamp", "table", "lights"]);
                let fillings = gaps.into_iter().flat_map(|gap| {
                    let of = move |(last, full)| Filling { gap, last, full };
                    [(false, false), (true, false), (false, true), (true, true)].map(of)
                });
                let mut tried = String::new();
                let is_met = fillings.into_iter().any(|with| {
                    let parts = said(left, &sets, language, &with);
                    let words: Vec<&str> = parts
                        .iter()
                        .map(|(_, said, _)| said.as_str())
                        .filter(|s| !s.is_empty())
                        .collect();
                    let sentence = words.join(" ").replace(" ,", ",");
                    let expected = put(right, &parts);
                    let plain = own.ordered(&sentence, stage, senses);
                    let is_met = plain
                        .as_ref()
                        .is_some_and(|(plain, _)| word_keys(plain) == word_keys(&expected));
                    tried = format!(
                        "{sentence} -> {:?}, not {expected}",
                        plain.map(|(plain, _)| plain)
                    );
                    is_met
                });
                met += usize::from(is_met);
                if !is_met {
                    unmet.push(format!("{path}: {line}\n    {tried}"));
                }
            }
        }
        assert!(unmet.is_empty(), "{}", unmet.join("\n"));
        assert!(met > 100, "{met}");
    }
}
