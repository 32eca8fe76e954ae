//! A word for some, each or none of those that were told, in any place of a question: "on any of them", «хоть у одного из них»,
//! "near both".
//!
//! Invariant: it is asked of each by its name, and what is told are the answers to that; where one of them has no answer of
//! the sort, none is given.

use std::ops::Range;

use super::grammar::Sentence;
use super::knowledge::Knowledge;
use super::mark::{Mark, Pronoun};
use super::memory::Exchange;
use super::numbered::genders;
use super::query::Rel;
use super::resolution::case_of;
use super::{Answer, Asker, Doubt, Memory, Outcome, Query, Said, Thing, vocabulary};
use crate::sets::set;
use crate::units::capitalized;
use crate::words::{Case, Language, phrase_at, word_keys, word_ranges};

/// What a question that is asked of each by itself is called among the forms of questions.
const EACH: &str = "each";

/// Of how many of those that were told something is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Share {
    Any,
    Each,
    /// «Ни на одном из них нет книги?»: of each it is denied.
    EachNot,
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

impl Told {
    /// "Is there a book not on any of them?": what is denied of any is denied of each; but "Isn't there one on any of them?"
    fn is_denied(&self, keys: &[String]) -> bool {
        let denies = |n: &usize| set!("NotWord").contains(&keys[*n].as_str());
        let first = keys.iter().take(2).filter(|key| set!("NotWord").contains(&key.as_str()));
        let inverted = first.count() > 0 && !denies(&self.lead.start.saturating_sub(1));
        !matches!(self.share, Share::Each | Share::EachNot)
            && (if inverted { 2 } else { 0 }..keys.len()).any(|n| denies(&n))
    }
}

/// The longest of some phrases that stand at a word.
pub(super) fn taken(keys: &[String], at: usize, all: &[&str]) -> Option<usize> {
    all.iter().filter_map(|phrase| phrase_at(keys, at, phrase)).max()
}

/// Where the preposition before a word begins; where there is none, at the word.
pub(super) fn link_before(keys: &[String], at: usize) -> (usize, Option<Rel>) {
    let link = |from: usize| match vocabulary::longest(&keys[from..at]) {
        Some((taken, Mark::Link(rel))) if taken == at - from => Some((from, Some(rel))),
        _ => None,
    };
    (at.saturating_sub(4)..at).find_map(link).unwrap_or((at, None))
}

