//! What stands in an Area (M4): replicas within its walls, places on its floor; and the robot's own numbers.

use std::collections::BTreeMap;

use crate::fault::{COORDINATE, MORE_THAN_0, MapError, Record, Spot, WITHIN};
use crate::units::{AreaId, Bilingual, Cm, Frame, Point, said, word};
use crate::{Replica, RobotProfile, World};

use super::group::Body;
use super::plane::{
    Bounds, border_distance, bounds, contains, difference, doubled_area, edges, meeting, middle,
};
use super::{Checker, at};

/// How far a replica may reach into a wall before it is worth a word, cm.
const DEPTH: f64 = 0.5;

/// The floor of an Area, from floor to ceiling.
struct Room {
    polygons: Vec<Vec<Point>>,
    boxes: Vec<Bounds>,
    floor: f64,
    ceiling: f64,
}

impl Checker<'_> {
    fn room(&self, area: AreaId) -> Option<Room> {
        let items = &self.world.areas.get(&area)?.items;
        if items.is_empty() || self.is_broken(Record::Area(area)) || !self.is_sound(items) {
            return None;
        }
        let bodies = self.bodies(items);
        Some(Room {
            floor: bodies.iter().map(|b| b.bottom).fold(f64::INFINITY, f64::min),
            ceiling: bodies.iter().map(|b| b.top).fold(f64::NEG_INFINITY, f64::max),
            boxes: bodies.iter().map(|b| b.bounds).collect(),
            polygons: bodies.into_iter().map(|b| b.polygon).collect(),
        })
    }

    pub(super) fn replicas(&mut self) {
        let world = self.world;
        match self.scope {
            None => self.some_replicas(world.replicas.values()),
            Some(scope) => {
                self.some_replicas(scope.replicas.iter().filter_map(|id| world.replicas.get(id)));
            }
        }
    }

    fn some_replicas<'r>(&mut self, replicas: impl Iterator<Item = &'r Replica>) {
        let mut rooms = BTreeMap::new();
        for replica in replicas {
            let area = replica.area;
            let room = rooms.entry(area).or_insert_with(|| self.room(area));
            self.replica(replica, room.as_ref());
        }
    }

    fn replica(&mut self, replica: &Replica, room: Option<&Room>) {
        let spot = Spot::of(Record::Replica(replica.id));
        let owner = Bilingual::quoted(&replica.name);
        if replica.move_prob > 100 {
            let value = f64::from(replica.move_prob);
            let at = spot.clone().field("move_prob");
            self.in_range("move_prob", value, false, word!("from-0-to-100"), at);
        }
        let is_finite = self.frame_is_finite(&replica.frame, &spot);
        let world = self.world;
        let area = world.areas.contains_key(&replica.area);
        self.exists(area, &owner, word!("area"), replica.area.0, spot.clone());
        let object = world.objects.get(&replica.object);
        let (id, what) = (replica.object.0, word!("object"));
        if !self.exists(object.is_some(), &owner, what, id, spot.clone()) {
            return;
        }
        self.replica_doors(replica, world, &spot);
        if let (Some(object), Some(room), true) = (object, room, is_finite)
            && !self.is_broken(Record::Object(object.id))
            && self.is_sound(&object.items)
        {
            let mut bodies = self.bodies(&object.items);
            bodies.iter_mut().for_each(|body| place(body, &replica.frame));
            self.within(replica, &bodies, room, &spot);
        }
    }

    /// A replica says how doors of its own stand, no others.
    fn replica_doors(&mut self, replica: &Replica, world: &World, spot: &Spot) {
        let object = &world.objects[&replica.object];
        for (&id, state) in &replica.door_states {
            let at = spot.clone().field("doors");
            match world.doors.get(&id) {
                Some(door) if object.doors.iter().any(|m| m.door == id) => {
                    self.state(door, state, &at);
                }
                Some(door) if !self.is_broken(Record::Object(object.id)) => {
                    let error = MapError::UnknownReference {
                        what: said!("door-of-this-object"),
                        name: door.name.clone(),
                        nearest: None,
                    };
                    self.fault(error, at);
                }
                Some(_) => {}
                None => {
                    let owner = Bilingual::quoted(&replica.name);
                    self.exists(false, &owner, word!("door-2"), id.0, at);
                }
            }
        }
    }

    fn within(&mut self, replica: &Replica, bodies: &[Body], room: &Room, spot: &Spot) {
        let area = &self.world.areas[&replica.area].name;
        let names = || (replica.name.clone(), area.clone());
        let (mut outside, mut whole) = (0.0, 0.0);
        let mut farthest: Option<(f64, Point)> = None;
        for body in bodies {
            whole += doubled_area(&body.polygon) / 2.0;
            if is_well_within(body, room) {
                continue;
            }
            let rest = difference(&body.polygon, &room.polygons);
            outside += rest.area;
            for p in rest.outlines.into_iter().flatten() {
                let depth = wall_distance(room, p);
                if depth > DEPTH && farthest.is_none_or(|(far, _)| depth > far) {
                    farthest = Some((depth, p));
                }
            }
        }
        if outside > whole / 2.0 {
            let corners = bodies.iter().flat_map(|b| b.polygon.iter().copied());
            let (low, high) = bounds(corners);
            let (replica, area) = names();
            let error = MapError::ReplicaOutside { replica, area, at: at(middle(&[low, high])) };
            self.fault(error, spot.clone().field("at"));
        } else if let Some((depth, p)) = farthest {
            let (replica, area) = names();
            let error =
                MapError::ReplicaThroughWall { replica, area, by: Cm::of(depth), at: at(p) };
            self.fault(error, spot.clone().field("at"));
        }
        let bottom = bodies.iter().map(|b| b.bottom).fold(f64::INFINITY, f64::min);
        let top = bodies.iter().map(|b| b.top).fold(f64::NEG_INFINITY, f64::max);
        if bottom < room.floor - DEPTH || top > room.ceiling + DEPTH {
            let (replica, area) = names();
            let (bottom, top) = (Cm::of(bottom), Cm::of(top));
            let (floor, ceiling) = (Cm::of(room.floor), Cm::of(room.ceiling));
            let error = MapError::ReplicaHeight { replica, area, bottom, top, floor, ceiling };
            self.fault(error, spot.clone().field("at"));
        }
    }

    pub(super) fn places(&mut self) {
        for place in self.world.places.values() {
            if self.scope.is_some_and(|scope| !scope.has_place(place)) {
                continue;
            }
            let spot = Spot::of(Record::Place(place.id));
            let owner = Bilingual::named(word!("place"), &place.name);
            let area = self.world.areas.get(&place.area);
            self.exists(area.is_some(), &owner, word!("area"), place.area.0, spot.clone());
            if let Some(replica) = place.serves {
                let exists = self.world.replicas.contains_key(&replica);
                let at = spot.clone().field("serves");
                self.exists(exists, &owner, word!("replica"), replica.0, at);
            }
            let at = spot.field("at");
            let wrong = [place.at.x, place.at.y].into_iter().find(|&c| Cm::new(c).is_err());
            if let Some(value) = wrong {
                self.in_range(COORDINATE, value, false, WITHIN, at);
            } else if let (Some(area), Some(room)) = (area, self.room(place.area))
                && !room.polygons.iter().any(|polygon| contains(polygon, place.at))
            {
                let (place, area) = (place.name.clone(), area.name.clone());
                self.fault(MapError::PlaceOutside { place, area }, at);
            }
        }
    }

    pub(super) fn robot(&mut self) {
        if self.is_broken(Record::Robot) {
            return;
        }
        let robot = &self.world.robot;
        let spot = Spot::of(Record::Robot);
        let numbers = [
            ("radius", robot.radius.get(), robot.radius.get() > 0.0),
            ("height", robot.height.get(), robot.height.get() > 0.0),
            ("step", robot.step.get(), robot.step.get() >= 0.0),
            ("clearance", robot.clearance.get(), robot.clearance.get() >= 0.0),
            ("speed", robot.speed, robot.speed > 0.0),
            ("turn_rate", robot.turn_rate, robot.turn_rate > 0.0),
        ];
        for (what, value, fits) in numbers {
            let range = if what == "step" || what == "clearance" {
                word!("at-least-0")
            } else {
                MORE_THAN_0
            };
            self.in_range(what, value, fits, range, spot.clone().field(what));
        }
        if let Err(reason) = footprint(robot) {
            self.fault(MapError::BadFootprint { reason }, spot.clone().field("footprint"));
        }
        if let Some(start) = robot.start {
            let exists = self.world.places.contains_key(&start);
            let (owner, what) = (said!("robot"), word!("place"));
            self.exists(exists, &owner, what, start.0, spot.field("start"));
        }
    }
}

