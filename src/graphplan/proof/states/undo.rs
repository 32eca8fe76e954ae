//! Operators undone, and the states that have the goal: what a search from the goal back needs.
//!
//! An operator can be undone where all that it deletes must have held before, and what it adds cannot have: then what was
//! before it follows from what is after it. Then its effects are a vector, too, the same wherever it is carried out; what
//! is reached differs from what holds at first by a sum of such vectors (the state equation of a Petri net: T. Murata,
//! 1989). With what the goal excludes that leaves a few states that have it, often one.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::steps::{Steps, brought_by, rivals};
use crate::bits;
use crate::portfolio::relaxed::initial;
use crate::proof::graph::PlanningGraph;
use crate::strips::{FactId, Operator, OperatorId, Task};

/// Steps from a state on, and those that lead to it; none where an operator cannot be undone, or there are too many.
/// The graph has leveled off.
pub(super) fn there_and_back<'a>(
    task: &'a Task,
    graph: &PlanningGraph,
) -> Option<(Steps<'a>, Steps<'a>)> {
    let possible = task.operator_ids().filter(|&id| is_possible(task.operator(id), graph));
    let possible: Vec<OperatorId> = possible.collect();
    let mut implying = vec![None; task.facts.len()];
    let mut undone = Vec::with_capacity(possible.len());
    for &id in &possible {
        let operator = task.operator(id);
        let mut was_held = |fact: FactId| {
            operator.preconditions.contains(&fact) || {
                let implying =
                    implying[fact.index()].get_or_insert_with(|| facts_implying(fact, task, graph));
                operator.preconditions.iter().any(|need| implying.contains(need))
            }
        };
        undone.push(self::undone(operator, graph, &mut was_held)?);
    }
    // What is brought does not hold before, so nobody else in the step needs or brings it; of what is deleted the same.
    let spoils = |one: &Operator, other: &Operator| {
        let uses = |fact| other.preconditions.contains(&fact) || other.add_effects.contains(&fact);
        brought_by(one).any(uses) || one.del_effects.iter().any(|f| other.del_effects.contains(f))
    };
    let apart = |one: OperatorId, other: OperatorId| {
        let (one, other) = (task.operator(one), task.operator(other));
        one.interferes(other) || spoils(one, other) || spoils(other, one)
    };
    let all: Vec<OperatorId> = task.operator_ids().collect();
    let there = Steps::of_all(Cow::Borrowed(task), rivals(&all, apart)?);
    let back = Task { operators: undone, ..task.clone() };
    let exclusive = task.fact_ids().map(|fact| {
        let mut row = vec![0; bits::words(task.facts.len())].into_boxed_slice();
        graph
            .exclusive_with(graph.top(), fact)
            .for_each(|other| bits::put(&mut row, other.index()));
        row
    });
    let back = Steps::of_all(Cow::Owned(back), rivals(&possible, apart)?);
    Some((there, back.keeping_apart(exclusive.collect())))
}

fn is_possible(operator: &Operator, graph: &PlanningGraph) -> bool {
    graph.is_possible(&operator.preconditions)
}

/// None where it cannot be.
fn undone(
    operator: &Operator,
    graph: &PlanningGraph,
    was_held: &mut dyn FnMut(FactId) -> bool,
) -> Option<Operator> {
    let Operator { preconditions, del_effects, .. } = operator;
    let brought: Vec<FactId> = brought_by(operator).collect();
    let is_new = |fact: &FactId| {
        preconditions.iter().any(|need| graph.is_exclusive(graph.top(), *need, *fact))
    };
    if brought.is_empty()
        || !brought.iter().all(is_new)
        || !del_effects.iter().all(|&fact| was_held(fact))
    {
        return None;
    }
    let mut needs: Vec<FactId> = preconditions.clone();
    needs.retain(|fact| !del_effects.contains(fact));
    needs.extend(&brought);
    needs.sort_unstable();
    Some(Operator {
        preconditions: needs,
        add_effects: del_effects.clone(),
        del_effects: brought,
        renewed: Vec::new(),
        ..operator.clone()
    })
}

