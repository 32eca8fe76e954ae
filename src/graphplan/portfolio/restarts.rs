//! Plans found step by step, each by fewer operators than the one before: best first by what is to come alone, then anew
//! each time with what was done so far weighing more (S. Richter, J. Thayer, W. Ruml, 2010, "the joy of forgetting").
//!
//! What is followed one operator at a time takes longer to find than the ends of relaxed plans and mostly has fewer
//! actions. A search anew is not held by where the one before it was led; the last goes on by itself until nothing with
//! fewer operators is left.

use super::best_first::{BestFirst, Come, End, Guide};
use super::landmarks::Landmarks;
use super::parallel::{in_parallel, needful};
use super::relaxed::{Relaxed, initial};
use crate::allowed::Allowed;
use crate::plan::Plan;
use crate::strips::Task;
use crate::{Attempt, Limit, Limits, Way};

/// What is to come weighs so much against what was done, one search after the other.
const WEIGHTS: [u32; 4] = [5, 3, 2, 1];

/// Such searches, as far as they have come.
pub(super) struct Restarts<'a> {
    guide: Guide<'a>,
    landmarks: Option<&'a Landmarks>,
    search: BestFirst<'a>,
    /// Weights that had their turn, or have it.
    weights: usize,
}

impl<'a> Restarts<'a> {
    pub(super) fn of(task: &'a Task, landmarks: Option<&'a Landmarks>, limits: &'a Limits) -> Self {
        let (relaxed, allowed) = (Relaxed::by_sum(task), Allowed::new(task));
        let guide = Guide { task, limits, relaxed, allowed, evaluated: 0 };
        let search = BestFirst::new(initial(task), landmarks);
        Self { guide, landmarks, search, weights: 0 }
    }

    /// Goes on to a plan, once one was found to one of fewer actions than so many; whether there may be another. Of the
    /// effort allowed what it took is taken.
    ///
    /// # Errors
    /// The limit that was reached.
    pub(super) fn go_on(
        &mut self,
        effort: &mut u64,
        fewer_than: usize,
    ) -> Result<(Option<Plan>, bool), Limit> {
        if self.weights > 0 {
            self.search.want(fewer_than);
        }
        let most = self.guide.relaxed.effort.saturating_add(*effort);
        let end = End { evaluated: u64::MAX, effort: most };
        let come = self.search.go_on(&mut self.guide, end);
        let spent = self.guide.relaxed.effort;
        *effort = most.saturating_sub(spent);
        self.guide.limits.note(Attempt::new(Way::Forward, 0, self.guide.evaluated, spent));
        Ok(match come? {
            Come::To(operators, _) => {
                let task = self.guide.task;
                let plan = in_parallel(task, needful(task, operators).into_iter());
                if let Some(&weight) = WEIGHTS.get(self.weights) {
                    let most = fewer_than.min(plan.action_count());
                    self.search = BestFirst::weighted(initial(task), self.landmarks, weight, most);
                    self.weights += 1;
                }
                (Some(plan), true)
            }
            Come::Exhausted => (None, false),
            Come::Over => (None, true),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::super::relaxed::{State, carry_out, holds};
    use super::*;
    use crate::samples::{random_errand, random_task};
    use crate::validate;

    /// Fewest actions by trying every operator in every state.
    fn fewest_actions(task: &Task) -> Option<usize> {
        let mut seen = HashSet::from([initial(task)]);
        let mut layer: Vec<State> = seen.iter().cloned().collect();
        for actions in 0.. {
            if layer.iter().any(|state| task.goal.iter().all(|&goal| holds(state, goal))) {
                return Some(actions);
            }
            let mut next = Vec::new();
            for state in &layer {
                for id in task.operator_ids() {
                    if task.operator(id).preconditions.iter().all(|&fact| holds(state, fact)) {
                        let mut after = state.clone();
                        carry_out(task, &mut after, id);
                        if seen.insert(after.clone()) {
                            next.push(after);
                        }
                    }
                }
            }
            if next.is_empty() {
                break;
            }
            layer = next;
        }
        None
    }

    /// With all turns that it takes, however short each is.
    #[test]
    fn when_nothing_is_left_the_last_plan_has_the_fewest_actions() {
        let (mut found, mut improved) = (0, 0);
        for seed in 1..=2000 {
            let task = if seed % 2 == 0 { random_task(seed) } else { random_errand(seed) };
            let (landmarks, limits) = (Landmarks::of(&task), Limits::default());
            let mut search = Restarts::of(&task, landmarks.as_ref(), &limits);
            let mut known = Vec::new();
            loop {
                let fewer_than = known.last().copied().unwrap_or(usize::MAX);
                let (plan, is_open) = search.go_on(&mut 1, fewer_than).unwrap();
                if let Some(plan) = plan {
                    assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                    assert!(plan.action_count() < fewer_than, "seed {seed}");
                    known.push(plan.action_count());
                }
                if !is_open {
                    break;
                }
            }
            assert_eq!(known.last().copied(), fewest_actions(&task), "seed {seed}");
            found += usize::from(!known.is_empty());
            improved += usize::from(known.len() > 1);
        }
        assert!(found > 500 && improved > 0, "{found} {improved}");
    }
}
