//! All states in the order of the steps that lead to them, up to exchanges of what is alike.
//!
//! States come to their turn by the steps so far and those still to come at least ([`super::ahead`]; P. Hart, N. Nilsson,
//! B. Raphael, 1968), of equal ones the farthest first. A state that is come to by fewer steps later has its turn once
//! more, so what stands first bounds all plans.

use std::collections::BTreeMap;

use super::ahead::Ahead;
use super::alike::Alike;
use super::packed::Packed;
use super::steps::Steps;
use super::{NONE, Progress, StateSearch, plan_along};
use crate::plan::Plan;
use crate::portfolio::relaxed::initial;
use crate::strips::Task;

pub(crate) struct Onward<'a> {
    task: &'a Task,
    steps: Steps<'a>,
    ahead: Ahead,
    alike: Alike,
    known: Packed,
    /// For each state the steps that lead to it, and the one before.
    nodes: Vec<(u32, u32)>,
    /// By steps in all, then by those made: numbers of states, some of which were come to sooner since.
    open: BTreeMap<u32, Vec<Vec<u32>>>,
    at_least: usize,
    /// Whether some state has more ways to go on than can be looked at, or there are too many states.
    is_given_up: bool,
}

impl<'a> Onward<'a> {
    /// `groups` are numbers of operators, the same for those no two of which go into one step. None where the task is
    /// too large.
    pub(crate) fn of(task: &'a Task, groups: &[usize]) -> Option<Self> {
        let steps = Steps::of(task)?;
        let mut states = Self {
            task,
            steps,
            ahead: Ahead::of(task, groups),
            alike: Alike::of(task),
            known: Packed::new(initial(task).len()),
            nodes: Vec::new(),
            open: BTreeMap::new(),
            at_least: 0,
            is_given_up: false,
        };
        states.meet(&initial(task), 0, NONE);
        Some(states)
    }

    /// The state whose turn it is, and the steps that led to it.
    fn next(&mut self) -> Option<(u32, u32)> {
        while let Some(mut first) = self.open.first_entry() {
            let all = *first.key() as usize;
            let by_made = first.get_mut();
            if let Some(numbers) = by_made.last_mut() {
                self.at_least = self.at_least.max(all);
                if let Some(number) = numbers.pop() {
                    return Some((number, by_made.len() as u32 - 1));
                }
                by_made.pop();
            } else {
                first.remove();
            }
        }
        None
    }

    fn meet(&mut self, state: &[u64], made: u32, from: u32) {
        let (number, is_new) = self.known.insert(state);
        if is_new {
            self.nodes.push((made, from));
        } else if self.nodes[number as usize].0 <= made {
            return;
        }
        self.nodes[number as usize] = (made, from);
        let Some(ahead) = self.ahead.steps(state) else { return };
        let by_made = self.open.entry(made + ahead).or_default();
        if by_made.len() <= made as usize {
            by_made.resize(made as usize + 1, Vec::new());
        }
        by_made[made as usize].push(number);
    }

    fn plan(&mut self, to: u32) -> Plan {
        let numbers = std::iter::successors(Some(to), |&at| {
            Some(self.nodes[at as usize].1).filter(|&from| from != NONE)
        });
        let mut way: Vec<&[u64]> = numbers.map(|number| self.known.state(number)).collect();
        way.reverse();
        let plan = plan_along(&way, self.task, &mut self.steps, &mut self.alike);
        plan.expect("as many ways as from what stands for it")
    }
}

