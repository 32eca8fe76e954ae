//! The corridors themselves: entrances and junctions, joined by stretches of corridor.
//!
//! Both road graphs of paper 4 are built from this one description, which knows no coordinates: an entrance
//! has a side, a junction has arms in a circular order, a stretch joins two of them. What a robot sees on
//! arriving at a vertex (the arc codes of table 1) and how it leaves a junction (table 2) follow from here.
//!
//! **Invariant**: every stretch ends in two different ports, and no port holds two stretches.

use std::borrow::Cow;

use crate::units::{Cm, Deg, Gather as _, InOrder as _, Point};

/// Index of a vertex in its system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VertexIx(pub usize);

/// A stretch driven one way. The two ways of one stretch are neighbours in number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ArcIx(pub usize);

impl ArcIx {
    /// The same stretch, driven the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self(self.0 ^ 1)
    }

    /// Index of the stretch.
    #[must_use]
    pub fn stretch(self) -> usize {
        self.0 / 2
    }
}

/// On which hand something is for one who drives by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    Right,
    Left,
    /// In the end wall of a dead end (beyond the paper, whose doors are right or left).
    Ahead,
}

impl Side {
    /// The side for one who comes the other way.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Right => Self::Left,
            Self::Left => Self::Right,
            Self::Ahead => Self::Ahead,
        }
    }
}

/// The way through a junction: table 2 of the paper, and of a star the ways by number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Turn {
    Straight,
    Right,
    Left,
    /// Beyond the paper, at a star: the n-th way counted from the right, from 1 on.
    Nth(u8),
}

impl Turn {
    /// Those of the paper.
    pub const ALL: [Self; 3] = [Self::Straight, Self::Right, Self::Left];

    /// The paper's code: 0, 1, 2; for the ways of a star 3 and on.
    #[must_use]
    pub fn code(self) -> u8 {
        match self {
            Self::Straight => 0,
            Self::Right => 1,
            Self::Left => 2,
            Self::Nth(n) => n.saturating_add(2),
        }
    }
}

/// What a junction looks like to one who comes to it: codes 1 to 6 of table 1, and beyond the paper a star.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum JunctionKind {
    Crossing,
    Tee,
    BranchRight,
    BranchLeft,
    TurnRight,
    TurnLeft,
    /// Beyond the paper: so many ways on, four or more. The robot counts them from the right.
    Star(u8),
}

impl JunctionKind {
    /// Those of the paper.
    pub const ALL: [Self; 6] = [
        Self::Crossing,
        Self::Tee,
        Self::BranchRight,
        Self::BranchLeft,
        Self::TurnRight,
        Self::TurnLeft,
    ];

    /// The paper's code: 1 to 6; 7 for a star.
    #[must_use]
    pub fn code(self) -> u8 {
        match self {
            Self::Crossing => 1,
            Self::Tee => 2,
            Self::BranchRight => 3,
            Self::BranchLeft => 4,
            Self::TurnRight => 5,
            Self::TurnLeft => 6,
            Self::Star(_) => 7,
        }
    }

    /// The ways on, in the order of their codes.
    #[must_use]
    pub fn ways(self) -> Cow<'static, [Turn]> {
        Cow::Borrowed(match self {
            Self::Crossing => &[Turn::Straight, Turn::Right, Turn::Left],
            Self::Tee => &[Turn::Right, Turn::Left],
            Self::BranchRight => &[Turn::Straight, Turn::Right],
            Self::BranchLeft => &[Turn::Straight, Turn::Left],
            Self::TurnRight => &[Turn::Right],
            Self::TurnLeft => &[Turn::Left],
            Self::Star(ways) => return (1..=ways).map(Turn::Nth).collect(),
        })
    }

    fn with_ways(ways: &[Turn]) -> Option<Self> {
        let star = u8::try_from(ways.len()).ok().filter(|_| ways.len() > 3).map(Self::Star);
        Self::ALL.into_iter().chain(star).find(|kind| *kind.ways() == *ways)
    }
}

/// What stands at the end of an arc: table 1 of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ArcCode {
    Junction(JunctionKind),
    Door(Side),
}

