//! Rooms as architects draw them: floor, walls, windows, stairs, lifts.

use std::collections::BTreeSet;

use crate::geometry::{PlacedArea, Polygon};
use crate::map::{Permeability, World};
use crate::units::{Piece, Point, Vector, word};

use super::canvas::{Canvas, Style};
use super::legend::Sample;

pub(super) const ROOM: Style = Style::fill("#faf7f0");
pub(super) const WALL: Style = Style::line("#3b3a36", 7.0);
pub(super) const PASSAGE: Style = Style::line("#a9a498", 1.2).dashed(6.0, 5.0);
pub(super) const GLASS: Style = Style::fill("#ffffff").outlined("#3b3a36", 1.0);
pub(super) const PANE: Style = Style::line("#5aa0c8", 1.2);
pub(super) const STAIRS: Style = Style::line("#b9b2a2", 1.2);
/// Depth of a step as it is drawn, cm.
const TREAD: f64 = 28.0;

/// Paper-coloured floor; a lift with the cross and stairs with the steps by which plans show them.
pub(super) fn floor(canvas: &mut Canvas, world: &World, area: &PlacedArea, pen: f64) {
    let kind = world.types.area.get(world.areas[&area.id].area_type);
    let is = |words: &[&str]| kind.is_some_and(|kind| kind.is_called(words));
    let (lift, stairs) = (is(LIFT), is(FLIGHT));
    for prism in &area.prisms {
        canvas.mark_of("room", format!("room-{}", area.id.0));
        canvas.polygon(&prism.polygon, ROOM, None);
        let lines = match (lift, stairs) {
            (true, _) => cross(&prism.polygon),
            (_, true) => steps(&prism.polygon, TREAD * pen),
            _ => Vec::new(),
        };
        canvas.mark(if lift { "lift" } else { "stairs" });
        for (a, b) in lines {
            canvas.segment(a, b, STAIRS.thick(pen));
        }
    }
}

/// The signs of walls, openings, stairs and lifts that stand on a plan of these rooms: class, sample, words.
pub(super) fn marks<'a>(
    world: &World,
    areas: impl Iterator<Item = &'a PlacedArea>,
) -> Vec<(&'static str, Sample, Piece)> {
    let [mut wall, mut window, mut passage, mut lift, mut stairs] = [false; 5];
    for area in areas {
        let kind = world.types.area.get(world.areas[&area.id].area_type);
        let is_lift = kind.is_some_and(|kind| kind.is_called(LIFT));
        lift |= is_lift;
        stairs |= !is_lift && kind.is_some_and(|kind| kind.is_called(FLIGHT));
        for (item, prism) in area.prisms.iter().enumerate() {
            let base = &world.orthoframes[&prism.orthoframe].base;
            for (((a, b), side), vector) in prism.polygon.edges().zip(prism.sides.iter()).zip(base)
            {
                match side.permeability {
                    Permeability::Impermeable if world.is_window(vector) => window = true,
                    Permeability::Impermeable => wall = true,
                    _ => passage |= !is_within(area, item, a, b),
                }
            }
        }
    }
    let all = [
        (wall, "key wall", Sample::Stroke(WALL), word!("wall")),
        (window, "key window", Sample::Stroke(PANE), word!("window")),
        (passage, "key passage", Sample::Stroke(PASSAGE), word!("passage")),
        (stairs, "key stairs", Sample::Stroke(STAIRS), word!("stairs")),
        (lift, "key lift", Sample::Stroke(STAIRS), word!("lift")),
    ];
    all.into_iter()
        .filter(|m| m.0)
        .map(|(_, class, sample, words)| (class, sample, words))
        .collect()
}

const LIFT: &[&str] = &["lift", "elevator"];
const FLIGHT: &[&str] = &["stairs", "stair", "staircase", "stairwell"];

/// Along the longest side of a room, as unit vector, with the room's box in these axes: start and size.
fn long_box(room: &Polygon) -> Option<(Point, Vector, Vector)> {
    let along = room.edges().map(|(a, b)| b - a).max_by(|u, v| u.norm().total_cmp(&v.norm()))?;
    let along = along.try_normalize(1e-9)?;
    let across = Vector::new(-along.y, along.x);
    let span = |axis: Vector| {
        let at = room.corners.iter().map(|p| p.coords.dot(&axis));
        at.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), t| (l.min(t), h.max(t)))
    };
    let ((x0, x1), (y0, y1)) = (span(along), span(across));
    Some((Point::from(along * x0 + across * y0), along * (x1 - x0), across * (y1 - y0)))
}

fn cross(room: &Polygon) -> Vec<(Point, Point)> {
    let Some((at, long, short)) = long_box(room) else { return Vec::new() };
    let lines = [(at, at + long + short), (at + short, at + long)];
    lines.into_iter().flat_map(|(a, b)| inside(room, a, b)).collect()
}

