//! The YAML of a building: lenient reading of its records, its scale, and how its levels lie on one another.

use serde_json::Value;

use crate::exchange::ReadError;
use crate::units::{Cm, Point, Source, Vector};

use super::{FORMAT, METRE};

/// The whole text as one value; nesting, nodes and aliases are limited.
pub(super) fn parse(source: &Source) -> Result<Value, ReadError> {
    let options = serde_saphyr::options! {
        budget: serde_saphyr::budget! {
            max_depth: 64,
            flow_nesting_limit: 32,
            max_nodes: 20_000_000,
            max_events: 40_000_000,
            max_aliases: 1_000,
        },
        alias_limits: serde_saphyr::alias_limits! { max_total_replayed_events: 10_000 },
    };
    serde_saphyr::from_str_with_options(source.text(), options).map_err(|e| {
        let e = e.without_snippet();
        let at = e.location().map_or(0, |at| {
            let lines = source.text().split_inclusive('\n');
            let before: usize =
                lines.take((at.line() as usize).saturating_sub(1)).map(str::len).sum();
            before + (at.column() as usize).saturating_sub(1)
        });
        ReadError::syntax(FORMAT, format!("это не YAML здания: {e}"), source, at)
    })
}

pub(super) fn text<'v>(value: &'v Value, field: &str) -> Option<&'v str> {
    value.get(field).and_then(Value::as_str).filter(|s| !s.is_empty())
}

pub(super) fn list<'v>(value: &'v Value, field: &str) -> &'v [Value] {
    value.get(field).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// The entries of a table, in the order of their names.
pub(super) fn entries<'v>(value: &'v Value, field: &str) -> Vec<(&'v str, &'v Value)> {
    let table = value.get(field).and_then(Value::as_object);
    table.into_iter().flatten().map(|(name, value)| (name.as_str(), value)).collect()
}

pub(super) fn number(value: Option<&Value>) -> Option<f64> {
    value.and_then(Value::as_f64).filter(|n| n.is_finite() && n.abs() < 1e12)
}

/// A length in units of so many cm; none beyond what a [`Cm`] holds.
pub(super) fn length(value: Option<&Value>, unit: f64) -> Option<Cm> {
    Cm::new(number(value)? * unit).ok()
}

/// A parameter of an edge: `[a, b, {name: [type, value]}]`.
pub(super) fn param<'v>(edge: &'v Value, name: &str) -> Option<&'v Value> {
    edge.get(2)?.get(name)?.get(1)
}

/// How coordinates of a level become cm of the building: turned, scaled, moved, and for images mirrored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fit {
    scale: f64,
    is_image: bool,
    turn: f64,
    shift: Vector,
}

impl Fit {
    pub(super) fn metres() -> Self {
        Self { scale: METRE, is_image: false, turn: 0.0, shift: Vector::zeros() }
    }

    /// Pixels of so many metres, y down.
    pub(super) fn pixels(metres: f64) -> Self {
        Self { scale: metres * METRE, is_image: true, ..Self::metres() }
    }

    pub(super) fn then(self, (turn, shift): (f64, Vector)) -> Self {
        Self { turn, shift, ..self }
    }

    /// By which the level is turned, radians.
    pub(super) fn turn(&self) -> f64 {
        self.turn
    }

    fn apply(&self, x: f64, y: f64) -> Point {
        let y = if self.is_image { -y } else { y };
        let (x, y) = (x * self.scale, y * self.scale);
        let (sin, cos) = self.turn.sin_cos();
        Point::new(x * cos - y * sin, x * sin + y * cos) + self.shift
    }
}

/// A place; none where it is no number or farther than any building reaches.
pub(super) fn point(x: Option<&Value>, y: Option<&Value>, fit: &Fit) -> Option<Point> {
    let p = fit.apply(number(x)?, number(y)?);
    (Cm::new(p.x).is_ok() && Cm::new(p.y).is_ok()).then_some(p)
}

