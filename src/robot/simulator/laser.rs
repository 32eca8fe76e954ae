//! A laser in the simulated world: what each beam truly meets at its height, walls, things, the leaves of doors as they
//! stand, and people.
//!
//! **Invariant**: made from the prisms of the truth, as the collision test is, and not from the free floor's faces, by which the
//! robot's own Map is looked at.

use parry2d_f64::math::Vector as ShapeVector;
use parry2d_f64::query::Ray;
use parry2d_f64::shape::{CompositeShapeRef, Polyline};

use crate::geometry::{Owner, Scene, is_solid};
use crate::map::Permeability;
use crate::units::{Point, Pose, Vector};

use super::Simulator;

/// All that a beam can meet, without people.
pub(super) struct Faces {
    shape: Option<Polyline>,
}

impl Faces {
    /// Of the Map on which the robot is, at `height` above its zero, in cm.
    pub(super) fn of(body: &Simulator, height: f64) -> Self {
        let scene = Scene::of(&body.truth, body.map);
        let mut faces: Vec<(Point, Point)> = Vec::new();
        for prism in scene.areas.values().flat_map(|area| &area.prisms) {
            if matches!(prism.owner, Owner::Area(_)) {
                let sides = prism.polygon.edges().zip(prism.sides.iter());
                let walls = sides.filter(|(_, s)| s.permeability == Permeability::Impermeable);
                faces.extend(walls.map(|(edge, _)| edge));
            }
        }
        for thing in scene.replicas.values() {
            for prism in thing.prisms.iter().filter(|p| p.bottom <= height && height < p.top) {
                let outline = prism.section(height);
                let stops = |(side, _): &(usize, _)| is_solid(&body.truth, thing.id, prism, *side);
                faces.extend(outline.edges().enumerate().filter(stops).map(|(_, edge)| edge));
            }
        }
        for doorway in body.doorways() {
            // Between the sides of two rooms the wall is as thick as the doorway is deep.
            if doorway.gap > 0.0 {
                let (right, left) = doorway.span();
                let jamb = |t| (doorway.at(t, 0.0), doorway.at(t, doorway.gap));
                faces.extend([jamb(right), jamb(left)]);
            }
            let Some(door) = doorway.door.and_then(|id| body.truth.doors.get(&id)) else {
                continue;
            };
            let floor = doorway.sides.first().map_or(0.0, |side| side.floor);
            let is_under = door.height.get() > 0.0 && door.height.get() <= height - floor;
            if !is_under {
                let leaves = doorway.leaves(door).obstacles(door.state);
                faces.extend(leaves.iter().flat_map(|leaf| leaf.edges().collect::<Vec<_>>()));
            }
        }
        let ends = faces.iter().flat_map(|(a, b)| [a, b]);
        let vertices = ends.map(|p| ShapeVector::new(p.x, p.y)).collect();
        let indices = (0..faces.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        Self { shape: (!faces.is_empty()).then(|| Polyline::new(vertices, Some(indices))) }
    }

    /// How far a beam goes from a pose before it meets something or somebody, in cm; none where that is farther than
    /// `reach`. People are discs: middle and radius.
    pub(super) fn cast(
        &self,
        from: Pose,
        bearing: f64,
        reach: f64,
        people: &[(Point, f64)],
    ) -> Option<f64> {
        let (sin, cos) = (from.heading.radians() + bearing).sin_cos();
        let ray = Ray::new(ShapeVector::new(from.at.x, from.at.y), ShapeVector::new(cos, sin));
        let hit = |shape| CompositeShapeRef(shape).cast_local_ray(&ray, reach, true);
        let wall = self.shape.as_ref().and_then(hit).map(|(_, distance)| distance);
        let met = people.iter().filter_map(|(at, radius)| {
            let to = at - from.at;
            let along = to.dot(&Vector::new(cos, sin));
            let half = (radius * radius - (to.norm_squared() - along * along)).sqrt();
            // Not a number where the beam passes by.
            (along - half > 0.0).then_some(along - half)
        });
        wall.into_iter().chain(met).filter(|distance| *distance < reach).min_by(f64::total_cmp)
    }
}
