//! Plans for scenarios: a rule file's problem, supplemented with what the Map knows.

use crate::graphplan::Limits;
use crate::robot::{
    Clock, Replanned, Solved, Wanted, facts_of_map, solve, solve_quickest, solve_without, state,
};
use crate::strips::{PlanText, Replayed, RuleError, RuleFault, Scenario, without_price};

use super::{Error, RequestError, State};

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
pub fn steps(solved: &Solved) -> Vec<Vec<PlanStep>> {
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
    /// Plans a scenario with the facts of the map that the engine holds, if it holds one.
    ///
    /// # Errors
    /// All faults of the scenario.
    pub fn plan(
        &self,
        scenario: Scenario,
        limits: &Limits,
        wanted: Wanted,
    ) -> Result<PlanAnswer, Error> {
        plan_alone(self.supplemented(scenario)?, limits, wanted)
    }

    /// The plan for a scenario, supplemented with the map, that is driven in the least time on the map's floor.
    ///
    /// # Errors
    /// There is no map, or it does not tell where something is that the scenario has the robot go to; all faults of the
    /// scenario.
    pub fn plan_quickest(&self, scenario: Scenario, limits: &Limits) -> Result<PlanAnswer, Error> {
        let mut clock = Clock::new(self.world()?, self.relations()?, self.floors()?);
        let Scenario { domain, problem, warnings, .. } = scenario;
        let solved = solve_quickest(&domain, &problem, &mut clock, limits)?.map_err(|names| {
            let names: Vec<String> = names.into_iter().collect();
            RequestError::Untimed { names: names.join(", ") }
        })?;
        Ok(PlanAnswer::of(solved, warnings))
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
            for fact in facts_of_map(world, self.relations()?) {
                state(&mut scenario.problem, &fact);
            }
        }
        Ok(())
    }
}

/// Plans a scenario that needs no map, withdraws assumptions, and plans anew with what was learned.
///
/// # Errors
/// All faults of the scenario, and of what is to be withdrawn.
pub fn plan_alone_without(
    scenario: Scenario,
    withdrawn: &[String],
    limits: &Limits,
    wanted: Wanted,
) -> Result<(Replanned, Vec<RuleFault>), Error> {
    let Scenario { domain, mut problem, mut warnings, .. } = scenario;
    let mut replanned = solve_without(&domain, &mut problem, withdrawn, limits, wanted)?;
    for solved in [&mut replanned.before, &mut replanned.after] {
        solved.is_of_whole_actions = are_whole(&warnings);
    }
    warnings.extend(without_price(&domain, &problem, &replanned.after.task)?);
    Ok((replanned, warnings))
}

/// Plans a scenario that needs no map.
///
/// # Errors
/// All faults of the scenario.
pub fn plan_alone(
    scenario: Scenario,
    limits: &Limits,
    wanted: Wanted,
) -> Result<PlanAnswer, Error> {
    let Scenario { domain, problem, mut warnings, .. } = scenario;
    let solved = solve(&domain, &problem, limits, wanted)?;
    warnings.extend(without_price(&domain, &problem, &solved.task)?);
    Ok(PlanAnswer::of(solved, warnings))
}

/// Carries a plan out on a scenario that needs no map.
///
/// # Errors
/// All faults of the scenario; that the plan breaks is no error.
pub fn check_plan_alone(scenario: &Scenario, plan: &PlanText) -> Result<Replayed, Error> {
    Ok(plan.replay(&scenario.domain, &scenario.problem)?)
}
