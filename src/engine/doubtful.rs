//! What is known beforehand of the things of an order: that they are behind doors that are shut, and how sure it is where
//! they are.
//!
//! Invariant: a place in which the robot is less sure than the rule text asks (the threshold «belief told») is never
//! told, or acted upon, as a fact.

use std::time::SystemTime;

use crate::language::command::Command;
use crate::map::Entity;
use crate::robot::GoalFact;
use crate::semantics::{Relations, predicate};
use crate::units::ReplicaId;

use super::error::in_both;
use super::task::thing_of;
use super::{Error, RequestError, State};

impl State {
    /// How sure the robot is of where a thing is, 0..=1, where that is less than what is told as a fact.
    pub(super) fn doubted(&self, thing: ReplicaId) -> Option<f64> {
        let reader = self.reader.as_ref()?;
        let replica = self.world().ok()?.replicas.get(&thing)?;
        let belief = reader.belief(replica, SystemTime::now().into()).ok()?;
        let told = self.relations().ok()?.thresholds().belief_told;
        (belief.confidence < told).then_some(belief.confidence)
    }

    /// The things that an order speaks of and a goal is about, of which the robot is not sure where they are.
    pub(super) fn unsure_of(
        &self,
        commands: &[Command<Entity>],
        goals: &[Vec<GoalFact>],
    ) -> Result<Vec<(ReplicaId, f64)>, Error> {
        // A rule file that knows no searching cannot be asked to search.
        if self.rules.robot.predicate(predicate::FOUND).is_none() {
            return Ok(Vec::new());
        }
        let mut unsure: Vec<(ReplicaId, f64)> = Vec::new();
        for id in self.carried_by(commands, goals)? {
            let lies_somewhere = self.uncarried()?.replicas.contains_key(&id);
            if let Some(sure) = self.doubted(id).filter(|_| lies_somewhere)
                && unsure.iter().all(|(other, _)| *other != id)
            {
                unsure.push((id, sure));
            }
        }
        Ok(unsure)
    }

    /// What is to be carried and is behind doors that are shut is taken out, and the doors are shut again, by a robot that
    /// opens furniture.
    ///
    /// # Errors
    /// [`RequestError::ShutIn`] for one that does not, and for what is locked.
    pub(super) fn shut_again(
        &self,
        commands: &[Command<Entity>],
        goals: &mut [Vec<GoalFact>],
        relations: &Relations,
    ) -> Result<(), Error> {
        let world = self.world()?;
        let name = |id| world.name(Entity::Replica(id)).to_owned();
        for id in self.carried_by(commands, goals)? {
            let Some(around) = relations.shut_in(id) else { continue };
            if !self.can_open(around) {
                let [thing, container] = [id, around].map(|id| in_both(world, &name(id)));
                return Err(RequestError::ShutIn { thing, container }.into());
            }
            let shut =
                GoalFact { predicate: predicate::STANDS_SHUT.to_owned(), args: vec![name(around)] };
            let thing = name(id);
            let speaks = |goal: &&mut Vec<GoalFact>| {
                goal.iter().any(|fact| fact.args.first() == Some(&thing))
            };
            if let Some(goal) = goals.iter_mut().find(speaks)
                && !goal.contains(&shut)
            {
                goal.push(shut);
            }
        }
        Ok(())
    }

    /// What something is to be put into or taken out of, and stands in something shut itself, a drawer in a wardrobe: that
    /// is opened before, the outermost first, while the hand is free, and shut again behind.
    pub(super) fn opened_around(
        &self,
        goals: Vec<Vec<GoalFact>>,
        relations: &Relations,
    ) -> Result<Vec<Vec<GoalFact>>, Error> {
        let world = self.world()?;
        let replica = |entity| match entity {
            Entity::Replica(id) => Some(id),
            _ => None,
        };
        let stands = |predicate: &str, id: &ReplicaId| {
            let args = vec![world.name(Entity::Replica(*id)).to_owned()];
            vec![GoalFact { predicate: predicate.to_owned(), args }]
        };
        let mut all = Vec::new();
        for goal in goals {
            let shut = goal.iter().filter(|fact| fact.predicate == predicate::STANDS_SHUT);
            let inner = shut.filter_map(|fact| fact.args.first()).filter(|_| goal.len() > 1);
            let mut around: Vec<ReplicaId> = Vec::new();
            for inner in inner.filter_map(|name| world.find(name).into_iter().find_map(replica)) {
                let outer = |at: &ReplicaId| relations.shut_in(*at).filter(|id| self.can_open(*id));
                let mut next = outer(&inner);
                while let Some(id) = next.filter(|id| !around.contains(id)) {
                    around.push(id);
                    next = outer(&id);
                }
            }
            all.extend(around.iter().rev().map(|id| stands(predicate::STANDS_OPEN, id)));
            all.push(goal);
            all.extend(around.iter().map(|id| stands(predicate::STANDS_SHUT, id)));
        }
        Ok(all)
    }

    /// The things that commands order to be carried, where something is to be done for that.
    fn carried_by(
        &self,
        commands: &[Command<Entity>],
        goals: &[Vec<GoalFact>],
    ) -> Result<Vec<ReplicaId>, Error> {
        let world = self.world()?;
        let carries = |command: &&Command<Entity>| {
            matches!(
                command,
                Command::Bring { .. }
                    | Command::Take { .. }
                    | Command::Put { .. }
                    | Command::SetDown { .. }
                    | Command::PutBack(_)
                    | Command::PutAway(_)
                    | Command::ThrowAway(_)
            )
        };
        let things = commands.iter().filter(carries).filter_map(thing_of);
        let is_wanted = |id: &ReplicaId| {
            let name = world.name(Entity::Replica(*id));
            goals.iter().flatten().any(|fact| fact.args.first().is_some_and(|arg| arg == name))
        };
        let replicas = things.filter_map(|entity| match entity {
            Entity::Replica(id) if world.has_trait(id, "portable") => Some(id),
            _ => None,
        });
        Ok(replicas.filter(is_wanted).collect())
    }
}
