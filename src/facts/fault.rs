//! What is wrong with a rule text, all of it at once, each fault with its place.

use std::fmt;

use miette::{Diagnostic, SourceSpan};

use super::limits::MAX_TEXT;
use super::syntax::Span;
use super::word::Note;
use crate::units::{
    Bilingual, EnglishGroup, Fault as _, InEnglish, InOrder as _, Language, Piece, Source, told,
};
use thiserror::Error;

/// Words of a message, in Russian and in English.
pub(super) type Told = Piece;

/// One fault of a rule text, or a warning about it (see [`RuleError::is_warning`]).
#[derive(Debug, Clone, PartialEq, crate::units::Fault)]
#[fault(facts)]
#[non_exhaustive]
pub enum RuleError {
    /// The text is no rule text here.
    Syntax { expected: Bilingual, found: Bilingual, at: SourceSpan },

    /// A character that no word of the language starts with.
    Character { character: char, at: SourceSpan },

    /// A text or a comment that is opened and never closed.
    Unclosed { what: Told, closing: Told, at: SourceSpan },

    /// A number that does not fit into 64 bits.
    Number { text: String, at: SourceSpan },

    /// A part of Soufflé's language that this engine does not have.
    Unsupported { what: Bilingual, help: Told, at: SourceSpan },

    /// What reads well and cannot be meant.
    Misuse { what: Bilingual, help: Told, at: SourceSpan },

    /// The text exceeds one of the limits that keep its reading bounded.
    TooLarge { what: Told, limit: usize, at: SourceSpan },

    /// Two declarations of one name.
    Duplicate { name: String, at: SourceSpan },

    /// A relation that no `.decl` introduces.
    UnknownRelation { name: String, nearest: Option<String>, at: SourceSpan },

    /// A type that no `.type` introduces.
    UnknownType { name: String, nearest: Option<String>, at: SourceSpan },

    /// A component that no `.comp` introduces.
    UnknownComponent { name: String, nearest: Option<String>, at: SourceSpan },

    /// A branch or a record of no known type.
    Record { what: String, at: SourceSpan },

    /// What is read and has no effect here.
    #[fault(warning)]
    Hint { what: String, at: SourceSpan },

    /// A number of the text that Soufflé would take for another.
    #[fault(warning)]
    Wide { number: i64, at: SourceSpan },

    /// A number that Soufflé would compute as a binary fraction.
    #[fault(warning)]
    Rounded { number: String, at: SourceSpan },

    /// A rule joins texts to one that is too long to be kept.
    #[fault(warning)]
    LongText { limit: usize, at: SourceSpan },

    /// A regular expression that matches nothing because it is none.
    #[fault(warning)]
    Pattern { pattern: String, why: String, at: SourceSpan },

    /// A number that no unsigned one is.
    Unsigned { text: String, at: SourceSpan },

    /// A relation or functor with a wrong number of arguments.
    Arity { name: String, expected: usize, found: usize, at: SourceSpan },

    /// A value of one type where another is wanted.
    Types { what: String, expected: String, found: Bilingual, at: SourceSpan },

    /// A variable that no positive premise gives a value.
    Ungrounded { variable: String, at: SourceSpan },

    /// `_` where a value is needed.
    Wildcard { at: SourceSpan },

    /// A relation that depends on its own negation or aggregate.
    Cycle { cycle: Bilingual, at: SourceSpan },

    /// A relation that no rule reads and nobody outside sees.
    #[fault(warning)]
    NeverUsed { name: String, at: SourceSpan },

    /// A relation that is read, but that no fact, rule or input fills.
    #[fault(warning)]
    NeverDerived { name: String, at: SourceSpan },

    /// A rule of which some premise never holds.
    #[fault(warning)]
    NeverFires { why: Bilingual, at: SourceSpan },

    /// Premises that nothing ties: all pairs are tried.
    #[fault(warning)]
    Product { one: String, other: String, at: SourceSpan },

    /// A variable that occurs once; often a slip of the pen.
    #[fault(warning)]
    SingleVariable { variable: String, at: SourceSpan },
}

impl RuleError {
    /// A warning does not keep the program from running.
    #[must_use]
    pub fn is_warning(&self) -> bool {
        crate::units::Fault::is_warning(self)
    }

