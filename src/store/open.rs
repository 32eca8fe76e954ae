//! The directory of a store: its FORMAT file, its lock, sled's corner of it.
//!
//! ```text
//! store/FORMAT      "orthoframe store, format 1"
//!       lock        held while a program has the store open for writing
//!       journal/    00000000000000000001.journal ...
//!       snapshots/  00000000000000004711.snapshot ...
//!       sled/       the trees
//!       derived/    relations, Passframes: what can be computed anew
//!       aside/      broken parts, kept for whoever wants to look
//! ```

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::disk::Disk;
use super::error::{Result, StoreError};
use super::frame::FORMAT;
use super::trees::{SledTrees, Trees};
use super::vault::Shelf;

const FORMAT_FILE: &str = "FORMAT";

/// Takes the store for this program alone; the lock goes with the file.
pub(crate) fn lock(dir: &Path) -> Result<File> {
    let path = dir.join("lock");
    let file = OpenOptions::new()
        .create(true)
        .truncate(false)
        .write(true)
        .open(&path)
        .map_err(StoreError::io("открыть", &path))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StoreError::Locked { dir: dir.display().to_string() }),
        Err(TryLockError::Error(error)) => Err(StoreError::io("запереть", &path)(error)),
    }
}

/// Whether a directory is a store of a format that this program knows, or may become one.
pub(crate) fn check_format(disk: &dyn Disk, dir: &Path) -> Result<bool> {
    let names = disk.list(dir).map_err(StoreError::io("прочитать каталог", dir))?;
    let name = dir.display().to_string();
    if !names.iter().any(|n| n == FORMAT_FILE) {
        // A first opening that was cut short leaves the lock and an unfinished FORMAT, and nothing else.
        let foreign = names.iter().any(|n| n != "lock" && n != "FORMAT.new");
        return if foreign { Err(StoreError::NotAStore { dir: name }) } else { Ok(false) };
    }
    let path = dir.join(FORMAT_FILE);
    let bytes = disk.read(&path).map_err(StoreError::io("прочитать", &path))?;
    let text = String::from_utf8_lossy(&bytes);
    let found = text.trim().strip_prefix("orthoframe store, format ").unwrap_or(&text);
    if found.parse() == Ok(FORMAT) {
        Ok(true)
    } else {
        let found = found.trim().chars().take(40).collect();
        Err(StoreError::UnknownFormat { dir: name, found, known: FORMAT })
    }
}

pub(crate) fn write_format(disk: &dyn Disk, dir: &Path) -> Result<()> {
    let path = dir.join(FORMAT_FILE);
    let text = format!("orthoframe store, format {FORMAT}\n").into_bytes();
    disk.replace(&path, &[text]).map_err(StoreError::io("записать", &path))
}

/// sled in a directory of the store.
pub(crate) struct SledShelf {
    pub(crate) dir: PathBuf,
}

impl Shelf for SledShelf {
    fn open(&mut self) -> Result<Arc<dyn Trees>> {
        Ok(Arc::new(SledTrees::open(&self.dir.join("sled"))?))
    }

    fn set_aside(&mut self) -> Result<()> {
        let (from, aside) = (self.dir.join("sled"), self.dir.join("aside"));
        if !from.exists() {
            return Ok(());
        }
        std::fs::create_dir_all(&aside).map_err(StoreError::io("создать каталог", &aside))?;
        // One broken set is kept, the latest: they could fill the disk.
        let to = aside.join("sled");
        if to.exists() {
            std::fs::remove_dir_all(&to).map_err(StoreError::io("удалить", &to))?;
        }
        std::fs::rename(&from, &to).map_err(StoreError::io("переименовать", &from))
    }
}
