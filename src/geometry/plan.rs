//! The floor of a whole Map, Fragment by Fragment, and the network of doorways between them.
//!
//! Two levels: Passframes and cells within a Fragment, doorways between Fragments. A change rebuilds the
//! Fragments that it touches; the others are shared, so that a plan is cheap to copy and to vary (a door opened,
//! a chair moved).
//!
//! **Invariant**: a plan after [`FloorPlan::rebuild`] equals one built anew from the same world.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use crate::map::{DoorState, Permeability, RobotProfile, World};
use crate::units::{AreaId, DoorId, MapId, Point, ReplicaId};

use super::buckets::Buckets;
use super::doors::{Doorway, doorways};
use super::floor::{FragmentFloor, Site};
use super::scene::{PlacedArea, PlacedReplica, Prism, Scene};
use super::search::{CellKey, Cells, Edge};
use super::{Bounds, Passframe, PassframeId};

/// Doors that stand otherwise than the world says: opened by the robot, or assumed.
pub type DoorStates = BTreeMap<DoorId, DoorState>;

/// Where two Fragments' centre spaces touch on a doorway's line.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Portal {
    /// Fragment, cell and edge on this side.
    from: CellKey,
    edge: usize,
    to: CellKey,
    right: Point,
    left: Point,
    doorway: usize,
}

/// The floor of one Map for one robot.
#[derive(Debug, Clone)]
pub struct FloorPlan {
    map: MapId,
    robot: RobotProfile,
    states: DoorStates,
    scene: Arc<Scene>,
    index: Arc<ReplicaIndex>,
    doorways: Arc<Vec<Doorway>>,
    /// For each Area its doorways, and which of their two sides it is.
    by_area: Arc<BTreeMap<AreaId, Vec<(usize, usize)>>>,
    /// In the order of the Areas' ids; a Fragment's place here is its number in the search.
    pub(super) fragments: Vec<Arc<FragmentFloor>>,
    portals: Vec<Vec<Portal>>,
    /// Which components of centre space hang together over open doorways: by Fragment, by component.
    regions: Vec<Vec<u32>>,
    /// See [`Branches`].
    branches: Branches,
    /// The Fragments by place, with half of the walls behind their doorways.
    by_place: Arc<Buckets>,
}

impl FloorPlan {
    /// Builds the floor of every Fragment of a Map. `states` overrides the doors' states in the world.
    ///
    /// # Panics
    /// When the map is not of this world.
    #[must_use]
    pub fn build(world: &World, map: MapId, robot: &RobotProfile, states: &DoorStates) -> Self {
        let scene = Scene::of(world, map);
        let doorways = doorways(world, &scene, map);
        let mut by_area: BTreeMap<AreaId, Vec<(usize, usize)>> = BTreeMap::new();
        for (index, doorway) in doorways.iter().enumerate() {
            for side in [0, 1] {
                by_area.entry(doorway.areas[side]).or_default().push((index, side));
            }
        }
        let mut plan = Self {
            map,
            robot: robot.clone(),
            states: states.clone(),
            index: Arc::new(ReplicaIndex::of(&scene)),
            doorways: Arc::new(doorways),
            by_area: Arc::new(by_area),
            scene: Arc::new(scene),
            fragments: Vec::new(),
            portals: Vec::new(),
            regions: Vec::new(),
            branches: Branches::default(),
            by_place: Arc::default(),
        };
        let areas: Vec<AreaId> = plan.scene.areas.keys().copied().collect();
        plan.fragments = plan.with_site(world, |site| build_all(site, &areas));
        let boxes: Vec<Bounds> = plan.fragments.iter().map(|f| plan.extent_of(f)).collect();
        plan.by_place = Arc::new(Buckets::of(&boxes));
        plan.connect(0..areas.len());
        plan
    }