/// Why a footprint is none.
fn footprint(robot: &RobotProfile) -> Result<(), Bilingual> {
    let corners = &robot.footprint;
    let n = corners.len();
    if n == 0 {
        return Ok(());
    }
    if n < 3 {
        return Err(said!("it-has-corners-and-needs-at-least", n));
    }
    for i in 0..n {
        let (a, b, c) = (corners[i], corners[(i + 1) % n], corners[(i + 2) % n]);
        if (b - a).perp(&(c - b)) <= 0.0 {
            let at = format!("({}, {})", b.x, b.y);
            return Err(said!("at-the-corner-it-does-not-turn", at));
        }
        if (b - a).perp(&-a.coords) <= 0.0 {
            return Err(said!("the-centre-0-0-round-which-the"));
        }
    }
    // Corners that each turn left may still run round twice.
    let turns: f64 = (0..n)
        .map(|i| {
            let (u, v) = (corners[i].coords, corners[(i + 1) % n].coords);
            u.perp(&v).atan2(u.dot(&v))
        })
        .sum();
    if turns > 7.0 {
        return Err(said!("it-crosses-itself"));
    }
    let reach = corners.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    if robot.radius.get() < reach - 1e-6 {
        let radius = robot.radius.get().to_string();
        return Err(said!("radius-too-small", radius, reach = format!("{reach:.2}")));
    }
    Ok(())
}

