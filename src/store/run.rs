//! A run: records of the past, sorted, in a file that is written once and read piece by piece.
//!
//! ```text
//! run    := head[24], block*, index, foot[36]
//! block  := (length key length value)*          about 16 KiB; a key is the tree's code and the key; lengths are varints
//! index  := (length first-key place length crc:u32)*                             one entry a block; numbers are varints
//! foot   := index-place:u64 index-length:u64 index-crc:u32 records:u64 crc:u32 "ORUN"
//! ```
//!
//! There are two files of each run, with the same bytes: what cannot be read in one of them is read in the other. An empty
//! value says that an older run's record is gone.
//!
//! **Invariant**: what is given out has passed its checksum.

use crate::units::{Piece, word};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};

use super::cell::{Bytes, put_bytes, put_varint};
use super::disk::{Appender, Disk, Reading};
use super::error::{Result, StoreError, doing};
use super::frame::{FILE_HEADER, RUN, file_header};
use super::journal::numbered;

/// Blocks are closed when they reach this.
const BLOCK: usize = 16 << 10;
const FOOT: usize = 36;
const FOOT_MAGIC: &[u8; 4] = b"ORUN";
/// Blocks kept at hand, of each run.
const KEPT: usize = 64;

/// Key with its tree, and value.
pub(crate) type Entry = (Vec<u8>, Vec<u8>);

struct Block {
    first: Vec<u8>,
    place: u64,
    length: u32,
    crc: u32,
}

/// A run, open for reading.
pub(crate) struct Run {
    /// The number of its files.
    pub(crate) file: u64,
    pub(crate) records: u64,
    pub(crate) bytes: u64,
    paths: [PathBuf; 2],
    copies: [Option<Box<dyn Reading>>; 2],
    /// Of which file something could not be read.
    is_broken: [AtomicBool; 2],
    index: Vec<Block>,
    kept: Mutex<Vec<(usize, Arc<Vec<Entry>>)>>,
}

/// Both files of a run.
pub(crate) fn paths(dir: &Path, file: u64) -> [PathBuf; 2] {
    ["run", "twin"].map(|extension| numbered(dir, file, extension))
}

/// Takes records in the order of their keys and writes them as a run.
struct Writing<'f> {
    out: &'f mut dyn Appender,
    block: Vec<u8>,
    first: Option<Vec<u8>>,
    index: Vec<u8>,
    place: u64,
    records: u64,
}

impl Writing<'_> {
    fn put(&mut self, key: &[u8], value: &[u8]) -> std::io::Result<()> {
        self.first.get_or_insert_with(|| key.to_vec());
        put_bytes(&mut self.block, key);
        put_bytes(&mut self.block, value);
        self.records += 1;
        if self.block.len() >= BLOCK { self.close() } else { Ok(()) }
    }

    fn close(&mut self) -> std::io::Result<()> {
        let Some(first) = self.first.take() else { return Ok(()) };
        put_bytes(&mut self.index, &first);
        put_varint(&mut self.index, self.place);
        put_varint(&mut self.index, self.block.len() as u64);
        self.index.extend(crc32fast::hash(&self.block).to_be_bytes());
        self.out.append(&self.block)?;
        self.place += self.block.len() as u64;
        self.block.clear();
        Ok(())
    }

    fn finish(mut self) -> std::io::Result<()> {
        self.close()?;
        let mut foot = self.place.to_be_bytes().to_vec();
        foot.extend((self.index.len() as u64).to_be_bytes());
        foot.extend(crc32fast::hash(&self.index).to_be_bytes());
        foot.extend(self.records.to_be_bytes());
        foot.extend(crc32fast::hash(&foot).to_be_bytes());
        foot.extend(FOOT_MAGIC);
        self.out.append(&self.index)?;
        self.out.append(&foot)
    }
}

/// Gives records in the order of their keys to whoever takes them.
pub(crate) type Giving<'a> = dyn Fn(&mut dyn FnMut(&[u8], &[u8]) -> Result<()>) -> Result<()> + 'a;

/// Writes both files of a run of these records. Each is whole or not there.
///
/// # Errors
/// [`StoreError::Io`], and what `records` meets with.
pub(crate) fn write(disk: &dyn Disk, dir: &Path, file: u64, records: &Giving<'_>) -> Result<()> {
    paths(dir, file).iter().try_for_each(|path| write_one(disk, path, file, records))
}

