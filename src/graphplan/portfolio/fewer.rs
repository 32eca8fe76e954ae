//! A plan of fewer actions, stretch by stretch: a few actions in a row are sought anew, from the state before them to
//! what the rest of the plan needs (F. Siddiqui, P. Haslum, 2015, "block deordering and local search").
//!
//! What stands in a row is a matter of the order. Actions that neither serve nor disturb each other may change places,
//! so each round lays the plan out anew and brings actions about the same things together: all that one lift does, all
//! that becomes of one passenger. A stretch is sought by best-first search over actions so far and those of a relaxed
//! plan to go, through helpful operators only: a stretch that it misses stays as it is. The plan stays a plan
//! throughout; it never gets more actions, nor dearer.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap, HashMap};
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use super::parallel::{follows, has_less, in_parallel, needful};
use super::relaxed::{Estimate, Relaxed, State, carry_out, initial, needed_by};
use crate::plan::Plan;
use crate::strips::{FactId, OperatorId, Task};
use crate::units::Gather as _;
use crate::{Limit, Limits};

/// Actions sought anew at once, one size after the other.
const WIDTHS: [usize; 4] = [6, 12, 24, 48];

/// States looked at for one stretch at first; twice as many each time that nothing more is won with so many.
const FEW_STATES: usize = 300;
const MOST_STATES: usize = 1 << 16;

/// Ways to lay a plan out.
#[derive(Clone, Copy)]
enum Layout {
    AsItIs,
    /// Next to each action the one that has most in common with it.
    Together,
    /// The same from the last action backward.
    FromTheEnd,
}

/// A plan with fewer actions, as far as so much effort goes, which is taken from it.
pub(crate) fn fewer(task: &Task, plan: Plan, limits: &Limits, effort: &mut u64) -> Plan {
    let mut stretches = Stretches::of(task, plan, limits);
    stretches.go_on(effort);
    stretches.best
}

/// A plan that is made of fewer actions, as far as that has come.
pub(super) struct Stretches<'a> {
    task: &'a Task,
    limits: &'a Limits,
    relaxed: Relaxed<'a>,
    /// Of each operator the objects of which it changes something.
    subjects: Vec<Vec<u32>>,
    /// Where the effort allowed ends.
    most: u64,
    /// What has the fewest actions, in the order that it was laid out in last.
    row: Vec<OperatorId>,
    /// Of those met on the way the plan that has the least of actions and steps together: what little is won at the end
    /// may put in a row what could be done at once.
    best: Plan,
    /// States looked at for one stretch.
    states: usize,
    /// Stretches of which it is known that so many states win nothing; told apart by a hash, as what two of them share
    /// costs no more than a chance.
    in_vain: HashMap<u64, usize>,
}

impl<'a> Stretches<'a> {
    pub(super) fn of(task: &'a Task, plan: Plan, limits: &'a Limits) -> Self {
        let row = needful(task, plan.operators().collect());
        let (relaxed, subjects) = (Relaxed::by_sum(task), subjects(task));
        let (states, in_vain) = (FEW_STATES, HashMap::new());
        let mut stretches =
            Self { task, limits, relaxed, subjects, most: 0, row, best: plan, states, in_vain };
        stretches.offer(&stretches.row.clone());
        stretches
    }

    /// Goes on for so much effort, from which what it took is taken; whether more may be won by more.
    pub(super) fn go_on(&mut self, effort: &mut u64) -> bool {
        self.most = self.relaxed.effort.saturating_add(*effort);
        let mut row = std::mem::take(&mut self.row);
        // What was won stands, whatever ends it.
        let ended = self.run(&mut row);
        self.row = row;
        *effort = self.most.saturating_sub(self.relaxed.effort);
        ended.is_err()
    }

    pub(super) fn best(&self) -> &Plan {
        &self.best
    }

