//! From commands to goals: what is to hold when each is done, in the order in which they were given.

use std::collections::{BTreeSet, VecDeque};

use crate::language::command::{Command, Relation};
use crate::map::{DoorStatus, Entity};
use crate::robot::{Belief, GoalFact, Station, facts_of_map};
use crate::semantics::{Relations, lifts, predicate, storey_name};
use crate::units::{AreaId, DoorId, Gather as _};

use super::directive_words::floor_place;
use super::error::{both, in_both};
use super::task::{OPERATOR, thing_of};
use super::{Error, RequestError, State};

/// Commands of one kind that are planned together, at most: «Закрой все двери». More are done so many after so many, since
/// the best order of many is not worth the wait; what was done before is to hold still.
const TOGETHER: usize = 3;

impl State {
    /// What is to hold, one goal after the other. `here` is the place where the commands were given.
    pub(super) fn goals_of(
        &self,
        commands: &[Command<Entity>],
        here: &str,
        relations: &Relations,
        belief: &mut Belief,
    ) -> Result<Vec<Vec<GoalFact>>, Error> {
        self.one_at_the_end(commands)?;
        let mut goals: Vec<Vec<GoalFact>> = Vec::new();
        let mut joined: Vec<&Command<Entity>> = Vec::new();
        for (n, command) in commands.iter().enumerate() {
            if is_part_of_what_follows(commands, n) || goes_on_within(&commands[n..], relations) {
                continue;
            }
            // «Возьми тарелку и верни на место», «… и убери»: it lies there now, and will not then.
            let lifted = match command {
                Command::PutBack(what) | Command::PutAway(what) => Some(what)
                    .filter(|what| commands[..n].iter().any(|c| thing_of(c) == Some(what.id))),
                _ => None,
            };
            let back = lifted.map(|what| Command::PutBack(what.clone()));
            let asked = back.as_ref().unwrap_or(command);
            let mut wanted = self.goals_of_one(asked, here, relations, belief)?;
            if let (Some(what), true) = (lifted, wanted.is_empty()) {
                wanted = self.put_back(what.id, belief)?;
            }
            // What is not locked is unlocked already, and what is locked is closed: each order asks for its own part only.
            let locked = |what: Entity| match what {
                Entity::Replica(_) => Ok(false),
                door => self.is_locked_by(&commands[..n], door),
            };
            match command {
                Command::Unlock(what) if !locked(what.id)? => wanted.clear(),
                Command::Close(what) if !wanted.is_empty() && locked(what.id)? => wanted.clear(),
                _ => {}
            }
            // What is so already joins nothing, and nothing is joined to it.
            if wanted.is_empty() {
                continue;
            }
            let is_alike = joined.last().is_some_and(|last| are_done_together(last, command));
            match (is_alike, goals.last_mut(), &wanted[..]) {
                (true, Some(goal), [facts]) if joined.len() < TOGETHER => {
                    goal.extend(facts.iter().cloned());
                    joined.push(command);
                }
                (true, Some(before), [facts]) => {
                    let goal = before.iter().chain(facts).cloned().collect();
                    goals.push(goal);
                    joined = vec![command];
                }
                _ => {
                    joined = vec![command];
                    goals.extend(wanted);
                }
            }
        }
        goals.retain(|goal| !goal.is_empty());
        Ok(goals)
    }

    /// Of what is taken and put nowhere, the one hand holds one thing.
    fn one_at_the_end(&self, commands: &[Command<Entity>]) -> Result<(), Error> {
        let is_left = |n: usize| match &commands[n] {
            Command::Take { what } => !commands[n + 1..].iter().any(|later| match later {
                Command::Bring { what: brought, .. } => brought.id == what.id,
                later => later.places(&what.id),
            }),
            _ => false,
        };
        let held = (0..commands.len()).filter(|n| is_left(*n));
        let held: BTreeSet<Entity> = held.filter_map(|n| thing_of(&commands[n])).collect();
        if held.len() < 2 {
            return Ok(());
        }
        let world = self.world()?;
        let things = held.into_iter().map(|thing| both(world, thing)).collect();
        Err(RequestError::OneHand { things }.into())
    }

