//! Convex partition of a floor, and what is needed to walk over it.
//!
//! Constrained Delaunay triangulation (i_triangle), then every edge is dropped whose removal leaves both of its
//! ends convex, the longest first (after Hertel and Mehlhorn 1983; never more than four times the fewest
//! possible cells). All decisions are made on the integer grid, hence exact.
//!
//! **Invariant**: cells are convex and counter-clockwise, do not overlap, and fill the floor; where two share a
//! border, both have it as one edge with the same two corners.

use std::collections::{BTreeMap, HashMap};

use i_overlay::core::solver::Solver;
use i_triangle::int::triangulator::IntTriangulator;
use i_triangle::int::validation::Validation;

use crate::units::Point;

use super::grid::{Grid, Node, Shapes};
use super::{Bounds, Polygon, nearest_on_segment};

/// No cell: the edge is a border of the floor.
pub(super) const NONE: u32 = u32::MAX;

/// A floor cut into convex cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Mesh {
    pub(super) vertices: Vec<Point>,
    /// Whether a shortest way may bend at the vertex: the floor's border turns inwards there.
    pub(super) is_corner: Vec<bool>,
    /// Where the corners of each cell begin in `ring`; one entry more than there are cells.
    starts: Vec<u32>,
    ring: Vec<u32>,
    across: Vec<u32>,
    /// Which cells hang together.
    pub(super) component: Vec<u32>,
    buckets: Buckets,
}

impl Mesh {
    pub(super) fn of(grid: &Grid, shapes: &Shapes) -> Self {
        if shapes.is_empty() {
            return Self::default();
        }
        let (nodes, triangles) = triangulate(shapes);
        let mut edges = HalfEdges::of(&nodes, &triangles);
        edges.merge();
        Self::from_faces(grid, &nodes, edges.faces())
    }

    fn from_faces(grid: &Grid, nodes: &[Node], mut faces: Vec<Vec<u32>>) -> Self {
        // Faces in the order of their places, whatever order they were found in.
        for face in &mut faces {
            let first = (0..face.len())
                .min_by_key(|&i| (nodes[face[i] as usize].y, nodes[face[i] as usize].x));
            face.rotate_left(first.unwrap_or(0));
        }
        faces.sort_by_key(|f| {
            f.iter().map(|&v| (nodes[v as usize].y, nodes[v as usize].x)).collect::<Vec<_>>()
        });
        let vertices: Vec<Point> = nodes.iter().map(|&n| grid.point(n)).collect();
        let mut mesh = Self { vertices, starts: vec![0], ..Self::default() };
        for face in &faces {
            mesh.ring.extend_from_slice(face);
            mesh.starts.push(mesh.ring.len() as u32);
        }
        mesh.link();
        mesh.is_corner = mesh.corners_of(nodes);
        mesh.component = mesh.components();
        mesh.buckets = Buckets::of(&mesh);
        mesh
    }

    pub(super) fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    pub(super) fn cells(&self) -> std::ops::Range<u32> {
        0..self.len() as u32
    }

    fn span(&self, cell: u32) -> std::ops::Range<usize> {
        self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize
    }

    /// The vertices of a cell, counter-clockwise.
    pub(super) fn ring(&self, cell: u32) -> &[u32] {
        &self.ring[self.span(cell)]
    }

    /// The cell across each edge; edge `i` starts at vertex `i` of the ring.
    pub(super) fn across(&self, cell: u32) -> &[u32] {
        &self.across[self.span(cell)]
    }

    pub(super) fn edge(&self, cell: u32, edge: usize) -> (Point, Point) {
        let ring = self.ring(cell);
        (self.vertices[ring[edge] as usize], self.vertices[ring[(edge + 1) % ring.len()] as usize])
    }

    pub(super) fn polygon(&self, cell: u32) -> Polygon {
        Polygon::new(self.ring(cell).iter().map(|&v| self.vertices[v as usize]).collect())
    }

