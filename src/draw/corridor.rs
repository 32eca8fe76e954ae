//! A schematic drawing of a corridor road graph, as SVG: vertices, arcs both ways, labels (paper 4, figs. 2-3).
//!
//! The caller gives plain points and texts; nothing here knows how a road graph is made.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::units::{Point, Vector};

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
    /// Lines below the drawing: the legend, the commands.
    pub notes: Vec<String>,
}

const MARGIN: f64 = 70.0;
const RADIUS: f64 = 15.0;
const LINE: f64 = 20.0;
/// Arcs keep to the right of the line between their vertices by this much.
const LANE: f64 = 6.0;
/// The shortest distance between two vertices.
const SPACING: f64 = 92.0;
const LARGEST: f64 = 4000.0;

/// The drawing as an SVG document.
#[must_use]
pub fn corridor_svg(drawing: &CorridorDrawing) -> String {
    let points = placed(drawing);
    let (width, height) =
        points.iter().fold((0.0_f64, 0.0_f64), |(w, h), p| (w.max(p.x), h.max(p.y)));
    let longest = drawing.notes.iter().chain([&drawing.title]).map(|n| n.chars().count()).max();
    let text_width = longest.unwrap_or(0) as f64 * 7.6 + 60.0;
    let width = (width + MARGIN).max(text_width);
    let top = height + MARGIN + 4.0;
    let height = top + LINE * drawing.notes.len() as f64 + 12.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"DejaVu Sans, Arial, sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
         <defs>{}{}{}</defs>\n",
        arrow("a", "#5b6770"),
        arrow("w", "#c0392b"),
        arrow("f", "#aab4bb"),
    );
    text(
        &mut svg,
        30.0,
        30.0,
        "font-size=\"17\" font-weight=\"bold\" fill=\"#22303c\"",
        &drawing.title,
    );
    for (a, b) in corridors(drawing) {
        let (p, q) = (points[a], points[b]);
        let _ = writeln!(
            svg,
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#edf0f2\" stroke-width=\"44\" stroke-linecap=\"round\"/>",
            p.x, p.y, q.x, q.y
        );
    }
    for arc in &drawing.arcs {
        draw_arc(&mut svg, &points, arc);
    }
    for (vertex, at) in drawing.vertices.iter().zip(&points) {
        draw_vertex(&mut svg, vertex, *at);
    }
    for (line, note) in drawing.notes.iter().enumerate() {
        let y = top + LINE * line as f64;
        text(&mut svg, 30.0, y, "font-size=\"13\" fill=\"#3d4a55\"", note);
    }
    svg.push_str("</svg>\n");
    svg
}

/// Pairs of vertices that are joined both ways: there runs a corridor. Each pair once.
fn corridors(drawing: &CorridorDrawing) -> Vec<(usize, usize)> {
    let known = |i: usize| i < drawing.vertices.len();
    let arcs = drawing.arcs.iter().filter(|a| !a.faint && known(a.from) && known(a.to));
    let ways: BTreeSet<_> = arcs.map(|a| (a.from, a.to)).collect();
    ways.iter().copied().filter(|&(a, b)| a < b && ways.contains(&(b, a))).collect()
}

/// Points of the page: scaled so that the nearest vertices stand apart, +y downwards.
fn placed(drawing: &CorridorDrawing) -> Vec<Point> {
    let finite = |p: Point| if p.x.is_finite() && p.y.is_finite() { p } else { Point::origin() };
    let points: Vec<Point> = drawing.vertices.iter().map(|v| finite(v.at)).collect();
    let mut nearest = f64::INFINITY;
    for (i, p) in points.iter().enumerate() {
        for q in &points[i + 1..] {
            let gap = (p - q).norm();
            if gap > 1e-6 {
                nearest = nearest.min(gap);
            }
        }
    }
    let bounds = crate::geometry::Bounds::of(points.iter().copied());
    let extent = (bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y).max(1e-6);
    let scale = (SPACING / nearest.min(extent)).min(LARGEST / extent);
    points
        .iter()
        .map(|p| {
            let x = (p.x - bounds.min.x) * scale + MARGIN;
            let y = (bounds.max.y - p.y) * scale + MARGIN + 26.0;
            Point::new(x, y)
        })
        .collect()
}

