//! Numbers, points and tuples as data.

use serde_json::{Value, json};

use crate::facts;
use crate::units::{Point, Pose};

pub(super) fn point(p: Point) -> [f64; 2] {
    [round(p.x), round(p.y)]
}

pub(super) fn pose(pose: Pose) -> Value {
    json!({"x": round(pose.at.x), "y": round(pose.at.y), "heading_deg": round(pose.heading.get())})
}

/// Hundredths: a tenth of a millimetre, a hundredth of a degree.
pub(super) fn round(value: f64) -> f64 {
    // (Nothing added up is minus zero.)
    (value * 100.0).round() / 100.0 + 0.0
}

pub fn tuple(values: &[facts::Value]) -> Vec<Value> {
    values
        .iter()
        .map(|value| match value {
            facts::Value::Symbol(symbol) => json!(symbol.as_ref()),
            other => other
                .to_string()
                .parse::<i64>()
                .map_or_else(|_| json!(other.to_string()), |n| json!(n)),
        })
        .collect()
}

pub(super) fn merge(view: &mut Value, more: Value) {
    if let (Value::Object(view), Value::Object(more)) = (view, more) {
        view.extend(more);
    }
}
