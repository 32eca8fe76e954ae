//! A map that comes as records from a centre of many robots, and takes the place of the store's.

use crate::map::{MapErrors, check};
use crate::store::shipping::unpack_rows;
use crate::store::{Change, ImportReport, Sheet, StoreError};

use super::history::in_memory;
use super::{Engine, Error};

impl Engine {
    /// Makes packed records ([`pack_rows`](crate::store::shipping::pack_rows)) the store's map, in one transaction. They keep
    /// their ids, so that both sides go on to mean the same things by them.
    ///
    /// # Errors
    /// They are no records, make no world, or the world does not pass the checks of a map file; the store is then as it was.
    pub(crate) fn take_rows(
        &mut self,
        rows: &[u8],
        change: &Change,
    ) -> Result<ImportReport, Error> {
        let unread = || StoreError::BadRecord { table: "~map", key: change.reason.clone() };
        let mut sheet = Sheet::default();
        for (table, row) in unpack_rows(rows).ok_or_else(unread)? {
            sheet.add(table, row)?;
        }
        let world = sheet.world()?.ok_or_else(unread)?;
        let faults = MapErrors { source: None, faults: check(&world) };
        if faults.has_errors() {
            return Err(faults.into());
        }
        let report = self.store.as_mut().ok_or_else(in_memory)?.import_sheet(&sheet, change)?;
        self.reread()?;
        Ok(report)
    }
}
