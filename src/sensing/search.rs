//! All poses from which a scan's returns lie on a chart's lines: branch and bound over a pyramid of rasters (W. Hess, D.
//! Kohler, H. Rapp, D. Andor, 2016).
//!
//! A cell of the finest raster says how near the nearest line is; one of level `k` the most that any of the `2^k × 2^k`
//! cells from it on says. So the sum over the returns, shifted by a coarse cell, is no less than that of any pose in
//! it, and whole stretches of the building are left out at once.

use std::collections::BinaryHeap;

use nalgebra::{Isometry2, Point2, Vector2};

use super::chart::{Chart, Line};

/// How far a return may lie from a line to count half, in cm.
const SPREAD: f64 = 10.0;
/// Poses that are looked at before the search gives up.
const MOST_NODES: usize = 3_000_000;
/// Turns at the finest level: one a degree.
const TURNS: usize = 360;
/// Of each level how many of these turns are looked at as one. A coarse cell is as far across as a turn of so much moves
/// what lies some metres off.
const TOGETHER: [usize; LEVELS] = [1, 1, 1, 2, 4, 4, 8];
/// Levels that are searched; coarser cells gain nothing.
const LEVELS: usize = 7;
/// One more is kept, for returns that lie so far off that a turn moves them by more.
const KEPT: usize = LEVELS + 1;
/// From this level on windows reach a quarter of their width further on all sides, since what falls into them is turned too.
const FIRST_TURNED: usize = 3;
/// Courses by which lines are told apart, in half a turn; one raster more has all lines.
const COURSES: usize = 4;
/// What runs along a line turns from it by no more than this, in degrees: the noise of a course, and half of what is
/// looked at as one turn.
const ASTRAY: f64 = 15.0;
/// Rasters of more cells are made of larger ones.
const MOST_CELLS: f64 = 4e6;

/// A return in the sensor's frame, with the course of the line that it is seen to lie on, in degrees of half a turn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mark {
    pub(crate) at: Vector2<f64>,
    pub(crate) course: Option<f64>,
}

/// The same, turned: its cell, the raster of its course, and how many levels up its windows are looked at.
#[derive(Debug, Clone, Copy)]
struct Turned {
    x: i32,
    y: i32,
    kind: usize,
    up: usize,
}

/// The most within windows, on a raster as coarse as they allow.
struct Level {
    values: Vec<u8>,
    width: i32,
    /// Steps of the raster are `1 << shift` cells.
    shift: u32,
}

/// The pyramid over a chart.
pub(crate) struct Pyramid {
    pub(crate) cell: f64,
    low: Point2<f64>,
    width: usize,
    height: usize,
    /// By course and level.
    kinds: Vec<Vec<Level>>,
}

/// How far a window of a level reaches before its first cell.
const fn pad(level: usize) -> i32 {
    if level < FIRST_TURNED { 0 } else { 1 << (level - 2) }
}

impl Pyramid {
    pub(crate) fn of(chart: &Chart) -> Self {
        let span = chart.high - chart.low;
        let margin = 50.0;
        let area = (span.x + 2.0 * margin) * (span.y + 2.0 * margin);
        let cell = 5.0_f64.max((area / MOST_CELLS).sqrt());
        let low = chart.low - Vector2::new(margin, margin);
        let size = ((span.add_scalar(2.0 * margin)) / cell).map(|x| x as usize + 1);
        let (width, height) = (size.x, size.y);
        let is_of = |line: &Line, kind: usize| {
            let along = line.direction();
            let course = along.y.atan2(along.x).to_degrees();
            let step = 180.0 / COURSES as f64;
            let off = (course - kind as f64 * step + 90.0).rem_euclid(180.0) - 90.0;
            kind == COURSES || off.abs() <= step / 2.0 + ASTRAY
        };
        let kinds = (0..=COURSES).map(|kind| {
            let lines = chart.lines().iter().filter(|line| is_of(line, kind));
            levels(&drawn(lines, low, cell, (width, height)), width, height)
        });
        let kinds = kinds.collect();
        Self { cell, low, width, height, kinds }
    }

