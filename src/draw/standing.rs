//! What every plan of a floor shows: its rooms and things, doors as they stand, places and zones.

use std::collections::HashSet;
use std::sync::Arc;

use crate::geometry::{Bounds, FloorPlan, Opening, PlacedZone};
use crate::map::World;
use crate::units::{AreaId, Language, PlaceId, Point, ZoneId};

use super::plan::{DoorGlyph, FloorLayer, NetworkLayer, PlanDrawing, RouteLayer, ViewLayer};
use super::zones::ZoneGlyph;

impl<'a> PlanDrawing<'a> {
    /// A floor, or one Area of it, without free floor, routes and views. `rule` tells in words what a zone asks for.
    #[must_use]
    pub fn of(
        world: &'a World,
        floor: &'a FloorPlan,
        only: Option<AreaId>,
        language: Language,
        rule: &dyn Fn(ZoneId) -> String,
    ) -> Self {
        Self {
            world,
            scene: floor.scene(),
            only,
            doors: door_glyphs(world, floor, only),
            floor: FloorLayer::default(),
            network: NetworkLayer::default(),
            route: RouteLayer::default(),
            view: ViewLayer::default(),
            places: places(world, floor, only, language),
            zones: zone_glyphs(world, floor, only, language, rule),
            language,
        }
    }
}

fn door_glyphs(world: &World, floor: &FloorPlan, only: Option<AreaId>) -> Vec<DoorGlyph> {
    let glyphs = |doorway: &Opening| {
        let Some(door) = doorway.door.and_then(|id| world.doors.get(&id)) else {
            return Vec::new();
        };
        let leaves = doorway.leaves(door).at(door.state);
        let mut arcs = doorway.leaves(door).arcs().into_iter();
        let status = door.state.status;
        leaves
            .into_iter()
            .map(|leaf| DoorGlyph {
                leaf,
                arc: arcs.next().unwrap_or_default(),
                status,
                door: door.id,
            })
            .collect()
    };
    let doorways = floor.doorways().iter().map(Arc::as_ref);
    let between = doorways.filter(|d| only.is_none_or(|a| d.areas.contains(&a)));
    between.chain(outer_doors(floor, only)).flat_map(glyphs).collect()
}

/// The doors that join no two Areas: they lead out of the map.
pub fn outer_doors(floor: &FloorPlan, only: Option<AreaId>) -> impl Iterator<Item = &Opening> {
    let joined: HashSet<_> = floor.doorways().iter().filter_map(|d| d.door).collect();
    let outer = floor.blind_openings().iter().map(Arc::as_ref);
    outer.filter(move |o| {
        o.door.is_some_and(|door| !joined.contains(&door)) && only.is_none_or(|only| o.is_of(only))
    })
}

/// The zones of a map, those for a time among them.
fn zone_glyphs(
    world: &World,
    floor: &FloorPlan,
    only: Option<AreaId>,
    language: Language,
    rule: &dyn Fn(ZoneId) -> String,
) -> Vec<ZoneGlyph> {
    let all = floor.with_zones(world, |_| true);
    let room = only.and_then(|area| floor.scene().areas.get(&area));
    let room =
        room.map(|a| a.prisms.iter().map(|p| p.bounds).fold(Bounds::EMPTY, |a, b| a.union(&b)));
    let is_shown =
        |zone: &&PlacedZone| room.is_none_or(|room| room.grown(-1.0).meets(&zone.bounds()));
    let glyph = |zone: &PlacedZone| ZoneGlyph {
        kind: zone.kind,
        name: match (language, &world.zones[&zone.id]) {
            (Language::English, zone) if !zone.name_en.is_empty() => zone.name_en.clone(),
            (_, zone) => zone.name.clone(),
        },
        rule: rule(zone.id),
        polygons: zone.polygons.clone(),
        is_timed: !world.zones[&zone.id].is_standing(),
    };
    all.zones().iter().filter(is_shown).map(glyph).collect()
}

fn places(
    world: &World,
    floor: &FloorPlan,
    only: Option<AreaId>,
    language: Language,
) -> Vec<(PlaceId, Point, String)> {
    let map = floor.map();
    let placements = world.placements();
    let shown = world.places.values().filter(|p| only.is_none_or(|a| a == p.area));
    shown
        .filter_map(|place| {
            let &(on, frame) = placements.get(&place.area)?;
            let english = language == Language::English && !place.name_en.is_empty();
            let name = if english { &place.name_en } else { &place.name };
            (on == map).then(|| (place.id, frame.apply(place.at), name.clone()))
        })
        .collect()
}
