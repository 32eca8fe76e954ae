//! How many steps are still to come at least, whatever the state: operators some of which must be carried out in any case,
//! no two of them in one step.
//!
//! A fact that is needed and does not hold must be brought. What all that may bring it first needs must hold before,
//! what they all add comes about, and what they all take from the goal must be brought once more; and so on back
//! (landmarks of the state: J. Hoffmann, J. Porteous, L. Sebastia, 2004). What may not bring it first is what needs a
//! fact that does not hold and that nothing brings before: a block is not taken off one on which it cannot stand yet.
//! The facts counted are chosen once: those that *one hand* brings, a group of operators no two of which go into one
//! step, and each by operators of its own. And the hand must be free for each of those that take it: between any two of
//! them one of the group frees it, and after the last if nothing else brings a goal.

use std::collections::BTreeSet;

use crate::strips::{FactId, Operator, OperatorId, Task};
use crate::{bits, units::Gather as _};

pub(super) struct Ahead {
    goal: Vec<FactId>,
    bringers: Vec<Vec<Bringer>>,
    /// Facts that are counted, by what bringing them does to the hand.
    counts: Vec<Option<Use>>,
    /// The fact that the hand is free, if the group has one, and whether all that brings a goal frees it: then it is free
    /// after the last step.
    hand: Option<FactId>,
    ends_free: bool,
    /// Of each fact when it was last seen as one to be brought.
    seen: Vec<u32>,
    turn: u32,
    /// Facts looked at so far.
    pub(super) effort: u64,
}

/// What all operators that bring a fact do to the hand.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    Takes,
    /// Frees it, or some of them do.
    MayFree,
    LeavesBe,
}

/// An operator that brings a fact.
struct Bringer {
    /// Facts that it needs and that do not come about before the fact that it brings does.
    only_later: Vec<FactId>,
    needs: Vec<FactId>,
    /// What else it adds, and takes from the goal.
    effects: Vec<FactId>,
}

impl Bringer {
    fn new(task: &Task, operator: &Operator, fact: FactId, causes: &[Vec<FactId>]) -> Self {
        let is_later = |need: &&FactId| causes[need.index()].contains(&fact);
        let adds = operator.add_effects.iter().filter(|&&added| added != fact);
        let takes = operator.del_effects.iter().filter(|taken| task.goal.contains(taken));
        Self {
            only_later: operator.preconditions.iter().filter(is_later).copied().collect(),
            needs: operator.preconditions.clone(),
            effects: adds.chain(takes).copied().collect(),
        }
    }
}

impl Ahead {
    /// `groups` are numbers, the same for operators no two of which go into one step.
    pub(super) fn of(task: &Task, groups: &[usize]) -> Self {
        let by = task.added_by();
        // What all that brings a fact needs.
        let causes = |by: &Vec<OperatorId>| -> Vec<FactId> {
            let Some((first, others)) = by.split_first() else { return Vec::new() };
            let needs = |id: &OperatorId| &task.operator(*id).preconditions;
            let by_all = |fact: &&FactId| others.iter().all(|id| needs(id).contains(fact));
            needs(first).iter().filter(by_all).copied().collect()
        };
        let causes: Vec<Vec<FactId>> = by.iter().map(causes).collect();
        let bringers = task.fact_ids().map(|fact| {
            let operators = by[fact.index()].iter().map(|&id| task.operator(id));
            operators.map(|operator| Bringer::new(task, operator, fact, &causes)).collect()
        });
        let mut ahead = Self {
            goal: task.goal.clone(),
            bringers: bringers.collect(),
            counts: vec![None; task.facts.len()],
            hand: None,
            ends_free: false,
            seen: vec![0; task.facts.len()],
            turn: 0,
            effort: 0,
        };
        let needed: Vec<FactId> =
            ahead.wanted(&crate::portfolio::relaxed::initial(task)).unwrap_or_default();
        // What is needed at first goes before what may be needed later, or what few operators bring before the rest.
        let mut by_few: Vec<FactId> = task.fact_ids().collect();
        by_few.sort_by_key(|fact| by[fact.index()].len());
        let as_needed: Vec<FactId> = needed.iter().copied().chain(task.fact_ids()).collect();
        let mut best = (0, Vec::new(), 0);
        let numbers: BTreeSet<usize> = groups.iter().copied().gather();
        for (group, order) in
            numbers.iter().flat_map(|&group| [(group, &as_needed), (group, &by_few)])
        {
            let mut used: BTreeSet<OperatorId> = BTreeSet::new();
            let mut counted = Vec::new();
            for &fact in order {
                let by = &by[fact.index()];
                let are_own = |id: &OperatorId| groups[id.index()] == group && !used.contains(id);
                if !by.is_empty() && by.iter().all(are_own) {
                    used.extend(by);
                    counted.push(fact);
                }
            }
            let count = needed.iter().filter(|fact| counted.contains(fact)).count();
            if count > best.0 {
                best = (count, counted, group);
            }
        }
        let (_, counted, group) = best;
        counted.iter().for_each(|fact| ahead.counts[fact.index()] = Some(Use::LeavesBe));
        ahead.take_hand(task, &by, &needed, |id| groups[id.index()] == group);
        ahead
    }

