//! What the robot would see from a pose (M12): walls, doors and things in perspective, hidden parts hidden, names on what
//! is seen.
//!
//! The picture plane is upright: one looks along the heading, at eye height.

mod bodies;
mod bsp;

use nalgebra::{Point3, Vector3};

use crate::geometry::{Bounds, Polygon, Scene};
use crate::map::{DoorStatus, World};
use crate::units::{InOrder as _, Language, Lengths, Point, Pose, Vector, told};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;
use super::labels::{Labels, around};
use bsp::{Facet, Plane, far_to_near};

/// A door leaf that stands on the floor.
#[derive(Debug, Clone)]
pub struct LeafBody {
    pub base: Polygon,
    pub bottom: f64,
    pub top: f64,
    pub status: DoorStatus,
}

/// An opening through a wall that has a depth.
#[derive(Debug, Clone)]
pub struct Mouth {
    /// On the right and on the left: from the face of the wall on one side to that on the other.
    pub jambs: [(Point, Point); 2],
    pub bottom: f64,
    /// Of the opening.
    pub top: f64,
}

/// What is to be shown, and from where.
#[derive(Debug)]
pub struct ViewDrawing<'a> {
    pub world: &'a World,
    pub scene: &'a Scene,
    pub leaves: Vec<LeafBody>,
    pub mouths: Vec<Mouth>,
    pub pose: Pose,
    /// Of the eye above the Map's zero, cm.
    pub height: f64,
    /// Angle of view from side to side, degrees; 10 to 150.
    pub field: f64,
    /// What is farther is left out, cm.
    pub range: f64,
    pub language: Language,
}

/// Of the picture, in its own units.
const WIDTH: f64 = 1200.0;
const HEIGHT: f64 = 760.0;
/// Of the line below the picture.
const CAPTION: f64 = 44.0;
/// Nothing is drawn nearer to the eye than this, cm.
const NEAREST: f64 = 4.0;
/// A name stands on what takes this share of the picture at least.
const NAMED: f64 = 0.0012;

/// What a facet belongs to, with the colour of its body.
#[derive(Debug, Clone)]
struct Body {
    color: [f64; 3],
    /// Of the thing; empty for walls.
    name: String,
}

struct Camera {
    eye: Point3<f64>,
    forward: Vector3<f64>,
    right: Vector3<f64>,
    focus: f64,
}

impl Camera {
    fn project(&self, p: &Point3<f64>) -> Point {
        let v = p - self.eye;
        let depth = v.dot(&self.forward).max(1e-6);
        Point::new(v.dot(&self.right) * self.focus / depth, v.z * self.focus / depth)
    }

    /// The planes that bound what is in the picture, their normals inwards.
    fn frustum(&self) -> [Plane; 5] {
        let through_eye =
            |normal: Vector3<f64>| Plane { normal, offset: normal.dot(&self.eye.coords) };
        let side = |sign: f64| self.forward * (WIDTH / 2.0) + self.right * (sign * self.focus);
        let level = |sign: f64| self.forward * (HEIGHT / 2.0) + Vector3::z() * (sign * self.focus);
        let near = Plane {
            normal: self.forward,
            offset: self.forward.dot(&(self.eye + self.forward * NEAREST).coords),
        };
        [
            near,
            through_eye(side(1.0).normalize()),
            through_eye(side(-1.0).normalize()),
            through_eye(level(1.0).normalize()),
            through_eye(level(-1.0).normalize()),
        ]
    }
}