fn steps(room: &Polygon, tread: f64) -> Vec<(Point, Point)> {
    let Some((at, long, short)) = long_box(room) else { return Vec::new() };
    let count = (long.norm() / tread).floor().max(1.0) as i32;
    let line = |i: i32| {
        let start = at + long * (f64::from(i) / f64::from(count));
        inside(room, start, start + short)
    };
    (1..count).flat_map(line).collect()
}

/// The pieces of a segment that lie within a room; what runs along its border is the wall's.
fn inside(room: &Polygon, a: Point, b: Point) -> Vec<(Point, Point)> {
    let way = b - a;
    let mut cuts: Vec<f64> = room
        .edges()
        .filter_map(|(p, q)| {
            let turn = way.perp(&(q - p));
            if turn.abs() < 1e-9 {
                return None;
            }
            let (t, s) = ((p - a).perp(&(q - p)) / turn, (p - a).perp(&way) / turn);
            ((0.0..=1.0).contains(&t) && (-1e-9..=1.0 + 1e-9).contains(&s)).then_some(t)
        })
        .chain([0.0, 1.0])
        .collect();
    cuts.sort_by(f64::total_cmp);
    let pieces = cuts.windows(2).filter(|w| w[1] - w[0] > 1e-6);
    let within = |p: Point| room.contains(p, 0.0) && room.border_distance(p) > 1e-6;
    pieces
        .filter(|w| within(a + way * f64::midpoint(w[0], w[1])))
        .map(|w| (a + way * w[0], a + way * w[1]))
        .collect()
}

/// Walls, windows and, in dashes, what one walks through from one room to another.
pub(super) fn walls<'a>(
    canvas: &mut Canvas,
    world: &World,
    areas: impl Iterator<Item = &'a PlacedArea>,
    pen: f64,
) {
    // Two rooms that touch have each their side of one passage; drawn twice, dashes would fill each other's gaps.
    let mut passages = BTreeSet::new();
    let mut is_new = |a: Point, b: Point| {
        let [u, v] = [a, b].map(|p| (p.x.round() as i64, p.y.round() as i64));
        passages.insert((u.min(v), u.max(v)))
    };
    for area in areas {
        for (item, prism) in area.prisms.iter().enumerate() {
            let orthoframe = &world.orthoframes[&prism.orthoframe];
            for (((a, b), side), vector) in
                prism.polygon.edges().zip(prism.sides.iter()).zip(&orthoframe.base)
            {
                match side.permeability {
                    Permeability::Impermeable if world.is_window(vector) => {
                        canvas.mark("window");
                        window(canvas, a, b, pen);
                    }
                    Permeability::Impermeable => {
                        canvas.mark("wall");
                        canvas.segment(a, b, WALL.thick(pen));
                    }
                    Permeability::Permeable | Permeability::Conditional => {
                        if !is_within(area, item, a, b) && is_new(a, b) {
                            canvas.mark("passage");
                            canvas.segment(a, b, PASSAGE.thick(pen));
                        }
                    }
                }
            }
        }
    }
}

/// Whether an open side only parts two pieces of one room.
fn is_within(area: &PlacedArea, item: usize, a: Point, b: Point) -> bool {
    let middle = nalgebra::center(&a, &b);
    let mut others = area.prisms.iter().enumerate().filter(|(other, _)| *other != item);
    others.any(|(_, prism)| {
        prism.bounds.grown(0.1).contains(middle) && prism.polygon.contains(middle, 0.05)
    })
}

/// A window is a pane in a gap of the wall.
fn window(canvas: &mut Canvas, a: Point, b: Point, pen: f64) {
    let along = b - a;
    let Some(unit) = along.try_normalize(1e-9) else { return };
    let half = Vector::new(unit.y, -unit.x) * (WALL.width * pen / 2.0);
    canvas.segment(a, b, WALL.thick(pen));
    canvas.polygon(
        &Polygon::new(vec![a - half, b - half, b + half, a + half]),
        GLASS.thick(pen),
        None,
    );
    canvas.segment(a, b, PANE.thick(pen));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_and_crosses_stay_within_a_room_of_any_shape() {
        let room = Polygon::new(
            [(0.0, 0.0), (300.0, 0.0), (300.0, 90.0), (120.0, 90.0), (120.0, 200.0), (0.0, 200.0)]
                .map(|(x, y)| Point::new(x, y))
                .into(),
        );
        let lines: Vec<_> = steps(&room, 28.0).into_iter().chain(cross(&room)).collect();
        assert_eq!(steps(&room, 28.0).len(), 9);
        for (a, b) in lines {
            for t in [0.01, 0.3, 0.7, 0.99] {
                assert!(room.contains(a + (b - a) * t, 1e-6), "{a} {b}");
            }
        }
        // One of the diagonals leaves the room at its inner corner, so it is cut.
        assert!(cross(&room).iter().any(|(a, b)| (b - a).norm() < 300.0));
    }
}
