//! Measures that are taken when somebody asks: between any two things, of one; and what lies between two.
//!
//! The relations hold what is near; a question may be about what is far. Lengths are cm, areas cm².

use crate::facts::{Value, quoted};
use crate::geometry::Polygon;
use crate::geometry::contact::{Footprint, gap, overlap_area};
use crate::units::{AreaId, InOrder as _, MapId, Point, ReplicaId, Vector};

use super::asked::{Around, way_between};
use super::measure::surface_distance;
use super::relations::Relations;

/// The sizes of a thing along its own axes, cm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    pub width: f64,
    pub depth: f64,
    pub height: f64,
    /// Of its foot above the zero of its Map.
    pub bottom: f64,
    /// Of its outline, cm².
    pub base: f64,
}

impl Relations {
    /// Distance between the surfaces of two things of one Map, cm.
    #[must_use]
    pub fn distance(&self, a: ReplicaId, b: ReplicaId) -> Option<f64> {
        let bodies = &self.measurements().bodies;
        let (a, b) = (bodies.get(&a)?, bodies.get(&b)?);
        (a.map == b.map).then(|| surface_distance(a, b).0)
    }

    /// Distance in the plan from a thing to a point of a Map, cm.
    #[must_use]
    pub fn distance_to_point(&self, a: ReplicaId, map: MapId, p: Point) -> Option<f64> {
        let body = self.measurements().bodies.get(&a).filter(|b| b.map == map)?;
        body.outline.iter().map(|f| f.distance_to(p)).reduce(f64::min)
    }

    /// Distance in the plan from a thing to a segment, such as a door's, cm.
    #[must_use]
    pub fn distance_to_segment(&self, a: ReplicaId, (from, to): (Point, Point)) -> Option<f64> {
        let body = self.measurements().bodies.get(&a)?;
        let along = (to - from).try_normalize(1e-9)?;
        // A thread of a rectangle: the contact tests want an area.
        let side = Vector::new(along.y, -along.x) * 0.05;
        let thread =
            Footprint::new(Polygon::new(vec![from + side, to + side, to - side, from - side]));
        body.outline.iter().map(|f| gap(f, &thread).distance).reduce(f64::min)
    }

    /// The Map on which a thing stands, and the middle of its outline there.
    #[must_use]
    pub fn centre(&self, id: ReplicaId) -> Option<(MapId, Point)> {
        self.measurements().bodies.get(&id).map(|b| (b.map, b.centre))
    }

    #[must_use]
    pub fn extent(&self, id: ReplicaId) -> Option<Extent> {
        let body = self.measurements().bodies.get(&id)?;
        let kind = self.measurements().kind(body.object)?;
        Some(Extent {
            width: kind.size.0,
            depth: kind.size.1,
            height: body.top - body.bottom,
            bottom: body.bottom,
            base: kind.outline_area,
        })
    }

    /// Whether a thing has a side that is its front.
    #[must_use]
    pub fn has_front(&self, id: ReplicaId) -> bool {
        self.front(id).is_some()
    }

    /// Outward normal of a thing's front, in the frame of its Map.
    #[must_use]
    pub fn front(&self, id: ReplicaId) -> Option<Vector> {
        self.measurements().bodies.get(&id)?.front
    }

