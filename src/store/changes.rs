//! What differs between two worlds, as rows.

use std::collections::BTreeMap;

use crate::map::World;

use super::cell::{Key, Row};
use super::error::Result;
use super::sheet::Sheet;
use super::tables::Table;

/// What differs between two worlds with the same ids: an edit before it is made, found once for who tells of it and who
/// writes it.
#[derive(Debug)]
pub struct Changes<'w> {
    worlds: [&'w World; 2],
    /// Before and after.
    pub(super) rows: BTreeMap<(Table, Key), [Option<Row>; 2]>,
}

impl<'w> Changes<'w> {
    /// Finds them.
    ///
    /// # Errors
    /// [`StoreError::Duplicate`](super::StoreError::Duplicate) when two parts of a world have one key.
    pub fn between(before: &'w World, after: &'w World) -> Result<Self> {
        let [old, new] = Sheet::of_change(before, after)?;
        let mut rows: BTreeMap<(Table, Key), [Option<Row>; 2]> = BTreeMap::new();
        for (place, sheet) in [old, new].into_iter().enumerate() {
            for (table, key, row) in sheet.into_rows() {
                rows.entry((table, key)).or_default()[place] = Some(row);
            }
        }
        rows.retain(|_, [was, is]| was != is);
        Ok(Self { worlds: [before, after], rows })
    }

    /// Before and after.
    pub(super) fn worlds(&self) -> [&'w World; 2] {
        self.worlds
    }
}