    /// Finds the fact that most of what is counted and needed at first takes, and that only the group brings.
    fn take_hand(
        &mut self,
        task: &Task,
        by: &[Vec<OperatorId>],
        needed: &[FactId],
        is_own: impl Fn(&OperatorId) -> bool,
    ) {
        let counted: Vec<FactId> =
            task.fact_ids().filter(|fact| self.counts[fact.index()].is_some()).collect();
        let takes = |hand: FactId, fact: FactId| {
            by[fact.index()].iter().all(|&id| {
                let operator = task.operator(id);
                operator.preconditions.contains(&hand) && operator.del_effects.contains(&hand)
            })
        };
        let counts = |fact: &&FactId| self.counts[fact.index()].is_some();
        let taken =
            |hand: FactId| needed.iter().filter(counts).filter(|&&fact| takes(hand, fact)).count();
        let hands = task.fact_ids().filter(|hand| by[hand.index()].iter().all(&is_own));
        let most = hands.map(|hand| (taken(hand), hand)).max_by_key(|&(taken, _)| taken);
        let Some((2.., hand)) = most else { return };
        let frees = |id: &OperatorId| task.operator(*id).add_effects.contains(&hand);
        self.hand = Some(hand);
        self.ends_free = self.goal.iter().all(|goal| by[goal.index()].iter().all(frees));
        for fact in counted {
            self.counts[fact.index()] = Some(match takes(hand, fact) {
                true => Use::Takes,
                false if by[fact.index()].iter().any(frees) => Use::MayFree,
                false => Use::LeavesBe,
            });
        }
    }

    /// None where the goal is out of reach.
    pub(super) fn steps(&mut self, state: &[u64]) -> Option<u32> {
        let wanted = self.wanted(state)?;
        let uses: Vec<Use> = wanted.iter().filter_map(|fact| self.counts[fact.index()]).collect();
        let count = |of: Use| uses.iter().filter(|&&one| one == of).count();
        let Some(hand) = self.hand.filter(|_| !wanted.is_empty()) else {
            return Some(uses.len() as u32);
        };
        // Takers and what frees the hand follow each other in turns.
        let frees = match (bits::has(state, hand.index()), self.ends_free) {
            (true, false) => count(Use::Takes).saturating_sub(1),
            (false, true) => count(Use::Takes) + 1,
            _ => count(Use::Takes),
        };
        Some((uses.len() + frees.saturating_sub(count(Use::MayFree))) as u32)
    }

    /// Facts that must be brought, though some may hold now; none where one of them cannot be.
    fn wanted(&mut self, state: &[u64]) -> Option<Vec<FactId>> {
        self.turn += 1;
        self.effort += self.goal.len() as u64;
        let Self { goal, bringers, seen, turn, effort, .. } = self;
        let holds = |fact: &FactId| bits::has(state, fact.index());
        let mut wanted: Vec<FactId> = Vec::new();
        let mut add = |wanted: &mut Vec<FactId>, fact: FactId| {
            if std::mem::replace(&mut seen[fact.index()], *turn) != *turn {
                wanted.push(fact);
            }
        };
        goal.iter().filter(|goal| !holds(goal)).for_each(|&goal| add(&mut wanted, goal));
        let mut at = 0;
        while let Some(&fact) = wanted.get(at) {
            at += 1;
            let is_first =
                |bringer: &&Bringer| holds(&fact) || bringer.only_later.iter().all(holds);
            let mut first = bringers[fact.index()].iter().filter(is_first);
            let one = first.next()?;
            let mut needs: Vec<FactId> =
                one.needs.iter().copied().filter(|need| !holds(need)).collect();
            let mut effects = one.effects.clone();
            for other in first {
                if needs.is_empty() && effects.is_empty() {
                    break;
                }
                needs.retain(|need| other.needs.contains(need));
                effects.retain(|effect| other.effects.contains(effect));
                *effort += 1;
            }
            *effort += 1 + (needs.len() + effects.len()) as u64;
            needs.into_iter().chain(effects).for_each(|fact| add(&mut wanted, fact));
        }
        Some(wanted)
    }
}