/// Facts beside which another always holds, itself among them: it does at first, and every operator leaves it so.
fn facts_implying(fact: FactId, task: &Task, graph: &PlanningGraph) -> BTreeSet<FactId> {
    let excludes = |one: FactId, other: FactId| graph.is_exclusive(graph.top(), one, other);
    let holds_first = task.init.contains(&fact);
    let mut implying: BTreeSet<FactId> = task
        .fact_ids()
        .filter(|&other| !excludes(other, fact) && (holds_first || !task.init.contains(&other)))
        .collect();
    let is_kept = |operator: &Operator, other: FactId, implying: &BTreeSet<FactId>| {
        let has = |facts: &[FactId], one: FactId| facts.contains(&one);
        let holds_before = || operator.preconditions.iter().any(|need| implying.contains(need));
        if has(&operator.add_effects, fact) {
            true
        } else if has(&operator.add_effects, other) {
            holds_before() && !has(&operator.del_effects, fact)
        } else {
            !has(&operator.del_effects, fact)
                || has(&operator.del_effects, other)
                || operator.preconditions.iter().any(|&need| excludes(need, other))
        }
    };
    loop {
        let all = &implying;
        let is_broken = |other: &FactId| {
            *other != fact && !task.operators.iter().all(|operator| is_kept(operator, *other, all))
        };
        let broken: Vec<FactId> = all.iter().copied().filter(is_broken).collect();
        if broken.is_empty() {
            return implying;
        }
        broken.iter().for_each(|other| _ = implying.remove(other));
    }
}

/// A prime: what must be zero is zero modulo it, too.
const MODULUS: i64 = (1 << 31) - 1;

/// More facts are too many to be eliminated.
const MOST_FACTS: usize = 1 << 10;

/// More states with the goal are not looked for, and not for so long.
const MOST_GOALS: usize = 1 << 8;
const MOST_TRIED: usize = 1 << 14;

/// All states that have the goal, as far as can be told, and maybe some that cannot be come to; none where there are too
/// many. All operators can be undone, and the graph has leveled off.
pub(super) fn goals(task: &Task, graph: &PlanningGraph) -> Option<Vec<Vec<u64>>> {
    let count = task.facts.len();
    if count > MOST_FACTS {
        return None;
    }
    let first = initial(task);
    let holds_first = |fact: usize| i64::from(bits::has(&first, fact));
    let is_excluded = |fact: FactId| {
        graph.fact_level(fact) == u32::MAX
            || task.goal.iter().any(|goal| graph.is_exclusive(graph.top(), *goal, fact))
    };
    let (known, open): (Vec<FactId>, Vec<FactId>) =
        task.fact_ids().partition(|fact| task.goal.contains(fact) || is_excluded(*fact));
    let mut basis = Basis::new(known.iter().chain(&open).map(|fact| fact.index()).collect());
    for operator in task.operators.iter().filter(|operator| is_possible(operator, graph)) {
        let mut change = vec![0; count];
        brought_by(operator).for_each(|fact| change[fact.index()] = 1);
        operator.del_effects.iter().for_each(|fact| change[fact.index()] = MODULUS - 1);
        basis.add(change);
    }
    // What the known facts tell of the sum of changes.
    let mut state: Vec<i64> = (0..count).map(holds_first).collect();
    for fact in &known {
        let wanted = i64::from(task.goal.contains(fact));
        let missing = (wanted - state[fact.index()]).rem_euclid(MODULUS);
        if let Some(row) = basis.of_pivot(fact.index()) {
            add_times(&mut state, row, missing);
        }
    }
    if known.iter().any(|fact| state[fact.index()] != i64::from(task.goal.contains(fact))) {
        return Some(Vec::new());
    }
    let free: Vec<FactId> =
        open.iter().copied().filter(|fact| basis.of_pivot(fact.index()).is_some()).collect();
    let mut trial = Trial { graph, basis: &basis, free: &free, tried: 0, found: Vec::new() };
    trial.choose(0, &mut Vec::new(), &state)?;
    let mut goals = trial.found;
    goals.retain(|state| {
        let held: Vec<FactId> = task.fact_ids().filter(|f| bits::has(state, f.index())).collect();
        graph.is_possible(&held)
    });
    Some(goals)
}

