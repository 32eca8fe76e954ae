//! What a dialogue remembers: what was spoken of, what was asked and answered last, and what waits for a reply.
//!
//! Invariant: it belongs to one state of the map (`outlive`).

use std::collections::BTreeSet;
use std::ops::Range;

use super::departed::{Departed, Stamp};
use super::doubt::Doubt;
use super::query::{Noun, Query, Thing};
use super::{Answer, Fact};
use crate::map::Entity;
use crate::units::Bilingual;
use crate::words::Language;

/// What was said so far in a dialogue.
#[derive(Debug, Clone, Default)]
pub struct Memory {
    /// In which language was last spoken: that of an answer to what has no words.
    pub(super) language: Language,
    /// What was spoken of, the latest first.
    pub(super) spoken: Vec<Thing>,
    /// What the last exchanges were about, the latest first.
    pub(super) exchanges: Vec<Exchange>,
    /// Whether what was spoken of last was called by a plural: «таблетки» may be one thing.
    pub(super) is_plural: bool,
    /// Whether the one thing that was spoken of last is all that a plural names: "them" are none of a list in which it was told.
    pub(super) is_whole: bool,
    /// The place that a person has told before asking of "there".
    pub(super) told_place: Option<Thing>,
    /// Whether the last question named what the map lacks: a pronoun means nothing that is known.
    pub(super) is_lost: bool,
    /// The things of the last answer.
    pub(super) last: Vec<Thing>,
    /// The last several things that an answer told, in its order: «вторую» counts them.
    pub(super) listed: Vec<Thing>,
    /// What orders took of them since.
    pub(super) taken: Taken,
    pub(super) facts: Vec<Fact>,
    /// Whether what was asked last is so.
    pub(super) so: Option<bool>,
    /// What the last answer said, for a "why" that rests on no fact.
    pub(super) said: Option<String>,
    /// The words of the last question: who asked for a «софа» calls a «Диван» «она».
    pub(super) words: String,
    /// What the last questions counted, the latest first: «А где больше?»
    pub(super) counted: Vec<Noun>,
    /// What was asked last, for «А чайник?»
    pub(super) query: Option<Query>,
    /// The last question, where it named what the map lacks, with the words for that.
    pub(super) unheard: Option<(String, String)>,
    /// A question that waits for the person to say which thing was meant.
    pub(super) pending: Option<Pending>,
    /// A command that waits for the same.
    pub(super) waiting: Option<Waiting>,
    /// The command that was understood last, for «А теперь другую».
    pub(super) ordered: Option<Ordered>,
    /// Where the person has said to be.
    pub(super) person: Option<Entity>,
    /// The words in which the person has told where it is, where these come to no place.
    pub(super) astray: Option<String>,
    /// Where the robot was when it was last told to bring something: with the person.
    pub(super) called_from: Option<Thing>,
    /// Where the robot was when it was last told something.
    pub(super) stands: Option<Thing>,
    /// Where the robot was before it was last sent away.
    pub(super) left: Option<Thing>,
    /// The same, where it left the map since.
    pub(super) left_departed: Option<Departed>,
    /// The last command that was carried out, and what it came to.
    pub(super) done: Option<Bilingual>,
    /// Whether an order was heard last.
    pub(super) is_ordered: bool,
    /// The state of the map to which all this belongs.
    pub(super) stamp: Option<Stamp>,
    /// What was spoken of and left the map since.
    pub(super) departed: Vec<Departed>,
    /// Whether the map has changed since the last answer.
    pub(super) is_outdated: bool,
}

/// What orders took of a list, one after the other, and not by its number there.
#[derive(Debug, Clone, Default)]
pub(super) struct Taken {
    list: Vec<Thing>,
    things: Vec<Thing>,
    /// Each was any of those that were left.
    is_any: bool,
}

impl Taken {
    /// What was taken of this list; of another, nothing.
    fn of(&self, list: &[Thing]) -> &[Thing] {
        match self.list == list {
            true => &self.things,
            false => &[],
        }
    }
}

#[derive(Debug, Clone)]
pub(super) struct Pending {
    pub(super) query: Query,
    pub(super) language: Language,
    pub(super) reference: String,
    pub(super) candidates: Vec<Thing>,
}

/// A command that waits for the person to say which thing was meant.
#[derive(Debug, Clone)]
pub(super) struct Waiting {
    pub(super) text: String,
    /// Bytes of the description.
    pub(super) at: Range<usize>,
    pub(super) candidates: Vec<Thing>,
    pub(super) language: Language,
}

