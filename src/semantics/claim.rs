//! Whether a pose bears out what a report says of it: the terms of [`Spot`](super::Spot) as conditions.
//!
//! A claim is weaker than the choice of [`whereabouts`](super::whereabouts): who stands in a corner stands by a wall
//! too. Invariant: what `whereabouts` says of a pose holds there as a claim.

use crate::map::World;
use crate::units::{AreaId, MapId, OpeningId, Point, ReplicaId};

use super::position::{Spot, by_walls, in_doorway};
use super::relations::Relations;
use crate::geometry::{Bounds, OpenSide, Opening, nearest_on_segment};

/// Something said of a spot. One of the openings is meant.
#[derive(Debug, Clone, PartialEq)]
pub enum Claim {
    InArea,
    InDoorway(Vec<OpeningId>),
    AtDoor(Vec<OpeningId>),
    On(ReplicaId),
    NextTo(ReplicaId),
    InCorner,
    AlongWall,
    InMiddle,
}

/// Whether a claim about an Area of a Map holds at a point.
#[must_use]
pub fn claim_holds(
    world: &World,
    relations: &Relations,
    (map, area): (MapId, AreaId),
    claim: &Claim,
    at: Point,
) -> bool {
    let (measured, openings) = (relations.measurements(), relations.openings());
    let near = relations.thresholds();
    let Some(room) = measured.rooms.get(&area).filter(|room| room.map == map) else {
        return false;
    };
    let meant = |places: &[OpeningId], holds: &dyn Fn(&Opening) -> bool| {
        places.iter().filter_map(|place| openings.opening(*place)).any(holds)
    };
    if let Claim::InDoorway(places) = claim {
        let here = measured.area_at(map, at);
        return meant(places, &|o| in_doorway(o, at, here, near));
    }
    if !room.parts.iter().any(|(part, ..)| part.contains(at)) {
        return false;
    }
    match claim {
        Claim::InArea => true,
        Claim::InDoorway(_) => false,
        Claim::AtDoor(places) => meant(places, &|o| {
            let away = |s: &OpenSide| (at - nearest_on_segment(at, s.ends.0, s.ends.1)).norm();
            o.sides.iter().any(|side| away(side) <= near.robot_door)
        }),
        Claim::On(thing) => measured
            .bodies
            .get(thing)
            .is_some_and(|body| body.outline.iter().any(|part| part.distance_to(at) <= 0.0)),
        Claim::NextTo(thing) => measured.bodies.get(thing).is_some_and(|body| {
            body.outline.iter().any(|part| part.distance_to(at) <= near.robot_thing)
        }),
        Claim::InCorner => by_walls(world, relations, area, at) == Spot::InCorner,
        Claim::AlongWall => {
            let spot = by_walls(world, relations, area, at);
            matches!(spot, Spot::InCorner | Spot::AlongWall)
        }
        Claim::InMiddle => by_walls(world, relations, area, at) == Spot::InMiddle,
    }
}

/// A box around an Area, with the thickness of its doorways; none for an Area that lies on no Map.
#[must_use]
pub fn claim_bounds(relations: &Relations, area: AreaId) -> Option<(MapId, Bounds)> {
    let thickness = relations.thresholds().step_distance;
    let room = relations.measurements().rooms.get(&area)?;
    Some((room.map, room.bounds.grown(thickness)))
}
