//! What the names in directives mean to a mission: where to go, which door, what thing.

use crate::belief::{Spot, Station};
use crate::geometry::{FloorPlan, Target};
use crate::map::{Entity, World};
use crate::semantics::Join;
use crate::semantics::planning::PlaceSource;
use crate::units::{AreaId, DoorId, ReplicaId};

use super::{Mission, Surprise};

/// Where the robot stands at a passage that has no leaf, on the side of an Area.
pub(crate) fn before_passage(
    world: &World,
    floor: &FloorPlan,
    join: &Join,
    side: AreaId,
) -> Option<Target> {
    /// How far before it, in radii of the robot.
    const BEFORE: f64 = 1.2;
    let doorway = floor.doorways().iter().find(|doorway| Some(doorway.id) == join.id)?;
    let before = world.robot.radius.get() * BEFORE;
    Some(Target::Point(doorway.before(doorway.index_of(side)?, before)))
}

impl Mission<'_> {
    pub(crate) fn name_this_point(&mut self) {
        let Some((area, _)) = self.belief.floor().locate(self.belief.pose.at) else { return };
        self.belief.area = area;
        let name = format!("Остановка-{}", self.belief.spots.len() + 1);
        self.belief.spots.push(Spot {
            name: name.clone(),
            area,
            pose: self.belief.pose,
            looks: false,
        });
        self.belief.station = Station::Place(name);
    }

    pub(crate) fn place_target(&self, name: &str) -> Result<Target, Surprise> {
        if let Some(spot) = self.belief.spots.iter().find(|s| s.name == name) {
            return Ok(Target::Point(spot.pose.at));
        }
        let place = self.places.iter().find(|p| p.name == name);
        match place.map(|p| p.source) {
            Some(PlaceSource::Named(id)) => Ok(Target::Place(id)),
            Some(PlaceSource::Before(id)) => Ok(Target::Replica(id)),
            Some(PlaceSource::Robot) | None => Err(Surprise::Unknown { name: name.to_owned() }),
        }
    }

    /// Where the robot stands at a door or passage on the side of `side`, coming from `from`.
    pub(super) fn door_target(
        &self,
        name: &str,
        from: AreaId,
        side: AreaId,
    ) -> Result<Target, Surprise> {
        if let Some(door) = self.opening(name)? {
            return Ok(Target::Door { door, area: side });
        }
        let unknown = || Surprise::Unknown { name: name.to_owned() };
        let join = self.joins.iter().find(|j| j.opening == name && j.from == from);
        let before = join
            .and_then(|join| before_passage(&self.belief.world, self.belief.floor(), join, side));
        before.ok_or_else(unknown)
    }

    /// The door of this name; none where it is a passage that has no name of its own on the Map.
    pub(super) fn opening(&self, name: &str) -> Result<Option<DoorId>, Surprise> {
        match self.joins.iter().find(|join| join.opening == name) {
            Some(join) => Ok(join.door),
            None => self.door(name).map(Some),
        }
    }

    pub(super) fn area(&self, name: &str) -> Result<AreaId, Surprise> {
        self.entity(name, |e| if let Entity::Area(id) = e { Some(id) } else { None })
    }

    pub(crate) fn door(&self, name: &str) -> Result<DoorId, Surprise> {
        self.entity(name, |e| if let Entity::Door(id) = e { Some(id) } else { None })
    }

    pub(crate) fn replica(&self, name: &str) -> Result<ReplicaId, Surprise> {
        self.entity(name, |e| if let Entity::Replica(id) = e { Some(id) } else { None })
    }

    pub(super) fn entity<T>(
        &self,
        name: &str,
        pick: impl Fn(Entity) -> Option<T>,
    ) -> Result<T, Surprise> {
        self.belief.entity(name, pick).ok_or_else(|| Surprise::Unknown { name: name.to_owned() })
    }

    pub(super) fn held(&self, name: &str) -> Result<ReplicaId, Surprise> {
        self.belief
            .held
            .as_ref()
            .filter(|r| r.name == name)
            .map(|r| r.id)
            .ok_or_else(|| Surprise::Unknown { name: name.to_owned() })
    }
}
