//! Objects that no plan needs to touch: the fifty things in a flat that a robot could pick up, to no purpose.
//!
//! Relevance alone keeps them, for putting one down frees the hand. But the hand was free before the thing was
//! taken. An object is a bystander when every action about it that gives some other fact only gives back what
//! taking the object had cost:
//!
//! - the other fact `f` (the hand is free) belongs to a group of facts of which at most one ever holds, and which
//!   hold in exchange for `f`: every action that adds one of them needs and deletes `f`;
//! - the action needs one of them that is about the object (the robot holds it), and that does not hold at first;
//! - whoever deletes `f` needs it.
//!
//! Leave such actions out of a plan, and what remains is a plan: between taking and giving back nobody else
//! could use `f`, and without the two it simply goes on to hold. So the number of steps needed does not change.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use super::draft::Draft;
use super::task::Fact;

/// One flag an operator: false for those that concern bystanders; none when it was stopped.
pub(super) fn bystanders(
    draft: &Draft,
    facts: &[Fact],
    goal: &[u32],
    goes_on: &dyn Fn() -> bool,
) -> Option<Vec<bool>> {
    let index = Index::new(draft, facts.len());
    let wanted: HashSet<&Arc<str>> =
        goal.iter().flat_map(|&fact| &facts[fact as usize].args).collect();
    let mut about: BTreeMap<&Arc<str>, Vec<u32>> = BTreeMap::new();
    for (number, fact) in facts.iter().enumerate() {
        for object in fact.args.iter().filter(|object| !wanted.contains(object)) {
            about.entry(object).or_default().push(number as u32);
        }
    }
    let mut groups = HashMap::new();
    let mut kept = vec![true; draft.operators.len()];
    for own in about.values() {
        if !goes_on() {
            return None;
        }
        let own: HashSet<u32> = own.iter().copied().collect();
        let concerned: HashSet<u32> =
            own.iter().flat_map(|&fact| &index.touched_by[fact as usize]).copied().collect();
        let idle = concerned.iter().all(|&number| {
            let operator = &draft.operators[number as usize];
            let gained = operator.add_effects.iter().filter(|fact| !own.contains(fact));
            let mut gained = gained.copied();
            gained.all(|fact| {
                let group = groups.entry(fact).or_insert_with(|| index.group(draft, fact));
                let traded = |need: &u32| {
                    own.contains(need) && group.contains(need) && !index.initially[*need as usize]
                };
                operator.preconditions.iter().any(traded)
            })
        });
        if idle {
            concerned.into_iter().for_each(|number| kept[number as usize] = false);
        }
    }
    Some(kept)
}

struct Index {
    /// Operators that need, add or delete a fact.
    touched_by: Vec<Vec<u32>>,
    initially: Vec<bool>,
}

impl Index {
    fn new(draft: &Draft, fact_count: usize) -> Self {
        let mut touched_by: Vec<Vec<u32>> = vec![Vec::new(); fact_count];
        for (number, operator) in draft.operators.iter().enumerate() {
            let lists = [&operator.preconditions, &operator.add_effects, &operator.del_effects];
            for &fact in lists.into_iter().flatten() {
                let numbers = &mut touched_by[fact as usize];
                if numbers.last() != Some(&(number as u32)) {
                    numbers.push(number as u32);
                }
            }
        }
        let mut initially = vec![false; fact_count];
        draft.init.iter().for_each(|&fact| initially[fact as usize] = true);
        Self { touched_by, initially }
    }

    /// The facts that hold in exchange for `fact`, if at most one of all of them and of `fact` ever holds and
    /// nobody deletes `fact` without needing it; else none.
    fn group(&self, draft: &Draft, fact: u32) -> HashSet<u32> {
        let operators = |fact: u32| {
            self.touched_by[fact as usize].iter().map(|&number| &draft.operators[number as usize])
        };
        let takes = |fact: u32, operator: &super::draft::DraftOperator| {
            operator.preconditions.contains(&fact) && operator.del_effects.contains(&fact)
        };
        if operators(fact)
            .any(|o| o.del_effects.contains(&fact) && !o.preconditions.contains(&fact))
        {
            return HashSet::new();
        }
        let candidates: HashSet<u32> = operators(fact)
            .filter(|operator| takes(fact, operator))
            .flat_map(|operator| operator.add_effects.iter().copied())
            .collect();
        let group: HashSet<u32> = candidates
            .into_iter()
            .filter(|&other| {
                operators(other).all(|o| !o.add_effects.contains(&other) || takes(fact, o))
            })
            .collect();
        let members = || group.iter().copied().chain([fact]);
        let balanced = members().flat_map(operators).all(|operator| {
            let within = |f: &&u32| **f == fact || group.contains(f);
            let added = operator.add_effects.iter().filter(within).count();
            let taken = operator
                .preconditions
                .iter()
                .filter(within)
                .filter(|f| operator.del_effects.contains(f))
                .count();
            added <= taken.min(1)
        });
        let held = members().filter(|&f| self.initially[f as usize]).count();
        if balanced && held <= 1 { group } else { HashSet::new() }
    }
}
