//! What can be wrong with rules, facts and questions, in English.

use std::fmt;

use miette::{Diagnostic, SourceCode};

use super::{AskError, EvaluateError, FactError, Faults, FileFaults, FilesError, RuleError};
use crate::units::{Bilingual, English, InEnglish, Language};

fn en(words: &Bilingual) -> &str {
    words.say(Language::English)
}

fn perhaps(nearest: Option<&str>, otherwise: &str) -> String {
    nearest.map_or_else(|| otherwise.to_owned(), |name| format!("perhaps “{name}”?"))
}

impl InEnglish for RuleError {
    fn english(&self) -> String {
        match self {
            Self::Syntax { expected, found, .. } => {
                format!("{} is expected here, and {} stands there", en(expected), en(found))
            }
            Self::Character { character, .. } => {
                format!("the sign “{character}” means nothing here")
            }
            Self::Unclosed { what, .. } => format!("{} is not closed", what.1),
            Self::Number { text, .. } => format!("the number “{text}” does not fit into 64 bits"),
            Self::Unsupported { what, .. } => format!("not supported: {}", en(what)),
            Self::Misuse { what, .. } => en(what).to_owned(),
            Self::TooLarge { what, limit, .. } => format!("{}: more than {limit}", what.1),
            Self::Duplicate { name, .. } => format!("“{name}” is declared twice"),
            Self::UnknownRelation { name, .. } => format!("unknown relation “{name}”"),
            Self::UnknownType { name, .. } => format!("unknown type “{name}”"),
            Self::UnknownComponent { name, .. } => format!("unknown component “{name}”"),
            Self::Record { what, .. } => format!("the record here has no known type: {what}"),
            Self::Hint { what, .. } => format!("{what}: this hint has no effect here"),
            Self::Wide { number, .. } => format!(
                "the number {number} does not fit into 32 bits: Soufflé will compute otherwise with it"
            ),
            Self::Rounded { number, .. } => format!(
                "the number {number} is rounded to six digits: Soufflé’s binary fraction is slightly different"
            ),
            Self::LongText { limit, .. } => {
                format!("a text longer than {limit} bytes is not kept: rows with it are left out")
            }
            Self::Pattern { pattern, .. } => {
                format!("“{pattern}” is no regular expression: nothing matches it")
            }
            Self::Unsigned { text, .. } => {
                format!("the number “{text}” does not fit into 32 bits without a sign")
            }
            Self::Arity { name, expected, found, .. } => {
                format!("“{name}” takes {expected} arguments, and {found} are given")
            }
            Self::Types { what, expected, found, .. } => {
                format!("“{what}”: the type {expected} is needed, and {} stands here", en(found))
            }
            Self::Ungrounded { variable, .. } => {
                format!("nothing binds the variable “{variable}”")
            }
            Self::Wildcard { .. } => "“_” stands where a value is needed".to_owned(),
            Self::Cycle { cycle, .. } => {
                format!("the relation depends on its own negation or aggregate: {}", en(cycle))
            }
            Self::NeverUsed { name, .. } => format!("the relation “{name}” is used nowhere"),
            Self::NeverDerived { name, .. } => {
                format!("the relation “{name}” is always empty: nothing derives it")
            }
            Self::NeverFires { why, .. } => format!("the rule never fires: {}", en(why)),
            Self::Product { one, other, .. } => {
                format!("nothing ties the premises “{one}” and “{other}”: all pairs are tried")
            }
            Self::SingleVariable { variable, .. } => {
                format!("the variable “{variable}” occurs once")
            }
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Syntax { .. } | Self::Number { .. } => return None,
            Self::Character { .. } => "texts are written in double quotation marks",
            Self::Unclosed { closing, .. } => return Some(format!("put {}", closing.1)),
            Self::Unsupported { help, .. } | Self::Misuse { help, .. } => help.1,
            Self::TooLarge { .. } => "divide it into several rules or relations",
            Self::Duplicate { .. } => "keep one declaration",
            Self::UnknownRelation { nearest, .. } => {
                return Some(perhaps(nearest.as_deref(), "declare it: .decl"));
            }
            Self::UnknownType { nearest, .. } => {
                let known = "there are symbol, number, unsigned and what .type declares";
                return Some(perhaps(nearest.as_deref(), known));
            }
            Self::UnknownComponent { nearest, .. } => {
                return Some(perhaps(nearest.as_deref(), "describe it: .comp"));
            }
            Self::Record { .. } => {
                "a relation’s column gives the type, or a branch’s name ($Name), or as([…], Type)"
            }
            Self::Hint { .. } => "what comes of the program does not depend on it",
            Self::Wide { .. } => "numbers have 64 bits here, and do not overflow silently",
            Self::Rounded { .. } => "a float is an exact decimal fraction in millionths here",
            Self::LongText { .. } => {
                "a recursive rule with cat makes a text grow without end; bound it: strlen(x) < 1000"
            }
            Self::Pattern { why, .. } => return Some(why.clone()),
            Self::Unsigned { .. } => "unsigned is from 0 to 4294967295",
            Self::Arity { name, .. } => {
                return Some(format!("compare with the declaration of “{name}”"));
            }
            Self::Types { .. } => {
                "numbers are written without quotation marks, texts within them; to_number and to_string convert"
            }
            Self::Ungrounded { .. } => {
                "name it in a positive premise of the rule, or equate it with what is known"
            }
            Self::Wildcard { .. } => "“_” serves in premises only, in the place of an argument",
            Self::Cycle { .. } => {
                "break the circle: only what was derived before can be negated and counted"
            }
            Self::NeverUsed { name, .. } => {
                return Some(format!("show it outside: .output {name}"));
            }
            Self::NeverDerived { name, .. } => {
                return Some(format!("add a rule, or .input {name}"));
            }
            Self::NeverFires { .. } => "check this premise",
            Self::Product { .. } => {
                "give them a common variable or a comparison; if all pairs are wanted, leave it so"
            }
            Self::SingleVariable { .. } => "if it is meant so, write “_”",
        };
        Some(help.to_owned())
    }

