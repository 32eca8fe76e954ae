//! Where a robot may stand that is sent to a place, a thing, a door or a room, and which way it faces there.
//!
//! **Invariants**: every goal lies in the centre space. Between a goal and the door that it is before stands nothing, and
//! between a goal and the face of a thing that it is before no wall and no leaf of a door, shut or open.

use std::collections::BTreeSet;

use crate::map::{DoorKind, World};
use crate::units::{
    AreaId, Deg, DoorId, Gather as _, InOrder as _, Point, Pose, ReplicaId, Vector,
};

use super::Bounds;
use super::anchor::Anchor;
use super::blocked::NoRoute;
use super::blocker::{Blocker, Obstacle};
use super::cells::{CellKey, Piece};
use super::opening::Opening;
use super::plan::FloorPlan;
use super::route::Target;

/// Whoever stands farther before a door than clear of it by this, in cm, stands before it no more.
const BEFORE_DOOR: f64 = 205.0;

/// A goal with the way to face there.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Goal {
    pub(super) anchor: Anchor,
    pub(super) heading: Option<Deg>,
}

impl FloorPlan {
    /// Where to stand before a door inside an Area: out of the way of its leaves, facing it.
    #[must_use]
    pub fn stand_before(&self, world: &World, door: DoorId, area: AreaId) -> Option<Pose> {
        let stands = self.door_goals(world, None, door, area);
        stands.first().map(|g| Pose { at: g.anchor.at, heading: g.heading.unwrap_or_default() })
    }

    /// The goals that serve a target, all as good as each other; those for a thing lie `within` the Fragments named, where
    /// some are.
    pub(super) fn goals(
        &self,
        world: &World,
        start: &Anchor,
        target: Target,
        within: Option<&[u32]>,
    ) -> Result<Vec<Goal>, NoRoute> {
        let region = Some(self.region(start.cell));
        let is_shut = |p: Point| self.zones.iter().any(|z| z.kind.is_shut() && z.contains(p, 0.0));
        let point = self.point_of(world, target).filter(|_| !matches!(target, Target::Replica(_)));
        if point.is_some_and(is_shut) {
            // What is shut is no goal, and no place near it instead.
            return Err(NoRoute::NoFloor);
        }
        let found = match target {
            Target::Point(p) => self.point_goals(region, p, None),
            Target::Place(id) => {
                let place = world.places.get(&id).ok_or(NoRoute::NoFloor)?;
                let frame = self
                    .scene()
                    .areas
                    .get(&place.area)
                    .ok_or(NoRoute::OtherMap { area: place.area })?
                    .frame;
                self.point_goals(
                    region,
                    frame.apply(place.at),
                    place.heading.map(|h| h + frame.angle),
                )
            }
            Target::Replica(id) => self.replica_goals(world, start, id, within)?,
            Target::Door { door, area } => {
                let reached = self.door_goals(world, region, door, area);
                // What bars the way is looked for up to where it would stand.
                let is_barred = reached.is_empty();
                if is_barred { self.door_goals(world, None, door, area) } else { reached }
            }
            Target::Area(area) => self.area_goals(world, start, area)?,
        };
        if found.is_empty() { Err(NoRoute::NoFloor) } else { Ok(found) }
    }

    fn point_goals(&self, region: Option<u32>, p: Point, heading: Option<Deg>) -> Vec<Goal> {
        // Near a place that does not admit the robot, take one that it can reach.
        let exact = self.anchor(p, None, None);
        let anchor = match exact {
            Some(a) if a.moved.is_none() => Some(a),
            other => self.anchor(p, region, None).or(other),
        };
        anchor.map(|anchor| Goal { anchor, heading }).into_iter().collect()
    }

    fn door_goals(
        &self,
        world: &World,
        region: Option<u32>,
        door: DoorId,
        area: AreaId,
    ) -> Vec<Goal> {
        let goals: Vec<Goal> = self
            .doorways_of(door)
            .filter_map(|d| Some((d, d.index_of(area)?)))
            .filter_map(|(doorway, side)| self.stand(world, self.admitting(region), doorway, side))
            .collect();
        if !goals.is_empty() {
            return goals;
        }
        // A door that leads outside joins no two Areas.
        let outer = self.blind_openings().iter().find(|o| o.door == Some(door) && o.area() == area);
        outer.and_then(|o| self.stand(world, self.admitting(region), o, 0)).into_iter().collect()
    }

