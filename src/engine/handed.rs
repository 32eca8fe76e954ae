//! A map that comes as records from a centre of many robots, and takes the place of the store's.

use crate::map::{MapErrors, check};
use crate::store::{Change, ImportReport, Sheet};

use super::history::in_memory;
use super::{Engine, Error, RequestError};

impl Engine {
    /// Makes records the store's map. They keep their ids, so that both sides go on to mean the same things by them.
    ///
    /// # Errors
    /// They make no world, or the world does not pass the checks of a map file; the store is then as it was.
    pub(crate) fn take_sheet(
        &mut self,
        sheet: &Sheet,
        change: &Change,
    ) -> Result<ImportReport, Error> {
        let no_map = || RequestError::NoMap { store: change.reason.clone() };
        let world = sheet.world()?.ok_or_else(no_map)?;
        let faults = MapErrors { source: None, faults: check(&world) };
        if faults.has_errors() {
            return Err(faults.into());
        }
        let report = self.store.as_mut().ok_or_else(in_memory)?.import_sheet(sheet, change)?;
        self.reread()?;
        Ok(report)
    }
}
