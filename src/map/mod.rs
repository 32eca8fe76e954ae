//! The paper's nouns: Orthoframe, Object, Area, Fragment, Map, Domain, Door, and what must hold between them.
//!
//! After paper 1 §§1-4 and 6 and paper 2. A [`World`] is the whole model of an operating environment: one
//! Domain with everything in it. A `World` that came out of [`World::load`] or of an edit has passed
//! every check of this folder; what is built by hand must pass [`check`] before it is stored.
//!
//! ```
//! use orthoframe_map::{Entity, Format, World};
//! use orthoframe_units::Source;
//!
//! let text = r#"
//!     format = 1
//!     [orthoframe.floor]
//!     rect = [400, 300]
//!     height = 270
//!     [area.study]
//!     name = "Кабинет"
//!     items = [{ id = "A", orthoframe = "floor" }]
//!     [map.flat]
//!     items = [{ area = "study" }]
//! "#;
//! let world = World::parse(&Source::new("study.toml", text), Format::Toml)?;
//! assert!(matches!(world.find("кабинет")[..], [Entity::Area(_)]));
//!
//! // Every fault at once, each at its line and character column.
//! let spoiled = text.replace("400", "-400").replace("area = \"study\"", "area = \"studio\"");
//! let errors = World::parse(&Source::new("study.toml", spoiled), Format::Toml).unwrap_err();
//! let shown: Vec<_> = errors.faults.iter().map(|f| (errors.position(f).unwrap(), f.to_string())).collect();
//! assert_eq!(shown[0], ((4, 12), "Ортофрейм «floor»: векторы Базы идут по часовой стрелке".into()));
//! assert_eq!(shown[1].0, (10, 23)); // Помещение «studio» не существует; может быть, «study»?
//! # Ok::<(), orthoframe_map::MapErrors>(())
//! ```
//!
//! # Invariants
//!
//! A `World` that came out of `World::load` has passed every check of `map/check`; warnings do not hinder. What
//! reads well and cannot be (`check/doubts`) is looked for by `ortho check` alone. Writing a checked `World` and
//! reading it again gives the same `World`, ids included. A fault knows its place as a path into the model; only
//! `map/file` turns it into a place in the text. An [`Edit`] is a value, which a text of edits is read into; it changes
//! the records that it names, and nothing can be edited into a map that a map file could not say. Reading takes bounded
//! memory: text size, nesting, alias replay, vectors per base are limited. A conditional side bears exactly one door; a
//! named passage is a door without leaves.

use orthoframe_units as units;

units::messages!("../../rules/messages", "map", MapError);

mod check;
mod counterpart;
mod device;
mod door;
mod doorway;
mod fault;
mod file;
mod marks;
mod name_index;
mod object;
mod orthoframe;
mod records;
mod types;
mod world;
mod zone;

pub use check::plane;
pub use check::{LeastSizes, THICKEST_WALL, Tolerances, check, doubts, news};
pub use device::{is_dark, is_on, is_open, set_open, stands, switch};
pub use door::{Door, DoorKind, DoorLeaf, DoorMount, DoorState, DoorStatus, HingeSide, OpensTo};
pub use fault::{Fault, MapError, MapErrors, Record, Spot, Step};
pub use file::{
    Edit, EditReading, Edits, Format, Naming, NewRecord, NextIds, Reading, RobotSaid, Truth, edit,
    json_schema, kinds, locate, read, read_file, read_truth, schema,
};
pub use marks::Mark;
pub use name_index::NameIndex;
pub use object::{Area, Face, Item, ItemLink, Object, SideRef};
pub use orthoframe::{BaseVector, Orthoframe, Permeability, Properties};
pub use records::{Change, Records};
pub use types::{Case, Forms, Gender, TypeEntry, TypeKind, TypeList, TypeLists};
pub use world::{
    Domain, DomainMap, Entity, LiftStop, Map, MapItem, MapLink, Place, Profile, Replica,
    RobotProfile, World,
};
pub use zone::{Extent, Zone, ZoneKind};
