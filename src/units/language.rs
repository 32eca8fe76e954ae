//! The two languages that people here speak.

/// The language of a sentence or of a drawing's lettering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Language {
    #[default]
    Russian,
    English,
}

impl Language {
    /// The text of this language.
    #[must_use]
    pub fn pick<T>(self, russian: T, english: T) -> T {
        match self {
            Self::Russian => russian,
            Self::English => english,
        }
    }
}
