//! The vault: journal, snapshots and trees as one thing that never loses what it acknowledged.
//!
//! A transaction is one frame of the journal, on the disk before it is acknowledged; then it is applied to the
//! records in memory, which readers read, and sled's trees follow (see `behind`). Truth is the newest whole snapshot
//! and the frames after it; the trees are an index of it, read and verified as a whole at each opening, which brings
//! the two together:
//!
//! | journal | trees | what is done |
//! |---|---|---|
//! | whole | whole | the frames that the trees lack are applied; a torn tail is cut off |
//! | whole | broken, or not as their digests say | set aside, built anew from snapshot and journal |
//! | broken | whole and not behind it | a new snapshot and a new journal are written from the trees |
//! | broken | broken | refused, both named |
//!
//! **Invariant**: when [`Vault::commit`] returns `Ok`, the frame is on the disk; after it returned an error
//! from the journal, nothing more is written until the store is opened again.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::behind::Behind;
use super::disk::Disk;
use super::error::{Result, StoreError};
use super::frame::{Digest, Digests, Op, encode_frame};
use super::journal::{
    Journal, Log, begin_journal, journal_dir, numbered, numbered_files, snapshot_dir,
    snapshot_files,
};
use super::memory::MemoryTrees;
use super::snapshot::{load_snapshot, write_snapshot};
use super::trees::{State, Trees, digests};

/// What opening a store found and mended.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct OpenReport {
    /// Sequence number of the last transaction.
    pub lsn: u64,
    /// Records found whole, those of the history included.
    pub records: u64,
    /// Transactions that the tables lacked and that were taken from the journal.
    pub replayed: u64,
    /// Length of a write that was cut short, and so never acknowledged; it was cut off.
    pub torn_bytes: u64,
    /// Why the tables were built anew from snapshot and journal.
    pub tables_rebuilt: Option<String>,
    /// Why the journal was written anew from the tables.
    pub journal_renewed: Option<String>,
}

impl OpenReport {
    fn fill(&mut self, state: &State, frames: u64) {
        self.lsn = state.lsn;
        self.replayed = frames;
        self.records = state.digests.values().map(|d| d.records).sum();
    }
}

/// One record's change within a transaction, with what stood there before.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Change {
    pub(crate) op: Op,
    pub(crate) old: Option<Vec<u8>>,
}

/// Where the trees live.
pub(crate) trait Shelf: Send {
    fn open(&mut self) -> Result<Arc<dyn Trees>>;
    /// Whether a thread of their own brings them into step.
    fn has_thread(&self) -> bool {
        true
    }
    /// Whether there are trees already, whole or broken.
    fn exists(&self) -> bool;
    /// Puts broken trees away, so that [`Shelf::open`] then gives empty ones.
    fn set_aside(&mut self) -> Result<()>;
}
/// See the module.
pub(crate) struct Vault {
    disk: Arc<dyn Disk>,
    dir: PathBuf,
    /// The records in memory.
    trees: Arc<dyn Trees>,
    /// sled, following memory; none in a store that is only read.
    behind: Option<Behind>,
    state: State,
    journal: Option<Journal>,
    read_only: Option<String>,
    /// Journal length at which the next snapshot is taken.
    checkpoint_at: u64,
    /// Counted over all journal files that a rebuild would have to read.
    journal_bytes: u64,
}

/// A snapshot is taken when the journal outgrows this, or twice the last snapshot if that is more.
const CHECKPOINT_BYTES: u64 = 64 << 20;
const SNAPSHOTS_KEPT: usize = 3;

/// Records brought to the end of the journal.
struct Brought {
    memory: MemoryTrees,
    state: State,
    /// Keys that the frames touched.
    touched: Vec<(u8, Vec<u8>)>,
    frames: u64,
}

/// Where the records come from.
struct Found {
    brought: Brought,
    /// The trees, when the records are theirs; else why they are those of snapshot and journal.
    trees: Result<Arc<dyn Trees>>,
}

