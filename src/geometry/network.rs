//! The network over which ways are looked for: cells within a Fragment, doorways between Fragments.
//!
//! **Invariant**: it depends on the Fragments' floors alone, not on how they came about.

use std::collections::BTreeMap;
use std::sync::Arc;

use petgraph::unionfind::UnionFind;

use crate::units::Point;

use super::Bounds;
use super::cells::{CellKey, Piece};
use super::floor::FragmentFloor;

/// Where two Fragments' centre spaces touch on a doorway's line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Portal {
    /// Fragment, cell and edge on this side.
    pub(super) from: CellKey,
    pub(super) edge: usize,
    pub(super) to: CellKey,
    pub(super) right: Point,
    pub(super) left: Point,
    pub(super) doorway: usize,
}

/// Straight legs between two pieces of centre space, one for each way.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Strait {
    pub(super) lanes: [Lane; 2],
    /// The doorways that it passes, by their indices in the plan, which rise, each with the Fragments on its sides.
    pub(super) doorways: Vec<(usize, [u32; 2])>,
}

impl Strait {
    /// The cells at its ends.
    pub(super) fn cells(&self) -> [CellKey; 2] {
        self.lanes[0].cells
    }

    /// A box around its lanes.
    pub(super) fn extent(&self) -> Bounds {
        Bounds::of(self.lanes.iter().flat_map(|lane| lane.ends))
    }
}

/// A straight leg from the first to the second of two places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lane {
    pub(super) ends: [Point; 2],
    pub(super) cells: [CellKey; 2],
}

impl Lane {
    pub(super) fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    pub(super) fn reversed(&self) -> Self {
        let ([a, b], [from, to]) = (self.ends, self.cells);
        Self { ends: [b, a], cells: [to, from] }
    }
}

/// How the Fragments of a Map hang together.
#[derive(Debug, Clone, Default)]
pub(super) struct Network {
    /// By Fragment, sorted by cell and edge.
    pub(super) portals: Vec<Vec<Portal>>,
    /// Where the pieces of each Fragment begin in `regions`; one entry more than there are Fragments.
    first: Vec<u32>,
    /// Where the cells of each Fragment begin among all cells of the plan; one entry more than there are Fragments.
    cells: Vec<u32>,
    /// Which pieces hang together over open doorways and straits.
    regions: Vec<u32>,
    /// Narrow legs between pieces; of a robot with a convex footprint only.
    pub(super) straits: Vec<Strait>,
    /// Which pieces hang together without straits; empty where there are none.
    open: Vec<u32>,
    /// See [`Branches`].
    branches: Branches,
}

impl Network {
    /// Finds anew what hangs together over the portals.
    pub(super) fn join(
        &mut self,
        fragments: &[Arc<FragmentFloor>],
        doorways: usize,
        straits: Vec<Strait>,
    ) {
        self.first.clear();
        let mut count = 0;
        for fragment in fragments {
            self.first.push(count);
            count += fragment.cells.components;
        }
        self.first.push(count);
        self.cells = std::iter::once(0)
            .chain(fragments.iter().scan(0, |cells, fragment| {
                *cells += fragment.cells.len() as u32;
                Some(*cells)
            }))
            .collect();
        let place = |(fragment, cell): CellKey| {
            let component = fragments[fragment as usize].cells.component(cell);
            (self.first[fragment as usize] + component) as usize
        };
        let mut sets = UnionFind::<u32>::new(count as usize);
        for portal in self.portals.iter().flatten().filter(|p| p.from.0 < p.to.0) {
            sets.union(place(portal.from) as u32, place(portal.to) as u32);
        }
        self.open = if straits.is_empty() { Vec::new() } else { sets.clone().into_labeling() };
        for strait in &straits {
            let [a, b] = strait.cells().map(place);
            sets.union(a as u32, b as u32);
        }
        self.regions = sets.into_labeling();
        self.branches = Branches::of(&self.portals, &straits, doorways);
        self.straits = straits;
    }

    /// The region of a piece: the robot can go between pieces of one region.
    pub(super) fn region(&self, (number, component): Piece) -> u32 {
        self.regions[(self.first[number as usize] + component) as usize]
    }

    /// The region of a piece that the robot does not leave by a strait.
    pub(super) fn open_region(&self, (number, component): Piece) -> u32 {
        let regions = if self.open.is_empty() { &self.regions } else { &self.open };
        regions[(self.first[number as usize] + component) as usize]
    }

    /// The pieces of centre space by the region they belong to.
    pub(super) fn pieces(&self) -> BTreeMap<u32, Vec<Piece>> {
        let mut pieces: BTreeMap<u32, Vec<Piece>> = BTreeMap::new();
        for (number, span) in (0..).zip(self.first.windows(2)) {
            for component in 0..span[1] - span[0] {
                pieces
                    .entry(self.region((number, component)))
                    .or_default()
                    .push((number, component));
            }
        }
        pieces
    }

    /// The Fragments that a shortest way between two of them can pass.
    pub(super) fn between(&self, start: u32, goal: u32) -> Vec<u32> {
        self.branches.between(start, goal)
    }

    /// How many cells the plan has.
    pub(super) fn size(&self) -> u32 {
        self.cells.last().copied().unwrap_or_default()
    }

    /// A cell's number among all cells of the plan.
    pub(super) fn number(&self, (fragment, cell): CellKey) -> u32 {
        self.cells[fragment as usize] + cell
    }

    pub(super) fn portals_of(&self, cell: CellKey) -> impl Iterator<Item = &Portal> {
        let list = &self.portals[cell.0 as usize];
        let from = list.partition_point(|p| p.from < cell);
        list[from..].iter().take_while(move |p| p.from == cell)
    }
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
    fn of(portals: &[Vec<Portal>], straits: &[Strait], doorways: usize) -> Self {
        let mut graph =
            petgraph::graph::UnGraph::<(), usize, u32>::with_capacity(portals.len(), doorways);
        portals.iter().for_each(|_| {
            graph.add_node(());
        });
        let mut is_joined = vec![false; doorways];
        for portal in portals.iter().flatten().filter(|p| p.from.0 < p.to.0) {
            if !std::mem::replace(&mut is_joined[portal.doorway], true) {
                graph.add_edge(portal.from.0.into(), portal.to.0.into(), portal.doorway);
            }
        }
        for &(doorway, [one, other]) in straits.iter().flat_map(|s| &s.doorways) {
            if one != other && !std::mem::replace(&mut is_joined[doorway], true) {
                graph.add_edge(one.into(), other.into(), doorway);
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

/// The stretch of `a`-`b` that the opposite edge `c`-`d` covers.
pub(super) fn overlap((a, b): (Point, Point), (c, d): (Point, Point)) -> Option<(Point, Point)> {
    let along = (b - a).try_normalize(0.0)?;
    let place = |p: Point| (p - a).dot(&along);
    let from = place(c).min(place(d)).max(0.0);
    let to = place(c).max(place(d)).min((b - a).norm());
    let end = |t: f64, p: Point, own: f64| if (t - own).abs() < 1e-9 { p } else { a + along * t };
    (to - from > 1e-6).then(|| (end(from, a, 0.0), end(to, b, (b - a).norm())))
}
