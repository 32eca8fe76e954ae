//! Tasks in words: a command becomes a goal, a mission drives to it, and each directive ends with a report.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeSet, VecDeque};
use std::sync::OnceLock;

use crate::graphplan::Limits;
use crate::language::command::Command;
use crate::language::report::Position;
use crate::map::{Entity, World};
use crate::robot::{
    Answer, Barred, Belief, Directive, Ending, Event, Failure, GoalFact, Ground, Leg, Mission,
    MissionError, Moment, Person, Pilot, Planned, Simulator, Station, Surprise, Vehicle,
    facts_of_map, height_of_laser, protocol,
};
use crate::semantics::{Followed, Relations, predicate};
use crate::strips::Domain;
use crate::units::{MapId, Point, Pose, ReplicaId, Stop};

mod understanding;

pub(super) use understanding::thing_of;

use super::after::After;
use super::position::describe;
use super::{Error, RequestError, State};

/// What a person who gives a task is called in plans.
pub(super) const OPERATOR: &str = "Оператор";

/// The name of the point where that person stands, for the time of a task.
pub(super) const OPERATOR_PLACE: &str = "Место-оператора";

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
    /// The robot is sent along a way, which begins where it stands; cm.
    Sent {
        map: MapId,
        way: &'a [Point],
    },
    /// The robot is on its way.
    Moved(&'a Moment),
    /// Its range finder turned once.
    Scanned(&'a protocol::Scan),
    Finished(&'a Report),
    /// The world was not as believed; a new plan follows.
    Surprised {
        directive: &'a Directive,
        surprise: &'a Surprise,
    },
    /// Something bars the only way: who is told may have it cleared, and say so.
    Barred {
        barred: &'a Barred,
        answer: &'a Cell<Answer>,
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
    /// How the robot and its world were then.
    pub after: After,
}

/// How a task ended.
#[derive(Debug)]
pub enum TaskEnding {
    Done,
    AlreadyTrue,
    NoPlan(Box<Planned>),
    Stuck(Surprise),
    /// It was told to stop, and stands.
    Stopped,
    /// The vehicle is of no more use; what is believed is what was known before.
    Failed(Failure),
}

impl TaskEnding {
    /// Whether what was asked for is so.
    #[must_use]
    pub fn is_done(&self) -> bool {
        matches!(self, Self::Done | Self::AlreadyTrue)
    }
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
    /// What was to be tidied and stays where it is, with the ending of each; the others are in their places.
    pub left: Vec<(GoalFact, TaskEnding)>,
    /// What was to be tidied and has no place, by name: it was moved, and is where it is.
    pub strays: Vec<String>,
    /// What was to be put away and lies where it is kept, by name, with that.
    pub kept: Vec<(String, String)>,
    /// What was to be put where it lies already, while others were put there, or into what it lies on, by name: it was left there.
    pub lying: Vec<String>,
    /// Whether the same was asked of several things, and done of those that are not told of as left.
    pub others_done: bool,
    /// What the sentence asked for beside, and was not begun, since what was asked for before it came to nothing.
    pub not_begun: Vec<GoalFact>,
    /// Whether it was told to tidy: «Убери со стола».
    pub tidies: bool,
    /// Whether it was only told to stop: each task runs to its end before the next is heard, so nothing was under way.
    pub stops: bool,
    /// Where the robot stands, when it was stopped, or told to report and no directive ends with a report.
    pub reported: Option<Position>,
    /// Things of which it was not sure where they are, and looked for before all else, each with how sure it was, 0..=1.
    pub unsure: Vec<(ReplicaId, f64)>,
    /// What the robot would keep in mind: see [`Engine::remember`](super::Engine::remember). None where nothing was done.
    pub after: Option<After>,
}

/// What is to be driven: from a sentence, or from a scenario.
pub(super) struct Errand<'r> {
    pub(super) domain: &'r Domain,
    pub(super) belief: Belief,
    /// Of what is believed.
    pub(super) relations: Followed,
    /// One after another; the facts of one hold together.
    pub(super) goals: Vec<Vec<GoalFact>>,
    /// Whether a thing that cannot be put into its place lets the rest be tidied.
    pub(super) tidies: bool,
    /// Whether the same is asked of several things, so that one of which it cannot be done lets it be done of the others.
    pub(super) each: bool,
}

impl State {
    /// The relations of the world in which a task begins, with what the robot knows beside it.
    pub(super) fn followed_with(&self, belief: &Belief) -> Result<Followed, Error> {
        let around = self.around()?;
        let mut followed = around.to_follow()?;
        if self.rules.relations.asks_the_robot() {
            let believed = self.whereabouts_believed(around.moment())?;
            let told = belief.told(followed.relations(), believed);
            followed.tell(told)?;
        }
        Ok(followed)
    }

    /// Carries out a command given in words, in the simulator, in a world that is as it is believed to be: as the
    /// Map says, and as the robot's last task left it. [`Engine::remember`](super::Engine::remember) notes how this one leaves it.
    ///
    /// # Errors
    /// The command is not understood, or the Map lacks what it needs. That there is no plan is an answer.
    pub fn perform(
        &self,
        command: &str,
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        self.carry_out(&self.understand(command)?, tell)
    }

    /// Carries out a command in a world that may differ from the Map.
    ///
    /// # Errors
    /// As [`State::perform`].
    pub fn perform_in(
        &self,
        command: &str,
        mut truth: World,
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        self.carry_out_in(&self.understand(command)?, &mut truth, tell)
    }

    /// Carries out commands that were understood already, in a world that is as it is believed to be.
    ///
    /// # Errors
    /// As [`State::perform`].
    pub fn carry_out(
        &self,
        commands: &[Command<Entity>],
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        let begun = self.at(std::time::SystemTime::now().into())?;
        let mut robot = begun.simulated(None)?;
        begun.carry_out_by(commands, &mut robot, tell, &Stop::new())
    }

    /// Carries out commands that were understood already, in a world that may differ from what is believed; it is left
    /// as the task leaves it.
    ///
    /// # Errors
    /// As [`State::perform`].
    pub fn carry_out_in(
        &self,
        commands: &[Command<Entity>],
        truth: &mut World,
        tell: &mut dyn FnMut(&Progress<'_>),
    ) -> Result<TaskAnswer, Error> {
        let mut robot = self.simulator(Some(truth.clone()))?;
        let answer = self.carry_out_with(commands, &mut robot, tell, &Stop::new())?;
        *truth = robot.into_truth();
        Ok(answer)
    }

    /// Carries out commands that were understood already, with a vehicle: the simulator, one of the caller's own, or a
    /// [`crate::robot::RemoteVehicle`]. Where the vehicle says that it stands, there it is, whatever was believed.
    ///
    /// A [`Stop`] that is raised, by another thread or a signal, ends planning and driving at once; the answer then tells
    /// how the robot stands, and [`Engine::remember`](super::Engine::remember) notes that as it does after any other ending.
    ///
    /// # Errors
    /// As [`State::perform`]. That the vehicle fails is an answer.
    pub fn carry_out_with(
        &self,
        commands: &[Command<Entity>],
        vehicle: &mut dyn Vehicle,
        tell: &mut dyn FnMut(&Progress<'_>),
        stop: &Stop,
    ) -> Result<TaskAnswer, Error> {
        self.carry_out_for(commands, None, vehicle, tell, stop)
    }

    /// The same for a person who stands elsewhere than the robot does now.
    pub(super) fn carry_out_for(
        &self,
        commands: &[Command<Entity>],
        person: Option<(MapId, Point)>,
        vehicle: &mut dyn Vehicle,
        tell: &mut dyn FnMut(&Progress<'_>),
        stop: &Stop,
    ) -> Result<TaskAnswer, Error> {
        let mut begun = self.at(std::time::SystemTime::now().into())?;
        begun.person = person;
        begun.carry_out_by(commands, vehicle, tell, stop)
    }

    /// The simulated robot where it is believed to be, with what it carries, in a world that may differ from what is
    /// believed; none, one that does not.
    ///
    /// # Errors
    /// There is no map.
    pub fn simulator(&self, truth: Option<World>) -> Result<Simulator, Error> {
        self.at(std::time::SystemTime::now().into())?.simulated(truth)
    }

    fn simulated(&self, truth: Option<World>) -> Result<Simulator, Error> {
        let (around, (map, pose)) = (self.around()?, self.robot()?);
        let truth = truth.unwrap_or_else(|| around.uncarried().clone());
        let robot =
            Simulator::new(truth, map, pose).through_walls(self.rules.relations.step_reach());
        Ok(robot.laden(around.held().cloned(), &around.handed_over(), &around.aboard()))
    }

    /// The same by the word of the vehicle, which knows where it stands; else why it cannot be used.
    pub(super) fn stood_by(&self, vehicle: &dyn Vehicle) -> Result<Self, Failure> {
        let (map, pose) = vehicle.pose();
        if ![pose.at.x, pose.at.y].iter().all(|number| number.is_finite()) {
            return Err(Failure::NoNumber);
        }
        let is_on_map = self.world().is_ok_and(|world| world.maps.contains_key(&map));
        if !is_on_map || !self.floor(map).is_ok_and(|floor| floor.locate(pose.at).is_some()) {
            return Err(Failure::OffTheMap { pose });
        }
        let mut state = self.clone();
        state.robot = OnceLock::from((map, pose));
        Ok(state)
    }

    /// What the robot believes when a task begins, and the place where the operator stands: where the robot does, unless
    /// it is told otherwise.
    pub(super) fn belief_of(&self) -> Result<(Belief, String), Error> {
        let (around, (map, start)) = (self.around()?, self.robot()?);
        let mut belief =
            Belief::new(around.uncarried().clone(), around.floors_from(map)?, map, start)
                .ok_or(RequestError::RobotNowhere)?;
        belief.held = around.held().cloned();
        belief.handed_over = around.handed_over();
        belief.aboard = around.aboard();
        let Station::Place(here) = belief.station.clone() else {
            return Err(RequestError::RobotNowhere.into());
        };
        let elsewhere = self.person.and_then(|(map, at)| {
            let floor = self.around().ok()?.floor(map).ok()?;
            Some((floor.locate(at)?.0, at))
        });
        let here = match elsewhere {
            Some((area, at)) => belief.name_point(OPERATOR_PLACE.to_owned(), area, at),
            None => here,
        };
        belief.people.push(Person {
            name: OPERATOR.to_owned(),
            name_en: "operator".to_owned(),
            place: here.clone(),
        });
        Ok((belief, here))
    }

    /// Has a vehicle do something that knows where it stands: one that does not is given a pilot who finds it.
    pub(super) fn piloted<T>(
        &self,
        vehicle: &mut dyn Vehicle,
        begin: impl FnOnce(Result<&mut dyn Vehicle, Failure>) -> T,
    ) -> Result<T, Error> {
        if !vehicle.tells_odometry() {
            return Ok(begin(Ok(vehicle)));
        }
        let height = match height_of_laser(vehicle) {
            Ok(height) => height,
            Err(failure) => return Ok(begin(Err(failure))),
        };
        let (around, robot) = (self.around()?, self.robot()?);
        let floors = around.floors_from(robot.0)?;
        let ground = Ground::of(around.uncarried(), &floors, height);
        let finders = ground.finders();
        Ok(match Pilot::new(&ground, &finders, vehicle, robot) {
            Ok(mut pilot) => begin(Ok(&mut pilot)),
            Err(failure) => begin(Err(failure)),
        })
    }

    fn carry_out_by(
        &self,
        commands: &[Command<Entity>],
        vehicle: &mut dyn Vehicle,
        tell: &mut dyn FnMut(&Progress<'_>),
        stop: &Stop,
    ) -> Result<TaskAnswer, Error> {
        self.piloted(vehicle, |vehicle| match vehicle {
            Ok(vehicle) => match self.stood_by(vehicle) {
                Ok(begun) => begun.carry_out_placed(commands, vehicle, tell, stop),
                Err(failure) => self.not_begun(failure),
            },
            Err(failure) => self.not_begun(failure),
        })?
    }

    fn carry_out_placed(
        &self,
        commands: &[Command<Entity>],
        vehicle: &mut dyn Vehicle,
        tell: &mut dyn FnMut(&Progress<'_>),
        stop: &Stop,
    ) -> Result<TaskAnswer, Error> {
        let (mut belief, here) = self.belief_of()?;
        let followed = self.followed_with(&belief)?;
        let relations = followed.relations();
        let (commands, staying) = self.staying(commands, relations)?;
        let mut goals = self.goals_of(&commands, &here, relations, &mut belief)?;
        self.shut_again(&commands, &mut goals, relations)?;
        let mut goals = self.opened_around(goals, relations)?;
        let unsure = self.unsure_of(&commands, &goals)?;
        // Of what it is not sure where it is, it looks first.
        for (thing, _) in unsure.iter().rev() {
            let name = self.world()?.name(Entity::Replica(*thing)).to_owned();
            belief.sought.insert(name.clone(), BTreeSet::new());
            belief.adrift.insert(name.clone());
            goals.insert(
                0,
                vec![GoalFact { predicate: predicate::FOUND.to_owned(), args: vec![name] }],
            );
        }
        belief.into.extend(commands.iter().filter_map(|command| self.put_into(command)));
        let sought = commands.iter().filter_map(|command| match command {
            Command::Find(what) => Some(what.id),
            _ => None,
        });
        let unsure_ones = unsure.iter().map(|(thing, _)| Entity::Replica(*thing));
        let sought = sought.chain(unsure_ones).filter_map(|what| match what {
            Entity::Replica(id) => Some(id),
            _ => None,
        });
        if let Err(failure) = self.seek(sought, relations, &mut belief, vehicle)? {
            return self.not_begun(failure);
        }
        let lying = self.lying_there(&commands, relations)?;
        let tidying = |c: &Command<_>| {
            matches!(c, Command::Tidy(_) | Command::Clear { .. } | Command::Clean(_))
        };
        let kept = |c: &Command<_>| matches!(c, Command::PutBack(_) | Command::PutAway(_));
        let tidies = commands.iter().any(|c| tidying(c) || kept(c));
        let domain = &self.rules.robot;
        let each = asks_of_each(&commands);
        let errand = Errand { domain, belief, relations: followed, goals, tidies, each };
        let mut answer = self.drive(errand, vehicle, tell, stop)?;
        answer.lying = lying;
        (answer.strays, answer.kept) = (staying.strays, staying.kept);
        let must_report = matches!(answer.ending, TaskEnding::Stopped)
            || (answer.reports.is_empty() && commands.iter().any(|c| matches!(c, Command::Report)));
        let reported = must_report.then(|| self.locate(answer.end_map, answer.end, false));
        answer.reported = reported.and_then(Result::ok).map(|found| found.position);
        answer.tidies = commands.iter().any(tidying);
        answer.stops = matches!(&commands[..], [Command::Stop]);
        answer.unsure = unsure;
        Ok(answer)
    }

    /// Of what is to be found, what is in view or in the hand is found already; the rest is looked for.
    pub(super) fn seek(
        &self,
        things: impl Iterator<Item = ReplicaId>,
        relations: &Relations,
        belief: &mut Belief,
        vehicle: &mut dyn Vehicle,
    ) -> Result<Result<(), Failure>, Error> {
        let room = self.world()?.name(Entity::Area(belief.area)).to_owned();
        let is_lit = facts_of_map(self.uncarried()?, relations)
            .iter()
            .any(|f| f.predicate == predicate::ROOM_LIT && f.arguments[0].name == room);
        for id in things {
            let name = self.world()?.name(Entity::Replica(id)).to_owned();
            let in_hand = !self.uncarried()?.replicas.contains_key(&id);
            let seen = if is_lit && !in_hand { vehicle.sees(id) } else { Ok(None) };
            let in_view = match seen {
                Ok(seen) => seen.is_some(),
                Err(failure) => return Ok(Err(failure)),
            };
            if in_hand || in_view {
                belief.found.insert(name);
            } else {
                if self.doubted(id).is_some() {
                    belief.adrift.insert(name.clone());
                }
                belief.sought.insert(name, BTreeSet::new());
            }
        }
        Ok(Ok(()))
    }

    /// Drives to goals, one after another, until one is out of reach.
    pub(super) fn drive(
        &self,
        errand: Errand<'_>,
        vehicle: &mut dyn Vehicle,
        tell: &mut dyn FnMut(&Progress<'_>),
        stop: &Stop,
    ) -> Result<TaskAnswer, Error> {
        let begun_at = vehicle.time();
        let (surveyed, before) = (self.world()?, self.uncarried()?);
        let (map, start) = self.robot()?;
        let remembered = (self.memory()?, self.around()?.moment());
        let Errand { domain, belief, relations, goals, tidies, each } = errand;
        let sure = relations.relations().thresholds().belief_own;
        let after = |belief: &Belief| After::of(surveyed, before, remembered, (belief, sure));
        // Reports are of moments between plans; each follows by itself.
        let mut reported = relations.clone();
        let effort = Some(Limits::TO_START);
        let (rules, limits) = (&self.rules.relations, Limits { effort, ..Limits::default() });
        let mut mission = Mission::new(belief, domain, relations, rules, limits);
        if self.plans_in_time {
            mission = mission.in_least_time();
        }
        let mut reports = Vec::new();
        let mut plans = 0;
        let surprised: RefCell<Option<Surprise>> = RefCell::new(None);
        let mut hear = |event: &Event<'_>| match event {
            Event::Planned(planned) => {
                plans += 1;
                tell(&Progress::Planned(planned));
            }
            Event::Started { number, of, directive } => {
                tell(&Progress::Started { number: *number, of: *of, directive });
            }
            Event::Sent { map, way } => tell(&Progress::Sent { map: *map, way }),
            Event::Moved(moment) => tell(&Progress::Moved(moment)),
            Event::Scanned(scan) => tell(&Progress::Scanned(scan)),
            Event::Finished { number, directive, belief, leg } => {
                let report =
                    report_of((*number, directive), belief, leg, after(belief), &mut reported);
                tell(&Progress::Finished(&report));
                reports.push(report);
            }
            Event::Surprised { directive, surprise, .. } => {
                surprised.replace(Some(Surprise::clone(surprise)));
                tell(&Progress::Surprised { directive, surprise });
            }
            Event::Barred { barred, answer } => tell(&Progress::Barred { barred, answer }),
        };
        let mut ending = TaskEnding::AlreadyTrue;
        let mut left: Vec<(GoalFact, TaskEnding)> = Vec::new();
        let mut begun = 0;
        let mut run = |goal: &[GoalFact]| match (
            mission.run(goal, vehicle, stop, &mut hear),
            surprised.take(),
        ) {
            (Ok(ended), _) => Ok(ended),
            // A place that proved to be out of reach is none to the next plan, and the goal speaks of it.
            (Err(MissionError::Rules(_)), Some(surprise)) => Ok(Ending::Stuck(surprise)),
            (Err(error), _) => Err(Error::from(error)),
        };
        let (mut done, mut given_up) = (false, Vec::new());
        'goals: for goal in &goals {
            begun += 1;
            // Together first; where that does not come about, one after the other.
            let mut asked = VecDeque::from([but(goal, &given_up)]);
            let mut holds: Vec<GoalFact> = Vec::new();
            while let Some(facts) = asked.pop_front().filter(|facts| !facts.is_empty()) {
                let whole: Vec<GoalFact> = holds.iter().chain(&facts).cloned().collect();
                let failed = match run(&whole)? {
                    Ending::Done => {
                        (ending, done, holds) = (TaskEnding::Done, true, whole);
                        continue;
                    }
                    Ending::AlreadyTrue => {
                        holds = whole;
                        continue;
                    }
                    Ending::NoPlan(planned) => TaskEnding::NoPlan(planned),
                    Ending::Stuck(surprise) => TaskEnding::Stuck(surprise),
                    Ending::Stopped => {
                        ending = TaskEnding::Stopped;
                        break 'goals;
                    }
                    Ending::Failed(failure) => {
                        ending = TaskEnding::Failed(failure);
                        break 'goals;
                    }
                };
                match &facts[..] {
                    // What cannot be put away lets the rest be tidied.
                    [fact] if tidies && fact.predicate == predicate::IN_ITS_PLACE => {
                        left.push((fact.clone(), failed));
                    }
                    [first, rest @ ..] if each => {
                        match rest.iter().any(|f| f.args.first() != first.args.first()) {
                            true => asked.extend(of_each_thing(&facts)),
                            false => {
                                left.push((first.clone(), failed));
                                given_up.extend(facts);
                            }
                        }
                    }
                    _ => {
                        ending = failed;
                        break 'goals;
                    }
                }
            }
        }
        let stands = !matches!(ending, TaskEnding::Done | TaskEnding::AlreadyTrue);
        let others_done = each && done && !left.is_empty() && !stands;
        if !left.is_empty() && (matches!(ending, TaskEnding::AlreadyTrue) || others_done) {
            ending = left.remove(0).1;
        }
        Ok(TaskAnswer {
            goal: each_once(&goals),
            map,
            start,
            end: mission.belief.pose,
            end_map: mission.belief.map,
            reports,
            replans: usize::saturating_sub(plans, begun),
            seconds: vehicle.time() - begun_at,
            ending,
            left,
            strays: Vec::new(),
            lying: Vec::new(),
            kept: Vec::new(),
            others_done,
            not_begun: each_once(&goals).split_off(each_once(&goals[..begun]).len()),
            tidies: false,
            stops: false,
            reported: None,
            after: Some(after(&mission.belief)),
            unsure: Vec::new(),
        })
    }
}

/// Whether commands ask for the same of several things: "Switch off every lamp", «Отнеси книги на стол».
fn asks_of_each(commands: &[Command<Entity>]) -> bool {
    let alike = |one: &Command<Entity>, other: &Command<Entity>| {
        std::mem::discriminant(one) == std::mem::discriminant(other)
            && one.place() == other.place()
            && one.what().zip(other.what()).is_some_and(|(one, other)| one.id != other.id)
    };
    commands.len() > 1 && commands.windows(2).all(|pair| alike(&pair[0], &pair[1]))
}

/// Facts of a goal by the thing of which they are, in their order.
fn of_each_thing(facts: &[GoalFact]) -> Vec<Vec<GoalFact>> {
    facts.chunk_by(|one, other| one.args.first() == other.args.first()).map(<[_]>::to_vec).collect()
}

fn but(goal: &[GoalFact], given_up: &[GoalFact]) -> Vec<GoalFact> {
    goal.iter().filter(|fact| !given_up.contains(fact)).cloned().collect()
}

/// The facts of goals of which some repeat the one before, and add to it.
fn each_once(goals: &[Vec<GoalFact>]) -> Vec<GoalFact> {
    let mut before: &[GoalFact] = &[];
    let mut all = Vec::new();
    for goal in goals {
        all.extend_from_slice(goal.strip_prefix(before).unwrap_or(goal));
        before = goal;
    }
    all
}

fn report_of(
    (number, directive): (usize, &Directive),
    belief: &Belief,
    leg: &Leg,
    after: After,
    relations: &mut Followed,
) -> Report {
    let say = |relations: &Relations| {
        describe(&belief.world, relations, belief.map, belief.pose, false).map(|w| w.position)
    };
    let points = leg.route.as_ref().map(|r| r.points.clone()).unwrap_or_default();
    Report {
        number,
        directive: directive.clone(),
        map: belief.map,
        pose: belief.pose,
        position: relations.of(&belief.world).ok().and_then(say),
        length: leg.route.as_ref().map_or(0.0, |r| r.length),
        points,
        seconds: leg.seconds,
        after,
    }
}

impl State {
    /// Nothing was begun, since the vehicle cannot be used; the robot is held to be where it was.
    pub(super) fn not_begun(&self, failure: Failure) -> Result<TaskAnswer, Error> {
        let (map, pose) = self.robot()?;
        Ok(TaskAnswer {
            goal: Vec::new(),
            map,
            start: pose,
            end: pose,
            end_map: map,
            reports: Vec::new(),
            replans: 0,
            seconds: 0.0,
            ending: TaskEnding::Failed(failure),
            left: Vec::new(),
            strays: Vec::new(),
            lying: Vec::new(),
            kept: Vec::new(),
            others_done: false,
            not_begun: Vec::new(),
            tidies: false,
            stops: false,
            reported: None,
            unsure: Vec::new(),
            after: None,
        })
    }
}
