//! A floor cut into convex cells (see [`super::half_edge`]), and what is needed to walk over it.
//!
//! **Invariant**: cells are convex and counter-clockwise, do not overlap, and fill the floor; where two share a
//! border, both have it as one edge with the same two corners.

use crate::units::{InOrder as _, Point};

use super::buckets::Buckets;
use super::grid::{Contour, Grid, Node, Region, Shapes, positive};
use super::half_edge::HalfEdges;
use super::kept_value::Kept;
use super::numbers::{Numbers, Part};
use super::on_demand::OnDemand;
use super::{Bounds, Polygon, nearest_on_segment};

/// No cell: the edge is a border of the floor.
pub(super) use super::numbers::NONE;

impl Kept for Mesh {
    fn put(&self, out: &mut Vec<u8>) {
        self.grid.put(out);
        self.nodes.put(out);
        self.is_corner.put(out);
        self.starts.put(out);
        self.ring.put(out);
        self.across.put(out);
        self.component.put(out);
        self.components.put(out);
        self.trunk.put(out);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Self::restored(bytes)
    }
}

/// A floor cut into convex cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Mesh {
    /// The grid of its vertices.
    grid: Grid,
    nodes: Vec<Node>,
    /// Whether a shortest way may bend at the vertex: the floor's border turns inwards there, or that of the whole Map may;
    /// see [`Self::bend_at`].
    pub(super) is_corner: Vec<bool>,
    /// Where the corners of each cell begin in `ring`; one entry more than there are cells.
    starts: Numbers,
    ring: Numbers,
    across: Numbers,
    /// Which cells hang together.
    component: Numbers,
    /// How many components there are.
    pub(super) components: u32,
    /// The cell that a branch of cells hangs on: a way enters the branch over it alone, and leaves it there again.
    /// [`NONE`] for cells in a ring, and for the last of a tree.
    trunk: Numbers,
    buckets: OnDemand<Buckets>,
    passages: OnDemand<Passages>,
}

/// An edge of a cell that another cell lies behind.
#[derive(Debug, Clone, Copy)]
pub(super) struct Passage {
    /// Seen from inside the cell, `right` comes first counter-clockwise.
    pub(super) right: Point,
    pub(super) left: Point,
    /// Whether a shortest way may bend there.
    pub(super) right_bends: bool,
    pub(super) left_bends: bool,
    pub(super) to: u32,
}

/// The passages of all cells, one cell after another, as a search wants them.
#[derive(Debug, Clone)]
struct Passages {
    /// Where those of each cell begin in `all`, and of these those behind which a branch begins; one entry more than
    /// there are cells.
    starts: Vec<[u32; 2]>,
    all: Vec<Passage>,
}

impl Mesh {
    /// `patience` is how hard to try for few cells; see [`HalfEdges::pair_up`].
    pub(super) fn of(grid: &Grid, shapes: &Shapes, patience: usize) -> Self {
        if shapes.is_empty() {
            return Self::default();
        }
        let mut edges = HalfEdges::of(shapes);
        edges.merge();
        edges.pair_up(patience);
        let faces = edges.faces();
        let mut face_of = vec![NONE; edges.origin.len()];
        for (number, face) in faces.iter().enumerate() {
            face.iter().for_each(|&h| face_of[h as usize] = number as u32);
        }
        let beyond = |h: u32| match edges.twin[h as usize] {
            NONE => NONE,
            twin => face_of[twin as usize],
        };
        let count = faces.iter().map(<[u32]>::len).sum();
        let (mut starts, mut ring, mut across) =
            (vec![0], Vec::with_capacity(count), Vec::with_capacity(count));
        for face in faces.iter() {
            ring.extend(face.iter().map(|&h| edges.origin[h as usize]));
            across.extend(face.iter().map(|&h| beyond(h)));
            starts.push(ring.len() as u32);
        }
        let mut mesh = Self {
            grid: *grid,
            nodes: edges.nodes.clone(),
            is_corner: edges.corners(),
            starts: Numbers::of(&starts),
            ring: Numbers::of(&ring),
            across: Numbers::of(&across),
            ..Self::default()
        };
        let (component, components) = mesh.find_components();
        (mesh.component, mesh.components) = (Numbers::of(&component), components);
        mesh.trunk = Numbers::of(&mesh.trunks());
        mesh
    }

