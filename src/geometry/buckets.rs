//! Boxes by place: a grid of square buckets, each with the boxes that reach into it.
//!
//! **Invariant**: every list is in the order of the boxes, each of them once.

use crate::units::Point;

use super::Bounds;

/// Boxes, known by their numbers, sorted into buckets.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Buckets {
    bounds: Bounds,
    size: f64,
    columns: usize,
    rows: usize,
    /// Where the boxes of each bucket begin in `items`; one entry more than there are buckets.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Default for Buckets {
    fn default() -> Self {
        Self {
            bounds: Bounds::EMPTY,
            size: 1.0,
            columns: 0,
            rows: 0,
            starts: vec![0],
            items: vec![],
        }
    }
}

impl Buckets {
    pub(super) fn of(boxes: &[Bounds]) -> Self {
        let Some(bounds) = boxes.iter().copied().reduce(|a, b| a.union(&b)) else {
            return Self::default();
        };
        let extent = bounds.max - bounds.min;
        let size =
            (extent.x * extent.y / boxes.len() as f64).sqrt().max(extent.amax() / 256.0).max(1e-3);
        let (columns, rows) = ((extent.x / size) as usize + 1, (extent.y / size) as usize + 1);
        // Counts are kept two places on, so that filling the buckets moves every start to its place.
        let starts = vec![0; columns * rows + 2];
        let mut buckets = Self { bounds, size, columns, rows, starts, items: vec![] };
        for reach in boxes {
            for bucket in buckets.covering(reach) {
                buckets.starts[bucket + 2] += 1;
            }
        }
        for i in 1..=columns * rows {
            buckets.starts[i + 1] += buckets.starts[i];
        }
        buckets.items = vec![0; buckets.starts[columns * rows + 1] as usize];
        for (item, reach) in boxes.iter().enumerate() {
            for bucket in buckets.covering(reach) {
                let at = buckets.starts[bucket + 1];
                buckets.items[at as usize] = item as u32;
                buckets.starts[bucket + 1] = at + 1;
            }
        }
        buckets.starts.pop();
        buckets
    }

    fn column_row(&self, p: Point) -> (usize, usize) {
        let v = (p - self.bounds.min) / self.size;
        // Casts saturate, so points far off come to the rim.
        ((v.x as usize).min(self.columns - 1), (v.y as usize).min(self.rows - 1))
    }

    fn covering(&self, reach: &Bounds) -> impl Iterator<Item = usize> + use<> {
        let ((left, bottom), (right, top)) =
            (self.column_row(reach.min), self.column_row(reach.max));
        let columns = self.columns;
        (bottom..=top).flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }

    fn bucket(&self, index: usize) -> &[u32] {
        &self.items[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    /// The boxes that may hold a point.
    pub(super) fn near(&self, p: Point) -> &[u32] {
        if self.columns == 0 || !self.bounds.contains(p) {
            return &[];
        }
        let (column, row) = self.column_row(p);
        self.bucket(row * self.columns + column)
    }

    /// The boxes that may meet another, written into `found`.
    pub(super) fn meeting(&self, reach: &Bounds, found: &mut Vec<u32>) {
        found.clear();
        if self.columns == 0 || !self.bounds.meets(reach) {
            return;
        }
        let mut buckets = 0;
        for bucket in self.covering(reach) {
            found.extend_from_slice(self.bucket(bucket));
            buckets += 1;
        }
        if buckets > 1 {
            found.sort_unstable();
            found.dedup();
        }
    }

    /// The boxes that may meet another, in no order, some perhaps more than once.
    pub(super) fn visit_meeting(&self, reach: &Bounds, mut visit: impl FnMut(u32)) {
        if self.columns > 0 && self.bounds.meets(reach) {
            for bucket in self.covering(reach) {
                self.bucket(bucket).iter().copied().for_each(&mut visit);
            }
        }
    }

    /// The boxes that a segment may meet, written into `found`.
    pub(super) fn along(&self, a: Point, b: Point, found: &mut Vec<u32>) {
        const TOUCH: f64 = 1e-6;
        let reach = Bounds::of([a, b]).grown(TOUCH);
        found.clear();
        if self.columns == 0 || !self.bounds.meets(&reach) {
            return;
        }
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        let ((_, bottom), (_, top)) = (self.column_row(reach.min), self.column_row(reach.max));
        for row in bottom..=top {
            // Where the segment enters and leaves the row; the outermost rows go on for ever.
            let floor = self.bounds.min.y + row as f64 * self.size;
            let at = |y: f64| {
                let rise = high.y - low.y;
                let share = if rise > TOUCH { ((y - low.y) / rise).clamp(0.0, 1.0) } else { 0.0 };
                low.x + (high.x - low.x) * share
            };
            let (from, to) = if high.y - low.y > TOUCH {
                (at(floor - TOUCH), at(floor + self.size + TOUCH))
            } else {
                (low.x, high.x)
            };
            let y = floor + self.size / 2.0;
            let (left, _) = self.column_row(Point::new(from.min(to) - TOUCH, y));
            let (right, _) = self.column_row(Point::new(from.max(to) + TOUCH, y));
            for column in left..=right {
                found.extend_from_slice(self.bucket(row * self.columns + column));
            }
        }
        found.sort_unstable();
        found.dedup();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_that_meets_is_found() {
        let boxes: Vec<Bounds> = (0..200)
            .map(|i| {
                let at = Point::new(f64::from(i * 37 % 101), f64::from(i * 53 % 97));
                Bounds { min: at, max: at + nalgebra::Vector2::new(f64::from(i % 30), 3.0) }
            })
            .collect();
        let buckets = Buckets::of(&boxes);
        let mut found = Vec::new();
        for (i, wanted) in boxes.iter().enumerate() {
            buckets.meeting(wanted, &mut found);
            assert!(found.windows(2).all(|w| w[0] < w[1]));
            for (k, other) in boxes.iter().enumerate() {
                assert!(!wanted.meets(other) || found.contains(&(k as u32)), "{i} {k}");
            }
            assert!(buckets.near(wanted.min).contains(&(i as u32)));
            // Every point of a segment lies in boxes that are found along it.
            let (a, b) = (wanted.min, boxes[(i * 71 + 5) % boxes.len()].max);
            buckets.along(a, b, &mut found);
            for step in 0..=50 {
                let p = a + (b - a) * (f64::from(step) / 50.0);
                for (k, other) in boxes.iter().enumerate() {
                    assert!(!other.contains(p) || found.contains(&(k as u32)), "{i} {k}");
                }
            }
        }
    }

    #[test]
    fn no_boxes_meet_nothing() {
        let mut found = vec![7];
        Buckets::of(&[]).meeting(&Bounds::of([Point::origin()]), &mut found);
        assert!(found.is_empty() && Buckets::default().near(Point::origin()).is_empty());
    }
}
