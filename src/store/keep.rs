//! [`Store`]: the map's records under lock, with their history.
//!
//! One writer: whoever holds the `Store`. Readers are values of their own ([`Reader`]) and may live in other threads.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use crate::map::{Replica, World};
use crate::units::{AreaId, Bilingual, Timestamp, said};

use super::cell::Key;
use super::changes::Changes;
use super::disk::{Disk, RealDisk};
use super::edits::{
    Change, Draft, Edits, ImportReport, Revision, RevisionKind, check_id, check_numbers,
    note_revision,
};
use super::error::{Result, StoreError, doing};
use super::ids::{self, Known};
use super::lock::{Lock, PATIENCE, lock};
use super::open::{Place, SledShelf, check_format, write_format};
use super::reader::{Reader, history_key, replica_index};
use super::sheet::Sheet;
use super::tables::{self as t, Record, Table, key_of_record};
use super::trees::{HISTORY, REPLICAS};
use super::vault::{OpenReport, Vault};
use super::version::{Stamp, Version, bad};

/// A store open for writing (or, with [`Store::open_read_only`], for reading).
pub struct Store {
    pub(super) vault: Vault,
    pub(super) dir: PathBuf,
    revision: u64,
    pub(super) lock: Option<Lock>,
}

impl std::fmt::Debug for Store {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Store")
            .field("dir", &self.dir)
            .field("revision", &self.revision)
            .finish_non_exhaustive()
    }
}

impl Store {
    /// Opens the store in a directory, or makes a new one there. It is this program's alone until it is closed, or
    /// [put down](Store::put_down).
    ///
    /// # Errors
    /// [`StoreError::Locked`] when another program has it, and keeps it for longer than a call takes;
    /// [`StoreError::UnknownFormat`] and [`StoreError::NotAStore`] when the directory is something else,
    /// [`StoreError::BothCorrupt`] when it is beyond repair; nothing is changed then.
    pub fn open(dir: impl AsRef<Path>) -> Result<(Self, OpenReport)> {
        Self::open_within(dir.as_ref(), PATIENCE)
    }

    /// Opens a store to be asked: what is to be mended is mended, and other programs may write. Where one does at this
    /// moment, the store is read as it stands.
    ///
    /// # Errors
    /// As [`Store::open`].
    pub fn open_to_ask(dir: impl AsRef<Path>) -> Result<(Self, OpenReport)> {
        match Self::open_within(dir.as_ref(), Duration::ZERO) {
            Err(StoreError::Locked { .. }) => Self::open_read_only(dir),
            opened => opened.map(|(mut store, report)| {
                store.put_down();
                (store, report)
            }),
        }
    }

    fn open_within(dir: &Path, patience: Duration) -> Result<(Self, OpenReport)> {
        let disk: Arc<dyn Disk> = Arc::new(RealDisk);
        let place = check_format(&*disk, dir)?;
        disk.create_dir(dir).map_err(StoreError::io(doing::MAKE_DIR, dir))?;
        let lock = lock(dir, patience)?;
        let mut marked = Ok(());
        if place != Place::Store {
            marked = write_format(&*disk, dir);
            let parent = dir.parent().filter(|p| !p.as_os_str().is_empty());
            let parent = parent.unwrap_or_else(|| Path::new("."));
            disk.sync_dir(parent).map_err(StoreError::io(doing::WRITE_DIR, parent))?;
        }
        // A store that is there is told by its other files as well.
        if place == Place::New {
            marked?;
        }
        let (vault, mut report) = Vault::open(disk, dir, &mut SledShelf::new(dir))?;
        if place == Place::Unmarked {
            report.marks_renewed.push("FORMAT");
        }
        Ok((Self::over(vault, dir, Some(lock))?, report))
    }

