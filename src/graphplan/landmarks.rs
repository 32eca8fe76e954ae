//! Facts that every plan makes true at some time, and how many of them are still ahead (J. Hoffmann, J. Porteous,
//! L. Sebastia, 2004; counted as by S. Richter, M. Westphal, 2010).
//!
//! A fact is a landmark of another when without delete effects there is no way to the other but through it; that is
//! a fixpoint of sets (L. Zhu, R. Givan, 2003). Orders tell when having a landmark counts: what all first ways to it
//! need comes before it, and of two goals that one whose attainment would undo the other. A tower built on the wrong
//! base therefore counts for nothing, where a relaxed plan would praise it.

use std::collections::{BTreeMap, VecDeque};

use super::bits::{has, members, put, unite, words};
use super::relaxed::{State, holds};
use crate::strips::{FactId, Task};

/// More facts than these make the sets too large.
const MOST_FACTS: usize = 1 << 13;
/// More goals than these are not ordered pair by pair.
const MOST_GOALS: usize = 512;

/// Landmarks attained so far, as bits.
pub(super) type Attained = Box<[u64]>;

pub(super) struct Landmarks {
    facts: Vec<FactId>,
    is_goal: Vec<bool>,
    /// Which landmarks must have been attained before one counts.
    before: Vec<Vec<u32>>,
    /// Landmarks that directly need one.
    needed_by: Vec<Vec<u32>>,
    /// The goals, none before another that it would be undone for.
    in_order: Vec<FactId>,
}

impl Landmarks {
    /// None when there are too many facts, or the goal is out of reach.
    pub(super) fn of(task: &Task) -> Option<Self> {
        if task.facts.len() > MOST_FACTS {
            return None;
        }
        let sets = Sets::new(task);
        let mut all = vec![0; sets.words];
        for goal in &task.goal {
            let of_goal = sets.of_fact[goal.index()].as_ref()?;
            unite(&mut all, of_goal);
        }
        let facts: Vec<FactId> = members(&all).map(|fact| FactId(fact as u32)).collect();
        let mut number = vec![None; task.facts.len()];
        for (n, fact) in facts.iter().enumerate() {
            number[fact.index()] = Some(n as u32);
        }
        let mut first = vec![false; task.facts.len()];
        task.init.iter().for_each(|fact| first[fact.index()] = true);
        let ways: Vec<Ways> =
            facts.iter().map(|&f| sets.first_ways(task, f, first[f.index()])).collect();
        let mut needs: Vec<Vec<u32>> = vec![Vec::new(); facts.len()];
        let mut needed_by: Vec<Vec<u32>> = vec![Vec::new(); facts.len()];
        for n in (0..facts.len()).filter(|&n| !first[facts[n].index()]) {
            for need in &ways[n].needs {
                if let Some(need) = number[need.index()] {
                    needs[n].push(need);
                    needed_by[need as usize].push(n as u32);
                }
            }
        }
        let goals: Vec<u32> = task.goal.iter().filter_map(|goal| number[goal.index()]).collect();
        let mut is_goal = vec![false; facts.len()];
        goals.iter().for_each(|&goal| is_goal[goal as usize] = true);
        let mut landmarks = Self { facts, is_goal, before: needs, needed_by, in_order: Vec::new() };
        let direct = landmarks.before.clone();
        let undoing = landmarks.undoing(&ways, &goals, &direct);
        landmarks.in_order =
            in_order(&goals, &undoing).map(|goal| landmarks.facts[goal as usize]).collect();
        for (later, earlier) in undoing {
            landmarks.before[later as usize].push(earlier);
        }
        Some(landmarks)
    }

    /// The goals, none before another that it would be undone for.
    pub(super) fn goals_in_order(&self) -> &[FactId] {
        &self.in_order
    }

    /// Pairs of goals of which the first would be undone for the second; no cycles.
    fn undoing(&self, ways: &[Ways], goals: &[u32], needs: &[Vec<u32>]) -> Vec<(u32, u32)> {
        if goals.len() > MOST_GOALS {
            return Vec::new();
        }
        let mut after: Vec<Vec<usize>> = vec![Vec::new(); goals.len()];
        let mut pairs = Vec::new();
        for later in 0..goals.len() {
            for earlier in (0..goals.len()).filter(|&earlier| earlier != later) {
                let undoes = self.undoes(ways, needs, goals[later], goals[earlier]);
                if undoes && !leads_to(&after, later, earlier) {
                    after[earlier].push(later);
                    pairs.push((goals[later], goals[earlier]));
                }
            }
        }
        pairs
    }

    /// Whether a goal would be undone on the way to another that is attained after it: the other's last ways need
    /// what every way to the goal deletes, be it through facts that cannot hold beside the goal.
    fn undoes(&self, ways: &[Ways], needs: &[Vec<u32>], goal: u32, other: u32) -> bool {
        let goal = &ways[goal as usize];
        let mut open = vec![other];
        let mut seen = vec![other];
        while let Some(landmark) = open.pop() {
            for &need in &needs[landmark as usize] {
                if goal.deletes.binary_search(&self.facts[need as usize]).is_ok() {
                    return true;
                }
                let takes = &ways[need as usize].deletes;
                let apart = takes.iter().any(|fact| goal.needs.binary_search(fact).is_ok());
                if apart && !seen.contains(&need) {
                    seen.push(need);
                    open.push(need);
                }
            }
        }
        false
    }

