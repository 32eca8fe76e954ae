//! What can be seen at one height from a pose (M12): a scan such as a laser would bring, and the stretches of floor plan
//! in view. What is seen in space is told by [`super::seen`].
//!
//! At the height of the eye every side of every prism is a segment of the floor plan; permeable sides and open
//! doorways are seen through. Beams are cast with parry. The visible stretches are found by casting between the
//! directions of all segments' ends, and halving where something crosses in between.
//!
//! **Invariant**: nothing solid stands between the eye and a stretch that is called visible.

use std::f64::consts::PI;

use parry2d_f64::math::Vector as Vec2;
use parry2d_f64::query::Ray;
use parry2d_f64::shape::{CompositeShapeRef, Polyline};

use crate::map::{DoorStatus, Permeability, World};
use crate::units::{Point, Pose, Vector};

use super::blocker::Blocker;
use super::floor::FragmentFloor;
use super::nearest_on_segment;
use super::opening::Opening;
use super::plan::FloorPlan;
use super::scene::Prism;

/// A face that a beam can meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SeenFace {
    pub blocker: Blocker,
    /// The side of its Orthoframe; none for jambs and leaves.
    pub side: Option<usize>,
}

/// From where beams meet a stretch, as one looks from its start to its end: from one side where what is solid lies on the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Front {
    Left,
    Right,
    Both,
}

/// A stretch that beams meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    pub face: SeenFace,
    pub start: Point,
    pub end: Point,
    pub front: Front,
}

/// What one beam meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// Radians counter-clockwise from +x of the Map.
    pub direction: f64,
    /// In cm; the range where nothing is met.
    pub distance: f64,
    pub face: Option<SeenFace>,
}

/// A stretch of a face that is seen, from right to left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Visible {
    pub face: SeenFace,
    pub right: Point,
    pub left: Point,
}

/// Everything that can be met at one height, ready to be looked at from anywhere.
pub struct Sight {
    faces: Vec<SeenFace>,
    ends: Vec<(Point, Point)>,
    fronts: Vec<Front>,
    shape: Option<Polyline>,
}

impl FloorPlan {
    /// What there is to see at `height` above the Map's zero, in cm.
    #[must_use]
    pub fn sight(&self, world: &World, height: f64) -> Sight {
        let both = |(face, (start, end)): (SeenFace, (Point, Point))| Stretch {
            face,
            start,
            end,
            front: Front::Both,
        };
        let mut found: Vec<Stretch> = Vec::new();
        for fragment in self.fragments() {
            for &(start, end) in &fragment.walls {
                let face = self.wall_face(fragment, start, end);
                // A side of the Area is run through with the Area on its left; a jamb is a side of none.
                let front = if face.side.is_some() { Front::Left } else { Front::Both };
                found.push(Stretch { face, start, end, front });
            }
        }
        for doorway in self.doorways() {
            let Some(door) = doorway.door.and_then(|d| world.doors.get(&d)) else { continue };
            // Over a door there is wall again.
            if door.height.get() > 0.0 && door.height.get() <= height - self.level_of(doorway) {
                found.extend((0..2).filter_map(|side| self.lintel(world, doorway, side)).map(both));
                continue;
            }
            for (leaf, polygon) in
                doorway.leaves(door).obstacles(self.door_state(world, door.id)).iter().enumerate()
            {
                let blocker = Blocker::DoorLeaf { door: door.id, leaf };
                found.extend(polygon.edges().map(|e| both((SeenFace { blocker, side: None }, e))));
            }
        }
        for replica in self.scene().replicas.values() {
            for prism in replica.prisms.iter().filter(|p| p.bottom <= height && height < p.top) {
                let blocker = Blocker::Replica { replica: replica.id, item: prism.item };
                let solid = |side: &usize| is_solid(world, replica.id, prism, *side);
                // Where one side is seen through the others are seen from within.
                let is_whole = (0..prism.sides.len()).all(|side| solid(&side));
                for (side, edge) in prism.section(height).edges().enumerate() {
                    if !solid(&side) {
                        continue;
                    }
                    let seen = both((SeenFace { blocker, side: Some(side) }, edge));
                    // Counter-clockwise about what is solid.
                    let front = if is_whole { Front::Right } else { Front::Both };
                    found.push(Stretch { front, ..seen });
                }
            }
        }
        Sight::of(found)
    }