    /// Takes a mesh off the front of bytes; see [`Kept`].
    fn restored(bytes: &mut &[u8]) -> Option<Self> {
        let mesh = Self {
            grid: Kept::take(bytes)?,
            nodes: Kept::take(bytes)?,
            is_corner: Kept::take(bytes)?,
            starts: Kept::take(bytes)?,
            ring: Kept::take(bytes)?,
            across: Kept::take(bytes)?,
            component: Kept::take(bytes)?,
            components: Kept::take(bytes)?,
            trunk: Kept::take(bytes)?,
            buckets: OnDemand::default(),
            passages: OnDemand::default(),
        };
        let cells = mesh.len();
        let is_cell = |c: u32| c == NONE || (c as usize) < cells;
        // Numbers that lead nowhere would be asked for later.
        let is_sound = mesh.is_corner.len() == mesh.nodes.len()
            && mesh.across.len() == mesh.ring.len()
            && mesh.component.len() == cells
            && mesh.trunk.len() == cells
            && mesh.starts.all().iter().is_sorted()
            && mesh.starts.all().iter().last().map_or(0, |n| n as usize) == mesh.ring.len()
            && mesh.cells().all(|c| mesh.span(c).len() > 2)
            && mesh.ring.all().iter().all(|v| (v as usize) < mesh.nodes.len())
            && [&mesh.across, &mesh.trunk].into_iter().flat_map(|n| n.all().iter()).all(is_cell)
            && mesh.component.all().iter().all(|c| c < mesh.components);
        is_sound.then_some(mesh)
    }

    /// Lets ways bend at the ends of an edge that leads on into another floor: where the doorway's line ends, a border that
    /// runs straight on in each of the two floors turns inwards in both together.
    pub(super) fn bend_at(&mut self, cell: u32, edge: usize) {
        let ring = self.ring(cell);
        let next = if edge + 1 == ring.len() { 0 } else { edge + 1 };
        for end in [ring.get(edge), ring.get(next)] {
            self.is_corner[end as usize] = true;
        }
        self.passages = OnDemand::default();
    }

    pub(super) fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    pub(super) fn cells(&self) -> std::ops::Range<u32> {
        0..self.len() as u32
    }

    fn span(&self, cell: u32) -> std::ops::Range<usize> {
        self.starts.get(cell as usize) as usize..self.starts.get(cell as usize + 1) as usize
    }

