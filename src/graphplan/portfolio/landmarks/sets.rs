//! Without which facts there is no way to a fact, when deletes are forgotten: a fixpoint of sets (L. Zhu, R. Givan,
//! 2003).

use std::collections::VecDeque;

use super::State;
use crate::bits::{has, members, put, unite, words};
use crate::strips::{FactId, Operator, Task};

/// What all operators have in common that may add a fact for the first time.
pub(super) struct Ways {
    pub(super) needs: Vec<FactId>,
    pub(super) deletes: Vec<FactId>,
}

impl Ways {
    pub(super) fn of<'a>(operators: impl Iterator<Item = &'a Operator> + Clone) -> Self {
        Self {
            needs: common(operators.clone().map(|operator| operator.preconditions.as_slice())),
            deletes: common(operators.map(|operator| operator.del_effects.as_slice())),
        }
    }
}

pub(super) fn common<'a>(mut lists: impl Iterator<Item = &'a [FactId]>) -> Vec<FactId> {
    let mut common = lists.next().unwrap_or_default().to_vec();
    lists.for_each(|list| common.retain(|fact| list.binary_search(fact).is_ok()));
    common
}

/// For each fact its landmarks, itself among them.
pub(super) struct Sets {
    pub(super) words: usize,
    pub(super) of_fact: Vec<Option<Box<[u64]>>>,
    added_by: Vec<Vec<u32>>,
}

impl Sets {
    pub(super) fn new(task: &Task, state: &State) -> Self {
        let words = words(task.facts.len());
        let mut added_by = vec![Vec::new(); task.facts.len()];
        let mut needed_by = vec![Vec::new(); task.facts.len()];
        for (number, operator) in task.operators.iter().enumerate() {
            operator.add_effects.iter().for_each(|f| added_by[f.index()].push(number as u32));
            operator.preconditions.iter().for_each(|f| needed_by[f.index()].push(number as u32));
        }
        let mut sets = Self { words, of_fact: vec![None; task.facts.len()], added_by };
        for fact in members(state) {
            let mut own = vec![0; words];
            put(&mut own, fact);
            sets.of_fact[fact] = Some(own.into());
        }
        let mut waits = vec![true; task.operators.len()];
        let mut queue: VecDeque<u32> = (0..task.operators.len() as u32).collect();
        let mut through = vec![0; words];
        while let Some(number) = queue.pop_front() {
            waits[number as usize] = false;
            let operator = &task.operators[number as usize];
            if !sets.of_needs(&operator.preconditions, &mut through) {
                continue;
            }
            for &fact in &operator.add_effects {
                if sets.narrow(fact, &through) {
                    for &by in &needed_by[fact.index()] {
                        if !std::mem::replace(&mut waits[by as usize], true) {
                            queue.push_back(by);
                        }
                    }
                }
            }
        }
        sets
    }

    /// The landmarks of all preconditions together; false when one is out of reach.
    fn of_needs(&self, needs: &[FactId], through: &mut [u64]) -> bool {
        through.fill(0);
        needs.iter().all(|need| match &self.of_fact[need.index()] {
            Some(own) => {
                unite(through, own);
                true
            }
            None => false,
        })
    }

    /// There is a way to a fact through these; whether that tells anything new.
    fn narrow(&mut self, fact: FactId, through: &[u64]) -> bool {
        let own = &mut self.of_fact[fact.index()];
        let Some(own) = own else {
            let mut set: Box<[u64]> = through.into();
            put(&mut set, fact.index());
            *own = Some(set);
            return true;
        };
        let mut narrower = false;
        for (at, (own, &through)) in own.iter_mut().zip(through).enumerate() {
            let itself = if fact.index() / 64 == at { 1 << (fact.index() % 64) } else { 0 };
            let kept = *own & (through | itself);
            narrower |= kept != *own;
            *own = kept;
        }
        narrower
    }

    /// A way that needs the fact itself is no first way to it, unless it held: a block is not taken off itself.
    pub(super) fn first_ways(&self, task: &Task, fact: FactId, held: bool) -> Ways {
        let first = |operator: &&Operator| {
            let before = |need: &FactId| {
                let set = self.of_fact[need.index()].as_ref();
                set.is_some_and(|set| !has(set, fact.index()))
            };
            held || operator.preconditions.iter().all(before)
        };
        Ways::of(self.operators(task, fact).filter(first))
    }

    /// Operators that may bring one of some facts while none of them held before.
    pub(super) fn first_of<'a>(&'a self, task: &'a Task, facts: &[FactId]) -> Vec<&'a Operator> {
        let before = |need: &FactId| {
            let set = self.of_fact[need.index()].as_ref();
            set.is_some_and(|set| !facts.iter().any(|fact| has(set, fact.index())))
        };
        let all = facts.iter().flat_map(|&fact| self.operators(task, fact));
        all.filter(|operator| operator.preconditions.iter().all(before)).collect()
    }

    /// Operators that may bring one of some facts at any time.
    pub(super) fn all_of<'a>(&'a self, task: &'a Task, facts: &[FactId]) -> Vec<&'a Operator> {
        let all = facts.iter().flat_map(|&fact| self.operators(task, fact));
        all.filter(|operator| self.is_possible(operator)).collect()
    }

    fn is_possible(&self, operator: &Operator) -> bool {
        operator.preconditions.iter().all(|need| self.of_fact[need.index()].is_some())
    }

    pub(super) fn ways(&self, task: &Task, fact: FactId) -> Ways {
        Ways::of(self.operators(task, fact).filter(|operator| self.is_possible(operator)))
    }

    fn operators<'a>(
        &'a self,
        task: &'a Task,
        fact: FactId,
    ) -> impl Iterator<Item = &'a Operator> + Clone {
        self.added_by[fact.index()].iter().map(|&number| &task.operators[number as usize])
    }
}