/// A command that was understood, for what amends it.
#[derive(Debug, Clone)]
pub(super) struct Ordered {
    pub(super) text: String,
    /// Bytes of what it was done to, and the things.
    pub(super) object: Option<(Range<usize>, Vec<Thing>)>,
    /// Bytes of what told where things were.
    pub(super) told: Vec<Range<usize>>,
    /// Bytes of whither, with the preposition.
    pub(super) goal: Option<Range<usize>>,
    /// Whether the things are those that were meant, and not all that the words may mean.
    pub(super) is_resolved: bool,
    pub(super) language: Language,
}

impl Memory {
    /// Nothing was said yet, and who has no words is answered in this language.
    #[must_use]
    pub fn speaking(language: Language) -> Self {
        Self { language, ..Self::default() }
    }

    /// Notes a command that can go on once a name in it is known to mean one of some things.
    pub fn wait(
        &mut self,
        text: &str,
        at: Range<usize>,
        candidates: Vec<Thing>,
        language: Language,
    ) {
        self.waiting = Some(Waiting { text: text.to_owned(), at, candidates, language });
    }

    /// Whether a command or a question waits for the person to say which thing was meant.
    #[must_use]
    pub fn awaits_reply(&self) -> bool {
        self.waiting.is_some() || self.pending.is_some()
    }

    /// The things one of which a command is to be done to, as soon as the person says which.
    #[must_use]
    pub fn asked_about(&self) -> &[Thing] {
        self.waiting.as_ref().map_or(&[], |waiting| &waiting.candidates)
    }

    /// Drops what waits for a reply.
    pub fn forget_reply(&mut self) {
        self.waiting = None;
        self.pending = None;
    }

    /// The single thing spoken of last, for «её» in a command.
    #[must_use]
    pub fn last_thing(&self) -> Option<Thing> {
        self.spoken.first().copied()
    }

    /// Where the robot was before it was last sent away.
    #[must_use]
    pub fn place_left(&self) -> Option<Thing> {
        self.left
    }

    /// Notes where the robot is as it is told something. Who has not moved since the order before was not sent away by it.
    pub fn stand(&mut self, place: Thing) {
        match self.stands.replace(place) {
            Some(before) if before != place || self.left.is_none() => {
                (self.left, self.left_departed) = (Some(before), None);
            }
            _ => {}
        }
    }

    /// Notes where the robot is as it is told to bring something thither.
    pub fn bring_to(&mut self, place: Thing) {
        self.called_from = Some(place);
    }

    /// Where the person is who says "here": where he has said to be, else where something was to be brought to him.
    #[must_use]
    pub fn place_of_speaker(&self) -> Option<Thing> {
        self.person.map(Thing::Entity).or(self.called_from)
    }

    /// Whether what was asked last is so; none where it was not asked whether.
    #[must_use]
    pub fn is_so(&self) -> Option<bool> {
        self.so
    }

    /// Notes what a command came to, for "What did you do?".
    pub fn did(&mut self, told: Bilingual) {
        self.done = Some(told);
    }

    /// Remembers what an answer was about.
    pub fn learn(&mut self, answer: &Answer) {
        self.pending = None;
        self.unheard = None;
        self.told_place = None;
        (self.is_outdated, self.is_ordered) = (false, false);
        if !matches!(answer.query, Query::Why { .. } | Query::Courtesy(_)) {
            self.so = answer.is_so();
            self.facts.clone_from(&answer.facts);
            self.said = Some(answer.text.clone());
            match &answer.query {
                // A sum takes the place of what it sums.
                Query::Count(noun) if noun.sums() => self.counted = vec![noun.clone()],
                Query::Count(noun) => self.counted.insert(0, noun.clone()),
                Query::MoreOf { .. } => {}
                _ => self.counted.clear(),
            }
            self.counted.truncate(20);
            self.query = Some(answer.query.clone());
            self.words.clone_from(&answer.words);
        }
        self.is_plural = false;
        answer.query.clone().each_noun(&mut |noun| self.is_plural |= noun.plural);
        self.hear(answer);
        if answer.topic.is_empty() {
            return;
        }
        self.last.clone_from(&answer.things);
        let told = answer.topic.iter().filter(|t| !answer.things.contains(t));
        let told: Vec<Thing> = told.copied().collect();
        // «Где чашка?» of two, of which both were told: «Красная» tells which one was meant.
        let candidates = match &answer.query {
            Query::Where(_) => answer.things.clone(),
            _ => told.clone(),
        };
        if let Query::Where(noun) | Query::RoomOf(noun) = &answer.query
            && noun.means_one()
            && candidates.len() > 1
        {
            self.is_plural = true;
            self.pending = Some(Pending {
                query: answer.query.clone(),
                language: answer.language,
                reference: noun.text.clone(),
                candidates,
            });
        }
        // "How far is the toolbox from the battery? Which of them is higher up?"
        if answer.things.is_empty() {
            self.last.clone_from(&answer.compared);
        }
        // "Where do the doors lead? Which of them is wider?", "What do the books lie on? Where are they?"
        let keeps = match &answer.query {
            Query::Leads(_) => true,
            query => is_of_whereabouts(query) && answer.things.len() < 2 && told.len() > 1,
        };
        if keeps {
            self.last = told;
        }
        if self.last.len() > 1 {
            self.listed.clone_from(&self.last);
            self.taken = Taken::default();
        }
        for thing in answer.topic.iter().rev() {
            self.spoken.retain(|t| t != thing);
            self.spoken.insert(0, *thing);
        }
        self.spoken.truncate(50);
    }

