//! Facts that every plan makes true at some time, and how many of them are still ahead (J. Hoffmann, J. Porteous,
//! L. Sebastia, 2004; counted as by S. Richter, M. Westphal, 2010).
//!
//! A fact is a landmark of another when without delete effects there is no way to the other but through it; that is
//! a fixpoint of sets (L. Zhu, R. Givan, 2003). Orders tell when having a landmark counts: what all first ways to it
//! need comes before it, and of two goals that one whose attainment would undo the other. A tower built on the wrong
//! base therefore counts for nothing, where a relaxed plan would praise it.

mod disjunctions;
mod sets;

use std::collections::BTreeMap;

use self::sets::{Sets, Ways, common};
use super::relaxed::{State, holds};
use crate::bits::{has, members, put, unite, words};
use crate::strips::{FactId, Task};
use crate::units::Gather as _;

/// More facts than these make the sets too large.
const MOST_FACTS: usize = 1 << 13;
/// More goals than these are not ordered pair by pair.
const MOST_GOALS: usize = 512;

/// Landmarks attained so far, as bits.
pub(crate) type Attained = Box<[u64]>;

pub(crate) struct Landmarks {
    facts: Vec<FactId>,
    /// Landmarks of several facts each, one of which must hold at some time; their numbers go on from those of `facts`.
    disjunctions: Vec<Box<[FactId]>>,
    is_goal: Vec<bool>,
    /// Which landmarks must have been attained before one counts.
    before: Vec<Vec<u32>>,
    /// Landmarks that one directly needs to come about for the first time.
    needs: Vec<Vec<u32>>,
    /// The same for any time.
    needs_again: Vec<Vec<u32>>,
    /// The goals, none before another that it would be undone for.
    in_order: Vec<FactId>,
}

impl Landmarks {
    /// None when there are too many facts, or the goal is out of reach.
    pub(crate) fn of(task: &Task) -> Option<Self> {
        let mut initial = vec![0; words(task.facts.len())].into_boxed_slice();
        task.init.iter().for_each(|fact| put(&mut initial, fact.index()));
        Self::from(task, &initial)
    }

    /// The landmarks of what is still to be done after some state; none as above.
    pub(crate) fn from(task: &Task, state: &State) -> Option<Self> {
        if task.facts.len() > MOST_FACTS {
            return None;
        }
        let sets = Sets::new(task, state);
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
        let ways: Vec<Ways> =
            facts.iter().map(|&f| sets.first_ways(task, f, holds(state, f))).collect();
        let mut needs: Vec<Vec<u32>> = vec![Vec::new(); facts.len()];
        // What holds at first was had, though as a goal it may have to be brought about once more.
        let mut before = needs.clone();
        for n in (0..facts.len()).filter(|&n| !holds(state, facts[n])) {
            for (need, number) in ways[n].needs.iter().filter_map(|f| Some((f, number[f.index()]?)))
            {
                needs[n].push(number);
                if !holds(state, *need) {
                    before[n].push(number);
                }
            }
        }
        let needs_again: Vec<Vec<u32>> = (facts.iter())
            .map(|&fact| sets.ways(task, fact).needs)
            .map(|needs| needs.iter().filter_map(|need| number[need.index()]).collect())
            .collect();
        let goals: Vec<u32> = task.goal.iter().filter_map(|goal| number[goal.index()]).collect();
        let mut is_goal = vec![false; facts.len()];
        goals.iter().for_each(|&goal| is_goal[goal as usize] = true);
        let mut landmarks = Self {
            facts,
            disjunctions: Vec::new(),
            is_goal,
            before,
            needs,
            needs_again,
            in_order: Vec::new(),
        };
        let undoing = landmarks.order(&ways, &goals);
        landmarks.order_needs(task, &ways, |fact| sets.of_fact[fact.index()].as_deref());
        landmarks.in_order =
            in_order(&goals, &undoing).map(|goal| landmarks.facts[goal as usize]).collect();
        disjunctions::add(&mut landmarks, task, &sets, state);
        Some(landmarks)
    }

    /// The goals, none before another that it would be undone for.
    pub(crate) fn goals_in_order(&self) -> &[FactId] {
        &self.in_order
    }

