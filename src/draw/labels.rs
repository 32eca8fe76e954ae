//! Where names stand on a drawing: legible, none over another, near what they name.
//!
//! Candidates are tried and the cheapest feasible one is taken: rooms first, then things from the large to the small.
//!
//! **Invariant.** No two names overlap, and none is set smaller than it can be read; one that finds no place is left
//! out, or told by its number ([`super::legend::List`]).

use std::collections::HashMap;

use crate::geometry::{Bounds, Polygon};
use crate::units::{Frame, InOrder as _, Point, Vector};

use super::canvas::{Canvas, Lettering, Style};
use super::font::text_width;

/// The share of its size to which the name of a thing shrinks.
const SMALLEST: f64 = 0.85;

/// A name that found its place.
struct Placed {
    at: Point,
    lettering: Lettering,
    /// What it covers: one frame where it is level or upright, a row of small ones where it slants.
    frames: Vec<Bounds>,
}

/// What a name may stand on.
pub(super) struct Ground<'g> {
    pub(super) bounds: Bounds,
    /// What stands upon it.
    pub(super) upon: &'g [Bounds],
    /// Of a thing that is turned out of the sheet's directions, and clearly longer than wide.
    pub(super) slant: Option<Slant>,
}

/// A rectangle by its middle, half its length and width, cm, and the degrees of its length, in which a name is read.
#[derive(Clone, Copy)]
pub(super) struct Slant {
    middle: Point,
    half: Vector,
    turn: f64,
}

impl Slant {
    /// The smallest rectangle along a frame's axes around some points; none where a level name serves as well.
    pub(super) fn of(frame: &Frame, points: impl Iterator<Item = Point>) -> Option<Self> {
        /// Nearer to level or upright, degrees, a name is set so.
        const LEVEL: f64 = 4.0;
        /// Of length to width.
        const LONG: f64 = 1.4;
        let own = Bounds::of(points.map(|p| frame.invert(p)));
        let (half, angle) = ((own.max - own.min) / 2.0, frame.angle.get());
        let is_wide = half.x >= half.y;
        let (half, turn) =
            if is_wide { (half, angle) } else { (Vector::new(half.y, half.x), angle + 90.0) };
        // Read from the left to the right, or upwards.
        let turn = 90.0 - (90.0 - turn).rem_euclid(180.0);
        let off = turn.rem_euclid(90.0);
        let slants = off.min(90.0 - off) > LEVEL && half.x > LONG * half.y;
        let middle = frame.apply(nalgebra::center(&own.min, &own.max));
        slants.then_some(Self { middle, half, turn })
    }

    /// Frames that cover a name's rectangle, so many cm along it and across from the middle.
    fn cover(&self, (along, across): (f64, f64), (long, tall): (f64, f64)) -> Vec<Bounds> {
        let (sin, cos) = self.turn.to_radians().sin_cos();
        let at = |x: f64, y: f64| self.middle + Vector::new(x * cos - y * sin, x * sin + y * cos);
        let pieces = (long / tall).ceil().max(1.0);
        let edge = |k: f64| along - long / 2.0 + long * k / pieces;
        let (low, high) = (across - tall / 2.0, across + tall / 2.0);
        let piece = |k: f64| {
            let (x, next) = (edge(k), edge(k + 1.0));
            Bounds::of([at(x, low), at(next, low), at(next, high), at(x, high)])
        };
        (0..pieces as u32).map(|k| piece(f64::from(k))).collect()
    }
}

/// Frames that are taken, found by the cell of a coarse grid.
pub(super) struct Labels {
    cell: f64,
    taken: HashMap<(i64, i64), Vec<Bounds>>,
    /// Lines that a name should not lie on, such as walls and the route, by the same grid.
    lines: HashMap<(i64, i64), Vec<(Point, Point)>>,
    /// Where names may stand at all.
    sheet: Option<Bounds>,
    /// Left free between names, cm on the sheet.
    margin: f64,
}

