//! A point of the floor told by its coordinates: «в точку (330; 265)», "to the point (330, 265)".
//!
//! The pair is told in brackets, of the Map, in the unit in which positions are told; a storey may be named behind it: «(330; 265; Этаж 2)».

use std::ops::Range;

use crate::sets::Set;
use crate::units::Lengths;

/// A point that a sentence names, and where it does so: with the words that lead to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Pointed {
    pub at: Range<usize>,
    /// Whole cm.
    pub x: i32,
    pub y: i32,
    /// The name of a storey; none where it is that of the robot.
    pub storey: Option<String>,
}

/// Words that may lead to a point, the longest first.
static LEADING: Set = Set::named("ToPoint");
/// Farther than this no building reaches, cm.
const FARTHEST: f64 = 1e7;

/// The first point that a sentence names by its coordinates.
#[must_use]
pub fn pointed(sentence: &str) -> Option<Pointed> {
    sentence.match_indices('(').find_map(|(open, _)| {
        let length = sentence[open..].find(')')?;
        let inside = &sentence[open + 1..open + length];
        // A comma parts numbers, unless a semicolon does.
        let by = if inside.contains(';') { ';' } else { ',' };
        let mut parts = inside.splitn(3, by).map(str::trim);
        let (x, y) = (whole(parts.next()?)?, whole(parts.next()?)?);
        let storey = parts.next().filter(|name| !name.is_empty()).map(str::to_owned);
        let begin = leading(&sentence[..open]);
        Some(Pointed { at: begin..open + length + 1, x, y, storey })
    })
}

/// A length in whole cm, told with a decimal point or comma.
fn whole(text: &str) -> Option<i32> {
    let number = Lengths::said().meant(text.replace(',', ".").parse().ok()?);
    (number.abs() <= FARTHEST).then_some(number.round() as i32)
}

/// Where the words begin that lead to what comes.
fn leading(before: &str) -> usize {
    let trimmed = before.trim_end();
    let lower = trimmed.to_lowercase();
    let led = LEADING.iter().find(|words| {
        lower.strip_suffix(**words).is_some_and(|rest| !rest.ends_with(char::is_alphanumeric))
    });
    // Case changes no length of these words.
    led.map_or(before.len(), |words| trimmed.len() - words.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_read_with_the_words_that_lead_to_it_and_nothing_else_is_one() {
        for (sentence, cut, x, y, storey) in [
            ("Поезжай в точку (330; 265)", "в точку (330; 265)", 330, 265, None),
            ("Поезжай В ТОЧКУ (330,4; -265) и стой", "В ТОЧКУ (330,4; -265)", 330, -265, None),
            ("Go to the point (330, 265)", "to the point (330, 265)", 330, 265, None),
            ("Drive to (1.6, 2)", "to (1.6, 2)", 2, 2, None),
            ("Поезжай в точку (1; 2; Этаж 2)", "в точку (1; 2; Этаж 2)", 1, 2, Some("Этаж 2")),
            ("Остров (3; 4)", "(3; 4)", 3, 4, None),
        ] {
            let found = pointed(sentence).expect(sentence);
            assert_eq!(&sentence[found.at.clone()], cut);
            assert_eq!((found.x, found.y, found.storey.as_deref()), (x, y, storey), "{sentence}");
        }
        for sentence in [
            "Поезжай в кухню (большую)",
            "(1)",
            "(1; два)",
            "(1e9; 2)",
            "(NaN; 2)",
            "((",
            ")(",
            "(inf, 2)",
        ] {
            assert_eq!(pointed(sentence), None, "{sentence}");
        }
    }
}
