//! What a mission holds to be so: the Map, corrected by what was seen, and where the robot and its load are.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{Bounds, DoorStates, FloorPlan, Scene};
use crate::map::{DoorState, DoorStatus, Entity, Mark, Replica, World, set_open, switch};
use crate::semantics::planning::{self, Argument, InitialFact, PlanPlace, RobotAt, RobotState};
use crate::semantics::{
    Relations, Told, carried_to, lifts, predicate, robot_eye, storey_name, things_in_view,
};
use crate::units::{
    AreaId, Deg, DoorId, Frame, Gather as _, MapId, Point, Pose, ReplicaId, Vector, name_key,
};

mod lost;
mod unknown;
mod views;

use super::vehicle::Sighting;

/// Where the robot is, as the rules speak of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Station {
    /// A named place, or the place before a thing: whatever a rule file calls «место».
    Place(String),
    /// At a door, inside the Area in which the robot is.
    Door(String),
}

/// A point that was given a name for the time of a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    pub name: String,
    pub area: AreaId,
    pub pose: Pose,
    /// Whether the heading is part of it.
    pub looks: bool,
}

/// A person to whom things can be handed, and the place from which it is done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Person {
    pub name: String,
    pub name_en: String,
    pub place: String,
}

/// The name of the point where a mission began, if the Map has none for it.
pub const STARTING_POINT: &str = "Исходная-точка";
/// What the name of a point in the middle of an Area begins with; the Area's follows.
pub const IN_MIDDLE: &str = "Место-посреди-";
/// A robot this near to a named place stands at it, cm: as near to its goal as the protocol has a vehicle end (see
/// docs/vehicle.md), so that what was driven to is reached.
pub(super) const AT_PLACE: f64 = 15.0;

/// A thing that a push brings out of a way.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct InTheWay {
    pub(super) thing: ReplicaId,
    /// In the Map's frame, cm.
    pub(super) by: Vector,
    /// The door, and the Area in which the way to it is barred.
    pub(super) door: String,
    pub(super) area: AreaId,
    /// What was given up for it.
    pub(super) way: (AreaId, String),
}

/// A thing that may be gone, and where it was held to stand.
#[derive(Debug, Clone)]
struct Lost {
    thing: Replica,
    stood: Option<Bounds>,
}

/// What the mission holds to be so.
#[derive(Debug, Clone)]
pub struct Belief {
    /// A thing in the hand or given to a person is not in it.
    pub world: World,
    pub map: MapId,
    pub area: AreaId,
    pub pose: Pose,
    pub station: Station,
    pub held: Option<Replica>,
    pub handed_over: Vec<(Replica, String)>,
    /// What lies on or in things that are held or were handed over, each with the thing with which it goes.
    pub aboard: Vec<(Replica, ReplicaId)>,
    pub people: Vec<Person>,
    pub spots: Vec<Spot>,
    /// Places and doors that proved to have no way to them from within an Area.
    pub unreachable: Vec<(AreaId, String)>,
    /// What is to be pushed out of the way, and what proved not to be.
    pub(super) pushes: Vec<InTheWay>,
    pub(super) stays: BTreeSet<ReplicaId>,
    /// Unknown things that were met, seen or only felt, and whether one whose outline was not seen bars one of these ways.
    unknown: Vec<ReplicaId>,
    felt: Vec<ReplicaId>,
    is_barred: bool,
    /// Things that may be gone.
    lost: BTreeMap<ReplicaId, Lost>,
    /// Doors that could not be opened again from within an Area once they are shut.
    pub no_return: Vec<(AreaId, String)>,
    /// What is to be found, with the Areas where it proved not to be.
    pub sought: BTreeMap<String, BTreeSet<AreaId>>,
    /// Of these what was seen so long ago, for how often such a thing is moved, that its last place is hardly surer than
    /// others where its kind lies.
    pub adrift: BTreeSet<String>,
    /// Of these what is looked for everywhere, since no way leads to where it is likely.
    wide: BTreeSet<String>,
    /// What is or was in view since the mission began, or known to be in a hand.
    pub found: BTreeSet<String>,
    /// What was not where it is believed to be, and was not seen since.
    missing: BTreeSet<ReplicaId>,
    /// Where things belong: by the names of a thing and of its support.
    pub homes: Vec<(String, String)>,
    /// What proved to have no place on something: the names of both.
    pub(super) no_room: BTreeSet<(String, String)>,
    /// What things are thrown into, by name.
    pub bins: BTreeSet<String>,
    /// What is to be put into another thing, not onto it: by the names of both.
    pub into: BTreeSet<(String, String)>,
    /// What is to be put beside another thing: by the names of both.
    pub beside: BTreeSet<(String, String)>,
    /// The door at which the cabin of a lift stands, by the names of both; none where it was not seen.
    pub cabins: BTreeMap<String, String>,
    /// Of the robot's Map, and of those to which lifts lead.
    floors: BTreeMap<MapId, FloorPlan>,
}

