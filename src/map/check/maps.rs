//! Maps and their Domain (M5, M6): each Area once, linked sides that coincide, no two Areas in one place.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::ControlFlow;
use std::sync::Arc;

use crate::fault::{MapError, Record, Spot};
use crate::units::{
    AreaId, Bilingual, Cm, DoorId, Frame, Gather as _, InOrder as _, OrFrId, Vector, said, word,
};
use crate::{BaseVector, Map, MapItem, MapLink, SideRef, TypeKind};

use super::group::{
    Body, Group, Offset, Openings, Parts, PlacedSide, keeps_origin, openings, overlap, same_length,
};
use super::plane::{Bounds, bounds, near_pairs};
use super::{Checker, MOST_OVERLAPS, Short, TOLERANCE, area_title, at};

/// Whether two boxes have a point in common.
fn meet((low, high): &Bounds, (least, most): &Bounds) -> bool {
    low.x <= most.x && least.x <= high.x && low.y <= most.y && least.y <= high.y
}

/// Whether a frame has numbers that can be computed with.
fn is_finite(frame: &Frame) -> bool {
    [frame.x, frame.y, frame.z].iter().all(|n| Cm::new(n.get()).is_ok())
        && Cm::new(frame.angle.get()).is_ok()
}

impl<'w> Checker<'w> {
    pub(super) fn maps(&mut self) {
        let mut keys = BTreeSet::new();
        let mut placed: HashMap<AreaId, usize> = HashMap::new();
        if self.scope.is_some_and(|scope| !scope.has_standing()) {
            return;
        }
        for map in self.world.maps.values() {
            let record = Record::Map(map.id);
            let spot = Spot::of(record);
            self.key(&mut keys, &map.key, word!("map"), &spot);
            for (i, item) in map.items.iter().enumerate() {
                let count = placed.entry(item.area).or_default();
                *count += 1;
                if *count == 2 {
                    let area = area_title(self.world, item.area);
                    self.fault(MapError::AreaTwice { area }, spot.clone().field("items").index(i));
                }
            }
            if !self.is_broken(record) && self.asks_for(record) {
                self.map(map, &spot);
            }
        }
        let all_maps_read = !self.broken.iter().any(|r| matches!(r, Record::Map(_)));
        for area in self.world.areas.values() {
            if all_maps_read && !placed.contains_key(&area.id) {
                let error = MapError::AreaNowhere { area: area.name.clone() };
                self.fault(error, Spot::of(Record::Area(area.id)));
            }
        }
    }

    fn map(&mut self, map: &'w Map, spot: &Spot) {
        let title = Bilingual::named(word!("map-2"), &map.name);
        self.type_exists(TypeKind::Map, map.map_type, &title, spot);
        if map.items.is_empty() {
            self.fault(MapError::NoItems { owner: title }, spot.clone());
            return;
        }
        let mut all_there = true;
        for (i, item) in map.items.iter().enumerate() {
            let exists = self.world.areas.contains_key(&item.area);
            if exists && is_finite(&item.frame) {
                continue;
            }
            let at = spot.clone().field("items").index(i);
            all_there &= self.exists(exists, &title, word!("area"), item.area.0, at.clone());
            all_there &= self.frame_is_finite(&item.frame, &at);
        }
        let bases = map.items.iter().filter(|item| item.is_base).count();
        if bases != 1 {
            let error = MapError::BaseItemCount { owner: title.clone(), count: bases };
            self.fault(error, spot.clone().field("items"));
        }
        if !all_there {
            return;
        }
        let is_meant = |(i, link): &(usize, &Arc<MapLink>)| {
            self.scope.is_none_or(|scope| scope.has_link(map, *i, link))
        };
        let links: Vec<_> = map.links.iter().enumerate().filter(is_meant).collect();
        for (i, link) in links {
            self.map_link(map, &title, link, spot.clone().field("links").index(i));
        }
        self.map_origin(map, &title, spot);
        self.area_overlaps(map, &title, spot);
        self.connected_areas(map, &title, spot);
    }

