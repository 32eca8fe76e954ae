//! The vault: journal, snapshots and trees as one thing that never loses what it acknowledged.
//!
//! A transaction is one frame of the journal, on the disk before it is acknowledged; then it is applied to the
//! records in memory, which readers read, and sled's trees follow (see `behind`). Truth is the newest whole snapshot
//! and the frames after it; the trees are an index of it, read and verified as a whole at each opening, which brings
//! the two together. How far they must reach is known from a third place (see `head`): a journal that ends earlier is
//! broken, though every frame in it be whole. What is done where one of them is not whole stands in `recover`.
//!
//! All of this is said of what is young; what is past lies in runs beside it, which transactions name (see `past`).
//!
//! What cannot be mended, on a full disk for one, leaves the store open for reading.
//!
//! **Invariant**: when [`Vault::commit`] returns `Ok`, the frame is on the disk; after it returned an error
//! from the journal, nothing more is written until the store is opened again. The trees decide nothing: whatever
//! they do, a store whose snapshot and journal are whole opens and takes what it is given.

mod recover;
mod runs;
mod share;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::behind::Behind;
use super::disk::Disk;
use super::error::{Result, StoreError, doing};
use super::frame::{Digests, Op, encode_frame};
use super::head::{Head, Known, Mark, read_head};
use super::journal::{
    Journal, Log, begin_journal, journal_dir, keep_journal, numbered, numbered_files, snapshot_dir,
    snapshot_files,
};
use super::lock::is_driven;
use super::memory::MemoryTrees;
use super::past::{Layered, Past, is_past};
use super::snapshot::write_snapshot;

use super::trees::{Records, State, Trees};
use crate::units::{Bilingual, said};

pub(crate) use share::Found as Meanwhile;

use recover::{Brought, Files, Found, Recovered, find, journal_fault, recover};
use share::Left;

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
    pub tables_rebuilt: Option<Bilingual>,
    /// Why the journal was written anew from the tables.
    pub journal_renewed: Option<Bilingual>,
    /// Why a store that is only read was read from the tables: what the journal lacks, an opening for writing mends.
    pub read_from_tables: Option<Bilingual>,
    /// Why the tables are not kept this time; journal and snapshots have everything.
    pub tables_off: Option<Bilingual>,
    /// Which of the small files `FORMAT` and `head` were lost or broken, and are written anew.
    pub marks_renewed: Vec<&'static str>,
    /// A file of the past that was lost or broken, and was written anew from its twin.
    pub past_mended: Option<Bilingual>,
    /// Why nothing can be written though the store was opened for writing.
    pub not_writable: Option<Bilingual>,
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
    /// Opens the trees without touching them, for one who only reads.
    fn look(&self) -> Result<Arc<dyn Trees>>;
}

/// See the module.
pub(crate) struct Vault {
    disk: Arc<dyn Disk>,
    dir: PathBuf,
    /// The young records, in memory.
    memory: Arc<MemoryTrees>,
    /// The same with the past behind them, which readers read.
    trees: Arc<dyn Records>,
    past: Arc<Past>,
    /// Files of runs that are not in use any more, each with the transaction since when: older snapshots may need them.
    retired: Vec<(u64, u64)>,
    /// sled, following memory; none in a store that is only read, or that was put down: see `share`.
    behind: Option<Behind>,
    state: State,
    journal: Option<Journal>,
    /// Where it ended, while other programs may write.
    left: Option<Left>,
    /// None in a store that is only read, or where the file cannot be written.
    head: Option<Head>,
    read_only: Option<ReadOnly>,
    /// Journal length at which the next snapshot is taken.
    checkpoint_at: u64,
    /// Counted over all journal files that a rebuild would have to read.
    journal_bytes: u64,
}

/// A snapshot is taken when the journal outgrows this, or the last snapshot if that is more.
const CHECKPOINT_BYTES: u64 = 16 << 20;
const SNAPSHOTS_KEPT: usize = 3;

/// Why a store takes nothing.
#[derive(Debug, Clone)]
struct ReadOnly {
    reason: Bilingual,
    /// It was opened so.
    by_choice: bool,
}

impl ReadOnly {
    fn because(reason: Bilingual) -> Self {
        Self { reason, by_choice: false }
    }

    fn error(&self) -> StoreError {
        StoreError::ReadOnly { reason: self.reason.clone(), by_choice: self.by_choice }
    }
}

