//! Questions for ways, distances and where doors lead.
//!
//! Invariant: a question without a goal is none of these.

use super::Frame;
use super::Spot;
use super::Subject;
use crate::question::grammar::Item;
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::query::{
    Best, Claim, Closeness, Extreme, Head, Noun, Query, Reach, Rel, Restriction, Thing,
};
use crate::sets::{Set, set};
use crate::units::InOrder as _;
use crate::words::{Case, Language};

impl Frame<'_, '_> {
    /// Whether a place says where something is, and by its case cannot say whither: «на кухне».
    fn is_where(&self, spot: &Spot) -> bool {
        if self.sentence.language != Language::Russian || !matches!(spot.rel, Rel::In | Rel::On) {
            return false;
        }
        let items = self.sentence.items();
        let Some(Item::Place { nouns, .. }) = items.get(spot.at) else { return false };
        let has = |case: Case| nouns[0].cases.iter().any(|reading| reading.has_case(case));
        (has(Case::Prepositional) || has(Case::Locative)) && !has(Case::Accusative)
    }

    /// "Which rooms can you not reach?", «До каких комнат ты доберёшься?», «Куда ты можешь доехать?»
    pub(super) fn reached(&self) -> Option<Query> {
        let measures = [Mark::HowFar, Mark::HowLong, Mark::HowGet];
        if measures.iter().any(|mark| self.has(*mark)) {
            return None;
        }
        let robot = |noun: &Noun| noun.head.things.as_deref() == Some(&[Thing::Robot][..]);
        let mut nouns = self.nouns.iter().map(|s| &s.noun).filter(|noun| !robot(noun));
        let around = |spot: &&Spot| spot.rel == Rel::Through && spot.negated;
        let spots: Vec<&Spot> = self.spots.iter().filter(|spot| !around(spot)).collect();
        let around = self.spots.iter().filter(around);
        let avoiding: Vec<Noun> = around.flat_map(|spot| spot.nouns.iter().cloned()).collect();
        // «До каких комнат …?» asks whither by itself.
        let able = self.has(Mark::Can)
            || self.links.iter().any(|(rel, _)| matches!(rel, Rel::To | Rel::In));
        let asks = self.asks() && self.has(Mark::Move);
        let from = spots.iter().find(|spot| spot.rel == Rel::From && !avoiding.is_empty());
        let ends: Vec<&&Spot> =
            spots.iter().filter(|spot| from.is_none_or(|from| from.at != spot.at)).collect();
        let what = match (nouns.next(), &ends[..]) {
            (Some(noun), []) if asks && able && !self.is_doors(noun) => noun.clone(),
            (None, [Spot { rel: Rel::To | Rel::In, nouns, .. }])
                if asks && self.is_rooms(&nouns[0]) =>
            {
                nouns[0].clone()
            }
            (None, []) if self.asks_whither() => {
                let except = self.except.clone();
                Noun {
                    head: Head::of_kind(self.lexicon, &Extension::Rooms),
                    except,
                    ..Noun::default()
                }
            }
            _ => return None,
        };
        if nouns.next().is_some() {
            return None;
        }
        let from = from.and_then(|spot| spot.nouns.first()).cloned().map(Box::new);
        let reach = Reach { able: !self.negated, from, avoiding };
        Some(Query::Find(Noun { plural: true, reached: Some(reach), ..what }))
    }

    /// «Куда ты можешь доехать?», "Where can you go?"
    fn asks_whither(&self) -> bool {
        let goes = self.has(Mark::Move) || self.has(Mark::Lead);
        let whither = self.has(Mark::Whither)
            || self.has(Mark::Where) && self.sentence.language == Language::English;
        whither && goes && self.has(Mark::Can) && self.you && self.there.is_none()
    }

