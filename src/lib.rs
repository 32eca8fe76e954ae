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
pub mod corridor;
pub mod draw;
pub mod engine;
pub mod exchange;
pub mod facts;
pub mod geometry;
pub mod graphplan;
pub mod language;
pub mod map;
pub mod robot;
pub mod semantics;
pub mod store;
pub mod strips;
pub mod units;

pub use engine::Engine;
