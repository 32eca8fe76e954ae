//! Importers and exporters of foreign formats.
//!
//! A reader makes a [`Survey`] of a foreign file; the assembler makes a checked [`crate::map::World`] of any `Survey`;
//! [`read`] recognises the format and does both. What had to be mended or left out stands in the [`Report`].

mod assemble;
mod error;
mod export;
mod fault;
pub mod geojson;
pub mod ifc;
mod input;
mod osmag;
mod outline;
mod read;
mod report;
mod rmf;
pub mod ros;
mod scene;
mod shafts;
mod survey;
mod synonyms;
mod yaml;

pub use assemble::assemble;
pub use error::ReadError;
pub use export::{
    GridFiles, MOST_CELLS, to_geojson, to_grid, to_map_file, to_records, to_route_graph,
};
#[cfg(feature = "sqlite")]
pub use export::{SqliteError, read_sqlite, write_sqlite};
pub use fault::ImportError;
pub use input::{LARGEST, decode, file_bytes, file_text};
pub use osmag::read as read_osmag;
pub use read::{Format, Imported, Options, read};
pub use report::{Count, Deed, Note, Report, What, Why};
pub use rmf::read as read_rmf;
pub use scene::{Assets, SceneFormat, read_procthor, read_pyrobosim, read_thor, read_virtualhome};
use survey::zero_of;
pub use survey::{
    Feet, Kind, Lane, Level, Lift, Opening, OpeningKind, Part, Remark, Room, Spot, Survey, Thing,
    Told,
};
pub use synonyms::{Found, Meaning, Synonyms, Vocabulary};
