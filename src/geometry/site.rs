//! What a Fragment's floor is made from: the world, the scene, the openings that lead through, the robot and the doors.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::map::{DoorKind, DoorState, DoorStatus, Permeability, RobotProfile, World};
use crate::units::{AreaId, DoorId, ReplicaId};

use super::Bounds;
use super::doorways::ByArea;
use super::opening::Opening;
use super::scene::Scene;
use super::zone::PlacedZone;

/// A passage exactly as wide as the robot is passable: so much is forgiven, in cm.
pub const SLACK: f64 = 0.004;

/// Doors that stand otherwise than the world says: opened by the robot, or assumed.
pub type DoorStates = BTreeMap<DoorId, DoorState>;

/// What a Fragment's floor is made from.
pub(super) struct Site<'a> {
    pub(super) world: &'a World,
    pub(super) scene: &'a Scene,
    /// Replicas near any place.
    pub(super) nearby: &'a (dyn Fn(&Bounds) -> Vec<ReplicaId> + Sync),
    pub(super) doorways: &'a [Arc<Opening>],
    pub(super) by_area: &'a ByArea,
    pub(super) robot: &'a RobotProfile,
    pub(super) states: &'a DoorStates,
    pub(super) zones: &'a [PlacedZone],
}

impl Site<'_> {
    /// How far the robot's centre keeps from everything.
    pub(super) fn reach(&self) -> f64 {
        (self.robot.radius.get() + self.robot.clearance.get()).max(2.0 * SLACK)
    }

    pub(super) fn state(&self, door: DoorId) -> DoorState {
        self.states
            .get(&door)
            .copied()
            .or_else(|| self.world.doors.get(&door).map(|d| d.state))
            .unwrap_or(DoorState::CLOSED)
    }

    /// Whether the robot may try to pass: the door stands open, high enough, and without a step.
    pub(super) fn is_open(&self, doorway: &Opening) -> bool {
        let door_admits = match (doorway.door, doorway.permeability) {
            (None, Permeability::Permeable) => true,
            (None, _) => false,
            (Some(door), _) => {
                let high_enough = self.world.doors.get(&door).is_none_or(|d| {
                    d.height.get() <= 0.0 || d.height.get() >= self.robot.height.get()
                });
                let state = self.state(door);
                let stands_open = state.status == DoorStatus::Open && state.opening > 0.0;
                high_enough && (stands_open || self.is_passage(door))
            }
        };
        door_admits && doorway.rise.abs() <= self.robot.step.get().max(0.0) + 1e-9
    }

    fn is_passage(&self, door: DoorId) -> bool {
        self.world.doors.get(&door).is_some_and(|d| d.kind == DoorKind::Passage)
    }

    /// The doorways of an Area, each with its number among them and the Area's index in it.
    pub(super) fn doorways_of(
        &self,
        area: AreaId,
    ) -> impl Iterator<Item = (usize, &Opening, usize)> {
        let own = self.by_area.of(area);
        let told = |(number, &(index, side)): (usize, &(usize, usize))| {
            (number, &*self.doorways[index], side)
        };
        own.iter().enumerate().map(told)
    }
}
