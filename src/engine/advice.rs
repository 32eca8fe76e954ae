//! What would open a way, in words of both languages: doors to open or to shut, things to push, and where to.
//!
//! A push is told by what lies that way in the room, as people tell it: a window, a door, a piece of furniture;
//! otherwise by what lies the opposite way, and where nothing does by the angle on the Map.

use crate::geometry::{FloorPlan, Remedy};
use crate::language::{Case, Language, enumerate};
use crate::map::{DoorStatus, Entity, World};
use crate::semantics::{Relations, Thresholds};
use crate::units::{DoorId, Lengths, Point, ReplicaId, Vector, told};

use super::barriers::thing_in_words;
use super::lexicon::named;

/// A change that is known to open a way.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    pub remedy: Remedy,
    /// Of a push.
    pub whither: Option<Whither>,
}

/// Which way a thing is pushed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Whither {
    Towards(Landmark),
    AwayFrom(Landmark),
    /// Degrees counter-clockwise from +x of the Map.
    Angle(f64),
}

/// What people name a direction by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Landmark {
    Window,
    Door(DoorId),
    Thing(ReplicaId),
}

impl Advice {
    /// `relations` are asked for where something is to be pushed.
    pub(super) fn of<'r>(
        world: &World,
        floor: &FloorPlan,
        relations: impl FnOnce() -> Option<&'r Relations>,
        remedy: Remedy,
    ) -> Self {
        let whither = match &remedy {
            Remedy::Move { replica, by, .. } => {
                Some(whither(world, floor, relations(), *replica, *by))
            }
            _ => None,
        };
        Self { remedy, whither }
    }

    /// «подвиньте Стул-2 на 14 см к окну»
    #[must_use]
    pub fn in_words(&self, world: &World, language: Language) -> String {
        let of = |entity: Entity, case: Case| named(world, entity).form(case, language);
        let opening = |doors: &[DoorId]| {
            let verb = |door: &DoorId| match world.doors.get(door).map(|d| d.state) {
                Some(s) if s.status == DoorStatus::Locked => {
                    told!(language, "unlock-and-open")
                }
                Some(s) if s.status == DoorStatus::Open && s.opening > 0.0 => {
                    told!(language, "open-wide")
                }
                _ => told!(language, "open-please"),
            };
            let mut told: Vec<(String, Vec<String>)> = Vec::new();
            for door in doors {
                let (verb, name) = (verb(door), of(Entity::Door(*door), Case::Accusative));
                match told.last_mut().filter(|(last, _)| *last == verb) {
                    Some((_, names)) => names.push(name),
                    None => told.push((verb, vec![name])),
                }
            }
            let parts = told.iter().map(|(v, names)| format!("{v} {}", enumerate(names, language)));
            enumerate(&parts.collect::<Vec<_>>(), language)
        };
        let (open, change) = match &self.remedy {
            Remedy::Open(doors) => return opening(doors),
            Remedy::Move { replica, by, open } => {
                let thing = thing_in_words(world, *replica, Case::Accusative, language);
                let distance = Lengths::said().told(by.norm(), 0, language);
                let push = told!(language, "move-by", thing, distance);
                let way = self.whither.map(|w| self.way(world, w, language));
                (open, way.map_or(push.clone(), |way| format!("{push} {way}")))
            }
            Remedy::Shut { door, of: None, open } => {
                let door = of(Entity::Door(*door), Case::Accusative);
                (open, format!("{} {door}", told!(language, "shut-please")))
            }
            Remedy::Shut { of: Some(replica), open, .. } => {
                let of = of(Entity::Replica(*replica), Case::Genitive);
                let change = told!(language, "shut-the-doors-of", of);
                (open, change)
            }
            Remedy::Remove { replicas, open } => {
                let things: Vec<String> = replicas
                    .iter()
                    .map(|r| thing_in_words(world, *r, Case::Accusative, language))
                    .collect();
                let change =
                    format!("{} {}", told!(language, "take-away"), enumerate(&things, language));
                (open, change)
            }
        };
        if open.is_empty() {
            return change;
        }
        format!("{} {} {change}", opening(open), told!(language, "and-then"))
    }

    fn way(&self, world: &World, whither: Whither, language: Language) -> String {
        let name = |landmark: Landmark, case: Case| match landmark {
            Landmark::Window if case == Case::Dative => told!(language, "towards-the-window"),
            Landmark::Window => told!(language, "from-the-window"),
            Landmark::Door(id) => named(world, Entity::Door(id)).form(case, language),
            Landmark::Thing(id) => named(world, Entity::Replica(id)).form(case, language),
        };
        match whither {
            Whither::Towards(to) => told!(language, "towards", what = name(to, Case::Dative)),
            Whither::AwayFrom(from) => {
                told!(language, "away-from", what = name(from, Case::Genitive))
            }
            Whither::Angle(degrees) => told!(language, "at-an-angle", degrees),
        }
    }
}

