//! A planning problem solved, with all that a person wants to know of the answer.

use std::cell::Cell;

use crate::graphplan::{self, Learned, Limit, Limits, NoPlanReason, Outcome};
use crate::strips::{Domain, FactId, Problem, RuleFaults, Task, explain_unreachable, ground_while};

/// What planning came to, with the task that it was about.
#[derive(Debug, Clone)]
pub struct Solved {
    pub task: Task,
    pub outcome: Outcome,
    /// A plan is proven to have the fewest parallel steps.
    pub is_shortest: bool,
    /// The assumptions that the plan rests on, in the words of the rule files.
    pub assumptions: Vec<String>,
    /// Why there is no plan; none when there is one.
    pub explanation: Option<String>,
}

/// Which plan is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wanted {
    /// The one with the fewest parallel steps, proven.
    #[default]
    Shortest,
    /// Any, soon.
    Any,
}

/// Grounds a problem and finds a plan, or why there is none.
///
/// # Errors
/// The problem names what the rules do not know.
pub fn solve(
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    wanted: Wanted,
) -> Result<Solved, RuleFaults> {
    let (task, outcome) = match grounded(domain, problem, limits)? {
        Ok(task) => {
            let outcome = match wanted {
                Wanted::Shortest => graphplan::solve(&task, limits),
                Wanted::Any => graphplan::solve_any(&task, limits),
            };
            (task, outcome)
        }
        Err(limit) => (Task::default(), Outcome::LimitReached(limit)),
    };
    told(domain, problem, task, outcome, wanted)
}

/// The shortest plan, with what was learned by planning before where that is sound, and what is learned now.
///
/// # Errors
/// As [`solve`].
pub(super) fn solve_again(
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    learned: Option<&Learned>,
) -> Result<(Solved, Option<Learned>), RuleFaults> {
    let (task, (outcome, learned)) = match grounded(domain, problem, limits)? {
        Ok(task) => {
            let solved = graphplan::solve_learning(&task, learned, limits);
            (task, solved)
        }
        Err(limit) => (Task::default(), (Outcome::LimitReached(limit), None)),
    };
    Ok((told(domain, problem, task, outcome, Wanted::Shortest)?, learned))
}

/// The task, or the limit that grounding ran into.
fn grounded(
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
) -> Result<Result<Task, Limit>, RuleFaults> {
    let reached = Cell::new(None);
    let may_go_on = |bytes| {
        reached.set(limits.check(bytes).err());
        reached.get().is_none()
    };
    let task = ground_while(domain, problem, &may_go_on)?;
    Ok(task.ok_or_else(|| reached.get().expect("a limit stopped it")))
}

fn told(
    domain: &Domain,
    problem: &Problem,
    task: Task,
    outcome: Outcome,
    wanted: Wanted,
) -> Result<Solved, RuleFaults> {
    let is_shortest = wanted == Wanted::Shortest;
    let assumptions = match &outcome {
        Outcome::Plan(plan) => {
            plan.assumptions(&task).iter().map(|&f| task.fact(f).to_string()).collect()
        }
        _ => Vec::new(),
    };
    let explanation = explain(domain, problem, &task, &outcome)?;
    Ok(Solved { task, outcome, is_shortest, assumptions, explanation })
}

fn explain(
    domain: &Domain,
    problem: &Problem,
    task: &Task,
    outcome: &Outcome,
) -> Result<Option<String>, RuleFaults> {
    let fact = |id: FactId| task.fact(id).to_string();
    Ok(Some(match outcome {
        Outcome::Plan(_) => return Ok(None),
        Outcome::NoPlan { reason: NoPlanReason::Unreachable(facts), .. } => {
            let goals = facts.iter().map(|&id| task.fact(id));
            let obstacles = explain_unreachable(domain, problem, goals)?;
            obstacles.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        }
        Outcome::NoPlan { reason: NoPlanReason::Exclusive(pairs), .. } => {
            let pairs: Vec<String> =
                pairs.iter().map(|&(a, b)| format!("{} и {}", fact(a), fact(b))).collect();
            format!("цели исключают друг друга: {}", pairs.join("; "))
        }
        Outcome::NoPlan { reason: NoPlanReason::Together(facts), .. } => {
            let facts: Vec<String> = facts.iter().map(|&id| fact(id)).collect();
            format!("цели недостижимы все вместе: {}", facts.join(", "))
        }
        Outcome::LimitReached(Limit::Time) => "время вышло раньше, чем нашёлся план".to_owned(),
        Outcome::LimitReached(Limit::Memory) => "память вышла раньше, чем нашёлся план".to_owned(),
        Outcome::LimitReached(Limit::Steps) => {
            "плана нет в пределах наибольшего числа шагов".to_owned()
        }
    }))
}
