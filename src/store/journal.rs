//! The journal's files: where they are, what they hold, how one begins.
//!
//! **Invariant**: [`Log::read`] gives every frame that is whole, those behind a hole too, and names the hole.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::disk::{Appender, Disk};
use super::error::{Result, StoreError, doing};
use super::frame::{
    FILE_HEADER, FORMAT, HeadError, JOURNAL, Payload, Scan, Tail, file_header, scan,
};

pub(super) struct Journal {
    pub(super) file: Box<dyn Appender>,
    pub(super) path: PathBuf,
    pub(super) length: u64,
}

pub(super) fn journal_dir(dir: &Path) -> PathBuf {
    dir.join("journal")
}

pub(super) fn snapshot_dir(dir: &Path) -> PathBuf {
    dir.join("snapshots")
}

pub(super) fn numbered(dir: &Path, lsn: u64, extension: &str) -> PathBuf {
    dir.join(format!("{lsn:020}.{extension}"))
}

/// Files named by a number, in its order.
pub(super) fn numbered_files(
    disk: &dyn Disk,
    dir: &Path,
    extension: &str,
) -> Result<Vec<(u64, PathBuf)>> {
    let names = disk.list(dir).map_err(StoreError::io(doing::LIST, dir))?;
    let number = |name: &String| {
        let (stem, end) = name.split_once('.')?;
        (end == extension && stem.len() == 20).then(|| stem.parse().ok()).flatten()
    };
    Ok(names.iter().filter_map(|n| Some((number(n)?, dir.join(n)))).collect())
}

/// The snapshots of a store, the oldest first.
pub(super) fn snapshot_files(disk: &dyn Disk, dir: &Path) -> Result<Vec<(u64, PathBuf)>> {
    numbered_files(disk, &snapshot_dir(dir), "snapshot")
}

/// All that the journal files hold.
#[derive(Default)]
pub(super) struct Log {
    pub(super) files: Vec<(u64, PathBuf, Vec<u8>)>,
    /// Sequence number → file and payload.
    frames: BTreeMap<u64, (usize, std::ops::Range<usize>)>,
    /// Where the last file's good part ends, and how much follows.
    pub(super) end: u64,
    pub(super) torn: u64,
    pub(super) fault: Option<StoreError>,
}

impl Log {
    pub(super) fn read(disk: &dyn Disk, dir: &Path) -> Result<Self> {
        Self::read_from(disk, dir, 0)
    }

    /// The same from the file on in which a transaction stands, or would.
    pub(super) fn read_from(disk: &dyn Disk, dir: &Path, lsn: u64) -> Result<Self> {
        let mut log = Self::default();
        let mut torn_files = Vec::new();
        let files = numbered_files(disk, &journal_dir(dir), "journal")?;
        let from = files.iter().rposition(|(first, _)| *first <= lsn).unwrap_or(0);
        for (first, path) in files.into_iter().skip(from) {
            let bytes = disk.read(&path).map_err(StoreError::io(doing::READ, &path))?;
            let index = log.files.len();
            let corrupt = |offset: usize| StoreError::JournalCorrupt {
                path: path.display().to_string(),
                offset: offset as u64,
            };
            (log.end, log.torn) = (bytes.len() as u64, 0);
            match scan(&bytes, JOURNAL) {
                Ok(scan) if scan.lsn == first => {
                    log.end = scan.good as u64;
                    log.torn = bytes.len() as u64 - log.end;
                    if scan.tail == Tail::Torn {
                        torn_files.push((first + scan.frames.len() as u64, corrupt(scan.good)));
                    }
                    log.take(index, &scan, &bytes, &corrupt);
                }
                Err(HeadError::Short) => {
                    (log.end, log.torn) = (0, bytes.len() as u64);
                }
                Err(HeadError::Format(found)) => {
                    return Err(StoreError::UnknownFormat {
                        dir: dir.display().to_string(),
                        found: found.to_string(),
                        known: FORMAT,
                    });
                }
                Ok(_) | Err(HeadError::Broken) => {
                    log.fault.get_or_insert(corrupt(0));
                    // The frames may be whole though the head is not.
                    let mut mended = file_header(JOURNAL, first);
                    mended.extend(bytes.get(mended.len()..).unwrap_or_default());
                    if let Ok(scan) = scan(&mended, JOURNAL) {
                        log.take(index, &scan, &mended, &corrupt);
                    }
                }
            }
            log.files.push((first, path, bytes));
        }
        // A tear is harmless only where nothing was written after it.
        for (next, fault) in torn_files {
            if log.frames.range(next..).next().is_some() {
                log.fault.get_or_insert(fault);
            }
        }
        Ok(log)
    }