impl Labels {
    /// `letter` is the size of an ordinary letter on this drawing.
    pub(super) fn new(letter: f64) -> Self {
        Self {
            cell: letter * 12.0,
            taken: HashMap::new(),
            lines: HashMap::new(),
            sheet: None,
            margin: 0.0,
        }
    }

    /// No name reaches beyond these bounds.
    pub(super) fn within(mut self, sheet: Bounds) -> Self {
        self.sheet = Some(sheet);
        self
    }

    /// Names stand so far apart at least, cm on the sheet.
    pub(super) fn spaced(mut self, margin: f64) -> Self {
        self.margin = margin;
        self
    }

    fn cells(&self, frame: &Bounds) -> impl Iterator<Item = (i64, i64)> + use<> {
        let index = |v: f64| (v / self.cell).floor() as i64;
        let (x, y) =
            (index(frame.min.x)..=index(frame.max.x), index(frame.min.y)..=index(frame.max.y));
        x.flat_map(move |x| y.clone().map(move |y| (x, y)))
    }

    pub(super) fn take(&mut self, frame: Bounds) {
        for cell in self.cells(&frame) {
            self.taken.entry(cell).or_default().push(frame);
        }
    }

    pub(super) fn avoid_line(&mut self, a: Point, b: Point) {
        for cell in self.cells(&Bounds::of([a, b])) {
            let (x, y) = (cell.0 as f64 * self.cell, cell.1 as f64 * self.cell);
            let square =
                Bounds { min: Point::new(x, y), max: Point::new(x + self.cell, y + self.cell) };
            if segment_meets(a, b, &square) {
                self.lines.entry(cell).or_default().push((a, b));
            }
        }
    }

    /// Whether nothing stands there.
    pub(super) fn is_open(&self, frame: &Bounds) -> bool {
        self.is_free(frame)
    }

    fn is_free(&self, frame: &Bounds) -> bool {
        let on_sheet = self.sheet.is_none_or(|s| s.contains(frame.min) && s.contains(frame.max));
        on_sheet
            && self
                .cells(frame)
                .all(|cell| self.taken.get(&cell).is_none_or(|t| !t.iter().any(|t| t.meets(frame))))
    }

    /// Whether a line that a name should not lie on runs there.
    pub(super) fn crosses_line(&self, frame: &Bounds) -> bool {
        self.cells(frame).any(|cell| {
            self.lines
                .get(&cell)
                .is_some_and(|lines| lines.iter().any(|&(a, b)| segment_meets(a, b, frame)))
        })
    }

    /// The name of a place, beside its dot.
    pub(super) fn beside(&mut self, canvas: &mut Canvas, dot: Point, text: &str, style: Lettering) {
        let (width, height) = (text_width(text, style.size, style.bold), style.size * 1.15);
        const AROUND: [(f64, f64); 6] =
            [(0.0, 1.0), (0.0, -1.0), (0.56, 0.8), (-0.56, 0.8), (0.56, -0.8), (-0.56, -0.8)];
        let away = |distance: f64| {
            AROUND.map(|(dx, dy)| {
                let by = Vector::new(dx * width, dy * height * distance);
                around(dot + by, width, height)
            })
        };
        let frames: Vec<Bounds> = [1.0, 1.4, 2.0, 2.8].into_iter().flat_map(away).collect();
        let free = || frames.iter().filter(|f| self.is_free(f));
        let best = free().find(|f| !self.crosses_line(f)).or_else(|| free().next()).copied();
        if let Some(frame) = best {
            let at = nalgebra::center(&frame.min, &frame.max);
            self.put(canvas, text, &Placed { at, lettering: style, frames: vec![frame] });
        }
    }

