//! Operators in a row made a plan: rid of what is needless, and laid out in parallel steps.

use crate::plan::Plan;
use crate::strips::{Operator, OperatorId, Task};

/// Takes out operators that the goal does without, together with those that only served them.
pub(crate) fn drop_needless(task: &Task, steps: &mut [Vec<OperatorId>]) {
    let mut before = vec![false; task.facts.len()];
    task.init.iter().for_each(|fact| before[fact.index()] = true);
    let mut dropped = Vec::new();
    for step in 0..steps.len() {
        let mut at = 0;
        while at < steps[step].len() {
            if does_without(task, steps, (step, at), before.clone(), &mut dropped) {
                for &(step, at) in dropped.iter().rev() {
                    steps[step].remove(at);
                }
            } else {
                at += 1;
            }
        }
        carry_out(task, &steps[step], |_| true, &mut before);
    }
}

/// Whether the goal is reached without one operator and without all that it enabled; these are told.
fn does_without(
    task: &Task,
    steps: &[Vec<OperatorId>],
    one: (usize, usize),
    mut state: Vec<bool>,
    dropped: &mut Vec<(usize, usize)>,
) -> bool {
    dropped.clear();
    for (step, operators) in steps.iter().enumerate().skip(one.0) {
        let known = dropped.len();
        for (at, &id) in operators.iter().enumerate() {
            let needs = &task.operator(id).preconditions;
            if (step, at) == one || !needs.iter().all(|fact| state[fact.index()]) {
                dropped.push((step, at));
            }
        }
        let stays = |at: usize| !dropped[known..].contains(&(step, at));
        carry_out(task, operators, stays, &mut state);
    }
    task.goal.iter().all(|fact| state[fact.index()])
}

/// The state after those operators of a step that are wanted.
fn carry_out(
    task: &Task,
    operators: &[OperatorId],
    wanted: impl Fn(usize) -> bool,
    state: &mut [bool],
) {
    let chosen = || operators.iter().enumerate().filter(|(at, _)| wanted(*at)).map(|(_, id)| *id);
    for id in chosen() {
        task.operator(id).del_effects.iter().for_each(|fact| state[fact.index()] = false);
    }
    for id in chosen() {
        task.operator(id).add_effects.iter().for_each(|fact| state[fact.index()] = true);
    }
}

/// Each operator in the first step after all that it depends on or interferes with.
pub(crate) fn in_parallel(task: &Task, operators: impl Iterator<Item = OperatorId>) -> Plan {
    let mut placed: Vec<(OperatorId, usize)> = Vec::new();
    let mut steps: Vec<Vec<OperatorId>> = Vec::new();
    for id in operators {
        let operator = task.operator(id);
        let waits = |earlier: OperatorId| follows(task.operator(earlier), operator);
        let after = placed.iter().filter(|(earlier, _)| waits(*earlier)).map(|(_, step)| step + 1);
        let step = after.max().unwrap_or(0);
        if steps.len() <= step {
            steps.resize(step + 1, Vec::new());
        }
        steps[step].push(id);
        placed.push((id, step));
    }
    steps.iter_mut().for_each(|step| step.sort_unstable());
    Plan { steps }
}

/// Whether an action must come after another: it needs what that one brings, or interferes with it.
pub(crate) fn follows(earlier: &Operator, later: &Operator) -> bool {
    earlier.add_effects.iter().any(|fact| later.preconditions.binary_search(fact).is_ok())
        || earlier.interferes(later)
}

/// A row of actions without those that it reaches the goal without.
pub(crate) fn needful(task: &Task, row: Vec<OperatorId>) -> Vec<OperatorId> {
    let mut steps: Vec<Vec<OperatorId>> = row.into_iter().map(|id| vec![id]).collect();
    drop_needless(task, &mut steps);
    steps.into_iter().flatten().collect()
}

/// Whether a plan has less of actions and steps together than another, no more actions, and costs no more.
pub(crate) fn has_less(task: &Task, plan: &Plan, known: &Plan) -> bool {
    let sum = |plan: &Plan| plan.action_count() + plan.steps.len();
    plan.action_count() <= known.action_count()
        && plan.cost(task) <= known.cost(task)
        && sum(plan) < sum(known)
}
