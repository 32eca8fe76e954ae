//! The planning graph: which facts and actions are possible from which level on, and which pairs exclude each other.
//!
//! Levels only grow: a fact or an action once possible stays so, and a pair once free of mutex stays free. So
//! facts and actions are kept once, with the first level at which they appear; only the mutex relation of facts
//! is kept for each level, as a bit matrix, until the graph levels off. Mutexes of actions follow from those of
//! their preconditions and are computed when asked for.

use std::cell::OnceCell;

use super::replan::Inherited;
use crate::bits;
use crate::strips::{FactId, Task};
use crate::{Limit, Limits, NoPlanReason};

/// An operator, or the no-op that carries a fact from one level to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct ActionId(pub(crate) u32);

impl ActionId {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// An operator or no-op with short sorted lists of facts.
#[derive(Debug)]
pub(crate) struct Action {
    pub(crate) preconditions: Box<[FactId]>,
    pub(crate) add_effects: Box<[FactId]>,
    /// What it deletes, if only for a moment: through these it interferes with others.
    pub(crate) takes: Box<[FactId]>,
}

/// A level that no fact or action reaches.
const NEVER: u32 = u32::MAX;

/// A symmetric relation on facts.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Pairs {
    words: usize,
    bits: Vec<u64>,
}

impl Pairs {
    fn new(facts: usize) -> Self {
        let words = bits::words(facts);
        Self { words, bits: vec![0; words * facts] }
    }

    fn contains(&self, a: FactId, b: FactId) -> bool {
        bits::has(self.row(a), b.index())
    }

    fn insert(&mut self, a: FactId, b: FactId) {
        for (row, bit) in [(a.index(), b.index()), (b.index(), a.index())] {
            bits::put(&mut self.bits[row * self.words..][..self.words], bit);
        }
    }

    fn row(&self, a: FactId) -> &[u64] {
        &self.bits[a.index() * self.words..][..self.words]
    }
}

#[derive(Debug)]
pub(crate) struct PlanningGraph {
    pub(crate) actions: Vec<Action>,
    /// Operators come first, then one no-op a fact.
    operator_count: usize,
    /// Actions that add a fact; the no-op first.
    achievers: Vec<Vec<ActionId>>,
    fact_level: Vec<u32>,
    action_level: Vec<u32>,
    /// Per level up to the last that differs from the one before.
    mutex: Vec<Pairs>,
    top: usize,
    leveled_off_at: Option<usize>,
    effort: u64,
}

impl PlanningGraph {
    /// The graph of level 0: the initial state.
    pub(crate) fn new(task: &Task) -> Self {
        let fact_count = task.facts.len();
        let operators = task.operators.iter().map(|operator| Action {
            preconditions: operator.preconditions.as_slice().into(),
            add_effects: operator.add_effects.as_slice().into(),
            takes: operator.takes().collect(),
        });
        let no_ops = task.fact_ids().map(|fact| Action {
            preconditions: [fact].into(),
            add_effects: [fact].into(),
            takes: [].into(),
        });
        let actions: Vec<Action> = operators.chain(no_ops).collect();
        let operator_count = task.operators.len();
        let mut achievers: Vec<Vec<ActionId>> =
            (0..fact_count).map(|fact| vec![ActionId((operator_count + fact) as u32)]).collect();
        for (number, action) in actions[..operator_count].iter().enumerate() {
            for fact in &action.add_effects {
                achievers[fact.index()].push(ActionId(number as u32));
            }
        }
        let mut fact_level = vec![NEVER; fact_count];
        task.init.iter().for_each(|fact| fact_level[fact.index()] = 0);
        Self {
            action_level: vec![NEVER; actions.len()],
            actions,
            operator_count,
            achievers,
            fact_level,
            mutex: vec![Pairs::new(fact_count)],
            top: 0,
            leveled_off_at: None,
            effort: 0,
        }
    }

    /// The last level built.
    pub(crate) fn top(&self) -> usize {
        self.top
    }

    pub(crate) fn leveled_off_at(&self) -> Option<usize> {
        self.leveled_off_at
    }

    pub(crate) fn action(&self, id: ActionId) -> &Action {
        &self.actions[id.index()]
    }

    pub(crate) fn is_no_op(&self, id: ActionId) -> bool {
        id.index() >= self.operator_count
    }

    pub(crate) fn achievers(&self, fact: FactId) -> &[ActionId] {
        &self.achievers[fact.index()]
    }

