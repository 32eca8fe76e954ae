//! A planning problem solved, with all that a person wants to know of the answer.

use std::sync::Arc;

use super::grounding::grounded;
use super::helping::keep_what_helps;
use super::passable::{Found, Passable, Refused, again};
use super::soon::improve;
use super::timing::Clock;
use super::wishes::{self, Wishes};
use crate::graphplan::{
    self, Attempt, Learned, Limit, Limits, NoPlanReason, Outcome, Unfinished, Way,
};
use crate::strips::{
    Clash, Domain, FactId, Obstacle, Phrases, Problem, RuleFaults, Said, Task, Wording,
    explain_unreachable,
};
use crate::units::{Language, name_key, told};

/// What planning came to, with the task that it was about.
#[derive(Debug, Clone)]
pub struct Solved {
    pub task: Task,
    pub outcome: Outcome,
    /// A plan, where the search was not given up, is proven to have the fewest parallel steps.
    pub is_shortest: bool,
    /// Proven: no plan has fewer parallel steps.
    pub at_least: usize,
    /// The assumptions that the plan rests on.
    pub assumptions: Vec<Said>,
    /// Why there is no plan; none when there is one.
    pub reason: Option<Reason>,
    /// How the rules say their facts and actions in words.
    pub phrases: Arc<Phrases>,
    /// Which preferences the plan meets, where the problem has any.
    pub wishes: Option<Wishes>,
    /// How long the plan takes, where it was planned for that.
    pub time: Option<DrivenTime>,
    /// Of actions that last, each planned as one: none was sought in which one goes on within another.
    pub is_of_whole_actions: bool,
}

/// How long a plan takes to be driven, in hundredths of a second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DrivenTime {
    pub takes: u64,
    /// Proven: no plan takes less.
    pub at_least: u64,
}

impl DrivenTime {
    #[must_use]
    pub fn is_least(&self) -> bool {
        self.takes <= self.at_least
    }
}

/// Why there is no plan, or none was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reason {
    Unreachable(Vec<Obstacle>),
    /// Pairs of goals that exclude each other.
    Exclusive(Vec<(Said, Said)>),
    /// Goals that cannot all hold at once.
    Together(Vec<Said>),
    /// By the rules there is a plan; these of its actions the floor refuses, and without them there is none.
    NoWay(Vec<Refused>),
    /// The search was given up.
    Limit {
        limit: Limit,
        /// Proven: no plan has fewer parallel steps.
        at_least: usize,
        /// There is a plan of so many steps, though shorter ones are not ruled out.
        at_most: Option<usize>,
        /// What was tried, and how far it came.
        tried: Vec<Attempt>,
    },
}

