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
//! - *Large tasks.* Only the operators are planned with that some shortest plan may need (`graphplan/needed`):
//!   no returns, nothing undone for nothing, no fact that is only passed through (`graphplan/detours`). Of
//!   places in a room of which the map says no more than that they are there one stands for all (`robot/idle`).
//! - *Proofs.* Every stored no-good was derived by the search; the solver's refutations are never stored, and
//!   the proof of "no plan" rests on this. Past level-off a third way looks for that proof: induction over the
//!   number of steps (`graphplan/induction`) asks a solver of its own about one step at a time and keeps its
//!   own sets; it gets a share of the effort of the other two until it comes to a plan. What is inherited from
//!   planning before a withdrawal is true of the new task, but the proof of "no plan" uses it only after
//!   checking that it is closed.
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
//!   until the solver refutes it or the given effort is used up; a plan found soon is shortened piece by piece
//!   to a given effort, stays a plan throughout, and ends with no more actions than it began with.
//! - *Why a goal is out of reach* is found apart from planning, from the rules (`strips/lack`): what is told to
//!   be missing holds in no relaxed future, and what is told to help was neither stated nor can be brought
//!   about; what was withdrawn comes first. What is told is data (`Said`) until it is worded, by the phrases of
//!   the rules or as the rule file writes it (`strips/phrase`).

use orthoframe_strips as strips;
use orthoframe_units as units;

mod any;
mod bits;
mod counting;
mod cuts;
mod detours;
mod extract;
mod fewest;
mod first_use;
mod graph;
mod induction;
mod landmarks;
mod needed;
mod no_good;
mod novelty;
mod pairs;
mod plan;
mod relaxed;
mod replan;
mod rivals;
mod sat;
mod serial;
mod shorten;
mod solver;
mod symmetry;
mod transition;

use std::time::Instant;

pub use plan::{Flaw, Plan, validate};
pub use replan::Learned;

use crate::strips::{FactId, Task};
use extract::{Extraction, Search};
use graph::PlanningGraph;
use induction::{Induction, Proof};
use replan::Inherited;
use sat::{Encoding, Verdict};

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
}

impl From<Limit> for Unfinished {
    fn from(limit: Limit) -> Self {
        Self { limit, at_least: 0, plan: None }
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
    /// What shortening may take in all, in variables set by the solver and what takes as long.
    pub shorten_effort: u64,
    /// Who is told of a plan found soon, and of every one with fewer steps that it is shortened to.
    pub tell: Option<fn(&Plan)>,
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
            shorten_effort: 1 << 28,
            tell: None,
        }
    }
}

impl Limits {
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
}

/// Finds a plan with the fewest parallel steps, or proves that there is none.
///
/// Equal tasks give equal plans.
#[must_use]
pub fn solve(task: &Task, limits: &Limits) -> Outcome {
    solve_learning(task, None, limits).0
}

/// As [`solve`], and keeps what was learned on the way, for planning anew after an assumption was withdrawn; what
/// was learned before serves as far as it is sound. The answer is as good as that of [`solve`], though of several
/// plans with the fewest steps another may be found.
#[must_use]
pub fn solve_learning(
    task: &Task,
    learned: Option<&Learned>,
    limits: &Limits,
) -> (Outcome, Option<Learned>) {
    let inherited = learned.and_then(|learned| learned.about(task));
    if inherited.is_none() && task.facts.len() >= LARGE {
        return (solve_large(task, limits).unwrap_or_else(Outcome::LimitReached), None);
    }
    match with_stack(|| search(task, limits, Turn::default(), inherited.as_ref())) {
        Ok((outcome, learned)) => {
            (outcome.expect("turns without end come to an answer"), Some(learned))
        }
        Err(unfinished) => (Outcome::LimitReached(unfinished), None),
    }
}

/// Of so many facts a task is planned without the operators that no shortest plan needs. What is learned then is about
/// another task, and is not kept; finding them out again costs less than the whole graph would.
const LARGE: usize = 1_000;

