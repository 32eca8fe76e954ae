//! What is left: «Сколько осталось в ванной?», "How many are left on the table?"
//!
//! Invariant: it is asked of the kind of what was counted or carried last, in the place that is named; where there was no one
//! kind, or it was asked back which is meant, nothing is counted.

use super::follow::is_place;
use super::grammar::{Item, Sentence};
use super::mark::{Mark, Pronoun};
use super::{Asker, Head, Memory, Noun, Query, Rel, Restriction, Thing};
use crate::sets::{Set, set};
use crate::words::word_keys;

impl Asker<'_> {
    /// The count that a text asks of what is left and names no kind of; an outer none where it asks no such thing.
    pub(super) fn how_many_left(&self, text: &str, memory: &Memory) -> Option<Option<Query>> {
        static LEFT: Set = Set::named("IsLeft");
        let keys = word_keys(text);
        let left = keys.iter().position(|key| LEFT.contains(&key.as_str()))?;
        // "To the left", "on the left"
        if left > 0 && set!("TheOrA").contains(&keys[left - 1].as_str()) {
            return None;
        }
        let said: Vec<&str> =
            keys.iter().map(String::as_str).filter(|key| !LEFT.contains(key)).collect();
        let plain = self.plain(&said.join(" "));
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let (mut counts, mut there, mut places) = (false, false, Vec::<Restriction>::new());
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::HowMany) => counts = true,
                Item::Mark(Mark::Be | Mark::And | Mark::Exists | Mark::Filler) => {}
                Item::Noun(phrase) if phrase.pronoun == Some(Pronoun::They) => {}
                Item::Noun(phrase) if phrase.person == Some(Mark::There) => there = true,
                Item::Place { rel, nouns, either: false } => {
                    let they = nouns.iter().all(|p| p.pronoun == Some(Pronoun::They));
                    if they && matches!(rel, Rel::From | Rel::Of) {
                        continue;
                    }
                    let [phrase] = &nouns[..] else { return None };
                    if phrase.pronoun.is_some() || phrase.person.is_some() {
                        return counts.then_some(None);
                    }
                    let anchors = vec![phrase.noun.clone()];
                    let place = Restriction { rel, anchors, negated: false };
                    // "On the table in the kitchen": the table is there.
                    match places.last_mut() {
                        Some(Restriction { anchors, .. }) => anchors[0].restrictions.push(place),
                        None => places.push(place),
                    }
                }
                _ => return None,
            }
        }
        if !counts {
            return None;
        }
        // «Сколько ложек на столе? Возьми одну. Сколько осталось?»: as it was counted there before. Whither something was taken
        // since may be "there" as well.
        if places.is_empty() {
            let counted = |query: &Query| match query {
                Query::Count(noun) => noun.restrictions.iter().any(is_place) && noun.best.is_none(),
                _ => false,
            };
            let is_open = there && memory.told_place.is_some();
            return Some(memory.query.clone().filter(counted).filter(|_| !is_open));
        }
        let knowledge = self.knowledge(sentence.language, memory);
        let things = |told: &[Thing]| knowledge.alike(told).filter(|_| !memory.awaits_reply());
        let asked = memory.query.as_ref().and_then(Query::sought);
        let asked = asked.filter(|_| memory.last.is_empty()).map(|noun| noun.head.clone());
        let of_kind = |kind| Head { kinds: vec![kind], ..Head::default() };
        let head =
            things(&memory.last).map(of_kind).or(asked).filter(|head| !head.kinds.is_empty());
        Some(head.map(|head| {
            Query::Count(Noun { head, restrictions: places, plural: true, ..Noun::default() })
        }))
    }
}