impl StateSearch for Onward<'_> {
    fn at_least(&self) -> usize {
        self.at_least
    }

    fn effort(&self) -> u64 {
        self.steps.effort() + self.alike.effort + self.ahead.effort
    }

    fn share(&self) -> u64 {
        4
    }

    fn bytes(&self) -> usize {
        let open: usize = self.open.values().flatten().map(|numbers| numbers.capacity() * 4).sum();
        self.known.bytes() + self.nodes.capacity() * 8 + open
    }

    fn is_given_up(&self) -> bool {
        self.is_given_up
    }

    fn give_up(&mut self) {
        self.is_given_up = true;
        self.known = Packed::new(1);
        (self.nodes, self.open) = Default::default();
    }

    fn look(&mut self) -> Option<Progress> {
        let Some((number, made)) = self.next() else { return Some(Progress::Never) };
        if self.nodes[number as usize].0 != made {
            return None;
        }
        let state = self.known.state(number).to_vec();
        if self.task.goal.iter().all(|fact| crate::bits::has(&state, fact.index())) {
            self.at_least = made as usize;
            return Some(Progress::Plan(self.plan(number)));
        }
        let Some(after) = self.steps.after(&state) else {
            self.give_up();
            return None;
        };
        for (mut after, _) in after {
            self.alike.represent(&mut after);
            self.meet(&after, made + 1, number);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Limits;
    use crate::bits;
    use crate::proof::fewest::groups;
    use crate::proof::graph::PlanningGraph;
    use crate::samples::{crates, random_errand, random_task, random_task_with_objects, towers};
    use crate::strips::FactId;
    use crate::tests::fewest_steps;
    use crate::validate;

    fn states<'a>(task: &'a Task) -> Onward<'a> {
        let mut graph = PlanningGraph::new(task);
        while graph.leveled_off_at().is_none() {
            graph.expand(None, &Limits::default()).unwrap();
        }
        Onward::of(task, &groups(task, &graph)).unwrap()
    }

    /// Whatever the effort, what is claimed is true.
    #[test]
    fn looking_at_all_states_agrees_with_breadth_first_search() {
        let (mut plans, mut none, mut fewer) = (0, 0, 0);
        let tasks = (1..=1200)
            .flat_map(|seed| [random_task(seed), random_task_with_objects(seed)])
            .chain((1..=300).map(random_errand))
            .chain((1..=60).map(crates))
            .chain((1..=200).map(towers));
        for (number, task) in tasks.enumerate() {
            let fewest = fewest_steps(&task);
            let mut states = states(&task);
            loop {
                let allowed = states.effort() + 1 + number as u64 % 50;
                let progress = states.go_on(allowed, &Limits::default()).unwrap();
                assert!(fewest.is_none_or(|fewest| states.at_least() <= fewest), "{number}");
                match progress {
                    Progress::Plan(plan) => {
                        assert_eq!(validate(&task, &plan), Ok(()), "{number}");
                        assert_eq!(Some(plan.steps.len()), fewest, "{number}");
                        plans += 1;
                        break;
                    }
                    Progress::Never => {
                        assert_eq!(fewest, None, "{number}");
                        none += 1;
                        break;
                    }
                    Progress::Open => assert!(!states.is_given_up(), "{number}"),
                }
            }
            fewer += usize::from(states.alike.count() > 0);
        }
        assert!(plans > 500 && none > 300 && fewer > 200, "{plans} {none} {fewer}");
    }

    #[test]
    fn crates_in_containers_of_their_own_are_alike() {
        let wants_all = |task: &Task| {
            let goal = task.goal.iter().map(|fact| task.fact(*fact).to_string());
            goal.collect::<Vec<_>>() == ["stored_(c0)", "stored_(c1)", "stored_(c2)"]
                && task.facts.iter().all(|fact| fact.to_string() != "clear_(p2)")
        };
        // More of them than of places and hands, which could be exchanged instead.
        let task = (1..).map(crates).find(wants_all).unwrap();
        let mut states = states(&task);
        let mut named = |facts: &[&str]| {
            let mut state = vec![0; bits::words(task.facts.len())];
            for fact in facts {
                let words: Vec<&str> = fact.split(' ').collect();
                let is_it = |id: &FactId| {
                    let fact = task.fact(*id);
                    let args: Vec<&str> = fact.args.iter().map(AsRef::as_ref).collect();
                    *fact.predicate == *words[0] && args == words[1..]
                };
                bits::put(&mut state, task.fact_ids().find(is_it).unwrap().index());
            }
            states.alike.represent(&mut state);
            state
        };
        let one = named(&["on c0 k0", "on c1 p0", "clear p1"]);
        assert_eq!(one, named(&["on c1 k1", "on c0 p0", "clear p1"]));
        assert_ne!(one, named(&["on c1 k1", "on c0 k0", "clear p0"]));
    }

    #[test]
    fn a_state_with_too_many_ways_on_ends_the_search() {
        let task = crate::samples::wishes(10, 10);
        let mut states = states(&task);
        assert!(matches!(states.go_on(u64::MAX, &Limits::default()), Ok(Progress::Open)));
        assert!(states.is_given_up() && states.at_least() <= 1);
    }
}
