//! Local frames: where an item stands in its Object, an Object in its Area, an Area in its Map.

use serde::{Deserialize, Serialize};

use super::{Cm, Deg};

/// A point of a floor plan, in cm.
pub type Point = nalgebra::Point2<f64>;
/// A displacement in a floor plan, in cm.
pub type Vector = nalgebra::Vector2<f64>;

/// A place to stand and the way one faces there. `at` in cm, `heading` counter-clockwise from +x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    pub at: Point,
    pub heading: Deg,
}

impl From<Pose> for nalgebra::Isometry2<f64> {
    fn from(pose: Pose) -> Self {
        Self::new(pose.at.coords, pose.heading.radians())
    }
}

impl From<nalgebra::Isometry2<f64>> for Pose {
    fn from(motion: nalgebra::Isometry2<f64>) -> Self {
        let heading = Deg::from_radians(motion.rotation.angle());
        Self { at: Point::from(motion.translation.vector), heading }
    }
}

/// Position of a child frame in its parent: the paper's PosX, PosY, PosZ, PosA.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Frame {
    pub x: Cm,
    pub y: Cm,
    pub z: Cm,
    pub angle: Deg,
}

impl Frame {
    pub const IDENTITY: Self = Self { x: Cm::ZERO, y: Cm::ZERO, z: Cm::ZERO, angle: Deg::ZERO };

    /// A frame from computed coordinates in cm.
    #[must_use]
    pub fn new(x: f64, y: f64, z: f64, angle: Deg) -> Self {
        Self { x: Cm::of(x), y: Cm::of(y), z: Cm::of(z), angle }
    }

    #[must_use]
    pub fn origin(&self) -> Point {
        Point::new(self.x.get(), self.y.get())
    }

    /// A point of this frame, seen in the parent. Exact when `angle` is a multiple of 90°.
    #[must_use]
    pub fn apply(&self, p: Point) -> Point {
        self.origin() + self.turn(p.coords)
    }

    /// A displacement of this frame, seen in the parent.
    #[must_use]
    pub fn turn(&self, v: Vector) -> Vector {
        let (sin, cos) = self.angle.sin_cos();
        Vector::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
    }

    /// A point of the parent, seen in this frame.
    #[must_use]
    pub fn invert(&self, p: Point) -> Point {
        let (sin, cos) = self.angle.sin_cos();
        let v = p - self.origin();
        Point::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin)
    }

    /// The frame that leads from `inner`'s child to this frame's parent.
    #[must_use]
    pub fn compose(&self, inner: &Self) -> Self {
        let at = self.apply(inner.origin());
        Self::new(at.x, at.y, self.z.get() + inner.z.get(), self.angle + inner.angle)
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "exactness is what these tests are about")]
mod tests {
    use super::*;

    #[test]
    fn eight_quarter_turns_return_exactly() {
        let step = Frame::new(12.3, 45.6, 7.0, Deg::of(90.0));
        let p = Point::new(0.1, 0.7);
        let mut q = p;
        for _ in 0..4 {
            q = step.turn(q.coords).into();
        }
        assert_eq!(p, q);
    }

    #[test]
    fn invert_undoes_apply() {
        let frame = Frame::new(-310.0, 95.5, 0.0, Deg::of(17.3));
        let p = Point::new(123.4, -56.7);
        assert!((frame.invert(frame.apply(p)) - p).norm() < 1e-9);
    }

    #[test]
    fn compose_is_apply_after_apply() {
        let outer = Frame::new(5.0, 6.0, 7.0, Deg::of(33.0));
        let inner = Frame::new(1.0, -2.0, 3.0, Deg::of(270.0));
        let p = Point::new(4.0, 4.0);
        assert!((outer.compose(&inner).apply(p) - outer.apply(inner.apply(p))).norm() < 1e-9);
        assert_eq!(outer.compose(&inner).z.get(), 10.0);
    }
}