    /// The vertices of a cell, counter-clockwise.
    pub(super) fn ring(&self, cell: u32) -> Part<'_> {
        self.ring.part(self.span(cell))
    }

    /// The cell across each edge; edge `i` starts at vertex `i` of the ring.
    pub(super) fn across(&self, cell: u32) -> Part<'_> {
        self.across.part(self.span(cell))
    }

    /// The vertices at which a shortest way may bend.
    pub(super) fn bends(&self) -> impl Iterator<Item = Point> + '_ {
        let corners = self.nodes.iter().zip(&self.is_corner).filter(|(_, is)| **is);
        corners.map(|(node, _)| self.grid.point(*node))
    }

    pub(super) fn component(&self, cell: u32) -> u32 {
        self.component.get(cell as usize)
    }

    /// The cell that a branch hangs on; see [`Mesh`].
    pub(super) fn trunk(&self, cell: u32) -> u32 {
        self.trunk.get(cell as usize)
    }

    fn vertex(&self, vertex: u32) -> Point {
        self.grid.point(self.nodes[vertex as usize])
    }

    /// The corners of a cell, counter-clockwise.
    pub(super) fn corners(&self, cell: u32) -> impl Iterator<Item = Point> + '_ {
        self.ring(cell).iter().map(|v| self.vertex(v))
    }

    /// The edges of a cell, counter-clockwise, from the one that ends at the first vertex on.
    fn edges(&self, cell: u32) -> impl Iterator<Item = (Point, Point)> + '_ {
        let ring = self.ring(cell);
        let mut from = self.vertex(ring.get(ring.len() - 1));
        ring.iter().map(move |v| {
            let to = self.vertex(v);
            (std::mem::replace(&mut from, to), to)
        })
    }

    pub(super) fn edge(&self, cell: u32, edge: usize) -> (Point, Point) {
        let ring = self.ring(cell);
        let next = if edge + 1 == ring.len() { 0 } else { edge + 1 };
        (self.vertex(ring.get(edge)), self.vertex(ring.get(next)))
    }

    pub(super) fn polygon(&self, cell: u32) -> Polygon {
        Polygon::new(self.corners(cell).collect())
    }

    /// The floor that the cells fill.
    pub(super) fn outline(&self) -> Vec<Region> {
        let node = |v: u32| self.nodes[v as usize];
        let cells: Vec<Contour> =
            self.cells().map(|c| self.ring(c).iter().map(node).collect()).collect();
        self.grid.regions(&positive(&cells))
    }

    /// Whether the cells are as large as the shapes that they were made of.
    pub(super) fn fills(&self, grid: &Grid, shapes: &Shapes) -> bool {
        let wanted: f64 = grid.regions(shapes).iter().map(Region::area).sum();
        let own: f64 = self.cells().map(|c| self.polygon(c).signed_area()).sum();
        (own - wanted).abs() <= 1e-6 * wanted.max(1.0)
    }

    /// The edges of a cell that lead into other cells: those that do not lead into a branch, and those that do, each
    /// counter-clockwise.
    #[inline]
    pub(super) fn passages(&self, cell: u32) -> (&[Passage], &[Passage]) {
        let Passages { starts, all } = self.passages.get(|| self.find_passages());
        let ([from, branches], [to, _]) = (starts[cell as usize], starts[cell as usize + 1]);
        (&all[from as usize..branches as usize], &all[branches as usize..to as usize])
    }

    fn find_passages(&self) -> Passages {
        let count = self.across.all().iter().filter(|&to| to != NONE).count();
        let mut starts = Vec::with_capacity(self.len() + 1);
        let mut all = Vec::with_capacity(count);
        for cell in self.cells() {
            let (ring, across) = (self.ring(cell), self.across(cell));
            let begin = [false, true].map(|is_branch| {
                let begin = all.len() as u32;
                for (i, to) in across.iter().enumerate().filter(|e| e.1 != NONE) {
                    if (self.trunk(to) == cell) != is_branch {
                        continue;
                    }
                    let next = if i + 1 == ring.len() { 0 } else { i + 1 };
                    let (u, v) = (ring.get(i), ring.get(next));
                    all.push(Passage {
                        right: self.vertex(u),
                        left: self.vertex(v),
                        right_bends: self.is_corner[u as usize],
                        left_bends: self.is_corner[v as usize],
                        to,
                    });
                }
                begin
            });
            starts.push(begin);
        }
        starts.push([all.len() as u32; 2]);
        Passages { starts, all }
    }

    /// The cells by place.
    fn buckets(&self) -> &Buckets {
        let reach = |c: u32| Bounds::of(self.corners(c)).grown(1e-3);
        self.buckets.get(|| Buckets::of(&self.cells().map(reach).collect::<Vec<_>>()))
    }

    /// A cell that holds `p`, its border within `tolerance` cm; the lowest of several.
    pub(super) fn locate(&self, p: Point, tolerance: f64) -> Option<u32> {
        self.buckets().near(p).iter().copied().find(|&c| self.holds(c, p, tolerance))
    }

    /// Whether a point lies in a cell, its border within `tolerance` cm.
    pub(super) fn holds(&self, cell: u32, p: Point, tolerance: f64) -> bool {
        let (at, tolerance) = (self.grid.place(p), tolerance * self.grid.scale);
        let ring = self.ring(cell);
        let corner = |v: u32| {
            let node = self.nodes[v as usize];
            Point::new(f64::from(node.x), f64::from(node.y))
        };
        let mut from = corner(ring.get(ring.len() - 1));
        ring.iter().all(|v| {
            let b = corner(v);
            let a = std::mem::replace(&mut from, b);
            let side = (b - a).perp(&(at - a));
            side >= 0.0 || side >= -tolerance * (b - a).norm()
        })
    }

    /// How far inside a cell a point lies, in cm; negative outside.
    fn depth(&self, cell: u32, p: Point) -> f64 {
        let mut depth = f64::INFINITY;
        for (a, b) in self.edges(cell) {
            let along = b - a;
            let length = along.norm();
            if length > 0.0 {
                depth = depth.min(along.perp(&(p - a)) / length);
            }
        }
        depth
    }

    /// The place nearest to `p` in the cells that `admits` accepts, and its cell.
    pub(super) fn nearest(&self, p: Point, admits: impl Fn(u32) -> bool) -> Option<(Point, u32)> {
        let place = |cell: u32| {
            if self.depth(cell, p) >= 0.0 {
                return (0.0, p, cell);
            }
            self.edges(cell)
                .map(|(a, b)| {
                    let q = nearest_on_segment(p, a, b);
                    ((q - p).norm(), q, cell)
                })
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .expect("a cell has edges")
        };
        self.cells()
            .filter(|&c| admits(c))
            .map(place)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, q, cell)| (q, cell))
    }

    /// The part of segment `a`-`b` within a cell, as fractions of its length.
    pub(super) fn clip(&self, cell: u32, a: Point, b: Point) -> Option<(f64, f64)> {
        /// Rounding turns an edge so short, in cm, that its line says nothing of places far off.
        const SHORT: f64 = 0.1;
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        let mut has_short = false;
        for (u, v) in self.edges(cell) {
            let along = v - u;
            let (da, db) = (along.perp(&(a - u)), along.perp(&(b - u)));
            // Most edges have all of the segment on their inner side.
            if da >= 0.0 && db >= 0.0 {
                continue;
            }
            let length = along.norm();
            if length < SHORT {
                has_short = true;
                continue;
            }
            (from, to) = cut(from, to, (da / length, db / length))?;
        }
        if has_short {
            // Where the long edges leave the segment, the short ones are near.
            let (p, q) = (a + (b - a) * from, a + (b - a) * to);
            let (mut near, mut far) = (0.0, 1.0);
            for (u, v) in self.edges(cell) {
                let along = v - u;
                let length = along.norm();
                if length > 0.0 && length < SHORT {
                    let sides = [p, q].map(|end| along.perp(&(end - u)) / length);
                    (near, far) = cut(near, far, (sides[0], sides[1]))?;
                }
            }
            (from, to) = (from + (to - from) * near, from + (to - from) * far);
        }
        // A needle's sides are within touch of their own line all along it: only its ends end it.
        let ends = Bounds::of(self.corners(cell));
        let along = b - a;
        for axis in 0..2 {
            if along[axis].abs() > TOUCH {
                let at = |edge: f64| (edge - a[axis]) / along[axis];
                let (s, t) = (at(ends.min[axis] - TOUCH), at(ends.max[axis] + TOUCH));
                (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
            }
        }
        (from <= to).then_some((from, to))
    }

    /// Where a segment that comes into a cell at a place leaves it: at which share of its length, over which edge; none
    /// when it ends there.
    pub(super) fn way_out(&self, cell: u32, a: Point, b: Point) -> Option<(f64, usize)> {
        /// Edges in one line are left at one share of the length, but for rounding.
        const SAME: f64 = 1e-10;
        let ring = self.ring(cell);
        let along = b - a;
        // With how far the place lies from the edge, as a share of the edge.
        let mut first: Option<(f64, usize, f64)> = None;
        for edge in 0..ring.len() {
            let (u, v) = self.edge(cell, edge);
            let side = v - u;
            let outwards = along.perp(&side);
            if outwards > 0.0 {
                let share = side.perp(&(a - u)) / outwards;
                let least = first.map_or(1.0, |f| f.0);
                if share < least + SAME && share < 1.0 {
                    let on = (a + along * share - u).dot(&side) / side.norm_squared();
                    let off = (-on).max(on - 1.0);
                    if share < least - SAME || first.is_none_or(|f| off < f.2) {
                        first = Some((share, edge, off));
                    }
                }
            }
        }
        first.map(|(share, edge, _)| (share, edge))
    }

    /// The cells whose boxes come near segment `a`-`b`, written into `found`.
    pub(super) fn near_segment(&self, a: Point, b: Point, found: &mut Vec<u32>) {
        self.buckets().along(a, b, found);
    }

    /// The cells that may meet a box.
    pub(super) fn meeting(&self, bounds: &Bounds) -> Vec<u32> {
        let mut found = Vec::new();
        self.buckets().meeting(bounds, &mut found);
        found
    }

    /// The stretches of segment `a`-`b` that lie on the floor, as fractions of its length.
    pub(super) fn stretches(&self, a: Point, b: Point) -> Vec<(f64, f64)> {
        let (mut near, mut stretches) = (Vec::new(), Vec::new());
        self.stretches_into(a, b, &mut near, &mut stretches);
        stretches
    }

    /// As [`Self::stretches`], into a list that is there; `near` is overwritten.
    pub(super) fn stretches_into(
        &self,
        a: Point,
        b: Point,
        near: &mut Vec<u32>,
        stretches: &mut Vec<(f64, f64)>,
    ) {
        self.near_segment(a, b, near);
        stretches.clear();
        stretches.extend(near.iter().filter_map(|&c| self.clip(c, a, b)));
        stretches.order_by(|x, y| x.0.total_cmp(&y.0));
        let close = 1e-4 / (b - a).norm().max(1e-4);
        stretches.dedup_by(|next, last| {
            let joins = next.0 <= last.1 + close;
            if joins {
                last.1 = last.1.max(next.1);
            }
            joins
        });
    }

    /// Whether all of segment `a`-`b` lies on the floor.
    pub(super) fn sees(&self, a: Point, b: Point) -> bool {
        let close = 1e-3 / (b - a).norm().max(1e-3);
        matches!(self.stretches(a, b)[..], [(from, to)] if from <= close && to >= 1.0 - close)
    }

    /// Cuts cells off that hang on one border, again and again.
    fn trunks(&self) -> Vec<u32> {
        let borders = |c: u32| self.across(c).iter().filter(|&o| o != NONE);
        let mut left: Vec<usize> = self.cells().map(|c| borders(c).count()).collect();
        let mut trunk = vec![NONE; self.len()];
        let mut leaves: Vec<u32> = self.cells().filter(|&c| left[c as usize] == 1).collect();
        while let Some(leaf) = leaves.pop() {
            if left[leaf as usize] != 1 {
                continue;
            }
            left[leaf as usize] = 0;
            if let Some(on) = borders(leaf).find(|&o| left[o as usize] > 0) {
                trunk[leaf as usize] = on;
                left[on as usize] -= 1;
                if left[on as usize] == 1 {
                    leaves.push(on);
                }
            }
        }
        trunk
    }

    fn find_components(&self) -> (Vec<u32>, u32) {
        let mut component = vec![NONE; self.len()];
        let mut count = 0;
        for seed in self.cells() {
            if component[seed as usize] != NONE {
                continue;
            }
            let mut open = vec![seed];
            component[seed as usize] = count;
            while let Some(cell) = open.pop() {
                for other in self.across(cell).iter() {
                    if other != NONE && component[other as usize] == NONE {
                        component[other as usize] = count;
                        open.push(other);
                    }
                }
            }
            count += 1;
        }
        (component, count)
    }
}

