//! Variant 2 of the road graph: two vertices per entrance, one for each direction (paper 4, fig. 3).
//!
//! Junctions have no vertices. An arc leads from one entrance to the next, along the corridor or through
//! junctions, and bears the commands for it; a U-turn is an arc as well, at dead ends too. The state needs no
//! memory of the last arc, since from a vertex one can only drive one way along the corridor.
//!
//! Of several ways through a cluster of junctions to the same vertex the graph keeps the best one: with
//! doorless rings of corridors there would be no end of them.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use petgraph::algo::dijkstra;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::{EdgeRef, Reversed};

use super::CorridorError;
use super::command::Command;
use super::single::command_of;
use super::system::{ArcCode, ArcIx, CorridorSystem, VertexIx, side_seen};
use super::way::{Position, Way};
use super::weight::{Cost, arc_costs, u_turn_cost};

/// A vertex of variant 2: at an entrance, with a direction of travel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Bearing {
    pub vertex: VertexIx,
    /// The paper's stroke: drives back along the corridor rather than forth.
    pub primed: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DoubleArcKind {
    UTurn,
    /// From an entrance to the next one.
    Corridor,
    /// Through one junction or several.
    Junction,
}

/// An arc of variant 2 with its command list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DoubleArc {
    pub kind: DoubleArcKind,
    pub commands: Vec<Command>,
    pub cost: Cost,
}

/// The road graph of variant 2.
#[derive(Debug, Clone)]
pub struct DoubleGraph<'a> {
    system: &'a CorridorSystem,
    /// Each entrance gives two neighbouring nodes: without and with the stroke.
    pub graph: DiGraph<Bearing, DoubleArc>,
    nodes: BTreeMap<Bearing, NodeIndex>,
}

impl<'a> DoubleGraph<'a> {
    /// # Errors
    /// [`CorridorError::NoLength`] when metres are to be counted and a stretch has no length.
    pub fn new(system: &'a CorridorSystem) -> Result<Self, CorridorError> {
        let costs = arc_costs(system)?;
        let mut graph = DiGraph::new();
        let mut nodes = BTreeMap::new();
        for (vertex, _) in system.vertices().filter(|(_, v)| v.entrance().is_some()) {
            for primed in [false, true] {
                let bearing = Bearing { vertex, primed };
                nodes.insert(bearing, graph.add_node(bearing));
            }
        }
        let u_turn = u_turn_cost(system);
        for (&bearing, &from) in &nodes {
            let turned = Bearing { primed: !bearing.primed, ..bearing };
            let (kind, commands) = (DoubleArcKind::UTurn, vec![Command::UTurn]);
            graph.add_edge(from, nodes[&turned], DoubleArc { kind, commands, cost: u_turn });
            for (to, arc) in drives(system, &costs, bearing) {
                if to != bearing {
                    graph.add_edge(from, nodes[&to], arc);
                }
            }
        }
        Ok(Self { system, graph, nodes })
    }

    /// The shortest way, chosen as [`super::SingleGraph::way`] chooses it.
    ///
    /// # Errors
    /// [`CorridorError::AtJunction`]: this variant has no vertex there.
    pub fn way(
        &self,
        position: Position,
        goals: &[VertexIx],
    ) -> Result<Option<Way>, CorridorError> {
        let Some(entrance) = self.system.vertex(position.vertex).entrance() else {
            let vertex = self.system.vertex(position.vertex).number;
            return Err(CorridorError::AtJunction { vertex });
        };
        let starts: Vec<(Vec<Command>, Bearing)> = match position.last {
            Some(last) => vec![(Vec::new(), arrival(self.system, last))],
            None => [false, true]
                .map(|primed| {
                    let side = side_seen(entrance, usize::from(primed));
                    let bearing = Bearing { vertex: position.vertex, primed };
                    (vec![Command::Face(side)], bearing)
                })
                .to_vec(),
        };
        Ok(self.way_from(starts, goals))
    }