/// Applies the frames after the records' own state, and checks what comes out of it against the digests. `counted`
/// is what the records hold before, by their own bytes.
fn replay(log: &Log, memory: MemoryTrees, mut counted: Digests, last: u64) -> Result<Brought> {
    let mut state = memory.state()?;
    let broken = |what: &str| StoreError::Tables { what: what.to_owned() };
    if !log.reaches(state.lsn, last) {
        let empty = state.lsn == 0;
        return Err(broken(if empty {
            "таблиц нет"
        } else {
            "таблицы отстали от журнала"
        }));
    }
    let before = state.lsn;
    let mut touched = Vec::new();
    for lsn in before + 1..=last {
        let payload = log.payload(lsn).ok_or_else(|| broken("кадр журнала не читается"))?;
        state.advance(lsn, payload.digests);
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
        return Err(broken("записи не совпадают с контрольной суммой"));
    }
    Ok(Brought { memory, frames: state.lsn - before, state, touched })
}

impl Vault {
    /// Opens what is there, or makes it; see the module's table.
    pub(crate) fn open(
        disk: Arc<dyn Disk>,
        dir: &Path,
        shelf: &mut dyn Shelf,
    ) -> Result<(Self, OpenReport)> {
        for dir in [dir.to_owned(), journal_dir(dir), snapshot_dir(dir)] {
            disk.create_dir(&dir).map_err(StoreError::io("создать каталог", &dir))?;
        }
        disk.sync_dir(dir).map_err(StoreError::io("записать каталог", dir))?;
        let mut log = Log::read(&*disk, dir)?;
        let snapshots = snapshot_files(&*disk, dir)?;
        if log.files.is_empty() && snapshots.is_empty() && !shelf.exists() {
            // The journal comes first: trees without one are then always trees that have lost it.
            begin_journal(&*disk, dir, 1)?;
            log = Log::read(&*disk, dir)?;
        }
        // A frame that a killed program wrote but did not sync can be read now and yet vanish with the power:
        // what is built upon must be on the disk first.
        if let Some((_, path, _)) = log.files.last() {
            let synced = disk.appender(path).and_then(|mut file| file.sync());
            synced.map_err(StoreError::io("записать", path))?;
        }
        let (trees, behind, state, mut report) = Self::recover(&*disk, dir, &log, shelf)?;
        let journal_bytes = log.files.iter().map(|(_, _, bytes)| bytes.len() as u64).sum();
        let mut vault = Self {
            disk,
            dir: dir.to_owned(),
            trees,
            behind: Some(behind),
            state,
            journal: None,
            read_only: None,
            checkpoint_at: CHECKPOINT_BYTES,
            journal_bytes,
        };
        vault.resume_journal(&log, &mut report)?;
        Ok((vault, report))
    }

    /// Reads a store without touching it: snapshot and journal into memory.
    pub(crate) fn open_read_only(disk: Arc<dyn Disk>, dir: &Path) -> Result<(Self, OpenReport)> {
        let unopened = StoreError::Tables {
            what: "только для чтения не открываются".to_owned()
        };
        let (vault, report) = Self::look(disk, dir, || Err(unopened))?;
        // What an opening for writing would mend, this one does not.
        Ok((vault, OpenReport { tables_rebuilt: None, journal_renewed: None, ..report }))
    }

    /// What an opening for writing would find and mend; nothing is mended.
    pub(crate) fn look(
        disk: Arc<dyn Disk>,
        dir: &Path,
        open: impl FnOnce() -> Result<Arc<dyn Trees>>,
    ) -> Result<(Self, OpenReport)> {
        let log = Log::read(&*disk, dir)?;
        let Found { brought, trees } = Self::find(&*disk, dir, &log, open)?;
        let journal_renewed = journal_fault(&*disk, dir, &log, brought.state.lsn)?;
        let mut report = OpenReport {
            torn_bytes: if journal_renewed.is_some() { 0 } else { log.torn },
            tables_rebuilt: trees.err().map(|why| why.to_string()),
            journal_renewed,
            ..OpenReport::default()
        };
        report.fill(&brought.state, brought.frames);
        let vault = Self {
            disk,
            dir: dir.to_owned(),
            trees: Arc::new(brought.memory),
            behind: None,
            state: brought.state,
            journal: None,
            read_only: Some("так его открыли".into()),
            checkpoint_at: u64::MAX,
            journal_bytes: 0,
        };
        Ok((vault, report))
    }

