//! A plan soon, not the shortest: for tasks on which the proof of optimality is out of reach.
//!
//! Forward search guided by relaxed plans (J. Hoffmann, B. Nebel, 2001): a relaxed problem forgets delete effects, its
//! solution estimates the distance to the goal and names the operators worth trying first. Enforced hill climbing
//! goes first, and first of all as far along the relaxed plan as that can be carried out (V. Vidal, 2004, "a lookahead
//! strategy"); where it gets stuck, best-first search takes over, and it misses nothing. The sequence found is rid of
//! operators that turned out needless and laid out in parallel steps.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap, HashMap, HashSet, VecDeque};

use super::plan::Plan;
use super::{Limit, Limits};
use crate::strips::{FactId, OperatorId, Task};

/// What holds, as bits.
type State = Box<[u64]>;

fn holds(state: &State, fact: FactId) -> bool {
    state[fact.index() / 64] >> (fact.index() % 64) & 1 == 1
}

/// What forward search came to.
pub(super) enum Found {
    Plan(Plan),
    /// Every state that can be reached was seen.
    Exhausted,
    /// The effort allowed was not enough.
    Open,
}

/// How long to go on where hill climbing is stuck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Effort {
    Small,
    All,
}

/// States looked at with small effort.
const FEW_STATES: u64 = 20_000;

pub(super) fn search(task: &Task, limits: &Limits, effort: Effort) -> Result<Found, Limit> {
    let mut forward = Forward { task, limits, relaxed: Relaxed::new(task), evaluated: 0, effort };
    let operators = match forward.climb()? {
        Some(operators) => operators,
        None => match forward.best_first()? {
            Some(operators) => operators,
            None if forward.is_over() => return Ok(Found::Open),
            None => return Ok(Found::Exhausted),
        },
    };
    let mut steps: Vec<Vec<OperatorId>> = operators.into_iter().map(|id| vec![id]).collect();
    drop_needless(task, &mut steps);
    Ok(Found::Plan(in_parallel(task, steps.into_iter().flatten())))
}

struct Forward<'a> {
    task: &'a Task,
    limits: &'a Limits,
    relaxed: Relaxed<'a>,
    evaluated: u64,
    effort: Effort,
}

/// How far a state seems from the goal, and what to try.
struct Estimate {
    distance: u32,
    /// Applicable operators that bring a first fact of the relaxed plan, those of the relaxed plan first.
    helpful: Vec<OperatorId>,
    /// The relaxed plan, in the order of its layers.
    relaxed_plan: Vec<OperatorId>,
}

