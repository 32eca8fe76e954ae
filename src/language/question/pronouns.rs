//! What a pronoun takes up: what was last asked of before the members of a list, where it agrees and may stand so.
//!
//! Invariant: where several of one rank fit, none is chosen: it is asked back which is meant.

use std::collections::BTreeSet;

use super::Doubt;
use super::everyday;
use super::focus::{is_one, is_shown};
use super::grammar::points;
use super::knowledge::Knowledge;
use super::lexicon::{Extension, Meaning};
use super::mark::{Mark, Pronoun};
use super::memory::Exchange;
use super::query::{Claim, Noun, Query, Rel, Thing};
use super::vocabulary;
use crate::map::Entity;
use crate::sets::set;
use crate::words::{Gender, NounPhrase, Number, WordHints, word_keys, word_ranges};

impl Knowledge<'_> {
    /// What a pronoun means: what was last spoken of that agrees with it, and may stand in the relation that it is named
    /// in («на нём»).
    pub(super) fn referent(&self, pronoun: Pronoun, rel: Option<Rel>) -> Vec<Thing> {
        let last = &self.memory.last;
        match pronoun {
            // "Is there a towel in the bathroom? – No such thing. – How many paintings are there?": in the bathroom.
            // Nor is anywhere "there" while it is asked back which of several was meant.
            Pronoun::There if self.memory.is_lost || self.memory.awaits_reply() => {
                self.memory.told_place.into_iter().collect()
            }
            _ if self.memory.is_lost => Vec::new(),
            Pronoun::There => self.places_spoken_of(),
            Pronoun::They if last.len() > 1 => self.several_meant(rel),
            // "How many of them are on the table? Which of them is bigger?": of one thing there are no others.
            Pronoun::They
                if matches!(rel, Some(Rel::From | Rel::Of))
                    && let Some(list) = self.list_with(last) =>
            {
                list
            }
            Pronoun::They if let Some(ends) = self.ends_spoken_of() => ends,
            Pronoun::They if let Some(pair) = self.last_pair() => pair,
            _ if let Some(sought) = self.sought_in_vain(pronoun) => sought,
            // "What can I write with and where is it?": each of them.
            Pronoun::Any
                if matches!(self.memory.query, Some(Query::Find(_)))
                    && last.len() > 1
                    && self.memory.exchanges.first().is_some_and(|e| e.topics().is_empty()) =>
            {
                last.clone()
            }
            // "The living room is big. What are they on?": one thing is no "they", but scissors and «таблетки» are.
            Pronoun::They => {
                // Where nothing was found, "they" are not what it was looked for on.
                let plural = self.memory.is_plural && !self.found_nothing();
                let several = |t: &Thing| plural || self.gender(*t).1 == Number::Plural;
                // "I can't find my keys. Where are they?": of two sets neither is meant rather than the other.
                self.taken_up(pronoun, rel).into_iter().filter(several).collect()
            }
            _ => self.taken_up(pronoun, rel),
        }
    }

    /// The one that was spoken of last, or all of a list none of which was spoken of more than the others.
    fn taken_up(&self, pronoun: Pronoun, rel: Option<Rel>) -> Vec<Thing> {
        /// A pronoun passes over no more exchanges for something that may stand in its relation.
        const NEAR: usize = 2;
        let may = |t: &Thing| rel.is_none_or(|rel| self.may_be_anchor(rel, *t));
        let near = self.memory.exchanges.iter().take(NEAR);
        let fitting = |admits: &dyn Fn(&Thing) -> bool| -> Vec<Thing> {
            let fits = |t: &Thing| self.agrees(pronoun, *t) && admits(t);
            let placed = matches!(rel, Some(Rel::On | Rel::In));
            let rank = near.clone().enumerate().find_map(|(n, exchange)| {
                if let Some(whither) = exchange.whither().filter(|t| placed && fits(t)) {
                    return Some(vec![whither]);
                }
                let topic = exchange.topics().iter().find(|t| fits(t)).map(|t| {
                    // «Где вытяжка? А телевизор? – На тумбе. – Она большая?»: the hood as well as the stand.
                    let mut before = near.clone().skip(n + 1).filter_map(Exchange::topic);
                    let before = before.find(|other| fits(other) && other != t);
                    let before = before.filter(|_| exchange.is_only_place(*t));
                    before.into_iter().chain([*t]).collect()
                });
                let all_of = |all: &[Thing]| -> Vec<Thing> {
                    all.iter().copied().filter(|t| fits(t)).collect()
                };
                let ranks = [exchange.members(), exchange.aside()];
                topic.or_else(|| ranks.into_iter().map(all_of).find(|all| !all.is_empty()))
            });
            rank.unwrap_or_default()
        };
        let found = fitting(&may);
        let whatever = found.is_empty() && rel != Some(Rel::Outside);
        let found = if whatever { fitting(&|_| true) } else { found };
        if !found.is_empty() {
            return found;
        }
        let spoken = self.memory.spoken.iter().copied().find(|t| self.agrees(pronoun, *t));
        spoken.into_iter().collect()
    }

    /// What one word in the singular may mean of several: "it" after a list, "that one". Where they are told by name one
    /// by one, all of them are.
    pub(super) fn contested(&self, query: &Query) -> Option<Doubt> {
        /// Of no more it is asked back which is meant.
        const MOST: usize = 8;
        if let Some(told) = self.memory.astray.as_ref().filter(|_| query.counts_from_here()) {
            return Some(Doubt::Astray { told: told.clone() });
        }
        if let Some(doubt) = self.is_point_not_room(query) {
            return Some(doubt);
        }
        if matches!(query, Query::Several(_)) {
            return None;
        }
        // "How many things are on the bed? – Three. – Where is it?": none of several that were asked after as such.
        let told_each =
            matches!(query, Query::Where(_) | Query::RoomOf(_)) && !self.memory.is_plural;
        let mut doubt = None;
        query
            .clone()
            .each_noun(&mut |noun| doubt = doubt.take().or_else(|| self.shown_unclearly(noun)));
        let single = |noun: &Noun| {
            let words = word_keys(&noun.text);
            let pronoun = match vocabulary::longest(&words) {
                Some((taken, Mark::Pronoun(p))) if taken == words.len() => Some(p),
                _ => None,
            };
            let shown = words.last().is_some_and(|word| word == "one") && is_shown(noun);
            let it = pronoun.is_some_and(|p| !matches!(p, Pronoun::They | Pronoun::There));
            !told_each && (shown || it) || is_another(&words)
        };
        let mut check = |noun: &Noun| {
            let several = noun.head.things.as_deref().filter(|things| things.len() > 1);
            let bare = noun.filters.is_empty()
                && noun.restrictions.is_empty()
                && noun.sizes.is_empty()
                && noun.best.is_none()
                && noun.rank.is_none()
                && !noun.other;
            // None of 69 is "it": all of them are no answer to what was meant either.
            if several.is_some_and(|all| all.len() > MOST) && bare && single(noun) {
                doubt.get_or_insert(Doubt::NoReferent { word: noun.text.clone() });
                return;
            }
            if let Some(candidates) = several.filter(|_| bare && single(noun)) {
                let (reference, candidates) = (noun.text.clone(), candidates.to_vec());
                doubt.get_or_insert(Doubt::Ambiguous { reference, candidates });
            }
        };
        query.clone().each_noun(&mut |noun| {
            check(noun);
            noun.restrictions.iter().flat_map(|place| &place.anchors).for_each(&mut check);
        });
        doubt
    }

    /// "Is there a bowl in that cabinet?", where none of several was spoken of; or what was told last lies in something of another
    /// name, which may be called so.
    fn shown_unclearly(&self, noun: &Noun) -> Option<Doubt> {
        let mut candidates = match is_shown(noun) && is_one(noun) && !points(noun) {
            true => self.find(noun, true).ok()?,
            false => return None,
        };
        if candidates.is_empty() || candidates.iter().any(|thing| thing.replica().is_none()) {
            return None;
        }
        let is_spoken = match candidates[..] {
            [only] => self.memory.exchanges.iter().any(|e| e.things().any(|thing| *thing == only)),
            _ => self.in_focus(&candidates).is_some(),
        };
        let told = self.memory.exchanges.first().into_iter().flat_map(Exchange::things);
        let bearing = told.filter_map(|thing| self.relations.support_of(thing.replica()?));
        let bearing: BTreeSet<Thing> =
            bearing.map(|id| Thing::Entity(Entity::Replica(id))).collect();
        if let ([only], false) = (&bearing.into_iter().collect::<Vec<_>>()[..], is_spoken)
            && !candidates.contains(only)
        {
            candidates.insert(0, *only);
        }
        let reference = noun.text.clone();
        (!is_spoken && candidates.len() > 1).then_some(Doubt::Ambiguous { reference, candidates })
    }

    /// From what something is taken that lies on "it" or in it: what was last spoken of that agrees and may bear things.
    pub(super) fn borne_by_pronoun(&self, pronoun: Pronoun) -> Option<Thing> {
        if self.memory.is_lost || matches!(pronoun, Pronoun::They | Pronoun::There) {
            return None;
        }
        let exchanges = self.memory.exchanges.iter();
        let mut ranked = exchanges.flat_map(|e| [e.topics(), e.members()]).flatten();
        let bears = |t: &Thing| self.may_be_anchor(Rel::On, *t) || self.may_be_anchor(Rel::In, *t);
        ranked.find(|t| self.agrees(pronoun, **t) && bears(t)).copied()
    }

    /// "Is it there?", where "it" and the place are one thing: what was meant by one of the two is not known.
    pub(super) fn is_at_itself(&self, query: &Query) -> Option<String> {
        let Query::Holds { subject, claims, .. } = query else { return None };
        let own = |anchor: &&Noun| {
            let things = subject.head.things.as_deref().unwrap_or_default();
            !things.is_empty() && anchor.head.things.as_deref() == Some(things)
        };
        claims.iter().find_map(|claim| match claim {
            Claim::Related(place) => place.anchors.iter().find(own).map(|a| a.text.clone()),
            _ => None,
        })
    }

    /// The places of which "in them" and "on them" speak: all that were told and may be so, where there are several.
    pub(super) fn places_meant(&self, pronoun: Pronoun, rel: Rel) -> Option<Vec<Thing>> {
        let mut meant = match pronoun {
            Pronoun::They => self.referent(pronoun, Some(rel)),
            _ => Vec::new(),
        };
        meant.retain(|thing| self.may_be_anchor(rel, *thing));
        (meant.len() > 1).then_some(meant)
    }

    pub(super) fn agrees(&self, pronoun: Pronoun, thing: Thing) -> bool {
        let fits = |gender: Gender| match pronoun {
            Pronoun::He => gender == Gender::Masculine,
            Pronoun::HimOrIt => gender != Gender::Feminine,
            Pronoun::She | Pronoun::Her => gender == Gender::Feminine,
            Pronoun::It => gender == Gender::Neuter,
            Pronoun::They | Pronoun::Any | Pronoun::There => true,
        };
        let (gender, number) = self.gender(thing);
        let singular = number == Number::Singular;
        let any = matches!(pronoun, Pronoun::They | Pronoun::Any | Pronoun::There);
        any || (fits(gender) && singular) || self.genders_said(thing).into_iter().any(fits)
    }

    /// «Что ближе к ней: кровать или комод?»: not to the room in which both are, but to what was spoken of in it.
    pub(super) fn out_of_its_room(&self, query: &mut Query) {
        let Query::WhichMore { of, to: Some(to), .. } = query else { return };
        let words = word_keys(&to.text);
        let Some((_, Mark::Pronoun(pronoun))) = vocabulary::longest(&words) else { return };
        let Some(&[room]) = to.head.things.as_deref() else { return };
        let inside = |noun: &Noun| {
            let found = self.find(noun, true).unwrap_or_default();
            !found.is_empty()
                && found.iter().all(|t| t.replica().is_some() && self.area_of(*t) == room.area())
        };
        if room.area().is_none() || !of.iter().all(inside) {
            return;
        }
        let mut topics = self.memory.exchanges.iter().flat_map(Exchange::topics);
        let meant = topics.find(|t| t.replica().is_some() && self.agrees(pronoun, **t));
        to.head.things = meant.map(|meant| vec![*meant]).or(to.head.things.take());
    }

    /// Whether something may be on or in a thing.
    pub(super) fn may_be_anchor(&self, rel: Rel, thing: Thing) -> bool {
        let wanted: &[&str] = match rel {
            Rel::On => &["support", "seat", "bed"],
            // «… в тумбе, а сколько снаружи?»: outside of what has an inside.
            Rel::In | Rel::Outside => &["container"],
            _ => return true,
        };
        let has = |id| wanted.iter().any(|wanted| self.world.has_trait(id, wanted));
        let held = if rel == Rel::Outside { Rel::In } else { rel };
        match thing.replica() {
            Some(id) => has(id) || !self.related(held, thing).is_empty(),
            None => held == Rel::In && thing.area().is_some(),
        }
    }

    /// Genders of the words of the last question that mean a thing of its answer.
    fn genders_said(&self, thing: Thing) -> Vec<Gender> {
        if !self.memory.last.contains(&thing) {
            return Vec::new();
        }
        let lexicon = self.lexicon();
        let means = |word: &&str| {
            let plain = everyday::plain(word, lexicon);
            let hits = lexicon.nouns.find(&plain);
            let kinds = hits.iter().filter_map(|hit| match hit.id {
                Meaning::Kind(kind) => Some(lexicon.kind(*kind).extension),
                Meaning::Entity(_) => None,
            });
            let general = |e: &Extension| matches!(e, Extension::ObjectType(_));
            kinds.filter(general).any(|kind| self.members(&kind).contains(&thing))
        };
        let words = &self.memory.words;
        let said = word_ranges(words).into_iter().map(|range| &words[range]);
        let phrases = said.filter(means).map(|w| NounPhrase::parse(w, &WordHints::default()));
        phrases.filter(|p| p.number() == Number::Singular).map(|p| p.gender()).collect()
    }

    /// «Что в микроволновке? Она включена?»: of what was spoken of, what can be in that state. What a question was about
    /// comes before the members of a list; where that does not tell, it is asked back which is meant.
    pub(super) fn by_state(&self, query: &mut Query) {
        let Query::Holds { subject, claims, .. } = query else { return };
        let [Claim::Value(filter)] = &claims[..] else { return };
        let words = word_keys(&subject.text);
        let Some((_, Mark::Pronoun(pronoun))) = vocabulary::longest(&words) else { return };
        let lacks = |thing: Thing| self.own_value(thing, filter.value).is_none();
        // "Which rooms have TVs? Are they on?": no room is on.
        let rooms = subject.head.things.as_deref().unwrap_or_default();
        if pronoun == Pronoun::They
            && rooms.iter().all(|room| room.area().is_some() && lacks(*room))
            && let Some(had) = self.had_by_rooms().filter(|had| !had.iter().any(|t| lacks(*t)))
        {
            subject.head.things = Some(had);
            return;
        }
        let Some([only]) = subject.head.things.as_deref() else { return };
        let [latest, before @ ..] = &self.memory.exchanges[..] else { return };
        if !lacks(*only) {
            return;
        }
        let fits = |t: &&Thing| !lacks(**t) && self.agrees(pronoun, **t);
        let topic = |exchange: &Exchange| exchange.topics().iter().find(fits).copied();
        let listed: Vec<Thing> = latest.members().iter().filter(fits).copied().collect();
        // Of one in a list and what was asked of before it, nothing says which.
        let earlier = before.first().and_then(topic);
        let meant = match (topic(latest), &listed[..], earlier) {
            (Some(topic), _, _) => vec![topic],
            (None, [only], Some(earlier)) => vec![earlier, *only],
            (None, _, Some(earlier)) => vec![earlier],
            (None, _, None) => listed,
        };
        if !meant.is_empty() {
            subject.head.things = Some(meant);
        }
    }

    /// «Где ручка? А вантуз? – В Ванной. – В какой комнате она?»: no room is asked after the room that it is in, where something
    /// else may be meant.
    pub(super) fn in_no_room_itself(&self, query: &mut Query) {
        let Query::RoomOf(noun) = query else { return };
        if let Some(things) = noun.head.things.as_mut().filter(|things| things.len() > 1)
            && things.iter().any(|thing| thing.replica().is_some())
        {
            things.retain(|thing| thing.area().is_none());
        }
    }

    /// "Which room is the sink in? How many chairs are in it?": in the room, as no chair is in a sink. Of what might be in either,
    /// it is asked back.
    pub(super) fn in_its_room(&self, noun: &mut Noun) {
        if !matches!(self.memory.query, Some(Query::RoomOf(_))) || noun.head.anything {
            return;
        }
        let Some(exchange) = self.memory.exchanges.first() else { return };
        let Some(&room) = exchange.topics().iter().find(|t| t.area().is_some()) else { return };
        let sought = self.base(&noun.head);
        let inside = noun.restrictions.iter_mut().filter(|place| place.rel == Rel::In);
        for anchor in inside.flat_map(|place| &mut place.anchors) {
            let words = word_keys(&anchor.text);
            let Some((_, Mark::Pronoun(pronoun))) = vocabulary::longest(&words) else { continue };
            let Some(&[thing]) = anchor.head.things.as_deref() else { continue };
            let within = self.related(Rel::In, thing);
            if thing.replica().is_none()
                || !self.agrees(pronoun, room)
                || within.iter().any(|inside| sought.contains(inside))
            {
                continue;
            }
            let portable =
                |t: &Thing| t.replica().is_some_and(|id| self.world.has_trait(id, "portable"));
            let meant = if sought.iter().any(portable) { vec![thing, room] } else { vec![room] };
            anchor.head.things = Some(meant);
        }
    }

    /// "Is there any fruit in the kitchen? Where is it?": what was found there, of which there is more than one, or what there
    /// is of it elsewhere; where the kitchen is was not wondered.
    pub(super) fn found_where(&self, query: &mut Query) {
        let (Query::Where(noun) | Query::RoomOf(noun)) = query else { return };
        let words = word_keys(&noun.text);
        let Some((_, Mark::Pronoun(pronoun))) = vocabulary::longest(&words) else { return };
        let Some([place]) = noun.head.things.as_deref() else { return };
        if !matches!(self.memory.query, Some(Query::Exists { .. })) {
            return;
        }
        let last = &self.memory.last;
        let elsewhere = self.sought_in_vain(Pronoun::They).unwrap_or_default();
        let found = if last.is_empty() { elsewhere } else { last.clone() };
        let are_meant = found.len() > 1 && !found.contains(place);
        if are_meant && found.iter().all(|t| self.agrees(pronoun, *t)) {
            noun.head.things = Some(found);
        }
    }

    /// "The kitchen one, is it white?": the pronoun resumes the subject, and claims nothing of it.
    pub(super) fn resume(&self, query: &mut Query) {
        let Query::Holds { claims, .. } = query else { return };
        let resumes = |claim: &Claim| match claim {
            Claim::Kind(noun) => {
                let words = word_keys(&noun.text);
                let said = vocabulary::longest(&words);
                matches!(said, Some((taken, Mark::Pronoun(_))) if taken == words.len())
            }
            _ => false,
        };
        if claims.iter().any(|claim| !resumes(claim)) {
            claims.retain(|claim| !resumes(claim));
        }
    }
}

/// Whether words mean one other thing: "the other one", «другая».
fn is_another(words: &[String]) -> bool {
    let others = set!("OtherSeveral");
    let other = |word: &String| {
        set!("Another").contains(&word.as_str()) && !others.contains(&word.as_str())
    };
    let small = |word: &String| {
        set!("TheOrA").contains(&word.as_str()) || set!("OneOrAny").contains(&word.as_str())
    };
    words.iter().any(other) && words.iter().all(|word| other(word) || small(word))
}
