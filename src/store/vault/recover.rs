//! The records of a store, by its trees or by snapshot and journal.
//!
//! | journal | trees | what is done |
//! |---|---|---|
//! | whole | whole | the frames that the trees lack are applied; a torn tail is cut off |
//! | whole | broken, or not as their digests say | set aside, built anew from snapshot and journal |
//! | whole | cannot be set aside or built anew | left alone; the store works without them |
//! | broken | whole and not behind it | a new snapshot and a new journal are written from the trees |
//! | broken | broken | refused, both named |
//!

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::disk::Disk;
use super::super::error::{Result, StoreError};
use super::super::frame::{Digest, Digests};
use super::super::head::{Known, Mark};
use super::super::journal::{Log, snapshot_files};
use super::super::memory::MemoryTrees;
use super::super::snapshot::load_snapshot;
use super::super::trees::{Records, State, Trees, digests};
use super::{OpenReport, Shelf};
use crate::units::{Bilingual, Piece, said, word};

/// Records brought to the end of the journal.
pub(super) struct Brought {
    pub(super) memory: MemoryTrees,
    pub(super) state: State,
    /// Keys that the frames touched.
    pub(super) touched: Vec<(u8, Vec<u8>)>,
    pub(super) frames: u64,
}

/// What was read of a store's own files.
pub(super) struct Files<'f> {
    pub(super) disk: &'f dyn Disk,
    pub(super) dir: &'f Path,
    pub(super) known: &'f Known,
    pub(super) log: &'f Log,
    /// Whether there were trees before this opening.
    pub(super) had_trees: bool,
}

/// What an opening for writing goes on with.
pub(super) struct Recovered {
    pub(super) memory: Arc<MemoryTrees>,
    /// The trees that are to follow, or why none do.
    pub(super) trees: std::result::Result<Arc<dyn Trees>, Bilingual>,
    /// Keys in which they differ from memory.
    pub(super) dirty: Vec<(u8, Vec<u8>)>,
    pub(super) state: State,
}

/// Where the records come from.
pub(super) struct Found {
    pub(super) brought: Brought,
    /// The trees, when the records are theirs; else why they are those of snapshot and journal.
    pub(super) trees: Result<Arc<dyn Trees>>,
}

/// Applies the frames after the records' own state, and checks what comes out of it against the digests. `counted`
/// is what the records hold before, by their own bytes.
fn replay(files: &Files, memory: MemoryTrees, mut counted: Digests, last: u64) -> Result<Brought> {
    let log = files.log;
    let mut state = memory.state()?;
    let broken = |what: Piece| StoreError::Tables { what: what.into() };
    // At the transaction that was acknowledged last, the store must hold what it held then.
    let check = |state: &State| match files.known.mark() {
        Some(mark) if mark.lsn == state.lsn && *mark != Mark::of(state) => {
            Err(broken(word!("the-records-are-not-those-that-were")))
        }
        _ => Ok(()),
    };
    check(&state)?;
    if !log.reaches(state.lsn, last) {
        let empty = state.lsn == 0;
        return Err(broken(if empty {
            word!("there-are-no-tables")
        } else {
            word!("the-tables-are-behind-the-journal")
        }));
    }
    let before = state.lsn;
    let mut touched = Vec::new();
    for lsn in before + 1..=last {
        let payload =
            log.payload(lsn).ok_or_else(|| broken(word!("a-frame-of-the-journal-cannot-be")))?;
        state.advance(lsn, payload.digests);
        check(&state)?;
        for op in &payload.ops {
            let digest = counted.entry(op.tree).or_default();
            if let Some(old) = memory.get(op.tree, &op.key)? {
                digest.remove(&op.key, &old);
            }
            if let Some(new) = &op.value {
                digest.add(&op.key, new);
            }
            touched.push((op.tree, op.key.clone()));
        }
        memory.apply(payload.ops, &state)?;
    }
    counted.retain(|_, digest| *digest != Digest::default());
    if counted != state.digests {
        return Err(broken(word!("the-records-do-not-match-their-checksum")));
    }
    Ok(Brought { memory, frames: state.lsn - before, state, touched })
}

