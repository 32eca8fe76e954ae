//! What is wrong with a rule text, all of it at once, each fault with its place.

use std::fmt;

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use super::limits::MAX_TEXT;
use super::syntax::Span;
use super::word::Note;
use crate::units::{Bilingual, InOrder as _, Source};

/// Words of a message, in Russian and in English.
pub(super) type Told = (&'static str, &'static str);

/// One fault of a rule text, or a warning about it (see [`RuleError::is_warning`]).
#[derive(Debug, Clone, PartialEq, Error, Diagnostic)]
#[non_exhaustive]
pub enum RuleError {
    /// The text is no rule text here.
    #[error("здесь ожидается {expected}, а стоит {found}")]
    #[diagnostic(code(facts::syntax))]
    Syntax {
        expected: Bilingual,
        found: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A character that no word of the language starts with.
    #[error("символ «{character}» здесь ничего не значит")]
    #[diagnostic(code(facts::character), help("строки пишутся в двойных кавычках"))]
    Character {
        character: char,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A text or a comment that is opened and never closed.
    #[error("{} не закрыт", .what.0)]
    #[diagnostic(code(facts::unclosed), help("поставьте {}", closing.0))]
    Unclosed {
        what: Told,
        closing: Told,
        #[label("открыт здесь")]
        at: SourceSpan,
    },
    /// A number that does not fit into 64 bits.
    #[error("число «{text}» не помещается в 64 бита")]
    #[diagnostic(code(facts::number))]
    Number {
        text: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A part of Soufflé's language that this engine does not have.
    #[error("не поддерживается: {what}")]
    #[diagnostic(code(facts::unsupported), help("{}", help.0))]
    Unsupported {
        what: Bilingual,
        help: Told,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// What reads well and cannot be meant.
    #[error("{what}")]
    #[diagnostic(code(facts::misuse), help("{}", help.0))]
    Misuse {
        what: Bilingual,
        help: Told,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// The text exceeds one of the limits that keep its reading bounded.
    #[error("{}: больше {limit}", .what.0)]
    #[diagnostic(code(facts::too_large), help("разбейте на несколько правил или отношений"))]
    TooLarge {
        what: Told,
        limit: usize,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// Two declarations of one name.
    #[error("«{name}» объявлено дважды")]
    #[diagnostic(code(facts::duplicate), help("оставьте одно объявление"))]
    Duplicate {
        name: String,
        #[label("второе объявление")]
        at: SourceSpan,
    },
    /// A relation that no `.decl` introduces.
    #[error("неизвестное отношение «{name}»")]
    #[diagnostic(code(facts::unknown_relation), help("{}", did_you_mean(nearest.as_deref(), "объявите его: .decl")))]
    UnknownRelation {
        name: String,
        nearest: Option<String>,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A type that no `.type` introduces.
    #[error("неизвестный тип «{name}»")]
    #[diagnostic(code(facts::unknown_type), help("{}", did_you_mean(nearest.as_deref(), "есть symbol, number, unsigned и объявленные: .type")))]
    UnknownType {
        name: String,
        nearest: Option<String>,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A component that no `.comp` introduces.
    #[error("неизвестный компонент «{name}»")]
    #[diagnostic(code(facts::unknown_component), help("{}", did_you_mean(nearest.as_deref(), "опишите его: .comp")))]
    UnknownComponent {
        name: String,
        nearest: Option<String>,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A branch or a record of no known type.
    #[error("у записи здесь нет известного типа: {what}")]
    #[diagnostic(
        code(facts::record),
        help("тип даёт столбец отношения, имя варианта ($Имя) или as([…], Тип)")
    )]
    Record {
        what: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// What is read and has no effect here.
    #[error("{what}: подсказка здесь ни на что не влияет")]
    #[diagnostic(code(facts::hint), severity(Warning), help("итог программы от неё не зависит"))]
    Hint {
        what: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A number of the text that Soufflé would take for another.
    #[error("число {number} не помещается в 32 бита: Soufflé посчитает с ним иначе")]
    #[diagnostic(
        code(facts::wide),
        severity(Warning),
        help("здесь числа 64-битные и не переполняются молча")
    )]
    Wide {
        number: i64,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A number that Soufflé would compute as a binary fraction.
    #[error("число {number} округлено до шести знаков: двоичная дробь Soufflé чуть другая")]
    #[diagnostic(
        code(facts::rounded),
        severity(Warning),
        help("float здесь – точная десятичная дробь в миллионных долях")
    )]
    Rounded {
        number: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A rule joins texts to one that is too long to be kept.
    #[error("текст длиннее {limit} байт не хранится: строки с ним пропущены")]
    #[diagnostic(
        code(facts::long_text),
        severity(Warning),
        help("рекурсивное правило с cat растит текст без конца; ограничьте его: strlen(x) < 1000")
    )]
    LongText {
        limit: usize,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A regular expression that matches nothing because it is none.
    #[error("«{pattern}» – не регулярное выражение: ничто ему не отвечает")]
    #[diagnostic(code(facts::pattern), severity(Warning), help("{why}"))]
    Pattern {
        pattern: String,
        why: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A number that no unsigned one is.
    #[error("число «{text}» не помещается в 32 бита без знака")]
    #[diagnostic(code(facts::unsigned), help("unsigned – от 0 до 4294967295"))]
    Unsigned {
        text: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A relation or functor with a wrong number of arguments.
    #[error("у «{name}» аргументов {expected}, а дано {found}")]
    #[diagnostic(code(facts::arity), help("сверьтесь с объявлением «{name}»"))]
    Arity {
        name: String,
        expected: usize,
        found: usize,
        #[label("дано {found}")]
        at: SourceSpan,
    },
    /// A value of one type where another is wanted.
    #[error("«{what}»: нужен тип {expected}, а здесь {found}")]
    #[diagnostic(
        code(facts::types),
        help("числа пишутся без кавычек, строки — в кавычках; to_number и to_string переводят")
    )]
    Types {
        what: String,
        expected: String,
        found: Bilingual,
        #[label("тип {found}")]
        at: SourceSpan,
    },
    /// A variable that no positive premise gives a value.
    #[error("переменная «{variable}» ничем не связана")]
    #[diagnostic(
        code(facts::ungrounded),
        help("назовите её в утвердительной посылке правила или приравняйте к известному")
    )]
    Ungrounded {
        variable: String,
        #[label("нет значения")]
        at: SourceSpan,
    },
    /// `_` where a value is needed.
    #[error("«_» стоит там, где нужно значение")]
    #[diagnostic(code(facts::wildcard), help("«_» годится только в посылках, на месте аргумента"))]
    Wildcard {
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A relation that depends on its own negation or aggregate.
    #[error("отношение зависит от собственного отрицания или счёта: {cycle}")]
    #[diagnostic(
        code(facts::cycle),
        help("разорвите круг: отрицать и считать можно только выведенное раньше")
    )]
    Cycle {
        cycle: Bilingual,
        #[label("эта посылка замыкает круг")]
        at: SourceSpan,
    },
    /// A relation that no rule reads and nobody outside sees.
    #[error("отношение «{name}» нигде не используется")]
    #[diagnostic(
        code(facts::never_used),
        severity(Warning),
        help("покажите его наружу: .output {name}")
    )]
    NeverUsed {
        name: String,
        #[label("объявлено здесь")]
        at: SourceSpan,
    },
    /// A relation that is read, but that no fact, rule or input fills.
    #[error("отношение «{name}» всегда пусто: его ничто не выводит")]
    #[diagnostic(
        code(facts::never_derived),
        severity(Warning),
        help("допишите правило или .input {name}")
    )]
    NeverDerived {
        name: String,
        #[label("объявлено здесь")]
        at: SourceSpan,
    },
    /// A rule of which some premise never holds.
    #[error("правило никогда не сработает: {why}")]
    #[diagnostic(code(facts::never_fires), severity(Warning), help("проверьте эту посылку"))]
    NeverFires {
        why: Bilingual,
        #[label("эта посылка не выполняется")]
        at: SourceSpan,
    },
    /// Premises that nothing ties: all pairs are tried.
    #[error("посылки «{one}» и «{other}» ничем не связаны: перебираются все пары")]
    #[diagnostic(
        code(facts::product),
        severity(Warning),
        help("дайте им общую переменную или сравнение; если все пары и нужны, оставьте так")
    )]
    Product {
        one: String,
        other: String,
        #[label("здесь")]
        at: SourceSpan,
    },
    /// A variable that occurs once; often a slip of the pen.
    #[error("переменная «{variable}» встречается один раз")]
    #[diagnostic(
        code(facts::single_variable),
        severity(Warning),
        help("если так и задумано, пишите «_»")
    )]
    SingleVariable {
        variable: String,
        #[label("здесь")]
        at: SourceSpan,
    },
}

