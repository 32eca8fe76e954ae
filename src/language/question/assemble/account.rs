//! Which words a sort of query answers: a word that asks something else than what was read makes the reading invalid.
//!
//! Invariant: the table is by the words' parts in a question, never by sentences. What it does not let through is said
//! not to be understood, however well the rest of the sentence was read.

use super::taken_up::{Told, answers};
use super::{Frame, Subject};
use crate::question::grammar::points;
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::query::{Claim, Extreme, Noun, Quantity, Query, Rel, Restriction, Thing};
use crate::question::values::Property;
use crate::sets::{Set, set};
use crate::words::Language;

impl Frame<'_, '_> {
    /// Whether a word of the sentence asks for what the query does not answer.
    pub(super) fn asks_more_than(&self, query: &mut Query) -> bool {
        if self.suffice(query) {
            return true;
        }
        self.rank_as_number(query);
        let told = Told::of(query);
        let query = &*query;
        // «Какие картины или картины …?», where two words mean the same
        let twice = self.nouns.windows(2).any(|pair| pair[0].noun.head == pair[1].noun.head);
        // «Чайник ещё закрыт?» asks whether it still is.
        let still = matches!(query, Query::Holds { .. } | Query::Choice { .. })
            && self.sentence.keys.iter().any(|key| key == "еще");
        let asks = |(mark, _): &(Mark, usize)| {
            !(answers(query, *mark, &told)
                || twice && *mark == Mark::Or
                || still && *mark == Mark::Other)
        };
        // «Для чего он нужен?»: nothing lies to anything as a way leads.
        let leads = matches!(query, Query::Anchor { rel: Rel::To | Rel::Through, .. });
        // "And which has the fewest?"
        let counts = |mark: &Mark| matches!(mark, Mark::Best(Extreme::Most | Extreme::Fewest));
        // «Каких вещей больше всего?» asks for a kind, and not for the biggest thing.
        let things =
            |noun: &Noun| noun.head.anything || self.is_kind(noun, |e| *e == Extension::Things);
        let of_kinds = matches!(query, Query::Find(noun) if things(noun));
        let fewest = matches!(query, Query::Find(_))
            && (self.has(Mark::Have) || of_kinds)
            && !told.most
            && self.marks.iter().any(|(mark, _)| counts(mark));
        // "Which room has more?" asks of what was counted, not for the biggest room.
        let has_more = matches!(query, Query::Find(_))
            && self.has(Mark::Have)
            && !told.most
            && !told.inward
            && self.marks.iter().any(|(mark, _)| matches!(mark, Mark::More(_)));
        // "How many of those are there?", "Do all of them go there?": a single place is no "those".
        let only = |noun: &Noun| matches!(noun.head.things.as_deref(), Some([only]) if only.replica().is_none());
        let many = match query {
            Query::Count(noun) => only(noun),
            Query::Holds { subject, .. } => subject.all && only(subject),
            _ => false,
        };
        // "Why can't one drive through it?" asks of more than the last answer.
        let why = matches!(query, Query::Why { about: None, .. })
            && (self.has(Mark::Can) || self.has(Mark::Cannot) || self.has(Mark::Move))
            && !(self.spots.is_empty() && self.nouns.is_empty());
        // «Которая из них в спальне, на чём стоит?» asks two things.
        let governed = |(rel, at): &(Rel, usize)| {
            matches!(rel, Rel::On | Rel::In | Rel::Under)
                && self.marks.contains(&(Mark::What, at + 1))
        };
        let twofold = !matches!(query, Query::Anchor { .. })
            && (self.has(Mark::Which) || self.has(Mark::Where) || self.has(Mark::HowMany))
            && self.links.iter().any(governed);
        // "Which rooms don't have both a bed and a sofa?": one of the two they may have.
        let has = |noun: &Noun| noun.restrictions.iter().filter(|r| r.rel == Rel::Has).count();
        let both = self.negated
            && (self.has(Mark::All) || self.nouns.iter().any(|s| s.noun.all))
            && matches!(query, Query::Find(noun) | Query::Count(noun) if has(noun) > 1);
        // «В какой комнате стульев больше, чем книг?» asks for rooms.
        let of_rooms = |s: &Subject| self.is_rooms(&s.noun) && self.follows_which(s.at);
        let placed = |noun: &Noun| !noun.restrictions.is_empty();
        let in_which = matches!(query, Query::MoreOf { of, .. } if !of.iter().any(placed))
            && self.nouns.iter().any(of_rooms);
        // "Whose mug is that?" asks for an owner.
        static WHOSE: Set = Set::named("Whose");
        let owner = |query: &Query| match query {
            Query::Property { property, .. } => *property == Property::Owner,
            _ => false,
        };
        let whose =
            self.sentence.keys.iter().any(|key| WHOSE.contains(&key.as_str())) && !owner(query);
        // «А в ванной есть хоть одна?»: one of a kind that was spoken of, and not anything at all.
        static ONE: Set = Set::named("OneWord");
        let bare = |noun: &Noun| noun.head.anything && noun.filters.is_empty();
        // «А в ванной есть ещё?»: of what, is not said.
        let another = !(self.has(Mark::Anything) || self.has(Mark::What))
            && self.sentence.keys.iter().any(|key| set!("AnotherWord").contains(&key.as_str()));
        let one = matches!(query, Query::Exists { what, .. } if what.iter().all(bare))
            && (another || self.sentence.keys.iter().any(|key| ONE.contains(&key.as_str())));
        // "In here", which was not put as the room.
        let here = self.sentence.keys.windows(2).any(|two| two == ["in", "here"]);
        // "Is its door locked?": of the door, and not whether the room is one.
        let kind = |claim: &Claim| matches!(claim, Claim::Kind(_));
        let its = self.sentence.keys.iter().any(|key| key == "its")
            && matches!(query, Query::Holds { claims, .. } if claims.iter().any(kind));
        // "The plunger and the toilet, same room?": of one room, and not whether they are rooms.
        let rooms = |query: &Query| match query {
            Query::Holds { subject, claims, .. } => claims.iter().any(|claim| match claim {
                Claim::Kind(room) => self.is_area(room) && !self.is_area(subject),
                _ => false,
            }),
            _ => false,
        };
        let same = match query {
            Query::Several(each) => each.iter().any(rooms),
            one => rooms(one),
        };
        // "What is the robot's name?" asks for a name, and for no list.
        let named = self.has(Mark::What)
            && self.has(Mark::List)
            && self.sentence.keys.iter().any(|key| key == "name");
        // "How many chairs can you get to?" asks for ways.
        let by_way = |noun: &Noun| {
            noun.reached.is_some() || self.is_doors(noun) || self.is_exits(noun) || told.inward
        };
        let goes = self.has(Mark::Can)
            && self.has(Mark::Move)
            && matches!(query, Query::Find(noun) | Query::Count(noun) if !by_way(noun));
        // "Which door do I go through?": whither is not said.
        let any_doors = |noun: &Noun| {
            let head = &noun.head;
            let any = head.things.is_none() && head.named.is_empty();
            self.is_doors(noun) && any && noun.restrictions.is_empty()
        };
        let through = self.links.iter().any(|(rel, _)| *rel == Rel::Through);
        let nowhither = (through || self.has(Mark::Move))
            && !self.has(Mark::Can)
            && matches!(query, Query::Find(noun) if any_doors(noun));
        // "What if Door 1 is locked?" supposes.
        let supposes = self.sentence.keys.windows(2).any(|two| two == ["what", "if"]);
        leads
            || told.parted
            || told.itself
            || nowhither
            || self.is_torn(query)
            || self.is_misplaced(query)
            || self.only_denies(query)
            || self.denies_aside()
            || self.sets_rooms_against(query)
            || self.points_to_a_place()
            || self.denies_a_guess()
            || many
            || why
            || twofold
            || whose
            || both
            || in_which
            || one
            || here
            || supposes
            || goes
            || named
            || has_more
            || its
            || same
            || fewest
            || self.marks.iter().any(asks)
            || self.points(&told, query)
            || self.is_piece(query)
            || self.loses_there(query)
            || self.loses_a_side(query)
            || self.loses_what_governs(query)
            || self.loses_the_property(query)
            || self.loses_what_is_shown(query)
    }

