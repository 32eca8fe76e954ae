//! Map and state as the initial facts of a planning problem (paper 1 §8; SPEC P5).
//!
//! The predicates are those that the head of `rules/service-robot.strips` asks the Map for. A scenario names only what
//! the Map cannot know. Plain data: predicate, arguments with their types, and whether it is a fact or an assumption.
//!
//! **Invariant:** a place serves an object that the robot reaches from it; what has no such place is not spoken of.

use std::collections::{BTreeMap, BTreeSet};

use crate::map::{DoorKind, DoorStatus, Entity, Mark, Replica, World, is_dark, is_on, stands};
use crate::units::{AreaId, Gather as _, PlaceId, ReplicaId};

use super::lifts::{Lift, lifts, storey_name};
use super::measure::Single;
use super::predicate;
use super::relations::Relations;

/// One argument of a fact, with its type in the rule file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Argument {
    pub name: String,
    pub kind: &'static str,
}

/// A fact of the initial position.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct InitialFact {
    pub predicate: &'static str,
    pub arguments: Vec<Argument>,
    /// Holds until it is observed otherwise (SPEC P2).
    pub assumed: bool,
}

/// What stands behind the name of a place in a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlaceSource {
    Named(PlaceId),
    /// Before this thing, wherever the robot can stand.
    Before(ReplicaId),
    /// Where the robot is now.
    Robot,
}

/// A place that a plan may send the robot to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanPlace {
    pub name: String,
    pub area: AreaId,
    pub source: PlaceSource,
}

/// Where the robot is, as far as a plan cares.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RobotAt {
    Place(PlaceId),
    Before(ReplicaId),
    /// At a door, named as [`Relations`] names it, on the side of the robot's Area.
    Door(String),
    /// At no place with a name.
    Elsewhere,
}

/// The part of the state that the Map does not hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotState {
    pub area: AreaId,
    pub at: RobotAt,
    pub holds: Option<ReplicaId>,
}

/// The initial position of a planning problem.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Initial {
    /// Sorted, distinct.
    pub facts: Vec<InitialFact>,
    pub places: Vec<PlanPlace>,
}

/// Name of the place where the robot stands when it stands at no named one.
pub const ROBOT_PLACE: &str = "Место-робота";

/// What the name of a place beside a thing begins with, where the thing cannot lend it its own.
pub const PLACE_BESIDE: &str = "Место-у-";

/// Facts for a plan from the Map as it is.
#[must_use]
pub fn initial(world: &World, relations: &Relations, state: &RobotState) -> Initial {
    let mut writer = Writer {
        world,
        relations,
        facts: BTreeSet::new(),
        places: BTreeMap::new(),
        shut: relations.all_shut_in(),
    };
    let lifts = lifts(world, relations);
    writer.doors(&lifts);
    writer.storeys(&lifts);
    writer.lifts(&lifts, state.area);
    writer.named_places();
    writer.light();
    writer.things(state.holds);
    writer.robot(state);
    Initial {
        facts: writer.facts.into_iter().collect(),
        places: writer
            .places
            .into_iter()
            .map(|(name, (area, source))| PlanPlace { name, area, source })
            .collect(),
    }
}

const ROOM: &str = "помещение";
const DOOR: &str = "дверь";
const PLACE: &str = "место";
const ITEM: &str = "предмет";
const OBJECT: &str = "объект";
const PERSON: &str = "человек";
const LIFT: &str = "лифт";
const STOREY: &str = "этаж";

struct Writer<'a> {
    world: &'a World,
    relations: &'a Relations,
    facts: BTreeSet<InitialFact>,
    places: BTreeMap<String, (AreaId, PlaceSource)>,
    /// What is in something that is shut.
    shut: BTreeSet<ReplicaId>,
}

