//! Proof by induction over the number of steps: *property-directed reachability* (A. Bradley, 2011, "IC3"; N. Eén,
//! A. Mishchenko, R. Brayton, 2011; for planning M. Suda, 2014).
//!
//! For each number of steps some sets of facts are known that cannot all hold by then. The goal is taken back one
//! step at a time; where what is known of the level below leaves no step that brings a set about, the solver tells
//! which facts of it are to blame. As many of them as can be are left out, as long as the rest does not hold at first
//! and no step brings it about from where it does not hold. A set that no step brings about from the level that it
//! fails at fails at the next level as well; once all of a level do, there is no plan of any length.
//!
//! Where the solver of [`super::sat`] refutes one length after the other for ever, as goals that fit by pairs and
//! not together make it do, this comes to an end.

use super::graph::{ActionId, PlanningGraph};
use super::solver::{Answer, Literal, Solver};
use super::transition::{Transition, add_mutexes};
use crate::plan::Plan;
use crate::strips::{FactId, OperatorId, Task};
use crate::{Limit, Limits};

pub(crate) enum Proof {
    /// A plan, maybe longer than need be.
    Plan(Plan),
    /// No plan, because of these goals.
    Never(Vec<FactId>),
    /// The effort allowed was not enough.
    Open,
}

pub(crate) struct Induction<'a> {
    task: &'a Task,
    limits: &'a Limits,
    solver: Solver,
    transition: Transition<'a>,
    /// Variables of the facts before the step that is looked at, of its operators, and of the facts after it.
    before: Vec<Option<Literal>>,
    operators: Vec<Option<Literal>>,
    after: Vec<Option<Literal>>,
    initially: Vec<bool>,
    /// From the initial state on.
    levels: Vec<Level>,
    /// Sets of facts that would lead to the goal, by the level that they are looked for at.
    open: Vec<Vec<Subgoal>>,
    /// How the goal is made of them.
    made: Vec<Step>,
    /// Levels up to this one were gone through for sets that fail at the next as well.
    pushed: usize,
}

/// Sets of facts that fail up to a level and, as far as is known, not at the next.
struct Level {
    /// Makes the solver heed them.
    heeded: Literal,
    fails: Vec<Vec<FactId>>,
}

struct Subgoal {
    facts: Vec<FactId>,
    /// The step that it is wanted for.
    wanted_for: Option<usize>,
}

struct Step {
    operators: Vec<OperatorId>,
    then: Option<usize>,
}

/// What a step from one level makes of a set of facts.
enum Reply {
    /// It brings it about: the operators, and what they need.
    Reached(Vec<OperatorId>, Vec<FactId>),
    /// These facts of it fail, up to that level.
    Failed(Vec<FactId>, usize),
}

impl<'a> Induction<'a> {
    /// The graph has leveled off: what excludes each other does so for good.
    pub(crate) fn new(task: &'a Task, graph: &PlanningGraph, limits: &'a Limits) -> Self {
        let mut solver = Solver::new(limits);
        let top = graph.top();
        let mut facts = || -> Vec<Option<Literal>> {
            let possible = |fact| graph.fact_level(fact) as usize <= top;
            task.fact_ids().map(|f| possible(f).then(|| solver.new_variable())).collect()
        };
        let (before, after) = (facts(), facts());
        let possible = |id: OperatorId| graph.action_level(ActionId(id.0)) as usize <= top;
        let operators: Vec<Option<Literal>> =
            task.operator_ids().map(|id| possible(id).then(|| solver.new_variable())).collect();
        let transition = Transition::new(task);
        transition.add(&mut solver, (graph, top), (&before, &operators, &after));
        add_mutexes(&mut solver, graph, top, &before);
        add_mutexes(&mut solver, graph, top, &after);
        let mut initially = vec![false; task.facts.len()];
        task.init.iter().for_each(|fact| initially[fact.index()] = true);
        let mut own = Self {
            task,
            limits,
            solver,
            transition,
            before,
            operators,
            after,
            initially,
            levels: Vec::new(),
            open: Vec::new(),
            made: Vec::new(),
            pushed: 0,
        };
        own.add_level();
        // Of what holds at first some may be forgotten: more facts never harm a plan.
        for (fact, before) in own.before.iter().enumerate() {
            if let (Some(holds), false) = (*before, own.initially[fact]) {
                own.solver.add_clause(&[!own.levels[0].heeded, !holds]);
            }
        }
        own
    }

    fn add_level(&mut self) {
        let heeded = self.solver.new_switch();
        self.levels.push(Level { heeded, fails: Vec::new() });
    }

    /// Every plan has more steps than this.
    pub(crate) fn refuted(&self) -> usize {
        self.levels.len().saturating_sub(2)
    }

    pub(crate) fn bytes(&self) -> usize {
        self.solver.bytes()
    }

    /// What the solver spent so far.
    pub(crate) fn effort(&self) -> u64 {
        self.solver.effort()
    }