/// The records, and the trees that are to follow them.
pub(super) fn recover(
    files: &Files,
    shelf: &mut dyn Shelf,
    report: &mut OpenReport,
) -> Result<Recovered> {
    let Found { mut brought, trees } = find(files, || shelf.open())?;
    let (trees, dirty) = match trees {
        Ok(trees) => (Ok(trees), std::mem::take(&mut brought.touched)),
        Err(why) => {
            let anew = shelf.set_aside().and_then(|()| shelf.open());
            report.tables_rebuilt = anew.is_ok().then(|| Bilingual::of(&why));
            (anew, brought.memory.keys())
        }
    };
    let Brought { memory, state, frames, .. } = brought;
    report.fill(&state, frames);
    let trees = trees.map_err(|why| Bilingual::of(&why));
    Ok(Recovered { memory: Arc::new(memory), trees, dirty, state })
}

/// The records by the trees, or, when these do not hold, by snapshot and journal.
pub(super) fn find(files: &Files, open: impl FnOnce() -> Result<Arc<dyn Trees>>) -> Result<Found> {
    let Files { disk, dir, log, .. } = *files;
    let snapshots = snapshot_files(disk, dir)?;
    let newest_snapshot = snapshots.last().map_or(0, |(lsn, _)| *lsn);
    let last = log.last().max(newest_snapshot).max(files.known.lsn());
    let opened = open().and_then(|trees| {
        let seen = trees.state()?.lsn;
        let (memory, counted) = MemoryTrees::copy_of(&*trees)?;
        Ok((trees, replay(files, memory, counted, last.max(seen))?))
    });
    // With neither snapshot nor journal, empty trees would be a silent loss of everything. The head of the first
    // journal was on the disk before there were trees.
    let was_emptied = files.had_trees && log.is_headless() && newest_snapshot == 0;
    let opened = opened.and_then(|found| match found.1.state.lsn {
        // sled makes new trees of broken ones: that they are empty then says nothing.
        0 if was_emptied => Err(StoreError::Tables { what: said!("they-are-empty") }),
        _ => Ok(found),
    });
    match opened {
        Ok((trees, brought)) => Ok(Found { brought, trees: Ok(trees) }),
        Err(why)
            if newest_snapshot == 0 && (log.files.is_empty() || log.lost_head() || was_emptied) =>
        {
            Err(both_corrupt(dir, log, &why, &why))
        }
        Err(why) => {
            let brought = from_files(files, &snapshots, last)
                .map_err(|also| both_corrupt(dir, log, &also, &why))?;
            Ok(Found { brought, trees: Err(why) })
        }
    }
}

/// The records of the newest snapshot that is whole and from which the journal leads on.
fn from_files(files: &Files, snapshots: &[(u64, PathBuf)], last: u64) -> Result<Brought> {
    let Files { disk, log, .. } = *files;
    let mut why = StoreError::Tables { what: word!("there-is-no-snapshot-from-which-the").into() };
    let empty = (0, PathBuf::new());
    for (lsn, path) in snapshots.iter().rev().chain([&empty]) {
        if !log.reaches(*lsn, last) {
            if log.last() < files.known.lsn() {
                why = cut_short(log.last(), files.known.lsn());
            }
            continue;
        }
        let memory = MemoryTrees::default();
        let loaded = if *lsn == 0 { Ok(()) } else { load_snapshot(disk, path, &memory) };
        let counted = loaded.and_then(|()| digests(&memory));
        match counted.and_then(|counted| replay(files, memory, counted, last)) {
            Ok(found) => return Ok(found),
            Err(error) => why = error,
        }
    }
    Err(why)
}

/// Why a journal does not lead to a state, if so.
pub(super) fn journal_fault(
    disk: &dyn Disk,
    dir: &Path,
    log: &Log,
    lsn: u64,
) -> Result<Option<Bilingual>> {
    let snapshots = snapshot_files(disk, dir)?;
    let newest = snapshots.last().map_or(0, |(lsn, _)| *lsn);
    let mut chained = snapshots.iter().map(|(lsn, _)| *lsn).chain([0]);
    Ok(if let Some(fault) = &log.fault {
        Some(Bilingual::of(fault))
    } else if lsn > log.last().max(newest) {
        Some(said!("journal-lacks-frames"))
    } else if !chained.any(|first| log.reaches(first, lsn)) {
        Some(said!("no-snapshot-to-go-on-from"))
    } else {
        None
    })
}

fn cut_short(found: u64, known: u64) -> StoreError {
    StoreError::CutShort { found, known }
}

fn both_corrupt(dir: &Path, log: &Log, rebuild: &StoreError, trees: &StoreError) -> StoreError {
    let journal = log.fault.as_ref().unwrap_or(rebuild);
    StoreError::BothCorrupt {
        dir: dir.display().to_string(),
        journal: Box::new(Bilingual::of(journal)),
        tables: Box::new(Bilingual::of(trees)),
    }
}
