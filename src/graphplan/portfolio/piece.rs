//! What of a task a short piece of a plan can use at all: a task with few operators is made ready and searched in no time.
//!
//! An operator is left out if it cannot be carried out so soon, even without delete effects, or if after it so few
//! steps are left that it serves no goal. Every plan within so many steps, rid of what serves nothing, is kept, unless the
//! piece is large.

use super::relaxed::{self, Relaxed, State};
use crate::proof::needed::Reduced;
use crate::strips::{FactId, OperatorId, Task};

/// A piece has no more operators than these, if it can be cut down to so many.
const FEW: usize = 1 << 10;

/// What lies within so many steps between a state and a goal. Where that is much, nothing that holds at first is brought
/// about anew: a hand that is free need not take something up to be so again. Mostly the best plan is kept then, too.
pub(crate) fn within(
    task: &Task,
    relaxed: &mut Relaxed<'_>,
    (state, goal): (&State, &[FactId]),
    steps: usize,
) -> Reduced {
    // Steps after which an operator can be carried out at the earliest.
    let earliest = relaxed.earliest(state, steps);
    let init = relaxed::facts(state);
    let all = serving(task, relaxed, &earliest, (&[], goal), steps);
    let operators = if all.len() <= FEW {
        all
    } else {
        serving(task, relaxed, &earliest, (&init, goal), steps)
    };
    Reduced::keeping(task, operators, &init, goal)
}

/// The operators that can come in time, and early enough to serve the goal, without what serves facts that are given.
fn serving(
    task: &Task,
    relaxed: &Relaxed<'_>,
    earliest: &[usize],
    (given, goal): (&[FactId], &[FactId]),
    steps: usize,
) -> Vec<OperatorId> {
    const NEVER: usize = usize::MAX;
    // Facts that were wanted already.
    let mut wanted = vec![false; task.facts.len()];
    given.iter().for_each(|fact| wanted[fact.index()] = true);
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
                let piece = within(&task, &mut Relaxed::new(&task), (&state, &task.goal), steps);
                left_out += task.operators.len() - piece.task.operators.len();
                assert_eq!(fewest_steps(&piece.task), Some(fewest), "seed {seed}");
            }
            planned += usize::from(fewest > 0);
        }
        assert!(planned > 300 && left_out > 1000, "{planned} {left_out}");
    }
}
