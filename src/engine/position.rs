//! Where a pose is, from the terms of geometry to a report in words (SPEC T4).

use crate::language::Language;
use crate::language::names::english_name;
use crate::language::report::read::{SaidMark, SaidOpening, SaidPosition, SaidSpot};
use crate::language::report::{
    Beside, Context, Facing, Mark, Named, OpeningKind, Position, Spot, ToldOpening,
};
use crate::map::{Entity, World};
use crate::semantics::{self, Faced, Relations, Way, Whereabouts, faced, whereabouts};
use crate::units::{AreaId, DoorId, MapId, Pose, name_key};

use super::lexicon::named;
use super::located::nowhere_on;
use super::reading::regions;
use super::{Error, State};

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
        match describe(world, self.relations()?, map, pose, facing) {
            Some(found) => Ok(found),
            None => Err(nowhere_on(world, self.floor(map)?, pose.at).into()),
        }
    }
}

/// Describes a pose, and where it is asked what the robot faces.
#[must_use]
pub(super) fn describe(
    world: &World,
    relations: &Relations,
    map: MapId,
    pose: Pose,
    facing: bool,
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
    let faced = facing.then(|| faced(world, relations, map, &[pose]));
    position.facing = faced.into_iter().flatten().next().map(|faced| match faced {
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
