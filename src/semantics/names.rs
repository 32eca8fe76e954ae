//! The symbols by which facts speak of a world: the names that people use, made unique.
//!
//! **Invariant:** two different things never share a symbol; a thing whose name is its own keeps it unchanged.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::hash::Hasher;
use std::sync::Arc;

use foldhash::fast::RandomState;

use crate::map::{Entity, World};
use crate::units::{AreaId, DoorId, ObjectId, OrFrId, PlaceId, ReplicaId, name_key};

/// What a symbol can stand for: what people name, and what these are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Subject {
    Entity(Entity),
    /// A kind of thing.
    Object(ObjectId),
    /// An Orthoframe; all Objects that are made of it share it.
    Part(OrFrId),
}

/// Symbols of everything in a world, both ways.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Symbols {
    of: HashMap<Subject, Arc<str>, RandomState>,
    subjects: BTreeMap<Arc<str>, Subject>,
    /// Of every symbol the hash of the name as people spell it.
    taken: HashSet<u64, RandomState>,
    /// Names, so hashed, that more than one subject would have had.
    contested: HashSet<u64, RandomState>,
}

/// Two names that meet are held for one, which costs a derivation and no more.
fn hash(name: &str) -> u64 {
    let mut hasher = std::hash::DefaultHasher::new();
    hasher.write(name_key(name).as_bytes());
    hasher.finish()
}

