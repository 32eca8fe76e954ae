//! What is past, on the disk: read when it is asked for, checksum by checksum.
//!
//! Observations, old versions and the lists of what revisions touched are written once and hardly ever read again. They are
//! kept in memory, and by sled, from one snapshot to the next only; then they are written out as a run (see `run`), and a
//! transaction takes them from the trees and notes the run in a tree of its own. So journal, snapshots, sled and all that is
//! said of them in `vault` deal with what is young, and opening a store reads what is young and the index of each run.
//!
//! Eight runs of like size become one. The files of runs that no snapshot needs any more are removed.
//!
//! **Invariant**: a record that is taken from memory is in a run before that; who reads memory first and runs then misses none.

use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock};

use super::cell::{Bytes, put_varint};
use super::disk::Disk;
use super::error::{Result, StoreError};
use super::frame::Op;
use super::memory::MemoryTrees;
use super::run::{self, Cursor, Run};
use super::tables::Table;
use super::trees::{CHANGES, HISTORY, Pair, RUNS, Records, State, Trees, Visit};
use crate::units::{Bilingual, InOrder as _};

/// So many runs of like size are made one.
const MOST_ALIKE: usize = if cfg!(test) { 3 } else { 8 };

/// Whether the records of a tree become past.
pub(crate) fn is_past(tree: u8) -> bool {
    [HISTORY, CHANGES, Table::Observations.code()].contains(&tree)
}

pub(crate) fn past_dir(dir: &Path) -> PathBuf {
    dir.join("past")
}

/// Where a run stands among the others: later runs count before earlier ones.
type Place = u64;

/// What a tree says of a run: the number of its files.
pub(crate) fn describe(file: u64) -> Vec<u8> {
    let mut out = Vec::new();
    put_varint(&mut out, file);
    let crc = crc32fast::hash(&out);
    out.extend(crc.to_be_bytes());
    out
}

fn described(bytes: &[u8]) -> Option<u64> {
    let (body, crc) = bytes.split_last_chunk::<4>()?;
    (crc32fast::hash(body) == u32::from_be_bytes(*crc)).then(|| Bytes(body).varint())?
}

/// One run, or why it cannot be read.
type Opened = std::result::Result<Arc<Run>, StoreError>;

/// A run as the trees name it.
pub(crate) struct Named {
    pub(crate) place: Place,
    /// The number of its files, which are in use whether they can be read or not.
    file: u64,
    pub(crate) run: Opened,
}

impl Named {
    fn run(&self) -> Result<&Arc<Run>> {
        self.run.as_ref().map_err(told)
    }

    fn again(&self) -> Self {
        Self { place: self.place, file: self.file, run: self.run().map(Arc::clone) }
    }
}

/// The runs of a store, the oldest first.
pub(crate) struct Past {
    runs: RwLock<Arc<Vec<Named>>>,
}

impl Past {
    /// The runs that the trees name. One that cannot be opened is told of when it is asked.
    pub(crate) fn open(disk: &dyn Disk, dir: &Path, trees: &dyn Trees) -> Result<Self> {
        let dir = past_dir(dir);
        let mut runs = Vec::new();
        trees.scan(RUNS, &[], &mut |key, value| {
            let place = key.first_chunk::<8>().map(|n| u64::from_be_bytes(*n));
            let bad = || StoreError::BadRecord { table: "~runs", key: format!("{key:?}") };
            let (place, file) = place.zip(described(value)).ok_or_else(bad)?;
            let run = Run::open(disk, &dir, file).map(Arc::new);
            runs.push(Named { place, file, run });
            Ok(true)
        })?;
        Ok(Self { runs: RwLock::new(Arc::new(runs)) })
    }

