//! What no map says, and a robot knows: where it stands, what it has in view, where it believes things to be, who has
//! what was carried off. It is told, not measured, and only to rule texts that ask for it.

use crate::geometry::{Blocker, Eye, FloorPlan};
use crate::map::World;
use crate::units::{AreaId, InOrder as _, MapId, Pose, ReplicaId};

use super::thresholds::Thresholds;

/// What a robot knows beside its map.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Told {
    /// Where it stands.
    pub robot: Option<(MapId, Pose)>,
    /// What it has in view there.
    pub in_view: Vec<ReplicaId>,
    /// Where things that were looked for are believed to be, and how surely, as a share of one.
    pub believed: Vec<(ReplicaId, AreaId, f64)>,
    /// What is on no map since it was taken up, and who has it; an empty name for the robot itself.
    pub carried: Vec<(ReplicaId, String)>,
}

/// The things that one makes out, the nearest first.
#[must_use]
pub fn things_in_view(
    world: &World,
    floor: &FloorPlan,
    eye: &Eye,
    near: &Thresholds,
) -> Vec<ReplicaId> {
    let mut seen: Vec<(ReplicaId, f64, f64)> = Vec::new();
    for view in floor.faces(world, eye).in_view(eye) {
        let Blocker::Replica { replica, .. } = view.face.blocker else { continue };
        let size = view.apparent_size(eye);
        match seen.iter_mut().find(|s| s.0 == replica) {
            Some((_, nearest, whole)) => {
                *nearest = nearest.min(view.distance);
                *whole += size;
            }
            None => seen.push((replica, view.distance, size)),
        }
    }
    seen.retain(|(_, _, size)| *size >= near.robot_speck);
    seen.order_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    seen.into_iter().map(|(id, ..)| id).collect()
}

/// The robot's eye at a pose: at its height over the floor on which it stands.
#[must_use]
pub fn robot_eye(world: &World, floor: &FloorPlan, pose: Pose, near: &Thresholds) -> Eye {
    let stands = floor.scene().area_at(pose.at);
    let room = stands.and_then(|area| floor.scene().areas[&area].prisms.first());
    let height = room.map_or(0.0, |prism| prism.bottom) + world.robot.height.get();
    Eye { pose, height, field: near.robot_field, range: near.robot_sight }
}
