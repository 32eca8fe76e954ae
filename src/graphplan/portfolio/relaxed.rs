//! The problem without delete effects: how far a state seems from the goal (J. Hoffmann, B. Nebel, 2001).
//!
//! A relaxed plan is read off layers of facts that only grow. Its length estimates the distance, and operators that
//! bring a fact of its first layer are worth trying first.

use std::collections::{BTreeSet, HashSet};

use crate::bits;
use crate::strips::{FactId, OperatorId, Task};

/// What holds, as bits.
pub(crate) type State = Box<[u64]>;

pub(crate) fn holds(state: &State, fact: FactId) -> bool {
    bits::has(state, fact.index())
}

/// How far a state seems from the goal, and what to try.
pub(crate) struct Estimate {
    pub(crate) distance: u32,
    /// Applicable operators that bring a first fact of the relaxed plan, those of the relaxed plan first.
    pub(crate) helpful: Vec<OperatorId>,
    /// The relaxed plan, in the order of its layers.
    pub(crate) relaxed_plan: Vec<OperatorId>,
}

/// The problem without delete effects.
pub(crate) struct Relaxed<'a> {
    task: &'a Task,
    /// Operators by a fact that they need, those of fact `f` from `starts[f]` to `starts[f + 1]`.
    needed_by: Vec<u32>,
    starts: Vec<u32>,
    pub(crate) added_by: Vec<Vec<u32>>,
    /// What operator `o` adds, from `adds_from[o]` to `adds_from[o + 1]`.
    adds: Vec<FactId>,
    adds_from: Vec<u32>,
    without_needs: Vec<u32>,
    /// How many facts an operator needs, and how many of them are yet missing.
    needs: Vec<u32>,
    missing: Vec<u32>,
    goal: Vec<FactId>,
    is_goal: Vec<bool>,
    /// The layer at which a fact appears, and the operator that brings it.
    layer: Vec<u32>,
    bringer: Vec<u32>,
    /// Operators that can be carried out in the state looked at last, ascending.
    pub(crate) applicable: Vec<OperatorId>,
}

const NOT_YET: u32 = u32::MAX;

impl<'a> Relaxed<'a> {
    pub(crate) fn new(task: &'a Task) -> Self {
        let mut by_need = vec![Vec::new(); task.facts.len()];
        let mut added_by = vec![Vec::new(); task.facts.len()];
        for (number, operator) in task.operators.iter().enumerate() {
            let needs = operator.preconditions.iter();
            needs.for_each(|fact| by_need[fact.index()].push(number as u32));
            operator.add_effects.iter().for_each(|fact| added_by[fact.index()].push(number as u32));
        }
        let mut starts = vec![0];
        let mut needed_by = Vec::new();
        for operators in by_need {
            needed_by.extend(operators);
            starts.push(needed_by.len() as u32);
        }
        let mut adds_from = vec![0];
        let mut adds = Vec::new();
        for operator in &task.operators {
            adds.extend(&operator.add_effects);
            adds_from.push(adds.len() as u32);
        }
        let needs: Vec<u32> =
            task.operators.iter().map(|operator| operator.preconditions.len() as u32).collect();
        let mut relaxed = Self {
            task,
            needed_by,
            starts,
            added_by,
            adds,
            adds_from,
            without_needs: (0..needs.len() as u32).filter(|&n| needs[n as usize] == 0).collect(),
            missing: needs.clone(),
            needs,
            goal: Vec::new(),
            is_goal: vec![false; task.facts.len()],
            layer: vec![NOT_YET; task.facts.len()],
            bringer: vec![NOT_YET; task.facts.len()],
            applicable: Vec::new(),
        };
        relaxed.aim_at(&task.goal);
        relaxed
    }

    /// From now on distances are those to these facts.
    pub(crate) fn aim_at(&mut self, goal: &[FactId]) {
        self.goal.iter().for_each(|fact| self.is_goal[fact.index()] = false);
        self.goal = goal.to_vec();
        self.goal.iter().for_each(|fact| self.is_goal[fact.index()] = true);
    }