/// The vertices of a level, with their numbers kept.
pub(super) fn points(level: &Value, field: &str, fit: &Fit) -> Vec<Option<Point>> {
    list(level, field).iter().map(|v| point(v.get(0), v.get(1), fit)).collect()
}

/// Metres of a pixel: the mean of the level's measurements.
pub(super) fn scale(level: &Value) -> Option<f64> {
    let vertices = points(level, "vertices", &Fit { scale: 1.0, ..Fit::metres() });
    let measured = list(level, "measurements").iter().filter_map(|m| {
        let end =
            |k: usize| vertices.get(usize::try_from(m.get(k)?.as_u64()?).ok()?).copied().flatten();
        let pixels = (end(0)? - end(1)?).norm();
        let metres = number(param(m, "distance"))?;
        (pixels > 0.0 && metres > 0.0).then_some(metres / pixels)
    });
    let (sum, count) = measured.fold((0.0, 0_u32), |(sum, n), scale| (sum + scale, n + 1));
    let mean = sum / f64::from(count.max(1));
    (count > 0 && mean > 1e-6 && mean < 1e3).then_some(mean)
}

/// The marks of a level by their names, in cm.
pub(super) fn fiducials(level: &Value, fit: &Fit) -> Vec<(String, Point)> {
    list(level, "fiducials")
        .iter()
        .filter_map(|mark| {
            let at = point(mark.get(0), mark.get(1), fit)?;
            let name = mark.get(2)?;
            let name = name.as_str().map_or_else(|| name.to_string(), str::to_owned);
            (!name.is_empty()).then_some((name, at))
        })
        .collect()
}

/// The turn and shift that bring marks onto those of the same names, with the least squares of their distances.
pub(super) fn lay(marks: &[(String, Point)], on: &[(String, Point)]) -> Option<(f64, Vector)> {
    let pairs: Vec<(Point, Point)> = marks
        .iter()
        .filter_map(|(name, p)| on.iter().find(|(n, _)| n == name).map(|(_, q)| (*p, *q)))
        .collect();
    let count = pairs.len() as f64;
    if pairs.is_empty() {
        return None;
    }
    let mean = |side: fn(&(Point, Point)) -> Point| -> Vector {
        pairs.iter().map(|pair| side(pair).coords).sum::<Vector>() / count
    };
    let (from, to) = (mean(|p| p.0), mean(|p| p.1));
    let (mut dot, mut cross) = (0.0, 0.0);
    for (p, q) in &pairs {
        let (u, v) = (p.coords - from, q.coords - to);
        dot += u.dot(&v);
        cross += u.perp(&v);
    }
    // A ten-thousandth of a degree is the rounding of the marks.
    let turn = if pairs.len() < 2 { 0.0 } else { cross.atan2(dot) };
    let turn = if turn.abs() < 1e-6 { 0.0 } else { turn };
    let (sin, cos) = turn.sin_cos();
    let turned = Vector::new(from.x * cos - from.y * sin, from.x * sin + from.y * cos);
    Some((turn, to - turned))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_laid_over_one_another_by_their_marks() {
        let mark = |name: &str, x: f64, y: f64| (name.to_owned(), Point::new(x, y));
        let on = [mark("1", 0.0, 0.0), mark("2", 100.0, 0.0), mark("3", 0.0, 50.0)];
        // Turned by a right angle and moved.
        let marks = [mark("2", 7.0, 105.0), mark("1", 7.0, 5.0), mark("3", -43.0, 5.0)];
        let (turn, shift) = lay(&marks, &on).expect("common marks");
        assert!((turn + std::f64::consts::FRAC_PI_2).abs() < 1e-9);
        let fit = Fit { scale: 1.0, ..Fit::metres() }.then((turn, shift));
        assert!((fit.apply(7.0, 105.0) - Point::new(100.0, 0.0)).norm() < 1e-9);
        assert_eq!(lay(&marks, &[mark("9", 0.0, 0.0)]), None);
    }
}
