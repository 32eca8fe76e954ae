//! The letters of a drawing: DejaVu Sans, Latin and Cyrillic, carried inside so that a drawing looks the same everywhere.
//!
//! **Invariant.** Every SVG brings its font along as a data URL, and PNGs are painted with it alone: what fonts a machine
//! has makes no difference.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;

pub(super) const FAMILY: &str = "DejaVu Sans";
pub(super) const REGULAR: &[u8] = include_bytes!("fonts/DejaVuSans.ttf");
pub(super) const BOLD: &[u8] = include_bytes!("fonts/DejaVuSans-Bold.ttf");

/// Advance widths in thousandths of the size, from U+0020.
const ASCII: [u16; 95] = [
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838,
];
/// From U+0410, А to я.
const CYRILLIC: [u16; 64] = [
    684, 686, 686, 610, 781, 632, 1077, 641, 748, 748, 710, 752, 863, 752, 787, 752, 603, 698, 611,
    609, 861, 685, 776, 686, 1069, 1094, 833, 882, 686, 698, 1080, 695, 613, 617, 589, 525, 691,
    615, 901, 532, 650, 650, 604, 639, 754, 654, 612, 654, 635, 550, 583, 592, 855, 592, 681, 591,
    915, 942, 707, 790, 589, 549, 842, 602,
];
/// Bold letters are about a tenth wider.
const BOLD_OVER_REGULAR: f64 = 1.115;

/// Width of a line of text, in the unit of `size`. Signs outside the tables count as an average letter.
#[must_use]
pub fn text_width(text: &str, size: f64, bold: bool) -> f64 {
    let advance = |c: char| {
        let at = |table: &[u16], first: u32| {
            (c as u32).checked_sub(first).and_then(|i| table.get(i as usize).copied())
        };
        f64::from(at(&ASCII, 0x20).or_else(|| at(&CYRILLIC, 0x410)).unwrap_or(620))
    };
    let width = text.chars().map(advance).sum::<f64>() / 1000.0 * size;
    if bold { width * BOLD_OVER_REGULAR } else { width }
}

/// The style sheet that brings the font along.
pub(super) fn style_sheet() -> String {
    let face = |weight: &str, font: &[u8]| {
        format!(
            "@font-face{{font-family:\"{FAMILY}\";font-weight:{weight};\
             src:url(data:font/ttf;base64,{})}}",
            BASE64.encode(font)
        )
    };
    face("normal", REGULAR) + &face("bold", BOLD)
}
