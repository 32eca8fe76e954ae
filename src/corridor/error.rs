//! What can be wrong with a question about the way.

use crate::units::Bilingual;

/// Why there are no directions.
#[derive(Debug, Clone, PartialEq, Eq, crate::units::Fault)]
#[fault(corridor)]
#[non_exhaustive]
pub enum CorridorError {
    UnknownRoom { room: String, hint: Bilingual },

    UnknownVertex { vertex: String, known: String },

    SeveralEntrances { room: String, vertices: String, example: u32 },

    UnknownArc { from: u32, to: u32, neighbours: String },

    LastArcElsewhere { vertex: u32, from: u32, to: u32 },

    Unreachable { from: String, to: String, hint: Bilingual },

    AtJunction { vertex: u32 },

    HeadingNeeded { vertex: u32 },

    GoalIsJunction { vertex: u32 },

    NoLength { from: u32, to: u32 },

    UnknownMap { map: u32 },

    NoCorridors { name: String },
}