    /// The name of a room within its outline, clear of furniture as far as may be; smaller, in two lines or upright
    /// where it would not fit otherwise. A second line, such as the room's area, stands below it. Says whether it found place.
    pub(super) fn in_room(
        &mut self,
        canvas: &mut Canvas,
        room: &Polygon,
        furniture: &[Bounds],
        text: &str,
        below: &str,
        style: Lettering,
    ) -> bool {
        let bounds = room.bounds();
        let spots = spots(room, bounds);
        // The second line is smaller, as long as it can be read.
        let second = |size: f64| (size * 0.6).max(style.size * 0.4);
        let mut best: Option<(f64, Placed)> = None;
        for share in [1.0, 0.82, 0.66, 0.52, 0.42] {
            for turn in [0.0, 90.0] {
                let lettering = Lettering { size: style.size * share, turn, ..style };
                let size = lettering.size;
                let long =
                    text_width(text, size, style.bold).max(text_width(below, second(size), false));
                let more = if below.is_empty() { 0.0 } else { 1.25 * second(size) };
                let tall = size * 1.15 + more;
                let (width, height) = if turn > 0.0 { (tall, long) } else { (long, tall) };
                if width > bounds.max.x - bounds.min.x || height > bounds.max.y - bounds.min.y {
                    continue;
                }
                for &(spot, off) in &spots {
                    let frame = around(spot, width, height);
                    let cost = 2.2 * (1.0 - share) + if turn > 0.0 { 0.5 } else { 0.0 } + 0.9 * off;
                    if best.as_ref().is_some_and(|(least, _)| cost >= *least) {
                        continue;
                    }
                    let covered: f64 = furniture.iter().map(|f| overlap(f, &frame)).sum();
                    let cost = cost
                        + 1.6 * (covered / (width * height)).min(1.0)
                        + if self.crosses_line(&frame) { 1.2 } else { 0.0 };
                    let better = best.as_ref().is_none_or(|(least, _)| cost < *least);
                    if better && self.is_free(&frame) && holds(room, &frame) {
                        best = Some((cost, Placed { at: spot, lettering, frames: vec![frame] }));
                    }
                }
            }
        }
        let Some((_, placed)) = best else { return false };
        if below.is_empty() {
            self.put(canvas, text, &placed);
            return true;
        }
        let size = placed.lettering.size;
        let down = if placed.lettering.turn > 0.0 { Vector::x() } else { -Vector::y() };
        // The two share the frame, whatever their sizes.
        let small = Lettering { size: second(size), bold: false, ..placed.lettering };
        canvas.text(placed.at + down * size * 0.575, below, small);
        let name = Placed { at: placed.at - down * second(size) * 0.625, ..placed };
        self.put(canvas, text, &name);
        true
    }

    /// The name of a thing: on it where it fits, rather beside what stands upon it than over that; else near it on the
    /// floor of its room, clear of the walls, with a thin line to it; anywhere near where there are no rooms at all. Says
    /// whether it found a place.
    pub(super) fn on_thing(
        &mut self,
        canvas: &mut Canvas,
        &Ground { bounds: thing, upon, slant }: &Ground<'_>,
        text: &str,
        style: Lettering,
        rooms: Option<&[&Polygon]>,
    ) -> bool {
        let center = nalgebra::center(&thing.min, &thing.max);
        let along = |upon| slant.and_then(|slant| self.spot_along(slant, upon, text, style));
        // To be clear of them, a name is not turned.
        let clear = || self.spot_on((thing, upon), text, style, &[0.0]);
        let anywhere = || self.spot_on((thing, &[]), text, style, &[0.0, 90.0]);
        let on_it = along(upon).or_else(|| along(&[])).or_else(clear).or_else(anywhere);
        if let Some(placed) = on_it {
            self.put(canvas, text, &placed);
            return true;
        }
        let lettering = Lettering { size: style.size * SMALLEST, ..style };
        let (width, height) = (text_width(text, lettering.size, style.bold), lettering.size * 1.1);
        let reach = (thing.max - thing.min) / 2.0 + Vector::new(width, height) / 2.0;
        for distance in [0.12, 0.7, 1.5, 2.6] {
            for (dx, dy) in [
                (0.0, -1.0),
                (0.0, 1.0),
                (1.0, 0.0),
                (-1.0, 0.0),
                (0.7, -1.0),
                (-0.7, -1.0),
                (0.7, 1.0),
                (-0.7, 1.0),
            ] {
                let away = Vector::new(dx, dy) * distance * height;
                let at = center + Vector::new(dx, dy).component_mul(&reach) + away;
                let frame = around(at, width, height);
                let stands = |f: &Bounds| {
                    let aside = f.grown(0.35 * lettering.size);
                    rooms.is_none_or(|rooms| rooms.iter().any(|room| holds(room, &aside)))
                        && !self.crosses_line(&aside)
                };
                if self.is_free(&frame) && stands(&frame) {
                    if distance > 0.5 {
                        let leader = Style::line(lettering.color, style.size * 0.05);
                        canvas.segment(center, frame_point(&frame, center), leader);
                    }
                    self.put(canvas, text, &Placed { at, lettering, frames: vec![frame] });
                    return true;
                }
            }
        }
        false
    }

