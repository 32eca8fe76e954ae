//! Facts that are only passed through: a robot drives to a chair and on to a door, where it could drive to the door.
//!
//! A fact `f` is a *detour* when whoever comes to it, by an operator `a`, and leaves it, by an operator `b`, could have
//! come there by one operator `c` at the moment of `b`, or stayed. Then a plan in which nobody uses `f` but to leave it
//! has a like one without `a` and `b`: what `a` gives up stays, for it excludes `f` and is given up only by who needs
//! it; what else `c` needs stays too, for whoever deletes it needs something that excludes `f`.
//!
//! The conditions are read off below. They ask of `c` no more than `a` and `b` had, that it adds what they did, and
//! deletes nothing that they did not, be it for a moment; what it needs in their stead nobody else may delete then, not
//! even for a moment.

use std::collections::HashMap;

use super::pairs::ReachedPairs;
use crate::strips::{FactId, OperatorId, Task};

/// Looks for such facts, and keeps what it found.
pub(crate) struct Detours<'a> {
    task: &'a Task,
    pairs: &'a ReachedPairs,
    uses: &'a Uses,
    /// Operators by a fact that they need and give up and one that they add.
    turns: HashMap<(FactId, FactId), Vec<OperatorId>>,
    found: Vec<Option<bool>>,
    by_need: Vec<Option<bool>>,
    stays: HashMap<(FactId, FactId), bool>,
    implied: HashMap<(FactId, FactId), bool>,
    alone: HashMap<(FactId, FactId), bool>,
    untouched: HashMap<(FactId, FactId), bool>,
}

/// By whom each fact is added, needed, deleted and renewed, of those who can be carried out; what holds at first, and in the end.
pub(crate) struct Uses {
    pub(crate) added_by: Vec<Vec<OperatorId>>,
    pub(crate) needed_by: Vec<Vec<OperatorId>>,
    pub(crate) deleted_by: Vec<Vec<OperatorId>>,
    renewed_by: Vec<Vec<OperatorId>>,
    pub(crate) initially: Vec<bool>,
    pub(crate) is_goal: Vec<bool>,
}

impl Uses {
    pub(crate) fn of(task: &Task, pairs: &ReachedPairs) -> Self {
        let count = task.facts.len();
        let nobody = || vec![Vec::new(); count];
        let (mut added_by, mut needed_by, mut deleted_by, mut renewed_by) =
            (nobody(), nobody(), nobody(), nobody());
        for id in task.operator_ids().filter(|id| pairs.applicable[id.index()]) {
            let operator = task.operator(id);
            operator.add_effects.iter().for_each(|f| added_by[f.index()].push(id));
            operator.preconditions.iter().for_each(|f| needed_by[f.index()].push(id));
            operator.del_effects.iter().for_each(|f| deleted_by[f.index()].push(id));
            operator.renewed.iter().for_each(|f| renewed_by[f.index()].push(id));
        }
        let marked = |facts: &[FactId]| {
            let mut marks = vec![false; count];
            facts.iter().for_each(|fact| marks[fact.index()] = true);
            marks
        };
        let (initially, is_goal) = (marked(&task.init), marked(&task.goal));
        Self { added_by, needed_by, deleted_by, renewed_by, initially, is_goal }
    }
}

impl<'a> Detours<'a> {
    pub(crate) fn new(task: &'a Task, pairs: &'a ReachedPairs, uses: &'a Uses) -> Self {
        let mut turns: HashMap<_, Vec<OperatorId>> = HashMap::new();
        for id in task.operator_ids().filter(|id| pairs.applicable[id.index()]) {
            let operator = task.operator(id);
            for &from in operator.preconditions.iter().filter(|f| operator.del_effects.contains(f))
            {
                for &to in &operator.add_effects {
                    turns.entry((from, to)).or_default().push(id);
                }
            }
        }
        Self {
            task,
            pairs,
            uses,
            turns,
            found: vec![None; task.facts.len()],
            by_need: vec![None; task.facts.len()],
            stays: HashMap::new(),
            implied: HashMap::new(),
            alone: HashMap::new(),
            untouched: HashMap::new(),
        }
    }

    /// Whether an operator leaves a detour of which no kept operator makes any use.
    pub(crate) fn leaves_one(&mut self, id: OperatorId, kept: &[bool]) -> bool {
        let operator = self.task.operator(id);
        operator.preconditions.iter().filter(|f| operator.del_effects.contains(f)).any(|&f| {
            self.uses.needed_by[f.index()].iter().all(|by| !kept[by.index()]) && self.is_detour(f)
        })
    }

    /// Whether an operator adds what must hold already, by what it needs.
    pub(crate) fn adds_nothing(&mut self, id: OperatorId, fact: FactId) -> bool {
        let operator = self.task.operator(id);
        !operator.del_effects.contains(&fact) && self.holds_before(id, fact)
    }

    fn is_detour(&mut self, f: FactId) -> bool {
        if let Some(known) = self.found[f.index()] {
            return known;
        }
        let is = !self.uses.initially[f.index()]
            && !self.uses.is_goal[f.index()]
            && self.is_given_up_by_need(f)
            && self.uses.added_by[f.index()].iter().all(|&a| {
                self.uses.deleted_by[f.index()].iter().all(|&b| a == b || self.is_spared(f, a, b))
            });
        self.found[f.index()] = Some(is);
        is
    }

