//! Why a drawing is no picture.

use crate::units::Fault;

/// A drawing that cannot become a picture.
#[derive(Debug, Fault)]
#[fault(draw)]
#[non_exhaustive]
pub enum PngError {
    /// The text is no SVG.
    Svg { message: String },
    /// More pixels than memory should hold.
    Size { width: u32, height: u32 },
}
