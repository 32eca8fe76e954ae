//! Extraction by satisfiability (H. Kautz, B. Selman, 1999): the planning graph as clauses.
//!
//! One variable says that a fact holds at a level, one that an operator is carried out in a step. Levels are
//! added once and kept, with all that the solver learned about them; the goal is assumed at the last one.

use super::counting::Counter;
use super::first_use::FirstUse;
use super::graph::{ActionId, PlanningGraph};
use super::serial::Serial;
use super::solver::{Answer, Literal, Solver};
use super::transition::{Transition, Variables, add_mutexes};
use crate::plan::Plan;
use crate::strips::{FactId, OperatorId, Task};
use crate::{Limit, Limits};

pub(crate) struct Encoding<'a> {
    task: &'a Task,
    limits: Limits,
    solver: Solver,
    /// Per level, the variable of each fact that may hold there.
    facts: Vec<Vec<Option<Literal>>>,
    /// Per step, the variable of each operator that may be carried out there.
    operators: Vec<Vec<Option<Literal>>>,
    transition: Transition<'a>,
    /// The least number of steps before the end at which an operator can serve the goal.
    relevant_from: Vec<u32>,
    /// What is said of the length looked at; withdrawn with the next.
    horizon: Option<(usize, Literal)>,
    /// So many steps are said to carry out something.
    busy: usize,
    /// What can hold after so many steps that follow one another singly, if they do.
    serial: Option<Serial>,
    /// For each operator those that would only undo it.
    undone_by: Vec<Vec<OperatorId>>,
    /// Interchangeable objects and their order, once there is a level.
    first_use: Option<FirstUse>,
    /// What is still to be done at each level, once that is worth counting.
    counter: Option<Counter>,
    /// Whether it was asked if counting is worth it.
    asked_to_count: bool,
}

/// Conflicts after which counting is thought of: most lengths are decided sooner.
const BEFORE_COUNTING: u64 = 1 << 11;

/// What the solver found out about a number of steps.
pub(crate) enum Verdict {
    Plan(Plan),
    /// No plan of this many steps.
    None,
    /// The effort allowed was not enough.
    Open,
}

impl<'a> Encoding<'a> {
    /// `shorter_refuted` promises that plans are looked for of a length only once every shorter one is refuted.
    pub(crate) fn new(task: &'a Task, shorter_refuted: bool, limits: &Limits) -> Self {
        let serial = if shorter_refuted { Serial::of(task, limits) } else { None };
        Self {
            task,
            limits: limits.clone(),
            solver: Solver::new(limits),
            facts: Vec::new(),
            operators: Vec::new(),
            transition: Transition::new(task),
            relevant_from: relevance(task),
            horizon: None,
            busy: 0,
            undone_by: undoing(task),
            serial,
            first_use: None,
            counter: None,
            asked_to_count: false,
        }
    }

    /// An assumption under which no operator is carried out that comes too late to serve the goal.
    fn horizon(&mut self, level: usize) -> Literal {
        if let Some((length, literal)) = self.horizon {
            if length == level {
                return literal;
            }
            self.solver.add_clause(&[!literal]);
        }
        self.keep_busy(level);
        let literal = self.solver.new_variable();
        for (step, operators) in self.operators[..level].iter().enumerate() {
            for (operator, &from) in operators.iter().zip(&self.relevant_from) {
                if let (Some(done), true) = (*operator, from as usize > level - step) {
                    self.solver.add_clause(&[!literal, !done]);
                }
            }
        }
        if let Some(counter) = &self.counter {
            counter.bound(&mut self.solver, literal, level);
        }
        self.horizon = Some((level, literal));
        literal
    }

    /// A plan with an idle step would do with one step less, and that is refuted. Where one hand does everything, this
    /// tells what each step must be about.
    fn keep_busy(&mut self, level: usize) {
        while self.serial.is_some() && self.busy < level {
            let done: Vec<Literal> = self.operators[self.busy].iter().flatten().copied().collect();
            self.solver.add_clause(&done);
            self.busy += 1;
        }
    }

