//! From a route over the floor to the terms in which people tell a way: doors, turns, lengths, landmarks.
//!
//! ```text
//!        +-------- D2 --+        One room's part of a route: in by D1, the way the door faces; the polyline without
//!        |        /     |        its small bends is one stretch; out by D2. The turns are the angles between the door
//!        D1 ---->'      |        that was passed, the stretches, and the door ahead, so that their sum is the angle
//!        +--------------+        between the two doors.
//! ```
//!
//! Where the way through an opening is straight, it is told straight, however obliquely the wall stands to it.
//!
//! Invariant: lengths add up to the route's, but for what small bends add; no landmark is told whose name is borne by
//! another thing of its room.

use crate::geometry::{FloorPlan, Opening, PlacedReplica, nearest_on_segment};
use crate::language::directions::{Directions, Exit, Goal, RoomPart, Side, Stretch, Turn, Turns};
use crate::language::names::named;
use crate::language::report::{Named, OpeningKind};
use crate::map::{Entity, World};
use crate::semantics::{Relations, Thresholds};
use crate::units::{AreaId, Deg, InOrder as _, Point, Vector};

use super::known::Known;
use super::located::End;
use super::route::RouteAnswer;
use super::{Error, State};

/// So many landmarks a stretch.
const LANDMARKS: usize = 2;

impl State {
    /// A way over the map in the terms of people. `heading` is how one stands at its beginning, where that is known.
    ///
    /// # Errors
    /// There is no map. No way has no directions.
    pub fn directions(
        &self,
        answer: &RouteAnswer,
        heading: Option<Deg>,
    ) -> Result<Option<Directions>, Error> {
        self.around()?.directions(answer, heading)
    }
}

impl Known {
    /// A way in the terms of people. `heading` is how one stands at its beginning, where that is known.
    ///
    /// # Errors
    /// There is no map. No way has no directions.
    pub(super) fn directions(
        &self,
        answer: &RouteAnswer,
        heading: Option<Deg>,
    ) -> Result<Option<Directions>, Error> {
        let Ok(route) = &answer.route else { return Ok(None) };
        let (world, relations) = (self.world(), self.relations()?);
        let mut line: &[Point] = &route.points;
        let start = line.first().copied();
        let floor = self.floor(answer.map)?;
        let guide = Guide { world, relations, floor, end: &answer.end, start };
        let near = relations.thresholds();
        let mut start = None;
        let mut facing = heading.map(|h| {
            let (sin, cos) = h.sin_cos();
            Vector::new(cos, sin)
        });
        // The part of the way in each Area, and the doorway by which it is left.
        let mut pieces: Vec<(Vec<Point>, Option<&Opening>)> = Vec::new();
        for (n, stage) in answer.stages.iter().enumerate() {
            let goes_on = n + 1 < answer.stages.len();
            let door = stage.leaves_by.filter(|_| goes_on).map(|d| &*guide.floor.doorways()[d]);
            let mut piece: Vec<Point> = start.into_iter().collect();
            let crossing = door.map(|door| crossing(door, stage.area, line));
            let taken = crossing.map_or(line.len(), |(taken, _)| taken);
            piece.extend(&line[..taken]);
            piece.extend(crossing.map(|(_, at)| at));
            pieces.push((piece, door));
            line = &line[taken..];
            start = crossing.map(|(_, at)| at);
        }
        let mut passages = Vec::new();
        for (n, (stage, (piece, door))) in answer.stages.iter().zip(&pieces).enumerate() {
            let stretches = guide.stretches(stage.area, piece, facing);
            let last = last_direction(piece, near.way_jog).or(facing);
            let next = pieces.get(n + 1);
            let straight = next.and_then(|(next, _)| straight_through(piece, next, near));
            let out = door.map(|door| straight.unwrap_or_else(|| way_through(door, stage.area)));
            let exit = door.zip(out).map(|(door, out)| guide.exit(door, last, out));
            let room = named(world, Entity::Area(stage.area));
            passages.push(RoomPart { room, stretches, exit });
            facing = out;
        }
        let goal = match &answer.end {
            End::Entity(Entity::Area(_)) | End::Lift => Goal::Room,
            End::Entity(entity) => Goal::Thing(named(world, *entity)),
            End::Point => Goal::Point(answer.to.clone()),
        };
        Ok((!passages.is_empty()).then_some(Directions { passages, goal, turns: near.into() }))
    }
}

/// Unit vector out of an Area through one of its doorways.
fn way_through(door: &Opening, from: AreaId) -> Vector {
    if door.areas[0] == from { door.out() } else { -door.out() }
}

