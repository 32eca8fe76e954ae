//! Bases of Orthoframes as the map file tells them: by their corners, their sides named by letters.

use std::collections::BTreeMap;

use crate::units::Point;
use crate::{BaseVector, Permeability};

/// A, B … Z, AA, AB …
pub(super) fn letters(index: usize) -> String {
    let last = char::from(b'A' + (index % 26) as u8);
    if index < 26 { last.to_string() } else { format!("{}{last}", letters(index / 26 - 1)) }
}

/// Sides A, B, C … through the given corners.
pub(super) fn lettered(corners: &[Point]) -> Vec<BaseVector> {
    let end = |i| corners[(i + 1) % corners.len()];
    corners
        .iter()
        .enumerate()
        .map(|(i, &start)| BaseVector {
            id: letters(i),
            start,
            end: end(i),
            side_type: None,
            permeability: Permeability::Impermeable,
            names: Vec::new(),
            properties: BTreeMap::new(),
        })
        .collect()
}

/// Corners of a regular polygon, counter-clockwise, the first at the origin and the second on +x.
pub(super) fn regular_corners(count: u32, radius: f64) -> Vec<Point> {
    let step = std::f64::consts::TAU / f64::from(count);
    let (half_side, inner) = (radius * (step / 2.0).sin(), radius * (step / 2.0).cos());
    // Rounded to a micrometre, so that the file and its copies read the same.
    let round = |x: f64| (x * 1e4).round() / 1e4 + 0.0;
    (0..count)
        .map(|i| {
            let turn = step * (f64::from(i) - 0.5) - std::f64::consts::FRAC_PI_2;
            let (x, y) = (half_side + radius * turn.cos(), inner + radius * turn.sin());
            Point::new(round(x), round(y))
        })
        .collect()
}

/// Twice the signed area of a base, positive when counter-clockwise.
pub(super) fn twice_area(base: &[BaseVector]) -> f64 {
    let Some(first) = base.first() else { return 0.0 };
    base.iter().map(|v| (v.start - first.start).perp(&(v.end - first.start))).sum()
}
