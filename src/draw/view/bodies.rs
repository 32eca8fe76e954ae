//! What stands around an eye, as facets: walls with their openings and windows, door leaves, things.

use nalgebra::{Point3, Vector3};

use crate::geometry::{PlacedArea, PlacedReplica, Polygon, Prism};
use crate::map::{DoorMount, DoorStatus, Permeability, Properties, World};
use crate::units::{Language, Point, Vector};

use super::bsp::{Facet, Plane};
use super::{Body, Mouth, ViewDrawing};

const WALL: [f64; 3] = [0.95, 0.93, 0.88];
const FLOOR: [f64; 3] = [0.80, 0.74, 0.63];
const GLASS: [f64; 3] = [0.74, 0.87, 0.95];
const FRAME: [f64; 3] = [0.99, 0.99, 0.98];
const LEAF: [f64; 3] = [0.86, 0.76, 0.60];
const LOCKED: [f64; 3] = [0.80, 0.45, 0.40];
const WOOD: [f64; 3] = [0.85, 0.72, 0.53];
const MOVABLE: [f64; 3] = [0.70, 0.76, 0.66];
/// A window's pane stands so high above the floor, and ends so far below the ceiling, cm.
const SILL: f64 = 90.0;
const ABOVE_WINDOW: f64 = 40.0;
/// What is left of a wall beside an opening is drawn from this length on, cm.
const SEEN_PIECE: f64 = 0.5;

/// Words for colours as maps have them, and what they look like.
const COLORS: [(&[&str], [f64; 3]); 14] = [
    (&["бел", "white"], [0.96, 0.96, 0.95]),
    (&["черн", "чёрн", "black"], [0.25, 0.25, 0.27]),
    (&["сер", "gray", "grey", "silver"], [0.66, 0.67, 0.68]),
    (&["красн", "red"], [0.80, 0.27, 0.24]),
    (&["оранж", "orange"], [0.93, 0.58, 0.22]),
    (&["желт", "жёлт", "yellow"], [0.95, 0.83, 0.35]),
    (&["зелен", "зелён", "green"], [0.42, 0.66, 0.40]),
    (&["голуб", "light blue", "cyan"], [0.58, 0.78, 0.90]),
    (&["син", "blue"], [0.32, 0.45, 0.74]),
    (&["фиолет", "purple", "violet"], [0.55, 0.42, 0.70]),
    (&["розов", "pink"], [0.93, 0.68, 0.74]),
    (&["коричн", "brown"], [0.62, 0.45, 0.31]),
    (&["беж", "beige"], [0.90, 0.84, 0.72]),
    (&["прозрачн", "transparent"], [0.85, 0.92, 0.95]),
];

/// The bodies within range, and their facets that face the eye.
pub(super) fn of(view: &ViewDrawing<'_>, eye: Point3<f64>) -> (Vec<Body>, Vec<Facet>) {
    let mut room = Collector { view, eye, bodies: Vec::new(), facets: Vec::new() };
    let reach = crate::geometry::Bounds::of([view.pose.at]).grown(view.range);
    // Walls seen from behind come first: of two faces in one plane, as between two rooms that touch, the later one is
    // drawn over the other.
    for within in [false, true] {
        for area in view.scene.areas.values() {
            if area.prisms.iter().any(|p| p.bounds.meets(&reach)) {
                room.walls(area, within);
            }
        }
    }
    for area in view.scene.areas.values() {
        if area.prisms.iter().any(|p| p.bounds.meets(&reach)) {
            room.floor(area);
        }
    }
    for mouth in &view.mouths {
        room.mouth(mouth);
    }
    for leaf in view.leaves.iter().filter(|l| l.base.bounds().meets(&reach)) {
        let color = if leaf.status == DoorStatus::Locked { LOCKED } else { LEAF };
        let owner = room.body(color, String::new());
        room.block(&leaf.base, &leaf.base, leaf.bottom, leaf.top, owner);
    }
    for placed in view.scene.replicas.values().filter(|r| r.bounds.meets(&reach)) {
        room.thing(placed);
    }
    (room.bodies, room.facets)
}

struct Collector<'v> {
    view: &'v ViewDrawing<'v>,
    eye: Point3<f64>,
    bodies: Vec<Body>,
    facets: Vec<Facet>,
}

