//! Cells, rows and keys: how a record becomes bytes and how it is read back.
//!
//! A row is a list of cells in the order of its table's columns, each with a tag of its own. So a row is read
//! without knowing the program that wrote it, and a column added at the end of a table is simply missing from
//! older rows, which then take its default, as with SQLite's `ADD COLUMN`. Beside that the same cells serve the
//! exchange with SQL, the diff in words and the check of a store. A typical
//! replica takes 72 bytes with its stamp; in CBOR with field names it is 147, in JSON 206. A format without tags
//! (postcard) would be some ten bytes shorter still, but could not take a new column.
//!
//! **Invariant**: [`decode_row`] accepts any bytes and never panics; keys sort as their cells do.

use std::fmt;

use crate::units::{Bilingual, Language};

/// One value of a record.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    Null,
    Int(i64),
    Real(f64),
    Text(String),
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => f.write_str("—"),
            Self::Int(n) => write!(f, "{n}"),
            Self::Real(x) => write!(f, "{x}"),
            Self::Text(text) => write!(f, "«{text}»"),
        }
    }
}

impl Cell {
    /// The same with a text in the quotation marks of a language.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        match self {
            Self::Text(text) => Bilingual::quoted(text).say(language).to_owned(),
            other => other.to_string(),
        }
    }
}

/// The cells of one record, in the order of its table's columns.
pub type Row = Vec<Cell>;

/// A type that a record's field may have.
pub(crate) trait Field: Sized {
    const KIND: Kind;
    fn to_cell(&self) -> Cell;
    /// None when the cell holds something else.
    fn from_cell(cell: &Cell) -> Option<Self>;
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// An id or a small count; 4 bytes in a key.
    Id,
    /// 8 bytes in a key.
    Int,
    Real,
    Text,
}

impl Field for u32 {
    const KIND: Kind = Kind::Id;
    fn to_cell(&self) -> Cell {
        Cell::Int(i64::from(*self))
    }
    fn from_cell(cell: &Cell) -> Option<Self> {
        match cell {
            Cell::Int(n) => Self::try_from(*n).ok(),
            _ => None,
        }
    }
}

impl Field for i64 {
    const KIND: Kind = Kind::Int;
    fn to_cell(&self) -> Cell {
        Cell::Int(*self)
    }
    fn from_cell(cell: &Cell) -> Option<Self> {
        match cell {
            Cell::Int(n) => Some(*n),
            _ => None,
        }
    }
}

impl Field for bool {
    const KIND: Kind = Kind::Id;
    fn to_cell(&self) -> Cell {
        Cell::Int(i64::from(*self))
    }
    fn from_cell(cell: &Cell) -> Option<Self> {
        match cell {
            Cell::Int(0) => Some(false),
            Cell::Int(1) => Some(true),
            _ => None,
        }
    }
}

impl Field for f64 {
    const KIND: Kind = Kind::Real;
    fn to_cell(&self) -> Cell {
        Cell::Real(*self)
    }
    fn from_cell(cell: &Cell) -> Option<Self> {
        match cell {
            Cell::Real(x) if x.is_finite() => Some(*x),
            Cell::Int(n) => Some(*n as Self),
            _ => None,
        }
    }
}

impl Field for String {
    const KIND: Kind = Kind::Text;
    fn to_cell(&self) -> Cell {
        Cell::Text(self.clone())
    }
    fn from_cell(cell: &Cell) -> Option<Self> {
        match cell {
            Cell::Text(text) => Some(text.clone()),
            _ => None,
        }
    }
}

impl<T: Field> Field for Option<T> {
    const KIND: Kind = T::KIND;
    fn to_cell(&self) -> Cell {
        self.as_ref().map_or(Cell::Null, T::to_cell)
    }
    fn from_cell(cell: &Cell) -> Option<Self> {
        match cell {
            Cell::Null => Some(None),
            other => T::from_cell(other).map(Some),
        }
    }
}

/// Bytes of a key that grows from its first cell on, so that a prefix of cells is a prefix of bytes.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Key(Vec<u8>);

impl Key {
    /// The empty key: a prefix of all.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    #[must_use]
    pub fn id(mut self, id: u32) -> Self {
        self.0.extend(id.to_be_bytes());
        self
    }

    #[must_use]
    pub fn int(mut self, n: i64) -> Self {
        // The sign bit is turned over, so that negative numbers sort first.
        self.0.extend((n as u64 ^ (1 << 63)).to_be_bytes());
        self
    }

    /// A text ends with 00; a 00 within it becomes 00 FF, so that `"A"` is no prefix of `"AB"`.
    #[must_use]
    pub fn text(mut self, text: &str) -> Self {
        for byte in text.bytes() {
            self.0.push(byte);
            if byte == 0 {
                self.0.push(0xFF);
            }
        }
        self.0.push(0);
        self
    }

    /// Appends a cell in the form that its column's kind asks for; none when the cell does not fit.
    pub(crate) fn cell(self, cell: &Cell, kind: Kind) -> Option<Self> {
        match (kind, cell) {
            (Kind::Id, Cell::Int(n)) => u32::try_from(*n).ok().map(|id| self.id(id)),
            (Kind::Int, Cell::Int(n)) => Some(self.int(*n)),
            (Kind::Text, Cell::Text(text)) => Some(self.text(text)),
            _ => None,
        }
    }

    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.0
    }

    pub(crate) fn from_bytes(bytes: &[u8]) -> Self {
        Self(bytes.to_vec())
    }
}

