//! Where the person is, told before a question or behind it: "I'm in the kitchen. Where is the nearest bin?"
//!
//! Invariant: a place that was told takes the robot's where a question counts from here, and nothing else.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::query::Extreme;
use super::{Asker, Noun, Query, Rel};

impl Asker<'_> {
    /// The place of «я на кухне», "I'm on the sofa", where a part of a line says that and no more.
    pub(super) fn premise(&self, text: &str) -> Option<Noun> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let (mut me, mut place) = (false, None);
        for item in sentence.items() {
            match item {
                Item::Noun(phrase) if phrase.person == Some(Mark::Me) => me = true,
                Item::Mark(Mark::Me) => me = true,
                Item::Mark(
                    Mark::Be | Mark::And | Mark::Filler | Mark::The | Mark::Sit | Mark::LieDown,
                ) => {}
                Item::Place { rel, nouns, either: false } if place.is_none() => {
                    let here = matches!(rel, Rel::In | Rel::On | Rel::At | Rel::NextTo | Rel::Near);
                    let [phrase] = &nouns[..] else { return None };
                    if !here || phrase.pronoun.is_some() || phrase.person.is_some() {
                        return None;
                    }
                    place = Some(phrase.noun.clone());
                }
                _ => return None,
            }
        }
        place.filter(|_| me)
    }
}

impl Query {
    /// The same question asked from a place.
    pub(super) fn asked_at(mut self, place: &Noun) -> Self {
        match &mut self {
            Self::Way { from, .. }
            | Self::CanReach { from, .. }
            | Self::Duration { from, .. }
            | Self::Distance { from, .. }
            | Self::Passing { from, .. }
                if from.is_none() =>
            {
                *from = Some(place.clone());
            }
            _ => self.each_noun(&mut |noun| {
                if let Some(best) = &mut noun.best
                    && matches!(best.extreme, Extreme::Nearest | Extreme::Farthest)
                    && best.anchor.is_none()
                {
                    best.anchor = Some(Box::new(place.clone()));
                }
            }),
        }
        self
    }
}