    /// Notes what a command is done to, on or in what that is before it, and whither it goes: "there" afterwards, and «на нём» of
    /// what may bear things.
    pub fn order(&mut self, things: &[Thing], whence: &[Thing], places: &[Thing]) {
        let things = &*each_once(things);
        self.mention(things);
        (self.is_plural, self.is_ordered) = (things.len() > 1, true);
        if let Some(exchange) = self.exchanges.first_mut().filter(|_| !things.is_empty()) {
            let others = whence.iter().filter(|place| !things.contains(place));
            exchange.aside.extend(others);
        }
        let Some(place) = places.last() else { return };
        self.told_place = Some(*place);
        let own = places.iter().rev().filter(|place| !things.contains(place));
        match self.exchanges.first_mut().filter(|_| !things.is_empty()) {
            Some(exchange) => {
                for place in own {
                    // Several things may go to one place.
                    if !exchange.topics.contains(place) {
                        exchange.topics.push(*place);
                    }
                }
                exchange.whither = Some(*place);
            }
            None => self.hear_of_things(places),
        }
    }

    /// An order was not understood: «А в ванной?» goes on from no question before it.
    pub fn mishear(&mut self) {
        (self.query, self.pending) = (None, None);
        self.counted.clear();
    }

    /// Notes the things that a command named.
    pub fn mention(&mut self, things: &[Thing]) {
        // "Take it to the bedroom and put it on the dresser" names one thing twice, which is no list.
        let things = &*each_once(things);
        self.hear_of_things(things);
        self.last = things.to_vec();
        if things.len() > 1 {
            self.listed = things.to_vec();
        }
        for thing in things {
            self.spoken.retain(|t| t != thing);
            self.spoken.insert(0, *thing);
        }
    }

    /// All that the last answer or order was about, and the last list.
    pub(super) fn told_of(&self) -> Vec<Thing> {
        let latest = self.exchanges.first().into_iter().flat_map(Exchange::things);
        let all: BTreeSet<Thing> = latest.chain(&self.listed).chain(&self.last).copied().collect();
        all.into_iter().collect()
    }

    /// What was spoken of by itself since the last list, the earliest first.
    pub(super) fn in_turn(&self, fits: impl Fn(&Thing) -> bool) -> Vec<Thing> {
        let told = |thing: &Thing| self.listed.contains(thing);
        let since = self.exchanges.iter().take_while(|exchange| {
            !self.listed.iter().all(|thing| exchange.things().any(|other| other == thing))
                || self.listed.is_empty()
        });
        let mut things: Vec<Thing> = Vec::new();
        for topic in since.filter_map(Exchange::topic) {
            if fits(&topic) && !told(&topic) && !things.contains(&topic) {
                things.insert(0, topic);
            }
        }
        things
    }

    /// Those of the last list that its Nth may be: by its order, or by that in which orders took of it. Two are meant by a number
    /// that counts differently in the two, and all that are left where it is one that was taken.
    pub(super) fn numbered(&self, at: usize) -> Vec<Thing> {
        let (list, taken) = (&self.listed, self.taken.of(&self.listed));
        let other = match (&list[..], taken) {
            ([_, _], [only]) if at == 1 => list.iter().find(|thing| *thing != only),
            _ => None,
        };
        let told =
            list.get(at).filter(|_| !self.taken.is_any || list.len() > 2 || taken.is_empty());
        let in_turn = taken.get(at).or(other);
        match (told, in_turn) {
            (Some(told), Some(in_turn)) if told != in_turn => vec![*told, *in_turn],
            (Some(told), None) if taken.contains(told) => {
                list.iter().copied().filter(|thing| !taken.contains(thing)).collect()
            }
            (told, in_turn) => told.or(in_turn).copied().into_iter().collect(),
        }
    }

