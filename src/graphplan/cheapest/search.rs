//! The way of least cost from a state to a goal: A* over states, with the bound of [`Cuts`] (M. Helmert, C. Domshlak,
//! 2009).
//!
//! A state is judged when it comes to its turn, not when it is met: before that it is held to be as far as the one
//! before it, less the action in between. It may be met again at less cost, and is then looked at again, for the bound is
//! never too high, but need not fall in step with the costs. So what stands first in the queue is at any moment a bound on
//! all plans.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use crate::allowed::Allowed;
use crate::bits;
use crate::portfolio::relaxed::{State, carry_out, holds};
use crate::proof::cuts::Cuts;
use crate::strips::{FactId, OperatorId, Task};
use crate::{Limit, Limits};

/// What so much effort came to.
pub(super) enum Progress {
    /// Proven to cost least.
    Cheapest(Vec<OperatorId>),
    /// Proven: nothing costs less than what was known.
    NothingCheaper,
    /// Whatever costs less than what was known costs at least so much.
    AtLeast(u64),
}

struct Node {
    cost: u64,
    /// What is still to come at least, by itself once it was judged, else by the state before.
    ahead: u64,
    is_judged: bool,
    from: Option<(u32, OperatorId)>,
}

/// A search that can be gone on with.
pub(super) struct Search<'a> {
    task: &'a Task,
    goal: &'a [FactId],
    cuts: Cuts,
    allowed: Allowed,
    nodes: Vec<Node>,
    states: Vec<State>,
    numbers: HashMap<State, u32>,
    /// Least in all first, of these what has least ahead; with the cost at which it was met.
    open: BinaryHeap<Reverse<(u64, u64, u32, u64)>>,
    bytes: usize,
}

impl<'a> Search<'a> {
    pub(super) fn new(task: &'a Task, start: State, goal: &'a [FactId]) -> Self {
        let mut search = Self {
            task,
            goal,
            cuts: Cuts::towards(task, goal),
            allowed: Allowed::new(task),
            nodes: Vec::new(),
            states: Vec::new(),
            numbers: HashMap::new(),
            open: BinaryHeap::new(),
            bytes: 0,
        };
        search.meet(start, Node { cost: 0, ahead: 0, is_judged: false, from: None });
        search
    }

    /// What was looked at so far, in facts and operators.
    pub(super) fn effort(&self) -> u64 {
        self.cuts.effort + self.allowed.looked_at
    }

    fn meet(&mut self, state: State, node: Node) {
        let number = self.nodes.len() as u32;
        self.open.push(Reverse((node.cost + node.ahead, node.ahead, number, node.cost)));
        self.bytes += 2 * (state.len() * 8 + 16) + 128;
        self.numbers.insert(state.clone(), number);
        self.states.push(state);
        self.nodes.push(node);
    }

    /// Goes on until so much effort is spent in all. Only what costs less than `below` is sought, which may be less than
    /// it was, and never more.
    ///
    /// # Errors
    /// Time or memory is up; what was found out stays.
    pub(super) fn go_on(
        &mut self,
        below: u64,
        effort: u64,
        limits: &Limits,
    ) -> Result<Progress, Limit> {
        while let Some(&Reverse((sum, _, number, met_at))) = self.open.peek() {
            let (cost, is_judged) = {
                let node = &self.nodes[number as usize];
                (node.cost, node.is_judged)
            };
            if cost != met_at {
                self.open.pop();
                continue;
            }
            if sum >= below {
                return Ok(Progress::NothingCheaper);
            }
            if self.effort() >= effort {
                return Ok(Progress::AtLeast(sum));
            }
            limits.check(self.bytes)?;
            self.open.pop();
            let state = self.states[number as usize].clone();
            if !is_judged {
                // Out of reach from here.
                let Some(ahead) = self.cuts.at_least(self.task, bits::members(&state)) else {
                    continue;
                };
                let node = &mut self.nodes[number as usize];
                (node.ahead, node.is_judged) = (node.ahead.max(ahead), true);
                if cost + node.ahead > sum {
                    self.open.push(Reverse((cost + node.ahead, node.ahead, number, cost)));
                    continue;
                }
            }
            if self.goal.iter().all(|&fact| holds(&state, fact)) {
                return Ok(Progress::Cheapest(self.path(number)));
            }
            self.expand(number, &state, below);
        }
        Ok(Progress::NothingCheaper)
    }

    /// Proven of all that costs less than what was known.
    pub(super) fn at_least(&self) -> Option<u64> {
        self.open.peek().map(|Reverse((sum, ..))| *sum)
    }

    fn expand(&mut self, number: u32, state: &State, below: u64) {
        let (cost, ahead) = {
            let node = &self.nodes[number as usize];
            (node.cost, node.ahead)
        };
        for id in self.allowed.by(state) {
            let operator = self.task.operator(id);
            // What only takes away is of no use.
            if operator.add_effects.iter().all(|&fact| holds(state, fact)) {
                continue;
            }
            let price = u64::from(operator.cost);
            let (cost, ahead) = (cost + price, ahead.saturating_sub(price));
            if cost + ahead >= below {
                continue;
            }
            let mut next = state.clone();
            carry_out(self.task, &mut next, id);
            let from = Some((number, id));
            match self.numbers.get(&next) {
                None => self.meet(next, Node { cost, ahead, is_judged: false, from }),
                Some(&known) => {
                    let node = &mut self.nodes[known as usize];
                    if cost < node.cost {
                        node.cost = cost;
                        node.from = from;
                        self.open.push(Reverse((cost + node.ahead, node.ahead, known, cost)));
                    }
                }
            }
        }
    }

    fn path(&self, to: u32) -> Vec<OperatorId> {
        let mut path = Vec::new();
        let mut at = to;
        while let Some((from, by)) = self.nodes[at as usize].from {
            path.push(by);
            at = from;
        }
        path.reverse();
        path
    }
}