    /// Whether a room would be on, in or under something: "I'm in the kitchen, is it on the table?" is not of the kitchen.
    fn is_misplaced(&self, query: &Query) -> bool {
        let room = |noun: &Noun| self.is_area(noun) && !self.is_storey(noun);
        let named = |noun: &Noun| !noun.head.named.is_empty() || noun.head.things.is_some();
        let bears = |place: &Restriction| {
            let thing = |anchor: &Noun| {
                let kinds = !anchor.head.kinds.is_empty() || named(anchor);
                kinds && !self.is_area(anchor) && !self.is_building(anchor)
            };
            matches!(place.rel, Rel::On | Rel::In | Rel::Under) && place.anchors.iter().all(thing)
        };
        match query {
            Query::Holds { subject, claims, .. } | Query::Choice { subject, claims } => {
                let of = |claim: &Claim| matches!(claim, Claim::Related(place) if bears(place));
                room(subject) && named(subject) && claims.iter().any(of)
            }
            _ => false,
        }
    }

    /// «Не то, что на столе»: what something is not, where nothing is asked.
    fn only_denies(&self, query: &Query) -> bool {
        let Query::Find(noun) = query else { return false };
        let denied = noun.restrictions.iter().all(|place| place.negated);
        // «не то что на столешнице»
        let that = self.sentence.keys.windows(2).any(|two| two == ["то", "что"]);
        let asks = self.asks() && !that || self.has(Mark::Where) || self.has(Mark::List);
        noun.head.anything
            && denied
            && !noun.restrictions.is_empty()
            && noun.filters.is_empty()
            && !asks
    }

