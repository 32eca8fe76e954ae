//! The parts of a thing that lie above each other: shelves, drawers.

use crate::facts::Value;
use crate::map::Entity;
use crate::measure::tenths;
use crate::names::Subject;

use super::Asked;

/// `shelf(+x, kind, top)`: the parts of each kind that a thing has, by the heights of their tops above the Map's zero.
pub(super) fn shelves(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let x = known[0].clone()?;
    let Some(Subject::Entity(Entity::Replica(id))) = asked.subject(Some(&x)) else { return None };
    let world = asked.around.world;
    let object = world.objects.get(&world.replicas.get(&id)?.object)?;
    let foot = asked.body(id)?.bottom;
    let lowest = object.items.iter().map(|item| item.frame.z.get()).fold(f64::INFINITY, f64::min);
    for item in &object.items {
        let Some(part) = world.orthoframes.get(&item.orthoframe) else { continue };
        let Some(kind) = world.types.orthoframe.get(part.frame_type) else { continue };
        let top = foot + item.frame.z.get() + part.height.get() - lowest;
        tell(&[x.clone(), Value::from(kind.name.as_str()), Value::Number(tenths(top))]);
    }
    Some(())
}
