//! Ways as rooms one after the other, with the doors and passages between them.
//!
//! Invariant: a passage has the fewest crossings of all that keep to what is asked, and of those the fewest shut doors.

use super::Knowledge;
use super::KnownOpening;
use crate::map::{DoorStatus, Entity};
use crate::question::query::Thing;
use crate::units::AreaId;
use std::collections::{BTreeMap, BTreeSet};

/// A step from one room to the next: by a door or passage, or by a lift.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::question) struct Crossing {
    pub(in crate::question) by: Thing,
    pub(in crate::question) into: AreaId,
}

/// The room in which a passage begins, and its crossings in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::question) struct RoomPath {
    pub(in crate::question) start: AreaId,
    pub(in crate::question) crossings: Vec<Crossing>,
}

/// What a passage must keep to.
#[derive(Debug, Clone, Default)]
pub(in crate::question) struct Limits {
    /// Rooms and doors that are not on it; it may begin and end in such a room.
    pub(in crate::question) avoiding: Vec<Thing>,
    /// No door is to be opened on it.
    pub(in crate::question) open_only: bool,
}

impl Knowledge<'_> {
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

    /// The passage from one of some rooms to one of others; none where what is asked leaves no way.
    pub(in crate::question) fn passage(
        &self,
        from: &[AreaId],
        to: &[AreaId],
        limits: &Limits,
    ) -> Option<RoomPath> {
        let area = |area: AreaId| Thing::Entity(crate::map::Entity::Area(area));
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
                let barred = limits.avoiding.contains(&crossing.by)
                    || (limits.avoiding.contains(&area(crossing.into))
                        && !to.contains(&crossing.into))
                    || (limits.open_only && is_shut);
                let cost = (steps + 1, shut + usize::from(is_shut));
                if barred || best.get(&crossing.into).is_some_and(|known| *known <= cost) {
                    continue;
                }
                best.insert(crossing.into, cost);
                came.insert(crossing.into, (at, crossing));
                open.insert((cost.0, cost.1, crossing.into));
            }
        }
        None
    }

    /// The passage that leads through rooms and doors in their order.
    pub(in crate::question) fn passage_through(
        &self,
        from: &[AreaId],
        to: &[AreaId],
        through: &[Thing],
        limits: &Limits,
    ) -> Option<RoomPath> {
        let Some((next, rest)) = through.split_first() else {
            return self.passage(from, to, limits);
        };
        let joined = |first: RoomPath, crossing: Option<Crossing>, last: RoomPath| {
            let mut crossings = first.crossings;
            crossings.extend(crossing);
            crossings.extend(last.crossings);
            RoomPath { start: first.start, crossings }
        };
        let Some(gate) = self.opening(*next) else {
            let first = self.passage(from, &self.rooms_of(*next), limits)?;
            let here = [first.end()];
            let last = self.passage_through(&here, to, rest, limits)?;
            return Some(joined(first, None, last));
        };
        if limits.open_only && self.is_shut(*next) {
            return None;
        }
        let ways = gate.areas.iter().flat_map(|near| {
            let beyond = gate.areas.iter().filter(move |far| *far != near);
            beyond.filter_map(|far| {
                let first = self.passage(from, &[*near], limits)?;
                let last = self.passage_through(&[*far], to, rest, limits)?;
                Some(joined(first, Some(Crossing { by: *next, into: *far }), last))
            })
        });
        ways.min_by_key(|way| way.crossings.len())
    }
}

impl RoomPath {
    /// The room in which it ends.
    pub(in crate::question) fn end(&self) -> AreaId {
        self.crossings.last().map_or(self.start, |last| last.into)
    }

    /// Whether it comes into no room twice.
    pub(in crate::question) fn is_straight(&self) -> bool {
        let rooms = self.crossings.iter().map(|c| c.into).chain([self.start]);
        rooms.collect::<BTreeSet<_>>().len() == self.crossings.len() + 1
    }

    /// The rooms between its first and its last.
    pub(in crate::question) fn between(&self) -> Vec<AreaId> {
        let inner = self.crossings.len().saturating_sub(1);
        self.crossings.iter().take(inner).map(|c| c.into).collect()
    }
}
