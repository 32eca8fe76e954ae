//! Warnings about a rule text, in English.

use std::fmt;

use miette::Diagnostic;

use super::fault::{FileFaults, RuleError};
use crate::units::{English, InEnglish, Language};

impl InEnglish for RuleError {
    /// What is no warning is told as it is displayed.
    fn english(&self) -> String {
        match self {
            Self::Hint { what, .. } => format!("{what}: the hint changes nothing here"),
            Self::Wide { number, .. } => {
                format!("the number {number} exceeds 32 bits: Soufflé computes with another")
            }
            Self::Rounded { number, .. } => format!(
                "the number {number} is rounded to six digits: Soufflé's binary fraction differs a little"
            ),
            Self::LongText { limit, .. } => {
                format!("texts over {limit} bytes are not kept: rows with one are passed over")
            }
            Self::Pattern { pattern, .. } => {
                format!("“{pattern}” is no regular expression: nothing matches it")
            }
            Self::NeverUsed { name, .. } => format!("the relation “{name}” is never used"),
            Self::NeverDerived { name, .. } => {
                format!("the relation “{name}” is always empty: nothing derives it")
            }
            Self::NeverFires { why, .. } => {
                format!("the rule never fires: {}", why.say(Language::English))
            }
            Self::Product { one, other, .. } => {
                format!("nothing ties the premises “{one}” and “{other}”: all pairs are tried")
            }
            Self::SingleVariable { variable, .. } => {
                format!("the variable “{variable}” occurs once")
            }
            fault => fault.to_string(),
        }
    }

    fn english_help(&self) -> Option<String> {
        Some(match self {
            Self::Hint { .. } => "the program's result does not depend on it".to_owned(),
            Self::Wide { .. } => "numbers here have 64 bits and never overflow silently".to_owned(),
            Self::Rounded { .. } => "a float here is an exact decimal in millionths".to_owned(),
            Self::LongText { .. } => {
                "a recursive rule with cat lengthens a text for ever; limit it: strlen(x) < 1000"
                    .to_owned()
            }
            Self::NeverUsed { name, .. } => format!("show it: .output {name}"),
            Self::NeverDerived { name, .. } => format!("add a rule, or .input {name}"),
            Self::NeverFires { .. } => "look at this premise".to_owned(),
            Self::Product { .. } => {
                "give them a common variable or a comparison; if all pairs are meant, leave it so"
                    .to_owned()
            }
            Self::SingleVariable { .. } => "write “_” if that is meant".to_owned(),
            fault => return fault.help().map(|help| help.to_string()),
        })
    }

    fn english_labels(&self) -> [&'static str; 2] {
        match self {
            Self::NeverUsed { .. } | Self::NeverDerived { .. } => ["declared here", ""],
            Self::NeverFires { .. } => ["this premise does not hold", ""],
            _ => ["here", ""],
        }
    }
}

/// The warnings of one text in English.
pub struct EnglishWarnings<'f> {
    of: &'f FileFaults,
    told: Vec<English<'f, RuleError>>,
}

impl<'f> From<&'f FileFaults> for EnglishWarnings<'f> {
    fn from(of: &'f FileFaults) -> Self {
        Self { of, told: of.faults.iter().map(English).collect() }
    }
}

impl fmt::Debug for EnglishWarnings<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.of, f)
    }
}

impl fmt::Display for EnglishWarnings<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "“{}”: warnings {}", self.of.source.name(), self.told.len())
    }
}

impl std::error::Error for EnglishWarnings<'_> {}

impl Diagnostic for EnglishWarnings<'_> {
    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        Some(&self.of.source)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.told.iter().map(|fault| fault as &dyn Diagnostic)))
    }
}
