//! [`Pilot`]: a vehicle that only knows what its wheels and its laser tell, made one that knows where it is (SPEC L3, L4, X4).
//!
//! It is sent on in short pieces; after each the laser says where it came to, and the next piece is aimed from there. What
//! the laser sees on the way ahead that the Map has not stops it before it is touched: what moves is waited for, what
//! stays is told: a door that stands otherwise, a thing that was moved, something unknown with its outline.
//!
//! **Invariant**: a pose is told only while what the laser sees fits it; where nothing fits, the robot looks about, makes the
//! move that would tell places apart, and then says that it does not know.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use nalgebra::Isometry2;

use crate::geometry::{FloorPlan, Polygon, Ride};
use crate::map::{DoorState, World};
use crate::sensing::{
    Belief, Chart, Fit, Inspector, Localiser, Options, Tracker, Unknown, telling_move,
};
use crate::units::{
    AreaId, Bilingual, Deg, DoorId, Frame, Gather as _, MapId, Point, Pose, ReplicaId, said,
};
use crate::vectors::scan::{Noise, Sensor};
use crate::vehicle::protocol::Scan;
use crate::vehicle::{
    Bump, Done, Failure, Gathered, Moment, Notice, Obstruction, Outlines, Refusal, Sighting,
    Unfinished, Vehicle, Watch,
};

mod way;

// How a laser and wheels err, and what may be believed of them: set by the sensors, so no rule reads it.

/// A return so far from all that is known is of something else, cm.
const UNKNOWN: f64 = 9.0;
/// So sure must it be of what it tells.
const SURE: f64 = 0.8;
/// A pose that explains less than this of what is seen is doubted, and given up for one that explains so much more.
const DOUBTED: f64 = 0.5;
const BETTER: f64 = 0.2;
/// Scans in a row.
const DOUBTS: usize = 2;
/// A pose that jumps by more was not driven to, cm and degrees.
const JUMP: (f64, f64) = (15.0, 10.0);
/// Looks and moves after which it gives up finding itself.
const TRIES: usize = 10;
/// A lost robot drives no less and no more than this to see more, cm.
const STROLL: (f64, f64) = (20.0, 80.0);
/// A scan is held against the Map where the pose is known as well as this, cm and degrees.
const KNOWN: (f64, f64) = (12.0, 1.5);
/// Of a range finder nothing is known but what it tells: nothing in a building is farther, cm.
const FARTHEST: f64 = 5_000.0;

/// The floors that a robot is to find itself on, as they are believed to be, at the height of its laser.
pub struct Ground<'w> {
    world: &'w World,
    floors: &'w BTreeMap<MapId, FloorPlan>,
    height: f64,
    charts: BTreeMap<MapId, Chart>,
}

/// What finds places on these floors, made where it is first wanted.
pub struct Finders<'g>(BTreeMap<MapId, OnceCell<Localiser<'g>>>);

impl<'w> Ground<'w> {
    /// `height` is of the laser above the zero of each Map, cm.
    #[must_use]
    pub fn of(world: &'w World, floors: &'w BTreeMap<MapId, FloorPlan>, height: f64) -> Self {
        let chart = |(map, floor): (&MapId, &FloorPlan)| {
            (*map, Chart::of_map(world, floor, height).without_leaves())
        };
        Self { world, floors, height, charts: floors.iter().map(chart).gather() }
    }

    #[must_use]
    pub fn finders(&self) -> Finders<'_> {
        Finders(self.charts.keys().map(|map| (*map, OnceCell::new())).gather())
    }
}

/// A vehicle that finds itself.
pub struct Pilot<'g, 'v> {
    body: &'v mut dyn Vehicle,
    ground: &'g Ground<'g>,
    finders: &'g Finders<'g>,
    tracker: Tracker<'g>,
    inspector: Inspector<'g>,
    map: MapId,
    /// Where it is, and what its wheels told there.
    pose: Isometry2<f64>,
    odometry: Isometry2<f64>,
    /// The last look, from where it was taken.
    look: Option<(Isometry2<f64>, Sensor, Vec<f64>)>,
    doubts: usize,
    is_lost: bool,
    /// Doors as they are believed to stand.
    doors: BTreeMap<DoorId, DoorState>,
    news: Vec<Sighting>,
    has_jumped: bool,
    /// Returns for which it stopped last, and what stood before the body where it touched something that nobody knows.
    met: Vec<Point>,
    felt: Vec<Point>,
    /// Things that it told to stand elsewhere than mapped, and where.
    told: BTreeMap<ReplicaId, Frame>,
    /// Things that its own hand changed: they are not where they were to be seen.
    handled: BTreeSet<ReplicaId>,
}

