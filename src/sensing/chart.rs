//! What a laser can meet at its height, as segments, with a raster over them for what asks for much at once.

use std::cmp::Ordering;
use std::collections::HashSet;
use std::f64::consts::PI;

use nalgebra::{Isometry2, Point2, Vector2};
use parry2d_f64::math::Vector as Vec2;
use parry2d_f64::query::Ray;
use parry2d_f64::shape::{CompositeShapeRef, Polyline};

use crate::geometry::{Blocker, FloorPlan, Front, SeenFace, Stretch, nearest_on_segment};
use crate::map::World;
use crate::vectors::Segment;
use crate::vectors::read::Scan;
use crate::vectors::scan::{Extractor, Sensor};

/// A stretch that stops a beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    pub start: Point2<f64>,
    pub end: Point2<f64>,
    /// From where it is seen.
    pub front: Front,
    /// What of the Map it belongs to.
    pub face: Option<SeenFace>,
}

impl Line {
    /// A stretch of nothing known, seen from both sides.
    #[must_use]
    pub fn between(start: Point2<f64>, end: Point2<f64>) -> Self {
        Self { start, end, front: Front::Both, face: None }
    }

    pub(crate) fn direction(&self) -> Vector2<f64> {
        (self.end - self.start).normalize()
    }

    /// The nearest point of it.
    pub(crate) fn nearest(&self, p: Point2<f64>) -> Point2<f64> {
        nearest_on_segment(p, self.start, self.end)
    }
}

/// All that a laser can meet at one height.
pub struct Chart {
    lines: Vec<Line>,
    shape: Option<Polyline>,
    /// How far the ends of its lines may be off, in cm.
    ends: f64,
    pub(crate) low: Point2<f64>,
    pub(crate) high: Point2<f64>,
    /// The lines near each bucket of [`BUCKET`] cm, the nearest to its middle first, with how far they lie from that.
    buckets: Vec<Vec<(f32, u32)>>,
    columns: usize,
    /// Lower left corner of the first bucket: what lies a little outside of all lines is near one too.
    corner: Point2<f64>,
}

/// Side of a bucket, in cm; lines up to [`NEAR`] away are in it.
const BUCKET: f64 = 25.0;
const NEAR: f64 = 40.0;
/// Shorter stretches than this are no walls of a log, in cm.
const LEAST_WALL: f64 = 25.0;

/// What the ends of a line err that was seen, in cm.
pub(crate) const ENDS: f64 = 3.0;

/// Where walls have been seen, and along which of [`COURSES`] courses, in cells of [`CELL`] cm.
#[derive(Default)]
struct Covered {
    cells: HashSet<(i32, i32, i32)>,
}

const CELL: f64 = 10.0;
const COURSES: i32 = 24;

impl Covered {
    /// Whether a line tells of something new: then it is known from now on.
    fn takes_in(&mut self, line: &Line) -> bool {
        let along = line.direction();
        let turn = along.y.atan2(along.x).rem_euclid(PI) / PI * f64::from(COURSES);
        let course = turn.round() as i32;
        let count = ((line.end - line.start).norm() / (CELL / 2.0)).ceil() as usize;
        let at = |n: usize| {
            let p = line.start + (line.end - line.start) * (n as f64 / count as f64);
            ((p.x / CELL).floor() as i32, (p.y / CELL).floor() as i32)
        };
        let is_known = |(x, y): (i32, i32)| {
            (-1..=1).any(|dx| {
                (-1..=1).any(|dy| {
                    (-1..=1).any(|by| {
                        let course = (course + by).rem_euclid(COURSES);
                        self.cells.contains(&(x + dx, y + dy, course))
                    })
                })
            })
        };
        let known = (0..=count).filter(|&n| is_known(at(n))).count();
        let is_new = known as f64 <= 0.9 * (count + 1) as f64;
        if is_new {
            let course = course.rem_euclid(COURSES);
            self.cells.extend((0..=count).map(at).map(|(x, y)| (x, y, course)));
        }
        is_new
    }
}

