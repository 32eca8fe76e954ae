//! Sets of facts of which exactly one holds at any time, and what excludes each other because of them.
//!
//! A group is balanced when one of its facts holds at first and each operator gives up as many of them as it brings,
//! having needed them (M. Helmert, 2009, on invariants). What an operator adds though it holds already is not brought: a
//! rule may say once more in which room a place is. That it holds already is known where a fact of another group, which
//! the operator needs, implies it.

use std::collections::{BTreeSet, HashMap};

use crate::strips::{FactId, Operator, OperatorId, Task};
use crate::units::Gather as _;

/// Facts of which exactly one holds at any time.
#[derive(Clone)]
pub(super) struct Group {
    pub(super) number: usize,
    pub(super) facts: BTreeSet<FactId>,
}

impl Group {
    pub(super) fn has(&self, fact: &FactId) -> bool {
        self.facts.contains(fact)
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.facts.iter().any(|fact| other.has(fact))
    }

    /// What an operator needs of the group.
    pub(super) fn needed(&self, operator: &Operator) -> Option<FactId> {
        operator.preconditions.iter().copied().find(|fact| self.has(fact))
    }

    pub(super) fn is_changed_by(&self, operator: &Operator) -> bool {
        operator.del_effects.iter().any(|fact| self.has(fact))
    }

    /// Whether this group is one more part of where the walker is: whatever changes it needs the first, and some of what
    /// changes the first needs it in turn.
    pub(super) fn goes_with(&self, first: &Self, task: &Task) -> bool {
        let changing = |group: &Self| {
            task.operators
                .iter()
                .filter(|operator| group.is_changed_by(operator))
                .collect::<Vec<_>>()
        };
        !self.meets(first)
            && changing(self).iter().all(|operator| first.needed(operator).is_some())
            && changing(first).iter().any(|operator| self.needed(operator).is_some())
    }

    /// Whether whatever changes the group needs a place and moves nowhere.
    pub(super) fn is_hand(&self, task: &Task, walker: &[&Self]) -> bool {
        let mut changers =
            task.operators.iter().filter(|operator| self.is_changed_by(operator)).peekable();
        changers.peek().is_some()
            && changers.all(|operator| {
                !walker.iter().any(|group| group.is_changed_by(operator))
                    && walker.iter().any(|group| group.needed(operator).is_some())
            })
    }
}

/// Whether exactly one of these facts always holds; what an operator only says again is told by `is_implied`.
pub(super) fn is_balanced(
    task: &Task,
    has: impl Fn(&FactId) -> bool,
    mut is_implied: impl FnMut(&Operator, FactId) -> bool,
) -> bool {
    task.init.iter().filter(|fact| has(fact)).count() == 1
        && task.operators.iter().all(|operator| {
            let mut brings = 0;
            for fact in operator.add_effects.iter().filter(|fact| has(fact)) {
                let holds = operator.preconditions.contains(fact) || is_implied(operator, *fact);
                brings += usize::from(!holds);
            }
            let gives = |fact: &&FactId| has(fact) && operator.preconditions.contains(fact);
            let needs = operator.preconditions.iter().filter(|fact| has(fact)).count();
            let deletes = operator.del_effects.iter().filter(|fact| has(fact)).count();
            let given = operator.del_effects.iter().filter(gives).count();
            // What is deleted was needed, so it held; one at most can have held, and one comes for it.
            deletes == given && needs <= 1 && brings == given
        })
}

/// Groups of all facts of a few predicates.
pub(super) struct Groups(pub(super) Vec<Group>);

impl Groups {
    pub(super) fn of(task: &Task) -> Self {
        let mut numbers = HashMap::new();
        let mut names = Vec::with_capacity(task.facts.len());
        for fact in &task.facts {
            let next = numbers.len();
            names.push(*numbers.entry((&fact.predicate, fact.negated)).or_insert(next));
        }
        let mut found: Vec<(BTreeSet<usize>, Group)> = Vec::new();
        let firsts: BTreeSet<usize> = task.init.iter().map(|fact| names[fact.index()]).gather();
        // What is implied by groups that are known may balance others.
        for with_implied in [false, true] {
            let known = Self(found.iter().map(|(_, group)| group.clone()).collect());
            let mut implied = Implied::new(task, &known);
            for &first in &firsts {
                if with_implied && found.iter().any(|(members, _)| members.contains(&first)) {
                    continue;
                }
                let is_implied =
                    |operator: &Operator, fact| with_implied && implied.holds(operator, fact);
                let Some(members) = grown(task, &names, first, is_implied) else { continue };
                if found.iter().any(|(known, _)| *known == members) {
                    continue;
                }
                let facts: BTreeSet<FactId> =
                    task.fact_ids().filter(|fact| members.contains(&names[fact.index()])).gather();
                if facts.len() > 1 {
                    found.push((members, Group { number: found.len(), facts }));
                }
            }
        }
        Self(found.into_iter().map(|(_, group)| group).collect())
    }
}

