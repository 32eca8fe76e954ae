//! Where a pose is, from the terms of geometry to a report in words (SPEC T4).

use crate::geometry::{Bounds, FloorPlan, Owner, Scene};
use crate::language::report::{Beside, Doorway, Facing, Named, Opening, Position, Spot};
use crate::map::{Entity, Permeability, World};
use crate::semantics::{self, Nearness, Relations, Way, Whereabouts, whereabouts};
use crate::units::{AreaId, DoorId, MapId, Point, Pose, ReplicaId, Vector};

use super::lexicon::named;
use super::{Engine, Error, RequestError};

/// A pose with what can be said of it.
#[derive(Debug, Clone)]
pub struct Whereabout {
    pub map: MapId,
    pub pose: Pose,
    pub terms: Whereabouts,
    pub position: Position,
}

impl Engine {
    /// Where a pose of a map is. `facing` asks for the heading too.
    ///
    /// # Errors
    /// The pose lies in no Area.
    pub fn locate(&self, map: MapId, pose: Pose, facing: bool) -> Result<Whereabout, Error> {
        let world = self.world()?;
        let found = describe(
            world,
            self.relations()?,
            map,
            pose,
            facing.then(|| self.floor(map)).transpose()?.map(|f| f.scene()),
        );
        match found {
            Some(found) => Ok(found),
            None => Err(nowhere_on(world, self.floor(map)?, pose.at).into()),
        }
    }
}

/// A point that no Area of a map holds.
pub(super) fn nowhere_on(world: &World, floor: &FloorPlan, at: Point) -> RequestError {
    let map = world.maps[&floor.map()].name.clone();
    RequestError::Nowhere { x: at.x, y: at.y, map, extent: extent(floor.scene()) }
}

fn extent(scene: &Scene) -> String {
    let rooms = scene.areas.values().flat_map(|a| &a.prisms);
    let b = rooms.fold(Bounds::EMPTY, |b, p| b.union(&p.bounds));
    format!("x {:.0}…{:.0}, y {:.0}…{:.0}", b.min.x, b.max.x, b.min.y, b.max.y)
}

/// Describes a pose; with a scene, also what the robot faces.
#[must_use]
pub(super) fn describe(
    world: &World,
    relations: &Relations,
    map: MapId,
    pose: Pose,
    scene: Option<&Scene>,
) -> Option<Whereabout> {
    let terms = whereabouts(
        world,
        relations.measurements(),
        relations.openings(),
        map,
        &pose,
        &Nearness::default(),
    )?;
    let area = |id: AreaId| named(world, Entity::Area(id));
    let spot = match terms.spot {
        semantics::Spot::InDoorway(way) => Spot::InDoorway(doorway(world, relations, way)),
        semantics::Spot::AtDoor { way, .. } => Spot::AtDoor(doorway(world, relations, way)),
        semantics::Spot::NextTo { replica, .. } => {
            Spot::Object(Beside::NextTo, named(world, Entity::Replica(replica)))
        }
        semantics::Spot::InCorner => Spot::InCorner(None),
        semantics::Spot::AlongWall => Spot::AlongWall(None),
        semantics::Spot::InMiddle => Spot::InMiddle,
    };
    let mut position = Position::new(area(terms.area), [spot]);
    // Where another Map has an Area of this name, the Map is said too.
    let name = world.name(Entity::Area(terms.area));
    let namesakes = world.areas.values().filter(|a| a.name == name).count();
    if namesakes > 1 && !world.maps[&map].name.is_empty() {
        position.within.push(named(world, Entity::Map(map)));
    }
    let faced = scene.and_then(|scene| faced(world, relations, scene, terms.area, pose));
    position.facing = faced.map(|faced| match faced {
        Faced::Door(way) => Facing::Door(doorway(world, relations, way)),
        Faced::Object(replica) => Facing::Object(named(world, Entity::Replica(replica))),
        Faced::Wall => Facing::Wall,
        Faced::Inward => Facing::Inward,
    });
    Some(Whereabout { map, pose, terms, position })
}

