//! All poses from which a scan's returns lie on a chart's lines: branch and bound over a pyramid of rasters (W. Hess, D.
//! Kohler, H. Rapp, D. Andor, 2016).
//!
//! A cell of the finest raster says how near the nearest line is; one of level `k` the most that any of the `2^k × 2^k`
//! cells from it on says. So the sum over the returns, shifted by a coarse cell, is no less than that of any pose in
//! it, and whole stretches of the building are left out at once.

use std::collections::BinaryHeap;

use nalgebra::{Isometry2, Point2, Vector2};

use super::chart::Chart;

/// How far a return may lie from a line to count half, in cm.
const SPREAD: f64 = 10.0;
/// Poses that are looked at before the search gives up.
const MOST_NODES: usize = 3_000_000;

/// The pyramid over a chart.
pub(crate) struct Pyramid {
    pub(crate) cell: f64,
    low: Point2<f64>,
    width: usize,
    height: usize,
    /// Of each level the values of all cells, row by row.
    levels: Vec<Vec<u8>>,
}

/// Coarser cells than of this many fine ones gain nothing.
const LEVELS: usize = 7;
/// Rasters of more cells are made of larger ones.
const MOST_CELLS: f64 = 4e6;

impl Pyramid {
    pub(crate) fn of(chart: &Chart) -> Self {
        let span = chart.high - chart.low;
        let margin = 50.0;
        let area = (span.x + 2.0 * margin) * (span.y + 2.0 * margin);
        let cell = 5.0_f64.max((area / MOST_CELLS).sqrt());
        let low = chart.low - Vector2::new(margin, margin);
        let size = ((span.add_scalar(2.0 * margin)) / cell).map(|x| x as usize + 1);
        let (width, height) = (size.x, size.y);
        let mut fine = vec![0_u8; width * height];
        let reach = 2.5 * SPREAD;
        for line in chart.lines() {
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
        let mut levels = vec![fine];
        for level in 1..LEVELS {
            let (below, step) = (&levels[level - 1], 1_usize << (level - 1));
            let mut above = below.clone();
            for row in 0..height {
                for column in 0..width {
                    let mut most = below[row * width + column];
                    for (r, c) in
                        [(row + step, column), (row, column + step), (row + step, column + step)]
                    {
                        if r < height && c < width {
                            most = most.max(below[r * width + c]);
                        }
                    }
                    above[row * width + column] = most;
                }
            }
            levels.push(above);
        }
        Self { cell, low, width, height, levels }
    }

    /// Of a level, the cell at these steps; before the raster's beginning what a coarse cell there may reach into it.
    fn value(&self, level: usize, column: i32, row: i32) -> u8 {
        let (width, height, pad) = (self.width as i32, self.height as i32, 1 << level);
        if column >= width || row >= height || column <= -pad || row <= -pad {
            return 0;
        }
        // A window that begins outside: all of its cells are in the one that begins at the edge.
        self.levels[level][(row.max(0) * width + column.max(0)) as usize]
    }

    fn score(&self, level: usize, points: &[(i32, i32)], shift: (i32, i32)) -> f64 {
        let sum: u32 = points
            .iter()
            .map(|&(x, y)| u32::from(self.value(level, x + shift.0, y + shift.1)))
            .sum();
        f64::from(sum) / (255.0 * points.len() as f64)
    }

    /// Poses that explain no less than `least` of the returns, nor less than the best by more than `margin`: of each place
    /// the best, no two of them nearer than `apart` cm and 20°. None when there are more than can be gone through.
    pub(crate) fn search(
        &self,
        returns: &[Vector2<f64>],
        turns: &[f64],
        least: f64,
        margin: f64,
        apart: f64,
        most: usize,
    ) -> Option<Vec<Isometry2<f64>>> {
        if returns.is_empty() {
            return Some(Vec::new());
        }
        let turned: Vec<Vec<(i32, i32)>> = turns
            .iter()
            .map(|turn| {
                let (sin, cos) = turn.sin_cos();
                let cell = |p: &Vector2<f64>| {
                    let (x, y) = (cos * p.x - sin * p.y, sin * p.x + cos * p.y);
                    ((x / self.cell).round() as i32, (y / self.cell).round() as i32)
                };
                returns.iter().map(cell).collect()
            })
            .collect();
        let top = LEVELS - 1;
        let step = 1 << top;
        let mut open: BinaryHeap<Node> = BinaryHeap::new();
        for (turn, points) in turned.iter().enumerate() {
            for row in (0..self.height as i32).step_by(step) {
                for column in (0..self.width as i32).step_by(step) {
                    let bound = self.score(top, points, (column, row));
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
            let pose = self.pose(&node, turns);
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
                let bound = self.score(level, &turned[node.turn], (column, row));
                if bound >= least && bound >= best - margin {
                    open.push(Node { bound, level, turn: node.turn, column, row });
                }
            }
            if looked > MOST_NODES {
                return None;
            }
        }
        Some(found)
    }

    fn pose(&self, node: &Node, turns: &[f64]) -> Isometry2<f64> {
        let at = self.low
            + Vector2::new(f64::from(node.column) + 0.5, f64::from(node.row) + 0.5) * self.cell;
        Isometry2::new(at.coords, turns[node.turn])
    }
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
