//! An answer always: a plan at once, better ones as they come, and a rising bound on the fewest steps, until the two
//! meet or the effort is used up.
//!
//! Rounds with twice the effort of the one before: in each the best plan is made of fewer actions and of fewer steps, piece
//! by piece, and a proof of the fewest steps is tried anew, each of the three within the round's effort. The order of the
//! rounds depends on nothing but the task, so equal tasks give equal plans wherever effort alone ends them.

use super::any::{self, Found};
use super::landmarks::Landmarks;
use super::restarts::Restarts;
use super::{fewer, shorten};
use crate::proof::errands::Errands;
use crate::proof::{Tried, Working, prove};
use crate::strips::{FactId, Task};
use crate::tried::telling;
use crate::units::InOrder as _;
use crate::{Learned, Limit, Limits, Outcome, Plan, Unfinished, solve, solve_learning, validate};

/// What the first round may take for shortening, and for a proof.
const FIRST_EFFORT: u64 = 1 << 22;

/// What the fewest steps of one errand may take.
const ERRAND_EFFORT: u64 = 1 << 22;

/// After so many rounds nothing but the proof itself is left to be sought.
const ROUNDS: u32 = 24;

/// A search for a plan, a proof, and a piece of a plan, which is small or better left alone, take these parts of the memory.
const SEARCH_OF_MEMORY: usize = 4;
const PROOF_OF_MEMORY: usize = 6;
const PIECE_OF_MEMORY: usize = 16;

struct Best<'a> {
    task: &'a Task,
    limits: &'a Limits,
    plan: Option<Plan>,
    at_least: usize,
}

impl Best<'_> {
    /// Keeps a plan if it is one, by the rules' own judgement, and has fewer steps, or as many and fewer actions.
    fn offer(&mut self, plan: Plan) {
        let size = |plan: &Plan| (plan.steps.len(), plan.action_count());
        let is_better = self.plan.as_ref().is_none_or(|best| size(&plan) < size(best));
        if is_better && validate(self.task, &plan).is_ok() {
            if self.plan.as_ref().is_none_or(|best| plan.steps.len() < best.steps.len()) {
                self.limits.tell_of(&plan);
            }
            self.plan = Some(plan);
        }
    }

    fn raise(&mut self, at_least: usize) {
        if at_least > self.at_least {
            self.at_least = at_least;
            self.limits.tell_of_bound(at_least);
        }
    }

    fn is_proven(&self) -> bool {
        self.plan.as_ref().is_some_and(|plan| plan.steps.len() <= self.at_least)
    }

    /// One more than the steps of which a plan is known.
    fn ceiling(&self) -> usize {
        self.plan
            .as_ref()
            .map_or(self.limits.parallel_steps.saturating_add(1), |plan| plan.steps.len())
    }

    fn end(self, limit: Limit) -> Outcome {
        match self.plan {
            Some(plan) if plan.steps.len() <= self.at_least => Outcome::Plan(plan),
            plan => {
                let at_least = self.at_least;
                Outcome::LimitReached(Unfinished { at_least, plan, ..limit.into() })
            }
        }
    }
}

/// A plan soon, then better ones, with a proven bound that rises: [`Outcome::Plan`] is proven to have the fewest steps,
/// [`Outcome::NoPlan`] is proven, and [`Unfinished`] tells what is known in between. [`Limits::tell`] hears of every
/// plan with fewer steps, [`Limits::tell_bound`] of every higher bound.
#[must_use]
pub fn solve_anytime(task: &Task, limits: &Limits) -> Outcome {
    let search = |limits: &Limits| {
        let mut best = Best { task, limits, plan: None, at_least: 0 };
        match run(&mut best) {
            Ok(Some(outcome)) => outcome,
            Ok(None) => best.end(Limit::Effort),
            Err(limit) => best.end(limit),
        }
    };
    telling(limits, search, |outcome| outcome)
}

/// As [`solve_learning`] as long as [`Limits::effort`] lasts; where the proof has not come to an end by then, what
/// [`solve_anytime`] knows after as much again: a robot starts with a plan and its bounds.
#[must_use]
pub fn solve_soon(
    task: &Task,
    learned: Option<&Learned>,
    limits: &Limits,
) -> (Outcome, Option<Learned>) {
    telling(limits, |limits| soon(task, learned, limits), |(outcome, _)| outcome)
}

