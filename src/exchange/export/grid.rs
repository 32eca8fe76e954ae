//! A floor as ROS map_server has it: a PGM picture of what is free, occupied, unknown, and its YAML file.
//!
//! Free is what lies in a room or doorway and under no obstacle of the robot's height, dead zones included: the
//! navigation of the reader's robot decides for itself where it fits. Doors count as open, for the picture cannot
//! change. Walls are drawn along the rooms' borders; what lies between two rooms is wall when it is no thicker than a
//! thick wall, else unknown.

use crate::geometry::{Blocker, Bounds, FloorPlan, Polygon};
use crate::map::World;
use crate::units::Point;

use super::metre;

/// A picture larger than this is refused: four hundred metres square at 5 cm.
pub const MOST_CELLS: usize = 64_000_000;
/// cm around the outermost walls.
const MARGIN: f64 = 50.0;
/// cm. A wall is drawn this far out of its room.
const WALL: f64 = 10.0;

const FREE: u8 = 254;
const UNKNOWN: u8 = 205;
const OCCUPIED: u8 = 0;

/// The two files of a floor.
#[derive(Debug, Clone, PartialEq)]
pub struct GridFiles {
    /// The map's key: name of both files without ending.
    pub name: String,
    pub yaml: String,
    pub pgm: Vec<u8>,
}

/// The grid of a floor in its Map's own frame; `cell` is a cell's size in cm. None when it would have more than
/// [`MOST_CELLS`], or no floor at all.
///
/// # Panics
/// When the plan is not of this world.
#[must_use]
pub fn to_grid(world: &World, plan: &FloorPlan, cell: f64) -> Option<GridFiles> {
    let scene = plan.scene();
    let floors = || scene.areas.values().flat_map(|a| &a.prisms);
    let bounds = Bounds::of(floors().flat_map(|p| p.polygon.corners.iter().copied()));
    let bounds = bounds.grown(MARGIN);
    let size = bounds.max - bounds.min;
    let fits =
        size.x.is_finite() && cell > 0.0 && (size.x / cell) * (size.y / cell) < MOST_CELLS as f64;
    if !fits {
        return None;
    }
    // Whole cells from the origin, so that walls at round places stay sharp.
    let low =
        Point::new((bounds.min.x / cell).floor() * cell, (bounds.min.y / cell).floor() * cell);
    let cells = |x: f64| (x / cell).ceil() as usize + 1;
    let mut raster = Raster {
        low,
        cell,
        width: cells(size.x),
        height: cells(size.y),
        pixels: vec![UNKNOWN; cells(size.x) * cells(size.y)],
    };
    for prism in floors() {
        for (a, b) in prism.polygon.edges() {
            raster.fill(&beside(a, b, WALL), OCCUPIED);
        }
    }
    for prism in floors() {
        raster.fill(&prism.polygon, FREE);
    }
    for fragment in plan.fragments() {
        for (a, b) in &fragment.walls {
            raster.line(*a, *b, OCCUPIED);
        }
    }
    for doorway in plan.doorways() {
        let (t0, t1) = doorway.span();
        // From within one room to within the other, over whatever wall was drawn between them.
        let (from, to) = (-cell, doorway.gap + cell);
        let corners = vec![
            doorway.at(t0, from),
            doorway.at(t0, to),
            doorway.at(t1, to),
            doorway.at(t1, from),
        ];
        raster.fill(&Polygon::new(corners).counter_clockwise(), FREE);
    }
    for fragment in plan.fragments() {
        for obstacle in fragment.obstacles() {
            if !matches!(
                obstacle.blocker,
                Blocker::DoorLeaf { .. } | Blocker::Wall { .. } | Blocker::Zone { .. }
            ) {
                raster.fill(&obstacle.polygon, OCCUPIED);
            }
        }
    }
    let name = world.maps[&plan.map()].key.clone();
    let yaml = format!(
        "image: {name}.pgm\nmode: trinary\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        metre(cell),
        metre(low.x),
        metre(low.y)
    );
    Some(GridFiles { name, yaml, pgm: raster.to_pgm() })
}

/// The strip along the right of an edge: outside of a counter-clockwise polygon.
fn beside(a: Point, b: Point, width: f64) -> Polygon {
    let along = (b - a).try_normalize(1e-9).unwrap_or_default() * width;
    let out = crate::units::Vector::new(along.y, -along.x);
    // Longer by its width at both ends, so that corners are shut.
    let (a, b) = (a - along, b + along);
    Polygon::new(vec![a + out, b + out, b, a])
}

struct Raster {
    low: Point,
    cell: f64,
    width: usize,
    height: usize,
    /// Rows run upwards.
    pixels: Vec<u8>,
}

impl Raster {
    /// Paints the cells whose middles lie in a polygon.
    fn fill(&mut self, polygon: &Polygon, with: u8) {
        let bounds = polygon.bounds();
        let row = |y: f64| {
            ((y - self.low.y) / self.cell - 0.5).ceil().clamp(0.0, self.height as f64) as usize
        };
        let mut crossings: Vec<f64> = Vec::new();
        for y in row(bounds.min.y)..row(bounds.max.y) {
            let middle = self.low.y + (y as f64 + 0.5) * self.cell;
            crossings.clear();
            crossings.extend(
                polygon
                    .edges()
                    .filter(|(a, b)| (a.y > middle) != (b.y > middle))
                    .map(|(a, b)| a.x + (b.x - a.x) * (middle - a.y) / (b.y - a.y)),
            );
            crossings.sort_by(f64::total_cmp);
            for span in crossings.chunks_exact(2) {
                let column = |x: f64| {
                    let at = ((x - self.low.x) / self.cell - 0.5).ceil();
                    at.clamp(0.0, self.width as f64) as usize
                };
                let (from, to) = (column(span[0]), column(span[1]));
                self.pixels[y * self.width + from..y * self.width + to.max(from)].fill(with);
            }
        }
    }

    /// Paints the cells that a segment passes through, as points half a cell apart.
    fn line(&mut self, a: Point, b: Point, with: u8) {
        let steps = ((b - a).norm() / self.cell * 2.0).ceil().max(1.0);
        for step in 0..=steps as usize {
            let p = (a + (b - a) * (step as f64 / steps) - self.low) / self.cell;
            let (x, y) = (p.x.floor(), p.y.floor());
            if x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64 {
                self.pixels[y as usize * self.width + x as usize] = with;
            }
        }
    }

    fn to_pgm(&self) -> Vec<u8> {
        let mut out = format!("P5\n{} {}\n255\n", self.width, self.height).into_bytes();
        for row in self.pixels.chunks_exact(self.width).rev() {
            out.extend(row);
        }
        out
    }
}
