//! Where a way begins, and what it is, in either of the two road graphs.

use super::command::Command;
use super::system::{ArcIx, VertexIx};
use super::weight::Cost;

/// Where the robot stopped, and over which arc it came; without it the heading is unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Position {
    pub vertex: VertexIx,
    pub last: Option<ArcIx>,
}

/// A shortest way, as either graph gives it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Way {
    pub commands: Vec<Command>,
    /// Vertices of the graph that were used: «1», «2'».
    pub labels: Vec<String>,
    pub cost: Cost,
    /// The last arc: together with its head the position at the goal.
    pub arrived_by: ArcIx,
}
