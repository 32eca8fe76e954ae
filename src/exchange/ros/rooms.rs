//! Free floor → rooms, doorways between them, islands in them.
//!
//! 1. What stands free in a room, smaller than a wall, is set aside as a thing.
//! 2. The floor is cut at its doorways; what is connected then is a room. A cut that leaves a piece too small for a
//!    room is taken back.
//!
//! **Invariant**: equal grids give equal rooms in equal order: by their lowest, leftmost cell.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use crate::geometry::convex_hull;
use crate::map::{Permeability, Properties};
use crate::units::{Cm, Deg, Gather as _, Point, Vector, said};
use crate::{Kind, Level, Opening, OpeningKind, Part, Remark, Room, Thing, outline};

use super::Sheet;
use super::doorways::{Cut, doorways};
use super::fans::fans;
use super::grid::{Cell, Grid, corner};
use super::trace;

/// cm². A smaller piece of floor is no room but a part of its neighbour.
const SMALLEST_ROOM: f64 = 12_000.0;
/// cm². A smaller piece of floor that nothing joins is noise.
const SMALLEST_PIECE: f64 = 10_000.0;
/// cm². Larger islands are walls, shafts and courtyards.
const LARGEST_THING: f64 = 60_000.0;
/// cm². Smaller islands are noise of the sensor.
const SMALLEST_THING: f64 = 150.0;
/// Cells. A smaller piece beside a cut is a pocket of it.
const POCKET: usize = 40;
/// cm. Niches shallower than this are levelled.
const SHALLOW: f64 = 30.0;
/// cm. What is this long and this thin may be a wall.
const LONG: f64 = 180.0;
const THICK: f64 = 30.0;
/// A thing of a grid is known by its print only.
const THING_HEIGHT: f64 = 75.0;
const MOST_THINGS: usize = 5_000;

/// Fills a level with rooms, openings and things; the kinds of the things are returned.
pub(super) fn furnish(
    grid: &Grid,
    sheet: &Sheet,
    level: &mut Level,
    remarks: &mut Vec<Remark>,
) -> Vec<Kind> {
    let cell_area = sheet.resolution * sheet.resolution;
    let mut free: Vec<bool> = grid.cells.iter().map(|c| *c == Cell::Free).collect();
    if let Some((fans, count)) = fans(grid, sheet.resolution)
        && count > 0
    {
        free.iter_mut().zip(fans).for_each(|(free, is_fan)| *free &= !is_fan);
        let area = count as f64 * cell_area / 1e4;
        let text = said!("floor-outside-of-the-walls", area = format!("{area:.0}"));
        remarks.push(Remark { source: String::new(), text });
    }
    let islands = islands(grid, &mut free, cell_area);
    let noise = drop_pieces(grid, &mut free, (SMALLEST_PIECE / cell_area) as usize);
    if noise > 0 {
        let text = said!("scraps-of-free-floor-under", noise);
        remarks.push(Remark { source: String::new(), text });
    }
    let distances = grid.distances(&free);
    let cuts = doorways(grid, sheet, &free, &distances);
    drop(distances);
    let (label, sizes, cuts) = cut(grid, &free, cuts, (SMALLEST_ROOM / cell_area) as usize);
    rooms(grid, sheet, &label, &sizes, level);
    openings(grid, sheet, &label, &cuts, level);
    let (kinds, left) = things(grid, sheet, &label, &islands, level);
    if left > 0 {
        let text = said!("there-are-more-than-islands", limit = MOST_THINGS, left);
        remarks.push(Remark { source: String::new(), text });
    }
    kinds
}

