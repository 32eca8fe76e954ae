//! A plan made shorter piece by piece: a few of its steps are planned anew, from the state before them to what
//! the rest of the plan needs (after F. Siddiqui, P. Haslum, 2015, "block deordering and local search").
//!
//! Wider pieces follow when narrower ones are as short as they can be. The plan stays a plan throughout, so the
//! improvement may be ended at any time; it ends by itself when its effort is spent. It never proves anything about the
//! whole. On the way it may take more actions for fewer steps, and win them back; what it ends with has no more actions
//! than it began with, and costs no more.

use super::parallel::in_parallel;
use super::relaxed::{Relaxed, State, carry_out, holds, initial};
use super::{any, piece};
use crate::plan::Plan;
use crate::proof::{Turn, search_counted};
use crate::strips::{FactId, OperatorId, Task};
use crate::{Limits, Outcome};

/// Steps planned anew at once, one size after the other.
const WIDTHS: [usize; 5] = [3, 5, 8, 12, 18];

/// What one piece may take: it is a small task, or better left alone.
const TURN: Turn = Turn {
    choices: 1 << 12,
    conflicts: 1 << 8,
    turns: Some(3),
    goes_on: false,
    effort: None,
    seek: None,
};

/// A stage is looked for within so many steps, the fewest first: what lies farther off need not be made ready.
const REACHES: [usize; 5] = [8, 16, 32, 64, 128];

/// More operators than these are not made ready for the fewest steps of a stage.
const MOST_OPERATORS: usize = 1 << 13;

/// What making ready to plan a piece takes for each operator, beside what its search counts.
const EFFORT_AN_OPERATOR: u64 = 32;

/// A plan of fewer steps, or as many with fewer actions, and never of more actions or greater cost than at first, after
/// at most `limits.shorten` pieces were looked at, or so much effort was spent, which is taken from it.
pub(crate) fn shorten(task: &Task, plan: Plan, limits: &Limits, effort: &mut u64) -> Plan {
    let mut best = plan.clone();
    let first = plan.clone();
    let is_no_dearer = |plan: &Plan| {
        plan.action_count() <= first.action_count() && plan.cost(task) <= first.cost(task)
    };
    let mut plan = plan;
    let mut left = limits.shorten;
    let mut relaxed = Relaxed::new(task);
    let mut narrowest = 0;
    while let Some(&width) = WIDTHS.get(narrowest) {
        let mut better = false;
        let mut from = 0;
        while from < plan.steps.len() && left > 0 && *effort > 0 && limits.check(0).is_ok() {
            left -= 1;
            match replaced((task, &mut relaxed), &plan, (from, width), limits, effort) {
                Some(shorter) => {
                    plan = shorter;
                    if is_no_dearer(&plan) && size(&plan) < size(&best) {
                        if plan.steps.len() < best.steps.len() {
                            limits.tell_of(&plan);
                        }
                        best = plan.clone();
                    }
                    better = true;
                }
                None => from += (width / 2).max(1),
            }
        }
        if left == 0 || *effort == 0 || width >= plan.steps.len() {
            break;
        }
        // What one width improved, a narrower one may improve further.
        narrowest = if better { 0 } else { narrowest + 1 };
    }
    best
}

fn size(plan: &Plan) -> (usize, usize) {
    (plan.steps.len(), plan.action_count())
}