    /// Where a name fits on a thing, clear of what stands upon it, in one of some turns.
    fn spot_on(
        &self,
        (thing, upon): (Bounds, &[Bounds]),
        text: &str,
        style: Lettering,
        turns: &[f64],
    ) -> Option<Placed> {
        let center = nalgebra::center(&thing.min, &thing.max);
        for share in [1.0, SMALLEST] {
            for &turn in turns {
                let lettering = Lettering { size: style.size * share, turn, ..style };
                let long = text_width(text, lettering.size, style.bold);
                let tall = lettering.size * 1.1;
                // A single letter gains nothing from being turned.
                if turn > 0.0 && long < 1.3 * tall {
                    continue;
                }
                let (width, height) = if turn > 0.0 { (tall, long) } else { (long, tall) };
                let spare = (thing.max - thing.min) - Vector::new(width, height);
                if spare.x < 0.0 || spare.y < 0.0 {
                    continue;
                }
                for share in [0.0, 0.5, -0.5, 0.9, -0.9] {
                    for along in [Vector::new(0.0, share), Vector::new(share, 0.0)] {
                        let at = center + along.component_mul(&spare) / 2.0;
                        let frame = around(at, width, height);
                        let is_clear = !upon.iter().any(|other| other.meets(&frame));
                        if is_clear && self.is_free(&frame) && !self.crosses_line(&frame) {
                            return Some(Placed { at, lettering, frames: vec![frame] });
                        }
                    }
                }
            }
        }
        None
    }

    /// Where a name fits along a thing that slants, clear of what stands upon it.
    fn spot_along(
        &self,
        slant: Slant,
        upon: &[Bounds],
        text: &str,
        style: Lettering,
    ) -> Option<Placed> {
        [1.0, SMALLEST].into_iter().find_map(|share| {
            let lettering = Lettering { size: style.size * share, turn: slant.turn, ..style };
            let (long, tall) = (text_width(text, lettering.size, style.bold), lettering.size * 1.1);
            let spare = slant.half - Vector::new(long, tall) / 2.0;
            if spare.x < 0.0 || spare.y < 0.0 {
                return None;
            }
            let shares = [0.0, 0.5, -0.5, 0.9, -0.9];
            let off = shares.map(|s| (0.0, s * spare.y)).into_iter();
            off.chain(shares.map(|s| (s * spare.x, 0.0))).find_map(|off| {
                let frames = slant.cover(off, (long, tall));
                let is_clear = frames.iter().all(|frame| {
                    !upon.iter().any(|other| other.meets(frame))
                        && self.is_free(frame)
                        && !self.crosses_line(frame)
                });
                let (first, last) = (frames.first()?, frames.last()?);
                let middle = |b: &Bounds| nalgebra::center(&b.min, &b.max);
                let at = nalgebra::center(&middle(first), &middle(last));
                is_clear.then_some(Placed { at, lettering, frames })
            })
        })
    }

