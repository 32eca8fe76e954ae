//! What stands at the height of a sensor: the faces of a Map, or walls that were seen before (SPEC L2).
//!
//! **Invariant**: every face is longer than a millimetre and finite.

use nalgebra::Vector2;
use orthoframe_geometry::{Blocker, FloorPlan, SeenFace};
use orthoframe_map::World;

/// A straight piece of something solid in the plane of the sensor, in cm in the Map's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    pub start: Vector2<f64>,
    pub end: Vector2<f64>,
    /// What of the Map it is; none for what is only known from scans.
    pub of: Option<SeenFace>,
}

impl Face {
    /// A face that is known from elsewhere than a Map.
    #[must_use]
    pub const fn plain(start: Vector2<f64>, end: Vector2<f64>) -> Self {
        Self { start, end, of: None }
    }

    /// In cm.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.end - self.start).norm()
    }

    /// Whether it may stand otherwise without anything being moved: the leaf of a door.
    #[must_use]
    pub const fn is_leaf(&self) -> bool {
        matches!(self.of, Some(SeenFace { blocker: Blocker::DoorLeaf { .. }, .. }))
    }

    /// Whether it is of the building, not of a thing in it or of a door.
    #[must_use]
    pub const fn is_wall(&self) -> bool {
        matches!(self.of, None | Some(SeenFace { blocker: Blocker::Wall { .. }, .. }))
    }

    /// Unit vector from start to end.
    pub(crate) fn direction(&self) -> Vector2<f64> {
        (self.end - self.start) / self.length()
    }

    /// From a point to the nearest point of the face, in cm.
    pub(crate) fn distance(&self, p: &Vector2<f64>) -> f64 {
        let v = self.end - self.start;
        let share = ((p - self.start).dot(&v) / v.norm_squared()).clamp(0.0, 1.0);
        (self.start + v * share - p).norm()
    }

    pub(crate) fn is_sound(&self) -> bool {
        let finite = self.start.iter().chain(self.end.iter()).all(|x| x.abs() < 1e7);
        finite && self.length() > 0.1
    }
}

/// The faces of a Map at `height` cm above its zero, furniture and door leaves as they stand in this state.
#[must_use]
pub fn faces_at(plan: &FloorPlan, world: &World, height: f64) -> Vec<Face> {
    let sight = plan.sight(world, height);
    let face = |(of, a, b): (SeenFace, orthoframe_units::Point, orthoframe_units::Point)| Face {
        start: a.coords,
        end: b.coords,
        of: Some(of),
    };
    sight.faces().map(face).filter(Face::is_sound).collect()
}
