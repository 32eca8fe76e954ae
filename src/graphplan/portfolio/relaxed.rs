//! The problem without delete effects: how far a state seems from the goal (J. Hoffmann, B. Nebel, 2001).
//!
//! A relaxed plan is read off layers of facts that only grow. Its length estimates the distance, and operators that
//! bring a fact of its first layer are worth trying first.

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::bits;
use crate::strips::{FactId, Operator, OperatorId, Task};

/// What holds, as bits.
pub(crate) type State = Box<[u64]>;

/// What holds at the beginning.
pub(crate) fn initial(task: &Task) -> State {
    let mut state: State = vec![0; bits::words(task.facts.len())].into();
    task.init.iter().for_each(|fact| bits::put(&mut state, fact.index()));
    state
}

/// What must hold for the last actions of a plan to reach the goal.
pub(crate) fn needed_by(task: &Task, row: &[OperatorId]) -> Vec<FactId> {
    let mut needed = vec![0; bits::words(task.facts.len())].into_boxed_slice();
    task.goal.iter().for_each(|fact| bits::put(&mut needed, fact.index()));
    for &id in row.iter().rev() {
        let operator = task.operator(id);
        operator.add_effects.iter().for_each(|fact| bits::take(&mut needed, fact.index()));
        operator.preconditions.iter().for_each(|fact| bits::put(&mut needed, fact.index()));
    }
    facts(&needed)
}

/// The facts of a set, sorted.
pub(crate) fn facts(state: &State) -> Vec<FactId> {
    bits::members(state).map(|fact| FactId(fact as u32)).collect()
}

/// Carries out an action whose conditions hold.
pub(crate) fn carry_out(task: &Task, state: &mut State, id: OperatorId) {
    let operator = task.operator(id);
    operator.del_effects.iter().for_each(|fact| bits::take(state, fact.index()));
    operator.add_effects.iter().for_each(|fact| bits::put(state, fact.index()));
}

pub(crate) fn holds(state: &State, fact: FactId) -> bool {
    bits::has(state, fact.index())
}

/// How far a state seems from the goal, and what to try.
pub(crate) struct Estimate {
    pub(crate) distance: u32,
    /// Facts that its first operators bring.
    first: BTreeSet<FactId>,
    /// The relaxed plan, in the order of its layers.
    pub(crate) relaxed_plan: Vec<OperatorId>,
}

/// The problem without delete effects.
pub(crate) struct Relaxed<'a> {
    task: &'a Task,
    /// The numbers of the operators that bring anything; the others are left out of all that follows.
    operators: Vec<u32>,
    /// Places in that row by a fact that the operators there need, those of fact `f` from `starts[f]` to `starts[f + 1]`.
    needed_by: Vec<u32>,
    starts: Vec<u32>,
    /// The numbers of all operators that add a fact.
    pub(crate) added_by: Vec<Vec<u32>>,
    /// What the operator at place `o` brings, from `adds_from[o]` to `adds_from[o + 1]`.
    adds: Vec<FactId>,
    adds_from: Vec<u32>,
    without_needs: Vec<u32>,
    allowed: Vec<bool>,
    /// How many facts an operator needs, and how many of them are yet missing.
    needs: Vec<u32>,
    missing: Vec<u32>,
    goal: Vec<FactId>,
    is_goal: Vec<bool>,
    /// The layer at which a fact appears, or what it takes with all that leads to it, and the operator that brings it.
    layer: Vec<u32>,
    bringer: Vec<u32>,
    /// What was looked at so far, in facts and operators.
    pub(crate) effort: u64,
    /// Whether what brings a fact is chosen by all that leads to it rather than by its layer, and for that what an
    /// operator takes, and the facts in the order of what they take.
    by_sum: bool,
    takes: Vec<u32>,
    buckets: Vec<Vec<u32>>,
}

/// What takes more than this is not told apart.
const MOST_TAKEN: usize = 1 << 12;

const NOT_YET: u32 = u32::MAX;

