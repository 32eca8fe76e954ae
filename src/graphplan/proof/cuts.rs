//! Sets of operators of which every plan carries out at least one: *disjunctive action landmarks*, found by cuts
//! (M. Helmert, C. Domshlak, 2009, LM-cut).
//!
//! Without delete effects, and each operator costing as much as its dearest precondition allows (h^max), the goal
//! is reached through a graph in which every fact has one supporter an operator. What lies before the goal's zone
//! of free operators is cut off from it by operators, one of which any plan must carry out. These become free, and
//! the next cut is disjoint from them all: so a plan has at least as many operators as there are cuts.

use std::collections::VecDeque;

use crate::strips::{OperatorId, Task};

/// Disjoint sets, one operator of each of which every plan carries out; none when the goal is out of reach, or
/// holds. Ends early after so much work, in visits of operators' lists.
pub(crate) fn disjoint_landmarks(task: &Task, work: usize) -> Vec<Vec<OperatorId>> {
    let mut cuts = Cuts::new(task);
    let size: usize =
        task.operators.iter().map(|o| o.preconditions.len() + o.add_effects.len()).sum();
    let most = work / (size + task.facts.len()).max(1);
    let mut landmarks = Vec::new();
    while landmarks.len() < most
        && let Some(cut) = cuts.next_cut()
    {
        landmarks.push(cut);
    }
    landmarks
}

/// An operator over plain numbers; the last one stands for the goal.
struct Rule {
    needs: Vec<u32>,
    adds: Vec<u32>,
    /// Whether it still costs one.
    priced: bool,
}

struct Cuts {
    rules: Vec<Rule>,
    init: Vec<u32>,
    needed_by: Vec<Vec<u32>>,
    added_by: Vec<Vec<u32>>,
    /// The fact that says that the goal is reached.
    end: u32,
}

/// Not reached, or no supporter.
const NONE: u32 = u32::MAX;

impl Cuts {
    fn new(task: &Task) -> Self {
        // A fact that always holds supports what needs nothing; another says that the goal is reached.
        let (start, end) = (task.facts.len() as u32, task.facts.len() as u32 + 1);
        let or_start = |needs: Vec<u32>| if needs.is_empty() { vec![start] } else { needs };
        let mut rules: Vec<Rule> = task
            .operators
            .iter()
            .map(|operator| Rule {
                needs: or_start(operator.preconditions.iter().map(|fact| fact.0).collect()),
                adds: operator.add_effects.iter().map(|fact| fact.0).collect(),
                priced: true,
            })
            .collect();
        let goal = or_start(task.goal.iter().map(|fact| fact.0).collect());
        rules.push(Rule { needs: goal, adds: vec![end], priced: false });
        let mut needed_by = vec![Vec::new(); end as usize + 1];
        let mut added_by = vec![Vec::new(); end as usize + 1];
        for (number, rule) in rules.iter().enumerate() {
            rule.needs.iter().for_each(|&fact| needed_by[fact as usize].push(number as u32));
            rule.adds.iter().for_each(|&fact| added_by[fact as usize].push(number as u32));
        }
        let init = task.init.iter().map(|fact| fact.0).chain([start]).collect();
        Self { rules, init, needed_by, added_by, end }
    }

    /// The operators of the next cut, which then cost nothing; none when the goal costs nothing, or everything.
    fn next_cut(&mut self) -> Option<Vec<OperatorId>> {
        let (cost, supporter) = self.dearest();
        if matches!(cost[self.end as usize], 0 | NONE) {
            return None;
        }
        let goal_zone = self.goal_zone(&supporter);
        let mut reached = vec![false; cost.len()];
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
        cut.iter().for_each(|&number| self.rules[number as usize].priced = false);
        Some(cut.into_iter().map(OperatorId).collect())
    }

    /// For each fact what its dearest precondition, and so on back, costs (h^max); for each rule the precondition
    /// that came last.
    fn dearest(&self) -> (Vec<u32>, Vec<u32>) {
        let mut cost = vec![NONE; self.needed_by.len()];
        let mut done = vec![false; cost.len()];
        let mut supporter = vec![NONE; self.rules.len()];
        let mut missing: Vec<usize> = self.rules.iter().map(|rule| rule.needs.len()).collect();
        let mut queue: VecDeque<u32> = VecDeque::new();
        for &fact in &self.init {
            cost[fact as usize] = 0;
            queue.push_back(fact);
        }
        // Prices are nothing or one: what is found at no price goes to the front, and facts come in order.
        while let Some(fact) = queue.pop_front() {
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
                let reached = cost[fact as usize] + u32::from(rule.priced);
                for &add in &rule.adds {
                    if reached < cost[add as usize] {
                        cost[add as usize] = reached;
                        if rule.priced { queue.push_back(add) } else { queue.push_front(add) }
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
                let free = !self.rules[number as usize].priced && from != NONE;
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
