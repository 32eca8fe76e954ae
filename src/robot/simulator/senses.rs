//! [`SensingRobot`]: the simulated robot as one that knows its world by its senses alone (X4): wheels that slip, a laser
//! that errs, a bumper, an eye that names what is in view, and locks that it finds shut when it tries them.
//!
//! Where it stands it does not know: its pose is what its wheels tell, from where they began to count. What drives by it
//! finds itself (`robot/pilot`). People walk about, and lifts keep it waiting.
//!
//! **Invariant**: all that is random is drawn from one seed, so a run repeats itself. The truth is handed out to judges
//! alone ([`SensingRobot::body`]); no order's answer tells of it but what a sense would.

use fastrand::Rng;

use crate::geometry::{Ride, opening_of};
use crate::map::{DoorState, World};
use crate::units::{AreaId, Deg, DoorId, Frame, MapId, Point, Pose, ReplicaId, Vector};
use crate::vehicle::protocol::Scan;
use crate::vehicle::{
    Bump, Done, Failure, Moment, Notice, Obstruction, Refusal, Sighting, Unfinished, Vehicle, Watch,
};

use super::laser::Faces;
use super::people::{GIRTH, Walker};
use super::{SKIN, Simulator};

/// How the senses err, and what else there is in the world of a [`SensingRobot`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Senses {
    /// All that is random is drawn from it.
    pub seed: u64,
    /// Deviation of what the wheels tell after a metre, as a share of it, and of a turn by a right angle as a share of
    /// that; it grows with the root of the way.
    pub slip: f64,
    /// Of a range, cm.
    pub noise: f64,
    /// Share of the beams of which nothing comes back.
    pub dropouts: f64,
    /// Of the laser, above the Map's zero, cm.
    pub height: f64,
    /// Evenly around, the first straight ahead.
    pub beams: usize,
    /// Cm.
    pub reach: f64,
    /// People who walk about.
    pub people: usize,
    /// A lift comes up to so much later than it might, seconds.
    pub lift_delay: f64,
}

impl Senses {
    /// An ordinary robot in an ordinary house: odometry 3 %, ranges 2 cm, one beam in a hundred lost, a lift that takes up
    /// to a minute longer, nobody about.
    #[must_use]
    pub fn of_seed(seed: u64) -> Self {
        Self {
            seed,
            slip: 0.03,
            noise: 2.0,
            dropouts: 0.01,
            height: 20.0,
            beams: 360,
            reach: 1_000.0,
            people: 0,
            lift_delay: 60.0,
        }
    }
}

/// The wheels turn in steps of so much, cm and degrees; a step slips by itself.
const STEP: (f64, f64) = (5.0, 5.0);
/// The laser turns once in so many seconds while the robot moves.
const LOOK: f64 = 0.25;
/// Degrees by which the heading slips on a metre of way, per share of slip.
const SWERVE: f64 = 30.0;

/// So long it waits for people who stand in the way of a leaf, seconds.
const PATIENCE: usize = 20;

/// The simulated robot behind its senses.
pub struct SensingRobot {
    body: Simulator,
    senses: Senses,
    dice: Rng,
    faces: Faces,
    people: Vec<Walker>,
    /// Until when they have walked.
    walked: f64,
    /// What the wheels tell: where it stands from where it began.
    odometry: Pose,
    /// When the laser last turned.
    looked: f64,
    touched: Vec<Touch>,
}

/// A contact of a [`SensingRobot`], as a judge of its drive knows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Where the robot truly was.
    pub at: Pose,
    /// What it touched; none: somebody.
    pub what: Option<Obstruction>,
}

impl std::fmt::Debug for SensingRobot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SensingRobot").field("senses", &self.senses).finish_non_exhaustive()
    }
}

impl SensingRobot {
    /// The robot that `body` is, where that truly stands. Its wheels begin to count at zero.
    #[must_use]
    pub fn new(body: Simulator, senses: Senses) -> Self {
        let mut dice = Rng::with_seed(senses.seed);
        let faces = Faces::of(&body, senses.height);
        let people = (0..senses.people).filter_map(|_| Walker::appear(&body, &mut dice)).collect();
        let odometry = Pose { at: Point::origin(), heading: Deg::ZERO };
        let walked = body.time;
        Self {
            body,
            senses,
            dice,
            faces,
            people,
            walked,
            odometry,
            looked: walked,
            touched: Vec::new(),
        }
    }