    /// A box around all that a Fragment's floor can ever reach, whatever its doors do.
    fn extent_of(&self, fragment: &FragmentFloor) -> Bounds {
        let doorways = self.by_area.get(&fragment.area).into_iter().flatten();
        let mouths =
            doorways.map(|&(d, _)| self.doorways[d].rectangle(0.0, self.doorways[d].gap, 0.0));
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

    fn with_site<T>(&self, world: &World, work: impl FnOnce(&Site<'_>) -> T) -> T {
        let nearby = |bounds: &Bounds| self.index.near(bounds);
        work(&Site {
            world,
            scene: &self.scene,
            nearby: &nearby,
            doorways: &self.doorways,
            by_area: &self.by_area,
            robot: &self.robot,
            states: &self.states,
        })
    }

    /// Takes over what the world now says of an Area's replicas, and builds anew the Fragments that it touches.
    pub fn rebuild(&mut self, world: &World, area: AreaId) {
        let mut touched = self.footprint_of(area);
        let scene = Arc::make_mut(&mut self.scene);
        let index = Arc::make_mut(&mut self.index);
        for id in index.by_area.remove(&area).unwrap_or_default() {
            if let Some(gone) = scene.replicas.remove(&id) {
                index.remove(&gone);
            }
        }
        if let Some(frame) = scene.areas.get(&area).map(|a| a.frame) {
            for replica in world.replicas_in(area) {
                let placed = PlacedReplica::new(world, replica.id, frame.compose(&replica.frame));
                // It may have stood in another Fragment, which is rebuilt on its own turn.
                if let Some(gone) = scene.replicas.remove(&replica.id) {
                    index.remove(&gone);
                }
                index.insert(&placed);
                scene.replicas.insert(replica.id, placed);
            }
        }
        touched.extend(self.footprint_of(area));
        let reach = self.reach();
        let is_touched = |zone: Bounds| touched.iter().any(|b| b.grown(0.2).meets(&zone));
        let stale: Vec<AreaId> = self
            .scene
            .areas
            .values()
            .filter(|a| {
                let mouths = self.by_area.get(&a.id).into_iter().flatten();
                a.id == area
                    || a.prisms.iter().any(|p| is_touched(p.bounds))
                    || mouths.into_iter().any(|&(d, _)| is_touched(self.doorways[d].mouth(reach)))
            })
            .map(|a| a.id)
            .collect();
        self.renew(world, &stale);
    }

    /// What the replicas of an Area can reach.
    fn footprint_of(&self, area: AreaId) -> Vec<Bounds> {
        let ids = self.index.by_area.get(&area).into_iter().flatten();
        let replicas = ids.filter_map(|id| self.scene.replicas.get(id));
        // Open leaves stick out; a Uniframe may be wider than its base.
        let is_plain = |r: &PlacedReplica| {
            let closed = |p: &Prism| {
                p.roof_scale <= 1.0
                    && p.sides.iter().all(|s| s.permeability != Permeability::Conditional)
            };
            r.prisms.iter().all(closed)
        };
        replicas.map(|r| r.bounds.grown(if is_plain(r) { 0.0 } else { 150.0 })).collect()
    }

    /// The same floor with doors in other states: those in `states` as given, the others as before.
    #[must_use]
    pub fn with_doors(&self, world: &World, states: &DoorStates) -> Self {
        let mut plan = self.clone();
        let mut stale = Vec::new();
        for (&door, &state) in states {
            let before = self.door_state(world, door);
            plan.states.insert(door, state);
            if before != state {
                for doorway in self.doorways.iter().filter(|d| d.door == Some(door)) {
                    stale.extend(doorway.areas);
                    // The leaf may stand before a neighbour's door.
                    stale.extend(self.next_to(doorway));
                }
            }
        }
        stale.sort_unstable();
        stale.dedup();
        plan.renew(world, &stale);
        plan
    }

    /// The Areas behind other doorways close to this one.
    fn next_to(&self, doorway: &Doorway) -> Vec<AreaId> {
        let zone = Bounds::of([doorway.middle()]).grown(
            2.0 * doorway.width() + 3.0 * (self.robot.radius.get() + self.robot.clearance.get()),
        );
        self.doorways
            .iter()
            .filter(|d| zone.grown(d.width()).contains(d.middle()))
            .flat_map(|d| d.areas)
            .collect()
    }

    /// The state that the plan assumes of a door.
    #[must_use]
    pub fn door_state(&self, world: &World, door: DoorId) -> DoorState {
        self.with_site(world, |site| site.state(door))
    }

    fn renew(&mut self, world: &World, stale: &[AreaId]) {
        let fresh: Vec<_> = self.with_site(world, |site| build_all(site, stale));
        for floor in fresh {
            if let Some(number) = self.number(floor.area) {
                self.fragments[number] = floor;
            }
        }
        let numbers: Vec<usize> = stale.iter().filter_map(|&a| self.number(a)).collect();
        self.connect(numbers);
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

    /// All doors and passages between Areas, open or not.
    #[must_use]
    pub fn doorways(&self) -> &[Doorway] {
        &self.doorways
    }

    /// The doorways that a door closes; several only if a door is mounted twice.
    pub fn doorways_of(&self, door: DoorId) -> impl Iterator<Item = &Doorway> + '_ {
        self.doorways.iter().filter(move |d| d.door == Some(door))
    }

    /// All Fragments, in the order of their Areas' ids.
    pub fn fragments(&self) -> impl ExactSizeIterator<Item = &FragmentFloor> + '_ {
        self.fragments.iter().map(Arc::as_ref)
    }

    #[must_use]
    pub fn fragment(&self, area: AreaId) -> Option<&FragmentFloor> {
        self.number(area).map(|n| self.fragments[n].as_ref())
    }

    /// The Passframes of an Area.
    #[must_use]
    pub fn passframes(&self, area: AreaId) -> &[Passframe] {
        self.fragment(area).map_or(&[], |f| &f.passframes)
    }

    #[must_use]
    pub fn passframe(&self, area: AreaId, id: PassframeId) -> Option<&Passframe> {
        self.passframes(area).iter().find(|p| p.id == id)
    }

    pub(super) fn number(&self, area: AreaId) -> Option<usize> {
        self.fragments.binary_search_by_key(&area, |f| f.area).ok()
    }

    pub(super) fn floor(&self, number: u32) -> &FragmentFloor {
        &self.fragments[number as usize]
    }

    /// Which part of the Map's centre space a cell belongs to: the robot can go between cells of one region.
    pub(super) fn region(&self, cell: CellKey) -> u32 {
        let component = self.floor(cell.0).cells.component[cell.1 as usize];
        self.regions[cell.0 as usize][component as usize]
    }

    /// Whether the robot can pass from a Fragment through a doorway as it stands.
    pub(super) fn is_passable(&self, number: u32, doorway: usize) -> bool {
        self.portals[number as usize].iter().any(|p| p.doorway == doorway)
    }

    /// The doorways that the robot can pass as they stand.
    #[must_use]
    pub fn open_doorways(&self) -> BTreeSet<usize> {
        self.portals.iter().flatten().map(|p| p.doorway).collect()
    }

    /// The doorways of a Fragment, by their index in [`Self::doorways`], each with the Fragment's side.
    pub(super) fn doorways_at(&self, number: u32) -> &[(usize, usize)] {
        self.by_area.get(&self.floor(number).area).map_or(&[], Vec::as_slice)
    }

    /// The pieces of centre space by the region they belong to: Fragment, component.
    pub(super) fn pieces(&self) -> BTreeMap<u32, Vec<(u32, u32)>> {
        let mut pieces: BTreeMap<u32, Vec<(u32, u32)>> = BTreeMap::new();
        for (number, regions) in (0..).zip(&self.regions) {
            for (component, &region) in (0..).zip(regions) {
                pieces.entry(region).or_default().push((number, component));
            }
        }
        pieces
    }

    /// The region of a piece.
    pub(super) fn region_of(&self, (number, component): (u32, u32)) -> u32 {
        self.regions[number as usize][component as usize]
    }

    /// Finds where the given Fragments touch others, and what hangs together now.
    fn connect(&mut self, stale: impl IntoIterator<Item = usize>) {
        let mut touched: BTreeSet<usize> = BTreeSet::new();
        for number in stale {
            touched.insert(number);
            let area = self.fragments[number].area;
            for &(doorway, side) in self.by_area.get(&area).into_iter().flatten() {
                touched.extend(self.number(self.doorways[doorway].areas[1 - side]));
            }
        }
        self.portals.resize(self.fragments.len(), Vec::new());
        for number in touched {
            self.portals[number] = self.portals_from(number);
        }
        self.regions = self.join_components();
        self.branches = Branches::of(&self.portals);
    }

    /// The Fragments that a shortest way between two of them can pass.
    pub(super) fn between(&self, start: u32, goal: u32) -> Vec<u32> {
        self.branches.between(start, goal)
    }

    /// The places where a Fragment's centre space touches another's.
    fn portals_from(&self, number: usize) -> Vec<Portal> {
        let fragment = &self.fragments[number];
        let mut portals = Vec::new();
        for exit in &fragment.exits {
            let doorway = &self.doorways[exit.doorway];
            let other = doorway.index_of(fragment.area).map(|side| doorway.areas[1 - side]);
            let Some(to) = other.and_then(|a| self.number(a)) else { continue };
            let own = fragment.cells.edge(exit.cell, exit.edge);
            for entry in self.fragments[to].exits.iter().filter(|e| e.doorway == exit.doorway) {
                let opposite = self.fragments[to].cells.edge(entry.cell, entry.edge);
                if let Some((right, left)) = overlap(own, opposite) {
                    portals.push(Portal {
                        from: (number as u32, exit.cell),
                        edge: exit.edge,
                        to: (to as u32, entry.cell),
                        right,
                        left,
                        doorway: exit.doorway,
                    });
                }
            }
        }
        portals.sort_by_key(|p| (p.from, p.edge, p.to));
        portals
    }

    fn join_components(&self) -> Vec<Vec<u32>> {
        let mut first = Vec::new();
        let mut count = 0;
        for fragment in &self.fragments {
            first.push(count);
            count += fragment.cells.component.iter().max().map_or(0, |m| m + 1) as usize;
        }
        let mut sets = petgraph::unionfind::UnionFind::<usize>::new(count);
        let component = |key: CellKey| {
            first[key.0 as usize] + self.floor(key.0).cells.component[key.1 as usize] as usize
        };
        for portal in self.portals.iter().flatten() {
            sets.union(component(portal.from), component(portal.to));
        }
        let labels = sets.into_labeling();
        self.fragments
            .iter()
            .zip(&first)
            .map(|(fragment, &first)| {
                let own = fragment.cells.component.iter().max().map_or(0, |m| m + 1) as usize;
                (first..first + own).map(|i| labels[i] as u32).collect()
            })
            .collect()
    }

    fn portals_of(&self, cell: CellKey) -> &[Portal] {
        let list = &self.portals[cell.0 as usize];
        let from = list.partition_point(|p| p.from < cell);
        let to = list.partition_point(|p| p.from <= cell);
        &list[from..to]
    }
}

/// The floors of Areas, in their order, by as many threads as the machine has for so much work.
fn build_all(site: &Site<'_>, areas: &[AreaId]) -> Vec<Arc<FragmentFloor>> {
    let build = |area: &AreaId| Arc::new(FragmentFloor::build(site, *area));
    const WORTH_A_THREAD: usize = 8;
    let most = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = most.min(areas.len() / WORTH_A_THREAD);
    if threads < 2 {
        return areas.iter().map(build).collect();
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut built = Vec::new();
        while let Some(area) = areas.get(next.fetch_add(1, Relaxed)) {
            built.push(build(area));
        }
        built
    };
    let mut floors: Vec<_> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mut floors = work();
        for other in others {
            match other.join() {
                Ok(built) => floors.extend(built),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        floors
    });
    floors.sort_by_key(|f| f.area);
    floors
}

/// The upper level of the network: Fragments as nodes, open doorways as edges; what hangs on one doorway is cut
/// off again and again, until only rings are left.
///
/// A way never enters a Fragment only to come back through the same doorway, since the straight line between the
/// two crossings is free. So a query looks at the branches of its start and its goal, and at the rings between.
#[derive(Debug, Clone, Default)]
struct Branches {
    /// The Fragment that a branch hangs on; none in the rings, and for the last of a tree.
    parent: Vec<Option<u32>>,
    rings: Vec<u32>,
}

impl Branches {
    fn of(portals: &[Vec<Portal>]) -> Self {
        let mut graph = petgraph::graph::UnGraph::<(), usize, u32>::with_capacity(portals.len(), 0);
        portals.iter().for_each(|_| {
            graph.add_node(());
        });
        let mut doorways = BTreeSet::new();
        for portal in portals.iter().flatten().filter(|p| p.from.0 < p.to.0) {
            if doorways.insert(portal.doorway) {
                graph.add_edge(portal.from.0.into(), portal.to.0.into(), portal.doorway);
            }
        }
        let mut degree: Vec<usize> = graph.node_indices().map(|n| graph.edges(n).count()).collect();
        let mut parent = vec![None; portals.len()];
        let mut is_cut = vec![false; portals.len()];
        let mut leaves: Vec<usize> = (0..portals.len()).filter(|&n| degree[n] == 1).collect();
        while let Some(leaf) = leaves.pop() {
            is_cut[leaf] = true;
            let on = graph.neighbors((leaf as u32).into()).map(|n| n.index()).find(|&n| !is_cut[n]);
            if let Some(on) = on {
                parent[leaf] = Some(on as u32);
                degree[on] -= 1;
                if degree[on] == 1 {
                    leaves.push(on);
                }
            }
        }
        let rings =
            (0..portals.len() as u32).filter(|&n| degree[n as usize] > 1 && !is_cut[n as usize]);
        Self { rings: rings.collect(), parent }
    }

