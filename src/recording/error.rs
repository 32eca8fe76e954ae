//! Why a recording cannot be written or read.

use crate::units::{Bilingual, Fault};

/// See the head of this file.
#[derive(Debug, Fault)]
#[fault(recording)]
#[non_exhaustive]
pub enum RecordingError {
    /// The disk refused.
    Unwritable { path: String, reason: String },
    /// The disk refused.
    Unreadable { path: String, reason: Bilingual },
    /// Bytes of another kind.
    NotMcap { path: String },
    /// An MCAP of which nothing of a mission is left.
    Cut { path: String },
    /// An MCAP of another program.
    Foreign { path: String },
}

impl RecordingError {
    /// The input is at fault, not the program or the disk.
    #[must_use]
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Unwritable { .. })
    }
}
