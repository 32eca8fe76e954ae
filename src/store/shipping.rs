//! The journal read by another program, frame by frame, to keep a second copy of the store elsewhere.
//!
//! A frame bears the sequence number of its transaction and a checksum. Who has a copy as of frame *n* asks for what
//! follows it ([`frames_after`]) and shows the checksum of frame *n*, so that a store that was put back from a backup, and
//! then went on otherwise, is told from the one that was copied. Where the journal does not lead on from there, because a
//! snapshot made the files superfluous or because it is another past, the copy begins anew from the whole ([`whole`]).
//!
//! Nothing is locked and nothing written: the store's own program does not notice. Only what `head` says was acknowledged
//! is given, for a frame behind it may yet be cut off.
//!
//! **Invariant**: whatever bytes are read as a frame or as a store, there is no panic.

use std::collections::BTreeMap;
use std::path::Path;

use super::cell::{Bytes, Key, Row};
use super::disk::{Disk, RealDisk};
use super::error::{Result, StoreError, doing};
use super::frame::{JOURNAL, Op, Payload, decode_frame, encode_frame, scan};
use super::head::read_head;
use super::journal::{journal_dir, numbered_files};
use super::keep::Store;
use super::open::{Place, check_format};
use super::schema::key_of;
use super::tables::Table;
use super::trees::HISTORY;
use super::version::Version;

/// A transaction of the journal as it stands there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Frame {
    /// Its number: 1 is the store's first transaction.
    pub sequence: u64,
    /// CRC-32 over all of it but this checksum.
    pub checksum: u32,
    /// The whole frame, head and checksum included.
    pub bytes: Vec<u8>,
}

/// What follows a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Following {
    /// The next frames in their order; none when that frame is the last.
    Frames(Vec<Frame>),
    /// The journal does not lead on from that frame: the copy has to begin anew, see [`whole`].
    Broken,
}

/// One record that a transaction wrote.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    pub table: Table,
    /// With all columns of its table, those that were added after it was written too.
    pub version: Version,
    /// The revision of the version that it takes the place of; of records of the map alone.
    pub replaces: Option<u64>,
}

/// All that a store holds, as the transaction of a number left it.
#[derive(Debug)]
pub struct Whole {
    pub sequence: u64,
    /// The checksum of that transaction's frame, where the journal still has it.
    pub checksum: Option<u32>,
    /// Pieces in the form of frames, of records in place of one transaction's: the old versions before the newer ones.
    pub pieces: Vec<Frame>,
}

/// Tries while the store's own program removes files that were just listed.
const TRIES: usize = 5;
/// Records of a piece of the whole.
const PIECE: usize = 4096;

/// The frames after the one of `sequence`, which had that checksum, up to about so many bytes; 0 is before the first.
///
/// # Errors
/// [`StoreError::Io`], [`StoreError::NotAStore`], [`StoreError::Missing`], [`StoreError::UnknownFormat`].
pub fn frames_after(
    dir: &Path,
    sequence: u64,
    checksum: Option<u32>,
    most_bytes: usize,
) -> Result<Following> {
    let mut tries = 0;
    loop {
        tries += 1;
        match read_after(dir, sequence, checksum, most_bytes) {
            Err(StoreError::Io { source, .. })
                if source.kind() == std::io::ErrorKind::NotFound && tries < TRIES => {}
            done => return done,
        }
    }
}

fn is_there(disk: &dyn Disk, dir: &Path) -> Result<()> {
    match check_format(disk, dir)? {
        Place::New => Err(StoreError::Missing { dir: dir.display().to_string() }),
        Place::Store | Place::Unmarked => Ok(()),
    }
}

fn read_after(
    dir: &Path,
    sequence: u64,
    checksum: Option<u32>,
    most_bytes: usize,
) -> Result<Following> {
    let disk = RealDisk;
    is_there(&disk, dir)?;
    let last = read_head(&disk, dir)?.lsn();
    if sequence > last {
        return Ok(Following::Broken);
    }
    let files = numbered_files(&disk, &journal_dir(dir), "journal")?;
    let from = files.iter().rposition(|(first, _)| *first <= sequence.max(1)).unwrap_or(0);
    let mut found = Vec::<Frame>::new();
    let (mut size, mut is_joined) = (0, sequence == 0);
    for (first, path) in files.iter().skip(from) {
        let bytes = disk.read(path).map_err(StoreError::io(doing::READ, path))?;
        let Ok(scan) = scan(&bytes, JOURNAL) else { break };
        if scan.lsn != *first {
            break;
        }
        for (lsn, payload) in scan.frames {
            let frame = frame_of(&bytes, lsn, &payload);
            if lsn == sequence {
                is_joined = Some(frame.checksum) == checksum;
            }
            if lsn <= sequence || lsn > last {
                continue;
            }
            if !is_joined || lsn != found.last().map_or(sequence, |f| f.sequence) + 1 {
                return Ok(Following::Broken);
            }
            if size > 0 && size + frame.bytes.len() > most_bytes {
                return Ok(Following::Frames(found));
            }
            size += frame.bytes.len();
            found.push(frame);
        }
    }
    // What is acknowledged and not read is a hole of the journal.
    let reached = found.last().map_or(sequence, |f| f.sequence);
    Ok(if is_joined && reached == last { Following::Frames(found) } else { Following::Broken })
}

