//! Where a point of the floor is among doors, things and walls: the robot's own, and those that are asked of.
//!
//! A point is called by the robot's word, or by its place among those asked of.

use crate::facts::Value;
use crate::geometry::{OpenSide, Polygon, nearest_on_segment, outward_normal};
use crate::map::World;
use crate::measure::{hundredths, per_mille, tenths};
use crate::units::{AreaId, Deg, MapId, Point, Vector};

use super::Asked;

/// The robot, its own place, and whoever carries what it has itself, as the rules call them.
pub(crate) const ROBOT: &str = "робот";

/// A point that is asked of, what it is called, and which way one looks from it.
pub(super) struct Spot {
    pub(super) name: Value,
    pub(super) map: MapId,
    pub(super) at: Point,
    pub(super) heading: Option<Deg>,
}

impl Asked<'_, '_> {
    /// The points that are meant: all, or the one of that name.
    pub(super) fn spots(&self, known: Option<&Value>) -> Vec<Spot> {
        let own = self.around.robot;
        let own = own.map(|(map, pose)| (Value::from(ROBOT), (map, pose.at, Some(pose.heading))));
        let asked = self.around.spots.iter().enumerate();
        let asked = asked.map(|(n, spot)| (Value::from(n.to_string().as_str()), *spot));
        let all = own.into_iter().chain(asked);
        let meant = all.filter(|(name, _)| known.is_none_or(|known| known == name));
        meant.map(|(name, (map, at, heading))| Spot { name, map, at, heading }).collect()
    }

    /// The Areas in whose bases a point is, the lower ids first.
    fn areas_at(&self, spot: &Spot) -> Vec<AreaId> {
        let rooms = &self.relations.measurements().rooms;
        let holds = |room: &&crate::measure::Room| {
            room.map == spot.map && room.parts.iter().any(|(part, ..)| part.contains(spot.at))
        };
        rooms
            .iter()
            .filter(|(_, room)| room.bounds.contains(spot.at) && holds(room))
            .map(|(id, _)| *id)
            .collect()
    }

    pub(super) fn area(&self, id: AreaId) -> Value {
        Value::Symbol(self.relations.symbols().area(id).clone())
    }
}

type Tell<'t> = &'t mut dyn FnMut(&[Value]);
type Known<'k> = &'k [Option<Value>];

/// `spot(p, r)`: the point is on the floor of an Area.
pub(super) fn spots(asked: &Asked<'_, '_>, known: Known<'_>, tell: Tell<'_>) -> Option<()> {
    for spot in asked.spots(known[0].as_ref()) {
        for area in asked.areas_at(&spot) {
            tell(&[spot.name.clone(), asked.area(area)]);
        }
    }
    Some(())
}

/// `spot_side(p, o, n, r, out, thick)`: the point is before a side of an opening, or so far behind it, in a wall so thick.
pub(super) fn sides(asked: &Asked<'_, '_>, known: Known<'_>, tell: Tell<'_>) -> Option<()> {
    let near = asked.relations.thresholds();
    let reach = near.robot_doorway.max(near.step_distance);
    for spot in asked.spots(known[0].as_ref()) {
        for opening in asked.relations.openings().iter().filter(|o| o.map == spot.map) {
            for side in &opening.sides {
                let Some((share, out)) = along_and_out(side, spot.at) else { continue };
                if (0.0..=1.0).contains(&share) && out.abs() <= reach {
                    let thick = side.outward.map_or(0.0, |(_, way)| way);
                    let [n, out, thick] =
                        [i64::from(opening.id.0), tenths(out), tenths(thick)].map(Value::Number);
                    let name = Value::from(opening.name.as_str());
                    tell(&[spot.name.clone(), name, n, asked.area(side.area), out, thick]);
                }
            }
        }
    }
    Some(())
}

/// Position along a side and out of it: (share of its length, cm to the outside).
pub(super) fn along_and_out(side: &OpenSide, p: Point) -> Option<(f64, f64)> {
    let (a, b) = side.ends;
    let normal = outward_normal(a, b)?;
    let along = b - a;
    Some(((p - a).dot(&along) / along.norm_squared(), (p - a).dot(&normal)))
}

/// `spot_opening(p, o, n, r, d)`: how far the point is from the nearest side of an opening, and an Area that it is of.
pub(super) fn openings(asked: &Asked<'_, '_>, known: Known<'_>, tell: Tell<'_>) -> Option<()> {
    let reach = asked.relations.thresholds().robot_door;
    for spot in asked.spots(known[0].as_ref()) {
        for opening in asked.relations.openings().iter().filter(|o| o.map == spot.map) {
            let away =
                |s: &OpenSide| (spot.at - nearest_on_segment(spot.at, s.ends.0, s.ends.1)).norm();
            let Some(away) = opening.sides.iter().map(away).reduce(f64::min) else { continue };
            if away > reach + 1.0 {
                continue;
            }
            for area in opening.all_areas() {
                let [n, d] = [i64::from(opening.id.0), tenths(away)].map(Value::Number);
                let name = Value::from(opening.name.as_str());
                tell(&[spot.name.clone(), name, n, asked.area(area), d]);
            }
        }
    }
    Some(())
}

