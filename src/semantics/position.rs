//! Where a pose is, in terms that people use (SPEC T4): data for a report, the words are made elsewhere.
//!
//! The Area first, then the strongest of: in the doorway, at the door, next to an object that is the only one of its
//! kind there, in the corner, along the wall, in the middle. Where none of these holds, the Area alone is said. Which of
//! these hold the rules say; of several doors or things the nearest is told.

use crate::facts::Value;
use crate::geometry::contact::Footprint;
use crate::geometry::{Opening, nearest_on_segment};
use crate::map::World;
use crate::units::{AreaId, Deg, DoorId, MapId, OpeningId, Point, Pose, ReplicaId};

use super::asked::Around;
use super::body::Body;
use super::relations::Relations;

/// A door or passage as a report speaks of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Way {
    pub opening: OpeningId,
    /// None for a passage without a name.
    pub door: Option<DoorId>,
    /// A passage has nothing to open.
    pub is_passage: bool,
    pub from: AreaId,
    /// None when the Map does not know what lies behind.
    pub to: Option<AreaId>,
}

/// The strongest thing to say of a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    InDoorway(Way),
    AtDoor {
        way: Way,
        distance: f64,
    },
    /// Underfoot lies something that the robot drives over.
    On {
        replica: ReplicaId,
    },
    NextTo {
        replica: ReplicaId,
        distance: f64,
    },
    InCorner,
    AlongWall,
    InMiddle,
    /// Somewhere in the Area, of which nothing more can be said.
    Inside,
}

/// A pose put into terms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Whereabouts {
    pub area: AreaId,
    pub spot: Spot,
    pub heading: Deg,
}

/// Describes a pose on a Map; none when it is in no Area and in no doorway.
#[must_use]
pub fn whereabouts(
    world: &World,
    relations: &Relations,
    map: MapId,
    pose: &Pose,
) -> Option<Whereabouts> {
    let here = relations.measurements().area_at(map, pose.at);
    let held = Held { relations, at: pose.at, spots: &[(map, pose.at, None)], world };
    let heading = pose.heading;
    if let Some((opening, side)) = held.doorway() {
        let area = here.unwrap_or(side);
        let spot = Spot::InDoorway(Way::through(opening, area));
        return Some(Whereabouts { area, spot, heading });
    }
    let area = here?;
    let spot =
        held.at_door(area).or_else(|| held.next_to(area)).unwrap_or_else(|| held.by_walls(area));
    Some(Whereabouts { area, spot, heading })
}

/// What the rules hold of one point.
struct Held<'a> {
    world: &'a World,
    relations: &'a Relations,
    at: Point,
    spots: &'a [(MapId, Point, Option<Deg>)],
}

impl Way {
    /// An opening seen from one of the Areas that it is of.
    #[must_use]
    pub fn through(opening: &Opening, from: AreaId) -> Self {
        let to = opening.joined_to(from).or_else(|| {
            // Of an Area that it does not join, as of one that lies in its mouth, one sees the side of the other.
            Some(opening.area()).filter(|area| *area != from && opening.side_in(from).is_none())
        });
        Self { opening: opening.id, door: opening.door, is_passage: opening.is_passage(), from, to }
    }
}

impl<'a> Held<'a> {
    fn asked(&self, premise: &str) -> Vec<Vec<Value>> {
        let around = Around { world: self.world, robot: None, spots: self.spots };
        self.relations.found(&around, &format!("?- {premise}"))
    }

    fn opening(&self, value: &Value) -> Option<&'a Opening> {
        let Value::Number(number) = value else { return None };
        self.relations.openings().opening(OpeningId(u32::try_from(*number).ok()?))
    }

    fn area(&self, value: &Value) -> Option<AreaId> {
        let Value::Symbol(symbol) = value else { return None };
        self.relations.symbols().area_of(Some(symbol))
    }

    /// The doorway that holds the point, and the Area whose side it is: the sides of the lower Areas first.
    fn doorway(&self) -> Option<(&'a Opening, AreaId)> {
        let rows = self.asked("SPOT_IN_DOORWAY(_, _, N, R)");
        let side = |row: &Vec<Value>| Some((self.opening(&row[0])?, self.area(&row[1])?));
        rows.iter().filter_map(side).min_by_key(|(opening, area)| (*area, opening.id))
    }

    fn at_door(&self, area: AreaId) -> Option<Spot> {
        let rows = self.asked("SPOT_AT_DOOR(_, _, N, R)");
        let away = |o: &Opening| {
            let sides = o.sides.iter().map(|s| nearest_on_segment(self.at, s.ends.0, s.ends.1));
            sides.map(|on_it| (self.at - on_it).norm()).fold(f64::INFINITY, f64::min)
        };
        let of_area = rows.iter().filter(|row| self.area(&row[1]) == Some(area));
        let (distance, opening) = of_area
            .filter_map(|row| self.opening(&row[0]))
            .map(|o| (away(o), o))
            // What lies in the Area's own side says more than what only leads there.
            .min_by(|(d, o), (e, q)| {
                let is_own = |o: &Opening| o.side_in(area).is_none();
                d.total_cmp(e).then(is_own(o).cmp(&is_own(q))).then(o.id.cmp(&q.id))
            })?;
        Some(Spot::AtDoor { way: Way::through(opening, area), distance })
    }

    /// The nearest thing that stands on the floor and is the only one of its kind and of its name in the Area.
    fn next_to(&self, area: AreaId) -> Option<Spot> {
        let bodies = &self.relations.measurements().bodies;
        let standing = self.relations.on_floor_of(area);
        let standing: Vec<&Body> = standing.iter().filter_map(|id| bodies.get(id)).collect();
        let name = |id: ReplicaId| self.world.replicas.get(&id).map(|r| r.name.as_str());
        let distance = |outline: &[Footprint]| {
            outline.iter().map(|f| f.distance_to(self.at)).fold(f64::INFINITY, f64::min)
        };
        let around = Around { world: self.world, robot: None, spots: self.spots };
        let near = self.relations.things(&around, "?- SPOT_NEXT_TO(_, X)");
        let is_only = |b: &&&Body| {
            let mut others = standing.iter().filter(|c| c.id != b.id);
            others.all(|c| c.object != b.object && name(c.id) != name(b.id))
        };
        let told = standing.iter().filter(|b| near.contains(&b.id)).filter(is_only);
        let (distance, body) = told
            .map(|b| (distance(&b.outline), *b))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.id.cmp(&b.1.id)))?;
        let is_flat = body.top - body.bottom <= self.world.robot.step.get();
        Some(match distance <= 0.0 && is_flat {
            true => Spot::On { replica: body.id },
            false => Spot::NextTo { replica: body.id, distance },
        })
    }

    fn by_walls(&self, area: AreaId) -> Spot {
        let spots = [
            ("SPOT_IN_CORNER", Spot::InCorner),
            ("SPOT_AT_WALL", Spot::AlongWall),
            ("SPOT_IN_MIDDLE", Spot::InMiddle),
        ];
        let holds = |(relation, _): &(&str, Spot)| {
            let rows = self.asked(&format!("{relation}(_, R)"));
            rows.iter().any(|row| self.area(&row[0]) == Some(area))
        };
        spots.into_iter().find(holds).map_or(Spot::Inside, |(_, spot)| spot)
    }
}
