//! Reading a store at one revision, while others may write.
//!
//! A reader sees the map as it stood at its revision, whatever is committed meanwhile: a record that is newer
//! than that is looked up in the history, which the same transaction has filled.

use std::sync::Arc;

use crate::map::{Replica, World};
use crate::units::{AreaId, DomainId, InOrder as _, MapId, ReplicaId, Timestamp};

use super::cell::{Key, Row};
use super::edits::{Revision, revision};
use super::error::{Result, StoreError};
use super::sheet::{Sheet, describe_key};
use super::tables::{self as t, Record, Table};
use super::touched::decode_touched;
use super::trees::{CHANGES, HISTORY, REPLICAS, Records};
use super::version::{Version, VersionHead};

/// The store at one revision. Cheap to clone, and safe to use in another thread than the writer's.
#[derive(Clone)]
pub struct Reader {
    trees: Arc<dyn Records>,
    revision: u64,
}

impl std::fmt::Debug for Reader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Reader").field("revision", &self.revision).finish_non_exhaustive()
    }
}

/// Under this name the first revision that can still be read stands among the last ids.
pub(super) const FORGOTTEN: &str = "~forgotten";

/// `table key revision`: where the history keeps an old version.
pub(crate) fn history_key(table: Table, key: &[u8], revision: u64) -> Vec<u8> {
    let mut out = history_prefix(table, key);
    out.extend(revision.to_be_bytes());
    out
}

fn history_prefix(table: Table, key: &[u8]) -> Vec<u8> {
    let mut out = vec![table.code()];
    out.extend(key);
    out
}

impl Reader {
    pub(crate) fn new(trees: Arc<dyn Records>, revision: u64) -> Self {
        Self { trees, revision }
    }

    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The store as it stood at an earlier revision; 0 is the empty store.
    ///
    /// # Errors
    /// [`StoreError::UnknownRevision`] when there is none of that number yet, [`StoreError::ForgottenRevision`]
    /// when it was collected as garbage.
    pub fn at(&self, revision: u64) -> Result<Self> {
        if revision > self.revision {
            return Err(StoreError::UnknownRevision { wanted: revision, last: self.revision });
        }
        let first = self.first_revision()?;
        if revision < first {
            return Err(StoreError::ForgottenRevision { wanted: revision, first });
        }
        Ok(Self { trees: Arc::clone(&self.trees), revision })
    }

    /// The earliest revision that can be read; 0 when nothing was forgotten.
    fn first_revision(&self) -> Result<u64> {
        let mark = self.record::<t::LastIds>(&Key::new().text(FORGOTTEN))?;
        Ok(mark.map_or(0, |m| u64::from(m.last_id)))
    }

