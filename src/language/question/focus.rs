//! What a dialogue is about: which of several things a description means that was just spoken of.
//!
//! Invariant: nothing is taken for meant that the last few exchanges did not name; where they name several of one rank
//! that fit, it is asked back.

use std::collections::{BTreeSet, HashSet};

use super::grammar::{are_shown, points};
use super::knowledge::Knowledge;
use super::mark::Mark;
use super::memory::Exchange;
use super::query::{Best, Claim, Extreme, Head, Noun, Query, Rel, Restriction, Thing};
use super::{Doubt, vocabulary};
use crate::map::Entity;
use crate::sets::{Set, set};
use crate::words::word_keys;

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

    /// «Сколько ламп в спальне? Нет, я про другую спальню»: the one of some things by which the last question was asked, and which
    /// its answer is not about.
    pub(super) fn asked_by(&self, found: &[Thing]) -> Option<Thing> {
        let mut named = Vec::new();
        self.memory.query.clone()?.each_noun(&mut |noun| {
            let own = noun.head.named.iter().map(|entity| Thing::Entity(*entity));
            let own: Vec<Thing> = own.chain(noun.head.things.iter().flatten().copied()).collect();
            named
                .extend(own.first().copied().filter(|only| own.len() == 1 && found.contains(only)));
        });
        named.dedup();
        named.first().copied().filter(|_| named.len() == 1)
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

    /// "Is there a medicine cabinet?": a thing that is called after another, where none of its kind is near such a one, may be
    /// there under another name. So may "the book glass": a book is no place by which a glass is known.
    pub(super) fn unknown_compound(&self, query: &Query) -> Option<String> {
        let mut compound = None;
        query.clone().each_noun(&mut |noun| {
            let anchors = noun.restrictions.iter().flat_map(|r| &r.anchors);
            let modifying: Vec<&Noun> = anchors.filter(|anchor| anchor.modifies).collect();
            let found = || self.find(noun, true).unwrap_or_default();
            let is_placed = modifying.iter().all(|anchor| self.is_place_of_things(anchor));
            if !modifying.is_empty() && (!is_placed || found().is_empty()) {
                compound.get_or_insert_with(|| without_article(&noun.text).to_owned());
            }
        });
        compound
    }

    /// «левый кабинет номер 5»: of what a name means alone none is the leftmost; the word tells of another, or of its name.
    pub(super) fn foremost_of_one(&self, query: &Query) -> Option<String> {
        let mut word = None;
        query.clone().each_noun(&mut |noun| {
            if is_foremost_of_one(noun) {
                word.get_or_insert_with(|| without_article(&noun.text).to_owned());
            }
        });
        word
    }

    /// Whether things may be told by where they are to such a one: not where it is only carried about itself, nor to a
    /// person: "nurse desks" are a sort.
    fn is_place_of_things(&self, noun: &Noun) -> bool {
        let has = |id, wanted| self.world.has_trait(id, wanted);
        let carried = |t: &Thing| {
            t.replica().is_some_and(|id| {
                let carried = has(id, "portable") && !has(id, "container") && !has(id, "support");
                carried || has(id, "person")
            })
        };
        !self.base(&noun.head).iter().any(carried)
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
            // "Which one is in the kitchen?", of all that there is.
            let bare = noun.restrictions.is_empty() && noun.filters.is_empty();
            let seeks = matches!(query, Query::Find(_) | Query::Count(_) | Query::Where(_));
            let placed = !seeks && !bare;
            let unsaid = points(noun) && noun.head.anything && !placed;
            if unsaid && noun.head.things.is_none() && noun.except.is_empty() {
                word.get_or_insert_with(|| noun.text.clone());
            }
            let missing = |noun: &Noun| noun.head.things.as_deref() == Some(&[]);
            let anchors = || noun.restrictions.iter().flat_map(|place| &place.anchors);
            let unshown = are_shown(noun)
                && noun.head.things.is_none()
                && !matches!(query, Query::Where(_) | Query::RoomOf(_))
                && self.base(&noun.head).len() > 1;
            if unshown || is_shown(noun) && (lacks || robots && elsewhere()) {
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
        self.rooms_for_points(query);
        self.doors_of_what_shuts(query);
        self.is_among_those(query);
        if self.memory.exchanges.is_empty() && self.memory.listed.is_empty() {
            query.each_noun(&mut |noun| {
                self.room_beside_room(noun);
                self.this_room(&mut noun.restrictions);
            });
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
        query.each_noun(&mut |noun| {
            self.of_those_told(noun);
            self.of_those_shown(noun);
        });
        query.each_noun(&mut |noun| {
            self.rooms_there(noun);
            self.in_its_room(noun);
        });
        query.each_noun(&mut |noun| {
            self.room_beside_room(noun);
            self.places_there_alone(noun);
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
                // "Which ones are not on the bed?": of those, as what is denied leads to no others.
                let any = word_keys(&noun.text).len() == 1 && !noun.denies();
                noun.head = match self.alike(&things).filter(|_| any) {
                    Some(kind) => Head { kinds: vec![kind], ..Head::default() },
                    None => Head { things: Some(things), ..Head::default() },
                };
            }
        });
        self.put_together(query);
        self.keep_room(query);
        self.in_no_room_itself(query);
        self.found_where(query);
        self.by_state(query);
        self.resume(query);
        self.most_of_their_kind(query);
        self.out_of_its_room(query);
        query.each_noun(&mut rooms_have);
        // «Сколько их всего?» of one thing: how many of its kind there are.
        if let Query::Count(noun) = query
            && let Some(things @ ([only] | [_, only])) = noun.head.things.as_deref()
            && self.memory.last.len() < 2
            && !noun.sums()
            && (noun.text.is_empty() || is_pronoun(noun))
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
    pub(super) fn found_nothing(&self) -> bool {
        let sought = self.memory.query.as_ref().is_some_and(|query| query.sought().is_some());
        sought && self.memory.last.is_empty()
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

    fn focus_places(&self, restrictions: &mut [Restriction]) {
        // "Which sofa …? What is on it? And on the first one?": of those that can have something on them.
        for place in restrictions.iter_mut() {
            let rel = place.rel;
            let bear = |e: &&Exchange| {
                e.members().len() > 1 && e.members().iter().all(|t| self.may_be_anchor(rel, *t))
            };
            let told = self.memory.exchanges.iter().find(bear);
            for anchor in place.anchors.iter_mut().filter(|a| points(a) && a.other) {
                if matches!(rel, Rel::On | Rel::In) {
                    let things = Some(self.other_place(rel));
                    anchor.head = Head { things, ..Head::default() };
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
                // The most of nothing that is counted: "Which are more?"
                let most = |best: &Best| {
                    best.anchor.is_none() && matches!(best.extreme, Extreme::Most | Extreme::Fewest)
                };
                if noun.best.as_ref().is_some_and(most) {
                    return true;
                }
                let ones = words.last().is_some_and(|word| set!("OneOrOnes").contains(&&**word));
                let itself = matches!(noun.head.things.as_deref(), Some([_])) && is_pronoun(noun)
                    || ones && noun.head.things.is_some();
                floors(noun) || itself && bare == Noun::default()
            }
            Query::Count(noun) | Query::Where(noun) => floors(noun),
            // "On what floors?", of nothing: a storey is in no room and on nothing.
            Query::RoomOf(noun) | Query::Anchor { of: noun, .. } => {
                let base = self.base(&noun.head);
                !base.is_empty() && base.iter().all(Thing::is_storey)
            }
            Query::Several(queries) => queries.iter().any(|query| self.tells_nothing(query)),
            Query::Exists { what, .. } => what.iter().any(floors),
            _ => false,
        }
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
}

/// «Какие комнаты есть? В какой из них нет окон?»: they are rooms, and rooms have what furniture bears.
fn rooms_have(noun: &mut Noun) {
    let are_rooms = |things: &Vec<Thing>| things.iter().all(|thing| thing.area().is_some());
    if noun.head.things.as_ref().is_some_and(are_rooms) {
        let bearing = noun.restrictions.iter_mut().filter(|told| told.rel == Rel::Bears);
        bearing.for_each(|told| told.rel = Rel::Has);
    }
}

/// Whether no word but a pronoun says what is meant.
fn is_pronoun(noun: &Noun) -> bool {
    let words = word_keys(&noun.text);
    let said = vocabulary::longest(&words);
    matches!(said, Some((taken, Mark::Pronoun(_))) if taken == words.len())
}

/// Whether a description shows one thing: "that shelf", «эта лампа».
pub(super) fn is_shown(noun: &Noun) -> bool {
    static SHOWING: Set = Set::named("Showing");
    let keys = word_keys(&noun.text);
    keys.len() > 1 && SHOWING.contains(&keys[0].as_str())
}

/// Whether a description means one thing and does not tell by itself which.
pub(super) fn is_one(noun: &Noun) -> bool {
    !(noun.plural
        || noun.indefinite
        || noun.all
        || noun.other
        || noun.head.anything
        || noun.head.things.is_some()
        || noun.count.is_some()
        || noun.best.is_some())
}

pub(super) fn without_article(said: &str) -> &str {
    let article = |(first, rest): (&str, &str)| {
        set!("TheOrA").contains(&&*first.to_lowercase()).then_some(rest.len())
    };
    let rest = said.split_once(' ').and_then(article);
    rest.map_or(said, |rest| &said[said.len() - rest..])
}

/// Whether a superlative stands with the name of one thing.
pub(super) fn is_foremost_of_one(noun: &Noun) -> bool {
    let is_name = noun.head.kinds.is_empty() && noun.head.named.len() == 1;
    noun.best.is_some() && is_name && noun.head.things.is_none() && noun.also.is_empty()
}