/// What was heard on the way.
type Heard = Vec<(Isometry2<f64>, Scan)>;

/// Looks about once, before anything is known: the height of the laser above the Map's zero.
///
/// # Errors
/// The vehicle failed, or tells of no scan.
pub fn height_of_laser(body: &mut dyn Vehicle) -> Result<f64, Failure> {
    let mut height = None;
    let mut hear = |notice: &Notice| {
        if let Notice::Scanned(scan) = notice {
            height = Some(scan.height);
        }
        ControlFlow::Continue(())
    };
    let looked = body.look_round(&mut Watch::new(Default::default(), &mut hear));
    match (looked, height) {
        (Err(Unfinished::Failed(failure)), _) => Err(failure),
        (_, Some(height)) if height.is_finite() => Ok(height),
        _ => Err(nowhere(said!("its-range-finder-tells-of"))),
    }
}

fn nowhere(why: Bilingual) -> Failure {
    Failure::Nowhere { why }
}

impl<'g, 'v> Pilot<'g, 'v> {
    /// A robot that is believed to be here; it looks about first, and where what it sees does not fit it is where that does.
    ///
    /// # Errors
    /// [`Failure::Nowhere`], or the vehicle failed.
    pub fn new(
        ground: &'g Ground<'g>,
        finders: &'g Finders<'g>,
        body: &'v mut dyn Vehicle,
        (map, believed): (MapId, Pose),
    ) -> Result<Self, Failure> {
        let odometry = Isometry2::from(body.pose().1);
        let pose = Isometry2::from(believed);
        let (tracker, inspector) = on_map(ground, finders, map, pose, odometry)
            .ok_or_else(|| nowhere(said!("the-map-has-no-such")))?;
        let doors = ground.world.doors.values().map(|door| (door.id, door.state)).collect();
        let mut pilot = Self {
            body,
            ground,
            finders,
            tracker,
            inspector,
            map,
            pose,
            odometry,
            look: None,
            doubts: 0,
            is_lost: false,
            doors,
            news: Vec::new(),
            has_jumped: false,
            met: Vec::new(),
            felt: Vec::new(),
            told: BTreeMap::new(),
            handled: BTreeSet::new(),
        };
        let watch = &mut Watch::none();
        let looked: Done = pilot.ask(watch, |body, watch| body.look_round(watch));
        let found = looked.and_then(|()| pilot.find_itself(watch));
        match found {
            Err(Unfinished::Failed(failure)) => return Err(failure),
            // Nobody tells it to stop; what it would not do now it is asked again later.
            Err(Unfinished::Stopped | Unfinished::Met(_)) | Ok(()) => {}
        }
        pilot.has_jumped = false;
        pilot.look_for_news();
        Ok(pilot)
    }

    fn at(&self) -> Point {
        Point::from(self.pose.translation.vector)
    }

