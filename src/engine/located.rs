//! Where points and entities are on the floor, as ends of a way.

use crate::geometry::{Bounds, FloorPlan, Method, Scene, Target};
use crate::map::{Entity, World};
use crate::units::{AreaId, Lengths, MapId, Point};

use super::error::{both, in_both};
use super::known::Known;
use super::{Error, RequestError};

/// What a way leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    Entity(Entity),
    /// Coordinates.
    Point,
    /// A lift or stairs, from where the way goes on elsewhere.
    Lift,
}

/// What a name of a place comes to on a floor.
#[derive(Debug, Clone, Copy)]
pub struct Located {
    pub map: MapId,
    /// A point at it, where a way may begin.
    pub at: Point,
    pub target: Target,
    pub end: End,
}

impl Known {
    /// A point of a Map, as an end of a way.
    ///
    /// # Errors
    /// It lies in no Area.
    pub(super) fn locate_point(&self, map: MapId, at: Point) -> Result<Located, Error> {
        let floor = self.floor(map)?;
        if floor.locate(at).is_none() {
            return Err(nowhere_on(self.world(), floor, at).into());
        }
        Ok(Located { map, at, target: Target::Point(at), end: End::Point })
    }

    /// Where an entity is, as an end of a way.
    ///
    /// # Errors
    /// It is something where one cannot stand.
    pub(super) fn locate_entity(&self, entity: Entity) -> Result<Located, Error> {
        let world = self.world();
        let nowhere = || Error::from(RequestError::NotAPlace { name: both(world, entity) });
        let located = |map, at, target| Ok(Located { map, at, target, end: End::Entity(entity) });
        match entity {
            Entity::Map(_) | Entity::Zone(_) => Err(nowhere()),
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
                let floor = self.floor(map)?;
                let stand = floor.stand_before(world, door, area).map(|stand| stand.at);
                // Where there is no place before it, it is where its doorway is.
                let middle = || floor.doorways_of(door).next().map(|way| way.middle());
                let at = stand.or_else(middle).ok_or_else(nowhere)?;
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

/// A point as it is told: (225, 380).
pub(super) fn spot_in_words(x: f64, y: f64, between: &str) -> String {
    let [x, y] = [x, y].map(|at| Lengths::said().short(at, 2));
    format!("({x}{between}{y})")
}

/// A point that no Area of a map holds.
pub(super) fn nowhere_on(world: &World, floor: &FloorPlan, at: Point) -> RequestError {
    let map = in_both(world, &world.maps[&floor.map()].name);
    let at = spot_in_words(at.x, at.y, ", ");
    RequestError::Nowhere { at, map, extent: extent(floor.scene()) }
}

fn extent(scene: &Scene) -> String {
    let rooms = scene.areas.values().flat_map(|a| &a.prisms);
    let b = rooms.fold(Bounds::EMPTY, |b, p| b.union(&p.bounds));
    let [left, right, near, far] =
        [b.min.x, b.max.x, b.min.y, b.max.y].map(|at| Lengths::said().number(at, 0));
    format!("x {left}…{right}, y {near}…{far}")
}
