//! A mission: a goal, planned, driven directive by directive, and planned anew when the world is not as believed (X2).

use crate::graphplan::{Learned, Limits, Outcome};
use crate::map::{DoorState, Entity, World};
use crate::semantics::planning::PlanPlace;
use crate::semantics::{Followed, Join, Lift, RelationError, RelationRules, lifts, predicate};
use crate::strips::{Domain, OperatorId, Problem, RuleFaults};
use crate::units::{MapId, Pose, Stop};

use std::collections::BTreeMap;

use miette::Diagnostic;
use thiserror::Error;

mod acts;
mod aside;
mod clearing;
mod gathered;
mod missed;
mod names;
mod pursuit;
mod rehearsal;
mod round;

pub(super) use names::before_passage;
pub(super) use rehearsal::refused_on_floor;
use rehearsal::{Known, rehearse};

use super::ahead::{Ahead, Lasting};
use super::atlas::Atlas;
use super::belief::Belief;
use super::directive::{Directive, Primitive};
use super::event::{Ending, Event, Leg, Planned, Surprise};
use super::goal::{GoalFact, state};
use super::idle::without_idle;
use super::reins::Reins;
use super::solve::{solve_again, solve_in_time};
use super::timing::Clock;
use super::vehicle::{
    Bump, Failure, Obstruction, Outlines, Refusal, Sighting, Unfinished, Vehicle,
};

/// So often what is seen of one thing may change the belief in one mission.
const MOST_CHANGES: usize = 20;

/// A mission that cannot even be planned.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum MissionError {
    /// The goal or the rules name what neither the Map nor the rules know.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Rules(#[from] RuleFaults),
    /// The relations of what is believed cannot be derived.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Relations(#[from] RelationError),
}

impl MissionError {
    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Rules(faults) => Box::new(faults.in_english()),
            Self::Relations(error) => error.in_english(),
        }
    }
}

/// Plans and carries out goals on a belief of its own.
#[derive(Debug, Clone)]
pub struct Mission<'r> {
    pub belief: Belief,
    domain: &'r Domain,
    relations: Followed,
    pub(super) rules: &'r RelationRules,
    limits: Limits,
    /// Of the plan in force.
    pub(super) places: Vec<PlanPlace>,
    joins: Vec<Join>,
    lifts: Vec<Lift>,
    /// How often what was seen of each thing changed the belief.
    changes: BTreeMap<Obstruction, usize>,
    /// Whether the plan is wanted that is driven in the least time.
    in_time: bool,
    /// What of the floors nothing changes; found where it is first asked for.
    lasting: Option<Lasting>,
}

impl<'r> Mission<'r> {
    /// `relations` are of the world that is believed, or of one from which it can be followed.
    #[must_use]
    pub fn new(
        belief: Belief,
        domain: &'r Domain,
        relations: Followed,
        rules: &'r RelationRules,
        limits: Limits,
    ) -> Self {
        let (places, joins, lifts) = (Vec::new(), Vec::new(), Vec::new());
        let (changes, in_time, lasting) = (BTreeMap::new(), false, None);
        Self {
            belief,
            domain,
            relations,
            rules,
            limits,
            places,
            joins,
            lifts,
            changes,
            in_time,
            lasting,
        }
    }

    /// The same, that plans for the least driven time, however many steps it takes.
    #[must_use]
    pub fn in_least_time(self) -> Self {
        Self { in_time: true, ..self }
    }

    /// The same, given a plan that names the places, doors and lifts of the map.
    pub(super) fn knowing(self, clock: &Clock<'_>) -> Self {
        let Atlas { places_named, joins, .. } = &clock.atlas;
        let (places, joins) = (places_named.clone(), joins.clone());
        Self { places, joins, lifts: clock.lifts.clone(), ..self }
    }

    /// The plan for a goal from what is believed now.
    ///
    /// # Errors
    /// [`MissionError`].
    pub fn plan(&mut self, goal: &[GoalFact]) -> Result<Planned, MissionError> {
        Ok(self.plan_again(goal, None)?.0)
    }

