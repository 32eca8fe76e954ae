//! Plans, and an independent look at whether one works.

use crate::strips::{FactId, OperatorId, Task};

/// Parallel steps, each of operators that may be carried out in any order or at once.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Plan {
    pub steps: Vec<Vec<OperatorId>>,
}

impl Plan {
    #[must_use]
    pub fn action_count(&self) -> usize {
        self.steps.iter().map(Vec::len).sum()
    }

    #[must_use]
    pub fn cost(&self, task: &Task) -> u64 {
        self.operators().map(|id| u64::from(task.operator(id).cost)).sum()
    }

    /// The assumptions that the plan rests on, sorted: those that an operator or the goal needs before any
    /// operator has made them true (SPEC P2).
    #[must_use]
    pub fn assumptions(&self, task: &Task) -> Vec<FactId> {
        let mut made = vec![false; task.facts.len()];
        let mut rests_on = vec![false; task.facts.len()];
        for operators in &self.steps {
            for &id in operators {
                for fact in &task.operator(id).preconditions {
                    rests_on[fact.index()] |= !made[fact.index()];
                }
            }
            for &id in operators {
                task.operator(id).add_effects.iter().for_each(|fact| made[fact.index()] = true);
            }
        }
        for fact in &task.goal {
            rests_on[fact.index()] |= !made[fact.index()];
        }
        task.assumptions.iter().copied().filter(|fact| rests_on[fact.index()]).collect()
    }

    /// All operators in an order in which they may be carried out one by one.
    pub fn operators(&self) -> impl Iterator<Item = OperatorId> {
        self.steps.iter().flatten().copied()
    }
}

/// Where a plan breaks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Flaw {
    /// An operator's precondition does not hold before its step.
    Precondition { step: usize, operator: OperatorId, missing: FactId },
    /// Two operators of a step interfere: one deletes what the other needs or adds.
    Interference { step: usize, deleter: OperatorId, other: OperatorId, fact: FactId },
    /// The plan ends and a part of the goal does not hold.
    Goal { missing: FactId },
}

/// Replays a plan from the initial state, step by step; shares no code with the planner.
///
/// # Errors
/// The first [`Flaw`].
pub fn validate(task: &Task, plan: &Plan) -> Result<(), Flaw> {
    let mut holds = vec![false; task.facts.len()];
    for fact in &task.init {
        holds[fact.index()] = true;
    }
    for (step, operators) in plan.steps.iter().enumerate() {
        for &id in operators {
            let missing = task.operator(id).preconditions.iter().find(|fact| !holds[fact.index()]);
            if let Some(&missing) = missing {
                return Err(Flaw::Precondition { step, operator: id, missing });
            }
        }
        for &deleter in operators {
            for &other in operators.iter().filter(|&&other| other != deleter) {
                let needs = task.operator(other);
                for fact in task.operator(deleter).takes() {
                    if needs.preconditions.contains(&fact) || needs.add_effects.contains(&fact) {
                        return Err(Flaw::Interference { step, deleter, other, fact });
                    }
                }
            }
        }
        for &id in operators {
            task.operator(id).del_effects.iter().for_each(|fact| holds[fact.index()] = false);
        }
        for &id in operators {
            task.operator(id).add_effects.iter().for_each(|fact| holds[fact.index()] = true);
        }
    }
    match task.goal.iter().find(|fact| !holds[fact.index()]) {
        Some(&missing) => Err(Flaw::Goal { missing }),
        None => Ok(()),
    }
}