    /// From a Fragment up to its ring or the last of its tree.
    fn trunk(&self, from: u32) -> Vec<u32> {
        std::iter::successors(Some(from), |&n| self.parent[n as usize]).collect()
    }

    fn between(&self, start: u32, goal: u32) -> Vec<u32> {
        let (mut up, mut down) = (self.trunk(start), self.trunk(goal));
        match up.iter().position(|n| down.contains(n)) {
            Some(meet) => {
                let top = up[meet];
                up.truncate(meet + 1);
                down.truncate(down.iter().position(|&n| n == top).unwrap_or(0));
                up.extend(down);
            }
            None => {
                up.extend(down);
                up.extend(&self.rings);
            }
        }
        up.sort_unstable();
        up.dedup();
        up
    }
}

/// The cells of a plan as a search for one goal may use them.
pub(super) struct Walkable<'a> {
    plan: &'a FloorPlan,
    /// Fragments to stay in, sorted.
    within: &'a [u32],
    /// The cells of branches that lead to the goal or to a Fragment that may be passed, sorted: a way never enters
    /// the other branches, since it would have to come back over the same border.
    branches: Vec<CellKey>,
}

impl<'a> Walkable<'a> {
    pub(super) fn toward(plan: &'a FloorPlan, within: &'a [u32], goal: CellKey) -> Self {
        let admitted = |p: &&Portal| within.binary_search(&p.to.0).is_ok();
        let exits = within.iter().flat_map(|&n| plan.portals[n as usize].iter().filter(admitted));
        let mut branches: Vec<CellKey> = Vec::new();
        for (number, cell) in exits.map(|p| p.from).chain([goal]) {
            let trunk = &plan.floor(number).cells.trunk;
            let mut at = cell;
            while trunk[at as usize] != super::mesh::NONE && branches.last() != Some(&(number, at))
            {
                branches.push((number, at));
                at = trunk[at as usize];
            }
        }
        branches.sort_unstable();
        branches.dedup();
        Self { plan, within, branches }
    }
}