/// `spot_thing(p, x, d)`: how far the point is from a thing, in the plan.
pub(super) fn things(asked: &Asked<'_, '_>, known: Known<'_>, tell: Tell<'_>) -> Option<()> {
    let measured = asked.relations.measurements();
    let reach = asked.relations.thresholds().robot_thing;
    for spot in asked.spots(known[0].as_ref()) {
        for body in measured.near_to(spot.map, spot.at, reach + 1.0) {
            let away = body.outline.iter().map(|part| part.distance_to(spot.at));
            let (Some(away), Some(symbol)) = (away.reduce(f64::min), asked.symbol(body.id)) else {
                continue;
            };
            tell(&[spot.name.clone(), symbol, Value::Number(tenths(away))]);
        }
    }
    Some(())
}

/// `spot_wall(p, r, wall, d, way)`: how far the point is from a wall of the Area where it is, and which way that wall
/// looks outwards.
pub(super) fn walls(asked: &Asked<'_, '_>, known: Known<'_>, tell: Tell<'_>) -> Option<()> {
    let reach = asked.relations.thresholds().robot_wall;
    for spot in asked.spots(known[0].as_ref()) {
        for area in asked.areas_at(&spot) {
            for (n, (a, b)) in asked.relations.measurements().walls(area).enumerate() {
                let away = (spot.at - nearest_on_segment(spot.at, a, b)).norm();
                let Some(normal) = outward_normal(a, b).filter(|_| away <= reach + 1.0) else {
                    continue;
                };
                let way = normal.y.atan2(normal.x).to_degrees().rem_euclid(360.0);
                let [n, d, way] = [n as i64, tenths(away), hundredths(way)].map(Value::Number);
                tell(&[spot.name.clone(), asked.area(area), n, d, way]);
            }
        }
    }
    Some(())
}

/// `spot_middle(p, r, share)`: how far the point is from the middle of its Area towards the rim. An Area whose centroid
/// lies outside it, like an L, has no middle.
pub(super) fn middles(asked: &Asked<'_, '_>, known: Known<'_>, tell: Tell<'_>) -> Option<()> {
    for spot in asked.spots(known[0].as_ref()) {
        for area in asked.areas_at(&spot) {
            if let Some(share) = share_to_rim(asked.around.world, area, spot.at) {
                let share = Value::Number(per_mille(share));
                tell(&[spot.name.clone(), asked.area(area), share]);
            }
        }
    }
    Some(())
}

/// The share of the way from an Area's centroid through a point to the rim that lies before the point.
fn share_to_rim(world: &World, area: AreaId, p: Point) -> Option<f64> {
    let (_, frame) = world.placement(area)?;
    let parts: Vec<Polygon> = world.areas[&area]
        .items
        .iter()
        .map(|item| {
            let place = frame.compose(&item.frame);
            let base = &world.orthoframe_of(item).base;
            Polygon::new(base.iter().map(|side| place.apply(side.start)).collect())
        })
        .collect();
    let whole: f64 = parts.iter().map(Polygon::signed_area).sum();
    if whole <= 0.0 {
        return None;
    }
    let moments = parts.iter().map(|part| part.centroid().coords * part.signed_area());
    let centroid = Point::from(moments.fold(Vector::zeros(), |sum, m| sum + m) / whole);
    let holds = |at: Point| parts.iter().any(|part| part.contains(at, 1e-6));
    if !holds(centroid) {
        return None;
    }
    let away = p - centroid;
    // Beyond the farthest corner nothing is within.
    let farthest = parts.iter().flat_map(|part| &part.corners).map(|c| (c - centroid).norm());
    let length = farthest.fold(0.0, f64::max) + 1.0;
    let Some(along) = away.try_normalize(1e-9) else { return Some(0.0) };
    // Where the ray crosses a rim, it is within or it is not; between two crossings that does not change.
    let mut crossings: Vec<f64> = vec![0.0, length];
    for (a, b) in parts.iter().flat_map(Polygon::edges) {
        let (side, off) = (b - a, a - centroid);
        let across = along.perp(&side);
        if across.abs() > 1e-12 {
            let (at, of) = (off.perp(&side) / across, off.perp(&along) / across);
            if at > 0.0 && (-1e-9..=1.0 + 1e-9).contains(&of) {
                crossings.push(at);
            }
        }
    }
    crossings.sort_by(f64::total_cmp);
    let leaves = crossings.windows(2).find(|ends| {
        ends[1] - ends[0] > 1e-6 && !holds(centroid + along * f64::midpoint(ends[0], ends[1]))
    });
    let rim = leaves.map_or(length, |ends| ends[0]);
    Some(away.norm() / rim.max(1e-6))
}
