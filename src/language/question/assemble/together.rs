//! What several things share: one room, one table, the same values; and in what they differ.
//!
//! Invariant: at least two things are compared, or one description of several.

use super::Frame;
use crate::question::mark::Mark;
use crate::question::query::{Claim, Noun, Query, Rel, Restriction};

impl Frame<'_, '_> {
    /// «Лекарство и кровать в одной комнате?», "Is the battery on the same desk as the lamp?", "What else is in the
    /// same room as the fridge?"
    pub(super) fn together(&self) -> Option<Query> {
        let Some(spot) = self.spots.iter().find(|s| s.nouns[0].same) else {
            return self.same_room();
        };
        if !matches!(spot.rel, Rel::In | Rel::On | Rel::Under | Rel::NextTo) {
            return None;
        }
        let place = Noun { same: false, ..spot.nouns[0].clone() };
        // «в одной комнате с кроватью»: what follows the place, in whatever case.
        let with = self.spots.iter().filter(|s| {
            s.at > spot.at && matches!(s.rel, Rel::From | Rel::Has | Rel::To | Rel::At)
        });
        let partners: Vec<Noun> = with.flat_map(|s| s.nouns.iter().cloned()).collect();
        let asked = self.nouns.iter().find(|s| s.at < spot.at && self.follows_which(s.at));
        if self.asks() && (asked.is_some() || self.nouns.iter().all(|s| s.at > spot.at)) {
            let later =
                self.nouns.iter().filter(|s| s.at > spot.at).map(|s| (s.at, s.noun.clone()));
            let partners = partners.into_iter().map(|noun| (spot.at, noun));
            let (at, mut partner) = later.chain(partners).next()?;
            // "as the laptop in the bedroom"
            let rooms = self.spots.iter().filter(|s| {
                s.at > at
                    && matches!(s.rel, Rel::In | Rel::On)
                    && s.nouns.iter().all(|noun| self.is_area(noun))
            });
            partner.restrictions.extend(rooms.map(|s| Restriction {
                rel: s.rel,
                anchors: s.nouns.clone(),
                negated: s.negated,
            }));
            return Some(self.sharing(asked.map(|s| s.noun.clone()), place, spot.rel, partner));
        }
        let mut of: Vec<Noun> = self.nouns.iter().map(|s| s.noun.clone()).collect();
        of.extend(partners);
        let several = |noun: &Noun| noun.plural || noun.all || noun.head.things.is_some();
        let enough = of.len() > 1 || of.iter().any(several);
        (enough && !self.asks()).then_some(Query::Together { of, rel: spot.rel, place })
    }

    /// "The plunger and the toilet, same room?"
    fn same_room(&self) -> Option<Query> {
        let (room, of) = self.nouns.split_last()?;
        let plain = self.spots.is_empty() && self.values.is_empty() && !self.asks();
        let same = room.noun.same
            || self.marks.iter().any(|(mark, at)| *mark == Mark::Same && at + 1 == room.at);
        let only = plain && same && self.is_rooms(&room.noun);
        let of: Vec<Noun> = of.iter().map(|s| s.noun.clone()).collect();
        let place = Noun { same: false, ..room.noun.clone() };
        (only && of.len() > 1).then_some(Query::Together { of, rel: Rel::In, place })
    }

    /// What is in the room, or on the table, where its partner is.
    fn sharing(&self, asked: Option<Noun>, place: Noun, rel: Rel, partner: Noun) -> Query {
        let bears = if self.is_area(&place) { Rel::Has } else { Rel::Bears };
        let mut noun = asked.unwrap_or_default();
        if noun.head.kinds.is_empty() && noun.head.named.is_empty() {
            noun.head.anything = true;
        }
        noun.head.named.clear();
        noun.plural = true;
        noun.indefinite = true;
        noun.except.push(partner.clone());
        let having = Restriction { rel: bears, anchors: vec![partner], negated: false };
        let mut place = place;
        place.restrictions.push(having);
        noun.restrictions.push(Restriction { rel, anchors: vec![place], negated: false });
        Query::Find(noun)
    }

    /// «Диван и кресло стоят рядом?», "Are the sofa and the armchair next to each other?"
    pub(super) fn side_by_side(&self) -> Option<Query> {
        let (rel, _) = *self.links.iter().find(|(r, _)| matches!(r, Rel::NextTo | Rel::Near))?;
        // «Они рядом?» of two that were told.
        if let [pair] = &self.nouns[..]
            && let Some([one, other]) = pair.noun.head.things.as_deref()
            && !self.asks()
            && self.spots.is_empty()
        {
            let [one, other] = [one, other].map(|thing| Noun::of(vec![*thing]));
            let place = Restriction { rel, anchors: vec![other], negated: false };
            let claims = vec![Claim::Related(place)];
            return Some(Query::Holds { subject: one, claims, denial: self.negated.into() });
        }
        let [first, second] = &self.nouns[..] else { return None };
        if self.asks() || !self.has(Mark::And) || self.has(Mark::Where) || !self.spots.is_empty() {
            return None;
        }
        let anchors = vec![second.noun.clone()];
        let claims = vec![Claim::Related(Restriction { rel, anchors, negated: false })];
        Some(Query::Holds { subject: first.noun.clone(), claims, denial: self.negated.into() })
    }

    /// «Чем отличаются Шкаф-1 и Шкаф-2?», "What do the sofa and the bookshelf have in common?"
    pub(super) fn difference(&self) -> Option<Query> {
        let alike = self.has(Mark::Alike);
        // «Тумбочки одинаковые?»: in nothing do they differ.
        let alone = self.spots.is_empty() && self.links.is_empty() && self.values.is_empty();
        let same = self.has(Mark::Same) && self.property.is_none() && !self.asks() && alone;
        if !alike && !self.has(Mark::Differ) && !same {
            return None;
        }
        let mut of: Vec<Noun> = self.nouns.iter().map(|s| s.noun.clone()).collect();
        of.extend(self.spots.iter().flat_map(|s| s.nouns.iter().cloned()));
        let several = |noun: &Noun| noun.plural || noun.all || noun.head.things.is_some();
        let enough = of.len() == 2 || (of.len() == 1 && several(&of[0]));
        let dimension = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::HowBig(dimension) => Some(*dimension),
            _ => None,
        });
        enough.then_some(match dimension.filter(|_| same) {
            Some(dimension) => Query::SameSize { dimension, of },
            None => Query::Differ { of, alike },
        })
    }
}