impl<'a> Relaxed<'a> {
    pub(crate) fn new(task: &'a Task) -> Self {
        let mut added_by = vec![Vec::new(); task.facts.len()];
        for (number, operator) in task.operators.iter().enumerate() {
            operator.add_effects.iter().for_each(|fact| added_by[fact.index()].push(number as u32));
        }
        let mut relaxed = Self {
            task,
            operators: Vec::new(),
            needed_by: Vec::new(),
            starts: Vec::new(),
            added_by,
            adds: Vec::new(),
            adds_from: Vec::new(),
            without_needs: Vec::new(),
            allowed: vec![true; task.operators.len()],
            missing: Vec::new(),
            needs: Vec::new(),
            goal: Vec::new(),
            is_goal: vec![false; task.facts.len()],
            layer: vec![NOT_YET; task.facts.len()],
            bringer: vec![NOT_YET; task.facts.len()],
            effort: 0,
            by_sum: false,
            takes: Vec::new(),
            buckets: Vec::new(),
        };
        relaxed.index();
        relaxed.aim_at(&task.goal);
        relaxed
    }

    /// From now on there are no other operators than these.
    pub(crate) fn restrict(&mut self, allowed: impl Fn(usize) -> bool) {
        (0..self.allowed.len()).for_each(|number| self.allowed[number] = allowed(number));
        self.index();
    }

    /// What the operators allowed bring, and need for it.
    fn index(&mut self) {
        let task = self.task;
        let serving = self.serving();
        self.operators.clear();
        self.adds.clear();
        self.adds_from.clear();
        for (number, fact) in serving {
            if self.operators.last() != Some(&number) {
                self.operators.push(number);
                self.adds_from.push(self.adds.len() as u32);
            }
            self.adds.push(fact);
        }
        self.adds_from.push(self.adds.len() as u32);
        let needs = |number: u32| &task.operators[number as usize].preconditions;
        self.needs = self.operators.iter().map(|&number| needs(number).len() as u32).collect();
        self.missing.clone_from(&self.needs);
        let places = || (0..self.operators.len() as u32).zip(&self.operators);
        self.without_needs =
            places().filter(|(_, number)| needs(**number).is_empty()).map(|(at, _)| at).collect();
        self.starts.clear();
        self.starts.resize(task.facts.len() + 1, 0);
        for fact in self.operators.iter().flat_map(|&number| needs(number)) {
            self.starts[fact.index() + 1] += 1;
        }
        (0..task.facts.len()).for_each(|fact| self.starts[fact + 1] += self.starts[fact]);
        let mut next = self.starts.clone();
        self.needed_by.clear();
        self.needed_by.resize(self.starts[task.facts.len()] as usize, 0);
        for (at, &number) in places() {
            for fact in needs(number) {
                self.needed_by[next[fact.index()] as usize] = at;
                next[fact.index()] += 1;
            }
        }
        self.effort += task.operators.len() as u64 / 4;
    }

    /// Operators with what they bring, ascending: an operator brings nothing that another brings which needs some of the
    /// same facts and no others, for the other comes no later.
    fn serving(&self) -> Vec<(u32, FactId)> {
        let task = self.task;
        let needs = |number: u32| &task.operators[number as usize].preconditions;
        let mut serving: Vec<(u32, FactId)> = Vec::new();
        // Those that serve, by the one of their needs that the fewest share.
        let mut by_need: HashMap<FactId, Vec<u32>> = HashMap::new();
        let mut sharing = vec![0_u32; task.facts.len()];
        for fact in task.fact_ids() {
            let mut bringers: Vec<u32> = self.added_by[fact.index()].clone();
            let may = |number: &u32| {
                self.allowed[*number as usize] && needs(*number).binary_search(&fact).is_err()
            };
            bringers.retain(may);
            bringers.sort_by_key(|&number| needs(number).len());
            let all = || bringers.iter().flat_map(|&number| needs(number));
            all().for_each(|need| sharing[need.index()] += 1);
            by_need.clear();
            for &number in &bringers {
                let own = needs(number);
                let less =
                    |&other: &u32| needs(other).iter().all(|need| own.binary_search(need).is_ok());
                if own.iter().filter_map(|need| by_need.get(need)).flatten().any(less) {
                    continue;
                }
                serving.push((number, fact));
                match own.iter().min_by_key(|need| sharing[need.index()]) {
                    Some(&need) => by_need.entry(need).or_default().push(number),
                    // There is nothing less.
                    None => break,
                }
            }
            all().for_each(|need| sharing[need.index()] = 0);
        }
        serving.sort_unstable();
        serving
    }

    /// As [`Self::new`], but relaxed plans are shorter and take longer to find: what brings a fact is what takes the
    /// fewest actions with all that leads to it (E. Keyder, H. Geffner, 2008).
    pub(crate) fn by_sum(task: &'a Task) -> Self {
        Self { by_sum: true, buckets: vec![Vec::new(); MOST_TAKEN], ..Self::new(task) }
    }

