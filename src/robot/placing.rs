//! Where a thing can be set down on another, or in it: the free spot nearest to the robot.

use crate::geometry::{Bounds, PlacedReplica, Polygon, Prism, Scene};
use crate::map::{DoorStatus, Permeability, Replica, World, plane};
use crate::units::{AreaId, Deg, Frame, InOrder as _, MapId, Point, Pose, ReplicaId, Vector};

/// Free air kept round a thing that is set down, cm.
const MARGIN: f64 = 1.0;
/// What lies on a surface and is no thicker takes no room there, cm: a placemat, a cloth. The simulated world holds by it
/// as well, whatever rules a map is read by.
const FLAT: f64 = 2.0;
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
    let mut roofs: Vec<Surface<'_>> = support
        .prisms
        .iter()
        .filter(|p| p.roof_permeability == Permeability::Impermeable)
        .map(|p| Surface { polygon: &p.polygon, height: p.top, within: None })
        .collect();
    roofs.order_by(|a, b| b.height.total_cmp(&a.height));
    spot(world, scene, thing, support, &roofs, from)
}

/// Whether a thing can have others in it, and whether a hand gets in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hollow {
    /// Solid, or a flat top.
    No,
    /// Behind doors that are shut.
    Shut,
    Open,
}

/// Whether and how a thing is hollow.
///
/// # Panics
/// When the support is not of this world.
#[must_use]
pub fn hollow(world: &World, scene: &Scene, support: ReplicaId) -> Hollow {
    let Some(placed) = scene.replicas.get(&support) else { return Hollow::No };
    // Of a sofa the hull is open, and nobody puts things into it.
    let is = |wanted: &&str| world.has_trait(support, wanted);
    if ["seat", "bed"].iter().any(is) && !is(&"container") {
        return Hollow::No;
    }
    let hollow = || placed.prisms.iter().filter(|p| is_hollow(p));
    if hollow().any(|p| is_open(world, placed, p)) {
        Hollow::Open
    } else if hollow().next().is_some() {
        Hollow::Shut
    } else {
        Hollow::No
    }
}

/// As [`spot_on`], inside of what is open of `support`: on its bottom or on a shelf in it.
///
/// # Panics
/// When `thing` is not of this world.
#[must_use]
pub fn spot_in(
    world: &World,
    scene: &Scene,
    thing: ReplicaId,
    support: ReplicaId,
    from: Point,
) -> Option<Frame> {
    let placed = scene.replicas.get(&support)?;
    let mut surfaces = Vec::new();
    for around in placed.prisms.iter().filter(|p| is_hollow(p) && is_open(world, placed, p)) {
        surfaces.push(Surface {
            polygon: &around.polygon,
            height: around.bottom,
            within: Some(around),
        });
        let shelves = placed.prisms.iter().filter(|p| {
            p.roof_permeability == Permeability::Impermeable
                && p.top > around.bottom + 1e-6
                && p.top < around.top - 1e-6
                && p.bounds.meets(&around.bounds)
        });
        surfaces.extend(shelves.map(|shelf| Surface {
            polygon: &shelf.polygon,
            height: shelf.top,
            within: Some(around),
        }));
    }
    surfaces.order_by(|a, b| b.height.total_cmp(&a.height));
    spot(world, scene, thing, placed, &surfaces, from)
}