    fn english_labels(&self) -> [&'static str; 2] {
        match self {
            Self::Unclosed { .. } => ["opened here", ""],
            Self::Duplicate { .. } => ["the second declaration", ""],
            Self::Ungrounded { .. } => ["no value", ""],
            Self::Cycle { .. } => ["this premise closes the circle", ""],
            Self::NeverFires { .. } => ["this premise does not hold", ""],
            _ => ["here", "and here"],
        }
    }
}

/// The faults of one text as English tells them.
pub struct EnglishFile<'f> {
    file: &'f FileFaults,
    faults: Vec<English<'f, RuleError>>,
}

/// The faults of all texts of a program as English tells them.
pub struct EnglishProgram<'f> {
    all: &'f Faults,
    files: Vec<EnglishFile<'f>>,
}

impl FileFaults {
    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishFile<'_> {
        EnglishFile { file: self, faults: self.faults.iter().map(English).collect() }
    }
}

impl Faults {
    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishProgram<'_> {
        EnglishProgram { all: self, files: self.files.iter().map(FileFaults::in_english).collect() }
    }
}

impl fmt::Debug for EnglishFile<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.file, f)
    }
}

impl fmt::Display for EnglishFile<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let warnings = self.file.faults.iter().filter(|fault| fault.is_warning()).count();
        let errors = self.file.faults.len() - warnings;
        let told = [("errors", errors), ("warnings", warnings)];
        let told: Vec<String> = told
            .iter()
            .filter(|(_, count)| *count > 0)
            .map(|(what, count)| format!("{what} {count}"))
            .collect();
        write!(f, "“{}”: {}", self.file.source.name(), told.join(", "))
    }
}

impl std::error::Error for EnglishFile<'_> {}

impl Diagnostic for EnglishFile<'_> {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.file.source)
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.faults.iter().map(|fault| fault as &dyn Diagnostic)))
    }
}

impl fmt::Debug for EnglishProgram<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.all, f)
    }
}

/// One fault with its place; of several their number and the first.
impl fmt::Display for EnglishProgram<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut all = self.all.files.iter().flat_map(|file| {
            file.placed().map(|(line, column, fault)| {
                format!("{}:{line}:{column}: {}", file.source.name(), fault.english())
            })
        });
        let first = all.next().unwrap_or_default();
        match all.count() {
            0 => f.write_str(&first),
            more => write!(f, "faults in the rules: {}; the first: {first}", more + 1),
        }
    }
}

