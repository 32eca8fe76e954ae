//! The planning graph, as in the paper (A. Blum, M. Furst, 1997, section 2): levels of facts and of actions by turns.
//!
//! ```text
//!  facts 0        actions 0        facts 1        actions 1    ...
//!  initial state  whose needs are  what they add  ...
//!                 there, unmarked
//! ```
//!
//! A *no-op* carries a fact from one level to the next. Facts, actions and non-mutexes only grow, so at some level the
//! graph has *leveled off*: every later one is the same. Nothing here is made quick; [`crate::proof`] is.

use super::action::Action;
use super::mutex::{FactMutex, are_mutex};
use crate::strips::{FactId, Task};
use crate::{Limit, Limits, NoPlanReason};

/// What may hold after so many steps.
#[derive(Debug, Clone, PartialEq, Eq)]
struct FactLevel {
    may_hold: Vec<bool>,
    mutex: FactMutex,
}

/// Actions, by number, that may be carried out in a step.
type ActionLevel = Vec<usize>;

#[derive(Debug)]
pub(super) struct PlanningGraph {
    actions: Vec<Action>,
    fact_levels: Vec<FactLevel>,
    action_levels: Vec<ActionLevel>,
}

impl PlanningGraph {
    /// The graph of level 0: the initial state.
    pub(super) fn new(task: &Task) -> Self {
        let operators = task.operator_ids().map(|id| {
            let operator = task.operator(id);
            Action {
                operator: Some(id),
                preconditions: operator.preconditions.clone(),
                add_effects: operator.add_effects.clone(),
                takes: operator.takes().collect(),
            }
        });
        let no_ops = task.fact_ids().map(|fact| Action {
            operator: None,
            preconditions: vec![fact],
            add_effects: vec![fact],
            takes: Vec::new(),
        });
        // No-ops first: what holds already is best kept.
        let actions = no_ops.chain(operators).collect();
        let mut may_hold = vec![false; task.facts.len()];
        task.init.iter().for_each(|fact| may_hold[fact.index()] = true);
        let initial = FactLevel { may_hold, mutex: FactMutex::none(task.facts.len()) };
        Self { actions, fact_levels: vec![initial], action_levels: Vec::new() }
    }

    /// The last level of facts.
    pub(super) fn top(&self) -> usize {
        self.action_levels.len()
    }

    pub(super) fn action(&self, number: usize) -> &Action {
        &self.actions[number]
    }

    /// Adds a level of actions and a level of facts.
    pub(super) fn expand(&mut self, limits: &Limits) -> Result<(), Limit> {
        let below = &self.fact_levels[self.top()];
        let is_possible = |facts: &[FactId]| are_possible(below, facts);
        let level: ActionLevel = (0..self.actions.len())
            .filter(|&number| is_possible(&self.actions[number].preconditions))
            .collect();
        let facts = below.may_hold.len();
        let mut ways = vec![Vec::new(); facts];
        for &number in &level {
            let adds = &self.actions[number].add_effects;
            adds.iter().for_each(|fact| ways[fact.index()].push(number));
        }
        let excluded = |a: usize, b: usize| {
            a != b && are_mutex(&self.actions[a], &self.actions[b], &below.mutex)
        };
        let mut mutex = FactMutex::none(facts);
        for p in 0..facts {
            limits.check(self.bytes())?;
            for q in (0..p).filter(|&q| !ways[p].is_empty() && !ways[q].is_empty()) {
                if ways[p].iter().all(|&a| ways[q].iter().all(|&b| excluded(a, b))) {
                    mutex.insert(FactId(p as u32), FactId(q as u32));
                }
            }
        }
        let may_hold = ways.iter().map(|ways| !ways.is_empty()).collect();
        self.action_levels.push(level);
        self.fact_levels.push(FactLevel { may_hold, mutex });
        Ok(())
    }

    /// Whether all facts may hold at the last level, as far as pairs tell.
    pub(super) fn is_possible(&self, facts: &[FactId]) -> bool {
        are_possible(&self.fact_levels[self.top()], facts)
    }

    /// The first level from which on nothing changes, once the last two are equal.
    pub(super) fn leveled_off_at(&self) -> Option<usize> {
        self.fact_levels.windows(2).position(|pair| pair[0] == pair[1])
    }

    /// Actions of the step before `level` that add a fact.
    pub(super) fn ways(&self, level: usize, fact: FactId) -> impl Iterator<Item = usize> {
        let adds = move |&number: &usize| self.actions[number].add_effects.contains(&fact);
        self.action_levels[level - 1].iter().copied().filter(adds)
    }

    /// Whether two actions exclude each other in the step before `level`.
    pub(super) fn are_mutex(&self, level: usize, a: usize, b: usize) -> bool {
        a != b && are_mutex(&self.actions[a], &self.actions[b], &self.fact_levels[level - 1].mutex)
    }

    /// Why facts are not possible together at the last level.
    pub(super) fn conflict_of(&self, facts: &[FactId]) -> NoPlanReason {
        let FactLevel { may_hold, mutex } = &self.fact_levels[self.top()];
        let missing: Vec<FactId> = facts.iter().copied().filter(|f| !may_hold[f.index()]).collect();
        if !missing.is_empty() {
            return NoPlanReason::Unreachable(missing);
        }
        let pairs = facts.iter().enumerate().flat_map(|(at, &p)| {
            facts[at + 1..].iter().filter(move |&&q| mutex.contains(p, q)).map(move |&q| (p, q))
        });
        NoPlanReason::Exclusive(pairs.collect())
    }

    /// Memory held, near enough to honour a limit.
    pub(super) fn bytes(&self) -> usize {
        let levels = self.fact_levels.iter().map(|level| level.mutex.bytes()).sum::<usize>();
        levels + self.action_levels.iter().map(|level| level.len() * 8).sum::<usize>()
    }
}

fn are_possible(level: &FactLevel, facts: &[FactId]) -> bool {
    let hold = facts.iter().all(|fact| level.may_hold[fact.index()]);
    hold && facts.iter().all(|&p| facts.iter().all(|&q| !level.mutex.contains(p, q)))
}
