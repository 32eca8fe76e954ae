//! Where a pose is, from the terms of geometry to a report in words (SPEC T4).

use crate::geometry::{Blocker, Bounds, FloorPlan, Owner, Scene, nearest_on_segment};
use crate::language::Language;
use crate::language::names::english_name;
use crate::language::report::read::{SaidMark, SaidOpening, SaidPosition, SaidSpot};
use crate::language::report::{
    Beside, Context, Facing, Mark, Named, OpeningKind, Position, Spot, ToldOpening,
};
use crate::map::{DoorStatus, Entity, Permeability, World};
use crate::semantics::{self, Relations, Way, Whereabouts, whereabouts};
use crate::units::{AreaId, DoorId, Lengths, MapId, Point, Pose, ReplicaId, Vector, name_key};

use super::lexicon::named;
use super::reading::regions;
use super::{Error, RequestError, State};

/// A pose with what can be said of it.
#[derive(Debug, Clone)]
pub struct Whereabout {
    pub map: MapId,
    pub pose: Pose,
    pub terms: Whereabouts,
    pub position: Position,
}

impl State {
    /// Where a pose of a map is. `facing` asks for the heading too.
    ///
    /// # Errors
    /// The pose lies in no Area.
    pub fn locate(&self, map: MapId, pose: Pose, facing: bool) -> Result<Whereabout, Error> {
        let world = self.world()?;
        let found = describe(
            world,
            self.relations()?,
            map,
            pose,
            facing.then(|| self.floor(map)).transpose()?,
        );
        match found {
            Some(found) => Ok(found),
            None => Err(nowhere_on(world, self.floor(map)?, pose.at).into()),
        }
    }
}

/// A point as it is told: (225, 380).
pub(super) fn spot_in_words(x: f64, y: f64, between: &str) -> String {
    let [x, y] = [x, y].map(|at| Lengths::said().short(at, 2));
    format!("({x}{between}{y})")
}

/// A point that no Area of a map holds.
pub(super) fn nowhere_on(world: &World, floor: &FloorPlan, at: Point) -> RequestError {
    let map = world.maps[&floor.map()].name.clone();
    let at = spot_in_words(at.x, at.y, ", ");
    RequestError::Nowhere { at, map, extent: extent(floor.scene()) }
}

fn extent(scene: &Scene) -> String {
    let rooms = scene.areas.values().flat_map(|a| &a.prisms);
    let b = rooms.fold(Bounds::EMPTY, |b, p| b.union(&p.bounds));
    let [left, right, near, far] =
        [b.min.x, b.max.x, b.min.y, b.max.y].map(|at| Lengths::said().number(at, 0));
    format!("x {left}…{right}, y {near}…{far}")
}

/// Describes a pose; with its floor, also what the robot faces.
#[must_use]
pub(super) fn describe(
    world: &World,
    relations: &Relations,
    map: MapId,
    pose: Pose,
    floor: Option<&FloorPlan>,
) -> Option<Whereabout> {
    let terms = whereabouts(world, relations, map, &pose)?;
    let area = |id: AreaId| named(world, Entity::Area(id));
    let spot = match terms.spot {
        semantics::Spot::InDoorway(way) => Some(Spot::InDoorway(doorway(world, relations, way))),
        semantics::Spot::AtDoor { way, .. } => Some(Spot::AtDoor(doorway(world, relations, way))),
        semantics::Spot::On { replica } => {
            Some(Spot::Object(Beside::On, named(world, Entity::Replica(replica))))
        }
        semantics::Spot::NextTo { replica, .. } => {
            Some(Spot::Object(Beside::NextTo, named(world, Entity::Replica(replica))))
        }
        semantics::Spot::InCorner => Some(Spot::InCorner(None)),
        semantics::Spot::AlongWall => Some(Spot::AlongWall(None)),
        semantics::Spot::InMiddle => Some(Spot::InMiddle),
        semantics::Spot::Inside => None,
    };
    let mut position = Position::new(area(terms.area), spot);
    let areas = namesakes(world, Entity::Area(terms.area), &[]);
    let telling = Telling { world, relations, map, area: terms.area, areas };
    position.context = telling.context(None);
    position.spot_context = telling.context(Some(&terms.spot));
    let faced = floor.and_then(|floor| faced(world, relations, floor, terms.area, pose));
    position.facing = faced.map(|faced| match faced {
        Faced::Door(way) => Facing::Door(doorway(world, relations, way)),
        Faced::Leaf(way) => Facing::Leaf(doorway(world, relations, way)),
        Faced::Object(replica) => Facing::Object(named(world, Entity::Replica(replica))),
        Faced::Wall { own } if terms.spot == semantics::Spot::AlongWall => match own {
            true => Facing::OwnWall,
            false => Facing::OtherWall,
        },
        Faced::Wall { .. } => Facing::Wall,
        Faced::Inward => Facing::Inward,
    });
    Some(Whereabout { map, pose, terms, position })
}

