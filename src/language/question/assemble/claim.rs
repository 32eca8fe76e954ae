//! Questions whether something is so or exists, and why.
//!
//! Invariant: a sentence that claims nothing is no such question.

use super::Frame;
use super::Spot;
use super::Subject;
use crate::question::mark::Mark;
use crate::question::query::{Claim, Denial, Extreme, Filter, Noun, Query, Rel, Restriction};
use crate::question::values::ValueId;
use crate::sets::set;

impl Frame<'_, '_> {
    /// «В холодильнике пусто?», «Темно ли в спальне?»: a value in the short neuter that no noun bears is said of the place.
    pub(super) fn said_of_a_place(&self) -> Option<Query> {
        let ([(value, _, negated)], [spot]) = (&self.values[..], &self.spots[..]) else {
            return None;
        };
        let one = matches!((spot.rel, &spot.nouns[..]), (Rel::In | Rel::On, [_]));
        let neuter = self
            .sentence
            .keys
            .iter()
            .any(|key| key.ends_with('о') && self.lexicon.values.meaning(key) == Some(*value));
        // «А чё, в холодильнике пусто?» asks for no things.
        let asks = [Mark::Which, Mark::HowMany, Mark::Where].into_iter().any(|mark| self.has(mark));
        if asks || !self.nouns.is_empty() || !one || spot.negated || !neuter {
            return None;
        }
        let claims = vec![Claim::Value(Filter::new(*value, *negated))];
        let subject = spot.nouns[0].clone();
        Some(Query::Holds { subject, claims, denial: self.negated.into() })
    }

    pub(super) fn why(&self) -> Query {
        let negated = self.has(Mark::WhyNot) || self.negated;
        // «Почему она там?» asks of its place.
        let there =
            set!("ThereWord").iter().any(|word| self.sentence.keys.iter().any(|k| k == word));
        let about = match self.nouns.is_empty() && self.spots.is_empty() {
            true => None,
            false if there && self.spots.is_empty() && self.values.is_empty() => {
                self.first().map(Query::Where)
            }
            false => self.exists_or_holds(),
        };
        Query::Why { negated, about: about.map(Box::new) }
    }

    fn exists_or_holds(&self) -> Option<Query> {
        // «Почему нельзя попасть в лабораторию?»
        let goes = self.has(Mark::Move) || self.has(Mark::Lead) || self.says_out();
        let moves = self.has(Mark::Can) && goes;
        if let (true, [only]) = (self.has(Mark::Take), &self.nouns[..]) {
            return Some(Query::Takes(self.with_rest(only.noun.clone(), &[])));
        }
        // "Why can't you get through the kitchen door?" asks whether it is open.
        let open = self.lexicon.values.meaning("открытый");
        if let (true, [], [Spot { rel: Rel::Through, nouns, .. }], Some(open)) =
            (moves, &self.nouns[..], &self.spots[..], open)
            && let [door] = &nouns[..]
            && self.is_doors(door)
        {
            let claims = vec![Claim::Value(Filter::new(open, false))];
            return Some(Query::Holds { subject: door.clone(), claims, denial: Denial::default() });
        }
        let way = || if moves { self.passing().or_else(|| self.way()) } else { None };
        way().or_else(|| self.holds()).or_else(|| self.exists())
    }

