//! What was seen and is not on the map, in the world as it is now: it fades (SPEC L4).

use crate::map::World;
use crate::robot::stand_obstacle;
use crate::store::SeenObstacle;

pub(super) use crate::robot::is_obstacle;

/// Stands what was seen in the world.
pub(super) fn put_up<'o>(world: &mut World, seen: impl Iterator<Item = &'o SeenObstacle>) {
    for obstacle in seen {
        stand_obstacle(world, obstacle.area, &obstacle.pieces, obstacle.top);
    }
}
