//! The plan of a Map (figs. 6, 9-12): rooms, doors as architects draw them, furniture, free floor, Passframes, route.

use crate::geometry::{Bounds, Owner, Polygon, Prism, Region, Scene};
use crate::map::{Permeability, World};
use crate::units::{Point, Pose, Vector};

use super::canvas::{Anchor, Canvas, Lettering, Style, text_width};

/// Free floor and its partition, as the drawing needs them.
#[derive(Debug, Clone, Default)]
pub struct FloorLayer {
    /// Convex cells with the short text that stands in them.
    pub passframes: Vec<(Polygon, String)>,
    /// Floor that no position of the robot covers.
    pub dead_zones: Vec<Region>,
}

/// A drivable line, cut into the directives' legs.
#[derive(Debug, Clone, Default)]
pub struct RouteLayer {
    /// The number of the directive, and its way.
    pub legs: Vec<(usize, Vec<Point>)>,
    pub start: Option<Pose>,
    /// Radius of the robot's disc, cm.
    pub robot_radius: f64,
}

/// A door leaf where it stands, and the floor that it passes over when it shuts.
#[derive(Debug, Clone)]
pub struct DoorGlyph {
    pub leaf: Polygon,
    pub swept: Option<Polygon>,
}

/// What is to be drawn of a Map.
#[derive(Debug)]
pub struct PlanDrawing<'a> {
    pub world: &'a World,
    pub scene: &'a Scene,
    pub doors: Vec<DoorGlyph>,
    pub floor: FloorLayer,
    pub route: RouteLayer,
    /// Points with a name: «Точка-А».
    pub places: Vec<(Point, String)>,
}

const WALL: Style = Style::line("#3b3a36", 7.0);
const PASSAGE: Style = Style::line("#a9a498", 1.2).dashed("6 5");
const LEAF: Style = Style::fill("#ffffff").outlined("#3b3a36", 1.2);
const SWING: Style = Style::line("#8c887d", 0.9).dashed("3 3");
const PASSFRAME: Style = Style::fill("#e4f1e3").outlined("#69a869", 0.9);
const DEAD_ZONE: Style = Style::fill("#e8a39b").faint(0.75);
const ROUTE: Style = Style::line("#1f5fbf", 4.0);
const INK: &str = "#2b2a27";

