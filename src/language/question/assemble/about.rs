//! Questions about the robot, history, what things are good for, parts and properties.
//!
//! Invariant: a rule answers only where one of its telling words stands.

use super::Frame;
use super::Spot;
use crate::map::Entity;
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::query::{Denial, Filter, Head, Noun, Query, Rel, Restriction, Thing, Use};
use crate::question::values::{Property, ValueId};
use crate::question::{opening, vocabulary};
use crate::report::Detail;
use crate::sets::{Set, set};
use crate::words::{Language, is_first_person, word_keys};

impl Frame<'_, '_> {
    pub(super) fn of_robot(&self) -> Option<Query> {
        if self.has(Mark::Hold) && self.nouns.is_empty() {
            return Some(Query::WhatDoYouHold);
        }
        if self.has(Mark::Help)
            && self.activity_said().is_none()
            && self.nouns.is_empty()
            && self.spots.is_empty()
        {
            return Some(Query::Help);
        }
        if self.has(Mark::Did) && self.nouns.is_empty() && self.spots.is_empty() {
            return Some(Query::Done);
        }
        let own = [
            (Mark::Changed, Query::Changed),
            (Mark::Unseen, Query::Unseen),
            (Mark::Sureness, Query::Sureness),
        ];
        if self.nouns.is_empty()
            && self.spots.is_empty()
            && let Some((_, query)) = own.into_iter().find(|(mark, _)| self.has(*mark))
        {
            return Some(query);
        }
        if self.has(Mark::Heading) && self.nouns.is_empty() && self.spots.is_empty() {
            return Some(Query::WhereAreYou(Detail::Heading));
        }
        // «Где я?», "Which floor am I on?"
        let me = self.me && !self.you && self.spots.is_empty() && !self.has(Mark::Can);
        // «Скажи мне, какая комната самая большая?» asks of the rooms.
        let plain = |noun: &Noun| {
            noun.head.named.is_empty() && noun.filters.is_empty() && noun.best.is_none()
        };
        let nowhere = self.values.is_empty()
            && !self.marks.iter().any(|(mark, _)| matches!(mark, Mark::Best(_) | Mark::More(_)))
            && self.nouns.iter().all(|s| self.is_area(&s.noun) && plain(&s.noun));
        let asks = self.has(Mark::Where) || (self.asks() && !self.nouns.is_empty());
        if me
            && asks
            && nowhere
            && self.activity_said().is_none()
            && !self.has(Mark::HowGet)
            && !self.has(Mark::Move)
        {
            return Some(Query::WhereAmI);
        }
        let storey = self.nouns.iter().any(|s| self.is_storeys(&s.noun));
        if self.you && self.asks() && storey && self.nouns.len() == 1 {
            let of = super::things(vec![Thing::Robot], "you");
            return Some(Query::Anchor { rel: Rel::In, of, what: self.first() });
        }
        let rooms_only = self.nouns.iter().all(|s| self.is_rooms(&s.noun));
        let others = !rooms_only || !self.spots.is_empty();
        // «Что ты видишь перед собой?»
        if self.has(Mark::See)
            && self.nouns.is_empty()
            && self.spots.iter().all(|s| s.rel == Rel::InFrontOf && is_robot(&s.nouns[0]))
        {
            return Some(Query::WhatDoYouSee);
        }
        // «Что ты видишь справа от себя?»
        if let (true, true, [spot]) = (self.has(Mark::See), self.nouns.is_empty(), &self.spots[..])
            && is_robot(&spot.nouns[0])
        {
            let head = Head { anything: true, ..Head::default() };
            let noun = Noun { head, plural: true, ..Noun::default() };
            return Some(Query::Find(self.with_rest(noun, &[])));
        }
        let asks = self.has(Mark::Where) || (self.asks() && !self.nouns.is_empty());
        let moves = self.has(Mark::Can) || self.has(Mark::HowGet) || self.has(Mark::Sit);
        if self.you && asks && !others && !moves && !self.has(Mark::Before) {
            return Some(Query::WhereAreYou(self.detail()));
        }
        None
    }

