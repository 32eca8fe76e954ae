//! A schematic drawing of a corridor road graph, as SVG: vertices, arcs both ways, labels (paper 4, figs. 2-3).
//!
//! The caller gives plain points and texts; nothing here knows how a road graph is made. The drawing keeps roughly where
//! vertices lie to each other, not the distances: empty stretches are shortened, and what is crowded moves apart until no
//! mark lies on another. Letters grow with the sheet, so that they can be read however large the building is.
//!
//! **Invariant.** No mark lies on another, no two texts overlap, no name lies on an arc where there is place elsewhere, and
//! the sheet holds them all.

use std::collections::BTreeSet;

use crate::geometry::{Bounds, Polygon};
use crate::units::{Gather as _, InOrder as _, Point, Vector};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;
use super::labels::{Labels, around, frame_point};

/// How a vertex is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CorridorMark {
    Entrance,
    Junction,
}

#[derive(Debug, Clone, PartialEq)]
pub struct CorridorVertex {
    /// In any unit, +y to the north; the drawing is scaled to fit.
    pub at: Point,
    pub mark: CorridorMark,
    /// Inside the mark: «2», «2'».
    pub label: String,
    /// Beside the mark: «202».
    pub name: String,
    /// Where the name stands, as seen from the mark; a zero vector puts it below.
    pub name_towards: Vector,
}

#[derive(Debug, Clone, PartialEq)]
pub struct CorridorArc {
    /// Indices into [`CorridorDrawing::vertices`].
    pub from: usize,
    pub to: usize,
    /// At the middle of the arc: its code.
    pub label: String,
    /// Part of the way that is shown.
    pub on_way: bool,
    /// Drawn in a weaker line: a U-turn.
    pub faint: bool,
}

/// Everything that the drawing shows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CorridorDrawing {
    pub title: String,
    pub vertices: Vec<CorridorVertex>,
    pub arcs: Vec<CorridorArc>,
    /// What the labels of arcs mean: those of this drawing are listed.
    pub codes: Vec<(String, String)>,
    /// What the marks and lines mean, in the order of [`CorridorSign`]; none leaves the sign out of the legend.
    pub signs: Vec<(CorridorSign, String)>,
    /// Lines below the drawing: the commands.
    pub notes: Vec<String>,
}

/// What the legend explains besides codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CorridorSign {
    Entrance,
    Junction,
    Arc,
    Way,
    UTurn,
}

const RADIUS: f64 = 15.0;
/// Letters are so large at least, and such a share of the longer side of what is drawn: some nine pixels of 1600.
const LETTER: f64 = 13.0;
const READABLE: f64 = 13.0 / 2200.0;
/// Of lines below the drawing, in letters.
const LINE: f64 = 1.55;
/// Arcs keep to the right of the line between their vertices by this much.
const LANE: f64 = 6.0;
/// Marks stand so far apart at least; what is joined by an arc, farther, for its arrow and code.
const APART: f64 = 2.0 * RADIUS + 10.0;
const JOINED: f64 = 2.0 * RADIUS + 36.0;
/// An empty stretch is no longer than this.
const LONGEST: f64 = 120.0;
/// Before crowds move apart the drawing is no larger than this.
const LARGEST: f64 = 2200.0;
/// How often crowds are looked at: moved apart where they are, and then with all that lies beyond.
const MOST_NUDGES: usize = 400;
const MOST_LOOKS: usize = 50;
const INK: &str = "#22303c";
const WAY: &str = "#c0392b";
const ARC: &str = "#5b6770";
const FAINT: &str = "#aab4bb";
const DOOR: &str = "#2c5f8a";
const CORRIDOR: Style = Style::line("#edf0f2", 44.0);
const ENTRANCE: Style = Style::fill("#ffffff").outlined(DOOR, 2.0);
const JUNCTION: Style = Style::fill("#fff3d6").outlined("#b9770e", 2.0);

