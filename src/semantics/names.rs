//! The symbols by which facts speak of a world: the names that people use, made unique.
//!
//! **Invariant:** two different things never share a symbol; a thing whose name is its own keeps it unchanged.

use std::collections::hash_map::Entry;
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
    /// Of every symbol the hash of the name as people spell it, and whose it is.
    taken: HashMap<u64, Subject, RandomState>,
    /// Of names, so hashed, that others would have had, how many.
    contested: HashMap<u64, u32, RandomState>,
}

/// What a subject may be called by: its name, and what tells it from others of that name.
type Called<'w> = (&'w str, &'w str, u32);

/// The symbols that a subject would have, the dearest first.
fn candidates((name, key, n): Called<'_>) -> impl Iterator<Item = String> {
    let wanted = if name.is_empty() { key } else { name };
    let numbered = (0..).map(move |i| format!("{wanted} #{}", n + i));
    let first = [wanted.to_owned(), format!("{wanted} ({key})")].into_iter();
    first.filter(|c| !c.is_empty() && c != " ()").chain(numbered)
}

/// What a world calls a subject; none where it has no such subject.
fn called(world: &World, subject: Subject) -> Option<Called<'_>> {
    macro_rules! called {
        ($records:ident, $id:expr, $key:ident) => {
            world.$records.get(&$id).map(|r| (r.name.as_str(), r.$key.as_str(), $id.0))
        };
    }
    match subject {
        Subject::Entity(Entity::Area(id)) => called!(areas, id, key),
        Subject::Entity(Entity::Replica(id)) => called!(replicas, id, name_en),
        Subject::Entity(Entity::Door(id)) => called!(doors, id, key),
        Subject::Entity(Entity::Place(id)) => called!(places, id, name_en),
        Subject::Entity(Entity::Zone(id)) => called!(zones, id, key),
        Subject::Entity(Entity::Map(id)) => called!(maps, id, key),
        Subject::Object(id) => called!(objects, id, key),
        Subject::Part(id) => called!(orthoframes, id, key),
    }
}

/// Who is named before whom: theirs are the names that people speak.
fn rank(subject: Subject) -> (u8, u32) {
    match subject {
        Subject::Entity(Entity::Area(id)) => (0, id.0),
        Subject::Entity(Entity::Replica(id)) => (1, id.0),
        Subject::Entity(Entity::Door(id)) => (2, id.0),
        Subject::Entity(Entity::Place(id)) => (3, id.0),
        Subject::Entity(Entity::Zone(id)) => (4, id.0),
        Subject::Entity(Entity::Map(id)) => (5, id.0),
        Subject::Object(id) => (6, id.0),
        Subject::Part(id) => (7, id.0),
    }
}

/// Two names that meet are held for one, which costs a derivation and no more.
fn hash(name: &str) -> u64 {
    let mut hasher = std::hash::DefaultHasher::new();
    hasher.write(name_key(name).as_bytes());
    hasher.finish()
}