impl Writer<'_> {
    fn fact(&mut self, predicate: &'static str, arguments: &[(&str, &'static str)]) {
        self.insert(predicate, arguments, false);
    }

    fn insert(
        &mut self,
        predicate: &'static str,
        arguments: &[(&str, &'static str)],
        assumed: bool,
    ) {
        let arguments = arguments
            .iter()
            .map(|&(name, kind)| Argument { name: name.to_owned(), kind })
            .collect();
        self.facts.insert(InitialFact { predicate, arguments, assumed });
    }

    /// A lift works its doors by itself: whether one stands open is where the cabin is.
    fn doors(&mut self, lifts: &[Lift]) {
        let of_lifts: BTreeSet<&str> =
            lifts.iter().flat_map(|lift| &lift.doors).map(|join| join.opening.as_str()).gather();
        for join in self.relations.joins() {
            let (from, to) = (self.area(join.from), self.area(join.to));
            self.fact(predicate::DOOR_IN, &[(&join.opening, DOOR), (&from, ROOM)]);
            let door = join.door.and_then(|d| self.world.doors.get(&d));
            let leafed = door.filter(|d| d.kind != DoorKind::Passage && !d.leaves.is_empty());
            let of_lift = of_lifts.contains(join.opening.as_str());
            if leafed.is_some() && !of_lift {
                self.fact(predicate::DOOR_HAS_LEAF, &[(&join.opening, DOOR)]);
            }
            let predicate = match leafed.map(|d| d.state.status) {
                Some(DoorStatus::Locked) => predicate::DOOR_LOCKED,
                _ if of_lift => continue,
                None | Some(DoorStatus::Open) => predicate::DOOR_OPEN,
                Some(DoorStatus::Closed) => predicate::DOOR_CLOSED,
            };
            let arguments =
                [(join.opening.as_str(), DOOR), (from.as_str(), ROOM), (to.as_str(), ROOM)];
            self.insert(predicate, &arguments, true);
        }
    }

    /// Rooms of storeys, where there is more than one; in a cabin one is on none.
    fn storeys(&mut self, lifts: &[Lift]) {
        if self.world.maps.len() < 2 {
            return;
        }
        let cabins: BTreeSet<AreaId> =
            lifts.iter().flat_map(|lift| lift.cabins.iter().copied()).gather();
        for (area, (map, _)) in self.world.placements() {
            if !cabins.contains(&area) {
                let (room, storey) = (self.area(area), storey_name(self.world, map));
                self.fact(predicate::ROOM_ON_STOREY, &[(&room, ROOM), (&storey, STOREY)]);
            }
        }
    }

    fn lifts(&mut self, lifts: &[Lift], robot: AreaId) {
        for lift in lifts {
            let name = (lift.name.as_str(), LIFT);
            for &cabin in &lift.cabins {
                let cabin = self.area(cabin);
                self.fact(predicate::LIFT_HAS_CABIN, &[name, (&cabin, ROOM)]);
            }
            for join in &lift.doors {
                self.fact(predicate::LIFT_HAS_DOOR, &[name, (&join.opening, DOOR)]);
            }
            self.insert(predicate::LIFT_WORKS, &[name], true);
            if let Some(join) = lift.cabin_unseen(self.world, robot) {
                self.insert(predicate::CABIN_AT, &[name, (&join.opening, DOOR)], true);
            }
        }
    }

    fn named_places(&mut self) {
        for place in self.world.places.values() {
            let name = self.relations.symbols().place(place.id).to_string();
            self.place(name, place.area, PlaceSource::Named(place.id));
        }
    }

    fn place(&mut self, name: String, area: AreaId, source: PlaceSource) {
        let room = self.area(area);
        self.fact(predicate::PLACE_IN, &[(&name, PLACE), (&room, ROOM)]);
        self.places.insert(name, (area, source));
    }

    /// Light is an assumption where the Map does not say that it is dark; there the lamps make it.
    fn light(&mut self) {
        for (id, area) in &self.world.areas {
            let room = self.area(*id);
            let is_lamp = |lamp: &ReplicaId| {
                self.world.has_trait(*lamp, "light")
                    && self.world.has_trait(*lamp, "device")
                    && self.relations.area_of(*lamp) == Some(*id)
            };
            let all = self.world.replicas.keys().copied();
            let lamps: Vec<ReplicaId> =
                if is_dark(&area.properties) { all.filter(is_lamp).collect() } else { Vec::new() };
            let shines =
                |lamp: &ReplicaId| is_on(&self.world.replicas[lamp].properties) == Some(true);
            if !is_dark(&area.properties) || lamps.iter().any(shines) {
                self.insert(predicate::ROOM_LIT, &[(&room, ROOM)], true);
            }
            for lamp in lamps {
                let name = self.relations.symbols().replica(lamp).to_string();
                let kind = if self.world.has_trait(lamp, "portable") { ITEM } else { OBJECT };
                self.fact(predicate::SWITCH_OF_LIGHT, &[(&name, kind), (&room, ROOM)]);
            }
        }
    }

    /// A device and its state; where it is reached from, of one that can be carried.
    fn device(&mut self, id: ReplicaId, name: &str, root: ReplicaId, area: AreaId) {
        let is_portable = self.world.has_trait(id, "portable");
        let kind = if is_portable { ITEM } else { OBJECT };
        self.fact(predicate::DEVICE_HAS_BUTTON, &[(name, kind)]);
        match is_on(&self.world.replicas[&id].properties) {
            Some(true) => self.fact(predicate::DEVICE_ON, &[(name, kind)]),
            Some(false) => self.fact(predicate::DEVICE_OFF, &[(name, kind)]),
            None => {}
        }
        if is_portable {
            for place in self.places_of(root, self.relations.area_of(root).unwrap_or(area)) {
                self.fact(predicate::PLACE_BY, &[(&place, PLACE), (name, kind)]);
            }
        }
    }

    /// Places by things, things on things, things on the floor, keys, people.
    fn things(&mut self, held: Option<ReplicaId>) {
        for (&id, replica) in &self.world.replicas {
            if held == Some(id) {
                continue;
            }
            let Some(area) = self.relations.area_of(id) else { continue };
            let name = self.relations.symbols().replica(id).to_string();
            let chain = self.supports(id);
            let root = chain.last().copied().unwrap_or(id);
            if self.world.has_trait(id, "person") {
                for place in self.places_of(root, area) {
                    self.fact(predicate::PERSON_AT_PLACE, &[(&name, PERSON), (&place, PLACE)]);
                }
            } else if self.world.has_trait(id, "portable") {
                self.portable(id, &name, &chain, root, area);
                if self.is_bearer(id) {
                    for place in self.places_of(root, self.relations.area_of(root).unwrap_or(area))
                    {
                        self.fact(predicate::PLACE_BY, &[(&place, PLACE), (&name, ITEM)]);
                    }
                }
            } else {
                for place in self.places_of(root, self.relations.area_of(root).unwrap_or(area)) {
                    self.fact(predicate::PLACE_BY, &[(&place, PLACE), (&name, OBJECT)]);
                }
            }
            if self.world.has_trait(id, "device") {
                self.device(id, &name, root, area);
            }
            if let Some(status) = stands(self.world, replica).filter(|_| self.world.robot.opens) {
                let kind = if self.world.has_trait(id, "portable") { ITEM } else { OBJECT };
                match status {
                    DoorStatus::Open => self.fact(predicate::STANDS_OPEN, &[(&name, kind)]),
                    DoorStatus::Closed => self.fact(predicate::STANDS_SHUT, &[(&name, kind)]),
                    // It has no key to furniture.
                    DoorStatus::Locked => {}
                }
            }
            if let Some((_, door)) = Mark::KeyOf.of(&replica.properties) {
                let known = self.world.find(door).into_iter().find_map(|entity| match entity {
                    Entity::Door(id) => Some(self.relations.symbols().door(id).to_string()),
                    _ => None,
                });
                let door = known.unwrap_or_else(|| door.to_owned());
                self.fact(predicate::KEY_FITS, &[(&name, ITEM), (&door, DOOR)]);
            }
        }
    }

    fn portable(
        &mut self,
        id: ReplicaId,
        name: &str,
        chain: &[ReplicaId],
        root: ReplicaId,
        area: AreaId,
    ) {
        // Behind doors that are shut nothing can be taken, before they are opened.
        if self.shut.contains(&id) {
            if let Some(around) = self.relations.shut_in(id).filter(|_| self.world.robot.opens) {
                let on = self.relations.symbols().replica(around).to_string();
                let kind = if self.world.has_trait(around, "portable") { ITEM } else { OBJECT };
                self.fact(predicate::THING_IN, &[(name, ITEM), (&on, kind)]);
            }
            return;
        }
        // In a box is in the box, and on a tray is on the tray: what is in it or on it goes with it. On a pile of books
        // on the table is on the table.
        let bears = |s: &&ReplicaId| !self.world.has_trait(**s, "portable") || self.is_bearer(**s);
        match chain.iter().find(bears) {
            Some(&support) => {
                let on = self.relations.symbols().replica(support).to_string();
                let kind = if self.world.has_trait(support, "portable") { ITEM } else { OBJECT };
                self.fact(predicate::THING_ON, &[(name, ITEM), (&on, kind)]);
                let opens =
                    |s: &&Replica| self.world.robot.opens && stands(self.world, s).is_some();
                if self.world.replicas.get(&support).filter(opens).is_some()
                    && self.relations.is_inside(id, support)
                {
                    self.fact(predicate::THING_IN, &[(name, ITEM), (&on, kind)]);
                }
            }
            None => {
                for place in self.places_of(root, area) {
                    self.fact(predicate::THING_AT_PLACE, &[(name, ITEM), (&place, PLACE)]);
                }
            }
        }
    }

    /// Whether it is made to have things in or on it, which go with it where it is carried.
    fn is_bearer(&self, id: ReplicaId) -> bool {
        ["container", "support"].iter().any(|made| self.world.has_trait(id, made))
    }

    /// What a thing stands on or lies in, from below it down to what stands on the floor or hangs by itself.
    fn supports(&self, id: ReplicaId) -> Vec<ReplicaId> {
        let mut chain = Vec::new();
        let mut at = id;
        while let Some(next) = self.relations.support_of(at)
            // The bottom of a box on the floor is nearly the floor.
            && (!self.on_floor(at) || self.is_bearer(next))
            && next != id
            && !chain.contains(&next)
        {
            chain.push(next);
            at = next;
        }
        chain
    }

    fn on_floor(&self, id: ReplicaId) -> bool {
        let area = self.relations.measurements().of_thing(id).and_then(Single::area);
        area.is_some_and(|area| self.relations.stands_on_floor(id, area))
    }

    /// The places that serve a thing, or the one before it.
    fn places_of(&mut self, root: ReplicaId, area: AreaId) -> Vec<String> {
        let serving: Vec<String> = self
            .world
            .places
            .values()
            .filter(|p| p.serves == Some(root))
            .map(|p| self.relations.symbols().place(p.id).to_string())
            .collect();
        if !serving.is_empty() {
            return serving;
        }
        let thing = self.relations.symbols().replica(root);
        // What can be carried is no place by its own name: a name has one type in a rule file.
        let name = if self.world.has_trait(root, "portable") || self.world.has_trait(root, "person")
        {
            format!("{PLACE_BESIDE}{thing}")
        } else {
            thing.to_string()
        };
        if !self.places.contains_key(&name) {
            self.place(name.clone(), area, PlaceSource::Before(root));
        }
        vec![name]
    }

    fn robot(&mut self, state: &RobotState) {
        let room = self.area(state.area);
        self.fact(predicate::ROBOT_IN, &[(&room, ROOM)]);
        match &state.at {
            RobotAt::Door(door) => self.fact(predicate::ROBOT_AT_DOOR, &[(door, DOOR)]),
            RobotAt::Place(id) => {
                let name = self.relations.symbols().place(*id).to_string();
                self.fact(predicate::ROBOT_AT_PLACE, &[(&name, PLACE)]);
            }
            RobotAt::Before(id) => {
                for name in self.places_of(*id, state.area).into_iter().take(1) {
                    self.fact(predicate::ROBOT_AT_PLACE, &[(&name, PLACE)]);
                }
            }
            RobotAt::Elsewhere => {
                self.place(ROBOT_PLACE.to_owned(), state.area, PlaceSource::Robot);
                self.fact(predicate::ROBOT_AT_PLACE, &[(ROBOT_PLACE, PLACE)]);
            }
        }
        match state.holds {
            Some(id) => {
                let name = self.relations.symbols().replica(id).to_string();
                self.fact(predicate::ROBOT_HOLDS, &[(&name, ITEM)]);
            }
            None => self.fact(predicate::HAND_FREE, &[]),
        }
    }

    fn area(&self, id: AreaId) -> String {
        self.relations.symbols().area(id).to_string()
    }
}
