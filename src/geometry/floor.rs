//! Free floor of a Fragment (W1): what is left for the robot of an Area's base, and why the rest is not.
//!
//! After paper 1, section 7: the Area's base, less the bases of all Orthoframes between what the robot drives
//! over and its height, less the dead zones. Unlike the paper's, a dead zone is found by the robot's size: it is
//! floor that the disc covers from no place where it fits.
//!
//! A Fragment's floor ends on the lines of its doorways. Near an open doorway the neighbour's floor and
//! furniture are taken into account as far as the robot's radius reaches, so that both Fragments agree on where
//! the robot fits through.
//!
//! **Invariant**: `free` and the dead zones do not overlap and together are the floor inside the doorways'
//! lines; `centre` lies in `free`, at least the robot's radius and clearance (less [`SLACK`]) from everything.

use std::collections::BTreeMap;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::map::{DoorKind, DoorState, DoorStatus, Permeability, RobotProfile, World};
use crate::units::{AreaId, DoorId, Point, ReplicaId, Vector};

use super::doors::{Doorway, distance, object_leaves};
use super::grid::{Contour, Grid, Shapes, difference, intersection, overlays, smooth};
use super::mesh::{Mesh, NONE};
use super::offset::{grow, shrink};
use super::passframe::{Passframe, passframes};
use super::plan::DoorStates;
use super::scene::{PlacedArea, PlacedReplica, Prism, Scene};
use super::{Bounds, Polygon, Region, nearest_on_segment};

/// A passage exactly as wide as the robot is passable: so much is forgiven, in cm.
pub const SLACK: f64 = 0.004;
/// What has no thickness is given this to either side, in cm, so that it has a place on the floor.
const THIN: f64 = 0.01;

/// What takes floor away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Blocker {
    /// An Orthoframe of a replica.
    Replica { replica: ReplicaId, item: usize },
    /// A leaf of a door between Areas.
    DoorLeaf { door: DoorId, leaf: usize },
    /// A leaf of a replica's own door.
    ReplicaLeaf { replica: ReplicaId, door: DoorId, leaf: usize },
    /// A wall, by the side that stands on it.
    Wall { area: AreaId, item: usize, side: usize },
    /// A piece of the Area's floor that lies too high or too low, or under a low ceiling.
    Floor { area: AreaId, item: usize },
}

/// A piece of floor that is taken, and the heights between which.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    pub blocker: Blocker,
    pub polygon: Polygon,
    /// Above the floor, in cm.
    pub bottom: f64,
    pub top: f64,
}

/// Floor that the robot cannot cover from any place where it fits.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadZone {
    pub region: Region,
    /// What stands around it.
    pub owners: Vec<Blocker>,
    /// The narrowest gap between two of them that is too narrow for the robot, in cm.
    pub gap: Option<f64>,
}

/// An edge of the centre space on a doorway's line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Exit {
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
    /// Floor that nothing stands on, dead zones included; reaches into the open doorways' other sides.
    pub raw: Vec<Region>,
    pub free: Vec<Region>,
    /// Where the robot's centre may be.
    pub centre: Vec<Region>,
    pub obstacles: Vec<Obstacle>,
    /// Walls and jambs, whatever the state of the doors.
    pub walls: Vec<(Point, Point)>,
    pub dead_zones: Vec<DeadZone>,
    /// Sorted by place; see [`Passframe::id`].
    pub passframes: Vec<Passframe>,
    /// The cells of `passframes`, in the same order.
    pub(super) frames: Mesh,
    /// A convex partition of `centre`.
    pub(super) cells: Mesh,
    pub(super) exits: Vec<Exit>,
}

/// What a Fragment's floor is made from.
pub(super) struct Site<'a> {
    pub(super) world: &'a World,
    pub(super) scene: &'a Scene,
    /// Replicas near any place.
    pub(super) nearby: &'a dyn Fn(&Bounds) -> Vec<ReplicaId>,
    pub(super) doorways: &'a [Doorway],
    pub(super) by_area: &'a BTreeMap<AreaId, Vec<(usize, usize)>>,
    pub(super) robot: &'a RobotProfile,
    pub(super) states: &'a DoorStates,
}