    /// "Who is in the kitchen?", «Есть ли кто-нибудь дома?»
    pub(super) fn people(&self) -> Option<Query> {
        let other = self.has(Mark::Took)
            || self.has(Mark::Have)
            || self.has(Mark::LastSeen)
            || self.has(Mark::Moved)
            || self.has(Mark::Move);
        let in_rooms =
            self.nouns.iter().map(|s| &s.noun).chain(self.spots.iter().flat_map(|s| &s.nouns));
        let only_rooms = in_rooms.into_iter().all(|noun| self.is_area(noun));
        let asks = self.nouns.len() + self.spots.len() > 0
            || self.there.is_some()
            || self.has(Mark::Exists)
            || self.has(Mark::Be)
            || self.has(Mark::See);
        // «Кто такой Боб?»
        if let ([one], true, true) =
            (&self.nouns[..], self.has(Mark::Who) && self.spots.is_empty(), !other && !only_rooms)
            && is_replica(&one.noun)
        {
            return Some(Query::Describe(one.noun.clone()));
        }
        let named = self.nouns.iter().filter(|s| !self.is_rooms(&s.noun)).map(|s| Restriction {
            rel: Rel::In,
            anchors: vec![s.noun.clone()],
            negated: false,
        });
        let spots = self.spots.iter().filter(|s| s.nouns.iter().all(|n| !self.is_building(n)));
        let within = named.chain(spots.flat_map(Spot::restrictions)).collect();
        (self.has(Mark::Who) && !other && only_rooms && asks && self.values.is_empty())
            .then_some(Query::People { within })
    }

    /// «Какие виды мебели есть в спальне?», "How many kinds of food are there?"
    pub(super) fn kinds(&self) -> Option<Query> {
        if !self.has(Mark::Kinds) {
            return None;
        }
        let mut noun = self.first()?;
        noun.plural = true;
        noun.indefinite = true;
        for other in self.nouns.iter().skip(1) {
            self.relate(&mut noun, other, other.negated || self.negated);
        }
        let count = self.has(Mark::HowMany) || self.has(Mark::Count);
        Some(Query::Kinds { of: self.with_rest(noun, &[]), count })
    }

    /// "Which key opens the lab?", «От какой двери ключ?», "What does Key 1 open?"
    pub(super) fn keys(&self) -> Option<Query> {
        // «Чем открыть лабораторию?»
        if let ([door], true, true) = (&self.nouns[..], self.has(Mark::Opens), self.with_what())
            && (self.is_area(&door.noun) || self.is_doors(&door.noun))
        {
            let anchors = vec![door.noun.clone()];
            let opens = Restriction { rel: Rel::Opens, anchors, negated: false };
            let head = Head { anything: true, ..Head::default() };
            let restrictions = vec![opens];
            let noun =
                Noun { head, plural: true, indefinite: true, restrictions, ..Noun::default() };
            return Some(Query::Find(noun));
        }
        // «Где ключ? – … – От чего он?»
        if let ([only], true) = (&self.nouns[..], self.has(Mark::Opens))
            && only.noun.head.things.as_ref().is_some_and(|things| things.len() == 1)
            && self.spots.is_empty()
            && self.sentence.language == Language::Russian
            && self.sentence.keys.iter().any(|key| key == "от")
        {
            let of = only.noun.clone();
            return Some(Query::Anchor { rel: Rel::Opens, of, what: None });
        }
        let key = self.nouns.iter().find(|s| self.is_key(&s.noun))?;
        let from = self.links.iter().any(|(rel, _)| matches!(rel, Rel::From | Rel::To));
        let open = self.lexicon.values.meaning("открытый");
        let opens = self.has(Mark::Opens)
            || from
            || self.values.iter().any(|(value, _, _)| Some(*value) == open);
        if !opens || !(self.asks() || self.has(Mark::Where) || self.has(Mark::Opens)) {
            return None;
        }
        let general = |noun: &Noun| noun.head.named.is_empty() && self.follows_which(key.at);
        let other = self.nouns.iter().find(|s| s.at != key.at && !self.follows_which(s.at));
        let other = other
            .map(|s| s.noun.clone())
            .or_else(|| self.spots.first().map(|spot| spot.nouns[0].clone()));
        match other {
            Some(door) => {
                let mut noun = key.noun.clone();
                noun.plural |= general(&noun);
                let anchors = vec![door];
                noun.restrictions.push(Restriction { rel: Rel::Opens, anchors, negated: false });
                Some(Query::Find(Noun { indefinite: true, ..noun }))
            }
            None => {
                let of = key.noun.clone();
                Some(Query::Anchor { rel: Rel::Opens, of, what: None })
            }
        }
    }