    pub(super) fn exists(&self) -> Option<Query> {
        // «нет красных чашек»: the genitive is of what there is none of, whatever stands between.
        let lacks = self.sentence.keys.iter().any(|key| key == "нет" || key == "нету");
        let none = self.has(Mark::Not)
            && (lacks || self.values.is_empty())
            && self.nouns.iter().any(|s| {
                // «нет чашки»
                let governed =
                    s.at.checked_sub(1).is_some_and(|n| self.marks.contains(&(Mark::Not, n)));
                !s.nominative || lacks && governed
            });
        // «Ты видишь кресло?»: in view, not on the map.
        let key = |word: &str| self.sentence.keys.iter().any(|key| key == word);
        let from_here = key("see") && key("from");
        let plain = self.spots.is_empty()
            && self.values.is_empty()
            && (from_here || !self.has(Mark::Exists));
        if let ([only], true, true) = (&self.nouns[..], self.has(Mark::See) || from_here, plain)
            && !self.is_area(&only.noun)
            && !self.asks()
        {
            return Some(Query::Sees(only.noun.clone()));
        }
        // "Is the television visible from the sofa?": what is seen from elsewhere is not known.
        if self.has(Mark::See) && self.spot(&[Rel::From]).is_some() {
            return None;
        }
        let seen = self.has(Mark::See) && !self.nouns.is_empty();
        // «Бананы остались?», of which nothing else is asked.
        let left = |key: &String| key.starts_with("остал") || key.starts_with("остаё");
        let remains = !self.nouns.is_empty()
            && self.values.is_empty()
            && !self.asks()
            && !self.has(Mark::Where)
            && self.sentence.keys.iter().any(left);
        let exists = self.has(Mark::Exists) || self.has(Mark::Have) || seen || none || remains;
        if !exists {
            return None;
        }
        let mut subjects: Vec<&Subject> = self.nouns.iter().collect();
        // «Есть ли дома растения?» asks for plants.
        if subjects.iter().any(|s| !self.is_building(&s.noun)) && !self.has(Mark::Have) {
            subjects.retain(|s| !self.is_building(&s.noun));
        }
        let mut within = Vec::new();
        // "Does the kitchen have a fridge?"
        if self.has(Mark::Have) && subjects.len() > 1 {
            let owner = subjects.remove(0);
            // "Do any of the rooms have two doors?" asks for such a room.
            if self.is_rooms(&owner.noun) && owner.noun.indefinite {
                let mut rooms = owner.noun.clone();
                let having = subjects.iter().map(|s| Noun { indefinite: true, ..s.noun.clone() });
                rooms.restrictions.extend(having.map(|anchor| Restriction {
                    rel: Rel::Has,
                    anchors: vec![anchor],
                    negated: false,
                }));
                let what = vec![Noun { plural: true, ..self.with_rest(rooms, &[]) }];
                return Some(Query::Exists { what, either: false, denial: self.negated.into() });
            }
            // "Does the bedroom have a window and the kitchen a fridge?" says nothing of a kitchen in the bedroom.
            let rooms = subjects.iter().filter(|s| self.is_area(&s.noun)).count();
            if rooms > 0 && rooms < subjects.len() {
                return None;
            }
            if !self.is_building(&owner.noun) {
                let rel = if self.is_area(&owner.noun) { Rel::In } else { Rel::On };
                within.push(Restriction { rel, anchors: vec![owner.noun.clone()], negated: false });
            }
        }
        let mut what: Vec<Noun> = Vec::new();
        for subject in &subjects {
            // «Есть ли в доме комната с диваном?» has its sofa in a place already.
            let mut noun = subject.noun.clone();
            noun.indefinite = true;
            noun.restrictions.extend(within.iter().cloned());
            if !noun.head.kinds.is_empty() {
                noun.head.named.retain(|_| noun.head.kinds.is_empty());
                // «Вино ещё есть?», "Are there more potatoes?": besides what was spoken of.
                let more = |(mark, _): &(Mark, usize)| {
                    matches!(mark, Mark::Other | Mark::More(Extreme::Most))
                };
                noun.other |= self.marks.iter().any(more) && !self.has(Mark::Than);
            }
            what.push(self.with_rest(noun, &[]));
        }
        if what.is_empty() {
            let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
            noun.head.anything = true;
            noun.restrictions = within;
            let told = self.spots.is_empty() && self.there.is_none() && self.values.is_empty();
            if told && self.sizes.is_empty() {
                return None;
            }
            what.push(self.with_rest(noun, &[]));
        }
        // «Яблока нет на столе» denies the apple, and neither the place nor what it is like.
        if none && self.marks.iter().filter(|(mark, _)| *mark == Mark::Not).count() == 1 {
            for noun in &mut what {
                noun.restrictions.iter_mut().for_each(|place| place.negated = false);
                noun.filters.iter_mut().for_each(|filter| filter.negated = false);
            }
        }
        what.iter_mut().for_each(|noun| self.joining(noun));
        let either = self.has(Mark::Or);
        Some(Query::Exists { what, either, denial: self.denied(none) })
    }