    /// None when the goal is out of reach even without delete effects.
    pub(crate) fn estimate(&mut self, state: &State) -> Option<Estimate> {
        self.spread(state).then(|| self.relaxed_plan(state))
    }

    /// Steps that the goal takes at least from a state: its layer without delete effects; none when it is out of reach
    /// even so.
    pub(crate) fn depth(&mut self, state: &State) -> Option<usize> {
        let reached = self.spread(state);
        let layers = self.goal.iter().map(|goal| self.layer[goal.index()] as usize);
        reached.then(|| layers.max().unwrap_or(0))
    }

    /// Layers of facts up to the goal.
    fn spread(&mut self, state: &State) -> bool {
        self.layer.fill(NOT_YET);
        self.missing.copy_from_slice(&self.needs);
        let mut open = self.goal.iter().filter(|goal| !holds(state, **goal)).count();
        let mut queue: Vec<u32> = Vec::new();
        for fact in bits::members(state) {
            self.layer[fact] = 0;
            queue.push(fact as u32);
        }
        self.applicable.clear();
        for at in 0..self.without_needs.len() {
            self.applicable.push(OperatorId(self.without_needs[at]));
            self.apply(self.without_needs[at], 1, &mut open, &mut queue);
        }
        let mut next = 0;
        while let Some(&fact) = queue.get(next) {
            next += 1;
            let layer = self.layer[fact as usize];
            // What the state itself allows is wanted whole, even if the goal holds.
            if open == 0 && layer > 0 {
                break;
            }
            for at in self.starts[fact as usize]..self.starts[fact as usize + 1] {
                let number = self.needed_by[at as usize];
                self.missing[number as usize] -= 1;
                if self.missing[number as usize] == 0 {
                    if layer == 0 {
                        self.applicable.push(OperatorId(number));
                    }
                    self.apply(number, layer + 1, &mut open, &mut queue);
                }
            }
        }
        self.applicable.sort_unstable();
        open == 0
    }

    fn apply(&mut self, number: u32, layer: u32, open: &mut usize, queue: &mut Vec<u32>) {
        let own =
            self.adds_from[number as usize] as usize..self.adds_from[number as usize + 1] as usize;
        for added in &self.adds[own] {
            if self.layer[added.index()] == NOT_YET {
                self.layer[added.index()] = layer;
                self.bringer[added.index()] = number;
                queue.push(added.0);
                *open -= usize::from(self.is_goal[added.index()]);
            }
        }
    }

    fn relaxed_plan(&self, state: &State) -> Estimate {
        let mut wanted: Vec<FactId> =
            self.goal.iter().copied().filter(|&goal| !holds(state, goal)).collect();
        let mut asked: HashSet<FactId> = wanted.iter().copied().collect();
        // Operators by the layer at which they become possible.
        let mut chosen: BTreeSet<(u32, u32)> = BTreeSet::new();
        let mut first: BTreeSet<FactId> = BTreeSet::new();
        while let Some(fact) = wanted.pop() {
            if self.layer[fact.index()] == 1 {
                first.insert(fact);
            }
            let number = self.bringer[fact.index()];
            if chosen.insert((self.layer[fact.index()], number)) {
                for &need in &self.task.operators[number as usize].preconditions {
                    if self.layer[need.index()] > 0 && asked.insert(need) {
                        wanted.push(need);
                    }
                }
            }
        }
        let applicable = |number: &u32| {
            self.task.operators[*number as usize]
                .preconditions
                .iter()
                .all(|&fact| holds(state, fact))
        };
        // Whatever brings a fact of the first layer helps, not only what the relaxed plan chose for it.
        let mut operators: Vec<u32> = first
            .iter()
            .flat_map(|fact| self.added_by[fact.index()].iter().copied())
            .filter(applicable)
            .collect();
        operators.sort_unstable_by_key(|number| (!chosen.contains(&(1, *number)), *number));
        operators.dedup();
        Estimate {
            distance: chosen.len() as u32,
            helpful: operators.into_iter().map(OperatorId).collect(),
            relaxed_plan: chosen.into_iter().map(|(_, number)| OperatorId(number)).collect(),
        }
    }
}
