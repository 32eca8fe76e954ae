//! Shortest way of a point over convex cells: Polyanya.
//!
//! After M. Cui, D. Harabor, A. Grastien, "Compromise-free pathfinding on a navigation mesh" (IJCAI 2017). A
//! search node is a stretch of a cell's edge that is seen from a root, the last bend of the way to it. Nodes are
//! taken in the order of the least length that a way through them can have, so the first way that reaches the
//! goal is the shortest of all; no graph of sight lines is built beforehand.
//!
//! A way bends at corners of cells alone, so there are finitely many roots, and what a root sees through an edge does not
//! depend on the way that the sight took there: of two nodes of one root and one edge the one that sees no more is
//! dropped ([`Search::is_known`]). Without that, the search would turn for ever round a corner at which cells meet on
//! all sides, as the end of a doorway's line may be, since that corner lies in line with every edge there.
//!
//! Angles are measured in floating point, and the Fragments that meet on a doorway's line know it each on a grid of its own.
//! So what border and ray have in line is taken whole, wherever rounding puts it, and looked at from its nearer end.
//!
//! **Invariant**: every way found lies in the cells; none is shorter. None is found only where no chain of cells leads to
//! the goal: that is asked of the cells before it is said ([`taut`]). No root looks twice through the same stretch of an
//! edge, so that every search ends, and what it remembers is bounded by corners and edges.

use std::cell::RefCell;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use std::hash::{BuildHasherDefault, Hasher};

use crate::units::Point;

use super::cells::{CellKey, Cells, Edge, side};
use super::{nearest_on_segment, taut};

/// Lengths below this are rounding, in cm.
const EPSILON: f64 = 1e-7;
/// Cells looked through without asking whether another way is shorter.
const EAGER: usize = 6;
/// Points nearer than this to a vertex are the vertex, and nearer to a line are in line, in cm: more than the grids of two
/// Fragments, where these meet on a doorway's line, can differ, and far less than the narrowest gap is wide.
const SNAP: f64 = 1e-4;

#[derive(Debug, Clone, Copy)]
struct SearchNode {
    /// Length of the way up to the root.
    spent: f64,
    root: u32,
    right: Point,
    left: Point,
    right_bends: bool,
    left_bends: bool,
    cell: CellKey,
    from: CellKey,
    is_final: bool,
    /// The node before it in [`Search::known`] that has the same root and edge.
    alike: u32,
}

impl SearchNode {
    /// Whether all that another node of the same root and edge can lead to is found through this one.
    fn covers(&self, other: &Self) -> bool {
        let sees = |p: Point| {
            (p - nearest_on_segment(p, self.right, self.left)).norm_squared() < SNAP * SNAP
        };
        self.spent <= other.spent + EPSILON
            && (self.right_bends || !other.right_bends)
            && (self.left_bends || !other.left_bends)
            && sees(other.right)
            && sees(other.left)
    }
}

/// The last of a chain of nodes.
const NO_NODE: u32 = u32::MAX;

/// A bend of a way under construction.
#[derive(Debug, Clone, Copy)]
struct Root {
    at: Point,
    /// Its place's number in [`Search::best`].
    place: u32,
    parent: u32,
}

/// A node that waits for its turn: the least bound goes first, then a final node, then the older one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Waiting {
    /// The bits of the least length of a way through the node; they are in order, since no length is negative.
    bound: u64,
    is_not_final: bool,
    node: u32,
}

/// A way and what it took to find.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Way {
    pub(super) points: Vec<Point>,
    pub(super) length: f64,
}

/// The shortest way from `start` in cell `from` to `goal` in cell `to`; none only where no chain of cells leads there.
pub(super) fn shortest(
    cells: &impl Cells,
    start: Point,
    from: CellKey,
    goal: Point,
    to: CellKey,
) -> Option<Way> {
    seen(cells, start, from, goal, to).or_else(|| {
        let points = taut::along_cells(cells, start, from, goal, to)?;
        debug_assert!(false, "a way from {start} in {from:?} to {goal} in {to:?} was not seen");
        Some(Way { length: length(&points), points })
    })
}