    fn recover(
        disk: &dyn Disk,
        dir: &Path,
        log: &Log,
        shelf: &mut dyn Shelf,
    ) -> Result<(Arc<dyn Trees>, Behind, State, OpenReport)> {
        let mut report = OpenReport::default();
        let Found { mut brought, trees } = Self::find(disk, dir, log, || shelf.open())?;
        let (trees, dirty) = match trees {
            Ok(trees) => (trees, std::mem::take(&mut brought.touched)),
            Err(why) => {
                shelf.set_aside()?;
                report.tables_rebuilt = Some(why.to_string());
                (shelf.open()?, brought.memory.keys())
            }
        };
        let Brought { memory, state, frames, .. } = brought;
        report.fill(&state, frames);
        let memory = Arc::new(memory);
        let behind = Behind::new(Arc::clone(&memory), trees, dirty, shelf.has_thread())?;
        Ok((memory, behind, state, report))
    }

    /// The records by the trees, or, when these do not hold, by snapshot and journal.
    fn find(
        disk: &dyn Disk,
        dir: &Path,
        log: &Log,
        open: impl FnOnce() -> Result<Arc<dyn Trees>>,
    ) -> Result<Found> {
        let snapshots = snapshot_files(disk, dir)?;
        let newest_snapshot = snapshots.last().map_or(0, |(lsn, _)| *lsn);
        let last = log.last().max(newest_snapshot);
        let opened = open().and_then(|trees| {
            let seen = trees.state()?.lsn;
            let (memory, counted) = MemoryTrees::copy_of(&*trees)?;
            Ok((trees, replay(log, memory, counted, last.max(seen))?))
        });
        match opened {
            Ok((trees, brought)) => Ok(Found { brought, trees: Ok(trees) }),
            // With neither snapshot nor journal, empty trees would be a silent loss of everything.
            Err(why) if newest_snapshot == 0 && (log.files.is_empty() || log.lost_head()) => {
                Err(both_corrupt(dir, log, &why, &why))
            }
            Err(why) => {
                let brought = Self::from_files(disk, &snapshots, log, last)
                    .map_err(|also| both_corrupt(dir, log, &also, &why))?;
                Ok(Found { brought, trees: Err(why) })
            }
        }
    }

    /// The records of the newest snapshot that is whole and from which the journal leads on.
    fn from_files(
        disk: &dyn Disk,
        snapshots: &[(u64, PathBuf)],
        log: &Log,
        last: u64,
    ) -> Result<Brought> {
        let mut why = StoreError::Tables {
            what: "нет снимка, от которого ведёт журнал".to_owned(),
        };
        let empty = (0, PathBuf::new());
        for (lsn, path) in snapshots.iter().rev().chain([&empty]) {
            if !log.reaches(*lsn, last) {
                continue;
            }
            let memory = MemoryTrees::default();
            let loaded = if *lsn == 0 { Ok(()) } else { load_snapshot(disk, path, &memory) };
            let counted = loaded.and_then(|()| digests(&memory));
            match counted.and_then(|counted| replay(log, memory, counted, last)) {
                Ok(found) => return Ok(found),
                Err(error) => why = error,
            }
        }
        Err(why)
    }

