//! Doors (M7; paper 1 §2, paper 2 §7): leaves, the way they open, and how far they stand open now.
//!
//! Beyond the papers a plain passage can be a [`Door`] too, of kind [`DoorKind::Passage`] and without leaves, so that
//! plans and reports can call it by its name.

use serde::{Deserialize, Serialize};

use crate::units::{Cm, DoorId, TypeId};

use super::{Forms, Properties};

/// How the leaves of a door move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum DoorKind {
    Hinged,
    /// Leaves run along the wall.
    Sliding,
    /// No leaf at all: an opening with a name, mounted on permeable sides and always open.
    Passage,
}

/// Where a leaf's hinges are, seen from the Area into which the door's side faces (paper 2: 0 right, 1 left).
/// A sliding leaf withdraws towards this side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum HingeSide {
    Right,
    Left,
}

/// One leaf (table DoorSides).
#[derive(Debug, Clone, PartialEq)]
pub struct DoorLeaf {
    pub hinge: HingeSide,
    /// Share of the door's width, in (0, 1]; the shares of a door add up to 1.
    pub share: f64,
    pub thickness: Cm,
    /// Degrees of turn for a hinged leaf, percent of its width for a sliding one.
    pub max_open: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum DoorStatus {
    Open,
    Closed,
    Locked,
}

/// How a door stands now. `opening` is 0 unless the status is `Open`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoorState {
    pub status: DoorStatus,
    /// Percent of [`DoorLeaf::max_open`], 0..=100, the same for all leaves.
    pub opening: f64,
}

impl DoorState {
    pub const OPEN: Self = Self { status: DoorStatus::Open, opening: 100.0 };
    pub const CLOSED: Self = Self { status: DoorStatus::Closed, opening: 0.0 };
    pub const LOCKED: Self = Self { status: DoorStatus::Locked, opening: 0.0 };
}

/// A door: of Areas, where the two Areas that it joins mount it each on a side of their own,
/// or of an Object, where each replica has its own state.
#[derive(Debug, Clone, PartialEq)]
pub struct Door {
    pub id: DoorId,
    pub key: String,
    pub name: String,
    pub name_en: String,
    pub door_type: Option<TypeId>,
    pub kind: DoorKind,
    pub width: Cm,
    pub height: Cm,
    /// From the right jamb to the left one, seen from the first Area that mounts the door.
    pub leaves: Vec<DoorLeaf>,
    pub state: DoorState,
    pub properties: Properties,
    pub forms: Forms,
}

/// Whether the leaves swing into the mounting Area (paper 2, SetInside: 1) or out of it (-1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum OpensTo {
    Inside,
    Outside,
}

/// A door bound to a conditional side (tables AreaDoors, ObjectDoors), a passage to a permeable one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DoorMount {
    pub item: String,
    pub side: String,
    pub door: DoorId,
    pub opens: OpensTo,
}
