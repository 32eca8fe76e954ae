//! Tables, keys, history (paper 2): the map kept so that nothing acknowledged is ever lost.
//!
//! Every table of paper 2 has a record type and a sled tree of its own ([`records`], [`Table`]); a [`World`]
//! becomes records and comes back from them unchanged ([`Sheet`]). Every change is one transaction: a
//! checksummed frame of the journal, on the disk before it is acknowledged, then one sled transaction. Nothing
//! is overwritten without trace: each version of a record bears who wrote it, when, and in which revision, and
//! the map can be read as of any revision.
//!
//! ```
//! use orthoframe_store::{Change, Store, Timestamp};
//! # let dir = tempfile::tempdir().unwrap();
//! # let dir = dir.path().join("store");
//!
//! let (store, report) = Store::open(&dir)?;
//! assert_eq!((store.revision(), report.torn_bytes), (0, 0));
//! assert!(store.world()?.is_none()); // until the first store.import(&world, &change)
//! let change = Change::new("Мастер", Timestamp(0), "первая карта");
//! # let _ = change;
//! # Ok::<(), orthoframe_store::StoreError>(())
//! ```
//!
//! [`World`]: crate::map::World
//!
//! # Invariants
//!
//! A transaction is one checksummed journal frame, on the disk before it is acknowledged; readers read memory,
//! each at its revision, and take over what other programs acknowledged (`share`); sled is an index that follows on a thread of its own and that snapshot and journal can
//! rebuild, and only `store/trees.rs` names it. What is past lies in runs on the disk (`past`), each in two files, and is read
//! when it is asked for, its checksum tested. Ids are never given twice and nothing is overwritten without
//! trace. Observations, the robot's pose, and what it opened, switched or carried never change the map. What the
//! papers' tables lack stands in marked columns and tables. After a failed journal write nothing more is written
//! until the store is opened again.

use orthoframe_map as map;
use orthoframe_units as units;

units::messages!("../../rules/messages", "store", StoreError);

mod behind;
mod cell;
mod changes;
mod check;
mod derived;
mod diff;
mod disk;
mod edits;
mod error;
mod frame;
mod gc;
mod head;
mod ids;
mod journal;
mod keep;
mod lock;
mod memory;
mod observe;
mod open;
mod past;
mod queue;
mod read;
mod reader;
mod robot;
mod run;
mod schema;
mod share;
mod sheet;
pub mod shipping;
mod sides;
#[cfg(test)]
mod sim;
mod snapshot;
mod tables;
mod touched;
mod trees;
mod undo;
mod vault;
mod version;
mod wall;
mod words;
mod write;

pub use crate::units::{Timestamp, TimestampError};
pub use cell::{Cell, Key, Kind, Row};
pub use changes::Changes;
pub use check::{Finding, FsckReport, Severity, fsck};
pub use derived::Derived;
pub use diff::{Difference, Fate, FieldChange};
pub use edits::{Change, Counts, Edits, ImportReport, Revision, RevisionKind};
pub use error::StoreError;
pub use gc::Forgotten;
pub use ids::{next_ids, numbered};
pub use keep::Store;
pub use observe::{Belief, Observation, Proposal, Seen, Stay};
pub use queue::{Queue, QueuedTask};
pub use reader::Reader;
pub use robot::{FoundAt, RobotMemory, SeenObstacle};
pub use schema::{Column, Origin};
pub use share::{Meanwhile, last_transaction};
pub use sheet::Sheet;
pub use tables::{Record, Table};
pub use vault::OpenReport;
pub use version::{Stamp, Version};

/// One struct a table, under the table's name.
pub mod records {
    pub use super::tables::*;
}
