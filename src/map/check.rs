//! What must hold in a [`World`], with every fault at once.

use super::World;
use super::fault::Fault;

/// Every fault of a world.
#[must_use]
pub fn check(_world: &World) -> Vec<Fault> {
    Vec::new()
}
