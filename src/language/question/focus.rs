//! What a dialogue is about: what a pronoun takes up, and which of several things a description means that was just
//! spoken of.
//!
//! Invariant: nothing is taken for meant that the last few exchanges did not name; where they name several of one rank
//! that fit, it is asked back.

use std::collections::{BTreeSet, HashSet};

use super::everyday;
use super::grammar::points;
use super::knowledge::Knowledge;
use super::lexicon::{Extension, Meaning};
use super::mark::{Mark, Pronoun};
use super::memory::Exchange;
use super::query::{Best, Claim, Extreme, Head, Noun, Query, Rel, Restriction, Thing};
use super::{Doubt, vocabulary};
use crate::map::Entity;
use crate::words::{Gender, NounPhrase, Number, WordHints, word_keys, word_ranges};

impl Knowledge<'_> {
    /// The one of several things that was spoken of last.
    pub(super) fn in_focus(&self, found: &[Thing]) -> Option<Thing> {
        let ranks = self.memory.exchanges.iter().flat_map(|e| [e.topics(), e.members(), e.aside()]);
        for rank in ranks {
            let mut named = found.iter().filter(|t| rank.contains(t));
            match (named.next(), named.next()) {
                (Some(only), None) => return Some(*only),
                (None, _) => {}
                (Some(_), Some(_)) => return None,
            }
        }
        self.bearing_in_focus(found)
    }

    /// "Which pencils are on the table?" after pencils that lie on one of two: the one that bears or holds what was just
    /// spoken of.
    fn bearing_in_focus(&self, found: &[Thing]) -> Option<Thing> {
        /// What was spoken of before is not thought of by where it lies.
        const NEAR: usize = 2;
        for exchange in self.memory.exchanges.iter().take(NEAR) {
            let spoken = exchange.things().filter_map(|thing| thing.replica());
            let supports = spoken.filter_map(|id| self.relations.support_of(id));
            let supports: HashSet<Thing> =
                supports.map(|id| Thing::Entity(Entity::Replica(id))).collect();
            let mut borne = found.iter().filter(|t| supports.contains(t));
            match (borne.next(), borne.next()) {
                (Some(only), None) => return Some(*only),
                (None, _) => {}
                (Some(_), Some(_)) => return None,
            }
        }
        None
    }

    /// What "that shelf" may mean where the map has no shelf of that name: of what was spoken of or bears it, the one
    /// whose kind is called by the word, as a bookshelf is.
    fn called_so(&self, noun: &Noun) -> Option<Thing> {
        let last = word_keys(&noun.text).pop()?;
        let called = |thing: &Thing| {
            let name = self.kind_name(*thing).unwrap_or_default();
            let keys = word_keys(&name);
            keys.last().is_some_and(|key| key.ends_with(&last))
        };
        self.memory.exchanges.iter().find_map(|exchange| {
            let spoken = exchange.things().copied();
            let bearing = exchange.things().filter_map(|thing| thing.replica());
            let bearing = bearing.filter_map(|id| self.relations.support_of(id));
            let bearing = bearing.map(|id| Thing::Entity(Entity::Replica(id)));
            let all: HashSet<Thing> = spoken.chain(bearing).filter(called).collect();
            let mut all = all.into_iter();
            all.next().filter(|_| all.next().is_none())
        })
    }

    /// What points in a query at a thing of a sort that the map lacks: "that shelf".
    pub(super) fn points_at_nothing(&self, query: &Query) -> Option<String> {
        let mut word = None;
        query.clone().each_noun(&mut |noun| {
            let lacks = noun.head.things.is_none()
                && self.base(&noun.head).is_empty()
                && !noun.head.kinds.is_empty();
            // "In this room" after what is in another one than the robot.
            let own = self.area_of(Thing::Robot).map(|id| Thing::Entity(Entity::Area(id)));
            let elsewhere = || {
                let topic = self.memory.exchanges.first().and_then(|e| e.things().next().copied());
                let room = topic.and_then(|topic| self.area_of(topic));
                room.is_some_and(|room| Some(Thing::Entity(Entity::Area(room))) != own)
            };
            let robots = own.is_some_and(|own| noun.head.things.as_deref() == Some(&[own]));
            // Other than nothing is no other.
            let bare = Noun { other: true, ..Noun { head: noun.head.clone(), ..Noun::default() } };
            let all = self.base(&noun.head);
            // «Хлеб остался ещё?»
            let whether = matches!(query, Query::Exists { .. });
            let other = noun.other
                && !whether
                && !noun.head.anything
                && noun.head.things.is_none()
                && noun.except.is_empty();
            if other
                && !all.is_empty()
                && self.find(&bare, true).is_ok_and(|f| f.len() == all.len())
            {
                word.get_or_insert_with(|| noun.text.clone());
            }
            // "Which ones are nearer?" after nothing that is known.
            let unsaid = points(noun) && noun.restrictions.is_empty() && noun.filters.is_empty();
            if unsaid && noun.head.things.is_none() && noun.except.is_empty() {
                word.get_or_insert_with(|| noun.text.clone());
            }
            let missing = |noun: &Noun| noun.head.things.as_deref() == Some(&[]);
            let anchors = || noun.restrictions.iter().flat_map(|place| &place.anchors);
            if is_shown(noun) && (lacks || robots && elsewhere()) {
                word.get_or_insert_with(|| noun.text.clone());
            }
            if let Some(anchor) = anchors().find(|anchor| missing(anchor)) {
                word.get_or_insert_with(|| anchor.text.clone());
            }
        });
        word
    }

    /// Of several things that a description in the singular fits: the one that was just spoken of, else the one that is
    /// exactly of the kind.
    ///
    /// # Errors
    /// Several are left.
    pub(super) fn meant(&self, noun: &Noun, found: &[Thing]) -> Result<Thing, Doubt> {
        let one = !noun.plural && !noun.indefinite && !noun.other && noun.head.things.is_none();
        if let Some(thing) = self.in_focus(found).filter(|_| one) {
            return Ok(thing);
        }
        match self.exactly(noun, found).as_deref().unwrap_or(found) {
            [only] => Ok(*only),
            several => Err(self.ambiguous(noun, several)),
        }
    }

    /// Those of some things that a word names outright: "the box" is no tissue box where there is a box. None where
    /// that leaves all or nothing.
    pub(super) fn exactly(&self, noun: &Noun, found: &[Thing]) -> Option<Vec<Thing>> {
        let kinds = self.lexicon().proper(&noun.head.kinds, self.language);
        let own: HashSet<Thing> =
            self.base(&Head { kinds, ..Head::default() }).into_iter().collect();
        let exact: Vec<Thing> = found.iter().filter(|t| own.contains(t)).copied().collect();
        (!exact.is_empty() && exact.len() < found.len()).then_some(exact)
    }

    /// Puts for each place of a query that several things are, the one of them that was just spoken of.
    pub(super) fn focus(&self, query: &mut Query) {
        if self.memory.exchanges.is_empty() && self.memory.listed.is_empty() {
            query.each_noun(&mut |noun| self.this_room(&mut noun.restrictions));
            self.put_together(query);
            return;
        }
        if let Query::Holds { claims, .. } | Query::Choice { claims, .. } = query {
            for claim in claims {
                if let Claim::Related(restriction) = claim {
                    self.focus_places(std::slice::from_mut(restriction));
                }
            }
        }
        query.each_noun(&mut |noun| {
            if is_shown(noun)
                && is_one(noun)
                && self.base(&noun.head).is_empty()
                && let Some(meant) = self.called_so(noun)
            {
                noun.head = Head { things: Some(vec![meant]), ..Head::default() };
            }
        });
        query.each_noun(&mut |noun| self.of_those_told(noun));
        if self.asked_where() {
            query.each_noun(&mut |noun| self.rooms_there(noun));
        }
        query.each_noun(&mut |noun| {
            self.focus_places(&mut noun.restrictions);
            self.this_room(&mut noun.restrictions);
            // "the bigger one" of several that were told
            let one = points(noun);
            if one && noun.head.anything && noun.other {
                if let Some(rest) = self.complement() {
                    noun.head = Head { things: Some(rest), ..Head::default() };
                    noun.other = false;
                }
            } else if one && noun.head.anything && self.memory.listed.len() < 2 {
                // "Is there a window in the hall? So which rooms don't have one?"
                let sought = self.memory.query.as_ref().and_then(Query::sought);
                if let Some(sought) = sought.filter(|sought| !sought.head.anything) {
                    noun.head = Head { things: None, ..sought.head.clone() };
                } else if is_shown(noun) && noun.restrictions.is_empty() {
                    // "What is the front door made of? Is that one locked?"
                    let shown = self.memory.exchanges.first().and_then(Exchange::topic);
                    noun.head.things = shown.map(|shown| vec![shown]);
                    noun.head.anything = noun.head.things.is_none();
                }
            } else if one && is_shown(noun) && self.found_nothing() {
                // "What about pens? – There are none. – Where is that one?"
            } else if one && noun.head.anything && self.memory.listed.len() > 1 {
                // "Which rooms have a TV? What does the one in the bedroom stand on?"
                let rooms = self.memory.listed.iter().all(|t| t.area().is_some());
                let had = self.had_by_rooms().filter(|_| rooms && !noun.restrictions.is_empty());
                // "Which are on the table? And the one on the dresser?": of those that were told before.
                let listed = || self.list_fitting(noun).filter(|_| !noun.restrictions.is_empty());
                let things = had.or_else(listed).unwrap_or_else(|| self.memory.listed.clone());
                // "Is there one in the kitchen?": any of the kind.
                noun.head = match self.alike(&things).filter(|_| word_keys(&noun.text).len() == 1) {
                    Some(kind) => Head { kinds: vec![kind], ..Head::default() },
                    None => Head { things: Some(things), ..Head::default() },
                };
            }
        });
        self.put_together(query);
        self.keep_room(query);
        self.by_state(query);
        self.resume(query);
        self.most_of_their_kind(query);
        // «Сколько их всего?» of one thing: how many of its kind there are.
        if let Query::Count(noun) = query
            && let Some(things @ ([only] | [_, only])) = noun.head.things.as_deref()
            && self.memory.last.len() < 2
            && things.iter().all(|t| self.kind_of(*t) == self.kind_of(*only))
            && let Some(kind) = self.kind_of(*only)
        {
            noun.head = Head { kinds: vec![kind], ..Head::default() };
        }
    }

    /// «Сколько ламп в ванной? Где их больше всего?»: of the kind, since all that were told are in one room. Of rooms it is
    /// asked which, in whatever words.
    fn most_of_their_kind(&self, query: &mut Query) {
        let many = |extreme: Extreme| matches!(extreme, Extreme::Most | Extreme::Fewest);
        if let Query::Where(noun) = query
            && noun.best.as_ref().is_some_and(|b| many(b.extreme) && b.anchor.is_some())
        {
            *query = Query::Find(noun.clone());
        }
        let Query::Find(Noun { best: Some(best), .. }) = query else { return };
        let is_many = many(best.extreme);
        let Some(had) = best.anchor.as_deref_mut().filter(|_| is_many) else { return };
        let Some(things) = had.head.things.as_deref() else { return };
        let rooms: BTreeSet<_> = things.iter().map(|thing| self.area_of(*thing)).collect();
        if let (1, Some(kind)) = (rooms.len(), self.alike(things)) {
            had.head = Head { kinds: vec![kind], ..Head::default() };
        }
    }

    /// Whether the last question sought something and there was none.
    fn found_nothing(&self) -> bool {
        let sought = self.memory.query.as_ref().is_some_and(|query| query.sought().is_some());
        sought && self.memory.last.is_empty()
    }

    /// "The kitchen one, is it white?": the pronoun resumes the subject, and claims nothing of it.
    fn resume(&self, query: &mut Query) {
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

    /// «Что в микроволновке? Она включена?»: of what was spoken of, what can be in that state. What a question was about
    /// comes before the members of a list; where that does not tell, it is asked back which is meant.
    fn by_state(&self, query: &mut Query) {
        let Query::Holds { subject, claims, .. } = query else { return };
        let [Claim::Value(filter)] = &claims[..] else { return };
        let words = word_keys(&subject.text);
        let Some((_, Mark::Pronoun(pronoun))) = vocabulary::longest(&words) else { return };
        let Some([only]) = subject.head.things.as_deref() else { return };
        let lacks = |thing: Thing| self.own_value(thing, filter.value).is_none();
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

    /// "How far is the sofa from the dining table?": of several tables the one in the room of the sofa.
    fn put_together(&self, query: &mut Query) {
        let nouns: Vec<&mut Noun> = match query {
            Query::Distance { from: Some(from), to } => vec![from, to],
            Query::Closer { what, near, than, .. } => vec![what, near, than],
            Query::WhichMore { of, to: Some(to), .. } => of.iter_mut().chain([to]).collect(),
            Query::Larger { what, than, to: Some(to), .. } => vec![what, than, to],
            _ => return,
        };
        let found: Vec<Vec<Thing>> =
            nouns.iter().map(|noun| self.find(noun, false).unwrap_or_default()).collect();
        let mut rooms = found.iter().filter_map(|found| match found[..] {
            [only] if only.replica().is_some() => self.area_of(only),
            _ => None,
        });
        let Some(room) = rooms.next().filter(|room| rooms.all(|other| other == *room)) else {
            return;
        };
        for (noun, found) in nouns.into_iter().zip(&found) {
            let mut here = found.iter().filter(|t| self.area_of(**t) == Some(room));
            if let (true, Some(&only), None) = (is_one(noun), here.next(), here.next())
                && found.len() > 1
            {
                let text = std::mem::take(&mut noun.text);
                *noun = Noun { text, ..Noun::of(vec![only]) };
            }
        }
    }

    /// "In this room", where no room was spoken of: the robot's.
    fn this_room(&self, restrictions: &mut [Restriction]) {
        let Some(own) = self.area_of(Thing::Robot) else { return };
        let own = Thing::Entity(Entity::Area(own));
        for anchor in restrictions.iter_mut().flat_map(|r| &mut r.anchors) {
            let this = word_keys(&anchor.text).first().is_some_and(|word| {
                ["this", "этой", "эта", "эту", "этом", "этот"].contains(&word.as_str())
            });
            if this && is_one(anchor) && self.base(&anchor.head).contains(&own) {
                *anchor = Noun { text: std::mem::take(&mut anchor.text), ..Noun::of(vec![own]) };
            }
        }
    }

    fn focus_places(&self, restrictions: &mut [Restriction]) {
        // "Which sofa …? What is on it? And on the first one?": of those that can have something on them.
        for place in restrictions.iter_mut() {
            let rel = place.rel;
            let bear = |e: &&Exchange| {
                e.members().len() > 1 && e.members().iter().all(|t| self.may_be_anchor(rel, *t))
            };
            let told = self.memory.exchanges.iter().find(bear);
            for anchor in place.anchors.iter_mut().filter(|a| points(a) && a.other) {
                if let Some(rest) = self.other_bearing(rel) {
                    anchor.head = Head { things: Some(rest), ..Head::default() };
                    anchor.other = false;
                }
            }
            for anchor in place.anchors.iter_mut().filter(|a| points(a) && !a.other) {
                if let Some(told) = told {
                    let things = Some(told.members().to_vec());
                    anchor.head = Head { things, ..Head::default() };
                } else if matches!(rel, Rel::On | Rel::In) && anchor.head.anything {
                    // "What is lying on the bigger bed? And on the smaller one?"
                    anchor.head =
                        self.like_anchor(rel).unwrap_or_else(|| Noun::of(Vec::new()).head);
                }
            }
        }
        for anchor in restrictions.iter_mut().flat_map(|r| &mut r.anchors) {
            let found = is_one(anchor).then(|| self.find(anchor, false).ok()).flatten();
            if let Some(meant) = found.filter(|f| f.len() > 1).and_then(|f| self.in_focus(&f)) {
                let text = std::mem::take(&mut anchor.text);
                *anchor = Noun { text, ..Noun::of(vec![meant]) };
            }
        }
    }

    /// «Какой он?»: asked which one it is, a thing that was spoken of is only itself; and of floors, which have no names,
    /// there is no list.
    pub(super) fn tells_nothing(&self, query: &Query) -> bool {
        let floors = |noun: &Noun| self.is_floor(noun) && noun.head.things.is_none();
        match query {
            Query::Find(noun) => {
                let bare = Noun {
                    head: Head::default(),
                    text: String::new(),
                    plural: false,
                    all: false,
                    ..noun.clone()
                };
                let words = word_keys(&noun.text);
                let ones = words.last().is_some_and(|word| matches!(&**word, "one" | "ones"));
                let said = vocabulary::longest(&words);
                let pronoun = matches!(said, Some((n, Mark::Pronoun(_))) if n == words.len());
                let itself = matches!(noun.head.things.as_deref(), Some([_])) && pronoun
                    || ones && noun.head.things.is_some();
                floors(noun) || itself && bare == Noun::default()
            }
            Query::Count(noun) | Query::Where(noun) => floors(noun),
            Query::Exists { what, .. } => what.iter().any(floors),
            _ => false,
        }
    }

    /// Keeps a place of a surface in the room that was spoken of: «Что на полу? А на стенах?»
    fn keep_room(&self, query: &mut Query) {
        let (Query::Find(noun) | Query::Count(noun)) = query else {
            if let Query::Exists { what, .. } = query
                && let [noun] = &mut what[..]
            {
                self.keep_room_of(noun);
            }
            return;
        };
        self.keep_room_of(noun);
    }

    fn keep_room_of(&self, noun: &mut Noun) {
        let surface = |a: &Noun| {
            (self.is_floor(a) || self.is_walls(a)) && a.restrictions.is_empty() && !a.all
        };
        let [place] = &noun.restrictions[..] else { return };
        if place.negated || !place.anchors.iter().all(surface) {
            return;
        }
        let Some(last) = &self.memory.query else { return };
        let mut rooms: Vec<Thing> = Vec::new();
        last.clone().each_noun(&mut |noun| {
            for anchor in noun.restrictions.iter().flat_map(|place| &place.anchors) {
                let found = self.find(anchor, true).unwrap_or_default();
                rooms.extend(found.into_iter().filter(|t| t.area().is_some()));
            }
        });
        rooms.dedup();
        if let [room] = rooms[..] {
            let anchors = vec![Noun::of(vec![room])];
            noun.restrictions.push(Restriction { rel: Rel::In, anchors, negated: false });
        }
    }

    /// In which rooms the things are that were spoken of last.
    pub(super) fn rooms_spoken_of(&self) -> Vec<Thing> {
        let last = self.memory.exchanges.first().into_iter().flat_map(Exchange::things);
        let rooms = last.filter_map(|thing| self.area_of(*thing));
        rooms.map(|room| Thing::Entity(Entity::Area(room))).collect()
    }

    /// The kind of what the last question asked to be on or in.
    fn like_anchor(&self, rel: Rel) -> Option<Head> {
        let mut told: Vec<Noun> = Vec::new();
        self.memory.query.clone()?.each_noun(&mut |noun| {
            let places = noun.restrictions.iter().filter(|place| place.rel == rel);
            told.extend(places.flat_map(|place| place.anchors.clone()));
        });
        let [anchor] = &told[..] else { return None };
        let found = self.find(anchor, true).ok().filter(|found| !found.is_empty())?;
        Some(Head { kinds: vec![self.alike(&found)?], ..Head::default() })
    }

    /// What a pronoun means: what was last spoken of that agrees with it, and may stand in the relation that it is named
    /// in («на нём»).
    pub(super) fn referent(&self, pronoun: Pronoun, rel: Option<Rel>) -> Vec<Thing> {
        let last = &self.memory.last;
        match pronoun {
            // "Is there a towel in the bathroom? – No such thing. – How many paintings are there?": in the bathroom.
            // Nor is anywhere "there" while it is asked back which of several was meant.
            Pronoun::There if self.memory.is_lost || self.memory.pending.is_some() => {
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
                let several =
                    |t: &Thing| self.memory.is_plural || self.gender(*t).1 == Number::Plural;
                self.taken_up(pronoun, rel).into_iter().take(1).filter(several).collect()
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
            let rank = near.clone().find_map(|exchange| {
                if let Some(whither) = exchange.whither().filter(|t| placed && fits(t)) {
                    return Some(vec![whither]);
                }
                let topic = exchange.topics().iter().find(|t| fits(t)).map(|t| vec![*t]);
                let all_of = |all: &[Thing]| -> Vec<Thing> {
                    all.iter().copied().filter(|t| fits(t)).collect()
                };
                let ranks = [exchange.members(), exchange.aside()];
                topic.or_else(|| ranks.into_iter().map(all_of).find(|all| !all.is_empty()))
            });
            rank.unwrap_or_default()
        };
        let found = fitting(&may);
        let found = if found.is_empty() { fitting(&|_| true) } else { found };
        if !found.is_empty() {
            return found;
        }
        let spoken = self.memory.spoken.iter().copied().find(|t| self.agrees(pronoun, *t));
        spoken.into_iter().collect()
    }

    /// What one word in the singular may mean of several: "it" after a list, "that one". Where they are told by name one
    /// by one, all of them are.
    pub(super) fn contested(&self, query: &Query) -> Option<Doubt> {
        if matches!(query, Query::Where(_) | Query::RoomOf(_) | Query::Several(_)) {
            return None;
        }
        let mut doubt = None;
        let single = |noun: &Noun| {
            let words = word_keys(&noun.text);
            let pronoun = match vocabulary::longest(&words) {
                Some((taken, Mark::Pronoun(p))) if taken == words.len() => Some(p),
                _ => None,
            };
            let shown = words.last().is_some_and(|word| word == "one") && is_shown(noun);
            shown || pronoun.is_some_and(|p| !matches!(p, Pronoun::They | Pronoun::There))
        };
        let mut check = |noun: &Noun| {
            let several = noun.head.things.as_deref().filter(|things| things.len() > 1);
            let bare = noun.filters.is_empty()
                && noun.restrictions.is_empty()
                && noun.sizes.is_empty()
                && noun.best.is_none()
                && noun.rank.is_none()
                && !noun.other;
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

    /// Whether something may be on or in a thing.
    pub(super) fn may_be_anchor(&self, rel: Rel, thing: Thing) -> bool {
        let wanted: &[&str] = match rel {
            Rel::On => &["support", "seat", "bed"],
            Rel::In => &["container"],
            _ => return true,
        };
        let has = |id| wanted.iter().any(|wanted| self.world.has_trait(id, wanted));
        match thing.replica() {
            Some(id) => has(id) || !self.related(rel, thing).is_empty(),
            None => rel == Rel::In && thing.area().is_some(),
        }
    }

    /// Genders of the words of the last question that mean the one thing of its answer.
    fn genders_said(&self, thing: Thing) -> Vec<Gender> {
        if self.memory.last != [thing] {
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

    /// What "there" means: where each of several things is that were asked after, else the latest place.
    fn places_spoken_of(&self) -> Vec<Thing> {
        // «Где вилки? Сколько там ложек? А сколько ножей там?»: there as before.
        let mut there = Vec::new();
        if let Some(mut query) = self.memory.query.clone() {
            query.each_noun(&mut |noun| {
                let places = noun.restrictions.iter().filter(|place| place.rel == Rel::There);
                let things = places.flat_map(|place| &place.anchors);
                there.extend(things.filter_map(|anchor| anchor.head.things.clone()).flatten());
            });
        }
        if there.len() > 1 && self.memory.told_place.is_none() {
            return there;
        }
        let last = &self.memory.last;
        let each = last.len() > 1 && self.memory.told_place.is_none() && self.asked_where();
        let places: BTreeSet<Thing> = match each {
            true => last.iter().filter_map(|thing| self.place_of(*thing)).collect(),
            false => self.place_spoken_of().into_iter().collect(),
        };
        places.into_iter().collect()
    }

    /// Whether the last question was where something is.
    fn asked_where(&self) -> bool {
        matches!(self.memory.query, Some(Query::Where(_)))
    }

    /// What bears or holds a thing, else its room.
    fn place_of(&self, thing: Thing) -> Option<Thing> {
        let support = thing.replica().and_then(|id| self.relations.support_of(id));
        let support = support.map(|id| Thing::Entity(Entity::Replica(id)));
        support.or_else(|| self.area_of(thing).map(|id| Thing::Entity(Entity::Area(id))))
    }

    /// «Где тарелки? Сколько там стульев?»: what stands on the floor is not where they lie, but in the rooms of that.
    fn rooms_there(&self, noun: &mut Noun) {
        let sought = self.base(&noun.head);
        let carried = |t: &Thing| t.replica().is_none_or(|id| self.world.has_trait(id, "portable"));
        let there = noun.restrictions.iter_mut().filter(|place| place.rel == Rel::There);
        for anchor in there.flat_map(|place| &mut place.anchors) {
            let Some(places) = anchor.head.things.as_deref() else { continue };
            let lies = |place: &Thing| self.related(Rel::There, *place);
            let fits = places.iter().flat_map(lies).any(|thing| sought.contains(&thing));
            if fits || sought.is_empty() || sought.iter().any(carried) {
                continue;
            }
            let rooms: BTreeSet<Thing> = places
                .iter()
                .map(|place| match self.area_of(*place) {
                    Some(room) => Thing::Entity(Entity::Area(room)),
                    None => *place,
                })
                .collect();
            anchor.head.things = Some(rooms.into_iter().collect());
        }
    }

    /// The latest place that was spoken of: a room or what bears things; else where the latest thing is.
    fn place_spoken_of(&self) -> Option<Thing> {
        // "I put the bottle in the bathroom, is it there?"
        if self.memory.told_place.is_some() {
            return self.memory.told_place;
        }
        let opens = |thing: &Thing| self.opening(*thing).is_some();
        let bears = |thing: Thing| {
            !opens(&thing)
                && thing.replica().is_none_or(|id| {
                    ["support", "container"].iter().any(|wanted| self.world.has_trait(id, wanted))
                })
        };
        // "Which floor is the storeroom on? What is in there?": in the storeroom.
        let asked = matches!(self.memory.query, Some(Query::RoomOf(_)));
        let topic = || self.memory.exchanges.first().and_then(Exchange::topic);
        if let Some(room) = asked.then(topic).flatten().filter(|t| t.area().is_some()) {
            return Some(room);
        }
        // «Что на кухне?» lists things there; the kitchen is the place.
        let latest = self.memory.exchanges.first().filter(|e| !e.members().is_empty());
        if let Some(place) = latest.and_then(|e| e.topics().iter().copied().find(|t| bears(*t))) {
            return Some(place);
        }
        let latest = *self.memory.spoken.iter().find(|thing| !opens(thing))?;
        // «Где кружка и что ещё там лежит?»: where the cup is, not in it.
        let placed = matches!(self.memory.query, Some(Query::Where(_) | Query::RoomOf(_)));
        let told = placed && self.memory.last.contains(&latest) || !bears(latest);
        let Some(id) = latest.replica().filter(|_| told) else { return Some(latest) };
        self.place_of(Thing::Entity(Entity::Replica(id))).or(Some(latest))
    }
}

/// Whether a description shows one thing: "that shelf", «эта лампа».
pub(super) fn is_shown(noun: &Noun) -> bool {
    const SHOWING: [&str; 12] = [
        "this",
        "that",
        "эта",
        "этот",
        "это",
        "эту",
        "этой",
        "этом",
        "этого",
        "этому",
        "этим",
        "этою",
    ];
    let keys = word_keys(&noun.text);
    keys.len() > 1 && SHOWING.contains(&keys[0].as_str())
}

/// Whether a description means one thing and does not tell by itself which.
fn is_one(noun: &Noun) -> bool {
    !(noun.plural
        || noun.indefinite
        || noun.all
        || noun.other
        || noun.head.anything
        || noun.head.things.is_some()
        || noun.count.is_some()
        || noun.best.is_some())
}