    /// The first level at which a fact may hold.
    pub(crate) fn fact_level(&self, fact: FactId) -> u32 {
        self.fact_level[fact.index()]
    }

    /// The first step (from that level to the next) in which an action may be carried out.
    pub(crate) fn action_level(&self, action: ActionId) -> u32 {
        self.action_level[action.index()]
    }

    /// From level 0 on, the levels that have mutexes of their own; later ones have those of the last.
    pub(crate) fn levels_of_mutexes(&self) -> usize {
        self.mutex.len()
    }

    pub(crate) fn fact_count(&self) -> usize {
        self.fact_level.len()
    }

    fn mutex_at(&self, level: usize) -> &Pairs {
        &self.mutex[level.min(self.mutex.len() - 1)]
    }

    pub(crate) fn is_exclusive(&self, level: usize, a: FactId, b: FactId) -> bool {
        self.mutex_at(level).contains(a, b)
    }

    /// Facts that exclude `fact` at a level, as far as they may hold there at all.
    pub(crate) fn exclusive_with(
        &self,
        level: usize,
        fact: FactId,
    ) -> impl Iterator<Item = FactId> {
        bits::members(self.mutex_at(level).row(fact)).map(|fact| FactId(fact as u32))
    }

    /// Whether all facts may hold at the last level, as far as pairs tell.
    pub(crate) fn is_possible(&self, facts: &[FactId]) -> bool {
        let mutex = self.mutex_at(self.top);
        facts.iter().all(|fact| self.fact_level(*fact) != NEVER)
            && facts
                .iter()
                .enumerate()
                .all(|(at, &a)| facts[..at].iter().all(|&b| !mutex.contains(a, b)))
    }

    /// Why facts are not possible together at the last level.
    pub(crate) fn conflict_of(&self, facts: &[FactId]) -> NoPlanReason {
        let unreachable: Vec<FactId> =
            facts.iter().copied().filter(|&fact| self.fact_level(fact) == NEVER).collect();
        if !unreachable.is_empty() {
            return NoPlanReason::Unreachable(unreachable);
        }
        let mutex = self.mutex_at(self.top);
        let mut pairs = Vec::new();
        for (at, &a) in facts.iter().enumerate() {
            pairs
                .extend(facts[at + 1..].iter().filter(|&&b| mutex.contains(a, b)).map(|&b| (a, b)));
        }
        NoPlanReason::Exclusive(pairs)
    }

    /// Two actions exclude each other in the step that starts at `level`.
    ///
    /// Inconsistent effects and interference: one deletes what the other adds or needs. Competing needs: a
    /// precondition of one excludes a precondition of the other.
    pub(crate) fn is_mutex(&self, level: usize, a: ActionId, b: ActionId) -> bool {
        self.interfere(a, b) || self.compete(self.mutex_at(level), a, b)
    }

    fn interfere(&self, a: ActionId, b: ActionId) -> bool {
        let (a, b) = (self.action(a), self.action(b));
        let breaks = |x: &Action, y: &Action| {
            x.takes.iter().any(|f| y.preconditions.contains(f) || y.add_effects.contains(f))
        };
        breaks(a, b) || breaks(b, a)
    }

    fn compete(&self, mutex: &Pairs, a: ActionId, b: ActionId) -> bool {
        let (a, b) = (self.action(a), self.action(b));
        a.preconditions.iter().any(|&p| b.preconditions.iter().any(|&q| mutex.contains(p, q)))
    }

    /// Adds a level of actions and a level of facts. What is inherited need not be found out again.
    pub(crate) fn expand(
        &mut self,
        inherited: Option<&Inherited<'_>>,
        limits: &Limits,
    ) -> Result<(), Limit> {
        if self.leveled_off_at.is_some() {
            self.top += 1;
            return Ok(());
        }
        let new_actions = self.add_actions();
        let new_facts = self.add_facts();
        let (next, effort) = self.next_mutex(inherited, limits)?;
        self.effort += effort + self.actions.len() as u64;
        if !new_actions && !new_facts && next == self.mutex[self.top] {
            self.leveled_off_at = Some(self.top);
        } else {
            self.mutex.push(next);
        }
        self.top += 1;
        Ok(())
    }