    /// A cell that holds `p`, its border within `tolerance` cm; the lowest of several.
    pub(super) fn locate(&self, p: Point, tolerance: f64) -> Option<u32> {
        self.buckets.near(p).iter().copied().find(|&c| self.depth(c, p) >= -tolerance)
    }

    /// How far inside a cell a point lies, in cm; negative outside.
    fn depth(&self, cell: u32, p: Point) -> f64 {
        let ring = self.ring(cell);
        let mut depth = f64::INFINITY;
        for i in 0..ring.len() {
            let (a, b) = self.edge(cell, i);
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
            let ring = self.ring(cell);
            (0..ring.len())
                .map(|i| {
                    let (a, b) = self.edge(cell, i);
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
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for i in 0..self.ring(cell).len() {
            let (u, v) = self.edge(cell, i);
            let along = v - u;
            let length = along.norm();
            if length <= 0.0 {
                continue;
            }
            let (da, db) = (along.perp(&(a - u)) / length, along.perp(&(b - u)) / length);
            const TOUCH: f64 = 1e-4;
            if da < -TOUCH && db < -TOUCH {
                return None;
            }
            if (da - db).abs() > 1e-12 {
                let t = da / (da - db);
                if da < -TOUCH {
                    from = from.max(t);
                } else if db < -TOUCH {
                    to = to.min(t);
                }
            }
        }
        (from <= to).then_some((from, to))
    }

    /// The cells whose boxes meet that of segment `a`-`b`.
    pub(super) fn near_segment(&self, a: Point, b: Point) -> Vec<u32> {
        self.buckets.meeting(&Bounds::of([a, b]).grown(1e-6))
    }

    /// The stretches of segment `a`-`b` that lie on the floor, as fractions of its length.
    pub(super) fn stretches(&self, a: Point, b: Point) -> Vec<(f64, f64)> {
        let mut parts: Vec<_> =
            self.near_segment(a, b).into_iter().filter_map(|c| self.clip(c, a, b)).collect();
        parts.sort_by(|x, y| x.0.total_cmp(&y.0));
        let close = 1e-4 / (b - a).norm().max(1e-4);
        let mut joined: Vec<(f64, f64)> = Vec::new();
        for (from, to) in parts {
            match joined.last_mut() {
                Some(last) if from <= last.1 + close => last.1 = last.1.max(to),
                _ => joined.push((from, to)),
            }
        }
        joined
    }

    /// Whether all of segment `a`-`b` lies on the floor.
    pub(super) fn sees(&self, a: Point, b: Point) -> bool {
        let close = 1e-3 / (b - a).norm().max(1e-3);
        matches!(self.stretches(a, b)[..], [(from, to)] if from <= close && to >= 1.0 - close)
    }

    /// Finds the cell across each edge.
    fn link(&mut self) {
        let mut by_edge = HashMap::with_capacity(self.ring.len());
        for cell in self.cells() {
            let span = self.span(cell);
            for i in span.clone() {
                by_edge.insert((self.ring[i], self.ring[next_in(&span, i)]), cell);
            }
        }
        self.across = vec![NONE; self.ring.len()];
        for cell in self.cells() {
            let span = self.span(cell);
            for i in span.clone() {
                let back = (self.ring[next_in(&span, i)], self.ring[i]);
                self.across[i] = by_edge.get(&back).copied().unwrap_or(NONE);
            }
        }
    }

    /// A border that turns to the right, or vertices at which borders meet.
    fn corners_of(&self, nodes: &[Node]) -> Vec<bool> {
        let mut leaving: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let mut borders = Vec::new();
        for cell in self.cells() {
            let span = self.span(cell);
            for i in span.clone().filter(|&i| self.across[i] == NONE) {
                let (u, v) = (self.ring[i], self.ring[next_in(&span, i)]);
                leaving.entry(u).or_default().push(v);
                borders.push((u, v));
            }
        }
        let mut corner = vec![false; nodes.len()];
        for (u, v) in borders {
            let after = leaving.get(&v).map_or(&[][..], Vec::as_slice);
            corner[v as usize] |= match after {
                [w] => orientation(nodes[u as usize], nodes[v as usize], nodes[*w as usize]) < 0,
                _ => true,
            };
        }
        corner
    }

    fn components(&self) -> Vec<u32> {
        let mut component = vec![NONE; self.len()];
        let mut count = 0;
        for seed in self.cells() {
            if component[seed as usize] != NONE {
                continue;
            }
            let mut open = vec![seed];
            component[seed as usize] = count;
            while let Some(cell) = open.pop() {
                for &other in self.across(cell) {
                    if other != NONE && component[other as usize] == NONE {
                        component[other as usize] = count;
                        open.push(other);
                    }
                }
            }
            count += 1;
        }
        component
    }
}

fn next_in(span: &std::ops::Range<usize>, i: usize) -> usize {
    if i + 1 == span.end { span.start } else { i + 1 }
}

/// Positive when a, b, c turn left; exact.
fn orientation(a: Node, b: Node, c: Node) -> i128 {
    let d = |p: i32, q: i32| i128::from(p) - i128::from(q);
    d(b.x, a.x) * d(c.y, b.y) - d(b.y, a.y) * d(c.x, b.x)
}

/// Distinct nodes and the triangles on them.
fn triangulate(shapes: &Shapes) -> (Vec<Node>, Vec<[u32; 3]>) {
    let count = shapes.iter().flatten().map(Vec::len).sum();
    let mut triangulator =
        IntTriangulator::<i32, u32>::new(count, Validation::default(), Solver::AUTO);
    triangulator.delaunay = true;
    let found = triangulator.uncheck_triangulate_shapes(shapes);
    // Shapes that touch in a point bring it twice.
    let mut nodes = Vec::with_capacity(found.points.len());
    let mut numbers = HashMap::with_capacity(found.points.len());
    let renumbered: Vec<u32> = found
        .points
        .iter()
        .map(|&p| {
            *numbers.entry((p.x, p.y)).or_insert_with(|| {
                nodes.push(p);
                nodes.len() as u32 - 1
            })
        })
        .collect();
    let triangles = found
        .indices
        .chunks_exact(3)
        .map(|t| [0, 1, 2].map(|i| renumbered[t[i] as usize]))
        .filter(|&[a, b, c]| a != b && b != c && c != a)
        .map(|[a, b, c]| {
            let turn = orientation(nodes[a as usize], nodes[b as usize], nodes[c as usize]);
            if turn < 0 { [a, c, b] } else { [a, b, c] }
        })
        .collect();
    (nodes, triangles)
}

/// A planar subdivision whose edges can be dropped.
struct HalfEdges<'a> {
    nodes: &'a [Node],
    origin: Vec<u32>,
    next: Vec<u32>,
    prev: Vec<u32>,
    twin: Vec<u32>,
    dropped: Vec<bool>,
}

impl<'a> HalfEdges<'a> {
    fn of(nodes: &'a [Node], triangles: &[[u32; 3]]) -> Self {
        let n = 3 * triangles.len();
        let mut edges = Self {
            nodes,
            origin: triangles.iter().flatten().copied().collect(),
            next: (0..n as u32).map(|h| if h % 3 == 2 { h - 2 } else { h + 1 }).collect(),
            prev: (0..n as u32).map(|h| if h % 3 == 0 { h + 2 } else { h - 1 }).collect(),
            twin: vec![NONE; n],
            dropped: vec![false; n],
        };
        let mut by_ends = HashMap::with_capacity(n);
        for h in 0..n as u32 {
            by_ends.insert((edges.origin[h as usize], edges.end(h)), h);
        }
        for h in 0..n as u32 {
            let twin = by_ends.get(&(edges.end(h), edges.origin[h as usize])).copied();
            // An edge that three faces claim (overlapping slivers) stays a border for the third.
            if let Some(t) =
                twin.filter(|&t| edges.twin[t as usize] == NONE || edges.twin[t as usize] == h)
            {
                edges.twin[h as usize] = t;
            }
        }
        for h in 0..n {
            let t = edges.twin[h];
            if t != NONE && edges.twin[t as usize] != h as u32 {
                edges.twin[h] = NONE;
            }
        }
        edges
    }

    fn end(&self, h: u32) -> u32 {
        self.origin[self.next[h as usize] as usize]
    }

    fn node(&self, vertex: u32) -> Node {
        self.nodes[vertex as usize]
    }

    /// Drops every edge that convexity does not need, the longest first.
    fn merge(&mut self) {
        let mut inner: Vec<u32> = (0..self.origin.len() as u32)
            .filter(|&h| self.twin[h as usize] != NONE && h < self.twin[h as usize])
            .collect();
        inner.sort_by_key(|&h| {
            let (a, b) = (self.node(self.origin[h as usize]), self.node(self.end(h)));
            let (dx, dy) = (i64::from(a.x) - i64::from(b.x), i64::from(a.y) - i64::from(b.y));
            let length = i128::from(dx).pow(2) + i128::from(dy).pow(2);
            let (low, high) = ((a.y, a.x).min((b.y, b.x)), (a.y, a.x).max((b.y, b.x)));
            (std::cmp::Reverse(length), low, high)
        });
        for h in inner {
            if self.is_needless(h) {
                self.drop_edge(h);
            }
        }
    }

    /// Without the edge, the chain runs straight on or to the left at both of its ends.
    fn is_needless(&self, h: u32) -> bool {
        let t = self.twin[h as usize];
        self.runs_left(self.prev[h as usize], self.next[t as usize])
            && self.runs_left(self.prev[t as usize], self.next[h as usize])
    }

    /// Whether `leaving` may follow `arriving` in a convex chain.
    fn runs_left(&self, arriving: u32, leaving: u32) -> bool {
        let [a, b, c] =
            [self.origin[arriving as usize], self.origin[leaving as usize], self.end(leaving)];
        if a == c {
            return false;
        }
        let (a, b, c) = (self.node(a), self.node(b), self.node(c));
        let turn = orientation(a, b, c);
        let d = |p: i32, q: i32| i128::from(p) - i128::from(q);
        let ahead = d(b.x, a.x) * d(c.x, b.x) + d(b.y, a.y) * d(c.y, b.y);
        turn > 0 || (turn == 0 && ahead > 0)
    }

    fn drop_edge(&mut self, h: u32) {
        let t = self.twin[h as usize];
        let (before_h, after_h) = (self.prev[h as usize], self.next[h as usize]);
        let (before_t, after_t) = (self.prev[t as usize], self.next[t as usize]);
        self.next[before_h as usize] = after_t;
        self.prev[after_t as usize] = before_h;
        self.next[before_t as usize] = after_h;
        self.prev[after_h as usize] = before_t;
        self.dropped[h as usize] = true;
        self.dropped[t as usize] = true;
    }

    /// The remaining faces; those without area are left out.
    fn faces(&self) -> Vec<Vec<u32>> {
        let mut seen = self.dropped.clone();
        let mut faces = Vec::new();
        for seed in 0..self.origin.len() {
            if seen[seed] {
                continue;
            }
            let mut face = Vec::new();
            let mut h = seed;
            while !seen[h] {
                seen[h] = true;
                face.push(self.origin[h]);
                h = self.next[h] as usize;
            }
            if face.len() >= 3 && self.has_area(&face) {
                faces.push(face);
            }
        }
        faces
    }

    fn has_area(&self, face: &[u32]) -> bool {
        let o = self.node(face[0]);
        face.windows(2).any(|e| orientation(o, self.node(e[0]), self.node(e[1])) != 0)
    }
}

/// A grid of boxes, each with the cells that reach into it.
#[derive(Debug, Clone, PartialEq)]
struct Buckets {
    bounds: Bounds,
    size: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    cells: Vec<u32>,
}

impl Default for Buckets {
    fn default() -> Self {
        Self {
            bounds: Bounds::EMPTY,
            size: 1.0,
            columns: 0,
            rows: 0,
            starts: vec![0],
            cells: vec![],
        }
    }
}

impl Buckets {
    fn of(mesh: &Mesh) -> Self {
        let boxes: Vec<Bounds> =
            mesh.cells().map(|c| mesh.polygon(c).bounds().grown(1e-3)).collect();
        let Some(bounds) = boxes.iter().copied().reduce(|a, b| a.union(&b)) else {
            return Self::default();
        };
        let extent = bounds.max - bounds.min;
        let size =
            (extent.x * extent.y / boxes.len() as f64).sqrt().max(extent.amax() / 256.0).max(1e-3);
        let (columns, rows) = ((extent.x / size) as usize + 1, (extent.y / size) as usize + 1);
        let mut buckets = Self { bounds, size, columns, rows, starts: vec![], cells: vec![] };
        let mut lists = vec![Vec::new(); columns * rows];
        for (cell, reach) in boxes.iter().enumerate() {
            for bucket in buckets.covering(reach) {
                lists[bucket].push(cell as u32);
            }
        }
        buckets.starts.push(0);
        for list in lists {
            buckets.cells.extend(list);
            buckets.starts.push(buckets.cells.len() as u32);
        }
        buckets
    }

    fn column_row(&self, p: Point) -> (usize, usize) {
        let v = (p - self.bounds.min) / self.size;
        // Casts saturate, so points far off come to the rim.
        ((v.x as usize).min(self.columns - 1), (v.y as usize).min(self.rows - 1))
    }

    fn covering(&self, reach: &Bounds) -> impl Iterator<Item = usize> + use<> {
        let ((left, bottom), (right, top)) =
            (self.column_row(reach.min), self.column_row(reach.max));
        let columns = self.columns;
        (bottom..=top).flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }

    fn bucket(&self, index: usize) -> &[u32] {
        &self.cells[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    fn near(&self, p: Point) -> &[u32] {
        if self.columns == 0 || !self.bounds.contains(p) {
            return &[];
        }
        let (column, row) = self.column_row(p);
        self.bucket(row * self.columns + column)
    }

    fn meeting(&self, reach: &Bounds) -> Vec<u32> {
        if self.columns == 0 || !self.bounds.meets(reach) {
            return Vec::new();
        }
        let mut found: Vec<u32> =
            self.covering(reach).flat_map(|b| self.bucket(b).iter().copied()).collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::grid::{difference, doubled_area};

    fn rectangle(x: i32, y: i32, w: i32, h: i32) -> Vec<Node> {
        [(x, y), (x + w, y), (x + w, y + h), (x, y + h)].map(|(x, y)| Node::new(x, y)).to_vec()
    }

    fn unit_grid() -> Grid {
        Grid::over(&Bounds { min: Point::new(-400.0, -400.0), max: Point::new(400.0, 400.0) })
    }

    /// Every promise of the module; answers the number of cells.
    fn check(shapes: &Shapes) -> usize {
        let grid = unit_grid();
        let mesh = Mesh::of(&grid, shapes);
        let wanted = shapes.iter().map(|s| doubled_area(s)).sum::<i128>() as f64 / 2.0;
        let got: f64 = mesh.cells().map(|c| mesh.polygon(c).signed_area()).sum();
        let unit = (grid.point(Node::new(1, 0)) - grid.point(Node::new(0, 0))).x;
        let got = got / unit.powi(2);
        assert!((got - wanted).abs() <= 1e-9 * wanted, "{got} of {wanted}");
        for cell in mesh.cells() {
            assert!(mesh.polygon(cell).is_convex(1e-12));
            for (i, &other) in mesh.across(cell).iter().enumerate() {
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
        let mesh = Mesh::of(&unit_grid(), &shapes);
        assert_ne!(mesh.component[0], mesh.component[1]);
    }

    #[test]
    fn only_inward_corners_bend_a_way() {
        let shapes = difference(&[rectangle(0, 0, 1000, 700)], &[rectangle(400, 300, 100, 100)]);
        let mesh = Mesh::of(&unit_grid(), &shapes);
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