    /// Whether a cell is of a region of the floor, if one is named.
    fn admitting(&self, region: Option<u32>) -> impl Fn(CellKey) -> bool + Copy {
        move |cell| region.is_none_or(|r| self.region(cell) == r)
    }

    /// The piece of a Fragment's floor in which the robot stands that was sent to a doorway, on one side of it.
    pub(super) fn piece_before(&self, world: &World, index: usize, side: usize) -> Option<Piece> {
        let stand = self.stand(world, |_| true, &self.doorways()[index], side)?;
        Some(self.piece_of(stand.anchor.cell))
    }

    /// All pieces in which it may.
    pub(super) fn pieces_before(
        &self,
        world: &World,
        index: usize,
        side: usize,
    ) -> BTreeSet<Piece> {
        let doorway = &self.doorways()[index];
        let Some(number) = self.number(doorway.areas[side]) else { return BTreeSet::new() };
        let components = 0..self.fragments[number].cells.components;
        let pieces = components.map(|component| (number as u32, component));
        let is_before = |piece: &Piece| {
            self.stand(world, |cell| self.piece_of(cell) == *piece, doorway, side).is_some()
        };
        pieces.filter(is_before).gather()
    }

    /// A place before a doorway from which its door is at hand: straight before its middle, clear of the leaves' way.
    fn stand(
        &self,
        world: &World,
        admits: impl Fn(CellKey) -> bool + Copy,
        doorway: &Opening,
        side: usize,
    ) -> Option<Goal> {
        let number = self.number(doorway.areas[side])? as u32;
        let cells = &self.floor(number).cells;
        let reach = self.reach();
        let door = doorway.door.and_then(|d| world.doors.get(&d));
        let swings_here =
            door.is_some_and(|d| d.kind == DoorKind::Hinged) && doorway.opens_to == side;
        let swept = door
            .filter(|_| swings_here)
            .map_or_else(Vec::new, |d| doorway.leaves(d).swept((0.0, 100.0)));
        let is_clear = |p: Point| {
            swept.iter().all(|s| !s.contains(p, 0.0) && s.border_distance(p) >= reach - 1e-6)
        };
        let solid = self.solid_before(number, doorway);
        let is_at_hand = |p: Point| {
            // Some part of it, for a leaf is worked at one of its ends.
            let face = [0.5, 0.1, 0.9].map(|share| doorway.on_face(side, share));
            face.into_iter().any(|at| is_open_between(p, at, &solid))
        };
        let try_at = |p: Point| {
            let cell = cells.locate(p, 1e-6).filter(|&c| admits((number, c)))?;
            (is_clear(p) && is_at_hand(p)).then_some((p, cell))
        };
        let along = (doorway.line().1 - doorway.line().0) / doorway.width().max(1e-9);
        let steps = (1..).map(|k| 5.0 * f64::from(k)).take_while(|back| *back <= BEFORE_DOOR);
        let shifts: [f64; 9] = [0.0, 15.0, -15.0, 30.0, -30.0, 50.0, -50.0, 75.0, -75.0];
        let mut spots: Vec<(f64, f64)> = steps
            .flat_map(|back| shifts.map(|s| (reach + back, s)))
            .filter(|(d, s)| s.abs() <= 2.0 * d)
            .collect();
        // The nearer the better; a step aside costs a little more than one back.
        spots.order_by(|a, b| (a.0 + 1.2 * a.1.abs()).total_cmp(&(b.0 + 1.2 * b.1.abs())));
        let straight =
            spots.into_iter().find_map(|(d, s)| try_at(doorway.before(side, d) + along * s));
        if let Some((at, cell)) = straight {
            let heading = facing(at, doorway.middle());
            return Some(Goal { anchor: Anchor::at(at, (number, cell)), heading });
        }
        let middle = doorway.on_face(side, 0.5);
        self.nearest_before(admits, doorway, side).filter(|goal| {
            (goal.anchor.at - middle).norm() <= reach + BEFORE_DOOR && is_at_hand(goal.anchor.at)
        })
    }

