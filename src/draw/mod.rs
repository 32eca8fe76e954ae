//! Drawings as SVG and PNG (SPEC M12): the plan of a Map or Fragment with furniture, free floor, Passframes, their network
//! and routes; an Object from three sides; the view from a pose; a road graph; seen
//! segments and the tree of a hierarchical map.
//!
//! A drawing is built from plain geometry, so that every layer can be drawn without the others. Coordinates
//! are the Map's, in cm, y up; the sheet turns them over, since SVG counts y downwards.
//!
//! **Invariant.** The same input gives the same bytes.
//!
//! # Invariants
//!
//! The same input gives the same bytes, whatever fonts a machine has: every drawing carries its own. No two names
//! on a plan or a road graph overlap, none is cut, and none is set smaller than can be read at the size of the
//! sheet; every sign of a plan stands in its legend; one that finds no place is told by its number in a list, or
//! left out. The order of faces in a view is exact (a binary space partition), not by distance.

use orthoframe_geometry as geometry;
use orthoframe_map as map;
use orthoframe_units as units;

orthoframe_units::messages!("../../rules/messages", "draw", PngError);

mod canvas;
mod corridor;
mod error;
mod font;
mod furniture;
mod labels;
mod legend;
#[cfg(feature = "pictures")]
mod letters;
mod object;
#[cfg(feature = "pictures")]
mod picture;
mod plan;
mod rooms;
mod seen;
mod sight;
mod standing;
mod tree;
mod view;
mod zones;

pub use corridor::{
    CorridorArc, CorridorDrawing, CorridorMark, CorridorSign, CorridorVertex, corridor_svg,
};
pub use error::PngError;
pub use font::text_width;
pub use object::object_svg;
#[cfg(feature = "pictures")]
pub use picture::png;
pub use plan::{DoorGlyph, FloorLayer, NetworkLayer, PlanDrawing, RouteLayer, ViewLayer};
pub use seen::{SeenDrawing, SeenSegment, SeenSign, seen_svg};
pub use sight::{SightDrawing, SightLine, SightSign, beside, sight_svg};
pub use standing::outer_doors;
pub use tree::{TreeNode, tree_svg};
pub use view::{LeafBody, Mouth, ViewDrawing};
pub use zones::ZoneGlyph;
