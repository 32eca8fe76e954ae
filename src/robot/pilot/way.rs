//! The way of a [`Pilot`]: piece by piece, looking ahead; what stands in it is waited for, recognised, or told with its
//! outline.

use crate::geometry::{PlacedReplica, Polygon, convex_hull, nearest_on_segment};
use crate::map::DoorKind;
use crate::sensing::ThingSeen;
use crate::units::{Deg, Frame, InOrder as _, Point, Pose, ReplicaId, Vector};
use crate::vehicle::{Bump, Gathered, Notice, Obstruction, Outlines, Sighting, Unfinished, Watch};

use super::{Pilot, SURE, UNKNOWN};

/// The robot drives so far before it aims anew, cm.
const PIECE: f64 = 20.0;
/// So near to a corner of its way, and to its end, it is there, cm; so near to a heading it faces it, degrees.
const AT_CORNER: f64 = 1.5;
const AT_END: f64 = 3.0;
const AT_HEADING: f64 = 1.5;
/// The way ahead is looked over so far, cm.
const AHEAD: f64 = 70.0;
/// Looks for which it waits before what stands in the way, and those after which what has not moved stays.
const LOOKS: usize = 10;
const STAYS: usize = 3;
/// What moved by less stands, cm.
const STILL: f64 = 8.0;
/// What is farther is not what stands in the way, cm.
const NEAR: f64 = 200.0;
/// What a way comes nearer to by no more is not met on it, cm.
const NEARER: f64 = 1.0;
/// A turn by more goes astray by so much that the robot looks where it faces before it drives on, degrees.
const TURN: f64 = 30.0;
/// How thick something is at least of which single returns tell, cm to each side.
const THICK: f64 = 3.0;
/// Contacts on one stretch of a way, where something is known to stand, after which something unseen stands there too.
const CONTACTS: usize = 4;
/// What is seen beside the way is kept off by so much where there is room, cm.
const AMPLE: f64 = 4.0;
/// What is no larger across may be one thing on several legs, cm.
const ONE_THING: f64 = 90.0;
/// Away from what was touched, cm.
const AWAY: f64 = 4.0;

impl Pilot<'_, '_> {
    /// Leaves of doors as they are believed to stand, as edges.
    fn leaves(&self) -> Vec<(Point, Point)> {
        let doorways = self.ground.floors[&self.map].doorways().iter();
        let leaves = doorways.filter_map(|doorway| {
            let door = self.ground.world.doors.get(&doorway.door?)?;
            Some(doorway.leaves(door).obstacles(*self.doors.get(&door.id)?))
        });
        leaves.flatten().flat_map(|leaf| leaf.edges().collect::<Vec<_>>()).collect()
    }

    /// Returns of the last look that lie on the way ahead, and on nothing that is known.
    fn in_the_way(&self, path: &[Point]) -> Vec<Point> {
        let Some((from, sensor, ranges)) = &self.look else { return Vec::new() };
        let way = ahead(self.at(), path, AHEAD);
        let robot = &self.ground.world.robot;
        let wide = robot.passing_width() / 2.0 - robot.clearance.get() - 1.0;
        let leaves = self.leaves();
        let chart = self.chart();
        let off = |p: Point| {
            let legs = way.windows(2).map(|leg| (nearest_on_segment(p, leg[0], leg[1]) - p).norm());
            legs.fold(f64::INFINITY, f64::min)
        };
        let is_known = |p: Point| {
            chart.nearest(p).is_some_and(|(_, foot)| (foot - p).norm() <= UNKNOWN)
                || leaves.iter().any(|(a, b)| (nearest_on_segment(p, *a, *b) - p).norm() <= UNKNOWN)
        };
        let ends = ranges.iter().zip(sensor.directions());
        let ends = ends.filter(|(range, _)| sensor.returned(**range));
        let ends = ends.map(|(range, u)| from * Point::from(u * *range));
        // No way leads through what is known: a return that deep in it is of something, whatever the map has there. What
        // stands beside the robot or behind is passed already.
        let here = way[0];
        let bars = |p: Point| {
            let off = off(p);
            let is_ahead = off < (p - here).norm() - NEARER;
            is_ahead && (off < wide - UNKNOWN || off < wide && !is_known(p))
        };
        let met: Vec<Point> = ends.filter(|p| bars(*p)).collect();
        // One by itself is noise.
        if met.len() < 2 { Vec::new() } else { met }
    }