impl Site<'_> {
    /// How far the robot's centre keeps from everything.
    pub(super) fn reach(&self) -> f64 {
        (self.robot.radius.get() + self.robot.clearance.get()).max(2.0 * SLACK)
    }

    pub(super) fn state(&self, door: DoorId) -> DoorState {
        self.states
            .get(&door)
            .copied()
            .or_else(|| self.world.doors.get(&door).map(|d| d.state))
            .unwrap_or(DoorState::CLOSED)
    }

    /// Whether the robot may try to pass: the door stands open, high enough, and without a step.
    pub(super) fn is_open(&self, doorway: &Doorway) -> bool {
        let door_admits = match (doorway.door, doorway.permeability) {
            (None, Permeability::Permeable) => true,
            (None, _) => false,
            (Some(door), _) => {
                let high_enough = self.world.doors.get(&door).is_none_or(|d| {
                    d.height.get() <= 0.0 || d.height.get() >= self.robot.height.get()
                });
                let state = self.state(door);
                let stands_open = state.status == DoorStatus::Open && state.opening > 0.0;
                high_enough && (stands_open || self.is_passage(door))
            }
        };
        door_admits && doorway.rise.abs() <= self.robot.step.get().max(0.0) + 1e-9
    }

    fn is_passage(&self, door: DoorId) -> bool {
        self.world.doors.get(&door).is_some_and(|d| d.kind == DoorKind::Passage)
    }

    /// The doorways of an Area, each with the Area's index in it.
    pub(super) fn doorways_of(
        &self,
        area: AreaId,
    ) -> impl Iterator<Item = (usize, &Doorway, usize)> {
        let own = self.by_area.get(&area).map_or(&[][..], Vec::as_slice);
        own.iter().map(|&(doorway, side)| (doorway, &self.doorways[doorway], side))
    }
}

impl FragmentFloor {
    /// Builds the floor of one Area of the site's scene.
    pub(super) fn build(site: &Site<'_>, area: AreaId) -> Self {
        let placed = &site.scene.areas[&area];
        let reach = site.reach();
        let bounds = placed.prisms.iter().fold(Bounds::EMPTY, |b, p| b.union(&p.bounds));
        let grid = Grid::over(&bounds.grown(4.0 * reach + 200.0));
        let storey = Storey::of(site, placed);
        let open: Vec<_> = site.doorways_of(area).filter(|(_, d, _)| site.is_open(d)).collect();

        let mut obstacles = storey.closed_floor.clone();
        obstacles.extend(obstacles_near(site, &storey, &bounds.grown(3.0 * reach)));
        obstacles.extend(leaves_near(site, area));
        let mut floor: Vec<Contour> = storey.floor.iter().map(|p| grid.contour(p)).collect();
        let mut beyond: Vec<Contour> = Vec::new();
        for &(_, doorway, side) in &open {
            floor.extend(stub(site, &grid, doorway, side, reach));
            beyond.push(grid.contour(&doorway.beyond(side, 2.0 * reach + 10.0)));
        }
        let mut blocked: Vec<Contour> =
            obstacles.iter().map(|o| grid.contour(&o.polygon)).collect();
        blocked.extend(storey.inner_walls.iter().map(|p| grid.contour(p)));

        let mut inside = difference(&floor, &blocked);
        let raw = grid.regions(&inside);
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

        let cells = Mesh::of(&grid, &centre);
        let frames = Mesh::of(&grid, &free);
        let exits = exits(&cells, &open);
        let walls = walls(site, placed);
        let dead_zones = dead_zones(&grid, &dead, area, &obstacles, &storey.sides, reach);
        let mut built = Self {
            area,
            bounds,
            level: storey.level,
            raw,
            free: grid.regions(&free),
            centre: grid.regions(&centre),
            obstacles,
            walls,
            dead_zones,
            passframes: Vec::new(),
            frames,
            cells,
            exits,
        };
        built.passframes = passframes(site, &built, &storey.sides);
        built
    }