/// The frame (in the Area that holds `from`) that sets a thing on the floor beside a robot: ahead of it, else as little
/// aside as can be. `None` when there is room nowhere about.
///
/// # Panics
/// When the thing is not of this world.
#[must_use]
pub(super) fn spot_on_floor(
    world: &World,
    scene: &Scene,
    thing: ReplicaId,
    area: AreaId,
    from: Pose,
) -> Option<Frame> {
    /// Degrees between the directions that are tried.
    const TURN: f64 = 15.0;
    let shape = PlacedReplica::new(world, thing, Frame::IDENTITY);
    let room = scene.areas.get(&area)?;
    let half = (shape.bounds.max - shape.bounds.min) / 2.0;
    let middle = shape.bounds.min + half;
    let away = world.robot.radius.get() + half.norm() + MARGIN;
    let height = shape.top - shape.bottom;
    let floor = room.frame.z.get();
    let is_free = |at: Point| {
        let bounds = Bounds { min: at - half, max: at + half }.grown(MARGIN);
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        corners.iter().all(|(x, y)| {
            let corner = at + Vector::new(x * half.x, y * half.y);
            room.prisms.iter().any(|p| p.polygon.contains(corner, 1e-6))
        }) && scene
            .replicas
            .values()
            .filter(|r| r.id != thing && r.bounds.meets(&bounds))
            .flat_map(|r| &r.prisms)
            .all(|p| p.top <= floor || p.bottom >= floor + height || !p.bounds.meets(&bounds))
    };
    let turns = (0..=(180.0 / TURN) as i32).flat_map(|n| [f64::from(n), -f64::from(n)]);
    let spots = turns.map(|turn| {
        let heading = (from.heading + Deg::of(turn * TURN)).radians();
        from.at + Vector::new(heading.cos(), heading.sin()) * away
    });
    spots.into_iter().find(|&at| is_free(at)).map(|at| {
        let origin = room.frame.invert(Point::origin() + (at - middle));
        Frame::new(origin.x, origin.y, -shape.bottom, Deg::ZERO - room.frame.angle)
    })
}

/// Whether a thing stays where it is put: on a floor, a roof, or the bottom of something hollow, and not within another.
///
/// A thing set down where [`spot_on`], [`spot_in`] or [`spot_on_floor`] say does, in the world that they were asked about.
pub(super) fn rests(scene: &Scene, thing: ReplicaId) -> bool {
    let Some(placed) = scene.replicas.get(&thing) else { return false };
    let middle = nalgebra::center(&placed.bounds.min, &placed.bounds.max);
    let is_under = |height: f64| (height - placed.bottom).abs() <= FLAT;
    let bears = |p: &Prism| {
        (is_under(p.top) || is_hollow(p) && is_under(p.bottom)) && p.polygon.contains(middle, 1e-6)
    };
    let on_floor = scene.areas.get(&placed.area).is_some_and(|room| {
        is_under(room.frame.z.get()) && room.prisms.iter().any(|p| p.polygon.contains(middle, 1e-6))
    });
    let core = placed.bounds.grown(-MARGIN);
    let others = || scene.replicas.values().filter(|r| r.id != thing);
    let stands_within = || {
        others().filter(|r| r.bounds.meets(&core)).flat_map(|r| &r.prisms).any(|p| {
            !is_hollow(p)
                && p.top > placed.bottom + FLAT
                && p.bottom < placed.top - FLAT
                && p.bounds.meets(&core)
        })
    };
    (on_floor || others().flat_map(|r| &r.prisms).any(bears)) && !stands_within()
}

