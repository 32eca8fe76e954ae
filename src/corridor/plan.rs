//! The floor of a Map's corridors and the entrances that open on it.
//!
//! Corridor Areas that a door or a passage joins are one floor: the walls between them are taken as open, and
//! a wall's thickness between them is bridged. Corridor Areas that merely touch stay apart.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;

use crate::geometry::{OpenSide, Opening, Openings, Polygon, Scene};
use crate::map::{Area, World};
use crate::units::{AreaId, Language, MapId, Point, Vector, word};

/// Where an entrance opens on the plan.
#[derive(Debug, Clone)]
pub(super) struct Doorstep {
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
    pub(super) entrances: Vec<Doorstep>,
}

/// Pieces of floor overlap by this much, so that rotated neighbours leave no slit.
const OVERLAP: f64 = 0.5;

/// An opening seen from one of its sides.
#[derive(Clone, Copy)]
struct Mouth<'a> {
    opening: &'a Opening,
    side: &'a OpenSide,
}

impl Mouth<'_> {
    fn middle(&self) -> Point {
        self.side.middle()
    }

    fn inward(&self) -> Vector {
        left_of(self.side.ends.0, self.side.ends.1)
    }

    /// The Area that the rules let it join to that of its side.
    fn behind(&self) -> Option<AreaId> {
        self.opening.joined_to(self.side.area)
    }

    /// Name of the door, or else of the side.
    fn name(&self, world: &World) -> Option<(String, String)> {
        let door = self.opening.door.and_then(|door| world.doors.get(&door));
        let door = door.map(|d| (d.name.clone(), d.name_en.clone()));
        let side = || {
            let item = world.areas[&self.side.area].item(&self.side.side.item)?;
            let (_, vector) = world.orthoframe_of(item).side(&self.side.side.side)?;
            vector.names.first().map(|name| (name.clone(), String::new()))
        };
        door.filter(|(name, _)| !name.is_empty()).or_else(side)
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
    pub(super) fn of(world: &World, openings: &Openings, map: MapId) -> Self {
        let scene = Scene::of(world, map);
        let corridors: Vec<AreaId> =
            scene.areas.keys().copied().filter(|&id| is_corridor(world, id)).collect();
        if corridors.is_empty() {
            return Self::default();
        }
        let own = openings.iter().filter(|opening| opening.map == map);
        let mouths: Vec<Mouth<'_>> = own
            .flat_map(|opening| opening.sides.iter().map(move |side| Mouth { opening, side }))
            .collect();
        let corridor = |id: AreaId| corridors.contains(&id);
        let thickest = openings.reach();
        let mut joined = Vec::new();
        let mut floor: Vec<Vec<[f64; 2]>> = Vec::new();
        for mouth in mouths.iter().filter(|m| corridor(m.side.area)) {
            let Some(behind) = mouth.behind().filter(|&b| corridor(b)) else { continue };
            joined.extend([(mouth.side.area, behind), (behind, mouth.side.area)]);
            floor.extend(bridge(world, &scene, *mouth, behind, thickest));
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
            entrances: entrances(world, &mouths, corridor, thickest),
        }
    }
}

/// The entrances: openings of corridors to what is none, and openings of rooms to corridors that are blank there. Two within
/// the `thickest` wall and the depth of its frame are one.
fn entrances(
    world: &World,
    mouths: &[Mouth<'_>],
    corridor: impl Fn(AreaId) -> bool,
    thickest: f64,
) -> Vec<Doorstep> {
    let mut found: Vec<Doorstep> = Vec::new();
    for mouth in mouths.iter().filter(|m| corridor(m.side.area)) {
        let names = match mouth.behind() {
            Some(behind) if corridor(behind) => continue,
            Some(behind) => Some(names_of(&world.areas[&behind])),
            None if mouth.opening.is_passage() => mouth.name(world),
            None => mouth.name(world).or_else(|| {
                let exit = word!("exit");
                let [name, name_en] = [Language::Russian, Language::English].map(|l| exit.say(l));
                Some((name.into_owned(), name_en.into_owned()))
            }),
        };
        if let Some((room, room_en)) = names {
            found.push(Doorstep { room, room_en, at: mouth.middle(), inward: mouth.inward() });
        }
    }
    for mouth in mouths.iter().filter(|m| !corridor(m.side.area)) {
        if !mouth.behind().is_some_and(&corridor) {
            continue;
        }
        let (room, room_en) = names_of(&world.areas[&mouth.side.area]);
        let at = mouth.middle();
        let known = |e: &Doorstep| e.room == room && (e.at - at).norm() < thickest + 20.0;
        if !found.iter().any(known) {
            found.push(Doorstep { room, room_en, at, inward: -mouth.inward() });
        }
    }
    found
}

fn names_of(area: &Area) -> (String, String) {
    (area.name.clone(), area.name_en.clone())
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

/// Floor through the wall between two joined corridors, no thicker than that, as wide as both are there.
fn bridge(
    world: &World,
    scene: &Scene,
    mouth: Mouth<'_>,
    behind: AreaId,
    thickest: f64,
) -> Option<Vec<[f64; 2]>> {
    let (start, end) = mouth.side.ends;
    let dir = (end - start) / (end - start).norm().max(1e-9);
    let outward = -mouth.inward();
    let items = &world.areas[&mouth.side.area].items;
    let item = items.iter().position(|item| item.id == mouth.side.side.item)?;
    let (side, _) = world.orthoframe_of(&items[item]).side(&mouth.side.side.side)?;
    let polygon = &scene.areas[&mouth.side.area].prisms[item].polygon;
    let t = |p: Point| (p - start).dot(&dir);
    // The whole wall in which the opening is.
    let n = polygon.corners.len();
    let (mut low, mut high) = (t(start), t(end));
    let in_line = |p: Point| (p - start).dot(&outward).abs() < 1.0;
    for step in 1..n {
        let p = polygon.corners[(side + 1 + step) % n];
        if !in_line(p) {
            break;
        }
        high = high.max(t(p));
    }
    for step in 1..n {
        let p = polygon.corners[(side + n - step) % n];
        if !in_line(p) {
            break;
        }
        low = low.min(t(p));
    }
    let edges = facing(scene, behind, start, end, thickest);
    let depth = edges
        .iter()
        .filter(|(from, to, _)| *from < t(end) && *to > 0.0)
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
        let p = start + dir * t + outward * away;
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
