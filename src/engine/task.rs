//! Tasks in words: a command becomes a goal, a mission drives to it, and each directive ends with a report.

use std::collections::BTreeSet;

use crate::graphplan::Limits;
use crate::language::command::{Command, Listener};
use crate::language::question::{Memory, Thing};
use crate::language::report::Position;
use crate::map::{Entity, World};
use crate::robot::{
    Belief, Directive, Drive, Ending, Event, GoalFact, Leg, Mission, Person, Planned, Simulator,
    Station, Surprise,
};
use crate::semantics::{Profile, Relations, derive, lifts, predicate, storey_name};
use crate::units::{MapId, Point, Pose};

use super::memory::{After, Now};
use super::position::describe;
use super::{Engine, Error, RequestError};

/// What a person who gives a task is called in plans.
pub const OPERATOR: &str = "Оператор";

/// What happens on the way, as it happens.
#[derive(Debug)]
pub enum Progress<'a> {
    /// A plan was made, or found to be impossible.
    Planned(&'a Planned),
    Started {
        number: usize,
        of: usize,
        directive: &'a Directive,
    },
    Finished(&'a Report),
    /// The world was not as believed; a new plan follows.
    Surprised {
        directive: &'a Directive,
        surprise: &'a Surprise,
    },
}

/// Where the robot was when a directive was done.
#[derive(Debug, Clone)]
pub struct Report {
    pub number: usize,
    pub directive: Directive,
    /// Of the storey on which the robot is.
    pub map: MapId,
    pub pose: Pose,
    /// `None` when the robot was in no Area.
    pub position: Option<Position>,
    /// The way driven for it: points, cm.
    pub points: Vec<Point>,
    pub length: f64,
    pub seconds: f64,
}

/// How a task ended.
#[derive(Debug)]
pub enum TaskEnding {
    Done,
    AlreadyTrue,
    NoPlan(Box<Planned>),
    Stuck(Surprise),
}

/// A task carried out, or shown impossible.
#[derive(Debug)]
pub struct TaskAnswer {
    pub goal: Vec<GoalFact>,
    pub map: MapId,
    pub start: Pose,
    /// On [`Self::end_map`].
    pub end: Pose,
    /// Another than `map` when the robot rode a lift.
    pub end_map: MapId,
    pub reports: Vec<Report>,
    /// How often a new plan was needed.
    pub replans: usize,
    pub seconds: f64,
    pub ending: TaskEnding,
    /// What the robot would keep in mind: see [`Engine::remember`]. None where nothing was done.
    pub after: Option<After>,
}

impl Engine {
    /// Carries out a command given in words, in the simulator, in a world that is as it is believed to be: as the
    /// Map says, and as the robot's last task left it. [`Engine::remember`] notes how this one leaves it.
    ///
    /// # Errors
    /// The command is not understood, or the Map lacks what it needs. That there is no plan is an answer.
    pub fn perform(
        &self,
        command: &str,
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        let now = self.now(std::time::SystemTime::now().into())?;
        self.perform_from(command, &now, now.world.clone(), tell)
    }

    /// Carries out a command in a world that may differ from the Map.
    ///
    /// # Errors
    /// As [`Engine::perform`].
    pub fn perform_in(
        &self,
        command: &str,
        truth: World,
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        let now = self.now(std::time::SystemTime::now().into())?;
        self.perform_from(command, &now, truth, tell)
    }

    fn perform_from(
        &self,
        command: &str,
        now: &Now,
        truth: World,
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        self.carry_out_from(&self.understand(command)?, now, truth, tell)
    }

    /// Carries out commands that were understood already, in a world that is as it is believed to be.
    ///
    /// # Errors
    /// As [`Engine::perform`].
    pub fn carry_out(
        &self,
        commands: &[Command<Entity>],
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        let now = self.now(std::time::SystemTime::now().into())?;
        self.carry_out_from(commands, &now, now.world.clone(), tell)
    }

    fn carry_out_from(
        &self,
        commands: &[Command<Entity>],
        now: &Now,
        truth: World,
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        let (map, start) = (now.map, now.pose);
        let mut belief = Belief::new(now.world.clone(), self.floors_now(now)?, map, start)
            .ok_or(RequestError::RobotNowhere)?;
        belief.held.clone_from(&now.held);
        belief.handed_over.clone_from(&now.handed_over);
        let Station::Place(here) = belief.station.clone() else {
            return Err(RequestError::RobotNowhere.into());
        };
        belief.people.push(Person { name: OPERATOR.to_owned(), place: here.clone() });
        let relations = self.relations_now(now)?;
        let relations = relations.as_ref().map_or_else(|| self.relations(), Ok)?;
        // What is asked for is brought about together, and then each misplaced thing is put away by itself.
        let mut goals = vec![Vec::new()];
        for command in commands {
            goals[0].extend(self.goal_of(command, &here, now, relations)?);
        }
        for command in commands {
            let Command::Tidy(within) = command else { continue };
            for (thing, home) in self.misplaced(*within, now, relations)? {
                let args = vec![thing.clone()];
                goals.push(vec![GoalFact { predicate: predicate::IN_ITS_PLACE.to_owned(), args }]);
                belief.homes.push((thing, home));
            }
        }
        goals.retain(|goal| !goal.is_empty());
        belief.into = commands.iter().filter_map(|command| self.put_into(command)).collect();
        let mut drive = Simulator::new(truth, map, start).holding(now.held.clone());
        for command in commands {
            let Command::Find(what) = command else { continue };
            let Entity::Replica(id) = what.id else { continue };
            let name = self.world()?.name(what.id).to_owned();
            let in_hand = !now.world.replicas.contains_key(&id);
            if in_hand || drive.sees(id).is_some() {
                belief.found.insert(name);
            } else {
                belief.sought.insert(name, BTreeSet::new());
            }
        }
        let mut mission =
            Mission::new(belief, &self.rules.robot, &self.rules.relations, Limits::default());
        let mut reports = Vec::new();
        let mut plans = 0;
        let mut hear = |event: &Event<'_>| match event {
            Event::Planned(planned) => {
                plans += 1;
                tell(&Progress::Planned(planned));
            }
            Event::Started { number, of, directive } => {
                tell(&Progress::Started { number: *number, of: *of, directive });
            }
            Event::Finished { number, directive, belief, leg } => {
                let report = self.report(*number, directive, belief, leg);
                tell(&Progress::Finished(&report));
                reports.push(report);
            }
            Event::Surprised { directive, surprise, .. } => {
                tell(&Progress::Surprised { directive, surprise });
            }
        };
        let mut ending = TaskEnding::AlreadyTrue;
        let mut begun = 0;
        for goal in &goals {
            begun += 1;
            match mission.run(goal, &mut drive, &mut hear)? {
                Ending::Done => ending = TaskEnding::Done,
                Ending::AlreadyTrue => {}
                Ending::NoPlan(planned) => {
                    ending = TaskEnding::NoPlan(planned);
                    break;
                }
                Ending::Stuck(surprise) => {
                    ending = TaskEnding::Stuck(surprise);
                    break;
                }
            }
        }
        let trace = drive.trace();
        let last = trace.last().expect("a run begins with a moment");
        Ok(TaskAnswer {
            goal: goals.concat(),
            map,
            start,
            end: last.pose,
            end_map: last.map,
            reports,
            replans: plans - begun,
            seconds: last.time,
            ending,
            after: Some(After::of(self.world()?, now, &mission)),
        })
    }

    /// The commands of a sentence, with everything that it names found on the map.
    ///
    /// # Errors
    /// What was not understood, which candidates there are, or what the map lacks.
    pub fn understand(&self, sentence: &str) -> Result<Vec<Command<Entity>>, Error> {
        let settled = self.settle(sentence, &Memory::default())?;
        let nearest = |all: &[Entity]| self.nearest(all);
        Ok(Listener::new(self.forms()?).choosing(&nearest).hear(&settled)?)
    }

    /// The commands of a sentence in a dialogue: «её» is what was spoken of last.
    ///
    /// # Errors
    /// As [`Engine::understand`].
    pub fn understand_in(
        &self,
        sentence: &str,
        memory: &mut Memory,
    ) -> Result<Vec<Command<Entity>>, Error> {
        let settled = self.settle(sentence, memory)?;
        let last = match memory.last_thing() {
            Some(Thing::Entity(entity)) => Some(entity),
            _ => None,
        };
        let nearest = |all: &[Entity]| self.nearest(all);
        let listener = Listener::new(self.forms()?).remembering(last).choosing(&nearest);
        let commands = listener.hear(&settled)?;
        for command in &commands {
            if let Some(entity) = thing_of(command) {
                memory.mention(Thing::Entity(entity));
            }
        }
        Ok(commands)
    }

    /// Of several things the one nearest to the robot, in its own room before all others; the first where it is not
    /// known how far they are.
    fn nearest(&self, all: &[Entity]) -> Option<Entity> {
        let relations = self.relations().ok()?;
        let (map, pose) = self.robot_pose()?;
        let here = relations.measurements().area_at(map, pose.at);
        let away = |entity: &Entity| match entity {
            Entity::Replica(id) => {
                let far = relations.distance_to_point(*id, map, pose.at).unwrap_or(f64::INFINITY);
                (relations.area_of(*id) != here, far)
            }
            _ => (true, f64::INFINITY),
        };
        let order = |a: &&Entity, b: &&Entity| {
            let ((here_a, far_a), (here_b, far_b)) = (away(a), away(b));
            here_a.cmp(&here_b).then(far_a.total_cmp(&far_b))
        };
        all.iter().min_by(order).copied()
    }

    /// What is to hold when a command is done. `here` is the place where it was given.
    fn goal_of(
        &self,
        command: &Command<Entity>,
        here: &str,
        now: &Now,
        relations: &Relations,
    ) -> Result<Vec<GoalFact>, Error> {
        let world = self.world()?;
        let name = |e: Entity| world.name(e).to_owned();
        let fact =
            |predicate: &str, args: Vec<String>| GoalFact { predicate: predicate.to_owned(), args };
        Ok(match command {
            Command::GoTo { to, .. } => vec![self.being_at(to.anchor, &now.world, relations)?],
            Command::ComeHere => vec![fact(predicate::ROBOT_AT_PLACE, vec![here.to_owned()])],
            Command::Bring { what, to: None } => {
                self.portable(what.id)?;
                vec![fact(predicate::HANDED_OVER, vec![name(what.id), OPERATOR.to_owned()])]
            }
            Command::Bring { what, to: Some(to) } | Command::Put { what, to } => {
                self.delivered(what.id, to, now, relations)?
            }
            Command::Take { what } => {
                self.portable(what.id)?;
                vec![fact(predicate::ROBOT_HOLDS, vec![name(what.id)])]
            }
            Command::Find(what) => match what.id {
                Entity::Replica(_) => vec![fact(predicate::FOUND, vec![name(what.id)])],
                place => vec![self.being_at(place, &now.world, relations)?],
            },
            Command::Open(door) => self.door_facts(predicate::DOOR_OPEN, door.id)?,
            Command::Close(door) => self.door_facts(predicate::DOOR_CLOSED, door.id)?,
            Command::Lock(door) => self.door_facts(predicate::DOOR_LOCKED, door.id)?,
            Command::Unlock(door) => self.door_facts(predicate::DOOR_CLOSED, door.id)?,
            Command::SwitchOn(device) => vec![self.switched(predicate::DEVICE_ON, device.id)?],
            Command::SwitchOff(device) => vec![self.switched(predicate::DEVICE_OFF, device.id)?],
            Command::CallOperator => vec![fact(predicate::CALLED, vec![OPERATOR.to_owned()])],
            // What is to be tidied, each thing is a goal of its own: see `goals_of`.
            Command::Tidy(_) => Vec::new(),
            Command::Stop | Command::Report => {
                return Err(RequestError::NoGoal { command: "это".to_owned() }.into());
            }
        })
    }

    fn switched(&self, predicate: &str, entity: Entity) -> Result<GoalFact, Error> {
        let world = self.world()?;
        let name = world.name(entity).to_owned();
        if !matches!(entity, Entity::Replica(id) if world.has_trait(id, "device")) {
            return Err(RequestError::NotADevice { name }.into());
        }
        Ok(GoalFact { predicate: predicate.to_owned(), args: vec![name] })
    }

    fn being_at(
        &self,
        entity: Entity,
        now: &World,
        relations: &Relations,
    ) -> Result<GoalFact, Error> {
        let world = self.world()?;
        let predicate = match entity {
            Entity::Area(_) => predicate::ROBOT_IN,
            Entity::Door(_) => predicate::ROBOT_AT_DOOR,
            Entity::Place(_) => predicate::ROBOT_AT_PLACE,
            Entity::Replica(_) => return self.being_near(entity, now, relations),
            // On a storey is in any room of it.
            Entity::Map(map) => {
                let predicate = predicate::ROBOT_ON_STOREY.to_owned();
                return Ok(GoalFact { predicate, args: vec![storey_name(world, map)] });
            }
        };
        Ok(GoalFact { predicate: predicate.to_owned(), args: vec![world.name(entity).to_owned()] })
    }

    /// At the place from which a thing is reached: the one that serves it or what it stands on.
    fn being_near(
        &self,
        entity: Entity,
        now: &World,
        relations: &Relations,
    ) -> Result<GoalFact, Error> {
        let name = self.world()?.name(entity);
        let facts = crate::robot::facts_of_map(now, relations);
        let about = |predicate: &str, at: usize, wanted: &str, give: usize| {
            facts
                .iter()
                .find(|f| f.predicate == predicate && f.arguments[at].name == wanted)
                .map(|f| f.arguments[give].name.clone())
        };
        let support = about(predicate::THING_ON, 0, name, 1);
        let place = about(predicate::THING_AT_PLACE, 0, name, 1)
            .or_else(|| about(predicate::PLACE_BY, 1, support.as_deref().unwrap_or(name), 0))
            .ok_or_else(|| RequestError::NotAPlace { name: name.to_owned() })?;
        Ok(GoalFact { predicate: predicate::ROBOT_AT_PLACE.to_owned(), args: vec![place] })
    }

    /// A state of a door, said for every pair of Areas that it joins.
    fn door_facts(&self, predicate: &str, entity: Entity) -> Result<Vec<GoalFact>, Error> {
        let world = self.world()?;
        let Entity::Door(door) = entity else {
            return Err(RequestError::NotADoor { name: world.name(entity).to_owned() }.into());
        };
        let relations = self.relations()?;
        let joins = relations.joins();
        // A lift opens its door by itself when it has come.
        let lift = lifts(world, relations).into_iter().find_map(|lift| {
            let join = lift.doors.iter().find(|join| join.door == Some(door))?;
            Some(vec![lift.name, join.opening.clone()])
        });
        if let Some(args) = lift.filter(|_| predicate == predicate::DOOR_OPEN) {
            return Ok(vec![GoalFact { predicate: predicate::CABIN_AT.to_owned(), args }]);
        }
        let facts: Vec<GoalFact> = joins
            .iter()
            .filter(|j| j.door == Some(door))
            .map(|j| GoalFact {
                predicate: predicate.to_owned(),
                args: [Entity::Door(door), Entity::Area(j.from), Entity::Area(j.to)]
                    .map(|e| world.name(e).to_owned())
                    .into(),
            })
            .collect();
        if facts.is_empty() {
            return Err(RequestError::NotADoor { name: world.name(entity).to_owned() }.into());
        }
        Ok(facts)
    }

    fn report(&self, number: usize, directive: &Directive, belief: &Belief, leg: &Leg) -> Report {
        let say = |relations: &Relations| {
            describe(&belief.world, relations, belief.map, belief.pose, None).map(|w| w.position)
        };
        // Most directives leave the world as the Map has it, and its relations are derived already.
        let position = match self.relations() {
            Ok(relations) if self.world.as_ref() == Some(&belief.world) => say(relations),
            _ => derive(&belief.world, &self.rules.relations, Profile::Surveyed)
                .ok()
                .and_then(|r| say(&r)),
        };
        let points = leg.route.as_ref().map(|r| r.points.clone()).unwrap_or_default();
        Report {
            number,
            directive: directive.clone(),
            map: belief.map,
            pose: belief.pose,
            position,
            length: leg.route.as_ref().map_or(0.0, |r| r.length),
            points,
            seconds: leg.seconds,
        }
    }
}

/// What a command is about.
fn thing_of(command: &Command<Entity>) -> Option<Entity> {
    match command {
        Command::Bring { what, .. } | Command::Take { what } | Command::Put { what, .. } => {
            Some(what.id)
        }
        Command::Open(what)
        | Command::Close(what)
        | Command::Lock(what)
        | Command::Unlock(what)
        | Command::SwitchOn(what)
        | Command::SwitchOff(what)
        | Command::Find(what) => Some(what.id),
        Command::GoTo { to, .. } => Some(to.anchor),
        _ => None,
    }
}
