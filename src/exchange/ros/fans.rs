//! Free cells that a laser saw through windows and doors, out of any room: *fans* of its rays.
//!
//! From within a room, walls are seen nearly all round; from a place outside of the building they are seen on one side at
//! most, and beyond the other the grid is unknown. So of each free cell it is asked in how many directions a wall ends
//! the view, and in how many what nobody has seen.

use super::grid::{Cell, Grid};

/// The directions in which is looked; each with the cells passed on the way to the next in that direction, so that no
/// wall of one cell is looked through.
const DIRECTIONS: [&[(i64, i64)]; 16] = [
    &[(1, 0)],
    &[(1, 0), (1, 1), (2, 1)],
    &[(1, 0), (0, 1), (1, 1)],
    &[(0, 1), (1, 1), (1, 2)],
    &[(0, 1)],
    &[(0, 1), (-1, 1), (-1, 2)],
    &[(-1, 0), (0, 1), (-1, 1)],
    &[(-1, 0), (-1, 1), (-2, 1)],
    &[(-1, 0)],
    &[(-1, 0), (-1, -1), (-2, -1)],
    &[(-1, 0), (0, -1), (-1, -1)],
    &[(0, -1), (-1, -1), (-1, -2)],
    &[(0, -1)],
    &[(0, -1), (1, -1), (1, -2)],
    &[(1, 0), (0, -1), (1, -1)],
    &[(1, 0), (1, -1), (2, -1)],
];
/// Of these directions so many must end at walls.
const ENCLOSED: u32 = 9;
/// cm. Over so much around a cell its neighbours have their say.
const AROUND: f64 = 50.0;
/// cm². Smaller spots of the unknown beside a wall or a thing are its shade.
const SHADE: f64 = 10_000.0;
/// A grid that shows walls along less of its free floor is no scan: what bounds its floor is all that bounds it.
const WALLED: f64 = 0.25;

/// Which free cells lie in no room, and how many; none where the grid shows too few walls to tell.
pub(super) fn fans(grid: &Grid, resolution: f64) -> Option<(Vec<bool>, usize)> {
    let is_free = |c: usize| grid.cells[c] == Cell::Free;
    let is_wall = walls(grid, (SHADE / (resolution * resolution)) as usize);
    let (mut border, mut walled) = (0_usize, 0_usize);
    for cell in (0..grid.cells.len()).filter(|c| is_free(*c)) {
        for next in grid.beside(cell).filter(|n| !is_free(*n)) {
            border += 1;
            walled += usize::from(is_wall[next]);
        }
    }
    if (walled as f64) < WALLED * border as f64 {
        return None;
    }
    let seen = walls_seen(grid, &is_wall);
    let reach = (AROUND / resolution).round().max(1.0) as usize;
    let (sum, count) = (sums(grid, |c| u64::from(seen[c])), sums(grid, |c| u64::from(is_free(c))));
    let mut found = vec![false; grid.cells.len()];
    let mut how_many = 0;
    for cell in (0..grid.cells.len()).filter(|c| is_free(*c)) {
        let (walls, cells) = (around(grid, &sum, cell, reach), around(grid, &count, cell, reach));
        found[cell] = walls < u64::from(ENCLOSED) * cells;
        how_many += usize::from(found[cell]);
    }
    Some((found, how_many))
}

/// What ends a view for good: walls and things, and the shade behind them.
fn walls(grid: &Grid, shade: usize) -> Vec<bool> {
    let is = |c: usize, what: Cell| grid.cells[c] == what;
    let (label, sizes) = grid.components(|c| is(c, Cell::Unknown));
    let mut touches = vec![false; sizes.len()];
    for cell in (0..grid.cells.len()).filter(|c| label[*c] != u32::MAX) {
        let spot = label[cell] as usize;
        touches[spot] |= grid.beside(cell).any(|n| is(n, Cell::Occupied));
    }
    let is_shade = |l: u32| l != u32::MAX && touches[l as usize] && sizes[l as usize] <= shade;
    (0..grid.cells.len()).map(|c| is(c, Cell::Occupied) || is_shade(label[c])).collect()
}

/// For every free cell, in how many directions a wall ends the view.
fn walls_seen(grid: &Grid, is_wall: &[bool]) -> Vec<u8> {
    let mut seen = vec![0_u8; grid.cells.len()];
    let mut ends = vec![false; grid.cells.len()];
    for steps in DIRECTIONS {
        let &(dx, dy) = steps.last().expect("every direction has a step");
        // Every cell after the one that lies before it in this direction.
        let forwards = dy < 0 || (dy == 0 && dx < 0);
        for n in 0..grid.cells.len() {
            let cell = if forwards { n } else { grid.cells.len() - 1 - n };
            if grid.cells[cell] != Cell::Free {
                continue;
            }
            let (x, y) = grid.xy(cell);
            let mut end = None;
            for &(sx, sy) in steps {
                end = match grid.at(x + sx, y + sy) {
                    None => Some(false),
                    Some(next) if is_wall[next] => Some(true),
                    Some(next) if grid.cells[next] == Cell::Unknown => Some(false),
                    Some(_) => continue,
                };
                break;
            }
            let next = || grid.at(x + dx, y + dy).is_some_and(|next| ends[next]);
            ends[cell] = end.unwrap_or_else(next);
            seen[cell] += u8::from(ends[cell]);
        }
    }
    seen
}

/// Sums over all rectangles from the lower left corner, one row and column more than the grid.
fn sums(grid: &Grid, of: impl Fn(usize) -> u64) -> Vec<u64> {
    let wide = grid.width + 1;
    let mut sum = vec![0; wide * (grid.height + 1)];
    for y in 0..grid.height {
        let mut row = 0;
        for x in 0..grid.width {
            row += of(y * grid.width + x);
            sum[(y + 1) * wide + x + 1] = sum[y * wide + x + 1] + row;
        }
    }
    sum
}

/// The sum over the square around a cell.
fn around(grid: &Grid, sum: &[u64], cell: usize, reach: usize) -> u64 {
    let (x, y) = (cell % grid.width, cell / grid.width);
    let (x0, y0) = (x.saturating_sub(reach), y.saturating_sub(reach));
    let (x1, y1) = ((x + reach + 1).min(grid.width), (y + reach + 1).min(grid.height));
    let at = |x: usize, y: usize| sum[y * (grid.width + 1) + x];
    at(x1, y1) + at(x0, y0) - at(x0, y1) - at(x1, y0)
}