/// Where a line first passes the middle of a doorway on its way out of an Area: how many of its points lie before, and
/// the point. A line that never does (it begins in the doorway) passes it at its first point.
fn crossing(door: &Opening, from: AreaId, line: &[Point]) -> (usize, Point) {
    let (origin, out) = (door.at(0.0, door.gap / 2.0), way_through(door, from));
    let along = door.at(1.0, door.gap / 2.0) - origin;
    let (right, left) = door.span();
    let ahead = |p: &Point| (p - origin).dot(&out);
    for (n, pair) in line.windows(2).enumerate() {
        let (before, behind) = (ahead(&pair[0]), ahead(&pair[1]));
        if before > 1e-6 || behind < -1e-6 || behind - before < 1e-9 {
            continue;
        }
        let at = pair[0] + (pair[1] - pair[0]) * (-before / (behind - before)).clamp(0.0, 1.0);
        let t = (at - origin).dot(&along);
        if (right - 1.0..=left + 1.0).contains(&t) {
            return (n + 1, at);
        }
    }
    (0, line.first().copied().unwrap_or(origin))
}

/// A line without the bends that a person would not notice, nearer than `jog` to the straight way, cm (Ramer, Douglas
/// and Peucker).
fn plain(line: &[Point], jog: f64) -> Vec<Point> {
    let (Some(&first), Some(&last)) = (line.first(), line.last()) else { return Vec::new() };
    let off = |p: &Point| (p - nearest_on_segment(*p, first, last)).norm();
    let inner = line.iter().enumerate().skip(1).take(line.len().saturating_sub(2));
    let farthest = inner.map(|(n, p)| (off(p), n)).max_by(|a, b| a.0.total_cmp(&b.0));
    match farthest.filter(|(d, _)| *d > jog) {
        None if line.len() < 2 => vec![first],
        None => vec![first, last],
        Some((_, n)) => {
            let mut kept = plain(&line[..=n], jog);
            kept.pop();
            kept.extend(plain(&line[n..], jog));
            kept
        }
    }
}

/// The signed angle from one direction to another, degrees counter-clockwise.
fn turn(from: Vector, to: Vector) -> f64 {
    from.perp(&to).atan2(from.dot(&to)).to_degrees()
}

fn direction(a: Point, b: Point) -> Option<Vector> {
    (b - a).try_normalize(1.0)
}

fn last_direction(piece: &[Point], jog: f64) -> Option<Vector> {
    plain(piece, jog).windows(2).rev().find_map(|pair| direction(pair[0], pair[1]))
}

/// The direction in which a way passes straight from one part of it to the next; none where it turns there.
fn straight_through(before: &[Point], after: &[Point], near: &Thresholds) -> Option<Vector> {
    let into = last_direction(before, near.way_jog)?;
    let on = plain(after, near.way_jog).windows(2).find_map(|pair| direction(pair[0], pair[1]))?;
    let from = along(before.iter().rev(), near.way_through)?;
    let through = direction(from, along(after.iter(), near.way_through)?)?;
    let is_straight = |a: Vector, b: Vector| turn(a, b).abs() < near.turn_straight;
    (is_straight(into, through) && is_straight(through, on) && is_straight(into, on))
        .then_some(into)
}

/// The point so far along a line, in cm, or its end.
fn along<'p>(line: impl Iterator<Item = &'p Point>, far: f64) -> Option<Point> {
    let (mut left, mut at) = (far, None::<Point>);
    for &next in line {
        if let Some(from) = at {
            let length = (next - from).norm();
            if length >= left {
                return Some(from + (next - from) * (left / length.max(1e-9)));
            }
            left -= length;
        }
        at = Some(next);
    }
    at
}

struct Guide<'e> {
    world: &'e World,
    relations: &'e Relations,
    floor: &'e FloorPlan,
    end: &'e End,
    /// Where the way begins.
    start: Option<Point>,
}

