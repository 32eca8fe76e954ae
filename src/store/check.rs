//! The deep check of a store, its backup and its restoration.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use super::derived::broken_derived;
use super::disk::{Disk, RealDisk};
use super::error::{Result, StoreError, doing};
use super::frame::{FILE_HEADER, format_stated};
use super::journal::{numbered, snapshot_dir, snapshot_files};
use super::keep::Store;
use super::lock::{PATIENCE, lock};
use super::open::{Place, SledShelf, check_format, write_format};
use super::past::Past;
use super::reader::replica_index;
use super::schema::key_of;
use super::snapshot::{check_snapshot, write_snapshot_of};
use super::tables::Table;
use super::trees::{HISTORY, REPLICAS, RUNS, Records, State, Trees, digests};
use super::vault::{Shelf, Vault};
use super::version::Version;
use crate::units::{Bilingual, Gather as _, Piece, said, word};

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Good to know.
    Note,
    /// The store mends it, at the next opening or snapshot, at the latest with `gc`; nothing is lost.
    Mendable,
    /// Something is lost, or wrong.
    Broken,
}

/// One thing that a check found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    pub severity: Severity,
    pub text: Bilingual,
}

/// What a deep check of a store found.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FsckReport {
    pub lsn: u64,
    pub revision: u64,
    /// Live records, deleted ones and old versions.
    pub records: u64,
    pub snapshots: usize,
    pub findings: Vec<Finding>,
}

impl FsckReport {
    /// Nothing needs mending.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.findings.iter().all(|f| f.severity == Severity::Note)
    }

    fn find(&mut self, severity: Severity, text: impl Into<Bilingual>) {
        self.findings.push(Finding { severity, text: text.into() });
    }
}

/// Checks every byte of a store: journal, snapshots, every record, the map that they make, and sled's trees
/// against them. Mends nothing; [`Store::open`] does.
///
/// # Errors
/// When there is no store, or it is of an unknown format. Whatever is broken within it is a finding.
pub fn fsck(dir: impl AsRef<Path>) -> Result<FsckReport> {
    let dir = dir.as_ref();
    let disk: Arc<dyn Disk> = Arc::new(RealDisk);
    let place = check_format(&*disk, dir)?;
    if place == Place::New {
        return Err(StoreError::Missing { dir: dir.display().to_string() });
    }
    let mut report = FsckReport::default();
    if place == Place::Unmarked {
        report.find(Severity::Mendable, word!("the-file-format-is-lost-or-broken"));
    }
    check_snapshots(&*disk, dir, &mut report)?;
    let lock = lock(dir, PATIENCE);
    let mut shelf = SledShelf::new(dir);
    let had_trees = shelf.exists();
    let looked = match &lock {
        Ok(_) => Vault::look(Arc::clone(&disk), dir, had_trees, || match had_trees {
            true => shelf.open(),
            false => Err(StoreError::Tables { what: said!("there-are-no-tables-of-sled") }),
        }),
        Err(why) => {
            report.find(Severity::Note, said!("tables-not-checked", why));
            Vault::open_read_only(Arc::clone(&disk), dir, &shelf)
        }
    };
    match looked {
        Err(error @ StoreError::UnknownFormat { .. }) => return Err(error),
        Err(error) => report.find(Severity::Broken, Bilingual::of(&error)),
        Ok((vault, opened)) => {
            report.lsn = opened.lsn;
            report.records = opened.records;
            if opened.torn_bytes > 0 {
                let bytes = opened.torn_bytes;
                let text = said!("the-journal-is-cut-off-bytes-of", bytes);
                report.find(Severity::Mendable, text);
            }
            let faults =
                [&opened.journal_renewed, &opened.tables_rebuilt, &opened.read_from_tables];
            for fault in faults.into_iter().flatten() {
                report.find(Severity::Mendable, fault.clone());
            }
            for name in &opened.marks_renewed {
                report.find(Severity::Mendable, said!("the-file-is-broken", name));
            }
            if lock.is_ok() && opened.replayed > 0 && opened.tables_rebuilt.is_none() {
                report.find(Severity::Note, word!("the-tables-of-sled-are-behind-the"));
            }
            check_past(vault.past(), &mut report);
            if let Err(error) = check_records(&**vault.trees(), &mut report) {
                report.find(Severity::Broken, Bilingual::of(&error));
            }
            check_map(Store::over(vault, dir, None), &mut report);
            for kind in broken_derived(&*disk, dir)? {
                let text = said!("what-was-derived-from-the-map-is", kind);
                report.find(Severity::Mendable, text);
            }
        }
    }
    Ok(report)
}