    /// «Мне надо поспать, что рядом с дверью?»: a need that is told, and a question of something else.
    pub(super) fn tells_need(&self) -> bool {
        let Some((told, asked)) = self.sentence.text.split_once(',') else { return false };
        let named = |noun: &Noun| asked.contains(&noun.text);
        let places = self.spots.iter().flat_map(|spot| &spot.nouns);
        let names_thing = self.nouns.iter().map(|s| &s.noun).chain(places).any(named);
        let (told, asked) = (word_keys(told), word_keys(asked));
        let marks = |words: &[String]| -> Vec<Mark> {
            let marks = (0..words.len()).filter_map(|at| vocabulary::longest(&words[at..]));
            marks.map(|(_, mark)| mark).collect()
        };
        let needs = |words: &[String]| -> Vec<Mark> {
            let is_need = |mark: &Mark| matches!(mark, Mark::Sit | Mark::LieDown);
            marks(words).into_iter().filter(is_need).collect()
        };
        let names = names_thing || marks(&asked).contains(&Mark::You);
        let (told_needs, asked_needs) = (needs(&told), needs(&asked));
        let asks_for_it = told_needs.iter().any(|need| asked_needs.contains(need));
        // "…, so what is on the table?"
        let asks = (0..asked.len().min(2)).any(|at| opening::begins_question(&asked[at..]));
        let of_me =
            told.first().is_some_and(opening::is_me) || told.iter().any(|key| is_first_person(key));
        names && of_me && !told_needs.is_empty() && !asks_for_it && asks
    }

    pub(super) fn use_of_place(&self) -> Option<Query> {
        let within = || -> Vec<Restriction> {
            self.spots
                .iter()
                .filter(|s| !self.is_building(&s.nouns[0]))
                .flat_map(Spot::restrictions)
                .chain(self.except.iter().filter(|noun| self.is_area(noun)).map(|noun| {
                    // «кроме кухни»
                    let anchors = vec![noun.clone()];
                    Restriction { rel: Rel::In, anchors, negated: true }
                }))
                .collect()
        };
        if self.has(Mark::Opens) && self.has(Mark::Can) && self.asks() {
            return self.openable();
        }
        // «Где можно посидеть и почитать?» asks for a seat.
        let rests = self.has(Mark::Where) && (self.has(Mark::Sit) || self.has(Mark::LieDown));
        if let Some(query) = self.activity().filter(|_| !rests) {
            return Some(query);
        }
        let asks = self.has(Mark::Where)
            || self.asks()
            || self.has(Mark::Can)
            || self.has(Mark::Whither)
            || self.has(Mark::Exists);
        let whether = !self.has(Mark::Where)
            && !self.has(Mark::Whither)
            && !self.asks()
            && self.links.is_empty();
        let use_for = match () {
            () if self.has(Mark::Sit) => Some(Use::Sit),
            () if self.has(Mark::LieDown) => Some(Use::Lie),
            () if self.has(Mark::PutDown)
                && (self.has(Mark::Where) || self.has(Mark::Whither) || self.has(Mark::Can)) =>
            {
                Some(Use::Put)
            }
            () => None,
        };
        // "Where is the closest place to sit?"
        let best =
            self.marks.iter().any(|(mark, _)| matches!(mark, Mark::Best(_) | Mark::BestTo(_)));
        let nearest = best || self.nouns.iter().any(|s| s.noun.best.is_some());
        if let (Some(Use::Sit), true) = (use_for, nearest) {
            let best = self.nouns.iter().find_map(|s| s.noun.best.clone());
            let head = Head::of_kind(self.lexicon, &Extension::Trait("seat"));
            let seat = Noun { head, best, indefinite: true, ..Noun::default() };
            return Some(Query::Find(self.with_rest(seat, &[])));
        }
        // «В каких комнатах можно сесть?»: the rooms that have seats.
        let wanted = match use_for {
            Some(Use::Sit) => Some("seat"),
            Some(Use::Lie) => Some("bed"),
            _ => None,
        };
        let kind = wanted.and_then(|wanted| self.lexicon.kind_of(&Extension::Trait(wanted)));
        if let Some(rooms) = self.rooms_asked().filter(|_| kind.is_some()) {
            let head = Head { kinds: kind.into_iter().collect(), ..Head::default() };
            return Some(self.rooms_having(&rooms, head));
        }
        if let (Some(use_for), true) = (use_for, asks && !nearest) {
            let (what, within) = (self.first(), within());
            // "Where does he sleep?" asks of him, and not of any place.
            let of_one = what.as_ref().is_some_and(|what| {
                what.head.things.as_deref().is_some_and(|things| things != [Thing::Robot])
            });
            // "I want to sit down, where is the book?" asks for the book.
            let of_another = what.as_ref().is_some_and(|what| {
                let head = &what.head;
                let is_any = head.kinds.is_empty() && head.named.is_empty();
                !(head.anything || is_any || self.is_things(what))
            });
            if (of_one || of_another) && use_for != Use::Put {
                return None;
            }
            return Some(Query::Place { use_for, what, within, whether });
        }
        if !self.has(Mark::Free) {
            return None;
        }
        if let Some(query) = self.which_free() {
            return Some(query);
        }
        // "Is there enough room on the desk for the vase?"
        static FITS: Set = Set::named("FitsOrFor");
        let named = FITS.iter().any(|word| self.sentence.keys.iter().any(|k| k == word));
        let what = self.spot_noun(&[Rel::To]).or_else(|| self.first()).filter(|_| named);
        let on = self.spots.iter().filter(|s| s.rel == Rel::On && !self.is_area(&s.nouns[0]));
        // "on the bedside table with the lamp"
        let with = |spot: &Spot| {
            let next = self.spots.iter().find(|s| s.at == spot.at + 1 && s.rel == Rel::Has);
            let room = self.spots.iter().find(|s| s.rel == Rel::In && self.is_area(&s.nouns[0]));
            let mut spot = spot.clone();
            for (noun, room) in spot.nouns.iter_mut().zip(room) {
                noun.restrictions.extend(room.restrictions());
            }
            for (noun, next) in spot.nouns.iter_mut().zip(next) {
                let bears = Spot { rel: Rel::Bears, ..next.clone() };
                noun.restrictions.extend(bears.restrictions());
            }
            spot.restrictions()
        };
        let within: Vec<Restriction> = on.flat_map(with).collect();
        let what = what.filter(|noun| !self.is_area(noun));
        if let (Some(what), false) = (&what, within.is_empty()) {
            let what = Some(what.clone());
            return Some(Query::Place { use_for: Use::Put, what, within, whether });
        }
        // «Где есть место для вазы?»
        let places = self.spots.iter().filter(|s| self.is_area(&s.nouns[0]));
        if self.spot(&[Rel::To]).is_some() && self.has(Mark::Where) && what.is_some() {
            let within = places.flat_map(Spot::restrictions).collect();
            return Some(Query::Place { use_for: Use::Put, what, within, whether });
        }
        let place = self.spots.first().map(|s| s.nouns[0].clone()).or_else(|| self.first())?;
        if self.is_area(&place) && self.spots.len() < 2 {
            // "free chairs in the kitchen", «свободно ли в комнате» are no questions about a top.
            let at = self.spots.first().map(|s| s.at);
            let noun = self.first()?;
            return self
                .has(Mark::HowMany)
                .then(|| Query::Free(self.with_rest(noun, &at.into_iter().collect::<Vec<_>>())));
        }
        let mut place = place;
        for spot in self.spots.iter().skip(1) {
            self.attach(&mut place, spot);
        }
        Some(Query::Free(place))
    }

