//! A plan soon, not the shortest: for tasks on which the proof of optimality is out of reach.
//!
//! Forward search guided by relaxed plans (J. Hoffmann, B. Nebel, 2001): a relaxed problem forgets delete effects, its
//! solution, which takes each fact from what is cheapest with all that leads to it, estimates the distance to the goal
//! and names the operators worth trying first. Enforced hill climbing goes first, and first of all as far along the
//! relaxed plan as that can be carried out (V. Vidal, 2004, "a lookahead strategy"); where it gets stuck, states are
//! looked at by width for a while, and landmarks followed one by one. Then [search by width](super::novelty), by relaxed
//! plans of either kind, and best-first search, which counts landmarks besides, take turns; all miss nothing. The
//! sequence found is rid of operators that turned out needless and laid out in parallel steps.

use std::cmp::Reverse;
use std::collections::binary_heap::PeekMut;
use std::collections::{BinaryHeap, HashMap, HashSet, VecDeque};

use super::landmarks::{Attained, Landmarks};
use super::novelty::{self, Searched};
use super::parallel::{in_parallel, needful};
use super::relaxed::{Estimate, Relaxed, State, carry_out, holds, initial};
use crate::bits;
use crate::plan::Plan;
use crate::strips::{FactId, OperatorId, Task};
use crate::{Attempt, Limit, Limits, Way};

/// What forward search came to.
pub(crate) enum Found {
    Plan(Plan),
    /// Every state that can be reached was seen.
    Exhausted,
    /// The effort allowed was not enough.
    Open,
}

impl Found {
    pub(crate) fn plan(self) -> Option<Plan> {
        match self {
            Self::Plan(plan) => Some(plan),
            Self::Exhausted | Self::Open => None,
        }
    }
}

/// How long to go on where hill climbing is stuck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effort {
    /// Hill climbing, and a little width.
    Least,
    Small,
    All,
}

/// States looked at with small effort, and what their relaxed plans may take in all where each looks at many operators.
const FEW_STATES: u64 = 20_000;
const FEW_RELAXED: u64 = 1 << 29;

/// States looked at by width before landmarks are followed, with small effort, and most of all.
const FEWEST_STATES_BY_WIDTH: usize = 10_000;
const FEW_STATES_BY_WIDTH: usize = 50_000;
const MANY_STATES_BY_WIDTH: usize = 2_000_000;

pub(crate) fn search(task: &Task, limits: &Limits, effort: Effort) -> Result<Found, Limit> {
    let mut forward = Forward::new(task, limits, effort);
    let found = forward.sequence();
    forward.note();
    let operators = match found? {
        Searched::Path(operators) => operators,
        Searched::Exhausted => return Ok(Found::Exhausted),
        Searched::Open => return Ok(Found::Open),
    };
    Ok(Found::Plan(without_needless(task, operators)))
}

/// A plan that reaches one stage after the other, if hill climbing finds the way.
pub(crate) fn in_order(
    task: &Task,
    stages: &[Vec<FactId>],
    limits: &Limits,
) -> Result<Option<Plan>, Limit> {
    let mut forward = Forward::new(task, limits, Effort::Least);
    let operators = forward.climb_in_order(stages.iter().map(Vec::as_slice))?;
    Ok(operators.map(|operators| without_needless(task, operators)))
}

/// A plan found step by step, without following relaxed plans to their ends: it takes longer to find and mostly has
/// fewer actions (S. Richter, M. Westphal, 2010). None where it takes more than so much effort.
pub(crate) fn step_by_step(
    task: &Task,
    effort: u64,
    limits: &Limits,
) -> Result<Option<Plan>, Limit> {
    let mut forward = Forward::new(task, limits, Effort::Small);
    forward.looks_ahead = false;
    forward.most_effort = effort;
    let landmarks = Landmarks::of(task);
    let state = initial(task);
    let attained = landmarks.as_ref().map(|all| all.initially(&state)).unwrap_or_default();
    let found = forward.best_first(Stage { state, attained }, landmarks.as_ref(), false);
    forward.note();
    Ok(found?.map(|(operators, _)| without_needless(task, operators)))
}