impl PlanDrawing<'_> {
    /// The drawing as SVG text.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let rooms = self.scene.areas.values().flat_map(|a| &a.prisms);
        let extent = rooms.clone().fold(Bounds::EMPTY, |b, prism| b.union(&prism.bounds));
        let extent =
            if extent.min.x <= extent.max.x { extent } else { Bounds::of([Point::origin()]) };
        let mut sheet = extent.grown(40.0);
        sheet.min.y -= 70.0; // scale bar and legend
        let mut canvas = Canvas::new(sheet);
        for prism in rooms {
            canvas.polygon(&prism.polygon, Style::fill("#faf7f0"), None);
        }
        self.floor(&mut canvas);
        self.furniture(&mut canvas);
        self.walls(&mut canvas);
        for door in &self.doors {
            draw_door(&mut canvas, door);
        }
        self.route(&mut canvas);
        self.labels(&mut canvas);
        legend(&mut canvas, extent, !self.floor.passframes.is_empty(), !self.route.legs.is_empty());
        canvas.into_svg(&self.world.maps[&self.scene.map].name)
    }

    fn floor(&self, canvas: &mut Canvas) {
        for (cell, id) in &self.floor.passframes {
            canvas.polygon(cell, PASSFRAME, Some(id));
        }
        for zone in &self.floor.dead_zones {
            canvas.polygons(zone.contours().map(|c| c.corners.as_slice()), DEAD_ZONE, None);
        }
    }

    /// Low things first, so that what stands on a table is seen.
    fn furniture(&self, canvas: &mut Canvas) {
        let mut prisms: Vec<&Prism> =
            self.scene.replicas.values().flat_map(|r| &r.prisms).collect();
        prisms.sort_by(|a, b| a.top.total_cmp(&b.top).then(b.bottom.total_cmp(&a.bottom)));
        for prism in prisms {
            let Owner::Replica(id) = prism.owner else { continue };
            let replica = &self.world.replicas[&id];
            let movable = replica.move_prob > 0;
            canvas.polygon(&prism.polygon, furniture_style(prism, movable), Some(&replica.name));
        }
    }

    fn walls(&self, canvas: &mut Canvas) {
        for prism in self.scene.areas.values().flat_map(|a| &a.prisms) {
            for ((a, b), side) in prism.polygon.edges().zip(&prism.sides) {
                match side.permeability {
                    Permeability::Impermeable => canvas.segment(a, b, WALL),
                    Permeability::Permeable | Permeability::Conditional => {
                        canvas.segment(a, b, PASSAGE)
                    }
                }
            }
        }
    }

    fn route(&self, canvas: &mut Canvas) {
        for (_, leg) in &self.route.legs {
            canvas.polyline(leg, ROUTE);
        }
        if let Some(pose) = self.route.start {
            let (sin, cos) = pose.heading.sin_cos();
            let nose = pose.at + Vector::new(cos, sin) * self.route.robot_radius;
            canvas.circle(
                pose.at,
                self.route.robot_radius,
                Style::fill("#9cc2f2").outlined("#1f5fbf", 2.0).faint(0.85),
            );
            canvas.segment(pose.at, nose, Style::line("#1f5fbf", 2.5));
        }
    }

    /// Numbers of the directives at the ends of their legs; those that end at one point share a badge.
    fn badges(&self, canvas: &mut Canvas) -> Vec<Bounds> {
        let mut badges: Vec<(Point, String)> = Vec::new();
        for (number, leg) in &self.route.legs {
            let Some(&end) = leg.last() else { continue };
            match badges.iter_mut().find(|(at, _)| (at - end).norm() < 16.0) {
                Some((_, text)) => text.push_str(&format!(" · {number}")),
                None => badges.push((end, number.to_string())),
            }
        }
        let mut taken = Vec::new();
        for (at, text) in badges {
            let frame = around(at, (text_width(&text, 11.0) + 8.0).max(18.0), 18.0);
            canvas.rectangle(frame, Style::fill("#1f5fbf").outlined("#ffffff", 1.6), 9.0);
            canvas.text(at, &text, Lettering { halo: false, ..Lettering::bold(11.0, "#ffffff") });
            taken.push(frame);
        }
        taken
    }

    /// Names of places, rooms and furniture, the large before the small, none over another.
    fn labels(&self, canvas: &mut Canvas) {
        for (p, _) in &self.places {
            canvas.circle(*p, 3.2, Style::fill("#b3261e"));
        }
        let mut taken = self.badges(canvas);
        for (p, name) in &self.places {
            place_label(
                canvas,
                &mut taken,
                *p,
                name,
                Lettering::bold(13.0, "#b3261e"),
                &AROUND_A_POINT,
            );
        }
        for area in self.scene.areas.values() {
            let area_of = |prism: &Prism| prism.polygon.signed_area();
            let largest = area.prisms.iter().max_by(|a, b| area_of(a).total_cmp(&area_of(b)));
            let Some(prism) = largest else { continue };
            let name = &self.world.areas[&area.id].name;
            place_label(
                canvas,
                &mut taken,
                prism.polygon.centroid(),
                name,
                Lettering::bold(21.0, INK),
                &IN_A_ROOM,
            );
        }
        let mut replicas: Vec<_> = self.scene.replicas.values().collect();
        let size = |b: &Bounds| (b.max.x - b.min.x) * (b.max.y - b.min.y);
        replicas.sort_by(|a, b| size(&b.bounds).total_cmp(&size(&a.bounds)).then(a.id.cmp(&b.id)));
        for replica in replicas {
            let center = nalgebra::center(&replica.bounds.min, &replica.bounds.max);
            let name = &self.world.replicas[&replica.id].name;
            place_label(
                canvas,
                &mut taken,
                center,
                name,
                Lettering::plain(9.0, "#5b5647"),
                &ON_A_THING,
            );
        }
    }
}

