//! The fewest parallel steps, proven quickly: the planning graph with levels kept once, backward extraction with
//! no-goods generalised by explanation, a satisfiability solver, a proof by induction and a look at all states taking
//! turns.
//!
//! The textbook's algorithm stands above, in [`crate::graph`], [`crate::mutex`] and [`crate::extract`]; this folder
//! answers the same question, and its tests hold it against that and against breadth-first search.

mod counting;
pub(crate) mod cuts;
mod detours;
pub(crate) mod errands;
mod extract;
mod fewest;
mod first_use;
mod graph;
mod induction;
pub(crate) mod needed;
mod no_good;
pub(crate) mod pairs;
mod replan;
mod rivals;
mod sat;
mod serial;
mod solver;
mod states;
mod symmetry;
mod transition;

pub use replan::Learned;

use crate::portfolio::{any, parallel, rounds};
use crate::strips::{FactId, Task};
use crate::tried::telling;
use crate::{Attempt, Limit, Limits, NoPlanReason, Outcome, Plan, Unfinished, Way, with_stack};
use errands::Errands;
use extract::{Extraction, Search};
use graph::PlanningGraph;
use induction::{Induction, Proof};
use replan::Inherited;
use sat::{Encoding, Verdict};
use states::{BothEnds, Onward, Progress, StateSearch};

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
    let search = |limits: &Limits| learning(task, learned, limits);
    telling(limits, search, |(outcome, _)| outcome)
}

fn learning(task: &Task, learned: Option<&Learned>, limits: &Limits) -> (Outcome, Option<Learned>) {
    let inherited = learned.and_then(|learned| learned.about(task));
    if inherited.is_none() && task.facts.len() >= LARGE {
        return (solve_large(task, limits).unwrap_or_else(Outcome::LimitReached), None);
    }
    let turn = Turn { effort: limits.effort, ..Turn::default() };
    match with_stack(|| search(task, limits, turn, inherited.as_ref())) {
        Ok((Some(outcome), learned)) => (outcome, Some(learned)),
        Ok((None, learned)) => (Outcome::LimitReached(spent(&learned)), None),
        Err(unfinished) => (Outcome::LimitReached(unfinished), None),
    }
}

/// Turns without end come to an answer, or to the end of the effort allowed.
fn spent(learned: &Learned) -> Unfinished {
    Unfinished { at_least: learned.fewest_steps, ..Limit::Effort.into() }
}

/// Of so many facts a task is planned without the operators that no shortest plan needs. What is learned then is about
/// another task, and is not kept; finding them out again costs less than the whole graph would.
const LARGE: usize = 1_000;