impl Symbols {
    /// Names everything. Areas, replicas, doors and places come first: theirs are the names that people speak.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let mut symbols = Self::default();
        let Self { of, subjects, taken, contested } = &mut symbols;
        let mut give = |subject: Subject, name: &str, key: &str, n: u32| {
            let wanted = if name.is_empty() { key } else { name };
            let numbered = (0..).map(|i| format!("{wanted} #{}", n + i));
            let candidates = [wanted.to_owned(), format!("{wanted} ({key})")];
            let symbol = candidates
                .into_iter()
                .filter(|c| !c.is_empty() && c != " ()")
                .chain(numbered)
                .find(|c| {
                    let hash = hash(c);
                    let is_free = taken.insert(hash);
                    if !is_free {
                        contested.insert(hash);
                    }
                    is_free
                })
                .expect("the numbers do not end");
            let symbol: Arc<str> = symbol.into();
            subjects.insert(Arc::clone(&symbol), subject);
            of.insert(subject, symbol);
        };
        for a in world.areas.values() {
            give(Subject::Entity(Entity::Area(a.id)), &a.name, &a.key, a.id.0);
        }
        for r in world.replicas.values() {
            give(Subject::Entity(Entity::Replica(r.id)), &r.name, &r.name_en, r.id.0);
        }
        for d in world.doors.values() {
            give(Subject::Entity(Entity::Door(d.id)), &d.name, &d.key, d.id.0);
        }
        for p in world.places.values() {
            give(Subject::Entity(Entity::Place(p.id)), &p.name, &p.name_en, p.id.0);
        }
        for z in world.zones.values() {
            give(Subject::Entity(Entity::Zone(z.id)), &z.name, &z.key, z.id.0);
        }
        for m in world.maps.values() {
            give(Subject::Entity(Entity::Map(m.id)), &m.name, &m.key, m.id.0);
        }
        for o in world.objects.values() {
            give(Subject::Object(o.id), &o.name, &o.key, o.id.0);
        }
        for o in world.orthoframes.values() {
            give(Subject::Part(o.id), &o.name, &o.key, o.id.0);
        }
        symbols
    }

    /// # Panics
    /// When the subject is not of the world that these symbols name.
    #[must_use]
    pub fn symbol(&self, subject: Subject) -> &Arc<str> {
        self.of.get(&subject).expect("every subject of the world has a symbol")
    }

    /// The symbol of a subject, where these symbols name it.
    #[must_use]
    pub fn known(&self, subject: Subject) -> Option<&Arc<str>> {
        self.of.get(&subject)
    }

    /// Whether naming everything anew would give these replicas of an edited world their names for symbols, and all others
    /// the symbols that they have: no such name, the one before or the one now, is wanted by anything else.
    pub(super) fn can_give(&self, names: &[(ReplicaId, &str)]) -> bool {
        let mut new = HashSet::new();
        names.iter().all(|(id, name)| {
            let was = self.known(Subject::Entity(Entity::Replica(*id)));
            let is_own = was.is_none_or(|was| !self.contested.contains(&hash(was)));
            is_own
                && !name.is_empty()
                && !self.taken.contains(&hash(name))
                && new.insert(hash(name))
        })
    }

    /// Gives a replica its name for a symbol; see [`Symbols::can_give`]. The symbol before still leads to it until
    /// [`Symbols::retire`].
    pub(super) fn give(&mut self, id: ReplicaId, name: &str) {
        let subject = Subject::Entity(Entity::Replica(id));
        let symbol: Arc<str> = name.into();
        self.taken.insert(hash(name));
        self.subjects.insert(Arc::clone(&symbol), subject);
        self.of.insert(subject, symbol);
    }

    /// The symbols of these replicas, for [`Symbols::retire`].
    pub(super) fn of_replicas<'i>(
        &'i self,
        ids: impl IntoIterator<Item = &'i ReplicaId>,
    ) -> Vec<(ReplicaId, Arc<str>)> {
        let symbol = |id: &ReplicaId| {
            Some((*id, Arc::clone(self.known(Subject::Entity(Entity::Replica(*id)))?)))
        };
        ids.into_iter().filter_map(symbol).collect()
    }

    /// Forgets of these symbols those that replicas had and have no more.
    pub(super) fn retire(&mut self, before: &[(ReplicaId, Arc<str>)]) {
        for (id, was) in before {
            let now = self.known(Subject::Entity(Entity::Replica(*id)));
            if now.is_some_and(|now| now != was) {
                self.subjects.remove(was);
                self.taken.remove(&hash(was));
            }
        }
    }

    /// What a name means, spelled as people spell: case and ё do not matter.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<Subject> {
        let exact = self.subjects.get(name).copied();
        exact.or_else(|| {
            let key = name_key(name);
            self.subjects.iter().find(|(s, _)| name_key(s) == key).map(|(_, &subject)| subject)
        })
    }

    #[must_use]
    pub fn subject(&self, symbol: &str) -> Option<Subject> {
        self.subjects.get(symbol).copied()
    }

    /// The replica that a column of a tuple names.
    pub(super) fn replica_of(&self, symbol: Option<&str>) -> Option<ReplicaId> {
        match self.subject(symbol?)? {
            Subject::Entity(Entity::Replica(id)) => Some(id),
            _ => None,
        }
    }

    /// The Area that a column of a tuple names.
    pub(super) fn area_of(&self, symbol: Option<&str>) -> Option<AreaId> {
        match self.subject(symbol?)? {
            Subject::Entity(Entity::Area(id)) => Some(id),
            _ => None,
        }
    }

    pub(super) fn area(&self, id: AreaId) -> &Arc<str> {
        self.symbol(Subject::Entity(Entity::Area(id)))
    }

    pub(super) fn replica(&self, id: ReplicaId) -> &Arc<str> {
        self.symbol(Subject::Entity(Entity::Replica(id)))
    }

    pub(super) fn door(&self, id: DoorId) -> &Arc<str> {
        self.symbol(Subject::Entity(Entity::Door(id)))
    }

    pub(super) fn place(&self, id: PlaceId) -> &Arc<str> {
        self.symbol(Subject::Entity(Entity::Place(id)))
    }

    pub(super) fn object(&self, id: ObjectId) -> &Arc<str> {
        self.symbol(Subject::Object(id))
    }

    pub(super) fn part(&self, id: OrFrId) -> &Arc<str> {
        self.symbol(Subject::Part(id))
    }
}