    /// The place in the Area on one side of a doorway that is nearest to it, however far.
    fn nearest_before(
        &self,
        admits: impl Fn(CellKey) -> bool,
        doorway: &Opening,
        side: usize,
    ) -> Option<Goal> {
        let number = self.number(doorway.areas[side])? as u32;
        let straight = doorway.before(side, self.reach() + 5.0);
        let own = |cell| admits((number, cell));
        let (at, cell) = self.floor(number).cells.nearest(straight, own)?;
        let heading = facing(at, doorway.middle());
        Some(Goal { anchor: Anchor::at(at, (number, cell)), heading })
    }

    /// What may stand between the robot in a Fragment and a doorway: walls, things, leaves but its own.
    fn solid_before(&self, number: u32, doorway: &Opening) -> Vec<(Point, Point)> {
        let floor = self.floor(number);
        let is_solid = |obstacle: &&Obstacle| match obstacle.blocker {
            Blocker::DoorLeaf { door, .. } => doorway.door != Some(door),
            Blocker::Replica { .. } | Blocker::ReplicaLeaf { .. } | Blocker::Wall { .. } => true,
            // One reaches over what one only may not, or cannot, drive on.
            Blocker::Floor { .. } | Blocker::Zone { .. } => false,
        };
        let things = floor.obstacles().iter().filter(is_solid);
        let edges = floor.walls.iter().copied().chain(things.flat_map(|o| o.polygon.edges()));
        let (a, b) = doorway.line();
        let near = Bounds::of([a, b]).grown(self.reach() + BEFORE_DOOR + doorway.gap);
        edges.filter(|&(u, v)| Bounds::of([u, v]).meets(&near)).collect()
    }

    /// Inside an Area: just behind each of its doorways that can be reached. Every goal lies in the Area.
    fn area_goals(
        &self,
        world: &World,
        start: &Anchor,
        area: AreaId,
    ) -> Result<Vec<Goal>, NoRoute> {
        let number = self.number(area).ok_or(NoRoute::OtherMap { area })? as u32;
        if start.cell.0 == number {
            return Ok(vec![Goal {
                anchor: Anchor { moved: None, ..start.clone() },
                heading: None,
            }]);
        }
        let admits = self.admitting(Some(self.region(start.cell)));
        let mut goals: Vec<Goal> = self
            .doorways()
            .iter()
            .filter_map(|d| Some((d, d.index_of(area)?)))
            .filter_map(|(d, side)| {
                let stand = self.stand(world, admits, d, side);
                // In the Area is in the Area, whatever stands before the doorway.
                let mut goal = stand.or_else(|| self.nearest_before(admits, d, side))?;
                // One enters looking ahead.
                goal.heading = goal.heading.map(|h| h + Deg::of(180.0));
                Some(goal)
            })
            .collect();
        if goals.is_empty() {
            // No way leads there: what bars it is looked for up to a place in the room itself.
            let middle = self.scene().areas[&area].prisms.first().map(|p| p.polygon.centroid());
            let rest = middle.and_then(|middle| self.rest(number, middle));
            let anchor = rest.map(|(at, cell)| Anchor::at(at, (number, cell)));
            goals.extend(anchor.map(|anchor| Goal { anchor, heading: None }));
        }
        Ok(goals)
    }

    /// Before the front of a thing; else before any of its sides; else as near as can be.
    fn replica_goals(
        &self,
        world: &World,
        start: &Anchor,
        id: ReplicaId,
        within: Option<&[u32]>,
    ) -> Result<Vec<Goal>, NoRoute> {
        let Some(placed) = self.scene().replicas.get(&id) else {
            let area = world.replicas.get(&id).map(|r| r.area).ok_or(NoRoute::NoFloor)?;
            return Err(NoRoute::OtherMap { area });
        };
        let region = self.region(start.cell);
        let object = &world.objects[&world.replicas[&id].object];
        let front = object.front.as_ref().and_then(|f| {
            let item = object.items.iter().position(|i| i.id == f.item)?;
            let (side, _) = world.orthoframe_of(&object.items[item]).side(&f.side)?;
            placed.prisms.get(item)?.polygon.edges().nth(side)
        });
        let edges = placed.prisms.iter().flat_map(|p| p.polygon.edges());
        let sides: Vec<(Point, Point)> = edges.collect();
        // Through a door one stands before a thing only where one can from nowhere else: it may be shut again.
        for is_through in [false, true] {
            let doors = self.doors_of(world, placed.area, is_through);
            let before = |face| self.before_face(region, within, &doors, face);
            if let Some(goal) = front.and_then(before) {
                return Ok(vec![goal]);
            }
            let goals: Vec<Goal> = sides.iter().copied().filter_map(before).collect();
            if !goals.is_empty() {
                return Ok(goals);
            }
        }
        let middle = nalgebra::center(&placed.bounds.min, &placed.bounds.max);
        if self.zones.iter().any(|zone| zone.kind.is_shut() && zone.contains(middle, 0.0)) {
            return Err(NoRoute::NoFloor);
        }
        let anchor = self.anchor(middle, Some(region), within).filter(|a| {
            self.floor(a.cell.0).area == placed.area
                && (a.at - middle).norm() < 150.0 + self.reach()
        });
        let anchor = anchor.or_else(|| self.anchor(middle, None, None));
        Ok(anchor
            .map(|a| Goal { heading: facing(a.at, middle), anchor: Anchor { moved: None, ..a } })
            .into_iter()
            .collect())
    }

