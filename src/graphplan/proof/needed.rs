//! Operators that no shortest plan needs, left out before the planning graph is built: a robot's way into a room
//! where it has nothing to do and out again, keys to such rooms, a thing put down only to be taken up again.
//!
//! Backward from the goal an operator is *kept* when it adds a needed fact, and then its preconditions are needed too
//! (P. Haslum, M. Helmert, A. Jonsson, 2013, go further than that in another way). Three kinds of operators are not
//! kept although they add a needed fact:
//!
//! 1. **Returns.** The operator needs a fact that lies *beyond* the one it adds: it excludes it, and was come to from
//!    it, all the way by operators that are not kept. Who takes no such way never lost what the return brings back.
//! 2. **Undone for nothing.** The operator gives up `p`, and whoever uses what it adds does so only to have `p`
//!    again. Who keeps `p` needs neither.
//! 3. **Detours.** The operator leaves a fact that no kept operator uses, and to which one need not have come: see
//!    [`detours`](super::detours).
//!
//! Let a plan be given, and leave out of it all that is not kept. By induction over its steps every needed fact that
//! holds in the course of the whole plan holds in the course of the rest, too, but for what an operator of the second
//! kind added and nobody used up to the moment when its `p` is had again – at which moment those facts hold no more,
//! for they exclude `p`; a kept operator that uses one of them is left out as well. So the rest is a plan, with no
//! more steps and no more actions; parallel steps lose members and stay parallel. The conditions are read off below.

use super::detours::{Detours, Uses};
use super::pairs::ReachedPairs;
use crate::bits;
use crate::strips::{FactId, Operator, OperatorId, Task};
use crate::{Limit, Limits, Plan};

/// A task with fewer operators and facts, and the same fewest steps.
pub(crate) struct Reduced {
    pub(crate) task: Task,
    facts: Vec<FactId>,
    operators: Vec<OperatorId>,
}

impl Reduced {
    /// # Errors
    /// Time or memory is up.
    pub(crate) fn of(task: &Task, limits: &Limits) -> Result<Self, Limit> {
        let pairs = ReachedPairs::of(task, limits)?;
        let uses = Uses::of(task, &pairs);
        let mut relevance = Relevance::new(task, &pairs, &uses);
        relevance.fixpoint(limits)?;
        let operators = task.operator_ids().filter(|id| relevance.kept[id.index()]).collect();
        Ok(Self::keeping(task, operators, &task.init, &task.goal))
    }

    /// These operators and the facts that matter to them, from one state to one goal.
    pub(crate) fn keeping(
        task: &Task,
        operators: Vec<OperatorId>,
        init: &[FactId],
        goal: &[FactId],
    ) -> Self {
        let mut roles = vec![Role::default(); task.facts.len()];
        init.iter().for_each(|fact| roles[fact.index()].is_initial = true);
        goal.iter().for_each(|fact| roles[fact.index()].is_goal = true);
        for operator in operators.iter().map(|&id| task.operator(id)) {
            operator.add_effects.iter().for_each(|fact| roles[fact.index()].is_added = true);
            operator.del_effects.iter().for_each(|fact| roles[fact.index()].is_deleted = true);
            operator.renewed.iter().for_each(|fact| roles[fact.index()].is_renewed = true);
            operator.preconditions.iter().for_each(|fact| roles[fact.index()].is_needed = true);
            let needs_only =
                operator.preconditions.iter().filter(|fact| !operator.add_effects.contains(fact));
            needs_only.chain(&operator.add_effects).for_each(|f| roles[f.index()].users += 1);
        }
        let counts = |fact: &FactId| roles[fact.index()].counts();
        let facts: Vec<FactId> = task.fact_ids().filter(counts).collect();
        let mut number = vec![None; task.facts.len()];
        for (new, old) in facts.iter().enumerate() {
            number[old.index()] = Some(FactId(new as u32));
        }
        let own = |facts: &[FactId]| facts.iter().filter_map(|f| number[f.index()]).collect();
        let of_operator = |&id: &OperatorId| {
            let operator = task.operator(id);
            Operator {
                preconditions: own(&operator.preconditions),
                add_effects: own(&operator.add_effects),
                del_effects: own(&operator.del_effects),
                renewed: own(&operator.renewed),
                ..operator.clone()
            }
        };
        let smaller = Task {
            facts: facts.iter().map(|&fact| task.fact(fact).clone()).collect(),
            operators: operators.iter().map(of_operator).collect(),
            init: own(init),
            goal: own(goal),
            assumptions: own(&task.assumptions),
            goal_steps: 0,
        };
        Self { task: smaller, facts, operators }
    }

