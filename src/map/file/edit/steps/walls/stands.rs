//! Where something stands, and whose coordinates a room and its Map have.

use super::super::Steps;
use super::super::word::{Outcome, number, numbers};
use crate::file::edit::tree::{Handle, Kind, entry};
use crate::file::node::{Node, Span, Value};

/// What is nearer to the origin than this stands there, cm.
const THERE: f64 = 0.01;

/// Whether a point is that from which all is measured.
pub(super) fn is_origin(p: [f64; 2]) -> bool {
    p[0].hypot(p[1]) < THERE
}

/// Where something stands: its origin, and its angle in degrees.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Stands {
    pub(super) at: [f64; 2],
    degrees: f64,
}

impl Stands {
    pub(super) fn of(node: &Node) -> Outcome<Self> {
        let at = node.entry("at").map(|e| numbers(&e.node)).transpose()?;
        let degrees = node.entry("angle").map(|e| number(&e.node)).transpose()?;
        Ok(Self {
            at: at.map_or([0.0; 2], |list| [list[0], list[1]]),
            degrees: degrees.unwrap_or(0.0),
        })
    }

    pub(super) fn invert(self, p: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = sin_cos(self.degrees);
        let (dx, dy) = (p[0] - self.at[0], p[1] - self.at[1]);
        [cos * dx + sin * dy, cos * dy - sin * dx]
    }

    pub(super) fn apply(self, p: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = sin_cos(self.degrees);
        [self.at[0] + cos * p[0] - sin * p[1], self.at[1] + sin * p[0] + cos * p[1]]
    }
}

fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        // Exact on the axes, so that straight walls stay straight.
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}

/// Of the items of an Area, or of a Map, the one that gives it its coordinates: that which says so, or else the first.
pub(super) fn base_of(items: &[Node]) -> Option<&Node> {
    let mut standing = items.iter().filter(|n| n.value != Value::Nothing);
    let is_base = |n: &&Node| n.entry("base").is_some_and(|e| e.node.value == Value::Bool(true));
    standing.clone().find(is_base).or_else(|| standing.next())
}

impl Steps<'_> {
    /// Where an item stands in its Area.
    pub(super) fn frame_of(&self, area: Handle, item: &str) -> Outcome<Stands> {
        let items = self.tree.get(area).and_then(|n| n.entry("items"));
        let items = items.map_or(&[][..], |e| e.node.elements());
        let is_it = |n: &&Node| n.entry("id").and_then(|e| e.node.text()) == Some(item);
        items.iter().find(is_it).map_or(Ok(Stands::default()), Stands::of)
    }

    /// A Map whose coordinates an Area gave keeps them as its own when that one leaves their origin: what was seen there, and
    /// the robot, are told in them.
    pub(in crate::file::edit::steps) fn keep_coordinates(&mut self, area: Handle, span: &Span) {
        let key = self.tree.key(area).to_owned();
        for map in self.tree.all(Kind::Map) {
            let Some(record) = self.tree.get(map) else { continue };
            let has_own = record.entry("frame").and_then(|e| e.node.text());
            let items = record.entry("items").map_or(&[][..], |e| e.node.elements());
            let base = base_of(items);
            let is_of = |n: &&Node| n.entry("area").and_then(|e| e.node.text()) == Some(&key);
            let Some(base) = base.filter(is_of) else { continue };
            if has_own.is_some_and(|frame| !frame.is_empty()) || self.is_at_origin(area, base) {
                continue;
            }
            let frame = Value::Text(self.tree.key(map).to_owned());
            self.change(map).put(entry("frame", span, frame));
        }
    }

    /// Whether the base item of an Area that stands so on a Map has a corner, or its own origin, at that of the Map. What cannot
    /// be measured is told by the checks.
    fn is_at_origin(&self, area: Handle, on_map: &Node) -> bool {
        let items = self.tree.get(area).and_then(|n| n.entry("items"));
        let Some(base) = base_of(items.map_or(&[][..], |e| e.node.elements())) else { return true };
        let (Ok(inner), Ok(outer)) = (Stands::of(base), Stands::of(on_map)) else { return true };
        let Some(sides) = self.sides_of(base) else { return true };
        let corners = sides.iter().map(|side| side.from);
        let mut all = corners.map(|p| inner.apply(p)).chain([inner.at]);
        all.any(|p| is_origin(outer.apply(p)))
    }
}