fn without_needless(task: &Task, operators: Vec<OperatorId>) -> Plan {
    in_parallel(task, needful(task, operators).into_iter())
}

struct Forward<'a> {
    task: &'a Task,
    limits: &'a Limits,
    relaxed: Relaxed<'a>,
    /// Relaxed plans by layers: where those by sums get stuck, these may not, and the other way round.
    by_layers: Relaxed<'a>,
    evaluated: u64,
    /// Where best-first search ends for the time being.
    until: u64,
    /// Where it ends as well, in what looking at relaxed plans takes.
    most_effort: u64,
    effort: Effort,
    /// Whether best-first search also jumps to the end of a relaxed plan: sooner at a goal, by a longer way.
    looks_ahead: bool,
}

impl<'a> Forward<'a> {
    fn new(task: &'a Task, limits: &'a Limits, effort: Effort) -> Self {
        Self {
            task,
            limits,
            relaxed: Relaxed::by_sum(task),
            by_layers: Relaxed::new(task),
            evaluated: 0,
            until: u64::MAX,
            most_effort: u64::MAX,
            effort,
            looks_ahead: true,
        }
    }

    fn note(&self) {
        let effort = self.relaxed.effort + self.by_layers.effort;
        self.limits.note(Attempt::new(Way::Forward, 0, self.evaluated, effort));
    }

    /// Hill climbing, then a little width, and with the least effort no more; then landmarks, then width, then relaxed plans and landmarks.
    fn sequence(&mut self) -> Result<Searched, Limit> {
        if self.effort != Effort::All
            && let Some((operators, _)) = self.climb(initial(self.task))?
        {
            return Ok(Searched::Path(operators));
        }
        let landmarks = Landmarks::of(self.task);
        // What is looked at by width leaves room for what comes after it.
        let half = Limits { memory_bytes: self.limits.memory_bytes / 2, ..self.limits.clone() };
        if self.effort != Effort::All
            && let Some(landmarks) = &landmarks
        {
            let goals = landmarks.goals_in_order();
            if let Some(operators) =
                self.climb_in_order((1..=goals.len()).map(|turn| &goals[..turn]))?
            {
                return Ok(Searched::Path(operators));
            }
            if let Some(found) =
                self.by_width(false, Some(landmarks), FEWEST_STATES_BY_WIDTH, &half)?
            {
                return Ok(found);
            }
            if self.effort == Effort::Small {
                // Where relaxed plans by sums got stuck, those by layers may not.
                std::mem::swap(&mut self.relaxed, &mut self.by_layers);
                let descended = self.descend();
                std::mem::swap(&mut self.relaxed, &mut self.by_layers);
                if let Some(operators) = descended? {
                    return Ok(Searched::Path(operators));
                }
            }
        }
        if self.effort == Effort::Least {
            return Ok(Searched::Open);
        }
        let first = if self.effort == Effort::Small { 0 } else { 1 };
        // All take turns, each with more effort than before: where one loses its way, another may know it. Width goes
        // twice, by layers and by sums, which see different things as brought about.
        for round in first.. {
            let times = 4_usize.pow(round);
            let states = FEW_STATES_BY_WIDTH * times;
            let by_width = states <= MANY_STATES_BY_WIDTH;
            for by_sum in [false, true] {
                if by_width
                    && let Some(found) = self.by_width(by_sum, landmarks.as_ref(), states, &half)?
                {
                    return Ok(found);
                }
            }
            (self.until, self.most_effort) = match by_width {
                true => (
                    self.evaluated + FEW_STATES * times as u64,
                    self.relaxed.effort + FEW_RELAXED * times as u64,
                ),
                false => (u64::MAX, u64::MAX),
            };
            let state = initial(self.task);
            let attained = landmarks.as_ref().map(|all| all.initially(&state)).unwrap_or_default();
            let start = Stage { state, attained };
            if let Some((operators, _)) = self.best_first(start, landmarks.as_ref(), false)? {
                return Ok(Searched::Path(operators));
            }
            if !self.is_over() {
                return Ok(Searched::Exhausted);
            }
            if self.effort == Effort::Small {
                break;
            }
        }
        Ok(Searched::Open)
    }