    fn way_from(&self, starts: Vec<(Vec<Command>, Bearing)>, goals: &[VertexIx]) -> Option<Way> {
        let remaining = self.costs_to(goals);
        let (mut commands, start) = starts
            .into_iter()
            .filter(|(_, bearing)| remaining[self.nodes[bearing].index()].is_some())
            .min_by(|(a, x), (b, y)| {
                let left = |bearing| remaining[self.nodes[bearing].index()];
                left(x).cmp(&left(y)).then_with(|| a.cmp(b))
            })?;
        let mut node = self.nodes[&start];
        let cost = remaining[node.index()].expect("starts without a way were left out");
        let mut labels = vec![self.label(node)];
        while remaining[node.index()] != Some(0) {
            let arc = self
                .graph
                .edges(node)
                .filter(|arc| remaining[arc.target().index()].is_some())
                .min_by(|a, b| {
                    let total = |e: &petgraph::graph::EdgeReference<'_, DoubleArc>| {
                        remaining[e.target().index()].map(|r| r + e.weight().cost)
                    };
                    let by_commands = || a.weight().commands.cmp(&b.weight().commands);
                    total(a).cmp(&total(b)).then_with(by_commands)
                })
                .expect("a vertex with a remaining cost has an arc on the way");
            commands.extend(&arc.weight().commands);
            node = arc.target();
            labels.push(self.label(node));
        }
        let Bearing { vertex, primed } = self.graph[node];
        let behind = self.system.departure(vertex, usize::from(primed))?;
        Some(Way { commands, labels, cost, arrived_by: behind.reversed() })
    }

    /// By node: the cost to the nearest goal, in whatever direction it is reached.
    fn costs_to(&self, goals: &[VertexIx]) -> Vec<Option<Cost>> {
        let mut best = vec![None; self.graph.node_count()];
        for bearing in self.nodes.keys().filter(|b| goals.contains(&b.vertex)) {
            let start = self.nodes[bearing];
            for (node, cost) in
                dijkstra(Reversed(&self.graph), start, None, |arc| arc.weight().cost)
            {
                let best = &mut best[node.index()];
                *best = Some(best.map_or(cost, |b: Cost| b.min(cost)));
            }
        }
        best
    }

    /// «2» or «2'»
    #[must_use]
    pub fn label(&self, node: NodeIndex) -> String {
        let Bearing { vertex, primed } = self.graph[node];
        let stroke = if primed { "'" } else { "" };
        format!("{}{stroke}", self.system.vertex(vertex).number)
    }
}

/// The vertex at which an arc into an entrance arrives.
fn arrival(system: &CorridorSystem, arc: ArcIx) -> Bearing {
    let head = system.head(arc);
    Bearing { vertex: head.vertex, primed: head.port == 1 }
}

/// Every entrance that can be reached as the next one, with the best arc to it.
///
/// Dijkstra's algorithm over the arcs between junctions, by cost and then by commands.
fn drives(system: &CorridorSystem, costs: &[Cost], from: Bearing) -> BTreeMap<Bearing, DoubleArc> {
    let mut found = BTreeMap::new();
    let mut done = BTreeSet::new();
    let mut queue = BinaryHeap::new();
    if let Some(arc) = system.departure(from.vertex, usize::from(!from.primed)) {
        queue.push(Reverse((costs[arc.0], vec![command_of(system.code(arc))], arc)));
    }
    while let Some(Reverse((cost, commands, arc))) = queue.pop() {
        if !done.insert(arc) {
            continue;
        }
        if matches!(system.code(arc), ArcCode::Door(_)) {
            let through = commands.len() > 1;
            let kind = if through { DoubleArcKind::Junction } else { DoubleArcKind::Corridor };
            found.insert(arrival(system, arc), DoubleArc { kind, commands, cost });
            continue;
        }
        for (next, turn) in system.successors(arc) {
            let mut commands = commands.clone();
            commands.extend([Command::Take(turn), command_of(system.code(next))]);
            queue.push(Reverse((cost + costs[next.0], commands, next)));
        }
    }
    found
}