    /// Rounds of all layouts and widths with what a stretch does not touch at rest, then of the same with all that there
    /// is; when neither wins anything, with more states.
    fn run(&mut self, row: &mut Vec<OperatorId>) -> Result<(), Limit> {
        while self.states <= MOST_STATES {
            let before = (row.len(), self.cost(row));
            for others_rest in [true, false] {
                for width in WIDTHS {
                    for layout in [Layout::AsItIs, Layout::Together, Layout::FromTheEnd] {
                        *row = laid_out(self.task, row, layout);
                        let known = (row.len(), self.cost(row));
                        let ended = self.pass(row, (width, self.states), others_rest);
                        // Another order of the same actions makes the same steps.
                        if (row.len(), self.cost(row)) < known {
                            *row = needful(self.task, std::mem::take(row));
                            self.offer(row);
                        }
                        ended?;
                    }
                    if width >= 2 * row.len() {
                        break;
                    }
                }
            }
            if (row.len(), self.cost(row)) >= before {
                self.states *= 2;
            }
        }
        Ok(())
    }

    fn offer(&mut self, row: &[OperatorId]) {
        if row.len() <= self.best.action_count() && self.cost(row) <= self.best.cost(self.task) {
            let plan = in_parallel(self.task, row.iter().copied());
            if has_less(self.task, &plan, &self.best) {
                self.best = plan;
            }
        }
    }

    /// Each stretch of so many actions once; with what it does not touch at rest, or free.
    fn pass(
        &mut self,
        row: &mut Vec<OperatorId>,
        (width, states): (usize, usize),
        others_rest: bool,
    ) -> Result<(), Limit> {
        if !others_rest {
            self.relaxed.restrict(|_| true);
        }
        let mut from = 0;
        let mut state = initial(self.task);
        while from < row.len() {
            self.limits.check(0)?;
            if self.relaxed.effort >= self.most {
                return Err(Limit::Effort);
            }
            let to = (from + width).min(row.len());
            let goal = needed_by(self.task, &row[to..]);
            let mut hasher = DefaultHasher::new();
            (&state, &goal, &row[from..to], others_rest).hash(&mut hasher);
            let stretch = hasher.finish();
            let is_in_vain = self.in_vain.get(&stretch).is_some_and(|&known| known >= states);
            if others_rest && !is_in_vain {
                let touched: BTreeSet<u32> = row[from..to]
                    .iter()
                    .flat_map(|id| &self.subjects[id.index()])
                    .copied()
                    .gather();
                let subjects = &self.subjects;
                self.relaxed.restrict(|operator| {
                    subjects[operator].iter().all(|subject| touched.contains(subject))
                });
            }
            let sought = match is_in_vain {
                true => Sought::Open,
                false => self.sought(&state, &goal, &row[from..to], states)?,
            };
            let next = match sought {
                // What came before may be won further by what is new.
                Sought::Shorter(shorter) => {
                    row.splice(from..to, shorter);
                    from
                }
                Sought::Open | Sought::None => {
                    if !is_in_vain {
                        let is_open = matches!(sought, Sought::Open);
                        self.in_vain.insert(stretch, if is_open { states } else { usize::MAX });
                    }
                    from + (width / 2).max(1)
                }
            };
            let next = next.min(row.len());
            row[from..next].iter().for_each(|&id| carry_out(self.task, &mut state, id));
            from = next;
        }
        Ok(())
    }

    fn cost(&self, row: &[OperatorId]) -> u64 {
        row.iter().map(|&id| u64::from(self.task.operator(id).cost)).sum()
    }