impl ViewDrawing<'_> {
    /// The view as SVG text.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let (sin, cos) = self.pose.heading.sin_cos();
        let field = self.field.clamp(10.0, 150.0).to_radians();
        let camera = Camera {
            eye: Point3::new(self.pose.at.x, self.pose.at.y, self.height),
            forward: Vector3::new(cos, sin, 0.0),
            right: Vector3::new(sin, -cos, 0.0),
            focus: WIDTH / 2.0 / (field / 2.0).tan(),
        };
        let frame = around(Point::origin(), WIDTH, HEIGHT);
        let sheet = Bounds { min: frame.min - Vector::new(0.0, CAPTION), max: frame.max };
        let mut canvas = Canvas::new(sheet).wide(WIDTH);
        canvas.mark("backdrop");
        backdrop(&mut canvas, frame);
        let (bodies, facets) = bodies::of(self, camera.eye);
        let frustum = camera.frustum();
        let in_view = |facet: Facet| frustum.iter().try_fold(facet, |f, plane| f.clipped(plane));
        let facets: Vec<Facet> = facets.into_iter().filter_map(in_view).collect();
        let order = far_to_near(facets, camera.eye);
        for facet in &order {
            self.paint(&mut canvas, &camera, facet, &bodies[facet.owner]);
        }
        self.names(&mut canvas, &camera, &order, &bodies);
        canvas.mark("frame");
        canvas.rectangle(frame.grown(-1.0), Style::line("#3b3a36", 2.0), 0.0);
        let caption = self.caption();
        let plain =
            Lettering { anchor: Anchor::Start, halo: false, ..Lettering::plain(16.0, "#2b2a27") };
        // A long name of a room makes the letters no wider than the picture, as long as they can be read.
        let wide = text_width(&caption, plain.size, false);
        let size = plain.size * ((WIDTH - 40.0) / wide).clamp(0.5, 1.0);
        canvas.mark("caption");
        let at = Point::new(frame.min.x + 20.0, frame.min.y - CAPTION / 2.0);
        canvas.text(at, &caption, Lettering { size, ..plain });
        canvas.into_svg(&caption)
    }

    /// From where one looks, and how: the room, the pose, the eye and its angle.
    fn caption(&self) -> String {
        let holds = |a: &&crate::geometry::PlacedArea| {
            a.prisms.iter().any(|p| p.polygon.contains(self.pose.at, 0.1))
        };
        let room = self.scene.areas.values().find(holds).map(|a| &self.world.areas[&a.id]);
        let name = room.map_or("", |area| match self.language {
            Language::English if !area.name_en.is_empty() => &area.name_en,
            _ => &area.name,
        });
        let lengths = Lengths::said();
        let [x, y] = [self.pose.at.x, self.pose.at.y]
            .map(|at| lengths.in_language(at.round() + 0.0, 0, self.language));
        let height = lengths.told(self.height.round() + 0.0, 0, self.language);
        let [heading, field] = [self.pose.heading.get(), self.field].map(|v| v.round() as i64);
        told!(self.language, "view", room = name, x, y, heading, height, field)
    }

    fn paint(&self, canvas: &mut Canvas, camera: &Camera, facet: &Facet, body: &Body) {
        let corners: Vec<Point> = facet.corners.iter().map(|p| camera.project(p)).collect();
        canvas.mark(if body.name.is_empty() { "wall" } else { "thing" });
        // Lamps hang high and to the left of one who looks; what is far is paler.
        let towards =
            if facet.normal.dot(&(camera.eye - facet.corners[0])) < 0.0 { -1.0 } else { 1.0 };
        let lamp = (Vector3::z() * 0.75 - camera.right * 0.4 - camera.forward * 0.55).normalize();
        let light = 0.84 + 0.20 * (facet.normal * towards).dot(&lamp).max(-0.6);
        // By the distance of the plane, so that the pieces of one wall look alike.
        let depth = facet.normal.dot(&(camera.eye - facet.corners[0])).abs();
        let haze = (depth / self.range).clamp(0.0, 1.0) * 0.25;
        let shade = |c: f64| (c * light * (1.0 - haze) + 0.96 * haze).clamp(0.0, 1.0);
        let fill = hex(body.color.map(shade));
        let line = hex(body.color.map(|c| shade(c) * 0.55));
        canvas.shade(&corners, &fill);
        let n = corners.len();
        for i in (0..n).filter(|&i| facet.is_edge[i]) {
            canvas.stroke(corners[i], corners[(i + 1) % n], &line, 1.1);
        }
    }

    /// Names on what is seen well, measured on a coarse picture in which each cell keeps the nearest facet.
    fn names(&self, canvas: &mut Canvas, camera: &Camera, order: &[Facet], bodies: &[Body]) {
        const COLUMNS: usize = 150;
        const ROWS: usize = 95;
        let cell = Point::new(WIDTH / COLUMNS as f64, HEIGHT / ROWS as f64);
        let mut nearest = vec![usize::MAX; COLUMNS * ROWS];
        for facet in order {
            let outline = Polygon::new(facet.corners.iter().map(|p| camera.project(p)).collect());
            let b = outline.bounds();
            let column = |x: f64| {
                ((x + WIDTH / 2.0) / cell.x).floor().clamp(0.0, COLUMNS as f64 - 1.0) as usize
            };
            let row = |y: f64| {
                ((y + HEIGHT / 2.0) / cell.y).floor().clamp(0.0, ROWS as f64 - 1.0) as usize
            };
            for r in row(b.min.y)..=row(b.max.y) {
                for c in column(b.min.x)..=column(b.max.x) {
                    if outline.contains(middle_of(r, c, cell), 0.0) {
                        nearest[r * COLUMNS + c] = facet.owner;
                    }
                }
            }
        }
        let mut seen: std::collections::BTreeMap<&str, Vec<Point>> = Default::default();
        for (i, &owner) in nearest.iter().enumerate() {
            if let Some(body) = bodies.get(owner).filter(|b| !b.name.is_empty()) {
                seen.entry(&body.name).or_default().push(middle_of(i / COLUMNS, i % COLUMNS, cell));
            }
        }
        let mut seen: Vec<_> = seen.into_iter().collect();
        seen.order_by(|a, b| b.1.len().cmp(&a.1.len()).then(a.0.cmp(b.0)));
        let mut labels =
            Labels::new(14.0).within(around(Point::origin(), WIDTH, HEIGHT).grown(-4.0));
        canvas.mark("name");
        for (name, cells) in seen {
            if (cells.len() as f64) < NAMED * (COLUMNS * ROWS) as f64 {
                continue;
            }
            let sum = cells.iter().map(|p| p.coords).sum::<Vector>();
            let centre = Point::from(sum / cells.len() as f64);
            let off = |p: &Point| (p - centre).norm_squared();
            // The middle of a chair may be what stands behind it: a spot on the thing itself.
            if let Some(&spot) = cells.iter().min_by(|a, b| off(a).total_cmp(&off(b))) {
                let lettering = Lettering::plain(15.0, "#2b2a27");
                let half = text_width(name, lettering.size, false) / 2.0 + 6.0;
                let x =
                    spot.x.clamp(half - WIDTH / 2.0, (WIDTH / 2.0 - half).max(half - WIDTH / 2.0));
                let y = spot.y.clamp(16.0 - HEIGHT / 2.0, HEIGHT / 2.0 - 16.0);
                labels.near(canvas, Point::new(x, y), name, lettering);
            }
        }
    }
}

fn middle_of(row: usize, column: usize, cell: Point) -> Point {
    let at = |i: usize, size: f64, whole: f64| (i as f64 + 0.5) * size - whole / 2.0;
    Point::new(at(column, cell.x, WIDTH), at(row, cell.y, HEIGHT))
}

/// Ceiling above the eye's level, floor below it, where nothing else is.
fn backdrop(canvas: &mut Canvas, frame: Bounds) {
    canvas.rectangle(frame, Style::fill("#eceae4"), 0.0);
    let floor = Bounds { min: frame.min, max: Point::new(frame.max.x, 0.0) };
    canvas.rectangle(floor, Style::fill("#d9d3c5"), 0.0);
}

fn hex(color: [f64; 3]) -> String {
    let [r, g, b] = color.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
