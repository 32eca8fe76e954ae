//! The mouth of an open doorway: the floor behind its line as far as a disc on the line reaches.
//!
//! A Fragment's floor is the Area's own and the mouths of its open doorways, in one. Where walls have no thickness the two
//! meet not on the doorway's line alone: a corridor that goes round the corner of a room lies on both sides of the room's
//! wall beside the jamb. Such a wall would be gone once both are one floor, so a slit is cut along it:
//!
//! ```text
//!      corridor     ────────────┐ <- a wall of no thickness, up to the jamb
//!    ═══════════════════════════╡
//!      room   │ mouth of the    ╎ corridor
//!             │ corridor's door ╎ <- the doorway's line
//! ```
//!
//! **Invariant**: nothing solid is lost where floors are put together; own floor that lies behind a doorway, beyond what the
//! doorway leads to, stays own floor.

use crate::units::{AreaId, Point, Vector};

use super::apart::distance;
use super::grid::{Contour, Grid, difference, intersection};
use super::obstacle::walls_in;
use super::opening::Opening;
use super::site::{SLACK, Site};
use super::storey::{Storey, THIN};
use super::{Bounds, Polygon};

impl Opening {
    /// The `s` of a line `depth` beyond the doorway's line, seen from an Area (0 or 1).
    fn past(&self, side: usize, depth: f64) -> f64 {
        self.gap / 2.0 + if side == 0 { depth } else { -depth }
    }

    fn beyond(&self, side: usize, from: f64, depth: f64) -> Polygon {
        self.rectangle(self.past(side, from), self.past(side, depth), 0.5)
    }

    /// What a disc on the doorway's line can touch, on both sides.
    pub(super) fn mouth(&self, reach: f64) -> Bounds {
        let depth = self.gap / 2.0 + reach + 2.0;
        self.rectangle(self.past(1, depth), self.past(0, depth), 0.0).bounds()
    }
}

/// What lies so far beyond a doorway's line, in cm, or deeper, until behind the [`stub`].
pub(super) fn beyond(
    grid: &Grid,
    doorway: &Opening,
    side: usize,
    from: f64,
    reach: f64,
) -> Contour {
    let depth = doorway.gap / 2.0 + 2.0 * reach + 10.0;
    grid.contour(&doorway.beyond(side, from, depth))
}

/// As [`beyond`], from the line on, without the Area's own floor that lies there behind the other Area.
pub(super) fn not_own(
    grid: &Grid,
    doorway: &Opening,
    side: usize,
    reach: f64,
    own: &[Polygon],
) -> Vec<Contour> {
    /// Areas that share a line may overlap by less, in cm.
    const BEHIND: f64 = 1.0;
    let whole = beyond(grid, doorway, side, 0.0, reach);
    let behind = doorway.beyond(side, BEHIND, doorway.gap / 2.0 + 2.0 * reach + 10.0);
    let bounds = behind.bounds();
    let own = own.iter().filter(|p| p.bounds().meets(&bounds) && distance(p, &behind) <= 0.0);
    let own: Vec<Contour> = own.map(|p| grid.contour(p)).collect();
    if own.is_empty() {
        return vec![whole];
    }
    let kept = intersection(&own, &[grid.contour(&behind)]);
    let kept: Vec<Contour> = kept.into_iter().flatten().collect();
    difference(&[whole], &kept).into_iter().flatten().collect()
}

/// The mouths of an Area's open doorways.
pub(super) struct Mouths<'s> {
    site: &'s Site<'s>,
    own: AreaId,
    reach: f64,
    /// For each open doorway what its mouth reaches into.
    stubs: Vec<Stub<'s>>,
}

struct Stub<'s> {
    doorway: &'s Opening,
    ahead: Polygon,
    /// From where to where `ahead` reaches, as the doorway's `s`.
    depths: (f64, f64),
    holes: Vec<Polygon>,
    others: Vec<AreaId>,
}

