//! Which things are near: a grid of square cells over a Map, each with the things whose bounds touch it.
//!
//! A grid rather than a tree: furniture is of one order of size, so that a query looks at the few cells around a thing,
//! and a move touches only the cells left and entered. Things that would fill too many cells are kept in a list of their own.

use std::collections::HashMap;
use std::hash::Hash;

use crate::geometry::Bounds;

/// Side of a cell, in cm: about the reach of the measurements, so that a query looks at some nine cells.
const CELL: f64 = 150.0;
/// What covers more cells than this is near everything.
const MOST_CELLS: f64 = 4096.0;

#[derive(Debug, Clone)]
pub(super) struct Grid<T> {
    cells: HashMap<(i32, i32), Vec<T>>,
    huge: Vec<T>,
}

impl<T> Default for Grid<T> {
    fn default() -> Self {
        Self { cells: HashMap::new(), huge: Vec::new() }
    }
}

impl<T: Copy + Eq + Ord + Hash> Grid<T> {
    pub(super) fn insert(&mut self, thing: T, bounds: &Bounds) {
        match cells(bounds) {
            Some(cells) => cells.for_each(|c| self.cells.entry(c).or_default().push(thing)),
            None => self.huge.push(thing),
        }
    }

    /// `bounds` must be those with which it was inserted.
    pub(super) fn remove(&mut self, thing: T, bounds: &Bounds) {
        let Some(cells) = cells(bounds) else {
            self.huge.retain(|&t| t != thing);
            return;
        };
        for cell in cells {
            if let Some(here) = self.cells.get_mut(&cell) {
                here.retain(|&t| t != thing);
                if here.is_empty() {
                    self.cells.remove(&cell);
                }
            }
        }
    }

    /// Things in the cells that the bounds touch: all whose own bounds meet these, and some more. Sorted, distinct.
    pub(super) fn near(&self, bounds: &Bounds, found: &mut Vec<T>) {
        found.clear();
        found.extend(&self.huge);
        match cells(bounds) {
            Some(cells) => {
                cells.filter_map(|c| self.cells.get(&c)).for_each(|here| found.extend(here));
            }
            None => self.cells.values().for_each(|here| found.extend(here)),
        }
        found.sort_unstable();
        found.dedup();
    }
}

fn cells(bounds: &Bounds) -> Option<impl Iterator<Item = (i32, i32)>> {
    // Lengths of a checked world keep within ±1e7 cm, far from the ends of i32.
    let cell = |v: f64| (v / CELL).floor();
    let (x0, x1) = (cell(bounds.min.x), cell(bounds.max.x));
    let (y0, y1) = (cell(bounds.min.y), cell(bounds.max.y));
    let count = (x1 - x0 + 1.0) * (y1 - y0 + 1.0);
    (count <= MOST_CELLS).then(|| {
        (x0 as i32..=x1 as i32).flat_map(move |x| (y0 as i32..=y1 as i32).map(move |y| (x, y)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Point;

    fn bounds(x: f64, y: f64, size: f64) -> Bounds {
        Bounds { min: Point::new(x, y), max: Point::new(x + size, y + size) }
    }

    #[test]
    fn what_meets_is_found_and_what_left_is_not() {
        let mut grid = Grid::default();
        grid.insert(1, &bounds(-10.0, -10.0, 20.0));
        grid.insert(2, &bounds(400.0, 0.0, 20.0));
        grid.insert(3, &bounds(-1e6, -1e6, 2e6));
        let mut found = Vec::new();
        grid.near(&bounds(0.0, 0.0, 5.0), &mut found);
        assert_eq!(found, [1, 3]);
        grid.remove(3, &bounds(-1e6, -1e6, 2e6));
        grid.near(&bounds(0.0, 0.0, 1e6), &mut found);
        assert_eq!(found, [1, 2]);
        grid.remove(1, &bounds(-10.0, -10.0, 20.0));
        grid.near(&bounds(0.0, 0.0, 5.0), &mut found);
        assert!(found.is_empty());
    }
}
