//! The narrow places of a floor at which it is cut into rooms.
//!
//! The distance from the walls is flooded from its heights downwards. Where two basins meet, the meeting place is a
//! doorway when it is no wider than a door and clearly narrower than both basins; else the lower basin was only a
//! corner of the other. The cut runs across it, from jamb to jamb.

use crate::units::Vector;

use super::Sheet;
use super::grid::Grid;

/// cm. A gap wider than this is no doorway.
const WIDEST_DOOR: f64 = 210.0;
/// cm. A gap narrower than this lets nobody through: cable ducts, gaps between scans.
const NARROWEST_DOOR: f64 = 35.0;
/// A doorway is narrower than the rooms beside it by this share of the smaller's half width.
const NARROWER: f64 = 0.82;
const MOST_DOORS: usize = 20_000;

/// A place where the floor is cut.
#[derive(Debug, Clone)]
pub(super) struct Cut {
    /// In cells, middles of the walls' cells on either side.
    pub jambs: [(f64, f64); 2],
    pub cells: Vec<usize>,
}

/// Basins of the watershed so far.
struct Basins {
    parent: Vec<u32>,
    peak: Vec<f32>,
}

impl Basins {
    fn root(&mut self, mut basin: u32) -> u32 {
        while self.parent[basin as usize] != basin {
            let above = self.parent[self.parent[basin as usize] as usize];
            self.parent[basin as usize] = above;
            basin = above;
        }
        basin
    }
}

/// The narrow places between basins, the widest cell of each.
pub(super) fn doorways(grid: &Grid, sheet: &Sheet, free: &[bool], distances: &[f32]) -> Vec<Cut> {
    let widest = (WIDEST_DOOR / sheet.resolution / 2.0) as f32;
    // Highest first; equal heights in the order of the grid.
    let mut order: Vec<u32> = (0..free.len() as u32).filter(|c| free[*c as usize]).collect();
    order.sort_unstable_by(|a, b| {
        distances[*b as usize].total_cmp(&distances[*a as usize]).then(a.cmp(b))
    });
    let mut basin = vec![u32::MAX; free.len()];
    let mut basins = Basins { parent: Vec::new(), peak: Vec::new() };
    // Where two basins met first: their saddle.
    let mut saddles: Vec<(u32, u32, usize)> = Vec::new();
    let mut border = vec![u32::MAX; free.len()];
    for cell in order {
        let cell = cell as usize;
        let here = distances[cell];
        let mut own = u32::MAX;
        let (x, y) = grid.xy(cell);
        for (dx, dy) in [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1)] {
            let Some(next) = grid.at(x + dx, y + dy).filter(|n| basin[*n] != u32::MAX) else {
                continue;
            };
            let other = basins.root(basin[next]);
            if own == u32::MAX || own == other {
                own = other;
                continue;
            }
            let (high, low) = if basins.peak[own as usize] >= basins.peak[other as usize] {
                (own, other)
            } else {
                (other, own)
            };
            let lower = basins.peak[low as usize];
            let is_door = here <= widest
                && f64::from(here) < NARROWER * f64::from(lower)
                && lower - here >= 1.5;
            if is_door {
                let known = border_beside(grid, &border, cell);
                if known.is_none() && saddles.len() < MOST_DOORS {
                    saddles.push((own, other, cell));
                }
                border[cell] = known.unwrap_or(saddles.len() as u32);
                own = high;
            } else {
                basins.parent[low as usize] = high;
                own = high;
            }
        }
        if own == u32::MAX {
            own = basins.parent.len() as u32;
            basins.parent.push(own);
            basins.peak.push(here);
        }
        basin[cell] = own;
    }
    // Basins that became one after they had met need no door between them.
    let mut cuts = Vec::new();
    for (a, b, cell) in saddles {
        if basins.root(a) != basins.root(b) {
            cuts.extend(across(grid, sheet, free, distances, cell));
        }
    }
    cuts
}

/// The doorway whose border runs by a cell, if any: the same two basins, flooded further down.
fn border_beside(grid: &Grid, border: &[u32], cell: usize) -> Option<u32> {
    let (x, y) = grid.xy(cell);
    let around = (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (dx, dy)));
    around
        .filter_map(|(dx, dy)| grid.at(x + dx, y + dy))
        .map(|c| border[c])
        .find(|b| *b != u32::MAX)
}

/// The cut through a saddle: to the nearest wall, and to the wall on the other side.
fn across(
    grid: &Grid,
    sheet: &Sheet,
    free: &[bool],
    distances: &[f32],
    saddle: usize,
) -> Option<Cut> {
    let (x, y) = grid.xy(saddle);
    let reach = f64::from(distances[saddle]).ceil() as i64 + 1;
    let is_wall = |a: i64, b: i64| grid.at(a, b).is_none_or(|c| !free[c]);
    let square = |a: i64, b: i64| (a - x).pow(2) + (b - y).pow(2);
    let near = (y - reach..=y + reach)
        .flat_map(|b| (x - reach..=x + reach).map(move |a| (a, b)))
        .filter(|(a, b)| is_wall(*a, *b))
        .min_by_key(|(a, b)| (square(*a, *b), *b, *a))?;
    let towards = Vector::new((near.0 - x) as f64, (near.1 - y) as f64).try_normalize(1e-9)?;
    // The narrowest way across: of the walls on the other side, within 45° of straight on, the one nearest to the
    // first. A wall may be one cell thick, so that a ray could pass it by.
    let most = (WIDEST_DOOR / sheet.resolution * 1.2) as i64;
    let is_opposite = |a: i64, b: i64| {
        let way = Vector::new((a - x) as f64, (b - y) as f64);
        way.dot(&-towards) >= way.norm() * std::f64::consts::FRAC_1_SQRT_2
    };
    let far = (y - most..=y + most)
        .flat_map(|b| (x - most..=x + most).map(move |a| (a, b)))
        .filter(|(a, b)| is_opposite(*a, *b) && is_wall(*a, *b))
        .min_by_key(|(a, b)| ((a - near.0).pow(2) + (b - near.1).pow(2), *b, *a))?;
    let ends = [(near.0 as f64, near.1 as f64), (far.0 as f64, far.1 as f64)];
    let width =
        (Vector::new(ends[1].0 - ends[0].0, ends[1].1 - ends[0].1).norm() - 1.0) * sheet.resolution;
    if !(NARROWEST_DOOR..=WIDEST_DOOR).contains(&width) {
        return None;
    }
    Some(Cut { jambs: ends, cells: line(grid, near, far, free) })
}

/// The free cells of a line that leaves no gap between diagonal neighbours.
fn line(grid: &Grid, from: (i64, i64), to: (i64, i64), free: &[bool]) -> Vec<usize> {
    let (dx, dy) = ((to.0 - from.0).abs(), (to.1 - from.1).abs());
    let (sx, sy) = ((to.0 - from.0).signum(), (to.1 - from.1).signum());
    let (mut x, mut y) = from;
    let mut error = dx - dy;
    let mut cells = Vec::new();
    loop {
        cells.extend(grid.at(x, y).filter(|c| free[*c]));
        if (x, y) == to {
            return cells;
        }
        // One step at a time: the cells share sides.
        if x != to.0 && 2 * error > -dy {
            error -= dy;
            x += sx;
        } else if y != to.1 {
            error += dx;
            y += sy;
        } else {
            x += sx;
        }
    }
}
