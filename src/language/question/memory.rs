//! What a dialogue remembers: what was spoken of, what was asked and answered last, and what waits for a reply.
//!
//! Invariant: it belongs to one state of the map (`outlive`).

use super::outlive::{Departed, Stamp};
use super::query::{Noun, Query, Thing};
use super::{Answer, Fact, focus, resolution};
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
    pub(super) exchanges: Vec<focus::Exchange>,
    /// Whether what was spoken of last was called by a plural: «таблетки» may be one thing.
    pub(super) is_plural: bool,
    /// The place that a person has told before asking of "there".
    pub(super) told_place: Option<Thing>,
    /// Whether the last question named what the map lacks: a pronoun means nothing that is known.
    pub(super) is_lost: bool,
    /// The things of the last answer.
    pub(super) last: Vec<Thing>,
    /// The last several things that an answer told, in its order: «вторую» counts them.
    pub(super) listed: Vec<Thing>,
    pub(super) facts: Vec<Fact>,
    /// What the last answer said, for a "why" that rests on no fact.
    pub(super) said: Option<String>,
    /// The words of the last question: who asked for a «софа» calls a «Диван» «она».
    pub(super) words: String,
    /// What the last questions counted, the latest first: «А где больше?»
    pub(super) counted: Vec<Noun>,
    /// What was asked last, for «А чайник?»
    pub(super) query: Option<Query>,
    /// A question that waits for the person to say which thing was meant.
    pub(super) pending: Option<Pending>,
    /// A command that waits for the same.
    pub(super) waiting: Option<resolution::Waiting>,
    /// The command that was understood last, for «А теперь другую».
    pub(super) ordered: Option<resolution::Ordered>,
    /// Where the robot was before it was last sent away.
    pub(super) left: Option<Thing>,
    /// The same, where it left the map since.
    pub(super) left_departed: Option<Departed>,
    /// The last command that was carried out, and what it came to.
    pub(super) done: Option<Bilingual>,
    /// The state of the map to which all this belongs.
    pub(super) stamp: Option<Stamp>,
    /// What was spoken of and left the map since.
    pub(super) departed: Vec<Departed>,
    /// Whether the map has changed since the last answer.
    pub(super) is_outdated: bool,
}

#[derive(Debug, Clone)]
pub(super) struct Pending {
    pub(super) query: Query,
    pub(super) language: Language,
    pub(super) reference: String,
    pub(super) candidates: Vec<Thing>,
}

impl Memory {
    /// Nothing was said yet, and who has no words is answered in this language.
    #[must_use]
    pub fn speaking(language: Language) -> Self {
        Self { language, ..Self::default() }
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

    /// Notes where the robot is while it is sent away.
    pub fn leave(&mut self, place: Thing) {
        (self.left, self.left_departed) = (Some(place), None);
    }

    /// Notes what a command came to, for "What did you do?".
    pub fn did(&mut self, told: Bilingual) {
        self.done = Some(told);
    }

    /// Remembers what an answer was about.
    pub fn learn(&mut self, answer: &Answer) {
        self.pending = None;
        self.told_place = None;
        self.is_outdated = false;
        if !matches!(answer.query, Query::Why { .. } | Query::Courtesy(_)) {
            self.facts.clone_from(&answer.facts);
            self.said = Some(answer.text.clone());
            match &answer.query {
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
        if answer.things.len() > 1 {
            self.listed.clone_from(&answer.things);
        }
        for thing in answer.topic.iter().rev() {
            self.spoken.retain(|t| t != thing);
            self.spoken.insert(0, *thing);
        }
        self.spoken.truncate(50);
    }

    /// Notes the things that a command named.
    pub fn mention(&mut self, things: &[Thing]) {
        self.hear_of_things(things);
        self.last = things.to_vec();
        for thing in things {
            self.spoken.retain(|t| t != thing);
            self.spoken.insert(0, *thing);
        }
    }

    /// Notes several things, none of which is more spoken of than the others.
    pub(super) fn list(&mut self, things: &[Thing]) {
        match things {
            [] => {}
            [only] => self.mention(&[*only]),
            _ => {
                self.mention(things);
                if let Some(exchange) = self.exchanges.first_mut() {
                    *exchange = focus::Exchange::list(things);
                }
                self.listed = things.to_vec();
            }
        }
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
