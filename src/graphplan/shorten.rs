//! A plan made shorter piece by piece: a few of its steps are planned anew, from the state before them to what
//! the rest of the plan needs (after F. Siddiqui, P. Haslum, 2015, "block deordering and local search").
//!
//! Wider pieces follow when narrower ones are as short as they can be. The plan stays a plan throughout, so the
//! improvement may be ended at any time. It never proves anything about the whole.

use super::any::in_parallel;
use super::plan::Plan;
use super::{Limits, Outcome, Turn, search};
use crate::strips::{FactId, OperatorId, Task};

/// Steps planned anew at once, one size after the other.
const WIDTHS: [usize; 5] = [3, 5, 8, 12, 18];

/// What one piece may take: it is a small task, or better left alone.
const TURN: Turn = Turn { choices: 1 << 12, conflicts: 1 << 8, turns: Some(3), goes_on: false };

/// A plan of fewer steps, or as many with fewer actions, after at most `limits.shorten` pieces were looked at.
pub(super) fn shorten(task: &Task, plan: Plan, limits: &Limits) -> Plan {
    let mut plan = plan;
    let mut left = limits.shorten;
    let mut narrowest = 0;
    while let Some(&width) = WIDTHS.get(narrowest) {
        let mut better = false;
        let mut from = 0;
        while from < plan.steps.len() && left > 0 && limits.check(0).is_ok() {
            left -= 1;
            match replaced(task, &plan, from, width, limits) {
                Some(shorter) => {
                    if shorter.steps.len() < plan.steps.len() {
                        limits.tell_of(&shorter);
                    }
                    plan = shorter;
                    better = true;
                }
                None => from += (width / 2).max(1),
            }
        }
        if left == 0 || width >= plan.steps.len() {
            break;
        }
        // What one width improved, a narrower one may improve further.
        narrowest = if better { 0 } else { narrowest + 1 };
    }
    plan
}

fn size(plan: &Plan) -> (usize, usize) {
    (plan.steps.len(), plan.action_count())
}

/// The plan with a better piece in place of `width` of its steps.
fn replaced(task: &Task, plan: &Plan, from: usize, width: usize, limits: &Limits) -> Option<Plan> {
    let to = (from + width).min(plan.steps.len());
    let piece = Task {
        init: state_before(task, &plan.steps[..from]),
        goal: needed_by(task, &plan.steps[to..]),
        ..task.clone()
    };
    let within = Limits { parallel_steps: to - from, shorten: 0, ..*limits };
    let (Some(Outcome::Plan(found)), _) = search(&piece, &within, TURN, None).ok()? else {
        return None;
    };
    let operators = plan.steps[..from].iter().chain(&found.steps).chain(&plan.steps[to..]);
    let whole = in_parallel(task, operators.flatten().copied());
    (size(&whole) < size(plan)).then_some(whole)
}

fn state_before(task: &Task, steps: &[Vec<OperatorId>]) -> Vec<FactId> {
    let mut holds = vec![false; task.facts.len()];
    task.init.iter().for_each(|fact| holds[fact.index()] = true);
    for &id in steps.iter().flatten() {
        task.operator(id).del_effects.iter().for_each(|fact| holds[fact.index()] = false);
        task.operator(id).add_effects.iter().for_each(|fact| holds[fact.index()] = true);
    }
    task.fact_ids().filter(|fact| holds[fact.index()]).collect()
}

/// What must hold for the last steps of a plan to reach the goal.
fn needed_by(task: &Task, steps: &[Vec<OperatorId>]) -> Vec<FactId> {
    let mut needed = vec![false; task.facts.len()];
    task.goal.iter().for_each(|fact| needed[fact.index()] = true);
    for operators in steps.iter().rev() {
        for &id in operators {
            task.operator(id).add_effects.iter().for_each(|fact| needed[fact.index()] = false);
        }
        for &id in operators {
            task.operator(id).preconditions.iter().for_each(|fact| needed[fact.index()] = true);
        }
    }
    task.fact_ids().filter(|fact| needed[fact.index()]).collect()
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::super::samples::random_task;
    use super::super::{Outcome, solve_any};
    use super::*;

    thread_local! {
        static TOLD: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) };
    }

    #[test]
    fn the_first_plan_and_every_shorter_one_are_told_of() {
        let tell: fn(&Plan) = |plan| TOLD.with_borrow_mut(|told| told.push(plan.steps.len()));
        let mut shortened = 0;
        for seed in 1..=1000 {
            let limits = Limits { tell: Some(tell), ..Limits::default() };
            let Outcome::Plan(plan) = solve_any(&random_task(seed), &limits) else { continue };
            let told = TOLD.take();
            assert!(told.is_sorted_by(|longer, shorter| longer > shorter), "{seed}: {told:?}");
            assert_eq!(told.last(), Some(&plan.steps.len()), "seed {seed}");
            shortened += usize::from(told.len() > 1);
        }
        assert!(shortened > 0);
    }
}
