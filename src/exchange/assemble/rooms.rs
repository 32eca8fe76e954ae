//! Rooms of one level: their outlines cleaned, and no two of them in one place.

use crate::map::plane::{bounds, edges};
use crate::report::{What, Why};
use crate::units::said;
use crate::{Level, Report, Room};

use super::index::Index;
use super::ring::{self, Region, Ring, band, clean, common, overlay, subtract};

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

/// Overlaps less deep than this on the average are the rounding of the file, cm.
const ROUNDING: f64 = 0.2;
/// Common floor smaller than this is none, cm²; the map's checks allow 1.
const TOUCH: f64 = 0.3;
/// How far a room keeps off another that has the common floor, cm: not at all, then more than corners may move.
const MARGINS: [f64; 5] = [0.0, 0.25, 0.5, 1.0, 3.0];
/// Corners that a room may have; the map's checks allow 10 000 with the jambs.
const MOST_CORNERS: usize = 5_000;

/// The floors of a level's rooms, no two of them in one place.
pub(super) struct Floors {
    /// In the order of the level's rooms, and after them what was cut off from one; None for a room that is none.
    pub(super) regions: Vec<Option<Region>>,
    /// Of each region the room of the file.
    pub(super) rooms: Vec<usize>,
}

/// The floor of every room.
pub(super) fn floors(level: &Level, report: &mut Report) -> Floors {
    let mut regions = Vec::with_capacity(level.rooms.len());
    for room in &level.rooms {
        let corners = room.outline.len() + room.holes.iter().map(Vec::len).sum::<usize>();
        if corners > MOST_CORNERS {
            let value = corners.to_string();
            report.skipped(
                What::Room,
                &room.source,
                Why::BadValue { what: said!("number-of-corners"), value: value.into() },
            );
            regions.push(None);
            continue;
        }
        let cleaned = clean(&room.outline, &room.holes);
        if let Some(cleaned) = &cleaned {
            if cleaned.was_crossed {
                report.mended(What::Room, &room.source, Why::OutlineCrosses);
            }
            for _ in 0..cleaned.bad_holes {
                report.mended(What::Room, &room.source, Why::BadHole);
            }
        } else {
            report.skipped(What::Room, &room.source, Why::NoOutline { least: 400 });
        }
        regions.push(cleaned.map(|cleaned| cleaned.region));
    }
    let rooms = (0..regions.len()).collect();
    let mut floors = Floors { regions, rooms };
    floors.part(level, report);
    floors
}

impl Floors {
    /// Takes common floor from the larger of two rooms, and drops a room that is drawn twice. What another room cuts off
    /// stays floor: a room of its own.
    ///
    /// A cut makes new corners, and corners nearer than [`NEAR`](super::ring::NEAR) become one: along a wall of ten
    /// metres that alone is more common floor than the map's checks allow. So rooms that were cut are looked at again,
    /// and then keep a hair off those that they still reach into.
    fn part(&mut self, level: &Level, report: &mut Report) {
        let mut is_new = vec![true; self.regions.len()];
        for margin in MARGINS {
            let mut known = 0;
            // What was cut off may lie in further rooms.
            while known < self.regions.len() {
                known = self.regions.len();
                is_new = self.part_once(level, &is_new, margin, report);
                is_new.resize(self.regions.len(), true);
            }
            if !is_new.contains(&true) {
                return;
            }
        }
    }

