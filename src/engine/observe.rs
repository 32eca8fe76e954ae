//! Where a thing is, was, and since when; what people and the robot saw of it; corrections of the map (D5, M8).

use crate::map::{Entity, Replica};
use crate::store::{
    Belief, Change, ImportReport, Key, Observation, Reader, Seen, Stamp, Store, Table, Timestamp,
};
use crate::units::{AreaId, Frame, InOrder as _, MapId, ReplicaId};

use super::error::{both, in_both};
use super::history::in_memory;
use super::located::nowhere_on;
use super::{Engine, Error, RequestError, State};

/// Where a thing is believed to be, or was.
#[derive(Debug, Clone, PartialEq)]
pub struct Believed {
    pub replica: ReplicaId,
    pub name: String,
    pub belief: Belief,
    /// Where the map has it at that time; none where it lacks it.
    pub surveyed: Option<Seen>,
    /// Taken off the map by the robot: the person who has it, or an empty name for its own hand.
    pub carried: Option<String>,
}

/// How something came to be known of a thing's place.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// The map said so from this revision on.
    Map { revision: u64, user: String },
    /// It was seen there, or seen to be gone.
    Seen { observer: String, sure: f64 },
}

/// One entry of the story of a thing, in the order of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    pub at: Timestamp,
    /// None: it was not where it was expected, or was taken off the map.
    pub place: Option<Seen>,
    pub source: Source,
}

impl State {
    /// The thing of this name, in any of its forms.
    ///
    /// # Errors
    /// Nothing bears the name, several things do, or it is no thing.
    pub fn thing(&self, name: &str) -> Result<&Replica, Error> {
        let entity = self.find(name)?;
        let Entity::Replica(id) = entity else {
            let world = self.world()?;
            return Err(RequestError::NotAThing { name: both(world, entity) }.into());
        };
        Ok(&self.world()?.replicas[&id])
    }

    /// Where a thing is believed to be at a moment, by what was known then.
    ///
    /// # Errors
    /// As [`State::thing`]; [`RequestError::NotYet`] when it was not on the map at that moment.
    pub fn where_is(&self, name: &str, at: Timestamp) -> Result<Believed, Error> {
        let (world, replica) = (self.world()?, self.thing(name)?.clone());
        let reader = self.reader()?;
        let reader = reader.at(reader.revision_at(at)?)?;
        let then = reader.replica(replica.id)?;
        let then =
            then.ok_or_else(|| RequestError::NotYet { name: in_both(world, &replica.name) })?;
        let belief = reader.belief(&then, at)?;
        let surveyed = Some(Seen { area: then.area, frame: then.frame });
        // What is carried now says nothing of an earlier moment.
        let is_latest = reader.observations(replica.id)?.iter().all(|o| o.at <= at);
        let carried = reader.robot_memory()?.carried.remove(&replica.id).filter(|_| is_latest);
        Ok(Believed { replica: replica.id, name: replica.name, belief, surveyed, carried })
    }

    /// Everything that is known of where a thing stood, by the map and by what was seen, the oldest first.
    ///
    /// # Errors
    /// As [`State::thing`].
    pub fn story_of(&self, name: &str) -> Result<Vec<Station>, Error> {
        let id = self.thing(name)?.id;
        let reader = self.reader()?;
        let mut story = Vec::new();
        let mut last = None;
        for version in reader.replica_history(id)? {
            let place = reader.place_of(&version);
            // A change of its name, say, is no news of its place.
            if last != Some(place) {
                let (revision, user) = (version.stamp.revision, version.stamp.user);
                let source = Source::Map { revision, user };
                story.push(Station { at: version.stamp.at, place, source });
            }
            last = Some(place);
        }
        for seen in reader.observations(id)? {
            let source = Source::Seen { observer: seen.observer, sure: seen.sure };
            story.push(Station { at: seen.at, place: seen.seen, source });
        }
        story.order_by_key(|s| s.at);
        Ok(story)
    }

    /// The revisions that made or changed the record of something on the map, the oldest first.
    ///
    /// # Errors
    /// The store cannot be read, or there is none.
    pub(crate) fn changes_of(&self, entity: Entity) -> Result<Vec<Stamp>, Error> {
        let (world, reader) = (self.world()?, self.reader()?);
        let one = |table: Table, id: u32| reader.history(table, &Key::new().id(id));
        let versions = match entity {
            Entity::Replica(id) => reader.replica_history(id),
            Entity::Door(id) => one(Table::Door, id.0),
            Entity::Area(id) => one(Table::Area, id.0),
            Entity::Zone(id) => one(Table::Zones, id.0),
            Entity::Map(id) => one(Table::Map, id.0),
            Entity::Place(id) => {
                let area = world.places.get(&id).map_or(0, |place| place.area.0);
                reader.history(Table::Places, &Key::new().id(area).id(id.0))
            }
        };
        Ok(versions?.into_iter().map(|version| version.stamp).collect())
    }

    /// The store's records at this moment.
    fn reader(&self) -> Result<&Reader, Error> {
        self.reader.as_ref().ok_or_else(|| in_memory().into())
    }
}

impl State {
    /// A place of an Area where it is on its Map: the frame of `where`, of routes, and of the file of an imported map.
    ///
    /// # Errors
    /// There is no map.
    pub fn on_map(&self, seen: &Seen) -> Result<Option<(MapId, Frame)>, Error> {
        let placed = self.world()?.placement(seen.area);
        Ok(placed.map(|(map, area)| (map, area.compose(&seen.frame))))
    }

