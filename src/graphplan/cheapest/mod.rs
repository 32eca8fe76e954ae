//! The plan of least cost, however many steps it takes: where operators cost what they take of time, the quickest.
//!
//! A plan found soon is made cheaper a piece at a time, while a search over all states ([`search`]) raises the bound from
//! below; they take turns, each with twice the effort of the turn before, until they meet. The operators that are left
//! out at first (`proof/needed`) are such that a plan with them has a like one without, of no more cost.
//!
//! **Invariant**: what is carried out in one step costs as much as one by one. A robot with one drive does one thing at a
//! time.

use crate::plan::Plan;
use crate::portfolio::parallel::{in_parallel, needful};
use crate::portfolio::relaxed::{carry_out, initial, needed_by};
use crate::portfolio::solve_anytime;
use crate::proof::needed::Reduced;
use crate::strips::{OperatorId, Task};
use crate::tried::telling;
use crate::{Limit, Limits, Outcome, Unfinished, validate};

mod search;

use search::{Progress, Search};

/// What the first turn may take.
const FIRST_EFFORT: u64 = 1 << 22;

/// Actions sought anew at once.
const WIDTHS: [usize; 3] = [8, 16, 32];

/// The plan whose operators cost least together, with what no plan costs less than. [`Outcome::Plan`] is proven to cost
/// least; a plan that is not stands in [`Unfinished`], whose `at_least` counts steps as ever.
#[must_use]
pub fn solve_cheapest(task: &Task, limits: &Limits) -> (Outcome, u64) {
    telling(limits, |limits| cheapest(task, limits), |(outcome, _)| outcome)
}

fn cheapest(task: &Task, limits: &Limits) -> (Outcome, u64) {
    let effort = Some(limits.effort.unwrap_or(Limits::TO_START).min(Limits::TO_START));
    let soon = Limits { effort, ..limits.quiet() };
    let (first, limit, at_least_steps) = match solve_anytime(task, &soon) {
        Outcome::NoPlan { leveled_off_at, reason } => {
            return (Outcome::NoPlan { leveled_off_at, reason }, 0);
        }
        Outcome::Plan(plan) => {
            let steps = plan.steps.len();
            (Some(plan), Limit::Effort, steps)
        }
        Outcome::LimitReached(known) => (known.plan, known.limit, known.at_least),
    };
    let mut turns = Turns { task, limits, best: None, at_least: 0 };
    if let Some(plan) = first {
        turns.offer(plan.operators().collect());
    }
    let ended = match limit {
        Limit::Effort => turns.run(),
        limit => Err(limit),
    };
    let (at_least, best) = (turns.at_least, turns.best);
    let plan = best.map(|(_, row)| in_parallel(task, row.into_iter()));
    match (ended, plan) {
        (Ok(()), Some(plan)) => (Outcome::Plan(plan), at_least),
        // The planning graph tells why.
        (Ok(()), None) => (crate::solve(task, limits), at_least),
        (Err(limit), plan) => {
            let known = Unfinished { at_least: at_least_steps, plan, ..limit.into() };
            (Outcome::LimitReached(known), at_least)
        }
    }
}

struct Turns<'a> {
    task: &'a Task,
    limits: &'a Limits,
    /// What it costs, and its operators one by one.
    best: Option<(u64, Vec<OperatorId>)>,
    at_least: u64,
}

impl Turns<'_> {
    /// Keeps a plan if it is one, by the rules' own judgement, and costs less.
    fn offer(&mut self, row: Vec<OperatorId>) {
        let row = needful(self.task, row);
        let cost = cost(self.task, &row);
        let plan = Plan { steps: row.iter().map(|&id| vec![id]).collect() };
        if self.best.as_ref().is_none_or(|best| cost < best.0) && validate(self.task, &plan).is_ok()
        {
            self.best = Some((cost, row));
        }
    }

    fn ceiling(&self) -> u64 {
        self.best.as_ref().map_or(u64::MAX, |best| best.0)
    }

    /// Until bound and plan meet.
    fn run(&mut self) -> Result<(), Limit> {
        let reduced = Reduced::of(self.task, self.limits)?;
        let smaller = &reduced.task;
        let mut search = Search::new(smaller, initial(smaller), &smaller.goal);
        let mut effort = FIRST_EFFORT;
        let mut spent = 0_u64;
        loop {
            let until = search.effort() + effort;
            let progress = search.go_on(self.ceiling(), until, self.limits);
            let bound = match progress {
                Ok(Progress::Cheapest(row)) => {
                    self.at_least = cost(smaller, &row);
                    self.offer(row.into_iter().map(|id| reduced.operator(id)).collect());
                    return Ok(());
                }
                Ok(Progress::NothingCheaper) => {
                    self.at_least = self.best.as_ref().map_or(0, |best| best.0);
                    return Ok(());
                }
                Ok(Progress::AtLeast(bound)) => Some(bound),
                Err(_) => search.at_least(),
            };
            let bound = bound.unwrap_or(0).min(self.ceiling());
            self.at_least = self.at_least.max(bound);
            progress?;
            spent = spent.saturating_add(2 * effort);
            if self.limits.effort.is_some_and(|most| spent > most) {
                return Err(Limit::Effort);
            }
            self.make_cheaper(effort)?;
            effort = effort.saturating_mul(2);
        }
    }

    /// Some actions in a row are sought anew, from the state before them to what the rest of the plan needs.
    fn make_cheaper(&mut self, mut effort: u64) -> Result<(), Limit> {
        let Some((_, mut row)) = self.best.clone() else { return Ok(()) };
        for width in WIDTHS {
            let (mut from, mut state) = (0, initial(self.task));
            while from + 1 < row.len() && effort > 0 {
                let to = (from + width).min(row.len());
                let goal = needed_by(self.task, &row[to..]);
                let mut search = Search::new(self.task, state.clone(), &goal);
                let known = cost(self.task, &row[from..to]);
                let found = search.go_on(known, effort / 4 + 1, self.limits)?;
                effort = effort.saturating_sub(search.effort());
                if let Progress::Cheapest(cheaper) = found {
                    row.splice(from..to, cheaper);
                    self.offer(row.clone());
                }
                let next = (from + width / 2).min(row.len());
                row[from..next].iter().for_each(|&id| carry_out(self.task, &mut state, id));
                from = next;
            }
        }
        Ok(())
    }
}