/// What the search finds by itself.
pub(super) fn seen(
    cells: &impl Cells,
    start: Point,
    from: CellKey,
    goal: Point,
    to: CellKey,
) -> Option<Way> {
    if from == to {
        return Some(Way { points: vec![start, goal], length: (goal - start).norm() });
    }
    let mut search = KEPT.take();
    search.begin(start, goal);
    let way = search.run(cells, from, to);
    KEPT.set(search);
    way
}

pub(super) fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|p| (p[1] - p[0]).norm()).sum()
}

thread_local! {
    /// What one search allocates serves the next.
    static KEPT: RefCell<Search> = RefCell::default();
}

#[derive(Default)]
struct Search {
    goal: Point,
    roots: Vec<Root>,
    /// The numbers of the places where ways bend, but for the start's, which is 0.
    places: HashMap<(u64, u64), u32, BuildHasherDefault<PlaceHasher>>,
    /// Least length found up to each place.
    best: Vec<f64>,
    /// The edges of the cell that is looked at.
    edges: Vec<Edge>,
    /// What the cell that is looked at leads to.
    fresh: Vec<SearchNode>,
    nodes: Vec<SearchNode>,
    /// The node that came last of each root's place and each edge, told by the cells on its two sides.
    known: HashMap<(u32, CellKey, CellKey), u32, BuildHasherDefault<PlaceHasher>>,
    /// The foremost of the nodes that came last; often it goes before all others, and never sees the heap.
    next: Option<Waiting>,
    open: BinaryHeap<Reverse<Waiting>>,
}

/// Where the line through `a` and `b` meets the segment from `p` to `q`.
fn meet(a: Point, b: Point, p: Point, q: Point) -> Point {
    let (dp, dq) = (side(a, b, p), side(a, b, q));
    let t = if (dp - dq).abs() > 0.0 { (dp / (dp - dq)).clamp(0.0, 1.0) } else { 0.0 };
    let at = p + (q - p) * t;
    // A ray along a wall meets the wall's end: rounding must not lose the bend there.
    [p, q].into_iter().find(|&end| (end - at).norm_squared() < SNAP * SNAP).unwrap_or(at)
}

/// Whether three points are in line but for rounding.
fn is_in_line(a: Point, b: Point, c: Point) -> bool {
    let longest = (b - a).norm_squared().max((c - a).norm_squared()).max((c - b).norm_squared());
    side(a, b, c).powi(2) <= SNAP * SNAP * longest
}

/// Whether a root is in line with a stretch: it sees nothing past it, save through its nearer end.
fn is_flat(at: Point, right: Point, left: Point) -> bool {
    let area = side(at, right, left);
    let width = (left - right).norm_squared().max(EPSILON * EPSILON);
    area <= 0.0 || area * area <= EPSILON * EPSILON * width
}

impl Search {
    fn begin(&mut self, start: Point, goal: Point) {
        self.goal = goal;
        self.roots.clear();
        self.roots.push(Root { at: start, place: 0, parent: u32::MAX });
        self.fresh.clear();
        self.places.clear();
        self.best.clear();
        self.best.push(0.0);
        self.nodes.clear();
        self.known.clear();
        self.next = None;
        self.open.clear();
    }

    fn run(&mut self, cells: &impl Cells, from: CellKey, to: CellKey) -> Option<Way> {
        let mut first = std::mem::take(&mut self.edges);
        first.clear();
        cells.edges(from, None, &mut first);
        first.iter().for_each(|&edge| self.push(0.0, 0, edge, edge.right, edge.left, from));
        self.edges = first;
        self.queue();
        while let Some(next) = self.take() {
            let node = self.nodes[next.node as usize];
            if node.is_final {
                return Some(self.way(&node));
            }
            if self.is_outdone(&node) {
                continue;
            }
            if node.cell == to {
                self.finish(&node);
            } else {
                self.follow(cells, node, to);
            }
        }
        None
    }

