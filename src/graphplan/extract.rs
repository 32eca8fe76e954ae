//! GraphPlan, as in the paper (A. Blum, M. Furst, 1997, sections 2 and 3), whole and alone.
//!
//! The graph grows until the goal may hold at its last level. Then a plan is sought backward: the goals of a level get
//! actions of the step before it, no two of which exclude each other, and what these need are the goals of the level
//! below. A set of goals that failed at a level is *memoised* there. If no plan has that many steps, the graph grows
//! by one level more.
//!
//! **No plan** (section 5, theorem 2 of the journal's version). Let the graph have leveled off at level `n`, and let
//! `S(t)` be the sets memoised at `n` once the search over `t` levels has failed. If `S(t) = S(t + 1)`, for `t > n`,
//! no number of levels will do: each way down from `n + 1` fails in a set of `S(t + 1)` at level `n`, level `n + 1` of
//! `t + 1` levels is like level `n` of `t`, and so on upwards. Sets only come to `S`, so their number tells.

use std::collections::HashSet;

use super::graph::PlanningGraph;
use super::plan::Plan;
use crate::strips::{FactId, Task};
use crate::tried::telling;
use crate::{Attempt, Limit, Limits, NoPlanReason, Outcome, Unfinished, Way, with_stack};

/// The paper's algorithm and nothing else: a plan with the fewest parallel steps, or the proof that there is none.
///
/// What [`solve`](crate::solve) answers is the same; this is its textbook, and the judge of its tests.
#[must_use]
pub fn solve_plainly(task: &Task, limits: &Limits) -> Outcome {
    let search = |limits: &Limits| {
        with_stack(|| graphplan(task, limits)).unwrap_or_else(Outcome::LimitReached)
    };
    telling(limits, search, |outcome| outcome)
}

fn graphplan(task: &Task, limits: &Limits) -> Result<Outcome, Unfinished> {
    let mut graph = PlanningGraph::new(task);
    let mut search = Search { task, limits, memoised: Vec::new(), ticks: 0, bytes: 0 };
    let outcome = by_levels(&mut graph, &mut search);
    let sets: usize = search.memoised.iter().map(HashSet::len).sum();
    limits.note(Attempt::new(Way::Graph, graph.top(), sets as u64, search.ticks));
    outcome
}

fn by_levels(graph: &mut PlanningGraph, search: &mut Search<'_>) -> Result<Outcome, Unfinished> {
    let Search { task, limits, .. } = *search;
    // How many sets failed at the level at which the graph leveled off, when the last search had failed.
    let mut failed_before = None;
    loop {
        let at_least = graph.top();
        let unfinished = |limit| Unfinished { at_least, ..Unfinished::from(limit) };
        limits.check(graph.bytes() + search.bytes).map_err(unfinished)?;
        if graph.is_possible(&task.goal) {
            if let Some(plan) = search.extract(graph).map_err(unfinished)? {
                return Ok(Outcome::Plan(plan));
            }
            if let Some(leveled_off_at) = graph.leveled_off_at()
                && graph.top() > leveled_off_at
            {
                let failed = search.memoised[leveled_off_at].len();
                if failed_before.replace(failed) == Some(failed) {
                    let reason = NoPlanReason::Together(task.goal.clone());
                    return Ok(Outcome::NoPlan { leveled_off_at, reason });
                }
            }
        } else if let Some(leveled_off_at) = graph.leveled_off_at() {
            let reason = graph.conflict_of(&task.goal);
            return Ok(Outcome::NoPlan { leveled_off_at, reason });
        }
        if graph.top() >= limits.parallel_steps {
            return Err(Unfinished { at_least: graph.top() + 1, ..Limit::Steps.into() });
        }
        graph.expand(limits).map_err(unfinished)?;
    }
}

struct Search<'a> {
    task: &'a Task,
    limits: &'a Limits,
    /// For each level the sets of goals that cannot all hold there.
    memoised: Vec<HashSet<Vec<FactId>>>,
    ticks: u64,
    bytes: usize,
}

/// The actions of a step, by their numbers in the graph.
type Chosen = Vec<usize>;

