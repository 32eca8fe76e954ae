//! Ways as rooms one after the other, with the doors and passages between them.
//!
//! Invariant: a passage has the fewest crossings of all, and of those the fewest shut doors.

use super::Knowledge;
use super::KnownOpening;
use crate::map::{DoorStatus, Entity};
use crate::question::Doubt;
use crate::question::lexicon::{Extension, KindId};
use crate::question::query::{Head, Noun, Rel, Restriction, Thing};
use crate::question::senses::{Crossing, RoomPath};
use crate::units::{AreaId, Gather as _};
use std::collections::{BTreeMap, BTreeSet, HashSet};

impl Knowledge<'_> {
    /// Whether a description is of ways out, of which a room has others than the building.
    pub(in crate::question) fn are_ways_out(&self, noun: &Noun) -> bool {
        let exits = |k: &KindId| self.lexicon().kind(*k).extension == Extension::Exits;
        let is_bare = noun.head.things.is_none() && noun.head.named.is_empty();
        is_bare && noun.head.kinds.iter().any(exits)
    }

    /// Whether a description is of the ways out of rooms.
    pub(in crate::question) fn is_of_rooms(&self, noun: &Noun) -> bool {
        let is_room = |anchor: &Noun| {
            let rooms = self.base(&anchor.head);
            !rooms.is_empty() && rooms.iter().all(|t| t.area().is_some())
        };
        self.are_ways_out(noun)
            && noun.restrictions.iter().any(|r| {
                let is_whose = matches!(r.rel, Rel::From | Rel::Of | Rel::In | Rel::At | Rel::To);
                is_whose && !r.negated && !r.anchors.is_empty() && r.anchors.iter().all(is_room)
            })
    }

    /// What a description of ways out is of rooms: whatever opens on one, and not only what leads out of the building.
    pub(in crate::question) fn opening_on_rooms(&self, noun: &Noun) -> Noun {
        let things = self.openings().iter().map(|gate| gate.thing).collect();
        Noun { head: Head { things: Some(things), ..noun.head.clone() }, ..noun.clone() }
    }

    /// "Which rooms have two exits?": of the ways out of rooms.
    pub(super) fn ways_out_had(
        &self,
        restriction: &Restriction,
        of: &[Thing],
    ) -> Option<Restriction> {
        let [exits] = &restriction.anchors[..] else { return None };
        let rooms = restriction.rel == Rel::Has && of.iter().all(|t| t.area().is_some());
        (rooms && self.are_ways_out(exits)).then(|| Restriction {
            anchors: vec![self.opening_on_rooms(exits)],
            ..restriction.clone()
        })
    }

    /// The things that are counted of some places: of rooms, all their ways out.
    pub(in crate::question) fn counted_at(
        &self,
        counted: &Noun,
        of: &[Thing],
    ) -> Result<HashSet<Thing>, Doubt> {
        let of_rooms = self.are_ways_out(counted) && of.iter().all(|t| t.area().is_some());
        let opened = of_rooms.then(|| self.opening_on_rooms(counted));
        let all = self.find(opened.as_ref().unwrap_or(counted), true)?;
        Ok(all.into_iter().collect())
    }

    /// Rooms in which a thing is, or which it joins.
    pub(in crate::question) fn rooms_of(&self, thing: Thing) -> Vec<AreaId> {
        if let Thing::Entity(Entity::Map(id)) = thing {
            let items = self.world.maps.get(&id).into_iter().flat_map(|map| &map.items);
            return items.map(|item| item.area).collect();
        }
        match self.opening(thing) {
            Some(gate) => gate.areas.clone(),
            None => self.area_of(thing).into_iter().collect(),
        }
    }

    /// The doors and passages that join two Areas.
    pub(in crate::question) fn openings_between(
        &self,
        a: AreaId,
        b: AreaId,
    ) -> impl Iterator<Item = &KnownOpening> {
        self.openings().iter().filter(move |g| g.joins(a, b))
    }

    /// Whether a door is shut.
    pub(in crate::question) fn is_shut(&self, gate: Thing) -> bool {
        self.statuses(gate).iter().any(|(status, _)| *status != DoorStatus::Open)
    }

    fn crossings(&self, from: AreaId) -> Vec<Crossing> {
        let beyond = self
            .openings()
            .iter()
            .flat_map(|g| g.beyond(from).map(|into| Crossing { by: g.thing, into }));
        let lifts = self.world.domain.lifts.iter().map(|(_, stops)| stops);
        let here = lifts.filter(|stops| stops.iter().any(|s| s.area == from));
        let rides = here.flatten().filter(|s| s.area != from);
        let area = |area| Thing::Entity(crate::map::Entity::Area(area));
        beyond.chain(rides.map(|s| Crossing { by: area(from), into: s.area })).collect()
    }

    /// The passage from one of some rooms to one of others, as far as doors and passages lead.
    pub(in crate::question) fn passage(&self, from: &[AreaId], to: &[AreaId]) -> Option<RoomPath> {
        // Number of crossings and of shut doors, room; how it was come to.
        let mut open: BTreeSet<(usize, usize, AreaId)> = BTreeSet::new();
        let mut came: BTreeMap<AreaId, (AreaId, Crossing)> = BTreeMap::new();
        let mut best: BTreeMap<AreaId, (usize, usize)> = BTreeMap::new();
        for start in from {
            open.insert((0, 0, *start));
            best.insert(*start, (0, 0));
        }
        while let Some((steps, shut, at)) = open.pop_first() {
            if to.contains(&at) {
                let (mut start, mut crossings) = (at, Vec::new());
                while let Some((before, crossing)) = came.get(&start) {
                    crossings.push(*crossing);
                    start = *before;
                }
                crossings.reverse();
                return Some(RoomPath { start, crossings });
            }
            if best.get(&at) != Some(&(steps, shut)) {
                continue;
            }
            for crossing in self.crossings(at) {
                let is_shut = self.is_shut(crossing.by);
                let cost = (steps + 1, shut + usize::from(is_shut));
                if best.get(&crossing.into).is_some_and(|known| *known <= cost) {
                    continue;
                }
                best.insert(crossing.into, cost);
                came.insert(crossing.into, (at, crossing));
                open.insert((cost.0, cost.1, crossing.into));
            }
        }
        None
    }
}

impl RoomPath {
    /// This one, and on by a crossing and another.
    pub(in crate::question) fn then(mut self, crossing: Option<Crossing>, on: Self) -> Self {
        self.crossings.extend(crossing);
        self.crossings.extend(on.crossings);
        self
    }

    /// Whether it comes into no room twice.
    pub(in crate::question) fn is_straight(&self) -> bool {
        let rooms = self.crossings.iter().map(|c| c.into).chain([self.start]);
        rooms.gather::<BTreeSet<_>>().len() == self.crossings.len() + 1
    }

    /// The rooms between its first and its last.
    pub(in crate::question) fn between(&self) -> Vec<AreaId> {
        let inner = self.crossings.len().saturating_sub(1);
        self.crossings.iter().take(inner).map(|c| c.into).collect()
    }
}
