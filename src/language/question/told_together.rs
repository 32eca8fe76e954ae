//! Several things that were told: which of them "they", "the others" or a question word without its noun means.
//!
//! Invariant: of one thing there are no others; what was told of no one kind is not taken for one.

use std::collections::HashSet;

use super::grammar::{Item, are_shown};
use super::knowledge::Knowledge;
use super::lexicon::{Extension, KindId};
use super::mark::{Mark, Pronoun};
use super::memory::{Exchange, is_of_whereabouts};
use super::of_those::{asks_of_one, chooses};
use super::query::{Claim, Extreme, Head, Noun, Query, Rel, Restriction, Thing};
use super::{Asker, Memory, vocabulary};
use crate::command::{self, Sort};
use crate::map::Entity;
use crate::sets::{Set, set};
use crate::words::{Language, Number, word_keys, word_ranges};

/// Numbers that may stand for a storey, each with its noun.
static RANKS: Set = Set::named("RankOfStorey");

/// What a question word without its noun asks among.
pub(super) struct Elided {
    /// As it was asked for.
    pub(super) all: Head,
    /// Those that were told, where several of one kind were.
    pub(super) told: Option<Head>,
}

impl Elided {
    /// "Which are not on the bed?": of those that were told, as what is denied leads to no others.
    pub(super) fn head_of(self, noun: &Noun) -> Head {
        match self.told.filter(|_| noun.denies()) {
            Some(told) => told,
            None => self.all,
        }
    }
}

impl Asker<'_> {
    /// «Сколько этажей? – Первый и Второй. – Что на втором?», «Сколько столов на первом этаже? А на втором?»: a number without
    /// its noun, after storeys that were told or a storey that was asked of.
    pub(super) fn with_storey(&self, text: &str, memory: &Memory) -> Option<String> {
        let told = |e: &Exchange| e.members().len() > 1 && e.members().iter().all(Thing::is_storey);
        let asked = || self.asked_of_storey(memory) && goes_on_alone(text);
        if !memory.exchanges.iter().any(told) && !asked() {
            return None;
        }
        let (words, keys) = (word_ranges(text), word_keys(text));
        let at = (1..keys.len()).find(|&n| {
            let ranks = matches!(vocabulary::longest(&keys[n..]), Some((1, Mark::Rank(_))));
            let placed = set!("OnOrThe").contains(&keys[n - 1].as_str());
            let ends = keys.get(n + 1).is_none_or(|next| next == "one" && n + 2 == keys.len());
            ranks && placed && ends
        })?;
        let end = words.last()?.end;
        let noun = Language::of(text).pick("этаже", "floor");
        Some(format!("{} {noun}{}", &text[..words[at].end], &text[end..]))
    }

    /// «Поезжай к лифту на втором»: where one goes, that is a storey, if the map has several.
    pub(super) fn on_storey(&self, text: String) -> String {
        let (words, keys) = (word_ranges(&text), word_keys(&text));
        let goes = matches!(command::clauses(&text)[..], [(_, Sort::Go)]);
        let [.., on, rank] = &keys[..] else { return text };
        let storey = RANKS.meant().iter().find(|(said, _)| said == rank).map(|(_, noun)| noun);
        let placed = goes && set!("OnOrThe").contains(&on.as_str());
        let Some(noun) = storey.filter(|_| placed && self.world.maps.len() > 1) else {
            return text;
        };
        let end = words[words.len() - 1].end;
        format!("{} {noun}{}", &text[..end], &text[end..])
    }

    /// Whether the last question asked of what is on a storey, and told no several things that may be counted themselves.
    fn asked_of_storey(&self, memory: &Memory) -> bool {
        let knowledge = self.knowledge(memory.language, memory);
        let bears = |thing: &Thing| knowledge.may_be_anchor(Rel::On, *thing);
        if memory.last.len() > 1 && memory.last.iter().any(bears) {
            return false;
        }
        let Some(sought) = memory.query.as_ref().and_then(Query::sought) else { return false };
        let is_storey = |anchor: &Noun| {
            let found = knowledge.find(anchor, true).unwrap_or_default();
            matches!(&found[..], [only] if only.is_storey())
        };
        sought.restrictions.iter().flat_map(|place| &place.anchors).any(is_storey)
    }
}

