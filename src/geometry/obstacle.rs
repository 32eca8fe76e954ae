//! What takes floor away: bases of Orthoframes in the robot's height band, door leaves, walls.
//!
//! **Invariant**: an obstacle lies on the Fragment's floor or in the mouth of one of its open doorways, by its box:
//! a thing behind a wall is no obstacle.

use crate::map::{DoorStatus, Permeability, RobotProfile, World};
use crate::units::{AreaId, Point, Vector};

use super::blocker::{Blocker, Obstacle};
use super::leaf::Leaves;
use super::opening::Opening;
use super::scene::{PlacedArea, PlacedReplica, Prism};
use super::site::Site;
use super::storey::{Side, Storey, THIN, sides, strip};
use super::{Bounds, Polygon};

/// The floor that a prism takes from the robot above a floor at `floor`, by side where it is thin; none when it
/// stands aside of the robot's height.
fn footprint(prism: &Prism, floor: f64, robot: &RobotProfile) -> Vec<(Option<usize>, Polygon)> {
    let (step, height) = (robot.step.get().max(0.0), robot.height.get());
    let (bottom, top) = (prism.bottom - floor, prism.top - floor);
    let is_flat = top <= bottom;
    let in_the_way =
        if is_flat { bottom > step && bottom < height } else { top > step && bottom < height };
    if !in_the_way {
        return Vec::new();
    }
    let mut polygon = prism.polygon.clone();
    if (prism.roof_scale - 1.0).abs() > f64::EPSILON && !is_flat {
        // A Uniframe is as wide as its widest section that the robot can meet.
        let scale_at = |z: f64| {
            let share = ((z - bottom) / (top - bottom)).clamp(0.0, 1.0);
            1.0 + (prism.roof_scale - 1.0) * share
        };
        let scale = scale_at(step.max(bottom)).max(scale_at(height.min(top))).max(0.0);
        let centre = polygon.centroid();
        for p in &mut polygon.corners {
            *p = centre + (*p - centre) * scale;
        }
    }
    let extent = polygon.bounds().max - polygon.bounds().min;
    if polygon.signed_area().abs() <= 2.0 * THIN * extent.norm() {
        let strips = polygon.edges().enumerate();
        return strips.map(|(side, (a, b))| (Some(side), strip(a, b))).collect();
    }
    vec![(None, polygon.counter_clockwise())]
}

/// The obstacles that the replicas are, as far as they meet one of the boxes.
pub(super) fn obstacles_near(site: &Site<'_>, storey: &Storey, zones: &[Bounds]) -> Vec<Obstacle> {
    let Some(bounds) = zones.iter().copied().reduce(|a, b| a.union(&b)) else { return Vec::new() };
    let mut found = Vec::new();
    for id in (site.nearby)(&bounds) {
        let Some(replica) = site.scene.replicas.get(&id) else { continue };
        let reach = replica.reach();
        if !zones.iter().any(|zone| zone.meets(&reach)) {
            continue;
        }
        let under = site.scene.areas.get(&replica.area).map_or(0.0, |placed| {
            storey.floor_under(placed, nalgebra::center(&replica.bounds.min, &replica.bounds.max))
        });
        let floor = storey.level + under;
        for prism in &replica.prisms {
            for (side, polygon) in footprint(prism, floor, site.robot) {
                found.push(Obstacle {
                    blocker: Blocker::Replica { replica: id, item: prism.item },
                    polygon,
                    side,
                    bottom: prism.bottom - floor,
                    top: prism.top - floor,
                });
            }
        }
        found.extend(own_leaves(site, replica, floor));
    }
    found.retain(|o| {
        let at = o.polygon.bounds();
        zones.iter().any(|zone| zone.meets(&at))
    });
    found
}

/// The open leaves of a replica's own doors, within the robot's height.
fn own_leaves(site: &Site<'_>, replica: &PlacedReplica, floor: f64) -> Vec<Obstacle> {
    let (step, height) = (site.robot.step.get(), site.robot.height.get());
    open_leaves(site.world, replica)
        .into_iter()
        .map(|(blocker, polygon, (bottom, top))| Obstacle {
            blocker,
            polygon,
            side: None,
            bottom: bottom - floor,
            top: top - floor,
        })
        .filter(|leaf| leaf.top > step && leaf.bottom < height)
        .collect()
}

impl PlacedReplica {
    /// What the open leaves of its own doors take, each from which to which height of the Map, in cm.
    #[must_use]
    pub fn open_leaves(&self, world: &World) -> Vec<(Polygon, (f64, f64))> {
        let leaves = open_leaves(world, self).into_iter();
        leaves.map(|(_, polygon, heights)| (polygon, heights)).collect()
    }
}

/// The open leaves of a replica's own doors, each with its base and its height in the Map's frame.
pub(super) fn open_leaves(
    world: &World,
    replica: &PlacedReplica,
) -> Vec<(Blocker, Polygon, (f64, f64))> {
    if !replica.has_doors {
        return Vec::new();
    }
    let Some(model) = world.replicas.get(&replica.id) else { return Vec::new() };
    let object = &world.objects[&model.object];
    let mut found = Vec::new();
    for mount in &object.doors {
        let Some(door) = world.doors.get(&mount.door) else { continue };
        let state = model.door_states.get(&mount.door).copied().unwrap_or(door.state);
        let Some((prism, (a, b))) = mounted_side(world, object, replica, mount) else { continue };
        if state.status != DoorStatus::Open {
            continue;
        }
        let height =
            if door.height.get() > 0.0 { door.height.get() } else { prism.top - prism.bottom };
        let leaves = Leaves::of_object(door, mount, a, b).map(|leaves| leaves.at(state));
        for (leaf, polygon) in leaves.into_iter().flatten().enumerate() {
            let blocker = Blocker::ReplicaLeaf { replica: replica.id, door: mount.door, leaf };
            found.push((blocker, polygon, (prism.bottom, prism.bottom + height)));
        }
    }
    found
}

