//! Frames: the checksummed pieces of which journal and snapshots consist.
//!
//! ```text
//! file   := magic[8] version:u32 lsn:u64 crc:u32  frame*
//! frame  := "OFJ\x01" length:u32 crc:u32 lsn:u64 payload[length]      crc over length, lsn, payload
//! payload:= count (tree key has_value value?)*  count (tree records:u64 sum:u64)*
//! ```
//! Numbers are big-endian; lengths within a payload are varints. The second list of a payload is the digests
//! of the trees touched, as they are after the frame.
//!
//! **Invariant**: [`scan`] accepts any bytes; what it returns as frames passed their checksums.

use std::collections::BTreeMap;
use std::ops::Range;

use super::cell::{Bytes, put_bytes, put_varint};

/// Version of all that is written here.
pub(crate) const FORMAT: u32 = 1;
pub(crate) const JOURNAL: &[u8; 8] = b"ORTHOJNL";
pub(crate) const SNAPSHOT: &[u8; 8] = b"ORTHOSNP";
pub(crate) const RUN: &[u8; 8] = b"ORTHORUN";
pub(crate) const FILE_HEADER: usize = 24;
const FRAME_MAGIC: &[u8; 4] = b"OFJ\x01";
pub(crate) const FRAME_HEADER: usize = 20;

/// One record put or removed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Op {
    pub(crate) tree: u8,
    pub(crate) key: Vec<u8>,
    pub(crate) value: Option<Vec<u8>>,
}

/// Number and checksum of the records of a tree, whatever their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Digest {
    pub(crate) records: u64,
    pub(crate) sum: u64,
}

impl Digest {
    pub(crate) fn add(&mut self, key: &[u8], value: &[u8]) {
        self.records = self.records.wrapping_add(1);
        self.sum = self.sum.wrapping_add(Self::of(key, value));
    }

    pub(crate) fn remove(&mut self, key: &[u8], value: &[u8]) {
        self.records = self.records.wrapping_sub(1);
        self.sum = self.sum.wrapping_sub(Self::of(key, value));
    }

    fn of(key: &[u8], value: &[u8]) -> u64 {
        let mut crc = crc32fast::Hasher::new();
        crc.update(key);
        crc.update(value);
        // Spread over 64 bits, so that sums of many do not meet by chance.
        (u64::from(crc.finalize()) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }
}

pub(crate) type Digests = BTreeMap<u8, Digest>;

/// What a frame says.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Payload {
    pub(crate) ops: Vec<Op>,
    pub(crate) digests: Digests,
}

pub(crate) fn encode_digests(out: &mut Vec<u8>, digests: &Digests) {
    put_varint(out, digests.len() as u64);
    for (tree, digest) in digests {
        out.push(*tree);
        out.extend(digest.records.to_be_bytes());
        out.extend(digest.sum.to_be_bytes());
    }
}

pub(crate) fn decode_digests(bytes: &mut Bytes) -> Option<Digests> {
    let count = bytes.varint()?;
    (0..count)
        .map(|_| {
            let tree = bytes.byte()?;
            let records = u64::from_be_bytes(bytes.fixed()?);
            Some((tree, Digest { records, sum: u64::from_be_bytes(bytes.fixed()?) }))
        })
        .collect()
}

impl Payload {
    pub(crate) fn decode(bytes: &[u8]) -> Option<Self> {
        let mut bytes = Bytes(bytes);
        let count = bytes.varint()?;
        let ops = (0..count)
            .map(|_| {
                let tree = bytes.byte()?;
                let key = bytes.slice()?.to_vec();
                let value = match bytes.byte()? {
                    0 => None,
                    1 => Some(bytes.slice()?.to_vec()),
                    _ => return None,
                };
                Some(Op { tree, key, value })
            })
            .collect::<Option<_>>()?;
        let digests = decode_digests(&mut bytes)?;
        bytes.0.is_empty().then_some(Self { ops, digests })
    }
}