    fn goals_of_one(
        &self,
        command: &Command<Entity>,
        here: &str,
        relations: &Relations,
        belief: &mut Belief,
    ) -> Result<Vec<Vec<GoalFact>>, Error> {
        let world = self.world()?;
        let name = |e: Entity| world.name(e).to_owned();
        let both = |e: Entity| both(world, e);
        let one = |fact: GoalFact| vec![vec![fact]];
        Ok(match command {
            Command::GoTo { to, via, facing } => {
                let goal = vec![self.standing(to, facing.as_ref(), relations, belief)?];
                match via {
                    Some(Entity::Door(door)) => {
                        let mut goals = self.through(*door, relations)?;
                        goals.push(goal);
                        goals
                    }
                    // «через кухню»
                    Some(place) => vec![vec![self.being_at(*place, relations)?], goal],
                    None => vec![goal],
                }
            }
            Command::Face(facing) => one(self.turned_here(facing, belief)?),
            Command::GoThrough(Entity::Door(door)) => self.through(*door, relations)?,
            Command::GoThrough(place) => one(self.being_at(*place, relations)?),
            Command::Leave(place) => {
                let here = self.robot_area()?.map(Entity::Area);
                match place {
                    Some(left) if matches!(left, Entity::Area(_)) && Some(*left) != here => {
                        Vec::new()
                    }
                    _ => one(self.outside(relations)?),
                }
            }
            Command::Charge => {
                let charger = self.charger()?;
                one(self.being_at(charger, relations)?)
            }
            Command::GoHome => {
                let start = world.robot.start.ok_or(RequestError::NoStart)?;
                one(self.being_at(Entity::Place(start), relations)?)
            }
            Command::ComeHere | Command::ComeBack => {
                one(fact(predicate::ROBOT_AT_PLACE, vec![here.to_owned()]))
            }
            Command::Bring { what, to: None } => {
                self.portable(what.id)?;
                one(fact(predicate::HANDED_OVER, vec![name(what.id), OPERATOR.to_owned()]))
            }
            Command::Bring { what, to: Some(to) } | Command::Put { what, to } => {
                let near = match (to.relation, to.anchor) {
                    (_, Entity::Replica(person)) if world.has_trait(person, "person") => false,
                    (Relation::NextTo | Relation::Middle, _) => true,
                    (Relation::At, Entity::Replica(anchor)) => !self.bears(anchor),
                    _ => false,
                };
                if near {
                    belief.beside.insert((name(what.id), name(to.anchor)));
                }
                let delivered = self.delivered(what.id, to, relations)?;
                let lifted = self.is_lifted(what.id, to, relations);
                let held = lifted.then(|| vec![fact(predicate::ROBOT_HOLDS, vec![name(what.id)])]);
                held.into_iter().chain([delivered]).collect()
            }
            Command::SetDown { what, within } => {
                // What a person has does not lie on the floor where he stands.
                let given =
                    belief.handed_over.iter().any(|(r, _)| Entity::Replica(r.id) == what.id);
                let held = given.then(|| vec![fact(predicate::ROBOT_HOLDS, vec![name(what.id)])]);
                held.into_iter()
                    .chain([self.set_down(what.id, *within, relations, belief)?])
                    .collect()
            }
            Command::Take { what } => {
                self.portable(what.id)?;
                one(fact(predicate::ROBOT_HOLDS, vec![name(what.id)]))
            }
            Command::PutBack(what) | Command::PutAway(what) => match what.id {
                Entity::Replica(id) if world.has_trait(id, "portable") => {
                    let Some(home) = self.home_of(&name(what.id), relations)? else {
                        return match (command, self.homes()?.remove(&name(what.id))) {
                            (Command::PutAway(_), Some(home)) => {
                                let things = vec![(both(what.id), in_both(world, &home))];
                                Err(RequestError::at_home(&things).into())
                            }
                            _ => Ok(Vec::new()),
                        };
                    };
                    belief.homes.push((name(what.id), home));
                    one(fact(predicate::IN_ITS_PLACE, vec![name(what.id)]))
                }
                place => self.tidied(Some(place), relations, belief)?,
            },
            Command::Find(what) => match what.id {
                Entity::Replica(_) => one(fact(predicate::FOUND, vec![name(what.id)])),
                place => one(self.being_at(place, relations)?),
            },
            // What is no door is neither opened nor closed; if it is so already, nothing is to be done.
            Command::Open(thing) | Command::Close(thing) => {
                let open = matches!(command, Command::Open(_));
                let state = if open { predicate::DOOR_OPEN } else { predicate::DOOR_CLOSED };
                match self.furniture_stands(thing.id, open)? {
                    Some(goal) => vec![goal],
                    None => vec![self.door_facts(state, thing.id)?],
                }
            }
            Command::ThrowAway(what) => vec![self.thrown_away(what.id, belief)?],
            Command::Lock(door) => vec![self.door_facts(predicate::DOOR_LOCKED, door.id)?],
            Command::Unlock(door) => vec![self.door_facts(predicate::DOOR_CLOSED, door.id)?],
            Command::SwitchOn(device) => one(self.switched(predicate::DEVICE_ON, device.id)?),
            Command::SwitchOff(device) => one(self.switched(predicate::DEVICE_OFF, device.id)?),
            Command::CallLift => one(self.cabin_here(relations)?),
            Command::CallOperator => one(fact(predicate::CALLED, vec![OPERATOR.to_owned()])),
            Command::Clean(Some(thing @ Entity::Replica(_))) => {
                return Err(RequestError::NotCleaned { name: both(*thing) }.into());
            }
            Command::Clear { from, .. } => self.cleared(*from, relations, belief)?,
            Command::Tidy(within) | Command::Clean(within) => {
                self.tidied(*within, relations, belief)?
            }
            // Each action ends with a report as it is; nothing is under way that could be stopped.
            Command::Wait | Command::Report | Command::Stop => Vec::new(),
        })
    }

