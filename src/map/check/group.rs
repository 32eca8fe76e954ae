//! Objects and Areas as groups of items (M2, M3): one base item at the origin, links that agree with positions.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use crate::fault::{MapError, Record, Spot};
use crate::units::{Bilingual, Cm, Deg, Frame, Piece, Point, said, word};
use crate::{
    BaseVector, DoorMount, Face, Item, ItemLink, Orthoframe, Permeability, SideRef, TypeKind, World,
};

use super::base::is_good_id;
use super::plane::{Bounds, bounds, intersection, middle, near_pairs, touch};
use super::{ANGLE_TOLERANCE, Checker, MOST_OVERLAPS, OVERLAP, Short, TOLERANCE, at};

/// What Objects and Areas have in common.
pub(super) struct Group<'w> {
    pub(super) title: Bilingual,
    pub(super) record: Record,
    pub(super) items: &'w [Item],
    pub(super) links: &'w [ItemLink],
    pub(super) doors: &'w [DoorMount],
    pub(super) is_area: bool,
}

/// An item where it stands in its group.
pub(super) struct Body {
    pub(super) polygon: Vec<Point>,
    pub(super) bounds: Bounds,
    pub(super) bottom: f64,
    pub(super) top: f64,
}

impl Body {
    pub(super) fn heights_meet(&self, other: &Self, margin: f64) -> bool {
        self.bottom <= other.top + margin && other.bottom <= self.top + margin
    }
}

/// How a linked face lies to the one it is linked with, and what a link says of that.
#[derive(Clone, Copy)]
pub(super) struct Offset {
    x: f64,
    y: f64,
    z: f64,
    angle: f64,
}

impl Offset {
    pub(super) fn of(x: Cm, y: Cm, z: Cm, angle: Deg) -> Self {
        Self { x: x.get(), y: y.get(), z: z.get(), angle: angle.signed() }
    }

    pub(super) fn agrees(&self, other: &Self) -> bool {
        let turn = (self.angle - other.angle).rem_euclid(360.0);
        (self.x - other.x).abs() <= TOLERANCE
            && (self.y - other.y).abs() <= TOLERANCE
            && (self.z - other.z).abs() <= TOLERANCE
            && turn.min(360.0 - turn) <= ANGLE_TOLERANCE
    }

    pub(super) fn distance(&self) -> f64 {
        (self.x.powi(2) + self.y.powi(2) + self.z.powi(2)).sqrt()
    }
}

/// Whether a frame stands with its own origin at that of whatever it is told in.
pub(super) fn keeps_origin(frame: &Frame) -> bool {
    frame.origin().coords.norm() <= TOLERANCE && frame.z.get().abs() <= TOLERANCE
}

impl Offset {
    pub(super) fn in_words(&self) -> Bilingual {
        let Self { x, y, z, angle } = *self;
        let by = format!("({}; {}; {})", Short(x), Short(y), Short(z));
        said!("an-offset-of-an-angle-of", by, angle = Short(angle).to_string())
    }
}

/// A side where it stands: its ends and the height of its foot.
pub(super) struct PlacedSide {
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) z: f64,
}

impl PlacedSide {
    pub(super) fn new(side: &BaseVector, frame: &Frame) -> Self {
        Self { start: frame.apply(side.start), end: frame.apply(side.end), z: frame.z.get() }
    }

    /// The offset of `other` from this side. Back to back, the end of the other corresponds to the start of this.
    pub(super) fn offset(&self, other: &Self) -> Offset {
        let direction = |s: &Self| {
            let v = s.end - s.start;
            v.y.atan2(v.x).to_degrees()
        };
        let turn = Deg::of(direction(other) - direction(self)).signed();
        let is_reversed = turn.abs() > 90.0;
        let corner = if is_reversed { other.end } else { other.start };
        let angle = if is_reversed { Deg::of(turn - 180.0).signed() } else { turn };
        let d = corner - self.start;
        Offset { x: d.x, y: d.y, z: other.z - self.z, angle }
    }
}

