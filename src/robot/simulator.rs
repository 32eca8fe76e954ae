//! The simulated robot (X1): a disc, or a convex footprint, that turns on the spot and drives straight, among the
//! prisms and door leaves of a world of its own.
//!
//! That world is the truth; it may differ from the Map that a mission believes, and then the robot bumps.
//! Collisions are found by casting its shape along each straight piece, and by the arcs on which corners pass edges
//! in a turn (exact between the end points, no time steps), independent of the free floor that the route was made
//! from. Time is simulated; nothing is random, so a run repeats itself.

use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

use parry2d_f64::math::{Pose as ShapePose, Vector as ShapeVector};
use parry2d_f64::query::intersection_test;
use parry2d_f64::shape::Segment;

use crate::geometry::{
    Bounds, LIFT_WAIT, Leaves, Opening, Openings, Owner, PlacedReplica, Polygon, Prism, Ride,
    STEP_REACH, Scene, opening_of,
};
use crate::map::{
    Door, DoorState, DoorStatus, Permeability, Replica, RobotProfile, World, set_open, stands,
    switch,
};
use crate::semantics::{RelationRules, cargo, shut_around};
use crate::units::{AreaId, Deg, DoorId, Frame, MapId, Point, Pose, ReplicaId};

use super::belief::frame_aboard;
use super::eye::View;
use super::placing::{rests, slides};
use super::timing::{CALL_TIME, DOOR_TIME, GRASP_TIME, PUSH_TIME, SWITCH_TIME};
use super::vehicle::{
    Bump, Done, Failure, Moment, Notice, Obstruction, Refusal, Sighting, Unfinished, Vehicle, Watch,
};

mod contact;
mod laser;
mod people;
pub(super) mod senses;

use contact::placed;

/// What rests on what in the simulated world.
static NATURE: LazyLock<RelationRules> = LazyLock::new(RelationRules::standard);
/// How far the arm of the simulated body reaches beyond its footprint, cm.
const ARM_REACH: f64 = 90.0;
/// How often a motion tells of itself and can be stopped, seconds of simulated time.
const STEP: f64 = 0.25;
/// Contacts shallower than this are rounding of coordinates, not bumps, cm.
const SKIN: f64 = 0.01;

/// An edge that the robot must not touch.
#[derive(Debug, Clone, Copy)]
struct Edge {
    a: Point,
    b: Point,
    of: Obstruction,
}

/// A robot in a world of its own.
#[derive(Debug)]
pub struct Simulator {
    truth: World,
    map: MapId,
    profile: RobotProfile,
    pose: Pose,
    time: f64,
    held: Option<Replica>,
    /// What lies on and in the thing in the hand.
    aboard: Vec<Replica>,
    /// What people were given, each with what lies on and in it.
    given: Vec<(Replica, Vec<Replica>)>,
    edges: Vec<Edge>,
    /// As they are in truth.
    openings: Arc<Openings>,
    trace: Vec<Moment>,
    calls: Vec<String>,
    /// The speed that it keeps to, cm/s, where it was told one.
    pace: Option<f64>,
}

impl Simulator {
    /// Puts the robot of `truth` down at a pose of one of its Maps.
    #[must_use]
    pub fn new(truth: World, map: MapId, pose: Pose) -> Self {
        let profile = truth.robot.clone();
        let openings = Arc::new(Openings::of(&truth, STEP_REACH));
        let mut simulator = Self {
            truth,
            map,
            profile,
            pose,
            time: 0.0,
            held: None,
            aboard: Vec::new(),
            given: Vec::new(),
            edges: Vec::new(),
            openings,
            trace: vec![Moment { time: 0.0, map, pose }],
            calls: Vec::new(),
            pace: None,
        };
        simulator.rebuild();
        simulator
    }

    /// The same robot where doors lead through walls as thick as that, cm: as the rules have it by which its map is read.
    #[must_use]
    pub fn through_walls(mut self, thickness: f64) -> Self {
        self.openings = Arc::new(Openings::of(&self.truth, thickness));
        self.rebuild();
        self
    }