    fn take(
        &mut self,
        file: usize,
        found: &Scan,
        bytes: &[u8],
        corrupt: &dyn Fn(usize) -> StoreError,
    ) {
        for (lsn, payload) in &found.frames {
            self.frames.insert(*lsn, (file, payload.clone()));
        }
        if found.tail == Tail::Corrupt {
            self.fault.get_or_insert_with(|| corrupt(found.good));
            // What stands behind the hole may be all that the trees lack.
            let mut at = found.good + 1;
            while at < bytes.len() {
                let mut rest = file_header(JOURNAL, 0);
                let head = rest.len();
                rest.extend(&bytes[at..]);
                match scan(&rest, JOURNAL) {
                    Ok(later) if !later.frames.is_empty() => {
                        for (lsn, payload) in &later.frames {
                            let place = payload.start - head + at..payload.end - head + at;
                            self.frames.insert(*lsn, (file, place));
                        }
                        at += (later.good - head).max(1);
                    }
                    _ => at += next_magic(&bytes[at + 1..]) + 1,
                }
            }
        }
    }

    /// Whether something stood in a journal of which nothing can be read any more.
    pub(super) fn lost_head(&self) -> bool {
        self.fault.is_some() && self.frames.is_empty()
    }

    /// Whether no file has its head: nothing tells that there ever was a transaction, or that there was none.
    pub(super) fn is_headless(&self) -> bool {
        self.frames.is_empty() && self.end < FILE_HEADER as u64
    }

    /// The last sequence number that is known of: a file that begins with 4 has had 3 before it.
    pub(super) fn last(&self) -> u64 {
        let before = self.files.last().map_or(0, |(first, ..)| first.saturating_sub(1));
        self.frames.keys().next_back().copied().unwrap_or(0).max(before)
    }

    /// Whether every frame from `after + 1` to `last` is there.
    pub(super) fn reaches(&self, after: u64, last: u64) -> bool {
        last <= after || self.frames.range(after + 1..=last).count() as u64 == last - after
    }

    pub(super) fn payload(&self, lsn: u64) -> Option<Payload> {
        let (file, range) = self.frames.get(&lsn)?;
        Payload::decode(self.files[*file].2.get(range.clone())?)
    }
}

/// How many bytes to skip to the next place where a frame may begin.
fn next_magic(bytes: &[u8]) -> usize {
    bytes.windows(4).position(|w| w == b"OFJ\x01").unwrap_or(bytes.len())
}

/// A journal file that begins with the given sequence number.
pub(super) fn begin_journal(disk: &dyn Disk, dir: &Path, lsn: u64) -> Result<Journal> {
    let dir = journal_dir(dir);
    let path = numbered(&dir, lsn, "journal");
    let head = file_header(JOURNAL, lsn);
    let mut file = disk.appender(&path).map_err(StoreError::io(doing::MAKE, &path))?;
    let written = file.append(&head).and_then(|()| file.sync());
    written.map_err(StoreError::io(doing::WRITE, &path))?;
    disk.sync_dir(&dir).map_err(StoreError::io(doing::WRITE_DIR, &dir))?;
    Ok(Journal { file, path, length: head.len() as u64 })
}

/// Sees to it that a file outlives a power cut, with its name. A frame that a killed program wrote but did not sync, and a
/// file whose making failed at the last, can be read now and yet vanish: what is built upon must be on the disk first.
pub(super) fn keep_journal(disk: &dyn Disk, path: &Path) -> Result<()> {
    let synced = disk.appender(path).and_then(|mut file| file.sync());
    synced.map_err(StoreError::io(doing::WRITE, path))?;
    let dir = path.parent().unwrap_or(path);
    disk.sync_dir(dir).map_err(StoreError::io(doing::WRITE_DIR, dir))
}