    /// From now on distances are those to these facts.
    pub(crate) fn aim_at(&mut self, goal: &[FactId]) {
        self.goal.iter().for_each(|fact| self.is_goal[fact.index()] = false);
        self.goal = goal.to_vec();
        self.goal.iter().for_each(|fact| self.is_goal[fact.index()] = true);
    }

    /// None when the goal is out of reach even without delete effects.
    pub(crate) fn estimate(&mut self, state: &State) -> Option<Estimate> {
        let reached =
            if self.by_sum { self.spread_by_sum(state) } else { self.spread(state, None) };
        reached.then(|| self.relaxed_plan(state))
    }

    /// Steps that the goal takes at least from a state: its layer without delete effects; none when it is out of reach
    /// even so.
    pub(crate) fn depth(&mut self, state: &State) -> Option<usize> {
        let reached = self.spread(state, None);
        let layers = self.goal.iter().map(|goal| self.layer[goal.index()] as usize);
        reached.then(|| layers.max().unwrap_or(0))
    }

    /// For each operator the steps that must come before it, without delete effects; as many as can be told as not for
    /// those that do not come within so many.
    pub(crate) fn earliest(&mut self, state: &State, within: usize) -> Vec<usize> {
        self.spread(state, Some(within as u32));
        let needs = |operator: &Operator| {
            let layers = operator.preconditions.iter().map(|fact| self.layer[fact.index()]);
            layers.max().unwrap_or(0)
        };
        let earliest = self.task.operators.iter().map(|operator| match needs(operator) as usize {
            soon if soon < within => soon,
            _ => usize::MAX,
        });
        earliest.collect()
    }

    /// Layers of facts up to the goal, or up to a given one.
    fn spread(&mut self, state: &State, within: Option<u32>) -> bool {
        self.layer.fill(NOT_YET);
        self.missing.copy_from_slice(&self.needs);
        let mut open = self.goal.iter().filter(|goal| !holds(state, **goal)).count();
        let mut queue: Vec<u32> = Vec::new();
        for fact in bits::members(state) {
            self.layer[fact] = 0;
            queue.push(fact as u32);
        }
        for at in 0..self.without_needs.len() {
            self.apply(self.without_needs[at], 1, &mut open, &mut queue);
        }
        let mut next = 0;
        while let Some(&fact) = queue.get(next) {
            next += 1;
            let layer = self.layer[fact as usize];
            let is_far = within.map_or(open == 0, |within| layer >= within);
            if is_far {
                break;
            }
            let users = self.starts[fact as usize]..self.starts[fact as usize + 1];
            self.effort += u64::from(users.end - users.start);
            for at in users {
                let number = self.needed_by[at as usize];
                self.missing[number as usize] -= 1;
                if self.missing[number as usize] == 0 {
                    self.apply(number, layer + 1, &mut open, &mut queue);
                }
            }
        }
        // Wiping the slate takes little for each fact and operator.
        self.effort += (self.layer.len() + self.missing.len()) as u64 / 16 + queue.len() as u64;
        open == 0
    }

    /// What each fact up to the goal takes, with all that leads to it.
    fn spread_by_sum(&mut self, state: &State) -> bool {
        self.layer.fill(NOT_YET);
        self.missing.copy_from_slice(&self.needs);
        self.takes.clear();
        self.takes.resize(self.needs.len(), 1);
        let mut open = self.goal.len();
        let (mut at, mut last, mut looked_at) = (0, 0, 0);
        for fact in bits::members(state) {
            self.layer[fact] = 0;
            self.buckets[0].push(fact as u32);
        }
        for n in 0..self.without_needs.len() {
            last = last.max(self.brought(self.without_needs[n]));
        }
        while at <= last && open > 0 {
            let Some(fact) = self.buckets[at].pop() else {
                at += 1;
                continue;
            };
            if self.layer[fact as usize] as usize != at {
                continue;
            }
            open -= usize::from(self.is_goal[fact as usize]);
            let users = self.starts[fact as usize]..self.starts[fact as usize + 1];
            looked_at += u64::from(users.end - users.start) + 1;
            for user in users {
                let number = self.needed_by[user as usize];
                self.missing[number as usize] -= 1;
                self.takes[number as usize] += at as u32;
                if self.missing[number as usize] == 0 {
                    last = last.max(self.brought(number));
                }
            }
        }
        self.buckets[at..=last].iter_mut().for_each(Vec::clear);
        self.effort += (self.layer.len() + 2 * self.missing.len()) as u64 / 16 + 2 * looked_at;
        open == 0
    }

