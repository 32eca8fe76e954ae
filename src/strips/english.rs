//! What is wrong with a given plan, or with what is to be withdrawn, in English: a task in English meets no other faults.

use super::error::RuleError;

impl RuleError {
    /// The fault in English; none for one that only whoever writes rules meets.
    #[must_use]
    pub fn english(&self) -> Option<String> {
        let not = |fact: &str| match fact.strip_prefix("НЕ ") {
            Some(fact) => format!("NOT {fact}"),
            None => fact.to_owned(),
        };
        Some(match self {
            Self::UnknownAction { name, .. } => format!("unknown action “{name}”"),
            Self::UnknownObject { name, .. } => format!("unknown object “{name}”"),
            Self::WrongObject { name, expected, .. } => {
                format!("“{name}” does not fit: an object of type “{expected}” is due here")
            }
            Self::Arity { name, expected, found, .. } => {
                format!("“{name}” takes {expected} arguments, and {found} are given")
            }
            Self::PlanPrecondition { fact, .. } => {
                format!("the action cannot be carried out: it takes {}", not(fact))
            }
            Self::PlanInterference { fact, other, .. } => format!(
                "two actions of one step disturb each other: because of {} it does not go with “{other}”",
                not(fact)
            ),
            Self::PlanMissesGoal { fact } => {
                format!("in the end the goal {} does not hold", not(fact))
            }
            _ => return None,
        })
    }
}
