//! Convex cells and the edges between them: what a search walks over.

use crate::units::Point;

/// Cells of all Fragments: Fragment, cell.
pub(super) type CellKey = (u32, u32);

/// A piece of centre space that hangs together within its Fragment: Fragment, component.
pub(super) type Piece = (u32, u32);

/// What the search walks over.
pub(super) trait Cells {
    /// Adds the edges of a cell that do not lead back to `from`, counter-clockwise, each with the cell behind it.
    fn edges(&self, cell: CellKey, from: Option<CellKey>, found: &mut Vec<Edge>);

    /// The only edge of a cell that does not lead back to `from`, where that is told at once.
    fn only_edge(&self, cell: CellKey, from: CellKey) -> Option<Edge>;
}

/// A stretch of a cell's border that leads into another cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Seen from inside the cell, `right` comes first counter-clockwise.
    pub(super) right: Point,
    pub(super) left: Point,
    /// Whether a way may bend there.
    pub(super) right_bends: bool,
    pub(super) left_bends: bool,
    pub(super) to: CellKey,
}

/// Twice the area of a triangle; positive where `c` lies to the left of the line from `a` to `b`.
pub(super) fn side(a: Point, b: Point, c: Point) -> f64 {
    (b - a).perp(&(c - a))
}
