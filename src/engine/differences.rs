//! What scans see that the map has otherwise (SPEC L4): held against the survey, told, and kept as what was seen, never as an
//! edit.

use std::collections::BTreeMap;

use crate::geometry::{Bounds, Polygon};
use crate::language::Language;
use crate::map::{DoorState, DoorStatus, Entity, World};
use crate::sensing::{
    Belief, Chart, DoorSeen, Fit, Inspector, Localiser, Options, ThingSeen, Tracker,
};
use crate::store::{FoundAt, Observation, RobotMemory, Seen, SeenObstacle, Timestamp};
use crate::units::{AreaId, DoorId, Frame, Lengths, MapId, Point, ReplicaId, told};
use crate::vectors::read::Scan;

use super::memory::ROBOT;
use super::sighting::named;
use super::{Engine, Error, RequestError, Sighted, State};

/// A scan is held against the map where its pose is known as well as this, in cm and degrees.
const POSE_KNOWN: (f64, f64) = (12.0, 1.5);

/// What scans say of a thing of the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ThingNews {
    /// It was seen where the map has it.
    There,
    Missed,
    Moved(Seen),
}

/// What scans say of a door.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoorNews {
    pub state: DoorState,
    /// Of how far it stands open, in per cent: all between these fit.
    pub between: (f64, f64),
    pub sure: f64,
    pub is_as_mapped: bool,
}

/// What scans of a log say of a map.
#[derive(Debug, Clone)]
pub struct Differing {
    pub map: MapId,
    /// Scans that were looked at, and those whose pose was known well enough to be held against the map.
    pub scans: usize,
    pub held: usize,
    /// With how sure each is.
    pub things: BTreeMap<ReplicaId, (ThingNews, f64)>,
    pub doors: BTreeMap<DoorId, DoorNews>,
    pub obstacles: Vec<SeenObstacle>,
    /// Obstacles that were seen before and that beams now went through.
    pub gone: Vec<SeenObstacle>,
    /// Where the last scan can have been taken.
    pub found: Vec<FoundAt>,
}

/// A pose that a log tells is off by no more, cm: what fits farther off is another place.
const TOLD_OFF: f64 = 30.0;

impl State {
    /// What scans of a log see that a map has otherwise, by a laser at `height` cm above the Map's zero: of the scan `only`,
    /// from 1, or of all. Their poses are found on the map, and followed by odometry where the log has it; or the log tells
    /// them, in the map's frame (`posed`).
    ///
    /// # Errors
    /// As [`State::find_scans`].
    pub fn differences(
        &self,
        map: MapId,
        log: &Sighted,
        only: Option<usize>,
        height: f64,
        posed: bool,
        at: Timestamp,
    ) -> Result<Differing, Error> {
        let (world, floor) = (self.world()?, self.floor(map)?);
        let log = log.log().ok_or(RequestError::NoLog)?;
        if let Some(scan) = only.filter(|&scan| scan == 0 || scan > log.scans.len()) {
            return Err(RequestError::NoScan { scan, count: log.scans.len() }.into());
        }
        let chart = Chart::of_map(world, floor, height);
        let localiser = Localiser::new(&chart, Options::default());
        let mut tracker = Tracker::new(&localiser);
        let mut inspector = Inspector::new(world, floor, height);
        let (mut scans, mut held, mut last) = (0, 0, Vec::new());
        for (number, scan) in (1..).zip(&log.scans) {
            if only.is_some_and(|only| only != number) {
                continue;
            }
            scans += 1;
            let sensor = log.sensor(scan);
            let fits = match posed {
                false => found_on_map(&localiser, &mut tracker, log, scan),
                true => {
                    let pose = scan.pose.ok_or(RequestError::NoPose { line: scan.line })?;
                    let near = localiser.near(sensor, &scan.ranges, pose);
                    // What the log tells is made exact where the map allows it.
                    let is_near = |fit: &Fit| {
                        (fit.pose.translation.vector - pose.translation.vector).norm() <= TOLD_OFF
                    };
                    let told = || Fit {
                        pose,
                        covariance: nalgebra::Matrix3::zeros(),
                        explained: 0.0,
                        through: 0.0,
                        likeness: 0.0,
                    };
                    vec![near.filter(is_near).unwrap_or_else(told)]
                }
            };
            if let [fit] = &fits[..] {
                let (place, heading) = fit.deviations();
                if place <= POSE_KNOWN.0 && heading.to_degrees() <= POSE_KNOWN.1 {
                    inspector.take_in(sensor, &scan.ranges, &fit.pose);
                    held += 1;
                }
            }
            last = fits;
        }
        let seen = inspector.differences();
        let mut things = BTreeMap::new();
        for look in &seen.things {
            let news = match look.seen {
                ThingSeen::There => Some(ThingNews::There),
                ThingSeen::Missed => Some(ThingNews::Missed),
                ThingSeen::Moved(frame) => self.in_area(map, frame)?.map(ThingNews::Moved),
            };
            things.extend(news.map(|news| (look.thing, (news, look.sure))));
        }
        let mut doors = BTreeMap::new();
        for (&id, seen) in &seen.doors {
            let Some(door) = world.doors.get(&id) else { continue };
            doors.extend(door_news(door.state, seen).map(|news| (id, news)));
        }
        let mut obstacles = Vec::new();
        for thing in &seen.unmapped {
            let Some((area, frame)) = self.area_on(map, thing.middle())? else { continue };
            let piece = |polygon: &Polygon| {
                polygon.corners.iter().map(|corner| frame.invert(*corner)).collect()
            };
            obstacles.push(SeenObstacle {
                area,
                pieces: thing.pieces.iter().map(piece).collect(),
                top: height - frame.z.get(),
                at,
                sure: thing.sure,
            });
        }
        let mut gone = Vec::new();
        let least = self.reckoned_with()?;
        for old in self.memory()?.obstacles.iter().filter(|old| old.stands(at, least)) {
            let Some((_, frame)) = world.placement(old.area).filter(|(on, _)| *on == map) else {
                continue;
            };
            let piece = |piece: &Vec<Point>| {
                Polygon::new(piece.iter().map(|corner| frame.apply(*corner)).collect())
            };
            let pieces: Vec<Polygon> = old.pieces.iter().map(piece).collect();
            if inspector.is_gone(&pieces) {
                gone.push(old.clone());
            }
        }
        let found = last.iter().map(|fit| {
            let (place, heading) = fit.deviations();
            let deviation = (place, heading.to_degrees());
            FoundAt { map, pose: fit.pose.into(), deviation, explained: fit.explained, at }
        });
        let found = found.collect();
        Ok(Differing { map, scans, held, things, doors, obstacles, gone, found })
    }