    /// The robot as it truly is, for who judges a drive.
    #[must_use]
    pub fn body(&self) -> &Simulator {
        &self.body
    }

    /// The world as it really is now, when the robot is no longer wanted.
    #[must_use]
    pub fn into_truth(self) -> World {
        self.body.into_truth()
    }

    /// All that it touched.
    #[must_use]
    pub fn touched(&self) -> &[Touch] {
        &self.touched
    }

    /// Somebody lifts it up and sets it down elsewhere: its wheels tell nothing of that.
    pub fn carry_off(&mut self, to: Pose) {
        self.body.pose = to;
    }

    /// Where people on the robot's Map are, as discs.
    #[must_use]
    pub fn people(&self) -> Vec<(Point, f64)> {
        let here = self.people.iter().filter(|walker| walker.is_on(self.body.map));
        here.map(|walker| (walker.at, GIRTH)).collect()
    }

    /// Time has passed: people walked.
    fn catch_up(&mut self) {
        let (from, to) = (self.walked, self.body.time);
        for walker in &mut self.people {
            walker.walk(&self.body, from, to, &mut self.dice);
        }
        self.walked = to;
    }

    /// A draw from the normal law of deviation 1 (Box and Muller, 1958).
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.dice.f64()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.dice.f64()).cos()
    }

    fn scan(&mut self) -> Scan {
        let people = self.people();
        let step = 360.0 / self.senses.beams as f64;
        let ranges = (0..self.senses.beams)
            .map(|beam| {
                let bearing = (beam as f64 * step).to_radians();
                let met = self.faces.cast(self.body.pose, bearing, self.senses.reach, &people);
                let noise = self.normal() * self.senses.noise;
                let is_lost = self.dice.f64() < self.senses.dropouts;
                let range = (met? + noise).max(0.1);
                // Whole millimetres, as such a sensor tells them.
                (!is_lost).then_some((range * 10.0).round() / 10.0)
            })
            .collect();
        Scan { height: self.senses.height, from: 0.0, step, ranges }
    }

    /// Tells where the wheels hold it to be and, when it is time or must be, what the laser sees from there.
    fn tell(&mut self, watch: &mut Watch<'_>, must_look: bool) {
        self.catch_up();
        let (time, map, pose) = (self.body.time, self.body.map, self.odometry);
        watch.notice(&Notice::Moved(Moment { time, map, pose }));
        if must_look || time - self.looked >= LOOK {
            self.looked = time;
            let scan = self.scan();
            watch.notice(&Notice::Scanned(scan));
        }
    }

    fn bump(&mut self, what: Option<Obstruction>) -> Unfinished<Bump> {
        self.touched.push(Touch { at: self.body.pose, what });
        Bump { at: self.odometry, against: Obstruction::Something }.into()
    }

    /// How far it gets on a straight way before it touches something, or somebody, of whom it is told as nothing.
    fn free_way(&self, goal: Point) -> Option<(f64, Option<Obstruction>)> {
        let (from, way) = (self.body.pose.at, goal - self.body.pose.at);
        let length = way.norm();
        let thing = self.body.first_contact(goal).map(|(distance, what)| (distance, Some(what)));
        let girth = self.body.profile.radius.get() + GIRTH;
        let person = self.people().into_iter().filter_map(|(at, _)| {
            let to = at - from;
            let along = to.dot(&way) / length;
            let half = (girth * girth - (to.norm_squared() - along * along)).sqrt();
            // Nobody is run through who is touched already and behind.
            (along > 0.0 && along - half <= length).then(|| ((along - half).max(0.0), None))
        });
        thing.into_iter().chain(person).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Drives straight ahead by what the wheels tell.
    fn drive(&mut self, length: f64, watch: &mut Watch<'_>) -> Result<(), Unfinished<Bump>> {
        let mut left = length;
        while left > 1e-9 {
            watch.check()?;
            let step = STEP.0.min(left);
            // Deviations add up as roots do: after a metre they are `slip` of it.
            let spread = self.senses.slip * (100.0 * step).sqrt();
            let (ahead, aside) = (step + self.normal() * spread, self.normal() * spread * 0.2);
            let swerve = self.normal() * self.senses.slip * SWERVE * (step / 100.0).sqrt();
            let along = heading_of(self.body.pose);
            let way = along * ahead.max(0.0) + Vector::new(-along.y, along.x) * aside;
            let length = way.norm().max(1e-9);
            let goal = self.body.pose.at + way;
            let contact = self.free_way(goal);
            let share = contact.map_or(1.0, |(free, _)| ((free - SKIN).max(0.0) / length).min(1.0));
            let at = self.body.pose.at + way * share;
            let (turned, _) = self.turned(swerve * share);
            let heading = self.body.pose.heading + Deg::of(turned);
            self.body.advance(step * share / self.body.profile.speed, Pose { at, heading });
            self.odometry.at += heading_of(self.odometry) * (step * share);
            if let Some((_, what)) = contact {
                self.tell(watch, true);
                return Err(self.bump(what));
            }
            left -= step;
            self.tell(watch, left <= 1e-9);
        }
        Ok(())
    }

    /// How far it can truly turn of so many degrees, and what stops it.
    fn turned(&self, turn: f64) -> (f64, Option<Obstruction>) {
        let skin = (SKIN / self.body.profile.radius.get()).to_degrees();
        match self.body.contact_in_turn(turn) {
            Some((angle, what)) => {
                (turn.signum() * (angle - skin).clamp(0.0, turn.abs()), Some(what))
            }
            None => (turn, None),
        }
    }

    fn turn(&mut self, turn: f64, watch: &mut Watch<'_>) -> Result<(), Unfinished<Bump>> {
        let mut left = turn.abs();
        while left > 1e-9 {
            watch.check()?;
            let step = STEP.1.min(left);
            let wished = step + self.normal() * self.senses.slip * (90.0 * step).sqrt();
            let wished = wished.max(0.0) * turn.signum();
            let (truly, stopped) = self.turned(wished);
            let heading = self.body.pose.heading + Deg::of(truly);
            let pose = Pose { heading, ..self.body.pose };
            self.body.advance(step / self.body.profile.turn_rate, pose);
            let touches = (truly - wished).abs() > 1e-9;
            let told = if touches { truly.abs().min(step) } else { step };
            self.odometry.heading = self.odometry.heading + Deg::of(told * turn.signum());
            if touches {
                self.tell(watch, true);
                return Err(self.bump(stopped));
            }
            left -= step;
            self.tell(watch, left <= 1e-9);
        }
        Ok(())
    }

    /// Something that the hand does: the world may look otherwise afterwards.
    fn act(&mut self, watch: &mut Watch<'_>, order: impl FnOnce(&mut Simulator) -> Done) -> Done {
        watch.check()?;
        let done = order(&mut self.body);
        self.faces = Faces::of(&self.body, self.senses.height);
        self.tell(watch, true);
        done
    }

    /// Waits so long, and can be told to stop.
    fn wait(&mut self, seconds: f64, watch: &mut Watch<'_>) -> Done {
        let mut left = seconds;
        while left > 0.0 {
            watch.check()?;
            let step = left.min(1.0);
            self.body.advance(step, self.body.pose);
            self.tell(watch, true);
            left -= step;
        }
        Ok(())
    }

    fn strikes_somebody(&self, door: DoorId, state: DoorState) -> bool {
        let Some(model) = self.body.truth.doors.get(&door) else { return false };
        let openings = (opening_of(model.state), opening_of(state));
        let people = self.people();
        self.body.doorways().filter(|doorway| doorway.door == Some(door)).any(|doorway| {
            let swept = doorway.leaves(model).swept(openings);
            swept.iter().any(|way| people.iter().any(|(at, girth)| way.contains(*at, *girth)))
        })
    }

    fn lift_comes(&mut self, watch: &mut Watch<'_>) -> Done {
        let late = self.dice.f64() * self.senses.lift_delay;
        self.wait(late, watch)
    }
}

