//! Whether a query has all that the sentence said: what a rule passed over makes the question not understood.
//!
//! Invariant: nothing that tells one answer from another is dropped in silence.

use super::Frame;
use crate::question::lexicon::{Extension, KindId};
use crate::question::mark::Mark;
use crate::question::purposes::{self, Role};
use crate::question::query::{Claim, Head, Noun, Query, Rel, Sized};
use crate::question::uses;
use crate::question::values::{Property, ValueId};

/// What the nouns and claims of a query speak of.
#[derive(Default)]
struct Used {
    heads: Vec<Head>,
    values: Vec<ValueId>,
    sizes: Vec<Sized>,
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
                Claim::Related(_) | Claim::Kind(_) => {}
            }
        }
        query.each_noun(&mut |noun| used.add(noun));
        used
    }

    fn add(&mut self, noun: &mut Noun) {
        self.heads.push(noun.head.clone());
        self.values.extend(noun.filters.iter().flat_map(|filter| filter.values()));
        self.sizes.extend(&noun.sizes);
        self.heads.extend(noun.also.iter().cloned());
        for except in &mut noun.except {
            except.each(&mut |noun| self.add(noun));
        }
    }

    fn has(&self, head: &Head) -> bool {
        self.heads.iter().any(|used| {
            used.named.iter().any(|entity| head.named.contains(entity))
                || used.kinds.iter().any(|kind| head.kinds.contains(kind))
        })
    }
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
            || noun.reached == Some(false)
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

    /// The words of the first description or value that a query does without.
    pub(super) fn left_out(&self, query: &mut Query) -> Option<String> {
        // "Where could three people sit?", "How many cups 3 are there?": no number is passed over.
        if self.idle {
            return Some(self.sentence.text.to_owned());
        }
        let whole = matches!(
            query,
            Query::Several(_)
                | Query::Why { .. }
                | Query::Noted { .. }
                | Query::Ran { .. }
                | Query::Help
                | Query::People { .. }
                | Query::Courtesy(_)
                | Query::WhereAreYou(_)
                | Query::WhereAmI
                | Query::WhatDoYouSee
                | Query::Deeds
                | Query::Changed
                | Query::Unseen
                | Query::Sureness
                | Query::WhatDoYouHold
        );
        if whole {
            return None;
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
        if self.deed_said().is_some() && matches!(query, Query::Find(noun) if rooms(noun)) {
            return Some(self.sentence.text.to_owned());
        }
        // «Каким ножом порезать хлеб?», «Чем порезать хлеб?»
        let role = match query {
            Query::Serving { sort, .. } => Some(purposes::role(*sort)),
            Query::Find(noun) if !noun.also.is_empty() => self.role_said(),
            _ => None,
        };
        let serving = role.is_some_and(|role| !matches!(role, Role::Patient | Role::Theme));
        if !serving && self.undone.is_some() {
            return self.undone.clone();
        }
        let mut idle = None;
        query.each_noun(&mut |noun| {
            idle = idle.take().or(noun.idle_count().map(|n| n.text.clone()))
        });
        if idle.is_some() {
            return idle;
        }
        let used = Used::of(query);
        // "On what do cats fry eggs?" is not asked of eggs alone.
        let own = |deed: u16| uses::sorts(deed).flat_map(|sort| self.lexicon.kinds_of_sort(sort));
        let done =
            |deed: u16| own(deed).any(|kind| used.heads.iter().any(|h| h.kinds.contains(&kind)));
        let served = matches!(query, Query::Serving { .. } | Query::Place { .. });
        if let Some((deed, _)) = self.deed_said()
            && !served
            && !done(deed)
        {
            return Some(self.sentence.text.to_owned());
        }
        // Where a door leads is told with all its rooms.
        let leads = matches!(query, Query::Leads(_));
        // «Чем порезать хлеб?»: what is cut limits nothing.
        let object = self.object_of_deed().filter(|_| serving).map(|s| s.at);
        let apart: Vec<usize> = self.beside_deed().filter(|_| serving).map(|s| s.at).collect();
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
        let opens = matches!(query, Query::Anchor { rel: Rel::Opens, .. }) || self.has(Mark::Can);
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
