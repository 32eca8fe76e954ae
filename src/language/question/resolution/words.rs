//! The words about a noun: what stands beside it, behind it and between it and others.

use std::ops::Range;

use super::Resolver;
use super::choice::with;
use super::place::Spot;
use crate::command::{self, Sort};
use crate::question::grammar::{Item, Phrase};
use crate::question::mark::Mark;
use crate::question::query::{Noun, Rel, Restriction};
use crate::question::values::ValueId;
use crate::sets::Set;

impl Resolver<'_, '_> {
    /// «чашку белую»: the value behind its noun.
    pub(super) fn value_after(
        &self,
        items: &[Item],
        at: usize,
        phrase: &Phrase,
    ) -> Option<(ValueId, Range<usize>)> {
        let Some(Item::Value(value)) = items.get(at + 1) else { return None };
        let words = phrase.words.end..phrase.words.end + 1;
        (!self.is_parted(words.start)).then_some((*value, words))
    }

    /// «все лампы, кроме торшера», «всё со стола, кроме вазы»: what is left out, and the word at which that begins.
    pub(super) fn except_after<'i>(
        &self,
        items: &'i [Item],
        at: usize,
        objects: &[(usize, &'i Phrase)],
    ) -> Option<(Vec<&'i Phrase>, usize)> {
        let places = items.get(at + 1..)?;
        let after = places.iter().position(|item| !matches!(item, Item::Place { .. }))?;
        let [Item::Mark(Mark::Except), Item::Noun(first), ..] = &places[after..] else {
            return None;
        };
        // "… except the kitchen and the hall"
        let except = at + 1 + after + 1;
        let own = objects.iter().skip_while(|(item, _)| *item < except);
        let listed = own.enumerate().take_while(|(n, (item, _))| *item == except + 2 * n);
        let joined = listed.take_while(|(n, (item, _))| {
            *n == 0 || matches!(items[item - 1], Item::Mark(Mark::And))
        });
        let except: Vec<&Phrase> = joined.map(|(_, (_, phrase))| *phrase).collect();
        let except = if except.is_empty() { vec![first] } else { except };
        let from = match &items[at + after] {
            Item::Noun(phrase) => phrase.words.end,
            Item::Place { nouns, .. } => nouns.last()?.words.end,
            _ => return None,
        };
        Some((except, from))
    }

    /// What is left out, with the places that tell which: those that follow the last of it.
    pub(super) fn left_out(&self, sort: Sort, except: &Phrase, spots: &[&&Spot<'_>]) -> Noun {
        let own = spots.iter().filter(|s| s.phrase.words.start >= except.words.end);
        let within = own.map(|s| Restriction {
            rel: if sort == Sort::Door { Rel::Of } else { s.rel },
            anchors: vec![with(&s.phrase.noun, &s.within)],
            negated: false,
        });
        let within: Vec<Restriction> = within.collect();
        with(&except.noun, &self.resting(&within))
    }

    /// "the book on the dresser and the cup from the kitchen": what is named behind a place and its joint is an object
    /// of the verb, where the verb can be done to it and not to what the place names.
    pub(super) fn freed(&self, items: Vec<Item>, sort: impl Fn(usize) -> Sort) -> Vec<Item> {
        let mut freed = Vec::with_capacity(items.len());
        for item in items {
            let Item::Place { rel, mut nouns, either } = item else {
                freed.push(item);
                continue;
            };
            let done = nouns.first().map_or(Sort::Other, |n| sort(self.bytes(&n.words).start));
            let able = |phrase: &Phrase| {
                let base = self.knowledge.base(&phrase.noun.head);
                base.iter().any(|t| self.knowledge.can(done, *t))
            };
            let carried = matches!(done, Sort::Carry | Sort::Switch) && rel != Rel::Between;
            let from = (1..nouns.len()).find(|&n| carried && !able(&nouns[0]) && able(&nouns[n]));
            let objects = from.map(|from| nouns.split_off(from)).unwrap_or_default();
            freed.push(Item::Place { rel, nouns, either });
            for object in objects {
                freed.push(Item::Mark(if either { Mark::Or } else { Mark::And }));
                freed.push(Item::Noun(object));
            }
        }
        freed
    }

    /// "Go to all rooms", «поезжай во все комнаты»: each of them is gone to, as what is visited; with the bytes of the
    /// prepositions, which are none then.
    pub(super) fn rounds(
        &self,
        items: Vec<Item>,
        sort: impl Fn(usize) -> Sort,
    ) -> (Vec<Item>, Vec<Range<usize>>) {
        let mut links = Vec::new();
        let of_rounds = |item| match item {
            Item::Place { rel, mut nouns, either } if nouns.len() == 1 => {
                let phrase = &nouns[0];
                let base = self.knowledge.base(&phrase.noun.head);
                let goes = sort(self.bytes(&phrase.words).start) == Sort::Go
                    && self.is_whither(rel, phrase) != Some(false)
                    && phrase.noun.all
                    && !base.is_empty()
                    && base.iter().all(|t| t.area().is_some());
                if !goes {
                    return Item::Place { rel, nouns, either };
                }
                let first = phrase.words.start;
                let link = command::link_before(&self.sentence.keys, first);
                if link > 0 {
                    links.push(self.bytes(&(first - link..first)));
                }
                Item::Noun(nouns.remove(0))
            }
            item => item,
        };
        let items = items.into_iter().map(of_rounds).collect();
        (items, links)
    }

    /// «лицом к столу», "facing the table": what the robot is to look at.
    pub(super) fn is_faced(&self, phrase: &Phrase) -> bool {
        static FACE: Set = Set::named("FacingWord");
        let before = phrase.words.start.saturating_sub(2)..phrase.words.start;
        let keys = self.sentence.keys.get(before).unwrap_or_default();
        keys.iter().any(|key| FACE.contains(&key.as_str()))
    }

    /// Whether words that nothing knows stand between a thing and a place: "to the person in the kitchen".
    pub(super) fn is_cut_off(&self, items: &[Item], object: usize, place: usize) -> bool {
        let between = items.get(object.min(place)..object.max(place)).unwrap_or_default();
        between.iter().any(|item| match item {
            Item::Unknown(words) => !command::is_known(&self.sentence.keys, words.start),
            _ => false,
        })
    }

    /// Whether a word that nothing knows belongs to a noun: "a cup of tea" is no cup.
    pub(super) fn is_strange(&self, words: &Range<usize>) -> bool {
        let items = self.sentence.items();
        items.iter().any(|item| match item {
            Item::Unknown(unknown) => {
                let beside = unknown.start == words.end || unknown.end == words.start;
                let gap = unknown.start.max(words.start);
                let known = command::is_known(&self.sentence.keys, unknown.start);
                beside && !known && !self.is_parted(gap)
            }
            _ => false,
        })
    }

    /// Whether a mark stands before a word.
    pub(super) fn is_parted(&self, word: usize) -> bool {
        let (Some(before), Some(after)) = (
            word.checked_sub(1).and_then(|n| self.sentence.words.get(n)),
            self.sentence.words.get(word),
        ) else {
            return true;
        };
        before.end > after.start
            || self.sentence.text[before.end..after.start].contains([',', ';', '.', ':'])
    }

    /// A number in digits right behind some words.
    pub(super) fn number_after(&self, words: &Range<usize>) -> Option<&str> {
        let key = self.sentence.keys.get(words.end)?;
        let is_number = !key.is_empty() && key.chars().all(char::is_numeric);
        (is_number && !self.is_parted(words.end)).then_some(key)
    }

    /// Whether a name tells which of a kind is meant: one that is as the kind is described.
    pub(super) fn names_one_of(&self, name: &Phrase, kind: &Phrase) -> bool {
        let named = self.knowledge.base(&name.noun.head);
        let all = self.knowledge.base(&kind.noun.head);
        let fits = |only| self.candidates(&kind.noun, &[]).is_ok_and(|found| found.contains(only));
        matches!(&named[..], [only] if all.len() > 1 && all.contains(only) && fits(only))
    }
}