impl ArcCode {
    /// 1 to 7 for junctions, 11 and 12 for doors on the right and on the left; beyond the paper, 13 for a door
    /// straight ahead.
    #[must_use]
    pub fn number(self) -> u8 {
        match self {
            Self::Junction(kind) => kind.code(),
            Self::Door(Side::Right) => 11,
            Self::Door(Side::Left) => 12,
            Self::Door(Side::Ahead) => 13,
        }
    }
}

/// The way into a room.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entrance {
    /// «201»
    pub room: String,
    /// English name of the room; empty where the number serves both languages.
    pub room_en: String,
    /// For one who drives from port 0 to port 1.
    pub side: Side,
}

/// A place where corridors meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Junction {
    /// Direction in which each arm leaves, by port. Only the angles between arms have a meaning.
    /// An arm without a stretch is blind: it can be seen, but has no entrance to drive to.
    pub arms: Vec<Deg>,
}

impl Junction {
    /// The ways on for one who comes out of the arm `from`: the arm and the turn into it, in the order of turns.
    ///
    /// Two arms that point much the same way are told apart by their order: the straighter one is «straight».
    #[must_use]
    pub fn ways(&self, from: usize) -> Vec<(usize, Turn)> {
        let heading = self.arms[from] + Deg::of(180.0);
        let mut others: Vec<(f64, usize)> = (0..self.arms.len())
            .filter(|&arm| arm != from)
            .map(|arm| ((self.arms[arm] - heading).signed(), arm))
            .collect();
        others.order_by(|a, b| a.0.total_cmp(&b.0));
        let turns = turns_of(&others.iter().map(|(angle, _)| *angle).collect::<Vec<_>>());
        let mut ways: Vec<_> = others.iter().map(|(_, arm)| *arm).zip(turns).collect();
        ways.order_by_key(|(_, turn)| *turn);
        ways
    }
}

/// Names for the ways on; their angles to the heading rise, from rightmost to leftmost. More than three are counted.
fn turns_of(angles: &[f64]) -> Vec<Turn> {
    match *angles {
        [only] if only < 0.0 => vec![Turn::Right],
        [_] => vec![Turn::Left],
        [a, b] if a < -45.0 && b > 45.0 => vec![Turn::Right, Turn::Left],
        [a, b] if a.abs() <= b.abs() => vec![Turn::Straight, Turn::Left],
        [_, _] => vec![Turn::Right, Turn::Straight],
        [_, _, _] => vec![Turn::Right, Turn::Straight, Turn::Left],
        ref many => (1..=u8::MAX).map(Turn::Nth).take(many.len()).collect(),
    }
}

#[derive(Debug, Clone, PartialEq)]
pub enum VertexKind {
    /// Port 0 looks back along the corridor, port 1 forth.
    Entrance(Entrance),
    Junction(Junction),
}

/// A vertex of the road graph: an entrance or a junction.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertex {
    /// The number by which people call it; unique.
    pub number: u32,
    pub kind: VertexKind,
    /// Name of the floor; empty in a description of one floor.
    pub floor: String,
    /// Where it is, when a Map says so.
    pub at: Option<Point>,
}

impl Vertex {
    #[must_use]
    pub fn entrance(&self) -> Option<&Entrance> {
        match &self.kind {
            VertexKind::Entrance(entrance) => Some(entrance),
            VertexKind::Junction(_) => None,
        }
    }

    #[must_use]
    pub fn junction(&self) -> Option<&Junction> {
        match &self.kind {
            VertexKind::Junction(junction) => Some(junction),
            VertexKind::Entrance(_) => None,
        }
    }

    pub(super) fn port_count(&self) -> usize {
        self.junction().map_or(2, |j| j.arms.len())
    }
}

/// One end of a stretch of corridor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Port {
    pub vertex: VertexIx,
    pub port: usize,
}

/// A piece of corridor between two vertices with none between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    pub ends: [Port; 2],
    /// Known from a Map or from the description.
    pub length: Option<Cm>,
}

/// What an arc costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Measure {
    /// One per arc, as the paper has it.
    #[default]
    Arcs,
    /// The stretch's length.
    Metres,
}

/// Weights for Dijkstra's algorithm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    pub measure: Measure,
    /// What turning round costs: arcs or metres, as [`Self::measure`] says.
    pub u_turn: f64,
}

