//! Best-first search by two measures that take turns (S. Richter, M. Westphal, 2010).
//!
//! One is the length of a relaxed plan, the other counts landmarks ahead. With each, helpful operators have a queue of
//! their own that goes first while progress is made: those of the relaxed plan, and what brings the next landmarks. A
//! successor is looked at only when its turn comes, as each that is tried in vain costs an estimate. Where what was done
//! so far weighs as well, a state that is come to by a shorter way is opened again.

use std::cmp::Reverse;
use std::collections::binary_heap::PeekMut;
use std::collections::{BinaryHeap, HashMap, HashSet};

use super::landmarks::{Attained, Landmarks};
use super::relaxed::{Estimate, Relaxed, State, carry_out, holds};
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
        Successors { operators: [helpful, others].concat().into(), helpful: count, ahead: [0; 2] }
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
    /// How much what is to come weighs against what was done so far; only the first counts where there is none.
    weight: Option<u32>,
    /// Only a way of fewer operators is wanted.
    fewer_than: u32,
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
        let (weight, fewer_than) = (None, u32::MAX);
        Self { landmarks, nearer: 0, weight, fewer_than, seen: Seen::default(), queues, next }
    }

    /// To the goal by fewer operators than so many; what is to come weighs so much against what was done so far. It may
    /// go on after a way was found, to one of fewer operators still, and misses none.
    pub(super) fn weighted(
        state: State,
        landmarks: Option<&'l Landmarks>,
        weight: u32,
        fewer_than: usize,
    ) -> Self {
        let mut search = Self { weight: Some(weight), ..Self::new(state, landmarks) };
        search.want(fewer_than);
        search
    }

    /// From now on only a way of fewer operators than these is wanted.
    pub(super) fn want(&mut self, fewer_than: usize) {
        self.fewer_than = u32::try_from(fewer_than).unwrap_or(u32::MAX);
        self.next = self.next.take().filter(|(_, from)| self.seen.after(*from) < self.fewer_than);
    }

    /// To the goal, or only to where fewer landmarks are ahead than at first.
    pub(super) fn nearer(start: Stage, landmarks: &'l Landmarks) -> Self {
        let nearer = landmarks.ahead(&start.attained, &start.state);
        let queues = Queues::new(2);
        let next = Some((start, None));
        Self {
            landmarks: Some(landmarks),
            nearer,
            weight: None,
            fewer_than: u32::MAX,
            seen: Seen::default(),
            queues,
            next,
        }
    }

    pub(super) fn go_on(&mut self, guide: &mut Guide<'_>, end: End) -> Result<Come, Limit> {
        loop {
            if let Some((stage, from)) = self.next.take() {
                match self.seen.add(&stage, from, self.weight.is_some()) {
                    Met::First(number) => {
                        let bytes = self.seen.bytes + self.queues.bytes;
                        if let Some(estimate) = guide.estimate(&stage.state, bytes)? {
                            let attained = &stage.attained;
                            let ahead =
                                self.landmarks.map_or(0, |l| l.ahead(attained, &stage.state));
                            if estimate.distance == 0 || ahead < self.nearer {
                                return Ok(Come::To(self.seen.path(number), stage));
                            }
                            let wanted = match self.landmarks {
                                Some(all) => all.next(attained, &stage.state),
                                None => vec![0; stage.state.len()].into(),
                            };
                            let successors =
                                guide.successors(&stage.state, &estimate.relaxed_plan, &wanted);
                            self.queues.add([estimate.distance, ahead], number, successors);
                            self.open(number);
                        }
                    }
                    Met::Sooner(number) => {
                        if guide.task.goal.iter().all(|&goal| holds(&stage.state, goal)) {
                            return Ok(Come::To(self.seen.path(number), stage));
                        }
                        self.open(number);
                    }
                    Met::Again => {}
                }
            }
            if guide.is_over(end) {
                return Ok(Come::Over);
            }
            let Some((from, by)) = self.queues.pop() else { return Ok(Come::Exhausted) };
            // What leads nowhere takes time as well.
            guide.relaxed.effort += 1;
            if self.seen.after(Some((from, by))) >= self.fewer_than {
                continue;
            }
            let mut stage = self.seen.stages[from as usize].clone();
            carry_out(guide.task, &mut stage.state, by);
            if let Some(landmarks) = self.landmarks {
                stage.attained = landmarks.advance(&stage.attained, &stage.state);
            }
            self.next = Some((stage, Some((from, by))));
        }
    }

    fn open(&mut self, number: u32) {
        self.queues
            .open(number, self.weight.map(|weight| (self.seen.done[number as usize], weight)));
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
    /// What is to come, by each measure.
    ahead: [u32; 2],
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

    /// What a state allows. Progress in some measure lets helpful operators go first for a while.
    fn add(&mut self, ahead: [u32; 2], number: u32, successors: Successors) {
        for (least, value) in self.least.iter_mut().zip(ahead) {
            if value < *least {
                *least = value;
                let helpful = self.queues.iter_mut().filter(|queue| queue.helpful);
                helpful.for_each(|queue| queue.turn -= BOOST);
            }
        }
        self.bytes += successors.operators.len() * 4 + 48;
        self.successors.resize_with(number as usize, Successors::default);
        self.successors.push(Successors { ahead, ..successors });
    }

    /// A state's successors wait for their turn, by what is to come, or by that and what was done together.
    fn open(&mut self, number: u32, done_and_weight: Option<(u32, u32)>) {
        let Some(successors) = self.successors.get(number as usize) else { return };
        // A heap doubles when it grows.
        self.bytes += self.queues.len() * 24;
        for queue in &mut self.queues {
            let ahead = successors.ahead[queue.measure];
            let value = match done_and_weight {
                Some((done, weight)) => ahead.saturating_mul(weight).saturating_add(done),
                None => ahead,
            };
            queue.heap.push(Reverse((value, number, 0)));
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
            let Successors { operators, helpful, .. } = &self.successors[number as usize];
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
    /// Operators on the way to it.
    done: Vec<u32>,
    bytes: usize,
}

/// How a state is met.
enum Met {
    /// For the first time; its number.
    First(u32),
    /// Once more, by a shorter way.
    Sooner(u32),
    Again,
}

impl Seen {
    /// Notes a state; a shorter way to one that was met takes the place of the longer where that is asked for.
    fn add(&mut self, stage: &Stage, from: Option<(u32, OperatorId)>, sooner: bool) -> Met {
        let done = self.after(from);
        if let Some(&number) = self.numbers.get(&stage.state) {
            let known = number as usize;
            if !sooner || self.done[known] <= done {
                return Met::Again;
            }
            (self.done[known], self.from[known]) = (done, from);
            return Met::Sooner(number);
        }
        let number = self.stages.len() as u32;
        let words = 2 * stage.state.len() + stage.attained.len();
        self.bytes += words * 8 + 154;
        self.numbers.insert(stage.state.clone(), number);
        self.stages.push(stage.clone());
        self.from.push(from);
        self.done.push(done);
        Met::First(number)
    }

    /// How many operators lead to what is come to from there.
    fn after(&self, from: Option<(u32, OperatorId)>) -> u32 {
        from.map_or(0, |(from, _)| self.done[from as usize] + 1)
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
