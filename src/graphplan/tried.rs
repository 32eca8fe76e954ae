//! What a search tried before it was given up, and how far it came.

use std::sync::{Arc, Mutex, PoisonError};

use crate::{Limits, Outcome};

/// A way to a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// The rules were made into ground actions.
    Grounding,
    /// GraphPlan as published.
    Graph,
    /// The proof of the fewest steps: extraction, solver and induction by turns.
    Proof,
    /// Search forward from what holds at first, by relaxed plans, landmarks and width.
    Forward,
}

/// A way that was tried, and how far it went in all its turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attempt {
    pub way: Way,
    pub times: usize,
    /// The most levels of the planning graph.
    pub levels: usize,
    /// Sets of goals, or states, that were looked at.
    pub nodes: u64,
    /// In variables set by the solver and what takes as long; of forward search in operators of relaxed plans.
    pub effort: u64,
}

impl Attempt {
    pub(crate) fn new(way: Way, levels: usize, nodes: u64, effort: u64) -> Self {
        Self { way, times: 1, levels, nodes, effort }
    }
}

/// Where searches note what they tried; some run in threads of their own.
#[derive(Debug, Clone, Default)]
pub struct Log(Arc<Mutex<Vec<Attempt>>>);

impl Log {
    fn attempts(&self) -> Vec<Attempt> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Limits {
    pub(crate) fn note(&self, attempt: Attempt) {
        let Some(Log(log)) = &self.log else { return };
        let mut log = log.lock().unwrap_or_else(PoisonError::into_inner);
        match log.iter_mut().find(|known| known.way == attempt.way) {
            Some(known) => {
                known.times += attempt.times;
                known.levels = known.levels.max(attempt.levels);
                known.nodes += attempt.nodes;
                known.effort += attempt.effort;
            }
            None => log.push(attempt),
        }
    }
}

/// A search that tells, if it is given up, what was tried.
pub(crate) fn telling<T>(
    limits: &Limits,
    search: impl FnOnce(&Limits) -> T,
    outcome: impl FnOnce(&mut T) -> &mut Outcome,
) -> T {
    let log = limits.log.clone().unwrap_or_default();
    let mut found = search(&Limits { log: Some(log.clone()), ..limits.clone() });
    if let Outcome::LimitReached(known) = outcome(&mut found) {
        known.tried = log.attempts();
    }
    found
}