    /// What counts as attained at first.
    pub(super) fn initially(&self, state: &State) -> Attained {
        let mut attained = vec![0; words(self.facts.len())].into_boxed_slice();
        for (n, &fact) in self.facts.iter().enumerate() {
            if holds(state, fact) && self.before[n].is_empty() {
                put(&mut attained, n);
            }
        }
        attained
    }

    /// What counts as attained once a state is come to.
    pub(super) fn advance(&self, attained: &Attained, state: &State) -> Attained {
        let mut next = attained.clone();
        for (n, &fact) in self.facts.iter().enumerate() {
            let counts = !has(attained, n)
                && holds(state, fact)
                && self.before[n].iter().all(|&before| has(attained, before as usize));
            if counts {
                put(&mut next, n);
            }
        }
        next
    }

    /// How many landmarks are ahead: not attained, or lost and needed once more.
    pub(super) fn ahead(&self, attained: &Attained, state: &State) -> u32 {
        let is_ahead = |n: usize, fact: FactId| {
            let again = || {
                self.is_goal[n] || self.needed_by[n].iter().any(|&by| !has(attained, by as usize))
            };
            !has(attained, n) || !holds(state, fact) && again()
        };
        self.facts.iter().enumerate().filter(|&(n, &fact)| is_ahead(n, fact)).count() as u32
    }
}

/// Goals by the longest chain of pairs that ends with them; the pairs have no cycles.
fn in_order(goals: &[u32], pairs: &[(u32, u32)]) -> impl Iterator<Item = u32> + use<> {
    let mut rank: BTreeMap<u32, usize> = goals.iter().map(|&goal| (goal, 0)).collect();
    loop {
        let before = rank.clone();
        for (later, earlier) in pairs {
            let least = rank[earlier] + 1;
            rank.entry(*later).and_modify(|rank| *rank = least.max(*rank));
        }
        if rank == before {
            break;
        }
    }
    let mut ordered: Vec<(usize, u32)> =
        rank.into_iter().map(|(goal, rank)| (rank, goal)).collect();
    ordered.sort_unstable();
    ordered.into_iter().map(|(_, goal)| goal)
}

/// Whether one node of a graph is reached from another.
fn leads_to(after: &[Vec<usize>], from: usize, to: usize) -> bool {
    let mut seen = vec![false; after.len()];
    let mut open = vec![from];
    while let Some(node) = open.pop() {
        if node == to {
            return true;
        }
        if !std::mem::replace(&mut seen[node], true) {
            open.extend(&after[node]);
        }
    }
    false
}

/// What all operators have in common that may add a fact for the first time.
struct Ways {
    needs: Vec<FactId>,
    deletes: Vec<FactId>,
}

fn common<'a>(mut lists: impl Iterator<Item = &'a [FactId]>) -> Vec<FactId> {
    let mut common = lists.next().unwrap_or_default().to_vec();
    lists.for_each(|list| common.retain(|fact| list.binary_search(fact).is_ok()));
    common
}

/// For each fact its landmarks, itself among them.
struct Sets {
    words: usize,
    of_fact: Vec<Option<Box<[u64]>>>,
    added_by: Vec<Vec<u32>>,
}

impl Sets {
    fn new(task: &Task) -> Self {
        let words = words(task.facts.len());
        let mut added_by = vec![Vec::new(); task.facts.len()];
        let mut needed_by = vec![Vec::new(); task.facts.len()];
        for (number, operator) in task.operators.iter().enumerate() {
            operator.add_effects.iter().for_each(|f| added_by[f.index()].push(number as u32));
            operator.preconditions.iter().for_each(|f| needed_by[f.index()].push(number as u32));
        }
        let mut sets = Self { words, of_fact: vec![None; task.facts.len()], added_by };
        for &fact in &task.init {
            let mut own = vec![0; words];
            put(&mut own, fact.index());
            sets.of_fact[fact.index()] = Some(own.into());
        }
        let mut waits = vec![true; task.operators.len()];
        let mut queue: VecDeque<u32> = (0..task.operators.len() as u32).collect();
        let mut through = vec![0; words];
        while let Some(number) = queue.pop_front() {
            waits[number as usize] = false;
            let operator = &task.operators[number as usize];
            if !sets.of_needs(&operator.preconditions, &mut through) {
                continue;
            }
            for &fact in &operator.add_effects {
                if sets.narrow(fact, &through) {
                    for &by in &needed_by[fact.index()] {
                        if !std::mem::replace(&mut waits[by as usize], true) {
                            queue.push_back(by);
                        }
                    }
                }
            }
        }
        sets
    }

    /// The landmarks of all preconditions together; false when one is out of reach.
    fn of_needs(&self, needs: &[FactId], through: &mut [u64]) -> bool {
        through.fill(0);
        needs.iter().all(|need| match &self.of_fact[need.index()] {
            Some(own) => {
                unite(through, own);
                true
            }
            None => false,
        })
    }