    /// The most that the windows of a level say that begin at a cell, or a little before.
    fn value(&self, kind: usize, level: usize, column: i32, row: i32) -> u8 {
        let (width, height) = (self.width as i32, self.height as i32);
        let (reach, before) = ((1 << level) + pad(level), pad(level));
        if column - before >= width || row - before >= height || column <= -reach || row <= -reach {
            return 0;
        }
        let level = &self.kinds[kind][level];
        // A window that begins outside: all of its cells are in the one that begins at the edge.
        let at = |x: i32, most: i32| ((x - before).max(0).min(most - 1) >> level.shift) as usize;
        level.values[at(row, height) * level.width as usize + at(column, width)]
    }

    /// The most that any pose of a node explains; less than `least` where that is told without all marks.
    fn score(&self, level: usize, marks: &[Turned], shift: (i32, i32), least: f64) -> f64 {
        let whole = 255 * marks.len() as u32;
        let needed = (least * f64::from(whole)) as u32;
        let mut sum = 0;
        let mut left = whole;
        for marks in marks.chunks(16) {
            for mark in marks {
                let (x, y) = (mark.x + shift.0, mark.y + shift.1);
                sum += u32::from(self.value(mark.kind, level + mark.up, x, y));
            }
            left -= 255 * marks.len() as u32;
            if sum + left < needed {
                return 0.0;
            }
        }
        f64::from(sum) / f64::from(whole)
    }

    /// The marks as they lie at a turn of a level, in an order that jumps about.
    fn turned(&self, marks: &[Mark], level: usize, turn: usize) -> Vec<Turned> {
        let together = TOGETHER[level] as f64;
        let half = (together - 1.0) / 2.0;
        let degrees = turn as f64 * together + half;
        let (sin, cos) = degrees.to_radians().sin_cos();
        let one = |mark: &Mark| {
            let p = mark.at;
            let (x, y) = (cos * p.x - sin * p.y, sin * p.x + cos * p.y);
            let kind = mark.course.map_or(COURSES, |course| {
                let step = 180.0 / COURSES as f64;
                ((course + degrees).rem_euclid(180.0) / step).round() as usize % COURSES
            });
            // A turn by half of what is looked at as one moves it by so many cells.
            let moved = (p.norm() * half.to_radians() / self.cell).ceil() as i32;
            let up = (0..).take_while(|up| moved > pad(level + up)).count();
            let cell = |v: f64| (v / self.cell).round() as i32;
            Turned { x: cell(x), y: cell(y), kind, up: up.min(KEPT - 1 - level) }
        };
        let count = marks.len();
        let stride = (count * 5 / 8..).find(|stride| gcd(*stride, count) == 1).unwrap_or(1);
        (0..count).map(|k| one(&marks[k * stride % count])).collect()
    }

