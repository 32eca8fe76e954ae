//! The map in other programs' formats: a map file, GeoJSON, occupancy grids, masks, route graphs, surfaces, records, SQL
//! tables.

mod geojson;
mod grid;
mod masks;
mod mesh;
mod nav2;
mod notation;
mod records;
#[cfg(feature = "sqlite")]
mod sqlite;

pub use geojson::to_geojson;
pub use grid::{Cell, Grid, GridFiles, MOST_CELLS, to_grid};
pub use masks::{Mask, to_masks};
pub use mesh::to_passframe_mesh;
pub use nav2::{to_route_graph, to_route_graph_of_all};
pub use notation::to_map_file;
pub use records::to_records;
#[cfg(feature = "sqlite")]
pub use sqlite::{SqliteError, read_sqlite, write_sqlite};

use crate::units::Point;

/// cm → metres, to the hundredth of a millimetre.
fn metres(p: Point) -> [f64; 2] {
    [metre(p.x), metre(p.y)]
}

fn metre(cm: f64) -> f64 {
    (cm * 1000.0).round() / 100_000.0 + 0.0
}

/// A ring of GeoJSON: closed, counter-clockwise as it is given.
fn ring(points: impl Iterator<Item = Point>) -> Vec<[f64; 2]> {
    let mut ring: Vec<[f64; 2]> = points.map(metres).collect();
    ring.extend(ring.first().copied());
    ring
}
