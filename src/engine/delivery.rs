//! Where a thing goes that is to be brought somewhere: onto what was named, or onto what stands in the room that was
//! named and has space for it.

use crate::language::command::{Command, Placement, Relation};
use crate::map::{Entity, World};
use crate::robot::{GoalFact, Hollow, facts_of_map, hollow, spot_on};
use crate::semantics::{Relations, predicate};
use crate::units::{AreaId, InOrder as _, MapId, ReplicaId};

use super::error::{both, in_both};
use super::{Error, Method, RequestError, State};

impl State {
    /// Whether a thing is taken up before it is put where it lies: what lies on top, before it is put in, since to the rules
    /// "on" is both; and what is behind a door, before it is put on top.
    pub(super) fn is_lifted(
        &self,
        thing: Entity,
        to: &Placement<Entity>,
        relations: &Relations,
    ) -> bool {
        let (Entity::Replica(thing), Entity::Replica(holder)) = (thing, to.anchor) else {
            return false;
        };
        let is_inside = || relations.is_inside(thing, holder);
        match to.relation {
            Relation::In => relations.support_of(thing) == Some(holder) && !is_inside(),
            Relation::On => is_inside() && self.has_doors(holder),
            _ => false,
        }
    }

    /// What is to be put where it lies already, and is left there: told, where others are put there, or where it lies inside
    /// and was to be put on top.
    pub(super) fn lying_there(
        &self,
        commands: &[Command<Entity>],
        relations: &Relations,
    ) -> Result<Vec<String>, Error> {
        let world = self.world()?;
        let replica = |entity| match entity {
            Entity::Replica(id) => Some(id),
            _ => None,
        };
        let put: Vec<(usize, ReplicaId, &Placement<Entity>)> = commands
            .iter()
            .enumerate()
            .filter_map(|(n, command)| match command {
                Command::Put { what, to } | Command::Bring { what, to: Some(to) } => {
                    replica(what.id).map(|thing| (n, thing, to))
                }
                _ => None,
            })
            .collect();
        let lies = |(n, thing, to): &(usize, ReplicaId, &Placement<Entity>)| {
            let id = Entity::Replica(*thing);
            let moved = commands[..*n].iter().any(|command| command.places(&id));
            let there = match to.anchor {
                Entity::Replica(holder) => {
                    to.relation != Relation::NextTo
                        && (relations.support_of(*thing) == Some(holder)
                            || relations.is_inside(*thing, holder))
                }
                Entity::Area(area) => relations.area_of(*thing) == Some(area),
                _ => false,
            };
            there && !moved && !self.is_lifted(id, to, relations)
        };
        let (lying, going): (Vec<_>, Vec<_>) = put.into_iter().partition(lies);
        let within = |(_, thing, to): &(usize, ReplicaId, &Placement<Entity>)| {
            to.relation == Relation::On
                && replica(to.anchor).is_some_and(|holder| relations.is_inside(*thing, holder))
        };
        let told = lying.iter().filter(|one| !going.is_empty() || within(one));
        Ok(told.map(|(_, thing, _)| world.name(Entity::Replica(*thing)).to_owned()).collect())
    }
    /// The name of a thing that the robot can carry.
    ///
    /// # Errors
    /// It is no such thing.
    pub(super) fn portable(&self, entity: Entity) -> Result<ReplicaId, Error> {
        let world = self.world()?;
        match entity {
            Entity::Replica(id) if world.has_trait(id, "portable") => Ok(id),
            other => Err(RequestError::NotPortable { name: both(world, other) }.into()),
        }
    }

