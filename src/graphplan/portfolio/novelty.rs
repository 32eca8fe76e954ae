//! Best-first width search (N. Lipovetzky, H. Geffner, 2017): states that show something new go first.
//!
//! A state is *new* when some fact holds in it, or else some pair of facts, that held in no state met before with as
//! much still ahead and as much of a relaxed plan brought about. Of states equally new those go first that have less
//! ahead. No relaxed plan is made for each state, as in [`super::any`], only where less is ahead than before: so many
//! more states are looked at in the same time, and plateaus on which all relaxed plans are of one length are crossed.
//! Nothing is left out for being old, so the search misses nothing.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

use super::landmarks::{Attained, Landmarks};
use super::relaxed::{Relaxed, State, carry_out, holds, initial};
use crate::allowed::Allowed;
use crate::bits;
use crate::strips::{FactId, OperatorId, Task};
use crate::{Limit, Limits};

/// What the search came to.
pub(crate) enum Searched {
    Path(Vec<OperatorId>),
    /// Every state that can be reached was seen.
    Exhausted,
    /// The effort allowed was not enough.
    Open,
}

/// Looks at so many states at most.
pub(crate) fn search(
    task: &Task,
    relaxed: &mut Relaxed<'_>,
    landmarks: Option<&Landmarks>,
    states: usize,
    limits: &Limits,
) -> Result<Searched, Limit> {
    let initial = initial(task);
    let mut search = Width {
        task,
        landmarks,
        allowed: Allowed::new(task),
        novelty: Novelty::new(task.facts.len(), limits.memory_bytes / PART_FOR_PAIRS),
        seen: HashSet::new(),
        nodes: Vec::new(),
        anchors: Vec::new(),
        queue: BinaryHeap::new(),
        bytes: 0,
    };
    search.run(initial, relaxed, states, limits)
}

/// Tables of pairs take this part of the memory at most.
const PART_FOR_PAIRS: usize = 4;

/// A state met, and how it was come to.
struct Node {
    state: State,
    attained: Attained,
    from: Option<(u32, OperatorId)>,
    /// Landmarks, or else goals, that are still ahead.
    ahead: u32,
    /// The last state before, or this one, that had less ahead than all on the way to it.
    anchor: u32,
    /// Which facts of the anchor's relaxed plan were brought about since.
    met: Box<[u64]>,
}

struct Width<'a> {
    task: &'a Task,
    landmarks: Option<&'a Landmarks>,
    allowed: Allowed,
    novelty: Novelty,
    seen: HashSet<State>,
    nodes: Vec<Node>,
    /// Facts that the relaxed plan of a state brings about.
    anchors: Vec<Box<[FactId]>>,
    /// The newest first, of these that with the least ahead, of these the oldest.
    queue: BinaryHeap<Reverse<(u8, u32, u32)>>,
    bytes: usize,
}

impl Width<'_> {
    fn run(
        &mut self,
        initial: State,
        relaxed: &mut Relaxed<'_>,
        states: usize,
        limits: &Limits,
    ) -> Result<Searched, Limit> {
        let attained = self.landmarks.map(|all| all.initially(&initial)).unwrap_or_default();
        if self.is_goal(&initial) {
            return Ok(Searched::Path(Vec::new()));
        }
        self.add(initial, attained, None, relaxed);
        while let Some(Reverse((_, _, number))) = self.queue.pop() {
            for id in self.allowed.by(&self.nodes[number as usize].state) {
                let next = self.after(number, id);
                if self.seen.contains(&next) {
                    continue;
                }
                if self.is_goal(&next) {
                    return Ok(Searched::Path(self.path(number, id)));
                }
                let attained = &self.nodes[number as usize].attained;
                let attained =
                    self.landmarks.map(|all| all.advance(attained, &next)).unwrap_or_default();
                self.add(next, attained, Some((number, id)), relaxed);
                if self.seen.len() >= states {
                    return Ok(Searched::Open);
                }
                if self.seen.len().is_multiple_of(64) {
                    limits.check(self.bytes + self.novelty.bytes)?;
                }
            }
        }
        Ok(Searched::Exhausted)
    }

    fn is_goal(&self, state: &State) -> bool {
        self.task.goal.iter().all(|&goal| holds(state, goal))
    }

    fn after(&self, number: u32, id: OperatorId) -> State {
        let mut state = self.nodes[number as usize].state.clone();
        carry_out(self.task, &mut state, id);
        state
    }

    fn path(&self, mut number: u32, last: OperatorId) -> Vec<OperatorId> {
        let mut path = vec![last];
        while let Some((before, by)) = self.nodes[number as usize].from {
            path.push(by);
            number = before;
        }
        path.reverse();
        path
    }

    /// A state waits for its turn, unless the goal is out of its reach even without delete effects.
    fn add(
        &mut self,
        state: State,
        attained: Attained,
        from: Option<(u32, OperatorId)>,
        relaxed: &mut Relaxed<'_>,
    ) {
        self.bytes += 2 * state.len() * 8 + attained.len() * 8 + 160;
        self.seen.insert(state.clone());
        let goals = || self.task.goal.iter().filter(|&&goal| !holds(&state, goal)).count() as u32;
        let ahead = self.landmarks.map_or_else(goals, |all| all.ahead(&attained, &state));
        let before = from.map(|(number, _)| &self.nodes[number as usize]);
        let (anchor, met) = match before {
            Some(before) if before.ahead <= ahead => {
                let mut met = before.met.clone();
                for (at, &fact) in self.anchors[before.anchor as usize].iter().enumerate() {
                    if holds(&state, fact) {
                        bits::put(&mut met, at);
                    }
                }
                (before.anchor, met)
            }
            _ => {
                let Some(estimate) = relaxed.estimate(&state) else { return };
                let adds = |&id: &OperatorId| &self.task.operator(id).add_effects;
                let mut facts: Vec<FactId> =
                    estimate.relaxed_plan.iter().flat_map(adds).copied().collect();
                facts.retain(|&fact| !holds(&state, fact));
                facts.sort_unstable();
                facts.dedup();
                let met = vec![0; bits::words(facts.len())].into();
                self.bytes += facts.len() * 4;
                self.anchors.push(facts.into());
                (self.anchors.len() as u32 - 1, met)
            }
        };
        let brought = met.iter().map(|word| word.count_ones()).sum();
        let class = self.novelty.class((ahead, brought), &state);
        let number = self.nodes.len() as u32;
        self.bytes += met.len() * 8;
        self.nodes.push(Node { state, attained, from, ahead, anchor, met });
        self.queue.push(Reverse((class, ahead, number)));
    }
}