impl Reason {
    #[must_use]
    pub fn in_words(&self, wording: &Wording<'_>) -> String {
        let language = wording.language;
        match self {
            Self::Unreachable(obstacles) => {
                // A door locked from either side is one door in words.
                let mut told: Vec<String> = Vec::new();
                for obstacle in obstacles.iter().map(|obstacle| obstacle.in_words(wording)) {
                    if !told.contains(&obstacle) {
                        told.push(obstacle);
                    }
                }
                told.join("\n")
            }
            Self::Exclusive(pairs) => {
                let and = told!(language, "and-that");
                let pair = |(a, b): &(Said, Said)| {
                    format!("{} {and} {}", wording.fact(a), wording.fact(b))
                };
                let pairs: Vec<String> = pairs.iter().map(pair).collect();
                let head = told!(language, "goals-exclude");
                head + &pairs.join(language.pick("; ", "; that "))
            }
            Self::Together(facts) => {
                let head = told!(language, "goals-out-of-reach");
                let facts: Vec<String> = facts.iter().map(|fact| wording.fact(fact)).collect();
                head + &facts.join(language.pick(", ", ", that "))
            }
            Self::NoWay(actions) => {
                let head = told!(language, "floor-has-no-way");
                let action = |refused: &Refused| match &refused.why {
                    Some(why) => {
                        format!("{} ({})", wording.action(&refused.action), why.say(language))
                    }
                    None => wording.action(&refused.action),
                };
                let actions: Vec<String> = actions.iter().map(action).collect();
                head + &actions.join(language.pick(", ", "; "))
            }
            Self::Limit { limit, at_least, at_most: None, tried } => {
                let ended = match limit {
                    Limit::Time => told!(language, "no-plan-in-time"),
                    Limit::Memory => told!(language, "no-plan-in-memory"),
                    Limit::Steps => told!(language, "no-plan-within-steps"),
                    Limit::Stopped => told!(language, "no-plan-before-stop"),
                    Limit::Effort => told!(language, "no-plan-in-effort"),
                };
                let known = match at_least {
                    0 => ended,
                    least => told!(language, "proven-steps", ended, least),
                };
                let tried: Vec<String> =
                    tried.iter().map(|attempt| tried_in_words(attempt, language)).collect();
                match tried.is_empty() {
                    true => known,
                    false => format!("{known}; {}: {}", told!(language, "tried"), tried.join(", ")),
                }
            }
            Self::Limit { limit, at_least, at_most: Some(most), .. } => {
                let ended = match limit {
                    Limit::Time => told!(language, "ended-by-time"),
                    Limit::Memory => told!(language, "ended-by-memory"),
                    Limit::Steps => {
                        told!(language, "ended-by-steps")
                    }
                    Limit::Stopped => told!(language, "ended-by-stop"),
                    Limit::Effort => {
                        told!(language, "ended-by-effort")
                    }
                };
                told!(language, "shorter-plan-open", ended, at_least, most)
            }
        }
    }
}

/// A way that was tried, and how far it came: levels of the graph, sets of goals or states, effort.
fn tried_in_words(attempt: &Attempt, language: Language) -> String {
    let Attempt { way, times, levels, nodes, effort } = *attempt;
    let way = match way {
        Way::Grounding => {
            return told!(language, "way-grounding");
        }
        Way::Graph => told!(language, "way-graph"),
        Way::Proof => told!(language, "way-proof"),
        Way::Forward => told!(language, "way-forward"),
    };
    let mut far = Vec::new();
    if levels > 0 {
        far.push(told!(language, "levels", levels));
    }
    far.push(told!(language, "nodes", nodes));
    far.push(told!(language, "effort", effort));
    if times > 1 {
        far.push(told!(language, "times", times));
    }
    format!("{way} ({})", far.join(", "))
}

impl Solved {
    /// Why there is no plan, in words; none when there is one. Objects go under the names that they are planned by.
    #[must_use]
    pub fn explanation(&self, language: Language) -> Option<String> {
        self.explanation_with(&self.wording(language, &str::to_owned))
    }

    /// The same with names of objects from elsewhere, such as their English names on a map.
    #[must_use]
    pub fn explanation_with(&self, wording: &Wording<'_>) -> Option<String> {
        self.reason.as_ref().map(|reason| reason.in_words(wording))
    }

    /// The assumptions in words, each once.
    #[must_use]
    pub fn assumptions_with(&self, wording: &Wording<'_>) -> Vec<String> {
        let mut told: Vec<String> = Vec::new();
        for assumption in self.assumptions.iter().map(|fact| wording.fact(fact)) {
            if !told.contains(&assumption) {
                told.push(assumption);
            }
        }
        told
    }

    /// The words of the rules in a language.
    #[must_use]
    pub fn wording<'a>(
        &'a self,
        language: Language,
        name: &'a dyn Fn(&str) -> String,
    ) -> Wording<'a> {
        Wording { language, phrases: &self.phrases, name }
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
    /// One at once, better ones as they come, and what is proven of the fewest steps, until the two meet.
    Anytime,
    /// The shortest by the paper's algorithm, and nothing else.
    Plain,
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
    solve_on(None, domain, problem, limits, wanted)
}

