//! Which of those that were told has most of something, or something: "Which of the two has more chairs around it?", «На каком
//! из них лежит книга?»
//!
//! Invariant: it goes by what the plain question comes to of each of them by its name; where one has no answer, none is told.

use std::ops::Range;

use super::each_told::{bare, case_behind, link_before, ran, taken};
use super::mark::Mark;
use super::query::{Extreme, Rel};
use super::{Answer, Asker, Memory, Query, Said, Thing, vocabulary};
use crate::sets::set;
use crate::units::capitalized;
use crate::words::{Case, Language, word_keys, word_ranges};

impl Asker<'_> {
    /// "Which of the two has more chairs around it?", «На каком из них больше книг?», "Which of them has a cup on it?": of
    /// those that were told, by how many there are at each, or whether any; `first`, before it is read otherwise.
    pub(super) fn which_told(
        &self,
        text: &str,
        first: bool,
        language: Language,
        memory: &Memory,
    ) -> Option<Answer> {
        let asked = WhichTold::read(text, language)?;
        let goes_first = asked.extreme.is_some() || !matches!(asked.rel, Rel::On | Rel::In);
        if goes_first != first {
            return None;
        }
        let things = self.all_told(Some(asked.rel), asked.of_two, memory)?;
        let knowledge = self.knowledge(language, memory);
        let are_rooms = || things.iter().all(|thing| thing.area().is_some());
        if asked.of_two && things.len() != 2 || asked.of_rooms && !are_rooms() {
            return None;
        }
        let mut answers = Vec::new();
        for thing in &things {
            let name = knowledge.form(*thing, asked.case);
            answers.push(self.answer(&asked.plainly(&name), language, memory).ok()?);
        }
        let (best, told): (Vec<usize>, String) = match asked.extreme {
            None => {
                let yes = |n: &usize| answers[*n].said == Said::Yes;
                let is_whether = |a: &Answer| matches!(a.said, Said::Yes | Said::No);
                if !answers.iter().all(is_whether) {
                    return None;
                }
                let has: Vec<usize> = (0..answers.len()).filter(yes).collect();
                let told = match has.is_empty() {
                    true => bare(answers.iter().collect()),
                    false => bare(has.iter().map(|n| &answers[*n]).collect()),
                };
                (has, told)
            }
            Some(extreme) => {
                let counts: Option<Vec<f64>> = answers
                    .iter()
                    .map(|a| matches!(a.query, Query::Count(_)).then_some(a.number).flatten())
                    .collect();
                let counts = counts?;
                let most = match extreme {
                    Extreme::Fewest => counts.iter().copied().fold(f64::INFINITY, f64::min),
                    _ => counts.iter().copied().fold(0.0, f64::max),
                };
                let is_best = |n: &usize| counts[*n].total_cmp(&most).is_eq();
                let best: Vec<usize> = (0..counts.len()).filter(is_best).collect();
                (best, bare(answers.iter().collect()))
            }
        };
        let winners: Vec<Thing> = best.iter().map(|n| things[*n]).collect();
        let equal = winners.len() == things.len() && asked.extreme.is_some();
        let list = knowledge.list(&winners);
        let text_told = match (winners.is_empty(), equal) {
            (true, _) => {
                language.pick(format!("Ни один из них. {told}"), format!("None of them. {told}"))
            }
            (_, true) => {
                language.pick(format!("Поровну. {told}"), format!("The same number. {told}"))
            }
            _ => language
                .pick(format!("Это {list}. {told}"), format!("{}. {told}", capitalized(&list))),
        };
        let said = if winners.is_empty() { Said::Nothing } else { Said::Found };
        let topic = if winners.is_empty() { things } else { winners.clone() };
        let joined = Answer::joined(answers, language);
        let query = ran(&knowledge, &joined.query);
        Some(Answer {
            query,
            said,
            text: text_told,
            things: winners,
            topic,
            number: None,
            so: None,
            words: text.to_owned(),
            ..joined
        })
    }
}

/// "Which of them has …?", by what it asks of each.
struct WhichTold {
    /// «больше», "fewer"; none where it is asked which has any.
    extreme: Option<Extreme>,
    noun: String,
    /// The preposition as it was said.
    link: String,
    rel: Rel,
    case: Case,
    of_two: bool,
    /// "Which of them has more windows?": rooms have what is in them.
    of_rooms: bool,
    language: Language,
}

