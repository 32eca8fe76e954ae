//! Faces and floors as rooms, and what their kinds can be told from.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::exchange::assemble::ring::{self, Region};
use crate::exchange::{Room, Spot};
use crate::map::Properties;
use crate::map::plane::{contains, doubled_area, edges};
use crate::units::{Cm, Point};

use super::WALL;
use super::faces::{Face, Plan};

/// Open floor smaller than this is the edge of a drawing, cm².
const LEAST_FLOOR: f64 = 20_000.0;
/// Open floor narrower than this on the average is likewise, cm.
const LEAST_WIDTH: f64 = 60.0;
/// A face of which the drawn floors cover less is no room: a shaft, a yard.
const COVERED: f64 = 0.2;

/// The faces that have a floor, then what the floors cover beyond all faces.
pub(super) fn rooms(level: &str, plan: &Plan, floors: &[Vec<Point>]) -> Vec<Room> {
    let faces: Vec<Region> = plan.faces.iter().map(region).collect();
    let floors: Vec<Vec<Point>> = floors
        .iter()
        .filter(|f| f.len() >= 3)
        .map(|f| ring::counter_clockwise(f.clone()))
        .collect();
    let room = |source: String, region: &Region| Room {
        source,
        name: String::new(),
        kind: String::new(),
        outline: region.outer.clone(),
        holes: region.holes.clone(),
        height: Some(Cm::of(WALL)),
        properties: Properties::new(),
    };
    let mut rooms: Vec<Room> = faces
        .iter()
        .enumerate()
        .filter(|(_, face)| floors.is_empty() || is_covered(face, &floors))
        .map(|(i, face)| room(format!("{level}/face/{i}"), face))
        .collect();
    if !floors.is_empty() {
        let walled: Vec<Vec<Point>> = faces.iter().map(|f| f.outer.clone()).collect();
        let open = ring::overlay(&floors, &walled, OverlayRule::Difference, FillRule::NonZero);
        let open = open.iter().filter(|region| is_floor(region));
        rooms.extend(open.enumerate().map(|(i, r)| room(format!("{level}/floor/{i}"), r)));
    }
    rooms
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

/// Tells what a room is by the one named vertex in it, else by the name of a door for which it is the smaller room.
pub(super) fn name(rooms: &mut [Room], plan: &Plan, spots: &[Spot], doors: &[String]) {
    let area = |room: &Room| doubled_area(&room.outline).abs();
    for room in rooms.iter_mut() {
        let within = |spot: &&Spot| {
            contains(&room.outline, spot.at) && !room.holes.iter().any(|h| contains(h, spot.at))
        };
        let named: Vec<&Spot> = spots.iter().filter(within).collect();
        if let [only] = named[..] {
            room.kind.clone_from(&only.name);
        }
    }
    for (i, door) in doors.iter().enumerate() {
        let beside = |room: &Room| {
            plan.faces.iter().any(|f| f.outline == room.outline && f.tags.contains(&(i + 1)))
        };
        let mut beside: Vec<usize> = (0..rooms.len()).filter(|&r| beside(&rooms[r])).collect();
        beside.sort_by(|&a, &b| area(&rooms[a]).total_cmp(&area(&rooms[b])));
        // A door with one room only leads outside: its name may mean either.
        if let [smaller, _] = beside[..]
            && rooms[smaller].kind.is_empty()
        {
            rooms[smaller].kind.clone_from(door);
        }
    }
}