    /// «Что можно открыть в спальне?», "Which doors can be opened?": doors.
    pub(super) fn openable(&self) -> Option<Query> {
        let opened = self.lexicon.values.meaning("открытый")?;
        let open = |value: &ValueId| self.lexicon.values.is(*value, opened);
        let doors = match &self.nouns[..] {
            [] => Noun { head: Head::of_kind(self.lexicon, &Extension::Doors), ..Noun::default() },
            [only] if self.is_doors(&only.noun) => only.noun.clone(),
            _ => return None,
        };
        let said = self.values.iter().all(|(value, _, _)| open(value)) && !self.has(Mark::Than);
        let mut noun = Noun { plural: true, indefinite: true, ..doors };
        for spot in &self.spots {
            self.attach(&mut noun, spot);
        }
        said.then_some(Query::Find(noun))
    }

    /// «Чем», "with", "use": what it is done with is asked for.
    fn with_what(&self) -> bool {
        static WITH: Set = Set::named("WithWhat");
        self.sentence.keys.iter().any(|key| WITH.contains(&key.as_str()))
    }

    /// «Какой стул свободен?», "Is any chair free?": which have nothing on them.
    fn which_free(&self) -> Option<Query> {
        let value = self.lexicon.values.meaning("пустой")?;
        let [only] = &self.nouns[..] else { return None };
        let noun = &only.noun;
        let kind = noun.head.named.is_empty() && !noun.head.kinds.is_empty();
        let which = self.has(Mark::Which) && self.follows_which(only.at);
        let asked = which
            || noun.plural
            || noun.indefinite
            || self.has(Mark::HowMany)
            || self.has(Mark::Exists);
        // «Есть свободный стул у стола?» speaks of the chair; a place on the table is another question.
        let beside = |s: &Spot| matches!(s.rel, Rel::NextTo | Rel::Near | Rel::At);
        let in_rooms = self.spots.iter().all(|s| self.is_area(&s.nouns[0]) || beside(s));
        let more = self.marks.iter().any(|(m, _)| matches!(m, Mark::More(_) | Mark::Best(_)));
        if more || !kind || !asked || !in_rooms || self.is_area(noun) {
            return None;
        }
        let mut noun = self.with_rest(noun.clone(), &[]);
        noun.filters.push(Filter::new(value, self.negated));
        noun.plural = true;
        noun.indefinite = true;
        Some(match () {
            () if self.has(Mark::HowMany) => Query::Count(noun),
            () if which => Query::Find(noun),
            () if self.asks() || self.has(Mark::List) => Query::Find(noun),
            () if self.has(Mark::Where) => Query::Where(noun),
            () => Query::Exists { what: vec![noun], either: false, denial: Denial::None },
        })
    }