/// Whether a thing can be pushed to another frame of its Area in a straight line: it stays in its room, and touches no
/// other thing, nor the disc of a robot, any more than it does now.
pub(super) fn slides(
    world: &World,
    map: MapId,
    thing: &Replica,
    to: &Frame,
    (robot, radius): (Point, f64),
) -> bool {
    /// Between two places that are looked at on the way, cm.
    const STEP: f64 = 4.0;
    /// What is no touch, in cm².
    const NONE: f64 = 1.0;
    let from = thing.frame;
    let way = Vector::new(to.x.get() - from.x.get(), to.y.get() - from.y.get());
    let count = (way.norm() / STEP).ceil().max(1.0);
    let mut moved = world.clone();
    let mut touches = |share: f64| -> Option<f64> {
        let (x, y) = (from.x.get() + way.x * share, from.y.get() + way.y * share);
        let frame = Frame::new(x, y, from.z.get(), from.angle);
        moved.replicas.get_mut(&thing.id)?.frame = frame;
        let scene = Scene::of(&moved, map);
        let (placed, room) = (scene.replicas.get(&thing.id)?, scene.areas.get(&thing.area)?);
        let inside = |p: &Prism| {
            p.polygon
                .corners
                .iter()
                .all(|corner| room.prisms.iter().any(|r| r.polygon.contains(*corner, 1.0)))
        };
        if !placed.prisms.iter().all(inside) {
            return None;
        }
        let near =
            |p: &Prism| p.polygon.contains(robot, 0.0) || p.polygon.border_distance(robot) < radius;
        if share > 0.0 && placed.prisms.iter().any(near) {
            return None;
        }
        let others = scene.replicas.values().filter(|r| r.id != thing.id);
        let pairs = others.flat_map(|r| &r.prisms).flat_map(|other| {
            placed.prisms.iter().filter_map(move |own| {
                let apart = own.top <= other.bottom + FLAT || other.top <= own.bottom + FLAT;
                (!apart && own.bounds.meets(&other.bounds))
                    .then(|| plane::intersection(&own.polygon.corners, &other.polygon.corners).area)
            })
        });
        Some(pairs.sum())
    };
    let Some(now) = touches(0.0) else { return false };
    (1..=count as u32).all(|n| touches(f64::from(n) / count).is_some_and(|then| then <= now + NONE))
}

/// What a thing may be set down on.
struct Surface<'p> {
    polygon: &'p Polygon,
    height: f64,
    /// The hollow that it is in: the thing must fit in there.
    within: Option<&'p Prism>,
}

/// The spot nearest to `from` on the first surface that has room.
fn spot(
    world: &World,
    scene: &Scene,
    thing: ReplicaId,
    support: &PlacedReplica,
    surfaces: &[Surface<'_>],
    from: Point,
) -> Option<Frame> {
    // Turned to the Map's axes at the origin: the size of the thing's own box.
    let shape = PlacedReplica::new(world, thing, Frame::IDENTITY);
    let height = shape.top - shape.bottom;
    let area = scene.areas.get(&support.area)?;
    let half = (shape.bounds.max - shape.bounds.min) / 2.0;
    let middle = shape.bounds.min + half;
    let corners = |c: Point| {
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
            .map(|(sx, sy)| Point::new(c.x + sx * half.x, c.y + sy * half.y))
    };
    let fits = |at: Vector, surface: &Surface<'_>, foot: f64| {
        let bounds =
            Bounds { min: shape.bounds.min + at, max: shape.bounds.max + at }.grown(MARGIN);
        let (bottom, top) = (foot, foot + height);
        // A hollow thing is not in its own way, nor is the counter into which it is built.
        let is_solid = |r: &PlacedReplica, p: &Prism| match surface.within {
            Some(within) => !is_hollow(p) || r.id != support.id && !surrounds(p, within),
            None => true,
        };
        scene
            .replicas
            .values()
            .filter(|r| r.id != thing && r.bounds.meets(&bounds))
            .flat_map(|r| r.prisms.iter().filter(move |p| is_solid(r, p)))
            .all(|p| p.top <= bottom + 1e-6 || p.bottom >= top || !p.bounds.meets(&bounds))
    };
    // A placemat takes no room: what stands wholly on it stands on the table.
    let on_mat = |c: Point, surface: &Surface<'_>| {
        let lies_flat = |p: &&Prism| {
            p.roof_permeability == Permeability::Impermeable
                && (p.bottom - surface.height).abs() <= FLAT
                && p.top > surface.height
                && p.top <= surface.height + FLAT
                && corners(c).iter().all(|&corner| p.polygon.contains(corner, 1e-6))
        };
        let others = scene.replicas.values().filter(|r| r.id != thing && r.id != support.id);
        let prisms = others.flat_map(|r| &r.prisms).filter(lies_flat);
        prisms.map(|p| p.top).max_by(f64::total_cmp)
    };
    surfaces.iter().find_map(|surface| {
        let holds = |c: Point| {
            let roofed = |p: &Prism| {
                p.roof_permeability != Permeability::Permeable && surface.height + height > p.top
            };
            corners(c).iter().all(|&p| {
                surface.polygon.contains(p, 1e-6)
                    && surface.within.is_none_or(|w| w.polygon.contains(p, 1e-6))
            }) && !surface.within.is_some_and(roofed)
        };
        let nearest = |spots: Vec<(Point, f64)>| {
            spots
                .into_iter()
                .min_by(|(a, _), (b, _)| (a - from).norm().total_cmp(&(b - from).norm()))
        };
        let spots = || grid(surface.polygon.bounds()).filter(|&c| holds(c));
        // The bare surface before a mat on it.
        let bare = spots().filter(|&c| fits(c - middle, surface, surface.height));
        let spot = nearest(bare.map(|c| (c, surface.height)).collect()).or_else(|| {
            let mats = spots().filter_map(|c| Some((c, on_mat(c, surface)?)));
            nearest(mats.filter(|(c, top)| fits(c - middle, surface, *top)).collect())
        });
        spot.map(|(c, foot)| {
            let origin = area.frame.invert(Point::origin() + (c - middle));
            Frame::new(
                origin.x,
                origin.y,
                foot - shape.bottom - area.frame.z.get(),
                Deg::ZERO - area.frame.angle,
            )
        })
    })
}

