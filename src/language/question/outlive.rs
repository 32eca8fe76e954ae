//! What is remembered of a dialogue when the map has changed since.
//!
//! Invariant: nothing that left the map is spoken of again but to say that it left, and what is counted by its place in
//! a list of the map (kinds, values) outlives no change of that list.

use super::departed::{Departed, Stamp};
use super::speech;
use super::{Answer, Doubt, Memory, Thing, Unanswered};
use crate::report::Named;
use crate::words::{Case, Language, english, enumerate};

impl Memory {
    /// The state of the map to which it belongs; none where nothing was said yet.
    #[must_use]
    pub fn stamp(&self) -> Option<Stamp> {
        self.stamp
    }

    /// It was brought to this state of the map.
    pub fn belongs_to(&mut self, stamp: Stamp) {
        self.stamp = Some(stamp);
    }

    /// Forgets all that was said: it was about another map.
    pub fn forget(&mut self) {
        *self = Self { language: self.language, is_outdated: true, ..Self::default() };
    }

    /// Brings it to a map that has changed. `gone` tells what left it; `renamed`, whether more than places may have
    /// changed. An exchange that named what left is forgotten with all before it, so that no pronoun passes over it to
    /// something older.
    pub fn outlive(&mut self, gone: &dyn Fn(Thing) -> Option<Departed>, renamed: bool) {
        // What the last answer rested on need not hold any more.
        (self.facts, self.said, self.is_outdated) = (Vec::new(), None, true);
        if !renamed {
            return;
        }
        (self.query, self.pending, self.waiting, self.ordered) = (None, None, None, None);
        self.words.clear();
        let is_gone = |thing: &Thing| gone(*thing).is_some();
        let (named, lost) = match self.exchanges.iter().position(|e| e.things().any(is_gone)) {
            Some(at) => (self.exchanges.split_off(at), true),
            None => (Vec::new(), false),
        };
        let spoken = self.spoken.iter().position(is_gone);
        let unsaid = spoken.map(|at| self.spoken.split_off(at)).unwrap_or_default();
        if lost || spoken.is_some() {
            let newest = named.first().into_iter().flat_map(|e| e.things());
            let first = unsaid.first().into_iter();
            let mut things: Vec<Thing> = newest.chain(first).copied().filter(is_gone).collect();
            things.dedup();
            self.departed = things.into_iter().filter_map(gone).collect();
            self.departed.dedup();
        }
        if self.exchanges.is_empty() && lost {
            self.spoken.clear();
        }
        for told in [&mut self.last, &mut self.listed] {
            if told.iter().any(is_gone) || self.exchanges.is_empty() {
                told.clear();
            }
        }
        self.person = self.person.filter(|place| !is_gone(&Thing::Entity(*place)));
        self.called_from = self.called_from.filter(|place| !is_gone(place));
        self.stands = self.stands.filter(|place| !is_gone(place));
        if let Some(departed) = self.left.and_then(gone) {
            (self.left, self.left_departed) = (None, Some(departed));
        }
    }

    /// Why a word means nothing: what it would mean left the map.
    pub(super) fn why_nothing(&self, doubt: Doubt) -> Doubt {
        match doubt {
            Doubt::NoReferent { .. } if !self.departed.is_empty() => {
                Doubt::Departed { things: self.departed.clone() }
            }
            other => other,
        }
    }

    /// That what was spoken of left the map, where nothing else is spoken of.
    #[must_use]
    pub fn lost_topic(&self, language: Language) -> Option<Unanswered> {
        let is_lost = !self.departed.is_empty() && self.last_thing().is_none();
        is_lost.then(|| unanswered(&self.departed, language))
    }

    /// That the place left the map from which the robot was sent away.
    #[must_use]
    pub fn lost_place(&self, language: Language) -> Option<Unanswered> {
        self.left_departed.as_ref().map(|place| unanswered(std::slice::from_ref(place), language))
    }
}

fn unanswered(departed: &[Departed], language: Language) -> Unanswered {
    let doubt = Doubt::Departed { things: departed.to_vec() };
    let text = speech::sentence(&departed_words(departed, language));
    Unanswered { doubt, language, text, names: Box::default(), offers: Box::default() }
}

impl Answer {
    /// The state of the map that it was found in.
    #[must_use]
    pub fn stamp(&self) -> Option<Stamp> {
        self.stamp
    }

    /// The answer, as one found in the state to which a memory belongs.
    #[must_use]
    pub fn of(self, memory: &Memory) -> Self {
        Self { stamp: memory.stamp, ..self }
    }
}

/// «Чашки-1 больше нет на карте», "Cup 1 is no longer on the map"
pub(super) fn departed_words(things: &[Departed], language: Language) -> String {
    let named: Vec<Named> = things
        .iter()
        .filter(|thing| !thing.name.is_empty())
        .map(|thing| {
            let english = Some(&*thing.english).filter(|name| !name.is_empty());
            Named::new(&thing.name, &thing.hints, english)
        })
        .collect();
    match (language, &named[..]) {
        (Language::Russian, []) => "того, о чём шла речь, на карте больше нет".to_owned(),
        (Language::English, []) => "what was spoken of is no longer on the map".to_owned(),
        (Language::Russian, all) => {
            let names: Vec<String> = all.iter().map(|n| n.form(Case::Genitive, language)).collect();
            format!("{} больше нет на карте", enumerate(&names, language))
        }
        (Language::English, all) => {
            let names: Vec<String> = all.iter().map(Named::english).collect();
            let many = names.len() > 1 || english::is_plural(&names[0]);
            let is = if many { "are" } else { "is" };
            format!("{} {is} no longer on the map", enumerate(&names, language))
        }
    }
}
