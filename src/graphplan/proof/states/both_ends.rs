//! All states in the order of the steps that lead to them from what holds at first, and of those that lead from them to
//! the goal, layer by layer in turns (I. Pohl, 1971), the smaller one first: where operators can be undone and few states
//! have the goal ([`super::undo`]).
//!
//! The first state that both sides know is on a shortest way: while neither knows one of the other's, every plan has more
//! steps than both have gone. States that differ by an exchange of what is alike are one, as they are equally far from
//! the goal, and each side has the same of them.

use super::alike::Alike;
use super::packed::Packed;
use super::steps::Steps;
use super::{NONE, Progress, StateSearch, plan_along, undo};
use crate::plan::Plan;
use crate::portfolio::relaxed::initial;
use crate::proof::graph::PlanningGraph;
use crate::strips::Task;

pub(crate) struct BothEnds<'a> {
    task: &'a Task,
    alike: Alike,
    there: Side<'a>,
    back: Side<'a>,
    /// Which of the two is gone on with.
    is_back: bool,
    is_given_up: bool,
}

/// What is known from one end.
struct Side<'a> {
    steps: Steps<'a>,
    /// In the order of the steps from the end.
    known: Packed,
    /// For each state the one nearer to the end.
    from: Vec<u32>,
    /// The next state to go on from, and the first that is a step farther.
    at: u32,
    layer_end: u32,
    depth: usize,
}

impl<'a> Side<'a> {
    fn new(steps: Steps<'a>, ends: &[Vec<u64>], words: usize) -> Self {
        let mut known = Packed::new(words);
        let mut from = Vec::new();
        for state in ends {
            if known.insert(state).1 {
                from.push(NONE);
            }
        }
        Self { steps, known, layer_end: from.len() as u32, from, at: 0, depth: 0 }
    }

    fn bytes(&self) -> usize {
        self.known.bytes() + self.from.capacity() * 4
    }

    fn open(&self) -> usize {
        self.from.len() - self.at as usize
    }

    /// From a state to the end, itself among them.
    fn way(&self, number: u32) -> impl Iterator<Item = &[u64]> {
        let numbers = std::iter::successors(Some(number), |&at| {
            Some(self.from[at as usize]).filter(|&from| from != NONE)
        });
        numbers.map(|number| self.known.state(number))
    }
}

impl<'a> BothEnds<'a> {
    /// None where the task is not of the kind. The graph has leveled off.
    pub(crate) fn of(task: &'a Task, graph: &PlanningGraph) -> Option<Self> {
        let (there, back) = undo::there_and_back(task, graph)?;
        let goals = undo::goals(task, graph)?;
        let mut alike = Alike::of(task);
        let mut represented = |mut states: Vec<Vec<u64>>| {
            states.iter_mut().for_each(|state| alike.represent(state));
            states
        };
        let first = represented(vec![initial(task).to_vec()]);
        let goals = represented(goals);
        let words = first[0].len();
        let (there, back) = (Side::new(there, &first, words), Side::new(back, &goals, words));
        // Who is there already has nothing to look for.
        back.known.find(&first[0]).is_none().then_some(())?;
        Some(Self { task, alike, there, back, is_back: false, is_given_up: false })
    }

    /// None where a state that was come to from the goal has too many ways on.
    fn plan(&mut self, there: u32, back: u32) -> Option<Plan> {
        let mut way: Vec<Vec<u64>> = self.there.way(there).map(<[u64]>::to_vec).collect();
        way.reverse();
        way.extend(self.back.way(back).skip(1).map(<[u64]>::to_vec));
        plan_along(&way, self.task, &mut self.there.steps, &mut self.alike)
    }
}

