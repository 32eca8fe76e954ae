//! Walls of a log whose poses are known: the segments of all scans, those of one line joined (SPEC L6).

use nalgebra::{Isometry2, Matrix2, Point2, SymmetricEigen, Vector2};
use orthoframe_vectors::Segment;
use orthoframe_vectors::scan::{Extractor, Sensor};

use crate::faces::Face;

/// Two segments of one wall differ in direction by a sine of at most this.
const TURN: f64 = 0.09;
/// They lie apart across it by at most this, in cm.
const APART: f64 = 8.0;
/// And along it, in cm.
const GAP: f64 = 15.0;
/// Shortest segment that is taken, in cm.
const SHORTEST: f64 = 12.0;
/// Scans that must have seen a wall.
const SEEN: usize = 2;

/// A line as it grows: moments of the points along its segments.
struct Growing {
    mass: f64,
    sum: Vector2<f64>,
    square: Matrix2<f64>,
    face: Face,
    seen: usize,
    last: usize,
}

/// Joins what scans saw into walls.
#[derive(Default)]
pub struct Walls {
    walls: Vec<Growing>,
    cells: std::collections::HashMap<(i32, i32), Vec<usize>>,
    scans: usize,
    extractor: Extractor,
}

const CELL: f64 = 100.0;

impl Walls {
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a scan taken at `pose` (sensor → Map, cm and rad); `ranges` are cm, one a beam.
    pub fn add(&mut self, sensor: &Sensor, ranges: &[f64], pose: &Isometry2<f64>) {
        let mut extractor = std::mem::take(&mut self.extractor);
        let place = |p: Vector2<f64>| (pose * Point2::from(p)).coords;
        for segment in extractor.segments(sensor, ranges) {
            let face = Face::plain(place(segment.start), place(segment.end));
            if face.is_sound() && segment.length() >= SHORTEST {
                self.join(face, weight(segment));
            }
        }
        self.extractor = extractor;
        self.scans += 1;
    }

    fn join(&mut self, face: Face, weight: f64) {
        let mut near: Vec<usize> =
            cells(&face).filter_map(|c| self.cells.get(&c)).flatten().copied().collect();
        near.sort_unstable();
        near.dedup();
        let own = near.into_iter().find(|k| is_one(&self.walls[*k].face, &face));
        let number = own.unwrap_or_else(|| {
            let wall = Growing {
                mass: 0.0,
                sum: Vector2::zeros(),
                square: Matrix2::zeros(),
                face,
                seen: 0,
                last: usize::MAX,
            };
            self.walls.push(wall);
            self.walls.len() - 1
        });
        let wall = &mut self.walls[number];
        wall.grow(&face, weight);
        if wall.last != self.scans {
            wall.seen += 1;
            wall.last = self.scans;
        }
        for cell in cells(&wall.face) {
            let here = self.cells.entry(cell).or_default();
            if !here.contains(&number) {
                here.push(number);
            }
        }
    }

    /// The walls that at least two scans saw.
    #[must_use]
    pub fn faces(&self) -> Vec<Face> {
        self.walls.iter().filter(|w| w.seen >= SEEN).map(|w| w.face).collect()
    }
}

/// A segment weighs by its length, and less the less is known of it.
fn weight(segment: &Segment<2>) -> f64 {
    let variance = segment.covariance.start.trace() + segment.covariance.end.trace();
    segment.length() / variance.clamp(1.0, 1e4)
}

fn cells(face: &Face) -> impl Iterator<Item = (i32, i32)> + use<> {
    let (low, high) = (face.start.inf(&face.end), face.start.sup(&face.end));
    let steps = (face.length() / (0.5 * CELL)).ceil().max(1.0) as u32;
    let (start, along) = (face.start, face.end - face.start);
    debug_assert!(low <= high);
    (0..=steps).flat_map(move |step| {
        let p = start + along * (f64::from(step) / f64::from(steps));
        let (x, y) = ((p.x / CELL).floor() as i32, (p.y / CELL).floor() as i32);
        (-1..=1).flat_map(move |i| (-1..=1).map(move |j| (x + i, y + j)))
    })
}

/// Whether both are pieces of one wall.
fn is_one(wall: &Face, face: &Face) -> bool {
    let (t, length) = (wall.direction(), wall.length());
    let across = |p: Vector2<f64>| t.perp(&(p - wall.start)).abs();
    let along = |p: Vector2<f64>| t.dot(&(p - wall.start));
    let (s, e) = (along(face.start), along(face.end));
    let (low, high) = (s.min(e), s.max(e));
    // A wall is seen from one side: what is seen from the other is another face.
    t.dot(&face.direction()) > 0.0
        && t.perp(&face.direction()).abs() < TURN.max(8.0 / face.length().min(length))
        && across(face.start).max(across(face.end)) < APART
        && low < length + GAP
        && high > -GAP
}

impl Growing {
    fn grow(&mut self, face: &Face, weight: f64) {
        let (centre, v) = ((face.start + face.end) * 0.5, face.end - face.start);
        self.mass += weight;
        self.sum += centre * weight;
        self.square += (centre * centre.transpose() + v * v.transpose() / 12.0) * weight;
        let mean = self.sum / self.mass;
        let scatter = self.square / self.mass - mean * mean.transpose();
        let eigen = SymmetricEigen::new(scatter);
        let mut t: Vector2<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
        if t.dot(&self.face.direction()) < 0.0 {
            t = -t;
        }
        let ends = [self.face.start, self.face.end, face.start, face.end];
        let places = ends.map(|p| t.dot(&(p - mean)));
        let low = places.iter().copied().fold(f64::INFINITY, f64::min);
        let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.face = Face::plain(mean + t * low, mean + t * high);
    }
}
