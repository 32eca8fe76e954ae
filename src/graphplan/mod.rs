//! GraphPlan (A. Blum, M. Furst, 1997): the planner that the source paper names (paper 1, section 8).
//!
//! The planning graph alternates levels of facts with levels of actions, from the initial state forward,
//! and marks pairs that exclude each other (*mutex*). A plan is then sought backward from the goal. The first
//! level at which one is found is the fewest parallel steps there can be; when the graph has leveled off
//! and the same sets of goals keep failing, there is no plan, and that is an answer, not an error.
//!
//! ```
//! use orthoframe_graphplan::{Limits, Outcome, solve};
//! use orthoframe_strips::Scenario;
//! use orthoframe_units::Source;
//!
//! let task = Scenario::parse(&Source::new("дверь", "
//! Действие: Открыть (Параметры: дверь ?y)
//! (Предусловие: ЗАКРЫТА_(?y)) (Эффект+: ОТКРЫТА_(?y)) (Эффект-: ЗАКРЫТА_(?y))
//! Факты: ЗАКРЫТА_(Дверь-ВZ)   Цель: ОТКРЫТА_(Дверь-ВZ)"))?.ground()?;
//! let Outcome::Plan(plan) = solve(&task, &Limits::default()) else { panic!("дверь открывается") };
//! assert_eq!(task.operator(plan.steps[0][0]).to_string(), "Открыть_(Дверь-ВZ)");
//! # Ok::<(), orthoframe_strips::RuleFaults>(())
//! ```
//!
//! # Invariants
//!
//! - *Tasks.* The planner sees only a `Task`. Every list of a task is a sorted set, no operator both adds and
//!   deletes a fact, negation exists only as complementary facts. What an action deletes and adds again holds
//!   after it, so it is an add effect, and is *renewed* besides: within a step nobody else may need or add it
//!   (`Operator::interferes`, which graph, solver, extraction, shortening and replay share in meaning).
//!   Grounding drops only what cannot change the fewest number of parallel steps, so a fact that always holds
//!   stays where operators interfere through it; assumptions are never dropped as always true.
//! - *Where what stands.* `graph`, `mutex` and `extract` are the paper's algorithm, whole and alone
//!   ([`solve_plainly`]). `proof` answers the same question quickly, `portfolio` finds plans that need not be the
//!   shortest; neither is needed to understand the other.
//! - *Large tasks.* Only the operators are planned with that some shortest plan may need (`graphplan/proof/needed`):
//!   no returns, nothing undone for nothing, no fact that is only passed through (`graphplan/proof/detours`). Of
//!   places in a room of which the map says no more than that they are there one stands for all (`robot/idle`).
//! - *Proofs.* Every stored no-good was derived by the search; the solver's refutations are never stored, and
//!   the proof of "no plan" rests on this. Past level-off a third way looks for that proof: induction over the
//!   number of steps (`graphplan/proof/induction`) asks a solver of its own about one step at a time and keeps its
//!   own sets; it gets a share of the effort of the other two until it comes to a plan. A fourth looks at all states up
//!   to exchanges of what is alike (`graphplan/proof/states`), as long as these are few; from both ends where
//!   operators can be undone and few states have the goal. What is inherited from planning before a withdrawal is
//!   true of the new task, but the proof of "no plan" uses it only after checking that it is closed.
//! - *Effort* is counted in choices, conflicts and variables set, never in seconds, so equal tasks give equal
//!   plans; limits of time and memory, and signals, only end it. A search given up tells what it knows
//!   (`Unfinished`): the fewest steps that are not refuted, and a plan, if forward search, asked for one after
//!   some effort, had found any.
//! - *The solver* cannot count by itself: operators of landmarks that no step can carry out together are
//!   counted for it. It is told to use objects that neither initial state nor goal nor costs tell apart in the
//!   order of their names: of the plans that differ by their exchange one is kept. It is also told that no step
//!   only undoes the one before, and, where every two operators exclude each other and every shorter plan is
//!   refuted, what can hold after exactly so many steps; both hold of some plan of the fewest actions.
//! - *Fewest actions.* After the fewest steps are proven, a bound on the number (or cost) of actions sinks
//!   until the solver refutes it or the given effort is used up; a plan found soon is made of fewer actions and of
//!   fewer steps piece by piece, and sought anew by fewer, to a given effort; it never gets more actions or dearer.
//! - *Least cost*, whatever the steps: [`solve_cheapest`] (`graphplan/cheapest`), where what operators cost is time.
//! - *Why a goal is out of reach* is found apart from planning, from the rules (`strips/lack`): what is told to
//!   be missing holds in no relaxed future, and what is told to help was neither stated nor can be brought
//!   about; what was withdrawn comes first. What is told is data (`Said`) until it is worded, by the phrases of
//!   the rules or as the rule file writes it (`strips/phrase`).

