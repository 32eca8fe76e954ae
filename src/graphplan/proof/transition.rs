//! A step as clauses: how the facts before it, the operators carried out in it and the facts after it hang together.
//!
//! Interference is encoded in linear space: whoever needs a fact without deleting it makes it hold after the
//! step as well, which no deleter of the same step allows; those who both need and delete it are at most one. Who
//! renews a fact leaves it to nobody else: neither to those who need it nor to those who add it.

use super::graph::PlanningGraph;
use super::solver::{Literal, Solver};
use crate::strips::{FactId, OperatorId, Task};

/// The variables of facts, or of operators, by their numbers; none where it is out of reach.
pub(crate) type Variables = [Option<Literal>];

pub(crate) struct Transition<'a> {
    task: &'a Task,
    /// Operators that need, and that delete, each fact.
    users: Vec<Users>,
    added_by: Vec<Vec<OperatorId>>,
}

#[derive(Default, Clone)]
struct Users {
    keepers: Vec<OperatorId>,
    takers: Vec<OperatorId>,
    breakers: Vec<OperatorId>,
    renewers: Vec<OperatorId>,
    /// Who needs or adds a fact that others renew.
    beside_renewers: Vec<OperatorId>,
}

impl<'a> Transition<'a> {
    pub(crate) fn new(task: &'a Task) -> Self {
        let mut users = vec![Users::default(); task.facts.len()];
        let added_by = task.added_by();
        for id in task.operator_ids() {
            let operator = task.operator(id);
            for fact in &operator.preconditions {
                let users = &mut users[fact.index()];
                let taken = operator.del_effects.contains(fact);
                if taken { &mut users.takers } else { &mut users.keepers }.push(id);
            }
            for fact in &operator.del_effects {
                if !operator.preconditions.contains(fact) {
                    users[fact.index()].breakers.push(id);
                }
            }
            operator.renewed.iter().for_each(|fact| users[fact.index()].renewers.push(id));
        }
        for (users, adders) in users.iter_mut().zip(&added_by) {
            if users.renewers.is_empty() {
                continue;
            }
            let mut others: Vec<OperatorId> = users.keepers.iter().chain(adders).copied().collect();
            others.sort_unstable();
            others.dedup();
            // Both are in the order of operators.
            others.retain(|id| users.renewers.binary_search(id).is_err());
            users.beside_renewers = others;
        }
        Self { task, users, added_by }
    }

    /// Says what a step of these operators makes of the facts before it, beside what excludes each other at the levels
    /// before and after it ([`add_mutexes`]): what follows from that is left out.
    pub(crate) fn add(
        &self,
        solver: &mut Solver,
        (graph, step): (&PlanningGraph, usize),
        (before, operators, after): (&Variables, &Variables, &Variables),
    ) {
        for id in self.task.operator_ids() {
            let Some(done) = operators[id.index()] else { continue };
            let operator = self.task.operator(id);
            for fact in &operator.preconditions {
                let holds = before[fact.index()].expect("preconditions come before their operator");
                solver.add_clause(&[!done, holds]);
            }
            for fact in &operator.add_effects {
                let holds = after[fact.index()].expect("effects follow their operator");
                solver.add_clause(&[!done, holds]);
            }
            for fact in &operator.del_effects {
                let excluded = |add: &FactId| graph.is_exclusive(step + 1, *add, *fact);
                if let Some(holds) = after[fact.index()]
                    && !operator.add_effects.iter().any(excluded)
                {
                    solver.add_clause(&[!done, !holds]);
                }
            }
        }
        for fact in self.task.fact_ids() {
            let Some(holds) = after[fact.index()] else { continue };
            let mut clause = vec![!holds];
            clause.extend(before[fact.index()]);
            clause.extend(self.added_by[fact.index()].iter().filter_map(|a| operators[a.index()]));
            solver.add_clause(&clause);
        }
        for fact in self.task.fact_ids() {
            self.add_interference(solver, fact, (graph, step), operators, after);
        }
    }

