//! What bars the only way of a mission, and what is said of it.

use crate::units::{AreaId, MapId, Point, ReplicaId};

/// What stands in the only way.
#[derive(Debug, Clone, PartialEq)]
pub struct Barred {
    /// Things of the Map; none where only what is on no map stands there.
    pub things: Vec<ReplicaId>,
    /// What was seen there and is on no map, as far as it was believed to stand there.
    pub unknown: Vec<ReplicaId>,
    /// Where it stands, as far as that is known: cm on the Map.
    pub map: MapId,
    pub area: AreaId,
    pub at: Point,
    /// The door or place to which it bars the way, where that has a name.
    pub to: Option<String>,
}

/// What is said to who asks for a way to be cleared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Answer {
    /// Nobody answers.
    #[default]
    Silence,
    /// The way is clear.
    Clear,
    /// It will not be.
    GiveUp,
}