fn cost(task: &Task, row: &[OperatorId]) -> u64 {
    row.iter().map(|&id| u64::from(task.operator(id).cost)).sum()
}

#[cfg(test)]
mod tests {
    use std::cmp::Reverse;
    use std::collections::{BinaryHeap, HashMap};

    use super::*;
    use crate::samples::{Random, random_errand, random_task};
    use crate::strips::FactId;

    /// The least that any plan costs, by all states in the order of their costs.
    fn least_cost(task: &Task) -> Option<u64> {
        let set = |facts: &[FactId]| facts.iter().fold(0_u64, |set, fact| set | 1 << fact.0);
        let goal = set(&task.goal);
        let mut known = HashMap::new();
        let mut open = BinaryHeap::from([Reverse((0, set(&task.init)))]);
        while let Some(Reverse((cost, state))) = open.pop() {
            if state & goal == goal {
                return Some(cost);
            }
            if known.insert(state, cost).is_some() {
                continue;
            }
            for operator in &task.operators {
                let needs = set(&operator.preconditions);
                let next = state & !set(&operator.del_effects) | set(&operator.add_effects);
                if state & needs == needs && !known.contains_key(&next) {
                    open.push(Reverse((cost + u64::from(operator.cost), next)));
                }
            }
        }
        None
    }

    /// Whatever the effort, what is claimed is true, and with enough of it plan and bound meet.
    #[test]
    fn the_cheapest_plan_is_found_and_bounds_hold() {
        let (mut proven, mut none, mut open, mut longer) = (0, 0, 0, 0);
        for seed in 1..=600 {
            let mut task = if seed % 2 == 0 { random_task(seed) } else { random_errand(seed) };
            if task.facts.len() > 64 {
                continue;
            }
            let mut random = Random(seed);
            task.operators.iter_mut().for_each(|o| o.cost = random.below(9) as u32);
            let least = least_cost(&task);
            for effort in [Some(0), None] {
                let limits = Limits { effort, ..Limits::default() };
                let (outcome, at_least) = solve_cheapest(&task, &limits);
                match outcome {
                    Outcome::Plan(plan) => {
                        assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                        assert_eq!(Some(plan.cost(&task)), least, "seed {seed}");
                        assert_eq!(Some(at_least), least, "seed {seed}");
                        proven += 1;
                        let fewest = crate::tests::fewest_steps(&task);
                        longer += usize::from(fewest.is_some_and(|f| f < plan.steps.len()));
                    }
                    Outcome::NoPlan { .. } => {
                        assert_eq!(least, None, "seed {seed}");
                        none += 1;
                    }
                    Outcome::LimitReached(known) => {
                        assert!(effort.is_some(), "seed {seed}: {known:?}");
                        assert!(least.is_none_or(|least| at_least <= least), "seed {seed}");
                        if let Some(plan) = known.plan {
                            assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                            assert!(least.is_some_and(|least| least <= plan.cost(&task)));
                        }
                        open += 1;
                    }
                }
            }
        }
        let told = format!("{proven} proven, {none} without, {open} open, {longer} of more steps");
        assert!(proven > 200 && none > 60 && longer > 5, "{told}");
    }

    /// A piece of a plan is replaced by a cheaper one, and the rest still works.
    #[test]
    fn pieces_are_made_cheaper() {
        let mut won = 0;
        for seed in 1..=400 {
            let mut task = random_errand(seed);
            let mut random = Random(seed);
            task.operators.iter_mut().for_each(|o| o.cost = random.below(9) as u32);
            let limits = Limits { fewer_actions: 0, ..Limits::default() };
            let Outcome::Plan(plan) = crate::solve(&task, &limits) else { continue };
            let mut turns = Turns { task: &task, limits: &limits, best: None, at_least: 0 };
            turns.offer(plan.operators().collect());
            let before = turns.ceiling();
            turns.make_cheaper(1 << 20).unwrap();
            assert!(turns.ceiling() <= before, "seed {seed}");
            won += usize::from(turns.ceiling() < before);
        }
        assert!(won > 0, "{won}");
    }
}
