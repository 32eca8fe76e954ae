//! The picture of a grid: PGM, plain (P2) and binary (P5), or PNG. Rows run downwards.

use crate::ReadError;
use crate::units::{Bilingual, said, word};

use super::{FORMAT, MOST_CELLS};

/// Lightness 0..=1 and whether a pixel is transparent.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Picture {
    pub width: usize,
    pub height: usize,
    /// 0..=255, scaled from whatever the file has.
    pub grey: Vec<u8>,
    /// Empty when nothing is transparent.
    pub is_clear: Vec<bool>,
}

pub(super) fn read(bytes: &[u8]) -> Result<Picture, ReadError> {
    match bytes {
        [b'P', b'2' | b'5', ..] => pgm(bytes),
        [0x89, b'P', b'N', b'G', ..] => png(bytes),
        _ => Err(fault(0, word!("the-picture-is-neither-pgm"))),
    }
}

fn fault(at: usize, what: impl Into<Bilingual>) -> ReadError {
    ReadError::Bytes { format: FORMAT, what: what.into(), at }
}

fn cells(width: usize, height: usize) -> Result<usize, ReadError> {
    match width.checked_mul(height) {
        Some(0) => Err(fault(0, word!("the-picture-is-empty"))),
        Some(cells) if cells <= MOST_CELLS => Ok(cells),
        _ => Err(ReadError::TooMany { format: FORMAT, what: said!("cells"), limit: MOST_CELLS }),
    }
}

/// Netpbm's grey map. Comments run from `#` to the end of the line, in the header and in plain rasters.
fn pgm(bytes: &[u8]) -> Result<Picture, ReadError> {
    let is_plain = bytes[1] == b'2';
    let mut at = 2;
    let number = |at: &mut usize| -> Result<usize, ReadError> {
        loop {
            match bytes.get(*at) {
                Some(b'#') => {
                    while bytes.get(*at).is_some_and(|b| *b != b'\n') {
                        *at += 1;
                    }
                }
                Some(b) if b.is_ascii_whitespace() => *at += 1,
                Some(b) if b.is_ascii_digit() => break,
                Some(_) => {
                    return Err(fault(*at, word!("a-number-must-stand-here")));
                }
                None => return Err(fault(*at, word!("the-file-is-cut-off-2"))),
            }
        }
        let mut n = 0_usize;
        while let Some(digit) = bytes.get(*at).filter(|b| b.is_ascii_digit()) {
            n = n.saturating_mul(10).saturating_add(usize::from(digit - b'0'));
            *at += 1;
        }
        Ok(n)
    };
    let (width, height, most) = (number(&mut at)?, number(&mut at)?, number(&mut at)?);
    if !(1..=65_535).contains(&most) {
        return Err(fault(at, said!("the-largest-grey-value-is", most)));
    }
    let cells = cells(width, height)?;
    let scaled = |n: usize| (n.min(most) * 255 / most) as u8;
    let mut grey = Vec::new();
    if is_plain {
        // Each number takes two bytes at least: a raster that cannot fit is refused before memory is taken.
        if bytes.len().saturating_sub(at) < cells {
            return Err(fault(bytes.len(), word!("the-file-is-cut-off-there")));
        }
        grey.reserve_exact(cells);
        for _ in 0..cells {
            grey.push(scaled(number(&mut at)?));
        }
    } else {
        // One blank stands between header and raster.
        let raster = bytes.get(at + 1..).unwrap_or_default();
        let wide = if most > 255 { 2 } else { 1 };
        let Some(raster) = raster.get(..cells * wide) else {
            let have = raster.len() / wide;
            return Err(fault(bytes.len(), said!("the-file-is-cut-off", have, cells)));
        };
        grey = if wide == 1 {
            raster.iter().map(|b| scaled(usize::from(*b))).collect()
        } else {
            let pair = |p: &[u8]| scaled(usize::from(u16::from_be_bytes([p[0], p[1]])));
            raster.chunks_exact(2).map(pair).collect()
        };
    }
    Ok(Picture { width, height, grey, is_clear: Vec::new() })
}

fn png(bytes: &[u8]) -> Result<Picture, ReadError> {
    let wrong = |e: png::DecodingError| fault(0, format!("PNG: {e}"));
    let limits = png::Limits { bytes: MOST_CELLS * 4 };
    let mut decoder = png::Decoder::new_with_limits(std::io::Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let cells = cells(width, height)?;
    let size = reader.output_buffer_size().ok_or_else(|| fault(0, word!("png-too-large")))?;
    if size > MOST_CELLS * 4 {
        return Err(ReadError::TooMany { format: FORMAT, what: said!("cells"), limit: MOST_CELLS });
    }
    let mut raw = vec![0; size];
    let info = reader.next_frame(&mut raw).map_err(wrong)?;
    let channels = info.color_type.samples();
    let colours = if channels > 2 { 3 } else { 1 };
    let has_alpha = matches!(channels, 2 | 4);
    let pixels = || raw.chunks_exact(channels).take(cells);
    // Coloured pictures are averaged, as map_server does.
    let mean =
        |p: &[u8]| (p[..colours].iter().map(|c| u32::from(*c)).sum::<u32>() / colours as u32) as u8;
    let grey: Vec<u8> = pixels().map(mean).collect();
    if grey.len() < cells {
        return Err(fault(bytes.len(), word!("png-too-short")));
    }
    let is_clear =
        if has_alpha { pixels().map(|p| p[channels - 1] < 255).collect() } else { Vec::new() };
    Ok(Picture { width, height, grey, is_clear })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(bytes: &[u8]) -> String {
        match read(bytes) {
            Ok(p) => format!("{}x{} {:?}", p.width, p.height, p.grey),
            Err(e) => e.to_string(),
        }
    }

    #[test]
    fn plain_and_binary_grey_maps_are_one() {
        let plain = b"P2 # kind\n# made by hand\n3 2\n255\n0 205 254\n254 # row\n0 0\n";
        assert_eq!(said(plain), "3x2 [0, 205, 254, 254, 0, 0]");
        assert_eq!(said(b"P5\n3 2\n255\n\x00\xCD\xFE\xFE\x00\x00"), said(plain));
        assert_eq!(said(b"P5 1 1 65535 \xFF\xFF"), "1x1 [255]");
        assert_eq!(said(b"P2 2 1 4 2 4"), "2x1 [127, 255]");
    }

    #[test]
    fn broken_pictures_are_refused_with_the_place() {
        assert_eq!(
            said(b"P5 3 2 255\n\x00"),
            "ROS map_server, байт 12: файл оборван: клеток 1 вместо 6"
        );
        assert_eq!(said(b"P5 99999 99999 255\n"), "ROS map_server: клеток больше 40000000");
        assert_eq!(
            said(b"P5 99999999999999999999 9 255\n"),
            "ROS map_server: клеток больше 40000000"
        );
        assert_eq!(said(b"P5 0 9 255\n"), "ROS map_server, байт 0: картинка пуста");
        assert_eq!(said(b"GIF89a"), "ROS map_server, байт 0: картинка не PGM (P2, P5) и не PNG");
    }

    #[test]
    fn a_png_tells_what_is_transparent() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(png::ColorType::GrayscaleAlpha);
        encoder.write_header().unwrap().write_image_data(&[254, 255, 0, 0]).unwrap();
        let picture = read(&bytes).unwrap();
        assert_eq!((picture.grey, picture.is_clear), (vec![254, 0], vec![false, true]));
        assert!(said(&bytes[..bytes.len() / 2]).starts_with("ROS map_server, байт 0: PNG: "));
    }
}
