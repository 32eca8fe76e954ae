//! Objects that are alike for what is still to be done: states that differ by an exchange of them are equally far from
//! the goal, so of each kind one is enough (N. Pochter, A. Zohar, J. Rosenschein, 2011, "exploiting problem symmetries in
//! state-based planners").
//!
//! Where the objects are now plays no part, unlike in [`super::super::symmetry`]: crates that are wanted in the same room
//! are alike wherever they stand. An exchange turns the operators and the goal into themselves. A fact that only one of
//! the two can be part of tells what must be exchanged along with them: the crate that stands in its own container.

use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use crate::bits;
use crate::strips::{Fact, FactId, Operator, Task};
use crate::units::InOrder as _;

/// More facts of one object are not looked at.
const MOST_FACTS: usize = 128;

/// More objects do not change places together.
const MOST_LINKED: usize = 16;

/// Comparing more than this takes too long.
const MOST_WORK: usize = 1 << 22;

/// For each class, for each object of it, the facts about it, in the same order for all.
pub(super) struct Alike {
    classes: Vec<Vec<Vec<usize>>>,
    /// Facts looked at so far, some at once.
    pub(super) effort: u64,
}

impl Alike {
    pub(super) fn of(task: &Task) -> Self {
        let index = Index::new(task);
        let mut classes = Vec::new();
        let mut work = 0;
        for objects in index.of_a_kind() {
            let mut left = objects;
            while let Some((first, others)) = left.split_first().filter(|(_, o)| !o.is_empty()) {
                let mut class: Vec<Vec<usize>> = Vec::new();
                let mut rest = Vec::new();
                for other in others {
                    work += index.size_of(first);
                    let exchange =
                        if work < MOST_WORK { index.exchange(first, other) } else { None };
                    let fits = |(own, _): &(Vec<usize>, Vec<usize>)| {
                        own.len() <= MOST_FACTS && class.first().is_none_or(|known| known == own)
                    };
                    match exchange.filter(fits) {
                        Some((own, image)) => {
                            if class.is_empty() {
                                class.push(own);
                            }
                            class.push(image);
                        }
                        None => rest.push(*other),
                    }
                }
                if !class.is_empty() {
                    classes.push(class);
                }
                left = rest;
            }
        }
        // A fact is exchanged in one way only: then each class has its order apart from the others.
        classes.order_by_key(|class| Reverse(class.len()));
        let mut taken: HashSet<usize> = HashSet::new();
        classes.retain(|class| {
            let is_apart = class.iter().flatten().all(|fact| !taken.contains(fact));
            if is_apart {
                taken.extend(class.iter().flatten());
            }
            is_apart
        });
        Self { classes, effort: 0 }
    }

    /// How many classes there are.
    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.classes.len()
    }

    /// Of all states that differ by exchanges of what is alike, the same one.
    pub(super) fn represent(&mut self, state: &mut [u64]) {
        let mut columns: Vec<u128> = Vec::new();
        for class in &self.classes {
            columns.clear();
            columns.extend(class.iter().map(|facts| {
                let held = facts.iter().enumerate().filter(|(_, fact)| bits::has(state, **fact));
                held.fold(0_u128, |column, (at, _)| column | 1 << at)
            }));
            self.effort += (class.len() * (2 + class[0].len() / 4)) as u64;
            if columns.is_sorted() {
                continue;
            }
            columns.sort_unstable();
            for (facts, column) in class.iter().zip(&columns) {
                for (at, &fact) in facts.iter().enumerate() {
                    if column >> at & 1 == 1 {
                        bits::put(state, fact);
                    } else {
                        bits::take(state, fact);
                    }
                }
            }
        }
    }
}

type Key<'a> = (&'a str, bool, Vec<&'a str>);
type Lists = [Vec<FactId>; 4];
/// A predicate, and at which of its places an object is.
type Said<'a> = (&'a str, bool, Vec<bool>);

struct Index<'a> {
    task: &'a Task,
    facts: HashMap<Key<'a>, usize>,
    facts_of: BTreeMap<&'a str, Vec<usize>>,
    /// Operators that need or change each fact.
    users: Vec<Vec<usize>>,
    operators: HashSet<Lists>,
}

