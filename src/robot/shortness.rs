//! Why no plan has fewer steps, in words: what every plan goes through, and what each goal takes alone (SPEC P6).

use crate::graphplan::{self, Limits};
use crate::strips::{Said, Task, Wording};
use crate::units::{told, word};

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
        let mut lines = vec![told!(language, "why-so-many-steps", steps = self.steps)];
        if self.row.len() > 1 {
            let row: Vec<String> = self.row.iter().map(|fact| wording.fact(fact)).collect();
            let steps = row.len();
            let row = row.join(&word!("then").say(language));
            lines.push(told!(language, "milestones", row, steps));
        }
        for (goal, steps) in &self.alone {
            let goal = wording.fact(goal);
            lines.push(told!(language, "goal-alone", goal, steps));
        }
        let seen = self.alone.iter().map(|(_, steps)| *steps).chain([self.row.len()]).max();
        if seen.unwrap_or(0) < self.steps {
            lines.push(told!(language, "rest-by-search", steps = self.steps));
        }
        lines.join("\n")
    }
}