const NULL: u8 = 0;
const INT: u8 = 1;
const REAL: u8 = 2;
const TEXT: u8 = 3;
/// A whole number of cm or degrees, which most are: shorter than eight bytes.
const WHOLE_REAL: u8 = 4;

pub(crate) fn put_varint(out: &mut Vec<u8>, mut n: u64) {
    while n >= 0x80 {
        out.push(n as u8 | 0x80);
        n >>= 7;
    }
    out.push(n as u8);
}

pub(crate) fn put_signed(out: &mut Vec<u8>, n: i64) {
    put_varint(out, ((n << 1) ^ (n >> 63)) as u64);
}

pub(crate) fn put_bytes(out: &mut Vec<u8>, bytes: &[u8]) {
    put_varint(out, bytes.len() as u64);
    out.extend(bytes);
}

/// Takes numbers and texts off the front of some bytes; `None` as soon as they do not fit.
pub(crate) struct Bytes<'a>(pub(crate) &'a [u8]);

impl<'a> Bytes<'a> {
    pub(crate) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (head, tail) = self.0.split_at_checked(count)?;
        self.0 = tail;
        Some(head)
    }

    pub(crate) fn byte(&mut self) -> Option<u8> {
        self.take(1).map(|b| b[0])
    }

    pub(crate) fn fixed<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    pub(crate) fn varint(&mut self) -> Option<u64> {
        let mut n = 0u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            let bits = u64::from(byte & 0x7F);
            if shift == 63 && bits > 1 {
                return None;
            }
            n |= bits << shift;
            if byte & 0x80 == 0 {
                return Some(n);
            }
        }
        None
    }

    pub(crate) fn signed(&mut self) -> Option<i64> {
        self.varint().map(|n| (n >> 1) as i64 ^ -((n & 1) as i64))
    }

    pub(crate) fn slice(&mut self) -> Option<&'a [u8]> {
        let count = usize::try_from(self.varint()?).ok()?;
        self.take(count)
    }

    pub(crate) fn text(&mut self) -> Option<&'a str> {
        std::str::from_utf8(self.slice()?).ok()
    }
}

pub(crate) fn encode_row(out: &mut Vec<u8>, row: &[Cell]) {
    put_varint(out, row.len() as u64);
    for cell in row {
        match cell {
            Cell::Null => out.push(NULL),
            Cell::Int(n) => {
                out.push(INT);
                put_signed(out, *n);
            }
            Cell::Real(x) if is_whole(*x) => {
                out.push(WHOLE_REAL);
                put_signed(out, *x as i64);
            }
            Cell::Real(x) => {
                out.push(REAL);
                out.extend(x.to_be_bytes());
            }
            Cell::Text(text) => {
                out.push(TEXT);
                put_bytes(out, text.as_bytes());
            }
        }
    }
}

/// Whether an `i64` gives back these very bits; not so for -0.0, whose sign must live.
fn is_whole(x: f64) -> bool {
    x.abs() < 1e9 && (x as i64 as f64).to_bits() == x.to_bits()
}

pub(crate) fn decode_row(bytes: &mut Bytes) -> Option<Row> {
    let count = usize::try_from(bytes.varint()?).ok()?;
    // A count from broken bytes must not reserve memory: each cell takes a byte at least.
    if count > bytes.0.len() {
        return None;
    }
    let mut row = Vec::with_capacity(count.min(32));
    for _ in 0..count {
        row.push(match bytes.byte()? {
            NULL => Cell::Null,
            INT => Cell::Int(bytes.signed()?),
            REAL => Cell::Real(f64::from_be_bytes(bytes.fixed()?)),
            TEXT => Cell::Text(bytes.text()?.to_owned()),
            WHOLE_REAL => Cell::Real(bytes.signed()? as f64),
            _ => return None,
        });
    }
    Some(row)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn cells() -> impl Strategy<Value = Cell> {
        prop_oneof![
            Just(Cell::Null),
            any::<i64>().prop_map(Cell::Int),
            any::<f64>().prop_filter("NaN equals nothing", |x| !x.is_nan()).prop_map(Cell::Real),
            (-1000..1000i32).prop_map(|n| Cell::Real(f64::from(n) / 2.0)),
            any::<String>().prop_map(Cell::Text),
        ]
    }

    proptest! {
        #[test]
        fn a_row_comes_back_bit_for_bit(row in prop::collection::vec(cells(), 0..20)) {
            let mut out = Vec::new();
            encode_row(&mut out, &row);
            let mut bytes = Bytes(&out);
            let back = decode_row(&mut bytes).unwrap();
            prop_assert!(bytes.0.is_empty());
            prop_assert_eq!(format!("{:?}", &back), format!("{:?}", &row)); // tells -0.0 from 0.0
        }

        #[test]
        fn rubbish_is_refused_quietly(rubbish in prop::collection::vec(any::<u8>(), 0..60)) {
            let _ = decode_row(&mut Bytes(&rubbish));
        }

        #[test]
        fn keys_sort_as_their_cells(a: (u32, String, i64), b: (u32, String, i64)) {
            let key = |(id, text, n): &(u32, String, i64)| Key::new().id(*id).text(text).int(*n);
            prop_assert_eq!(key(&a).cmp(&key(&b)), a.cmp(&b));
        }
    }

    #[test]
    fn a_text_is_no_prefix_of_a_longer_one() {
        let longer = Key::new().id(7).text("AB");
        assert!(!longer.as_bytes().starts_with(Key::new().id(7).text("A").as_bytes()));
        assert!(longer.as_bytes().starts_with(Key::new().id(7).as_bytes()));
    }
}
