//! A problem grounded within the limits of the search for its plan.

use std::cell::Cell;

use crate::graphplan::{Limit, Limits};
use crate::strips::{Domain, Problem, RuleFaults, Task, ground_while};

/// The task, or the limit that grounding ran into.
pub(super) fn grounded(
    domain: &Domain,
    problem: &Problem,
    limits: &Limits,
) -> Result<Result<Task, Limit>, RuleFaults> {
    let reached = Cell::new(None);
    let may_go_on = |bytes| {
        reached.set(limits.check(bytes).err());
        reached.get().is_none()
    };
    let task = ground_while(domain, problem, &may_go_on)?;
    Ok(task.ok_or_else(|| reached.get().expect("a limit stopped it")))
}
