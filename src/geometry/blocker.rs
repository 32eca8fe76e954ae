//! What takes floor away, and whose it is.

use crate::units::{AreaId, DoorId, ReplicaId, ZoneId};

use super::Polygon;

/// What takes floor away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Blocker {
    /// An Orthoframe of a replica.
    Replica { replica: ReplicaId, item: usize },
    /// A leaf of a door between Areas.
    DoorLeaf { door: DoorId, leaf: usize },
    /// A leaf of a replica's own door.
    ReplicaLeaf { replica: ReplicaId, door: DoorId, leaf: usize },
    /// A wall, by the side that stands on it.
    Wall { area: AreaId, item: usize, side: usize },
    /// A piece of the Area's floor that lies too high or too low, or under a low ceiling.
    Floor { area: AreaId, item: usize },
    /// A zone that the robot has to keep out of.
    Zone { zone: ZoneId },
}

impl Blocker {
    /// Jambs have no side of their own: they belong to the wall.
    pub(super) fn jamb(area: AreaId) -> Self {
        Self::Wall { area, item: 0, side: 0 }
    }
}

/// A piece of floor that is taken, and the heights between which.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    pub blocker: Blocker,
    pub polygon: Polygon,
    /// The side of its Orthoframe that it is a strip of; none of a whole base, whose edges are the sides.
    pub side: Option<usize>,
    /// Above the floor, in cm.
    pub bottom: f64,
    pub top: f64,
}
