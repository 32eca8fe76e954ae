//! The vault: journal, snapshots and trees as one thing that never loses what it acknowledged.
//!
//! A transaction is one frame of the journal, on the disk before it is acknowledged; then it is applied to the
//! records in memory, which readers read, and sled's trees follow (see `behind`). Truth is the newest whole snapshot
//! and the frames after it; the trees are an index of it, read and verified as a whole at each opening, which brings
//! the two together. How far they must reach is known from a third place (see `head`): a journal that ends earlier is
//! broken, though every frame in it be whole.
//!
//! | journal | trees | what is done |
//! |---|---|---|
//! | whole | whole | the frames that the trees lack are applied; a torn tail is cut off |
//! | whole | broken, or not as their digests say | set aside, built anew from snapshot and journal |
//! | whole | cannot be set aside or built anew | left alone; the store works without them |
//! | broken | whole and not behind it | a new snapshot and a new journal are written from the trees |
//! | broken | broken | refused, both named |
//!
//! All of this is said of what is young; what is past lies in runs beside it, which transactions name (see `past`).
//!
//! What cannot be mended, on a full disk for one, leaves the store open for reading.
//!
//! **Invariant**: when [`Vault::commit`] returns `Ok`, the frame is on the disk; after it returned an error
//! from the journal, nothing more is written until the store is opened again. The trees decide nothing: whatever
//! they do, a store whose snapshot and journal are whole opens and takes what it is given.

mod runs;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::behind::Behind;
use super::disk::Disk;
use super::error::{Result, StoreError};
use super::frame::{Digest, Digests, Op, encode_frame};
use super::head::{Head, Known, Mark, read_head};
use super::journal::{
    Journal, Log, begin_journal, journal_dir, numbered, numbered_files, snapshot_dir,
    snapshot_files,
};
use super::memory::MemoryTrees;
use super::past::{Layered, Past, is_past};
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
    /// Why a store that is only read was read from the tables: what the journal lacks, an opening for writing mends.
    pub read_from_tables: Option<String>,
    /// Why the tables are not kept this time; journal and snapshots have everything.
    pub tables_off: Option<String>,
    /// Which of the small files `FORMAT` and `head` were lost or broken, and are written anew.
    pub marks_renewed: Vec<&'static str>,
    /// A file of the past that was lost or broken, and was written anew from its twin.
    pub past_mended: Option<String>,
    /// Why nothing can be written though the store was opened for writing.
    pub not_writable: Option<String>,
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
    trees: Arc<dyn Trees>,
    past: Arc<Past>,
    /// Files of runs that are not in use any more, each with the transaction since when: older snapshots may need them.
    retired: Vec<(u64, u64)>,
    /// sled, following memory; none in a store that is only read.
    behind: Option<Behind>,
    state: State,
    journal: Option<Journal>,
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
    reason: String,
    /// It was opened so.
    by_choice: bool,
}

impl ReadOnly {
    fn because(reason: String) -> Self {
        Self { reason, by_choice: false }
    }

    fn error(&self) -> StoreError {
        StoreError::ReadOnly { reason: self.reason.clone(), by_choice: self.by_choice }
    }
}

/// Records brought to the end of the journal.
struct Brought {
    memory: MemoryTrees,
    state: State,
    /// Keys that the frames touched.
    touched: Vec<(u8, Vec<u8>)>,
    frames: u64,
}

/// What was read of a store's own files.
struct Files<'f> {
    disk: &'f dyn Disk,
    dir: &'f Path,
    known: &'f Known,
    log: &'f Log,
    /// Whether there were trees before this opening.
    had_trees: bool,
}

/// What an opening for writing goes on with.
struct Recovered {
    memory: Arc<MemoryTrees>,
    /// The trees that are to follow, or why none do.
    trees: std::result::Result<Arc<dyn Trees>, String>,
    /// Keys in which they differ from memory.
    dirty: Vec<(u8, Vec<u8>)>,
    state: State,
}

/// Where the records come from.
struct Found {
    brought: Brought,
    /// The trees, when the records are theirs; else why they are those of snapshot and journal.
    trees: Result<Arc<dyn Trees>>,
}

