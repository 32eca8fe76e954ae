//! Sets of operators of which every plan carries out at least one: *disjunctive action landmarks*, found by cuts
//! (M. Helmert, C. Domshlak, 2009, LM-cut).
//!
//! Without delete effects, and each operator costing as much as its dearest precondition allows (h^max), the goal
//! is reached through a graph in which every fact has one supporter an operator. What lies before the goal's zone
//! of free operators is cut off from it by operators, one of which any plan must carry out. These become free, and
//! the next cut is disjoint from them all: so a plan has at least as many operators as there are cuts. Where operators
//! have prices, each cut takes the least of its own off them all, and a plan costs at least what was taken.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::strips::{FactId, Operator, OperatorId, Task};

/// Disjoint sets, one operator of each of which every plan carries out; none when the goal is out of reach, or
/// holds. Ends early after so much work, in visits of operators' lists.
pub(crate) fn disjoint_landmarks(task: &Task, work: usize) -> Vec<Vec<OperatorId>> {
    let mut cuts = Cuts::new(task);
    cuts.price(task, |_| 1);
    let most = work / cuts.size.max(1);
    let mut landmarks = Vec::new();
    while landmarks.len() < most
        && let Some((cut, _)) = cuts.next_cut()
    {
        landmarks.push(cut);
    }
    landmarks
}

/// An operator over plain numbers; the last one stands for the goal.
struct Rule {
    needs: Vec<u32>,
    adds: Vec<u32>,
    /// What it still costs.
    price: u32,
}

/// The task without delete effects, at prices that each cut lowers.
pub(crate) struct Cuts {
    rules: Vec<Rule>,
    init: Vec<u32>,
    needed_by: Vec<Vec<u32>>,
    added_by: Vec<Vec<u32>>,
    /// A fact that always holds, and supports what needs nothing.
    start: u32,
    /// The fact that says that the goal is reached.
    end: u32,
    /// What one cut looks at, in facts and operators' lists.
    size: usize,
    /// What was looked at so far.
    pub(crate) effort: u64,
}

/// Not reached, or no supporter.
const NONE: u32 = u32::MAX;

impl Cuts {
    /// From the initial state to the goal, at no price.
    fn new(task: &Task) -> Self {
        Self::towards(task, &task.goal)
    }

    /// From the initial state to these facts, at no price.
    pub(crate) fn towards(task: &Task, goal: &[FactId]) -> Self {
        let (start, end) = (task.facts.len() as u32, task.facts.len() as u32 + 1);
        let or_start = |needs: Vec<u32>| if needs.is_empty() { vec![start] } else { needs };
        let mut rules: Vec<Rule> = task
            .operators
            .iter()
            .map(|operator| Rule {
                needs: or_start(operator.preconditions.iter().map(|fact| fact.0).collect()),
                adds: operator.add_effects.iter().map(|fact| fact.0).collect(),
                price: 0,
            })
            .collect();
        let goal = or_start(goal.iter().map(|fact| fact.0).collect());
        rules.push(Rule { needs: goal, adds: vec![end], price: 0 });
        let mut needed_by = vec![Vec::new(); end as usize + 1];
        let mut added_by = vec![Vec::new(); end as usize + 1];
        for (number, rule) in rules.iter().enumerate() {
            rule.needs.iter().for_each(|&fact| needed_by[fact as usize].push(number as u32));
            rule.adds.iter().for_each(|&fact| added_by[fact as usize].push(number as u32));
        }
        let init = task.init.iter().map(|fact| fact.0).chain([start]).collect();
        let lists = |o: &Operator| o.preconditions.len() + o.add_effects.len();
        let size = task.operators.iter().map(lists).sum::<usize>() + task.facts.len();
        Self { rules, init, needed_by, added_by, start, end, size, effort: 0 }
    }

    /// From now on operators have these prices.
    fn price(&mut self, task: &Task, price: impl Fn(OperatorId) -> u32) {
        task.operator_ids().for_each(|id| self.rules[id.index()].price = price(id));
    }

    /// What a plan costs at least from where these facts hold, at the prices that the task has; none when the goal is out
    /// of reach.
    pub(crate) fn at_least(
        &mut self,
        task: &Task,
        facts: impl Iterator<Item = usize>,
    ) -> Option<u64> {
        self.init.clear();
        self.init.extend(facts.map(|fact| fact as u32).chain([self.start]));
        self.price(task, |id| task.operator(id).cost);
        let mut sum = 0;
        loop {
            let (cost, supporter) = self.dearest();
            match cost[self.end as usize] {
                0 => return Some(sum),
                NONE => return None,
                _ => sum += u64::from(self.cut(&supporter).1),
            }
        }
    }

    /// The operators of the next cut, and the least of their prices; none when the goal costs nothing, or is out of reach.
    fn next_cut(&mut self) -> Option<(Vec<OperatorId>, u32)> {
        let (cost, supporter) = self.dearest();
        if matches!(cost[self.end as usize], 0 | NONE) {
            return None;
        }
        Some(self.cut(&supporter))
    }