    /// Search by width over so many states, by relaxed plans of either kind; none where it comes to nothing.
    fn by_width(
        &mut self,
        by_sum: bool,
        landmarks: Option<&Landmarks>,
        states: usize,
        limits: &Limits,
    ) -> Result<Option<Searched>, Limit> {
        let relaxed = if by_sum { &mut self.relaxed } else { &mut self.by_layers };
        match novelty::search(self.task, relaxed, landmarks, states, limits) {
            Ok(Searched::Open) | Err(Limit::Memory) => Ok(None),
            found => found.map(Some),
        }
    }

    fn is_over(&self) -> bool {
        self.evaluated >= self.until || self.relaxed.effort >= self.most_effort
    }

    fn after(&self, state: &State, id: OperatorId) -> State {
        let mut next = state.clone();
        carry_out(self.task, &mut next, id);
        next
    }

    /// As far as a relaxed plan can be carried out one operator after the other. Where none can be, one of them is
    /// replaced by another that brings what it was to bring: the truck is no longer where it set out from, but there
    /// is a way from where it is.
    fn ahead(&self, state: &State, relaxed_plan: &[OperatorId]) -> (State, Vec<OperatorId>) {
        let (mut state, mut path) = (state.clone(), Vec::new());
        let mut open = relaxed_plan.to_vec();
        let mut wanted: HashMap<FactId, u32> = HashMap::new();
        for &id in relaxed_plan {
            for &need in &self.task.operator(id).preconditions {
                *wanted.entry(need).or_default() += 1;
            }
        }
        loop {
            let before = path.len();
            open.retain(|&id| {
                let possible = self.is_applicable(&state, id);
                if possible {
                    carry_out(self.task, &mut state, id);
                    path.push(id);
                    self.no_longer_wanted(&mut wanted, id);
                }
                !possible
            });
            if path.len() > before {
                continue;
            }
            let instead = open.iter().enumerate().find_map(|(at, &id)| {
                let brings = self.task.operator(id).add_effects.iter().find_map(|&fact| {
                    let serves = wanted.get(&fact).is_some_and(|&count| count > 0);
                    let missing = serves && !holds(&state, fact);
                    missing.then(|| self.bringer(&state, fact)).flatten()
                });
                brings.map(|other| (at, other))
            });
            let Some((at, other)) = instead else { return (state, path) };
            let replaced = open.remove(at);
            self.no_longer_wanted(&mut wanted, replaced);
            carry_out(self.task, &mut state, other);
            path.push(other);
        }
    }

    fn no_longer_wanted(&self, wanted: &mut HashMap<FactId, u32>, id: OperatorId) {
        for need in &self.task.operator(id).preconditions {
            if let Some(count) = wanted.get_mut(need) {
                *count -= 1;
            }
        }
    }

    /// An operator that can be carried out and brings a fact.
    fn bringer(&self, state: &State, fact: FactId) -> Option<OperatorId> {
        let mut bringers = self.relaxed.added_by[fact.index()].iter().map(|&n| OperatorId(n));
        bringers.find(|&id| self.is_applicable(state, id))
    }

    fn is_applicable(&self, state: &State, id: OperatorId) -> bool {
        self.task.operator(id).preconditions.iter().all(|&fact| holds(state, fact))
    }

    fn estimate(&mut self, state: &State, held_bytes: usize) -> Result<Option<Estimate>, Limit> {
        self.evaluated += 1;
        self.limits.check(held_bytes)?;
        Ok(self.relaxed.estimate(state))
    }