/// Groups of cells that are not free and touch neither the border nor an outer wall, with their cells. They become
/// free, but for those that may be walls between doorways: long and thin.
fn islands(grid: &Grid, free: &mut [bool], cell_area: f64) -> Vec<Vec<usize>> {
    let (label, sizes) = grid.components(|c| !free[c]);
    let most = (LARGEST_THING / cell_area) as usize;
    let mut is_island: Vec<bool> = sizes.iter().map(|s| *s <= most).collect();
    let (w, h) = (grid.width, grid.height);
    let border = (0..w).flat_map(|x| [x, (h - 1) * w + x]);
    for cell in border.chain((0..h).flat_map(|y| [y * w, y * w + w - 1])) {
        if label[cell] != u32::MAX {
            is_island[label[cell] as usize] = false;
        }
    }
    let mut found = BTreeMap::<u32, Vec<usize>>::new();
    for cell in 0..free.len() {
        if label[cell] != u32::MAX && is_island[label[cell] as usize] {
            found.entry(label[cell]).or_default().push(cell);
        }
    }
    let size = cell_area.sqrt();
    for cells in found.values().filter(|cells| !is_wall(grid, cells, size)) {
        cells.iter().for_each(|cell| free[*cell] = true);
    }
    let least = (SMALLEST_THING / cell_area).ceil() as usize;
    found.into_values().filter(|cells| cells.len() >= least.max(2)).collect()
}

/// Longer than [`LONG`] and, by its area over half of its border, no thicker than [`THICK`].
fn is_wall(grid: &Grid, cells: &[usize], size: f64) -> bool {
    let own: HashSet<usize> = cells.iter().copied().collect();
    let border: usize =
        cells.iter().map(|c| 4 - grid.beside(*c).filter(|n| own.contains(n)).count()).sum();
    let places: Vec<Point> =
        cells.iter().map(|c| grid.xy(*c)).map(|(x, y)| Point::new(x as f64, y as f64)).collect();
    let (low, high) = outline::bounds(&places);
    let thick = cells.len() as f64 * 2.0 / border.max(1) as f64;
    (high - low).amax() * size >= LONG && thick * size <= THICK
}

/// Pieces of floor smaller than this are no floor. How many there were.
fn drop_pieces(grid: &Grid, free: &mut [bool], least: usize) -> usize {
    let (label, sizes) = grid.components(|c| free[c]);
    for cell in 0..free.len() {
        if label[cell] != u32::MAX && sizes[label[cell] as usize] < least {
            free[cell] = false;
        }
    }
    sizes.iter().filter(|s| **s < least).count()
}

/// Cuts the floor and takes back the cuts that leave a piece too small for a room.
fn cut(
    grid: &Grid,
    free: &[bool],
    mut cuts: Vec<Cut>,
    least: usize,
) -> (Vec<u32>, Vec<usize>, Vec<Cut>) {
    // Each round takes back at least one cut of every piece that is too small.
    for _ in 0..8 {
        let (label, sizes) = pieces(grid, free, &cuts);
        let mut back = BTreeSet::new();
        for (piece, _) in sizes.iter().enumerate().filter(|(_, s)| **s < least) {
            let beside = cuts.iter().enumerate().filter(|(_, cut)| {
                cut.cells.iter().flat_map(|c| grid.beside(*c)).any(|n| label[n] == piece as u32)
            });
            back.extend(beside.max_by_key(|(_, cut)| cut.cells.len()).map(|(no, _)| no));
        }
        if back.is_empty() {
            return (label, sizes, cuts);
        }
        let mut no = 0..;
        cuts.retain(|_| !back.contains(&no.next().unwrap_or(0)));
    }
    let (label, sizes) = pieces(grid, free, &cuts);
    (label, sizes, cuts)
}

/// Pieces of the floor between the cuts, numbered by their lowest, leftmost cell, and their sizes.
///
/// The cells of a cut, and the pockets that a slanting cut leaves along a wall, go to a piece beside them, so that the
/// rooms meet in the doorway.
fn pieces(grid: &Grid, free: &[bool], cuts: &[Cut]) -> (Vec<u32>, Vec<usize>) {
    let mut is_cut = vec![false; free.len()];
    for cell in cuts.iter().flat_map(|c| &c.cells) {
        is_cut[*cell] = true;
    }
    let (raw, raw_sizes) = grid.components(|c| free[c] && !is_cut[c]);
    let mut number = vec![u32::MAX; raw_sizes.len()];
    let mut sizes = Vec::new();
    for (piece, size) in raw_sizes.iter().enumerate().filter(|(_, size)| **size >= POCKET) {
        number[piece] = sizes.len() as u32;
        sizes.push(*size);
    }
    let named = |piece: u32| number.get(piece as usize).copied().unwrap_or(u32::MAX);
    let mut label: Vec<u32> = raw.into_iter().map(named).collect();
    // Outwards from what has a number, ring by ring.
    let lost = |label: &[u32], c: usize| free[c] && label[c] == u32::MAX;
    let mut open: Vec<usize> = (0..free.len()).filter(|c| lost(&label, *c)).collect();
    while !open.is_empty() {
        let beside = |c: usize| grid.beside(c).map(|n| label[n]).filter(|l| *l != u32::MAX).min();
        let found: Vec<(usize, u32)> =
            open.iter().filter_map(|c| Some((*c, beside(*c)?))).collect();
        if found.is_empty() {
            break;
        }
        for (cell, room) in found {
            label[cell] = room;
            sizes[room as usize] += 1;
        }
        open.retain(|c| lost(&label, *c));
    }
    (label, sizes)
}

