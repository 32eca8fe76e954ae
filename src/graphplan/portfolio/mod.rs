//! Several ways to some plan, one after the other and taking turns, and what makes a plan shorter: for tasks on which
//! the proof of the fewest steps is out of reach.

pub(crate) mod any;
mod anytime;
mod best_first;
mod fewer;
mod landmarks;
mod novelty;
pub(crate) mod parallel;
mod piece;
pub(crate) mod relaxed;
mod restarts;
pub(crate) mod rounds;
mod shorten;

pub use anytime::{solve_anytime, solve_soon};

use crate::proof::errands::Errands;
use crate::proof::{Tried, Turn, Working, prove, search};
use crate::strips::{FactId, Task};
use crate::tried::telling;
use crate::{Limit, Limits, Outcome, Plan, Unfinished, solve, with_stack};

/// Steps that a task takes at least, as far as can be seen at once: where deletes are forgotten.
pub(crate) fn steps_at_least(task: &Task) -> usize {
    relaxed::Relaxed::new(task).depth(&relaxed::initial(task)).unwrap_or(0)
}

/// Facts that hold for the first time one after the other in every plan, the longest such row that is seen at once; no
/// plan has fewer steps.
#[must_use]
pub fn milestones(task: &Task) -> Vec<FactId> {
    landmarks::longest_row(task, &relaxed::initial(task))
}

/// Of a plan found soon, how few steps are ruled out: no plan has fewer than the number told, as far as little effort
/// proves. Where the proof comes upon a plan of fewer steps and no more actions, that takes its place.
#[must_use]
pub fn bounded(task: &Task, plan: Plan, limits: &Limits) -> (Plan, usize) {
    /// What the proof may take.
    const EFFORT: u64 = 1 << 21;
    let walked = Errands::of(task).map_or(0, |errands| errands.at_least);
    let at_once = steps_at_least(task).max(walked).min(plan.steps.len());
    if at_once == plan.steps.len() || limits.check(0).is_err() {
        return (plan, at_once);
    }
    let Ok(working) = Working::of(task, limits) else { return (plan, at_once) };
    match prove(working.task(), plan.steps.len(), EFFORT, limits) {
        Tried::Plan(shorter) => {
            let shorter = working.own(shorter);
            let fewest = shorter.steps.len();
            let is_better = shorter.action_count() <= plan.action_count();
            (if is_better { shorter } else { plan }, fewest)
        }
        Tried::AtLeast(at_least, _) => {
            let most = plan.steps.len();
            (plan, at_least.clamp(at_once, most))
        }
        // There is one.
        Tried::NoPlan => (plan, at_once),
    }
}

/// Finds some plan soon, where the shortest is out of reach. The plan is then shortened piece by piece within
/// [`Limits::shorten`], but not proven to be the shortest; that there is no plan is proven all the same.
#[must_use]
pub fn solve_any(task: &Task, limits: &Limits) -> Outcome {
    telling(limits, |limits| soon(task, limits), |outcome| outcome)
}

/// Makes a plan shorter, piece by piece, within [`Limits::shorten`] and [`Limits::shorten_effort`]: of no more actions, no
/// dearer, and not proven to be the shortest.
#[must_use]
pub fn shorten(task: &Task, plan: Plan, limits: &Limits) -> Plan {
    match limits.shorten {
        0 => plan,
        _ => rounds::shortened(task, plan, limits, Some(shorten::shorten)),
    }
}

fn soon(task: &Task, limits: &Limits) -> Outcome {
    /// Turns of the graph's extraction at a level, when forward search is stuck.
    const FEW_TURNS: u32 = 3;
    /// A graph that takes more than this part of the memory, or more steps, is left alone.
    const FEW_OF_MEMORY: usize = 16;
    const FEW_STEPS: usize = 50;
    let shortened = |plan: Plan| {
        limits.tell_of(&plan);
        Outcome::Plan(shorten(task, plan, limits))
    };
    let found = |found| match found {
        any::Found::Plan(plan) => Some(shortened(plan)),
        // The planning graph tells why.
        any::Found::Exhausted => Some(solve(task, limits)),
        any::Found::Open => None,
    };
    let at_once = steps_at_least(task);
    let tries = || -> Result<Outcome, Unfinished> {
        if let Some(errands) = Errands::of(task)
            && let Some(plan) = any::in_order(task, &errands.stages, limits)?
        {
            return Ok(shortened(plan));
        }
        if let Some(outcome) = found(any::search(task, limits, any::Effort::Small)?) {
            return Ok(outcome);
        }
        let mut refuted = at_once;
        // Where forward search loses its way, the graph may see at once that there is none, or the solver that there
        // is one; if it is small.
        let turn = Turn { turns: Some(FEW_TURNS), goes_on: true, seek: None, ..Turn::default() };
        let brief = Limits {
            memory_bytes: limits.memory_bytes / FEW_OF_MEMORY,
            parallel_steps: limits.parallel_steps.min(FEW_STEPS),
            ..limits.clone()
        };
        match with_stack(|| search(task, &brief, turn, None)) {
            Ok((Some(Outcome::Plan(plan)), _)) => return Ok(shortened(plan)),
            Ok((Some(outcome), _)) => return Ok(outcome),
            Err(unfinished) if matches!(unfinished.limit, Limit::Time | Limit::Stopped) => {
                return Err(unfinished);
            }
            Err(unfinished) => refuted = unfinished.at_least.max(at_once),
            Ok((None, _)) => {}
        }
        let all = any::search(task, limits, any::Effort::All)
            .map_err(|limit| Unfinished { at_least: refuted, ..limit.into() })?;
        Ok(found(all).expect("all effort leaves nothing open"))
    };
    match tries() {
        Ok(Outcome::LimitReached(known)) | Err(known) => {
            let at_least = known.at_least.max(at_once);
            Outcome::LimitReached(Unfinished { at_least, ..known })
        }
        Ok(outcome) => outcome,
    }
}
