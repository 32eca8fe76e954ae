//! The directory of a store: its FORMAT file, its lock, sled's corner of it.
//!
//! ```text
//! store/FORMAT      "orthoframe store, format 1", twice: one flipped bit is then no other format
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
const FORMAT_LINE: &str = "orthoframe store, format ";

/// The store is this program's alone as long as this lives.
pub(crate) struct Lock(File);

impl Drop for Lock {
    fn drop(&mut self) {
        // Closing is not enough: a child that another thread is about to start shares the file until it runs. What
        // cannot be unlocked is unlocked by the end of both.
        let _ = self.0.unlock();
    }
}

/// Takes the store for this program alone.
pub(crate) fn lock(dir: &Path) -> Result<Lock> {
    let path = dir.join("lock");
    let file = OpenOptions::new()
        .create(true)
        .truncate(false)
        .write(true)
        .open(&path)
        .map_err(StoreError::io("открыть", &path))?;
    match file.try_lock() {
        Ok(()) => Ok(Lock(file)),
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
    match format_of(&bytes) {
        Some(FORMAT) => Ok(true),
        Some(other) => {
            Err(StoreError::UnknownFormat { dir: name, found: other.to_string(), known: FORMAT })
        }
        // A damaged file says nothing; every journal and snapshot states its format once more.
        None if names.iter().any(|n| n == "journal") => Ok(true),
        None => Err(StoreError::NotAStore { dir: name }),
    }
}

/// The format that both lines state.
fn format_of(bytes: &[u8]) -> Option<u32> {
    let mut lines = std::str::from_utf8(bytes).ok()?.lines();
    let (first, second) = (lines.next()?, lines.next()?);
    let number = first.strip_prefix(FORMAT_LINE)?.parse().ok()?;
    (first == second && lines.next().is_none()).then_some(number)
}

/// Whether the FORMAT file is as this program writes it.
pub(crate) fn format_is_whole(disk: &dyn Disk, dir: &Path) -> bool {
    disk.read(&dir.join(FORMAT_FILE)).is_ok_and(|bytes| format_of(&bytes) == Some(FORMAT))
}

pub(crate) fn write_format(disk: &dyn Disk, dir: &Path) -> Result<()> {
    let path = dir.join(FORMAT_FILE);
    let text = format!("{FORMAT_LINE}{FORMAT}\n").repeat(2).into_bytes();
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

    fn exists(&self) -> bool {
        self.dir.join("sled").exists()
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
