//! Whether a query has all that the sentence said: what a rule passed over makes the question not understood.
//!
//! Invariant: nothing that tells one answer from another is dropped in silence.

use super::Frame;
use super::Spot;
use crate::question::lexicon::{Extension, KindId};
use crate::question::mark::Mark;
use crate::question::purposes::{self, Role};
use crate::question::query::{Claim, Dimension, Head, Noun, Query, Rel, Restriction, Sized};
use crate::question::uses;
use crate::question::values::{Property, ValueId};
use crate::words::Language;

/// What the nouns and claims of a query speak of.
#[derive(Default)]
struct Used {
    heads: Vec<Head>,
    values: Vec<ValueId>,
    sizes: Vec<Sized>,
    /// What is excepted, denied or gone round.
    excepted: Vec<Head>,
    /// Superlatives.
    bests: usize,
    /// How things lie to others.
    rels: Vec<Rel>,
}

impl Used {
    fn of(query: &mut Query) -> Self {
        let mut used = Self::default();
        let claims = match query {
            Query::Holds { claims, .. } | Query::Choice { claims, .. } => claims.clone(),
            _ => Vec::new(),
        };
        for claim in &claims {
            match claim {
                Claim::Value(filter) => used.values.extend(filter.values()),
                Claim::Size(size) => used.sizes.push(*size),
                Claim::Related(place) => {
                    used.deny(std::slice::from_ref(place));
                    used.rels.push(place.rel);
                }
                Claim::Kind(_) => {}
            }
        }
        query.each_noun(&mut |noun| used.add(noun));
        match query {
            Query::Passing { avoiding, .. } => {
                used.excepted.extend(avoiding.iter().map(|noun| noun.head.clone()));
            }
            Query::Place { within, .. } => {
                used.deny(within);
                used.rels.extend(within.iter().map(|place| place.rel));
            }
            Query::WhichMore { .. } | Query::WhichWay { .. } | Query::Size { .. } => {
                used.bests += 1;
            }
            _ => {}
        }
        used
    }

    fn deny(&mut self, places: &[Restriction]) {
        let denied = places.iter().filter(|place| place.negated).flat_map(|place| &place.anchors);
        self.excepted.extend(denied.map(|noun| noun.head.clone()));
    }

    fn add(&mut self, noun: &mut Noun) {
        self.heads.push(noun.head.clone());
        self.bests += usize::from(noun.best.is_some());
        let around = noun.reached.iter().flat_map(|reach| &reach.avoiding);
        self.excepted.extend(around.map(|noun| noun.head.clone()));
        self.excepted.extend(noun.except.iter().map(|except| except.head.clone()));
        self.deny(&noun.restrictions);
        self.rels.extend(noun.restrictions.iter().map(|place| place.rel));
        self.values.extend(noun.filters.iter().flat_map(|filter| filter.values()));
        self.sizes.extend(&noun.sizes);
        self.heads.extend(noun.also.iter().cloned());
        for except in &mut noun.except {
            except.each(&mut |noun| self.add(noun));
        }
    }

    fn has(&self, head: &Head) -> bool {
        self.heads.iter().any(|used| meet(used, head))
    }

    fn excepts(&self, head: &Head) -> bool {
        self.excepted.iter().any(|used| used == head || meet(used, head))
    }
}

/// Whether two heads mean the same name or kind.
fn meet(one: &Head, other: &Head) -> bool {
    one.named.iter().any(|entity| other.named.contains(entity))
        || one.kinds.iter().any(|kind| other.kinds.contains(kind))
}

