//! How far it is from anywhere to the nearest face, on a grid: what makes it cheap to ask whether a scan fits.
//!
//! The nearest face of each cell comes of an exact distance transform (Felzenszwalb and Huttenlocher 2012), carried out
//! along columns and then along rows, that keeps beside each distance the face it is of. Where a number must be exact,
//! the face itself is asked.

use nalgebra::Vector2;

use crate::faces::Face;

/// Finest cell, in cm.
const FINEST: f64 = 5.0;
/// Most cells; a larger Map has coarser ones.
const MOST_CELLS: f64 = 1.6e7;
/// Free border about the faces, in cm.
const BORDER: f64 = 100.0;
const NONE: u32 = u32::MAX;

/// Distances to faces.
#[derive(Debug, Clone)]
pub(crate) struct Field {
    low: Vector2<f64>,
    cell: f64,
    width: usize,
    height: usize,
    /// To the nearest face from the middle of the cell, about, in cm.
    distances: Vec<f32>,
    nearest: Vec<u32>,
}

impl Field {
    pub(crate) fn new(faces: &[Face]) -> Self {
        let ends = || faces.iter().flat_map(|f| [f.start, f.end]);
        let low = ends().reduce(|a, b| a.inf(&b)).unwrap_or_default().add_scalar(-BORDER);
        let high = ends().reduce(|a, b| a.sup(&b)).unwrap_or_default().add_scalar(BORDER);
        let span = high - low;
        let cell = (span.x * span.y / MOST_CELLS).sqrt().max(span.max() / 1e6).max(FINEST);
        let width = (span.x / cell).ceil().max(1.0) as usize;
        let height = (span.y / cell).ceil().max(1.0) as usize;
        let mut nearest = vec![NONE; width * height];
        for (number, face) in faces.iter().enumerate() {
            let steps = (face.length() / (cell * 0.4)).ceil().max(1.0);
            for step in 0..=steps as u32 {
                let p = face.start + (face.end - face.start) * (f64::from(step) / steps);
                let at = (p - low) / cell;
                let (x, y) = ((at.x as usize).min(width - 1), (at.y as usize).min(height - 1));
                nearest[y * width + x] = number as u32;
            }
        }
        let mut field = Self { low, cell, width, height, distances: Vec::new(), nearest };
        field.spread();
        field
    }

    /// Carries each face to the cells that it is nearest to.
    fn spread(&mut self) {
        let (width, height) = (self.width, self.height);
        let far = 1e12_f32;
        let mut squares: Vec<f32> =
            self.nearest.iter().map(|n| if *n == NONE { far } else { 0.0 }).collect();
        let mut line = Line::new(width.max(height));
        for x in 0..width {
            line.run(&mut squares, &mut self.nearest, x, width, height);
        }
        for y in 0..height {
            line.run(&mut squares, &mut self.nearest, y * width, 1, width);
        }
        for square in &mut squares {
            *square = square.sqrt() * self.cell as f32;
        }
        self.distances = squares;
    }

    fn index(&self, p: &Vector2<f64>) -> Option<usize> {
        let at = (p - self.low) / self.cell;
        let inside = at.x >= 0.0 && at.y >= 0.0;
        let (x, y) = (at.x as usize, at.y as usize);
        (inside && x < self.width && y < self.height).then(|| y * self.width + x)
    }

    /// About how far the nearest face is, in cm; far outside of the grid.
    pub(crate) fn distance(&self, p: &Vector2<f64>) -> f64 {
        self.index(p).map_or(1e6, |k| f64::from(self.distances[k]))
    }

    /// The face that is nearest to a point.
    pub(crate) fn nearest(&self, p: &Vector2<f64>) -> Option<usize> {
        let found = self.nearest[self.index(p)?];
        (found != NONE).then_some(found as usize)
    }

    /// What a beam along the unit vector `u` strikes first within `reach` cm: its range and face.
    pub(crate) fn strike(
        &self,
        faces: &[Face],
        from: &Vector2<f64>,
        u: &Vector2<f64>,
        reach: f64,
    ) -> Option<(f64, usize)> {
        let mut range = 0.0;
        while range < reach {
            let p = from + u * range;
            let index = self.index(&p)?;
            let free = f64::from(self.distances[index]);
            if free <= 1.5 * self.cell && self.nearest[index] != NONE {
                let number = self.nearest[index] as usize;
                if let Some(hit) = meet(&faces[number], from, u)
                    && hit > 0.0
                    && (hit - range).abs() <= 3.0 * self.cell
                {
                    return (hit < reach).then_some((hit, number));
                }
            }
            range += (free - 1.5 * self.cell).max(0.5 * self.cell);
        }
        None
    }
}