    /// The same robot with a thing in its hand and others given to people, each with what lies on and in it: of `aboard`
    /// that which goes with it. They then are not in its world.
    #[must_use]
    pub fn laden(
        mut self,
        held: Option<Replica>,
        given: &[(Replica, String)],
        aboard: &[(Replica, ReplicaId)],
    ) -> Self {
        let with = |carrier: ReplicaId| -> Vec<Replica> {
            let along = aboard.iter().filter(|(_, on)| *on == carrier);
            along.map(|(thing, _)| thing.clone()).collect()
        };
        self.aboard = held.as_ref().map_or_else(Vec::new, |held| with(held.id));
        self.held = held;
        self.given = given.iter().map(|(thing, _)| (thing.clone(), with(thing.id))).collect();
        let given = self.given.iter().flat_map(|(thing, with)| std::iter::once(thing).chain(with));
        let gone = self.held.iter().chain(&self.aboard).chain(given);
        for id in gone.map(|thing| thing.id).collect::<Vec<_>>() {
            self.truth.replicas.remove(&id);
        }
        self.rebuild();
        self
    }

    /// What lies on and in a thing, by the rules that the crate brings along: in the simulated world things rest on each
    /// other as they do there, whatever rules a map is read by.
    fn cargo(&self, thing: ReplicaId) -> BTreeSet<ReplicaId> {
        let scene = Scene::of(&self.truth, self.map);
        cargo(&self.truth, &NATURE, &scene, thing).unwrap_or_default()
    }

    /// The shut thing in which a thing is.
    fn shut_in(&self, thing: ReplicaId) -> Option<ReplicaId> {
        let scene = Scene::of(&self.truth, self.map);
        let shut = |thing| shut_around(&self.truth, &NATURE, &scene, thing).ok().flatten();
        let around = shut(thing)?;
        // A dishwasher has a door of its own to the room, though the counter into which it is built is shut.
        let has_own_way = |r: &Replica| {
            let is_shut =
                matches!(stands(&self.truth, r), Some(DoorStatus::Closed | DoorStatus::Locked));
            let fixed = !self.truth.has_trait(r.id, "portable");
            let holds = is_within(&scene, thing, r.id) && !is_within(&scene, around, r.id);
            fixed && !is_shut && holds && shut(r.id).is_none()
        };
        (!self.truth.replicas.values().any(has_own_way)).then_some(around)
    }

    /// Every moment at which the motion changed.
    #[must_use]
    pub fn trace(&self) -> &[Moment] {
        &self.trace
    }

    /// The world as it really is now.
    #[must_use]
    pub fn truth(&self) -> &World {
        &self.truth
    }

    /// The world as it really is now, when the robot is no longer wanted.
    #[must_use]
    pub fn into_truth(self) -> World {
        self.truth
    }

    /// What stands where the robot stands, so that it could not move; none where its place is free.
    #[must_use]
    pub fn stands_in(&self) -> Option<Obstruction> {
        let (body, at) = (self.body(), placed(self.pose));
        let near = Bounds::of([self.pose.at]).grown(self.profile.radius.get());
        let still = ShapePose::identity();
        let touched = self.edges.iter().filter(|e| Bounds::of([e.a, e.b]).meets(&near)).find(|e| {
            let edge = Segment::new(ShapeVector::new(e.a.x, e.a.y), ShapeVector::new(e.b.x, e.b.y));
            intersection_test(&at, &*body, &still, &edge)
                .expect("parry tests a ball or a polygon against a segment")
                .intersecting
        });
        let scene = Scene::of(&self.truth, self.map);
        let within = || {
            let around =
                |p: &&Prism| self.is_in_the_way(p) && p.polygon.contains(self.pose.at, 0.0);
            scene.replicas.values().find(|r| r.prisms.iter().any(|p| around(&p)))
        };
        touched.map(|e| e.of).or_else(|| within().map(|r| Obstruction::Replica(r.id)))
    }

    /// Whom it has called, in order.
    #[must_use]
    pub fn calls(&self) -> &[String] {
        &self.calls
    }

    /// Edges of everything within the robot's height, walls and door leaves.
    fn rebuild(&mut self) {
        let scene = Scene::of(&self.truth, self.map);
        let mut edges = Vec::new();
        for prism in scene.areas.values().flat_map(|a| &a.prisms) {
            let Owner::Area(area) = prism.owner else { continue };
            for ((a, b), side) in prism.polygon.edges().zip(prism.sides.iter()) {
                if side.permeability == Permeability::Impermeable {
                    edges.push(Edge { a, b, of: Obstruction::Wall(area) });
                }
            }
        }
        for replica in scene.replicas.values() {
            for prism in replica.prisms.iter().filter(|p| self.is_in_the_way(p)) {
                edges.extend(edges_of(&prism.polygon, Obstruction::Replica(replica.id)));
            }
        }
        for doorway in self.doorways() {
            let Some(door) = doorway.door else { continue };
            for leaf in self.leaves(doorway, door, self.truth.doors[&door].state) {
                edges.extend(edges_of(&leaf, Obstruction::Door(door)));
            }
        }
        self.edges = edges;
    }