    /// Waits while what is in the way moves; what stays there, then.
    fn wait_for_way(
        &mut self,
        path: &[Point],
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        let mut still = 0;
        let mut before: Option<Point> = None;
        for _ in 0..LOOKS {
            let met = self.in_the_way(path);
            self.met.clone_from(&met);
            if met.is_empty() {
                return Ok(());
            }
            if let Some(against) = self.recognise_door(&met, watch) {
                return Err(Bump { at: Pose::from(self.pose), against }.into());
            }
            let middle = middle_of(&met);
            still = match before {
                Some(before) if (middle - before).norm() <= STILL => still + 1,
                _ => 0,
            };
            if still >= STAYS {
                break;
            }
            before = Some(middle);
            let looked = self.ask(watch, |body, watch| body.look_round(watch));
            looked.map_err(|unfinished| {
                unfinished
                    .map(|_| Bump { at: Pose::from(self.pose), against: Obstruction::Something })
            })?;
            self.confirm_pose(watch)?;
        }
        let met = self.in_the_way(path);
        if met.is_empty() {
            return Ok(());
        }
        // Who walks may look like a thing that was moved, until they walk on.
        let against = self.recognise_thing(&met, watch).unwrap_or(Obstruction::Something);
        Err(Bump { at: Pose::from(self.pose), against }.into())
    }

    /// The door whose leaf is here, where it is not believed to be; it is told.
    fn recognise_door(&mut self, met: &[Point], watch: &mut Watch<'_>) -> Option<Obstruction> {
        let floor = &self.ground.floors[&self.map];
        for (id, seen) in self.inspector.differences().doors {
            let Some(door) = self.ground.world.doors.get(&id) else { continue };
            let Some(state) = seen.state(self.doors[&id]).filter(|_| seen.sure >= SURE) else {
                continue;
            };
            if state == self.doors[&id] || door.kind == DoorKind::Passage {
                continue;
            }
            let leaves = floor.doorways_of(id).flat_map(|way| way.leaves(door).obstacles(state));
            let leaves: Vec<Polygon> = leaves.collect();
            if is_of(met, &leaves.iter()) {
                self.doors.insert(id, state);
                watch.notice(&Notice::Saw(Sighting::Door { door: id, state }));
                return Some(Obstruction::Door(id));
            }
        }
        None
    }

    /// The thing that stands here, and is mapped elsewhere; it is told, unless it was told to stand here and something is in
    /// the way all the same.
    fn recognise_thing(&mut self, met: &[Point], watch: &mut Watch<'_>) -> Option<Obstruction> {
        for look in self.inspector.differences().things.iter().filter(|look| look.sure >= SURE) {
            let ThingSeen::Moved(frame) = look.seen else { continue };
            let is_told = self
                .told
                .get(&look.thing)
                .is_some_and(|told| (told.origin() - frame.origin()).norm() <= UNKNOWN);
            let placed = PlacedReplica::new(self.ground.world, look.thing, frame);
            if !is_told
                && is_of(met, &placed.prisms.iter().map(|prism| &prism.polygon))
                && let Some(seen) = self.in_area(look.thing, frame)
            {
                self.told.insert(look.thing, frame);
                watch.notice(&Notice::Saw(seen));
                return Some(Obstruction::Replica(look.thing));
            }
        }
        None
    }

