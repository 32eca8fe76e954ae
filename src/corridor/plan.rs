//! The floor of a Map's corridors and the entrances that open on it.
//!
//! Corridor Areas that a door or a passage joins are one floor: the walls between them are taken as open, and
//! a wall's thickness between them is bridged. Corridor Areas that merely touch stay apart.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;

use crate::geometry::{Polygon, PrismSide, Scene};
use crate::map::{Area, Map, Permeability, World};
use crate::units::{AreaId, MapId, Point, Vector};

/// An entrance on the plan.
#[derive(Debug, Clone)]
pub(super) struct Opening {
    pub(super) room: String,
    pub(super) room_en: String,
    /// Middle of the doorway, on the corridor's wall.
    pub(super) at: Point,
    /// Into the corridor.
    pub(super) inward: Vector,
}

/// What the lanes of one Map are found in.
#[derive(Debug, Default)]
pub(super) struct Plan {
    /// Connected shapes of floor: contours, the outer one first.
    pub(super) shapes: Vec<Vec<Vec<Point>>>,
    pub(super) openings: Vec<Opening>,
}

/// Walls between Areas are at most this thick, in cm.
const WALL: f64 = 60.0;
/// Pieces of floor overlap by this much, so that rotated neighbours leave no slit.
const OVERLAP: f64 = 0.5;

/// A side that can be gone through.
struct Gate<'a> {
    area: &'a Area,
    side: usize,
    prism: usize,
    a: Point,
    b: Point,
    permeability: Permeability,
    behind: Option<AreaId>,
    /// Name of the door or of the side.
    name: Option<(String, String)>,
}

impl Gate<'_> {
    fn middle(&self) -> Point {
        nalgebra::center(&self.a, &self.b)
    }

    fn inward(&self) -> Vector {
        left_of(self.a, self.b)
    }
}

fn left_of(a: Point, b: Point) -> Vector {
    let along = b - a;
    Vector::new(-along.y, along.x) / along.norm().max(1e-9)
}

/// Whether an Area is a corridor, by its type.
pub(super) fn is_corridor(world: &World, area: AreaId) -> bool {
    world.area_has_trait(area, "corridor")
}

impl Plan {
    /// Reads the corridors of a Map; the Map is of this world.
    pub(super) fn of(world: &World, map: MapId) -> Self {
        let scene = Scene::of(world, map);
        let corridors: Vec<AreaId> =
            scene.areas.keys().copied().filter(|&id| is_corridor(world, id)).collect();
        if corridors.is_empty() {
            return Self::default();
        }
        let gates: Vec<Gate<'_>> = scene
            .areas
            .keys()
            .flat_map(|id| gates(world, &world.maps[&map], &scene, &world.areas[id]))
            .collect();
        let corridor = |id: AreaId| corridors.contains(&id);
        let mut joined = Vec::new();
        let mut floor: Vec<Vec<[f64; 2]>> = Vec::new();
        for gate in gates.iter().filter(|g| corridor(g.area.id)) {
            let Some(behind) = gate.behind.filter(|&b| corridor(b)) else { continue };
            joined.extend([(gate.area.id, behind), (behind, gate.area.id)]);
            floor.extend(bridge(&scene, gate, behind));
        }
        let mut walls = Vec::new();
        for (at, &a) in corridors.iter().enumerate() {
            floor.extend(scene.areas[&a].prisms.iter().map(|p| grown(&p.polygon)));
            for &b in &corridors[at + 1..] {
                if !joined.contains(&(a, b)) {
                    walls.extend(shared_walls(&scene, a, b));
                }
            }
        }
        let shapes = floor.overlay_as::<i64>(&walls, OverlayRule::Difference, FillRule::NonZero);
        let point = |p: [f64; 2]| Point::new(p[0], p[1]);
        let contour = |c: Vec<[f64; 2]>| c.into_iter().map(point).collect();
        Self {
            shapes: shapes.into_iter().map(|s| s.into_iter().map(contour).collect()).collect(),
            openings: openings(world, &gates, corridor),
        }
    }
}

