//! A store that several programs write in turn: each has it for the length of a call.
//!
//! Who lives long, a server or a dialogue, puts the store down between two calls and keeps what it has read. A call that
//! writes takes the store up again, with what others wrote meanwhile; one that asks takes that over and leaves the store
//! where it is. That nothing is new costs a look at `head`.
//!
//! **Invariant**: what is written rests on all that was acknowledged before, by whichever program.

use std::path::Path;
use std::sync::Arc;

use super::disk::RealDisk;
use super::error::{Result, StoreError};
use super::head::read_head;
use super::keep::Store;
use super::lock::{PATIENCE, lock};
use super::open::SledShelf;
use super::vault::{self, Vault};

/// What other programs wrote since it was looked last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meanwhile {
    Nothing,
    /// It is known now, and follows from what was known before.
    Records,
    /// The store was opened anew: readers made before stay at what it was.
    Anew,
}

/// Tries while another program removes files that were just listed.
const TRIES: usize = 5;

/// The number of the last transaction of a store that is known to be acknowledged; cheap, and locks nothing.
///
/// # Errors
/// [`StoreError::Io`], [`StoreError::UnknownFormat`].
pub fn last_transaction(dir: &Path) -> Result<u64> {
    Ok(read_head(&RealDisk, dir)?.lsn())
}

impl Store {
    /// Lets other programs write. What is asked is answered as before; what would write is refused until the store is
    /// [taken up](Store::take_up).
    pub fn put_down(&mut self) {
        if self.lock.is_some() {
            self.vault.put_down(&mut SledShelf::new(&self.dir));
            self.lock = None;
        }
    }

    /// Takes the store for this program alone, with what others wrote meanwhile. In a store that cannot be written, or was
    /// opened to be read, it only [follows](Store::follow).
    ///
    /// # Errors
    /// [`StoreError::Locked`] when another program keeps it for longer than a call takes, or drives the robot; else as
    /// [`Store::open`]. The store is then as it was.
    pub fn take_up(&mut self) -> Result<Meanwhile> {
        if self.lock.is_some() || !self.vault.is_put_down() {
            return self.follow();
        }
        let lock = lock(&self.dir, PATIENCE)?;
        let found = match self.vault.take_up()? {
            vault::Meanwhile::Nothing => Meanwhile::Nothing,
            vault::Meanwhile::Frames => Meanwhile::Records,
            vault::Meanwhile::Apart => {
                let mut shelf = SledShelf::new(&self.dir);
                let (vault, report) = Vault::open(Arc::new(RealDisk), &self.dir, &mut shelf)?;
                tracing::info!(?report, "the store is opened anew");
                self.vault = vault;
                Meanwhile::Anew
            }
        };
        self.lock = Some(lock);
        if found != Meanwhile::Nothing {
            self.count_revisions()?;
        }
        Ok(found)
    }

    /// Takes over what other programs have written, and leaves the store to them.
    ///
    /// # Errors
    /// As [`Store::open_read_only`]; the store is then as it was.
    pub fn follow(&mut self) -> Result<Meanwhile> {
        if self.lock.is_some() {
            return Ok(Meanwhile::Nothing);
        }
        let mut tries = 0;
        let found = loop {
            tries += 1;
            match self.followed() {
                Err(StoreError::Io { source, .. })
                    if source.kind() == std::io::ErrorKind::NotFound && tries < TRIES => {}
                done => break done?,
            }
        };
        if found != Meanwhile::Nothing {
            self.count_revisions()?;
        }
        Ok(found)
    }

    fn followed(&mut self) -> Result<Meanwhile> {
        Ok(match self.vault.follow()? {
            vault::Meanwhile::Nothing => Meanwhile::Nothing,
            vault::Meanwhile::Frames => Meanwhile::Records,
            vault::Meanwhile::Apart => {
                let shelf = SledShelf::new(&self.dir);
                let (vault, _) = Vault::open_read_only(Arc::new(RealDisk), &self.dir, &shelf)?;
                self.vault = vault.in_place_of(&self.vault);
                Meanwhile::Anew
            }
        })
    }

    /// Whether the store is this program's alone.
    #[must_use]
    pub fn is_in_hand(&self) -> bool {
        self.lock.is_some()
    }

    /// The number of the last transaction that is known here.
    #[must_use]
    pub fn transaction(&self) -> u64 {
        self.vault.lsn()
    }

    /// Tells other programs, as long as the store is this one's, that the robot is driven meanwhile: they are refused at
    /// once then, for that takes longer than anybody waits.
    ///
    /// # Errors
    /// The store cannot be written, or was put down.
    pub fn set_out(&mut self) -> Result<()> {
        self.vault.check_writable()?;
        self.says_drives(true);
        Ok(())
    }

    /// The robot is back.
    pub fn come_back(&mut self) {
        self.says_drives(false);
    }

    fn says_drives(&mut self, drives: bool) {
        if let Some(lock) = &mut self.lock {
            lock.says_drives(drives);
        }
    }
}