/// «Какие вещи не рядом ни с чем?»: whether things are asked for of which nothing is denied.
fn lost_its_denial(query: &mut Query) -> bool {
    if !matches!(
        query,
        Query::Find(_)
            | Query::Count(_)
            | Query::Where(_)
            | Query::RoomOf(_)
            | Query::Serving { .. }
            | Query::Anchor { .. }
            | Query::Size { .. }
            | Query::Distance { .. }
    ) {
        return false;
    }
    let mut denies = false;
    query.each_noun(&mut |noun| {
        denies |= !noun.except.is_empty()
            || noun.other
            || noun.reached.as_ref().is_some_and(|reach| !reach.able)
            || noun.filters.iter().any(|filter| filter.negated)
            || noun.sizes.iter().any(|size| size.negated)
            || noun.restrictions.iter().any(|place| place.negated)
            || noun.head.kinds.is_empty() && noun.head.named.is_empty() && !noun.head.anything;
    });
    !denies
}

impl Frame<'_, '_> {
    /// A word for what is asked, or for the whole, that narrows nothing: «в какой комнате», "things", "in the house".
    fn asks_only(&self, noun: &Noun) -> bool {
        let general = |kind: &KindId| {
            matches!(
                self.lexicon.kind(*kind).extension,
                Extension::Rooms
                    | Extension::Storeys
                    | Extension::Things
                    | Extension::Doors
                    | Extension::Passages
                    | Extension::Exits
                    | Extension::OuterDoors
                    | Extension::Places
                    | Extension::Building
            )
        };
        // «проход» is a map's own sort of door as well.
        let any_door = |e: &Extension| matches!(e, Extension::Doors | Extension::Passages);
        let door = |kind: &KindId| {
            matches!(self.lexicon.kind(*kind).extension, Extension::DoorType(_))
                && self.is_kind(noun, any_door)
        };
        let narrowed = !noun.filters.is_empty() || !noun.restrictions.is_empty();
        let kinds = &noun.head.kinds;
        noun.head.named.is_empty() && !narrowed && kinds.iter().all(|k| general(k) || door(k))
    }

    /// How many superlatives are said, by themselves or of what is described.
    fn superlatives(&self) -> usize {
        let by_themselves = |mark: &Mark| matches!(mark, Mark::Best(_) | Mark::BestTo(_));
        let mut said = self.marks.iter().filter(|(mark, _)| by_themselves(mark)).count();
        let nouns = self.nouns.iter().map(|s| &s.noun);
        for noun in nouns.chain(self.spots.iter().flat_map(|s| &s.nouns)) {
            noun.clone().each(&mut |noun| said += usize::from(noun.best.is_some()));
        }
        said
    }

    /// Whether nothing is named that a query of the robot alone, or of the last answer, could leave aside.
    fn names_nothing(&self) -> bool {
        let small = |noun: &Noun| noun.head.things.is_some() || self.asks_only(noun);
        let nouns = self.nouns.iter().map(|s| &s.noun);
        let mut all = nouns.chain(self.spots.iter().flat_map(|s| &s.nouns));
        self.values.is_empty() && self.excepted.is_empty() && all.all(small)
    }

    /// Whether a comparison, a way or a list of parts is asked for with a denial that none of them takes up. "Isn't the sofa
    /// bigger?" asks as without it.
    fn denies_in_vain(&self, query: &Query, used: &Used) -> bool {
        let takes_none = matches!(
            query,
            Query::MoreOf { .. }
                | Query::Larger { .. }
                | Query::Closer { .. }
                | Query::WhichMore { .. }
                | Query::WhichWay { .. }
                | Query::Choice { .. }
                | Query::Same { .. }
                | Query::SameAll { .. }
                | Query::Way { .. }
                | Query::Passing { .. }
                | Query::Duration { .. }
                | Query::Parts(_)
                | Query::Leads(_)
                | Query::Kinds { .. }
                | Query::Place { .. }
                | Query::Free(_)
                | Query::Describe(_)
                | Query::Before(_)
        );
        let led = |(mark, at): &(Mark, usize)| *mark == Mark::Not && *at == 1;
        let by_the_way = self.sentence.language == Language::English && self.marks.iter().any(led);
        takes_none && self.negated && used.excepted.is_empty() && !by_the_way
    }