/// Which facts, and which pairs of facts, held in states of a kind.
struct Novelty {
    words: usize,
    facts: HashMap<(u32, u32), Box<[u64]>>,
    pairs: HashMap<(u32, u32), Box<[u64]>>,
    bytes: usize,
    bytes_of_pairs: usize,
    most_bytes: usize,
}

impl Novelty {
    fn new(facts: usize, most_bytes: usize) -> Self {
        Self {
            words: bits::words(facts),
            facts: HashMap::new(),
            pairs: HashMap::new(),
            bytes: 0,
            bytes_of_pairs: facts * bits::words(facts) * 8,
            most_bytes,
        }
    }

    /// Nothing for a new fact, one for a new pair, two for neither, or where pairs are too many to be kept.
    fn class(&mut self, kind: (u32, u32), state: &State) -> u8 {
        let words = self.words;
        let known = self.facts.entry(kind).or_insert_with(|| {
            self.bytes += words * 8;
            vec![0; words].into()
        });
        let new_fact = widen(known, state);
        if !self.pairs.contains_key(&kind) {
            if self.bytes + self.bytes_of_pairs > self.most_bytes {
                return if new_fact { 0 } else { 2 };
            }
            self.bytes += self.bytes_of_pairs;
            self.pairs.insert(kind, vec![0; self.bytes_of_pairs / 8].into());
        }
        let rows = self.pairs.get_mut(&kind).expect("it was just put there");
        let mut new_pair = false;
        for fact in bits::members(state) {
            new_pair |= widen(&mut rows[fact * words..][..words], state);
        }
        match (new_fact, new_pair) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        }
    }
}

/// Adds what a state holds; whether any of it is new.
fn widen(known: &mut [u64], state: &State) -> bool {
    let mut new = false;
    for (known, &word) in known.iter_mut().zip(state) {
        new |= word & !*known != 0;
        *known |= word;
    }
    new
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::random_task;
    use crate::tests::fewest_steps;
    use crate::{Plan, validate};

    #[test]
    fn nothing_is_missed() {
        let (mut found, mut none) = (0, 0);
        for seed in 1..=3000 {
            let task = random_task(seed);
            let mut relaxed = Relaxed::new(&task);
            // Landmarks and goals take turns.
            let landmarks = Landmarks::of(&task).filter(|_| seed % 2 == 0);
            let limits = Limits::default();
            let searched =
                search(&task, &mut relaxed, landmarks.as_ref(), usize::MAX, &limits).unwrap();
            match searched {
                Searched::Path(path) => {
                    let plan = Plan { steps: path.into_iter().map(|id| vec![id]).collect() };
                    assert_eq!(validate(&task, &plan), Ok(()), "seed {seed}");
                    found += 1;
                }
                Searched::Exhausted => {
                    assert_eq!(fewest_steps(&task), None, "seed {seed}");
                    none += 1;
                }
                Searched::Open => panic!("seed {seed}: no effort was set"),
            }
        }
        assert!(found > 500 && none > 500, "{found} {none}");
    }
}