    /// Opens a store for reading, without touching it: another program may be writing it meanwhile.
    ///
    /// # Errors
    /// [`StoreError::Missing`] when there is none; else as [`Store::open`].
    pub fn open_read_only(dir: impl AsRef<Path>) -> Result<(Self, OpenReport)> {
        let dir = dir.as_ref();
        let disk: Arc<dyn Disk> = Arc::new(RealDisk);
        if check_format(&*disk, dir)? == Place::New {
            return Err(StoreError::Missing { dir: dir.display().to_string() });
        }
        let (vault, report) = Vault::open_read_only(disk, dir, &SledShelf::new(dir))?;
        Ok((Self::over(vault, dir, None)?, report))
    }

    pub(crate) fn over(vault: Vault, dir: &Path, lock: Option<Lock>) -> Result<Self> {
        let mut store = Self { vault, dir: dir.to_owned(), revision: 0, lock };
        store.count_revisions()?;
        Ok(store)
    }

    /// Finds out which revision is the last.
    pub(super) fn count_revisions(&mut self) -> Result<()> {
        let last = self.vault.trees().last(Table::Revisions.code(), &[], &[0xFF; 4])?;
        if let Some((key, _)) = last {
            let key = Key::from_bytes(&key);
            let record = self.reader().record::<t::Revisions>(&key)?;
            let record = record.ok_or_else(|| bad(Table::Revisions, key.as_bytes()))?;
            self.revision = u64::from(record.revision);
        }
        Ok(())
    }

    /// The number of the last change of the map; 0 before the first import.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The directory of the store.
    #[must_use]
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Why nothing can be written, if so.
    #[must_use]
    pub fn read_only(&self) -> Option<&Bilingual> {
        self.vault.read_only()
    }

    /// The store as it stands now, for reading.
    #[must_use]
    pub fn reader(&self) -> Reader {
        Reader::new(Arc::clone(self.vault.trees()), self.revision)
    }

    /// The store as it stood at a revision; 0 is the empty store.
    ///
    /// # Errors
    /// [`StoreError::UnknownRevision`] when there is none of that number yet, [`StoreError::ForgottenRevision`]
    /// when it was collected as garbage.
    pub fn reader_at(&self, revision: u64) -> Result<Reader> {
        self.reader().at(revision)
    }

