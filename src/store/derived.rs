//! What is computed from the map and kept for the next start: relations, Passframes (D4).
//!
//! Each piece bears the revision that it was computed from; under another one it is stale and is not given out.
//! It stands beside the journal, not in it: what a power cut takes is computed anew.
//!
//! ```text
//! file := "ORTHODRV" format:u32 revision:u64 crc:u32 bytes       crc over all the rest; numbers big-endian
//! ```

use std::path::PathBuf;

use super::Store;
use super::error::{Result, StoreError};
use super::frame::FORMAT;

const MAGIC: &[u8; 8] = b"ORTHODRV";
const HEAD: usize = 24;

impl Store {
    /// Keeps something computed from the map of a revision, in place of what was kept of that kind before.
    ///
    /// # Errors
    /// [`StoreError::ReadOnly`], [`StoreError::Io`].
    ///
    /// # Panics
    /// When `kind` is no plain word: it becomes a file's name.
    pub fn put_derived(&self, kind: &str, revision: u64, bytes: &[u8]) -> Result<()> {
        if let Some(reason) = self.read_only() {
            return Err(StoreError::ReadOnly { reason: reason.to_owned() });
        }
        let path = self.derived_path(kind);
        let dir = self.dir.join("derived");
        self.vault.disk().create_dir(&dir).map_err(StoreError::io("создать каталог", &dir))?;
        let mut head = MAGIC.to_vec();
        head.extend(FORMAT.to_be_bytes());
        head.extend(revision.to_be_bytes());
        head.extend(checksum(&head, bytes).to_be_bytes());
        let parts = [head, bytes.to_vec()];
        self.vault.disk().replace(&path, &parts).map_err(StoreError::io("записать", &path))
    }

    /// What was computed from the map as it stands now; none when it is stale, broken, or was never kept.
    ///
    /// # Panics
    /// When `kind` is no plain word.
    #[must_use]
    pub fn get_derived(&self, kind: &str) -> Option<Vec<u8>> {
        let mut file = self.vault.disk().read(&self.derived_path(kind)).ok()?;
        let (head, bytes) = file.split_at_checked(HEAD)?;
        let whole = head[..8] == *MAGIC
            && head[8..12] == FORMAT.to_be_bytes()
            && head[12..20] == self.revision().to_be_bytes()
            && head[20..24] == checksum(&head[..20], bytes).to_be_bytes();
        whole.then(|| file.split_off(HEAD))
    }

    fn derived_path(&self, kind: &str) -> PathBuf {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        assert!(!kind.is_empty() && kind.chars().all(plain), "{kind:?} is no plain word");
        self.dir.join("derived").join(kind)
    }
}

fn checksum(head: &[u8], bytes: &[u8]) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    crc.update(head);
    crc.update(bytes);
    crc.finalize()
}