impl Cells for Walkable<'_> {
    fn edges(&self, cell: CellKey, visit: &mut dyn FnMut(Edge)) {
        let mesh = &self.plan.floor(cell.0).cells;
        let ring = mesh.ring(cell.1);
        for (i, &across) in mesh.across(cell.1).iter().enumerate() {
            if across == super::mesh::NONE
                || (mesh.trunk[across as usize] == cell.1
                    && self.branches.binary_search(&(cell.0, across)).is_err())
            {
                continue;
            }
            let (u, v) = (ring[i] as usize, ring[(i + 1) % ring.len()] as usize);
            visit(Edge {
                right: mesh.vertices[u],
                left: mesh.vertices[v],
                right_bends: mesh.is_corner[u],
                left_bends: mesh.is_corner[v],
                to: (cell.0, across),
            });
        }
        for portal in self.plan.portals_of(cell) {
            if self.within.binary_search(&portal.to.0).is_ok() {
                let Portal { right, left, to, .. } = *portal;
                visit(Edge { right, left, right_bends: true, left_bends: true, to });
            }
        }
    }
}

/// The stretch of `a`-`b` that the opposite edge `c`-`d` covers.
fn overlap((a, b): (Point, Point), (c, d): (Point, Point)) -> Option<(Point, Point)> {
    let along = (b - a).try_normalize(0.0)?;
    let place = |p: Point| (p - a).dot(&along);
    let from = place(c).min(place(d)).max(0.0);
    let to = place(c).max(place(d)).min((b - a).norm());
    let end = |t: f64, p: Point, own: f64| if (t - own).abs() < 1e-9 { p } else { a + along * t };
    (to - from > 1e-6).then(|| (end(from, a, 0.0), end(to, b, (b - a).norm())))
}