    fn area_on(&self, map: MapId, at: Point) -> Result<Option<(AreaId, Frame)>, Error> {
        let area = self.floor(map)?.scene().area_at(at);
        Ok(area.and_then(|area| Some((area, self.world().ok()?.placement(area)?.1))))
    }

    /// A frame on a Map, as one of the Area that holds it.
    fn in_area(&self, map: MapId, frame: Frame) -> Result<Option<Seen>, Error> {
        let area = self.area_on(map, frame.origin())?;
        Ok(area.map(|(area, placed)| {
            let at = placed.invert(frame.origin());
            let (z, angle) = (frame.z - placed.z, frame.angle - placed.angle);
            Seen { area, frame: Frame::new(at.x, at.y, z.get(), angle) }
        }))
    }
}

fn found_on_map(
    localiser: &Localiser<'_>,
    tracker: &mut Tracker<'_>,
    log: &crate::vectors::read::Log,
    scan: &Scan,
) -> Vec<Fit> {
    let belief = match scan.odometry {
        Some(odometry) => {
            tracker.scan(log.sensor(scan), &scan.ranges, odometry);
            tracker.belief().clone()
        }
        None => localiser.locate(log.sensor(scan), &scan.ranges).into(),
    };
    match belief {
        Belief::At(fit) => vec![fit],
        Belief::OneOf(fits) => fits,
        Belief::Lost(_) => Vec::new(),
    }
}

fn door_news(mapped: DoorState, seen: &DoorSeen) -> Option<DoorNews> {
    let state = seen.state(mapped)?;
    let is_shut = |state: DoorState| state.status != DoorStatus::Open || state.opening <= 0.0;
    let is_as_mapped = is_shut(state) == is_shut(mapped)
        && (is_shut(state) || (state.opening - mapped.opening).abs() < 1e-9);
    Some(DoorNews { state, between: (seen.least, seen.most), sure: seen.sure, is_as_mapped })
}

impl Engine {
    /// Keeps what scans saw: things as observations, doors and obstacles as the world is now, the pose where it is the only
    /// one. The map stays as it was; what observations speak for is proposed ([`Engine::proposals`]).
    ///
    /// # Errors
    /// The disk refused.
    pub fn keep_differences(&mut self, seen: &Differing, at: Timestamp) -> Result<(), Error> {
        let mut memory = self.memory()?.clone();
        let observed = seen.things.iter().map(|(&replica, &(news, sure))| {
            let seen = match news {
                ThingNews::There => {
                    let replica = self.world().ok()?.replicas.get(&replica)?;
                    Some(Seen { area: replica.area, frame: replica.frame })
                }
                ThingNews::Missed => None,
                ThingNews::Moved(place) => Some(place),
            };
            Some(Observation { replica, at, seen, sure, observer: ROBOT.to_owned() })
        });
        let observed: Vec<Observation> = observed.flatten().collect();
        let apart = self.relations()?.thresholds().robot_same;
        let least = self.reckoned_with()?;
        renew(&mut memory, seen, (apart, least), at);
        self.next().forget_present();
        Ok(self.writable()?.remember(&memory, &observed, ROBOT, at)?)
    }
}