impl Collector<'_> {
    fn body(&mut self, color: [f64; 3], name: String) -> usize {
        self.bodies.push(Body { color, name });
        self.bodies.len() - 1
    }

    fn world(&self) -> &World {
        self.view.world
    }

    fn floor(&mut self, placed: &PlacedArea) {
        let floor = self.body(FLOOR, String::new());
        for prism in &placed.prisms {
            for part in convex_parts(&prism.polygon) {
                self.level(&part, prism.bottom, floor);
            }
        }
    }

    /// The walls of an Area that are seen from within, or those that are seen from behind, such as from the depth of a
    /// doorway: walls hide what is beyond them on either side.
    fn walls(&mut self, placed: &PlacedArea, within: bool) {
        let wall = self.body(WALL, String::new());
        let (glass, frame) = (self.body(GLASS, String::new()), self.body(FRAME, String::new()));
        let area = &self.view.world.areas[&placed.id];
        for (item, prism) in area.items.iter().zip(&placed.prisms) {
            let orthoframe = self.view.world.orthoframe_of(item);
            let corners = &prism.polygon.corners;
            let n = corners.len();
            let world = self.view.world;
            // The opening in a side between two corners, and how high it is.
            let opening = |side: usize, ends: (Point, Point)| {
                let vector = &orthoframe.base[side];
                if vector.permeability == Permeability::Impermeable {
                    return None;
                }
                let is_here = |m: &&DoorMount| m.item == item.id && m.side == vector.id;
                let door = world.doors.get(&area.doors.iter().find(is_here)?.door)?;
                let on_map = |(r, l)| (placed.frame.apply(r), placed.frame.apply(l));
                let top = if door.height.get() > 0.0 { door.height.get() } else { f64::INFINITY };
                Some((
                    world.threshold(placed.id, door.id).map_or(ends, on_map),
                    (prism.bottom + top).min(prism.top),
                ))
            };
            for (i, ((a, b), vector)) in prism.polygon.edges().zip(&orthoframe.base).enumerate() {
                if self.sees_inside(a, b) != within {
                    continue;
                }
                // A wall that goes straight on shows no edge there; where it ends at an opening it does.
                let edge_at = |side: usize, at: Point, turns: bool| {
                    let ends = (corners[side], corners[(side + 1) % n]);
                    let is_end = |p: Point| (p - at).norm() <= SEEN_PIECE;
                    match opening(side, ends) {
                        _ if turns => f64::INFINITY,
                        Some(((r, l), lintel)) if is_end(r) || is_end(l) => lintel,
                        _ => f64::NEG_INFINITY,
                    }
                };
                let turns = |p: Point, q: Point, r: Point| {
                    (q - p).perp(&(r - q)).abs() > 1e-3 * (q - p).norm() * (r - q).norm()
                };
                let (before, after) = ((i + n - 1) % n, (i + 1) % n);
                let at_a = edge_at(before, a, turns(corners[before], a, b));
                let at_b = edge_at(after, b, turns(a, b, corners[(i + 2) % n]));
                match vector.permeability {
                    Permeability::Impermeable => {
                        self.wall(a, b, (prism.bottom, prism.top), wall, [at_a, at_b]);
                        let (low, high) = (prism.bottom + SILL, prism.top - ABOVE_WINDOW);
                        if within && self.world().is_window(vector) && high > low {
                            self.upright(a, b, low, high, frame);
                            let inset = (b - a) * (6.0 / (b - a).norm()).min(0.4);
                            self.upright(a + inset, b - inset, low + 5.0, high - 5.0, glass);
                        }
                    }
                    Permeability::Permeable | Permeability::Conditional => {
                        let Some(((right, left), lintel)) = opening(i, (a, b)) else { continue };
                        if lintel < prism.top {
                            let none = [f64::NEG_INFINITY; 2];
                            self.wall(right, left, (lintel, prism.top), wall, none);
                        }
                        for (p, q, edges) in [(a, right, [at_a, lintel]), (left, b, [lintel, at_b])]
                        {
                            if (q - p).norm() > SEEN_PIECE {
                                self.wall(p, q, (prism.bottom, prism.top), wall, edges);
                            }
                        }
                    }
                }
            }
        }
    }

    /// The depth of a doorway: its jambs, the floor between them, and what is above them.
    fn mouth(&mut self, mouth: &Mouth) {
        let (wall, floor) = (self.body(WALL, String::new()), self.body(FLOOR, String::new()));
        let [right, left] = mouth.jambs;
        for (a, b) in [right, left] {
            self.upright(a, b, mouth.bottom, mouth.top, wall);
        }
        let between = Polygon::new(vec![right.0, right.1, left.1, left.0]).counter_clockwise();
        self.level(&between, mouth.bottom, floor);
        self.level(&between, mouth.top, wall);
    }

    /// Walls are seen from within their room: the room lies to the left of its base vectors.
    fn sees_inside(&self, a: Point, b: Point) -> bool {
        let to_eye = Point::new(self.eye.x, self.eye.y) - a;
        (b - a).perp(&to_eye) > 1e-6
    }

    fn thing(&mut self, placed: &PlacedReplica) {
        let world = self.view.world;
        let replica = &world.replicas[&placed.id];
        let object = &world.objects[&replica.object];
        let usual = if replica.move_prob > 0 { MOVABLE } else { WOOD };
        let color =
            painted(&replica.properties).or_else(|| painted(&object.properties)).unwrap_or(usual);
        let english = self.view.language == Language::English && !replica.name_en.is_empty();
        let name = if english { &replica.name_en } else { &replica.name };
        let owner = self.body(color, name.clone());
        let before = self.facets.len();
        for prism in &placed.prisms {
            self.prism(prism, owner);
        }
        // What stands against a wall of its room, or reaches into it, ends there: else its back would be seen from the
        // next room, in the wall's own plane.
        let walls = self.walls_at(placed);
        for facet in self.facets.split_off(before) {
            let whole = walls.iter().try_fold(facet, |f, wall| f.clipped(wall));
            let flush = |facet: &Facet| walls.iter().any(|wall| facet.lies_against(wall));
            self.facets.extend(whole.filter(|facet| !flush(facet)));
        }
    }

    /// The planes of the walls of a thing's own room that it touches, their normals into the room.
    fn walls_at(&self, placed: &PlacedReplica) -> Vec<Plane> {
        const TOUCHES: f64 = 1e-3;
        let Some(home) = self.view.scene.areas.get(&placed.area) else { return Vec::new() };
        let sides = home.prisms.iter().flat_map(|p| p.polygon.edges().zip(p.sides.iter()));
        let walls = sides.filter(|(_, s)| s.permeability == Permeability::Impermeable);
        let middle = nalgebra::center(&placed.bounds.min, &placed.bounds.max);
        let planes = walls.filter_map(|((a, b), _)| {
            let along = (b - a).try_normalize(1e-9)?;
            let inwards = Vector::new(-along.y, along.x);
            let reaches = |p: &Point| {
                let t = (p - a).dot(&along);
                (p - a).dot(&inwards) <= TOUCHES && t > -TOUCHES && t < (b - a).norm() + TOUCHES
            };
            let corners = || placed.prisms.iter().flat_map(|p| &p.polygon.corners);
            ((middle - a).dot(&inwards) > TOUCHES && corners().any(reaches)).then(|| Plane {
                normal: Vector3::new(inwards.x, inwards.y, 0.0),
                offset: inwards.dot(&a.coords),
            })
        });
        planes.collect()
    }

    fn prism(&mut self, prism: &Prism, owner: usize) {
        let centre = prism.polygon.centroid();
        let scaled = |p: &Point| centre + (p - centre) * prism.roof_scale;
        let roof = Polygon::new(prism.polygon.corners.iter().map(scaled).collect());
        let solid = |p: Permeability| p != Permeability::Permeable;
        let is_open =
            prism.sides.iter().any(|s| !solid(s.permeability)) || !solid(prism.roof_permeability);
        for (i, side) in prism.sides.iter().enumerate() {
            if solid(side.permeability) && prism.top > prism.bottom {
                let j = (i + 1) % prism.sides.len();
                let (a, b) = (prism.polygon.corners[i], prism.polygon.corners[j]);
                let (d, c) = (roof.corners[i], roof.corners[j]);
                let at = |p: Point, z: f64| Point3::new(p.x, p.y, z);
                let corners = vec![
                    at(a, prism.bottom),
                    at(b, prism.bottom),
                    at(c, prism.top),
                    at(d, prism.top),
                ];
                self.face(corners, owner, is_open);
            }
        }
        for (polygon, z, permeability) in [
            (&prism.polygon, prism.bottom, prism.base_permeability),
            (&roof, prism.top, prism.roof_permeability),
        ] {
            // Of a body without an opening only the face towards the eye is seen.
            let faces =
                is_open || (z > prism.bottom) == (self.eye.z > z) || prism.top <= prism.bottom;
            if solid(permeability) && faces {
                for part in convex_parts(polygon) {
                    self.level(&part, z, owner);
                }
            }
        }
    }

    /// A closed block, such as a door leaf.
    fn block(&mut self, base: &Polygon, roof: &Polygon, bottom: f64, top: f64, owner: usize) {
        for (a, b) in base.edges() {
            if !self.sees_inside(a, b) {
                self.upright(a, b, bottom, top, owner);
            }
        }
        if self.eye.z > top {
            self.level(roof, top, owner);
        }
    }

    /// A piece of wall; `edges` tells how high the lines at its ends `a` and `b` are seen.
    fn wall(&mut self, a: Point, b: Point, (low, high): (f64, f64), owner: usize, edges: [f64; 2]) {
        let mut levels = vec![low, high];
        levels.extend(edges.iter().filter(|&&z| low < z && z < high));
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        let last = levels.len() - 2;
        for (k, row) in levels.windows(2).enumerate() {
            let before = self.facets.len();
            self.upright(a, b, row[0], row[1], owner);
            if let Some(facet) = self.facets.get_mut(before) {
                let [at_a, at_b] = edges.map(|z| z >= row[1]);
                facet.is_edge = vec![k == 0, at_b, k == last, at_a];
            }
        }
    }

    fn upright(&mut self, a: Point, b: Point, low: f64, high: f64, owner: usize) {
        let corners = [(a, low), (b, low), (b, high), (a, high)];
        self.facets
            .extend(Facet::new(corners.map(|(p, z)| Point3::new(p.x, p.y, z)).into(), owner));
    }

    fn level(&mut self, polygon: &Polygon, z: f64, owner: usize) {
        let corners = polygon.corners.iter().map(|p| Point3::new(p.x, p.y, z)).collect();
        if let Some(mut facet) = Facet::new(corners, owner) {
            if !polygon.is_convex(1e-6) {
                return;
            }
            facet.is_edge = vec![owner_has_edges(&self.bodies[owner]); facet.corners.len()];
            self.facets.push(facet);
        }
    }

    /// A face of a thing; from behind only where one can look in.
    fn face(&mut self, corners: Vec<Point3<f64>>, owner: usize, both_sides: bool) {
        if let Some(facet) = Facet::new(corners, owner)
            && (both_sides || facet.normal.dot(&(self.eye - facet.corners[0])) > 0.0)
        {
            self.facets.push(facet);
        }
    }
}

