//! Where a pose is, in terms that people use (SPEC T4): data for a report, the words are made elsewhere.
//!
//! The Area first, then the strongest of: in the doorway, at the door, next to an object that is the only one of its
//! kind there, in the corner, along the wall, in the middle. Where none of these holds, the Area alone is said.

use crate::geometry::contact::Footprint;
use crate::map::World;
use crate::units::{
    AreaId, Deg, DoorId, InOrder as _, MapId, OpeningId, Point, Pose, ReplicaId, Vector,
};

use super::body::Body;
use super::relations::Relations;
use super::thresholds::Thresholds;
use crate::geometry::{OpenSide, Opening, Openings, Polygon, nearest_on_segment, outward_normal};

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
    let (measured, openings) = (relations.measurements(), relations.openings());
    let near = relations.thresholds();
    let here = measured.area_at(map, pose.at);
    let on_map = openings.iter().filter(|o| o.map == map);
    let sides = on_map.flat_map(|o| o.sides.iter().map(move |side| (o, side)));
    // The sides of the lower Areas first.
    let mut sides: Vec<_> = sides.filter(|(_, side)| in_side(side, pose.at, here, near)).collect();
    sides.order_by_key(|(opening, side)| (side.area, opening.id));
    if let Some((opening, side)) = sides.first() {
        let area = here.unwrap_or(side.area);
        return Some(Whereabouts {
            area,
            spot: Spot::InDoorway(Way::through(opening, area)),
            heading: pose.heading,
        });
    }
    let area = here?;
    let spot = at_door(openings, area, pose.at, near)
        .or_else(|| next_to(world, relations, area, pose.at))
        .unwrap_or_else(|| by_walls(world, relations, area, pose.at));
    Some(Whereabouts { area, spot, heading: pose.heading })
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

/// Position along a side and out of it: (share of its length, cm to the outside).
fn along_and_out((a, b): (Point, Point), p: Point) -> Option<(f64, f64)> {
    let normal = outward_normal(a, b)?;
    let along = b - a;
    Some(((p - a).dot(&along) / along.norm_squared(), (p - a).dot(&normal)))
}

pub(super) fn in_doorway(
    opening: &Opening,
    p: Point,
    here: Option<AreaId>,
    near: &Thresholds,
) -> bool {
    opening.sides.iter().any(|side| in_side(side, p, here, near))
}

fn in_side(side: &OpenSide, p: Point, here: Option<AreaId>, near: &Thresholds) -> bool {
    let Some((share, out)) = along_and_out(side.ends, p) else { return false };
    // In the wall's thickness no Area is underfoot.
    let thickness = side.outward.map_or(0.0, |(_, way)| way.min(near.step_distance));
    let within = if here.is_none() {
        -near.robot_doorway..=thickness
    } else {
        -near.robot_doorway..=near.robot_doorway
    };
    (0.0..=1.0).contains(&share) && within.contains(&out)
}

fn at_door(openings: &Openings, area: AreaId, p: Point, near: &Thresholds) -> Option<Spot> {
    let away = |o: &Opening| {
        let sides = o.sides.iter().map(|s| (p - nearest_on_segment(p, s.ends.0, s.ends.1)).norm());
        sides.fold(f64::INFINITY, f64::min)
    };
    let nearest = openings
        .iter()
        .filter(|o| o.is_of(area))
        .map(|o| (away(o), o))
        // What lies in the Area's own side says more than what only leads there.
        .min_by(|(d, o), (e, q)| {
            d.total_cmp(e).then(o.side_in(area).is_none().cmp(&q.side_in(area).is_none()))
        })?;
    let (distance, opening) = nearest;
    (distance <= near.robot_door)
        .then(|| Spot::AtDoor { way: Way::through(opening, area), distance })
}

/// The nearest thing that stands on the floor and is the only one of its kind and of its name in the Area.
fn next_to(world: &World, relations: &Relations, area: AreaId, p: Point) -> Option<Spot> {
    let bodies = &relations.measurements().bodies;
    let standing = relations.on_floor_of(area);
    let bodies: Vec<&Body> = standing.iter().filter_map(|id| bodies.get(id)).collect();
    let name = |id: ReplicaId| world.replicas.get(&id).map(|r| r.name.as_str());
    let distance = |outline: &[Footprint]| {
        outline.iter().map(|f| f.distance_to(p)).fold(f64::INFINITY, f64::min)
    };
    bodies
        .iter()
        .filter(|b| {
            let mut others = bodies.iter().filter(|c| c.id != b.id);
            others.all(|c| c.object != b.object && name(c.id) != name(b.id))
        })
        .map(|b| (distance(&b.outline), *b))
        .filter(|(d, _)| *d <= relations.thresholds().robot_thing)
        .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.id.cmp(&b.1.id)))
        .map(|(distance, body)| {
            let is_flat = body.top - body.bottom <= world.robot.step.get();
            match distance <= 0.0 && is_flat {
                true => Spot::On { replica: body.id },
                false => Spot::NextTo { replica: body.id, distance },
            }
        })
}

pub(super) fn by_walls(world: &World, relations: &Relations, area: AreaId, p: Point) -> Spot {
    let near = relations.thresholds();
    let walls: Vec<Vector> = relations
        .measurements()
        .walls(area)
        .filter(|&(a, b)| (p - nearest_on_segment(p, a, b)).norm() <= near.robot_wall)
        .filter_map(|(a, b)| outward_normal(a, b))
        .collect();
    let straight = near.corner_turn.to_radians().cos();
    let turned = |u: &Vector, v: &Vector| u.dot(v) < straight;
    let opposite = |u: &Vector, v: &Vector| u.dot(v) < -straight;
    let corner = walls.iter().any(|u| walls.iter().any(|v| turned(u, v) && !opposite(u, v)));
    match walls.len() {
        0 if in_middle(world, area, p, near) => Spot::InMiddle,
        0 => Spot::Inside,
        _ if corner => Spot::InCorner,
        _ => Spot::AlongWall,
    }
}

/// Whether a point lies in the middle of an Area: away from its centroid by no more than a share of the way from there to
/// its rim. An Area whose centroid lies outside it, like an L, has no middle.
fn in_middle(world: &World, area: AreaId, p: Point, near: &Thresholds) -> bool {
    let Some((_, frame)) = world.placement(area) else { return false };
    let parts: Vec<Polygon> = world.areas[&area]
        .items
        .iter()
        .map(|item| {
            let place = frame.compose(&item.frame);
            let base = &world.orthoframe_of(item).base;
            Polygon::new(base.iter().map(|side| place.apply(side.start)).collect())
        })
        .collect();
    let whole: f64 = parts.iter().map(Polygon::signed_area).sum();
    let moments = parts.iter().map(|part| part.centroid().coords * part.signed_area());
    let centroid = Point::from(moments.fold(Vector::zeros(), |sum, m| sum + m) / whole);
    let holds = |at: Point| parts.iter().any(|part| part.contains(at, 1e-6));
    whole > 0.0 && holds(centroid) && holds(centroid + (p - centroid) / near.robot_middle.max(1e-6))
}
