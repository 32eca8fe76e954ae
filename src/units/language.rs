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
    /// The language that a text is written in. Names are no evidence, nor are identifiers, as `robot1_charger`: the small
    /// words decide, then the first letter.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let words = || text.split(|c: char| !c.is_alphanumeric() && c != '_');
        let is_identifier = |word: &str| word.contains(|c: char| c == '_' || c.is_numeric());
        let small = |latin: bool| {
            let own = words().filter(|word| !is_identifier(word));
            let first = own.filter_map(|word| word.chars().next());
            first.filter(|c| c.is_lowercase() && c.is_ascii() == latin).count()
        };
        let first_is_latin = text.chars().find(|c| c.is_alphabetic()).is_some_and(|c| c.is_ascii());
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
