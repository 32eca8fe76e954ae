//! How things lie for the robot that stands among them.
//!
//! ```text
//!              behind
//!        left  anchor  right        `view`: the anchor turns its face to the viewer (SPEC R1)
//!             in front
//!                 ^
//!              viewer
//! ```

use crate::facts::Value;
use crate::measure::{hundredths, level, surface_distance, tenths};
use crate::units::{MapId, Pose, Vector};

use super::Asked;
use crate::body::Body;

impl Asked<'_, '_> {
    /// The robot's place and what is in its Area.
    fn about_robot(&self) -> Option<(MapId, Pose, Vec<&Body>)> {
        let (map, pose) = self.around.robot?;
        let area = self.relations.measurements().area_at(map, pose.at)?;
        let here = self.bodies().filter(|body| self.relations.area_of(body.id) == Some(area));
        Some((map, pose, here.collect()))
    }
}

/// `view(x, anchor, bearing, d, level)`: of the things in the robot's Area.
pub(super) fn view(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let (_, pose, bodies) = asked.about_robot()?;
    let meant =
        |body: &Body, value: &Option<Value>| value.is_none() || asked.symbol(body.id) == *value;
    for anchor in bodies.iter().filter(|anchor| meant(anchor, &known[1])) {
        // Whoever stands on the anchor sees it from no side.
        let Some(ahead) = (pose.at - anchor.centre).try_normalize(1e-6) else { continue };
        for thing in bodies.iter().filter(|thing| thing.id != anchor.id && meant(thing, &known[0]))
        {
            let Some(level) = level(thing, anchor) else { continue };
            let Some(bearing) = anchor.bearing_from(ahead, thing.centre) else { continue };
            let (distance, _) = surface_distance(thing, anchor);
            let [Some(x), Some(of)] = [thing, anchor].map(|body| asked.symbol(body.id)) else {
                continue;
            };
            let [bearing, d, level] =
                [hundredths(bearing), tenths(distance), level].map(Value::Number);
            tell(&[x, of, bearing, d, level]);
        }
    }
    Some(())
}

/// `about_robot(x, ahead, left, d)`: how far before the robot and to its left the middles of the things of its Area are, and
/// how far from it they begin, in the plan.
pub(super) fn about(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let (map, pose, bodies) = asked.about_robot()?;
    let (sin, cos) = pose.heading.sin_cos();
    let ahead = Vector::new(cos, sin);
    for body in bodies {
        let Some(symbol) = asked.symbol(body.id) else { continue };
        if known[0].as_ref().is_some_and(|own| *own != symbol) {
            continue;
        }
        let Some(distance) = asked.relations.distance_to_point(body.id, map, pose.at) else {
            continue;
        };
        let off = body.centre - pose.at;
        let [before, left, d] =
            [off.dot(&ahead), ahead.perp(&off), distance].map(|v| Value::Number(tenths(v)));
        tell(&[symbol, before, left, d]);
    }
    Some(())
}
