//! Many robots and many buildings: one centre on an existing PostgreSQL (SPEC F).
//!
//! Each robot keeps its own store and works alone. When there is a line it pushes the frames of its journal ([`push`]); the
//! centre keeps the frames and the records that they write, in one transaction ([`ingest`]), in the tables of paper 2 with
//! their past (`migrations/`). What the server has is not made again: roles, row security, partitions, backup, replication
//! are PostgreSQL's.
//!
//! # Invariants
//!
//! - A transaction of the centre holds a robot's frames and all that they write, or nothing of them; what is acknowledged
//!   is committed.
//! - Whatever is done in a robot's name is done under the role `fleet_robot` with its key set: row security decides.
//! - The embedded store knows nothing of the centre.

use orthoframe_draw as draw;
use orthoframe_facts as facts;
use orthoframe_geometry as geometry;
use orthoframe_language as language;
use orthoframe_map as map;
use orthoframe_semantics as semantics;
use orthoframe_store as store;
use orthoframe_units as units;

units::messages!("../../rules/messages", "fleet", FleetError);

pub mod ask;
mod console;
pub mod db;
pub mod derive;
mod error;
pub mod gate;
pub mod handout;
mod holder;
pub mod ingest;
pub mod keys;
mod lists;
pub mod migrate;
pub mod picture;
pub mod pull;
pub mod push;
pub mod query;
pub mod revise;
pub mod rows;
pub mod serve;
pub mod sheets;
pub mod tls;

pub use error::{FleetError, Result};