    /// Poses that explain no less than `least` of the returns, nor less than the best by more than `margin`: of each place
    /// the best, no two of them nearer than `apart` cm and 20°. None when there are more than can be gone through.
    pub(crate) fn search(
        &self,
        marks: &[Mark],
        least: f64,
        margin: f64,
        apart: f64,
        most: usize,
    ) -> Option<Vec<Isometry2<f64>>> {
        if marks.is_empty() {
            return Some(Vec::new());
        }
        let turned: Vec<Vec<Vec<Turned>>> = (0..LEVELS)
            .map(|level| {
                let turns = 0..TURNS / TOGETHER[level];
                turns.map(|turn| self.turned(marks, level, turn)).collect()
            })
            .collect();
        let top = LEVELS - 1;
        let step = 1 << top;
        let mut open: BinaryHeap<Node> = BinaryHeap::new();
        for (turn, marks) in turned[top].iter().enumerate() {
            for row in (0..self.height as i32).step_by(step) {
                for column in (0..self.width as i32).step_by(step) {
                    let bound = self.score(top, marks, (column, row), least);
                    if bound >= least {
                        open.push(Node { bound, level: top, turn, column, row });
                    }
                }
            }
        }
        let mut found: Vec<Isometry2<f64>> = Vec::new();
        let mut best = 0.0_f64;
        let mut looked = 0;
        while let Some(node) = open.pop() {
            if node.bound < best - margin {
                break;
            }
            let pose = self.pose(&node);
            if node.level == 0 {
                let is_known = |other: &Isometry2<f64>| is_near(other, &pose, apart);
                if !found.iter().any(is_known) {
                    best = best.max(node.bound);
                    found.push(pose);
                    if found.len() >= most {
                        return None;
                    }
                }
                continue;
            }
            // What lies wholly beside a better pose is of the same place.
            let half = self.cell * f64::from(1 << node.level) * std::f64::consts::FRAC_1_SQRT_2;
            let middle = Vector2::repeat(self.cell * f64::from(1 << node.level) / 2.0);
            let centre = Isometry2::new(pose.translation.vector + middle, pose.rotation.angle());
            if half < apart && found.iter().any(|known| is_near(known, &centre, apart - half)) {
                continue;
            }
            let level = node.level - 1;
            let step = 1 << level;
            let needed = least.max(best - margin);
            let parts = TOGETHER[node.level] / TOGETHER[level];
            let turns = turned[level].iter().enumerate().skip(node.turn * parts).take(parts);
            for (turn, marks) in turns {
                for (column, row) in [
                    (node.column, node.row),
                    (node.column + step, node.row),
                    (node.column, node.row + step),
                    (node.column + step, node.row + step),
                ] {
                    if column >= self.width as i32 || row >= self.height as i32 {
                        continue;
                    }
                    looked += 1;
                    let bound = self.score(level, marks, (column, row), needed);
                    if bound >= needed {
                        open.push(Node { bound, level, turn, column, row });
                    }
                }
            }
            if looked > MOST_NODES {
                return None;
            }
        }
        Some(found)
    }

    fn pose(&self, node: &Node) -> Isometry2<f64> {
        let at = self.low
            + Vector2::new(f64::from(node.column) + 0.5, f64::from(node.row) + 0.5) * self.cell;
        let together = TOGETHER[node.level] as f64;
        let degrees = node.turn as f64 * together + (together - 1.0) / 2.0;
        Isometry2::new(at.coords, degrees.to_radians())
    }
}

const fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// How near the nearest of some lines is, cell by cell.
fn drawn<'l>(
    lines: impl Iterator<Item = &'l Line>,
    low: Point2<f64>,
    cell: f64,
    (width, height): (usize, usize),
) -> Vec<u8> {
    let mut fine = vec![0_u8; width * height];
    let reach = 2.5 * SPREAD;
    for line in lines {
        let (a, b) = (line.start.inf(&line.end), line.start.sup(&line.end));
        let first = ((a - low).add_scalar(-reach) / cell).map(|x| x.max(0.0) as usize);
        let last = ((b - low).add_scalar(reach) / cell).map(|x| x.max(0.0) as usize);
        for row in first.y..=last.y.min(height - 1) {
            for column in first.x..=last.x.min(width - 1) {
                let p = low + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * cell;
                let far = (line.nearest(p) - p).norm() / SPREAD;
                let value = (255.0 * (-far * far * std::f64::consts::LN_2).exp()) as u8;
                let here = &mut fine[row * width + column];
                *here = (*here).max(value);
            }
        }
    }
    fine
}

