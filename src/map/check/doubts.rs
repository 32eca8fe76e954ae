//! What a map says that reads well and cannot be: things in one another, things that hover, a doorway that furniture
//! bars, a place where nobody can stand, words that nothing understands, metres written for centimetres.
//!
//! None of it hinders the use of a map, so all of it is told as a warning, by [`doubts`] alone: reading and editing do
//! not ask. The tolerances are those within which the rules take one thing to stand on another ([`Tolerances`]), and walls, doors
//! and things are held against each other as solids of their own Area; a thing that sticks through a wall is a fault of
//! [`check`](super::check).

mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use miette::Diagnostic;

use crate::fault::{Fault, MapError, Record, Spot};
use crate::units::{AreaId, Bilingual, Cm, DoorId, InOrder as _, Point, said, word};
use crate::{Area, Orthoframe, Permeability, Replica, World};

use super::group::{Body, bodies_of};
use super::placed::place;
use super::plane::{
    Bounds, border_distance, bounds, contains, edges, intersection, middle, near_pairs,
    segment_distance, touch,
};
use super::{OVERLAP, Short, TOLERANCE, at};

/// Within what one thing is taken to stand on another, to hang, to lean and to lie in it, in cm: as the rules say that tell
/// relations, so that no thing of which they speak is doubted for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// A thing may be so far above the floor.
    pub floor: f64,
    /// So far it may be from the wall, and from the thing above, that it hangs from,
    pub hanging: f64,
    /// and so far from the ceiling.
    pub ceiling: f64,
    /// It may sink so far into the thing that bears it, or be so far above it.
    pub support: f64,
    /// What leans on a thing comes so near to it.
    pub beside: f64,
    /// What is within a container may stick out so far.
    pub inside: f64,
    /// How far two things may reach into one another sidewards before it is no slip of the tape.
    pub overlap: f64,
    /// How deep a doorway reaches into each of its rooms.
    pub doorway: f64,
    /// What is smaller was written in metres.
    pub least: LeastSizes,
}

/// The least sizes that such things have, in cm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSizes {
    /// How wide an Area is,
    pub room: f64,
    /// and how high.
    pub ceiling: f64,
    /// How wide and how high a door is.
    pub door: f64,
    /// The largest size of a piece of furniture.
    pub furniture: f64,
    /// Of the robot, as are its height and, in cm/s, its speed.
    pub radius: f64,
    pub height: f64,
    pub speed: f64,
}

/// Of one sort of doubt so many are told, and the rest counted: a plan shifted against itself has them by thousands.
const MOST_ALIKE: usize = 5;

/// What may be written of a checked world and cannot be, every fault a warning. `near` and `rule_words` are
/// of the rules: within what things stand on one another, and the traits that rules of the user's own know.
///
/// ```
/// use std::collections::BTreeSet;
/// use orthoframe_map::{LeastSizes, Tolerances, World, doubts};
///
/// # std::env::set_current_dir("../..").unwrap();
/// let mut world = World::load("maps/rb2.toml").unwrap();
/// let least = LeastSizes {
///     room: 10.0, ceiling: 15.0, door: 5.0, furniture: 10.0, radius: 2.0, height: 2.5, speed: 2.5,
/// };
/// let near = Tolerances {
///     floor: 8.0, hanging: 8.0, ceiling: 16.0, support: 2.0, beside: 5.0, inside: 5.0, overlap: 1.0, doorway: 10.0, least,
/// };
/// assert!(doubts(&world, &near, &BTreeSet::new()).is_empty());
/// world.robot.speed = 0.6;
/// let told = doubts(&world, &near, &BTreeSet::new())[0].to_string();
/// assert_eq!(told, "робот, speed: размер 0.6 - не метры ли это?");
/// ```
#[must_use]
pub fn doubts(world: &World, near: &Tolerances, rule_words: &BTreeSet<String>) -> Vec<Fault> {
    let mut doubter = Doubter { world, near: *near, faults: Vec::new() };
    doubter.measures();
    let mut things: BTreeMap<AreaId, Vec<Thing<'_>>> = BTreeMap::new();
    for replica in world.replicas.values() {
        things.entry(replica.area).or_default().push(Thing::of(world, replica));
    }
    for (area, things) in &things {
        let area = &world.areas[area];
        doubter.overlaps(things);
        doubter.hovering(area, things);
        doubter.doorways(area, things);
    }
    doubter.places(&things);
    doubter.marks();
    doubter.traits(rule_words);
    few_alike(doubter.faults)
}