    /// Height of the floor before a doorway, in the Map's frame, in cm.
    pub(super) fn level_of(&self, doorway: &Opening) -> f64 {
        let room = self.scene().areas.get(&doorway.areas[0]).and_then(|a| a.prisms.first());
        room.map_or(0.0, |prism| prism.bottom)
    }

    /// The wall over a doorway, on its side towards one of its Areas.
    pub(super) fn lintel(
        &self,
        world: &World,
        doorway: &Opening,
        side: usize,
    ) -> Option<(SeenFace, (Point, Point))> {
        let (area, of) = (doorway.areas[side], &doorway.sides[side].side);
        let items = &world.areas.get(&area)?.items;
        let item = items.iter().position(|i| i.id == of.item)?;
        let (number, _) = world.orthoframe_of(&items[item]).side(&of.side)?;
        let (depth, (right, left)) = ([0.0, doorway.gap][side], doorway.span());
        let face =
            SeenFace { blocker: Blocker::Wall { area, item, side: number }, side: Some(number) };
        Some((face, (doorway.at(right, depth), doorway.at(left, depth))))
    }

    /// The side of the Area on which a piece of wall lies.
    pub(super) fn wall_face(&self, fragment: &FragmentFloor, a: Point, b: Point) -> SeenFace {
        let near =
            |p: Point, (u, v): (Point, Point)| (p - nearest_on_segment(p, u, v)).norm() < 0.01;
        let prisms = self.scene().areas.get(&fragment.area).map_or(&[][..], |p| &p.prisms);
        let side = prisms.iter().enumerate().find_map(|(item, prism)| {
            let side = prism.polygon.edges().position(|e| near(a, e) && near(b, e))?;
            Some((item, side))
        });
        let (item, number) = side.unwrap_or((0, 0));
        let blocker = Blocker::Wall { area: fragment.area, item, side: number };
        SeenFace { blocker, side: side.map(|s| s.1) }
    }
}

/// Whether a side of a thing's prism stops a beam: walls do, doors of Objects while they are shut.
#[must_use]
pub fn is_solid(
    world: &World,
    replica: crate::units::ReplicaId,
    prism: &Prism,
    side: usize,
) -> bool {
    match prism.sides[side].permeability {
        Permeability::Impermeable => true,
        Permeability::Permeable => false,
        Permeability::Conditional => {
            let Some(model) = world.replicas.get(&replica) else { return true };
            let object = &world.objects[&model.object];
            let item = object.items.get(prism.item).map(|i| i.id.as_str());
            let id = &world.orthoframes[&prism.orthoframe].base[side].id;
            let mount =
                object.doors.iter().find(|m| Some(m.item.as_str()) == item && m.side == *id);
            let Some(mount) = mount else { return true };
            let state = model.door_states.get(&mount.door).copied();
            let state = state.or_else(|| world.doors.get(&mount.door).map(|d| d.state));
            state.is_none_or(|s| s.status != DoorStatus::Open)
        }
    }
}

impl Sight {
    fn of(mut found: Vec<Stretch>) -> Self {
        found.retain(|stretch| (stretch.end - stretch.start).norm() > 1e-9);
        let faces = found.iter().map(|stretch| stretch.face).collect();
        let fronts = found.iter().map(|stretch| stretch.front).collect();
        let ends: Vec<_> = found.iter().map(|stretch| (stretch.start, stretch.end)).collect();
        let vertices =
            ends.iter().flat_map(|&(a, b)| [a, b]).map(|p| Vec2::new(p.x, p.y)).collect();
        let indices = (0..ends.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        let shape = (!ends.is_empty()).then(|| Polyline::new(vertices, Some(indices)));
        Self { faces, ends, fronts, shape }
    }

    /// Every face, as it stands in the floor plan; a side that is seen through is none.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = Stretch> + '_ {
        let ends = self.ends.iter().zip(&self.fronts);
        self.faces.iter().zip(ends).map(|(&face, (&(start, end), &front))| Stretch {
            face,
            start,
            end,
            front,
        })
    }

