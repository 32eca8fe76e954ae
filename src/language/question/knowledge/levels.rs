//! Shelves, drawers and other parts told by their height: «верхняя полка стеллажа», "the second drawer from the bottom".
//!
//! Invariant: levels are parts of one thing as the map has them; what is on a level begins at or above it and below
//! the next one.

use super::Knowledge;
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
    /// Where it begins and where the next one does, cm above the Map's zero.
    heights: (f64, f64),
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
        let bottom = self.measure(Extreme::Bottommost, thing)?;
        let heights = self.level_heights(owner, part);
        let place = heights.iter().rposition(|height| *height <= bottom + self.sunk())?;
        self.level_at(owner, part, place)
    }

    /// What is on a level.
    pub(super) fn on_level(&self, level: &Level) -> HashSet<Thing> {
        let mut found = self.related(Rel::On, level.owner);
        found.extend(self.related(Rel::In, level.owner));
        let (from, to) = (level.heights.0 - self.sunk(), level.heights.1 - self.sunk());
        let here = |t: &Thing| {
            self.measure(Extreme::Bottommost, *t)
                .is_some_and(|bottom| bottom >= from && bottom < to)
        };
        found.into_iter().filter(here).collect()
    }

    /// By how much what stands on a part sinks into it, cm.
    fn sunk(&self) -> f64 {
        self.relations.thresholds().level_sunk
    }

    fn level_at(&self, owner: Thing, part: &Noun, place: usize) -> Option<Level> {
        let heights = self.level_heights(owner, part);
        let next = heights.get(place + 1).copied().unwrap_or(f64::INFINITY);
        let heights_of = (*heights.get(place)?, next);
        Some(Level { owner, place, of: heights.len(), heights: heights_of })
    }

    pub(in crate::question) fn has_part_kinds(&self, noun: &Noun) -> bool {
        let part = |k: &_| matches!(self.lexicon().kind(*k).extension, Extension::Part(_));
        noun.head.kinds.iter().any(part)
    }

    /// How high the parts of some kinds of a thing are, the lowest first, cm above the Map's zero.
    fn level_heights(&self, owner: Thing, part: &Noun) -> Vec<f64> {
        let object = owner
            .replica()
            .and_then(|id| self.world.objects.get(&self.world.replicas.get(&id)?.object));
        let (Some(object), Some(foot)) = (object, self.measure(Extreme::Bottommost, owner)) else {
            return Vec::new();
        };
        let kinds = part.head.kinds.iter().map(|k| self.lexicon().kind(*k).extension);
        let kinds: Vec<Extension> = kinds.collect();
        let lowest =
            object.items.iter().map(|item| item.frame.z.get()).fold(f64::INFINITY, f64::min);
        let of_kind = object.items.iter().filter_map(|item| {
            let frame = self.world.orthoframes.get(&item.orthoframe)?;
            let kind = Extension::Part(frame.frame_type?);
            let top = item.frame.z.get() + frame.height.get();
            kinds.contains(&kind).then_some(foot + top - lowest)
        });
        let mut heights: Vec<f64> = of_kind.collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup_by(|a, b| (*a - *b).abs() < self.sunk());
        heights
    }
}
