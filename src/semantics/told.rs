//! What no map says, and a robot knows: where it stands, what it has in view, where it believes things to be, who has
//! what was carried off. It is told, not measured, and only to rule texts that ask for it.

use std::collections::BTreeSet;

use crate::facts::Value;
use crate::geometry::{Blocker, Eye, FloorPlan};
use crate::map::{Entity, World};
use crate::units::{AreaId, MapId, Pose, ReplicaId};

use super::measure::{hundredths, tenths};
use super::names::Subject;
use super::relations::{RelationError, RelationRules, Relations};
use super::thresholds::Thresholds;

/// The relations that are told.
const TOLD: [&str; 4] = [ROBOT_AT, SEES, BELIEVED, CARRIED_BY];
const ROBOT_AT: &str = "robot_at";
const SEES: &str = "sees";
const BELIEVED: &str = "believed";
const CARRIED_BY: &str = "carried_by";
/// Whoever carries what the robot has itself.
const ROBOT: &str = "робот";
/// What looks smaller is not made out, steradians: a matchbox at six metres.
const SPECK: f64 = 2e-5;

/// What a robot knows beside its map.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Told {
    /// Where it stands.
    pub robot: Option<(MapId, Pose)>,
    /// What it has in view there.
    pub in_view: Vec<ReplicaId>,
    /// Where things that were looked for are believed to be, and how surely, as a share of one.
    pub believed: Vec<(ReplicaId, AreaId, f64)>,
    /// What is on no map since it was taken up, and who has it; an empty name for the robot itself.
    pub carried: Vec<(ReplicaId, String)>,
}

impl RelationRules {
    /// Whether the rule text asks what a robot knows.
    #[must_use]
    pub fn asks_the_robot(&self) -> bool {
        TOLD.iter().any(|name| self.asks_for(name))
    }

    /// Whether the rule text asks what the robot has in view.
    #[must_use]
    pub fn asks_for_view(&self) -> bool {
        self.asks_for(SEES)
    }

    /// A relation of the user's own that bears the name is another one.
    fn asks_for(&self, name: &str) -> bool {
        let program = self.program();
        program.relation(name).is_some_and(|id| !program.info(id).inputs.is_empty())
    }
}

impl Relations {
    /// Takes over what a robot knows instead of what it knew before, and derives what follows.
    ///
    /// # Errors
    /// As [`derive()`](super::derive).
    pub fn tell(&mut self, world: &World, told: &Told) -> Result<(), RelationError> {
        let rows = self.told_rows(world, told);
        self.replace_told(rows)
    }

    fn told_rows(&self, world: &World, told: &Told) -> BTreeSet<(&'static str, Vec<Value>)> {
        let symbols = self.symbols();
        let thing = |id: ReplicaId| match symbols.known(Subject::Entity(Entity::Replica(id))) {
            Some(symbol) => Value::Symbol(symbol.clone()),
            // What is carried may have no symbol any more.
            None => Value::from(world.name(Entity::Replica(id))),
        };
        let area = |id: AreaId| Value::Symbol(symbols.area(id).clone());
        let mut rows = BTreeSet::new();
        let mut put = |name: &'static str, row: Vec<Value>| {
            if self.rules().asks_for(name) {
                rows.insert((name, row));
            }
        };
        if let Some((map, pose)) = &told.robot
            && let Some(room) = self.measurements().area_at(*map, pose.at)
        {
            let map = symbols.symbol(Subject::Entity(Entity::Map(*map)));
            let [x, y] = [pose.at.x, pose.at.y].map(|at| Value::Number(tenths(at)));
            let angle = Value::Number(hundredths(pose.heading.get()));
            put(ROBOT_AT, vec![Value::Symbol(map.clone()), area(room), x, y, angle]);
        }
        for &id in told.in_view.iter().filter(|id| world.replicas.contains_key(id)) {
            put(SEES, vec![thing(id)]);
        }
        for &(id, room, sure) in &told.believed {
            if world.replicas.contains_key(&id) && world.areas.contains_key(&room) {
                let sure = Value::Number((sure * 1000.0).round() as i64);
                put(BELIEVED, vec![thing(id), area(room), sure]);
            }
        }
        for (id, holder) in &told.carried {
            let holder = if holder.is_empty() { ROBOT } else { holder };
            put(CARRIED_BY, vec![thing(*id), Value::from(holder)]);
        }
        rows
    }
}

/// The things that one makes out, the nearest first.
#[must_use]
pub fn things_in_view(world: &World, floor: &FloorPlan, eye: &Eye) -> Vec<ReplicaId> {
    let mut seen: Vec<(ReplicaId, f64, f64)> = Vec::new();
    for view in floor.faces(world, eye).in_view(eye) {
        let Blocker::Replica { replica, .. } = view.face.blocker else { continue };
        let size = view.apparent_size(eye);
        match seen.iter_mut().find(|s| s.0 == replica) {
            Some((_, nearest, whole)) => {
                *nearest = nearest.min(view.distance);
                *whole += size;
            }
            None => seen.push((replica, view.distance, size)),
        }
    }
    seen.retain(|(_, _, size)| *size >= SPECK);
    seen.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    seen.into_iter().map(|(id, ..)| id).collect()
}

/// The robot's eye at a pose: at its height over the floor on which it stands.
#[must_use]
pub fn robot_eye(world: &World, floor: &FloorPlan, pose: Pose, near: &Thresholds) -> Eye {
    let stands = floor.scene().area_at(pose.at);
    let room = stands.and_then(|area| floor.scene().areas[&area].prisms.first());
    let height = room.map_or(0.0, |prism| prism.bottom) + world.robot.height.get();
    Eye { pose, height, field: near.robot_field, range: near.robot_sight }
}