    /// Floor area of an Area, cm², its extents along the Map's axes and its height, cm.
    #[must_use]
    pub fn area_extent(&self, id: AreaId) -> Option<Extent> {
        let room = self.measurements().rooms.get(&id)?;
        let (low, high) = room
            .parts
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.1), h.max(p.2)));
        Some(Extent {
            width: room.bounds.max.x - room.bounds.min.x,
            depth: room.bounds.max.y - room.bounds.min.y,
            height: high - low,
            bottom: low,
            base: room.parts.iter().map(|(f, _, _)| f.area).sum(),
        })
    }

    /// The middle of an Area and its Map.
    #[must_use]
    pub fn area_centre(&self, id: AreaId) -> Option<(MapId, Point)> {
        let room = self.measurements().rooms.get(&id)?;
        let largest = room.parts.iter().max_by(|a, b| a.0.area.total_cmp(&b.0.area))?;
        Some((room.map, largest.0.interior_point()))
    }

    /// Distance in the plan from a thing to the floor of an Area, cm; 0 for what is in it.
    #[must_use]
    pub fn distance_to_area(&self, id: ReplicaId, area: AreaId) -> Option<f64> {
        let body = self.measurements().bodies.get(&id)?;
        let room = self.measurements().rooms.get(&area).filter(|r| r.map == body.map)?;
        let gaps =
            body.outline.iter().flat_map(|f| room.parts.iter().map(move |(p, _, _)| gap(f, p)));
        gaps.map(|g| g.distance).reduce(f64::min)
    }

    /// What is between two things by the rules, in its order on the way from the first to the second.
    #[must_use]
    pub fn standing_between(
        &self,
        around: &Around<'_>,
        a: ReplicaId,
        b: ReplicaId,
    ) -> Vec<ReplicaId> {
        let bodies = &self.measurements().bodies;
        let (Some(first), Some(second)) = (bodies.get(&a), bodies.get(&b)) else {
            return Vec::new();
        };
        let ends = [a, b].map(|id| quoted(self.symbols().replica(id)));
        let question = format!("?- BETWEEN(X, {}, {})", ends[0], ends[1]);
        let mut found = self.things(around, &question);
        let (from, to) = way_between(first, second);
        let along = (to - from).try_normalize(1e-6).unwrap_or_else(Vector::zeros);
        found.order_by(|x, y| {
            let at = |id: &ReplicaId| (bodies[id].centre - from).dot(&along);
            at(x).total_cmp(&at(y))
        });
        found
    }

    /// What is between a thing and the walls near to it, by the rules.
    #[must_use]
    pub fn before_walls(&self, around: &Around<'_>, a: ReplicaId) -> Vec<ReplicaId> {
        let end = quoted(self.symbols().replica(a));
        self.things(around, &format!("?- BETWEEN_WALL_AND(X, {end})"))
    }

    /// The things in the first column of the answers.
    pub(crate) fn things(&self, around: &Around<'_>, question: &str) -> Vec<ReplicaId> {
        let rows = self.found(around, question);
        let symbol = |row: &Vec<Value>| match row.first() {
            Some(Value::Symbol(symbol)) => self.symbols().replica_of(Some(symbol)),
            _ => None,
        };
        rows.iter().filter_map(symbol).collect()
    }

    /// The top of a thing: its area and how much of that nothing covers, cm².
    #[must_use]
    pub fn free_top(&self, id: ReplicaId) -> Option<(f64, f64)> {
        let bodies = &self.measurements().bodies;
        let body = bodies.get(&id)?;
        let roofs = || {
            body.blocks.iter().filter(|b| b.solid_roof && b.top >= body.top - 0.5).map(|b| b.roof())
        };
        // A back that stands up is no place to put things.
        let widest = body.blocks.iter().filter(|b| b.solid_roof).map(|b| b.roof());
        let widest = widest.max_by(|a, b| a.area.total_cmp(&b.area))?;
        let top: f64 = roofs().map(|f| f.area).sum();
        let is_top = top >= widest.area * self.thresholds().top_share;
        let tops: Vec<&Footprint> = if is_top { roofs().collect() } else { vec![widest] };
        let area: f64 = tops.iter().map(|f| f.area).sum();
        let on_it = bodies.values().filter(|b| self.support_of(b.id) == Some(id));
        let covered: f64 = on_it
            .flat_map(|b| &b.outline)
            .map(|f| tops.iter().map(|t| overlap_area(f, t)).sum::<f64>())
            .sum();
        Some((area, (area - covered).max(0.0)))
    }
}
