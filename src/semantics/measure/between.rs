//! What stands between two things that are beside each other: third things, and walls of their Area.

use std::collections::BTreeMap;

use crate::geometry::Bounds;
use crate::geometry::contact::{Footprint, length_within, stays_within};
use crate::units::ReplicaId;

use super::super::body::{Block, Body};
use super::pair::{Between, Pair};
use super::{Key, Measurements, Near, per_mille};

impl Measurements {
    /// Everything that stands between a pair, from scratch.
    pub(super) fn look_between(&mut self, key: Key) {
        let Some(pair) = self.pairs().get(&key).filter(|p| p.beside.is_some()) else { return };
        let found = self.between(key, pair);
        let near = self.near_mut();
        let pair = near.pairs.get_mut(&key).expect("looked up above");
        pair.beside.as_mut().expect("looked up above").between = found;
        let pair = pair.clone();
        near.note_between(key, &pair);
    }

    pub(super) fn between(
        &self,
        key: (ReplicaId, ReplicaId),
        pair: &Pair,
    ) -> BTreeMap<Between, i64> {
        let mut found = BTreeMap::new();
        if pair.way.distance <= 0.0 {
            return found;
        }
        let (from, to) = (pair.way.from, pair.way.to);
        let a = &self.bodies[&key.0];
        let mut near = Vec::new();
        if let Some(grid) = self.grids.get(&a.map) {
            grid.near(&Bounds::of([from, to]), &mut near);
        }
        for third in near.iter().filter(|&&t| t != key.0 && t != key.1) {
            let share = self.fills(key, pair, &self.bodies[third]);
            if share > 0 {
                found.insert(Between::Replica(*third), share);
            }
        }
        let areas = [key.0, key.1].map(|id| self.singles[&id].area());
        if let [Some(area), Some(other)] = areas
            && area == other
        {
            let floor: Vec<&Footprint> =
                self.rooms[&area].parts.iter().map(|(f, _, _)| f).collect();
            if !stays_within(from, to, &floor, 0.5) {
                found.insert(Between::Wall(area), 1000);
            }
        }
        found
    }

    /// Share of a pair's common height that a third thing fills where the two are nearest.
    pub(super) fn fills(&self, key: (ReplicaId, ReplicaId), pair: &Pair, third: &Body) -> i64 {
        let (a, b) = (&self.bodies[&key.0], &self.bodies[&key.1]);
        let (from, to) = (pair.way.from, pair.way.to);
        if pair.way.distance <= 0.0 || !third.bounds.meets(&Bounds::of([from, to])) {
            return 0;
        }
        let (low, high) = (a.bottom.max(b.bottom), a.top.min(b.top));
        // What holds both of them is round them, not between them.
        let holds_both = |base: &Footprint| base.contains(from) && base.contains(to);
        let in_the_way = |block: &&Block| {
            block.top > low
                && block.bottom < high
                && length_within(from, to, &block.base) > 0.5
                && !holds_both(&block.base)
        };
        let filled: f64 = third
            .blocks
            .iter()
            .filter(in_the_way)
            .map(|block| block.top.min(high) - block.bottom.max(low))
            .sum();
        per_mille((filled / (high - low)).min(1.0))
    }
}

impl Near {
    pub(super) fn note_between(&mut self, key: Key, pair: &Pair) {
        for thing in pair.beside.iter().flat_map(|b| b.between.keys()) {
            if let Between::Replica(third) = thing {
                self.stands_between.entry(*third).or_default().insert(key);
            }
        }
    }

    pub(super) fn clear_between(&mut self, key: Key, pair: &Pair) {
        for thing in pair.beside.iter().flat_map(|b| b.between.keys()) {
            if let Between::Replica(third) = thing
                && let Some(keys) = self.stands_between.get_mut(third)
            {
                keys.remove(&key);
                if keys.is_empty() {
                    self.stands_between.remove(third);
                }
            }
        }
    }
}
