//! What can be wrong with a log.

use std::fmt;

use miette::{Diagnostic, SourceSpan};
use orthoframe_units::{EnglishGroup, Fault as _, Language, Source, by_lines, told};
use thiserror::Error;

use crate::scan::SensorError;

/// One fault of a log, at its place.
#[derive(Debug, Clone, PartialEq, orthoframe_units::Fault)]
#[fault(vectors)]
#[non_exhaustive]
pub enum LogFault {
    #[fault(code = "vectors::log_unknown")]
    Unknown { at: SourceSpan },

    #[fault(code = "vectors::log_empty")]
    Empty { at: SourceSpan },

    #[fault(code = "vectors::log_not_number")]
    NotNumber { found: String, at: SourceSpan },

    #[fault(code = "vectors::log_no_place")]
    NoPlace { found: String, at: SourceSpan },

    #[fault(code = "vectors::log_beams")]
    Beams { found: String, at: SourceSpan },

    #[fault(code = "vectors::log_field")]
    Field { count: usize, at: SourceSpan },

    #[fault(code = "vectors::log_cut")]
    CutOff { found: usize, needed: usize, at: SourceSpan },

    #[fault(code = "vectors::log_too_long")]
    TooLong { found: usize, needed: usize, at: SourceSpan },

    #[fault(code = "vectors::log_no_message")]
    NoMessage { found: String, at: SourceSpan },

    #[fault(code = "vectors::log_column_twice")]
    Twice { column: String, at: SourceSpan },

    #[fault(code = "vectors::log_unit")]
    Unit { found: String, at: SourceSpan },

    #[fault(code = "vectors::log_heading")]
    NoColumn { column: String, at: SourceSpan },

    #[fault(code = "vectors::log_sensor")]
    Sensor { fault: SensorError, at: SourceSpan },
}

impl LogFault {
    /// Byte offset at which the fault is shown.
    #[must_use]
    pub fn offset(&self) -> usize {
        self.first_span().map_or(0, |span| span.offset())
    }
}

/// A log with faults, in the order of the text.
#[derive(Debug, Clone, Error, Diagnostic)]
#[diagnostic(code(vectors::log), help("{}", told!(Language::Russian, "vectors-log-help")))]
pub struct LogError {
    #[source_code]
    pub source_text: Source,
    #[related]
    pub faults: Vec<LogFault>,
    /// Further faults that are only counted.
    pub more: usize,
}

/// A line per fault: `файл:строка:столбец: что не так`.
impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Language::Russian))
    }
}

impl LogError {
    fn told(&self, language: Language) -> String {
        let title = told!(language, "vectors-log", count = self.faults.len() + self.more);
        by_lines(title, &self.source_text, &self.faults, language)
    }

    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_> {
        EnglishGroup {
            help: Some(told!(Language::English, "vectors-log-help")),
            ..EnglishGroup::new(self, self.told(Language::English), &self.faults)
        }
    }
}
