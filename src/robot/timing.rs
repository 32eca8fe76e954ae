//! How long a directive takes, by the floor as it is known: the true way at the robot's speed, its turns, doors, rides of
//! lifts with their waits, and what the hand does. A plan by driven time is chosen by it.
//!
//! A *stand* is where the robot stands at a place, or before a door on one side of it: the end of a way that comes from the
//! middle of the room. Each directive is timed from stand to stand, so that what it takes does not depend on what came
//! before. Where a room cannot be crossed as its doors stand, it is asked for with all doors open: a plan may open them.

use std::collections::{BTreeMap, HashMap};

use crate::geometry::{DoorStates, FloorPlan, LIFT_WAIT, Method, Ride, Target};
use crate::map::{DoorState, DoorStatus, World};
use crate::semantics::planning::{self, PlaceSource, RobotAt, RobotState};
use crate::semantics::{Join, Lift, Relations, lifts, predicate};
use crate::units::{AreaId, Deg, Gather as _, MapId, Point, name_key};

use super::directive::{Directive, Effect, Primitive};
use super::mission::before_passage;

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

/// What is known of how long a directive takes.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Takes {
    Seconds(f64),
    /// The floor has no way for it.
    NoWay,
    /// The Map does not tell where that is.
    Unknown(String),
}

/// Where the robot may stand.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Spot {
    Place(String),
    Door(String, AreaId),
}

#[derive(Debug, Clone, Copy)]
struct Stand {
    map: MapId,
    area: AreaId,
    at: Point,
    heading: Option<Deg>,
}

/// Why there is no time: there is no way, or a name is not known.
enum Untimed {
    NoWay,
    Unknown(String),
}

/// Tells how long directives take in a world.
pub struct Clock<'a> {
    world: &'a World,
    floors: &'a BTreeMap<MapId, FloorPlan>,
    /// The same with every door open.
    open: BTreeMap<MapId, FloorPlan>,
    areas: HashMap<String, AreaId>,
    places: HashMap<String, (AreaId, PlaceSource)>,
    joins: Vec<Join>,
    lifts: Vec<Lift>,
    stands: HashMap<Spot, Option<Stand>>,
    drives: HashMap<(Spot, Spot), Option<f64>>,
}

impl<'a> Clock<'a> {
    #[must_use]
    pub fn new(
        world: &'a World,
        relations: &Relations,
        floors: &'a BTreeMap<MapId, FloorPlan>,
    ) -> Self {
        let opened = |floor: &FloorPlan| {
            let shut = |door: &_| floor.door_state(world, *door).status != DoorStatus::Open;
            let doors = floor.doorways().iter().filter_map(|way| way.door).filter(shut);
            let states: DoorStates = doors.map(|door| (door, DoorState::OPEN)).gather();
            floor.with_doors(world, &states)
        };
        let symbol = |id: AreaId| (name_key(relations.symbols().area(id)), id);
        let state = world.areas.keys().next().map(|&area| RobotState {
            area,
            at: RobotAt::Elsewhere,
            holds: None,
        });
        let places = state.map(|state| planning::initial(world, relations, &state).places);
        let places = places.unwrap_or_default().into_iter();
        Self {
            world,
            floors,
            open: floors.iter().map(|(&map, floor)| (map, opened(floor))).gather(),
            areas: world.areas.keys().copied().map(symbol).collect(),
            places: places.map(|p| (name_key(&p.name), (p.area, p.source))).collect(),
            joins: relations.joins(),
            lifts: lifts(world, relations),
            stands: HashMap::new(),
            drives: HashMap::new(),
        }
    }

    pub(super) fn takes(&mut self, directive: &Directive) -> Takes {
        let primitives = directive.primitives();
        let seconds = primitives
            .iter()
            .map(|primitive| self.primitive(directive, primitive))
            .sum::<Result<f64, _>>();
        match seconds {
            Ok(seconds) => Takes::Seconds(seconds),
            Err(Untimed::NoWay) => Takes::NoWay,
            Err(Untimed::Unknown(name)) => Takes::Unknown(name),
        }
    }

