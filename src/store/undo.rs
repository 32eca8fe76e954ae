//! Undo and redo: a revision that takes another one back, record by record.
//!
//! Nothing is rewound: undoing revision 7 makes revision 8, in which every record that 7 touched is again what
//! it was after 6. So the history stays whole, and an undo can be undone.

use super::cell::Key;
use super::edits::{Change, Edits, ImportReport, Revision, RevisionKind};
use super::error::{Result, StoreError};
use super::keep::Store;
use super::reader::Reader;
use super::sheet::describe_key;
use super::tables::Table;
use crate::units::{Bilingual, said};

impl Store {
    /// Takes back the last change that is not taken back yet.
    ///
    /// # Errors
    /// [`StoreError::NothingToUndo`]; else as [`Store::apply`].
    pub fn undo(&mut self, change: &Change) -> Result<ImportReport> {
        let target = undoable(&self.revisions()?).last().copied();
        let target = target.ok_or(StoreError::NothingToUndo { what: said!("undo") })?;
        self.revert(target, change, RevisionKind::Undo)
    }

    /// Brings back what the last undo took.
    ///
    /// # Errors
    /// [`StoreError::NothingToUndo`] when the last change is no undo; else as [`Store::apply`].
    pub fn redo(&mut self, change: &Change) -> Result<ImportReport> {
        let target = redoable(&self.revisions()?).last().copied();
        let target = target.ok_or(StoreError::NothingToUndo { what: said!("redo") })?;
        self.revert(target, change, RevisionKind::Redo)
    }

    /// Takes back one revision, wherever it stands, if nothing that it touched was changed since.
    ///
    /// # Errors
    /// [`StoreError::UndoConflict`] names the record and the later revision; [`StoreError::AlreadyUndone`];
    /// [`StoreError::UnknownRevision`].
    pub fn undo_revision(&mut self, revision: u64, change: &Change) -> Result<ImportReport> {
        if revision == 0 || revision > self.revision() {
            let last = self.revision();
            return Err(StoreError::UnknownRevision { wanted: revision, last });
        }
        if let Some(by) = undone_by(&self.revisions()?, revision) {
            return Err(StoreError::AlreadyUndone { revision, by });
        }
        self.revert(revision, change, RevisionKind::Undo)
    }

    /// Makes the map what it was at a revision.
    ///
    /// # Errors
    /// [`StoreError::UnknownRevision`]; else as [`Store::apply`].
    pub fn return_to(&mut self, revision: u64, change: &Change) -> Result<ImportReport> {
        let then = self.reader_at(revision)?.sheet()?;
        let edits = Edits::between(&self.reader().sheet()?, &then);
        self.write(&edits, change, RevisionKind::Edit, None)
    }

    fn revert(&mut self, target: u64, change: &Change, kind: RevisionKind) -> Result<ImportReport> {
        let (now, before) = (self.reader(), self.reader_at(target - 1)?);
        let mut edits = Edits::new();
        for (table, key) in now.touched(target)? {
            check_untouched_since(&now, target, table, &key)?;
            let old = before.version(table, &key)?.filter(|v| !v.stamp.deleted).map(|v| v.row);
            edits.rows.insert((table, key), old);
        }
        // Taking back the last change that stands gives a map that has been; any other may give one that has not.
        if kind == RevisionKind::Undo && undoable(&self.revisions()?).last() != Some(&target) {
            check_outcome(&now, target, &edits)?;
        }
        self.write(&edits, change, kind, Some(target))
    }
}

/// Whatever was built on what the revision made, in records of its own, must do without it.
fn check_outcome(now: &Reader, target: u64, edits: &Edits) -> Result<()> {
    let mut sheet = now.sheet()?;
    for ((table, key), row) in &edits.rows {
        match row {
            Some(row) => sheet.insert(*table, key.clone(), row.clone()),
            None => sheet.remove(*table, key),
        }
    }
    let fault = match sheet.world() {
        Ok(None) => None,
        Ok(Some(world)) => {
            // What was wrong before is not the undoing's fault.
            let known = now.world()?.map_or_else(Vec::new, |world| crate::map::check(&world));
            let is_news = |f: &crate::map::Fault| !known.iter().any(|k| k.error == f.error);
            let faults = crate::map::check(&world);
            faults.into_iter().find(|f| !f.is_warning() && is_news(f)).map(|f| Bilingual::of(&f))
        }
        Err(error) => Some(Bilingual::of(&error)),
    };
    fault.map_or(Ok(()), |what| Err(StoreError::UndoBreaks { revision: target, what }))
}

/// The record must still be as the revision left it, whichever later revision wrote it.
fn check_untouched_since(now: &Reader, target: u64, table: Table, key: &Key) -> Result<()> {
    let Some(current) = now.version(table, key)? else { return Ok(()) };
    let left = now.history(table, key)?.into_iter().find(|v| v.stamp.revision == target);
    let same = left.is_some_and(|left| {
        left.stamp.deleted == current.stamp.deleted
            && (left.row == current.row || current.stamp.deleted)
    });
    if same {
        return Ok(());
    }
    Err(StoreError::UndoConflict {
        revision: target,
        record: format!("{} ({})", table.name(), describe_key(table, &current.row)),
        by: current.stamp.revision,
    })
}

/// The revision that took this one back and was not taken back itself; a redo takes back the undo.
fn undone_by(revisions: &[Revision], number: u64) -> Option<u64> {
    let mut takers = revisions.iter().filter(|r| r.undoes == Some(number)).map(|r| r.number);
    takers.find(|taker| undone_by(revisions, *taker).is_none())
}

/// The changes that stand, the oldest first: an undo takes its target off, a redo puts it back on.
fn undoable(revisions: &[Revision]) -> Vec<u64> {
    let mut standing = Vec::new();
    for r in revisions {
        match (r.kind, r.undoes) {
            (RevisionKind::Undo, Some(target)) => standing.retain(|n| *n != target),
            (RevisionKind::Redo, Some(undo)) => {
                let brought = revisions.iter().find(|r| r.number == undo).and_then(|r| r.undoes);
                standing.extend(brought);
            }
            _ => standing.push(r.number),
        }
    }
    standing
}

/// The undos that can be taken back: those after the last change of another kind, and not redone yet.
fn redoable(revisions: &[Revision]) -> Vec<u64> {
    let mut undos = Vec::new();
    for r in revisions {
        match (r.kind, r.undoes) {
            (RevisionKind::Undo, _) => undos.push(r.number),
            (RevisionKind::Redo, Some(undo)) => undos.retain(|n| *n != undo),
            _ => undos.clear(),
        }
    }
    undos
}
