//! Which pairs of facts can ever hold at once, as far as pairs tell: where the mutexes of the planning graph level
//! off (h^2: P. Haslum, H. Geffner, 2000), found without its levels.
//!
//! An operator whose preconditions can all hold in pairs carries over every fact that can hold beside each of them
//! and that it does not delete. Rows of bits make that a few words an operator; only operators that need a fact whose
//! row has grown are looked at again, sweep by sweep.

use crate::bits;
use crate::strips::{FactId, OperatorId, Task};
use crate::{Limit, Limits};

pub(crate) struct ReachedPairs {
    words: usize,
    /// Row by row; a fact that can hold at all is in its own row.
    rows: Vec<u64>,
    /// Operators that can be carried out, as far as pairs tell.
    pub(crate) applicable: Vec<bool>,
}

impl ReachedPairs {
    /// # Errors
    /// Time or memory is up.
    pub(crate) fn of(task: &Task, limits: &Limits) -> Result<Self, Limit> {
        let words = bits::words(task.facts.len());
        limits.check(words * task.facts.len() * 8)?;
        let mut reached = Self {
            words,
            rows: vec![0; words * task.facts.len()],
            applicable: vec![false; task.operators.len()],
        };
        let mut needed_by = vec![Vec::new(); task.facts.len()];
        for id in task.operator_ids() {
            task.operator(id).preconditions.iter().for_each(|f| needed_by[f.index()].push(id));
        }
        for &a in &task.init {
            for &b in &task.init {
                bits::put(reached.row_mut(a), b.index());
            }
        }
        let without_needs: Vec<OperatorId> =
            task.operator_ids().filter(|&id| task.operator(id).preconditions.is_empty()).collect();
        let mut due: Vec<OperatorId> = task.operator_ids().collect();
        let mut is_due = vec![false; task.operators.len()];
        let mut grown = Grown { facts: Vec::new(), has: vec![false; task.facts.len()] };
        // Sweep by sweep: a row mostly grows by many operators of a sweep, and who needs it is looked for once.
        while !due.is_empty() {
            let mut any_new = false;
            for (n, id) in due.drain(..).enumerate() {
                if n.is_multiple_of(256) {
                    limits.check(reached.rows.len() * 8)?;
                }
                is_due[id.index()] = false;
                any_new |= reached.carry_out(task, id, &mut grown);
            }
            // What needs nothing goes beside every fact that can hold at all.
            let others = if any_new { without_needs.as_slice() } else { &[] };
            let needing = grown.facts.iter().flat_map(|fact| &needed_by[*fact]).chain(others);
            for &id in needing {
                if !std::mem::replace(&mut is_due[id.index()], true) {
                    due.push(id);
                }
            }
            grown.clear();
        }
        Ok(reached)
    }

    /// Facts that can hold beside a fact.
    pub(crate) fn row(&self, fact: FactId) -> &[u64] {
        &self.rows[fact.index() * self.words..][..self.words]
    }

    fn row_mut(&mut self, fact: FactId) -> &mut [u64] {
        &mut self.rows[fact.index() * self.words..][..self.words]
    }

    pub(crate) fn is_exclusive(&self, a: FactId, b: FactId) -> bool {
        !bits::has(self.row(a), b.index())
    }

    /// Notes what an operator brings about and which facts' rows have grown by it; whether it makes a fact hold that
    /// never did.
    fn carry_out(&mut self, task: &Task, id: OperatorId, grown: &mut Grown) -> bool {
        let operator = task.operator(id);
        let needs = &operator.preconditions;
        let may_hold = |(n, a): (usize, &FactId)| {
            let row = self.row(*a);
            needs[n..].iter().all(|b| bits::has(row, b.index()))
        };
        if !needs.iter().enumerate().all(may_hold) {
            return false;
        }
        let mut beside = match needs.split_first() {
            Some((first, others)) => {
                let mut beside = self.row(*first).to_vec();
                others.iter().for_each(|&fact| bits::keep_common(&mut beside, self.row(fact)));
                beside
            }
            None => {
                let mut beside = vec![0; self.words];
                let possible = task.fact_ids().filter(|&fact| self.can_hold(fact));
                possible.for_each(|fact| bits::put(&mut beside, fact.index()));
                beside
            }
        };
        self.applicable[id.index()] = true;
        operator.del_effects.iter().for_each(|fact| bits::take(&mut beside, fact.index()));
        let is_new = operator.add_effects.iter().any(|&fact| !self.can_hold(fact));
        operator.add_effects.iter().for_each(|fact| bits::put(&mut beside, fact.index()));
        for &added in &operator.add_effects {
            let at = added.index() * self.words;
            let mut grows = false;
            for (word, &beside) in beside.iter().enumerate() {
                let more = beside & !self.rows[at + word];
                if more == 0 {
                    continue;
                }
                grows = true;
                self.rows[at + word] |= more;
                for bit in bits::of_word(more) {
                    let other = word * 64 + bit;
                    bits::put(&mut self.rows[other * self.words..][..self.words], added.index());
                    grown.add(other);
                }
            }
            if grows {
                grown.add(added.index());
            }
        }
        is_new
    }

    fn can_hold(&self, fact: FactId) -> bool {
        bits::has(self.row(fact), fact.index())
    }
}

/// Facts whose rows have grown, each once.
struct Grown {
    facts: Vec<usize>,
    has: Vec<bool>,
}

impl Grown {
    fn add(&mut self, fact: usize) {
        if !std::mem::replace(&mut self.has[fact], true) {
            self.facts.push(fact);
        }
    }

    fn clear(&mut self) {
        self.facts.drain(..).for_each(|fact| self.has[fact] = false);
    }
}