fn check_snapshots(disk: &dyn Disk, dir: &Path, report: &mut FsckReport) -> Result<()> {
    for (_, path) in snapshot_files(disk, dir)? {
        report.snapshots += 1;
        if let Err(error) = check_snapshot(disk, &path) {
            report.find(Severity::Mendable, Bilingual::of(&error));
        }
    }
    Ok(())
}

/// Both files of every run. What can be read in one of them, the next opening mends.
fn check_past(past: &Past, report: &mut FsckReport) {
    for run in past.runs().iter().map(|named| &named.run) {
        match run {
            Err(error) => report.find(Severity::Broken, Bilingual::of(error)),
            Ok(run) => {
                report.records += run.records;
                for error in run.check() {
                    report.find(Severity::Mendable, Bilingual::of(&error));
                }
            }
        }
    }
}

/// Every version of every record: checksum, cells, key.
fn check_records(trees: &dyn Records, report: &mut FsckReport) -> Result<()> {
    let mut astray = 0;
    let mut check = |table: Table, key: &[u8], bytes: &[u8]| {
        let fault = match Version::decode(table, key, bytes) {
            Err(error) => Bilingual::of(&error),
            Ok(version) => match key_of(table.columns(), &version.row) {
                Some(own) if own.as_bytes() == key && table.fits(&version.row) => return,
                _ => said!("table-a-record-does-not-stand-under", name = table.name()),
            },
        };
        report.find(Severity::Broken, fault);
    };
    for table in Table::ALL.iter().copied().filter(|t| t.is_stored()) {
        trees.scan(table.code(), &[], &mut |key, bytes| {
            check(table, key, bytes);
            if table == Table::AreaObjects && trees.get(REPLICAS, &replica_index(key))?.is_none() {
                astray += 1;
            }
            Ok(true)
        })?;
    }
    trees.scan(HISTORY, &[], &mut |key, bytes| {
        if let Some((table, key)) = key.split_first().and_then(|(code, rest)| {
            Some((Table::from_code(*code)?, rest.split_last_chunk::<8>()?.0))
        }) {
            check(table, key, bytes);
        }
        Ok(true)
    })?;
    if astray > 0 {
        report.find(Severity::Broken, said!("the-index-lacks-replicas", astray));
    }
    Ok(())
}

fn check_map(store: Result<Store>, report: &mut FsckReport) {
    let found = store.and_then(|store| {
        report.revision = store.revision();
        let numbers: BTreeSet<u64> = store.revisions()?.iter().map(|r| r.number).gather();
        if let (Some(first), Some(last)) = (numbers.first(), numbers.last())
            && last - first + 1 != numbers.len() as u64
        {
            report.find(Severity::Broken, word!("revisions-are-missing-in-the-list"));
        }
        store.world()
    });
    match found {
        Err(error) => report.find(Severity::Broken, Bilingual::of(&error)),
        Ok(None) => report.find(Severity::Note, word!("the-store-holds-no-map-yet")),
        // The store kept faithfully what it was given: such a fault is the map's, not the store's.
        Ok(Some(world)) => {
            for fault in crate::map::check(&world).iter().filter(|f| !f.is_warning()) {
                report.find(Severity::Note, said!("of-the-map", fault = fault.error));
            }
        }
    }
}

/// Bytes. A store is kept in memory, and its copy is read into memory.
const LARGEST_BACKUP: u64 = 4 << 30;