    pub(super) fn history(&self) -> Option<Query> {
        let noun = || self.first().map(|n| self.with_rest(n, &[]));
        // «Когда переставили диван?», "Did anybody move the medicine?"
        let asked_move = self.has(Mark::Move)
            && self.spots.is_empty()
            && !self.has(Mark::How)
            && !self.has(Mark::Can)
            && !self.has(Mark::HowMany)
            && !self.nouns.is_empty()
            && self.nouns.iter().all(|s| !self.is_area(&s.noun) && !self.is_doors(&s.noun))
            && !self.asks()
            && !self.has(Mark::Where)
            && !self.has(Mark::Whither);
        if self.has(Mark::Moved) || asked_move {
            return noun().map(Query::Before);
        }
        // "When was it last used?" asks for no sighting.
        let timed = self.has(Mark::When) || self.has(Mark::Last);
        if self.has(Mark::LastSeen) || self.has(Mark::See) && timed {
            return noun().map(Query::LastSeen);
        }
        if self.has(Mark::Before) && (self.has(Mark::Where) || self.asks()) {
            return noun().map(Query::Before);
        }
        None
    }

    pub(super) fn made_of(&self) -> Option<Query> {
        let of = || {
            let noun = self.first().map(|n| (n, Vec::new()));
            let spot = self.spots.first();
            let (noun, without) =
                noun.or_else(|| spot.map(|s| (s.nouns[0].clone(), vec![s.at])))?;
            Some(self.with_rest(noun, &without))
        };
        if self.has(Mark::Parts) {
            return of().map(Query::Parts);
        }
        let made = self.has(Mark::MadeOf);
        if made
            && self.values.is_empty()
            && (self.asks()
                || self.has(Mark::How)
                || self.sentence.keys.iter().any(|key| key == "чего")
                || self.place_of(Mark::MadeOf) == Some(0)
                || !self.links.is_empty())
        {
            return of().map(|of| Query::Property { property: Property::Material, of });
        }
        None
    }

    pub(super) fn property(&self) -> Option<Query> {
        // «Чей это зонт?», "Whose umbrella is this?"
        if self.sentence.keys.iter().any(|key| set!("Whose").contains(&key.as_str()))
            && let Some(of) = self.first().filter(|noun| !self.is_area(noun))
        {
            return Some(Query::Property {
                property: Property::Owner,
                of: self.with_rest(of, &[]),
            });
        }
        let (property, at) = self.property.clone()?;
        // «Одного ли цвета стулья?» is for another rule.
        if self.has(Mark::Same) {
            return None;
        }
        if !self.values.is_empty() && !self.has(Mark::Or) {
            return None;
        }
        // "the colour of the chair nearest to the window"
        let of = self.spots.iter().find(|s| s.rel == Rel::Of && s.at == at + 1);
        let of = of.map(|s| (s.nouns[0].clone(), vec![s.at]));
        let noun = of.or_else(|| self.nouns.first().map(|s| (s.noun.clone(), Vec::new())));
        let owner = self.spot(&[Rel::NextTo, Rel::Of]).map(|s| (s.nouns[0].clone(), vec![s.at]));
        let spot = self.spots.iter().find(|s| s.at > at).map(|s| (s.nouns[0].clone(), vec![s.at]));
        let (noun, without) = noun.or(owner).or(spot)?;
        Some(Query::Property { property, of: self.with_rest(noun, &without) })
    }
}

fn is_robot(noun: &Noun) -> bool {
    noun.head.things.as_deref() == Some(&[Thing::Robot][..])
}

/// Whether a noun is the name of a thing.
fn is_replica(noun: &Noun) -> bool {
    let of_thing = |e: &Entity| matches!(e, Entity::Replica(_));
    !noun.head.named.is_empty() && noun.head.named.iter().all(of_thing)
}