fn arrow(id: &str, colour: &str) -> String {
    format!(
        "<marker id=\"{id}\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"8\" markerHeight=\"8\" markerUnits=\"userSpaceOnUse\" orient=\"auto\"><path d=\"M0,0.8 L8,4 L0,7.2 z\" fill=\"{colour}\"/></marker>"
    )
}

fn draw_arc(svg: &mut String, points: &[Point], arc: &CorridorArc) {
    let (Some(&a), Some(&b)) = (points.get(arc.from), points.get(arc.to)) else { return };
    let gap = (b - a).norm();
    if gap < 1e-6 {
        return;
    }
    let along = (b - a) / gap;
    // To the right of the way, on a page whose y runs down.
    let aside = Vector::new(-along.y, along.x) * LANE;
    let inset = along * (RADIUS * 0.95).min(gap * 0.4);
    let (p, q) = (a + aside + inset, b + aside - inset);
    let (colour, width, marker) = match (arc.on_way, arc.faint) {
        (true, _) => ("#c0392b", 2.6, "w"),
        (false, false) => ("#5b6770", 1.3, "a"),
        (false, true) => ("#aab4bb", 1.0, "f"),
    };
    let _ = writeln!(
        svg,
        "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{colour}\" stroke-width=\"{width}\" marker-end=\"url(#{marker})\"/>",
        p.x, p.y, q.x, q.y
    );
    let middle = nalgebra::center(&p, &q) + aside * 1.45;
    let style =
        format!("font-size=\"10.5\" text-anchor=\"middle\" dy=\"0.35em\" fill=\"{colour}\"");
    text(svg, middle.x, middle.y, &style, &arc.label);
}

fn draw_vertex(svg: &mut String, vertex: &CorridorVertex, at: Point) {
    let (x, y) = (at.x, at.y);
    let shape = match vertex.mark {
        CorridorMark::Entrance => format!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{RADIUS}\" fill=\"#ffffff\" stroke=\"#2c5f8a\" stroke-width=\"2\"/>"
        ),
        CorridorMark::Junction => format!(
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{d}\" height=\"{d}\" rx=\"4\" fill=\"#fff3d6\" stroke=\"#b9770e\" stroke-width=\"2\"/>",
            x - RADIUS,
            y - RADIUS,
            d = 2.0 * RADIUS
        ),
    };
    let _ = writeln!(svg, "{shape}");
    let style = "font-size=\"13\" text-anchor=\"middle\" dy=\"0.35em\" fill=\"#22303c\"";
    text(svg, x, y, style, &vertex.label);
    let towards = vertex.name_towards;
    let unit = if towards.norm() > 1e-9 { towards.normalize() } else { Vector::new(0.0, -1.0) };
    let chars = vertex.name.chars().count() as f64;
    // A name needs more room sideways than up and down.
    let reach = RADIUS + 15.0 + unit.x.abs() * (chars * 4.0 - 2.0).max(0.0);
    let style = "font-size=\"13\" font-weight=\"bold\" text-anchor=\"middle\" dy=\"0.35em\" fill=\"#2c5f8a\"";
    text(svg, x + unit.x * reach, y - unit.y * reach, style, &vertex.name);
}

fn text(svg: &mut String, x: f64, y: f64, style: &str, content: &str) {
    if content.is_empty() {
        return;
    }
    let mut safe = String::with_capacity(content.len());
    for c in content.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" {style}>{safe}</text>");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odd_input_gives_a_drawing_all_the_same() {
        assert!(corridor_svg(&CorridorDrawing::default()).ends_with("</svg>\n"));
        let vertex = |x: f64| CorridorVertex {
            at: Point::new(x, 0.0),
            mark: CorridorMark::Entrance,
            label: "<1&".into(),
            name: "\u{1}".into(),
            name_towards: Vector::zeros(),
        };
        let arc = CorridorArc { from: 0, to: 9, label: String::new(), on_way: false, faint: false };
        let vertices = vec![vertex(f64::NAN), vertex(0.0), vertex(1e300)];
        let drawing = CorridorDrawing { vertices, arcs: vec![arc], ..CorridorDrawing::default() };
        let svg = corridor_svg(&drawing);
        assert!(svg.contains("&lt;1&amp;") && !svg.contains("NaN") && !svg.contains('\u{1}'));
    }
}