/// The head of a journal or snapshot file.
pub(crate) fn file_header(magic: &[u8; 8], lsn: u64) -> Vec<u8> {
    let mut out = magic.to_vec();
    out.extend(FORMAT.to_be_bytes());
    out.extend(lsn.to_be_bytes());
    let crc = crc32fast::hash(&out);
    out.extend(crc.to_be_bytes());
    out
}

/// A whole frame.
pub(crate) fn encode_frame(lsn: u64, ops: &[Op], digests: &Digests) -> Vec<u8> {
    let size: usize =
        ops.iter().map(|o| o.key.len() + o.value.as_ref().map_or(0, Vec::len) + 8).sum();
    let mut out = Vec::with_capacity(FRAME_HEADER + size + 20 * digests.len() + 16);
    out.extend([0; FRAME_HEADER]);
    put_varint(&mut out, ops.len() as u64);
    for op in ops {
        out.push(op.tree);
        put_bytes(&mut out, &op.key);
        out.push(u8::from(op.value.is_some()));
        if let Some(value) = &op.value {
            put_bytes(&mut out, value);
        }
    }
    encode_digests(&mut out, digests);
    let length = (out.len() - FRAME_HEADER) as u32;
    out[..4].copy_from_slice(FRAME_MAGIC);
    out[4..8].copy_from_slice(&length.to_be_bytes());
    out[12..20].copy_from_slice(&lsn.to_be_bytes());
    let crc = frame_crc(&out);
    out[8..12].copy_from_slice(&crc.to_be_bytes());
    out
}

fn frame_crc(frame: &[u8]) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    crc.update(&frame[4..8]);
    crc.update(&frame[12..]);
    crc.finalize()
}

/// How a file ends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Tail {
    Whole,
    /// What follows `Scan::good` is no frame, nor is there one after it: a write that was cut short.
    Torn,
    /// What follows `Scan::good` is broken, yet a whole frame stands after it.
    Corrupt,
}

/// What a journal or snapshot file holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Scan {
    /// The number in the file's head.
    pub(crate) lsn: u64,
    /// Where the payloads are, with their sequence numbers.
    pub(crate) frames: Vec<(u64, Range<usize>)>,
    /// Length of the part that passed its checksums.
    pub(crate) good: usize,
    pub(crate) tail: Tail,
}

/// Why a file cannot be scanned at all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum HeadError {
    /// Shorter than a head: its creation was cut short.
    Short,
    Broken,
    Format(u32),
}

/// The format that the head of a journal or snapshot states, if that head is whole.
pub(crate) fn format_stated(bytes: &[u8]) -> Option<u32> {
    let (head, crc) = bytes.get(..FILE_HEADER)?.split_last_chunk::<4>()?;
    let is_ours = head.starts_with(JOURNAL) || head.starts_with(SNAPSHOT);
    let is_whole = is_ours && crc32fast::hash(head) == u32::from_be_bytes(*crc);
    is_whole.then(|| u32::from_be_bytes(head[8..12].try_into().expect("four bytes")))
}

pub(crate) fn scan(bytes: &[u8], magic: &[u8; 8]) -> Result<Scan, HeadError> {
    let Some(head) = bytes.get(..FILE_HEADER) else { return Err(HeadError::Short) };
    let number = |at: usize| u32::from_be_bytes(head[at..at + 4].try_into().expect("four bytes"));
    if crc32fast::hash(&head[..20]) != number(20) || &head[..8] != magic {
        return Err(HeadError::Broken);
    }
    if number(8) != FORMAT {
        return Err(HeadError::Format(number(8)));
    }
    let lsn = u64::from_be_bytes(head[12..20].try_into().expect("eight bytes"));
    let mut scan = Scan { lsn, frames: Vec::new(), good: FILE_HEADER, tail: Tail::Whole };
    while scan.good < bytes.len() {
        let Some((lsn, length)) = frame_at(bytes, scan.good) else {
            let later = (scan.good + 1..bytes.len())
                .any(|at| bytes[at..].starts_with(FRAME_MAGIC) && frame_at(bytes, at).is_some());
            scan.tail = if later { Tail::Corrupt } else { Tail::Torn };
            break;
        };
        let start = scan.good + FRAME_HEADER;
        scan.frames.push((lsn, start..start + length));
        scan.good = start + length;
    }
    Ok(scan)
}

