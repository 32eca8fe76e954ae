//! A plan found soon gets better for as long as it may: rounds in which it is made of fewer actions stretch by stretch, is
//! sought anew by fewer, and is made of fewer steps.

use super::fewer::Stretches;
use super::landmarks::Landmarks;
use super::parallel::has_less;
use super::restarts::Restarts;
use crate::Limits;
use crate::plan::Plan;
use crate::strips::Task;

/// What each part of the first round may take; of the next twice as much, to the most.
const FIRST_EFFORT: u64 = 1 << 16;
const MOST_EFFORT: u64 = 1 << 22;

/// Facts and operators of relaxed plans that are looked at while the solver sets one variable.
const LOOKS: u64 = 32;

/// Plans that are made of fewer actions at the same time: one may come to less though it has more at first.
const WAYS: usize = 2;

/// What makes of a plan one of fewer steps and no more actions, and takes what that takes from the effort allowed.
pub(crate) type FewerSteps = fn(&Task, Plan, &Limits, &mut u64) -> Plan;

/// A plan of no more actions, no dearer, with less of actions and steps together, as far as [`Limits::shorten_effort`] goes.
pub(crate) fn shortened(
    task: &Task,
    plan: Plan,
    limits: &Limits,
    fewer_steps: Option<FewerSteps>,
) -> Plan {
    // How few steps there can be is still to be proven.
    let limits = &limits.with_time_to_spare();
    let mut best = plan.clone();
    let offer = |best: &mut Plan, plan: &Plan| {
        if has_less(task, plan, best) {
            *best = plan.clone();
            limits.tell_of(best);
        }
    };
    let mut ways = vec![Stretches::of(task, plan, limits)];
    let mut as_short = Plan { steps: Vec::new() };
    let landmarks = Landmarks::of(task);
    let mut anew = Some(Restarts::of(task, landmarks.as_ref(), limits));
    let (mut effort, mut left) = (FIRST_EFFORT, limits.shorten_effort);
    while left > 0 && limits.check(0).is_ok() {
        let mut turn = |looks: u64, part: &mut dyn FnMut(&mut u64)| {
            let most = effort.min(left);
            let mut share = most.saturating_mul(looks);
            part(&mut share);
            left -= most - share / looks;
        };
        ways.retain_mut(|way| {
            let mut is_open = true;
            turn(LOOKS, &mut |share| is_open = way.go_on(share));
            offer(&mut best, way.best());
            is_open
        });
        let mut found = Ok((None, false));
        if let Some(search) = &mut anew {
            turn(LOOKS, &mut |share| found = search.go_on(share, best.action_count()));
        }
        if !matches!(found, Ok((_, true))) {
            anew = None;
        }
        if let Ok((Some(other), _)) = found {
            offer(&mut best, &other);
            ways.push(Stretches::of(task, other, limits));
            ways.sort_by_key(|way| way.best().action_count());
            ways.truncate(WAYS);
        }
        if let Some(fewer_steps) = fewer_steps
            && best != as_short
        {
            let within = Limits { tell: None, ..limits.clone() };
            let mut shorter = best.clone();
            turn(1, &mut |share| shorter = fewer_steps(task, best.clone(), &within, share));
            offer(&mut best, &shorter);
            as_short.clone_from(&best);
        }
        if ways.is_empty() && anew.is_none() {
            break;
        }
        effort = (2 * effort).min(MOST_EFFORT);
    }
    best
}
