//! Convex partition of a floor: a planar subdivision whose edges are dropped and turned until few cells are left.
//!
//! Constrained Delaunay triangulation (i_triangle), then every edge is dropped whose removal leaves both of its
//! ends convex, those first that serve no inward corner well (after Hertel and Mehlhorn 1983; never more than
//! four times the fewest possible cells), then edges are turned so that one serves two corners. All decisions are
//! made on the integer grid, hence exact.
//!
//! **Invariant**: the faces of the subdivision fill the floor and do not overlap; after every step the cells that
//! were convex are convex.

use std::cell::RefCell;
use std::ops::Range;

use i_overlay::core::solver::Solver;
use i_triangle::advanced::delaunay::IntDelaunay;
use i_triangle::int::triangulator::IntTriangulator;
use i_triangle::int::validation::Validation;

use super::grid::{Node, Shapes};
use super::numbers::NONE;

/// Positive when a, b, c turn left; exact, since the grid leaves two bits of 32 free.
fn orientation(a: Node, b: Node, c: Node) -> i64 {
    let d = |p: i32, q: i32| i64::from(p) - i64::from(q);
    d(b.x, a.x) * d(c.y, b.y) - d(b.y, a.y) * d(c.x, b.x)
}

thread_local! {
    /// What one triangulation allocates serves the next: a Fragment needs two, a building thousands.
    static KEPT: RefCell<IntTriangulator<i32, u32>> =
        RefCell::new(IntTriangulator::new(512, Validation::default(), Solver::AUTO));
}

fn triangulate(shapes: &Shapes) -> IntDelaunay<i32> {
    let mut found = IntDelaunay { triangles: Vec::new(), points: Vec::new() };
    KEPT.with_borrow_mut(|kept| kept.uncheck_delaunay_shapes_into(shapes, &mut found));
    found
}

/// A planar subdivision whose edges can be dropped.
pub(super) struct HalfEdges {
    pub(super) nodes: Vec<Node>,
    pub(super) origin: Vec<u32>,
    next: Vec<u32>,
    prev: Vec<u32>,
    /// The other half; [`NONE`] for a border of the floor.
    pub(super) twin: Vec<u32>,
    dropped: Vec<bool>,
    /// For each vertex a border edge that arrives and one that leaves; [`NONE`] within the floor.
    borders: Vec<(u32, u32)>,
    /// Vertices where several pieces of the border touch, so that `borders` does not tell all.
    touching: Vec<u32>,
}

/// Faces of a subdivision, one chain after another.
pub(super) struct Faces {
    chain: Vec<u32>,
    spans: Vec<Range<usize>>,
}

impl Faces {
    pub(super) fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.spans.iter().map(|span| &self.chain[span.clone()])
    }
}

impl HalfEdges {
    /// The triangles of the shapes.
    pub(super) fn of(shapes: &Shapes) -> Self {
        let found = triangulate(shapes);
        let n = 3 * found.triangles.len();
        let mut edges = Self {
            nodes: found.points,
            origin: Vec::with_capacity(n),
            next: (0..n as u32).map(|h| if h % 3 == 2 { h - 2 } else { h + 1 }).collect(),
            prev: (0..n as u32).map(|h| if h % 3 == 0 { h + 2 } else { h - 1 }).collect(),
            twin: vec![NONE; n],
            dropped: vec![false; n],
            borders: Vec::new(),
            touching: Vec::new(),
        };
        // Which corner of its triangle lies opposite to each half-edge.
        let mut opposite = Vec::with_capacity(n);
        for triangle in &found.triangles {
            let [a, b, c] = triangle.vertices.map(|v| v.index as u32);
            let turns_right = orientation(edges.node(a), edges.node(b), edges.node(c)) < 0;
            edges.origin.extend(if turns_right { [a, c, b] } else { [a, b, c] });
            opposite.extend(if turns_right { [1, 0, 2] } else { [2, 0, 1] });
        }
        for (h, corner) in opposite.into_iter().enumerate() {
            let other = found.triangles[h / 3].neighbors[corner];
            if other < found.triangles.len() {
                let ends = (edges.node(edges.origin[h]), edges.node(edges.end(h as u32)));
                // Shapes that touch in a point have that corner twice: it is places that are compared.
                let is_twin = |&k: &u32| {
                    (edges.node(edges.end(k)), edges.node(edges.origin[k as usize])) == ends
                };
                let found = (3 * other as u32..3 * other as u32 + 3).find(is_twin);
                edges.twin[h] = found.unwrap_or(NONE);
            }
        }
        for h in 0..n {
            let twin = edges.twin[h];
            if twin != NONE && edges.twin[twin as usize] != h as u32 {
                edges.twin[h] = NONE;
            }
        }
        edges.find_borders();
        edges
    }

