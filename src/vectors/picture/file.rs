//! Pictures of PNG files, as grey values.

use std::io::Cursor;

use super::{LARGEST, Picture, PictureError};

/// How a PNG file begins.
const HEAD: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];
/// Memory for unpacking, in bytes.
const MOST_BYTES: usize = 256 << 20;

impl Picture {
    /// Whether a file begins as a PNG.
    #[must_use]
    pub fn is_png(bytes: &[u8]) -> bool {
        bytes.starts_with(&HEAD)
    }

    /// The picture of a PNG file; colours as their brightness (ITU-R BT.601), what is clear on white paper.
    ///
    /// # Errors
    /// [`PictureError`].
    pub fn from_png(bytes: &[u8]) -> Result<Self, PictureError> {
        let wrong = |e: png::DecodingError| PictureError::Unreadable { reason: e.to_string() };
        let limits = png::Limits { bytes: MOST_BYTES };
        let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
        let mut reader = decoder.read_info().map_err(wrong)?;
        let (width, height) = (reader.info().width, reader.info().height);
        let size = reader.output_buffer_size().filter(|size| *size <= MOST_BYTES);
        let Some(size) = size.filter(|_| width <= LARGEST && height <= LARGEST) else {
            return Err(PictureError::Size { width, height, pixels: 0 });
        };
        let mut raw = vec![0; size];
        let info = reader.next_frame(&mut raw).map_err(wrong)?;
        let channels = info.color_type.samples();
        let grey = |p: &[u8]| {
            let light = |k: usize| u32::from(p[k]);
            let value = match channels {
                1 | 2 => light(0),
                _ => (299 * light(0) + 587 * light(1) + 114 * light(2)) / 1000,
            };
            match channels {
                2 | 4 => {
                    let cover = light(channels - 1);
                    (value * cover + 255 * (255 - cover)) / 255
                }
                _ => value,
            }
        };
        let pixels: Vec<u8> = raw.chunks_exact(channels).map(|p| grey(p).min(255) as u8).collect();
        let count = width as usize * height as usize;
        Self::new(width, height, pixels.into_iter().take(count).collect())
    }
}