/// The entrances: gates of corridors to what is none, and gates of rooms to corridors that are blank there.
fn openings(world: &World, gates: &[Gate<'_>], corridor: impl Fn(AreaId) -> bool) -> Vec<Opening> {
    let mut found: Vec<Opening> = Vec::new();
    for gate in gates.iter().filter(|g| corridor(g.area.id)) {
        let names = match gate.behind {
            Some(behind) if corridor(behind) => continue,
            Some(behind) => Some(names_of(&world.areas[&behind])),
            None if gate.permeability == Permeability::Permeable => gate.name.clone(),
            None => gate.name.clone().or_else(|| Some(("Выход".into(), "Exit".into()))),
        };
        if let Some((room, room_en)) = names {
            found.push(Opening { room, room_en, at: gate.middle(), inward: gate.inward() });
        }
    }
    for gate in gates.iter().filter(|g| !corridor(g.area.id)) {
        if !gate.behind.is_some_and(&corridor) {
            continue;
        }
        let (room, room_en) = names_of(gate.area);
        let at = gate.middle();
        let known = |o: &Opening| o.room == room && (o.at - at).norm() < WALL + 20.0;
        if !found.iter().any(known) {
            found.push(Opening { room, room_en, at, inward: -gate.inward() });
        }
    }
    found
}

fn names_of(area: &Area) -> (String, String) {
    (area.name.clone(), area.name_en.clone())
}

/// The sides of an Area that can be gone through, less those that lie between its own items.
fn gates<'a>(world: &World, map: &Map, scene: &Scene, area: &'a Area) -> Vec<Gate<'a>> {
    let mut found = Vec::new();
    for prism in &scene.areas[&area.id].prisms {
        let item = &area.items[prism.item].id;
        for (side, (a, b)) in prism.polygon.edges().enumerate() {
            let PrismSide { permeability } = &prism.sides[side];
            let id = &world.orthoframes[&prism.orthoframe].base[side].id;
            let mount = area.doors.iter().find(|m| m.item == *item && m.side == *id);
            if mount.is_none() && *permeability == Permeability::Impermeable {
                continue;
            }
            let linked = map.links.iter().find_map(|link| {
                let here = |area_id, side: &crate::map::SideRef| {
                    area_id == area.id && side.item == *item && side.side == *id
                };
                if here(link.area, &link.side) {
                    Some(link.to_area)
                } else {
                    here(link.to_area, &link.to_side).then_some(link.area)
                }
            });
            let shared = mount.and_then(|mount| {
                let other =
                    |o: &&Area| o.id != area.id && o.doors.iter().any(|m| m.door == mount.door);
                scene.areas.keys().map(|id| &world.areas[id]).find(other).map(|o| o.id)
            });
            let behind = linked.or(shared).or_else(|| step_off(scene, a, b));
            if behind == Some(area.id) {
                continue;
            }
            let door = mount.and_then(|m| world.doors.get(&m.door));
            let vector = world
                .orthoframes
                .get(&prism.orthoframe)
                .and_then(|f| f.base.get(side))
                .and_then(|v| v.names.first());
            let name = door
                .map(|d| (d.name.clone(), d.name_en.clone()))
                .filter(|(name, _)| !name.is_empty())
                .or_else(|| vector.map(|name| (name.clone(), String::new())));
            found.push(Gate {
                area,
                side,
                prism: prism.item,
                a,
                b,
                permeability: *permeability,
                behind,
                name,
            });
        }
    }
    found
}

/// The Area behind a side, at most a wall away.
fn step_off(scene: &Scene, a: Point, b: Point) -> Option<AreaId> {
    let outward = -left_of(a, b);
    let middle = nalgebra::center(&a, &b);
    [2.0, 10.0, 20.0, 35.0, WALL].iter().find_map(|step| scene.area_at(middle + outward * *step))
}

/// A polygon with every edge moved out a little.
fn grown(polygon: &Polygon) -> Vec<[f64; 2]> {
    let corners = &polygon.corners;
    let n = corners.len();
    (0..n)
        .map(|i| {
            let before = left_of(corners[(i + n - 1) % n], corners[i]);
            let after = left_of(corners[i], corners[(i + 1) % n]);
            let bisector = before + after;
            // A spike would run far out; it moves by the overlap alone.
            let p = corners[i] - bisector * (2.0 * OVERLAP / bisector.norm_squared().max(0.5));
            [p.x, p.y]
        })
        .collect()
}

