//! Backward search for a plan in the planning graph, with no-goods generalised by explanation.
//!
//! A level's goals get their actions one by one; the preconditions of the actions chosen are the goals of the
//! level before. A failure is explained by the goals that took part in it (S. Kambhampati's EBL and DDB, 2000): the
//! search jumps back to the last of them, and the explanation, usually far smaller than the set of goals, is
//! remembered with its level.
//!
//! Past level-off the graph repeats itself, and a no-good that one more step of actions cannot undo is pushed one
//! level up. Once some level keeps no no-good of its own, those of the next are closed under every choice of
//! actions: no plan of any length exists. (The argument is that of property-directed reachability, and sharper
//! than counting memos as Blum and Furst did, for an explanation need not come out the same twice.)

use super::graph::{ActionId, PlanningGraph};
use super::no_good::NoGoods;
use super::rivals::Rivals;
use super::symmetry::Symmetry;
use crate::bits;
use crate::plan::Plan;
use crate::strips::{FactId, OperatorId, Task};
use crate::{Limit, Limits};

pub(crate) enum Extraction {
    Plan(Plan),
    /// Not with this many steps.
    None,
    /// Not with any number of steps, because of these goals.
    Never(Vec<FactId>),
    /// The effort allowed was not enough.
    Open,
}

pub(crate) struct Search<'a> {
    task: &'a Task,
    limits: Limits,
    no_goods: NoGoods,
    rivals: Rivals,
    ticks: u64,
    /// Ticks at which the search gives up for now.
    allowed: u64,
    /// The highest level of a no-good that was not derived here.
    inherited_up_to: u32,
}

/// The choices made at one level.
struct Level<'g> {
    graph: &'g PlanningGraph,
    level: usize,
    goals: Vec<FactId>,
    /// The action chosen for the goal of that index.
    chosen: Vec<(ActionId, usize)>,
    /// Whether the levels below are searched, or only asked for known no-goods.
    deep: bool,
}

/// Why a choice failed: either goals of the level, or the search stops.
enum Failure {
    Goals(GoalSet),
    Stop(Stop),
}

/// Why the search stops without an answer.
enum Stop {
    Limit(Limit),
    Effort,
}

/// A set of indices into a level's goals: of so few as there mostly are, nothing is kept elsewhere.
#[derive(Clone, Default)]
struct GoalSet {
    first: u64,
    rest: Vec<u64>,
}

impl GoalSet {
    fn one(index: usize) -> Self {
        let mut set = Self::default();
        set.insert(index);
        set
    }

    fn insert(&mut self, index: usize) {
        match index.checked_sub(64) {
            None => self.first |= 1 << index,
            Some(index) => {
                let words = bits::words(index + 1).max(self.rest.len());
                self.rest.resize(words, 0);
                bits::put(&mut self.rest, index);
            }
        }
    }

    fn contains(&self, index: usize) -> bool {
        match index.checked_sub(64) {
            None => self.first >> index & 1 == 1,
            Some(index) => index / 64 < self.rest.len() && bits::has(&self.rest, index),
        }
    }

    fn union(&mut self, other: &Self) {
        self.first |= other.first;
        self.rest.resize(self.rest.len().max(other.rest.len()), 0);
        bits::unite(&mut self.rest, &other.rest);
    }

    fn members(&self) -> impl Iterator<Item = usize> {
        bits::of_word(self.first).chain(bits::members(&self.rest).map(|index| index + 64))
    }
}

/// Steps of a plan, last first while the search descends.
type Steps = Vec<Vec<ActionId>>;

impl<'a> Search<'a> {
    pub(crate) fn new(task: &'a Task, limits: Limits) -> Self {
        let symmetry = Symmetry::of(task, &limits);
        Self {
            task,
            limits,
            no_goods: NoGoods::new(symmetry, task.facts.len()),
            rivals: Rivals::default(),
            ticks: 0,
            allowed: 0,
            inherited_up_to: 0,
        }
    }

    /// Takes over no-goods that are true of this task, however they were derived.
    pub(crate) fn inherit(&mut self, no_goods: impl Iterator<Item = (Vec<FactId>, u32)>) {
        for (facts, level) in no_goods {
            self.no_goods.insert(&facts, level);
            self.inherited_up_to = self.inherited_up_to.max(level);
        }
    }

    /// All no-goods, the search being over.
    pub(crate) fn into_no_goods(self) -> Vec<(Vec<FactId>, u32)> {
        self.no_goods.all().collect()
    }