fn solve_large(task: &Task, limits: &Limits) -> Result<Outcome, Unfinished> {
    let reduced = needed::Reduced::of(task, limits)?;
    let own = |mut plan: Plan| {
        plan.steps.iter_mut().flatten().for_each(|id| *id = reduced.operator(*id));
        plan
    };
    let (outcome, _) = with_stack(|| search(&reduced.task, limits, Turn::default(), None))
        .map_err(|unfinished| Unfinished { plan: unfinished.plan.map(own), ..unfinished })?;
    let facts = |facts: Vec<FactId>| facts.into_iter().map(|fact| reduced.fact(fact)).collect();
    Ok(match outcome.expect("turns without end come to an answer") {
        Outcome::Plan(plan) => Outcome::Plan(own(plan)),
        Outcome::NoPlan { leveled_off_at, reason } => {
            let reason = match reason {
                NoPlanReason::Unreachable(unreachable) => {
                    NoPlanReason::Unreachable(facts(unreachable))
                }
                NoPlanReason::Exclusive(pairs) => {
                    let pair = |(a, b)| (reduced.fact(a), reduced.fact(b));
                    NoPlanReason::Exclusive(pairs.into_iter().map(pair).collect())
                }
                NoPlanReason::Together(together) => NoPlanReason::Together(facts(together)),
            };
            Outcome::NoPlan { leveled_off_at, reason }
        }
        limit @ Outcome::LimitReached(_) => limit,
    })
}

/// Finds some plan soon, where the shortest is out of reach. The plan is then shortened piece by piece within
/// [`Limits::shorten`], but not proven to be the shortest; that there is no plan is proven all the same.
#[must_use]
pub fn solve_any(task: &Task, limits: &Limits) -> Outcome {
    /// Turns of the graph's extraction at a level, when forward search is stuck.
    const FEW_TURNS: u32 = 3;
    /// A graph that takes more than this part of the memory, or more steps, is left alone.
    const FEW_OF_MEMORY: usize = 16;
    const FEW_STEPS: usize = 50;
    let shortened = |plan| {
        limits.tell_of(&plan);
        Outcome::Plan(shorten::shorten(task, plan, limits))
    };
    let found = |found| match found {
        any::Found::Plan(plan) => Some(shortened(plan)),
        // The planning graph tells why.
        any::Found::Exhausted => Some(solve(task, limits)),
        any::Found::Open => None,
    };
    let tries = || -> Result<Outcome, Unfinished> {
        if let Some(outcome) = found(any::search(task, limits, any::Effort::Small)?) {
            return Ok(outcome);
        }
        let mut refuted = 0;
        // Where forward search loses its way, the graph may see at once that there is none, or the solver that there
        // is one; if it is small.
        let turn = Turn { turns: Some(FEW_TURNS), goes_on: true, seek: None, ..Turn::default() };
        let brief = Limits {
            memory_bytes: limits.memory_bytes / FEW_OF_MEMORY,
            parallel_steps: limits.parallel_steps.min(FEW_STEPS),
            ..limits.clone()
        };
        match with_stack(|| search(task, &brief, turn, None)) {
            Ok((Some(Outcome::Plan(plan)), _)) => return Ok(shortened(plan)),
            Ok((Some(outcome), _)) => return Ok(outcome),
            Err(unfinished) if matches!(unfinished.limit, Limit::Time | Limit::Stopped) => {
                return Err(unfinished);
            }
            Err(unfinished) => refuted = unfinished.at_least,
            Ok((None, _)) => {}
        }
        let all = any::search(task, limits, any::Effort::All)
            .map_err(|limit| Unfinished { at_least: refuted, ..limit.into() })?;
        Ok(found(all).expect("all effort leaves nothing open"))
    };
    tries().unwrap_or_else(Outcome::LimitReached)
}

