//! A road graph as a figure: plain points and labels for a drawing of either variant.

use petgraph::visit::EdgeRef;

use crate::units::{Point, Vector};

use super::double::{DoubleArcKind, DoubleGraph};
use super::single::SingleGraph;
use super::system::{ArcCode, CorridorSystem};
use super::{CorridorError, Variant};

#[derive(Debug, Clone, PartialEq)]
pub struct FigureVertex {
    pub at: Point,
    pub is_junction: bool,
    /// «2», «2'»
    pub label: String,
    /// The room; empty for a junction.
    pub name: String,
    pub name_towards: Vector,
    /// Name of the floor; empty in a description of one floor.
    pub floor: String,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FigureArc {
    pub from: usize,
    pub to: usize,
    /// Code of table 1; empty in variant 2.
    pub label: String,
    pub on_way: bool,
    pub is_u_turn: bool,
}

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// The floor that is shown; empty in a description of one floor.
    pub floor: String,
    pub vertices: Vec<FigureVertex>,
    pub arcs: Vec<FigureArc>,
}

/// The road graph of a variant, with a way marked on it: the labels of [`super::Directions::path`]. Of several floors, which
/// lie over each other, that of the way is shown.
///
/// # Errors
/// [`CorridorError::NoLength`] as the graphs have it.
pub fn figure(
    system: &CorridorSystem,
    variant: Variant,
    path: &[String],
) -> Result<Figure, CorridorError> {
    let mut figure = match variant {
        Variant::Single => single(system, &SingleGraph::new(system)?),
        Variant::Double => double(system, &DoubleGraph::new(system)?),
    };
    let first = path.first().and_then(|l| figure.vertices.iter().find(|v| v.label == *l));
    if let Some(floor) = first.map(|vertex| vertex.floor.clone()) {
        figure.keep(floor);
    }
    for arc in &mut figure.arcs {
        let labels = [arc.from, arc.to].map(|v| &figure.vertices[v].label);
        arc.on_way = path.windows(2).any(|pair| [&pair[0], &pair[1]] == labels);
    }
    Ok(figure)
}

impl Figure {
    /// Leaves out what is on other floors.
    fn keep(&mut self, floor: String) {
        let mut kept = 0..;
        let is_here = |vertex: &FigureVertex| vertex.floor == floor;
        let place: Vec<Option<usize>> =
            self.vertices.iter().map(|v| is_here(v).then(|| kept.next()).flatten()).collect();
        self.vertices.retain(is_here);
        self.arcs.retain_mut(|arc| match (place[arc.from], place[arc.to]) {
            (Some(from), Some(to)) => {
                (arc.from, arc.to) = (from, to);
                true
            }
            _ => false,
        });
        self.floor = floor;
    }
}

fn single(system: &CorridorSystem, graph: &SingleGraph<'_>) -> Figure {
    let vertices = system.vertices().zip(system.places()).map(|((_, vertex), place)| {
        let entrance = vertex.entrance();
        FigureVertex {
            at: place.at,
            is_junction: entrance.is_none(),
            label: vertex.number.to_string(),
            name: entrance.map(|e| e.room.clone()).unwrap_or_default(),
            name_towards: place.door_towards,
            floor: vertex.floor.clone(),
        }
    });
    let arcs = graph.graph.edge_references().map(|arc| FigureArc {
        from: arc.source().index(),
        to: arc.target().index(),
        label: code_label(arc.weight().code),
        on_way: false,
        is_u_turn: false,
    });
    Figure { vertices: vertices.collect(), arcs: arcs.collect(), ..Figure::default() }
}

/// The two vertices of an entrance stand on either side of the middle, each on its driver's right.
fn double(system: &CorridorSystem, graph: &DoubleGraph<'_>) -> Figure {
    let places = system.places();
    let mut nearest = f64::INFINITY;
    for stretch in system.stretches() {
        let [a, b] = stretch.ends.map(|end| places[end.vertex.0].at);
        let gap = (a - b).norm();
        if gap > 1e-6 {
            nearest = nearest.min(gap);
        }
    }
    let apart = if nearest.is_finite() { 0.3 * nearest } else { 1.0 };
    let vertices = graph.graph.node_indices().map(|node| {
        let bearing = graph.graph[node];
        let place = places[bearing.vertex.0];
        let entrance = system.vertex(bearing.vertex).entrance();
        let right = place.right * if bearing.primed { -apart } else { apart };
        let name_here = right.dot(&place.door_towards) > 1e-9 * apart
            || (right.dot(&place.door_towards).abs() <= 1e-9 * apart && !bearing.primed);
        FigureVertex {
            at: place.at + right,
            is_junction: false,
            label: graph.label(node),
            name: entrance.filter(|_| name_here).map(|e| e.room.clone()).unwrap_or_default(),
            name_towards: place.door_towards,
            floor: system.vertex(bearing.vertex).floor.clone(),
        }
    });
    let arcs = graph.graph.edge_references().map(|arc| FigureArc {
        from: arc.source().index(),
        to: arc.target().index(),
        label: String::new(),
        on_way: false,
        is_u_turn: arc.weight().kind == DoubleArcKind::UTurn,
    });
    Figure { vertices: vertices.collect(), arcs: arcs.collect(), ..Figure::default() }
}

fn code_label(code: ArcCode) -> String {
    code.number().to_string()
}