/// The thickest wall that a door may stand in, cm: a law of maps, which are read before any rules are. The threshold
/// «step distance», as far as rules look through a door, is the same in the program's own rules.
pub const THICKEST_WALL: f64 = 60.0;

impl PlacedSide {
    /// Whether another side lies opposite this one, as the two faces of a wall do.
    pub(super) fn faces(&self, other: &Self) -> bool {
        let along = (self.end - self.start).normalize();
        let other_along = (other.end - other.start).normalize();
        let across =
            nalgebra::center(&other.start, &other.end) - nalgebra::center(&self.start, &self.end);
        along.dot(&other_along) < -0.999
            && across.dot(&along).abs() <= TOLERANCE
            && across.norm() <= THICKEST_WALL
            && (self.z - other.z).abs() <= THICKEST_WALL
    }
}

impl<'w> Checker<'w> {
    pub(super) fn groups(&mut self) {
        let mut keys = BTreeSet::new();
        let id = |record: &Record| match record {
            Record::Object(id) => Some(*id),
            _ => None,
        };
        for object in self.asked(("objects", &self.world.objects), id, |o| &o.key) {
            let record = Record::Object(object.id);
            let spot = Spot::of(record);
            self.key(&mut keys, &object.key, word!("object-title"), &spot);
            if self.is_broken(record) || !self.asks_for(record) {
                continue;
            }
            let group = Group {
                title: Bilingual::named(word!("object"), &object.name),
                record,
                items: &object.items,
                links: &object.links,
                doors: &object.doors,
                is_area: false,
            };
            self.type_exists(TypeKind::Object, object.object_type, &group.title, &spot);
            self.group(&group);
            for (side, field) in [(&object.front, "front"), (&object.back, "back")] {
                if let Some(side) = side {
                    self.side(&group, side, spot.clone().field(field));
                }
            }
        }
        keys.clear();
        let id = |record: &Record| match record {
            Record::Area(id) => Some(*id),
            _ => None,
        };
        for area in self.asked(("areas", &self.world.areas), id, |a| &a.key) {
            let record = Record::Area(area.id);
            let spot = Spot::of(record);
            self.key(&mut keys, &area.key, word!("area-title"), &spot);
            if self.is_broken(record) || !self.asks_for(record) {
                continue;
            }
            let group = Group {
                title: Bilingual::named(word!("area"), &area.name),
                record,
                items: &area.items,
                links: &area.links,
                doors: &area.doors,
                is_area: true,
            };
            self.type_exists(TypeKind::Area, area.area_type, &group.title, &spot);
            self.group(&group);
        }
    }

    /// A handle of a record: not empty, not given twice, without the point that references use.
    pub(super) fn key(
        &mut self,
        keys: &mut BTreeSet<&'w str>,
        key: &'w str,
        what: Piece,
        spot: &Spot,
    ) {
        let owner = what.into();
        if key.is_empty() || key.contains('.') {
            self.fault(MapError::BadId { owner, id: key.to_owned() }, spot.clone());
        } else if !keys.insert(key) {
            self.fault(MapError::DuplicatePart { owner, id: key.to_owned() }, spot.clone());
        }
    }

    fn group(&mut self, group: &Group<'w>) {
        let spot = Spot::of(group.record);
        if group.items.is_empty() {
            self.fault(MapError::NoItems { owner: group.title.clone() }, spot);
            return;
        }
        let mut ids = BTreeSet::new();
        let mut all_there = true;
        for (i, item) in group.items.iter().enumerate() {
            let spot = spot.clone().field("items").index(i);
            let owner = || group.title.clone();
            if !is_good_id(&item.id) {
                self.fault(MapError::BadId { owner: owner(), id: item.id.clone() }, spot.clone());
            } else if !ids.insert(&item.id) {
                let error = MapError::DuplicatePart { owner: owner(), id: item.id.clone() };
                self.fault(error, spot.clone());
            }
            let exists = self.world.orthoframes.contains_key(&item.orthoframe);
            let id = item.orthoframe.0;
            all_there &= self.exists(exists, &group.title, word!("orthoframe"), id, spot.clone());
            all_there &= self.frame_is_finite(&item.frame, &spot);
        }
        let bases = group.items.iter().filter(|item| item.is_base).count();
        if bases != 1 {
            let error = MapError::BaseItemCount { owner: group.title.clone(), count: bases };
            self.fault(error, spot.clone().field("items"));
        }
        if all_there {
            for (i, link) in group.links.iter().enumerate() {
                self.item_link(group, link, spot.clone().field("links").index(i));
            }
            self.mounts(group);
        }
        if all_there && self.is_sound(group.items) {
            self.origin(group);
            let bodies = self.bodies(group.items);
            self.item_overlaps(group, &bodies);
            self.connected_items(group, &bodies);
        }
    }

