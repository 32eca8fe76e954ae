//! What of a task a short piece of a plan can use at all: a task with few operators is made ready and searched in no time.
//!
//! An operator is left out if it cannot be carried out so soon, even without delete effects, or if after it so few
//! steps are left that it serves no goal. Every plan within so many steps, rid of what serves nothing, is kept.

use super::relaxed::{Relaxed, State};
use crate::strips::{FactId, OperatorId, Task};

/// The operators of a piece that lie within so many steps, between a state and a goal.
pub(crate) fn within(
    task: &Task,
    relaxed: &mut Relaxed<'_>,
    (state, goal): (&State, &[FactId]),
    steps: usize,
) -> Vec<OperatorId> {
    const NEVER: usize = usize::MAX;
    // Steps after which an operator can be carried out at the earliest.
    let earliest = relaxed.earliest(state, steps);
    // Facts that were wanted already.
    let mut wanted = vec![false; task.facts.len()];
    let mut layer = goal.to_vec();
    let mut kept = vec![false; task.operators.len()];
    for left in 0..steps {
        layer.retain(|fact| !std::mem::replace(&mut wanted[fact.index()], true));
        let mut next = Vec::new();
        for fact in &layer {
            for &number in &relaxed.added_by[fact.index()] {
                let soon = earliest[number as usize];
                if !kept[number as usize] && soon != NEVER && soon + left < steps {
                    kept[number as usize] = true;
                    let needs = &task.operators[number as usize].preconditions;
                    next.extend(needs.iter().filter(|need| !wanted[need.index()]));
                }
            }
        }
        next.sort_unstable();
        next.dedup();
        layer = next;
    }
    task.operator_ids().filter(|id| kept[id.index()]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::relaxed::initial;
    use super::*;
    use crate::samples::{random_errand, random_task};
    use crate::tests::fewest_steps;

    #[test]
    fn a_shortest_plan_is_kept() {
        let (mut planned, mut left_out) = (0, 0);
        for seed in 1..=2000 {
            let task = if seed % 2 == 0 { random_task(seed) } else { random_errand(seed) };
            let Some(fewest) = fewest_steps(&task) else { continue };
            let state = initial(&task);
            for steps in [fewest, fewest + 2] {
                let own = within(&task, &mut Relaxed::new(&task), (&state, &task.goal), steps);
                left_out += task.operators.len() - own.len();
                let operators = own.iter().map(|&id| task.operator(id).clone()).collect();
                let piece = Task { operators, ..task.clone() };
                assert_eq!(fewest_steps(&piece), Some(fewest), "seed {seed}");
            }
            planned += usize::from(fewest > 0);
        }
        assert!(planned > 300 && left_out > 1000, "{planned} {left_out}");
    }
}