    /// A thing in the place where it is kept, though it lies there still.
    fn put_back(&self, thing: Entity, belief: &mut Belief) -> Result<Vec<Vec<GoalFact>>, Error> {
        let world = self.world()?;
        let name = world.name(thing).to_owned();
        let home = self.homes()?.remove(&name);
        let home = home.ok_or_else(|| RequestError::homeless(vec![in_both(world, &name)]))?;
        belief.homes.push((name.clone(), home));
        Ok(vec![vec![fact(predicate::IN_ITS_PLACE, vec![name])]])
    }

    /// What lies on a thing and is kept elsewhere. Where all of it is kept there, nobody said whither it should go.
    fn cleared(
        &self,
        from: Entity,
        relations: &Relations,
        belief: &mut Belief,
    ) -> Result<Vec<Vec<GoalFact>>, Error> {
        let goals = self.tidied(Some(from), relations, belief)?;
        let (kept, world) = (self.lying_on(from, relations)?, self.world()?);
        match goals.is_empty() && !kept.is_empty() {
            true => {
                let things = kept.iter().map(|name| in_both(world, name)).collect();
                let name = both(world, from);
                Err(RequestError::KeptThere { things, name }.into())
            }
            false => Ok(goals),
        }
    }

    /// What is to be tidied, each thing a goal of its own.
    fn tidied(
        &self,
        within: Option<Entity>,
        relations: &Relations,
        belief: &mut Belief,
    ) -> Result<Vec<Vec<GoalFact>>, Error> {
        let mut goals = Vec::new();
        for (thing, home) in self.misplaced(within, relations)? {
            goals.push(vec![fact(predicate::IN_ITS_PLACE, vec![thing.clone()])]);
            belief.homes.push((thing, home));
        }
        Ok(goals)
    }

