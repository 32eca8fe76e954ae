//! A planning task over ground facts and operators: all that a planner needs, and nothing of where it came from.
//!
//! Invariant: in every operator preconditions, add and delete effects are sorted, without repetition, and no
//! fact is both added and deleted: what an action deletes and adds holds after it, so it is added, and *renewed*
//! besides, for within a parallel step it is in nobody else's reach. Every [`FactId`] lies within [`Task::facts`].

use std::fmt;
use std::sync::Arc;

use super::indices::indices;

indices! {
    /// A fact of a [`Task`].
    FactId,
    /// An operator of a [`Task`].
    OperatorId,
}

/// A ground atom, or its negation where an action or the goal asks for it.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Fact {
    pub predicate: Arc<str>,
    pub args: Vec<Arc<str>>,
    pub negated: bool,
}

/// `НЕ ДВЕРЬ_ИЗ_В_ОТКРЫТА_(Дверь-ВZ, Комната-В, Комната-Z)`
impl fmt::Display for Fact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.negated {
            f.write_str("НЕ ")?;
        }
        write_call(f, &self.predicate, &self.args)
    }
}

/// A ground action; a step of a plan that carries it out is the paper's directive.
#[derive(Debug, Clone)]
pub struct Operator {
    pub name: Arc<str>,
    pub args: Vec<Arc<str>>,
    pub preconditions: Vec<FactId>,
    pub add_effects: Vec<FactId>,
    pub del_effects: Vec<FactId>,
    /// Those of `add_effects` that the action deletes before it adds them: a channel that is taken and free again.
    pub renewed: Vec<FactId>,
    pub cost: u32,
}

impl Operator {
    /// What it deletes, if only for a moment: no other operator of the same step may need or add it.
    pub fn takes(&self) -> impl Iterator<Item = FactId> {
        self.del_effects.iter().chain(&self.renewed).copied()
    }

    /// Whether two operators cannot be carried out in one step: one deletes what the other needs or adds (A. Blum,
    /// M. Furst, 1997).
    #[must_use]
    pub fn interferes(&self, other: &Self) -> bool {
        let spoils = |one: &Self, other: &Self| {
            let uses = |facts: &[FactId], fact| facts.binary_search(&fact).is_ok();
            one.takes().any(|f| uses(&other.preconditions, f) || uses(&other.add_effects, f))
        };
        spoils(self, other) || spoils(other, self)
    }
}

/// `Движение-из_в_через-дверь_(Комната-В, Комната-Z, Дверь-ВZ)`, as the paper prints a directive.
impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_call(f, &self.name, &self.args)
    }
}

fn write_call(f: &mut fmt::Formatter<'_>, name: &str, args: &[Arc<str>]) -> fmt::Result {
    write!(f, "{name}_(")?;
    for (place, arg) in args.iter().enumerate() {
        if place > 0 {
            f.write_str(", ")?;
        }
        f.write_str(arg)?;
    }
    f.write_str(")")
}

/// A ground planning task.
#[derive(Debug, Clone, Default)]
pub struct Task {
    pub facts: Vec<Fact>,
    pub operators: Vec<Operator>,
    /// What holds at first, sorted.
    pub init: Vec<FactId>,
    /// What must hold in the end, sorted.
    pub goal: Vec<FactId>,
    /// Those of `init` that are only assumed (SPEC P2), sorted.
    pub assumptions: Vec<FactId>,
    /// The last so many operators are no actions: each meets the one fact that is the goal by one of several ways in which
    /// the goal that was given can be met.
    pub goal_steps: usize,
}

impl Task {
    /// Whether an operator only says that a goal of several ways is met.
    #[must_use]
    pub fn is_goal_step(&self, id: OperatorId) -> bool {
        id.index() + self.goal_steps >= self.operators.len()
    }

    /// Takes the disjunct by which steps meet a goal of several to be the goal; the steps end where it is met.
    pub fn choose_disjunct(&mut self, steps: &mut Vec<Vec<OperatorId>>) {
        let is_met = |step: &Vec<OperatorId>| step.iter().position(|&id| self.is_goal_step(id));
        let met = steps.iter().enumerate().find_map(|(at, step)| Some((at, step[is_met(step)?])));
        let Some((at, by)) = met else { return };
        steps.truncate(at);
        self.goal = self.operator(by).preconditions.clone();
        self.operators.truncate(self.operators.len() - self.goal_steps);
        self.goal_steps = 0;
    }

    #[must_use]
    pub fn fact(&self, id: FactId) -> &Fact {
        &self.facts[id.index()]
    }

    #[must_use]
    pub fn operator(&self, id: OperatorId) -> &Operator {
        &self.operators[id.index()]
    }

    pub fn fact_ids(&self) -> impl Iterator<Item = FactId> + use<> {
        (0..self.facts.len() as u32).map(FactId)
    }

    /// For each fact the operators that add it.
    #[must_use]
    pub fn added_by(&self) -> Vec<Vec<OperatorId>> {
        self.operators_by(|operator| &operator.add_effects)
    }

    /// For each fact the operators that delete it for good.
    #[must_use]
    pub fn deleted_by(&self) -> Vec<Vec<OperatorId>> {
        self.operators_by(|operator| &operator.del_effects)
    }

    fn operators_by(&self, facts: impl Fn(&Operator) -> &[FactId]) -> Vec<Vec<OperatorId>> {
        let mut by = vec![Vec::new(); self.facts.len()];
        for id in self.operator_ids() {
            facts(self.operator(id)).iter().for_each(|fact| by[fact.index()].push(id));
        }
        by
    }

    pub fn operator_ids(&self) -> impl Iterator<Item = OperatorId> + use<> {
        (0..self.operators.len() as u32).map(OperatorId)
    }

    /// Panics when the invariant of this module does not hold; for tests and for hand-made tasks.
    pub fn check_invariants(&self) {
        let strictly_sorted = |ids: &[FactId]| ids.windows(2).all(|pair| pair[0] < pair[1]);
        let within = |ids: &[FactId]| ids.iter().all(|id| id.index() < self.facts.len());
        for ids in [&self.init, &self.goal, &self.assumptions] {
            assert!(strictly_sorted(ids) && within(ids), "the task's fact lists are sorted sets");
        }
        for operator in &self.operators {
            let Operator { preconditions, add_effects, del_effects, renewed, .. } = operator;
            for ids in [preconditions, add_effects, del_effects, renewed] {
                assert!(strictly_sorted(ids) && within(ids), "{operator}: lists are sorted sets");
            }
            assert!(
                !add_effects.iter().any(|id| del_effects.contains(id)),
                "{operator}: no fact is both added and deleted"
            );
            assert!(
                renewed.iter().all(|id| add_effects.contains(id)),
                "{operator}: what is renewed is added"
            );
        }
    }
}