    /// A name at a point, or as near to it as there is space.
    pub(super) fn near(&mut self, canvas: &mut Canvas, spot: Point, text: &str, style: Lettering) {
        let (width, height) = (text_width(text, style.size, style.bold), style.size * 1.15);
        const STEPS: [(f64, f64); 7] =
            [(0.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.5, 0.0), (-0.5, 0.0), (0.0, 2.0), (0.0, -2.0)];
        let frames =
            STEPS.map(|(x, y)| around(spot + Vector::new(x * width, y * height), width, height));
        if let Some(&frame) = frames.iter().find(|f| self.is_free(f) && !self.crosses_line(f)) {
            let at = nalgebra::center(&frame.min, &frame.max);
            self.put(canvas, text, &Placed { at, lettering: style, frames: vec![frame] });
        }
    }

    fn put(&mut self, canvas: &mut Canvas, text: &str, placed: &Placed) {
        canvas.text(placed.at, text, placed.lettering);
        placed.frames.iter().for_each(|frame| self.take(frame.grown(self.margin)));
    }
}

pub(super) fn around(p: Point, width: f64, height: f64) -> Bounds {
    let half = Vector::new(width / 2.0, height / 2.0);
    Bounds { min: p - half, max: p + half }
}

/// Points of a room where a name may stand, the best first, each with what it is off the best place: by the way from
/// the centre as a share of the room's diagonal; in a room of many corners, where the centre may lie in a bay or
/// behind a wall, also by how much nearer it is to a wall than the widest place.
fn spots(room: &Polygon, bounds: Bounds) -> Vec<(Point, f64)> {
    let winding = room.corners.len() > 8;
    let steps = if winding { 24 } else { 9 };
    let (centre, extent) = (room.centroid(), bounds.max - bounds.min);
    let grid =
        (1..steps).flat_map(|i| (1..steps).map(move |j| Vector::new(f64::from(i), f64::from(j))));
    let on_floor = grid
        .map(|v| bounds.min + v.component_mul(&extent) / f64::from(steps))
        .chain([centre])
        .filter(|p| room.contains(*p, 0.0));
    let mut spots: Vec<(Point, f64)> = if winding {
        let clear: Vec<(Point, f64)> = on_floor.map(|p| (p, room.border_distance(p))).collect();
        let widest = clear.iter().map(|c| c.1).fold(1e-9, f64::max);
        let narrow = |width: f64| 0.8 * (0.75 - width / widest).max(0.0);
        let off = |p: Point| 0.5 * (p - centre).norm() / extent.norm();
        clear.into_iter().map(|(p, width)| (p, narrow(width) + off(p))).collect()
    } else {
        on_floor.map(|p| (p, (p - centre).norm() / extent.norm())).collect()
    };
    spots.order_by(|a, b| a.1.total_cmp(&b.1));
    spots
}

/// Whether a frame lies within a room; looked at on its border, which is enough for rooms as they are built.
fn holds(room: &Polygon, frame: &Bounds) -> bool {
    let steps = [0.0, 0.25, 0.5, 0.75, 1.0];
    let extent = frame.max - frame.min;
    steps.into_iter().all(|t| {
        [(t, 0.0), (t, 1.0), (0.0, t), (1.0, t)]
            .into_iter()
            .all(|(x, y)| room.contains(frame.min + Vector::new(x, y).component_mul(&extent), 0.0))
    })
}

fn overlap(a: &Bounds, b: &Bounds) -> f64 {
    let width = a.max.x.min(b.max.x) - a.min.x.max(b.min.x);
    let height = a.max.y.min(b.max.y) - a.min.y.max(b.min.y);
    width.max(0.0) * height.max(0.0)
}

/// The point of a frame that is nearest to `p`.
pub(super) fn frame_point(frame: &Bounds, p: Point) -> Point {
    Point::new(p.x.clamp(frame.min.x, frame.max.x), p.y.clamp(frame.min.y, frame.max.y))
}

