//! How a task leaves the robot and its world.

use std::collections::BTreeMap;

use crate::map::{DoorStatus, Replica, World, is_on, stands};
use crate::robot::{Belief, outline_of};
use crate::store::{RobotMemory, Seen, SeenObstacle, Timestamp};
use crate::units::{Gather as _, ReplicaId};

use super::obstacles::is_obstacle;

/// How a task left the robot and its world.
#[derive(Debug, Clone, Default)]
pub struct After {
    pub memory: RobotMemory,
    /// Things that are not where they were when the task began: where they are, or that they are gone.
    pub moved: BTreeMap<ReplicaId, Option<Seen>>,
    /// How sure the robot is of it, 0..=1.
    pub sure: f64,
}

impl After {
    /// What a robot holds to be so, against the map and against what was so, and remembered, when it began at a moment;
    /// how sure it is of what it touched.
    pub(super) fn of(
        surveyed: &World,
        before: &World,
        (remembered, begun): (&RobotMemory, Timestamp),
        (belief, sure): (&Belief, f64),
    ) -> Self {
        let doors = belief
            .world
            .doors
            .iter()
            .filter(|(id, door)| surveyed.doors.get(id).is_some_and(|d| d.state != door.state))
            .map(|(id, door)| (*id, door.state))
            .collect();
        let carried = belief.carried();
        let mut moved = BTreeMap::new();
        for (id, is) in &belief.world.replicas {
            let was = before.replicas.get(id);
            // What nobody knows is no thing of the map that was moved.
            if is_obstacle(*id) {
                continue;
            }
            if was.is_none_or(|was| (was.area, was.frame) != (is.area, is.frame)) {
                moved.insert(*id, Some(Seen { area: is.area, frame: is.frame }));
            }
        }
        for id in before.replicas.keys().filter(|id| carried.contains_key(id)) {
            moved.insert(*id, None);
        }
        moved.extend(belief.missing().iter().map(|id| (*id, None)));
        let holding = belief.held.iter().chain(belief.handed_over.iter().map(|(thing, _)| thing));
        let holding = holding.chain(belief.aboard.iter().map(|(thing, _)| thing));
        let elsewhere = holding.chain(belief.lost());
        let all: Vec<&Replica> = belief.world.replicas.values().chain(elsewhere).collect();
        let is_open = |one: &Replica| Some(stands(surveyed, one)? == DoorStatus::Open);
        let opened = all
            .iter()
            .filter_map(|is| {
                let open = is_open(is)?;
                let was = is_open(surveyed.replicas.get(&is.id)?);
                (was != Some(open)).then_some((is.id, open))
            })
            .gather();
        let devices = all
            .iter()
            .filter_map(|is| {
                let on = is_on(&is.properties)?;
                let was = is_on(&surveyed.replicas.get(&is.id)?.properties);
                (was != Some(on)).then_some((is.id, on))
            })
            .gather();
        let pose = Some((belief.map, belief.pose));
        let stand = belief.world.replicas.keys().filter(|id| is_obstacle(**id));
        let obstacles = stand.filter_map(|&id| {
            let (area, pieces, top) = outline_of(&belief.world, id)?;
            let new = SeenObstacle { area, pieces, top, at: begun, sure };
            // What is as it was remembered was not seen again.
            Some(remembered.obstacles.iter().find(|old| old.is_as(&new)).cloned().unwrap_or(new))
        });
        // Their names follow their order.
        let obstacles = obstacles.rev().collect();
        let memory = RobotMemory {
            pose,
            doors,
            carried,
            devices,
            opened,
            obstacles,
            ..RobotMemory::default()
        };
        Self { memory, moved, sure }
    }
}
