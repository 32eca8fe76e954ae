//! Where the vertices stand in a schematic drawing.
//!
//! A Map gives real places. A corridor file has none, so the drawing is laid out on a grid: corridors run east,
//! north, west or south as the junctions say, and every vertex takes the first free place in its direction.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::units::{Deg, Point, Vector};

use super::system::{ArcIx, CorridorSystem, Port, Side, VertexIx, VertexKind};

/// A vertex's place in a drawing, +y to the north.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    pub at: Point,
    /// To the side on which its door is; zero for a junction.
    pub door_towards: Vector,
    /// To the right of one who drives forth.
    pub right: Vector,
}

impl CorridorSystem {
    /// A place for each vertex, in the order of their indices; no two vertices share one.
    #[must_use]
    pub fn places(&self) -> Vec<Place> {
        let headings = self.headings();
        let given: Option<Vec<Point>> = self.vertices().map(|(_, v)| v.at).collect();
        let at = given.unwrap_or_else(|| self.grid(&headings));
        let heading_of = |v: VertexIx| match self.departures(v).next() {
            // Real places tell the heading better than the quarter turns of the grid.
            Some(arc) if self.vertex(v).at.is_some() => {
                let way = at[self.head(arc).vertex.0] - at[v.0];
                let way = if self.tail(arc).port == 0 { -way } else { way };
                way.try_normalize(1e-6).unwrap_or_else(|| unit(headings[v.0]))
            }
            _ => unit(headings[v.0]),
        };
        self.vertices()
            .map(|(v, vertex)| {
                let forth = heading_of(v);
                let left = Vector::new(-forth.y, forth.x);
                let door_towards = match &vertex.kind {
                    VertexKind::Junction(_) => Vector::zeros(),
                    VertexKind::Entrance(entrance) => match entrance.side {
                        Side::Left => left,
                        Side::Right => -left,
                        // The dead end is where no stretch leaves.
                        Side::Ahead if self.departure(v, 1).is_none() => forth,
                        Side::Ahead => -forth,
                    },
                };
                Place { at: at[v.0], door_towards, right: -left }
            })
            .collect()
    }

    /// The way in which each vertex faces (for a junction: its frame's +x), from the first vertex outwards.
    fn headings(&self) -> Vec<Deg> {
        let mut headings: Vec<Option<Deg>> = vec![None; self.vertices().len()];
        for (start, _) in self.vertices() {
            if headings[start.0].is_some() {
                continue;
            }
            headings[start.0] = Some(Deg::ZERO);
            let mut queue = VecDeque::from([start]);
            while let Some(vertex) = queue.pop_front() {
                for arc in self.departures(vertex) {
                    let head = self.head(arc);
                    if headings[head.vertex.0].is_none() {
                        let way = self.direction(arc, &headings);
                        let back = self.port_angle(head) + Deg::of(180.0);
                        headings[head.vertex.0] = Some(way - back);
                        queue.push_back(head.vertex);
                    }
                }
            }
        }
        headings.into_iter().map(Option::unwrap_or_default).collect()
    }

    /// The way in which a port looks, in its vertex's own frame.
    fn port_angle(&self, Port { vertex, port }: Port) -> Deg {
        match &self.vertex(vertex).kind {
            VertexKind::Junction(junction) => junction.arms[port],
            VertexKind::Entrance(_) => Deg::of(if port == 1 { 0.0 } else { 180.0 }),
        }
    }

    fn direction(&self, arc: ArcIx, headings: &[Option<Deg>]) -> Deg {
        let tail = self.tail(arc);
        headings[tail.vertex.0].unwrap_or_default() + self.port_angle(tail)
    }

    fn grid(&self, headings: &[Deg]) -> Vec<Point> {
        let headings: Vec<Option<Deg>> = headings.iter().copied().map(Some).collect();
        let mut cells: BTreeMap<VertexIx, (i64, i64)> = BTreeMap::new();
        let mut taken = BTreeSet::new();
        for (start, _) in self.vertices() {
            if cells.contains_key(&start) {
                continue;
            }
            // Corridors that do not meet stand one above the other.
            let below = taken.iter().map(|(_, y): &(i64, i64)| y - 2).min().unwrap_or(0);
            cells.insert(start, (0, below));
            taken.insert((0, below));
            let mut queue = VecDeque::from([start]);
            while let Some(vertex) = queue.pop_front() {
                for arc in self.departures(vertex) {
                    let next = self.head(arc).vertex;
                    if cells.contains_key(&next) {
                        continue;
                    }
                    let way = unit(self.direction(arc, &headings));
                    let step = (way.x.round() as i64, way.y.round() as i64);
                    let mut cell = cells[&vertex];
                    while taken.contains(&cell) {
                        cell = (cell.0 + step.0, cell.1 + step.1);
                    }
                    taken.insert(cell);
                    cells.insert(next, cell);
                    queue.push_back(next);
                }
            }
        }
        let point = |(v, _)| {
            let (x, y) = cells[&v];
            Point::new(x as f64, y as f64)
        };
        self.vertices().map(point).collect()
    }
}

fn unit(heading: Deg) -> Vector {
    let (sin, cos) = heading.sin_cos();
    Vector::new(cos, sin)
}