    /// The items where they stand in their group. All must be sound.
    pub(super) fn bodies(&self, items: &[Item]) -> Vec<Body> {
        bodies_of(self.world, items)
    }

    /// The base item gives the group its coordinates: a corner of it stands at the origin, or, in an Area whose corners were
    /// put elsewhere since, the origin of its own frame.
    fn origin(&mut self, group: &Group<'_>) {
        for (i, item) in group.items.iter().enumerate().filter(|(_, item)| item.is_base) {
            if group.is_area && keeps_origin(&item.frame) {
                continue;
            }
            let orthoframe = self.world.orthoframe_of(item);
            let corners = orthoframe.corners().map(|p| item.frame.apply(p));
            let nearest = corners
                .min_by(|p, q| p.coords.norm().total_cmp(&q.coords.norm()))
                .expect("a sound base has corners");
            if nearest.coords.norm() > TOLERANCE || item.frame.z.get().abs() > TOLERANCE {
                let error = MapError::BaseItemOffOrigin {
                    owner: group.title.clone(),
                    item: item.id.clone(),
                    nearest: format!(
                        "({}; {}; {})",
                        Short(nearest.x),
                        Short(nearest.y),
                        Short(item.frame.z.get())
                    ),
                };
                self.fault(error, Spot::of(group.record).field("items").index(i).field("at"));
            }
        }
    }

    pub(super) fn item(
        &mut self,
        group: &Group<'w>,
        id: &str,
        spot: &Spot,
    ) -> Option<(usize, &'w Item)> {
        let found = group.items.iter().enumerate().find(|(_, item)| item.id == id);
        if found.is_none() {
            let known: Vec<_> = group.items.iter().map(|item| item.id.as_str()).collect();
            let error = MapError::UnknownItem {
                owner: group.title.clone(),
                item: id.to_owned(),
                known: known.join(", "),
            };
            self.fault(error, spot.clone());
        }
        found
    }

    /// A side of the group, or a fault where there is none.
    pub(super) fn side(
        &mut self,
        group: &Group<'w>,
        side: &SideRef,
        spot: Spot,
    ) -> Option<(&'w Item, &'w BaseVector)> {
        let (_, item) = self.item(group, &side.item, &spot)?;
        let orthoframe = self.world.orthoframes.get(&item.orthoframe)?;
        if self.is_broken(Record::Orthoframe(orthoframe.id)) {
            return None;
        }
        let found = orthoframe.side(&side.side);
        if found.is_none() {
            let known: Vec<_> = orthoframe.base.iter().map(|v| v.id.as_str()).collect();
            let error = MapError::UnknownSide {
                owner: group.title.clone(),
                item: item.id.clone(),
                side: side.side.clone(),
                known: known.join(", "),
            };
            self.fault(error, spot);
        }
        found.map(|(_, vector)| (item, vector))
    }

