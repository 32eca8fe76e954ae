//! Walls of a log whose poses are known: the segments of all scans, those of one line joined (SPEC L6).

use nalgebra::{Isometry2, Matrix2, Point2, SymmetricEigen, Vector2};
use orthoframe_vectors::Segment;
use orthoframe_vectors::scan::{Extractor, Sensor};

use crate::faces::Face;
use crate::field::Field;
use crate::fit::{Met, met};
use crate::view::View;

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

/// Fewest beams of a segment that is taken: fewer join what lies before each other.
const BEAMS: f64 = 5.0;
/// Pieces that are held against what went through them, in cm.
const PIECE: f64 = 20.0;
/// Rounds in which what is not there is taken away: each lays open what it hid.
const ROUNDS: usize = 4;

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
    views: Vec<(Isometry2<f64>, View)>,
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
            let angle = segment.start.perp(&segment.end).atan2(segment.start.dot(&segment.end));
            let is_seen = angle.abs() >= BEAMS * sensor.step();
            if face.is_sound() && segment.length() >= SHORTEST && is_seen {
                self.join(face, weight(segment));
            }
        }
        self.extractor = extractor;
        self.views.push((*pose, View::new(sensor, ranges, 0.0)));
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

    /// The walls that at least two scans saw, without what more scans went through than ended at (SPEC V9).
    #[must_use]
    pub fn faces(&self) -> Vec<Face> {
        let whole = self.walls.iter().filter(|w| w.seen >= SEEN).map(|w| w.face);
        let mut pieces: Vec<(usize, Face)> =
            whole.enumerate().flat_map(|(k, face)| cut(&face).map(move |f| (k, f))).collect();
        for _ in 0..ROUNDS {
            let faces: Vec<Face> = pieces.iter().map(|p| p.1).collect();
            let field = Field::new(&faces);
            let mut counts = vec![(0_u32, 0_u32); faces.len()];
            for (pose, view) in &self.views {
                for beam in &view.beams {
                    match met(&field, &faces, pose, beam) {
                        Met::Face(face) => counts[face].0 += 1,
                        Met::Through(face) => counts[face].1 += 1,
                        Met::Before(_) | Met::Open => {}
                    }
                }
            }
            let mut counts = counts.into_iter();
            let before = pieces.len();
            pieces.retain(|_| counts.next().is_none_or(|(seen, through)| seen > through));
            if pieces.len() == before {
                break;
            }
        }
        joined(&pieces)
    }
}

/// A face in pieces.
fn cut(face: &Face) -> impl Iterator<Item = Face> + use<> {
    let count = (face.length() / PIECE).ceil().max(1.0) as u32;
    let (start, step) = (face.start, (face.end - face.start) / f64::from(count));
    (0..count)
        .map(move |k| Face::plain(start + step * f64::from(k), start + step * f64::from(k + 1)))
}

/// Pieces that follow each other on one wall, joined again.
fn joined(pieces: &[(usize, Face)]) -> Vec<Face> {
    let follows =
        |a: &(usize, Face), b: &(usize, Face)| a.0 == b.0 && (a.1.end - b.1.start).norm() < 0.1;
    let runs = pieces.chunk_by(follows);
    runs.map(|run| Face::plain(run[0].1.start, run[run.len() - 1].1.end)).collect()
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
