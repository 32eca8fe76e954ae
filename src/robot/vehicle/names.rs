//! The names of a map, for a vehicle that does not know its numbers.

use std::collections::{BTreeMap, HashMap};

use crate::map::{Entity, World};
use crate::units::{AreaId, DoorId, MapId, ReplicaId, name_key};

use super::protocol::{No, Place, Sight, Stand, Thing, door_state};
use super::{Obstruction, Refusal, Sighting};

/// What is called how, in either language.
#[derive(Debug, Clone)]
pub(super) struct Names {
    pub(super) domain: String,
    entities: HashMap<String, Entity>,
    names: BTreeMap<Entity, String>,
    lifts: Vec<String>,
}

/// A name that the map does not have, or a number that cannot be.
pub(super) type Wrong = String;

impl Names {
    pub(super) fn of(world: &World) -> Self {
        let mut entities = HashMap::new();
        let mut names = BTreeMap::new();
        for (entity, name) in world.names() {
            entities.entry(name_key(name)).or_insert(entity);
            // The Russian name comes first.
            names.entry(entity).or_insert_with(|| name.to_owned());
        }
        let lifts = world.domain.lifts.iter().map(|(name, _)| name.clone()).collect();
        Self { domain: world.domain.name.clone(), entities, names, lifts }
    }

    fn name(&self, entity: Entity) -> String {
        self.names.get(&entity).cloned().unwrap_or_default()
    }

    pub(super) fn map_name(&self, id: MapId) -> String {
        self.name(Entity::Map(id))
    }

    pub(super) fn area_name(&self, id: AreaId) -> String {
        self.name(Entity::Area(id))
    }

    pub(super) fn door_name(&self, id: DoorId) -> String {
        self.name(Entity::Door(id))
    }

    pub(super) fn thing_name(&self, id: ReplicaId) -> String {
        self.name(Entity::Replica(id))
    }

    pub(super) fn lift_name(&self, lift: usize) -> String {
        self.lifts.get(lift).cloned().unwrap_or_default()
    }

    fn find(&self, name: &str) -> Option<Entity> {
        self.entities.get(&name_key(name)).copied()
    }

    pub(super) fn map(&self, name: &str) -> Result<MapId, Wrong> {
        match self.find(name) {
            Some(Entity::Map(id)) => Ok(id),
            _ => Err(name.to_owned()),
        }
    }

    pub(super) fn area(&self, name: &str) -> Result<AreaId, Wrong> {
        match self.find(name) {
            Some(Entity::Area(id)) => Ok(id),
            _ => Err(name.to_owned()),
        }
    }

    pub(super) fn door(&self, name: &str) -> Result<DoorId, Wrong> {
        match self.find(name) {
            Some(Entity::Door(id)) => Ok(id),
            _ => Err(name.to_owned()),
        }
    }

    pub(super) fn thing(&self, name: &str) -> Result<ReplicaId, Wrong> {
        match self.find(name) {
            Some(Entity::Replica(id)) => Ok(id),
            _ => Err(name.to_owned()),
        }
    }

    pub(super) fn lift(&self, name: &str) -> Result<usize, Wrong> {
        self.lifts.iter().position(|lift| lift == name).ok_or_else(|| name.to_owned())
    }

    pub(super) fn stand(&self, (map, pose): (MapId, crate::units::Pose)) -> Stand {
        Stand::new(&self.map_name(map), pose)
    }

    pub(super) fn told(&self, what: Obstruction) -> Thing {
        let known = |name: String, told: fn(String) -> Thing| match name.is_empty() {
            true => Thing::Unknown,
            false => told(name),
        };
        match what {
            Obstruction::Wall(area) => known(self.area_name(area), Thing::Wall),
            Obstruction::Door(door) => known(self.door_name(door), Thing::Door),
            Obstruction::Replica(thing) => known(self.thing_name(thing), Thing::Thing),
            Obstruction::Something => Thing::Unknown,
        }
    }

    /// What stands somewhere; what the map does not have is something all the same.
    pub(super) fn obstruction(&self, told: &Thing) -> Obstruction {
        let known = match told {
            Thing::Wall(name) => self.area(name).map(Obstruction::Wall),
            Thing::Door(name) => self.door(name).map(Obstruction::Door),
            Thing::Thing(name) => self.thing(name).map(Obstruction::Replica),
            Thing::Unknown => Ok(Obstruction::Something),
        };
        known.unwrap_or(Obstruction::Something)
    }

    pub(super) fn sight(&self, seen: Sighting) -> Sight {
        match seen {
            Sighting::Door { door, state } => Sight::Door {
                door: self.door_name(door),
                status: state.status.into(),
                opening: state.opening,
            },
            Sighting::Replica { replica, area, frame } => Sight::Thing {
                thing: self.thing_name(replica),
                place: Place::new(&self.area_name(area), frame),
            },
        }
    }

    pub(super) fn sighting(&self, told: &Sight) -> Result<Sighting, Wrong> {
        match told {
            Sight::Door { door, status, opening } => {
                let state =
                    door_state(*status, *opening).ok_or_else(|| format!("opening = {opening}"))?;
                Ok(Sighting::Door { door: self.door(door)?, state })
            }
            Sight::Thing { thing, place } => {
                let frame = place.frame().ok_or_else(|| format!("{place:?}"))?;
                let (replica, area) = (self.thing(thing)?, self.area(&place.area)?);
                Ok(Sighting::Replica { replica, area, frame })
            }
        }
    }

    pub(super) fn no(&self, refusal: Refusal) -> No {
        let thing = |id| self.thing_name(id);
        match refusal {
            Refusal::Locked(door) => No::Locked { door: self.door_name(door) },
            Refusal::DoorJammed { door, by, opening } => No::Jammed {
                door: self.door_name(door),
                by: by.map(|what| self.told(what)),
                opening,
            },
            Refusal::OutOfReach(id) => No::OutOfReach { thing: thing(id) },
            Refusal::NotThere(id) => No::NotThere { thing: thing(id) },
            Refusal::HandFull(id) => No::HandFull { thing: thing(id) },
            Refusal::NotHeld(id) => No::NotHeld { thing: thing(id) },
            Refusal::NoRoom(id) => No::NoRoom { thing: thing(id) },
            Refusal::Shut(id) => No::Shut { thing: thing(id) },
            Refusal::Stays(id) => No::Stays { thing: thing(id) },
        }
    }

    pub(super) fn refusal(&self, no: &No) -> Result<Refusal, Wrong> {
        Ok(match no {
            No::Locked { door } => Refusal::Locked(self.door(door)?),
            No::Jammed { door, by, opening } => Refusal::DoorJammed {
                door: self.door(door)?,
                by: by.as_ref().map(|thing| self.obstruction(thing)),
                opening: (*opening).min(100),
            },
            No::OutOfReach { thing } => Refusal::OutOfReach(self.thing(thing)?),
            No::NotThere { thing } => Refusal::NotThere(self.thing(thing)?),
            No::HandFull { thing } => Refusal::HandFull(self.thing(thing)?),
            No::NotHeld { thing } => Refusal::NotHeld(self.thing(thing)?),
            No::NoRoom { thing } => Refusal::NoRoom(self.thing(thing)?),
            No::Shut { thing } => Refusal::Shut(self.thing(thing)?),
            No::Stays { thing } => Refusal::Stays(self.thing(thing)?),
        })
    }
}
