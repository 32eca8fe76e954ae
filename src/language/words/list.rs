//! Lists as people say them.

pub use crate::units::Language;

/// «A, B и C» or "A, B and C".
///
/// ```
/// use orthoframe_language::{Language, enumerate};
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