impl Forward<'_> {
    fn is_over(&self) -> bool {
        self.effort == Effort::Small && self.evaluated >= FEW_STATES
    }

    fn initial(&self) -> State {
        let mut state = vec![0; self.task.facts.len().div_ceil(64)].into_boxed_slice();
        self.task.init.iter().for_each(|fact| state[fact.index() / 64] |= 1 << (fact.index() % 64));
        state
    }

    fn after(&self, state: &State, id: OperatorId) -> State {
        let mut next = state.clone();
        self.carry_out(&mut next, id);
        next
    }

    fn carry_out(&self, state: &mut State, id: OperatorId) {
        let operator = self.task.operator(id);
        operator.del_effects.iter().for_each(|f| state[f.index() / 64] &= !(1 << (f.index() % 64)));
        operator.add_effects.iter().for_each(|f| state[f.index() / 64] |= 1 << (f.index() % 64));
    }

    /// As far as the operators of a relaxed plan can be carried out one after the other.
    fn ahead(&self, state: &State, relaxed_plan: &[OperatorId]) -> (State, Vec<OperatorId>) {
        let (mut state, mut path) = (state.clone(), Vec::new());
        let mut open = relaxed_plan.to_vec();
        loop {
            let before = path.len();
            open.retain(|&id| {
                let possible = self.is_applicable(&state, id);
                if possible {
                    self.carry_out(&mut state, id);
                    path.push(id);
                }
                !possible
            });
            if path.len() == before {
                return (state, path);
            }
        }
    }

    fn is_applicable(&self, state: &State, id: OperatorId) -> bool {
        self.task.operator(id).preconditions.iter().all(|&fact| holds(state, fact))
    }

    fn estimate(&mut self, state: &State, held_bytes: usize) -> Result<Option<Estimate>, Limit> {
        self.evaluated += 1;
        if self.evaluated.is_multiple_of(16) {
            self.limits.check(held_bytes)?;
        }
        Ok(self.relaxed.estimate(state))
    }

    /// From each state on to any nearer one: that at the end of the relaxed plan, or one found breadth first through
    /// helpful operators.
    fn climb(&mut self) -> Result<Option<Vec<OperatorId>>, Limit> {
        /// A plateau wider than this is better left to best-first search.
        const WIDEST: usize = 5_000;
        let mut state = self.initial();
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
        Ok(Some(plan))
    }

    /// Nearest state first; helpful operators are tried at once, the others when nothing nearer is left.
    fn best_first(&mut self) -> Result<Option<Vec<OperatorId>>, Limit> {
        let initial = self.initial();
        let mut parents: HashMap<State, Option<(State, OperatorId)>> = HashMap::new();
        let mut queue: BinaryHeap<Reverse<(u32, u64, State)>> = BinaryHeap::new();
        parents.insert(initial.clone(), None);
        queue.push(Reverse((0, 0, initial)));
        let mut order = 0;
        while let Some(Reverse((_, _, state))) = queue.pop() {
            if self.is_over() {
                return Ok(None);
            }
            let bytes = parents.len() * (state.len() * 24 + 128);
            let Some(estimate) = self.estimate(&state, bytes)? else { continue };
            if estimate.distance == 0 {
                return Ok(Some(path(&parents, &state)));
            }
            let applicable = self.relaxed.applicable.clone();
            for id in applicable {
                let next = self.after(&state, id);
                if parents.contains_key(&next) {
                    continue;
                }
                parents.insert(next.clone(), Some((state.clone(), id)));
                order += 1;
                // A successor is valued as its parent, a step nearer when the operator helps.
                let helps = u32::from(!estimate.helpful.contains(&id));
                queue.push(Reverse((2 * estimate.distance + helps, order, next)));
            }
        }
        Ok(None)
    }
}

fn path(parents: &HashMap<State, Option<(State, OperatorId)>>, state: &State) -> Vec<OperatorId> {
    let mut operators = Vec::new();
    let mut at = state;
    while let Some((before, id)) = &parents[at] {
        operators.push(*id);
        at = before;
    }
    operators.reverse();
    operators
}

/// The problem without delete effects.
struct Relaxed<'a> {
    task: &'a Task,
    /// Operators by a fact that they need, those of fact `f` from `starts[f]` to `starts[f + 1]`.
    needed_by: Vec<u32>,
    starts: Vec<u32>,
    added_by: Vec<Vec<u32>>,
    without_needs: Vec<u32>,
    /// How many facts an operator needs, and how many of them are yet missing.
    needs: Vec<u32>,
    missing: Vec<u32>,
    is_goal: Vec<bool>,
    /// The layer at which a fact appears, and the operator that brings it.
    layer: Vec<u32>,
    bringer: Vec<u32>,
    /// Operators that can be carried out in the state looked at last, ascending.
    applicable: Vec<OperatorId>,
}

const NOT_YET: u32 = u32::MAX;

