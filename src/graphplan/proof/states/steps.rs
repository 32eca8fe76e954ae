//! What one step can make of a state.
//!
//! A step carries out any operators of which no two interfere, so there may be many: more than a search can look at, and
//! then it ends. Left out is what brings nothing new, since whatever can be done without it can be done still. And what
//! *only helps* is not weighed but done: an operator whose effects nobody ever takes away, that uses up only what nobody
//! else wants, and that interferes with nothing else that could be done now. Put into the first step of a plan it leaves
//! the rest of the plan as it is, but that the operator itself is done with.

use crate::allowed::Allowed;
use crate::bits;
use crate::strips::{FactId, OperatorId, Task};

/// Of more operators than this it is not kept which interfere.
const MOST_OPERATORS: usize = 1 << 12;

/// More ways to go on from one state are not looked at.
const MOST_WAYS: usize = 1 << 9;

pub(super) struct Steps<'a> {
    task: &'a Task,
    allowed: Allowed,
    /// For each operator those that it interferes with.
    rivals: Vec<Box<[u64]>>,
    /// Operators whose effects last and that use up only what they alone want.
    last: Vec<bool>,
    /// What states after steps took so far.
    carried_out: u64,
}

/// A state after a step, and the operators carried out in it.
pub(super) type After = (Vec<u64>, Vec<OperatorId>);

impl<'a> Steps<'a> {
    /// None where there are too many operators.
    pub(super) fn of(task: &'a Task) -> Option<Self> {
        let count = task.operators.len();
        if count > MOST_OPERATORS {
            return None;
        }
        let mut needed_by = vec![Vec::new(); task.facts.len()];
        let mut is_taken = vec![false; task.facts.len()];
        for id in task.operator_ids() {
            let operator = task.operator(id);
            operator.preconditions.iter().for_each(|fact| needed_by[fact.index()].push(id));
            operator.takes().for_each(|fact| is_taken[fact.index()] = true);
        }
        let mut rivals = vec![vec![0; bits::words(count)].into_boxed_slice(); count];
        for (a, one) in task.operators.iter().enumerate() {
            for (b, other) in task.operators[..a].iter().enumerate() {
                if one.interferes(other) {
                    bits::put(&mut rivals[a], b);
                    bits::put(&mut rivals[b], a);
                }
            }
        }
        let lasts = |id: OperatorId| {
            let operator = task.operator(id);
            let is_own = |fact: &FactId| {
                needed_by[fact.index()].iter().all(|&other| other == id)
                    && !task.goal.contains(fact)
            };
            !operator.add_effects.iter().any(|fact| is_taken[fact.index()])
                && operator.del_effects.iter().all(is_own)
        };
        let last = task.operator_ids().map(lasts).collect();
        Some(Self { task, allowed: Allowed::new(task), rivals, last, carried_out: 0 })
    }

    /// What was looked at so far.
    pub(super) fn effort(&self) -> u64 {
        self.allowed.looked_at + self.carried_out
    }

    /// All states that one step leads to, some twice; none where there are too many.
    pub(super) fn after(&mut self, state: &[u64]) -> Option<Vec<After>> {
        let applicable = self.applicable(state);
        let only_helps = |id: &OperatorId| {
            let rivals = &self.rivals[id.index()];
            self.last[id.index()] && !applicable.iter().any(|o| bits::has(rivals, o.index()))
        };
        let (mut chosen, open): (Vec<OperatorId>, Vec<OperatorId>) =
            applicable.iter().copied().partition(only_helps);
        let mut found = Vec::new();
        if !chosen.is_empty() {
            found.push(self.carried_out(state, &chosen));
        }
        let fits = self.add_sets(state, &open, &mut chosen, &mut found);
        self.carried_out += (found.len() * (8 + 2 * state.len())) as u64;
        fits.then_some(found)
    }

    /// Adds what one or more of the operators besides those chosen come to; not when there are too many ways.
    fn add_sets(
        &self,
        state: &[u64],
        open: &[OperatorId],
        chosen: &mut Vec<OperatorId>,
        found: &mut Vec<After>,
    ) -> bool {
        for (at, &id) in open.iter().enumerate() {
            chosen.push(id);
            found.push(self.carried_out(state, chosen));
            let is_free = |other: &OperatorId| !bits::has(&self.rivals[id.index()], other.index());
            let beside: Vec<OperatorId> = open[at + 1..].iter().copied().filter(is_free).collect();
            let fits = found.len() <= MOST_WAYS && self.add_sets(state, &beside, chosen, found);
            chosen.pop();
            if !fits {
                return false;
            }
        }
        true
    }

    fn carried_out(&self, state: &[u64], chosen: &[OperatorId]) -> After {
        let mut after = state.to_vec();
        for &id in chosen {
            let operator = self.task.operator(id);
            operator.del_effects.iter().for_each(|fact| bits::take(&mut after, fact.index()));
            operator.add_effects.iter().for_each(|fact| bits::put(&mut after, fact.index()));
        }
        let mut chosen = chosen.to_vec();
        chosen.sort_unstable();
        (after, chosen)
    }

    /// What can be carried out and brings something new.
    fn applicable(&mut self, state: &[u64]) -> Vec<OperatorId> {
        let mut applicable = self.allowed.by(state);
        applicable.retain(|&id| {
            self.task.operator(id).add_effects.iter().any(|fact| !bits::has(state, fact.index()))
        });
        applicable
    }
}