    pub(crate) fn fact(&self, of_reduced: FactId) -> FactId {
        self.facts[of_reduced.index()]
    }

    pub(crate) fn operator(&self, of_reduced: OperatorId) -> OperatorId {
        self.operators[of_reduced.index()]
    }

    /// A plan of this task in terms of the whole.
    pub(crate) fn own(&self, mut plan: Plan) -> Plan {
        plan.steps.iter_mut().flatten().for_each(|id| *id = self.operator(*id));
        plan
    }
}

/// What a fact is to the operators that are kept.
#[derive(Clone, Copy, Default)]
struct Role {
    is_initial: bool,
    is_goal: bool,
    is_needed: bool,
    is_added: bool,
    is_deleted: bool,
    is_renewed: bool,
    /// How many need it, or add it.
    users: usize,
}

impl Role {
    /// What holds and is never given up need not be asked for; it still keeps operators apart, and so does what nobody
    /// needs, where one of them deletes, if only for a moment, what another adds or needs.
    fn counts(self) -> bool {
        let stays = self.is_initial && !self.is_deleted && !self.is_goal;
        let is_contested = self.is_added && self.is_deleted || self.is_renewed && self.users > 1;
        is_contested || (self.is_needed || self.is_goal) && !stays
    }
}

struct Relevance<'a> {
    task: &'a Task,
    pairs: &'a ReachedPairs,
    uses: &'a Uses,
    detours: Detours<'a>,
    kept: Vec<bool>,
    /// The kept ones in the order in which they came to be kept.
    kept_in_order: Vec<OperatorId>,
    needed: Vec<bool>,
    /// Per fact, once asked for, what lies beyond it.
    beyond: Vec<Option<Beyond>>,
    /// Facts that operators of the second kind give up, and those that only they add.
    given_up: Vec<bool>,
    missing: Vec<bool>,
}

/// What lies beyond a fact, as the first so many operators that are kept let it be.
struct Beyond {
    facts: Box<[u64]>,
    kept: usize,
}

impl<'a> Relevance<'a> {
    fn new(task: &'a Task, pairs: &'a ReachedPairs, uses: &'a Uses) -> Self {
        let count = task.facts.len();
        Self {
            task,
            pairs,
            uses,
            detours: Detours::new(task, pairs, uses),
            kept: vec![false; task.operators.len()],
            kept_in_order: Vec::new(),
            needed: uses.is_goal.clone(),
            beyond: (0..count).map(|_| None).collect(),
            given_up: vec![false; count],
            missing: vec![false; count],
        }
    }

    /// Keeps operators until none that is left must be kept. What one round believed of facts beyond may turn out
    /// wrong when more is kept; the last round changes nothing, so that in it all was judged by what is kept at last.
    fn fixpoint(&mut self, limits: &Limits) -> Result<(), Limit> {
        loop {
            self.given_up.fill(false);
            self.missing.fill(false);
            let mut open: Vec<FactId> =
                self.task.fact_ids().filter(|fact| self.needed[fact.index()]).collect();
            let mut changed = false;
            while let Some(fact) = open.pop() {
                limits.check(0)?;
                for at in 0..self.uses.added_by[fact.index()].len() {
                    let id = self.uses.added_by[fact.index()][at];
                    if self.kept[id.index()] || self.is_needless(id) {
                        continue;
                    }
                    changed = true;
                    self.kept[id.index()] = true;
                    self.kept_in_order.push(id);
                    for &need in &self.task.operator(id).preconditions {
                        if !std::mem::replace(&mut self.needed[need.index()], true) {
                            open.push(need);
                        }
                    }
                }
            }
            if !changed {
                return Ok(());
            }
        }
    }

    fn is_needless(&mut self, id: OperatorId) -> bool {
        let operator = self.task.operator(id);
        let mut brought = Vec::new();
        for &fact in &operator.add_effects {
            if self.needed[fact.index()]
                && !self.is_return(id, fact)
                && !self.detours.adds_nothing(id, fact)
            {
                brought.push(fact);
            }
        }
        if brought.is_empty() || self.detours.leaves_one(id, &self.kept) {
            return true;
        }
        let gives_up = operator.preconditions.iter().filter(|f| operator.del_effects.contains(f));
        for &p in gives_up {
            if self.is_undone_for_nothing(p, &brought) {
                self.given_up[p.index()] = true;
                brought.iter().for_each(|fact| self.missing[fact.index()] = true);
                return true;
            }
        }
        false
    }

