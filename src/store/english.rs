//! What can go wrong with a store, in English.

use super::error::StoreError;
use crate::units::{Bilingual, InEnglish, Language};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

impl InEnglish for StoreError {
    fn english(&self) -> String {
        match self {
            Self::Io { what, path, source } => {
                format!("the store: could not {} “{path}”: {source}", en(what))
            }
            Self::NotAStore { dir } => {
                format!("“{dir}” is no store: the directory has files, and no file FORMAT")
            }
            Self::NotEmpty { dir } => format!("the directory “{dir}” is not empty"),
            Self::Missing { dir } => format!("there is no store “{dir}”"),
            Self::UnknownFormat { dir, found, known } => format!(
                "the store “{dir}” is written in the format “{found}”, and this program knows format {known}"
            ),
            Self::Locked { dir, drives: true } => {
                format!("the store “{dir}” is taken: another program drives the robot")
            }
            Self::Locked { dir, drives: false } => {
                format!("another program has the store “{dir}” open")
            }
            Self::JournalCorrupt { path, offset } => format!(
                "the journal “{path}” is damaged: the frame at {offset} is broken, though whole ones follow"
            ),
            Self::CutShort { found, known } => {
                format!("the journal ends at transaction {found}, and {known} were confirmed")
            }
            Self::BothCorrupt { dir, journal, tables } => format!(
                "the store “{dir}” is damaged: the journal: {}; the tables: {}",
                en(journal),
                en(tables)
            ),
            Self::BadRecord { table, key } => format!("table {table}: the record {key} is broken"),
            Self::BrokenReference { table, what } => format!("table {table}: {}", en(what)),
            Self::Duplicate { table, key } => format!("table {table}: the key {key} stands twice"),
            Self::DuplicateName { table, name } => {
                format!("{table}: the name “{name}” stands twice")
            }
            Self::IdReused { table, id, was, is } => format!(
                "{table}: the number {id} belongs to the record “{was}”, and cannot go to “{is}”"
            ),
            Self::NotFinite { table, key, column, value } => {
                format!("table {table}, record {key}: the field {column} is no number, but {value}")
            }
            Self::UnknownReplica { id } => format!("the map has no replica of the number {id}"),
            Self::DerivedTable { table } => {
                format!("the table {table} is computed from others, and cannot be edited")
            }
            Self::ReadOnly { reason, .. } => {
                format!("the store is open for reading only: {}", en(reason))
            }
            Self::UnknownRevision { wanted, last } => {
                format!("there is no revision {wanted}: the last is {last}")
            }
            Self::ForgottenRevision { wanted, first } => format!(
                "the revision {wanted} is removed from the history already; the earliest is {first}"
            ),
            Self::UndoConflict { revision, record, by } => format!(
                "the revision {revision} cannot be undone: the record {record} was changed later, by revision {by}"
            ),
            Self::AlreadyUndone { revision, by } => {
                format!("the revision {revision} is undone already, by revision {by}")
            }
            Self::UndoBreaks { revision, what } => format!(
                "the revision {revision} cannot be undone: the map would become faulty: {}",
                en(what)
            ),
            Self::NothingToUndo { what } => format!("there is nothing to {}", en(what)),
            Self::Tables { what } => format!("the store’s tables: {}", en(what)),
            Self::BadFile { path, what } => {
                format!("“{path}” is a broken file, or another program’s: {}", en(what))
            }
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Io { .. } => "see that the directory can be written and the disk has room",
            Self::NotAStore { .. } => "name an empty directory, or a new one",
            Self::NotEmpty { .. } => "name a new directory: a store is not written over",
            Self::Missing { .. } => "make it by importing a map: ortho import MAP",
            Self::UnknownFormat { .. } => {
                "open it with the version of the program that wrote it, and export the map"
            }
            Self::Locked { .. } => {
                "wait until it is done, take another store, or open this one --read-only"
            }
            Self::JournalCorrupt { .. } | Self::CutShort { .. } => {
                "check the disk; restore the store from a backup: ortho restore"
            }
            Self::BothCorrupt { .. } => {
                "check the disk, and restore the store from a backup: ortho restore BACKUP"
            }
            Self::BadRecord { .. } | Self::Tables { .. } => {
                "close the store and open it again: the tables will be restored from the journal"
            }
            Self::BrokenReference { .. } => "check the store: ortho fsck",
            Self::Duplicate { .. } => "give the parts of the map different names",
            Self::DuplicateName { .. } => "give them different names",
            Self::IdReused { .. } => "take a new number: Store::next_id",
            Self::NotFinite { .. } => "correct the map: numbers must be finite",
            Self::UnknownReplica { .. } => "the replicas are listed by: ortho relations",
            Self::DerivedTable { .. } => "edit the tables that it comes from",
            Self::ReadOnly { .. } => "remove the cause, and open the store again",
            Self::UnknownRevision { .. } | Self::NothingToUndo { .. } => {
                "the revisions are listed by: ortho history"
            }
            Self::ForgottenRevision { .. } => "take a backup of that time",
            Self::UndoConflict { by, .. } => return Some(format!("first undo revision {by}")),
            Self::AlreadyUndone { by, .. } => {
                return Some(format!("it comes back by ortho redo, or ortho undo {by}"));
            }
            Self::UndoBreaks { .. } => "first undo the revisions that rest on it: ortho history",
            Self::BadFile { .. } => "take another backup",
        };
        Some(help.to_owned())
    }
}
