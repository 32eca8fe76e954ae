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
    if let Some(marked) = marked(&bytes) {
        let text = marked.ok_or_else(|| not_text(name, &bytes))?;
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
        return Err(ReadError::NotText { name: name.to_owned(), at, byte: hex(bytes[at]) });
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(name, text)),
        Err(e) => {
            let text: String = e.as_bytes().iter().map(|byte| windows_1251(*byte)).collect();
            Ok(Source::new(name, text))
        }
    }
}

/// The text of bytes that begin with a mark of their encoding; none inside where they are not of it.
fn marked(bytes: &[u8]) -> Option<Option<String>> {
    let utf_16 = |rest: &[u8], unit: fn([u8; 2]) -> u16| {
        let (units, rest) = rest.as_chunks();
        let text = char::decode_utf16(units.iter().copied().map(unit)).collect::<Result<_, _>>();
        text.ok().filter(|_| rest.is_empty())
    };
    match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => Some(String::from_utf8(rest.to_vec()).ok()),
        [0xFF, 0xFE, rest @ ..] => Some(utf_16(rest, u16::from_le_bytes)),
        [0xFE, 0xFF, rest @ ..] => Some(utf_16(rest, u16::from_be_bytes)),
        _ => None,
    }
}

/// The sign that a byte is in Windows-1251. A crate that has the tables of all encodings would be a third of a megabyte.
fn windows_1251(byte: u8) -> char {
    /// From 0x80 to 0xBF; the Russian letters follow in their order.
    const SIGNS: [char; 64] = [
        'Ђ', 'Ѓ', '‚', 'ѓ', '„', '…', '†', '‡', '€', '‰', 'Љ', '‹', 'Њ', 'Ќ', 'Ћ', 'Џ', 'ђ', '‘',
        '’', '“', '”', '•', '–', '—', '\u{98}', '™', 'љ', '›', 'њ', 'ќ', 'ћ', 'џ', '\u{a0}', 'Ў',
        'ў', 'Ј', '¤', 'Ґ', '¦', '§', 'Ё', '©', 'Є', '«', '¬', '\u{ad}', '®', 'Ї', '°', '±', 'І',
        'і', 'ґ', 'µ', '¶', '·', 'ё', '№', 'є', '»', 'ј', 'Ѕ', 'ѕ', 'ї',
    ];
    match byte {
        0..0x80 => char::from(byte),
        0x80..0xC0 => SIGNS[usize::from(byte - 0x80)],
        _ => char::from_u32(u32::from('А') + u32::from(byte - 0xC0)).expect("a letter up to я"),
    }
}

fn not_text(name: &str, bytes: &[u8]) -> ReadError {
    let at = std::str::from_utf8(bytes).err().map_or(0, |e| e.valid_up_to());
    ReadError::NotText { name: name.to_owned(), at, byte: hex(bytes.get(at).copied().unwrap_or(0)) }
}

fn hex(byte: u8) -> String {
    format!("{byte:#04x}")
}

#[cfg(test)]
mod tests {
    use encoding_rs::{Encoding, WINDOWS_1251};

    use super::*;

    #[test]
    fn bytes_are_read_as_encoding_rs_reads_them() {
        for byte in 0..=u8::MAX {
            let (sign, _) = WINDOWS_1251.decode_without_bom_handling(std::slice::from_ref(&byte));
            assert_eq!(windows_1251(byte).to_string(), sign, "{byte:#x}");
        }
        let marks: [&[u8]; 5] = [b"\xEF\xBB\xBF", b"\xFF\xFE", b"\xFE\xFF", b"\xEF\xBB", b""];
        // Letters in UTF-8, halves of pairs and whole pairs in UTF-16, in every order of a few.
        let parts: [&[u8]; 6] =
            [b"a", "я".as_bytes(), b"\xD8\x3D", b"\xDE\x00", b"\x3D\xD8", b"\x00\xDE"];
        for number in 0..6_usize.pow(4) {
            let chosen = (0..4).map(|place| parts[number / 6_usize.pow(place) % 6]);
            let rest: Vec<u8> = chosen.take(number % 5).flatten().copied().collect();
            for mark in marks {
                let bytes = [mark, &rest].concat();
                let read = Encoding::for_bom(&bytes).map(|(encoding, mark)| {
                    let (text, broken) = encoding.decode_without_bom_handling(&bytes[mark..]);
                    (!broken).then(|| text.into_owned())
                });
                assert_eq!(marked(&bytes), read, "{bytes:x?}");
            }
        }
    }
}
