//! One thing moved, added or removed: what was measured of it is measured anew, and of it alone.
//!
//! **Invariant:** after any [`Measurements::update`] the measurements equal those made from scratch.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::contact::bounds_distance;
use crate::map::World;
use crate::units::ReplicaId;

use super::super::body::Body;
use super::pair::{Between, Pair};
use super::single::Single;
use super::{Measurements, cm};

/// The pairs whose measurements an update changed, and the things whose own did.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Change {
    pub removed: BTreeMap<(ReplicaId, ReplicaId), Pair>,
    pub added: BTreeSet<(ReplicaId, ReplicaId)>,
    pub single_before: Option<Single>,
    pub single_after: Option<Single>,
}

impl Measurements {
    /// Measures one replica anew after it was moved, added or removed in `world`; Areas and Objects must be as they were.
    pub fn update(&mut self, world: &World, id: ReplicaId) -> Change {
        let mut change = Change::default();
        self.take_away(id, &mut change);
        self.put_in_place(world, id, &mut change);
        change
    }

    /// Forgets what was measured of a replica.
    pub(crate) fn take_away(&mut self, id: ReplicaId, change: &mut Change) {
        self.near();
        change.single_before = self.singles.remove(&id);
        if let Some(body) = self.bodies.remove(&id) {
            self.forget(&body, &mut Vec::new(), change);
        }
    }

    /// Measures a replica of `world`, if it is there, of which nothing is measured.
    pub(crate) fn put_in_place(&mut self, world: &World, id: ReplicaId, change: &mut Change) {
        self.near();
        if let Some(body) = Body::new(world, &self.kinds, &self.placements, id) {
            self.enter(body, &mut Vec::new(), change);
        }
        change.single_after = self.singles.get(&id).cloned();
    }

    fn forget(&mut self, body: &Body, near: &mut Vec<ReplicaId>, change: &mut Change) {
        let id = body.id;
        if let Some(grid) = self.grids.get_mut(&body.map) {
            grid.remove(id, &body.bounds);
        }
        self.around(body, near);
        for &other in near.iter() {
            let key = (id.min(other), id.max(other));
            let near = self.near_mut();
            if let Some(pair) = near.pairs.remove(&key) {
                near.clear_between(key, &pair);
                change.removed.insert(key, pair);
            }
        }
        let near = self.near_mut();
        for key in near.stands_between.remove(&id).unwrap_or_default() {
            let Some(pair) = near.pairs.get_mut(&key) else { continue };
            change.removed.entry(key).or_insert_with(|| pair.clone());
            change.added.insert(key);
            if let Some(beside) = &mut pair.beside {
                beside.between.remove(&Between::Replica(id));
            }
        }
    }

    fn enter(&mut self, body: Body, near: &mut Vec<ReplicaId>, change: &mut Change) {
        let id = body.id;
        self.grids.entry(body.map).or_default().insert(id, &body.bounds);
        self.around(&body, near);
        self.singles.insert(id, self.single(&body));
        let mut found = Vec::new();
        for &other in near.iter().filter(|&&b| b != id) {
            let other = &self.bodies[&other];
            let (a, b) = if id < other.id { (&body, other) } else { (other, &body) };
            if let Some(pair) = self.pair(a, b) {
                change.added.insert((a.id, b.id));
                found.push(((a.id, b.id), pair));
            }
        }
        self.near_mut().pairs.extend(found);
        // A way between two others that this thing now crosses has both its ends within reach of it.
        let reach = cm(self.reach.beside);
        near.retain(|&n| {
            n != id && bounds_distance(&self.bodies[&n].bounds, &body.bounds) <= reach
        });
        self.bodies.insert(id, body);
        let entered: Vec<_> =
            change.added.iter().copied().filter(|k| k.0 == id || k.1 == id).collect();
        for key in entered {
            self.look_between(key);
        }
        for (i, &a) in near.iter().enumerate() {
            for &b in &near[i + 1..] {
                self.step_between((a, b), id, change);
            }
        }
    }

    /// Notes that `third` stands between two others, if it does.
    fn step_between(&mut self, key: (ReplicaId, ReplicaId), third: ReplicaId, change: &mut Change) {
        let Some(pair) = self.pairs().get(&key) else { return };
        if pair.beside.is_none() {
            return;
        }
        let share = self.fills(key, pair, &self.bodies[&third]);
        if share == 0 {
            return;
        }
        change.removed.entry(key).or_insert_with(|| pair.clone());
        change.added.insert(key);
        let near = self.near_mut();
        let beside = near.pairs.get_mut(&key).and_then(|p| p.beside.as_mut());
        beside.expect("looked up above").between.insert(Between::Replica(third), share);
        near.stands_between.entry(third).or_default().insert(key);
    }
}