    /// Casts one beam.
    #[must_use]
    pub fn beam(&self, from: Point, direction: f64, range: f64) -> Beam {
        let (sin, cos) = direction.sin_cos();
        let ray = Ray::new(Vec2::new(from.x, from.y), Vec2::new(cos, sin));
        let hit = self
            .shape
            .as_ref()
            .and_then(|s| CompositeShapeRef(s).cast_local_ray(&ray, range, true));
        match hit {
            Some((segment, distance)) => {
                Beam { direction, distance, face: Some(self.faces[segment as usize]) }
            }
            None => Beam { direction, distance: range, face: None },
        }
    }

    /// A scan of `beams` beams over a field of view of `field` degrees about the heading, from right to left.
    #[must_use]
    pub fn scan(&self, pose: Pose, field: f64, beams: usize, range: f64) -> Vec<Beam> {
        let field = field.clamp(0.0, 360.0).to_radians();
        let step = if beams > 1 { field / (beams - 1) as f64 } else { 0.0 };
        let first = pose.heading.radians() - if beams > 1 { field / 2.0 } else { 0.0 };
        (0..beams).map(|k| self.beam(pose.at, first + step * k as f64, range)).collect()
    }

    /// The stretches of faces that are seen within a field of view of `field` degrees, from right to left.
    #[must_use]
    pub fn visible(&self, pose: Pose, field: f64, range: f64) -> Vec<Visible> {
        let half = field.clamp(0.0, 360.0).to_radians() / 2.0;
        let heading = pose.heading.radians();
        let turn = |p: Point| {
            let v: Vector = p - pose.at;
            (v.y.atan2(v.x) - heading + PI).rem_euclid(2.0 * PI) - PI
        };
        let mut turns: Vec<f64> = self
            .ends
            .iter()
            .filter(|&&(a, b)| (nearest_on_segment(pose.at, a, b) - pose.at).norm() <= range)
            .flat_map(|&(a, b)| [turn(a), turn(b)])
            .filter(|t| t.abs() < half)
            .chain([-half, half])
            .collect();
        turns.sort_by(f64::total_cmp);
        turns.dedup_by(|a, b| *a - *b < 1e-9);
        let mut seen = Vec::new();
        for pair in turns.windows(2) {
            let inset = ((pair[1] - pair[0]) / 4.0).min(1e-7);
            let cast = |t: f64| self.beam(pose.at, heading + t, range);
            self.between(pose.at, cast(pair[0] + inset), cast(pair[1] - inset), range, &mut seen);
        }
        join(seen)
    }

    /// Stretches between two beams: one if both and their middle meet the same face, else halves.
    fn between(&self, from: Point, right: Beam, left: Beam, range: f64, seen: &mut Vec<Visible>) {
        let middle = self.beam(from, (right.direction + left.direction) / 2.0, range);
        let is_one = right.face == left.face && middle.face == right.face;
        if is_one || left.direction - right.direction < 1e-4 {
            if let (Some(face), true) = (right.face, right.face == left.face) {
                seen.push(Visible { face, right: end_of(from, right), left: end_of(from, left) });
            }
            return;
        }
        self.between(from, right, middle, range, seen);
        self.between(from, middle, left, range, seen);
    }
}

fn end_of(from: Point, beam: Beam) -> Point {
    from + Vector::new(beam.direction.cos(), beam.direction.sin()) * beam.distance
}

/// Stretches of one face that follow each other, joined.
fn join(seen: Vec<Visible>) -> Vec<Visible> {
    let mut joined: Vec<Visible> = Vec::new();
    for next in seen {
        match joined.last_mut() {
            Some(last) if last.face == next.face && (last.left - next.right).norm() < 0.1 => {
                last.left = next.left;
            }
            _ => joined.push(next),
        }
    }
    joined.retain(|v| (v.left - v.right).norm() > 1e-3);
    joined
}