    /// The words of the first description or value that a query does without.
    pub(super) fn left_out(&self, query: &mut Query) -> Option<String> {
        // "Where could three people sit?", "How many cups 3 are there?": no number is passed over.
        if self.idle {
            return Some(self.sentence.text.to_owned());
        }
        match query {
            Query::Why { about: Some(about), .. } => return self.unused(about),
            Query::Why { .. }
            | Query::WhereAreYou(_)
            | Query::WhereAmI
            | Query::WhatDoYouSee
            | Query::Done
            | Query::Changed
            | Query::Unseen
            | Query::Sureness
            | Query::WhatDoYouHold => {
                let about_itself = matches!(query, Query::WhereAreYou(_) | Query::WhatDoYouHold);
                let denied = self.negated && about_itself;
                let done = about_itself && self.activity_said().is_some();
                return (denied || done || !self.names_nothing())
                    .then(|| self.sentence.text.to_owned());
            }
            Query::Several(_)
            | Query::Noted { .. }
            | Query::Ran { .. }
            | Query::Help
            | Query::People { .. }
            | Query::Courtesy(_) => return None,
            _ => {}
        }
        // "When did you last clean the bathroom?": what is done and what is so look alike.
        if matches!(query, Query::LastSeen(_) | Query::Before(_)) && !self.values.is_empty() {
            return Some(self.sentence.text.to_owned());
        }
        // "How high is the lamp above the table?" asks how far above it, not how high that one is.
        let above = |of: &Noun| of.restrictions.iter().any(|r| r.rel == Rel::Above);
        if matches!(query, Query::Size { dimension: Dimension::Height, of } if above(of)) {
            return Some(self.sentence.text.to_owned());
        }
        // «Какого цвета не бывает стульев?»
        if self.negated && matches!(query, Query::Property { .. } | Query::Size { .. }) {
            return Some(self.sentence.text.to_owned());
        }
        if self.negated && lost_its_denial(query) {
            return Some(self.sentence.text.to_owned());
        }
        // "Which room would you go to to cook?": no room is told by what is done there.
        let rooms = |noun: &Noun| self.is_area(noun) && self.asks_only(noun);
        if self.activity_said().is_some() && matches!(query, Query::Find(noun) if rooms(noun)) {
            return Some(self.sentence.text.to_owned());
        }
        if !self.serves(query) && self.undone.is_some() {
            return self.undone.clone();
        }
        let mut idle = None;
        query.each_noun(&mut |noun| {
            idle = idle.take().or(noun.idle_count().map(|n| n.text.clone()))
        });
        if idle.is_some() {
            return idle;
        }
        self.unused(query)
    }

    /// «Каким ножом порезать хлеб?», «Чем порезать хлеб?»: whether what something is done with is asked for.
    fn serves(&self, query: &Query) -> bool {
        let role = match query {
            Query::Serving { sort, .. } => Some(purposes::role(*sort)),
            Query::Find(noun) if !noun.also.is_empty() => self.role_said(),
            _ => None,
        };
        role.is_some_and(|role| !matches!(role, Role::Patient | Role::Theme))
    }

    /// A side of something that is told of nothing: "What colour is outside the armchair?"
    fn idle_side(&self, query: &Query, used: &Used) -> Option<&Noun> {
        let described = matches!(
            query,
            Query::Property { .. }
                | Query::Size { .. }
                | Query::Describe(_)
                | Query::Parts(_)
                | Query::Same { .. }
                | Query::SameAll { .. }
                | Query::Where(_)
                | Query::RoomOf(_)
                | Query::Find(_)
                | Query::Count(_)
                | Query::Exists { .. }
                | Query::LastSeen(_)
                | Query::Free(_)
        );
        let side = |rel: Rel| {
            matches!(rel, Rel::Outside | Rel::Behind | Rel::InFrontOf | Rel::Under | Rel::Above)
        };
        let idle = |spot: &&Spot| side(spot.rel) && !used.rels.contains(&spot.rel);
        let idle = self.spots.iter().filter(|_| described).find(idle);
        idle.and_then(|spot| spot.nouns.first())
    }

