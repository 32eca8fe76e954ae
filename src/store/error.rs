//! What can go wrong with a store, each with its remedy.

use std::path::{Path, PathBuf};

use crate::units::{Bilingual, is_input};

/// What was to be done with a file.
pub(crate) mod doing {
    pub(crate) use crate::units::Piece as Words;
    use crate::units::word;

    pub(crate) const OPEN: Words = word!("open-2");
    pub(crate) const LOCK: Words = word!("lock");
    pub(crate) const LIST: Words = word!("read-the-directory");
    pub(crate) const READ: Words = word!("read");
    pub(crate) const WRITE: Words = word!("write");
    pub(crate) const WRITE_DIR: Words = word!("write-the-directory");
    pub(crate) const WRITE_SNAPSHOT: Words = word!("write-the-snapshot");
    pub(crate) const FIND_ROOM: Words = word!("find-room-for");
    pub(crate) const REMOVE: Words = word!("remove");
    pub(crate) const MAKE: Words = word!("make");
    pub(crate) const MAKE_DIR: Words = word!("make-the-directory");
    pub(crate) const RENAME: Words = word!("rename");
    pub(crate) const CUT: Words = word!("cut-short");
}

/// A store that cannot be opened, read or written, or that refuses what it was asked to keep.
#[derive(Debug, crate::units::Fault)]
#[fault(store)]
#[non_exhaustive]
pub enum StoreError {
    /// The file system refused.
    Io { what: Bilingual, path: String, source: std::io::Error },

    /// A directory with something else in it.
    NotAStore { dir: String },

    /// A backup is restored into a place of its own.
    NotEmpty { dir: String },

    /// There is nothing at this path.
    Missing { dir: String },

    /// Written by another version of the program.
    UnknownFormat { dir: String, found: String, known: u32 },

    /// Another process writes it, and went on longer than is waited; or has the robot drive.
    Locked { dir: String, drives: bool },

    /// A broken frame stands before good ones: not a torn tail.
    JournalCorrupt { path: String, offset: u64 },

    /// The journal is whole as far as it goes, and does not go as far as was acknowledged.
    #[fault(code = "store::journal_cut_short")]
    CutShort { found: u64, known: u64 },

    /// Neither the journal nor the tables are whole.
    BothCorrupt { dir: String, journal: Box<Bilingual>, tables: Box<Bilingual> },

    /// A record's bytes do not match their checksum, or its cells do not fit.
    BadRecord { table: &'static str, key: String },

    /// A record of the map names one that is not there.
    BrokenReference { table: &'static str, what: Bilingual },

    /// Two records with one key.
    Duplicate { table: &'static str, key: String },

    /// Two things with one name, so that an import cannot tell them apart.
    DuplicateName { table: &'static str, name: String },

    /// An id of something that is gone was given to something else.
    IdReused { table: &'static str, id: u32, was: String, is: String },

    /// A number that is none.
    NotFinite { table: &'static str, key: String, column: &'static str, value: f64 },

    /// Something is said of a replica that is not in the map.
    UnknownReplica { id: u32 },

    /// A derived table was to be edited.
    DerivedTable { table: &'static str },

    /// The store was opened for reading, or has become unsafe to write.
    ReadOnly {
        reason: Bilingual,
        /// It was opened so; else the disk is at fault.
        by_choice: bool,
    },

    /// No such revision.
    UnknownRevision { wanted: u64, last: u64 },

    /// What a reader or an "as of" asks for was collected as garbage.
    ForgottenRevision { wanted: u64, first: u64 },

    /// Later changes stand on the one that was to be undone.
    UndoConflict { revision: u64, record: String, by: u64 },

    /// It was undone already, and not brought back since.
    AlreadyUndone { revision: u64, by: u64 },

    /// Without what the revision made, the map would be faulty.
    UndoBreaks { revision: u64, what: Bilingual },

    /// Nothing is left to undo or redo.
    NothingToUndo { what: Bilingual },

    /// sled failed, or panicked.
    Tables { what: Bilingual },

    /// A backup or snapshot whose bytes are not what was written.
    BadFile { path: String, what: Bilingual },
}

impl StoreError {
    /// What was asked for is at fault, not the disk, the store's own files or the program.
    #[must_use]
    pub fn is_input(&self) -> bool {
        match self {
            Self::Io { source, .. } => is_input(source.kind()),
            Self::ReadOnly { by_choice, .. } => *by_choice,
            Self::JournalCorrupt { .. }
            | Self::CutShort { .. }
            | Self::BothCorrupt { .. }
            | Self::BadRecord { .. }
            | Self::Tables { .. } => false,
            _ => true,
        }
    }

    pub(crate) fn io(
        what: doing::Words,
        path: &Path,
    ) -> impl FnOnce(std::io::Error) -> Self + use<> {
        let path: PathBuf = path.to_owned();
        move |source| Self::Io { what: what.into(), path: path.display().to_string(), source }
    }
}

/// The work of this folder succeeds or says why not.
pub(crate) type Result<T> = std::result::Result<T, StoreError>;
