//! The load of a thing that an edit moves: what stood on it or lay in it goes with it, or is told to have stayed.
//!
//! **Invariant.** A load keeps its place on what bears it; what the edit moves itself is where the edit puts it.

use std::collections::{BTreeMap, BTreeSet};

use crate::Relations;
use crate::map::{Replica, World};
use crate::units::{Frame, ReplicaId};

/// Moves the loads of `carriers` along, in `after`; returns those that stood on other moved things and stayed.
#[must_use]
pub fn carry(
    before: &World,
    relations: &Relations,
    carriers: &BTreeSet<ReplicaId>,
    after: &mut World,
) -> Vec<ReplicaId> {
    let stands_as_before = |id: ReplicaId, after: &World| {
        let (old, new) = (before.replicas.get(&id)?, after.replicas.get(&id)?);
        Some(old.area == new.area && old.frame == new.frame)
    };
    let changes = before.replicas.changes(&after.replicas).into_iter();
    let moved = changes.map(|(id, ..)| id).filter(|id| stands_as_before(*id, after) == Some(false));
    let mut loads = BTreeMap::new();
    for support in moved.collect::<Vec<_>>() {
        let mut open = vec![support];
        while let Some(at) = open.pop() {
            for id in relations.borne_by(at) {
                // Rules of the user's own might make things bear one another in a ring.
                if stands_as_before(id, after) == Some(true) && !loads.contains_key(&id) {
                    loads.insert(id, support);
                    open.push(id);
                }
            }
        }
    }
    let mut stayed = Vec::new();
    for (id, support) in loads {
        if carriers.contains(&support) {
            let (old, new) = (&before.replicas[&support], &after.replicas[&support]);
            let moved = along(&before.replicas[&id], old, new);
            after.replicas.insert(id, moved);
        } else {
            stayed.push(id);
        }
    }
    stayed
}

/// A load after what bears it went from `old` to `new`.
fn along(load: &Replica, old: &Replica, new: &Replica) -> Replica {
    let turn = Frame::new(0.0, 0.0, 0.0, new.frame.angle - old.frame.angle);
    let at = new.frame.origin() + turn.turn(load.frame.origin() - old.frame.origin());
    let z = load.frame.z.get() + (new.frame.z.get() - old.frame.z.get());
    let frame = Frame::new(at.x, at.y, z, load.frame.angle + turn.angle);
    Replica { area: new.area, frame, ..load.clone() }
}