impl Vault {
    /// Opens what is there, or makes it; see the module's table.
    pub(crate) fn open(
        disk: Arc<dyn Disk>,
        dir: &Path,
        shelf: &mut dyn Shelf,
    ) -> Result<(Self, OpenReport)> {
        for dir in [dir.to_owned(), journal_dir(dir), snapshot_dir(dir)] {
            disk.create_dir(&dir).map_err(StoreError::io(doing::MAKE_DIR, &dir))?;
        }
        disk.sync_dir(dir).map_err(StoreError::io(doing::WRITE_DIR, dir))?;
        let known = read_head(&*disk, dir)?;
        let mut log = Log::read(&*disk, dir)?;
        let snapshots = snapshot_files(&*disk, dir)?;
        let had_trees = shelf.exists();
        let was_there = had_trees || known == Known::Broken || known.lsn() > 0;
        if log.files.is_empty() && snapshots.is_empty() && !was_there {
            // The journal comes first: trees without one are then always trees that have lost it.
            begin_journal(&*disk, dir, 1)?;
            log = Log::read(&*disk, dir)?;
        }
        if let Some((_, path, _)) = log.files.last() {
            keep_journal(&*disk, path)?;
        }
        let files = Files { disk: &*disk, dir, known: &known, log: &log, had_trees };
        let mut report = OpenReport::default();
        let Recovered { memory, trees, dirty, state } = recover(&files, shelf, &mut report)?;
        // Without it the store works as well, and is only not told twice how far it must reach.
        let head = Head::open(&*disk, dir, &known, &Mark::of(&state));
        let head = head.inspect_err(|error| tracing::warn!(%error, "head is not written")).ok();
        if known == Known::Broken {
            report.marks_renewed.push("head");
        }
        report.tables_off = trees.as_ref().err().cloned();
        let threaded = shelf.has_thread();
        let behind = Behind::new(Arc::clone(&memory), trees, head.clone(), dirty, threaded)?;
        let past = Arc::new(Past::open(&*disk, dir, &*memory)?);
        let layered = Layered { young: Arc::clone(&memory), past: Arc::clone(&past) };
        let journal_bytes = log.files.iter().map(|(_, _, bytes)| bytes.len() as u64).sum();
        let mut vault = Self {
            disk,
            dir: dir.to_owned(),
            memory,
            trees: Arc::new(layered),
            past,
            retired: Vec::new(),
            behind: Some(behind),
            state,
            journal: None,
            left: None,
            head,
            read_only: None,
            checkpoint_at: CHECKPOINT_BYTES,
            journal_bytes,
        };
        if let Err(error) = vault.resume_journal(&log, &mut report) {
            // What was acknowledged is here and can be read, though nothing can be added to it.
            report.not_writable = Some(Bilingual::of(&error));
            vault.read_only = Some(ReadOnly::because(Bilingual::of(&error)));
        }
        vault.care_for_runs(&mut report);
        Ok((vault, report))
    }

    /// Reads a store without touching it: snapshot and journal into memory; where these are not whole, the trees.
    pub(crate) fn open_read_only(
        disk: Arc<dyn Disk>,
        dir: &Path,
        shelf: &dyn Shelf,
    ) -> Result<(Self, OpenReport)> {
        let known = read_head(&*disk, dir)?;
        let log = Log::read(&*disk, dir)?;
        let had_trees = shelf.exists();
        let files = Files { disk: &*disk, dir, known: &known, log: &log, had_trees };
        let mut report = OpenReport::default();
        // Where `head` tells how far the journal must reach, the trees need not be asked; else they are who knows.
        let by_files = match known.mark().is_some() || !had_trees {
            true => {
                Some(find(&files, || Err(StoreError::Tables { what: said!("there-are-none") })))
            }
            false => None,
        };
        let brought = match by_files {
            Some(Ok(found)) => found.brought,
            not_told => {
                let Found { brought, trees } = find(&files, || shelf.look())?;
                report.read_from_tables = match not_told {
                    Some(Err(StoreError::BothCorrupt { journal, .. })) => Some(*journal),
                    Some(Err(other)) => Some(Bilingual::of(&other)),
                    _ if trees.is_ok() => journal_fault(&*disk, dir, &log, brought.state.lsn)?,
                    _ => None,
                };
                brought
            }
        };
        if report.read_from_tables.is_none() && log.fault.is_none() {
            report.torn_bytes = log.torn;
        }
        report.fill(&brought.state, brought.frames);
        Ok((Self::only_read(disk, dir, brought)?, report))
    }

