//! Plans for scenarios: a rule file's problem, supplemented with what the Map knows.

use std::path::Path;

use crate::graphplan::{self, Limit, Limits, NoPlanReason, Outcome};
use crate::robot::{facts_of_map, state};
use crate::strips::{Scenario, Task};

use super::{Engine, Error};

/// One action of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanStep {
    pub action: String,
    pub args: Vec<String>,
}

/// What planning came to, with the task that it was about.
#[derive(Debug, Clone)]
pub struct PlanAnswer {
    pub task: Task,
    pub outcome: Outcome,
    /// Harmless faults of the rule files, as they are shown to a person.
    pub warnings: Vec<crate::strips::RuleFault>,
}

impl PlanAnswer {
    /// The parallel steps, empty unless there is a plan.
    #[must_use]
    pub fn steps(&self) -> Vec<Vec<PlanStep>> {
        let Outcome::Plan(plan) = &self.outcome else { return Vec::new() };
        let step = |&id| {
            let operator = self.task.operator(id);
            PlanStep {
                action: operator.name.to_string(),
                args: operator.args.iter().map(ToString::to_string).collect(),
            }
        };
        plan.steps.iter().map(|parallel| parallel.iter().map(step).collect()).collect()
    }

    /// Why there is no plan, in the words of the rule files; none when there is one.
    #[must_use]
    pub fn explanation(&self) -> Option<String> {
        match &self.outcome {
            Outcome::Plan(_) => None,
            Outcome::NoPlan { reason, .. } => Some(explain(&self.task, reason)),
            Outcome::LimitReached(Limit::Time) => Some("время вышло раньше, чем нашёлся план".to_owned()),
            Outcome::LimitReached(_) => Some("предел исчерпан раньше, чем нашёлся план".to_owned()),
        }
    }
}

fn explain(task: &Task, reason: &NoPlanReason) -> String {
    let fact = |id: &_| task.fact(*id).to_string();
    match reason {
        NoPlanReason::Unreachable(facts) => {
            let facts: Vec<String> = facts.iter().map(fact).collect();
            format!("никакое действие не приводит к цели {}", facts.join(", "))
        }
        NoPlanReason::Exclusive(pairs) => {
            let pairs: Vec<String> = pairs.iter().map(|(a, b)| format!("{} и {}", fact(a), fact(b))).collect();
            format!("цели исключают друг друга: {}", pairs.join("; "))
        }
        NoPlanReason::Together(facts) => {
            let facts: Vec<String> = facts.iter().map(fact).collect();
            format!("цели недостижимы все вместе: {}", facts.join(", "))
        }
    }
}

impl Engine {
    /// Plans a scenario with the facts of the map that the engine holds, if it holds one.
    ///
    /// # Errors
    /// All faults of the scenario.
    pub fn plan(&self, scenario: Scenario, limits: &Limits) -> Result<PlanAnswer, Error> {
        let mut problem = scenario.problem;
        if let Ok(world) = self.world() {
            for fact in facts_of_map(world, self.relations()?) {
                state(&mut problem, &fact);
            }
        }
        let task = crate::strips::ground(&scenario.domain, &problem)?;
        let outcome = graphplan::solve(&task, limits);
        Ok(PlanAnswer { task, outcome, warnings: scenario.warnings })
    }
}

/// Plans a scenario that needs no map.
///
/// # Errors
/// All faults of the scenario.
pub fn plan_alone(scenario: Scenario, limits: &Limits) -> Result<PlanAnswer, Error> {
    let task = scenario.ground()?;
    let outcome = graphplan::solve(&task, limits);
    Ok(PlanAnswer { task, outcome, warnings: scenario.warnings })
}

/// Reads a scenario.
///
/// # Errors
/// All faults of the file and of those that it includes.
pub fn read_scenario(path: &Path) -> Result<Scenario, Error> {
    Ok(Scenario::read(path)?)
}
