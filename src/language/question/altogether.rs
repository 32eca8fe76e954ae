//! «А всего?», "And in the whole house?": the sum of what was counted place by place, or all that there is.
//!
//! Invariant: the sum is of the places that were spoken of, and named with them, with all that there is beside it where that
//! is more; the whole map is meant where it is said, or where one place only was spoken of.

use std::collections::BTreeSet;

use super::grammar::{Item, Sentence};
use super::mark::{Mark, Pronoun};
use super::query::{Noun, Query, Rel, Restriction, Thing};
use super::{Answer, Asker, Memory, vocabulary};
use crate::words::word_keys;

impl Asker<'_> {
    /// The last question without its place, or of all the places of the last ones.
    pub(super) fn altogether(&self, text: &str, last: &Query, memory: &Memory) -> Option<Query> {
        match self.asks_everywhere(text)? {
            true => without_place(last),
            false => self.sum_of_counted(memory).or_else(|| without_place(last)),
        }
    }

    /// «Сколько окон в спальне? А в ванной? А всего?»: beside the sum, how many there are on the whole map, where that is more.
    pub(super) fn with_whole(&self, text: &str, memory: &Memory, answer: Answer) -> Answer {
        let is_sum = matches!(&answer.query, Query::Count(noun) if !noun.restrictions.is_empty())
            && memory.counted.len() > 1
            && self.asks_everywhere(&self.plain(text)) == Some(false);
        let whole = without_place(&answer.query).filter(|_| is_sum);
        let all =
            whole.and_then(|whole| self.knowledge(answer.language, memory).answer(&whole).ok());
        match all.filter(|all| all.number > answer.number) {
            Some(all) => Answer { text: format!("{} {}", answer.text, all.text), ..answer },
            None => answer,
        }
    }

    /// Whether what asks for all of what was counted says that the whole building is meant; none of what asks more.
    fn asks_everywhere(&self, text: &str) -> Option<bool> {
        let keys = word_keys(text);
        let (mut rest, mut total, mut everywhere) = (Vec::new(), false, false);
        let mut at = 0;
        while let Some(words) = keys.get(at..).filter(|words| !words.is_empty()) {
            let all = vocabulary::taken_by(Mark::Everywhere, words);
            let sum = vocabulary::taken_by(Mark::Total, words);
            everywhere |= all.is_some();
            total |= sum.is_some();
            match all.or(sum) {
                Some(taken) => at += taken,
                None => {
                    rest.push(keys[at].as_str());
                    at += 1;
                }
            }
        }
        let asks = (total || everywhere) && self.asks_nothing_else(&rest.join(" "));
        asks.then_some(everywhere)
    }

    fn asks_nothing_else(&self, text: &str) -> bool {
        let small = |item: &Item| match item {
            Item::Mark(Mark::HowMany | Mark::Be | Mark::The | Mark::And | Mark::Have) => true,
            Item::Mark(Mark::Exists | Mark::What) => true,
            Item::Noun(phrase) => {
                matches!(phrase.pronoun, Some(Pronoun::They | Pronoun::There))
                    || self.is_bare_thing(&phrase.noun)
            }
            _ => false,
        };
        Sentence::new(text, &self.mind.lexicon).items().iter().all(small)
    }

    /// "How many chairs are in the kitchen? And in the hall? How many is that altogether?": of all that was counted.
    fn sum_of_counted(&self, memory: &Memory) -> Option<Query> {
        if memory.counted.len() < 2 {
            return None;
        }
        let knowledge = self.knowledge(memory.language, memory);
        let mut things: BTreeSet<Thing> = BTreeSet::new();
        for noun in &memory.counted {
            things.extend(knowledge.find(noun, true).ok()?);
        }
        let merged = self.merged(&memory.counted).filter(|merged| {
            let found = knowledge.find(merged, true);
            found.is_ok_and(|found| found.into_iter().collect::<BTreeSet<_>>() == things)
        });
        let listed =
            || Noun { plural: true, all: true, ..Noun::of(things.iter().copied().collect()) };
        Some(Query::Count(merged.unwrap_or_else(listed)))
    }

    /// What was counted, in any of the places where it was.
    fn merged(&self, counted: &[Noun]) -> Option<Noun> {
        let sought = |noun: &Noun| Noun {
            restrictions: Vec::new(),
            text: String::new(),
            plural: true,
            indefinite: false,
            all: true,
            ..noun.clone()
        };
        let whole = sought(counted.first()?);
        if counted.iter().any(|noun| sought(noun) != whole) {
            return None;
        }
        // «Сколько картин? А на кухне? А всего?»
        if counted.iter().any(|noun| noun.restrictions.is_empty()) {
            return Some(Noun { all: false, ..whole });
        }
        let mut anchors: Vec<Noun> = Vec::new();
        for noun in counted.iter().rev() {
            let [Restriction { rel: Rel::In | Rel::On, anchors: own, negated: false }] =
                &noun.restrictions[..]
            else {
                return None;
            };
            for anchor in own.iter().filter(|anchor| self.is_room(anchor)) {
                if !anchors.contains(anchor) {
                    anchors.push(anchor.clone());
                }
            }
        }
        let restrictions = vec![Restriction { rel: Rel::In, anchors, negated: false }];
        Some(Noun { restrictions, ..whole })
    }
}

/// "How many lamps are in the kitchen? And in the whole flat?"
fn without_place(last: &Query) -> Option<Query> {
    let mut query = last.clone();
    let asked = match &mut query {
        Query::Find(asked)
        | Query::Count(asked)
        | Query::Where(asked)
        | Query::Serving { of: asked, .. } => asked,
        Query::Exists { what, .. } => what.first_mut()?,
        _ => return None,
    };
    if asked.head.anything || asked.restrictions.is_empty() {
        return None;
    }
    asked.restrictions.clear();
    Some(query)
}