impl<'a> Relaxed<'a> {
    fn new(task: &'a Task) -> Self {
        let mut by_need = vec![Vec::new(); task.facts.len()];
        let mut added_by = vec![Vec::new(); task.facts.len()];
        for (number, operator) in task.operators.iter().enumerate() {
            let needs = operator.preconditions.iter();
            needs.for_each(|fact| by_need[fact.index()].push(number as u32));
            operator.add_effects.iter().for_each(|fact| added_by[fact.index()].push(number as u32));
        }
        let mut starts = vec![0];
        let mut needed_by = Vec::new();
        for operators in by_need {
            needed_by.extend(operators);
            starts.push(needed_by.len() as u32);
        }
        let needs: Vec<u32> =
            task.operators.iter().map(|operator| operator.preconditions.len() as u32).collect();
        let mut is_goal = vec![false; task.facts.len()];
        task.goal.iter().for_each(|goal| is_goal[goal.index()] = true);
        Self {
            task,
            needed_by,
            starts,
            added_by,
            without_needs: (0..needs.len() as u32).filter(|&n| needs[n as usize] == 0).collect(),
            missing: needs.clone(),
            needs,
            is_goal,
            layer: vec![NOT_YET; task.facts.len()],
            bringer: vec![NOT_YET; task.facts.len()],
            applicable: Vec::new(),
        }
    }

    /// None when the goal is out of reach even without delete effects.
    fn estimate(&mut self, state: &State) -> Option<Estimate> {
        self.spread(state).then(|| self.relaxed_plan(state))
    }

    /// Layers of facts up to the goal.
    fn spread(&mut self, state: &State) -> bool {
        self.layer.fill(NOT_YET);
        self.missing.copy_from_slice(&self.needs);
        let mut open = self.task.goal.iter().filter(|goal| !holds(state, **goal)).count();
        let mut queue: Vec<u32> = Vec::new();
        for (word, &bits) in state.iter().enumerate() {
            let mut bits = bits;
            while bits != 0 {
                let fact = (word * 64) as u32 + bits.trailing_zeros();
                bits &= bits - 1;
                self.layer[fact as usize] = 0;
                queue.push(fact);
            }
        }
        self.applicable.clear();
        for at in 0..self.without_needs.len() {
            self.applicable.push(OperatorId(self.without_needs[at]));
            self.apply(self.without_needs[at], 1, &mut open, &mut queue);
        }
        let mut next = 0;
        while let Some(&fact) = queue.get(next) {
            next += 1;
            let layer = self.layer[fact as usize];
            // What the state itself allows is wanted whole, even if the goal holds.
            if open == 0 && layer > 0 {
                break;
            }
            for at in self.starts[fact as usize]..self.starts[fact as usize + 1] {
                let number = self.needed_by[at as usize];
                self.missing[number as usize] -= 1;
                if self.missing[number as usize] == 0 {
                    if layer == 0 {
                        self.applicable.push(OperatorId(number));
                    }
                    self.apply(number, layer + 1, &mut open, &mut queue);
                }
            }
        }
        self.applicable.sort_unstable();
        open == 0
    }

    fn apply(&mut self, number: u32, layer: u32, open: &mut usize, queue: &mut Vec<u32>) {
        for added in &self.task.operators[number as usize].add_effects {
            if self.layer[added.index()] == NOT_YET {
                self.layer[added.index()] = layer;
                self.bringer[added.index()] = number;
                queue.push(added.0);
                *open -= usize::from(self.is_goal[added.index()]);
            }
        }
    }

