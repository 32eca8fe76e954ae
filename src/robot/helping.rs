//! What is said to help where there is no plan, tried: a plan is sought with those facts stated, and what brings none is
//! not said.
//!
//! The search for what is lacking goes backward from one goal, by what actions give; that an action on the way takes
//! something else away, or that a condition has more to it, only a plan shows.
//!
//! **Invariant**: with each set of facts that is left, stated beside those that help the other goals, there is a plan; where
//! another goal is past help, for the one goal alone.

use super::grounding::grounded;
use crate::graphplan::{self, Limits, Outcome};
use crate::strips::{Domain, Obstacle, Problem, Said, SaidArgument};

/// What one search may take.
const EFFORT: u64 = Limits::TO_START / 8;
/// So many objects are tried where any one of a type is said to help.
const MOST_TRIED: usize = 8;
/// An object that is not there yet.
const NEW: &str = "new-object";

/// Leaves of what would help only what does.
pub(super) fn keep_what_helps(
    domain: &Domain,
    problem: &Problem,
    obstacles: &mut [Obstacle],
    limits: &Limits,
) {
    let limits = Limits { effort: Some(EFFORT), tell: None, tell_bound: None, ..limits.clone() };
    let first: Vec<Option<Vec<Said>>> =
        obstacles.iter().map(|obstacle| obstacle.help.first().cloned()).collect();
    for (number, obstacle) in obstacles.iter_mut().enumerate() {
        let others = first.iter().enumerate().filter(|(other, _)| *other != number);
        let others: Option<Vec<Vec<Said>>> = others.map(|(_, help)| help.clone()).collect();
        let helps = |facts: &Vec<Said>| match &others {
            Some(others) => {
                let all: Vec<Said> = others.iter().flatten().chain(facts).cloned().collect();
                is_solved(domain, problem, &all, &limits)
            }
            None => {
                let alone = problem.for_goal(&obstacle.goal);
                alone.is_some_and(|alone| is_solved(domain, &alone, facts, &limits))
            }
        };
        let mut help = std::mem::take(&mut obstacle.help);
        help.retain(helps);
        obstacle.help = help;
    }
}

/// Whether there is a plan once some facts are stated, and those that are said to fail withdrawn. Of an open place any one
/// object will do.
fn is_solved(domain: &Domain, problem: &Problem, facts: &[Said], limits: &Limits) -> bool {
    let open = |fact: &Said| {
        let is_open = |argument: &SaidArgument| matches!(argument, SaidArgument::Any(_));
        fact.args.iter().any(is_open)
    };
    let tried: Vec<&str> = match facts.iter().any(open) {
        true => std::iter::once(NEW).chain(problem.mentioned_objects()).collect(),
        false => vec![NEW],
    };
    let with = |object: &str| {
        let mut stated = problem.clone();
        for fact in facts {
            let args: Vec<&str> = fact
                .args
                .iter()
                .map(|argument| match argument {
                    SaidArgument::Object(name) => name.as_str(),
                    SaidArgument::Any(kinds) if object == NEW => {
                        let kinds: Vec<&str> = kinds.iter().take(1).map(String::as_str).collect();
                        stated.add_object(NEW, &kinds);
                        NEW
                    }
                    SaidArgument::Any(_) => object,
                })
                .collect();
            match fact.negated {
                true => drop(stated.withdraw(&fact.name, &args)),
                false => stated.add_fact(&fact.name, &args),
            }
        }
        // An object of another type is none of which the fact can be stated.
        grounded(domain, &stated, limits).ok()?.ok()
    };
    let tasks = tried.into_iter().filter_map(with).take(MOST_TRIED);
    tasks.into_iter().any(|task| matches!(graphplan::solve_any(&task, limits), Outcome::Plan(_)))
}