    pub(crate) fn bytes(&self) -> usize {
        self.no_goods.bytes() + self.rivals.bytes()
    }

    /// Looks for a plan of `length` steps, with so many choices at most.
    pub(crate) fn extract(
        &mut self,
        graph: &PlanningGraph,
        length: usize,
        choices: u64,
    ) -> Result<Extraction, Limit> {
        self.allowed = self.ticks + choices;
        match self.try_extract(graph, length) {
            Ok(extraction) => Ok(extraction),
            Err(Stop::Limit(limit)) => Err(limit),
            Err(Stop::Effort) => Ok(Extraction::Open),
        }
    }

    /// Choices made so far.
    pub(crate) fn choices(&self) -> u64 {
        self.ticks
    }

    fn never(&mut self, graph: &PlanningGraph) -> Extraction {
        let goal = &self.task.goal;
        let level = graph.leveled_off_at().expect("no-goods are pushed past level-off") as u32;
        Extraction::Never(self.no_goods.subset_of(goal, level + 1).unwrap_or_else(|| goal.clone()))
    }

    fn try_extract(&mut self, graph: &PlanningGraph, length: usize) -> Result<Extraction, Stop> {
        let mut steps = Steps::new();
        match self.reach(graph, length, &self.task.goal.clone(), &mut steps)? {
            None => Ok(Extraction::Plan(self.plan(graph, steps))),
            Some(_) if self.push_no_goods(graph, length)? => Ok(self.never(graph)),
            Some(_) => Ok(Extraction::None),
        }
    }

    fn plan(&self, graph: &PlanningGraph, steps: Steps) -> Plan {
        let operators = |actions: Vec<ActionId>| {
            let mut operators: Vec<OperatorId> = actions
                .into_iter()
                .filter(|&a| !graph.is_no_op(a))
                .map(|a| OperatorId(a.0))
                .collect();
            operators.sort_unstable();
            operators.dedup();
            operators
        };
        Plan { steps: steps.into_iter().map(operators).collect() }
    }

    /// None when all goals can hold at `level`, with the steps that make them; else the goals that cannot.
    fn reach(
        &mut self,
        graph: &PlanningGraph,
        level: usize,
        goals: &[FactId],
        steps: &mut Steps,
    ) -> Result<Option<Vec<FactId>>, Stop> {
        if let Some(missing) = goals.iter().find(|&&goal| graph.fact_level(goal) as usize > level) {
            return Ok(Some(vec![*missing]));
        }
        if level == 0 {
            return Ok(None);
        }
        if let Some(known) = self.no_goods.subset_of(goals, level as u32) {
            return Ok(Some(known));
        }
        let mut choice = Level::new(graph, level, goals, true);
        match self.assign(&mut choice, 0, steps) {
            Ok(()) => Ok(None),
            Err(Failure::Stop(stop)) => Err(stop),
            Err(Failure::Goals(set)) => {
                let reason = choice.facts(&set);
                self.no_goods.insert(&reason, level as u32);
                Ok(Some(reason))
            }
        }
    }

    /// Chooses actions for the goals from `index` on, then goes on to the level below.
    fn assign(
        &mut self,
        choice: &mut Level<'_>,
        index: usize,
        steps: &mut Steps,
    ) -> Result<(), Failure> {
        let Some(&goal) = choice.goals.get(index) else {
            return self.descend(choice, steps);
        };
        let graph = choice.graph;
        if choice.chosen.iter().any(|&(action, _)| graph.action(action).add_effects.contains(&goal))
        {
            return self.assign(choice, index + 1, steps);
        }
        let step = choice.level - 1;
        let mut reason = GoalSet::one(index);
        for action in choice.ways(goal) {
            self.tick(graph).map_err(Failure::Stop)?;
            let others = choice.chosen.iter().map(|&(other, _)| other);
            if let Some(rival) = self.rivals.first_of(graph, step, action, others) {
                reason.insert(choice.chosen[rival].1);
                continue;
            }
            choice.chosen.push((action, index));
            let result = self.assign(choice, index + 1, steps);
            choice.chosen.pop();
            match result {
                Err(Failure::Goals(set)) if set.contains(index) => reason.union(&set),
                // Whatever is chosen here, the same goals would fail again.
                other => return other,
            }
        }
        Err(Failure::Goals(reason))
    }

