//! Variant 1 of the road graph: one vertex per entrance and per junction (paper 4, fig. 2, tables 1-3).
//!
//! The robot's position is a vertex and the arc driven last. A way is a sequence of arcs; the auxiliary table
//! says how to leave a junction, and a U-turn comes first when the way starts back over the last arc.
//!
//! Unlike the paper, Dijkstra's algorithm runs over pairs of successive arcs, not over vertices: a way over
//! vertices could turn round in a junction for nothing, and could not weigh the U-turn at its start.

use petgraph::algo::dijkstra;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::{EdgeRef, Reversed};

use super::CorridorError;
use super::command::Command;
use super::system::{ArcCode, ArcIx, CorridorSystem, Turn, VertexIx, side_seen};
use super::way::{Position, Way};
use super::weight::{Cost, arc_costs, u_turn_cost};

/// An arc of variant 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SingleArc {
    pub arc: ArcIx,
    pub code: ArcCode,
    pub cost: Cost,
}

/// A row of the auxiliary table (table 3): two arcs that share a junction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TurnRow {
    pub first: ArcIx,
    pub second: ArcIx,
    pub turn: Turn,
}

/// The road graph of variant 1.
#[derive(Debug, Clone)]
pub struct SingleGraph<'a> {
    system: &'a CorridorSystem,
    /// Nodes in the order of the system's vertices, edges in the order of its arcs.
    pub graph: DiGraph<VertexIx, SingleArc>,
    /// The auxiliary table, by first arc and turn.
    pub table: Vec<TurnRow>,
    /// Which arc can follow which without a U-turn; a node per arc, the edge bears the cost of the second.
    succession: DiGraph<ArcIx, Cost>,
    u_turn: Cost,
}

impl<'a> SingleGraph<'a> {
    /// # Errors
    /// [`CorridorError::NoLength`] when metres are to be counted and a stretch has no length.
    pub fn new(system: &'a CorridorSystem) -> Result<Self, CorridorError> {
        let costs = arc_costs(system)?;
        let mut graph = DiGraph::new();
        let mut succession = DiGraph::new();
        for (vertex, _) in system.vertices() {
            graph.add_node(vertex);
        }
        for arc in system.arcs() {
            let (tail, head) = (system.tail(arc).vertex, system.head(arc).vertex);
            let weight = SingleArc { arc, code: system.code(arc), cost: costs[arc.0] };
            graph.add_edge(NodeIndex::new(tail.0), NodeIndex::new(head.0), weight);
            succession.add_node(arc);
        }
        let mut table = Vec::new();
        for first in system.arcs() {
            for (second, turn) in system.successors(first) {
                succession.add_edge(node(first), node(second), costs[second.0]);
                if matches!(system.code(first), ArcCode::Junction(_)) {
                    table.push(TurnRow { first, second, turn });
                }
            }
        }
        Ok(Self { system, graph, table, succession, u_turn: u_turn_cost(system) })
    }

    /// The shortest way from a position to the nearest of the goals; none where no corridor leads there.
    ///
    /// Of equally short ways the one with the fewest U-turns, then the one that goes straight before right,
    /// right before left, at the first junction where they part.
    #[must_use]
    pub fn way(&self, position: Position, goals: &[VertexIx]) -> Option<Way> {
        let remaining = self.costs_to(goals);
        let (_, first, mut commands, mut arc) = self
            .starts(position)
            .into_iter()
            .filter_map(|(cost, commands, arc)| {
                Some((cost + self.cost(arc) + remaining[arc.0]?, cost, commands, arc))
            })
            .min_by(|a, b| a.0.cmp(&b.0).then_with(|| a.2.cmp(&b.2)))?;
        let mut cost = first;
        let mut labels = vec![self.label(position.vertex)];
        loop {
            cost += self.cost(arc);
            commands.push(command_of(self.system.code(arc)));
            labels.push(self.label(self.system.head(arc).vertex));
            if remaining[arc.0] == Some(0) {
                return Some(Way { commands, labels, cost, arrived_by: arc });
            }
            let (next, turn) = self
                .system
                .successors(arc)
                .into_iter()
                .filter(|(next, _)| remaining[next.0].is_some())
                .min_by_key(|(next, _)| remaining[next.0].map(|r| r + self.cost(*next)))
                .expect("an arc with a remaining cost has a successor on the way");
            if matches!(self.system.code(arc), ArcCode::Junction(_)) {
                commands.push(Command::Take(turn));
            }
            arc = next;
        }
    }

    /// What stands before the first arc: its cost and commands, for each arc that leaves the position.
    fn starts(&self, position: Position) -> Vec<(Cost, Vec<Command>, ArcIx)> {
        let system = self.system;
        let Some(last) = position.last else {
            let Some(entrance) = system.vertex(position.vertex).entrance() else {
                return Vec::new();
            };
            let face = |arc| {
                let from = 1 - system.tail(arc).port;
                (0, vec![Command::Face(side_seen(entrance, from))], arc)
            };
            return system.departures(position.vertex).map(face).collect();
        };
        let at_junction = system.vertex(position.vertex).junction().is_some();
        let on = system.successors(last).into_iter().map(|(arc, turn)| {
            let turn = at_junction.then_some(Command::Take(turn));
            (0, turn.into_iter().collect(), arc)
        });
        on.chain([(self.u_turn, vec![Command::UTurn], last.reversed())]).collect()
    }

    /// By arc: the cost from its end to the nearest goal.
    fn costs_to(&self, goals: &[VertexIx]) -> Vec<Option<Cost>> {
        let mut best = vec![None; self.succession.node_count()];
        let arrivals = goals.iter().flat_map(|&g| self.system.departures(g)).map(ArcIx::reversed);
        for arrival in arrivals {
            let costs = dijkstra(Reversed(&self.succession), node(arrival), None, |e| *e.weight());
            for (arc, cost) in costs {
                let best = &mut best[arc.index()];
                *best = Some(best.map_or(cost, |b: Cost| b.min(cost)));
            }
        }
        best
    }

    fn cost(&self, arc: ArcIx) -> Cost {
        self.graph[petgraph::graph::EdgeIndex::new(arc.0)].cost
    }

    fn label(&self, vertex: VertexIx) -> String {
        self.system.vertex(vertex).number.to_string()
    }
}

fn node(arc: ArcIx) -> NodeIndex {
    NodeIndex::new(arc.0)
}

/// The command that drives an arc of this code.
pub(super) fn command_of(code: ArcCode) -> Command {
    match code {
        ArcCode::Junction(kind) => Command::ToJunction(kind),
        ArcCode::Door(side) => Command::ToDoor(side),
    }
}