    fn switched(&self, predicate: &str, entity: Entity) -> Result<GoalFact, Error> {
        let world = self.world()?;
        let name = world.name(entity).to_owned();
        if !matches!(entity, Entity::Replica(id) if world.has_trait(id, "device")) {
            return Err(RequestError::NotADevice { name: in_both(world, &name) }.into());
        }
        Ok(fact(predicate, vec![name]))
    }

    pub(super) fn being_at(
        &self,
        entity: Entity,
        relations: &Relations,
    ) -> Result<GoalFact, Error> {
        let world = self.world()?;
        let name = world.name(entity).to_owned();
        let predicate = match entity {
            Entity::Area(_) => predicate::ROBOT_IN,
            // A door with a room on one side only is none to the planner.
            Entity::Door(door) => {
                if !relations.joins().iter().any(|join| join.door == Some(door)) {
                    return Err(RequestError::LeadsOutside { name: in_both(world, &name) }.into());
                }
                predicate::ROBOT_AT_DOOR
            }
            Entity::Place(_) => {
                // A place where the robot does not fit, or in no room, is none to the planner.
                let known = facts_of_map(self.uncarried()?, relations)
                    .into_iter()
                    .any(|f| f.predicate == predicate::PLACE_IN && f.arguments[0].name == name);
                if !known {
                    return Err(RequestError::NotAPlace { name: in_both(world, &name) }.into());
                }
                predicate::ROBOT_AT_PLACE
            }
            Entity::Replica(_) => return self.being_near(entity, relations),
            Entity::Zone(_) => {
                return Err(RequestError::NotAPlace { name: in_both(world, &name) }.into());
            }
            // On a storey is in any room of it.
            Entity::Map(map) => {
                return Ok(fact(predicate::ROBOT_ON_STOREY, vec![storey_name(world, map)]));
            }
        };
        Ok(fact(predicate, vec![name]))
    }

    /// The nearest place or thing that is for charging, by its name or its type.
    fn charger(&self) -> Result<Entity, Error> {
        let all = crate::language::names::chargers(self.world()?);
        let far = |entity: Entity| (self.way_to(entity), entity);
        let nearest = all.map(far).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Ok(nearest.ok_or(RequestError::NoCharger)?.1)
    }

    /// A thing on the floor: of the room that is named, else where it lies, else where the robot stands.
    fn set_down(
        &self,
        thing: Entity,
        within: Option<Entity>,
        relations: &Relations,
        belief: &mut Belief,
    ) -> Result<Vec<GoalFact>, Error> {
        let id = self.portable(thing)?;
        let world = self.world()?;
        let name = world.name(thing).to_owned();
        let facts = facts_of_map(self.uncarried()?, relations);
        let area = match within {
            Some(Entity::Area(area)) => Some(area),
            Some(Entity::Place(place)) => {
                let place = world.name(Entity::Place(place)).to_owned();
                return Ok(vec![fact(predicate::THING_AT_PLACE, vec![name, place])]);
            }
            Some(Entity::Replica(beside)) => {
                let beside = world.name(Entity::Replica(beside)).to_owned();
                let place = facts
                    .iter()
                    .find(|f| f.predicate == predicate::PLACE_BY && f.arguments[1].name == beside);
                let place = place
                    .ok_or_else(|| RequestError::NotAPlace { name: in_both(world, &beside) })?;
                let place = place.arguments[0].name.clone();
                return Ok(vec![fact(predicate::THING_AT_PLACE, vec![name, place])]);
            }
            Some(other) => {
                return Err(RequestError::NotPutThere { name: both(world, other) }.into());
            }
            None => relations.area_of(id),
        };
        let lies = facts
            .iter()
            .find(|f| f.predicate == predicate::THING_AT_PLACE && f.arguments[0].name == name);
        if let Some(lies) = lies.filter(|_| relations.area_of(id) == area) {
            return Ok(vec![fact(
                predicate::THING_AT_PLACE,
                vec![name, lies.arguments[1].name.clone()],
            )]);
        }
        let room = area.map(|area| world.name(Entity::Area(area)).to_owned());
        let no_space = || {
            let area = in_both(world, room.as_deref().unwrap_or_default());
            Error::from(RequestError::NoSpace { thing: in_both(world, &name), area })
        };
        let place = match (area, &room) {
            (Some(area), Some(room)) => {
                let (map, _) = world.placement(area).ok_or_else(no_space)?;
                let at = self.around()?.floor(map)?.rest_in(area).ok_or_else(no_space)?;
                belief.name_point(floor_place(room), area, at)
            }
            _ => match &belief.station {
                Station::Place(here) => here.clone(),
                Station::Door(_) => return Err(no_space()),
            },
        };
        Ok(vec![fact(predicate::THING_AT_PLACE, vec![name.clone(), place])])
    }