impl StateSearch for BothEnds<'_> {
    fn at_least(&self) -> usize {
        self.there.depth + self.back.depth + 1
    }

    fn effort(&self) -> u64 {
        self.there.steps.effort() + self.back.steps.effort() + self.alike.effort
    }

    /// It comes half as deep as another.
    fn share(&self) -> u64 {
        1
    }

    fn bytes(&self) -> usize {
        self.there.bytes() + self.back.bytes()
    }

    fn is_given_up(&self) -> bool {
        self.is_given_up
    }

    fn give_up(&mut self) {
        self.is_given_up = true;
        for side in [&mut self.there, &mut self.back] {
            (side.known, side.from) = (Packed::new(1), Vec::new());
        }
    }

    fn look(&mut self) -> Option<Progress> {
        let Self { there, back, alike, .. } = self;
        let (side, other) = if self.is_back { (back, &*there) } else { (there, &*back) };
        if side.at == side.layer_end {
            side.depth += 1;
            side.layer_end = side.from.len() as u32;
            let is_over = side.at == side.layer_end;
            self.is_back = self.back.open() < self.there.open();
            return is_over.then_some(Progress::Never);
        }
        let state = side.known.state(side.at).to_vec();
        let Some(after) = side.steps.after(&state) else {
            self.give_up();
            return None;
        };
        for (mut after, _) in after {
            alike.represent(&mut after);
            let (number, is_new) = side.known.insert(&after);
            if is_new {
                side.from.push(side.at);
                if let Some(met) = other.known.find(&after) {
                    let (there, back) = if self.is_back { (met, number) } else { (number, met) };
                    let plan = self.plan(there, back).map(Progress::Plan);
                    if plan.is_none() {
                        self.give_up();
                    }
                    return plan;
                }
            }
        }
        side.at += 1;
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Limits;
    use crate::samples::{
        Named, Random, crates, random_errand, random_task, random_task_with_objects, towers,
    };
    use crate::strips::FactId;
    use crate::tests::fewest_steps;
    use crate::validate;

    /// Cars that stand at kerbs, one or two at each, and drive from one to the other; that a car stands inside is not
    /// asked of it before it leaves.
    fn cars(seed: u64) -> Task {
        let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        let mut named = Named::default();
        let (kerbs, cars) = (2 + random.below(2), 2 + random.below(3));
        let mut fact = |words: String| named.fact(&words);
        let inside: Vec<FactId> = (0..cars).map(|c| fact(format!("inside c{c}"))).collect();
        let clear: Vec<FactId> = (0..cars).map(|c| fact(format!("clear c{c}"))).collect();
        let free: Vec<FactId> = (0..kerbs).map(|k| fact(format!("free k{k}"))).collect();
        // At a kerb, or behind a car: places after those of the kerbs.
        let mut row = |car: usize| -> Vec<FactId> {
            let kerbs = (0..kerbs).map(|kerb| format!("at c{car} k{kerb}"));
            let behind = (0..cars).map(|other| format!("behind c{car} c{other}"));
            kerbs.chain(behind).map(&mut fact).collect()
        };
        let at: Vec<Vec<FactId>> = (0..cars).map(&mut row).collect();
        let places = |car: usize| (0..kerbs + cars).filter(move |place| *place != kerbs + car);
        let stand = |random: &mut Random, init: bool| {
            let mut order: Vec<usize> = (0..cars).collect();
            (1..cars).rev().for_each(|last| order.swap(last, random.below(last + 1)));
            let mut facts = Vec::new();
            for (number, &car) in order.iter().enumerate() {
                let before = number.checked_sub(kerbs).map(|number| order[number]);
                facts.push(at[car][before.map_or(number, |before| kerbs + before)]);
                if init && before.is_none() {
                    facts.push(inside[car]);
                }
                if init && order.get(number + kerbs).is_none() {
                    facts.push(clear[car]);
                }
            }
            if init {
                facts.extend((cars..kerbs).map(|kerb| free[kerb]));
            }
            facts
        };
        let (init, mut goal) = (stand(&mut random, true), stand(&mut random, false));
        if random.below(3) == 0 {
            goal.remove(random.below(goal.len()));
        }
        for car in 0..cars {
            for (from, to) in places(car).flat_map(|from| places(car).map(move |to| (from, to))) {
                if from == to {
                    continue;
                }
                let (stood, stands) = (at[car][from], at[car][to]);
                let (mut needs, mut adds) = (vec![clear[car], stood], vec![stands]);
                let mut deletes = vec![stood];
                match from.checked_sub(kerbs) {
                    None => adds.push(free[from]),
                    Some(other) => adds.push(clear[other]),
                }
                match to.checked_sub(kerbs) {
                    None => needs.push(free[to]),
                    Some(other) => needs.extend([clear[other], inside[other]]),
                }
                deletes.push(to.checked_sub(kerbs).map_or_else(|| free[to], |other| clear[other]));
                match (from < kerbs, to < kerbs) {
                    (true, false) => deletes.push(inside[car]),
                    (false, true) => adds.push(inside[car]),
                    _ => {}
                }
                named.operator(&needs, &adds, &deletes);
            }
        }
        named.task(&init, &goal)
    }

    /// Whatever the effort, what is claimed is true.
    #[test]
    fn a_search_from_both_ends_agrees_with_breadth_first_search() {
        let (mut plans, mut none) = (0, 0);
        let random = (1..=1500)
            .flat_map(|seed| [random_task(seed), random_task_with_objects(seed)])
            .chain((1..=300).map(random_errand))
            .chain((1..=60).map(crates));
        let kinds =
            [random.collect(), (1..=200).map(towers).collect(), (1..=300).map(cars).collect()];
        let mut of_kind = [0; 3];
        for (kind, task) in kinds
            .iter()
            .enumerate()
            .flat_map(|(kind, tasks): (_, &Vec<Task>)| tasks.iter().map(move |task| (kind, task)))
        {
            let mut graph = PlanningGraph::new(task);
            while graph.leveled_off_at().is_none() {
                graph.expand(None, &Limits::default()).unwrap();
            }
            let Some(mut search) = BothEnds::of(task, &graph) else { continue };
            of_kind[kind] += 1;
            let fewest = fewest_steps(task);
            loop {
                let allowed = search.effort() + 1 + plans % 50;
                let progress = search.go_on(allowed, &Limits::default()).unwrap();
                match progress {
                    Progress::Plan(plan) => {
                        assert_eq!(validate(task, &plan), Ok(()), "{task:?}");
                        assert_eq!(Some(plan.steps.len()), fewest, "{task:?}");
                        plans += 1;
                        break;
                    }
                    Progress::Never => {
                        assert_eq!(fewest, None, "{task:?}");
                        none += 1;
                        break;
                    }
                    Progress::Open => {
                        assert!(
                            fewest.is_none_or(|fewest| search.at_least() <= fewest),
                            "{task:?}"
                        );
                        assert!(!search.is_given_up(), "{task:?}");
                    }
                }
            }
        }
        assert!(plans > 300 && none > 300, "{plans} {none}");
        assert!(of_kind.iter().all(|&count| count > 100), "{of_kind:?}");
    }
}
