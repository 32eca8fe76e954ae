//! Everything flat that can be seen of a Map, or hides what is behind it: walls with their doorways, floors, door
//! leaves, the faces of things. What is seen of it from a pose is told by [`super::seen`].
//!
//! **Invariant**: a face is flat, its corners counter-clockwise as seen from where its normal points; that of a closed
//! body points out of it, that of a wall into its room.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use crate::map::World;
use crate::units::{Point, ReplicaId};

use super::blocker::Blocker;
use super::eye::Eye;
use super::opening::Opening;
use super::plan::FloorPlan;
use super::scene::Prism;
use super::view::is_solid;
use super::{Bounds, Polygon};

/// Which face of a prism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FaceKind {
    /// The side on a base vector, by its index.
    Side(usize),
    Base,
    Roof,
}

/// A face of something that can be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Face {
    pub blocker: Blocker,
    pub kind: FaceKind,
}

/// Everything flat that can be seen of a Map, ready to be looked at from anywhere.
#[derive(Debug, Clone)]
pub struct Faces {
    pub(super) sheets: Vec<Sheet>,
    /// Solid bodies, for an eye that is within one.
    pub(super) bodies: Vec<Prism>,
}

/// A face in space.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    pub(super) face: Face,
    /// Counter-clockwise as seen from where its normal points.
    pub(super) corners: Vec<Point3<f64>>,
    pub(super) plane: Plane,
    pub(super) backs: Backs,
    pub(super) centre: Point3<f64>,
    pub(super) radius: f64,
}

/// What is to be seen of a face from behind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Backs {
    /// The same as from before.
    Seen,
    /// Another face, such as that of the next room: it hides, but is not seen.
    Hiding,
    /// The inside of the body of this number, which its other faces hide.
    Inside(usize),
}

/// A plane with coordinates of its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub(super) origin: Point3<f64>,
    u: Vector3<f64>,
    v: Vector3<f64>,
    pub(super) normal: Vector3<f64>,
}

impl Plane {
    fn of(corners: &[Point3<f64>]) -> Option<Self> {
        // Newell's normal, which any flat polygon has; about a corner, so that far from the origin nothing is lost.
        let origin = *corners.first()?;
        let normal = (1..corners.len().max(2) - 1).fold(Vector3::zeros(), |n, i| {
            n + (corners[i] - origin).cross(&(corners[i + 1] - origin))
        });
        let normal = normal.try_normalize(1e-6)?;
        let u = corners.windows(2).find_map(|e| (e[1] - e[0]).try_normalize(1e-6))?;
        Some(Self { origin, u, v: normal.cross(&u), normal })
    }

    pub(super) fn height(&self, p: Point3<f64>) -> f64 {
        self.normal.dot(&(p - self.origin))
    }

    pub(super) fn flat(&self, p: Point3<f64>) -> Point {
        Point::new(self.u.dot(&(p - self.origin)), self.v.dot(&(p - self.origin)))
    }

    pub(super) fn lift(&self, p: Point) -> Point3<f64> {
        self.origin + self.u * p.x + self.v * p.y
    }
}

impl FloorPlan {
    /// All about an eye that may be seen or may hide: walls, floors, door leaves, things.
    #[must_use]
    pub fn faces(&self, world: &World, eye: &Eye) -> Faces {
        let mut faces = Faces { sheets: Vec::new(), bodies: Vec::new() };
        let near = Bounds::of([eye.pose.at]).grown(eye.range);
        for fragment in self.fragments() {
            let Some(placed) = self.scene().areas.get(&fragment.area) else { continue };
            if !placed.prisms.iter().any(|prism| prism.bounds.meets(&near)) {
                continue;
            }
            for prism in &placed.prisms {
                let blocker = Blocker::Floor { area: fragment.area, item: prism.item };
                let face = Face { blocker, kind: FaceKind::Base };
                faces.level(face, &prism.polygon, prism.bottom, true, Backs::Hiding);
            }
            for &(a, b) in &fragment.walls {
                let seen = self.wall_face(fragment, a, b);
                let Blocker::Wall { item, side, .. } = seen.blocker else { continue };
                let Some(room) = placed.prisms.get(item) else { continue };
                let kind = FaceKind::Side(side);
                let face = Face { blocker: seen.blocker, kind };
                // A jamb is no side of the room.
                let backs = if seen.side.is_some() { Backs::Hiding } else { Backs::Seen };
                let along = room.polygon.edges().nth(side).map_or(b - a, |(p, q)| q - p);
                let (a, b) = if along.dot(&(b - a)) < 0.0 { (b, a) } else { (a, b) };
                // The room lies to the left of its base vectors.
                faces.upright(face, (b, a), (room.bottom, room.top), backs);
            }
        }
        let within = |d: &&Arc<Opening>| near.grown(d.width()).contains(d.middle());
        for doorway in self.doorways().iter().filter(within) {
            let Some(door) = doorway.door.and_then(|d| world.doors.get(&d)) else { continue };
            let bottom = self.level_of(doorway);
            let lintel = bottom + door.height.get();
            for side in 0..2 {
                let room = self.scene().areas.get(&doorway.areas[side]);
                let Some(room) = room.and_then(|placed| placed.prisms.first()) else { continue };
                let Some((seen, (right, left))) = self.lintel(world, doorway, side) else {
                    continue;
                };
                if door.height.get() > 0.0 && lintel < room.top {
                    let kind = FaceKind::Side(seen.side.unwrap_or_default());
                    let face = Face { blocker: seen.blocker, kind };
                    // Seen from its own room, which lies against `out` of the first Area.
                    let ends = if side == 0 { (left, right) } else { (right, left) };
                    faces.upright(face, ends, (lintel, room.top), Backs::Hiding);
                }
            }
            let top = if door.height.get() > 0.0 { lintel } else { f64::INFINITY };
            let room = self.scene().areas.get(&doorway.areas[0]).and_then(|a| a.prisms.first());
            let top = top.min(room.map_or(bottom, |room| room.top));
            let leaves = doorway.leaves(door).obstacles(self.door_state(world, door.id));
            for (leaf, polygon) in leaves.iter().enumerate() {
                faces.block(Blocker::DoorLeaf { door: door.id, leaf }, polygon, (bottom, top));
            }
        }
        for replica in self.scene().replicas.values().filter(|r| r.reach().meets(&near)) {
            for prism in &replica.prisms {
                faces.prism(world, replica.id, prism);
            }
            for (blocker, polygon, heights) in super::obstacle::open_leaves(world, replica) {
                faces.block(blocker, &polygon, heights);
            }
        }
        faces
    }
}