    /// Goes on until there is an answer or so much effort was spent in all.
    pub(crate) fn go_on(&mut self, effort: u64) -> Result<Proof, Limit> {
        loop {
            let top = self.levels.len() - 1;
            if self.pushed == top {
                self.add_level();
                self.pushed = 0;
                self.made.clear();
                self.open = (0..=top + 1).map(|_| Vec::new()).collect();
                self.open[top + 1] =
                    vec![Subgoal { facts: self.task.goal.clone(), wanted_for: None }];
            }
            while let Some(level) = self.open.iter().position(|open| !open.is_empty()) {
                if self.effort() >= effort {
                    return Ok(Proof::Open);
                }
                if let Some(plan) = self.take_back(level)? {
                    return Ok(Proof::Plan(plan));
                }
            }
            while self.pushed < self.levels.len() - 1 {
                if self.effort() >= effort {
                    return Ok(Proof::Open);
                }
                if self.push(self.pushed)? {
                    return Ok(Proof::Never(self.to_blame()));
                }
                self.pushed += 1;
            }
        }
    }

    /// Deals with a subgoal of a level: a plan, if it was the last to be made.
    fn take_back(&mut self, level: usize) -> Result<Option<Plan>, Limit> {
        let Some(Subgoal { facts, wanted_for }) = self.open[level].pop() else { return Ok(None) };
        if self.hold_at_first(&facts) {
            return Ok(Some(self.plan(wanted_for)));
        }
        if self.is_known(&facts, level) {
            return Ok(None);
        }
        match self.ask(&facts, level, true)? {
            Reply::Reached(operators, needs) => {
                self.made.push(Step { operators, then: wanted_for });
                let made = Some(self.made.len() - 1);
                self.open[level].push(Subgoal { facts, wanted_for });
                self.open[level - 1].push(Subgoal { facts: needs, wanted_for: made });
            }
            Reply::Failed(blamed, up_to) => {
                let up_to = self.learn(blamed, up_to, true)?;
                // What fails so soon may lead to the goal later on. A plan come to in this way may be too long.
                if up_to + 1 < self.levels.len() {
                    self.open[up_to + 1].push(Subgoal { facts, wanted_for });
                }
            }
        }
        Ok(None)
    }

    fn plan(&self, first: Option<usize>) -> Plan {
        let steps = std::iter::successors(first, |&made| self.made[made].then);
        Plan { steps: steps.map(|made| self.made[made].operators.clone()).collect() }
    }

    /// Moves up the sets of a level that one step more does not bring about; whether none is left.
    fn push(&mut self, level: usize) -> Result<bool, Limit> {
        if level == 0 {
            return Ok(false);
        }
        for set in self.levels[level].fails.clone() {
            // A smaller one may have taken its place.
            let is_there = self.levels[level].fails.contains(&set);
            if is_there && let Reply::Failed(set, up_to) = self.ask(&set, level + 1, false)? {
                self.insert(set, up_to);
            }
        }
        Ok(self.levels[level].fails.is_empty())
    }

    /// Goals that fail at the last level, which is any.
    fn to_blame(&self) -> Vec<FactId> {
        let goal = &self.task.goal;
        let within = |set: &&Vec<FactId>| set.iter().all(|fact| goal.contains(fact));
        let sets = self.levels.iter().rev().flat_map(|level| &level.fails);
        sets.into_iter().find(within).unwrap_or(goal).clone()
    }

    fn is_known(&self, facts: &[FactId], level: usize) -> bool {
        let mut sets = self.levels[level..].iter().flat_map(|level| &level.fails);
        sets.any(|set| is_within(set, facts))
    }

    /// Whether a step from the level below brings facts about; from where they do not all hold, if so wished.
    fn ask(&mut self, facts: &[FactId], level: usize, not_before: bool) -> Result<Reply, Limit> {
        self.limits.check(self.bytes())?;
        let top = self.levels.len() - 1;
        if let Some(&never) = facts.iter().find(|fact| self.after[fact.index()].is_none()) {
            return Ok(Reply::Failed(vec![never], top));
        }
        let wanted = |fact: &FactId, of: &[Option<Literal>]| of[fact.index()].expect("seen above");
        let mut assumed: Vec<Literal> = facts.iter().map(|f| wanted(f, &self.after)).collect();
        let without = not_before.then(|| {
            let without = self.solver.new_switch();
            let missing = facts.iter().map(|fact| !wanted(fact, &self.before));
            let clause: Vec<Literal> = missing.chain([!without]).collect();
            self.solver.add_clause(&clause);
            without
        });
        assumed.extend(without);
        // Whatever fails farther on fails here as well; at first all that does not hold.
        let heeded = if level == 1 { &self.levels[..1] } else { &self.levels[level - 1..] };
        assumed.extend(heeded.iter().rev().map(|level| level.heeded));
        let reply = match self.solver.solve(&assumed, u64::MAX >> 1) {
            Answer::Open => return Err(Limit::Time),
            Answer::Satisfiable => {
                let is_true = |variable: Option<Literal>| {
                    variable.is_some_and(|variable| self.solver.value(variable))
                };
                let held = |fact: FactId| is_true(self.before[fact.index()]);
                let done = |id: OperatorId| is_true(self.operators[id.index()]);
                let (operators, needs) = self.transition.causes(facts, held, done);
                Reply::Reached(operators, needs)
            }
            Answer::Unsatisfiable => {
                let blamed = self.solver.blamed();
                let is_blamed = |fact: &FactId| blamed.contains(&wanted(fact, &self.after));
                let mut fewer: Vec<FactId> = facts.iter().copied().filter(is_blamed).collect();
                if self.hold_at_first(&fewer) {
                    fewer.extend(facts.iter().find(|fact| !self.initially[fact.index()]));
                    fewer.sort_unstable();
                }
                let lowest =
                    (level - 1..=top).find(|&below| blamed.contains(&self.levels[below].heeded));
                Reply::Failed(fewer, lowest.map_or(top, |below| (below + 1).min(top)))
            }
        };
        if let Some(without) = without {
            self.solver.add_clause(&[!without]);
        }
        Ok(reply)
    }