    /// A thing at a frame of the Map, as a sighting in the Area that holds it.
    fn in_area(&self, replica: ReplicaId, frame: Frame) -> Option<Sighting> {
        let area = self.ground.floors[&self.map].scene().area_at(frame.origin())?;
        let (_, placed) = self.ground.world.placement(area)?;
        let at = placed.invert(frame.origin());
        let (z, angle) = (frame.z - placed.z, frame.angle - placed.angle);
        let frame = Frame::new(at.x, at.y, z.get(), angle);
        Some(Sighting::Replica { replica, area, frame })
    }

    /// A little back on a way, in the frame of the odometry.
    fn behind(&self, way: Vector) -> Point {
        self.to_odometry(self.at() - way.normalize() * AWAY)
    }

    /// Back from what was touched, to a place in the frame of the odometry.
    fn back_off(&mut self, goal: Point, watch: &mut Watch<'_>) -> Result<(), Unfinished<Bump>> {
        match self.ask(watch, |body, watch| body.follow(&[goal], None, watch)) {
            Ok(()) | Err(Unfinished::Met(_)) => self.confirm_pose(watch),
            Err(unfinished) => Err(unfinished),
        }
    }

    /// Away from the nearest return of the last look.
    fn away(&self) -> Vector {
        let Some((from, sensor, ranges)) = &self.look else { return Vector::x() };
        let ends = ranges.iter().zip(sensor.directions());
        let near =
            ends.filter(|(range, _)| sensor.returned(**range)).min_by(|a, b| a.0.total_cmp(b.0));
        near.map_or(Vector::x(), |(_, u)| from.rotation * u)
    }

    /// Whether the laser sees what the body touches: it was grazed.
    fn sees_beside(&self) -> bool {
        let beside = self.ground.world.robot.radius.get() + UNKNOWN;
        let Some((_, sensor, ranges)) = &self.look else { return false };
        ranges.iter().any(|range| sensor.returned(*range) && *range <= beside)
    }

    /// Whether what was touched just before the body may be what is known to stand there.
    fn may_be_known(&self, front: &[Point]) -> bool {
        let floor = &self.ground.floors[&self.map];
        let walls = floor.fragments().flat_map(|fragment| fragment.walls.iter().copied());
        let things = floor.fragments().flat_map(|fragment| fragment.obstacles());
        let edges = things.flat_map(|thing| thing.polygon.edges().collect::<Vec<_>>());
        let is_near = |p: &Point, (a, b): (Point, Point)| {
            (nearest_on_segment(*p, a, b) - p).norm() <= UNKNOWN
        };
        let mut known = walls.chain(edges).chain(self.leaves());
        known.any(|edge| front.iter().any(|p| is_near(p, edge)))
    }

    /// A point on the way, moved a little away from what the last look shows beside it: outlines are known no better.
    fn eased(&self, p: Point, spare: f64) -> Point {
        let Some((from, sensor, ranges)) = &self.look else { return p };
        let keep = self.ground.world.robot.radius.get() + spare;
        let ends = ranges.iter().zip(sensor.directions());
        let ends = ends.filter(|(range, _)| sensor.returned(**range));
        let near: Vec<Point> = ends
            .map(|(range, u)| from * Point::from(u * *range))
            .filter(|end| (end - p).norm() < 2.0 * keep)
            .collect();
        // One return by itself is noise.
        let second = |p: Point| {
            let mut off: Vec<Vector> = near.iter().map(|end| p - end).collect();
            off.order_by(|a, b| a.norm().total_cmp(&b.norm()));
            off.get(1).copied()
        };
        let Some(off) = second(p).filter(|off| off.norm() < keep) else { return p };
        let lack = keep - off.norm();
        let tries = [1.0, 0.5, 0.25].map(|share| p + off.normalize() * (lack * share));
        let room = |p: &Point| second(*p).map_or(f64::INFINITY, |off| off.norm());
        let best = tries.into_iter().max_by(|a, b| room(a).total_cmp(&room(b)));
        best.filter(|eased| room(eased) > room(&p)).unwrap_or(p)
    }

