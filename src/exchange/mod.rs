//! Importers and exporters of foreign formats.
//!
//! A reader makes a [`Survey`] of a foreign file; the assembler makes a checked [`crate::map::World`] of any `Survey`.

mod survey;

pub use survey::{Kind, Level, Lift, Opening, OpeningKind, Part, Room, Spot, Survey, Thing};
