//! The directory of a store: its FORMAT file, sled's corner of it.
//!
//! ```text
//! store/FORMAT      "orthoframe store, format 1", twice: one flipped bit is then no other format
//!       head        which transaction was acknowledged last, and what the store held after it
//!       lock        held while a program writes; it says so where it drives the robot meanwhile
//!       journal/    00000000000000000001.journal ...
//!       snapshots/  00000000000000004711.snapshot ...
//!       past/       00000000000000004711.run and .twin ...: what is past, see `past`
//!       sled/       the trees
//!       derived/    relations, Passframes: what can be computed anew
//!       aside/      broken parts, kept for whoever wants to look
//! ```

use crate::units::said;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::disk::{Disk, RealDisk};
use super::error::{Result, StoreError, doing};
use super::frame::{FORMAT, format_stated};
use super::head::format_told;
use super::journal::{journal_dir, numbered_files, snapshot_files};
use super::trees::{SledTrees, Trees};
use super::vault::Shelf;

const FORMAT_FILE: &str = "FORMAT";
const FORMAT_LINE: &str = "orthoframe store, format ";

/// What a directory is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// Empty, or a first opening was cut short there.
    New,
    /// A store of a format that this program knows.
    Store,
    /// One whose FORMAT file is lost or damaged; its other files state the format.
    Unmarked,
}

/// Whether a directory is a store of a format that this program knows, or may become one.
pub(crate) fn check_format(disk: &dyn Disk, dir: &Path) -> Result<Place> {
    let names = disk.list(dir).map_err(StoreError::io(doing::LIST, dir))?;
    let has = |name: &str| names.iter().any(|n| n == name);
    let name = dir.display().to_string();
    let of = |format: u32, place: Place| match format {
        FORMAT => Ok(place),
        other => Err(StoreError::UnknownFormat {
            dir: name.clone(),
            found: other.to_string(),
            known: FORMAT,
        }),
    };
    if has(FORMAT_FILE) {
        let path = dir.join(FORMAT_FILE);
        let bytes = disk.read(&path).map_err(StoreError::io(doing::READ, &path))?;
        if let Some(format) = format_of(&bytes) {
            return of(format, Place::Store);
        }
    }
    if let Some(format) = told_elsewhere(disk, dir)? {
        return of(format, Place::Unmarked);
    }
    match has(FORMAT_FILE) {
        // A damaged file says nothing, and neither do damaged journals; what is left of them is found out later.
        true if has("journal") => Ok(Place::Unmarked),
        true => Err(StoreError::NotAStore { dir: name }),
        // A first opening that was cut short leaves the lock and an unfinished FORMAT, and nothing else.
        false if names.iter().all(|n| n == "lock" || n == "FORMAT.new") => Ok(Place::New),
        false => Err(StoreError::NotAStore { dir: name }),
    }
}

/// The format as `head`, a journal or a snapshot states it, under a checksum.
fn told_elsewhere(disk: &dyn Disk, dir: &Path) -> Result<Option<u32>> {
    if let Some(format) = format_told(disk, dir) {
        return Ok(Some(format));
    }
    let journals = numbered_files(disk, &journal_dir(dir), "journal")?;
    for (_, path) in journals.into_iter().chain(snapshot_files(disk, dir)?) {
        let bytes = disk.read(&path).map_err(StoreError::io(doing::READ, &path))?;
        if let Some(format) = format_stated(&bytes) {
            return Ok(Some(format));
        }
    }
    Ok(None)
}

/// The format that both lines state.
fn format_of(bytes: &[u8]) -> Option<u32> {
    let mut lines = std::str::from_utf8(bytes).ok()?.lines();
    let (first, second) = (lines.next()?, lines.next()?);
    let number = first.strip_prefix(FORMAT_LINE)?.parse().ok()?;
    (first == second && lines.next().is_none()).then_some(number)
}

pub(crate) fn write_format(disk: &dyn Disk, dir: &Path) -> Result<()> {
    let path = dir.join(FORMAT_FILE);
    let text = format!("{FORMAT_LINE}{FORMAT}\n").repeat(2).into_bytes();
    disk.replace(&path, &[text]).map_err(StoreError::io(doing::WRITE, &path))
}

/// sled in a directory of the store.
pub(crate) struct SledShelf {
    dir: PathBuf,
    /// Another program's sled, left behind by a store that it has closed, still holds the directory.
    is_held: bool,
}

/// Room that a new sled is given; on a disk without it sled would fail, or hang, while it is made.
const ROOM: usize = 1 << 20;

impl SledShelf {
    pub(crate) fn new(dir: &Path) -> Self {
        Self { dir: dir.to_owned(), is_held: false }
    }

    /// Whether the disk has room for a new sled, found out by asking for it.
    fn check_room(&self) -> Result<()> {
        let probe = self.dir.join("room");
        let asked = RealDisk.remove_if_there(&probe).and_then(|()| {
            let mut file = RealDisk.appender(&probe)?;
            let piece = vec![0x5A; 1 << 16];
            (0..ROOM >> 16).try_for_each(|_| file.append(&piece))
        });
        let removed = RealDisk.remove_if_there(&probe);
        asked.and(removed).map_err(StoreError::io(doing::FIND_ROOM, &self.dir.join("sled")))
    }
}

impl Shelf for SledShelf {
    fn open(&mut self) -> Result<Arc<dyn Trees>> {
        if !self.exists()
            && let Err(full) = self.check_room()
        {
            // What was set aside is in the way of what is needed.
            let aside = self.dir.join("aside").join("sled");
            if std::fs::remove_dir_all(aside).is_err() || self.check_room().is_err() {
                return Err(full);
            }
        }
        match SledTrees::open(&self.dir.join("sled")) {
            Ok(trees) => Ok(Arc::new(trees)),
            Err(error) => {
                self.is_held = error.to_string().contains("could not acquire lock");
                Err(error)
            }
        }
    }

    fn exists(&self) -> bool {
        self.dir.join("sled").exists()
    }

    fn set_aside(&mut self) -> Result<()> {
        if self.is_held {
            let what = said!("another-program-still-holds-sled");
            return Err(StoreError::Tables { what });
        }
        let (from, aside) = (self.dir.join("sled"), self.dir.join("aside"));
        if !from.exists() {
            return Ok(());
        }
        // One broken set is kept, the latest: they could fill the disk.
        let to = aside.join("sled");
        if to.exists() {
            std::fs::remove_dir_all(&to).map_err(StoreError::io(doing::REMOVE, &to))?;
        }
        std::fs::create_dir_all(&aside).map_err(StoreError::io(doing::MAKE_DIR, &aside))?;
        std::fs::rename(&from, &to).map_err(StoreError::io(doing::RENAME, &from))
    }

    fn look(&self) -> Result<Arc<dyn Trees>> {
        match self.exists() {
            true => Ok(Arc::new(SledTrees::open_copy(&self.dir.join("sled"))?)),
            false => Err(StoreError::Tables { what: said!("there-are-no-tables-of-sled") }),
        }
    }
}