/// Runs a search on a stack of its own: it goes as deep as a plan has goals and steps.
fn with_stack<T: Send, E: From<Limit> + Send>(
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

/// What a conflict of the solver takes the time of, near enough.
const CHOICES_A_CONFLICT: u64 = 100;

/// Levels that the solver refutes at no price, one after the other, must not leave the search behind for good.
const CHOICES_A_LEVEL: u64 = 128;

/// What a proof by induction may spend, in variables set by the solver: so much for each level past level-off, and such
/// a part of what the other ways spent. A choice of the search takes as long as setting so many.
const EFFORT_A_LEVEL: u64 = 1 << 14;
const INDUCTION_SHARE: u64 = 4;
const EFFORT_A_CHOICE: u64 = 4;

/// Choices that the search may take for a level before the solver has its turn, after it decided the last level
/// with so many: much more while they are few, later no more than twice as many.
fn patience(spent: u64) -> u64 {
    (8 * spent.min(1 << 14)).max(2 * spent)
}

/// What each way of extraction may spend in its first turn at a level.
#[derive(Debug, Clone, Copy)]
struct Turn {
    /// Choices of the backward search.
    choices: u64,
    /// Conflicts of the solver.
    conflicts: u64,
    /// Turns at one level before giving up, if ever.
    turns: Option<u32>,
    /// A level given up is left for one farther on, where more plans lie: the first found need not be the shortest.
    goes_on: bool,
    /// Effort in all before giving up, if ever.
    effort: Option<u64>,
    /// After so much effort it is time for some plan, if ever, to know how far there is to go: a search that is given
    /// up then leaves it behind, and at its length nothing is left to be sought.
    seek: Option<u64>,
}

impl Default for Turn {
    fn default() -> Self {
        Self {
            choices: 1 << 13,
            conflicts: 1 << 9,
            turns: None,
            goes_on: false,
            effort: None,
            seek: Some(1 << 22),
        }
    }
}

/// No outcome when the turns at some level are used up, or the effort in all.
fn search(
    task: &Task,
    limits: &Limits,
    turn: Turn,
    inherited: Option<&Inherited<'_>>,
) -> Result<(Option<Outcome>, Learned), Unfinished> {
    let mut extractor = Extractor::new(task, limits, turn);
    let mut graph = PlanningGraph::new(task);
    match by_levels(&mut graph, &mut extractor, inherited) {
        Ok(outcome) => {
            let fewest_steps = graph.top();
            let no_goods = extractor.search.into_no_goods();
            let (task, state) = (task.clone(), task.init.clone());
            Ok((outcome, Learned { task, graph, no_goods, fewest_steps, state, done: 0 }))
        }
        Err(limit) => {
            Err(Unfinished { limit, at_least: extractor.at_least, plan: extractor.known })
        }
    }
}

/// What a search comes to, if it does, and what it took.
fn search_counted(task: &Task, limits: &Limits, turn: Turn) -> (Option<Outcome>, u64) {
    let mut extractor = Extractor::new(task, limits, turn);
    let mut graph = PlanningGraph::new(task);
    let outcome = by_levels(&mut graph, &mut extractor, None);
    (outcome.ok().flatten(), extractor.effort(&graph))
}

fn by_levels(
    graph: &mut PlanningGraph,
    extractor: &mut Extractor<'_>,
    inherited: Option<&Inherited<'_>>,
) -> Result<Option<Outcome>, Limit> {
    let Extractor { task, limits, turn, .. } = *extractor;
    if let Some(inherited) = inherited {
        extractor.search.inherit(inherited.no_goods());
    }
    let mut too_few = inherited.map_or(0, Inherited::fewest_steps);
    // Whether every length so far was refuted, and none only left.
    let mut are_refuted = true;
    extractor.at_least = too_few;
    loop {
        limits.check(graph.bytes() + extractor.bytes())?;
        if turn.effort.is_some_and(|most| extractor.effort(graph) > most) {
            return Ok(None);
        }
        if graph.is_possible(&task.goal) {
            if graph.top() >= too_few {
                match extractor.extract(graph)? {
                    Extraction::Plan(mut plan) => {
                        any::drop_needless(task, &mut plan.steps);
                        let encoding = &mut extractor.encoding;
                        let plan = fewest::fewest(task, graph, encoding, plan, limits);
                        return Ok(Some(Outcome::Plan(plan)));
                    }
                    Extraction::None => {}
                    Extraction::Open if turn.goes_on => {
                        are_refuted = false;
                        too_few = graph.top() + graph.top() / 4 + 1;
                    }
                    Extraction::Open => return Ok(None),
                    Extraction::Never(goals) => {
                        let leveled_off_at =
                            graph.leveled_off_at().expect("never is said after level-off");
                        let reason = NoPlanReason::Together(goals);
                        return Ok(Some(Outcome::NoPlan { leveled_off_at, reason }));
                    }
                }
            }
        } else if let Some(leveled_off_at) = graph.leveled_off_at() {
            let reason = graph.conflict_of(&task.goal);
            return Ok(Some(Outcome::NoPlan { leveled_off_at, reason }));
        }
        if are_refuted {
            extractor.at_least = extractor.at_least.max(graph.top() + 1);
        }
        if graph.top() >= limits.parallel_steps {
            return Err(Limit::Steps);
        }
        graph.expand(inherited, limits)?;
    }
}

/// The ways to look for a plan of a given length, taking turns.
///
/// Search is strong where a deep serial chain rules, the solver where many choices interact. Turns are counted in
/// choices and conflicts, not in seconds: the same task always goes the same way.
struct Extractor<'a> {
    task: &'a Task,
    search: Search<'a>,
    encoding: Encoding<'a>,
    limits: &'a Limits,
    turn: Turn,
    /// Who decided the level before goes first.
    solver_leads: bool,
    /// The choices with which the search decided the level before; none when the solver did.
    spent: u64,
    /// The last number of steps that the search refuted.
    refuted: usize,
    /// The third way, once the graph has leveled off, and the plan that it came to.
    induction: Option<Induction<'a>>,
    known: Option<Plan>,
    /// Whether forward search was asked for any plan.
    has_sought: bool,
    /// Fewer steps than these are refuted.
    at_least: usize,
}