    pub(super) fn way(&self) -> Option<Query> {
        if let Some(query) = self.which_way() {
            return Some(query);
        }
        let long = self.has(Mark::HowLong);
        let far = self.has(Mark::HowFar) || long;
        if self.asks() && self.has(Mark::Can) && !far && !self.has(Mark::HowGet) {
            return None;
        }
        if far && self.marks.iter().any(|(m, _)| matches!(m, Mark::More(_))) {
            return None;
        }
        let goes = self.has(Mark::Move) || self.has(Mark::Lead);
        // «Через какие комнаты идти из спальни в ванную?», "Which doors do I go through from the hall to the bedroom?": of one
        // door it is asked which lies between.
        let passed =
            |s: &Subject| self.is_rooms(&s.noun) || (self.is_doors(&s.noun) && s.noun.plural);
        let through =
            self.links.iter().any(|(rel, _)| *rel == Rel::Through) && self.nouns.iter().all(passed);
        // "Which doors do I pass on the way from the hall to the bedroom?"
        let both = self.spot(&[Rel::From]).is_some() && self.spot(&[Rel::To, Rel::In]).is_some();
        let named = |s: &Subject| self.is_doors(&s.noun) || self.is_rooms(&s.noun);
        let on_the_way = (self.has(Mark::HowGet) && self.nouns.iter().all(named))
            || (self.has(Mark::Move) && self.nouns.iter().all(passed));
        let by_rooms = self.asks() && ((through && goes) || (both && on_the_way));
        if by_rooms {
            let to = self.spot_noun(&[Rel::To]).or_else(|| self.spot_noun(&[Rel::In, Rel::On]))?;
            let from = self.spot_noun(&[Rel::From]);
            return Some(Query::Way { from, to, detail: self.detail() });
        }
        let how = !long && (self.has(Mark::HowGet) || (self.has(Mark::How) && goes));
        if how && let Some(out) = self.way_out() {
            return Some(out);
        }
        // "How do I leave the bedroom?"
        if let ([left], true) = (&self.nouns[..], how && self.spots.is_empty())
            && self.says_out()
            && self.is_area(&left.noun)
        {
            return Some(self.doors_out_of(left.noun.clone()));
        }
        // "Can you leave the kitchen?", "Can you get out of the kitchen?"
        let left = match (&self.nouns[..], &self.spots[..]) {
            ([left], []) => Some(&left.noun),
            ([], [Spot { rel: Rel::From, nouns, .. }]) => nouns.first(),
            _ => None,
        };
        if let Some(left) = left.filter(|left| self.is_area(left))
            && self.has(Mark::Can)
            && self.says_out()
        {
            return Some(self.doors_out_of(left.clone()));
        }
        let can = self.has(Mark::Can) && goes;
        if !(far || how || can) {
            return None;
        }
        let pair = self.spot(&[Rel::Between]).filter(|s| s.nouns.len() == 2);
        if let Some(pair) = pair {
            let (from, to) = (Some(pair.nouns[0].clone()), pair.nouns[1].clone());
            let detail = self.detail();
            return Some(match far {
                true if long => Query::Duration { from, to },
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
        // «Я на кухне, как пройти?» says whence, and not whither.
        let goal = self.spot(&TO).filter(|spot| !(ends.is_empty() && self.is_where(spot)));
        let room = goal.and_then(|spot| spot.nouns.first()).cloned();
        let (from, to) = match (from, room, ends.len()) {
            // "How far is the table from the bed?"
            // "How far apart are the two wardrobes?"
            (None, None, 1) if far && ends[0].plural => {
                let pair = self.with_rest(ends[0].clone(), &[]);
                return Some(Query::Distance { from: Some(pair.clone()), to: pair });
            }
            // "I need the bathroom, how do I get out of the kitchen?": which of the two is left nothing says.
            (None, None, 2..) if self.says_out() => return None,
            (from, None, 1..) => {
                let second = ends.get(1).cloned();
                (
                    from.or_else(|| second.clone().map(|_| ends[0].clone())),
                    second.unwrap_or_else(|| ends[0].clone()),
                )
            }
            (Some(from), Some(mut to), 1..) if far => {
                // "How far is the sofa from the table in the kitchen?": the room is of both.
                let place = self.spot(&TO).map_or(0, |s| s.at);
                let mut from = from;
                if self.is_area(&to)
                    && !self.is_area(&from)
                    && self.spot(&[Rel::From, Rel::Of]).is_some_and(|s| s.at + 1 == place)
                {
                    let anchors = vec![to.clone()];
                    from.restrictions.push(Restriction { rel: Rel::In, anchors, negated: false });
                }
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
            // «Как выйти из спальни?»: by its doors.
            (Some(from), None, 0) if how && self.is_area(&from) => {
                return Some(self.doors_out_of(from));
            }
            _ => return None,
        };
        // "… to the wardrobe in the bedroom"
        let mut to = to;
        let goal = self.spots.iter().find(|s| s.rel == Rel::To && s.nouns[0] == to);
        let room = goal.and_then(|goal| self.spots.iter().find(|s| s.at == goal.at + 1));
        let room = room.filter(|s| s.rel == Rel::In && self.is_area(&s.nouns[0]));
        if let Some(room) = room.filter(|_| !self.is_area(&to)) {
            to.restrictions.extend(room.restrictions());
        }
        let from = from.filter(|noun| !robot(noun));
        // Of several ways out the nearest is meant.
        if self.is_exits(&to) && to.best.is_none() {
            to.best = Some(Best { extreme: Extreme::Nearest, anchor: None });
        }
        Some(match () {
            () if long => Query::Duration { from, to },
            () if far => Query::Distance { from, to },
            () if can && !how => Query::CanReach { from, to },
            () => Query::Way { from, to, detail: self.detail() },
        })
    }

    /// «Какой путь короче: из спальни в коридор или на кухню?»
    fn which_way(&self) -> Option<Query> {
        let extreme = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::More(Extreme::Lowest | Extreme::Smallest | Extreme::Shortest)
            | Mark::Nearer(Closeness::Nearer) => Some(Extreme::Nearest),
            Mark::More(Extreme::Longest | Extreme::Biggest) | Mark::Nearer(Closeness::Farther) => {
                Some(Extreme::Farthest)
            }
            _ => None,
        })?;
        let either = self.has(Mark::Or) || self.spots.iter().any(|s| s.either);
        let goes = self.has(Mark::HowGet) || self.has(Mark::Whither) || self.has(Mark::Move);
        if !either || !goes || !self.nouns.is_empty() {
            return None;
        }
        let mut from = None;
        let mut ways: Vec<(Option<Noun>, Noun)> = Vec::new();
        let mut spots: Vec<&Spot> = self.spots.iter().collect();
        spots.order_by_key(|spot| spot.at);
        for spot in spots {
            match spot.rel {
                Rel::From => from = spot.nouns.first().cloned(),
                Rel::To | Rel::In | Rel::On | Rel::At => {
                    ways.extend(spot.nouns.iter().map(|to| (from.clone(), to.clone())));
                }
                _ => return None,
            }
        }
        (ways.len() == 2).then_some(Query::WhichWay { of: ways, extreme })
    }

    pub(super) fn is_exits(&self, noun: &Noun) -> bool {
        let outside = |e: &Extension| matches!(e, Extension::Exits | Extension::OuterDoors);
        let exits = |k: &_| outside(&self.lexicon.kind(*k).extension);
        noun.head.named.is_empty() && noun.head.kinds.iter().any(exits)
    }

    /// «Как выйти из квартиры?»: to the nearest way out.
    fn way_out(&self) -> Option<Query> {
        let nouns = self.nouns.iter().map(|s| &s.noun);
        let spots = self.spots.iter().flat_map(|s| &s.nouns);
        let all: Vec<&Noun> = nouns.chain(spots).collect();
        let out =
            (!all.is_empty() || self.says_out()) && all.iter().all(|noun| self.is_building(noun));
        if !out || self.spots.iter().any(|s| s.rel != Rel::From) {
            return None;
        }
        Some(Query::Way { from: None, to: self.nearest_exit(), detail: self.detail() })
    }

    /// "How do I get out of here?"
    pub(super) fn says_out(&self) -> bool {
        static OUT: Set = Set::named("WayOut");
        self.sentence.keys.iter().any(|key| OUT.contains(&key.as_str()))
    }

    /// The doors of a room, by which one leaves it.
    fn doors_out_of(&self, room: Noun) -> Query {
        let out = Restriction { rel: Rel::From, anchors: vec![room], negated: false };
        let head = Head::of_kind(self.lexicon, &Extension::Doors);
        Query::Find(Noun { head, plural: true, restrictions: vec![out], ..Noun::default() })
    }

    /// «Соединена ли спальня с кухней?», "Are the hall and the kitchen connected?"
    pub(super) fn joined(&self) -> Option<Query> {
        let doors = self.nouns.iter().any(|s| self.is_doors(&s.noun));
        if !self.has(Mark::Lead) || self.asks() || self.has(Mark::Where) || doors {
            return None;
        }
        let rooms = self.nouns.iter().filter(|s| self.is_area(&s.noun)).map(|s| s.noun.clone());
        let mut rooms: Vec<Noun> = rooms.collect();
        let places = self.spots.iter().flat_map(|s| &s.nouns).filter(|n| self.is_area(n));
        rooms.extend(places.cloned());
        let [subject, other] = <[Noun; 2]>::try_from(rooms).ok()?;
        let place = Restriction { rel: Rel::NextTo, anchors: vec![other], negated: false };
        let claims = vec![Claim::Related(place)];
        Some(Query::Holds { subject, claims, denial: self.negated.into() })
    }

    pub(super) fn leads(&self) -> Option<Query> {
        let door = self
            .nouns
            .iter()
            .find(|s| self.is_doors(&s.noun) && (!s.noun.plural || s.noun.head.things.is_some()));
        let asks_where = self.has(Mark::Where) || self.has(Mark::Whither);
        // «Из какой комнаты можно выйти на улицу?»
        let exit = self.spots.iter().find(|s| self.is_exits(&s.nouns[0]));
        let asked = self.nouns.iter().find(|s| self.is_rooms(&s.noun) && self.follows_which(s.at));
        if let (Some(exit), Some(asked)) = (exit, asked)
            && (self.has(Mark::Lead) || self.has(Mark::Move) || self.has(Mark::Exists))
        {
            let anchors = vec![Noun { indefinite: true, ..exit.nouns[0].clone() }];
            let mut rooms = Noun { plural: true, indefinite: true, ..asked.noun.clone() };
            rooms.restrictions.push(Restriction { rel: Rel::Has, anchors, negated: false });
            return Some(Query::Find(rooms));
        }
        if let Some(query) = self.passage_rooms().or_else(|| self.passage_between()) {
            return Some(query);
        }
        // «Куда попадёшь из кухни через Дверь-ВZ?»
        let through = self.spots.iter().find(|s| s.rel == Rel::Through);
        if let Some(through) = through.filter(|s| {
            let leads = self.has(Mark::Lead) || self.has(Mark::Move);
            leads && (asks_where || self.asks()) && self.is_doors(&s.nouns[0])
        }) {
            return Some(Query::Leads(through.nouns[0].clone()));
        }
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
            // «Какая дверь ведёт на улицу?»
            let out = |s: &&Spot| {
                self.is_exits(&s.nouns[0])
                    || (matches!(s.rel, Rel::From | Rel::Outside) && self.is_building(&s.nouns[0]))
            };
            if let Some(out) = self.spots.iter().find(out) {
                let outer: Vec<_> =
                    self.lexicon.kind_of(&Extension::OuterDoors).into_iter().collect();
                // «Какие из них ведут наружу?»: those of them that do.
                match noun.head.things.is_some() {
                    true => noun.also.push(Head { kinds: outer, ..Head::default() }),
                    false => noun.head.kinds = outer,
                }
                return Some(Query::Find(self.with_rest(noun, &[out.at])));
            }
            let to_or_from = |spot: &Spot| match spot.rel {
                Rel::In | Rel::On | Rel::To | Rel::At => Rel::To,
                rel => rel,
            };
            for spot in &self.spots {
                let spot = Spot { rel: to_or_from(spot), ..spot.clone() };
                noun.restrictions.extend(spot.restrictions());
            }
            noun.filters.extend(self.filters());
            return Some(Query::Find(noun));
        }
        // «С какими комнатами соединена Комната-В?», «С чем граничит Комната-В?», «Куда можно выйти из Комнаты-В?»
        if self.asks() || asks_where || self.has(Mark::As) {
            let mut rooms = self.rooms_near(self.joined_room()?);
            // "Which floors does the lift go to?", "Which corridor leads to the lab?"
            if let Some(asked) = asked {
                rooms.head.kinds.clone_from(&asked.noun.head.kinds);
                rooms.text.clone_from(&asked.noun.text);
            }
            // «Из каких комнат можно попасть в коридор?», "Which rooms lead to the corridor?"
            let whither = self.spots.iter().any(|s| {
                self.is_area(&s.nouns[0]) && matches!(s.rel, Rel::To | Rel::In | Rel::On | Rel::At)
            });
            let from = self.links.iter().any(|(rel, _)| *rel == Rel::From);
            let joined = self
                .sentence
                .keys
                .iter()
                .any(|key| set!("JoinStem").iter().any(|stem| key.starts_with(stem)));
            if whither && (from || !joined) && !asks_where && !self.negated {
                rooms.restrictions.iter_mut().for_each(|r| r.rel = Rel::To);
            }
            if self.negated {
                // «Какие комнаты не соединены с коридором?»: a room is not joined to itself.
                let [place] = &mut rooms.restrictions[..] else { return None };
                place.negated = true;
                rooms.except.extend(place.anchors.iter().cloned());
            }
            return Some(Query::Find(rooms));
        }
        None
    }

    /// «Из какой комнаты есть проход в гостиную?», «В какие комнаты есть проход из кухни?»
    fn passage_rooms(&self) -> Option<Query> {
        let [one, other] = &self.nouns[..] else { return None };
        let asked = |s: &&Subject| self.is_rooms(&s.noun) && self.follows_which(s.at);
        let rooms = [one, other].into_iter().find(asked)?;
        let doors = [one, other].into_iter().find(|s| s.at != rooms.at)?;
        // A door is not any way; of a passage people speak where there is a door.
        let general = self.is_kind(&doors.noun, |e| *e == Extension::Passages)
            && doors.noun.head.named.is_empty();
        let place = self.spots.iter().find(|s| self.is_area(&s.nouns[0]))?;
        if !general || !self.has(Mark::Exists) || self.negated {
            return None;
        }
        let from = self.links.iter().any(|(rel, _)| *rel == Rel::From);
        let rel = match (from, place.rel) {
            (true, Rel::In | Rel::On | Rel::To) => Rel::To,
            (false, Rel::From) => Rel::Near,
            _ => return None,
        };
        let mut rooms = self.rooms_near(place.nouns[0].clone());
        rooms.restrictions.iter_mut().for_each(|r| r.rel = rel);
        Some(Query::Find(rooms))
    }

    /// «Есть ли проход из кухни в гостиную?»: whether they are joined, by a door too.
    fn passage_between(&self) -> Option<Query> {
        let [way] = &self.nouns[..] else { return None };
        let passage = |e: &Extension| *e == Extension::Passages;
        let ends = |rels: &[Rel]| {
            self.spot(rels).filter(|s| self.is_area(&s.nouns[0])).map(|s| s.nouns[0].clone())
        };
        let (from, to) = (ends(&[Rel::From])?, ends(&[Rel::To, Rel::In, Rel::On])?);
        let asked = self.has(Mark::Exists) && !self.asks() && !self.has(Mark::HowMany);
        if !asked || !self.is_kind(&way.noun, passage) || !way.noun.head.named.is_empty() {
            return None;
        }
        let place = Restriction { rel: Rel::NextTo, anchors: vec![to], negated: false };
        let claims = vec![Claim::Related(place)];
        Some(Query::Holds { subject: from, claims, denial: self.negated.into() })
    }

    /// The room to which others are joined.
    pub(super) fn joined_room(&self) -> Option<Noun> {
        let room = |s: &&Subject| self.is_area(&s.noun) && !self.is_rooms(&s.noun);
        let room = self.nouns.iter().rev().find(room).map(|s| &s.noun);
        let place = || self.spots.iter().map(|s| &s.nouns[0]).find(|noun| self.is_area(noun));
        room.or_else(place).cloned()
    }

    pub(super) fn rooms_near(&self, anchor: Noun) -> Noun {
        let restriction = Restriction { rel: Rel::Near, anchors: vec![anchor], negated: false };
        Noun {
            head: Head::of_kind(self.lexicon, &Extension::Rooms),
            plural: true,
            restrictions: vec![restriction],
            ..Noun::default()
        }
    }
}
