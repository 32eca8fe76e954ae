//! From one task to the next: the robot stays where it is, doors stay as it left them, things stay where it put them.
//!
//! **Invariant.** The map is never changed by this: what the robot did and saw stands beside the survey (D5), and the
//! world of a task is the map with that applied.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use crate::map::{Entity, Replica, World, set_open, switch};
use crate::robot::starting_pose;
use crate::store::{Change, Observation, RobotMemory, Seen, Timestamp};
use crate::units::{AreaId, Deg, Gather as _, MapId, Pose, ReplicaId};

use super::after::After;
use super::obstacles::put_up;
use super::route::is_pair;
use super::task::TaskAnswer;
use super::{Engine, Error, RequestError, State};

/// Who notes what the robot saw.
pub(super) const ROBOT: &str = "робот";
impl State {
    /// The same at a moment: what was seen counts as it does then, and so do zones that begin and end.
    ///
    /// # Errors
    /// There is no map.
    pub(super) fn at(&self, moment: Timestamp) -> Result<Self, Error> {
        let mut state = self.clone();
        state.now = OnceLock::from(Some(self.known_at(moment)?));
        Ok(state)
    }

    /// Where the robot stands: where its last task left it, else where the map lets it begin.
    ///
    /// # Errors
    /// There is no map, or it does not say where the robot starts.
    pub fn robot(&self) -> Result<(MapId, Pose), Error> {
        if let Some(robot) = self.robot.get() {
            return Ok(*robot);
        }
        let world = self.world()?;
        // A map that was replaced since may not have this place any more.
        let stands = |(map, pose): &(MapId, Pose)| {
            world.maps.contains_key(map)
                && self.floor(*map).is_ok_and(|floor| floor.locate(pose.at).is_some())
        };
        let last = self.memory()?.pose.filter(stands);
        let robot = last.or_else(|| starting_pose(world)).ok_or(RequestError::RobotNowhere)?;
        Ok(*self.robot.get_or_init(|| robot))
    }

    /// The Area in which the robot stands; none beside the floor.
    ///
    /// # Errors
    /// As [`State::robot`].
    pub(super) fn robot_area(&self) -> Result<Option<AreaId>, Error> {
        let (map, pose) = self.robot()?;
        Ok(self.around()?.floor(map)?.locate(pose.at).map(|(area, _)| area))
    }

    /// The world as it is believed to be now, without what is carried or was handed over.
    ///
    /// # Errors
    /// There is no map.
    pub fn uncarried(&self) -> Result<&World, Error> {
        Ok(self.around()?.uncarried())
    }

    /// What the robot holds.
    ///
    /// # Errors
    /// There is no map.
    pub fn held(&self) -> Result<Option<&Replica>, Error> {
        Ok(self.around()?.held())
    }

    /// What was handed over, with the names of those who have it.
    ///
    /// # Errors
    /// There is no map.
    pub fn handed_over(&self) -> Result<Vec<(Replica, String)>, Error> {
        Ok(self.around()?.handed_over())
    }

    /// What lies on or in what is held or was handed over, each with the thing with which it goes.
    ///
    /// # Errors
    /// There is no map.
    pub fn aboard(&self) -> Result<Vec<(Replica, ReplicaId)>, Error> {
        Ok(self.around()?.aboard())
    }

    /// Of things that are carried, those that lie on or in others of them, each with the one that carries it and is itself
    /// carried by none: as they lay when they were taken up. What is carried keeps its last place in `world`.
    pub(super) fn carriers(
        &self,
        world: &World,
        carried: &BTreeMap<ReplicaId, String>,
    ) -> Result<BTreeMap<ReplicaId, ReplicaId>, Error> {
        if carried.len() < 2 {
            return Ok(BTreeMap::new());
        }
        let relations = self.followed(world)?;
        let relations = relations.relations();
        let mut carriers = BTreeMap::new();
        for (&carrier, holder) in carried {
            let along = relations.goes_with(carrier);
            let own = along.into_iter().filter(|thing| carried.get(thing) == Some(holder));
            carriers.extend(own.map(|thing| (thing, carrier)));
        }
        let root = |mut at: ReplicaId| {
            for _ in 0..carriers.len() {
                let Some(next) = carriers.get(&at) else { break };
                at = *next;
            }
            at
        };
        Ok(carriers.values().zip(carriers.keys()).map(|(c, thing)| (*thing, root(*c))).gather())
    }

    /// The map with the doors, devices and places of things as they are believed to be; what is carried still in it.
    pub(super) fn believed(&self, memory: &RobotMemory, at: Timestamp) -> Result<World, Error> {
        let mut world = self.world()?.clone();
        for (door, state) in &memory.doors {
            if let Some(door) = world.doors.get_mut(door) {
                door.state = *state;
            }
        }
        if let Some(reader) = &self.reader {
            for id in reader.observed()? {
                let Some(replica) = world.replicas.get_mut(&id) else { continue };
                // Also within the step by which a place counts as the surveyed one: what lies on a tray goes with it.
                let belief = reader.belief(replica, at)?;
                if self.world()?.areas.contains_key(&belief.place.area) {
                    (replica.area, replica.frame) = (belief.place.area, belief.place.frame);
                }
            }
        }
        for (device, on) in &memory.devices {
            if let Some(replica) = world.replicas.get_mut(device) {
                switch(&mut replica.properties, *on);
            }
        }
        for (thing, open) in &memory.opened {
            if let Some(replica) = world.replicas.get_mut(thing)
                && let Some(object) = world.objects.get(&replica.object)
            {
                set_open(replica, object, *open);
            }
        }
        let least = self.reckoned_with()?;
        put_up(&mut world, memory.obstacles.iter().filter(|seen| seen.stands(at, least)));
        Ok(world)
    }