    /// There is a way to a fact through these; whether that tells anything new.
    fn narrow(&mut self, fact: FactId, through: &[u64]) -> bool {
        let own = &mut self.of_fact[fact.index()];
        let Some(own) = own else {
            let mut set: Box<[u64]> = through.into();
            put(&mut set, fact.index());
            *own = Some(set);
            return true;
        };
        let mut narrower = false;
        for (at, (own, &through)) in own.iter_mut().zip(through).enumerate() {
            let itself = if fact.index() / 64 == at { 1 << (fact.index() % 64) } else { 0 };
            let kept = *own & (through | itself);
            narrower |= kept != *own;
            *own = kept;
        }
        narrower
    }

    /// A way that needs the fact itself is no first way to it, unless it held: a block is not taken off itself.
    fn first_ways(&self, task: &Task, fact: FactId, held: bool) -> Ways {
        let first = || {
            self.added_by[fact.index()].iter().filter_map(|&number| {
                let operator = &task.operators[number as usize];
                let before = held
                    || operator.preconditions.iter().all(|need| {
                        self.of_fact[need.index()]
                            .as_ref()
                            .is_some_and(|set| !has(set, fact.index()))
                    });
                before.then_some(operator)
            })
        };
        Ways {
            needs: common(first().map(|operator| operator.preconditions.as_slice())),
            deletes: common(first().map(|operator| operator.del_effects.as_slice())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strips::Scenario;
    use crate::units::Source;

    /// Three blocks: А on Б on the table, and В; wanted is А on Б on В.
    fn towers() -> Task {
        let text = "
        Действие: Взять (Параметры: кубик ?x) (Предусловие: СВОБОДЕН_(?x) СТОЛ_(?x) РУКА_())
        (Эффект+: ДЕРЖИТ_(?x)) (Эффект-: СВОБОДЕН_(?x) СТОЛ_(?x) РУКА_())
        Действие: Снять (Параметры: кубик ?x, кубик ?y) (Предусловие: СВОБОДЕН_(?x) НА_(?x, ?y) РУКА_())
        (Эффект+: ДЕРЖИТ_(?x) СВОБОДЕН_(?y)) (Эффект-: СВОБОДЕН_(?x) НА_(?x, ?y) РУКА_())
        Действие: Положить (Параметры: кубик ?x) (Предусловие: ДЕРЖИТ_(?x))
        (Эффект+: СВОБОДЕН_(?x) СТОЛ_(?x) РУКА_()) (Эффект-: ДЕРЖИТ_(?x))
        Действие: Поставить (Параметры: кубик ?x, кубик ?y) (Предусловие: ДЕРЖИТ_(?x) СВОБОДЕН_(?y))
        (Эффект+: СВОБОДЕН_(?x) НА_(?x, ?y) РУКА_()) (Эффект-: ДЕРЖИТ_(?x) СВОБОДЕН_(?y))
        Факты: НА_(А, Б) СТОЛ_(Б) СТОЛ_(В) СВОБОДЕН_(А) СВОБОДЕН_(В) РУКА_()
        Цель: НА_(А, Б) НА_(Б, В)";
        Scenario::parse(&Source::new("towers", text)).unwrap().ground().unwrap()
    }

    fn state(task: &Task) -> State {
        let mut state = vec![0; words(task.facts.len())].into_boxed_slice();
        task.init.iter().for_each(|fact| put(&mut state, fact.index()));
        state
    }

    #[test]
    fn what_must_come_about_is_found() {
        let task = towers();
        let landmarks = Landmarks::of(&task).unwrap();
        let mut names: Vec<String> =
            landmarks.facts.iter().map(|&fact| task.fact(fact).to_string()).collect();
        names.sort();
        let expected = [
            "ДЕРЖИТ_(Б)",
            "НА_(А, Б)",
            "НА_(Б, В)",
            "РУКА_()",
            "СВОБОДЕН_(А)",
            "СВОБОДЕН_(Б)",
            "СВОБОДЕН_(В)",
            "СТОЛ_(Б)",
        ];
        assert_eq!(names, expected);
    }

    #[test]
    fn a_tower_on_the_wrong_base_does_not_count() {
        let task = towers();
        let landmarks = Landmarks::of(&task).unwrap();
        let state = state(&task);
        let on_b = task.fact_ids().find(|&f| task.fact(f).to_string() == "НА_(А, Б)").unwrap();
        let number = landmarks.facts.iter().position(|&fact| fact == on_b).unwrap();
        assert!(holds(&state, on_b) && !has(&landmarks.initially(&state), number));
        assert!(landmarks.ahead(&landmarks.initially(&state), &state) > 0);
    }

    #[test]
    fn a_tower_is_built_from_its_base() {
        let task = towers();
        let landmarks = Landmarks::of(&task).unwrap();
        let order: Vec<String> =
            landmarks.goals_in_order().iter().map(|&fact| task.fact(fact).to_string()).collect();
        assert_eq!(order, ["НА_(Б, В)", "НА_(А, Б)"]);
    }
}