    /// What is to hold when a thing has been brought to a place.
    ///
    /// # Errors
    /// It cannot be carried, or nothing there can take it.
    pub(super) fn delivered(
        &self,
        thing: Entity,
        to: &Placement<Entity>,
        relations: &Relations,
    ) -> Result<Vec<GoalFact>, Error> {
        let world = self.world()?;
        let id = self.portable(thing)?;
        let name = |e: Entity| world.name(e).to_owned();
        let fact = |predicate: &str, anchor: Entity| {
            vec![GoalFact {
                predicate: predicate.to_owned(),
                args: vec![name(thing), name(anchor)],
            }]
        };
        match (to.relation, to.anchor) {
            // What is brought to a person is given to him; nothing is put on him.
            (Relation::At | Relation::NextTo, Entity::Replica(person))
                if world.has_trait(person, "person") =>
            {
                Ok(fact(predicate::HANDED_OVER, to.anchor))
            }
            (_, Entity::Replica(person)) if world.has_trait(person, "person") => {
                Err(RequestError::NotPutThere { name: in_both(world, &name(to.anchor)) }.into())
            }
            (Relation::In, Entity::Replica(support)) => {
                if !self.must_be_opened(support)? {
                    return Ok(fact(predicate::THING_ON, to.anchor));
                }
                let shut = GoalFact {
                    predicate: predicate::STANDS_SHUT.to_owned(),
                    args: vec![name(to.anchor)],
                };
                Ok([fact(predicate::THING_IN, to.anchor), vec![shut]].concat())
            }
            // «поближе к телефону»: nothing is put onto what bears nothing.
            (Relation::At, Entity::Replica(anchor)) if !self.bears(anchor) => {
                self.laid_beside(name(thing), anchor, relations)
            }
            // "to the table": what is carried to a table is put onto it.
            (Relation::On | Relation::At | Relation::Middle, Entity::Replica(_)) => {
                Ok(fact(predicate::THING_ON, to.anchor))
            }
            (_, Entity::Place(_)) => Ok(fact(predicate::THING_AT_PLACE, to.anchor)),
            (Relation::NextTo, Entity::Replica(anchor)) => {
                self.laid_beside(name(thing), anchor, relations)
            }
            (Relation::On | Relation::In | Relation::At | Relation::Middle, Entity::Area(area)) => {
                self.laid_in_area(id, area, relations)
            }
            (Relation::On | Relation::In | Relation::At, Entity::Map(map)) => {
                self.laid_on_storey(id, map, relations)
            }
            (_, anchor) => {
                Err(RequestError::NotPutThere { name: in_both(world, &name(anchor)) }.into())
            }
        }
    }

    /// Whether a thing is made to bear or hold others.
    pub(super) fn bears(&self, id: ReplicaId) -> bool {
        let Ok(world) = self.world() else { return false };
        let has = |wanted: &&str| world.has_trait(id, wanted);
        let is_made_to = ["support", "container", "seat", "bed"].iter().any(has);
        is_made_to || !["portable", "device", "light"].iter().any(has)
    }

    /// A thing that is to be beside another: on what that one stands on or is let into, as a sink is into a counter, else on the
    /// floor before it.
    fn laid_beside(
        &self,
        thing: String,
        anchor: ReplicaId,
        relations: &Relations,
    ) -> Result<Vec<GoalFact>, Error> {
        let world = self.world()?;
        let name = world.name(Entity::Replica(anchor)).to_owned();
        let facts = facts_of_map(self.uncarried()?, relations);
        let about = |predicate: &str, at: usize, give: usize| {
            let found =
                facts.iter().find(|f| f.predicate == predicate && f.arguments[at].name == name);
            found.map(|f| f.arguments[give].name.clone())
        };
        let serves = |id: &ReplicaId| *id != anchor && world.has_trait(*id, "support");
        let holder = || {
            let around = world.replicas.keys().filter(|id| relations.is_inside(anchor, **id));
            relations.support_of(anchor).into_iter().chain(around.copied()).find(serves)
        };
        let support = about(predicate::THING_ON, 0, 1)
            .or_else(|| holder().map(|id| world.name(Entity::Replica(id)).to_owned()));
        let (predicate, where_to) = match support {
            Some(support) => (predicate::THING_ON, support),
            None => {
                let place = about(predicate::THING_AT_PLACE, 0, 1)
                    .or_else(|| about(predicate::PLACE_BY, 1, 0))
                    .ok_or_else(|| RequestError::NotAPlace { name: in_both(world, &name) })?;
                (predicate::THING_AT_PLACE, place)
            }
        };
        let args = vec![thing, where_to];
        Ok(vec![GoalFact { predicate: predicate.to_owned(), args }])
    }

