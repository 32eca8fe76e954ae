//! What is said to help where there is no plan, tried: a plan is sought with those facts stated, and what is proven to bring
//! none is not said.
//!
//! The search for what is lacking goes backward from one goal, by what actions give; that an action on the way takes
//! something else away, or that a condition has more to it, only a plan shows.
//!
//! **Invariant**: of each set of facts that is left and names its objects it is not proven that there is no plan with it,
//! stated beside those that help the other goals; where another goal is past help, for the one goal alone.

use super::grounding::grounded;
use crate::graphplan::{self, Limits, Outcome};
use crate::strips::{Domain, Obstacle, Problem, Said, SaidArgument};

/// What one search may take.
const EFFORT: u64 = Limits::TO_START / 8;
/// Leaves of what would help only what does.
pub(super) fn keep_what_helps(
    domain: &Domain,
    problem: &Problem,
    obstacles: &mut [Obstacle],
    limits: &Limits,
) {
    let limits = Limits { effort: Some(EFFORT), ..limits.quiet() };
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

/// Whether there may be a plan once some facts are stated, and those that are said to fail withdrawn: it is not proven that
/// there is none. Of an open place any one object might do, and nothing is proven.
fn is_solved(domain: &Domain, problem: &Problem, facts: &[Said], limits: &Limits) -> bool {
    let mut stated = problem.clone();
    for fact in facts {
        let mut args = Vec::new();
        for argument in &fact.args {
            let SaidArgument::Object(name) = argument else { return true };
            args.push(name.as_str());
        }
        match fact.negated {
            true => drop(stated.withdraw(&fact.name, &args)),
            false => stated.add_fact(&fact.name, &args),
        }
    }
    let Ok(Ok(task)) = grounded(domain, &stated, limits) else { return true };
    let whatever = Limits { shorten: 0, ..limits.clone() };
    !matches!(graphplan::solve_any(&task, &whatever), Outcome::NoPlan { .. })
}