    /// The same, with what the plan before had taught.
    fn plan_again(
        &mut self,
        goal: &[GoalFact],
        learned: Option<&Learned>,
    ) -> Result<(Planned, Option<Learned>), MissionError> {
        let mut problem = Problem::new();
        self.relations.of(&self.belief.world)?;
        if self.rules.asks_the_robot() {
            let believed = self.relations.told().believed.clone();
            let told = self.belief.told(self.relations.relations(), believed);
            self.relations.tell(told)?;
        }
        let relations = self.relations.relations();
        let (mut facts, places) = self.belief.initial(relations);
        facts.extend(self.belief.name_views(&facts));
        for fact in &without_idle(facts, goal) {
            state(&mut problem, fact);
        }
        for fact in goal {
            let args: Vec<&str> = fact.args.iter().map(String::as_str).collect();
            problem.add_goal(&fact.predicate, &args);
        }
        let in_time = match self.in_time {
            true => {
                let belief = &self.belief;
                let mut clock = Clock::new(&belief.world, relations, belief.floors());
                clock = clock.knowing(&belief.spots);
                solve_in_time(self.domain, &problem, &mut clock, &self.limits)?
            }
            false => None,
        };
        let (solved, now_learned) = match in_time {
            Some(solved) => (solved, None),
            None => {
                let (belief, near) = (&self.belief, self.rules.hold_cm());
                let known = self.lasting.take().filter(|lasting| lasting.holds(belief));
                let lasting =
                    self.lasting.insert(known.unwrap_or_else(|| Lasting::of(belief, near)));
                let mut ahead = Ahead { belief, relations, places: &places, lasting };
                solve_again(Some(&mut ahead), self.domain, &problem, &self.limits, learned)?
            }
        };
        let learned_before = learned.is_some_and(|learned| learned.serves(&solved.task));
        let steps = match solved.outcome.plan() {
            Some(plan) => {
                let directive = |&o| {
                    let operator = solved.task.operator(o);
                    Directive::of(self.domain, &solved.task, operator).putting(&self.belief.into)
                };
                plan.steps.iter().map(|step| step.iter().map(directive).collect()).collect()
            }
            None => Vec::new(),
        };
        let (joins, lifts) = (relations.joins(), lifts(&self.belief.world, relations));
        Ok((Planned { solved, steps, places, joins, lifts, learned_before }, now_learned))
    }

