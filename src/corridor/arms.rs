//! Which stretch leaves a junction of the corridor file on which hand.
//!
//! The corridors say which stretches meet; the declared kind says which ways there are, as seen from one of
//! them. What is not named follows where only one choice is left; everything else is a fault.

use std::collections::BTreeMap;

use miette::SourceSpan;

use crate::units::{Bilingual, Deg, said};

use super::fault::CorridorFault;
use super::system::{Junction, JunctionKind, Port, Stretch, Turn, VertexIx};
use super::words::{kind_word, turn_word};

/// One end of a stretch: which stretch, which of its two ends.
type End = (usize, usize);

/// What a stop's `junction` says, seen by one who comes along the corridor.
#[derive(Debug, Clone)]
pub(super) struct Declared {
    pub(super) kind: JunctionKind,
    pub(super) at: SourceSpan,
    /// Neighbour by turn, where the file names it.
    pub(super) neighbours: Vec<(Turn, i64, SourceSpan)>,
    pub(super) blind: Vec<(Turn, SourceSpan)>,
}

/// A declaration together with where it was made from.
#[derive(Debug, Clone)]
struct Seen {
    declared: Declared,
    /// The end by which the corridor comes to the junction.
    back: End,
    /// The end by which the same corridor goes on.
    on: Option<End>,
}

/// The stretches laid so far, and what is said of the junctions.
#[derive(Debug)]
pub(super) struct Layout {
    stretches: Vec<Stretch>,
    /// By vertex, in the order of the text.
    ends: Vec<Vec<End>>,
    seen: BTreeMap<VertexIx, Vec<Seen>>,
}

impl Layout {
    pub(super) fn new(vertices: usize) -> Self {
        Self { stretches: Vec::new(), ends: vec![Vec::new(); vertices], seen: BTreeMap::new() }
    }

    pub(super) fn add(&mut self, stretch: Stretch) -> usize {
        let index = self.stretches.len();
        for (end, port) in stretch.ends.iter().enumerate() {
            self.ends[port.vertex.0].push((index, end));
        }
        self.stretches.push(stretch);
        index
    }

    pub(super) fn declare(
        &mut self,
        vertex: VertexIx,
        declared: Declared,
        back: End,
        on: Option<End>,
    ) {
        self.seen.entry(vertex).or_default().push(Seen { declared, back, on });
    }

    pub(super) fn degree(&self, vertex: VertexIx) -> usize {
        self.ends[vertex.0].len()
    }

    pub(super) fn into_stretches(self) -> Vec<Stretch> {
        self.stretches
    }

    /// Gives every stretch of a junction its port, and the junction its arms.
    ///
    /// The first declaration tells the arms, the others must agree with it.
    pub(super) fn assign_ports(
        &mut self,
        vertex: VertexIx,
        number: u32,
        faults: &mut Vec<CorridorFault>,
        number_of: impl Fn(VertexIx) -> u32,
    ) -> Junction {
        let none = Junction { arms: Vec::new() };
        let Some(all) = self.seen.get(&vertex).cloned() else { return none };
        let (first, others) = all.split_first().expect("a vertex that was seen was seen once");
        let neighbour = |end: &End| number_of(self.far(*end).vertex);
        let mut work =
            Assignment { number, ends: &self.ends[vertex.0], neighbour: &neighbour, faults };
        let Some(arms) = work.arms(first) else { return none };
        // The way back is the arm at 180°.
        let angle = |turn: Option<Turn>| match turn {
            None => 180.0,
            // A file tells of the paper's ways alone.
            Some(Turn::Straight | Turn::Nth(_)) => 0.0,
            Some(Turn::Right) => 270.0,
            Some(Turn::Left) => 90.0,
        };
        let junction =
            Junction { arms: arms.iter().map(|(turn, _)| Deg::of(angle(*turn))).collect() };
        for other in others {
            work.compare(&junction, &arms, first, other);
        }
        for (port, (_, end)) in arms.iter().enumerate() {
            if let Some((stretch, end)) = *end {
                self.stretches[stretch].ends[end].port = port;
            }
        }
        junction
    }

    fn far(&self, (stretch, end): End) -> Port {
        self.stretches[stretch].ends[1 - end]
    }
}

/// The arms of a junction: the turn into each (none for the way back) and its stretch (none for a blind one).
type Arms = Vec<(Option<Turn>, Option<End>)>;

struct Assignment<'a> {
    number: u32,
    ends: &'a [End],
    neighbour: &'a dyn Fn(&End) -> u32,
    faults: &'a mut Vec<CorridorFault>,
}