    /// Goes on writing where the journal ends, or begins a new one where it cannot be trusted.
    fn resume_journal(&mut self, log: &Log, report: &mut OpenReport) -> Result<()> {
        report.journal_renewed = journal_fault(&*self.disk, &self.dir, log, self.state.lsn)?;
        if report.journal_renewed.is_some() {
            return self.renew_journal(log);
        }
        report.torn_bytes = log.torn;
        let Some((_, path, bytes)) = log.files.last() else { return self.begin_journal() };
        if log.end == 0 {
            self.remove(path)?;
            return self.begin_journal();
        }
        let mut file = self.disk.appender(path).map_err(StoreError::io("открыть", path))?;
        if log.end < bytes.len() as u64 {
            file.cut(log.end).map_err(StoreError::io("укоротить", path))?;
        }
        self.journal = Some(Journal { file, path: path.clone(), length: log.end });
        Ok(())
    }

    /// Writes a snapshot of the trees, a journal after it, and puts the broken one aside.
    fn renew_journal(&mut self, log: &Log) -> Result<()> {
        self.write_snapshot()?;
        let aside = self.dir.join("aside");
        self.disk.create_dir(&aside).map_err(StoreError::io("создать каталог", &aside))?;
        for (first, path, _) in &log.files {
            let to = numbered(&aside, *first, "journal");
            self.disk.rename(path, &to).map_err(StoreError::io("переименовать", path))?;
        }
        let dir = journal_dir(&self.dir);
        self.disk.sync_dir(&dir).map_err(StoreError::io("записать каталог", &dir))?;
        self.begin_journal()
    }

    fn remove(&self, path: &Path) -> Result<()> {
        self.disk.remove(path).map_err(StoreError::io("удалить", path))
    }

    fn begin_journal(&mut self) -> Result<()> {
        self.journal = Some(begin_journal(&*self.disk, &self.dir, self.state.lsn + 1)?);
        Ok(())
    }

    pub(crate) fn trees(&self) -> &Arc<dyn Trees> {
        &self.trees
    }

    /// Brings sled into step now.
    #[cfg(test)]
    pub(crate) fn catch_up(&self) -> Result<()> {
        self.behind.as_ref().map_or(Ok(()), Behind::catch_up)
    }

    /// A record as it stands; does not ask a tree that is empty.
    pub(crate) fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>> {
        if self.state.digests.contains_key(&tree) { self.trees.get(tree, key) } else { Ok(None) }
    }

    pub(crate) fn disk(&self) -> &dyn Disk {
        &*self.disk
    }

    #[cfg(test)]
    pub(crate) fn lsn(&self) -> u64 {
        self.state.lsn
    }

    pub(crate) fn read_only(&self) -> Option<&str> {
        self.read_only.as_deref()
    }

    /// One transaction: on the disk when this returns.
    pub(crate) fn commit(&mut self, changes: Vec<Change>) -> Result<()> {
        if let Some(reason) = &self.read_only {
            return Err(StoreError::ReadOnly { reason: reason.clone() });
        }
        if let Some(reason) = self.behind.as_ref().and_then(Behind::failure) {
            // Nothing is lost: the journal has it all. But what cannot follow should not fall farther behind.
            self.read_only = Some(reason.clone());
            return Err(StoreError::ReadOnly { reason });
        }
        let touched = self.digests_after(&changes);
        let ops: Vec<Op> = changes.into_iter().map(|c| c.op).collect();
        let lsn = self.state.lsn + 1;
        let frame = encode_frame(lsn, &ops, &touched);
        self.append(&frame)?;
        self.state.advance(lsn, touched);
        if let Some(behind) = &self.behind {
            behind.apply(ops, &self.state)?;
        }
        self.checkpoint_if_due();
        Ok(())
    }

    fn digests_after(&self, changes: &[Change]) -> Digests {
        let mut touched = Digests::new();
        for Change { op, old } in changes {
            let before = self.state.digests.get(&op.tree).copied().unwrap_or_default();
            let digest = touched.entry(op.tree).or_insert(before);
            if let Some(old) = old {
                digest.remove(&op.key, old);
            }
            if let Some(new) = &op.value {
                digest.add(&op.key, new);
            }
        }
        touched
    }