    /// From each state on to any nearer one: that at the end of the relaxed plan, or one found breadth first through
    /// helpful operators.
    fn climb(&mut self, from: State) -> Result<Option<(Vec<OperatorId>, State)>, Limit> {
        /// A plateau wider than this is better left to best-first search.
        const WIDEST: usize = 1_000;
        let mut state = from;
        let mut plan = Vec::new();
        let Some(mut here) = self.estimate(&state, 0)? else { return Ok(None) };
        while here.distance > 0 {
            let (next, path) = self.ahead(&state, &here.relaxed_plan);
            if let Some(there) = self.estimate(&next, 0)?
                && there.distance < here.distance
            {
                plan.extend(path);
                (state, here) = (next, there);
                continue;
            }
            let mut seen = HashSet::from([state.clone()]);
            let mut queue =
                VecDeque::from([(state.clone(), Vec::new(), std::mem::take(&mut here.helpful))]);
            let nearer = 'plateau: loop {
                let Some((from, path, helpful)) = queue.pop_front() else { return Ok(None) };
                if seen.len() > WIDEST {
                    return Ok(None);
                }
                for id in helpful {
                    let next = self.after(&from, id);
                    if !seen.insert(next.clone()) {
                        continue;
                    }
                    let Some(estimate) = self.estimate(&next, seen.len() * from.len() * 8)? else {
                        continue;
                    };
                    let mut path: Vec<OperatorId> = path.clone();
                    path.push(id);
                    if estimate.distance < here.distance {
                        break 'plateau (next, path, estimate);
                    }
                    queue.push_back((next, path, estimate.helpful));
                }
            };
            plan.extend(nearer.1);
            (state, here) = (nearer.0, nearer.2);
        }
        Ok(Some((plan, state)))
    }

    /// One goal after the other, none of which is undone for one that comes later (J. Koehler, J. Hoffmann, 2000, the
    /// goal agenda). A goal attained may be given up for a while, but holds again before the next has its turn.
    fn climb_in_order<'g>(
        &mut self,
        stages: impl Iterator<Item = &'g [FactId]>,
    ) -> Result<Option<Vec<OperatorId>>, Limit> {
        let mut state = initial(self.task);
        let mut plan = Vec::new();
        for stage in stages {
            self.relaxed.aim_at(stage);
            let climbed = self.climb(state);
            self.relaxed.aim_at(&self.task.goal);
            let Some((path, end)) = climbed? else { return Ok(None) };
            plan.extend(path);
            state = end;
        }
        // The last stage may be less than the goal.
        Ok(self.task.goal.iter().all(|&goal| holds(&state, goal)).then_some(plan))
    }

    /// What the state looked at last allows.
    fn successors(&self, helpful: &[OperatorId]) -> Successors {
        let known: HashSet<OperatorId> = helpful.iter().copied().collect();
        let others = self.relaxed.applicable.iter().filter(|id| !known.contains(id));
        let count = helpful.len();
        Successors { operators: helpful.iter().chain(others).copied().collect(), helpful: count }
    }

    /// Two measures take turns: the length of a relaxed plan, and the landmarks ahead; with each, helpful operators
    /// have a queue of their own that goes first while progress is made (S. Richter, M. Westphal, 2010). Those of the
    /// relaxed plan itself are helpful, its end, and what brings the next landmarks: as a successor is looked at only
    /// when its turn comes, each that is tried in vain costs an estimate.
    ///
    /// The end is the goal, or with `nearer` already fewer landmarks ahead than at first.
    fn best_first(
        &mut self,
        start: Stage,
        landmarks: Option<&Landmarks>,
        nearer: bool,
    ) -> Result<Option<(Vec<OperatorId>, Stage)>, Limit> {
        let mut seen = Seen::default();
        let mut queues = Queues::new(if landmarks.is_some() { 2 } else { 1 });
        let ahead =
            |stage: &Stage| landmarks.map_or(0, |all| all.ahead(&stage.attained, &stage.state));
        let at_first = ahead(&start);
        let mut next = Some((start, None, Box::default()));
        loop {
            if let Some((stage, from, by)) = next.take()
                && let Some(number) = seen.add(&stage, from, by)
            {
                let bytes = seen.bytes + queues.bytes;
                if let Some(estimate) = self.estimate(&stage.state, bytes)? {
                    let values = [estimate.distance, ahead(&stage)];
                    if estimate.distance == 0 || nearer && values[1] < at_first {
                        return Ok(Some((seen.path(number), stage)));
                    }
                    let possible = |id: &OperatorId| self.is_applicable(&stage.state, *id);
                    let mut helpful: Vec<OperatorId> =
                        estimate.relaxed_plan.iter().copied().filter(possible).collect();
                    if let Some(landmarks) = landmarks {
                        self.add_bringers(
                            &landmarks.next(&stage.attained, &stage.state),
                            &mut helpful,
                        );
                    }
                    queues.push(values, number, self.successors(&helpful));
                    seen.relaxed_plans.insert(number, estimate.relaxed_plan);
                }
            }
            let Some((from, by)) = queues.pop() else { return Ok(None) };
            if self.is_over() {
                return Ok(None);
            }
            if by.is_none() && (nearer || !self.looks_ahead) {
                continue;
            }
            let path: Box<[OperatorId]> = match by {
                Some(id) => [id].into(),
                None => {
                    let Some(plan) = seen.relaxed_plans.remove(&from) else { continue };
                    self.ahead(&seen.stages[from as usize].state, &plan).1.into_boxed_slice()
                }
            };
            let mut stage = seen.stages[from as usize].clone();
            for &id in &path {
                carry_out(self.task, &mut stage.state, id);
                if let Some(landmarks) = landmarks {
                    stage.attained = landmarks.advance(&stage.attained, &stage.state);
                }
            }
            next = Some((stage, Some(from), path));
        }
    }

    /// Adds operators that the state looked at last allows and that bring a wanted fact.
    fn add_bringers(&self, wanted: &[u64], helpful: &mut Vec<OperatorId>) {
        let known: HashSet<OperatorId> = helpful.iter().copied().collect();
        let brings = |id: &&OperatorId| {
            let adds = &self.task.operator(**id).add_effects;
            adds.iter().any(|fact| bits::has(wanted, fact.index())) && !known.contains(id)
        };
        helpful.extend(self.relaxed.applicable.iter().filter(brings));
    }

    /// From each state on to any with fewer landmarks ahead, without looking back. Where no such state is near, the
    /// landmarks are found anew: those of the initial state do not tell what has come into the way since.
    fn descend(&mut self) -> Result<Option<Vec<OperatorId>>, Limit> {
        /// States looked at for one with less ahead: fewer where each takes longer.
        const NEAR: u64 = 2_000;
        const OPERATORS_LOOKED_AT: u64 = 10_000_000;
        let near = NEAR.min(OPERATORS_LOOKED_AT / (self.task.operators.len() as u64).max(1));
        let mut state = initial(self.task);
        let mut plan = Vec::new();
        let mut least = u32::MAX;
        loop {
            let Some(landmarks) = Landmarks::from(self.task, &state) else { return Ok(None) };
            let mut stage = Stage { attained: landmarks.initially(&state), state };
            let ahead = landmarks.ahead(&stage.attained, &stage.state);
            if std::mem::replace(&mut least, ahead) <= ahead {
                return Ok(None);
            }
            loop {
                self.until = self.evaluated + near;
                let nearer = self.best_first(stage.clone(), Some(&landmarks), true)?;
                let Some((path, next)) = nearer else { break };
                plan.extend(path);
                stage = next;
                if self.task.goal.iter().all(|&goal| holds(&stage.state, goal)) {
                    return Ok(Some(plan));
                }
            }
            state = stage.state;
        }
    }
}

