//! Zones on the floor of a Map: where they lie, and what they say to the robot.
//!
//! A shut zone (keep-out, closed) takes floor away as a body of the robot's height would: the robot's whole body keeps out of
//! it. What slow and one-way zones do to ways stands in [`super::lawful`].

use crate::map::{Extent, World, Zone, ZoneKind};
use crate::units::{MapId, Point, ZoneId};

use super::blocker::{Blocker, Obstacle};
use super::scene::Scene;
use super::{Bounds, Polygon};

/// A zone in the frame of a Map.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedZone {
    pub id: ZoneId,
    pub kind: ZoneKind,
    /// Counter-clockwise; several where it is made of Areas.
    pub polygons: Vec<Polygon>,
}

impl PlacedZone {
    /// What lies of a zone on a Map; none where nothing does.
    fn of(scene: &Scene, map: MapId, zone: &Zone) -> Option<Self> {
        let polygons: Vec<Polygon> = match &zone.extent {
            Extent::Polygon { map: own, corners } if *own == map => {
                vec![Polygon::new(corners.clone()).counter_clockwise()]
            }
            Extent::Polygon { .. } => Vec::new(),
            Extent::Areas(areas) => {
                let placed = areas.iter().filter_map(|area| scene.areas.get(area));
                placed.flat_map(|a| &a.prisms).map(|p| p.polygon.clone()).collect()
            }
        };
        (!polygons.is_empty()).then_some(Self { id: zone.id, kind: zone.kind, polygons })
    }

    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.polygons.iter().fold(Bounds::EMPTY, |b, p| b.union(&p.bounds()))
    }

    /// Whether a point lies in it, or so near to it, in cm; with a margin below 0, so deep in it.
    #[must_use]
    pub fn contains(&self, p: Point, margin: f64) -> bool {
        self.polygons.iter().any(|polygon| {
            if margin >= 0.0 {
                polygon.contains(p, margin)
            } else {
                polygon.contains(p, 0.0) && polygon.border_distance(p) >= -margin
            }
        })
    }
}

/// The zones of a Map among those of a world that are wanted, in the order of their ids.
pub(super) fn placed(
    world: &World,
    scene: &Scene,
    map: MapId,
    is_wanted: impl Fn(&Zone) -> bool,
) -> Vec<PlacedZone> {
    let wanted = world.zones.values().filter(|zone| is_wanted(zone));
    wanted.filter_map(|zone| PlacedZone::of(scene, map, zone)).collect()
}

/// The floor that shut zones take, as far as it meets one of the boxes, for a robot so high.
pub(super) fn obstacles_of(zones: &[PlacedZone], near: &[Bounds], height: f64) -> Vec<Obstacle> {
    let shut = zones.iter().filter(|zone| zone.kind.is_shut());
    let all = shut.flat_map(|zone| zone.polygons.iter().map(|polygon| (zone.id, polygon)));
    let meets = |polygon: &Polygon| {
        let bounds = polygon.bounds();
        near.iter().any(|b| b.meets(&bounds))
    };
    all.filter(|(_, polygon)| meets(polygon))
        .map(|(zone, polygon)| Obstacle {
            blocker: Blocker::Zone { zone },
            polygon: polygon.clone(),
            side: None,
            bottom: 0.0,
            top: height,
        })
        .collect()
}

/// What zones shut that others do not, either way.
pub(super) fn shut_otherwise(before: &[PlacedZone], after: &[PlacedZone]) -> Vec<Bounds> {
    let shut = |zones: &[PlacedZone], others: &[PlacedZone]| -> Vec<Bounds> {
        let news = zones.iter().filter(|z| z.kind.is_shut() && !others.contains(z));
        news.map(|z| z.bounds().grown(0.2)).collect()
    };
    [shut(before, after), shut(after, before)].concat()
}
