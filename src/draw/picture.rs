//! A drawing as a PNG picture.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::PngError;
use super::letters;

/// More than a wall poster needs.
const MOST_PIXELS: u64 = 100_000_000;

fn parse(svg: &str) -> Result<Tree, PngError> {
    let fault = |message| PngError::Svg { message };
    let outlined = letters::outlined(svg).map_err(|e| fault(e.to_string()))?;
    Tree::from_str(&outlined, &Options::default()).map_err(|e| fault(e.to_string()))
}

/// Paints an SVG, `width` pixels wide; as wide as the drawing says when that is not given.
///
/// # Errors
/// The text is no SVG, or the picture would be larger than memory should hold.
pub fn png(svg: &str, width: Option<u32>) -> Result<Vec<u8>, PngError> {
    let tree = parse(svg)?;
    let size = tree.size();
    let width = width.unwrap_or(size.width().ceil() as u32).max(1);
    let scale = width as f32 / size.width();
    let height = (size.height() * scale).ceil().max(1.0) as u32;
    let too_large = || PngError::Size { width, height };
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(too_large());
    }
    let mut pixels = Pixmap::new(width, height).ok_or_else(too_large)?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| PngError::Svg { message: e.to_string() })
}