    /// The base Area stands with a corner of its base item, or with that one's own origin, at the origin of the Map, where the
    /// coordinates are its own.
    fn map_origin(&mut self, map: &Map, title: &Bilingual, spot: &Spot) {
        if !map.frame.is_empty() {
            return;
        }
        for (i, item) in map.items.iter().enumerate().filter(|(_, item)| item.is_base) {
            let area = &self.world.areas[&item.area];
            let Some(base) = area.items.iter().find(|item| item.is_base) else { continue };
            if self.is_broken(Record::Area(area.id)) || !self.can_be_measured(base.orthoframe) {
                continue;
            }
            let frame = item.frame.compose(&base.frame);
            if keeps_origin(&frame) {
                continue;
            }
            let corners = self.world.orthoframe_of(base).corners().map(|p| frame.apply(p));
            let nearest = corners
                .min_by(|p, q| p.coords.norm().total_cmp(&q.coords.norm()))
                .expect("a sound base has corners");
            if nearest.coords.norm() > TOLERANCE || frame.z.get().abs() > TOLERANCE {
                let error = MapError::BaseItemOffOrigin {
                    owner: title.clone(),
                    item: area.name.clone(),
                    nearest: format!(
                        "({}; {}; {})",
                        Short(nearest.x),
                        Short(nearest.y),
                        Short(frame.z.get())
                    ),
                };
                self.fault(error, spot.clone().field("items").index(i).field("at"));
            }
        }
    }

    /// A side of a Map's Area and the frame in which its item stands on the Map.
    fn map_side(
        &mut self,
        map: &Map,
        title: &Bilingual,
        area: AreaId,
        side: &SideRef,
        spot: &Spot,
    ) -> Option<(&'w BaseVector, Frame, usize)> {
        let known = self.placed(area).filter(|(on, _)| *on == map.id);
        let found = match known {
            Some((_, index)) => Some((index, &map.items[index])),
            None => map.items.iter().enumerate().find(|(_, i)| i.area == area),
        };
        let Some((index, item)) = found else {
            let error = MapError::UnknownReference {
                what: said!("area-on-this-map"),
                name: area_title(self.world, area),
                nearest: None,
            };
            self.fault(error, spot.clone());
            return None;
        };
        if self.is_broken(Record::Area(area)) {
            return None;
        }
        let group = Group {
            title: title.clone(),
            record: Record::Map(map.id),
            items: &self.world.areas[&area].items,
            links: &[],
            doors: &[],
            is_area: true,
        };
        let (inner, vector) = self.side(&group, side, spot.clone())?;
        self.can_be_measured(inner.orthoframe)
            .then(|| (vector, item.frame.compose(&inner.frame), index))
    }

    fn map_link(&mut self, map: &Map, title: &Bilingual, link: &MapLink, spot: Spot) {
        let from = spot.clone().field("from");
        let one = self.map_side(map, title, link.area, &link.side, &from);
        let to = spot.clone().field("to");
        let other = self.map_side(map, title, link.to_area, &link.to_side, &to);
        let (Some((one, frame, _)), Some((other, to_frame, to_index))) = (one, other) else {
            return;
        };
        let owner = title.clone();
        let words = |area, side: &SideRef| {
            format!("{}.{}.{}", area_title(self.world, area), side.item, side.side)
        };
        let words =
            format!("{} - {}", words(link.area, &link.side), words(link.to_area, &link.to_side));
        let opening = openings(one, other);
        if opening == Openings::Mixed {
            self.fault(MapError::LinkPermeability { owner, link: words }, spot);
            return;
        }
        if opening == Openings::Both && !same_length(one, other) {
            let (length, other) = (one.length(), other.length());
            self.fault(MapError::LinkLength { owner, link: words, length, other }, spot);
            return;
        }
        let claimed = Offset::of(link.rel_x, link.rel_y, link.rel_z, link.rel_a);
        let found = PlacedSide::new(one, &frame).offset(&PlacedSide::new(other, &to_frame));
        let place = Spot::of(Record::Map(map.id)).field("items").index(to_index);
        if !claimed.agrees(&found) {
            let (claimed, found) = (claimed.in_words(), found.in_words());
            let error = MapError::LinkContradicts { owner, link: words, claimed, found };
            self.contradiction(error, spot, place);
        } else if opening == Openings::Both && found.distance() > TOLERANCE {
            let distance = Cm::of(found.distance());
            self.contradiction(MapError::LinkApart { owner, link: words, distance }, spot, place);
        }
    }

