//! Zones on a plan: where the robot may not go, goes slowly, or goes one way only.

use crate::geometry::{Polygon, nearest_on_segment};
use crate::map::ZoneKind;
use crate::units::{Piece, Point, Vector, word};

use super::canvas::{Anchor, Canvas, Lettering, Style};

/// A zone as it is drawn.
#[derive(Debug, Clone)]
pub struct ZoneGlyph {
    pub kind: ZoneKind,
    pub name: String,
    /// What it says, in words.
    pub rule: String,
    pub polygons: Vec<Polygon>,
    /// Whether it is in force for a time only.
    pub is_timed: bool,
}

const KEEP_OUT: Style = Style::fill("#d0312d").faint(0.28);
const CLOSED: Style = Style::fill("#f08a24").faint(0.30);
const SLOW: Style = Style::fill("#e6c700").faint(0.28);
const ONE_WAY: Style = Style::fill("#3b82c4").faint(0.22);

/// How a kind of zones is drawn, its class and its name in the legend.
pub(super) fn look(kind: ZoneKind) -> (Style, &'static str, &'static str, Piece) {
    match kind {
        ZoneKind::KeepOut => (KEEP_OUT, "#a11d1a", "keep-out", word!("keep-out")),
        ZoneKind::Closed => (CLOSED, "#a8550a", "closed", word!("closed")),
        ZoneKind::Slow { .. } => (SLOW, "#8a7800", "slow", word!("slow")),
        ZoneKind::OneWay { .. } => (ONE_WAY, "#1d5b96", "one-way", word!("one-way")),
    }
}

pub(super) fn draw(canvas: &mut Canvas, zones: &[ZoneGlyph], pen: f64) {
    for zone in zones {
        let (style, color, _, _) = look(zone.kind);
        canvas.mark("zone");
        for polygon in &zone.polygons {
            canvas.polygon(polygon, style, Some(&zone.rule));
            let border = Style::line(color, 1.4 * pen);
            let border = if zone.is_timed { border.dashed(6.0 * pen, 4.0 * pen) } else { border };
            let ring: Vec<Point> =
                polygon.corners.iter().chain(polygon.corners.first()).copied().collect();
            canvas.polyline(&ring, border);
        }
        if let (ZoneKind::OneWay { heading }, Some(polygon)) = (zone.kind, zone.polygons.first()) {
            let angle = heading.get().to_radians();
            let along = Vector::new(angle.cos(), angle.sin());
            let middle = inside(polygon);
            let reach = polygon.border_distance(middle).clamp(8.0 * pen, 60.0 * pen) * 0.8;
            let (tail, tip) = (middle - along * reach, middle + along * reach);
            let side = Vector::new(-along.y, along.x) * (5.0 * pen);
            let back = tip - along * (10.0 * pen);
            canvas.polyline(&[tail, tip], Style::line(color, 2.2 * pen));
            canvas.polyline(&[back + side, tip, back - side], Style::line(color, 2.2 * pen));
        }
    }
}

/// The names, over all that stands there.
pub(super) fn names(canvas: &mut Canvas, zones: &[ZoneGlyph], pen: f64) {
    for zone in zones {
        let (_, color, _, _) = look(zone.kind);
        let largest = zone
            .polygons
            .iter()
            .max_by(|a, b| a.signed_area().abs().total_cmp(&b.signed_area().abs()));
        let Some(polygon) = largest else { continue };
        // Under the upper border, where rooms and things seldom have their names.
        let bounds = polygon.bounds();
        let middle = inside(polygon);
        let top = Point::new(middle.x, bounds.max.y);
        let edges = polygon.edges().map(|(a, b)| nearest_on_segment(top, a, b));
        let border = edges.min_by(|a, b| (a - top).norm().total_cmp(&(b - top).norm()));
        let at = border.unwrap_or(middle) - Vector::new(0.0, 12.0 * pen);
        let lettering =
            Lettering { anchor: Anchor::Middle, halo: true, ..Lettering::bold(10.0 * pen, color) };
        canvas.mark("zone-name");
        canvas.text(at, &zone.name, lettering);
    }
}

/// A point within a polygon: its centroid, else beside the middle of an edge.
fn inside(polygon: &Polygon) -> Point {
    let centroid = polygon.centroid();
    if polygon.contains(centroid, 0.0) {
        return centroid;
    }
    let beside = polygon.edges().map(|(a, b)| {
        let inward = Vector::new(a.y - b.y, b.x - a.x) / (b - a).norm().max(1e-9);
        nalgebra::center(&a, &b) + inward * 10.0
    });
    beside.into_iter().find(|p| polygon.contains(*p, 0.0)).unwrap_or(centroid)
}
