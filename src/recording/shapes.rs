//! Pieces that several schemas share.

use serde_json::{Value, json};

use crate::units::{Deg, Point, Pose};

/// cm → metres, to the hundredth of a millimetre.
pub(super) fn metre(cm: f64) -> f64 {
    (cm * 1000.0).round() / 100_000.0 + 0.0
}

pub(super) fn timestamp(time: u64) -> Value {
    json!({ "sec": time / 1_000_000_000, "nsec": time % 1_000_000_000 })
}

pub(super) fn vector(at: Point, z: f64) -> Value {
    json!({ "x": metre(at.x), "y": metre(at.y), "z": metre(z) })
}

/// A turn about the vertical.
pub(super) fn quaternion(angle: Deg) -> Value {
    let half = angle.get().to_radians() / 2.0;
    json!({ "x": 0, "y": 0, "z": half.sin(), "w": half.cos() })
}

pub(super) fn pose(pose: Pose, z: f64) -> Value {
    json!({ "position": vector(pose.at, z), "orientation": quaternion(pose.heading) })
}

/// Red, green and blue of 0..=255, and how much it covers, 0..=1.
pub(super) fn color([r, g, b]: [u8; 3], a: f64) -> Value {
    let share = |part: u8| (f64::from(part) / 255.0 * 1000.0).round() / 1000.0;
    json!({ "r": share(r), "g": share(g), "b": share(b), "a": a })
}