/// Of each sort the first, then how many more there are.
fn few_alike(faults: Vec<Fault>) -> Vec<Fault> {
    let code = |fault: &Fault| Diagnostic::code(fault).map_or_else(String::new, |c| c.to_string());
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    faults.iter().for_each(|fault| *counts.entry(code(fault)).or_default() += 1);
    let mut told: BTreeMap<String, usize> = BTreeMap::new();
    let mut few = Vec::new();
    for fault in faults {
        let kind = code(&fault);
        let (count, no) = (counts[&kind], told.entry(kind.clone()).or_default());
        *no += 1;
        if *no <= MOST_ALIKE || count == MOST_ALIKE + 1 {
            few.push(fault);
        } else if *no == MOST_ALIKE + 1 {
            let error = MapError::MoreAlike { count: count - MOST_ALIKE, kind };
            few.push(Fault::new(error, fault.spots));
        }
    }
    few
}

/// How a solid lets others in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Open {
    No,
    /// From above alone, as a cup.
    Above,
    /// From aside or below: what reaches into it may reach out of it too.
    Around,
}

impl Open {
    fn of(orthoframe: &Orthoframe) -> Self {
        let is_open = |permeability| permeability != Permeability::Impermeable;
        let aside = orthoframe.base.iter().any(|side| is_open(side.permeability));
        match (aside || is_open(orthoframe.base_permeability), orthoframe.roof_permeability) {
            (true, _) => Self::Around,
            (false, roof) if is_open(roof) => Self::Above,
            (false, _) => Self::No,
        }
    }

    /// Whether `inner` can have come into `outer`, which is open so: what came from above is within its rim, or stands
    /// out above it.
    fn lets(self, inner: &Body, outer: &Body, near: &Tolerances) -> bool {
        match self {
            Self::No => false,
            Self::Above => inner.top >= outer.top || is_within(inner, outer, near),
            Self::Around => true,
        }
    }
}

/// A replica with its solids in the frame of its Area.
struct Thing<'w> {
    replica: &'w Replica,
    bodies: Vec<Body>,
    open: Vec<Open>,
    /// Made to hold others, whatever its solids let through.
    is_container: bool,
    is_light: bool,
    is_person: bool,
}

impl<'w> Thing<'w> {
    fn of(world: &'w World, replica: &'w Replica) -> Self {
        let items = &world.objects[&replica.object].items;
        let mut bodies = bodies_of(world, items);
        bodies.iter_mut().for_each(|body| place(body, &replica.frame));
        let has = |wanted: &str| world.has_trait(replica.id, wanted);
        Self {
            replica,
            bodies,
            open: items.iter().map(|i| Open::of(world.orthoframe_of(i))).collect(),
            is_container: has("container") || has("shelves"),
            is_light: has("light"),
            is_person: has("person"),
        }
    }

    fn at(&self) -> Spot {
        Spot::of(Record::Replica(self.replica.id)).field("at")
    }

    fn bottom(&self) -> f64 {
        self.bodies.iter().map(|b| b.bottom).fold(f64::INFINITY, f64::min)
    }

    fn top(&self) -> f64 {
        self.bodies.iter().map(|b| b.top).fold(f64::NEG_INFINITY, f64::max)
    }
}

struct Doubter<'w> {
    world: &'w World,
    near: Tolerances,
    faults: Vec<Fault>,
}

