//! Why no plan has fewer steps, in words: what every plan goes through, and what each goal takes alone (SPEC P6).

use crate::graphplan::{self, Limits};
use crate::strips::{Said, Task, Wording};

use super::solve::Solved;

/// Each goal alone is solved once more: of more goals than these nobody reads it.
const MOST_GOALS: usize = 12;

/// Why a plan that is proven to have the fewest steps has so many.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shortness {
    pub steps: usize,
    /// Facts that hold for the first time one after the other in every plan.
    pub row: Vec<Said>,
    /// What each of several goals takes when it is the only one; those that a limit left open are left out.
    pub alone: Vec<(Said, usize)>,
}

impl Solved {
    /// Why there is no plan of fewer steps. None where there is no plan, or none that is proven to have the fewest steps.
    #[must_use]
    pub fn why_not_shorter(&self, limits: &Limits) -> Option<Shortness> {
        let plan = self.outcome.plan().filter(|plan| self.is_shortest && !plan.steps.is_empty())?;
        let task = &self.task;
        let said = |fact| Said::from(task.fact(fact));
        let goals: Vec<_> = task.goal.iter().filter(|goal| !task.init.contains(goal)).collect();
        let several = task.goal_steps == 0 && (2..=MOST_GOALS).contains(&goals.len());
        let quiet = limits.quiet();
        let alone = goals.iter().filter(|_| several).filter_map(|&&goal| {
            let only = Task { goal: vec![goal], ..task.clone() };
            let steps = graphplan::solve(&only, &quiet).plan()?.steps.len();
            Some((said(goal), steps))
        });
        let row = graphplan::milestones(task);
        let row = row.into_iter().filter(|_| task.goal_steps == 0).map(said).collect();
        Some(Shortness { steps: plan.steps.len(), row, alone: alone.collect() })
    }
}

impl Shortness {
    #[must_use]
    pub fn in_words(&self, wording: &Wording<'_>) -> String {
        let language = wording.language;
        let mut lines = vec![language.pick(
            format!("Почему шагов не меньше {}:", self.steps),
            format!("Why there are no fewer than {}:", steps_in_english(self.steps)),
        )];
        if self.row.len() > 1 {
            let row: Vec<String> = self.row.iter().map(|fact| wording.fact(fact)).collect();
            lines.push(language.pick(
                format!(
                    "  в любом плане одно за другим становится так: {}; это уже {}",
                    row.join(", затем "),
                    count_in_russian(row.len()),
                ),
                format!(
                    "  in every plan it comes to be, one after the other, that {}: that is {} at least",
                    row.join(", then that "),
                    steps_in_english(row.len()),
                ),
            ));
        }
        for (goal, steps) in &self.alone {
            let goal = wording.fact(goal);
            lines.push(language.pick(
                format!("  цель {goal} одна требует: {}", count_in_russian(*steps)),
                format!("  the goal that {goal} takes {} alone", steps_in_english(*steps)),
            ));
        }
        let seen = self.alone.iter().map(|(_, steps)| *steps).chain([self.row.len()]).max();
        if seen.unwrap_or(0) < self.steps {
            lines.push(language.pick(
                format!("  остальное доказал поиск: все планы короче {} исключены", self.steps),
                format!(
                    "  the rest is proven by search: all plans shorter than {} are ruled out",
                    self.steps
                ),
            ));
        }
        lines.join("\n")
    }
}

fn steps_in_english(steps: usize) -> String {
    if steps == 1 { "1 step".to_owned() } else { format!("{steps} steps") }
}

fn count_in_russian(steps: usize) -> String {
    let word = match (steps % 10, steps % 100) {
        (1, hundred) if hundred != 11 => "шаг",
        (2..=4, 10..=20) => "шагов",
        (2..=4, _) => "шага",
        _ => "шагов",
    };
    format!("{steps} {word}")
}
