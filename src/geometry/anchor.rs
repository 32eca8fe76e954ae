//! Places where the robot's centre may be, and those that were moved to where it may.

use crate::units::Point;

use super::blocker::Blocker;
use super::cells::CellKey;

/// A start or goal where the robot does not fit, and the nearest place where it does.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    pub from: Point,
    pub to: Point,
    /// What takes the place, if anything does; else it is a dead zone, a strait or too near to a wall.
    pub blocker: Option<Blocker>,
}

/// A place where the robot's centre may be.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Anchor {
    pub(super) at: Point,
    pub(super) cell: CellKey,
    pub(super) moved: Option<Moved>,
}

impl Anchor {
    pub(super) fn at(at: Point, cell: CellKey) -> Self {
        Self { at, cell, moved: None }
    }
}
