//! A floor as a search for a plan sees it: what it is asked, and what it says.

use crate::graphplan::{Limits, Outcome, Plan};
use crate::strips::{Domain, Problem, Said, Task};
use crate::units::Bilingual;

/// A floor on which plans are driven, as a search for one sees it.
pub(super) trait Passable {
    /// Searches for a plan that can be driven. The task is left without the actions that the floor refuses; where there is
    /// no plan for that reason alone, it is told which.
    fn search(
        &mut self,
        given: (&Domain, &Problem),
        task: &mut Task,
        limits: &Limits,
        search: &mut dyn FnMut(&Task) -> Outcome,
    ) -> Found;

    /// Whether a plan of a task that was searched can be driven, as far as a search would ask.
    fn lets_pass(
        &mut self,
        given: (&Domain, &Problem),
        task: &Task,
        plan: &Plan,
        limits: &Limits,
    ) -> bool;
}

/// What a search came to, and which actions the floor refuses where there is no plan for that reason.
pub(super) type Found = (Outcome, Vec<Refused>);

/// An action that the rules allow and the floor does not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    pub action: Said,
    /// What bars its way, and what would open it; none where the robot's start is not known.
    pub why: Option<Bilingual>,
}

/// The same floor for one search of several.
pub(super) fn again<'f>(floor: &'f mut Option<&mut dyn Passable>) -> Option<&'f mut dyn Passable> {
    match floor {
        Some(floor) => Some(&mut **floor),
        None => None,
    }
}