/// A few predicates, the first among them, whose facts are balanced.
fn grown(
    task: &Task,
    names: &[usize],
    first: usize,
    mut is_implied: impl FnMut(&Operator, FactId) -> bool,
) -> Option<BTreeSet<usize>> {
    const MOST: usize = 4;
    let mut members = BTreeSet::from([first]);
    loop {
        let has = |fact: &FactId| members.contains(&names[fact.index()]);
        if is_balanced(task, has, &mut is_implied) {
            return Some(members);
        }
        // What is given up for a member, or comes for one, may be a member too.
        let other = task.operators.iter().find_map(|operator| {
            let mut brings = 0;
            for &fact in operator.add_effects.iter().filter(|fact| has(fact)) {
                brings += usize::from(!is_implied(operator, fact));
            }
            let gives = operator.del_effects.iter().filter(|fact| has(fact)).count();
            let list = match brings.cmp(&gives) {
                std::cmp::Ordering::Greater => &operator.del_effects,
                std::cmp::Ordering::Less => &operator.add_effects,
                std::cmp::Ordering::Equal => return None,
            };
            // The one with the fewest arguments is the likeliest.
            let outside = list.iter().filter(|fact| !has(fact));
            outside.min_by_key(|fact| task.fact(**fact).args.len()).copied()
        })?;
        if members.len() == MOST {
            return None;
        }
        members.insert(names[other.index()]);
    }
}

/// What holds wherever some other fact does, which a group has.
struct Implied<'a> {
    task: &'a Task,
    group_of: Vec<Option<u32>>,
    added_by: Vec<Vec<OperatorId>>,
    deleted_by: Vec<Vec<OperatorId>>,
    known: HashMap<(FactId, FactId), bool>,
}

impl<'a> Implied<'a> {
    fn new(task: &'a Task, groups: &Groups) -> Self {
        let mut group_of = vec![None; task.facts.len()];
        for group in &groups.0 {
            group.facts.iter().for_each(|f| group_of[f.index()] = Some(group.number as u32));
        }
        let (added_by, deleted_by) = (task.added_by(), task.deleted_by());
        Self { task, group_of, added_by, deleted_by, known: HashMap::new() }
    }

    /// Whether a fact holds wherever an operator can be carried out.
    fn holds(&mut self, operator: &Operator, fact: FactId) -> bool {
        operator.preconditions.iter().any(|&need| {
            self.group_of[need.index()].is_some() && {
                let known = self.known.get(&(need, fact)).copied();
                known.unwrap_or_else(|| {
                    let implies = self.implies(need, fact);
                    self.known.insert((need, fact), implies);
                    implies
                })
            }
        })
    }

    /// Whether one fact always holds beside another of a group: at first, whenever that comes about, and while it holds,
    /// for whoever deletes the one needs another fact of the group, or deletes the other as well.
    fn implies(&self, other: FactId, one: FactId) -> bool {
        let task = self.task;
        let has = |facts: &[FactId], fact: FactId| facts.binary_search(&fact).is_ok();
        let apart = |operator: &Operator| {
            let group = self.group_of[other.index()];
            let elsewhere =
                |need: &&FactId| **need != other && self.group_of[need.index()] == group;
            has(&operator.del_effects, other)
                || operator.preconditions.iter().any(|need| elsewhere(&need))
                    && !has(&operator.add_effects, other)
        };
        (!has(&task.init, other) || has(&task.init, one))
            && self.added_by[other.index()].iter().all(|&id| {
                let operator = task.operator(id);
                let kept = has(&operator.preconditions, one) && !has(&operator.del_effects, one);
                kept || has(&operator.add_effects, one)
            })
            && self.deleted_by[one.index()].iter().all(|&id| apart(task.operator(id)))
    }
}

/// Whether no two of these go into one step.
pub(super) fn all_exclude(task: &Task, groups: &[Group], counted: &[OperatorId]) -> bool {
    let needs = needs(task, groups, counted);
    // Those that need different facts of a group exclude each other; what is left is looked at pair by pair.
    let without = |group: usize| needs.iter().filter(|needs| needs[group].is_none()).count();
    let Some(by) = (0..groups.len()).min_by_key(|&group| without(group)) else { return false };
    let mut alike: HashMap<Option<FactId>, Vec<usize>> = HashMap::new();
    (0..counted.len()).for_each(|at| alike.entry(needs[at][by]).or_default().push(at));
    let anywhere = alike.remove(&None).unwrap_or_default();
    let exclude = |a: usize, b: usize| {
        compete(&needs[a], &needs[b])
            || task.operator(counted[a]).interferes(task.operator(counted[b]))
    };
    let all_among =
        |ones: &[usize]| (0..ones.len()).all(|a| (0..a).all(|b| exclude(ones[a], ones[b])));
    alike.values().all(|ones| all_among(ones))
        && all_among(&anywhere)
        && anywhere.iter().all(|&a| alike.values().flatten().all(|&b| exclude(a, b)))
}

/// Whether none of these goes into one step with any of the others.
pub(super) fn excludes(
    task: &Task,
    groups: &[Group],
    ones: &[OperatorId],
    others: &[OperatorId],
) -> bool {
    let (needs_of_ones, needs_of_others) = (needs(task, groups, ones), needs(task, groups, others));
    ones.iter().zip(&needs_of_ones).all(|(&one, own)| {
        others.iter().zip(&needs_of_others).all(|(&other, needs)| {
            compete(own, needs) || task.operator(one).interferes(task.operator(other))
        })
    })
}

/// What each needs of each group.
fn needs(task: &Task, groups: &[Group], operators: &[OperatorId]) -> Vec<Vec<Option<FactId>>> {
    let of = |&id: &OperatorId| groups.iter().map(|g| g.needed(task.operator(id))).collect();
    operators.iter().map(of).collect()
}

fn compete(one: &[Option<FactId>], other: &[Option<FactId>]) -> bool {
    one.iter().zip(other).any(|(one, other)| one.is_some() && other.is_some() && one != other)
}