impl Search<'_> {
    /// A plan with as many steps as the graph has levels, if there is one.
    fn extract(&mut self, graph: &PlanningGraph) -> Result<Option<Plan>, Limit> {
        self.memoised.resize_with(graph.top() + 1, HashSet::new);
        let Some(steps) = self.reach(graph, graph.top(), self.task.goal.clone())? else {
            return Ok(None);
        };
        let operators = |chosen: Chosen| {
            let mut step: Vec<_> =
                chosen.into_iter().filter_map(|number| graph.action(number).operator).collect();
            step.sort_unstable();
            step
        };
        Ok(Some(Plan { steps: steps.into_iter().map(operators).collect() }))
    }

    /// Steps after which all of these goals hold at a level.
    fn reach(
        &mut self,
        graph: &PlanningGraph,
        level: usize,
        goals: Vec<FactId>,
    ) -> Result<Option<Vec<Chosen>>, Limit> {
        if level == 0 {
            // Level 0 holds the initial state and nothing else.
            return Ok(Some(Vec::new()));
        }
        if self.memoised[level].contains(&goals) {
            return Ok(None);
        }
        let steps = self.choose(graph, level, &goals, &mut Vec::new())?;
        if steps.is_none() {
            self.bytes += 64 + goals.len() * 4;
            self.memoised[level].insert(goals);
        }
        Ok(steps)
    }

    /// Actions for the goals that are left, beside those chosen already, and so on downwards.
    fn choose(
        &mut self,
        graph: &PlanningGraph,
        level: usize,
        goals: &[FactId],
        chosen: &mut Chosen,
    ) -> Result<Option<Vec<Chosen>>, Limit> {
        let Some((&goal, others)) = goals.split_first() else {
            return self.descend(graph, level, chosen);
        };
        if chosen.iter().any(|&action| graph.action(action).add_effects.contains(&goal)) {
            return self.choose(graph, level, others, chosen);
        }
        for action in graph.ways(level, goal) {
            self.tick(graph)?;
            if chosen.iter().any(|&other| graph.are_mutex(level, action, other)) {
                continue;
            }
            chosen.push(action);
            let steps = self.choose(graph, level, others, chosen)?;
            chosen.pop();
            if steps.is_some() {
                return Ok(steps);
            }
        }
        Ok(None)
    }

    /// What the chosen actions need are the goals of the level below.
    fn descend(
        &mut self,
        graph: &PlanningGraph,
        level: usize,
        chosen: &Chosen,
    ) -> Result<Option<Vec<Chosen>>, Limit> {
        let needs = chosen.iter().flat_map(|&action| &graph.action(action).preconditions);
        let mut needs: Vec<FactId> = needs.copied().collect();
        needs.sort_unstable();
        needs.dedup();
        let mut steps = self.reach(graph, level - 1, needs)?;
        if let Some(steps) = &mut steps {
            steps.push(chosen.clone());
        }
        Ok(steps)
    }

    fn tick(&mut self, graph: &PlanningGraph) -> Result<(), Limit> {
        self.ticks += 1;
        if self.ticks.is_multiple_of(1024) {
            self.limits.check(graph.bytes() + self.bytes)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{random_errand, random_task};
    use crate::tests::fewest_steps;
    use crate::{solve, validate};

    /// The paper's algorithm against breadth-first search, and what is quick against the paper's algorithm.
    #[test]
    fn the_textbook_and_what_is_quick_say_the_same() {
        let (mut plans, mut none) = (0, 0);
        for seed in 1..=600 {
            let task = if seed % 2 == 0 { random_task(seed) } else { random_errand(seed) };
            let fewest = fewest_steps(&task);
            let quick = solve(&task, &Limits::default());
            match solve_plainly(&task, &Limits::default()) {
                Outcome::Plan(plan) => {
                    assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                    assert_eq!(Some(plan.steps.len()), fewest, "seed {seed}");
                    assert_eq!(quick.plan().map(|plan| plan.steps.len()), fewest, "seed {seed}");
                    plans += 1;
                }
                Outcome::NoPlan { .. } => {
                    assert_eq!(fewest, None, "seed {seed}");
                    assert!(matches!(quick, Outcome::NoPlan { .. }), "seed {seed}");
                    none += 1;
                }
                Outcome::LimitReached(known) => panic!("seed {seed}: {known:?}"),
            }
        }
        assert!(plans > 50 && none > 50, "{plans} plans, {none} without");
    }

    #[test]
    fn a_limit_tells_what_is_refuted() {
        let task = random_errand(1);
        let fewest = fewest_steps(&task).expect("the errand can be done");
        let limits = Limits { parallel_steps: fewest - 1, ..Limits::default() };
        let Outcome::LimitReached(known) = solve_plainly(&task, &limits) else { panic!("too few") };
        assert_eq!((known.limit, known.at_least), (Limit::Steps, fewest));
    }
}
