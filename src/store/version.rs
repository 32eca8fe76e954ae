//! One version of a record: its row and the stamp that every record bears (paper 2 §1; D3).

use super::cell::{Bytes, Row, decode_row, encode_row, put_bytes, put_signed, put_varint};
use super::error::{Result, StoreError};
use super::tables::Table;
use crate::units::Timestamp;

/// RecDate, RecUser, Deleted, and the revision that wrote them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stamp {
    /// The revision of the map that made this version; for what is not of the map, the one that was current.
    pub revision: u64,
    /// `RecDate`
    pub at: Timestamp,
    /// `RecUser`
    pub user: String,
    /// `Deleted`: the record is gone, but not its past.
    pub deleted: bool,
}

/// A record as it stood from one revision to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Version {
    pub stamp: Stamp,
    pub row: Row,
}

/// What of a version says whether it counts; its checksum was right. The row is read when it is wanted.
pub(crate) struct VersionHead<'b> {
    pub(crate) revision: u64,
    pub(crate) deleted: bool,
    rest: Bytes<'b>,
}

impl<'b> VersionHead<'b> {
    pub(crate) fn decode(table: Table, key: &[u8], bytes: &'b [u8]) -> Result<Self> {
        Self::try_decode(table, key, bytes).ok_or_else(|| bad(table, key))
    }

    fn try_decode(table: Table, key: &[u8], bytes: &'b [u8]) -> Option<Self> {
        let (crc, body) = bytes.split_first_chunk::<4>()?;
        if checksum(table, key, body) != u32::from_be_bytes(*crc) {
            return None;
        }
        let mut rest = Bytes(body);
        let revision = rest.varint()?;
        let deleted = rest.byte()? != 0;
        Some(Self { revision, deleted, rest })
    }

    pub(crate) fn row(mut self, table: Table, key: &[u8]) -> Result<Row> {
        let mut read = || {
            self.rest.signed()?;
            self.rest.slice()?;
            decode_row(&mut self.rest)
        };
        read().ok_or_else(|| bad(table, key))
    }
}

/// A record whose bytes say nothing.
pub(super) fn bad(table: Table, key: &[u8]) -> StoreError {
    StoreError::BadRecord { table: table.name(), key: hex(key) }
}

/// A version's bytes: `crc32 revision flags date user row`; the checksum covers table and key too, so that a value
/// that strayed to another key is found out.
pub(crate) fn encode(table: Table, key: &[u8], stamp: &Stamp, row: &Row) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 + 24 * row.len());
    out.extend([0; 4]);
    put_varint(&mut out, stamp.revision);
    out.push(u8::from(stamp.deleted));
    put_signed(&mut out, stamp.at.0);
    put_bytes(&mut out, stamp.user.as_bytes());
    encode_row(&mut out, row);
    let crc = checksum(table, key, &out[4..]);
    out[..4].copy_from_slice(&crc.to_be_bytes());
    // It stays in memory as it is.
    out.shrink_to_fit();
    out
}

impl Version {
    pub(crate) fn encode(&self, table: Table, key: &[u8]) -> Vec<u8> {
        encode(table, key, &self.stamp, &self.row)
    }

    pub(crate) fn decode(table: Table, key: &[u8], bytes: &[u8]) -> Result<Self> {
        Self::try_decode(table, key, bytes).ok_or_else(|| bad(table, key))
    }

    fn try_decode(table: Table, key: &[u8], bytes: &[u8]) -> Option<Self> {
        let (crc, body) = bytes.split_first_chunk::<4>()?;
        if checksum(table, key, body) != u32::from_be_bytes(*crc) {
            return None;
        }
        let mut body = Bytes(body);
        let revision = body.varint()?;
        let deleted = body.byte()? != 0;
        let at = Timestamp(body.signed()?);
        let user = body.text()?.to_owned();
        let row = decode_row(&mut body)?;
        body.0.is_empty().then_some(Self { stamp: Stamp { revision, at, user, deleted }, row })
    }
}

fn checksum(table: Table, key: &[u8], body: &[u8]) -> u32 {
    let mut crc = crc32fast::Hasher::new();
    crc.update(&[table.code()]);
    crc.update(key);
    crc.update(body);
    crc.finalize()
}

fn hex(key: &[u8]) -> String {
    key.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::super::Cell;
    use super::*;

    #[test]
    fn a_version_comes_back_only_under_its_own_table_and_key() {
        let stamp =
            Stamp { revision: 300, at: Timestamp(-5), user: "Мастер".into(), deleted: true };
        let version = Version { stamp, row: vec![Cell::Int(7), Cell::Text("стул".into())] };
        let bytes = version.encode(Table::Object, b"key");
        assert_eq!(Version::decode(Table::Object, b"key", &bytes).unwrap(), version);
        assert!(Version::decode(Table::Object, b"kez", &bytes).is_err());
        assert!(Version::decode(Table::Area, b"key", &bytes).is_err());
        for bit in 0..bytes.len() * 8 {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(Version::decode(Table::Object, b"key", &flipped).is_err(), "bit {bit}");
        }
    }
}
