//! What a level of actions is made of.

use crate::strips::{FactId, OperatorId};

/// An operator of the task, or the no-op of a fact.
#[derive(Debug)]
pub(super) struct Action {
    /// None for a no-op.
    pub(super) operator: Option<OperatorId>,
    pub(super) preconditions: Vec<FactId>,
    pub(super) add_effects: Vec<FactId>,
    /// What it deletes, if only for a moment.
    pub(super) takes: Vec<FactId>,
}