/// A backup says in its first bytes that it is one: what says something else is not read.
fn check_size(backup: &Path) -> Result<()> {
    let bad = |what: Piece| {
        Err(StoreError::BadFile { path: backup.display().to_string(), what: what.into() })
    };
    let about = std::fs::metadata(backup).map_err(StoreError::io(doing::READ, backup))?;
    if !about.is_file() {
        return bad(word!("it-is-no-file"));
    }
    if about.len() > LARGEST_BACKUP {
        return bad(word!("it-is-larger-than-4-gib"));
    }
    let mut head = Vec::new();
    File::open(backup)
        .and_then(|file| file.take(FILE_HEADER as u64).read_to_end(&mut head))
        .map_err(StoreError::io(doing::READ, backup))?;
    if format_stated(&head).is_some() {
        Ok(())
    } else {
        bad(word!("the-beginning-of-the-file-is-broken"))
    }
}

/// Writes all records, of the past too, as a snapshot of a store that has no runs.
fn write_backup(path: &Path, trees: &dyn Trees) -> Result<()> {
    let lsn = trees.state()?.lsn;
    let mut digests = digests(trees)?;
    digests.remove(&RUNS);
    write_snapshot_of(&RealDisk, path, trees, &State { lsn, digests }, |tree| tree != RUNS)?;
    Ok(())
}

/// Makes of a backup the least that is a store.
fn fill(backup: &Path, dir: &Path, lsn: u64) -> Result<()> {
    let snapshots = snapshot_dir(dir);
    RealDisk.create_dir(&snapshots).map_err(StoreError::io(doing::MAKE_DIR, &snapshots))?;
    let bytes = RealDisk.read(backup).map_err(StoreError::io(doing::READ, backup))?;
    let path = numbered(&snapshots, lsn, "snapshot");
    RealDisk.replace(&path, &[bytes]).map_err(StoreError::io(doing::WRITE, &path))?;
    // Last, so that a half-restored directory is no store.
    write_format(&RealDisk, dir)
}

impl Store {
    /// Writes the whole store, its history included, into one checksummed file.
    ///
    /// # Errors
    /// [`StoreError::Io`].
    pub fn backup(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        write_backup(path, &**self.vault.trees())?;
        // Whoever relies on a copy wants to know that it can be read.
        check_snapshot(&RealDisk, path).map(|_| ())
    }

    /// Makes a new store of a backup, in a directory that is empty or does not exist.
    ///
    /// # Errors
    /// [`StoreError::BadFile`] when the backup is broken; [`StoreError::NotEmpty`] when there is something in
    /// the directory: a store is never overwritten.
    pub fn restore(backup: impl AsRef<Path>, dir: impl AsRef<Path>) -> Result<Self> {
        let (backup, dir) = (backup.as_ref(), dir.as_ref());
        check_size(backup)?;
        let state = check_snapshot(&RealDisk, backup)?;
        let names = RealDisk.list(dir).map_err(StoreError::io(doing::LIST, dir))?;
        if !names.is_empty() {
            return Err(StoreError::NotEmpty { dir: dir.display().to_string() });
        }
        let was_there = dir.exists();
        fill(backup, dir, state.lsn).inspect_err(|_| {
            // Half a copy would only be in the way of the next attempt.
            for part in ["snapshots", "FORMAT", "FORMAT.new"].map(|name| dir.join(name)) {
                let _ = std::fs::remove_dir_all(&part).or_else(|_| std::fs::remove_file(&part));
            }
            if !was_there {
                let _ = std::fs::remove_dir(dir);
            }
        })?;
        let mut store = Self::open(dir)?.0;
        // What is past need not stay in memory; if this fails, the next snapshot sees to it.
        if let Err(error) = store.checkpoint() {
            tracing::warn!(%error, "the past stays in memory");
        }
        Ok(store)
    }

    /// Takes a snapshot now: the next opening has less to replay.
    ///
    /// # Errors
    /// [`StoreError::ReadOnly`], [`StoreError::Io`].
    pub fn checkpoint(&mut self) -> Result<()> {
        self.vault.checkpoint_with(&mut SledShelf::new(&self.dir))
    }
}
