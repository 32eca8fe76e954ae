//! Faces and floors as rooms, and what their kinds can be told from.

use std::collections::HashMap;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::assemble::ring::{self, Region, Ring};
use crate::map::Properties;
use crate::map::plane::{bounds, contains, doubled_area, edges};
use crate::units::{Bilingual, Cm, InOrder as _, Point, said};
use crate::{Room, Spot};

use super::faces::{Face, Plan};
use super::{METRE, WALL};

/// Open floor smaller than this is the edge of a drawing, cm².
const LEAST_FLOOR: f64 = 20_000.0;
/// Open floor narrower than this on the average is likewise, cm.
const LEAST_WIDTH: f64 = 60.0;
/// A face of which the drawn floors cover less is no room: a shaft, a yard.
const COVERED: f64 = 0.2;

/// What a level says of its floor.
pub(super) struct Drawn<'d> {
    pub(super) floors: &'d [Vec<Point>],
    pub(super) holes: &'d [Vec<Point>],
}

/// The rooms of a level.
#[derive(Default)]
pub(super) struct Found {
    /// Each with the face of the walls whose floor it is, or a part of it.
    pub(super) rooms: Vec<(Room, Option<usize>)>,
    /// Parts of rooms in which the drawing has no floor: wells, voids over a hall.
    pub(super) left_out: Vec<(String, Region)>,
}

/// The faces that have a floor or through which a lane runs, then what the floors cover beyond all faces.
///
/// Floors are drawn roughly: one may stop short of its walls, so a face is floor up to them. But what of a face the
/// drawn floors leave out, as large as a piece of floor counts, and every hole that is drawn, is none.
pub(super) fn rooms(
    level: &str,
    plan: &Plan,
    drawn: &Drawn<'_>,
    lanes: &[(Point, Point)],
) -> Found {
    let faces: Vec<Region> = plan.faces.iter().map(region).collect();
    let holes = rings(drawn.holes);
    let floors = without(rings(drawn.floors), &holes);
    let is_driven = |face: &Region| {
        lanes
            .iter()
            .any(|&(a, b)| [a, nalgebra::center(&a, &b), b].iter().any(|&p| face.contains(p)))
    };
    let room = |source: String, region: &Region| Room {
        source,
        name: String::new(),
        kind: String::new(),
        called: String::new(),
        outline: region.outer.clone(),
        holes: region.holes.clone(),
        height: Some(Cm::of(WALL)),
        properties: Properties::new(),
    };
    let mut found = Found::default();
    for (i, face) in faces.iter().enumerate() {
        let is_room = floors.is_empty() || is_covered(face, &floors) || is_driven(face);
        if !is_room {
            continue;
        }
        let source = format!("{level}/face/{i}");
        let mut none: Vec<Region> = Vec::new();
        if !floors.is_empty() {
            let drawn: Vec<Ring> = floors.iter().chain(&holes).cloned().collect();
            let bare = ring::subtract(face, &drawn);
            none.extend(bare.into_iter().filter(|part| is_floor(part) && !is_driven(part)));
        }
        none.extend(
            within(face, &holes).into_iter().filter(|hole| hole.area() >= ring::LEAST_AREA),
        );
        if none.is_empty() {
            found.rooms.push((room(source, face), Some(i)));
            continue;
        }
        let cuts: Vec<Ring> = none.iter().flat_map(|part| part.rings().cloned()).collect();
        let parts = ring::subtract(face, &cuts);
        let parts: Vec<&Region> = parts.iter().filter(|p| is_floor(p) || is_driven(p)).collect();
        for (k, part) in parts.iter().enumerate() {
            let source = if parts.len() > 1 { format!("{source}/{k}") } else { source.clone() };
            found.rooms.push((room(source, part), Some(i)));
        }
        found.left_out.extend(none.into_iter().map(|part| (source.clone(), part)));
    }
    if !floors.is_empty() {
        let walled: Vec<Vec<Point>> = faces.iter().map(|f| f.outer.clone()).collect();
        let open = ring::overlay(&floors, &walled, OverlayRule::Difference, FillRule::NonZero);
        let open = open.iter().filter(|region| is_floor(region)).enumerate();
        found.rooms.extend(open.map(|(i, r)| (room(format!("{level}/floor/{i}"), r), None)));
    }
    found
}