    /// Points just before the body on its way.
    fn front(&self, way: Vector) -> Vec<Point> {
        let radius = self.ground.world.robot.radius.get() + THICK + 1.0;
        let course = way.y.atan2(way.x);
        let before = |turn: f64| {
            let (sin, cos) = (course + turn.to_radians()).sin_cos();
            self.at() + Vector::new(cos, sin) * radius
        };
        [-25.0, 0.0, 25.0].map(before).to_vec()
    }

    /// Drives to one corner of a way.
    pub(super) fn approach(
        &mut self,
        leg: (Point, Point),
        rest: &[Point],
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        let (from, goal) = leg;
        let close = if rest.len() > 1 { AT_CORNER } else { AT_END };
        let (mut contacts, mut is_turned) = (0, false);
        let (mut goal, mut rest) = (goal, rest.to_vec());
        let mut is_eased = false;
        let clearance = self.ground.world.robot.clearance.get();
        let ample = clearance.max(AMPLE);
        self.felt.clear();
        loop {
            watch.check()?;
            if !is_eased && (goal - self.at()).norm() <= 2.0 * PIECE {
                is_eased = true;
                // Where it is to stand it keeps off what is seen there no more than it must.
                goal = self.eased(goal, if rest.len() > 1 { ample } else { clearance });
                rest[0] = goal;
            }
            let way = goal - self.at();
            let left = way.norm();
            let is_past = left <= 2.0 * AT_END && way.dot(&(goal - from)) <= 0.0;
            if left <= close || is_past {
                return Ok(());
            }
            if !self.in_the_way(&rest).is_empty() {
                self.wait_for_way(&rest, watch)?;
                continue;
            }
            let course = Deg::from_radians(way.y.atan2(way.x));
            if (course - Pose::from(self.pose).heading).signed().abs() > TURN && !is_turned {
                is_turned = true;
                self.face(course, watch)?;
                continue;
            }
            is_turned = false;
            let target = match left > PIECE {
                true => self.eased(self.at() + way * (PIECE / left), ample),
                false => goal,
            };
            let target = self.to_odometry(target);
            match self.ask(watch, |body, watch| body.follow(&[target], None, watch)) {
                Ok(()) => {}
                Err(Unfinished::Met(bump)) => {
                    contacts += 1;
                    let back = self.behind(way);
                    if let Err(elsewhere) = self.confirm_pose(watch) {
                        // Wherever that is, it stands against something: from there no way begins.
                        self.back_off(back, watch)?;
                        return Err(elsewhere);
                    }
                    // Below or above what the laser sees: it stands before the body.
                    let felt = self.front(way);
                    let is_new = !self.sees_beside() && !self.may_be_known(&felt);
                    self.back_off(self.behind(way), watch)?;
                    if is_new || contacts >= CONTACTS {
                        self.met.clear();
                        self.felt = felt;
                        let at = Pose::from(self.pose);
                        return Err(Bump { at, ..bump }.into());
                    }
                }
                Err(unfinished) => return Err(unfinished),
            }
            self.confirm_pose(watch)?;
        }
    }

    pub(super) fn face(
        &mut self,
        heading: Deg,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        for _ in 0..CONTACTS {
            let off = (heading - Pose::from(self.pose).heading).signed();
            if off.abs() <= AT_HEADING {
                break;
            }
            let goal = Deg::from_radians(self.odometry.rotation.angle()) + Deg::of(off);
            match self.ask(watch, |body, watch| body.follow(&[], Some(goal), watch)) {
                Ok(()) => self.confirm_pose(watch)?,
                Err(Unfinished::Met(_)) => {
                    self.confirm_pose(watch)?;
                    self.back_off(self.behind(self.away()), watch)?;
                }
                Err(unfinished) => return Err(unfinished),
            }
        }
        Ok(())
    }