impl std::error::Error for EnglishProgram<'_> {}

impl Diagnostic for EnglishProgram<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.all.code()
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.files.iter().map(|file| file as &dyn Diagnostic)))
    }
}

impl InEnglish for FactError {
    fn english(&self) -> String {
        match self {
            Self::UnknownRelation { name, .. } => format!("unknown relation “{name}”"),
            Self::Arity { relation, expected, found } => {
                format!("“{relation}” has {expected} columns, and {found} values are given")
            }
            Self::Types { relation, column, expected, found } => format!(
                "“{relation}”, column “{column}”: the type {expected} is needed, and “{found}” is given"
            ),
        }
    }

    fn english_help(&self) -> Option<String> {
        Some(match self {
            Self::UnknownRelation { nearest, .. } => {
                perhaps(nearest.as_deref(), "declare it in the rule file: .decl")
            }
            Self::Arity { relation, .. } | Self::Types { relation, .. } => {
                format!("compare with the declaration of “{relation}”")
            }
        })
    }
}

impl InEnglish for EvaluateError {
    fn english(&self) -> String {
        match self {
            Self::TooMany { relation, rule, limit } => {
                format!("{rule}: the relation “{relation}” has more than {limit} rows")
            }
            Self::Time { relation, rule, seconds, rows } => format!(
                "{rule}: within {seconds} s the relation “{relation}” is not derived, with {rows} rows so far"
            ),
            Self::Memory { relation, rule, megabytes, rows } => format!(
                "{rule}: the relation “{relation}” does not fit into {megabytes} MiB of memory, with {rows} rows so far"
            ),
            Self::Stopped { relation, rule } => {
                format!("{rule}: the relation “{relation}” is not derived: stopped")
            }
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::TooMany { .. } => {
                "the rule seems to make new rows without end; bound its numbers by a comparison, give .limitsize, or allow more rows (--row-limit)"
            }
            Self::Time { .. } => {
                "the rule seems to make new rows without end: bound its numbers by a comparison; or give more time (--time-limit)"
            }
            Self::Memory { .. } => {
                "bind the rule’s premises by common variables, or bound it by a comparison; or give more memory (--memory-limit)"
            }
            Self::Stopped { .. } => return None,
        };
        Some(help.to_owned())
    }
}

impl InEnglish for AskError {
    fn english(&self) -> String {
        match self {
            Self::Faults(faults) => faults.in_english().to_string(),
            Self::Evaluate(error) => error.english(),
            Self::Blocked { relation, needs, place } => {
                format!("{place}the relation “{relation}” is computed when {} are known", en(needs))
            }
            Self::TooDeep { relation } => {
                format!("“{relation}” depends on too long a chain of relations")
            }
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Faults(_) => return None,
            Self::Evaluate(error) => return error.english_help(),
            Self::Blocked { .. } => "bind these columns by other premises, or name their values",
            Self::TooDeep { .. } => "derive a part of the chain beforehand",
        };
        Some(help.to_owned())
    }
}

impl AskError {
    /// The faults as English tells them, each with its place.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Faults(faults) => Box::new(faults.in_english()),
            other => Box::new(English(other)),
        }
    }
}

impl InEnglish for FilesError {
    fn english(&self) -> String {
        match self {
            Self::Program(faults) => faults.in_english().to_string(),
            Self::File { path, cause } => format!("{}: {cause}", path.display()),
            Self::Line { path, line, cause } => {
                format!("{}:{line}: {}", path.display(), cause.english())
            }
            Self::Parameter { relation, name, value } => {
                format!("“{relation}”: {name}={value} is not supported")
            }
            Self::Evaluate(error) => error.english(),
            Self::Ask(error) => error.english(),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Program(_) => return None,
            Self::File { .. } => {
                "check the name and the permissions: facts of a relation r are read from r.facts, the output folder must be there"
            }
            Self::Line { .. } => "values are divided by tabs, one a column",
            Self::Parameter { .. } => {
                "there are IO=file, for .input IO=stdin, for .output IO=stdout, filename, delimiter, headers, rfc4180, for .input columns=\"1:0\""
            }
            Self::Evaluate(error) => return error.english_help(),
            Self::Ask(error) => return error.english_help(),
        };
        Some(help.to_owned())
    }
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
