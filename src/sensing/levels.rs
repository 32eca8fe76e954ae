//! The rasters of a chart at all levels, by the courses of its lines, and what marks sum up to on them, a strip of cells at a time.

use nalgebra::{Point2, Vector2};

use super::chart::{Chart, ENDS, Line};

/// How far a return may lie from a line to count half, in cm.
const SPREAD: f64 = 12.0;
/// What a return on a line counts.
pub(crate) const FULL: u8 = 4;
/// Levels; coarser cells gain nothing.
pub(crate) const LEVELS: usize = 5;
/// Cells that are looked at together, in two registers.
pub(crate) const STRIP: usize = 32;
/// Returns that are summed before it is asked whether the rest can make up for what they lack; their sum fits a byte.
const GROUP: usize = 16;
/// Courses by which lines are told apart, in half a turn; one raster more has all lines.
pub(crate) const COURSES: usize = 16;
/// What is seen to run along a line turns from it by no more than this, in degrees, and by what its ends err.
const ASTRAY: f64 = 6.0;
/// Parts of a degree by which courses are told apart that no line has.
pub(crate) const FINE: f64 = 2.0;
/// Empty cells about the building, so that a window may begin before it: twice the coarsest.
pub(crate) const BORDER: usize = 2 << (LEVELS - 1);

/// Where a mark meets the rasters of a level, from a cell on: where its plane begins, and how many cells on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Offset {
    plane: usize,
    column: i32,
    row: i32,
}

/// The rasters of a level: of each course and each phase one.
pub(crate) struct Level {
    pub(crate) values: Vec<u8>,
    /// Cells that can be met, and what lies between the beginnings of two rows.
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    pub(crate) stride: usize,
    /// Cells of a level are `step` finest ones apart; a window may begin every `finest`.
    step: usize,
    finest: usize,
}

impl Level {
    pub(crate) fn new(level: usize, (width, height): (usize, usize)) -> Self {
        let (step, finest) = (1 << level, 1 << level.saturating_sub(2));
        let (columns, rows) = (width.div_ceil(step), height.div_ceil(step));
        Self { values: Vec::new(), columns, rows, stride: columns + 2 * STRIP, step, finest }
    }

    /// Phases in either direction.
    fn phases(&self) -> usize {
        self.step / self.finest
    }

    /// Takes in the next course: at each cell the most in the window of `step` cells from it on, in both directions.
    pub(crate) fn add(&mut self, most: &[u8], (width, height): (usize, usize)) {
        // What begins anywhere between two phases is within the window of the first, so much the wider.
        let wide = (self.finest > 1).then(|| widened(most, width, height, self.finest - 1));
        let most = wide.as_deref().unwrap_or(most);
        for phase in 0..self.phases() * self.phases() {
            let [left, low] =
                [phase % self.phases(), phase / self.phases()].map(|n| n * self.finest);
            for row in 0..self.rows {
                let y = row * self.step + low;
                let at = |column: usize| (column * self.step + left, y);
                self.values.extend([0; STRIP]);
                self.values.extend((0..self.columns).map(|column| {
                    let (x, y) = at(column);
                    if x < width && y < height { most[y * width + x] } else { 0 }
                }));
                self.values.extend([0; STRIP]);
            }
        }
    }

    /// Where a mark that lies so many finest cells on meets it.
    pub(crate) fn offset(&self, x: i32, y: i32, kind: usize) -> Offset {
        let split = |v: i32| {
            let (v, step) = (v + BORDER as i32, self.step as i32);
            (v.div_euclid(step), v.rem_euclid(step) as usize / self.finest)
        };
        let ((column, left), (row, low)) = (split(x), split(y));
        let plane = (kind * self.phases() + low) * self.phases() + left;
        Offset { plane: plane * self.rows * self.stride, column, row }
    }