impl Default for Weights {
    fn default() -> Self {
        Self { measure: Measure::Arcs, u_turn: 1.0 }
    }
}

/// Corridors with their entrances and junctions, on one floor or on several.
#[derive(Debug, Clone, PartialEq)]
pub struct CorridorSystem {
    pub name: String,
    pub name_en: String,
    pub weights: Weights,
    vertices: Vec<Vertex>,
    stretches: Vec<Stretch>,
    /// By vertex and port: the arc that leaves there.
    departures: Vec<Vec<Option<ArcIx>>>,
}

impl CorridorSystem {
    /// Joins checked parts; the callers keep the invariant.
    pub(super) fn assemble(name: String, vertices: Vec<Vertex>, stretches: Vec<Stretch>) -> Self {
        let mut departures: Vec<_> = vertices.iter().map(|v| vec![None; v.port_count()]).collect();
        for (index, stretch) in stretches.iter().enumerate() {
            for (way, end) in stretch.ends.iter().enumerate() {
                departures[end.vertex.0][end.port] = Some(ArcIx(2 * index + way));
            }
        }
        let weights = Weights::default();
        Self { name, name_en: String::new(), weights, vertices, stretches, departures }
    }

    /// All vertices, in the order of their indices.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = (VertexIx, &Vertex)> + '_ {
        self.vertices.iter().enumerate().map(|(i, v)| (VertexIx(i), v))
    }

    #[must_use]
    pub fn vertex(&self, index: VertexIx) -> &Vertex {
        &self.vertices[index.0]
    }

    #[must_use]
    pub fn numbered(&self, number: u32) -> Option<VertexIx> {
        self.vertices.iter().position(|v| v.number == number).map(VertexIx)
    }

    #[must_use]
    pub fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// Every arc: both ways of every stretch.
    pub fn arcs(&self) -> impl ExactSizeIterator<Item = ArcIx> + use<> {
        (0..2 * self.stretches.len()).map(ArcIx)
    }

    /// Where an arc starts.
    #[must_use]
    pub fn tail(&self, arc: ArcIx) -> Port {
        self.stretches[arc.stretch()].ends[arc.0 % 2]
    }

    /// Where an arc ends.
    #[must_use]
    pub fn head(&self, arc: ArcIx) -> Port {
        self.tail(arc.reversed())
    }

    /// The arc between two vertices; the first where several corridors join them.
    #[must_use]
    pub fn arc_between(&self, from: VertexIx, to: VertexIx) -> Option<ArcIx> {
        self.departures(from).find(|&arc| self.head(arc).vertex == to)
    }

    /// The arc that leaves through a port.
    #[must_use]
    pub fn departure(&self, vertex: VertexIx, port: usize) -> Option<ArcIx> {
        self.departures[vertex.0][port]
    }

    /// The arcs that leave a vertex, by port.
    pub fn departures(&self, vertex: VertexIx) -> impl Iterator<Item = ArcIx> + '_ {
        self.departures[vertex.0].iter().flatten().copied()
    }

    /// What the robot sees at the end of an arc.
    #[must_use]
    pub fn code(&self, arc: ArcIx) -> ArcCode {
        let Port { vertex, port } = self.head(arc);
        match &self.vertex(vertex).kind {
            VertexKind::Entrance(entrance) => ArcCode::Door(side_seen(entrance, port)),
            VertexKind::Junction(junction) => {
                let ways: Vec<Turn> = junction.ways(port).iter().map(|(_, turn)| *turn).collect();
                let kind = JunctionKind::with_ways(&ways);
                ArcCode::Junction(kind.expect("a junction has at most 255 ways on, all different"))
            }
        }
    }

    /// The arcs on which the robot can go on without turning round, and how: in the order of the turns.
    #[must_use]
    pub fn successors(&self, arc: ArcIx) -> Vec<(ArcIx, Turn)> {
        let Port { vertex, port } = self.head(arc);
        let ways = match &self.vertex(vertex).kind {
            VertexKind::Entrance(_) => vec![(1 - port, Turn::Straight)],
            VertexKind::Junction(junction) => junction.ways(port),
        };
        ways.into_iter()
            .filter_map(|(port, turn)| Some((self.departure(vertex, port)?, turn)))
            .collect()
    }

    /// The vertices whose room bears this name, in either language.
    #[must_use]
    pub fn entrances_of(&self, room: &str) -> Vec<VertexIx> {
        let key = crate::units::name_key(room);
        let bears = |name: &str| !name.is_empty() && crate::units::name_key(name) == key;
        self.vertices()
            .filter(|(_, v)| v.entrance().is_some_and(|e| bears(&e.room) || bears(&e.room_en)))
            .map(|(index, _)| index)
            .collect()
    }

    /// Panics where the invariant of this file does not hold; for tests.
    #[doc(hidden)]
    pub fn check_invariants(&self) {
        let mut held = std::collections::BTreeSet::new();
        for end in self.stretches.iter().flat_map(|s| s.ends) {
            assert!(end.port < self.vertex(end.vertex).port_count(), "{end:?} is no port");
            assert!(held.insert(end), "{end:?} holds two stretches");
        }
        let numbers: std::collections::BTreeSet<_> =
            self.vertices.iter().map(|v| v.number).gather();
        assert_eq!(numbers.len(), self.vertices.len(), "a number stands for two vertices");
        for arc in self.arcs() {
            let _ = self.code(arc);
        }
    }
}