    fn add_actions(&mut self) -> bool {
        let mutex = &self.mutex[self.top];
        let level = self.top as u32;
        let mut any = false;
        for (action, first) in self.actions.iter().zip(&mut self.action_level) {
            let needs = &action.preconditions;
            let possible = *first == NEVER
                && needs.iter().all(|fact| self.fact_level[fact.index()] <= level)
                && needs
                    .iter()
                    .enumerate()
                    .all(|(at, &p)| needs[..at].iter().all(|&q| !mutex.contains(p, q)));
            if possible {
                *first = level;
                any = true;
            }
        }
        any
    }

    fn add_facts(&mut self) -> bool {
        let level = self.top as u32;
        let mut any = false;
        for (action, &first) in self.actions.iter().zip(&self.action_level) {
            if first == level {
                for fact in &action.add_effects {
                    let first = &mut self.fact_level[fact.index()];
                    if *first == NEVER {
                        *first = level + 1;
                        any = true;
                    }
                }
            }
        }
        any
    }

    /// Facts exclude each other at the next level when all ways to have the one exclude all ways to have the
    /// other. A pair free at this level stays free: two no-ops carry it over.
    fn next_mutex(
        &self,
        inherited: Option<&Inherited<'_>>,
        limits: &Limits,
    ) -> Result<(Pairs, u64), Limit> {
        let level = self.top as u32;
        let known = |a, b| inherited.is_some_and(|old| old.is_exclusive(self.top + 1, a, b));
        let old = &self.mutex[self.top];
        let mut next = Pairs::new(self.fact_level.len());
        let mut effort = 0;
        let words = old.words;
        let (mut present, mut new) = (vec![0_u64; words], vec![0_u64; words]);
        for (fact, &first) in self.fact_level.iter().enumerate() {
            if first <= level + 1 {
                bits::put(&mut present, fact);
            }
            if first == level + 1 {
                bits::put(&mut new, fact);
            }
        }
        for number in 0..self.fact_level.len() {
            let a = FactId(number as u32);
            if self.fact_level(a) > level + 1 {
                continue;
            }
            limits.check(0)?;
            let is_new = self.fact_level(a) == level + 1;
            let row = old.row(a);
            let barred = OnceCell::new();
            for word in 0..=number / 64 {
                let open =
                    if is_new { present[word] } else { present[word] & (row[word] | new[word]) };
                for bit in bits::of_word(open) {
                    effort += 1;
                    let b = FactId((word * 64 + bit) as u32);
                    let excluded = |barred| !self.jointly_achievable(old, a, b, barred);
                    if b < a
                        && (known(a, b) || excluded(barred.get_or_init(|| self.barred(old, a))))
                    {
                        next.insert(a, b);
                    }
                }
            }
        }
        Ok((next, effort))
    }

    /// The facts, as a row of bits, that no action may need beside any way to have `p`: each way excludes its
    /// preconditions or takes it away. With one robot that moves, mostly all the places where it may be.
    fn barred(&self, mutex: &Pairs, p: FactId) -> Vec<u64> {
        let mut barred = vec![u64::MAX; mutex.words];
        let mut excluded = vec![0_u64; mutex.words];
        for a in self.ways(p) {
            excluded.fill(0);
            let action = self.action(a);
            for &fact in &action.preconditions {
                bits::unite(&mut excluded, mutex.row(fact));
            }
            for fact in &action.takes {
                bits::put(&mut excluded, fact.index());
            }
            bits::keep_common(&mut barred, &excluded);
        }
        barred
    }

    /// The actions of this level that add a fact.
    fn ways(&self, fact: FactId) -> impl Iterator<Item = ActionId> {
        let level = self.top as u32;
        self.achievers(fact).iter().copied().filter(move |&a| self.action_level(a) <= level)
    }

    fn jointly_achievable(&self, mutex: &Pairs, p: FactId, q: FactId, barred: &[u64]) -> bool {
        let is_barred = |fact: &FactId| bits::has(barred, fact.index());
        let goes_beside = |b: ActionId| {
            !self.action(b).preconditions.iter().any(is_barred)
                && self.ways(p).any(|a| !self.compete(mutex, a, b) && !self.interfere(a, b))
        };
        self.ways(p).any(|a| self.action(a).add_effects.contains(&q))
            || self.ways(q).any(goes_beside)
    }

    /// Pairs of facts and actions looked at.
    pub(crate) fn effort(&self) -> u64 {
        self.effort
    }

    /// Memory held, near enough to honour a limit.
    pub(crate) fn bytes(&self) -> usize {
        self.mutex.iter().map(|pairs| pairs.bits.len() * 8).sum::<usize>()
            + self.actions.len() * 128
    }
}
