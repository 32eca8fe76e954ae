//! The last step of grounding: complementary facts for negations, then everything dropped that cannot matter.
//!
//! What is dropped is dropped soundly: operators that can never apply or never help, facts that always hold,
//! facts that never do. A fact stays all the same where two operators interfere through it, though nothing needs it
//! or it always holds: a plan's number of parallel steps must not depend on grounding.

use std::collections::{BTreeSet, VecDeque};

use super::bystander::bystanders;
use super::draft::{Draft, DraftOperator};
use super::task::{Fact, FactId, Operator, Task};
use crate::units::Gather as _;

/// The task without what cannot change the fewest number of steps; none when it was stopped.
pub(super) fn simplify(mut draft: Draft, goes_on: &dyn Fn() -> bool) -> Option<Task> {
    let mut facts: Vec<Fact> = draft
        .facts
        .drain(..)
        .map(|(predicate, args)| Fact { predicate, args, negated: false })
        .collect();
    let goal = complement(&mut draft, &mut facts);
    let reachable = reachable(&draft, facts.len());
    keep(&mut draft.operators, reachable);
    let bystanders = bystanders(&draft, &facts, &goal, goes_on)?;
    keep(&mut draft.operators, bystanders);
    if !goes_on() {
        return None;
    }
    let fixed = always_true(&draft, facts.len());
    let goal: Vec<u32> = goal.into_iter().filter(|&fact| !fixed[fact as usize]).collect();
    let relevant = relevant(&draft, &goal, &fixed);
    keep(&mut draft.operators, relevant.operators);
    goes_on().then(|| renumber(draft, &facts, &goal, &relevant.facts))
}

/// Adds "not p" for every p whose absence is asked for; returns the goal in positive facts alone.
fn complement(draft: &mut Draft, facts: &mut Vec<Fact>) -> Vec<u32> {
    let negated_goals = draft.goal.iter().filter(|(_, negated)| *negated).map(|&(fact, _)| fact);
    let wanted: BTreeSet<u32> = draft
        .operators
        .iter()
        .flat_map(|o| o.negative.iter().copied())
        .chain(negated_goals)
        .gather();
    let mut complement_of = vec![None; facts.len()];
    let initially: BTreeSet<u32> = draft.init.iter().copied().gather();
    for &fact in &wanted {
        let number = facts.len() as u32;
        complement_of[fact as usize] = Some(number);
        facts.push(Fact { negated: true, ..facts[fact as usize].clone() });
        if !initially.contains(&fact) {
            draft.init.push(number);
        }
    }
    let complement = |fact: u32| complement_of[fact as usize];
    for operator in &mut draft.operators {
        let negative = std::mem::take(&mut operator.negative);
        operator.preconditions.extend(negative.into_iter().filter_map(complement));
        // An action adds after it deletes, as in PDDL.
        let is_added = |fact: &u32| operator.add_effects.contains(fact);
        let (renewed, deleted): (Vec<u32>, Vec<u32>) =
            std::mem::take(&mut operator.del_effects).into_iter().partition(is_added);
        operator.renewed.extend(renewed);
        operator.del_effects = deleted;
        let gained: Vec<u32> =
            operator.del_effects.iter().filter_map(|&fact| complement(fact)).collect();
        let lost: Vec<u32> =
            operator.add_effects.iter().filter_map(|&fact| complement(fact)).collect();
        operator.add_effects.extend(gained);
        operator.del_effects.extend(lost);
        for list in
            [&mut operator.preconditions, &mut operator.add_effects, &mut operator.del_effects]
        {
            list.sort_unstable();
            list.dedup();
        }
    }
    let mut goal: Vec<u32> = draft
        .goal
        .iter()
        .map(|&(fact, negated)| if negated { complement(fact).expect("made above") } else { fact })
        .collect();
    if draft.impossible {
        goal.push(facts.len() as u32);
        facts.push(Fact { predicate: NO_CASE.into(), args: Vec::new(), negated: false });
    }
    goal
}

/// The fact that a goal comes to of which no case can come about.
pub(super) const NO_CASE: &str = "≠";

/// Which operators the relaxed problem ever applies, complements counted.
fn reachable(draft: &Draft, fact_count: usize) -> Vec<bool> {
    let mut waiting: Vec<Vec<u32>> = vec![Vec::new(); fact_count];
    let mut missing: Vec<usize> = Vec::with_capacity(draft.operators.len());
    let mut holds = vec![false; fact_count];
    let mut queue: VecDeque<u32> = VecDeque::new();
    let mut reach = |fact: u32, queue: &mut VecDeque<u32>| {
        if !std::mem::replace(&mut holds[fact as usize], true) {
            queue.push_back(fact);
        }
    };
    for (number, operator) in draft.operators.iter().enumerate() {
        missing.push(operator.preconditions.len());
        for &fact in &operator.preconditions {
            waiting[fact as usize].push(number as u32);
        }
        if operator.preconditions.is_empty() {
            operator.add_effects.iter().for_each(|&fact| reach(fact, &mut queue));
        }
    }
    draft.init.iter().for_each(|&fact| reach(fact, &mut queue));
    while let Some(fact) = queue.pop_front() {
        for &number in &waiting[fact as usize] {
            missing[number as usize] -= 1;
            if missing[number as usize] == 0 {
                let operator = &draft.operators[number as usize];
                operator.add_effects.iter().for_each(|&fact| reach(fact, &mut queue));
            }
        }
    }
    missing.into_iter().map(|count| count == 0).collect()
}

