//! SVG of maps, objects, Passframes, routes and road graphs.

mod corridor;

pub use corridor::{CorridorArc, CorridorDrawing, CorridorMark, CorridorVertex, corridor_svg};