/// A door told by the Areas on its sides, and by its own name where these are joined by several.
fn doorway(world: &World, relations: &Relations, way: Way) -> Doorway {
    let area = |id: AreaId| -> Named { named(world, Entity::Area(id)) };
    let alike = relations
        .joins()
        .iter()
        .filter(|j| {
            j.from == way.from
                && Some(j.to) == way.to
                && is_passage(world, j.door) == way.is_passage
        })
        .count();
    let name = way.door.filter(|_| alike > 1).map(|door| named(world, Entity::Door(door)));
    Doorway {
        opening: if way.is_passage { Opening::Passage } else { Opening::Door },
        name,
        from: area(way.from),
        to: way.to.map(area),
    }
}

fn is_passage(world: &World, door: Option<DoorId>) -> bool {
    door.and_then(|d| world.doors.get(&d)).is_none_or(|d| d.kind == crate::map::DoorKind::Passage)
}

/// Farther than this, nothing in particular is faced, cm.
const FACING_RANGE: f64 = 250.0;

/// What the robot faces, before words are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Faced {
    Door(Way),
    Object(ReplicaId),
    Wall,
    Inward,
}

/// The first thing that a ray along the heading meets.
pub(super) fn faced(
    world: &World,
    relations: &Relations,
    scene: &Scene,
    area: AreaId,
    pose: Pose,
) -> Option<Faced> {
    let (sin, cos) = pose.heading.sin_cos();
    let ray = Vector::new(cos, sin);
    let height = world.robot.height.get();
    let mut nearest: Option<(f64, Faced)> = None;
    let mut offer = |distance: f64, what: Faced| {
        if distance <= FACING_RANGE && nearest.as_ref().is_none_or(|(d, _)| distance < *d) {
            nearest = Some((distance, what));
        }
    };
    for replica in scene.replicas.values() {
        for prism in replica.prisms.iter().filter(|p| p.bottom < height && p.top > 10.0) {
            for (a, b) in prism.polygon.edges() {
                if let Some(distance) = hit(pose.at, ray, a, b) {
                    offer(distance, Faced::Object(replica.id));
                }
            }
        }
    }
    let placed = scene.areas.get(&area)?;
    for prism in &placed.prisms {
        let Owner::Area(area) = prism.owner else { continue };
        for ((a, b), side) in prism.polygon.edges().zip(&prism.sides) {
            let Some(distance) = hit(pose.at, ray, a, b) else { continue };
            if side.permeability == Permeability::Impermeable {
                offer(distance, Faced::Wall);
            } else if let Some(way) = way_through(relations, area, nalgebra::center(&a, &b)) {
                offer(distance, Faced::Door(way));
            }
        }
    }
    Some(nearest.map_or(Faced::Inward, |(_, faced)| faced))
}

/// The opening of an Area whose middle is here, seen from that Area.
fn way_through(relations: &Relations, area: AreaId, middle: Point) -> Option<Way> {
    let near =
        |o: &&semantics::Opening| (nalgebra::center(&o.ends.0, &o.ends.1) - middle).norm() < 1.0;
    let opening = relations.openings().iter().filter(near).min_by_key(|o| o.area != area)?;
    let behind = opening.leads_to();
    let to = if opening.area == area { behind } else { Some(opening.area) };
    Some(Way {
        door: opening.door,
        is_passage: opening.permeability == Permeability::Permeable,
        from: area,
        to,
    })
}

/// Distance along a ray to a segment.
fn hit(from: Point, ray: Vector, a: Point, b: Point) -> Option<f64> {
    let along = b - a;
    let cross = ray.perp(&along);
    if cross.abs() < 1e-12 {
        return None;
    }
    let distance = (a - from).perp(&along) / cross;
    let share = (a - from).perp(&ray) / cross;
    (distance > 0.0 && (0.0..=1.0).contains(&share)).then_some(distance)
}
