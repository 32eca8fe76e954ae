//! Orders about what opens and shuts by itself (cupboards, fridges, drawers, boxes), and about what is thrown away.
//!
//! Invariant: what the robot cannot open is told before it moves.

use crate::language::question::Extension;
use crate::map::{DoorStatus, Entity, Replica, World, stands};
use crate::robot::{Belief, GoalFact};
use crate::semantics::predicate;
use crate::units::ReplicaId;

use super::error::in_both;
use super::{Error, RequestError, State};

impl State {
    /// Whether a thing stands shut and the robot opens it: its profile says so, its rules know how, and there is no lock.
    pub(super) fn can_open(&self, thing: ReplicaId) -> bool {
        let Ok(now) = self.uncarried() else { return false };
        let status = now.replicas.get(&thing).and_then(|it| stands(now, it));
        self.opens_furniture() && status == Some(DoorStatus::Closed)
    }

    /// Whether a thing has doors, a lid or drawers, so that in it is not on it.
    pub(super) fn has_doors(&self, thing: ReplicaId) -> bool {
        let status = |now: &World| now.replicas.get(&thing).and_then(|it| stands(now, it));
        self.uncarried().ok().and_then(status).is_some()
    }

    fn opens_furniture(&self) -> bool {
        let knows_how = self.rules.robot.predicate(predicate::STANDS_SHUT).is_some();
        knows_how && self.world().is_ok_and(|world| world.robot.opens)
    }

    /// What holds when a thing stands open or shut; nothing where it does. None for what neither opens nor shuts.
    ///
    /// # Errors
    /// The robot does not open such things, or it is locked.
    pub(super) fn furniture_stands(
        &self,
        thing: Entity,
        open: bool,
    ) -> Result<Option<Vec<GoalFact>>, Error> {
        let Entity::Replica(id) = thing else { return Ok(None) };
        let now = self.uncarried()?;
        let status = now.replicas.get(&id).and_then(|it| stands(now, it));
        let Some(status) = status else { return Ok(None) };
        if (status == DoorStatus::Open) == open {
            return Ok(Some(Vec::new()));
        }
        let world = self.world()?;
        let name = world.name(thing).to_owned();
        if !self.opens_furniture() {
            return Err(RequestError::NotADoor { name: in_both(world, &name) }.into());
        }
        if status == DoorStatus::Locked {
            return Err(RequestError::Locked { name: in_both(world, &name) }.into());
        }
        let predicate = if open { predicate::STANDS_OPEN } else { predicate::STANDS_SHUT };
        Ok(Some(vec![GoalFact { predicate: predicate.to_owned(), args: vec![name] }]))
    }

    /// What holds when a thing has been thrown away: into any bin, and those that are shut now are shut then.
    ///
    /// # Errors
    /// It cannot be carried, or the map has no bin that the robot gets into.
    pub(super) fn thrown_away(
        &self,
        thing: Entity,
        belief: &mut Belief,
    ) -> Result<Vec<GoalFact>, Error> {
        let id = self.portable(thing)?;
        let world = self.world()?;
        let name = world.name(thing).to_owned();
        let mut goal = vec![GoalFact {
            predicate: predicate::THROWN_AWAY.to_owned(),
            args: vec![name.clone()],
        }];
        let mut locked = None;
        for bin in self.bins()?.into_iter().filter(|bin| *bin != id) {
            let called = world.name(Entity::Replica(bin)).to_owned();
            match self.must_be_opened(bin) {
                Ok(is_shut) => {
                    let args = vec![called.clone()];
                    let predicate = predicate::STANDS_SHUT.to_owned();
                    goal.extend(is_shut.then_some(GoalFact { predicate, args }));
                    belief.into.insert((name.clone(), called.clone()));
                }
                // What is drawn solid takes things on its top.
                Err(Error::Request(RequestError::NotHollow { .. })) => {}
                Err(error) => {
                    locked = Some(error);
                    continue;
                }
            }
            belief.bins.insert(called);
        }
        match (belief.bins.is_empty(), locked) {
            (false, _) => Ok(goal),
            (true, Some(error)) => Err(error),
            (true, None) => Err(RequestError::NoBin { thing: in_both(world, &name) }.into()),
        }
    }

    /// What people throw things into, by the words of their kinds.
    ///
    /// # Errors
    /// There is no map.
    pub(super) fn bins(&self) -> Result<Vec<ReplicaId>, Error> {
        let (now, kinds) = (self.uncarried()?, self.mind()?.lexicon.bins());
        let of_kind = |one: &&Replica| {
            let kind = now.objects.get(&one.object).and_then(|object| object.object_type);
            kinds.iter().any(|extension| match extension {
                Extension::ObjectType(wanted) => Some(*wanted) == kind,
                Extension::Object(wanted) => *wanted == one.object,
                _ => false,
            })
        };
        Ok(now.replicas.values().filter(of_kind).map(|one| one.id).collect())
    }
}
