//! Care of a store: deep check, backup, restoration.

use std::path::Path;

use crate::store::{FsckReport, Store, fsck};

use super::{Engine, Error};

impl Engine {
    /// Checks every byte of a store and mends nothing.
    ///
    /// # Errors
    /// There is no store, or it is of an unknown format. Whatever is broken within it is a finding.
    pub fn check_store(dir: &Path) -> Result<FsckReport, Error> {
        Ok(fsck(dir)?)
    }

    /// Makes a new store of a backup, in a directory that is empty or does not exist; returns its last revision.
    ///
    /// # Errors
    /// The backup is broken, or the directory is not empty.
    pub fn restore_store(backup: &Path, dir: &Path) -> Result<u64, Error> {
        Ok(Store::restore(backup, dir)?.revision())
    }

    /// Writes the whole store, its history included, into one checksummed file, and reads it back.
    ///
    /// # Errors
    /// The disk refused; the engine has no store.
    pub fn backup(&self, file: &Path) -> Result<(), Error> {
        Ok(self.store()?.backup(file)?)
    }
}