/// The same on a floor, where there is one: of what the rules allow that has no way there.
///
/// # Errors
/// As [`solve`].
pub(super) fn solve_on(
    floor: Option<&mut dyn Passable>,
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    wanted: Wanted,
) -> Result<Solved, RuleFaults> {
    match problem.preferences().next() {
        Some(_) => wishes::solve(floor, domain, problem, limits, wanted),
        None => solve_goal(floor, domain, problem, limits, wanted),
    }
}

/// The same, and preferences are none of its business.
pub(super) fn solve_goal(
    mut floor: Option<&mut dyn Passable>,
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    wanted: Wanted,
) -> Result<Solved, RuleFaults> {
    // What the floor refuses is planned anew without it.
    let many = limits.one_of_several();
    let each = if floor.is_some() { &many } else { limits };
    let mut search = |task: &Task| match wanted {
        Wanted::Shortest => graphplan::solve(task, each),
        Wanted::Any => graphplan::solve_any(task, each),
        Wanted::Anytime => graphplan::solve_anytime(task, each),
        Wanted::Plain => graphplan::solve_plainly(task, each),
    };
    let (task, mut found) = found_on(again(&mut floor), domain, problem, each, &mut search)?;
    let bound = match &mut found.0 {
        Outcome::Plan(plan) if wanted == Wanted::Any => {
            Some(improve(floor, (domain, problem), &task, plan, limits))
        }
        _ => None,
    };
    told(domain, problem, task, found, bound, wanted, limits)
}

/// Grounds a problem and searches for a plan that the floor does not refuse.
fn found_on(
    floor: Option<&mut dyn Passable>,
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    search: &mut dyn FnMut(&Task) -> Outcome,
) -> Result<(Task, Found), RuleFaults> {
    let mut task = match grounded(domain, problem, limits)? {
        Ok(task) => task,
        Err(limit) => {
            let outcome = Outcome::LimitReached(Unfinished::in_grounding(limit));
            return Ok((Task::default(), (outcome, Vec::new())));
        }
    };
    let found = match floor {
        Some(floor) => floor.search((domain, problem), &mut task, limits, search),
        None => (search(&task), Vec::new()),
    };
    Ok((task, found))
}

/// The plan that takes the least time, for a robot that tries its plans itself; none where the rules do not tell where it
/// stands, or the floor has no way: of that the plan by steps tells more.
pub(super) fn solve_in_time(
    domain: &Domain,
    problem: &Problem,
    clock: &mut Clock<'_>,
    limits: &Limits,
) -> Result<Option<Solved>, RuleFaults> {
    let Ok(mut task) = grounded(domain, problem, limits)? else { return Ok(None) };
    if !clock.charge(domain, &mut task).is_empty() {
        return Ok(None);
    }
    clock.bar(domain, &mut task);
    let (outcome, at_least) = graphplan::solve_cheapest(&task, limits);
    if outcome.plan().is_none() {
        return Ok(None);
    }
    timed(domain, problem, task, (outcome, Vec::new()), at_least, limits).map(Some)
}

/// A plan found for its cost, which is time.
pub(super) fn timed(
    domain: &Domain,
    problem: &Problem,
    task: Task,
    found: Found,
    at_least: u64,
    limits: &Limits,
) -> Result<Solved, RuleFaults> {
    let takes = found.0.plan().map(|plan| plan.cost(&task));
    let mut solved = told(domain, problem, task, found, None, Wanted::Shortest, limits)?;
    // Of its steps nothing is proven.
    (solved.is_shortest, solved.at_least) = (false, 0);
    solved.time = takes.map(|takes| DrivenTime { takes, at_least: at_least.min(takes) });
    Ok(solved)
}

/// The shortest plan, or the best that the effort allows, with what was learned by planning before where that is sound, and what is learned now.
///
/// # Errors
/// As [`solve`].
pub(super) fn solve_again(
    floor: Option<&mut dyn Passable>,
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
    learned: Option<&Learned>,
) -> Result<(Solved, Option<Learned>), RuleFaults> {
    let mut now_learned = None;
    let mut search = |task: &Task| {
        let (outcome, learned) = graphplan::solve_soon(task, learned, limits);
        now_learned = learned;
        outcome
    };
    let (task, found) = found_on(floor, domain, problem, limits, &mut search)?;
    Ok((told(domain, problem, task, found, None, Wanted::Shortest, limits)?, now_learned))
}