fn heading_of(pose: Pose) -> Vector {
    let (sin, cos) = pose.heading.radians().sin_cos();
    Vector::new(cos, sin)
}

impl Vehicle for SensingRobot {
    /// What its wheels tell.
    fn pose(&self) -> (MapId, Pose) {
        (self.body.map, self.odometry)
    }

    fn time(&self) -> f64 {
        self.body.time
    }

    fn tells_odometry(&self) -> bool {
        true
    }

    fn follow(
        &mut self,
        path: &[Point],
        heading: Option<Deg>,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        watch.check()?;
        for &goal in path {
            let way = goal - self.odometry.at;
            if way.norm() < 1e-6 {
                continue;
            }
            let toward = Deg::from_radians(way.y.atan2(way.x));
            self.turn((toward - self.odometry.heading).signed(), watch)?;
            self.drive(way.norm(), watch)?;
        }
        if let Some(heading) = heading {
            self.turn((heading - self.odometry.heading).signed(), watch)?;
        }
        Ok(())
    }

    /// Nobody is struck by a leaf: the robot waits until people have gone out of its way.
    fn set_door(&mut self, door: DoorId, state: DoorState, watch: &mut Watch<'_>) -> Done {
        for _ in 0..PATIENCE {
            if !self.strikes_somebody(door, state) {
                break;
            }
            self.wait(1.0, watch)?;
        }
        if self.strikes_somebody(door, state) {
            let by = Some(Obstruction::Something);
            return Err(Refusal::DoorJammed { door, by, opening: 0 }.into());
        }
        let done = self.act(watch, |body| body.set_door(door, state, &mut Watch::none()));
        // That a leaf strikes something is felt, not what it is.
        done.map_err(|unfinished| {
            unfinished.map(|refusal| match refusal {
                Refusal::DoorJammed { door, by: Some(_), opening } => {
                    Refusal::DoorJammed { door, by: Some(Obstruction::Something), opening }
                }
                other => other,
            })
        })
    }

