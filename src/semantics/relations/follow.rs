//! From the relations of one world to those of another that a robot made of it: things moved, taken away and put back,
//! doors opened, lamps switched.
//!
//! **Invariant**: afterwards the derived relations are those that [`derive()`](super::derive) gives of the other world.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::facts::{FactError, RelationId, Value};
use crate::feed::{Cell, Feed};
use crate::map::{Entity, Object, World};
use crate::names::Subject;
use crate::units::{DoorId, Gather as _, MapId, ObjectId, ReplicaId};

use super::rows::{note, tuple};
use super::{RelationError, Relations, derive};
use crate::told::Told;

/// Beyond so many changed things, deriving all relations anew costs less than following each.
const MOST_FOLLOWED: usize = 200;

/// Input rows on their way out and in. A row that stays is in both.
#[derive(Default)]
pub(super) struct Difference {
    pub(super) out: BTreeSet<(&'static str, Vec<Value>)>,
    pub(super) into: BTreeSet<(&'static str, Vec<Value>)>,
}

/// A world and its relations, which follow it from one state to the next.
#[derive(Debug, Clone)]
pub struct Followed {
    pub(super) world: Arc<World>,
    pub(super) relations: Arc<Relations>,
    pub(super) told: Told,
    /// Following broke off halfway: next time they are derived anew.
    is_spoilt: bool,
}

impl Followed {
    /// `relations` are those of `world`. Both may be shared: what follows is a copy, made when it is first needed.
    #[must_use]
    pub fn new(world: Arc<World>, relations: Arc<Relations>) -> Self {
        Self { world, relations, told: Told::default(), is_spoilt: false }
    }

    /// Those of the world that was followed last.
    #[must_use]
    pub fn relations(&self) -> &Relations {
        &self.relations
    }

    /// The same, to be kept.
    #[must_use]
    pub fn shared(&self) -> Arc<Relations> {
        Arc::clone(&self.relations)
    }

    /// What was told last.
    #[must_use]
    pub fn told(&self) -> &Told {
        &self.told
    }

    /// The relations of the world as it now is: followed from those before where they can be, else derived anew.
    ///
    /// # Errors
    /// As [`derive()`].
    pub fn of(&mut self, now: &World) -> Result<&Relations, RelationError> {
        if self.is_spoilt || *self.world != *now {
            let mut follow = || {
                matches!(
                    Arc::make_mut(&mut self.relations).follow_world(&self.world, now),
                    Ok(true)
                )
            };
            if self.is_spoilt || !follow() {
                self.is_spoilt = true;
                let relations = derive(now, self.relations.rules(), now.domain.profile)?;
                (self.relations, self.is_spoilt) = (Arc::new(relations), false);
            }
            self.world = Arc::new(now.clone());
        }
        Ok(&self.relations)
    }
}

impl Relations {
    /// Follows from the world of these relations to one that differs in its things, in the states of its doors, or as an
    /// edited building does: see `building`. `false` where so much differs that deriving anew is cheaper, or what things
    /// are called has to be told anew; these relations may then be of neither world.
    ///
    /// # Errors
    /// As [`derive()`](super::derive).
    pub fn follow_world(&mut self, before: &World, after: &World) -> Result<bool, RelationError> {
        if !before.is_same_building(after) {
            return self.follow_building(before, after);
        }
        let Some((replicas, doors)) = self.followed(before, after) else { return Ok(false) };
        let Some(named) = self.named(before, after, &replicas) else { return Ok(false) };
        let symbols = self.symbols.of_replicas(named.keys());
        // What is new has no symbol that could be told before.
        for (id, name) in &named {
            if self.symbols.known(Subject::Entity(Entity::Replica(*id))).is_none() {
                self.symbols.give(*id, name);
            }
        }
        let mut rows = Difference::default();
        let hung = self.hung_with(&doors);
        self.openings_and_properties(before, &hung, &replicas, &doors, |rel, row| {
            rows.out.insert((rel, row));
        });
        for &id in &replicas {
            let change = self.measured.update(after, id);
            let mut put = |rel: &'static str, cells: &[Cell<'_>]| {
                rows.out.insert((rel, tuple(cells)));
            };
            // All that is measured by now is in this one, and Objects are the same in both.
            let world = if after.replicas.contains_key(&id) { after } else { before };
            let feed = Feed {
                world,
                symbols: &self.symbols,
                measured: &self.measured,
                openings: &self.openings,
            };
            change.single_before.iter().for_each(|s| feed.single(id, s, &mut put));
            change.removed.iter().for_each(|(&key, pair)| feed.pair(key, pair, &mut put));
            for &map in before.maps.keys() {
                rows.out.insert(self.asked(id, map));
            }
            if let Some(name) = named.get(&id) {
                self.symbols.give(id, name);
            }
            let feed = Feed {
                world,
                symbols: &self.symbols,
                measured: &self.measured,
                openings: &self.openings,
            };
            let mut back: Vec<(&'static str, Vec<Value>)> = Vec::new();
            let mut put = |rel: &'static str, cells: &[Cell<'_>]| back.push((rel, tuple(cells)));
            change.single_after.iter().for_each(|s| feed.single(id, s, &mut put));
            for key in &change.added {
                if let Some(pair) = self.measured.pairs().get(key) {
                    feed.pair(*key, pair, &mut put);
                }
            }
            rows.into.extend(back);
            if let Some(map) = self.measured.map_of(id).filter(|_| self.measured.asks_of_all()) {
                rows.into.insert(self.asked(id, map));
            }
            self.apply(&mut rows)?;
        }
        self.openings_and_properties(after, &hung, &replicas, &doors, |rel, row| {
            rows.into.insert((rel, row));
        });
        self.apply(&mut rows)?;
        self.live.update()?;
        self.follow(BTreeSet::new());
        self.symbols.retire(&symbols, |_| false);
        Ok(true)
    }

    /// The replicas that get another symbol, with their names; none where others might get another one with them.
    pub(super) fn named<'w>(
        &self,
        before: &World,
        after: &'w World,
        replicas: &[ReplicaId],
    ) -> Option<BTreeMap<ReplicaId, &'w str>> {
        let mut named = Vec::new();
        for id in replicas {
            let Some(is) = after.replicas.get(id) else { continue };
            let symbol = self.symbols.known(Subject::Entity(Entity::Replica(*id)));
            let has_own = symbol.is_some_and(|symbol| **symbol == *is.name);
            match before.replicas.get(id) {
                // What was there once, and is put back, still has its symbol.
                None if has_own => {}
                Some(was) if was.name == is.name => {
                    // A symbol that is not the name may be made of the English one.
                    if !has_own && was.name_en != is.name_en {
                        return None;
                    }
                }
                _ => named.push((*id, is.name.as_str())),
            }
        }
        // A passage without a name is called by what no thing is called, with a number where it must be.
        let of_opening = |name: &str| {
            let is_like = |own: &str| {
                own.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
            };
            self.openings.iter().any(|o| o.door.is_none() && is_like(&o.name))
        };
        let old = named.iter().filter_map(|(id, _)| before.replicas.get(id)).map(|r| &*r.name);
        if old.chain(named.iter().map(|(_, name)| *name)).any(of_opening) {
            return None;
        }
        self.symbols.can_give(&named).then(|| named.into_iter().collect())
    }

    /// The row by which OUTSIDE is derived of a thing.
    pub(super) fn asked(&self, thing: ReplicaId, map: MapId) -> (&'static str, Vec<Value>) {
        let map = self.symbols.symbol(Subject::Entity(Entity::Map(map)));
        ("asked", tuple(&[Cell::Name(self.symbols.replica(thing)), Cell::Name(map)]))
    }

    /// The replicas and doors that differ; none where something else does, or too much.
    fn followed(&self, before: &World, after: &World) -> Option<(Vec<ReplicaId>, Vec<DoorId>)> {
        // What is gone goes first: nothing that is measured afterwards may lie beside it.
        let (mut replicas, mut stays) = (Vec::new(), Vec::new());
        for (id, was, is) in before.replicas.changes(&after.replicas) {
            match (was, is) {
                (_, None) => replicas.push(id),
                // What is made otherwise is another thing.
                (Some(was), Some(is)) if was.object != is.object => return None,
                (_, Some(_)) => stays.push(id),
            }
        }
        replicas.extend(stays);
        let doors = before.doors.changes(&after.doors).into_iter().map(|(id, ..)| id).collect();
        (replicas.len() <= MOST_FOLLOWED).then_some((replicas, doors))
    }

    /// The names of the openings in which one of these doors hangs.
    pub(super) fn hung_with(&self, doors: &[DoorId]) -> BTreeSet<String> {
        let openings = self.openings.iter().filter(|_| !doors.is_empty());
        let hung = openings.filter(|o| o.door.is_some_and(|door| doors.contains(&door)));
        hung.map(|o| o.name.clone()).gather()
    }

    /// Rows of the openings of these names, and of the properties of what differs.
    pub(super) fn openings_and_properties(
        &self,
        world: &World,
        openings: &BTreeSet<String>,
        replicas: &[ReplicaId],
        doors: &[DoorId],
        mut put: impl FnMut(&'static str, Vec<Value>),
    ) {
        let mut sink = |rel: &'static str, cells: &[Cell<'_>]| put(rel, tuple(cells));
        let feed = Feed {
            world,
            symbols: &self.symbols,
            measured: &self.measured,
            openings: &self.openings,
        };
        if !openings.is_empty() {
            feed.openings(|opening| openings.contains(&opening.name), &mut sink);
        }
        doors.iter().for_each(|&door| feed.door_properties(door, &mut sink));
        // A door of furniture tells the state of what it belongs to.
        let hung = |o: &&Object| o.doors.iter().any(|mount| doors.contains(&mount.door));
        let objects = world.objects.values().filter(|_| !doors.is_empty());
        let hung: BTreeSet<ObjectId> = objects.filter(hung).map(|o| o.id).gather();
        let mut changed: BTreeSet<ReplicaId> = replicas.iter().copied().gather();
        if !hung.is_empty() {
            let bearing = world.replicas.values().filter(|r| hung.contains(&r.object));
            changed.extend(bearing.map(|r| r.id));
        }
        changed.into_iter().for_each(|id| feed.replica_properties(id, &mut sink));
    }

    /// Takes rows out and puts others in; those in both stay as they are. What the rule text does not declare is in neither.
    pub(super) fn apply(&mut self, rows: &mut Difference) -> Result<(), RelationError> {
        let mut fault: Option<FactError> = None;
        let Difference { out, into } = std::mem::take(rows);
        let program = self.rules.program();
        let mut last: (&str, Option<RelationId>) = ("", None);
        let mut declared = |relation: &'static str| {
            if last.0 != relation {
                last = (relation, program.relation(relation));
            }
            last.1
        };
        for (relation, row) in out.difference(&into) {
            if let Some(relation) = declared(relation)
                && let Err(e) = self.live.remove(relation, row)
            {
                note(&mut fault, e);
            }
        }
        for (relation, row) in &into {
            if let Some(relation) = declared(relation)
                && let Err(e) = self.live.insert(relation, row)
            {
                note(&mut fault, e);
            }
        }
        fault.map_or(Ok(()), |fault| Err(RelationError::Schema { fault }))
    }
}