    /// Fewer actions that lead from a state to all that is wanted, and cost no more.
    fn sought(
        &mut self,
        start: &State,
        goal: &[FactId],
        known: &[OperatorId],
        most_states: usize,
    ) -> Result<Sought, Limit> {
        let most_cost = self.cost(known);
        self.relaxed.aim_at(goal);
        let Some(first) = self.relaxed.estimate(start) else { return Ok(Sought::None) };
        let distance = first.distance;
        let mut nodes = vec![Node { from: None, actions: 0, cost: 0, estimate: Some(first) }];
        let mut states = vec![start.clone()];
        let mut seen: HashMap<State, u32> = HashMap::from([(start.clone(), 0)]);
        let mut open = BinaryHeap::from([Reverse((distance, distance, 0_u32))]);
        if distance == 0 {
            return Ok(if known.is_empty() { Sought::None } else { Sought::Shorter(Vec::new()) });
        }
        while let Some(Reverse((_, _, number))) = open.pop() {
            let (actions, cost) = {
                let node = &nodes[number as usize];
                (node.actions + 1, node.cost)
            };
            // Some action leads from here to the goal at best.
            if actions as usize >= known.len() {
                continue;
            }
            let Some(estimate) = nodes[number as usize].estimate.take() else { continue };
            for id in self.relaxed.helpful(&states[number as usize], &estimate) {
                let cost = cost + u64::from(self.task.operator(id).cost);
                if cost > most_cost {
                    continue;
                }
                let mut state = states[number as usize].clone();
                carry_out(self.task, &mut state, id);
                if seen.get(&state).is_some_and(|&known| known <= actions) {
                    continue;
                }
                seen.insert(state.clone(), actions);
                let Some(estimate) = self.relaxed.estimate(&state) else { continue };
                let next = nodes.len() as u32;
                let from = Some((number, id));
                if estimate.distance == 0 {
                    nodes.push(Node { from, actions, cost, estimate: None });
                    return Ok(Sought::Shorter(path(&nodes, next)));
                }
                if actions as usize + 1 >= known.len() {
                    continue;
                }
                open.push(Reverse((actions + estimate.distance, estimate.distance, next)));
                nodes.push(Node { from, actions, cost, estimate: Some(estimate) });
                states.push(state);
            }
            if nodes.len() >= most_states {
                return Ok(Sought::Open);
            }
            self.limits.check(0)?;
        }
        Ok(Sought::None)
    }
}

/// Of each operator the objects of which it changes something: those that a fact it deletes and one that it adds have
/// in common. A lift that goes from floor to floor is its own subject, the floors are not.
fn subjects(task: &Task) -> Vec<Vec<u32>> {
    let mut numbers: HashMap<&str, u32> = HashMap::new();
    let subjects = task.operators.iter().map(|operator| {
        let mut own = BTreeSet::new();
        for &gone in &operator.del_effects {
            for &come in &operator.add_effects {
                let (gone, come) = (&task.fact(gone).args, &task.fact(come).args);
                for arg in gone.iter().filter(|arg| come.contains(arg)) {
                    let next = numbers.len() as u32;
                    own.insert(*numbers.entry(arg).or_insert(next));
                }
            }
        }
        own.into_iter().collect()
    });
    subjects.collect()
}

/// What a stretch came to.
enum Sought {
    /// Fewer actions, no dearer.
    Shorter(Vec<OperatorId>),
    /// None that helpful operators lead to.
    None,
    /// The states allowed were not enough.
    Open,
}

/// A state met on the way, and by which operator.
struct Node {
    from: Option<(u32, OperatorId)>,
    actions: u32,
    cost: u64,
    /// Until its turn has come.
    estimate: Option<Estimate>,
}

fn path(nodes: &[Node], to: u32) -> Vec<OperatorId> {
    let mut path = Vec::new();
    let mut at = to;
    while let Some((from, by)) = nodes[at as usize].from {
        path.push(by);
        at = from;
    }
    path.reverse();
    path
}

/// For each action those before it that must stay before it: it needs what they bring, or interferes.
fn before(task: &Task, row: &[OperatorId]) -> Vec<Vec<u32>> {
    let stays = |earlier: OperatorId, later: OperatorId| {
        follows(task.operator(earlier), task.operator(later))
    };
    (0..row.len())
        .map(|at| (0..at).filter(|&e| stays(row[e], row[at])).map(|e| e as u32).collect())
        .collect()
}