    /// Of what yes and no are said where a question asks whether there is something.
    pub(super) fn denied(&self, none: bool) -> Denial {
        match none || self.says_nothing() {
            // «Нет ли на кухне молока?», "Is there no milk?" ask whether there is some.
            true if self.has(Mark::Exists) && !self.says_nothing() => Denial::Idle,
            is_denied => is_denied.into(),
        }
    }

    /// "Is there nothing on the sofa?"
    fn says_nothing(&self) -> bool {
        self.sentence.keys.iter().any(|key| key == "nothing")
    }

    /// «С какой стороны от дивана стоит стеллаж?», "Which side of the sofa is the bookshelf on?"
    pub(super) fn side(&self) -> Option<Query> {
        let at = self.place_of(Mark::Side)?;
        let anchor = self.nouns.iter().find(|s| s.at > at)?;
        let subject = self.nouns.iter().find(|s| s.at != anchor.at)?;
        const SIDES: [Rel; 4] = [Rel::LeftOf, Rel::RightOf, Rel::InFrontOf, Rel::Behind];
        let claims = SIDES.map(|rel| {
            let anchors = vec![anchor.noun.clone()];
            Claim::Related(Restriction { rel, anchors, negated: false })
        });
        Some(Query::Choice { subject: subject.noun.clone(), claims: claims.to_vec() })
    }

    /// «Холодильник на кухне или в коридоре?», "Is the TV above the cabinet or on it?"
    pub(super) fn either_place(&self) -> Option<Query> {
        let or = self.place_of(Mark::Or)?;
        let [only] = &self.nouns[..] else { return None };
        let parted = self.spots.iter().any(|s| s.at < or) && self.spots.iter().any(|s| s.at > or);
        if !parted || self.spots.len() != 2 || !self.values.is_empty() || self.negated {
            return None;
        }
        let claims = self.spots.iter().flat_map(Spot::restrictions).map(Claim::Related).collect();
        Some(Query::Choice { subject: only.noun.clone(), claims })
    }