    /// So sure of it, 0..=1, an obstacle still counts. It is asked before there are relations, which are of a world with
    /// such obstacles in it.
    pub(super) fn reckoned_with(&self) -> Result<f64, Error> {
        let profile = self.world()?.domain.profile;
        Ok(self.rules.relations.thresholds(profile).belief_reckoned)
    }

    /// What the robot did, and where it stands.
    pub(super) fn memory(&self) -> Result<&RobotMemory, Error> {
        if let Some(memory) = self.memory.get() {
            return Ok(memory);
        }
        let memory = match &self.reader {
            Some(reader) => reader.robot_memory()?,
            None => RobotMemory::default(),
        };
        Ok(self.memory.get_or_init(|| memory))
    }
}

impl Engine {
    /// Notes in the store how a task left the robot and its world. The map stays as it was.
    ///
    /// # Errors
    /// The disk refused.
    pub fn remember(&mut self, answer: &TaskAnswer, at: Timestamp) -> Result<(), Error> {
        match &answer.after {
            Some(after) => self.remember_after(after, at),
            None => {
                self.next().forget_present();
                Ok(())
            }
        }
    }

    /// Notes in the store how a task that was driven elsewhere left the robot and its world.
    ///
    /// # Errors
    /// The disk refused.
    pub fn remember_after(&mut self, after: &After, at: Timestamp) -> Result<(), Error> {
        self.next().forget_present();
        let Some(store) = &mut self.store else { return Ok(()) };
        let seen: Vec<Observation> = after
            .moved
            .iter()
            .map(|(replica, seen)| Observation {
                replica: *replica,
                at,
                seen: *seen,
                sure: after.sure,
                observer: ROBOT.to_owned(),
            })
            .collect();
        Ok(store.remember(&after.memory, &seen, ROBOT, at)?)
    }

    /// Notes how a task that is still under way has left the robot and its world so far, where it has changed more than
    /// the robot's place since `kept`, which was noted last; whether it has.
    pub(crate) fn remember_so_far(
        &mut self,
        after: &After,
        kept: &mut After,
    ) -> Result<bool, Error> {
        let news = after.moved.iter().filter(|(id, seen)| {
            // What is in the hand is noted as that; it is seen again where it is put down.
            seen.is_some() && kept.moved.get(*id) != Some(*seen)
        });
        let moved: BTreeMap<ReplicaId, Option<Seen>> = news.map(|(id, seen)| (*id, *seen)).gather();
        let pose = after.memory.pose;
        if moved.is_empty() && after.memory == (RobotMemory { pose, ..kept.memory.clone() }) {
            return Ok(false);
        }
        kept.moved.extend(moved.clone());
        kept.memory = after.memory.clone();
        let so_far = After { memory: after.memory.clone(), moved, sure: after.sure };
        self.remember_after(&so_far, std::time::SystemTime::now().into())?;
        Ok(true)
    }

    /// Whether what the robot does is kept on a disk.
    pub(super) fn is_kept(&self) -> bool {
        self.store.is_some()
    }

    /// The robot stands at a place given by name, as `X,Y` or as `X,Y,HEADING`, or as near to it as it fits: it was carried there, or
    /// the map does not say. It faces as the place says, or along x where none is said.
    ///
    /// # Errors
    /// The name means nothing, or no place; the disk refused.
    pub fn place_robot(&mut self, name: &str, change: &Change) -> Result<(), Error> {
        let there = self.locate_name(name)?;
        let floor = self.around()?.floor(there.map)?;
        let at = floor.standing_at(there.at).ok_or(RequestError::RobotNowhere)?;
        self.next().forget_present();
        let pose = Pose { at, heading: self.heading_at(name)? };
        let store = self.writable()?;
        Ok(store.put_robot_pose(there.map, &pose, &change.user, change.at)?)
    }

    /// Where one faces who stands at a place given by name, or as numbers.
    fn heading_at(&self, name: &str) -> Result<Deg, Error> {
        if is_pair(name) {
            return Ok(State::parse_pose(name)?.heading);
        }
        let Entity::Place(place) = self.find(name)? else { return Ok(Deg::ZERO) };
        let world = self.world()?;
        let place = &world.places[&place];
        let turned = world.placement(place.area).map_or(Deg::ZERO, |(_, frame)| frame.angle);
        Ok(place.heading.unwrap_or_default() + turned)
    }

    /// The robot is put back to the map's start, into a map as it was surveyed: what it saw and did counts no more.
    ///
    /// # Errors
    /// The disk refused.
    pub fn reset_robot(&mut self, change: &Change) -> Result<(), Error> {
        self.next().forget_present();
        let Some(store) = &mut self.store else { return Ok(()) };
        let reader = store.reader();
        if !reader.robot_memory()?.is_empty() {
            store.remember(&RobotMemory::default(), &[], ROBOT, change.at)?;
        }
        for id in reader.observed()? {
            if reader.observations(id)?.iter().any(|o| o.observer == ROBOT) {
                store.reject(id, change)?;
            }
        }
        Ok(())
    }
}
