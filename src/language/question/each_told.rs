//! A word for some, each or none of those that were told, in any place of a question: "on any of them", «хоть у одного из них»,
//! "near both"; and which of them has most of something, or something: "Which of the two has more chairs around it?"
//!
//! Invariant: it is asked of each by its name, and what is told are the answers to that; where one of them has no answer of
//! the sort, none is given.

use std::ops::Range;

use super::grammar::Sentence;
use super::knowledge::Knowledge;
use super::mark::{Mark, Pronoun};
use super::numbered::genders;
use super::query::{Extreme, Rel};
use super::resolution::case_of;
use super::{Answer, Asker, Doubt, Memory, Outcome, Query, Said, Thing, vocabulary};
use crate::sets::set;
use crate::units::capitalized;
use crate::words::{Case, Language, phrase_at, word_keys, word_ranges};

/// Of how many of those that were told something is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Share {
    Any,
    Each,
    None,
}

/// A word for some of those that were told, as it stands in a question.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Told {
    words: Range<usize>,
    /// «хоть на одном из них»: words before the preposition that go with it.
    lead: Range<usize>,
    /// Where the preposition begins, which ends where the words begin.
    link: usize,
    share: Share,
    /// "Both", "neither" speak of two.
    of_two: bool,
}

/// The longest of some phrases that stand at a word.
fn taken(keys: &[String], at: usize, all: &[&str]) -> Option<usize> {
    all.iter().filter_map(|phrase| phrase_at(keys, at, phrase)).max()
}

/// Where the preposition before a word begins; where there is none, at the word.
fn link_before(keys: &[String], at: usize) -> (usize, Option<Rel>) {
    let link = |from: usize| match vocabulary::longest(&keys[from..at]) {
        Some((taken, Mark::Link(rel))) if taken == at - from => Some((from, Some(rel))),
        _ => None,
    };
    (at.saturating_sub(4)..at).find_map(link).unwrap_or((at, None))
}

/// What a preposition takes, by its last word: «рядом с» as «с» does.
fn case_behind(keys: &[String], at: usize, rel: Option<Rel>) -> Case {
    let Some(rel) = rel else { return Case::Nominative };
    let last = &keys[at - 1];
    if set!("With").contains(&last.as_str()) {
        return Case::Instrumental;
    }
    match vocabulary::longest(std::slice::from_ref(last)) {
        Some((_, Mark::Link(own))) => case_of(own, false),
        _ => case_of(rel, false),
    }
}

/// Whether words may stand for some of those that were told.
fn speaks_of_told(keys: &[String]) -> bool {
    let sets: [&[&str]; 6] = [
        set!("AnyOfTold"),
        set!("EachOfTold"),
        set!("NoneOfTold"),
        set!("EitherTold"),
        set!("EachTold"),
        set!("NeitherTold"),
    ];
    (0..keys.len()).any(|at| sets.iter().any(|set| taken(keys, at, set).is_some()))
}

