//! What is not where it belongs: the home of a thing is the one that its property names, else where it was surveyed.

use std::collections::BTreeMap;

use crate::map::{Entity, Mark, World};
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
        let world = self.world()?;
        let homes = self.homes()?;
        let (now, held) = (self.uncarried()?, self.held()?);
        let lie_on = supports(now, relations);
        let is_asked = |thing: &str| match within {
            None => true,
            Some(Entity::Area(area)) => {
                now.replicas.values().any(|r| r.name == thing && r.area == area)
            }
            Some(Entity::Map(map)) => now.replicas.values().any(|r| {
                r.name == thing && world.placement(r.area).is_some_and(|(on, _)| on == map)
            }),
            Some(entity) => lie_on.get(thing).is_some_and(|on| on == world.name(entity)),
        };
        let bins = self.bins()?;
        let is_waste = |thing: &str| {
            let called = now.replicas.values().filter(|one| one.name == thing);
            called.map(|one| one.id).any(|id| bins.iter().any(|bin| relations.is_inside(id, *bin)))
        };
        let is_held = |thing: &str| held.is_some_and(|held| held.name == thing);
        let lies = |thing: &str| now.replicas.values().any(|r| r.name == thing);
        Ok(homes
            .into_iter()
            .filter(|(thing, home)| {
                is_held(thing)
                    || (lies(thing)
                        && is_asked(thing)
                        && lie_on.get(thing) != Some(home)
                        && !is_waste(thing))
            })
            .collect())
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

    /// Where a thing is kept, by name; none where it lies there already.
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
