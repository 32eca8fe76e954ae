//! Why a foreign file gives no map at all: [`ImportError`].

use miette::SourceSpan;

use super::{ReadError, Report};
use crate::map::MapErrors;
use crate::units::{Bilingual, Source};

/// A foreign file of which nothing can be made. What can be mended or left out is in the [`Report`] instead.
#[derive(Debug, crate::units::Fault)]
#[fault(import)]
#[non_exhaustive]
pub enum ImportError {
    /// The file itself cannot be read.
    #[fault(transparent)]
    Read(#[from] Box<ReadError>),

    /// More of something than any building needs.
    Limit { what: Bilingual, count: usize, limit: usize },

    /// None of the formats.
    UnknownFormat { path: String, known: String },

    /// The notation is sound, but this is no building.
    Content { format: &'static str, message: Bilingual, help: Bilingual },

    /// A second file is needed.
    NoAssets { wanted: String },

    /// The synonym table is broken.
    Synonyms {
        message: Bilingual,
        #[source_code]
        text: Source,
        at: Option<SourceSpan>,
    },

    /// Something was mended or left out, and that was not wanted.
    Strict { mended: usize, skipped: usize, report: Box<Report> },

    /// The map file itself, or what the assembler made, does not pass the checks.
    #[fault(transparent)]
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
