//! The grid: free, occupied, unknown; components; the distance of every free cell from what is not.

use super::Sheet;
use super::image::Picture;
use crate::units::Point;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cell {
    Free,
    Occupied,
    Unknown,
}

/// Rows run upwards: cell 0 is the lower left.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    pub width: usize,
    pub height: usize,
    pub cells: Vec<Cell>,
}

impl Grid {
    pub(super) fn of(sheet: &Sheet, picture: &Picture) -> Self {
        let meaning = |at: usize| {
            let grey = f64::from(picture.grey[at]);
            if picture.is_clear.get(at) == Some(&true) {
                return Cell::Unknown;
            }
            let occupancy = match (sheet.is_raw, sheet.negate) {
                // Raw values are percents; what is above is unknown.
                (true, _) if grey > 100.0 => return Cell::Unknown,
                (true, _) => grey / 100.0,
                (false, true) => grey / 255.0,
                (false, false) => (255.0 - grey) / 255.0,
            };
            if occupancy >= sheet.occupied_thresh {
                Cell::Occupied
            } else if occupancy <= sheet.free_thresh {
                Cell::Free
            } else {
                Cell::Unknown
            }
        };
        let (width, height) = (picture.width, picture.height);
        let rows = (0..height).rev().flat_map(|row| (0..width).map(move |x| row * width + x));
        Self { width, height, cells: rows.map(meaning).collect() }
    }

    pub(super) fn at(&self, x: i64, y: i64) -> Option<usize> {
        let inside = x >= 0 && y >= 0 && x < self.width as i64 && y < self.height as i64;
        inside.then(|| y as usize * self.width + x as usize)
    }

    pub(super) fn xy(&self, cell: usize) -> (i64, i64) {
        ((cell % self.width) as i64, (cell / self.width) as i64)
    }

    /// The four cells beside a cell.
    pub(super) fn beside(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        let (x, y) = self.xy(cell);
        [(1, 0), (0, 1), (-1, 0), (0, -1)]
            .into_iter()
            .filter_map(move |(dx, dy)| self.at(x + dx, y + dy))
    }

    /// Numbers the connected groups of cells that `wanted` holds for; `u32::MAX` elsewhere. With the size of each.
    pub(super) fn components(&self, wanted: impl Fn(usize) -> bool) -> (Vec<u32>, Vec<usize>) {
        let mut label = vec![u32::MAX; self.cells.len()];
        let mut sizes = Vec::new();
        let mut open = Vec::new();
        for start in 0..self.cells.len() {
            if label[start] != u32::MAX || !wanted(start) {
                continue;
            }
            let number = sizes.len() as u32;
            let mut size = 0;
            label[start] = number;
            open.push(start);
            while let Some(cell) = open.pop() {
                size += 1;
                for next in self.beside(cell) {
                    if label[next] == u32::MAX && wanted(next) {
                        label[next] = number;
                        open.push(next);
                    }
                }
            }
            sizes.push(size);
        }
        (label, sizes)
    }

    /// For every cell the distance of its middle, in cells, from the middle of the nearest cell that is not free;
    /// what lies outside of the picture is not.
    pub(super) fn distances(&self, free: &[bool]) -> Vec<f32> {
        let (width, height) = (self.width, self.height);
        let far = (width + height) as f32;
        let mut column = vec![0.0_f32; free.len()];
        for x in 0..width {
            let mut run = 0.0;
            for y in 0..height {
                run = if free[y * width + x] { run + 1.0 } else { 0.0 };
                column[y * width + x] = f32::min(run, far);
            }
            run = 0.0;
            for y in (0..height).rev() {
                run = if free[y * width + x] { run + 1.0 } else { 0.0 };
                column[y * width + x] = column[y * width + x].min(run);
            }
        }
        // Lower envelope of parabolas along each row, with a wall of zeros at either end.
        let mut out = vec![0.0_f32; free.len()];
        let (mut foot, mut from) = (vec![0_i64; width + 3], vec![0.0_f64; width + 3]);
        for y in 0..height {
            let row = &column[y * width..(y + 1) * width];
            let value = |q: i64| -> f64 {
                if q < 0 || q >= width as i64 { 0.0 } else { f64::from(row[q as usize]).powi(2) }
            };
            let mut top = 0;
            foot[0] = -1;
            from[0] = f64::NEG_INFINITY;
            for q in 0..=width as i64 {
                let meet = |p: i64| {
                    let (q2, p2) = ((q * q) as f64, (p * p) as f64);
                    ((value(q) + q2) - (value(p) + p2)) / (2 * (q - p)) as f64
                };
                let mut at = meet(foot[top]);
                while top > 0 && at <= from[top] {
                    top -= 1;
                    at = meet(foot[top]);
                }
                top += 1;
                foot[top] = q;
                from[top] = at;
            }
            let mut k = 0;
            for x in 0..width {
                while k < top && from[k + 1] < x as f64 {
                    k += 1;
                }
                let p = foot[k];
                let squared = ((x as i64 - p) as f64).powi(2) + value(p);
                out[y * width + x] = squared.sqrt() as f32;
            }
        }
        out
    }
}

/// The corner `(x, y)` of the grid's lines on the plan, in cm.
pub(super) fn corner(sheet: &Sheet, x: f64, y: f64) -> Point {
    sheet.origin.apply(Point::new(x * sheet.resolution, y * sheet.resolution))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_the_slow_way() {
        let (width, height) = (23, 17);
        let mut seed = 7_u32;
        let free: Vec<bool> = (0..width * height)
            .map(|_| {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                seed >> 24 > 30
            })
            .collect();
        let grid = Grid { width, height, cells: vec![Cell::Free; width * height] };
        let fast = grid.distances(&free);
        for (cell, fast) in fast.iter().enumerate() {
            let (x, y) = grid.xy(cell);
            let mut slow = [x + 1, y + 1, width as i64 - x, height as i64 - y].map(|d| d * d)[0..4]
                .iter()
                .copied()
                .min()
                .unwrap();
            for other in (0..free.len()).filter(|o| !free[*o]) {
                let (a, b) = grid.xy(other);
                slow = slow.min((a - x).pow(2) + (b - y).pow(2));
            }
            assert!((f64::from(*fast) - (slow as f64).sqrt()).abs() < 1e-3, "{x} {y}");
        }
    }
}
