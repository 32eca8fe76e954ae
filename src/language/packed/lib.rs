//! The dictionary of Russian word forms, carried compressed: 13 MB less of a program.

use std::io::{Error, Read as _, Result};

/// The dictionary as its crate publishes it.
///
/// # Errors
///
/// What the decoder says of bytes that are none of its.
pub fn unpacked() -> Result<Vec<u8>> {
    const PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/ru.dict.zst"));
    let mut bytes = Vec::new();
    let frame = ruzstd::decoding::StreamingDecoder::new(PACKED);
    frame.map_err(Error::other)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    #[test]
    fn what_is_carried_is_the_dictionary_as_it_was_published() {
        assert!(super::unpacked().expect("a whole frame") == rumorph_dict_ru::DICTIONARY);
    }
}