    fn root(&self, node: &SearchNode) -> Point {
        self.roots[node.root as usize].at
    }

    fn is_outdone(&self, node: &SearchNode) -> bool {
        let place = self.roots[node.root as usize].place;
        self.best[place as usize] + EPSILON < node.spent
    }

    /// A way to a bend as a new root; none when a shorter one is known.
    fn reach(&mut self, at: Point, spent: f64, parent: u32) -> Option<u32> {
        let count = self.best.len() as u32;
        let place = *self.places.entry(key(at)).or_insert(count);
        if place == count {
            self.best.push(spent);
        }
        let best = &mut self.best[place as usize];
        if spent > *best + EPSILON {
            return None;
        }
        *best = best.min(spent);
        self.roots.push(Root { at, place, parent });
        Some(self.roots.len() as u32 - 1)
    }

    fn wait(&mut self, bound: f64, node: SearchNode) {
        let number = self.nodes.len() as u32;
        let new = Waiting { bound: bound.to_bits(), is_not_final: !node.is_final, node: number };
        self.nodes.push(node);
        match self.next {
            Some(next) if next < new => self.open.push(Reverse(new)),
            _ => {
                if let Some(later) = self.next.replace(new) {
                    self.open.push(Reverse(later));
                }
            }
        }
    }

    /// Takes the node whose turn it is.
    fn take(&mut self) -> Option<Waiting> {
        match (self.next.take(), self.open.peek()) {
            (Some(next), Some(Reverse(first))) if *first < next => {
                let mut first = self.open.peek_mut()?;
                Some(std::mem::replace(&mut *first, Reverse(next)).0)
            }
            (Some(next), _) => Some(next),
            (None, _) => self.open.pop().map(|first| first.0),
        }
    }

    fn push(
        &mut self,
        spent: f64,
        root: u32,
        edge: Edge,
        right: Point,
        left: Point,
        from: CellKey,
    ) {
        self.fresh.push(SearchNode {
            spent,
            root,
            right,
            left,
            right_bends: edge.right_bends && right == edge.right,
            left_bends: edge.left_bends && left == edge.left,
            cell: edge.to,
            from,
            is_final: false,
            alike: NO_NODE,
        });
    }

    /// Whether all that a node sees was seen from the same root through the same edge already; else it is the next to
    /// wait, and known from now on.
    fn is_known(&mut self, node: &mut SearchNode) -> bool {
        let place = self.roots[node.root as usize].place;
        let number = self.nodes.len() as u32;
        let last = self.known.entry((place, node.from, node.cell)).or_insert(NO_NODE);
        let before = |&n: &u32| Some(self.nodes[n as usize].alike).filter(|&n| n != NO_NODE);
        let mut alike = std::iter::successors(Some(*last).filter(|&n| n != NO_NODE), before);
        if alike.any(|n| self.nodes[n as usize].covers(node)) {
            return true;
        }
        node.alike = std::mem::replace(last, number);
        false
    }

    /// Lets what was found wait for its turn.
    fn queue(&mut self) {
        let mut fresh = std::mem::take(&mut self.fresh);
        for mut node in fresh.drain(..) {
            if self.is_known(&mut node) {
                continue;
            }
            let at = self.root(&node);
            self.wait(node.spent + through(at, node.right, node.left, self.goal), node);
        }
        self.fresh = fresh;
    }