    /// The best place to stand before a face, facing it: at its middle, close; not through `doors`.
    fn before_face(
        &self,
        region: u32,
        within: Option<&[u32]>,
        doors: &[(Point, Point)],
        (a, b): (Point, Point),
    ) -> Option<Goal> {
        let along = (b - a).try_normalize(1e-6)?;
        let out = Vector::new(along.y, -along.x);
        let length = (b - a).norm();
        let admits = |number: u32| within.is_none_or(|w| w.contains(&number));
        let mut solid = None;
        for back in [3.0, 8.0, 15.0, 25.0, 40.0] {
            for share in [0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95] {
                let face = a + along * (length * share);
                let at = face + out * (self.reach() + back);
                for &number in self.fragments_at(at).iter().filter(|n| admits(**n)) {
                    let Some(cell) = self.floor(number).cells.locate(at, 1e-6) else { continue };
                    if self.region((number, cell)) != region {
                        continue;
                    }
                    let solid = solid.get_or_insert_with(|| self.shutting_off(doors, a, b));
                    if is_open_between(at, face, solid) {
                        let heading = Deg::from_radians((-out.y).atan2(-out.x));
                        let anchor = Anchor::at(at, (number, cell));
                        return Some(Goal { anchor, heading: Some(heading) });
                    }
                }
            }
        }
        None
    }

    /// The doorways of an Area's doors: those that are shut, and the others too unless it may be through them.
    fn doors_of(&self, world: &World, area: AreaId, is_through: bool) -> Vec<(Point, Point)> {
        let has_leaf = |doorway: &Opening| {
            let door = doorway.door.and_then(|door| world.doors.get(&door));
            door.is_some_and(|door| door.kind != DoorKind::Passage)
        };
        let own = self.doorways.by_area.of(area).iter().map(|own| own.0);
        own.filter(|&number| !is_through || !self.admits(number))
            .map(|number| &self.doorways()[number])
            .filter(|doorway| has_leaf(doorway))
            .map(|doorway| doorway.line())
            .collect()
    }

    /// What shuts off a face of a thing from whoever is before it: walls, the leaves of doors as they stand, and `doors`.
    fn shutting_off(&self, doors: &[(Point, Point)], a: Point, b: Point) -> Vec<(Point, Point)> {
        let near = Bounds::of([a, b]).grown(self.reach() + 40.0);
        let is_leaf = |o: &&Obstacle| matches!(o.blocker, Blocker::DoorLeaf { .. });
        let mut solid = doors.to_vec();
        for floor in self.fragments_near(&near) {
            let leaves = floor.obstacles().iter().filter(is_leaf);
            solid.extend(floor.walls.iter().copied());
            solid.extend(leaves.flat_map(|leaf| leaf.polygon.edges()));
        }
        solid.retain(|&(u, v)| Bounds::of([u, v]).meets(&near));
        solid
    }
}

/// No edge of what is solid lies between two points, the second of which may itself lie on one.
fn is_open_between(a: Point, b: Point, solid: &[(Point, Point)]) -> bool {
    let reach = Bounds::of([a, b]);
    let stop = b + (a - b) * 0.02;
    solid
        .iter()
        .filter(|&&(u, v)| Bounds::of([u, v]).meets(&reach))
        .all(|&(u, v)| super::apart::segment_distance(a, stop, u, v) > 0.0)
}

fn facing(from: Point, to: Point) -> Option<Deg> {
    let v = to - from;
    (v.norm() > 1e-9).then(|| Deg::from_radians(v.y.atan2(v.x)))
}
