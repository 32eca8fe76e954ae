//! Names: whatever a person can speak of bears a name of its own, in either language.

use std::collections::{BTreeSet, HashMap};

use crate::fault::{MapError, Record, Spot};
use crate::units::{Bilingual, Gather as _, InOrder as _, Piece, name_key, said, word};
use crate::{Entity, TypeKind, World};

use super::{Checker, Scope};

impl Checker<'_> {
    pub(super) fn names(&mut self) {
        let world = self.world;
        if let Some(scope) = self.scope {
            self.some_names(scope);
            return TypeKind::ALL.into_iter().for_each(|kind| self.type_names(kind));
        }
        let mut bearers: HashMap<String, Entity> = HashMap::new();
        for (entity, name) in world.names() {
            let first = *bearers.entry(name_key(name)).or_insert(entity);
            if first != entity {
                self.borne_twice(name, first, entity);
            }
        }
        self.nameless();
        for kind in TypeKind::ALL {
            self.type_names(kind);
        }
    }

    /// The same of the names in a scope, where all others are known to be in order or as they were.
    fn some_names(&mut self, scope: &Scope<'_>) {
        let world = self.world;
        let Some((spoken, bearers)) = &scope.names else { return };
        let keys: BTreeSet<String> = spoken.iter().map(|name| name_key(name)).gather();
        let mut twice = Vec::new();
        for key in &keys {
            let all = bearers.find(world, key);
            let Some((&first, others)) = all.split_first() else { continue };
            for &entity in others {
                let names = world.both_names(entity).into_iter().enumerate();
                let of_key = names.filter(|(_, n)| !n.is_empty() && name_key(n) == *key);
                twice.extend(of_key.map(|(field, name)| (entity, field, name, first)));
            }
        }
        // In the order of the whole check.
        twice.order();
        for (entity, _, name, first) in twice {
            self.borne_twice(name, first, entity);
        }
        for &entity in &scope.entities {
            if world.has(entity) && world.name(entity).trim().is_empty() {
                self.has_no_name(entity);
            }
        }
    }

    fn borne_twice(&mut self, name: &str, first: Entity, second: Entity) {
        let world = self.world;
        let [one, other] = [first, second].map(|entity| title(world, entity));
        let error = MapError::DuplicateName {
            name: name.to_owned(),
            other: format!("{}-2", name.trim()),
            first: one,
            second: other,
        };
        self.contradiction(error, spot(second, world, name), spot(first, world, name));
    }

    fn has_no_name(&mut self, entity: Entity) {
        let at = Spot::of(entity.into()).field("name");
        self.fault(MapError::NoName { what: kind(entity).into() }, at);
    }

    fn nameless(&mut self) {
        let w = self.world;
        let named = w
            .maps
            .values()
            .map(|m| (Entity::Map(m.id), &m.name))
            .chain(w.areas.values().map(|a| (Entity::Area(a.id), &a.name)))
            .chain(w.doors.values().map(|d| (Entity::Door(d.id), &d.name)))
            .chain(w.replicas.values().map(|r| (Entity::Replica(r.id), &r.name)))
            .chain(w.places.values().map(|p| (Entity::Place(p.id), &p.name)))
            .chain(w.zones.values().map(|z| (Entity::Zone(z.id), &z.name)));
        let nameless: Vec<_> = named.filter(|(_, name)| name.trim().is_empty()).collect();
        for (entity, _) in nameless {
            self.has_no_name(entity);
        }
    }

    /// Types are referred to by their Russian names.
    fn type_names(&mut self, kind: TypeKind) {
        let mut bearers = HashMap::new();
        for entry in self.world.types.list(kind).entries.values() {
            let spot = Spot::of(Record::Type(kind, entry.id));
            if entry.name.trim().is_empty() {
                self.fault(MapError::NoName { what: said!("type") }, spot);
            } else if let Some(&first) = bearers.get(&entry.name) {
                let list = kind.field();
                let words = |id: crate::units::TypeId| said!("type-of-the-list", id = id.0, list);
                let error = MapError::DuplicateName {
                    name: entry.name.clone(),
                    other: format!("{}-2", entry.name.trim()),
                    first: words(first),
                    second: words(entry.id),
                };
                self.contradiction(error, spot, Spot::of(Record::Type(kind, first)));
            } else {
                bearers.insert(entry.name.clone(), entry.id);
            }
        }
    }
}

impl From<Entity> for Record {
    fn from(entity: Entity) -> Self {
        match entity {
            Entity::Map(id) => Self::Map(id),
            Entity::Area(id) => Self::Area(id),
            Entity::Door(id) => Self::Door(id),
            Entity::Replica(id) => Self::Replica(id),
            Entity::Place(id) => Self::Place(id),
            Entity::Zone(id) => Self::Zone(id),
        }
    }
}

fn kind(entity: Entity) -> Piece {
    match entity {
        Entity::Map(_) => word!("map-2"),
        Entity::Area(_) => word!("area"),
        Entity::Door(_) => word!("door-2"),
        Entity::Replica(_) => word!("replica"),
        Entity::Place(_) => word!("place"),
        Entity::Zone(_) => word!("zone"),
    }
}

fn title(world: &World, entity: Entity) -> Bilingual {
    Bilingual::named(kind(entity), world.name(entity))
}

/// The field that holds the name.
fn spot(entity: Entity, world: &World, name: &str) -> Spot {
    let field = if world.name(entity) == name { "name" } else { "name_en" };
    Spot::of(entity.into()).field(field)
}
