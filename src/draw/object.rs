//! An Object from three sides with its dimensions: façade, profile, plan (fig. 8 of paper 1).
//!
//! The views stand as drawing rules of the first angle have it: the profile, seen from the left, to the right of the
//! façade; the plan, seen from above, below it.
//!
//! ```text
//!   façade   profile        each view has its own axes: right, up, and away from the eye
//!   plan
//! ```

use crate::geometry::{Bounds, Polygon, nearest_on_segment};
use crate::map::{Object, Permeability, World};
use crate::units::{InOrder as _, Language, Piece, Point, Vector, word};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;
use super::labels::{Ground, Labels};

const INK: &str = "#2b2a27";
const OUTLINE: &str = "#3b3a36";
const HIDDEN: &str = "#8a8578";
const DIMENSION: &str = "#4a6b8a";

/// One Orthoframe of the Object, turned so that the front looks to -y.
struct Body {
    id: String,
    base: Polygon,
    roof: Polygon,
    bottom: f64,
    top: f64,
    sides: Vec<Permeability>,
    roof_permeability: Permeability,
    /// Leaves of the door that a side bears, from its right jamb to the left: share of the width, hinges on the left.
    doors: Vec<(usize, Vec<(f64, bool)>)>,
}

/// Which way one looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum View {
    Facade,
    Profile,
    Plan,
}

/// A body as a view shows it.
struct Silhouette<'b> {
    body: &'b Body,
    outline: Polygon,
    /// Edges within the outline.
    inner: Vec<(Point, Point)>,
    /// Distances from the eye, the nearest and the farthest.
    near: f64,
    far: f64,
    /// The face towards the eye.
    face: Permeability,
}

impl View {
    /// A point of the Object on the sheet of this view.
    fn project(self, p: Point, z: f64) -> Point {
        match self {
            Self::Facade => Point::new(p.x, z),
            Self::Profile => Point::new(-p.y, z),
            Self::Plan => p,
        }
    }

    fn silhouette(self, body: &Body) -> Silhouette<'_> {
        let depth = |p: &Point| if self == Self::Facade { p.y } else { p.x };
        let all = || body.base.corners.iter().chain(&body.roof.corners);
        if self == Self::Plan {
            let (outer, other) = if body.roof.signed_area() > body.base.signed_area() {
                (&body.roof, &body.base)
            } else {
                (&body.base, &body.roof)
            };
            let inner = if outer == other { Vec::new() } else { other.edges().collect() };
            let (near, far) = (-body.top, -body.bottom);
            let face = body.roof_permeability;
            return Silhouette { body, outline: outer.clone(), inner, near, far, face };
        }
        let span = |polygon: &Polygon, z: f64| {
            let b = Bounds::of(polygon.corners.iter().map(|&p| self.project(p, z)));
            (b.min, Point::new(b.max.x, z))
        };
        let ((a, b), (d, c)) = (span(&body.base, body.bottom), span(&body.roof, body.top));
        let outline = Polygon::new(vec![a, b, c, d]);
        // Corners of faces towards the eye stand out, unless the base is a round one in small pieces.
        let towards = |i: usize| {
            let (p, q) =
                (body.base.corners[i], body.base.corners[(i + 1) % body.base.corners.len()]);
            let out = Vector::new(q.y - p.y, p.x - q.x);
            (if self == Self::Facade { -out.y } else { -out.x }) / out.norm().max(1e-9)
        };
        let n = body.base.corners.len();
        let mut inner = Vec::new();
        if n <= 10 {
            for i in 0..n {
                if towards(i) > 1e-6 || towards((i + n - 1) % n) > 1e-6 {
                    let at = self.project(body.base.corners[i], body.bottom);
                    inner.push((at, self.project(body.roof.corners[i], body.top)));
                }
            }
        }
        let open =
            |wanted: Permeability| (0..n).any(|i| towards(i) > 0.7 && body.sides[i] == wanted);
        let face = if open(Permeability::Permeable) {
            Permeability::Permeable
        } else if open(Permeability::Conditional) {
            Permeability::Conditional
        } else {
            Permeability::Impermeable
        };
        let near = all().map(depth).fold(f64::INFINITY, f64::min);
        let far = all().map(depth).fold(f64::NEG_INFINITY, f64::max);
        Silhouette { body, outline, inner, near, far, face }
    }

    fn title(self) -> Piece {
        match self {
            Self::Facade => word!("facade"),
            Self::Profile => word!("profile"),
            Self::Plan => word!("plan"),
        }
    }
}

