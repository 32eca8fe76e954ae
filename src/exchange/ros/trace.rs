//! The border of a region of cells → a ring of straight walls.

use crate::units::{InOrder as _, Point, Vector};

use super::grid::Grid;
use crate::geometry::nearest_on_segment;
use crate::outline;

/// A border may stray from its wall by this, in cells.
const STRAY: f64 = 2.2;
/// Edges within this of the region's main directions run along them.
const SNAP: f64 = 14.0;

/// The rings around the cells of one label, as corners of the grid's lines: the outer one first, counter-clockwise.
pub(super) fn rings(
    grid: &Grid,
    label: &[u32],
    wanted: u32,
    start_cells: &[usize],
) -> Vec<Vec<(i64, i64)>> {
    let is = |x: i64, y: i64| grid.at(x, y).is_some_and(|c| label[c] == wanted);
    // Unit steps along cell sides that have the region on their left.
    let mut seen = std::collections::HashSet::new();
    let mut found: Vec<Vec<(i64, i64)>> = Vec::new();
    for &cell in start_cells {
        let (x, y) = grid.xy(cell);
        // The lower side of a cell whose lower neighbour is outside runs to the right.
        if is(x, y - 1) || seen.contains(&((x, y), (1, 0))) {
            continue;
        }
        let (mut at, mut way) = ((x, y), (1_i64, 0_i64));
        let mut ring = Vec::new();
        while seen.insert((at, way)) {
            if ring.len() < 2 || !straight(&ring, at) {
                ring.push(at);
            } else if let Some(last) = ring.last_mut() {
                *last = at;
            }
            at = (at.0 + way.0, at.1 + way.1);
            // Cells ahead: on the left and on the right of the way.
            let left = (at.0 + (way.0 - way.1 - 1) / 2, at.1 + (way.1 + way.0 - 1) / 2);
            let right = (at.0 + (way.0 + way.1 - 1) / 2, at.1 + (way.1 - way.0 - 1) / 2);
            way = match (is(left.0, left.1), is(right.0, right.1)) {
                // Two cells that touch at a corner only are not one region.
                (false, _) => (-way.1, way.0),
                (true, false) => way,
                (true, true) => (way.1, -way.0),
            };
        }
        found.push(ring);
    }
    let twice = |r: &Vec<(i64, i64)>| -> i64 {
        r.iter().zip(r.iter().cycle().skip(1)).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum()
    };
    found.order_by_key(|r| std::cmp::Reverse(twice(r)));
    found
}

/// Whether the last step of a ring goes on to `at` without a turn.
fn straight(ring: &[(i64, i64)], at: (i64, i64)) -> bool {
    let (a, b) = (ring[ring.len() - 2], ring[ring.len() - 1]);
    (b.0 - a.0) * (at.1 - b.1) == (b.1 - a.1) * (at.0 - b.0)
}

/// A ring of straight walls near a border: thinned, squared to its own main directions where it follows them, rid of
/// jogs and of niches shallower than `shallow` cells.
pub(super) fn walls(border: &[(i64, i64)], shallow: f64) -> Vec<Point> {
    let ring: Vec<Point> = border.iter().map(|p| Point::new(p.0 as f64, p.1 as f64)).collect();
    let thin = thinned(&ring);
    let Some(main) = main_direction(&thin) else { return thin };
    let squared = squared(&thin, main, shallow);
    // A shape that squaring spoils is better left as it was traced.
    let whole = outline::area(&ring).abs();
    let kept = (outline::area(&squared).abs() - whole).abs() <= 0.15 * whole + 8.0;
    if squared.len() >= 3 && kept && is_simple(&squared) { squared } else { thin }
}

