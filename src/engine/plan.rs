//! Plans for scenarios: a rule file's problem, supplemented with what the Map knows.

use crate::graphplan::Limits;
use crate::map::{Entity, World};
use crate::robot::{
    Replanned, Solved, Surprise, Terrain, Wanted, facts_of_map, solve_on, solve_quickest,
    solve_without, state,
};
use crate::semantics::predicate;
use crate::strips::{
    Domain, PlanText, Problem, Replayed, RuleError, RuleFault, Scenario, without_price,
};
use crate::units::{Bilingual, ReplicaId, name_key};

use super::error::in_both;
use super::{Error, RequestError, State, surprise_in_words};

/// The types of things that the Map alone makes known.
const OF_MAP: [&str; 2] = ["помещение", "дверь"];

/// One action of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanStep {
    pub action: String,
    pub args: Vec<String>,
}

/// A scenario's plan, or why it has none.
#[derive(Debug, Clone)]
pub struct PlanAnswer {
    pub solved: Solved,
    /// Harmless faults of the rule files.
    pub warnings: Vec<RuleFault>,
}

impl PlanAnswer {
    fn of(mut solved: Solved, warnings: Vec<RuleFault>) -> Self {
        solved.is_of_whole_actions = are_whole(&warnings);
        Self { solved, warnings }
    }

    /// Plans a scenario that needs no map.
    ///
    /// # Errors
    /// All faults of the scenario.
    pub fn without_map(scenario: Scenario, limits: &Limits, wanted: Wanted) -> Result<Self, Error> {
        let Scenario { domain, problem, warnings, .. } = scenario;
        planned(None, &domain, &problem, warnings, limits, wanted)
    }

    /// The parallel steps, empty unless there is a plan.
    #[must_use]
    pub fn steps(&self) -> Vec<Vec<PlanStep>> {
        steps(&self.solved)
    }
}

/// Whether actions of the scenario last, and are planned each as one.
fn are_whole(warnings: &[RuleFault]) -> bool {
    warnings.iter().any(|fault| matches!(*fault.error, RuleError::Durations { .. }))
}

/// The parallel steps of a plan, empty unless there is one; where the search was given up, of the best that was found.
#[must_use]
pub(super) fn steps(solved: &Solved) -> Vec<Vec<PlanStep>> {
    let Some(plan) = solved.outcome.plan() else { return Vec::new() };
    let step = |&id| {
        let operator = solved.task.operator(id);
        PlanStep {
            action: operator.name.to_string(),
            args: operator.args.iter().map(ToString::to_string).collect(),
        }
    };
    plan.steps.iter().map(|parallel| parallel.iter().map(step).collect()).collect()
}

impl State {
    /// Plans a scenario with the facts of the map that the engine holds, if it holds one: a plan that can be driven on its
    /// floor.
    ///
    /// # Errors
    /// All faults of the scenario.
    pub fn plan(
        &self,
        scenario: Scenario,
        limits: &Limits,
        wanted: Wanted,
    ) -> Result<PlanAnswer, Error> {
        self.plan_supplied(self.supplemented(scenario)?, limits, wanted)
    }

    /// The same for a scenario that the map has supplemented.
    ///
    /// # Errors
    /// All faults of the scenario.
    pub fn plan_supplied(
        &self,
        scenario: Scenario,
        limits: &Limits,
        wanted: Wanted,
    ) -> Result<PlanAnswer, Error> {
        if self.world().is_err() {
            return PlanAnswer::without_map(scenario, limits, wanted);
        }
        let Scenario { domain, problem, warnings, .. } = scenario;
        self.on_terrain(&problem, |terrain| {
            planned(Some(terrain), &domain, &problem, warnings, limits, wanted)
        })
    }

    /// The same; then assumptions are withdrawn, and it is planned anew with what was learned.
    ///
    /// # Errors
    /// All faults of the scenario, and of what is to be withdrawn.
    pub fn plan_supplied_without(
        &self,
        scenario: Scenario,
        withdrawn: &[String],
        limits: &Limits,
        wanted: Wanted,
    ) -> Result<(Replanned, Vec<RuleFault>), Error> {
        if self.world().is_err() {
            return plan_alone_without(scenario, withdrawn, limits, wanted);
        }
        let Scenario { domain, problem, warnings, .. } = scenario;
        self.on_terrain(&problem, |terrain| {
            let given = (&domain, problem.clone(), warnings);
            planned_without(Some(terrain), given, withdrawn, limits, wanted)
        })
    }

