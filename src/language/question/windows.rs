//! The windows of a map: sides of rooms that it calls so.

use crate::map::{Permeability, World};
use crate::units::{AreaId, Point, TypeId, name_key};

/// A window in the wall of an Area.
#[derive(Debug, Clone, PartialEq)]
pub struct Window {
    pub area: AreaId,
    pub name: String,
    /// Its side's ends in the Map's frame.
    pub ends: (Point, Point),
}

/// Sides that the map calls windows.
pub(super) fn windows(world: &World) -> Vec<Window> {
    let is_window = |id: Option<TypeId>| {
        world.types.side.get(id).is_some_and(|t| {
            [&t.name, &t.name_en].iter().any(|n| ["окно", "window"].contains(&&*name_key(n)))
        })
    };
    let placements = world.placements();
    let mut found = Vec::new();
    for area in world.areas.values() {
        let Some((_, frame)) = placements.get(&area.id) else { continue };
        for item in &area.items {
            let place = frame.compose(&item.frame);
            for side in &world.orthoframe_of(item).base {
                if is_window(side.side_type) && side.permeability != Permeability::Permeable {
                    let name = side.names.first().cloned().unwrap_or_default();
                    let ends = (place.apply(side.start), place.apply(side.end));
                    found.push(Window { area: area.id, name, ends });
                }
            }
        }
    }
    found
}