/// Where a piece of floor is and how large, for people.
pub(super) fn place(region: &Region) -> Bilingual {
    let (low, high) = bounds(region.outer.iter().copied());
    let middle = nalgebra::center(&low, &high) / METRE;
    said!(
        "area-at",
        area = format!("{:.1}", region.area() / 1e4),
        x = format!("{:.2}", middle.x),
        y = format!("{:.2}", middle.y)
    )
}

/// The part of drawn polygons that lies in a face.
fn within(face: &Region, drawn: &[Ring]) -> Vec<Region> {
    if drawn.is_empty() {
        return Vec::new();
    }
    let own: Vec<Ring> = face.rings().cloned().collect();
    ring::overlay(&own, drawn, OverlayRule::Intersect, FillRule::NonZero)
}

/// Drawn polygons, counter-clockwise.
fn rings(drawn: &[Vec<Point>]) -> Vec<Ring> {
    let drawn = drawn.iter().filter(|ring| ring.len() >= 3);
    drawn.map(|ring| ring::counter_clockwise(ring.clone())).collect()
}

/// Floors less the holes that are drawn into them.
fn without(floors: Vec<Ring>, holes: &[Ring]) -> Vec<Ring> {
    if holes.is_empty() {
        return floors;
    }
    let left = ring::overlay(&floors, holes, OverlayRule::Difference, FillRule::NonZero);
    left.iter().flat_map(|region| region.rings().cloned()).collect()
}

fn region(face: &Face) -> Region {
    Region { outer: face.outline.clone(), holes: face.holes.clone() }
}

fn is_covered(face: &Region, floors: &[Vec<Point>]) -> bool {
    let outer = [face.outer.clone()];
    let common = ring::overlay(&outer, floors, OverlayRule::Intersect, FillRule::NonZero);
    let covered: f64 = common.iter().map(Region::area).sum();
    covered >= COVERED * doubled_area(&face.outer) / 2.0
}

fn is_floor(region: &Region) -> bool {
    let around: f64 = region.rings().flat_map(|r| edges(r)).map(|(a, b)| (b - a).norm()).sum();
    region.area() >= LEAST_FLOOR && 2.0 * region.area() / around >= LEAST_WIDTH
}

/// What doors and vertices say of the rooms that they belong to.
pub(super) struct Named<'n> {
    pub(super) faces: &'n [Option<usize>],
    pub(super) plan: &'n Plan,
    pub(super) spots: &'n [Spot],
    /// As many as doors in the plan, in its order.
    pub(super) doors: &'n [String],
}

