//! What is written: edits, who makes them, what they did, and the list of revisions.

use std::collections::BTreeMap;

use super::cell::{Cell, Key, Row};
use super::error::{Result, StoreError};
use super::frame::Op;
use super::ids;
use super::sheet::{Sheet, describe_key};
use super::tables::{self as t, Record, Table, key_of_record, key_of_row};
use super::touched::encode_touched;
use super::trees::CHANGES;
use super::vault::Change as Write;
use super::version::{Stamp, Version};
use crate::units::Timestamp;

/// Who changes the map, when and why. The clock is the caller's.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    pub user: String,
    pub at: Timestamp,
    pub reason: String,
}

impl Change {
    #[must_use]
    pub fn new(user: impl Into<String>, at: Timestamp, reason: impl Into<String>) -> Self {
        Self { user: user.into(), at, reason: reason.into() }
    }
}

/// How many records a transaction created, changed and deleted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    pub created: u32,
    pub changed: u32,
    pub deleted: u32,
}

impl Counts {
    #[must_use]
    pub fn total(&self) -> u32 {
        self.created + self.changed + self.deleted
    }
}

/// What a transaction did.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ImportReport {
    /// The revision that it made, or the old one when nothing changed.
    pub revision: u64,
    pub counts: Counts,
    /// The same by table; tables without a change are absent.
    pub by_table: BTreeMap<Table, Counts>,
}

/// Records to put and to remove in one transaction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Edits {
    pub(crate) rows: BTreeMap<(Table, Key), Option<Row>>,
}

impl Edits {
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Creates the record, or changes the one with its key.
    #[must_use]
    pub fn put<T: Record>(mut self, record: &T) -> Self {
        let row = record.to_row();
        self.rows.insert((T::TABLE, key_of_row::<T>(&row)), Some(row));
        self
    }

    /// Marks the record with this record's key as deleted; only its key fields count.
    #[must_use]
    pub fn remove<T: Record>(mut self, record: &T) -> Self {
        self.rows.insert((T::TABLE, key_of_record(record)), None);
        self
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// What turns one sheet into another.
    pub(crate) fn between(from: &Sheet, to: &Sheet) -> Self {
        let mut rows = BTreeMap::new();
        for (table, key, row) in to.iter() {
            if from.get(table, key) != Some(row) {
                rows.insert((table, key.clone()), Some(row.clone()));
            }
        }
        for (table, key, _) in from.iter() {
            if to.get(table, key).is_none() {
                rows.insert((table, key.clone()), None);
            }
        }
        Self { rows }
    }
}

/// Why a revision was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RevisionKind {
    Import,
    Edit,
    Undo,
    Redo,
}

impl RevisionKind {
    const ALL: [(Self, &'static str); 4] = [
        (Self::Import, "import"),
        (Self::Edit, "edit"),
        (Self::Undo, "undo"),
        (Self::Redo, "redo"),
    ];

    #[must_use]
    pub fn word(self) -> &'static str {
        Self::ALL.iter().find(|(kind, _)| *kind == self).map_or("edit", |(_, word)| word)
    }
}

/// One entry of the list of revisions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Revision {
    pub number: u64,
    pub at: Timestamp,
    pub user: String,
    pub reason: String,
    pub kind: RevisionKind,
    /// The revision that an undo took back, or that a redo brought again.
    pub undoes: Option<u64>,
    pub counts: Counts,
}

/// A transaction in the making.
#[derive(Default)]
pub(super) struct Draft {
    pub(super) writes: Vec<Write>,
    pub(super) touched: Vec<(Table, Key)>,
    pub(super) by_table: BTreeMap<Table, Counts>,
    pub(super) last_ids: BTreeMap<Table, u32>,
}

impl Draft {
    pub(super) fn put(&mut self, tree: u8, key: Vec<u8>, value: Vec<u8>, old: Option<Vec<u8>>) {
        self.writes.push(Write { op: Op { tree, key, value: Some(value) }, old });
    }

    pub(super) fn raise_id(&mut self, table: Table, row: &Row) {
        if let Some(id) = ids::id_of(table, row) {
            let last = self.last_ids.entry(table).or_default();
            *last = (*last).max(id);
        }
    }

    pub(super) fn report(&mut self, revision: u64) -> ImportReport {
        self.by_table.retain(|_, counts| counts.total() > 0);
        let mut counts = Counts::default();
        for c in self.by_table.values() {
            counts.created += c.created;
            counts.changed += c.changed;
            counts.deleted += c.deleted;
        }
        ImportReport { revision, counts, by_table: std::mem::take(&mut self.by_table) }
    }
}

/// What is not finite could be written, but not read.
pub(super) fn check_numbers(table: Table, row: &Row) -> Result<()> {
    for (column, cell) in table.columns().iter().zip(row) {
        if let Cell::Real(value) = cell
            && !value.is_finite()
        {
            let (key, column) = (describe_key(table, row), column.name);
            return Err(StoreError::NotFinite { table: table.name(), key, column, value: *value });
        }
    }
    Ok(())
}

/// A deleted record may come back as itself, but not as something else.
pub(super) fn check_id(table: Table, was: &Version, row: &Row) -> Result<()> {
    match (ids::identity(table, &was.row), ids::identity(table, row)) {
        (Some((id, was)), Some((_, is))) if was != is => {
            Err(StoreError::IdReused { table: table.name(), id, was, is })
        }
        _ => Ok(()),
    }
}

pub(super) fn note_revision(
    draft: &mut Draft,
    report: &ImportReport,
    stamp: &Stamp,
    change: &Change,
    kind: RevisionKind,
    undoes: Option<u64>,
) {
    let number = |n: u64| u32::try_from(n).expect("four thousand million revisions are not made");
    let record = t::Revisions {
        revision: number(report.revision),
        kind: kind.word().into(),
        reason: change.reason.clone(),
        undoes: undoes.map(number),
        created: report.counts.created,
        changed: report.counts.changed,
        deleted: report.counts.deleted,
    };
    let key = key_of_record(&record);
    let version = Version { stamp: stamp.clone(), row: record.to_row() };
    let bytes = version.encode(Table::Revisions, key.as_bytes());
    draft.put(Table::Revisions.code(), key.as_bytes().to_vec(), bytes, None);
    let pieces = encode_touched(draft.touched.iter());
    for (no, piece) in (0u32..).zip(pieces) {
        let mut key = report.revision.to_be_bytes().to_vec();
        key.extend(no.to_be_bytes());
        draft.put(CHANGES, key, piece, None);
    }
}

pub(super) fn revision(version: &Version) -> Result<Revision> {
    let bad = || StoreError::BadRecord {
        table: Table::Revisions.name(),
        key: describe_key(Table::Revisions, &version.row),
    };
    let r = <t::Revisions as Record>::from_row(&version.row).ok_or_else(bad)?;
    let kind = RevisionKind::ALL.iter().find(|(_, word)| *word == r.kind).ok_or_else(bad)?.0;
    Ok(Revision {
        number: u64::from(r.revision),
        at: version.stamp.at,
        user: version.stamp.user.clone(),
        reason: r.reason,
        kind,
        undoes: r.undoes.map(u64::from),
        counts: Counts { created: r.created, changed: r.changed, deleted: r.deleted },
    })
}
