//! How many steps are still to come at least, whatever the state: a few facts are needed in any case, and of what brings
//! them no two go into one step.
//!
//! A fact that is needed and does not hold must be brought, so whatever all that brings it needs must hold before, and so
//! on back. The facts counted are chosen once: those that *one hand* brings, a group of operators no two of which go into
//! one step, and each by operators of its own. A step brings one of them at most, and what it brings was needed for
//! nothing else that is missing: so the count sinks by one at most from step to step.

use std::collections::BTreeSet;

use crate::strips::{FactId, OperatorId, Task};
use crate::{bits, units::Gather as _};

pub(super) struct Ahead {
    goal: Vec<FactId>,
    /// For each fact what all that brings it needs; none where nothing does.
    causes: Vec<Option<Vec<FactId>>>,
    counts: Vec<bool>,
    seen: Vec<u32>,
    turn: u32,
    /// Facts looked at so far.
    pub(super) effort: u64,
}

impl Ahead {
    /// `groups` are numbers, the same for operators no two of which go into one step.
    pub(super) fn of(task: &Task, groups: &[usize]) -> Self {
        let mut bringers: Vec<Vec<OperatorId>> = vec![Vec::new(); task.facts.len()];
        for id in task.operator_ids() {
            task.operator(id).add_effects.iter().for_each(|fact| bringers[fact.index()].push(id));
        }
        let common = |bringers: &Vec<OperatorId>| -> Option<Vec<FactId>> {
            let (first, others) = bringers.split_first()?;
            let needs = |id: &OperatorId| &task.operator(*id).preconditions;
            let by_all = |fact: &&FactId| others.iter().all(|id| needs(id).contains(fact));
            Some(needs(first).iter().filter(by_all).copied().collect())
        };
        let mut ahead = Self {
            goal: task.goal.clone(),
            causes: bringers.iter().map(common).collect(),
            counts: vec![false; task.facts.len()],
            seen: vec![0; task.facts.len()],
            turn: 0,
            effort: 0,
        };
        let initially = crate::portfolio::relaxed::initial(task);
        let needed: Vec<FactId> = ahead.missing(&initially).unwrap_or_default();
        let mut best = (0, Vec::new());
        let numbers: BTreeSet<usize> = groups.iter().copied().gather();
        for group in numbers {
            let mut used: BTreeSet<OperatorId> = BTreeSet::new();
            let mut counted = Vec::new();
            // What is needed at first goes before what may be needed later.
            for fact in needed.iter().copied().chain(task.fact_ids()) {
                let by = &bringers[fact.index()];
                let are_own = |id: &OperatorId| groups[id.index()] == group && !used.contains(id);
                if !by.is_empty() && by.iter().all(are_own) {
                    used.extend(by);
                    counted.push(fact);
                }
            }
            let count = needed.iter().filter(|fact| counted.contains(fact)).count();
            if count > best.0 {
                best = (count, counted);
            }
        }
        best.1.into_iter().for_each(|fact| ahead.counts[fact.index()] = true);
        ahead
    }

    /// None where the goal is out of reach.
    pub(super) fn steps(&mut self, state: &[u64]) -> Option<u32> {
        let missing = self.missing(state)?;
        Some(missing.iter().filter(|fact| self.counts[fact.index()]).count() as u32)
    }

    /// Facts that do not hold and must be brought; none where one of them cannot be.
    fn missing(&mut self, state: &[u64]) -> Option<Vec<FactId>> {
        self.turn += 1;
        self.effort += self.goal.len() as u64;
        let mut missing: Vec<FactId> = Vec::new();
        let Self { goal, causes, seen, turn, effort, .. } = self;
        let mut need = |missing: &mut Vec<FactId>, facts: &[FactId]| {
            for &fact in facts {
                let is_new = std::mem::replace(&mut seen[fact.index()], *turn) != *turn;
                if is_new && !bits::has(state, fact.index()) {
                    missing.push(fact);
                }
            }
        };
        need(&mut missing, goal);
        let mut at = 0;
        while let Some(&fact) = missing.get(at) {
            let causes = causes[fact.index()].as_ref()?;
            need(&mut missing, causes);
            *effort += causes.len() as u64;
            at += 1;
        }
        Some(missing)
    }
}
