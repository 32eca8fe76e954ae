//! Why there are no relations, in English.

use miette::Diagnostic;

use crate::relations::RelationError;
use crate::thresholds::ThresholdFault;
use crate::units::{English, EnglishGroup, InEnglish, Language};

impl InEnglish for ThresholdFault {
    fn english(&self) -> String {
        self.message.say(Language::English).to_owned()
    }

    fn english_help(&self) -> Option<String> {
        Some(self.help.say(Language::English).to_owned())
    }
}

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
