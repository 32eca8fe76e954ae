//! One state of the world with what was derived of it: the map as surveyed, or what is believed to be so now.
//!
//! Ways and places are told, asked for and driven in one state of the world: as it is believed to be now, where the robot
//! or an observation knows it otherwise than the survey.

use std::collections::BTreeMap;

use crate::geometry::{FloorPlan, Method, Target};
use crate::map::{Entity, World};
use crate::semantics::Relations;
use crate::units::{AreaId, MapId, Point};

use super::position::nowhere_on;
use super::present::Present;
use super::route::{End, Located};
use super::{Error, RequestError, State};

/// The map, or the world as it is now.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings<'e> {
    engine: &'e State,
    now: Option<&'e Present>,
}

impl State {
    /// The world as it is believed to be now: the map, with what the robot did and what was seen.
    ///
    /// # Errors
    /// There is no map.
    pub fn world_now(&self) -> Result<&World, Error> {
        self.around()?.world()
    }

    /// The world as it is believed to be now.
    pub(super) fn around(&self) -> Result<Surroundings<'_>, Error> {
        Ok(Surroundings { engine: self, now: self.present()? })
    }
}

impl<'e> Surroundings<'e> {
    pub(super) fn world(&self) -> Result<&'e World, Error> {
        match self.now {
            Some(now) => Ok(&now.world),
            None => self.engine.world(),
        }
    }

    pub(super) fn relations(&self) -> Result<&'e Relations, Error> {
        match self.now {
            Some(now) => Ok(now.relations.relations()),
            None => self.engine.relations(),
        }
    }

    pub(super) fn floors(&self) -> Result<&'e BTreeMap<MapId, FloorPlan>, Error> {
        match self.now {
            Some(now) => now.floors(self.engine),
            None => self.engine.floors(),
        }
    }

    pub(super) fn floor(&self, map: MapId) -> Result<&'e FloorPlan, Error> {
        Ok(self.floors()?.get(&map).expect("every map of the world has a floor"))
    }

    /// A point of a Map, as an end of a way.
    ///
    /// # Errors
    /// It lies in no Area.
    pub(super) fn locate_point(&self, map: MapId, at: Point) -> Result<Located, Error> {
        let floor = self.floor(map)?;
        if floor.locate(at).is_none() {
            return Err(nowhere_on(self.world()?, floor, at).into());
        }
        Ok(Located { map, at, target: Target::Point(at), end: End::Point })
    }

    /// Where an entity is, as an end of a way.
    ///
    /// # Errors
    /// It is something where one cannot stand.
    pub(super) fn locate_entity(&self, entity: Entity) -> Result<Located, Error> {
        let world = self.world()?;
        let nowhere =
            || Error::from(RequestError::NotAPlace { name: world.name(entity).to_owned() });
        let located = |map, at, target| Ok(Located { map, at, target, end: End::Entity(entity) });
        match entity {
            Entity::Map(_) => Err(nowhere()),
            Entity::Place(id) => {
                let place = &world.places[&id];
                let (map, frame) = world.placement(place.area).ok_or_else(nowhere)?;
                located(map, frame.apply(place.at), Target::Place(id))
            }
            Entity::Area(id) => {
                let (map, at) = self.middle_of(world, id).ok_or_else(nowhere)?;
                located(map, at, Target::Area(id))
            }
            Entity::Replica(id) => {
                let (map, _) = world.placement(world.replicas[&id].area).ok_or_else(nowhere)?;
                let floor = self.floor(map)?;
                let bounds = floor.scene().replicas.get(&id).ok_or_else(nowhere)?.bounds;
                let middle = nalgebra::center(&bounds.min, &bounds.max);
                let target = Target::Replica(id);
                // In front of the thing, where there is a way to that; else beside it.
                let standing = floor.route(world, middle, target, Method::Shortest).ok();
                let at = standing.and_then(|r| r.points.last().copied()).unwrap_or(middle);
                located(map, at, target)
            }
            Entity::Door(door) => {
                let area = *world.door_areas(door).first().ok_or_else(nowhere)?;
                let (map, _) = world.placement(area).ok_or_else(nowhere)?;
                let at = self.floor(map)?.stand_before(world, door, area).ok_or_else(nowhere)?.at;
                located(map, at, Target::Door { door, area })
            }
        }
    }

    fn middle_of(&self, world: &World, area: AreaId) -> Option<(MapId, Point)> {
        let (map, _) = world.placement(area)?;
        let placed = self.floor(map).ok()?.scene().areas.get(&area)?;
        Some((map, placed.prisms.first()?.polygon.centroid()))
    }
}
