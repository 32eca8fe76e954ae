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
                    self.carry_out(&mut state, id);
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
            self.carry_out(&mut state, other);
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

    /// Nearest state first; helpful operators are tried at once, the others when nothing nearer is left, and the end
    /// of the relaxed plan before all. A successor is made when its turn comes: most never come to it.
    fn best_first(&mut self) -> Result<Option<Vec<OperatorId>>, Limit> {
        let mut seen = Seen::default();
        let mut queue: BinaryHeap<Reverse<Candidate>> = BinaryHeap::new();
        let mut next = Some((self.initial(), None, Box::default()));
        let mut order = 0;
        loop {
            if let Some((state, from, by)) = next.take()
                && let Some(number) = seen.add(&state, from, by)
            {
                let bytes = seen.bytes + queue.len() * std::mem::size_of::<Candidate>();
                if let Some(estimate) = self.estimate(&state, bytes)? {
                    if estimate.distance == 0 {
                        return Ok(Some(seen.path(number)));
                    }
                    let mut push = |value, by| {
                        order += 1;
                        queue.push(Reverse(Candidate { value, order, from: number, by }));
                    };
                    // A successor is valued as its parent, a step nearer when the operator helps.
                    for &id in &self.relaxed.applicable {
                        let helps = u32::from(!estimate.helpful.contains(&id));
                        push(2 * estimate.distance + helps, Some(id));
                    }
                    push(2 * estimate.distance - 1, None);
                    seen.relaxed_plans.insert(number, estimate.relaxed_plan);
                }
            }
            let Some(Reverse(Candidate { from, by, .. })) = queue.pop() else { return Ok(None) };
            if self.is_over() {
                return Ok(None);
            }
            let state = &seen.states[from as usize];
            let (state, by) = match by {
                Some(id) => (self.after(state, id), Box::from([id])),
                None => {
                    let plan = seen.relaxed_plans.remove(&from).unwrap_or_default();
                    let (state, path) = self.ahead(state, &plan);
                    (state, path.into_boxed_slice())
                }
            };
            next = Some((state, Some(from), by));
        }
    }
}

/// A successor that waits for its turn; those of least value come first, of these the oldest.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Candidate {
    value: u32,
    order: u32,
    from: u32,
    /// None for the end of the relaxed plan.
    by: Option<OperatorId>,
}

/// States met, each with the state that it was come to from, and by which operators.
#[derive(Default)]
struct Seen {
    numbers: HashMap<State, u32>,
    states: Vec<State>,
    from: Vec<(Option<u32>, Box<[OperatorId]>)>,
    /// Of states whose relaxed plan was not yet followed.
    relaxed_plans: HashMap<u32, Vec<OperatorId>>,
    bytes: usize,
}

impl Seen {
    /// The number of a state not met before.
    fn add(&mut self, state: &State, from: Option<u32>, by: Box<[OperatorId]>) -> Option<u32> {
        let number = self.states.len() as u32;
        if self.numbers.contains_key(state) {
            return None;
        }
        self.bytes += 2 * state.len() * 8 + by.len() * 4 + 128;
        self.numbers.insert(state.clone(), number);
        self.states.push(state.clone());
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

/// The problem without delete effects.
struct Relaxed<'a> {
    task: &'a Task,
    /// Operators by a fact that they need, those of fact `f` from `starts[f]` to `starts[f + 1]`.
    needed_by: Vec<u32>,
    starts: Vec<u32>,
    added_by: Vec<Vec<u32>>,
    /// What operator `o` adds, from `adds_from[o]` to `adds_from[o + 1]`.
    adds: Vec<FactId>,
    adds_from: Vec<u32>,
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
        let mut adds_from = vec![0];
        let mut adds = Vec::new();
        for operator in &task.operators {
            adds.extend(&operator.add_effects);
            adds_from.push(adds.len() as u32);
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
            adds,
            adds_from,
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
        let own =
            self.adds_from[number as usize] as usize..self.adds_from[number as usize + 1] as usize;
        for added in &self.adds[own] {
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
