//! Stairs, ramps, escalators and lifts → links between storeys.
//!
//! A flight is no floor to drive on, neither where it stands nor where it comes up: on every storey that it reaches,
//! what it covers of a room becomes a room of its own, of the kind *stairs*, with a passage at the end at which one
//! steps on it. Where the model has a space for the stairs, that space is it.
//!
//! ```text
//!   upper storey   +-----------+   hall      the well: a passage at its upper end (right)
//!                  | stairs ====|
//!   lower storey   | ==== stairs           the flight: a passage at its lower end (left)
//! ```

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;

use crate::assemble::ring::{
    LEAST_AREA, Region, clean, common, counter_clockwise, largest, overlay,
};
use crate::map::Properties;
use crate::shafts::vertical;
use crate::units::{Cm, InOrder as _, Point, Vector, said, word};
use crate::{Lift, Opening, OpeningKind, Room, Treatment, What, outline};

use super::body::{Body, rings, together};
use super::building::{Reader, source};
use super::classes::Becomes;
use super::shape::Else;
use super::step::Instance;

/// Flights of one file.
const MOST: usize = 5_000;
/// The end of a flight may lie so far from the floor that it leads to, in cm.
const RISE: f64 = 50.0;
/// Corners of a flight so near to a floor, in cm, are where one steps on it.
const TREAD: f64 = 30.0;
/// Of a flight at least so much stands in a room, or it does not stand there.
const LEAST_SHARE: f64 = 0.2;
/// A room of which a flight covers so much is the flight's own.
const OWN_SHARE: f64 = 0.6;
/// Edges shorter than this, in cm, are no way on.
const LEAST_EDGE: f64 = 55.0;
/// A lift's shaft is no larger than so many cabins.
const MOST_CABINS: f64 = 4.0;
/// How far from the end of a flight, in cm, the room is looked for to which it leads.
const REACH: f64 = 150.0;
/// Parts in parts.
const DEEPEST: usize = 16;

/// A way between storeys.
struct Way {
    source: String,
    name: String,
    /// The word for the rooms that it makes: `stairs`, `ramp`.
    kind: &'static str,
    bodies: Vec<Body>,
    floor: Region,
    low: f64,
    high: f64,
}

