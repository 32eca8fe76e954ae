//! The floors of the Areas, ready for measuring, and which of them lie under a point.

use crate::geometry::contact::{Footprint, overlap_area};
use crate::geometry::{Bounds, Polygon};
use crate::map::{Item, World};
use crate::units::{AreaId, Frame, MapId, Point};

use super::Measurements;
use crate::body::Body;

/// The floor of one Area, ready for measuring.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Room {
    pub(crate) id: AreaId,
    pub(crate) map: MapId,
    pub(crate) parts: Vec<(Footprint, f64, f64)>,
    pub(crate) bounds: Bounds,
}

/// How an Area of another storey lies to one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OtherStorey {
    pub(crate) area: AreaId,
    /// How much higher it begins, cm.
    pub(crate) rise: f64,
    /// What both have in common in the plan, as a share of the smaller floor.
    pub(crate) shared: f64,
}

impl Measurements {
    /// How the Areas of other Maps lie to an Area, as the Domain places these Maps; in the order of their ids. There are
    /// none where the Domain does not place the Area's own Map.
    pub(crate) fn on_other_storeys(&self, world: &World, area: AreaId) -> Vec<OtherStorey> {
        let frame_of = |room: &Room| {
            world.domain.maps.iter().find(|placed| placed.map == room.map).map(|m| m.frame)
        };
        let Some((own, frame)) = self.rooms.get(&area).and_then(|r| Some((r, frame_of(r)?))) else {
            return Vec::new();
        };
        let lowest = |room: &Room, frame: &Frame| {
            let bottoms = room.parts.iter().map(|(_, bottom, _)| frame.z.get() + bottom);
            bottoms.fold(f64::INFINITY, f64::min)
        };
        let base = |room: &Room, frame: &Frame| -> Vec<Footprint> {
            room.parts.iter().map(|(part, _, _)| part.placed(frame)).collect()
        };
        let size = |parts: &[Footprint]| parts.iter().map(|part| part.area).sum::<f64>();
        let (height, own_base) = (lowest(own, &frame), base(own, &frame));
        let own_size = size(&own_base);
        let lie = |room: &Room| {
            let other = frame_of(room).filter(|_| room.map != own.map)?;
            let other_base = base(room, &other);
            let pairs = other_base.iter().flat_map(|a| own_base.iter().map(move |b| (a, b)));
            let common: f64 = pairs.map(|(a, b)| overlap_area(a, b)).sum();
            let shared = common / own_size.min(size(&other_base));
            Some(OtherStorey { area: room.id, rise: lowest(room, &other) - height, shared })
        };
        self.rooms.values().filter_map(lie).collect()
    }

    /// The Area whose base holds a point of a Map; the lowest id where bases meet.
    #[must_use]
    pub fn area_at(&self, map: MapId, p: Point) -> Option<AreaId> {
        let mut near = Vec::new();
        self.room_grid.get(&map)?.near(&Bounds { min: p, max: p }, &mut near);
        near.into_iter().find(|id| self.rooms[id].parts.iter().any(|(f, _, _)| f.contains(p)))
    }
}

impl Measurements {
    /// The things of a Map whose bounds come as near to a point, in cm.
    pub(crate) fn near_to(&self, map: MapId, p: Point, reach: f64) -> impl Iterator<Item = &Body> {
        let bounds = Bounds { min: p, max: p }.grown(reach);
        let mut near = Vec::new();
        if let Some(grid) = self.grids.get(&map) {
            grid.near(&bounds, &mut near);
        }
        near.into_iter()
            .filter_map(|id| self.bodies.get(&id))
            .filter(move |b| b.bounds.meets(&bounds))
    }
}

impl Room {
    /// The floor of an Area that stands so on a Map.
    pub(crate) fn of(world: &World, id: AreaId, (map, frame): (MapId, Frame)) -> Option<Self> {
        let part = |item: &Item| {
            let orthoframe = world.orthoframe_of(item);
            let place = frame.compose(&item.frame);
            let base = Polygon::new(orthoframe.corners().map(|p| place.apply(p)).collect());
            let bottom = place.z.get();
            (Footprint::new(base), bottom, bottom + orthoframe.height.get())
        };
        let parts: Vec<_> = world.areas.get(&id)?.items.iter().map(part).collect();
        let bounds = parts.iter().fold(Bounds::EMPTY, |b, (f, _, _)| b.union(&f.bounds));
        Some(Self { id, map, parts, bounds })
    }
}