    fn primitive(&mut self, directive: &Directive, primitive: &Primitive) -> Result<f64, Untimed> {
        let look_round = 360.0 / self.world.robot.turn_rate;
        Ok(match primitive {
            Primitive::GoToPlace(place) => {
                let from = self.begins(directive)?;
                self.drive(from, Spot::Place(name_key(place)))?
            }
            Primitive::GoToDoor(door) => {
                let from = self.begins(directive)?;
                let area = match &from {
                    Spot::Door(_, area) => *area,
                    Spot::Place(place) => self.places[place].0,
                };
                self.drive(from, Spot::Door(name_key(door), area))?
            }
            Primitive::Cross { door, into } => {
                let (from, into) = (self.begins(directive)?, self.area(into)?);
                self.drive(from, Spot::Door(name_key(door), into))?
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

    fn area(&self, name: &str) -> Result<AreaId, Untimed> {
        let area = self.areas.get(&name_key(name));
        area.copied().ok_or_else(|| Untimed::Unknown(name.to_owned()))
    }

    /// Where the robot stands before a directive, by what that needs.
    fn begins(&self, directive: &Directive) -> Result<Spot, Untimed> {
        let needed = |predicate: &str| -> Option<&Effect> {
            let key = name_key(predicate);
            directive.needs.iter().find(|need| need.predicate == key)
        };
        if let Some(Effect { args, .. }) = needed(predicate::ROBOT_AT_PLACE)
            && let [place] = args.as_slice()
        {
            let key = name_key(place);
            let is_known = self.places.contains_key(&key);
            return if is_known {
                Ok(Spot::Place(key))
            } else {
                Err(Untimed::Unknown(place.clone()))
            };
        }
        if let (Some(door), Some(room)) =
            (needed(predicate::ROBOT_AT_DOOR), needed(predicate::ROBOT_IN))
            && let ([door], [room, ..]) = (door.args.as_slice(), room.args.as_slice())
        {
            return Ok(Spot::Door(name_key(door), self.area(room)?));
        }
        // The rule asks for no place to begin from.
        Err(Untimed::Unknown(directive.to_string()))
    }

    fn stand(&mut self, spot: &Spot) -> Result<Stand, Untimed> {
        if let Some(known) = self.stands.get(spot) {
            return known.ok_or(Untimed::NoWay);
        }
        let found = self.find_stand(spot)?;
        self.stands.insert(spot.clone(), found);
        found.ok_or(Untimed::NoWay)
    }

    /// None where the robot cannot come to stand there.
    fn find_stand(&self, spot: &Spot) -> Result<Option<Stand>, Untimed> {
        let unknown = |name: &str| Untimed::Unknown(name.to_owned());
        let area = match spot {
            Spot::Place(name) => self.places.get(name).ok_or_else(|| unknown(name))?.0,
            Spot::Door(_, area) => *area,
        };
        let Some((map, _)) = self.world.placement(area) else { return Ok(None) };
        let (Some(floor), Some(open)) = (self.floors.get(&map), self.open.get(&map)) else {
            return Ok(None);
        };
        let target = match spot {
            Spot::Place(name) => match self.places[name].1 {
                PlaceSource::Named(id) => Target::Place(id),
                PlaceSource::Before(id) => Target::Replica(id),
                PlaceSource::Robot => return Err(unknown(name)),
            },
            Spot::Door(name, _) => {
                let of_name = |join: &&Join| name_key(&join.opening) == *name;
                let mut named = self.joins.iter().filter(of_name).peekable();
                named.peek().ok_or_else(|| unknown(name))?;
                // A rule may speak of the robot at a door in a room that the door does not lead to.
                let Some(join) = named.find(|join| join.from == area) else { return Ok(None) };
                match join.door {
                    Some(door) => Target::Door { door, area },
                    None => before_passage(self.world, floor, join, area)
                        .ok_or_else(|| unknown(name))?,
                }
            }
        };
        let stand = [floor, open].into_iter().find_map(|floor| {
            let from = floor.rest_in(area)?;
            let way = floor
                .route_within(self.world, from, target, Method::Shortest, Some(&[area]))
                .ok()?;
            Some(Stand { map, area, at: *way.points.last()?, heading: way.heading })
        });
        Ok(stand)
    }

    fn drive(&mut self, from: Spot, to: Spot) -> Result<f64, Untimed> {
        let key = (from, to);
        if let Some(known) = self.drives.get(&key) {
            return known.ok_or(Untimed::NoWay);
        }
        let (start, end) = (self.stand(&key.0)?, self.stand(&key.1)?);
        let seconds = self.seconds(start, end);
        self.drives.insert(key, seconds);
        seconds.ok_or(Untimed::NoWay)
    }

    /// The way between two stands, through the door where they lie in two rooms, driven as a vehicle drives it: turning on
    /// the spot, and straight on.
    fn seconds(&self, start: Stand, end: Stand) -> Option<f64> {
        if start.map != end.map {
            return None;
        }
        let areas = [start.area, end.area];
        let (floor, open) = (&self.floors[&start.map], &self.open[&start.map]);
        let floors = if start.area == end.area { vec![floor, open] } else { vec![open] };
        floors.into_iter().find_map(|floor| {
            let target = Target::Point(end.at);
            let way = floor
                .route_within(self.world, start.at, target, Method::Shortest, Some(&areas))
                .ok()?;
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
            seconds += end.heading.map_or(0.0, turn);
            Some(seconds)
        })
    }

    /// The lift opens its own door, where it has one.
    fn opens(&self, door: &str) -> f64 {
        let key = name_key(door);
        let mut named = self.joins.iter().filter(|join| name_key(&join.opening) == key);
        if named.any(|join| join.door.is_some()) { DOOR_TIME } else { 0.0 }
    }

    fn ride(&self, directive: &Directive, lift: &str, to: &str) -> Result<f64, Untimed> {
        let unknown = |name: &str| Untimed::Unknown(name.to_owned());
        let of_name = |known: &&Lift| name_key(&known.name) == name_key(lift);
        let number = self.lifts.iter().find(of_name).ok_or_else(|| unknown(lift))?.number;
        let key = name_key(predicate::ROBOT_IN);
        let room = directive.needs.iter().find(|need| need.predicate == key);
        let from = room.and_then(|room| room.args.first()).ok_or_else(|| unknown(lift))?;
        let (from, to) = (self.area(from)?, self.area(to)?);
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
