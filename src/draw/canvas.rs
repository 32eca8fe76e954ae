//! A sheet with the Map's coordinates: cm, y up.

use std::collections::HashSet;

use svg::node::element::{
    Circle, Group, Line, Path, Rectangle, Style as StyleSheet, Text, Title, path::Data,
};
use svg::{Document, Node};

use crate::geometry::{Bounds, Polygon};
use crate::units::Point;

use super::font::{self, FAMILY};

/// How a shape is filled and outlined. `None` is not painted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    pub fill: Option<&'static str>,
    pub stroke: Option<&'static str>,
    /// cm on the sheet.
    pub width: f64,
    /// Lengths of dash and gap, cm on the sheet.
    pub dash: Option<(f64, f64)>,
    pub opacity: f64,
}

impl Style {
    pub(super) const fn fill(color: &'static str) -> Self {
        Self { fill: Some(color), stroke: None, width: 0.0, dash: None, opacity: 1.0 }
    }

    pub(super) const fn line(color: &'static str, width: f64) -> Self {
        Self { fill: None, stroke: Some(color), width, dash: None, opacity: 1.0 }
    }

    pub(super) const fn outlined(mut self, color: &'static str, width: f64) -> Self {
        self.stroke = Some(color);
        self.width = width;
        self
    }

    pub(super) const fn dashed(mut self, dash: f64, gap: f64) -> Self {
        self.dash = Some((dash, gap));
        self
    }

    /// With lines and dashes so many times as large: for sheets of large buildings.
    pub(super) fn thick(mut self, pen: f64) -> Self {
        self.width *= pen;
        self.dash = self.dash.map(|(dash, gap)| (dash * pen, gap * pen));
        self
    }

    pub(super) const fn faint(mut self, opacity: f64) -> Self {
        self.opacity = opacity;
        self
    }

    fn apply<N: Node>(&self, node: &mut N) {
        node.assign("fill", self.fill.unwrap_or("none"));
        if let Some(stroke) = self.stroke {
            node.assign("stroke", stroke);
            node.assign("stroke-width", number(self.width));
            node.assign("stroke-linejoin", "round");
            node.assign("stroke-linecap", "round");
        }
        if let Some((dash, gap)) = self.dash {
            node.assign("stroke-dasharray", format!("{} {}", number(dash), number(gap)));
        }
        if self.opacity < 1.0 {
            node.assign("opacity", number(self.opacity));
        }
    }
}

/// Where a text stands against its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
}

/// How a text looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lettering {
    /// Of the font, cm on the sheet.
    pub size: f64,
    pub color: &'static str,
    pub bold: bool,
    pub anchor: Anchor,
    /// A light rim that parts the letters from the lines below them.
    pub halo: bool,
    /// Degrees counter-clockwise from the sheet's x.
    pub turn: f64,
}

impl Lettering {
    pub(super) const fn plain(size: f64, color: &'static str) -> Self {
        Self { size, color, bold: false, anchor: Anchor::Middle, halo: true, turn: 0.0 }
    }

    pub(super) const fn bold(size: f64, color: &'static str) -> Self {
        Self { bold: true, ..Self::plain(size, color) }
    }
}

/// Collects shapes; [`Canvas::into_svg`] frames them.
pub(super) struct Canvas {
    bounds: Bounds,
    /// Of the picture, as it is shown unscaled.
    pixels: f64,
    nodes: Group,
    /// What the next shapes show: the class for style sheets and pages.
    class: &'static str,
    /// Of the record that they show.
    of: Option<String>,
    ids: HashSet<String>,
}

impl Canvas {
    /// A sheet that shows `bounds` of the Map.
    pub(super) fn new(bounds: Bounds) -> Self {
        let width = bounds.max.x - bounds.min.x;
        Self {
            bounds,
            pixels: width.clamp(600.0, 1600.0),
            nodes: Group::new().set("font-family", format!("{FAMILY}, Arial, sans-serif")),
            class: "",
            of: None,
            ids: HashSet::new(),
        }
    }

    /// The next shapes are of this class, and show no record of the Map.
    pub(super) fn mark(&mut self, class: &'static str) {
        (self.class, self.of) = (class, None);
    }

    /// The next shapes are of this class and show this record: the first bears its id, `thing-17`, further ones name it
    /// as `data-of`, since an id stands once in a document.
    pub(super) fn mark_of(&mut self, class: &'static str, record: String) {
        (self.class, self.of) = (class, Some(record));
    }

    fn add<N: Node>(&mut self, mut node: N) {
        if !self.class.is_empty() {
            node.assign("class", self.class);
        }
        if let Some(of) = &self.of {
            let name = if self.ids.insert(of.clone()) { "id" } else { "data-of" };
            node.assign(name, of.as_str());
        }
        self.nodes.append(node);
    }

    /// So many pixels wide, whatever the sheet's own size.
    pub(super) fn wide(mut self, pixels: f64) -> Self {
        self.pixels = pixels;
        self
    }

    fn at(&self, p: Point) -> (f64, f64) {
        (round(p.x - self.bounds.min.x), round(self.bounds.max.y - p.y))
    }