impl RuleError {
    /// A warning does not keep the program from running.
    #[must_use]
    pub fn is_warning(&self) -> bool {
        self.severity() == Some(miette::Severity::Warning)
    }

    /// Where in its text.
    #[must_use]
    pub fn span(&self) -> SourceSpan {
        match self {
            Self::Syntax { at, .. }
            | Self::Character { at, .. }
            | Self::Unclosed { at, .. }
            | Self::Number { at, .. }
            | Self::Unsupported { at, .. }
            | Self::Misuse { at, .. }
            | Self::TooLarge { at, .. }
            | Self::Duplicate { at, .. }
            | Self::UnknownRelation { at, .. }
            | Self::UnknownType { at, .. }
            | Self::UnknownComponent { at, .. }
            | Self::Record { at, .. }
            | Self::Unsigned { at, .. }
            | Self::Hint { at, .. }
            | Self::Wide { at, .. }
            | Self::Rounded { at, .. }
            | Self::LongText { at, .. }
            | Self::Pattern { at, .. }
            | Self::Arity { at, .. }
            | Self::Types { at, .. }
            | Self::Ungrounded { at, .. }
            | Self::Wildcard { at }
            | Self::Cycle { at, .. }
            | Self::NeverUsed { at, .. }
            | Self::NeverDerived { at, .. }
            | Self::NeverFires { at, .. }
            | Self::Product { at, .. }
            | Self::SingleVariable { at, .. } => *at,
        }
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
        let warnings = self.faults.iter().filter(|fault| fault.is_warning()).count();
        let errors = self.faults.len() - warnings;
        let (name, mut sep) = (self.source.name(), ":");
        write!(f, "«{name}»")?;
        for (what, count) in [("ошибок", errors), ("предупреждений", warnings)]
        {
            if count > 0 {
                write!(f, "{sep} {what} {count}")?;
                sep = ",";
            }
        }
        Ok(())
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
#[error("{}", head(files))]
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

/// One fault with its place; of several their number and the first.
fn head(files: &[FileFaults]) -> String {
    let mut all = files.iter().flat_map(|file| {
        file.placed()
            .map(|(line, column, fault)| format!("{}:{line}:{column}: {fault}", file.source.name()))
    });
    let first = all.next().unwrap_or_default();
    match all.count() {
        0 => first,
        more => format!("ошибок в правилах: {}; первая – {first}", more + 1),
    }
}

fn did_you_mean(nearest: Option<&str>, otherwise: &str) -> String {
    nearest.map_or_else(|| otherwise.to_owned(), |name| format!("может быть, «{name}»?"))
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