    fn end(&self, h: u32) -> u32 {
        self.origin[self.next[h as usize] as usize]
    }

    fn node(&self, vertex: u32) -> Node {
        self.nodes[vertex as usize]
    }

    /// Drops every edge that convexity does not need: first those that straighten no inward corner, last those
    /// that straighten one at each end; the longer of equals first.
    pub(super) fn merge(&mut self) {
        let inner = (0..self.origin.len() as u32)
            .filter(|&h| self.twin[h as usize] != NONE && h < self.twin[h as usize]);
        let mut ranked: Vec<_> = inner
            .map(|h| {
                let (a, b) = (self.node(self.origin[h as usize]), self.node(self.end(h)));
                // Coordinates leave two bits of 32 free.
                let (dx, dy) = (i64::from(a.x) - i64::from(b.x), i64::from(a.y) - i64::from(b.y));
                let service = self.usefulness(h) + self.usefulness(self.twin[h as usize]);
                let length = dx.unsigned_abs().pow(2) + dy.unsigned_abs().pow(2);
                (
                    service,
                    std::cmp::Reverse(length),
                    (a.y, a.x).min((b.y, b.x)),
                    (a.y, a.x).max((b.y, b.x)),
                    h,
                )
            })
            .collect();
        ranked.sort_unstable();
        for (.., h) in ranked {
            if self.is_needless(h) {
                self.drop_edge(h);
            }
        }
    }

    /// Lets one edge do for two inward corners what two do: an edge that only one of its ends needs is turned
    /// about that end to a corner whose own edge is then needless.
    ///
    /// ```text
    ///   a corner d needs a-b, corner e needs e-f:   b + - - - - + f      both are served by d-e
    ///                                               |  \\     /  |
    ///                                               d    - -    e
    /// ```
    ///
    /// Every partition has one cell more than it has edges, less one for each hole, so each such turn saves a cell.
    ///
    /// Where no turn saves a cell any more, edges that serve one corner are turned on to their next end, which may
    /// let others meet; after `patience` such rounds without a cell saved no more is tried.
    pub(super) fn pair_up(&mut self, patience: usize) {
        let order = self.inner_edges();
        let mut idle = 0;
        loop {
            if self.save_cells(&order) {
                idle = 0;
            }
            if idle == patience {
                return;
            }
            idle += 1;
            let mut ends = Vec::new();
            for &h in &order {
                for h in [h, self.twin[h as usize]] {
                    if self.serves_origin_alone(h) {
                        self.other_ends(h, &mut ends);
                        if let Some(&to) = ends.first() {
                            self.turn(h, to);
                        }
                        break;
                    }
                }
            }
        }
    }

    /// One half of each inner edge, by place, so that what happens elsewhere does not change their order.
    fn inner_edges(&self) -> Vec<u32> {
        let place = |h: u32| {
            let [a, b] =
                [self.origin[h as usize], self.end(h)].map(|v| (self.node(v).y, self.node(v).x));
            (a.min(b), a.max(b))
        };
        let mut order: Vec<u32> = (0..self.origin.len() as u32)
            .filter(|&h| !self.dropped[h as usize])
            .filter(|&h| self.twin[h as usize] != NONE && h < self.twin[h as usize])
            .collect();
        order.sort_by_cached_key(|&h| place(h));
        order
    }

