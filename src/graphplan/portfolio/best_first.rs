//! Best-first search by two measures that take turns (S. Richter, M. Westphal, 2010).
//!
//! One is the length of a relaxed plan, the other counts landmarks ahead. With each, helpful operators have a queue of
//! their own that goes first while progress is made: those of the relaxed plan, and what brings the next landmarks. A
//! successor is looked at only when its turn comes, as each that is tried in vain costs an estimate.

use std::cmp::Reverse;
use std::collections::binary_heap::PeekMut;
use std::collections::{BinaryHeap, HashMap, HashSet};

use super::landmarks::{Attained, Landmarks};
use super::relaxed::{Estimate, Relaxed, State, carry_out};
use crate::allowed::Allowed;
use crate::bits;
use crate::strips::{OperatorId, Task};
use crate::{Limit, Limits};

/// Looks at states, and counts what that takes.
pub(super) struct Guide<'a> {
    pub(super) task: &'a Task,
    pub(super) limits: &'a Limits,
    pub(super) relaxed: Relaxed<'a>,
    pub(super) allowed: Allowed,
    pub(super) evaluated: u64,
}

impl Guide<'_> {
    pub(super) fn estimate(
        &mut self,
        state: &State,
        held_bytes: usize,
    ) -> Result<Option<Estimate>, Limit> {
        self.evaluated += 1;
        self.limits.check(held_bytes)?;
        Ok(self.relaxed.estimate(state))
    }

    fn is_over(&self, end: End) -> bool {
        self.evaluated >= end.evaluated || self.relaxed.effort >= end.effort
    }

    /// What a state allows: first operators of its relaxed plan and those that bring a landmark wanted next.
    fn successors(&mut self, state: &State, plan: &[OperatorId], wanted: &[u64]) -> Successors {
        let operators = self.allowed.by(state);
        let planned: HashSet<OperatorId> = plan.iter().copied().collect();
        let brings = |id: &OperatorId| {
            let mut adds = self.task.operator(*id).add_effects.iter();
            adds.any(|fact| bits::has(wanted, fact.index()))
        };
        let (helpful, others): (Vec<OperatorId>, Vec<OperatorId>) =
            operators.iter().partition(|id| planned.contains(id) || brings(id));
        let count = helpful.len();
        Successors { operators: [helpful, others].concat().into(), helpful: count }
    }
}

/// Where a search ends for the time being: by states looked at, and by what looking at relaxed plans took, both since
/// the guide began.
#[derive(Clone, Copy)]
pub(super) struct End {
    pub(super) evaluated: u64,
    pub(super) effort: u64,
}

/// What a search has come to.
pub(super) enum Come {
    /// To its end, which is told, by a way.
    To(Vec<OperatorId>, Stage),
    /// Nowhere else can be come to.
    Exhausted,
    /// It can go on from here.
    Over,
}

/// A search, as far as it has come.
pub(super) struct BestFirst<'l> {
    landmarks: Option<&'l Landmarks>,
    /// Fewer landmarks ahead than this are the end; at none only the goal is.
    nearer: u32,
    seen: Seen,
    queues: Queues,
    /// A state that was not looked at yet, and where it was come to from.
    next: Option<(Stage, Option<(u32, OperatorId)>)>,
}

impl<'l> BestFirst<'l> {
    /// To the goal.
    pub(super) fn new(state: State, landmarks: Option<&'l Landmarks>) -> Self {
        let attained = landmarks.map(|all| all.initially(&state)).unwrap_or_default();
        let queues = Queues::new(if landmarks.is_some() { 2 } else { 1 });
        let next = Some((Stage { state, attained }, None));
        Self { landmarks, nearer: 0, seen: Seen::default(), queues, next }
    }

    /// To the goal, or only to where fewer landmarks are ahead than at first.
    pub(super) fn nearer(start: Stage, landmarks: &'l Landmarks) -> Self {
        let nearer = landmarks.ahead(&start.attained, &start.state);
        let queues = Queues::new(2);
        let next = Some((start, None));
        Self { landmarks: Some(landmarks), nearer, seen: Seen::default(), queues, next }
    }

