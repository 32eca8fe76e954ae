//! Drawings of a map with what is known of it.

use crate::draw::{DoorGlyph, FloorLayer, PlanDrawing, RouteLayer};
use crate::geometry::FloorPlan;
use crate::map::{DoorKind, World};
use crate::units::{MapId, Point, Pose};

use super::{Engine, Error};

/// What to draw of a map besides rooms, doors and furniture.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// Passframes and dead zones.
    pub floor: bool,
    /// The legs of a way, one a directive.
    pub legs: Vec<Vec<Point>>,
    /// Where the robot stands.
    pub robot: Option<Pose>,
}

impl Engine {
    /// The plan of a map as SVG.
    ///
    /// # Errors
    /// There is no map.
    pub fn draw(&self, map: MapId, drawing: &Drawing) -> Result<String, Error> {
        let world = self.world()?;
        let floor = self.floor(map)?;
        let drawing = PlanDrawing {
            world,
            scene: floor.scene(),
            doors: door_glyphs(world, floor),
            floor: if drawing.floor { floor_layer(floor) } else { FloorLayer::default() },
            route: RouteLayer {
                legs: drawing.legs.clone(),
                start: drawing.robot,
                robot_radius: world.robot.radius.get(),
            },
            places: places(world, map),
        };
        Ok(drawing.to_svg())
    }
}

fn door_glyphs(world: &World, floor: &FloorPlan) -> Vec<DoorGlyph> {
    let glyphs = |doorway: &crate::geometry::Doorway| {
        let Some(door) = doorway.door.and_then(|id| world.doors.get(&id)) else {
            return Vec::new();
        };
        let leaves = doorway.leaves(door, door.state);
        let swept =
            (door.kind == DoorKind::Hinged).then(|| doorway.swept(door)).unwrap_or_default();
        let mut swept = swept.into_iter();
        leaves.into_iter().map(|leaf| DoorGlyph { leaf, swept: swept.next() }).collect()
    };
    floor.doorways().iter().flat_map(glyphs).collect()
}

fn floor_layer(floor: &FloorPlan) -> FloorLayer {
    let mut layer = FloorLayer::default();
    for fragment in floor.fragments() {
        layer.passframes.extend(
            fragment
                .passframes
                .iter()
                .map(|p| (p.polygon.clone(), format!("{} · {}", p.id, p.kind.name()))),
        );
        layer.dead_zones.extend(fragment.dead_zones.iter().map(|zone| zone.region.clone()));
    }
    layer
}

fn places(world: &World, map: MapId) -> Vec<(Point, String)> {
    world
        .places
        .values()
        .filter_map(|place| {
            let (on, frame) = world.placement(place.area)?;
            (on == map).then(|| (frame.apply(place.at), place.name.clone()))
        })
        .collect()
}