impl WhichTold {
    fn read(text: &str, language: Language) -> Option<Self> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        let said = |range: Range<usize>| match range.is_empty() {
            true => String::new(),
            false => text[words[range.start].start..words[range.end - 1].end].to_owned(),
        };
        let start = taken(&keys, 0, set!("AndWord")).unwrap_or(0);
        // «На каком из них», "on which of them", "which of the two".
        let which = (start..keys.len().min(start + 5))
            .find(|n| taken(&keys, *n, set!("WhichOfTold")).is_some())?;
        let of = which + taken(&keys, which, set!("WhichOfTold"))?;
        let them = taken(&keys, of, set!("ThoseOfTold"));
        let alone =
            || set!("WhichOneTold").contains(&keys[which..of].join(" ").as_str()).then_some(0);
        let end = of + them.or_else(alone)?;
        let of_two = taken(&keys, of, set!("TwoOfTold")).is_some();
        let (link, rel) = link_before(&keys, which);
        if link != start {
            return None;
        }
        let mark = |n: usize| vocabulary::longest(&keys[n..=n]).map(|(_, mark)| mark);
        let small = |n: usize| {
            matches!(
                mark(n),
                Some(
                    Mark::Be
                        | Mark::Exists
                        | Mark::Have
                        | Mark::Hang
                        | Mark::The
                        | Mark::A
                        | Mark::Filler
                )
            )
        };
        let mut from = end;
        while from < keys.len() && (small(from) || set!("ThereWord").contains(&&*keys[from])) {
            from += 1;
        }
        let extreme_of = |by: Extreme| match by {
            Extreme::Most | Extreme::Biggest => Some(Extreme::Most),
            Extreme::Fewest | Extreme::Smallest => Some(Extreme::Fewest),
            _ => None,
        };
        let (mut extreme, mut noun) = (None, from);
        // "more chairs", «больше всего книг»; «больше» is "bigger" as well.
        if let Some((length, Mark::More(by) | Mark::Best(by))) =
            vocabulary::longest(keys.get(from..)?)
        {
            (extreme, noun) = (Some(extreme_of(by)?), from + length);
        }
        let mut of_rooms = false;
        let (mut until, mut own) = (keys.len(), (link, rel, which));
        // «На каком из них вещей больше?»
        if extreme.is_none() && rel.is_some() {
            let last =
                (from + 1..keys.len()).find_map(|at| match vocabulary::longest(&keys[at..]) {
                    Some((length, Mark::More(by) | Mark::Best(by)))
                        if at + length == keys.len() =>
                    {
                        Some((at, by))
                    }
                    _ => None,
                });
            if let Some((at, by)) = last {
                extreme = Some(extreme_of(by)?);
                until = at;
            }
        }
        if rel.is_none() {
            let has =
                |n: usize| mark(n) == Some(Mark::Have) || set!("ThereWord").contains(&&*keys[n]);
            if !(end..noun).any(has) {
                return None;
            }
            // "… around it?", "… in front of them?", "… is there a cup on?"
            if keys.last().is_some_and(|key| set!("ItBehind").contains(&key.as_str())) {
                until -= 1;
            }
            let (link, rel) = link_before(&keys, until);
            own = (link, rel, until);
            until = link;
            of_rooms = rel.is_none() && until == keys.len();
        }
        let rel = own.1.or(of_rooms.then_some(Rel::In))?;
        let (link, behind) = (own.0, own.2);
        let denies = |key: &String| {
            set!("DeniesWord").contains(&key.as_str()) || set!("NoneOf").contains(&key.as_str())
        };
        if noun >= until || keys[end..].iter().any(denies) {
            return None;
        }
        while noun < until && (small(noun) || set!("Article").contains(&&*keys[noun])) {
            noun += 1;
        }
        let noun = said(noun..until);
        let case = case_behind(&keys, behind, Some(rel));
        let link = match of_rooms {
            true => language.pick("в", "in").to_owned(),
            false => said(link..behind),
        };
        (!noun.is_empty()).then_some(Self {
            extreme,
            noun,
            link,
            rel,
            case,
            of_two,
            of_rooms,
            language,
        })
    }

    /// The question of one of them, by its name.
    fn plainly(&self, name: &str) -> String {
        let Self { noun, link, .. } = self;
        let link = link.to_lowercase();
        match (self.extreme.is_some(), self.language) {
            (true, Language::Russian) => format!("Сколько {noun} {link} {name}?"),
            (true, Language::English) => format!("How many {noun} are there {link} {name}?"),
            (false, Language::Russian) => format!("Есть ли {noun} {link} {name}?"),
            (false, Language::English) => format!("Is there a {noun} {link} {name}?"),
        }
    }
}