/// The one such word of a question.
fn told_in(sentence: &Sentence<'_>) -> Option<Told> {
    let keys = &sentence.keys;
    let said = |at: usize| {
        let partitive = |of: &[&str], share: Share| {
            let of = at + taken(keys, at, of)?;
            let end = of + taken(keys, of, set!("ThoseOfTold"))?;
            let is_them = matches!(
                vocabulary::longest(&keys[end - 1..end]),
                Some((_, Mark::Pronoun(Pronoun::They)))
            );
            // "Each of these books" has its noun.
            (is_them || sentence.ends_noun(end)).then_some((end, share))
        };
        // "Is there a lamp near both?"
        let alone = |told: &[&str], share: Share| {
            let end = at + taken(keys, at, told)?;
            let joins = keys[end..].iter().any(|key| set!("And").contains(&key.as_str()));
            let open = match keys.get(end..).and_then(vocabulary::longest) {
                Some((_, mark)) => {
                    matches!(
                        mark,
                        Mark::Be
                            | Mark::Exists
                            | Mark::Have
                            | Mark::Hang
                            | Mark::Not
                            | Mark::Filler
                    ) || matches!(mark, Mark::Link(rel) if rel != Rel::Of)
                }
                None => true,
            };
            (sentence.ends_noun(end) && open && !joins).then_some((end, share))
        };
        let (end, share) = partitive(set!("AnyOfTold"), Share::Any)
            .or_else(|| partitive(set!("EachOfTold"), Share::Each))
            .or_else(|| partitive(set!("NoneOfTold"), Share::None))
            .or_else(|| alone(set!("EitherTold"), Share::Any))
            .or_else(|| alone(set!("EachTold"), Share::Each))
            .or_else(|| alone(set!("NeitherTold"), Share::None))?;
        let (link, _) = link_before(keys, at);
        let denied = link > 0 && set!("NotEven").contains(&keys[link - 1].as_str());
        let least = || (0..link).find(|n| taken(keys, *n, set!("AtLeastOne")) == Some(link - n));
        let (lead, share) = match denied {
            // «Ни на одном из них нет книги?»: of each it is denied.
            true => (link - 1, Share::Each),
            false => (least().unwrap_or(link), share),
        };
        let of_two = taken(keys, at, set!("OfTwoTold")).is_some();
        Some(Told { words: at..end, lead: lead..link, link, share, of_two })
    };
    let mut all: Vec<Told> = Vec::new();
    for at in 0..keys.len() {
        if let Some(found) = said(at)
            && all.last().is_none_or(|before| before.words.end <= at)
        {
            all.push(found);
        }
    }
    let one = all.pop()?;
    all.is_empty().then_some(one)
}

