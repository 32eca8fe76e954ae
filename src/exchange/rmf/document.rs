//! The YAML of a building: lenient reading of its records, its scale, and how its levels lie on one another.

use serde_json::Value;

use crate::ReadError;
use crate::units::{Cm, Point, Source, Vector, word};

use super::{FORMAT, METRE};

/// The whole text as one value; nesting, nodes and aliases are limited.
pub(super) fn parse(source: &Source) -> Result<Value, ReadError> {
    crate::yaml::parse(source, FORMAT, word!("of-a-building"))
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

/// What the coordinates of a building count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum System {
    /// Pixels of a drawing, y down; each level has its own.
    Image,
    /// Metres, y up.
    Metres,
    /// Degrees of longitude and latitude on WGS 84.
    Degrees,
    /// The square of the spherical Mercator projection, 256 wide, y down.
    Mercator,
}

impl System {
    /// The system of this name in the file; the editor's first one where the file names none.
    pub(super) fn named(name: Option<&str>) -> Option<Self> {
        match name.unwrap_or("reference_image") {
            "reference_image" => Some(Self::Image),
            "cartesian_meters" => Some(Self::Metres),
            "wgs84" => Some(Self::Degrees),
            "web_mercator" => Some(Self::Mercator),
            _ => None,
        }
    }
}

/// Radius of the sphere of the Mercator projection, and WGS 84's radius at the equator, m.
const RADIUS: f64 = 6_378_137.0;
/// Square of the eccentricity of WGS 84.
const ECCENTRICITY2: f64 = 0.006_694_379_990_14;

/// How coordinates of a level become cm of the building: moved to the origin, scaled, turned, moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fit {
    /// What lies at the origin; globes need it for the sake of precision.
    origin: Vector,
    /// cm of a unit along both axes; negative where an axis runs down.
    scale: Vector,
    turn: f64,
    shift: Vector,
}

impl Fit {
    pub(super) fn metres() -> Self {
        Self::units(METRE, METRE)
    }

    fn units(x: f64, y: f64) -> Self {
        Self {
            origin: Vector::zeros(),
            scale: Vector::new(x, y),
            turn: 0.0,
            shift: Vector::zeros(),
        }
    }

    /// Pixels of so many metres, y down.
    pub(super) fn pixels(metres: f64) -> Self {
        Self::units(metres * METRE, -metres * METRE)
    }

    /// The plane that touches the ellipsoid at a longitude and latitude, degrees.
    pub(super) fn degrees(lon: f64, lat: f64) -> Self {
        let lat_here = lat.to_radians();
        let w = (1.0 - ECCENTRICITY2 * lat_here.sin().powi(2)).sqrt();
        let east = (RADIUS / w * lat_here.cos()).to_radians();
        let north = (RADIUS * (1.0 - ECCENTRICITY2) / w.powi(3)).to_radians();
        Self { origin: Vector::new(lon, lat), ..Self::units(east * METRE, north * METRE) }
    }

    /// The Mercator square about one of its points: the projection stretches by 1/cos of the latitude.
    pub(super) fn mercator(x: f64, y: f64) -> Self {
        let unit = std::f64::consts::PI / 128.0;
        let lat = ((128.0 - y) * unit).sinh().atan();
        let cm = RADIUS * unit * lat.cos() * METRE;
        Self { origin: Vector::new(x, y), ..Self::units(cm, -cm) }
    }

    /// Latitude and longitude of what lies at the zero point of a globe laid flat.
    pub(super) fn zero(&self, system: System) -> (f64, f64) {
        match system {
            System::Mercator => {
                let unit = std::f64::consts::PI / 128.0;
                let lat = ((128.0 - self.origin.y) * unit).sinh().atan().to_degrees();
                (lat, self.origin.x / 256.0 * 360.0 - 180.0)
            }
            _ => (self.origin.y, self.origin.x),
        }
    }

    pub(super) fn then(self, (turn, shift): (f64, Vector)) -> Self {
        Self { turn, shift, ..self }
    }

    /// By which the level is turned, radians.
    pub(super) fn turn(&self) -> f64 {
        self.turn
    }

    fn apply(&self, x: f64, y: f64) -> Point {
        let p = (Vector::new(x, y) - self.origin).component_mul(&self.scale);
        let (sin, cos) = self.turn.sin_cos();
        Point::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos) + self.shift
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
    let vertices = points(level, "vertices", &Fit::units(1.0, 1.0));
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
    fn globes_are_laid_flat() {
        // The same two places of Singapore, 100 m apart to the east and to the north.
        let (lon, lat) = (103.85, 1.29);
        let near = |p: Point, x: f64, y: f64| (p - Point::new(x, y)).norm() < 1.0;
        let degrees = Fit::degrees(lon, lat);
        let moved = degrees.apply(lon + 8.985e-4, lat + 9.0437e-4);
        assert!(near(moved, 10_000.0, 10_000.0), "{moved}");
        let square = |lon: f64, lat: f64| {
            let y = lat.to_radians().tan().asinh() * 128.0 / std::f64::consts::PI;
            ((lon + 180.0) / 360.0 * 256.0, 128.0 - y)
        };
        let (x, y) = square(lon, lat);
        let mercator = Fit::mercator(x, y);
        let (x, y) = square(lon + 8.985e-4, lat + 9.0437e-4);
        // The sphere is not the ellipsoid: to the north they differ by a hundred and fiftieth.
        let moved = mercator.apply(x, y);
        assert!((moved.x - 10_000.0).abs() < 5.0 && (moved.y - 10_067.0).abs() < 5.0, "{moved}");
    }

    #[test]
    fn levels_are_laid_over_one_another_by_their_marks() {
        let mark = |name: &str, x: f64, y: f64| (name.to_owned(), Point::new(x, y));
        let on = [mark("1", 0.0, 0.0), mark("2", 100.0, 0.0), mark("3", 0.0, 50.0)];
        // Turned by a right angle and moved.
        let marks = [mark("2", 7.0, 105.0), mark("1", 7.0, 5.0), mark("3", -43.0, 5.0)];
        let (turn, shift) = lay(&marks, &on).expect("common marks");
        assert!((turn + std::f64::consts::FRAC_PI_2).abs() < 1e-9);
        let fit = Fit::units(1.0, 1.0).then((turn, shift));
        assert!((fit.apply(7.0, 105.0) - Point::new(100.0, 0.0)).norm() < 1e-9);
        assert_eq!(lay(&marks, &[mark("9", 0.0, 0.0)]), None);
    }
}