    pub(super) fn go_on(&mut self, guide: &mut Guide<'_>, end: End) -> Result<Come, Limit> {
        loop {
            if let Some((stage, from)) = self.next.take()
                && let Some(number) = self.seen.add(&stage, from)
            {
                let bytes = self.seen.bytes + self.queues.bytes;
                if let Some(estimate) = guide.estimate(&stage.state, bytes)? {
                    let ahead =
                        self.landmarks.map_or(0, |all| all.ahead(&stage.attained, &stage.state));
                    if estimate.distance == 0 || ahead < self.nearer {
                        return Ok(Come::To(self.seen.path(number), stage));
                    }
                    let wanted = match self.landmarks {
                        Some(all) => all.next(&stage.attained, &stage.state),
                        None => vec![0; stage.state.len()].into(),
                    };
                    let successors =
                        guide.successors(&stage.state, &estimate.relaxed_plan, &wanted);
                    self.queues.push([estimate.distance, ahead], number, successors);
                }
            }
            if guide.is_over(end) {
                return Ok(Come::Over);
            }
            let Some((from, by)) = self.queues.pop() else { return Ok(Come::Exhausted) };
            let mut stage = self.seen.stages[from as usize].clone();
            carry_out(guide.task, &mut stage.state, by);
            if let Some(landmarks) = self.landmarks {
                stage.attained = landmarks.advance(&stage.attained, &stage.state);
            }
            self.next = Some((stage, Some((from, by))));
        }
    }
}

/// A state, and which landmarks were attained on the way to it.
#[derive(Clone)]
pub(super) struct Stage {
    pub(super) state: State,
    pub(super) attained: Attained,
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
    /// Least value first, of these the oldest state; and which of its successors is next. Not the least by the other
    /// measure: where both agree on the order, none finds the way round what the other sees as the way.
    heap: BinaryHeap<Reverse<(u32, u32, u32)>>,
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
            queue.heap.push(Reverse((values[queue.measure], number, 0)));
        }
    }

    /// The state whose turn it is, and the operator.
    fn pop(&mut self) -> Option<(u32, OperatorId)> {
        loop {
            let open = self.queues.iter_mut().filter(|queue| !queue.heap.is_empty());
            let queue = open.min_by_key(|queue| queue.turn)?;
            queue.turn += 1;
            let mut first = queue.heap.peek_mut()?;
            let Reverse((_, number, at)) = *first;
            let Successors { operators, helpful } = &self.successors[number as usize];
            let own = if queue.helpful { &operators[..*helpful] } else { operators };
            if let Some(&id) = own.get(at as usize) {
                first.0.2 = at + 1;
                return Some((number, id));
            }
            PeekMut::pop(first);
        }
    }
}

/// States met, each with the state that it was come to from, and by which operator.
#[derive(Default)]
struct Seen {
    numbers: HashMap<State, u32>,
    stages: Vec<Stage>,
    from: Vec<Option<(u32, OperatorId)>>,
    bytes: usize,
}

impl Seen {
    /// The number of a state not met before.
    fn add(&mut self, stage: &Stage, from: Option<(u32, OperatorId)>) -> Option<u32> {
        let number = self.stages.len() as u32;
        if self.numbers.contains_key(&stage.state) {
            return None;
        }
        let words = 2 * stage.state.len() + stage.attained.len();
        self.bytes += words * 8 + 150;
        self.numbers.insert(stage.state.clone(), number);
        self.stages.push(stage.clone());
        self.from.push(from);
        Some(number)
    }

    fn path(&self, to: u32) -> Vec<OperatorId> {
        let mut path = Vec::new();
        let mut at = to;
        while let Some((before, by)) = self.from[at as usize] {
            path.push(by);
            at = before;
        }
        path.reverse();
        path
    }
}