    /// A place on a Map, as one of the Area that holds it: of the thing's own Map, where none is named.
    ///
    /// # Errors
    /// As [`State::thing`]; no Map bears the name, or no Area of it holds the place.
    pub fn seen_on_map(&self, thing: &str, map: Option<&str>, at: Frame) -> Result<Seen, Error> {
        let world = self.world()?;
        let home = world.placement(self.thing(thing)?.area).map(|(map, _)| map);
        let map = match map.map(|name| self.find(name)).transpose()? {
            Some(Entity::Map(id)) => Some(id),
            Some(other) => {
                return Err(RequestError::NotAnArea { name: both(world, other) }.into());
            }
            None => home,
        };
        let map = map.ok_or(RequestError::RobotNowhere)?;
        let area = self.relations()?.measurements().area_at(map, at.origin());
        let placed = area.and_then(|area| Some((area, world.placement(area)?.1)));
        let Some((area, frame)) = placed else {
            return Err(nowhere_on(world, self.floor(map)?, at.origin()).into());
        };
        let inner = frame.invert(at.origin());
        let (z, angle) = (at.z - frame.z, at.angle - frame.angle);
        Ok(Seen { area, frame: Frame::new(inner.x, inner.y, z.get(), angle) })
    }
}

impl Engine {
    /// Notes that a thing was seen at a place of its Map: see [`State::seen_on_map`].
    ///
    /// # Errors
    /// As [`State::seen_on_map`]; the disk refused.
    pub fn observe_on_map(
        &mut self,
        name: &str,
        (map, at): (Option<&str>, Frame),
        sure: f64,
        observer: &str,
        when: Timestamp,
    ) -> Result<(), Error> {
        let replica = self.thing(name)?.id;
        let seen = Some(self.seen_on_map(name, map, at)?);
        self.next().forget_present();
        let observer = observer.to_owned();
        let observation = Observation { replica, at: when, seen, sure, observer };
        Ok(self.writable()?.observe(&[observation])?)
    }

    /// Notes that a thing was seen at a place of an Area (of the map's Area for it, where none is named), or
    /// that it was not where it was expected. The map stays as it was.
    ///
    /// # Errors
    /// As [`State::thing`]; no Area of the Map holds the place; the disk refused.
    pub fn observe(
        &mut self,
        name: &str,
        seen: Option<(Option<&str>, Frame)>,
        sure: f64,
        observer: &str,
        at: Timestamp,
    ) -> Result<(), Error> {
        let replica = self.thing(name)?;
        let (id, home) = (replica.id, replica.area);
        let seen = match seen {
            None => None,
            Some((area, frame)) => {
                let area = area.map_or(Ok(home), |name| self.area(name))?;
                let seen = Seen { area, frame };
                if let Some((map, at)) = self.on_map(&seen)?
                    && self.relations()?.measurements().area_at(map, at.origin()).is_none()
                {
                    return Err(nowhere_on(self.world()?, self.floor(map)?, at.origin()).into());
                }
                Some(seen)
            }
        };
        self.next().forget_present();
        let observation =
            Observation { replica: id, at, seen, sure, observer: observer.to_owned() };
        Ok(self.writable()?.observe(&[observation])?)
    }

    fn area(&self, name: &str) -> Result<AreaId, Error> {
        match self.find(name)? {
            Entity::Area(id) => Ok(id),
            other => {
                let world = self.world()?;
                Err(RequestError::NotAnArea { name: both(world, other) }.into())
            }
        }
    }

    /// The things that are believed to stand elsewhere than the map says, and those that it lacks.
    ///
    /// # Errors
    /// The store cannot be read, or the relations cannot be derived.
    pub fn proposals(&self, now: Timestamp) -> Result<Vec<Believed>, Error> {
        let world = self.world()?;
        let carried = self.store()?.reader().robot_memory()?.carried;
        let told = self.relations()?.thresholds().belief_told;
        let all = self.store()?.proposals(now, told)?.into_iter();
        let moved = all.map(|p| Believed {
            replica: p.replica,
            name: world.replicas[&p.replica].name.clone(),
            belief: p.believed,
            surveyed: Some(p.surveyed),
            carried: carried.get(&p.replica).cloned(),
        });
        Ok(moved.chain(self.lacked(now)?).collect())
    }

    /// A person says that a thing does stand where it is believed to: an edit of the map, checked as any. What the map lacks
    /// becomes a thing of it.
    ///
    /// # Errors
    /// As [`State::thing`]; the map would be faulty.
    pub fn confirm(&mut self, name: &str, change: &Change) -> Result<ImportReport, Error> {
        if let Some(obstacle) = self.obstacle(name)? {
            return self.survey_obstacle(&obstacle, change);
        }
        let id = self.thing(name)?.id;
        let believed = self.where_is(name, change.at)?.belief;
        if believed.is_surveyed {
            let name = in_both(self.world()?, name);
            return Err(RequestError::NothingProposed { name }.into());
        }
        let edited = self.edit_world(change, super::Mode::Commit, |world| {
            if let Some(replica) = world.replicas.get_mut(&id) {
                (replica.area, replica.frame) = (believed.place.area, believed.place.frame);
            }
        })?;
        Ok(edited.report.unwrap_or_default())
    }

    /// A person says that a thing stands where the map says: what was seen until now counts no more.
    ///
    /// # Errors
    /// As [`State::thing`]; the disk refused.
    pub fn reject(&mut self, name: &str, change: &Change) -> Result<(), Error> {
        if let Some(obstacle) = self.obstacle(name)? {
            return self.forget_obstacle(&obstacle, change);
        }
        let id = self.thing(name)?.id;
        self.next().forget_present();
        Ok(self.writable()?.reject(id, change)?)
    }

    pub(super) fn writable(&mut self) -> Result<&mut Store, Error> {
        self.store.as_mut().ok_or_else(|| in_memory().into())
    }
}
