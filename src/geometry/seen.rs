//! What is seen from a pose in space (M12), face by face: tops from above, what stands low hidden behind what stands high,
//! things on open shelves.
//!
//! Every face is a flat polygon. What lies between the eye and a face casts a shadow on the face's plane; all shadows are
//! taken from the face by one boolean operation on an integer grid, so what is left is exactly what is seen.
//!
//! ```text
//!      eye ·───────────┐ shadow
//!           ˙ ˙ . ▐────▓  of the box on the wall
//!                 ▐box ▓
//!                      │ seen
//! ```
//!
//! **Invariant**: of a solid body only faces that look towards the eye are seen; of one that can be looked into, or that
//! holds the eye, both sides of each.

use nalgebra::{Point3, Vector3};

use crate::units::Vector;

use super::eye::Eye;
use super::faces::{Backs, Face, Faces, Plane, Sheet};
use super::grid::{Grid, difference};
use super::scene::Prism;
use super::{Bounds, Polygon, Region};

/// Faces in one plane do not hide each other, cm.
const FLUSH: f64 = 1e-3;
/// Pieces that are smaller are taken for rounding, cm².
const SPECK: f64 = 1e-2;

/// What is seen of a face.
#[derive(Debug, Clone)]
pub struct FaceInView {
    pub face: Face,
    /// Of what is seen, cm².
    pub area: f64,
    /// Of the whole face, cm².
    pub whole: f64,
    /// From the eye to the middle of the largest piece that is seen, cm.
    pub distance: f64,
    plane: Plane,
    seen: Vec<Region>,
}

impl FaceInView {
    /// Whether a point on the face's plane is seen.
    #[must_use]
    pub fn contains(&self, p: Point3<f64>, tolerance: f64) -> bool {
        let flat = self.plane.flat(p);
        self.plane.height(p).abs() <= tolerance.max(1e-3)
            && self.seen.iter().any(|region| region.contains(flat, tolerance))
    }

    /// The pieces that are seen, each by its outline in space.
    pub fn outlines(&self) -> impl Iterator<Item = Vec<Point3<f64>>> + '_ {
        let lift = |r: &Region| r.outer.corners.iter().map(|&p| self.plane.lift(p)).collect();
        self.seen.iter().map(lift)
    }

    /// How large it looks: the part of the unit sphere about the eye that it takes, about, in steradians.
    #[must_use]
    pub fn apparent_size(&self, eye: &Eye) -> f64 {
        let slant = self.plane.height(eye.at()).abs() / self.distance.max(1e-9);
        self.area * slant / (self.distance * self.distance).max(1.0)
    }
}

impl Faces {
    /// The faces that are seen, those that look largest first.
    #[must_use]
    pub fn in_view(&self, eye: &Eye) -> Vec<FaceInView> {
        let at = eye.at();
        let holds = |p: &Prism| {
            let is_level = p.bottom < eye.height && eye.height < p.top;
            is_level && p.section(eye.height).contains(eye.pose.at, 0.0)
        };
        let within: Vec<bool> = self.bodies.iter().map(holds).collect();
        // What turns its back to the eye casts no shadow of its own: the body's other faces do.
        let near: Vec<&Sheet> = self
            .sheets
            .iter()
            .filter(|s| (s.centre - at).norm() - s.radius <= eye.range)
            .filter(|s| match s.backs {
                Backs::Inside(body) => within[body] || s.plane.height(at) > 0.0,
                Backs::Seen | Backs::Hiding => true,
            })
            .collect();
        let mut hiding: Vec<Cone<'_>> = near.iter().map(|s| Cone::of(s, at)).collect();
        // The large ones first: one of them may hide all.
        hiding.sort_by(|a, b| b.half.total_cmp(&a.half));
        let looks = |s: &&&Sheet| s.backs != Backs::Hiding || s.plane.height(at) > 0.0;
        let mut seen: Vec<FaceInView> =
            near.iter().filter(looks).filter_map(|s| s.seen(eye, &hiding)).collect();
        seen.sort_by(|a, b| {
            b.apparent_size(eye).total_cmp(&a.apparent_size(eye)).then(a.face.cmp(&b.face))
        });
        seen
    }
}

/// The directions in which a face is seen, and how far off it is.
struct Cone<'s> {
    sheet: &'s Sheet,
    axis: Vector3<f64>,
    /// Radians; the whole sphere about an eye that is nearer than the face is large.
    half: f64,
    nearest: f64,
    farthest: f64,
}

impl<'s> Cone<'s> {
    fn of(sheet: &'s Sheet, eye: Point3<f64>) -> Self {
        let way = sheet.centre - eye;
        let far = way.norm();
        let half =
            if far > sheet.radius { (sheet.radius / far).asin() } else { std::f64::consts::PI };
        let axis = way.try_normalize(1e-9).unwrap_or_else(Vector3::x);
        Self { sheet, axis, half, nearest: far - sheet.radius, farthest: far + sheet.radius }
    }

    fn may_hide(&self, other: &Self) -> bool {
        let both = self.half + other.half;
        self.nearest <= other.farthest
            && (both >= std::f64::consts::PI || self.axis.dot(&other.axis) >= both.cos() - 1e-9)
    }
}

