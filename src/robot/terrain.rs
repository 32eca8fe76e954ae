//! What the floor makes of a plan for a scenario: the rules know rooms and doors, and nothing of the floor.
//!
//! Before there is a plan, each ground action that drives or opens a door is asked of the floor once; what has no way is no
//! action of the task ([`Clock::allows`]). A plan made of the rest is carried out in a simulated world that is the map, as
//! that of a mission is (`robot/rehearsal`), since how doors are set meanwhile may bar a way: what is refused there is
//! left out as well, and another plan sought.
//!
//! **Invariant**: what a scenario says of things and places that the map does not know is taken to be so.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::FloorPlan;
use crate::graphplan::{self, Limits, Outcome, Plan, Unfinished};
use crate::map::World;
use crate::semantics::{Followed, RelationRules, predicate};
use crate::strips::{Domain, OperatorId, Problem, RuleFaults, Said, Task};
use crate::units::{Bilingual, MapId, name_key};

use super::belief::{Belief, Station};
use super::directive::Directive;
use super::event::Surprise;
use super::grounding::grounded;
use super::mission::{Mission, refused_on_floor};
use super::passable::{Found, Passable, Refused};
use super::solve::{self, Replanned, Solved, Wanted, timed, told};
use super::timing::{Clock, leave_out};

/// The floor that a scenario's plan is to be driven on.
pub struct Terrain<'a> {
    world: &'a World,
    floors: &'a BTreeMap<MapId, FloorPlan>,
    relations: Followed,
    rules: &'a RelationRules,
    /// How a surprise is told of.
    words: fn(&World, &Surprise) -> Bilingual,
    pub(super) clock: Clock<'a>,
}

impl<'a> Terrain<'a> {
    #[must_use]
    pub fn new(
        world: &'a World,
        relations: Followed,
        floors: &'a BTreeMap<MapId, FloorPlan>,
        rules: &'a RelationRules,
        words: fn(&World, &Surprise) -> Bilingual,
    ) -> Self {
        let clock = Clock::new(world, relations.relations(), floors);
        Self { world, floors, relations, rules, words, clock }
    }

    /// A mission at the scenario's beginning; none where the map does not tell where that is.
    fn trial<'d>(
        &mut self,
        domain: &'d Domain,
        problem: &Problem,
        limits: &Limits,
    ) -> Option<Mission<'d>>
    where
        'a: 'd,
    {
        let begins = |predicate: &str| {
            let key = name_key(predicate);
            let mut facts = problem.stated_facts().filter(|fact| !fact.is_negated());
            facts.find(|fact| name_key(fact.predicate()) == key)?.args().first().cloned()
        };
        let (at, station) = if let Some(place) = begins(predicate::ROBOT_AT_PLACE) {
            (self.clock.stands_at(&place, None)?, Station::Place(place))
        } else {
            let room = self.clock.atlas.area_named(&begins(predicate::ROBOT_IN)?)?;
            let door = begins(predicate::ROBOT_AT_DOOR)?;
            (self.clock.stands_at(&door, Some(room))?, Station::Door(door))
        };
        let mut belief = Belief::new(self.world.clone(), self.floors.clone(), at.0, at.1)?;
        belief.station = station;
        let (relations, limits) = (self.relations.clone(), limits.quiet());
        let mission = Mission::new(belief, domain, relations, self.rules, limits);
        Some(mission.knowing(&self.clock))
    }

    /// The first action of a plan that is refused when it is tried.
    fn refused_of(
        &self,
        domain: &Domain,
        task: &Task,
        plan: impl Iterator<Item = OperatorId>,
        trial: &Mission<'_>,
        limits: &Limits,
    ) -> Option<(OperatorId, Surprise)> {
        let ids: Vec<OperatorId> = plan.filter(|&id| !task.is_goal_step(id)).collect();
        let directives: Vec<_> = ids.iter().map(|&id| directive(domain, task, id)).collect();
        let stop = limits.stop.clone().unwrap_or_default();
        let (at, surprise) = refused_on_floor(trial, &directives, &stop)?;
        Some((ids[at], surprise))
    }

    /// What the floor refuses of a plan that the rules allow.
    fn refused(
        &mut self,
        domain: &Domain,
        task: &Task,
        plan: &Plan,
        trial: Option<Mission<'_>>,
        limits: &Limits,
    ) -> Vec<Refused> {
        let first =
            trial.and_then(|trial| self.refused_of(domain, task, plan.operators(), &trial, limits));
        if let Some((id, surprise)) = first {
            let why = Some((self.words)(self.world, &surprise));
            return vec![Refused { action: Said::from(task.operator(id)), why }];
        }
        let actions = plan.operators().filter(|&id| !task.is_goal_step(id));
        let refused = actions.filter(|&id| !self.clock.allows(&directive(domain, task, id)));
        refused.map(|id| Refused { action: Said::from(task.operator(id)), why: None }).collect()
    }
}