    /// "Not the big table, what is on the coffee table?": what is not meant is no part of what is asked.
    fn denies_aside(&self) -> bool {
        let asks = [Mark::What, Mark::Which, Mark::Where, Mark::HowMany];
        let first = self.nouns.iter().map(|s| s.at).chain(self.spots.iter().map(|s| s.at)).min();
        self.marks.contains(&(Mark::Not, 0))
            && first == Some(1)
            && self.marks.iter().any(|(mark, at)| *at > 1 && asks.contains(mark))
    }

    /// «Где телефон, не на диване ли?» guesses at its place, and asks for no place without it.
    fn denies_a_guess(&self) -> bool {
        let keys = &self.sentence.keys;
        let parted = (1..keys.len())
            .any(|n| set!("Not").contains(&keys[n].as_str()) && self.sentence.comma_between(n, n));
        let guess = |(mark, at): &(Mark, usize)| {
            let place = self.spots.iter().any(|spot| spot.at == at + 1);
            let asked = self.marks.iter().any(|(m, w)| *m == Mark::Where && w < at);
            *mark == Mark::Not && place && asked
        };
        parted && self.marks.iter().any(guess)
    }

    /// «А на той, где ракетка?» tells which one is meant, and does not ask where the racket is.
    fn points_to_a_place(&self) -> bool {
        static POINTING: Set = Set::named("PointingWord");
        let keys = self.sentence.keys.windows(2);
        keys.enumerate().any(|(at, pair)| {
            POINTING.contains(&pair[0].as_str())
                && pair[1] == "где"
                && self.sentence.comma_between(at + 1, at + 1)
        })
    }

    /// «Чего нет в ванной, что есть на кухне?»: what stands in one room is never in the other too; that asks for kinds.
    fn sets_rooms_against(&self, query: &Query) -> bool {
        let Query::Find(noun) = query else { return false };
        let within = |negated: bool| {
            noun.restrictions.iter().any(|r| {
                let rooms =
                    |a: &Noun| self.is_area(a) && !self.is_building(a) && !self.is_storey(a);
                r.rel == Rel::In && r.negated == negated && r.anchors.iter().all(rooms)
            })
        };
        noun.head.anything && within(true) && within(false)
    }

    /// Whether something is in two rooms: «в гостиной, то есть в спальне».
    fn is_torn(&self, query: &Query) -> bool {
        let room = |r: &Restriction| match (&r.anchors[..], r.rel, r.negated) {
            ([only], Rel::In | Rel::On, false)
                if self.is_area(only) && !self.is_building(only) && !self.is_storey(only) =>
            {
                Some(only.head.clone())
            }
            _ => None,
        };
        let mut torn = false;
        if matches!(query, Query::Kinds { .. }) && self.says_both() {
            return torn;
        }
        query.clone().each_noun(&mut |noun| {
            let mut rooms = noun.restrictions.iter().filter_map(room);
            torn |= rooms.next().is_some_and(|one| rooms.any(|other| other != one));
        });
        torn
    }