/// Douglas and Peucker's thinning of a closed ring.
fn thinned(ring: &[Point]) -> Vec<Point> {
    if ring.len() < 4 {
        return ring.to_vec();
    }
    let far = |from: Point| {
        let d = |i: &usize| (ring[*i] - from).norm_squared();
        (0..ring.len()).max_by(|a, b| d(a).total_cmp(&d(b))).unwrap_or(0)
    };
    let first = far(ring[0]);
    let second = far(ring[first]);
    let (low, high) = (first.min(second), first.max(second));
    let mut kept = vec![false; ring.len()];
    kept[low] = true;
    kept[high] = true;
    let mut open = vec![(low, high), (high, low + ring.len())];
    while let Some((a, b)) = open.pop() {
        let at = |i: usize| ring[i % ring.len()];
        let off = |i: &usize| (nearest_on_segment(at(*i), at(a), at(b)) - at(*i)).norm();
        let worst = (a + 1..b).max_by(|x, y| off(x).total_cmp(&off(y)));
        if let Some(worst) = worst.filter(|w| off(w) > STRAY) {
            kept[worst % ring.len()] = true;
            open.extend([(a, worst), (worst, b)]);
        }
    }
    ring.iter().zip(kept).filter(|(_, k)| *k).map(|(p, _)| *p).collect()
}

/// The direction, modulo a right angle, that most of the edges' length runs along.
fn main_direction(ring: &[Point]) -> Option<f64> {
    // Fourfold angles make the four directions one.
    let sum = outline::edges(ring).fold((0.0, 0.0), |(x, y), (a, b)| {
        let v = b - a;
        let (sin, cos) = (4.0 * v.y.atan2(v.x)).sin_cos();
        (x + v.norm() * cos, y + v.norm() * sin)
    });
    let length: f64 = outline::edges(ring).map(|(a, b)| (b - a).norm()).sum();
    (sum.0.hypot(sum.1) > 0.3 * length).then(|| sum.1.atan2(sum.0) / 4.0)
}

/// A wall: the line `normal · p = offset`, and how long it was.
#[derive(Debug, Clone, Copy)]
struct Wall {
    /// 0, 1: along the main directions; none: as it was.
    axis: Option<u8>,
    normal: Vector,
    offset: f64,
    length: f64,
}

fn squared(ring: &[Point], main: f64, shallow: f64) -> Vec<Point> {
    let (sin, cos) = main.sin_cos();
    let axes = [Vector::new(cos, sin), Vector::new(-sin, cos)];
    let wall = |(a, b): (Point, Point)| {
        let v = b - a;
        let middle = a + v / 2.0;
        let along = |axis: &Vector| v.dot(axis).abs() >= v.norm() * SNAP.to_radians().cos();
        let axis = axes.iter().position(along);
        let normal = match axis {
            Some(0) => axes[1],
            Some(_) => axes[0],
            None => Vector::new(-v.y, v.x).normalize(),
        };
        let offset = normal.dot(&middle.coords);
        Wall { axis: axis.map(|a| a as u8), normal, offset, length: v.norm() }
    };
    let mut walls: Vec<Wall> = outline::edges(ring).filter(|(a, b)| a != b).map(wall).collect();
    loop {
        merge_parallel(&mut walls);
        // The shortest step between two walls of one direction that lie near each other is a jog or a niche's side.
        let n = walls.len();
        if n < 5 {
            break;
        }
        let step = |i: &usize| {
            let (before, after) = (walls[(i + n - 1) % n], walls[(i + 1) % n]);
            let parallel = before.axis.is_some() && before.axis == after.axis;
            let jog = (before.offset - after.offset).abs();
            (parallel && walls[*i].axis != before.axis && jog <= shallow).then_some(jog)
        };
        let Some(worst) = (0..n)
            .filter(|i| step(i).is_some())
            .min_by(|a, b| step(a).unwrap_or(0.0).total_cmp(&step(b).unwrap_or(0.0)))
        else {
            break;
        };
        // The longer of the two walls goes on.
        let (b, a) = ((worst + n - 1) % n, (worst + 1) % n);
        let (keep, give) = if walls[b].length >= walls[a].length { (b, a) } else { (a, b) };
        walls[keep].length += walls[give].length;
        let gone = [worst, give];
        let mut index = 0..;
        walls.retain(|_| !gone.contains(&index.next().unwrap_or(0)));
    }
    let n = walls.len();
    let meet = |i: usize| {
        let (a, b) = (walls[i], walls[(i + 1) % n]);
        let det = a.normal.perp(&b.normal);
        (det.abs() > 0.05).then(|| {
            Point::new(
                (a.offset * b.normal.y - b.offset * a.normal.y) / det,
                (a.normal.x * b.offset - b.normal.x * a.offset) / det,
            )
        })
    };
    (0..n).filter_map(meet).collect()
}

