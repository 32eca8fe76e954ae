//! Free floor of a Fragment (W1): what is left for the robot of an Area's base, and why the rest is not.
//!
//! After paper 1, section 7: the Area's base, less the bases of all Orthoframes between what the robot drives
//! over and its height, less the dead zones. Unlike the paper's, a dead zone is found by the robot's size: it is
//! floor that the disc covers from no place where it fits, nor the footprint at any heading ([`super::coverage`]).
//!
//! A Fragment's floor ends on the lines of its doorways. Near an open doorway the neighbour's floor and
//! furniture are taken into account as far as the robot's radius reaches, so that both Fragments agree on where
//! the robot fits through.
//!
//! What is free and where the robot's centre may be is kept as convex cells alone; outlines are drawn round them when
//! they are asked for.
//!
//! **Invariant**: what is free and the dead zones do not overlap and together are the floor inside the doorways'
//! lines; centre space lies in it, at least the robot's radius and clearance (less [`SLACK`]) from everything.

use std::f64::consts::FRAC_PI_2;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::units::{AreaId, InOrder as _, Point, Vector};

use super::blocker::Obstacle;
use super::buckets::Buckets;
use super::coverage::Coverage;
use super::dead_zone::dead_zones;
use super::edging::Edging;
use super::grid::{Contour, Grid, Outlines, Shapes, difference, overlays, smooth};
use super::mesh::{Mesh, NONE};
use super::mouth::{Mouths, beyond, not_own};
use super::obstacle::{leaves_near, obstacles_near, walls};
use super::offset::{grow, shrink};
use super::on_demand::{Folded, OnDemand};
use super::opening::Opening;
use super::passframe::{Beyond, Passframe, PassframeId, ids};
use super::scene::Prism;
use super::site::{SLACK, Site};
use super::storey::{Storey, THIN};
use super::zone::obstacles_of;
use super::{Bounds, Region, nearest_on_segment};

/// Rounds in which fewer Passframes are looked for in vain.
const PATIENCE: usize = 1;

/// An edge of the centre space on a doorway's line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Exit {
    /// Its number among the doorways of the Area.
    pub(super) doorway: usize,
    pub(super) cell: u32,
    pub(super) edge: usize,
}

/// The floor of one Fragment, in the Map's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FragmentFloor {
    pub area: AreaId,
    /// Of the Area's base.
    pub bounds: Bounds,
    /// Height of the floor in the Map's frame, in cm.
    pub level: f64,
    /// See [`Self::raw`].
    pub(super) bare: Outlines,
    /// The grid of the outlines and cells.
    pub(super) grid: Grid,
    pub(super) obstacles: Folded<Vec<Obstacle>>,
    /// Walls and jambs, whatever the state of the doors.
    pub walls: Vec<(Point, Point)>,
    pub(super) dead: Outlines,
    pub(super) dead_zones: OnDemand<Vec<Region>>,
    pub(super) edging: Edging,
    /// The cells of the Passframes, sorted by place.
    pub(super) frames: Mesh,
    /// The ids of the Passframes, in the order of the cells.
    pub(super) ids: Vec<PassframeId>,
    pub(super) passframes: OnDemand<Vec<Passframe>>,
    /// Where the robot's centre passes between places where it may turn.
    pub(super) lanes: Vec<(Point, Point)>,
    /// A convex partition of `centre`.
    pub(super) cells: Mesh,
    pub(super) exits: Vec<Exit>,
}