    /// The openings of the Map on which the robot is through which one can pass.
    fn doorways(&self) -> impl Iterator<Item = &Opening> {
        self.openings.iter().filter(|o| o.map == self.map && o.is_through())
    }

    fn leaves(&self, doorway: &Opening, door: DoorId, state: DoorState) -> Vec<Polygon> {
        doorway.leaves(&self.truth.doors[&door]).obstacles(state)
    }

    /// What stops the leaves of a door on their way to another state.
    fn jam(&self, door: DoorId, model: &Door, state: DoorState) -> Option<Refusal> {
        let openings = (opening_of(model.state), opening_of(state));
        let (at, radius) = (self.pose.at, self.profile.radius.get() - SKIN);
        let scene = Scene::of(&self.truth, self.map);
        self.doorways().filter(|d| d.door == Some(door)).find_map(|doorway| {
            let leaves = doorway.leaves(model);
            let mut ways = leaves.swept(openings).into_iter().chain(leaves.obstacles(state));
            if ways.any(|way| way.contains(at, radius)) {
                let opening = openings.0 as u8;
                return Some(Refusal::DoorJammed { door, by: None, opening });
            }
            let solids = self.solids_before(doorway, &leaves, &scene);
            let strike = leaves.strikes(openings, solids.iter().map(|(of, body)| (*of, body)))?;
            let (by, opening) = (Some(strike.against), strike.opening as u8);
            Some(Refusal::DoorJammed { door, by, opening })
        })
    }

    /// What stands about a doorway at the height of its leaves: things, and leaves of other doors.
    fn solids_before(
        &self,
        doorway: &Opening,
        leaves: &Leaves<'_>,
        scene: &Scene,
    ) -> Vec<(Obstruction, Polygon)> {
        let room = scene.areas.get(&doorway.areas[0]).and_then(|a| a.prisms.first());
        let space = leaves.space(room.map_or(0.0, |prism| prism.bottom));
        let things = scene.replicas.values().flat_map(|r| {
            let met = r.prisms.iter().filter(move |p| space.meets(p));
            met.map(move |p| (Obstruction::Replica(r.id), p.polygon.clone()))
        });
        let others = self.doorways().filter(|d| d.door != doorway.door);
        let leaves = others.flat_map(|d| {
            let door = d.door.filter(|id| self.truth.doors.contains_key(id));
            let leaves = door.map(|id| (id, self.leaves(d, id, self.truth.doors[&id].state)));
            leaves.into_iter().flat_map(|(id, all)| {
                all.into_iter().map(move |leaf| (Obstruction::Door(id), leaf))
            })
        });
        things.chain(leaves.filter(|(_, leaf)| leaf.bounds().meets(&space.near))).collect()
    }

    fn is_in_the_way(&self, prism: &Prism) -> bool {
        prism.bottom < self.profile.height.get() && prism.top > self.profile.step.get()
    }

    /// Turns on the spot, by the shorter way.
    fn turn_to(&mut self, heading: Deg, watch: &mut Watch<'_>) -> Result<(), Unfinished<Bump>> {
        let turn = (heading - self.pose.heading).signed();
        if let Some((angle, against)) = self.contact_in_turn(turn) {
            let skin = (SKIN / self.profile.radius.get()).to_degrees();
            let done = (angle - skin).max(0.0);
            let heading = self.pose.heading + Deg::of(done * turn.signum());
            self.move_to(done / self.profile.turn_rate, Pose { heading, ..self.pose }, watch)?;
            return Err(Bump { at: self.pose, against }.into());
        }
        self.move_to(turn.abs() / self.profile.turn_rate, Pose { heading, ..self.pose }, watch)
    }