    /// Turns edges as long as that makes others needless; whether it ever did.
    fn save_cells(&mut self, order: &[u32]) -> bool {
        let (mut has_saved, mut ends) = (false, Vec::new());
        loop {
            let mut is_better = false;
            for &h in order {
                if !self.dropped[h as usize] && self.is_needless(h) {
                    self.drop_edge(h);
                    is_better = true;
                }
                for h in [h, self.twin[h as usize]] {
                    if !self.serves_origin_alone(h) {
                        continue;
                    }
                    self.other_ends(h, &mut ends);
                    let at = self.node(self.origin[h as usize]);
                    let found = ends.iter().copied().filter(|&to| self.straightens(to, at));
                    let mut found = found.filter_map(|to| Some((to, self.useless_at(to, h)?)));
                    if let Some((to, useless)) = found.next() {
                        self.turn(h, to);
                        if self.is_needless(useless) {
                            self.drop_edge(useless);
                            is_better = true;
                        }
                    }
                }
            }
            if !is_better {
                return has_saved;
            }
            has_saved = true;
        }
    }

    fn serves_origin_alone(&self, h: u32) -> bool {
        !self.dropped[h as usize]
            && self.is_needed_at_origin(h)
            && !self.is_needed_at_origin(self.twin[h as usize])
    }

    fn is_needed_at_origin(&self, h: u32) -> bool {
        !self.runs_left(self.prev[h as usize], self.next[self.twin[h as usize] as usize])
    }

    /// Where else an edge that serves its origin alone could end: half-edges of the two faces along it, at whose
    /// starts it would leave both faces convex; counter-clockwise, beginning after its present end.
    fn other_ends(&self, h: u32, ends: &mut Vec<u32>) {
        ends.clear();
        let t = self.twin[h as usize];
        let (arriving, leaving) = (self.prev[h as usize], self.next[t as usize]);
        let place = |h: u32| self.node(self.origin[h as usize]);
        let (before, at, after) = (place(arriving), place(h), self.node(self.end(leaving)));
        let admits = |to: u32| {
            let there = place(to);
            orientation(before, at, there) > 0
                && orientation(there, at, after) > 0
                && orientation(there, self.node(self.end(to)), at) > 0
                && orientation(there, at, place(self.prev[to as usize])) > 0
        };
        // Round both faces, as one: only the origin turns inwards there, so it sees all their corners.
        let mut stretch = |from: u32, until: u32| {
            let mut to = from;
            while to != until {
                if admits(to) {
                    ends.push(to);
                }
                to = self.next[to as usize];
            }
        };
        // The first of the next face starts at the present end.
        let first = self.next[h as usize];
        if first != arriving {
            stretch(self.next[first as usize], arriving);
        }
        if leaving != t {
            stretch(self.next[leaving as usize], t);
        }
    }

    /// Whether an edge from the origin of `to` towards `from` would make that corner convex on both sides.
    fn straightens(&self, to: u32, from: Node) -> bool {
        let (arriving, leaving) = self.borders[self.origin[to as usize] as usize];
        if arriving == NONE || leaving == NONE {
            return false;
        }
        let corner = self.node(self.origin[to as usize]);
        let (before, after) =
            (self.node(self.origin[arriving as usize]), self.node(self.end(leaving)));
        orientation(before, corner, after) < 0
            && orientation(before, corner, from) > 0
            && orientation(from, corner, after) > 0
    }

    /// An edge at the origin of `to` that its other end does not need.
    fn useless_at(&self, to: u32, but: u32) -> Option<u32> {
        let mut found = None;
        let mut visit = |h: u32| {
            let t = self.twin[h as usize];
            if h != but && t != but && !self.is_needed_at_origin(t) {
                found = Some(h);
            }
            found.is_some()
        };
        // Round the corner both ways, to its borders.
        let mut h = to;
        while self.twin[h as usize] != NONE {
            if visit(h) {
                return found;
            }
            h = self.next[self.twin[h as usize] as usize];
            if h == to {
                return None;
            }
        }
        let mut h = self.twin[self.prev[to as usize] as usize];
        while h != NONE {
            if visit(h) {
                return found;
            }
            h = self.twin[self.prev[h as usize] as usize];
        }
        None
    }

    /// Takes an edge out and puts it in again, from its origin to that of `to`, a half-edge of the faces along it.
    fn turn(&mut self, h: u32, to: u32) {
        let t = self.twin[h as usize];
        let (arriving, leaving) = (self.prev[h as usize], self.next[t as usize]);
        self.drop_edge(h);
        let before_to = self.prev[to as usize];
        self.origin[t as usize] = self.origin[to as usize];
        // h runs from the corner to `to`, t back again.
        self.link(arriving, h);
        self.link(h, to);
        self.link(before_to, t);
        self.link(t, leaving);
        self.dropped[h as usize] = false;
        self.dropped[t as usize] = false;
    }