impl Guide<'_> {
    fn stretches(&self, area: AreaId, piece: &[Point], mut facing: Option<Vector>) -> Vec<Stretch> {
        let (landmarks, near) = (self.landmarks(area), self.relations.thresholds());
        let mut stretches: Vec<Stretch> = Vec::new();
        // Corners of the plain line with the lengths of the real one between them.
        let corners = plain(piece, near.way_jog);
        let turns = Turns::from(near);
        for pair in corners.windows(2) {
            let Some(way) = direction(pair[0], pair[1]) else { continue };
            let length = (pair[1] - pair[0]).norm();
            let angle = facing.map(|facing| turn(facing, way));
            let passed = if length < near.way_told {
                Vec::new()
            } else {
                passed(&landmarks, (pair[0], pair[1]), way, near.way_beside)
            };
            facing = Some(way);
            match (stretches.last_mut(), angle) {
                // What goes on nearly straight is the same stretch.
                (Some(last), Some(angle)) if turns.name(angle) == Turn::Straight => {
                    last.length += length;
                    last.passed.extend(passed);
                    last.passed.truncate(LANDMARKS);
                }
                (before, angle) => {
                    let bends =
                        before.is_some() && angle.is_some_and(|a| turns.name(a) != Turn::Straight);
                    let at = bends.then(|| nearest(&landmarks, pair[0], near.way_bend)).flatten();
                    stretches.push(Stretch { angle, at, length, passed });
                }
            }
        }
        let mut told: Vec<Named> = Vec::new();
        let mut is_new = |thing: &Named| {
            let is_new = !told.contains(thing);
            told.push(thing.clone());
            is_new
        };
        for stretch in &mut stretches {
            stretch.passed.retain(|(_, thing)| is_new(thing));
        }
        let mut turned_at: Vec<Named> = Vec::new();
        for stretch in &mut stretches {
            stretch.at = stretch.at.take().filter(|thing| !turned_at.contains(thing));
            turned_at.extend(stretch.at.clone());
        }
        // Turning by a thing is enough to be told of it once.
        for n in 1..stretches.len() {
            if let Some(at) = stretches[n].at.clone() {
                stretches[n].passed.retain(|(_, thing)| *thing != at);
                stretches[n - 1].passed.retain(|(_, thing)| *thing != at);
            }
        }
        stretches
    }

    /// Things on the floor of a room that are there to stay, that are not at the way's own ends and whose names no other
    /// thing of the room bears.
    fn landmarks(&self, area: AreaId) -> Vec<(&PlacedReplica, Named)> {
        let here: Vec<&PlacedReplica> = self.floor.scene().replicas_in(area).collect();
        let name = |thing: &PlacedReplica| self.world.name(Entity::Replica(thing.id));
        let near = self.relations.thresholds();
        let most_moved = near.way_landmark * 100.0;
        let stays = |thing: &&&PlacedReplica| {
            let replica = &self.world.replicas[&thing.id];
            *self.end != End::Entity(Entity::Replica(thing.id))
                && self.start.is_none_or(|start| distance(thing, start, start) >= near.way_told)
                && f64::from(replica.move_prob) <= most_moved
                && !self.world.has_trait(thing.id, "portable")
                && self.relations.support_of(thing.id).is_none()
                && here.iter().filter(|other| name(other) == name(thing)).count() == 1
        };
        let things = here.iter().filter(stays);
        things.map(|thing| (*thing, named(self.world, Entity::Replica(thing.id)))).collect()
    }

    fn exit(&self, door: &Opening, last: Option<Vector>, out: Vector) -> Exit {
        let is_passage = door
            .door
            .and_then(|d| self.world.doors.get(&d))
            .is_none_or(|d| d.kind == crate::map::DoorKind::Passage);
        let opening = if is_passage { OpeningKind::Passage } else { OpeningKind::Door };
        let name = door.door.map(Entity::Door).filter(|d| !self.world.name(*d).is_empty());
        let angle = last.map_or(0.0, |last| turn(last, out));
        Exit { opening, name: name.map(|d| named(self.world, d)), angle }
    }
}

fn distance(thing: &PlacedReplica, a: Point, b: Point) -> f64 {
    let edges = thing.prisms.iter().flat_map(|p| p.polygon.edges());
    edges.map(|(c, d)| segments_apart((a, b), (c, d))).fold(f64::INFINITY, f64::min)
}

/// Distance between two segments that do not cross.
fn segments_apart((a, b): (Point, Point), (c, d): (Point, Point)) -> f64 {
    let to = |p: Point, (q, r): (Point, Point)| (p - nearest_on_segment(p, q, r)).norm();
    to(a, (c, d)).min(to(b, (c, d))).min(to(c, (a, b))).min(to(d, (a, b)))
}

/// What one passes between two points within reach, in order, the nearest only, and nothing that lies across the way.
fn passed(
    landmarks: &[(&PlacedReplica, Named)],
    (a, b): (Point, Point),
    way: Vector,
    reach: f64,
) -> Vec<(Side, Named)> {
    let length = (b - a).norm();
    let mut beside: Vec<(f64, f64, Side, &Named)> = landmarks
        .iter()
        .filter_map(|(thing, name)| {
            let middle = nalgebra::center(&thing.bounds.min, &thing.bounds.max);
            let along = (middle - a).dot(&way);
            let away = distance(thing, a, b);
            let corners = || thing.prisms.iter().flat_map(|p| p.polygon.edges()).map(|(p, _)| p);
            let side = match () {
                () if corners().all(|p| way.perp(&(p - a)) > 0.0) => Side::Left,
                () if corners().all(|p| way.perp(&(p - a)) < 0.0) => Side::Right,
                () => return None,
            };
            (away <= reach && along > 0.0 && along < length).then_some((away, along, side, name))
        })
        .collect();
    beside.order_by(|x, y| x.0.total_cmp(&y.0));
    beside.truncate(LANDMARKS);
    beside.order_by(|x, y| x.1.total_cmp(&y.1));
    beside.into_iter().map(|(_, _, side, name)| (side, name.clone())).collect()
}

fn nearest(landmarks: &[(&PlacedReplica, Named)], at: Point, reach: f64) -> Option<Named> {
    let away = landmarks.iter().map(|(thing, name)| (distance(thing, at, at), name));
    let nearest = away.filter(|(d, _)| *d <= reach).min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map(|(_, name)| name.clone())
}