/// What became of a plan when assumptions were withdrawn.
#[derive(Debug, Clone)]
pub struct Replanned {
    pub before: Solved,
    pub after: Solved,
    pub withdrawn: Vec<Said>,
    /// Whether what planning before had taught went into the new plan.
    pub learned_before: bool,
}

impl Replanned {
    /// Whether the plan before rested on something withdrawn.
    #[must_use]
    pub fn rested_on(&self) -> bool {
        let said = |a: &Said, b: &Said| {
            name_key(&a.written(Language::Russian)) == name_key(&b.written(Language::Russian))
        };
        self.withdrawn.iter().any(|gone| self.before.assumptions.iter().any(|a| said(a, gone)))
    }
}

/// Plans, withdraws assumptions, and plans anew with what was learned the first time, where that is sound.
///
/// `withdrawn` are texts as [`Problem::withdraw_assumptions`] reads them. Any plan soon is planned anew from the
/// beginning: the graph is not what it came from.
///
/// # Errors
/// As [`solve`]; and what cannot be withdrawn, all of it at once.
pub(super) fn solve_without(
    mut floor: Option<&mut dyn Passable>,
    domain: &Domain,
    problem: &mut Problem,
    withdrawn: &[String],
    limits: &Limits,
    wanted: Wanted,
) -> Result<Replanned, RuleFaults> {
    let mut without = problem.clone();
    let (mut gone, mut faults) = (Vec::new(), Vec::new());
    for text in withdrawn {
        match without.withdraw_assumptions(domain, text) {
            Ok(said) => gone.extend(said),
            Err(RuleFaults(found)) => faults.extend(found),
        }
    }
    if !faults.is_empty() {
        return Err(RuleFaults(faults));
    }
    let is_plain = problem.preferences().next().is_none();
    let (before, after, learned_before) = if wanted == Wanted::Shortest && is_plain {
        let (before, learned) = solve_again(again(&mut floor), domain, problem, limits, None)?;
        let (after, _) = solve_again(floor, domain, &without, limits, learned.as_ref())?;
        let serves = learned.is_some_and(|learned| learned.serves(&after.task));
        (before, after, serves)
    } else {
        let both = limits.one_of_several();
        let before = solve_on(again(&mut floor), domain, problem, &both, wanted)?;
        (before, solve_on(floor, domain, &without, &both, wanted)?, false)
    };
    *problem = without;
    Ok(Replanned { before, after, withdrawn: gone, learned_before })
}

/// Of a goal of several disjuncts the one that the plan meets; the operator that only says so is no step.
fn choose_disjunct(task: &mut Task, outcome: &mut Outcome) {
    if task.goal_steps == 0 {
        return;
    }
    match outcome {
        Outcome::Plan(plan) => task.choose_disjunct(&mut plan.steps),
        Outcome::NoPlan { .. } => {}
        Outcome::LimitReached(known) => {
            known.at_least = known.at_least.saturating_sub(1);
            if let Some(plan) = &mut known.plan {
                task.choose_disjunct(&mut plan.steps);
            }
        }
    }
}