/// The edges of an Area that face the edge `a`-`b` from outside within `reach`: as intervals along the edge,
/// with their distance.
fn facing(scene: &Scene, area: AreaId, a: Point, b: Point, reach: f64) -> Vec<(f64, f64, f64)> {
    let length = (b - a).norm().max(1e-9);
    let dir = (b - a) / length;
    let outward = -left_of(a, b);
    let mut found = Vec::new();
    for (p, q) in scene.areas[&area].prisms.iter().flat_map(|prism| prism.polygon.edges()) {
        let along = q - p;
        let (t, away) = ((p - a).dot(&dir), (p - a).dot(&outward));
        let parallel = along.perp(&dir).abs() <= 0.02 * along.norm() && along.dot(&dir) < 0.0;
        if parallel && away > -2.0 && away <= reach {
            found.push((t + along.dot(&dir), t, away.max(0.0)));
        }
    }
    found
}

/// Floor through the wall between two joined corridors, as wide as both are there.
fn bridge(scene: &Scene, gate: &Gate<'_>, behind: AreaId) -> Option<Vec<[f64; 2]>> {
    let dir = (gate.b - gate.a) / (gate.b - gate.a).norm().max(1e-9);
    let outward = -gate.inward();
    let polygon = &scene.areas[&gate.area.id].prisms[gate.prism].polygon;
    let t = |p: Point| (p - gate.a).dot(&dir);
    // The whole wall in which the gate is.
    let n = polygon.corners.len();
    let (mut low, mut high) = (t(gate.a), t(gate.b));
    let in_line = |p: Point| (p - gate.a).dot(&outward).abs() < 1.0;
    for step in 1..n {
        let p = polygon.corners[(gate.side + 1 + step) % n];
        if !in_line(p) {
            break;
        }
        high = high.max(t(p));
    }
    for step in 1..n {
        let p = polygon.corners[(gate.side + n - step) % n];
        if !in_line(p) {
            break;
        }
        low = low.min(t(p));
    }
    let edges = facing(scene, behind, gate.a, gate.b, WALL);
    let depth = edges
        .iter()
        .filter(|(from, to, _)| *from < t(gate.b) && *to > 0.0)
        .map(|(.., away)| *away)
        .fold(f64::INFINITY, f64::min);
    if !depth.is_finite() || depth < 0.5 {
        return None;
    }
    let same = edges.iter().filter(|(.., away)| (away - depth).abs() < 1.0);
    let (from, to) = same.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), edge| {
        (from.min(edge.0), to.max(edge.1))
    });
    let (low, high) = (low.max(from), high.min(to));
    let corner = |t: f64, away: f64| {
        let p = gate.a + dir * t + outward * away;
        [p.x, p.y]
    };
    (low < high).then(|| {
        vec![
            corner(low, depth + 1.0),
            corner(high, depth + 1.0),
            corner(high, -1.0),
            corner(low, -1.0),
        ]
    })
}

/// Thin strips along the walls at which two corridors touch without a way through.
fn shared_walls(scene: &Scene, a: AreaId, b: AreaId) -> Vec<Vec<[f64; 2]>> {
    let mut strips = Vec::new();
    for (p, q) in scene.areas[&a].prisms.iter().flat_map(|prism| prism.polygon.edges()) {
        let length = (q - p).norm();
        let (dir, outward) = ((q - p) / length.max(1e-9), -left_of(p, q));
        for (from, to, _) in facing(scene, b, p, q, 2.0) {
            let (low, high) = (from.max(0.0) - 2.0, to.min(length) + 2.0);
            let corner = |t: f64, away: f64| {
                let c = p + dir * t + outward * away;
                [c.x, c.y]
            };
            if high - low > 9.0 {
                let (near, far) = (-2.0, 4.0);
                strips.push(vec![
                    corner(low, far),
                    corner(low, near),
                    corner(high, near),
                    corner(high, far),
                ]);
            }
        }
    }
    strips
}
