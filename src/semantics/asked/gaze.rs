//! What lies ahead of who looks somewhere: the robot, or whoever is asked of.
//!
//! ```text
//!                 b
//!        turn   ./     An edge that the straight line from the middle meets turns from it by 0, at the distance where it
//!   at --------+--->   is met; another by the smaller of the angles to its ends, at the distance of that end.
//!             /
//!            a
//! ```

use crate::facts::Value;
use crate::geometry::{OpenSide, PlacedReplica};
use crate::map::DoorStatus;
use crate::measure::{hundredths, tenths};
use crate::relations::Relations;
use crate::units::{AreaId, Deg, MapId, Point, Vector};

use super::spot::{Spot, along_and_out};
use super::{Asked, Placed};

/// A look: from where, which way, and how far aside something may be to be told of at all, in degrees.
struct Look {
    at: Point,
    ahead: Vector,
    widest: f64,
}

/// How far something turns from a look, in degrees, and how far away it is there, in cm.
type Met = (f64, f64);

impl Look {
    fn edge(&self, (a, b): (Point, Point)) -> Met {
        if let Some(distance) = self.hit(a, b) {
            return (0.0, distance);
        }
        let end = |p: Point| {
            let off = p - self.at;
            let turn = self.ahead.perp(&off).atan2(self.ahead.dot(&off));
            (turn.abs().to_degrees(), off.norm())
        };
        nearer(end(a), end(b))
    }

    /// Distance along the line to a segment.
    fn hit(&self, a: Point, b: Point) -> Option<f64> {
        let along = b - a;
        let cross = self.ahead.perp(&along);
        if cross.abs() < 1e-12 {
            return None;
        }
        let distance = (a - self.at).perp(&along) / cross;
        let share = (a - self.at).perp(&self.ahead) / cross;
        (distance > 0.0 && (0.0..=1.0).contains(&share)).then_some(distance)
    }

    /// Of some edges the one that turns least, and of several such the nearest; none where all turn too far.
    fn first(&self, edges: impl Iterator<Item = (Point, Point)>) -> Option<Met> {
        edges.map(|edge| self.edge(edge)).reduce(nearer).filter(|(turn, _)| *turn <= self.widest)
    }
}

fn nearer(one: Met, other: Met) -> Met {
    if one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)).is_le() { one } else { other }
}

/// `gaze(p, x, as, n, low, high, turn, d)`: what of things, leaves, openings and walls is ahead of a look, from which to which
/// height above the floor, how far it turns from the line and how far away it is. What is asked of by its name is measured
/// wherever it is.
pub(super) fn gaze(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let (relations, world) = (asked.relations, asked.around.world);
    let (measured, near) = (relations.measurements(), relations.thresholds());
    let wanted = known[1].as_ref();
    let is_meant = |symbol: &Value| wanted.is_none_or(|wanted| wanted == symbol);
    let one = asked.placed(wanted);
    for Spot { name, map, at, heading } in asked.spots(known[0].as_ref()) {
        let (Some(heading), Some(area)) = (heading, looks_from(relations, map, at)) else {
            continue;
        };
        let look = Look {
            at,
            ahead: ahead(heading),
            widest: if wanted.is_some() { 180.0 } else { near.robot_facing_turn },
        };
        let parts = measured.rooms.get(&area).into_iter().flat_map(|room| &room.parts);
        let here = parts.filter(|(part, ..)| part.contains(at));
        let floor = here.map(|(_, low, _)| *low).reduce(f64::min).unwrap_or_default();
        let mut row = |x: Value, kind: &str, n: i64, (low, high): (f64, f64), (turn, d): Met| {
            let heights = [tenths(low - floor), tenths(high - floor)];
            let [low, high, turn, d] =
                [heights[0], heights[1], hundredths(turn), tenths(d)].map(Value::Number);
            tell(&[name.clone(), x, Value::from(kind), Value::Number(n), low, high, turn, d]);
        };
        let things: Vec<_> = match (wanted, one) {
            (Some(_), Some(Placed::Thing(id))) => {
                measured.bodies.get(&id).filter(|body| body.map == map).into_iter().collect()
            }
            (Some(_), _) => Vec::new(),
            (None, _) => measured.near_to(map, at, near.robot_facing + 1.0).collect(),
        };
        for body in things {
            let Some(symbol) = asked.symbol(body.id) else { continue };
            for block in &body.blocks {
                if let Some(met) = look.first(block.base.polygon.edges()) {
                    row(symbol.clone(), "thing", 0, (block.bottom, block.top), met);
                }
            }
            let frame = world.replicas.get(&body.id).and_then(|replica| {
                let has_doors = !world.objects.get(&replica.object)?.doors.is_empty();
                let (_, frame) = world.placement(replica.area).filter(|_| has_doors)?;
                Some(frame.compose(&replica.frame))
            });
            let placed = frame.map(|frame| PlacedReplica::new(world, body.id, frame));
            for (leaf, heights) in placed.iter().flat_map(|placed| placed.open_leaves(world)) {
                if let Some(met) = look.first(leaf.edges()) {
                    row(symbol.clone(), "thing", 0, heights, met);
                }
            }
        }
        for opening in relations.openings().iter().filter(|opening| opening.map == map) {
            let symbol = Value::from(opening.name.as_str());
            if !is_meant(&symbol) {
                continue;
            }
            let (n, door) =
                (i64::from(opening.id.0), opening.door.and_then(|d| world.doors.get(&d)));
            for side in opening.sides.iter().filter(|side| side.area == area) {
                if let Some(met) = look.first([side.ends].into_iter()) {
                    row(symbol.clone(), "opening", n, (floor, floor), met);
                }
            }
            // One does not look through a leaf; one that is shut is in its opening.
            let open = door.filter(|door| door.state.status == DoorStatus::Open);
            let leaves = open.map(|door| opening.leaves(door).obstacles(door.state));
            for leaf in leaves.into_iter().flatten() {
                let height = door.map_or(0.0, |door| door.height.get());
                if let Some(met) = look.first(leaf.edges()) {
                    row(symbol.clone(), "leaf", n, (floor, floor + height), met);
                }
            }
        }
        let room = asked.area(area);
        if is_meant(&room) {
            for (n, wall) in measured.walls(area).enumerate() {
                if let Some(met) = look.first([wall].into_iter()) {
                    row(room.clone(), "wall", n as i64, (floor, floor), met);
                }
            }
        }
    }
    Some(())
}

/// The Area whose walls and openings are looked at from a point: the one where it is; within the thickness of a wall, where
/// no floor is anybody's, one whose opening is there.
pub(crate) fn looks_from(relations: &Relations, map: MapId, at: Point) -> Option<AreaId> {
    let openings = || relations.openings().iter().filter(|opening| opening.map == map);
    let is_in = |side: &&OpenSide| {
        let thick = side.outward.map_or(0.0, |(_, way)| way);
        along_and_out(side, at).is_some_and(|(share, out)| {
            (0.0..=1.0).contains(&share) && (0.0..=thick).contains(&out)
        })
    };
    let here = relations.measurements().area_at(map, at);
    here.or_else(|| {
        openings().flat_map(|opening| &opening.sides).filter(is_in).map(|side| side.area).min()
    })
}

fn ahead(heading: Deg) -> Vector {
    let (sin, cos) = heading.sin_cos();
    Vector::new(cos, sin)
}