fn soon(task: &Task, learned: Option<&Learned>, limits: &Limits) -> (Outcome, Option<Learned>) {
    let solved = solve_learning(task, learned, limits);
    let Outcome::LimitReached(refuted) = &solved.0 else { return solved };
    if refuted.limit != Limit::Effort {
        return solved;
    }
    let outcome = match solve_anytime(task, limits) {
        Outcome::LimitReached(mut known) => {
            known.at_least = known.at_least.max(refuted.at_least);
            match known.plan {
                Some(plan) if plan.steps.len() <= known.at_least => Outcome::Plan(plan),
                _ => Outcome::LimitReached(known),
            }
        }
        outcome => outcome,
    };
    (outcome, None)
}

fn run(best: &mut Best<'_>) -> Result<Option<Outcome>, Limit> {
    let (task, limits) = (best.task, best.limits);
    let part = |of: usize| Limits { memory_bytes: limits.memory_bytes / of, ..limits.clone() };
    let (some, proof, piece) =
        (part(SEARCH_OF_MEMORY), part(PROOF_OF_MEMORY), part(PIECE_OF_MEMORY));
    // What can be seen at once is told at once: forward search may take long for its first plan.
    best.raise(super::steps_at_least(task));
    let errands = Errands::of(task);
    if let Some(errands) = &errands {
        best.raise(errands.at_least);
        if let Some(plan) = any::in_order(task, &errands.stages, &some)? {
            best.offer(plan);
        }
    }
    // Forward search may lose its way; then the proof has its turn.
    if best.plan.is_none() {
        match any::search(task, &some, any::Effort::Least) {
            Ok(Found::Plan(plan)) => best.offer(plan),
            // The planning graph tells why.
            Ok(Found::Exhausted) => return Ok(Some(solve(task, limits))),
            Ok(Found::Open) | Err(Limit::Memory) => {}
            Err(limit) => return Err(limit),
        }
    }
    if best.is_proven() {
        return Ok(None);
    }
    let working = Working::of(task, limits)?;
    // Plans in the terms of the task that is worked on, the best of which is shortened on.
    let mut current: Vec<Plan> = Vec::new();
    match working {
        Working::Whole(_) => current.extend(best.plan.clone()),
        Working::Reduced(_) => {}
    }
    if !best.is_proven() {
        if let Some(errands) = &errands {
            let own = |stage: &Vec<FactId>| stage.iter().map(|&fact| working.fact(fact)).collect();
            let stages: Option<Vec<Vec<FactId>>> = errands.stages.iter().map(own).collect();
            current.extend(stages.and_then(|stages| {
                shorten::one_by_one(working.task(), &stages, ERRAND_EFFORT, &piece)
            }));
        }
        // A day of errands is in order already; any other plan may be as good as the first.
        if let (Working::Reduced(_), true) = (&working, current.is_empty())
            && let Ok(Found::Plan(plan)) = any::search(working.task(), &some, any::Effort::Least)
        {
            current.push(plan);
        } else if let (Working::Whole(_), true) = (&working, errands.is_some())
            && let Ok(Found::Plan(plan)) = any::search(task, &some, any::Effort::Least)
        {
            current.push(plan);
        }
        current.iter().for_each(|plan| best.offer(working.own(plan.clone())));
    }
    let landmarks = Landmarks::of(working.task());
    let mut anew =
        errands.is_none().then(|| Restarts::of(working.task(), landmarks.as_ref(), &some));
    let mut is_provable = true;
    let mut spent = 0_u64;
    for round in 0..ROUNDS {
        if best.is_proven() {
            break;
        }
        let effort = FIRST_EFFORT << round;
        spent = spent.saturating_add(3 * effort);
        if round > 0 && limits.effort.is_some_and(|most| spent > most) {
            return Ok(None);
        }
        let within = Limits { tell: None, shorten: u64::MAX, ..piece.clone() };
        // What was found soon may be far from the best that is found step by step.
        if let Some(search) = &mut anew {
            let known = best.plan.as_ref().map_or(usize::MAX, Plan::action_count);
            match search.go_on(&mut effort.clone(), known) {
                Ok((found, is_open)) => {
                    if let Some(plan) = found {
                        best.offer(working.own(plan.clone()));
                        current.push(plan);
                    }
                    if !is_open {
                        anew = None;
                    }
                }
                Err(Limit::Memory) => anew = None,
                Err(limit) => return Err(limit),
            }
        }
        for plan in &mut current {
            let mut share = effort;
            *plan = fewer::fewer(working.task(), std::mem::take(plan), limits, &mut share);
            best.offer(working.own(plan.clone()));
            share = effort;
            *plan = shorten::shorten(working.task(), std::mem::take(plan), &within, &mut share);
            best.offer(working.own(plan.clone()));
        }
        // The others had their chance.
        current.order_by_key(|plan| (plan.steps.len(), plan.action_count()));
        current.truncate(1);
        if best.is_proven() {
            break;
        }
        limits.check(0)?;
        let tried = is_provable.then(|| prove(working.task(), best.ceiling(), effort, &proof));
        match tried {
            Some(Tried::Plan(plan)) => {
                let plan = working.own(plan);
                best.raise(plan.steps.len());
                best.offer(plan);
            }
            // In the terms of the whole task, and with its reason.
            Some(Tried::NoPlan) => return Ok(Some(solve(task, limits))),
            Some(Tried::AtLeast(at_least, limit)) => {
                best.raise(at_least);
                match limit {
                    // It suffices for better plans still, and for this proof it never will.
                    Some(Limit::Memory) => is_provable = false,
                    Some(limit) => return Err(limit),
                    None => {}
                }
            }
            None => {}
        }
        if best.plan.is_none() {
            // Each round looks farther for a first plan.
            let reach = if round < 2 { any::Effort::Small } else { any::Effort::All };
            match any::search(task, &some, reach) {
                Ok(Found::Plan(plan)) => {
                    if let Working::Whole(_) = working {
                        current.push(plan.clone());
                    }
                    best.offer(plan);
                }
                Ok(Found::Exhausted) => return Ok(Some(solve(task, limits))),
                Ok(Found::Open) | Err(Limit::Memory) => {}
                Err(limit) => return Err(limit),
            }
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::samples::{random_errand, random_task};
    use crate::tests::fewest_steps;

    thread_local! {
        static BOUNDS: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) };
        static PLANS: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) };
    }

    /// Whatever the effort, what is claimed is true, bounds rise, plans get shorter, and with enough effort they meet.
    #[test]
    fn bounds_rise_and_plans_get_shorter_until_they_meet() {
        let limits = |effort| Limits {
            effort,
            tell: Some(|plan| PLANS.with_borrow_mut(|told| told.push(plan.steps.len()))),
            tell_bound: Some(|bound| BOUNDS.with_borrow_mut(|told| told.push(bound))),
            ..Limits::default()
        };
        let (mut proven, mut none) = (0, 0);
        for seed in 1..=400 {
            let task = if seed % 2 == 0 { random_task(seed) } else { random_errand(seed) };
            let fewest = fewest_steps(&task);
            for effort in [Some(0), None] {
                let outcome = solve_anytime(&task, &limits(effort));
                let (plans, bounds) = (PLANS.take(), BOUNDS.take());
                assert!(
                    plans.is_sorted_by(|longer, shorter| longer > shorter),
                    "{seed}: {plans:?}"
                );
                assert!(bounds.is_sorted_by(|low, high| low < high), "{seed}: {bounds:?}");
                assert!(
                    bounds.last().is_none_or(|&bound| fewest.is_none_or(|f| bound <= f)),
                    "{seed}"
                );
                match outcome {
                    Outcome::Plan(plan) => {
                        assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                        assert_eq!(Some(plan.steps.len()), fewest, "seed {seed}");
                        assert_eq!(plans.last(), Some(&plan.steps.len()), "seed {seed}");
                        proven += 1;
                    }
                    Outcome::NoPlan { .. } => {
                        assert_eq!(fewest, None, "seed {seed}");
                        none += 1;
                    }
                    Outcome::LimitReached(known) => {
                        assert!(effort.is_some(), "seed {seed}: {known:?}");
                        assert!(
                            fewest.is_none_or(|fewest| known.at_least <= fewest),
                            "seed {seed}"
                        );
                        if let Some(plan) = known.plan {
                            assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                        }
                    }
                }
            }
        }
        assert!(proven > 100 && none > 50, "{proven} proven, {none} without");
    }
}
