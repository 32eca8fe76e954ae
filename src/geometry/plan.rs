//! The floor of a whole Map, Fragment by Fragment, and the network of doorways between them.
//!
//! Two levels: Passframes and cells within a Fragment, doorways between Fragments. A change rebuilds the
//! Fragments that it touches; the others are shared, so that a plan is cheap to copy and to vary (a door opened,
//! a chair moved).
//!
//! **Invariant**: a plan after [`FloorPlan::rebuild`] equals one built anew from the same world.

pub(super) mod built;
mod follow;

use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::map::{DoorState, RobotProfile, World};
use crate::units::{AreaId, DoorId, Gather as _, MapId, Point};

use super::buckets::Buckets;
use super::cells::{CellKey, Piece};
use super::coverage::{self, Coverage};
use super::doorways::Doorways;
use super::floor::FragmentFloor;
use super::grid::{Contour, Shapes, overlay};
use super::network::{Network, Strait};
use super::opening::Opening;
use super::replica_index::ReplicaIndex;
use super::scene::{PlacedArea, Prism, Scene};
use super::site::{DoorStates, SLACK, Site};
use super::surroundings::{Surroundings, surroundings};
use super::zone::PlacedZone;
use super::{Bounds, Passframe, PassframeId, Region};

/// The floor of one Map for one robot.
#[derive(Debug, Clone)]
pub struct FloorPlan {
    pub(super) map: MapId,
    pub(super) robot: RobotProfile,
    pub(super) states: DoorStates,
    pub(super) zones: Arc<Vec<PlacedZone>>,
    pub(super) scene: Arc<Scene>,
    pub(super) index: Arc<ReplicaIndex>,
    pub(super) doorways: Arc<Doorways>,
    /// In the order of the Areas' ids; a Fragment's place here is its number in the search.
    pub(super) fragments: Vec<Arc<FragmentFloor>>,
    /// The same, with what only the footprint covers; made when it is asked for. Not used for a disc.
    pub(super) covered: Vec<OnceLock<Arc<FragmentFloor>>>,
    /// Of each doorway whether it stands open, is high enough and without a step.
    pub(super) admits: Vec<bool>,
    pub(super) network: Network,
    /// By Fragment, then by doorway.
    pub(super) straits: Vec<Vec<Strait>>,
    /// Of each Fragment the box around all that it can ever reach.
    pub(super) extents: Arc<Vec<Bounds>>,
    /// The Fragments by place, with half of the walls behind their doorways.
    pub(super) by_place: Arc<Buckets>,
}

impl FloorPlan {
    /// A box around all that a Fragment's floor can ever reach, whatever its doors do.
    pub(super) fn extent_of(&self, fragment: &FragmentFloor) -> Bounds {
        let doorways = self.doorways.by_area.of(fragment.area).iter();
        let mouths = doorways
            .map(|&(d, _)| self.doorways.ways[d].rectangle(0.0, self.doorways.ways[d].gap, 0.0));
        mouths.fold(fragment.bounds, |b, m| b.union(&m.bounds())).grown(1.0)
    }

    /// The numbers of the Fragments whose floor may hold a point.
    pub(super) fn fragments_at(&self, p: Point) -> &[u32] {
        self.by_place.near(p)
    }