pub(super) fn place(body: &mut Body, frame: &Frame) {
    body.polygon.iter_mut().for_each(|p| *p = frame.apply(*p));
    body.bounds = bounds(body.polygon.iter().copied());
    body.bottom += frame.z.get();
    body.top += frame.z.get();
}

/// A quick look that spares most replicas the boolean operation: the body, made a little smaller, lies in one
/// polygon of the room and meets none of its walls.
fn is_well_within(body: &Body, room: &Room) -> bool {
    let centre = middle(&body.polygon);
    let shrunk: Vec<_> = body
        .polygon
        .iter()
        .map(|p| {
            let v = p - centre;
            p - v * (DEPTH / v.norm().max(DEPTH))
        })
        .collect();
    let (low, high) = body.bounds;
    room.polygons.iter().zip(&room.boxes).any(|(polygon, &(least, greatest))| {
        let may_hold = low.x >= least.x - DEPTH
            && low.y >= least.y - DEPTH
            && high.x <= greatest.x + DEPTH
            && high.y <= greatest.y + DEPTH;
        may_hold
            && shrunk.iter().all(|&p| contains(polygon, p))
            && !edges(&shrunk).any(|e| {
                let (a, b) = bounds([e.0, e.1]);
                edges(polygon).any(|f| {
                    let (c, d) = bounds([f.0, f.1]);
                    let apart = d.x < a.x || c.x > b.x || d.y < a.y || c.y > b.y;
                    !apart && meeting(e, f).is_some()
                })
            })
    })
}

/// How far outside the room a point lies, cm.
fn wall_distance(room: &Room, p: Point) -> f64 {
    if room.polygons.iter().any(|polygon| contains(polygon, p)) {
        return 0.0;
    }
    room.polygons.iter().map(|q| border_distance(q, p)).fold(f64::INFINITY, f64::min)
}
