//! Doors, passages and windows of one level: between which rooms they are, and where in their walls.
//!
//! A door stands in the face of the room into which its leaves open; where the walls of its two rooms lie apart, the
//! floor of the doorway belongs to the other room. So both rooms have the very same side, and leaves have the room
//! that they need. A passage stands in the face of its first side.

use crate::map::OpensTo;
use crate::map::plane::bounds;
use crate::report::{What, Why};
use crate::units::{InOrder as _, Point, Vector};
use crate::{Level, Opening, OpeningKind, Report};

use super::index::Index;
use super::ring::{Region, common, is_sound};
use super::wall::{Seat, Walls, as_region};

/// The farthest that a wall may be from an opening in it, cm.
const REACH: f64 = 80.0;
/// Likewise for rooms that the file says the opening joins.
const SAID_REACH: f64 = 150.0;
/// Steps off the opening at which rooms are looked for, cm.
const STEPS: [f64; 8] = [3.0, 8.0, 15.0, 25.0, 35.0, 48.0, 62.0, 78.0];
/// Openings narrower than this are none, cm.
const LEAST_WIDTH: f64 = 20.0;
/// A floor that differs less from the one drawn is the same, cm².
const UNCHANGED: f64 = 0.01;
/// Bays may share so much floor with another room, cm²; the map's checks allow 1.
const TOUCH: f64 = 0.5;

/// Where the openings of a level are.
pub(super) struct Placed {
    /// By room.
    pub(super) walls: Vec<Option<Walls>>,
    /// By opening: the rooms that have it in their walls, the one to the left of its jambs first.
    pub(super) mounted: Vec<Option<[Option<usize>; 2]>>,
}

/// The record sort of an opening.
pub(super) fn what(opening: &Opening) -> What {
    match opening.what {
        OpeningKind::Door { .. } => What::Door,
        OpeningKind::Passage => What::Passage,
        OpeningKind::Window => What::Window,
    }
}

pub(super) fn place(level: &Level, regions: &[Option<Region>], report: &mut Report) -> Placed {
    let index = Index::of(regions);
    let walls = regions.iter().map(|r| r.as_ref().map(Walls::of)).collect();
    let mut site = Site { level, regions, index, walls, report };
    let mut mounted = vec![None; level.openings.len()];
    // Windows give way to doors: they come last.
    for windows in [false, true] {
        for (i, opening) in level.openings.iter().enumerate() {
            if (opening.what == OpeningKind::Window) == windows {
                match site.mount(i, opening) {
                    Ok(rooms) => mounted[i] = Some(rooms),
                    Err(why) => site.report.skipped(what(opening), &opening.source, why),
                }
            }
        }
    }
    site.drop_unsound(&mut mounted);
    let walls = site.walls;
    Placed { walls, mounted }
}

struct Site<'a> {
    level: &'a Level,
    regions: &'a [Option<Region>],
    index: Index,
    walls: Vec<Option<Walls>>,
    report: &'a mut Report,
}