    /// Where in its text.
    #[must_use]
    pub fn span(&self) -> SourceSpan {
        self.first_span().expect("each of them stands somewhere in the text")
    }
}

impl Note {
    /// The note as a warning about what stands there.
    pub(super) fn told(self, at: Span) -> RuleError {
        let at = at.into();
        match self {
            Self::Wide(number) => RuleError::Wide { number, at },
            Self::Rounded(number) => RuleError::Rounded { number: number.to_string(), at },
            Self::LongText => RuleError::LongText { limit: MAX_TEXT, at },
        }
    }
}

/// The faults of one text.
#[derive(Debug, Clone)]
pub struct FileFaults {
    pub source: Source,
    pub faults: Vec<RuleError>,
}

impl FileFaults {
    /// Line and character column of each fault, both from 1, in the order of the text.
    pub fn placed(&self) -> impl Iterator<Item = (usize, usize, &RuleError)> {
        self.faults.iter().map(|fault| {
            let (line, column) = self.source.position(fault.span().offset());
            (line, column, fault)
        })
    }
}

/// What is drawn above the faults themselves, each of which comes with its lines.
impl fmt::Display for FileFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Language::Russian))
    }
}

impl FileFaults {
    fn told(&self, language: Language) -> String {
        let warnings = self.faults.iter().filter(|fault| fault.is_warning()).count();
        let errors = self.faults.len() - warnings;
        told!(language, "facts-in-file", name = self.source.name(), errors, warnings)
    }

    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_> {
        EnglishGroup::new(self, self.told(Language::English), &self.faults)
    }
}

impl std::error::Error for FileFaults {}

impl Diagnostic for FileFaults {
    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        Some(&self.source)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.faults.iter().map(|fault| fault as &dyn Diagnostic)))
    }
}

/// All faults of all texts of a program; never empty.
#[derive(Debug, Clone, Error, Diagnostic)]
#[error("{}", self.told(Language::Russian))]
#[diagnostic(code(facts::program))]
pub struct Faults {
    #[related]
    pub files: Vec<FileFaults>,
}

impl Faults {
    /// Every fault, file by file.
    pub fn iter(&self) -> impl Iterator<Item = &RuleError> {
        self.files.iter().flat_map(|file| &file.faults)
    }
}

impl Faults {
    /// One fault with its place; of several their number and the first.
    fn told(&self, language: Language) -> String {
        let mut all = self.files.iter().flat_map(|file| {
            file.placed().map(|(line, column, fault)| {
                format!("{}:{line}:{column}: {}", file.source.name(), fault.tell(language))
            })
        });
        let first = all.next().unwrap_or_default();
        match all.count() {
            0 => first,
            more => told!(language, "facts-faults", count = more + 1, first),
        }
    }

    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_> {
        EnglishGroup {
            all: self,
            title: self.told(Language::English),
            help: None,
            faults: self.files.iter().map(|file| Box::new(file.in_english()) as _).collect(),
        }
    }
}

impl InEnglish for Faults {
    fn english(&self) -> String {
        self.told(Language::English)
    }
    fn english_help(&self) -> Option<String> {
        None
    }
}

/// Faults with the number of their text.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) all: Vec<(u32, RuleError)>,
}

impl Found {
    pub(super) fn push(&mut self, at: Span, fault: RuleError) {
        // A rule with several heads is checked once for each.
        if !self.all.iter().rev().take(16).any(|(file, known)| *file == at.file && *known == fault)
        {
            self.all.push((at.file, fault));
        }
    }
}

pub(super) fn by_file(sources: &[Source], mut faults: Vec<(u32, RuleError)>) -> Vec<FileFaults> {
    faults.order_by_key(|(file, fault)| (*file, fault.span().offset()));
    let mut files: Vec<(u32, FileFaults)> = Vec::new();
    for (file, fault) in faults {
        match files.last_mut() {
            Some((last, here)) if *last == file => here.faults.push(fault),
            _ => {
                let source = sources[file as usize].clone();
                files.push((file, FileFaults { source, faults: vec![fault] }));
            }
        }
    }
    files.into_iter().map(|(_, file)| file).collect()
}