    /// Whether the robot's centre may be at `p`.
    #[must_use]
    pub fn fits(&self, p: Point) -> bool {
        self.cells.locate(p, 1e-6).is_some()
    }

    /// The Passframe that holds a point of the floor.
    #[must_use]
    pub fn passframe_at(&self, p: Point) -> Option<&Passframe> {
        self.frames.locate(p, 1e-3).map(|cell| &self.passframes[cell as usize])
    }

    /// The dead zone that holds a point of the floor.
    #[must_use]
    pub fn dead_zone_at(&self, p: Point) -> Option<&DeadZone> {
        self.dead_zones.iter().find(|z| z.region.contains(p, 1e-3))
    }

    /// What stands on a point of the floor.
    #[must_use]
    pub fn obstacle_at(&self, p: Point) -> Option<&Obstacle> {
        self.obstacles.iter().find(|o| o.polygon.contains(p, 1e-6))
    }
}

fn flat(shapes: &Shapes) -> Vec<Contour> {
    shapes.iter().flatten().cloned().collect()
}

impl Doorway {
    /// The `s` of a line `depth` beyond the doorway's line, seen from an Area (0 or 1).
    fn past(&self, side: usize, depth: f64) -> f64 {
        self.gap / 2.0 + if side == 0 { depth } else { -depth }
    }

    fn beyond(&self, side: usize, depth: f64) -> Polygon {
        self.rectangle(self.past(side, 0.0), self.past(side, depth), 0.5)
    }
}

/// The floor through an open doorway as far as a disc on its line reaches.
fn stub(site: &Site<'_>, grid: &Grid, doorway: &Doorway, side: usize, reach: f64) -> Vec<Contour> {
    let other = doorway.areas[1 - side];
    let gap = grid.contour(&doorway.rectangle(-THIN, doorway.gap + THIN, 0.0));
    let depth = doorway.gap / 2.0 + reach + 2.0;
    let ahead =
        grid.contour(&doorway.rectangle(doorway.past(side, 0.0), doorway.past(side, depth), 0.0));
    let mut floor = vec![gap.clone()];
    // Beyond a threshold that is less deep than the robot its next doorway counts too.
    let near = doorway.rectangle(doorway.past(side, 0.0), doorway.past(side, depth), 0.0).bounds();
    let mut others = vec![other];
    for (_, next, at) in site.doorways_of(other) {
        if next != doorway && site.is_open(next) {
            let hole = next.rectangle(-THIN, next.gap + THIN, 0.0);
            if hole.bounds().meets(&near) {
                floor.push(grid.contour(&hole));
                others.push(next.areas[1 - at]);
            }
        }
    }
    for area in others.into_iter().filter_map(|a| site.scene.areas.get(&a)) {
        floor.extend(Storey::of(site, area).floor.iter().map(|p| grid.contour(p)));
    }
    let mut cut = flat(&intersection(&floor, &[ahead]));
    cut.push(gap);
    cut
}

/// An Area's side as a wall or an opening.
#[derive(Debug, Clone)]
pub(super) struct Side {
    pub(super) item: usize,
    pub(super) side: usize,
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) permeability: Permeability,
}

/// The Area's items by what they mean to the robot.
pub(super) struct Storey {
    level: f64,
    /// Bases that hang together without a step that the robot cannot take, and thin strips that weld them.
    floor: Vec<Polygon>,
    closed_floor: Vec<Obstacle>,
    /// Walls between the items.
    inner_walls: Vec<Polygon>,
    pub(super) sides: Vec<Side>,
}

