//! Whether light is on, and whether anything is in a thing: states that are told of what they are states of.
//!
//! Invariant: of light one does not ask which.

use super::Draft;
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::{KindId, Meaning};
use crate::question::query::{Head, Noun, Rel, Thing};
use crate::question::values::ValueId;
use crate::question::{Doubt, Said};
use crate::sets::set;
use crate::units::InOrder as _;
use crate::words::enumerate;

impl Knowledge<'_> {
    /// «да, в Кухне включена Лампа-1», «нет, Лампа-1 выключена»: of light one does not ask which.
    pub(super) fn say_lighting(
        &self,
        subject: &Noun,
        asked: ValueId,
        negated: bool,
    ) -> Result<Draft, Doubt> {
        let found = self.find(subject, true)?;
        if found.is_empty() {
            return Err(self.none_such(subject));
        }
        let known: Vec<Thing> =
            found.iter().copied().filter(|t| self.own_value(*t, asked).is_some()).collect();
        let lit: Vec<Thing> = known.iter().copied().filter(|t| self.has_value(*t, asked)).collect();
        // There is light where one lamp is on, and none only where each is off.
        let is_on = self.lexicon().values.meaning("включённый") == Some(asked);
        let shining = if is_on { !lit.is_empty() } else { lit.len() < known.len() };
        let unknown = found.iter().find(|t| !known.contains(t));
        if let Some(unknown) = unknown.filter(|_| !shining) {
            let property = self.lexicon().values.entry(asked).property.clone();
            let shown = known.iter().copied().chain(self.switches_of(subject, asked));
            let shown: Vec<Thing> = shown.collect();
            let told = shown.iter().map(|t| self.with_value(*t, asked)).collect::<Vec<_>>();
            let unsaid = self.no_property(&property, *unknown);
            let text = match told.is_empty() {
                true => unsaid,
                false => format!("{}; {unsaid}", enumerate(&told, self.language)),
            };
            let things = if known.is_empty() { found } else { shown };
            return Ok(Draft::new(Said::Unknown, text).with(things));
        }
        let yes = lit.is_empty() == negated;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let shown = if lit.is_empty() { &known } else { &lit };
        let each = |t: &Thing| self.with_value(*t, asked);
        let words: Vec<String> = shown.iter().take(8).map(each).collect();
        let text = format!("{head}{}", enumerate(&words, self.language));
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(shown.clone()))
    }

    /// «Лампа-1 включена»
    fn with_value(&self, thing: Thing, asked: ValueId) -> String {
        let own = self.own_value(thing, asked).unwrap_or_default();
        match self.is_russian() {
            true => format!("{} {own}", self.name(thing)),
            false => format!("{} is {own}", self.name(thing)),
        }
    }

    /// The light switches where lamps are asked for, as far as the map tells how they stand.
    fn switches_of(&self, lamps: &Noun, asked: ValueId) -> Vec<Thing> {
        let kind = |word: &&str| {
            self.lexicon().nouns.find(word).into_iter().find_map(|hit| match hit.id {
                Meaning::Kind(kind) => Some(*kind),
                _ => None,
            })
        };
        let kinds: Vec<KindId> = set!("LightSwitch").iter().filter_map(kind).collect();
        if kinds.is_empty() || lamps.restrictions.is_empty() {
            return Vec::new();
        }
        let head = Head { kinds, ..Head::default() };
        let restrictions = lamps.restrictions.clone();
        let noun = Noun { head, plural: true, restrictions, ..Noun::default() };
        let mut found = self.find(&noun, true).unwrap_or_default();
        found.retain(|t| self.own_value(*t, asked).is_some());
        found
    }

    /// Whether nothing is in or on a thing.
    pub(super) fn say_empty(&self, thing: Thing, negated: bool) -> Draft {
        let mut held = self.related(Rel::In, thing);
        let container = thing.replica().is_some_and(|id| self.world.has_trait(id, "container"));
        // What stands on a microwave does not fill it, but what stands on a dresser is on it.
        let bears = thing.replica().is_some_and(|id| self.world.has_trait(id, "support"));
        if bears || !container {
            held.extend(self.related(Rel::On, thing));
        }
        held.order();
        held.dedup();
        let yes = held.is_empty() != negated;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let inside = held.iter().any(|t| self.tuple(Rel::In, *t, thing).is_some());
        let rel = if inside || (held.is_empty() && container) { Rel::In } else { Rel::On };
        let place = self.place(rel, &[thing]);
        let text = match (held.is_empty(), self.is_russian()) {
            (true, true) => format!("{head}{place} ничего нет"),
            (true, false) => format!("{head}there is nothing {place}"),
            (false, true) => format!("{head}{place} {} {}", self.is(&held), self.list(&held)),
            (false, false) => format!("{head}{} {} {place}", self.list(&held), self.is(&held)),
        };
        let said = if yes { Said::Yes } else { Said::No };
        Draft::new(said, text).with(vec![thing]).about(&held)
    }
}