impl Faces {
    fn put(&mut self, face: Face, corners: Vec<Point3<f64>>, backs: Backs) {
        let Some(plane) = Plane::of(&corners) else { return };
        let sum: Vector3<f64> = corners.iter().map(|p| p.coords).sum();
        let centre = Point3::from(sum / corners.len() as f64);
        let radius = corners.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max);
        self.sheets.push(Sheet { face, corners, plane, backs, centre, radius });
    }

    /// A level face that looks up or down.
    fn level(&mut self, face: Face, polygon: &Polygon, z: f64, up: bool, backs: Backs) {
        let mut corners: Vec<_> =
            polygon.corners.iter().map(|p| Point3::new(p.x, p.y, z)).collect();
        if (polygon.signed_area() > 0.0) != up {
            corners.reverse();
        }
        self.put(face, corners, backs);
    }

    /// An upright face that looks to the right of the way from `a` to `b`.
    fn upright(
        &mut self,
        face: Face,
        (a, b): (Point, Point),
        (low, high): (f64, f64),
        backs: Backs,
    ) {
        let at = |p: Point, z: f64| Point3::new(p.x, p.y, z);
        self.put(face, vec![at(a, low), at(b, low), at(b, high), at(a, high)], backs);
    }

    /// A closed block that stands upright, such as a door leaf.
    fn block(&mut self, blocker: Blocker, base: &Polygon, (bottom, top): (f64, f64)) {
        let base = base.clone().counter_clockwise();
        for (side, ends) in base.edges().enumerate() {
            let face = Face { blocker, kind: FaceKind::Side(side) };
            self.upright(face, ends, (bottom, top), Backs::Seen);
        }
        let roof = Face { blocker, kind: FaceKind::Roof };
        self.level(roof, &base, top, true, Backs::Seen);
    }

    fn prism(&mut self, world: &World, replica: ReplicaId, prism: &Prism) {
        use crate::map::Permeability::Permeable;
        let blocker = Blocker::Replica { replica, item: prism.item };
        let face = |kind| Face { blocker, kind };
        let roof = prism.roof();
        if prism.top <= prism.bottom {
            if prism.roof_permeability != Permeable {
                self.level(face(FaceKind::Roof), &prism.polygon, prism.top, true, Backs::Hiding);
                self.level(
                    face(FaceKind::Base),
                    &prism.polygon,
                    prism.bottom,
                    false,
                    Backs::Hiding,
                );
            }
            return;
        }
        let n = prism.sides.len();
        let solid: Vec<bool> = (0..n).map(|side| is_solid(world, replica, prism, side)).collect();
        let closed = solid.iter().all(|s| *s)
            && prism.base_permeability != Permeable
            && prism.roof_permeability != Permeable;
        let backs = if closed { Backs::Inside(self.bodies.len()) } else { Backs::Seen };
        if closed {
            self.bodies.push(prism.clone());
        }
        let at = |p: Point, z: f64| Point3::new(p.x, p.y, z);
        for i in (0..n).filter(|&i| solid[i]) {
            let j = (i + 1) % n;
            let (a, b) = (prism.polygon.corners[i], prism.polygon.corners[j]);
            let (d, c) = (roof.corners[i], roof.corners[j]);
            let corners =
                vec![at(a, prism.bottom), at(b, prism.bottom), at(c, prism.top), at(d, prism.top)];
            self.put(face(FaceKind::Side(i)), corners, backs);
        }
        if prism.base_permeability != Permeable {
            self.level(face(FaceKind::Base), &prism.polygon, prism.bottom, false, backs);
        }
        if prism.roof_permeability != Permeable {
            self.level(face(FaceKind::Roof), &roof, prism.top, true, backs);
        }
    }
}