fn write_one(disk: &dyn Disk, path: &Path, file: u64, records: &Giving<'_>) -> Result<()> {
    let mut met = None;
    let written = disk.replace_by(path, &mut |out| {
        let head = file_header(RUN, file);
        out.append(&head)?;
        let place = head.len() as u64;
        let (block, index) = (Vec::new(), Vec::new());
        let mut writing = Writing { out, block, first: None, index, place, records: 0 };
        let taken = records(&mut |key, value| {
            writing.put(key, value).map_err(StoreError::io(doing::WRITE, path))
        });
        if let Err(error) = taken {
            met = Some(error);
            return Err(std::io::ErrorKind::WriteZero.into());
        }
        writing.finish()
    });
    match met {
        Some(error) => Err(error),
        None => written.map_err(StoreError::io(doing::WRITE, path)),
    }
}

fn bad(path: &Path, what: Piece) -> StoreError {
    StoreError::BadFile { path: path.display().to_string(), what: what.into() }
}

/// Index and number of records of one copy.
fn read_index(copy: &dyn Reading, path: &Path, file: u64) -> Result<(Vec<Block>, u64, u64)> {
    let io = || StoreError::io(doing::READ, path);
    let length = copy.length().map_err(io())?;
    let short = || bad(path, word!("the-file-was-not-written-to-its"));
    let foot_at = length.checked_sub(FOOT as u64).ok_or_else(short)?;
    if copy.read_at(0, FILE_HEADER).map_err(io())? != file_header(RUN, file) {
        return Err(bad(path, word!("the-beginning-of-the-file-is-broken")));
    }
    let foot = copy.read_at(foot_at, FOOT).map_err(io())?;
    let eight = |at: usize| u64::from_be_bytes(foot[at..at + 8].try_into().expect("eight bytes"));
    let four = |at: usize| u32::from_be_bytes(foot[at..at + 4].try_into().expect("four bytes"));
    if &foot[32..] != FOOT_MAGIC || crc32fast::hash(&foot[..28]) != four(28) {
        return Err(bad(path, word!("the-end-of-the-file-is-broken")));
    }
    let (place, size, records) = (eight(0), eight(8), eight(20));
    if place.checked_add(size) != Some(foot_at) {
        return Err(bad(path, word!("the-end-of-the-file-is-broken")));
    }
    let bytes = copy.read_at(place, size as usize).map_err(io())?;
    if crc32fast::hash(&bytes) != four(16) {
        return Err(bad(path, word!("the-index-is-broken")));
    }
    let mut rest = Bytes(&bytes);
    let mut index = Vec::new();
    let mut read = || {
        while !rest.0.is_empty() {
            let first = rest.slice()?.to_vec();
            let (place, length) = (rest.varint()?, u32::try_from(rest.varint()?).ok()?);
            index.push(Block { first, place, length, crc: u32::from_be_bytes(rest.fixed()?) });
        }
        Some(())
    };
    read().ok_or_else(|| bad(path, word!("the-index-is-broken")))?;
    Ok((index, records, length))
}

impl Run {
    /// Opens a run by whichever of its files has a whole index.
    ///
    /// # Errors
    /// Neither has.
    pub(crate) fn open(disk: &dyn Disk, dir: &Path, file: u64) -> Result<Self> {
        let paths = paths(dir, file);
        let mut fault = None;
        let mut found = None;
        let copies = [0, 1].map(|n| {
            let path: &PathBuf = &paths[n];
            let opened = disk.reading(path).map_err(StoreError::io(doing::READ, path));
            let read = opened.and_then(|copy| Ok((read_index(&*copy, path, file)?, copy)));
            match read {
                Ok((index, copy)) => {
                    found.get_or_insert(index);
                    Some(copy)
                }
                Err(error) => {
                    fault.get_or_insert(error);
                    None
                }
            }
        });
        match (found, fault) {
            (Some((index, records, bytes)), _) => {
                let is_broken = [0, 1].map(|n: usize| AtomicBool::new(copies[n].is_none()));
                let kept = Mutex::default();
                Ok(Self { file, records, bytes, paths, copies, is_broken, index, kept })
            }
            (None, Some(error)) => Err(error),
            (None, None) => unreachable!("a copy is read or at fault"),
        }
    }

    /// Which of its files were found broken since it was opened.
    pub(crate) fn broken(&self) -> Vec<PathBuf> {
        let pairs = self.paths.iter().zip(&self.is_broken);
        let broken = pairs.filter(|(_, is_broken)| is_broken.load(Relaxed));
        broken.map(|(path, _)| path.clone()).collect()
    }

    /// Writes one of its files anew from the other.
    ///
    /// # Errors
    /// A block cannot be read in the other either, or the disk refused.
    pub(crate) fn copy_to(self: &Arc<Self>, disk: &dyn Disk, path: &Path) -> Result<()> {
        write_one(disk, path, self.file, &|put| {
            let mut cursor = self.entries_from(&[]);
            while let Some((key, value)) = cursor.peek()? {
                put(key, value)?;
                cursor.step();
            }
            Ok(())
        })
    }