    /// The Fragments that may reach into a box.
    pub(super) fn fragments_near(
        &self,
        bounds: &Bounds,
    ) -> impl Iterator<Item = &FragmentFloor> + '_ {
        let mut found = Vec::new();
        self.by_place.meeting(bounds, &mut found);
        found.into_iter().map(|n| self.floor(n))
    }

    /// The Area that holds a point of the floor; the lowest id where borders meet.
    #[must_use]
    pub fn area_at(&self, p: Point) -> Option<AreaId> {
        let holds = |area: &PlacedArea| {
            let here = |f: &Prism| f.bounds.grown(1e-6).contains(p) && f.polygon.contains(p, 1e-6);
            area.prisms.iter().any(here)
        };
        let areas = self.fragments_at(p).iter().map(|&n| self.floor(n).area);
        areas.into_iter().find(|a| self.scene.areas.get(a).is_some_and(holds))
    }

    pub(super) fn with_site<T>(&self, world: &World, work: impl FnOnce(&Site<'_>) -> T) -> T {
        let nearby = |bounds: &Bounds| self.index.near(&self.scene, bounds);
        work(&Site {
            world,
            scene: &self.scene,
            nearby: &nearby,
            doorways: &self.doorways.ways,
            by_area: &self.doorways.by_area,
            robot: &self.robot,
            states: &self.states,
            zones: &self.zones,
        })
    }

    /// The zones that it respects: those without a time, until told otherwise by [`Self::with_zones`].
    #[must_use]
    pub fn zones(&self) -> &[PlacedZone] {
        &self.zones
    }

    /// The state that the plan assumes of a door.
    #[must_use]
    pub fn door_state(&self, world: &World, door: DoorId) -> DoorState {
        self.with_site(world, |site| site.state(door))
    }

    #[must_use]
    pub fn map(&self) -> MapId {
        self.map
    }

    #[must_use]
    pub fn robot(&self) -> &RobotProfile {
        &self.robot
    }

    /// The distance that the robot's centre keeps from everything: its radius and clearance, in cm.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.robot.radius.get() + self.robot.clearance.get()
    }

    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// All openings that the floor leads through, with their doors open or not.
    #[must_use]
    pub fn doorways(&self) -> &[Arc<Opening>] {
        &self.doorways.ways
    }

    /// The index in [`Self::doorways`] of an Area's doorway, by its number among those of the Area.
    #[must_use]
    pub fn doorway_at(&self, area: AreaId, number: usize) -> Option<usize> {
        Some(self.doorways.by_area.of(area).get(number)?.0)
    }

    /// The openings of the Map that join no two Areas by their sides: doors that lead out of it, and those that the rules
    /// do not let join.
    #[must_use]
    pub fn blind_openings(&self) -> &[Arc<Opening>] {
        &self.doorways.blind
    }

    /// The doorways that a door closes; several only if a door is mounted twice.
    pub fn doorways_of(&self, door: DoorId) -> impl Iterator<Item = &Opening> + '_ {
        self.doorways.ways.iter().map(Arc::as_ref).filter(move |d| d.door == Some(door))
    }

    /// All Fragments, in the order of their Areas' ids.
    pub fn fragments(&self) -> impl ExactSizeIterator<Item = &FragmentFloor> + '_ {
        (0..self.fragments.len() as u32).map(|n| self.covered(n))
    }

    #[must_use]
    pub fn fragment(&self, area: AreaId) -> Option<&FragmentFloor> {
        self.number(area).map(|n| self.covered(n as u32))
    }

    /// The Passframes of an Area.
    #[must_use]
    pub fn passframes(&self, area: AreaId) -> &[Passframe] {
        self.fragment(area).map_or(&[], FragmentFloor::passframes)
    }

    #[must_use]
    pub fn passframe(&self, area: AreaId, id: PassframeId) -> Option<&Passframe> {
        self.passframes(area).iter().find(|p| p.id == id)
    }

    /// What stands around a dead zone of a Fragment.
    #[must_use]
    pub fn around(&self, fragment: &FragmentFloor, zone: &Region) -> Surroundings {
        surroundings(fragment, zone, self.reach())
    }

    pub(super) fn number(&self, area: AreaId) -> Option<usize> {
        self.fragments.binary_search_by_key(&area, |f| f.area).ok()
    }

    pub(super) fn floor(&self, number: u32) -> &FragmentFloor {
        &self.fragments[number as usize]
    }

    /// The Fragment with the Passframes of all that the footprint covers.
    pub(super) fn covered(&self, number: u32) -> &FragmentFloor {
        if self.robot.footprint.is_empty() {
            return self.floor(number);
        }
        self.covered[number as usize].get_or_init(|| self.cover(number))
    }

    /// Which part of the Map's centre space a cell belongs to: the robot can go between cells of one region.
    pub(super) fn region(&self, cell: CellKey) -> u32 {
        self.network.region(self.piece_of(cell))
    }

    /// The piece of its Fragment's floor that a cell is of.
    pub(super) fn piece_of(&self, (number, cell): CellKey) -> Piece {
        (number, self.floor(number).cells.component(cell))
    }

    /// Whether the robot can pass from a Fragment through a doorway as it stands.
    pub(super) fn is_passable(&self, number: u32, doorway: usize) -> bool {
        let is_strait = |s: &Strait| {
            s.doorways.iter().any(|&(index, sides)| index == doorway && sides.contains(&number))
        };
        self.network.portals[number as usize].iter().any(|p| p.doorway == doorway)
            || self.network.straits.iter().any(is_strait)
    }

    /// Whether a Fragment has no place where the robot may turn as it likes.
    pub(super) fn is_blind(&self, number: u32) -> bool {
        self.floor(number).cells.components == 0
    }

    /// Whether a doorway stands open, is high enough and without a step; how wide does not matter.
    pub(super) fn admits(&self, doorway: usize) -> bool {
        self.admits[doorway]
    }

    /// The doorways that the robot can pass as they stand.
    #[must_use]
    pub fn open_doorways(&self) -> BTreeSet<usize> {
        let narrow = self.network.straits.iter().flat_map(|s| s.doorways.iter().map(|d| d.0));
        let portals = self.network.portals.iter().flatten();
        let whole = portals
            .filter(|p| [p.from, p.to].into_iter().all(|cell| self.leads_on(cell, p.doorway)));
        whole.map(|p| p.doorway).chain(narrow).gather()
    }

    /// Whether from a cell at a doorway the whole robot comes clear of the doorway, or through a further one: the
    /// wedge behind a leaf that stands ajar leads nowhere.
    fn leads_on(&self, (number, cell): CellKey, index: usize) -> bool {
        let (floor, doorway) = (self.floor(number), &self.doorways.ways[index]);
        let component = floor.cells.component(cell);
        let is_own = |&cell: &u32| floor.cells.component(cell) == component;
        let mut portals = self.network.portals[number as usize].iter();
        let is_first = doorway.index_of(floor.area) == Some(0);
        let is_clear = |corner: Point| {
            let out = (corner - doorway.at(0.0, 0.0)).dot(&doorway.out());
            let depth = if is_first { -out } else { out - doorway.gap };
            depth >= self.reach() - SLACK
        };
        portals.any(|p| p.doorway != index && is_own(&p.from.1))
            || floor.cells.cells().filter(is_own).any(|c| floor.cells.corners(c).any(is_clear))
    }

    /// The doorways of a Fragment, by their index in [`Self::doorways`], each with the Fragment's side.
    pub(super) fn doorways_at(&self, number: u32) -> &[(usize, usize)] {
        self.doorways.by_area.of(self.floor(number).area)
    }

    /// A Fragment whose free floor is what the footprint covers too.
    fn cover(&self, number: u32) -> Arc<FragmentFloor> {
        let own = &self.fragments[number as usize];
        let extent = self.extent_of(own);
        let near = self.straits.iter().flatten().filter(|s| s.extent().meets(&extent));
        let lanes: Vec<(Point, Point)> =
            near.flat_map(|s| s.lanes).map(|lane| (lane.ends[0], lane.ends[1])).collect();
        if own.dead_zones().is_empty() && lanes.is_empty() {
            return Arc::clone(own);
        }
        let coverage = self.coverage(number, &lanes);
        Arc::new(own.with_footprint(self.inside(number, 0.0), &coverage, lanes))
    }

    /// The floor of a Fragment that nothing stands on, up to so far beyond the lines of its open doorways, in cm.
    fn inside(&self, number: u32, further: f64) -> Shapes {
        let own = self.doorways_at(number).iter().filter(|d| self.admits[d.0]);
        let open = own.map(|&(index, side)| (&*self.doorways.ways[index], side));
        self.floor(number).inside(open, further, self.reach().max(2.0 * SLACK))
    }

    /// What the footprint can touch that covers some floor of a Fragment.
    fn coverage(&self, number: u32, lanes: &[(Point, Point)]) -> Coverage<'_> {
        /// Floors overlap by so much in cm on either side of the line on which they meet.
        const WELD: f64 = 0.1;
        let grid = self.floor(number).grid;
        let place = self.extent_of(self.floor(number)).grown(self.body_reach());
        let (mut numbers, mut shut) = (vec![number], Vec::new());
        let mut k = 0;
        while let Some(&at) = numbers.get(k) {
            k += 1;
            for &(index, side) in self.doorways_at(at) {
                let doorway = &self.doorways.ways[index];
                let next = self.number(doorway.areas[1 - side]).map(|n| n as u32);
                if !self.admits[index] {
                    shut.push(doorway.line());
                } else if let Some(next) = next.filter(|n| !numbers.contains(n))
                    && self.floor(next).bounds.meets(&place)
                {
                    numbers.push(next);
                }
            }
        }
        let floors: Vec<&FragmentFloor> = numbers.iter().map(|&n| self.floor(n)).collect();
        let within = |regions: Vec<Region>| -> Vec<Contour> {
            let near = regions.iter().flat_map(Region::contours);
            near.map(|c| grid.contour(&c.clone().clipped(&place))).collect()
        };
        let inside =
            numbers.iter().flat_map(|&n| within(self.floor(n).grid.regions(&self.inside(n, WELD))));
        let inside: Vec<Contour> = inside.collect();
        let floor = overlay(&inside, &[], OverlayRule::Subject, FillRule::NonZero);
        let floor: Vec<Contour> = floor.into_iter().flatten().collect();
        let rims: Vec<(Point, Point)> =
            floor.iter().flat_map(|c| grid.polygon(c).edges().collect::<Vec<_>>()).collect();
        let walls = floors.iter().flat_map(|f| f.walls.iter().copied());
        Coverage {
            robot: &self.robot,
            grid,
            edges: rims.into_iter().chain(walls).chain(shut).collect(),
            floor,
            lanes: lanes.iter().map(|(a, b)| (b.y - a.y).atan2(b.x - a.x)).collect(),
        }
    }

    /// How far from what the body covers it may touch something, in cm.
    fn body_reach(&self) -> f64 {
        2.0 * coverage::extent(&self.robot) + 5.0
    }
}