impl Storey {
    fn of(site: &Site<'_>, placed: &PlacedArea) -> Self {
        let model = &site.world.areas[&placed.id];
        let step = site.robot.step.get().max(0.0) + 1e-9;
        let height = site.robot.height.get();
        let base = model.items.iter().position(|i| i.is_base).unwrap_or(0);
        let level = placed.prisms.get(base).map_or(0.0, |p| p.bottom);
        let low_ceiling = |p: &Prism| {
            p.top > p.bottom
                && p.top - p.bottom < height
                && p.roof_permeability == Permeability::Impermeable
        };
        // The base is floor, whatever is above it; other items are floor if they have one.
        let is_floor = |i: usize, p: &Prism| {
            i == base
                || (p.bottom - level < height && p.base_permeability == Permeability::Impermeable)
        };
        let candidates: Vec<usize> = placed
            .prisms
            .iter()
            .enumerate()
            .filter(|(i, p)| is_floor(*i, p))
            .map(|(i, _)| i)
            .collect();
        let mut reached: Vec<usize> = candidates
            .iter()
            .copied()
            .filter(|&i| i == base && !low_ceiling(&placed.prisms[i]))
            .collect();
        let mut frontier = reached.clone();
        while let Some(i) = frontier.pop() {
            for &j in &candidates {
                let (p, q) = (&placed.prisms[i], &placed.prisms[j]);
                if !reached.contains(&j)
                    && !low_ceiling(q)
                    && (p.bottom - q.bottom).abs() <= step
                    && p.bounds.grown(0.05).meets(&q.bounds)
                    && distance(&p.polygon, &q.polygon) <= 0.05
                {
                    reached.push(j);
                    frontier.push(j);
                }
            }
        }
        let closed_floor = candidates
            .iter()
            .filter(|i| !reached.contains(i))
            .map(|&i| Obstacle {
                blocker: Blocker::Floor { area: placed.id, item: i },
                polygon: placed.prisms[i].polygon.clone(),
                bottom: placed.prisms[i].bottom - level,
                top: placed.prisms[i].top - level,
            })
            .collect();
        reached.sort_unstable();
        let mut storey = Self {
            level,
            floor: reached.iter().map(|&i| placed.prisms[i].polygon.clone()).collect(),
            closed_floor,
            inner_walls: Vec::new(),
            sides: sides(placed, &candidates),
        };
        storey.weld(site, placed, &reached);
        storey
    }

    /// Joins items along shared open sides, and parts them along shared walls.
    fn weld(&mut self, site: &Site<'_>, placed: &PlacedArea, reached: &[usize]) {
        if reached.len() < 2 {
            return;
        }
        let step = site.robot.step.get().max(0.0) + 1e-9;
        let sides: Vec<&Side> = self.sides.iter().filter(|s| reached.contains(&s.item)).collect();
        let (mut floor, mut walls) = (Vec::new(), Vec::new());
        for (k, a) in sides.iter().enumerate() {
            for b in &sides[k + 1..] {
                let Some((from, to)) = (a.item != b.item).then(|| shared(a, b)).flatten() else {
                    continue;
                };
                let level = |s: &Side| placed.prisms[s.item].bottom;
                let open = self.is_open(site, placed.id, a)
                    && self.is_open(site, placed.id, b)
                    && (level(a) - level(b)).abs() <= step;
                if open {
                    floor.push(strip(from, to));
                } else {
                    walls.push(strip(from, to));
                }
            }
        }
        self.floor.extend(floor);
        self.inner_walls = walls;
    }

    fn is_open(&self, site: &Site<'_>, area: AreaId, side: &Side) -> bool {
        match side.permeability {
            Permeability::Permeable => true,
            Permeability::Impermeable => false,
            Permeability::Conditional => {
                let model = &site.world.areas[&area];
                let item = &model.items[side.item];
                let id = &site.world.orthoframe_of(item).base[side.side].id;
                let mount = model.doors.iter().find(|m| m.item == item.id && m.side == *id);
                mount.is_some_and(|m| site.state(m.door).status == DoorStatus::Open)
            }
        }
    }

    /// The height of the floor under a point, above the Area's level.
    fn floor_under(&self, placed: &PlacedArea, p: Point) -> f64 {
        placed
            .prisms
            .iter()
            .filter(|f| f.bounds.contains(p) && f.polygon.contains(p, 1e-6))
            .map(|f| f.bottom - self.level)
            .filter(|z| self.floor.len() > 1 && z.abs() < 30.0)
            .fold(0.0, f64::min)
    }
}