    /// Operators one of which every plan carries out, and the least of their prices, which is taken off them all.
    fn cut(&mut self, supporter: &[u32]) -> (Vec<OperatorId>, u32) {
        let goal_zone = self.goal_zone(supporter);
        let mut reached = vec![false; goal_zone.len()];
        let mut queue: Vec<u32> = Vec::new();
        for &fact in &self.init {
            if !goal_zone[fact as usize] && !std::mem::replace(&mut reached[fact as usize], true) {
                queue.push(fact);
            }
        }
        let mut cut = Vec::new();
        while let Some(fact) = queue.pop() {
            for &number in &self.needed_by[fact as usize] {
                if supporter[number as usize] != fact {
                    continue;
                }
                let adds = &self.rules[number as usize].adds;
                if adds.iter().any(|&add| goal_zone[add as usize]) {
                    cut.push(number);
                }
                for &add in adds {
                    let seen = goal_zone[add as usize] || reached[add as usize];
                    if !seen {
                        reached[add as usize] = true;
                        queue.push(add);
                    }
                }
            }
        }
        cut.sort_unstable();
        let least = cut.iter().map(|&number| self.rules[number as usize].price).min();
        let least = least.expect("what is reached at a price is cut off from where one is");
        cut.iter().for_each(|&number| self.rules[number as usize].price -= least);
        self.effort += self.size as u64;
        (cut.into_iter().map(OperatorId).collect(), least)
    }

    /// For each fact what its dearest precondition, and so on back, costs (h^max); for each rule the precondition
    /// that came last.
    fn dearest(&self) -> (Vec<u32>, Vec<u32>) {
        let mut cost = vec![NONE; self.needed_by.len()];
        let mut done = vec![false; cost.len()];
        let mut supporter = vec![NONE; self.rules.len()];
        let mut missing: Vec<usize> = self.rules.iter().map(|rule| rule.needs.len()).collect();
        // What costs the same comes in turn, and what was come to at no price before it, the last first.
        let mut turn = 0_i64;
        let mut queue: BinaryHeap<Reverse<(u32, i64, u32)>> = BinaryHeap::new();
        for &fact in &self.init {
            cost[fact as usize] = 0;
            turn += 1;
            queue.push(Reverse((0, turn, fact)));
        }
        while let Some(Reverse((_, _, fact))) = queue.pop() {
            if std::mem::replace(&mut done[fact as usize], true) {
                continue;
            }
            for &number in &self.needed_by[fact as usize] {
                missing[number as usize] -= 1;
                if missing[number as usize] > 0 {
                    continue;
                }
                supporter[number as usize] = fact;
                let rule = &self.rules[number as usize];
                let reached = cost[fact as usize].saturating_add(rule.price);
                for &add in &rule.adds {
                    if reached < cost[add as usize] {
                        cost[add as usize] = reached;
                        turn += 1;
                        let turn = if rule.price > 0 { turn } else { -turn };
                        queue.push(Reverse((reached, turn, add)));
                    }
                }
            }
        }
        (cost, supporter)
    }

    /// Facts from which the goal is reached at no price, along supporters.
    fn goal_zone(&self, supporter: &[u32]) -> Vec<bool> {
        let mut zone = vec![false; self.needed_by.len()];
        zone[self.end as usize] = true;
        let mut queue = vec![self.end];
        while let Some(fact) = queue.pop() {
            for &number in &self.added_by[fact as usize] {
                let from = supporter[number as usize];
                let free = self.rules[number as usize].price == 0 && from != NONE;
                if free && !std::mem::replace(&mut zone[from as usize], true) {
                    queue.push(from);
                }
            }
        }
        zone
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strips::Scenario;
    use crate::units::Source;

    fn landmarks(text: &str) -> Vec<String> {
        let task = Scenario::parse(&Source::new("test", text)).unwrap().ground().unwrap();
        let named = |cut: Vec<OperatorId>| -> String {
            let names: Vec<String> = cut.iter().map(|&id| task.operator(id).to_string()).collect();
            names.join(" | ")
        };
        disjoint_landmarks(&task, 1 << 20).into_iter().map(named).collect()
    }

    #[test]
    fn every_way_to_the_goal_leads_through_each_cut() {
        let found = landmarks(
            "Действие: Шаг (Параметры: место ?a, место ?b) (Предусловие: ТУТ_(?a) ПУТЬ_(?a, ?b))
            (Эффект+: ТУТ_(?b)) (Эффект-: ТУТ_(?a))
            Факты: ТУТ_(А) ПУТЬ_(А, Б) ПУТЬ_(А, В) ПУТЬ_(Б, Г) ПУТЬ_(В, Г) ПУТЬ_(Г, Д) Цель: ТУТ_(Д)",
        );
        assert_eq!(found, ["Шаг_(Г, Д)", "Шаг_(Б, Г) | Шаг_(В, Г)", "Шаг_(А, Б) | Шаг_(А, В)"]);
    }

    #[test]
    fn a_goal_that_holds_or_is_out_of_reach_has_none() {
        let rules =
            "Действие: Шаг (Параметры: место ?a, место ?b) (Предусловие: ТУТ_(?a) ПУТЬ_(?a, ?b))
            (Эффект+: ТУТ_(?b)) (Эффект-: ТУТ_(?a)) Факты: ТУТ_(А) ПУТЬ_(А, Б) Объекты: В — место ";
        assert!(landmarks(&format!("{rules} Цель: ТУТ_(А)")).is_empty());
        assert!(landmarks(&format!("{rules} Цель: ТУТ_(В)")).is_empty());
    }
}
