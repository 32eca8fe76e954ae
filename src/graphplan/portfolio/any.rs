//! A plan soon, not the shortest: for tasks on which the proof of optimality is out of reach.
//!
//! Forward search guided by relaxed plans (J. Hoffmann, B. Nebel, 2001): a relaxed problem forgets delete effects, its
//! solution, which takes each fact from what is cheapest with all that leads to it, estimates the distance to the goal
//! and names the operators worth trying first. Enforced hill climbing goes first, and first of all as far along the
//! relaxed plan as that can be carried out (V. Vidal, 2004, "a lookahead strategy"); where it gets stuck, states are
//! looked at by width for a while, then [best first](super::best_first), and landmarks followed one by one. Then
//! [search by width](super::novelty), by relaxed plans of either kind, and best-first search, which goes on from where
//! it was, take turns; both miss nothing. The sequence found is rid of operators that turned out needless and laid out
//! in parallel steps.

use std::collections::{HashMap, HashSet, VecDeque};

use super::best_first::{BestFirst, Come, End, Guide, Stage};
use super::landmarks::Landmarks;
use super::novelty::{self, Searched};
use super::parallel::{in_parallel, needful};
use super::relaxed::{Relaxed, State, carry_out, holds, initial};
use crate::allowed::Allowed;
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

/// Times that effort that best-first search has each time search by width has looked at so many more states: on large
/// tasks it takes as long then.
const BESIDE_WIDTH: u64 = 4;

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

fn without_needless(task: &Task, operators: Vec<OperatorId>) -> Plan {
    in_parallel(task, needful(task, operators).into_iter())
}

struct Forward<'a> {
    guide: Guide<'a>,
    /// Relaxed plans by layers: where those by sums get stuck, these may not, and the other way round.
    by_layers: Relaxed<'a>,
    effort: Effort,
}

impl<'a> Forward<'a> {
    fn new(task: &'a Task, limits: &'a Limits, effort: Effort) -> Self {
        let (relaxed, allowed) = (Relaxed::by_sum(task), Allowed::new(task));
        let guide = Guide { task, limits, relaxed, allowed, evaluated: 0 };
        Self { guide, by_layers: Relaxed::new(task), effort }
    }

    fn note(&self) {
        let effort = self.guide.relaxed.effort + self.by_layers.effort;
        self.guide.limits.note(Attempt::new(Way::Forward, 0, self.guide.evaluated, effort));
    }