    /// Whether orders took any of the last list, and not by its number.
    pub(super) fn has_taken(&self) -> bool {
        !self.taken.of(&self.listed).is_empty()
    }

    /// Notes that an order takes one of the last list, by its name or as any of them.
    pub(super) fn take(&mut self, thing: Thing, is_any: bool) {
        if self.listed.len() < 2 || !self.listed.contains(&thing) {
            return;
        }
        if self.taken.of(&self.listed).is_empty() {
            self.taken = Taken { list: self.listed.clone(), is_any: true, things: Vec::new() };
        }
        self.taken.is_any &= is_any;
        if !self.taken.things.contains(&thing) {
            self.taken.things.push(thing);
        }
    }

    /// Notes several things, none of which is more spoken of than the others.
    pub(super) fn list(&mut self, things: &[Thing]) {
        match &each_once(things)[..] {
            [] => {}
            [only] => self.mention(&[*only]),
            things => {
                self.mention(things);
                if let Some(exchange) = self.exchanges.first_mut() {
                    *exchange = Exchange::list(things);
                }
                self.listed = things.to_vec();
            }
        }
    }

    /// Notes that one of several things was meant, and which was not told.
    pub(super) fn waver(&mut self, things: &[Thing]) {
        self.last.clear();
        self.listed.clear();
        self.follow(Exchange::list(things));
    }

    /// What "them" means in a command, the one that "it" means at the end.
    #[must_use]
    pub fn last_things(&self) -> Vec<Thing> {
        let Some(first) = self.spoken.first() else { return self.last.clone() };
        let mut things = match self.last.contains(first) {
            true => self.last.clone(),
            false => Vec::new(),
        };
        things.retain(|t| t != first);
        things.push(*first);
        things
    }
}

/// Things in their order, each once.
fn each_once(things: &[Thing]) -> Vec<Thing> {
    let mut each: Vec<Thing> = Vec::new();
    for thing in things {
        if !each.contains(thing) {
            each.push(*thing);
        }
    }
    each
}

/// So many exchanges back a description is still understood by what was spoken of.
const RECENT: usize = 4;

/// What one question and its answer, or an order, were about.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Exchange {
    /// What a singular pronoun takes up, in this order.
    topics: Vec<Thing>,
    /// So many at the end of them only told where something is.
    only_places: usize,
    /// The members of a list, none of which is more spoken of than the others.
    listed: Vec<Thing>,
    /// Whither an order went: "on it" is on that before it is on what was carried.
    whither: Option<Thing>,
    /// What was measured against each other: each is "the other one" of the rest.
    compared: Vec<Thing>,
    /// What a list was asked after by, and what bore what an order takes: "it" is no such thing, but what lies on something may be
    /// on that.
    aside: Vec<Thing>,
}

/// Whether what is found is where things are, and they are what is spoken of.
pub(super) fn is_of_whereabouts(query: &Query) -> bool {
    match query {
        Query::Anchor { .. } | Query::RoomOf(_) => true,
        Query::Several(all) => all.iter().all(is_of_whereabouts),
        _ => false,
    }
}

impl Exchange {
    fn of(answer: &Answer) -> Self {
        let others = || answer.topic.iter().filter(|t| !answer.things.contains(t)).copied();
        let found = answer.things.iter().copied();
        let mut plural = false;
        answer.query.clone().first_noun(|noun| {
            // "What do they lie on?"
            plural = noun.plural || noun.head.things.as_ref().is_some_and(|all| all.len() > 1);
        });
        plural |= matches!(answer.query, Query::Several(_));
        match &answer.query {
            // "Which rooms are the mugs in?": an order is of none of them more than of the others.
            query if is_of_whereabouts(query) && plural && others().count() > 1 => {
                let topics = others().chain(found).collect();
                Self { topics, listed: others().collect(), ..Self::default() }
            }
            // "Which room is the juice in?" of two: "it" is neither of them.
            Query::RoomOf(noun) if noun.means_one() && others().count() > 1 => {
                Self { listed: others().collect(), aside: found.collect(), ..Self::default() }
            }
            // "What is the lamp on?" goes on being about the lamp.
            Query::Anchor { .. } | Query::RoomOf(_) | Query::Leads(_) => {
                Self { topics: others().chain(found).collect(), ..Self::default() }
            }
            // "Is the milk in the fridge? Where is it then?": the milk, however many packs of it there are.
            Query::Holds { .. } | Query::Choice { .. } if answer.things.len() > 1 => Self {
                listed: answer.things.clone(),
                aside: others().collect::<BTreeSet<Thing>>().into_iter().collect(),
                ..Self::default()
            },
            // "What else is there?": the place was not called by a name.
            query if answer.things.len() > 1 && query.is_of_there() => {
                Self { listed: answer.things.clone(), aside: others().collect(), ..Self::default() }
            }
            _ if answer.things.len() > 1 => Self {
                topics: others().collect(),
                listed: answer.things.clone(),
                compared: answer.compared.clone(),
                ..Self::default()
            },
            query => Self {
                topics: found.chain(others()).collect(),
                only_places: if matches!(query, Query::Where(_)) { others().count() } else { 0 },
                compared: answer.compared.clone(),
                ..Self::default()
            },
        }
    }

