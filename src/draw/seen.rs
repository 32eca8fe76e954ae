//! What was seen, as segments with their true and cut ends (paper 3, figs. 2 and 3).
//!
//! The caller gives plain lines and words; nothing here knows how segments are found.
//!
//! **Invariant.** The sheet holds all that is drawn, and pens are as thick on it whatever its scale.

use crate::geometry::Bounds;
use crate::units::{Point, Vector};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;

/// A segment as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenSegment {
    pub from: Point,
    pub to: Point,
    /// Which ends are the thing's own.
    pub is_true: [bool; 2],
    /// Things and parts have colours by number; none is drawn in ink.
    pub group: Option<usize>,
    /// As it was before, in a weaker line.
    pub is_before: bool,
}

/// What the legend explains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeenSign {
    Return,
    TrueEnd,
    CutEnd,
    Observer,
    Before,
    Moved,
}

/// Everything that the drawing shows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SeenDrawing {
    pub title: String,
    pub segments: Vec<SeenSegment>,
    /// Returns of the sensor.
    pub returns: Vec<Point>,
    /// Where the observer stands, looking along +x.
    pub observer: Option<Point>,
    /// From where to where something moved.
    pub moves: Vec<(Point, Point)>,
    /// Units of the drawing that the scale's name stands for, and the name: 100 and «1 м».
    pub scale: Option<(f64, String)>,
    /// What the signs mean; those that are not drawn are left out.
    pub signs: Vec<(SeenSign, String)>,
    /// Lines below the drawing.
    pub notes: Vec<String>,
}

/// Width of the drawn part of the sheet.
const WIDE: f64 = 1100.0;
const TALL: f64 = 900.0;
const ROW: f64 = 22.0;
const LETTER: f64 = 13.0;
const INK: &str = "#22303c";
const TRUE: Style = Style::fill("#c0392b");
const CUT: Style = Style::fill("#ffffff").outlined("#22303c", 1.2);
const RETURN: Style = Style::fill("#9fb4c4");
const OBSERVER: Style = Style::fill("#2c5f8a");
const BEFORE: Style = Style::line("#b6bec4", 1.4).dashed(5.0, 4.0);
const MOVED: Style = Style::line("#c0392b", 1.4);
const GROUPS: [&str; 10] = [
    "#1f77b4", "#d9730d", "#2a8f3c", "#b3261e", "#7b52ab", "#7a4b3a", "#c2529b", "#5c6770",
    "#8f8b14", "#0e8ea3",
];

/// The drawing as an SVG document.
#[must_use]
pub fn seen_svg(drawing: &SeenDrawing) -> String {
    let sheet = Sheet::of(drawing);
    let signs: Vec<&(SeenSign, String)> =
        drawing.signs.iter().filter(|(sign, _)| is_drawn(drawing, *sign)).collect();
    let rows = signs.len().div_ceil(3) + drawing.notes.len() + usize::from(drawing.scale.is_some());
    let title = text_width(&drawing.title, 17.0, true);
    let longest = drawing.notes.iter().map(|n| text_width(n, LETTER, false)).fold(title, f64::max);
    let bounds = Bounds {
        min: Point::new(-20.0, -30.0 - ROW * rows as f64),
        max: Point::new(sheet.width.max(longest).max(900.0) + 20.0, sheet.height + 50.0),
    };
    let mut canvas = Canvas::new(bounds).wide(bounds.max.x - bounds.min.x);
    let start = |style: Lettering| Lettering { anchor: Anchor::Start, halo: false, ..style };
    canvas.mark("heading");
    canvas.text(
        Point::new(0.0, sheet.height + 28.0),
        &drawing.title,
        start(Lettering::bold(17.0, INK)),
    );
    canvas.mark("return");
    drawing.returns.iter().for_each(|p| canvas.circle(sheet.at(*p), 1.6, RETURN));
    draw_segments(&mut canvas, &sheet, drawing);
    canvas.mark("moved");
    for (from, to) in &drawing.moves {
        arrow(&mut canvas, sheet.at(*from), sheet.at(*to));
    }
    if let Some(eye) = drawing.observer {
        canvas.mark("observer");
        observer(&mut canvas, sheet.at(eye));
    }
    let mut y = -20.0;
    if let Some((length, name)) = &drawing.scale {
        canvas.mark("scale");
        let wide = length * sheet.factor;
        let ends = (Point::new(0.0, y), Point::new(wide, y));
        canvas.segment(ends.0, ends.1, Style::line(INK, 1.6));
        for p in [ends.0, ends.1] {
            let tick = Vector::new(0.0, 5.0);
            canvas.segment(p - tick, p + tick, Style::line(INK, 1.6));
        }
        let beside = Point::new(wide + 10.0, y);
        canvas.text(beside, name, start(Lettering::plain(LETTER, INK)));
        y -= ROW;
    }
    for row in signs.chunks(3) {
        for (k, (sign, text)) in row.iter().enumerate() {
            let at = Point::new(300.0 * k as f64, y);
            draw_sign(&mut canvas, *sign, at);
            canvas.mark("key");
            let beside = at + Vector::new(40.0, 0.0);
            canvas.text(beside, text, start(Lettering::plain(LETTER, INK)));
        }
        y -= ROW;
    }
    canvas.mark("note");
    for note in &drawing.notes {
        canvas.text(Point::new(0.0, y), note, start(Lettering::plain(LETTER, "#3d4a55")));
        y -= ROW;
    }
    canvas.into_svg(&drawing.title)
}

