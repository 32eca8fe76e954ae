//! Operators undone, and the states that have the goal: what a search from the goal back needs.
//!
//! An operator can be undone where all that it deletes must have held before, and what it adds cannot have: then what was
//! before it follows from what is after it. Then its effects are a vector, too, the same wherever it is carried out; what
//! is reached differs from what holds at first by a sum of such vectors (the state equation of a Petri net: T. Murata,
//! 1989). With what the goal excludes that leaves a few states that have it, often one.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

use super::steps::{Claims, Steps, brought_by, rivals};
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
    let possible = |operator: &&Operator| is_possible(operator, graph);
    let mut implications = Implications::new(task, graph);
    let undone = task.operators.iter().filter(possible).map(|o| undone(o, &mut implications));
    let undone: Vec<Operator> = undone.collect::<Option<_>>()?;
    let rivals_there: Vec<Claims> = task.operators.iter().map(claims).collect();
    let rivals_back: Vec<Claims> = task.operators.iter().filter(possible).map(claims).collect();
    let there = Steps::of_all(Cow::Borrowed(task), rivals(&rivals_there, task.facts.len())?);
    let back = Task { operators: undone, ..task.clone() };
    let exclusive = task.fact_ids().map(|fact| {
        let mut row = vec![0; bits::words(task.facts.len())].into_boxed_slice();
        graph
            .exclusive_with(graph.top(), fact)
            .for_each(|other| bits::put(&mut row, other.index()));
        row
    });
    let back = Steps::of_all(Cow::Owned(back), rivals(&rivals_back, task.facts.len())?);
    Some((there, back.keeping_apart(exclusive.collect())))
}

fn is_possible(operator: &Operator, graph: &PlanningGraph) -> bool {
    graph.is_possible(&operator.preconditions)
}

/// What is brought does not hold before, so nobody else in the step uses it; nor does anybody else delete what one deletes.
fn claims(operator: &Operator) -> Claims {
    let Operator { preconditions, add_effects, del_effects, .. } = operator;
    Claims {
        uses: preconditions.iter().chain(add_effects).chain(del_effects).copied().collect(),
        takes: operator.takes().chain(brought_by(operator)).collect(),
    }
}

/// None where it cannot be.
fn undone(operator: &Operator, implications: &mut Implications<'_>) -> Option<Operator> {
    let Operator { preconditions, del_effects, .. } = operator;
    let brought: Vec<FactId> = brought_by(operator).collect();
    let is_new = |fact: &FactId| implications.excludes_any(preconditions, *fact);
    if brought.is_empty()
        || !brought.iter().all(is_new)
        || !del_effects.iter().all(|&fact| implications.imply(preconditions, fact))
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

/// Which facts always hold beside others.
struct Implications<'a> {
    task: &'a Task,
    graph: &'a PlanningGraph,
    added_by: Vec<Vec<OperatorId>>,
    deleted_by: Vec<Vec<OperatorId>>,
    /// Of each fact that was asked for, those that imply it.
    known: HashMap<FactId, BTreeSet<FactId>>,
}

impl<'a> Implications<'a> {
    fn new(task: &'a Task, graph: &'a PlanningGraph) -> Self {
        let (added_by, deleted_by) = (task.added_by(), task.deleted_by());
        Self { task, graph, added_by, deleted_by, known: HashMap::new() }
    }

    fn excludes_any(&self, facts: &[FactId], other: FactId) -> bool {
        facts.iter().any(|&fact| self.graph.is_exclusive(self.graph.top(), fact, other))
    }

    /// Whether a fact holds wherever all these do.
    fn imply(&mut self, facts: &[FactId], fact: FactId) -> bool {
        facts.contains(&fact) || {
            if !self.known.contains_key(&fact) {
                self.known.insert(fact, self.implying(fact));
            }
            facts.iter().any(|need| self.known[&fact].contains(need))
        }
    }

    /// Beside these a fact holds at first, and every operator leaves it so.
    fn implying(&self, fact: FactId) -> BTreeSet<FactId> {
        let holds_first = self.task.init.contains(&fact);
        let may_imply = |other: &FactId| {
            !self.excludes_any(&[*other], fact) && (holds_first || !self.task.init.contains(other))
        };
        let mut implying: BTreeSet<FactId> = self.task.fact_ids().filter(may_imply).collect();
        loop {
            let is_broken = |other: &&FactId| !self.is_kept(**other, fact, &implying);
            let broken: Vec<FactId> = implying.iter().filter(is_broken).copied().collect();
            if broken.is_empty() {
                return implying;
            }
            broken.iter().for_each(|other| _ = implying.remove(other));
        }
    }

    /// Whether a fact holds beside another after each operator, if it does beside all these before.
    fn is_kept(&self, other: FactId, fact: FactId, implying: &BTreeSet<FactId>) -> bool {
        let held =
            |operator: &Operator| operator.preconditions.iter().any(|f| implying.contains(f));
        let is_added_with = |&id: &OperatorId| {
            let operator = self.task.operator(id);
            operator.add_effects.contains(&fact)
                || held(operator) && !operator.del_effects.contains(&fact)
        };
        let is_deleted_with = |&id: &OperatorId| {
            let operator = self.task.operator(id);
            operator.del_effects.contains(&other)
                || self.excludes_any(&operator.preconditions, other)
        };
        other == fact
            || self.added_by[other.index()].iter().all(is_added_with)
                && self.deleted_by[fact.index()].iter().all(is_deleted_with)
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
