//! Whether a pose bears out what a report says of it: the terms of [`Spot`](super::Spot) as conditions.
//!
//! A claim is weaker than the choice of [`whereabouts`](super::whereabouts): who stands in a corner stands by a wall
//! too. Invariant: what `whereabouts` says of a pose holds there as a claim.

use std::collections::BTreeSet;

use crate::facts::Value;
use crate::geometry::Bounds;
use crate::map::World;
use crate::units::{AreaId, MapId, OpeningId, Point, ReplicaId};

use super::asked::Around;
use super::relations::Relations;

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

/// The places of those of some points of a Map at which a claim about an Area holds.
#[must_use]
pub fn claim_holds(
    world: &World,
    relations: &Relations,
    (map, area): (MapId, AreaId),
    claim: &Claim,
    at: &[Point],
) -> BTreeSet<usize> {
    let measured = relations.measurements();
    let Some(room) = measured.rooms.get(&area).filter(|room| room.map == map) else {
        return BTreeSet::new();
    };
    let within = |n: &usize| room.parts.iter().any(|(part, ..)| part.contains(at[*n]));
    let spots: Vec<_> = at.iter().map(|p| (map, *p, None)).collect();
    let around = Around { world, robot: None, spots: &spots };
    let symbols = relations.symbols();
    // The points of which a relation holds with one of the wanted second terms.
    let held = |premise: String, is_meant: &dyn Fn(&Value) -> bool| -> BTreeSet<usize> {
        let rows = relations.found(&around, &premise);
        let rows = rows.iter().filter(|row| is_meant(&row[1]));
        rows.filter_map(|row| row[0].to_string().parse().ok()).collect()
    };
    let of_openings = |relation: &str, places: &[OpeningId]| {
        held(
            format!("?- {relation}(P, _, N, _)"),
            &|value| matches!(value, Value::Number(n) if places.iter().any(|place| i64::from(place.0) == *n)),
        )
    };
    let of_thing = |relation: &str, thing: ReplicaId| {
        held(
            format!("?- {relation}(P, X)"),
            &|value| matches!(value, Value::Symbol(symbol) if symbols.replica_of(Some(symbol)) == Some(thing)),
        )
    };
    let of_area = |relation: &str| {
        held(
            format!("?- {relation}(P, R)"),
            &|value| matches!(value, Value::Symbol(symbol) if symbols.area_of(Some(symbol)) == Some(area)),
        )
    };
    let found = match claim {
        Claim::InDoorway(places) => return of_openings("SPOT_IN_DOORWAY", places),
        Claim::InArea => (0..at.len()).collect(),
        Claim::AtDoor(places) => of_openings("SPOT_AT_DOOR", places),
        Claim::On(thing) => of_thing("SPOT_OVER", *thing),
        Claim::NextTo(thing) => of_thing("SPOT_NEXT_TO", *thing),
        Claim::InCorner => of_area("SPOT_IN_CORNER"),
        Claim::AlongWall => of_area("SPOT_AT_WALL"),
        Claim::InMiddle => of_area("SPOT_IN_MIDDLE"),
    };
    found.into_iter().filter(within).collect()
}

/// A box around an Area, with the thickness of its doorways; none for an Area that lies on no Map.
#[must_use]
pub fn claim_bounds(relations: &Relations, area: AreaId) -> Option<(MapId, Bounds)> {
    let thickness = relations.thresholds().step_distance;
    let room = relations.measurements().rooms.get(&area)?;
    Some((room.map, room.bounds.grown(thickness)))
}