impl Reader<'_> {
    /// Whether an element is a part of stairs or a ramp.
    pub(super) fn is_of_stairs(&self, id: u32) -> bool {
        let mut whole = self.wholes.get(&id);
        for _ in 0..DEEPEST {
            let Some(record) = whole.and_then(|id| self.all.get(*id)) else { return false };
            if ["IFCSTAIR", "IFCRAMP"].contains(&record.kind) {
                return true;
            }
            whole = whole.and_then(|id| self.wholes.get(id));
        }
        false
    }

    pub(super) fn stairs(&mut self) {
        let mut parts = std::collections::BTreeMap::<u32, Vec<u32>>::new();
        for (id, _) in self.elements(Becomes::Flight) {
            // Of the stairs as a whole, through whatever they are divided into.
            let mut whole = id;
            for _ in 0..DEEPEST {
                whole = self.wholes.get(&whole).copied().unwrap_or(whole);
            }
            let of = self.wholes.get(&id).copied().unwrap_or(whole);
            parts.entry(of).or_default().push(id);
        }
        let mut every = self.elements(Becomes::Stairs);
        let (of_others, alone): (Vec<_>, Vec<_>) =
            self.elements(Becomes::Flight).into_iter().partition(|(id, _)| self.is_of_stairs(*id));
        every.extend(alone);
        if !of_others.is_empty() {
            let text = said!("flights-are-taken-with-their", of_others = of_others.len());
            let count = (of_others.len(), of_others.len());
            self.tell((Treatment::Noted, What::Record), count, "IFCSTAIRFLIGHT", text);
        }
        every.extend(self.elements(Becomes::Lift));
        for (no, (id, record)) in every.into_iter().enumerate() {
            let own = source(record, id);
            if no >= MOST {
                self.lose(What::Lift, &own, word!("there-are-too-many-stairs"));
                continue;
            }
            let own_parts = parts.get(&id).map(Vec::as_slice).unwrap_or_default();
            let Some(way) = self.way(id, record, own_parts) else {
                self.lose(What::Lift, &own, word!("there-is-no-body-that-shows"));
                continue;
            };
            let levels = self.reached(&way);
            if levels.len() < 2 && way.kind != "lift" {
                self.within_storey(id, &own, own_parts);
                continue;
            }
            let stops = if way.kind == "lift" {
                self.shaft(&way, &levels)
            } else {
                let top = levels.last().copied();
                levels
                    .iter()
                    .filter_map(|l| Some((*l, self.stop(&way, *l, Some(*l) == top)?)))
                    .collect()
            };
            self.link(way, stops);
        }
    }

    /// A few steps within one storey are in the way.
    fn within_storey(&mut self, id: u32, own: &str, parts: &[u32]) {
        let text = word!("it-leads-to-no-other");
        if parts.is_empty() {
            self.tell((Treatment::Mended, What::Lift), (0, 0), own, text);
            self.steps.push(id);
        } else {
            self.tell((Treatment::Mended, What::Lift), (1, 1), own, text);
            self.steps.extend(parts);
        }
    }

    fn way(&mut self, id: u32, record: &Instance, parts: &[u32]) -> Option<Way> {
        let all = self.all;
        let mut bodies = Vec::new();
        for part in parts.iter().filter_map(|id| all.get(*id)).chain([record]) {
            let place = self.place_of(part);
            bodies.extend(self.shapes.of_product(part.at(6), &place, Else::Box).0);
        }
        let heights = bodies.iter().filter_map(Body::heights);
        let (low, high) = heights.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
        let effort = &mut self.shapes.effort;
        let covered: Vec<Region> = bodies.iter().flat_map(|b| b.footprint(effort)).collect();
        let covered = together(&covered, effort);
        let whole = covered.iter().max_by(|a, b| a.area().total_cmp(&b.area()))?;
        let ring = outline::ring(super::things::lighter(whole.outer.clone()))?;
        let floor = clean(&ring, &[])?.region;
        let told = record.at(8).word().or_else(|| self.type_of(id)?.at(9).word());
        let kind = match (record.kind, told.unwrap_or_default()) {
            ("IFCRAMP" | "IFCRAMPFLIGHT", _) => "ramp",
            ("IFCTRANSPORTELEMENT", "ESCALATOR" | "MOVINGWALKWAY") => "escalator",
            ("IFCTRANSPORTELEMENT", _) => "lift",
            _ => "stairs",
        };
        // Its name says more than the form of its run does: `Stair:Residential:151086`.
        let name = record.at(2).text().or(record.at(4).text()).unwrap_or(kind);
        let name = name.split(':').next().unwrap_or_default().trim().chars().take(100).collect();
        Some(Way { source: source(record, id), name, kind, bodies, floor, low, high })
    }

    /// The storeys with rooms that a way reaches, from below.
    fn reached(&self, way: &Way) -> Vec<usize> {
        let levels = &self.survey.levels;
        let floors = || (0..levels.len()).filter(|l| !levels[*l].rooms.is_empty());
        let z = |l: &usize| levels[*l].elevation.get();
        let Some(base) =
            floors().filter(|l| z(l) <= way.low + RISE).max_by(|a, b| z(a).total_cmp(&z(b)))
        else {
            return Vec::new();
        };
        let above = floors().filter(|l| z(l) > z(&base) + RISE && z(l) <= way.high + RISE);
        std::iter::once(base).chain(above).collect()
    }

    /// The rooms of a lift: its shaft on every storey.
    fn shaft(&mut self, way: &Way, levels: &[usize]) -> Vec<(usize, usize)> {
        let middle = outline::middle(&way.floor.outer);
        let mut stops = Vec::new();
        for level in levels {
            for room in self.rooms_at(*level, middle) {
                let it = &self.survey.levels[*level].rooms[room];
                let is_narrow = outline::area(&it.outline).abs() <= MOST_CABINS * way.floor.area();
                if vertical(it) == Some("lift") || is_narrow {
                    stops.push((*level, room));
                    break;
                }
            }
        }
        stops
    }

    /// The room in which a way begins or ends on a storey.
    fn stop(&mut self, way: &Way, level: usize, is_top: bool) -> Option<usize> {
        let entry = self.entry(way, level, is_top);
        let (low, high) = outline::bounds(&way.floor.outer);
        let mut beside: Vec<(f64, usize)> = Vec::new();
        for i in self.rooms_near(level, (low, high)) {
            let room = &self.survey.levels[level].rooms[i];
            if !self.shapes.effort.allows(room.outline.len() + way.floor.outer.len()) {
                continue;
            }
            if let Some(floor) = clean(&room.outline, &room.holes) {
                beside.push((common(&floor.region, &way.floor).0, i));
            }
        }
        let area = way.floor.area();
        let rooms = &self.survey.levels[level].rooms;
        let is_own = |room: usize| vertical(&rooms[room]) == Some(way.kind);
        let own =
            beside.iter().filter(|(share, room)| *share >= LEAST_SHARE * area && is_own(*room));
        if let Some((_, room)) = own.max_by(|a, b| a.0.total_cmp(&b.0)) {
            return Some(*room);
        }
        let most = beside.iter().max_by(|a, b| a.0.total_cmp(&b.0)).copied();
        let Some((share, room)) = most.filter(|(s, _)| *s >= (LEAST_SHARE * area).max(LEAST_AREA))
        else {
            let room = self.outward(way, level, entry)?;
            return Some(self.carve(way, level, way.floor.clone(), room, entry));
        };
        let floor = clean(&rooms[room].outline, &rooms[room].holes)?.region;
        if share >= OWN_SHARE * floor.area() {
            way.kind.clone_into(&mut self.survey.levels[level].rooms[room].kind);
            let own = self.survey.levels[level].rooms[room].source.clone();
            let text = word!("the-room-is-taken-up");
            self.tell((Treatment::Noted, What::Room), (0, 0), &own, text);
            return Some(room);
        }
        let (one, other) = (rings(&[floor]), rings(std::slice::from_ref(&way.floor)));
        let piece = overlay(&one, &other, OverlayRule::Intersect, FillRule::NonZero);
        let piece = largest(piece)?;
        Some(self.carve(way, level, piece, room, entry))
    }

    /// Where one steps on a way from a storey's floor.
    fn entry(&self, way: &Way, level: usize, is_top: bool) -> Point {
        let z = self.survey.levels[level].elevation.get();
        let z = if is_top { way.high } else { z.max(way.low) };
        let near = way.bodies.iter().flat_map(Body::corners).filter(|p| (p.z - z).abs() <= TREAD);
        let near: Vec<Point> = near.map(|p| Point::new(p.x, p.y)).collect();
        let near = if near.is_empty() { &way.floor.outer } else { &near };
        outline::middle(near)
    }

    /// The room beyond the end of a way.
    fn outward(&mut self, way: &Way, level: usize, entry: Point) -> Option<usize> {
        let middle = outline::middle(&way.floor.outer);
        let ahead = (entry - middle).try_normalize(1.0).unwrap_or_else(Vector::x);
        let aside = Vector::new(-ahead.y, ahead.x);
        let mut by = 0.0;
        while by <= REACH {
            for towards in [ahead, aside, -aside] {
                if let Some(room) = self.rooms_at(level, entry + towards * by).first() {
                    return Some(*room);
                }
            }
            by += 10.0;
        }
        None
    }

    /// Makes a room of what a way covers, and the passage to it from a room.
    fn carve(
        &mut self,
        way: &Way,
        level: usize,
        floor: Region,
        room: usize,
        entry: Point,
    ) -> usize {
        let storey = &self.survey.levels[level];
        let own = format!("{}@{}", way.source, storey.source);
        let ring = counter_clockwise(floor.outer);
        let holds = |p: Point| outline::contains(&storey.rooms[room].outline, p);
        // An edge to the room's floor, the nearest to where one steps on; best one that is wide enough.
        let mut best: Option<(bool, f64, [Point; 2])> = None;
        for (a, b) in outline::edges(&ring) {
            let Some(along) = (b - a).try_normalize(1e-6) else { continue };
            let middle = a + (b - a) / 2.0;
            let out = Vector::new(along.y, -along.x);
            let is_wide = (b - a).norm() >= LEAST_EDGE;
            let leads = [2.0, 10.0, 40.0, 80.0].iter().any(|by| holds(middle + out * *by));
            let away = (middle - entry).norm();
            let is_better = |(wide, far, _): &(bool, f64, _)| {
                is_wide && !wide || (is_wide == *wide && away < *far)
            };
            if leads && best.as_ref().is_none_or(is_better) {
                best = Some((is_wide, away, [a, b]));
            }
        }
        let storey = &mut self.survey.levels[level];
        let number = storey.rooms.len();
        storey.rooms.push(Room {
            source: own.clone(),
            kind: way.kind.to_owned(),
            outline: ring,
            ..Room::default()
        });
        match best {
            Some((_, _, jambs)) => storey.openings.push(Opening {
                source: format!("{own}:вход"),
                name: String::new(),
                what: OpeningKind::Passage,
                jambs,
                rooms: Some([Some(number), Some(room)]),
                height: None,
                sill: Cm::ZERO,
                properties: Properties::new(),
            }),
            None => self.tell(
                (Treatment::Mended, What::Lift),
                (0, 0),
                &own,
                word!("its-entrance-is-not-found"),
            ),
        }
        number
    }

    fn link(&mut self, way: Way, stops: Vec<(usize, usize)>) {
        if stops.len() < 2 {
            let text = if way.kind == "lift" {
                // Shafts that lie above one another are joined all the same.
                word!("the-body-does-not-show")
            } else {
                word!("the-ends-of-the-stairs")
            };
            return self.lose(What::Lift, &way.source, text);
        }
        // One flight after another in one stairwell.
        let lifts = &mut self.survey.lifts;
        if let Some(lift) = lifts.iter_mut().find(|l| l.stops.iter().any(|s| stops.contains(s))) {
            let new = stops.into_iter().filter(|s| !lift.stops.contains(s)).collect::<Vec<_>>();
            lift.stops.extend(new);
            lift.stops.order();
            let text = word!("with-other-flights-of-the");
            return self.tell((Treatment::Noted, What::Lift), (1, 1), &way.source, text);
        }
        // Of one name, each after the first with its number.
        let like = lifts.iter().filter(|l| l.name.starts_with(&way.name)).count();
        let name = if like == 0 { way.name } else { format!("{}-{}", way.name, like + 1) };
        lifts.push(Lift { source: way.source, name, stops, is_told: true });
    }
}
