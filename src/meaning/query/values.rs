//! Values and properties as premises: what the facts call them, and what they know of a thing.

use std::collections::BTreeSet;

use crate::language::question::{Property, ValueId};
use crate::map::DoorStatus;
use crate::outcome::NoAnswer;
use crate::term::Sorts;

use super::{Asking, FALSE, either};
use crate::facts::quoted;
use crate::units::Gather as _;

impl Asking<'_> {
    pub(super) fn value(
        &self,
        value: ValueId,
        x: &str,
        sorts: Sorts,
    ) -> Result<Vec<String>, NoAnswer> {
        const STATES: [(DoorStatus, &str); 3] = [
            (DoorStatus::Open, "open"),
            (DoorStatus::Closed, "closed"),
            (DoorStatus::Locked, "locked"),
        ];
        let values = &self.map.lexicon.values;
        if values.entry(value).is_emptiness() {
            return Err(NoAnswer::Unfit("empty and full"));
        }
        let of_doors = STATES
            .iter()
            .filter(|(status, _)| values.of_door(*status).is_some_and(|own| values.is(own, value)));
        let mut choices: Vec<String> =
            of_doors.map(|(_, word)| format!("DOOR_IS({x}, \"{word}\")")).collect();
        // The rules' types keep doors and things apart.
        if sorts.meets(Sorts::THING) {
            choices.clear();
        }
        for spelling in self.spellings(value) {
            choices.push(format!("HAS({x}, _, {})", quoted(&spelling)));
        }
        if choices.is_empty() {
            choices.push(FALSE.to_owned());
        }
        Ok(choices)
    }

    /// That a thing has some value where it might have this one; none where the property has no facts.
    pub(crate) fn property_known(&self, value: ValueId, x: &str, sorts: Sorts) -> Option<String> {
        self.property_told(&self.map.lexicon.values.entry(value).property, x, sorts)
    }

    /// That a thing has some value of a property; none where the property has no facts.
    pub(crate) fn property_told(
        &self,
        property: &Property,
        x: &str,
        sorts: Sorts,
    ) -> Option<String> {
        let mut known: Vec<String> = self
            .names_of(property)
            .into_iter()
            .map(|name| format!("HAS({x}, {}, _)", quoted(&name)))
            .collect();
        if *property == Property::State && !sorts.meets(Sorts::THING) {
            known.push(format!("DOOR_IS({x}, _)"));
        }
        (!known.is_empty()).then(|| either(&known))
    }

    /// What the facts call a property.
    pub(crate) fn names_of(&self, property: &Property) -> Vec<String> {
        self.of_facts(1, |name| Property::of(name) == *property)
    }

    /// How the facts write a value, or one that counts as it.
    pub(super) fn spellings(&self, value: ValueId) -> Vec<String> {
        let values = &self.map.lexicon.values;
        self.of_facts(2, |text| values.meaning(text).is_some_and(|own| values.is(own, value)))
    }

    /// What stands in a column of `HAS` and fits, sorted, each once.
    pub(super) fn of_facts(&self, column: usize, fits: impl Fn(&str) -> bool) -> Vec<String> {
        let tuples = self.map.relations.derived().tuples("HAS").into_iter().flatten();
        let texts: BTreeSet<String> =
            tuples.filter_map(|tuple| tuple.symbol(column).map(str::to_owned)).gather();
        texts.into_iter().filter(|text| fits(text)).collect()
    }
}