impl Belief {
    /// What the Map says, with the robot at a pose of one of the floors. `None` when the pose lies in no Area.
    #[must_use]
    pub fn new(
        world: World,
        floors: BTreeMap<MapId, FloorPlan>,
        map: MapId,
        pose: Pose,
    ) -> Option<Self> {
        let floor = floors.get(&map)?;
        let (area, _) = floor.locate(pose.at)?;
        let frame = floor.scene().areas.get(&area)?.frame;
        let near = |at: Point| (frame.apply(at) - pose.at).norm() <= AT_PLACE;
        let place =
            world.places.values().find(|p| p.area == area && near(p.at)).map(|p| p.name.clone());
        let mut spots = Vec::new();
        let place = place.unwrap_or_else(|| {
            spots.push(Spot { name: STARTING_POINT.to_owned(), area, pose, looks: false });
            STARTING_POINT.to_owned()
        });
        Some(Self {
            world,
            map,
            area,
            pose,
            station: Station::Place(place),
            held: None,
            handed_over: Vec::new(),
            aboard: Vec::new(),
            people: Vec::new(),
            spots,
            unreachable: Vec::new(),
            pushes: Vec::new(),
            stays: BTreeSet::new(),
            unknown: Vec::new(),
            felt: Vec::new(),
            is_barred: false,
            lost: BTreeMap::new(),
            no_return: Vec::new(),
            sought: BTreeMap::new(),
            adrift: BTreeSet::new(),
            wide: BTreeSet::new(),
            found: BTreeSet::new(),
            missing: BTreeSet::new(),
            homes: Vec::new(),
            no_room: BTreeSet::new(),
            bins: BTreeSet::new(),
            into: BTreeSet::new(),
            beside: BTreeSet::new(),
            cabins: BTreeMap::new(),
            floors,
        })
    }

    /// The name of a point of an Area for the time of the mission; that of its own place where the robot stands there.
    pub fn name_point(&mut self, name: String, area: AreaId, at: Point) -> String {
        if let Station::Place(here) = &self.station
            && area == self.area
            && (at - self.pose.at).norm() <= AT_PLACE
        {
            return here.clone();
        }
        if !self.spots.iter().any(|spot| spot.name == name) {
            let pose = Pose { at, ..self.pose };
            self.spots.push(Spot { name: name.clone(), area, pose, looks: false });
        }
        name
    }

    /// The name of a point at which the robot looks in a direction; another than that of the place where it stands,
    /// since there it may look elsewhere.
    pub fn name_view(&mut self, name: String, area: AreaId, at: Point, heading: Deg) -> String {
        self.spots.retain(|spot| spot.name != name);
        self.spots.push(Spot { name: name.clone(), area, pose: Pose { at, heading }, looks: true });
        name
    }

    /// The free floor of the Map on which the robot is.
    #[must_use]
    pub fn floor(&self) -> &FloorPlan {
        &self.floors[&self.map]
    }

    pub(super) fn floors(&self) -> &BTreeMap<MapId, FloorPlan> {
        &self.floors
    }