fn keep(operators: &mut Vec<DraftOperator>, keep: Vec<bool>) {
    let mut keep = keep.into_iter();
    operators.retain(|_| keep.next().expect("one flag an operator"));
}

/// Facts that hold at first and that nothing deletes. Assumptions stay, so that a plan can name them.
fn always_true(draft: &Draft, fact_count: usize) -> Vec<bool> {
    let mut fixed = vec![false; fact_count];
    draft.init.iter().for_each(|&fact| fixed[fact as usize] = true);
    draft.assumptions.iter().for_each(|&fact| fixed[fact as usize] = false);
    for operator in &draft.operators {
        operator.del_effects.iter().for_each(|&fact| fixed[fact as usize] = false);
    }
    fixed
}

struct Relevant {
    facts: Vec<bool>,
    operators: Vec<bool>,
}

/// What the goal can be traced back to, but for what always holds; and through what operators interfere.
fn relevant(draft: &Draft, goal: &[u32], fixed: &[bool]) -> Relevant {
    let fact_count = fixed.len();
    let mut achievers: Vec<Vec<u32>> = vec![Vec::new(); fact_count];
    for (number, operator) in draft.operators.iter().enumerate() {
        operator.add_effects.iter().for_each(|&f| achievers[f as usize].push(number as u32));
    }
    let mut facts = vec![false; fact_count];
    let mut operators = vec![false; draft.operators.len()];
    let mut open: Vec<u32> = goal.to_vec();
    while let Some(fact) = open.pop() {
        if std::mem::replace(&mut facts[fact as usize], true) {
            continue;
        }
        for &number in &achievers[fact as usize] {
            if !std::mem::replace(&mut operators[number as usize], true) {
                let needs = draft.operators[number as usize].preconditions.iter();
                open.extend(needs.filter(|need| !fixed[**need as usize]));
            }
        }
    }
    // Facts through which two operators interfere: one adds and another deletes it; or one renews it, and another has
    // any use of it.
    let (mut added, mut deleted) = (vec![false; fact_count], vec![false; fact_count]);
    let (mut renewed, mut users) = (vec![false; fact_count], vec![0; fact_count]);
    for (operator, _) in draft.operators.iter().zip(&operators).filter(|(_, relevant)| **relevant) {
        operator.add_effects.iter().for_each(|&fact| added[fact as usize] = true);
        operator.del_effects.iter().for_each(|&fact| deleted[fact as usize] = true);
        operator.renewed.iter().for_each(|&fact| renewed[fact as usize] = true);
        let needs_only =
            operator.preconditions.iter().filter(|f| !operator.add_effects.contains(f));
        needs_only.chain(&operator.add_effects).for_each(|&fact| users[fact as usize] += 1);
    }
    for fact in 0..fact_count {
        facts[fact] |= added[fact] && deleted[fact] || renewed[fact] && users[fact] > 1;
    }
    Relevant { facts, operators }
}

fn renumber(draft: Draft, facts: &[Fact], goal: &[u32], relevant: &[bool]) -> Task {
    let mut number_of = vec![None; facts.len()];
    let mut task = Task::default();
    for (old, fact) in facts.iter().enumerate().filter(|(old, _)| relevant[*old]) {
        number_of[old] = Some(FactId(task.facts.len() as u32));
        task.facts.push(fact.clone());
    }
    let translate = |facts: &[u32]| -> Vec<FactId> {
        let mut ids: Vec<FactId> =
            facts.iter().filter_map(|&fact| number_of[fact as usize]).collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    };
    task.goal_steps = draft.operators.iter().filter(|operator| operator.meets_goal).count();
    task.operators = draft
        .operators
        .into_iter()
        .map(|operator| Operator {
            preconditions: translate(&operator.preconditions),
            add_effects: translate(&operator.add_effects),
            del_effects: translate(&operator.del_effects),
            renewed: translate(&operator.renewed),
            name: operator.name,
            args: operator.args,
            cost: operator.cost,
        })
        .collect();
    task.init = translate(&draft.init);
    task.goal = translate(goal);
    task.assumptions = translate(&draft.assumptions);
    task
}