    /// The map; none before the first import.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn world(&self) -> Result<Option<World>> {
        self.reader().world()
    }

    /// The map as it stood at a revision.
    ///
    /// # Errors
    /// As [`Store::reader_at`].
    pub fn world_as_of(&self, revision: u64) -> Result<Option<World>> {
        self.reader_at(revision)?.world()
    }

    /// The last revision made at or before a moment; 0 when there was none.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn revision_at(&self, moment: Timestamp) -> Result<u64> {
        self.reader().revision_at(moment)
    }

    /// A Fragment: the replicas that stand in an Area.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn fragment(&self, area: AreaId) -> Result<Vec<Replica>> {
        self.reader().fragment(area)
    }

    /// All versions of a record, the oldest first.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a version is broken.
    pub fn history(&self, table: Table, key: &Key) -> Result<Vec<Version>> {
        self.reader().history(table, key)
    }

    /// All revisions, the oldest first.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn revisions(&self) -> Result<Vec<Revision>> {
        self.reader().revisions()
    }

    /// Makes the map of the store equal to a world that was read from a file: one transaction, one revision.
    ///
    /// What bears a known name keeps its id, what is new gets the next one, what has vanished is marked as
    /// deleted. A world that says what the store says changes nothing.
    ///
    /// # Errors
    /// [`StoreError::DuplicateName`] and [`StoreError::Duplicate`] when the world is ambiguous;
    /// [`StoreError::Io`] when it could not be written. The store is then as before.
    pub fn import(&mut self, world: &World, change: &Change) -> Result<ImportReport> {
        let world = if self.revision == 0 {
            world.clone()
        } else {
            ids::renumbered(world, &mut self.known_ids()?)?
        };
        self.become_world(&world, change, RevisionKind::Import)
    }

    /// Makes the map of the store equal to a world that came from it and was edited: ids are the store's own.
    ///
    /// # Errors
    /// As [`Store::import`]; [`StoreError::IdReused`] when a new thing bears the id of an old one.
    pub fn commit(&mut self, world: &World, change: &Change) -> Result<ImportReport> {
        self.become_world(world, change, RevisionKind::Edit)
    }

    /// The same, where it is known what differs from the world that the store holds: what both worlds share is neither read
    /// nor compared.
    ///
    /// # Errors
    /// As [`Store::commit`].
    pub fn commit_changes(
        &mut self,
        changes: &Changes<'_>,
        change: &Change,
    ) -> Result<ImportReport> {
        for ((table, key), [was, _]) in &changes.rows {
            let held = self.reader().version(*table, key)?.filter(|v| !v.stamp.deleted);
            if held.as_ref().map(|v| &v.row) != was.as_ref() {
                // It holds another: all of it is compared.
                return self.commit(changes.worlds()[1], change);
            }
        }
        let news = changes.rows.iter().map(|(at, [_, is])| (at.clone(), is.clone()));
        let edits = Edits { rows: news.collect() };
        self.write(&edits, change, RevisionKind::Edit, None)
    }

    /// Makes the map of the store equal to records that came from elsewhere, a base of SQL tables for one.
    /// Their ids are kept.
    ///
    /// # Errors
    /// As [`Store::commit`]; [`StoreError::BadRecord`] or [`StoreError::BrokenReference`] when the records make
    /// no world.
    pub fn import_sheet(&mut self, sheet: &Sheet, change: &Change) -> Result<ImportReport> {
        if sheet.world()?.is_none() {
            let what = said!("the-records-hold-no-domain");
            return Err(StoreError::BrokenReference { table: Table::Domain.name(), what });
        }
        let edits = Edits::between(&self.reader().sheet()?, sheet);
        self.write(&edits, change, RevisionKind::Import, None)
    }

    fn become_world(
        &mut self,
        world: &World,
        change: &Change,
        kind: RevisionKind,
    ) -> Result<ImportReport> {
        let edits = Edits::between(&self.reader().sheet()?, &Sheet::of(world)?);
        self.write(&edits, change, kind, None)
    }

    /// Edits single records in one transaction.
    ///
    /// The records are taken as they are: whoever edits a map this way checks it (`map::check`) first.
    ///
    /// # Errors
    /// As [`Store::commit`]; [`StoreError::DerivedTable`] for a table that is computed.
    pub fn apply(&mut self, edits: &Edits, change: &Change) -> Result<ImportReport> {
        self.write(edits, change, RevisionKind::Edit, None)
    }

    /// The next free id of a table: ids are never given twice.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn next_id(&self, table: Table) -> Result<u32> {
        let last = self.reader().record::<t::LastIds>(&Key::new().text(table.name()))?;
        Ok(last.map_or(0, |l| l.last_id).saturating_add(1))
    }

    /// The names and ids of all that is or was in the map.
    fn known_ids(&self) -> Result<Known> {
        let mut known = Known::default();
        for table in ids::tables() {
            self.vault.trees().scan(table.code(), &[], &mut |key, bytes| {
                let version = Version::decode(table, key, bytes)?;
                known.add(table, &version.row, !version.stamp.deleted);
                Ok(true)
            })?;
        }
        for last in self.reader().records::<t::LastIds>(&Key::new())? {
            if let Some(table) = Table::named(&last.kind) {
                known.raise(table, last.last_id);
            }
        }
        Ok(known)
    }

    /// The one place where records of the map are written.
    pub(super) fn write(
        &mut self,
        edits: &Edits,
        change: &Change,
        kind: RevisionKind,
        undoes: Option<u64>,
    ) -> Result<ImportReport> {
        let revision = self.revision + 1;
        let stamp = |deleted| Stamp { revision, at: change.at, user: change.user.clone(), deleted };
        let stamps = [stamp(false), stamp(true)];
        let mut draft = Draft::default();
        for ((table, key), row) in &edits.rows {
            if !table.is_stored() {
                return Err(StoreError::DerivedTable { table: table.name() });
            }
            if let Some(row) = row {
                check_numbers(*table, row)?;
            }
            let old = self.vault.get(table.code(), key.as_bytes())?;
            let was =
                old.as_ref().map(|b| Version::decode(*table, key.as_bytes(), b)).transpose()?;
            let living = was.as_ref().filter(|v| !v.stamp.deleted);
            let counts = draft.by_table.entry(*table).or_default();
            let is_deletion = row.is_none();
            let row = match (living, row) {
                (None, None) => continue,
                (Some(v), Some(row)) if v.row == *row => continue,
                (None, Some(row)) => {
                    if let Some(v) = &was {
                        check_id(*table, v, row)?;
                    }
                    counts.created += 1;
                    row
                }
                (Some(v), None) => {
                    counts.deleted += 1;
                    &v.row
                }
                (Some(_), Some(row)) => {
                    counts.changed += 1;
                    row
                }
            };
            draft.raise_id(*table, row);
            let stamp = &stamps[usize::from(is_deletion)];
            let bytes = super::version::encode(*table, key.as_bytes(), stamp, row);
            if let (Some(old), Some(was)) = (&old, &was) {
                let key = history_key(*table, key.as_bytes(), was.stamp.revision);
                draft.put(HISTORY, key, old.clone(), None);
            }
            if *table == Table::AreaObjects && was.is_none() {
                draft.put(REPLICAS, replica_index(key.as_bytes()), Vec::new(), None);
            }
            draft.put(table.code(), key.as_bytes().to_vec(), bytes, old);
            draft.touched.push((*table, key.clone()));
        }
        let report = draft.report(revision);
        if report.counts.total() == 0 {
            return Ok(ImportReport { revision: self.revision, ..ImportReport::default() });
        }
        self.note_ids(&mut draft, &stamp(false))?;
        note_revision(&mut draft, &report, &stamp(false), change, kind, undoes);
        self.vault.commit(draft.writes)?;
        self.revision = revision;
        Ok(report)
    }

    fn note_ids(&self, draft: &mut Draft, stamp: &Stamp) -> Result<()> {
        for (table, id) in std::mem::take(&mut draft.last_ids) {
            if id >= self.next_id(table)? {
                let record = t::LastIds { kind: table.name().into(), last_id: id };
                self.put_log(draft, &record, stamp)?;
            }
        }
        Ok(())
    }

    /// Adds a record that is not of the map to a transaction.
    pub(super) fn put_log<T: Record>(
        &self,
        draft: &mut Draft,
        record: &T,
        stamp: &Stamp,
    ) -> Result<()> {
        let key = key_of_record(record);
        let old = self.vault.get(T::TABLE.code(), key.as_bytes())?;
        self.put_over(draft, record, old, stamp)
    }

    /// The same of a record that is known to be new.
    pub(super) fn put_new<T: Record>(
        &self,
        draft: &mut Draft,
        record: &T,
        stamp: &Stamp,
    ) -> Result<()> {
        self.put_over(draft, record, None, stamp)
    }

    fn put_over<T: Record>(
        &self,
        draft: &mut Draft,
        record: &T,
        old: Option<Vec<u8>>,
        stamp: &Stamp,
    ) -> Result<()> {
        let row = record.to_row();
        check_numbers(T::TABLE, &row)?;
        let key = key_of_record(record).as_bytes().to_vec();
        let bytes = Version { stamp: stamp.clone(), row }.encode(T::TABLE, &key);
        draft.put(T::TABLE.code(), key, bytes, old);
        Ok(())
    }
}
