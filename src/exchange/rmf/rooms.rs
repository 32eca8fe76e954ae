//! Faces and floors as rooms, and what their kinds can be told from.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::exchange::assemble::ring::{self, Region, Ring};
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

/// The faces that have a floor or through which a lane runs, then what the floors cover beyond all faces.
pub(super) fn rooms(
    level: &str,
    plan: &Plan,
    floors: &[Vec<Point>],
    holes: &[Vec<Point>],
    lanes: &[(Point, Point)],
) -> Vec<Room> {
    let faces: Vec<Region> = plan.faces.iter().map(region).collect();
    let floors = without(rings(floors), &rings(holes));
    let is_driven = |face: &Region| {
        lanes
            .iter()
            .any(|&(a, b)| [a, nalgebra::center(&a, &b), b].iter().any(|&p| face.contains(p)))
    };
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
        .filter(|(_, face)| floors.is_empty() || is_covered(face, &floors) || is_driven(face))
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

/// Tells what a room is by the one named vertex in it, else by the name of a door for which it is the smaller room.
pub(super) fn name(rooms: &mut [Room], plan: &Plan, spots: &[Spot], doors: &[String]) {
    let area = |room: &Room| doubled_area(&room.outline).abs();
    for room in rooms.iter_mut() {
        let within = |spot: &&Spot| {
            contains(&room.outline, spot.at) && !room.holes.iter().any(|h| contains(h, spot.at))
        };
        let named: Vec<&Spot> =
            spots.iter().filter(|spot| !spot.name.is_empty()).filter(within).collect();
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