/// The same plan, with its actions in another order, as far as that is free.
fn laid_out(task: &Task, row: &[OperatorId], layout: Layout) -> Vec<OperatorId> {
    if let Layout::AsItIs = layout {
        return row.to_vec();
    }
    let before = before(task, row);
    let mut after = vec![Vec::new(); row.len()];
    for (later, earlier) in before.iter().enumerate() {
        earlier.iter().for_each(|&earlier| after[earlier as usize].push(later as u32));
    }
    if let Layout::Together = layout {
        return together(task, row, &before, &after, (0..row.len()).collect());
    }
    let mut laid = together(task, row, &after, &before, (0..row.len()).rev().collect());
    laid.reverse();
    laid
}

/// Actions in the order in which they cease to wait, each one that has most in common with the one before it; of those
/// the one that comes first in `ranked`.
fn together(
    task: &Task,
    row: &[OperatorId],
    waits_for: &[Vec<u32>],
    next: &[Vec<u32>],
    ranked: Vec<usize>,
) -> Vec<OperatorId> {
    let mut waits: Vec<usize> = waits_for.iter().map(Vec::len).collect();
    let in_common = |a: OperatorId, b: OperatorId| {
        let (a, b) = (&task.operator(a).args, &task.operator(b).args);
        a.iter().filter(|arg| b.contains(arg)).count()
    };
    let mut rank = vec![0; row.len()];
    ranked.iter().enumerate().for_each(|(at, &action)| rank[action] = at);
    let mut free: Vec<usize> = ranked.into_iter().filter(|&action| waits[action] == 0).collect();
    let mut laid: Vec<OperatorId> = Vec::with_capacity(row.len());
    let best = |free: &[usize], last: Option<OperatorId>| {
        let key = |&at: &usize| {
            let action = free[at];
            let shared = last.map_or(0, |last| in_common(last, row[action]));
            (Reverse(shared), rank[action])
        };
        (0..free.len()).min_by_key(key)
    };
    while let Some(at) = best(&free, laid.last().copied()) {
        let action = free.swap_remove(at);
        laid.push(row[action]);
        for &other in &next[action] {
            waits[other as usize] -= 1;
            if waits[other as usize] == 0 {
                free.push(other as usize);
            }
        }
    }
    laid
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{Random, random_errand, random_task};
    use crate::{Outcome, solve_any, validate};

    #[test]
    fn what_has_fewer_actions_is_a_plan_and_no_dearer() {
        let mut won = 0;
        for seed in 1..=3000 {
            let mut task = if seed % 2 == 0 { random_task(seed) } else { random_errand(seed) };
            let mut random = Random(seed);
            if seed % 3 == 0 {
                task.operators.iter_mut().for_each(|o| o.cost = random.below(4) as u32);
            }
            let at_once = Limits { shorten: 0, ..Limits::default() };
            let Outcome::Plan(first) = solve_any(&task, &at_once) else { continue };
            for most in [0, 1 << 8, 1 << 16] {
                let mut effort = most;
                let plan = fewer(&task, first.clone(), &Limits::default(), &mut effort);
                assert!(effort <= most);
                assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                assert!(plan.action_count() <= first.action_count(), "seed {seed}");
                assert!(plan.cost(&task) <= first.cost(&task), "seed {seed}");
                won += usize::from(plan.action_count() < first.action_count());
            }
        }
        assert!(won > 20, "{won}");
    }

    #[test]
    fn every_layout_is_the_same_plan() {
        for seed in 1..=1000 {
            let task = random_task(seed);
            let at_once = Limits { shorten: 0, ..Limits::default() };
            let Outcome::Plan(plan) = solve_any(&task, &at_once) else { continue };
            let row: Vec<OperatorId> = plan.operators().collect();
            for layout in [Layout::AsItIs, Layout::Together, Layout::FromTheEnd] {
                let laid = laid_out(&task, &row, layout);
                let (mut before, mut after) = (row.clone(), laid.clone());
                before.sort_unstable();
                after.sort_unstable();
                assert_eq!(before, after, "seed {seed}");
                let steps = laid.into_iter().map(|id| vec![id]).collect();
                assert_eq!(validate(&task, &Plan { steps }), Ok(()), "seed {seed}");
            }
        }
    }
}
