//! What is wanted where a goal is out of reach: an atom or its absence, with places that may be open.

use super::domain::{KindSet, PredicateId};
use super::resolve::{GroundAtom, ThingId};

/// An atom, or its absence; open places are any object of the types that are asked for there.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct Wanted {
    pub(super) predicate: PredicateId,
    pub(super) args: Vec<Option<ThingId>>,
    /// For each open place the types of which the object must be one: a parameter's may be narrower than the
    /// predicate's. None where they are all that the predicate takes, or the place is not open.
    pub(super) kinds: Vec<KindSet>,
    pub(super) negated: bool,
}

impl Wanted {
    pub(super) fn of(predicate: PredicateId, args: Vec<Option<ThingId>>) -> Self {
        Self { predicate, kinds: vec![KindSet::new(); args.len()], args, negated: false }
    }

    /// The atom, where no place is open.
    pub(super) fn closed(&self) -> Option<GroundAtom> {
        let args = self.args.iter().copied().collect::<Option<_>>()?;
        Some(GroundAtom { predicate: self.predicate, args })
    }
}