use orthoframe_strips as strips;
use orthoframe_units as units;

mod action;
mod allowed;
mod bits;
mod cheapest;
mod extract;
mod graph;
mod mutex;
mod plan;
mod portfolio;
mod proof;
mod tried;

use std::time::Instant;

pub use cheapest::solve_cheapest;
pub use extract::solve_plainly;
pub use plan::{Flaw, Plan, validate};
pub use portfolio::{bounded, milestones, shorten, solve_any, solve_anytime, solve_soon};
pub use proof::{Learned, solve, solve_learning};
pub use tried::{Attempt, Log, Way};

use crate::strips::FactId;

/// What the search for a plan came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// A plan with the fewest parallel steps.
    Plan(Plan),
    /// Proven: no plan of any length.
    NoPlan {
        /// The level from which on the graph stays the same.
        leveled_off_at: usize,
        reason: NoPlanReason,
    },
    /// Given up, with what is known.
    LimitReached(Unfinished),
}

impl Outcome {
    /// The plan that there is, proven to be the shortest or not.
    #[must_use]
    pub fn plan(&self) -> Option<&Plan> {
        match self {
            Self::Plan(plan) => Some(plan),
            Self::NoPlan { .. } => None,
            Self::LimitReached(unfinished) => unfinished.plan.as_ref(),
        }
    }

    /// The limit that ended the search, if one did.
    #[must_use]
    pub fn limit(&self) -> Option<Limit> {
        match self {
            Self::LimitReached(unfinished) => Some(unfinished.limit),
            _ => None,
        }
    }
}

/// What is known when a search is given up.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unfinished {
    pub limit: Limit,
    /// Proven: no plan has fewer parallel steps.
    pub at_least: usize,
    /// A plan, though shorter ones are not ruled out: the fewest steps are no more than its.
    pub plan: Option<Plan>,
    /// The ways that were tried, and how far they came.
    pub tried: Vec<Attempt>,
}

impl From<Limit> for Unfinished {
    fn from(limit: Limit) -> Self {
        Self { limit, at_least: 0, plan: None, tried: Vec::new() }
    }
}

impl Unfinished {
    /// Given up before there was a task.
    #[must_use]
    pub fn in_grounding(limit: Limit) -> Self {
        let tried = vec![Attempt::new(Way::Grounding, 0, 0, 0)];
        Self { tried, ..limit.into() }
    }
}

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoPlanReason {
    /// Facts of the goal that no action can reach.
    Unreachable(Vec<FactId>),
    /// Pairs of the goal that never hold at once.
    Exclusive(Vec<(FactId, FactId)>),
    /// Facts of the goal that pairwise may hold, but not all together.
    Together(Vec<FactId>),
}

/// Which limit ended the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    Time,
    Memory,
    Steps,
    /// It was told to stop.
    Stopped,
    /// The effort allowed was spent ([`Limits::effort`]).
    Effort,
}

