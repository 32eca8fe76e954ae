//! Everything of a kind.
//!
//! Invariant: what a kind means is said here, whoever asks.

use std::borrow::Cow;

use super::Knowledge;
use crate::map::Entity;
use crate::names::chargers;
use crate::question::lexicon::{Extension, KindId, Lexicon};
use crate::question::query::{Noun, Rel, Thing};
use crate::units::{InOrder as _, ObjectId, ReplicaId};
use crate::words::english;

impl Knowledge<'_> {
    /// What shelves are where something is on them, whichever: those of a bookcase as well, which is called otherwise.
    pub(in crate::question) fn shelves<'n>(&self, rel: Rel, noun: &'n Noun) -> Cow<'n, Noun> {
        const SHELVES: &str = "shelves";
        let types = &self.world.types.object;
        let kinds = types.entries.keys().filter(|id| types.has_trait(Some(**id), SHELVES));
        let kinds = kinds.filter_map(|id| self.lexicon().kind_of(&Extension::ObjectType(*id)));
        let kinds: Vec<KindId> = kinds.collect();
        let any = (noun.indefinite || noun.plural) && noun.count.is_none();
        let called = |id: &KindId| english::plural(&self.lexicon().kind(*id).english) == SHELVES;
        let named = |id: &&KindId| noun.head.kinds.contains(id);
        if rel != Rel::On || !any || !kinds.iter().filter(named).any(called) {
            return Cow::Borrowed(noun);
        }
        let mut noun = noun.clone();
        noun.head.kinds.extend(kinds);
        Cow::Owned(noun)
    }

    /// The switches of lights.
    pub(in crate::question) fn switches(&self) -> Vec<Thing> {
        let types = &self.world.types.object;
        let kinds = self.by_type().iter();
        let kinds = kinds.filter(|(kind, _)| types.get(**kind).is_some_and(Lexicon::is_switch));
        kinds.flat_map(|(_, all)| all).map(|id| Thing::Entity(Entity::Replica(*id))).collect()
    }

    /// Everything of a kind.
    pub(in crate::question) fn members(&self, extension: &Extension) -> Vec<Thing> {
        let replica = |&id: &ReplicaId| Thing::Entity(Entity::Replica(id));
        let of_object = |object: ObjectId| {
            let all = self.world.replicas.values().filter(move |r| r.object == object);
            all.map(|r| Thing::Entity(Entity::Replica(r.id))).collect()
        };
        let with_trait = |wanted: &str| -> Vec<Thing> {
            let kinds = self.by_type().iter();
            let kinds = kinds.filter(|(kind, _)| self.world.types.object.has_trait(**kind, wanted));
            let mut found: Vec<Thing> = kinds.flat_map(|(_, all)| all).map(replica).collect();
            found.order();
            found
        };
        match extension {
            Extension::ObjectType(kind) => {
                self.by_type().get(&Some(*kind)).into_iter().flatten().map(replica).collect()
            }
            Extension::Object(object) => of_object(*object),
            Extension::Trait(wanted) => with_trait(wanted),
            Extension::Lighting => {
                let found = with_trait("light");
                // A switch stands for its light only where the map gives the lights themselves no place.
                if found.is_empty() { self.switches() } else { found }
            }
            Extension::Things => self.world.replicas.keys().map(replica).collect(),
            Extension::Furniture => self.furniture().iter().map(replica).collect(),
            Extension::AreaType(kind) => {
                let all = self.world.areas.values().filter(|a| a.area_type == Some(*kind));
                all.map(|a| Thing::Entity(Entity::Area(a.id))).collect()
            }
            Extension::Rooms => {
                self.world.areas.keys().map(|a| Thing::Entity(Entity::Area(*a))).collect()
            }
            Extension::DoorType(kind) => {
                let all = self.world.doors.values().filter(|d| d.door_type == Some(*kind));
                all.map(|d| Thing::Entity(Entity::Door(d.id))).collect()
            }
            Extension::Doors => {
                self.openings().iter().filter(|g| !g.is_passage).map(|g| g.thing).collect()
            }
            Extension::Passages => {
                self.openings().iter().filter(|g| g.is_passage).map(|g| g.thing).collect()
            }
            Extension::Windows => {
                (0..self.lexicon().windows.len()).map(|n| Thing::Window(n as u32)).collect()
            }
            Extension::Places => {
                self.world.places.keys().map(|p| Thing::Entity(Entity::Place(*p))).collect()
            }
            Extension::Storeys | Extension::Building => {
                self.world.maps.keys().map(|m| Thing::Entity(Entity::Map(*m))).collect()
            }
            Extension::Chargers => chargers(self.world).map(Thing::Entity).collect(),
            Extension::Robot => vec![Thing::Robot],
            Extension::Lifts => {
                let stops = self.world.domain.lifts.iter().filter_map(|(_, stops)| stops.first());
                stops.map(|stop| Thing::Entity(Entity::Area(stop.area))).collect()
            }
            Extension::Exits | Extension::OuterDoors => {
                self.openings().iter().filter(|g| g.areas.len() == 1).map(|g| g.thing).collect()
            }
            Extension::Floor
            | Extension::Walls
            | Extension::Corners
            | Extension::Part(_)
            | Extension::Sort(_) => Vec::new(),
        }
    }
}
