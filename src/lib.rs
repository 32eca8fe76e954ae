//! orthoframe: an embedded knowledge base and logic engine for robots that work inside buildings.

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
