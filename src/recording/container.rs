//! The container that recordings are kept in: MCAP, version 0 (<https://mcap.dev/spec>), as far as a mission needs it.
//!
//! A file is a magic, records, and the magic again; a record is a letter, the length of what follows as a `u64`, and that.
//! Numbers are little-endian. Messages stand in chunks, not compressed; a summary at the end tells where. The crate `mcap`
//! does the same with fifteen packages more, which need syn in full below every derive of this program.

use std::collections::BTreeMap;

pub(super) const MAGIC: &[u8; 8] = b"\x89MCAP0\r\n";

/// What a record is, by its first byte.
pub(super) mod op {
    pub(crate) const HEADER: u8 = 0x01;
    pub(crate) const FOOTER: u8 = 0x02;
    pub(crate) const SCHEMA: u8 = 0x03;
    pub(crate) const CHANNEL: u8 = 0x04;
    pub(crate) const MESSAGE: u8 = 0x05;
    pub(crate) const CHUNK: u8 = 0x06;
    pub(crate) const MESSAGE_INDEX: u8 = 0x07;
    pub(crate) const CHUNK_INDEX: u8 = 0x08;
    pub(crate) const ATTACHMENT: u8 = 0x09;
    pub(crate) const ATTACHMENT_INDEX: u8 = 0x0a;
    pub(crate) const STATISTICS: u8 = 0x0b;
    pub(crate) const METADATA: u8 = 0x0c;
    pub(crate) const METADATA_INDEX: u8 = 0x0d;
    pub(crate) const DATA_END: u8 = 0x0f;
}

/// The fields of a record, put one after the other.
#[derive(Debug, Default)]
pub(super) struct Fields(pub(super) Vec<u8>);

impl Fields {
    pub(super) fn u16(mut self, value: u16) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn u32(mut self, value: u32) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn u64(mut self, value: u64) -> Self {
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(super) fn text(self, text: &str) -> Self {
        self.bytes(text.as_bytes())
    }

    /// With their length before them: texts, tables, schemas are shorter than 4 GiB.
    pub(super) fn bytes(mut self, bytes: &[u8]) -> Self {
        self = self.u32(u32::try_from(bytes.len()).unwrap_or(u32::MAX));
        self.rest(bytes)
    }

    /// As they are.
    pub(super) fn rest(mut self, bytes: &[u8]) -> Self {
        self.0.extend(bytes);
        self
    }

    pub(super) fn texts(self, table: &BTreeMap<String, String>) -> Self {
        let put = |fields: Self, (key, value): (&String, &String)| fields.text(key).text(value);
        let table = table.iter().fold(Self::default(), put);
        self.bytes(&table.0)
    }

    pub(super) fn record(self, op: u8) -> Vec<u8> {
        let mut record = vec![op];
        record.extend((self.0.len() as u64).to_le_bytes());
        record.extend(self.0);
        record
    }
}

/// Why bytes are no whole record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Torn {
    /// They end before it does.
    Short,
    /// What stands in it contradicts itself.
    Broken,
}

/// Reads fields one after the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reader<'b>(pub(super) &'b [u8]);

impl<'b> Reader<'b> {
    pub(super) fn take(&mut self, count: u64) -> Result<&'b [u8], Torn> {
        let count = usize::try_from(count).map_err(|_error| Torn::Short)?;
        let (taken, rest) = self.0.split_at_checked(count).ok_or(Torn::Short)?;
        self.0 = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Torn> {
        let taken = self.take(N as u64)?;
        Ok(taken.try_into().expect("so many were taken"))
    }

    pub(super) fn u16(&mut self) -> Result<u16, Torn> {
        self.array().map(u16::from_le_bytes)
    }

    pub(super) fn u32(&mut self) -> Result<u32, Torn> {
        self.array().map(u32::from_le_bytes)
    }

    pub(super) fn u64(&mut self) -> Result<u64, Torn> {
        self.array().map(u64::from_le_bytes)
    }

    pub(super) fn bytes(&mut self) -> Result<&'b [u8], Torn> {
        let count = self.u32()?;
        self.take(count.into())
    }

    pub(super) fn text(&mut self) -> Result<&'b str, Torn> {
        std::str::from_utf8(self.bytes()?).map_err(|_error| Torn::Broken)
    }

    pub(super) fn texts(&mut self) -> Result<BTreeMap<String, String>, Torn> {
        let mut table = Self(self.bytes()?);
        let mut texts = BTreeMap::new();
        while !table.0.is_empty() {
            texts.insert(table.text()?.to_owned(), table.text()?.to_owned());
        }
        Ok(texts)
    }

    /// The next record: what it is, and its fields.
    pub(super) fn record(&mut self) -> Result<(u8, Self), Torn> {
        let [op] = self.array()?;
        let length = self.u64()?;
        Ok((op, Self(self.take(length)?)))
    }
}