/// The drawing as an SVG document.
#[must_use]
pub fn corridor_svg(drawing: &CorridorDrawing) -> String {
    let points = placed(drawing);
    let plan = Bounds::of(points.iter().copied().chain([Point::origin()])).grown(RADIUS);
    let letter = LETTER.max((plan.max - plan.min).amax() * READABLE);
    // Names are placed first: how far they reach is how large the sheet must be.
    let codes = codes(drawing, &points, letter);
    let names = names(drawing, &points, &codes, letter);
    let frames = names.iter().map(|name| &name.frame).chain(codes.iter().map(|code| &code.frame));
    let reach = frames.fold(plan, |all, frame| all.union(frame)).grown(24.0);
    let left = reach.min.x;
    let key = Key { letter };
    let lines = key.lines(drawing, reach.max.x - left);
    let texts = drawing.notes.iter().chain(lines.iter().flat_map(|l| l.iter().map(|e| &e.text)));
    let widest = texts.map(|t| text_width(t, letter, false) + 3.1 * letter).fold(0.0, f64::max);
    let head_letter = 1.3 * letter;
    let line_height = LINE * letter;
    let title_width = text_width(&drawing.title, head_letter, true);
    let rows = lines.len() + drawing.notes.len() + usize::from(!drawing.notes.is_empty());
    let mut sheet = reach;
    sheet.max.x = sheet.max.x.max(left + widest.max(title_width).max(360.0) + 30.0);
    sheet.max.y += 2.4 * head_letter;
    sheet.min.y -= line_height * rows as f64 + 16.0;
    let sheet = Bounds { min: sheet.min - Vector::new(16.0, 0.0), max: sheet.max };
    let mut canvas = Canvas::new(sheet).wide(sheet.max.x - sheet.min.x);
    let start = |style: Lettering| Lettering { anchor: Anchor::Start, halo: false, ..style };
    let head = Point::new(left, sheet.max.y - 1.4 * head_letter);
    canvas.mark("heading");
    canvas.text(head, &drawing.title, start(Lettering::bold(head_letter, INK)));
    canvas.mark("corridor");
    for (a, b) in corridors(drawing) {
        canvas.segment(points[a], points[b], CORRIDOR);
    }
    for (n, arc) in drawing.arcs.iter().enumerate() {
        draw_arc(&mut canvas, &points, n, arc);
    }
    canvas.mark("code");
    for Code { text, frame, color } in &codes {
        let at = nalgebra::center(&frame.min, &frame.max);
        canvas.text(at, text, Lettering::plain(letter, color));
    }
    canvas.mark("name");
    for Name { frame, mark, is_far, .. } in &names {
        if *is_far {
            let end = frame_point(frame, *mark);
            canvas.segment(*mark, end, Style::line(DOOR, 0.8).faint(0.6));
        }
    }
    for (vertex, at) in drawing.vertices.iter().zip(&points) {
        draw_vertex(&mut canvas, vertex, *at, letter);
    }
    canvas.mark("name");
    for Name { text, frame, .. } in &names {
        let at = nalgebra::center(&frame.min, &frame.max);
        canvas.text(at, text, Lettering::bold(letter, DOOR));
    }
    let mut y = reach.min.y - line_height / 2.0;
    for line in &lines {
        for entry in line {
            key.draw(entry, &mut canvas, Point::new(left, y));
        }
        y -= line_height;
    }
    y -= line_height / 2.0;
    canvas.mark("note");
    for note in &drawing.notes {
        canvas.text(Point::new(left, y), note, start(Lettering::plain(letter, "#3d4a55")));
        y -= line_height;
    }
    canvas.into_svg(&drawing.title)
}

/// An entry of the legend, so far to the right of its line's start.
struct KeyEntry {
    x: f64,
    sign: Option<CorridorSign>,
    /// The code itself, where it is one.
    code: String,
    text: String,
}

/// The legend in letters of a size.
struct Key {
    letter: f64,
}

impl Key {
    /// The width of a sign.
    fn sign(&self) -> f64 {
        2.6 * self.letter
    }

    fn width(&self, code: &str, text: &str) -> f64 {
        let words = text_width(code, self.letter, true) + text_width(text, self.letter, false);
        self.sign() + words + 2.0 * self.letter
    }

