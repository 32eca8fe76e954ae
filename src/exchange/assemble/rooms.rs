//! Rooms of one level: their outlines cleaned, and no two of them in one place.

use crate::exchange::report::{What, Why};
use crate::exchange::{Level, Report};
use crate::map::plane::{bounds, edges};

use super::index::Index;
use super::ring::{Region, Ring, band, clean, common, largest, overlay, subtract};

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

/// The floor of every room, in the order of the level's; None for a room that is none.
pub(super) fn regions(level: &Level, report: &mut Report) -> Vec<Option<Region>> {
    let mut regions = Vec::with_capacity(level.rooms.len());
    for room in &level.rooms {
        let corners = room.outline.len() + room.holes.iter().map(Vec::len).sum::<usize>();
        if corners > MOST_CORNERS {
            let value = corners.to_string();
            report.skipped(What::Room, &room.source, Why::BadValue { what: "число углов", value });
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
    part(level, &mut regions, report);
    regions
}

/// Takes common floor from the larger of two rooms, and drops a room that is drawn twice.
///
/// A cut makes new corners, and corners nearer than [`NEAR`](super::ring::NEAR) become one: along a wall of ten metres
/// that alone is more common floor than the map's checks allow. So rooms that were cut are looked at again, and then
/// keep a hair off those that they still reach into.
fn part(level: &Level, regions: &mut [Option<Region>], report: &mut Report) {
    let index = Index::of(regions);
    let mut is_new = vec![true; regions.len()];
    for margin in MARGINS {
        is_new = part_once(level, regions, &index, &is_new, margin, report);
        if !is_new.contains(&true) {
            return;
        }
    }
}

/// Parts the rooms of which one is new; tells which rooms were cut.
fn part_once(
    level: &Level,
    regions: &mut [Option<Region>],
    index: &Index,
    is_new: &[bool],
    margin: f64,
    report: &mut Report,
) -> Vec<bool> {
    let is_first = margin <= 0.0;
    let mut was_cut = vec![false; regions.len()];
    for i in 0..regions.len() {
        let Some(one) = &regions[i] else { continue };
        for j in index.near_box(bounds(one.outer.iter().copied())) {
            if j <= i || !(is_new[i] || is_new[j]) {
                continue;
            }
            let (Some(one), Some(other)) = (&regions[i], &regions[j]) else { continue };
            if boxes_apart(one, other) {
                continue;
            }
            let (area, around) = common(one, other);
            if area <= TOUCH {
                continue;
            }
            let sources = (&level.rooms[i].source, &level.rooms[j].source);
            if is_first && area > 0.95 * one.area().max(other.area()) {
                let twice = Why::RoomTwice { other: sources.0.clone() };
                report.skipped(What::Room, sources.1, twice);
                regions[j] = None;
                continue;
            }
            // The smaller room keeps the floor: a closet drawn into its hall.
            let (loser, winner) = if one.area() > other.area() { (i, j) } else { (j, i) };
            let (rest, is_less) = match (&regions[loser], &regions[winner]) {
                (Some(from), Some(what)) => remaining(from, what, margin),
                _ => continue,
            };
            was_cut[loser] = true;
            let source = &level.rooms[loser].source;
            if is_first && area > ROUNDING * around / 2.0 {
                let other = level.rooms[winner].source.clone();
                report.mended(What::Room, source, Why::RoomsOverlap { other });
            }
            if is_less {
                report.mended(What::Room, source, Why::RoomCut);
            }
            if rest.is_none() {
                report.skipped(What::Room, source, Why::NoOutline { least: 400 });
            }
            regions[loser] = rest;
            if regions[i].is_none() {
                break;
            }
        }
    }
    was_cut
}

/// Neighbours wall to wall, the usual case, need no boolean operation.
fn boxes_apart(one: &Region, other: &Region) -> bool {
    let (a, b) = (bounds(one.outer.iter().copied()), bounds(other.outer.iter().copied()));
    let common = a.1.inf(&b.1) - a.0.sup(&b.0);
    common.x < 1e-4 || common.y < 1e-4
}

/// What is left of a room when another takes the common floor and so much around it, and whether more than crumbs had
/// to go besides.
fn remaining(from: &Region, what: &Region, margin: f64) -> (Option<Region>, bool) {
    let mut rings: Vec<Ring> = what.rings().cloned().collect();
    if margin > 0.0 {
        rings.extend(what.rings().flat_map(|ring| edges(ring)).map(|side| band(side, margin)));
    }
    // A ring's sense tells floor from hole; as one clip it must be a union.
    let taken = overlay(&rings, &[], OverlayRule::Subject, FillRule::NonZero);
    let taken: Vec<_> = taken.iter().flat_map(|r| r.rings().cloned()).collect();
    let parts = subtract(from, &taken);
    let all: f64 = parts.iter().map(Region::area).sum();
    let rest = largest(parts);
    let is_less = rest.as_ref().is_some_and(|r| all - r.area() > 400.0);
    (rest, is_less)
}