    /// The items of an Area where they stand on the Map; nothing when they cannot be measured.
    fn placed_bodies(&self, item: &MapItem) -> Vec<Body> {
        let area = &self.world.areas[&item.area];
        if self.is_broken(Record::Area(area.id)) || !self.is_sound(&area.items) {
            return Vec::new();
        }
        let mut bodies = self.bodies(&area.items);
        for body in &mut bodies {
            body.polygon.iter_mut().for_each(|p| *p = item.frame.apply(*p));
            body.bounds = bounds(body.polygon.iter().copied());
            body.bottom += item.frame.z.get();
            body.top += item.frame.z.get();
        }
        bodies
    }

    /// A box round an Area where it stands on the Map.
    fn bounds_of(&self, item: &MapItem) -> Option<Bounds> {
        let items = &self.world.areas.get(&item.area)?.items;
        let frames = items.iter().filter_map(|own| {
            Some((self.world.orthoframes.get(&own.orthoframe)?, item.frame.compose(&own.frame)))
        });
        let mut corners =
            frames.flat_map(|(part, frame)| part.corners().map(move |p| frame.apply(p))).peekable();
        corners.peek()?;
        Some(bounds(corners))
    }

    /// A box in which an Area lies where it stands on the Map, whichever way it is turned; `reaches` keeps how far from their
    /// origins Orthoframes reach.
    fn roughly(&self, item: &MapItem, reaches: &RefCell<HashMap<OrFrId, f64>>) -> Option<Bounds> {
        let items = &self.world.areas.get(&item.area)?.items;
        let mut reaches = reaches.borrow_mut();
        let reach = items.iter().filter_map(|own| {
            let part = self.world.orthoframes.get(&own.orthoframe)?;
            let farthest = || part.corners().map(|p| p.coords.norm()).fold(0.0, f64::max);
            let reach = reaches.entry(own.orthoframe).or_insert_with(farthest);
            Some(own.frame.origin().coords.norm() + *reach)
        });
        let reach = reach.reduce(f64::max)?;
        let (at, way) = (item.frame.origin(), Vector::new(reach, reach));
        Some((at - way, at + way))
    }