/// What a preposition takes, by its last word: «рядом с» as «с» does.
pub(super) fn case_behind(keys: &[String], at: usize, rel: Option<Rel>) -> Case {
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
            true => (link - 1, Share::EachNot),
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
        self.answer_whole(text, language, memory).or_else(|unanswered| {
            let is_clear = match &unanswered.0 {
                // "How far is each of them from the fridge?" is asked of each, and not which.
                Doubt::Ambiguous { reference, .. } => !speaks_of_told(&word_keys(reference)),
                doubt => matches!(doubt, Doubt::Unheeded { .. }),
            };
            if is_clear {
                return Err(unanswered);
            }
            let of_two = || self.answer(&self.of_them(text, memory)?, language, memory).ok();
            told(false).and_then(Result::ok).or_else(of_two).ok_or(unanswered)
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
        let keys = word_keys(text);
        // Which of those of which it was asked whether it is so of any.
        let which = set!("BareWhich").contains(&keys.join(" ").as_str())
            && matches!(memory.query, Some(Query::Ran { form: EACH, .. }));
        if which && !governed {
            return None;
        }
        // Where it is so of none, none is meant.
        if which && memory.so != Some(true) {
            return Some(Err(Box::new((Doubt::NoReferent { word: text.to_owned() }, None))));
        }
        let text = if which { &*memory.words } else { text };
        if !which && !speaks_of_told(&keys) {
            return None;
        }
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let said = told_in(&sentence)?;
        if !which && self.is_first(&said, &sentence) != governed {
            return None;
        }
        let (_, rel) = link_before(&sentence.keys, said.words.start);
        let genders = genders(&sentence.keys[said.words.start..=said.words.start]);
        let about = sentence.said(&said.words).to_owned();
        let unclear = || Err(Box::new((Doubt::Incomplete { about: about.clone() }, None)));
        // Of those on which nothing may be, it is not read as of them together.
        let is_placed = rel.is_some() && self.all_told(None, said.of_two, memory).is_some();
        let Some(things) = self.all_told(rel, said.of_two, memory) else {
            return is_placed.then(unclear);
        };
        let knowledge = self.knowledge(language, memory);
        let agree = |thing: &Thing| {
            genders.is_empty() || genders.iter().any(|gender| knowledge.agrees(*gender, *thing))
        };
        if said.of_two && things.len() != 2 {
            return None;
        }
        // «Сколько тумб? Что на каждом из них?» may be of something else.
        if !which && (!things.iter().all(agree) || said.is_denied(&sentence.keys)) {
            return Some(unclear());
        }
        let case = case_behind(&sentence.keys, said.words.start, rel);
        let words = &sentence.words;
        // "What is between both of them?"
        if rel == Some(Rel::Between) {
            let at = words[said.words.start].start..words[said.words.end - 1].end;
            let mut asked = text.to_owned();
            asked.replace_range(at, &knowledge.listed(&things, case));
            let of_pair = said.of_two && said.share == Share::Each;
            return of_pair.then(|| self.answer(&asked, language, memory));
        }
        if self.is_collective(&sentence) {
            return None;
        }
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
        let query = |answer: &Answer| ran(&knowledge, &answer.query);
        // "Is there a sofa in front of any of them? – Yes. – Which one?"
        if which {
            let is_so = |n: &usize| answers[*n].so == Some(true);
            let all: Vec<usize> = (0..things.len()).filter(is_so).collect();
            let meant: Vec<Thing> = all.iter().map(|n| things[*n]).collect();
            let list = capitalized(&knowledge.list(&meant));
            let told = bare(all.iter().map(|n| &answers[*n]).collect());
            let text = language.pick(format!("Это {list}. {told}"), format!("{list}. {told}"));
            let joined = Answer::joined(answers, language);
            let query = query(&joined);
            let (topic, said) = (meant.clone(), Said::Found);
            let answer = Answer { query, said, so: None, text, things: meant, topic, ..joined };
            return (!all.is_empty()).then_some(Ok(answer));
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
        Some(Ok(Answer { query: query(&answer), words: text.to_owned(), ..answer }))
    }

    /// Whether a word is taken so before the question is read otherwise: where a preposition governs it, or what some of them
    /// have is asked after ("Does any of them have a book on it?").
    fn is_first(&self, said: &Told, sentence: &Sentence<'_>) -> bool {
        let keys = &sentence.keys;
        let has = |n: usize| {
            matches!(vocabulary::longest(&keys[n..=n]), Some((_, Mark::Have)))
                || set!("WhetherWord").contains(&keys[n].as_str()) && said.words.contains(&n)
        };
        said.link < said.words.start
            || matches!(said.share, Share::Any | Share::None)
                && (said.words.end..keys.len()).any(has)
            || said.words.clone().any(has)
    }

    /// "Which of the two is closer to the fridge?", of two that were told: which of them.
    fn of_them(&self, text: &str, memory: &Memory) -> Option<String> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        let (at, end) = (1..keys.len())
            .find_map(|at| Some((at, at + taken(&keys, at, set!("TwoOfTold"))?)))
            .filter(|(at, _)| {
                (0..*at).any(|n| taken(&keys, n, set!("WhichOfTold")) == Some(at - n))
            })?;
        let them =
            set!("ThoseOfTold").iter().find(|them| Language::of(them) == Language::of(text))?;
        let is_pair = self.all_told(None, true, memory)?.len() == 2;
        is_pair
            .then(|| format!("{}{them}{}", &text[..words[at].start], &text[words[end - 1].end..]))
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
            )
        })
    }

    /// All that "them" are in a relation, where they are several; where they are two, also those of which the last two questions
    /// were asked, one each: "What's on the desk? And on the table? Which of the two has …?"
    pub(super) fn all_told(
        &self,
        rel: Option<Rel>,
        of_two: bool,
        memory: &Memory,
    ) -> Option<Vec<Thing>> {
        /// So many are asked of one by one.
        const MOST: usize = 20;
        if memory.awaits_reply() {
            return None;
        }
        let knowledge = self.knowledge(memory.language, memory);
        let told = rel.filter(|_| memory.last.len() > 1).or(Some(Rel::Of));
        let mut things: Vec<Thing> = Vec::new();
        for thing in knowledge.referent(Pronoun::They, told) {
            if !things.contains(&thing) {
                things.push(thing);
            }
        }
        if !of_two {
            return (2..=MOST).contains(&things.len()).then_some(things);
        }
        let topics: Vec<Thing> =
            memory.exchanges.iter().take(2).rev().filter_map(Exchange::topic).collect();
        let alike = |pair: &Vec<Thing>| {
            let are_rooms = pair.iter().all(|thing| thing.area().is_some());
            pair.len() == 2 && pair[0] != pair[1] && (are_rooms || knowledge.alike(pair).is_some())
        };
        let may = |pair: &Vec<Thing>| {
            pair.len() == 2
                && rel.is_none_or(|rel| pair.iter().all(|t| knowledge.may_be_anchor(rel, *t)))
        };
        let topics = Some(topics).filter(alike).filter(|pair| !things.contains(&pair[0]));
        // Of two pairs nothing says which.
        match (Some(things).filter(may), topics.filter(may)) {
            (Some(told), None) => Some(told),
            (None, topics) => topics,
            (Some(_), Some(_)) => None,
        }
    }
}

/// What an answer says, without the yes or no before it.
fn unled(answer: &Answer) -> &str {
    let leads = ["Да, ", "Нет, ", "Yes, ", "No, "];
    leads.iter().find_map(|lead| answer.text.strip_prefix(lead)).unwrap_or(&answer.text)
}

/// The same of several, each a sentence.
pub(super) fn bare(answers: Vec<&Answer>) -> String {
    answers.into_iter().map(|answer| capitalized(unled(answer))).collect::<Vec<_>>().join(" ")
}

/// A question that was asked in parts: another goes on from none of them.
pub(super) fn ran(knowledge: &Knowledge<'_>, query: &Query) -> Query {
    Query::Ran { form: EACH, rule: knowledge.rule(query) }
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
        Share::Each | Share::EachNot if !no.is_empty() => Some(false),
        _ if unknown => None,
        Share::Any => Some(false),
        Share::Each | Share::EachNot | Share::None => Some(true),
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
        (Share::Each | Share::EachNot, Some(false)) => led(false, no),
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
    let counts = |a: &Answer| matches!(a.query, Query::Count(_));
    let found = |a: &Answer| a.said == Said::Found;
    let answers = match share {
        // "How many cups are on one of them?": on each so many.
        Share::Any if answers.iter().all(counts) => answers,
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