    /// «Какая это комната?», "How many do they have?", "The one in the hall" by itself: what was spoken of is neither
    /// listed with all others, nor counted, nor said to be where it was only described to be.
    fn loses_what_is_shown(&self, query: &Query) -> bool {
        let placed = |claim: &Claim| matches!(claim, Claim::Related(_));
        match query {
            Query::Find(noun) => {
                let bare = noun.head.things.is_none()
                    && !noun.head.anything
                    && noun.filters.is_empty()
                    && noun.restrictions.is_empty()
                    && noun.best.is_none();
                bare && self.sentence.language == Language::Russian
                    && self.sentence.keys.iter().any(|key| key == "это")
            }
            Query::Count(noun) => {
                self.has(Mark::Have) && noun.head.things.is_some() && noun.restrictions.is_empty()
            }
            Query::Holds { subject, claims, .. } => {
                let says = self.has(Mark::Be)
                    || self.has(Mark::Exists)
                    || [Mark::All, Mark::Each].iter().any(|m| self.has(*m));
                points(subject) && claims.iter().all(placed) && !says
            }
            _ => false,
        }
    }

    /// «Какого цвета табурет, чёрный?»: the property is asked, and not for those that have the value.
    fn loses_the_property(&self, query: &Query) -> bool {
        let (Query::Find(noun), Some((asked, at))) = (query, &self.property) else { return false };
        // «Что красного цвета?» asks for no colour.
        let which = |(mark, before): &(Mark, usize)| *mark == Mark::Which && before + 1 == *at;
        if !self.marks.iter().any(which) {
            return false;
        }
        let own = |value| self.lexicon.values.entry(value).property == *asked;
        noun.like.is_none() && noun.filters.iter().any(|filter| own(filter.value))
    }

    /// "Where did you get it from?", «В какой из них больше?»: a preposition of what is asked that the query has not.
    fn loses_what_governs(&self, query: &Query) -> bool {
        let has = |rel: Rel| self.links.iter().any(|(own, _)| *own == rel);
        match query {
            Query::Where(noun) => {
                has(Rel::From)
                    && !self.has(Mark::Lead)
                    && noun.restrictions.iter().all(|place| place.rel != Rel::From)
            }
            Query::Find(noun) => {
                let things = noun.head.things.as_deref().unwrap_or_default();
                let told = !things.is_empty() && things.iter().all(|t| t.replica().is_some());
                let asked = self.links.first().is_some_and(|(rel, at)| {
                    matches!(rel, Rel::In | Rel::On) && *at < 2 && self.has(Mark::Which)
                });
                told && asked && noun.best.is_some() && noun.restrictions.is_empty()
            }
            _ => false,
        }
    }

    /// «Туда дверь открыта?»: of the door there, and not of any.
    fn loses_there(&self, query: &Query) -> bool {
        // "How many chairs have we got there?", where nothing was told that it could be.
        if self.nowhere.is_some() && self.spots.is_empty() {
            return matches!(query, Query::Count(_) | Query::Find(_) | Query::Exists { .. });
        }
        let (Some(there), Query::Holds { .. }) = (&self.there, query) else { return false };
        let mut taken = false;
        if let Query::Holds { claims, .. } = query {
            taken |= claims
                .iter()
                .any(|claim| matches!(claim, Claim::Related(place) if place.rel == Rel::There));
        }
        query.clone().each_noun(&mut |noun| {
            taken |= noun.head.things == there.head.things
                || noun.restrictions.iter().any(|place| place.rel == Rel::There);
        });
        !taken
    }

