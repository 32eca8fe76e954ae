//! How long a directive takes, by the floor as it is known: the true way at the robot's speed, its turns, doors, rides of
//! lifts with their waits, and what the hand does. A plan by driven time is chosen by it.
//!
//! A *stand* is where the robot stands at a place, or before a door on one side of it: the end of a way that comes from the
//! middle of the room, or of each of the pieces of floor into which things cut it. Each directive is timed from stand to
//! stand, so that what it takes does not depend on what came before. Where a room cannot be crossed as its doors stand, it
//! is asked for with all doors open, and with all of them shut: a plan may set them.
//!
//! **Invariant**: what has no way has none however doors are set, furniture shut and light things taken away; so a plan
//! loses nothing by it.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::rc::Rc;

use crate::geometry::{Blocker, DoorStates, FloorPlan, LIFT_WAIT, Method, Ride, Target};
use crate::map::{DoorState, DoorStatus, Replica, World, set_open, stands};
use crate::semantics::planning::{self, RobotAt, RobotState};
use crate::semantics::{Lift, Relations, lifts, predicate};
use crate::strips::{Domain, OperatorId, Task};
use crate::units::{AreaId, Deg, DoorId, Gather as _, MapId, Point, Pose, ReplicaId, name_key};

use super::atlas::{At, Atlas, Unknown};
use super::belief::Spot;
use super::directive::{Directive, Primitive};

/// Seconds to press a button.
pub(super) const SWITCH_TIME: f64 = 3.0;
/// Seconds to call a person.
pub(super) const CALL_TIME: f64 = 2.0;
/// Seconds to swing or lock a door.
pub(super) const DOOR_TIME: f64 = 4.0;
/// Seconds that a push takes.
pub(super) const PUSH_TIME: f64 = 6.0;
/// Seconds to take a thing or to let it go.
pub(super) const GRASP_TIME: f64 = 5.0;

/// How the doors of a floor are set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Doors {
    AsTheyAre,
    Open,
    /// And what can be carried is taken away, and furniture shut.
    Shut,
}

#[derive(Debug, Clone, Copy)]
struct Stand {
    map: MapId,
    area: AreaId,
    at: Point,
    heading: Option<Deg>,
    doors: Doors,
    /// Of the pieces of the Area's floor, by number.
    piece: usize,
}

/// Why there is no time: there is no way, or a name is not known.
enum Untimed {
    NoWay,
    Unknown(String),
}

impl From<Unknown> for Untimed {
    fn from(Unknown(name): Unknown) -> Self {
        Self::Unknown(name)
    }
}

/// Tells how long directives take in a world, and for which of them its floor has no way.
pub(super) struct Clock<'a> {
    world: &'a World,
    floors: &'a BTreeMap<MapId, FloorPlan>,
    /// The same with every door open.
    open: OnceCell<BTreeMap<MapId, FloorPlan>>,
    /// The same with every door shut, and a world with nothing about that a plan could put away.
    shut: OnceCell<(World, BTreeMap<MapId, FloorPlan>)>,
    pub(super) atlas: Atlas,
    pub(super) lifts: Vec<Lift>,
    /// A place in each piece of an Area's floor.
    rests: HashMap<(AreaId, Doors), Vec<Point>>,
    stands: HashMap<(At, Doors), Rc<[Stand]>>,
    drives: HashMap<(At, At), Option<f64>>,
}

impl<'a> Clock<'a> {
    pub(super) fn new(
        world: &'a World,
        relations: &Relations,
        floors: &'a BTreeMap<MapId, FloorPlan>,
    ) -> Self {
        let state = world.areas.keys().next().map(|&area| RobotState {
            area,
            at: RobotAt::Elsewhere,
            holds: None,
        });
        let places = state.map(|state| planning::initial(world, relations, &state).places);
        Self {
            world,
            floors,
            open: OnceCell::new(),
            shut: OnceCell::new(),
            atlas: Atlas::of(world, relations, places.unwrap_or_default()),
            lifts: lifts(world, relations),
            rests: HashMap::new(),
            stands: HashMap::new(),
            drives: HashMap::new(),
        }
    }

