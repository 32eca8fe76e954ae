//! Which segments of a model lie near a point: cells of a grid, kept sorted.
//!
//! # Invariants
//!
//! Every point of a segment lies within half a cell of one of its entries, so the cells around a point name every
//! segment that passes within half a cell of it.

use nalgebra::SVector;

use crate::Segment;

/// Entries by cell; a cell's number is a hash, so strangers may share it: the caller compares anyway.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Locator<const D: usize> {
    cell: f64,
    /// (cell, segment), sorted.
    entries: Vec<(u32, u32)>,
    /// Where the cells that begin with these bits start in `entries`.
    directory: Vec<u32>,
    shift: u32,
}

impl<const D: usize> Locator<D> {
    pub(crate) fn new(segments: &[Segment<D>]) -> Self {
        let total: f64 = segments.iter().map(Segment::length).sum();
        // About six cells to a segment of mean length, and never so fine that one long wall fills the memory.
        let cell = (total / (4.0 * segments.len().max(1) as f64)).max(5.0).max(total / 1e6);
        let mut entries = Vec::with_capacity(segments.len() * 8);
        for (k, segment) in segments.iter().enumerate() {
            let steps = (segment.length() / cell).ceil().max(1.0);
            for step in 0..=steps as u32 {
                let at = segment.start + segment.vector() * (f64::from(step) / steps);
                entries.push((hash(&at.map(|x| (x / cell).floor() as i64)), k as u32));
            }
        }
        entries.sort_unstable();
        entries.dedup();
        let bits = (entries.len().max(1) as u32).ilog2();
        let shift = 32 - bits;
        let mut directory = vec![0; (1_usize << bits) + 1];
        for &(cell, _) in &entries {
            directory[(u64::from(cell) >> shift) as usize + 1] += 1;
        }
        for k in 1..directory.len() {
            directory[k] += directory[k - 1];
        }
        Self { cell, entries, directory, shift }
    }

    /// Adds to `found` every segment that passes within `reach` of `point`, and some others; sorted, each once.
    pub(crate) fn near(&self, point: &SVector<f64, D>, reach: f64, found: &mut Vec<u32>) {
        let low = point.map(|x| ((x - reach) / self.cell - 0.5).floor() as i64);
        let high = point.map(|x| ((x + reach) / self.cell + 0.5).floor() as i64);
        let spans = high - low;
        let count = spans.iter().map(|&s| (s + 1) as f64).product::<f64>();
        if count > self.entries.len() as f64 {
            found.extend(self.entries.iter().map(|e| e.1));
        } else {
            let mut at = low;
            'cells: loop {
                self.within(hash(&at), found);
                for k in 0..D {
                    if at[k] < high[k] {
                        at[k] += 1;
                        continue 'cells;
                    }
                    at[k] = low[k];
                }
                break;
            }
        }
        found.sort_unstable();
        found.dedup();
    }

    fn within(&self, cell: u32, found: &mut Vec<u32>) {
        let bucket = (u64::from(cell) >> self.shift) as usize;
        let range = self.directory[bucket] as usize..self.directory[bucket + 1] as usize;
        found.extend(self.entries[range].iter().filter(|e| e.0 == cell).map(|e| e.1));
    }
}

/// A cell's number: its coordinates, well stirred.
fn hash<const D: usize>(cell: &SVector<i64, D>) -> u32 {
    let stirred = cell.iter().fold(0x9e37_79b9_7f4a_7c15_u64, |h, &x| {
        (h ^ x as u64).wrapping_mul(0xff51_afd7_ed55_8ccd).rotate_left(31)
    });
    (stirred.wrapping_mul(0xc4ce_b9fe_1a85_ec53) >> 32) as u32
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Against all pairs: whatever passes within reach is named.
        #[test]
        fn nothing_near_is_missed(
            ends in prop::collection::vec((-300.0..300.0, -300.0..300.0, -300.0..300.0, -300.0..300.0), 1..30),
            x in -400.0..400.0, y in -400.0..400.0, reach in 0.0..60.0,
        ) {
            let segments: Vec<Segment<2>> = ends
                .into_iter()
                .map(|(a, b, c, d): (f64, f64, f64, f64)| Segment::given(Vector2::new(a, b), Vector2::new(c, d), 1.0))
                .collect();
            let point: Vector2<f64> = Vector2::new(x, y);
            let mut found = Vec::new();
            Locator::new(&segments).near(&point, reach, &mut found);
            for (k, s) in segments.iter().enumerate() {
                let t = ((point - s.start).dot(&s.vector()) / s.vector().norm_squared()).clamp(0.0, 1.0);
                let distance = (s.start + s.vector() * t - point).norm();
                prop_assert!(distance > reach || found.contains(&(k as u32)));
            }
        }
    }
}