impl Assignment<'_> {
    fn arms(&mut self, seen: &Seen) -> Option<Arms> {
        let Declared { kind, at, neighbours, blind } = &seen.declared;
        let mut free: Vec<End> = self.ends.iter().copied().filter(|e| *e != seen.back).collect();
        let mut open: Vec<Turn> = kind.ways().into_owned();
        let mut arms: Arms = vec![(None, Some(seen.back))];
        for (turn, at) in blind {
            self.take(&mut open, *turn, *kind, *at)?;
            arms.push((Some(*turn), None));
        }
        for (turn, wanted, at) in neighbours {
            self.take(&mut open, *turn, *kind, *at)?;
            let fits: Vec<End> = free
                .iter()
                .copied()
                .filter(|e| i64::from((self.neighbour)(e)) == *wanted)
                .collect();
            let [end] = *fits else {
                let (vertex, neighbour, at) = (self.number, *wanted, *at);
                let neighbours = self.list(&free);
                self.faults.push(CorridorFault::NoSuchNeighbour {
                    vertex,
                    neighbour,
                    neighbours,
                    at,
                });
                return None;
            };
            free.retain(|e| *e != end);
            arms.push((Some(*turn), Some(end)));
        }
        if free.len() != open.len() {
            self.faults.push(CorridorFault::ArmsDisagree {
                vertex: self.number,
                kind: kind_word(*kind),
                wanted: kind.ways().len() + 1 - blind.len(),
                found: self.ends.len(),
                neighbours: self.list(self.ends),
                at: *at,
            });
            return None;
        }
        // A corridor goes straight on where it can.
        if let Some(on) = seen.on.filter(|on| free.contains(on))
            && open.contains(&Turn::Straight)
        {
            free.retain(|e| *e != on);
            open.retain(|t| *t != Turn::Straight);
            arms.push((Some(Turn::Straight), Some(on)));
        }
        match (free.as_slice(), open.as_slice()) {
            ([], []) => {}
            ([end], [turn]) => arms.push((Some(*turn), Some(*end))),
            _ => {
                let (vertex, neighbours) = (self.number, self.list(self.ends));
                self.faults.push(CorridorFault::AmbiguousArms { vertex, neighbours, at: *at });
                return None;
            }
        }
        Some(arms)
    }

    fn take(
        &mut self,
        open: &mut Vec<Turn>,
        turn: Turn,
        kind: JunctionKind,
        at: SourceSpan,
    ) -> Option<()> {
        if let Some(place) = open.iter().position(|t| *t == turn) {
            open.remove(place);
            return Some(());
        }
        let ways: Vec<_> = kind.ways().iter().map(|t| turn_word(*t)).collect();
        self.faults.push(CorridorFault::NoSuchWay {
            vertex: self.number,
            kind: kind_word(kind),
            way: turn_word(turn),
            ways: ways.join(", "),
            at,
        });
        None
    }

    /// Another description of a junction whose arms are told, from the same or from another corridor.
    fn compare(&mut self, junction: &Junction, arms: &Arms, first: &Seen, other: &Seen) {
        let Some(from) = arms.iter().position(|(_, end)| *end == Some(other.back)) else { return };
        let ways = junction.ways(from);
        let turns: Vec<Turn> = ways.iter().map(|(_, turn)| *turn).collect();
        if *other.declared.kind.ways() != *turns {
            let seen = JunctionKind::ALL.into_iter().find(|k| *k.ways() == *turns);
            self.faults.push(CorridorFault::JunctionDisagrees {
                vertex: self.number,
                said: kind_word(other.declared.kind),
                seen: seen.map_or("", kind_word),
                at: other.declared.at,
                first: first.declared.at,
            });
            return;
        }
        let said = other.declared.neighbours.iter().map(|(t, n, at)| (*t, Some(*n), *at));
        let blind = other.declared.blind.iter().map(|(t, at)| (*t, None, *at));
        for (turn, wanted, at) in said.chain(blind) {
            let end = ways.iter().find(|(_, t)| *t == turn).and_then(|(arm, _)| arms[*arm].1);
            let seen = end.as_ref().map(self.neighbour);
            if seen.map(i64::from) != wanted {
                self.faults.push(CorridorFault::WayDisagrees {
                    vertex: self.number,
                    way: turn_word(turn),
                    said: wanted.map_or_else(dead_end, |n| n.to_string().into()),
                    seen: seen.map_or_else(dead_end, |n| n.to_string().into()),
                    at,
                });
            }
        }
    }

    fn list(&self, ends: &[End]) -> Bilingual {
        let numbers: Vec<_> = ends.iter().map(|e| (self.neighbour)(e).to_string()).collect();
        if numbers.is_empty() { said!("no-numbers") } else { numbers.join(", ").into() }
    }
}

fn dead_end() -> Bilingual {
    said!("a-dead-end")
}
