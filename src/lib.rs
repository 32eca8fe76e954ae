//! orthoframe: an embedded knowledge base and logic engine for robots that work inside buildings.
//!
//! A building's rooms, doors and furniture, described once as a 2.5D map of *Orthoframes*, answer from then
//! on where things are, how to get there, and what to do to bring them; offline, in one process.
//! [`Engine`] is the front door:
//!
//! ```no_run
#![doc = include_str!("../examples/fetch.rs")]
//! ```
//!
//! The folders and which may use which are drawn in `ARCHITECTURE.md`.

#[cfg(feature = "cli")]
pub mod cli;
pub mod engine;

pub use engine::Engine;
pub use orthoframe_corridor as corridor;
pub use orthoframe_draw as draw;
pub use orthoframe_exchange as exchange;
pub use orthoframe_facts as facts;
pub use orthoframe_geometry as geometry;
pub use orthoframe_graphplan as graphplan;
pub use orthoframe_language as language;
pub use orthoframe_map as map;
pub use orthoframe_robot as robot;
pub use orthoframe_semantics as semantics;
pub use orthoframe_store as store;
pub use orthoframe_strips as strips;
pub use orthoframe_units as units;
pub use orthoframe_vectors as vectors;