/// Range at which a ray meets a face, half a centimetre beyond its ends too.
fn meet(face: &Face, from: &Vector2<f64>, u: &Vector2<f64>) -> Option<f64> {
    let (v, w) = (face.end - face.start, face.start - from);
    let sine = u.perp(&v);
    if sine.abs() < 1e-9 {
        return None;
    }
    let (range, share) = (w.perp(&v) / sine, w.perp(u) / sine);
    let slack = 0.5 / face.length();
    (share >= -slack && share <= 1.0 + slack).then_some(range)
}

/// One run of the distance transform along a line of cells: the lower envelope of parabolas.
struct Line {
    values: Vec<f32>,
    labels: Vec<u32>,
    feet: Vec<usize>,
    borders: Vec<f32>,
}

impl Line {
    fn new(longest: usize) -> Self {
        Self {
            values: vec![0.0; longest],
            labels: vec![NONE; longest],
            feet: vec![0; longest],
            borders: vec![0.0; longest + 1],
        }
    }

    fn run(
        &mut self,
        squares: &mut [f32],
        nearest: &mut [u32],
        at: usize,
        step: usize,
        count: usize,
    ) {
        for k in 0..count {
            self.values[k] = squares[at + k * step];
            self.labels[k] = nearest[at + k * step];
        }
        let mut top: Option<usize> = None;
        for q in 0..count {
            if self.labels[q] == NONE {
                continue;
            }
            let lift = |k: usize| (k as f32).mul_add(k as f32, self.values[k]);
            let mut border = f32::NEG_INFINITY;
            while let Some(k) = top {
                let foot = self.feet[k];
                border = (lift(q) - lift(foot)) / (2.0 * (q - foot) as f32);
                if border > self.borders[k] {
                    break;
                }
                top = k.checked_sub(1);
                border = f32::NEG_INFINITY;
            }
            let next = top.map_or(0, |k| k + 1);
            self.feet[next] = q;
            self.borders[next] = border;
            top = Some(next);
        }
        let Some(top) = top else { return };
        let mut k = 0;
        for q in 0..count {
            while k < top && self.borders[k + 1] < q as f32 {
                k += 1;
            }
            let foot = self.feet[k];
            let apart = q.abs_diff(foot) as f32;
            squares[at + q * step] = apart.mul_add(apart, self.values[foot]);
            nearest[at + q * step] = self.labels[foot];
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn worlds() -> impl Strategy<Value = Vec<Face>> {
        let end = (-500.0..500.0, -500.0..500.0);
        let face = (end.clone(), end).prop_map(|(a, b): ((f64, f64), (f64, f64))| {
            Face::plain(Vector2::new(a.0, a.1), Vector2::new(b.0, b.1))
        });
        prop::collection::vec(face.prop_filter("a face has a length", Face::is_sound), 1..12)
    }

    proptest! {
        /// Against all faces.
        #[test]
        fn distances_are_those_of_the_nearest_face(faces in worlds(), x in -500.0..500.0, y in -500.0..500.0) {
            let p = Vector2::new(x, y);
            let least = faces.iter().map(|f| f.distance(&p)).fold(f64::INFINITY, f64::min);
            let field = Field::new(&faces);
            if field.index(&p).is_some() {
                prop_assert!((field.distance(&p) - least).abs() <= 2.0 * field.cell);
            }
        }

        /// Against all faces: a beam is never longer than it can be by more than what lies about a corner.
        #[test]
        fn beams_end_at_the_first_face(faces in worlds(), x in -400.0..400.0, y in -400.0..400.0, turn in -3.1..3.1) {
            let (from, u) = (Vector2::new(x, y), Vector2::new(f64::cos(turn), f64::sin(turn)));
            let first = faces.iter().filter_map(|f| meet(f, &from, &u)).filter(|r| *r > 0.0);
            let first = first.fold(f64::INFINITY, f64::min);
            let field = Field::new(&faces);
            if let Some((range, face)) = field.strike(&faces, &from, &u, 1e4) {
                prop_assert!(range >= first - 1e-6);
                prop_assert!(meet(&faces[face], &from, &u).is_some());
            }
        }
    }
}
