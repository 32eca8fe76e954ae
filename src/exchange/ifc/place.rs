//! Placements: chains of IfcLocalPlacement, axes, mapping operators → one affine frame.

use nalgebra::{Point3, Vector3};

use super::step::{Instance, Instances, Value};

/// A placement chain longer than this has no end.
const LONGEST: usize = 64;
/// Scales of mapping operators outside of this are none.
const SCALES: std::ops::Range<f64> = 1e-6..1e6;

/// A frame: `origin + x·X + y·Y + z·Z`. Its axes are at right angles to one another, as long as they scale, and
/// left-handed where a shape is mirrored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub origin: Point3<f64>,
    pub x: Vector3<f64>,
    pub y: Vector3<f64>,
    pub z: Vector3<f64>,
}

impl Default for Place {
    fn default() -> Self {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        Self { origin: Point3::origin(), x, y, z }
    }
}

impl Place {
    pub(super) fn apply(&self, p: Point3<f64>) -> Point3<f64> {
        self.origin + self.turn(p.coords)
    }

    pub(super) fn turn(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    /// The frame that leads from `inner`'s child to this frame's parent.
    pub(super) fn compose(&self, inner: &Self) -> Self {
        Self {
            origin: self.apply(inner.origin),
            x: self.turn(inner.x),
            y: self.turn(inner.y),
            z: self.turn(inner.z),
        }
    }

    /// The file's world on the plan: its unit in cm, and what is taken off every coordinate.
    pub(super) fn of_world(unit: f64, shift: Vector3<f64>) -> Self {
        let world = Self::default();
        Self {
            origin: Point3::from(-shift),
            x: world.x * unit,
            y: world.y * unit,
            z: world.z * unit,
        }
    }

    /// The direction of X on the plan, in radians; 0 where X stands upright.
    pub(super) fn heading(&self) -> f64 {
        let flat = self.x.xy();
        if flat.norm() > 1e-6 * self.x.norm() { flat.y.atan2(flat.x) } else { 0.0 }
    }

    /// The same frame seen from its own origin with its heading ahead: what all like things have in common.
    pub(super) fn unturned(&self) -> Self {
        let (sin, cos) = (-self.heading()).sin_cos();
        let turn =
            |v: Vector3<f64>| Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
        let (x, y, z) = (turn(self.x), turn(self.y), turn(self.z));
        Self { origin: Point3::origin(), x, y, z }
    }

    /// A frame with this Z and an X as near to the wanted one as may be (ISO 10303-42, `build_axes`).
    fn of_axes(origin: Point3<f64>, z: Option<Vector3<f64>>, x: Option<Vector3<f64>>) -> Self {
        let z = z.and_then(|z| z.try_normalize(1e-12)).unwrap_or_else(Vector3::z);
        let towards = x.unwrap_or_else(Vector3::x);
        let level = |v: Vector3<f64>| (v - z * v.dot(&z)).try_normalize(1e-9);
        let x = level(towards).or_else(|| level(Vector3::x())).or_else(|| level(Vector3::y()));
        let x = x.unwrap_or_else(Vector3::x);
        Self { origin, x, y: z.cross(&x), z }
    }

    /// IfcLocalPlacement with all that it stands in.
    pub(super) fn of_object(all: &Instances, id: Option<u32>) -> Self {
        let mut chain = Vec::new();
        let mut next = id;
        while let Some(local) = next.and_then(|id| all.get(id))
            && local.kind == "IFCLOCALPLACEMENT"
            && chain.len() < LONGEST
        {
            chain.push(Self::of_axis(all, local.at(1)));
            next = local.at(0).reference();
        }
        chain.iter().rev().fold(Self::default(), |outer, inner| outer.compose(inner))
    }

    /// IfcAxis2Placement3D or 2D, IfcAxis1Placement; the world's frame where there is none.
    pub(super) fn of_axis(all: &Instances, value: &Value) -> Self {
        let Some(axis) = value.reference().and_then(|id| all.get(id)) else {
            return Self::default();
        };
        let origin = point(all, axis.at(0)).unwrap_or_else(Point3::origin);
        match axis.kind {
            "IFCAXIS2PLACEMENT3D" => {
                Self::of_axes(origin, direction(all, axis.at(1)), direction(all, axis.at(2)))
            }
            "IFCAXIS2PLACEMENT2D" => Self::of_axes(origin, None, direction(all, axis.at(1))),
            "IFCAXIS1PLACEMENT" => Self::of_axes(origin, direction(all, axis.at(1)), None),
            _ => Self::default(),
        }
    }

    /// IfcCartesianTransformationOperator, of 2 or 3 dimensions, with one scale or three: where a mapped shape goes.
    pub(super) fn of_operator(all: &Instances, operator: &Instance) -> Self {
        let origin = point(all, operator.at(2)).unwrap_or_else(Point3::origin);
        let is_flat = operator.kind.starts_with("IFCCARTESIANTRANSFORMATIONOPERATOR2D");
        let z = if is_flat { None } else { direction(all, operator.at(4)) };
        let mut place = Self::of_axes(origin, z, direction(all, operator.at(0)));
        // A second axis to the other side mirrors.
        if direction(all, operator.at(1)).is_some_and(|y| y.dot(&place.y) < 0.0) {
            place.y = -place.y;
        }
        let scale = |at: usize| operator.at(at).number().filter(|s| SCALES.contains(s));
        let x = scale(3).unwrap_or(1.0);
        let (y, z) = match operator.kind {
            "IFCCARTESIANTRANSFORMATIONOPERATOR3DNONUNIFORM" => (scale(5), scale(6)),
            "IFCCARTESIANTRANSFORMATIONOPERATOR2DNONUNIFORM" => (scale(4), None),
            _ => (None, None),
        };
        place.x *= x;
        place.y *= y.unwrap_or(x);
        place.z *= z.unwrap_or(x);
        place
    }
}

/// IfcCartesianPoint; a missing third coordinate is 0.
pub(super) fn point(all: &Instances, value: &Value) -> Option<Point3<f64>> {
    let point = all.get(value.reference()?)?;
    (point.kind == "IFCCARTESIANPOINT").then(|| coordinates(point.at(0)))?
}

pub(super) fn coordinates(value: &Value) -> Option<Point3<f64>> {
    let mut numbers = value.list().iter().map(Value::number);
    let (x, y) = (numbers.next()??, numbers.next()??);
    let z = numbers.next().flatten().unwrap_or(0.0);
    let sound = [x, y, z].iter().all(|n| n.abs() < 1e12);
    sound.then(|| Point3::new(x, y, z))
}

pub(super) fn direction(all: &Instances, value: &Value) -> Option<Vector3<f64>> {
    let direction = all.get(value.reference()?)?;
    if direction.kind != "IFCDIRECTION" {
        return None;
    }
    coordinates(direction.at(0)).map(|p| p.coords)
}
