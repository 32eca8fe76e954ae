//! A way along a chain of cells, pulled taut: what stands in for the search over intervals, should that find none.
//!
//! Which cells hang together is asked of the cells alone, without one measured angle; so there is no way only where no chain
//! of cells leads from the start to the goal, whatever rounding does to sight lines.
//!
//! **Invariant**: a way lies in the cells of its chain and is the shortest there; through other cells there may be a shorter.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use crate::units::Point;

use super::cells::{CellKey, Cells, Edge, side};
use super::nearest_on_segment;

/// The taut way along a short chain of cells; none where no chain leads to the goal's cell.
pub(super) fn along_cells(
    cells: &impl Cells,
    start: Point,
    from: CellKey,
    goal: Point,
    to: CellKey,
) -> Option<Vec<Point>> {
    let mut doors: Vec<(Point, Point)> =
        chain(cells, start, from, goal, to)?.iter().map(|e| (e.right, e.left)).collect();
    doors.push((goal, goal));
    Some(pull(start, &doors))
}

/// The edges that lead from cell to cell, by the way that goes to the nearest place of each next edge.
fn chain(
    cells: &impl Cells,
    start: Point,
    from: CellKey,
    goal: Point,
    to: CellKey,
) -> Option<Vec<Edge>> {
    /// How a cell was reached.
    struct Reached {
        spent: f64,
        at: Point,
        over: Option<(CellKey, Edge)>,
    }
    let mut reached = HashMap::from([(from, Reached { spent: 0.0, at: start, over: None })]);
    let mut open = BinaryHeap::from([Reverse((0, 0, from))]);
    let mut edges = Vec::new();
    while let Some(Reverse((_, told, cell))) = open.pop() {
        let Reached { spent, at, over } = &reached[&cell];
        if cell == to {
            break;
        }
        // Reached anew by a shorter way since it was put there.
        if spent.to_bits() < told {
            continue;
        }
        let (spent, at) = (*spent, *at);
        edges.clear();
        cells.edges(cell, over.map(|o| o.0), &mut edges);
        for &edge in &edges {
            let next = nearest_on_segment(at, edge.right, edge.left);
            let spent = spent + (next - at).norm();
            if reached.get(&edge.to).is_none_or(|known| spent < known.spent) {
                let bound = spent + (goal - next).norm();
                reached.insert(edge.to, Reached { spent, at: next, over: Some((cell, edge)) });
                open.push(Reverse((bound.to_bits(), spent.to_bits(), edge.to)));
            }
        }
    }
    let mut back = reached.get(&to)?;
    let mut chain = Vec::new();
    while let Some((before, edge)) = back.over {
        chain.push(edge);
        back = &reached[&before];
    }
    chain.reverse();
    Some(chain)
}