/// Says as little of an Area as tells it from all others (Zender and Kruijff: the context is widened until the
/// description is unique).
struct Telling<'a> {
    world: &'a World,
    relations: &'a Relations,
    map: MapId,
    area: AreaId,
    /// All Areas of its name.
    areas: Vec<Entity>,
}

impl Telling<'_> {
    /// The first context under which one region of the building is meant; where none does, the widest.
    fn context(&self, spot: Option<&semantics::Spot>) -> Context {
        if self.is_unique(spot, false, None) {
            return Context::default();
        }
        let floor = !self.world.maps[&self.map].name.is_empty();
        let within = || vec![named(self.world, Entity::Map(self.map))];
        if floor && self.is_unique(spot, true, None) {
            return Context { within: within(), mark: None };
        }
        let marks = self.marks();
        let found = marks.iter().find(|(_, said)| self.is_unique(spot, false, Some(said)));
        if let Some((mark, _)) = found {
            return Context { within: Vec::new(), mark: Some(mark.clone()) };
        }
        let found = marks.into_iter().find(|(_, said)| self.is_unique(spot, true, Some(said)));
        let within = if floor { within() } else { Vec::new() };
        Context { within, mark: found.map(|(mark, _)| mark) }
    }

    /// Whether a reader of the report would find one region.
    fn is_unique(
        &self,
        spot: Option<&semantics::Spot>,
        floor: bool,
        mark: Option<&SaidMark<Entity>>,
    ) -> bool {
        let said = SaidPosition {
            language: Language::Russian,
            area: self.areas.clone(),
            within: floor.then(|| self.namesakes(Entity::Map(self.map))).into_iter().collect(),
            mark: mark.cloned(),
            spot: spot.and_then(|spot| self.said(spot)),
            facing: None,
        };
        regions(self.relations, &said).is_ok_and(|found| found.len() == 1)
    }

    /// What may tell the Area from its namesakes: the rooms beside it, its doors, what stands in it.
    fn marks(&self) -> Vec<(Mark, SaidMark<Entity>)> {
        let openings = self.relations.openings().of_area(self.area);
        let (mut marks, mut doors) = (Vec::new(), Vec::new());
        let mut beside = std::collections::BTreeSet::new();
        for opening in openings {
            let sides = opening.all_areas().into_iter();
            for room in sides.filter(|side| *side != self.area && beside.insert(*side)) {
                let (room, names) = self.named(Entity::Area(room));
                marks.push((Mark::Adjoining(room), SaidMark::Adjoining(names)));
            }
            let door = opening.door.map(Entity::Door);
            doors.extend(door.filter(|d| !self.world.name(*d).is_empty()));
        }
        let things = self.world.replicas.values().filter(|r| r.area == self.area);
        let stays = |r: &&crate::map::Replica| {
            !self.world.has_trait(r.id, "portable") && !r.name.is_empty()
        };
        let things = things.filter(stays).map(|r| Entity::Replica(r.id));
        for thing in things.chain(doors) {
            let (thing, names) = self.named(thing);
            marks.push((Mark::With(thing), SaidMark::With(names)));
        }
        marks
    }

    fn named(&self, entity: Entity) -> (Named, Vec<Entity>) {
        (named(self.world, entity), self.namesakes(entity))
    }

    fn namesakes(&self, entity: Entity) -> Vec<Entity> {
        namesakes(self.world, entity, &self.areas)
    }

    /// A spot in the terms in which its report is read back.
    fn said(&self, spot: &semantics::Spot) -> Option<SaidSpot<Entity>> {
        let door = |way: Way| {
            let name = own_name(self.world, self.relations, way);
            let opening = if way.is_passage { OpeningKind::Passage } else { OpeningKind::Door };
            SaidOpening {
                opening: name.is_none().then_some(opening),
                name: name.map(|door| self.namesakes(Entity::Door(door))),
                from: self.namesakes(Entity::Area(way.from)),
                to: way.to.map(|to| self.namesakes(Entity::Area(to))),
            }
        };
        Some(match *spot {
            semantics::Spot::InDoorway(way) => SaidSpot::InDoorway(door(way)),
            semantics::Spot::AtDoor { way, .. } => SaidSpot::AtDoor(door(way)),
            semantics::Spot::On { replica } => {
                SaidSpot::Object(Beside::On, self.namesakes(Entity::Replica(replica)))
            }
            semantics::Spot::NextTo { replica, .. } => {
                SaidSpot::Object(Beside::NextTo, self.namesakes(Entity::Replica(replica)))
            }
            semantics::Spot::InCorner => SaidSpot::InCorner(None),
            semantics::Spot::AlongWall => SaidSpot::AlongWall(None),
            semantics::Spot::InMiddle => SaidSpot::InMiddle,
            semantics::Spot::Inside => return None,
        })
    }
}

