//! What the robot faces, before words are made.

use crate::geometry::{Blocker, FloorPlan, Owner, nearest_on_segment};
use crate::map::{DoorStatus, Permeability, World};
use crate::semantics::{self, Relations, Way};
use crate::units::{AreaId, DoorId, Point, Pose, ReplicaId, Vector};

/// What the robot faces, before words are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Faced {
    Door(Way),
    /// An open leaf of a door.
    Leaf(Way),
    Object(ReplicaId),
    Wall {
        /// Whether the robot is by it.
        own: bool,
    },
    /// Nothing near.
    Inward,
}

/// The first thing that a ray along the heading meets.
pub(super) fn faced(
    world: &World,
    relations: &Relations,
    floor: &FloorPlan,
    area: AreaId,
    pose: Pose,
) -> Option<Faced> {
    let (scene, near) = (floor.scene(), relations.thresholds());
    let (sin, cos) = pose.heading.sin_cos();
    let ray = Vector::new(cos, sin);
    let height = world.robot.height.get();
    let mut nearest: Option<(f64, Faced)> = None;
    let mut offer = |distance: f64, what: Faced| {
        if distance <= near.robot_facing && nearest.as_ref().is_none_or(|(d, _)| distance < *d) {
            nearest = Some((distance, what));
        }
    };
    // A thing of another room leans on the other side of the wall, or reaches into it where boxes are loose.
    let wall = scene.areas.get(&area).and_then(|placed| {
        let own = placed.prisms.iter().filter(|p| matches!(p.owner, Owner::Area(_)));
        let sides = own.flat_map(|prism| prism.polygon.edges().zip(prism.sides.iter()));
        let walls = sides.filter(|(_, side)| side.permeability == Permeability::Impermeable);
        walls.filter_map(|((a, b), _)| hit(pose.at, ray, a, b)).min_by(f64::total_cmp)
    });
    let is_behind = |replica: ReplicaId, distance: f64| {
        world.replicas.get(&replica).is_some_and(|r| r.area != area)
            && wall.is_some_and(|wall| distance > wall - near.robot_through)
    };
    // One faces a table, not the spoon on it.
    for replica in scene.replicas.values().filter(|r| !world.has_trait(r.id, "portable")) {
        for prism in replica.prisms.iter().filter(|p| p.bottom < height && p.top > near.robot_low) {
            for (a, b) in prism.polygon.edges() {
                let met = hit(pose.at, ray, a, b);
                if let Some(distance) = met.filter(|d| !is_behind(replica.id, *d)) {
                    offer(distance, Faced::Object(replica.id));
                }
            }
        }
    }
    // One does not look through a door's leaf, nor through the leaf of a wardrobe.
    let is_open = |door: DoorId| floor.door_state(world, door).status == DoorStatus::Open;
    for obstacle in floor.fragment(area).into_iter().flat_map(|f| f.obstacles()) {
        let what = match obstacle.blocker {
            Blocker::DoorLeaf { door, .. } if is_open(door) => {
                way_of(relations, door, area).map(Faced::Leaf)
            }
            Blocker::ReplicaLeaf { replica, .. } => Some(Faced::Object(replica)),
            _ => None,
        };
        for (a, b) in obstacle.polygon.edges() {
            if let (Some(what), Some(distance)) = (what, hit(pose.at, ray, a, b)) {
                offer(distance, what);
            }
        }
    }
    let placed = scene.areas.get(&area)?;
    for prism in &placed.prisms {
        let Owner::Area(area) = prism.owner else { continue };
        for ((a, b), side) in prism.polygon.edges().zip(prism.sides.iter()) {
            let Some(distance) = hit(pose.at, ray, a, b) else { continue };
            if side.permeability == Permeability::Impermeable {
                let away = (pose.at - nearest_on_segment(pose.at, a, b)).norm();
                offer(distance, Faced::Wall { own: away <= near.robot_wall });
            } else if let Some(way) = way_through(relations, area, nalgebra::center(&a, &b)) {
                offer(distance, Faced::Door(way));
            }
        }
    }
    Some(nearest.map_or(Faced::Inward, |(_, faced)| faced))
}

/// A door seen from an Area, or from the one that mounts it where it is not of that Area.
fn way_of(relations: &Relations, door: DoorId, area: AreaId) -> Option<Way> {
    let own = relations.openings().iter().filter(|o| o.door == Some(door));
    let opening = own.min_by_key(|o| !o.is_of(area))?;
    Some(Way::through(opening, if opening.is_of(area) { area } else { opening.area() }))
}

/// The opening of an Area in a side whose middle is here, seen from that Area.
fn way_through(relations: &Relations, area: AreaId, middle: Point) -> Option<Way> {
    let near = |o: &&semantics::Opening| o.sides.iter().any(|s| (s.middle() - middle).norm() < 1.0);
    let opening = relations.openings().iter().filter(near).min_by_key(|o| !o.is_of(area))?;
    Some(Way::through(opening, area))
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