    /// Of a command that puts a thing into another: the names of both.
    pub(super) fn put_into(&self, command: &Command<Entity>) -> Option<(String, String)> {
        let world = self.world().ok()?;
        match command {
            Command::Bring { what, to: Some(to) } | Command::Put { what, to }
                if to.relation == Relation::In && matches!(to.anchor, Entity::Replica(_)) =>
            {
                Some((world.name(what.id).to_owned(), world.name(to.anchor).to_owned()))
            }
            _ => None,
        }
    }

    /// Whether a thing into which others can be put is shut, and the robot opens it.
    ///
    /// # Errors
    /// It has no inside, or the robot does not get in.
    pub(super) fn must_be_opened(&self, support: ReplicaId) -> Result<bool, Error> {
        let world = self.world()?;
        let name = || both(world, Entity::Replica(support));
        let around = self.around()?;
        let now = around.uncarried();
        let area = now.replicas.get(&support).map(|r| r.area);
        let map = area.and_then(|area| now.placement(area)).map(|(map, _)| map);
        let hollow = match map {
            Some(map) => hollow(now, around.floor(map)?.scene(), support),
            None => Hollow::No,
        };
        match hollow {
            Hollow::Open => Ok(false),
            Hollow::Shut if self.can_open(support) => Ok(true),
            Hollow::Shut => Err(RequestError::Shut { name: name() }.into()),
            Hollow::No => Err(RequestError::NotHollow { name: name() }.into()),
        }
    }

    /// A thing that is to lie in an Area: it stays where it is when it lies there, else goes onto the thing to which
    /// the way is the shortest of those that have space for it, a table before a chair, else to a place of the map.
    fn laid_in_area(
        &self,
        thing: ReplicaId,
        area: AreaId,
        relations: &Relations,
    ) -> Result<Vec<GoalFact>, Error> {
        let world = self.world()?;
        let name = world.name(Entity::Replica(thing)).to_owned();
        let facts = facts_of_map(self.uncarried()?, relations);
        if relations.area_of(thing) == Some(area) {
            let lies = |p: &str| p == predicate::THING_ON || p == predicate::THING_AT_PLACE;
            let here = facts.iter().find(|f| lies(f.predicate) && f.arguments[0].name == name);
            return Ok(here
                .map(|f| GoalFact {
                    predicate: f.predicate.to_owned(),
                    args: f.arguments.iter().map(|a| a.name.clone()).collect(),
                })
                .into_iter()
                .collect());
        }
        // What stands on another thing, as a toaster does, bears things where it is made for that.
        let now = self.uncarried()?;
        let serves =
            |id: ReplicaId| now.has_trait(id, "support") || relations.support_of(id).is_none();
        let bears =
            |id: ReplicaId| !now.has_trait(id, "portable") && serves(id) && self.takes(id, thing);
        let reached = |id: ReplicaId| {
            let support = world.name(Entity::Replica(id));
            facts
                .iter()
                .any(|f| f.predicate == predicate::PLACE_BY && f.arguments[1].name == support)
        };
        let in_area = |id: &ReplicaId| relations.area_of(*id) == Some(area);
        let supports = now.replicas.keys().copied().filter(in_area);
        let supports = supports.filter(|id| reached(*id) && bears(*id)).map(Entity::Replica);
        let places = now.places.values().filter(|p| p.area == area);
        let places = places.map(|p| Entity::Place(p.id));
        for (predicate, anchors) in [
            (predicate::THING_ON, supports.collect::<Vec<_>>()),
            (predicate::THING_AT_PLACE, places.collect()),
        ] {
            let ranked = anchors.into_iter().map(|e| (unfit(now, e), self.way_to(e), e));
            let best = ranked.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
            if let Some((_, _, anchor)) = best {
                let args = vec![name, world.name(anchor).to_owned()];
                return Ok(vec![GoalFact { predicate: predicate.to_owned(), args }]);
            }
        }
        let area = both(world, Entity::Area(area));
        Err(RequestError::NoSpace { thing: in_both(world, &name), area }.into())
    }

