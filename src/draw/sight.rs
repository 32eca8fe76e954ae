//! The operative model (paper 1, section 9): the floor that one scan shows, cut into Passframes, with what bounds it.
//!
//! The caller gives plain geometry and words; nothing here knows how it was seen.

use crate::geometry::{Bounds, Polygon, Region};
use crate::units::{Language, Point, Pose, Vector};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;
use super::legend::scale_bar;

/// How a stretch of the outline is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SightLine {
    /// A face that the Map has there too.
    Known,
    /// A face that it has not.
    Unknown,
    /// Sight ends: hidden, or out of reach.
    End,
}

/// Everything that the drawing shows.
#[derive(Debug, Clone, PartialEq)]
pub struct SightDrawing {
    pub title: String,
    /// Convex cells with the short text that stands in them.
    pub passframes: Vec<(Polygon, String)>,
    pub dead_zones: Vec<Region>,
    pub outline: Vec<(Point, Point, SightLine)>,
    /// What people call what stands at a place.
    pub names: Vec<(Point, String)>,
    pub robot: Pose,
    pub radius: f64,
    /// What the lines mean, and Passframes and dead zones.
    pub legend: Vec<(SightSign, String)>,
    pub language: Language,
}

/// What the legend explains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SightSign {
    Passframe,
    DeadZone,
    Line(SightLine),
}

const INK: &str = "#2b2a27";
const PASSFRAME: Style = Style::fill("#e4f1e3").outlined("#69a869", 0.9);
const DEAD_ZONE: Style = Style::fill("#e8a39b").faint(0.75);
const KNOWN: Style = Style::line("#2b2a27", 3.0);
const UNKNOWN: Style = Style::line("#c0392b", 3.4);
const END: Style = Style::line("#7f8c96", 1.6).dashed(6.0, 5.0);
const ROBOT: Style = Style::fill("#9cc2f2").outlined("#1f5fbf", 2.0).faint(0.85);
const LETTER: f64 = 12.0;
const ROW: f64 = 20.0;

fn line_style(line: SightLine) -> Style {
    match line {
        SightLine::Known => KNOWN,
        SightLine::Unknown => UNKNOWN,
        SightLine::End => END,
    }
}

/// The drawing as an SVG document.
#[must_use]
pub fn sight_svg(drawing: &SightDrawing) -> String {
    let ends = drawing.outline.iter().flat_map(|&(a, b, _)| [a, b]);
    let whole = Bounds::of(ends.chain([drawing.robot.at]));
    let size = whole.max - whole.min;
    let pen = (size.amax() / 1000.0).max(0.35).sqrt();
    let title = text_width(&drawing.title, 17.0, true) * pen;
    let wide = drawing.legend.iter().map(|(_, text)| text_width(text, LETTER, false));
    let wide = (wide.fold(0.0, f64::max) + 60.0) * pen;
    let mut sheet = whole.grown(34.0 * pen);
    sheet.max.y += 30.0 * pen;
    sheet.min.y -= ROW * pen * (drawing.legend.len() as f64 + 2.0);
    sheet.max.x = sheet.max.x.max(sheet.min.x + title.max(wide) + 40.0 * pen);
    let width = sheet.max.x - sheet.min.x;
    let mut canvas = Canvas::new(sheet).wide((width / pen).clamp(600.0, 4000.0));
    canvas.mark("passframe");
    for (cell, text) in &drawing.passframes {
        canvas.polygon(cell, PASSFRAME.thick(pen), Some(text));
    }
    canvas.mark("dead-zone");
    for zone in &drawing.dead_zones {
        canvas.polygons(zone.contours().map(|c| c.corners.as_slice()), DEAD_ZONE, None);
    }
    canvas.mark("sight");
    for &(a, b, line) in &drawing.outline {
        canvas.segment(a, b, line_style(line).thick(pen));
    }
    robot(&mut canvas, drawing, pen);
    canvas.mark("passframe-name");
    for (cell, text) in &drawing.passframes {
        let wide = text_width(text, LETTER, false) * pen;
        let bounds = cell.bounds();
        // In a sliver its own name would hide it.
        if bounds.max.x - bounds.min.x > wide && bounds.max.y - bounds.min.y > 2.0 * LETTER * pen {
            let lettering = Lettering::plain(LETTER * pen, "#3f7a3f");
            canvas.text(cell.centroid(), text, lettering);
        }
    }
    names(&mut canvas, drawing, &whole, pen);
    let start = |style: Lettering| Lettering { anchor: Anchor::Start, halo: false, ..style };
    canvas.mark("heading");
    let above = Point::new(whole.min.x, whole.max.y + 40.0 * pen);
    canvas.text(above, &drawing.title, start(Lettering::bold(17.0 * pen, INK)));
    let mut at = Point::new(whole.min.x, whole.min.y - 30.0 * pen);
    scale_bar(&mut canvas, at, pen, drawing.language);
    at.y -= 1.6 * ROW * pen;
    for (sign, text) in &drawing.legend {
        canvas.mark("key");
        let box_of = |style: Style, canvas: &mut Canvas| {
            let half = Vector::new(0.0, 6.0 * pen);
            let bounds = Bounds { min: at - half, max: at + half + Vector::new(26.0 * pen, 0.0) };
            canvas.rectangle(bounds, style, 0.0);
        };
        match sign {
            SightSign::Passframe => box_of(PASSFRAME.thick(pen), &mut canvas),
            SightSign::DeadZone => box_of(DEAD_ZONE, &mut canvas),
            SightSign::Line(line) => {
                let end = at + Vector::new(26.0 * pen, 0.0);
                canvas.segment(at, end, line_style(*line).thick(pen));
            }
        }
        let beside = at + Vector::new(36.0 * pen, 0.0);
        canvas.text(beside, text, start(Lettering::plain(LETTER * pen, INK)));
        at.y -= ROW * pen;
    }
    canvas.into_svg(&drawing.title)
}