    /// That of another Map; none where no lift leads.
    pub(super) fn floor_of(&self, map: MapId) -> Option<&FloorPlan> {
        self.floors.get(&map)
    }

    fn rebuild(&mut self, things: &[ReplicaId]) {
        let floor = self.floors.get_mut(&self.map).expect("the robot stands on a floor");
        floor.rebuild(&self.world, things);
    }

    /// The initial position of a planning problem, and the places that it speaks of.
    /// What is known beside the world, for rules that ask for it; of where things are believed to be a mission learns
    /// nothing that is not in its world.
    #[must_use]
    pub fn told(&self, relations: &Relations, believed: Vec<(ReplicaId, AreaId, f64)>) -> Told {
        let in_view = match self.floors.get(&self.map) {
            Some(floor) if relations.rules().asks_for_view() => {
                let near = relations.thresholds();
                let eye = robot_eye(&self.world, floor, self.pose, near);
                things_in_view(&self.world, floor, &eye, near)
            }
            _ => Vec::new(),
        };
        let carried = self.carried().into_iter().collect();
        Told { robot: Some((self.map, self.pose)), in_view, believed, carried }
    }

    /// What was taken off the map, and who has it; an empty name for the robot itself.
    #[must_use]
    pub fn carried(&self) -> BTreeMap<ReplicaId, String> {
        let mut carried: BTreeMap<ReplicaId, String> =
            self.handed_over.iter().map(|(thing, to)| (thing.id, to.clone())).gather();
        carried.extend(self.held.iter().map(|thing| (thing.id, String::new())));
        for (thing, carrier) in &self.aboard {
            carried.insert(thing.id, carried.get(carrier).cloned().unwrap_or_default());
        }
        carried
    }

    pub(super) fn initial(&self, relations: &Relations) -> (Vec<InitialFact>, Vec<PlanPlace>) {
        // The state of the robot is told below: its spots and its load are not in the Map.
        let state = RobotState { area: self.area, at: RobotAt::Elsewhere, holds: None };
        let initial = planning::initial(&self.world, relations, &state);
        let is_seen = |f: &InitialFact| {
            is(f, predicate::CABIN_AT) && self.cabins.contains_key(&f.arguments[0].name)
        };
        let of_map = initial
            .facts
            .into_iter()
            .filter(|f| !speaks_of_robot(f) && !self.is_refuted(f) && !is_seen(f));
        let of_map: Vec<InitialFact> = of_map.collect();
        let lies = |f: &&InitialFact| is(f, predicate::THING_ON) || is(f, predicate::THING_IN);
        let in_bin =
            of_map.iter().filter(lies).filter(|f| self.bins.contains(&f.arguments[1].name));
        let thrown =
            in_bin.map(|f| fact(predicate::THROWN_AWAY, &[(&f.arguments[0].name, "предмет")]));
        let thrown: Vec<InitialFact> = thrown.collect();
        let known = self.of_robot().into_iter().chain(self.on_storey(relations));
        (of_map.into_iter().chain(thrown).chain(known).collect(), initial.places)
    }

    /// The facts that a plan begins with, given the relations of the believed world.
    #[must_use]
    pub fn facts(&self, relations: &Relations) -> Vec<InitialFact> {
        self.initial(relations).0
    }

    /// The storey on which the robot is, unless it is in the cabin of a lift, and where cabins were seen.
    fn on_storey(&self, relations: &Relations) -> Vec<InitialFact> {
        let mut all = Vec::new();
        if !lifts(&self.world, relations).iter().any(|lift| lift.cabins.contains(&self.area)) {
            let storey = storey_name(&self.world, self.map);
            all.push(fact(predicate::ROBOT_ON_STOREY, &[(&storey, "этаж")]));
        }
        for (lift, door) in &self.cabins {
            let args = [(lift.as_str(), "лифт"), (door.as_str(), "дверь")];
            all.push(InitialFact { assumed: true, ..fact(predicate::CABIN_AT, &args) });
        }
        all
    }