impl Asker<'_> {
    /// The answer to a question; where a word of it stands for some of those that were told, to what it asks of each.
    pub(super) fn answer(&self, text: &str, language: Language, memory: &Memory) -> Outcome {
        let told = |first: bool| {
            self.of_each_told(text, first, language, memory)
                .or_else(|| self.which_told(text, first, language, memory).map(Ok))
        };
        if let Some(outcome) = told(true) {
            return outcome;
        }
        self.answer_whole(text, language, memory).or_else(|unanswered| match unanswered.0 {
            Doubt::Ambiguous { .. } | Doubt::Unheeded { .. } => Err(unanswered),
            _ => told(false).and_then(Result::ok).ok_or(unanswered),
        })
    }

    /// "Is there a sofa in front of any of them?", "What is near each of them?": asked of each that was told, by its name. None
    /// where no such word is governed by a preposition, which is all that `governed` asks for.
    pub(super) fn of_each_told(
        &self,
        text: &str,
        governed: bool,
        language: Language,
        memory: &Memory,
    ) -> Option<Outcome> {
        if !speaks_of_told(&word_keys(text)) {
            return None;
        }
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let said = told_in(&sentence)?;
        if (said.link == said.words.start) == governed || self.is_collective(&sentence) {
            return None;
        }
        let (_, rel) = link_before(&sentence.keys, said.words.start);
        let genders = genders(&sentence.keys[said.words.start..=said.words.start]);
        let things = self.all_told(rel, memory)?;
        let knowledge = self.knowledge(language, memory);
        let agree = |thing: &Thing| {
            genders.is_empty() || genders.iter().any(|gender| knowledge.agrees(*gender, *thing))
        };
        if said.of_two && things.len() != 2 {
            return None;
        }
        let unclear = || Err(Box::new((Doubt::not_understood(text), None)));
        // «Сколько тумб? Что на каждом из них?» may be of something else.
        if !things.iter().all(agree) {
            return Some(unclear());
        }
        let case = case_behind(&sentence.keys, said.words.start, rel);
        let words = &sentence.words;
        let mut answers = Vec::new();
        for thing in &things {
            let mut asked = text.to_owned();
            let end = words[said.words.end - 1].end;
            asked.replace_range(words[said.words.start].start..end, &knowledge.form(*thing, case));
            if !said.lead.is_empty() {
                let next = words[said.lead.end].start;
                asked.replace_range(words[said.lead.start].start..next, "");
            }
            match self.answer(&asked, language, memory) {
                Ok(answer) => answers.push(answer),
                // Which of several tables is meant, for one, is asked back of all of them.
                Err(unanswered) if matches!(unanswered.0, Doubt::Ambiguous { .. }) => return None,
                Err(_) => return Some(unclear()),
            }
        }
        let whether = |answer: &Answer| {
            matches!(answer.said, Said::Yes | Said::No)
                || answer.said == Said::Unknown && answer.so.is_none()
        };
        let answer = match answers.iter().all(whether) {
            true => whether_of(answers, said.share, &things, language),
            false => each_of(answers, said.share, &things, language),
        };
        let Some(answer) = answer else { return Some(unclear()) };
        let query = ran(&knowledge, &answer.query);
        Some(Ok(Answer { query, words: text.to_owned(), ..answer }))
    }

    /// What is asked of several at once is asked of none by itself.
    fn is_collective(&self, sentence: &Sentence<'_>) -> bool {
        let marks =
            (0..sentence.keys.len()).filter_map(|n| vocabulary::longest(&sentence.keys[n..]));
        let mut marks = marks.map(|(_, mark)| mark);
        marks.any(|mark| {
            matches!(
                mark,
                Mark::Same | Mark::Differ | Mark::Alike | Mark::Total | Mark::Except | Mark::Other
            ) || matches!(mark, Mark::Link(Rel::Between))
        })
    }

    /// All that "them" are in a relation, where they are several.
    fn all_told(&self, rel: Option<Rel>, memory: &Memory) -> Option<Vec<Thing>> {
        /// So many are asked of one by one.
        const MOST: usize = 20;
        if memory.awaits_reply() {
            return None;
        }
        let rel = rel.filter(|_| memory.last.len() > 1).or(Some(Rel::Of));
        let told = self.knowledge(memory.language, memory).referent(Pronoun::They, rel);
        let mut things: Vec<Thing> = Vec::new();
        for thing in told {
            if !things.contains(&thing) {
                things.push(thing);
            }
        }
        (2..=MOST).contains(&things.len()).then_some(things)
    }

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
        let things = self.all_told(Some(asked.rel), memory)?;
        let knowledge = self.knowledge(language, memory);
        if asked.of_two && things.len() != 2 {
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
            _ => language.pick(format!("Это {list}. {told}"), format!("{list}. {told}")),
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
        let (mut extreme, mut noun) = (None, from);
        for at in from..keys.len() {
            // "more chairs", «больше всего книг»; «больше» is "bigger" as well.
            if let Some((length, Mark::More(by) | Mark::Best(by))) =
                vocabulary::longest(&keys[at..])
            {
                extreme = Some(match by {
                    Extreme::Most | Extreme::Biggest => Extreme::Most,
                    Extreme::Fewest | Extreme::Smallest => Extreme::Fewest,
                    _ => return None,
                });
                noun = at + length;
                break;
            }
            if at > from {
                break;
            }
        }
        let (mut until, mut own) = (keys.len(), (link, rel, which));
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
        }
        let (link, rel, behind) = (own.0, own.1?, own.2);
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
        let link = said(link..behind);
        (!noun.is_empty()).then_some(Self { extreme, noun, link, rel, case, of_two, language })
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

/// What an answer says, without the yes or no before it.
fn unled(answer: &Answer) -> &str {
    let leads = ["Да, ", "Нет, ", "Yes, ", "No, "];
    leads.iter().find_map(|lead| answer.text.strip_prefix(lead)).unwrap_or(&answer.text)
}