/// What of the same sort bears the same name, in either language, the entity itself first; of things, those in some
/// Areas only.
fn namesakes(world: &World, entity: Entity, within: &[Entity]) -> Vec<Entity> {
    let own = [world.name(entity), english_name(world, entity)].map(name_key);
    let alike = |other: Entity| {
        let names = [world.name(other), english_name(world, other)].map(name_key);
        names.iter().zip(&own).any(|(name, own)| !own.is_empty() && name == own)
    };
    let mut found = vec![entity];
    match entity {
        Entity::Map(_) => found.extend(world.maps.keys().map(|id| Entity::Map(*id))),
        Entity::Area(_) => found.extend(world.areas.keys().map(|id| Entity::Area(*id))),
        Entity::Door(_) => found.extend(world.doors.keys().map(|id| Entity::Door(*id))),
        Entity::Replica(_) => {
            let here = world.replicas.values().filter(|r| within.contains(&Entity::Area(r.area)));
            found.extend(here.map(|r| Entity::Replica(r.id)));
        }
        Entity::Place(_) | Entity::Zone(_) => {}
    }
    let mut first = true;
    found.retain(|other| std::mem::take(&mut first) || (*other != entity && alike(*other)));
    found
}

/// The door whose own name is needed, where the names of the Areas that it joins are those of others too.
fn own_name(world: &World, relations: &Relations, way: Way) -> Option<DoorId> {
    let name = |area: AreaId| world.areas[&area].name.as_str();
    let door = way.door.filter(|door| !world.name(Entity::Door(*door)).is_empty())?;
    let alike = |join: &&semantics::Join| {
        name(join.from) == name(way.from)
            && way.to.is_some_and(|to| name(join.to) == name(to))
            && is_passage(world, join.door) == way.is_passage
    };
    (relations.joins().iter().filter(alike).count() > 1).then_some(door)
}

/// A door told by the Areas on its sides, and by its own name where these are joined by several.
fn doorway(world: &World, relations: &Relations, way: Way) -> ToldOpening {
    let area = |id: AreaId| -> Named { named(world, Entity::Area(id)) };
    let name = own_name(world, relations, way).map(|door| named(world, Entity::Door(door)));
    ToldOpening {
        opening: if way.is_passage { OpeningKind::Passage } else { OpeningKind::Door },
        name,
        from: area(way.from),
        to: way.to.map(area),
    }
}

fn is_passage(world: &World, door: Option<DoorId>) -> bool {
    door.and_then(|d| world.doors.get(&d)).is_none_or(|d| d.kind == crate::map::DoorKind::Passage)
}

/// What the robot faces, before words are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Faced {
    Door(Way),
    /// An open leaf of a door.
    Leaf(Way),
    Object(ReplicaId),
    Wall {
        /// Whether the robot is by it.
        own: bool,
    },
    /// Nothing near.
    Inward,
}

/// How far a thing of another room may reach through the wall and still stand behind it, cm.
const IN_WALL: f64 = 5.0;

