//! What was acknowledged, told a second time, apart from the journal.
//!
//! A journal that was emptied, or cut off between two frames, is a whole journal to look at, of an older map. So the
//! sequence number of the last acknowledged transaction, and the checksum of what the store held after it, stand in a
//! small file of their own, `head`:
//!
//! ```text
//! head := slot, slot                                                  each in a sector of its own
//! slot := magic[8] format:u32 lsn:u64 records:u64 sum:u32 crc:u32     crc over all before it; numbers big-endian
//! ```
//!
//! Transactions write the two slots in turn, in place, after their frame is on the disk and before they are
//! acknowledged. The order is all that is needed:
//!
//! - A slot never says more than the journal has, whenever the power goes, for its frame was on the disk before it
//!   was begun: what was not lost is not refused.
//! - A slot that is torn by a power cut is known by its checksum; the other one tells of the transaction before.
//! - The slot is handed to the system, not forced to the disk: that costs no second sync. It is there when a
//!   program is killed; when the power goes it may be as old as the system keeps what it has not yet written, while
//!   the journal is never older than what was acknowledged. It is forced when the store has a moment of rest, and when
//!   the store is closed.
//!
//! **Invariant**: opening gives at least what the newer whole slot says, with its checksum, or is refused.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::disk::{Disk, Placed};
use super::error::{Result, StoreError, doing};
use super::frame::FORMAT;
use super::trees::{State, encode_state};

const MAGIC: &[u8; 8] = b"ORTHOHED";
/// A slot lies in one sector, so that a disk writes it whole or not at all.
const SECTOR: usize = 512;
const SLOT: usize = 36;

/// A transaction and what the store held after it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Mark {
    pub(super) lsn: u64,
    records: u64,
    sum: u32,
}

impl Mark {
    pub(super) fn of(state: &State) -> Self {
        Self {
            lsn: state.lsn,
            records: state.digests.values().fold(0, |all, d| all.wrapping_add(d.records)),
            sum: crc32fast::hash(&encode_state(state)),
        }
    }

    fn encode(&self) -> Vec<u8> {
        let mut slot = MAGIC.to_vec();
        slot.extend(FORMAT.to_be_bytes());
        slot.extend(self.lsn.to_be_bytes());
        slot.extend(self.records.to_be_bytes());
        slot.extend(self.sum.to_be_bytes());
        slot.extend(crc32fast::hash(&slot).to_be_bytes());
        slot
    }

    /// Where the slot of this transaction stands.
    fn place(&self) -> usize {
        (self.lsn % 2) as usize * SECTOR
    }
}

/// What the file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Known {
    /// There is no such file: the store is new, was kept by an earlier version, or has lost it.
    Absent,
    /// There is one that tells nothing.
    Broken,
    Mark(Mark),
}

impl Known {
    pub(super) fn mark(&self) -> Option<&Mark> {
        if let Self::Mark(mark) = self { Some(mark) } else { None }
    }

    /// The last transaction that was acknowledged for certain.
    pub(super) fn lsn(&self) -> u64 {
        self.mark().map_or(0, |mark| mark.lsn)
    }
}

fn path_of(dir: &Path) -> PathBuf {
    dir.join("head")
}

/// The format and the mark of a slot that is whole.
fn slot(bytes: &[u8]) -> Option<(u32, Mark)> {
    let slot = bytes.get(..SLOT)?;
    let (body, crc) = slot.split_last_chunk::<4>()?;
    if !body.starts_with(MAGIC) || crc32fast::hash(body) != u32::from_be_bytes(*crc) {
        return None;
    }
    let four = |at: usize| u32::from_be_bytes(body[at..at + 4].try_into().expect("four bytes"));
    let eight = |at: usize| u64::from_be_bytes(body[at..at + 8].try_into().expect("eight bytes"));
    Some((four(8), Mark { lsn: eight(12), records: eight(20), sum: four(28) }))
}

fn slots(bytes: &[u8]) -> impl Iterator<Item = (u32, Mark)> + '_ {
    [0, SECTOR].into_iter().filter_map(|at| slot(bytes.get(at..)?))
}

/// The format that the file states.
pub(super) fn format_told(disk: &dyn Disk, dir: &Path) -> Option<u32> {
    let bytes = disk.read(&path_of(dir)).ok()?;
    slots(&bytes).max_by_key(|(_, mark)| mark.lsn).map(|(format, _)| format)
}

/// Must be read before the journal: another program may be writing both.
pub(super) fn read_head(disk: &dyn Disk, dir: &Path) -> Result<Known> {
    let path = path_of(dir);
    let bytes = match disk.read(&path) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(Known::Absent),
        bytes => bytes.map_err(StoreError::io(doing::READ, &path))?,
    };
    let newest = slots(&bytes).max_by_key(|(_, mark)| mark.lsn);
    Ok(match newest {
        None => Known::Broken,
        Some((FORMAT, mark)) => Known::Mark(mark),
        Some((other, _)) => {
            let dir = dir.display().to_string();
            return Err(StoreError::UnknownFormat { dir, found: other.to_string(), known: FORMAT });
        }
    })
}

/// The file, open for writing.
#[derive(Clone)]
pub(super) struct Head(Arc<dyn Placed>);

impl Head {
    /// Brings the file to a mark, from what was read of it.
    ///
    /// # Errors
    /// [`StoreError::Io`].
    pub(super) fn open(disk: &dyn Disk, dir: &Path, known: &Known, mark: &Mark) -> Result<Self> {
        let path = path_of(dir);
        let failed = || StoreError::io(doing::WRITE, &path);
        if !matches!(known, Known::Mark(_)) {
            let mut file = vec![0; 2 * SECTOR];
            file[mark.place()..mark.place() + SLOT].copy_from_slice(&mark.encode());
            disk.replace(&path, &[file]).map_err(failed())?;
        }
        let head = Self(Arc::from(disk.placed(&path).map_err(failed())?));
        if known.mark().is_some_and(|known| known != mark) {
            head.note(mark).map_err(failed())?;
        }
        Ok(head)
    }

    pub(super) fn note(&self, mark: &Mark) -> std::io::Result<()> {
        self.0.write_at(mark.place() as u64, &mark.encode())
    }

    pub(super) fn sync(&self) -> std::io::Result<()> {
        self.0.sync()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slot_comes_back_whole_or_not_at_all() {
        let mark = Mark { lsn: 7, records: 3, sum: 0xABCD };
        let bytes = mark.encode();
        assert_eq!((bytes.len(), slot(&bytes)), (SLOT, Some((FORMAT, mark))));
        for bit in 0..bytes.len() * 8 {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(slot(&flipped), None, "bit {bit}");
        }
        for length in 0..SLOT {
            assert_eq!(slot(&bytes[..length]), None);
        }
    }
}