/// «А на втором?», "And on the second?": a place and no more.
fn goes_on_alone(text: &str) -> bool {
    let keys = word_keys(text);
    let first = keys.first().is_some_and(|key| set!("AndWord").contains(&key.as_str()));
    first && keys.get(1).is_some_and(|key| key == "на" || key == "on")
}

impl Knowledge<'_> {
    /// Those of some things that an answer has told one after the other, in its order.
    pub(super) fn of_listed(&self, things: &[Thing]) -> Vec<Thing> {
        let told = self.memory.listed.iter().copied();
        told.filter(|t| things.contains(t)).collect()
    }

    /// "How many of them are eggs?": of several that were told, those of a kind.
    pub(super) fn of_those_told(&self, noun: &mut Noun) {
        let told = |r: &Restriction| match &r.anchors[..] {
            [anchor] if matches!(r.rel, Rel::Of | Rel::From) && !r.negated => {
                anchor.head.things.clone().filter(|things| things.len() > 1)
            }
            _ => None,
        };
        if noun.head.kinds.is_empty() {
            return;
        }
        let Some((at, things)) =
            noun.restrictions.iter().enumerate().find_map(|(n, r)| Some((n, told(r)?)))
        else {
            return;
        };
        let all: HashSet<Thing> = self.base(&noun.head).into_iter().collect();
        let those = things.into_iter().filter(|t| all.contains(t)).collect();
        noun.restrictions.remove(at);
        noun.head = Head { things: Some(those), ..Head::default() };
    }

    /// "What else is there? – A vase and a box. – Is the box among them?": whether there is one among those that were told.
    pub(super) fn is_among_those(&self, query: &mut Query) {
        let Query::Holds { subject, claims, denial } = query else { return };
        let [Claim::Related(place)] = &claims[..] else { return };
        let [anchor] = &place.anchors[..] else { return };
        let told = anchor.head.things.as_ref().filter(|things| things.len() > 1);
        let are_things = told.is_some_and(|things| things.iter().all(|t| t.replica().is_some()));
        if are_things && matches!(place.rel, Rel::Of | Rel::From) && !place.negated {
            let mut sought = subject.clone();
            sought.restrictions.push(place.clone());
            *query = Query::Exists { what: vec![sought], either: false, denial: *denial };
        }
    }

    /// "Are these books red?": those of the latest that were told together, else one by one.
    pub(super) fn of_those_shown(&self, noun: &mut Noun) {
        // After what was sought in vain, "these" are none.
        if !are_shown(noun) || noun.head.things.is_some() || self.found_nothing() {
            return;
        }
        let all: HashSet<Thing> = self.base(&noun.head).into_iter().collect();
        let fitting = |told: &[Thing]| -> Vec<Thing> {
            told.iter().copied().filter(|t| all.contains(t)).collect()
        };
        let memory = self.memory;
        // The last answer may have told one of a list; it may have told one by itself.
        let last = self.list_with(&memory.last).unwrap_or_else(|| memory.last.clone());
        let lists = memory.exchanges.iter().map(Exchange::members).chain([&memory.listed[..]]);
        let mut lists = std::iter::once(&last[..]).chain(lists).map(fitting);
        let together = lists.find(|those| !those.is_empty());
        let one_by_one = || {
            let mut spoken: Vec<Thing> = Vec::new();
            for thing in memory.exchanges.iter().flat_map(Exchange::things) {
                if all.contains(thing) && !spoken.contains(thing) {
                    spoken.push(*thing);
                }
            }
            spoken
        };
        let those = together.unwrap_or_else(one_by_one);
        // Of one there are no others.
        if those.len() > 1 || those.len() == 1 && noun.best.is_none() {
            noun.head = Head { things: Some(those), ..Head::default() };
        }
    }

    /// "The other one", «остальные»: what was told together with those that were told last, else the others of the
    /// kind of what was spoken of.
    pub(super) fn complement(&self) -> Option<Vec<Thing>> {
        // "What is the lamp on? – Table 1. – And the other one?": the other lamp.
        let subject = match &self.memory.query {
            Some(Query::Anchor { of, .. } | Query::RoomOf(of)) => self.find(of, true).ok(),
            _ => None,
        };
        let subject = subject.filter(|found| found.len() == 1);
        let told = subject.as_ref().unwrap_or(&self.memory.last);
        // "How far is the cup from the kettle? … And the other one?"
        let compared = |exchange: &Exchange| {
            let all = exchange.compared();
            let holds = !told.is_empty() && told.iter().all(|t| all.contains(t));
            (holds && all.len() > told.len())
                .then(|| all.iter().copied().filter(|t| !told.contains(t)).collect())
        };
        let exchanges = &self.memory.exchanges;
        // "Which of them is higher? What is it standing on? And the other one?"
        let of_topic = || {
            let topic = exchanges.first().and_then(Exchange::topic)?;
            let all = exchanges.iter().map(Exchange::compared).find(|all| all.contains(&topic))?;
            Some(all.iter().copied().filter(|t| *t != topic).collect::<Vec<_>>())
        };
        if let Some(rest) = self
            .rest_of_list(told)
            .or_else(|| exchanges.iter().find_map(compared))
            .or_else(of_topic)
        {
            return Some(rest);
        }
        let others = |thing: &Thing| {
            let rest = self.all_like(*thing).into_iter().filter(|t| t != thing);
            Some(rest.collect::<Vec<Thing>>()).filter(|rest| !rest.is_empty())
        };
        // "Where is the television? – On Cabinet 2. – And the other one?": no cabinet, where there is one television.
        if let [only] = told[..] {
            // "What is next to the tap? – A glass. – Where is the other one?": the other tap, or the other glass.
            let beside = self.asked_beside() && subject.is_none();
            let by = self.memory.exchanges.first().filter(|_| beside);
            let by = by.into_iter().flat_map(Exchange::topics).filter(|t| **t != only);
            let by: Vec<Thing> = by.filter_map(others).flatten().collect();
            let own = others(&only).unwrap_or_default();
            let rest: Vec<Thing> = own.into_iter().chain(by).collect();
            return (!rest.is_empty()).then_some(rest);
        }
        let topics = self.memory.exchanges.first()?.topics();
        if let Some(rest) = topics.iter().find_map(others) {
            return Some(rest);
        }
        // Of several that were told at once none is "the other".
        match told.len() {
            0 | 1 => self.memory.spoken.iter().find_map(others),
            _ => self.alike(told).map(|_| told.clone()),
        }
    }

    /// What was told before together with these, and is of one kind: "the second one" of a laptop and a book is none of what
    /// lay with it.
    pub(super) fn rest_of_list(&self, told: &[Thing]) -> Option<Vec<Thing>> {
        self.memory.exchanges.iter().skip(1).map(Exchange::members).find_map(|all| {
            let holds = !told.is_empty() && told.iter().all(|t| all.contains(t));
            (holds && all.len() > told.len() && self.alike(all).is_some())
                .then(|| all.iter().copied().filter(|t| !told.contains(t)).collect())
        })
    }

    /// "And on the other one?": of what was spoken of, the others of the kind of what may bear or hold something.
    fn other_bearing(&self, rel: Rel) -> Option<Vec<Thing>> {
        if !matches!(rel, Rel::On | Rel::In) {
            return None;
        }
        let exchange = self.memory.exchanges.first()?;
        let otherwise = self.places_otherwise(rel);
        let fits = |thing: &&Thing| self.may_be_anchor(rel, **thing) && !otherwise.contains(*thing);
        let meant = exchange.things().find(fits).copied()?;
        self.kind_of(meant)?;
        let rest: Vec<Thing> =
            self.all_like(meant).into_iter().filter(|thing| *thing != meant).collect();
        (!rest.is_empty()).then_some(rest)
    }

    /// The places of the last question that something lay to otherwise: "How many pillows are on the bed there? And in the
    /// other one?" asks of no bed.
    fn places_otherwise(&self, rel: Rel) -> HashSet<Thing> {
        let mut places = HashSet::new();
        if let Some(mut query) = self.memory.query.clone() {
            query.each_noun(&mut |noun| {
                let is_other = |place: &&Restriction| {
                    place.rel != rel && matches!(place.rel, Rel::On | Rel::In)
                };
                let told = noun.restrictions.iter().filter(is_other);
                let things = told.flat_map(|place| &place.anchors);
                places.extend(things.filter_map(|a| a.head.things.clone()).flatten());
            });
        }
        places
    }

    /// The other one, where something is on it or in it: what else was told together and may be so, or nothing.
    pub(super) fn other_place(&self, rel: Rel) -> Vec<Thing> {
        let otherwise = self.places_otherwise(rel);
        let unlike = |thing: &Thing| {
            let kind = self.kind_of(*thing);
            kind.is_none() || otherwise.iter().all(|other| self.kind_of(*other) != kind)
        };
        let told = || self.complement().filter(|rest| rest.iter().all(unlike));
        self.other_bearing(rel).or_else(told).unwrap_or_default()
    }

    /// What a question word without a noun asks among: those that were told, else what was asked for.
    pub(super) fn elided(&self) -> Option<Elided> {
        let last = &self.memory.last;
        // «Это Часы-1, Часы-2 или Часы-3?» – «Сколько в спальне?»
        if let Some(pending) = &self.memory.pending {
            let things = pending.candidates.clone();
            // "Which room is the biggest? How many windows has it? – A or B? – And which is the smallest?": of all, or of
            // those two, nothing says.
            let asked = self.memory.query.as_ref().and_then(Query::sought);
            let of_all = |noun: &Noun| noun.best.is_some() && noun.head.things.is_none();
            if asked.is_some_and(of_all) {
                return None;
            }
            self.alike(&things)?;
            let head = Head { things: Some(things), ..Head::default() };
            return Some(Elided { all: head.clone(), told: Some(head) });
        }
        let query = self.memory.query.as_ref()?;
        let counted = |noun: &Noun| match &noun.best {
            Some(best) if matches!(best.extreme, Extreme::Most | Extreme::Fewest) => {
                best.anchor.as_deref().cloned()
            }
            _ => Some(noun.clone()),
        };
        let sought = query.sought().and_then(counted).map(|noun| noun.head);
        let sought = sought.filter(|head| !head.kinds.is_empty());
        let things = last.iter().all(|t| t.replica().is_some());
        let told = (last.len() > 1 && things && self.alike(last).is_some())
            .then(|| Head { things: Some(last.clone()), ..Head::default() });
        // "Is the kitchen bigger than the hall? Which is the smallest of all?"
        let rooms = || {
            let (mut all, mut any) = (true, false);
            query.clone().each_noun(&mut |noun| {
                any = true;
                all &= self.base(&noun.head).iter().all(|t| t.area().is_some());
            });
            let kind = self.lexicon().kind_of(&Extension::Rooms).filter(|_| all && any)?;
            Some(Head { kinds: vec![kind], ..Head::default() })
        };
        let all = sought.or_else(|| told.clone()).or_else(rooms)?;
        Some(Elided { all, told })
    }

    /// All things of the kind of one, which is one of them.
    pub(super) fn all_like(&self, thing: Thing) -> Vec<Thing> {
        match (self.kind_of(thing), thing) {
            (Some(kind), _) => self.members(&self.lexicon().kind(kind).extension),
            (None, Thing::Entity(Entity::Door(_))) => self.members(&Extension::Doors),
            (None, _)
                if let chargers @ [_, ..] = &self.members(&Extension::Chargers)[..]
                    && chargers.contains(&thing) =>
            {
                chargers.to_vec()
            }
            (None, _) => vec![thing],
        }
    }

    /// The one kind of some things.
    pub(super) fn alike(&self, things: &[Thing]) -> Option<KindId> {
        let kind = self.kind_of(*things.first()?)?;
        things.iter().all(|t| self.kind_of(*t) == Some(kind)).then_some(kind)
    }

    pub(super) fn kind_of(&self, thing: Thing) -> Option<KindId> {
        let replica = self.world.replicas.get(&thing.replica()?)?;
        let object = self.world.objects.get(&replica.object)?;
        self.lexicon().kind_of(&Extension::ObjectType(object.object_type?))
    }

    /// "Are there phones in the bedroom?" – "No." – "Where are they?": what was looked for in vain, wherever it is; none of
    /// several is "it".
    pub(super) fn sought_in_vain(&self, pronoun: Pronoun) -> Option<Vec<Thing>> {
        let sought =
            self.memory.query.as_ref()?.sought().filter(|_| self.memory.last.is_empty())?;
        let named = !sought.head.anything && !sought.restrictions.is_empty();
        let anywhere = Noun { restrictions: Vec::new(), ..sought.clone() };
        let found = self.find(&anywhere, true).ok().filter(|_| named)?;
        if pronoun != Pronoun::They && found.len() > 1 {
            return None;
        }
        found.iter().all(|t| self.agrees(pronoun, *t)).then_some(found).filter(|f| !f.is_empty())
    }

    /// «Где бита? А ракетка? Они на одной кровати?»: the things of the last two exchanges, one each.
    pub(super) fn last_pair(&self) -> Option<Vec<Thing>> {
        let [later, earlier, ..] = &self.memory.exchanges[..] else { return None };
        let one = |e: &Exchange| e.topic().filter(|_| e.members().is_empty());
        let pair = [one(earlier)?, one(later)?];
        let chargers = self.members(&Extension::Chargers);
        let is_thing = |t: &Thing| t.replica().is_some() || chargers.contains(t);
        let singular = |t: &Thing| is_thing(t) && self.gender(*t).1 == Number::Singular;
        (pair[0] != pair[1] && pair.iter().all(singular)).then(|| pair.to_vec())
    }

    /// "What is between the sofa and the TV? – Nothing. – How far apart are they?": the two.
    pub(super) fn ends_spoken_of(&self) -> Option<Vec<Thing>> {
        let noun = self.memory.query.as_ref()?.sought().filter(|_| self.memory.last.is_empty())?;
        let between = noun.restrictions.iter().find(|place| place.rel == Rel::Between)?;
        self.ends_between(between).ok().filter(|ends| ends.len() > 1)
    }

    /// "What's in the lab? And in the office? Which of the two is bigger?": the rooms or storeys of the last two exchanges.
    pub(super) fn last_places(&self) -> Option<Vec<Thing>> {
        let [later, earlier, ..] = &self.memory.exchanges[..] else { return None };
        let place = |e: &Exchange| {
            e.topic().filter(|t| matches!(t, Thing::Entity(Entity::Area(_) | Entity::Map(_))))
        };
        let pair = vec![place(earlier)?, place(later)?];
        (pair[0] != pair[1]).then_some(pair)
    }

    /// All that the last exchanges measured: "Is A bigger than B? And C? Which of the three is the smallest?"
    pub(super) fn measured_before(&self) -> Vec<Thing> {
        let mut all = Vec::new();
        for thing in self.memory.exchanges.iter().flat_map(Exchange::compared) {
            if !all.contains(thing) {
                all.push(*thing);
            }
        }
        all
    }

    /// The latest list of things of which some are, and others.
    pub(super) fn list_with(&self, some: &[Thing]) -> Option<Vec<Thing>> {
        let has = |list: &&[Thing]| {
            !self.memory.is_whole
                && list.len() > some.len()
                && !some.is_empty()
                && some.iter().all(|t| list.contains(t))
        };
        let lists = self.memory.exchanges.iter().map(Exchange::members);
        // The list may have been told longer ago than what else is spoken of.
        lists.chain([&self.memory.listed[..]]).find(has).map(<[Thing]>::to_vec)
    }

    /// The list of which "them" speaks in a question of some of them, where the last answer told fewer.
    pub(super) fn list_asked_of(&self, items: &[Item]) -> Option<Vec<Thing>> {
        let of_one = asks_of_one(items);
        let asked = self.asked_whether_one().filter(|_| of_one);
        // "How many of them are on the table? Which of them is nearest?": of one thing there are no others.
        let some = self.memory.last.len() == 1 && (of_one || chooses(items));
        asked.or_else(|| self.list_with(&self.memory.last).filter(|_| some))
    }

    /// "Is one of them in the bedroom? – Yes, two. – Is one of them in the hall?": of all of which it was asked.
    fn asked_whether_one(&self) -> Option<Vec<Thing>> {
        let Query::Exists { what, .. } = self.memory.query.as_ref()? else { return None };
        let [noun] = &what[..] else { return None };
        let list = noun.head.things.as_ref().filter(|list| list.len() > 1)?;
        self.memory.last.iter().all(|thing| list.contains(thing)).then(|| list.clone())
    }

    /// Of the lists that were told, the latest of which a description fits any.
    pub(super) fn list_fitting(&self, noun: &Noun) -> Option<Vec<Thing>> {
        self.memory
            .exchanges
            .iter()
            .map(Exchange::members)
            .find(|listed| {
                let head = Head { things: Some(listed.to_vec()), ..Head::default() };
                let told = Noun { head, ..noun.clone() };
                listed.len() > 1 && self.find(&told, true).is_ok_and(|found| !found.is_empty())
            })
            .map(<[Thing]>::to_vec)
    }

    /// What "them" means: the things of the last answer, else what was spoken of before, that may stand in the relation.
    pub(super) fn several_meant(&self, rel: Option<Rel>) -> Vec<Thing> {
        let last = &self.memory.last;
        // "What are they next to? – Table 1 and Table 2. – Which of them is nearer?": they, or the tables.
        let those = match &self.memory.query {
            Some(Query::Anchor { of, .. } | Query::RoomOf(of)) => Some(of),
            Some(Query::Find(noun)) => {
                let has = noun.restrictions.iter().find(|r| matches!(r.rel, Rel::Has | Rel::Bears));
                has.and_then(|has| has.anchors.first())
            }
            _ => None,
        };
        let those = those.and_then(|those| those.head.things.as_ref());
        let tells_of = |those: &Vec<Thing>| last.iter().all(|thing| those.contains(thing));
        if those.is_some_and(|those| those.len() > 1 && !tells_of(those)) {
            return Vec::new();
        }
        let fit = |things: &[Thing]| {
            things.len() > 1
                && rel.is_none_or(|rel| things.iter().all(|t| self.may_be_anchor(rel, *t)))
        };
        let topics = self.memory.exchanges.iter();
        let topics = topics.flat_map(|e| [e.topics(), e.members(), e.compared()]);
        let mut told = std::iter::once(&last[..]).chain(topics);
        // All things are outside of what has no inside, which nobody asks.
        let otherwise = if rel == Some(Rel::Outside) { &[][..] } else { last };
        told.find(|things| fit(things)).unwrap_or(otherwise).to_vec()
    }

    /// The things of which it was asked where they are, where several places were told.
    pub(super) fn asked_whereabouts(&self) -> Option<&[Thing]> {
        let query = self.memory.query.as_ref().filter(|query| is_of_whereabouts(query));
        let things = query.and(self.memory.exchanges.first())?.members();
        (things.len() > 1 && things != self.memory.last).then_some(things)
    }

    /// What the rooms have that were told last.
    pub(super) fn had_by_rooms(&self) -> Option<Vec<Thing>> {
        let Some(Query::Find(noun)) = &self.memory.query else { return None };
        let counted = noun.best.as_ref().and_then(|best| best.anchor.as_deref());
        let counted = counted.filter(|_| self.memory.last.iter().all(|t| t.area().is_some()));
        let has = || noun.restrictions.iter().find(|r| r.rel == Rel::Has)?.anchors.first();
        self.find(counted.or_else(has)?, true).ok().filter(|found| !found.is_empty())
    }
}
