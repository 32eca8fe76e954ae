//! Placements: chains of IfcLocalPlacement, axes, mapping operators → one rigid frame.

use nalgebra::{Point3, Vector3};

use super::step::{Instance, Instances, Value};

/// A placement chain longer than this has no end.
const LONGEST: usize = 64;

/// A right-handed frame with a scale: `origin + scale * (x·X + y·Y + z·Z)`. Lengths in the file's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub origin: Point3<f64>,
    pub x: Vector3<f64>,
    pub y: Vector3<f64>,
    pub z: Vector3<f64>,
    pub scale: f64,
}

impl Default for Place {
    fn default() -> Self {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        Self { origin: Point3::origin(), x, y, z, scale: 1.0 }
    }
}

impl Place {
    pub(super) fn apply(&self, p: Point3<f64>) -> Point3<f64> {
        self.origin + self.turn(p.coords)
    }

    pub(super) fn turn(&self, v: Vector3<f64>) -> Vector3<f64> {
        (self.x * v.x + self.y * v.y + self.z * v.z) * self.scale
    }

    /// The frame that leads from `inner`'s child to this frame's parent.
    pub(super) fn compose(&self, inner: &Self) -> Self {
        Self {
            origin: self.apply(inner.origin),
            x: self.turn(inner.x) / self.scale,
            y: self.turn(inner.y) / self.scale,
            z: self.turn(inner.z) / self.scale,
            scale: self.scale * inner.scale,
        }
    }

    /// A frame with this Z and an X as near to the wanted one as may be (ISO 10303-42, `build_axes`).
    fn of_axes(origin: Point3<f64>, z: Option<Vector3<f64>>, x: Option<Vector3<f64>>) -> Self {
        let z = z.and_then(|z| z.try_normalize(1e-12)).unwrap_or_else(Vector3::z);
        let towards = x.unwrap_or_else(Vector3::x);
        let level = |v: Vector3<f64>| (v - z * v.dot(&z)).try_normalize(1e-9);
        let x = level(towards).or_else(|| level(Vector3::x())).or_else(|| level(Vector3::y()));
        let x = x.unwrap_or_else(Vector3::x);
        Self { origin, x, y: z.cross(&x), z, scale: 1.0 }
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

    /// IfcAxis2Placement3D or 2D; the world's frame where there is none.
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
            _ => Self::default(),
        }
    }

    /// IfcCartesianTransformationOperator3D: where a mapped shape goes. Mirrored ones lose their mirror.
    pub(super) fn of_operator(all: &Instances, operator: &Instance) -> Self {
        let origin = point(all, operator.at(2)).unwrap_or_else(Point3::origin);
        let (x, z) = (direction(all, operator.at(0)), direction(all, operator.at(4)));
        let scale = operator.at(3).number().filter(|s| (1e-6..1e6).contains(s)).unwrap_or(1.0);
        Self { scale, ..Self::of_axes(origin, z, x) }
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

fn direction(all: &Instances, value: &Value) -> Option<Vector3<f64>> {
    let direction = all.get(value.reference()?)?;
    if direction.kind != "IFCDIRECTION" {
        return None;
    }
    coordinates(direction.at(0)).map(|p| p.coords)
}