pub(crate) fn solve_large(task: &Task, limits: &Limits) -> Result<Outcome, Unfinished> {
    let reduced = needed::Reduced::of(task, limits)?;
    let own = |plan: Plan| reduced.own(plan);
    let turn = Turn { effort: limits.effort, ..Turn::default() };
    let (outcome, learned) = with_stack(|| search(&reduced.task, limits, turn, None))
        .map_err(|unfinished| Unfinished { plan: unfinished.plan.map(own), ..unfinished })?;
    let facts = |facts: Vec<FactId>| facts.into_iter().map(|fact| reduced.fact(fact)).collect();
    let Some(outcome) = outcome else { return Err(spent(&learned)) };
    Ok(match outcome {
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

/// What a conflict of the solver takes the time of, near enough.
const CHOICES_A_CONFLICT: u64 = 100;

/// Levels that the solver refutes at no price, one after the other, must not leave the search behind for good.
const CHOICES_A_LEVEL: u64 = 128;

/// What a proof by induction may spend, in variables set by the solver: so much by the square of the levels past
/// level-off, but no more than half of what all else took, and besides such a part of what the other ways spent, a
/// choice of the search counted for so many.
const EFFORT_A_LEVEL: u64 = 1 << 10;
const INDUCTION_SHARE: u64 = 8;
const INDUCTION_A_CHOICE: u64 = 2;

/// A choice of a long search takes as long as setting so many variables.
const EFFORT_A_CHOICE: u64 = 4;

/// So much is spent before states are looked at.
const EFFORT_BEFORE_BOTH_ENDS: u64 = 1 << 20;
const EFFORT_BEFORE_STATES: u64 = 1 << 22;

/// Choices that the search may take for a level before the solver has its turn, after it decided the last level
/// with so many: much more while they are few, later no more than twice as many.
fn patience(spent: u64) -> u64 {
    (8 * spent.min(1 << 14)).max(2 * spent)
}

/// What each way of extraction may spend in its first turn at a level.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    /// Choices of the backward search.
    pub(crate) choices: u64,
    /// Conflicts of the solver.
    pub(crate) conflicts: u64,
    /// Turns at one level before giving up, if ever.
    pub(crate) turns: Option<u32>,
    /// A level given up is left for one farther on, where more plans lie: the first found need not be the shortest.
    pub(crate) goes_on: bool,
    /// Effort in all before giving up, if ever.
    pub(crate) effort: Option<u64>,
    /// After so much effort it is time for some plan, if ever, to know how far there is to go: a search that is given
    /// up then leaves it behind, and at its length nothing is left to be sought.
    pub(crate) seek: Option<u64>,
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
pub(crate) fn search(
    task: &Task,
    limits: &Limits,
    turn: Turn,
    inherited: Option<&Inherited<'_>>,
) -> Result<(Option<Outcome>, Learned), Unfinished> {
    let mut extractor = Extractor::new(task, limits, turn);
    let mut graph = PlanningGraph::new(task);
    let found = by_levels(&mut graph, &mut extractor, inherited);
    extractor.note(&graph);
    match found {
        Ok(outcome) => {
            let fewest_steps = graph.top();
            let no_goods = extractor.search.into_no_goods();
            let (task, state) = (task.clone(), task.init.clone());
            Ok((outcome, Learned { task, graph, no_goods, fewest_steps, state, done: 0 }))
        }
        Err(limit) => {
            let (at_least, plan) = (extractor.at_least, extractor.known);
            Err(Unfinished { at_least, plan, ..limit.into() })
        }
    }
}

/// What a search comes to, if it does, and what it took.
pub(crate) fn search_counted(task: &Task, limits: &Limits, turn: Turn) -> (Option<Outcome>, u64) {
    let mut extractor = Extractor::new(task, limits, turn);
    let mut graph = PlanningGraph::new(task);
    let outcome = by_levels(&mut graph, &mut extractor, None);
    (outcome.ok().flatten(), extractor.effort(&graph))
}

/// A task on which one proof after the other is tried, each with more effort: without the operators that no shortest
/// plan needs, where it is large.
pub(crate) enum Working<'t> {
    Whole(&'t Task),
    Reduced(needed::Reduced),
}

impl<'t> Working<'t> {
    pub(crate) fn of(task: &'t Task, limits: &Limits) -> Result<Self, Limit> {
        if task.facts.len() < LARGE {
            return Ok(Self::Whole(task));
        }
        let reduced = needed::Reduced::of(task, limits)?;
        // Little is won by little less, and lost what is known in terms of the whole.
        let is_worth_it = 2 * reduced.task.operators.len() <= task.operators.len();
        Ok(if is_worth_it { Self::Reduced(reduced) } else { Self::Whole(task) })
    }

    pub(crate) fn task(&self) -> &Task {
        match self {
            Self::Whole(task) => task,
            Self::Reduced(reduced) => &reduced.task,
        }
    }

    /// A fact of the whole in terms of this task, if it plays a part in it.
    pub(crate) fn fact(&self, whole: FactId) -> Option<FactId> {
        match self {
            Self::Whole(_) => Some(whole),
            Self::Reduced(reduced) => {
                reduced.task.fact_ids().find(|&own| reduced.fact(own) == whole)
            }
        }
    }

    /// A plan of this task in terms of the whole.
    pub(crate) fn own(&self, plan: Plan) -> Plan {
        match self {
            Self::Whole(_) => plan,
            Self::Reduced(reduced) => reduced.own(plan),
        }
    }
}

/// What a proof with little effort came to.
pub(crate) enum Tried {
    Plan(Plan),
    NoPlan,
    /// Proven: no plan has fewer steps. With the limit that ended it, if it was not the effort allowed.
    AtLeast(usize, Option<Limit>),
}

/// The fewest steps, as far as so much effort tells; from `ceiling` steps on there is nothing to be found.
pub(crate) fn prove(task: &Task, ceiling: usize, effort: u64, limits: &Limits) -> Tried {
    let turn = Turn { effort: Some(effort), seek: None, ..Turn::default() };
    let steps = limits.parallel_steps.min(ceiling.saturating_sub(1));
    let limits = Limits { parallel_steps: steps, ..limits.clone() };
    let search = || -> Result<Tried, Limit> {
        let mut extractor = Extractor::new(task, &limits, turn);
        let mut graph = PlanningGraph::new(task);
        let outcome = by_levels(&mut graph, &mut extractor, None);
        extractor.note(&graph);
        let at_least = extractor.at_least;
        Ok(match outcome {
            Ok(Some(Outcome::Plan(plan))) => Tried::Plan(plan),
            Ok(Some(_)) => Tried::NoPlan,
            Ok(None) => Tried::AtLeast(at_least, None),
            Err(Limit::Steps) if at_least >= ceiling => Tried::AtLeast(ceiling, None),
            Err(limit) => Tried::AtLeast(at_least, Some(limit)),
        })
    };
    with_stack(search).unwrap_or_else(|limit| Tried::AtLeast(0, Some(limit)))
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
                        parallel::drop_needless(task, &mut plan.steps);
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
    /// The fourth way, once it has its turn, and how many of its kinds were thought of.
    states: Vec<Box<dyn StateSearch + 'a>>,
    state_searches: usize,
    /// A plan, of whatever length.
    known: Option<Plan>,
    /// Whether forward search was asked for any plan.
    has_sought: bool,
    /// Fewer steps than these are refuted.
    at_least: usize,
    /// No walk that the goal asks for has fewer.
    walked: usize,
}

/// Forward search gets this part of the memory for it.
const SEEKING_OF_MEMORY: usize = 4;

/// What is known is made shorter each time that so many times the effort was spent, by such a part of it.
const SEEKING_AGAIN: u64 = 4;
const SEEKING_SHARE: u64 = 64;

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
            states: Vec::new(),
            state_searches: 0,
            known: None,
            has_sought: false,
            at_least: 0,
            walked: 0,
        }
    }

    fn bytes(&self) -> usize {
        let induction = self.induction.as_ref().map_or(0, Induction::bytes);
        let states: usize = self.states.iter().map(|search| search.bytes()).sum();
        self.search.bytes() + self.encoding.bytes() + induction + states
    }

    /// What was spent so far, in variables set by the solver and what takes as long.
    fn effort(&self, graph: &PlanningGraph) -> u64 {
        let induction = self.induction.as_ref().map_or(0, Induction::effort);
        let choices = self.search.choices() * EFFORT_A_CHOICE;
        let states: u64 = self.states.iter().map(|search| search.effort()).sum();
        graph.effort() + choices + self.encoding.effort() + induction + states
    }

    fn note(&self, graph: &PlanningGraph) {
        let (levels, nodes) = (graph.top(), self.search.choices());
        self.limits.note(Attempt::new(Way::Proof, levels, nodes, self.effort(graph)));
    }

    /// The fewest steps are no more than those of a plan found soon, and no fewer than those of the walk that the goal
    /// asks for, if it does. It is made shorter as the proof takes longer.
    fn seek(&mut self, graph: &PlanningGraph) -> Result<(), Limit> {
        let effort = self.effort(graph);
        if self.turn.seek.is_none_or(|from| effort < from) {
            return Ok(());
        }
        self.turn.seek = Some(effort.saturating_mul(SEEKING_AGAIN));
        let memory_bytes = self.limits.memory_bytes / SEEKING_OF_MEMORY;
        let shorten_effort = effort / SEEKING_SHARE;
        let limits = Limits { memory_bytes, shorten_effort, ..self.limits.quiet() };
        if !std::mem::replace(&mut self.has_sought, true) {
            return self.seek_any(&limits);
        }
        if let Some(known) = &self.known {
            self.offer(rounds::shortened(self.task, known.clone(), &limits, None));
        }
        Ok(())
    }

    fn seek_any(&mut self, limits: &Limits) -> Result<(), Limit> {
        let mut found = Ok(None);
        if let Some(errands) = Errands::of(self.task) {
            self.walked = errands.at_least;
            found = any::in_order(self.task, &errands.stages, limits);
        }
        if matches!(found, Ok(None)) && self.known.is_none() {
            found = any::search(self.task, limits, any::Effort::Least).map(any::Found::plan);
        }
        match found {
            Ok(Some(plan)) => self.offer(plan),
            Err(limit @ (Limit::Time | Limit::Stopped)) => return Err(limit),
            Ok(None) | Err(_) => {}
        }
        Ok(())
    }

    /// Keeps a plan if it has fewer steps than the one that is known.
    fn offer(&mut self, plan: Plan) {
        if self.known.as_ref().is_none_or(|known| plan.steps.len() < known.steps.len()) {
            self.limits.tell_of(&plan);
            self.known = Some(plan);
        }
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
            if graph.top() < self.walked {
                return Ok(Extraction::None);
            }
            if let Some(plan) = self.known_at(graph) {
                return Ok(Extraction::Plan(plan));
            }
            if let Some(extraction) = self.induce(graph)? {
                return Ok(extraction);
            }
            if let Some(extraction) = self.look_at_states(graph)? {
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
            if self.turn.effort.is_some_and(|most| self.effort(graph) > most) {
                return Ok(Extraction::Open);
            }
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
        let effort = self.search.choices() * INDUCTION_A_CHOICE + self.encoding.effort();
        let begins = (EFFORT_A_LEVEL * beyond * beyond).min((effort + graph.effort()) / 2);
        let share = begins + effort / INDUCTION_SHARE;
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

    /// Where there are few states, up to exchanges of what is alike, looking at them all is the shortest proof. Once the
    /// graph has leveled off and something was spent in vain, this gets a share of the effort.
    fn look_at_states(&mut self, graph: &PlanningGraph) -> Result<Option<Extraction>, Limit> {
        if graph.leveled_off_at().is_none() {
            return Ok(None);
        }
        let effort = self.search.choices() * EFFORT_A_CHOICE + self.encoding.effort();
        self.begin_to_look(graph, effort);
        for search in &mut self.states {
            if search.is_given_up() || search.at_least() > graph.top() {
                continue;
            }
            match search.go_on(effort / search.share(), self.limits)? {
                Progress::Plan(plan) => self.known = Some(plan),
                Progress::Never => return Ok(Some(Extraction::Never(self.task.goal.clone()))),
                Progress::Open => {}
            }
        }
        let at_least = self.states.iter().map(|search| search.at_least()).max().unwrap_or_default();
        Ok(match self.known_at(graph) {
            Some(plan) => Some(Extraction::Plan(plan)),
            None => (graph.top() < at_least).then_some(Extraction::None),
        })
    }

    /// Begins the next search through states that the task allows, once so much was spent.
    fn begin_to_look(&mut self, graph: &PlanningGraph, effort: u64) {
        let task = self.task;
        match self.state_searches {
            0 if effort >= EFFORT_BEFORE_BOTH_ENDS => {
                self.states.extend(BothEnds::of(task, graph).map(|ends| Box::new(ends) as _));
            }
            1 if effort >= EFFORT_BEFORE_STATES => {
                let groups = match self.encoding.is_serial() {
                    true => vec![0; task.operators.len()],
                    false => fewest::groups(task, graph),
                };
                self.states.extend(Onward::of(task, &groups).map(|onward| Box::new(onward) as _));
            }
            _ => return,
        }
        self.state_searches += 1;
    }
}