/// The floor has no outline of its own: its parts would show.
fn owner_has_edges(body: &Body) -> bool {
    !body.name.is_empty()
}

fn painted(properties: &Properties) -> Option<[f64; 3]> {
    let value = properties
        .iter()
        .find(|(name, _)| ["цвет", "color", "colour"].contains(&name.to_lowercase().as_str()))?;
    let word = value.1.to_lowercase();
    COLORS.iter().find(|(stems, _)| stems.iter().any(|s| word.contains(s))).map(|(_, c)| *c)
}

/// A polygon in convex parts: itself, or the ears cut from it.
fn convex_parts(polygon: &Polygon) -> Vec<Polygon> {
    if polygon.is_convex(1e-6) {
        return vec![polygon.clone()];
    }
    let mut rest = polygon.clone().counter_clockwise().corners;
    let mut parts = Vec::new();
    while rest.len() > 3 {
        let n = rest.len();
        let is_ear = |i: usize| {
            let (a, b, c) = (rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]);
            let turn = |p: Point, q: Point, r: Point| Vector::perp(&(q - p), &(r - p));
            let holds = |p: &Point| {
                *p != a
                    && *p != b
                    && *p != c
                    && turn(a, b, *p) > 0.0
                    && turn(b, c, *p) > 0.0
                    && turn(c, a, *p) > 0.0
            };
            turn(a, b, c) > 1e-9 && !rest.iter().any(holds)
        };
        // A simple polygon has an ear; what rounding has spoilt loses its flattest corner.
        let i = (0..n).find(|&i| is_ear(i)).unwrap_or(0);
        parts.push(Polygon::new(vec![rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]]));
        rest.remove(i);
    }
    parts.push(Polygon::new(rest));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ears_cover_a_room_with_a_corner_cut_out() {
        let room = Polygon::new(
            [
                (0.0, 0.0),
                (400.0, 0.0),
                (400.0, 200.0),
                (200.0, 200.0),
                (200.0, 400.0),
                (0.0, 400.0),
            ]
            .map(|(x, y)| Point::new(x, y))
            .into(),
        );
        let parts = convex_parts(&room);
        assert_eq!(parts.len(), 4);
        let area: f64 = parts.iter().map(Polygon::signed_area).sum();
        assert!((area - room.signed_area()).abs() < 1e-6);
    }

    #[test]
    fn colours_are_read_from_properties_in_both_languages() {
        let of =
            |name: &str, value: &str| painted(&Properties::from([(name.into(), value.into())]));
        assert_eq!(of("ЦВЕТ", "Чёрный"), of("color", "black"));
        assert_eq!(of("МАТЕРИАЛ", "Белый"), None);
    }
}