    fn draw(&self, entry: &KeyEntry, canvas: &mut Canvas, line: Point) {
        let at = line + Vector::new(entry.x, 0.0);
        let middle = at + Vector::new(self.sign() / 2.0 - 0.3 * self.letter, 0.0);
        let reach = Vector::new(0.9 * self.letter, 0.0);
        let (a, b) = (middle - reach, middle + reach);
        match entry.sign {
            Some(CorridorSign::Entrance) => {
                canvas.mark("key entrance");
                canvas.circle(middle, 0.54 * self.letter, ENTRANCE);
            }
            Some(CorridorSign::Junction) => {
                canvas.mark("key junction");
                let size = 1.08 * self.letter;
                canvas.rectangle(around(middle, size, size), JUNCTION, 3.0);
            }
            Some(CorridorSign::Arc) => {
                canvas.mark("key arc");
                arrow(canvas, (a, b), ARC, 1.3);
            }
            Some(CorridorSign::Way) => {
                canvas.mark("key way");
                arrow(canvas, (a, b), WAY, 2.6);
            }
            Some(CorridorSign::UTurn) => {
                canvas.mark("key u-turn");
                arrow(canvas, (a, b), FAINT, 1.0);
            }
            None => {}
        }
        canvas.mark("key");
        let style = |style: Lettering| Lettering { anchor: Anchor::Start, halo: false, ..style };
        let letter = self.letter;
        let mut x = self.sign();
        if !entry.code.is_empty() {
            x = 0.0;
            canvas.text(at, &entry.code, style(Lettering::bold(letter, ARC)));
            x += text_width(&entry.code, letter, true) + 0.5 * letter;
        }
        canvas.text(at + Vector::new(x, 0.0), &entry.text, style(Lettering::plain(letter, INK)));
    }

    /// Lines of at most `width`: what is drawn, and the codes that stand at arcs.
    fn lines(&self, drawing: &CorridorDrawing, width: f64) -> Vec<Vec<KeyEntry>> {
        let has_mark = |mark| drawing.vertices.iter().any(|v| v.mark == mark);
        let arcs = |wanted: &dyn Fn(&CorridorArc) -> bool| drawing.arcs.iter().any(wanted);
        let is_drawn = |sign| match sign {
            CorridorSign::Entrance => has_mark(CorridorMark::Entrance),
            CorridorSign::Junction => has_mark(CorridorMark::Junction),
            CorridorSign::Arc => arcs(&|a| !a.on_way && !a.faint),
            CorridorSign::Way => arcs(&|a| a.on_way),
            CorridorSign::UTurn => arcs(&|a| a.faint && !a.on_way),
        };
        let signs = drawing.signs.iter().filter(|(sign, _)| is_drawn(*sign));
        let signs = signs.map(|(sign, text)| (Some(*sign), String::new(), text.clone()));
        let used: BTreeSet<&str> = drawing.arcs.iter().map(|a| a.label.as_str()).gather();
        let codes = drawing.codes.iter().filter(|(code, _)| used.contains(code.as_str()));
        let codes = codes.map(|(code, text)| (None, code.clone(), text.clone()));
        let mut lines: Vec<Vec<KeyEntry>> = Vec::new();
        let mut x = f64::INFINITY;
        for (sign, code, text) in signs.chain(codes) {
            let wide = self.width(&code, &text);
            // A code begins no line of signs, so that each reads by itself.
            let begins = code.is_empty() != lines.last().is_none_or(|l| l[0].code.is_empty());
            if begins || x + wide > width.max(54.0 * self.letter) {
                x = 0.0;
                lines.push(Vec::new());
            }
            if let Some(line) = lines.last_mut() {
                line.push(KeyEntry { x, sign, code, text });
            }
            x += wide;
        }
        lines
    }
}

/// Pairs of vertices that are joined both ways: there runs a corridor. Each pair once.
fn corridors(drawing: &CorridorDrawing) -> Vec<(usize, usize)> {
    let known = |i: usize| i < drawing.vertices.len();
    let arcs = drawing.arcs.iter().filter(|a| !a.faint && known(a.from) && known(a.to));
    let ways: BTreeSet<_> = arcs.map(|a| (a.from, a.to)).gather();
    ways.iter().copied().filter(|&(a, b)| a < b && ways.contains(&(b, a))).collect()
}

