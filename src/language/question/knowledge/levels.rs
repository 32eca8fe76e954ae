//! Shelves, drawers and other parts told by their height: «верхняя полка стеллажа», "the second drawer from the bottom".
//!
//! Invariant: levels are parts of one thing as the map has them; which heights are one level, and what is on it, the
//! rules say.

use super::Knowledge;
use crate::facts::{Value, quoted};
use crate::map::Entity;
use crate::question::Doubt;
use crate::question::lexicon::Extension;
use crate::question::query::{Best, Extreme, Noun, Rel, Restriction, Thing};
use std::collections::HashSet;

/// One of the parts of a kind that a thing has above each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::question) struct Level {
    pub(in crate::question) owner: Thing,
    /// Counted from the lowest, from 0.
    pub(in crate::question) place: usize,
    /// How many there are.
    pub(in crate::question) of: usize,
    /// The height of its top in the rules.
    top: i64,
}

impl Knowledge<'_> {
    /// The level that a place names; none where it names none.
    ///
    /// # Errors
    /// Several things have such parts; none of the parts is that one.
    pub(in crate::question) fn level_of(
        &self,
        restriction: &Restriction,
    ) -> Result<Option<Level>, Doubt> {
        let [noun] = &restriction.anchors[..] else { return Ok(None) };
        match restriction.rel {
            Rel::On | Rel::In | Rel::There => self.level(noun),
            _ => Ok(None),
        }
    }

    fn level(&self, noun: &Noun) -> Result<Option<Level>, Doubt> {
        let Some(Best { extreme, .. }) = &noun.best else { return Ok(None) };
        if !extreme.is_level() || !self.has_part_kinds(noun) {
            return Ok(None);
        }
        let has = |t: &Thing, least: usize| self.level_heights(*t, noun).len() >= least;
        let owners: Vec<Thing> = match &noun.head.things {
            Some(things) => things.clone(),
            None => {
                let mut all: Vec<Thing> = self
                    .world
                    .replicas
                    .keys()
                    .map(|id| Thing::Entity(Entity::Replica(*id)))
                    .collect();
                // One shelf is neither the upper nor the lower, unless its owner is told.
                let mut least = 2;
                for place in noun.restrictions.iter().filter(|r| !r.negated) {
                    let Some(anchor) = place.anchors.first() else { continue };
                    let told = self.find(anchor, true)?;
                    if told.iter().all(|t| t.area().is_some()) {
                        all.retain(|t| told.iter().any(|room| room.area() == self.area_of(*t)));
                    } else {
                        all.retain(|t| told.contains(t));
                        least = 1;
                    }
                }
                all.retain(|t| has(t, least));
                all
            }
        };
        let owner = match owners[..] {
            [] => return Ok(None),
            [only] => only,
            _ => return Err(self.ambiguous(noun, &owners)),
        };
        let of = self.level_heights(owner, noun).len();
        let rank = noun.rank.and_then(|rank| usize::try_from(rank).ok()).unwrap_or(1);
        let place = match extreme {
            Extreme::Topmost => of.checked_sub(rank),
            Extreme::Bottommost => rank.checked_sub(1).filter(|place| *place < of),
            _ => (of % 2 == 1).then_some(of / 2),
        };
        let level = place.and_then(|place| self.level_at(owner, noun, place));
        level.map(Some).ok_or_else(|| self.none_such(noun))
    }

    /// On which of its support's parts of a kind a thing is; none where the map does not tell it.
    pub(in crate::question) fn level_under(&self, thing: Thing, part: &Noun) -> Option<Level> {
        let owner = *self
            .support_chain(thing)
            .iter()
            .find(|t| !self.level_heights(**t, part).is_empty())?;
        let tops = self.level_heights(owner, part);
        let (thing, of) = [thing, owner].map(|thing| quoted(&self.symbol(thing))).into();
        let rows =
            self.relations.found(&self.around(), &format!("?- ON_LEVEL({thing}, {of}, K, H)"));
        let kinds = self.part_kinds(part);
        let is_on = |top: i64| {
            let row = |row: &Vec<Value>| match &row[..] {
                [Value::Symbol(kind), Value::Number(own)] => {
                    *own == top && kinds.contains(&&**kind)
                }
                _ => false,
            };
            rows.iter().any(row)
        };
        let place = tops.iter().rposition(|top| is_on(*top))?;
        self.level_at(owner, part, place)
    }

    /// What is on a level.
    pub(super) fn on_level(&self, level: &Level) -> HashSet<Thing> {
        let mut found = self.related(Rel::On, level.owner);
        found.extend(self.related(Rel::In, level.owner));
        let owner = quoted(&self.symbol(level.owner));
        let top = level.top;
        let here: HashSet<Thing> =
            self.things_asked(&format!("?- ON_LEVEL(X, {owner}, _, {top})")).into_iter().collect();
        found.into_iter().filter(|thing| here.contains(thing)).collect()
    }

    fn level_at(&self, owner: Thing, part: &Noun, place: usize) -> Option<Level> {
        let tops = self.level_heights(owner, part);
        Some(Level { owner, place, of: tops.len(), top: *tops.get(place)? })
    }

    pub(in crate::question) fn has_part_kinds(&self, noun: &Noun) -> bool {
        let part = |k: &_| matches!(self.lexicon().kind(*k).extension, Extension::Part(_));
        noun.head.kinds.iter().any(part)
    }

    /// How high the levels of some kinds of a thing are by the rules, the lowest first.
    fn level_heights(&self, owner: Thing, part: &Noun) -> Vec<i64> {
        if owner.replica().is_none() {
            return Vec::new();
        }
        let of = quoted(&self.symbol(owner));
        let rows = self.relations.found(&self.around(), &format!("?- level({of}, K, H)"));
        let kinds = self.part_kinds(part);
        let top = |row: &Vec<Value>| match &row[..] {
            [Value::Symbol(kind), Value::Number(top)] => kinds.contains(&&**kind).then_some(*top),
            _ => None,
        };
        let mut tops: Vec<i64> = rows.iter().filter_map(top).collect();
        tops.sort_unstable();
        tops.dedup();
        tops
    }

    /// The kinds of parts that a noun means, as the rules call them.
    fn part_kinds(&self, part: &Noun) -> Vec<&str> {
        let kinds = part.head.kinds.iter().map(|k| self.lexicon().kind(*k).extension);
        let name = |extension| match extension {
            Extension::Part(id) => {
                self.world.types.orthoframe.get(Some(id)).map(|kind| kind.name.as_str())
            }
            _ => None,
        };
        kinds.filter_map(name).collect()
    }
}