    /// At the place from which a thing is reached: the one that serves it or what it stands on.
    fn being_near(&self, entity: Entity, relations: &Relations) -> Result<GoalFact, Error> {
        let world = self.world()?;
        let name = world.name(entity);
        let facts = facts_of_map(self.uncarried()?, relations);
        let about = |predicate: &str, at: usize, wanted: &str, give: usize| {
            facts
                .iter()
                .find(|f| f.predicate == predicate && f.arguments[at].name == wanted)
                .map(|f| f.arguments[give].name.clone())
        };
        let support = about(predicate::THING_ON, 0, name, 1);
        let place = about(predicate::THING_AT_PLACE, 0, name, 1)
            .or_else(|| about(predicate::PERSON_AT_PLACE, 0, name, 1))
            .or_else(|| about(predicate::PLACE_BY, 1, support.as_deref().unwrap_or(name), 0))
            .ok_or_else(|| RequestError::NotAPlace { name: in_both(world, name) })?;
        Ok(fact(predicate::ROBOT_AT_PLACE, vec![place]))
    }

    /// At a door, and then on its other side.
    fn through(&self, door: DoorId, relations: &Relations) -> Result<Vec<Vec<GoalFact>>, Error> {
        let world = self.world()?;
        let name = world.name(Entity::Door(door)).to_owned();
        let here = self.robot_area()?;
        let joins = relations.joins();
        let mut sides: BTreeSet<AreaId> = BTreeSet::new();
        for join in joins.iter().filter(|j| j.door == Some(door)) {
            sides.extend([join.from, join.to]);
        }
        if sides.is_empty() {
            return Err(RequestError::LeadsOutside { name: in_both(world, &name) }.into());
        }
        let at_door = vec![fact(predicate::ROBOT_AT_DOOR, vec![name])];
        let in_area = |area: &AreaId| {
            vec![fact(predicate::ROBOT_IN, vec![world.name(Entity::Area(*area)).to_owned()])]
        };
        let near = here.and_then(|here| self.nearest_side(here, door, &sides, relations));
        let beyond = sides.iter().find(|side| Some(**side) != near);
        Ok(match (near, beyond) {
            (Some(_), Some(beyond)) if near == here => vec![at_door, in_area(beyond)],
            // From farther off: first to the side to which it comes, so that it goes through and does not only come there.
            (Some(near), Some(beyond)) => vec![in_area(&near), at_door, in_area(beyond)],
            _ => vec![at_door],
        })
    }

    /// Of the two rooms of a door the one to which the robot comes first that does not go through it.
    fn nearest_side(
        &self,
        here: AreaId,
        door: DoorId,
        sides: &BTreeSet<AreaId>,
        relations: &Relations,
    ) -> Option<AreaId> {
        let (lifts, joins) = (lifts(self.world().ok()?, relations), relations.joins());
        let mut seen = BTreeSet::from([here]);
        let mut next = VecDeque::from([here]);
        while let Some(area) = next.pop_front() {
            if sides.contains(&area) {
                return Some(area);
            }
            let others = joins.iter().filter(|j| j.door != Some(door));
            let beside = others.filter(|j| j.from == area).map(|j| j.to);
            let of_lift = lifts.iter().filter(|lift| lift.cabins.contains(&area));
            for other in beside.chain(of_lift.flat_map(|lift| lift.cabins.iter().copied())) {
                if seen.insert(other) {
                    next.push_back(other);
                }
            }
        }
        None
    }