/// Points of the page, +y upwards: in the order of the vertices along both axes, and none on another.
fn placed(drawing: &CorridorDrawing) -> Vec<Point> {
    let finite = |p: Point| if p.x.is_finite() && p.y.is_finite() { p } else { Point::origin() };
    let mut points: Vec<Point> = drawing.vertices.iter().map(|v| finite(v.at)).collect();
    let count = points.len();
    let joined: BTreeSet<(usize, usize)> = drawing
        .arcs
        .iter()
        .filter(|a| a.from < count && a.to < count && a.from != a.to)
        .map(|a| (a.from.min(a.to), a.from.max(a.to)))
        .gather();
    // The usual arc gets the length that it needs.
    let lengths = joined.iter().map(|&(a, b)| (points[a] - points[b]).norm());
    let mut lengths: Vec<f64> = lengths.filter(|l| *l > 1e-6 && l.is_finite()).collect();
    lengths.sort_by(f64::total_cmp);
    let scale = lengths.get(lengths.len() / 2).map_or(1.0, |usual| JOINED / usual);
    let extent = Bounds::of(points.iter().copied());
    let extent = (extent.max - extent.min).amax();
    let scale = if extent * scale > LARGEST { LARGEST / extent } else { scale };
    points.iter_mut().for_each(|p| *p = Point::from(p.coords * scale));
    shorten(&mut points, |p| &mut p.x);
    shorten(&mut points, |p| &mut p.y);
    // Doors that face each other across the corridor stand on its two sides.
    let at = points.clone();
    for (i, vertex) in drawing.vertices.iter().enumerate() {
        let Some(out) = vertex.name_towards.try_normalize(1e-9) else { continue };
        let faces = |j: usize| {
            let other = drawing.vertices[j].name_towards;
            j != i && (at[i] - at[j]).norm() < APART && other.dot(&out) < 1e-9
        };
        if (0..count).any(faces) {
            points[i] += out * (APART / 2.0);
        }
    }
    nudge(&mut points, &joined, drawing);
    spread(&mut points, &joined);
    points
}

/// How far apart two marks stand at least.
fn least(joined: &BTreeSet<(usize, usize)>, i: usize, j: usize) -> f64 {
    if joined.contains(&(i.min(j), i.max(j))) { JOINED } else { APART }
}

/// Moves marks that stand too near each other apart, each half the way, and out of the way of arcs that are not theirs,
/// until all have place or enough was tried.
fn nudge(points: &mut [Point], joined: &BTreeSet<(usize, usize)>, drawing: &CorridorDrawing) {
    /// A little farther than need be, so that few rounds do.
    const BEYOND: f64 = 1.02;
    // Of two in one place each goes to its own side of the corridor, or else by their order.
    let way = |i: usize, j: usize, off: Vector| {
        let sides = drawing.vertices[j].name_towards - drawing.vertices[i].name_towards;
        let turned = Point::from(Vector::new(1.0, 0.3 + (i % 7) as f64));
        let ways = [off, sides, turned.coords];
        ways.into_iter().find_map(|way| way.try_normalize(1e-6)).unwrap_or_else(Vector::x)
    };
    for _ in 0..MOST_NUDGES {
        let mut is_stable = true;
        for i in 0..points.len() {
            for j in i + 1..points.len() {
                let (off, least) = (points[j] - points[i], least(joined, i, j));
                if off.norm() < least {
                    is_stable = false;
                    let by = way(i, j, off) * (BEYOND * least - off.norm()) / 2.0;
                    points[i] -= by;
                    points[j] += by;
                }
            }
        }
        for &(a, b) in joined {
            for i in (0..points.len()).filter(|i| *i != a && *i != b) {
                let near = crate::geometry::nearest_on_segment(points[i], points[a], points[b]);
                let (off, least) = (points[i] - near, RADIUS + 2.0 * LANE);
                if off.norm() < least {
                    is_stable = false;
                    let along = points[b] - points[a];
                    let aside = Vector::new(-along.y, along.x);
                    let by = [off, aside].into_iter().find_map(|way| way.try_normalize(1e-6));
                    let by = by.unwrap_or_else(Vector::y) * (BEYOND * least - off.norm()) / 2.0;
                    points[i] += by;
                    points[a] -= by;
                    points[b] -= by;
                }
            }
        }
        if is_stable {
            break;
        }
    }
}