/// The three views of an Object as SVG.
///
/// # Panics
/// When the Object is not of this world.
#[must_use]
pub fn object_svg(world: &World, object: &Object, language: Language) -> String {
    let bodies = bodies(world, object);
    let views = [View::Facade, View::Profile, View::Plan];
    let shown = views.map(|view| bodies.iter().map(|b| view.silhouette(b)).collect::<Vec<_>>());
    let extents = [0, 1, 2].map(|i| {
        shown[i].iter().fold(Bounds::EMPTY, |b, s: &Silhouette<'_>| b.union(&s.outline.bounds()))
    });
    let [facade, profile, plan] = extents;
    let ends = |view: usize, least: f64| {
        let bounds = shown[view].iter().map(|s| s.outline.bounds());
        let mut ends: Vec<f64> = bounds.flat_map(|b| [b.min.x, b.max.x]).collect();
        apart(&mut ends, least);
        ends
    };
    let size = |b: Bounds| b.max - b.min;
    let (width, height, depth) = (size(facade).x, size(facade).y, size(plan).y);
    // A letter is a fixed share of the sheet.
    let pen = ((width + depth).max(height + depth) / 620.0).max(0.004);
    let letter = 13.0 * pen;
    let shown_ends = [ends(0, 15.0 * pen), ends(1, 15.0 * pen)];
    let gap = 104.0 * pen;
    // Where each view's own origin stands on the sheet.
    let below = Vector::new(0.0, facade.min.y - gap - plan.max.y);
    let beside = Vector::new(facade.max.x + gap - profile.min.x, 0.0);
    let offsets = [Vector::zeros(), beside, below];
    let mut sheet = Bounds::of([
        facade.min,
        facade.max,
        profile.max + beside,
        plan.min + below,
        profile.min + beside,
    ]);
    let title = language
        .pick(&object.name, if object.name_en.is_empty() { &object.name } else { &object.name_en });
    let heading = 24.0 * pen;
    sheet = sheet.grown(40.0 * pen);
    sheet.min.x -= 70.0 * pen;
    sheet.min.y -= 20.0 * pen;
    sheet.max.y += 64.0 * pen;
    sheet.max.x = sheet.max.x.max(sheet.min.x + text_width(title, heading, true) + 60.0 * pen);
    let mut canvas = Canvas::new(sheet).wide((sheet.max.x - sheet.min.x) / pen);
    let left = Point::new(sheet.min.x + 30.0 * pen, sheet.max.y - 34.0 * pen);
    let start = |style: Lettering| Lettering { anchor: Anchor::Start, halo: false, ..style };
    canvas.mark("heading");
    canvas.text(left, title, start(Lettering::bold(heading, INK)));
    let note = word!("dimensions-in-centimetres").say(language);
    canvas.text(
        left - Vector::new(0.0, 24.0 * pen),
        &note,
        start(Lettering::plain(letter, HIDDEN)),
    );
    for ((view, mut silhouettes), offset) in views.into_iter().zip(shown).zip(offsets) {
        let extent = extents[view as usize];
        draw_view(&mut canvas, view, &mut silhouettes, offset, pen);
        canvas.mark("caption");
        let above = Point::new(extent.min.x, extent.max.y) + offset + Vector::new(0.0, 16.0 * pen);
        canvas.text(above, &view.title().say(language), start(Lettering::plain(letter, HIDDEN)));
    }
    let mut levels: Vec<f64> = bodies.iter().flat_map(|b| [b.bottom, b.top]).collect();
    distinct(&mut levels, 15.0 * pen);
    let ruler = Ruler { pen, language };
    let x = facade.min.x - 26.0 * pen;
    if levels.len() > 2 {
        ruler.upright(&mut canvas, x, facade.min.x, &levels);
        ruler.upright(&mut canvas, x - 32.0 * pen, x, &[facade.min.y, facade.max.y]);
    } else {
        ruler.upright(&mut canvas, x, facade.min.x, &[facade.min.y, facade.max.y]);
    }
    // Widths under the façade and depths under the profile: what the parts take, and below that the whole.
    let y = facade.min.y - 26.0 * pen;
    for (view, extent, offset) in [(0, facade, 0.0), (1, profile, beside.x)] {
        let ends = shown_ends[view].iter().map(|x| x + offset).collect::<Vec<f64>>();
        let whole = [extent.min.x + offset, extent.max.x + offset];
        if ends.len() > 2 {
            ruler.level(&mut canvas, y, facade.min.y, &ends);
            ruler.level(&mut canvas, y - 32.0 * pen, y, &whole);
        } else {
            ruler.level(&mut canvas, y, facade.min.y, &whole);
        }
    }
    let (low, high) = (plan.min.y + below.y, plan.max.y + below.y);
    ruler.upright(&mut canvas, x, plan.min.x, &[low, high]);
    canvas.into_svg(title)
}

fn bodies(world: &World, object: &Object) -> Vec<Body> {
    let front = object.front.as_ref().and_then(|side| {
        let item = object.item(&side.item)?;
        let (_, vector) = world.orthoframe_of(item).side(&side.side)?;
        let along = item.frame.apply(vector.end) - item.frame.apply(vector.start);
        Some(Vector::new(along.y, -along.x).normalize())
    });
    let out = front.unwrap_or(Vector::new(0.0, -1.0));
    let right = Vector::new(-out.y, out.x);
    let turned = |p: Point| Point::new(p.coords.dot(&right), -p.coords.dot(&out));
    object
        .items
        .iter()
        .map(|item| {
            let orthoframe = world.orthoframe_of(item);
            let corners: Vec<Point> =
                orthoframe.corners().map(|p| turned(item.frame.apply(p))).collect();
            let base = Polygon::new(corners);
            let centre = base.centroid();
            let scaled = |p: &Point| centre + (p - centre) * orthoframe.roof_scale;
            let roof = Polygon::new(base.corners.iter().map(scaled).collect());
            let bottom = item.frame.z.get();
            let doors = object.doors.iter().filter(|m| m.item == item.id).filter_map(|mount| {
                let (index, _) = orthoframe.side(&mount.side)?;
                let leaves = &world.doors.get(&mount.door)?.leaves;
                let leaf =
                    |l: &crate::map::DoorLeaf| (l.share, l.hinge == crate::map::HingeSide::Left);
                Some((index, leaves.iter().map(leaf).collect()))
            });
            Body {
                id: item.id.clone(),
                roof,
                bottom,
                top: bottom + orthoframe.height.get(),
                sides: orthoframe.base.iter().map(|v| v.permeability).collect(),
                roof_permeability: orthoframe.roof_permeability,
                doors: doors.collect(),
                base,
            }
        })
        .collect()
}

/// Far things first; an open front shows what is behind it, and only its rim is drawn in its own place.
fn draw_view(
    canvas: &mut Canvas,
    view: View,
    silhouettes: &mut [Silhouette<'_>],
    offset: Vector,
    pen: f64,
) {
    let placed =
        |polygon: &Polygon| Polygon::new(polygon.corners.iter().map(|p| p + offset).collect());
    let is_open = |s: &Silhouette<'_>| s.face == Permeability::Permeable;
    let key = |s: &Silhouette<'_>| if is_open(s) { s.far } else { s.near };
    let area = |s: &Silhouette<'_>| s.outline.signed_area().abs();
    // Of two that begin at one depth the larger holds the smaller.
    silhouettes.sort_by(|a, b| key(b).total_cmp(&key(a)).then(area(a).total_cmp(&area(b))));
    let line = 1.5 * pen;
    for s in silhouettes.iter() {
        let fill = if is_open(s) { "#f3ead8" } else { "#e6d3b1" };
        canvas.mark_of("part", format!("part-{}", s.body.id));
        canvas.polygon(
            &placed(&s.outline),
            Style::fill(fill).outlined(OUTLINE, line),
            Some(&s.body.id),
        );
        canvas.mark("edge");
        for &(a, b) in &s.inner {
            canvas.segment(a + offset, b + offset, Style::line(OUTLINE, line * 0.7));
        }
        if view == View::Facade && s.face == Permeability::Conditional {
            leaves(canvas, s, offset, pen);
        }
    }
    canvas.mark("edge");
    for s in silhouettes.iter().filter(|s| is_open(s)) {
        canvas.polygon(&placed(&s.outline), Style::line(OUTLINE, line * 1.3), None);
    }
    // What a nearer body hides is dashed.
    for hidden in silhouettes.iter() {
        let frame = hidden.outline.bounds();
        let hides = |s: &&Silhouette<'_>| {
            let over = s.outline.bounds().grown(1e-6);
            !is_open(s)
                && (s.near < hidden.near - 1e-6
                    || s.near < hidden.near + 1e-6 && area(s) > area(hidden) + 1e-6)
                && over.contains(frame.min)
                && over.contains(frame.max)
        };
        let nearer: Vec<&Silhouette<'_>> = silhouettes.iter().filter(hides).collect();
        // An edge that is seen takes the place of a hidden one behind it.
        let is_seen = |(a, b): &(Point, Point)| {
            let on =
                |p: Point, (u, v): (Point, Point)| (nearest_on_segment(p, u, v) - p).norm() < 1e-3;
            nearer.iter().any(|s| s.outline.edges().any(|e| on(*a, e) && on(*b, e)))
        };
        if !nearer.is_empty() {
            canvas.mark("hidden");
            let dashes = Style::line(HIDDEN, line * 0.6).dashed(5.0 * pen, 3.5 * pen);
            for (a, b) in hidden.outline.edges().filter(|edge| !is_seen(edge)) {
                canvas.segment(a + offset, b + offset, dashes);
            }
        }
    }
    let mut labels = Labels::new(11.0 * pen).spaced(4.0 * pen);
    canvas.mark("letter");
    for (letters, bounds) in lettered(silhouettes) {
        let frame = Bounds { min: bounds.min + offset, max: bounds.max + offset };
        labels.on_thing(
            canvas,
            &Ground { bounds: frame, upon: &[], slant: None },
            &letters,
            Lettering::bold(11.0 * pen, "#7a5c2e"),
            None,
        );
    }
}

/// The letters of the parts with what each stands on. Parts of which one covers the other from this side share one
/// label, the nearest first: «C, B, A», for letters side by side would be those of parts side by side.
fn lettered(silhouettes: &[Silhouette<'_>]) -> Vec<(String, Bounds)> {
    /// Outlines that differ less look like one, cm.
    const SAME: f64 = 0.5;
    let mut groups: Vec<(Vec<&Silhouette<'_>>, Bounds)> = Vec::new();
    for s in silhouettes {
        let bounds = s.outline.bounds();
        let is_same = |other: &Bounds| {
            (bounds.min - other.min).amax() < SAME && (bounds.max - other.max).amax() < SAME
        };
        match groups.iter_mut().find(|(_, other)| is_same(other)) {
            Some((group, _)) => group.push(s),
            None => groups.push((vec![s], bounds)),
        }
    }
    let letters = |(mut group, bounds): (Vec<&Silhouette<'_>>, Bounds)| {
        group.order_by(|a, b| a.near.total_cmp(&b.near).then(a.body.id.cmp(&b.body.id)));
        let ids: Vec<&str> = group.iter().map(|s| s.body.id.as_str()).collect();
        (ids.join(", "), bounds)
    };
    groups.into_iter().map(letters).collect()
}

/// The leaves of a furniture door, with the dashes that run to the hinges.
fn leaves(canvas: &mut Canvas, s: &Silhouette<'_>, offset: Vector, pen: f64) {
    canvas.mark("leaf");
    let bounds = s.outline.bounds();
    let (low, high) = (bounds.min + offset, bounds.max + offset);
    for (_, leaves) in &s.body.doors {
        let mut x = high.x;
        for (share, hinged_left) in leaves {
            let next = x - share * (high.x - low.x);
            let inset = 2.5 * pen;
            let frame = Bounds {
                min: Point::new(next + inset, low.y + inset),
                max: Point::new(x - inset, high.y - inset),
            };
            canvas.rectangle(frame, Style::line(OUTLINE, 1.0 * pen), 0.0);
            let (hinge, free) =
                if *hinged_left { (frame.min.x, frame.max.x) } else { (frame.max.x, frame.min.x) };
            let middle = f64::midpoint(frame.min.y, frame.max.y);
            let dashes = Style::line(HIDDEN, 0.8 * pen).dashed(5.0 * pen, 4.0 * pen);
            let corners = [
                Point::new(free, frame.min.y),
                Point::new(hinge, middle),
                Point::new(free, frame.max.y),
            ];
            canvas.polyline(&corners, dashes);
            x = next;
        }
    }
}

/// Sorted, without values closer together than `least`; the outermost stay.
fn distinct(values: &mut Vec<f64>, least: f64) {
    values.sort_by(f64::total_cmp);
    let last = values.last().copied();
    values.dedup_by(|next, kept| *next - *kept < least);
    if let (Some(last), Some(kept)) = (last, values.last_mut()) {
        *kept = last;
    }
}

/// Sorted, the outermost and those that no other is closer to than `least`: of a pole in the middle neither side stays.
fn apart(values: &mut Vec<f64>, least: f64) {
    values.sort_by(f64::total_cmp);
    values.dedup_by(|next, kept| *next - *kept < 1e-3);
    let all = values.clone();
    let last = all.len().saturating_sub(1);
    let mut index = 0..;
    values.retain(|v| {
        let i = index.next().unwrap_or(0);
        let is_close = |j: usize| (all[j] - v).abs() < least;
        i == 0 || i == last || !is_close(i - 1) && !is_close(i + 1)
    });
}

/// Draws chains of dimensions.
struct Ruler {
    pen: f64,
    language: Language,
}

impl Ruler {
    fn text(&self, value: f64) -> String {
        let text = ((value * 10.0).round() / 10.0).to_string();
        self.language.pick(text.replace('.', ","), text)
    }

    /// A chain at height `y` between marks; the extension lines start at `from`.
    fn level(&self, canvas: &mut Canvas, y: f64, from: f64, marks: &[f64]) {
        self.chain(
            canvas,
            marks,
            |mark, away| Point::new(mark, y + away),
            |mark| Point::new(mark, from),
            0.0,
        );
    }

    fn upright(&self, canvas: &mut Canvas, x: f64, from: f64, marks: &[f64]) {
        self.chain(
            canvas,
            marks,
            |mark, away| Point::new(x - away, mark),
            |mark| Point::new(from, mark),
            90.0,
        );
    }

    fn chain(
        &self,
        canvas: &mut Canvas,
        marks: &[f64],
        on_line: impl Fn(f64, f64) -> Point,
        origin: impl Fn(f64) -> Point,
        turn: f64,
    ) {
        let pen = self.pen;
        canvas.mark("dimension");
        let thin = Style::line(DIMENSION, 0.8 * pen);
        let size = 11.0 * pen;
        let beyond = |mark: f64| {
            let (a, b) = (origin(mark), on_line(mark, 0.0));
            let away = (b - a).try_normalize(1e-9).unwrap_or_else(Vector::zeros);
            (a + away * 3.0 * pen, b + away * 5.0 * pen)
        };
        for &mark in marks {
            let (a, b) = beyond(mark);
            canvas.segment(a, b, thin);
            // The architect's tick.
            let at = on_line(mark, 0.0);
            let tick = Vector::new(4.0, 4.0) * pen;
            canvas.segment(at - tick, at + tick, Style::line(DIMENSION, 1.4 * pen));
        }
        let mut last_outside = false;
        for pair in marks.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            canvas.segment(on_line(a, 0.0), on_line(b, 0.0), thin);
            let text = self.text(b - a);
            let fits = text_width(&text, size, false) + 6.0 * pen <= b - a;
            // A narrow step has its number on the other side of the line, so that neighbours do not touch.
            last_outside = !fits && !last_outside;
            let away = if last_outside { -9.0 } else { 8.0 } * pen;
            let lettering = Lettering {
                turn: if fits { turn } else { 0.0 },
                ..Lettering::plain(size, DIMENSION)
            };
            canvas.text(on_line(f64::midpoint(a, b), away), &text, lettering);
        }
    }
}
