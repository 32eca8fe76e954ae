//! Questions for ways, distances and where doors lead.
//!
//! Invariant: a question without a goal is none of these.

use super::Frame;
use super::Spot;
use crate::language::question::lexicon::Extension;
use crate::language::question::query::{Filter, Head, Noun, Query, Rel, Restriction, Thing};
use crate::language::question::vocabulary::Mark;

impl Frame<'_, '_> {
    pub(super) fn way(&self) -> Option<Query> {
        let far = self.has(Mark::HowFar);
        if self.asks() && self.has(Mark::Can) && !far && !self.has(Mark::HowGet) {
            return None;
        }
        let how = self.has(Mark::HowGet)
            || (self.has(Mark::How) && (self.has(Mark::Move) || self.has(Mark::Lead)));
        let can = self.has(Mark::Can) && (self.has(Mark::Move) || self.has(Mark::Lead));
        if !(far || how || can) {
            return None;
        }
        let pair = self.spot(&[Rel::Between]).filter(|s| s.nouns.len() == 2);
        if let Some(pair) = pair {
            let (from, to) = (Some(pair.nouns[0].clone()), pair.nouns[1].clone());
            let detail = self.detail();
            return Some(match far {
                true => Query::Distance { from, to },
                false => Query::Way { from, to, detail },
            });
        }
        let from = self.spot(&[Rel::From, Rel::Of]).map(|s| s.nouns[0].clone());
        const TO: [Rel; 12] = [
            Rel::To,
            Rel::In,
            Rel::On,
            Rel::At,
            Rel::NextTo,
            Rel::Near,
            Rel::Under,
            Rel::Behind,
            Rel::InFrontOf,
            Rel::Outside,
            Rel::LeftOf,
            Rel::RightOf,
        ];
        let robot = |noun: &Noun| noun.head.things.as_deref() == Some(&[Thing::Robot][..]);
        let mut ends: Vec<Noun> = self.nouns.iter().map(|s| s.noun.clone()).collect();
        ends.extend(self.there.clone());
        let room = self.spot_noun(&TO);
        let (from, to) = match (from, room, ends.len()) {
            // "How far is the table from the bed?"
            (from, None, 1..) => {
                let second = ends.get(1).cloned();
                (
                    from.or_else(|| second.clone().map(|_| ends[0].clone())),
                    second.unwrap_or_else(|| ends[0].clone()),
                )
            }
            (Some(from), Some(mut to), 1..) if far => {
                // "How far is the chair in the kitchen from the table?"
                if self.is_area(&to) && !self.is_area(&ends[0]) {
                    let place = Restriction { rel: Rel::In, anchors: vec![to], negated: false };
                    to = ends[0].clone();
                    to.restrictions.push(place);
                }
                (Some(from), to)
            }
            (None, Some(to), 1..) if far => (Some(ends[0].clone()), to),
            (from, Some(to), _) => (from, to),
            (Some(from), None, 0) if far => (None, from),
            _ => return None,
        };
        let from = from.filter(|noun| !robot(noun));
        Some(match () {
            () if far => Query::Distance { from, to },
            () if can && !how => Query::CanReach { from, to },
            () => Query::Way { from, to, detail: self.detail() },
        })
    }

    pub(super) fn leads(&self) -> Option<Query> {
        let door = self.nouns.iter().find(|s| self.is_doors(&s.noun) && !s.noun.plural);
        let asks_where = self.has(Mark::Where) || self.has(Mark::Whither);
        let rooms = self.nouns.iter().any(|s| self.is_rooms(&s.noun) || self.is_area(&s.noun));
        let leads = self.has(Mark::Lead) || (self.has(Mark::Move) && self.asks());
        if !leads {
            return None;
        }
        if let Some(door) = door
            && (asks_where || (self.asks() && (rooms || self.has(Mark::What))))
        {
            let which = self.nouns.iter().any(|s| {
                self.is_doors(&s.noun) && s.noun.head.named.is_empty() && self.follows_which(s.at)
            });
            if !which {
                return Some(Query::Leads(self.with_rest(door.noun.clone(), &[])));
            }
        }
        // «Какие двери ведут из Комнаты-В», "which doors lead to the kitchen"
        let doors = self.nouns.iter().find(|s| self.is_doors(&s.noun));
        if let (Some(doors), true) = (doors, self.asks() || self.has(Mark::List)) {
            let mut noun = doors.noun.clone();
            noun.plural = true;
            noun.head.named.clear();
            let rooms: Vec<Noun> = self
                .nouns
                .iter()
                .filter(|s| s.at != doors.at && self.is_area(&s.noun))
                .map(|s| s.noun.clone())
                .collect();
            if rooms.len() == 2 {
                noun.restrictions.push(Restriction {
                    rel: Rel::Between,
                    anchors: rooms,
                    negated: false,
                });
                return Some(Query::Find(noun));
            }
            for other in self.nouns.iter().filter(|s| s.at != doors.at && self.is_area(&s.noun)) {
                let anchors = vec![other.noun.clone()];
                noun.restrictions.push(Restriction { rel: Rel::Of, anchors, negated: false });
            }
            let to_or_from = |spot: &Spot| match spot.rel {
                Rel::In | Rel::On | Rel::To | Rel::At => Rel::To,
                rel => rel,
            };
            for spot in &self.spots {
                let spot = Spot { rel: to_or_from(spot), ..spot.clone() };
                noun.restrictions.extend(spot.restrictions());
            }
            for (value, _, negated) in &self.values {
                noun.filters.push(Filter { value: *value, negated: *negated });
            }
            return Some(Query::Find(noun));
        }
        // «С какими комнатами соединена Комната-В?», «С чем граничит Комната-В?», «Куда можно выйти из Комнаты-В?»
        if self.asks() || asks_where || self.has(Mark::As) {
            let room =
                self.nouns.iter().rev().find(|s| self.is_area(&s.noun) && !self.is_rooms(&s.noun));
            let anchor = room.map(|s| s.noun.clone()).or_else(|| {
                self.spots.iter().find(|s| self.is_area(&s.nouns[0])).map(|s| s.nouns[0].clone())
            })?;
            return Some(Query::Find(self.rooms_near(anchor)));
        }
        None
    }

    pub(super) fn rooms_near(&self, anchor: Noun) -> Noun {
        let kinds = self.lexicon.kind_of(&Extension::Rooms).into_iter().collect();
        let restriction = Restriction { rel: Rel::Near, anchors: vec![anchor], negated: false };
        Noun {
            head: Head { kinds, ..Head::default() },
            plural: true,
            restrictions: vec![restriction],
            ..Noun::default()
        }
    }
}