    fn chart(&self) -> &'g Chart {
        &self.ground.charts[&self.map]
    }

    /// Has the vehicle do something, and takes in what it tells meanwhile; its poses are passed on as the Map's.
    fn ask<Why>(
        &mut self,
        watch: &mut Watch<'_>,
        order: impl FnOnce(&mut dyn Vehicle, &mut Watch<'_>) -> Result<(), Unfinished<Why>>,
    ) -> Result<(), Unfinished<Why>> {
        watch.check()?;
        let mut heard: Heard = Vec::new();
        let (map, to_map) = (self.map, self.pose * self.odometry.inverse());
        let mut last = self.odometry;
        let stop = watch.stop().clone();
        let mut hear = |notice: &Notice| {
            match notice {
                Notice::Moved(moment) => {
                    last = Isometry2::from(moment.pose);
                    let pose = Pose::from(to_map * last);
                    watch.notice(&Notice::Moved(Moment { map, pose, ..*moment }));
                }
                Notice::Scanned(scan) => {
                    heard.push((last, scan.clone()));
                    watch.notice(notice);
                }
                Notice::Saw(_) => watch.notice(notice),
                Notice::Found(_) => {}
            }
            if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let done = order(&mut *self.body, &mut Watch::new(stop, &mut hear));
        for (odometry, scan) in heard {
            self.take_in(odometry, &scan);
        }
        // The wheels may have turned since the last look.
        let now = Isometry2::from(self.body.pose().1);
        self.pose *= self.odometry.inverse() * now;
        self.odometry = now;
        done
    }

    /// Believes what a scan says of where it is.
    fn take_in(&mut self, odometry: Isometry2<f64>, scan: &Scan) {
        let Some((sensor, ranges)) = sensor_of(scan) else { return };
        let led = self.pose * self.odometry.inverse() * odometry;
        self.tracker.scan(&sensor, &ranges, odometry);
        let mut fit = match self.tracker.belief() {
            Belief::At(fit) => Some(fit.clone()),
            Belief::OneOf(_) | Belief::Lost(_) => None,
        };
        self.doubts = match &fit {
            Some(fit) if fit.worth() >= DOUBTED => 0,
            _ => self.doubts + 1,
        };
        if let Some(doubted) = fit.as_ref().filter(|_| self.doubts >= DOUBTS) {
            self.doubts = 0;
            let finder = &self.finders.0[&self.map];
            if let Some(finder) = finder.get()
                && let crate::sensing::Answer::Unique(other) = finder.locate(&sensor, &ranges)
                && other.worth() > doubted.worth() + BETTER
            {
                self.tracker.believe(other.pose);
                fit = Some(other);
            }
        }
        self.odometry = odometry;
        self.is_lost = fit.is_none();
        self.pose = fit.as_ref().map_or(led, |fit| fit.pose);
        let off = led.inverse() * self.pose;
        let turned = off.rotation.angle().abs().to_degrees();
        self.has_jumped |= off.translation.vector.norm() > JUMP.0 || turned > JUMP.1;
        if let Some(fit) = fit.filter(is_known) {
            self.inspector.take_in(&sensor, &ranges, &fit.pose);
        }
        self.look = Some((self.pose, sensor, ranges));
    }

    /// Where it is lost, it looks about and moves until it knows where it is.
    fn find_itself<Why>(&mut self, watch: &mut Watch<'_>) -> Result<(), Unfinished<Why>> {
        for number in 0..TRIES {
            if !self.is_lost {
                return Ok(());
            }
            let belief = self.tracker.belief();
            // Where more fits than can be looked through, every way on tells more than another look from there.
            let goes_on = matches!(belief, Belief::Lost(Unknown::TooMany(_))) || number % 2 == 1;
            let radius = self.ground.world.robot.radius.get() + UNKNOWN;
            // From elsewhere it may see what it knows.
            let telling = telling_move(self.chart(), belief.fits(), radius)
                .map(|by| (by.turn, by.ahead))
                .or_else(|| self.open_way(radius).filter(|_| goes_on));
            let silent = &mut Watch::of(watch.stop());
            let looked = match telling {
                Some((turn, ahead)) => {
                    let turned = self.odometry * Isometry2::rotation(turn);
                    let goal = turned * nalgebra::Point2::new(ahead, 0.0);
                    let heading = Some(Deg::from_radians(turned.rotation.angle()));
                    let path: &[Point] = if ahead > 0.0 { &[goal] } else { &[] };
                    let moved = self.ask(silent, |body, watch| body.follow(path, heading, watch));
                    moved.map_err(|unfinished| unfinished.map(|_| ()))
                }
                None => {
                    let looked = self.ask(silent, |body, watch| body.look_round(watch));
                    looked.map_err(|unfinished| unfinished.map(|_| ()))
                }
            };
            match looked {
                Ok(()) | Err(Unfinished::Met(())) => {}
                Err(Unfinished::Stopped) => return Err(Unfinished::Stopped),
                Err(Unfinished::Failed(failure)) => return Err(Unfinished::Failed(failure)),
            }
        }
        if !self.is_lost {
            return Ok(());
        }
        let failure = match self.tracker.belief() {
            Belief::OneOf(_) => nowhere(said!("sees-several")),
            Belief::Lost(Unknown::TooMany(_)) => nowhere(said!("sees-too-many")),
            Belief::Lost(Unknown::TooLittle) => nowhere(said!("sees-too-little")),
            Belief::At(_) | Belief::Lost(Unknown::Unsure) => nowhere(said!("sees-unsurely")),
            Belief::Lost(Unknown::Nowhere) => nowhere(said!("sees-nowhere")),
        };
        Err(Unfinished::Failed(failure))
    }

    /// A turn and a way ahead that the last look shows to be the freest, rad and cm; none where it is hemmed in.
    fn open_way(&self, wide: f64) -> Option<(f64, f64)> {
        let (_, sensor, ranges) = self.look.as_ref()?;
        let ends = ranges.iter().zip(sensor.directions());
        let ends: Vec<Point> = ends
            .filter(|(range, _)| sensor.returned(**range))
            .map(|(range, u)| Point::from(u * *range))
            .collect();
        let free = |turn: f64| {
            let (sin, cos) = turn.sin_cos();
            let ahead = ends.iter().filter_map(|p| {
                let (along, aside) = (p.x * cos + p.y * sin, p.y * cos - p.x * sin);
                (along > 0.0 && aside.abs() < wide).then_some(along - wide)
            });
            ahead.fold(f64::INFINITY, f64::min)
        };
        let turns = (0..24).map(|step| (f64::from(step) * 15.0).to_radians());
        let best = turns.map(|turn| (turn, free(turn))).max_by(|a, b| a.1.total_cmp(&b.1))?;
        (best.1 >= STROLL.0).then(|| (best.0, best.1.min(STROLL.1)))
    }

    /// After a piece of the way: knows where it is, or tells that it found itself elsewhere.
    fn confirm_pose(&mut self, watch: &mut Watch<'_>) -> Result<(), Unfinished<Bump>> {
        self.find_itself(watch)?;
        if std::mem::take(&mut self.has_jumped) {
            let (time, map, pose) = (self.body.time(), self.map, Pose::from(self.pose));
            watch.notice(&Notice::Found(Moment { time, map, pose }));
            return Err(Bump { at: pose, against: Obstruction::Something }.into());
        }
        Ok(())
    }

    /// How doors stand that stand otherwise than believed.
    fn look_for_news(&mut self) {
        for (id, seen) in self.inspector.differences().doors {
            let Some(&believed) = self.doors.get(&id) else { continue };
            let Some(state) = seen.state(believed).filter(|_| seen.sure >= SURE) else { continue };
            if state.status != believed.status {
                self.doors.insert(id, state);
                self.news.push(Sighting::Door { door: id, state });
            }
        }
    }

    fn to_odometry(&self, p: Point) -> Point {
        self.odometry * (self.pose.inverse() * p)
    }

    /// An order to the hand, to a door or a lift.
    fn act(
        &mut self,
        watch: &mut Watch<'_>,
        order: impl FnOnce(&mut dyn Vehicle, &mut Watch<'_>) -> Done,
    ) -> Done {
        let done = self.ask(watch, order);
        self.find_itself(watch)?;
        done
    }
}

/// What follows a robot over a Map from here on, and what holds scans against it.
fn on_map<'g>(
    ground: &'g Ground<'g>,
    finders: &'g Finders<'g>,
    map: MapId,
    pose: Isometry2<f64>,
    odometry: Isometry2<f64>,
) -> Option<(Tracker<'g>, Inspector<'g>)> {
    let (chart, floor) = (ground.charts.get(&map)?, ground.floors.get(&map)?);
    let finder = finders.0.get(&map)?.get_or_init(|| Localiser::new(chart, Options::default()));
    let inspector = Inspector::new(ground.world, floor, ground.height);
    Some((Tracker::believing(finder, pose, odometry), inspector))
}

fn is_known(fit: &Fit) -> bool {
    let (place, heading) = fit.deviations();
    place > 0.0 && place <= KNOWN.0 && heading.to_degrees() <= KNOWN.1
}

/// A scan as one of a range finder that errs as most do.
fn sensor_of(scan: &Scan) -> Option<(Sensor, Vec<f64>)> {
    let noise = Noise { range: 2.0, ..Noise::default() };
    let (from, step) = (scan.from.to_radians(), scan.step.to_radians());
    let sensor = Sensor::new(from, step, scan.ranges.len(), (0.0, FARTHEST), noise).ok()?;
    Some((sensor, scan.ranges.iter().map(|range| range.unwrap_or(f64::INFINITY)).collect()))
}

impl Vehicle for Pilot<'_, '_> {
    fn pose(&self) -> (MapId, Pose) {
        (self.map, Pose::from(self.pose))
    }

    fn time(&self) -> f64 {
        self.body.time()
    }

    fn news(&mut self) -> Vec<Sighting> {
        std::mem::take(&mut self.news)
    }

    fn outlines(&self) -> Outlines {
        self.unknown()
    }

    fn gathered(&self) -> Gathered {
        self.found()
    }

    fn sees_through(&self, pieces: &[Polygon]) -> bool {
        self.inspector.is_gone(pieces)
    }

    fn follow(
        &mut self,
        path: &[Point],
        heading: Option<Deg>,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        let mut from = self.at();
        for (number, &goal) in path.iter().enumerate() {
            self.approach((from, goal), &path[number..], watch)?;
            from = goal;
        }
        if let Some(heading) = heading {
            self.face(heading, watch)?;
        }
        self.look_for_news();
        for seen in std::mem::take(&mut self.news) {
            watch.notice(&Notice::Saw(seen));
        }
        Ok(())
    }

    fn set_door(&mut self, door: DoorId, state: DoorState, watch: &mut Watch<'_>) -> Done {
        let done = self.act(watch, |body, watch| body.set_door(door, state, watch));
        match &done {
            Ok(()) => {
                self.doors.insert(door, state);
                self.inspector.forget_door(door);
            }
            Err(Unfinished::Met(Refusal::Locked(door))) => {
                self.doors.insert(*door, DoorState::LOCKED);
            }
            Err(_) => {}
        }
        done
    }

    fn call_lift(&mut self, door: Option<DoorId>, watch: &mut Watch<'_>) -> Done {
        let done = self.act(watch, |body, watch| body.call_lift(door, watch));
        self.doors.extend(door.filter(|_| done.is_ok()).map(|door| (door, DoorState::OPEN)));
        done
    }

    fn ride(
        &mut self,
        ride: &Ride,
        door: Option<DoorId>,
        arrival: (MapId, Pose),
        watch: &mut Watch<'_>,
    ) -> Done {
        let before = self.map;
        // What the laser sees on the way belongs to neither storey.
        let silent = &mut Watch::of(watch.stop());
        let done = self.body.ride(ride, door, arrival, silent);
        match &done {
            Err(Unfinished::Failed(_)) => return done,
            Err(Unfinished::Stopped) if self.body.pose().0 == before => return done,
            _ => {}
        }
        self.map = arrival.0;
        (self.pose, self.odometry) =
            (Isometry2::from(arrival.1), Isometry2::from(self.body.pose().1));
        let found = on_map(self.ground, self.finders, self.map, self.pose, self.odometry);
        let Some((tracker, inspector)) = found else {
            let failure = nowhere(said!("the-map-has-no-such"));
            return Err(Unfinished::Failed(failure));
        };
        (self.tracker, self.inspector, self.look) = (tracker, inspector, None);
        self.doors.extend(door.filter(|_| done.is_ok()).map(|door| (door, DoorState::OPEN)));
        self.act(watch, |body, watch| body.look_round(watch))?;
        self.has_jumped = false;
        done
    }

    fn set_open(&mut self, thing: ReplicaId, open: bool, watch: &mut Watch<'_>) -> Done {
        self.handled.insert(thing);
        self.act(watch, |body, watch| body.set_open(thing, open, watch))
    }

    fn push(
        &mut self,
        thing: ReplicaId,
        area: AreaId,
        frame: Frame,
        watch: &mut Watch<'_>,
    ) -> Done {
        self.handled.insert(thing);
        self.act(watch, |body, watch| body.push(thing, area, frame, watch))
    }

    fn take(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.handled.insert(thing);
        self.act(watch, |body, watch| body.take(thing, watch))
    }

    fn put(&mut self, thing: ReplicaId, area: AreaId, frame: Frame, watch: &mut Watch<'_>) -> Done {
        self.handled.insert(thing);
        self.act(watch, |body, watch| body.put(thing, area, frame, watch))
    }

    fn hand_over(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body, watch| body.hand_over(thing, watch))
    }

    fn take_back(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body, watch| body.take_back(thing, watch))
    }

    fn switch(&mut self, device: ReplicaId, on: bool, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body, watch| body.switch(device, on, watch))
    }

    fn call(&mut self, person: &str, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body, watch| body.call(person, watch))
    }

    fn look_round(&mut self, watch: &mut Watch<'_>) -> Done {
        self.act(watch, |body, watch| body.look_round(watch))
    }

    fn sees(&mut self, thing: ReplicaId) -> Result<Option<Sighting>, Failure> {
        self.body.sees(thing)
    }

    /// How a door stands the laser tells, and that it is locked the hand that tried it.
    fn look_at(&mut self, what: Obstruction) -> Result<Option<Sighting>, Failure> {
        match what {
            Obstruction::Door(door) => {
                let Some(&state) = self.doors.get(&door) else { return Ok(None) };
                let seen = self.inspector.differences().doors.get(&door).copied();
                let seen = seen.filter(|seen| seen.sure >= SURE).and_then(|seen| seen.state(state));
                Ok(Some(Sighting::Door { door, state: seen.unwrap_or(state) }))
            }
            other => self.body.look_at(other),
        }
    }
}