/// Clips the segment by the slabs of the frame.
fn segment_meets(a: Point, b: Point, frame: &Bounds) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    let d = b - a;
    for axis in 0..2 {
        let (low, high) = (frame.min[axis] - a[axis], frame.max[axis] - a[axis]);
        if d[axis].abs() < 1e-12 {
            if low > 0.0 || high < 0.0 {
                return false;
            }
            continue;
        }
        let (t, u) = (low / d[axis], high / d[axis]);
        enters = enters.max(t.min(u));
        leaves = leaves.min(t.max(u));
    }
    enters <= leaves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Deg;

    #[test]
    fn a_segment_meets_a_frame_or_passes_it() {
        let frame = around(Point::new(0.0, 0.0), 2.0, 2.0);
        let meets = |x1, y1, x2, y2| segment_meets(Point::new(x1, y1), Point::new(x2, y2), &frame);
        assert!(meets(-5.0, 0.0, 5.0, 0.0));
        assert!(meets(0.0, 0.0, 0.1, 0.0));
        assert!(!meets(-5.0, 2.0, 5.0, 2.0));
        assert!(!meets(2.0, 0.0, 5.0, 0.0));
        assert!(meets(0.5, -3.0, 0.5, 3.0));
    }

    #[test]
    fn a_name_runs_along_a_long_thing_that_is_turned_and_stays_on_it() {
        let along = |angle: f64, (wide, deep): (f64, f64)| {
            let frame = Frame::new(300.0, -40.0, 0.0, Deg::of(angle));
            let corners = [(0.0, 0.0), (wide, 0.0), (wide, deep), (0.0, deep)];
            Slant::of(&frame, corners.map(|(x, y)| frame.apply(Point::new(x, y))).into_iter())
        };
        for (angle, size, turn) in [
            (30.0, (160.0, 60.0), 30.0),
            (210.0, (160.0, 60.0), 30.0),
            (120.0, (160.0, 60.0), -60.0),
            (30.0, (60.0, 160.0), -60.0),
            (-20.0, (60.0, 160.0), 70.0),
        ] {
            let slant = along(angle, size).expect("turned and long");
            assert!((slant.turn - turn).abs() < 1e-9, "{angle}: {} for {turn}", slant.turn);
            let style = Lettering::plain(12.0, "#000000");
            let labels = Labels::new(10.0);
            let placed = labels.spot_along(slant, &[], "Desk", style).expect("there is space");
            let frame = Frame::new(300.0, -40.0, 0.0, Deg::of(angle));
            let on = Bounds { min: Point::origin(), max: Point::new(size.0, size.1) }.grown(6.0);
            for frame_of in &placed.frames {
                assert!(on.contains(frame.invert(nalgebra::center(&frame_of.min, &frame_of.max))));
            }
            assert!((placed.at - slant.middle).norm() < 1e-9);
        }
        assert!(along(2.0, (160.0, 60.0)).is_none() && along(88.0, (160.0, 60.0)).is_none());
        assert!(along(45.0, (60.0, 60.0)).is_none());
    }

    #[test]
    fn names_that_find_no_place_are_left_out_and_none_overlap() {
        let room = Polygon::new(
            [(0.0, 0.0), (200.0, 0.0), (200.0, 60.0), (0.0, 60.0)]
                .map(|(x, y)| Point::new(x, y))
                .into(),
        );
        let mut canvas = Canvas::new(room.bounds());
        let mut labels = Labels::new(10.0);
        for _ in 0..40 {
            labels.in_room(
                &mut canvas,
                &room,
                &[],
                "Комната",
                "",
                Lettering::bold(20.0, "#000000"),
            );
        }
        let mut frames: Vec<Bounds> = labels.taken.values().flatten().copied().collect();
        frames.sort_by(|a, b| (a.min.x, a.min.y).partial_cmp(&(b.min.x, b.min.y)).expect("finite"));
        frames.dedup();
        assert!((2..40).contains(&frames.len()), "{}", frames.len());
        for (i, a) in frames.iter().enumerate() {
            assert!(frames[i + 1..].iter().all(|b| !a.meets(b)));
        }
    }
}
