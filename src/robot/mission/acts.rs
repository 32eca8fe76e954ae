//! What a mission has its vehicle do, primitive by primitive: going and turning, riding, doors, taking and putting.

use crate::belief::Station;
use crate::directive::Primitive;
use crate::geometry::{
    Barrier, Blocker, DoorStates, FloorPlan, Method, NoRoute, PlacedZone, Ride, Route, Target,
};
use crate::map::{DoorState, DoorStatus, Entity, Zone};
use crate::placing::{spot_in, spot_on, spot_on_floor};
use crate::reins::Reins;
use crate::semantics::cargo;
use crate::semantics::planning::PLACE_BESIDE;
use crate::units::{AreaId, Deg, DoorId, Frame, MapId, Point, Pose, ReplicaId, Vector};
use crate::vehicle::{Done, Obstruction, Refusal, Sighting, Unfinished, Vehicle, Watch};

use super::{Leg, Mission, Surprise, blocked, look_round, refused};

impl Mission<'_> {
    pub(super) fn perform(
        &mut self,
        primitive: &Primitive,
        reins: &mut Reins<'_>,
        leg: &mut Leg,
    ) -> Result<(), Unfinished<Surprise>> {
        match primitive {
            Primitive::GoToPlace(name) => {
                let target = self.place_target(name)?;
                self.go(name, target, &[self.belief.area], reins, leg)?;
                let looks = self.belief.spots.iter().find(|s| s.looks && s.name == *name);
                if let Some(pose) = looks.map(|spot| spot.pose) {
                    self.turn(pose.heading, reins)?;
                }
                // Before a thing it stands only if the thing is there.
                if let Target::Replica(thing) = target
                    && self.is_elsewhere(thing, reins)?
                {
                    return Err(refused(Refusal::NotThere(thing).into(), reins));
                }
                self.belief.station = Station::Place(name.clone());
            }
            Primitive::GoToDoor(name) => {
                let area = self.belief.area;
                let target = self.door_target(name, area, area)?;
                self.go_out(name, target, &[area], reins, leg)?;
                self.belief.station = Station::Door(name.clone());
            }
            Primitive::Cross { door: name, into } => {
                let into = self.area(into)?;
                let areas = [self.belief.area, into];
                let target = self.door_target(name, self.belief.area, into)?;
                self.go_out(name, target, &areas, reins, leg)?;
                self.belief.area = into;
                self.belief.station = Station::Door(name.clone());
            }
            Primitive::SetDoor { door, status } => self.set_door(door, *status, reins)?,
            Primitive::CallLift { lift, door } => {
                let opening = self.opening(door)?;
                let called = reins.act(|vehicle, watch| vehicle.call_lift(opening, watch));
                called.map_err(|r| refused(r, reins))?;
                self.cabin_stands_at(lift, door, opening);
            }
            Primitive::Ride { lift, to, door } => self.ride(lift, to, door, reins)?,
            Primitive::SetOpen { thing, open } => {
                let id = self.replica(thing)?;
                self.within_reach(id, reins, leg, |v, watch| v.set_open(id, *open, watch))?;
                self.belief.set_open(id, *open);
            }
            Primitive::Push(name) => {
                let id = self.replica(name)?;
                self.push(id, reins, leg)?;
            }
            Primitive::Take(name) => self.take(name, reins, leg)?,
            Primitive::Put { thing, onto } => self.put(thing, onto.as_deref(), reins)?,
            Primitive::HandOver { thing, person } => {
                let held = self.held(thing)?;
                let given = reins.act(|vehicle, watch| vehicle.hand_over(held, watch));
                given.map_err(|r| refused(r, reins))?;
                let replica = self.belief.held.take().expect("checked by held()");
                self.belief.handed_over.push((replica, person.clone()));
            }
            Primitive::Switch { device, on } => {
                let id = self.replica(device)?;
                self.within_reach(id, reins, leg, |v, watch| v.switch(id, *on, watch))?;
                self.belief.switch(id, *on);
            }
            Primitive::LookRound => look_round(reins)?,
            Primitive::Seek(name) => self.seek(name, reins, leg)?,
            Primitive::Call(person) => {
                let called = reins.act(|vehicle, watch| vehicle.call(person, watch));
                called.map_err(|r| refused(r, reins))?;
            }
        }
        Ok(())
    }

    /// Takes a thing from where it is, or from the person who was given it.
    fn take(
        &mut self,
        name: &str,
        reins: &mut Reins<'_>,
        leg: &mut Leg,
    ) -> Result<(), Unfinished<Surprise>> {
        let given = self.belief.handed_over.iter().position(|(thing, _)| thing.name == *name);
        if let Some(at) = given {
            let thing = self.belief.handed_over[at].0.id;
            let taken = reins.act(|vehicle, watch| vehicle.take_back(thing, watch));
            taken.map_err(|r| refused(r, reins))?;
            self.belief.held = Some(self.belief.handed_over.remove(at).0);
            return Ok(());
        }
        let thing = self.replica(name)?;
        let with = cargo(&self.belief.world, self.rules, self.belief.scene(), thing);
        self.within_reach(thing, reins, leg, |v, watch| v.take(thing, watch))?;
        self.belief.pick_up(thing, &with.unwrap_or_default());
        // The place beside what lay on the floor goes with it; the robot still stands there.
        if let Station::Place(place) = &self.belief.station
            && place.strip_prefix(PLACE_BESIDE) == Some(name)
        {
            self.belief.pose = reins.pose().1;
            self.name_this_point();
        }
        Ok(())
    }

    /// Does something to a thing. Where the arm is too short from the place that serves what the thing stands on, a bed
    /// say, the robot first goes to where the thing itself is nearest.
    pub(super) fn within_reach(
        &mut self,
        thing: ReplicaId,
        reins: &mut Reins<'_>,
        leg: &mut Leg,
        act: impl Fn(&mut dyn Vehicle, &mut Watch<'_>) -> Done,
    ) -> Result<(), Unfinished<Surprise>> {
        let Err(refusal) = reins.act(&act) else { return Ok(()) };
        if let Unfinished::Met(Refusal::OutOfReach(_)) = refusal {
            let name = self.belief.world.name(Entity::Replica(thing)).to_owned();
            match self.go(&name, Target::Replica(thing), &[self.belief.area], reins, leg) {
                Ok(()) => match reins.act(&act) {
                    Err(Unfinished::Met(Refusal::OutOfReach(_))) => {}
                    done => return done.map_err(|r| refused(r, reins)),
                },
                Err(Unfinished::Met(_)) => {}
                Err(unfinished) => return Err(unfinished),
            }
            // No arm is too short for what is not there.
            if self.is_elsewhere(thing, reins)? {
                return Err(refused(Refusal::NotThere(thing).into(), reins));
            }
        }
        Err(refused(refusal, reins))
    }

    pub(crate) fn go(
        &mut self,
        name: &str,
        target: Target,
        areas: &[AreaId],
        reins: &mut Reins<'_>,
        leg: &mut Leg,
    ) -> Result<(), Unfinished<Surprise>> {
        let route = self
            .way(self.belief.floor(), target, areas)
            .map_err(|why| Surprise::NoWay { to: name.to_owned(), why, remedy: None })?;
        self.drive(route, reins, leg)
    }

    fn way(&self, floor: &FloorPlan, target: Target, areas: &[AreaId]) -> Result<Route, NoRoute> {
        let (world, from) = (&self.belief.world, self.belief.pose.at);
        floor.route_within(world, from, target, Method::Shortest, Some(areas))
    }

    /// The same to or through a door: of a room that is shut as a whole the robot gets out all the same.
    fn go_out(
        &mut self,
        name: &str,
        target: Target,
        areas: &[AreaId],
        reins: &mut Reins<'_>,
        leg: &mut Leg,
    ) -> Result<(), Unfinished<Surprise>> {
        let (floor, at) = (self.belief.floor(), self.belief.pose.at);
        let zones = floor.zones().iter();
        let is_in = |zone: &&PlacedZone| zone.kind.is_shut() && zone.contains(at, floor.reach());
        let (held_in, others): (Vec<_>, Vec<_>) = zones.partition(is_in);
        if held_in.is_empty() || self.way(floor, target, areas).is_ok() {
            return self.go(name, target, areas, reins, leg);
        }
        let is_other = |zone: &Zone| others.iter().any(|other| other.id == zone.id);
        let open = floor.with_zones(&self.belief.world, is_other);
        match self.way(&open, target, areas) {
            Ok(route) => self.drive(route, reins, leg),
            Err(_) => self.go(name, target, areas, reins, leg),
        }
    }

    fn drive(
        &mut self,
        route: Route,
        reins: &mut Reins<'_>,
        leg: &mut Leg,
    ) -> Result<(), Unfinished<Surprise>> {
        let pieces = self.belief.floor().paces(&route.points);
        let driven = reins.follow_paced(&pieces, route.heading);
        leg.route = Some(route);
        self.belief.pose = reins.pose().1;
        if reins.was_displaced() {
            return Err(Surprise::Displaced.into());
        }
        driven.map_err(|bump| blocked(bump, reins))
    }

    /// Turns where the robot stands.
    fn turn(&mut self, heading: Deg, reins: &mut Reins<'_>) -> Result<(), Unfinished<Surprise>> {
        let turned = reins.follow(&[self.belief.pose.at], Some(heading));
        self.belief.pose = reins.pose().1;
        if reins.was_displaced() {
            return Err(Surprise::Displaced.into());
        }
        turned.map_err(|bump| blocked(bump, reins))
    }

    /// Rides to another stop of the lift in which the robot stands: where it stands in the cabin, or in the middle of
    /// a cabin that lies elsewhere on the Map of that storey.
    fn ride(
        &mut self,
        lift: &str,
        to: &str,
        door: &str,
        reins: &mut Reins<'_>,
    ) -> Result<(), Unfinished<Surprise>> {
        let (to, opening) = (self.area(to)?, self.opening(door)?);
        let number = self.lifts.iter().find(|l| l.name == lift).map(|l| l.number);
        let number = number.ok_or_else(|| Surprise::Unknown { name: lift.to_owned() })?;
        let Some((arrival, rise)) = self.arrival(to) else {
            self.belief.unreachable.push((to, door.to_owned()));
            return Err({
                let why = self.no_arrival(to);
                Surprise::NoWay { to: lift.to_owned(), why, remedy: None }.into()
            });
        };
        let ride = Ride { lift: number, from: self.belief.area, to, rise };
        let ridden =
            reins.ride(arrival, |vehicle, watch| vehicle.ride(&ride, opening, arrival, watch));
        if let Err(Unfinished::Stopped | Unfinished::Failed(_)) = ridden {
            return ridden.map_err(|r| refused(r, reins));
        }
        (self.belief.map, self.belief.pose) = reins.pose();
        self.belief.area = to;
        self.belief.station = Station::Door(door.to_owned());
        ridden.map_err(|r| refused(r, reins))?;
        self.cabin_stands_at(lift, door, opening);
        Ok(())
    }

    /// Where the robot is after a ride, and how much higher, cm.
    fn arrival(&self, to: AreaId) -> Option<((MapId, Pose), f64)> {
        let belief = &self.belief;
        let storey = |map: MapId| {
            let maps = &belief.world.domain.maps;
            maps.iter().find(|m| m.map == map).map_or(Frame::IDENTITY, |m| m.frame)
        };
        let (map, frame) = belief.world.placement(to)?;
        let (below, above) = (storey(belief.map), storey(map));
        let floor = belief.floor_of(map)?;
        let same = above.invert(below.apply(belief.pose.at));
        let stands = |at: &Point| {
            floor.locate(*at).is_some_and(|(area, _)| area == to)
                && floor.standing_at(*at).is_some_and(|near| (near - at).norm() < 1e-6)
        };
        let at = Some(same).filter(stands).or_else(|| floor.rest_in(to))?;
        let heading = belief.pose.heading + below.angle - above.angle;
        let height = |storey: Frame, cabin: Frame| storey.z.get() + cabin.z.get();
        let (_, here) = belief.world.placement(belief.area)?;
        Some(((map, Pose { at, heading }), height(above, frame) - height(below, here)))
    }

    /// Why the robot has no place in a cabin: a zone that is shut lies over it, or it does not fit.
    fn no_arrival(&self, to: AreaId) -> NoRoute {
        let world = &self.belief.world;
        let over = || {
            let (map, frame) = world.placement(to)?;
            let item = world.areas.get(&to)?.items.first()?;
            let corners: Vec<Point> = world.orthoframe_of(item).corners().collect();
            let sum = corners.iter().fold(Vector::zeros(), |sum, corner| sum + corner.coords);
            let middle = Point::from(sum / corners.len().max(1) as f64);
            let at = frame.compose(&item.frame).apply(middle);
            let zones = self.belief.floor_of(map)?.zones().iter();
            let mut shut = zones.filter(|zone| zone.kind.is_shut());
            shut.find(|zone| zone.contains(at, 0.0)).map(|zone| zone.id)
        };
        match over() {
            Some(zone) => NoRoute::Blocked { barriers: vec![Barrier::Zone { zone }] },
            None => NoRoute::NoFloor,
        }
    }

    /// A lift has opened its door.
    fn cabin_stands_at(&mut self, lift: &str, door: &str, opening: Option<DoorId>) {
        self.belief.cabins.insert(lift.to_owned(), door.to_owned());
        let state = opening.and_then(|id| self.belief.world.doors.get(&id)).map(|d| d.state);
        if let (Some(id), Some(state)) = (opening, state)
            && state.status != DoorStatus::Open
        {
            self.belief.set_door(id, DoorState::OPEN);
        }
    }

    fn set_door(
        &mut self,
        name: &str,
        status: DoorStatus,
        reins: &mut Reins<'_>,
    ) -> Result<(), Unfinished<Surprise>> {
        let door = self.door(name)?;
        let state = match status {
            DoorStatus::Open => DoorState::OPEN,
            DoorStatus::Closed => DoorState::CLOSED,
            DoorStatus::Locked => DoorState::LOCKED,
        };
        let area = self.belief.area;
        if state.status != DoorStatus::Open
            && let Err(by) = self.could_open_again(door, area)
        {
            return Err(Surprise::NoReturn { door, area, by }.into());
        }
        let set = reins.act(|vehicle, watch| vehicle.set_door(door, state, watch));
        set.map_err(|r| refused(r, reins))?;
        self.belief.set_door(door, state);
        Ok(())
    }

    /// Whether the robot, where it stands, could open a door again once it is shut: it gets to the place before the door on
    /// its own side, and stands there out of the way of the leaves, which nothing stops. What stops them, where not.
    fn could_open_again(&self, door: DoorId, area: AreaId) -> Result<(), Option<Obstruction>> {
        let belief = &self.belief;
        let Some(model) = belief.world.doors.get(&door) else { return Ok(()) };
        if model.state.status != DoorStatus::Open {
            return Ok(());
        }
        let shut = DoorStates::from([(door, DoorState::CLOSED)]);
        let floor = belief.floor().with_doors(&belief.world, &shut);
        let (from, before) = (belief.pose.at, Target::Door { door, area });
        let areas = Some(&[area][..]);
        let way = floor.route_within(&belief.world, from, before, Method::Shortest, areas);
        let stand = way.ok().and_then(|way| way.points.last().copied());
        if stand.is_some_and(|at| floor.opens_from(&belief.world, door, at)) {
            return Ok(());
        }
        Err(floor.struck_by(&belief.world, door).and_then(|blocker| match blocker {
            Blocker::Replica { replica, .. } | Blocker::ReplicaLeaf { replica, .. } => {
                Some(Obstruction::Replica(replica))
            }
            Blocker::DoorLeaf { door, .. } => Some(Obstruction::Door(door)),
            Blocker::Wall { area, .. } | Blocker::Floor { area, .. } => {
                Some(Obstruction::Wall(area))
            }
            // No leaf strikes what is but a rule.
            Blocker::Zone { .. } => None,
        }))
    }

    fn put(
        &mut self,
        thing: &str,
        onto: Option<&str>,
        reins: &mut Reins<'_>,
    ) -> Result<(), Unfinished<Surprise>> {
        let held = self.held(thing)?;
        let from = self.belief.pose;
        let (area, frame) = match onto {
            Some(name) => {
                let support = self.replica(name)?;
                // The thing is in the hand, not in the scene; its size is wanted, so it goes back for a moment.
                let mut world = self.belief.world.clone();
                let replica = self.belief.held.clone().expect("checked by held()");
                world.replicas.insert(replica.id, replica);
                let within = self.belief.into.contains(&(thing.to_owned(), name.to_owned()));
                let spot = if within { spot_in } else { spot_on };
                let near = self.beside(thing).unwrap_or(from.at);
                let frame = spot(&world, self.belief.scene(), held, support, near)
                    .ok_or(Surprise::Refused { refusal: Refusal::NoRoom(support), seen: None })?;
                (self.belief.world.replicas[&support].area, frame)
            }
            None => {
                let mut world = self.belief.world.clone();
                let replica = self.belief.held.clone().expect("checked by held()");
                world.replicas.insert(replica.id, replica);
                let (scene, area) = (self.belief.scene(), self.belief.area);
                let frame = spot_on_floor(&world, scene, held, area, from)
                    .ok_or(Surprise::Refused { refusal: Refusal::NoRoom(held), seen: None })?;
                (area, frame)
            }
        };
        let put = reins.act(|vehicle, watch| vehicle.put(held, area, frame, watch));
        if let Err(unfinished) = put {
            let support = onto.and_then(|name| self.replica(name).ok());
            // What should bear it is elsewhere, or bears what nobody knew of.
            let unfinished = match (unfinished, support) {
                (Unfinished::Met(Refusal::NoRoom(_)), Some(support)) => {
                    Unfinished::Met(match self.is_elsewhere(support, reins)? {
                        true => Refusal::NotThere(support),
                        false => Refusal::NoRoom(support),
                    })
                }
                (other, _) => other,
            };
            return Err(refused(unfinished, reins));
        }
        self.belief.set_down(area, frame);
        Ok(())
    }

    /// Whether a thing, at which the vehicle looks, is not where it is believed to be.
    fn is_elsewhere(
        &self,
        thing: ReplicaId,
        reins: &mut Reins<'_>,
    ) -> Result<bool, Unfinished<Surprise>> {
        let seen = reins.look_at(Obstruction::Replica(thing)).map_err(Unfinished::Failed)?;
        Ok(match (seen, self.belief.world.replicas.get(&thing)) {
            (Some(Sighting::Replica { area, frame, .. }), Some(believed)) => {
                (area, frame) != (believed.area, believed.frame)
            }
            (None, Some(_)) => true,
            _ => false,
        })
    }

    /// The middle of the thing beside which another is to be put.
    fn beside(&self, thing: &str) -> Option<Point> {
        let (_, other) = self.belief.beside.iter().find(|(what, _)| what == thing)?;
        let placed = self.belief.scene().replicas.get(&self.replica(other).ok()?)?;
        Some(nalgebra::center(&placed.bounds.min, &placed.bounds.max))
    }
}
