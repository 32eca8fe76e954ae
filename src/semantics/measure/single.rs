//! One thing by itself: its heights and sizes, and the Area in which it stands.

use crate::geometry::Bounds;
use crate::geometry::contact::Footprint;
use crate::units::{AreaId, ObjectId};

use super::super::body::Body;
use super::rooms::Room;
use super::{Measurements, cm, hundredths, tenths};

/// One thing by itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Single {
    pub object: ObjectId,
    pub fragment: AreaId,
    pub move_prob: u8,
    pub bottom: i64,
    pub top: i64,
    /// The smaller of its sizes along its own axes.
    pub thin: i64,
    /// Mean of its sizes along its own axes.
    pub mean_size: i64,
    /// cm² of its outline.
    pub base: i64,
    pub place: Located,
    /// Where it stands in its Fragment's frame: x, y, z, angle.
    pub at: [i64; 4],
    /// Near walls of the Area where it is, by their places among its walls, with the distance in the plan.
    pub walls: Vec<(usize, i64)>,
    /// Near doors and passages, by the Areas of their sides and their places among the open sides of these, with the
    /// distance in the plan.
    pub openings: Vec<((AreaId, usize), i64)>,
    /// From the middle of the Area whose base holds it.
    pub middle: Option<i64>,
}

/// Which Area holds the interior point of a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Located {
    /// Within the base of the Area: height above its floor, and of the foot below its ceiling.
    In { area: AreaId, above_floor: i64, below_ceiling: i64 },
    /// In no Area's base; so far from the base of its own Fragment.
    Out { fragment: AreaId, distance: i64 },
    /// In no Area, and far from its Fragment.
    Nowhere,
}

impl Single {
    #[must_use]
    pub fn area(&self) -> Option<AreaId> {
        match self.place {
            Located::In { area, .. } => Some(area),
            _ => None,
        }
    }
}

impl Measurements {
    pub(super) fn single(&self, body: &Body) -> Single {
        let kind = &self.kinds[&body.object];
        let place = self.locate(body);
        let room = match place {
            Located::In { area, .. } => Some(area),
            Located::Out { fragment, .. } => Some(fragment),
            Located::Nowhere => None,
        };
        let frame = &body.frame;
        let origin = frame.origin();
        Single {
            object: body.object,
            fragment: body.fragment,
            move_prob: body.move_prob,
            bottom: tenths(body.bottom),
            top: tenths(body.top),
            thin: tenths(kind.size.0.min(kind.size.1)),
            mean_size: tenths(f64::midpoint(kind.size.0, kind.size.1)),
            base: kind.outline_area.round() as i64,
            at: [
                tenths(origin.x),
                tenths(origin.y),
                frame.z.to_tenths_mm(),
                hundredths(frame.angle.get()),
            ],
            walls: room.map(|room| self.near_walls(body, room)).unwrap_or_default(),
            openings: self.near_openings(body),
            middle: room.and_then(|room| self.to_middle(body, room)),
            place,
        }
    }

    fn locate(&self, body: &Body) -> Located {
        let p = body.interior_point();
        let floor_at = |room: &Room| {
            let here = |f: &&(Footprint, f64, f64)| f.0.contains(p);
            let storey = |f: &&(Footprint, f64, f64)| body.bottom <= f.2 && body.top >= f.1;
            let parts = || room.parts.iter().filter(here);
            parts().find(storey).map(|&(_, bottom, top)| Located::In {
                area: room.id,
                above_floor: tenths(body.bottom - bottom),
                below_ceiling: tenths(top - body.bottom),
            })
        };
        let mut near = Vec::new();
        if let Some(grid) = self.room_grid.get(&body.map) {
            grid.near(&Bounds { min: p, max: p }, &mut near);
        }
        // Where bases meet or overlap, the Map's maker decides.
        let own = self.rooms.get(&body.fragment);
        let others = near.iter().filter_map(|id| self.rooms.get(id));
        if let Some(place) = own.into_iter().chain(others).find_map(floor_at) {
            return place;
        }
        let distance = own.map_or(f64::INFINITY, |room| {
            room.parts.iter().map(|(f, _, _)| f.distance_to(p)).fold(f64::INFINITY, f64::min)
        });
        if distance <= cm(self.reach.outside) {
            Located::Out { fragment: body.fragment, distance: tenths(distance) }
        } else {
            Located::Nowhere
        }
    }
}
