//! The keys that a revision touched, as bytes.

use super::cell::{Bytes, Key, put_bytes};
use super::tables::Table;

/// The keys that a revision touched, in pieces that sled keeps within its pages.
pub(crate) fn encode_touched<'a>(keys: impl Iterator<Item = &'a (Table, Key)>) -> Vec<Vec<u8>> {
    const PIECE: usize = 16 << 10;
    let mut pieces = vec![Vec::new()];
    for (table, key) in keys {
        if pieces.last().is_some_and(|p| p.len() > PIECE) {
            pieces.push(Vec::new());
        }
        let piece = pieces.last_mut().expect("there is always a piece");
        piece.push(table.code());
        put_bytes(piece, key.as_bytes());
    }
    for piece in &mut pieces {
        let crc = crc32fast::hash(piece);
        piece.extend(crc.to_be_bytes());
    }
    pieces
}

pub(super) fn decode_touched(bytes: &[u8]) -> Option<Vec<(Table, Key)>> {
    let (body, crc) = bytes.split_last_chunk::<4>()?;
    if crc32fast::hash(body) != u32::from_be_bytes(*crc) {
        return None;
    }
    let mut bytes = Bytes(body);
    let mut keys = Vec::new();
    while !bytes.0.is_empty() {
        let table = Table::from_code(bytes.byte()?)?;
        keys.push((table, Key::from_bytes(bytes.slice()?)));
    }
    Some(keys)
}