    /// The robot, its hand, people, and spots.
    fn of_robot(&self) -> Vec<InitialFact> {
        let area = self.world.name(Entity::Area(self.area));
        let mut all = vec![fact(predicate::ROBOT_IN, &[(area, "помещение")])];
        all.push(match &self.station {
            Station::Place(name) => fact(predicate::ROBOT_AT_PLACE, &[(name, "место")]),
            Station::Door(name) => fact(predicate::ROBOT_AT_DOOR, &[(name, "дверь")]),
        });
        all.push(match &self.held {
            Some(thing) => fact(predicate::ROBOT_HOLDS, &[(&thing.name, "предмет")]),
            None => fact(predicate::HAND_FREE, &[]),
        });
        // What is in no place of the map is still a key.
        let away = self.held.iter().chain(self.handed_over.iter().map(|(thing, _)| thing));
        for thing in away.chain(self.aboard.iter().map(|(thing, _)| thing)) {
            if let Some((_, door)) = Mark::KeyOf.of(&thing.properties) {
                let door = self.entity(door, |e| matches!(e, Entity::Door(_)).then_some(e));
                let door = door.map(|e| self.world.name(e));
                let args = |door| [(thing.name.as_str(), "предмет"), (door, "дверь")];
                all.extend(door.map(|door| fact(predicate::KEY_FITS, &args(door))));
            }
        }
        let stands = self.spots.iter().map(|spot| self.fact_of(spot));
        all.extend(stands.filter(|fact| !self.is_refuted(fact)));
        for person in &self.people {
            let args = [(person.name.as_str(), "человек"), (person.place.as_str(), "место")];
            all.push(fact(predicate::PERSON_AT_PLACE, &args));
            for door in self.doors_of(person) {
                let args = [(person.name.as_str(), "человек"), (door, "дверь")];
                all.push(fact(predicate::PERSON_HAS_KEY, &args));
            }
        }
        for (area, door) in &self.no_return {
            let args =
                [(door.as_str(), "дверь"), (self.world.name(Entity::Area(*area)), "помещение")];
            all.push(fact(predicate::NO_RETURN, &args));
        }
        for InTheWay { thing, door, area, .. } in &self.pushes {
            let name = self.world.name(Entity::Replica(*thing));
            let room = (self.world.name(Entity::Area(*area)), "помещение");
            let (thing, door) = ((name, "объект"), (door.as_str(), "дверь"));
            all.push(fact(predicate::LIGHT, &[thing]));
            all.push(fact(predicate::BLOCKS_DOOR, &[thing, door, room]));
            all.push(fact(predicate::WAY_BLOCKED, &[door, room]));
        }
        for (thing, home) in &self.homes {
            let args = [(thing.as_str(), "предмет"), (home.as_str(), "объект")];
            all.push(fact(predicate::STORED_ON, &args));
        }
        for (thing, support) in &self.no_room {
            let args = [(thing.as_str(), "предмет"), (support.as_str(), "объект")];
            all.push(fact(predicate::NO_ROOM, &args));
        }
        for bin in &self.bins {
            all.push(fact(predicate::FOR_WASTE, &[(bin, "объект")]));
        }
        for (thing, searched) in &self.sought {
            for area in self.where_may_be(thing, searched) {
                let area = self.world.name(Entity::Area(area));
                let args = [(thing.as_str(), "объект"), (area, "помещение")];
                all.push(InitialFact { assumed: true, ..fact(predicate::MAY_BE_IN, &args) });
            }
        }
        for thing in &self.found {
            all.push(fact(predicate::FOUND, &[(thing, "объект")]));
        }
        for (thing, person) in &self.handed_over {
            let args = [(thing.name.as_str(), "предмет"), (person.as_str(), "человек")];
            all.push(fact(predicate::HANDED_OVER, &args));
            // The person gives it back to who asks for it there.
            if let Some(person) = self.people.iter().find(|p| p.name == *person) {
                let args = [(thing.name.as_str(), "предмет"), (person.place.as_str(), "место")];
                all.push(fact(predicate::THING_AT_PLACE, &args));
            }
        }
        all
    }

