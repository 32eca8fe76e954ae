//! What is wrong with grammar files: all of it at once, each fault with its place.

use std::fmt;

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::language::scan::Unread;
use crate::units::{Bilingual, Source};

/// One fault of a grammar file. The line in which it stands is left out; the rest works.
#[derive(Debug, Clone, PartialEq, Eq, Error, Diagnostic)]
#[non_exhaustive]
pub enum LangError {
    #[error("здесь ожидается {expected}")]
    #[diagnostic(code(language::syntax), help("образцы строк стоят в rules/language"))]
    Syntax {
        expected: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },
    #[error("неизвестно: {what} «{name}»")]
    #[diagnostic(code(language::unknown), help("{}", nearest.as_ref().map_or_else(
        || "исправьте имя или опишите его строкой".to_owned(), |n| format!("может быть, «{n}»?"))))]
    Unknown {
        what: Bilingual,
        name: String,
        nearest: Option<String>,
        #[label("здесь")]
        at: SourceSpan,
    },
    #[error("«{name}»: {}, а нужно {}", found.0, wanted.0)]
    #[diagnostic(
        code(language::type_mismatch),
        help("сверьте с тем, что даёт эта категория в других строках")
    )]
    Type {
        name: String,
        /// In Russian and in English.
        found: (&'static str, &'static str),
        wanted: (&'static str, &'static str),
        #[label("здесь")]
        at: SourceSpan,
    },
    #[error("«{name}» стоит только с одной стороны от «<-»")]
    #[diagnostic(
        code(language::one_side),
        help("что названо справа, должно войти в смысл слева, иначе слово пропало бы")
    )]
    OneSide {
        name: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    #[error("«{word}» – слово с собственным смыслом и не может быть просто словом оборота")]
    #[diagnostic(
        code(language::reserved),
        help("назовите его категорию, чтобы отрицание, число или степень вошли в смысл")
    )]
    Reserved {
        word: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    #[error("форм слова «{word}» никто не знает")]
    #[diagnostic(
        code(language::forms),
        help("выпишите его формы: один[nom m] | одна[nom f] | одного[gen m n]")
    )]
    Forms {
        word: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    #[error("в обороте нет ничего обязательного")]
    #[diagnostic(
        code(language::nothing_required),
        help("уберите «?» или «*» хотя бы у одной части")
    )]
    NothingRequired {
        #[label("здесь")]
        at: SourceSpan,
    },
    #[error("тот же оборот уже описан, с другим смыслом")]
    #[diagnostic(code(language::twice), help("оставьте одну из двух строк"))]
    Twice {
        #[label("здесь")]
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
#[error("{}", self.told())]
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
        let at = self.error.labels().and_then(|mut all| all.next()).map_or(0, |l| l.offset());
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

impl LangFaults {
    fn told(&self) -> String {
        format!("в файлах языка ошибок: {}", self.faults.len())
    }
}
