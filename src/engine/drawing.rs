//! Drawings of a map with what is known of it.

use crate::draw::{DoorGlyph, FloorLayer, PlanDrawing, RouteLayer};
use crate::geometry::{FloorPlan, Polygon};
use crate::map::{DoorKind, World};
use crate::units::{MapId, Point, Pose, Vector};

use super::{Engine, Error};

/// What to draw of a map besides rooms, doors and furniture.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// Passframes and dead zones.
    pub floor: bool,
    /// The legs of a way, each with its directive's number.
    pub legs: Vec<(usize, Vec<Point>)>,
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
        let swept = if door.kind == DoorKind::Hinged { doorway.swept(door) } else { Vec::new() };
        let mut swept = swept.into_iter();
        leaves.into_iter().map(|leaf| DoorGlyph { leaf, swept: swept.next() }).collect()
    };
    let between = floor.doorways().iter().flat_map(glyphs);
    between.chain(outer_doors(world, floor)).collect()
}

/// Doors that lead out of the map: a shut leaf in the wall.
fn outer_doors(world: &World, floor: &FloorPlan) -> Vec<DoorGlyph> {
    let joined: Vec<_> = floor.doorways().iter().filter_map(|d| d.door).collect();
    let mut glyphs = Vec::new();
    for (id, placed) in &floor.scene().areas {
        for mount in world.areas[id].doors.iter().filter(|m| !joined.contains(&m.door)) {
            let Some((right, left)) = world.threshold(*id, mount.door) else { continue };
            let (right, left) = (placed.frame.apply(right), placed.frame.apply(left));
            let along = (left - right).normalize();
            let half = Vector::new(along.y, -along.x) * 2.5;
            let leaf = Polygon::new(vec![right - half, right + half, left + half, left - half]);
            glyphs.push(DoorGlyph { leaf, swept: None });
        }
    }
    glyphs
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
