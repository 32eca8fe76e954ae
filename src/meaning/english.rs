//! What is wrong with grammar files, in English.

use super::fault::{LangError, LangFault, LangFaults};
use crate::units::{Bilingual, English, EnglishGroup, InEnglish, Language};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

impl InEnglish for LangFault {
    fn english(&self) -> String {
        match &self.error {
            LangError::Syntax { expected, .. } => format!("{} is expected here", en(expected)),
            LangError::Unknown { what, name, .. } => format!("unknown: {} “{name}”", en(what)),
            LangError::Type { name, found, wanted, .. } => {
                format!("“{name}”: {}, and {} is needed", found.1, wanted.1)
            }
            LangError::OneSide { name, .. } => format!("“{name}” stands on one side of “<-” only"),
            LangError::Reserved { word, .. } => {
                format!("“{word}” has a meaning of its own, and cannot be a mere word of a phrase")
            }
            LangError::Forms { word, .. } => format!("nobody knows the forms of the word “{word}”"),
            LangError::NothingRequired { .. } => "nothing in the phrase is required".to_owned(),
            LangError::Twice { .. } => {
                "the same phrase is described already, with another meaning".to_owned()
            }
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match &self.error {
            LangError::Syntax { .. } => "rules/language has examples of lines",
            LangError::Unknown { nearest: Some(near), .. } => {
                return Some(format!("perhaps “{near}”?"));
            }
            LangError::Unknown { nearest: None, .. } => {
                "correct the name, or describe it in a line"
            }
            LangError::Type { .. } => "compare with what this category gives in other lines",
            LangError::OneSide { .. } => {
                "what is named on the right must go into the meaning on the left, else the word would be lost"
            }
            LangError::Reserved { .. } => {
                "name its category, so that negation, number or degree enter the meaning"
            }
            LangError::Forms { .. } => {
                "write them out: один[nom m] | одна[nom f] | одного[gen m n]"
            }
            LangError::NothingRequired { .. } => "remove “?” or “*” from one part at least",
            LangError::Twice { .. } => "keep one of the two lines",
        };
        Some(help.to_owned())
    }
}

impl LangFaults {
    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_, LangFault> {
        EnglishGroup {
            all: self,
            title: format!("faults in the language files: {}", self.faults.len()),
            help: None,
            faults: self.faults.iter().map(English).collect(),
        }
    }
}
