//! Drawings as SVG (SPEC M12): the plan of a Map with furniture, free floor, Passframes and routes; a road graph.
//!
//! A drawing is built from plain geometry, so that every layer can be drawn without the others. Coordinates
//! are the Map's, in cm, y up; [`canvas`](self) turns them over, since SVG counts y downwards.
//!
//! **Invariant.** The same input gives the same bytes.

mod canvas;
mod corridor;
mod plan;

pub use corridor::{CorridorArc, CorridorDrawing, CorridorMark, CorridorVertex, corridor_svg};
pub use plan::{DoorGlyph, FloorLayer, PlanDrawing, RouteLayer};