    /// Parts the rooms of which one is new; tells which rooms were cut.
    fn part_once(
        &mut self,
        level: &Level,
        is_new: &[bool],
        margin: f64,
        report: &mut Report,
    ) -> Vec<bool> {
        let is_first = margin <= 0.0;
        let count = self.regions.len();
        let index = Index::of(&self.regions);
        let mut was_cut = vec![false; count];
        for i in 0..count {
            let Some(one) = &self.regions[i] else { continue };
            for j in index.near_box(bounds(one.outer.iter().copied())) {
                if j <= i || !(is_new[i] || is_new[j]) {
                    continue;
                }
                let (Some(one), Some(other)) = (&self.regions[i], &self.regions[j]) else {
                    continue;
                };
                if boxes_apart(one, other) {
                    continue;
                }
                let (area, around) = common(one, other);
                if area <= TOUCH {
                    continue;
                }
                let source = |room: usize| &level.rooms[self.rooms[room]].source;
                if is_first && area > 0.95 * one.area().max(other.area()) {
                    let twice = Why::RoomTwice { other: source(i).clone() };
                    report.skipped(What::Room, source(j), twice);
                    self.regions[j] = None;
                    continue;
                }
                // The smaller room keeps the floor: a closet drawn into its hall.
                let (loser, winner) = if one.area() > other.area() { (i, j) } else { (j, i) };
                let (from, what) = if loser == i { (one, other) } else { (other, one) };
                let mut rest = remaining(from, what, margin);
                was_cut[loser] = true;
                let (loser_source, other) = (source(loser), source(winner).clone());
                if is_first && area > ROUNDING * around / 2.0 {
                    report.mended(What::Room, loser_source, Why::RoomsOverlap { other });
                }
                if rest.has_crumbs {
                    report.mended(What::Room, loser_source, Why::RoomCut);
                }
                if rest.floors.is_empty() {
                    report.skipped(What::Room, loser_source, Why::NoOutline { least: 400 });
                }
                if rest.floors.len() > 1 {
                    let parts = rest.floors.len();
                    report.mended(What::Room, loser_source, Why::RoomParted { parts });
                }
                let more = rest.floors.split_off(rest.floors.len().min(1));
                let room = self.rooms[loser];
                self.rooms.extend(more.iter().map(|_| room));
                self.regions.extend(more.into_iter().map(Some));
                self.regions[loser] = rest.floors.pop();
                if self.regions[i].is_none() {
                    break;
                }
            }
        }
        was_cut
    }

    /// The level with a room for each further floor; none where every room kept its floor in one piece.
    pub(super) fn parted(&self, level: &Level) -> Option<Level> {
        let further = self.rooms.iter().zip(&self.regions).skip(level.rooms.len());
        let room = |(&room, floor): (&usize, &Option<Region>)| {
            let of = level.rooms[room].clone();
            match floor {
                Some(floor) => {
                    Room { outline: floor.outer.clone(), holes: floor.holes.clone(), ..of }
                }
                None => of,
            }
        };
        let further: Vec<Room> = further.map(room).collect();
        let rooms = || level.rooms.iter().cloned().chain(further.iter().cloned()).collect();
        (!further.is_empty()).then(|| Level { rooms: rooms(), ..level.clone() })
    }
}

/// Neighbours wall to wall, the usual case, need no boolean operation.
fn boxes_apart(one: &Region, other: &Region) -> bool {
    let (a, b) = (bounds(one.outer.iter().copied()), bounds(other.outer.iter().copied()));
    let common = a.1.inf(&b.1) - a.0.sup(&b.0);
    common.x < 1e-4 || common.y < 1e-4
}

/// What is left of a room.
struct Rest {
    /// Pieces on which one can stand, the largest first; the only one whatever its breadth.
    floors: Vec<Region>,
    /// More than crumbs had to go besides.
    has_crumbs: bool,
}

/// What is left of a room when another takes the common floor and so much around it.
fn remaining(from: &Region, what: &Region, margin: f64) -> Rest {
    let mut rings: Vec<Ring> = what.rings().cloned().collect();
    if margin > 0.0 {
        rings.extend(what.rings().flat_map(|ring| edges(ring)).map(|side| band(side, margin)));
    }
    // A ring's sense tells floor from hole; as one clip it must be a union.
    let taken = overlay(&rings, &[], OverlayRule::Subject, FillRule::NonZero);
    let taken: Vec<_> = taken.iter().flat_map(|r| r.rings().cloned()).collect();
    let parts = subtract(from, &taken);
    let all: f64 = parts.iter().map(Region::area).sum();
    let mut floors = ring::floors(parts);
    let mut is_largest = true;
    floors.retain(|floor| std::mem::replace(&mut is_largest, false) || is_broad(floor));
    let kept: f64 = floors.iter().map(Region::area).sum();
    Rest { has_crumbs: !floors.is_empty() && all - kept > 400.0, floors }
}

/// Whether a piece of floor is as broad on the average as the least room is: slivers between two outlines are none.
fn is_broad(floor: &Region) -> bool {
    const LEAST: f64 = 20.0;
    let around: f64 = floor.rings().flat_map(|ring| edges(ring)).map(|(a, b)| (b - a).norm()).sum();
    2.0 * floor.area() >= LEAST * around
}