    /// What the marks sum up to in each cell of a strip; none where it is told that no cell comes to `needed`.
    pub(crate) fn sums(
        &self,
        marks: &[Offset],
        column: i32,
        row: i32,
        needed: u16,
    ) -> Option<[u16; STRIP]> {
        let mut sums = [0_u16; STRIP];
        let mut left = u16::from(FULL) * marks.len() as u16;
        for group in marks.chunks(GROUP) {
            let mut part = [0_u8; STRIP];
            for mark in group {
                let (column, row) = (column + mark.column + STRIP as i32, row + mark.row);
                let Ok(row) = usize::try_from(row) else { continue };
                let Ok(column) = usize::try_from(column) else { continue };
                if row >= self.rows || column > self.columns + STRIP {
                    continue;
                }
                let values = &self.values[mark.plane + row * self.stride + column..][..STRIP];
                for (sum, value) in part.iter_mut().zip(values) {
                    *sum = sum.wrapping_add(*value);
                }
            }
            for (sum, part) in sums.iter_mut().zip(part) {
                *sum += u16::from(part);
            }
            left -= u16::from(FULL) * group.len() as u16;
            if sums.iter().fold(0, |most, sum| most.max(*sum)) + left < needed {
                return None;
            }
        }
        Some(sums)
    }
}

/// The course of a line in degrees, and by how much it is off where its ends err by so many cm.
pub(crate) fn course(along: Vector2<f64>, ends: f64) -> (f64, f64) {
    let errs = (ends / along.norm()).min(1.0).asin().to_degrees();
    (along.y.atan2(along.x).to_degrees(), errs)
}

/// Whether what is seen of a line can have a course; all lines are of the last.
pub(crate) fn is_of(line: &Line, kind: usize) -> bool {
    // What is seen of it is no longer than it is.
    let ((course, errs), step) = (course(line.end - line.start, ENDS), 180.0 / COURSES as f64);
    let off = (course - kind as f64 * step + 90.0).rem_euclid(180.0) - 90.0;
    kind == COURSES || off.abs() <= step / 2.0 + ASTRAY + errs
}

/// By how many degrees each course differs from the nearest of a line.
pub(crate) fn off(chart: &Chart) -> Vec<f64> {
    let count = (180.0 * FINE) as usize;
    let mut off = vec![f64::INFINITY; count];
    for line in chart.lines() {
        let (course, errs) = course(line.end - line.start, chart.ends());
        let at = ((course - errs).rem_euclid(180.0) * FINE) as usize;
        for n in 0..=(2.0 * errs * FINE).ceil() as usize {
            off[(at + n) % count] = 0.0;
        }
    }
    // Once about to the right and once to the left, twice for what lies across the seam.
    for _ in 0..2 {
        for n in 0..count {
            off[(n + 1) % count] = off[(n + 1) % count].min(off[n] + 1.0 / FINE);
        }
        for n in (0..count).rev() {
            off[n] = off[n].min(off[(n + 1) % count] + 1.0 / FINE);
        }
    }
    off
}

/// How near the nearest of some lines is, cell by cell.
pub(crate) fn drawn<'l>(
    lines: impl Iterator<Item = &'l Line>,
    low: Point2<f64>,
    cell: f64,
    (width, height): (usize, usize),
) -> Vec<u8> {
    let mut fine = vec![0_u8; width * height];
    let reach = 2.0 * SPREAD;
    for line in lines {
        let (a, b) = (line.start.inf(&line.end), line.start.sup(&line.end));
        let first = ((a - low).add_scalar(-reach) / cell).map(|x| x.max(0.0) as usize);
        let last = ((b - low).add_scalar(reach) / cell).map(|x| x.max(0.0) as usize);
        for row in first.y..=last.y.min(height - 1) {
            for column in first.x..=last.x.min(width - 1) {
                let p = low + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * cell;
                let far = (line.nearest(p) - p).norm() / SPREAD;
                let value = f64::from(FULL) * (-far * far * std::f64::consts::LN_2).exp();
                let here = &mut fine[row * width + column];
                *here = (*here).max(value.round() as u8);
            }
        }
    }
    fine
}

/// At each cell the most of it and of what stands so many steps further, in both directions.
pub(crate) fn widened(values: &[u8], width: usize, height: usize, step: usize) -> Vec<u8> {
    let mut wide = values.to_vec();
    for line in wide.chunks_mut(width) {
        for column in 0..width.saturating_sub(step) {
            line[column] = line[column].max(line[column + step]);
        }
    }
    for row in 0..height.saturating_sub(step) {
        let (upper, lower) = wide.split_at_mut((row + step) * width);
        let own = &mut upper[row * width..(row + 1) * width];
        own.iter_mut().zip(&lower[..width]).for_each(|(a, b)| *a = (*a).max(*b));
    }
    wide
}