impl Symbols {
    /// Names everything, in the order of their ranks.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let mut symbols = Self::default();
        macro_rules! name {
            ($records:ident, $subject:expr) => {
                for id in world.$records.keys() {
                    let subject = $subject(*id);
                    let called = called(world, subject).expect("it is one of the world's");
                    symbols.enter(subject, called);
                }
            };
        }
        name!(areas, |id| Subject::Entity(Entity::Area(id)));
        name!(replicas, |id| Subject::Entity(Entity::Replica(id)));
        name!(doors, |id| Subject::Entity(Entity::Door(id)));
        name!(places, |id| Subject::Entity(Entity::Place(id)));
        name!(zones, |id| Subject::Entity(Entity::Zone(id)));
        name!(maps, |id| Subject::Entity(Entity::Map(id)));
        name!(objects, Subject::Object);
        name!(orthoframes, Subject::Part);
        symbols
    }

    /// Gives a subject the first symbol that nobody has; of those that it would rather have had it is noted.
    fn enter(&mut self, subject: Subject, called: Called<'_>) {
        let Self { of, subjects, taken, contested } = self;
        let is_free = |candidate: &String| match taken.entry(hash(candidate)) {
            Entry::Vacant(place) => {
                place.insert(subject);
                true
            }
            Entry::Occupied(place) => {
                *contested.entry(*place.key()).or_default() += 1;
                false
            }
        };
        let symbol: Arc<str> =
            candidates(called).find(is_free).expect("the numbers do not end").into();
        subjects.insert(Arc::clone(&symbol), subject);
        of.insert(subject, symbol);
    }

    /// Names these subjects, of replicas those that are gone, as an edited world calls them: as naming everything anew would. The symbols
    /// that they had still lead to them until [`Symbols::retire`]. None where others might get another one with them;
    /// these symbols are then of neither world.
    pub(super) fn rename(
        &mut self,
        before: &World,
        after: &World,
        changed: impl Iterator<Item = Subject>,
    ) -> Option<Vec<(Subject, Option<Arc<str>>)>> {
        let mut changed: Vec<Subject> =
            changed.filter(|s| called(before, *s) != called(after, *s)).collect();
        changed.sort_unstable_by_key(|subject| rank(*subject));
        let mut old = Vec::new();
        for &subject in &changed {
            let (Some(called), Some(symbol)) = (called(before, subject), self.known(subject))
            else {
                old.push((subject, None));
                continue;
            };
            let symbol = Arc::clone(symbol);
            for skipped in candidates(called).take_while(|c| **c != *symbol) {
                let hash = hash(&skipped);
                let count = self.contested.get_mut(&hash)?;
                *count -= 1;
                if *count == 0 {
                    self.contested.remove(&hash);
                }
            }
            old.push((subject, Some(symbol)));
        }
        // What nobody else would have had is given free without any one getting it.
        let mut left = old.iter().filter_map(|(_, symbol)| symbol.as_ref());
        if left.any(|symbol| self.contested.contains_key(&hash(symbol))) {
            return None;
        }
        for subject in changed {
            let Some(called) = called(after, subject) else { continue };
            for candidate in candidates(called) {
                match self.taken.get(&hash(&candidate)) {
                    None => break,
                    // One who comes after it would have to give way, and of those who go it is not known who follows.
                    Some(owner)
                        if rank(*owner) >= rank(subject)
                            || self::called(after, *owner).is_none()
                            || old.iter().any(|(of, _)| of == owner) =>
                    {
                        return None;
                    }
                    Some(_) => {}
                }
            }
            self.enter(subject, called);
        }
        Some(old)
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

    /// Lets subjects have these symbols, and tells those that they had.
    pub(super) fn swap(&mut self, symbols: &mut [(Subject, Option<Arc<str>>)]) {
        for (subject, symbol) in symbols {
            let new = symbol.take();
            *symbol = match new {
                Some(new) => self.of.insert(*subject, new),
                None => self.of.remove(subject),
            };
        }
    }

    /// Whether naming everything anew would give these replicas of an edited world their names for symbols, and all others
    /// the symbols that they have: no such name, the one before or the one now, is wanted by anything else.
    pub(super) fn can_give(&self, names: &[(ReplicaId, &str)]) -> bool {
        let mut new = HashSet::new();
        names.iter().all(|(id, name)| {
            let was = self.known(Subject::Entity(Entity::Replica(*id)));
            let is_own = was.is_none_or(|was| !self.contested.contains_key(&hash(was)));
            is_own
                && !name.is_empty()
                && !self.taken.contains_key(&hash(name))
                && new.insert(hash(name))
        })
    }

    /// Gives a replica its name for a symbol; see [`Symbols::can_give`]. The symbol before still leads to it until
    /// [`Symbols::retire`].
    pub(super) fn give(&mut self, id: ReplicaId, name: &str) {
        let subject = Subject::Entity(Entity::Replica(id));
        let symbol: Arc<str> = name.into();
        self.taken.insert(hash(name), subject);
        self.subjects.insert(Arc::clone(&symbol), subject);
        self.of.insert(subject, symbol);
    }

    /// The symbols of these replicas, for [`Symbols::retire`].
    pub(super) fn of_replicas<'i>(
        &'i self,
        ids: impl IntoIterator<Item = &'i ReplicaId>,
    ) -> Vec<(Subject, Arc<str>)> {
        let subjects = ids.into_iter().map(|id| Subject::Entity(Entity::Replica(*id)));
        subjects.filter_map(|s| Some((s, Arc::clone(self.known(s)?)))).collect()
    }

    /// Forgets of these symbols those that their subjects had and have no more. One that is gone keeps its own, unless it
    /// `is_gone` for good.
    pub(super) fn retire(
        &mut self,
        before: &[(Subject, Arc<str>)],
        is_gone: impl Fn(Subject) -> bool,
    ) {
        for (subject, was) in before {
            if is_gone(*subject) {
                self.of.remove(subject);
            } else if self.known(*subject).is_none_or(|now| now == was) {
                continue;
            }
            self.subjects.remove(was);
            self.taken.remove(&hash(was));
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

    pub fn area(&self, id: AreaId) -> &Arc<str> {
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
