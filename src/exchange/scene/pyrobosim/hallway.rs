//! Hallways: the strip between two rooms, and the places where it leaves them.

use serde_json::Value;

use crate::OpeningKind;
use crate::map::{DoorKind, DoorStatus};
use crate::scene::json::{length, list, text};
use crate::scene::plane;
use crate::scene::procthor::contains;
use crate::units::{InOrder as _, Point, Vector};

use super::record::{centroid, pair};

/// A door in a hallway that can be shut. Nothing swings there: what shuts it takes no floor when it is open.
pub(super) fn door(record: &Value) -> OpeningKind {
    let flag =
        |field: &str, usual: bool| record.get(field).and_then(Value::as_bool).unwrap_or(usual);
    let open = flag("is_open", true);
    let status = match (open, flag("is_locked", false)) {
        (true, _) => DoorStatus::Open,
        (false, true) => DoorStatus::Locked,
        (false, false) => DoorStatus::Closed,
    };
    let opening = if open { 100.0 } else { 0.0 };
    OpeningKind::Door { kind: DoorKind::Sliding, leaves: Vec::new(), opens: None, status, opening }
}

/// The middle line of a hallway, by its `conn_method`.
pub(super) fn middle_line(record: &Value, [from, to]: &[Vec<Point>; 2]) -> Vec<Point> {
    let method = text(record, "conn_method").unwrap_or("auto");
    let points: Vec<Point> = list(record, "conn_points").iter().filter_map(pair).collect();
    if method == "points" && points.len() >= 2 {
        return points;
    }
    let (a, b) = (centroid(from), centroid(to));
    let mut along = b - a;
    if method == "angle" {
        let angle = record.get("conn_angle").and_then(Value::as_f64).filter(|a| a.is_finite());
        let way = Vector::new(angle.unwrap_or(0.0).cos(), angle.unwrap_or(0.0).sin());
        along = way * along.dot(&way);
    }
    let offset = record.get("offset").and_then(length).unwrap_or(0.0);
    let side = along.try_normalize(1e-6).map_or_else(Vector::zeros, |v| Vector::new(-v.y, v.x));
    vec![a + side * offset, a + side * offset + along]
}

/// The strip of a width along a line; at its bends each stretch reaches as far as the other's far side.
pub(super) fn band(way: &[Point], width: f64) -> Vec<Vec<Point>> {
    let last = way.len().saturating_sub(2);
    let strips = way.windows(2).enumerate().filter_map(|(i, ends)| {
        let along = (ends[1] - ends[0]).try_normalize(1e-6)?;
        let side = Vector::new(-along.y, along.x) * (width / 2.0);
        let from = ends[0] - if i > 0 { along * (width / 2.0) } else { Vector::zeros() };
        let to = ends[1] + if i < last { along * (width / 2.0) } else { Vector::zeros() };
        Some(vec![from - side, to - side, to + side, from + side])
    });
    plane::union(&strips.collect::<Vec<_>>())
}

/// Where a line crosses a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    at: Point,
    /// Along the wall, and along the line.
    wall: Vector,
    way: Vector,
}

impl Crossing {
    /// The corners that a hallway of a width cuts from the wall.
    pub(super) fn jambs(&self, width: f64) -> [Point; 2] {
        let sine = self.wall.perp(&self.way).abs().max(0.1);
        let half = self.wall * (width / 2.0 / sine);
        [self.at - half, self.at + half]
    }
}

/// Where a line that starts within an outline leaves it for the last time.
pub(super) fn crossing(way: &[Point], outline: &[Point]) -> Option<Crossing> {
    let mut last = None;
    for ends in way.windows(2) {
        let along = ends[1] - ends[0];
        let mut here: Vec<(f64, Crossing)> = Vec::new();
        for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
            let edge = b - a;
            let turn = along.perp(&edge);
            if turn.abs() < 1e-9 {
                continue;
            }
            let (t, s) = ((a - ends[0]).perp(&edge) / turn, (a - ends[0]).perp(&along) / turn);
            if (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&s) {
                let at = ends[0] + along * t;
                let beyond = at + along.normalize();
                if !contains(outline, beyond) {
                    here.push((t, Crossing { at, wall: edge.normalize(), way: along.normalize() }));
                }
            }
        }
        here.order_by(|x, y| x.0.total_cmp(&y.0));
        last = here.pop().map(|(_, c)| c).or(last);
    }
    last
}
