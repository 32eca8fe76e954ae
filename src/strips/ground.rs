//! From rules and a problem to a [`Task`]: every action over every choice of objects that could ever apply.
//!
//! Relaxed reachability decides what could ever apply ([`super::reachability`]). Predicates that no action changes are
//! looked up and leave no trace in the task; nor do facts that always hold. Each case of a condition beyond literals is a
//! ground action of its own ([`super::cases`]). What is derived is put in place of itself.
//!
//! A negative precondition becomes a fact of its own, kept complementary by every operator that touches the
//! positive one: the planner knows no negation.

use super::domain::Domain;
use super::draft::draft;
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::problem::Problem;
use super::reachability::{Reachability, is_bounded, too_many};
use super::simplify::simplify;
use super::task::Task;

/// Grounds a problem.
///
/// # Errors
/// All names of the problem that mean nothing to the rules, at once; or [`RuleError::TooManyOperators`].
pub fn ground(domain: &Domain, problem: &Problem) -> Result<Task, RuleFaults> {
    ground_while(domain, problem, &is_bounded)?.ok_or_else(too_many)
}

/// Grounds a problem while `may_go_on` says so, asked time and again with the bytes held, near enough; none when it
/// was stopped.
///
/// # Errors
/// All names of the problem that mean nothing to the rules, at once.
pub fn ground_while(
    domain: &Domain,
    problem: &Problem,
    may_go_on: &dyn Fn(usize) -> bool,
) -> Result<Option<Task>, RuleFaults> {
    if !problem.has_goal() {
        return Err(RuleFault::placeless(RuleError::NoGoal).into());
    }
    let resolved = problem.resolve(domain)?;
    let Some(reached) = Reachability::new(domain, &resolved, may_go_on).saturated() else {
        return Ok(None);
    };
    let goes_on = || may_go_on(reached.bytes());
    let draft = draft(domain, &resolved, &reached, &goes_on)?;
    Ok(draft.and_then(|draft| simplify(draft, &goes_on)))
}