    fn relaxed_plan(&self, state: &State) -> Estimate {
        let mut wanted: Vec<FactId> =
            self.task.goal.iter().copied().filter(|&goal| !holds(state, goal)).collect();
        let mut asked: HashSet<FactId> = wanted.iter().copied().collect();
        // Operators by the layer at which they become possible.
        let mut chosen: BTreeSet<(u32, u32)> = BTreeSet::new();
        let mut first: BTreeSet<FactId> = BTreeSet::new();
        while let Some(fact) = wanted.pop() {
            if self.layer[fact.index()] == 1 {
                first.insert(fact);
            }
            let number = self.bringer[fact.index()];
            if chosen.insert((self.layer[fact.index()], number)) {
                for &need in &self.task.operators[number as usize].preconditions {
                    if self.layer[need.index()] > 0 && asked.insert(need) {
                        wanted.push(need);
                    }
                }
            }
        }
        let applicable = |number: &u32| {
            self.task.operators[*number as usize]
                .preconditions
                .iter()
                .all(|&fact| holds(state, fact))
        };
        // Whatever brings a fact of the first layer helps, not only what the relaxed plan chose for it.
        let mut operators: Vec<u32> = first
            .iter()
            .flat_map(|fact| self.added_by[fact.index()].iter().copied())
            .filter(applicable)
            .collect();
        operators.sort_unstable_by_key(|number| (!chosen.contains(&(1, *number)), *number));
        operators.dedup();
        Estimate {
            distance: chosen.len() as u32,
            helpful: operators.into_iter().map(OperatorId).collect(),
            relaxed_plan: chosen.into_iter().map(|(_, number)| OperatorId(number)).collect(),
        }
    }
}

/// Takes out operators that the goal does without, together with those that only served them.
pub(super) fn drop_needless(task: &Task, steps: &mut Vec<Vec<OperatorId>>) {
    let mut step = 0;
    while step < steps.len() {
        let mut at = 0;
        while at < steps[step].len() {
            match without(task, steps, step, at) {
                Some(shorter) => *steps = shorter,
                None => at += 1,
            }
        }
        step += 1;
    }
}

/// The steps without one operator and without all that it enabled, if the goal is reached all the same.
fn without(
    task: &Task,
    steps: &[Vec<OperatorId>],
    step: usize,
    at: usize,
) -> Option<Vec<Vec<OperatorId>>> {
    let mut state = vec![false; task.facts.len()];
    task.init.iter().for_each(|fact| state[fact.index()] = true);
    let mut kept = Vec::with_capacity(steps.len());
    for (number, operators) in steps.iter().enumerate() {
        let possible = |(place, id): (usize, &OperatorId)| {
            let own = number == step && place == at;
            let ready = task.operator(*id).preconditions.iter().all(|fact| state[fact.index()]);
            (!own && ready).then_some(*id)
        };
        let operators: Vec<OperatorId> =
            operators.iter().enumerate().filter_map(possible).collect();
        for &id in &operators {
            task.operator(id).del_effects.iter().for_each(|fact| state[fact.index()] = false);
        }
        for &id in &operators {
            task.operator(id).add_effects.iter().for_each(|fact| state[fact.index()] = true);
        }
        kept.push(operators);
    }
    task.goal.iter().all(|fact| state[fact.index()]).then_some(kept)
}

/// Each operator in the first step after all that it depends on or interferes with.
pub(super) fn in_parallel(task: &Task, operators: impl Iterator<Item = OperatorId>) -> Plan {
    let mut placed: Vec<(OperatorId, usize)> = Vec::new();
    let mut steps: Vec<Vec<OperatorId>> = Vec::new();
    for id in operators {
        let operator = task.operator(id);
        let meets = |a: &[FactId], b: &[FactId]| a.iter().any(|fact| b.contains(fact));
        let follows = |earlier: OperatorId| {
            let earlier = task.operator(earlier);
            meets(&earlier.add_effects, &operator.preconditions)
                || meets(&earlier.del_effects, &operator.preconditions)
                || meets(&earlier.del_effects, &operator.add_effects)
                || meets(&operator.del_effects, &earlier.preconditions)
                || meets(&operator.del_effects, &earlier.add_effects)
        };
        let after =
            placed.iter().filter(|(earlier, _)| follows(*earlier)).map(|(_, step)| step + 1);
        let step = after.max().unwrap_or(0);
        if steps.len() <= step {
            steps.resize(step + 1, Vec::new());
        }
        steps[step].push(id);
        placed.push((id, step));
    }
    steps.iter_mut().for_each(|step| step.sort_unstable());
    Plan { steps }
}