/// Some face of it is no wall.
fn is_hollow(prism: &Prism) -> bool {
    prism.roof_permeability != Permeability::Impermeable
        || prism.sides.iter().any(|s| s.permeability != Permeability::Impermeable)
}

/// Whether one hollow is built into another, which may be a little less deep.
fn surrounds(outer: &Prism, inner: &Prism) -> bool {
    let middle = nalgebra::center(&inner.bounds.min, &inner.bounds.max);
    let extent = |prism: &Prism| prism.bounds.max - prism.bounds.min;
    let (around, own) = (extent(outer), extent(inner));
    outer.polygon.contains(middle, 1e-6)
        && outer.bottom <= inner.bottom + FLAT
        && outer.top >= inner.top - FLAT
        && around.x * around.y >= own.x * own.y
}

/// Whether another part of the thing covers the middle of a hollow.
fn is_roofed(placed: &PlacedReplica, hollow: &Prism) -> bool {
    let middle = nalgebra::center(&hollow.bounds.min, &hollow.bounds.max);
    placed.prisms.iter().any(|roof| {
        !is_hollow(roof)
            && roof.bottom > hollow.bottom + FLAT
            && roof.polygon.contains(middle, 1e-6)
    })
}

/// A hand gets in: by a face that is open, or by a door that is; where no door is drawn, by the lid or drawer that the
/// thing's state tells of. What is told to be shut and has a roof is shut, though the survey drew none of its sides.
fn is_open(world: &World, placed: &PlacedReplica, prism: &Prism) -> bool {
    let Some(replica) = world.replicas.get(&placed.id) else { return false };
    let told_shut = crate::map::is_open(&replica.properties) == Some(false);
    let has_open_face = prism.roof_permeability == Permeability::Permeable
        || prism.sides.iter().any(|s| s.permeability == Permeability::Permeable);
    if has_open_face && !(told_shut && is_roofed(placed, prism)) {
        return true;
    }
    let object = &world.objects[&replica.object];
    if object.doors.is_empty() {
        return crate::map::is_open(&replica.properties) == Some(true);
    }
    let item = object.items.get(prism.item).map(|item| item.id.as_str());
    object.doors.iter().filter(|mount| item == Some(&*mount.item)).any(|mount| {
        let own = replica.door_states.get(&mount.door).copied();
        let state = own.or_else(|| world.doors.get(&mount.door).map(|door| door.state));
        state.is_some_and(|state| state.status == DoorStatus::Open)
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
