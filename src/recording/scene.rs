//! What stands on a storey, as entities of `foxglove.SceneUpdate`: rooms and places; things and doors.

use i_triangle::float::triangulatable::Triangulatable as _;
use serde_json::{Value, json};

use crate::geometry::{FloorPlan, Polygon, Prism, Scene};
use crate::map::{DoorStatus, World};
use crate::units::{Deg, MapId, Point, Pose};

use super::shapes::{color, metre, pose, timestamp, vector};

/// m
const LETTERS: f64 = 0.15;
const WALL: f64 = 0.03;
const DOOR: f64 = 0.06;

const DARK: [u8; 3] = [60, 60, 70];
const WOOD: [u8; 3] = [176, 137, 104];
const OPEN: [u8; 3] = [60, 160, 80];
const CLOSED: [u8; 3] = [230, 150, 30];
const LOCKED: [u8; 3] = [200, 40, 40];
const PLACE: [u8; 3] = [40, 110, 200];

/// The update that leaves exactly these entities standing.
pub(super) fn update(frame: &str, time: u64, entities: Vec<Entity>) -> Value {
    let all = json!({ "timestamp": timestamp(time), "type": 1, "id": "" });
    let entity = |entity: Entity| entity.into_value(frame, time);
    let entities: Vec<Value> = entities.into_iter().map(entity).collect();
    json!({ "deletions": [all], "entities": entities })
}

/// Something that stands there.
#[derive(Debug, Default)]
pub(super) struct Entity {
    id: String,
    lines: Vec<Value>,
    triangles: Vec<Value>,
    spheres: Vec<Value>,
    texts: Vec<Value>,
}

impl Entity {
    fn new(id: String) -> Self {
        Self { id, ..Self::default() }
    }

    fn into_value(self, frame: &str, time: u64) -> Value {
        json!({
            "timestamp": timestamp(time), "frame_id": frame, "id": self.id,
            "lifetime": { "sec": 0, "nsec": 0 }, "frame_locked": true, "metadata": [],
            "arrows": [], "cubes": [], "spheres": self.spheres, "cylinders": [], "lines": self.lines,
            "triangles": self.triangles, "texts": self.texts, "models": [],
        })
    }

    /// `closed` lines run back to where they began.
    fn line(&mut self, points: &[Point], z: f64, width: f64, rgb: [u8; 3], closed: bool) {
        let points: Vec<Value> = points.iter().map(|point| vector(*point, z)).collect();
        self.lines.push(json!({
            "type": if closed { 1 } else { 0 }, "pose": pose(ORIGIN, 0.0), "thickness": width,
            "scale_invariant": false, "points": points, "color": color(rgb, 1.0), "colors": [],
            "indices": [],
        }));
    }

    fn text(&mut self, text: &str, at: Point, z: f64) {
        let at = Pose { at, heading: Deg::ZERO };
        self.texts.push(json!({
            "pose": pose(at, z), "billboard": true, "font_size": LETTERS,
            "scale_invariant": false, "color": color(DARK, 1.0), "text": text,
        }));
    }

    fn prism(&mut self, prism: &Prism, rgb: [u8; 3]) {
        let (points, indices) = solid(prism);
        self.triangles.push(json!({
            "pose": pose(ORIGIN, 0.0), "points": points, "color": color(rgb, 0.85),
            "colors": [], "indices": indices,
        }));
    }
}

const ORIGIN: Pose = Pose { at: Point::new(0.0, 0.0), heading: Deg::ZERO };

/// The surface of a prism: points, and three of them a triangle, which show their faces outwards.
fn solid(prism: &Prism) -> (Vec<Value>, Vec<u32>) {
    let base = Polygon::new(prism.polygon.corners.clone()).counter_clockwise();
    let n = base.corners.len() as u32;
    // One without height is a sheet, whose section no share of it tells.
    let roof = if prism.top > prism.bottom { prism.section(prism.top) } else { base.clone() };
    let low = base.corners.iter().map(|corner| vector(*corner, prism.bottom));
    let high = roof.corners.iter().map(|corner| vector(*corner, prism.top));
    let mut points: Vec<Value> = low.chain(high).collect();
    let mut indices: Vec<u32> = Vec::new();
    for k in 0..n {
        let next = (k + 1) % n;
        indices.extend([k, next, n + next, k, n + next, n + k]);
    }
    // The lids have corners of their own: a triangulation may leave out one on a straight edge.
    for (lid, z, is_roof) in [(&base, prism.bottom, false), (&roof, prism.top, true)] {
        if !can_be_cut(lid) {
            continue;
        }
        let contour: Vec<[f64; 2]> = lid.corners.iter().map(|c| [c.x, c.y]).collect();
        let cut = contour.triangulate().to_triangulation::<u32>();
        let first = points.len() as u32;
        points.extend(cut.points.iter().map(|[x, y]| vector(Point::new(*x, *y), z)));
        for triangle in cut.indices.chunks_exact(3) {
            let turned = [triangle[0], triangle[2], triangle[1]];
            let triangle = if is_roof { triangle } else { &turned[..] };
            indices.extend(triangle.iter().map(|corner| first + corner));
        }
    }
    (points, indices)
}

