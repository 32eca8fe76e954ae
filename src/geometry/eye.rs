//! Who looks: the place of an eye, and its field of view.

use nalgebra::{Point3, Vector3};

use crate::units::Pose;

/// From where, how wide and how far one looks. The field of view is horizontal; upwards and downwards all is in view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    pub pose: Pose,
    /// Above the Map's zero, cm.
    pub height: f64,
    /// From side to side, degrees; 360 and more is all round.
    pub field: f64,
    /// cm
    pub range: f64,
}

impl Eye {
    /// Where it is in the Map's frame.
    #[must_use]
    pub fn at(&self) -> Point3<f64> {
        Point3::new(self.pose.at.x, self.pose.at.y, self.height)
    }

    /// Directions that bound the field of view to the right and to the left, of less than a full turn.
    pub(super) fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        let half = self.field.clamp(0.0, 360.0).to_radians() / 2.0;
        let at = |turn: f64| {
            let angle = self.pose.heading.radians() + turn;
            Vector3::new(angle.cos(), angle.sin(), 0.0)
        };
        (self.field < 360.0).then(|| [at(-half), at(half)])
    }
}
