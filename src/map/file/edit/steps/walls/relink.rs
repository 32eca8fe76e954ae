//! What links say of where sides lie, told anew where a room or its walls went elsewhere.

use std::sync::Arc;

use super::super::Steps;
use crate::units::{AreaId, Cm, Deg, Frame, MapId, Point};
use crate::{Area, Face, Item, SideRef};

/// What differs by no more is the same number, worked out in another way; cm or degrees.
const EXACT: f64 = 1e-6;

/// What a link says of where its second side lies to its first: its number in the list, the offset, and the angle.
type Told = (usize, [f64; 2], f64);

impl Steps<'_> {
    /// Where the sides of an Area lie to those that they are linked with, on the Map and in the Area, is told anew.
    pub(in crate::file::edit::steps) fn relink(&mut self, area: AreaId) {
        let maps: Vec<MapId> = self.world.maps.keys().copied().collect();
        for map in maps {
            let found = self.told_anew(map, area);
            if found.is_empty() {
                continue;
            }
            let links = &mut self.map_mut(map).links;
            for (no, [x, y], degrees) in found {
                let link = Arc::make_mut(&mut links[no]);
                (link.rel_x, link.rel_y, link.rel_a) = (Cm::of(x), Cm::of(y), Deg::of(degrees));
            }
        }
        let found = self.told_anew_within(area);
        if !found.is_empty() {
            let links = &mut self.area_mut(area).links;
            for (no, [x, y], degrees) in found {
                let link = &mut links[no];
                (link.rel_x, link.rel_y, link.rel_a) = (Cm::of(x), Cm::of(y), Deg::of(degrees));
            }
        }
    }

    /// The links of a Map that speak of an Area and say something else than is so. What cannot be measured is told by the checks.
    fn told_anew(&self, map: MapId, area: AreaId) -> Vec<Told> {
        let map = &self.world.maps[&map];
        let placed = |of: AreaId, side: &SideRef| {
            let on_map = map.items.iter().find(|item| item.area == of)?;
            let own = self.placed_in(self.world.areas.get(&of)?, &side.item, &side.side)?;
            Some(own.map(|p| on_map.frame.apply(p)))
        };
        let links = map.links.iter().enumerate();
        let of_area = links.filter(|(_, link)| link.area == area || link.to_area == area);
        let anew = of_area.filter_map(|(no, link)| {
            let one = placed(link.area, &link.side)?;
            let other = placed(link.to_area, &link.to_side)?;
            let told = Frame { x: link.rel_x, y: link.rel_y, z: link.rel_z, angle: link.rel_a };
            anew(&told, &one, &other).map(|(by, degrees)| (no, by, degrees))
        });
        anew.collect()
    }

    /// The same of the links between sides of an Area's items.
    fn told_anew_within(&self, area: AreaId) -> Vec<Told> {
        let area = &self.world.areas[&area];
        let placed = |item: &str, face: &Face| match face {
            Face::Side(side) => self.placed_in(area, item, side),
            Face::Base | Face::Roof => None,
        };
        let anew = area.links.iter().enumerate().filter_map(|(no, link)| {
            let one = placed(&link.item, &link.face)?;
            let other = placed(&link.to_item, &link.to_face)?;
            let told = Frame { x: link.rel_x, y: link.rel_y, z: link.rel_z, angle: link.rel_a };
            anew(&told, &one, &other).map(|(by, degrees)| (no, by, degrees))
        });
        anew.collect()
    }

    /// A side of an Area in its frame: where it begins and where it ends; none where that is no side.
    fn placed_in(&self, area: &Area, item: &str, side: &str) -> Option<[Point; 2]> {
        let item: &Item = area.items.iter().find(|own| own.id == item)?;
        let part = self.world.orthoframes.get(&item.orthoframe)?;
        let side = part.base.iter().find(|vector| vector.id == side)?;
        Some([side.start, side.end].map(|p| item.frame.apply(p)))
    }
}

/// What is to be told of where one side lies to another, where something else is told.
fn anew(told: &Frame, one: &[Point; 2], other: &[Point; 2]) -> Option<([f64; 2], f64)> {
    let (by, degrees) = offset(one, other);
    let is_as_told = |is: f64, told: f64| (is - told).abs() < EXACT;
    let angle = told.angle.get();
    let is_same = is_as_told(by[0], told.x.get())
        && is_as_told(by[1], told.y.get())
        && is_as_told(degrees, angle);
    (!is_same).then_some((by, degrees))
}

/// The offset of a side from another, and its angle less that of the other, turned round where they lie back to back.
fn offset(one: &[Point; 2], other: &[Point; 2]) -> ([f64; 2], f64) {
    let direction = |s: &[Point; 2]| (s[1].y - s[0].y).atan2(s[1].x - s[0].x).to_degrees();
    let signed = |degrees: f64| (degrees + 180.0).rem_euclid(360.0) - 180.0;
    let turn = signed(direction(other) - direction(one));
    let is_reversed = turn.abs() > 90.0;
    let corner = if is_reversed { other[1] } else { other[0] };
    let angle = if is_reversed { signed(turn - 180.0) } else { turn };
    ([corner.x - one[0].x, corner.y - one[0].y], angle)
}