/// What is remembered of doors, obstacles and the pose, after these scans; obstacles whose middles are no farther `apart`
/// are one, and those less sure than `least` are forgotten.
fn renew(memory: &mut RobotMemory, seen: &Differing, (apart, least): (f64, f64), at: Timestamp) {
    for (door, news) in &seen.doors {
        if news.is_as_mapped {
            memory.doors.remove(door);
        } else {
            memory.doors.insert(*door, news.state);
        }
    }
    memory.obstacles.retain(|old| old.stands(at, least) && !seen.gone.contains(old));
    for new in &seen.obstacles {
        // Seen again, it is the same obstacle; the last look knows best how large it is.
        let known = memory
            .obstacles
            .iter_mut()
            .find(|old| old.area == new.area && distance(old, new) <= apart);
        match known {
            Some(old) => *old = new.clone(),
            None => memory.obstacles.push(new.clone()),
        }
    }
    if let [only] = &seen.found[..] {
        memory.pose = Some((only.map, only.pose));
    }
    if !seen.found.is_empty() {
        memory.found.clone_from(&seen.found);
    }
}

fn distance(one: &SeenObstacle, other: &SeenObstacle) -> f64 {
    let middle = |seen: &SeenObstacle| {
        let corners: Vec<_> = seen.pieces.iter().flatten().map(|p| p.coords).collect();
        corners.iter().sum::<crate::units::Vector>() / corners.len().max(1) as f64
    };
    (middle(one) - middle(other)).norm()
}

impl Differing {
    /// What differs, a line for each.
    #[must_use]
    pub fn in_words(&self, world: &World, language: Language) -> Vec<String> {
        let lengths = Lengths::said();
        let mut lines = vec![told!(language, "scans-held", scans = self.scans, held = self.held)];
        let name = |entity: Entity| named(world, entity, language);
        let area = |id: AreaId| name(Entity::Area(id));
        let mut same = 0;
        for (&id, &(news, sure)) in &self.things {
            let thing = name(Entity::Replica(id));
            let sure = (sure * 100.0).round();
            match news {
                ThingNews::There => same += 1,
                ThingNews::Missed => lines.push(told!(language, "thing-missed", thing, sure)),
                ThingNews::Moved(to) => {
                    let (at, turn) = (to.frame.origin(), to.frame.angle.get());
                    let (at, room) = (lengths.point(at.x, at.y, 0), area(to.area));
                    let now = told!(language, "now-at");
                    lines.push(format!("{thing}: {now} {at}, {turn:.0}°, {room} ({sure} %)"));
                }
            }
        }
        for (&id, news) in &self.doors {
            if news.is_as_mapped {
                same += 1;
                continue;
            }
            let door = name(Entity::Door(id));
            let sure = (news.sure * 100.0).round();
            let state = match news.state.status {
                DoorStatus::Open => {
                    let (low, high) = news.between;
                    format!("{} ({low:.0}–{high:.0} %)", told!(language, "stands-open"))
                }
                DoorStatus::Closed | DoorStatus::Locked => told!(language, "closed"),
            };
            lines.push(format!("{door}: {state} ({sure} %)"));
        }
        for obstacle in &self.obstacles {
            let corners: Vec<Point> = obstacle.pieces.iter().flatten().copied().collect();
            let bounds = Bounds::of(corners);
            let (size, at) = (bounds.max - bounds.min, nalgebra::center(&bounds.min, &bounds.max));
            let sure = (obstacle.sure * 100.0).round();
            let unit = lengths.word(language);
            let [long, wide] = [size.x, size.y].map(|length| lengths.number(length, 0));
            lines.push(format!(
                "{}: {long} × {wide} {unit}, {}, {} ({sure} %)",
                told!(language, "not-on-the-map"),
                lengths.point(at.x, at.y, 0),
                area(obstacle.area)
            ));
        }
        if !self.gone.is_empty() {
            let gone = told!(language, "obstacles-gone");
            lines.push(format!("{gone}: {}", self.gone.len()));
        }
        lines.push(told!(language, "as-on-the-map-same", same));
        lines
    }
}