impl Sheet {
    fn seen(&self, eye: &Eye, hiding: &[Cone<'_>]) -> Option<FaceInView> {
        let at = eye.at();
        let height = self.plane.height(at);
        if height.abs() <= FLUSH {
            return None;
        }
        let (mut shown, mut shadows) = (vec![self.corners.clone()], Vec::new());
        if let Some([right, left]) = eye.bounds() {
            let ends = [(right, 1.0), (left, -1.0)];
            let inside = |(way, sign): (Vector3<f64>, f64)| Vector3::new(-way.y, way.x, 0.0) * sign;
            let [a, b] = ends.map(inside);
            if eye.field <= 180.0 {
                let one = clipped(&clipped(&shown[0], a, a.dot(&at.coords)), b, b.dot(&at.coords));
                shown = vec![one];
            } else {
                // All but the wedge behind.
                let behind =
                    clipped(&clipped(&shown[0], -a, -a.dot(&at.coords)), -b, -b.dot(&at.coords));
                shadows.push(self.flat(&behind));
            }
        }
        let mut floor = self.flat(&shown[0]);
        if floor.corners.iter().any(|&p| (self.plane.lift(p) - at).norm() > eye.range) {
            floor = floor.within_convex(&self.in_range(at, height, eye.range)?);
        }
        let floor = floor.counter_clockwise();
        if floor.corners.len() < 3 || floor.signed_area() <= SPECK {
            return None;
        }
        let frame = floor.bounds();
        let whole_frame = (frame.max - frame.min).product();
        let own = Cone::of(self, at);
        for other in hiding {
            if std::ptr::eq(other.sheet, self) || !other.may_hide(&own) {
                continue;
            }
            let Some(shadow) = self.shadow_of(other.sheet, at, height, &frame) else { continue };
            if shadow.signed_area() >= whole_frame * (1.0 - 1e-12) {
                return None;
            }
            shadows.push(shadow);
        }
        let grid = Grid::over(&frame);
        let shadows: Vec<_> = shadows.iter().map(|s| grid.contour(s)).collect();
        let shapes = difference(&[grid.contour(&floor)], &shadows);
        let mut seen = grid.regions(&shapes);
        seen.retain(|region| region.area() > SPECK);
        let largest = seen.iter().max_by(|a, b| a.area().total_cmp(&b.area()))?;
        let distance = (self.plane.lift(largest.outer.centroid()) - at).norm();
        Some(FaceInView {
            face: self.face,
            area: seen.iter().map(Region::area).sum(),
            whole: self.flat(&self.corners).signed_area().abs(),
            distance,
            plane: self.plane,
            seen,
        })
    }

    fn flat(&self, corners: &[Point3<f64>]) -> Polygon {
        Polygon::new(corners.iter().map(|&p| self.plane.flat(p)).collect()).counter_clockwise()
    }

    /// The circle on the plane within which the eye sees so far, by a polygon within it.
    fn in_range(&self, eye: Point3<f64>, height: f64, range: f64) -> Option<Polygon> {
        const CORNERS: usize = 96;
        let radius = (range * range - height * height).max(0.0).sqrt();
        let foot = self.plane.flat(eye);
        let corner = |k: usize| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / CORNERS as f64).sin_cos();
            foot + Vector::new(cos, sin) * radius
        };
        (radius > 0.0).then(|| Polygon::new((0..CORNERS).map(corner).collect()))
    }

    /// What another face hides of this one's plane, within a frame.
    fn shadow_of(
        &self,
        other: &Self,
        eye: Point3<f64>,
        height: f64,
        frame: &Bounds,
    ) -> Option<Polygon> {
        /// As a share of the way from the eye to the plane, below which a shadow would reach to infinity.
        const NEAREST: f64 = 1e-6;
        let normal = self.plane.normal * height.signum();
        let level = normal.dot(&self.plane.origin.coords);
        let above = |p: &Point3<f64>| normal.dot(&p.coords) - level;
        // In one plane: the back of what stands against a wall is not seen through it, nor the wall through that back
        // by an eye within the thing.
        let faces_eye = other.plane.height(eye) > 0.0;
        let covers = match (self.backs, other.backs) {
            (Backs::Hiding, Backs::Inside(_)) => !faces_eye,
            (Backs::Inside(_) | Backs::Seen, Backs::Hiding) => faces_eye && height > 0.0,
            _ => false,
        };
        let margin = if covers { -2.0 * FLUSH } else { FLUSH };
        if other.corners.iter().all(|p| above(p) <= margin) {
            return None;
        }
        let over = clipped(&other.corners, normal, level + margin);
        let between = clipped(&over, -normal, -(level + height.abs() * (1.0 - NEAREST)));
        if between.len() < 3 {
            return None;
        }
        let cast = |p: &Point3<f64>| {
            let share = (height.abs() - above(p)) / height.abs();
            self.plane.flat(eye + (p - eye) / share)
        };
        let shadow = Polygon::new(between.iter().map(cast).collect()).clipped(frame);
        let shadow = shadow.counter_clockwise();
        (shadow.corners.len() >= 3 && shadow.signed_area() > 0.0).then_some(shadow)
    }
}

/// The part of a flat polygon where `normal · p ≥ offset`.
fn clipped(corners: &[Point3<f64>], normal: Vector3<f64>, offset: f64) -> Vec<Point3<f64>> {
    let depth = |p: &Point3<f64>| normal.dot(&p.coords) - offset;
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, a) in corners.iter().enumerate() {
        let b = &corners[(i + 1) % corners.len()];
        let (from, to) = (depth(a), depth(b));
        if from >= 0.0 {
            kept.push(*a);
        }
        if (from >= 0.0) != (to >= 0.0) {
            kept.push(a + (b - a) * (from / (from - to)));
        }
    }
    kept
}