    /// Moves evenly from here to a pose, and stops between two small steps of time when it is told to.
    fn move_to<Why>(
        &mut self,
        duration: f64,
        to: Pose,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Why>> {
        let (from, begun) = (self.pose, self.time);
        let turn = (to.heading - from.heading).signed();
        let mut passed = 0.0;
        while passed + STEP < duration {
            watch.check()?;
            passed += STEP;
            let share = passed / duration;
            let at = from.at + (to.at - from.at) * share;
            let pose = Pose { at, heading: from.heading + Deg::of(turn * share) };
            let (map, time) = (self.map, begun + passed);
            watch.notice(&Notice::Moved(Moment { time, map, pose }));
            if watch.is_stopped() {
                self.advance(passed, pose);
                return Err(Unfinished::Stopped);
            }
        }
        watch.check()?;
        self.advance(duration, to);
        let (map, time) = (self.map, self.time);
        watch.notice(&Notice::Moved(Moment { time, map, pose: to }));
        Ok(())
    }

    fn advance(&mut self, duration: f64, pose: Pose) {
        self.time += duration;
        self.pose = pose;
        if duration > 0.0 {
            self.trace.push(Moment { time: self.time, map: self.map, pose });
        }
    }

    fn let_go(&mut self, thing: ReplicaId) -> Result<Replica, Refusal> {
        let replica = self.held.take_if(|held| held.id == thing).ok_or(Refusal::NotHeld(thing))?;
        self.advance(GRASP_TIME, self.pose);
        Ok(replica)
    }

    /// The doors of a lift open by themselves, unless they are locked.
    fn open_for_lift(&mut self, door: Option<DoorId>) -> Result<(), Refusal> {
        let Some(door) = door else { return Ok(()) };
        match self.truth.doors.get(&door).map(|model| model.state.status) {
            Some(DoorStatus::Closed) => self.swing(door, DoorState::OPEN),
            Some(DoorStatus::Locked) => Err(Refusal::Locked(door)),
            Some(DoorStatus::Open) | None => Ok(()),
        }
    }

    fn reaches(&self, thing: ReplicaId) -> Result<bool, Refusal> {
        let scene = Scene::of(&self.truth, self.map);
        let placed = scene.replicas.get(&thing).ok_or(Refusal::NotThere(thing))?;
        Ok(beyond_arm(placed, self.pose.at, self.profile.radius.get()) <= 0.0)
    }
}

/// How much farther a thing is than the arm of a robot of some radius reaches, cm; negative within its reach.
#[must_use]
pub fn beyond_arm(thing: &PlacedReplica, robot: Point, radius: f64) -> f64 {
    let Bounds { min, max } = thing.bounds;
    let nearest = Point::new(robot.x.clamp(min.x, max.x), robot.y.clamp(min.y, max.y));
    (nearest - robot).norm() - radius - ARM_REACH
}

impl Simulator {
    /// The leaves stop against a robot or a thing that stands anywhere on their way.
    fn swing(&mut self, door: DoorId, state: DoorState) -> Result<(), Refusal> {
        let Some(model) = self.truth.doors.get(&door) else {
            return Err(Refusal::DoorJammed { door, by: None, opening: 0 });
        };
        if model.state.status == DoorStatus::Locked && state.status == DoorStatus::Open {
            return Err(Refusal::Locked(door));
        }
        if let Some(jam) = self.jam(door, model, state) {
            return Err(jam);
        }
        self.truth.doors.get_mut(&door).expect("found above").state = state;
        self.rebuild();
        self.advance(DOOR_TIME, self.pose);
        Ok(())
    }
}

/// A drive is stopped between two small steps of time; what hand, doors and lifts do is done at once when it is begun.
impl Vehicle for Simulator {
    fn pose(&self) -> (MapId, Pose) {
        (self.map, self.pose)
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn follow(
        &mut self,
        path: &[Point],
        heading: Option<Deg>,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        watch.check()?;
        for &goal in path {
            let way = goal - self.pose.at;
            let length = way.norm();
            if length < 1e-6 {
                continue;
            }
            self.turn_to(Deg::from_radians(way.y.atan2(way.x)), watch)?;
            let contact = self.first_contact(goal);
            let driven = contact.map_or(length, |(distance, _)| (distance - SKIN).max(0.0));
            let at = self.pose.at + way * (driven / length);
            let speed = self.pace.map_or(self.profile.speed, |pace| pace.min(self.profile.speed));
            self.move_to(driven / speed, Pose { at, ..self.pose }, watch)?;
            if let Some((_, against)) = contact {
                return Err(Bump { at: self.pose, against }.into());
            }
        }
        if let Some(heading) = heading {
            self.turn_to(heading, watch)?;
        }
        Ok(())
    }

    fn keep_to(&mut self, pace: Option<f64>) {
        self.pace = pace;
    }

    fn set_door(&mut self, door: DoorId, state: DoorState, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        Ok(self.swing(door, state)?)
    }

    fn call_lift(&mut self, door: Option<DoorId>, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        self.advance(LIFT_WAIT, self.pose);
        Ok(self.open_for_lift(door)?)
    }

    fn ride(
        &mut self,
        ride: &Ride,
        door: Option<DoorId>,
        (map, pose): (MapId, Pose),
        watch: &mut Watch<'_>,
    ) -> Done {
        watch.check()?;
        self.map = map;
        self.advance(ride.seconds() - LIFT_WAIT, pose);
        self.rebuild();
        Ok(self.open_for_lift(door)?)
    }

    fn set_open(&mut self, thing: ReplicaId, open: bool, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        if !self.reaches(thing)? {
            return Err(Refusal::OutOfReach(thing).into());
        }
        let replica = self.truth.replicas.get(&thing).ok_or(Refusal::NotThere(thing))?;
        let status = stands(&self.truth, replica);
        if !self.profile.opens || matches!(status, None | Some(DoorStatus::Locked)) {
            return Err(Refusal::Shut(thing).into());
        }
        let object = self.truth.objects[&replica.object].clone();
        if let Some(replica) = self.truth.replicas.get_mut(&thing) {
            set_open(replica, &object, open);
        }
        self.advance(DOOR_TIME, self.pose);
        Ok(())
    }

    /// In a straight line, past nothing that it would touch on its way.
    fn push(
        &mut self,
        thing: ReplicaId,
        area: AreaId,
        frame: Frame,
        watch: &mut Watch<'_>,
    ) -> Done {
        watch.check()?;
        if !self.reaches(thing)? {
            return Err(Refusal::OutOfReach(thing).into());
        }
        let replica = self.truth.replicas.get(&thing).ok_or(Refusal::NotThere(thing))?.clone();
        if !self.truth.has_trait(thing, "movable") || replica.area != area {
            return Err(Refusal::Stays(thing).into());
        }
        let me = (self.pose.at, self.profile.radius.get());
        if !slides(&self.truth, self.map, &replica, &frame, me) {
            return Err(Refusal::Stays(thing).into());
        }
        for id in self.cargo(thing) {
            let Some(carried) = self.truth.replicas.get(&id).cloned() else { continue };
            let frame = frame_aboard(&self.truth, &replica, &carried, &frame);
            self.truth.replicas.insert(id, Replica { area, frame, ..carried });
        }
        self.truth.replicas.insert(thing, Replica { area, frame, ..replica });
        self.rebuild();
        self.advance(PUSH_TIME, self.pose);
        Ok(())
    }

    fn take(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        if let Some(held) = &self.held {
            return Err(Refusal::HandFull(held.id).into());
        }
        if !self.reaches(thing)? {
            return Err(Refusal::OutOfReach(thing).into());
        }
        if let Some(around) = self.shut_in(thing) {
            return Err(Refusal::Shut(around).into());
        }
        for id in self.cargo(thing) {
            self.aboard.extend(self.truth.replicas.remove(&id));
        }
        self.held = self.truth.replicas.remove(&thing);
        self.rebuild();
        self.advance(GRASP_TIME, self.pose);
        Ok(())
    }

    /// What would fall, or stand within another thing, is kept in the hand.
    fn put(&mut self, thing: ReplicaId, area: AreaId, frame: Frame, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        if let Some(held) = self.held.as_ref().filter(|held| held.id == thing) {
            let there = Replica { area, frame, ..held.clone() };
            self.truth.replicas.insert(thing, there);
            let stays = rests(&Scene::of(&self.truth, self.map), thing);
            let shut = self.shut_in(thing);
            self.truth.replicas.remove(&thing);
            // A hand gets into nothing that is shut.
            if let Some(around) = shut {
                return Err(Refusal::Shut(around).into());
            }
            if !stays {
                return Err(Refusal::NoRoom(thing).into());
            }
        }
        let replica = self.let_go(thing)?;
        for carried in std::mem::take(&mut self.aboard) {
            let frame = frame_aboard(&self.truth, &replica, &carried, &frame);
            self.truth.replicas.insert(carried.id, Replica { area, frame, ..carried });
        }
        self.truth.replicas.insert(thing, Replica { area, frame, ..replica });
        self.rebuild();
        Ok(())
    }

    fn hand_over(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        let replica = self.let_go(thing)?;
        self.given.push((replica, std::mem::take(&mut self.aboard)));
        Ok(())
    }

    fn take_back(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        if let Some(held) = &self.held {
            return Err(Refusal::HandFull(held.id).into());
        }
        let at = self.given.iter().position(|(given, _)| given.id == thing);
        let (thing, with) = self.given.remove(at.ok_or(Refusal::NotThere(thing))?);
        (self.held, self.aboard) = (Some(thing), with);
        self.advance(GRASP_TIME, self.pose);
        Ok(())
    }

    fn switch(&mut self, device: ReplicaId, on: bool, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        if !self.reaches(device)? {
            return Err(Refusal::OutOfReach(device).into());
        }
        let replica = self.truth.replicas.get_mut(&device).ok_or(Refusal::NotThere(device))?;
        switch(&mut replica.properties, on);
        self.advance(SWITCH_TIME, self.pose);
        Ok(())
    }

    fn call(&mut self, person: &str, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        self.calls.push(person.to_owned());
        self.advance(CALL_TIME, self.pose);
        Ok(())
    }

    fn look_round(&mut self, watch: &mut Watch<'_>) -> Done {
        watch.check()?;
        self.advance(360.0 / self.profile.turn_rate, self.pose);
        Ok(())
    }

    fn sees(&mut self, thing: ReplicaId) -> Result<Option<Sighting>, Failure> {
        let scene = Scene::of(&self.truth, self.map);
        Ok(self.sighting(thing).filter(|_| self.is_in_view(thing, &scene)))
    }

    fn look_at(&mut self, what: Obstruction) -> Result<Option<Sighting>, Failure> {
        Ok(match what {
            Obstruction::Wall(_) | Obstruction::Something => None,
            Obstruction::Door(door) => {
                self.truth.doors.get(&door).map(|d| Sighting::Door { door, state: d.state })
            }
            Obstruction::Replica(thing) => {
                self.sighting(thing).filter(|_| self.is_before_eyes(thing))
            }
        })
    }
}

impl Simulator {
    fn sighting(&self, replica: ReplicaId) -> Option<Sighting> {
        let there = self.truth.replicas.get(&replica)?;
        Some(Sighting::Replica { replica, area: there.area, frame: there.frame })
    }