    /// In the room next to this one to which the way is the shortest.
    fn outside(&self, relations: &Relations) -> Result<GoalFact, Error> {
        let world = self.world()?;
        let here = self.robot_area()?.ok_or(RequestError::RobotNowhere)?;
        let beside: BTreeSet<AreaId> =
            relations.joins().iter().filter(|j| j.from == here).map(|j| j.to).gather();
        let far = |area: AreaId| (self.way_to(Entity::Area(area)), area);
        let next =
            beside.into_iter().map(far).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let name = world.name(Entity::Area(here));
        let (_, next) =
            next.ok_or_else(|| RequestError::NotAPlace { name: in_both(world, name) })?;
        Ok(fact(predicate::ROBOT_IN, vec![world.name(Entity::Area(next)).to_owned()]))
    }

    /// The cabin of the lift to which the way is the shortest stands at this storey.
    fn cabin_here(&self, relations: &Relations) -> Result<GoalFact, Error> {
        let world = self.world()?;
        let lifts = lifts(world, relations);
        let here = lifts.iter().flat_map(|lift| lift.doors.iter().map(move |join| (lift, join)));
        let here = here.filter_map(|(lift, join)| Some((lift, join, join.door?)));
        let (storey, _) = self.robot()?;
        let here = here.filter(|(_, join, _)| {
            world.placement(join.from).is_some_and(|(map, _)| map == storey)
        });
        let far = |door: DoorId| self.way_to(Entity::Door(door));
        let nearest = here.min_by(|a, b| far(a.2).total_cmp(&far(b.2)));
        let (lift, join, _) = nearest.ok_or(RequestError::NoLift)?;
        Ok(fact(predicate::CABIN_AT, vec![lift.name.clone(), join.opening.clone()]))
    }

    /// A door, or the door of a room that has only one: «Отопри лабораторию».
    fn door_of(&self, entity: Entity) -> Result<DoorId, Error> {
        let world = self.world()?;
        let door = match entity {
            Entity::Door(door) => Some(door),
            Entity::Area(area) => {
                let leafed = |d: &DoorId| world.doors.get(d).is_some_and(|d| !d.leaves.is_empty());
                let joins = self.relations()?.joins();
                let own = joins.iter().filter(|j| j.from == area).filter_map(|j| j.door);
                let doors: BTreeSet<DoorId> = own.filter(leafed).gather();
                doors.first().copied().filter(|_| doors.len() == 1)
            }
            _ => None,
        };
        let name = || RequestError::NotADoor { name: both(world, entity) };
        Ok(door.ok_or_else(name)?)
    }

    /// Whether a door is locked once the commands before have been carried out.
    fn is_locked_by(&self, before: &[Command<Entity>], entity: Entity) -> Result<bool, Error> {
        let door = self.door_of(entity)?;
        for command in before.iter().rev() {
            let (what, locks) = match command {
                Command::Lock(what) => (what, true),
                Command::Unlock(what) | Command::Open(what) => (what, false),
                _ => continue,
            };
            if self.door_of(what.id).is_ok_and(|other| other == door) {
                return Ok(locks);
            }
        }
        let door = self.world_now()?.doors.get(&door);
        Ok(door.is_some_and(|door| door.state.status == DoorStatus::Locked))
    }

