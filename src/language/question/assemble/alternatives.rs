//! Several places or things joined in one question: what is in both of two rooms, which of those that are named is there.
//!
//! Invariant: nothing is in two rooms at once, so what is in both is a kind; of what is named each is told of.

use super::Frame;
use crate::question::grammar::Item;
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::query::{Denial, Noun, Query, Rel, Restriction};

impl Frame<'_, '_> {
    /// «Какие предметы есть и на кухне, и в ванной?», "What is both in the kitchen and in the hall?": which kinds.
    pub(super) fn in_both(&self, query: Query) -> Query {
        let (mut of, count) = match &query {
            Query::Find(noun) => (noun.clone(), false),
            Query::Count(noun) => (noun.clone(), true),
            Query::Kinds { of, count } => (of.clone(), *count),
            _ => return query,
        };
        let things = of.head.anything || self.is_kind(&of, |e| *e == Extension::Things);
        if !(things && of.best.is_none() && self.says_both() && self.part_rooms(&mut of)) {
            return query;
        }
        Query::Kinds { of, count }
    }

    /// Whether a sentence says "both" or «и …, и …» of its places.
    pub(super) fn says_both(&self) -> bool {
        let keys = &self.sentence.keys;
        let and: Vec<usize> = (0..keys.len()).filter(|n| keys[*n] == "и").collect();
        let twice = match &and[..] {
            [_, later @ ..] => later.iter().any(|n| self.sentence.comma_between(*n, *n)),
            [] => false,
        };
        twice || keys.iter().any(|key| key == "both" || key == "обеих" || key == "обоих")
    }

    /// Makes of one place that is any of several rooms as many places; false where there is none.
    fn part_rooms(&self, of: &mut Noun) -> bool {
        let of_rooms = |place: &Restriction| {
            let rooms = place.anchors.len() > 1 && place.anchors.iter().all(|a| self.is_area(a));
            rooms && matches!(place.rel, Rel::In | Rel::On) && !place.negated
        };
        let Some(at) = of.restrictions.iter().position(of_rooms) else { return false };
        let whole = of.restrictions.remove(at);
        let each = whole.anchors.into_iter().map(|room| Restriction {
            rel: whole.rel,
            anchors: vec![room],
            negated: false,
        });
        of.restrictions.extend(each);
        true
    }

    /// «Чего нет на столе: миски или тарелки?», "What is in the kitchen, a sofa or a fridge?": of each whether it is there.
    pub(super) fn which_of_named(&self) -> Option<Query> {
        let asks = self.place_of(Mark::What).or_else(|| self.place_of(Mark::Which))?;
        let ([spot], [first, _, ..]) = (&self.spots[..], &self.nouns[..]) else { return None };
        let small = |(mark, _): &(Mark, usize)| {
            matches!(
                mark,
                Mark::What
                    | Mark::Which
                    | Mark::Be
                    | Mark::Exists
                    | Mark::Not
                    | Mark::Or
                    | Mark::The
                    | Mark::A
            ) || matches!(mark, Mark::And | Mark::Have | Mark::Hang)
        };
        let named = |noun: &Noun| !noun.head.kinds.is_empty() || !noun.head.named.is_empty();
        let listed = first.at > spot.at
            && spot.at > asks
            && self.nouns.iter().all(|s| named(&s.noun) && s.noun.restrictions.is_empty())
            && self.marks.iter().all(small)
            && !spot.either
            && self.values.is_empty()
            && self.sizes.is_empty()
            && self.links.is_empty();
        let items = self.sentence.items();
        let placed = items.iter().position(|item| matches!(item, Item::Place { .. }))?;
        let begins = items[placed..].iter().find_map(|item| match item {
            Item::Noun(phrase) => Some(phrase.words.start),
            _ => None,
        })?;
        let colon = self.sentence.colon_before(begins);
        let parted = colon || self.has(Mark::Or) && self.sentence.comma_between(begins, begins);
        if !listed || !parted {
            return None;
        }
        let of_kind = |noun: &Noun| {
            let mut noun = Noun { indefinite: true, ..noun.clone() };
            if !noun.head.kinds.is_empty() {
                noun.head.named.clear();
            }
            let anchors = spot.nouns.clone();
            noun.restrictions.push(Restriction { rel: spot.rel, anchors, negated: false });
            noun
        };
        let what = self.nouns.iter().map(|s| of_kind(&s.noun)).collect();
        Some(Query::Exists { what, either: true, denial: Denial::Unasked })
    }
}