    /// «А пластиковые возле чего лежат?»: a preposition of a side that governs nothing asks for what lies there.
    fn loses_a_side(&self, query: &Query) -> bool {
        let listed = matches!(query, Query::Find(_) | Query::Count(_) | Query::Exists { .. });
        if !listed && !self.links.iter().any(|(rel, _)| *rel == Rel::Outside) {
            return false;
        }
        let side = |rel: Rel| match rel {
            Rel::Outside => true,
            rel => listed && (rel.is_side() || matches!(rel, Rel::Under | Rel::Above)),
        };
        let mut asked: Vec<Rel> =
            self.links.iter().map(|(rel, _)| *rel).filter(|r| side(*r)).collect();
        query.clone().each_noun(&mut |noun| {
            // «За какой дверью ванная?»: what is behind a door is where it leads.
            let is = |place: &Restriction, rel: Rel| {
                place.rel == rel || (place.rel, rel) == (Rel::To, Rel::Behind)
            };
            asked.retain(|rel| !noun.restrictions.iter().any(|place| is(place, *rel)));
        });
        !asked.is_empty()
    }

    /// «Хватит ли шести стульев?», "Are there enough chairs for six?": so many or more. Whether for how many is not said.
    fn suffice(&self, query: &mut Query) -> bool {
        let keys = &self.sentence.keys;
        let asks = |key: &String| set!("Enough").contains(&key.as_str());
        if !keys.iter().any(asks) {
            return false;
        }
        let mut counted = false;
        query.each_noun(&mut |noun| {
            counted |= noun.count.is_some();
            if noun.count.is_some() && noun.quantity == Quantity::Exactly {
                noun.quantity = Quantity::AtLeast;
            }
        });
        !counted && matches!(query, Query::Exists { .. })
    }

    /// "Is there a second television?": at least two of them.
    fn rank_as_number(&self, query: &mut Query) {
        let Query::Exists { what, .. } = query else { return };
        for noun in what.iter_mut().filter(|noun| !self.is_area(noun) && noun.best.is_none()) {
            if let Some(rank) = noun.rank.take_if(|rank| *rank > 1) {
                (noun.count, noun.quantity) = (Some(rank), Quantity::AtLeast);
            }
        }
    }

    /// "How many things is that?", «Сколько это?»: what is pointed at must be in the query.
    fn points(&self, told: &Told, query: &Query) -> bool {
        let takes = matches!(
            query,
            Query::Why { .. }
                | Query::Several(_)
                | Query::WhereAreYou(_)
                | Query::Way { .. }
                | Query::Passing { .. }
                | Query::CanReach { .. }
        );
        // "Which room has nothing in it?" means the room.
        let own = self.nouns.iter().any(|subject| !spoken_of(&subject.noun));
        let places = self.spots.iter().filter(|_| !own).flat_map(|spot| &spot.nouns);
        let mut said = self.nouns.iter().map(|subject| &subject.noun).chain(places);
        // «Дойти от дивана до холодильника – это сколько?» points at what it names itself.
        let names_nothing = self.spots.is_empty()
            && (self.sentence.language == Language::English || self.nouns.is_empty());
        // "Which fruit isn't there?", but "Which rooms are there?"
        // "What do you see there?" asks of a place.
        let elsewhere = matches!(query, Query::WhatDoYouSee);
        let there = self.there.is_some() && (self.negated || elsewhere);
        !takes
            && !told.referent
            && (there || said.any(spoken_of) || self.sentence.points() && names_nothing)
    }

    /// "And to the kitchen?" by itself: a piece of a question that nothing before completes.
    fn is_piece(&self, query: &Query) -> bool {
        let begins = |n: usize| self.sentence.keys.get(n).map(String::as_str);
        let about = matches!((begins(0), begins(1)), (Some("what" | "how"), Some("about")));
        let goes_on = about || matches!(begins(0), Some("and" | "а" | "и"));
        let small = |mark: &Mark| {
            matches!(mark, Mark::And | Mark::The | Mark::A | Mark::Filler | Mark::One | Mark::Be)
                || about && matches!(mark, Mark::What | Mark::How)
        };
        let asks = |(mark, _): &(Mark, usize)| !small(mark);
        let placed = |query: &Query| match query {
            Query::Holds { claims, .. } => claims.iter().all(|c| matches!(c, Claim::Related(_))),
            _ => false,
        };
        goes_on
            && (matches!(query, Query::Find(_) | Query::Exists { .. }) || placed(query))
            && !self.marks.iter().any(asks)
    }
}

/// Whether a description is of what was spoken of, and not of the robot.
fn spoken_of(noun: &Noun) -> bool {
    noun.head.things.as_deref().is_some_and(|things| things != [Thing::Robot])
}
