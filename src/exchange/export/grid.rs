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

/// What is known of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    Free,
    Occupied,
    Unknown,
}

impl Cell {
    /// Its grey in the picture of a map_server in mode trinary.
    fn grey(self) -> u8 {
        match self {
            Self::Free => 254,
            Self::Occupied => 0,
            Self::Unknown => 205,
        }
    }
}

/// A floor cut into cells, in its Map's own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid<Value = Cell> {
    /// The corner of the first cell, and the size of each; cm.
    pub low: Point,
    pub cell: f64,
    pub width: usize,
    pub height: usize,
    /// Row by row upwards, `width` in each.
    pub cells: Vec<Value>,
}

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
    let grid = Grid::of_floor(plan, cell)?;
    let name = world.maps[&plan.map()].key.clone();
    Some(grid.into_files(name))
}

/// The strip along the right of an edge: outside of a counter-clockwise polygon.
fn beside(a: Point, b: Point, width: f64) -> Polygon {
    let along = (b - a).try_normalize(1e-9).unwrap_or_default() * width;
    let out = crate::units::Vector::new(along.y, -along.x);
    // Longer by its width at both ends, so that corners are shut.
    let (a, b) = (a - along, b + along);
    Polygon::new(vec![a + out, b + out, b, a])
}

impl Grid {
    /// What lies in a room or doorway is free where nothing of the robot's height stands. None when it would have more
    /// than [`MOST_CELLS`] cells, or there is no floor at all.
    ///
    /// # Panics
    /// When the plan is not of this world.
    #[must_use]
    pub fn of_floor(plan: &FloorPlan, cell: f64) -> Option<Self> {
        let mut grid = Self::of_rooms(plan, cell)?;
        for fragment in plan.fragments() {
            for obstacle in fragment.obstacles() {
                if !matches!(
                    obstacle.blocker,
                    Blocker::DoorLeaf { .. } | Blocker::Wall { .. } | Blocker::Zone { .. }
                ) {
                    grid.fill(&obstacle.polygon, Cell::Occupied);
                }
            }
        }
        Some(grid)
    }

    /// What a laser at a height above the Map's zero meets, in cm: walls, and things that stand there at that height.
    /// None as of [`Grid::of_floor`].
    #[must_use]
    pub fn of_laser(plan: &FloorPlan, cell: f64, height: f64) -> Option<Self> {
        let mut grid = Self::of_rooms(plan, cell)?;
        for prism in plan.scene().replicas.values().flat_map(|placed| &placed.prisms) {
            if prism.bottom <= height && height < prism.top {
                grid.fill(&prism.section(height).counter_clockwise(), Cell::Occupied);
            }
        }
        Some(grid)
    }

    /// Rooms and doorways without what stands in them.
    fn of_rooms(plan: &FloorPlan, cell: f64) -> Option<Self> {
        let mut grid = Self::blank(plan, cell, Cell::Unknown)?;
        let floors = || plan.scene().areas.values().flat_map(|area| &area.prisms);
        for prism in floors() {
            for (a, b) in prism.polygon.edges() {
                grid.fill(&beside(a, b, WALL), Cell::Occupied);
            }
        }
        for prism in floors() {
            grid.fill(&prism.polygon, Cell::Free);
        }
        for fragment in plan.fragments() {
            for (a, b) in &fragment.walls {
                grid.line(*a, *b, Cell::Occupied);
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
            grid.fill(&Polygon::new(corners).counter_clockwise(), Cell::Free);
        }
        Some(grid)
    }

    /// The two files of a map_server.
    #[must_use]
    pub fn into_files(self, name: String) -> GridFiles {
        GridFiles { yaml: self.yaml(&name, "trinary"), pgm: self.to_pgm(Cell::grey), name }
    }
}

impl<Value: Copy> Grid<Value> {
    /// Cells of one kind that cover a floor, as those of its other grids do.
    pub(super) fn blank(plan: &FloorPlan, cell: f64, with: Value) -> Option<Self> {
        let floors = plan.scene().areas.values().flat_map(|area| &area.prisms);
        let bounds = Bounds::of(floors.flat_map(|p| p.polygon.corners.iter().copied()));
        let bounds = bounds.grown(MARGIN);
        let size = bounds.max - bounds.min;
        let fits = size.x.is_finite()
            && cell > 0.0
            && (size.x / cell) * (size.y / cell) < MOST_CELLS as f64;
        if !fits {
            return None;
        }
        // Whole cells from the origin, so that walls at round places stay sharp.
        let low =
            Point::new((bounds.min.x / cell).floor() * cell, (bounds.min.y / cell).floor() * cell);
        let count = |x: f64| (x / cell).ceil() as usize + 1;
        let (width, height) = (count(size.x), count(size.y));
        Some(Self { low, cell, width, height, cells: vec![with; width * height] })
    }

    /// The text of a map_server's file beside the picture `name.pgm`.
    pub(super) fn yaml(&self, name: &str, mode: &str) -> String {
        let [x, y, cell] = [self.low.x, self.low.y, self.cell].map(metre);
        format!(
            "image: {name}.pgm\nmode: {mode}\nresolution: {cell}\norigin: [{x}, {y}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        )
    }

    /// Paints the cells whose middles lie in a polygon.
    pub(super) fn fill(&mut self, polygon: &Polygon, with: Value) {
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
                self.cells[y * self.width + from..y * self.width + to.max(from)].fill(with);
            }
        }
    }

    /// Paints the cells that a segment passes through, as points half a cell apart.
    fn line(&mut self, a: Point, b: Point, with: Value) {
        let steps = ((b - a).norm() / self.cell * 2.0).ceil().max(1.0);
        for step in 0..=steps as usize {
            let p = (a + (b - a) * (step as f64 / steps) - self.low) / self.cell;
            let (x, y) = (p.x.floor(), p.y.floor());
            if x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64 {
                self.cells[y as usize * self.width + x as usize] = with;
            }
        }
    }

    /// The picture, by the grey of each cell.
    pub(super) fn to_pgm(&self, grey: impl Fn(Value) -> u8) -> Vec<u8> {
        let mut out = format!("P5\n{} {}\n255\n", self.width, self.height).into_bytes();
        for row in self.cells.chunks_exact(self.width).rev() {
            out.extend(row.iter().map(|cell| grey(*cell)));
        }
        out
    }
}