fn rooms(grid: &Grid, sheet: &Sheet, label: &[u32], sizes: &[usize], level: &mut Level) {
    let mut cells = vec![Vec::new(); sizes.len()];
    for (cell, room) in label.iter().enumerate().filter(|(_, l)| **l != u32::MAX) {
        // Only cells at a lower border can begin a ring.
        if cell < grid.width || label[cell - grid.width] != *room {
            cells[*room as usize].push(cell);
        }
    }
    for (no, starts) in cells.iter().enumerate() {
        let rings = trace::rings(grid, label, no as u32, starts);
        let plan = |ring: &Vec<(i64, i64)>| {
            let walls = trace::walls(ring, SHALLOW / sheet.resolution);
            outline::ring(walls.iter().map(|p| corner(sheet, p.x, p.y)))
        };
        let outer = rings.first().and_then(plan).unwrap_or_default();
        let large = |h: &Vec<Point>| outline::area(h).abs() > LARGEST_THING;
        let holes = rings.iter().skip(1).filter_map(plan).filter(large).collect();
        level.rooms.push(Room {
            source: format!("room-{}", no + 1),
            name: String::new(),
            kind: if is_corridor(&outer) { "corridor" } else { "room" }.to_owned(),
            called: String::new(),
            outline: outer,
            holes,
            height: None,
            properties: Properties::new(),
        });
    }
}

/// Long and narrow: four times as long as wide on the mean, and no wider than three metres.
fn is_corridor(ring: &[Point]) -> bool {
    let around: f64 = outline::edges(ring).map(|(a, b)| (b - a).norm()).sum();
    let area = outline::area(ring).abs();
    // A rectangle's width w and length l: w + l = around / 2, w·l = area.
    let half = around / 4.0;
    let root = (half * half - area).max(0.0).sqrt();
    let (width, length) = (half - root, half + root);
    width <= 300.0 && length >= 4.0 * width
}

/// An opening for every cut that has two rooms beside it.
fn openings(grid: &Grid, sheet: &Sheet, label: &[u32], cuts: &[Cut], level: &mut Level) {
    for cut in cuts {
        let [a, b] = cut.jambs;
        let along = Vector::new(b.0 - a.0, b.1 - a.1);
        let Some(along) = along.try_normalize(1e-9) else { continue };
        let middle = (a.0.midpoint(b.0), a.1.midpoint(b.1));
        let room = |way: f64| {
            let steps = (3..40).map(|n| f64::from(n) * 0.5);
            steps.map(|s| (middle.0 - along.y * way * s, middle.1 + along.x * way * s)).find_map(
                |p| {
                    let cell = grid.at(p.0.round() as i64, p.1.round() as i64)?;
                    Some(label[cell]).filter(|l| *l != u32::MAX)
                },
            )
        };
        let (Some(left), Some(right)) = (room(1.0), room(-1.0)) else { continue };
        if left == right {
            continue;
        }
        // The jambs are the faces of the walls, half a cell before the middles of their cells.
        let face = |p: (f64, f64), way: f64| {
            corner(sheet, p.0 + 0.5 + along.x * way * 0.5, p.1 + 0.5 + along.y * way * 0.5)
        };
        level.openings.push(Opening {
            source: format!("gap-{}", level.openings.len() + 1),
            name: String::new(),
            what: OpeningKind::Passage,
            // From the room on the right of the way from a to b, b is the right jamb.
            jambs: [face(b, -1.0), face(a, 1.0)],
            rooms: Some([Some(right as usize), Some(left as usize)]),
            height: None,
            sill: Cm::ZERO,
            properties: Properties::new(),
        });
    }
}

