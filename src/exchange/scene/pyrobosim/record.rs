//! Footprints, poses and colours as pyrobosim writes them.

use serde_json::Value;

use crate::map::Properties;
use crate::scene::colour;
use crate::scene::json::{length, list, text};
use crate::scene::shape::rectangle;
use crate::units::{Cm, Deg, Frame, Point, Vector};

/// Corners of a circle.
const CORNERS: u32 = 16;

pub(super) fn colour_of(value: Option<&Value>) -> Properties {
    let name = match value {
        Some(Value::String(text)) => colour::of_text(text),
        Some(Value::Array(rgb)) => {
            let channels: Vec<f64> = rgb.iter().filter_map(Value::as_f64).collect();
            <[f64; 3]>::try_from(channels).ok().map(colour::of_rgb)
        }
        _ => None,
    };
    name.map(|n| ("ЦВЕТ".to_owned(), n.to_owned())).into_iter().collect()
}

/// A pair of metres.
pub(super) fn pair(value: &Value) -> Option<Point> {
    let numbers = value.as_array()?;
    Some(Point::new(length(numbers.first()?)?, length(numbers.get(1)?)?))
}

pub(super) fn footprint_outline(footprint: &Value) -> Option<Vec<Point>> {
    let offset = footprint.get("offset").and_then(pair).unwrap_or_else(Point::origin).coords;
    let outline: Vec<Point> = match text(footprint, "type")? {
        "polygon" => list(footprint, "coords").iter().filter_map(pair).collect(),
        "box" => {
            let half = footprint.get("dims").and_then(pair)? / 2.0;
            rectangle(-half.x, -half.y, half.x, half.y)
        }
        "circle" => {
            let r = footprint.get("radius").and_then(length)?;
            let step = std::f64::consts::TAU / f64::from(CORNERS);
            (0..CORNERS)
                .map(|i| (f64::from(i) + 0.5) * step)
                .map(|a| Point::new(r * a.cos(), r * a.sin()))
                .collect()
        }
        _ => return None,
    };
    (outline.len() >= 3).then(|| outline.into_iter().map(|p| p + offset).collect())
}

/// `[x, y]`, `[x, y, z]`, `[x, y, z, yaw]` or a record with `position` and a rotation.
pub(super) fn pose(value: &Value) -> Option<Frame> {
    let metres = |v: Option<&Value>| v.map_or(Some(0.0), length);
    if let Some(list) = value.as_array() {
        let yaw = list.get(3).and_then(Value::as_f64).filter(|a| a.is_finite()).unwrap_or(0.0);
        return Some(frame_at(pair(value)?, metres(list.get(2))?, yaw.to_degrees()));
    }
    let at = value.get("position")?;
    let place = Point::new(metres(at.get("x"))?, metres(at.get("y"))?);
    let number = |record: &Value, field: &str| {
        record.get(field).and_then(Value::as_f64).filter(|a| a.abs() < 1e9)
    };
    let yaw = if let Some(euler) = value.get("rotation_eul") {
        let yaw = number(euler, "yaw").unwrap_or(0.0);
        if text(euler, "angle_units") == Some("degrees") { yaw } else { yaw.to_degrees() }
    } else if let Some(q) = value.get("rotation_quat") {
        let [w, x, y, z] = ["w", "x", "y", "z"].map(|f| number(q, f).unwrap_or(0.0));
        (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z)).to_degrees()
    } else {
        0.0
    };
    Some(frame_at(place, metres(at.get("z"))?, yaw))
}

pub(super) fn centroid(outline: &[Point]) -> Point {
    let ends = || outline.iter().zip(outline.iter().cycle().skip(1));
    let doubled: f64 = ends().map(|(a, b)| a.x * b.y - b.x * a.y).sum();
    if doubled.abs() < 1e-6 {
        return outline.first().copied().unwrap_or_else(Point::origin);
    }
    let sum: Vector = ends().map(|(a, b)| (a.coords + b.coords) * (a.x * b.y - b.x * a.y)).sum();
    Point::from(sum / (3.0 * doubled))
}

pub(super) fn frame_at(p: Point, z: f64, degrees: f64) -> Frame {
    Frame { x: Cm::of(p.x), y: Cm::of(p.y), z: Cm::of(z), angle: Deg::of(degrees) }
}