/// The side of an entrance for one who comes to it through `port`.
pub(super) fn side_seen(entrance: &Entrance, port: usize) -> Side {
    if port == 0 { entrance.side } else { entrance.side.opposite() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(arms: &[f64], from: usize) -> Option<JunctionKind> {
        let junction = Junction { arms: arms.iter().map(|a| Deg::of(*a)).collect() };
        let ways: Vec<_> = junction.ways(from).iter().map(|(_, turn)| *turn).collect();
        JunctionKind::with_ways(&ways)
    }

    #[test]
    fn one_tee_has_three_faces() {
        let arms = [180.0, 0.0, 270.0]; // back, on, to the right
        assert_eq!(seen(&arms, 0), Some(JunctionKind::BranchRight));
        assert_eq!(seen(&arms, 1), Some(JunctionKind::BranchLeft));
        assert_eq!(seen(&arms, 2), Some(JunctionKind::Tee));
    }

    #[test]
    fn kinds_do_not_depend_on_the_frame() {
        for turned in [0.0, 17.3, 90.0, 211.0] {
            let arms = [180.0, 0.0, 270.0, 90.0].map(|a| a + turned);
            assert!((0..4).all(|from| seen(&arms, from) == Some(JunctionKind::Crossing)));
            assert_eq!(seen(&[180.0 + turned, 90.0 + turned], 0), Some(JunctionKind::TurnLeft));
            assert_eq!(seen(&[180.0 + turned, 90.0 + turned], 1), Some(JunctionKind::TurnRight));
        }
    }

    #[test]
    fn a_star_of_three_is_a_tee_from_everywhere() {
        for from in 0..3 {
            assert_eq!(seen(&[0.0, 120.0, 240.0], from), Some(JunctionKind::Tee));
        }
    }

    #[test]
    fn more_than_three_ways_on_are_counted_from_the_right() {
        for arms in [5, 6, 9] {
            for turned in [0.0, 31.0] {
                let angle = |arm: usize| turned + 360.0 * arm as f64 / arms as f64;
                let all: Vec<f64> = (0..arms).map(angle).collect();
                let star = Junction { arms: all.iter().map(|a| Deg::of(*a)).collect() };
                for from in 0..arms {
                    assert_eq!(seen(&all, from), Some(JunctionKind::Star(arms as u8 - 1)));
                    // Counter-clockwise from the arm that one comes out of, the first is the rightmost.
                    let counted = (1..arms).map(|n| ((from + n) % arms, Turn::Nth(n as u8)));
                    assert_eq!(star.ways(from), counted.collect::<Vec<_>>());
                }
            }
        }
    }

    #[test]
    fn codes_are_those_of_the_tables() {
        assert_eq!(JunctionKind::ALL.map(JunctionKind::code), [1, 2, 3, 4, 5, 6]);
        assert_eq!(Turn::ALL.map(Turn::code), [0, 1, 2]);
        assert_eq!(JunctionKind::Star(4).code(), 7);
        assert_eq!(ArcCode::Door(Side::Right).number(), 11);
        assert_eq!(ArcCode::Door(Side::Left).number(), 12);
    }
}