/// Places so far on the wrong side of an edge are on it, in cm.
const TOUCH: f64 = 1e-4;

/// What is left of a stretch, given as shares of a segment whose ends lie so far inside of an edge.
fn cut(from: f64, to: f64, (da, db): (f64, f64)) -> Option<(f64, f64)> {
    if da < -TOUCH && db < -TOUCH {
        return None;
    }
    if (da - db).abs() <= 1e-12 {
        return Some((from, to));
    }
    let t = da / (da - db);
    if da < -TOUCH {
        Some((from.max(t), to))
    } else if db < -TOUCH {
        Some((from, to.min(t)))
    } else {
        Some((from, to))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{difference, doubled_area};

    fn rectangle(x: i32, y: i32, w: i32, h: i32) -> Vec<Node> {
        [(x, y), (x + w, y), (x + w, y + h), (x, y + h)].map(|(x, y)| Node::new(x, y)).to_vec()
    }

    fn unit_grid() -> Grid {
        Grid::over(&Bounds { min: Point::new(-400.0, -400.0), max: Point::new(400.0, 400.0) })
    }

    /// Every promise of the module; answers the number of cells.
    fn check(shapes: &Shapes) -> usize {
        let grid = unit_grid();
        let mesh = Mesh::of(&grid, shapes, 4);
        let wanted = shapes.iter().map(|s| doubled_area(s)).sum::<i128>() as f64 / 2.0;
        let got: f64 = mesh.cells().map(|c| mesh.polygon(c).signed_area()).sum();
        let unit = (grid.point(Node::new(1, 0)) - grid.point(Node::new(0, 0))).x;
        let got = got / unit.powi(2);
        assert!((got - wanted).abs() <= 1e-9 * wanted, "{got} of {wanted}");
        for cell in mesh.cells() {
            assert!(mesh.polygon(cell).is_convex(1e-12));
            for (i, other) in mesh.across(cell).iter().enumerate() {
                if other != NONE {
                    let (a, b) = mesh.edge(cell, i);
                    let back = (0..mesh.ring(other).len()).any(|j| mesh.edge(other, j) == (b, a));
                    assert!(back, "a border has two sides");
                }
            }
        }
        mesh.len()
    }

    #[test]
    fn a_rectangle_is_one_cell() {
        assert_eq!(check(&vec![vec![rectangle(0, 0, 1000, 700)]]), 1);
    }

    #[test]
    fn a_pillar_makes_four_cells() {
        assert_eq!(
            check(&difference(&[rectangle(0, 0, 1000, 700)], &[rectangle(400, 300, 100, 100)])),
            4
        );
    }

    #[test]
    fn rooms_that_meet_in_a_point_stay_two() {
        let shapes = vec![vec![rectangle(0, 0, 100, 100)], vec![rectangle(100, 100, 100, 100)]];
        assert_eq!(check(&shapes), 2);
        let mesh = Mesh::of(&unit_grid(), &shapes, 4);
        assert_ne!(mesh.component(0), mesh.component(1));
    }

    #[test]
    fn only_inward_corners_bend_a_way() {
        let shapes = difference(&[rectangle(0, 0, 1000, 700)], &[rectangle(400, 300, 100, 100)]);
        let mesh = Mesh::of(&unit_grid(), &shapes, 4);
        assert_eq!(mesh.is_corner.iter().filter(|c| **c).count(), 4);
    }

    #[test]
    fn a_grid_of_pillars_is_filled_exactly() {
        let pillars: Vec<_> = (0..100)
            .map(|i| rectangle(37 + 97 * (i % 10), 41 + 89 * (i / 10), 20 + i % 7, 30 - i % 11))
            .collect();
        let cells = check(&difference(&[rectangle(0, 0, 1000, 1000)], &pillars));
        assert!(cells < 320, "{cells}");
    }
}
