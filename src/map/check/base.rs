//! Bases of Orthoframes (M1): closed, connected, simple, counter-clockwise, at least three vectors.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use crate::fault::{COORDINATE, MapError, Record, Spot, WITHIN};
use crate::units::{Bilingual, Cm, InOrder as _, Point, said, word};
use crate::{BaseVector, Orthoframe, TypeKind};

use super::plane::{bounds, doubled_area, meeting, near_pairs};
use super::{Checker, TOLERANCE, at};

/// Corners that a base may have; the check for crossings is quadratic in the worst case.
const MOST_VECTORS: usize = 10_000;
/// Crossings reported of one base.
const MOST_CROSSINGS: usize = 5;

impl Checker<'_> {
    pub(super) fn bases(&mut self) {
        let mut keys = BTreeSet::new();
        let id = |record: &Record| match record {
            Record::Orthoframe(id) => Some(*id),
            _ => None,
        };
        for frame in self.asked(("orthoframes", &self.world.orthoframes), id, |o| &o.key) {
            let spot = Spot::of(Record::Orthoframe(frame.id));
            if !keys.insert(&frame.key) || frame.key.is_empty() {
                let error = MapError::BadId { owner: said!("orthoframe"), id: frame.key.clone() };
                self.fault(error, spot.clone());
            }
            let record = Record::Orthoframe(frame.id);
            if self.asks_for(record) && !self.is_broken(record) {
                let is_sound = self.has_sound_base_at(frame, &spot);
                self.sound.get_mut().insert(frame.id, is_sound);
            }
        }
    }

    /// Whether the base can be measured; what is said of it is nobody's.
    pub(super) fn has_sound_base(mut self, frame: &Orthoframe) -> bool {
        self.has_sound_base_at(frame, &Spot::of(Record::Orthoframe(frame.id)))
    }

    fn has_sound_base_at(&mut self, frame: &Orthoframe, spot: &Spot) -> bool {
        self.sizes(frame, spot);
        let faults_before = self.faults.len();
        self.base(frame, &spot.clone().field("base_vectors"));
        self.faults.len() == faults_before
    }

    fn sizes(&mut self, frame: &Orthoframe, spot: &Spot) {
        let owner = Bilingual::named(word!("orthoframe"), &frame.name);
        self.type_exists(TypeKind::Orthoframe, frame.frame_type, &owner, spot);
        self.type_exists(TypeKind::Shape, frame.shape, &owner, spot);
        for vector in &frame.base {
            self.type_exists(TypeKind::Side, vector.side_type, &owner, spot);
        }
        let height = frame.height.get();
        let fits = Cm::new(height).is_ok();
        self.in_range(
            word!("height"),
            height,
            fits,
            word!("from-0-to-100-km"),
            spot.clone().field("height"),
        );
        if height < 0.0 {
            let error = MapError::NegativeHeight { name: frame.name.clone(), height: frame.height };
            self.fault(error, spot.clone().field("height"));
        }
        let scale = frame.roof_scale;
        let fits = (0.0..=100.0).contains(&scale);
        self.in_range(
            "roof_scale",
            scale,
            fits,
            word!("from-0-to-100"),
            spot.clone().field("roof_scale"),
        );
    }

    fn base(&mut self, frame: &Orthoframe, spot: &Spot) {
        let name = || frame.name.clone();
        let base = &frame.base;
        if base.len() < 3 {
            self.fault(MapError::BaseTooShort { name: name(), count: base.len() }, spot.clone());
            return;
        }
        if base.len() > MOST_VECTORS {
            let value = base.len() as f64;
            let what = word!("the-number-of-vectors-of-the-base");
            self.in_range(what, value, false, word!("from-3-to-10000"), spot.clone());
            return;
        }
        let coordinates = base.iter().flat_map(|v| [v.start.x, v.start.y, v.end.x, v.end.y]);
        if let Some(value) = coordinates.into_iter().find(|&c| Cm::new(c).is_err()) {
            self.in_range(COORDINATE, value, false, WITHIN, spot.clone());
            return;
        }
        let faults_before = self.faults.len();
        self.vectors(frame, spot);
        if self.faults.len() > faults_before {
            return;
        }
        self.crossings(frame, spot);
        let corners: Vec<_> = frame.corners().collect();
        let doubled = doubled_area(&corners);
        if self.faults.len() > faults_before {
            // The direction of a base that crosses itself means nothing.
        } else if doubled.abs() < 1e-6 {
            self.fault(MapError::BaseNoArea { name: name() }, spot.clone());
        } else if doubled < 0.0 {
            self.fault(MapError::BaseClockwise { name: name() }, spot.clone());
        }
    }

    /// Each vector by itself and with the next one.
    fn vectors(&mut self, frame: &Orthoframe, spot: &Spot) {
        let name = || frame.name.clone();
        let base = &frame.base;
        let mut ids = BTreeSet::new();
        for (i, vector) in base.iter().enumerate() {
            let spot = spot.clone().index(i);
            let owner = || Bilingual::named(word!("orthoframe"), &frame.name);
            if !is_good_id(&vector.id) {
                self.fault(MapError::BadId { owner: owner(), id: vector.id.clone() }, spot.clone());
            } else if !ids.insert(&vector.id) {
                let error = MapError::DuplicatePart { owner: owner(), id: vector.id.clone() };
                self.fault(error, spot.clone());
            }
            if (vector.end - vector.start).norm() < TOLERANCE {
                let (side, at) = (vector.id.clone(), at(vector.start));
                self.fault(MapError::BaseZeroLength { name: name(), side, at }, spot.clone());
            }
            let following = &base[(i + 1) % base.len()];
            // Exactly: a seam of a hair's breadth would be a hole for exact predicates.
            if vector.end != following.start {
                let is_last = i + 1 == base.len();
                self.fault(gap(frame, vector, following, is_last), spot);
            }
        }
    }

    fn crossings(&mut self, frame: &Orthoframe, spot: &Spot) {
        let base = &frame.base;
        let boxes: Vec<_> = base.iter().map(|v| bounds([v.start, v.end])).collect();
        let mut crossings = Vec::new();
        near_pairs(&boxes, 0.0, |i, j| {
            if let Some(p) = crossing(base, i, j) {
                crossings.push((i, j, p));
            }
            if crossings.len() < MOST_CROSSINGS {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        crossings.order_by_key(|&(i, j, _)| (i, j));
        for (i, j, p) in crossings {
            let error = MapError::BaseCrossesItself {
                name: frame.name.clone(),
                side: base[i].id.clone(),
                other: base[j].id.clone(),
                at: at(p),
            };
            self.contradiction(error, spot.clone().index(i), spot.clone().index(j));
        }
    }
}

/// Where two vectors meet that should not: neighbours only in their common corner.
fn crossing(base: &[BaseVector], i: usize, j: usize) -> Option<Point> {
    let (one, other) = ((base[i].start, base[i].end), (base[j].start, base[j].end));
    let follows = |a: usize, b: usize| (a + 1) % base.len() == b;
    if follows(i, j) || follows(j, i) {
        let (first, second) = if follows(i, j) { (one, other) } else { (other, one) };
        // A neighbour that turns straight back lies on this one.
        let (u, v) = (first.1 - first.0, second.1 - second.0);
        let turns_back = u.perp(&v).abs() <= 1e-12 * u.norm() * v.norm() && u.dot(&v) < 0.0;
        return turns_back.then_some(first.1);
    }
    meeting(one, other)
}

fn gap(frame: &Orthoframe, vector: &BaseVector, next: &BaseVector, is_last: bool) -> MapError {
    let (name, side, following) = (frame.name.clone(), vector.id.clone(), next.id.clone());
    let (end, start) = (at(vector.end), at(next.start));
    if is_last {
        MapError::BaseNotClosed { name, side, end, next: following, start }
    } else {
        MapError::BaseNotConnected { name, side, end, next: following, start }
    }
}

/// An id that references can name: see the map file's "A.roof".
pub(super) fn is_good_id(id: &str) -> bool {
    !id.is_empty()
        && !id.contains('.')
        && !["base", "roof", "база", "потолок"].contains(&id.to_lowercase().as_str())
}