    fn call_lift(&mut self, door: Option<DoorId>, watch: &mut Watch<'_>) -> Done {
        self.lift_comes(watch)?;
        self.act(watch, |body| body.call_lift(door, &mut Watch::none()))
    }

    /// It truly is, on the other storey, where it stood in the cabin; `arrival` is where it is held to be.
    fn ride(
        &mut self,
        ride: &Ride,
        door: Option<DoorId>,
        arrival: (MapId, Pose),
        watch: &mut Watch<'_>,
    ) -> Done {
        self.lift_comes(watch)?;
        let storey = |map: MapId| {
            let maps = &self.body.truth.domain.maps;
            maps.iter()
                .find(|placed| placed.map == map)
                .map_or(Frame::IDENTITY, |placed| placed.frame)
        };
        let (below, above) = (storey(self.body.map), storey(arrival.0));
        let Pose { at, heading } = self.body.pose;
        let at = above.invert(below.apply(at));
        let scene = crate::geometry::Scene::of(&self.body.truth, arrival.0);
        let truly = match scene.area_at(at) == Some(ride.to) {
            true => Pose { at, heading: heading + below.angle - above.angle },
            // A cabin that is drawn elsewhere on the other storey.
            false => arrival.1,
        };
        self.act(watch, |body| body.ride(ride, door, (arrival.0, truly), &mut Watch::none()))
    }

    fn set_open(&mut self, thing: ReplicaId, open: bool, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body| body.set_open(thing, open, &mut Watch::none()))
    }

    fn push(
        &mut self,
        thing: ReplicaId,
        area: AreaId,
        frame: Frame,
        watch: &mut Watch<'_>,
    ) -> Done {
        self.act(watch, |body| body.push(thing, area, frame, &mut Watch::none()))
    }

    fn take(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body| body.take(thing, &mut Watch::none()))
    }

    fn put(&mut self, thing: ReplicaId, area: AreaId, frame: Frame, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body| body.put(thing, area, frame, &mut Watch::none()))
    }

    fn hand_over(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body| body.hand_over(thing, &mut Watch::none()))
    }

    fn take_back(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body| body.take_back(thing, &mut Watch::none()))
    }

    fn switch(&mut self, device: ReplicaId, on: bool, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body| body.switch(device, on, &mut Watch::none()))
    }

    fn call(&mut self, person: &str, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body| body.call(person, &mut Watch::none()))
    }

    /// The eye turns, not the wheels.
    fn look_round(&mut self, watch: &mut Watch<'_>) -> Done {
        self.wait(360.0 / self.body.profile.turn_rate, watch)
    }

    fn sees(&mut self, thing: ReplicaId) -> Result<Option<Sighting>, Failure> {
        self.body.sees(thing)
    }

    /// Things that are in view; how doors stand its laser tells.
    fn look_at(&mut self, what: Obstruction) -> Result<Option<Sighting>, Failure> {
        match what {
            Obstruction::Replica(thing) => self.body.sees(thing),
            Obstruction::Door(_) | Obstruction::Wall(_) | Obstruction::Something => Ok(None),
        }
    }
}