    pub(super) fn holds(&self) -> Option<Query> {
        // "Is the umbrella leaning against something?": against what.
        let told = self.links.iter().rev().find(|(rel, _)| *rel != Rel::To);
        if let ([only], Some((rel, _)), true) = (&self.nouns[..], told, self.has(Mark::Anything))
            && self.spots.is_empty()
            && self.values.is_empty()
            && !self.says_nothing()
        {
            return Some(Query::Anchor { rel: *rel, of: only.noun.clone(), what: None });
        }
        let told = !self.spots.is_empty() || !self.values.is_empty() || !self.sizes.is_empty();
        if self.has(Mark::Anything) && self.nouns.is_empty() && told {
            let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
            noun.head.anything = true;
            let what = vec![self.with_rest(noun, &[])];
            let denial = (self.negated || self.says_nothing()).into();
            return Some(Query::Exists { what, either: false, denial });
        }
        // "Is everything in the kitchen made of wood?"
        if self.has(Mark::All) && self.nouns.is_empty() && !self.values.is_empty() {
            let mut noun = Noun { plural: true, all: true, ..Noun::default() };
            noun.head.anything = true;
            for spot in &self.spots {
                self.attach(&mut noun, spot);
            }
            noun.except.extend(self.except.iter().cloned());
            let claims = self.filters().into_iter().map(Claim::Value).collect();
            return Some(Query::Holds { subject: noun, claims, denial: self.negated.into() });
        }
        if let Some(choice) = self.either_place() {
            return Some(choice);
        }
        let at = self.nouns.iter().position(|s| s.nominative).unwrap_or(0);
        let first = self.nouns.get(at)?;
        let mut subject = first.noun.clone();
        let mut claims: Vec<Claim> = Vec::new();
        // A room said before another place or a value tells which thing is meant.
        let mut spots: Vec<&Spot> = self.spots.iter().collect();
        let has_more = !self.values.is_empty() || spots.len() > 1;
        if has_more {
            let values = !self.values.is_empty();
            spots.retain(|spot| {
                let room = spot.rel == Rel::In && self.is_area(&spot.nouns[0]);
                let tells = values || room;
                if tells && !spot.negated && !spot.either {
                    self.attach(&mut subject, spot);
                    return false;
                }
                true
            });
            if spots.is_empty() && !values {
                spots = self.spots.iter().collect();
                subject = first.noun.clone();
            }
        }
        let mut chained: Vec<Restriction> = Vec::new();
        let mut holder = Noun::default();
        for spot in &spots {
            if spot.either {
                chained.extend(spot.each());
            } else {
                self.attach(&mut holder, spot);
            }
        }
        chained.extend(holder.restrictions);
        let denied = |r: &Restriction| r.negated && matches!(r.rel, Rel::Has | Rel::Bears);
        let lead = self.has(Mark::Lead) || self.is_doors(&subject);
        for mut restriction in chained {
            if self.is_building(&restriction.anchors[0]) {
                continue;
            }
            if lead
                && self.has(Mark::Lead)
                && matches!(restriction.rel, Rel::In | Rel::On | Rel::At)
            {
                restriction.rel = Rel::To;
            }
            restriction.negated = denied(&restriction);
            claims.push(Claim::Related(restriction));
        }
        for (value, _, _) in &self.values {
            claims.push(Claim::Value(Filter::new(*value, false)));
        }
        claims.extend(self.sizes.iter().copied().map(Claim::Size));
        for (_, other) in self.nouns.iter().enumerate().filter(|(n, _)| *n != at) {
            // "Is it the left one?": of which ones is not said.
            if other.noun.head.anything && other.noun.best.is_some() {
                return None;
            }
            // «А кухня и спальня?» says of none that it is the other.
            let joined =
                other.at.checked_sub(1).is_some_and(|n| self.marks.contains(&(Mark::And, n)));
            let rooms = self.is_area(&other.noun) && self.is_area(&subject);
            if joined && rooms && !self.has(Mark::Be) && !self.has(Mark::Lead) {
                return None;
            }
            // "Does Door VZ join Room V and Room Z?"
            if self.has(Mark::Lead) && self.is_area(&other.noun) {
                let anchors = vec![other.noun.clone()];
                claims.push(Claim::Related(Restriction { rel: Rel::Of, anchors, negated: false }));
            } else {
                claims.push(Claim::Kind(other.noun.clone()));
            }
        }
        // «Кружка там?»
        if let (true, Some(there)) = (claims.is_empty(), &self.there) {
            let anchors = vec![there.clone()];
            claims.push(Claim::Related(Restriction { rel: Rel::There, anchors, negated: false }));
        }
        // «Ведёт ли дверь из спальни прямо в ванную?»: whether there is one; of a door that is named, whether it does.
        let mut ends = subject.restrictions.clone();
        let leads = |claim: &Claim| match claim {
            Claim::Related(end) => Some(end.clone()),
            _ => None,
        };
        ends.extend(claims.iter().filter_map(leads));
        if ends.len() == subject.restrictions.len() + claims.len()
            && !claims.is_empty()
            && let Some(between) = self.joined_by(&subject, &ends)
        {
            let (named, things) = (&subject.head.named, &subject.head.things);
            let general = named.is_empty() && things.is_none();
            let restrictions = if general { vec![between.clone()] } else { Vec::new() };
            let door = Noun { restrictions, ..subject };
            let denial = self.negated.into();
            return Some(match general {
                true => {
                    let what = vec![Noun { indefinite: true, plural: true, ..door }];
                    Query::Exists { what, either: false, denial }
                }
                false => {
                    Query::Holds { subject: door, claims: vec![Claim::Related(between)], denial }
                }
            });
        }
        // "Three spoons are on the counter, right?": whether there are so many there, and not where each of them is.
        let placed = |claim: &Claim| matches!(claim, Claim::Related(place) if !place.negated);
        if subject.count.is_some()
            && subject.head.things.is_none()
            && !subject.all
            && !self.negated
            && !claims.is_empty()
            && claims.iter().all(placed)
        {
            let mut noun = Noun { plural: true, indefinite: true, ..subject };
            noun.restrictions.extend(claims.into_iter().filter_map(|claim| match claim {
                Claim::Related(place) => Some(place),
                _ => None,
            }));
            return Some(Query::Exists { what: vec![noun], either: false, denial: Denial::None });
        }
        // «Один ли телевизор в доме?»
        if claims.is_empty() && subject.count.is_some() && self.nouns.len() == 1 {
            let what = vec![Noun { plural: true, indefinite: true, ..subject }];
            return Some(Query::Exists { what, either: false, denial: self.negated.into() });
        }
        if claims.is_empty() {
            return None;
        }
        // "Rooms without a bed?" is a description.
        let having = |claim: &Claim| matches!(claim, Claim::Related(r) if matches!(r.rel, Rel::Has | Rel::Bears));
        let asks_for = subject.plural && subject.head.named.is_empty() && !self.has(Mark::Be);
        if asks_for && claims.iter().all(having) {
            return Some(Query::Find(Noun { indefinite: true, ..self.with_rest(subject, &[]) }));
        }
        // "Is any door open?" asks whether there is an open one.
        // "Is any of them red?"
        let of_those = subject.head.things.is_some()
            && (subject.plural && self.has(Mark::A) || subject.indefinite);
        let general = subject.head.named.is_empty() && subject.head.things.is_none();
        if (subject.indefinite && general) || of_those {
            // "Any chairs that are not white?" asks for others.
            let lacking = |(_, at, negated): &(ValueId, usize, bool)| {
                *negated && at.checked_sub(1).is_some_and(|n| self.marks.contains(&(Mark::Not, n)))
            };
            if !self.values.is_empty()
                && self.values.iter().all(lacking)
                && first.at < self.values[0].1
                && claims.iter().all(|c| matches!(c, Claim::Value(_)))
            {
                let mut noun = Noun { plural: true, ..subject };
                noun.filters.extend(self.filters());
                return Some(Query::Exists {
                    what: vec![noun],
                    either: false,
                    denial: Denial::None,
                });
            }
            let mut noun = Noun { plural: true, ..subject.clone() };
            for claim in &claims {
                match claim {
                    Claim::Value(filter) => noun.filters.push(filter.clone()),
                    Claim::Size(size) => noun.sizes.push(*size),
                    Claim::Related(place) => noun.restrictions.push(place.clone()),
                    // "Are any of them books?": whether there are books among them.
                    Claim::Kind(kind) if of_those => {
                        let anchors = vec![Noun { indefinite: false, ..subject.clone() }];
                        noun.head = kind.head.clone();
                        noun.text = kind.text.clone();
                        noun.restrictions.push(Restriction {
                            rel: Rel::From,
                            anchors,
                            negated: false,
                        });
                    }
                    Claim::Kind(_) => {
                        return Some(Query::Holds { subject, claims, denial: self.negated.into() });
                    }
                }
            }
            return Some(Query::Exists {
                what: vec![noun],
                either: false,
                denial: self.negated.into(),
            });
        }
        // «Лежит ли на комоде книга?» asks for any book; «Книга на комоде?» for the one.
        let places = claims.iter().all(|c| matches!(c, Claim::Related(_)));
        let later = self.spots.iter().all(|s| s.at < first.at) && !self.spots.is_empty();
        let general = subject.head.named.is_empty() && subject.head.things.is_none();
        if self.sentence.language == crate::Language::Russian
            && places
            && later
            && general
            && !self.negated
        {
            let mut noun = first.noun.clone();
            noun.indefinite = true;
            let what = vec![self.with_rest(noun, &[])];
            return Some(Query::Exists { what, either: false, denial: Denial::None });
        }
        let either = self.has(Mark::Or) || self.spots.iter().any(|s| s.either);
        let values = self.values.len() > 1 || (self.values.len() == 1 && claims.len() > 1);
        if either && (values || claims.len() > 1) {
            return Some(Query::Choice { subject, claims });
        }
        if let (true, [Claim::Value(only)]) = (either, &claims[..]) {
            let filter = only.clone();
            return Some(Query::Holds {
                subject,
                claims: vec![Claim::Value(filter)],
                denial: self.negated.into(),
            });
        }
        Some(Query::Holds { subject, claims, denial: self.negated.into() })
    }
}
