//! Bytes of files become text, or are refused.

use orthoframe_exchange::decode;

fn text_of(bytes: &[u8]) -> String {
    decode("файл", bytes.to_vec()).map_or_else(|e| e.to_string(), |s| s.text().to_owned())
}

#[test]
fn the_encodings_that_exporters_write_are_told_apart() {
    let word = "Кухня";
    let utf16 = |swap: bool| -> Vec<u8> {
        std::iter::once(0xFEFF)
            .chain(word.encode_utf16())
            .flat_map(|u| if swap { u.to_be_bytes() } else { u.to_le_bytes() })
            .collect()
    };
    assert_eq!(text_of(word.as_bytes()), word);
    assert_eq!(text_of(&["\u{FEFF}".as_bytes(), word.as_bytes()].concat()), word);
    assert_eq!(text_of(&utf16(false)), word);
    assert_eq!(text_of(&utf16(true)), word);
    assert_eq!(text_of(&[0xCA, 0xF3, 0xF5, 0xED, 0xFF]), word); // Windows-1251
}

#[test]
fn what_is_no_text_is_refused_with_its_place() {
    assert_eq!(text_of(b"PK\x03\x04"), "«файл» – архив ZIP");
    let picture = "«файл» – картинка, а масштаба она не говорит";
    assert_eq!(text_of(b"\x89PNG\r\n\x1a\n\0"), picture);
    assert_eq!(text_of(b"P5\n2 1\n255\n\0\xff"), picture);
    assert_eq!(text_of(b"PK\x05\x06"), "«файл» – не текст: байт 2 равен 0x05");
    assert_eq!(text_of(b""), "");
}