/// Offsets to try for a label, in its widths and heights.
const AROUND_A_POINT: [(f64, f64); 6] =
    [(0.0, 1.7), (0.0, -1.7), (0.75, 0.9), (-0.75, 0.9), (0.75, -0.9), (-0.75, -0.9)];
const IN_A_ROOM: [(f64, f64); 9] = [
    (0.0, 0.0),
    (0.0, 1.2),
    (0.0, -1.2),
    (0.0, 2.5),
    (0.0, -2.5),
    (0.6, 1.2),
    (-0.6, 1.2),
    (0.6, -1.2),
    (-0.6, -1.2),
];
const ON_A_THING: [(f64, f64); 5] = [(0.0, 0.0), (0.0, 0.8), (0.0, -0.8), (0.0, 1.7), (0.0, -1.7)];

/// Draws a label at the first offset where it covers no other; not at all when there is none.
fn place_label(
    canvas: &mut Canvas,
    taken: &mut Vec<Bounds>,
    at: Point,
    text: &str,
    lettering: Lettering,
    offsets: &[(f64, f64)],
) {
    let (width, height) = (text_width(text, lettering.size), lettering.size * 1.15);
    for (dx, dy) in offsets {
        let p = at + Vector::new(dx * width, dy * height);
        let frame = around(p, width, height);
        if !taken.iter().any(|t| t.meets(&frame)) {
            canvas.text(p, text, lettering);
            taken.push(frame);
            return;
        }
    }
}

fn around(p: Point, width: f64, height: f64) -> Bounds {
    let half = Vector::new(width / 2.0, height / 2.0);
    Bounds { min: p - half, max: p + half }
}

/// Wood for furniture, cooler for what can be moved about; flat boards thinner than solid blocks.
fn furniture_style(prism: &Prism, movable: bool) -> Style {
    let fill = match (movable, prism.top - prism.bottom > 5.0) {
        (false, true) => "#e0cba6",
        (false, false) => "#efe2c8",
        (true, true) => "#cfd6c4",
        (true, false) => "#dfe4d8",
    };
    Style::fill(fill).outlined("#8a7a5c", 0.9).faint(0.92)
}

fn draw_door(canvas: &mut Canvas, door: &DoorGlyph) {
    if let Some(swept) = &door.swept {
        canvas.polygon(swept, SWING, None);
    }
    canvas.polygon(&door.leaf, LEAF, None);
}

fn legend(canvas: &mut Canvas, extent: Bounds, floor: bool, route: bool) {
    let y = extent.min.y - 45.0;
    let x = extent.min.x;
    for (i, color) in ["#2b2a27", "#ffffff"].into_iter().enumerate() {
        let bar = Bounds {
            min: Point::new(x + 100.0 * i as f64, y),
            max: Point::new(x + 100.0 * (i + 1) as f64, y + 6.0),
        };
        canvas.rectangle(bar, Style::fill(color).outlined(INK, 1.0), 0.0);
    }
    let small = Lettering::plain(12.0, INK);
    canvas.text(Point::new(x, y - 12.0), "0", small);
    canvas.text(Point::new(x + 100.0, y - 12.0), "1 м", small);
    canvas.text(Point::new(x + 200.0, y - 12.0), "2 м", small);
    let mut x = x + 260.0;
    let mut entry = |canvas: &mut Canvas, style: Style, text: &str| {
        let swatch = Bounds { min: Point::new(x, y - 6.0), max: Point::new(x + 24.0, y + 8.0) };
        canvas.rectangle(swatch, style, 2.0);
        canvas.text(
            Point::new(x + 32.0, y + 1.0),
            text,
            Lettering { anchor: Anchor::Start, ..small },
        );
        x += 50.0 + text_width(text, 12.0);
    };
    if floor {
        entry(canvas, PASSFRAME, "Пассфреймы");
        entry(canvas, DEAD_ZONE, "мёртвые зоны");
    }
    entry(canvas, Style::fill("#e0cba6").outlined("#8a7a5c", 0.9), "мебель");
    entry(canvas, Style::fill("#cfd6c4").outlined("#8a7a5c", 0.9), "подвижное");
    if route {
        entry(canvas, Style::fill("#1f5fbf"), "маршрут");
    }
}