    /// A thing that is to be on a storey: it stays where it is when it is there, else goes into the room nearest to
    /// where a lift arrives that can take it.
    fn laid_on_storey(
        &self,
        thing: ReplicaId,
        map: MapId,
        relations: &Relations,
    ) -> Result<Vec<GoalFact>, Error> {
        let world = self.world()?;
        let on_storey = |area: &AreaId| world.placement(*area).is_some_and(|(on, _)| on == map);
        if let Some(area) = relations.area_of(thing).filter(on_storey) {
            return self.laid_in_area(thing, area, relations);
        }
        let stops: Vec<AreaId> =
            world.domain.lifts.iter().flat_map(|(_, stops)| stops).map(|s| s.area).collect();
        let beside_lift = |area: AreaId| {
            let joins = |one: AreaId| {
                relations.joins().iter().any(|j| {
                    let ends = [j.from, j.to];
                    ends.contains(&one) && ends.contains(&area)
                })
            };
            stops.iter().copied().any(joins)
        };
        let mut rooms: Vec<AreaId> = world.areas.keys().copied().filter(on_storey).collect();
        rooms.retain(|area| !stops.contains(area));
        rooms.order_by_key(|area| !beside_lift(*area));
        for area in rooms {
            match self.laid_in_area(thing, area, relations) {
                Err(Error::Request(RequestError::NoSpace { .. })) => {}
                laid => return laid,
            }
        }
        let [area, thing] =
            [Entity::Map(map), Entity::Replica(thing)].map(|entity| both(world, entity));
        Err(RequestError::NoSpace { thing, area }.into())
    }

    /// Whether a thing has space for another, where the robot can reach it.
    fn takes(&self, support: ReplicaId, thing: ReplicaId) -> bool {
        let space = || {
            let around = self.around().ok()?;
            let now = around.uncarried();
            let (map, _) = now.placement(now.replicas.get(&support)?.area)?;
            let (_, pose) = self.robot().ok()?;
            // With what the robot carries, which stands nowhere now; its shape is the same.
            let world = around.world();
            let frame = spot_on(world, around.floor(map).ok()?.scene(), thing, support, pose.at)?;
            Some(frame.z <= now.robot.height)
        };
        space().unwrap_or(false)
    }

    /// Length of the way from the robot, cm; infinite where there is none on this floor.
    pub(super) fn way_to(&self, entity: Entity) -> f64 {
        let way = || {
            let (around, (map, pose)) = (self.around().ok()?, self.robot().ok()?);
            let goal = around.locate_entity(entity).ok().filter(|goal| goal.map == map)?;
            let floor = around.floor(map).ok()?;
            Some(
                floor
                    .route(around.uncarried(), pose.at, goal.target, Method::Shortest)
                    .ok()?
                    .length,
            )
        };
        way().unwrap_or(f64::INFINITY)
    }
}

/// How unfit a thing is to be put on: what is made to bear things before others, and seats last.
fn unfit(world: &World, entity: Entity) -> u8 {
    match entity {
        Entity::Replica(id) if world.has_trait(id, "seat") => 2,
        Entity::Replica(id) if !world.has_trait(id, "support") => 1,
        _ => 0,
    }
}