/// Makes the stretches along one axis in which no vertex stands no longer than [`LONGEST`].
fn shorten(points: &mut [Point], along: fn(&mut Point) -> &mut f64) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    let mut value: Vec<f64> = points.iter_mut().map(|p| *along(p)).collect();
    order.order_by(|&i, &j| value[i].total_cmp(&value[j]));
    let drawn = value.clone();
    let mut by = 0.0;
    for pair in order.windows(2) {
        let gap = drawn[pair[1]] - drawn[pair[0]];
        by += (gap - LONGEST).max(0.0);
        value[pair[1]] = drawn[pair[1]] - by;
    }
    for (p, v) in points.iter_mut().zip(value) {
        *along(p) = v;
    }
}

/// Opens the plane between marks that stand too near each other: all that lies beyond moves away, so that no two that
/// stood apart come nearer.
fn spread(points: &mut [Point], joined: &BTreeSet<(usize, usize)>) {
    // Each opening keeps what is apart; a second look finds what moved with one of a crowd.
    let mut is_stable = false;
    let mut looks = 0;
    while !is_stable && looks < MOST_LOOKS {
        is_stable = true;
        looks += 1;
        let pairs = (0..points.len()).flat_map(|i| (i + 1..points.len()).map(move |j| (i, j)));
        for (i, j) in pairs.collect::<Vec<_>>() {
            let least = least(joined, i, j);
            let off = points[j] - points[i];
            if off.norm() >= least - 1e-9 {
                continue;
            }
            is_stable = false;
            let is_level = off.x.abs() >= off.y.abs();
            let along = |p: &Point| if is_level { p.x } else { p.y };
            let (one, other) = (along(&points[i]), along(&points[j]));
            let missing = least - (one - other).abs();
            // Of two in one place the later one gives way, and all that is beyond with it.
            let (near, far) = if one > other { (j, i) } else { (i, j) };
            let from = along(&points[far]);
            let is_beyond = |n: &usize| *n == far || *n != near && along(&points[*n]) > from + 1e-9;
            let moved: Vec<usize> = (0..points.len()).filter(is_beyond).collect();
            for n in moved {
                if is_level {
                    points[n].x += missing;
                } else {
                    points[n].y += missing;
                }
            }
        }
    }
}

/// A name beside its mark.
struct Name<'d> {
    text: &'d str,
    frame: Bounds,
    mark: Point,
    /// A line leads to it.
    is_far: bool,
}

/// Names beside their marks, on the side of the room where they find place, else around it, else farther away; clear of
/// arcs as far as may be.
fn names<'d>(
    drawing: &'d CorridorDrawing,
    points: &[Point],
    codes: &[Code<'_>],
    letter: f64,
) -> Vec<Name<'d>> {
    let mut labels = Labels::new(letter);
    for at in points {
        labels.take(around(*at, 2.0 * RADIUS + 4.0, 2.0 * RADIUS + 4.0));
    }
    codes.iter().for_each(|code| labels.take(code.frame));
    for (p, q) in drawing.arcs.iter().filter_map(|arc| lane(points, arc)) {
        labels.avoid_line(p, q);
    }
    let mut names = Vec::new();
    for (vertex, at) in drawing.vertices.iter().zip(points) {
        if vertex.name.is_empty() {
            continue;
        }
        let towards = vertex.name_towards.try_normalize(1e-9).unwrap_or(Vector::new(0.0, -1.0));
        let (width, height) = (text_width(&vertex.name, letter, true) + 4.0, letter * 1.25);
        let aside = Vector::new(-towards.y, towards.x);
        let ways = [towards, towards + aside, towards - aside, -towards, aside, -aside];
        let ways = ways.map(|way| way.normalize());
        let frame = |step: u32, way: Vector| {
            let away = RADIUS + 4.0 + 0.5 * letter * f64::from(step);
            let reach = Vector::new(way.x * width, way.y * height) / 2.0;
            around(at + way * away + reach, width, height)
        };
        let spots = |farthest: u32| {
            (0..farthest).flat_map(move |step| ways.into_iter().map(move |way| (step, way)))
        };
        let is_clear = |frame: &Bounds| labels.is_open(frame) && !labels.crosses_line(frame);
        let clear = spots(16).find(|&(step, way)| is_clear(&frame(step, way)));
        let open = || spots(40).find(|&(step, way)| labels.is_open(&frame(step, way)));
        if let Some((step, way)) = clear.or_else(open) {
            let frame = frame(step, way);
            labels.take(frame);
            names.push(Name { text: &vertex.name, frame, mark: *at, is_far: step > 2 });
        }
    }
    names
}

