//! What left the map, and the states of the map by which that is told.

use crate::words::WordHints;

/// To which state of which map something belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    pub map: u64,
    pub change: u64,
}

/// What left the map, as it was called; without a name where it had none.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Departed {
    pub name: String,
    pub english: String,
    pub hints: WordHints,
}