    fn area_overlaps(&mut self, map: &Map, title: &Bilingual, spot: &Spot) {
        let mut owners = Vec::new();
        let mut bodies = Vec::new();
        // Two Areas that stand as they did overlap as they did.
        let is_changed =
            |item: &MapItem| self.scope.is_none_or(|scope| scope.moved.contains(&item.area));
        let changed: Vec<_> = map.items.iter().filter(|item| is_changed(item)).collect();
        let boxes: Vec<Bounds> = changed.iter().filter_map(|item| self.bounds_of(item)).collect();
        let reaches = RefCell::default();
        let is_near = |item: &MapItem| {
            let meets = |own: Bounds| boxes.iter().any(|b| meet(&own, b));
            self.scope.is_none()
                || self.roughly(item, &reaches).is_some_and(meets)
                    && self.bounds_of(item).is_some_and(meets)
        };
        for (i, item) in map.items.iter().enumerate().filter(|(_, item)| is_near(item)) {
            let placed = self.placed_bodies(item);
            owners.extend(std::iter::repeat_n(i, placed.len()));
            bodies.extend(placed);
        }
        let boxes: Vec<_> = bodies.iter().map(|b| b.bounds).collect();
        let mut overlaps = BTreeMap::new();
        near_pairs(&boxes, 0.0, |i, j| {
            let pair = (owners[i].min(owners[j]), owners[i].max(owners[j]));
            if pair.0 != pair.1
                && (is_changed(&map.items[pair.0]) || is_changed(&map.items[pair.1]))
                && !overlaps.contains_key(&pair)
                && let Some(p) = overlap(&bodies[i], &bodies[j])
            {
                overlaps.insert(pair, p);
            }
            if overlaps.len() < MOST_OVERLAPS {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        });
        for ((i, j), p) in overlaps {
            let name = |i: usize| area_title(self.world, map.items[i].area);
            let error = MapError::AreasOverlap {
                map: title.clone(),
                area: name(i),
                other: name(j),
                at: at(p),
            };
            let items = spot.clone().field("items");
            self.contradiction(error, items.clone().index(j), items.index(i));
        }
    }

    fn connected_areas(&mut self, map: &Map, title: &Bilingual, spot: &Spot) {
        // What was checked before hangs together.
        if self.scope.is_some_and(|scope| scope.came_linked(map)) {
            return;
        }
        let mut parts = Parts::new(map.items.len());
        // Of one that stands twice the last place counts.
        let mut indices: Vec<(AreaId, usize)> =
            map.items.iter().enumerate().map(|(i, item)| (item.area, i)).collect();
        indices.order();
        let index = |area: AreaId| {
            let (own, i) = indices[..indices.partition_point(|(own, _)| *own <= area)].last()?;
            (*own == area).then_some(*i)
        };
        for link in &map.links {
            if let (Some(i), Some(j)) = (index(link.area), index(link.to_area)) {
                parts.join(i, j);
            }
        }
        let mut mounts: Vec<(DoorId, usize)> = Vec::new();
        for item in &map.items {
            for mount in self.world.areas.get(&item.area).map_or(&[][..], |a| &a.doors) {
                mounts.extend(index(item.area).map(|i| (mount.door, i)));
            }
        }
        mounts.order_by_key(|(door, _)| *door);
        for mounted in mounts.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, one), (_, other)] = mounted {
                parts.join(*one, *other);
            }
        }
        let base = map.items.iter().position(|item| item.is_base).unwrap_or(0);
        for (i, item) in map.items.iter().enumerate() {
            if !parts.joined(base, i) {
                let area = area_title(self.world, item.area);
                let error = MapError::AreasApart { map: title.clone(), area };
                self.fault(error, spot.clone().field("items").index(i));
            }
        }
    }

    /// Every Map once in the Domain, one of them its base, lifts between different Maps.
    pub(super) fn domain(&mut self) {
        let domain = &self.world.domain;
        let spot = Spot::of(Record::Domain);
        if self.is_broken(Record::Domain) {
            return;
        }
        let owner = Bilingual::named(word!("domain"), &domain.name);
        for (i, item) in domain.maps.iter().enumerate() {
            let at = spot.clone().field("maps").index(i);
            let exists = self.world.maps.contains_key(&item.map);
            self.exists(exists, &owner, word!("map-2"), item.map.0, at.clone());
            let frame = &item.frame;
            let is_finite = self.frame_is_finite(frame, &at);
            if is_finite && item.is_base && *frame != Frame::IDENTITY {
                let error = MapError::BaseItemOffOrigin {
                    owner: owner.clone(),
                    item: self.world.maps.get(&item.map).map_or(String::new(), |m| m.name.clone()),
                    nearest: format!("({}; {})", Short(frame.x.get()), Short(frame.y.get())),
                };
                self.fault(error, at);
            }
        }
        let bases = domain.maps.iter().filter(|m| m.is_base).count();
        if bases != 1 && !self.world.maps.is_empty() && !domain.maps.is_empty() {
            let error = MapError::BaseItemCount { owner, count: bases };
            self.fault(error, spot.clone().field("maps"));
        }
        let mut counts: BTreeMap<_, usize> = self.world.maps.keys().map(|&id| (id, 0)).gather();
        domain.maps.iter().for_each(|m| *counts.entry(m.map).or_default() += 1);
        for map in self.world.maps.values() {
            let count = counts[&map.id];
            if count != 1 {
                let error = MapError::DomainMaps { map: map.name.clone(), count };
                let map = Spot::of(Record::Map(map.id));
                self.contradiction(error, map, spot.clone().field("maps"));
            }
        }
        self.lifts(&spot);
    }

    fn lifts(&mut self, spot: &Spot) {
        for (i, (name, stops)) in self.world.domain.lifts.iter().enumerate() {
            let at = spot.clone().field("lifts").index(i);
            let mut floors = BTreeSet::new();
            let mut all_there = true;
            for stop in stops {
                let exists = self.world.areas.contains_key(&stop.area);
                let owner = Bilingual::named(word!("lift"), name);
                all_there &= self.exists(exists, &owner, word!("area"), stop.area.0, at.clone());
                floors.extend(self.world.placement(stop.area).map(|(map, _)| map));
            }
            if all_there && floors.len() < 2 {
                self.fault(MapError::LiftStops { lift: name.clone() }, at);
            }
        }
    }
}