fn sides(placed: &PlacedArea, items: &[usize]) -> Vec<Side> {
    let mut found = Vec::new();
    for &item in items {
        let prism = &placed.prisms[item];
        for (side, (start, end)) in prism.polygon.edges().enumerate() {
            let permeability = prism.sides[side].permeability;
            found.push(Side { item, side, start, end, permeability });
        }
    }
    found
}

/// The stretch that two sides standing back to back share.
fn shared(a: &Side, b: &Side) -> Option<(Point, Point)> {
    const TOUCH: f64 = 0.05;
    let along = (a.end - a.start).try_normalize(0.0)?;
    let offset = |p: Point| along.perp(&(p - a.start)).abs();
    let place = |p: Point| (p - a.start).dot(&along);
    if offset(b.start) > TOUCH || offset(b.end) > TOUCH {
        return None;
    }
    let (low, high) = (place(b.start).min(place(b.end)), place(b.start).max(place(b.end)));
    let (from, to) = (low.max(0.0), high.min((a.end - a.start).norm()));
    (to - from > TOUCH).then(|| (a.start + along * from, a.start + along * to))
}

/// A segment with the least thickness that the floor can show.
fn strip(a: Point, b: Point) -> Polygon {
    let across = match (b - a).try_normalize(0.0) {
        Some(v) => Vector::new(-v.y, v.x) * THIN,
        None => Vector::new(0.0, THIN),
    };
    Polygon::new(vec![a - across, b - across, b + across, a + across])
}

/// The floor that a prism takes from the robot above a floor at `floor`; none when it stands aside of the
/// robot's height.
fn footprint(prism: &Prism, floor: f64, robot: &RobotProfile) -> Vec<Polygon> {
    let (step, height) = (robot.step.get().max(0.0), robot.height.get());
    let (bottom, top) = (prism.bottom - floor, prism.top - floor);
    let is_flat = top <= bottom;
    let in_the_way =
        if is_flat { bottom > step && bottom < height } else { top > step && bottom < height };
    if !in_the_way {
        return Vec::new();
    }
    let mut polygon = prism.polygon.clone();
    if (prism.roof_scale - 1.0).abs() > f64::EPSILON && !is_flat {
        // A Uniframe is as wide as its widest section that the robot can meet.
        let scale_at = |z: f64| {
            let share = ((z - bottom) / (top - bottom)).clamp(0.0, 1.0);
            1.0 + (prism.roof_scale - 1.0) * share
        };
        let scale = scale_at(step.max(bottom)).max(scale_at(height.min(top))).max(0.0);
        let centre = polygon.centroid();
        for p in &mut polygon.corners {
            *p = centre + (*p - centre) * scale;
        }
    }
    let extent = polygon.bounds().max - polygon.bounds().min;
    if polygon.signed_area().abs() <= 2.0 * THIN * extent.norm() {
        return polygon.edges().map(|(a, b)| strip(a, b)).collect();
    }
    vec![polygon.counter_clockwise()]
}

fn obstacles_near(site: &Site<'_>, storey: &Storey, bounds: &Bounds) -> Vec<Obstacle> {
    let mut found = Vec::new();
    for id in (site.nearby)(bounds) {
        let Some(replica) = site.scene.replicas.get(&id) else { continue };
        let under = site.scene.areas.get(&replica.area).map_or(0.0, |placed| {
            storey.floor_under(placed, nalgebra::center(&replica.bounds.min, &replica.bounds.max))
        });
        let floor = storey.level + under;
        for prism in replica.prisms.iter().filter(|p| p.bounds.meets(bounds)) {
            for polygon in footprint(prism, floor, site.robot) {
                found.push(Obstacle {
                    blocker: Blocker::Replica { replica: id, item: prism.item },
                    polygon,
                    bottom: prism.bottom - floor,
                    top: prism.top - floor,
                });
            }
        }
        found.extend(own_leaves(site, replica, floor));
    }
    found
}