/// The same of several, each a sentence.
fn bare(answers: Vec<&Answer>) -> String {
    answers.into_iter().map(|answer| capitalized(unled(answer))).collect::<Vec<_>>().join(" ")
}

/// A question that was asked in parts: another goes on from none of them.
fn ran(knowledge: &Knowledge<'_>, query: &Query) -> Query {
    Query::Ran { form: "each", rule: knowledge.rule(query) }
}

/// Whether it is so of any, of each or of none, by what is so of each.
fn whether_of(
    answers: Vec<Answer>,
    share: Share,
    things: &[Thing],
    language: Language,
) -> Option<Answer> {
    let those = |so: bool| answers.iter().filter(|a| a.so == Some(so)).collect::<Vec<_>>();
    let (yes, no) = (those(true), those(false));
    let unknown = yes.len() + no.len() < answers.len();
    let so = match share {
        Share::Any | Share::None if !yes.is_empty() => Some(share == Share::Any),
        Share::Each if !no.is_empty() => Some(false),
        _ if unknown => None,
        Share::Any => Some(false),
        Share::Each | Share::None => Some(true),
    };
    let word =
        |so: bool| language.pick(if so { "Да" } else { "Нет" }, if so { "Yes" } else { "No" });
    let all = || answers.iter().collect::<Vec<_>>();
    let led = |so: bool, told: Vec<&Answer>| {
        let lead = word(so);
        match told.split_first() {
            Some((first, rest)) if first.text.starts_with(lead) => {
                format!("{} {}", first.text, bare(rest.to_vec())).trim_end().to_owned()
            }
            _ => format!("{lead}. {}", bare(told)),
        }
    };
    let text = match (share, so) {
        (_, None) => bare(all()),
        (Share::Any, Some(true)) | (Share::None, Some(false)) => led(share == Share::Any, yes),
        // "No, not everywhere: there are no pillows on Bed 1."
        (Share::Each, Some(false)) if !yes.is_empty() => {
            let places = no.iter().all(|answer| matches!(answer.query, Query::Exists { .. }));
            let lead = match places {
                true => language.pick("Нет, не везде: ", "No, not everywhere: "),
                false => language.pick("Нет, не все: ", "No, not all of them: "),
            };
            let each: Vec<&str> = no.iter().map(|a| unled(a).trim_end_matches('.')).collect();
            format!("{lead}{}.", each.join("; "))
        }
        (Share::Each, Some(false)) => led(false, no),
        (_, Some(so)) => led(so, all()),
    };
    let said = match so {
        Some(true) => Said::Yes,
        Some(false) => Said::No,
        None => Said::Unknown,
    };
    let joined = Answer::joined(answers, language);
    let mut topic = things.to_vec();
    topic.extend(joined.things.iter().filter(|thing| !things.contains(thing)));
    Some(Answer { said, so, text, things: things.to_vec(), topic, ..joined })
}

/// What is told of each, one after the other.
fn each_of(
    answers: Vec<Answer>,
    share: Share,
    things: &[Thing],
    language: Language,
) -> Option<Answer> {
    let told = |a: &Answer| matches!(a.said, Said::Found | Said::Nothing | Said::Unknown);
    if share == Share::None || !answers.iter().all(told) {
        return None;
    }
    let finds = |a: &Answer| matches!(a.query, Query::Find(_));
    let found = |a: &Answer| a.said == Said::Found;
    let answers = match share {
        Share::Any if !answers.iter().all(finds) => return None,
        Share::Any if answers.iter().any(found) => answers.into_iter().filter(found).collect(),
        _ => answers,
    };
    let said = if answers.iter().any(found) { Said::Found } else { answers.first()?.said };
    let joined = Answer::joined(answers, language);
    let mut topic = joined.things.clone();
    topic.extend(things.iter().filter(|thing| !joined.things.contains(thing)));
    Some(Answer { said, topic, so: None, ..joined })
}