    /// What an operator brings waits for its turn, which is told.
    fn brought(&mut self, at: u32) -> usize {
        let takes = self.takes[at as usize].min(MOST_TAKEN as u32 - 1);
        let own = self.adds_from[at as usize]..self.adds_from[at as usize + 1];
        for added in &self.adds[own.start as usize..own.end as usize] {
            if self.layer[added.index()] > takes {
                self.layer[added.index()] = takes;
                self.bringer[added.index()] = self.operators[at as usize];
                self.buckets[takes as usize].push(added.0);
            }
        }
        takes as usize
    }

    fn apply(&mut self, at: u32, layer: u32, open: &mut usize, queue: &mut Vec<u32>) {
        let own = self.adds_from[at as usize] as usize..self.adds_from[at as usize + 1] as usize;
        for added in &self.adds[own] {
            if self.layer[added.index()] == NOT_YET {
                self.layer[added.index()] = layer;
                self.bringer[added.index()] = self.operators[at as usize];
                queue.push(added.0);
                *open -= usize::from(self.is_goal[added.index()]);
            }
        }
    }

    fn relaxed_plan(&self, state: &State) -> Estimate {
        let mut wanted: Vec<FactId> =
            self.goal.iter().copied().filter(|&goal| !holds(state, goal)).collect();
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
        Estimate {
            distance: chosen.len() as u32,
            first,
            relaxed_plan: chosen.into_iter().map(|(_, number)| OperatorId(number)).collect(),
        }
    }

    /// Operators that a state allows and that bring a first fact of its relaxed plan, whatever that chose for it; those
    /// of the relaxed plan first.
    pub(crate) fn helpful(&self, state: &State, of: &Estimate) -> Vec<OperatorId> {
        let planned: HashSet<OperatorId> = of.relaxed_plan.iter().copied().collect();
        let applicable = |number: &u32| {
            let needs = &self.task.operators[*number as usize].preconditions;
            self.allowed[*number as usize] && needs.iter().all(|&fact| holds(state, fact))
        };
        let bringers = of.first.iter().flat_map(|fact| self.added_by[fact.index()].iter().copied());
        let mut operators: Vec<OperatorId> = bringers.filter(applicable).map(OperatorId).collect();
        operators.sort_unstable_by_key(|id| (!planned.contains(id), *id));
        operators.dedup();
        operators
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::random_task;

    /// What each fact takes with all that leads to it, by all operators, until nothing changes.
    fn sums(task: &Task, allowed: impl Fn(usize) -> bool) -> Vec<u32> {
        let mut sums = vec![NOT_YET; task.facts.len()];
        task.init.iter().for_each(|fact| sums[fact.index()] = 0);
        loop {
            let before = sums.clone();
            for (_, operator) in task.operators.iter().enumerate().filter(|(n, _)| allowed(*n)) {
                let mut needs = operator.preconditions.iter().map(|need| sums[need.index()]);
                let Some(sum) = needs.try_fold(1_u32, u32::checked_add) else { continue };
                for added in &operator.add_effects {
                    sums[added.index()] = sums[added.index()].min(sum);
                }
            }
            if sums == before {
                return sums;
            }
        }
    }

    #[test]
    fn operators_left_out_bring_nothing_sooner() {
        let mut left_out = 0;
        for seed in 1..=1000 {
            let task = random_task(seed);
            let mut relaxed = Relaxed::by_sum(&task);
            left_out += task.operators.len() - relaxed.operators.len();
            // One goal that is out of reach, so that nothing ends before all is seen.
            relaxed.goal.push(FactId(0));
            relaxed.spread_by_sum(&initial(&task));
            assert_eq!(relaxed.layer, sums(&task, |_| true), "seed {seed}");
            let some = |operator: usize| !operator.is_multiple_of(3);
            relaxed.restrict(some);
            relaxed.spread_by_sum(&initial(&task));
            assert_eq!(relaxed.layer, sums(&task, some), "seed {seed}");
        }
        assert!(left_out > 1000, "{left_out}");
    }
}