fn things(
    grid: &Grid,
    sheet: &Sheet,
    label: &[u32],
    islands: &[Vec<usize>],
    level: &mut Level,
) -> (Vec<Kind>, usize) {
    let mut kinds = Vec::new();
    for island in islands.iter().take(MOST_THINGS) {
        // Of a wall between rooms, several rooms are around it.
        let around = island.iter().flat_map(|c| grid.beside(*c).chain([*c])).map(|c| label[c]);
        let around: BTreeSet<u32> = around.filter(|l| *l != u32::MAX).gather();
        let (Some(&room), 1) = (around.first(), around.len()) else { continue };
        let corners = island.iter().flat_map(|cell| {
            let (x, y) = grid.xy(*cell);
            [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(dx, dy)| corner(sheet, (x + dx) as f64, (y + dy) as f64))
        });
        let hull = convex_hull(corners.collect());
        let Some(ring) = outline::ring(hull) else { continue };
        let (at, _) = outline::bounds(&ring);
        let no = kinds.len() + 1;
        kinds.push(Kind {
            source: format!("island {no}"),
            word: "obstacle".to_owned(),
            parts: vec![Part {
                word: String::new(),
                outline: ring.iter().map(|p| Point::from(p - at)).collect(),
                bottom: Cm::ZERO,
                height: Cm::of(THING_HEIGHT),
                permeability: Permeability::Impermeable,
            }],
            ..Kind::default()
        });
        level.things.push(Thing {
            source: format!("island-{no}"),
            name: String::new(),
            kind: no - 1,
            at,
            z: Cm::ZERO,
            angle: Deg::ZERO,
            room: Some(room as usize),
            move_prob: None,
            properties: Properties::new(),
        });
    }
    (kinds, islands.len().saturating_sub(MOST_THINGS))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Frame;

    /// A grid of 5 cm cells, all wall, into which rectangles in metres are cut and drawn.
    struct Plan {
        grid: Grid,
        sheet: Sheet,
        seed: u32,
    }

    impl Plan {
        fn new(width: f64, height: f64) -> Self {
            let (width, height) = ((width * 20.0) as usize, (height * 20.0) as usize);
            let sheet = Sheet {
                image: String::new(),
                resolution: 5.0,
                origin: Frame::IDENTITY,
                negate: false,
                occupied_thresh: 0.65,
                free_thresh: 0.2,
                is_raw: false,
            };
            let cells = vec![Cell::Occupied; width * height];
            Self { grid: Grid { width, height, cells }, sheet, seed: 1 }
        }

        fn fill(&mut self, [x0, y0, x1, y1]: [f64; 4], with: Cell) {
            let cells = |m: f64| (m * 20.0).round() as i64;
            for y in cells(y0)..cells(y1) {
                for x in cells(x0)..cells(x1) {
                    if let Some(cell) = self.grid.at(x, y) {
                        self.grid.cells[cell] = with;
                    }
                }
            }
        }

        /// Teeth along the walls and specks on the floor, as a laser leaves them.
        fn roughen(&mut self) {
            let before = self.grid.cells.clone();
            for cell in 0..before.len() {
                self.seed = self.seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let dice = (self.seed >> 16) % 1000;
                let wall = |c: usize| before[c] == Cell::Occupied;
                let beside = self.grid.beside(cell).filter(|c| wall(*c)).count();
                if before[cell] == Cell::Free && (dice < 2 || (beside > 0 && dice < 60)) {
                    self.grid.cells[cell] = Cell::Occupied;
                } else if wall(cell) && (1..4).contains(&beside) && dice > 960 {
                    self.grid.cells[cell] = Cell::Unknown;
                }
            }
        }

        fn read(&self) -> (Level, Vec<Kind>) {
            let mut level = Level::default();
            let kinds = furnish(&self.grid, &self.sheet, &mut level, &mut Vec::new());
            (level, kinds)
        }
    }

    /// A corridor with three rooms on either side, walls of 20 cm, doors of 90 cm.
    fn office() -> Plan {
        let mut plan = Plan::new(14.0, 11.4);
        plan.fill([0.5, 4.7, 13.5, 6.7], Cell::Free);
        for n in 0..3 {
            let x = 0.5 + 4.4 * f64::from(n);
            for (y0, y1, d0, d1) in [(0.5, 4.5, 4.5, 4.7), (6.9, 10.9, 6.7, 6.9)] {
                plan.fill([x, y0, x + 4.2, y1], Cell::Free);
                plan.fill([x + 1.5, d0, x + 2.4, d1], Cell::Free);
            }
        }
        plan
    }

    fn check(level: &Level, rooms: usize, doors: usize) {
        let sizes: Vec<String> = level
            .rooms
            .iter()
            .map(|r| {
                format!(
                    "{} {:.1} m2 {} corners",
                    r.kind,
                    outline::area(&r.outline).abs() / 1e4,
                    r.outline.len()
                )
            })
            .collect();
        assert_eq!((level.rooms.len(), level.openings.len()), (rooms, doors), "{sizes:#?}");
    }

    #[test]
    fn an_office_comes_apart_at_its_doors() {
        let (level, _) = office().read();
        check(&level, 7, 6);
        for opening in &level.openings {
            let width = (opening.jambs[1] - opening.jambs[0]).norm();
            assert!((width - 90.0).abs() <= 6.0, "{width}");
        }
        let corridors: Vec<_> = level.rooms.iter().filter(|r| r.kind == "corridor").collect();
        assert_eq!(corridors.len(), 1);
        for room in &level.rooms {
            assert_eq!(room.outline.len(), 4, "{room:?}");
            let area = outline::area(&room.outline).abs() / 1e4;
            let expected = if room.kind == "corridor" { 26.0 } else { 16.8 };
            assert!((area - expected).abs() < 1.2, "{area}");
        }
    }

    #[test]
    fn a_rough_scan_of_it_comes_apart_at_the_same_doors() {
        for seed in 1..6 {
            let mut plan = office();
            plan.seed = seed * 7919;
            plan.roughen();
            // A table on four legs and a cupboard that stands free.
            for (x, y) in [(2.0, 2.0), (2.0, 3.0), (3.0, 2.0), (3.0, 3.0)] {
                plan.fill([x, y, x + 0.1, y + 0.1], Cell::Occupied);
            }
            plan.fill([6.0, 8.0, 7.0, 8.5], Cell::Occupied);
            let (level, _) = plan.read();
            check(&level, 7, 6);
            assert!(level.things.iter().any(|t| (t.at - Point::new(600.0, 800.0)).norm() < 15.0));
            let joined = |o: &Opening| {
                o.rooms
                    .is_some_and(|r| r.iter().flatten().any(|r| level.rooms[*r].kind == "corridor"))
            };
            assert!(level.openings.iter().all(joined), "seed {seed}");
        }
    }

    /// Through windows of every width the laser sees far out of the building; no room comes of that.
    #[test]
    fn what_is_seen_through_windows_is_no_room() {
        for (width, rays) in [(0.6, 9), (0.9, 40), (1.4, 200), (2.4, 400)] {
            let mut plan = office();
            let inside = plan.grid.clone();
            // The same building with walls of 20 cm on a wide sheet of the unknown.
            let (wide, high, shift) = (700, 640, 220);
            let mut cells = vec![Cell::Unknown; wide * high];
            for cell in 0..inside.cells.len() {
                let (x, y) = inside.xy(cell);
                let near = |reach: i64| {
                    (-reach..=reach).any(|dy| {
                        (-reach..=reach).any(|dx| {
                            inside.at(x + dx, y + dy).is_some_and(|c| inside.cells[c] == Cell::Free)
                        })
                    })
                };
                let at = (y as usize + shift) * wide + x as usize + shift;
                match inside.cells[cell] {
                    Cell::Free => cells[at] = Cell::Free,
                    _ if near(4) => cells[at] = Cell::Occupied,
                    _ => {}
                }
            }
            plan.grid = Grid { width: wide, height: high, cells };
            // A window in the lower wall of the first room, seen through from the middle of that room.
            let eye = (2.6 * 20.0 + shift as f64, 2.6 * 20.0 + shift as f64);
            for ray in 0..=rays {
                let across = (f64::from(ray) / f64::from(rays) - 0.5) * width * 20.0;
                let down = 2.3 * 20.0;
                let length = f64::hypot(across, down);
                for step in 0..160 {
                    let far = f64::from(step);
                    let x = eye.0 + across / length * far;
                    let y = eye.1 - down / length * far;
                    if let Some(cell) = plan.grid.at(x as i64, y as i64) {
                        plan.grid.cells[cell] = Cell::Free;
                    }
                }
            }
            let (level, _) = plan.read();
            check(&level, 7, 6);
            let shift = shift as f64 * 5.0;
            let low =
                level.rooms.iter().flat_map(|r| &r.outline).map(|p| p.y).fold(f64::MAX, f64::min);
            // The window's own sill at most.
            assert!(
                low > shift + 50.0 - 60.0,
                "width {width}: floor down to {low}, wall at {}",
                shift + 50.0
            );
        }
    }

    #[test]
    fn a_turned_origin_turns_the_plan() {
        let mut plan = office();
        let (straight, _) = plan.read();
        plan.sheet.origin = Frame::new(-250.0, 90.0, 0.0, Deg::of(30.0));
        let (turned, _) = plan.read();
        for (a, b) in straight.openings.iter().zip(&turned.openings) {
            assert!((plan.sheet.origin.apply(a.jambs[0]) - b.jambs[0]).norm() < 1e-6);
        }
    }

    #[test]
    fn walls_of_one_cell_are_walls() {
        let mut plan = Plan::new(9.0, 5.0);
        plan.fill([0.5, 0.5, 8.5, 4.5], Cell::Free);
        for (y0, y1) in [(0.5, 2.0), (2.9, 4.5)] {
            plan.fill([4.0, y0, 4.05, y1], Cell::Occupied);
        }
        let (level, _) = plan.read();
        check(&level, 2, 1);
        let jambs = level.openings[0].jambs;
        assert!((jambs[1] - jambs[0]).norm() < 95.0, "{jambs:?}");
    }

    #[test]
    fn a_slanting_cut_leaves_no_pockets() {
        // The jambs stand two cells apart from one another along the wall.
        let mut plan = Plan::new(9.0, 5.0);
        plan.fill([0.5, 0.5, 8.5, 4.5], Cell::Free);
        plan.fill([4.0, 0.5, 4.05, 2.0], Cell::Occupied);
        plan.fill([4.1, 2.9, 4.15, 4.5], Cell::Occupied);
        check(&plan.read().0, 2, 1);
    }

    #[test]
    fn a_wall_between_doorways_is_no_thing() {
        // Four rooms around a cross of thin walls that touches no outer wall.
        let mut plan = Plan::new(9.0, 9.0);
        plan.fill([0.5, 0.5, 8.5, 8.5], Cell::Free);
        plan.fill([4.4, 1.5, 4.5, 7.5], Cell::Occupied);
        plan.fill([1.5, 4.4, 7.5, 4.5], Cell::Occupied);
        let (level, kinds) = plan.read();
        check(&level, 4, 4);
        assert!(kinds.is_empty());
        // A bench in the middle of a room is one.
        plan.fill([1.5, 2.0, 3.0, 2.2], Cell::Occupied);
        let (level, kinds) = plan.read();
        check(&level, 4, 4);
        assert_eq!((level.things.len(), kinds.len()), (1, 1));
    }

    #[test]
    fn one_hall_stays_one_room() {
        let mut plan = Plan::new(12.0, 9.0);
        plan.fill([1.0, 1.0, 11.0, 8.0], Cell::Free);
        plan.fill([5.0, 1.0, 5.3, 2.5], Cell::Occupied);
        plan.roughen();
        let (level, _) = plan.read();
        check(&level, 1, 0);
    }
}
