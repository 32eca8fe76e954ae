//! The paper's nouns: Orthoframe, Object, Area, Fragment, Map, Domain, Door, and what must hold between them.
//!
//! After paper 1 §§1-4 and 6 and paper 2. A [`World`] is the whole model of an operating environment: one
//! Domain with everything in it. A `World` that came out of [`World::load`](World) or of an edit has passed
//! every check of this folder; what is built by hand must pass [`check`] before it is stored.

mod check;
mod door;
mod doorway;
mod fault;
mod file;
mod object;
mod orthoframe;
mod types;
mod world;

pub use check::check;
pub use door::{Door, DoorKind, DoorLeaf, DoorMount, DoorState, DoorStatus, HingeSide, OpensTo};
pub use fault::{Fault, MapError, MapErrors, Record, Spot, Step};
pub use file::{Format, Reading, json_schema, read, read_file};
pub use object::{Area, Face, Item, ItemLink, Object, SideRef};
pub use orthoframe::{BaseVector, Orthoframe, Permeability, Properties};
pub use types::{Case, Forms, Gender, TypeEntry, TypeKind, TypeList, TypeLists};
pub use world::{
    Domain, DomainMap, Entity, LiftStop, Map, MapItem, MapLink, Place, Replica, RobotProfile, World,
};