    fn item_link(&mut self, group: &Group<'w>, link: &ItemLink, spot: Spot) {
        let from = self.item(group, &link.item, &spot.clone().field("from"));
        let to = self.item(group, &link.to_item, &spot.clone().field("to"));
        let (Some((_, from)), Some((to_index, to))) = (from, to) else { return };
        let words = format!(
            "{} - {}",
            face_words(&link.item, &link.face),
            face_words(&link.to_item, &link.to_face)
        );
        let owner = || group.title.clone();
        let claimed = Offset::of(link.rel_x, link.rel_y, link.rel_z, link.rel_a);
        let place = Spot::of(group.record).field("items").index(to_index);
        let found = match (&link.face, &link.to_face) {
            (Face::Side(side), Face::Side(to_side)) => {
                let side = SideRef { item: from.id.clone(), side: side.clone() };
                let to_side = SideRef { item: to.id.clone(), side: to_side.clone() };
                let one = self.side(group, &side, spot.clone().field("from"));
                let other = self.side(group, &to_side, spot.clone().field("to"));
                let (Some((_, one)), Some((_, other))) = (one, other) else { return };
                if !self.is_sound(&[from.clone(), to.clone()]) {
                    return;
                }
                let opening = openings(one, other);
                if opening == Openings::Mixed && group.is_area {
                    self.fault(MapError::LinkPermeability { owner: owner(), link: words }, spot);
                    return;
                }
                if opening == Openings::Both && !same_length(one, other) {
                    let (length, other) = (one.length(), other.length());
                    let error = MapError::LinkLength { owner: owner(), link: words, length, other };
                    self.fault(error, spot);
                    return;
                }
                let placed = PlacedSide::new(one, &from.frame);
                let found = placed.offset(&PlacedSide::new(other, &to.frame));
                let apart = found.distance();
                if opening == Openings::Both && apart > TOLERANCE && claimed.agrees(&found) {
                    let distance = Cm::of(apart);
                    let error = MapError::LinkApart { owner: owner(), link: words, distance };
                    self.contradiction(error, spot, place);
                    return;
                }
                found
            }
            (Face::Side(_), _) | (_, Face::Side(_)) => {
                self.fault(MapError::LinkFaces { owner: owner(), link: words }, spot);
                return;
            }
            (face, to_face) => {
                let d = to.frame.origin() - from.frame.origin();
                let z = self.face_height(to, to_face) - self.face_height(from, face);
                let angle = (to.frame.angle - from.frame.angle).signed();
                Offset { x: d.x, y: d.y, z, angle }
            }
        };
        if !claimed.agrees(&found) {
            let error = MapError::LinkContradicts {
                owner: owner(),
                link: words,
                claimed: claimed.in_words(),
                found: found.in_words(),
            };
            self.contradiction(error, spot, place);
        }
    }

    fn face_height(&self, item: &Item, face: &Face) -> f64 {
        let height = self.world.orthoframe_of(item).height.get();
        item.frame.z.get() + if *face == Face::Roof { height } else { 0.0 }
    }

