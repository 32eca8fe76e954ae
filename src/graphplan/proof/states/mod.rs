//! All states, up to exchanges of what is alike: where these are few, no proof is shorter.
//!
//! A step is a parallel one ([`steps`]). Where operators can be undone and few states have the goal, the search goes from
//! both ends ([`both_ends`]), else from what holds at first ([`onward`]).

use self::alike::Alike;
use self::steps::{After, Steps};
use crate::plan::Plan;
use crate::portfolio::relaxed::initial;
use crate::strips::Task;
use crate::{Limit, Limits};

mod ahead;
mod alike;
mod both_ends;
mod onward;
mod packed;
mod steps;
mod undo;

pub(crate) use self::both_ends::BothEnds;
pub(crate) use self::onward::Onward;

/// What so much effort came to.
pub(crate) enum Progress {
    /// Of the fewest steps.
    Plan(Plan),
    /// No state that can be come to has the goal.
    Never,
    Open,
}

/// States are kept in this part of the memory.
const OF_MEMORY: usize = 4;

const NONE: u32 = u32::MAX;

/// A search through all states, of a kind.
pub(crate) trait StateSearch {
    /// Proven: no plan has fewer steps.
    fn at_least(&self) -> usize;

    /// What was spent, in what takes as long as for the solver to set a variable.
    fn effort(&self) -> u64;

    /// It gets such a part of what other ways spend.
    fn share(&self) -> u64;

    fn bytes(&self) -> usize;

    /// Whether nothing more is to be had of it: some state has more ways to go on than can be looked at, or there are too
    /// many states.
    fn is_given_up(&self) -> bool;

    fn give_up(&mut self);

    /// Looks at one state, and tells what that ends with, if with anything.
    fn look(&mut self) -> Option<Progress>;

    /// Goes on until so much effort is spent in all.
    ///
    /// # Errors
    /// Time is up.
    fn go_on(&mut self, effort: u64, limits: &Limits) -> Result<Progress, Limit> {
        const BETWEEN_CHECKS: u32 = 64;
        let mut looked_at = 0_u32;
        while !self.is_given_up() && self.effort() < effort {
            looked_at += 1;
            if looked_at.is_multiple_of(BETWEEN_CHECKS) {
                limits.check(0)?;
                if self.bytes() > limits.memory_bytes / OF_MEMORY {
                    self.give_up();
                    break;
                }
            }
            if let Some(progress) = self.look() {
                return Ok(progress);
            }
        }
        Ok(Progress::Open)
    }
}

/// The states on the way, from the first, stand for others; the way is gone once more from the beginning, from each state
/// to one that the next stands for. None where one has more ways to go on than can be looked at.
fn plan_along<State: AsRef<[u64]>>(
    way: &[State],
    task: &Task,
    steps: &mut Steps<'_>,
    alike: &mut Alike,
) -> Option<Plan> {
    let mut state = initial(task).to_vec();
    let mut plan = Plan { steps: Vec::new() };
    for next in &way[1..] {
        let all = steps.after(&state)?;
        let mut leads_there = |(after, _): &After| {
            let mut after = after.clone();
            alike.represent(&mut after);
            after == next.as_ref()
        };
        let found = all.into_iter().find(|after| leads_there(after));
        let (after, step) = found.expect("alike states go on alike");
        plan.steps.push(step);
        state = after;
    }
    Some(plan)
}
