//! The symbols by which facts speak of a world: the names that people use, made unique.
//!
//! **Invariant:** two different things never share a symbol; a thing whose name is its own keeps it unchanged.

use std::collections::{BTreeMap, HashMap, HashSet};
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
}

impl Symbols {
    /// Names everything. Areas, replicas, doors and places come first: theirs are the names that people speak.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let mut symbols = Self::default();
        let mut taken = HashSet::new();
        let mut give = |subject: Subject, name: &str, key: &str, n: u32| {
            let wanted = if name.is_empty() { key } else { name };
            let numbered = (0..).map(|i| format!("{wanted} #{}", n + i));
            let candidates = [wanted.to_owned(), format!("{wanted} ({key})")];
            let symbol = candidates
                .into_iter()
                .filter(|c| !c.is_empty() && c != " ()")
                .chain(numbered)
                .find(|c| taken.insert(name_key(c)))
                .expect("the numbers do not end");
            let symbol: Arc<str> = symbol.into();
            symbols.subjects.insert(Arc::clone(&symbol), subject);
            symbols.of.insert(subject, symbol);
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