    /// Parts of an Area never lie in one another; parts of an Object may when one of them is hollow: a shelf in
    /// the body of a bookcase.
    fn item_overlaps(&mut self, group: &Group<'_>, bodies: &[Body]) {
        let boxes: Vec<_> = bodies.iter().map(|b| b.bounds).collect();
        let hollow: Vec<bool> = group
            .items
            .iter()
            .map(|i| !group.is_area && is_hollow(self.world.orthoframe_of(i)))
            .collect();
        let mut overlaps = Vec::new();
        near_pairs(&boxes, 0.0, |i, j| {
            if !hollow[i]
                && !hollow[j]
                && let Some(p) = overlap(&bodies[i], &bodies[j])
            {
                overlaps.push((i, j, p));
            }
            if overlaps.len() < MOST_OVERLAPS {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        for (i, j, p) in overlaps {
            let error = MapError::ItemsOverlap {
                owner: group.title.clone(),
                item: group.items[i].id.clone(),
                other: group.items[j].id.clone(),
                at: at(p),
            };
            let items = Spot::of(group.record).field("items");
            self.contradiction(error, items.clone().index(j), items.index(i));
        }
    }

    /// Every item must hang together with the base item, by links or by touching.
    fn connected_items(&mut self, group: &Group<'_>, bodies: &[Body]) {
        let mut parts = Parts::new(bodies.len());
        let index = |id: &str| group.items.iter().position(|item| item.id == id);
        for link in group.links {
            if let (Some(i), Some(j)) = (index(&link.item), index(&link.to_item)) {
                parts.join(i, j);
            }
        }
        let boxes: Vec<_> = bodies.iter().map(|b| b.bounds).collect();
        if parts.count > 1 {
            near_pairs(&boxes, TOLERANCE, |i, j| {
                let (one, other) = (&bodies[i], &bodies[j]);
                if !parts.joined(i, j)
                    && one.heights_meet(other, TOLERANCE)
                    && touch(&one.polygon, &other.polygon, TOLERANCE)
                {
                    parts.join(i, j);
                }
                if parts.count > 1 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            });
        }
        let base = group.items.iter().position(|item| item.is_base).unwrap_or(0);
        for (i, item) in group.items.iter().enumerate() {
            if !parts.joined(base, i) {
                let error =
                    MapError::ItemsApart { owner: group.title.clone(), item: item.id.clone() };
                self.fault(error, Spot::of(group.record).field("items").index(i));
            }
        }
    }
}

/// The items where they stand in their group.
pub(super) fn bodies_of(world: &World, items: &[Item]) -> Vec<Body> {
    let body = |item: &Item| {
        let orthoframe = world.orthoframe_of(item);
        let polygon: Vec<_> = orthoframe.corners().map(|p| item.frame.apply(p)).collect();
        let bottom = item.frame.z.get();
        Body {
            bounds: bounds(polygon.iter().copied()),
            polygon,
            bottom,
            top: bottom + orthoframe.height.get(),
        }
    };
    items.iter().map(body).collect()
}

/// Something can be inside: a face is open, or is a door.
pub(super) fn is_hollow(orthoframe: &Orthoframe) -> bool {
    let faces = [orthoframe.base_permeability, orthoframe.roof_permeability];
    let sides = orthoframe.base.iter().map(|v| v.permeability);
    faces.into_iter().chain(sides).any(|p| p != Permeability::Impermeable)
}

/// A point in the common part of two bodies, when they share more than a touch.
pub(super) fn overlap(one: &Body, other: &Body) -> Option<Point> {
    if !one.heights_meet(other, -TOLERANCE) {
        return None;
    }
    let common = intersection(&one.polygon, &other.polygon);
    (common.area > OVERLAP).then(|| middle(&common.outlines[0]))
}

/// Whether linked sides let anything through.
#[derive(PartialEq, Eq)]
pub(super) enum Openings {
    None,
    /// Permeable with permeable, or conditional with conditional.
    Both,
    Mixed,
}

pub(super) fn openings(one: &BaseVector, other: &BaseVector) -> Openings {
    match (one.permeability, other.permeability) {
        (Permeability::Impermeable, Permeability::Impermeable) => Openings::None,
        (a, b) if a == b => Openings::Both,
        _ => Openings::Mixed,
    }
}

pub(super) fn same_length(one: &BaseVector, other: &BaseVector) -> bool {
    (one.length() - other.length()).get().abs() <= TOLERANCE
}

fn face_words(item: &str, face: &Face) -> String {
    match face {
        Face::Base => format!("{item}.base"),
        Face::Roof => format!("{item}.roof"),
        Face::Side(side) => format!("{item}.{side}"),
    }
}

/// Disjoint sets of indices.
pub(super) struct Parts {
    parent: Vec<usize>,
    pub(super) count: usize,
}

impl Parts {
    pub(super) fn new(count: usize) -> Self {
        Self { parent: (0..count).collect(), count }
    }

    fn root(&mut self, mut i: usize) -> usize {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    pub(super) fn joined(&mut self, i: usize, j: usize) -> bool {
        self.root(i) == self.root(j)
    }

    pub(super) fn join(&mut self, i: usize, j: usize) {
        let (i, j) = (self.root(i), self.root(j));
        if i != j {
            self.parent[i] = j;
            self.count -= 1;
        }
    }
}