    /// What an opening for writing would find and mend; nothing is mended.
    pub(crate) fn look(
        disk: Arc<dyn Disk>,
        dir: &Path,
        had_trees: bool,
        open: impl FnOnce() -> Result<Arc<dyn Trees>>,
    ) -> Result<(Self, OpenReport)> {
        let known = read_head(&*disk, dir)?;
        let log = Log::read(&*disk, dir)?;
        let files = Files { disk: &*disk, dir, known: &known, log: &log, had_trees };
        let Found { brought, trees } = find(&files, open)?;
        let journal_renewed = journal_fault(&*disk, dir, &log, brought.state.lsn)?;
        let mut report = OpenReport {
            torn_bytes: if journal_renewed.is_some() { 0 } else { log.torn },
            tables_rebuilt: trees.err().map(|why| Bilingual::of(&why)),
            journal_renewed,
            ..OpenReport::default()
        };
        if known == Known::Broken {
            report.marks_renewed.push("head");
        }
        report.fill(&brought.state, brought.frames);
        Ok((Self::only_read(disk, dir, brought)?, report))
    }

    fn only_read(disk: Arc<dyn Disk>, dir: &Path, brought: Brought) -> Result<Self> {
        let memory = Arc::new(brought.memory);
        let past = Arc::new(Past::open(&*disk, dir, &*memory)?);
        let layered = Layered { young: Arc::clone(&memory), past: Arc::clone(&past) };
        Ok(Self {
            disk,
            dir: dir.to_owned(),
            memory,
            trees: Arc::new(layered),
            past,
            retired: Vec::new(),
            behind: None,
            state: brought.state,
            journal: None,
            left: None,
            head: None,
            read_only: Some(ReadOnly { reason: said!("so-it-was-opened"), by_choice: true }),
            checkpoint_at: u64::MAX,
            journal_bytes: 0,
        })
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
        let mut file = self.disk.appender(path).map_err(StoreError::io(doing::OPEN, path))?;
        if log.end < bytes.len() as u64 {
            file.cut(log.end).map_err(StoreError::io(doing::CUT, path))?;
        }
        self.journal = Some(Journal { file, path: path.clone(), length: log.end });
        Ok(())
    }

    /// Writes a snapshot of the trees, a journal after it, and puts the broken one aside.
    fn renew_journal(&mut self, log: &Log) -> Result<()> {
        self.write_snapshot()?;
        let aside = self.dir.join("aside");
        self.disk.create_dir(&aside).map_err(StoreError::io(doing::MAKE_DIR, &aside))?;
        for (first, path, _) in &log.files {
            let to = numbered(&aside, *first, "journal");
            self.disk.rename(path, &to).map_err(StoreError::io(doing::RENAME, path))?;
        }
        let dir = journal_dir(&self.dir);
        self.disk.sync_dir(&dir).map_err(StoreError::io(doing::WRITE_DIR, &dir))?;
        self.begin_journal()
    }

    fn remove(&self, path: &Path) -> Result<()> {
        self.disk.remove(path).map_err(StoreError::io(doing::REMOVE, path))
    }

    fn begin_journal(&mut self) -> Result<()> {
        self.journal = Some(begin_journal(&*self.disk, &self.dir, self.state.lsn + 1)?);
        Ok(())
    }

    pub(crate) fn trees(&self) -> &Arc<dyn Records> {
        &self.trees
    }

    /// Brings sled into step now.
    #[cfg(test)]
    pub(crate) fn catch_up(&self) -> Result<()> {
        self.behind.as_ref().map_or(Ok(()), Behind::catch_up)
    }

    /// The young records alone.
    #[cfg(test)]
    pub(crate) fn memory(&self) -> &Arc<MemoryTrees> {
        &self.memory
    }

    pub(crate) fn past(&self) -> &Arc<Past> {
        &self.past
    }

    /// A record as it stands; does not ask a tree that is empty.
    pub(crate) fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>> {
        let asked = is_past(tree) || self.state.digests.contains_key(&tree);
        if asked { self.trees.get(tree, key) } else { Ok(None) }
    }

    pub(crate) fn disk(&self) -> Arc<dyn Disk> {
        Arc::clone(&self.disk)
    }

    pub(crate) fn lsn(&self) -> u64 {
        self.state.lsn
    }

    pub(crate) fn read_only(&self) -> Option<&Bilingual> {
        self.read_only.as_ref().map(|why| &why.reason)
    }