/// The open leaves of a replica's own doors.
fn own_leaves(site: &Site<'_>, replica: &PlacedReplica, floor: f64) -> Vec<Obstacle> {
    let Some(model) = site.world.replicas.get(&replica.id) else { return Vec::new() };
    let object = &site.world.objects[&model.object];
    let mut found = Vec::new();
    for mount in &object.doors {
        let Some(door) = site.world.doors.get(&mount.door) else { continue };
        let state = model.door_states.get(&mount.door).copied().unwrap_or(door.state);
        let Some((prism, (a, b))) = mounted_side(site, object, replica, mount) else { continue };
        if state.status != DoorStatus::Open {
            continue;
        }
        let height =
            if door.height.get() > 0.0 { door.height.get() } else { prism.top - prism.bottom };
        let (bottom, top) = (prism.bottom - floor, prism.bottom + height - floor);
        if top <= site.robot.step.get() || bottom >= site.robot.height.get() {
            continue;
        }
        for (leaf, polygon) in object_leaves(door, mount, a, b, state).into_iter().enumerate() {
            let blocker = Blocker::ReplicaLeaf { replica: replica.id, door: mount.door, leaf };
            found.push(Obstacle { blocker, polygon, bottom, top });
        }
    }
    found
}

fn mounted_side<'a>(
    site: &Site<'_>,
    object: &crate::map::Object,
    replica: &'a PlacedReplica,
    mount: &crate::map::DoorMount,
) -> Option<(&'a Prism, (Point, Point))> {
    let item = object.items.iter().position(|i| i.id == mount.item)?;
    let (side, _) = site.world.orthoframe_of(&object.items[item]).side(&mount.side)?;
    let prism = replica.prisms.get(item)?;
    Some((prism, prism.polygon.edges().nth(side)?))
}

/// The leaves of the Area's doors, and of its neighbours' doors close by.
fn leaves_near(site: &Site<'_>, area: AreaId) -> Vec<Obstacle> {
    let mut near: Vec<&Doorway> = site.doorways_of(area).map(|(_, d, _)| d).collect();
    for (_, doorway, side) in site.doorways_of(area).collect::<Vec<_>>() {
        let zone = Bounds::of([doorway.middle()]).grown(doorway.width() / 2.0 + 3.0 * site.reach());
        for (_, next, _) in site.doorways_of(doorway.areas[1 - side]) {
            if !near.contains(&next) && zone.grown(next.width()).contains(next.middle()) {
                near.push(next);
            }
        }
    }
    let mut found = Vec::new();
    for doorway in near {
        let Some(door) = doorway.door.and_then(|d| site.world.doors.get(&d)) else { continue };
        let leaves = doorway.leaf_obstacles(door, site.state(door.id));
        found.extend(leaves.into_iter().enumerate().map(|(leaf, polygon)| Obstacle {
            blocker: Blocker::DoorLeaf { door: door.id, leaf },
            polygon,
            bottom: 0.0,
            top: door.height.get(),
        }));
    }
    found
}