/// Of each level the most in the windows that begin at each step of its raster.
fn levels(fine: &[u8], width: usize, height: usize) -> Vec<Level> {
    // At each cell the most in the window of `1 << level` cells from it on, in both directions.
    let mut most = fine.to_vec();
    let mut kept = Vec::new();
    for level in 0..KEPT {
        if level > 0 {
            most = widened(&most, width, height, 1 << (level - 1));
        }
        // A window that is half as wide again is two of these, a half of their width apart.
        let padded =
            (level >= FIRST_TURNED).then(|| widened(&most, width, height, 1 << (level - 1)));
        let full = padded.as_ref().unwrap_or(&most);
        let shift = level.saturating_sub(2) as u32;
        let step = 1 << shift;
        let (columns, rows) = (width.div_ceil(step), height.div_ceil(step));
        let mut values = vec![0_u8; columns * rows];
        for (row, line) in full.chunks(width).enumerate() {
            let into = &mut values[(row >> shift) * columns..][..columns];
            for (column, value) in line.iter().enumerate() {
                let here = &mut into[column >> shift];
                *here = (*here).max(*value);
            }
        }
        kept.push(Level { values, width: columns as i32, shift });
    }
    kept
}

/// At each cell the most of it and of what stands so many steps further, in both directions.
fn widened(values: &[u8], width: usize, height: usize, step: usize) -> Vec<u8> {
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

/// Whether two poses are of one place: so near, and turned by no more than 20°.
pub(crate) fn is_near(a: &Isometry2<f64>, b: &Isometry2<f64>, apart: f64) -> bool {
    (a.translation.vector - b.translation.vector).norm() <= apart
        && a.rotation.angle_to(&b.rotation).abs() <= 20_f64.to_radians()
}

/// Cells from one on, at a turn, by the most that any pose in them can explain.
#[derive(Debug, Clone, Copy)]
struct Node {
    bound: f64,
    level: usize,
    turn: usize,
    column: i32,
    row: i32,
}

impl Ord for Node {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let place = |node: &Self| (node.level, node.turn, node.column, node.row);
        self.bound.total_cmp(&other.bound).then_with(|| place(other).cmp(&place(self)))
    }
}

impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Node {}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every pose of the raster, one after another.
    fn all(pyramid: &Pyramid, marks: &[Mark]) -> Vec<(f64, Isometry2<f64>)> {
        let mut scored = Vec::new();
        for turn in 0..TURNS {
            let turned = pyramid.turned(marks, 0, turn);
            for row in 0..pyramid.height as i32 {
                for column in 0..pyramid.width as i32 {
                    let bound = pyramid.score(0, &turned, (column, row), 0.0);
                    let node = Node { bound, level: 0, turn, column, row };
                    scored.push((bound, pyramid.pose(&node)));
                }
            }
        }
        scored
    }

    #[test]
    fn nothing_is_passed_over() {
        let (least, margin, apart) = (0.4, 0.2, 30.0);
        for seed in 0..3 {
            let mut random = fastrand::Rng::with_seed(seed);
            let mut point = |wide: f64| Point2::new(random.f64() * wide, random.f64() * 200.0);
            let lines: Vec<Line> = (0..12)
                .map(|_| Line { start: point(250.0), end: point(250.0), face: None })
                .collect();
            let chart = Chart::new(lines);
            let pyramid = Pyramid::of(&chart);
            let pose = Isometry2::new(Vector2::new(120.0, 90.0), 1.0 + f64::from(seed as u32));
            let marks: Vec<Mark> = (0..28)
                .filter_map(|beam| {
                    let bearing = f64::from(beam) * 0.22;
                    let (range, line) = chart.cast(&pose, bearing, 400.0);
                    let line = &chart.lines()[line? as usize];
                    let along = pose.rotation.inverse() * line.direction();
                    let course = (beam % 3 > 0).then(|| along.y.atan2(along.x).to_degrees());
                    Some(Mark { at: Vector2::new(bearing.cos(), bearing.sin()) * range, course })
                })
                .collect();
            let found = pyramid.search(&marks, least, margin, apart, 10_000).expect("it ends");
            let all = all(&pyramid, &marks);
            let best = all.iter().map(|(score, _)| *score).fold(0.0, f64::max);
            assert!(best > 0.5, "seed {seed}: {best}");
            for (score, pose) in &all {
                if *score >= least.max(best - margin) {
                    let near = found.iter().any(|known| is_near(known, pose, apart));
                    assert!(near, "seed {seed}: {pose} explains {score:.2} of {best:.2}");
                }
            }
        }
    }
}