    fn descend(&mut self, choice: &Level<'_>, steps: &mut Steps) -> Result<(), Failure> {
        let graph = choice.graph;
        let mut needs: Vec<FactId> = choice
            .chosen
            .iter()
            .flat_map(|&(action, _)| graph.action(action).preconditions.iter().copied())
            .collect();
        needs.sort_unstable();
        needs.dedup();
        let below = choice.level - 1;
        let failed = if choice.deep {
            self.reach(graph, below, &needs, steps).map_err(Failure::Stop)?
        } else {
            self.no_goods.subset_of(&needs, below as u32)
        };
        let Some(failed) = failed else {
            if choice.deep {
                steps.push(choice.chosen.iter().map(|&(action, _)| action).collect());
            }
            return Ok(());
        };
        let mut reason = GoalSet::default();
        for need in failed {
            // The first goal that brought the need in: the further back the jump, the better.
            let &(_, owner) = choice
                .chosen
                .iter()
                .find(|&&(action, _)| graph.action(action).preconditions.contains(&need))
                .expect("every need comes from a chosen action");
            reason.insert(owner);
        }
        Err(Failure::Goals(reason))
    }

    /// Pushes no-goods up past level-off; whether some level then keeps none of its own.
    fn push_no_goods(&mut self, graph: &PlanningGraph, length: usize) -> Result<bool, Stop> {
        let Some(leveled_off_at) = graph.leveled_off_at() else { return Ok(false) };
        for level in leveled_off_at..length {
            let mut all_pushed = true;
            for set in self.no_goods.exactly_at(level as u32) {
                if self.no_goods.subset_of(&set, level as u32 + 1).is_some() {
                    self.no_goods.insert(&set, level as u32 + 1);
                    continue;
                }
                let mut choice = Level::new(graph, level + 1, &set, false);
                match self.assign(&mut choice, 0, &mut Steps::new()) {
                    Ok(()) => all_pushed = false,
                    Err(Failure::Stop(stop)) => return Err(stop),
                    Err(Failure::Goals(reason)) => {
                        let reason = choice.facts(&reason);
                        self.no_goods.insert(&reason, level as u32 + 1);
                        self.no_goods.insert(&set, level as u32 + 1);
                    }
                }
            }
            if all_pushed && self.is_closed(graph, level)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether every no-good of the level above follows from those of this one. Those derived here do; what was
    /// inherited is true, but the no-goods that it once followed from may not have come along.
    fn is_closed(&mut self, graph: &PlanningGraph, level: usize) -> Result<bool, Stop> {
        if level as u32 >= self.inherited_up_to {
            return Ok(true);
        }
        let above: Vec<Vec<FactId>> = self
            .no_goods
            .all()
            .filter(|(_, at)| *at as usize > level)
            .map(|(set, _)| set)
            .collect();
        for set in above {
            let mut choice = Level::new(graph, level + 1, &set, false);
            match self.assign(&mut choice, 0, &mut Steps::new()) {
                Ok(()) => return Ok(false),
                Err(Failure::Stop(stop)) => return Err(stop),
                Err(Failure::Goals(_)) => {}
            }
        }
        Ok(true)
    }

    fn tick(&mut self, graph: &PlanningGraph) -> Result<(), Stop> {
        self.ticks += 1;
        if self.ticks > self.allowed {
            return Err(Stop::Effort);
        }
        if self.ticks.is_multiple_of(1024) {
            self.limits.check(graph.bytes() + self.bytes()).map_err(Stop::Limit)?;
        }
        Ok(())
    }
}

impl<'g> Level<'g> {
    /// Goals that appear late have the fewest ways to be had, and are chosen for first.
    fn new(graph: &'g PlanningGraph, level: usize, goals: &[FactId], deep: bool) -> Self {
        let mut goals = goals.to_vec();
        goals.sort_by_key(|&goal| (std::cmp::Reverse(graph.fact_level(goal)), goal));
        Self { graph, level, goals, chosen: Vec::new(), deep }
    }

    /// Actions that make a goal hold at this level, the no-op first.
    fn ways(&self, goal: FactId) -> impl Iterator<Item = ActionId> + use<'g> {
        let (graph, level) = (self.graph, self.level as u32);
        graph
            .achievers(goal)
            .iter()
            .copied()
            .filter(move |&action| graph.action_level(action) < level)
    }

    fn facts(&self, set: &GoalSet) -> Vec<FactId> {
        let mut facts: Vec<FactId> = set.members().map(|index| self.goals[index]).collect();
        facts.sort_unstable();
        facts
    }
}