/// Names beside what they are of, as far as none lies on another.
fn names(canvas: &mut Canvas, drawing: &SightDrawing, whole: &Bounds, pen: f64) {
    canvas.mark("name");
    let mut taken: Vec<Bounds> = Vec::new();
    for (at, text) in &drawing.names {
        let half = Vector::new(text_width(text, LETTER, false) / 2.0 + 2.0, LETTER * 0.7) * pen;
        let low = whole.min + half;
        let high = whole.max - half;
        let middle = Point::new(
            at.x.clamp(low.x.min(high.x), high.x.max(low.x)),
            at.y.clamp(low.y.min(high.y), high.y.max(low.y)),
        );
        let own = Bounds { min: middle - half, max: middle + half };
        if taken.iter().any(|other| other.meets(&own)) {
            continue;
        }
        canvas.text(middle, text, Lettering::plain(LETTER * pen, INK));
        taken.push(own);
    }
}

fn robot(canvas: &mut Canvas, drawing: &SightDrawing, pen: f64) {
    canvas.mark("robot");
    let Pose { at, heading } = drawing.robot;
    let (sin, cos) = heading.sin_cos();
    canvas.circle(at, drawing.radius, ROBOT.thick(pen));
    let nose = at + Vector::new(cos, sin) * drawing.radius;
    canvas.segment(at, nose, Style::line("#1f5fbf", 2.5).thick(pen));
}

/// Two drawings of this program side by side, as one document.
#[must_use]
pub fn beside(left: &str, right: &str) -> String {
    let number = |svg: &str, name: &str| {
        let head = svg.split('>').next().unwrap_or_default();
        let value = head.split(&format!(" {name}=\"")).nth(1)?.split('"').next()?;
        value.parse::<f64>().ok()
    };
    let size =
        |svg: &str| (number(svg, "width").unwrap_or(800.0), number(svg, "height").unwrap_or(600.0));
    let (one, other) = (size(left), size(right));
    // Both as high as the higher one.
    let height = one.1.max(other.1);
    let scaled = |(width, tall): (f64, f64)| width * height / tall.max(1.0);
    let placed = |svg: &str, x: f64, width: f64| {
        let body = svg.split_once("<svg").map_or("", |(_, rest)| rest);
        let (head, rest) = body.split_once('>').unwrap_or(("", ""));
        let kept: Vec<&str> = head
            .split_inclusive('"')
            .collect::<Vec<_>>()
            .chunks(2)
            .filter(|pair| {
                let name = pair[0].trim_start().trim_end_matches("=\"");
                pair.len() == 2 && name != "width" && name != "height"
            })
            .flat_map(|pair| pair.iter().copied())
            .collect();
        format!(
            "<svg x=\"{x:.1}\" y=\"0\" width=\"{width:.1}\" height=\"{height:.1}\"{}>{rest}",
            kept.concat()
        )
    };
    let (first, second) = (scaled(one), scaled(other));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.1}\" height=\"{height:.1}\" viewBox=\"0 0 {:.1} {height:.1}\">\n{}\n{}\n</svg>",
        first + second,
        first + second,
        placed(left, 0.0, first),
        placed(right, first, second),
    )
}