/// How far the search may go.
#[derive(Debug, Clone)]
pub struct Limits {
    pub deadline: Option<Instant>,
    pub memory_bytes: usize,
    /// Raised from outside, as by a signal, when the search is to end with what it has.
    pub stop: Option<crate::units::Stop>,
    pub parallel_steps: usize,
    /// Conflicts of the solver that may be spent on fewer actions once the fewest steps are found; on less cost,
    /// where actions have different costs.
    pub fewer_actions: u64,
    /// Pieces of a plan found soon that may be planned anew to shorten it.
    pub shorten: u64,
    /// What making a plan found soon shorter may take in all, in variables set by the solver and what takes as long;
    /// without end, it goes on until the deadline, or until nothing is left to be tried.
    pub shorten_effort: u64,
    /// Who is told of a plan found soon, and of every one with fewer steps or fewer actions that it is made.
    pub tell: Option<fn(&Plan)>,
    /// Who is told by [`solve_anytime`] when fewer steps than before are ruled out.
    pub tell_bound: Option<fn(usize)>,
    /// What a proof, or [`solve_anytime`] in all, may take, in variables set by the solver and what takes as long, if
    /// that is limited.
    pub effort: Option<u64>,
    /// Where it is noted what was tried; each search has a log of its own where none is given.
    pub log: Option<Log>,
}

impl Default for Limits {
    /// No deadline, a gigabyte, and more steps than a robot takes in a day.
    fn default() -> Self {
        Self {
            deadline: None,
            memory_bytes: 1 << 30,
            stop: None,
            parallel_steps: 10_000,
            fewer_actions: 1 << 10,
            shorten: 300,
            shorten_effort: Self::TO_START,
            tell: None,
            tell_bound: None,
            effort: None,
            log: None,
        }
    }
}

impl Limits {
    /// What a robot that is to start within two seconds may take.
    pub const TO_START: u64 = 1 << 25;

    /// The same, of which nobody is told anything on the way.
    #[must_use]
    pub fn quiet(&self) -> Self {
        Self { tell: None, tell_bound: None, ..self.clone() }
    }

    /// The same for one of several plans that are sought one after the other: it leaves time to those that come next.
    #[must_use]
    pub fn one_of_several(&self) -> Self {
        Self { shorten_effort: self.shorten_effort.min(Self::TO_START), ..self.clone() }
    }

    /// The same, but it ends somewhat earlier: what was found is looked at in the rest of the time.
    pub(crate) fn with_time_to_spare(&self) -> Self {
        const PART: u32 = 16;
        let earlier = |deadline: Instant| {
            deadline - deadline.saturating_duration_since(Instant::now()) / PART
        };
        Self { deadline: self.deadline.map(earlier), ..self.clone() }
    }

    /// Whether the clock and so much memory held allow to go on.
    ///
    /// # Errors
    /// The limit that was reached.
    pub fn check(&self, bytes: usize) -> Result<(), Limit> {
        if self.is_stopped() {
            return Err(Limit::Stopped);
        }
        if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            return Err(Limit::Time);
        }
        if bytes > self.memory_bytes { Err(Limit::Memory) } else { Ok(()) }
    }

    fn is_stopped(&self) -> bool {
        self.stop.as_ref().is_some_and(crate::units::Stop::is_raised)
    }

    fn tell_of(&self, plan: &Plan) {
        if let Some(tell) = self.tell {
            tell(plan);
        }
    }

    fn tell_of_bound(&self, at_least: usize) {
        if let Some(tell) = self.tell_bound {
            tell(at_least);
        }
    }
}

/// Runs a search on a stack of its own: it goes as deep as a plan has goals and steps.
pub(crate) fn with_stack<T: Send, E: From<Limit> + Send>(
    search: impl FnOnce() -> Result<T, E> + Send,
) -> Result<T, E> {
    const STACK_BYTES: usize = 1 << 29;
    std::thread::scope(|scope| {
        std::thread::Builder::new()
            .name("graphplan".to_owned())
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, search)
            .map_or(Err(Limit::Memory.into()), |search| {
                search.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            })
    })
}

#[cfg(test)]
mod samples;
#[cfg(test)]
mod tests;
