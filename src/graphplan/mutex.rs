//! Mutual exclusion, as in the paper (A. Blum, M. Furst, 1997, section 2.2): what cannot be done, or hold, at once.
//!
//! Two actions of a level exclude each other when one spoils the other whatever the level, or when what they need
//! excludes each other there. Two facts exclude each other when every way to have the one excludes every way to have
//! the other. "Exclusive" is told soundly and not completely: pairs that are not told may still never meet.

use super::action::Action;
use crate::strips::FactId;

/// Pairs of facts that exclude each other at one level: a symmetric relation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FactMutex {
    facts: usize,
    pairs: Vec<bool>,
}

impl FactMutex {
    pub(super) fn none(facts: usize) -> Self {
        Self { facts, pairs: vec![false; facts * facts] }
    }

    pub(super) fn contains(&self, p: FactId, q: FactId) -> bool {
        self.pairs[p.index() * self.facts + q.index()]
    }

    pub(super) fn insert(&mut self, p: FactId, q: FactId) {
        self.pairs[p.index() * self.facts + q.index()] = true;
        self.pairs[q.index() * self.facts + p.index()] = true;
    }

    pub(super) fn bytes(&self) -> usize {
        self.pairs.len()
    }
}

/// Whether two actions exclude each other above a level of facts with these mutexes.
pub(super) fn are_mutex(a: &Action, b: &Action, below: &FactMutex) -> bool {
    interfere(a, b) || have_competing_needs(a, b, below)
}

/// Inconsistent effects and interference: one deletes what the other adds or needs.
fn interfere(a: &Action, b: &Action) -> bool {
    let spoils = |one: &Action, other: &Action| {
        let uses = |fact| other.preconditions.contains(fact) || other.add_effects.contains(fact);
        one.takes.iter().any(uses)
    };
    spoils(a, b) || spoils(b, a)
}

/// A precondition of the one excludes a precondition of the other.
fn have_competing_needs(a: &Action, b: &Action, below: &FactMutex) -> bool {
    a.preconditions.iter().any(|&p| b.preconditions.iter().any(|&q| below.contains(p, q)))
}