    /// Orders goals that would be undone for another after that other, unless that leads in a circle, and tells of
    /// these pairs.
    fn order(&mut self, ways: &[Ways], goals: &[u32]) -> Vec<(u32, u32)> {
        if goals.len() > MOST_GOALS {
            return Vec::new();
        }
        let mut pairs = Vec::new();
        for &later in goals {
            for &earlier in goals.iter().filter(|&&earlier| earlier != later) {
                let undoes = self.undoes(ways, &ways[later as usize], earlier);
                if undoes && !leads_to(&self.before, earlier, later) {
                    self.before[later as usize].push(earlier);
                    pairs.push((later, earlier));
                }
            }
        }
        pairs
    }

    /// What a landmark directly needs is had last if it takes what comes back only when it is given up: whatever else
    /// comes before the landmark and rests on that comes first (reasonable orders). The place for a block is cleared
    /// before the block takes the hand.
    fn order_needs<'s>(
        &mut self,
        task: &Task,
        ways: &[Ways],
        own: impl Fn(FactId) -> Option<&'s [u64]>,
    ) {
        let taken: Vec<Ways> = (0..self.facts.len()).map(|n| self.taken(task, ways, n)).collect();
        for landmark in 0..self.facts.len() {
            let Some(own) = own(self.facts[landmark]) else { continue };
            for need in self.needs[landmark].clone() {
                let taken = &taken[need as usize];
                if self.is_goal[need as usize] || taken.deletes.is_empty() {
                    continue;
                }
                let is_other = |n: usize| n != landmark && n != need as usize;
                let others = (0..self.facts.len())
                    .filter(|&n| is_other(n) && has(own, self.facts[n].index()))
                    .map(|n| n as u32);
                for earlier in others {
                    let is_new = !self.before[need as usize].contains(&earlier)
                        && self.undoes(ways, taken, earlier)
                        && !leads_to(&self.before, earlier, need);
                    if is_new {
                        self.before[need as usize].push(earlier);
                    }
                }
            }
        }
    }

    /// What is gone as long as a landmark holds: all ways to it delete it, and whatever deletes the landmark brings it back.
    fn taken(&self, task: &Task, ways: &[Ways], landmark: usize) -> Ways {
        let fact = self.facts[landmark];
        let mut deletes = ways[landmark].deletes.clone();
        if !deletes.is_empty() {
            let ending =
                task.operators.iter().filter(|o| o.del_effects.binary_search(&fact).is_ok());
            let given = common(ending.map(|operator| operator.add_effects.as_slice()));
            deletes.retain(|fact| given.binary_search(fact).is_ok());
        }
        Ways { needs: ways[landmark].needs.clone(), deletes }
    }

    /// Whether a goal would be undone on the way to another that is attained after it: the other's last ways need
    /// what every way to the goal deletes, be it through facts that cannot hold beside the goal.
    fn undoes(&self, ways: &[Ways], goal: &Ways, other: u32) -> bool {
        let mut open = vec![other];
        let mut seen = vec![other];
        while let Some(landmark) = open.pop() {
            for &need in &self.needs[landmark as usize] {
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

    /// The fact of a landmark, or those of which one must hold.
    fn alternatives(&self, landmark: usize) -> &[FactId] {
        match landmark.checked_sub(self.facts.len()) {
            None => std::slice::from_ref(&self.facts[landmark]),
            Some(further) => &self.disjunctions[further],
        }
    }

    fn held(&self, landmark: usize, state: &State) -> bool {
        self.alternatives(landmark).iter().any(|&fact| holds(state, fact))
    }

    /// What counts as attained at first.
    pub(crate) fn initially(&self, state: &State) -> Attained {
        let mut attained = vec![0; words(self.before.len())].into_boxed_slice();
        for n in 0..self.before.len() {
            if self.held(n, state) && self.before[n].is_empty() {
                put(&mut attained, n);
            }
        }
        attained
    }

    /// What counts as attained once a state is come to.
    pub(crate) fn advance(&self, attained: &Attained, state: &State) -> Attained {
        let mut next = attained.clone();
        for n in 0..self.before.len() {
            let counts = !has(attained, n)
                && self.held(n, state)
                && self.before[n].iter().all(|&before| has(attained, before as usize));
            if counts {
                put(&mut next, n);
            }
        }
        next
    }

    /// Facts whose coming about would count next, as bits: landmarks not attained with nothing before them open, and
    /// those lost that are needed once more.
    pub(crate) fn next(&self, attained: &Attained, state: &State) -> Box<[u64]> {
        let mut next = vec![0; state.len()].into_boxed_slice();
        for n in 0..self.before.len() {
            let open = || self.before[n].iter().all(|&before| has(attained, before as usize));
            if !self.held(n, state) && !has(attained, n) && open() {
                self.alternatives(n).iter().for_each(|fact| put(&mut next, fact.index()));
            }
        }
        next
    }

    /// How many landmarks are ahead: not attained, or lost and needed once more, be it only for another that was lost.
    pub(crate) fn ahead(&self, attained: &Attained, state: &State) -> u32 {
        let mut ahead = vec![0; attained.len()].into_boxed_slice();
        let mut open: Vec<u32> = Vec::new();
        for n in 0..self.before.len() {
            if !has(attained, n) || self.is_goal[n] && !self.held(n, state) {
                put(&mut ahead, n);
                open.push(n as u32);
            }
        }
        let mut count = open.len() as u32;
        while let Some(landmark) = open.pop() {
            let (known, held) =
                (has(attained, landmark as usize), self.held(landmark as usize, state));
            // What holds and does not count yet will be undone and brought about once more.
            let needs = match (known, held) {
                (true, true) => continue,
                (false, false) => &self.needs[landmark as usize],
                _ => &self.needs_again[landmark as usize],
            };
            for &need in needs {
                if !has(&ahead, need as usize) && !self.held(need as usize, state) {
                    put(&mut ahead, need as usize);
                    open.push(need);
                    count += 1;
                }
            }
        }
        count
    }
}

/// The longest row of landmarks that hold for the first time one after the other in every plan: whatever brings the next
/// about rests on the one before, so every plan has at least as many steps. Empty where there are too many facts, or the
/// goal is out of reach.
pub(crate) fn longest_row(task: &Task, state: &State) -> Vec<FactId> {
    if task.facts.len() > MOST_FACTS {
        return Vec::new();
    }
    let sets = Sets::new(task, state);
    let mut all = vec![0; sets.words];
    for goal in &task.goal {
        let Some(of_goal) = sets.of_fact[goal.index()].as_ref() else { return Vec::new() };
        unite(&mut all, of_goal);
    }
    // What a landmark rests on has fewer landmarks itself.
    let own = |fact: FactId| {
        let landmarks = sets.of_fact[fact.index()].iter().flat_map(|set| members(set));
        landmarks.map(|fact| FactId(fact as u32)).filter(|&other| !holds(state, other))
    };
    let mut new: Vec<FactId> =
        members(&all).map(|fact| FactId(fact as u32)).filter(|&fact| !holds(state, fact)).collect();
    new.sort_by_cached_key(|&fact| (own(fact).count(), fact));
    // Of each the length of the longest row that ends with it, and what stands before it there.
    let mut rows: BTreeMap<FactId, (usize, Option<FactId>)> = BTreeMap::new();
    for &fact in &new {
        let before = own(fact).filter(|&other| other != fact);
        let longest = before.filter_map(|other| Some((rows.get(&other)?.0, other))).max();
        rows.insert(fact, (longest.map_or(1, |(length, _)| length + 1), longest.map(|(_, f)| f)));
    }
    let mut last =
        rows.iter().map(|(&fact, &(length, _))| (length, fact)).max().map(|(_, fact)| fact);
    let mut row = Vec::new();
    while let Some(fact) = last {
        row.push(fact);
        last = rows[&fact].1;
    }
    row.reverse();
    row
}

/// Goals by the longest chain of pairs that ends with them; the pairs have no cycles.
fn in_order(goals: &[u32], pairs: &[(u32, u32)]) -> impl Iterator<Item = u32> + use<> {
    let mut rank: BTreeMap<u32, usize> = goals.iter().map(|&goal| (goal, 0)).gather();
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
fn leads_to(next: &[Vec<u32>], from: u32, to: u32) -> bool {
    let mut seen = vec![false; next.len()];
    let mut open = vec![from];
    while let Some(node) = open.pop() {
        if node == to {
            return true;
        }
        if !std::mem::replace(&mut seen[node as usize], true) {
            open.extend(&next[node as usize]);
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bits::take;
    use crate::strips::{Operator, Scenario};
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

    /// The state after operators, told by their names, and what was attained on the way.
    fn after(task: &Task, landmarks: &Landmarks, names: &[&str]) -> (State, Attained) {
        let mut state = state(task);
        let mut attained = landmarks.initially(&state);
        for name in names {
            let named = |operator: &&Operator| operator.to_string() == *name;
            let operator = task.operators.iter().find(named).expect("an operator of that name");
            operator.del_effects.iter().for_each(|fact| take(&mut state, fact.index()));
            operator.add_effects.iter().for_each(|fact| put(&mut state, fact.index()));
            attained = landmarks.advance(&attained, &state);
        }
        (state, attained)
    }

    fn ahead_after(names: &[&str]) -> u32 {
        let task = towers();
        let landmarks = Landmarks::of(&task).unwrap();
        let (state, attained) = after(&task, &landmarks, names);
        landmarks.ahead(&attained, &state)
    }

    #[test]
    fn what_held_at_first_keeps_nothing_waiting() {
        let task = towers();
        let landmarks = Landmarks::of(&task).unwrap();
        let (state, attained) = after(&task, &landmarks, &["Снять_(А, Б)"]);
        // Б is free because А stood on it, though А on Б will count only once Б is on В.
        let free = landmarks.facts.iter().position(|&f| task.fact(f).to_string() == "СВОБОДЕН_(Б)");
        let free = free.expect("Б must be free");
        assert!(holds(&state, landmarks.facts[free]) && has(&attained, free));
    }

    #[test]
    fn what_was_lost_is_ahead_once_more_with_all_that_it_needs() {
        let cleared = ["Снять_(А, Б)", "Положить_(А)"];
        let held = [&cleared[..], &["Взять_(Б)"]].concat();
        let put_down = [&held[..], &["Положить_(Б)"]].concat();
        let covered = [&put_down[..], &["Взять_(А)", "Поставить_(А, Б)"]].concat();
        assert!(ahead_after(&cleared) < ahead_after(&[]));
        assert_eq!(ahead_after(&cleared), ahead_after(&put_down));
        // Б must be held once more, and free for that.
        assert!(ahead_after(&covered) > ahead_after(&put_down));
    }

    #[test]
    fn a_place_is_cleared_before_what_goes_there_is_taken() {
        let mut task = towers();
        let named = |name: &str| task.fact_ids().find(|&f| task.fact(f).to_string() == name);
        let [goal, held, free] = ["НА_(Б, В)", "ДЕРЖИТ_(Б)", "СВОБОДЕН_(В)"]
            .map(|name| named(name).expect("a fact of the towers"));
        task.goal = vec![goal];
        let landmarks = Landmarks::of(&task).unwrap();
        let (covered, _) = after(&task, &landmarks, &["Снять_(А, Б)", "Поставить_(А, В)"]);
        let anew = Landmarks::from(&task, &covered).unwrap();
        let number = |wanted| anew.facts.iter().position(|&fact| fact == wanted).unwrap();
        assert!(anew.before[number(held)].contains(&(number(free) as u32)));
        assert!(!anew.before[number(free)].contains(&(number(held) as u32)));
    }

    #[test]
    fn landmarks_of_a_later_state_tell_what_came_into_the_way() {
        let mut task = towers();
        let named = |name: &str| task.fact_ids().find(|&f| task.fact(f).to_string() == name);
        task.goal = vec![named("НА_(Б, В)").expect("a goal of the towers")];
        let landmarks = Landmarks::of(&task).unwrap();
        let names = ["Снять_(А, Б)", "Поставить_(А, В)"];
        let (later, _) = after(&task, &landmarks, &names);
        let anew = Landmarks::from(&task, &later).unwrap();
        let free = |landmarks: &Landmarks, state: &State| {
            let ahead = landmarks.next(&landmarks.initially(state), state);
            members(&ahead).any(|fact| task.facts[fact].to_string() == "СВОБОДЕН_(В)")
        };
        assert!(!free(&landmarks, &state(&task)) && free(&anew, &later));
    }
}
