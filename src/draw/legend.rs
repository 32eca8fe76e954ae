//! What stands under a plan: the scale bar, what colours mean, the directives and things by number.

use crate::geometry::{Bounds, Polygon};
use crate::units::{Language, Point, Vector, told};

use super::canvas::{Anchor, Canvas, Lettering, Style};
use super::font::text_width;
use super::labels::around;

const INK: &str = "#2b2a27";
const LETTER: f64 = 12.0;
const ROW: f64 = 24.0;
const SWATCH: f64 = 24.0;

/// What is shown beside its meaning.
#[derive(Debug, Clone, Copy)]
pub(super) enum Sample {
    Fill(Style),
    Dot(Style),
    Diamond(Style),
    Stroke(Style),
    Arrow(Style),
    Goal,
}

pub(super) enum Entry {
    /// A sign of the plan, the class of what it stands for with `key` before it, and what it means.
    Sign(Sample, &'static str, String),
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
                Entry::Sign(_, _, text) => {
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
        canvas.mark("key");
        for (at, entry) in &self.entries {
            match entry {
                Entry::Sign(sample, class, text) => {
                    canvas.mark(class);
                    sample.draw(canvas, at + Vector::new(0.0, 1.0) * pen, pen);
                    canvas.mark("key");
                    canvas.text(at + Vector::new(SWATCH + 8.0, 1.0) * pen, text, lettering);
                }
                Entry::Line(text) => canvas.text(*at, text, lettering),
            }
        }
    }
}

impl Sample {
    /// From its left end, at the height of its middle.
    fn draw(self, canvas: &mut Canvas, at: Point, pen: f64) {
        let middle = at + Vector::new(SWATCH / 2.0, 0.0) * pen;
        let ends = (at, at + Vector::new(SWATCH, 0.0) * pen);
        match self {
            Self::Fill(style) => {
                let swatch = around(middle, SWATCH * pen, 14.0 * pen);
                canvas.rectangle(swatch, style.thick(pen), 2.0 * pen);
            }
            Self::Dot(style) => canvas.circle(middle, 4.5 * pen, style.thick(pen)),
            Self::Diamond(style) => canvas.polygon(&diamond(middle, 4.5 * pen), style, None),
            Self::Stroke(style) => canvas.segment(ends.0, ends.1, style.thick(pen)),
            Self::Arrow(style) => {
                canvas.segment(ends.0, ends.1, style.thick(pen));
                let color = style.stroke.unwrap_or(INK);
                let head = arrow_head(ends, 1.0, pen);
                canvas.polygon(&head, Style::fill(color), None);
            }
            Self::Goal => goal(canvas, middle, 0.8 * pen),
        }
    }
}

pub(super) fn diamond(at: Point, r: f64) -> Polygon {
    Polygon::new(
        [(r, 0.0), (0.0, r), (-r, 0.0), (0.0, -r)].map(|(x, y)| at + Vector::new(x, y)).into(),
    )
}

/// The head of an arrow that points from the first end to the second, at this share of the way.
pub(super) fn arrow_head((from, to): (Point, Point), share: f64, pen: f64) -> Polygon {
    let along = (to - from).try_normalize(1e-9).unwrap_or_else(Vector::x);
    let aside = Vector::new(-along.y, along.x) * 6.5 * pen;
    let tip = from + (to - from) * share + along * 5.0 * pen;
    let neck = tip - along * 13.0 * pen;
    Polygon::new(vec![tip, neck + aside, neck - aside])
}

/// The sign of a goal: a ring round a dot.
pub(super) fn goal(canvas: &mut Canvas, at: Point, pen: f64) {
    canvas.circle(at, 9.0 * pen, Style::fill("#ffffff").outlined(GOAL, 2.6 * pen));
    canvas.circle(at, 4.0 * pen, Style::fill(GOAL));
}

const GOAL: &str = "#c0392b";

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

    /// How far it reaches, cm on the sheet.
    pub(super) fn right(&self) -> f64 {
        if self.names.is_empty() {
            self.at.x
        } else {
            self.at.x + self.columns as f64 * self.column
        }
    }

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
        canvas.mark("list");
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
    canvas.mark("scale");
    for (i, color) in [INK, "#ffffff"].into_iter().enumerate() {
        let min = at + Vector::new(length * 100.0 * i as f64, 0.0);
        let bar = Bounds { min, max: min + Vector::new(length * 100.0, 6.0 * pen) };
        canvas.rectangle(bar, Style::fill(color).outlined(INK, 1.0).thick(pen), 0.0);
    }
    for i in 0..3 {
        let reach = length * f64::from(i);
        let number = reach.to_string();
        let number = language.pick(number.replace('.', ","), number);
        let told = if i > 0 { told!(language, "metres", number) } else { number };
        let below = at + Vector::new(reach * 100.0, -12.0 * pen);
        canvas.text(below, &told, small);
    }
}
