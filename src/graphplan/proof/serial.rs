//! What can hold after exactly so many steps, where steps follow one another singly.
//!
//! When every two operators exclude each other, as where one hand does everything, a step carries out one operator.
//! And when every shorter plan is refuted, each step does carry one out. Then no fact is kept but beside an operator
//! that leaves it be: a hand that took something up in the first step is full after it, empty after the second.
//! The planning graph does not see that, since its no-ops may keep everything.

use super::pairs::ReachedPairs;
use crate::Limits;
use crate::bits;
use crate::strips::{FactId, OperatorId, Task};

/// Looking at every pair of an operator and a fact, or of operators, takes too long beyond this.
const MOST_PAIRS: usize = 1 << 21;

/// After exactly so many steps, which facts can hold, and which operators be carried out next.
pub(crate) struct Serial {
    /// For each operator the facts that it leaves be and that can hold beside all that it needs; none where it can
    /// never be carried out.
    keeps: Vec<Option<Box<[u64]>>>,
    levels: Vec<Box<[u64]>>,
}

impl Serial {
    /// None where two operators can be carried out in one step, or there are too many to look at.
    pub(crate) fn of(task: &Task, limits: &Limits) -> Option<Self> {
        let (facts, operators) = (task.facts.len(), task.operators.len());
        if operators * facts.max(operators) > MOST_PAIRS {
            return None;
        }
        let pairs = ReachedPairs::of(task, limits).ok()?;
        let possible: Vec<OperatorId> =
            task.operator_ids().filter(|id| pairs.applicable[id.index()]).collect();
        let mut so_far = possible.iter().enumerate();
        let excludes_all = |(at, &a): (usize, &OperatorId)| {
            limits.check(0).is_ok() && possible[..at].iter().all(|&b| exclude(task, &pairs, a, b))
        };
        if !so_far.all(excludes_all) {
            return None;
        }
        let mut keeps = vec![None; operators];
        possible.into_iter().for_each(|id| keeps[id.index()] = Some(kept(task, &pairs, id)));
        let mut first = vec![0; bits::words(facts)].into_boxed_slice();
        task.init.iter().for_each(|fact| bits::put(&mut first, fact.index()));
        Some(Self { keeps, levels: vec![first] })
    }

    /// Adds a level to the last one.
    pub(crate) fn reach(&mut self, task: &Task) {
        let level = self.levels.len() - 1;
        let now = &self.levels[level];
        let mut next = vec![0; now.len()].into_boxed_slice();
        for id in task.operator_ids().filter(|&id| self.allows(task, level, id)) {
            let keeps = self.keeps[id.index()].as_deref().unwrap_or_default();
            next.iter_mut().zip(now).zip(keeps).for_each(|((next, now), keep)| *next |= now & keep);
            task.operator(id).add_effects.iter().for_each(|f| bits::put(&mut next, f.index()));
        }
        self.levels.push(next);
    }

    /// Whether a fact can hold after exactly so many steps.
    pub(crate) fn holds(&self, level: usize, fact: FactId) -> bool {
        bits::has(&self.levels[level], fact.index())
    }

    /// Whether an operator can be carried out after exactly so many steps.
    pub(crate) fn allows(&self, task: &Task, level: usize, id: OperatorId) -> bool {
        self.keeps[id.index()].is_some()
            && task.operator(id).preconditions.iter().all(|&need| self.holds(level, need))
    }
}

/// Whether two operators are never carried out in one step.
fn exclude(task: &Task, pairs: &ReachedPairs, a: OperatorId, b: OperatorId) -> bool {
    let (a, b) = (task.operator(a), task.operator(b));
    let compete = || {
        let mut needs = a.preconditions.iter();
        needs.any(|&one| b.preconditions.iter().any(|&other| pairs.is_exclusive(one, other)))
    };
    a.interferes(b) || compete()
}

fn kept(task: &Task, pairs: &ReachedPairs, id: OperatorId) -> Box<[u64]> {
    let operator = task.operator(id);
    let mut kept = vec![u64::MAX; bits::words(task.facts.len())].into_boxed_slice();
    operator.preconditions.iter().for_each(|&need| bits::keep_common(&mut kept, pairs.row(need)));
    operator.del_effects.iter().for_each(|fact| bits::take(&mut kept, fact.index()));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::{Turn, search};
    use crate::samples::random_task;
    use crate::strips::Fact;
    use crate::tests::fewest_steps;
    use crate::{Outcome, validate};

    /// A random task all of whose operators pass one token on among three places, so that no two go together.
    fn with_token(seed: u64) -> Task {
        let mut task = random_task(seed);
        let first = task.facts.len() as u32;
        let places = (0..3).map(|number| Fact {
            predicate: format!("token{number}").into(),
            args: Vec::new(),
            negated: false,
        });
        task.facts.extend(places);
        for (number, operator) in task.operators.iter_mut().enumerate() {
            let from = (number as u32 + seed as u32) % 3;
            let to = (from + 1 + (seed / 3 % 2) as u32) % 3;
            operator.preconditions.push(FactId(first + from));
            operator.del_effects.push(FactId(first + from));
            operator.add_effects.push(FactId(first + to));
        }
        task.init.push(FactId(first));
        task.check_invariants();
        task
    }

    #[test]
    fn where_steps_follow_one_another_singly_the_answers_stay_right() {
        let turn = Turn { choices: 16, ..Turn::default() };
        let (mut solved, mut unsolvable) = (0, 0);
        for seed in 1..=3000 {
            let task = with_token(seed);
            assert!(Serial::of(&task, &Limits::default()).is_some(), "seed {seed}");
            let (outcome, _) = search(&task, &Limits::default(), turn, None).unwrap();
            match outcome.expect("turns without end") {
                Outcome::Plan(plan) => {
                    assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                    assert_eq!(Some(plan.steps.len()), fewest_steps(&task), "seed {seed}");
                    solved += 1;
                }
                _ => {
                    assert_eq!(fewest_steps(&task), None, "seed {seed}");
                    unsolvable += 1;
                }
            }
        }
        assert!(solved > 300 && unsolvable > 300, "{solved} {unsolvable}");
    }

    #[test]
    fn a_token_passed_on_is_where_the_number_of_steps_says() {
        let mut task = with_token(1);
        task.operators.truncate(1);
        let (from, to) =
            (task.operators[0].del_effects.clone(), task.operators[0].add_effects.clone());
        let token = |of: &[FactId]| of.last().copied().expect("it passes the token on");
        task.operators[0].preconditions = vec![token(&from)];
        task.operators[0].del_effects = vec![token(&from)];
        task.operators[0].add_effects = vec![token(&to)];
        task.init = vec![token(&from)];
        let mut serial = Serial::of(&task, &Limits::default()).unwrap();
        serial.reach(&task);
        assert!(!serial.holds(1, token(&from)) && serial.holds(1, token(&to)));
        assert!(!serial.allows(&task, 1, OperatorId(0)));
    }
}