    fn append(&mut self, frame: &[u8]) -> Result<()> {
        let journal = self.journal.as_mut().expect("a store open for writing has its journal");
        let written = journal.file.append(frame).and_then(|()| journal.file.sync());
        if let Err(error) = written {
            // After a failed sync nobody knows what the disk holds. Whatever of the frame is there goes, if it
            // can; and nothing is written after it.
            let _ = journal.file.cut(journal.length);
            self.read_only = Some(format!("журнал не записывается ({error})"));
            return Err(StoreError::io("записать", &journal.path)(error));
        }
        journal.length += frame.len() as u64;
        self.journal_bytes += frame.len() as u64;
        Ok(())
    }

    fn checkpoint_if_due(&mut self) {
        if self.journal_bytes < self.checkpoint_at {
            return;
        }
        if let Err(error) = self.checkpoint() {
            // Nothing is lost: the old journal goes on. Tried again when it has grown once more.
            tracing::warn!(%error, "снимок хранилища не удался");
            self.checkpoint_at = self.journal_bytes * 2;
        }
    }

    /// Takes a snapshot, begins a new journal, and drops what three snapshots no longer need.
    pub(crate) fn checkpoint(&mut self) -> Result<()> {
        if let Some(reason) = &self.read_only {
            return Err(StoreError::ReadOnly { reason: reason.clone() });
        }
        // What a snapshot makes superfluous in the journal, sled must not miss.
        if let Some(behind) = &self.behind {
            behind.flush()?;
        }
        let size = self.write_snapshot()?;
        let empty = self.journal.as_ref().is_some_and(|j| {
            j.path == numbered(&journal_dir(&self.dir), self.state.lsn + 1, "journal")
        });
        if !empty && let Err(error) = self.begin_journal() {
            // Two journals that both go on from here would not be told apart.
            self.read_only = Some(error.to_string());
            return Err(error);
        }
        self.drop_old_files()?;
        self.journal_bytes = 0;
        self.checkpoint_at = CHECKPOINT_BYTES.max(2 * size);
        Ok(())
    }

    fn write_snapshot(&self) -> Result<u64> {
        let path = numbered(&snapshot_dir(&self.dir), self.state.lsn, "snapshot");
        write_snapshot(&*self.disk, &path, &*self.trees, &self.state)
    }

    fn drop_old_files(&self) -> Result<()> {
        let snapshots = snapshot_files(&*self.disk, &self.dir)?;
        let Some(dropped) = snapshots.len().checked_sub(SNAPSHOTS_KEPT) else { return Ok(()) };
        for (_, path) in &snapshots[..dropped] {
            self.remove(path)?;
        }
        let oldest = snapshots[dropped].0;
        let journals = numbered_files(&*self.disk, &journal_dir(&self.dir), "journal")?;
        for pair in journals.windows(2) {
            // All frames of a file lie before the first of the next one.
            if pair[1].0 <= oldest + 1 {
                self.remove(&pair[0].1)?;
            }
        }
        Ok(())
    }
}

/// Why a journal does not lead to a state, if so.
fn journal_fault(disk: &dyn Disk, dir: &Path, log: &Log, lsn: u64) -> Result<Option<String>> {
    let snapshots = snapshot_files(disk, dir)?;
    let newest = snapshots.last().map_or(0, |(lsn, _)| *lsn);
    let mut chained = snapshots.iter().map(|(lsn, _)| *lsn).chain([0]);
    Ok(if let Some(fault) = &log.fault {
        Some(fault.to_string())
    } else if lsn > log.last().max(newest) {
        Some("в журнале нет последних кадров".into())
    } else if !chained.any(|first| log.reaches(first, lsn)) {
        Some("нет снимка, от которого ведёт журнал".into())
    } else {
        None
    })
}

fn both_corrupt(dir: &Path, log: &Log, rebuild: &StoreError, trees: &StoreError) -> StoreError {
    let journal = log.fault.as_ref().unwrap_or(rebuild);
    StoreError::BothCorrupt {
        dir: dir.display().to_string(),
        journal: journal.to_string(),
        tables: trees.to_string(),
    }
}
