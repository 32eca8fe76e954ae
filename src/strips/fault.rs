//! Faults in the texts that they were found in, all that there are at once.

use std::fmt;

use miette::{Diagnostic, LabeledSpan, Severity, SourceCode};

use super::error::RuleError;
use crate::units::{EnglishGroup, Fault as _, InEnglish, Language, Source, told};

/// A [`RuleError`] together with the text that it was found in.
#[derive(Debug, Clone)]
pub struct RuleFault {
    pub error: Box<RuleError>,
    source: Option<Source>,
}

impl RuleFault {
    /// A fault within a text; the labels of `error` are spans of `source`.
    #[must_use]
    pub fn new(source: &Source, error: RuleError) -> Self {
        Self { error: Box::new(error), source: Some(source.clone()) }
    }

    /// A fault of something that has no text, such as a fact that the map supplied.
    #[must_use]
    pub fn placeless(error: RuleError) -> Self {
        Self { error: Box::new(error), source: None }
    }

    /// File name, line and character column.
    #[must_use]
    pub fn position(&self) -> Option<(&str, usize, usize)> {
        let source = self.source.as_ref()?;
        let (line, column) = source.position(self.error.first_span()?.offset());
        Some((source.name(), line, column))
    }

    /// The text and the byte in it: what orders faults as their lines do, without counting lines for each of them.
    pub(super) fn place(&self) -> Option<(&str, usize)> {
        Some((self.source.as_ref()?.name(), self.error.first_span()?.offset()))
    }

    #[must_use]
    pub fn is_warning(&self) -> bool {
        self.error.is_warning()
    }
}

impl RuleFault {
    fn told(&self, language: Language) -> String {
        let place = self.position();
        let place = place.map(|(name, line, column)| format!("{name}:{line}:{column}: "));
        place.unwrap_or_default() + &self.error.tell(language)
    }
}

impl fmt::Display for RuleFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Language::Russian))
    }
}

impl InEnglish for RuleFault {
    fn english(&self) -> String {
        self.told(Language::English)
    }
    fn english_help(&self) -> Option<String> {
        self.error.english_help()
    }
    fn english_label(&self, nth: usize) -> String {
        self.error.english_label(nth)
    }
}

impl std::error::Error for RuleFault {}

impl Diagnostic for RuleFault {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.code()
    }
    fn severity(&self) -> Option<Severity> {
        self.error.severity()
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.help()
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        // Without a text a label points nowhere.
        self.source.as_ref().and_then(|_| self.error.labels())
    }
}

/// Everything that is wrong with what was read, in the order of the text; never empty.
#[derive(Debug, Clone)]
pub struct RuleFaults(pub Vec<RuleFault>);

impl RuleFaults {
    /// The stable codes, one a fault, for tests and the page.
    #[must_use]
    pub fn codes(&self) -> Vec<String> {
        self.0.iter().filter_map(|fault| fault.code().map(|code| code.to_string())).collect()
    }
}

impl From<RuleFault> for RuleFaults {
    fn from(fault: RuleFault) -> Self {
        Self(vec![fault])
    }
}

impl RuleFaults {
    fn told(&self, language: Language) -> String {
        match self.0.as_slice() {
            [only] => only.told(language),
            many => {
                let head = told!(language, "strips-faults", count = many.len());
                many.iter().fold(head, |told, fault| told + "\n  " + &fault.told(language))
            }
        }
    }

    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_> {
        EnglishGroup::new(self, self.told(Language::English), &self.0)
    }
}

impl fmt::Display for RuleFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(Language::Russian))
    }
}

impl std::error::Error for RuleFaults {}

impl Diagnostic for RuleFaults {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.first().and_then(Diagnostic::code)
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.0.iter().map(|fault| fault as &dyn Diagnostic)))
    }
}
