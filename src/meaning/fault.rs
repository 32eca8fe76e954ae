//! What is wrong with grammar files: all of it at once, each fault with its place.

use std::fmt;

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::language::scan::Unread;
use crate::units::{Bilingual, EnglishGroup, Fault as _, InEnglish, Language, Source, told};

/// One fault of a grammar file. The line in which it stands is left out; the rest works.
#[derive(Debug, Clone, PartialEq, Eq, crate::units::Fault)]
#[fault(language)]
#[non_exhaustive]
pub enum LangError {
    Syntax {
        expected: Bilingual,
        at: SourceSpan,
    },

    Unknown {
        what: Bilingual,
        name: String,
        nearest: Option<String>,
        at: SourceSpan,
    },

    #[fault(code = "language::type_mismatch")]
    Type {
        name: String,
        /// In Russian and in English.
        found: (&'static str, &'static str),
        wanted: (&'static str, &'static str),
        at: SourceSpan,
    },

    OneSide {
        name: String,
        at: SourceSpan,
    },

    Reserved {
        word: String,
        at: SourceSpan,
    },

    Forms {
        word: String,
        at: SourceSpan,
    },

    NothingRequired {
        at: SourceSpan,
    },

    Twice {
        at: SourceSpan,
    },
}

impl From<Unread> for LangError {
    fn from(Unread { expected, at }: Unread) -> Self {
        Self::Syntax { expected, at: at.into() }
    }
}

/// All faults of grammar files, each with its file.
#[derive(Debug, Clone, Error, Diagnostic)]
#[error("{}", self.told(Language::Russian))]
#[diagnostic(code(language::faults))]
pub struct LangFaults {
    #[related]
    pub faults: Vec<LangFault>,
}

/// A fault within its file.
#[derive(Debug, Clone, Error)]
#[error("{error}")]
pub struct LangFault {
    pub error: LangError,
    pub file: Source,
}

impl LangFault {
    /// File, line and column, both from 1, the column in characters.
    #[must_use]
    pub fn place(&self) -> (String, usize, usize) {
        let at = self.error.first_span().map_or(0, |span| span.offset());
        let (line, column) = self.file.position(at);
        (self.file.name().to_owned(), line, column)
    }
}

impl Diagnostic for LangFault {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.code()
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.help()
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = miette::LabeledSpan> + '_>> {
        self.error.labels()
    }
    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        Some(&self.file)
    }
}

impl InEnglish for LangFault {
    fn english(&self) -> String {
        self.error.english()
    }
    fn english_help(&self) -> Option<String> {
        self.error.english_help()
    }
}

impl LangFaults {
    fn told(&self, language: Language) -> String {
        told!(language, "language-faults", count = self.faults.len())
    }

    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_> {
        EnglishGroup::new(self, self.told(Language::English), &self.faults)
    }
}