    /// Where lengths are hard to decide, what is still to be done is counted.
    fn count(&mut self, graph: &PlanningGraph) {
        let hard = self.solver.conflicts() >= BEFORE_COUNTING && graph.leveled_off_at().is_some();
        if hard && !std::mem::replace(&mut self.asked_to_count, true) {
            self.counter = Counter::new(self.task, graph);
            if let (Some(_), Some((_, old))) = (&self.counter, self.horizon.take()) {
                self.solver.add_clause(&[!old]);
            }
        }
        if let Some(counter) = &mut self.counter {
            counter.reach(&mut self.solver, &self.operators);
        }
    }

    /// Looks for a plan as long as the graph, with so many conflicts at most.
    pub(crate) fn extract(
        &mut self,
        graph: &PlanningGraph,
        conflicts: u64,
        limits: &Limits,
    ) -> Result<Verdict, Limit> {
        self.extract_within(graph, &[], conflicts, limits)
    }

    /// The same, under further assumptions.
    pub(crate) fn extract_within(
        &mut self,
        graph: &PlanningGraph,
        assumptions: &[Literal],
        conflicts: u64,
        limits: &Limits,
    ) -> Result<Verdict, Limit> {
        self.reach(graph, limits)?;
        self.count(graph);
        let level = graph.top();
        let wanted: Option<Vec<Literal>> =
            self.task.goal.iter().map(|goal| self.facts[level][goal.index()]).collect();
        let Some(mut assumed) = wanted else { return Ok(Verdict::None) };
        assumed.push(self.horizon(level));
        assumed.extend(assumptions);
        Ok(match self.solver.solve(&assumed, conflicts) {
            Answer::Satisfiable => Verdict::Plan(self.plan(level)),
            Answer::Unsatisfiable => Verdict::None,
            Answer::Open => {
                limits.check(self.bytes() + graph.bytes())?;
                Verdict::Open
            }
        })
    }

    /// Adds the levels that the graph has and the formula has not.
    pub(crate) fn reach(&mut self, graph: &PlanningGraph, limits: &Limits) -> Result<(), Limit> {
        while self.facts.len() <= graph.top() {
            self.add_level(graph);
            limits.check(self.bytes() + graph.bytes())?;
        }
        Ok(())
    }

    /// The variable of an operator in a step, if it may be carried out there to any purpose.
    pub(crate) fn operator(
        &self,
        graph: &PlanningGraph,
        step: usize,
        id: OperatorId,
    ) -> Option<Literal> {
        let serves = self.relevant_from[id.index()] as usize <= graph.top() - step;
        self.operators[step][id.index()].filter(|_| serves)
    }

    pub(crate) fn solver(&mut self) -> &mut Solver {
        &mut self.solver
    }

    /// Whether each step is known to carry out one operator.
    pub(crate) fn is_serial(&self) -> bool {
        self.serial.is_some()
    }

    /// Conflicts met so far.
    pub(crate) fn conflicts(&self) -> u64 {
        self.solver.conflicts()
    }

    /// Variables set so far, over and over.
    pub(crate) fn effort(&self) -> u64 {
        self.solver.effort()
    }

    pub(crate) fn bytes(&self) -> usize {
        self.solver.bytes()
    }

    fn add_level(&mut self, graph: &PlanningGraph) {
        let level = self.facts.len();
        if let (Some(serial), true) = (&mut self.serial, level > 0) {
            serial.reach(self.task);
        }
        let possible = |fact: FactId| {
            graph.fact_level(fact) as usize <= level
                && self.serial.as_ref().is_none_or(|serial| serial.holds(level, fact))
        };
        let facts: Vec<Option<Literal>> = self
            .task
            .fact_ids()
            .map(|fact| possible(fact).then(|| self.solver.new_variable()))
            .collect();
        self.facts.push(facts);
        if level > 0 {
            self.add_step(graph, level - 1);
        } else {
            for fact in &self.task.init {
                let holds = self.facts[0][fact.index()].expect("what holds at first is at level 0");
                self.solver.add_clause(&[holds]);
            }
        }
        add_mutexes(&mut self.solver, graph, level, &self.facts[level]);
    }