    /// Points that have names for the time of a mission are places as well.
    pub(super) fn knowing(mut self, spots: &[Spot]) -> Self {
        self.atlas.learn(spots);
        self
    }

    /// Leaves out of a task what the floor refuses.
    pub(super) fn bar(&mut self, domain: &Domain, task: &mut Task) {
        leave_out(task, |task, id| !self.allows(&Directive::of(domain, task, task.operator(id))));
    }

    /// Whether the floor has a way for a directive, and its doors' leaves room; what is not known may have.
    pub(super) fn allows(&mut self, directive: &Directive) -> bool {
        directive.primitives().iter().all(|primitive| {
            let allowed = match primitive {
                Primitive::GoToPlace(_) | Primitive::GoToDoor(_) | Primitive::Cross { .. } => {
                    self.leads_by(directive, primitive)
                }
                Primitive::Ride { lift, to, .. } => self.ride(directive, lift, to).map(|_| true),
                Primitive::SetDoor { door, status: DoorStatus::Open } => Ok(self.swings(door)),
                _ => Ok(true),
            };
            !matches!(allowed, Ok(false) | Err(Untimed::NoWay))
        })
    }

    fn leads_by(&mut self, directive: &Directive, primitive: &Primitive) -> Result<bool, Untimed> {
        let (from, to) = self.atlas.drive_of(directive, primitive)?;
        self.leads(from, to)
    }

    /// Whether there is a way. In one piece of a room's floor there is, where no zone says in which direction to drive; and
    /// where the robot could not stand, as in a zone that is shut, it is not for the floor to say how it gets out.
    fn leads(&mut self, from: At, to: At) -> Result<bool, Untimed> {
        if !self.has_stand(&from)? {
            return Ok(true);
        }
        let in_room = self.within_room(&from, &to)?;
        let has_zones = |stand: &Stand| !self.floors[&stand.map].zones().is_empty();
        match in_room {
            Some((start, _)) if !has_zones(&start) => Ok(true),
            _ => self.drive(from, to).map(|_| true),
        }
    }

