//! Why there are no relations, in English.

use miette::Diagnostic;

use crate::relations::{MAX_FILE_BYTES, RelationError};
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

impl InEnglish for RelationError {
    fn english(&self) -> String {
        match self {
            Self::Unreadable { path, message } => {
                format!("the rule file “{path}” cannot be read: {}", message.say(Language::English))
            }
            Self::TooLarge { path, bytes } => format!(
                "the rule file “{path}” is too large: {bytes} bytes, and the limit is {MAX_FILE_BYTES}"
            ),
            Self::Empty { path } => format!("the rule file “{path}” is empty"),
            Self::Rules(faults) => faults.in_english().to_string(),
            Self::Schema { fault } => fault.english(),
            Self::Thresholds { faults } => {
                faults.first().map(InEnglish::english).unwrap_or_default()
            }
            Self::Evaluate(error) => error.english(),
            Self::UnknownRelation { name, .. } => format!("there is no relation “{name}”"),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Unreadable { .. } => "check the path and the permissions; the file must be UTF-8",
            Self::TooLarge { .. } => {
                "rules are a text that a person wrote; see whether this is the right file"
            }
            Self::Empty { .. } => "remove it, and the rules of the program itself hold",
            Self::Schema { .. } => {
                "what is measured is declared in rules/relations.dl; its columns cannot be changed"
            }
            Self::Rules(_) | Self::Thresholds { .. } => return None,
            Self::Evaluate(error) => return error.english_help(),
            Self::UnknownRelation { nearest: Some(near), .. } => {
                return Some(format!("perhaps “{near}”?"));
            }
            Self::UnknownRelation { nearest: None, .. } => {
                "the names of relations stand in rules/relations.dl"
            }
        };
        Some(help.to_owned())
    }
}

impl RelationError {
    /// The faults as English tells them, each with its place.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Rules(faults) => Box::new(faults.in_english()),
            Self::Thresholds { faults } => Box::new(EnglishGroup {
                all: self,
                title: self.english(),
                help: None,
                faults: faults.iter().map(English).collect(),
            }),
            other => Box::new(English(other)),
        }
    }
}