    fn add_step(&mut self, graph: &PlanningGraph, step: usize) {
        let possible = |id: OperatorId| {
            graph.action_level(ActionId(id.0)) as usize <= step
                && self.serial.as_ref().is_none_or(|serial| serial.allows(self.task, step, id))
        };
        let variables: Vec<Option<Literal>> = self
            .task
            .operator_ids()
            .map(|id| possible(id).then(|| self.solver.new_variable()))
            .collect();
        let (before, after) = (&self.facts[step], &self.facts[step + 1]);
        self.transition.add(&mut self.solver, (graph, step), (before, &variables, after));
        if let Some(before) = self.operators.last() {
            for (done, undoing) in before.iter().zip(&self.undone_by) {
                let Some(done) = *done else { continue };
                for undone in undoing.iter().filter_map(|id| variables[id.index()]) {
                    self.solver.add_clause(&[!done, !undone]);
                }
            }
        }
        let first_use = self.first_use.get_or_insert_with(|| FirstUse::of(self.task, &self.limits));
        first_use.add_step(&mut self.solver, &variables);
        self.operators.push(variables);
    }

    /// The operators of a model that are needed: those that first make a needed fact hold.
    fn plan(&self, level: usize) -> Plan {
        let is_true = |variables: &Variables, number: usize| {
            variables[number].is_some_and(|variable| self.solver.value(variable))
        };
        let mut needed = self.task.goal.clone();
        needed.sort_unstable();
        let mut steps = Vec::new();
        for step in (0..level).rev() {
            let held = |fact: FactId| is_true(&self.facts[step], fact.index());
            let done = |id: OperatorId| is_true(&self.operators[step], id.index());
            let (chosen, before) = self.transition.causes(&needed, held, done);
            steps.push(chosen);
            needed = before;
        }
        steps.reverse();
        Plan { steps }
    }
}

/// How many steps before the end an operator must come at the latest: what adds a goal in the last, what adds a
/// precondition of one of those in the last but one.
fn relevance(task: &Task) -> Vec<u32> {
    let achievers = task.added_by();
    let mut from = vec![u32::MAX; task.operators.len()];
    let mut asked = vec![false; task.facts.len()];
    let mut wanted = task.goal.clone();
    for distance in 1.. {
        let mut next = Vec::new();
        for fact in std::mem::take(&mut wanted) {
            if std::mem::replace(&mut asked[fact.index()], true) {
                continue;
            }
            for &id in &achievers[fact.index()] {
                if from[id.index()] == u32::MAX {
                    from[id.index()] = distance;
                    next.extend(&task.operator(id).preconditions);
                }
            }
        }
        if next.is_empty() {
            break;
        }
        wanted = next;
    }
    from
}

/// For each operator those of which the next step is rid in a plan of the fewest actions: they take away all that it
/// adds, and bring back only what held before it. Without both, as much holds after them, and what holds in between
/// instead is missed by nobody: who needs what the one adds is barred by the other, which deletes it.
fn undoing(task: &Task) -> Vec<Vec<OperatorId>> {
    let deleted_by = task.deleted_by();
    let undone_by = |id: OperatorId| -> Vec<OperatorId> {
        let one = task.operator(id);
        let Some(added) = one.add_effects.first() else { return Vec::new() };
        let undoes = |other: &&OperatorId| {
            let other = task.operator(**other);
            one.add_effects.iter().all(|fact| other.del_effects.binary_search(fact).is_ok())
                && other
                    .add_effects
                    .iter()
                    .all(|fact| one.preconditions.binary_search(fact).is_ok())
        };
        deleted_by[added.index()].iter().filter(undoes).copied().collect()
    };
    task.operator_ids().map(undone_by).collect()
}