    fn link(&mut self, before: u32, after: u32) {
        self.next[before as usize] = after;
        self.prev[after as usize] = before;
    }

    /// Border edges keep their ends whatever is dropped or turned.
    fn find_borders(&mut self) {
        self.borders = vec![(NONE, NONE); self.nodes.len()];
        for h in (0..self.origin.len() as u32).filter(|&h| self.twin[h as usize] == NONE) {
            let (from, to) = (self.origin[h as usize], self.end(h));
            if std::mem::replace(&mut self.borders[from as usize].1, h) != NONE {
                self.touching.push(from);
            }
            self.borders[to as usize].0 = h;
        }
        self.touching.sort_unstable();
    }

    /// What an edge does for the convexity of its origin: nothing, a part, or all.
    fn usefulness(&self, h: u32) -> u8 {
        let at = self.origin[h as usize];
        let (arriving, leaving) = self.borders[at as usize];
        if arriving == NONE || leaving == NONE {
            return 0;
        }
        let place = self.node(at);
        let (before, after) =
            (self.node(self.origin[arriving as usize]), self.node(self.end(leaving)));
        let to = self.node(self.end(h));
        if orientation(before, place, after) >= 0 {
            0
        } else if orientation(before, place, to) >= 0 && orientation(to, place, after) >= 0 {
            2
        } else {
            1
        }
    }

    /// The vertices where the border turns to the right, so that a shortest way may bend there.
    pub(super) fn corners(&self) -> Vec<bool> {
        let turns_right = |arriving: u32, leaving: u32| {
            let [a, b, c] = [self.origin[arriving as usize], self.end(arriving), self.end(leaving)];
            orientation(self.node(a), self.node(b), self.node(c)) < 0
        };
        let at_vertex = |&(arriving, leaving): &(u32, u32)| {
            arriving != NONE && leaving != NONE && turns_right(arriving, leaving)
        };
        let mut corner: Vec<bool> = self.borders.iter().map(at_vertex).collect();
        if self.touching.is_empty() {
            return corner;
        }
        self.touching.iter().for_each(|&v| corner[v as usize] = false);
        for h in (0..self.origin.len() as u32).filter(|&h| self.twin[h as usize] == NONE) {
            let end = self.end(h);
            if self.touching.binary_search(&end).is_ok() {
                // Round the end to the border that leaves it within the same floor.
                let mut leaving = self.next[h as usize];
                let mut steps = 0;
                while self.twin[leaving as usize] != NONE && steps < self.origin.len() {
                    leaving = self.next[self.twin[leaving as usize] as usize];
                    steps += 1;
                }
                corner[end as usize] |= turns_right(h, leaving);
            }
        }
        corner
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
        let d = |p: i32, q: i32| i64::from(p) - i64::from(q);
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

    /// The remaining faces as chains of half-edges, in the order of their lowest corners, which come first; those
    /// without area are left out.
    pub(super) fn faces(&self) -> Faces {
        let mut seen = self.dropped.clone();
        let mut faces = Faces { chain: Vec::with_capacity(self.origin.len()), spans: Vec::new() };
        let place = |&h: &u32| {
            let node = self.node(self.origin[h as usize]);
            (node.y, node.x)
        };
        for seed in 0..self.origin.len() {
            if seen[seed] {
                continue;
            }
            let from = faces.chain.len();
            let mut h = seed;
            while !seen[h] {
                seen[h] = true;
                faces.chain.push(h as u32);
                h = self.next[h] as usize;
            }
            let face = &mut faces.chain[from..];
            if face.len() >= 3 && self.has_area(face) {
                let first = (0..face.len()).min_by_key(|&i| place(&face[i])).unwrap_or(0);
                face.rotate_left(first);
                faces.spans.push(from..faces.chain.len());
            } else {
                faces.chain.truncate(from);
            }
        }
        let places = |span: &Range<usize>| faces.chain[span.clone()].iter().map(place);
        faces.spans.sort_by(|a, b| places(a).cmp(places(b)));
        faces
    }

    fn has_area(&self, face: &[u32]) -> bool {
        let node = |h: u32| self.node(self.origin[h as usize]);
        face.windows(2).any(|e| orientation(node(face[0]), node(e[0]), node(e[1])) != 0)
    }
}