    /// Reads every block of both files; says of which something is broken.
    pub(crate) fn check(&self) -> Vec<StoreError> {
        let mut found = Vec::new();
        for (path, copy) in self.paths.iter().zip(&self.copies) {
            let Some(copy) = copy else {
                found.push(bad(path, word!("beginning-end-or-index-are-broken")));
                continue;
            };
            if !(0..self.index.len()).all(|n| self.read(&**copy, n).is_some()) {
                found.push(bad(path, word!("the-records-do-not-match-their-checksum")));
            }
        }
        found
    }

    fn read(&self, copy: &dyn Reading, number: usize) -> Option<Vec<u8>> {
        let block = &self.index[number];
        let bytes = copy.read_at(block.place, block.length as usize).ok()?;
        (crc32fast::hash(&bytes) == block.crc).then_some(bytes)
    }

    fn block(&self, number: usize) -> Result<Arc<Vec<Entry>>> {
        let kept = || self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, entries)) = kept().iter().find(|(n, _)| *n == number) {
            return Ok(Arc::clone(entries));
        }
        let mut copies = self.copies.iter().zip(&self.is_broken);
        let bytes = copies.find_map(|(copy, is_broken)| {
            let read = copy.as_ref().and_then(|copy| self.read(&**copy, number));
            if read.is_none() {
                is_broken.store(true, Relaxed);
            }
            read
        });
        let broken = || bad(&self.paths[0], word!("the-records-do-not-match-their-checksum"));
        let bytes = bytes.ok_or_else(broken)?;
        let mut rest = Bytes(&bytes);
        let mut entries = Vec::new();
        while !rest.0.is_empty() {
            let pair = rest.slice().and_then(|key| Some((key.to_vec(), rest.slice()?.to_vec())));
            entries.push(pair.ok_or_else(broken)?);
        }
        let entries = Arc::new(entries);
        let mut kept = kept();
        if kept.len() >= KEPT {
            kept.remove(0);
        }
        kept.push((number, Arc::clone(&entries)));
        Ok(entries)
    }

    /// The block in which a key stands or would stand.
    fn block_of(&self, key: &[u8]) -> usize {
        self.index.partition_point(|block| block.first.as_slice() <= key).saturating_sub(1)
    }

    /// What the run says of a key; an empty value where it says that it is gone.
    pub(crate) fn get(&self, key: &[u8]) -> Result<Option<Vec<u8>>> {
        if self.index.is_empty() {
            return Ok(None);
        }
        let entries = self.block(self.block_of(key))?;
        let at = entries.binary_search_by(|(k, _)| k.as_slice().cmp(key));
        Ok(at.ok().map(|at| entries[at].1.clone()))
    }

    /// The last entry that is not beyond a key, or, where `within` is not said, lies before it.
    pub(crate) fn last(&self, limit: &[u8], within: bool) -> Result<Option<Entry>> {
        let mut number = self.block_of(limit);
        while number < self.index.len() {
            let entries = self.block(number)?;
            let is_in = |(key, _): &Entry| {
                if within { key.as_slice() <= limit } else { key.as_slice() < limit }
            };
            let count = entries.partition_point(is_in);
            if count > 0 {
                return Ok(Some(entries[count - 1].clone()));
            }
            let Some(before) = number.checked_sub(1) else { break };
            number = before;
        }
        Ok(None)
    }

    /// All entries from a key on.
    pub(crate) fn entries_from(self: &Arc<Self>, key: &[u8]) -> Cursor {
        let block = self.block_of(key);
        Cursor { run: Arc::clone(self), block, entries: None, at: 0, from: key.to_vec() }
    }
}

/// A way through a run.
pub(crate) struct Cursor {
    run: Arc<Run>,
    block: usize,
    entries: Option<Arc<Vec<Entry>>>,
    at: usize,
    from: Vec<u8>,
}

impl Cursor {
    /// The entry at which it stands.
    pub(crate) fn peek(&mut self) -> Result<Option<&Entry>> {
        loop {
            if self.block >= self.run.index.len() {
                return Ok(None);
            }
            if self.entries.is_none() {
                let entries = self.run.block(self.block)?;
                self.at = entries.partition_point(|(key, _)| *key < self.from);
                self.entries = Some(entries);
            }
            let length = self.entries.as_ref().map_or(0, |entries| entries.len());
            if self.at < length {
                return Ok(self.entries.as_ref().and_then(|entries| entries.get(self.at)));
            }
            self.block += 1;
            self.entries = None;
        }
    }

    pub(crate) fn step(&mut self) {
        self.at += 1;
    }
}