    /// Whether an operator adds what held before anyway.
    fn is_return(&mut self, id: OperatorId, fact: FactId) -> bool {
        let needs = &self.task.operator(id).preconditions;
        needs.contains(&fact)
            || self.is_given_up_only_by_need(fact) && {
                let beyond = self.beyond(fact);
                needs.iter().any(|need| bits::has(beyond, need.index()))
            }
    }

    /// Whether no kept operator deletes a fact that need not hold then: while it is lost, none of them deletes it.
    fn is_given_up_only_by_need(&self, fact: FactId) -> bool {
        self.uses.deleted_by[fact.index()]
            .iter()
            .filter(|id| self.kept[id.index()])
            .all(|&id| self.task.operator(id).preconditions.contains(&fact))
    }

    /// Whether `p`, given up for these facts, is all that any kept operator makes of them.
    fn is_undone_for_nothing(&mut self, p: FactId, brought: &[FactId]) -> bool {
        if self.missing[p.index()] || !self.is_given_up_only_by_need(p) {
            return false;
        }
        brought.iter().all(|&fact| {
            let pairs = self.pairs;
            let apart = |beyond: &[u64]| {
                beyond.iter().zip(pairs.row(p)).all(|(beyond, beside)| beyond & beside == 0)
            };
            !self.uses.is_goal[fact.index()]
                && !self.given_up[fact.index()]
                && pairs.is_exclusive(fact, p)
                && self.uses.needed_by[fact.index()]
                    .iter()
                    .filter(|id| self.kept[id.index()])
                    .flat_map(|&id| &self.task.operator(id).add_effects)
                    .all(|&add| add == p || !self.needed[add.index()])
                && apart(self.beyond(fact))
        })
    }

    /// Facts that exclude a fact and are come to only from it, by operators that are not kept: since one of them
    /// holds, the fact has held, and in between one or another of them did.
    ///
    /// More that is kept only takes facts out of it, so what was found before is narrowed.
    fn beyond(&mut self, fact: FactId) -> &[u64] {
        let kept = self.kept_in_order.len();
        let known = self.beyond[fact.index()].take();
        let facts = match known {
            Some(known) if known.kept == kept => known.facts,
            Some(known) => {
                let newly = self.kept_in_order[known.kept..].iter();
                let adds = newly.flat_map(|&id| &self.task.operator(id).add_effects);
                self.narrowed(fact, known.facts, adds.map(|add| add.index()).collect())
            }
            None => {
                let all = self.beside_none(fact);
                let members = bits::members(&all).collect();
                self.narrowed(fact, all, members)
            }
        };
        &self.beyond[fact.index()].insert(Beyond { facts, kept }).facts
    }

    /// All facts that exclude a fact.
    fn beside_none(&self, fact: FactId) -> Box<[u64]> {
        let count = self.task.facts.len();
        let mut facts = vec![0; bits::words(count)].into_boxed_slice();
        for (exclusive, beside) in facts.iter_mut().zip(self.pairs.row(fact)) {
            *exclusive = !beside;
        }
        (count..facts.len() * 64).for_each(|none| bits::take(&mut facts, none));
        facts
    }

    /// What is left when these members, and whatever was come to from them, are judged anew.
    fn narrowed(&self, fact: FactId, mut beyond: Box<[u64]>, members: Vec<usize>) -> Box<[u64]> {
        let comes_from_there = |beyond: &[u64], id: OperatorId| {
            let needs = &self.task.operator(id).preconditions;
            !self.kept[id.index()]
                && needs.iter().any(|&need| need == fact || bits::has(beyond, need.index()))
        };
        let mut gone = Vec::new();
        for member in members {
            let stays = !self.uses.initially[member]
                && self.uses.added_by[member].iter().all(|&id| comes_from_there(&beyond, id));
            if !stays && bits::has(&beyond, member) {
                bits::take(&mut beyond, member);
                gone.push(member);
            }
        }
        // Whoever came from there may have come from nowhere else.
        while let Some(member) = gone.pop() {
            for &id in self.uses.needed_by[member].iter().filter(|id| !self.kept[id.index()]) {
                if comes_from_there(&beyond, id) {
                    continue;
                }
                for add in self.task.operator(id).add_effects.iter().map(|add| add.index()) {
                    if bits::has(&beyond, add) {
                        bits::take(&mut beyond, add);
                        gone.push(add);
                    }
                }
            }
        }
        beyond
    }
}