    /// Plans, drives and plans anew until the goal holds or is shown to be out of reach.
    ///
    /// A plan is begun only when it could be carried out in the world as it is believed to be: see `rehearse`.
    ///
    /// Every surprise must teach something (a door's state, a thing's place, a way that is none), of which
    /// there is only so much; so the mission ends. It ends at once when it is told to stop, in planning or on the way, and
    /// the vehicle then stands; what is believed is so, and another goal may follow.
    ///
    /// # Errors
    /// As [`Mission::plan`].
    pub fn run(
        &mut self,
        goal: &[GoalFact],
        vehicle: &mut dyn Vehicle,
        stop: &Stop,
        tell: &mut dyn FnMut(&Event<'_>),
    ) -> Result<Ending, MissionError> {
        self.limits.stop = Some(stop.clone());
        self.changes.clear();
        match Reins::new(vehicle, (self.belief.map, self.belief.pose), stop, tell) {
            Ok(mut reins) => {
                // What was seen counts before the first metre.
                self.take_notice(&mut reins);
                let ending = self.pursue(goal, &mut reins);
                self.gather(&reins);
                ending
            }
            Err(failure) => Ok(Ending::Failed(failure)),
        }
    }

    fn attempt(
        &mut self,
        goal: &[GoalFact],
        reins: &mut Reins<'_>,
    ) -> Result<Ending, MissionError> {
        let mut moved = false;
        let mut learned: Option<Learned> = None;
        let mut given_up = None;
        loop {
            if reins.stop.is_raised() {
                return Ok(Ending::Stopped);
            }
            let (planned, now_learned) = match (self.plan_again(goal, learned.as_ref()), given_up) {
                // A place that proved to be out of reach is none to the next plan, and the goal speaks of it.
                (Err(MissionError::Rules(_)), Some(surprise)) => {
                    return Ok(Ending::Stuck(surprise));
                }
                (planned, before) => {
                    given_up = before;
                    planned?
                }
            };
            // A search that was cut short says nothing.
            if reins.stop.is_raised() {
                return Ok(Ending::Stopped);
            }
            if matches!(planned.solved.outcome, Outcome::NoPlan { .. })
                && (self.belief.widen_search() || self.push_aside())
            {
                learned = now_learned.and_then(|learned| learned.after(&[]));
                continue;
            }
            // The rules do not tell what is in the way where a way was given up, only that there is none.
            if let (Outcome::NoPlan { .. }, Some(surprise)) =
                (&planned.solved.outcome, given_up.take())
            {
                return Ok(Ending::Stuck(surprise));
            }
            let Some(plan) = planned.solved.outcome.plan() else {
                return Ok(Ending::NoPlan(Box::new(planned)));
            };
            let directives: Vec<&Directive> = planned.steps.iter().flatten().collect();
            self.places.clone_from(&planned.places);
            self.joins.clone_from(&planned.joins);
            self.lifts.clone_from(&planned.lifts);
            if let Err((known, surprise)) = rehearse(self, &directives, &reins.stop) {
                if !self.take_over(known) {
                    return Ok(Ending::Stuck(surprise));
                }
                given_up = Some(surprise);
                learned = now_learned.and_then(|learned| learned.after(&[]));
                continue;
            }
            (reins.tell)(&Event::Planned(&planned));
            if directives.is_empty() {
                return Ok(if moved { Ending::Done } else { Ending::AlreadyTrue });
            }
            moved = true;
            let (done, surprise) = match self.carry_out(&directives, reins) {
                Ok(()) => return Ok(Ending::Done),
                Err((done, Unfinished::Met(surprise))) => (done, surprise),
                Err((_, Unfinished::Stopped)) => return Ok(Ending::Stopped),
                Err((_, Unfinished::Failed(failure))) => return Ok(Ending::Failed(failure)),
            };
            if let Some(times) = self.is_restless(&surprise) {
                return Ok(Ending::Failed(Failure::Restless { times }));
            }
            let has_noticed = self.take_notice(reins).is_some();
            if let Some(looked) = self.look_for_missed(&surprise, reins)? {
                match looked {
                    Ending::Done | Ending::AlreadyTrue => {}
                    Ending::NoPlan(_) | Ending::Stuck(_) => return Ok(Ending::Stuck(surprise)),
                    Ending::Stopped | Ending::Failed(_) => return Ok(looked),
                }
                (given_up, learned) = (None, None);
                continue;
            }
            // What was noticed at the end of the last directive hindered none.
            if !self.learn(&surprise, directives[done.min(directives.len() - 1)]) && !has_noticed {
                return Ok(Ending::Stuck(surprise));
            }
            let bars = surprise.bars_a_way() || self.is_new(&surprise);
            given_up = bars.then_some(surprise);
            learned = now_learned.and_then(|learned| learned.after(&first(&plan.steps, done)));
        }
    }

    /// Carries out directives in order until one fails: how many were done, and why that one was not.
    pub(super) fn carry_out(
        &mut self,
        directives: &[&Directive],
        reins: &mut Reins<'_>,
    ) -> Result<(), (usize, Unfinished<Surprise>)> {
        for (i, directive) in directives.iter().enumerate() {
            let number = i + 1;
            if reins.stop.is_raised() {
                self.broke_off(directive, &Unfinished::Stopped, reins);
                return Err((i, Unfinished::Stopped));
            }
            (reins.tell)(&Event::Started { number, of: directives.len(), directive });
            let begun = reins.time();
            let mut leg = Leg::default();
            let result = directive
                .primitives()
                .iter()
                .try_for_each(|primitive| self.perform(primitive, reins, &mut leg));
            leg.seconds = reins.time() - begun;
            self.belief.pose = reins.pose().1;
            if let Err(unfinished) = result {
                self.broke_off(directive, &unfinished, reins);
                return Err((i, unfinished));
            }
            (reins.tell)(&Event::Finished { number, directive, belief: &self.belief, leg: &leg });
            if let Some(seen) = self.take_notice(reins) {
                let noticed = Unfinished::Met(Surprise::Noticed { seen });
                self.broke_off(directive, &noticed, reins);
                return Err((number, noticed));
            }
        }
        Ok(())
    }

    /// A directive was not done to its end: who looks on is told why, or the robot stands somewhere on its way.
    fn broke_off(
        &mut self,
        directive: &Directive,
        unfinished: &Unfinished<Surprise>,
        reins: &mut Reins<'_>,
    ) {
        let belief = &mut self.belief;
        match unfinished {
            Unfinished::Met(surprise) => {
                (reins.tell)(&Event::Surprised { directive, surprise, belief });
            }
            Unfinished::Stopped | Unfinished::Failed(_) => {
                (belief.map, belief.pose) = reins.pose();
                self.take_notice(reins);
                self.name_this_point();
            }
        }
    }

    /// Takes over what the vehicle saw on its way; the last of it that was news.
    fn take_notice(&mut self, reins: &mut Reins<'_>) -> Option<Sighting> {
        let seen = std::mem::take(&mut reins.seen);
        seen.into_iter().filter(|seen| self.belief.learn(*seen)).last()
    }

    /// Counts how often a thing was seen otherwise than before; the number, once it is too often.
    fn is_restless(&mut self, surprise: &Surprise) -> Option<usize> {
        let what = match surprise {
            Surprise::Noticed { seen }
            | Surprise::Blocked { seen: Some(seen), .. }
            | Surprise::Refused { seen: Some(seen), .. } => match seen {
                Sighting::Door { door, .. } => Obstruction::Door(*door),
                Sighting::Replica { replica, .. } => Obstruction::Replica(*replica),
            },
            Surprise::Displaced => Obstruction::Something,
            _ => return None,
        };
        let times = self.changes.entry(what).or_default();
        *times += 1;
        (*times > MOST_CHANGES).then_some(*times)
    }

    /// Whether something stood in the way of which the Map knows nothing.
    fn is_new(&self, surprise: &Surprise) -> bool {
        let Surprise::Blocked { bump, .. } = surprise else { return false };
        match bump.against {
            Obstruction::Something => true,
            Obstruction::Replica(id) => !self.belief.world.replicas.contains_key(&id),
            Obstruction::Wall(_) | Obstruction::Door(_) => false,
        }
    }

    /// Changes the belief; false when the surprise says nothing that was not believed already.
    fn learn(&mut self, surprise: &Surprise, directive: &Directive) -> bool {
        let near = *self.relations.relations().thresholds();
        match surprise {
            // It was not gone.
            Surprise::Blocked { bump, .. }
                if self.is_new(surprise)
                    && self.belief.find_again(Some((bump.at.at, near.robot_lost))) =>
            {
                self.name_this_point();
                true
            }
            Surprise::Refused { refusal: Refusal::DoorJammed { by: None, .. }, .. }
                if self.belief.find_again(None) =>
            {
                self.name_this_point();
                true
            }
            // What was seen of it stands there from now on, and a way may lead past it.
            Surprise::Blocked { outlines, .. }
                if self.is_new(surprise) && self.belief.stand(outlines) =>
            {
                self.name_this_point();
                true
            }
            // How large it is nobody knows: the way of this directive is given up, others may be free.
            Surprise::Blocked { .. } if self.is_new(surprise) => {
                self.name_this_point();
                let aims =
                    directive.primitives().into_iter().filter_map(|primitive| match primitive {
                        Primitive::GoToPlace(name) | Primitive::GoToDoor(name) => Some(name),
                        Primitive::Cross { door, .. } => Some(door),
                        _ => None,
                    });
                // Each of them is noted.
                aims.map(|name| self.belief.no_way_for_now(name)).filter(|news| *news).count() > 0
            }
            // Where the thing stands may be known; that the door does not open for it was not.
            Surprise::Refused { refusal: Refusal::DoorJammed { door, by: Some(_), .. }, seen } => {
                self.name_this_point();
                let name = self.belief.world.name(Entity::Door(*door)).to_owned();
                let moved = seen.is_some_and(|seen| self.belief.learn(seen));
                self.belief.no_way_to(name) || moved
            }
            Surprise::Refused { refusal: Refusal::Stays(thing), .. } => self.belief.stays(*thing),
            // The hand that tried a lock knows, whatever there is to see of the door.
            Surprise::Refused { refusal: Refusal::Locked(door), .. } => {
                self.name_this_point();
                self.belief.learn(Sighting::Door { door: *door, state: DoorState::LOCKED })
            }
            Surprise::Blocked { seen: Some(seen), .. }
            | Surprise::Refused { seen: Some(seen), .. } => {
                // The robot stopped somewhere on its way; from here on that is its place.
                self.name_this_point();
                self.belief.learn(*seen)
            }
            Surprise::Displaced => {
                self.name_this_point();
                self.belief.floor().locate(self.belief.pose.at).is_some()
            }
            // It was taken over when it was noticed.
            Surprise::Noticed { .. } => true,
            Surprise::NoWay { to, .. } => self.belief.no_way_to(to.clone()),
            Surprise::NotSeen { thing, area, .. } => self.belief.searched(thing, *area),
            Surprise::NoReturn { door, area, .. } => {
                let door = self.belief.world.name(Entity::Door(*door)).to_owned();
                self.belief.no_return_by(*area, door)
            }
            _ => false,
        }
    }

    /// Takes over what a rehearsal found that the rules did not know; whether it was news.
    fn take_over(&mut self, known: Known) -> bool {
        match known {
            Known::NoWay(area, name) => {
                let way = (area, name);
                let news = !self.belief.unreachable.contains(&way);
                self.belief.unreachable.push(way);
                news
            }
            Known::NoReturn(area, door) => self.belief.no_return_by(area, door),
            Known::NoRoom(both) => {
                self.domain.predicate(predicate::NO_ROOM).is_some()
                    && self.belief.no_room.insert(*both)
            }
            Known::Stays(thing) => self.belief.stays(thing),
            Known::Nothing => false,
        }
    }
}

/// The steps that the first so many of all actions make up; the last may be there in part.
fn first(steps: &[Vec<OperatorId>], mut actions: usize) -> Vec<Vec<OperatorId>> {
    let mut first = Vec::new();
    for step in steps {
        let done = actions.min(step.len());
        if done == 0 {
            break;
        }
        first.push(step[..done].to_vec());
        actions -= done;
    }
    first
}

/// What the vehicle would not do, with what there is to see of the reason.
fn refused(unfinished: Unfinished<Refusal>, reins: &mut Reins<'_>) -> Unfinished<Surprise> {
    let about = |refusal: &Refusal| refusal.about();
    surprised(unfinished, reins, about, |refusal, seen| Surprise::Refused { refusal, seen })
}

/// What stood in the way, with what there is to see of it.
fn blocked(unfinished: Unfinished<Bump>, reins: &mut Reins<'_>) -> Unfinished<Surprise> {
    let about = |bump: &Bump| Some(bump.against);
    let outlines = Box::new(match &unfinished {
        Unfinished::Met(Bump { against: Obstruction::Something, .. }) => reins.outlines(),
        _ => Outlines::default(),
    });
    let blocked = |bump, seen| Surprise::Blocked { bump, seen, outlines };
    surprised(unfinished, reins, about, blocked)
}

fn surprised<Why>(
    unfinished: Unfinished<Why>,
    reins: &mut Reins<'_>,
    about: impl Fn(&Why) -> Option<Obstruction>,
    surprise: impl FnOnce(Why, Option<Sighting>) -> Surprise,
) -> Unfinished<Surprise> {
    match unfinished {
        Unfinished::Met(why) => match about(&why).map(|what| reins.look_at(what)).transpose() {
            Ok(seen) => Unfinished::Met(surprise(why, seen.flatten())),
            Err(failure) => Unfinished::Failed(failure),
        },
        Unfinished::Stopped => Unfinished::Stopped,
        Unfinished::Failed(failure) => Unfinished::Failed(failure),
    }
}

/// Turns round once.
pub(super) fn look_round(reins: &mut Reins<'_>) -> Result<(), Unfinished<Surprise>> {
    let looked = reins.act(|vehicle, watch| vehicle.look_round(watch));
    looked.map_err(|r| refused(r, reins))
}

/// Where the robot is when nothing else is known: the pose of the Map's starting place.
#[must_use]
pub fn starting_pose(world: &World) -> Option<(MapId, Pose)> {
    let place = world.places.get(&world.robot.start?)?;
    let (map, frame) = world.placement(place.area)?;
    let heading = place.heading.unwrap_or_default() + frame.angle;
    Some((map, Pose { at: frame.apply(place.at), heading }))
}