/// Applies the frames after the records' own state, and checks what comes out of it against the digests. `counted`
/// is what the records hold before, by their own bytes.
fn replay(files: &Files, memory: MemoryTrees, mut counted: Digests, last: u64) -> Result<Brought> {
    let log = files.log;
    let mut state = memory.state()?;
    let broken = |what: &str| StoreError::Tables { what: what.to_owned() };
    // At the transaction that was acknowledged last, the store must hold what it held then.
    let check = |state: &State| match files.known.mark() {
        Some(mark) if mark.lsn == state.lsn && *mark != Mark::of(state) => {
            Err(broken("записи не те, что были подтверждены"))
        }
        _ => Ok(()),
    };
    check(&state)?;
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
        // A frame that a killed program wrote but did not sync can be read now and yet vanish with the power:
        // what is built upon must be on the disk first.
        if let Some((_, path, _)) = log.files.last() {
            let synced = disk.appender(path).and_then(|mut file| file.sync());
            synced.map_err(StoreError::io("записать", path))?;
        }
        let files = Files { disk: &*disk, dir, known: &known, log: &log, had_trees };
        let mut report = OpenReport::default();
        let Recovered { memory, trees, dirty, state } = Self::recover(&files, shelf, &mut report)?;
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
            head,
            read_only: None,
            checkpoint_at: CHECKPOINT_BYTES,
            journal_bytes,
        };
        if let Err(error) = vault.resume_journal(&log, &mut report) {
            // What was acknowledged is here and can be read, though nothing can be added to it.
            report.not_writable = Some(error.to_string());
            vault.read_only = Some(ReadOnly::because(error.to_string()));
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
                Some(Self::find(&files, || Err(StoreError::Tables { what: "нет".to_owned() })))
            }
            false => None,
        };
        let brought = match by_files {
            Some(Ok(found)) => found.brought,
            not_told => {
                let Found { brought, trees } = Self::find(&files, || shelf.look())?;
                report.read_from_tables = match not_told {
                    Some(Err(StoreError::BothCorrupt { journal, .. })) => Some(journal),
                    Some(Err(other)) => Some(other.to_string()),
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
        let Found { brought, trees } = Self::find(&files, open)?;
        let journal_renewed = journal_fault(&*disk, dir, &log, brought.state.lsn)?;
        let mut report = OpenReport {
            torn_bytes: if journal_renewed.is_some() { 0 } else { log.torn },
            tables_rebuilt: trees.err().map(|why| why.to_string()),
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
            head: None,
            read_only: Some(ReadOnly {
                reason: "так его открыли".into(), by_choice: true
            }),
            checkpoint_at: u64::MAX,
            journal_bytes: 0,
        })
    }

    /// The records, and the trees that are to follow them.
    fn recover(files: &Files, shelf: &mut dyn Shelf, report: &mut OpenReport) -> Result<Recovered> {
        let Found { mut brought, trees } = Self::find(files, || shelf.open())?;
        let (trees, dirty) = match trees {
            Ok(trees) => (Ok(trees), std::mem::take(&mut brought.touched)),
            Err(why) => {
                let anew = shelf.set_aside().and_then(|()| shelf.open());
                report.tables_rebuilt = anew.is_ok().then(|| why.to_string());
                (anew, brought.memory.keys())
            }
        };
        let Brought { memory, state, frames, .. } = brought;
        report.fill(&state, frames);
        let trees = trees.map_err(|why| why.to_string());
        Ok(Recovered { memory: Arc::new(memory), trees, dirty, state })
    }

    /// The records by the trees, or, when these do not hold, by snapshot and journal.
    fn find(files: &Files, open: impl FnOnce() -> Result<Arc<dyn Trees>>) -> Result<Found> {
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
            0 if was_emptied => Err(StoreError::Tables { what: "пусты".to_owned() }),
            _ => Ok(found),
        });
        match opened {
            Ok((trees, brought)) => Ok(Found { brought, trees: Ok(trees) }),
            Err(why)
                if newest_snapshot == 0
                    && (log.files.is_empty() || log.lost_head() || was_emptied) =>
            {
                Err(both_corrupt(dir, log, &why, &why))
            }
            Err(why) => {
                let brought = Self::from_files(files, &snapshots, last)
                    .map_err(|also| both_corrupt(dir, log, &also, &why))?;
                Ok(Found { brought, trees: Err(why) })
            }
        }
    }

    /// The records of the newest snapshot that is whole and from which the journal leads on.
    fn from_files(files: &Files, snapshots: &[(u64, PathBuf)], last: u64) -> Result<Brought> {
        let Files { disk, log, .. } = *files;
        let mut why = StoreError::Tables {
            what: "нет снимка, от которого ведёт журнал".to_owned(),
        };
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

    #[cfg(test)]
    pub(crate) fn lsn(&self) -> u64 {
        self.state.lsn
    }

    pub(crate) fn read_only(&self) -> Option<&str> {
        self.read_only.as_ref().map(|why| why.reason.as_str())
    }

    /// # Errors
    /// [`StoreError::ReadOnly`].
    pub(crate) fn check_writable(&self) -> Result<()> {
        self.read_only.as_ref().map_or(Ok(()), |why| Err(why.error()))
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
        self.checkpoint_if_due();
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
        if let Some(behind) = &self.behind {
            behind.apply(ops, &self.state)?;
        }
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
            self.read_only = Some(ReadOnly::because(format!("журнал не записывается ({error})")));
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
            self.read_only = Some(ReadOnly::because(error.to_string()));
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

fn cut_short(found: u64, known: u64) -> StoreError {
    StoreError::CutShort { found, known }
}

fn both_corrupt(dir: &Path, log: &Log, rebuild: &StoreError, trees: &StoreError) -> StoreError {
    let journal = log.fault.as_ref().unwrap_or(rebuild);
    StoreError::BothCorrupt {
        dir: dir.display().to_string(),
        journal: journal.to_string(),
        tables: trees.to_string(),
    }
}