impl<'s> Mouths<'s> {
    pub(super) fn of(
        site: &'s Site<'s>,
        own: AreaId,
        open: &[(usize, &'s Opening, usize)],
        reach: f64,
    ) -> Self {
        let stubs = open.iter().map(|&(_, doorway, side)| Stub::of(site, doorway, side, reach));
        Self { site, own, reach, stubs: stubs.collect() }
    }

    /// The floor through all the doorways.
    pub(super) fn floor(&self, grid: &Grid) -> Vec<Contour> {
        self.stubs.iter().flat_map(|stub| self.floor_of(grid, stub)).collect()
    }

    fn floor_of(&self, grid: &Grid, stub: &Stub<'_>) -> Vec<Contour> {
        let site = self.site;
        let gap = stub.doorway.rectangle(-THIN, stub.doorway.gap + THIN, 0.0);
        let near = stub.ahead.bounds();
        let placed = |area: &AreaId| site.scene.areas.get(area);
        let storeys: Vec<Storey> =
            stub.others.iter().filter_map(|a| Some(Storey::of(site, placed(a)?))).collect();
        let strips = self.strips(grid, stub);
        let inner = storeys.iter().flat_map(|s| &s.inner_walls);
        let blocked: Vec<&Polygon> =
            strips.iter().chain(inner).filter(|w| distance(w, &stub.ahead) <= 0.0).collect();
        let parts: Vec<Polygon> = storeys.iter().flat_map(|s| s.floor.iter().cloned()).collect();
        if blocked.is_empty() && parts.iter().all(|p| p.is_convex(1e-9)) {
            // Two convex polygons need no overlay.
            let cut = stub.holes.iter().chain(&parts).map(|p| p.clone().within_convex(&stub.ahead));
            return cut
                .chain([gap])
                .filter(|p| p.corners.len() > 2)
                .map(|p| grid.contour(&p))
                .collect();
        }
        // A long corridor need not be overlaid whole for one of its doors.
        let parts = parts.into_iter().map(|p| p.clipped(&near.grown(1.0)));
        let solid = stub.holes.iter().cloned().chain(parts).filter(|p| p.corners.len() > 2);
        let floor: Vec<Contour> = solid.map(|p| grid.contour(&p)).collect();
        let mut cut: Vec<Contour> =
            intersection(&floor, &[grid.contour(&stub.ahead)]).into_iter().flatten().collect();
        cut.push(grid.contour(&gap));
        if blocked.is_empty() {
            return cut;
        }
        let blocked: Vec<Contour> = blocked.into_iter().map(|w| grid.contour(w)).collect();
        difference(&cut, &blocked).into_iter().flatten().collect()
    }

    /// The walls that lie in a mouth and part it from other floor: of the Area itself, and where mouths reach into several
    /// Areas, of these.
    fn strips(&self, grid: &Grid, stub: &Stub<'_>) -> Vec<Polygon> {
        let zone = stub.ahead.bounds();
        let near = |other: &&Stub<'_>| other.ahead.bounds().grown(self.reach).meets(&zone);
        let others = self.stubs.iter().filter(near).flat_map(|s| &s.others);
        let mut whose: Vec<AreaId> = others.chain([&self.own]).copied().collect();
        if let [only] = stub.others[..] {
            // Its own walls bound it; nothing lies behind them in this mouth.
            whose.retain(|&area| area != only);
        }
        whose.sort_unstable();
        whose.dedup();
        let placed = whose.iter().filter_map(|area| self.site.scene.areas.get(area));
        let walls: Vec<(Point, Point)> =
            placed.flat_map(|placed| walls_in(self.site, placed, &zone)).collect();
        // A wall that only ends at the mouth, or lies beside it, parts nothing in it; one along its rim does.
        let wide = stub.doorway.rectangle(stub.depths.0, stub.depths.1, LEAST);
        let lies_in = |&(a, b): &(Point, Point)| {
            let inside = Polygon::new(vec![a, b]).within_convex(&wide);
            let from_line = |p: &Point| (p - stub.doorway.at(0.0, 0.0)).dot(&stub.doorway.out());
            let depths = inside.corners.iter().map(from_line);
            let (low, high) =
                depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| (l.min(d), h.max(d)));
            let faces = (-LEAST, stub.doorway.gap + LEAST);
            let is_long = inside.edges().any(|(p, q)| (q - p).norm() > LEAST);
            is_long && (low < faces.0 || high > faces.1)
        };
        let within = walls.iter().filter(|w| lies_in(w));
        within.map(|&wall| thick(wall, &walls, grid)).collect()
    }
}

impl<'s> Stub<'s> {
    fn of(site: &'s Site<'s>, doorway: &'s Opening, side: usize, reach: f64) -> Self {
        let other = doorway.areas[1 - side];
        let depth = doorway.gap / 2.0 + reach + 2.0;
        let depths = (doorway.past(side, 0.0), doorway.past(side, depth));
        let ahead = doorway.rectangle(depths.0, depths.1, 0.0);
        let near = ahead.bounds();
        let mut holes = vec![doorway.rectangle(-THIN, doorway.gap + THIN, 0.0)];
        let mut others = vec![other];
        // Beyond a threshold that is less deep than the robot its next doorway counts too.
        for (_, next, at) in site.doorways_of(other) {
            let hole = next.rectangle(-THIN, next.gap + THIN, 0.0);
            if hole.bounds().meets(&near) && next != doorway && site.is_open(next) {
                holes.push(hole);
                others.push(next.areas[1 - at]);
            }
        }
        Self { doorway, ahead, depths, holes, others }
    }
}

/// Walls that lie less deep in a mouth, in cm, part nothing in it.
const LEAST: f64 = 0.01;

/// A wall as a cut through the floor, longer only where another wall goes on.
pub(super) fn thick((a, b): (Point, Point), walls: &[(Point, Point)], grid: &Grid) -> Polygon {
    /// Ends nearer than this, in cm, are one.
    const SAME: f64 = 1e-4;
    let along = (b - a).normalize();
    let half = (SLACK / 4.0).max(2.0 / grid.scale);
    let goes_on = |p: Point| {
        let meets = |q: Point| (q - p).norm() < SAME;
        walls.iter().filter(|w| meets(w.0) || meets(w.1)).count() > 1
    };
    let longer = |p: Point| if goes_on(p) { half } else { 0.0 };
    let (a, b) = (a - along * longer(a), b + along * longer(b));
    let aside = Vector::new(-along.y, along.x) * half;
    Polygon::new(vec![a - aside, b - aside, b + aside, a + aside])
}