    fn fact_of(&self, spot: &Spot) -> InitialFact {
        let area = self.world.name(Entity::Area(spot.area));
        fact(predicate::PLACE_IN, &[(&spot.name, "место"), (area, "помещение")])
    }

    /// The doors to which a person has the key, by the Map.
    fn doors_of<'b>(&'b self, person: &Person) -> impl Iterator<Item = &'b str> {
        let names = [name_key(&person.name), name_key(&person.name_en)];
        let doors = self.world.doors.iter().filter(move |(_, door)| {
            let holder = Mark::KeyWith.of(&door.properties);
            holder.is_some_and(|(_, holder)| names.contains(&name_key(holder)))
        });
        doors.map(|(id, _)| self.world.name(Entity::Door(*id)))
    }

    /// Where a thing is believed to be, and of what is adrift also the Areas where things of its kind lie; once it proved not
    /// to be there, these Areas; then every Area. Of these those not yet searched.
    fn where_may_be(&self, thing: &str, searched: &BTreeSet<AreaId>) -> Vec<AreaId> {
        let replica = |e| if let Entity::Replica(id) = e { Some(id) } else { None };
        let believed = self.entity(thing, replica).and_then(|id| self.world.replicas.get(&id));
        match believed.map(|r| r.area) {
            Some(area) if !searched.contains(&area) => {
                let kin = match self.adrift.contains(thing) {
                    true => self.where_else(thing, searched),
                    false => (Vec::new(), false),
                };
                let kin = kin.0.into_iter().filter(|other| kin.1 && *other != area);
                std::iter::once(area).chain(kin).collect()
            }
            _ => self.where_else(thing, searched).0,
        }
    }

    /// Where a thing may be that is not where it was believed to be: the Areas, not yet searched, where others of its kind
    /// lie, and that it is for these; else all that are left.
    pub(super) fn where_else(
        &self,
        thing: &str,
        searched: &BTreeSet<AreaId>,
    ) -> (Vec<AreaId>, bool) {
        let replica = |e| if let Entity::Replica(id) = e { Some(id) } else { None };
        let sought = self.entity(thing, replica).and_then(|id| self.world.replicas.get(&id));
        let left = || self.world.areas.keys().copied().filter(|area| !searched.contains(area));
        let kind = |other: &Replica| self.world.objects.get(&other.object)?.object_type;
        let is_kin = |one: &Replica, other: &Replica| {
            one.id != other.id
                && (one.object == other.object || kind(one).is_some() && kind(one) == kind(other))
        };
        let has_kin = |area: AreaId| {
            let mut here = self.world.replicas.values().filter(|other| other.area == area);
            sought.is_some_and(|one| here.any(|other| is_kin(one, other)))
        };
        let likely: Vec<AreaId> = match self.wide.contains(thing) {
            true => Vec::new(),
            false => left().filter(|area| has_kin(*area)).collect(),
        };
        if likely.is_empty() { (left().collect(), false) } else { (likely, true) }
    }

    /// No way leads to where a thing is likely: it may be elsewhere. Whether that was not thought of before.
    pub(super) fn widen_search(&mut self) -> bool {
        let lost = self.sought.iter().filter(|(thing, searched)| {
            !searched.is_empty() && !self.found.contains(*thing) && !self.wide.contains(*thing)
        });
        let lost: Vec<String> = lost.map(|(thing, _)| thing.clone()).collect();
        self.wide.extend(lost.iter().cloned());
        !lost.is_empty()
    }

    /// Notes that a thing is not in an Area; whether it was news.
    pub(super) fn searched(&mut self, thing: &str, area: AreaId) -> bool {
        let replica = |e| if let Entity::Replica(id) = e { Some(id) } else { None };
        let believed = self.entity(thing, replica).and_then(|id| self.world.replicas.get(&id));
        if let Some(id) = believed.filter(|one| one.area == area).map(|one| one.id) {
            self.miss(id);
        }
        self.sought.entry(thing.to_owned()).or_default().insert(area)
    }

    /// Notes that a thing is not where it is believed to be, and that nobody knows where it is; whether it was news.
    pub(super) fn miss(&mut self, thing: ReplicaId) -> bool {
        let Some(replica) = self.world.replicas.get(&thing) else { return false };
        self.found.remove(&replica.name);
        self.missing.insert(thing)
    }

    /// What was not where it is believed to be, and was not seen since.
    #[must_use]
    pub fn missing(&self) -> &BTreeSet<ReplicaId> {
        &self.missing
    }

    /// Notes that from within this Area no way leads to a place or through a door; whether it was news.
    pub(super) fn no_way_to(&mut self, name: String) -> bool {
        let refuted = (self.area, name);
        let news = !self.unreachable.contains(&refuted);
        self.unreachable.push(refuted);
        news
    }

    /// Notes that a thing is not to be pushed; whether it was news.
    pub(super) fn stays(&mut self, thing: ReplicaId) -> bool {
        for one in self.pushes.extract_if(.., |one| one.thing == thing) {
            self.unreachable.push(one.way);
        }
        self.stays.insert(thing)
    }

    /// Notes that a door could not be opened again from within an Area; whether it was news.
    pub(super) fn no_return_by(&mut self, area: AreaId, door: String) -> bool {
        let news = !self.no_return.contains(&(area, door.clone()));
        self.no_return.push((area, door));
        news
    }

    pub(super) fn switch(&mut self, device: ReplicaId, on: bool) {
        if let Some(replica) = self.world.replicas.get_mut(&device) {
            switch(&mut replica.properties, on);
        }
    }

    pub(super) fn set_open(&mut self, thing: ReplicaId, open: bool) {
        let Some(replica) = self.world.replicas.get_mut(&thing) else { return };
        if let Some(object) = self.world.objects.get(&replica.object) {
            set_open(replica, object, open);
        }
        self.rebuild(&[thing]);
    }

    /// Whether a fact of the Map speaks of a way that proved not to be there.
    fn is_refuted(&self, fact: &InitialFact) -> bool {
        let is_way = [predicate::PLACE_IN, predicate::DOOR_IN].iter().any(|p| is(fact, p));
        is_way
            && self.unreachable.iter().any(|(area, name)| {
                fact.arguments[0].name == *name
                    && fact.arguments[1].name == self.world.name(Entity::Area(*area))
            })
    }

    /// Takes over what was seen; whether it was news.
    pub(super) fn learn(&mut self, sighting: Sighting) -> bool {
        match sighting {
            Sighting::Door { door, state } => {
                // Shut where the cabin of a lift was to stand: it is not there.
                let name = self.world.doors.get(&door).map(|d| d.name.as_str());
                let cabins = self.cabins.len();
                if state.status != DoorStatus::Open {
                    self.cabins.retain(|_, at| Some(at.as_str()) != name);
                }
                let left = self.cabins.len() < cabins;
                self.set_door(door, state) || left
            }
            Sighting::Replica { replica, area, frame } => {
                self.missing.remove(&replica);
                let Some(believed) = self.world.replicas.get_mut(&replica) else {
                    return self.regain(replica, area, frame);
                };
                if (believed.area, believed.frame) == (area, frame) {
                    return false;
                }
                (believed.area, believed.frame) = (area, frame);
                self.rebuild(&[replica]);
                true
            }
        }
    }

    pub(super) fn set_door(&mut self, door: DoorId, state: DoorState) -> bool {
        let Some(before) = self.world.doors.get(&door).map(|d| d.state) else { return false };
        if before == state {
            return false;
        }
        for floor in self.floors.values_mut() {
            if floor.doorways_of(door).next().is_some() {
                *floor = floor.with_doors(&self.world, &DoorStates::from([(door, state)]));
            }
        }
        self.world.doors.get_mut(&door).expect("found above").state = state;
        true
    }

    /// A thing stands where it was pushed to, and what lies on it and in it goes with it.
    pub(super) fn pushed(&mut self, thing: ReplicaId, to: Frame, with: &BTreeSet<ReplicaId>) {
        let Some(before) = self.world.replicas.get(&thing).cloned() else { return };
        let mut changed = vec![thing];
        for id in with {
            let Some(carried) = self.world.replicas.get(id).cloned() else { continue };
            let frame = frame_aboard(&self.world, &before, &carried, &to);
            let area = before.area;
            self.world.replicas.insert(*id, Replica { area, frame, ..carried });
            changed.push(*id);
        }
        self.world.replicas.insert(thing, Replica { frame: to, ..before });
        self.pushes.retain(|one| one.thing != thing);
        self.rebuild(&changed);
    }

    /// Takes a thing off the floor and into the hand, and with it what lies on it and in it.
    pub(super) fn pick_up(&mut self, thing: ReplicaId, with: &BTreeSet<ReplicaId>) {
        let Some(replica) = self.world.replicas.remove(&thing) else { return };
        self.held = Some(replica);
        let mut changed = vec![thing];
        for id in with {
            if let Some(replica) = self.world.replicas.remove(id) {
                self.aboard.push((replica, thing));
                changed.push(*id);
            }
        }
        self.rebuild(&changed);
    }

    /// Puts the thing in the hand down at a frame of an Area, and with it what lies on it and in it.
    pub(super) fn set_down(&mut self, area: AreaId, frame: Frame) {
        let Some(replica) = self.held.take() else { return };
        let id = replica.id;
        let mut changed = vec![id];
        for (thing, _) in self.aboard.extract_if(.., |(_, carrier)| *carrier == id) {
            changed.push(thing.id);
            let frame = frame_aboard(&self.world, &replica, &thing, &frame);
            self.world.replicas.insert(thing.id, Replica { area, frame, ..thing });
        }
        self.world.replicas.insert(id, Replica { area, frame, ..replica });
        self.rebuild(&changed);
    }

    pub(super) fn scene(&self) -> &Scene {
        self.floor().scene()
    }

    pub(super) fn entity<T>(&self, name: &str, pick: impl Fn(Entity) -> Option<T>) -> Option<T> {
        self.world.find(name).into_iter().find_map(pick)
    }
}