    fn add_interference(
        &self,
        solver: &mut Solver,
        fact: FactId,
        (graph, step): (&PlanningGraph, usize),
        operators: &Variables,
        after: &Variables,
    ) {
        let Users { keepers, takers, breakers, renewers, beside_renewers } =
            &self.users[fact.index()];
        let present = |ids: &[OperatorId]| -> Vec<Literal> {
            ids.iter().filter_map(|id| operators[id.index()]).collect()
        };
        let renewing = present(renewers);
        if !renewing.is_empty() {
            keep_apart(solver, &renewing, &present(beside_renewers));
            at_most_one(solver, &renewing);
        }
        let together = self.together(takers, (graph, step), operators);
        let (takers, breakers) = (present(takers), present(breakers));
        if takers.is_empty() && breakers.is_empty() {
            return;
        }
        for keeper in present(keepers) {
            let after = after[fact.index()].expect("what is kept may hold");
            solver.add_clause(&[!keeper, after]);
        }
        match together {
            Some(pairs) => pairs.iter().for_each(|(a, b)| solver.add_clause(&[!*a, !*b])),
            None => at_most_one(solver, &takers),
        }
        keep_apart(solver, &breakers, &takers);
    }

    /// Pairs of operators that only what they take keeps apart, not what they need besides or bring about; none where
    /// these are too many to be said one by one.
    fn together(
        &self,
        takers: &[OperatorId],
        (graph, step): (&PlanningGraph, usize),
        operators: &Variables,
    ) -> Option<Vec<(Literal, Literal)>> {
        const MANY: usize = 32;
        let present: Vec<(OperatorId, Literal)> =
            takers.iter().filter_map(|id| Some((*id, operators[id.index()]?))).collect();
        if present.len() > MANY {
            return None;
        }
        let exclude = |level, these: &[FactId], those: &[FactId]| {
            these.iter().any(|a| those.iter().any(|b| graph.is_exclusive(level, *a, *b)))
        };
        let mut together = Vec::new();
        for (at, &(one, a)) in present.iter().enumerate() {
            for &(other, b) in &present[..at] {
                let (one, other) = (self.task.operator(one), self.task.operator(other));
                if !exclude(step + 1, &one.add_effects, &other.add_effects)
                    && !exclude(step, &one.preconditions, &other.preconditions)
                {
                    together.push((a, b));
                }
            }
        }
        (together.len() <= 3 * present.len()).then_some(together)
    }

    /// Of the operators done, those that make the wanted facts hold that did not hold before, and the facts that all
    /// this rests on: what they need, and what did hold.
    pub(crate) fn causes(
        &self,
        wanted: &[FactId],
        held: impl Fn(FactId) -> bool,
        done: impl Fn(OperatorId) -> bool,
    ) -> (Vec<OperatorId>, Vec<FactId>) {
        let (mut chosen, mut needed): (Vec<OperatorId>, Vec<FactId>) = Default::default();
        for &fact in wanted {
            if held(fact) {
                needed.push(fact);
            } else if !chosen.iter().any(|&id| self.task.operator(id).add_effects.contains(&fact)) {
                let cause = self.added_by[fact.index()].iter().copied().find(|&id| done(id));
                chosen.push(cause.expect("a new fact has a cause"));
            }
        }
        needed.extend(chosen.iter().flat_map(|&id| &self.task.operator(id).preconditions));
        needed.sort_unstable();
        needed.dedup();
        chosen.sort_unstable();
        (chosen, needed)
    }
}

/// Says which facts exclude each other at a level.
pub(crate) fn add_mutexes(
    solver: &mut Solver,
    graph: &PlanningGraph,
    level: usize,
    facts: &Variables,
) {
    for (number, one) in facts.iter().enumerate() {
        let (fact, Some(one)) = (FactId(number as u32), *one) else { continue };
        for other in graph.exclusive_with(level, fact) {
            if let (true, Some(other)) = (other < fact, facts[other.index()]) {
                solver.add_clause(&[!one, !other]);
            }
        }
    }
}

/// None of the one beside any of the other.
fn keep_apart(solver: &mut Solver, one: &[Literal], other: &[Literal]) {
    if one.is_empty() || other.is_empty() {
        return;
    }
    let barred = solver.new_variable();
    one.iter().for_each(|&done| solver.add_clause(&[!done, barred]));
    other.iter().for_each(|&done| solver.add_clause(&[!done, !barred]));
}

/// Pairs while they are few, a chain of "one of those so far" beyond.
fn at_most_one(solver: &mut Solver, literals: &[Literal]) {
    const FEW: usize = 6;
    if literals.len() <= FEW {
        for (at, &a) in literals.iter().enumerate() {
            for &b in &literals[..at] {
                solver.add_clause(&[!a, !b]);
            }
        }
        return;
    }
    let mut so_far = literals[0];
    for &next in &literals[1..] {
        solver.add_clause(&[!so_far, !next]);
        let either = solver.new_variable();
        solver.add_clause(&[!so_far, either]);
        solver.add_clause(&[!next, either]);
        so_far = either;
    }
}