impl Doubter<'_> {
    fn doubt(&mut self, error: MapError, spots: Vec<Spot>) {
        self.faults.push(Fault::new(error, spots));
    }

    /// Rooms, doors, furniture and robots of sizes that no such thing has in centimetres, and has in metres.
    fn measures(&mut self) {
        let (world, least) = (self.world, self.near.least);
        let mut told = BTreeSet::new();
        for area in world.areas.values() {
            let bodies = bodies_of(world, &area.items);
            let base = area.items.iter().find(|i| i.is_base).or(area.items.first());
            let Some(base) = base.map(|item| item.orthoframe) else { continue };
            let (low, high) = bounds(bodies.iter().flat_map(|b| b.polygon.iter().copied()));
            let size = high - low;
            let height = bodies.iter().map(|b| b.top - b.bottom).fold(0.0, f64::max);
            let what = || Bilingual::named(word!("area"), &area.name);
            let spot = Spot::of(Record::Orthoframe(base));
            let is_high = height <= 0.0 || height >= least.ceiling;
            if size.min() >= least.room && is_high || !told.insert(base) {
                continue;
            }
            if size.min() < least.room {
                let size = [size.x, size.y, height];
                self.metres(what(), &size, spot.field("base_vectors"));
            } else {
                self.metres(what(), &[height], spot.field("height"));
            }
        }
        for door in world.doors.values() {
            let what = Bilingual::named(word!("door-2"), &door.name);
            let spot = Spot::of(Record::Door(door.id));
            if door.width.get() < least.door {
                self.metres(what, &[door.width.get()], spot.field("width"));
            } else if door.height.get() < least.door {
                self.metres(what, &[door.height.get()], spot.field("height"));
            }
        }
        for object in world.objects.values() {
            let is = |wanted| world.types.object.has_trait(object.object_type, wanted);
            if !["seat", "bed", "support"].into_iter().any(is) || is("portable") {
                continue;
            }
            let bodies = bodies_of(world, &object.items);
            let (low, high) = bounds(bodies.iter().flat_map(|b| b.polygon.iter().copied()));
            let top = bodies.iter().map(|b| b.top).fold(0.0, f64::max);
            let size = high - low;
            if size.max().max(top) < least.furniture {
                let what = Bilingual::named(word!("object"), &object.name);
                self.metres(what, &[size.x, size.y, top], Spot::of(Record::Object(object.id)));
            }
        }
        let robot = &world.robot;
        for (field, value, least) in [
            ("radius", robot.radius.get(), least.radius),
            ("height", robot.height.get(), least.height),
            ("speed", robot.speed, least.speed),
        ] {
            if value < least {
                let what = said!("the-robot-s", field);
                self.metres(what, &[value], Spot::of(Record::Robot).field(field));
            }
        }
    }

    fn metres(&mut self, what: Bilingual, sizes: &[f64], spot: Spot) {
        let line = |factor: f64| {
            let shown = sizes.iter().map(|size| Short(size * factor).to_string());
            shown.collect::<Vec<_>>().join(" × ")
        };
        self.doubt(MapError::Metres { what, size: line(1.0), wanted: line(100.0) }, vec![spot]);
    }

    /// Solids of two things in one place.
    fn overlaps(&mut self, things: &[Thing<'_>]) {
        let near = self.near;
        let (owners, boxes) = solids(things);
        let mut found: BTreeMap<(usize, usize), Point> = BTreeMap::new();
        near_pairs(&boxes, 0.0, |i, j| {
            let ((a, m), (b, n)) = (owners[i], owners[j]);
            let pair = (a.min(b), a.max(b));
            if a != b
                && !found.contains_key(&pair)
                && let Some(p) = clash((&things[a], m), (&things[b], n), &near)
            {
                found.insert(pair, p);
            }
            ControlFlow::Continue(())
        });
        for ((a, b), p) in found {
            let (one, other) = (&things[a], &things[b]);
            let error = MapError::ThingsOverlap {
                thing: other.replica.name.clone(),
                other: one.replica.name.clone(),
                at: at(p),
            };
            self.doubt(error, vec![other.at(), one.at()]);
        }
    }

    /// Things that nothing bears, and that no wall, ceiling or neighbour holds.
    fn hovering(&mut self, area: &Area, things: &[Thing<'_>]) {
        let (world, near) = (self.world, self.near);
        let rooms = bodies_of(world, &area.items);
        let walls = walls(world, area);
        let (owners, boxes) = solids(things);
        let mut is_held = vec![false; things.len()];
        for (no, thing) in things.iter().enumerate() {
            is_held[no] =
                thing.is_light || thing.is_person || is_fixed(thing, &rooms, &walls, &near);
        }
        let mut neighbours = Vec::new();
        near_pairs(&boxes, near.beside, |i, j| {
            let ((a, m), (b, n)) = (owners[i], owners[j]);
            if a != b {
                for ((a, m), (b, n)) in [((a, m), (b, n)), ((b, n), (a, m))] {
                    let (body, other) = (&things[a].bodies[m], &things[b].bodies[n]);
                    if is_held[a] || !touch(&body.polygon, &other.polygon, near.beside) {
                        continue;
                    }
                    if stands(&things[a], body, other, &near)
                        && intersection(&body.polygon, &other.polygon).area > OVERLAP
                    {
                        is_held[a] = true;
                    } else if hangs(body, other, &near) || body.heights_meet(other, 0.0) {
                        neighbours.push((a, b));
                    }
                }
            }
            ControlFlow::Continue(())
        });
        // A neighbour holds only what it can: two that hover side by side both do.
        let firm = is_held.clone();
        neighbours.into_iter().for_each(|(a, b)| is_held[a] |= firm[b]);
        for thing in things.iter().zip(is_held).filter(|(_, held)| !held).map(|(thing, _)| thing) {
            let beneath = |body: &&Body| {
                let meets = |b: &&Body| {
                    let size = b.bounds.1.inf(&body.bounds.1) - b.bounds.0.sup(&body.bounds.0);
                    size.x > 0.0 && size.y > 0.0
                };
                body.top <= thing.bottom()
                    && (thing.bodies.iter().filter(meets))
                        .any(|b| intersection(&b.polygon, &body.polygon).area > 0.0)
            };
            let others = things.iter().filter(|other| other.replica.id != thing.replica.id);
            let below = others.flat_map(|other| other.bodies.iter().map(move |b| (other, b)));
            let below = below.filter(|(_, body)| beneath(body));
            let nearest = below.max_by(|(_, a), (_, b)| a.top.total_cmp(&b.top));
            let floor = rooms.iter().map(|b| b.bottom).fold(f64::INFINITY, f64::min);
            let (over, height) = match nearest {
                Some((other, body)) => {
                    (Bilingual::quoted(&other.replica.name), thing.bottom() - body.top)
                }
                None => (said!("the-floor"), thing.bottom() - floor),
            };
            let error = MapError::ThingHovers {
                thing: thing.replica.name.clone(),
                over,
                height: Cm::of((height * 100.0).round() / 100.0),
            };
            self.doubt(error, vec![thing.at()]);
        }
    }

    /// Doorways of which things leave less than the robot needs.
    fn doorways(&mut self, area: &Area, things: &[Thing<'_>]) {
        let world = self.world;
        let robot = &world.robot;
        let needed = robot.passing_width();
        for mount in &area.doors {
            let door = &world.doors[&mount.door];
            let doorway = threshold(world, area.id, mount.door, self.near.doorway);
            let Some(doorway) = doorway else { continue };
            let (length, width) = (doorway.length, door.width.get());
            if width < needed {
                continue;
            }
            let mut taken: Vec<(f64, f64, usize)> = Vec::new();
            for (no, thing) in things.iter().enumerate() {
                let tall = thing.bodies.iter().filter(|b| {
                    b.bottom < robot.height.get().min(door.height.get())
                        && b.top > robot.step.get() + TOLERANCE
                });
                taken
                    .extend(tall.filter_map(|b| doorway.taken(b)).map(|(from, to)| (from, to, no)));
            }
            taken.order_by(|a, b| a.0.total_cmp(&b.0));
            let (mut free, mut reached) = (0.0_f64, 0.0_f64);
            let mut in_the_way: BTreeSet<usize> = BTreeSet::new();
            for (from, to, no) in taken {
                free = free.max(from - reached);
                reached = reached.max(to);
                in_the_way.insert(no);
            }
            free = free.max(length - reached);
            let Some(&first) = in_the_way.first().filter(|_| free < needed) else { continue };
            let names: Vec<Bilingual> =
                in_the_way.iter().map(|&no| Bilingual::quoted(&things[no].replica.name)).collect();
            let error = MapError::DoorwayBarred {
                door: door.name.clone(),
                things: Bilingual::list(&names),
                free: Cm::of((free * 100.0).round() / 100.0),
                width: door.width,
            };
            self.doubt(error, vec![things[first].at(), Spot::of(Record::Door(door.id))]);
        }
    }

    /// Places that lie in what stands on the floor.
    fn places(&mut self, things: &BTreeMap<AreaId, Vec<Thing<'_>>>) {
        let robot = &self.world.robot;
        for spot in self.world.places.values() {
            let is_over = |body: &Body| {
                body.bottom < robot.height.get()
                    && body.top > robot.step.get() + TOLERANCE
                    && contains(&body.polygon, spot.at)
            };
            let mut here = things.get(&spot.area).into_iter().flatten();
            if let Some(thing) = here.find(|thing| thing.bodies.iter().any(is_over)) {
                let error = MapError::PlaceUnder {
                    place: spot.name.clone(),
                    thing: thing.replica.name.clone(),
                };
                let place = Spot::of(Record::Place(spot.id)).field("at");
                self.doubt(error, vec![place, thing.at()]);
            }
        }
    }
}

/// Every solid of every thing: which thing, which of its solids, and its box.
fn solids(things: &[Thing<'_>]) -> (Vec<(usize, usize)>, Vec<Bounds>) {
    let all = things.iter().enumerate().flat_map(|(no, thing)| {
        thing.bodies.iter().enumerate().map(move |(part, body)| ((no, part), body.bounds))
    });
    all.unzip()
}

/// Where two solids are in one another, unless one stands on the other, lies in it, or lets it through.
fn clash(
    (one, m): (&Thing<'_>, usize),
    (other, n): (&Thing<'_>, usize),
    near: &Tolerances,
) -> Option<Point> {
    let (a, b) = (&one.bodies[m], &other.bodies[n]);
    // People sit in what bears them.
    if one.is_person
        || other.is_person
        || one.open[m].lets(b, a, near)
        || other.open[n].lets(a, b, near)
        || a.top.min(b.top) - a.bottom.max(b.bottom) <= near.overlap
    {
        return None;
    }
    let stands = |upper: &Body, lower: &Body| {
        upper.top > lower.top && lower.top - upper.bottom <= near.support
    };
    if stands(a, b) || stands(b, a) {
        return None;
    }
    if (one.is_container && is_within(b, a, near)) || (other.is_container && is_within(a, b, near))
    {
        return None;
    }
    let common = intersection(&a.polygon, &b.polygon);
    let outline = common.outlines.first()?;
    let around: f64 = edges(outline).map(|(p, q)| (q - p).norm()).sum();
    (common.area > near.overlap * around / 2.0).then(|| middle(outline))
}

/// Whether a solid is in another, which may be open above.
fn is_within(inner: &Body, outer: &Body, near: &Tolerances) -> bool {
    inner.bottom >= outer.bottom - near.inside
        && inner.polygon.iter().all(|&p| {
            contains(&outer.polygon, p) || border_distance(&outer.polygon, p) <= near.inside
        })
}

/// Whether a thing stands with one of its solids on or in a solid below. Any of its lowest will do: a bench may stand on
/// a step and on the floor.
fn stands(thing: &Thing<'_>, body: &Body, other: &Body, near: &Tolerances) -> bool {
    body.bottom <= thing.bottom() + near.floor
        && body.bottom <= other.top + near.support
        && body.bottom >= other.bottom - near.support
}

/// Whether a solid hangs from one above it.
fn hangs(body: &Body, other: &Body, near: &Tolerances) -> bool {
    (other.bottom - body.top).abs() <= near.hanging
}

/// Whether the floor, the ceiling or a wall holds a thing.
fn is_fixed(
    thing: &Thing<'_>,
    rooms: &[Body],
    walls: &[(Point, Point)],
    near: &Tolerances,
) -> bool {
    let (bottom, top) = (thing.bottom(), thing.top());
    let is_here =
        |room: &&Body| thing.bodies.iter().any(|b| touch(&b.polygon, &room.polygon, near.beside));
    let floors = rooms.iter().filter(is_here);
    let by_floor = floors.clone().any(|room| bottom - room.bottom <= near.floor);
    by_floor
        || floors.clone().any(|room| room.top - top <= near.ceiling)
        || thing.bodies.iter().any(|body| {
            walls.iter().any(|&(a, b)| {
                body.polygon.iter().any(|&p| segment_distance(p, (a, b)) <= near.hanging)
                    || [a, b].iter().any(|&p| border_distance(&body.polygon, p) <= near.hanging)
                    || edges(&body.polygon).any(|e| super::plane::meeting(e, (a, b)).is_some())
            })
        })
}

/// The solid sides of an Area.
fn walls(world: &World, area: &Area) -> Vec<(Point, Point)> {
    let sides = area.items.iter().flat_map(|item| {
        let base = &world.orthoframe_of(item).base;
        let solid = base.iter().filter(|v| v.permeability == Permeability::Impermeable);
        solid.map(|v| (item.frame.apply(v.start), item.frame.apply(v.end)))
    });
    sides.collect()
}

/// A doorway as its room sees it: from the right jamb along the threshold, and inwards.
struct Doorway {
    right: Point,
    along: crate::units::Vector,
    length: f64,
    /// The strip before the threshold.
    strip: Vec<Point>,
}

fn threshold(world: &World, area: AreaId, door: DoorId, depth: f64) -> Option<Doorway> {
    let (right, left) = world.threshold(area, door)?;
    let length = (left - right).norm();
    let along = (left - right).try_normalize(1e-9)?;
    // The base runs counter-clockwise: the room is on the left of the way from right to left.
    let inwards = crate::units::Vector::new(-along.y, along.x) * depth;
    let strip = vec![right, left, left + inwards, right + inwards];
    Some(Doorway { right, along, length, strip })
}

impl Doorway {
    /// The stretch of the threshold before which a solid stands.
    fn taken(&self, body: &Body) -> Option<(f64, f64)> {
        let common = intersection(&self.strip, &body.polygon);
        // A touch takes nothing.
        if common.area < OVERLAP {
            return None;
        }
        let along = common.outlines.iter().flatten().map(|p| (p - self.right).dot(&self.along));
        let stretch = along.fold((f64::INFINITY, 0.0_f64), |(a, b), t| (a.min(t), b.max(t)));
        Some((stretch.0.max(0.0), stretch.1.min(self.length)))
    }
}