    pub(super) fn polygons<'a>(
        &mut self,
        rings: impl IntoIterator<Item = &'a [Point]>,
        style: Style,
        title: Option<&str>,
    ) {
        let data = rings.into_iter().fold(Data::new(), |data, ring| self.trace(data, ring).close());
        let mut path = Path::new().set("d", data).set("fill-rule", "evenodd");
        style.apply(&mut path);
        if let Some(title) = title {
            path = path.add(Title::new(title));
        }
        self.add(path);
    }

    pub(super) fn polygon(&mut self, polygon: &Polygon, style: Style, title: Option<&str>) {
        self.polygons([polygon.corners.as_slice()], style, title);
    }

    pub(super) fn polyline(&mut self, points: &[Point], style: Style) {
        let mut path = Path::new().set("d", self.trace(Data::new(), points));
        style.apply(&mut path);
        self.add(path);
    }

    fn trace(&self, data: Data, points: &[Point]) -> Data {
        points.iter().enumerate().fold(data, |data, (i, &p)| {
            if i == 0 { data.move_to(self.at(p)) } else { data.line_to(self.at(p)) }
        })
    }

    /// A polygon of any colour, closed to its neighbours: a hair's breadth hides the seams of cut faces.
    pub(super) fn shade(&mut self, corners: &[Point], color: &str) {
        let path = Path::new()
            .set("d", self.trace(Data::new(), corners).close())
            .set("fill", color)
            .set("stroke", color)
            .set("stroke-width", "1");
        self.add(path);
    }

    /// A line of any colour.
    pub(super) fn stroke(&mut self, a: Point, b: Point, color: &str, width: f64) {
        let ((x1, y1), (x2, y2)) = (self.at(a), self.at(b));
        let line = Line::new().set("x1", x1).set("y1", y1).set("x2", x2).set("y2", y2);
        self.add(
            line.set("stroke", color)
                .set("stroke-width", number(width))
                .set("stroke-linecap", "round"),
        );
    }

    pub(super) fn segment(&mut self, a: Point, b: Point, style: Style) {
        let ((x1, y1), (x2, y2)) = (self.at(a), self.at(b));
        let mut line = Line::new().set("x1", x1).set("y1", y1).set("x2", x2).set("y2", y2);
        style.apply(&mut line);
        self.add(line);
    }

    pub(super) fn circle(&mut self, center: Point, radius: f64, style: Style) {
        let (x, y) = self.at(center);
        let mut circle = Circle::new().set("cx", x).set("cy", y).set("r", number(radius));
        style.apply(&mut circle);
        self.add(circle);
    }

    pub(super) fn rectangle(&mut self, bounds: Bounds, style: Style, rounding: f64) {
        let (x, y) = self.at(Point::new(bounds.min.x, bounds.max.y));
        let mut rectangle = Rectangle::new()
            .set("x", x)
            .set("y", y)
            .set("width", number(bounds.max.x - bounds.min.x))
            .set("height", number(bounds.max.y - bounds.min.y))
            .set("rx", number(rounding));
        style.apply(&mut rectangle);
        self.add(rectangle);
    }

    /// A line of text at the height of `p`.
    pub(super) fn text(&mut self, p: Point, text: &str, lettering: Lettering) {
        let (x, y) = self.at(p);
        let size = lettering.size;
        let anchor = if lettering.anchor == Anchor::Middle { "middle" } else { "start" };
        let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let mut node = Text::new(text)
            .set("x", x)
            // The baseline lies about a third of the size below the middle of the letters.
            .set("y", round(y + size * 0.36))
            .set("font-size", number(size))
            .set("fill", lettering.color)
            .set("text-anchor", anchor);
        if lettering.halo {
            node = node
                .set("stroke", "#ffffff")
                .set("stroke-opacity", "0.8")
                .set("stroke-width", number(size * 0.22))
                .set("stroke-linejoin", "round")
                .set("paint-order", "stroke");
        }
        if lettering.bold {
            node = node.set("font-weight", "bold");
        }
        if lettering.turn != 0.0 {
            node = node.set("transform", format!("rotate({} {x} {y})", number(-lettering.turn)));
        }
        self.add(node);
    }

    /// The sheet as SVG text, one unit a centimetre, with the paper under it.
    pub(super) fn into_svg(self, title: &str) -> String {
        let (width, height) =
            (self.bounds.max.x - self.bounds.min.x, self.bounds.max.y - self.bounds.min.y);
        let mut paper = Rectangle::new().set("width", "100%").set("height", "100%");
        Style::fill("#ffffff").apply(&mut paper);
        Document::new()
            .set("viewBox", (0, 0, round(width), round(height)))
            .set("width", number(self.pixels))
            .set("height", number(self.pixels * height / width))
            .add(Title::new(title))
            .add(StyleSheet::new(font::style_sheet()))
            .add(paper)
            .add(self.nodes)
            .to_string()
    }
}

/// Two decimals: a tenth of a millimetre is finer than any pen.
fn round(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

fn number(value: f64) -> String {
    round(value).to_string()
}
