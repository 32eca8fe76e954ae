//! Bytes of a foreign file → text: limits and encodings.
//!
//! Exporters write UTF-8 with and without a mark, UTF-16 with one, and in Russia Windows-1251. A text that is none of
//! the first is taken for the last; a byte that stands in no text of either is refused with its place.

use std::path::Path;

use crate::units::{FileFault, Source, read_file};

use super::error::ReadError;

/// A file larger than this is refused before it is read.
pub const LARGEST: u64 = 256 << 20;

/// The bytes of a file, at most [`LARGEST`].
///
/// # Errors
/// [`ReadError::Unreadable`], [`ReadError::TooLarge`].
pub fn file_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    read_file(path, LARGEST).map_err(|fault| match fault {
        FileFault::TooLarge { bytes, limit } => ReadError::TooLarge { bytes, limit },
        other => ReadError::unreadable(path)(other.into_io()),
    })
}

/// The text of a file.
///
/// # Errors
/// As [`file_bytes`]; [`ReadError::NotText`].
pub fn file_text(path: &Path) -> Result<Source, ReadError> {
    decode(&path.to_string_lossy(), file_bytes(path)?)
}

/// The text that some bytes stand for.
///
/// # Errors
/// [`ReadError::NotText`].
pub fn decode(name: &str, bytes: Vec<u8>) -> Result<Source, ReadError> {
    if let Some((encoding, mark)) = encoding_rs::Encoding::for_bom(&bytes) {
        let (text, broken) = encoding.decode_without_bom_handling(&bytes[mark..]);
        if broken {
            return Err(not_text(name, &bytes));
        }
        return Ok(Source::new(name, text));
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Err(ReadError::Archive { name: name.to_owned() });
    }
    // PNG, JPEG, binary PGM; GIF, BMP and WebP begin with letters and go on with zeros.
    const PICTURES: [&[u8]; 6] = [b"\x89PNG", b"\xFF\xD8\xFF", b"P5", b"GIF8", b"BM", b"RIFF"];
    let not_control = |b: &u8| *b >= 0x20 || matches!(b, b'\t' | b'\n' | b'\r' | 0x0C | 0x1A);
    if let Some(at) = bytes.iter().position(|b| !not_control(b)) {
        if PICTURES.iter().any(|magic| bytes.starts_with(magic)) {
            return Err(ReadError::Picture { name: name.to_owned() });
        }
        return Err(ReadError::NotText { name: name.to_owned(), at, byte: bytes[at] });
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(name, text)),
        Err(e) => {
            let at = e.utf8_error().valid_up_to();
            let bytes = e.into_bytes();
            let (text, broken) = encoding_rs::WINDOWS_1251.decode_without_bom_handling(&bytes);
            if broken {
                return Err(ReadError::NotText { name: name.to_owned(), at, byte: bytes[at] });
            }
            Ok(Source::new(name, text))
        }
    }
}

fn not_text(name: &str, bytes: &[u8]) -> ReadError {
    let at = std::str::from_utf8(bytes).err().map_or(0, |e| e.valid_up_to());
    ReadError::NotText { name: name.to_owned(), at, byte: bytes.get(at).copied().unwrap_or(0) }
}