fn add_times(sum: &mut [i64], row: &[i64], factor: i64) {
    if factor != 0 {
        for (sum, &entry) in sum.iter_mut().zip(row).filter(|(_, entry)| **entry != 0) {
            *sum = (*sum + factor * entry) % MODULUS;
        }
    }
}

/// Vectors of which all sums are made, each with a place of its own where it is 1 and the others are 0.
struct Basis {
    /// The places in the order in which they are given to vectors.
    order: Vec<usize>,
    rows: Vec<Vec<i64>>,
    row_of: Vec<Option<usize>>,
}

impl Basis {
    fn new(order: Vec<usize>) -> Self {
        let row_of = vec![None; order.len()];
        Self { order, rows: Vec::new(), row_of }
    }

    fn of_pivot(&self, place: usize) -> Option<&[i64]> {
        self.row_of[place].map(|row| &self.rows[row][..])
    }

    fn add(&mut self, mut vector: Vec<i64>) {
        for place in 0..vector.len() {
            if let (1.., Some(row)) = (vector[place], self.row_of[place]) {
                let factor = MODULUS - vector[place];
                add_times(&mut vector, &self.rows[row], factor);
            }
        }
        let Some(&pivot) = self.order.iter().find(|&&place| vector[place] != 0) else { return };
        let inverse = power(vector[pivot], MODULUS - 2);
        vector.iter_mut().for_each(|entry| *entry = *entry * inverse % MODULUS);
        for row in &mut self.rows {
            let factor = (MODULUS - row[pivot]) % MODULUS;
            add_times(row, &vector, factor);
        }
        self.row_of[pivot] = Some(self.rows.len());
        self.rows.push(vector);
    }
}

fn power(mut base: i64, mut exponent: i64) -> i64 {
    let mut product = 1;
    while exponent > 0 {
        if exponent % 2 == 1 {
            product = product * base % MODULUS;
        }
        base = base * base % MODULUS;
        exponent /= 2;
    }
    product
}

/// What is left open is tried fact by fact.
struct Trial<'a> {
    graph: &'a PlanningGraph,
    basis: &'a Basis,
    free: &'a [FactId],
    tried: usize,
    found: Vec<Vec<u64>>,
}

impl Trial<'_> {
    /// None where there is too much to be tried.
    fn choose(&mut self, at: usize, held: &mut Vec<FactId>, state: &[i64]) -> Option<()> {
        self.tried += 1;
        if self.tried > MOST_TRIED {
            return None;
        }
        let Some(&fact) = self.free.get(at) else {
            if state.iter().all(|value| matches!(value, 0 | 1)) {
                let mut packed = vec![0; bits::words(state.len())];
                let held = (0..state.len()).filter(|&fact| state[fact] == 1);
                held.for_each(|fact| bits::put(&mut packed, fact));
                self.found.push(packed);
            }
            return (self.found.len() <= MOST_GOALS).then_some(());
        };
        for value in [0, 1] {
            let excludes = |other: &FactId| self.graph.is_exclusive(self.graph.top(), *other, fact);
            if value == 1 && held.iter().any(excludes) {
                continue;
            }
            let row = self.basis.of_pivot(fact.index()).expect("what is free has a vector");
            let mut next = state.to_vec();
            let missing = (value - next[fact.index()]).rem_euclid(MODULUS);
            add_times(&mut next, row, missing);
            if value == 1 {
                held.push(fact);
            }
            let fits = self.choose(at + 1, held, &next);
            if value == 1 {
                held.pop();
            }
            fits?;
        }
        Some(())
    }
}
