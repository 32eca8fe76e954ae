//! Bytes read one after another.

use std::io::{Error, ErrorKind, Result};

/// The next `n` bytes.
pub(crate) fn take<'a>(bytes: &mut &'a [u8], n: usize) -> Result<&'a [u8]> {
    let (taken, rest) = bytes
        .split_at_checked(n)
        .ok_or_else(|| Error::new(ErrorKind::UnexpectedEof, "the dictionary is cut off"))?;
    *bytes = rest;
    Ok(taken)
}

/// The next `N` bytes as a number, the lowest first.
pub(crate) fn number<const N: usize>(bytes: &mut &[u8]) -> Result<u64> {
    let taken = take(bytes, N)?;
    Ok(taken.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte)))
}

/// The next bytes, after their number in eight.
pub(crate) fn counted<'a>(bytes: &mut &'a [u8]) -> Result<&'a [u8]> {
    let count = number::<8>(bytes)?;
    take(bytes, usize::try_from(count).map_err(Error::other)?)
}