pub(super) fn told(
    domain: &Domain,
    problem: &Problem,
    mut task: Task,
    (mut outcome, refused): Found,
    bound: Option<usize>,
    wanted: Wanted,
    limits: &Limits,
) -> Result<Solved, RuleFaults> {
    // The operator that only says that a goal is met is no step of the bound either.
    let said = usize::from(task.goal_steps > 0);
    let bound = bound.map(|bound| bound.saturating_sub(said));
    choose_disjunct(&mut task, &mut outcome);
    let at_least = match &outcome {
        Outcome::Plan(plan) => bound.unwrap_or(plan.steps.len()),
        Outcome::LimitReached(known) => known.at_least,
        Outcome::NoPlan { .. } => 0,
    };
    let is_shortest = outcome.plan().is_some_and(|plan| plan.steps.len() <= at_least);
    let assumptions = outcome.plan().map_or_else(Vec::new, |plan| {
        plan.assumptions(&task).iter().map(|&f| Said::from(task.fact(f))).collect()
    });
    let reason = match refused.is_empty() {
        true => explain(domain, problem, &task, &outcome, wanted, limits)?,
        false => Some(Reason::NoWay(refused)),
    };
    let phrases = Arc::clone(domain.phrases());
    Ok(Solved {
        task,
        outcome,
        is_shortest,
        at_least,
        assumptions,
        reason,
        phrases,
        wishes: None,
        time: None,
        is_of_whole_actions: false,
    })
}

fn explain(
    domain: &Domain,
    problem: &Problem,
    task: &Task,
    outcome: &Outcome,
    wanted: Wanted,
    limits: &Limits,
) -> Result<Option<Reason>, RuleFaults> {
    // The paper's algorithm explains itself.
    let is_plain = wanted == Wanted::Plain;
    let solve = if is_plain { graphplan::solve_plainly } else { graphplan::solve };
    let fact = |id: FactId| Said::from(task.fact(id));
    Ok(Some(match outcome {
        Outcome::Plan(_) => return Ok(None),
        Outcome::NoPlan { reason: NoPlanReason::Unreachable(facts), .. } => {
            let goals = facts.iter().map(|&id| task.fact(id));
            let mut obstacles = explain_unreachable(domain, problem, goals)?;
            for (obstacle, &goal) in obstacles.iter_mut().zip(facts) {
                if obstacle.is_met_singly {
                    obstacle.clash = clash(task, goal, solve, limits, MOST_ACTIONS_BETWEEN);
                }
            }
            // Whether it helps only other planners can try in a moment: untried it is not told.
            match is_plain {
                true => obstacles.iter_mut().for_each(|obstacle| obstacle.help.clear()),
                false => keep_what_helps(domain, problem, &mut obstacles, limits),
            }
            Reason::Unreachable(obstacles)
        }
        Outcome::NoPlan { reason: NoPlanReason::Exclusive(pairs), .. } => {
            Reason::Exclusive(pairs.iter().map(|&(a, b)| (fact(a), fact(b))).collect())
        }
        Outcome::NoPlan { reason: NoPlanReason::Together(facts), .. } => {
            Reason::Together(facts.iter().map(|&id| fact(id)).collect())
        }
        Outcome::LimitReached(known) => Reason::Limit {
            limit: known.limit,
            at_least: known.at_least,
            at_most: known.plan.as_ref().map(|plan| plan.steps.len()),
            tried: known.tried.clone(),
        },
    }))
}

/// How far from the goal the two facts may be that exclude each other.
const MOST_ACTIONS_BETWEEN: usize = 3;
/// Actions that would give one fact, of which more are not looked at.
const MOST_GIVERS: usize = 8;

/// Of the actions that would give a fact, or what they need, one two of whose needs exclude each other.
fn clash(
    task: &Task,
    goal: FactId,
    solve: fn(&Task, &Limits) -> Outcome,
    limits: &Limits,
    between: usize,
) -> Option<Clash> {
    let givers = task.operators.iter().filter(|operator| operator.add_effects.contains(&goal));
    givers.take(MOST_GIVERS).find_map(|giver| {
        let needs = Task { goal: giver.preconditions.clone(), ..task.clone() };
        match solve(&needs, limits) {
            Outcome::NoPlan { reason: NoPlanReason::Exclusive(pairs), .. } => {
                let &(a, b) = pairs.first()?;
                let needs = (Said::from(task.fact(a)), Said::from(task.fact(b)));
                Some(Clash { action: Said::from(giver), needs })
            }
            Outcome::NoPlan { reason: NoPlanReason::Unreachable(facts), .. } if between > 0 => {
                facts.iter().find_map(|&fact| clash(task, fact, solve, limits, between - 1))
            }
            _ => None,
        }
    })
}
