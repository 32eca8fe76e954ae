//! What a state allows: of each operator the needs that it lacks are counted, fact by fact of the state.

use crate::bits;
use crate::strips::{OperatorId, Task};

pub(crate) struct Allowed {
    needed_by: Vec<Vec<OperatorId>>,
    without_needs: Vec<OperatorId>,
    /// How many facts each operator lacks, while a state is looked at.
    missing: Vec<u32>,
    /// Needs looked at so far.
    pub(crate) looked_at: u64,
}

impl Allowed {
    pub(crate) fn new(task: &Task) -> Self {
        let mut needed_by = vec![Vec::new(); task.facts.len()];
        let mut without_needs = Vec::new();
        for id in task.operator_ids() {
            let needs = &task.operator(id).preconditions;
            needs.iter().for_each(|fact| needed_by[fact.index()].push(id));
            if needs.is_empty() {
                without_needs.push(id);
            }
        }
        let missing = task.operators.iter().map(|o| o.preconditions.len() as u32).collect();
        Self { needed_by, without_needs, missing, looked_at: 0 }
    }

    /// Ascending.
    pub(crate) fn by(&mut self, state: &[u64]) -> Vec<OperatorId> {
        let mut allowed = self.without_needs.clone();
        let mut touched = Vec::new();
        for fact in bits::members(state) {
            for &id in &self.needed_by[fact] {
                let missing = &mut self.missing[id.index()];
                *missing -= 1;
                touched.push(id);
                if *missing == 0 {
                    allowed.push(id);
                }
            }
        }
        touched.iter().for_each(|id| self.missing[id.index()] += 1);
        self.looked_at += touched.len() as u64;
        allowed.sort_unstable();
        allowed
    }
}