impl FragmentFloor {
    /// Builds the floor of one Area of the site's scene.
    pub(super) fn build(site: &Site<'_>, area: AreaId) -> Self {
        let placed = &site.scene.areas[&area];
        let reach = site.reach();
        let bounds = placed.prisms.iter().fold(Bounds::EMPTY, |b, p| b.union(&p.bounds));
        let grid = Grid::turned(&bounds.grown(4.0 * reach + 200.0), main_axis(&placed.prisms));
        let storey = Storey::of(site, placed);
        let open: Vec<_> = site.doorways_of(area).filter(|(_, d, _)| site.is_open(d)).collect();

        let mut zones: Vec<Bounds> =
            storey.floor.iter().map(|p| p.bounds().grown(10.0 * THIN)).collect();
        zones.extend(open.iter().map(|(_, d, _)| d.mouth(reach).grown(10.0 * THIN)));
        let mut obstacles = storey.closed_floor.clone();
        obstacles.extend(obstacles_near(site, &storey, &zones));
        obstacles.extend(leaves_near(site, area));
        obstacles.extend(obstacles_of(site.zones, &zones, site.robot.height.get()));
        let mut floor: Vec<Contour> = storey.floor.iter().map(|p| grid.contour(p)).collect();
        let mut beyond: Vec<Contour> = Vec::new();
        floor.extend(Mouths::of(site, area, &open, reach).floor(&grid));
        for &(_, doorway, side) in &open {
            beyond.extend(not_own(&grid, doorway, side, reach, &storey.floor));
        }
        let mut blocked: Vec<Contour> =
            obstacles.iter().map(|o| grid.contour(&o.polygon)).collect();
        blocked.extend(storey.inner_walls.iter().map(|p| grid.contour(p)));

        let mut inside = difference(&floor, &blocked);
        let (raw, bare) = (grid.regions(&inside), Outlines::of(&inside));
        let [all_centres, centre] = overlays(
            &shrink(&grid, &raw, reach - SLACK),
            &beyond,
            [OverlayRule::Subject, OverlayRule::Difference],
            FillRule::Positive,
        );
        let covered = grow(&grid, &grid.regions(&all_centres), reach - SLACK, &raw);
        // Run through clockwise, what lies beyond the doorways' lines is taken from what lies inside.
        beyond.iter_mut().for_each(|b| b.reverse());
        let inside: Vec<Contour> = inside.drain(..).flatten().chain(beyond).collect();
        let [free, dead] = overlays(
            &covered,
            &inside,
            [OverlayRule::Intersect, OverlayRule::InverseDifference],
            FillRule::Positive,
        );
        let free = smooth(free);

        let mut cells = Mesh::of(&grid, &centre, 0);
        let frames = Mesh::of(&grid, &free, PATIENCE);
        debug_assert!(cells.fills(&grid, &centre) && frames.fills(&grid, &free), "{area:?}");
        let exits = exits(&cells, &open);
        exits.iter().for_each(|exit| cells.bend_at(exit.cell, exit.edge));
        let walls = walls(site, placed);
        let dead = Outlines::of(&dead_zones(&grid, dead));
        let mut built = Self {
            area,
            bounds,
            level: storey.level,
            bare,
            grid,
            obstacles: Folded::of(&obstacles),
            walls,
            dead,
            dead_zones: OnDemand::default(),
            edging: Edging::default(),
            ids: ids(&frames),
            passframes: OnDemand::default(),
            frames,
            lanes: Vec::new(),
            cells,
            exits,
        };
        built.edging = Edging::of(site, area, &obstacles, storey.sides);
        built
    }

    /// The same floor with what a robot with a footprint covers: free where it was dead for its disc. `lanes` are those of
    /// the straits that lead over it.
    pub(super) fn with_footprint(
        &self,
        inside: Shapes,
        coverage: &Coverage<'_>,
        lanes: Vec<(Point, Point)>,
    ) -> Self {
        let inside: Vec<Contour> = inside.into_iter().flatten().collect();
        let zones = difference(&inside, &contours(&self.grid, &self.free()));
        let (mut left, mut dead) = (Vec::new(), Shapes::new());
        for zone in zones {
            let of_disc = dead_zones(&self.grid, vec![zone.clone()]);
            if of_disc.is_empty() {
                left.extend(zone);
                continue;
            }
            let of_footprint = coverage.left_of(&zone);
            left.extend(of_footprint.iter().flatten().cloned());
            dead.extend(dead_zones(&self.grid, of_footprint));
        }
        let free = smooth(difference(&inside, &left));
        let frames = Mesh::of(&self.grid, &free, PATIENCE);
        debug_assert!(frames.fills(&self.grid, &free), "{:?}", self.area);
        Self {
            dead: Outlines::of(&dead),
            dead_zones: OnDemand::default(),
            ids: ids(&frames),
            passframes: OnDemand::default(),
            frames,
            lanes,
            ..self.clone()
        }
    }

    /// The floor that nothing stands on up to the lines of its open doorways, each told with its side, or so much further,
    /// in cm; for a robot that keeps `reach` from everything.
    pub(super) fn inside<'a>(
        &self,
        open: impl Iterator<Item = (&'a Opening, usize)>,
        further: f64,
        reach: f64,
    ) -> Shapes {
        let grid = &self.grid;
        let beyond: Vec<Contour> =
            open.map(|(d, side)| beyond(grid, d, side, further, reach)).collect();
        difference(&contours(grid, &self.raw()), &beyond)
    }