impl Passable for Terrain<'_> {
    fn search(
        &mut self,
        (domain, problem): (&Domain, &Problem),
        task: &mut Task,
        limits: &Limits,
        search: &mut dyn FnMut(&Task) -> Outcome,
    ) -> Found {
        let trial = self.trial(domain, problem, limits);
        let whole = task.clone();
        self.clock.bar(domain, task);
        let outcome = loop {
            let outcome = search(task);
            let refused = outcome.plan().and_then(|plan| {
                self.refused_of(domain, task, plan.operators(), trial.as_ref()?, limits)
            });
            let Some((id, _)) = refused else { break outcome };
            let refused = directive(domain, task, id);
            leave_out(task, |task, id| is_alike(&refused, &directive(domain, task, id)));
        };
        let is_whole = task.operators.len() == whole.operators.len();
        if is_whole || !matches!(outcome, Outcome::NoPlan { .. }) {
            return (outcome, Vec::new());
        }
        match graphplan::solve_any(&whole, &limits.quiet().one_of_several()) {
            Outcome::Plan(plan) => (outcome, self.refused(domain, &whole, &plan, trial, limits)),
            // It is not the floor that it fails for.
            Outcome::NoPlan { .. } => {
                *task = whole;
                (search(task), Vec::new())
            }
            Outcome::LimitReached(_) => (outcome, Vec::new()),
        }
    }

    fn lets_pass(
        &mut self,
        (domain, problem): (&Domain, &Problem),
        task: &Task,
        plan: &Plan,
        limits: &Limits,
    ) -> bool {
        self.trial(domain, problem, limits).is_none_or(|trial| {
            self.refused_of(domain, task, plan.operators(), &trial, limits).is_none()
        })
    }
}

/// As [`solve`](fn@super::solve), on a floor where there is one: of what the rules allow that has no way there.
///
/// # Errors
/// The problem names what the rules do not know.
pub fn solve_on(
    terrain: Option<&mut Terrain<'_>>,
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    wanted: Wanted,
) -> Result<Solved, RuleFaults> {
    solve::solve_on(terrain.map(as_floor), domain, problem, limits, wanted)
}

/// Plans, withdraws assumptions, and plans anew with what was learned the first time, where that is sound.
///
/// `withdrawn` are texts as [`Problem::withdraw_assumptions`] reads them. Any plan soon is planned anew from the
/// beginning: the graph is not what it came from.
///
/// # Errors
/// As [`solve_on`]; and what cannot be withdrawn, all of it at once.
pub fn solve_without(
    terrain: Option<&mut Terrain<'_>>,
    domain: &Domain,
    problem: &mut Problem,
    withdrawn: &[String],
    limits: &Limits,
    wanted: Wanted,
) -> Result<Replanned, RuleFaults> {
    solve::solve_without(terrain.map(as_floor), domain, problem, withdrawn, limits, wanted)
}

fn as_floor<'t>(terrain: &'t mut Terrain<'_>) -> &'t mut dyn Passable {
    terrain
}

/// The plan that is driven in the least time on a floor, however many steps it has; of preferences those are met that can be
/// in the shortest plan.
///
/// # Errors
/// As [`solve_on`]; and, within, the names of which the map does not tell where they are.
pub fn solve_quickest(
    domain: &Domain,
    problem: &Problem,
    terrain: &mut Terrain<'_>,
    limits: &Limits,
) -> Result<Result<Solved, BTreeSet<String>>, RuleFaults> {
    if problem.preferences().next().is_some() {
        let shortest = Wanted::Shortest;
        let chosen = solve::solve_on(Some(&mut *terrain), domain, problem, limits, shortest)?;
        let Some(wishes) = &chosen.wishes else { return Ok(Ok(chosen)) };
        let all: Vec<_> = problem.preferences().cloned().collect();
        let kept = problem.with_preferences(|number| wishes.met.contains(&all[number]));
        let quickest = solve_quickest(domain, &kept, terrain, limits)?;
        return Ok(quickest.map(|solved| Solved { wishes: chosen.wishes, ..solved }));
    }
    let mut at_least = 0;
    let mut search = |task: &Task| {
        let (outcome, least) = graphplan::solve_cheapest(task, limits);
        at_least = least;
        outcome
    };
    let mut task = match grounded(domain, problem, limits)? {
        Ok(task) => task,
        Err(limit) => {
            let found = (Outcome::LimitReached(Unfinished::in_grounding(limit)), Vec::new());
            return told(domain, problem, Task::default(), found, None, Wanted::Any, limits)
                .map(Ok);
        }
    };
    let unknown = terrain.clock.charge(domain, &mut task);
    if !unknown.is_empty() {
        return Ok(Err(unknown));
    }
    let found = terrain.search((domain, problem), &mut task, limits, &mut search);
    timed(domain, problem, task, found, at_least, limits).map(Ok)
}

fn directive(domain: &Domain, task: &Task, id: OperatorId) -> Directive {
    Directive::of(domain, task, task.operator(id))
}

/// Whether two directives ask for the same in the same room, wherever in it the robot comes from.
fn is_alike(one: &Directive, other: &Directive) -> bool {
    let room = |directive: &Directive| {
        let key = name_key(predicate::ROBOT_IN);
        let need = directive.needs.iter().find(|need| need.predicate == key)?;
        need.args.first().map(|room| name_key(room))
    };
    one.primitives() == other.primitives() && room(one) == room(other)
}