impl Named<'_> {
    /// Tells what a room is by the one named vertex in it, else by the name of a door for which it is the smaller room;
    /// and what it is called, where that is told twice.
    pub(super) fn tell(&self, rooms: &mut [Room]) {
        let area = |room: &Room| doubled_area(&room.outline).abs();
        let spots: Vec<Vec<&str>> = rooms.iter().map(|room| self.spots_in(room)).collect();
        for (room, spots) in rooms.iter_mut().zip(&spots) {
            if let [only] = spots[..] {
                only.clone_into(&mut room.kind);
            }
        }
        let mut of_doors: Vec<Vec<&str>> = vec![Vec::new(); rooms.len()];
        let mut is_smaller = vec![false; rooms.len()];
        for (i, door) in self.doors.iter().enumerate() {
            let beside = |r: &usize| {
                self.faces[*r].is_some_and(|f| self.plan.faces[f].tags.contains(&(i + 1)))
            };
            let mut beside: Vec<usize> = (0..rooms.len()).filter(beside).collect();
            beside.iter().for_each(|&room| of_doors[room].push(door));
            beside.order_by(|&a, &b| area(&rooms[a]).total_cmp(&area(&rooms[b])));
            // A door with one room only leads outside: its name may mean either.
            if let [smaller, _] = beside[..] {
                is_smaller[smaller] = true;
                if rooms[smaller].kind.is_empty() {
                    rooms[smaller].kind.clone_from(door);
                }
            }
        }
        let called: Vec<Option<String>> =
            (0..rooms.len()).map(|i| common_name(&of_doors[i], &spots[i], is_smaller[i])).collect();
        let mut bearers: HashMap<&str, usize> = HashMap::new();
        called.iter().flatten().for_each(|name| *bearers.entry(name).or_default() += 1);
        for (room, name) in rooms.iter_mut().zip(&called) {
            let own = name.as_ref().filter(|name| bearers[name.as_str()] == 1);
            room.called = own.cloned().unwrap_or_default();
        }
    }

    /// The names of the vertices in a room.
    fn spots_in(&self, room: &Room) -> Vec<&str> {
        let is_within =
            |at| contains(&room.outline, at) && !room.holes.iter().any(|h| contains(h, at));
        let named = self.spots.iter().filter(|spot| !spot.name.is_empty() && is_within(spot.at));
        named.map(|spot| spot.name.as_str()).collect()
    }
}

/// What all doors of a room are called but for the side on which they are: `Left consult room 3` of
/// `left_consult_rm_3_inner` and `left_consult_rm_3_outer`. A single door names its room where a vertex within is called so
/// too, or where the name says that it is a room's, and the room beyond is larger.
fn common_name(doors: &[&str], spots: &[&str], is_smaller: bool) -> Option<String> {
    let (first, others) = doors.split_first()?;
    let mut stem = stem(first);
    let agree = |stem: &[&str], of: fn(&str) -> Vec<&str>| others.iter().all(|o| of(o) == stem);
    let is_spot = doors.iter().any(|door| spots.contains(door));
    let is_told = match others {
        [] => is_spot || is_smaller && stem.iter().any(|word| is_room(word)),
        _ if agree(&stem, self::stem) => true,
        // `left_treatment_1` and `left_treatment_2`, of which one is a vertex within: the doors are numbered.
        _ => {
            stem = unnumbered(first);
            is_spot && agree(&stem, unnumbered)
        }
    };
    (is_told && !stem.is_empty()).then(|| room_words(&stem))
}

/// The words of a door's name, without the side of the room on which it is.
fn stem(door: &str) -> Vec<&str> {
    let mut words: Vec<&str> =
        door.split(['_', ' ', '-']).filter(|word| !word.is_empty()).collect();
    if words.last().is_some_and(|last| SIDES.contains(&last.to_lowercase().as_str())) {
        words.pop();
    }
    words
}

/// The same without the number of the door.
fn unnumbered(door: &str) -> Vec<&str> {
    let mut words = stem(door);
    if words.last().is_some_and(|last| last.bytes().all(|byte| byte.is_ascii_digit())) {
        words.pop();
    }
    words
}

/// On which side of its room a door is.
const SIDES: [&str; 10] =
    ["inner", "outer", "inside", "outside", "front", "back", "entry", "exit", "in", "out"];

fn is_room(word: &str) -> bool {
    matches!(word.to_lowercase().as_str(), "rm" | "room")
}

/// `L1`, `consult`, `rm`, `3` as a room's name: "L1 consult room 3"; what does not say so is said to be a room.
fn room_words(words: &[&str]) -> String {
    let says_so = words.iter().any(|word| is_room(word));
    let words = words.iter().map(|word| if is_room(word) { "room" } else { word });
    words.chain((!says_so).then_some("room")).collect::<Vec<_>>().join(" ")
}