/// The plan with a better piece in place of `width` of its steps; what the search for it takes is taken from `effort`.
fn replaced(
    (task, relaxed): (&Task, &mut Relaxed<'_>),
    plan: &Plan,
    (from, width): (usize, usize),
    limits: &Limits,
    effort: &mut u64,
) -> Option<Plan> {
    let to = (from + width).min(plan.steps.len());
    let state = state_after(task, &plan.steps[..from]);
    let goal = needed_by(task, &plan.steps[to..]);
    let piece = piece::within(task, relaxed, (&state, &goal), to - from);
    let ready =
        EFFORT_AN_OPERATOR * piece.task.operators.len() as u64 + task.operators.len() as u64;
    *effort = effort.saturating_sub(ready);
    let within = Limits { parallel_steps: to - from, shorten: 0, ..limits.clone() };
    let turn = Turn { effort: Some(*effort), ..TURN };
    let (outcome, spent) = search_counted(&piece.task, &within, turn);
    *effort = effort.saturating_sub(spent);
    let Some(Outcome::Plan(found)) = outcome else { return None };
    let found = piece.own(found);
    let operators = plan.steps[..from].iter().chain(&found.steps).chain(&plan.steps[to..]);
    let whole = in_parallel(task, operators.flatten().copied());
    (size(&whole) < size(plan)).then_some(whole)
}

/// One stage after the other, each in the fewest steps from where the one before ended, as far as so much effort for each
/// tells; none where the way to one of them is not found.
pub(crate) fn one_by_one(
    task: &Task,
    stages: &[Vec<FactId>],
    effort: u64,
    limits: &Limits,
) -> Option<Plan> {
    let mut steps: Vec<Vec<OperatorId>> = Vec::new();
    let mut relaxed = Relaxed::new(task);
    for stage in stages {
        let state = state_after(task, &steps);
        let mut goal = stage.clone();
        goal.sort_unstable();
        if goal.iter().all(|&fact| holds(&state, fact)) {
            continue;
        }
        let found = stage_within(task, &mut relaxed, (&state, &goal), effort, limits)?;
        steps.extend(found.steps);
    }
    super::parallel::drop_needless(task, &mut steps);
    Some(in_parallel(task, steps.into_iter().flatten()))
}

/// The fewest steps to a stage, or, where that is too much to be found out, those that hill climbing finds.
fn stage_within(
    task: &Task,
    relaxed: &mut Relaxed<'_>,
    ends: (&State, &[FactId]),
    effort: u64,
    limits: &Limits,
) -> Option<Plan> {
    let turn = Turn { effort: Some(effort), ..TURN };
    let mut last = None;
    for reach in REACHES {
        let piece = piece::within(task, relaxed, ends, reach);
        if piece.task.operators.len() <= MOST_OPERATORS {
            let within =
                Limits { parallel_steps: reach, fewer_actions: 0, shorten: 0, ..limits.clone() };
            if let (Some(Outcome::Plan(found)), _) = search_counted(&piece.task, &within, turn) {
                return Some(piece.own(found));
            }
        }
        last = Some(piece);
    }
    let piece = last?;
    let climbed = any::in_order(&piece.task, std::slice::from_ref(&piece.task.goal), limits);
    climbed.ok().flatten().map(|found| piece.own(found))
}

fn state_after(task: &Task, steps: &[Vec<OperatorId>]) -> State {
    let mut state = initial(task);
    steps.iter().flatten().for_each(|&id| carry_out(task, &mut state, id));
    state
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

    use super::super::relaxed::facts;
    use super::*;
    use crate::samples::{Random, random_errand, random_task};
    use crate::{Outcome, solve_any, validate};

    thread_local! {
        static TOLD: RefCell<Vec<(usize, usize)>> = const { RefCell::new(Vec::new()) };
    }

    #[test]
    fn what_is_shortened_has_no_more_actions_and_costs_no_more() {
        let mut traded = 0;
        for seed in 1..=3000 {
            let mut task = if seed % 2 == 0 { random_task(seed) } else { random_errand(seed) };
            let mut random = Random(seed);
            if seed % 3 == 0 {
                task.operators.iter_mut().for_each(|o| o.cost = random.below(4) as u32);
            }
            let at_once = Limits { shorten: 0, ..Limits::default() };
            let Outcome::Plan(first) = solve_any(&task, &at_once) else { continue };
            // Detours and returns make a plan longer in every way.
            let walk = wandering(&task, &mut random, &first);
            for from in [first, walk] {
                let plan = shorten(&task, from.clone(), &Limits::default(), &mut (1 << 28));
                assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                assert!(size(&plan) <= size(&from), "seed {seed}");
                assert!(plan.action_count() <= from.action_count(), "seed {seed}");
                assert!(plan.cost(&task) <= from.cost(&task), "seed {seed}");
                traded += usize::from(size(&plan) < size(&from));
            }
        }
        assert!(traded > 100, "{traded}");
    }

    /// A plan that first goes where chance leads, and on from there.
    fn wandering(task: &Task, random: &mut Random, otherwise: &Plan) -> Plan {
        let mut steps: Vec<Vec<OperatorId>> = Vec::new();
        for _ in 0..6 {
            let state = state_after(task, &steps);
            let possible: Vec<OperatorId> = task
                .operator_ids()
                .filter(|&id| task.operator(id).preconditions.iter().all(|&f| holds(&state, f)))
                .collect();
            if possible.is_empty() {
                break;
            }
            steps.push(vec![possible[random.below(possible.len())]]);
        }
        let rest = Task { init: facts(&state_after(task, &steps)), ..task.clone() };
        match solve_any(&rest, &Limits { shorten: 0, ..Limits::default() }) {
            Outcome::Plan(on) => in_parallel(task, steps.into_iter().chain(on.steps).flatten()),
            _ => otherwise.clone(),
        }
    }

    #[test]
    fn shortening_ends_with_its_effort() {
        for effort in [0, 1, 1 << 10] {
            for seed in 1..=300 {
                let task = random_errand(seed);
                let limits = Limits { shorten_effort: effort, ..Limits::default() };
                if let Outcome::Plan(plan) = solve_any(&task, &limits) {
                    assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                }
            }
        }
    }

    #[test]
    fn the_first_plan_and_every_better_one_are_told_of() {
        let tell: fn(&Plan) = |plan| TOLD.with_borrow_mut(|told| told.push(size(plan)));
        let mut shortened = 0;
        for seed in 1..=1000 {
            let limits = Limits { tell: Some(tell), ..Limits::default() };
            let Outcome::Plan(plan) = solve_any(&random_task(seed), &limits) else { continue };
            let told = TOLD.take();
            let is_better = |known: &(usize, usize), next: &(usize, usize)| {
                next.0 < known.0 || next.1 < known.1
            };
            assert!(told.is_sorted_by(is_better), "{seed}: {told:?}");
            assert_eq!(told.last().map(|told| told.0), Some(plan.steps.len()), "seed {seed}");
            shortened += usize::from(told.len() > 1);
        }
        assert!(shortened > 0);
    }
}
