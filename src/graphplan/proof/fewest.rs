//! Fewer actions in as many steps: the solver is asked again with a bound on what the actions cost together.
//!
//! Operators of a step that exclude each other through a fact that they all need and delete (a hand, a truck's
//! place) are counted as one, so that the sum stays small: "something of this group is done" is a variable,
//! and a totalizer (O. Bailleux, Y. Boufkhad, 2003; weights after S. Joshi, R. Martins, V. Manquinho, 2015) adds up
//! the variables. The bound sinks below each plan found until the solver refutes it or the effort is used up.

use std::cmp::Reverse;
use std::collections::{BTreeMap, VecDeque};

use super::graph::PlanningGraph;
use super::sat::{Encoding, Verdict};
use super::solver::{Literal, Solver};
use crate::plan::Plan;
use crate::strips::{FactId, OperatorId, Task};
use crate::units::InOrder as _;
use crate::{Limit, Limits};

/// A counter with more clauses than this costs more than it saves.
const MOST_CLAUSES: usize = 1 << 19;

/// Each bound gets such a part of the effort at most: where there is a better plan it is mostly found soon, and most of
/// the effort would go into the last bound, which there is none for.
const SHARE: u64 = 2;

/// What an operator adds to a plan: its cost where costs differ, else one.
fn weight(task: &Task, id: OperatorId) -> u64 {
    if is_priced(task) { u64::from(task.operator(id).cost) } else { 1 }
}

fn is_priced(task: &Task) -> bool {
    task.operators.windows(2).any(|pair| pair[0].cost != pair[1].cost)
}

fn weight_of(task: &Task, plan: &Plan) -> u64 {
    if is_priced(task) { plan.cost(task) } else { plan.action_count() as u64 }
}

/// A plan of as many steps that costs no more, as little as so many conflicts of the solver allow.
pub(crate) fn fewest(
    task: &Task,
    graph: &PlanningGraph,
    encoding: &mut Encoding<'_>,
    mut plan: Plan,
    limits: &Limits,
) -> Plan {
    // What was found stands, whatever ends the improvement.
    let _ = improve(task, graph, encoding, &mut plan, limits);
    plan
}

fn improve(
    task: &Task,
    graph: &PlanningGraph,
    encoding: &mut Encoding<'_>,
    plan: &mut Plan,
    limits: &Limits,
) -> Result<(), Limit> {
    // One action a step is as few as there can be.
    if limits.fewer_actions == 0 || !is_priced(task) && plan.action_count() <= plan.steps.len() {
        return Ok(());
    }
    encoding.reach(graph, limits)?;
    let Some(sums) = sums(task, graph, encoding, weight_of(task, plan)) else { return Ok(()) };
    let until = encoding.conflicts() + limits.fewer_actions;
    while encoding.conflicts() < until {
        let best = weight_of(task, plan);
        let bound: Vec<Literal> = sums.range(best..).map(|(_, &reached)| !reached).collect();
        let allowed = (until - encoding.conflicts()).min(limits.fewer_actions.div_ceil(SHARE));
        let Verdict::Plan(mut better) = encoding.extract_within(graph, &bound, allowed, limits)?
        else {
            return Ok(());
        };
        crate::portfolio::parallel::drop_needless(task, &mut better.steps);
        if weight_of(task, &better) >= best {
            return Ok(());
        }
        *plan = better;
    }
    Ok(())
}

/// Variables that are true when at least that much is spent, for all sums that can come up; sums of `most` and
/// more are one.
type Sums = BTreeMap<u64, Literal>;

fn sums(
    task: &Task,
    graph: &PlanningGraph,
    encoding: &mut Encoding<'_>,
    most: u64,
) -> Option<Sums> {
    let groups = groups(task, graph);
    let group_count = groups.iter().max().map_or(0, |most| most + 1);
    let mut parts: VecDeque<Sums> = VecDeque::new();
    for step in 0..graph.top() {
        let mut members: Vec<BTreeMap<u64, Vec<Literal>>> = vec![BTreeMap::new(); group_count];
        for id in task.operator_ids() {
            let weight = weight(task, id).min(most);
            if let (Some(done), true) = (encoding.operator(graph, step, id), weight > 0) {
                members[groups[id.index()]].entry(weight).or_default().push(done);
            }
        }
        let solver = encoding.solver();
        for by_weight in members.into_iter().filter(|members| !members.is_empty()) {
            let mut part = Sums::new();
            for (weight, done) in by_weight {
                let any = solver.new_variable();
                done.into_iter().for_each(|done| solver.add_clause(&[!done, any]));
                part.insert(weight, any);
            }
            parts.push_back(part);
        }
    }
    let mut clauses = 0;
    let solver = encoding.solver();
    while parts.len() > 1 {
        let (a, b) = (parts.pop_front()?, parts.pop_front()?);
        clauses += (a.len() + 1) * (b.len() + 1);
        if clauses > MOST_CLAUSES {
            return None;
        }
        parts.push_back(added(solver, &a, &b, most));
    }
    parts.pop_front()
}

fn added(solver: &mut Solver, a: &Sums, b: &Sums, most: u64) -> Sums {
    let mut sums = Sums::new();
    let mut clauses: Vec<Vec<Literal>> = Vec::new();
    let mut reach = |solver: &mut Solver, sum: u64, because: &[Literal]| {
        let reached = *sums.entry(sum.min(most)).or_insert_with(|| solver.new_variable());
        clauses.push(because.iter().map(|&literal| !literal).chain([reached]).collect());
    };
    for (&x, &left) in a {
        reach(solver, x, &[left]);
        b.iter().for_each(|(&y, &right)| reach(solver, x + y, &[left, right]));
    }
    b.iter().for_each(|(&y, &right)| reach(solver, y, &[right]));
    clauses.iter().for_each(|clause| solver.add_clause(clause));
    sums
}

/// For each operator its group; no two of a group are ever carried out in one step. Facts that exclude each other
/// make a group of all operators that use one of them up.
pub(super) fn groups(task: &Task, graph: &PlanningGraph) -> Vec<usize> {
    let mut takers: Vec<Vec<OperatorId>> = vec![Vec::new(); task.facts.len()];
    for id in task.operator_ids() {
        let operator = task.operator(id);
        let taken = operator.preconditions.iter().filter(|f| operator.del_effects.contains(f));
        taken.for_each(|fact| takers[fact.index()].push(id));
    }
    let mut facts: Vec<FactId> =
        task.fact_ids().filter(|fact| !takers[fact.index()].is_empty()).collect();
    facts.order_by_key(|fact| (Reverse(takers[fact.index()].len()), *fact));
    let mut cliques: Vec<Vec<FactId>> = Vec::new();
    for fact in facts {
        let fits = |clique: &&mut Vec<FactId>| {
            clique.iter().all(|&other| graph.is_exclusive(graph.top(), fact, other))
        };
        match cliques.iter_mut().find(fits) {
            Some(clique) => clique.push(fact),
            None => cliques.push(vec![fact]),
        }
    }
    cliques.order_by_key(|clique| {
        Reverse(clique.iter().map(|fact| takers[fact.index()].len()).sum::<usize>())
    });
    let mut group = vec![usize::MAX; task.operators.len()];
    for (number, clique) in cliques.iter().enumerate() {
        for id in clique.iter().flat_map(|fact| &takers[fact.index()]) {
            let own = &mut group[id.index()];
            *own = number.min(*own);
        }
    }
    let alone = group.iter_mut().filter(|own| **own == usize::MAX);
    alone.zip(cliques.len()..).for_each(|(own, next)| *own = next);
    group
}
