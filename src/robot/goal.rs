//! What a mission's problem states: the facts that are to hold in the end, and those of the initial position.

use crate::semantics::planning::InitialFact;
use crate::strips::Problem;

/// One fact that is to hold in the end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GoalFact {
    pub predicate: String,
    pub args: Vec<String>,
}

/// States a fact of the initial position, and what its arguments are.
pub fn state(problem: &mut Problem, fact: &InitialFact) {
    for argument in &fact.arguments {
        problem.add_object(&argument.name, &[argument.kind]);
    }
    let args: Vec<&str> = fact.arguments.iter().map(|a| a.name.as_str()).collect();
    if fact.assumed {
        problem.add_assumption(fact.predicate, &args);
    } else {
        problem.add_fact(fact.predicate, &args);
    }
}