/// Replicas by place.
#[derive(Debug, Clone, Default)]
struct ReplicaIndex {
    cells: HashMap<(i32, i32), Vec<ReplicaId>>,
    /// Those that are spread over too many cells to list in each.
    wide: Vec<ReplicaId>,
    by_area: BTreeMap<AreaId, Vec<ReplicaId>>,
    bounds: HashMap<ReplicaId, Bounds>,
}

impl ReplicaIndex {
    const CELL: f64 = 300.0;

    fn of(scene: &Scene) -> Self {
        let mut index = Self::default();
        scene.replicas.values().for_each(|replica| index.insert(replica));
        index
    }

    /// The cells that a replica is listed in; none for one that is spread over too many.
    fn cells_of(bounds: &Bounds) -> Option<impl Iterator<Item = (i32, i32)> + use<>> {
        let ((left, bottom), (right, top)) = Self::span(bounds);
        let is_wide =
            i64::from(right) - i64::from(left) > 30 || i64::from(top) - i64::from(bottom) > 30;
        (!is_wide).then(|| (left..=right).flat_map(move |x| (bottom..=top).map(move |y| (x, y))))
    }

    fn insert(&mut self, replica: &PlacedReplica) {
        // Leaves of its own doors may stick out.
        self.bounds.insert(replica.id, replica.bounds.grown(150.0));
        self.by_area.entry(replica.area).or_default().push(replica.id);
        match Self::cells_of(&replica.bounds) {
            Some(cells) => {
                cells.for_each(|cell| self.cells.entry(cell).or_default().push(replica.id));
            }
            None => self.wide.push(replica.id),
        }
    }

