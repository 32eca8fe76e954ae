//! Why a program over files has no result.

use std::path::{Path, PathBuf};

use miette::Diagnostic;

use super::computed::AskError;
use super::database::FactError;
use super::evaluate::EvaluateError;
use super::fault::Faults;
use crate::units::English;

/// Why a program over files has no result.
#[derive(Debug, crate::units::Fault)]
#[fault(facts)]
#[non_exhaustive]
pub enum FilesError {
    #[fault(transparent)]
    Program(#[from] Faults),

    /// A file or folder that cannot be read or written.
    File { path: PathBuf, cause: std::io::Error },

    /// A line of facts that does not fit its relation.
    Line { path: PathBuf, line: usize, cause: Box<FactError> },

    /// A parameter of `.input` or `.output` that asks for what is not done here.
    Parameter { relation: String, name: String, value: String },

    #[fault(transparent)]
    Evaluate(#[from] EvaluateError),

    /// What comes of `.pragma "magic-transform"`.
    #[fault(transparent)]
    Ask(AskError),
}

impl From<AskError> for FilesError {
    fn from(error: AskError) -> Self {
        match error {
            AskError::Evaluate(error) => Self::Evaluate(error),
            other => Self::Ask(other),
        }
    }
}

pub(super) fn file_error(path: &Path, cause: std::io::Error) -> FilesError {
    FilesError::File { path: path.to_owned(), cause }
}

impl FilesError {
    /// The faults as English tells them, each with its place.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Program(faults) => Box::new(faults.in_english()),
            Self::Ask(error) => error.in_english(),
            other => Box::new(English(other)),
        }
    }
}