/// Forward search gets this part of the memory for it.
const SEEKING_OF_MEMORY: usize = 4;

impl<'a> Extractor<'a> {
    fn new(task: &'a Task, limits: &'a Limits, turn: Turn) -> Self {
        Self {
            task,
            search: Search::new(task, limits.clone()),
            encoding: Encoding::new(task, !turn.goes_on, limits),
            limits,
            turn,
            solver_leads: false,
            spent: 0,
            refuted: 0,
            induction: None,
            known: None,
            has_sought: false,
            at_least: 0,
        }
    }

    fn bytes(&self) -> usize {
        let induction = self.induction.as_ref().map_or(0, Induction::bytes);
        self.search.bytes() + self.encoding.bytes() + induction
    }

    /// What was spent so far, in variables set by the solver and what takes as long.
    fn effort(&self, graph: &PlanningGraph) -> u64 {
        let induction = self.induction.as_ref().map_or(0, Induction::effort);
        let choices = self.search.choices() * EFFORT_A_CHOICE;
        graph.effort() + choices + self.encoding.effort() + induction
    }

    /// The fewest steps are no more than those of a plan found soon.
    fn seek(&mut self, graph: &PlanningGraph) -> Result<(), Limit> {
        let is_time = self.turn.seek.is_some_and(|effort| self.effort(graph) >= effort);
        if !is_time || std::mem::replace(&mut self.has_sought, true) || self.known.is_some() {
            return Ok(());
        }
        let memory_bytes = self.limits.memory_bytes / SEEKING_OF_MEMORY;
        let limits = Limits { memory_bytes, ..self.limits.clone() };
        match any::search(self.task, &limits, any::Effort::Least) {
            Ok(any::Found::Plan(plan)) => {
                self.limits.tell_of(&plan);
                self.known = Some(plan);
            }
            Err(limit @ (Limit::Time | Limit::Stopped)) => return Err(limit),
            Ok(any::Found::Exhausted | any::Found::Open) | Err(_) => {}
        }
        Ok(())
    }

    /// The plan that is known, once every shorter one is refuted.
    fn known_at(&self, graph: &PlanningGraph) -> Option<Plan> {
        self.known.clone().filter(|plan| plan.steps.len() == graph.top())
    }

