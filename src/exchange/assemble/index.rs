//! Which rooms are near a place: boxes of rooms in the cells of a grid.

use std::collections::HashMap;

use crate::map::plane::bounds;
use crate::units::{InOrder as _, Point, Vector};

use super::ring::Region;

/// Entries in the grid, for each room; a coarser grid is taken when rooms are large.
const ENTRIES: usize = 32;

/// The rooms of a level by place.
pub(super) struct Index {
    origin: Point,
    cell: f64,
    cells: HashMap<(i64, i64), Vec<usize>>,
}

impl Index {
    pub(super) fn of(regions: &[Option<Region>]) -> Self {
        let boxes: Vec<(usize, (Point, Point))> = regions
            .iter()
            .enumerate()
            .filter_map(|(i, r)| Some((i, bounds(r.as_ref()?.outer.iter().copied()))))
            .collect();
        let (low, high) = bounds(boxes.iter().flat_map(|&(_, (a, b))| [a, b]));
        let extent = if boxes.is_empty() { 1.0 } else { (high - low).amax().max(1.0) };
        let mut cell = extent / (boxes.len() as f64).sqrt().clamp(1.0, 1024.0);
        let origin = if boxes.is_empty() { Point::origin() } else { low };
        let mut index = Self { origin, cell, cells: HashMap::new() };
        while boxes.iter().map(|&(_, b)| index.covered(b)).sum::<f64>()
            > (ENTRIES * boxes.len().max(1)) as f64
        {
            cell *= 2.0;
            index.cell = cell;
        }
        for (i, b) in boxes {
            for key in index.keys(b) {
                index.cells.entry(key).or_default().push(i);
            }
        }
        index
    }

    fn covered(&self, (low, high): (Point, Point)) -> f64 {
        let size = (high - low) / self.cell;
        (size.x.floor() + 2.0) * (size.y.floor() + 2.0)
    }

    fn keys(&self, (low, high): (Point, Point)) -> impl Iterator<Item = (i64, i64)> + use<> {
        let key = |p: Point| {
            let v = (p - self.origin) / self.cell;
            (v.x.floor() as i64, v.y.floor() as i64)
        };
        let (from, to) = (key(low), key(high));
        (from.0..=to.0).flat_map(move |x| (from.1..=to.1).map(move |y| (x, y)))
    }

    /// Rooms whose boxes may come within `margin` cm of a point, in their order.
    pub(super) fn near(&self, p: Point, margin: f64) -> Vec<usize> {
        let margin = Vector::new(margin, margin);
        self.near_box((p - margin, p + margin))
    }

    pub(super) fn near_box(&self, area: (Point, Point)) -> Vec<usize> {
        // Never more cells than there are: a search far wider than the plan looks at every entry once.
        let mut found: Vec<usize> = if self.covered(area) > self.cells.len() as f64 * 4.0 + 64.0 {
            self.cells.values().flatten().copied().collect()
        } else {
            self.keys(area).filter_map(|key| self.cells.get(&key)).flatten().copied().collect()
        };
        found.order();
        found.dedup();
        found
    }
}
