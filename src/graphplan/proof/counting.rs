//! Counting for the solver: how much is still to be done, and how little of it can be done at once.
//!
//! Clauses alone make the solver prove again and again that a hand cannot do thirteen things in twelve steps: the
//! pigeonhole principle, for which resolution needs exponentially long proofs. So the [landmarks](super::cuts)
//! not yet done are added up at each level (a totalizer, O. Bailleux, Y. Boufkhad, 2003). Their operators fall into
//! few groups of which each carries out one a step, as one hand or one truck does; hence no more of them may be left
//! at a level than the groups can do in the steps that remain.

use super::graph::{ActionId, PlanningGraph};
use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::cuts::disjoint_landmarks;
use super::solver::{Literal, Solver};
use crate::strips::{OperatorId, Task};

/// Counting pays when so large a share of what could be done at all has to be done.
const SHARE: (usize, usize) = (3, 5);

/// What landmarks, pairs of operators and clauses may cost.
const MOST_WORK: usize = 1 << 24;
const MOST_PAIRS: usize = 1 << 21;
const MOST_CLAUSES: usize = 1 << 21;

pub(crate) struct Counter {
    /// Sets of operators, one of each of which every plan carries out.
    landmarks: Vec<Vec<OperatorId>>,
    /// How many of them a step can do.
    at_once: usize,
    /// Per level, the variable that says that a landmark is not yet done.
    undone: Vec<Vec<Literal>>,
    /// Per level, from one on, the variable that says that so many are not yet done.
    left: Vec<Vec<Literal>>,
}

impl Counter {
    /// None where counting would not pay. The graph has leveled off: what excludes each other does so for good.
    pub(crate) fn new(task: &Task, graph: &PlanningGraph) -> Option<Self> {
        let landmarks = disjoint_landmarks(task, MOST_WORK);
        let cliques = cliques(graph, &landmarks)?;
        let mut best: Option<(usize, Vec<usize>)> = None;
        let mut chosen = vec![false; cliques.count];
        for at_once in 1..=cliques.count {
            let covered = |chosen: &[bool], more: Option<usize>| -> Vec<usize> {
                let own = |&id: &OperatorId| {
                    let clique = cliques.of[&id];
                    chosen[clique] || Some(clique) == more
                };
                (0..landmarks.len()).filter(|&l| landmarks[l].iter().all(own)).collect()
            };
            let next = (0..cliques.count)
                .filter(|&clique| !chosen[clique])
                .max_by_key(|&clique| (covered(&chosen, Some(clique)).len(), Reverse(clique)))?;
            chosen[next] = true;
            let covered = covered(&chosen, None);
            // More for each that a step can do at once.
            let gains = best
                .as_ref()
                .is_none_or(|(fewer, known)| covered.len() * fewer > known.len() * at_once);
            if gains {
                best = Some((at_once, covered));
            }
        }
        let (at_once, covered) = best?;
        let pays = covered.len() * SHARE.1 >= at_once * graph.top() * SHARE.0;
        let clauses = covered.len() * covered.len() * 2 * graph.top();
        if !pays || clauses > MOST_CLAUSES {
            return None;
        }
        let landmarks = covered.into_iter().map(|l| landmarks[l].clone()).collect();
        Some(Self { landmarks, at_once, undone: Vec::new(), left: Vec::new() })
    }

    /// Adds the levels that the formula has and the count has not; `operators` are the variables of each step.
    pub(crate) fn reach(&mut self, solver: &mut Solver, operators: &[Vec<Option<Literal>>]) {
        while self.undone.len() <= operators.len() {
            let undone: Vec<Literal> =
                self.landmarks.iter().map(|_| solver.new_variable()).collect();
            match self.undone.last() {
                None => undone.iter().for_each(|&undone| solver.add_clause(&[undone])),
                Some(before) => {
                    let step = &operators[self.undone.len() - 1];
                    for ((landmark, &before), &after) in
                        self.landmarks.iter().zip(before).zip(&undone)
                    {
                        let mut stays = vec![!before, after];
                        for done in landmark.iter().filter_map(|id| step[id.index()]) {
                            solver.add_clause(&[!done, !after]);
                            stays.push(done);
                        }
                        solver.add_clause(&stays);
                        solver.add_clause(&[!after, before]);
                    }
                }
            }
            let left = total(solver, &undone);
            if let Some(before) = self.left.last() {
                for (many, &fewer) in before[self.at_once.min(before.len())..].iter().zip(&left) {
                    solver.add_clause(&[!*many, fewer]);
                }
            }
            self.undone.push(undone);
            self.left.push(left);
        }
    }

    /// Under `horizon`, no more is left at any level than can be done before `length` steps are over.
    pub(crate) fn bound(&self, solver: &mut Solver, horizon: Literal, length: usize) {
        for (level, left) in self.left[..=length].iter().enumerate() {
            if let Some(&too_many) = left.get(self.at_once * (length - level)) {
                solver.add_clause(&[!horizon, !too_many]);
            }
        }
    }
}

/// From one on, "so many of these are true", in both directions.
fn total(solver: &mut Solver, of: &[Literal]) -> Vec<Literal> {
    if of.len() <= 1 {
        return of.to_vec();
    }
    let (a, b) = of.split_at(of.len() / 2);
    let (a, b) = (total(solver, a), total(solver, b));
    let sum: Vec<Literal> = of.iter().map(|_| solver.new_variable()).collect();
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            if i + j > 0 {
                let because = [i.checked_sub(1).map(|i| !a[i]), j.checked_sub(1).map(|j| !b[j])];
                let clause: Vec<Literal> =
                    because.into_iter().flatten().chain([sum[i + j - 1]]).collect();
                solver.add_clause(&clause);
            }
            if i + j < sum.len() {
                let because = [a.get(i).copied(), b.get(j).copied()];
                let clause: Vec<Literal> =
                    because.into_iter().flatten().chain([!sum[i + j]]).collect();
                solver.add_clause(&clause);
            }
        }
    }
    sum
}

struct Cliques {
    /// The clique of each operator of a landmark.
    of: BTreeMap<OperatorId, usize>,
    count: usize,
}

/// Operators of landmarks in groups of which no two are ever carried out in one step, as few as found by putting each
/// into the first that it fits; none when there are too many pairs to look at.
fn cliques(graph: &PlanningGraph, landmarks: &[Vec<OperatorId>]) -> Option<Cliques> {
    let mut members: Vec<Vec<OperatorId>> = Vec::new();
    let mut of = BTreeMap::new();
    let mut pairs = 0;
    for &id in landmarks.iter().flatten() {
        let action = ActionId(id.0);
        let mut fits = |others: &Vec<OperatorId>| {
            others.iter().all(|other| {
                pairs += 1;
                graph.is_mutex(graph.top(), action, ActionId(other.0))
            })
        };
        let clique = members.iter().position(&mut fits).unwrap_or_else(|| {
            members.push(Vec::new());
            members.len() - 1
        });
        members[clique].push(id);
        of.insert(id, clique);
        if pairs > MOST_PAIRS {
            return None;
        }
    }
    Some(Cliques { of, count: members.len() })
}
