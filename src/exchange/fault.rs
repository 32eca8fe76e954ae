//! Why a foreign file gives no map at all: [`ImportError`].

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use super::{ReadError, Report};
use crate::map::MapErrors;
use crate::units::{Bilingual, Source};

/// A foreign file of which nothing can be made. What can be mended or left out is in the [`Report`] instead.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum ImportError {
    /// The file itself cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Read(#[from] Box<ReadError>),
    /// More of something than any building needs.
    #[error("{what}: {count} при пределе {limit}")]
    #[diagnostic(code(import::limit), help("разделите здание на несколько файлов"))]
    Limit { what: Bilingual, count: usize, limit: usize },
    /// None of the formats.
    #[error("формат файла «{path}» не распознан")]
    #[diagnostic(
        code(import::unknown_format),
        help("читаются: {known}; формат можно назвать: --format")
    )]
    UnknownFormat { path: String, known: String },
    /// The notation is sound, but this is no building.
    #[error("{format}: {message}")]
    #[diagnostic(code(import::content), help("{help}"))]
    Content { format: &'static str, message: Bilingual, help: Bilingual },
    /// A second file is needed.
    #[error("не найден файл размеров: {wanted}")]
    #[diagnostic(code(import::no_assets), help("назовите его: --assets ФАЙЛ"))]
    NoAssets { wanted: String },
    /// The synonym table is broken.
    #[error("таблица синонимов: {message}")]
    #[diagnostic(code(import::synonyms), help("образец - rules/import-synonyms.toml"))]
    Synonyms {
        message: Bilingual,
        #[source_code]
        text: Source,
        #[label("здесь")]
        at: Option<SourceSpan>,
    },
    /// Something was mended or left out, and that was not wanted.
    #[error(
        "строгий импорт: исправлено {mended}, пропущено {skipped}",
        mended = .report.count(super::Treatment::Mended),
        skipped = .report.count(super::Treatment::Skipped)
    )]
    #[diagnostic(
        code(import::strict),
        help("исправьте файл или импортируйте без --strict\n{report}")
    )]
    Strict { report: Box<Report> },
    /// The map file itself, or what the assembler made, does not pass the checks.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Map(#[from] MapErrors),
}

impl From<ReadError> for ImportError {
    fn from(error: ReadError) -> Self {
        Self::Read(Box::new(error))
    }
}

impl ImportError {
    /// A file that reads well and holds no building.
    #[must_use]
    pub fn content(
        format: &'static str,
        message: impl Into<Bilingual>,
        help: impl Into<Bilingual>,
    ) -> Self {
        Self::Content { format, message: message.into(), help: help.into() }
    }
}
