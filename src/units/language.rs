//! The two languages that people here speak.

use std::cmp::Ordering;

/// The language of a sentence or of a drawing's lettering.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Language {
    #[default]
    Russian,
    English,
}

impl Language {
    /// The language that a text is written in. Names are no evidence: the small words decide, then the first letter.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let words =
            || text.split(|c: char| !c.is_alphabetic()).filter_map(|word| word.chars().next());
        let small =
            |latin: bool| words().filter(|c| c.is_lowercase() && c.is_ascii() == latin).count();
        let first_is_latin = words().next().is_some_and(|c| c.is_ascii());
        match small(true).cmp(&small(false)) {
            Ordering::Greater => Self::English,
            Ordering::Equal if first_is_latin => Self::English,
            _ => Self::Russian,
        }
    }

    /// The text of this language.
    #[must_use]
    pub fn pick<T>(self, russian: T, english: T) -> T {
        match self {
            Self::Russian => russian,
            Self::English => english,
        }
    }
}