/// Neighbouring walls of one direction become one, at the mean of their places weighted by length.
fn merge_parallel(walls: &mut Vec<Wall>) {
    let mut at = 0;
    while walls.len() > 3 && at < walls.len() {
        let next = (at + 1) % walls.len();
        let (a, b) = (walls[at], walls[next]);
        if a.axis.is_some() && a.axis == b.axis {
            let length = a.length + b.length;
            let offset = (a.offset * a.length + b.offset * b.length) / length;
            walls[at] = Wall { offset, length, ..a };
            walls.remove(next);
            at = at.saturating_sub(1);
        } else {
            at += 1;
        }
    }
}

fn is_simple(ring: &[Point]) -> bool {
    let n = ring.len();
    if n > 600 {
        return false;
    }
    let side = |a: Point, b: Point, p: Point| (b - a).perp(&(p - a));
    let cross = |i: usize, j: usize| {
        let (a, b, c, d) = (ring[i], ring[(i + 1) % n], ring[j], ring[(j + 1) % n]);
        side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
    };
    (0..n).all(|i| (i + 2..n).filter(|j| (j + 1) % n != i).all(|j| !cross(i, j)))
}

#[cfg(test)]
mod tests {
    use super::super::grid::Cell;
    use super::*;

    /// Rows from the top, `#` in the region.
    fn border(rows: &[&str]) -> Vec<Vec<(i64, i64)>> {
        let (width, height) = (rows[0].len(), rows.len());
        let label: Vec<u32> = rows
            .iter()
            .rev()
            .flat_map(|r| r.bytes().map(|b| if b == b'#' { 1 } else { 0 }))
            .collect();
        let grid = Grid { width, height, cells: vec![Cell::Free; width * height] };
        let cells: Vec<usize> = (0..label.len()).filter(|c| label[*c] == 1).collect();
        rings(&grid, &label, 1, &cells)
    }

    #[test]
    fn the_border_runs_around_the_cells_and_their_holes() {
        let rings = border(&["####", "#..#", "####", "##.."]);
        assert_eq!(rings.len(), 2);
        let area = |r: &[(i64, i64)]| -> i64 {
            r.iter().zip(r.iter().cycle().skip(1)).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum::<i64>()
                / 2
        };
        assert_eq!((area(&rings[0]), area(&rings[1])), (14, -2));
    }

    #[test]
    fn a_ragged_room_gets_straight_walls() {
        // 40 by 30 cells, with teeth of one cell and a niche of two.
        let mut rows = vec![vec![b'.'; 46]; 36];
        for (y, row) in rows.iter_mut().enumerate().take(33).skip(3) {
            for (x, cell) in row.iter_mut().enumerate().take(43).skip(3) {
                let tooth = x == 3 && y % 3 == 0 || y == 3 && x % 4 == 0;
                *cell = if tooth { b'.' } else { b'#' };
            }
        }
        for row in rows.iter_mut().take(20).skip(12) {
            row[43] = b'#';
            row[44] = b'#';
        }
        let text: Vec<String> = rows.into_iter().map(|r| String::from_utf8(r).unwrap()).collect();
        let rings = border(&text.iter().map(String::as_str).collect::<Vec<_>>());
        let walls = walls(&rings[0], 4.0);
        assert_eq!(walls.len(), 4, "{walls:?}");
        assert!((outline::area(&walls).abs() - 1200.0).abs() < 60.0);
    }
}
