//! Which of a product's representations is read, and with how much effort.

use std::collections::HashSet;

use super::body::{Body, Effort};
use super::place::Place;
use super::step::{Instance, Instances, Value};

/// Shape items and corners looked at in one file: shapes that map shapes that map shapes grow without end.
const MOST_WORK: usize = 20_000_000;
/// Identifiers of representations that are lines, marks or freedoms, not what stands there.
const NO_BODY: [&str; 11] = [
    "axis",
    "annotation",
    "clearance",
    "cog",
    "footprint",
    "box",
    "profile",
    "reference",
    "surveypoints",
    "lighting",
    "plan",
];

/// What stands for a product that has no body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Else {
    /// Of a room: its drawn floor, then its box.
    Footprint,
    /// Of a thing: its box, which has a height, then its drawn floor.
    Box,
}

/// How a product's shape was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Source {
    Body,
    Box,
    Footprint,
}

/// What a product's shape is made of and how it stands, whatever its place: like products have like keys.
pub(super) type Key = Vec<(u32, [i64; 9])>;

pub(super) struct Shapes<'a> {
    pub(super) all: &'a Instances,
    /// Radians in one of the file's units of angle.
    pub(super) angle_unit: f64,
    pub(super) effort: Effort,
    work: usize,
    /// Types of shape items that could not be read.
    pub(super) unread: HashSet<&'static str>,
}

impl<'a> Shapes<'a> {
    pub(super) fn new(all: &'a Instances, angle_unit: f64) -> Self {
        Self { all, angle_unit, effort: Effort::default(), work: 0, unread: HashSet::new() }
    }

    /// Whether shapes were left out because there was no end of them.
    pub(super) fn is_exhausted(&self) -> bool {
        self.work > MOST_WORK
    }

    pub(super) fn charge(&mut self, work: usize) {
        self.work = self.work.saturating_add(work);
    }

    /// The representations of a product, with their identifiers in small letters.
    fn named(&self, representation: &Value) -> Vec<(&'a Instance, String)> {
        let all = self.all;
        let Some(shape) = representation.reference().and_then(|id| all.get(id)) else {
            return Vec::new();
        };
        shape
            .at(2)
            .list()
            .iter()
            .filter_map(|v| all.get(v.reference()?))
            .filter(|r| r.kind == "IFCSHAPEREPRESENTATION")
            .map(|r| (r, r.at(1).text().unwrap_or("body").to_lowercase()))
            .collect()
    }

    /// The bodies of a product's representation (IfcProductDefinitionShape), seen in the frame `place`: of its body
    /// when it has one, else of what else there is.
    pub(super) fn of_product(
        &mut self,
        representation: &Value,
        place: &Place,
        or_else: Else,
    ) -> (Vec<Body>, Source) {
        let named = self.named(representation);
        let is_body = |name: &str| name == "body";
        let is_other = |name: &str| name != "body" && !NO_BODY.contains(&name);
        let is_footprint = |name: &str| ["footprint", "plan", "annotation"].contains(&name);
        let is_box = |name: &str| name == "box";
        type Wanted<'w> = (&'w dyn Fn(&str) -> bool, Source);
        let (first, second): (Wanted<'_>, Wanted<'_>) = match or_else {
            Else::Footprint => ((&is_footprint, Source::Footprint), (&is_box, Source::Box)),
            Else::Box => ((&is_box, Source::Box), (&is_footprint, Source::Footprint)),
        };
        for (wanted, source) in [
            (&is_body as &dyn Fn(&str) -> bool, Source::Body),
            (&is_other, Source::Body),
            first,
            second,
        ] {
            let mut bodies = Vec::new();
            for (representation, _) in named.iter().filter(|(_, name)| wanted(name)) {
                for item in representation.at(3).list() {
                    let Some(item) = item.reference().and_then(|id| self.all.get(id)) else {
                        continue;
                    };
                    let before = bodies.len();
                    self.solid(item, place, 0, &mut bodies);
                    if bodies.len() == before {
                        self.unread.insert(item.kind);
                    }
                }
            }
            bodies.retain(|b| b.heights().is_some());
            if !bodies.is_empty() {
                return (bodies, source);
            }
        }
        (Vec::new(), Source::Body)
    }

    /// What makes two products alike in shape; `place` without its origin and heading.
    pub(super) fn key(&self, representation: &Value, place: &Place) -> Key {
        let mut key = Vec::new();
        for (representation, _) in self.named(representation) {
            for id in representation.at(3).list().iter().filter_map(Value::reference) {
                let mapped = self.all.get(id).filter(|item| item.kind == "IFCMAPPEDITEM");
                let target = mapped.and_then(|item| self.target(item, place));
                let (id, at) = target.unwrap_or((id, *place));
                // An origin of its own is part of the look.
                let origin = at.origin - place.origin;
                key.push((id, rounded(&at)));
                key.push((0, rounded(&Place { x: origin, y: origin, z: origin, ..at })));
            }
        }
        key
    }
}

/// The axes of a frame, to a millionth.
fn rounded(place: &Place) -> [i64; 9] {
    let mut numbers = [0; 9];
    for (k, axis) in [place.x, place.y, place.z].iter().enumerate() {
        for (j, x) in axis.iter().enumerate() {
            numbers[3 * k + j] = (x * 1e5).round() as i64;
        }
    }
    numbers
}
