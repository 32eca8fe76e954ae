//! Planning anew after something assumed turned out false, with what was learned the first time (SPEC P2).
//!
//! Take facts of the initial state and operators away, and nothing becomes possible that was not: a plan for the
//! smaller task is a plan for the larger. So everything that was proven impossible stays so – fact levels and
//! mutexes are lower bounds, no-goods hold, and fewer steps than before will not do. Where a fact is asked for
//! negatively its withdrawal adds the complement, and nothing learned is sound; then planning starts anew. So it
//! does wherever the new task is not plainly a part of the old.
//!
//! The robot may have begun to carry out its plan. What is out of reach within `n` steps from where it was is out of
//! reach within `n - k` from where `k` steps took it: [`Learned::after`] shifts all that was learned by so much.

use std::collections::HashMap;
use std::sync::Arc;

use super::graph::PlanningGraph;
use crate::strips::{Fact, FactId, Operator, OperatorId, Task};

/// What planning a task has taught.
#[derive(Debug)]
pub struct Learned {
    pub(crate) task: Task,
    pub(crate) graph: PlanningGraph,
    /// Sets of facts with the level up to which they are out of reach together.
    pub(crate) no_goods: Vec<(Vec<FactId>, u32)>,
    /// Fewer steps than these will not do.
    pub(crate) fewest_steps: usize,
    /// What held when the steps counted by `done` were carried out.
    pub(crate) state: Vec<FactId>,
    /// Steps carried out since.
    pub(crate) done: usize,
}

/// What holds of a task because it held of one that it is a part of.
pub(crate) struct Inherited<'a> {
    learned: &'a Learned,
    /// The old fact for each new one.
    old: Vec<FactId>,
    /// The new fact for each old one, where there is one.
    new: Vec<Option<FactId>>,
    /// What of the old task holds where planning begins anew, and after how many steps.
    state: Vec<FactId>,
    done: usize,
}

impl Learned {
    /// The same, after some steps were carried out. None when they cannot be, by the task learned from; a step
    /// may be given in part.
    #[must_use]
    pub fn after(mut self, steps: &[Vec<OperatorId>]) -> Option<Self> {
        for step in steps {
            let needs = |id: &OperatorId| &self.task.operator(*id).preconditions;
            if !step.iter().flat_map(needs).all(|fact| self.state.contains(fact)) {
                return None;
            }
            for &id in step {
                let deleted = &self.task.operator(id).del_effects;
                self.state.retain(|fact| !deleted.contains(fact));
            }
            for &id in step {
                self.state.extend(&self.task.operator(id).add_effects);
            }
            self.state.sort_unstable();
            self.state.dedup();
            self.done += 1;
        }
        Some(self)
    }

    /// Whether what was learned serves for this task.
    #[must_use]
    pub fn serves(&self, task: &Task) -> bool {
        self.about(task).is_some()
    }

    /// None when the task is not plainly a part of the one that was learned from.
    pub(crate) fn about(&self, task: &Task) -> Option<Inherited<'_>> {
        let facts: HashMap<Key<'_>, FactId> =
            self.task.fact_ids().map(|id| (key(self.task.fact(id)), id)).collect();
        let old: Vec<FactId> =
            task.facts.iter().map(|fact| facts.get(&key(fact)).copied()).collect::<Option<_>>()?;
        let mut new = vec![None; self.task.facts.len()];
        for (number, fact) in old.iter().enumerate() {
            new[fact.index()] = Some(FactId(number as u32));
        }
        let (state, done) = (self.state.clone(), self.done);
        let mut inherited = Inherited { learned: self, old, new, state, done };
        let started = inherited.begins_at(task, &inherited.state) || inherited.step_further(task);
        (started && inherited.is_part(task)).then_some(inherited)
    }
}

/// What a fact says.
type Key<'a> = (&'a Arc<str>, &'a [Arc<str>], bool);

fn key(fact: &Fact) -> Key<'_> {
    (&fact.predicate, &fact.args, fact.negated)
}