    /// The plan for a scenario, supplemented with the map, that is driven in the least time on the map's floor.
    ///
    /// # Errors
    /// There is no map, or it does not tell where something is that the scenario has the robot go to; all faults of the
    /// scenario.
    pub fn plan_quickest(&self, scenario: Scenario, limits: &Limits) -> Result<PlanAnswer, Error> {
        let Scenario { domain, problem, warnings, .. } = scenario;
        let solved = self.on_terrain(&problem, |terrain| {
            Ok(solve_quickest(&domain, &problem, terrain, limits)?.map_err(|names| {
                let both =
                    |name: String| self.world().map_or(name.clone().into(), |w| in_both(w, &name));
                let names: Vec<Bilingual> = names.into_iter().map(both).collect();
                RequestError::Untimed { names: Bilingual::list(&names) }
            })?)
        })?;
        Ok(PlanAnswer::of(solved, warnings))
    }

    /// The map's floor as a scenario finds it: what is to be pushed stands nowhere on it, since the rules tell where that
    /// goes.
    fn on_terrain<T>(
        &self,
        problem: &Problem,
        plan: impl FnOnce(&mut Terrain<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let (world, floors) = (self.world()?, self.floors()?);
        let key = name_key(predicate::BLOCKS_DOOR);
        let stated = problem.stated_facts();
        let pushed = stated.filter(|fact| name_key(fact.predicate()) == key);
        let things = pushed.flat_map(|fact| fact.args().first().map(|name| world.find(name)));
        let of_thing = |entity| if let Entity::Replica(id) = entity { Some(id) } else { None };
        let things: Vec<ReplicaId> = things.flatten().filter_map(of_thing).collect();
        let relations = self.followed(world)?;
        let rules = &self.rules().relations;
        if things.is_empty() {
            return plan(&mut Terrain::new(world, relations, floors, rules, told));
        }
        let (mut world, mut floors) = (world.clone(), floors.clone());
        for thing in &things {
            world.replicas.remove(thing);
        }
        floors.values_mut().for_each(|floor| floor.rebuild(&world, &things));
        plan(&mut Terrain::new(&world, relations, &floors, rules, told))
    }

    /// A scenario with the facts of the map that the engine holds, if it holds one.
    ///
    /// # Errors
    /// Names of rooms and doors that the map does not know.
    pub fn supplemented(&self, mut scenario: Scenario) -> Result<Scenario, Error> {
        self.supply(&mut scenario)?;
        if self.world().is_ok() {
            scenario.problem.check_supplied(&scenario.domain, &OF_MAP)?;
        }
        Ok(scenario)
    }

    /// States what the map knows, and checks nothing.
    ///
    /// # Errors
    /// The map's relations cannot be derived.
    pub fn supply(&self, scenario: &mut Scenario) -> Result<(), Error> {
        if let Ok(world) = self.world() {
            let facts = facts_of_map(world, self.relations()?);
            for fact in &facts {
                state(&mut scenario.problem, fact);
            }
            self.surveyed()?.call_in_english(&mut scenario.problem, &facts);
        }
        Ok(())
    }
}

/// What the floor refuses, in words.
fn told(world: &World, surprise: &Surprise) -> Bilingual {
    Bilingual::both(|language| surprise_in_words(world, surprise, language))
}

/// Plans a scenario that needs no map, withdraws assumptions, and plans anew with what was learned.
///
/// # Errors
/// All faults of the scenario, and of what is to be withdrawn.
pub(crate) fn plan_alone_without(
    scenario: Scenario,
    withdrawn: &[String],
    limits: &Limits,
    wanted: Wanted,
) -> Result<(Replanned, Vec<RuleFault>), Error> {
    let Scenario { domain, problem, warnings, .. } = scenario;
    planned_without(None, (&domain, problem, warnings), withdrawn, limits, wanted)
}

fn planned_without(
    terrain: Option<&mut Terrain<'_>>,
    (domain, mut problem, mut warnings): (&Domain, Problem, Vec<RuleFault>),
    withdrawn: &[String],
    limits: &Limits,
    wanted: Wanted,
) -> Result<(Replanned, Vec<RuleFault>), Error> {
    let mut replanned = solve_without(terrain, domain, &mut problem, withdrawn, limits, wanted)?;
    for solved in [&mut replanned.before, &mut replanned.after] {
        solved.is_of_whole_actions = are_whole(&warnings);
    }
    warnings.extend(without_price(domain, &problem, &replanned.after.task)?);
    Ok((replanned, warnings))
}

fn planned(
    terrain: Option<&mut Terrain<'_>>,
    domain: &Domain,
    problem: &Problem,
    mut warnings: Vec<RuleFault>,
    limits: &Limits,
    wanted: Wanted,
) -> Result<PlanAnswer, Error> {
    let solved = solve_on(terrain, domain, problem, limits, wanted)?;
    warnings.extend(without_price(domain, problem, &solved.task)?);
    Ok(PlanAnswer::of(solved, warnings))
}

/// Carries a plan out on a scenario that needs no map.
///
/// # Errors
/// All faults of the scenario; that the plan breaks is no error.
pub(crate) fn check_plan_alone(scenario: &Scenario, plan: &PlanText) -> Result<Replayed, Error> {
    Ok(plan.replay(&scenario.domain, &scenario.problem)?)
}