    /// Looks on from cell to cell while there is one way on alone: only where there are several must one wait for
    /// another.
    fn follow(&mut self, cells: &impl Cells, mut node: SearchNode, to: CellKey) {
        for _ in 0..EAGER {
            let only = cells.only_edge(node.cell, node.from);
            if let Some(seen) = only.and_then(|edge| self.straight_on(&node, edge)) {
                node = seen;
                if node.cell == to {
                    break;
                }
                continue;
            }
            match only {
                Some(edge) => self.expand_over(&node, &[edge]),
                None => self.expand(cells, &node),
            }
            match self.fresh[..] {
                [only] if only.cell != to => {
                    node = only;
                    self.fresh.clear();
                }
                _ => return self.queue(),
            }
        }
        self.fresh.push(node);
        self.queue();
    }

    /// Ends a way whose last stretch lies in the goal's cell.
    fn finish(&mut self, node: &SearchNode) {
        let at = self.root(node);
        let mut last = *node;
        // Seen past an end of the stretch, the goal is reached over a bend there; in line with it, straight.
        let is_straight = |end: Point| is_in_line(at, end, self.goal);
        let bend = if side(at, node.left, self.goal) > 0.0 && !is_straight(node.left) {
            Some(node.left)
        } else if side(at, node.right, self.goal) < 0.0 && !is_straight(node.right) {
            Some(node.right)
        } else {
            None
        };
        if let Some(bend) = bend {
            last.spent += (bend - at).norm();
            let place = self.roots[node.root as usize].place;
            self.roots.push(Root { at: bend, place, parent: node.root });
            last.root = self.roots.len() as u32 - 1;
        }
        let bound = last.spent + (self.goal - self.root(&last)).norm();
        last.is_final = true;
        self.wait(bound, last);
    }

    fn expand(&mut self, cells: &impl Cells, node: &SearchNode) {
        let mut edges = std::mem::take(&mut self.edges);
        edges.clear();
        cells.edges(node.cell, Some(node.from), &mut edges);
        self.expand_over(node, &edges);
        self.edges = edges;
    }

    fn expand_over(&mut self, node: &SearchNode, edges: &[Edge]) {
        let at = self.root(node);
        if is_flat(at, node.right, node.left) {
            self.expand_flat(node, at, edges);
        } else {
            self.expand_cone(node, at, edges);
        }
    }

    /// The part of the only edge ahead that a root sees, if nothing else is to be looked at: what
    /// [`Self::expand_cone`] finds where it bends nowhere.
    #[inline(always)]
    fn straight_on(&self, node: &SearchNode, edge: Edge) -> Option<SearchNode> {
        let at = self.root(node);
        let (right, left, r, l) = (node.right, node.left, edge.right, edge.left);
        let (r_right, l_left) = (side(at, right, r) < 0.0, side(at, left, l) > 0.0);
        let (r_left, l_right) = (side(at, left, r) > 0.0, side(at, right, l) < 0.0);
        let bends = (r_right && node.right_bends) || (l_left && node.left_bends);
        if bends || r_left || l_right || is_flat(at, right, left) {
            return None;
        }
        let seen_right = if r_right { meet(at, right, r, l) } else { r };
        let seen_left = if l_left { meet(at, left, r, l) } else { l };
        let is_seen = (seen_left - seen_right).norm_squared() > EPSILON * EPSILON;
        // What is in line with the root is looked at more closely; see [`Self::expand_cone`].
        let is_plain = is_seen && !((r_right || l_left) && is_flat(at, seen_right, seen_left));
        is_plain.then(|| SearchNode {
            right: seen_right,
            left: seen_left,
            right_bends: edge.right_bends && seen_right == r,
            left_bends: edge.left_bends && seen_left == l,
            cell: edge.to,
            from: node.cell,
            ..*node
        })
    }

