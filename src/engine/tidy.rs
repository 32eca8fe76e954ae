//! What is not where it belongs: the home of a thing is the one that its property names, else where it was surveyed.

use std::collections::BTreeMap;

use crate::map::{Entity, Mark, Replica, World};
use crate::robot::facts_of_map;
use crate::semantics::{Relations, predicate};

use super::error::in_both;
use super::{Error, RequestError, State};
use crate::units::Gather as _;

impl State {
    /// The things that are not where they belong, each with the name of its home, in the order of their names.
    ///
    /// Within an Area, those that lie in it; on a thing, those that lie on it. What the robot holds is misplaced
    /// everywhere. A thing that was surveyed on the floor, and one that bears another, have no home.
    pub(super) fn misplaced(
        &self,
        within: Option<Entity>,
        relations: &Relations,
    ) -> Result<Vec<(String, String)>, Error> {
        let (lie_on, is_out) = (supports(self.uncarried()?, relations), self.is_out(relations)?);
        let is_asked = self.is_asked(within, relations)?;
        let held = self.held()?;
        let is_held = |thing: &str| held.is_some_and(|held| held.name == thing);
        Ok(self
            .homes()?
            .into_iter()
            .filter(|(thing, home)| {
                is_held(thing)
                    || is_asked(thing) && lie_on.get(thing) != Some(home) && is_out(thing)
            })
            .collect())
    }

    /// Whether a thing of this name lies where it is asked for: anywhere, in an Area, on a storey, on a thing.
    fn is_asked(
        &self,
        within: Option<Entity>,
        relations: &Relations,
    ) -> Result<impl Fn(&str) -> bool, Error> {
        let (world, now) = (self.world()?, self.uncarried()?);
        let lie_on = supports(now, relations);
        Ok(move |thing: &str| {
            let mut called = now.replicas.values().filter(|replica| replica.name == thing);
            match within {
                None => called.next().is_some(),
                Some(Entity::Area(area)) => called.any(|replica| replica.area == area),
                Some(Entity::Map(map)) => called
                    .any(|replica| world.placement(replica.area).is_some_and(|(on, _)| on == map)),
                Some(entity) => lie_on.get(thing).is_some_and(|on| on == world.name(entity)),
            }
        })
    }

    /// Whether no thing of this name was thrown away.
    fn is_out(&self, relations: &Relations) -> Result<impl Fn(&str) -> bool, Error> {
        let (now, bins) = (self.uncarried()?, self.bins()?);
        Ok(move |thing: &str| {
            let mut called = now.replicas.values().filter(|replica| replica.name == thing);
            !called.any(|one| bins.iter().any(|bin| relations.is_inside(one.id, *bin)))
        })
    }

    /// The names of things that have no home, and are elsewhere than they were surveyed.
    pub(super) fn strays(
        &self,
        within: Option<Entity>,
        relations: &Relations,
    ) -> Result<Vec<String>, Error> {
        let (world, now, homes) = (self.world()?, self.uncarried()?, self.homes()?);
        let (is_asked, is_out) = (self.is_asked(within, relations)?, self.is_out(relations)?);
        let is_held = |id| self.held().is_ok_and(|held| held.is_some_and(|held| held.id == id));
        let is_astray = |thing: &&Replica| match now.replicas.get(&thing.id) {
            Some(there) => {
                (there.area, &there.frame) != (thing.area, &thing.frame)
                    && is_asked(&thing.name)
                    && is_out(&thing.name)
            }
            None => is_held(thing.id),
        };
        let carried = world.replicas.values().filter(|t| world.has_trait(t.id, "portable"));
        let homeless = carried.filter(|thing| !homes.contains_key(&thing.name));
        Ok(homeless.filter(is_astray).map(|thing| thing.name.clone()).collect())
    }

    /// The names of what lies on a thing and can be carried.
    pub(super) fn lying_on(
        &self,
        thing: Entity,
        relations: &Relations,
    ) -> Result<Vec<String>, Error> {
        let name = self.world()?.name(thing);
        let lying = supports(self.uncarried()?, relations).into_iter();
        Ok(lying.filter(|(_, on)| on == name).map(|(thing, _)| thing).collect())
    }

    /// Where a thing is kept, by name; none where it lies there already, or was never moved from where it was surveyed.
    ///
    /// # Errors
    /// It has no home.
    pub(super) fn home_of(
        &self,
        thing: &str,
        relations: &Relations,
    ) -> Result<Option<String>, Error> {
        let world = self.world()?;
        let home = self.homes()?.remove(thing);
        let home = home.ok_or_else(|| RequestError::Homeless { thing: in_both(world, thing) })?;
        Ok((supports(self.uncarried()?, relations).get(thing) != Some(&home)).then_some(home))
    }

    /// The names of all things that have a home, with its name.
    pub(super) fn homes(&self) -> Result<BTreeMap<String, String>, Error> {
        let world = self.world()?;
        let mut homes = supports(world, self.relations()?);
        for replica in world.replicas.values() {
            let Some((_, kept)) = Mark::KeptOn.of(&replica.properties) else { continue };
            let is_thing = |e: &Entity| matches!(e, Entity::Replica(_));
            let Some(home) = world.find(kept).into_iter().find(is_thing) else {
                let (thing, home) = (in_both(world, &replica.name), kept.to_owned());
                return Err(RequestError::NoHome { thing, home }.into());
            };
            homes.insert(replica.name.clone(), world.name(home).to_owned());
        }
        Ok(homes)
    }
}

/// What each thing that can be carried lies on or in, by name.
fn supports(world: &World, relations: &Relations) -> BTreeMap<String, String> {
    facts_of_map(world, relations)
        .into_iter()
        .filter(|fact| fact.predicate == predicate::THING_ON)
        .filter_map(|fact| {
            let [thing, on] = <[_; 2]>::try_from(fact.arguments).ok()?;
            Some((thing.name, on.name))
        })
        .gather()
}