    /// Several things alike.
    pub(super) fn list(things: &[Thing]) -> Self {
        Self { listed: things.to_vec(), ..Self::default() }
    }

    /// What it was most about.
    pub(super) fn topic(&self) -> Option<Thing> {
        self.topics.first().copied()
    }

    /// Whether a thing was spoken of only to tell where another one is.
    pub(super) fn is_only_place(&self, thing: Thing) -> bool {
        self.topics.iter().rev().take(self.only_places).any(|told| *told == thing)
    }

    /// What a singular pronoun takes up, in this order.
    pub(super) fn topics(&self) -> &[Thing] {
        &self.topics
    }

    /// The members of a list that was told.
    pub(super) fn members(&self) -> &[Thing] {
        &self.listed
    }

    /// Whither an order went.
    pub(super) fn whither(&self) -> Option<Thing> {
        self.whither
    }

    /// What was measured against each other.
    pub(super) fn compared(&self) -> &[Thing] {
        &self.compared
    }

    /// All that it was about.
    pub(super) fn things(&self) -> impl Iterator<Item = &Thing> {
        self.topics.iter().chain(&self.listed).chain(&self.aside)
    }

    /// What a list was asked after by.
    pub(super) fn aside(&self) -> &[Thing] {
        &self.aside
    }

    fn is_empty(&self) -> bool {
        self.topics.is_empty() && self.listed.is_empty()
    }
}

impl Memory {
    /// Notes what an answer was about.
    pub(super) fn hear(&mut self, answer: &Answer) {
        self.follow(Exchange::of(answer));
    }

    /// Notes what an order names, the last of which is spoken of most.
    pub(super) fn hear_of_things(&mut self, things: &[Thing]) {
        let topics = things.iter().rev().copied().collect();
        self.follow(Exchange { topics, ..Exchange::default() });
    }

    fn follow(&mut self, exchange: Exchange) {
        (self.is_lost, self.is_whole) = (false, false);
        if !exchange.is_empty() {
            self.exchanges.insert(0, exchange);
            self.exchanges.truncate(RECENT);
            if self.exchanges.len() == RECENT {
                self.departed.clear();
            }
        }
    }

    /// The one of several things that was spoken of by itself before they were listed.
    pub(super) fn topic_among(&self, listed: &[Thing]) -> Option<Thing> {
        let before = self.exchanges.iter().flat_map(|exchange| &exchange.topics);
        let mut named = before.filter(|t| listed.len() > 1 && listed.contains(t));
        let first = named.next()?;
        named.all(|t| t == first).then_some(*first)
    }

    /// Notes that a question had no answer. Where it named nothing that is known, pronouns mean from now on what it was about.
    pub(super) fn miss(&mut self, doubt: &Doubt, names_nothing: bool) {
        (self.facts, self.said, self.told_place) = (Vec::new(), None, None);
        (self.so, self.is_ordered) = (None, false);
        // "By the book, do you mean …? – Is it open?" means one of those.
        if let Doubt::Ambiguous { candidates, .. } = doubt {
            // A reply is to what was asked back last.
            if self.waiting.take().is_some() {
                self.ordered = None;
            }
            self.exchanges.insert(0, Exchange::list(candidates));
            self.exchanges.truncate(RECENT);
            return;
        }
        // What was asked is understood, and still spoken of.
        if matches!(doubt, Doubt::Past { .. }) {
            return;
        }
        // "And on the bed?" goes on from what was not understood, and not from the question before it.
        self.query = None;
        self.counted.clear();
        self.is_lost |= matches!(doubt, Doubt::NoReferent { .. }) || names_nothing;
        if names_nothing {
            self.exchanges.clear();
            self.spoken.clear();
            self.last.clear();
            self.listed.clear();
        }
    }
}