    /// The doorways that it names, by their numbers among those of the Area.
    pub(super) fn doorways(&self) -> impl Iterator<Item = usize> + '_ {
        let along = self.edging.doorways.iter().filter_map(|face| match face.beyond {
            Beyond::Doorway { doorway, .. } => Some(doorway),
            _ => None,
        });
        along.chain(self.exits.iter().map(|exit| exit.doorway))
    }

    /// Whether the robot's centre may be at `p`.
    #[must_use]
    pub fn fits(&self, p: Point) -> bool {
        self.cells.locate(p, 1e-6).is_some()
    }

    /// Floor that nothing stands on, dead zones included; reaches into the open doorways' other sides.
    #[must_use]
    pub fn raw(&self) -> Vec<Region> {
        self.bare.regions(&self.grid)
    }

    /// Floor that the robot covers from no place and at no heading; what stands around, see
    /// [`super::FloorPlan::around`].
    #[must_use]
    pub fn dead_zones(&self) -> &[Region] {
        self.dead_zones.get(|| self.dead.regions(&self.grid))
    }

    /// Floor that nothing stands on and that the robot covers from somewhere.
    #[must_use]
    pub fn free(&self) -> Vec<Region> {
        self.frames.outline()
    }

    /// Where the robot's centre may be.
    #[must_use]
    pub fn centre(&self) -> Vec<Region> {
        self.cells.outline()
    }

    /// The id of the Passframe that holds a point of the floor.
    pub(super) fn passframe_id_at(&self, p: Point) -> Option<PassframeId> {
        self.frames.locate(p, 1e-3).map(|cell| self.ids[cell as usize])
    }

    /// The dead zone that holds a point of the floor.
    #[must_use]
    pub fn dead_zone_at(&self, p: Point) -> Option<&Region> {
        self.dead_zones().iter().find(|z| z.contains(p, 1e-3))
    }

    /// What takes floor away.
    #[must_use]
    pub fn obstacles(&self) -> &[Obstacle] {
        self.obstacles.get()
    }

    /// What stands on a point of the floor.
    #[must_use]
    pub fn obstacle_at(&self, p: Point) -> Option<&Obstacle> {
        self.obstacles().iter().find(|o| o.polygon.contains(p, 1e-6))
    }
}

/// The angle within a quarter turn at which most walls stand in line with others, in radians; of equals that of the
/// longest walls.
fn main_axis(prisms: &[Prism]) -> f64 {
    /// Walls whose angles differ less are parallel: so much is left of turning a straight room.
    const PARALLEL: f64 = 1e-7;
    /// Parallel walls nearer to one line, in cm, are in line.
    const IN_LINE: f64 = 1e-4;
    let edges = prisms.iter().flat_map(|p| p.polygon.edges());
    let mut walls: Vec<(f64, Point, Vector)> = edges
        .map(|(a, b)| {
            let angle = (b - a).y.atan2((b - a).x).rem_euclid(FRAC_PI_2);
            // Just below a quarter turn is just below none.
            (if FRAC_PI_2 - angle < PARALLEL { 0.0 } else { angle }, a, b - a)
        })
        .collect();
    walls.order_by(|a, b| a.0.total_cmp(&b.0));
    let mut best = (0, 0.0, 0.0);
    for parallel in walls.chunk_by(|a, b| b.0 - a.0 < PARALLEL) {
        let angle = parallel[0].0;
        let axis = Vector::new(angle.cos(), angle.sin());
        let line = |&(_, at, along): &(f64, Point, Vector)| {
            let is_along = along.dot(&axis).abs() > along.perp(&axis).abs();
            (is_along, if is_along { axis.perp(&at.coords) } else { axis.dot(&at.coords) })
        };
        let mut lines: Vec<(bool, f64)> = parallel.iter().map(line).collect();
        lines.order_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let is_same = |w: &&[(bool, f64)]| w[0].0 == w[1].0 && w[1].1 - w[0].1 < IN_LINE;
        let in_line = lines.windows(2).filter(is_same).count();
        let length: f64 = parallel.iter().map(|wall| wall.2.norm()).sum();
        if in_line > best.0 || (in_line == best.0 && length > best.1 * (1.0 + 1e-9)) {
            best = (in_line, length, angle);
        }
    }
    if best.2 < PARALLEL { 0.0 } else { best.2 }
}

pub(super) fn contours(grid: &Grid, regions: &[Region]) -> Vec<Contour> {
    regions.iter().flat_map(Region::contours).map(|c| grid.contour(c)).collect()
}

/// The edges of the centre space that lie on open doorways.
fn exits(cells: &Mesh, open: &[(usize, &Opening, usize)]) -> Vec<Exit> {
    const TOUCH: f64 = 0.01;
    let lines: Vec<(Point, Point)> = open.iter().map(|(_, d, _)| d.line()).collect();
    let boxes: Vec<Bounds> = lines.iter().map(|&(u, v)| Bounds::of([u, v]).grown(TOUCH)).collect();
    let buckets = Buckets::of(&boxes);
    let mut found = Vec::new();
    if open.is_empty() {
        return found;
    }
    for cell in cells.cells() {
        for (edge, across) in cells.across(cell).iter().enumerate() {
            if across != NONE {
                continue;
            }
            let (a, b) = cells.edge(cell, edge);
            let on_line = |i: &&u32| {
                let (u, v) = lines[**i as usize];
                [a, b].into_iter().all(|p| (p - nearest_on_segment(p, u, v)).norm() < TOUCH)
            };
            if let Some(&i) = buckets.near(a).iter().find(on_line) {
                found.push(Exit { doorway: open[i as usize].0, cell, edge });
            }
        }
    }
    found
}