    /// The words of the first description, value, exception, denial or superlative that is in no part of a query.
    fn unused(&self, query: &mut Query) -> Option<String> {
        let used = Used::of(query);
        // «Почему нельзя проехать в лабораторию?»: the denial is of what is asked why.
        let why = self.has(Mark::Why) || self.has(Mark::WhyNot);
        if let Some(except) = self.excepted.iter().find(|except| !used.excepts(&except.head)) {
            return Some(match except.text.is_empty() {
                true => self.sentence.text.to_owned(),
                false => except.text.clone(),
            });
        }
        if self.superlatives() > used.bests || !why && self.denies_in_vain(query, &used) {
            return Some(self.sentence.text.to_owned());
        }
        // Whether something is so is denied as a whole.
        let whole = why || matches!(query, Query::Holds { .. } | Query::Exists { .. });
        let denied = self.spots.iter().filter(|spot| spot.negated && !whole);
        let mut denied = denied.flat_map(|spot| &spot.nouns);
        if let Some(noun) = denied.find(|noun| !used.excepts(&noun.head)) {
            return Some(noun.text.clone());
        }
        if let Some(noun) = self.idle_side(query, &used) {
            return Some(noun.text.clone());
        }
        // "On what do cats fry eggs?" is not asked of eggs alone.
        let own =
            |activity: u16| uses::sorts(activity).flat_map(|sort| self.lexicon.kinds_of_sort(sort));
        let done = |activity: u16| {
            own(activity).any(|kind| used.heads.iter().any(|h| h.kinds.contains(&kind)))
        };
        let served = matches!(query, Query::Serving { .. } | Query::Place { .. });
        if let Some((activity, _)) = self.activity_said()
            && !served
            && !done(activity)
        {
            return Some(self.sentence.text.to_owned());
        }
        let serving = self.serves(query);
        // Where a door leads is told with all its rooms.
        let leads = matches!(query, Query::Leads(_));
        // «Чем порезать хлеб?»: what is cut limits nothing.
        let object = self.object_of_activity().filter(|_| serving).map(|s| s.at);
        let apart: Vec<usize> = self.beside_activity().filter(|_| serving).map(|s| s.at).collect();
        let nouns = self.nouns.iter().filter(|s| Some(s.at) != object).map(|s| &s.noun);
        let places = self.spots.iter().filter(|s| !apart.contains(&s.at)).flat_map(|s| &s.nouns);
        let tells = |noun: &&Noun| {
            let general = noun.head.anything || noun.head.things.is_some();
            !(general || self.asks_only(noun) || (leads && self.is_area(noun)))
        };
        let mut said = nouns.chain(places).chain(&self.except).filter(tells);
        if let Some(noun) = said.find(|noun| !used.has(&noun.head)) {
            return Some(noun.text.clone());
        }
        // "What does Key 1 open?", "What can be opened?": what is done, not what is so.
        let openable = matches!(query, Query::Find(noun) if self.is_doors(noun));
        let opens = matches!(query, Query::Anchor { rel: Rel::Opens, .. })
            || self.has(Mark::Can) && openable;
        let done =
            |value: ValueId| opens && self.lexicon.values.entry(value).property == Property::State;
        let value =
            self.values.iter().find(|(value, _, _)| !used.values.contains(value) && !done(*value));
        let text = value.map(|(value, _, _)| self.lexicon.values.entry(*value).russian.clone());
        text.or_else(|| {
            let lost = self.sizes.iter().any(|size| !used.sizes.contains(size));
            lost.then(|| self.sentence.text.to_owned())
        })
    }
}