    /// Whether whoever comes to `f` by `a` and leaves it by `b` could have done with one operator at the moment of `b`,
    /// or with none.
    fn is_spared(&mut self, f: FactId, a: OperatorId, b: OperatorId) -> bool {
        let (first, last) = (self.task.operator(a), self.task.operator(b));
        // What coming there adds besides must have held before, since others may use it in between.
        let others = first.add_effects.iter().filter(|add| **add != f);
        if !others.clone().all(|&add| self.adds_nothing(a, add)) {
            return false;
        }
        if last.add_effects.iter().all(|&add| self.is_had(f, a, add)) {
            return true;
        }
        let from = first.preconditions.iter().filter(|p| first.del_effects.contains(p));
        let pairs = from.flat_map(|&p| last.add_effects.iter().map(move |&q| (p, q)));
        let turns: Vec<OperatorId> =
            pairs.filter_map(|pair| self.turns.get(&pair)).flatten().copied().collect();
        turns.into_iter().any(|c| self.is_as_good(f, a, b, c))
    }

    fn is_as_good(&mut self, f: FactId, a: OperatorId, b: OperatorId, c: OperatorId) -> bool {
        let [first, last, direct] = [a, b, c].map(|id| self.task.operator(id));
        direct.cost <= first.cost + last.cost
            && direct.renewed.iter().all(|fact| last.takes().any(|taken| taken == *fact))
            && direct.preconditions.iter().all(|&need| {
                let own = last.preconditions.contains(&need) && !first.add_effects.contains(&need);
                own || self.is_had(f, a, need)
            })
            && last.add_effects.iter().all(|&add| {
                direct.add_effects.contains(&add)
                    || (!direct.del_effects.contains(&add) && self.is_had(f, a, add))
            })
            && direct
                .add_effects
                .iter()
                .all(|&add| last.add_effects.contains(&add) || self.is_had(f, a, add))
            && direct.del_effects.iter().all(|&gone| {
                last.del_effects.contains(&gone)
                    || (first.del_effects.contains(&gone) && self.is_alone(gone, f))
            })
    }

    /// Whether a fact that holds before `a` holds at the moment when `f` is left, if `a` is not carried out.
    fn is_had(&mut self, f: FactId, a: OperatorId, fact: FactId) -> bool {
        let given_up = self.task.operator(a).del_effects.contains(&fact);
        self.holds_before(a, fact)
            && self.is_untouched(fact, f)
            && match given_up {
                true => self.pairs.is_exclusive(fact, f) && self.is_given_up_by_need(fact),
                false => self.stays_beside(fact, f),
            }
    }

    fn holds_before(&mut self, id: OperatorId, fact: FactId) -> bool {
        let needs = &self.task.operator(id).preconditions;
        needs.contains(&fact) || needs.iter().any(|&need| self.implies(need, fact))
    }

    /// Whether whoever deletes a fact needs it.
    fn is_given_up_by_need(&mut self, fact: FactId) -> bool {
        let (task, by) = (self.task, &self.uses.deleted_by[fact.index()]);
        *self.by_need[fact.index()].get_or_insert_with(|| {
            by.iter().all(|&id| task.operator(id).preconditions.contains(&fact))
        })
    }

    /// Whether nobody can delete a fact while `f` holds.
    fn stays_beside(&mut self, fact: FactId, f: FactId) -> bool {
        let (pairs, task, deleted_by) = (self.pairs, self.task, &self.uses.deleted_by);
        *self.stays.entry((fact, f)).or_insert_with(|| {
            let apart = |&id: &OperatorId| {
                task.operator(id).preconditions.iter().any(|&need| pairs.is_exclusive(need, f))
            };
            deleted_by[fact.index()].iter().all(apart)
        })
    }

    /// Whether nobody can renew a fact while `f` holds.
    fn is_untouched(&mut self, fact: FactId, f: FactId) -> bool {
        let (pairs, task, renewed_by) = (self.pairs, self.task, &self.uses.renewed_by);
        *self.untouched.entry((fact, f)).or_insert_with(|| {
            let apart = |&id: &OperatorId| {
                task.operator(id).preconditions.iter().any(|&need| pairs.is_exclusive(need, f))
            };
            renewed_by[fact.index()].iter().all(apart)
        })
    }

    /// Whether a fact is exclusive with `f`, and nobody can add it while `f` holds but who gives `f` up.
    fn is_alone(&mut self, fact: FactId, f: FactId) -> bool {
        let (pairs, task, added_by) = (self.pairs, self.task, &self.uses.added_by);
        *self.alone.entry((fact, f)).or_insert_with(|| {
            let apart = |&id: &OperatorId| {
                let operator = task.operator(id);
                operator.preconditions.iter().any(|&need| pairs.is_exclusive(need, f))
                    || (operator.preconditions.contains(&f) && operator.del_effects.contains(&f))
            };
            pairs.is_exclusive(fact, f) && added_by[fact.index()].iter().all(apart)
        })
    }

    /// Whether one fact never holds without the other: it never comes to hold without it, and nobody deletes the other
    /// while it holds.
    fn implies(&mut self, one: FactId, other: FactId) -> bool {
        let (pairs, task) = (self.pairs, self.task);
        let (added_by, deleted_by) = (&self.uses.added_by, &self.uses.deleted_by);
        let at_first = !self.uses.initially[one.index()] || self.uses.initially[other.index()];
        *self.implied.entry((one, other)).or_insert_with(|| {
            let brings = |&id: &OperatorId| {
                let operator = task.operator(id);
                let has = operator.preconditions.contains(&other);
                operator.add_effects.contains(&other)
                    || (has && !operator.del_effects.contains(&other))
            };
            let apart = |&id: &OperatorId| {
                let operator = task.operator(id);
                operator.add_effects.contains(&other)
                    || (operator.del_effects.contains(&one) && !operator.add_effects.contains(&one))
                    || operator.preconditions.iter().any(|&need| pairs.is_exclusive(need, one))
            };
            at_first
                && !pairs.is_exclusive(one, other)
                && added_by[one.index()].iter().all(brings)
                && deleted_by[other.index()].iter().all(apart)
        })
    }
}
