//! Snapshots: all records of a store in one checksummed file, which is a backup too.
//!
//! ```text
//! snapshot := head, frames of records, a last frame without records that holds the digests
//! ```
//! Written aside, synced, renamed, and the folder synced: a snapshot is whole or not there.

use crate::units::{Piece, word};
use std::path::Path;

use super::disk::Disk;
use super::error::{Result, StoreError, doing};
use super::frame::{
    Digests, HeadError, Op, Payload, SNAPSHOT, Tail, encode_frame, file_header, scan,
};
use super::trees::{State, Trees, digests, tree_names};

/// Snapshots are written in frames of about this size.
const CHUNK_BYTES: usize = 1 << 20;

/// Puts a snapshot's records into empty trees.
pub(super) fn load_snapshot(disk: &dyn Disk, path: &Path, trees: &dyn Trees) -> Result<()> {
    let bad =
        |what: Piece| StoreError::BadFile { path: path.display().to_string(), what: what.into() };
    let bytes = disk.read(path).map_err(StoreError::io(doing::READ, path))?;
    let found = scan(&bytes, SNAPSHOT)
        .map_err(|_head: HeadError| bad(word!("the-beginning-of-the-file-is-broken")))?;
    let (Tail::Whole, Some((last, chunks))) = (&found.tail, found.frames.split_last()) else {
        return Err(bad(word!("the-file-is-broken-or-was-not")));
    };
    let payload = |(_, range): &(u64, std::ops::Range<usize>)| {
        Payload::decode(&bytes[range.clone()]).ok_or_else(|| bad(word!("a-frame-cannot-be-read")))
    };
    // The last frame holds the digests alone: without it the snapshot is not whole.
    let end = payload(last)?;
    if last.0 != found.lsn || !end.ops.is_empty() {
        return Err(bad(word!("the-file-was-not-written-to-its")));
    }
    for chunk in chunks {
        trees.apply(payload(chunk)?.ops, &State::default())?;
    }
    trees.apply(Vec::new(), &State { lsn: found.lsn, digests: end.digests })
}

/// Whether a snapshot file is whole, without putting it anywhere.
pub(super) fn check_snapshot(disk: &dyn Disk, path: &Path) -> Result<State> {
    let trees = super::memory::MemoryTrees::default();
    load_snapshot(disk, path, &trees)?;
    let state = trees.state()?;
    if digests(&trees)? == state.digests {
        Ok(state)
    } else {
        Err(StoreError::BadFile {
            path: path.display().to_string(),
            what: word!("the-records-do-not-match-their-checksum").into(),
        })
    }
}
/// Writes the records of some trees as a snapshot file; returns its size.
pub(super) fn write_snapshot(
    disk: &dyn Disk,
    path: &Path,
    trees: &dyn Trees,
    state: &State,
) -> Result<u64> {
    write_snapshot_of(disk, path, trees, state, |_| true)
}

/// The same of some trees only.
pub(super) fn write_snapshot_of(
    disk: &dyn Disk,
    path: &Path,
    trees: &dyn Trees,
    state: &State,
    is_wanted: impl Fn(u8) -> bool,
) -> Result<u64> {
    let mut chunks = vec![file_header(SNAPSHOT, state.lsn)];
    let (mut ops, mut size) = (Vec::new(), 0);
    for (tree, _) in tree_names().filter(|(tree, _)| is_wanted(*tree)) {
        trees.scan(tree, &[], &mut |key, value| {
            size += key.len() + value.len();
            ops.push(Op { tree, key: key.to_vec(), value: Some(value.to_vec()) });
            if size > CHUNK_BYTES {
                chunks.push(encode_frame(state.lsn, &ops, &Digests::new()));
                ops.clear();
                size = 0;
            }
            Ok(true)
        })?;
    }
    chunks.push(encode_frame(state.lsn, &ops, &Digests::new()));
    chunks.push(encode_frame(state.lsn, &[], &state.digests));
    let total = chunks.iter().map(|c| c.len() as u64).sum();
    disk.replace(path, &chunks).map_err(StoreError::io(doing::WRITE_SNAPSHOT, path))?;
    Ok(total)
}