    pub(crate) fn runs(&self) -> Arc<Vec<Named>> {
        Arc::clone(&self.runs.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Puts a run in the place of all from `first` to `place`.
    pub(crate) fn put(&self, first: Place, place: Place, run: Run) {
        let mut all = self.runs.write().unwrap_or_else(PoisonError::into_inner);
        let kept = all.iter().filter(|named| named.place < first || named.place > place);
        let mut runs: Vec<_> = kept.map(Named::again).collect();
        runs.push(Named { place, file: run.file, run: Ok(Arc::new(run)) });
        runs.order_by_key(|named| named.place);
        *all = Arc::new(runs);
    }

    /// Takes a run out that came to nothing.
    pub(crate) fn restore(&self, runs: Arc<Vec<Named>>) {
        *self.runs.write().unwrap_or_else(PoisonError::into_inner) = runs;
    }

    /// The numbers of the files that are in use.
    pub(crate) fn files(&self) -> Vec<u64> {
        self.runs().iter().map(|named| named.file).collect()
    }

    /// The runs that should be made one: the last ones, where there are many of like size. `all` takes every one.
    pub(crate) fn alike(&self, all: bool) -> Option<(Place, Place)> {
        let runs = self.runs();
        let sizes: Vec<(Place, u64)> = runs
            .iter()
            .map(|named| Ok((named.place, named.run.as_ref().map_err(drop)?.bytes)))
            .collect::<std::result::Result<_, ()>>()
            .ok()?;
        let (last, size) = *sizes.last()?;
        if all {
            return (!sizes.is_empty()).then(|| (sizes[0].0, last));
        }
        let mut alike = size;
        let mut count = 1;
        let mut first = last;
        for &(at, bytes) in sizes.iter().rev().skip(1) {
            if bytes > alike.saturating_mul(2) {
                break;
            }
            alike = alike.max(bytes);
            first = at;
            count += 1;
        }
        (count >= MOST_ALIKE).then_some((first, last))
    }
}

/// An error once more.
fn told(error: &StoreError) -> StoreError {
    match error {
        StoreError::BadFile { path, what } => {
            StoreError::BadFile { path: path.clone(), what: what.clone() }
        }
        other => StoreError::Tables { what: Bilingual::of(other) },
    }
}

fn full(tree: u8, key: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(key.len() + 1);
    out.push(tree);
    out.extend(key);
    out
}

/// The entries of some runs from a key on, each key once, as the latest of them has it; what is gone with an empty value.
pub(crate) fn merged(
    runs: &[Named],
    from: &[u8],
    young: Vec<Pair>,
    visit: &mut Visit<'_>,
) -> Result<()> {
    let mut cursors: Vec<Cursor> = runs
        .iter()
        .rev()
        .map(|named| Ok(named.run()?.entries_from(from)))
        .collect::<Result<_>>()?;
    let mut young = young.into_iter().peekable();
    loop {
        // The latest one that has the least key.
        let mut least: Option<Vec<u8>> = young.peek().map(|(key, _)| key.clone());
        for cursor in &mut cursors {
            if let Some((key, _)) = cursor.peek()?
                && least.as_ref().is_none_or(|least| key < least)
            {
                least = Some(key.clone());
            }
        }
        let Some(least) = least else { return Ok(()) };
        let mut value = young.next_if(|(key, _)| *key == least).map(|(_, value)| value);
        for cursor in &mut cursors {
            let Some((key, own)) = cursor.peek()? else { continue };
            if *key == least {
                if value.is_none() {
                    value = Some(own.clone());
                }
                cursor.step();
            }
        }
        if !visit(&least, &value.unwrap_or_default())? {
            return Ok(());
        }
    }
}

/// The records of a store: those in memory, and those of the past behind them.
pub(crate) struct Layered {
    pub(crate) young: Arc<MemoryTrees>,
    pub(crate) past: Arc<Past>,
}

impl Layered {
    /// The young records of a tree under a prefix, each with its full key.
    fn young(&self, tree: u8, prefix: &[u8]) -> Result<Vec<Pair>> {
        let mut found = Vec::new();
        self.young.scan(tree, prefix, &mut |key, value| {
            found.push((full(tree, key), value.to_vec()));
            Ok(true)
        })?;
        Ok(found)
    }
}

impl Records for Layered {
    fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>> {
        let young = self.young.get(tree, key)?;
        if !is_past(tree) {
            return Ok(young);
        }
        let mut found = young;
        if found.is_none() {
            let key = full(tree, key);
            for named in self.past.runs().iter().rev() {
                found = named.run()?.get(&key)?;
                if found.is_some() {
                    break;
                }
            }
        }
        Ok(found.filter(|value| !value.is_empty()))
    }

    fn last(&self, tree: u8, prefix: &[u8], limit: &[u8]) -> Result<Option<Pair>> {
        if !is_past(tree) {
            return self.young.last(tree, prefix, limit);
        }
        let young = self.young(tree, prefix)?;
        let runs = self.past.runs();
        let (least, mut most) = (full(tree, prefix), full(tree, limit));
        let mut within = true;
        loop {
            let is_in = |key: &Vec<u8>| if within { *key <= most } else { *key < most };
            let mut found = young.iter().rev().find(|(key, _)| is_in(key)).cloned();
            for named in runs.iter().rev() {
                if let Some(entry) = named.run()?.last(&most, within)?
                    && found.as_ref().is_none_or(|(key, _)| entry.0 > *key)
                {
                    found = Some(entry);
                }
            }
            let Some((key, value)) = found.filter(|(key, _)| *key >= least) else {
                return Ok(None);
            };
            if !value.is_empty() {
                return Ok(Some((key[1..].to_vec(), value)));
            }
            // It is gone: the one before it may be there.
            (most, within) = (key, false);
        }
    }
}

impl Trees for Layered {
    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()> {
        if !is_past(tree) {
            return self.young.scan(tree, prefix, visit);
        }
        let young = self.young(tree, prefix)?;
        let from = full(tree, prefix);
        merged(&self.past.runs(), &from, young, &mut |key, value| {
            if !key.starts_with(&from) {
                return Ok(false);
            }
            if value.is_empty() { Ok(true) } else { visit(&key[1..], value) }
        })
    }

    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()> {
        self.young.apply(ops, state)
    }

    fn state(&self) -> Result<State> {
        self.young.state()
    }

    fn flush(&self) -> Result<()> {
        Ok(())
    }
}

/// Writes the young records of the past as a run.
///
/// # Errors
/// [`StoreError::Io`].
pub(crate) fn write_young(disk: &dyn Disk, dir: &Path, file: u64, young: &[Pair]) -> Result<Run> {
    let dir = past_dir(dir);
    run::write(disk, &dir, file, &|put| young.iter().try_for_each(|(key, value)| put(key, value)))?;
    Run::open(disk, &dir, file)
}

/// Writes some runs as one; what is gone is left out where no older run could have it.
///
/// # Errors
/// [`StoreError::Io`], or a run cannot be read.
pub(crate) fn write_merged(
    disk: &dyn Disk,
    dir: &Path,
    file: u64,
    runs: &[Named],
    is_oldest: bool,
) -> Result<Run> {
    let dir = past_dir(dir);
    run::write(disk, &dir, file, &|put| {
        merged(runs, &[], Vec::new(), &mut |key, value| {
            if !(is_oldest && value.is_empty()) {
                put(key, value)?;
            }
            Ok(true)
        })
    })?;
    Run::open(disk, &dir, file)
}