/// What lies in the direction of a push, seen from the thing that is pushed.
fn whither(
    world: &World,
    floor: &FloorPlan,
    relations: Option<&Relations>,
    replica: ReplicaId,
    by: Vector,
) -> Whither {
    let angle = || Whither::Angle(by.y.atan2(by.x).to_degrees().round().rem_euclid(360.0));
    let Some(thing) = floor.scene().replicas.get(&replica) else { return angle() };
    let centre = nalgebra::center(&thing.bounds.min, &thing.bounds.max);
    let off = |way: Vector, at: Point| {
        let to = at - centre;
        way.perp(&to).atan2(way.dot(&to)).abs().to_degrees()
    };
    let landmarks = landmarks(world, floor, relations, replica);
    let most = relations.map_or_else(Thresholds::default, |r| *r.thresholds()).push_toward;
    let nearest = |way: Vector| {
        let that_way = landmarks.iter().filter(|(_, at)| off(way, *at) <= most);
        that_way.min_by(|a, b| off(way, a.1).total_cmp(&off(way, b.1))).map(|(l, _)| *l)
    };
    nearest(by)
        .map(Whither::Towards)
        .or_else(|| nearest(-by).map(Whither::AwayFrom))
        .unwrap_or_else(angle)
}

/// Windows, doors and furniture of a thing's room, and where they are.
fn landmarks(
    world: &World,
    floor: &FloorPlan,
    relations: Option<&Relations>,
    replica: ReplicaId,
) -> Vec<(Landmark, Point)> {
    let Some(area) = world.replicas.get(&replica).map(|r| r.area) else { return Vec::new() };
    let Some(placed) = floor.scene().areas.get(&area) else { return Vec::new() };
    let mut found = Vec::new();
    for prism in &placed.prisms {
        let vectors = world.orthoframes.get(&prism.orthoframe).map_or(&[][..], |o| &o.base);
        let windows = prism.polygon.edges().zip(vectors).filter(|(_, v)| world.is_window(v));
        found.extend(windows.map(|((a, b), _)| (Landmark::Window, nalgebra::center(&a, &b))));
    }
    let doorways = floor.doorways().iter().filter(|d| d.index_of(area).is_some());
    let is_named = |id: DoorId| world.doors.get(&id).is_some_and(|d| !d.name.is_empty());
    let doors = doorways.filter_map(|d| Some((Landmark::Door(d.door?), d.middle())));
    found.extend(doors.filter(|(l, _)| matches!(l, Landmark::Door(id) if is_named(*id))));
    let things = floor.scene().replicas_in(area).filter(|r| r.id != replica);
    let standing = things
        .filter(|r| relations.is_some_and(|all| all.stands_on_floor(r.id, area)))
        .filter(|r| {
            let model = world.replicas.get(&r.id);
            model.is_some_and(|m| !m.name.is_empty())
        });
    found.extend(
        standing.map(|r| (Landmark::Thing(r.id), nalgebra::center(&r.bounds.min, &r.bounds.max))),
    );
    found
}
