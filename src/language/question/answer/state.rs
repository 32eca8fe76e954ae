//! Whether light is on, and whether anything is in a thing: states that are told of what they are states of.
//!
//! Invariant: of light one does not ask which.

use super::Draft;
use crate::question::knowledge::Knowledge;
use crate::question::query::{Noun, Rel, Thing};
use crate::question::values::ValueId;
use crate::question::{Doubt, Said};
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
        let Some(&first) = found.first() else { return Err(self.none_such(subject)) };
        let known: Vec<Thing> =
            found.iter().copied().filter(|t| self.own_value(*t, asked).is_some()).collect();
        if known.is_empty() {
            let property = self.lexicon().values.entry(asked).property.clone();
            return Ok(Draft::new(Said::Unknown, self.no_property(&property, first)).with(found));
        }
        let lit: Vec<Thing> = known.iter().copied().filter(|t| self.has_value(*t, asked)).collect();
        let yes = lit.is_empty() == negated;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let shown = if lit.is_empty() { &known } else { &lit };
        let each = |t: &Thing| {
            let own = self.own_value(*t, asked).unwrap_or_default();
            match self.is_russian() {
                true => format!("{} {own}", self.name(*t)),
                false => format!("{} is {own}", self.name(*t)),
            }
        };
        let words: Vec<String> = shown.iter().take(8).map(each).collect();
        let text = format!("{head}{}", enumerate(&words, self.language));
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(shown.clone()))
    }

    /// Whether nothing is in or on a thing.
    pub(super) fn say_empty(&self, thing: Thing, negated: bool) -> Draft {
        let mut held = self.related(Rel::In, thing);
        held.extend(self.related(Rel::On, thing));
        held.order();
        held.dedup();
        let yes = held.is_empty() != negated;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let inside = held.iter().any(|t| self.tuple(Rel::In, *t, thing).is_some());
        let container = thing.replica().is_some_and(|id| self.world.has_trait(id, "container"));
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