/// A line with a head at its end.
fn arrow(canvas: &mut Canvas, (a, b): (Point, Point), color: &'static str, width: f64) {
    let Some(along) = (b - a).try_normalize(1e-9) else { return };
    let aside = Vector::new(-along.y, along.x) * 3.2;
    let neck = b - along * 7.0;
    canvas.segment(a, neck, Style::line(color, width));
    canvas.polygon(&Polygon::new(vec![b, neck + aside, neck - aside]), Style::fill(color), None);
}

/// Where an arc is drawn: to the right of the way from mark to mark.
fn lane(points: &[Point], arc: &CorridorArc) -> Option<(Point, Point)> {
    let (&a, &b) = (points.get(arc.from)?, points.get(arc.to)?);
    let gap = (b - a).norm();
    if gap < 1e-6 {
        return None;
    }
    let along = (b - a) / gap;
    let aside = Vector::new(along.y, -along.x) * LANE;
    let inset = along * (RADIUS * 0.95).min(gap * 0.4);
    Some((a + aside + inset, b + aside - inset))
}

/// How an arc is drawn: class, colour and width.
fn look(arc: &CorridorArc) -> (&'static str, &'static str, f64) {
    match (arc.on_way, arc.faint) {
        (true, _) => ("way", WAY, 2.6),
        (false, false) => ("arc", ARC, 1.3),
        (false, true) => ("u-turn", FAINT, 1.0),
    }
}

/// The label of an arc beside it.
struct Code<'d> {
    text: &'d str,
    frame: Bounds,
    color: &'static str,
}

/// Labels on the right of their arcs, as near as there is place; clear of other arcs as far as may be.
fn codes<'d>(drawing: &'d CorridorDrawing, points: &[Point], letter: f64) -> Vec<Code<'d>> {
    let mut labels = Labels::new(letter);
    for at in points {
        labels.take(around(*at, 2.0 * RADIUS, 2.0 * RADIUS));
    }
    for (p, q) in drawing.arcs.iter().filter_map(|arc| lane(points, arc)) {
        labels.avoid_line(p, q);
    }
    let mut codes = Vec::new();
    for arc in drawing.arcs.iter().filter(|arc| !arc.label.is_empty()) {
        let Some((p, q)) = lane(points, arc) else { continue };
        let Some(along) = (q - p).try_normalize(1e-9) else { continue };
        let out = Vector::new(along.y, -along.x);
        let (long, tall) = (text_width(&arc.label, letter, false), letter * 1.1);
        let reach = ((out.x * long).abs() + (out.y * tall).abs()) / 2.0;
        let spots = (0..12).flat_map(|step| [0.5, 0.35, 0.65, 0.2, 0.8].map(|share| (step, share)));
        let frame = |(step, share): (i32, f64)| {
            around(p + (q - p) * share + out * (4.0 + reach + f64::from(step) * 5.0), long, tall)
        };
        let mut near = spots.clone().take(15).map(frame);
        let clear = near.find(|f| labels.is_open(f) && !labels.crosses_line(f));
        if let Some(frame) = clear.or_else(|| spots.map(frame).find(|f| labels.is_open(f))) {
            labels.take(frame);
            codes.push(Code { text: &arc.label, frame, color: look(arc).1 });
        }
    }
    codes
}

