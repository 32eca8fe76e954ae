//! What can be wrong with a corridor file: every fault with its place.

use std::fmt;

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::units::{Bilingual, EnglishGroup, Fault as _, Language, Source, by_lines, told};

/// One fault of a corridor file.
#[derive(Debug, Clone, PartialEq, Eq, crate::units::Fault)]
#[fault(corridor)]
#[non_exhaustive]
pub enum CorridorFault {
    Syntax {
        message: String,
        at: SourceSpan,
    },

    Notation {
        at: SourceSpan,
    },

    UnknownField {
        field: String,
        hint: Bilingual,
        at: SourceSpan,
    },

    MissingField {
        field: &'static str,
        hint: Bilingual,
        at: SourceSpan,
    },

    WrongValue {
        field: String,
        expected: Bilingual,
        at: SourceSpan,
    },

    UnknownFormat {
        found: i64,
        at: SourceSpan,
    },

    Empty {
        at: SourceSpan,
    },

    RoomAndJunction {
        vertex: u32,
        at: SourceSpan,
    },

    RepeatedEntrance {
        vertex: u32,
        at: SourceSpan,
        first: SourceSpan,
    },

    UndeclaredVertex {
        vertex: u32,
        at: SourceSpan,
    },

    VertexMeetsItself {
        vertex: u32,
        at: SourceSpan,
    },

    AheadNotAtEnd {
        vertex: u32,
        at: SourceSpan,
    },

    JunctionWithoutApproach {
        vertex: u32,
        at: SourceSpan,
    },

    NoSuchWay {
        vertex: u32,
        kind: &'static str,
        way: &'static str,
        ways: String,
        at: SourceSpan,
    },

    NoSuchNeighbour {
        vertex: u32,
        neighbour: i64,
        neighbours: Bilingual,
        at: SourceSpan,
    },

    ArmsDisagree {
        vertex: u32,
        kind: &'static str,
        wanted: usize,
        found: usize,
        neighbours: Bilingual,
        at: SourceSpan,
    },

    AmbiguousArms {
        vertex: u32,
        neighbours: Bilingual,
        at: SourceSpan,
    },

    JunctionDisagrees {
        vertex: u32,
        said: &'static str,
        seen: &'static str,
        at: SourceSpan,
        first: SourceSpan,
    },

    WayDisagrees {
        vertex: u32,
        way: &'static str,
        said: Bilingual,
        seen: Bilingual,
        at: SourceSpan,
    },
}

impl CorridorFault {
    /// Byte offset at which the fault is shown.
    #[must_use]
    pub fn offset(&self) -> usize {
        self.first_span().map_or(0, |span| span.offset())
    }
}

/// A corridor file that cannot be used, with all its faults in the order of the text.
#[derive(Debug, Clone, Error, Diagnostic)]
#[diagnostic(code(corridor::file), help("{}", told!(Language::Russian, "corridor-file-help")))]
pub struct CorridorFileError {
    #[source_code]
    pub source_text: Source,
    #[related]
    pub faults: Vec<CorridorFault>,
}

/// A line per fault: `файл:строка:столбец: что не так`.
impl fmt::Display for CorridorFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Language::Russian))
    }
}

impl CorridorFileError {
    fn told(&self, language: Language) -> String {
        let title = told!(language, "corridor-file", count = self.faults.len());
        by_lines(title, &self.source_text, &self.faults, language)
    }

    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_> {
        EnglishGroup {
            help: Some(told!(Language::English, "corridor-file-help")),
            ..EnglishGroup::new(self, self.told(Language::English), &self.faults)
        }
    }
}
