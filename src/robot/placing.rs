//! Where a thing can be set down on another: the free spot nearest to the robot.

use crate::geometry::{Bounds, PlacedReplica, Scene};
use crate::map::{Permeability, World};
use crate::units::{Deg, Frame, Point, ReplicaId, Vector};

/// Free air kept round a thing that is set down, cm.
const MARGIN: f64 = 1.0;
/// Step of the search over a roof, cm.
const STEP: f64 = 2.5;

/// The frame (in the support's Area) that puts `thing` on the highest solid roof of `support` that has room,
/// as near to `from` as can be. `None` when it fits nowhere.
///
/// # Panics
/// When `thing` is not of this world.
#[must_use]
pub fn spot_on(
    world: &World,
    scene: &Scene,
    thing: ReplicaId,
    support: ReplicaId,
    from: Point,
) -> Option<Frame> {
    let support = scene.replicas.get(&support)?;
    // Turned to the Map's axes at the origin: the size of the thing's own box.
    let shape = PlacedReplica::new(world, thing, Frame::IDENTITY);
    let height = shape.top - shape.bottom;
    let mut roofs: Vec<_> = support
        .prisms
        .iter()
        .filter(|p| p.roof_permeability == Permeability::Impermeable)
        .collect();
    roofs.sort_by(|a, b| b.top.total_cmp(&a.top));
    let area = scene.areas.get(&support.area)?;
    let fits = |at: Vector, top: f64| {
        let bounds =
            Bounds { min: shape.bounds.min + at, max: shape.bounds.max + at }.grown(MARGIN);
        scene
            .replicas
            .values()
            .filter(|r| r.id != thing && r.bounds.meets(&bounds))
            .flat_map(|r| &r.prisms)
            .all(|p| p.top <= top + 1e-6 || p.bottom >= top + height || !p.bounds.meets(&bounds))
    };
    roofs.into_iter().find_map(|roof| {
        let half = (shape.bounds.max - shape.bounds.min) / 2.0;
        let middle = shape.bounds.min + half;
        let corners = |c: Point| {
            [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
                .map(|(sx, sy)| Point::new(c.x + sx * half.x, c.y + sy * half.y))
        };
        grid(roof.bounds)
            .filter(|&c| corners(c).iter().all(|&p| roof.polygon.contains(p, 1e-6)))
            .filter(|&c| fits(c - middle, roof.top))
            .min_by(|a, b| (a - from).norm().total_cmp(&(b - from).norm()))
            .map(|c| {
                let origin = area.frame.invert(Point::origin() + (c - middle));
                Frame::new(
                    origin.x,
                    origin.y,
                    roof.top - shape.bottom - area.frame.z.get(),
                    Deg::ZERO - area.frame.angle,
                )
            })
    })
}

fn grid(bounds: Bounds) -> impl Iterator<Item = Point> {
    let size = bounds.max - bounds.min;
    let count = |length: f64| (length / STEP).floor() as usize + 1;
    let (nx, ny) = (count(size.x), count(size.y));
    (0..nx).flat_map(move |i| {
        (0..ny).map(move |j| {
            bounds.min + Vector::new((i as f64 + 0.5) * STEP, (j as f64 + 0.5) * STEP)
        })
    })
}
