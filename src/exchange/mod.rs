//! Importers and exporters of foreign formats.
//!
//! A reader makes a [`Survey`] of a foreign file; the assembler makes a checked [`crate::map::World`] of any `Survey`;
//! [`read`] recognises the format and does both. What had to be mended or left out stands in the [`Report`].
//!
//! # Invariants
//!
//! A reader judges nothing beyond its syntax; one assembler serves all formats. A world that it makes passes
//! every check of `map/check`; every record that does not arrive as it stands has a note with the file's own id,
//! a class of which nothing is made one with its name, and the counts are those of the file. Ids follow the order
//! of the file, so that two imports of one file give the same world. Coordinates are the file's; a Map that keeps
//! them says so (`Map::frame`), any other has a corner of its base Area at the origin. A reader's memory is
//! bounded by its limits and its time by the file's length, whatever the bytes: `fuzz/bodies.rs` states it,
//! `tests/hostile.rs` tries it. What is exported in our own notations reads back as the same world.

use orthoframe_geometry as geometry;
use orthoframe_map as map;
use orthoframe_store as store;
use orthoframe_units as units;

units::messages!(
    "../../rules/messages",
    "exchange",
    ImportError,
    ReadError,
    report::Why,
    #[cfg(feature = "sqlite")]
    SqliteError
);

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
    Cell, Grid, GridFiles, MOST_CELLS, Mask, to_geojson, to_grid, to_map_file, to_masks,
    to_passframe_mesh, to_records, to_route_graph, to_route_graph_of_all,
};
#[cfg(feature = "sqlite")]
pub use export::{SqliteError, read_sqlite, write_sqlite};
pub use fault::ImportError;
pub use input::{LARGEST, decode, file_bytes, file_text};
pub use osmag::read as read_osmag;
pub use read::{Format, Imported, Options, read, read_grid};
pub use report::{Count, Note, Report, Treatment, What, Why};
pub use rmf::read as read_rmf;
pub use scene::{Assets, SceneFormat, read_procthor, read_pyrobosim, read_thor, read_virtualhome};
use survey::zero_of;
pub use survey::{
    Feet, Kind, Lane, Level, Lift, Opening, OpeningKind, Part, Remark, Room, Spot, Survey, Thing,
    Told,
};
pub use synonyms::{Found, Meaning, SYNONYMS, Synonyms, Vocabulary};
