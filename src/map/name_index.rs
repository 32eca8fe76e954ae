//! Who bears which name, kept in step with a world edit by edit.
//!
//! **Invariant**: after [`NameIndex::follow`] it is what [`NameIndex::of`] makes of the edited world.

use std::hash::Hasher;

use crate::units::{InOrder as _, name_key};
use crate::{Entity, Records, World};

/// Everything that bears a name, found by it without a search through the world. A copy shares what it has in common.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NameIndex {
    /// By the hash of the name as [`name_key`] spells it, in the order of [`Entity`], each once.
    bearers: Records<u64, Vec<Entity>>,
}

/// The same on every machine; two names that meet are told apart by the world.
fn hash(key: &str) -> u64 {
    let mut hasher = std::hash::DefaultHasher::new();
    hasher.write(key.as_bytes());
    hasher.finish()
}

impl NameIndex {
    #[must_use]
    pub fn of(world: &World) -> Self {
        let mut bearers = std::collections::BTreeMap::<u64, Vec<Entity>>::new();
        for (entity, name) in world.names() {
            bearers.entry(hash(&name_key(name))).or_default().push(entity);
        }
        for all in bearers.values_mut() {
            all.order();
            all.dedup();
        }
        Self { bearers: bearers.into() }
    }

    /// Follows a world to an edited one.
    pub fn follow(&mut self, before: &World, after: &World) {
        macro_rules! follow {
            ($($records:ident: $entity:ident),*) => {$(
                for (id, was, is) in before.$records.changes(&after.$records) {
                    let keys = [was, is].map(|r| r.map_or_else(Vec::new, |r| keys([&r.name, &r.name_en])));
                    self.rename(Entity::$entity(id), &keys);
                }
            )*};
        }
        follow!(maps: Map, areas: Area, doors: Door, replicas: Replica, places: Place, zones: Zone);
    }

    fn rename(&mut self, entity: Entity, [old, new]: &[Vec<u64>; 2]) {
        for key in old.iter().filter(|key| !new.contains(key)) {
            self.leave(*key, entity);
        }
        for key in new.iter().filter(|key| !old.contains(key)) {
            self.enter(*key, entity);
        }
    }

    fn enter(&mut self, key: u64, entity: Entity) {
        match self.bearers.get_mut(&key) {
            Some(all) => {
                if let Err(at) = all.binary_search(&entity) {
                    all.insert(at, entity);
                }
            }
            None => drop(self.bearers.insert(key, vec![entity])),
        }
    }

    fn leave(&mut self, key: u64, entity: Entity) {
        let Some(all) = self.bearers.get_mut(&key) else { return };
        all.retain(|bearer| *bearer != entity);
        if all.is_empty() {
            self.bearers.remove(&key);
        }
    }

    /// As [`World::find`] of the world of this index.
    #[must_use]
    pub fn find(&self, world: &World, name: &str) -> Vec<Entity> {
        let key = name_key(name);
        let all = self.bearers.get(&hash(&key)).map_or(&[][..], Vec::as_slice);
        let bears = |entity: &&Entity| {
            world.both_names(**entity).iter().any(|n| !n.is_empty() && name_key(n) == key)
        };
        all.iter().filter(bears).copied().collect()
    }
}

/// The hashes of names.
fn keys(names: [&String; 2]) -> Vec<u64> {
    let names = names.into_iter().filter(|name| !name.is_empty());
    names.map(|name| hash(&name_key(name))).collect()
}
