//! What is not where it belongs: the home of a thing is the one that its property names, else where it was surveyed.

use std::collections::{BTreeMap, BTreeSet};

use crate::language::command::Command;
use crate::map::{Entity, Mark, Replica, World};
use crate::robot::facts_of_map;
use crate::semantics::{Relations, predicate};

use super::error::in_both;
use super::task::thing_of;
use super::{Error, RequestError, State};
use crate::units::Gather as _;

/// What stays where it is of what is to be put back, put away or tidied, by name.
#[derive(Debug, Default)]
pub(super) struct Staying {
    /// What has no home, and was moved.
    pub(super) strays: Vec<String>,
    /// What is to be put away and lies where it is kept, with that.
    pub(super) kept: Vec<(String, String)>,
}

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

    /// Commands without what stays where it is of several things that are to be put back or away, and what stays: where
    /// nothing could be put away of all that is named, they are refused instead.
    ///
    /// # Errors
    /// All of them stay, for one reason.
    pub(super) fn staying(
        &self,
        commands: &[Command<Entity>],
        relations: &Relations,
    ) -> Result<(Vec<Command<Entity>>, Staying), Error> {
        let concerns = |command: &Command<Entity>| match command {
            Command::Tidy(_) | Command::Clean(_) | Command::Clear { .. } => true,
            command => matches!(command, Command::PutBack(_) | Command::PutAway(_)),
        };
        if !commands.iter().any(concerns) {
            return Ok((commands.to_vec(), Staying::default()));
        }
        let (world, homes) = (self.world()?, self.homes()?);
        let lie_on = supports(self.uncarried()?, relations);
        let mut staying = Staying::default();
        for command in commands {
            match command {
                Command::Tidy(within) | Command::Clean(within) => {
                    staying.strays.extend(self.strays(*within, relations)?);
                }
                Command::Clear { from, to: None } => {
                    staying.strays.extend(self.strays(Some(*from), relations)?);
                    let own = world.name(*from);
                    let kept = lie_on.iter().filter(|(thing, on)| {
                        *on == own && homes.get(*thing).is_some_and(|home| home == own)
                    });
                    staying.kept.extend(kept.map(|(thing, on)| (thing.clone(), on.clone())));
                }
                _ => {}
            }
        }
        let is_put = |n: &usize| match &commands[*n] {
            Command::PutBack(what) | Command::PutAway(what) => {
                let before = commands[..*n].iter().any(|c| thing_of(c) == Some(what.id));
                let carried =
                    matches!(what.id, Entity::Replica(id) if world.has_trait(id, "portable"));
                carried && !before
            }
            _ => false,
        };
        let put: Vec<usize> = (0..commands.len()).filter(is_put).collect();
        let mut own = Staying::default();
        let mut left = BTreeSet::new();
        let astray = self.strays(None, relations)?;
        for n in put.iter().filter(|_| put.len() > 1) {
            let away = matches!(commands[*n], Command::PutAway(_));
            let Some(thing) = thing_of(&commands[*n]).map(|thing| world.name(thing)) else {
                continue;
            };
            match homes.get(thing) {
                None if away || astray.iter().any(|stray| stray == thing) => {
                    own.strays.push(thing.to_owned());
                }
                // It was never moved.
                None => {}
                Some(home) if away && lie_on.get(thing) == Some(home) => {
                    own.kept.push((thing.to_owned(), home.clone()));
                }
                Some(_) => continue,
            }
            left.insert(*n);
        }
        let both = |name: &String| in_both(world, name);
        match (left.len() == put.len(), own.strays.is_empty(), own.kept.is_empty()) {
            (true, false, true) => {
                let things = own.strays.iter().map(both).collect();
                return Err(RequestError::homeless(things).into());
            }
            (true, true, false) => {
                let things = own.kept.iter().map(|(thing, home)| (both(thing), both(home)));
                return Err(RequestError::at_home(&things.collect::<Vec<_>>()).into());
            }
            _ => {}
        }
        staying.strays.extend(own.strays);
        staying.kept.extend(own.kept);
        let begun = (0..commands.len()).filter(|n| !left.contains(n)).map(|n| commands[n].clone());
        Ok((begun.collect(), staying))
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
        let home = home.ok_or_else(|| RequestError::homeless(vec![in_both(world, thing)]))?;
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