/// Where a thing lies, in the frame of an Area, once its carrier lies there at a frame: both were taken up together.
pub(super) fn frame_aboard(world: &World, carrier: &Replica, thing: &Replica, to: &Frame) -> Frame {
    let home = |area| world.placement(area).map_or(Frame::IDENTITY, |(_, frame)| frame);
    let (from, own) = (home(carrier.area), home(thing.area));
    carried_to((&carrier.frame, &from), (&thing.frame, &own), to)
}

/// What the Map knows for a plan, the robot left out.
#[must_use]
pub fn facts_of_map(world: &World, relations: &Relations) -> Vec<InitialFact> {
    let Some(&area) = world.areas.keys().next() else { return Vec::new() };
    let state = RobotState { area, at: RobotAt::Elsewhere, holds: None };
    let initial = planning::initial(world, relations, &state);
    initial.facts.into_iter().filter(|f| !speaks_of_robot(f)).collect()
}

fn fact(predicate: &'static str, arguments: &[(&str, &'static str)]) -> InitialFact {
    let argument = |&(name, kind): &(&str, &'static str)| Argument { name: name.to_owned(), kind };
    InitialFact { predicate, arguments: arguments.iter().map(argument).collect(), assumed: false }
}

fn is(fact: &InitialFact, predicate: &str) -> bool {
    fact.predicate == predicate
}

fn speaks_of_robot(fact: &InitialFact) -> bool {
    let of_robot = [
        predicate::ROBOT_IN,
        predicate::ROBOT_AT_PLACE,
        predicate::ROBOT_AT_DOOR,
        predicate::HAND_FREE,
    ];
    of_robot.iter().any(|p| is(fact, p))
        || fact.arguments.iter().any(|a| a.name == planning::ROBOT_PLACE)
}