fn draw_arc(canvas: &mut Canvas, points: &[Point], number: usize, arc: &CorridorArc) {
    let Some(ends) = lane(points, arc) else { return };
    let (class, color, width) = look(arc);
    canvas.mark_of(class, format!("arc-{number}"));
    arrow(canvas, ends, color, width);
}

fn draw_vertex(canvas: &mut Canvas, vertex: &CorridorVertex, at: Point, letter: f64) {
    let id = format!("vertex-{}", vertex.label);
    match vertex.mark {
        CorridorMark::Entrance => {
            canvas.mark_of("entrance", id);
            canvas.circle(at, RADIUS, ENTRANCE);
        }
        CorridorMark::Junction => {
            canvas.mark_of("junction", id);
            canvas.rectangle(around(at, 2.0 * RADIUS, 2.0 * RADIUS), JUNCTION, 4.0);
        }
    }
    canvas.mark("number");
    // Three signs and more are set smaller, to stay within the mark.
    let room = 2.0 * RADIUS - 3.0;
    let size = letter * (room / text_width(&vertex.label, letter, false).max(1.0)).min(1.0);
    canvas.text(at, &vertex.label, Lettering { halo: false, ..Lettering::plain(size, INK) });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(x: f64, y: f64, towards: (f64, f64)) -> CorridorVertex {
        CorridorVertex {
            at: Point::new(x, y),
            mark: CorridorMark::Entrance,
            label: "<1&".into(),
            name: "Помещение\u{1}".into(),
            name_towards: Vector::new(towards.0, towards.1),
        }
    }

    #[test]
    fn odd_input_gives_a_drawing_all_the_same() {
        assert!(corridor_svg(&CorridorDrawing::default()).ends_with("</svg>"));
        let arc = CorridorArc { from: 0, to: 9, label: String::new(), on_way: false, faint: false };
        let vertices = vec![
            vertex(f64::NAN, 0.0, (0.0, 0.0)),
            vertex(0.0, 0.0, (0.0, 0.0)),
            vertex(1e300, 0.0, (0.0, 0.0)),
        ];
        let drawing = CorridorDrawing { vertices, arcs: vec![arc], ..CorridorDrawing::default() };
        let svg = corridor_svg(&drawing);
        assert!(svg.contains("&lt;1&amp;") && !svg.contains("NaN") && !svg.contains('\u{1}'));
    }

    /// A corridor of 100 m with doors every few decimetres here and every ten metres there, many face to face.
    #[test]
    fn no_mark_stands_on_another_and_the_sheet_stays_small() {
        let stations = [0.0, 0.3, 0.6, 10.0, 10.0, 10.1, 40.0, 40.0, 41.0, 100.0];
        for turn in [0.0_f64, 0.4, 1.0] {
            let (sin, cos) = turn.sin_cos();
            let at = |n: usize, x: f64| {
                let out = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
                vertex(x * cos, x * sin, (-sin * out, cos * out))
            };
            let vertices: Vec<_> = stations.iter().enumerate().map(|(n, x)| at(n, *x)).collect();
            let arcs = (1..vertices.len()).flat_map(|n| [(n - 1, n), (n, n - 1)]);
            let arcs = arcs.map(|(from, to)| CorridorArc {
                from,
                to,
                label: "11".into(),
                on_way: false,
                faint: false,
            });
            let drawing =
                CorridorDrawing { arcs: arcs.collect(), vertices, ..CorridorDrawing::default() };
            let points = placed(&drawing);
            for (i, p) in points.iter().enumerate() {
                for q in &points[i + 1..] {
                    assert!((p - q).norm() >= APART - 1e-6, "{points:?}");
                }
            }
            let size = Bounds::of(points.iter().copied());
            let longest = (size.max - size.min).amax();
            assert!(longest < 1400.0, "{longest}");
        }
    }
}
