//! Why there are no relations, in English.

use miette::Diagnostic;

use crate::relations::RelationError;
use crate::units::{English, EnglishGroup, InEnglish};

impl RelationError {
    /// The faults as English tells them, each with its place.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Rules(faults) => Box::new(faults.in_english()),
            Self::Thresholds { faults, .. } => {
                Box::new(EnglishGroup::new(self, self.english(), faults))
            }
            other => Box::new(English(other)),
        }
    }
}
