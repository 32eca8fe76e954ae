//! What is computed from the map and kept for the next start: relations, Passframes (D4).
//!
//! Each piece bears the revision that it was computed from; under another one it is stale and is not given out.
//! It stands beside the journal, not in it: what a power cut takes is computed anew.
//!
//! ```text
//! file := "ORTHODRV" format:u32 revision:u64 crc:u32 bytes       crc over all the rest; numbers big-endian
//! ```

use std::path::{Path, PathBuf};

use std::sync::Arc;

use super::Store;
use super::disk::Disk;
use super::error::{Result, StoreError, doing};
use super::frame::FORMAT;

const MAGIC: &[u8; 8] = b"ORTHODRV";
const HEAD: usize = 24;

/// Where what is computed from the map of one revision is kept; any number of threads may hold it.
#[derive(Clone)]
pub struct Derived {
    disk: Arc<dyn Disk>,
    dir: PathBuf,
    revision: u64,
    is_writable: bool,
}

impl std::fmt::Debug for Derived {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Derived").field("revision", &self.revision).finish_non_exhaustive()
    }
}

impl Store {
    /// Where what is computed from the map as it stands now is kept.
    #[must_use]
    pub fn derived(&self) -> Derived {
        Derived {
            disk: self.vault.disk(),
            dir: self.dir.join("derived"),
            revision: self.revision(),
            is_writable: self.vault.read_only().is_none(),
        }
    }
}

impl Derived {
    /// Keeps something computed from the map of this revision, in place of what was kept of that kind before. In a store
    /// that is only read nothing is kept.
    ///
    /// # Errors
    /// [`StoreError::Io`].
    ///
    /// # Panics
    /// When `kind` is no plain word: it becomes a file's name.
    pub fn put(&self, kind: &str, bytes: &[u8]) -> Result<()> {
        if !self.is_writable {
            return Ok(());
        }
        let path = self.path(kind);
        self.disk.create_dir(&self.dir).map_err(StoreError::io(doing::MAKE_DIR, &self.dir))?;
        let mut head = MAGIC.to_vec();
        head.extend(FORMAT.to_be_bytes());
        head.extend(self.revision.to_be_bytes());
        head.extend(checksum(&head, bytes).to_be_bytes());
        let parts = [head, bytes.to_vec()];
        self.disk.replace(&path, &parts).map_err(StoreError::io(doing::WRITE, &path))
    }

    /// What was computed from the map of this revision; none when it is stale, broken, or was never kept.
    ///
    /// # Panics
    /// When `kind` is no plain word.
    #[must_use]
    pub fn get(&self, kind: &str) -> Option<Vec<u8>> {
        let mut file = self.disk.read(&self.path(kind)).ok()?;
        let is_current = whole_of(&file) == Some(self.revision);
        is_current.then(|| file.split_off(HEAD))
    }

    /// What was computed from the map of this or another revision; none when it is broken, or was never kept. For what
    /// knows by itself which of its parts still hold.
    ///
    /// # Panics
    /// When `kind` is no plain word.
    #[must_use]
    pub fn get_of_any(&self, kind: &str) -> Option<Vec<u8>> {
        let mut file = self.disk.read(&self.path(kind)).ok()?;
        whole_of(&file).is_some().then(|| file.split_off(HEAD))
    }

    fn path(&self, kind: &str) -> PathBuf {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        assert!(!kind.is_empty() && kind.chars().all(plain), "{kind:?} is no plain word");
        self.dir.join(kind)
    }
}

/// The revision of a file that is whole.
fn whole_of(file: &[u8]) -> Option<u64> {
    let (head, bytes) = file.split_at_checked(HEAD)?;
    let is_whole = head[..8] == *MAGIC
        && head[8..12] == FORMAT.to_be_bytes()
        && head[20..24] == checksum(&head[..20], bytes).to_be_bytes();
    let revision = head[12..20].try_into().expect("eight bytes");
    is_whole.then_some(u64::from_be_bytes(revision))
}

/// The kinds of derived things whose files are broken.
///
/// # Errors
/// [`StoreError::Io`].
pub(crate) fn broken_derived(disk: &dyn Disk, dir: &Path) -> Result<Vec<String>> {
    let dir = dir.join("derived");
    let mut kinds = disk.list(&dir).map_err(StoreError::io(doing::LIST, &dir))?;
    kinds.retain(|kind| {
        let is_whole = |file: Vec<u8>| whole_of(&file).is_some();
        // What a killed program left unfinished is no file of the store.
        !kind.ends_with(".new") && !disk.read(&dir.join(kind)).is_ok_and(is_whole)
    });
    Ok(kinds)
}

fn checksum(head: &[u8], bytes: &[u8]) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    crc.update(head);
    crc.update(bytes);
    crc.finalize()
}
