//! Forgetting: old versions are dropped when a person asks for it, never by themselves (D3).
//!
//! What any revision from the given one on can see is kept, and so is the list of revisions. Ids of what is
//! forgotten are still never given again.

use std::sync::Arc;

use super::edits::{Change, Draft};
use super::error::{Result, StoreError};
use super::frame::Op;
use super::keep::Store;
use super::reader::{FORGOTTEN, replica_index};
use super::tables::{self as t, Table};
use super::trees::{CHANGES, HISTORY, REPLICAS, Records};
use super::vault::Change as Write;
use super::version::{Stamp, Version};

/// What forgetting came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Forgotten {
    /// Versions of records dropped.
    pub versions: u64,
    /// Why the files of the store still hold them: no snapshot could be written. The next one will be without them.
    pub not_freed: Option<String>,
}

impl Store {
    /// Drops what only revisions before `revision` can see, and writes a new snapshot without it. What is dropped
    /// is dropped though no snapshot could be written.
    ///
    /// Readers of an older revision that are still in use may then miss records.
    ///
    /// # Errors
    /// [`StoreError::UnknownRevision`], [`StoreError::ReadOnly`], [`StoreError::Io`].
    pub fn forget_before(&mut self, revision: u64, change: &Change) -> Result<Forgotten> {
        // Fails for a revision that is not there or is forgotten already.
        let reader = self.reader_at(revision)?;
        let first = u32::try_from(revision).map_err(|_too_large| StoreError::UnknownRevision {
            wanted: revision,
            last: self.revision(),
        })?;
        let mut draft = Draft::default();
        let remove = |draft: &mut Draft, tree: u8, key: &[u8], old: &[u8]| {
            let op = Op { tree, key: key.to_vec(), value: None };
            draft.writes.push(Write { op, old: Some(old.to_vec()) });
        };
        let trees = Arc::clone(self.vault.trees());
        let old = superseded(&*trees, revision)?;
        for (key, bytes) in &old {
            remove(&mut draft, HISTORY, key, bytes);
        }
        let mut dropped = old.len() as u64;
        for table in Table::ALL.iter().copied().filter(|t| t.is_map()) {
            trees.scan(table.code(), &[], &mut |key, bytes| {
                let version = Version::decode(table, key, bytes)?;
                if version.stamp.deleted && version.stamp.revision <= revision {
                    dropped += 1;
                    remove(&mut draft, table.code(), key, bytes);
                    if table == Table::AreaObjects {
                        remove(&mut draft, REPLICAS, &replica_index(key), &[]);
                    }
                }
                Ok(true)
            })?;
        }
        trees.scan(CHANGES, &[], &mut |key, bytes| {
            let of = key.first_chunk::<8>().map_or(u64::MAX, |n| u64::from_be_bytes(*n));
            if of <= revision {
                remove(&mut draft, CHANGES, key, bytes);
            }
            Ok(true)
        })?;
        let mark = t::LastIds { kind: FORGOTTEN.into(), last_id: first };
        let stamp = Stamp {
            revision: reader.revision(),
            at: change.at,
            user: change.user.clone(),
            deleted: false,
        };
        self.put_log(&mut draft, &mark, &stamp)?;
        self.vault.commit(draft.writes)?;
        // Runs are written anew without what is gone.
        let freed = self.vault.put_past(true).and_then(|()| self.checkpoint());
        let not_freed = freed.err().map(|why| why.to_string());
        Ok(Forgotten { versions: dropped, not_freed })
    }
}

/// The old versions after which another one was valid by that revision.
fn superseded(trees: &dyn Records, revision: u64) -> Result<Vec<(Vec<u8>, Vec<u8>)>> {
    let mut found = Vec::new();
    let mut before: Option<(Vec<u8>, Vec<u8>)> = None;
    trees.scan(HISTORY, &[], &mut |key, bytes| {
        if let Some(version) = before.take() {
            let next = if parts(&version.0).0 == parts(key).0 {
                parts(key).1
            } else {
                current_revision(trees, &version.0)?
            };
            found.extend((next <= revision).then_some(version));
        }
        before = Some((key.to_vec(), bytes.to_vec()));
        Ok(true)
    })?;
    if let Some(version) = before {
        let next = current_revision(trees, &version.0)?;
        found.extend((next <= revision).then_some(version));
    }
    Ok(found)
}

/// A key of the history: table and key of the record, and the version's revision.
fn parts(key: &[u8]) -> (&[u8], u64) {
    key.split_last_chunk::<8>().map_or((key, u64::MAX), |(k, at)| (k, u64::from_be_bytes(*at)))
}

/// The revision of the version that stands in the record's own table.
fn current_revision(trees: &dyn Records, history_key: &[u8]) -> Result<u64> {
    let Some((code, key)) = parts(history_key).0.split_first() else { return Ok(u64::MAX) };
    match (Table::from_code(*code), trees.get(*code, key)?) {
        (Some(table), Some(bytes)) => Ok(Version::decode(table, key, &bytes)?.stamp.revision),
        _ => Ok(u64::MAX),
    }
}
