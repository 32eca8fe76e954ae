//! A sheet: the live records of the map at one revision, and their passage from and to a [`World`].
//!
//! **Invariant**: `Sheet::of(world)?.world()? == world`, to the last bit and in the same order.

use std::collections::BTreeMap;

use crate::map::World;

use super::cell::{Key, Row};
use super::error::{Result, StoreError};
use super::schema::{Record, key_of};
use super::tables::Table;

/// Records of one revision by table and key.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    tables: BTreeMap<Table, BTreeMap<Key, Row>>,
}

impl Sheet {
    /// The records of a world.
    ///
    /// # Errors
    /// [`StoreError::Duplicate`] when two parts of the world have one key.
    pub fn of(world: &World) -> Result<Self> {
        super::write::records(world)
    }

    /// The derived tables of a world: ObjectItemSides, AreaItemSides, AreaObjectSides, MapItemSides.
    ///
    /// # Errors
    /// [`StoreError::Duplicate`] when two parts of the world have one key.
    pub fn derived(world: &World) -> Result<Self> {
        super::sides::derived(world)
    }

    /// The world of the records; none when there is no Domain.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] or [`StoreError::BrokenReference`] when the records make no world.
    pub fn world(&self) -> Result<Option<World>> {
        super::read::world(self)
    }

    pub(crate) fn put<T: Record>(&mut self, record: &T) -> Result<()> {
        let (table, row) = (T::TABLE, record.to_row());
        let key = key_of(table.columns(), &row).expect("a record's key fields are ids and texts");
        match self.tables.entry(table).or_default().entry(key) {
            std::collections::btree_map::Entry::Vacant(place) => {
                place.insert(row);
                Ok(())
            }
            std::collections::btree_map::Entry::Occupied(place) => Err(StoreError::Duplicate {
                table: table.name(),
                key: describe_key(table, place.get()),
            }),
        }
    }

    pub(crate) fn insert(&mut self, table: Table, key: Key, row: Row) {
        self.tables.entry(table).or_default().insert(key, row);
    }

    pub(crate) fn remove(&mut self, table: Table, key: &Key) {
        if let Some(rows) = self.tables.get_mut(&table) {
            rows.remove(key);
        }
    }

    /// Adds a row that came from elsewhere, a table of SQL for one.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when the cells do not fit the table's columns, [`StoreError::Duplicate`] when
    /// there is a row with this key already, [`StoreError::DerivedTable`] for a table that is computed.
    pub fn add(&mut self, table: Table, row: Row) -> Result<()> {
        if !table.is_stored() {
            return Err(StoreError::DerivedTable { table: table.name() });
        }
        let described = || (table.name(), describe_key(table, &row));
        let key = key_of(table.columns(), &row).filter(|_| table.fits(&row));
        let Some(key) = key else {
            let (table, key) = described();
            return Err(StoreError::BadRecord { table, key });
        };
        if self.get(table, &key).is_some() {
            let (table, key) = described();
            return Err(StoreError::Duplicate { table, key });
        }
        self.insert(table, key, row);
        Ok(())
    }

    #[must_use]
    pub fn get(&self, table: Table, key: &Key) -> Option<&Row> {
        self.tables.get(&table)?.get(key)
    }

    /// The rows of a table in the order of their keys.
    pub fn rows(&self, table: Table) -> impl Iterator<Item = (&Key, &Row)> + '_ {
        self.tables.get(&table).into_iter().flatten()
    }

    /// All rows, in the order of tables and keys.
    pub fn iter(&self) -> impl Iterator<Item = (Table, &Key, &Row)> + '_ {
        self.tables.iter().flat_map(|(table, rows)| rows.iter().map(|(k, r)| (*table, k, r)))
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.tables.values().map(BTreeMap::len).sum()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The records of one type, in the order of their keys.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when a row does not fit its table.
    pub fn all<T: Record>(&self) -> Result<Vec<T>> {
        self.rows(T::TABLE)
            .map(|(_, row)| {
                T::from_row(row).ok_or_else(|| StoreError::BadRecord {
                    table: T::TABLE.name(),
                    key: describe_key(T::TABLE, row),
                })
            })
            .collect()
    }
}

/// A record's key as people read it: `AreaID 3, ReplID 17`.
pub(crate) fn describe_key(table: Table, row: &[super::Cell]) -> String {
    let parts: Vec<_> = table
        .columns()
        .iter()
        .zip(row)
        .filter(|(column, _)| column.is_key)
        .map(|(column, cell)| format!("{} {cell}", column.name))
        .collect();
    parts.join(", ")
}