/// The first thing that a ray along the heading meets.
pub(super) fn faced(
    world: &World,
    relations: &Relations,
    floor: &FloorPlan,
    area: AreaId,
    pose: Pose,
) -> Option<Faced> {
    let (scene, near) = (floor.scene(), relations.thresholds());
    let (sin, cos) = pose.heading.sin_cos();
    let ray = Vector::new(cos, sin);
    let height = world.robot.height.get();
    let mut nearest: Option<(f64, Faced)> = None;
    let mut offer = |distance: f64, what: Faced| {
        if distance <= near.robot_facing && nearest.as_ref().is_none_or(|(d, _)| distance < *d) {
            nearest = Some((distance, what));
        }
    };
    // A thing of another room leans on the other side of the wall, or reaches into it where boxes are loose.
    let wall = scene.areas.get(&area).and_then(|placed| {
        let own = placed.prisms.iter().filter(|p| matches!(p.owner, Owner::Area(_)));
        let sides = own.flat_map(|prism| prism.polygon.edges().zip(prism.sides.iter()));
        let walls = sides.filter(|(_, side)| side.permeability == Permeability::Impermeable);
        walls.filter_map(|((a, b), _)| hit(pose.at, ray, a, b)).min_by(f64::total_cmp)
    });
    let is_behind = |replica: ReplicaId, distance: f64| {
        world.replicas.get(&replica).is_some_and(|r| r.area != area)
            && wall.is_some_and(|wall| distance > wall - IN_WALL)
    };
    // One faces a table, not the spoon on it.
    for replica in scene.replicas.values().filter(|r| !world.has_trait(r.id, "portable")) {
        for prism in replica.prisms.iter().filter(|p| p.bottom < height && p.top > 10.0) {
            for (a, b) in prism.polygon.edges() {
                let met = hit(pose.at, ray, a, b);
                if let Some(distance) = met.filter(|d| !is_behind(replica.id, *d)) {
                    offer(distance, Faced::Object(replica.id));
                }
            }
        }
    }
    // One does not look through a door's leaf, nor through the leaf of a wardrobe.
    let is_open = |door: DoorId| floor.door_state(world, door).status == DoorStatus::Open;
    for obstacle in floor.fragment(area).into_iter().flat_map(|f| f.obstacles()) {
        let what = match obstacle.blocker {
            Blocker::DoorLeaf { door, .. } if is_open(door) => {
                way_of(relations, door, area).map(Faced::Leaf)
            }
            Blocker::ReplicaLeaf { replica, .. } => Some(Faced::Object(replica)),
            _ => None,
        };
        for (a, b) in obstacle.polygon.edges() {
            if let (Some(what), Some(distance)) = (what, hit(pose.at, ray, a, b)) {
                offer(distance, what);
            }
        }
    }
    let placed = scene.areas.get(&area)?;
    for prism in &placed.prisms {
        let Owner::Area(area) = prism.owner else { continue };
        for ((a, b), side) in prism.polygon.edges().zip(prism.sides.iter()) {
            let Some(distance) = hit(pose.at, ray, a, b) else { continue };
            if side.permeability == Permeability::Impermeable {
                let away = (pose.at - nearest_on_segment(pose.at, a, b)).norm();
                offer(distance, Faced::Wall { own: away <= near.robot_wall });
            } else if let Some(way) = way_through(relations, area, nalgebra::center(&a, &b)) {
                offer(distance, Faced::Door(way));
            }
        }
    }
    Some(nearest.map_or(Faced::Inward, |(_, faced)| faced))
}

/// A door seen from an Area, or from the one that mounts it where it is not of that Area.
fn way_of(relations: &Relations, door: DoorId, area: AreaId) -> Option<Way> {
    let own = relations.openings().iter().filter(|o| o.door == Some(door));
    let opening = own.min_by_key(|o| !o.is_of(area))?;
    Some(Way::through(opening, if opening.is_of(area) { area } else { opening.area() }))
}

/// The opening of an Area in a side whose middle is here, seen from that Area.
fn way_through(relations: &Relations, area: AreaId, middle: Point) -> Option<Way> {
    let near = |o: &&semantics::Opening| o.sides.iter().any(|s| (s.middle() - middle).norm() < 1.0);
    let opening = relations.openings().iter().filter(near).min_by_key(|o| !o.is_of(area))?;
    Some(Way::through(opening, area))
}

/// Distance along a ray to a segment.
fn hit(from: Point, ray: Vector, a: Point, b: Point) -> Option<f64> {
    let along = b - a;
    let cross = ray.perp(&along);
    if cross.abs() < 1e-12 {
        return None;
    }
    let distance = (a - from).perp(&along) / cross;
    let share = (a - from).perp(&ray) / cross;
    (distance > 0.0 && (0.0..=1.0).contains(&share)).then_some(distance)
}
