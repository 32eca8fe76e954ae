//! Texts of an SVG as outlines of their letters, for pictures.
//!
//! The font that is carried has Latin and Cyrillic letters, each at its place whatever stands beside it; so what lays out the
//! writing of all the world, larger than all that paints, is not carried with it.

use std::fmt::Write as _;

use resvg::usvg::roxmltree::{Document, Error, Node};
use ttf_parser::{Face, OutlineBuilder};

use super::font;

/// The SVG with a path in place of each text.
///
/// # Errors
/// It is no XML.
pub(super) fn outlined(svg: &str) -> Result<String, Error> {
    let document = Document::parse(svg)?;
    let [regular, bold] =
        [font::REGULAR, font::BOLD].map(|font| Face::parse(font, 0).expect("a font of ours"));
    let (mut out, mut done) = (String::with_capacity(2 * svg.len()), 0);
    for text in document.descendants().filter(|node| node.has_tag_name("text")) {
        let face = if text.attribute("font-weight") == Some("bold") { &bold } else { &regular };
        out += &svg[done..text.range().start];
        write_path(&mut out, svg, text, face);
        done = text.range().end;
    }
    out += &svg[done..];
    Ok(out)
}

/// How far the letters of a text reach, in the unit of its size.
fn width(face: &Face<'_>, text: &str) -> f64 {
    let advance = |letter| face.glyph_hor_advance(face.glyph_index(letter).unwrap_or_default());
    let units: f64 = text.chars().filter_map(advance).map(f64::from).sum();
    units / f64::from(face.units_per_em())
}

/// A path that is painted as the text is told to be.
fn write_path(out: &mut String, svg: &str, text: Node<'_, '_>, face: &Face<'_>) {
    const OF_LETTERS: [&str; 6] =
        ["x", "y", "font-size", "font-weight", "font-family", "text-anchor"];
    let number = |name| text.attribute(name).and_then(|told| told.parse().ok());
    let size: f64 = number("font-size").unwrap_or(16.0);
    let letters = text.text().unwrap_or_default();
    let before = match text.attribute("text-anchor") {
        Some("middle") => 0.5,
        Some("end") => 1.0,
        _ => 0.0,
    };
    let start = number("x").unwrap_or(0.0) - before * size * width(face, letters);
    out.push_str("<path");
    for attribute in text.attributes().filter(|told| !OF_LETTERS.contains(&told.name())) {
        out.push(' ');
        out.push_str(&svg[attribute.range()]);
    }
    out.push_str(" d=\"");
    let scale = size / f64::from(face.units_per_em());
    let mut pen = Pen { out, scale, x: start, y: number("y").unwrap_or(0.0) };
    for letter in letters.chars() {
        let glyph = face.glyph_index(letter).unwrap_or_default();
        face.outline_glyph(glyph, &mut pen);
        pen.x += scale * f64::from(face.glyph_hor_advance(glyph).unwrap_or_default());
    }
    out.push_str("\"/>");
}

/// Writes outlines, told in the font's units with y up, where a letter stands.
struct Pen<'o> {
    out: &'o mut String,
    scale: f64,
    x: f64,
    y: f64,
}

impl Pen<'_> {
    fn go<const N: usize>(&mut self, how: char, points: [(f32, f32); N]) {
        self.out.push(how);
        for (x, y) in points {
            let (x, y) = (self.scale.mul_add(x.into(), self.x), self.y - self.scale * f64::from(y));
            let _ = write!(self.out, "{x:.3} {y:.3} ");
        }
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.go('M', [(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.go('L', [(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.go('Q', [(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.go('C', [(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.out.push('Z');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_font() {
        for text in ["Комната-В", "Обеденный стол", "Meeting room 12", "АБВГДЕЖЗ ийклмн"]
        {
            for (bold, data) in [(false, font::REGULAR), (true, font::BOLD)] {
                let truth = 10.0 * width(&Face::parse(data, 0).expect("a font"), text);
                let guess = font::text_width(text, 10.0, bold);
                assert!((guess / truth - 1.0).abs() < 0.05, "{text} {bold}: {guess} {truth}");
            }
        }
    }

    #[test]
    fn a_text_becomes_a_path_of_its_letters_painted_alike() {
        let svg = r##"<svg xmlns="http://www.w3.org/2000/svg"><text x="50" y="20" font-size="10"
            text-anchor="middle" fill="#123456" transform="rotate(9 1 2)">о &amp; o</text><g/></svg>"##;
        let outlined = outlined(svg).expect("a good SVG");
        let document = Document::parse(&outlined).expect("a good SVG still");
        let path = document.descendants().find(|node| node.has_tag_name("path")).expect("a path");
        assert_eq!(path.attribute("fill"), Some("#123456"));
        assert_eq!(path.attribute("transform"), Some("rotate(9 1 2)"));
        assert!(document.descendants().any(|node| node.has_tag_name("g")));
        let d = path.attribute("d").expect("an outline");
        // Two rings for each.
        assert_eq!(d.matches('M').count(), 6, "{d}");
        let xs: Vec<f64> = d
            .split(['M', 'L', 'Q', 'C', 'Z'])
            .flat_map(|points| points.split_whitespace().step_by(2))
            .map(|x| x.parse().expect("a number"))
            .collect();
        let (low, high) = (
            xs.iter().copied().fold(f64::INFINITY, f64::min),
            xs.iter().copied().fold(0.0, f64::max),
        );
        assert!((f64::midpoint(low, high) - 50.0).abs() < 1e-2, "{low} {high}");
    }
}
