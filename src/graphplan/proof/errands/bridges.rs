//! What a walk must cross, bridge by bridge.
//!
//! A *bridge* is a way that alone joins what lies beyond it to where the walk begins: a door of a room, a stretch of a
//! corridor that is no ring. Each move across it carries one thing at most, so it is crossed once each way for every
//! thing that must come over, and at least once if anything is to be done beyond; ways in and out alternate. In a house
//! whose ways are a tree this bound misses nothing but that things put down on the way must be taken up again
//! (G. Frederickson, D. Guan, 1993, "nonpreemptive ensemble motion planning on a tree").
//!
//! If no move across can be made at first, something must be done on the near side before the first of them: a door is
//! opened. That takes a step of its own wherever nothing else must be done.

use std::collections::{BTreeMap, BTreeSet};

use super::groups::{Group, excludes};
use super::{Errand, Places, bringers};
use crate::strips::{FactId, OperatorId, Task};
use crate::units::Gather as _;

pub(super) struct Bridges {
    /// The place that stands for all that are one with a place.
    one: Vec<usize>,
    /// When each place is first come to, depth first, and when all that is come to through it was.
    first: Vec<usize>,
    last: Vec<usize>,
    /// Places in that order, each with the one that it is come to from.
    order: Vec<(usize, usize)>,
    /// Near and far end of each bridge.
    bridges: Vec<(usize, usize)>,
}

impl Bridges {
    pub(super) fn of(places: &Places) -> Self {
        let count = places.ways.len();
        let one = representatives(&places.free);
        let mut beside: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
        for (from, ways) in places.ways.iter().enumerate() {
            for &to in ways {
                let (a, b) = (one[from], one[to]);
                if a != b {
                    beside[a].insert(b);
                    beside[b].insert(a);
                }
            }
        }
        let beside: Vec<Vec<usize>> =
            beside.into_iter().map(|all| all.into_iter().collect()).collect();
        let never = usize::MAX;
        let (mut first, mut last, mut low) = (vec![never; count], vec![0; count], vec![0; count]);
        let mut bridges = Vec::new();
        let start = one[places.start];
        // Depth first (R. Tarjan, 1974): the place, the one before, and which neighbour is next.
        let mut open = vec![(start, never, 0)];
        let mut order = Vec::new();
        first[start] = 0;
        while let Some(&mut (place, before, ref mut next)) = open.last_mut() {
            if let Some(&other) = beside[place].get(*next) {
                *next += 1;
                if first[other] == never {
                    order.push((other, place));
                    (first[other], low[other]) = (order.len(), order.len());
                    open.push((other, place, 0));
                } else if other != before {
                    low[place] = low[place].min(first[other]);
                }
                continue;
            }
            last[place] = order.len() + 1;
            open.pop();
            if before != never {
                low[before] = low[before].min(low[place]);
                if low[place] > first[before] {
                    bridges.push((before, place));
                }
            }
        }
        Self { one, first, last, order, bridges }
    }

    fn is_beyond(&self, far: usize, place: usize) -> bool {
        let place = self.first[self.one[place]];
        self.first[far] <= place && place < self.last[far]
    }

    /// Moves that no walk does without: `carried` are brought from place to place, `visited` are come to.
    pub(super) fn moves(
        &self,
        distance: &[Vec<usize>],
        (points, carried, visited): (&[usize], &[Errand], &[usize]),
    ) -> usize {
        // Moves with a thing in the hand that cross no bridge.
        let mut within: usize = carried.iter().map(|e| distance[e.from][e.to]).sum();
        let mut sum = 0;
        // By the far end of a bridge, what it costs more, or less, to end beyond it.
        let mut beyond_it: BTreeMap<usize, i64> = BTreeMap::new();
        for &(_, far) in &self.bridges {
            let beyond = |point: usize| self.is_beyond(far, points[point]);
            let (mut into, mut out) = (0, 0);
            for errand in carried {
                match (beyond(errand.from), beyond(errand.to)) {
                    (false, true) => into += 1,
                    (true, false) => out += 1,
                    _ => {}
                }
            }
            within -= into + out;
            let is_needed = carried.iter().any(|e| beyond(e.from) || beyond(e.to))
                || visited.iter().any(|&point| beyond(point));
            let back = 2 * into.max(out).max(usize::from(is_needed));
            let there = 2 * into.max(out + 1) - 1;
            sum += back;
            beyond_it.insert(far, there as i64 - back as i64);
        }
        let mut ends = vec![0; self.one.len()];
        let mut best = 0;
        for &(place, before) in &self.order {
            ends[place] = ends[before] + beyond_it.get(&place).copied().unwrap_or(0);
            best = ends[place].min(best);
        }
        (sum as i64 + best) as usize + within
    }

    /// Steps in which something is done so that a bridge can be crossed at all, and nothing else that must be done.
    pub(super) fn enabling_steps(
        &self,
        (task, groups): (&Task, &[Group]),
        places: &Places,
        (needed, busy): (&[usize], &BTreeSet<usize>),
    ) -> usize {
        let busy: BTreeSet<usize> = busy.iter().map(|&place| self.one[place]).gather();
        let mut across: BTreeMap<(usize, usize), Vec<OperatorId>> = BTreeMap::new();
        for &(id, from, to) in &places.made {
            across.entry((self.one[from], self.one[to])).or_default().push(id);
        }
        let moves: Vec<OperatorId> = places.moves.iter().copied().collect();
        let mut done_at = BTreeSet::new();
        for &(near, far) in &self.bridges {
            if !needed.iter().any(|&place| self.is_beyond(far, place)) {
                continue;
            }
            let Some(ways) = across.get(&(near, far)) else { continue };
            let lacking = |&id: &OperatorId| -> Option<FactId> {
                let mut needs = task.operator(id).preconditions.iter().copied();
                needs.find(|fact| !places.walker.contains(fact) && !task.init.contains(fact))
            };
            let Some(lacks) = ways.iter().map(lacking).collect::<Option<BTreeSet<FactId>>>() else {
                continue;
            };
            let enablers: Vec<OperatorId> =
                lacks.into_iter().flat_map(|fact| bringers(task, fact)).collect();
            let at = places.spot(task, &enablers).unwrap_or_default();
            let at: BTreeSet<usize> = at
                .into_iter()
                .filter(|&place| !self.is_beyond(far, place))
                .map(|place| self.one[place])
                .gather();
            let (Some(&only), 1) = (at.first(), at.len()) else { continue };
            if !busy.contains(&only)
                && !enablers.iter().any(|id| places.moves.contains(id))
                && excludes(task, groups, &enablers, &moves)
            {
                done_at.insert(only);
            }
        }
        done_at.len()
    }
}

/// For each node the least of those that it is joined to.
fn representatives(joined: &[Vec<usize>]) -> Vec<usize> {
    let mut one = vec![usize::MAX; joined.len()];
    for least in 0..joined.len() {
        if one[least] != usize::MAX {
            continue;
        }
        one[least] = least;
        let mut open = vec![least];
        while let Some(node) = open.pop() {
            for &other in &joined[node] {
                if one[other] == usize::MAX {
                    one[other] = least;
                    open.push(other);
                }
            }
        }
    }
    one
}