impl Site<'_> {
    fn mount(&mut self, i: usize, opening: &Opening) -> Result<[Option<usize>; 2], Why> {
        let [p, q] = opening.jambs;
        let width = (q - p).norm();
        if width.is_nan() || width < LEAST_WIDTH {
            return Err(Why::TooNarrow { least: LEAST_WIDTH as u32 });
        }
        let rooms = match self.said(opening) {
            Some(rooms) => rooms,
            None => self.located(opening)?,
        };
        if opening.what == OpeningKind::Window {
            return self.mount_window(i, opening, rooms);
        }
        let width_now = match rooms {
            [Some(left), Some(right)] => self.mount_between(i, opening, left, right)?,
            [Some(only), None] => self.mount_alone(i, only, (p, q))?,
            [None, Some(only)] => self.mount_alone(i, only, (q, p))?,
            [None, None] => return Err(Why::NoRoom),
        };
        if width_now < width - (0.03 * width).max(2.0) {
            let (from, to) = (width.round() as u32, width_now.round() as u32);
            self.report.mended(what(opening), &opening.source, Why::Narrowed { from, to });
        }
        Ok(rooms)
    }

    fn seat(&self, room: usize, (p, q): (Point, Point), reach: f64) -> Option<Seat> {
        self.walls[room].as_ref()?.seat(p, q, reach)
    }

    /// The rooms that the file names, each on its side; None when it names none, or none that is near.
    fn said(&mut self, opening: &Opening) -> Option<[Option<usize>; 2]> {
        let [one, other] = opening.rooms?;
        let there = |room: Option<usize>| room.filter(|&r| self.regions[r].is_some());
        let (one, other) = (there(one), there(other).filter(|_| other != one));
        let [p, q] = opening.jambs;
        let cost = |room: Option<usize>, ends| {
            room.map_or(0.0, |room| {
                self.seat(room, ends, SAID_REACH).map_or(f64::INFINITY, |seat| seat.distance)
            })
        };
        let as_said = cost(one, (p, q)) + cost(other, (q, p));
        let turned = cost(other, (p, q)) + cost(one, (q, p));
        let least = as_said.min(turned);
        match (one, other) {
            (None, None) => None,
            _ if least.is_finite() => {
                Some(if turned < as_said { [other, one] } else { [one, other] })
            }
            _ => {
                let is_near = |room: usize| {
                    cost(Some(room), (p, q)).min(cost(Some(room), (q, p))).is_finite()
                };
                let far = [one, other].into_iter().flatten().find(|&r| !is_near(r));
                let room = far.or(one).or(other)?;
                let room = self.level.rooms[room].source.clone();
                self.report.mended(what(opening), &opening.source, Why::OtherRoom { room });
                None
            }
        }
    }

    /// The rooms found by stepping off both sides.
    fn located(&mut self, opening: &Opening) -> Result<[Option<usize>; 2], Why> {
        let [p, q] = opening.jambs;
        let along = (q - p).normalize();
        let left = Vector::new(-along.y, along.x);
        let near = self.index.near(nalgebra::center(&p, &q), (q - p).norm() / 2.0 + REACH);
        let mut seen: [Vec<usize>; 2] = [Vec::new(), Vec::new()];
        for share in [0.5, 0.25, 0.75] {
            let at = p + (q - p) * share;
            for (side, out) in [left, -left].into_iter().enumerate() {
                seen[side].extend(self.first_room(&near, at, out));
            }
        }
        let [left_room, right_room] = [most(&seen[0]), most(&seen[1])];
        let mut all = seen.concat();
        all.order();
        all.dedup();
        match (left_room, right_room) {
            (None, None) => Err(Why::NoRoom),
            (Some(a), Some(b)) if a == b => self.through_the_nearer_wall(opening, a, &near),
            (a, b) => {
                if all.len() > 2
                    && let (Some(a), Some(b)) = (a, b)
                {
                    let name = |r: usize| self.level.rooms[r].source.clone();
                    let why = Why::SeveralRooms { one: name(a), other: name(b) };
                    self.report.mended(what(opening), &opening.source, why);
                }
                Ok([a, b])
            }
        }
    }

    fn first_room(&self, near: &[usize], at: Point, out: Vector) -> Option<usize> {
        STEPS.iter().find_map(|&step| {
            let p = at + out * step;
            near.iter().copied().find(|&r| self.regions[r].as_ref().is_some_and(|r| r.contains(p)))
        })
    }

    /// An opening drawn a little within a room belongs to its nearer wall.
    fn through_the_nearer_wall(
        &self,
        opening: &Opening,
        room: usize,
        near: &[usize],
    ) -> Result<[Option<usize>; 2], Why> {
        let [p, q] = opening.jambs;
        let seats = [self.seat(room, (p, q), REACH), self.seat(room, (q, p), REACH)];
        let distance = |seat: &Option<Seat>| seat.as_ref().map_or(f64::INFINITY, |s| s.distance);
        // The room lies to the left of its wall's direction, what is beyond to the right.
        let side = usize::from(distance(&seats[1]) < distance(&seats[0]));
        let Some(seat) = &seats[side] else { return Err(Why::WithinRoom) };
        let along = (seat.left - seat.right).normalize();
        let out = Vector::new(along.y, -along.x);
        let middle = nalgebra::center(&seat.left, &seat.right);
        let beyond = self.first_room(near, middle, out).filter(|&r| r != room);
        Ok(if side == 0 { [Some(room), beyond] } else { [beyond, Some(room)] })
    }

    fn mount_alone(&mut self, i: usize, room: usize, ends: (Point, Point)) -> Result<f64, Why> {
        let seat = self.seat(room, ends, SAID_REACH).ok_or(Why::NoWall)?;
        check_width(seat.width(), ends)?;
        if let Some(walls) = &mut self.walls[room] {
            walls.take(&seat, i);
        }
        Ok(seat.width())
    }

    fn mount_between(
        &mut self,
        i: usize,
        opening: &Opening,
        left: usize,
        right: usize,
    ) -> Result<f64, Why> {
        let [p, q] = opening.jambs;
        let opens_right =
            matches!(opening.what, OpeningKind::Door { opens: Some(OpensTo::Outside), .. });
        // In whose face the opening stands, and the ends as that room sees them.
        let (keeper, other, ends) =
            if opens_right { (right, left, (q, p)) } else { (left, right, (p, q)) };
        let reach = SAID_REACH;
        let mut kept = self.seat(keeper, ends, reach).ok_or(Why::NoWall)?;
        let mut facing = self.seat(other, (kept.left, kept.right), reach).ok_or(Why::NoWall)?;
        if facing.width() < kept.width() * 0.99 - 0.1 {
            // The other room's wall is shorter: the opening is as wide as both allow.
            kept = self.seat(keeper, (facing.left, facing.right), reach).ok_or(Why::NoWall)?;
            facing = self.seat(other, (kept.left, kept.right), reach).ok_or(Why::NoWall)?;
        }
        check_width(kept.width(), ends)?;
        if let Some(walls) = &mut self.walls[keeper] {
            walls.take(&kept, i);
        }
        if let Some(walls) = &mut self.walls[other] {
            walls.take_line(&facing, kept.left, kept.right, i);
        }
        Ok(kept.width())
    }

    /// A window is a wall of another kind: each room has its own stretch of it.
    fn mount_window(
        &mut self,
        i: usize,
        opening: &Opening,
        rooms: [Option<usize>; 2],
    ) -> Result<[Option<usize>; 2], Why> {
        let [p, q] = opening.jambs;
        let mut mounted = [None; 2];
        for (side, ends) in [(p, q), (q, p)].into_iter().enumerate() {
            if let Some(room) = rooms[side]
                && self.mount_alone(i, room, ends).is_ok()
            {
                mounted[side] = Some(room);
            }
        }
        if mounted == [None; 2] { Err(Why::NoWall) } else { Ok(mounted) }
    }

    /// Gives up bays that make an outline cross itself or reach into another room.
    fn drop_unsound(&mut self, mounted: &mut [Option<[Option<usize>; 2]>]) {
        let mut queue: Vec<usize> = (0..self.walls.len()).collect();
        while let Some(room) = queue.pop() {
            while let Some(opening) = self.worst(room) {
                for other in mounted[opening].take().into_iter().flatten().flatten() {
                    if let Some(walls) = &mut self.walls[other] {
                        walls.release(opening);
                        // Without it the room is another one.
                        if other != room {
                            queue.push(other);
                        }
                    }
                }
                let record = &self.level.openings[opening];
                self.report.skipped(what(record), &record.source, Why::NoWall);
            }
        }
    }

    /// An opening of this room that has to go: the first without which the room is sound.
    fn worst(&self, room: usize) -> Option<usize> {
        let walls = self.walls[room].as_ref()?;
        if self.is_sound(room, walls) {
            return None;
        }
        let bays = walls.bays();
        let others: Vec<usize> = walls.openings().filter(|o| !bays.contains(o)).collect();
        let suspects: Vec<usize> = bays.into_iter().chain(others.into_iter().rev()).collect();
        let is_guilty = |&&opening: &&usize| {
            let mut without = walls.clone();
            without.release(opening);
            self.is_sound(room, &without)
        };
        suspects.iter().find(is_guilty).or(suspects.first()).copied()
    }

    /// Whether a room with its openings is a simple outline that reaches into no other room. Openings change the
    /// floor by bays, and by spanning slight bends of a wall.
    fn is_sound(&self, room: usize, walls: &Walls) -> bool {
        if walls.openings().next().is_none() {
            return true;
        }
        let shape = as_region(&walls.outline());
        if !is_sound(&shape) {
            return false;
        }
        let as_drawn = self.regions[room].as_ref().map_or(0.0, Region::area);
        if walls.bays().is_empty() && (shape.area() - as_drawn).abs() < UNCHANGED {
            return true;
        }
        let near = self.index.near_box(grown(bounds(shape.outer.iter().copied())));
        near.into_iter().filter(|&other| other != room).all(|other| {
            self.walls[other]
                .as_ref()
                .is_none_or(|walls| common(&shape, &as_region(&walls.outline())).0 <= TOUCH)
        })
    }
}

fn grown((low, high): (Point, Point)) -> (Point, Point) {
    let by = Vector::new(REACH, REACH);
    (low - by, high + by)
}

fn check_width(width: f64, (p, q): (Point, Point)) -> Result<(), Why> {
    let wanted = (q - p).norm();
    if width < LEAST_WIDTH || width < 0.4 * wanted { Err(Why::NoWall) } else { Ok(()) }
}

/// The room seen most often, the first seen of equals.
fn most(seen: &[usize]) -> Option<usize> {
    let count = |room: usize| seen.iter().filter(|&&r| r == room).count();
    let most = seen.iter().map(|&r| count(r)).max()?;
    seen.iter().copied().find(|&r| count(r) == most)
}