    fn has_stand(&mut self, spot: &At) -> Result<bool, Untimed> {
        for doors in [Doors::AsTheyAre, Doors::Open, Doors::Shut] {
            if !self.stands(spot, doors)?.is_empty() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether nothing that stays where it is stops a door's leaves.
    fn swings(&self, door: &str) -> bool {
        let key = name_key(door);
        let Some(join) = self.atlas.joins_named(&key).next() else { return true };
        let map = self.world.placement(join.from).map(|(map, _)| map);
        let floor = map.and_then(|map| self.floor(map, Doors::Shut));
        let (Some(door), Some((floor, world))) = (join.door, floor) else { return true };
        // Other leaves can be set otherwise.
        !floor.struck_by(world, door).is_some_and(|by| !matches!(by, Blocker::DoorLeaf { .. }))
    }

    /// What each action of a task takes becomes its cost, in hundredths of a second; what has no way has none. The names of
    /// which the map does not tell where they are.
    pub(super) fn charge(&mut self, domain: &Domain, task: &mut Task) -> BTreeSet<String> {
        let mut unknown = BTreeSet::new();
        for id in task.operator_ids().filter(|&id| !task.is_goal_step(id)).collect::<Vec<_>>() {
            let cost = match self.takes(&Directive::of(domain, task, task.operator(id))) {
                Ok(seconds) => (seconds * 100.0).round() as u32,
                Err(Untimed::NoWay) => 0,
                Err(Untimed::Unknown(name)) => {
                    unknown.insert(name);
                    0
                }
            };
            task.operators[id.index()].cost = cost;
        }
        let goal_steps = task.operators.len() - task.goal_steps;
        task.operators[goal_steps..].iter_mut().for_each(|step| step.cost = 0);
        unknown
    }

    fn takes(&mut self, directive: &Directive) -> Result<f64, Untimed> {
        directive.primitives().iter().map(|primitive| self.primitive(directive, primitive)).sum()
    }

    fn primitive(&mut self, directive: &Directive, primitive: &Primitive) -> Result<f64, Untimed> {
        let look_round = 360.0 / self.world.robot.turn_rate;
        Ok(match primitive {
            Primitive::GoToPlace(_) | Primitive::GoToDoor(_) | Primitive::Cross { .. } => {
                let (from, to) = self.atlas.drive_of(directive, primitive)?;
                self.drive(from, to)?
            }
            Primitive::SetDoor { .. } | Primitive::SetOpen { .. } => DOOR_TIME,
            Primitive::CallLift { door, .. } => LIFT_WAIT + self.opens(door),
            Primitive::Ride { lift, to, door } => {
                self.ride(directive, lift, to)? + self.opens(door)
            }
            Primitive::Push(_) => PUSH_TIME,
            Primitive::Take(_) | Primitive::Put { .. } | Primitive::HandOver { .. } => GRASP_TIME,
            Primitive::Switch { .. } => SWITCH_TIME,
            Primitive::LookRound | Primitive::Seek(_) => look_round,
            Primitive::Call(_) => CALL_TIME,
        })
    }

    fn stands(&mut self, spot: &At, doors: Doors) -> Result<Rc<[Stand]>, Untimed> {
        let key = (spot.clone(), doors);
        if let Some(known) = self.stands.get(&key) {
            return Ok(Rc::clone(known));
        }
        let area = self.atlas.area_of(spot)?;
        if !self.rests.contains_key(&(area, doors)) {
            let map = self.world.placement(area).map(|(map, _)| map);
            let floor = map.and_then(|map| self.floor(map, doors));
            let rests = floor.map_or_else(Vec::new, |(floor, _)| floor.rests_in(area));
            self.rests.insert((area, doors), rests);
        }
        let found: Rc<[Stand]> = self.find_stands(spot, doors)?.into();
        self.stands.insert(key, Rc::clone(&found));
        Ok(found)
    }

    /// A floor, and the world that it is of.
    fn floor(&self, map: MapId, doors: Doors) -> Option<(&FloorPlan, &World)> {
        let set = |state| -> BTreeMap<MapId, FloorPlan> {
            let set = |floor: &FloorPlan| with_doors_set(self.world, floor, state);
            self.floors.iter().map(|(&map, floor)| (map, set(floor))).gather()
        };
        Some(match doors {
            Doors::AsTheyAre => (self.floors.get(&map)?, self.world),
            Doors::Open => (self.open.get_or_init(|| set(DoorState::OPEN)).get(&map)?, self.world),
            Doors::Shut => {
                let (bare, floors) = self.shut.get_or_init(|| {
                    let (bare, differ) = put_away(self.world);
                    let mut floors = set(DoorState::CLOSED);
                    floors.values_mut().for_each(|floor| floor.rebuild(&bare, &differ));
                    (bare, floors)
                });
                (floors.get(&map)?, bare)
            }
        })
    }

    /// None where the robot cannot come to stand there.
    fn find_stands(&self, spot: &At, doors: Doors) -> Result<Vec<Stand>, Untimed> {
        let area = self.atlas.area_of(spot)?;
        let Some((map, _)) = self.world.placement(area) else { return Ok(Vec::new()) };
        let Some((floor, world)) = self.floor(map, doors) else { return Ok(Vec::new()) };
        let target = match self.atlas.target_of(world, floor, spot)? {
            // It is put away.
            Some(Target::Replica(id)) if !world.replicas.contains_key(&id) => {
                let placed = self.floors[&map].scene().replicas.get(&id);
                placed.map(|placed| {
                    Target::Point(nalgebra::center(&placed.bounds.min, &placed.bounds.max))
                })
            }
            target => target,
        };
        let Some(target) = target else { return Ok(Vec::new()) };
        let stand = |(piece, &from): (usize, &Point)| {
            let within = Some(&[area][..]);
            let way = floor.route_within(world, from, target, Method::Shortest, within).ok()?;
            Some(Stand { map, area, at: *way.points.last()?, heading: way.heading, doors, piece })
        };
        Ok(self.rests[&(area, doors)].iter().enumerate().filter_map(stand).collect())
    }

    /// Where the robot stands, as the doors are; none where that is in no one place.
    pub(super) fn stands_at(&mut self, place: &str, area: Option<AreaId>) -> Option<(MapId, Pose)> {
        let spot = match area {
            Some(area) => At::Door(name_key(place), area),
            None => At::Place(name_key(place)),
        };
        let stands = self.stands(&spot, Doors::AsTheyAre).ok()?;
        let [stand] = &stands[..] else { return None };
        Some((stand.map, Pose { at: stand.at, heading: stand.heading.unwrap_or_default() }))
    }

    /// Two stands in one piece of a room's floor, with its doors as they are where that will do.
    fn within_room(&mut self, from: &At, to: &At) -> Result<Option<(Stand, Stand)>, Untimed> {
        for doors in [Doors::AsTheyAre, Doors::Open, Doors::Shut] {
            let (starts, ends) = (self.stands(from, doors)?, self.stands(to, doors)?);
            let joined =
                |start: &&Stand, end: &Stand| (start.area, start.piece) == (end.area, end.piece);
            let both = |end: &Stand| Some((*starts.iter().find(|start| joined(start, end))?, *end));
            if let Some(both) = ends.iter().find_map(both) {
                return Ok(Some(both));
            }
        }
        Ok(None)
    }

    fn drive(&mut self, from: At, to: At) -> Result<f64, Untimed> {
        let key = (from, to);
        if let Some(known) = self.drives.get(&key) {
            return known.ok_or(Untimed::NoWay);
        }
        let seconds = match self.within_room(&key.0, &key.1)? {
            Some((start, end)) => self.seconds(start, end),
            None => self.through(&key.0, &key.1)?,
        };
        self.drives.insert(key, seconds);
        seconds.ok_or(Untimed::NoWay)
    }

    /// Through the door between two rooms, as the doors are, or all of them open, or all others shut where their leaves bar
    /// the way.
    fn through(&mut self, from: &At, to: &At) -> Result<Option<f64>, Untimed> {
        let At::Door(door, _) = to else { return Ok(None) };
        let door = self.atlas.joins_named(door).filter_map(|join| join.door);
        let opened: DoorStates = door.take(1).map(|door| (door, DoorState::OPEN)).gather();
        for doors in [Doors::AsTheyAre, Doors::Open, Doors::Shut] {
            let (starts, ends) = (self.stands(from, doors)?, self.stands(to, doors)?);
            let pairs = starts.iter().flat_map(|start| ends.iter().map(move |end| (*start, *end)));
            let mut pairs = pairs.filter(|(start, end)| start.area != end.area).peekable();
            let Some((start, _)) = pairs.peek() else { continue };
            let Some((floor, world)) = self.floor(start.map, doors) else { continue };
            let floor = match doors {
                Doors::Shut => Cow::Owned(floor.with_doors(world, &opened)),
                _ => Cow::Borrowed(floor),
            };
            let way = |(start, end)| self.seconds_on(&floor, world, start, end);
            if let Some(seconds) = pairs.find_map(way) {
                return Ok(Some(seconds));
            }
        }
        Ok(None)
    }

    fn seconds(&self, start: Stand, end: Stand) -> Option<f64> {
        let (floor, world) = self.floor(start.map, start.doors)?;
        self.seconds_on(floor, world, start, end)
    }

    /// The way between two stands, through the door where they lie in two rooms, driven as a vehicle drives it: turning on
    /// the spot, and straight on.
    fn seconds_on(
        &self,
        floor: &FloorPlan,
        world: &World,
        start: Stand,
        end: Stand,
    ) -> Option<f64> {
        if start.map != end.map {
            return None;
        }
        let (areas, target) = ([start.area, end.area], Target::Point(end.at));
        let way =
            floor.route_within(world, start.at, target, Method::Shortest, Some(&areas)).ok()?;
        let robot = &self.world.robot;
        let (mut seconds, mut heading) = (0.0, start.heading);
        let mut turn = |to: Deg| {
            let from = heading.replace(to).unwrap_or(to);
            (to - from).signed().abs() / robot.turn_rate
        };
        for (points, pace) in floor.paces(&way.points) {
            let speed = pace.map_or(robot.speed, |pace| pace.min(robot.speed));
            for pair in points.windows(2) {
                let along = pair[1] - pair[0];
                if along.norm() > 1e-6 {
                    seconds += turn(Deg::from_radians(along.y.atan2(along.x)));
                    seconds += along.norm() / speed;
                }
            }
        }
        Some(seconds + end.heading.map_or(0.0, turn))
    }

    /// The lift opens its own door, where it has one.
    fn opens(&self, door: &str) -> f64 {
        let key = name_key(door);
        let mut named = self.atlas.joins_named(&key);
        if named.any(|join| join.door.is_some()) { DOOR_TIME } else { 0.0 }
    }

    fn ride(&self, directive: &Directive, lift: &str, to: &str) -> Result<f64, Untimed> {
        let unknown = |name: &str| Untimed::Unknown(name.to_owned());
        let of_name = |known: &&Lift| name_key(&known.name) == name_key(lift);
        let number = self.lifts.iter().find(of_name).ok_or_else(|| unknown(lift))?.number;
        let key = name_key(predicate::ROBOT_IN);
        let room = directive.needs.iter().find(|need| need.predicate == key);
        let from = room.and_then(|room| room.args.first()).ok_or_else(|| unknown(lift))?;
        let (from, to) = (self.atlas.area(from)?, self.atlas.area(to)?);
        let height = |cabin: AreaId| {
            let (map, frame) = self.world.placement(cabin)?;
            let storey = self.world.domain.maps.iter().find(|m| m.map == map);
            Some(storey.map_or(0.0, |m| m.frame.z.get()) + frame.z.get())
        };
        let (Some(below), Some(above)) = (height(from), height(to)) else {
            return Err(Untimed::NoWay);
        };
        let ride = Ride { lift: number, from, to, rise: above - below };
        // The wait for it is that of the call.
        Ok(ride.seconds() - LIFT_WAIT)
    }
}

/// A floor with all doors in one state, those that have leaves.
fn with_doors_set(world: &World, floor: &FloorPlan, state: DoorState) -> FloorPlan {
    let has_leaf = |door: &DoorId| world.doors.get(door).is_some_and(|d| !d.leaves.is_empty());
    let differs = |door: &DoorId| floor.door_state(world, *door).status != state.status;
    let doors = floor.doorways().iter().filter_map(|way| way.door).filter(differs);
    let doors = doors.filter(|door| state.status == DoorStatus::Open || has_leaf(door));
    let states: DoorStates = doors.map(|door| (door, state)).gather();
    floor.with_doors(world, &states)
}

/// The world without what a plan may put away: what can be carried is gone, and furniture is shut. With what differs.
fn put_away(world: &World) -> (World, Vec<ReplicaId>) {
    let is_portable = |id: ReplicaId| world.has_trait(id, "portable");
    let open = |thing: &Replica| stands(world, thing) == Some(DoorStatus::Open);
    let differ = world.replicas.iter().filter(|(id, thing)| is_portable(**id) || open(thing));
    let differ: Vec<ReplicaId> = differ.map(|(id, _)| *id).collect();
    let mut bare = world.clone();
    for &id in &differ {
        if is_portable(id) {
            bare.replicas.remove(&id);
        } else if let Some(thing) = bare.replicas.get_mut(&id)
            && let Some(object) = world.objects.get(&thing.object)
        {
            set_open(thing, object, false);
        }
    }
    (bare, differ)
}

/// Leaves out actions of a task; what only says that the goal is met is none.
pub(super) fn leave_out(task: &mut Task, mut is_out: impl FnMut(&Task, OperatorId) -> bool) {
    let out = |id| !task.is_goal_step(id) && is_out(task, id);
    let out: Vec<bool> = task.operator_ids().map(out).collect();
    let mut out = out.into_iter();
    task.operators.retain(|_| !out.next().unwrap_or_default());
}
