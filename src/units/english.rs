//! Faults in English: what displays itself in Russian, told with English words in the same places.

use std::fmt;

use miette::{Diagnostic, LabeledSpan, Severity, SourceCode};

/// A fault that has English words besides the Russian ones with which it is displayed.
pub trait InEnglish: Diagnostic {
    fn english(&self) -> String;
    /// The remedy.
    fn english_help(&self) -> Option<String>;
    /// What its first label says, and what the others do.
    fn english_labels(&self) -> [&'static str; 2] {
        ["here", "and here"]
    }
    /// What its label of this number says.
    fn english_label(&self, nth: usize) -> String {
        self.english_labels()[nth.min(1)].to_owned()
    }
}

/// A fault as English tells it.
#[derive(Debug, Clone, Copy)]
pub struct English<'f, F>(pub &'f F);

impl<F: InEnglish> fmt::Display for English<'_, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.english())
    }
}

impl<F: InEnglish> std::error::Error for English<'_, F> {}

impl<F: InEnglish> Diagnostic for English<'_, F> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.code()
    }
    fn severity(&self) -> Option<Severity> {
        self.0.severity()
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.0.english_help()?))
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.source_code()
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = |(nth, label): (usize, LabeledSpan)| {
            LabeledSpan::new_with_span(Some(self.0.english_label(nth)), *label.inner())
        };
        Some(Box::new(self.0.labels()?.enumerate().map(label)))
    }
}

impl<'f, F: InEnglish> English<'f, F> {
    /// Each of several, for a [`EnglishGroup`].
    #[must_use]
    pub fn each(faults: &'f [F]) -> Vec<Box<dyn Diagnostic + 'f>> {
        faults.iter().map(|fault| Box::new(Self(fault)) as _).collect()
    }
}

/// Faults that stand together, as English tells them.
#[derive(Debug)]
pub struct EnglishGroup<'f> {
    pub all: &'f dyn Diagnostic,
    /// What is told of all of them in a line.
    pub title: String,
    pub help: Option<String>,
    pub faults: Vec<Box<dyn Diagnostic + 'f>>,
}

impl<'f> EnglishGroup<'f> {
    /// Faults under a title, without a remedy of their own.
    #[must_use]
    pub fn new(all: &'f dyn Diagnostic, title: String, faults: &'f [impl InEnglish]) -> Self {
        Self { all, title, help: None, faults: English::each(faults) }
    }
}

impl fmt::Display for EnglishGroup<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.title)
    }
}

impl std::error::Error for EnglishGroup<'_> {}

impl Diagnostic for EnglishGroup<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.all.code()
    }
    fn severity(&self) -> Option<Severity> {
        self.all.severity()
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.help.as_ref()?))
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.all.source_code()
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.faults.iter().map(|fault| &**fault as _)))
    }
}