/// A state, and which landmarks were attained on the way to it.
#[derive(Clone)]
struct Stage {
    state: State,
    attained: Attained,
}

/// Operators that a state allows, the helpful ones first.
#[derive(Default)]
struct Successors {
    operators: Box<[OperatorId]>,
    helpful: usize,
}

/// A queue of one measure.
#[derive(Default)]
struct Queue {
    /// Least value first, of these the least by the other measure, of these the oldest state; and which of its
    /// successors is next.
    heap: BinaryHeap<Reverse<([u32; 2], u32, u32)>>,
    /// The queue with the least has its turn.
    turn: i64,
    /// Which measure it goes by.
    measure: usize,
    /// Whether only helpful operators get in.
    helpful: bool,
}

struct Queues {
    queues: Vec<Queue>,
    least: [u32; 2],
    /// By the number of the state.
    successors: Vec<Successors>,
    bytes: usize,
}

/// How many turns helpful operators gain by progress.
const BOOST: i64 = 1000;

impl Queues {
    fn new(measures: usize) -> Self {
        let both =
            |measure| [true, false].map(|helpful| Queue { measure, helpful, ..Queue::default() });
        let queues = (0..measures).flat_map(both).collect();
        Self { queues, least: [u32::MAX; 2], successors: Vec::new(), bytes: 0 }
    }

