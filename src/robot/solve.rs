//! A planning problem solved, with all that a person wants to know of the answer.

use std::cell::Cell;

use crate::graphplan::{self, Learned, Limit, Limits, NoPlanReason, Outcome};
use crate::strips::{
    Clash, Domain, FactId, Obstacle, Problem, RuleFaults, Task, explain_unreachable, ground_while,
};
use crate::units::Language;

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
    pub reason: Option<Reason>,
}

/// Why there is no plan, or none was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reason {
    Unreachable(Vec<Obstacle>),
    /// Pairs of goals that exclude each other.
    Exclusive(Vec<(String, String)>),
    /// Goals that cannot all hold at once.
    Together(Vec<String>),
    Limit(Limit),
}

impl Reason {
    #[must_use]
    pub fn in_words(&self, language: Language) -> String {
        match self {
            Self::Unreachable(obstacles) => {
                let told: Vec<String> = obstacles.iter().map(|o| o.in_words(language)).collect();
                told.join("\n")
            }
            Self::Exclusive(pairs) => {
                let and = language.pick("и", "and");
                let pairs: Vec<String> =
                    pairs.iter().map(|(a, b)| format!("{a} {and} {b}")).collect();
                let head =
                    language.pick("цели исключают друг друга", "the goals exclude each other");
                format!("{head}: {}", pairs.join("; "))
            }
            Self::Together(facts) => {
                let head = language
                    .pick("цели недостижимы все вместе", "the goals are out of reach all together");
                format!("{head}: {}", facts.join(", "))
            }
            Self::Limit(limit) => match limit {
                Limit::Time => language.pick(
                    "время вышло раньше, чем нашёлся план",
                    "the time was up before a plan was found",
                ),
                Limit::Memory => language.pick(
                    "память вышла раньше, чем нашёлся план",
                    "the memory was used up before a plan was found",
                ),
                Limit::Steps => language.pick(
                    "плана нет в пределах наибольшего числа шагов",
                    "there is no plan within the greatest number of steps",
                ),
            }
            .to_owned(),
        }
    }
}

impl Solved {
    /// Why there is no plan, in words; none when there is one.
    #[must_use]
    pub fn explanation(&self, language: Language) -> Option<String> {
        self.reason.as_ref().map(|reason| reason.in_words(language))
    }
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
    told(domain, problem, task, outcome, wanted, limits)
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
    Ok((told(domain, problem, task, outcome, Wanted::Shortest, limits)?, learned))
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
    limits: &Limits,
) -> Result<Solved, RuleFaults> {
    let is_shortest = wanted == Wanted::Shortest;
    let assumptions = match &outcome {
        Outcome::Plan(plan) => {
            plan.assumptions(&task).iter().map(|&f| task.fact(f).to_string()).collect()
        }
        _ => Vec::new(),
    };
    let reason = explain(domain, problem, &task, &outcome, limits)?;
    Ok(Solved { task, outcome, is_shortest, assumptions, reason })
}

fn explain(
    domain: &Domain,
    problem: &Problem,
    task: &Task,
    outcome: &Outcome,
    limits: &Limits,
) -> Result<Option<Reason>, RuleFaults> {
    let fact = |id: FactId| task.fact(id).to_string();
    Ok(Some(match outcome {
        Outcome::Plan(_) => return Ok(None),
        Outcome::NoPlan { reason: NoPlanReason::Unreachable(facts), .. } => {
            let goals = facts.iter().map(|&id| task.fact(id));
            let mut obstacles = explain_unreachable(domain, problem, goals)?;
            for (obstacle, &goal) in obstacles.iter_mut().zip(facts) {
                if obstacle.is_met_singly {
                    obstacle.clash = clash(task, goal, limits, MOST_ACTIONS_BETWEEN);
                }
            }
            Reason::Unreachable(obstacles)
        }
        Outcome::NoPlan { reason: NoPlanReason::Exclusive(pairs), .. } => {
            Reason::Exclusive(pairs.iter().map(|&(a, b)| (fact(a), fact(b))).collect())
        }
        Outcome::NoPlan { reason: NoPlanReason::Together(facts), .. } => {
            Reason::Together(facts.iter().map(|&id| fact(id)).collect())
        }
        Outcome::LimitReached(limit) => Reason::Limit(*limit),
    }))
}

/// How far from the goal the two facts may be that exclude each other.
const MOST_ACTIONS_BETWEEN: usize = 3;
/// Actions that would give one fact, of which more are not looked at.
const MOST_GIVERS: usize = 8;

/// Of the actions that would give a fact, or what they need, one two of whose needs exclude each other.
fn clash(task: &Task, goal: FactId, limits: &Limits, between: usize) -> Option<Clash> {
    let givers = task.operators.iter().filter(|operator| operator.add_effects.contains(&goal));
    givers.take(MOST_GIVERS).find_map(|giver| {
        let needs = Task { goal: giver.preconditions.clone(), ..task.clone() };
        match graphplan::solve(&needs, limits) {
            Outcome::NoPlan { reason: NoPlanReason::Exclusive(pairs), .. } => {
                let &(a, b) = pairs.first()?;
                let needs = (task.fact(a).to_string(), task.fact(b).to_string());
                Some(Clash { action: giver.to_string(), needs })
            }
            Outcome::NoPlan { reason: NoPlanReason::Unreachable(facts), .. } if between > 0 => {
                facts.iter().find_map(|&fact| clash(task, fact, limits, between - 1))
            }
            _ => None,
        }
    })
}