    /// What it found to differ on this floor: of things that nobody knows those that stay.
    pub(super) fn found(&self) -> Gathered {
        let seen = self.inspector.differences();
        let mut gathered = Gathered::default();
        for look in seen.things {
            if look.sure < SURE || self.handled.contains(&look.thing) {
                continue;
            }
            match look.seen {
                ThingSeen::There => {}
                ThingSeen::Missed => gathered.missed.push(look.thing),
                ThingSeen::Moved(frame) => gathered.moved.extend(self.in_area(look.thing, frame)),
            }
        }
        let new = seen.unmapped.into_iter().filter(|new| new.sure >= SURE && new.looks >= STAYS);
        gathered.new.things = new.map(|new| new.pieces).collect();
        gathered.new.top = self.ground.height + 1.0;
        gathered
    }

    /// Things that it sees about it and that nobody knows, and what it touched.
    pub(super) fn unknown(&self) -> Outlines {
        let at = self.at();
        let is_here = |middle: Point| (middle - at).norm() <= NEAR;
        let seen = self.inspector.differences().unmapped.into_iter();
        let seen = seen.filter(|seen| seen.sure >= SURE && is_here(seen.middle()));
        let mut things: Vec<Vec<Polygon>> = seen.map(|seen| seen.pieces).collect();
        let is_told = |p: &Point| {
            let mut pieces = things.iter().flatten();
            pieces.any(|piece| piece.contains(*p, 0.0) || piece.border_distance(*p) <= UNKNOWN)
        };
        let untold: Vec<Point> = self.met.iter().filter(|p| !is_told(p)).copied().collect();
        if untold.len() >= 2 {
            things.push(vec![hull_about(&untold)]);
        }
        let mut felt = Vec::new();
        if self.felt.len() >= 2 {
            // What stands on legs that are seen reaches over them: it is one thing with those about it.
            let touched = hull_about(&self.felt);
            let size = |hull: &Polygon| (hull.bounds().max - hull.bounds().min).norm();
            let (mut legs, mut whole) = (things.clone(), touched);
            loop {
                let with = |leg: &Vec<Polygon>| {
                    let own = leg.iter().flat_map(|piece| piece.corners.iter().copied());
                    let all = own.chain(whole.corners.iter().copied()).collect();
                    Polygon::new(convex_hull(all))
                };
                let hulls = legs.iter().map(with).enumerate();
                let next = hulls.min_by(|a, b| size(&a.1).total_cmp(&size(&b.1)));
                let Some((leg, hull)) = next.filter(|(_, hull)| size(hull) <= ONE_THING) else {
                    break;
                };
                legs.swap_remove(leg);
                whole = hull;
            }
            felt.push(vec![whole]);
        }
        Outlines { things, felt, top: self.ground.height + 1.0 }
    }
}

/// Points with something about each.
fn hull_about(points: &[Point]) -> Polygon {
    let around = |p: &Point| {
        [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)]
            .map(|(x, y)| p + Vector::new(x, y) * THICK)
    };
    Polygon::new(convex_hull(points.iter().flat_map(around).collect()))
}

/// Whether most of what was met is of these outlines.
fn is_of<'o>(met: &[Point], outlines: &(impl Iterator<Item = &'o Polygon> + Clone)) -> bool {
    let is_on = |p: &&Point| {
        let mut outlines = outlines.clone();
        outlines.any(|one| one.contains(**p, 0.0) || one.border_distance(**p) <= 2.0 * UNKNOWN)
    };
    2 * met.iter().filter(is_on).count() > met.len()
}

fn middle_of(points: &[Point]) -> Point {
    let sum: Vector = points.iter().map(|p| p.coords).sum();
    Point::from(sum / points.len().max(1) as f64)
}

/// The beginning of a way, so far along.
fn ahead(from: Point, path: &[Point], mut left: f64) -> Vec<Point> {
    let mut way = vec![from];
    for &goal in path {
        let last = way[way.len() - 1];
        let length = (goal - last).norm();
        if length >= left {
            way.push(last + (goal - last) * (left / length.max(1e-9)));
            break;
        }
        left -= length;
        way.push(goal);
    }
    way
}