    /// A state's successors wait for their turn. Progress in some measure lets helpful ones go first for a while.
    fn push(&mut self, values: [u32; 2], number: u32, successors: Successors) {
        for (least, value) in self.least.iter_mut().zip(values) {
            if value < *least {
                *least = value;
                let helpful = self.queues.iter_mut().filter(|queue| queue.helpful);
                helpful.for_each(|queue| queue.turn -= BOOST);
            }
        }
        // A heap doubles when it grows.
        self.bytes += successors.operators.len() * 4 + 48 + self.queues.len() * 24;
        self.successors.resize_with(number as usize, Successors::default);
        self.successors.push(successors);
        for queue in &mut self.queues {
            let own = [values[queue.measure], values[1 - queue.measure]];
            queue.heap.push(Reverse((own, number, 0)));
        }
    }

    /// The state whose turn it is, and the operator; none for the end of the state's relaxed plan.
    fn pop(&mut self) -> Option<(u32, Option<OperatorId>)> {
        let open = self.queues.iter_mut().filter(|queue| !queue.heap.is_empty());
        let queue = open.min_by_key(|queue| queue.turn)?;
        queue.turn += 1;
        let mut first = queue.heap.peek_mut()?;
        let Reverse((_, number, at)) = *first;
        let Successors { operators, helpful } = &self.successors[number as usize];
        let end = if queue.helpful { *helpful } else { operators.len() };
        if (at as usize) < end {
            first.0.2 = at + 1;
        } else {
            PeekMut::pop(first);
        }
        Some((number, at.checked_sub(1).map(|at| operators[at as usize])))
    }
}

/// States met, each with the state that it was come to from, and by which operators.
#[derive(Default)]
struct Seen {
    numbers: HashMap<State, u32>,
    stages: Vec<Stage>,
    from: Vec<(Option<u32>, Box<[OperatorId]>)>,
    /// Of states whose relaxed plan was not yet followed.
    relaxed_plans: HashMap<u32, Vec<OperatorId>>,
    bytes: usize,
}

impl Seen {
    /// The number of a state not met before.
    fn add(&mut self, stage: &Stage, from: Option<u32>, by: Box<[OperatorId]>) -> Option<u32> {
        let number = self.stages.len() as u32;
        if self.numbers.contains_key(&stage.state) {
            return None;
        }
        let words = 2 * stage.state.len() + stage.attained.len();
        self.bytes += words * 8 + by.len() * 4 + 160;
        self.numbers.insert(stage.state.clone(), number);
        self.stages.push(stage.clone());
        self.from.push((from, by));
        Some(number)
    }

    fn path(&self, to: u32) -> Vec<OperatorId> {
        let mut pieces = Vec::new();
        let mut at = Some(to);
        while let Some(number) = at {
            let (before, by) = &self.from[number as usize];
            pieces.push(by);
            at = *before;
        }
        pieces.into_iter().rev().flat_map(|by| by.iter().copied()).collect()
    }
}
