//! Lists as people say them, and the two languages.

use std::cmp::Ordering;

pub use crate::units::Language;

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
}

/// «A, B и C» or "A, B and C".
///
/// ```
/// use orthoframe::language::{Language, enumerate};
/// assert_eq!(enumerate(&["стол", "стул", "диван"], Language::Russian), "стол, стул и диван");
/// assert_eq!(enumerate(&["table", "chair"], Language::English), "table and chair");
/// ```
#[must_use]
pub fn enumerate(items: &[impl AsRef<str>], language: Language) -> String {
    joined(items, if language == Language::Russian { "и" } else { "and" })
}

/// «A, B или C» or "A, B or C".
#[must_use]
pub fn alternatives(items: &[impl AsRef<str>], language: Language) -> String {
    joined(items, if language == Language::Russian { "или" } else { "or" })
}

fn joined(items: &[impl AsRef<str>], word: &str) -> String {
    let items: Vec<&str> = items.iter().map(AsRef::as_ref).collect();
    match items.as_slice() {
        [] => String::new(),
        [only] => (*only).into(),
        [before @ .., last] => format!("{} {word} {last}", before.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_any_length() {
        assert_eq!(enumerate(&[""; 0], Language::Russian), "");
        assert_eq!(alternatives(&["a", "b", "c"], Language::English), "a, b or c");
        assert_eq!(alternatives(&["стол", "стул"], Language::Russian), "стол или стул");
    }

    #[test]
    fn a_text_has_a_language() {
        assert_eq!(Language::of("Go to Комната-В now"), Language::English);
        assert_eq!(Language::of("Поезжай в Room-B"), Language::Russian);
        assert_eq!(Language::of("?"), Language::Russian);
    }
}