fn mounted_side<'a>(
    world: &World,
    object: &crate::map::Object,
    replica: &'a PlacedReplica,
    mount: &crate::map::DoorMount,
) -> Option<(&'a Prism, (Point, Point))> {
    let item = object.items.iter().position(|i| i.id == mount.item)?;
    let (side, _) = world.orthoframe_of(&object.items[item]).side(&mount.side)?;
    let prism = replica.prisms.get(item)?;
    Some((prism, prism.polygon.edges().nth(side)?))
}

/// The leaves of the Area's doors, and of its neighbours' doors close by.
pub(super) fn leaves_near(site: &Site<'_>, area: AreaId) -> Vec<Obstacle> {
    let mut near: Vec<&Opening> = site.doorways_of(area).map(|(_, d, _)| d).collect();
    for (_, doorway, side) in site.doorways_of(area).collect::<Vec<_>>() {
        let zone = Bounds::of([doorway.middle()]).grown(doorway.width() / 2.0 + 3.0 * site.reach());
        for (_, next, _) in site.doorways_of(doorway.areas[1 - side]) {
            if !near.contains(&next) && zone.grown(next.width()).contains(next.middle()) {
                near.push(next);
            }
        }
    }
    let mut found = Vec::new();
    for doorway in near {
        let Some(door) = doorway.door.and_then(|d| site.world.doors.get(&d)) else { continue };
        let leaves = doorway.leaves(door).obstacles(site.state(door.id));
        found.extend(leaves.into_iter().enumerate().map(|(leaf, polygon)| Obstacle {
            blocker: Blocker::DoorLeaf { door: door.id, leaf },
            polygon,
            side: None,
            bottom: 0.0,
            top: door.height.get(),
        }));
    }
    found
}

/// The Area's sides without its doorways, and the doorways' jambs.
pub(super) fn walls(site: &Site<'_>, placed: &PlacedArea) -> Vec<(Point, Point)> {
    let everywhere = Bounds {
        min: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        max: Point::new(f64::INFINITY, f64::INFINITY),
    };
    let mut walls = Vec::new();
    for (side, doorway) in solid_sides(site, placed, &everywhere) {
        if let Some((d, at)) = doorway {
            let face = if at == 0 { 0.0 } else { d.gap };
            for t in [d.span().0, d.span().1] {
                walls.push((d.at(t, face), d.at(t, d.gap / 2.0)));
            }
        }
        walls.extend(beside(&side, doorway.map(|d| d.0)));
    }
    walls.retain(|(a, b)| (b - a).norm() > 1e-6);
    walls
}

/// The Area's sides that come into a zone, without its open doorways.
pub(super) fn walls_in(site: &Site<'_>, placed: &PlacedArea, zone: &Bounds) -> Vec<(Point, Point)> {
    let sides = solid_sides(site, placed, zone).into_iter();
    let open = |d: &&Opening| site.is_open(d);
    sides.flat_map(|(side, door)| beside(&side, door.map(|d| d.0).filter(open))).collect()
}

/// What a side leaves beside a doorway in it.
fn beside(side: &Side, doorway: Option<&Opening>) -> Vec<(Point, Point)> {
    let along = (side.end - side.start).try_normalize(0.0).unwrap_or_else(Vector::zeros);
    let length = (side.end - side.start).norm();
    let pieces = doorway.map_or(vec![(0.0, length)], |d| {
        let (a, b) = d.line();
        let place = |p: Point| (p - side.start).dot(&along).clamp(0.0, length);
        let (low, high) = (place(a).min(place(b)), place(a).max(place(b)));
        vec![(0.0, low), (high, length)]
    });
    let pieces = pieces.into_iter().filter(|(a, b)| b - a > 1e-6);
    pieces.map(|(a, b)| (side.start + along * a, side.start + along * b)).collect()
}

/// The Area's sides near a zone that are walls, each with the doorway that is in it and which of the doorway's sides it is.
fn solid_sides<'s>(
    site: &Site<'s>,
    placed: &PlacedArea,
    zone: &Bounds,
) -> Vec<(Side, Option<(&'s Opening, usize)>)> {
    let all: Vec<usize> = (0..placed.prisms.len()).collect();
    let model = &site.world.areas[&placed.id];
    let near = |s: &Side| Bounds::of([s.start, s.end]).grown(0.1).meets(zone);
    let sides = sides(placed, &all).into_iter().filter(near);
    let with_doorway = sides.map(|side| {
        let id = &site.world.orthoframe_of(&model.items[side.item]).base[side.side].id;
        let is_here = |d: &Opening, at: usize| {
            let own = &d.sides[at].side;
            own.item == model.items[side.item].id && own.side == *id
        };
        let own = site.by_area.of(placed.id).iter();
        let mut own = own.map(|&(doorway, at)| (&*site.doorways[doorway], at));
        let doorway = own.find(|(d, at)| is_here(d, *at));
        (side, doorway)
    });
    let is_wall = |(side, doorway): &(Side, Option<_>)| {
        doorway.is_some()
            || side.permeability == Permeability::Impermeable
            || !is_inner(placed, side)
    };
    with_doorway.filter(is_wall).collect()
}

/// Whether a side lies between two items of the Area.
fn is_inner(placed: &PlacedArea, side: &Side) -> bool {
    let middle = nalgebra::center(&side.start, &side.end);
    placed.prisms.iter().enumerate().any(|(i, p)| {
        i != side.item && p.bounds.grown(0.1).contains(middle) && p.polygon.contains(middle, 0.05)
    })
}