fn frame_of(file: &[u8], sequence: u64, payload: &std::ops::Range<usize>) -> Frame {
    let bytes = file[payload.start - super::frame::FRAME_HEADER..payload.end].to_vec();
    let checksum = u32::from_be_bytes(bytes[8..12].try_into().expect("a frame has its head"));
    Frame { sequence, checksum, bytes }
}

/// The frames that stand one after the other in some bytes; none when anything else stands between or behind them.
#[must_use]
pub fn split_frames(mut bytes: &[u8]) -> Option<Vec<Frame>> {
    let mut found = Vec::new();
    while !bytes.is_empty() {
        let (sequence, length) = decode_frame(bytes)?;
        let (frame, rest) = bytes.split_at_checked(super::frame::FRAME_HEADER + length)?;
        found.push(frame_of(frame, sequence, &(super::frame::FRAME_HEADER..frame.len())));
        bytes = rest;
    }
    Some(found)
}

impl Frame {
    /// The records that the transaction wrote, in its order, those that only tell where the store keeps its past left out.
    ///
    /// A record that went into the past, or that was forgotten, is no record written.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] when the frame cannot be read, or holds a record that is none of its table.
    pub fn written(&self) -> Result<Vec<Written>> {
        let bad = || StoreError::BadRecord { table: "~journal", key: self.sequence.to_string() };
        let payload = self.bytes.get(super::frame::FRAME_HEADER..).and_then(Payload::decode);
        let ops = payload.ok_or_else(bad)?.ops;
        let mut replaced = BTreeMap::<&[u8], u64>::new();
        for op in ops.iter().filter(|op| op.tree == HISTORY && op.value.is_some()) {
            if let Some((of, revision)) = op.key.split_last_chunk::<8>() {
                replaced.insert(of, u64::from_be_bytes(*revision));
            }
        }
        let mut written = Vec::new();
        for op in &ops {
            let Some(table) = Table::from_code(op.tree) else { continue };
            let Some(value) = op.value.as_deref().filter(|v| !v.is_empty()) else { continue };
            let mut version = Version::decode(table, &op.key, value)?;
            version.row = table.full(&version.row).ok_or_else(bad)?;
            let of: Vec<u8> = std::iter::once(op.tree).chain(op.key.iter().copied()).collect();
            written.push(Written { table, version, replaces: replaced.get(&of[..]).copied() });
        }
        Ok(written)
    }
}

/// All that a store holds, for a copy that begins anew: every version of the records of the map, what was seen, and what
/// the robot keeps in mind.
///
/// # Errors
/// As [`Store::open_read_only`]; [`StoreError::BadRecord`] when a record is broken.
pub fn whole(dir: &Path) -> Result<Whole> {
    let (store, report) = Store::open_read_only(dir)?;
    let sequence = report.lsn;
    let checksum = checksum_of(dir, sequence)?;
    let reader = store.reader();
    let mut ops = Vec::new();
    let mut put = |table: Table, version: &Version| -> Result<()> {
        let key = key_of(table.columns(), &version.row).ok_or_else(|| StoreError::BadRecord {
            table: table.name(),
            key: super::sheet::describe_key(table, &version.row),
        })?;
        let value = Some(version.encode(table, key.as_bytes()));
        ops.push(Op { tree: table.code(), key: key.as_bytes().to_vec(), value });
        Ok(())
    };
    for table in Table::ALL.iter().copied().filter(|table| table.is_stored()) {
        if table.is_map() {
            reader.all_versions(table)?.iter().try_for_each(|version| put(table, version))?;
        } else {
            let versions = reader.versions(table, &Key::new())?;
            versions.iter().try_for_each(|(_, version)| put(table, version))?;
        }
    }
    let pieces = ops.chunks(PIECE).filter_map(|ops| {
        split_frames(&encode_frame(sequence, ops, &BTreeMap::new())).and_then(|mut f| f.pop())
    });
    Ok(Whole { sequence, checksum, pieces: pieces.collect() })
}

fn checksum_of(dir: &Path, sequence: u64) -> Result<Option<u32>> {
    let disk = RealDisk;
    for (_, path) in numbered_files(&disk, &journal_dir(dir), "journal")?.iter().rev() {
        let Ok(bytes) = disk.read(path) else { continue };
        let Ok(scan) = scan(&bytes, JOURNAL) else { continue };
        if let Some((lsn, payload)) = scan.frames.iter().find(|(lsn, _)| *lsn == sequence) {
            return Ok(Some(frame_of(&bytes, *lsn, payload).checksum));
        }
    }
    Ok(None)
}

/// Rows as bytes that bear their tables, to be sent from store to store; see [`unpack_rows`].
#[must_use]
pub fn pack_rows<'a>(rows: impl IntoIterator<Item = (Table, &'a Row)>) -> Vec<u8> {
    let mut out = Vec::new();
    for (table, row) in rows {
        out.push(table.code());
        super::cell::encode_row(&mut out, row);
    }
    out
}

/// Reads what [`pack_rows`] wrote; none when it is anything else.
#[must_use]
pub fn unpack_rows(bytes: &[u8]) -> Option<Vec<(Table, Row)>> {
    let mut bytes = Bytes(bytes);
    let mut rows = Vec::new();
    while !bytes.0.is_empty() {
        let table = Table::from_code(bytes.byte()?)?;
        rows.push((table, table.full(&super::cell::decode_row(&mut bytes)?)?));
    }
    Some(rows)
}