/// Whether there is a face to be cut: a roof may be a point, and a triangulation asks for numbers that a grid can hold.
fn can_be_cut(lid: &Polygon) -> bool {
    let bounds = lid.bounds();
    let size = bounds.max - bounds.min;
    let is_held = [bounds.min.x, bounds.min.y, size.x, size.y].iter().all(|x| x.abs() < 1e7);
    is_held && lid.signed_area() > 1e-4
}

/// Rooms with their outlines, and named places.
pub(super) fn rooms(world: &World, scene: &Scene, map: MapId) -> Vec<Entity> {
    let mut entities = Vec::new();
    for (id, placed) in &scene.areas {
        let mut entity = Entity::new(format!("room-{}", id.0));
        for prism in &placed.prisms {
            entity.line(&prism.polygon.corners, prism.bottom, WALL, DARK, true);
        }
        if let Some(prism) = placed.prisms.first() {
            entity.text(&world.areas[id].name, prism.polygon.centroid(), prism.bottom + 1.0);
        }
        entities.push(entity);
    }
    let placements = world.placements();
    for place in world.places.values() {
        let Some((on, frame)) = placements.get(&place.area) else { continue };
        if *on != map {
            continue;
        }
        let mut entity = Entity::new(format!("place-{}", place.id.0));
        let at = frame.apply(place.at);
        let size = json!({ "x": 0.1, "y": 0.1, "z": 0.1 });
        let here = pose(Pose { at, heading: Deg::ZERO }, frame.z.get());
        entity.spheres.push(json!({ "pose": here, "size": size, "color": color(PLACE, 0.9) }));
        entity.text(&place.name, at, frame.z.get() + 15.0);
        entities.push(entity);
    }
    entities
}

/// Things, and doors with how they stand.
pub(super) fn things(world: &World, plan: &FloorPlan, scene: &Scene) -> Vec<Entity> {
    let mut entities = Vec::new();
    for (id, placed) in &scene.replicas {
        let Some(replica) = world.replicas.get(id) else { continue };
        let mut entity = Entity::new(format!("thing-{}", id.0));
        for prism in &placed.prisms {
            entity.prism(prism, WOOD);
        }
        let bounds = placed.bounds;
        let middle = bounds.min + (bounds.max - bounds.min) / 2.0;
        entity.text(&replica.name, middle, placed.top + metre(10.0));
        entities.push(entity);
    }
    for (no, doorway) in plan.doorways().iter().enumerate() {
        let (a, b) = doorway.line();
        let Some(door) = doorway.door.and_then(|door| world.doors.get(&door)) else {
            let mut entity = Entity::new(format!("gap-{no}"));
            entity.line(&[a, b], 1.0, WALL, OPEN, false);
            entities.push(entity);
            continue;
        };
        let rgb = match door.state.status {
            DoorStatus::Open => OPEN,
            DoorStatus::Closed => CLOSED,
            DoorStatus::Locked => LOCKED,
        };
        let mut entity = Entity::new(format!("door-{}-{no}", door.id.0));
        entity.line(&[a, b], 1.0, DOOR, rgb, false);
        entity.text(&door.name, doorway.middle(), 10.0);
        entities.push(entity);
    }
    entities
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume by the divergence theorem is that of the prism: each face is there once, and shows outwards.
    #[test]
    fn the_surface_of_a_thing_is_closed_and_shows_outwards() {
        for name in ["rb2", "lab", "two-storeys", "box", "room"] {
            let path = format!("{}/../../maps/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let world = World::load(path).expect("the examples are sound");
            for map in world.maps.keys() {
                let scene = Scene::of(&world, *map);
                for prism in scene.replicas.values().flat_map(|placed| &placed.prisms) {
                    let (points, indices) = solid(prism);
                    let at = |k: u32| -> [f64; 3] {
                        ["x", "y", "z"].map(|axis| points[k as usize][axis].as_f64().unwrap())
                    };
                    let volume: f64 = indices
                        .chunks_exact(3)
                        .map(|t| {
                            let [a, b, c] = [at(t[0]), at(t[1]), at(t[2])];
                            let cross = [
                                b[1] * c[2] - b[2] * c[1],
                                b[2] * c[0] - b[0] * c[2],
                                b[0] * c[1] - b[1] * c[0],
                            ];
                            (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0
                        })
                        .sum();
                    if prism.top <= prism.bottom {
                        continue;
                    }
                    let area = |z: f64| prism.section(z).signed_area().abs() / 1e4;
                    let middle = (prism.bottom + prism.top) / 2.0;
                    let (a, b) = (area(prism.bottom), area(prism.top));
                    let mean = (a + 4.0 * area(middle) + b) / 6.0;
                    let right = mean * (prism.top - prism.bottom) / 100.0;
                    assert!((volume - right).abs() < 1e-4 + right * 1e-3, "{volume} is {right}");
                }
            }
        }
    }
}
