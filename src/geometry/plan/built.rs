//! A floor is built: its Fragments anew or from what was kept of them, and what joins them.

use std::collections::{BTreeSet, HashMap};
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::{Arc, OnceLock};

use crate::Bounds;
use crate::buckets::Buckets;
use crate::digest::digests;
use crate::doorways::Doorways;
use crate::floor::FragmentFloor;
use crate::kept;
use crate::map::{RobotProfile, World, Zone};
use crate::network::{Network, Portal, overlap};
use crate::openings::{Openings, STEP_REACH};
use crate::replica_index::ReplicaIndex;
use crate::scene::Scene;
use crate::site::{DoorStates, Site};
use crate::strait;
use crate::units::{AreaId, MapId};
use crate::zone::placed;

use super::FloorPlan;

impl FloorPlan {
    /// Builds the floor of every Fragment of a Map, with its openings as they are measured: see [`Openings::of`]. `states`
    /// overrides the doors' states in the world.
    ///
    /// # Panics
    /// When the map is not of this world.
    #[must_use]
    pub fn build(world: &World, map: MapId, robot: &RobotProfile, states: &DoorStates) -> Self {
        Self::restore(world, &Openings::of(world, STEP_REACH), map, robot, states, &[]).0
    }

    /// Builds the floor, which leads through the `openings` that the rules let join two Areas, with what [`Self::save`] kept of it: only Fragments that were made from something else than
    /// stands in the world now are built anew. Answers how many; bytes of anything else are as good as none.
    ///
    /// # Panics
    /// When the map is not of this world.
    #[must_use]
    pub fn restore(
        world: &World,
        openings: &Openings,
        map: MapId,
        robot: &RobotProfile,
        states: &DoorStates,
        kept: &[u8],
    ) -> (Self, usize) {
        let scene = Scene::of(world, map);
        let mut plan = Self {
            map,
            robot: robot.clone(),
            states: states.clone(),
            zones: Arc::new(placed(world, &scene, map, Zone::is_standing)),
            index: Arc::new(ReplicaIndex::of(&scene)),
            doorways: Arc::new(Doorways::of(openings, map)),
            scene: Arc::new(scene),
            fragments: Vec::new(),
            covered: Vec::new(),
            admits: Vec::new(),
            network: Network::default(),
            straits: Vec::new(),
            extents: Arc::default(),
            by_place: Arc::default(),
        };
        let areas: Vec<AreaId> = plan.scene.areas.keys().copied().collect();
        let (fragments, built) = plan.with_site(world, |site| {
            let mut kept = if kept.is_empty() { HashMap::new() } else { kept::read(kept) };
            if kept.is_empty() {
                return (build_all(site, &areas), areas.len());
            }
            let digests = areas.iter().zip(digests(site, &areas));
            let same = digests.filter_map(|(area, digest)| {
                let (own, floor) = kept.remove(area)?;
                let count = site.by_area.of(*area).len();
                let leads = |doorway: usize| doorway < count;
                let is_sound = floor.doorways().all(leads);
                (own == digest && is_sound).then(|| Arc::new(floor))
            });
            let mut floors: Vec<Arc<FragmentFloor>> = same.collect();
            let missing = |a: &&AreaId| floors.binary_search_by_key(*a, |f| f.area).is_err();
            let stale: Vec<AreaId> = areas.iter().filter(missing).copied().collect();
            floors.extend(build_all(site, &stale));
            floors.sort_by_key(|f| f.area);
            (floors, stale.len())
        });
        plan.fragments = fragments;
        plan.extents = Arc::new(plan.fragments.iter().map(|f| plan.extent_of(f)).collect());
        plan.by_place = Arc::new(Buckets::of(&plan.extents));
        plan.connect(world, 0..areas.len());
        (plan, built)
    }

    /// The Fragments' floors as bytes, each with a digest of what it was made from, for [`Self::restore`].
    #[must_use]
    pub fn save(&self, world: &World) -> Vec<u8> {
        let areas: Vec<AreaId> = self.fragments.iter().map(|f| f.area).collect();
        let digests = self.with_site(world, |site| digests(site, &areas));
        let fragments = self.fragments.iter().map(Arc::as_ref);
        kept::write(digests.into_iter().zip(fragments))
    }