    fn extract(&mut self, graph: &PlanningGraph) -> Result<Extraction, Limit> {
        if self.solver_leads
            && let Some(extraction) = self.prove(graph)?
        {
            return Ok(extraction);
        }
        // While the search does well, the next level may take it somewhat longer than the last did.
        let first = self.turn.choices.max(patience(self.spent));
        let before = self.search.choices();
        let mut round = 0;
        loop {
            self.seek(graph)?;
            if let Some(plan) = self.known_at(graph) {
                return Ok(Extraction::Plan(plan));
            }
            if let Some(extraction) = self.induce(graph)? {
                return Ok(extraction);
            }
            // Long before a share could overflow, some limit or the answer ends the turns.
            let doubled = round.min(30);
            if self.solver_leads || round > 0 {
                match self.encoding.extract(graph, self.turn.conflicts << doubled, self.limits)? {
                    Verdict::Plan(plan) => return Ok(Extraction::Plan(plan)),
                    Verdict::None => {
                        self.solver_leads = true;
                        self.spent = 0;
                        return Ok(Extraction::None);
                    }
                    Verdict::Open => {}
                }
            }
            let extraction = self.search.extract(graph, graph.top(), first << doubled)?;
            if !matches!(extraction, Extraction::Open) {
                self.solver_leads = false;
                self.spent = self.search.choices() - before;
                self.refuted = graph.top();
                return Ok(extraction);
            }
            round += 1;
            if self.turn.turns.is_some_and(|turns| round >= turns) {
                return Ok(Extraction::Open);
            }
        }
    }

    /// The solver never proves that no length will do. Once the graph has leveled off, the search gets a share
    /// of the effort for that, on the first length that it has not refuted itself; what it says of the present
    /// length is an answer.
    fn prove(&mut self, graph: &PlanningGraph) -> Result<Option<Extraction>, Limit> {
        let Some(leveled_off_at) = graph.leveled_off_at() else { return Ok(None) };
        let beyond = (graph.top() - leveled_off_at) as u64;
        let share = self.turn.choices * beyond
            + CHOICES_A_LEVEL * beyond * beyond
            + CHOICES_A_CONFLICT * self.encoding.conflicts();
        self.refuted = self.refuted.max(leveled_off_at);
        while self.refuted < graph.top() && self.search.choices() < share {
            let allowed = share - self.search.choices();
            match self.search.extract(graph, self.refuted + 1, allowed)? {
                Extraction::None => self.refuted += 1,
                Extraction::Open => return Ok(None),
                answer => return Ok(Some(answer)),
            }
        }
        Ok((self.refuted == graph.top()).then_some(Extraction::None))
    }

    /// Neither way may ever come to an end where goals fit by pairs and not together. Once the graph has leveled off, a
    /// proof by induction gets a share of the effort, until it comes to a plan of whatever length.
    fn induce(&mut self, graph: &PlanningGraph) -> Result<Option<Extraction>, Limit> {
        let Some(leveled_off_at) = graph.leveled_off_at() else { return Ok(None) };
        let beyond = (graph.top() - leveled_off_at) as u64;
        let effort = self.search.choices() * EFFORT_A_CHOICE + self.encoding.effort();
        let share = EFFORT_A_LEVEL * beyond + effort / INDUCTION_SHARE;
        let limits = self.limits;
        let induction =
            self.induction.get_or_insert_with(|| Induction::new(self.task, graph, limits));
        if self.known.is_none() && induction.effort() < share {
            match induction.go_on(share)? {
                Proof::Plan(plan) => self.known = Some(plan),
                Proof::Never(goals) => return Ok(Some(Extraction::Never(goals))),
                Proof::Open => {}
            }
        }
        let refuted = induction.refuted();
        Ok(match self.known_at(graph) {
            Some(plan) => Some(Extraction::Plan(plan)),
            None => (graph.top() <= refuted).then_some(Extraction::None),
        })
    }
}

#[cfg(test)]
mod samples;
#[cfg(test)]
mod tests;