    /// # Errors
    /// [`StoreError::ReadOnly`]; [`StoreError::Locked`] while others may write.
    pub(crate) fn check_writable(&self) -> Result<()> {
        match &self.read_only {
            Some(why) => Err(why.error()),
            None if self.is_put_down() => Err(StoreError::Locked {
                dir: self.dir.display().to_string(),
                drives: is_driven(&self.dir),
            }),
            None => Ok(()),
        }
    }

    /// One transaction: on the disk when this returns.
    pub(crate) fn commit(&mut self, mut changes: Vec<Change>) -> Result<()> {
        self.check_writable()?;
        let has_runs = !self.past.runs().is_empty();
        for change in changes.iter_mut().filter(|change| is_past(change.op.tree)) {
            // What is counted is young; what is gone from the past is said to be gone.
            change.old = self.memory.get(change.op.tree, &change.op.key)?;
            if change.op.value.is_none() && has_runs {
                change.op.value = Some(Vec::new());
            }
        }
        self.write(changes)?;
        // Where sled is closed, that is done when the vault is put down.
        if self.behind.is_some() {
            self.checkpoint_if_due();
        }
        Ok(())
    }

    /// A transaction of young records.
    fn write(&mut self, changes: Vec<Change>) -> Result<()> {
        let touched = self.digests_after(&changes);
        let ops: Vec<Op> = changes.into_iter().map(|c| c.op).collect();
        let lsn = self.state.lsn + 1;
        let frame = encode_frame(lsn, &ops, &touched);
        self.append(&frame)?;
        self.state.advance(lsn, touched);
        // After the frame, so that it never says more than the journal has; see `head`.
        if let Some(Err(error)) = self.head.as_ref().map(|head| head.note(&Mark::of(&self.state))) {
            tracing::warn!(%error, "head is not written");
        }
        match &self.behind {
            Some(behind) => behind.apply(ops, &self.state),
            None => self.memory.apply(ops, &self.state),
        }
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
            self.read_only =
                Some(ReadOnly::because(said!("journal-unwritable", reason = error.to_string())));
            return Err(StoreError::io(doing::WRITE, &journal.path)(error));
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
            tracing::warn!(%error, "a snapshot of the store failed");
            self.checkpoint_at = self.journal_bytes * 2;
        }
    }

    /// Takes a snapshot, begins a new journal, and drops what three snapshots no longer need.
    pub(crate) fn checkpoint(&mut self) -> Result<()> {
        self.check_writable()?;
        // That the past stays where it is costs memory; without a snapshot the journal would grow for ever.
        if let Err(error) = self.put_past(false) {
            tracing::warn!(%error, "the past stays as it is");
            self.check_writable()?;
        }
        self.mend_runs();
        // What a snapshot makes superfluous in the journal, sled should not miss; if it does, it is built anew.
        if let Some(Err(error)) = self.behind.as_ref().map(Behind::flush) {
            tracing::warn!(%error, "sled misses what goes into a snapshot");
        }
        let size = self.write_snapshot()?;
        let empty = self.journal.as_ref().is_some_and(|j| {
            j.path == numbered(&journal_dir(&self.dir), self.state.lsn + 1, "journal")
        });
        if !empty && let Err(error) = self.begin_journal() {
            // Two journals that both go on from here would not be told apart.
            self.read_only = Some(ReadOnly::because(Bilingual::of(&error)));
            return Err(error);
        }
        self.drop_old_files()?;
        self.journal_bytes = 0;
        self.checkpoint_at = CHECKPOINT_BYTES.max(size);
        Ok(())
    }

    fn write_snapshot(&self) -> Result<u64> {
        let path = numbered(&snapshot_dir(&self.dir), self.state.lsn, "snapshot");
        write_snapshot(&*self.disk, &path, &*self.memory, &self.state)
    }

    fn drop_old_files(&mut self) -> Result<()> {
        let snapshots = snapshot_files(&*self.disk, &self.dir)?;
        let Some(dropped) = snapshots.len().checked_sub(SNAPSHOTS_KEPT) else { return Ok(()) };
        for (_, path) in &snapshots[..dropped] {
            self.remove(path)?;
        }
        let oldest = snapshots[dropped].0;
        self.drop_old_runs(oldest)?;
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

impl Drop for Vault {
    fn drop(&mut self) {
        // The journal is on the disk; the mark beside it should be too.
        if let Some(Err(error)) = self.head.as_ref().map(Head::sync) {
            tracing::debug!(%error, "head is not on the disk yet");
        }
    }
}