    /// Whether there is anything to see of a thing from here: it is in the same Area, touched by the arm, or in view of
    /// another one.
    fn is_before_eyes(&self, thing: ReplicaId) -> bool {
        let scene = Scene::of(&self.truth, self.map);
        let area = self.truth.replicas.get(&thing).map(|replica| replica.area);
        area.is_some() && area == scene.area_at(self.pose.at)
            || self.reaches(thing) == Ok(true)
            || self.is_in_view(thing, &scene)
    }

    fn is_in_view(&self, thing: ReplicaId, scene: &Scene) -> bool {
        let Some(placed) = scene.replicas.get(&thing) else { return false };
        let eye = (self.pose.at, self.profile.height.get());
        let is_wall = |e: &&Edge| !matches!(e.of, Obstruction::Replica(_));
        let walls = self.edges.iter().filter(is_wall).map(|e| (e.a, e.b)).collect();
        let others = scene.replicas.values().filter(|r| r.id != thing);
        let view = View { walls, bodies: others.flat_map(|r| &r.prisms).collect() };
        placed.prisms.iter().any(|p| {
            let at = p.polygon.centroid();
            (at - eye.0).norm() <= SIGHT_RANGE
                && [(p.bottom + p.top) / 2.0, p.top].iter().any(|&z| view.is_clear(eye, (at, z)))
        })
    }
}

/// How far the eye of the simulated body tells a thing from others, cm; what is spoken of is nearer («robot sight»).
const SIGHT_RANGE: f64 = 1_000.0;

fn edges_of(polygon: &Polygon, of: Obstruction) -> impl Iterator<Item = Edge> + '_ {
    polygon.edges().map(move |(a, b)| Edge { a, b, of })
}

/// Whether a thing stands within the outline and the height of another.
fn is_within(scene: &Scene, thing: ReplicaId, around: ReplicaId) -> bool {
    let (Some(own), Some(outer)) = (scene.replicas.get(&thing), scene.replicas.get(&around)) else {
        return false;
    };
    let beside = outer.bounds.contains(own.bounds.min) && outer.bounds.contains(own.bounds.max);
    thing != around && beside && outer.bottom <= own.bottom && own.top <= outer.top
}
