//! What goes along when a thing is carried away: what stands on it, lies in it, and so on.
//!
//! The rules say what holds what. They are asked about the few things that stand over and under the thing that is carried,
//! so that it costs no more in a house full of things.
//!
//! **Invariant**: the answer is that of the relations of the whole world.

use std::collections::BTreeSet;

use crate::geometry::{PlacedReplica, Scene};
use crate::map::World;
use crate::units::{Frame, Gather as _, ReplicaId};

use super::relations::{RelationError, RelationRules, derive};

/// What is carried along with a thing of a scene.
///
/// # Errors
/// As [`derive()`].
pub fn cargo(
    world: &World,
    rules: &RelationRules,
    scene: &Scene,
    carrier: ReplicaId,
) -> Result<BTreeSet<ReplicaId>, RelationError> {
    let Some(placed) = scene.replicas.get(&carrier) else { return Ok(BTreeSet::new()) };
    let near = rules.hold_cm();
    // Whatever it may bear begins no lower than it does.
    let (mut column, mut open) = (BTreeSet::from([carrier]), vec![placed]);
    while let Some(lower) = open.pop() {
        let over = beside(scene, lower, near).filter(|upper| {
            let touches = upper.bottom <= lower.top + near && upper.bottom >= placed.bottom - near;
            touches && column.insert(upper.id)
        });
        open.extend(over.collect::<Vec<_>>());
    }
    if column.len() == 1 {
        return Ok(BTreeSet::new());
    }
    Ok(derive(&only_about(world, scene, &column, near), rules, world.domain.profile)?
        .goes_with(carrier))
}

/// The shut thing in which a thing of a scene is; none where a hand gets at it.
///
/// # Errors
/// As [`derive()`].
pub fn shut_around(
    world: &World,
    rules: &RelationRules,
    scene: &Scene,
    thing: ReplicaId,
) -> Result<Option<ReplicaId>, RelationError> {
    let Some(placed) = scene.replicas.get(&thing) else { return Ok(None) };
    let near = rules.hold_cm();
    let around = |r: &PlacedReplica| {
        r.bottom <= placed.bottom + near && r.top >= placed.bottom && r.top + near >= placed.top
    };
    if !beside(scene, placed, near).any(around) {
        return Ok(None);
    }
    let few = only_about(world, scene, &BTreeSet::from([thing]), near);
    Ok(derive(&few, rules, world.domain.profile)?.shut_in(thing))
}

/// What is so near to a thing, in cm, seen from above.
fn beside<'s>(
    scene: &'s Scene,
    placed: &'s PlacedReplica,
    near: f64,
) -> impl Iterator<Item = &'s PlacedReplica> {
    let near = placed.bounds.grown(near);
    scene.replicas.values().filter(move |r| r.id != placed.id && r.bounds.meets(&near))
}

/// The world with some things and what stands over, under and about them.
fn only_about(world: &World, scene: &Scene, things: &BTreeSet<ReplicaId>, near: f64) -> World {
    let about = things.iter().flat_map(|id| beside(scene, &scene.replicas[id], near));
    let asked: BTreeSet<ReplicaId> = about.map(|r| r.id).chain(things.iter().copied()).gather();
    let mut few = world.clone();
    few.replicas.retain(|id, _| asked.contains(id));
    few
}

/// Where a thing lies after what carries it was put elsewhere, in the frame of the Area in which that now is; all other
/// frames are those of the Areas, and of the Areas in the Map.
#[must_use]
pub fn carried_to(
    (carrier, carrier_area): (&Frame, &Frame),
    (thing, thing_area): (&Frame, &Frame),
    to: &Frame,
) -> Frame {
    let (from, own) = (carrier_area.compose(carrier), thing_area.compose(thing));
    let at = from.invert(own.origin());
    let within = Frame::new(at.x, at.y, own.z.get() - from.z.get(), own.angle - from.angle);
    to.compose(&within)
}
