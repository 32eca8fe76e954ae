//! What questions are asked of: the map as the robot believes it to be now.
//!
//! A door that a task has closed is closed, a lamp that it has switched on is on, and what it carries is in its hand. Where
//! nothing of that differs from the survey, the survey itself is asked, and nothing is derived anew.
//!
//! Invariant: the map of the store is never changed by this; what is carried stands in no relation to anything.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use crate::geometry::FloorPlan;
use crate::language::question::Mind;
use crate::map::World;
use crate::semantics::Followed;
use crate::units::{MapId, ReplicaId};

use super::{Error, State};

/// The world now, where it is not as surveyed.
#[derive(Debug)]
pub(super) struct Present {
    /// With what is carried, so that it can be spoken of.
    pub(super) world: World,
    /// Of all that is not carried.
    pub(super) relations: Followed,
    /// Who has what was taken off the map; an empty name for the robot itself.
    pub(super) holders: BTreeMap<ReplicaId, String>,
    /// Of what was taken off the map, what lies on or in another such thing, with that thing.
    pub(super) carriers: BTreeMap<ReplicaId, ReplicaId>,
    mind: OnceLock<Mind>,
    floors: OnceLock<BTreeMap<MapId, FloorPlan>>,
}

impl Present {
    /// The free floor now: that of the map, with what differs rebuilt.
    pub(super) fn floors(&self, engine: &State) -> Result<&BTreeMap<MapId, FloorPlan>, Error> {
        if let Some(floors) = self.floors.get() {
            return Ok(floors);
        }
        let surveyed = engine.world()?;
        let mut world = self.world.clone();
        for gone in self.holders.keys() {
            world.replicas.remove(gone);
        }
        let mut floors = engine.floors()?.clone();
        for floor in floors.values_mut() {
            floor.follow(surveyed, &world);
        }
        Ok(self.floors.get_or_init(|| floors))
    }

    pub(super) fn mind(&self) -> &Mind {
        self.mind.get_or_init(|| Mind::of(&self.world))
    }
}

impl State {
    /// What differs from the survey, at the moment when it is first asked for after a change.
    ///
    /// # Errors
    /// There is no map, or its relations cannot be derived.
    pub(super) fn present(&self) -> Result<Option<&Present>, Error> {
        if let Some(present) = self.present.get() {
            return Ok(present.as_deref());
        }
        let found = self.find_present()?;
        Ok(self.present.get_or_init(|| found.map(Box::new)).as_deref())
    }

    fn find_present(&self) -> Result<Option<Present>, Error> {
        let Some(reader) = &self.reader else { return Ok(None) };
        let memory = self.memory()?;
        let unmoved = memory.doors.is_empty()
            && memory.devices.is_empty()
            && memory.carried.is_empty()
            && reader.observed()?.is_empty();
        if unmoved {
            return Ok(None);
        }
        let surveyed = self.world()?;
        let mut world = self.believed(memory, std::time::SystemTime::now().into())?;
        let carriers = self.carriers(&world, &memory.carried)?;
        let gone: Vec<_> =
            memory.carried.keys().filter_map(|id| world.replicas.remove(id)).collect();
        if gone.is_empty() && world == *surveyed {
            return Ok(None);
        }
        let relations = self.followed(&world)?;
        world.replicas.extend(gone.into_iter().map(|replica| (replica.id, replica)));
        Ok(Some(Present {
            world,
            relations,
            holders: memory.carried.clone(),
            carriers,
            mind: OnceLock::new(),
            floors: OnceLock::new(),
        }))
    }

    /// The relations of a world that differs from the map in what a robot can do or see: those of the map, followed
    /// where they can be, else derived anew.
    pub(super) fn followed(&self, world: &World) -> Result<Followed, Error> {
        let (surveyed, relations) = (self.shared_world()?, self.shared_relations()?);
        let mut followed = Followed::new(Arc::clone(surveyed), Arc::clone(relations));
        followed.of(world)?;
        Ok(followed)
    }
}
