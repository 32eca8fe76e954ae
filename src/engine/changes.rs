//! Since when an id of the map means what it means: what a dialogue remembers is compared with this.
//!
//! **Invariant.** A thing that left the map is known by the name that it had, and whoever bears its id later is another.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::language::names::{english_name, hints};
use crate::language::question::{Departed, Stamp, Thing};
use crate::map::{Entity, Replica, World};
use crate::units::ReplicaId;

/// The changes that a map has seen since it was opened.
#[derive(Debug, Clone)]
pub(super) struct Changes {
    /// Which map, among all that this program has opened.
    map: u64,
    /// How many changes it has seen, those that the robot made among them.
    count: u64,
    /// The last one that was more than a move or what the robot did: names, kinds, values and openings count from there.
    vocabulary: u64,
    /// The last one that changed more than things.
    building: u64,
    /// What left the map, and by which change.
    gone: BTreeMap<Entity, (u64, Departed)>,
}

impl Default for Changes {
    fn default() -> Self {
        static MAPS: AtomicU64 = AtomicU64::new(0);
        let map = MAPS.fetch_add(1, Ordering::Relaxed);
        Self { map, count: 0, vocabulary: 0, building: 0, gone: BTreeMap::new() }
    }
}

impl Changes {
    /// The robot did something, or something was seen.
    pub(super) fn note_action(&mut self) {
        self.count += 1;
    }

    /// The map became another one; `changed` are the things that differ, where nothing else does. Where ids are given
    /// once for ever (in a store), what comes back is what it was.
    pub(super) fn note(
        &mut self,
        before: &World,
        after: &World,
        changed: Option<&[ReplicaId]>,
        ids_are_unique: bool,
    ) {
        self.count += 1;
        let Some(changed) = changed else {
            (self.building, self.vocabulary) = (self.count, self.count);
            for entity in entities_gone(before, after) {
                self.gone.insert(entity, (self.count, departed(before, entity)));
            }
            if ids_are_unique {
                self.gone.retain(|entity, _| !after.has(*entity));
            }
            return;
        };
        for id in changed {
            let entity = Entity::Replica(*id);
            match (before.replicas.get(id), after.replicas.get(id)) {
                (Some(was), Some(is)) => {
                    let moved = Replica { area: is.area, frame: is.frame, ..was.clone() };
                    if moved == *is {
                        continue;
                    }
                }
                (Some(_), None) => {
                    self.gone.insert(entity, (self.count, departed(before, entity)));
                }
                (None, _) if ids_are_unique => {
                    self.gone.remove(&entity);
                }
                (None, _) => {}
            }
            self.vocabulary = self.count;
        }
    }

    /// Whether names, kinds or openings may be others than they were.
    pub(super) fn has_renamed_since(&self, stamp: Stamp) -> bool {
        stamp.map != self.map || self.vocabulary > stamp.change
    }

    /// What a thing was that left the map since then, as far as that is known; none where the map still has it.
    pub(super) fn departed(&self, thing: Thing, since: Stamp, world: &World) -> Option<Departed> {
        match thing {
            Thing::Entity(entity) => match self.gone.get(&entity) {
                Some((left, departed)) if *left > since.change => Some(departed.clone()),
                _ => (!world.has(entity)).then(Departed::default),
            },
            Thing::Opening(_) | Thing::Window(_) => {
                (self.building > since.change).then(Departed::default)
            }
            Thing::Robot => None,
        }
    }

    pub(super) fn stamp(&self) -> Stamp {
        Stamp { map: self.map, change: self.count }
    }
}

/// What is of the first world alone.
fn entities_gone(before: &World, after: &World) -> Vec<Entity> {
    let mut gone = Vec::new();
    macro_rules! note {
        ($($records:ident: $entity:ident),*) => {$(
            let changes = before.$records.changes(&after.$records).into_iter();
            gone.extend(changes.filter(|(.., is)| is.is_none()).map(|(id, ..)| Entity::$entity(id)));
        )*};
    }
    note!(maps: Map, areas: Area, doors: Door, replicas: Replica, places: Place, zones: Zone);
    gone
}

fn departed(world: &World, entity: Entity) -> Departed {
    let (name, english) = (world.name(entity).to_owned(), english_name(world, entity).to_owned());
    Departed { name, english, hints: hints(world, entity) }
}
