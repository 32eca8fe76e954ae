//! Importers and exporters of foreign formats.
//!
//! A reader makes a [`Survey`] of a foreign file; the assembler makes a checked [`crate::map::World`] of any `Survey`.

mod error;
mod input;
mod scene;
mod survey;

pub use error::ReadError;
pub use input::{LARGEST, decode, file_bytes, file_text};
pub use scene::{Assets, SceneFormat, read_procthor, read_pyrobosim, read_thor, read_virtualhome};
pub use survey::{
    Kind, Level, Lift, Opening, OpeningKind, Part, Remark, Room, Spot, Survey, Thing,
};