    /// All revisions up to this one, the oldest first.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn revisions(&self) -> Result<Vec<Revision>> {
        let found = self.versions(Table::Revisions, &Key::new())?;
        let all = found.into_iter().map(|(_, version)| revision(&version));
        all.filter(|r| r.as_ref().map_or(true, |r| r.number <= self.revision)).collect()
    }

    /// The last revision made at or before a moment; 0 when there was none.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn revision_at(&self, moment: Timestamp) -> Result<u64> {
        let before = self.revisions()?.into_iter().filter(|r| r.at <= moment);
        Ok(before.map(|r| r.number).max().unwrap_or(0))
    }

    /// The version of a record that was valid at this revision, the mark of its deletion included.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when the record is broken.
    pub fn version(&self, table: Table, key: &Key) -> Result<Option<Version>> {
        match self.trees.get(table.code(), key.as_bytes())? {
            Some(bytes) => self.valid(table, key.as_bytes(), &bytes),
            None => Ok(None),
        }
    }

    fn valid(&self, table: Table, key: &[u8], current: &[u8]) -> Result<Option<Version>> {
        let version = Version::decode(table, key, current)?;
        if version.stamp.revision <= self.revision || !table.is_map() {
            return Ok(Some(version));
        }
        let (from, to) = (history_prefix(table, key), history_key(table, key, self.revision));
        match self.trees.last(HISTORY, &from, &to)? {
            Some((_, bytes)) => Version::decode(table, key, &bytes).map(Some),
            None => Ok(None),
        }
    }

    /// The live versions whose keys begin with `prefix`, in the order of their keys.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn versions(&self, table: Table, prefix: &Key) -> Result<Vec<(Key, Version)>> {
        let mut found = Vec::new();
        self.trees.scan(table.code(), prefix.as_bytes(), &mut |key, bytes| {
            if let Some(version) = self.valid(table, key, bytes)?
                && !version.stamp.deleted
            {
                found.push((Key::from_bytes(key), version));
            }
            Ok(true)
        })?;
        Ok(found)
    }

    /// The live records of a type whose keys begin with `prefix`: [`Key::new`] gives all.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn records<T: Record>(&self, prefix: &Key) -> Result<Vec<T>> {
        let mut found = Vec::new();
        self.trees.scan(T::TABLE.code(), prefix.as_bytes(), &mut |key, bytes| {
            let head = VersionHead::decode(T::TABLE, key, bytes)?;
            // Most are as old as this reader; then who wrote them, and when, need not be read.
            let row = if head.revision <= self.revision || !T::TABLE.is_map() {
                if head.deleted { None } else { Some(head.row(T::TABLE, key)?) }
            } else {
                self.valid(T::TABLE, key, bytes)?.filter(|v| !v.stamp.deleted).map(|v| v.row)
            };
            if let Some(row) = row {
                found.push(record(&row)?);
            }
            Ok(true)
        })?;
        Ok(found)
    }

    /// One live record.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when it is broken.
    pub fn record<T: Record>(&self, key: &Key) -> Result<Option<T>> {
        match self.version(T::TABLE, key)? {
            Some(v) if !v.stamp.deleted => record(&v.row).map(Some),
            _ => Ok(None),
        }
    }

    /// All live records of the map.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn sheet(&self) -> Result<Sheet> {
        let mut sheet = Sheet::default();
        for table in Table::ALL.iter().copied().filter(|t| t.is_map()) {
            for (key, version) in self.versions(table, &Key::new())? {
                sheet.insert(table, key, version.row);
            }
        }
        Ok(sheet)
    }

    /// The map; none when nothing was imported yet.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn world(&self) -> Result<Option<World>> {
        self.sheet()?.world()
    }

    /// A Fragment (paper 2 §5): all that stands in an Area, found by the Area's id alone.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn fragment(&self, area: AreaId) -> Result<Vec<Replica>> {
        let mut sheet = Sheet::default();
        for (key, version) in self.versions(Table::AreaObjects, &Key::new().id(area.0))? {
            let replica: t::AreaObjects = record(&version.row)?;
            sheet.insert(Table::AreaObjects, key, version.row);
            let by_replica = Key::new().id(replica.repl_id);
            let forms = Key::new().text(Table::AreaObjects.name()).id(replica.repl_id);
            for (table, prefix) in [
                (Table::ReplicaProperties, &by_replica),
                (Table::ReplicaDoors, &by_replica),
                (Table::NameForms, &forms),
            ] {
                for (key, version) in self.versions(table, prefix)? {
                    sheet.insert(table, key, version.row);
                }
            }
        }
        super::read::replicas(&sheet)
    }

    /// The Maps of a Domain, found by its id alone.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn maps_of(&self, domain: DomainId) -> Result<Vec<MapId>> {
        let placed = self.records::<t::DomainMaps>(&Key::new().id(domain.0))?;
        Ok(placed.into_iter().map(|r| MapId(r.map_id)).collect())
    }

    /// The Areas of a Map, found by its id alone.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn areas_of(&self, map: MapId) -> Result<Vec<AreaId>> {
        let placed = self.records::<t::MapItems>(&Key::new().id(map.0))?;
        Ok(placed.into_iter().map(|r| AreaId(r.area_id)).collect())
    }

    /// All versions of a record up to this revision, the oldest first.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a version is broken.
    pub fn history(&self, table: Table, key: &Key) -> Result<Vec<Version>> {
        let mut versions = Vec::new();
        let from = history_prefix(table, key.as_bytes());
        self.trees.scan(HISTORY, &from, &mut |_, bytes| {
            versions.push(Version::decode(table, key.as_bytes(), bytes)?);
            Ok(true)
        })?;
        if let Some(bytes) = self.trees.get(table.code(), key.as_bytes())? {
            versions.push(Version::decode(table, key.as_bytes(), &bytes)?);
        }
        versions.retain(|v| v.stamp.revision <= self.revision);
        Ok(versions)
    }

    /// All versions of all records of a table up to this revision, gone ones among them: those of one record
    /// together, the oldest first.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a version is broken.
    pub fn all_versions(&self, table: Table) -> Result<Vec<Version>> {
        let mut keys = Vec::new();
        self.trees.scan(table.code(), &[], &mut |key, _| {
            keys.push(Key::from_bytes(key));
            Ok(true)
        })?;
        let mut versions = Vec::new();
        for key in &keys {
            versions.extend(self.history(table, key)?);
        }
        Ok(versions)
    }

    /// All that is known of where a replica stood by the map, the oldest version first, whichever the Area.
    ///
    /// Where it went to another Area, the old place's mark of deletion is left out.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a version is broken.
    pub fn replica_history(&self, replica: ReplicaId) -> Result<Vec<Version>> {
        let mut versions = Vec::new();
        for key in self.replica_keys(replica)? {
            versions.extend(self.history(Table::AreaObjects, &key)?);
        }
        versions.order_by_key(|v| (v.stamp.revision, v.stamp.deleted));
        versions.dedup_by(|later, first| {
            later.stamp.deleted && later.stamp.revision == first.stamp.revision
        });
        Ok(versions)
    }

    /// A replica of the map, by its id alone.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a record is broken.
    pub fn replica(&self, id: ReplicaId) -> Result<Option<Replica>> {
        for key in self.replica_keys(id)? {
            if let Some(placed) = self.record::<t::AreaObjects>(&key)? {
                let fragment = self.fragment(AreaId(placed.area_id))?;
                return Ok(fragment.into_iter().find(|r| r.id == id));
            }
        }
        Ok(None)
    }

    /// The keys of AreaObjects that a replica ever had.
    pub(super) fn replica_keys(&self, replica: ReplicaId) -> Result<Vec<Key>> {
        let mut keys = Vec::new();
        self.trees.scan(REPLICAS, &replica.0.to_be_bytes(), &mut |key, _| {
            let (id, place) = key.split_at(key.len().min(4));
            keys.push(Key::from_bytes(&[place, id].concat()));
            Ok(true)
        })?;
        Ok(keys)
    }

    /// The keys that a revision touched.
    pub(crate) fn touched(&self, revision: u64) -> Result<Vec<(Table, Key)>> {
        let mut keys = Vec::new();
        self.trees.scan(CHANGES, &revision.to_be_bytes(), &mut |_, bytes| {
            let list = decode_touched(bytes).ok_or_else(|| StoreError::BadRecord {
                table: "~changes",
                key: revision.to_string(),
            })?;
            keys.extend(list);
            Ok(true)
        })?;
        Ok(keys)
    }
}

/// `ReplID AreaID ObjectID`: a key of AreaObjects, the id first.
pub(crate) fn replica_index(key: &[u8]) -> Vec<u8> {
    let split = key.len().min(8);
    [&key[split..], &key[..split]].concat()
}

pub(super) fn record<T: Record>(row: &Row) -> Result<T> {
    T::from_row(row).ok_or_else(|| StoreError::BadRecord {
        table: T::TABLE.name(),
        key: describe_key(T::TABLE, row),
    })
}
