//! The floors of the Areas, ready for measuring, and which of them lie under a point.

use crate::geometry::contact::Footprint;
use crate::geometry::{Bounds, Polygon};
use crate::map::{Item, World};
use crate::units::{AreaId, Frame, MapId, Point};

use super::Measurements;

/// The floor of one Area, ready for measuring.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Room {
    pub(crate) id: AreaId,
    pub(crate) map: MapId,
    pub(crate) parts: Vec<(Footprint, f64, f64)>,
    pub(crate) bounds: Bounds,
}

impl Measurements {
    /// The Area whose base holds a point of a Map; the lowest id where bases meet.
    #[must_use]
    pub fn area_at(&self, map: MapId, p: Point) -> Option<AreaId> {
        let mut near = Vec::new();
        self.room_grid.get(&map)?.near(&Bounds { min: p, max: p }, &mut near);
        near.into_iter().find(|id| self.rooms[id].parts.iter().any(|(f, _, _)| f.contains(p)))
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