impl Inherited<'_> {
    /// Fewer steps than these will not do.
    pub(crate) fn fewest_steps(&self) -> usize {
        self.learned.fewest_steps.saturating_sub(self.done)
    }

    /// Whether two new facts are known to exclude each other at a level.
    pub(crate) fn is_exclusive(&self, level: usize, a: FactId, b: FactId) -> bool {
        let graph = &self.learned.graph;
        let level = level + self.done;
        (level <= graph.top() || graph.leveled_off_at().is_some())
            && graph.is_exclusive(level, self.old[a.index()], self.old[b.index()])
    }

    /// No-goods of the old task in terms of the new; those about facts that it lacks are left behind.
    pub(crate) fn no_goods(&self) -> impl Iterator<Item = (Vec<FactId>, u32)> {
        self.learned.no_goods.iter().filter_map(|(facts, level)| {
            let level = level.checked_sub(self.done as u32).filter(|&level| level > 0)?;
            let mut facts: Vec<FactId> =
                facts.iter().map(|fact| self.new[fact.index()]).collect::<Option<_>>()?;
            facts.sort_unstable();
            Some((facts, level))
        })
    }

    /// Whether every initial fact of the new task holds in a state of the old.
    fn begins_at(&self, task: &Task, state: &[FactId]) -> bool {
        task.init.iter().all(|fact| state.contains(&self.old[fact.index()]))
    }

    /// A step that failed may have been carried out in part: the robot drove about in search of a thing, say. What
    /// an operator could have come to is as good as what was planned, one step later.
    fn step_further(&mut self, task: &Task) -> bool {
        let after = |operator: &Operator| {
            let left = self.state.iter().filter(|fact| !operator.del_effects.contains(fact));
            left.chain(&operator.add_effects).copied().collect::<Vec<FactId>>()
        };
        let possible = |operator: &&Operator| {
            operator.preconditions.iter().all(|fact| self.state.contains(fact))
        };
        let found = self
            .learned
            .task
            .operators
            .iter()
            .filter(possible)
            .map(after)
            .find(|state| self.begins_at(task, state));
        let Some(state) = found else { return false };
        self.state = state;
        self.done += 1;
        true
    }

    /// Every operator was an operator, and what grounding dropped from it makes no difference: needs that always
    /// hold, effects that nobody minds.
    fn is_part(&self, task: &Task) -> bool {
        let whole = &self.learned.task;
        let operators: HashMap<(&Arc<str>, &[Arc<str>]), &Operator> =
            whole.operators.iter().map(|o| ((&o.name, o.args.as_slice()), o)).collect();
        let pairs: Option<Vec<(&Operator, &Operator)>> = task
            .operators
            .iter()
            .map(|o| Some((o, *operators.get(&(&o.name, o.args.as_slice()))?)))
            .collect();
        let Some(pairs) = pairs else { return false };
        // What operators of the new task need, add and delete among the facts that it lacks.
        let lacking = |fact: &&FactId| self.new[fact.index()].is_none();
        let mut users = vec![0_usize; whole.facts.len()];
        let (mut deleted, mut renewed) =
            (vec![false; whole.facts.len()], vec![false; whole.facts.len()]);
        for (_, o) in &pairs {
            let needs_only = o.preconditions.iter().filter(|fact| !o.add_effects.contains(fact));
            let uses = needs_only.chain(&o.add_effects).filter(lacking);
            uses.for_each(|fact| users[fact.index()] += 1);
            o.del_effects.iter().filter(lacking).for_each(|fact| deleted[fact.index()] = true);
            o.renewed.iter().filter(lacking).for_each(|fact| renewed[fact.index()] = true);
        }
        let interferes =
            |fact: usize| deleted[fact] && users[fact] > 0 || renewed[fact] && users[fact] > 1;
        let harmless = !(0..whole.facts.len()).any(interferes);
        let always = |fact: &FactId| self.state.contains(fact) && !deleted[fact.index()];
        let same = |new: &[FactId], old: &[FactId]| {
            let mut kept: Vec<FactId> =
                old.iter().filter_map(|fact| self.new[fact.index()]).collect();
            kept.sort_unstable();
            kept == new
        };
        harmless
            && pairs.iter().all(|(new, old)| {
                same(&new.preconditions, &old.preconditions)
                    && same(&new.add_effects, &old.add_effects)
                    && same(&new.del_effects, &old.del_effects)
                    && same(&new.renewed, &old.renewed)
                    && old.preconditions.iter().filter(lacking).all(always)
            })
            && self.keeps_goal(task, always)
    }

    fn keeps_goal(&self, task: &Task, always: impl Fn(&FactId) -> bool) -> bool {
        let whole = &self.learned.task;
        whole.goal.iter().all(|fact| match self.new[fact.index()] {
            Some(fact) => task.goal.contains(&fact),
            None => always(fact),
        })
    }
}