/// The Area's sides without its doorways, and the doorways' jambs.
fn walls(site: &Site<'_>, placed: &PlacedArea) -> Vec<(Point, Point)> {
    let all: Vec<usize> = (0..placed.prisms.len()).collect();
    let model = &site.world.areas[&placed.id];
    let mut walls = Vec::new();
    for side in sides(placed, &all) {
        let reference = |d: &Doorway, at: usize| {
            let id = &site.world.orthoframe_of(&model.items[side.item]).base[side.side].id;
            d.sides[at].item == model.items[side.item].id && d.sides[at].side == *id
        };
        let doorway = site.doorways_of(placed.id).find(|(_, d, at)| reference(d, *at));
        let along = (side.end - side.start).try_normalize(0.0).unwrap_or_else(Vector::zeros);
        let length = (side.end - side.start).norm();
        let mut pieces = Vec::new();
        if let Some((_, d, at)) = doorway {
            let face = if at == 0 { 0.0 } else { d.gap };
            let (a, b) = d.line();
            let place = |p: Point| (p - side.start).dot(&along).clamp(0.0, length);
            let (low, high) = (place(a).min(place(b)), place(a).max(place(b)));
            pieces.push((0.0, low));
            pieces.push((high, length));
            for t in [d.span().0, d.span().1] {
                walls.push((d.at(t, face), d.at(t, d.gap / 2.0)));
            }
        } else if side.permeability == Permeability::Impermeable || !is_inner(placed, &side) {
            pieces.push((0.0, length));
        }
        walls.extend(
            pieces
                .into_iter()
                .filter(|(a, b)| b - a > 1e-6)
                .map(|(a, b)| (side.start + along * a, side.start + along * b)),
        );
    }
    walls.retain(|(a, b)| (b - a).norm() > 1e-6);
    walls
}

/// Whether a side lies between two items of the Area.
fn is_inner(placed: &PlacedArea, side: &Side) -> bool {
    let middle = nalgebra::center(&side.start, &side.end);
    placed.prisms.iter().enumerate().any(|(i, p)| {
        i != side.item && p.bounds.grown(0.1).contains(middle) && p.polygon.contains(middle, 0.05)
    })
}

/// The edges of the centre space that lie on open doorways.
fn exits(cells: &Mesh, open: &[(usize, &Doorway, usize)]) -> Vec<Exit> {
    let mut found = Vec::new();
    if open.is_empty() {
        return found;
    }
    for cell in cells.cells() {
        for (edge, &across) in cells.across(cell).iter().enumerate() {
            if across != NONE {
                continue;
            }
            let (a, b) = cells.edge(cell, edge);
            let on_line = |d: &Doorway| {
                let (u, v) = d.line();
                [a, b].into_iter().all(|p| (p - nearest_on_segment(p, u, v)).norm() < 0.01)
            };
            if let Some((doorway, _, _)) = open.iter().find(|(_, d, _)| on_line(d)) {
                found.push(Exit { doorway: *doorway, cell, edge });
            }
        }
    }
    found
}

fn dead_zones(
    grid: &Grid,
    dead: &Shapes,
    area: AreaId,
    obstacles: &[Obstacle],
    sides: &[Side],
    reach: f64,
) -> Vec<DeadZone> {
    let things: Vec<(Blocker, Polygon)> = obstacles
        .iter()
        .map(|o| (o.blocker, o.polygon.clone()))
        .chain(sides.iter().filter(|s| s.permeability != Permeability::Permeable).map(|s| {
            (Blocker::Wall { area, item: s.item, side: s.side }, Polygon::new(vec![s.start, s.end]))
        }))
        .collect();
    let zone = |region: Region| {
        let near: Vec<&(Blocker, Polygon)> = things
            .iter()
            .filter(|(_, p)| {
                p.bounds().grown(0.1).meets(&region.outer.bounds())
                    && distance(p, &region.outer) < 0.05
            })
            .collect();
        let mut gap: Option<f64> = None;
        for (i, (a, p)) in near.iter().enumerate() {
            for (b, q) in &near[i + 1..] {
                let d = distance(p, q);
                if a != b && d > 0.05 && d < 2.0 * reach && gap.is_none_or(|g| d < g) {
                    gap = Some(d);
                }
            }
        }
        let mut owners: Vec<Blocker> = near.iter().map(|(b, _)| *b).collect();
        owners.sort_unstable();
        owners.dedup();
        DeadZone { region, owners, gap }
    };
    // What rounding leaves along the walls is no zone.
    let rim = |r: &Region| {
        r.contours().flat_map(Polygon::edges).map(|(a, b)| (b - a).norm()).sum::<f64>()
    };
    let is_zone = |r: &Region| r.area() > 0.01 * rim(r).max(1.0);
    grid.regions(dead).into_iter().filter(is_zone).map(zone).collect()
}
