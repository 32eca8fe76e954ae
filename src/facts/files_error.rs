//! Why a program over files has no result.

use std::path::{Path, PathBuf};

use miette::Diagnostic;
use thiserror::Error;

use super::computed::AskError;
use super::database::FactError;
use super::evaluate::EvaluateError;
use super::fault::Faults;

/// Why a program over files has no result.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum FilesError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Program(#[from] Faults),
    /// A file or folder that cannot be read or written.
    #[error("{path}: {cause}", path = path.display())]
    #[diagnostic(
        code(facts::file),
        help(
            "проверьте имя и права: факты отношения r читаются из r.facts, папка для вывода должна уже быть"
        )
    )]
    File { path: PathBuf, cause: std::io::Error },
    /// A line of facts that does not fit its relation.
    #[error("{path}:{line}: {cause}", path = path.display())]
    #[diagnostic(code(facts::line), help("значения разделяются табуляцией, по одному на столбец"))]
    Line { path: PathBuf, line: usize, cause: Box<FactError> },
    /// A parameter of `.input` or `.output` that asks for what is not done here.
    #[error("«{relation}»: не поддерживается {name}={value}")]
    #[diagnostic(
        code(facts::parameter),
        help(
            "есть IO=file, для .input IO=stdin, для .output IO=stdout, filename, delimiter, headers, rfc4180, для .input columns=\"1:0\""
        )
    )]
    Parameter { relation: String, name: String, value: String },
    #[error(transparent)]
    #[diagnostic(transparent)]
    Evaluate(#[from] EvaluateError),
    /// What comes of `.pragma "magic-transform"`.
    #[error(transparent)]
    #[diagnostic(transparent)]
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