impl Chart {
    /// The Map's faces at `height` cm above its zero, door leaves as they stand.
    #[must_use]
    pub fn of_map(world: &World, plan: &FloorPlan, height: f64) -> Self {
        let sight = plan.sight(world, height);
        let line = |Stretch { face, start, end, front }| Line {
            start: Point2::new(start.x, start.y),
            end: Point2::new(end.x, end.y),
            front,
            face: Some(face),
        };
        Self::new(sight.faces().map(line).collect())
    }

    /// The walls of scans whose poses are known.
    #[must_use]
    pub fn of_scans<'s>(scans: impl IntoIterator<Item = (&'s Sensor, &'s Scan)>) -> Self {
        let mut extractor = Extractor::new();
        let (mut lines, mut known) = (Vec::new(), Covered::default());
        for (sensor, scan) in scans {
            let Some(pose) = scan.pose else { continue };
            let placed = |p: nalgebra::SVector<f64, 2>| pose * Point2::from(p);
            let segments = extractor.segments(sensor, &scan.ranges).iter();
            let long = segments.filter(|segment| segment.length() >= LEAST_WALL);
            let line =
                |segment: &Segment<2>| Line::between(placed(segment.start), placed(segment.end));
            lines.extend(long.map(line).filter(|line| known.takes_in(line)));
        }
        Self::new(lines).erring(ENDS)
    }

    /// The same without the leaves of doors, which stand now so and now otherwise.
    #[must_use]
    pub fn without_leaves(&self) -> Self {
        let is_fixed = |line: &&Line| {
            let blocker = line.face.map(|face| face.blocker);
            !matches!(blocker, Some(Blocker::DoorLeaf { .. }))
        };
        Self::new(self.lines.iter().filter(is_fixed).copied().collect()).erring(self.ends)
    }

    #[must_use]
    pub fn new(mut lines: Vec<Line>) -> Self {
        let is_sound = |line: &Line| {
            let ends = [line.start.x, line.start.y, line.end.x, line.end.y];
            ends.iter().all(|x| x.is_finite()) && (line.end - line.start).norm() > 1e-6
        };
        lines.retain(is_sound);
        let (mut low, mut high) = (Point2::new(0.0, 0.0), Point2::new(0.0, 0.0));
        if let Some(first) = lines.first() {
            (low, high) = (first.start, first.start);
        }
        for p in lines.iter().flat_map(|line| [line.start, line.end]) {
            low = low.inf(&p);
            high = high.sup(&p);
        }
        let corner = low - Vector2::repeat(NEAR);
        let size = ((high - low).add_scalar(2.0 * NEAR) / BUCKET).map(|x| x as usize + 1);
        let mut buckets = vec![Vec::new(); size.x * size.y];
        for (number, line) in lines.iter().enumerate() {
            let (a, b) = (line.start.inf(&line.end), line.start.sup(&line.end));
            let first = ((a - corner).add_scalar(-NEAR) / BUCKET).map(|x| x.max(0.0) as usize);
            let last = ((b - corner).add_scalar(NEAR) / BUCKET).map(|x| x.max(0.0) as usize);
            for row in first.y..=last.y.min(size.y - 1) {
                for column in first.x..=last.x.min(size.x - 1) {
                    let middle =
                        corner + Vector2::new(column as f64 + 0.5, row as f64 + 0.5) * BUCKET;
                    let reach = BUCKET * std::f64::consts::FRAC_1_SQRT_2 + NEAR;
                    let far = (line.nearest(middle) - middle).norm();
                    if far <= reach {
                        buckets[row * size.x + column].push((far as f32, number as u32));
                    }
                }
            }
        }
        for bucket in &mut buckets {
            bucket.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
        let vertices = lines.iter().flat_map(|line| [line.start, line.end]);
        let vertices = vertices.map(|p| Vec2::new(p.x, p.y)).collect();
        let indices = (0..lines.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        let shape = (!lines.is_empty()).then(|| Polyline::new(vertices, Some(indices)));
        Self { lines, shape, ends: 0.0, low, high, buckets, columns: size.x, corner }
    }

    /// The same where the ends of its lines may be off by so many cm, as those of walls that were themselves measured or drawn.
    #[must_use]
    pub fn erring(self, ends: f64) -> Self {
        Self { ends, ..self }
    }

    pub(crate) fn ends(&self) -> f64 {
        self.ends
    }

    #[must_use]
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// The line nearest to a point, with the nearest point of it, where one is within 40 cm.
    #[must_use]
    pub fn nearest(&self, p: Point2<f64>) -> Option<(u32, Point2<f64>)> {
        let at = (p - self.corner) / BUCKET;
        if at.x < 0.0 || at.y < 0.0 || at.x as usize >= self.columns {
            return None;
        }
        let near = self.buckets.get(at.y as usize * self.columns + at.x as usize)?;
        let middle = self.corner + at.map(|x| x.floor() + 0.5) * BUCKET;
        let off = (p - middle).norm();
        // Of two that meet at the nearest point the first one.
        let (mut far, mut best) = (NEAR, None);
        for &(from_middle, number) in near {
            // Neither is it nearer than so, nor are those after it; singles are rounded.
            if f64::from(from_middle) - off > far + 1e-3 {
                break;
            }
            let foot = self.lines[number as usize].nearest(p);
            let here = (foot - p).norm();
            let is_nearer = match here.total_cmp(&far) {
                Ordering::Less => true,
                Ordering::Equal => best.is_none_or(|(known, _)| number < known),
                Ordering::Greater => false,
            };
            if is_nearer {
                (far, best) = (here, Some((number, foot)));
            }
        }
        best
    }

    /// The lines near a point, of those within 40 cm all.
    pub(crate) fn about(&self, p: Point2<f64>) -> impl Iterator<Item = usize> + use<'_> {
        let at = (p - self.corner) / BUCKET;
        let is_within = at.x >= 0.0 && at.y >= 0.0 && (at.x as usize) < self.columns;
        let bucket = at.y as usize * self.columns + at.x as usize;
        let near = self.buckets.get(bucket).filter(|_| is_within);
        near.into_iter().flatten().map(|(_, number)| *number as usize)
    }

    /// Whether no line lies within a distance of a point.
    pub(crate) fn is_clear(&self, p: Point2<f64>, radius: f64) -> bool {
        if radius <= NEAR {
            return self.nearest(p).is_none_or(|(_, foot)| (foot - p).norm() > radius);
        }
        self.lines.iter().all(|line| (line.nearest(p) - p).norm() > radius)
    }

    /// The first line that a beam meets between two distances, and how far it lies, in cm.
    pub(crate) fn next_on(
        &self,
        pose: &Isometry2<f64>,
        bearing: f64,
        from: f64,
        to: f64,
    ) -> Option<(f64, u32)> {
        if to <= from {
            return None;
        }
        let ahead = pose.rotation * Vector2::new(bearing.cos(), bearing.sin()) * from;
        let begun = Isometry2::from_parts((pose.translation.vector + ahead).into(), pose.rotation);
        let (distance, line) = self.cast(&begun, bearing, to - from);
        line.map(|line| (from + distance, line))
    }

    /// How far a beam goes, in cm, and which line ends it; the range where nothing does.
    #[must_use]
    pub fn cast(&self, pose: &Isometry2<f64>, bearing: f64, range: f64) -> (f64, Option<u32>) {
        let direction = pose.rotation * Vector2::new(bearing.cos(), bearing.sin());
        let from = pose.translation.vector;
        let ray = Ray::new(Vec2::new(from.x, from.y), Vec2::new(direction.x, direction.y));
        let hit = self
            .shape
            .as_ref()
            .and_then(|shape| CompositeShapeRef(shape).cast_local_ray(&ray, range, true));
        hit.map_or((range, None), |(line, distance)| (distance, Some(line)))
    }
}