/// Sequence number and payload length of the whole frame with which some bytes begin.
pub(crate) fn decode_frame(bytes: &[u8]) -> Option<(u64, usize)> {
    frame_at(bytes, 0)
}

/// Sequence number and payload length of the whole frame that begins here.
fn frame_at(bytes: &[u8], at: usize) -> Option<(u64, usize)> {
    let rest = &bytes[at..];
    let head = rest.get(..FRAME_HEADER)?;
    if &head[..4] != FRAME_MAGIC {
        return None;
    }
    let length = u32::from_be_bytes(head[4..8].try_into().ok()?) as usize;
    let crc = u32::from_be_bytes(head[8..12].try_into().ok()?);
    let frame = rest.get(..FRAME_HEADER.checked_add(length)?)?;
    let lsn = u64::from_be_bytes(head[12..20].try_into().ok()?);
    (frame_crc(frame) == crc).then_some((lsn, length))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn op(key: u8, value: Option<&[u8]>) -> Op {
        Op { tree: 18, key: vec![key], value: value.map(<[u8]>::to_vec) }
    }

    fn journal() -> Vec<u8> {
        let mut file = file_header(JOURNAL, 7);
        for lsn in 7..10 {
            let digests = Digests::from([(18, Digest { records: lsn, sum: 5 })]);
            file.extend(encode_frame(lsn, &[op(lsn as u8, Some(b"abc")), op(1, None)], &digests));
        }
        file
    }

    #[test]
    fn frames_come_back() {
        let file = journal();
        let scan = scan(&file, JOURNAL).unwrap();
        assert_eq!((scan.lsn, scan.good, &scan.tail), (7, file.len(), &Tail::Whole));
        assert_eq!(scan.frames.iter().map(|(lsn, _)| *lsn).collect::<Vec<_>>(), [7, 8, 9]);
        let payload = Payload::decode(&file[scan.frames[1].1.clone()]).unwrap();
        assert_eq!(payload.ops, [op(8, Some(b"abc")), op(1, None)]);
        assert_eq!(payload.digests[&18].records, 8);
    }

    #[test]
    fn a_torn_tail_is_no_corruption_but_a_hole_is() {
        let file = journal();
        let frame = (file.len() - FILE_HEADER) / 3;
        for cut in 1..frame {
            let scan = scan(&file[..file.len() - cut], JOURNAL).unwrap();
            assert_eq!((scan.frames.len(), scan.tail), (2, Tail::Torn), "{cut}");
        }
        let mut holed = file;
        holed[FILE_HEADER + frame + FRAME_HEADER] ^= 1;
        let scan = scan(&holed, JOURNAL).unwrap();
        assert_eq!((scan.frames.len(), scan.tail), (1, Tail::Corrupt));
    }

    #[test]
    fn every_flipped_bit_is_noticed() {
        let file = journal();
        let whole = scan(&file, JOURNAL).unwrap();
        for bit in 0..file.len() * 8 {
            let mut flipped = file.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert_ne!(scan(&flipped, JOURNAL).as_ref(), Ok(&whole), "bit {bit}");
        }
    }

    #[test]
    fn an_unknown_format_is_refused_by_its_number() {
        let mut file = file_header(JOURNAL, 7);
        file[11] = 9;
        let crc = crc32fast::hash(&file[..20]);
        file[20..24].copy_from_slice(&crc.to_be_bytes());
        assert_eq!(scan(&file, JOURNAL), Err(HeadError::Format(9)));
        assert_eq!(scan(b"ORTHO", JOURNAL), Err(HeadError::Short));
        assert_eq!(scan(&[0; 100], JOURNAL), Err(HeadError::Broken));
    }

    proptest! {
        #[test]
        fn rubbish_is_no_journal(rubbish in prop::collection::vec(any::<u8>(), 0..200)) {
            let mut file = file_header(JOURNAL, 1);
            file.extend(&rubbish);
            prop_assert!(scan(&file, JOURNAL).unwrap().frames.is_empty());
            let _ = Payload::decode(&rubbish);
        }
    }
}