/// Where the drawing's coordinates lie on the sheet.
struct Sheet {
    low: Point,
    factor: f64,
    width: f64,
    height: f64,
}

impl Sheet {
    fn of(drawing: &SeenDrawing) -> Self {
        let ends = drawing.segments.iter().flat_map(|s| [s.from, s.to]);
        let moves = drawing.moves.iter().flat_map(|&(a, b)| [a, b]);
        let all = ends.chain(drawing.returns.iter().copied()).chain(moves).chain(drawing.observer);
        let mut all = all.filter(|p| p.x.is_finite() && p.y.is_finite()).peekable();
        if all.peek().is_none() {
            return Self { low: Point::origin(), factor: 1.0, width: WIDE, height: 200.0 };
        }
        let bounds = Bounds::of(all);
        let (wide, tall) = (bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let factor = (WIDE / wide.max(1e-6)).min(TALL / tall.max(1e-6)).min(1e6);
        Self { low: bounds.min, factor, width: wide * factor, height: tall * factor }
    }

    fn at(&self, p: Point) -> Point {
        Point::from((p - self.low) * self.factor)
    }
}

fn draw_segments(canvas: &mut Canvas, sheet: &Sheet, drawing: &SeenDrawing) {
    canvas.mark("before");
    for s in drawing.segments.iter().filter(|s| s.is_before) {
        canvas.segment(sheet.at(s.from), sheet.at(s.to), BEFORE);
    }
    canvas.mark("segment");
    let now = || drawing.segments.iter().filter(|s| !s.is_before);
    for s in now() {
        let color = s.group.map_or(INK, |group| GROUPS[group % GROUPS.len()]);
        canvas.stroke(sheet.at(s.from), sheet.at(s.to), color, 2.2);
    }
    // Of a crowd of ends the marks would hide the lines.
    let size = if now().count() > 300 { 2.0 } else { 3.4 };
    for s in now() {
        for (end, is_true) in [(s.from, s.is_true[0]), (s.to, s.is_true[1])] {
            canvas.mark(if is_true { "end true" } else { "end cut" });
            canvas.circle(sheet.at(end), size, if is_true { TRUE } else { CUT });
        }
    }
}

fn is_drawn(drawing: &SeenDrawing, sign: SeenSign) -> bool {
    let any_end =
        |wanted| drawing.segments.iter().any(|s| !s.is_before && s.is_true.contains(&wanted));
    match sign {
        SeenSign::Return => !drawing.returns.is_empty(),
        SeenSign::TrueEnd => any_end(true),
        SeenSign::CutEnd => any_end(false),
        SeenSign::Observer => drawing.observer.is_some(),
        SeenSign::Before => drawing.segments.iter().any(|s| s.is_before),
        SeenSign::Moved => !drawing.moves.is_empty(),
    }
}

fn draw_sign(canvas: &mut Canvas, sign: SeenSign, at: Point) {
    let middle = at + Vector::new(16.0, 0.0);
    let (left, right) = (at + Vector::new(2.0, 0.0), at + Vector::new(30.0, 0.0));
    match sign {
        SeenSign::Return => {
            canvas.mark("key return");
            canvas.circle(middle, 2.4, RETURN);
        }
        SeenSign::TrueEnd => {
            canvas.mark("key true");
            canvas.segment(left, middle, Style::line(INK, 2.2));
            canvas.circle(middle, 3.4, TRUE);
        }
        SeenSign::CutEnd => {
            canvas.mark("key cut");
            canvas.segment(left, middle, Style::line(INK, 2.2));
            canvas.circle(middle, 3.4, CUT);
        }
        SeenSign::Observer => {
            canvas.mark("key observer");
            observer(canvas, middle);
        }
        SeenSign::Before => {
            canvas.mark("key before");
            canvas.segment(left, right, BEFORE);
        }
        SeenSign::Moved => {
            canvas.mark("key moved");
            arrow(canvas, left, right);
        }
    }
}

fn observer(canvas: &mut Canvas, at: Point) {
    let corner = |x: f64, y: f64| at + Vector::new(x, y);
    let ring = [corner(11.0, 0.0), corner(-7.0, 7.0), corner(-3.0, 0.0), corner(-7.0, -7.0)];
    canvas.polygons([ring.as_slice()], OBSERVER, None);
}

fn arrow(canvas: &mut Canvas, from: Point, to: Point) {
    canvas.segment(from, to, MOVED);
    let Some(along) = (to - from).try_normalize(1e-9) else { return };
    let across = Vector::new(-along.y, along.x);
    let back = to - along * 8.0;
    let ring = [to, back + across * 3.5, back - across * 3.5];
    canvas.polygons([ring.as_slice()], Style::fill("#c0392b"), None);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_seen_is_an_empty_sheet() {
        let svg =
            seen_svg(&SeenDrawing { title: "пусто".to_owned(), ..SeenDrawing::default() });
        assert!(svg.contains("пусто") && !svg.contains("NaN"));
    }

    #[test]
    fn only_what_is_drawn_stands_in_the_legend() {
        let segment = SeenSegment {
            from: Point::new(0.0, 0.0),
            to: Point::new(100.0, 50.0),
            is_true: [true, true],
            group: None,
            is_before: false,
        };
        let word = |sign, text: &str| (sign, text.to_owned());
        let svg = seen_svg(&SeenDrawing {
            segments: vec![segment],
            signs: vec![word(SeenSign::TrueEnd, "свой конец"), word(SeenSign::CutEnd, "обрез")],
            ..SeenDrawing::default()
        });
        assert!(svg.contains("свой конец") && !svg.contains("обрез"));
    }
}