/// What an object takes the place of, and on which of the two sides of the exchange it is.
type Exchanged<'a> = BTreeMap<&'a str, (&'a str, bool)>;

impl<'a> Index<'a> {
    fn new(task: &'a Task) -> Self {
        let mut facts_of: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (number, fact) in task.facts.iter().enumerate() {
            for arg in &fact.args {
                let facts = facts_of.entry(arg).or_default();
                if facts.last() != Some(&number) {
                    facts.push(number);
                }
            }
        }
        let mut users = vec![Vec::new(); task.facts.len()];
        for (number, operator) in task.operators.iter().enumerate() {
            for fact in lists(operator).into_iter().flatten() {
                let users: &mut Vec<usize> = &mut users[fact.index()];
                if users.last() != Some(&number) {
                    users.push(number);
                }
            }
        }
        let facts = task.facts.iter().map(key).zip(0..).collect();
        let operators = task.operators.iter().map(lists).collect();
        Self { task, facts, facts_of, users, operators }
    }

    /// Objects of which the same can be said.
    fn of_a_kind(&self) -> Vec<Vec<&'a str>> {
        let mut kinds: BTreeMap<Vec<Said>, Vec<&str>> = BTreeMap::new();
        for (&object, facts) in &self.facts_of {
            let said = |&number: &usize| {
                let Fact { predicate, negated, args } = &self.task.facts[number];
                (&**predicate, *negated, args.iter().map(|arg| &**arg == object).collect())
            };
            let mut kind: Vec<_> = facts.iter().map(said).collect();
            kind.sort_unstable();
            kinds.entry(kind).or_default().push(object);
        }
        kinds.into_values().collect()
    }

    /// What an exchange of the object looks at.
    fn size_of(&self, object: &str) -> usize {
        let facts = self.facts_of.get(object).into_iter().flatten();
        facts.map(|&fact| 1 + self.users[fact].len()).sum()
    }

    /// Facts about the one object, and what they are turned into when the two, and what goes with them, change places;
    /// none where operators or goal do not stay the same.
    fn exchange(&self, a: &'a str, b: &'a str) -> Option<(Vec<usize>, Vec<usize>)> {
        let mut exchanged = Exchanged::from([(a, (b, false)), (b, (a, true))]);
        while let Some(lacks) = self.lacking(&exchanged) {
            if exchanged.len() > MOST_LINKED || !self.link(lacks, &mut exchanged) {
                return None;
            }
        }
        let mut image: BTreeMap<usize, usize> = BTreeMap::new();
        let mut own = Vec::new();
        for (object, (_, is_other)) in &exchanged {
            for &fact in &self.facts_of[object] {
                // What speaks of both sides at once is not told apart by objects.
                let args = &self.task.facts[fact].args;
                let sides = args.iter().filter_map(|arg| exchanged.get(&**arg));
                if sides.into_iter().any(|(_, side)| side != is_other) {
                    return None;
                }
                let is_new = image.insert(fact, self.image(fact, &exchanged)?).is_none();
                if is_new && !is_other {
                    own.push(fact);
                }
            }
        }
        own.sort_unstable();
        let in_goal = |fact: usize| self.task.goal.contains(&FactId(fact as u32));
        let serves = image.iter().all(|(&fact, &image)| in_goal(fact) == in_goal(image));
        let turned = |mut facts: Vec<FactId>| {
            for fact in &mut facts {
                *fact = image.get(&fact.index()).map_or(*fact, |&image| FactId(image as u32));
            }
            facts.sort_unstable();
            facts
        };
        let touched: HashSet<usize> =
            image.keys().flat_map(|&fact| &self.users[fact]).copied().collect();
        let stays = |number: usize| {
            self.operators.contains(&lists(&self.task.operators[number]).map(&turned))
        };
        (serves && touched.into_iter().all(stays))
            .then(|| (own.clone(), own.iter().map(|fact| image[fact]).collect()))
    }

    /// A fact about what changes places that there would not be afterwards.
    fn lacking(&self, exchanged: &Exchanged<'a>) -> Option<usize> {
        let mut facts = exchanged.keys().flat_map(|object| &self.facts_of[object]).copied();
        facts.find(|&fact| self.image(fact, exchanged).is_none())
    }

    fn renamed(&self, fact: usize, exchanged: &Exchanged<'a>) -> Key<'a> {
        let (predicate, negated, mut args) = key(&self.task.facts[fact]);
        for arg in &mut args {
            *arg = exchanged.get(arg).map_or(*arg, |(other, _)| other);
        }
        (predicate, negated, args)
    }

    fn image(&self, fact: usize, exchanged: &Exchanged<'a>) -> Option<usize> {
        self.facts.get(&self.renamed(fact, exchanged)).copied()
    }

    /// Finds what a fact without an image is to be turned into: one that lacks an image just so, and differs from it in
    /// objects that stay where they are so far. These change places too.
    fn link(&self, lacks: usize, exchanged: &mut Exchanged<'a>) -> bool {
        let (predicate, negated, wanted) = self.renamed(lacks, exchanged);
        let own = key(&self.task.facts[lacks]).2;
        let Some((by, side)) = own.iter().find_map(|arg| exchanged.get(arg)).copied() else {
            return false;
        };
        let answers = |&&other: &&usize| {
            let (other_predicate, other_negated, args) = key(&self.task.facts[other]);
            let fits = |(wanted, arg): (&&str, &&str)| {
                wanted == arg || !exchanged.contains_key(wanted) && !exchanged.contains_key(arg)
            };
            (other_predicate, other_negated, args.len()) == (predicate, negated, wanted.len())
                && wanted.iter().zip(&args).all(fits)
                && self.image(other, exchanged).is_none()
        };
        let Some(&answer) = self.facts_of[by].iter().find(answers) else { return false };
        for (one, other) in own.into_iter().zip(key(&self.task.facts[answer]).2) {
            if one != other && !exchanged.contains_key(one) && !exchanged.contains_key(other) {
                exchanged.insert(one, (other, side));
                exchanged.insert(other, (one, !side));
            }
        }
        true
    }
}

fn key(fact: &Fact) -> Key<'_> {
    (&fact.predicate, fact.negated, fact.args.iter().map(Arc::as_ref).collect())
}

fn lists(operator: &Operator) -> Lists {
    let Operator { preconditions, add_effects, del_effects, renewed, .. } = operator;
    [preconditions, add_effects, del_effects, renewed].map(Clone::clone)
}