    #[inline(always)]
    fn expand_cone(&mut self, node: &SearchNode, at: Point, edges: &[Edge]) {
        let (right, left) = (node.right, node.left);
        for &edge in edges {
            let (r, l) = (edge.right, edge.left);
            // What the two rays cut from the edge: left of the left ray, between, right of the right ray.
            let (r_left, l_left) = (side(at, left, r) > 0.0, side(at, left, l) > 0.0);
            let (r_right, l_right) = (side(at, right, r) < 0.0, side(at, right, l) < 0.0);
            let seen_right = if r_right { meet(at, right, r, l) } else { r };
            let seen_left = if l_left { meet(at, left, r, l) } else { l };
            let is_wide = (seen_left - seen_right).norm_squared() > EPSILON * EPSILON;
            if !r_left && !l_right && is_wide {
                // In line with the root only rounding cuts an edge: its ends alone are corners to bend at.
                let is_cut = r_right || l_left;
                let is_whole = is_cut && is_flat(at, seen_right, seen_left);
                let (right, left) = if is_whole { (r, l) } else { (seen_right, seen_left) };
                self.push(node.spent, node.root, edge, right, left, node.cell);
            } else {
                // Where the border runs straight on, no way bends, and only rounding takes the edge out of sight.
                let grazes = |end: Point| is_in_line(at, end, r) && is_in_line(at, end, l);
                let is_past_left = (l_left || r_left) && !node.left_bends;
                let is_past_right = (r_right || l_right) && !node.right_bends;
                if (is_past_left && grazes(left)) || (is_past_right && grazes(right)) {
                    self.push(node.spent, node.root, edge, r, l, node.cell);
                }
            }
            // An edge may end in the bend itself, and then leads off from it to the other side.
            if (l_left || r_left) && node.left_bends {
                let from = if r_left { r } else { meet(at, left, r, l) };
                self.push_bent(node, left, edge, from, l);
            }
            if (r_right || l_right) && node.right_bends {
                let to = if l_right { l } else { meet(at, right, r, l) };
                self.push_bent(node, right, edge, r, to);
            }
        }
    }

    /// A root on the line of its stretch: it looks through, or slides along to the nearer end and bends there.
    fn expand_flat(&mut self, node: &SearchNode, at: Point, edges: &[Edge]) {
        let near = nearest_on_segment(at, node.right, node.left);
        let is_within = (near - at).norm() <= EPSILON.sqrt();
        for &edge in edges {
            if is_within {
                self.push(node.spent, node.root, edge, edge.right, edge.left, node.cell);
            } else {
                self.push_bent(node, near, edge, edge.right, edge.left);
            }
        }
    }

    /// A stretch that is seen only from the end `bend` of the last one.
    fn push_bent(&mut self, node: &SearchNode, bend: Point, edge: Edge, right: Point, left: Point) {
        if (left - right).norm_squared() <= EPSILON * EPSILON {
            return;
        }
        let at = self.root(node);
        let spent = node.spent + (bend - at).norm();
        if let Some(root) = self.reach(bend, spent, node.root) {
            self.push(spent, root, edge, right, left, node.cell);
        }
    }

    fn way(&self, last: &SearchNode) -> Way {
        let mut points = vec![self.goal];
        let mut root = last.root;
        while root != u32::MAX {
            let Root { at, parent, .. } = self.roots[root as usize];
            if points.last().is_none_or(|&p| (p - at).norm() > EPSILON) {
                points.push(at);
            }
            root = parent;
        }
        points.reverse();
        if points.len() == 1 {
            points.push(points[0]);
        }
        Way { length: length(&points), points }
    }
}

/// A quick hash of two coordinates; nobody outside chooses them to collide.
#[derive(Default)]
struct PlaceHasher(u64);

impl Hasher for PlaceHasher {
    fn write_u32(&mut self, word: u32) {
        self.write_u64(u64::from(word));
    }

    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x517c_c1b7_2722_0a95);
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&b| self.write_u64(u64::from(b)));
    }

    fn finish(&self) -> u64 {
        self.0.rotate_left(26)
    }
}

fn key(p: Point) -> (u64, u64) {
    (p.x.to_bits(), p.y.to_bits())
}

