//! What is free on a thing, and where one can sit, lie or put something down.
//!
//! Invariant: a seat on which something stands is none, and nothing is put where its base does not fit.

use super::Draft;
use crate::language::question::knowledge::Knowledge;
use crate::language::question::query::{Noun, Rel, Restriction, Thing, Use};
use crate::language::question::{Doubt, Fact, Said};
use crate::language::words::Case;
use crate::language::words::area;

impl Knowledge<'_> {
    pub(super) fn free(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let top = thing.replica().and_then(|id| self.relations.free_top(id));
        let Some((whole, free)) = top.filter(|(whole, _)| *whole > 0.0) else {
            let text = match self.is_russian() {
                true => format!(
                    "{} {} ничего положить нельзя",
                    "на",
                    self.form(thing, Case::Accusative)
                ),
                false => format!("nothing can be put on {}", self.name(thing)),
            };
            return Ok(Draft::new(Said::No, text).with(vec![thing]));
        };
        let share = (free / whole * 100.0).round();
        let on_it = self.related(Rel::On, thing);
        let (free_words, place) = (area(free, self.language), self.place(Rel::On, &[thing]));
        let mut text = match (share >= 5.0, self.is_russian()) {
            (true, true) => format!("{place} свободно {share:.0} % поверхности ({free_words})"),
            (true, false) => format!("{share:.0} % of the surface {place} is free ({free_words})"),
            (false, true) => format!("нет, {place} почти нет свободного места"),
            (false, false) => format!("no, there is hardly any free space {place}"),
        };
        if !on_it.is_empty() {
            let list = self.list(&on_it);
            text = match self.is_russian() {
                true => format!("{text}; там {} {list}", self.is(&on_it)),
                false => format!("{text}; {list} {} there", self.is(&on_it)),
            };
        }
        let said = if share >= 5.0 { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![thing]).about(&on_it).number(share))
    }

    pub(super) fn usable(
        &self,
        use_for: Use,
        what: Option<&Noun>,
        within: &[Restriction],
    ) -> Result<Draft, Doubt> {
        let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
        noun.head.anything = true;
        noun.restrictions = within.to_vec();
        let all = self.find(&noun, false)?;
        let thing = match what {
            Some(what) if use_for == Use::Put => {
                let mut found = self.find(what, true)?;
                found.truncate(1);
                found.pop()
            }
            _ => None,
        };
        let needed = thing
            .and_then(Thing::replica)
            .and_then(|id| self.relations.extent(id))
            .map_or(400.0, |e| e.base);
        let fits = |t: &Thing| {
            let Some(id) = t.replica() else { return false };
            match use_for {
                Use::Sit => self.has_trait(id, "seat"),
                Use::Lie => self.has_trait(id, "bed"),
                Use::Put => {
                    self.has_trait(id, "support")
                        && !self.has_trait(id, "portable")
                        && Some(*t) != thing
                        && self.relations.free_top(id).is_some_and(|(_, free)| free >= needed)
                }
            }
        };
        let found: Vec<Thing> = all.into_iter().filter(fits).collect();
        // What something stands on is no seat now.
        let found: Vec<Thing> = match use_for {
            Use::Put => found,
            _ => {
                let empty =
                    |t: &Thing| t.replica().is_none_or(|id| !self.relations.bears_something(id));
                found.into_iter().filter(empty).collect()
            }
        };
        let place = self.restrictions(&noun);
        let text = match (use_for, found.is_empty(), self.is_russian()) {
            (_, true, true) => format!("{place} такого места на карте нет"),
            (_, true, false) => format!("the map has no such place {place}"),
            (Use::Sit, _, true) => format!("сесть можно {}", self.seats(&found)),
            (Use::Sit, _, false) => format!("one can sit on {}", self.list(&found)),
            (Use::Lie, _, true) => format!("лечь можно {}", self.seats(&found)),
            (Use::Lie, _, false) => format!("one can lie down on {}", self.list(&found)),
            (Use::Put, _, true) => format!("свободное место есть {}", self.place(Rel::On, &found)),
            (Use::Put, _, false) => format!("there is free space {}", self.place(Rel::On, &found)),
        };
        let facts = found.iter().take(20).map(|t| {
            let wanted = match use_for {
                Use::Sit => "seat",
                Use::Lie => "bed",
                Use::Put => "support",
            };
            Fact::holding("HAS_TRAIT", vec![self.symbol(*t), wanted.to_owned()])
        });
        let facts = facts.collect();
        let said = if found.is_empty() { Said::Nothing } else { Said::Found };
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }

    /// «на Диван-1, на Кресло-1 или на Стул-2»
    fn seats(&self, found: &[Thing]) -> String {
        format!("на {}", self.names(found, Case::Accusative))
    }
}
