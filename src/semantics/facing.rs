//! What the robot faces, in terms that people use: what the rules say of its pose. The words are made elsewhere.

use crate::facts::Value;
use crate::map::World;
use crate::units::{AreaId, MapId, OpeningId, Pose, ReplicaId};

use super::asked::{Around, looks_from};
use super::position::Way;
use super::relations::Relations;

/// What the robot faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Faced {
    Object(ReplicaId),
    /// An open leaf of a door.
    Leaf(Way),
    Wall {
        /// Whether the robot is by it.
        own: bool,
    },
    Door(Way),
    /// Nothing near.
    Inward,
}

/// What an answer says is faced, seen from an Area.
type Reading<'r> = dyn Fn(&[Value], Option<AreaId>) -> Option<Faced> + 'r;

/// What whoever has some poses on a Map faces there, in their order; of several things that are equally near the first.
/// Which of them count, and which is met first, the rules say.
#[must_use]
pub fn faced(world: &World, relations: &Relations, map: MapId, poses: &[Pose]) -> Vec<Faced> {
    let spots: Vec<_> = poses.iter().map(|p| (map, p.at, Some(p.heading))).collect();
    let around = Around { world, robot: None, spots: &spots };
    let mut found: Vec<Vec<Faced>> = vec![Vec::new(); poses.len()];
    let from: Vec<_> = poses.iter().map(|pose| looks_from(relations, map, pose.at)).collect();
    let way = |value: &Value, area: Option<AreaId>| {
        let Value::Number(number) = value else { return None };
        let opening = relations.openings().opening(OpeningId(u32::try_from(*number).ok()?))?;
        let from = area.filter(|area| opening.is_of(*area)).unwrap_or_else(|| opening.area());
        Some(Way::through(opening, from))
    };
    let mut told = |premise: &str, faced: &Reading<'_>| {
        for row in relations.found(&around, &format!("?- {premise}")) {
            let Some(n) = row[0].to_string().parse::<usize>().ok().filter(|n| *n < poses.len())
            else {
                continue;
            };
            found[n].extend(faced(&row, from[n]));
        }
    };
    told("FACES(P, X)", &|row, _| {
        let Value::Symbol(symbol) = &row[1] else { return None };
        relations.symbols().replica_of(Some(symbol)).map(Faced::Object)
    });
    told("FACES_LEAF(P, _, N)", &|row, area| way(&row[1], area).map(Faced::Leaf));
    told("FACES_OWN_WALL(P, _)", &|_, _| Some(Faced::Wall { own: true }));
    told("FACES_WALL(P, _)", &|_, _| Some(Faced::Wall { own: false }));
    told("FACES_DOOR(P, _, N)", &|row, area| way(&row[1], area).map(Faced::Door));
    found.into_iter().map(|faced| faced.into_iter().next().unwrap_or(Faced::Inward)).collect()
}