    /// A state of a door, said for every pair of Areas that it joins.
    fn door_facts(&self, predicate: &str, entity: Entity) -> Result<Vec<GoalFact>, Error> {
        let world = self.world()?;
        let relations = self.relations()?;
        let joins = relations.joins();
        let door = self.door_of(entity)?;
        // A lift opens its door by itself when it has come.
        let lift = lifts(world, relations).into_iter().find_map(|lift| {
            let join = lift.doors.iter().find(|join| join.door == Some(door))?;
            Some(vec![lift.name, join.opening.clone()])
        });
        if let Some(args) = lift.filter(|_| predicate == predicate::DOOR_OPEN) {
            return Ok(vec![fact(predicate::CABIN_AT, args)]);
        }
        let facts: Vec<GoalFact> = joins
            .iter()
            .filter(|j| j.door == Some(door))
            .map(|j| {
                let args = [Entity::Door(door), Entity::Area(j.from), Entity::Area(j.to)];
                fact(predicate, args.map(|e| world.name(e).to_owned()).into())
            })
            .collect();
        if facts.is_empty() {
            let name = both(world, Entity::Door(door));
            return Err(RequestError::LeadsOutside { name }.into());
        }
        Ok(facts)
    }
}

fn fact(predicate: &str, args: Vec<String>) -> GoalFact {
    GoalFact { predicate: predicate.to_owned(), args }
}

/// Whether a thing is taken, or brought to who speaks, only to be put where it is said next: "Get the milk and the eggs and
/// put them in the fridge" is one deed. What is done between the two divides it, but for several things, of which the
/// hand holds one; and what is put back is taken first, since it may lie there already.
fn is_part_of_what_follows(commands: &[Command<Entity>], at: usize) -> bool {
    let is_taken = |command: &Command<Entity>| {
        matches!(command, Command::Take { .. } | Command::Bring { to: None, .. })
    };
    let Some(id) = commands.get(at).filter(|command| is_taken(command)).and_then(thing_of) else {
        return false;
    };
    let is_back = |c: &Command<Entity>| matches!(c, Command::PutBack(_) | Command::PutAway(_));
    let is_brought = |c: &Command<Entity>| match c {
        Command::Bring { what, to: None } => what.id == id,
        _ => c.places(&id) && !is_back(c),
    };
    let Some(placed) = commands[at + 1..].iter().position(is_brought) else { return false };
    let between = &commands[at + 1..][..placed];
    let divides = |command: &Command<Entity>| {
        !is_taken(command) && !command.what().is_some_and(|what| command.places(&what.id))
    };
    let several = between.first().into_iter().chain(at.checked_sub(1).map(|n| &commands[n]));
    !between.iter().any(divides) || several.into_iter().any(is_taken)
}

/// «Отнеси кружку на кухню и поставь на стол»: whether what is carried into a room is next put on or in what stands there.
fn goes_on_within(commands: &[Command<Entity>], relations: &Relations) -> bool {
    let [first, next, ..] = commands else { return false };
    let carried = |command: &Command<Entity>| match command {
        Command::Bring { what, to: Some(to) } | Command::Put { what, to } => {
            Some((what.id, to.anchor))
        }
        _ => None,
    };
    match (carried(first), carried(next)) {
        (Some((one, Entity::Area(room))), Some((same, Entity::Replica(holder)))) => {
            one == same && relations.area_of(holder) == Some(room)
        }
        _ => false,
    }
}

/// Whether two commands one after the other ask for the same to be done to different things: then their order is
/// the planner's to choose. What is carried goes one by one through the one hand, so there is little to choose.
fn are_done_together(first: &Command<Entity>, second: &Command<Entity>) -> bool {
    use Command::{Close, Lock, Open, SwitchOff, SwitchOn, Take, Unlock};
    matches!(
        (first, second),
        // Held at the end are both, or it is said that they cannot be.
        (Take { .. }, Take { .. })
            | (Open(_), Open(_))
            | (Close(_), Close(_))
            | (Lock(_), Lock(_))
            | (Unlock(_), Unlock(_))
            | (SwitchOn(_), SwitchOn(_))
            | (SwitchOff(_), SwitchOff(_))
    )
}