    fn remove(&mut self, replica: &PlacedReplica) {
        let is_other = |id: &ReplicaId| *id != replica.id;
        self.bounds.remove(&replica.id);
        self.by_area.entry(replica.area).or_default().retain(is_other);
        match Self::cells_of(&replica.bounds) {
            Some(cells) => {
                cells.for_each(|cell| self.cells.entry(cell).or_default().retain(is_other))
            }
            None => self.wide.retain(is_other),
        }
    }

    fn span(bounds: &Bounds) -> ((i32, i32), (i32, i32)) {
        let cell =
            |p: Point| ((p.x / Self::CELL).floor() as i32, (p.y / Self::CELL).floor() as i32);
        (cell(bounds.min), cell(bounds.max))
    }

    /// The replicas whose boxes come near `bounds`, in the order of their ids.
    fn near(&self, bounds: &Bounds) -> Vec<ReplicaId> {
        let ((left, bottom), (right, top)) = Self::span(&bounds.grown(150.0));
        let cells =
            (i64::from(right) - i64::from(left) + 1) * (i64::from(top) - i64::from(bottom) + 1);
        let mut found: Vec<ReplicaId> = if cells > self.cells.len() as i64 {
            self.bounds.keys().copied().collect()
        } else {
            (left..=right)
                .flat_map(|x| (bottom..=top).map(move |y| (x, y)))
                .filter_map(|cell| self.cells.get(&cell))
                .flatten()
                .chain(&self.wide)
                .copied()
                .collect()
        };
        found.sort_unstable();
        found.dedup();
        found.retain(|r| self.bounds[r].meets(bounds));
        found
    }
}