    /// Keeps a failure with as few facts as can be, at that level or a later one, which is told.
    ///
    /// Where without some fact the rest could be come to, what it would be come to from may fail for a reason of its
    /// own, and when that is known the fact may be left out (Z. Hassan, A. Bradley, F. Somenzi, 2013,
    /// "counterexamples to generalization").
    fn learn(
        &mut self,
        mut set: Vec<FactId>,
        mut level: usize,
        goes_back: bool,
    ) -> Result<usize, Limit> {
        const MOST_REASONS: usize = 3;
        let mut at = 0;
        let mut reasons = 0;
        while at < set.len() {
            let mut fewer = set.clone();
            fewer.remove(at);
            let needs = match self.hold_at_first(&fewer) {
                true => None,
                false => match self.ask(&fewer, level, true)? {
                    Reply::Failed(fewer, up_to) => {
                        (set, level) = (fewer, up_to);
                        reasons = 0;
                        continue;
                    }
                    Reply::Reached(_, needs) => Some(needs),
                },
            };
            if goes_back
                && reasons < MOST_REASONS
                && let Some(needs) = needs.filter(|needs| level > 1 && !self.hold_at_first(needs))
                && let Reply::Failed(blamed, up_to) = self.ask(&needs, level - 1, true)?
            {
                self.learn(blamed, up_to, false)?;
                reasons += 1;
            } else {
                at += 1;
                reasons = 0;
            }
        }
        self.insert(set, level);
        Ok(level)
    }

    fn hold_at_first(&self, facts: &[FactId]) -> bool {
        facts.iter().all(|fact| self.initially[fact.index()])
    }

    fn insert(&mut self, set: Vec<FactId>, level: usize) {
        let hold = set.iter().filter_map(|fact| self.before[fact.index()]);
        let clause: Vec<Literal> =
            hold.map(|holds| !holds).chain([!self.levels[level].heeded]).collect();
        self.solver.add_clause(&clause);
        for level in &mut self.levels[..=level] {
            level.fails.retain(|old| !is_within(&set, old));
        }
        self.levels[level].fails.push(set);
    }
}

/// Whether all facts of a set are among others; both are sorted.
fn is_within(set: &[FactId], others: &[FactId]) -> bool {
    let mut others = others.iter();
    set.len() <= others.len() && set.iter().all(|fact| others.any(|other| other == fact))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::random_task;
    use crate::tests::fewest_steps;
    use crate::validate;

    fn is_solvable(task: &Task, effort: u64) -> bool {
        let limits = Limits::default();
        let mut graph = PlanningGraph::new(task);
        while graph.leveled_off_at().is_none() {
            graph.expand(None, &limits).unwrap();
        }
        let mut induction = Induction::new(task, &graph, &limits);
        loop {
            let allowed = induction.effort() + effort;
            match induction.go_on(allowed).unwrap() {
                Proof::Plan(plan) => {
                    assert_eq!(validate(task, &plan), Ok(()));
                    assert!(
                        plan.steps.is_empty() || induction.refuted() < fewest_steps(task).unwrap()
                    );
                    return true;
                }
                Proof::Never(goals) => {
                    assert!(goals.iter().all(|goal| task.goal.contains(goal)));
                    let some = Task { goal: goals, ..task.clone() };
                    assert_eq!(fewest_steps(&some), None, "the goals to blame suffice");
                    return false;
                }
                Proof::Open => {}
            }
        }
    }

    #[test]
    fn proofs_by_induction_agree_with_breadth_first_search() {
        let (mut plans, mut none) = (0, 0);
        for seed in 1..=3000 {
            let task = random_task(seed);
            let solvable = fewest_steps(&task).is_some();
            assert_eq!(is_solvable(&task, 1 + seed % 40), solvable, "seed {seed}");
            *if solvable { &mut plans } else { &mut none } += 1;
        }
        assert!(plans > 300 && none > 300, "{plans} {none}");
    }
}