/// Length of the shortest way from `root` over the stretch to `goal`, whatever lies between.
fn through(root: Point, right: Point, left: Point, goal: Point) -> f64 {
    let over = |turn: Point| (turn - root).norm() + (goal - turn).norm();
    let along = left - right;
    let (root_side, goal_side) = (along.perp(&(root - right)), along.perp(&(goal - right)));
    if root_side.abs() <= EPSILON {
        return over(nearest_on_segment(root, right, left));
    }
    // A goal on the root's side is mirrored: the way must touch the stretch.
    let mirrored = if root_side * goal_side > 0.0 {
        let normal = nalgebra::Vector2::new(-along.y, along.x);
        goal - normal * (2.0 * goal_side / along.norm_squared())
    } else {
        goal
    };
    // Past which end the straight line goes; seen from behind, the ends change sides.
    let straight = mirrored - root;
    let past = |end: Point| straight.perp(&(end - root)) * root_side;
    if past(right) > 0.0 {
        over(right)
    } else if past(left) < 0.0 {
        over(left)
    } else {
        straight.norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square floor of so many cells a side, 10 cm each, and one cell by itself. Wherever cells meet a way is said to
    /// bend, as at the ends of doorways' lines.
    struct Squares(u32);

    impl Cells for Squares {
        fn edges(&self, (_, cell): CellKey, from: Option<CellKey>, found: &mut Vec<Edge>) {
            let side = self.0;
            if cell == side * side {
                return;
            }
            let (x, y) = (cell % side, cell / side);
            let corner =
                |dx: u32, dy: u32| Point::new(f64::from(x + dx) * 10.0, f64::from(y + dy) * 10.0);
            let beside = [
                ((0, 0), (1, 0), (y > 0).then(|| cell - side)),
                ((1, 0), (1, 1), (x + 1 < side).then(|| cell + 1)),
                ((1, 1), (0, 1), (y + 1 < side).then(|| cell + side)),
                ((0, 1), (0, 0), (x > 0).then(|| cell - 1)),
            ];
            for (right, left, to) in beside {
                if let Some(to) = to.filter(|&to| from != Some((0, to))) {
                    found.push(Edge {
                        right: corner(right.0, right.1),
                        left: corner(left.0, left.1),
                        right_bends: true,
                        left_bends: true,
                        to: (0, to),
                    });
                }
            }
        }

        fn only_edge(&self, _: CellKey, _: CellKey) -> Option<Edge> {
            None
        }
    }

    #[test]
    fn no_search_turns_round_a_corner_for_ever() {
        for side in [2, 3, 5, 8] {
            let apart = (0, side * side);
            // On a corner, on an edge, beside a corner by less than rounding, and within a cell.
            for at in
                [(10.0, 10.0), (10.0, 14.0), (10.0 + 1e-9, 10.0), (10.0, 10.0 - 1e-5), (14.0, 13.0)]
            {
                let start = Point::new(at.0, at.1);
                let mut search = Search::default();
                search.begin(start, Point::new(500.0, 500.0));
                assert!(search.run(&Squares(side), (0, 0), apart).is_none());
                let corners = (side as usize + 1).pow(2) + 1;
                let edges = 4 * (side as usize).pow(2);
                assert!(search.nodes.len() <= corners * edges, "{side}: {}", search.nodes.len());
            }
        }
    }

    #[test]
    fn a_way_from_a_corner_at_which_cells_meet_is_straight() {
        for (from, goal) in
            [(0, (73.0, 61.0)), (1, (75.0, 75.0)), (9, (15.0, 78.0)), (8, (80.0, 10.0))]
        {
            let (start, goal) = (Point::new(10.0, 10.0), Point::new(goal.0, goal.1));
            let cell = |v: f64| ((v / 10.0) as u32).min(7);
            let to = (0, cell(goal.y) * 8 + cell(goal.x));
            let way = shortest(&Squares(8), start, (0, from), goal, to).expect("one floor");
            assert!((way.length - (goal - start).norm()).abs() < 1e-6, "{}", way.length);
        }
    }
}
