//! What one step can make of a state.
//!
//! A step carries out any operators of which no two interfere, so there may be many: more than a search can look at, and
//! then it ends. Left out is what brings nothing new, since whatever can be done without it can be done still. And what
//! *only helps* is not weighed but done: an operator whose effects nobody ever takes away, that uses up only what nobody
//! else wants, and that interferes with nothing else that could be done now. Put into the first step of a plan it leaves
//! the rest of the plan as it is, but that the operator itself is done with.

use std::borrow::Cow;

use crate::allowed::Allowed;
use crate::bits;
use crate::strips::{FactId, Operator, OperatorId, Task};

/// Of more operators than this it is not kept which interfere.
const MOST_OPERATORS: usize = 1 << 12;

/// More ways to go on from one state are not looked at.
const MOST_WAYS: usize = 1 << 9;

pub(super) struct Steps<'a> {
    task: Cow<'a, Task>,
    allowed: Allowed,
    rivals: Rivals,
    /// Operators whose effects last and that use up only what they alone want.
    last: Vec<bool>,
    /// Whether all that an operator brings must be new.
    is_all_new: bool,
    /// For each fact those that never hold beside it; none where that goes without saying.
    exclusive: Vec<Box<[u64]>>,
    /// What states after steps took so far.
    carried_out: u64,
}

/// For each operator those that it cannot go into one step with.
pub(super) type Rivals = Vec<Box<[u64]>>;

/// A state after a step, and the operators carried out in it.
pub(super) type After = (Vec<u64>, Vec<OperatorId>);

impl<'a> Steps<'a> {
    /// None where there are too many operators.
    pub(super) fn of(task: &'a Task) -> Option<Self> {
        let claims: Vec<Claims> = task.operators.iter().map(Claims::of).collect();
        let rivals = rivals(&claims, task.facts.len())?;
        let mut needed_by = vec![Vec::new(); task.facts.len()];
        let mut is_taken = vec![false; task.facts.len()];
        for id in task.operator_ids() {
            let operator = task.operator(id);
            operator.preconditions.iter().for_each(|fact| needed_by[fact.index()].push(id));
            operator.takes().for_each(|fact| is_taken[fact.index()] = true);
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
        Some(Self { last, is_all_new: false, ..Self::of_all(Cow::Borrowed(task), rivals) })
    }

    /// Steps in which nothing is done but what is chosen, and all that is added is new.
    pub(super) fn of_all(task: Cow<'a, Task>, rivals: Rivals) -> Self {
        let (allowed, last) = (Allowed::new(&task), vec![false; task.operators.len()]);
        let exclusive = Vec::new();
        Self { task, allowed, rivals, last, is_all_new: true, exclusive, carried_out: 0 }
    }

    /// Leads to no state in which facts exclude each other.
    pub(super) fn keeping_apart(self, exclusive: Vec<Box<[u64]>>) -> Self {
        Self { exclusive, ..self }
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
            let after = self.carried_out(state, chosen);
            if chosen.iter().all(|&id| self.excluded_by(id, &after.0).next().is_none()) {
                found.push(after);
            }
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
            let is_new = |fact: FactId| !bits::has(state, fact.index());
            let mut brought = brought_by(self.task.operator(id));
            if self.is_all_new { brought.all(is_new) } else { brought.any(is_new) }
        });
        if self.exclusive.is_empty() {
            return applicable;
        }
        // What an operator adds may exclude what only others of its step delete.
        let is_deleted = |fact: usize, id: OperatorId| {
            let fact = FactId(fact as u32);
            let beside = |other: &&OperatorId| {
                **other == id || !bits::has(&self.rivals[id.index()], other.index())
            };
            let deletes =
                |other: &OperatorId| self.task.operator(*other).del_effects.contains(&fact);
            applicable.iter().filter(beside).any(deletes)
        };
        let fits = |id: &OperatorId| self.excluded_by(*id, state).all(|fact| is_deleted(fact, *id));
        applicable.iter().copied().filter(fits).collect()
    }

    /// What holds and what an operator adds exclude each other.
    fn excluded_by(&self, id: OperatorId, state: &[u64]) -> impl Iterator<Item = usize> {
        let adds =
            if self.exclusive.is_empty() { &[] } else { &self.task.operator(id).add_effects[..] };
        adds.iter().flat_map(move |fact| bits::common(&self.exclusive[fact.index()], state))
    }
}

/// What an operator adds that need not hold before.
pub(super) fn brought_by(operator: &Operator) -> impl Iterator<Item = FactId> {
    operator.add_effects.iter().copied().filter(|fact| !operator.preconditions.contains(fact))
}

/// What an operator uses, and what it takes: nobody else in its step may use that.
pub(super) struct Claims {
    pub(super) uses: Vec<FactId>,
    pub(super) takes: Vec<FactId>,
}

impl Claims {
    /// Of those that may go into one step in any order (A. Blum, M. Furst, 1997).
    fn of(operator: &Operator) -> Self {
        let uses = operator.preconditions.iter().chain(&operator.add_effects);
        Self { uses: uses.copied().collect(), takes: operator.takes().collect() }
    }
}

/// None where there are too many operators.
pub(super) fn rivals(claims: &[Claims], fact_count: usize) -> Option<Rivals> {
    let count = claims.len();
    if count > MOST_OPERATORS {
        return None;
    }
    let row = || vec![0; bits::words(count)].into_boxed_slice();
    let (mut users, mut takers) = (vec![row(); fact_count], vec![row(); fact_count]);
    for (number, Claims { uses, takes }) in claims.iter().enumerate() {
        uses.iter().for_each(|fact| bits::put(&mut users[fact.index()], number));
        takes.iter().for_each(|fact| bits::put(&mut takers[fact.index()], number));
    }
    let rivals = claims.iter().enumerate().map(|(number, Claims { uses, takes })| {
        let mut rivals = row();
        takes.iter().for_each(|fact| bits::unite(&mut rivals, &users[fact.index()]));
        uses.iter().for_each(|fact| bits::unite(&mut rivals, &takers[fact.index()]));
        bits::take(&mut rivals, number);
        rivals
    });
    Some(rivals.collect())
}