/// The shortest way through doors one after the other, each given by its right and its left end; the last is the goal.
///
/// A funnel of what is seen from the last bend narrows from door to door; where its sides cross the way bends.
fn pull(start: Point, doors: &[(Point, Point)]) -> Vec<Point> {
    let mut points = vec![start];
    let (mut apex, mut right, mut left) = (start, start, start);
    // The doors that the funnel's sides are of.
    let (mut right_door, mut left_door) = (0, 0);
    let mut door = 0;
    while let Some(&(r, l)) = doors.get(door) {
        if side(apex, right, r) >= 0.0 {
            if apex == right || side(apex, left, r) < 0.0 {
                (right, right_door) = (r, door);
            } else {
                points.push(left);
                (apex, right, right_door) = (left, left, left_door);
                door = left_door + 1;
                continue;
            }
        }
        if side(apex, left, l) <= 0.0 {
            if apex == left || side(apex, right, l) > 0.0 {
                (left, left_door) = (l, door);
            } else {
                points.push(right);
                (apex, left, left_door) = (right, right, right_door);
                door = right_door + 1;
                continue;
            }
        }
        door += 1;
    }
    points.extend(doors.last().map(|d| d.0));
    points.dedup_by(|a, b| (*a - *b).norm() < 1e-7);
    if points.len() == 1 {
        points.push(points[0]);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::super::network::overlap;
    use super::super::search::{length, seen};
    use super::*;

    /// Rooms of squares, some of them solid, cut into Fragments whose corners differ by so much as their grids are coarse.
    struct Maze {
        side: u32,
        /// The Fragment of each square; none of a solid one.
        fragment: Vec<Option<u32>>,
        turn: f64,
        grain: f64,
    }

    impl Maze {
        fn of(side: u32, grain: f64, random: &mut impl FnMut() -> f64) -> Self {
            let walls = 0.1 + 0.4 * random();
            let (across, down) = (1 + (random() * 4.0) as u32, 1 + (random() * 4.0) as u32);
            let fragment = (0..side * side)
                .map(|n| {
                    let number = n % side / across + n / side / down * side;
                    (random() > walls).then_some(number)
                })
                .collect();
            Self { side, fragment, turn: random(), grain }
        }

        fn at(&self, x: i64, y: i64) -> Option<u32> {
            let side = i64::from(self.side);
            let is_in = (0..side).contains(&x) && (0..side).contains(&y);
            is_in.then(|| self.fragment[(y * side + x) as usize]).flatten()
        }

        /// A place as a Fragment knows it.
        fn place(&self, fragment: u32, x: f64, y: f64) -> Point {
            let off = |k: u32| f64::from((fragment * 7 + k) % 5) / 2.0 - 1.0;
            let p = Point::new(10.0 * x + self.grain * off(0), 10.0 * y + self.grain * off(3));
            nalgebra::Rotation2::new(self.turn) * p
        }

        /// Whether a Fragment's own floor turns inwards at a corner.
        fn is_corner(&self, fragment: u32, x: i64, y: i64) -> bool {
            let around = [(0, 0), (-1, 0), (-1, -1), (0, -1)];
            let at = |k: usize| self.at(x + around[k % 4].0, y + around[k % 4].1);
            // Or where a doorway's line ends: see `Mesh::bend_at`.
            let is_mouth = |k| {
                let (one, other) = (at(k), at(k + 1));
                one != other
                    && [one, other].contains(&Some(fragment))
                    && one.is_some()
                    && other.is_some()
            };
            (0..4).filter(|&k| at(k) == Some(fragment)).count() == 3 || (0..4).any(is_mouth)
        }

        fn key(&self, x: i64, y: i64) -> Option<CellKey> {
            Some((self.at(x, y)?, (y * i64::from(self.side) + x) as u32))
        }
    }

    impl Cells for Maze {
        fn edges(&self, (own, cell): CellKey, from: Option<CellKey>, found: &mut Vec<Edge>) {
            let (x, y) = (i64::from(cell % self.side), i64::from(cell / self.side));
            let around = [(0, -1), (1, 0), (0, 1), (-1, 0)];
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
            for k in 0..4 {
                let next = self.key(x + around[k].0, y + around[k].1);
                let Some(to) = next.filter(|&to| from != Some(to)) else { continue };
                let ends = [corners[k], corners[(k + 1) % 4]].map(|c| (x + c.0, y + c.1));
                let of = |fragment: u32| {
                    let [a, b] = ends.map(|c| self.place(fragment, c.0 as f64, c.1 as f64));
                    (a, b)
                };
                if to.0 == own {
                    let (right, left) = of(own);
                    let [right_bends, left_bends] = ends.map(|c| self.is_corner(own, c.0, c.1));
                    found.push(Edge { right, left, right_bends, left_bends, to });
                } else if let Some((right, left)) = overlap(of(own), of(to.0)) {
                    found.push(Edge { right, left, right_bends: true, left_bends: true, to });
                }
            }
        }

        fn only_edge(&self, cell: CellKey, from: CellKey) -> Option<Edge> {
            let mut found = Vec::new();
            self.edges(cell, Some(from), &mut found);
            match found[..] {
                [only] => Some(only),
                _ => None,
            }
        }
    }

    #[test]
    fn a_way_is_found_wherever_cells_hang_together() {
        let mut seed = 24_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for round in 0..300 {
            let grain = [0.0, 1e-9, 1e-6, 1e-5][round % 4];
            let maze = Maze::of(3 + (random() * 6.0) as u32, grain, &mut random);
            let side = i64::from(maze.side);
            let free: Vec<(i64, i64, CellKey)> = (0..side * side)
                .filter_map(|n| Some((n % side, n / side, maze.key(n % side, n / side)?)))
                .collect();
            for _ in 0..if free.is_empty() { 0 } else { 20 } {
                let mut pick = || {
                    let (x, y, key) = free[(random() * free.len() as f64) as usize];
                    // In the cell, on its edges and on its corners.
                    let mut part = || (random() * 5.0).floor() / 4.0;
                    (maze.place(key.0, x as f64 + part(), y as f64 + part()), key)
                };
                let ((start, from), (goal, to)) = (pick(), pick());
                let told = || format!("{round}: {from:?} {start} – {to:?} {goal}");
                let there = seen(&maze, start, from, goal, to).map(|way| way.length);
                let back = seen(&maze, goal, to, start, from).map(|way| way.length);
                let chain = along_cells(&maze, start, from, goal, to);
                assert_eq!(there.is_some(), chain.is_some(), "{}", told());
                assert_eq!(back.is_some(), chain.is_some(), "{}", told());
                if let (Some(there), Some(back), Some(chain)) = (there, back, chain) {
                    assert!((there - back).abs() < 1e-3, "{}: {there} {back}", told());
                    assert!(there < length(&chain) + 1e-3, "{}: {there} {chain:?}", told());
                }
            }
        }
    }
}
