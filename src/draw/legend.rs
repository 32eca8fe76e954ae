//! What stands under a plan: the scale bar, what colours mean, the directives and things by number.

use crate::geometry::Bounds;
use crate::units::{Language, Point, Vector};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;

const INK: &str = "#2b2a27";
const LETTER: f64 = 12.0;
const ROW: f64 = 24.0;
const SWATCH: f64 = 24.0;

pub(super) enum Entry {
    /// A colour and what it means.
    Swatch(Style, String),
    /// A small round mark and what it means.
    Dot(Style, String),
    /// A line of its own.
    Line(String),
}

/// Entries with their places.
pub(super) struct Legend {
    entries: Vec<(Point, Entry)>,
    height: f64,
    right: f64,
    pen: f64,
}

impl Legend {
    /// Swatches run from `at` in rows of `width`; lines stand below them, from `line_start` on.
    pub(super) fn new(
        entries: Vec<Entry>,
        at: Point,
        line_start: Point,
        width: f64,
        pen: f64,
    ) -> Self {
        let (mut x, mut y) = (0.0, 0.0);
        let mut placed = Vec::new();
        let (mut rows, mut right) = (1.0_f64, at.x);
        for entry in entries {
            match &entry {
                Entry::Swatch(_, text) | Entry::Dot(_, text) => {
                    let wide = (SWATCH + 26.0 + text_width(text, LETTER, false)) * pen;
                    if x > 0.0 && x + wide > width {
                        x = 0.0;
                        y += ROW * pen;
                        rows += 1.0;
                    }
                    placed.push((at + Vector::new(x, -y), entry));
                    x += wide;
                    right = right.max(at.x + x);
                }
                Entry::Line(text) => {
                    // The scale bar with its numbers is higher than one row.
                    rows = rows.max(1.5) + 1.0;
                    right = right.max(line_start.x + text_width(text, LETTER, false) * pen);
                    y = (rows - 1.0) * ROW * pen + 8.0 * pen;
                    placed.push((line_start + Vector::new(0.0, -y), entry));
                }
            }
        }
        Self { entries: placed, height: (rows * ROW + 22.0) * pen, right, pen }
    }

    /// Of everything below the plan, cm on the sheet.
    pub(super) fn height(&self) -> f64 {
        self.height
    }

    /// How far it reaches, cm on the sheet.
    pub(super) fn right(&self) -> f64 {
        self.right
    }

    pub(super) fn draw(&self, canvas: &mut Canvas) {
        let pen = self.pen;
        let lettering =
            Lettering { anchor: Anchor::Start, halo: false, ..Lettering::plain(LETTER * pen, INK) };
        for (at, entry) in &self.entries {
            match entry {
                Entry::Swatch(style, text) => {
                    let max = *at + Vector::new(SWATCH, 8.0) * pen;
                    let swatch = Bounds { min: at - Vector::new(0.0, 6.0) * pen, max };
                    canvas.rectangle(swatch, style.thick(pen), 2.0 * pen);
                    canvas.text(at + Vector::new(SWATCH + 8.0, 1.0) * pen, text, lettering);
                }
                Entry::Dot(style, text) => {
                    let middle = at + Vector::new(SWATCH / 2.0, 1.0) * pen;
                    canvas.circle(middle, 4.5 * pen, style.thick(pen));
                    canvas.text(at + Vector::new(SWATCH + 4.0, 1.0) * pen, text, lettering);
                }
                Entry::Line(text) => canvas.text(*at, text, lettering),
            }
        }
    }
}

/// Names by the numbers that stand on a plan, from 1 on, in columns.
pub(super) struct List {
    names: Vec<String>,
    at: Point,
    columns: usize,
    column: f64,
    pen: f64,
}

impl List {
    /// Its upper left corner is at `at`; all columns are `width` wide at most.
    pub(super) fn new(names: Vec<String>, at: Point, width: f64, pen: f64) -> Self {
        let longest = names.iter().map(|n| text_width(n, Self::LETTER, false)).fold(0.0, f64::max);
        let column = (Self::NUMBER + longest + 16.0) * pen;
        let columns = ((width / column) as usize).max(1);
        Self { names, at, columns, column, pen }
    }

    const LETTER: f64 = 9.5;
    const ROW: f64 = 14.0;
    /// The width of a number with the space behind it.
    const NUMBER: f64 = 26.0;

    fn rows(&self) -> usize {
        self.names.len().div_ceil(self.columns)
    }

    /// cm on the sheet
    pub(super) fn height(&self) -> f64 {
        if self.names.is_empty() { 0.0 } else { (self.rows() as f64 + 1.0) * Self::ROW * self.pen }
    }

    pub(super) fn draw(&self, canvas: &mut Canvas) {
        let plain = Lettering::plain(Self::LETTER * self.pen, INK);
        let lettering = Lettering { anchor: Anchor::Start, halo: false, ..plain };
        for (k, name) in self.names.iter().enumerate() {
            let (column, row) = (k / self.rows(), k % self.rows());
            let down = (row as f64 + 0.5) * Self::ROW * self.pen;
            let at = self.at + Vector::new(column as f64 * self.column, -down);
            canvas.text(at, &(k + 1).to_string(), Lettering { bold: true, ..lettering });
            canvas.text(at + Vector::new(Self::NUMBER * self.pen, 0.0), name, lettering);
        }
    }
}

/// How far to the right of its start a scale bar reaches with its last number, cm on the sheet.
pub(super) fn scale_bar_width(pen: f64) -> f64 {
    200.0 * scale_length(pen) + 2.0 * LETTER * pen
}

/// A round number of metres, some hundred pens long.
fn scale_length(pen: f64) -> f64 {
    let wished = 100.0 * pen;
    let metres = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
    let length = metres
        .into_iter()
        .min_by(|a, b| (a * 100.0 - wished).abs().total_cmp(&(b * 100.0 - wished).abs()));
    length.expect("the list of lengths is not empty")
}

/// Two such lengths.
pub(super) fn scale_bar(canvas: &mut Canvas, at: Point, pen: f64, language: Language) {
    let length = scale_length(pen);
    let small = Lettering { halo: false, ..Lettering::plain(LETTER * pen, INK) };
    for (i, color) in [INK, "#ffffff"].into_iter().enumerate() {
        let min = at + Vector::new(length * 100.0 * i as f64, 0.0);
        let bar = Bounds { min, max: min + Vector::new(length * 100.0, 6.0 * pen) };
        canvas.rectangle(bar, Style::fill(color).outlined(INK, 1.0).thick(pen), 0.0);
    }
    for i in 0..3 {
        let reach = length * f64::from(i);
        let unit = if i > 0 { language.pick(" м", " m") } else { "" };
        let number = reach.to_string();
        let number = language.pick(number.replace('.', ","), number);
        let below = at + Vector::new(reach * 100.0, -12.0 * pen);
        canvas.text(below, &format!("{number}{unit}"), small);
    }
}