    /// Finds where the given Fragments touch others, and what hangs together now.
    pub(crate) fn connect(&mut self, world: &World, stale: impl IntoIterator<Item = usize>) {
        let (mut touched, mut crossed) = (BTreeSet::new(), BTreeSet::new());
        let stale: Vec<usize> = stale.into_iter().collect();
        for &number in &stale {
            touched.insert(number);
            let area = self.fragments[number].area;
            for &(doorway, side) in self.doorways.by_area.of(area).iter() {
                crossed.insert(doorway);
                touched.extend(self.number(self.doorways.ways[doorway].areas[1 - side]));
            }
        }
        self.network.portals.resize(self.fragments.len(), Vec::new());
        for number in touched {
            self.network.portals[number] = self.portals_from(number);
        }
        let count = self.fragments.len();
        self.straits.resize(count + self.doorways.ways.len(), Vec::new());
        self.covered.resize(count, OnceLock::new());
        self.admits.resize(self.doorways.ways.len(), false);
        for &doorway in &crossed {
            self.admits[doorway] =
                self.with_site(world, |site| site.is_open(&self.doorways.ways[doorway]));
        }
        if !self.robot.footprint.is_empty() {
            // Straits lead on through Fragments without a place to turn.
            let mut open: Vec<usize> = crossed.iter().copied().collect();
            while let Some(doorway) = open.pop() {
                let sides =
                    self.doorways.ways[doorway].areas.iter().filter_map(|&a| self.number(a));
                for number in sides.filter(|&n| self.is_blind(n as u32)) {
                    let own = self.doorways_at(number as u32).iter().map(|d| d.0);
                    open.extend(own.filter(|&d| crossed.insert(d)));
                }
            }
            let mut changed = BTreeSet::new();
            let reach = self.body_reach();
            let mut near = Vec::new();
            let mut mark = |changed: &mut BTreeSet<usize>, extent: &Bounds| {
                self.by_place.meeting(extent, &mut near);
                changed.extend(near.iter().map(|&n| n as usize));
            };
            for &number in &stale {
                mark(&mut changed, &self.extent_of(&self.fragments[number]).grown(reach));
            }
            let within = stale.iter().map(|&n| (n, strait::within(self, n as u32)));
            let through = crossed.iter().map(|&d| (count + d, strait::through(self, d)));
            for (place, fresh) in within.chain(through).collect::<Vec<_>>() {
                let gone = std::mem::replace(&mut self.straits[place], fresh);
                for strait in gone.iter().chain(&self.straits[place]) {
                    mark(&mut changed, &strait.extent());
                }
            }
            for number in changed {
                self.covered[number] = OnceLock::new();
            }
        }
        let straits = self.straits.iter().flatten().cloned().collect();
        self.network.join(&self.fragments, self.doorways.ways.len(), straits);
    }

    /// The places where a Fragment's centre space touches another's.
    fn portals_from(&self, number: usize) -> Vec<Portal> {
        let fragment = &self.fragments[number];
        let mut portals = Vec::new();
        for exit in &fragment.exits {
            let Some(index) = self.doorway_at(fragment.area, exit.doorway) else { continue };
            let doorway = &self.doorways.ways[index];
            let other = doorway.index_of(fragment.area).map(|side| doorway.areas[1 - side]);
            let Some((area, to)) = other.and_then(|a| Some((a, self.number(a)?))) else { continue };
            let own = fragment.cells.edge(exit.cell, exit.edge);
            let there = |number: usize| self.doorway_at(area, number) == Some(index);
            for entry in self.fragments[to].exits.iter().filter(|e| there(e.doorway)) {
                let opposite = self.fragments[to].cells.edge(entry.cell, entry.edge);
                if let Some((right, left)) = overlap(own, opposite) {
                    portals.push(Portal {
                        from: (number as u32, exit.cell),
                        edge: exit.edge,
                        to: (to as u32, entry.cell),
                        right,
                        left,
                        doorway: index,
                    });
                }
            }
        }
        portals.sort_by_key(|p| (p.from, p.edge, p.to));
        portals
    }
}

/// The floors of Areas, in their order, by as many threads as the machine has for so much work.
pub(crate) fn build_all(site: &Site<'_>, areas: &[AreaId]) -> Vec<Arc<FragmentFloor>> {
    let build = |area: &AreaId| Arc::new(FragmentFloor::build(site, *area));
    const WORTH_A_THREAD: usize = 8;
    let worth = areas.len() / WORTH_A_THREAD;
    // How many cores there are is read from files.
    let most = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if worth < 2 { 1 } else { worth.min(most()) };
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