    /// Hill climbing, at once and goal by goal, then a little width, and with the least effort no more; then best-first
    /// search, landmark by landmark, and width and best-first search in turns.
    fn sequence(&mut self) -> Result<Searched, Limit> {
        let (task, limits) = (self.guide.task, self.guide.limits);
        if self.effort != Effort::All
            && let Some((operators, _)) = self.climb(initial(task))?
        {
            return Ok(Searched::Path(operators));
        }
        let landmarks = Landmarks::of(task);
        // What is looked at by width leaves room for what comes after it.
        let half = Limits { memory_bytes: limits.memory_bytes / 2, ..limits.clone() };
        let mut best_first = BestFirst::new(initial(task), landmarks.as_ref());
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
                if let Some(found) = self.on(&mut best_first, 1)? {
                    return Ok(found);
                }
                // Where relaxed plans by sums got stuck, those by layers may not.
                std::mem::swap(&mut self.guide.relaxed, &mut self.by_layers);
                let descended = self.descend();
                std::mem::swap(&mut self.guide.relaxed, &mut self.by_layers);
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
            let times = if by_width { BESIDE_WIDTH * times as u64 } else { u64::MAX };
            if let Some(found) = self.on(&mut best_first, times)? {
                return Ok(found);
            }
            if self.effort == Effort::Small {
                break;
            }
        }
        Ok(Searched::Open)
    }

    /// Lets best-first search go on for some times the effort that is little; none where it comes to nothing by then.
    fn on(&mut self, search: &mut BestFirst<'_>, times: u64) -> Result<Option<Searched>, Limit> {
        let end = End {
            evaluated: self.guide.evaluated.saturating_add(FEW_STATES.saturating_mul(times)),
            effort: self.guide.relaxed.effort.saturating_add(FEW_RELAXED.saturating_mul(times)),
        };
        Ok(match search.go_on(&mut self.guide, end)? {
            Come::To(operators, _) => Some(Searched::Path(operators)),
            Come::Exhausted => Some(Searched::Exhausted),
            Come::Over => None,
        })
    }

    /// Search by width over so many states, by relaxed plans of either kind; none where it comes to nothing.
    fn by_width(
        &mut self,
        by_sum: bool,
        landmarks: Option<&Landmarks>,
        states: usize,
        limits: &Limits,
    ) -> Result<Option<Searched>, Limit> {
        let relaxed = if by_sum { &mut self.guide.relaxed } else { &mut self.by_layers };
        match novelty::search(self.guide.task, relaxed, landmarks, states, limits) {
            Ok(Searched::Open) | Err(Limit::Memory) => Ok(None),
            found => found.map(Some),
        }
    }

    fn after(&self, state: &State, id: OperatorId) -> State {
        let mut next = state.clone();
        carry_out(self.guide.task, &mut next, id);
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
            for &need in &self.guide.task.operator(id).preconditions {
                *wanted.entry(need).or_default() += 1;
            }
        }
        loop {
            let before = path.len();
            open.retain(|&id| {
                let possible = self.is_applicable(&state, id);
                if possible {
                    carry_out(self.guide.task, &mut state, id);
                    path.push(id);
                    self.no_longer_wanted(&mut wanted, id);
                }
                !possible
            });
            if path.len() > before {
                continue;
            }
            let instead = open.iter().enumerate().find_map(|(at, &id)| {
                let brings = self.guide.task.operator(id).add_effects.iter().find_map(|&fact| {
                    let serves = wanted.get(&fact).is_some_and(|&count| count > 0);
                    let missing = serves && !holds(&state, fact);
                    missing.then(|| self.bringer(&state, fact)).flatten()
                });
                brings.map(|other| (at, other))
            });
            let Some((at, other)) = instead else { return (state, path) };
            let replaced = open.remove(at);
            self.no_longer_wanted(&mut wanted, replaced);
            carry_out(self.guide.task, &mut state, other);
            path.push(other);
        }
    }

    fn no_longer_wanted(&self, wanted: &mut HashMap<FactId, u32>, id: OperatorId) {
        for need in &self.guide.task.operator(id).preconditions {
            if let Some(count) = wanted.get_mut(need) {
                *count -= 1;
            }
        }
    }

    /// An operator that can be carried out and brings a fact.
    fn bringer(&self, state: &State, fact: FactId) -> Option<OperatorId> {
        let mut bringers = self.guide.relaxed.added_by[fact.index()].iter().map(|&n| OperatorId(n));
        bringers.find(|&id| self.is_applicable(state, id))
    }

    fn is_applicable(&self, state: &State, id: OperatorId) -> bool {
        self.guide.task.operator(id).preconditions.iter().all(|&fact| holds(state, fact))
    }

    /// From each state on to any nearer one: that at the end of the relaxed plan, or one found breadth first through
    /// helpful operators.
    fn climb(&mut self, from: State) -> Result<Option<(Vec<OperatorId>, State)>, Limit> {
        /// A plateau wider than this is better left to best-first search.
        const WIDEST: usize = 1_000;
        let mut state = from;
        let mut plan = Vec::new();
        let Some(mut here) = self.guide.estimate(&state, 0)? else { return Ok(None) };
        while here.distance > 0 {
            let (next, path) = self.ahead(&state, &here.relaxed_plan);
            if let Some(there) = self.guide.estimate(&next, 0)?
                && there.distance < here.distance
            {
                plan.extend(path);
                (state, here) = (next, there);
                continue;
            }
            let distance = here.distance;
            let mut seen = HashSet::from([state.clone()]);
            let mut queue = VecDeque::from([(state.clone(), Vec::new(), here)]);
            let nearer = 'plateau: loop {
                let Some((from, path, estimate)) = queue.pop_front() else { return Ok(None) };
                if seen.len() > WIDEST {
                    return Ok(None);
                }
                for id in self.guide.relaxed.helpful(&from, &estimate) {
                    let next = self.after(&from, id);
                    if !seen.insert(next.clone()) {
                        continue;
                    }
                    let Some(estimate) = self.guide.estimate(&next, seen.len() * from.len() * 8)?
                    else {
                        continue;
                    };
                    let mut path: Vec<OperatorId> = path.clone();
                    path.push(id);
                    if estimate.distance < distance {
                        break 'plateau (next, path, estimate);
                    }
                    queue.push_back((next, path, estimate));
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
        let mut state = initial(self.guide.task);
        let mut plan = Vec::new();
        for stage in stages {
            self.guide.relaxed.aim_at(stage);
            let climbed = self.climb(state);
            self.guide.relaxed.aim_at(&self.guide.task.goal);
            let Some((path, end)) = climbed? else { return Ok(None) };
            plan.extend(path);
            state = end;
        }
        // The last stage may be less than the goal.
        Ok(self.guide.task.goal.iter().all(|&goal| holds(&state, goal)).then_some(plan))
    }

    /// From each state on to any with fewer landmarks ahead, without looking back. Where no such state is near, the
    /// landmarks are found anew: those of the initial state do not tell what has come into the way since.
    fn descend(&mut self) -> Result<Option<Vec<OperatorId>>, Limit> {
        /// States looked at for one with less ahead: fewer where each takes longer.
        const NEAR: u64 = 2_000;
        const OPERATORS_LOOKED_AT: u64 = 10_000_000;
        let near = NEAR.min(OPERATORS_LOOKED_AT / (self.guide.task.operators.len() as u64).max(1));
        let mut state = initial(self.guide.task);
        let mut plan = Vec::new();
        let mut least = u32::MAX;
        loop {
            let Some(landmarks) = Landmarks::from(self.guide.task, &state) else { return Ok(None) };
            let mut stage = Stage { attained: landmarks.initially(&state), state };
            let ahead = landmarks.ahead(&stage.attained, &stage.state);
            if std::mem::replace(&mut least, ahead) <= ahead {
                return Ok(None);
            }
            loop {
                let end = End { evaluated: self.guide.evaluated + near, effort: u64::MAX };
                let mut nearer = BestFirst::nearer(stage.clone(), &landmarks);
                let Come::To(path, next) = nearer.go_on(&mut self.guide, end)? else { break };
                plan.extend(path);
                stage = next;
                if self.guide.task.goal.iter().all(|&goal| holds(&stage.state, goal)) {
                    return Ok(Some(plan));
                }
            }
            state = stage.state;
        }
    }
}
